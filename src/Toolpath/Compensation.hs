-- | Input for a control with cutter compensation (@G41@, @G42@).
--
-- The control receives the edge of the part and computes the offset itself. If it does not refuse
-- the edge, it makes the moves of the toolpath. The behaviour of controls was measured on LinuxCNC
-- 2.9:
--
-- * The first move under compensation is programmed as a straight line. The control moves the
-- centre to the point where the offsets of that line and of the next element intersect. This point
-- has to be the end of the approach in the toolpath. So the line is programmed tangent to the
-- cutter's circle about that end. The first element of the edge is extended backwards, along its
-- tangent at its start, until it meets the programmed line.
--
-- * At outer corners the control moves on arcs. It makes the arc at the last corner of a closed
-- contour only when another move under compensation follows.
--
-- * After the end of the contour the control moves straight from the end of the offset to the next
-- programmed point.
module Toolpath.Compensation
  ( PassMoves (..),
    compensationInput,
    endsAtOuterCorner,
    overrun,
  )
where

import Base.Quantity (Mm (..), Rad (..), plus, times)
import Base.Region (Region)
import Control.Monad (when, zipWithM_)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Geometry.Carrier (Side)
import Geometry.Carrier qualified as Carrier
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.Equidistant qualified as Equidistant
import Part.Part (Element, Milling)
import Part.Part qualified as Part
import Toolpath.Error (Error (..), Unsupported (..))
import Toolpath.Tolerance qualified as Tolerance
import Toolpath.Toolpath (Manner (..), Move (..), Sent (Sent), withoutBraking)
import Toolpath.Toolpath qualified as Toolpath

-- | The moves of the cutter's centre in one pass. The fields are in the order of execution.
data PassMoves = PassMoves
  { -- | the approach
    before :: [Move],
    leadIn :: [Move],
    -- | the moves along the contour
    cut :: NonEmpty Move,
    leadOut :: [Move],
    -- | the retract
    behind :: [Move]
  }

-- | The input for a control that does the cutter compensation, or the reason why a control cannot
-- make the pass. Nothing when the program does not ask for compensation by the control. @keyword@
-- is the region of the statement's first word. @side@ is the cutter's side of the contour; Nothing
-- when its centre moves on the contour.
compensationInput :: Region -> Milling -> Maybe Side -> PassMoves -> Either Error (Maybe Sent)
compensationInput keyword milling side passMoves = case Part.controlCompensation milling of
  Nothing -> Right Nothing
  Just requested -> do
    checkRequest requested milling
    s <- maybe (Left (NotForControl requested OnContour)) Right side
    checkElements keyword requested milling s passMoves
    let edge = programmed milling s passMoves
    (before', entry, edge') <- entering keyword requested milling s (before passMoves) edge
    (exit, behind') <- leaving keyword requested milling (NonEmpty.last edge') (behind passMoves)
    Right
      ( Just
          Sent
            { Toolpath.before = before',
              Toolpath.side = s,
              Toolpath.entry = entry,
              Toolpath.edge = edge',
              Toolpath.exit = exit,
              Toolpath.behind = behind'
            }
      )

-- | Refuses a blade, sharp corners, and allowances. The control receives only the edge of the part,
-- and that edge cannot express them. @requested@ is the region of the program's request for
-- compensation by the control.
checkRequest :: Region -> Milling -> Either Error ()
checkRequest requested milling
  | Just _ <- Part.gear milling = refused Swivelling
  | Part.corners milling == Part.Sharp = refused SharpCorners
  | any (> Mm 0) (Part.allowances milling)
      || any ((> Mm 0) . Part.allowance . Part.finish) (Part.elements (Part.contour milling)) =
    refused LeavingMaterial
  | otherwise = Right ()
  where
    refused = Left . NotForControl requested

