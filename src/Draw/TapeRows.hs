-- | Picture of a tape as text, for the user to read: a line for each row, with the row's holes and
-- its meaning. The medium of some machines is a text, without holes. Its picture has a line for
-- each line of this text.
module Draw.TapeRows
  ( RowRange (..),
    picture,
    extent,
    chosen,
    sprocket,
  )
where

import Base.Decimal qualified as Decimal
import Data.Bits (testBit)
import Data.List (foldl')
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Tape.Layout (RowKind (..))
import Tape.RowMeaning (Row (..))
import Tape.RowMeaning qualified as RowMeaning

-- | Part of a tape to show, as first and last number, both included. Frames and rows count from 1.
-- If the medium is a text, 'Rows' counts its lines.
data RowRange = Everything | Frames Int Int | Rows Int Int
  deriving stock (Eq, Show)

-- | Picture of the rows in @range@; Nothing if there are none. @rows@ are all rows of the tape.
picture :: Machine -> RowRange -> [Row] -> Maybe Text
picture machine range rows = case (Machine.pitch (Machine.medium machine), found) of
  (_, []) -> Nothing
  (Just _, _) -> Just (Text.unlines (heading (Machine.tracks (Machine.medium machine)) : found))
  (Nothing, _) -> Just (Text.unlines found)
  where
    found = pictureLines machine range rows

-- | Lines of the picture, without the heading.
pictureLines :: Machine -> RowRange -> [Row] -> [Text]
pictureLines machine range rows = case Machine.pitch (Machine.medium machine) of
  Just _ -> concatMap (holed machine) (folded (chosen range (zip [1 ..] rows)))
  Nothing -> mapMaybe (printed machine) (chosen' range (zip [1 ..] (textLines rows)))
  where
    chosen' r = filter (\(n, line) -> any (\row -> inRange r n row) line)

-- | Unit in which @range@ counts, and the count of these units on the whole tape. The unit is a
-- frame, a row, or a line of a text; the result has its name for reports.
extent :: Machine -> RowRange -> [Row] -> (Text, Int)
extent machine range rows = case (range, Machine.pitch (Machine.medium machine)) of
  (Frames _ _, _) -> ("frame", foldl' max 0 (mapMaybe frame rows))
  (_, Just _) -> ("row", length rows)
  (_, Nothing) -> ("line", length (textLines rows))

-- | Row with its number, from 1.
type Numbered = (Int, Row)

-- | Rows in a range.
chosen :: RowRange -> [Numbered] -> [Numbered]
chosen range = filter (uncurry (inRange range)) . untilEnd
  where
    -- Stops early, because the rows after the range need not be computed.
    untilEnd = case range of
      Everything -> id
      Rows _ b -> takeWhile ((<= b) . fst)
      Frames _ b -> takeWhile (maybe True (<= b) . frame . snd)

-- | True if @range@ contains @row@. @n@ is the number of the row, counted from 1; in a text medium
-- it is the number of the line to which the row belongs.
inRange :: RowRange -> Int -> Row -> Bool
inRange range n row = case range of
  Everything -> True
  Rows a b -> a <= n && n <= b
  Frames a b -> maybe False (\k -> a <= k && k <= b) (frame row)

-- Holes -------------------------------------------------------------------------------------------

-- | Heading with the track numbers, for a tape with the given count of tracks.
heading :: Int -> Text
heading tracks = "   row  " <> acrossTracks tracks Decimal.whole

-- | Joins one text for each of @tracks@ tracks, the highest track first; @each@ gives the text of a
-- track. The mark ∘ of the sprocket hole is inserted at its position between two tracks.
acrossTracks :: Int -> (Int -> Text) -> Text
acrossTracks tracks each =
  Text.unwords
    (concat [[each k] <> ["∘" | k == sprocket tracks + 1] | k <- [tracks, tracks - 1 .. 1]])

-- | Number, from 1, of the last track before the sprocket holes, by the count of tracks. The
-- sprocket holes lie between tracks 2 and 3 of a tape with at most five tracks, and between tracks
-- 3 and 4 of a wider tape.
sprocket :: Int -> Int
sprocket tracks = if tracks <= 5 then 2 else 3

-- | Groups neighbouring blank rows that have the same purpose and belong to the same frame. Every
-- other row is a group by itself.
folded :: [Numbered] -> [NonEmpty Numbered]
folded = NonEmpty.groupBy together
  where
    together (_, a) (_, b) = isBlank a && kind a == kind b && frame a == frame b

isBlank :: Row -> Bool
isBlank row = case kind row of
  Blank _ -> True
  Opening _ -> False
  Closing _ -> False
  Constant _ -> False
  Separator _ -> False
  CheckSymbol _ -> False
  InWord {} -> False

-- | Greatest count of blank rows that are shown one by one.
fewBlanks :: Int
fewBlanks = 3

-- | Lines of the picture for a group of rows. More than 'fewBlanks' blank rows share one line,
-- which shows their count.
holed :: Machine -> NonEmpty Numbered -> [Text]
holed machine group@((n, row) :| _)
  | count > fewBlanks =
    [ Text.justifyRight 6 ' ' (Decimal.whole n)
        <> "  "
        <> dots
        <> "  "
        <> meaning row
        <> ", "
        <> Decimal.whole count
        <> " rows"
    ]
  | otherwise = map line (NonEmpty.toList group)
  where
    count = NonEmpty.length group
    tracks = Machine.tracks (Machine.medium machine)
    dots = acrossTracks tracks (const "⋮")
    line (k, r) =
      Text.justifyRight 6 ' ' (Decimal.whole k)
        <> "  "
        <> acrossTracks tracks (hole r)
        <> "  "
        <> frameWord r
        <> meaning r
    hole r k = if testBit (holes r) (k - 1) then "●" else "·"
    frameWord r = maybe "" (\k -> "frame " <> Decimal.whole k <> ": ") (frame r)

-- Text --------------------------------------------------------------------------------------------

-- | Divides the rows of a text medium into the lines of the text. A row is one character. Each line
-- includes the row of its line end.
textLines :: [Row] -> [[Row]]
textLines rows = case break ((== Just '\n') . symbol) rows of
  ([], []) -> []
  (line, []) -> [line]
  (line, end : more) -> (line <> [end]) : textLines more

-- | Line of the picture for line @n@ (from 1) of a text medium: number, text, and meaning of the
-- words. Nothing for a line without rows.
printed :: Machine -> (Int, [Row]) -> Maybe Text
printed machine (n, line) = case line of
  [] -> Nothing
  first : _ ->
    Just
      ( Text.stripEnd
          ( Text.justifyRight 6 ' ' (Decimal.whole n)
              <> "  "
              <> Text.justifyLeft 44 ' ' shown
              <> "  "
              <> place first
              <> Text.intercalate ", " (wordsOf line)
          )
      )
  where
    shown = Text.pack (filter (/= '\n') (map (fromMaybe '?' . symbol) line))
    place row = maybe "" (\k -> "frame " <> Decimal.whole k <> ": ") (frame row)
    wordsOf rows = case rows of
      [] -> []
      r : more -> case kind r of
        InWord c k _ ->
          RowMeaning.wordMeaning machine c k : wordsOf (dropWhile (sameWord (kind r)) more)
        Opening _ -> "opening" : wordsOf (filter (isWord . kind) more)
        Closing _ -> "closing" : wordsOf (filter (isWord . kind) more)
        _ -> wordsOf more
    sameWord a row = case (a, kind row) of
      (InWord c _ _, InWord c' _ _) -> c == c'
      _ -> False
    isWord s = case s of
      InWord {} -> True
      _ -> False
