-- | Outlines of texts, with laws on random glyphs, and with the fonts of @test/data/fonts@.
module Font.TextOutlineSpec
  ( spec,
  )
where

import Base.Quantity (Mm (..))
import Control.Monad (forM_)
import Data.Aeson (encode, object, (.=))
import Data.Aeson qualified as Aeson
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.ByteString.Lazy qualified as Lazy
import Data.Either (isLeft)
import Data.List (sortOn)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (catMaybes, fromMaybe)
import Data.Semigroup (sconcat)
import Data.Text (Text)
import Data.Text qualified as Text
import Drawing.Drawing (PathPart (..))
import Drawing.PathPart qualified as PathPart
import Font.TextOutline (GlyphPlace (..))
import Font.TextOutline qualified as TextOutline
import Font.TrueType
import Geometry.Polyarc (Ends (Closed), Polyarc (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import PythonJudge qualified
import System.Directory (doesFileExist, makeAbsolute)
import System.FilePath ((</>))
import System.IO.Temp (withSystemTempDirectory)
import Test.Hspec
import Test.Hspec.QuickCheck (prop)
import Test.QuickCheck hiding (within)

spec :: Spec
spec = do
  prop "outlines have the area of the polynomials of their glyphs (catches a wrong scale upwards)" $
    forAll (scale (min 4) (listOf1 glyph)) $ \gs ->
      forAll ((,) <$> choose (1, 50) <*> choose (0, 1)) $ \(size, share) ->
        let k = size / 700
            expected = k * k * sum [areaOf c | g <- gs, c <- glyphContours g]
            found = sum (map (signedArea . snd) (placed 700 size share gs))
         in counterexample (show (found, expected)) $
              abs (found - expected) <= 1e-4 * k * k * sum [boxOf c | g <- gs, c <- glyphContours g]
                + 1e-4 * size
  describe "the fonts of the tests" $ do
    forM_ [("quadratic.ttf", 700), ("cubic.otf", 700)] $ \(file, capitals) ->
      it (file <> " has its height, its widths and its kerning") $ do
        font <- ByteString.readFile (fonts </> file)
        Right run <- glyphs font "AV HOж"
        capitalHeight run `shouldBe` Just capitals
        map (fmap advance) (characterGlyphs run)
          `shouldBe` [Just 600, Just 600, Just 350, Just 600, Just 640, Nothing]
        map (fmap kerning) (characterGlyphs run)
          `shouldBe` [Just (-90), Just 0, Just 0, Just 15, Just 0, Nothing]
    it "the middle between two control points is not rounded" $ do
      font <- ByteString.readFile (fonts </> "quadratic.ttf")
      Right run <- glyphs font "O"
      let contours = [c | Just g <- characterGlyphs run, c <- glyphContours g]
          ends = [q | GlyphContour _ cs <- contours, QuadraticTo _ q <- cs]
      ends `shouldContain` [Vec.point 510.5 604]
    it "contours that enclose nothing and curves without a length are left out" $ do
      Right outlines <- outlinesIn "cubic.otf" 7 0 "I"
      map (NonEmpty.length . snd) outlines `shouldBe` [4, 2]
    it "equal letters share their outlines" $ do
      font <- ByteString.readFile (fonts </> "quadratic.ttf")
      Right run <- glyphs font "OHO O"
      let found = TextOutline.shapes 700 (Mm 7) 0 (catMaybes (characterGlyphs run))
      map (map character . NonEmpty.toList . fst) found `shouldBe` [[0, 2, 4], [1]]
    it "every beginning of a font gives glyphs or a fault" $
      forM_ ["quadratic.ttf", "cubic.otf"] $ \file -> do
        font <- ByteString.readFile (fonts </> file)
        answers <-
          mapM (\n -> glyphs (ByteString.take n font) "AVO@") [0 .. ByteString.length font]
        length (filter isLeft answers) `shouldSatisfy` (> 100)
        sum (map sizeOf answers) `shouldSatisfy` (> 0)
    it "a file that is no font, and a text that is too long, are refused" $ do
      font <- ByteString.readFile (fonts </> "cubic.otf")
      glyphs "%PDF-1.4" "A" `shouldReturn` Left NoFont
      glyphs (font <> ByteString.replicate mostBytes 0) "A" `shouldReturn` Left TooMuch
      glyphs font (Text.replicate (mostCharacters + 1) "A") `shouldReturn` Left TooMuch
  describe "fontTools agrees about every point" $ do
    forM_ ["quadratic.ttf", "cubic.otf"] $ \file ->
      it file (judged (fonts </> file) "AVAHOC+@NФ X8I HO")
    forM_ installed $ \(package, file) ->
      it file $ do
        exists <- doesFileExist file
        if exists
          then judged file "ЗАВОД 12 Щёголь, AVATAR To &%@®ÅÖ"
          else pendingWith ("not installed: " <> package)
  where
    installed =
      [ ("fonts-dejavu-core", "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"),
        ("fonts-dejavu-core", "/usr/share/fonts/truetype/dejavu/DejaVuSerif-Bold.ttf")
      ]
    sizeOf answer = case answer of
      Right run -> length (catMaybes (characterGlyphs run))
      Left _ -> 0

-- | The index of a character, and an outline of it.
type PlacedOutline = (Int, NonEmpty PathPart)

fonts :: FilePath
fonts = "test/data/fonts"

-- | Outlines of a text in a font of the tests, for a height of the capitals in mm.
outlinesIn :: FilePath -> Double -> Double -> Text -> IO (Either FontFault [PlacedOutline])
outlinesIn file size share text =
  outlinesOf size share text =<< ByteString.readFile (fonts </> file)

outlinesOf :: Double -> Double -> Text -> ByteString -> IO (Either FontFault [PlacedOutline])
outlinesOf size share text font = fmap outlinesFrom <$> glyphs font text
  where
    outlinesFrom run =
      let height = fromMaybe 0 (capitalHeight run)
       in placed height size share (catMaybes (characterGlyphs run))

-- | The outlines of glyphs at their places, in the order of the text.
placed :: Double -> Double -> Double -> [Glyph] -> [PlacedOutline]
placed height size share gs =
  sortOn
    fst
    [ (character letter, fmap (movedBy (begin letter)) path)
      | (letters, outlines) <- TextOutline.shapes height (Mm size) share gs,
        letter <- NonEmpty.toList letters,
        path <- NonEmpty.toList outlines
    ]
  where
    movedBy (Mm x) part = case part of
      Plain s -> Plain (Transformation.segment (Transformation.translation (Vec.vec x 0)) s)
      Bezier controls ws -> Bezier (fmap (Vec.shift (Vec.vec x 0)) controls) ws
      other -> other

-- | The expectation that fontTools gives the same points for a text in a font.
judged :: FilePath -> Text -> Expectation
judged file text = do
  font <- ByteString.readFile file
  answer <- outlinesOf 8 0.5 text font
  case answer of
    Left fault -> expectationFailure (show fault)
    Right outlines -> withSystemTempDirectory "partc" $ \folder -> do
      whole <- makeAbsolute file
      Lazy.writeFile (folder </> "outlines.json") (encode (described whole outlines))
      PythonJudge.agrees
        "test/fonts/judge.py"
        [("fontTools", "python3-fonttools")]
        [folder </> "outlines.json"]
  where
    described whole outlines =
      object
        [ "font" .= whole,
          "text" .= text,
          "height" .= (8 :: Double),
          "share" .= (0.5 :: Double),
          "outlines"
            .= [ object ["character" .= k, "parts" .= fmap pointsOf path]
                 | (k, path) <- outlines
               ]
        ]
    pointsOf p = case p of
      Bezier controls _ -> map pair (NonEmpty.toList controls)
      _ -> [pair (PathPart.start p), pair (PathPart.end p)]
    pair q = Aeson.toJSON (Vec.x q, Vec.y q)

-- Areas -------------------------------------------------------------------------------------------

-- | The area of an outline, positive counter-clockwise.
signedArea :: NonEmpty PathPart -> Double
signedArea path = Polyarc.signedArea (Polyarc Closed (sconcat (fmap PathPart.segments path)))

-- | The area of a contour of a glyph from the polynomials of its curves: the integral of
-- (x dy - y dx) / 2, where a Bézier curve is a sum of Bernstein polynomials.
areaOf :: GlyphContour -> Double
areaOf (GlyphContour begin curves) = sum (zipWith area starts curves)
  where
    starts = scanl (\_ c -> last (pointsFrom begin c)) begin curves
    area p c = weighted (pointsFrom p c) / 2

pointsFrom :: Point -> GlyphCurve -> [Point]
pointsFrom p c = case c of
  LineTo q -> [p, q]
  QuadraticTo a q -> [p, a, q]
  CubicTo a b q -> [p, a, b, q]

-- | The integral of x dy - y dx along a Bézier curve. For its control points p and their indices i
-- and j, the integral of the product of a Bernstein polynomial of degree n and one of degree n - 1
-- is a quotient of binomial coefficients.
weighted :: [Point] -> Double
weighted ps =
  sum
    [ Vec.x p * (Vec.y r - Vec.y q) * w - Vec.y p * (Vec.x r - Vec.x q) * w
      | (i, p) <- zip [0 ..] ps,
        (j, q, r) <- zip3 [0 ..] ps (drop 1 ps),
        let w =
              fromIntegral (choices n i * choices (n - 1) j)
                / (2 * fromIntegral (choices (2 * n - 1) (i + j)))
    ]
  where
    n = length ps - 1

-- | The binomial coefficient.
choices :: Int -> Int -> Int
choices n k = product [n - k + 1 .. n] `div` product [1 .. k]

-- | The area of a square around a contour.
boxOf :: GlyphContour -> Double
boxOf (GlyphContour begin curves) = let d = maximum xs - minimum xs in d * d
  where
    xs = concat [[Vec.x p, Vec.y p] | p <- begin : concatMap (pointsFrom begin) curves]

-- | A glyph with one contour around its middle.
glyph :: Gen Glyph
glyph = do
  count <- choose (3, 8)
  curves <- mapM (curveTo count) [1 .. count]
  start <- near count 0
  advance <- fromIntegral <$> choose (100, 900 :: Int)
  kerning <- fromIntegral <$> choose (-100, 100 :: Int)
  pure Glyph {advance, kerning, glyphContours = [closed start curves]}
  where
    closed start curves = GlyphContour start (init curves <> [toStart start (last curves)])
    toStart start c = case c of
      LineTo _ -> LineTo start
      QuadraticTo a _ -> QuadraticTo a start
      CubicTo a b _ -> CubicTo a b start
    curveTo :: Int -> Int -> Gen GlyphCurve
    curveTo count k =
      oneof
        [ LineTo <$> near count (fromIntegral k),
          QuadraticTo <$> near count (fromIntegral k - 0.5) <*> near count (fromIntegral k),
          CubicTo
            <$> near count (fromIntegral k - 0.7)
              <*> near count (fromIntegral k - 0.3)
              <*> near count (fromIntegral k)
        ]
    near :: Int -> Double -> Gen Point
    near count k = do
      r <- choose (200, 400)
      let a = 2 * pi * k / fromIntegral count
      pure (Vec.point (whole (300 + r * cos a)) (whole (300 + r * sin a)))
    whole v = fromIntegral (round v :: Int) :: Double
