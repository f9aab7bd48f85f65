-- | The blocks of a DXF file that are inserted somewhere, and their contents as items.
--
-- The insertions of a small file can multiply without bound. So every block has a weight: the count
-- of the parts of which it will consist. The weights are computed before any insertion is carried
-- out.
module Drawing.DxfBlock
  ( DxfItem (..),
    ItemContent (..),
    BlockContent (..),
    Blocks,
    key,
    RawBlocks,
    rawBlocks,
    contents,
    weight,
  )
where

import Control.Monad (foldM)
import Data.Bifunctor (first)
import Data.Bits (testBit)
import Data.Either (partitionEithers)
import Data.List.NonEmpty (NonEmpty (..))
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Drawing.CodePage (Encoding)
import Drawing.Drawing (RemarkKind (..), Shape)
import Drawing.DxfEntity (ShapeReading (..))
import Drawing.DxfEntity qualified as DxfEntity
import Drawing.DxfInsert (Insert (Insert, blockName, counts))
import Drawing.DxfInsert qualified as DxfInsert
import Drawing.DxfRecord (Record (..))
import Drawing.DxfRecord qualified as DxfRecord
import Drawing.DxfSection (EntityRecord (..), RawBlock (..))
import Drawing.Error (DrawingFault (..), Error (Error))
import Drawing.ShapeCheck qualified as ShapeCheck
import Drawing.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | An entity of a block or of the drawing, in the unit of the file.
data DxfItem = DxfItem
  { -- | number of the line of the file
    itemLine :: Int,
    itemWord :: Text,
    -- | the layer in the file
    itemLayer :: Text,
    content :: ItemContent
  }

-- | The content of an item.
data ItemContent = Shaped Shape | Noted RemarkKind | Inserted Insert

-- | A block with all that it contains.
data BlockContent = BlockContent
  { base :: Point,
    items :: [DxfItem],
    -- | true if the block is in another file
    isExternal :: Bool,
    -- | the count of parts
    parts :: Integer,
    -- | the count of blocks within one another, at least 1
    height :: Int
  }

-- | The blocks that are inserted, by the 'key' of their names.
type Blocks = Map Text BlockContent

-- | The blocks of the file as records, by the 'key' of their names.
type RawBlocks = Map Text RawBlock

-- | The key of a name. Names of blocks and layers that differ only in capitals are the same.
key :: Text -> Text
key = Text.toCaseFold

-- | The blocks of a file by their names.
rawBlocks :: Encoding -> [RawBlock] -> Either Error RawBlocks
rawBlocks encoding blocks = Map.fromList <$> traverse named blocks
  where
    named block = do
      name <- DxfRecord.name encoding 2 (blockHead block)
      Right (maybe "" key name, block)

-- | The items of entities, and all blocks that they insert. All mistakes in these entities, up to a
-- limit, if there are any. Or the one error that a block is missing, contains itself, or is too
-- deep.
contents ::
  Encoding -> RawBlocks -> [EntityRecord] -> Either (NonEmpty Error) (Blocks, [DxfItem])
contents encoding raw records = do
  own <- itemsOf encoding records
  blocks <- foldM (visit encoding raw []) Map.empty own
  Right (blocks, own)

-- | The weight of an item, at least 1: the count of the parts that it becomes.
weight :: Blocks -> DxfItem -> Integer
weight blocks item = case content item of
  Shaped shape -> 1 + toInteger (ShapeCheck.size shape)
  Noted _ -> 1
  Inserted insert -> 1 + members insert * maybe 0 ((1 +) . parts) (blockOf insert)
  where
    members Insert {counts = (columns, rows)} = toInteger columns * toInteger rows
    blockOf insert = Map.lookup (key (blockName insert)) blocks

-- | Adds the block that an item inserts, and all blocks within it. The names of the blocks around
-- the item are given, the innermost first.
visit ::
  Encoding -> RawBlocks -> [Text] -> Blocks -> DxfItem -> Either (NonEmpty Error) Blocks
visit encoding raw around known DxfItem {itemLine, content} = case content of
  Shaped _ -> Right known
  Noted _ -> Right known
  Inserted Insert {blockName}
    | (inside, _ : _) <- break isSame around ->
      wrong (Cycle (blockName : reverse inside <> [blockName]))
    | length around >= Tolerance.mostNesting -> wrong TooDeep
    | Just block <- Map.lookup (key blockName) known ->
      if length around + height block > Tolerance.mostNesting then wrong TooDeep else Right known
    | otherwise -> case Map.lookup (key blockName) raw of
      Nothing -> wrong (BlockUnknown blockName)
      Just block -> do
        (blocks, read') <- readBlock block
        Right (Map.insert (key blockName) read' blocks)
    where
      isSame name = key name == key blockName
      readBlock RawBlock {blockHead, blockEntities} = do
        own <- itemsOf encoding blockEntities
        blocks <- foldM (visit encoding raw (blockName : around)) known own
        read' <- first pure (measured blocks blockHead own)
        Right (blocks, read')
  where
    wrong fault = Left (pure (Error itemLine fault))

-- | A block with its weight and its height, from the blocks within it.
measured :: Blocks -> Record -> [DxfItem] -> Either Error BlockContent
measured blocks record own = do
  x <- DxfRecord.realOr 0 10 record
  y <- DxfRecord.realOr 0 20 record
  flags <- DxfRecord.wholeOr 0 70 record
  Right
    BlockContent
      { base = Vec.point x y,
        items = own,
        isExternal = testBit flags 2 || testBit flags 3,
        parts = sum (map (weight blocks) own),
        height = 1 + maximum (0 : [height b | Inserted i <- map content own, Just b <- [found i]])
      }
  where
    found insert = Map.lookup (key (blockName insert)) blocks

-- | The items of entities, or their mistakes.
itemsOf :: Encoding -> [EntityRecord] -> Either (NonEmpty Error) [DxfItem]
itemsOf encoding records = case partitionEithers (map (itemsOfEntity encoding) records) of
  (e : es, _) -> Left (e :| take (Tolerance.mostErrors - 1) es)
  ([], found) -> Right (concat found)

itemsOfEntity :: Encoding -> EntityRecord -> Either Error [DxfItem]
itemsOfEntity encoding EntityRecord {own, followers} = do
  layer <- DxfRecord.name encoding 8 own
  space <- DxfRecord.wholeOr 0 67 own
  visibility <- DxfRecord.wholeOr 0 60 own
  let item content =
        DxfItem
          { itemLine = begin own,
            itemWord = word own,
            itemLayer = layerName layer,
            content
          }
      noted kind = [item (Noted kind)]
  case () of
    _ | space == 1 -> Right (noted (InPaperSpace (word own)))
    _ | visibility == 1 -> Right (noted (Invisible (word own)))
    _ | word own == "INSERT" -> do
      insert <- DxfInsert.fromRecord encoding own
      Right (item (Inserted insert) : concatMap attribute followers)
    _ -> do
      reading <- DxfEntity.shape own followers
      Right $ case reading of
        Read shape -> [item (Shaped shape)]
        ReadWith kind shape -> [item (Noted kind), item (Shaped shape)]
        LeftOut kind -> noted kind
  where
    layerName = maybe "0" (\name -> if Text.null name then "0" else name)
    attribute record =
      [ DxfItem
          { itemLine = begin record,
            itemWord = word record,
            itemLayer = "0",
            content = Noted (NotUnderstood (word record))
          }
      ]
