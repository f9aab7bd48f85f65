-- | Motions of a swivelling blade, brought to the height of their pass.
--
-- The /axis/ is the machine's z axis. It does not lift a blade: its height says how far the blade
-- is swivelled. If this height agrees with the bevel of the contour, within the tolerance and the
-- rounding, the motion gets the height of the pass. If not, it keeps the height of the axis, so
-- that it does not count as a motion along the contour.
module Verify.Swivel
  ( levelled,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, plus, times)
import Base.Region (Located (..))
import Data.IntSet qualified as IntSet
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (catMaybes, fromMaybe, listToMaybe, mapMaybe)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier (Side)
import Geometry.Carrier qualified as Carrier
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Part.Part (Milling)
import Part.Part qualified as Part
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.LevelledMotion (Levelled (..))
import Verify.Motion (CutterMotion (..))
import Verify.Motion qualified as Motion
import Verify.Requirement qualified as Requirement

-- | Bring the motions along contours that are cut with a blade to the heights of their passes. If a
-- motion fits several passes, it gets the height of the first one. Other motions stay as they are.
levelled :: Machine -> Toolpath -> [CutterMotion] -> Levelled
levelled machine path ms
  | null passes = Levelled {motions = ms, isAsDemanded = const False}
  | otherwise =
    Levelled
      { motions = zipWith fromMaybe ms fitting,
        isAsDemanded = \m -> IntSet.member (number m) swivelled
      }
  where
    fitting = map (\m -> listToMaybe (mapMaybe (\pass -> levelledIn machine pass m) passes)) ms
    swivelled = IntSet.fromList (map number (catMaybes fitting))
    passes =
      [ bladePass machine milling pass
        | Toolpath.Cutting {Toolpath.job = Located _ milling, Toolpath.pass} <-
            Toolpath.blocks path,
          Just _ <- [Part.gear milling]
      ]

-- | Pass along a contour with a blade.
data BladePass = BladePass
  { -- | height of the pass
    level :: Mm,
    -- | largest distance of the tool's centre from the contour
    maxReach :: Mm,
    -- | larger of the allowed chord errors into the part and away from it
    tolerance :: Mm,
    -- | largest deviation of the axis along a chord, without its rounding: the smaller one of the
    -- allowed chord errors, but at least one pulse of the plane
    axisDeviation :: Mm,
    -- | side of the contour on which the blade moves, if it goes round outer corners on arcs
    roundSide :: Maybe Side,
    -- | elements of the contour with their numbers from 0
    elements :: BoxTree (Int, Segment),
    -- | heights of the axis that swivels the blade, at the start and at the end of each element, by
    -- its number; empty without bevels
    axisHeights :: Vector (Mm, Mm)
  }

-- | Facts about a pass with a blade. The axis turns the blade by a wheel of diameter @D2@. For a
-- bevel of @μ°@ the axis is above the height of the pass by @z = ∓π·μ°·D2/360@. The sign is minus
-- on the right of the contour and plus on the left (Kolsanova, section 3, corrected).
bladePass :: Machine -> Milling -> Toolpath.Pass -> BladePass
bladePass machine milling Toolpath.Pass {Toolpath.left, Toolpath.atHeight} =
  BladePass
    { level = atHeight,
      maxReach =
        (if Part.corners milling == Part.Sharp then times 2 else id)
          ( plus
              (Requirement.centreDistance milling left)
              (maximum (fmap (Part.allowance . Part.finish) (Part.elements contour)))
          ),
      tolerance = uncurry max limits,
      axisDeviation = max (Machine.planeResolution machine) (uncurry min limits),
      roundSide =
        if Part.corners milling == Part.Round
          then Requirement.cutterSide milling
          else Nothing,
      elements =
        BoxTree.index
          (BoundingBox.ofSegment . snd)
          (zip [0 ..] (map Part.segment (NonEmpty.toList (Part.elements contour)))),
      axisHeights =
        maybe Vector.empty (fmap (\(a, b) -> (height a, height b))) (Requirement.bevels contour)
    }
  where
    limits = Part.deviationLimits (Part.tolerance milling)
    contour = Part.contour milling
    height bevel = plus atHeight (times (sign * bevel / 2) (fromMaybe (Mm 0) (Part.gear milling)))
    sign = maybe 1 Carrier.sideSign (Requirement.cutterSide milling)

-- | The motion @m@ at the height of a pass. Nothing if the axis does not have the right height at
-- all sample points of @m@.
levelledIn :: Machine -> BladePass -> CutterMotion -> Maybe CutterMotion
levelledIn machine pass m
  | all hasRightHeight (0 : sampled <> joints pass (segment m)) =
    Just m {fromHeight = level pass, toHeight = level pass}
  | otherwise = Nothing
  where
    hasRightHeight k =
      isRightHeight machine pass (Segment.at k (segment m)) (plus low (times k (minus high low)))
    (low, high) = Motion.heights m
    sampled = case segment m of
      -- At an outer corner the blade may have any bevel between those of the two elements. The ends
      -- of a line at a corner therefore prove little, and its middle is sampled as well.
      Straight _ _ -> [0.5, 1]
      -- The axis may have the right height at both ends of an arc and a wrong one between them. So
      -- sample points inside of the arc are tested as well.
      Arc {} -> Motion.samples m

