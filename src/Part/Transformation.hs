-- | Transforms operations. A transformation changes contours, points and sides. It does not change
-- cutters, heights and distances.
module Part.Transformation
  ( operation,
    solid,
    image,
  )
where

import Base.Region (Located (..))
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Transformation (Transformation)
import Geometry.Transformation qualified as Transformation
import Geometry.Vec qualified as Vec
import Part.Contour (transformedCurve)
import Part.Part

-- | The image of a solid under the transformation @s@, which does not change its heights.
solid :: Transformation -> Solid -> Solid
solid s body' = body' {outlines = map (onLeft s . image s) (outlines body')}

-- | The image of a contour that has a region on its left, in the direction in which it still has.
onLeft :: Transformation -> Contour -> Contour
onLeft s c = if Transformation.mirrors s then reversedContour c else c

-- | The image of a contour. It is no longer the contour that the program writes.
image :: Transformation -> Contour -> Contour
image s c =
  c
    { elements = fmap moved (elements c),
      breaks = map (Transformation.point s) (breaks c),
      writtenElements = []
    }
  where
    moved e =
      e
        { segment = Transformation.segment s (segment e),
          replaced = transformedCurve s <$> replaced e
        }

-- | The image of the operation @o@ under the transformation @s@. If @s@ mirrors, left and right are
-- swapped.
operation :: Transformation -> Operation -> Operation
operation s o = case o of
  Mill (Located at m) -> Mill (Located at (milling m))
  Pocket (Located at p) ->
    let (wall', islands') = (milling (wall p), map (image s) (islands p))
     in Pocket (Located at p {wall = wall', islands = islands', extent = extentOf (extent p)})
  Drill (Located at d) -> Drill (Located at d {holes = fmap placed (holes d)})
  Carve (Located at c) -> Carve (Located at c {carvedAreas = fmap area (carvedAreas c)})
  Travel stops -> Travel (NonEmpty.map stop stops)
  Command c -> Command c
  where
    area (outer, inner) = (onLeft s (image s outer), map (onLeft s . image s) inner)
    milling m =
      m
        { contour = image s (contour m),
          side = fmap mirrored (side m),
          approach = map stop (approach m),
          retract = map stop (retract m)
        }
    extentOf cleared = case cleared of
      Surface (Facing direction) -> Surface (Facing (moved direction))
      WholePocket -> cleared
      FloorOfCarving -> cleared
      RestOfPocket _ -> cleared
    moved v = Vec.to (movedPoint (Vec.point 0 0)) (movedPoint (Vec.shift v (Vec.point 0 0)))
    movedPoint = Transformation.point s
    stop p = p {place = fmap (Transformation.point s) (place p)}
    placed h = h {holeCentre = fmap (Transformation.point s) (holeCentre h)}
    mirrored side'
      | Transformation.mirrors s = case side' of
        LeftSide -> RightSide
        RightSide -> LeftSide
        Outside -> Outside
        Inside -> Inside
        On -> On
      | otherwise = side'
