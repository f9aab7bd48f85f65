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
import Frame.Frame (FrameProgram)
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
  it
    "a compiler that makes one other depth, diameter, pitch or peck is refused with its own tape \
    \(catches moves that may be beside those of the statement)"
    $ property $
      forAll work $ \w -> not (isTap w)
        ==> forAll (elements (filter (`notElem` files') (controls w)))
        $ \machine ->
          forAll (elements (filter (isSameWork w) (altered w))) $ \other ->
            case ( compiledFor machine (programOf machine w (statement w)),
                   compiledFor machine (programOf machine w other)
                 ) of
              (Right right, Right wrong) ->
                counterexample (Text.unpack other) (isProvenWithin right wrong === False)
              (a, b) -> counterexample (show (void' a, void' b)) False
  it
    "holes made in the order of the list are refused where the statement asks for a short way \
    \(catches a proof that takes the order from the list for works other than drilling)"
    $ property $
      forAll (workAt zigzag) $ \w ->
        forAll (elements (controls w)) $ \machine ->
          let listed = Text.replace "shortest" "" (statement w)
           in case ( compiledFor machine (programOf machine w (statement w)),
                     compiledFor machine (programOf machine w listed)
                   ) of
                (Right right, Right wrong) -> isProven right wrong === False
                (a, b) -> counterexample (show (void' a, void' b)) False
  where
    void' = either Just (const Nothing)
    isSameWork w other = take 1 (Text.words other) == take 1 (Text.words (statement w))
    files' = ["linuxcnc-mill", "haas", "fanuc", "grbl", "marlin"]

-- | A work on holes: the tool, the lines before the statement, the statement, and statements with
-- one other size.
data Work = Work
  { tool :: Text,
    preparation :: [Text],
    statement :: Text,
    altered :: [Text],
    isTap :: Bool
  }
  deriving stock (Show)

-- | The places of holes.
data Places = Places
  { -- | the lines of a table, if the holes are its rows
    tableLines :: [Text],
    -- | the word at, and the expression of the places
    at :: Text,
    -- | the text of a size, which a table changes from row to row
    ofRow :: Double -> Text,
    -- | the setting of the order, or nothing
    order :: Text
  }

-- | Holes whose list leads to and fro.
zigzag :: Places
zigzag = Places [] "at [(30, 0), (10, 0), (20, 0)]" mm "shortest"

-- | Up to three holes, in a list or in the rows of a table.
places :: Gen Places
places = do
  count <- chooseInt (1, 3)
  ps <- vectorOf count ((,) <$> size (-40, 40) <*> size (-40, 40))
  ks <- vectorOf count (elements [0.75, 1, 1.25])
  isTable <- arbitrary
  order <- elements ["", "shortest"]
  let pair (x, y) = "(" <> mm x <> ", " <> mm y <> ")"
      row (x, y) k = Text.unwords [mm x, mm y, mm k]
  pure $
    if isTable
      then
        Places
          { tableLines = ["table holes {", "x y k"] <> zipWith row ps ks <> ["}"],
            at = "at holes",
            ofRow = \d -> mm d <> " mm * k",
            order
          }
      else
        Places
          { tableLines = [],
            at = "at [" <> Text.intercalate ", " (map pair ps) <> "]",
            ofRow = mm,
            order
          }

-- | A block of settings.
block :: [Text] -> Text
block given = " { " <> Text.unwords given <> " }"

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
      "spindle cw 500 rpm"
    ]
    <> Text.unlines (preparation w <> [made])

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
            (framesOf right)
            (map fileText (files (punched wrong)))
     in not (isLeft readAs) && either (const False) (isGood . judged form) readAs
  Nothing -> isGood (provenAs (framesOf right) right wrong)
  where
    judged form = Compile.proveGcode form Nothing right

-- | True if the statements of the first program are proven by the toolpath and the tape of the
-- second one: a compiler that makes these for the first program.
isProvenWithin :: Compiled -> Compiled -> Bool
isProvenWithin right wrong = isGood (provenAs (framesOf wrong) right wrong)

-- | Proof of the first program by the tape of the second one. The planned frames are given.
provenAs :: FrameProgram -> Compiled -> Compiled -> Proof
provenAs planned right wrong =
  FromTape.prove
    (machine right)
    (toolpath right)
    planned
    (map Frame.frame (Frame.plannedFrames (framesOf wrong)))

framesOf :: Compiled -> FrameProgram
framesOf = Compile.program . punched

isGood :: Proof -> Bool
isGood found = null (Proof.findings found) && null (Proof.controlFindings found)

-- | A length in mm with one decimal.
size :: (Int, Int) -> Gen Double
size (low, high) = (/ 10) . fromIntegral <$> chooseInt (10 * low, 10 * high)

mm :: Double -> Text
mm = Decimal.short 4

-- | A random work on one to three holes.
work :: Gen Work
work = places >>= workAt

workAt :: Places -> Gen Work
workAt ps = oneof [drilled ps, pointed ps, reamed ps, circled ps, threaded ps, tapped ps]

drilled :: Places -> Gen Work
drilled ps = do
  d <- size (4, 20)
  p <- size (1, 3)
  rise <- elements [Nothing, Just 0.254, Just 0.6]
  let made deep peck up =
        "drill " <> at ps <> " depth " <> ofRow ps deep
          <> block ["peck " <> mm peck, maybe "" (("chip break " <>) . mm) up, order ps]
  pure
    Work
      { tool = "drill(diameter 5)",
        preparation = tableLines ps,
        statement = made d p rise,
        altered =
          [made (d + 0.4) p rise, made d (p / 2) rise]
            <> [made d p (Just (r + 0.3)) | Just r <- [rise]],
        isTap = False
      }

pointed :: Places -> Gen Work
pointed ps = do
  d <- size (2, 9)
  word <-
    elements
      ["spot " <> at ps <> " diameter ", "countersink " <> at ps <> " angle 90 diameter "]
  let made wide = word <> ofRow ps wide <> block [order ps]
  pure
    Work
      { tool = "drill(diameter 12, angle 90)",
        preparation = tableLines ps,
        statement = made d,
        altered = [made (d + 0.5), made (d - 0.5)],
        isTap = False
      }

reamed :: Places -> Gen Work
reamed ps = do
  d <- size (2, 12)
  let made word deep = word <> " " <> at ps <> " depth " <> ofRow ps deep <> block [order ps]
  pure
    Work
      { tool = "drill(diameter 6)",
        preparation = tableLines ps,
        statement = made "ream" d,
        altered = [made "ream" (d + 0.4), made "drill" d],
        isTap = False
      }

circled :: Places -> Gen Work
circled ps = do
  d <- size (7, 30)
  h <- size (2, 6)
  p <- size (1, 3)
  sense <- elements ["", "conventional"]
  isBore <- arbitrary
  let made wide deep pitch other
        | isBore =
          "bore " <> at ps <> " diameter " <> mm wide <> " depth " <> ofRow ps deep <> " pitch "
            <> mm pitch
            <> block [other, order ps]
        | otherwise =
          "counterbore " <> at ps <> " diameter " <> mm wide <> " depth " <> ofRow ps deep
            <> block ["pitch " <> mm pitch, other, order ps]
  pure
    Work
      { tool = "mill(diameter 6)",
        preparation = tableLines ps,
        statement = made d h p sense,
        altered =
          [ made (d + 0.4) h p sense,
            made d (h + 0.4) p sense,
            made d h (p / 3) sense,
            made d h p (if sense == "" then "conventional" else "")
          ],
        isTap = False
      }

threaded :: Places -> Gen Work
threaded ps = do
  d <- size (6, 20)
  h <- size (2, 8)
  (side, hand) <- (,) <$> elements [" inside", " outside"] <*> elements ["left", "right"]
  let made wide deep which =
        "thread " <> at ps <> " diameter " <> mm wide <> " pitch 1 depth " <> ofRow ps deep <> side
          <> block ["hand " <> which, order ps]
  pure
    Work
      { tool = "threadmill(diameter 4, pitch 1)",
        preparation = tableLines ps,
        statement = made d h hand,
        altered =
          [ made (d + 0.4) h hand,
            made d (h + 0.4) hand,
            made d h (if hand == "left" then "right" else "left")
          ],
        isTap = False
      }

tapped :: Places -> Gen Work
tapped ps = do
  h <- size (4, 12)
  p <- elements [0.8, 1, 1.5]
  let made pitch deep =
        "tap " <> at ps <> " pitch " <> mm pitch <> " depth " <> ofRow ps deep <> block [order ps]
  pure
    Work
      { tool = "tap(diameter 6)",
        preparation = tableLines ps,
        statement = made p h,
        altered = [made (p + 0.2) h, made p (h + 0.4)],
        isTap = True
      }
