-- | Location of all passes along contours on a tape, one after the other. Each cut of a pass is
-- searched for after the end of the cut before it.
--
-- The toolpath says which passes there are, at which height, with which allowance, and where their
-- cuts start and end. The side of the cutter and its distance from the contour come from the part.
-- A cut is one trip along a contour. A pass has several cuts if the cutter does not reach all of
-- the contour. Each of these cuts counts as a pass when passes are numbered.
module Verify.PassLocation
  ( Guide (..),
    locate,
    areFirst,
    motionsOfPasses,
  )
where

import Base.Quantity (Mm (..), plus, times)
import Base.Region (Located (..), Region)
import Data.Function (on)
import Data.List (foldl')
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isJust)
import Geometry.Carrier (Side)
import Geometry.Carrier qualified as Carrier
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Part.Part (Milling)
import Part.Part qualified as Part
import Toolpath.Tolerance qualified as Tolerance
import Toolpath.Toolpath (Block, Move)
import Toolpath.Toolpath qualified as Toolpath
import Verify.Deviation (MillingPass (..))
import Verify.Deviation qualified as Deviation
import Verify.Edge (Edge)
import Verify.Edge qualified as Edge
import Verify.MillingJob (MillingJob (..))
import Verify.Motion (CutterMotion (number))
import Verify.Motion qualified as Motion
import Verify.MotionSet qualified as MotionSet
import Verify.PassFrames (FrameRange (..))
import Verify.PassSearch qualified as PassSearch
import Verify.Requirement qualified as Requirement
import Verify.Tab qualified as Tab

-- | Facts about the machine, the toolpath and the planned frames that guide the search for passes.
data Guide = Guide
  { machine :: Machine,
    -- | true if the whole toolpath is at the height of its start; heights are then not compared
    isFlat :: Bool,
    -- | test that a motion swivels a blade as its pass demands
    isSwivelled :: CutterMotion -> Bool,
    -- | test that a motion goes over tabs as its pass demands
    isOverTabs :: CutterMotion -> Bool,
    -- | number of the last frame of a pass of a pocket, by the number of the pass from 0; Nothing
    -- if it is unknown
    lastFrameOf :: Int -> Maybe Int,
    -- | planned frames of a cut, by the number of its pass from 0. Only these frames, and the one
    -- before them, are searched, because another cut may lie within the tolerance of this one, and
    -- could be taken for it. Nothing if the frames of the tape differ from the planned ones, or if
    -- the toolpath has a single cut; then all frames after the previous cut are searched
    cutFramesOf :: Int -> Maybe FrameRange
  }

-- | State of the search: the position and height of the centre where the search continues, the
-- motions after that position, and the pass that was searched last, if there is one.
data SearchState = SearchState
  { at :: (Point, Mm),
    remaining :: [CutterMotion],
    lastPass :: Maybe MillingPass
  }

-- | Cut of the toolpath along a contour. A pass that leaves rest material may have several cuts.
data Cut = Cut
  { -- | number among all passes of the toolpath, from 0; each cut counts as a pass
    passIndex :: Int,
    -- | true if the pass has several cuts
    isPartial :: Bool,
    statementAt :: Located Milling,
    plannedPass :: Toolpath.Pass,
    cutMoves :: NonEmpty Move
  }

-- | Locate the passes along contours among the motions of a tape. @begin@ is the position and
-- height of the cutter's centre before the first motion. The result has one entry for each cut of
-- the toolpath's blocks.
locate :: Guide -> (Point, Mm) -> [CutterMotion] -> [Block] -> [MillingPass]
locate guide begin motions blocks =
  go
    (SearchState begin motions Nothing)
    (zip3 (Toolpath.passNumbers blocks) (arePartial blocks) blocks)
  where
    go state numbered = case numbered of
      [] -> []
      (passIndex, isPartial, block) : more -> case block of
        Toolpath.Cutting {Toolpath.job, Toolpath.pass, Toolpath.cut} ->
          let found =
                locateCut
                  guide
                  state
                  Cut
                    { passIndex,
                      isPartial,
                      statementAt = job,
                      plannedPass = pass,
                      cutMoves = cut
                    }
           in found : go (afterPass found state) more
        Toolpath.Clearing {}
          | Just final <- lastFrameOf guide passIndex -> go (afterFrame final state) more
        _ -> go state more

-- | State of the search after a located pass. The search continues after the last motion of the
-- pass; if the pass has no motions, it continues where it was.
afterPass :: MillingPass -> SearchState -> SearchState
afterPass pass state = case lastOf (PassSearch.motionsOf (found pass)) of
  Nothing -> state {lastPass = Just pass}
  Just final ->
    SearchState
      { at = Motion.endPosition final,
        remaining = drop 1 (dropWhile (not . Motion.isSame final) (remaining state)),
        lastPass = Just pass
      }

-- | State of the search after the frame with the number @final@: the motions up to this frame are
-- skipped.
afterFrame :: Int -> SearchState -> SearchState
afterFrame final state =
  state {at = maybe (at state) Motion.endPosition (lastOf done), remaining = later}
  where
    (done, later) = span ((<= final) . number) (remaining state)

