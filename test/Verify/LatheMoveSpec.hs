-- | Ways of a lathe to its retract positions and back.
module Verify.LatheMoveSpec (spec) where

import Base.Quantity (Mm (..))
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Gcode.Run (Action (..), Step (..))
import Gcode.Run qualified as Run
import Geometry.Segment (Segment (..))
import Geometry.Vec qualified as Vec
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine (Machine (programForm), MachineName (..), ProgramForm)
import Machine.ProgramForm (XMeaning (..))
import Test.Hspec
import Verify.ControlFault (ControlFault (..))
import Verify.LatheMove (LatheDemand (..), Nose (..))
import Verify.LatheMove qualified as LatheMove

spec :: Spec
spec = describe "ways of a lathe to its retract positions" $ do
  it "are X alone, and then Z" $ do
    faultsOf 1 (leaving <> coming 10 60) `shouldBe` []
    faultsOf 1 (leaving <> coming 10 60 <> leaving) `shouldBe` []
  it "do not begin with Z" $
    faultsOf 1 ["G53 G0 Z0", "G53 G0 X0"] `shouldBe` [LatheOrder]
  it "do not move X and Z at once" $ do
    faultsOf 1 ["G53 G0 X0 Z0"] `shouldBe` [LatheOrder]
    faultsOf 1 (leaving <> ["G0 X60 Z10"]) `shouldBe` [LatheOrder]
  it "do not lead to a place where Z is not known" $
    faultsOf 1 ["G53 G0 X0", "G0 X60"] `shouldBe` [LatheOrder]
  it "do not lead to other places of the machine" $ do
    faultsOf 1 ["G53 G0 X-30"] `shouldBe` [LatheOrder]
    faultsOf 1 ["G53 G0 X0 Z-50"] `shouldBe` [LatheOrder]
    faultsOf 1 (leaving <> ["G53 G0 Z-50"]) `shouldBe` [LatheOrder]
  it "are Z and then X in a bore, and back" $
    faultsOf 2 (leaving <> ["G0 X20", "G0 Z-10", "G53 G0 Z0", "G53 G0 X0"]) `shouldBe` []
  it "do not pass through a bore along X" $ do
    faultsOf 2 (leaving <> ["G0 X20", "G0 Z-10"] <> leaving) `shouldBe` [ThroughProfile]
    faultsOf 2 (leaving <> ["G0 Z-10", "G0 X20"]) `shouldBe` [ThroughProfile]
  it "do not pass through a shoulder along Z" $
    faultsOf 1 (leaving <> ["G0 Z-45", "G0 X42", "G53 G0 Z0", "G53 G0 X0"])
      `shouldBe` [ThroughProfile]
  it "may begin where the nose touches the part" $
    -- The tip 2 of a nose of 0.8 mm that touches the diameter of 40 mm.
    faultsOf 1 (leaving <> ["G0 Z-40", "G0 X40", "G53 G0 X0"]) `shouldBe` []
  it "are as far from the part with a pointed tool" $ do
    faultsOf 3 (leaving <> ["G0 Z-45", "G0 X40", "G53 G0 X0"]) `shouldBe` []
    faultsOf 3 (leaving <> ["G0 X20", "G0 Z-10"] <> leaving) `shouldBe` [ThroughProfile]
  where
    leaving = ["G53 G0 X0", "G53 G0 Z0"]
    coming z x = ["G0 Z" <> number z, "G0 X" <> number x]
    number :: Int -> Text
    number = Text.pack . show

-- | Faults of the motions of lines, with the tool of this number.
faultsOf :: Int -> [Text] -> [ControlFault]
faultsOf tool ls = case Run.run form (Just tool) 1 (Text.unlines ("G21 G18 G90 G7" : ls)) of
  Left fault -> error (show fault)
  Right steps ->
    concat [LatheMove.faults demand step travel | step@Step {action = Travels travel} <- steps]

form :: ProgramForm
form = fromMaybe (error "no form") (BuiltIn.find (MachineName "linuxcnc-lathe") >>= programForm)

-- | A shaft of 40 mm between the shoulders of 50 mm at -25 mm and of 60 mm at -50 mm, with a bore
-- of 30 mm.
demand :: LatheDemand
demand =
  LatheDemand
    { wordsOfX = XDiameter,
      profiles =
        [ Straight (Vec.point 0 25) (Vec.point (-25) 25),
          Straight (Vec.point (-25) 25) (Vec.point (-25) 20),
          Straight (Vec.point (-25) 20) (Vec.point (-50) 20),
          Straight (Vec.point (-50) 20) (Vec.point (-50) 30),
          Straight (Vec.point 0 15) (Vec.point (-50) 15)
        ],
      noses =
        Map.fromList
          [ (1, Nose (Mm 0.8) (Mm (-0.8)) (Mm (-0.8))),
            (2, Nose (Mm 0.4) (Mm (-0.4)) (Mm 0.4)),
            (3, Nose (Mm 0) (Mm 0) (Mm 0))
          ],
      slack = Mm 0.022
    }
