-- | Strokes of a swivelling blade as if its axis stood in its middle position.
--
-- The height of the axis says how far the blade is turned. Where that is what the contour asks for
-- at the place of the stroke, to a pulse, the stroke counts as one at the height of the pass;
-- elsewhere it stays as it is, and is not taken for a stroke along the contour.
module Verify.Swivel
  ( levelled,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Base.Region (Located (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier (Side (..))
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
import Toolpath.FromPart qualified as Toolpath (leadingSide)
import Toolpath.Swivel qualified as Swivel
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.Motion (CutterMotion (..), heights, line)
import Verify.Motion qualified as Motion

-- | The strokes of a tape, those along the contours of a blade at the heights of their passes.
levelled :: Machine -> Toolpath -> [CutterMotion] -> [CutterMotion]
levelled machine path = foldr (\p next -> map (onLevel machine p) . next) id blades
  where
    blades =
      [ blade milling pass
        | Toolpath.Cutting {Toolpath.job = Located _ milling, Toolpath.pass} <-
            Toolpath.blocks path,
          Just _ <- [Part.gear milling]
      ]

-- | A pass along a contour with a blade: how far the tool's centre stands from it at most, its
-- elements with their numbers, the heights of the axis at their ends.
data Blade = Blade
  { level :: Mm,
    furthest :: Mm,
    allowed :: Mm,
    elements :: BoxTree (Int, Segment),
    axes :: Vector (Mm, Mm)
  }

blade :: Milling -> Toolpath.Pass -> Blade
blade milling Toolpath.Pass {Toolpath.reach, Toolpath.atHeight} =
  Blade
    { level = atHeight,
      furthest =
        (if Part.corners milling == Part.Sharp then times 2 else id)
          ( plus
              reach
              (maximum (fmap (Part.allowance . Part.finish) (Part.elements (Part.contour milling))))
          ),
      allowed = uncurry max (Part.deepest (Part.tolerance milling)),
      elements =
        BoxTree.index
          (BoundingBox.ofSegment . snd)
          (zip [0 ..] (map Part.segment (NonEmpty.toList (Part.elements (Part.contour milling))))),
      axes =
        maybe
          Vector.empty
          (fmap (\(a, b) -> (height a, height b)))
          (Swivel.bevels (Part.contour milling))
    }
  where
    height angle = plus atHeight (times (sign * angle / 2) (fromMaybe (Mm 0) (Part.gear milling)))
    sign = case Toolpath.leadingSide milling of
      Right (Just RightOf) -> -1
      Right (Just LeftOf) -> 1
      Right Nothing -> 1
      Left _ -> 1

onLevel :: Machine -> Blade -> CutterMotion -> CutterMotion
onLevel machine b t
  | and [fits (Segment.at k (line t)) (plus low (times k (minus high low))) | k <- 0 : looked] =
    t {fromHeight = level b, toHeight = level b}
  | otherwise = t
  where
    (low, high) = heights t
    -- An arc stays at its height, whatever the contour asks for between its ends.
    looked = case line t of
      -- Between corners that are gone round, at which it may stand anywhere between, in the middle
      -- as well.
      Straight _ _ -> [0.5, 1]
      Arc {} -> Motion.places t
    -- What the tool touches is nearest to it.
    fits p z =
      case [ (minus h blur, plus h blur)
             | (d, i, s) <- beside p,
               d <= plus (nearest p) (times 2 off),
               let blur = blurAt i s p,
               Just h <- [axisAt b i s p]
           ] of
        [] -> False
        hs -> minus z (maximum (map snd hs)) <= slack && minus (minimum (map fst hs)) z <= slack
    beside p =
      [ (d, i, s)
        | (i, s) <-
            BoxTree.within
              (BoundingBox.inflate around (BoundingBox.ofPoints p []))
              (elements b),
          let d = Distance.toPoint p s,
          d <= around
      ]
    nearest p = minimum (around : [d | (d, _, _) <- beside p])
    off = plus (allowed b) (Machine.pulse machine)
    around = plus (furthest b) off
    -- The place is off by a pulse as well, about the inside of an arc by as much more as its radius
    -- is larger than that on which the centre goes.
    blurAt i s p = case axes b Vector.!? i of
      Just (from, to)
        | Mm l <- Segment.length s,
          l > 0 ->
          times
            (1.5 * lever s p / l * abs (let Mm rise = minus to from in rise))
            (Machine.pulse machine)
      _ -> Mm 0
    lever s p = case s of
      Arc {centre}
        | Mm r <- Segment.radius centre (Segment.start s),
          Mm own <- Vec.distance centre p,
          own > 0 ->
          max 1 (r / own)
      _ -> 1
    slack = times 1.5 (max (Machine.pulse machine) (Machine.pulseOf machine Machine.Z))

-- | The height of the axis beside a place of an element.
axisAt :: Blade -> Int -> Segment -> Point -> Maybe Mm
axisAt b i s p = (\(from, to) -> plus from (times share (minus to from))) <$> axes b Vector.!? i
  where
    share
      | Segment.spans s p = max 0 (min 1 (Segment.fraction s p))
      | Vec.distance p (Segment.start s) <= Vec.distance p (Segment.end s) = 0
      | otherwise = 1