-- | Refuses elements and leads that a control cannot follow. @keyword@ is the region of the
-- statement's first word, @requested@ that of the request for compensation by the control.
checkElements :: Region -> Region -> Milling -> Side -> PassMoves -> Either Error ()
checkElements keyword requested milling side passMoves =
  mapM_ (checkLength keyword requested) elements
    >> mapM_ checkRadius edge
    >> mapM_
      (checkCorner requested milling)
      (Polyarc.neighbours (Part.polyarcOf (Part.contour milling)))
    >> zipWithM_ checkArcStart edge (drop 1 edge)
  where
    elements = NonEmpty.toList (Part.elements (Part.contour milling))
    radius@(Mm r) = Part.radius milling
    edge =
      map lead (leadIn passMoves)
        <> [(Just i, Part.segment e) | (i, e) <- zip [0 ..] elements]
        <> map lead (leadOut passMoves)
    lead m = (Nothing, touchedCurve radius side (segment m))
    checkRadius (i, s) =
      mapM_
        (\old -> Left (TightForControl keyword requested (fmap element i) old radius))
        (tooTight radius side s)
    -- Refuses the arc @b@ if the control would refuse it after the segment @a@. A control ignores a
    -- very slight corner between them. If this corner turns away from the cutter, the arc of the
    -- centre begins too early, and sweeps more than @b@. Rounding to pulses turns @a@ a little,
    -- which has the same effect. The control refuses @b@ if the two sweeps differ by more than
    -- 'Tolerance.controlTurn'.
    checkArcStart (i, a) (_, b) =
      let Rad deflection = Vec.signedAngle (Segment.endDirection a) (Segment.startDirection b)
          needed = neededBefore (Mm r) side (Rad (max 0 (-(deflection * Carrier.sideSign side)))) b
       in if not (isIgnored deflection) || needed <= referenceLength a
            then Right ()
            else Left $ case i of
              Just n
                | abs deflection > smooth ->
                  SlightForControl
                    requested
                    (element n)
                    (element (n + 1))
                    (Rad deflection)
                    (Mm (r * (1 - cos deflection)))
              _ -> TinyForControl keyword requested (fmap element i) (referenceLength a) needed
    Rad smooth = Tolerance.smoothAngle
    element = elementAt milling

-- | Refuses an element shorter than 'Tolerance.controlLength'. @keyword@ is the region of the
-- statement's first word, @requested@ that of the request for compensation.
checkLength :: Region -> Region -> Element -> Either Error ()
checkLength keyword requested e =
  when
    (l < Tolerance.controlLength)
    (Left (TinyForControl keyword requested (Just e) l Tolerance.controlLength))
  where
    l = Segment.length (Part.segment e)

-- | Refuses a corner so slight that a control ignores it, if the control would then cut too deep.
-- Refuses also a corner at which the contour almost reverses. The triple has the number, from 0, of
-- the element before the corner, and the segments of the elements before and after it.
checkCorner :: Region -> Milling -> (Int, Segment, Segment) -> Either Error ()
checkCorner requested milling (i, a, b) =
  when
    (isIgnored deflection && gouge > Tolerance.controlCut)
    (Left (SlightForControl requested element following (Rad deflection) gouge))
    >> when
      (isIgnored (pi - abs deflection))
      (Left (BackForControl requested element following (Rad deflection)))
  where
    Rad deflection = Vec.signedAngle (Segment.endDirection a) (Segment.startDirection b)
    Mm r = Part.radius milling
    gouge = Mm (r * (1 - cos deflection))
    element = elementAt milling i
    following = elementAt milling (i + 1)

-- | True for a change of direction, in radians, that a control ignores.
isIgnored :: Double -> Bool
isIgnored deflection = abs deflection < least
  where
    Rad least = Tolerance.controlBend

-- | The element with the number @i@, from 0. After the last element the first one follows again.
elementAt :: Milling -> Int -> Element
elementAt milling i = elements NonEmpty.!! (i `mod` length elements)
  where
    elements = Part.elements (Part.contour milling)

-- | The least 'referenceLength' that a control accepts for the segment before @s@: a least length
-- for a line, a least radius for an arc. @away@ is the angle by which the contour turns away from
-- the cutter at the start of @s@; @r@ is the cutter's radius in mm.
--
-- If @s@ is an arc, the centre's arc may sweep more than @s@. One reason is the angle @away@. The
-- other is rounding to pulses, which turns the segment before @s@, and turns a longer one less. If
-- that segment has at least the length of the result, the two sweeps differ by at most
-- 'Tolerance.controlTurn'. The result is 0 if @s@ is a line, and infinite if no length suffices.
neededBefore :: Mm -> Side -> Rad -> Segment -> Mm
neededBefore (Mm r) side (Rad away) s = case s of
  Straight _ _ -> Mm 0
  Arc {start, centre, sweep = Rad angle}
    | left > 0 -> Mm (r * rounding / left)
    | otherwise -> Mm (1 / 0)
    where
      left = most * (old - signum angle * Carrier.sideSign side * r - least) - r * away
      Mm old = Segment.radius centre start
      Mm least = Tolerance.controlArc
      Mm rounding = Tolerance.controlRounding
      Rad most = Tolerance.controlTurn

