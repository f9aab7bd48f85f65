-- | The entities of a DXF file with all insertions carried out, in mm.
module Drawing.DxfExpansion
  ( drawing,
  )
where

import Data.Bifunctor (first)
import Data.List (maximumBy)
import Data.List.NonEmpty (NonEmpty)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Ord (comparing)
import Data.Text (Text)
import Drawing.AffineMap (AffineMap, after)
import Drawing.AffineMap qualified as AffineMap
import Drawing.Assembly (DrawingPart (..))
import Drawing.Assembly qualified as Assembly
import Drawing.CodePage (Encoding)
import Drawing.Drawing (Drawing, Entity (..), Remark (..), RemarkKind (..))
import Drawing.DxfBlock (BlockContent (..), Blocks, DxfItem (..), ItemContent (..))
import Drawing.DxfBlock qualified as DxfBlock
import Drawing.DxfInsert (Insert (blockName))
import Drawing.DxfInsert qualified as DxfInsert
import Drawing.DxfRecord (Record)
import Drawing.DxfRecord qualified as DxfRecord
import Drawing.DxfSection (Sections (..))
import Drawing.Error (DrawingFault (..), Error (Error))
import Drawing.Tolerance qualified as Tolerance

-- | The drawing of a file whose unit has this length in mm. All errors of its entities are
-- reported, up to a limit.
drawing :: Encoding -> Double -> Sections -> Either (NonEmpty Error) Drawing
drawing encoding unit sections = do
  hidden <- first pure (hiddenLayers encoding (layers sections))
  raw <- first pure (DxfBlock.rawBlocks encoding (blocks sections))
  (known, own) <- DxfBlock.contents encoding raw (entities sections)
  let weights = [(DxfBlock.weight known item, itemLine item) | item <- own]
      scaled = AffineMap.scaling unit unit
      context = Context {known, hidden, toDrawing = scaled, layerOfInsert = "0"}
  if sum (map fst weights) > toInteger Tolerance.mostParts
    then Left (pure (Error (snd (maximumBy (comparing fst) weights)) TooManyParts))
    else Assembly.assembled (concatMap (partsOf context) own)

-- Layers --------------------------------------------------------------------------------------

-- | The state of a layer that is not shown. A layer that is frozen also hides the insertions on it.
data Hiding = Frozen | Off
  deriving stock (Eq)

-- | The layers that are not shown, by the keys of their names: frozen ones have the flag 1 in group
-- 70, and those that are off have a negative colour.
hiddenLayers :: Encoding -> [Record] -> Either Error (Map Text Hiding)
hiddenLayers encoding records = Map.fromList . concat <$> traverse hiding records
  where
    hiding record = do
      name <- DxfRecord.name encoding 2 record
      flags <- DxfRecord.wholeOr 0 70 record
      colour <- DxfRecord.wholeOr 7 62 record
      Right
        [ (DxfBlock.key known, if odd flags then Frozen else Off)
          | odd flags || colour < 0,
            Just known <- [name]
        ]

-- Insertions ----------------------------------------------------------------------------------

-- | The surroundings of an item.
data Context = Context
  { known :: Blocks,
    hidden :: Map Text Hiding,
    -- | the map from the coordinates of the item to those of the drawing
    toDrawing :: AffineMap,
    -- | the layer of the insertion around the item; entities on layer 0 take it
    layerOfInsert :: Text
  }

-- | The parts of the drawing that an item becomes.
partsOf :: Context -> DxfItem -> [DrawingPart]
partsOf context DxfItem {itemLine = line, itemWord, itemLayer, content} = case content of
  Noted kind -> [remarked kind]
  Shaped own -> case hiding of
    Just _ -> [remarked (OnHiddenLayer itemWord layer)]
    Nothing ->
      [ Assembly.partOf
          Entity
            { line,
              word = itemWord,
              layer,
              identifiers = [],
              classes = [],
              shape = AffineMap.shape (toDrawing context) own
            }
      ]
  Inserted insert
    | hiding == Just Frozen -> [remarked (OnHiddenLayer itemWord layer)]
    | otherwise -> case Map.lookup (DxfBlock.key (blockName insert)) (known context) of
      Nothing -> [Wrong (Error line (BlockUnknown (blockName insert)))]
      Just block
        | isExternal block -> [remarked (Unusable itemWord "its block is in another file")]
        | otherwise ->
          maybe [remarked (NotInPlane itemWord)] (concatMap (inserted block)) (maps block)
    where
      maps block = DxfInsert.maps (base block) insert
  where
    layer = if itemLayer == "0" then layerOfInsert context else itemLayer
    hiding = Map.lookup (DxfBlock.key layer) (hidden context)
    remarked = remarkOn line layer
    inserted block m =
      concatMap
        (partsOf context {toDrawing = toDrawing context `after` m, layerOfInsert = layer})
        (items block)

-- | A remark on an entity with its line and its layer.
remarkOn :: Int -> Text -> RemarkKind -> DrawingPart
remarkOn line layer kind =
  Remarked
    Remark
      { remarkLine = line,
        remarkKind = kind,
        remarkLayer = layer,
        remarkIdentifiers = [],
        remarkClasses = []
      }
