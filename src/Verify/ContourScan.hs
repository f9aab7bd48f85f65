-- | Scan of the motions beside a contour, in the order of the tape. The elements within reach of a
-- motion are looked up once for all comparisons of the motion: its gouge, its distance from the
-- contour, its side. The scan also collects for each element a fast upper bound of its distance
-- from the motions along the contour.
module Verify.ContourScan
  ( Scan (..),
    scan,
  )
where

import Base.Quantity (Mm (..))
import Control.Applicative ((<|>))
import Control.Monad (foldM, when)
import Control.Monad.ST (ST, runST)
import Data.Primitive.PrimArray (MutablePrimArray, PrimArray)
import Data.Primitive.PrimArray qualified as PrimArray
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment)
import Verify.Edge (Edge (long, rank, shape))
import Verify.Excess qualified as Excess
import Verify.Gouge (KeepOut (..))
import Verify.Gouge qualified as Gouge
import Verify.Gouge.Fast qualified as FastGouge
import Verify.MillingJob (MillingJob (..))
import Verify.MillingJob qualified as MillingJob
import Verify.Motion (CutterMotion (number, part, segment))
import Verify.Motion qualified as Motion
import Verify.Proof (Finding, Witness)
import Verify.Proof qualified as Proof
import Verify.WrongSide qualified as WrongSide

-- | Result of a scan.
data Scan = Scan
  { -- | deepest gouge, if there is one
    gouge :: Maybe Witness,
    -- | motions that are too far from the contour, the last one first
    strays :: [Witness],
    -- | finding for the first motion on the wrong side
    wrongSide :: Maybe Finding,
    -- | bounding paths of the last motion along the contour; none after a vertical one
    latest :: [Segment]
  }

-- | Motion with what all its comparisons need: the elements that the cutter may touch during it,
-- and its bounding paths.
data View = View {motion :: CutterMotion, close :: [Edge], bounding :: [Segment]}

-- | Scan the motions that have to keep out of the part, and the motions that have to follow the
-- contour. Both lists are in the order of the tape; a motion may be in both.
--
-- The array has an upper bound in mm for each element, by its number: no point of the element is
-- further from the motions along the contour on its right side. Each bound comes from one motion or
-- from two that follow one another; it is ∞ if none was found.
scan ::
  MillingJob ->
  (CutterMotion -> KeepOut) ->
  Mm ->
  [CutterMotion] ->
  [CutterMotion] ->
  (Scan, PrimArray Double)
scan job keepOutOf allowedExcess keepingOut along = runST $ do
  bounds <- PrimArray.newPrimArray (BoxTree.size (edges job))
  PrimArray.setPrimArray bounds 0 (PrimArray.sizeofMutablePrimArray bounds) (1 / 0)
  let go result toKeepOut toFollow = case (toKeepOut, toFollow) of
        (v : vs, m : ms) -> case inOrder (motion v) m of
          EQ -> following (keptOut result v) v >>= \result' -> go result' vs ms
          LT -> go (keptOut result v) vs toFollow
          GT -> following result (viewOf m) >>= \result' -> go result' toKeepOut ms
        (v : vs, []) -> go (keptOut result v) vs []
        ([], ms) -> foldM following result (views ms)
      following result v = do
        mapM_ (improveBound job bounds (latest result) v) (close v)
        pure $! followed job strayJob v result
  result <- go (Scan Nothing [] Nothing []) (views keepingOut) along
  frozen <- PrimArray.unsafeFreezePrimArray bounds
  pure (result, frozen)
  where
    -- The excess of a motion is measured from the largest distance that the cutter may keep.
    strayJob = job {reach = maxReach job, allowance = allowedExcess}
    views ms = zipWith view (MillingJob.edgesNearEach job ms) ms
    view es m = View {motion = m, close = es, bounding = Motion.pathList m}
    viewOf m = view (MillingJob.edgesNear job m) m
    inOrder a b = compare (number a) (number b) <> compare (part a) (part b)
    keptOut result v =
      result {gouge = deeperGouge job (keepOutOf (motion v)) v (gouge result)}

-- | Gouge of a motion if it is deeper than the deepest one so far, otherwise that one.
deeperGouge :: MillingJob -> KeepOut -> View -> Maybe Witness -> Maybe Witness
deeperGouge job keepOut View {motion, close, bounding} best
  | FastGouge.mayGougeDeeper keepOut best motion bounding near =
    maybe best (Just . Proof.deeper best) (Gouge.gougeOf keepOut (edges job) motion)
  | otherwise = best
  where
    near
      | searchRadius keepOut <= MillingJob.contactLimit job = close
      | otherwise =
        BoxTree.within
          (BoundingBox.inflate (searchRadius keepOut) (Motion.box motion))
          (edges job)

-- | Result after one more motion along the contour. @strayJob@ has the distances by which a motion
-- too far from the contour is found.
followed :: MillingJob -> MillingJob -> View -> Scan -> Scan
followed job strayJob View {motion, close, bounding} result
  | Motion.isVertical motion = result {latest = []}
  | otherwise =
    result
      { latest = bounding,
        strays = maybe (strays result) (: strays result) stray,
        wrongSide = wrongSide result <|> WrongSide.wrongSide job motion close
      }
  where
    stray = Excess.strayOf strayJob motion close bounding

-- | Lower the bound of an element to its distance from a motion, if the motion is surely on the
-- right side of it. @before@ are the bounding paths of the motion before.
improveBound :: MillingJob -> MutablePrimArray s Double -> [Segment] -> View -> Edge -> ST s ()
improveBound job bounds before View {motion, bounding} e = do
  known <- PrimArray.readPrimArray bounds (rank e)
  -- A bound below the reach need not be lowered.
  when (known > enough) $ do
    let far = boundFrom job known before motion bounding e
    when
      (far < known && all (Excess.isSurelyOnSide job (shape e)) bounding)
      (PrimArray.writePrimArray bounds (rank e) far)
  where
    enough = let Mm r = reach job in r - 2 * FastDistance.unsure

-- | Upper bound of the distance of an element from a motion. If the motion alone gives none and
-- none is known, the element is divided at the point beside the start of the motion: its first part
-- is compared with the motion before.
boundFrom :: MillingJob -> Double -> [Segment] -> CutterMotion -> [Segment] -> Edge -> Double
boundFrom job known before motion bounding e
  | alone < 1 / 0
      || known <= limit
      || null before
      || not (FastDistance.mayLieWithin limit (long e) (shape e) x y) =
    alone
  | otherwise = case FastDistance.divided x y (shape e) of
    Just (first, second)
      | all (Excess.isSurelyOnSide job (shape e)) before ->
        max
          (FastDistance.furthestFrom limit first before)
          (FastDistance.furthestFrom limit second bounding)
    _ -> alone
  where
    alone = FastDistance.furthestFrom limit (shape e) bounding
    Mm limit = MillingJob.contactLimit job
    (x, y) = FastDistance.begin (segment motion)