-- | The length of a line or the radius of an arc. The larger it is, the less the direction at the
-- end of the segment changes when that end is rounded to pulses.
referenceLength :: Segment -> Mm
referenceLength s = case s of
  Straight a b -> Vec.distance a b
  Arc {start, centre} -> Segment.radius centre start

-- | The radius of the segment @s@, if @s@ is a concave arc that is too small for the cutter: its
-- radius is less than the cutter's @radius@ plus 'Tolerance.controlArc'. Nothing for any other
-- segment.
tooTight :: Mm -> Side -> Segment -> Maybe Mm
tooTight radius side s = case s of
  Straight _ _ -> Nothing
  Arc {start, centre, sweep = Rad angle}
    | signum angle == Carrier.sideSign side,
      old <- Segment.radius centre start,
      old < plus radius Tolerance.controlArc ->
      Just old
    | otherwise -> Nothing

-- The edge

-- | The edge of the part in the direction of travel, as moves: the line or arc that the cutter
-- touches during the lead-in, the elements of the contour, and the line or arc that it touches
-- during the lead-out.
programmed :: Milling -> Side -> PassMoves -> NonEmpty Move
programmed milling side PassMoves {leadIn, cut, leadOut} = case map lead leadIn of
  [] -> elements `followedBy` map lead leadOut
  l : more -> l :| more <> NonEmpty.toList elements <> map lead leadOut
  where
    lead m = m {segment = touchedCurve (Part.radius milling) side (segment m)}
    elements =
      NonEmpty.zipWith element (False :| repeat True) (Part.elements (Part.contour milling))
    element isLater e =
      Move
        { segment = Part.segment e,
          manner =
            Manner
              (Toolpath.heights (NonEmpty.head cut))
              (maybe (Part.At (Part.feed milling)) Part.At (Part.ownFeed (Part.finish e)))
              (Part.slow (Part.finish e)),
          origin = Part.origin e,
          continues = isLater && Part.continues e
        }
    followedBy (e :| es) more = e :| es <> more

-- | The line or arc that a cutter of this radius touches while its centre moves along the segment
-- @s@. The cutter is on @side@ of that line or arc. The result is @s@ if @s@ has no length, or if
-- the arc would have a radius of 0 or less.
touchedCurve :: Mm -> Side -> Segment -> Segment
touchedCurve radius side s =
  fromMaybe s (Segment.offset (Carrier.oppositeSide side) radius s)

-- | True when a control does the compensation and the path ends with the arc round an outer corner,
-- as a path round a closed contour may.
endsAtOuterCorner :: Milling -> NonEmpty Equidistant.OffsetSegment -> Bool
endsAtOuterCorner milling offsetSegments = case Part.controlCompensation milling of
  Nothing -> False
  Just _ -> case Equidistant.origin (NonEmpty.last offsetSegments) of
    Equidistant.Around _ -> True
    Equidistant.Along _ -> False

-- | A move of at most 1 mm along @first@, the first segment of a closed path. The cutter makes it a
-- second time after the path's end, because a control makes the arc round the last corner only when
-- another move follows. Empty when @first@ has no length. @keyword@ is the region of the
-- statement's first word. The heights of the move are 0; the caller sets them.
overrun :: Region -> Milling -> Segment -> [Move]
overrun keyword milling first =
  [ Move
      (fst (Segment.cutAt share first))
      (Manner (Mm 0, Mm 0) (Part.At (Part.feed milling)) False)
      keyword
      False
    | l > 0
  ]
  where
    Mm l = Segment.length first
    share = min 1 (l / 2) / l

-- Approach and retract

-- | The moves before compensation begins, the straight move on which it begins, and the edge from
-- the end of that move. @passMoves@ are the moves of the approach; the last of them must be
-- straight and level.
--
-- If this last move is longer than three radii of the cutter, it is divided at two radii from its
-- end. Compensation begins on the second part. The programmed line is the tangent from there to the
-- cutter, which is turned by 30° from the approach. So even if the edge continues the direction of
-- the approach, there is a corner that a control does not ignore. @keyword@ is the region of the
-- statement's first word, @requested@ that of the request for compensation.
entering ::
  Region ->
  Region ->
  Milling ->
  Side ->
  [Move] ->
  NonEmpty Move ->
  Either Error ([Move], Move, NonEmpty Move)
