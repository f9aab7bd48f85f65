-- | The fast loops of the proof, compared with the plain functions beside them.
module Verify.MillingJob.FastSpec
  ( spec,
  )
where

import Base.Quantity (Mm (..))
import Data.Maybe (isJust, isNothing)
import Generate qualified
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machines (iso6983)
import Part.Part qualified as Part
import Test.Hspec
import Test.QuickCheck
import Toolpath.Toolpath qualified as Toolpath
import Verify.Deviation qualified as Deviation
import Verify.Edge qualified as Edge
import Verify.Gouge qualified as Gouge
import Verify.Gouge.Fast qualified as FastGouge
import Verify.MillingJob (MillingJob (..))
import Verify.MillingJob qualified as MillingJob
import Verify.MillingJob.Fast qualified as FastContact
import Verify.Motion (CutterMotion (..))
import Verify.Motion qualified as Motion
import Verify.PassLocation (Guide (..))
import Verify.PassLocation qualified as PassLocation

spec :: Spec
spec = do
  it
    "the fast loop gives the contacts of a cutter in their order (catches a loop that ignores the \
    \allowance of an element)"
    $ property $
      forAllBlind position $ \(job, p) ->
        let near = MillingJob.edgesAround job p
            found = MillingJob.contacts job near p
         in cover 3 (length found > 1) "several contacts" $
              FastContact.foldContacts job near p (\others n s -> (n, s) : others) []
                === reverse found
  it
    "the fast loop gives the least distance of a point (catches a loop that looks at the first \
    \element only)"
    $ property $
      forAllBlind position $ \(job, p) ->
        let near = MillingJob.edgesAround job p
            least = FastContact.leastDistance (1 / 0) near (Vec.x p) (Vec.y p)
         in least === Edge.leastExcess (const (Mm 0)) (1 / 0) near p
              .&&. property (all (isAtLeast least p) near)
  it "the fast bounds exclude no gouge (catches bounds that allow half of the distance)" $
    property $
      forAllBlind position $ \(job, p) ->
        forAll (step p) $ \q ->
          let m = CutterMotion 1 0 (Straight p q) (Mm 0) (Mm 0)
              keepOut = Gouge.constantKeepOut (reach job)
              near = MillingJob.edgesInBox job m
              isExcluded =
                not (FastGouge.mayGougeDeeper keepOut Nothing m (Motion.pathList m) near)
              gouge = Gouge.gougeOf keepOut (edges job) m
           in cover 10 isExcluded "excluded" $
                cover 10 (isJust gouge) "gouges" (not isExcluded || isNothing gouge)
  where
    isAtLeast d p e =
      let Mm exact = Distance.toPoint p (Edge.shape e) in exact >= d - 1e-9
    step p = do
      dx <- choose (-0.3, 0.3)
      dy <- choose (-0.3, 0.3)
      pure (Vec.point (Vec.x p + dx) (Vec.y p + dy))
    position = do
      job <- Generate.closedCase `suchThatMap` jobOf
      (,) job <$> positionAround job
    jobOf c = Generate.milled (Mm 0.02) c >>= firstJob

-- | A point about as far from the contour as the centre of the cutter is.
positionAround :: MillingJob -> Gen Point
positionAround job = do
  e <- elements (MillingJob.elementsOf job)
  angle <- choose (0, 2 * pi)
  let Mm r = MillingJob.contactLimit job
  d <- choose (0.5 * r, 1.5 * r)
  let centre = Segment.end (Part.segment e)
  pure (Vec.point (Vec.x centre + d * cos angle) (Vec.y centre + d * sin angle))

-- | The first cut along a contour of a toolpath.
firstJob :: Toolpath.Toolpath -> Maybe MillingJob
firstJob path = case PassLocation.locate guide start [] (Toolpath.blocks path) of
  pass : _ -> Just (Deviation.job pass)
  [] -> Nothing
  where
    start = (Vec.point 0 0, Mm 0)
    guide =
      Guide
        { machine = iso6983,
          isFlat = True,
          isSwivelled = const False,
          isOverTabs = const True,
          lastFrameOf = const Nothing,
          cutFramesOf = const Nothing
        }
