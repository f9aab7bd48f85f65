-- The loops carry more than ten numbers. The option -fmax-worker-args keeps these unboxed.
{-# OPTIONS_GHC -O2 -fmax-worker-args=40 #-}

-- | Quick estimates of the deviation of an arc about a grid point, so that most grid points are
-- rejected without the exact computation in "Frame.Arc.Deviation". The deviation is the distance of
-- the rounded arc from the exact circle. A rounded arc has different radii at its beginning and at
-- its end. The estimates are for controls that keep the radius of the beginning, or change it
-- linearly to that of the end; a jump of the radius is not estimated.
module Frame.Arc.Estimate
  ( ArcEnds,
    endsOf,
    estimate,
    estimateError,
    errorAtBegin,
    frameArcAbout,
    errorInMiddle,
  )
where

import Base.PulseVector (Pulses2 (..), xy)
import Base.Quantity (Mm (..), Pulses (..), Rad (..))
import Frame.Arc.Context (Grid (pulseX, pulseY), RoundedArc (..))
import Frame.Arc.Context qualified as Context
import Frame.Arc.Deviation (FrameArc (FrameArc))
import Frame.Arc.Deviation qualified as Deviation
import Geometry.Carrier (Sense)
import Geometry.Carrier qualified as Carrier
import Geometry.Vec qualified as Vec

-- | Rounded ends of an arc and its exact circle, and vectors for the estimates. All lengths are in
-- mm.
data ArcEnds = ArcEnds
  { -- | size of a pulse along x and along y
    stepX :: Double,
    stepY :: Double,
    -- | the rounded ends
    beginX :: Double,
    beginY :: Double,
    finishX :: Double,
    finishY :: Double,
    -- | centre and radius of the exact circle
    exactX :: Double,
    exactY :: Double,
    exactRadius :: Double,
    -- | distances of the rounded ends from the exact circle, positive outside
    beginError :: Double,
    finishError :: Double,
    -- | the vector @u − u₀@ of 'estimate' for the middle of the arc: the unit vector from the exact
    -- centre to this middle, minus the unit vector from the exact centre to the rounded start
    halfX :: Double,
    halfY :: Double,
    -- | the vector @u − u₀@ of 'estimate' for the end of the arc: the unit vector from the exact
    -- centre to the rounded end, minus the unit vector from the exact centre to the rounded start
    wholeX :: Double,
    wholeY :: Double
  }

-- | Ends of an arc for the estimates; Nothing if both are the same grid point, because the
-- estimates do not hold for a full circle.
endsOf :: Grid -> RoundedArc -> Maybe ArcEnds
endsOf grid arc
  | begin arc == finish arc = Nothing
  | otherwise =
    Just
      ArcEnds
        { stepX = pulseX grid,
          stepY = pulseY grid,
          beginX = Vec.x a,
          beginY = Vec.y a,
          finishX = Vec.x b,
          finishY = Vec.y b,
          exactX = Vec.x (centre arc),
          exactY = Vec.y (centre arc),
          exactRadius,
          beginError = toA - exactRadius,
          finishError = toB - exactRadius,
          halfX = Vec.dot (Vec.vec 1 0) half,
          halfY = Vec.dot (Vec.vec 0 1) half,
          wholeX = Vec.dot (Vec.vec 1 0) whole,
          wholeY = Vec.dot (Vec.vec 0 1) whole
        }
  where
    a = Context.gridPoint grid (xy (begin arc))
    b = Context.gridPoint grid (xy (finish arc))
    from = Vec.unit (Vec.to (centre arc) a)
    half = Vec.add (Vec.rotate (Rad (sweep arc / 2)) from) (Vec.negate from)
    whole = Vec.add (Vec.unit (Vec.to (centre arc) b)) (Vec.negate from)
    Mm exactRadius = radius arc
    Mm toA = Vec.distance (centre arc) a
    Mm toB = Vec.distance (centre arc) b

-- | Estimated deviation in mm of an arc about the grid point (@i@, @j@). It is the largest of three
-- deviations. Two are those at the middle and at the end, if the control keeps the radius of the
-- beginning. The third is that at the middle, if the control changes the radius linearly.
--
-- The exact radius at a point of the arc has the direction u. About a centre that is off by a
-- vector v, the deviation at this point is @e + v·(u − u₀)@. Here e is the deviation at the
-- beginning and u₀ the direction there. Terms of second order in v are neglected.
estimate :: ArcEnds -> Pulses2 -> Double
estimate
  ArcEnds {stepX, stepY, exactX, exactY, beginError, finishError, halfX, halfY, wholeX, wholeY}
  (Pulses2 (Pulses i) (Pulses j)) =
    larger between (larger (abs half) (abs whole))
    where
      x = fromIntegral i * stepX - exactX
      y = fromIntegral j * stepY - exactY
      half = beginError + x * halfX + y * halfY
      whole = beginError + x * wholeX + y * wholeY
      -- If the radius changes linearly, the radius at the middle is larger than at the beginning by
      -- half the difference between the radii at the end and at the beginning.
      between = abs (half + 0.5 * (finishError - whole))
      larger a b = if a > b then a else b
{-# INLINE estimate #-}

-- | Largest amount in mm by which the true deviation about the grid point (@i@, @j@) can be less
-- than 'estimate'.
estimateError :: ArcEnds -> Pulses2 -> Double
estimateError ArcEnds {stepX, stepY, exactX, exactY, exactRadius} (Pulses2 (Pulses i) (Pulses j)) =
  (if 8 * off < exactRadius then 4 else 16) * off * off / exactRadius + Deviation.roundingError
  where
    off =
      abs (fromIntegral i * stepX - exactX)
        + abs (fromIntegral j * stepY - exactY)
        + stepX
        + stepY
{-# INLINE estimateError #-}

-- | Exact deviation in mm at the beginning of an arc about the grid point (@i@, @j@). It equals the
-- result of 'Frame.Arc.Deviation.linearErrorAt' at the fraction 0 of the sweep, to the last digit.
errorAtBegin :: ArcEnds -> Pulses2 -> Double
errorAtBegin
  ArcEnds {stepX, stepY, beginX, beginY, exactX, exactY, exactRadius}
  (Pulses2 (Pulses i) (Pulses j)) =
    abs (sqrt (x * x + y * y) - exactRadius)
    where
      mx = fromIntegral i * stepX
      my = fromIntegral j * stepY
      x = mx + (beginX - mx) - exactX
      y = my + (beginY - my) - exactY
{-# INLINE errorAtBegin #-}

-- | The whole arc about the grid point (@i@, @j@) as the arc of one frame.
frameArcAbout :: ArcEnds -> Sense -> Pulses2 -> FrameArc
frameArcAbout
  ArcEnds {stepX, stepY, beginX, beginY, finishX, finishY, exactX, exactY, exactRadius}
  sense
  (Pulses2 (Pulses i) (Pulses j)) =
    FrameArc
      { Deviation.centreX,
        Deviation.centreY,
        Deviation.startX,
        Deviation.startY,
        Deviation.startRadius = sqrt (startX * startX + startY * startY),
        Deviation.endRadius = sqrt (endX * endX + endY * endY),
        Deviation.turned,
        Deviation.exactX,
        Deviation.exactY,
        Deviation.exactRadius
      }
    where
      centreX = fromIntegral i * stepX
      centreY = fromIntegral j * stepY
      startX = beginX - centreX
      startY = beginY - centreY
      endX = finishX - centreX
      endY = finishY - centreY
      short = atan2 (startX * endY - startY * endX) (startX * endX + startY * endY)
      Rad turned = Carrier.sweepInSense sense (Rad short)
{-# INLINE frameArcAbout #-}

-- | Exact deviation in mm in the middle of an arc about a grid point. It is the larger one of two
-- deviations: for a control that keeps the radius of the beginning, and for a control that changes
-- it linearly. No trigonometry is needed: seen from the grid point, the direction to the middle is
-- square to the difference of the unit directions to the two ends. Apply the first two arguments
-- once, and the result to many grid points.
errorInMiddle :: Grid -> RoundedArc -> Pulses2 -> Double
errorInMiddle grid arc =
  let a = Context.gridPoint grid (xy (begin arc))
      b = Context.gridPoint grid (xy (finish arc))
      exactCentre = centre arc
      sign = -(Carrier.senseSign (sense arc))
      Mm r = radius arc
   in \c ->
        let m = Context.gridPoint grid c
            toA = Vec.to m a
            toB = Vec.to m b
            first = Vec.norm toA
            final = Vec.norm toB
            chord = Vec.unit (Vec.add (Vec.scale (-1 / first) toA) (Vec.scale (1 / final) toB))
            toMiddle = Vec.scale sign (Vec.left chord)
            off radiusThere =
              let Mm d = Vec.distance exactCentre (Vec.shift (Vec.scale radiusThere toMiddle) m)
               in abs (d - r)
         in max (off first) (off ((first + final) / 2))
