-- | The last check of a shape in mm: it lies within reach, and its numbers make a curve.
module Drawing.ShapeCheck
  ( Judgement (..),
    judge,
    size,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Drawing.Drawing (Ellipse (..), PathPart (..), Shape (..), Spline (..))
import Drawing.Tolerance qualified as Tolerance
import Geometry.Carrier (Circle (Circle))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance (reach)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The judgement of a shape.
data Judgement
  = -- | the shape without parts of length 0, and with lines in place of arcs that are flat
    Usable Shape
  | -- | the reason why the shape is no curve
    Degenerate Text
  | -- | a number is larger than 'reach', or not finite
    TooFar

-- | Judges a shape in mm.
judge :: Shape -> Judgement
judge shape = case shape of
  Dot p -> if isNear p then Usable shape else TooFar
  FullCircle (Circle c r)
    | not (isNear c && isWithin r) -> TooFar
    | r <= Mm 0 -> Degenerate "its radius is 0"
    | otherwise -> Usable shape
  FullEllipse e
    | not (isNearEllipse e) -> TooFar
    | minor e <= Mm 0 -> Degenerate "a semi-axis is 0"
    | otherwise -> Usable shape
  Path ends parts
    | not (all isNearPiece straightened) -> TooFar
    | any isCollapsed straightened -> Degenerate "a semi-axis is 0"
    | otherwise -> case NonEmpty.filter (not . isPoint) straightened of
      first : rest -> Usable (Path ends (first :| rest))
      [] -> Degenerate "its length is 0"
    where
      straightened = fmap withoutFlatArc parts

-- | The count of the points that a shape is made of, at least 1.
size :: Shape -> Int
size shape = case shape of
  Dot _ -> 1
  FullCircle _ -> 1
  FullEllipse _ -> 1
  Path _ parts -> sum (fmap ofPiece parts)
  where
    ofPiece part = case part of
      Plain _ -> 1
      EllipseArc {} -> 1
      Bezier points _ -> length points
      BSpline s -> length (controls s)

-- | The line between the ends of an arc that is as good as a line and whose radius is out of reach.
withoutFlatArc :: PathPart -> PathPart
withoutFlatArc part = case part of
  Plain segment@Arc {start, end, centre}
    | not (isWithin (Segment.radius centre start)),
      sagittaOf segment <= Tolerance.flatArc ->
      Plain (Straight start end)
  _ -> part

-- | The sagitta of an arc from its chord and its sweep, since the centre of a flat arc is inexact:
-- @tan(sweep/4)·chord/2@.
sagittaOf :: Segment -> Mm
sagittaOf segment = Mm (abs (Segment.bulge segment) * chord / 2)
  where
    Mm chord = Vec.distance (start segment) (end segment)

isNearPiece :: PathPart -> Bool
isNearPiece part = case part of
  Plain (Straight a b) -> isNear a && isNear b
  Plain Arc {start, end, centre, sweep = Rad s} ->
    isNear start && isNear end && isNear centre
      && isWithin (Segment.radius centre start)
      && abs s <= 2 * pi
  EllipseArc e from to -> isNearEllipse e && abs (to - from) <= 2 * pi
  Bezier points _ -> all isNear points
  BSpline s -> all isNear (controls s)

-- | True of a part that is a point.
isPoint :: PathPart -> Bool
isPoint part = case part of
  Plain (Straight a b) -> a == b
  Plain Arc {start, centre, sweep} -> start == centre || sweep == Rad 0
  EllipseArc _ from to -> from == to
  Bezier (first :| rest) _ -> all (== first) rest
  BSpline s -> let first :| rest = controls s in all (== first) rest

-- | True of a part of an ellipse that is flattened to a line.
isCollapsed :: PathPart -> Bool
isCollapsed part = case part of
  EllipseArc e from to -> from /= to && minor e <= Mm 0
  _ -> False

isNearEllipse :: Ellipse -> Bool
isNearEllipse e = isNear (middle e) && isWithin (major e)

isNear :: Point -> Bool
isNear p = isWithin (Mm (Vec.x p)) && isWithin (Mm (Vec.y p))

-- | True of a finite length within reach; false of NaN.
isWithin :: Mm -> Bool
isWithin (Mm length') = let Mm limit = reach in abs length' <= limit
