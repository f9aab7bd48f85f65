{-# LANGUAGE BangPatterns #-}
{-# OPTIONS_GHC -O2 -fno-full-laziness #-}

-- | Intersections of two segments (lines and arcs). They are of three kinds: the segments cross
-- between their ends; an end of one lies on the other; the segments touch between their ends. The
-- latter two are decided within a tolerance. The caller's 'Visitor' has an action for each kind.
--
-- Arcs are handled through the power of a point with respect to their circle
-- ("Geometry.ClosedPolyarcs"); the circle's centre is not needed. In all functions @tolerance@ (mm)
-- covers rounding, and @c@ contains the segments and vertices, which are given by number. Vertex
-- @i@ is the start of segment @i@, and vertex @i + 1@ is its end. A position along a chord is a
-- fraction from 0 to 1. Neighbours are segments that share a vertex.
module Offset.SegmentIntersection
  ( Visitor (..),
    meet,
  )
where

import Control.Monad (unless, when)
import Control.Monad.ST (ST)
import Data.Primitive.PrimArray
import Geometry.ClosedPolyarcs (ClosedPolyarcs)
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs

-- | The actions for each kind of intersection. Segments and vertices are given by number.
data Visitor s = Visitor
  { -- | for two segments that cross between their ends: the first segment and the crossing's
    -- position along its chord, as a fraction; the same for the second segment; x and y of the
    -- crossing in mm; and a number with the sign of the cross product of both directions. The sign
    -- is positive when the second segment crosses to the left of the first
    crossing :: Int -> Double -> Int -> Double -> Double -> Double -> Double -> ST s (),
    -- | for an end that lies on a segment: the segment, and the vertex at that end
    resting :: Int -> Int -> ST s (),
    -- | for two segments that touch between their ends: both segments, x and y of the point in mm
    touching :: Int -> Int -> Double -> Double -> ST s ()
  }

-- | Reports the intersections of two different segments to @visitor@. It leaves out the vertex that
-- neighbours share, and a second intersection that rounding hides ('isThin'). The number of the
-- first segment is less than that of the second.
meet :: Double -> ClosedPolyarcs -> Visitor s -> Int -> Int -> ST s ()
meet !tolerance !c visitor = pair
  where
    pair !i !j
      | j == i + 1 = unless (meetsOnlyAtJoint tolerance c i j) (adjacent tolerance c visitor i j)
      | mark ClosedPolyarcs.firstMark i && mark ClosedPolyarcs.lastMark j =
        adjacent tolerance c visitor i j
      | otherwise = others i j
    others = unconnected tolerance c visitor
    mark m k = ClosedPolyarcs.hasMark m (indexPrimArray (ClosedPolyarcs.marks c) k)
{-# INLINE meet #-}

-- | True for neighbours @i@ and @j@ that certainly meet at their common vertex only, so that 'meet'
-- skips the exact test. Their joint is smooth, or both are lines that do not fold back. False when
-- segment @i@ begins a polyarc, because both segments may then have their other ends in common as
-- well.
meetsOnlyAtJoint :: Double -> ClosedPolyarcs -> Int -> Int -> Bool
meetsOnlyAtJoint tolerance c i j
  | ClosedPolyarcs.hasMark ClosedPolyarcs.firstMark (indexPrimArray (ClosedPolyarcs.marks c) i) =
    False
  | isArc c i || isArc c j =
    ClosedPolyarcs.hasMark ClosedPolyarcs.smoothMark (indexPrimArray (ClosedPolyarcs.marks c) j)
  | otherwise =
    ClosedPolyarcs.chord
      c
      i
      (\ux uy -> ClosedPolyarcs.chord c j (\vx vy -> not (foldsBack tolerance ux uy vx vy)))
{-# INLINE meetsOnlyAtJoint #-}

-- | True when the chord (@vx@, @vy@) folds back onto the chord (@ux@, @uy@) that precedes it: the
-- far end of the shorter chord lies on the longer one, within the tolerance (mm).
foldsBack :: Double -> Double -> Double -> Double -> Double -> Bool
foldsBack tolerance ux uy vx vy =
  ux * vx + uy * vy < 0 && cross * cross <= tolerance * tolerance * (if uu > vv then uu else vv)
  where
    cross = ux * vy - uy * vx
    uu = ux * ux + uy * uy
    vv = vx * vx + vy * vy
{-# INLINE foldsBack #-}

-- | True of a segment that is an arc.
isArc :: ClosedPolyarcs -> Int -> Bool
isArc c k = indexPrimArray (ClosedPolyarcs.bulges c) k /= 0
{-# INLINE isArc #-}

-- | Reports the intersections of segments @i@ and @j@, which may be neighbours: @j@ is @i + 1@, or
-- @i@ is the first segment of a polyarc and @j@ the last one of this or another polyarc.
adjacent :: Double -> ClosedPolyarcs -> Visitor s -> Int -> Int -> ST s ()
adjacent !tolerance !c visitor !i !j
  | after && before = when (isArc c i || isArc c j) (sharingEnds tolerance c visitor i j)
  | after = neighbours tolerance c visitor i j (i + 1)
  | before = neighbours tolerance c visitor j i i
  | otherwise = unconnected tolerance c visitor i j
  where
    -- True when segment @j@ begins where segment @i@ ends. 'before' is True when segment @j@ ends
    -- where segment @i@ begins.
    after = j == i + 1
    mark m k = ClosedPolyarcs.hasMark m (indexPrimArray (ClosedPolyarcs.marks c) k)
    before =
      mark ClosedPolyarcs.firstMark i
        && mark ClosedPolyarcs.lastMark j
        && mark ClosedPolyarcs.repeatedMark (j + 1)
        && at (ClosedPolyarcs.xs c)
        && at (ClosedPolyarcs.ys c)
    at a = indexPrimArray a (j + 1) == indexPrimArray a i
{-# NOINLINE adjacent #-}

-- | Reports the intersections of two segments that are not neighbours. It is inlined, so that the
-- compiler specialises it for each @visitor@.
unconnected :: Double -> ClosedPolyarcs -> Visitor s -> Int -> Int -> ST s ()
unconnected !tolerance !c visitor = pair
  where
    pair !i !j
      | isArc c i = if isArc c j then arcsBySize i j else lineAndArc j i
      | isArc c j = lineAndArc i j
      | otherwise = lines' tolerance c visitor i j
    lineAndArc !i !j =
      unless
        (isDisjoint tolerance c i j)
        (lineArc tolerance c visitor (crossingAlong c visitor i j) i j)
    arcsBySize !i !j =
      if ClosedPolyarcs.diameter c i <= ClosedPolyarcs.diameter c j then bySize i j else bySize j i
    bySize !i !j = arcs tolerance c visitor (crossingAt c visitor i j) i j
{-# INLINE unconnected #-}

-- | Reports the intersections of lines @i@ and @j@, which are not neighbours.
lines' :: Double -> ClosedPolyarcs -> Visitor s -> Int -> Int -> ST s ()
lines' !tolerance !c visitor !i !j =
  ClosedPolyarcs.chord c i $ \ux uy -> ClosedPolyarcs.chord c j $ \vx vy -> do
    let x i' = indexPrimArray (ClosedPolyarcs.xs c) i'
        y i' = indexPrimArray (ClosedPolyarcs.ys c) i'
        !wx = x j - x i
        !wy = y j - y i
        -- Signed distance of each end from the other line, times the length of the other line.
        !startJ = ux * wy - uy * wx
        !den = ux * vy - uy * vx
        !endJ = startJ + den
        !startI = wx * vy - wy * vx
        !endI = startI - den
        -- Bounds of these products for ends within the tolerance of line @i@, and of line @j@. They
        -- are a little too large: |x| + |y| is used as the length of a line.
        !nearU = tolerance * (abs ux + abs uy)
        !nearV = tolerance * (abs vx + abs vy)
        areApart a b near = if a > 0 then a > near && b > near else a < -near && b < -near
        crosses = do
          let !s = startI / den
              !t = -(startJ / den)
              !px = x i + s * ux
              !py = y i + s * uy
          crossing visitor i s j t px py den
    unless (areApart startJ endJ nearU || areApart startI endI nearV) $
      if abs startJ > nearU && abs endJ > nearU && abs startI > nearV && abs endI > nearV
        || not (eitherRests tolerance c i j) && startJ * endJ < 0 && startI * endI < 0
        then crosses
        else rests tolerance c visitor i j
{-# INLINE lines' #-}

-- | Reports the ends of each of the segments @i@ and @j@ that lie on the other one.
rests :: Double -> ClosedPolyarcs -> Visitor s -> Int -> Int -> ST s ()
rests !tolerance !c visitor !i !j = do
  when (liesOn tolerance c j i) (resting visitor j i)
  when (liesOn tolerance c j (i + 1)) (resting visitor j (i + 1))
  when (liesOn tolerance c i j) (resting visitor i j)
  when (liesOn tolerance c i (j + 1)) (resting visitor i (j + 1))

-- | True when an end of segment @i@ lies on segment @j@, or an end of @j@ on @i@.
eitherRests :: Double -> ClosedPolyarcs -> Int -> Int -> Bool
eitherRests tolerance c i j =
  liesOn tolerance c i j
    || liesOn tolerance c i (j + 1)
    || liesOn tolerance c j i
    || liesOn tolerance c j (i + 1)

-- | True when vertex @k@ lies on segment @i@, within the tolerance (mm).
liesOn :: Double -> ClosedPolyarcs -> Int -> Int -> Bool
liesOn !tolerance !c !i !k =
  ClosedPolyarcs.chord c i $ \ux uy ->
    let px = indexPrimArray (ClosedPolyarcs.xs c) k
        py = indexPrimArray (ClosedPolyarcs.ys c) k
        ax = px - indexPrimArray (ClosedPolyarcs.xs c) i
        ay = py - indexPrimArray (ClosedPolyarcs.ys c) i
        bx = px - indexPrimArray (ClosedPolyarcs.xs c) (i + 1)
        by = py - indexPrimArray (ClosedPolyarcs.ys c) (i + 1)
        b = indexPrimArray (ClosedPolyarcs.bulges c) i
        aside = ux * ay - uy * ax
        along = ux * ax + uy * ay
        square = ux * ux + uy * uy
        atAnEnd =
          ax * ax + ay * ay <= tolerance * tolerance || bx * bx + by * by <= tolerance * tolerance
     in atAnEnd
          || if b == 0
            then aside * aside <= tolerance * tolerance * square && along > 0 && along < square
            else
              aside * b <= 0
                && abs (ClosedPolyarcs.power c i px py)
                  <= tolerance * (ClosedPolyarcs.diameter c i + tolerance)

-- | True when line @i@ and arc @j@ are certainly disjoint, so that the exact test is skipped. The
-- arc lies in a rectangle between its chord and the tangent at its apex. Either the rectangle lies
-- on one side of the line, or the line lies beyond the chord or beyond the tangent.
isDisjoint :: Double -> ClosedPolyarcs -> Int -> Int -> Bool
isDisjoint !tolerance !c !i !j =
  above nearLine arcStart arcEnd rise
    || above nearLine (-arcStart) (-arcEnd) (-rise)
    || (lineStart < -nearChord && lineEnd < -nearChord)
    || (lineStart > height + nearChord && lineEnd > height + nearChord)
  where
    x k = indexPrimArray (ClosedPolyarcs.xs c) k
    y k = indexPrimArray (ClosedPolyarcs.ys c) k
    !b = indexPrimArray (ClosedPolyarcs.bulges c) j
    !ux = x (i + 1) - x i
    !uy = y (i + 1) - y i
    !dx = x (j + 1) - x j
    !dy = y (j + 1) - y j
    !wx = x j - x i
    !wy = y j - y i
    !turning = ux * dy - uy * dx
    -- Twice the signed areas of the triangles that the line forms with each end of the arc. Both
    -- numbers grow by @rise@ when the chord moves to the arc's apex.
    !arcStart = ux * wy - uy * wx
    !arcEnd = arcStart + turning
    !rise = -0.5 * b * (ux * dx + uy * dy)
    -- Twice the signed areas in mm² of the triangles that the chord forms with each end of the
    -- line, positive on the arc's side. @height@ is this number for the arc's apex.
    !sign = if b > 0 then 1 else -1
    !lineStart = sign * (dx * wy - dy * wx)
    !lineEnd = lineStart + sign * turning
    !height = 0.5 * abs b * (dx * dx + dy * dy)
    !nearLine = 2 * tolerance * (abs ux + abs uy)
    !nearChord = 2 * tolerance * (abs dx + abs dy)
    above !limit !p !q !r = p > limit && q > limit && p + r > limit && q + r > limit
    {-# INLINE above #-}
{-# INLINE isDisjoint #-}

-- | Finds the intersections of line @i@ and arc @j@, which are not neighbours. @report@ gets the
-- position of a crossing along the line, as a fraction. The foot of the perpendicular from the
-- arc's start has the position @s0@. At the position @s0 + s@ the power is @aa·s² + 2·half·s + c0@;
-- it is zero at both intersections with the arc's circle.
--
-- The error of a crossing at an angle α is about the tolerance divided by sin α. When a crossing is
-- nearer to an end of a segment than a few such errors, @closely@ examines both crossings.
lineArc :: Double -> ClosedPolyarcs -> Visitor s -> (Double -> ST s ()) -> Int -> Int -> ST s ()
lineArc !tolerance !c visitor report !i !j
  | disc < -verge = pure ()
  | disc <= verge = closely
  | otherwise = do
    let !root = sqrt disc
        !q = if half > 0 then -half - root else root - half
        !blurred = blur root
        !margin = blurred / sqrt aa
        !s1 = s0 + q / aa
        !s2 = s0 + (if half == 0 then -(q / aa) else c0 / q)
        !sure1 = verdict blurred margin s1
        !sure2 = verdict blurred margin s2
    reportCertain closely sure1 (report s1) sure2 (report s2)
  where
    !lx = indexPrimArray (ClosedPolyarcs.xs c) i
    !ly = indexPrimArray (ClosedPolyarcs.ys c) i
    !ux = indexPrimArray (ClosedPolyarcs.xs c) (i + 1) - lx
    !uy = indexPrimArray (ClosedPolyarcs.ys c) (i + 1) - ly
    !aa = ux * ux + uy * uy
    !s0 =
      ( ux * (indexPrimArray (ClosedPolyarcs.xs c) j - lx)
          + uy * (indexPrimArray (ClosedPolyarcs.ys c) j - ly)
      )
        / aa
    !x0 = lx + s0 * ux
    !y0 = ly + s0 * uy
    !half = ClosedPolyarcs.gradient c j x0 y0 (\gx gy -> 0.5 * (gx * ux + gy * uy))
    !c0 = ClosedPolyarcs.power c j x0 y0
    !disc = half * half - aa * c0
    !r = 0.5 * ClosedPolyarcs.diameter c j
    !verge = aa * tolerance * (2 * r + tolerance)
    blur root = 4 * tolerance * (1 + r * sqrt aa / root)
    verdict blurred margin s
      | s < -margin || s > 1 + margin = Passes
      | nearEnds c j blurred px py = Doubtful
      | not (isOnArc c j px py) = Passes
      | s > margin && s < 1 - margin = Crosses
      | otherwise = Doubtful
      where
        !px = lx + s * ux
        !py = ly + s * uy
    {-# INLINE verdict #-}
    -- Reports the intersections when the segments may touch, or an end may lie on the other one.
    closely = do
      let endTouches = eitherRests tolerance c i j
          foot = s0 - half / aa
          footX = lx + foot * ux
          footY = ly + foot * uy
          root = sqrt disc
          q = if half > 0 then -half - root else root - half
          try step = when (s0 + step > 0 && s0 + step < 1) $ do
            let px = lx + (s0 + step) * ux
                py = ly + (s0 + step) * uy
            when
              ( isOnArc c j px py
                  && not
                    ( endTouches
                        && (nearEnds c i (blur root) px py || nearEnds c j (blur root) px py)
                    )
              )
              (report (s0 + step))
      when endTouches (rests tolerance c visitor i j)
      if abs disc <= verge
        then
          when
            (not endTouches && foot > 0 && foot < 1 && isOnArc c j footX footY)
            (touching visitor i j footX footY)
        else try (q / aa) >> try (if half == 0 then -(q / aa) else c0 / q)
{-# INLINE lineArc #-}

-- | Reports the crossing of line @i@ and arc @j@ at the fraction @s@ along the line.
crossingAlong :: ClosedPolyarcs -> Visitor s -> Int -> Int -> Double -> ST s ()
crossingAlong c visitor !i !j !s = ClosedPolyarcs.chord c i $ \ux uy -> do
  let !px = indexPrimArray (ClosedPolyarcs.xs c) i + s * ux
      !py = indexPrimArray (ClosedPolyarcs.ys c) i + s * uy
      !t = parameter c j px py
      !cross = ClosedPolyarcs.gradient c j px py (\gx gy -> signed c j (ux * gx + uy * gy))
  crossing visitor i s j t px py cross
{-# INLINE crossingAlong #-}

-- | Reports the crossing of arcs @i@ and @j@ at the point (@px@, @py@) in mm.
crossingAt :: ClosedPolyarcs -> Visitor s -> Int -> Int -> Double -> Double -> ST s ()
crossingAt c visitor !i !j !px !py = do
  let !s = parameter c i px py
      !t = parameter c j px py
      !cross =
        ClosedPolyarcs.gradient
          c
          i
          px
          py
          ( \ax ay ->
              ClosedPolyarcs.gradient
                c
                j
                px
                py
                (\bx by -> signed c i (signed c j (ax * by - ay * bx)))
          )
  crossing visitor i s j t px py cross
{-# INLINE crossingAt #-}

-- | The verdict on an intersection of two segments' carriers.
data Verdict
  = -- | the intersection is on both segments
    Crosses
  | -- | the intersection is not on both segments
    Passes
  | -- | the intersection is nearer to an end of a segment than rounding allows to decide
    Doubtful
  deriving stock (Eq)

-- | Reports those of two intersections of carriers that are on both segments. @first@ and @second@
-- are the verdicts on them; @reportFirst@ and @reportSecond@ report them. If one of them is
-- doubtful, @closely@ examines both instead.
reportCertain :: ST s () -> Verdict -> ST s () -> Verdict -> ST s () -> ST s ()
reportCertain closely first reportFirst second reportSecond
  | first == Doubtful || second == Doubtful = closely
  | otherwise = when (first == Crosses) reportFirst >> when (second == Crosses) reportSecond
{-# INLINE reportCertain #-}

-- | True when the point (@px@, @py@) lies within @within@ mm of an end of segment @i@.
nearEnds :: ClosedPolyarcs -> Int -> Double -> Double -> Double -> Bool
nearEnds c i within px py = near i || near (i + 1)
  where
    near k =
      let dx = px - indexPrimArray (ClosedPolyarcs.xs c) k
          dy = py - indexPrimArray (ClosedPolyarcs.ys c) k
       in dx * dx + dy * dy <= within * within
{-# INLINE nearEnds #-}

-- | Finds the intersections of arcs @i@ and @j@, which are not neighbours; the circle of @i@ is not
-- the larger one. @report@ gets x and y of a crossing in mm.
arcs ::
  Double ->
  ClosedPolyarcs ->
  Visitor s ->
  (Double -> Double -> ST s ()) ->
  Int ->
  Int ->
  ST s ()
arcs !tolerance !c visitor report !i !j
  | dist <= 4 * tolerance = rests tolerance c visitor i j
  | disc < -verge = pure ()
  | disc <= verge = closely
  | otherwise = do
    let !root = sqrt disc
        !q = if half > 0 then -half - root else root - half
        !blurred = blur root
        !s1 = q / gg
        !s2 = if half == 0 then -(q / gg) else c0 / q
        !sure1 = verdict blurred s1
        !sure2 = verdict blurred s2
    reportCertain closely sure1 (reportAt s1) sure2 (reportAt s2)
  where
    !x0 = indexPrimArray (ClosedPolyarcs.xs c) i
    !y0 = indexPrimArray (ClosedPolyarcs.ys c) i
    -- The difference of the powers of a point with respect to both circles is a linear function of
    -- the point; (gx, gy) is its gradient. The function is zero on the radical axis, which passes
    -- through the intersections of the circles.
    !gx =
      ClosedPolyarcs.gradient
        c
        i
        x0
        y0
        (\ax _ -> ClosedPolyarcs.gradient c j x0 y0 (\bx _ -> ax - bx))
    !gy =
      ClosedPolyarcs.gradient
        c
        i
        x0
        y0
        (\_ ay -> ClosedPolyarcs.gradient c j x0 y0 (\_ by -> ay - by))
    !gg = gx * gx + gy * gy
    !dist = 0.5 * sqrt gg
    -- If the circles overlap by a small δ, half their common chord squared is about 2·opening·δ.
    !opening = 0.5 * ClosedPolyarcs.diameter c i * ClosedPolyarcs.diameter c j / (2 * dist)
    !g0 = -(ClosedPolyarcs.power c j x0 y0)
    -- (lx, ly) is a point of the radical axis. At the point (lx − s·gy, ly + s·gx) of this axis,
    -- the power with respect to the circle of arc @i@ is gg·s² + 2·half·s + c0.
    !lx = x0 - g0 * gx / gg
    !ly = y0 - g0 * gy / gg
    !half = ClosedPolyarcs.gradient c i lx ly (\ax ay -> 0.5 * (ay * gx - ax * gy))
    !c0 = ClosedPolyarcs.power c i lx ly
    !disc = half * half - gg * c0
    !verge = 4 * gg * tolerance * (opening + tolerance)
    blur root = 4 * tolerance * (1 + opening * 2 * dist / root)
    verdict blurred s
      | nearEnds c i blurred px py || nearEnds c j blurred px py = Doubtful
      | isOnArc c i px py && isOnArc c j px py = Crosses
      | otherwise = Passes
      where
        !px = lx - s * gy
        !py = ly + s * gx
    {-# INLINE verdict #-}
    reportAt s = report (lx - s * gy) (ly + s * gx)
    {-# INLINE reportAt #-}
    -- Reports the intersections when the segments may touch, or an end may lie on the other one.
    closely = do
      let endTouches = eitherRests tolerance c i j
          footX = lx + half / gg * gy
          footY = ly - half / gg * gx
          root = sqrt disc
          q = if half > 0 then -half - root else root - half
          try s = do
            let px = lx - s * gy
                py = ly + s * gx
            when
              ( isOnArc c i px py
                  && isOnArc c j px py
                  && not
                    ( endTouches
                        && (nearEnds c i (blur root) px py || nearEnds c j (blur root) px py)
                    )
              )
              (report px py)
      when endTouches (rests tolerance c visitor i j)
      if abs disc <= verge
        then
          when
            (not endTouches && isOnArc c i footX footY && isOnArc c j footX footY)
            (touching visitor i j footX footY)
        else try (q / gg) >> try (if half == 0 then -(q / gg) else c0 / q)
{-# INLINE arcs #-}

-- | Reports the intersections of the neighbours @i@ and @j@ other than their common vertex, whose
-- number is @vertex@.
neighbours :: Double -> ClosedPolyarcs -> Visitor s -> Int -> Int -> Int -> ST s ()
neighbours !tolerance !c visitor !i !j !vertex
  | not (isArc c i) && not (isArc c j) =
    ClosedPolyarcs.chord c i $ \ux uy ->
      ClosedPolyarcs.chord c j $ \vx vy -> when (foldsBack tolerance ux uy vx vy) farEnds
  | ClosedPolyarcs.hasMark ClosedPolyarcs.smoothMark (indexPrimArray (ClosedPolyarcs.marks c) j) =
    pure ()
  | liesOn tolerance c j i || liesOn tolerance c i (j + 1) = farEnds
  | not (isArc c i) = secondOfLineAndArc tolerance c visitor vertex i j
  | not (isArc c j) = secondOfLineAndArc tolerance c visitor vertex j i
  | otherwise = secondOfArcs tolerance c visitor vertex i j
  where
    farEnds = do
      when (liesOn tolerance c j i) (resting visitor j i)
      when (liesOn tolerance c i (j + 1)) (resting visitor i (j + 1))
{-# NOINLINE neighbours #-}

-- | Reports the second intersection of the line @l@ and the arc @arc@, which meet at vertex
-- @vertex@. The line starts at this vertex when @l@ is equal to @vertex@; otherwise the line ends
-- there.
secondOfLineAndArc :: Double -> ClosedPolyarcs -> Visitor s -> Int -> Int -> Int -> ST s ()
secondOfLineAndArc !tolerance !c visitor !vertex !l !arc =
  ClosedPolyarcs.chord c l $ \ux uy -> ClosedPolyarcs.gradient c arc vx0 vy0 $ \gx gy -> do
    let step = -(gx * ux + gy * uy) / (ux * ux + uy * uy)
        s = if l == vertex then step else 1 + step
        px = vx0 + step * ux
        !py = vy0 + step * uy
        hh = (px - vx0) * (px - vx0) + (py - vy0) * (py - vy0)
    when (s > 0 && s < 1 && isOnArc c arc px py) $
      unless (isThin tolerance hh (1 / ClosedPolyarcs.diameter c arc)) $
        crossing
          visitor
          l
          s
          arc
          (parameter c arc px py)
          px
          py
          (ClosedPolyarcs.gradient c arc px py (\hx hy -> signed c arc (ux * hx + uy * hy)))
  where
    vx0 = indexPrimArray (ClosedPolyarcs.xs c) vertex
    vy0 = indexPrimArray (ClosedPolyarcs.ys c) vertex

-- | Reports the second intersection of the arcs @i@ and @j@, which meet at vertex @vertex@.
secondOfArcs :: Double -> ClosedPolyarcs -> Visitor s -> Int -> Int -> Int -> ST s ()
secondOfArcs !tolerance !c visitor !vertex !i !j =
  ClosedPolyarcs.gradient c i vx0 vy0 $ \ax ay ->
    ClosedPolyarcs.gradient c j vx0 vy0 $ \bx by -> do
      let gx = ax - bx
          gy = ay - by
          gg = gx * gx + gy * gy
          -- The second intersection of both circles: the mirror image of the vertex about the line
          -- through both centres.
          k = (ay * gx - ax * gy) / gg
          px = vx0 + k * gy
          py = vy0 - k * gx
          -- If the centres lie on opposite sides of the common chord, the curvatures are added.
          hx = px - vx0
          hy = py - vy0
          bend =
            abs
              ( 1 / ClosedPolyarcs.diameter c i
                  - signum ((hx * ay - hy * ax) * (hx * by - hy * bx))
                    / ClosedPolyarcs.diameter c j
              )
      when
        ( gg > 16 * tolerance * tolerance
            && isOnArc c i px py
            && isOnArc c j px py
            && not (isThin tolerance (hx * hx + hy * hy) bend)
        )
        (crossingAt c visitor i j px py)
  where
    vx0 = indexPrimArray (ClosedPolyarcs.xs c) vertex
    vy0 = indexPrimArray (ClosedPolyarcs.ys c) vertex

-- | True when two segments meet twice within the tolerance (mm), or when the region between them is
-- at most four tolerances wide. Then the second intersection is not reported. @hh@ is the squared
-- distance of the two intersections in mm², and @bend@ half the difference of the curvatures in
-- 1/mm; the width is about @hh·bend/4@.
isThin :: Double -> Double -> Double -> Bool
isThin tolerance hh bend = hh <= tolerance * tolerance || hh * bend <= 16 * tolerance

-- | Finds the intersections of the segments @i@ and @j@, which share both ends and are not both
-- lines. When the segments coincide, the start of @j@ is reported as lying on @i@; otherwise they
-- meet nowhere else.
sharingEnds :: Double -> ClosedPolyarcs -> Visitor s -> Int -> Int -> ST s ()
sharingEnds !tolerance !c visitor !i !j =
  -- The bulge of an arc changes its sign when the arc is reversed.
  ClosedPolyarcs.chord c i $ \ux uy ->
    when
      ( 0.5
          * abs
            ( indexPrimArray (ClosedPolyarcs.bulges c) i
                + indexPrimArray (ClosedPolyarcs.bulges c) j
            )
          * sqrt (ux * ux + uy * uy)
            <= tolerance
      )
      $ resting visitor i j

-- | True when the point (@px@, @py@) of the circle of arc @i@ belongs to the arc, that is, it lies
-- on the arc's side of the chord. Near the ends of a flat arc rounding would decide that. Therefore
-- a point of a flat arc's circle belongs to the arc under two conditions: its foot on the chord
-- lies between the chord's ends, and it is nearer to the chord than the chord is long.
isOnArc :: ClosedPolyarcs -> Int -> Double -> Double -> Bool
isOnArc c i px py = ClosedPolyarcs.chord c i $ \ux uy ->
  let ax = px - indexPrimArray (ClosedPolyarcs.xs c) i
      ay = py - indexPrimArray (ClosedPolyarcs.ys c) i
      b = indexPrimArray (ClosedPolyarcs.bulges c) i
      aside = ux * ay - uy * ax
      along = ux * ax + uy * ay
      square = ux * ux + uy * uy
   in if abs b > 0.1 then aside * b < 0 else along > 0 && along < square && abs aside < square
{-# INLINE isOnArc #-}

-- | The position of the point (@px@, @py@) of segment @i@ along the segment's chord, as a fraction
-- from 0 to 1. It is the position of the foot of the perpendicular from the point to the chord.
parameter :: ClosedPolyarcs -> Int -> Double -> Double -> Double
parameter c i px py = ClosedPolyarcs.chord c i $ \ux uy ->
  ( ux * (px - indexPrimArray (ClosedPolyarcs.xs c) i)
      + uy * (py - indexPrimArray (ClosedPolyarcs.ys c) i)
  )
    / (ux * ux + uy * uy)
{-# INLINE parameter #-}

-- | The number @a@, with its sign changed if segment @i@ is a clockwise arc.
signed :: ClosedPolyarcs -> Int -> Double -> Double
signed c i a = if indexPrimArray (ClosedPolyarcs.bulges c) i < 0 then -a else a
{-# INLINE signed #-}
