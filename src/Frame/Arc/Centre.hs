{-# OPTIONS_GHC -O2 #-}

-- | Grid points that are tried as centres of a rounded arc. A grid point is a position in whole
-- pulses.
module Frame.Arc.Centre
  ( nearCentres,
    remoteCentres,
    isOneFrame,
  )
where

import Base.PulseVector (Pulses2 (..), xy)
import Base.Quantity (Mm (..), Pulses (..))
import Frame.Arc.Context (ArcContext (..), ArcTolerance (linearError), Grid (..), RoundedArc (..))
import Frame.Arc.Context qualified as Context
import Frame.Arc.Estimate qualified as Estimate
import Frame.Arc.Quadrant qualified as Quadrant
import Geometry.Vec qualified as Vec
import Machine.Machine (Arcs (..))
import Machine.Machine qualified as Machine

-- | Grid points near the exact centre of the arc, and near a second point. The second point is
-- equally far from both rounded ends, and of all such points it is nearest to the exact centre. A
-- full circle has no second point.
nearCentres :: ArcContext -> RoundedArc -> [Pulses2]
nearCentres context arc
  | begin arc == finish arc = around (nearest (centre arc))
  | otherwise =
    let first = nearest (centre arc)
     in around first <> filter (not . isBeside first) (around (nearest equidistant))
  where
    nearest c = xy (Context.roundedPoint context c)
    around c = map (c +) neighbours
    isBeside = isWithin nearReach
    a = Context.gridPoint (grid context) (xy (begin arc))
    b = Context.gridPoint (grid context) (xy (finish arc))
    -- The exact centre, moved onto the perpendicular bisector of the rounded ends.
    equidistant =
      let u = Vec.unit (Vec.to a b)
          c = centre arc
       in Vec.shift (Vec.scale (Vec.dot u (Vec.to c (Vec.interpolate 0.5 a b))) u) c

-- | Distance in pulses, in x and in y, up to which grid points are tried about a point.
nearReach :: Pulses
nearReach = 2

neighbours :: [Pulses2]
neighbours = square nearReach

-- | Grid points up to @most@ pulses from zero, in x and in y.
square :: Pulses -> [Pulses2]
square most = [Pulses2 di dj | di <- [-most .. most], dj <- [-most .. most]]

-- | True for two grid points that are at most @most@ pulses apart, in x and in y.
isWithin :: Pulses -> Pulses2 -> Pulses2 -> Bool
isWithin most (Pulses2 i j) (Pulses2 k l) = abs (i - k) <= most && abs (j - l) <= most

-- | Grid points that are tried when none of 'nearCentres' gives steps within the tolerance. In x or
-- in y they are more than 'nearReach' pulses away from the grid point nearest to the exact centre.
-- About each of them the whole arc is one frame, and the middle of this frame's arc is within the
-- tolerance of the exact arc.
--
-- The following bound limits the search. Consider an arc of the sweep 2h with a fixed start. Its
-- centre is displaced by n towards the middle of the arc, and by t at right angles to n, towards
-- its end. This displaces the middle outwards by @(1 − cos h)·n + sin h·t@ and the end by
-- @2·sin h·t@. The deviation at each of these points is the displacement plus the rounding of the
-- start. So for a deviation within the tolerance, each displacement is at most the sum of the
-- tolerance and the rounding of the start. For the end this means that @sin h·t@ is at most half of
-- this sum in size. So for the middle, @(1 − cos h)·n@ is at most 3/2 of the sum.
remoteCentres :: ArcContext -> RoundedArc -> [Pulses2]
remoteCentres context arc
  | begin arc == finish arc = []
  | otherwise =
    [ c
      | c <- map (first +) (square (min remoteReach (Pulses reach))),
        not (isWithin nearReach first c),
        isOneFrame context arc c,
        errorInMiddle c <= most
    ]
  where
    first = xy (Context.roundedPoint context (centre arc))
    Mm most = linearError (tolerance context)
    reach =
      ceiling
        ( min
            1000
            ( 1.5 * (most / pulse (grid context) + sqrt 0.5)
                / (1 - cos (min pi (abs (sweep arc / 2))))
            )
        )
    errorInMiddle = Estimate.errorInMiddle (grid context) arc

-- | Largest distance in pulses of 'remoteCentres' from the exact centre, in x and in y. For an arc
-- of small sweep even more distant grid points are suitable, but there are enough within this
-- distance.
remoteReach :: Pulses
remoteReach = 8

-- | True when one frame can hold the whole arc about the grid point @c@.
isOneFrame :: ArcContext -> RoundedArc -> Pulses2 -> Bool
isOneFrame context arc c = case Machine.arcs (machine (grid context)) of
  NoArcs -> False
  Arcs {Machine.quadrants} ->
    not quadrants
      || Quadrant.isInQuadrant (sense arc) (xy (begin arc) - c) (xy (finish arc) - c)
