-- | A pretty-printer for documents with possible line breaks.
--
-- A document is a text with possible line breaks. It is printed on one line if it fits. Otherwise
-- its outermost brackets and series are broken first. Widths, indentations and columns are counted
-- in characters.
module Surface.PrettyPrinter
  ( Doc (..),
    Member (..),
    PrintedLine (..),
    maxWidth,
    firstText,
    render,
  )
where

import Data.Text (Text)
import Data.Text qualified as Text

-- | A text with the positions at which it may be broken into lines.
data Doc
  = -- | never broken
    Text Text
  | -- | documents next to one another, without a break between them
    Beside [Doc]
  | -- | members with a space or a line break between them. Lines after the first are indented by
    -- four characters more than the first
    Series [Member]
  | -- | an opening bracket, members and a closing bracket. If broken, lines follow that each have
    -- as many members as fit, then a line that begins with the closing bracket. The lines of
    -- members are indented by two characters more than the closing bracket. The flag is true if the
    -- brackets must be broken, even if one line has room for them
    Brackets Bool Text [Member] Text
  deriving stock (Eq, Show)

-- | A document in a series or in brackets. @startsLine@ tells if it must begin a line.
data Member = Member {startsLine :: Bool, content :: Doc}
  deriving stock (Eq, Show)

-- | A line of the output: its indentation in characters, and its text.
data PrintedLine = PrintedLine {indent :: Int, text :: Text}
  deriving stock (Eq, Show)

-- | The largest width of a line in characters; only an unbreakable text exceeds it.
maxWidth :: Int
maxWidth = 100

-- | The first non-empty text in a document; the empty text if there is none.
firstText :: Doc -> Text
firstText doc = case doc of
  Text t -> t
  Beside ds -> case filter (not . Text.null) (map firstText ds) of
    t : _ -> t
    [] -> ""
  Series members -> firstText (Beside (map content members))
  Brackets _ open _ _ -> open

-- | Renders a document whose first line is indented by @from@ characters; gives at least one line.
render :: Int -> Doc -> [PrintedLine]
render from doc = map line (reverse (now pen : done pen))
  where
    pen = write from 0 doc Pen {done = [], now = (from, []), column = from}
    line (indent, texts) = PrintedLine {indent, text = Text.concat (reverse texts)}

-- | The output so far.
data Pen = Pen
  { -- | the complete lines, the last one first; of each line the indentation and the texts in
    -- reverse order
    done :: [(Int, [Text])],
    -- | the line that is being written: its indentation, and its texts in reverse order
    now :: (Int, [Text]),
    -- | the column of the next character, from 0
    column :: Int
  }

put :: Text -> Pen -> Pen
put t pen =
  let (indent, ts) = now pen in pen {now = (indent, t : ts), column = column pen + Text.length t}

newLine :: Int -> Pen -> Pen
newLine indent pen = Pen {done = now pen : done pen, now = (indent, []), column = indent}

-- | Writes a document. A new line is indented by @indent@ characters, plus the indentation that
-- broken series and brackets add. The last line keeps room for @trailing@ characters, which follow
-- the document without a possible line break.
write :: Int -> Int -> Doc -> Pen -> Pen
write indent trailing doc pen
  | fits (maxWidth - column pen - trailing) doc = foldl (flip put) pen (unbroken doc)
  | otherwise = case doc of
    Text t -> put t pen
    Beside ds ->
      foldl (\p (d, after) -> write indent after d p) pen (zip ds (widthsAfter trailing ds))
    Series members -> fill (indent + 4) trailing members pen
    Brackets _ open members close ->
      let inside = fill (indent + 2) 0 members (newLine (indent + 2) (put open pen))
       in put close (newLine indent inside)

-- | Computes, for each document of a 'Beside', the number of characters from the document's end to
-- the next possible line break. @trailing@ is this number for the last document.
widthsAfter :: Int -> [Doc] -> [Int]
widthsAfter trailing = drop 1 . scanr step trailing
  where
    step doc after = case doc of
      Text t -> Text.length t + after
      _ -> Text.length (firstText doc)

-- | Writes as many members on each line as fit. New lines are indented by @indent@ characters. The
-- last line keeps room for @trailing@ characters, which follow without a possible line break.
fill :: Int -> Int -> [Member] -> Pen -> Pen
fill indent trailing members = case members of
  [] -> id
  first : rest -> go rest . write indent (if null rest then trailing else 0) (content first)
  where
    go ms pen = case ms of
      [] -> pen
      Member {startsLine, content} : rest ->
        let after = if null rest then trailing else 0
            isRoom = not startsLine && fits (maxWidth - column pen - 1 - after) content
            separated = if isRoom then put " " pen else newLine indent pen
         in go rest (write indent after content separated)

-- | Tells if a document fits unbroken into @room@ characters.
fits :: Int -> Doc -> Bool
fits room doc = maybe False (>= 0) (roomAfter doc room)

-- | The number of characters, out of @room@, that remain if the document is printed on one line. If
-- the document needs more room, the result is negative or 'Nothing'. The result is also 'Nothing'
-- if the document must be broken.
roomAfter :: Doc -> Int -> Maybe Int
roomAfter doc room
  | room < 0 = Nothing
  | otherwise = case doc of
    Text t -> Just (room - Text.length t)
    Beside ds -> foldl (\r d -> r >>= roomAfter d) (Just room) ds
    Series members -> roomAfterAll members room
    Brackets isBroken open members close
      | isBroken -> Nothing
      | otherwise -> roomAfterAll members (room - Text.length open - Text.length close)

roomAfterAll :: [Member] -> Int -> Maybe Int
roomAfterAll members room =
  if null members then Just room else foldl next (Just (room + 1)) members
  where
    next left member
      | startsLine member = Nothing
      | otherwise = left >>= \r -> roomAfter (content member) (r - 1)

-- | The texts of which a document consists when it is printed on one line.
unbroken :: Doc -> [Text]
unbroken doc = case doc of
  Text t -> [t]
  Beside ds -> concatMap unbroken ds
  Series members -> spaced members
  Brackets _ open members close -> open : spaced members <> [close]
  where
    spaced members = drop 1 (concatMap (\m -> " " : unbroken (content m)) members)