-- | Fractions of a path at which it passes the ends of elements. Between them the bevel is linear
-- in the arc length. A path along several elements could otherwise have the right heights at its
-- sample points and wrong ones between them, where the bevel rises and falls again.
joints :: BladePass -> Segment -> [Double]
joints pass path =
  [ Distance.nearestFraction p path
    | (_, s) <-
        BoxTree.within
          (BoundingBox.inflate reach (BoundingBox.ofSegment path))
          (elements pass),
      p <- [Segment.start s, Segment.end s],
      Distance.toPoint p path <= reach
  ]
  where
    reach = plus (maxReach pass) (tolerance pass)

-- | Test that @z@ is the height of the axis that the nearest element demands, while the centre is
-- at @p@. If several elements are equally near, any height between their demands is right. Round an
-- outer corner the demand changes evenly from that of the one element to that of the other.
isRightHeight :: Machine -> BladePass -> Point -> Mm -> Bool
isRightHeight machine pass p z = case demanded of
  [] -> False
  _ ->
    minus z (maximum (map snd demanded)) <= slack && minus (minimum (map fst demanded)) z <= slack
  where
    demanded = map snd corners <> concat [range i s | (i, s) <- closest, not (isAtCorner i s)]
    range i s =
      [ (minus h uncertainty, plus h uncertainty)
        | let uncertainty = heightUncertainty machine pass i s p,
          Just h <- [axisAt pass i s p]
      ]
    closest = [(i, s) | (d, i, s) <- near, d <= plus nearest (times 2 deviation)]
    corners =
      [ ([i, j], demand)
        | (i, s) <- closest,
          (j, s') <- closest,
          j == (i + 1) `mod` BoxTree.size (elements pass),
          Just demand <- [heightAtCorner machine pass p (i, s) (j, s')]
      ]
    isAtCorner i s =
      any ((i `elem`) . fst) corners && Distance.nearestFraction p s `elem` [0, 1]
    near =
      [ (d, i, s)
        | (i, s) <-
            BoxTree.within
              (BoundingBox.inflate limit (BoundingBox.ofPoints p []))
              (elements pass),
          let d = Distance.toPoint p s,
          d <= limit
      ]
    nearest = minimum (limit : [d | (d, _, _) <- near])
    deviation = plus (tolerance pass) (Machine.planeResolution machine)
    limit = plus (maxReach pass) deviation
    slack = plus (axisDeviation pass) (times 0.5 (Machine.resolutionOf machine Machine.Z))

-- | Range of the heights that the axis may have while the centre is at @p@, by its direction from
-- the outer corner between two elements; they are given with their numbers. Nothing if the elements
-- do not meet at an outer corner with a nearest point at @p@, or if the blade does not go round it
-- on an arc.
heightAtCorner ::
  Machine -> BladePass -> Point -> (Int, Segment) -> (Int, Segment) -> Maybe (Mm, Mm)
heightAtCorner machine pass p (i, s) (j, s') = do
  side <- roundSide pass
  (_, from) <- axisHeights pass Vector.!? i
  (to, _) <- axisHeights pass Vector.!? j
  let corner = Segment.end s
      Rad turn = Vec.signedAngle (Segment.endDirection s) (Segment.startDirection s')
      normal = Vec.to corner (Carrier.beside side (Mm 1) (Segment.endDirection s) corner)
      Rad angle = Vec.signedAngle normal (Vec.to corner p)
      share = max 0 (min 1 (angle / turn))
      Mm away = Vec.distance corner p
      Mm pulse = Machine.planeResolution machine
      rise = minus to from
      uncertainty = times (1.5 * pulse / (away * abs turn)) (max rise (minus (Mm 0) rise))
      height = plus from (times share rise)
  if Vec.isNear corner (Segment.start s')
    && Carrier.sideSign side * turn < negate leastTurn
    && away > 0
    && (Distance.nearestFraction p s == 1 || Distance.nearestFraction p s' == 0)
    then Just (minus height uncertainty, plus height uncertainty)
    else Nothing

-- | Angle in radians below which a joint between two elements does not count as an outer corner.
leastTurn :: Double
leastTurn = 1e-3

-- | Uncertainty in mm of the height that the axis has to have while the centre is at @p@, beside
-- the element @s@ with the number @i@. The reason is that @p@ is rounded to pulses. Inside an arc
-- the contact point moves further than the centre, in proportion to their distances from the arc's
-- centre.
heightUncertainty :: Machine -> BladePass -> Int -> Segment -> Point -> Mm
heightUncertainty machine pass i s p = case axisHeights pass Vector.!? i of
  Just (from, to)
    | Mm l <- Segment.length s,
      Mm rise <- minus to from,
      l > 0 ->
      times (1.5 * magnification * abs rise / l) (Machine.planeResolution machine)
  _ -> Mm 0
  where
    magnification = case s of
      Arc {centre}
        | Mm r <- Segment.radius centre (Segment.start s),
          Mm own <- Vec.distance centre p,
          own > 0 ->
          max 1 (r / own)
      _ -> 1

-- | Height that the axis has to have while the centre is at @p@, beside the element @s@ with the
-- number @i@. This height is linear in the arc length along @s@, and constant beyond the ends of
-- @s@. Nothing if the contour has no bevels.
axisAt :: BladePass -> Int -> Segment -> Point -> Maybe Mm
axisAt pass i s p =
  (\(from, to) -> plus from (times (Distance.nearestFraction p s) (minus to from)))
    <$> axisHeights pass Vector.!? i
