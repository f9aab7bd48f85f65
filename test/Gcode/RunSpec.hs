-- | Lines that a control reads in another way than others, or on which it acts.
module Gcode.RunSpec (spec) where

import Control.Monad (forM_)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Gcode.Block (Fault (..), FaultReason (..))
import Gcode.Run qualified as Run
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine (MachineName (..), ProgramForm, programForm)
import Test.Hspec

spec :: Spec
spec = describe "lines of files" $ do
  forM_ refused $ \(machine, text, reason) ->
    it ("are refused for " <> Text.unpack machine <> ": " <> show text) $
      case Run.run (formOf machine) (Just 1) 1 text of
        Left (Fault _ _ found) -> found `shouldBe` reason
        Right _ -> expectationFailure "the line is read"
  forM_ accepted $ \(machine, text) ->
    it ("are read for " <> Text.unpack machine <> ": " <> show text) $
      case Run.run (formOf machine) (Just 1) 1 text of
        Left fault -> expectationFailure (show fault)
        Right _ -> pure ()

  it "have the first fault of a file, in the order of its lines" $ do
    let linesOf = Run.run (formOf "grbl") (Just 1) 1 . Text.unlines
        long = "(" <> Text.replicate 300 "a" <> ")"
        placeOf answer = case answer of
          Left (Fault n _ _) -> Just n
          Right _ -> Nothing
    placeOf (linesOf ["G21", "X1", "G1 Z-20!"]) `shouldBe` Just 2
    placeOf (linesOf ["G21", "G1 Z-20!", "X1"]) `shouldBe` Just 2
    placeOf (linesOf ["G21", long, "X1"]) `shouldBe` Just 2
    placeOf (linesOf ["G21", "X1", long]) `shouldBe` Just 2
    placeOf (linesOf ["G21", "G0", long]) `shouldBe` Just 3

formOf :: Text -> ProgramForm
formOf name =
  fromMaybe (error "no machine with a form") (BuiltIn.find (MachineName name) >>= programForm)

refused :: [(Text, Text, FaultReason)]
refused =
  [ ("linuxcnc-mill", "G21 ;py,this.execute(\"G1 Z-30 F100\")", ActiveComment),
    ("linuxcnc-mill", "( PY , x = 1 )", ActiveComment),
    ("linuxcnc-mill", "G21 (LOGOPEN,file.txt)", ActiveComment),
    ("linuxcnc-mill", "(probe open file.txt) G21", ActiveComment),
    ("linuxcnc-lathe", ";py,print(1)", ActiveComment),
    ("linuxcnc-mill", "(a\rG1 Z-20 F100\r)", LoneReturn),
    ("haas", "(a\rG1 Z-20. F100.\r)", LoneReturn),
    ("grbl", "(a\rG1 Z-20 F100\r)", LoneReturn),
    ("marlin", ";a\rG1 Z-20 F100", LoneReturn),
    ("grbl", "G21 (stop!)", RealTimeCharacter '!'),
    ("grbl", "(ready?)", RealTimeCharacter '?'),
    ("grbl", "(\CAN)", RealTimeCharacter '\CAN'),
    ("grbl", "(Gehäuse)", RealTimeCharacter 'ä'),
    ("grbl", "%", OtherMeaning '%'),
    ("marlin", "G1 (Z-20) X8", OtherMeaning '('),
    ("marlin", "/G0 Z15", OtherMeaning '/'),
    ("marlin", "g0 Z15", OtherMeaning 'g'),
    ("marlin", "%", OtherMeaning '%'),
    ("marlin", "M0 S5", UnprovenWord "S5"),
    ("marlin", "M1 P500", UnprovenWord "P500"),
    ("haas", "G1 X8. ; Z-20.", OtherMeaning ';'),
    ("haas", "G21 G90 G1 X8 F100.", PointMissing "X8"),
    ("fanuc", "G21 G90 G1 X8. F100", PointMissing "F100"),
    ("fanuc", "S6000 M3 M8", RepeatedWord "M8"),
    ("fanuc", "G21\nO2000", UnprovenWord "O2000")
  ]

accepted :: [(Text, Text)]
accepted =
  [ ("linuxcnc-mill", "G21 (MSG, pylon) ; python, later"),
    ("linuxcnc-mill", "%\nG21 (ready? Gehäuse!)\n%"),
    ("linuxcnc-mill", "G21 G90\r\nG0 X0 Y0\r\n"),
    ("grbl", "G21 G90 (a tab:\tdone) g0 x1 y1"),
    ("grbl", "/G21"),
    ("marlin", "G21 ; all (of %) it"),
    ("marlin", "M0"),
    ("haas", "O2000 (first)\nG0 G17 G40 G49 G80 G90 G69 G50;"),
    ("haas", "G90 G53 G0 Z0"),
    ("haas", "G91 G28 Z0."),
    ("linuxcnc-mill", "(pyramid)")
  ]
