-- | Engraved texts are proven, and their toolpaths contain every letter.
module Part.EngravingSpec (spec) where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Region (Located (..))
import Base.Result qualified as Result
import Compile (Analysis (..), Compiled (..))
import Compile qualified
import Data.Functor.Identity (runIdentity)
import Data.List (nub)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Font.BuiltIn qualified as BuiltIn
import Font.Font (Letter (strokes))
import Machine.Machine (Machine)
import Machines qualified
import Part.Part qualified as Part
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report qualified as Report
import Surface.Import qualified as Import
import Test.Hspec
import Test.Hspec.QuickCheck (modifyMaxSuccess, prop)
import Test.QuickCheck
import Toolpath.Toolpath qualified as Toolpath
import Verify.Proof qualified as Proof

spec :: Spec
spec = modifyMaxSuccess (const 60) $ do
  prop "random engraved texts are proven (catches a cutter beside the strokes)" $
    forAll ((,) <$> statement 6 <*> elements machines) $ \((_, s), m) ->
      case Compile.compile (Machines.jobFor m []) (loaded s) of
        outcome
          | Just [c] <- Result.ifSound outcome ->
            counterexample (Text.unpack s) (fmap Proof.isProven (proof c) === Just True)
          | otherwise ->
            counterexample (show (s, map Report.title (Result.errors outcome))) (property False)
  prop "the path of a text cuts every letter in its order (catches a letter left out)" $
    forAll (statement 30) $ \(content, s) ->
      case Result.ifSound (Compile.analyse [] (loaded s)) of
        Just Analysis {path} -> lettersOf path === cutLetters content
        Nothing -> counterexample (Text.unpack s) (property False)
  prop "a V-bit may be as near to an edge as its groove is wide (catches the whole tool)" $
    forAll groove $ \g ->
      forAll ((,,) <$> elements [True, False] <*> choose (0.03, 0.5) <*> elements machines) $
        \(isFree, gap, m) ->
          let away = halfWidth g + (if isFree then gap else -min gap (halfWidth g))
              program = loadedWith (tool g) (besideEdge g away)
              outcome = Compile.compile (Machines.jobFor m []) program
              proofs = map (fmap Proof.isProven . proof) <$> Result.ifSound outcome
           in counterexample (show (g, away, map Report.title (Result.errors outcome))) $
                if isFree
                  then proofs === Just [Just True]
                  else counterexample "the groove cuts the edge" (isRefused outcome)
  it "a V-bit that comes from below counts as wide as it then is (catches a cut into the part)" $
    map (isRefused . deepStart) [-4, -2.2, -2, -0.5]
      `shouldBe` [True, True, False, False]
  where
    machines :: [Machine]
    machines = [Machines.iso6983, Machines.named "linuxcnc-mill", Machines.lkp01f]
    isRefused outcome =
      or
        [ "engraving this contour cuts into" `Text.isPrefixOf` Report.title e
          | e <- Result.errors outcome
        ]
    -- The flank is 1.155 mm wider 2 mm above the tip, and the edge 1.25 mm away.
    deepStart z =
      Compile.compile
        (Machines.jobFor Machines.iso6983 [])
        ( loadedFrom
            ("(-1.25, 40, " <> Decimal.short 1 z <> ")")
            "vbit(angle 60, tip 0.1, diameter 6)"
            (besideEdge (Groove "" 0.4 0.28) 5)
        )

