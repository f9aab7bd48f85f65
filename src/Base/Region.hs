-- | Places in a source text.
--
-- Inside the compiler a place is an offset in characters (code points) from the
-- start of the text. This module is the only one that turns offsets into lines
-- and columns; both count from 1, and a column counts characters.
module Base.Region
  ( Region (..),
    Located (..),
    Source,
    Position (..),
    span,
    merge,
    fromText,
    text,
    position,
    lineText,
  )
where

import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Vector qualified as Boxed
import Data.Vector.Unboxed qualified as Vector
import Prelude hiding (length, span)

-- | A stretch of the source: offsets of its first character and of the one behind its last.
data Region = Region {start :: Int, end :: Int}
  deriving stock (Eq, Ord, Show)

-- | A thing and where it stands.
data Located a = Located {region :: Region, value :: a}
  deriving stock (Eq, Show)

instance Functor Located where
  fmap f (Located region value) = Located region (f value)

-- | From the beginning of one region to the end of another.
span :: Region -> Region -> Region
span a b = Region (start a) (end b)

-- | The smallest region that holds both.
merge :: Region -> Region -> Region
merge a b = Region (min (start a) (start b)) (max (end a) (end b))

-- | A text with an index of its lines. Lines end with LF, CR or CR LF.
data Source = Source {text :: Text, length :: Int, starts :: Vector.Vector Int, contents :: Boxed.Vector Text}

-- | A line and a column, both from 1.
data Position = Position {line :: Int, column :: Int}
  deriving stock (Eq, Ord, Show)

-- | Index a text. Linear in its length.
fromText :: Text -> Source
fromText text = Source {text, length = Text.length text, starts = Vector.fromList (map fst found), contents = Boxed.fromList (map snd found)}
  where
    found = go 0 text
    go at rest =
      let (before, after) = Text.break (\c -> c == '\n' || c == '\r') rest
          ending = case Text.unpack (Text.take 2 after) of
            "\r\n" -> 2
            [] -> 0
            _ -> 1
       in (at, before) : if ending == 0 then [] else go (at + Text.length before + ending) (Text.drop ending after)

-- | The position of an offset; an offset outside the text counts as its nearest end.
position :: Source -> Int -> Position
position Source {length, starts} offset = Position {line = index + 1, column = at - starts Vector.! index + 1}
  where
    at = max 0 (min offset length)
    index = search 0 (Vector.length starts)
    -- The last line that begins at or before the offset: low is such a line, high is not.
    search low high
      | high - low <= 1 = low
      | starts Vector.! middle <= at = search middle high
      | otherwise = search low middle
      where
        middle = (low + high) `div` 2

-- | A line by its number from 1, without its line end.
lineText :: Source -> Int -> Text
lineText Source {contents} line = Maybe.fromMaybe "" (contents Boxed.!? (line - 1))
