{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 #-}

-- | The raw offset: every segment of closed polyarcs is moved sideways, by a distance that the
-- caller gives for it, and joined to the next one.
--
-- An outer corner turns away from the cutter, an inner one towards it. Segments at an outer corner
-- are joined by an arc about the vertex, or by two lines up to the intersection of the tangents. At
-- an inner corner two sufficiently long lines are cut at their intersection; other segments are
-- joined by a straight line. At a smooth joint, where the direction does not change, the moved
-- segments meet. When an arc is moved towards its centre by more than its radius, it keeps its
-- bulge and then runs backwards. The raw offset deforms continuously as the distance grows from 0.
-- Its winding numbers therefore show what the cutter's centre can reach (Chen and McMains, "Polygon
-- offsetting by computing winding numbers", 2005).
--
-- Segments and vertices are given by their numbers in 'ClosedPolyarcs'. Lengths and coordinates are
-- in mm. A mark says something about a segment, for example that it starts smoothly;
-- 'ClosedPolyarcs' has one constant for each mark.
module Offset.RawOffset
  ( Corners (..),
    raw,
  )
where

import Base.Quantity (Rad (..))
import Control.Monad.ST (ST, runST)
import Data.Int (Int32)
import Data.Primitive.PrimArray
import Data.Word (Word8)
import Geometry.ClosedPolyarcs (ClosedPolyarcs (ClosedPolyarcs))
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.Tolerance qualified as Tolerance

-- | The form of outer corners: an arc about the vertex, or two lines. A corner that turns by more
-- than 120° is always round.
data Corners = Round | Sharp
  deriving stock (Eq, Show)

-- | The arrays of a raw offset while they are written: x and y of the vertices, bulges and marks of
-- the segments, and the numbers of the segments from which they were made.
data Filling s
  = Filling
      (MutablePrimArray s Double)
      (MutablePrimArray s Double)
      (MutablePrimArray s Double)
      (MutablePrimArray s Word8)
      (MutablePrimArray s Int32)

-- | The kind of joint between two moved segments.
data Joint
  = -- | no corner, and both segments have the same distance: they meet
    Smooth
  | -- | no corner, but different distances: a line square to both segments joins them
    Step
  | -- | an outer corner: an arc or two lines go round the vertex
    Outer
  | -- | an inner corner between two lines, which are cut at their intersection
    Trimmed
  | -- | any other inner corner: a line joins the end of one segment to the start of the next; if
    -- any distances differ, two lines do, which meet at the vertex
    Over
  deriving stock (Eq)

-- | The raw offset of the polyarcs @c@, and @c@ itself with its smooth joints marked. The other
-- arguments are:
--
-- * @tolerance@: a length in mm; shorter segments of the raw offset are omitted;
-- * @smoothness@: two directions are equal when the sine of the angle between them is at most this;
-- * @corners@: the form of outer corners;
-- * @uneven@: True when the segments' distances differ;
-- * @distance@: each segment's distance in mm, positive to the right of the direction of travel;
-- * @corner@: the radius in mm, with the sign of the distance, of arcs about each segment's ends;
--   it may be larger than the distance.
raw ::
  Double ->
  Double ->
  Corners ->
  Bool ->
  (Int -> Double) ->
  (Int -> Double) ->
  ClosedPolyarcs ->
  (ClosedPolyarcs, ClosedPolyarcs)
raw !tolerance !smoothness corners uneven distance corner !c = runST $ do
  let n = sizeofPrimArray (ClosedPolyarcs.xs c)
      -- Each segment needs room for itself and its joint: an arc or a line, or two lines for a
      -- sharp corner. Uneven distances need two lines more.
      capacity = n * (if uneven then 5 else if corners == Sharp then 3 else 2) + 8
  filling <- newFilling capacity
  heads <- newPrimArray (ClosedPolyarcs.loopCount c + 1)
  marks <- thawPrimArray (ClosedPolyarcs.marks c) 0 n
  let offsetAll !w !k !kept
        | w >= ClosedPolyarcs.loopCount c = writePrimArray heads kept k >> pure (k, kept)
        | otherwise = do
          k' <-
            offsetPolyarc
              tolerance
              smoothness
              corners
              uneven
              distance
              corner
              c
              marks
              filling
              (ClosedPolyarcs.firstVertex c w)
              (ClosedPolyarcs.repeatedVertex c w)
              k
          if k' - k < 2
            then offsetAll (w + 1) k kept
            else do
              closeUp filling k k'
              writePrimArray heads kept k
              offsetAll (w + 1) (k' + 1) (kept + 1)
  (used, kept) <- offsetAll 0 0 0
  shrinkMutablePrimArray heads (kept + 1)
  result <- frozen filling used heads
  marks' <- unsafeFreezePrimArray marks
  pure (result, c {ClosedPolyarcs.marks = marks'})
{-# INLINE raw #-}

-- | Arrays with room for @capacity@ vertices.
newFilling :: Int -> ST s (Filling s)
newFilling capacity =
  Filling
    <$> newPrimArray capacity
      <*> newPrimArray capacity
      <*> newPrimArray capacity
      <*> newPrimArray capacity
      <*> newPrimArray capacity

-- | The polyarcs in the filled arrays, of which @used@ entries are in use. @heads@ has the index of
-- each polyarc's first vertex.
frozen :: Filling s -> Int -> MutablePrimArray s Int -> ST s ClosedPolyarcs
frozen (Filling rx ry rb rm rs) used heads = do
  mapM_ (`shrinkMutablePrimArray` used) [rx, ry, rb]
  shrinkMutablePrimArray rm used
  shrinkMutablePrimArray rs used
  ClosedPolyarcs
    <$> unsafeFreezePrimArray rx
      <*> unsafeFreezePrimArray ry
      <*> unsafeFreezePrimArray rb
      <*> unsafeFreezePrimArray rm
      <*> unsafeFreezePrimArray rs
      <*> unsafeFreezePrimArray heads

-- | Closes a polyarc whose first vertex is at index @k@ and whose last segment is just before index
-- @k'@. Copies the vertex from @k@ to @k'@, and marks the first and the last segment.
closeUp :: Filling s -> Int -> Int -> ST s ()
closeUp (Filling rx ry rb rm rs) k k' = do
  readPrimArray rx k >>= writePrimArray rx k'
  readPrimArray ry k >>= writePrimArray ry k'
  writePrimArray rb k' 0
  writePrimArray rm k' ClosedPolyarcs.repeatedMark
  writePrimArray rs k' 0
  m <- readPrimArray rm k
  writePrimArray rm k (m + ClosedPolyarcs.firstMark)
  m' <- readPrimArray rm (k' - 1)
  writePrimArray rm (k' - 1) (m' + ClosedPolyarcs.lastMark)

-- | Writes the raw offset of one of the polyarcs @c@. The arguments up to @c@ are those of 'raw'.
-- @marks@ are the marks of the segments of @c@, to which the marks of smooth joints are added. The
-- polyarc to be offset has its first vertex at index @a@, and the same vertex again at the end, at
-- index @e@. The raw offset is written from index @k0@ on; the result is the next free index.
offsetPolyarc ::
  Double ->
  Double ->
  Corners ->
  Bool ->
  (Int -> Double) ->
  (Int -> Double) ->
  ClosedPolyarcs ->
  MutablePrimArray s Word8 ->
  Filling s ->
  Int ->
  Int ->
  Int ->
  ST s Int
offsetPolyarc
  !tolerance
  !smoothness
  corners
  uneven
  distance
  corner
  !c
  marks
  (Filling rx ry rb rm rs)
  !a
  !e
  !k0 =
    endDirections c a $ \sx sy ex ey l ->
      endDirections c (e - 1) $ \_ _ zx zy lz ->
        joint (e - 1) a zx zy sx sy (if lz < l then lz else l) lz l $ \closing bend cut -> do
          markSmooth a closing
          go a k0 sx sy ex ey l cut (if closing == Smooth then ClosedPolyarcs.smoothMark else 0) $
            const (closing, bend, cut)
    where
      bulge i = indexPrimArray (ClosedPolyarcs.bulges c) i
      markSmooth i j = case j of
        Smooth ->
          readPrimArray marks i >>= \m -> writePrimArray marks i (m + ClosedPolyarcs.smoothMark)
        _ -> pure ()
      -- The joint between segment @i@, which ends in the direction (@ax@, @ay@), and segment @j@,
      -- which starts in the direction (@bx@, @by@). Passes to @k@: the kind of the joint; tan(θ/4)
      -- of an outer corner that turns by θ; the length in mm by which both lines of an inner corner
      -- are cut. @shorter@ is the length of the shorter chord. @restI@ and @restJ@ are the lengths
      -- that earlier cuts leave of both lines. Rounding of the vertices changes the direction of a
      -- chord. Therefore a corner also counts as smooth when this moves no point of the offset by
      -- more than the tolerance.
      joint i j ax ay bx by shorter restI restJ k
        | dt > 0
            && ( abs cr <= smoothness
                   || abs cr * shorter <= tolerance
                     && abs (cr * d) * (abs cr + abs (bulge i) + abs (bulge j)) <= tolerance
               ) =
          k (if di == dj then Smooth else Step) 0 0
        -- The direction reverses here: a cusp. A cusp that is open towards the cutter is an inner
        -- corner, because the cutter cannot enter the cusp. Any other one is an outer corner. So is
        -- a cusp between lines that coincide.
        | dt < 0 && abs cr <= cuspSine =
          k
            ( if d * (Tolerance.cuspDepth / 2 * (curvature i + curvature j) - cr) > smoothness
                then Over
                else Outer
            )
            (signum d * (if cr * d > 0 then reversing else 1 / reversing))
            0
        | cr * d > 0 = k Outer (cr / (1 + dt + sqrt ((1 + dt) * (1 + dt) + cr * cr))) 0
        | bulge i == 0 && bulge j == 0 && di == dj && needed <= restI && needed <= restJ =
          k Trimmed 0 cut
        | otherwise = k Over 0 0
        where
          di = distance i
          dj = distance j
          d = if abs di > abs dj then di else dj
          cr = ax * by - ay * bx
          dt = ax * bx + ay * by
          curvature = ClosedPolyarcs.curvature c
          -- tan(θ/4) for the angle θ between both directions, at a cusp.
          reversing = tan ((pi - asin (abs cr)) / 4)
          cut = abs (d * cr / (1 + dt))
          -- The least length in mm that each of the two lines must have to be cut. If the distances
          -- of the segments differ (@uneven@), the part that is cut off from each line has to lie
          -- beside the other line. If all distances are equal, this is not required, because the
          -- cutter's centre cannot reach any point of that part.
          needed
            | uneven = max cut (if dt > 0 then abs (d * cr) else abs d)
            | otherwise = cut
      {-# INLINE joint #-}
      put !k !x !y !b !m !s = do
        writePrimArray rx k x
        writePrimArray ry k y
        writePrimArray rb k b
        writePrimArray rm k (m :: Word8)
        writePrimArray rs k (indexPrimArray (ClosedPolyarcs.sources c) s)
      -- Writes segment @i@ and all later segments of the polyarc, from index @k@ on. The next
      -- arguments are the segment's directions at its start and its end, and its chord's length
      -- @l@. @cut@ is the length cut off at the segment's start, @beginMark@ the mark of a smooth
      -- start, and @closing@ the joint at the end of the polyarc.
      go !i !k !sx !sy !ex !ey !l !cut !beginMark closing
        | i == e - 1 = case closing () of
          (kind, bend, back) ->
            segment i a k sx sy ex ey l cut back beginMark kind bend $ \k' _ -> pure k'
        | otherwise =
          endDirections c (i + 1) $ \sx' sy' ex' ey' l' -> do
            let kept = if i + 1 == e - 1 then case closing () of (_, _, back) -> l' - back else l'
            joint i (i + 1) ex ey sx' sy' (if l < l' then l else l') (l - cut) kept $
              \kind bend cut' ->
                do
                  markSmooth (i + 1) kind
                  segment i (i + 1) k sx sy ex ey l cut cut' beginMark kind bend $ \k' beginMark' ->
                    go (i + 1) k' sx' sy' ex' ey' l' cut' beginMark' closing
      -- Writes segment @i@ and its joint to segment @j@. @cut@ and @cut'@ are the lengths cut off
      -- at the start and the end of segment @i@. @kind@ is the kind of the joint, and @bend@ is
      -- tan(θ/4) of an outer corner that turns by θ. @next@ gets the next free index, and the mark
      -- of segment @j@ if it starts smoothly, else 0.
      segment !i !j !k !sx !sy !ex !ey !l !cut !cut' !beginMark kind !bend next = do
        let d = distance i
            b = bulge i
            x = indexPrimArray (ClosedPolyarcs.xs c) i + d * sy + cut * sx
            y = indexPrimArray (ClosedPolyarcs.ys c) i - d * sx + cut * sy
            vx = indexPrimArray (ClosedPolyarcs.xs c) (i + 1)
            vy = indexPrimArray (ClosedPolyarcs.ys c) (i + 1)
            fx = vx + d * ey
            fy = vy - d * ex
            -- An arc whose centre is on the left grows when it moves to the right.
            isLongEnough =
              if b == 0
                then l - cut - cut' > tolerance
                else abs (l + 4 * d * b / (1 + b * b)) > tolerance
            k1 = if isLongEnough then k + 1 else k
            endMark = if isLongEnough then ClosedPolyarcs.smoothMark else 0
        if isLongEnough then put k x y b beginMark i else pure ()
        case kind of
          Smooth -> next k1 endMark
          Step -> put k1 fx fy 0 ClosedPolyarcs.aroundMark i >> next (k1 + 1) 0
          Trimmed -> next k1 0
          -- If the distances of the segments differ, a straight line from segment to segment could
          -- cross the material and come out on its other side. Two lines that meet at the vertex
          -- cannot.
          Over
            | uneven ->
              put k1 fx fy 0 ClosedPolyarcs.connectingMark i
                >> put (k1 + 1) vx vy 0 ClosedPolyarcs.connectingMark i
                >> next (k1 + 2) 0
            | otherwise -> put k1 fx fy 0 ClosedPolyarcs.connectingMark i >> next (k1 + 1) 0
          Outer -> do
            let dj = distance j
                radius = if abs (corner j) > abs (corner i) then corner j else corner i
            k2 <-
              if radius == d
                then pure k1
                else put k1 fx fy 0 ClosedPolyarcs.aroundMark i >> pure (k1 + 1)
            let gx = vx + radius * ey
                gy = vy - radius * ex
                endMark' = (if radius == d then endMark else 0) + ClosedPolyarcs.aroundMark
            -- With bend = tan(θ/4), both tangents intersect at radius·tan(θ/2) from the arc's ends.
            k3 <-
              if corners == Sharp && abs bend <= tan (pi / 6) + 1e-9 && d == dj
                then do
                  let out = abs (radius * 2 * bend / (1 - bend * bend))
                  put k2 gx gy 0 endMark' i
                  put (k2 + 1) (gx + out * ex) (gy + out * ey) 0 ClosedPolyarcs.aroundMark i
                  pure (k2 + 2)
                else put k2 gx gy bend endMark' i >> pure (k2 + 1)
            if radius == dj
              then next k3 (if corners == Sharp && d == dj then 0 else ClosedPolyarcs.smoothMark)
              else do
                -- The direction after the corner is the direction before it, rotated by θ.
                let p = (1 - bend * bend) / (1 + bend * bend)
                    q = 2 * bend / (1 + bend * bend)
                    co = p * p - q * q
                    si = 2 * p * q
                    ex' = ex * co - ey * si
                    ey' = ey * co + ex * si
                put k3 (vx + radius * ey') (vy - radius * ex') 0 ClosedPolyarcs.aroundMark i
                next (k3 + 1) 0
      {-# INLINE segment #-}
{-# INLINE offsetPolyarc #-}

-- | The largest sine of the angle between the two segments at a cusp.
cuspSine :: Double
cuspSine = let Rad angle = Tolerance.cuspAngle in sin angle

-- | Passes five numbers to the continuation @k@: the direction at the start of segment @i@, x and
-- y; the direction at its end, x and y; and the length of its chord in mm. The directions have the
-- length 1, and deviate from the chord by half the sweep.
endDirections ::
  ClosedPolyarcs -> Int -> (Double -> Double -> Double -> Double -> Double -> r) -> r
endDirections c i k =
  ClosedPolyarcs.chord c i $ \dx dy ->
    let l = sqrt (dx * dx + dy * dy)
        ux = dx / l
        uy = dy / l
        b = indexPrimArray (ClosedPolyarcs.bulges c) i
     in if b == 0
          then k ux uy ux uy l
          else
            let q = 1 / (1 + b * b)
                co = (1 - b * b) * q
                si = 2 * b * q
             in k
                  (ux * co + uy * si)
                  (uy * co - ux * si)
                  (ux * co - uy * si)
                  (uy * co + ux * si)
                  l
{-# INLINE endDirections #-}
