-- | Scan of the motions beside a contour, in the order of the tape. For each motion it looks up,
-- only once, which elements the cutter may touch during the motion. Three comparisons use these
-- elements: the gouge, the distance from the contour, and the side.
--
-- The scan also gives for each element an upper bound of the distance of its points from the
-- motions along the contour. An element with a small bound needs no exact comparison for excess,
-- that is, for material that remains. A /job/ is a cut along a contour as the part demands it.
--
-- The /bounding paths/ of a motion enclose its real path: one path, or two for an arc whose radii
-- at start and end differ (see "Control.Motion").
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
    -- | motions that are too far from the contour, in the reverse order of the tape
    strays :: [Witness],
    -- | finding for the first motion on the wrong side
    wrongSide :: Maybe Finding,
    -- | bounding paths of the last motion along the contour; empty before the first motion and
    -- after a vertical one
    latest :: [Segment]
  }

-- | Motion with the elements that the cutter may touch during the motion (@close@), and with its
-- bounding paths.
data View = View {motion :: CutterMotion, close :: [Edge], bounding :: [Segment]}

-- | Scan two lists of motions, each in the order of the tape: @keepingOut@ are the motions that are
-- examined for gouges, @along@ those that have to follow the contour. A motion may be in both.
-- @keepOutOf@ gives the distances that a motion has to keep from the elements. A motion along the
-- contour may be further from it than 'maxReach' by at most @allowedExcess@.
--
-- The array of the result has an upper bound in mm for each element, by the element's number from
-- 0. Each point of the element has a motion of @along@ within that distance, on the required side.
-- A bound comes from one motion or from two successive ones; it is ∞ if none was found.
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
    -- A motion is too far from the contour if it is further than 'maxReach' plus @allowedExcess@.
    strayJob = job {reach = maxReach job, allowance = allowedExcess}
    views ms = zipWith view (MillingJob.edgesNearEach job ms) ms
    view es m = View {motion = m, close = es, bounding = Motion.pathList m}
    viewOf m = view (MillingJob.edgesNear job m) m
    inOrder a b = compare (number a) (number b) <> compare (part a) (part b)
    keptOut result v =
      result {gouge = deeperGouge job (keepOutOf (motion v)) v (gouge result)}

-- | Deepest gouge, out of the motion's gouges and @best@, the deepest gouge so far.
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

-- | Scan after a motion along the contour; @result@ is the scan before that motion. @strayJob@ is
-- @job@ with another reach and allowance. A motion is too far from the contour if its distance is
-- larger than the sum of these two.
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

-- | Replace the bound of the element @e@ by that of 'boundFrom' if the latter is smaller. The bound
-- is not changed if the motion is not surely on the required side of the element. @bounds@ has the
-- bound of each element in mm. @before@ are the bounding paths of the motion before.
improveBound :: MillingJob -> MutablePrimArray s Double -> [Segment] -> View -> Edge -> ST s ()
improveBound job bounds before View {motion, bounding} e = do
  known <- PrimArray.readPrimArray bounds (rank e)
  -- A bound below the reach of the job already shows that the element has no excess.
  when (known > enough) $ do
    let far = boundFrom job known before motion bounding e
    when
      (far < known && all (Excess.isSurelyOnSide job (shape e)) bounding)
      (PrimArray.writePrimArray bounds (rank e) far)
  where
    enough = let Mm r = reach job in r - 2 * FastDistance.unsure

-- | Upper bound, in mm, of the distance from the points of the element @e@ to a motion and the one
-- before it: within this distance, each point has at least one of the two motions. It is ∞ if no
-- bound is found. @known@ is the bound so far; @before@ and @bounding@ are the bounding paths of
-- the motion before and of the motion itself.
--
-- If the motion alone gives no bound, and @known@ is above 'MillingJob.contactLimit', the element
-- is divided at its point nearest to the start of the motion. The first part is compared with the
-- motion before, the second with the motion itself. The result is the larger bound of the two.
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
