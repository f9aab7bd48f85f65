-- | The sections of a DXF file: the header, the layers, the blocks and the entities, still as
-- records.
module Drawing.DxfSection
  ( Sections (..),
    RawBlock (..),
    EntityRecord (..),
    fromRecords,
  )
where

import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Drawing.DxfPair (Pair)
import Drawing.DxfRecord (Record (..))
import Drawing.DxfRecord qualified as DxfRecord
import Drawing.Error (Container (..), DrawingFault (..), Error (Error))

-- | The sections that a reader of drawings needs.
data Sections = Sections
  { -- | the variables of the header, each a pair with code 9 and the pairs of its value
    header :: [Pair],
    -- | the entries of the table of layers
    layers :: [Record],
    blocks :: [RawBlock],
    entities :: [EntityRecord]
  }

-- | A block: the record with its name and base point, and its entities.
data RawBlock = RawBlock {blockHead :: Record, blockEntities :: [EntityRecord]}

-- | An entity, and the records that follow it up to SEQEND: the vertices of a POLYLINE or the
-- attributes of an INSERT.
data EntityRecord = EntityRecord {own :: Record, followers :: [Record]}

-- | A section: its first record, its name, and its other records.
data Section = Section {begin' :: Record, name :: Text, body :: [Record]}

-- | The sections of a file. An error if a section or a block has no end, if a record is outside of
-- all sections, or if the file has no entities.
fromRecords :: [Record] -> Either Error Sections
fromRecords records = do
  sections <- cut records
  let named wanted = [s | s@Section {name} <- sections, name == wanted]
  blocks <- concat <$> traverse (blocksOf . body) (named "BLOCKS")
  entities <- case named "ENTITIES" of
    [] -> Left (Error (lastLine records) (EndsEarly EntitySection))
    found -> concat <$> traverse (sequences . body) found
  Right
    Sections
      { header = concatMap (pairs . begin') (named "HEADER"),
        layers = filter ((== "LAYER") . word) (concatMap body (named "TABLES")),
        blocks,
        entities
      }

lastLine :: [Record] -> Int
lastLine = foldl (\_ record -> begin record) 1

-- | The records divided into sections.
cut :: [Record] -> Either Error [Section]
cut = go []
  where
    go found records = case records of
      [] -> Right (reverse found)
      begin'@Record {begin, word} : rest
        | word /= "SECTION" -> Left (Error begin (Misplaced word))
        | otherwise -> case break ((== "ENDSEC") . DxfRecord.word) rest of
          (_, []) -> Left (Error begin (EndsEarly OneSection))
          (body, _ : more) -> case filter ((== "SECTION") . DxfRecord.word) body of
            inner : _ -> Left (Error (DxfRecord.begin inner) (Misplaced "SECTION"))
            [] -> go (Section {begin', name = nameOf begin', body} : found) more
    nameOf = fromMaybe "" . DxfRecord.text 2

-- | The blocks of the section BLOCKS.
blocksOf :: [Record] -> Either Error [RawBlock]
blocksOf = go []
  where
    go found records = case records of
      [] -> Right (reverse found)
      blockHead@Record {begin, word} : rest
        | word /= "BLOCK" -> Left (Error begin (Misplaced word))
        | otherwise -> case break ((`elem` ["ENDBLK", "BLOCK"]) . DxfRecord.word) rest of
          (body, Record {word = "ENDBLK"} : more) -> do
            blockEntities <- sequences body
            go (RawBlock {blockHead, blockEntities} : found) more
          _ -> Left (Error begin (EndsEarly OneBlock))

-- | The entities, each with the records that belong to it.
sequences :: [Record] -> Either Error [EntityRecord]
sequences = go []
  where
    go found records = case records of
      [] -> Right (reverse found)
      own : rest -> case memberWord own of
        Nothing -> go (EntityRecord {own, followers = []} : found) rest
        Just member -> case span ((== member) . word) rest of
          (followers, Record {word = "SEQEND"} : more) ->
            go (EntityRecord {own, followers} : found) more
          _ -> Left (Error (begin own) (EndsEarly EntitySequence))
    memberWord own
      | word own == "POLYLINE" = Just "VERTEX"
      | word own == "INSERT" && hasAttributes own = Just "ATTRIB"
      | otherwise = Nothing
    hasAttributes own = DxfRecord.wholeOr 0 66 own == Right 1
