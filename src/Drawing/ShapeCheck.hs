-- | The last check of a shape in mm: it lies within reach, and its numbers make a curve.
module Drawing.ShapeCheck
  ( Judgement (..),
    judge,
    size,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.Foldable (toList)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Drawing.Drawing (Ellipse (..), PathPart (..), Shape (..), Spline (..))
import Drawing.OutlineTolerance qualified as OutlineTolerance
import Drawing.PathPart qualified as PathPart
import Drawing.Tolerance qualified as Tolerance
import Geometry.Carrier (Circle (Circle))
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance (reach)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The judgement of a shape.
data Judgement
  = -- | the shape without parts that count as points, and with lines in place of arcs that are flat
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
    | otherwise -> maybe (Degenerate "its length is 0") Usable (withoutPoints ends straightened)
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

-- | The path without the parts that stay within 'OutlineTolerance.same' of the end of the part
-- before them. The sums of relative coordinates leave such parts, as a line by which a path returns
-- to its start. The parts beside one that is left out are moved so that they meet. A path whose
-- ends are that near to each other is closed. Nothing if no part is left.
withoutPoints :: Ends -> NonEmpty PathPart -> Maybe Shape
withoutPoints ends parts = case longer (PathPart.start (NonEmpty.head parts)) (toList parts) of
  [] -> Nothing
  first : rest
    | length rest + 1 == length parts && really == ends -> Just (Path ends parts)
    | otherwise -> Just (Path really (PathPart.meeting really kept))
    where
      kept = first :| rest
      isBack = not (null rest) && isSame (PathPart.start first) (PathPart.end (NonEmpty.last kept))
      really = if isBack then Closed else ends
  where
    longer before list = case list of
      [] -> []
      p : more
        | isPoint p && isSame before (PathPart.end p) -> longer before more
        | otherwise -> p : longer (PathPart.end p) more

-- | True of a part whose length is at most 'OutlineTolerance.same'.
isPoint :: PathPart -> Bool
isPoint part = case part of
  Plain (Straight a b) -> isSame a b
  Plain Arc {start, centre, sweep = Rad s} -> isShort (Segment.radius centre start) s
  EllipseArc e from to -> isShort (major e) (to - from)
  Bezier (first :| rest) _ -> all (isSame first) rest
  BSpline s -> let first :| rest = controls s in all (isSame first) rest
  where
    isShort (Mm r) angle = Mm (r * abs angle) <= OutlineTolerance.same

-- | True of two points that count as the same.
isSame :: Point -> Point -> Bool
isSame p q = Vec.distance p q <= OutlineTolerance.same

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
