-- | Descents among moves.
module Draw.DescentSpec (spec) where

import Base.Quantity (Feed (..), Mm (..))
import Base.Region (Located (..), Region (..))
import Draw.Descent (Descent (..), DescentKind (..))
import Draw.Descent qualified as Descent
import Geometry.Carrier (Sense (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Part.CutFeed (CutFeed (..))
import Part.Part (Pace (..))
import Test.Hspec
import Toolpath.Toolpath (Manner (..), Move (..))

spec :: Spec
spec = describe "descents" $ do
  it "are told apart by their moves (catches a helix that is taken for a ramp)" $
    map (map kind . Descent.ofMoves . pure) [down plunge 2, down ramp 2, down turn 2]
      `shouldBe` [[Plunge], [Ramp], [Helix]]
  it "end where the tool is deepest (catches a descent for each move)" $
    Descent.ofMoves
      [move ramp (5, -1), move back (-1, -3), move plunge (-3, 5), move plunge (5, -2)]
      `shouldBe` [Descent Ramp (Vec.point 0 0) (Mm (-3)), Descent Plunge (Vec.point 0 0) (Mm (-2))]
  it "begin at the top of the part (catches the way down to the clearance height)" $
    map kind (Descent.ofMoves [move back (20, 5), move plunge (5, -4)]) `shouldBe` [Plunge]
  it "do not end above the part" $
    Descent.ofMoves [move plunge (20, 1)] `shouldBe` []
  it "of one kind at one point are listed once, with the lowest end" $
    map bottom (Descent.deepest (concatMap (Descent.ofMoves . pure . down plunge) [2, 6, 4]))
      `shouldBe` [Mm (-6)]
  where
    down segment' depth = move segment' (1, negate depth)
    plunge = Straight (Vec.point 0 0) (Vec.point 0 0)
    ramp = Straight (Vec.point 0 0) (Vec.point 9 0)
    back = Straight (Vec.point 9 0) (Vec.point 0 0)
    turn = Segment.arc Clockwise (Vec.point 0 0) (Vec.point 5 0) (Vec.point 0 5)

move :: Segment -> (Double, Double) -> Move
move along (from, to) =
  Move
    { segment = along,
      manner =
        Manner
          { between = (Mm from, Mm to),
            Toolpath.Toolpath.at = At (Located nowhere (PerMinute (Feed 100))),
            isBraking = False
          },
      origin = nowhere,
      continues = False
    }
  where
    nowhere = Region 0 0
