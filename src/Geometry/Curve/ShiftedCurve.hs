-- | Curves: a base curve with any number of shifts, each of which is a layer on top of the curve
-- below. They are evaluated by power series through all layers. A span is a part of the base on
-- which one formula gives the points. The parameter of a curve rises by 1 over each span.
--
-- A shift can make corners, for example where a change of distance begins or ends. The next shift
-- joins its two parts at such a corner, unless the corner is slight. Each part is moved as if the
-- curve below were continued beyond the corner by the formulas that hold before it or after it, and
-- both parts end where they meet. So the corner remains a corner: on its outer side the parts are
-- longer, on its inner side shorter. The corner keeps its parameter in all layers. In order that it
-- can, the parameters of the two parts beside it are stretched a little ('StretchedPart'). At a
-- slight corner, one that turns by at most 'Tolerance.kink', both parts may be nearly parallel
-- after the shift, so that they meet far away or nowhere. There the normals are turned instead
-- ('NormalTurns').
module Geometry.Curve.ShiftedCurve
  ( Curve (..),
    Layer (..),
    Side (..),
    shifted,
    base,
    layers,
    breaks,
    arcLength,
    position,
    footing,
    expansionAt,
    shiftAt,
    joinedCorners,
    domain,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List (find, zip4, zipWith4)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, mapMaybe)
import Geometry.Carrier (Side (..))
import Geometry.Curve.BasisCurve (BasisCurve, CurvePosition (..), SpanPoint)
import Geometry.Curve.BasisCurve qualified as BasisCurve
import Geometry.Curve.ShiftDistance (CurveBelow (..), Distance, ShiftInterval)
import Geometry.Curve.ShiftDistance qualified as ShiftDistance
import Geometry.Numeric.ArcLength (ArcLength)
import Geometry.Numeric.ArcLength qualified as ArcLength
import Geometry.Numeric.PowerSeries (PowerSeries)
import Geometry.Numeric.PowerSeries qualified as PowerSeries
import Geometry.Numeric.TaylorExpansion (Approach (..), TaylorExpansion)
import Geometry.Numeric.TaylorExpansion qualified as TaylorExpansion
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Vec)
import Geometry.Vec qualified as Vec

-- | Curve with any number of shifts.
data Curve
  = -- | a curve without shifts
    Unshifted BasisCurve
  | -- | the shift, the curve below, and the arc length of the result
    Shifted Layer Curve ~ArcLength
  deriving stock (Eq, Show)

-- | One shift: its side, its distance, the interval over which the distance changes, the turns of
-- the normals beside slight corners, and the parts beside other corners whose parameters are
-- stretched.
data Layer = Layer
  { side :: Side,
    distance :: Distance,
    interval :: ~ShiftInterval,
    turns :: ~NormalTurns,
    stretched :: ~StretchedParts
  }
  deriving stock (Eq, Show)

-- | Turns of the normals of a curve beside its slight corners: the smooth stretches that have such
-- corners at their ends, by their first parameters.
newtype NormalTurns = NormalTurns (Map Double TurnedStretch)

-- | All turns compare equal: the curve whose normals they turn determines them.
instance Eq NormalTurns where
  _ == _ = True

instance Show NormalTurns where
  show _ = "NormalTurns"

-- | Last parameter of a smooth stretch, and the angles in radians, counter-clockwise, by which the
-- normals at its begin and at its end are turned.
data TurnedStretch = TurnedStretch {upTo :: Double, atBegin :: Double, atEnd :: Double}

-- | Stretched parts of a shifted curve, by their first parameters.
newtype StretchedParts = StretchedParts (Map Double StretchedPart)

-- | All stretched parts compare equal: the shift and its curve determine them.
instance Eq StretchedParts where
  _ == _ = True

instance Show StretchedParts where
  show _ = "StretchedParts"

-- | Part of a shifted curve from the parameter @begin@ to @end@. The parameters @from@ and @to@ of
-- the curve below belong to its ends, and in between the parameters are proportional. @first@ and
-- @final@ are the ends of the smooth run of the curve below in which the part lies. @from@ may lie
-- before @first@, and @to@ after @final@; there the run is continued.
data StretchedPart = StretchedPart
  { begin, end, from, to :: Double,
    first, final :: Double
  }

