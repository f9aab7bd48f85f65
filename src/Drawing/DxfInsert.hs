-- | The entity INSERT of a DXF file: a block at a position, or an array of them.
module Drawing.DxfInsert
  ( Insert (..),
    fromRecord,
    maps,
  )
where

import Base.Quantity (Rad, radians)
import Data.Text (Text)
import Drawing.AffineMap (AffineMap, after)
import Drawing.AffineMap qualified as AffineMap
import Drawing.CodePage (Encoding)
import Drawing.DxfEntity (EntityPlane)
import Drawing.DxfEntity qualified as DxfEntity
import Drawing.DxfRecord (Record (..))
import Drawing.DxfRecord qualified as DxfRecord
import Drawing.Error (DrawingFault (..), Error (Error))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | An insertion.
data Insert = Insert
  { -- | the name of the block
    blockName :: Text,
    position :: Point,
    scales :: (Double, Double),
    angle :: Rad,
    -- | the counts of columns and rows, at least 1
    counts :: (Int, Int),
    -- | the distances of columns and of rows, along the axes that are turned by the angle
    distances :: (Double, Double),
    own :: EntityPlane
  }

-- | The insertion of a record. A scale of 0 counts as 1, and so does a count below 1.
fromRecord :: Encoding -> Record -> Either Error Insert
fromRecord encoding record = do
  blockName <- maybe missing Right =<< DxfRecord.name encoding 2 record
  position <- Vec.point <$> DxfRecord.needed 10 record <*> DxfRecord.needed 20 record
  scales <- (,) <$> scale 41 <*> scale 42
  angle <- radians <$> DxfRecord.realOr 0 50 record
  counts <- (,) <$> count 70 <*> count 71
  distances <- (,) <$> DxfRecord.realOr 0 44 record <*> DxfRecord.realOr 0 45 record
  own <- DxfEntity.plane record
  Right Insert {blockName, position, scales, angle, counts, distances, own}
  where
    missing = Left (Error (begin record) (ValueMissing (word record) 2))
    scale code = (\k -> if k == 0 then 1 else k) <$> DxfRecord.realOr 1 code record
    count code = max 1 <$> DxfRecord.wholeOr 1 code record

-- | The maps from the coordinates of a block with a base point to those around its insertion: one
-- for each member of the array, row by row. Nothing if the insertion lies in another plane.
maps :: Point -> Insert -> Maybe [AffineMap]
maps base Insert {position, scales, angle, counts, distances, own} = do
  surroundings <- DxfEntity.fromPlane own
  let turned = AffineMap.rotation angle
      placed = AffineMap.translation (Vec.to origin position)
      scaled = uncurry AffineMap.scaling scales `after` AffineMap.translation (Vec.to base origin)
      member column row =
        AffineMap.translation (Vec.vec (column * fst distances) (row * snd distances))
  Just
    [ surroundings `after` placed `after` turned `after` member column row `after` scaled
      | row <- upTo (snd counts),
        column <- upTo (fst counts)
    ]
  where
    origin = Vec.point 0 0
    upTo n = map fromIntegral [0 .. n - 1]
