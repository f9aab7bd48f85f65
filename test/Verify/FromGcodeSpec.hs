-- | Files of G-code with one line changed by hand: what the proof of the file reports, and at which
-- line. Each test is a case that a simple reader of the file would pass over.
module Verify.FromGcodeSpec (spec) where

import Base.Quantity (Mm (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Gcode.Block (Fault (..), FaultReason (..))
import Gcode.ModalState (Coolant (..))
import GcodeSubject (Subject (own), judged, subjectOf)
import Test.Hspec
import Verify.ControlFault (ControlFault (..), ControlFinding (..))
import Verify.Proof qualified as Proof

-- | Verdict about a file.
data Outcome
  = NotRead Fault
  | -- | the faults of the state, each with its line, and the count of other findings
    Judged [(Int, ControlFault)] Int
  deriving stock (Eq, Show)

spec :: Spec
spec = do
  describe "a line that is not understood" $ do
    it "has a word of an arc that no arc uses" $
      changed "cover" "G1 X21.000" "G1 X21.000 I2" `gives` notRead 23 12 (UnusedWord "I")
    it "has the centre of an arc along the axis of its plane" $
      changed "cover" "G3 X13.000 I-2.000 J0.000" "G3 X13.000 I-2.000 K0.000"
        `gives` notRead 21 20 (UnusedWord "K")
    it "has a position beside a dwell: the control would move there" $
      changed "bar" "G4 P3" "G4 P3 X15" `gives` notRead 16 7 (UnusedWord "X")
    it "has G53 without an axis" $
      changed "bar" "G53 G0 Z0" "G53 G0" `gives` notRead 12 1 (WordMissing "Z0" "G53")
    it "may be left out by the operator" $
      changed "bar" "G0 X-5.000" "/G0 X-5.000" `gives` notRead 17 1 (UnprovenWord "/")
  describe "a fault of the state" $ do
    it "is a move to an unknown height, at the end of the file too" $
      changedLast "bar" "G53 G0 Z0" "G53 G0 Z-50" `gives` Judged [(52, UnknownHeight)] 0
    it "is a change of the tool near the part" $
      changed "plate" "G53 G0 Z0\nM5\nM9\nT2" "M5\nM9\nT2" `givesFault` (31, LowChange)
    it "is a feed that G94 has set to 0" $
      changed "cover" "G1 X21.000" "G94\nG1 X21.000"
        `givesFault` (24, NoFeed)
    it "is a feed in the units of the line before" $
      changed "cover" "G1 X21.000" "G20 F7.874\nG21\nG1 X21.000" `givesOther` True
    it "is mist where the program asks for flood" $
      changed "cover" "M8" "M7" `givesFault` (37, OtherCoolant Flood)
    it "is a bound of the path mode that no contour allows" $
      changed "bar" "G61" "G64 P0.01 Q0" `givesFault` (18, BoundTooLarge (Mm 0.01) (Mm 0.001))
    it "is a path mode without a bound, at rapid moves too" $
      changedLast "cover" "G0 Z2.000" "G64\nG0 Z2.000" `givesFault` (46, NoBound)
    it "is a path mode with a negative Q" $
      changed "cover" "G64 P0.020 Q0" "G64 P0.030 Q-0.010" `givesFault` (17, NoBound)
  describe "a file is accepted" $ do
    it "that waits for the spindle longer, or not at all" $ do
      changed "bar" "G4 P3" "G4 P9" `gives` Judged [] 0
      changed "plate" "G4 P3\n" "" `gives` Judged [] 0
    it "that comes down over another point of a rapid move" $
      changedLast
        "bar"
        "G0 X35.000 Y5.000\nG0 Z2.000\nG0 X10.000 Y15.000 Z15.000"
        "G0 X10.000 Y15.000\nG0 Z15.000"
        `gives` Judged [] 0
    it "that stops on its way down from the retract height" $
      changedLast "bar" "G0 Z15.000\nG0 X5.000 Y5.000 Z2.000" "G0 X5.000 Y5.000\nG0 Z10\nG0 Z2"
        `gives` Judged [] 0
    it "that goes up from a hole to the retract height at once" $
      changed "bar" "G1 Z-6.000\nG0 Z2.000\nG53 G0 Z0" "G1 Z-6.000\nG53 G0 Z0" `gives` Judged [] 0
  where
    notRead n column reason = NotRead (Fault n column reason)

-- | Outcome of a program's own file with its first lines of a text replaced.
changed :: FilePath -> Text -> Text -> IO Outcome
changed name old new = outcome name $ \text ->
  let (begin, rest) = Text.breakOn old text in begin <> new <> Text.drop (Text.length old) rest

-- | Does the same with the last lines of a text.
changedLast :: FilePath -> Text -> Text -> IO Outcome
changedLast name old new = outcome name $ \text ->
  let (begin, rest) = Text.breakOnEnd old text
   in Text.dropEnd (Text.length old) begin <> new <> rest

gives :: IO Outcome -> Outcome -> Expectation
gives action wanted = action >>= (`shouldBe` wanted)

-- | Expects a fault of the state among others.
givesFault :: IO Outcome -> (Int, ControlFault) -> Expectation
givesFault action wanted =
  action >>= \case
    Judged faults _ -> faults `shouldContain` [wanted]
    NotRead fault' -> expectationFailure (show fault')

-- | Expects other findings than those of the state, or none.
givesOther :: IO Outcome -> Bool -> Expectation
givesOther action wanted =
  action >>= \case
    Judged _ others -> (others > 0) `shouldBe` wanted
    NotRead fault' -> expectationFailure (show fault')

-- | Reads and judges the file of a program after a change.
outcome :: FilePath -> (Text -> Text) -> IO Outcome
outcome name change = do
  subject <- subjectOf ("test/gcode/" <> name <> ".part")
  let text = change (own subject)
  text `shouldNotBe` own subject
  pure $ case judged subject text of
    Left fault' -> NotRead fault'
    Right proof ->
      Judged
        [(n, f) | ControlFinding n _ f <- Proof.controlFindings proof]
        (length (Proof.findings proof))