entering keyword requested milling side passMoves edge = case reverse passMoves of
  m@Move {segment = Straight from to', manner = Manner {between = (z, z')}} : earlier
    | z == z',
      Vec.distance from to' > Tolerance.coincident -> do
      let whole@(Mm long) = Vec.distance from to'
          on = if whole > times 3 radius then Vec.interpolate (1 - 2 * r / long) from to' else from
          onwards = m {segment = Straight on to'}
          straight = [(withoutBraking m) {segment = Straight from on} | on /= from]
      begin <- entryPoint requested milling side onwards (segment (NonEmpty.head edge))
      Right (reverse earlier <> straight, m {segment = Straight on begin}, beginningAt begin edge)
  _ -> Left (ShortForControl keyword requested True (Mm 0) radius)
  where
    radius@(Mm r) = Part.radius milling

-- | The end of the straight move on which compensation begins. @approach@ is this move as the
-- cutter's centre makes it without compensation, and @first@ is the first element of the edge. One
-- line goes from the start of @approach@ and is tangent to the cutter at the end of @approach@. The
-- other goes through the start of @first@ in the direction of @first@ there. The result is their
-- intersection. Refuses an approach that is too short, or from a direction that a control does not
-- accept.
entryPoint :: Region -> Milling -> Side -> Move -> Segment -> Either Error Point
entryPoint requested milling side approach first = do
  when (d <= r) (tooShort (Mm d))
  when
    (bend < max (2 * least) (leastOntoArc radius side first) || bend > furthestTurn)
    (Left (WrongWayForControl (origin approach) requested finish))
  when (l <= plus radius Tolerance.controlMargin) (tooShort l)
  Right begin
  where
    radius@(Mm r) = Part.radius milling
    on = Segment.start (segment approach)
    finish = Segment.end (segment approach)
    Mm d = Vec.distance on finish
    ahead = Segment.startDirection first
    tangent =
      Vec.rotate
        (Rad (-Carrier.sideSign side * asin (min 1 (r / d))))
        (Vec.unit (Vec.to on finish))
    Rad deflection = Vec.signedAngle tangent ahead
    bend = Carrier.sideSign side * deflection
    begin = Vec.shift (Vec.scale (-r * tan (bend / 2)) ahead) (Segment.start first)
    Rad least = Tolerance.controlBend
    l = Vec.distance on begin
    tooShort distance = Left (ShortForControl (origin approach) requested True distance radius)

-- | The least allowed change of direction, in radians, from the programmed line of the approach to
-- the @first@ element of the edge. It is 0 if @first@ is a line. Before an arc the edge gets an
-- additional line ('beginningAt'). With a smaller change of direction, this line would be too short
-- for a control.
leastOntoArc :: Mm -> Side -> Segment -> Double
leastOntoArc radius@(Mm r) side first = case first of
  Straight _ _ -> 0
  Arc {} -> 2 * atan2 l r
    where
      Mm l = max Tolerance.controlLength (neededBefore radius side (Rad 0) first)

-- | The edge with the new beginning @begin@. A straight first element then begins at that point. If
-- the first element is an arc, a line from that point to the arc is added before it.
beginningAt :: Point -> NonEmpty Move -> NonEmpty Move
beginningAt begin (first :| others) = case segment first of
  Straight _ b -> first {segment = Straight begin b} :| others
  Arc {start} ->
    (withoutBraking first) {segment = Straight begin start, continues = False} :| first : others

-- | The largest allowed change of direction from the approach to the first element: 175°. At this
-- angle the first element is extended backwards by 23 radii of the cutter.
furthestTurn :: Double
furthestTurn = 35 / 36 * pi

-- | The straight move on which compensation ends, and the moves after it. @keyword@ is the region
-- of the statement's first word, @requested@ that of the request for compensation. @final@ is the
-- last move of the edge. @passMoves@ are the moves of the retract; the first must be straight and
-- level.
leaving :: Region -> Region -> Milling -> Move -> [Move] -> Either Error (Move, [Move])
leaving keyword requested milling final passMoves = case passMoves of
  m@Move {segment = Straight _ to', manner = Manner {between = (z, z')}} : later | z == z' -> do
    let l = Vec.distance from to'
    when
      (l <= plus radius Tolerance.controlMargin)
      (Left (ShortForControl (origin m) requested False l radius))
    Right (m {segment = Straight from to'}, later)
  _ -> Left (ShortForControl keyword requested False (Mm 0) radius)
  where
    radius = Part.radius milling
    from = Segment.end (segment final)
