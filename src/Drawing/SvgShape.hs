-- | The basic shapes of SVG and its paths, in user units with y downwards (SVG 1.1, chapters 8
-- and 9).
module Drawing.SvgShape
  ( figures,
  )
where

import Base.Quantity (Mm (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Drawing.Drawing (PathPart (..), Shape (..))
import Drawing.Ellipse qualified as Ellipse
import Drawing.Error (DrawingFault (..), Error (Error))
import Drawing.SvgLength (Direction (..), Viewport)
import Drawing.SvgLength qualified as SvgLength
import Drawing.SvgNumber (numbers)
import Drawing.SvgPath qualified as SvgPath
import Drawing.XmlElement (XmlElement (line), attribute, nameOf)
import Geometry.Carrier (Circle (Circle))
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The shapes of an element in a viewport: several for a path of several subpaths. The reason in
-- the inner 'Left' if it has none. Nothing for an element that is not drawn as a curve.
figures :: XmlElement -> Maybe (Viewport -> Either Error (Either Text [Shape]))
figures element = case nameOf element of
  "path" -> constant (path element)
  "polyline" -> constant (polyline Open element)
  "polygon" -> constant (polyline Closed element)
  "line" -> Just (line' element)
  "rect" -> Just (rectangle element)
  "circle" -> Just (circle element)
  "ellipse" -> Just (ellipse element)
  _ -> Nothing
  where
    -- the data are read once, however often the element is used
    constant shapes = Just (const shapes)

path :: XmlElement -> Either Error (Either Text [Shape])
path element = case SvgPath.fromText <$> attribute "d" element of
  Just (Left text) -> Left (wrong element "d" text)
  Just (Right shapes@(_ : _)) -> Right (Right shapes)
  _ -> Right (Left "it has no curve")

polyline :: Ends -> XmlElement -> Either Error (Either Text [Shape])
polyline ends element = case numbers (fromMaybe "" (attribute "points" element)) of
  Left text -> Left (wrong element "points" text)
  Right xs -> case paired xs of
    Nothing -> Left (wrong element "points" "the last number")
    Just vertices@(first : rest@(_ : _)) ->
      let isBack = ends == Closed && last rest /= first
          around = vertices <> [first | isBack]
          isClosed = ends == Closed || last rest == first
       in Right (Right [chain (if isClosed then Closed else Open) around])
    Just _ -> Right (Left "it has fewer than two points")
  where
    paired xs = case xs of
      [] -> Just []
      [_] -> Nothing
      x : y : rest -> (Vec.point x y :) <$> paired rest

-- | The path of the lines between points, of which there are at least two.
chain :: Ends -> [Point] -> Shape
chain ends points =
  Path ends . NonEmpty.fromList $ [Plain (Straight a b) | (a, b) <- zip points (drop 1 points)]

line' :: XmlElement -> Viewport -> Either Error (Either Text [Shape])
line' element viewport = do
  a <- Vec.point <$> at Horizontal "x1" <*> at Vertical "y1"
  b <- Vec.point <$> at Horizontal "x2" <*> at Vertical "y2"
  Right (Right [chain Open [a, b]])
  where
    at direction name = SvgLength.givenOr 0 viewport direction name element

circle :: XmlElement -> Viewport -> Either Error (Either Text [Shape])
circle element viewport = do
  c <- Vec.point <$> at Horizontal "cx" <*> at Vertical "cy"
  r <- at Oblique "r"
  Right $ if r > 0 then Right [FullCircle (Circle c (Mm r))] else Left "its radius is not positive"
  where
    at direction name = SvgLength.givenOr 0 viewport direction name element

ellipse :: XmlElement -> Viewport -> Either Error (Either Text [Shape])
ellipse element viewport = do
  c <- Vec.point <$> at Horizontal "cx" <*> at Vertical "cy"
  (rx, ry) <- radii element viewport
  Right $
    if rx > 0 && ry > 0
      then Right [Ellipse.whole c (Vec.vec rx 0) (Vec.vec 0 ry)]
      else Left "a radius is not positive"
  where
    at direction name = SvgLength.givenOr 0 viewport direction name element

-- | The radii rx and ry. If only one is given, both are equal.
radii :: XmlElement -> Viewport -> Either Error (Double, Double)
radii element viewport = do
  rx <- SvgLength.given viewport Horizontal "rx" element
  ry <- SvgLength.given viewport Vertical "ry" element
  Right $ case (rx, ry) of
    (Just a, Just b) -> (a, b)
    (Just a, Nothing) -> (a, a)
    (Nothing, Just b) -> (b, b)
    (Nothing, Nothing) -> (0, 0)

-- | A rectangle, which may have rounded corners. The radii are at most half of the sides.
rectangle :: XmlElement -> Viewport -> Either Error (Either Text [Shape])
rectangle element viewport = do
  corner <- (,) <$> at Horizontal "x" <*> at Vertical "y"
  width <- at Horizontal "width"
  height <- at Vertical "height"
  (rx, ry) <- radii element viewport
  Right $
    if width > 0 && height > 0
      then Right [rounded corner (width, height) (min rx (width / 2), min ry (height / 2))]
      else Left "its width or its height is not positive"
  where
    at direction name = SvgLength.givenOr 0 viewport direction name element

-- | A rectangle from the end of its first corner on, in the direction from x to y.
rounded :: (Double, Double) -> (Double, Double) -> (Double, Double) -> Shape
rounded (x, y) (width, height) (rx, ry)
  | rx <= 0 || ry <= 0 = chain Closed [p x y, p right y, p right below, p x below, p x y]
  | otherwise =
    Path Closed . NonEmpty.fromList $
      [ side (p (x + rx) y) (p (right - rx) y),
        corner (p (right - rx) y, p right (y + ry)) (p (right - rx) (y + ry)) (negate quarter),
        side (p right (y + ry)) (p right (below - ry)),
        corner (p right (below - ry), p (right - rx) below) (p (right - rx) (below - ry)) 0,
        side (p (right - rx) below) (p (x + rx) below),
        corner (p (x + rx) below, p x (below - ry)) (p (x + rx) (below - ry)) quarter,
        side (p x (below - ry)) (p x (y + ry)),
        corner (p x (y + ry), p (x + rx) y) (p (x + rx) (y + ry)) (2 * quarter)
      ]
  where
    p = Vec.point
    (right, below) = (x + width, y + height)
    quarter = pi / 2
    side a b = Plain (Straight a b)
    corner ends centre from =
      SvgPath.arcPiece ends centre (Vec.vec rx 0, Vec.vec 0 ry) from (from + quarter)

wrong :: XmlElement -> Text -> Text -> Error
wrong element name text = Error (line element) (WrongAttribute (nameOf element) name text)
