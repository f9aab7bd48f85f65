-- The loops carry more than ten numbers. The option -fmax-worker-args keeps these unboxed.
{-# OPTIONS_GHC -O2 -fmax-worker-args=40 #-}

-- | Radial deviation of the arc in a frame from the exact arc.
--
-- The rounded ends of an arc usually have different distances from the rounded centre. So the
-- radius at the end differs from that at the beginning. A control keeps the radius of the
-- beginning, changes it linearly to that of the end, or at worst jumps to it at any point. All
-- three cases are measured.
module Frame.Arc.Deviation
  ( FrameArc (..),
    ArcDeviation (..),
    deviationOf,
    sampledDeviation,
    deviationAtEnds,
    linearErrorAt,
    roundingError,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List (foldl')
import Data.Maybe (fromMaybe)
import Frame.Arc.Context (ArcTolerance (inwards, outwards))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec

-- | Arc of a frame together with the exact circle, in mm and radians.
data FrameArc = FrameArc
  { -- | centre of the frame's arc
    centreX :: Double,
    centreY :: Double,
    -- | vector from the centre of the frame's arc to its beginning
    startX :: Double,
    startY :: Double,
    -- | radii of the frame's arc at its beginning and at its end
    startRadius :: Double,
    endRadius :: Double,
    -- | sweep of the frame's arc in radians, positive counter-clockwise
    turned :: Double,
    -- | centre and radius of the exact circle
    exactX :: Double,
    exactY :: Double,
    exactRadius :: Double
  }

-- | The exact arc and a frame's arc in one record. Nothing if either of them is a line.
frameArcOf :: Segment -> Segment -> Maybe FrameArc
frameArcOf exact ofFrame = case (exact, ofFrame) of
  (Arc {start = p, centre = c}, Arc {start = a, end = b, centre = m, sweep = Rad turned}) ->
    let Mm exactRadius = Segment.radius c p
        Mm startRadius = Vec.distance m a
        Mm endRadius = Vec.distance m b
     in Just
          FrameArc
            { centreX = Vec.x m,
              centreY = Vec.y m,
              startX = Vec.x a - Vec.x m,
              startY = Vec.y a - Vec.y m,
              startRadius,
              endRadius,
              turned,
              exactX = Vec.x c,
              exactY = Vec.y c,
              exactRadius
            }
  _ -> Nothing

-- | Largest radial deviations of a frame's arc from the exact circle, in mm.
data ArcDeviation = ArcDeviation
  { -- | distance on either side, if the control keeps the radius of the beginning, or changes it
    -- linearly to that of the end
    linear :: Double,
    -- | distance towards the centre, even if the control jumps from the radius of the beginning to
    -- that of the end at any point
    inward :: Double,
    -- | distance away from the centre, under the same condition as 'inward'
    outward :: Double
  }

-- | Deviation of a frame's arc, the last argument, from the exact arc; 0 if either of them is a
-- line. @tolerance@ only selects the method of computation: the quick 'deviationAtEnds' if it gives
-- a result, otherwise 'sampledDeviation'.
deviationOf :: ArcTolerance -> Segment -> Segment -> ArcDeviation
deviationOf tolerance exact ofFrame =
  maybe
    (ArcDeviation 0 0 0)
    (\arc -> fromMaybe (sampledDeviation arc) (deviationAtEnds tolerance arc))
    (frameArcOf exact ofFrame)

-- | Deviation at the ends of an arc, if it is provably the largest deviation of the whole arc and
-- less than both tolerances 'inwards' and 'outwards'. Otherwise Nothing.
--
-- The centre of the frame's arc lies at the distance v from the exact centre, and the sweep is φ.
-- Between the ends, the deviation differs by up to @φ²·v/8@ from the linear interpolation of the
-- deviations at both ends. The bound used here is twice as large, to cover the terms of second
-- order in v.
deviationAtEnds :: ArcTolerance -> FrameArc -> Maybe ArcDeviation
deviationAtEnds tolerance arc
  | abs (turned arc) < 1
      && off < startRadius arc / 8
      && perpendicular 0 * perpendicular 1 > 0
      && abs (linear a - linear b) > 8 * interpolationError
      && max (inward d) (outward d) + interpolationError < smaller =
    Just d
  | otherwise = Nothing
  where
    a = deviationAt arc 0
    b = deviationAt arc 1
    d = larger a b
    asideX = centreX arc - exactX arc
    asideY = centreY arc - exactY arc
    off = abs asideX + abs asideY
    interpolationError = turned arc * turned arc * off / 4 + roundingError
    Mm smaller = min (inwards tolerance) (outwards tolerance)
    -- Cross product of two vectors: from the centre of the frame's arc to its point at the fraction
    -- @t@ of the sweep, and from the exact centre to the centre of the frame's arc. Where the
    -- radial deviation is extreme, both vectors are parallel and the product changes its sign. So
    -- equal signs at both ends mean that there is no extreme between them.
    perpendicular t =
      let (c, s) = (cos (t * turned arc), sin (t * turned arc))
       in (c * startX arc - s * startY arc) * asideY - (c * startY arc + s * startX arc) * asideX

-- | Upper bound in mm for the error that the rounding of doubles causes in a computed deviation.
roundingError :: Double
roundingError = 1e-9

-- | Largest one of the deviations at certain points of the arc, field by field. These are the
-- beginning, every eighth of the sweep, and the points that are nearest to and furthest from the
-- exact centre.
sampledDeviation :: FrameArc -> ArcDeviation
sampledDeviation arc =
  foldl'
    (\d t -> larger d (deviationAt arc t))
    (foldl' (\d t -> larger d (deviationAt arc t)) (deviationAt arc 0) eighths)
    extremes
  where
    out = Vec.vec (startX arc) (startY arc)
    aside = Vec.vec (centreX arc - exactX arc) (centreY arc - exactY arc)
    Rad toward = Vec.signedAngle out aside
    share angle =
      let t = angle * signum (turned arc) in (if t < 0 then t + 2 * pi else t) / abs (turned arc)
    extremes =
      if Vec.norm aside > 0
        then filter (< 1) [share toward, share (if toward > 0 then toward - pi else toward + pi)]
        else []

-- | The larger one of two deviations, field by field.
larger :: ArcDeviation -> ArcDeviation -> ArcDeviation
larger (ArcDeviation a b d) (ArcDeviation a' b' d') = ArcDeviation (max a a') (max b b') (max d d')

-- | Fractions of the sweep, besides 0, at which the deviation is computed.
eighths :: [Double]
eighths = [k / 8 | k <- [1 .. 8]]

-- | Deviation at the fraction @t@ of the sweep, from 0 to 1.
deviationAt :: FrameArc -> Double -> ArcDeviation
deviationAt arc t =
  ArcDeviation
    { linear = max (abs first) (abs between),
      inward = -(min first final),
      outward = max first final
    }
  where
    first = beyondCircle arc t (startRadius arc)
    between = beyondCircle arc t (startRadius arc + t * (endRadius arc - startRadius arc))
    final = beyondCircle arc t (endRadius arc)

-- | The field 'linear' of 'deviationAt' alone, in mm, for an inner loop that needs no other field.
linearErrorAt :: FrameArc -> Double -> Double
linearErrorAt arc t =
  max
    (abs (beyondCircle arc t (startRadius arc)))
    (abs (beyondCircle arc t (startRadius arc + t * (endRadius arc - startRadius arc))))
{-# INLINE linearErrorAt #-}

-- | Signed distance in mm of a point from the exact circle, positive outside of the circle. The
-- point lies at the fraction @t@ of the sweep, @radius@ mm away from the centre of the frame's arc.
beyondCircle :: FrameArc -> Double -> Double -> Double
beyondCircle
  FrameArc {centreX, centreY, startX, startY, startRadius, turned, exactX, exactY, exactRadius}
  t
  radius =
    sqrt (dx * dx + dy * dy) - exactRadius
    where
      (along, across) = (cos (t * turned), sin (t * turned))
      (vx, vy) = (radius / startRadius * startX, radius / startRadius * startY)
      dx = centreX + (along * vx + across * negate vy) - exactX
      dy = centreY + (along * vy + across * vx) - exactY
{-# INLINE beyondCircle #-}
