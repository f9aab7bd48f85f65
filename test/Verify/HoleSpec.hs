-- | Laws of works on holes: random ones are proven, and no altered one is.
module Verify.HoleSpec
  ( spec,
  )
where

import Base.Decimal qualified as Decimal
import Base.Result qualified as Result
import Compile (Compiled (..), Punched (..))
import Compile qualified
import Data.Either (isLeft)
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Frame qualified as Frame
import Gcode.Heading qualified as Heading
import Gcode.Writer (ToolFile (fileText))
import Machine.Machine qualified as Machine
import Machines qualified
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report qualified as Report
import Test.Hspec
import Test.QuickCheck
import Verify.FromGcode qualified as FromGcode
import Verify.FromTape qualified as FromTape
import Verify.Proof (Proof)
import Verify.Proof qualified as Proof

spec :: Spec
spec = do
  it
    "random works on holes are proven on every control that can make them (catches a helix in the \
    \other sense, and pecks that differ from those of a cycle)"
    $ property $
      forAll work $ \w -> forAll (elements (controls w)) $ \machine ->
        case compiledFor machine (programOf machine w (statement w)) of
          Left why -> counterexample (show why) False
          Right c -> fmap Proof.findings (proof c) === Just []
  it
    "a tape with one altered depth, diameter, pitch or peck is refused (catches a proof that takes \
    \its moves from the toolpath)"
    $ property $
      forAll work $ \w ->
        forAll (elements (controls w)) $ \machine ->
          forAll (elements (altered w)) $ \other ->
            case ( compiledFor machine (programOf machine w (statement w)),
                   compiledFor machine (programOf machine w other)
                 ) of
              (Right right, Right wrong) ->
                counterexample (Text.unpack other) (isProven right wrong === False)
              (a, b) -> counterexample (show (void' a, void' b)) False
  where
    void' = either Just (const Nothing)

-- | A work on holes: the tool, the statement, and statements with one other size.
data Work = Work {tool :: Text, statement :: Text, altered :: [Text], isTap :: Bool}
  deriving stock (Show)

-- | Names of the controls that can make it.
controls :: Work -> [Text]
controls w
  | isTap w = ["linuxcnc-mill", "haas"]
  | otherwise = ["linuxcnc-mill", "haas", "fanuc", "grbl", "marlin", "iso6983", "lkp-01f", "n55"]

-- | The text of a program with one statement.
programOf :: Text -> Work -> Text -> Text
programOf machine w made =
  Text.unlines
    [ "part p",
      "machine " <> machine,
      "safe 50",
      "tool 1 " <> tool w,
      "feed 120",
      "tolerance 0.03",
      "clearance 1",
      "from (0, 0, 1)",
      "spindle cw 500 rpm",
      made
    ]

-- | The tape or the file of a program on a machine; the reports if there is none.
compiledFor :: Text -> Text -> Either [Text] Compiled
compiledFor machine text = case Result.ifSound outcome of
  Just [c] -> Right c
  _ -> Left (text : map Report.title (Result.errors outcome))
  where
    loaded = LoadedProgram.fromText "p.part" text
    outcome = Compile.compile (Machines.jobFor (Machines.named machine) []) loaded

-- | True if the tape or the file of the second program is proven for the first one.
isProven :: Compiled -> Compiled -> Bool
isProven right wrong = case Machine.programForm (machine right) of
  Just form ->
    let readAs =
          FromGcode.readTexts
            (machine right)
            form
            (Heading.fromToolpath (toolpath right))
            (Compile.program (punched right))
            (map fileText (files (punched wrong)))
     in not (isLeft readAs) && either (const False) (good . judged form) readAs
  Nothing ->
    good
      ( FromTape.prove
          (machine right)
          (toolpath right)
          (Compile.program (punched right))
          (map Frame.frame (Frame.plannedFrames (Compile.program (punched wrong))))
      )
  where
    judged form = Compile.proveGcode form Nothing right
    good :: Proof -> Bool
    good found = null (Proof.findings found) && null (Proof.controlFindings found)

