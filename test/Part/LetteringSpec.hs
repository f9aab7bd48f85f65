-- | Texts in a font at their places in the part.
module Part.LetteringSpec (spec) where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (Mm (..), Rad (..))
import Base.Region (Located (..))
import Base.Result qualified as Result
import Compile (Analysis (Analysis, part))
import Compile qualified
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (catMaybes)
import Data.Text (Text)
import Data.Text qualified as Text
import Drawing.PathPart qualified as PathPart
import Font.TextOutline (GlyphPlace (..))
import Font.TextOutline qualified as TextOutline
import Font.TrueType (FontFault, Glyph (..), GlyphContour (..), GlyphCurve (..), GlyphRun (..))
import Font.TrueType qualified as TrueType
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part qualified as Part
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report qualified as Report
import Surface.Import qualified as Import
import Test.Hspec
import Test.Hspec.QuickCheck (modifyMaxSuccess, prop)
import Test.QuickCheck

spec :: Spec
spec = modifyMaxSuccess (const 60) $ do
  font <- runIO (ByteString.readFile "test/data/fonts/quadratic.ttf")
  prop "letters stand at their point, turned and scaled (catches letters turned the other way)" $
    forAll (Text.pack <$> scale (min 6) (listOf1 (elements "HOAVC+Ф"))) $ \text ->
      forAll ((,) <$> hundredths 1 40 <*> hundredths 0 360) $ \(size, turned) ->
        forAll ((,) <$> hundredths (-50) 50 <*> hundredths (-50) 50) $ \p ->
          forAll (elements [("", 0), ("align centre", 0.5), ("align right", 1)]) $ \(word, share) ->
            let statement = statementOf text size turned p word
             in counterexample (Text.unpack statement) . ioProperty $ do
                  outcome <- Compile.analyse [] <$> loaded font statement
                  expected <- placed font text size turned p share
                  pure $ case Result.ifSound outcome of
                    Just Analysis {part} ->
                      conjoin
                        [counterexample (show q) (any (isNear q) (startsIn part)) | q <- expected]
                    Nothing ->
                      counterexample (show (map Report.title (Result.errors outcome))) False
  it "letters that overlap are joined" $ do
    program <-
      loadedBy
        (const (Right overlapping))
        "contours sign from \"own.ttf\" text \"HH\" at (0, 0) height 7"
    let outcome = Compile.analyse [] program
    map Report.title (Result.errors outcome) `shouldBe` []
    map (Polyarc.signedArea . Part.polyarcOf) (regionOf outcome) `shouldBe` [56]
  where
    hundredths :: Int -> Int -> Gen Double
    hundredths low high = (/ 100) . fromIntegral <$> chooseInt (100 * low, 100 * high)
    isNear a b = Vec.distance a b <= Mm 1e-9
    regionOf outcome =
      [ c
        | Just Analysis {part} <- [Result.ifSound outcome],
          c <- Part.contours part,
          value (Part.contourName c) == Name "sign"
      ]

-- | A run of two letters, each a square of 5 mm by 7 mm, the second one 3 mm behind the first one.
overlapping :: GlyphRun
overlapping = GlyphRun {capitalHeight = Just 700, characterGlyphs = [Just glyph, Just glyph]}
  where
    glyph = Glyph {advance = 300, kerning = 0, glyphContours = [square]}
    square =
      GlyphContour (corner 0 0) (map (LineTo . uncurry corner) [(5, 0), (5, 7), (0, 7), (0, 0)])
    corner x y = Vec.point (100 * x) (100 * y)

-- | The statement for a text, a height, a direction in degrees, a point and an alignment.
statementOf :: Text -> Double -> Double -> (Double, Double) -> Text -> Text
statementOf text size turned (x, y) word =
  Text.unwords
    [ "contours sign from \"quadratic.ttf\" text \"" <> text <> "\" at",
      "(" <> number x <> ", " <> number y <> ") height " <> number size,
      "direction " <> number turned,
      word
    ]
  where
    number = Decimal.short 2

-- | The points at which parts of the outlines of a text begin.
placed :: ByteString -> Text -> Double -> Double -> (Double, Double) -> Double -> IO [Point]
placed font text size turned (x, y) share = either (const []) starts <$> TrueType.glyphs font text
  where
    starts run =
      [ Vec.shift (Vec.rotate (Rad (turned * pi / 180)) (Vec.to (Vec.point 0 0) q)) (Vec.point x y)
        | (letters, outlines) <-
            TextOutline.shapes 700 (Mm size) share (catMaybes (characterGlyphs run)),
          Mm far <- map begin (NonEmpty.toList letters),
          p <- map PathPart.start (concatMap NonEmpty.toList outlines),
          let q = Vec.shift (Vec.vec far 0) p
      ]

-- | The points at which the segments of the contours of the text begin.
startsIn :: Part.Part -> [Point]
startsIn part =
  [ Segment.start (Part.segment e)
    | c <- Part.contours part,
      let Name name = value (Part.contourName c),
      "sign " `Text.isPrefixOf` name,
      e <- NonEmpty.toList (Part.elements c)
  ]

-- | A program with a statement, beside a font.
loaded :: ByteString -> Text -> IO LoadedProgram
loaded font statement = loadedFrom (fmap Right . TrueType.glyphs font) statement

-- | A program with a statement, beside a font that gives these glyphs for a text.
loadedBy :: (Text -> Either FontFault GlyphRun) -> Text -> IO LoadedProgram
loadedBy glyphsOf = loadedFrom (pure . Right . glyphsOf)

loadedFrom :: (Text -> IO (Either Text (Either FontFault GlyphRun))) -> Text -> IO LoadedProgram
loadedFrom glyphsOf statement = LoadedProgram.load reader "t.part" whole
  where
    reader =
      (Import.byName (const (pure (Left "it imports nothing"))))
        { Import.glyphs = const glyphsOf
        }
    whole =
      Text.unlines
        [ "part t",
          "tool 1 mill(diameter 0.5)",
          "feed 60",
          "tolerance 0.01",
          "clearance 2",
          "from (0, 0, 2)",
          "spindle cw 900",
          statement,
          "engrave \"I\" at (0, 0) height 5 { depth 0.3 }"
        ]
