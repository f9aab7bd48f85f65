{-# OPTIONS_GHC -O2 #-}

-- | Offset loops in flat arrays: closed loops of lines and arcs. They bound the region that the
-- cutter's centre can reach. They are cut out of the raw offset, the contour's segments moved
-- sideways and joined ("Offset.RawOffset"). Loops, segments and vertices are numbered from 0.
module Offset.Loop
  ( OffsetLoops (..),
    none,
    untrimmed,
    count,
    size,
    polyarc,
    polyarcs,
    area,
    filtered,
  )
where

import Data.Int (Int32)
import Data.Primitive.PrimArray
import Geometry.ClosedPolyarcs (ClosedPolyarcs)
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.FlatPolyarc (FlatPolyarc (FlatPolyarc))
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Polyarc (Ends (..))

-- | The loops, one after the other in arrays that all loops share. Segment @i@ leads from vertex
-- @i@ to the next vertex of its loop; the last segment of a loop leads to the loop's first vertex.
data OffsetLoops = OffsetLoops
  { -- | the index of each loop's first vertex, followed by the number of all vertices
    starts :: PrimArray Int,
    -- | x of the vertices, in mm
    xs :: PrimArray Double,
    -- | y of the vertices, in mm
    ys :: PrimArray Double,
    -- | @tan(sweep/4)@ of the segments, 0 for a line
    bulges :: PrimArray Double,
    -- | for each segment: the number of the segment of the raw offset from which it was cut
    raws :: PrimArray Int32
  }

-- | Offset loops without any loop: the boundary of an empty region.
none :: OffsetLoops
none =
  OffsetLoops
    (primArrayFromList [0])
    (primArrayFromList [])
    (primArrayFromList [])
    (primArrayFromList [])
    (primArrayFromList [])

-- | All closed polyarcs of the raw offset @c@ as loops, untrimmed.
untrimmed :: ClosedPolyarcs -> OffsetLoops
untrimmed c =
  OffsetLoops
    { starts = primArrayFromList (scanl (+) 0 (map length ranges)),
      xs = gathered (ClosedPolyarcs.xs c),
      ys = gathered (ClosedPolyarcs.ys c),
      bulges = gathered (ClosedPolyarcs.bulges c),
      raws = primArrayFromList (map fromIntegral (concat ranges))
    }
  where
    ranges =
      [ [ClosedPolyarcs.firstVertex c w .. ClosedPolyarcs.repeatedVertex c w - 1]
        | w <- [0 .. ClosedPolyarcs.loopCount c - 1]
      ]
    gathered a = primArrayFromList (map (indexPrimArray a) (concat ranges))

-- | The number of loops.
count :: OffsetLoops -> Int
count l = sizeofPrimArray (starts l) - 1

-- | The number of segments of the loop with the number @k@.
size :: OffsetLoops -> Int -> Int
size l k = indexPrimArray (starts l) (k + 1) - indexPrimArray (starts l) k

-- | The loop with the number @k@ as a polyarc.
polyarc :: OffsetLoops -> Int -> FlatPolyarc
polyarc l k = FlatPolyarc Closed (cut (xs l)) (cut (ys l)) (cut (bulges l))
  where
    cut :: PrimArray Double -> PrimArray Double
    cut s = clonePrimArray s (indexPrimArray (starts l) k) (size l k)

-- | All loops as polyarcs.
polyarcs :: OffsetLoops -> [FlatPolyarc]
polyarcs l = map (polyarc l) [0 .. count l - 1]

-- | The area in mm² that all loops enclose. A clockwise loop, the boundary of a hole, counts as
-- negative.
area :: OffsetLoops -> Double
area = sum . map FlatPolyarc.area . polyarcs

-- | The loops for whose numbers @keep@ is True. They get new numbers from 0, in the old order.
filtered :: (Int -> Bool) -> OffsetLoops -> OffsetLoops
filtered keep l
  | length kept == count l = l
  | otherwise =
    OffsetLoops
      { starts = primArrayFromList (scanl (+) 0 (map (size l) kept)),
        xs = gathered (xs l),
        ys = gathered (ys l),
        bulges = gathered (bulges l),
        raws = gathered (raws l)
      }
  where
    kept = filter keep [0 .. count l - 1]
    begin = indexPrimArray (starts l)
    gathered a = mconcat [clonePrimArray a (begin k) (size l k) | k <- kept]
