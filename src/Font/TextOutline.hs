-- | The outlines of a text: the glyphs of its characters side by side on the x axis.
module Font.TextOutline
  ( TextOutline (..),
    outlines,
  )
where

import Base.Quantity (Mm (..))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (mapMaybe)
import Drawing.Drawing (PathPart (..))
import Font.TrueType (Glyph (..), GlyphContour (..), GlyphCurve (..))
import Geometry.Segment (Segment (Straight))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | A closed outline of a glyph: the index of its character in the text, from 0, and its parts.
data TextOutline = TextOutline {character :: Int, path :: NonEmpty PathPart}
  deriving stock (Eq, Show)

-- | The outlines of glyphs side by side, in the order of the font, in mm. The letters stand on the
-- x axis. @capitals@ is the height of the capitals in units of the font, above 0, and @size@ the
-- same height in mm. The part @share@ of the width of the text, from 0 to 1, lies before x = 0.
--
-- Parts without a length are left out, and so are contours whose points lie on a line: they enclose
-- nothing.
outlines :: Double -> Mm -> Double -> [Glyph] -> [TextOutline]
outlines capitals (Mm size) share glyphs =
  [ TextOutline {character, path}
    | (character, begin, glyph) <- zip3 [0 ..] begins glyphs,
      contour <- glyphContours glyph,
      not (isFlat contour),
      Just path <- [NonEmpty.nonEmpty (partsOf (placed begin) contour)]
  ]
  where
    widths = [advance g + kerning g | g <- glyphs]
    begins = scanl (+) (negate (share * sum widths)) widths
    placed begin p = Vec.point ((begin + Vec.x p) * size / capitals) (Vec.y p * size / capitals)

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
