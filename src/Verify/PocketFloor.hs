-- | Search for material that a tape leaves on the floor of a pocket: a position that the cutter's
-- centre may take, but that is too far from every motion. A motion clears all positions within the
-- cutter's radius, to which the allowed excess is added.
--
-- The search only follows curves, so its time does not depend on the area of the floor. Let A be
-- the set of all positions that the centre may take. The border of A is the rim of the pocket. Let
-- the /band/ of a motion be the set of all positions within the distance R of the motion. R is the
-- radius plus 'floorResolution'. Suppose that a position P of A lies in no band. The part of A that
-- is connected with P then has a position X that no motion clears, on a curve of one of two kinds:
--
-- * Rim: if this part of A meets no band, X is any point of its border.
-- * Border of a band: otherwise a path in A leads from P into a band. X is the point where the path
--   enters a band for the first time. Its distance from the nearest motion is R.
--
-- So the search examines the rim and the borders of all bands. The border of a band consists of the
-- offsets of the motion to both sides and of arcs about its ends. Where the next motion begins at
-- such an end, only the arc on the outer side of the corner is left of these arcs.
--
-- After a larger cutter, the positions that it has cleared are no part of A, and their border is a
-- part of the border of A. It is examined like the rim.
--
-- The curves are divided into pieces. A piece needs no division in two cases: it lies within the
-- distance @reach@ of one motion, or the centre may take no position on it. Any other piece is
-- halved, down to a quarter of 'floorResolution'. The middle of such a short piece decides for all
-- of it. The inexact steps add up to less than 'floorResolution', so no position P is missed:
--
-- * @reach@ exceeds the radius by a quarter of 'floorResolution';
-- * a point of a short piece is up to an eighth away from its middle;
-- * the point X is up to three eighths away from the curves that are examined ('slight');
-- * the centre may be allowed at X, and not in the middle of the short piece beside it. Then there
--   is a point of the rim between the two, up to another eighth away from the middle of its own
--   short piece.
module Verify.PocketFloor
  ( unclearedPoint,
    bordersOn,
    floorResolution,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, over, plus, times)