-- | A length in mm with one decimal.
size :: (Int, Int) -> Gen Double
size (low, high) = (/ 10) . fromIntegral <$> chooseInt (10 * low, 10 * high)

mm :: Double -> Text
mm = Decimal.short 4

-- | A random work on one to three holes.
work :: Gen Work
work = do
  count <- chooseInt (1, 3)
  ps <- vectorOf count ((,) <$> size (-40, 40) <*> size (-40, 40))
  let at = "at [" <> Text.intercalate ", " [pair p | p <- ps] <> "]"
      pair (x, y) = "(" <> mm x <> ", " <> mm y <> ")"
  oneof [drilled at, pointed at, reamed at, circled at, threaded at, tapped at]

drilled :: Text -> Gen Work
drilled at = do
  d <- size (4, 20)
  p <- size (1, 3)
  rise <- elements [Nothing, Just 0.254, Just 0.6]
  let made deep peck up =
        "drill " <> at <> " depth " <> mm deep <> " { peck " <> mm peck
          <> maybe "" ((" chip break " <>) . mm) up
          <> " }"
  pure
    Work
      { tool = "drill(diameter 5)",
        statement = made d p rise,
        altered =
          [made (d + 0.4) p rise, made d (p / 2) rise]
            <> [made d p (Just (r + 0.3)) | Just r <- [rise]],
        isTap = False
      }

pointed :: Text -> Gen Work
pointed at = do
  d <- size (2, 9)
  word <- elements ["spot " <> at <> " diameter ", "countersink " <> at <> " angle 90 diameter "]
  pure
    Work
      { tool = "drill(diameter 12, angle 90)",
        statement = word <> mm d,
        altered = [word <> mm (d + 0.5), word <> mm (d - 0.5)],
        isTap = False
      }

reamed :: Text -> Gen Work
reamed at = do
  d <- size (2, 12)
  pure
    Work
      { tool = "drill(diameter 6)",
        statement = "ream " <> at <> " depth " <> mm d,
        altered = ["ream " <> at <> " depth " <> mm (d + 0.4), "drill " <> at <> " depth " <> mm d],
        isTap = False
      }

circled :: Text -> Gen Work
circled at = do
  d <- size (7, 30)
  h <- size (2, 6)
  p <- size (1, 3)
  sense <- elements ["", "conventional"]
  isBore <- arbitrary
  let made wide deep pitch other
        | isBore =
          "bore " <> at <> " diameter " <> mm wide <> " depth " <> mm deep <> " pitch " <> mm pitch
            <> " { "
            <> other
            <> " }"
        | otherwise =
          "counterbore " <> at <> " diameter " <> mm wide <> " depth " <> mm deep <> " { pitch "
            <> mm pitch
            <> " "
            <> other
            <> " }"
  pure
    Work
      { tool = "mill(diameter 6)",
        statement = made d h p sense,
        altered =
          [ made (d + 0.4) h p sense,
            made d (h + 0.4) p sense,
            made d h (p / 3) sense,
            made d h p (if sense == "" then "conventional" else "")
          ],
        isTap = False
      }

threaded :: Text -> Gen Work
threaded at = do
  d <- size (6, 20)
  h <- size (2, 8)
  (side, hand) <- (,) <$> elements [" inside", " outside"] <*> elements ["left", "right"]
  let made wide deep which =
        "thread " <> at <> " diameter " <> mm wide <> " pitch 1 depth " <> mm deep <> side
          <> " { hand "
          <> which
          <> " }"
  pure
    Work
      { tool = "threadmill(diameter 4, pitch 1)",
        statement = made d h hand,
        altered =
          [ made (d + 0.4) h hand,
            made d (h + 0.4) hand,
            made d h (if hand == "left" then "right" else "left")
          ],
        isTap = False
      }

tapped :: Text -> Gen Work
tapped at = do
  h <- size (4, 12)
  p <- elements [0.8, 1, 1.5]
  let made pitch deep = "tap " <> at <> " pitch " <> mm pitch <> " depth " <> mm deep
  pure
    Work
      { tool = "tap(diameter 6)",
        statement = made p h,
        altered = [made (p + 0.2) h, made p (h + 0.4)],
        isTap = True
      }
