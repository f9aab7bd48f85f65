-- | The part of an exact curve along which the arcs and lines of a contour run.
module Export.ElementCurve
  ( along,
  )
where

import Base.Quantity (Mm (..), plus)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isJust, listToMaybe, mapMaybe)
import Data.Semigroup (sconcat)
import Data.Vector qualified as Vector
import Export.Bezier (CubicBezier)
import Export.Bezier qualified as Bezier
import Export.Tolerance qualified as Tolerance
import Geometry.Curve (Curve)
import Geometry.Curve qualified as Curve
import Geometry.Curve.BasisCurve qualified as BasisCurve
import Geometry.Curve.Span (Span (Polynomial))
import Geometry.Curve.Spline qualified as Spline
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (ReplacedCurve (..))

-- | The cubic curves of a curve, and true if they end where they begin.
data Pieces = Pieces {cubics :: NonEmpty CubicBezier, isClosed :: Bool}

-- | The cubic curves of a curve. Nothing if it consists of lines and arcs only, or if
-- 'Curve.cubics' finds no cubics for a shifted curve.
piecesOf :: Curve -> Maybe (NonEmpty CubicBezier)
piecesOf curve
  | isJust (Curve.toSegments curve) = Nothing
  | Just (_, xs, ys) <- Curve.cubics Tolerance.cubic curve =
    joined [Polynomial (Spline.at xs i) (Spline.at ys i) | i <- [0 .. Spline.count xs - 1]]
  | null (Curve.layers curve) = joined (Vector.toList (BasisCurve.spans (Curve.base curve)))
  | otherwise = Nothing
  where
    joined spans =
      fmap sconcat . NonEmpty.nonEmpty =<< traverse (Bezier.fromSpan Tolerance.cubic) spans

-- | The cubic curves along segments that replace a part of a curve, from the start of the first
-- segment to the end of the last one. Nothing if the curve does not pass through the ends and the
-- middles of all segments, or if it consists of lines and arcs, because the segments are the same.
along :: ReplacedCurve -> NonEmpty Segment -> Maybe (NonEmpty CubicBezier)
along ReplacedCurve {exact, deviation} segments = do
  cubics <- piecesOf exact
  let begin = Bezier.start (NonEmpty.head cubics)
      isClosed = Vec.isNear begin (Bezier.end (NonEmpty.last cubics))
  if all Bezier.isStraight cubics
    then Nothing
    else partAlong (plus Tolerance.onCurve deviation) nodes Pieces {cubics, isClosed}
  where
    nodes =
      Segment.start (NonEmpty.head segments) :
      concat [[Segment.at 0.5 s, Segment.end s] | s <- NonEmpty.toList segments]

-- | The part of a curve between the first and the last node, if the curve passes all nodes within
-- @reach@, in their order or in the opposite one.
partAlong :: Mm -> [Point] -> Pieces -> Maybe (NonEmpty CubicBezier)
partAlong reach nodes pieces =
  listToMaybe (mapMaybe (partForwards reach nodes) [pieces, backwards])
  where
    backwards = pieces {cubics = NonEmpty.reverse (fmap Bezier.reversed (cubics pieces))}

-- | The part of a curve between the first and the last node, if it passes all of them within
-- @reach@, in their order. In a closed curve the part may lead over the end of the curve.
partForwards :: Mm -> [Point] -> Pieces -> Maybe (NonEmpty CubicBezier)
partForwards reach nodes Pieces {cubics, isClosed} = do
  found <- traverse (position reach tree) nodes
  let begin = onSeam 0 (listToMaybe found)
      stations = begin : drop 1 found
      final = onSeam whole (listToMaybe (reverse stations))
      rising = and (zipWith (<=) stations (drop 1 (init stations <> [final])))
      wraps = length (filter id (zipWith (>) stations (drop 1 (init stations <> [final]))))
  part <- NonEmpty.nonEmpty $ case () of
    _
      | rising -> cut begin final
      | isClosed && wraps == 1 && final <= begin -> cut begin whole <> cut 0 final
      | otherwise -> []
  pure (withEnds nodes part)
  where
    numbered = zip [0 ..] (NonEmpty.toList cubics)
    tree = BoxTree.index (Bezier.boundingBox . snd) numbered
    whole = fromIntegral (length cubics) :: Double
    -- The seam of a closed curve is its start and its end: a node there has both parameters.
    onSeam wanted station = case station of
      Just u | isClosed && (u <= slack || u >= whole - slack) -> wanted
      Just u -> u
      Nothing -> wanted
    slack = 1e-9
    cut a b =
      [ Bezier.between (max 0 (a - i)) (min 1 (b - i)) piece
        | (i, piece) <- numbered,
          a < i + 1 - slack,
          b > i + slack
      ]

-- | The parameter of a point on numbered curves: the number of a curve, and the parameter along it.
-- Nothing if none of the curves passes through the point.
position :: Mm -> BoxTree (Double, CubicBezier) -> Point -> Maybe Double
position reach numbered p =
  fst <$> foldl nearer Nothing found
  where
    found = [(i + t, d) | (i, b) <- near, Just (t, d) <- [Bezier.nearest reach p b]]
    near = BoxTree.within (BoundingBox.inflate reach (BoundingBox.ofPoints p [])) numbered
    nearer best new = case best of
      Just (_, d) | d <= snd new -> best
      _ -> Just new

-- | The curves with the first and the last node as their ends, so that they join their neighbours.
withEnds :: [Point] -> NonEmpty CubicBezier -> NonEmpty CubicBezier
withEnds nodes (first :| others) = case nodes of
  [] -> first :| others
  begin : _ -> ending (Bezier.withStart begin first :| others)
  where
    ending list = case NonEmpty.reverse list of
      final :| before -> NonEmpty.reverse (Bezier.withEnd (last nodes) final :| before)