-- | Curve @lower@ moved along its normal to a side. The distance is a function of the position on
-- @lower@.
shifted :: Side -> Distance -> Curve -> Curve
shifted side distance lower = whole
  where
    whole =
      Shifted
        layer
        lower
        (ArcLength.fromSpeed speed (merge (breaks whole) (knots whole)))
    layer =
      Layer
        { side,
          distance,
          interval = ShiftDistance.intervalOf (arcLength lower) distance,
          turns = turnsOf lower,
          stretched = stretchedParts layer lower
        }
    speed u = speedAt whole (position After u whole)

-- | Speed in mm per unit of the parameter.
speedAt :: Curve -> CurvePosition -> Double
speedAt curve s = Vec.norm (TaylorExpansion.velocity (expansionAt 1 curve s))

-- | Base, the unshifted curve below all shifts.
base :: Curve -> BasisCurve
base curve = case curve of
  Unshifted b -> b
  Shifted _ lower _ -> base lower

-- | Sides and distances of the shifts, the innermost first.
layers :: Curve -> [(Side, Distance)]
layers curve = reverse (outermost curve)
  where
    outermost c = case c of
      Unshifted _ -> []
      Shifted layer lower _ -> (side layer, distance layer) : outermost lower

-- | Parameters, in ascending order, between which the curve is smooth. The first is 0, the last is
-- that of the curve's end.
breaks :: Curve -> [Double]
breaks curve = case curve of
  Unshifted b -> map fromIntegral [0 .. BasisCurve.count b]
  Shifted layer lower _ ->
    raised layer (merge (breaks lower) (filter isInside (ShiftDistance.marks (interval layer))))
  where
    isInside u = u > 0 && u < domain curve

-- | Parameters, in ascending order, at which the distance of a shift changes from one cubic to the
-- next, because it interpolates between the rows of a table. The tangent of the curve is continuous
-- there, but a higher derivative may jump. It may also jump where the continuation of a part beyond
-- a corner ends. So the table of arc lengths has a new interval at each of these parameters.
knots :: Curve -> [Double]
knots curve = case curve of
  Unshifted _ -> []
  Shifted layer lower _ ->
    let ofDistance = filter isInside (ShiftDistance.knots (base lower) (distance layer))
     in merge (continuationEnds layer) (raised layer (merge (knots lower) ofDistance))
  where
    isInside u = u > 0 && u < domain curve

-- | Union of two ascending lists.
merge :: [Double] -> [Double] -> [Double]
merge as bs = case (as, bs) of
  ([], _) -> bs
  (_, []) -> as
  (a : as', b : bs')
    | a < b -> a : merge as' bs
    | b < a -> b : merge as bs'
    | otherwise -> a : merge as' bs'

-- | Parameter of the curve's end, which is the count of spans.
domain :: Curve -> Double
domain = fromIntegral . BasisCurve.count . base

-- | Arc length along the curve as a function of its parameter.
arcLength :: Curve -> ArcLength
arcLength curve = case curve of
  Unshifted b -> BasisCurve.arcLength b
  Shifted _ _ along -> along

-- | Position with the parameter @u@. At a joint of two spans it lies in the earlier span for
-- 'Before' and in the later one for 'After'. A parameter outside of the domain gives the nearer
-- end.
position :: Approach -> Double -> Curve -> CurvePosition
position approach u curve = CurvePosition {parameter, home = parameter, approach}
  where
    parameter = max 0 (min (domain curve) u)

-- | Point of the base from which the shifts have moved the curve's point at a position, and the
-- derivative there of the parameter of the base by that of the curve.
footing :: Curve -> CurvePosition -> (SpanPoint, Double)
footing curve s = case curve of
  Unshifted b -> (BasisCurve.spanPointAt s b, 1)
  Shifted layer lower _ ->
    let (foot, k) = footing lower (below layer lower s)
     in (foot, k * rate layer lower s)

-- | Taylor expansion of the curve's point, in mm, about the position @s@, up to the power @n@ of
-- the parameter. To evaluate a shift, the curve below is expanded to one power more, except where
-- the shift's distance is identically 0.
expansionAt :: Int -> Curve -> CurvePosition -> TaylorExpansion
expansionAt n curve s = case curve of
  Unshifted b -> BasisCurve.expansion n b (BasisCurve.spanPointAt s b)
  Shifted layer lower _ ->
    fmap (PowerSeries.stretched (rate layer lower s)) (movedAt n layer lower (below layer lower s))