-- | A text of at most @most@ letters, and a statement that engraves it.
statement :: Int -> Gen (Text, Text)
statement most = do
  n <- chooseInt (1, most)
  content <- Text.pack <$> vectorOf n (elements written) `suchThat` any (/= ' ')
  h <- oneof [choose (1, 30), elements [1.8, 2.5, 3.5, 5, 7, 10]]
  x <- coordinate
  y <- coordinate
  course <-
    oneof
      [ pure "",
        ("direction " <>) . number <$> choose (0, 360),
        pure ("around circle((0, 0), " <> number (h * fromIntegral (2 * n)) <> ")"),
        pure ("around circle((0, 0), " <> number (h * fromIntegral (2 * n)) <> ") inside")
      ]
  alignment <- elements ["", "align left", "align centre", "align right"]
  depth <- elements ["depth 0.3", "depth 0.4 step 0.15  plunge 30", "depth 0.2  ramp 10"]
  pure
    ( content,
      Text.unwords
        [ "engrave \"" <> content <> "\" at (" <> x <> ", " <> y <> ") height " <> number h,
          course,
          alignment,
          "{ " <> depth <> " }"
        ]
    )
  where
    number = Decimal.short 2
    coordinate = number <$> choose (1, 300)
    written = filter (/= '"') (Map.keys BuiltIn.letters)

-- | A V-bit and the depth of its groove. Lengths are in mm.
data Groove = Groove
  { tool :: Text,
    deep :: Double,
    -- | half of the width at the top of the part
    halfWidth :: Double
  }
  deriving stock (Show)

-- | A random groove, as deep as the flank is high or less.
groove :: Gen Groove
groove = do
  narrow <- hundredths (0, 100)
  half <- fromIntegral <$> chooseInt (10, 60)
  deep <- hundredths (20, 200)
  higher <- hundredths (1, 500)
  let halfWidth = narrow / 2 + deep * tan (half * pi / 180)
      sizes = [2 * half, narrow, 2 * (halfWidth + higher)]
      given = zip ["angle ", "tip ", "diameter "] sizes
      words' = [word <> Decimal.short 2 x | (word, x) <- given]
  pure Groove {tool = "vbit(" <> Text.intercalate ", " words' <> ")", deep, halfWidth}
  where
    hundredths range = (/ 100) . fromIntegral <$> chooseInt range

-- | Statements that engrave an upright stroke to the right of the left edge of a part, and mill
-- this edge with another tool.
besideEdge :: Groove -> Double -> Text
besideEdge g away =
  Text.unlines
    [ "engrave \"|\" at (" <> number away <> ", 40) height 8 align centre {",
      "  depth " <> number (deep g) <> " step " <> number (deep g / 2),
      "}",
      "change 2 mill(diameter 3)",
      "spindle cw 900",
      "contour edge closed { (0, 0) (0, 100) (100, 100) (100, 0) }",
      "mill edge outside { depth 3 }"
    ]
  where
    number = Decimal.short 6

-- | A program with this statement.
loaded :: Text -> LoadedProgram
loaded = loadedWith "mill(diameter 0.5)"

-- | A program with this first tool and these statements.
loadedWith :: Text -> Text -> LoadedProgram
loadedWith = loadedFrom "(0, 0, 2)"

-- | A program with this start, this first tool and these statements.
loadedFrom :: Text -> Text -> Text -> LoadedProgram
loadedFrom begin first s =
  runIdentity (LoadedProgram.load nothing "t.part" whole)
  where
    nothing = Import.byName (const (pure (Left "it imports nothing")))
    whole =
      Text.unlines
        [ "part t",
          "tool 1 " <> first,
          "feed 60",
          "tolerance 0.01",
          "clearance 2",
          "from " <> begin,
          "work 54",
          "safe 20",
          "spindle cw 900",
          s
        ]

-- | The letters along which a toolpath cuts, each as often as it has strokes.
lettersOf :: Toolpath.Toolpath -> [Text]
lettersOf path =
  [ name
    | (_, Name name) <-
        nub
          [ (Toolpath.number pass, value (Part.contourName (Part.contour (value job))))
            | Toolpath.Cutting {Toolpath.job, Toolpath.pass} <- Toolpath.blocks path
          ]
  ]

cutLetters :: Text -> [Text]
cutLetters content =
  concat
    [ replicate (maybe 0 (length . strokes) (Map.lookup c BuiltIn.letters)) (Text.singleton c)
      | c <- Text.unpack content
    ]
