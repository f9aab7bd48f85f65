-- | Every small number that the geometry compares with, by name.
module Geometry.Tolerance
  ( coincident,
    smoothAngle,
    parallel,
    clearance,
    slot,
    sameLength,
    smallestFillet,
    sameFillet,
    nearTie,
    bevel,
    smoothGap,
    smoothTurn,
    slightRest,
    smallestCutter,
    equal,
    resolution,
    reach,
    crossing,
    curve,
    arcLength,
    arcLengthShare,
    parameter,
    still,
    straight,
    byControl,
    controlArc,
    controlTurn,
    controlRounding,
    controlLength,
    controlBend,
    controlCut,
    oneArc,
    halfTurn,
    kink,
    rounding,
    tangential,
    deviationShare,
    roundingShare,
    finestStep,
    hair,
  )
where

import Base.Quantity (Mm (..), Rad (..))

-- | Points no further apart are one point. A part 20 m long is held in doubles to 4·10⁻¹² mm;
-- the square roots of the constructions cost half of the digits at worst.
coincident :: Mm
coincident = Mm 1e-6

-- | Two elements whose directions differ by no more go over into one another smoothly.
smoothAngle :: Rad
smoothAngle = Rad 1e-7

-- | Two lines whose directions have no larger sine between them are parallel.
parallel :: Double
parallel = 1e-12

-- | How much nearer than its radius the cutter's centre may come to the part by rounding of
-- doubles. It is above what 'smoothAngle' opens at the radius of a large cutter (50 mm).
clearance :: Mm
clearance = Mm 1e-5

-- | A slot of just the cutter's width that is no longer than half of this does not count.
slot :: Mm
slot = Mm 0.01

-- | Two contours whose lengths differ by no more are equally long: the choice between them is a
-- tie.
sameLength :: Mm
sameLength = Mm 1e-6

-- | A fillet that has to be smaller than this does not fit.
smallestFillet :: Mm
smallestFillet = Mm 1e-3

-- | Two fillets whose centres are no further apart are one: it touches where two segments of a
-- curve join.
sameFillet :: Mm
sameFillet = Mm 1e-5

-- | Of two points whose distances from a third differ by no more, neither is the nearer one: points
-- on curves are known to 'curve' at best.
nearTie :: Mm
nearTie = Mm 1e-4

-- | A bevel that goes evenly between two places is off by no more.
bevel :: Rad
bevel = Rad 5e-5

-- | Curves of measured points count as joined when their ends are no further apart …
smoothGap :: Mm
smoothGap = Mm 1e-3

-- | … and as smooth when their directions differ by no more: 0.1°.
smoothTurn :: Rad
smoothTurn = Rad 1.75e-3

-- | A corner towards the cutter in which no more than this is left standing counts as none.
slightRest :: Mm
slightRest = Mm 1e-5

-- | No cutter has a smaller radius: one that would fit where only those do is not offered.
smallestCutter :: Mm
smallestCutter = Mm 0.05

-- | Numbers of a program that differ by no more are equal, in the units in which they are held (mm,
-- radians, minutes, none).
equal :: Double
equal = 1e-9

-- | Coordinates and radii up to 1 km; anything more is a slip of the pen, and beyond what the other
-- tolerances are meant for.
reach :: Mm
reach = Mm 1e6

-- | How finely a largest cutter or a largest excess is determined.
resolution :: Mm
resolution = Mm 1e-6

-- | How exactly the length of each piece of a curve is measured, where its doubles hold so much.
arcLength :: Mm
arcLength = Mm 1e-9

-- | Below this share of its length the measure of a piece is lost in the rounding of the speed.
arcLengthShare :: Double
arcLengthShare = 1e-12

-- | How exactly a place on a curve is found by its parameter, of which a span has 1.
parameter :: Double
parameter = 1e-12

-- | A curve whose place changes no faster, in mm for 1 of its parameter, stands still there.
still :: Mm
still = Mm 1e-9

-- | An arc that turns by no more is a straight line: its centre would be so far away that distances
-- from it lose more digits (@c·5·10⁷·10⁻¹⁶@ for a chord c) than the bulge (@c·2.5·10⁻⁹@) is worth.
straight :: Rad
straight = Rad 2e-8

-- | A biarc whose ends lean to its chord by angles that differ by no more is one arc.
oneArc :: Rad
oneArc = Rad 1e-9

-- | No arc of a biarc turns by more: half a turn, and what rounding adds.
halfTurn :: Rad
halfTurn = Rad (pi + 1e-9)

-- | A smooth curve may change its direction at a joint of its spans by this much; by more, it has a
-- corner there.
kink :: Rad
kink = Rad 1e-3

-- | What rounding may add to a point of the offset kernel, as a share of the largest coordinate:
-- some fifty units in the last place.
rounding :: Double
rounding = 1e-14

-- | The offset kernel takes directions whose sine is no larger for one: what that moves is this
-- share of the distance.
tangential :: Double
tangential = 1e-9

-- | The share of a tolerance that is kept back because a deviation is measured at finitely many
-- points.
deviationShare :: Double
deviationShare = 0.02

-- | The share that is kept back where a bound of the deviation is known, for the rounding of
-- doubles.
roundingShare :: Double
roundingShare = 1e-3

-- | No step along a curve is smaller than this share of a span.
finestStep :: Double
finestStep = 1e-6

-- | A share of a segment too short to matter.
hair :: Double
hair = 1e-9

-- | Where curves cross, their places are no further apart.
crossing :: Mm
crossing = Mm 1e-8

-- | A curve is replaced by arcs that stay so near to it.
curve :: Mm
curve = Mm 1e-5

-- | A control rounds what it is sent to its pulses. A length that has to be larger than the
-- cutter's radius there is larger by this.
byControl :: Mm
byControl = Mm 0.01

-- | The centre rolls about the inside of an arc on an arc of its own. If that is smaller, what
-- rounding to pulses adds to it may be more than 'controlTurn': of 1500 arcs with 0.06 mm LinuxCNC
-- refuses none, of those with 0.05 mm one.
controlArc :: Mm
controlArc = Mm 0.08

-- | LinuxCNC refuses an arc of the centre that turns further than it was programmed, by more than
-- this.
controlTurn :: Rad
controlTurn = Rad 0.0254

-- | The ends of a line that a control is sent are rounded, to 0.001 mm mostly: one may be off by so
-- much beside the other.
controlRounding :: Mm
controlRounding = Mm 1.5e-3

-- | A shorter element, rounded to pulses, might seem to a control to turn towards the cutter.
controlLength :: Mm
controlLength = Mm 0.05

-- | LinuxCNC takes a corner that turns by less for none and goes straight over from the one way to
-- the other. A way in has to turn by twice as much.
controlBend :: Rad
controlBend = Rad 0.05

-- | What a control may cut away at a corner that it takes for none.
controlCut :: Mm
controlCut = Mm 2e-3