import Data.List (foldl')
import Data.Maybe (fromMaybe, listToMaybe, maybeToList)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier (Side (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Offset.Tolerance qualified as Tolerance
import Verify.Edge (Edge)
import Verify.Edge qualified as Edge
import Verify.Motion (CutterMotion)
import Verify.Motion qualified as Motion
import Verify.Pocket (Pocket)
import Verify.Pocket qualified as Pocket

-- | Floor of a pocket at one height, with the motions at that height. A motion clears all positions
-- whose distance from its path is at most @reach@.
data Floor = Floor
  { pocket :: Pocket,
    reach :: Mm,
    -- | bounding paths of each motion, in the order of the tape
    paths :: Vector [Segment],
    parts :: BoxTree MotionPart
  }

-- | Part of a motion, given by parts of its bounding paths and by the number of the motion in
-- 'paths'. The parts of an arc are so short that their bounding boxes are narrow: the boxes of
-- whole arcs about one centre all overlap.
data MotionPart = MotionPart {motion :: Int, part :: [Segment]}

-- | Position that the cutter's centre may take, but that is further than the radius from every
-- motion; Nothing if there is none. A position whose distance exceeds the radius by no more than
-- 'floorResolution' may be missed.
unclearedPoint :: Pocket -> Mm -> [CutterMotion] -> Maybe Point
unclearedPoint pocket radius clearing =
  listToMaybe (unclearedOn floor' (Hint 0 Nothing Nothing) (map (`Piece` Nothing) curves))
  where
    curves =
      map snd (Pocket.rim pocket) <> roughBorder pocket <> concatMap borders [LeftOf, RightOf]
    borders side = bordersOn side band (concatMap plainPaths near)
    band = plus radius floorResolution
    -- The bands of all other motions lie outside of the pocket.
    near = filter (BoundingBox.meets aroundPocket . Motion.box) clearing
    aroundPocket = BoundingBox.inflate band (Pocket.bounds pocket)
    paths = Vector.fromList (map Motion.pathList near)
    floor' =
      Floor
        { pocket,
          reach = plus radius (times 0.25 floorResolution),
          paths,
          parts =
            BoxTree.sortedIndex
              (foldr1 BoundingBox.union . map BoundingBox.ofSegment . part)
              (concatMap (uncurry (partsOf radius)) (zip [0 ..] (Vector.toList paths)))
        }

-- | Parts of the motion with the number @motion@ and the given bounding paths. The sagitta of a
-- part is at most half of the radius @r@.
partsOf :: Mm -> Int -> [Segment] -> [MotionPart]
partsOf r motion bounding =
  [ MotionPart {motion, part = map (Segment.between (share k) (share (k + 1))) bounding}
    | k <- [0 .. count - 1]
  ]
  where
    share k = fromIntegral k / fromIntegral count
    count = foldl' max 1 (map countOf bounding) :: Int
    countOf path = case path of
      Straight _ _ -> 1
      Arc {start, centre, sweep = Rad angle} ->
        let ratio = over r (times 4 (Segment.radius centre start))
         in ceiling (abs angle / (4 * asin (min 1 (sqrt ratio))))

-- Borders of bands --------------------------------------------------------------------------------

-- | Curves that contain the border of the floor that a larger cutter has cleared; empty without
-- such a cutter.
roughBorder :: Pocket -> [Segment]
roughBorder pocket = case Pocket.roughed pocket of
  Nothing -> []
  Just Pocket.RoughedFloor {Pocket.roughRim, Pocket.clearedReach} ->
    bordersOn
      (Carrier.oppositeSide (Pocket.side pocket))
      clearedReach
      (BoxTree.toList roughRim)

-- | Paths of a motion round which its band lies: the bounding paths. If these are two arcs that
-- hardly differ, it is the path of the motion alone.
plainPaths :: CutterMotion -> [Segment]
plainPaths m
  | Mm (FastDistance.uneven (Motion.segment m)) <= slight = [Motion.segment m]
  | otherwise = Motion.pathList m

-- | Curves of which the borders of bands consist, on one side of the paths and round their ends.
-- @r@ is the distance of the borders from the paths.
bordersOn :: Side -> Mm -> [Segment] -> [Segment]
bordersOn side r paths = concat (zipWith3 border (Nothing : map Just paths) paths others)
  where
    others = map Just (drop 1 paths) <> [Nothing]
    border before s next
      | Segment.length s <= Mm 0 = [roundAbout r (Segment.start s)]
      | otherwise =
        [ roundEnd side r (Segment.start s) (Vec.negate (Segment.startDirection s))
          | not (maybe False (`leadsTo` s) before)
        ]
          <> maybeToList (Segment.offset side r s)
          <> case next of
            Just s' | s `leadsTo` s' -> roundCorner side r s s'
            _ -> [roundEnd side r (Segment.end s) (Segment.endDirection s)]
    s `leadsTo` s' =
      Vec.distance (Segment.end s) (Segment.start s') <= slight && Segment.length s' > Mm 0

-- | Circle of the radius @r@ about a point.
roundAbout :: Mm -> Point -> Segment
roundAbout r p =
  Segment.fullCircle
    Carrier.CounterClockwise
    (Carrier.Circle p r)
    (Carrier.beside LeftOf r (Vec.vec 0 (-1)) p)

-- | Quarter of a circle of the radius @r@ about the end of a path, on a side of the direction
-- @outwards@. This direction leads away from the path.
roundEnd :: Side -> Mm -> Point -> Vec -> Segment
roundEnd side r end outwards =
  roundSide side r end outwards (Rad (Carrier.sideSign side * (-pi / 2)))

-- | Arc of the radius @r@ round the corner between two paths, if @side@ is its outer side; empty if
-- the arc is short.
roundCorner :: Side -> Mm -> Segment -> Segment -> [Segment]
roundCorner side r s s' =
  [ roundSide side r (Segment.end s) direction (Rad angle)
    | times (negate (Carrier.sideSign side) * angle) r > slight
  ]
  where
    direction = Segment.endDirection s
    Rad angle = Vec.signedAngle direction (Segment.startDirection s')

-- | Arc of the radius @r@ about a point, of the given sweep. It begins on a side of a direction.
roundSide :: Side -> Mm -> Point -> Vec -> Rad -> Segment
roundSide side r centre direction sweep =
  Arc {start = from direction, end = from (Vec.rotate sweep direction), centre, sweep}
  where
    from v = Carrier.beside side r v centre

-- | Largest length that counts as none: the distance between the bounding paths of a motion, the
-- distance from the end of a path to the start of the next one, the length of the arc at a corner.
slight :: Mm
slight = times 0.125 floorResolution

-- Search ------------------------------------------------------------------------------------------

-- | Piece of a curve. @candidates@ are the numbers of all motions that clear a point of the piece,
-- and perhaps of others; Nothing if they are not known yet.
data Piece = Piece {curve :: Segment, candidates :: Maybe [Int]}

-- | Motion and wall that decided earlier pieces. They or a neighbouring motion often decide the
-- next piece, too.
data Hint = Hint
  { -- | number of the last motion that cleared a piece; 0 if none did
    clearedBy :: Int,
    -- | last wall that was too near to a piece
    screenedBy :: Maybe Segment,
    -- | last position of a larger cutter that has cleared a piece
    roughedBy :: Maybe Segment
  }

-- | Uncleared positions on pieces of curves.
--
-- The motions near a long piece would be too many, so they are not looked for.
unclearedOn :: Floor -> Hint -> [Piece] -> [Point]
unclearedOn floor' hint pieces = case pieces of
  [] -> []
  Piece {curve, candidates} : more
    | any (screens floor' curve) (screenedBy hint) -> unclearedOn floor' hint more
    | any (hasRoughed floor' curve) (roughedBy hint) -> unclearedOn floor' hint more
    | n : _ <- filter (clears floor' curve) [known, known + 1, known - 1] -> cleared n
    | isLong -> unclearedOn floor' hint (halves Nothing <> more)
    | n : _ <- filter (clears floor' curve) clearing -> cleared n
    | isShort curve, not (null clearing) -> unclearedOn floor' hint more
    | null clearing,
      Just (w, wall) <- nearest,
      isOutside floor' curve middle w wall ->
      unclearedOn floor' hint {screenedBy = Just (Edge.shape wall)} more
    | null clearing,
      Just (w, _) <- nearest,
      Just by <- roughedOf floor' curve middle w ->
      unclearedOn floor' hint {roughedBy = Just by} more
    | isShort curve -> middle : unclearedOn floor' hint more
    | otherwise -> unclearedOn floor' hint (halves (Just clearingPoints) <> more)
    where
      known = clearedBy hint
      cleared n = unclearedOn floor' hint {clearedBy = n} more
      nearest = Pocket.nearestWall (Pocket.walls (pocket floor')) middle
      (first, second) = Segment.cutAt 0.5 curve
      middle = Segment.end first
      radius = times 0.5 (Segment.length curve)
      isLong = radius > times 0.5 (reach floor')
      -- Motions that clear the middle, and those that clear points of the piece.
      clearing = [n | (n, d) <- away, d <= reach floor']
      clearingPoints = [n | (n, d) <- away, d <= plus (reach floor') radius]
      halves numbers = map (`Piece` numbers) [first, second]
      away = [(n, distanceOf floor' n middle) | n <- fromMaybe found candidates]
      found = motionsNear floor' (BoundingBox.ofSegment curve)

-- | Test that a motion, given by its number, clears all of a piece. If the result is true, this is
-- certain.
clears :: Floor -> Segment -> Int -> Bool
clears floor' piece n = maybe False (all (isWithin (reach floor') piece)) (paths floor' Vector.!? n)

-- | Test that a wall is too near to all of a piece. If the result is true, this is certain.
screens :: Floor -> Segment -> Segment -> Bool
screens floor' piece = isWithin (wallLimit floor') piece

-- | Distance below which the cutter's centre may take no position. The rim may be nearer to the
-- walls than its distance, because of rounding.
wallLimit :: Floor -> Mm
wallLimit floor' = minus (Pocket.rimDistance (pocket floor')) Tolerance.clearance

-- | Test that the cutter's centre may take no position on a piece. For a short piece, its middle
-- decides. @wall@ is the wall nearest to the middle, at the distance @w@.
isOutside :: Floor -> Segment -> Point -> Mm -> Edge -> Bool
isOutside floor' piece middle w wall =
  plus w half < limit
    || screens floor' piece (Edge.shape wall)
    || (w > half || isShort piece)
    && not (Pocket.isOnFreeSide (Pocket.side (pocket floor')) walls middle wall)
    || isShort piece
    && w < limit
  where
    half = times 0.5 (Segment.length piece)
    walls = Pocket.walls (pocket floor')
    limit = wallLimit floor'

-- | Test that a larger cutter has cleared all of a piece from a part of the border of its
-- positions. If the result is true, this is certain.
hasRoughed :: Floor -> Segment -> Segment -> Bool
hasRoughed floor' piece by =
  or [isWithin (roughedLimit f) piece by | Just f <- [Pocket.roughed (pocket floor')]]

-- | Distance from the positions of a larger cutter up to which the floor counts as cleared. The
-- border of this floor is examined, so it is no part of it.
roughedLimit :: Pocket.RoughedFloor -> Mm
roughedLimit f = minus (Pocket.clearedReach f) Tolerance.clearance

-- | Part of the border of the positions of a larger cutter that is near a piece, if this cutter has
-- cleared the piece; Nothing if it has not. For a short piece, its middle decides. The distance of
-- the middle from the nearest wall is @w@.
roughedOf :: Floor -> Segment -> Point -> Mm -> Maybe Segment
roughedOf floor' piece middle w = do
  f <- Pocket.roughed (pocket floor')
  (d, by) <-
    BoxTree.closest
      (\s -> Mm (FastDistance.distance s (Vec.x middle) (Vec.y middle)))
      middle
      (Pocket.roughRim f)
  if hasRoughed floor' piece by
    || minus w half >= Pocket.roughRimDistance f
    || isShort piece && (d <= roughedLimit f || w >= Pocket.roughRimDistance f)
    then Just by
    else Nothing
  where
    half = times 0.5 (Segment.length piece)

-- | Test that a piece is so short that it is not divided.
isShort :: Segment -> Bool
isShort piece = Segment.length piece <= times 0.25 floorResolution

-- | Test that every point of a piece is within a distance of a path. If the result is true, this is
-- certain.
isWithin :: Mm -> Segment -> Segment -> Bool
isWithin (Mm distance) = FastDistance.isWithin (distance - 2 * FastDistance.unsure)

-- | Numbers of the motions that clear a point of a box, and perhaps of others.
motionsNear :: Floor -> BoundingBox -> [Int]
motionsNear floor' box =
  map motion (BoxTree.within (BoundingBox.inflate (reach floor') box) (parts floor'))

-- | Distance of a motion, given by its number, from a point.
distanceOf :: Floor -> Int -> Point -> Mm
distanceOf floor' n p =
  foldl'
    (\d path -> max d (Mm (FastDistance.distance path (Vec.x p) (Vec.y p))))
    (Mm 0)
    (paths floor' Vector.! n)

-- | Length by which the distance of a position from the nearest motion may exceed the radius before
-- the position counts as uncleared.
floorResolution :: Mm
floorResolution = Mm 0.02
