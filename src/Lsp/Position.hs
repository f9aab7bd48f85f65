-- | The positions of the Language Server Protocol, which count lines and UTF-16 code units from 0.
-- The compiler uses offsets: counts of characters from the beginning of a source. A source is a
-- main file with its imported files. Only this module converts between positions and offsets.
module Lsp.Position
  ( LspPosition (..),
    LspRange (..),
    position,
    range,
    fileOf,
    offset,
    region,
    charactersIn,
  )
where

import Base.Region (Region (..), Source)
import Base.Region qualified as Region
import Data.Aeson (FromJSON (..), ToJSON (..), object, withObject, (.:), (.=))
import Data.Char (ord)
import Data.Text (Text)
import Data.Text qualified as Text

-- | A position: the line, from 0, and the count of UTF-16 code units before it on that line.
data LspPosition = LspPosition {line :: Int, character :: Int}
  deriving stock (Eq, Ord, Show)

-- | A range: the position of its first character, and the position after its last one.
data LspRange = LspRange {from :: LspPosition, to :: LspPosition}
  deriving stock (Eq, Ord, Show)

instance ToJSON LspPosition where
  toJSON LspPosition {line, character} = object ["line" .= line, "character" .= character]

instance FromJSON LspPosition where
  parseJSON = withObject "a position" (\o -> LspPosition <$> o .: "line" <*> o .: "character")

instance ToJSON LspRange where
  toJSON LspRange {from, to} = object ["start" .= from, "end" .= to]

instance FromJSON LspRange where
  parseJSON = withObject "a range" (\o -> LspRange <$> o .: "start" <*> o .: "end")

-- | The position of the offset @at@. It counts lines in the file that contains the offset: the main
-- file or an imported one.
position :: Source -> Int -> LspPosition
position source at =
  LspPosition
    { line = Region.line inFile - 1,
      character = units (Text.take (Region.column inFile - 1) (Region.lineText source at))
    }
  where
    inFile = Region.position source at

-- | The range of a region. Its positions count lines in the file that contains the region.
range :: Source -> Region -> LspRange
range source (Region from to) = LspRange (position source from) (position source to)

-- | The path of the file in which a region lies.
fileOf :: Source -> Region -> Text
fileOf source (Region from _) = Region.file (Region.position source from)

-- | The offset of a position in the main file of a source. A position beyond the end of its line
-- gives the end of the line; one beyond the last line gives the end of the text. A position inside
-- a surrogate pair gives the beginning of the character.
offset :: Source -> LspPosition -> Int
offset source LspPosition {line, character} =
  Region.offset source ordinal (1 + charactersIn character content)
  where
    ordinal = min line (maxBound - 1) + 1
    content = Region.lineText source (Region.offset source ordinal 1)

-- | The region of a range in the main file of a source. Some clients send the end of a range before
-- its beginning; the result is in order.
region :: Source -> LspRange -> Region
region source LspRange {from, to} = Region (min a b) (max a b)
  where
    a = offset source from
    b = offset source to

-- | The count of UTF-16 code units of a text.
units :: Text -> Int
units = Text.foldl' (\count c -> count + width c) 0

-- | The count of characters at the beginning of a text that fit into @limit@ UTF-16 code units.
charactersIn :: Int -> Text -> Int
charactersIn limit =
  length . takeWhile (<= limit) . drop 1 . scanl (\count c -> count + width c) 0 . Text.unpack

-- | The count of UTF-16 code units of a character: 2 outside of the basic multilingual plane,
-- otherwise 1.
width :: Char -> Int
width c = if ord c > 0xFFFF then 2 else 1
