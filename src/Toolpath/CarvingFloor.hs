-- | Floors that V-carvings leave: places of their areas that are so wide that the tool, at the
-- largest depth, carves only beside the contours.
module Toolpath.CarvingFloor
  ( Floor (..),
    uncleared,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Base.Region (Located (..), Region)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc (Polyarc)
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Part.Part (Carving)
import Part.Part qualified as Part
import Toolpath.Toolpath (Block (..), Move, Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | A floor that stays: the statement of the V-carving, and a point above the floor.
data Floor = Floor {carvedBy :: Region, floorAt :: Point}
  deriving stock (Eq, Show)

-- | An area of a V-carving.
data Area = Area {box :: BoundingBox, outline :: Polyarc, edges :: BoxTree Segment}

-- | For each V-carving, the first of its floors that no pocket of the toolpath clears down to its
-- depth, and that no deeper V-carving carves. Floors narrower than the tolerance do not count.
uncleared :: Toolpath -> [Floor]
uncleared path =
  concat
    [ take 1 (map (Floor region) (filter (not . isCleared c) (floors c (NonEmpty.toList ms))))
      | Carved (Located region c) ms _ <- Toolpath.blocks path
    ]
  where
    isCleared c p = isInPocket c p || isCarvedDeeper c p
    isCarvedDeeper c p =
      or
        [ Part.carvingDepth other > plus (Part.carvingDepth c) Tolerance.coincident
            && any (\a -> WindingNumber.encloses (outline a) p) (areasOf other)
          | Carved (Located _ other) _ _ <- Toolpath.blocks path
        ]
    isInPocket c p =
      or
        [ WindingNumber.encloses outer p
            && not (any (`WindingNumber.encloses` p) islands)
            && all (\s -> Distance.toPoint p s >= minus (Toolpath.left pass) (slack c)) walls
          | Clearing {pocket = Located _ pocket, pass} <- Toolpath.blocks path,
            Toolpath.atHeight pass <= plus (times (-1) (Part.carvingDepth c)) Tolerance.coincident,
            let outer = Part.polyarcOf (Part.contour (Part.wall pocket)),
            let islands = map Part.polyarcOf (Part.islands pocket),
            let walls = concatMap (NonEmpty.toList . Polyarc.segments) (outer : islands)
        ]

-- | The deviation that a V-carving may have.
slack :: Carving -> Mm
slack c = uncurry max (Part.deviationLimits (Part.carvingTolerance c))

areasOf :: Carving -> [Area]
areasOf c =
  [ Area
      { box = foldr1 BoundingBox.union (fmap BoundingBox.ofSegment segments),
        outline,
        edges = BoxTree.index BoundingBox.ofSegment (concatMap segmentsOf (outline : holes))
      }
    | (outer, inner) <- NonEmpty.toList (Part.carvedAreas c),
      let outline = Part.polyarcOf outer,
      let holes = map Part.polyarcOf inner,
      let segments = Polyarc.segments outline
  ]
  where
    segmentsOf = NonEmpty.toList . Polyarc.segments

-- | Points over the floors of a V-carving. The tool moves at its largest depth, where its axis is
-- 'Part.carvingReach' from the contours, along a floor if a point is further from all of them than
-- the edge of its tip.
floors :: Carving -> [Move] -> [Point]
floors c moves =
  [ p
    | m <- moves,
      isDeepest m,
      let s = Toolpath.segment m,
      t <- [0.1, 0.5, 0.9],
      side <- [Vec.left, Vec.scale (-1) . Vec.left],
      let p = Vec.shift (Vec.scale aside (side (Segment.directionAt t s))) (Segment.at t s),
      area <- BoxTree.within (BoundingBox.ofPoints p []) areas,
      Just (far, _) <- [BoxTree.closest (Distance.toPoint p) p (edges area)],
      minus far (plus (Part.carvingReach c) (Mm aside)) >= times (-0.1) (slack c),
      WindingNumber.encloses (outline area) p
  ]
  where
    areas = BoxTree.index box (areasOf c)
    Mm aside = plus (Part.carvingTip c) (times 0.5 (slack c))
    isDeepest m =
      Segment.length (Toolpath.segment m) > Mm aside
        && snd (Toolpath.heights m) <= bottom
        && fst (Toolpath.heights m) <= bottom
    bottom = plus (times (-1) (Part.carvingDepth c)) Tolerance.coincident