-- | Taylor expansion of the point to which a shift moves the position @s@ of the curve below it.
-- Its parameter is that of the curve below.
movedAt :: Int -> Layer -> Curve -> CurvePosition -> TaylorExpansion
movedAt n layer lower s
  | ShiftDistance.vanishes (distance layer) s = expansionAt n lower s
  | otherwise =
    let near = expansionAt (n + 1) lower s
        turned = turnAt n (turns layer) lower s
     in TaylorExpansion.offset turned (distanceAt n layer lower near s) near

-- | Expansion of the curve below a shift about a position of the shifted curve, up to the power
-- @n + 1@, and the shift's distance there in mm, positive to the left, as a power series up to the
-- power @n@. The parameter is that of the shifted curve.
shiftAt :: Int -> Layer -> Curve -> CurvePosition -> (TaylorExpansion, PowerSeries)
shiftAt n layer lower s =
  ( fmap (PowerSeries.stretched k) near,
    PowerSeries.stretched k (distanceAt n layer lower near s')
  )
  where
    s' = below layer lower s
    k = rate layer lower s
    near = expansionAt (n + 1) lower s'

-- | Power series of a shift's distance in mm, positive to the left, about a position of the curve
-- below. The arguments are the highest power, the shift, the curve below, the expansion of that
-- curve about the position, and the position.
distanceAt :: Int -> Layer -> Curve -> TaylorExpansion -> CurvePosition -> PowerSeries
distanceAt n layer lower near s = case side layer of
  LeftOf -> d
  RightOf -> PowerSeries.scale (-1) d
  where
    d = ShiftDistance.series n curveBelow (interval layer) (distance layer) s
    curveBelow =
      CurveBelow
        { under = base lower,
          along = arcLength lower,
          beyond,
          near,
          onBase,
          baseRate
        }
    (onBase, baseRate) = footing lower s
    beyond
      | parameter s == home s = 0
      | otherwise =
        ArcLength.integral (\u -> speedAt lower s {parameter = u}) (home s) (parameter s)

-- Normals beside slight corners -------------------------------------------------------------------

-- | Turns of the normals of a curve. At a slight corner the normals before and after it are turned
-- to their mean. At the start and the end of a closed curve this needs both of them to be one
-- point.
turnsOf :: Curve -> NormalTurns
turnsOf curve =
  NormalTurns
    ( Map.fromDistinctAscList
        [ (a, TurnedStretch {upTo = b, atBegin = -(before / 2), atEnd = after / 2})
          | (a, b, before, after) <- zip4 bs (drop 1 bs) corners (drop 1 corners),
            before /= 0 || after /= 0
        ]
    )
  where
    bs = breaks curve
    seam = ifSlight (ofCurve (seamOf curve))
    corners = [seam] <> map (ifSlight . ofCurve . turnOf curve) (innerBreaks curve) <> [seam]
    ifSlight a = if isSlight a then a else 0

-- | True for the angle in radians of a slight corner.
isSlight :: Double -> Bool
isSlight a = Rad (abs a) > Tolerance.smoothAngle && Rad (abs a) <= Tolerance.kink

-- | Turn of the normal of a curve about a position as a power series up to the power @n@, in
-- radians. Nothing if the normal is not turned.
turnAt :: Int -> NormalTurns -> Curve -> CurvePosition -> Maybe PowerSeries
turnAt n (NormalTurns stretches) curve s
  | Map.null stretches = Nothing
  | otherwise = case lookupHome s stretches of
    Just (a, TurnedStretch {upTo, atBegin, atEnd})
      | isUpTo curve upTo s ->
        let slope = (atEnd - atBegin) / (upTo - a)
         in Just (PowerSeries.fromList n [atBegin + slope * (parameter s - a), slope])
    _ -> Nothing

-- | Entry of the last parameter that is not after the home of a position. At a parameter itself,
-- the approach decides. A position before the start of the curve is at its start.
lookupHome :: CurvePosition -> Map Double a -> Maybe (Double, a)
lookupHome s = case approach s of
  Before | home s > 0 -> Map.lookupLT (home s)
  _ -> Map.lookupLE (home s)

-- | True if the home of a position is not past the end of a stretch of a curve. At the end itself
-- the approach decides, but nothing follows the end of the curve.
isUpTo :: Curve -> Double -> CurvePosition -> Bool
isUpTo curve end s = case approach s of
  After | end < domain curve -> home s < end
  _ -> home s <= end

-- Corners that a shift joins ----------------------------------------------------------------------

-- | Stretched part of a shifted curve that contains the home of a position, if there is one.
-- @lower@ is the curve below, which has the same range of parameters.
partAt :: Layer -> Curve -> CurvePosition -> Maybe StretchedPart
partAt layer lower s
  | Map.null parts = Nothing
  | otherwise = case lookupHome s parts of
    Just (_, part) | isUpTo lower (end part) s -> Just part
    _ -> Nothing
  where
    StretchedParts parts = stretched layer

-- | Position on the curve below that a shift moves to a position of the shifted curve.
below :: Layer -> Curve -> CurvePosition -> CurvePosition
below layer lower s = case partAt layer lower s of
  Nothing -> s
  Just part@StretchedPart {first, final} ->
    let h = lowered part (home s)
        p = if parameter s == home s then h else lowered part (parameter s)
     in if h >= final
          then CurvePosition {parameter = p, home = final, approach = Before}
          else
            if h <= first
              then CurvePosition {parameter = p, home = first, approach = After}
              else s {parameter = p, home = h}

-- | Parameter of the curve below for a parameter in or beside a stretched part. It is exact at both
-- ends of the part.
lowered :: StretchedPart -> Double -> Double
lowered StretchedPart {begin, end, from, to} u
  | u == end = to
  | otherwise = from + (u - begin) * ((to - from) / (end - begin))

-- | Derivative of the parameter of the curve below by that of the shifted curve.
rate :: Layer -> Curve -> CurvePosition -> Double
rate layer lower s = case partAt layer lower s of
  Nothing -> 1
  Just StretchedPart {begin, end, from, to} -> (to - from) / (end - begin)

-- | Parameters of the shifted curve for those of the curve below, both in ascending order. The
-- parameters in those parts of the curve below that are cut off at corners are left out.
raised :: Layer -> [Double] -> [Double]
raised layer us
  | Map.null parts = us
  | otherwise = mapMaybe raise us
  where
    StretchedParts parts = stretched layer
    raise u = case find (`concerns` u) parts of
      Nothing -> Just u
      Just StretchedPart {begin, end, from, to}
        | u <= from || u >= to -> Nothing
        | otherwise -> Just (begin + (u - from) * ((end - begin) / (to - from)))
    concerns StretchedPart {begin, end} u = begin < u && u < end

-- | Parameters of a shifted curve, in ascending order, at which the continuation of a part beyond a
-- corner ends.
continuationEnds :: Layer -> [Double]
continuationEnds layer =
  concat
    [ [begin + (u - from) * ((end - begin) / (to - from)) | u <- [first, final], from < u, u < to]
      | StretchedPart {begin, end, from, to, first, final} <- Map.elems parts
    ]
  where
    StretchedParts parts = stretched layer

-- | Stretched parts of the shift of a curve.
stretchedParts :: Layer -> Curve -> StretchedParts
stretchedParts layer lower
  | null corners && not hasSeam = StretchedParts Map.empty
  | otherwise =
    StretchedParts
      (Map.fromList [(begin part, part) | run <- runs, part <- partsOf (breaks lower) run])
  where
    corners = filter (isJoined . turnOf lower) (innerBreaks lower)
    hasSeam = isJoined (seamOf lower)
    ends = [0] <> corners <> [domain lower]
    joints =
      (if hasSeam then cutsAt layer lower (domain lower) 0 else Nothing) :
      map (\u -> cutsAt layer lower u u) corners
    arriving = map (fmap fst) (drop 1 joints <> take 1 joints)
    runs =
      zipWith4
        (\a b leave arrive -> (a, b, fromMaybe a leave, fromMaybe b arrive))
        ends
        (drop 1 ends)
        (map (fmap snd) joints)
        arriving

-- | Stretched parts of a run of the curve below from the parameter @a@ to @b@, of which the shift
-- uses the part from @t@ to @w@. Only a part beside each end is stretched, up to a break between
-- smooth stretches. It is at least four times as long as the part that is cut off or added there.
-- If there are no such breaks, the whole run is stretched. A run of which nothing is left is not
-- stretched, so that gaps remain at its ends.
partsOf :: [Double] -> (Double, Double, Double, Double) -> [StretchedPart]
partsOf bs (a, b, t, w)
  | t == a && w == b || t >= w = []
  | l <= r =
    [part a l t l | t /= a] <> [part r b r w | w /= b]
  | otherwise = [part a b t w]
  where
    part begin end from to = StretchedPart {begin, end, from, to, first = a, final = b}
    inside = filter (\u -> u > a && u < b) bs
    l = if t == a then a else fromMaybe (1 / 0) (find (\u -> u - a >= 4 * abs (t - a)) inside)
    r =
      if w == b
        then b
        else fromMaybe (-1 / 0) (find (\u -> b - u >= 4 * abs (w - b)) (reverse inside))

-- | Parameters at which the shift of a curve leaves the part before a corner and enters the part
-- after it. The corner is at the parameter @c@ before it and @c'@ after it; they differ only where
-- a closed curve begins. Newton's method finds the intersection of both parts. Nothing if it does
-- not.
cutsAt :: Layer -> Curve -> Double -> Double -> Maybe (Double, Double)
cutsAt layer lower c c'
  | ShiftDistance.vanishes (distance layer) (before c)
      && ShiftDistance.vanishes (distance layer) (after c') =
    Nothing
  | otherwise = newton (20 :: Int) c c'
  where
    before u = CurvePosition {parameter = u, home = min c u, approach = Before}
    after u = CurvePosition {parameter = u, home = max c' u, approach = After}
    -- The sides are continued by less than the length of a span. False also for NaN.
    isBeside corner u = abs (u - corner) <= 1
    newton steps a b
      | Vec.norm gap <= 0 = Just (a, b)
      | abs (Vec.cross v w) <= 0 || not (isBeside c a && isBeside c' b) = Nothing
      -- A last step leaves no gap that the arc length would notice.
      | Mm (Vec.norm gap) <= Tolerance.crossing = Just next
      | steps == 0 = Nothing
      | otherwise = uncurry (newton (steps - 1)) next
      where
        next = (a + Vec.cross gap w / Vec.cross v w, b + Vec.cross gap v / Vec.cross v w)
        p = movedAt 1 layer lower (before a)
        q = movedAt 1 layer lower (after b)
        gap = Vec.to (TaylorExpansion.position p) (TaylorExpansion.position q)
        (v, w) = (TaylorExpansion.velocity p, TaylorExpansion.velocity q)

-- | Parameters, in ascending order, of the corners that shifts have made and at which a further
-- shift joins both sides. The point at which a closed curve begins and ends has the parameter 0.
joinedCorners :: Curve -> [Double]
joinedCorners curve =
  [0 | isJoined (seamOf curve)]
    <> filter (isJoined . turnOf curve) (innerBreaks curve)

-- | Parameters, in ascending order, of the breaks between smooth stretches, without the ends.
innerBreaks :: Curve -> [Double]
innerBreaks curve = drop 1 (takeWhile (< domain curve) (breaks curve))

-- | Corner of a curve: the angle in radians, counter-clockwise, by which the curve turns there, and
-- that by which its base turns.
data Turn = Turn {ofCurve :: Double, ofBase :: Double}

-- | True if a shift of the curve joins both sides of a corner: if it turns by more than a slight
-- corner, at most by 'Tolerance.joinedCorner', and if it is not a corner of the base.
isJoined :: Turn -> Bool
isJoined Turn {ofCurve, ofBase} =
  Rad (abs ofCurve) > Tolerance.kink
    && Rad (abs ofCurve) <= Tolerance.joinedCorner
    && Rad (abs ofBase) <= Tolerance.kink

-- | Turn of a curve at a parameter.
turnOf :: Curve -> Double -> Turn
turnOf curve u = turnBetween curve (position Before u curve) (position After u curve)

-- | Turn of a closed curve where it begins and ends; that of an open curve is 0.
seamOf :: Curve -> Turn
seamOf curve
  | Vec.isNear (point start) (point finish) = turnBetween curve finish start
  | otherwise = Turn 0 0
  where
    start = position After 0 curve
    finish = position Before (domain curve) curve
    point s = TaylorExpansion.position (expansionAt 0 curve s)

-- | Turn between two positions. An angle is 0 if there is no direction at one of them.
turnBetween :: Curve -> CurvePosition -> CurvePosition -> Turn
turnBetween curve before after =
  Turn {ofCurve = turn curve, ofBase = turn (Unshifted (base curve))}
  where
    turn c = fromMaybe 0 (angle <$> along before c <*> along after c)
    angle v w = let Rad a = Vec.signedAngle v w in a
    along :: CurvePosition -> Curve -> Maybe Vec
    along s c = TaylorExpansion.direction (approach s) (expansionAt 1 c s)
