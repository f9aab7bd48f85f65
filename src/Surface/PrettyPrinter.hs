-- | Text that knows where it may be broken.
--
-- A document stands on one line when it fits; otherwise its outermost brackets and series are
-- broken first. What must stand on one line with its neighbours is joined by 'Beside'.
module Surface.PrettyPrinter
  ( Document (..),
    Member (..),
    PrintedLine (..),
    maxWidth,
    firstText,
    render,
  )
where

import Data.Text (Text)
import Data.Text qualified as Text

data Document
  = -- | never broken
    Text Text
  | -- | one directly behind the other
    Beside [Document]
  | -- | pieces with a space or a line break between them; broken, its lines hang four spaces in
    Series [Member]
  | -- | brackets; broken, they stand apart from what they hold. The flag says that they are broken
    -- in any case
    Brackets Bool Text [Member] Text
  deriving stock (Eq, Show)

-- | Whether it has to begin a line, and what it is.
data Member = Member {startsLine :: Bool, content :: Document}
  deriving stock (Eq, Show)

-- | A line of the output: its indentation and the text behind it.
data PrintedLine = PrintedLine {indent :: Int, text :: Text}
  deriving stock (Eq, Show)

-- | A line is not longer if it can be helped.
maxWidth :: Int
maxWidth = 100

-- | The text with which a document begins.
firstText :: Document -> Text
firstText doc = case doc of
  Text t -> t
  Beside ds -> case filter (not . Text.null) (map firstText ds) of
    t : _ -> t
    [] -> ""
  Series pieces -> firstText (Beside (map content pieces))
  Brackets _ open _ _ -> open

-- | The lines of a document whose first one is indented so far; there is at least one.
render :: Int -> Document -> [PrintedLine]
render from doc = map line (reverse (now pen : done pen))
  where
    pen = write from 0 doc Pen {done = [], now = (from, []), column = from}
    line (indent, texts) = PrintedLine {indent, text = Text.concat (reverse texts)}

-- | The lines that are complete and the one that is not, both backwards, and where the next
-- character goes.
data Pen = Pen {done :: [(Int, [Text])], now :: (Int, [Text]), column :: Int}

put :: Text -> Pen -> Pen
put t pen =
  let (indent, ts) = now pen in pen {now = (indent, t : ts), column = column pen + Text.length t}

newLine :: Int -> Pen -> Pen
newLine indent pen = Pen {done = now pen : done pen, now = (indent, []), column = indent}

-- | Write a document. Lines that it begins are indented so far, and so many characters stand behind
-- its last one.
write :: Int -> Int -> Document -> Pen -> Pen
write indent behind doc pen
  | fits (maxWidth - column pen - behind) doc = foldl (flip put) pen (flat doc)
  | otherwise = case doc of
    Text t -> put t pen
    Beside ds -> foldl (\p (d, b) -> write indent b d p) pen (zip ds (followers behind ds))
    Series pieces -> fill (indent + 4) behind pieces pen
    Brackets _ open pieces close ->
      put close (newLine indent (fill (indent + 2) 0 pieces (newLine (indent + 2) (put open pen))))

-- | How many characters follow each document before the line can be broken.
followers :: Int -> [Document] -> [Int]
followers behind = drop 1 . scanr step behind
  where
    step doc after = case doc of
      Text t -> Text.length t + after
      _ -> Text.length (firstText doc)

-- | As many pieces on each line as fit.
fill :: Int -> Int -> [Member] -> Pen -> Pen
fill indent behind pieces = case pieces of
  [] -> id
  first : rest -> go rest . write indent (if null rest then behind else 0) (content first)
  where
    go ps pen = case ps of
      [] -> pen
      Member {startsLine, content} : rest ->
        let after = if null rest then behind else 0
            enough = not startsLine && fits (maxWidth - column pen - 1 - after) content
         in go
              rest
              (write indent after content (if enough then put " " pen else newLine indent pen))

-- | Whether a document fits unbroken into so many characters.
fits :: Int -> Document -> Bool
fits room doc = maybe False (>= 0) (spend doc room)

-- | What is left of a room. Looks no further than the room goes.
spend :: Document -> Int -> Maybe Int
spend doc room
  | room < 0 = Nothing
  | otherwise = case doc of
    Text t -> Just (room - Text.length t)
    Beside ds -> foldl (\r d -> r >>= spend d) (Just room) ds
    Series pieces -> spendAll pieces room
    Brackets broken open pieces close
      | broken -> Nothing
      | otherwise -> spendAll pieces (room - Text.length open - Text.length close)

spendAll :: [Member] -> Int -> Maybe Int
spendAll pieces room = if null pieces then Just room else foldl next (Just (room + 1)) pieces
  where
    next left piece = if startsLine piece then Nothing else left >>= \r -> spend (content piece) (r - 1)

-- | The texts of a document on one line.
flat :: Document -> [Text]
flat doc = case doc of
  Text t -> [t]
  Beside ds -> concatMap flat ds
  Series pieces -> spaced pieces
  Brackets _ open pieces close -> open : spaced pieces <> [close]
  where
    spaced pieces = drop 1 (concatMap (\p -> " " : flat (content p)) pieces)
