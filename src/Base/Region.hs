{-# LANGUAGE PatternSynonyms #-}
{-# LANGUAGE ViewPatterns #-}

-- | Places in a source text.
--
-- Inside the compiler a place is an offset in characters (code points). The texts of a
-- program and of what it imports lie one behind the other, so an offset tells the file as
-- well. This module is the only one that turns offsets into lines and columns; both
-- count from 1, and a column counts characters.
module Base.Region
  ( Region (Region, start, end),
    Located (..),
    Source,
    Position (..),
    span,
    merge,
    fromText,
    add,
    next,
    text,
    mainFile,
    position,
    offset,
    lineText,
    pieces,
  )
where

import Base.BinarySearch qualified as BinarySearch
import Data.Bits (shiftL, shiftR, (.&.), (.|.))
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Vector qualified as Boxed
import Data.Vector.Unboxed qualified as Vector
import Prelude hiding (length, span)

-- | A stretch of the source. There is one for every word of a program, so it takes one word of
-- memory: the upper half is the offset of its beginning, the lower half that of its end. Texts have
-- fewer than 2³² characters.
newtype Region = Halves Word
  deriving newtype (Eq, Ord)

-- | A stretch by the offsets of its first character and of the one behind its last, neither of
-- which is below zero.
pattern Region :: Int -> Int -> Region
pattern Region {start, end} <-
  (offsets -> (start, end))
  where
    Region begin finish = Halves (fromIntegral begin `shiftL` half .|. fromIntegral finish)

{-# COMPLETE Region #-}

instance Show Region where
  showsPrec depth (Region a b) =
    showParen
      (depth > 10)
      (showString "Region {start = " . shows a . showString ", end = " . shows b . showString "}")

offsets :: Region -> (Int, Int)
offsets (Halves both) =
  (fromIntegral (both `shiftR` half), fromIntegral (both .&. (1 `shiftL` half - 1)))
{-# INLINE offsets #-}

-- | The bits of one offset.
half :: Int
half = 32

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

-- | Texts with an index of their lines, the program's own first. Lines end with LF, CR or CR LF.
data Source = Source {own :: File, imported :: Boxed.Vector File}

-- The lines are looked for only when a place is asked for.
data File = File
  { path :: Text,
    base :: Int,
    content :: Text,
    length :: Int,
    starts :: ~(Vector.Vector Int),
    contents :: ~(Boxed.Vector Text)
  }

-- | A file, a line and a column; the numbers count from 1.
data Position = Position {file :: Text, line :: Int, column :: Int}
  deriving stock (Eq, Ord, Show)

-- | Index the text of a program; the first argument names its file. Linear in its length.
fromText :: Text -> Text -> Source
fromText path content = Source {own = indexed path 0 content, imported = Boxed.empty}

-- | Put another file behind the ones that are there.
add :: Text -> Text -> Source -> Source
add path content source =
  source {imported = Boxed.snoc (imported source) (indexed path (next source) content)}

-- | The offset at which the next file will begin.
next :: Source -> Int
next source = let final = fileAt source maxBound in base final + length final + 1

-- | The program's own text.
text :: Source -> Text
text = content . own

-- | The program's own file.
mainFile :: Source -> Text
mainFile = path . own

indexed :: Text -> Int -> Text -> File
indexed path base content =
  File
    { path,
      base,
      content,
      length = Text.length content,
      starts = Vector.fromList (map fst (numbered content)),
      contents = Boxed.fromList (map snd (numbered content))
    }

-- | The lines with the offsets at which they begin.
numbered :: Text -> [(Int, Text)]
numbered = go 0
  where
    go at rest =
      let (before, after) = Text.break (\c -> c == '\n' || c == '\r') rest
          ending = case Text.unpack (Text.take 2 after) of
            "\r\n" -> 2
            [] -> 0
            _ -> 1
       in (at, before) :
          if ending == 0
            then []
            else go (at + Text.length before + ending) (Text.drop ending after)

-- | The file that holds an offset; an offset outside all counts as the nearest.
fileAt :: Source -> Int -> File
fileAt source at =
  Boxed.foldl' (\_ file' -> file') (own source) (Boxed.takeWhile ((<= at) . base) (imported source))

-- | The position of an offset; an offset outside its text counts as its nearest end.
position :: Source -> Int -> Position
position source at =
  Position {file = path found, line = index + 1, column = within + 1 - starts found Vector.! index}
  where
    found = fileAt source at
    within = max 0 (min (at - base found) (length found))
    index = lineIndex found within

-- | The offset of a line and a column of the program's own text, both from 1; a column behind its
-- line counts as its end.
offset :: Source -> Int -> Int -> Int
offset Source {own} line column
  | line > Vector.length (starts own) = length own
  | otherwise =
    starts own Vector.! index + max 0 (min (column - 1) (Text.length (contents own Boxed.! index)))
  where
    index = max 0 (line - 1)

-- | The last line that begins at or before an offset within its file.
lineIndex :: File -> Int -> Int
lineIndex File {starts} at = BinarySearch.lastBelow (Vector.length starts) at starts

-- | The line in which an offset lies, without its line end.
lineText :: Source -> Int -> Text
lineText source at =
  let found =
        fileAt source at
   in contents found Boxed.! lineIndex found (max 0 (min (at - base found) (length found)))

-- | What lies in a region of each of its lines, without their line ends.
pieces :: Source -> Region -> [Text]
pieces source (Region from to) =
  [ part (starts found Vector.! i) (contents found Boxed.! i)
    | i <- [lineIndex found a .. lineIndex found b]
  ]
  where
    found = fileAt source from
    (a, b) = (within from, within to)
    within at = max 0 (min (at - base found) (length found))
    part begin line = Text.take (b - max a begin) (Text.drop (a - begin) line)
