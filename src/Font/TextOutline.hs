-- | The outlines of a text: the glyphs of its characters side by side on the x axis. Letters that
-- have equal glyphs share their outlines.
module Font.TextOutline
  ( GlyphPlace (..),
    shapes,
    GlyphName (..),
    LetterShape (..),
    FilledOutlines,
    capitals,
  )
where

import Base.Quantity (Mm (..), times)
import Base.Region (Located)
import Data.List (partition)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (mapMaybe)
import Drawing.Drawing (PathPart (..))
import Font.TrueType (Glyph (..), GlyphContour (..), GlyphCurve (..))
import Geometry.Segment (Segment (Straight))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The place of a glyph in a text: the index of its character, from 0, and the x coordinate of its
-- origin.
data GlyphPlace = GlyphPlace {character :: Int, begin :: Mm}
  deriving stock (Eq, Show)

-- | The height of the capitals for which the outlines of a text are laid out.
capitals :: Mm
capitals = Mm 10

-- | The letters of glyphs side by side, in mm, and their closed outlines about the origin of the
-- glyph. The letters stand on the x axis. @high@ is the height of the capitals in units of the
-- font, above 0, and @size@ the same height in mm. The part @share@ of the width of the text, from
-- 0 to 1, lies before x = 0.
--
-- Letters with equal outlines are together. Letters without outlines are left out, and so are parts
-- without a length, and contours whose points lie on a line: they enclose nothing.
shapes :: Double -> Mm -> Double -> [Glyph] -> [(NonEmpty GlyphPlace, NonEmpty (NonEmpty PathPart))]
shapes high size share glyphs =
  [ (letters, outlines)
    | (contours, letters) <- grouped (zip (map glyphContours glyphs) placed),
      Just outlines <- [NonEmpty.nonEmpty (mapMaybe outlineOf (filter (not . isFlat) contours))]
  ]
  where
    widths = [advance g + kerning g | g <- glyphs]
    begins = scanl (+) (negate (share * sum widths)) widths
    placed = zipWith GlyphPlace [0 ..] (map inMm begins)
    inMm v = times (v / high) size
    outlineOf = NonEmpty.nonEmpty . partsOf scaled
    scaled p =
      let (Mm x, Mm y) = (inMm (Vec.x p), inMm (Vec.y p)) in Vec.point x y

-- | The values of equal keys together, in the order of the first ones.
grouped :: Eq k => [(k, v)] -> [(k, NonEmpty v)]
grouped list = case list of
  [] -> []
  (k, v) : more ->
    let (same, others) = partition ((== k) . fst) more
     in (k, v :| map snd same) : grouped others

-- | The path of a font, and a character of it.
data GlyphName = GlyphName FilePath Char
  deriving stock (Eq, Ord, Show)

-- | Closed outlines in mm about the origin of a glyph, for capitals of the height 'capitals', each
-- with its depth. Outlines of an even depth add what is inside at least one of them, those of an
-- odd depth take it away from what the lower depths have given. At least one has the depth 0.
type FilledOutlines = NonEmpty (NonEmpty PathPart, Int)

-- | The outlines of equal letters of a text in a font.
data LetterShape = LetterShape
  { shapeGlyph :: GlyphName,
    -- | the regions of these letters, and the x coordinate of the origin of each
    shapeLetters :: NonEmpty (Located Mm),
    shapeOutlines :: FilledOutlines
  }
  deriving stock (Eq, Show)

-- | True if all points of a contour lie on one line.
isFlat :: GlyphContour -> Bool
isFlat (GlyphContour begin curves) = case filter (/= begin) (concatMap pointsOf curves) of
  [] -> True
  p : ps -> all (\q -> Vec.cross (Vec.to begin p) (Vec.to begin q) == 0) ps

pointsOf :: GlyphCurve -> [Point]
pointsOf curve = case curve of
  LineTo q -> [q]
  QuadraticTo c q -> [c, q]
  CubicTo c d q -> [c, d, q]

-- | The parts of a contour, each point of which the function @place@ places.
partsOf :: (Point -> Point) -> GlyphContour -> [PathPart]
partsOf place (GlyphContour begin curves) = mapMaybe part (zip starts curves)
  where
    starts = scanl (\_ c -> last (begin : pointsOf c)) begin curves
    part (p, curve) = case curve of
      _ | all (== p) (pointsOf curve) -> Nothing
      LineTo q -> Just (straight p q)
      QuadraticTo c q
        | all (isBetween p q) [c] -> Just (straight p q)
        | otherwise -> Just (Bezier (fmap place (p :| [c, q])) Nothing)
      CubicTo c d q
        | all (isBetween p q) [c, d] -> Just (straight p q)
        | otherwise -> Just (Bezier (fmap place (p :| [c, d, q])) Nothing)
    straight p q = Plain (Straight (place p) (place q))

-- | True for a point on the line from @p@ to @q@, its ends included.
isBetween :: Point -> Point -> Point -> Bool
isBetween p q c =
  Vec.cross (Vec.to p q) (Vec.to p c) == 0
    && Vec.dot (Vec.to p c) (Vec.to c q) >= 0