-- | Locate one cut among the motions that remain after the cuts before it.
locateCut :: Guide -> SearchState -> Cut -> MillingPass
locateCut guide state cut =
  MillingPass {job, passNumber, level, found = PassSearch.find job startsAt searched}
  where
    Located statement milling = statementAt cut
    Toolpath.Pass {Toolpath.number = passNumber, Toolpath.atHeight = level} = plannedPass cut
    job = jobOf (machine guide) statement milling cut edges
    -- All cuts of a statement share one tree of elements, so that it is not built again.
    edges = case lastPass state of
      Just MillingPass {job = MillingJob {edges = same}, passNumber = m} | m == passNumber -> same
      _ -> Edge.edgesOf (Part.contour milling)
    startsAt
      | isFlat guide || MotionSet.isSameHeight (machine guide) level (snd (at state)) =
        Just (fst (at state))
      | otherwise = Nothing
    searched
      | isFlat guide = candidates
      | isJust (Part.gear milling) = filter (isSwivelled guide) atHeight
      | Just (Located _ t) <- Part.tabs milling,
        Tab.isBelow (machine guide) t level =
        filter (isOverTabs guide) atHeight
      | otherwise = atHeight
    atHeight = filter (MotionSet.isAtHeight (machine guide) level) candidates
    candidates = case cutFramesOf guide (passIndex cut) of
      Nothing -> remaining state
      Just (FrameRange a b) ->
        takeWhile ((<= b) . number) (dropWhile ((< a - 1) . number) (remaining state))

-- | Milling job of a cut: what the part demands of it. @edges@ are the elements of the contour.
jobOf :: Machine -> Region -> Milling -> Cut -> BoxTree Edge -> MillingJob
jobOf machine statement milling cut edges =
  MillingJob
    { milling,
      statement,
      side,
      entry = Segment.start (Toolpath.segment (NonEmpty.head (cutMoves cut))),
      exit =
        fromMaybe
          (Segment.end (Toolpath.segment (NonEmpty.last (cutMoves cut))))
          (exitByControl milling side reach),
      reach,
      maxReach = largestReach milling (Edge.largestAllowance edges) reach,
      allowance,
      exitTolerance = plus allowance (exitUncertainty machine milling reach),
      isPartialCut = isPartial cut,
      edges
    }
  where
    side = Requirement.cutterSide milling
    reach = Requirement.centreDistance milling (Toolpath.left (plannedPass cut))
    allowance =
      plus
        (uncurry max (Deviation.allowedDeviation (Edge.isCurved edges) milling))
        (Machine.planeResolution machine)

-- | List with an entry for each block: true if the block is one of several cuts of a pass. A pass
-- has several cuts only if rest material is allowed.
arePartial :: [Block] -> [Bool]
arePartial blocks =
  zipWith3
    (\before own next -> isJust own && (own == before || own == next))
    (Nothing : passes)
    passes
    (drop 1 passes <> [Nothing])
  where
    passes = map passOf blocks
    passOf b = case b of
      Toolpath.Cutting
        { Toolpath.job = Located _ milling,
          Toolpath.pass = Toolpath.Pass {Toolpath.number, Toolpath.left, Toolpath.atHeight}
        }
          | Part.rest milling == Part.Allowed ->
            Just (number, left, atHeight)
      _ -> Nothing

-- | Position of the cutter's centre at the end of a contour if the control does the cutter
-- compensation: on the normal at the end of the last element, at the distance @reach@. Nothing if
-- the control does not compensate, or if @side@ is Nothing. With compensation, the end of the
-- toolpath may be another point: on a closed contour, the control may or may not treat the joint
-- with the first element as a corner.
exitByControl :: Milling -> Maybe Side -> Mm -> Maybe Point
exitByControl milling side reach = case (Part.controlCompensation milling, side) of
  (Just _, Just s) ->
    Just (Carrier.beside s reach (Segment.endDirection final) (Segment.end final))
  _ -> Nothing
  where
    final = Part.segment (NonEmpty.last (Part.elements (Part.contour milling)))

-- | Uncertainty in mm of the position of 'exitByControl'; 0 without compensation. Rounding to
-- pulses changes the direction of the last element, most of all if the element is short. The
-- shortest element under compensation has the length 'Tolerance.controlLength'.
exitUncertainty :: Machine -> Milling -> Mm -> Mm
exitUncertainty machine milling reach = case Part.controlCompensation milling of
  Just _ -> times (2 * pulse / shortest) reach
  Nothing -> Mm 0
  where
    Mm pulse = Machine.planeResolution machine
    Mm shortest = Tolerance.controlLength

-- | Largest distance of the centre from a contour in a pass. @reach@ is the distance that the pass
-- keeps from an element without an allowance of its own. @allowance@ is the largest allowance of an
-- element. At a sharp corner the toolpath goes up to twice as far from the contour.
largestReach :: Milling -> Mm -> Mm -> Mm
largestReach milling allowance reach
  | Part.corners milling == Part.Sharp = times 2 (plus reach allowance)
  | otherwise = plus reach allowance

-- | List with an entry for each cut: true if it is the first cut of its statement's execution.
areFirst :: [MillingPass] -> [Bool]
areFirst passes =
  zipWith (/=) (map (Just . passNumber) passes) (Nothing : map (Just . passNumber) passes)

-- | For the first cut of each pass, the motions of all its cuts; Nothing for the later cuts. A pass
-- is one allowance at one height.
motionsOfPasses :: [MillingPass] -> [Maybe [CutterMotion]]
motionsOfPasses = concatMap ofPass . NonEmpty.groupBy ((==) `on` key)
  where
    key MillingPass {job, passNumber, level} = (passNumber, level, reach job)
    ofPass cuts =
      Just (concatMap (PassSearch.motionsOf . found) cuts) :
      map (const Nothing) (NonEmpty.tail cuts)

-- | Last element of a list, if there is one.
lastOf :: [a] -> Maybe a
lastOf = foldl' (\_ a -> Just a) Nothing
