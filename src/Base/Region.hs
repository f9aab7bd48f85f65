{-# LANGUAGE PatternSynonyms #-}
{-# LANGUAGE ViewPatterns #-}

-- | Regions of the source text, and their lines and columns.
--
-- An offset is a position in the source as a number: it counts characters (code points) from 0. The
-- count starts in the text of the program and continues through the texts of its imports, so an
-- offset also determines the file. Only this module converts offsets to lines and columns. Lines
-- and columns are numbered from 1, and a column counts characters.
module Base.Region
  ( Region (Region, start, end),
    Located (..),
    Source,
    Position (..),
    span,
    merge,
    fromText,
    addFile,
    nextOffset,
    text,
    mainFile,
    files,
    position,
    offset,
    lineText,
    linesIn,
    numbered,
  )
where

import Base.BinarySearch qualified as BinarySearch
import Data.Bits (shiftL, shiftR, (.&.), (.|.))
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Vector qualified as Boxed
import Data.Vector.Unboxed qualified as Vector
import Prelude hiding (length, span)

-- | A region: a range of characters of the source. Every token of a program has a region. To save
-- memory, a region is one word: the upper half is the offset of its start, the lower half the
-- offset of its end. All offsets are below 2³²: the texts of a program are much shorter.
newtype Region = Halves Word
  deriving newtype (Eq, Ord)

-- | A region as two offsets: @start@ is the offset of its first character, and @end@ is the offset
-- after its last character. Neither is below 0.
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

-- | The offsets at which a region starts and ends.
offsets :: Region -> (Int, Int)
offsets (Halves both) =
  (fromIntegral (both `shiftR` half), fromIntegral (both .&. (1 `shiftL` half - 1)))
{-# INLINE offsets #-}

-- | The count of bits for one of the two offsets in a region: half of a 64-bit word.
half :: Int
half = 32

-- | A value, and the region of the source from which it comes.
data Located a = Located {region :: Region, value :: a}
  deriving stock (Eq, Show)

instance Functor Located where
  fmap f (Located region value) = Located region (f value)

-- | The region from the start of the first region to the end of the second.
span :: Region -> Region -> Region
span a b = Region (start a) (end b)

-- | The smallest region that contains both regions, in either order.
merge :: Region -> Region -> Region
merge a b = Region (min (start a) (start b)) (max (end a) (end b))

-- | The text of a program and the texts that it imports, with an index of their lines. Lines end
-- with LF, CR or CR LF.
data Source = Source {own :: File, imported :: Boxed.Vector File}

-- | A file of a source: its path and its text. The index of its lines is computed on demand.
data File = File
  { path :: Text,
    -- | the offset of the text's first character in the source
    base :: Int,
    content :: Text,
    -- | the count of the text's characters
    length :: Int,
    -- | for every line, the count of this text's characters before the line
    starts :: ~(Vector.Vector Int),
    -- | the texts of the lines, without their line ends
    contents :: ~(Boxed.Vector Text)
  }

-- | A position as the path of a file, a line and a column. Line and column count from 1.
data Position = Position {file :: Text, line :: Int, column :: Int}
  deriving stock (Eq, Ord, Show)

-- | The source of a program without imports, from the path of its file and its text.
fromText :: Text -> Text -> Source
fromText path content = Source {own = indexed path 0 content, imported = Boxed.empty}

-- | Appends an imported file, given by its path and its text, to a source.
addFile :: Text -> Text -> Source -> Source
addFile path content source =
  source {imported = Boxed.snoc (imported source) (indexed path (nextOffset source) content)}

-- | The offset at which the next appended file begins. It is one more than the end of the last
-- text, so that this end belongs to no other file.
nextOffset :: Source -> Int
nextOffset source = let final = fileAt source maxBound in base final + length final + 1

-- | The text of the program itself.
text :: Source -> Text
text = content . own

-- | The path of the program's own file.
mainFile :: Source -> Text
mainFile = path . own

-- | All files of a source, each with its path and its text: the program's own file, then the
-- imported files.
files :: Source -> [(Text, Text)]
files Source {own, imported} = [(path f, content f) | f <- own : Boxed.toList imported]

-- | Makes a file with an index of its lines. @base@ is the offset of its first character.
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

-- | The lines of a text, without their line ends. The number of each pair is the count of the
-- text's characters before the line.
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

-- | The file that contains an offset. An offset outside of all files belongs to the nearest file.
fileAt :: Source -> Int -> File
fileAt source at =
  Boxed.foldl' (\_ file' -> file') (own source) (Boxed.takeWhile ((<= at) . base) (imported source))

-- | The position of an offset. An offset below 0 counts as 0, and an offset beyond the last text
-- counts as the end of that text.
position :: Source -> Int -> Position
position source at =
  Position {file = path found, line = index + 1, column = within + 1 - starts found Vector.! index}
  where
    found = fileAt source at
    within = max 0 (min (at - base found) (length found))
    index = lineIndex found within

-- | The offset of a position in the program's own file, given by line and column from 1. A column
-- beyond the end of its line counts as that end, and a line beyond the text counts as the text's
-- end.
offset :: Source -> Int -> Int -> Int
offset Source {own} line column
  | line > Vector.length (starts own) = length own
  | otherwise =
    starts own Vector.! index + max 0 (min (column - 1) (Text.length (contents own Boxed.! index)))
  where
    index = max 0 (line - 1)

-- | The index, from 0, of the line of a file that contains the offset @at@. This offset counts from
-- the start of the file.
lineIndex :: File -> Int -> Int
lineIndex File {starts} at = BinarySearch.lastAtMost (Vector.length starts) at starts

-- | The text of the line that contains an offset, without its line end.
lineText :: Source -> Int -> Text
lineText source at = contents found Boxed.! lineIndex found within
  where
    found = fileAt source at
    within = max 0 (min (at - base found) (length found))

-- | The text of a region, divided into lines, without the line ends.
linesIn :: Source -> Region -> [Text]
linesIn source (Region from to) =
  [ part (starts found Vector.! i) (contents found Boxed.! i)
    | i <- [lineIndex found a .. lineIndex found b]
  ]
  where
    found = fileAt source from
    (a, b) = (within from, within to)
    within at = max 0 (min (at - base found) (length found))
    part begin line = Text.take (b - max a begin) (Text.drop (a - begin) line)
