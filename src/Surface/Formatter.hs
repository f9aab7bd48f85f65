-- | The canonical layout of a program text, its comments included.
--
-- The tree is printed anew. Comments stay where they stood: on a line of their own above what
-- follows, or behind what they follow. A comment within something that now stands on one line goes
-- behind that line, or above it when the place is taken.
module Surface.Formatter
  ( format,
    layout,
  )
where

import Base.Region (Located (..), Region (..), Source)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Data.Function (on)
import Data.Maybe qualified as Maybe
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.Alignment (AlignedLine (..), LineCells (..))
import Surface.Alignment qualified as Alignment
import Surface.Error (Error)
import Surface.Lexer qualified as Lexer
import Surface.Parser qualified as Parser
import Surface.PrintExpression (CommentPositions (..))
import Surface.PrintProgram qualified as PrintProgram
import Surface.SourceLine (SourceLine (..))
import Surface.SourceLine qualified as SourceLine
import Surface.Syntax (Program (..))
import Surface.Token (Token, Token_ (Symbol))
import Surface.Token qualified as Token
import Surface.Unlocated qualified as Unlocated

-- | The text in the canonical layout; nothing when it has mistakes. The meaning and the comments
-- stay: should the layout ever fail in that, which would be a bug, the text stays as it is.
format :: Text -> Maybe Text
format text = fmap checked (layout text)
  where
    checked new = if (same `on` program) (normal text) new then new else text
    same a b = Maybe.isJust a && a == b
    program t =
      fmap
        (\p -> (Unlocated.statements (statements p), map (Text.stripEnd . value) (comments p)))
        (parsed t)

-- | The layout as it comes, without the check that nothing is lost.
layout :: Text -> Maybe Text
layout text = fmap (laidOut (normal text)) (parsed (normal text))

parsed :: Text -> Maybe Program
parsed text = case Parser.parse 0 text :: Result () Error Program of
  Result {errors = [], output} -> output
  _ -> Nothing

-- | Lines end with LF, and no mark of the byte order is there.
normal :: Text -> Text
normal text =
  Text.replace
    "\r"
    "\n"
    (Text.replace "\r\n" "\n" (Maybe.fromMaybe text (Text.stripPrefix "\xFEFF" text)))

laidOut :: Text -> Program -> Text
laidOut text program = Text.unlines (written (tidy (entries source remarks rows)))
  where
    source = Region.fromText "" text
    remarks = map (remark source) (comments program)
    tokens = fst (Lexer.tokens 0 text)
    sources = map offset remarks
    between set from to = maybe False (< to) (Set.lookupGE from set)
    marks =
      CommentPositions
        { isBetween = between (Set.fromList sources),
          isAtComma = between (Set.fromList (besideCommas tokens sources))
        }
    rows =
      concatMap
        (parted marks)
        (SourceLine.withSources tokens (PrintProgram.rows marks (statements program)))

-- | Those of some places, in order, that have a comma directly before or behind them.
besideCommas :: [Token] -> [Int] -> [Int]
besideCommas = go False
  where
    -- Whether the last token was a comma.
    go after tokens sources = case (tokens, sources) of
      (_, []) -> []
      ([], _) -> if after then sources else []
      (t : rest, at : others)
        | start (Token.place t) < at -> go (comma t) rest sources
        | after || comma t -> at : go after tokens others
        | otherwise -> go after tokens others
    comma t = Token.shape t == Symbol ","

-- Comments

-- | A comment, where it stands, whether something stands before it on its line, and whether the
-- line above is blank.
data Remark = Remark {offset :: Int, text :: Text, trailing :: Bool, apart :: Bool}
  deriving stock (Eq, Show)

remark :: Source -> Located Text -> Remark
remark source (Located region text) =
  Remark
    { offset = start region,
      text = Text.stripEnd text,
      trailing,
      apart = not trailing && blankAbove source (start region)
    }
  where
    Region.Position {Region.column} = Region.position source (start region)
    trailing =
      not (Text.null (Text.strip (Text.take (column - 1) (Region.lineText source (start region)))))

-- | Whether the line above that of an offset is blank.
blankAbove :: Source -> Int -> Bool
blankAbove source at =
  line > 1 && Text.null (Text.strip (Region.lineText source (Region.offset source (line - 1) 1)))
  where
    Region.Position {Region.line} = Region.position source at

-- | A row that ends with an empty block is two when a comment stands in the block.
parted :: CommentPositions -> SourceLine -> [SourceLine]
parted marks anchor = case (reverse (shapes anchor), reverse (sources anchor)) of
  (Symbol "}" : Symbol "{" : _, Just close : Just open : _)
    | isBetween marks (start (Token.place open)) (start (Token.place close)) ->
      [ anchor
          { row = (row anchor) {cells = WholeLine (Text.dropEnd 2 (Alignment.unaligned (row anchor)))},
            shapes = init (shapes anchor),
            sources = init (sources anchor)
          },
        SourceLine
          { row = AlignedLine {indent = indent (row anchor), cells = WholeLine "}", isContinuation = False},
            shapes = [Symbol "}"],
            sources = [Just close]
          }
      ]
  _ -> [anchor]

-- Lines

-- | A line of the output, and whether a blank one is wanted above it.
data Entry = Entry {gap :: Bool, line :: Content}
  deriving stock (Eq, Show)

data Content
  = -- | a comment with its indentation
    Own Int Text
  | -- | a row, and the comment behind it
    Printed SourceLine (Maybe Text)
  deriving stock (Eq, Show)

-- | Rows with the comments among them.
entries :: Source -> [Remark] -> [SourceLine] -> [Entry]
entries source remarks rows = go (zip rows (starts rows)) remarks []
  where
    -- The first comments are those that go above the next row.
    go left rest above = case left of
      [] -> map (own 0) (above <> rest)
      (anchor, (from, finish)) : more ->
        let (early, others) = span ((< from) . offset) rest
            (mine, later) = case more of
              (_, (next, _)) : _ -> span ((< next) . offset) others
              [] -> (others, [])
            (within, behind) = span ((< finish) . offset) mine
            (tail', below) = case behind of
              r : rs | trailing r -> (Just r, rs)
              _ -> (Nothing, behind)
            (moved, tail'') = case (within, tail') of
              ([r], Nothing) | trailing r -> ([], Just r)
              _ -> (within, tail')
            deep = indent (row anchor) + (if SourceLine.isClosing anchor then 2 else 0)
            leading =
              [(own deep r) {gap = apart r && not (isContinuation (row anchor))} | r <- above <> early]
            wanted =
              not (SourceLine.isClosing anchor)
                && not (isContinuation (row anchor))
                && firstOnLine anchor
                && blankAbove source from
            shifted =
              [ Entry {gap = wanted && first, line = Own deep (text r)}
                | (r, first) <- zip moved (True : repeat False)
              ]
         in leading
              <> shifted
              <> ( Entry {gap = wanted && null moved, line = Printed anchor (fmap text tail'')} :
                   go more later below
                 )
    own deep r = Entry {gap = apart r, line = Own deep (text r)}
    firstOnLine anchor = maybe False Token.newLine (found anchor)
    found anchor = Maybe.listToMaybe (Maybe.catMaybes (take 1 (sources anchor)))

-- | Where each row begins and ends in the source; a row that is not there stands where the one
-- before it ends. The comma at the end of a row does not count: a comment before it is one behind
-- the row.
starts :: [SourceLine] -> [(Int, Int)]
starts = go 0
  where
    go end' anchors = case anchors of
      [] -> []
      anchor : rest -> case map Token.place (Maybe.catMaybes (sources anchor)) of
        [] -> (end', end') : go end' rest
        first : more ->
          let finish = end (last (first : beforeComma anchor more))
           in (start first, finish) : go (end (last (first : more))) rest
    beforeComma anchor regions =
      if drop (length (shapes anchor) - 1) (shapes anchor) == [Symbol ","]
        then take (length regions - 1) regions
        else regions

-- | No blank line at the beginning of the text or of a block.
tidy :: [Entry] -> [Entry]
tidy list = zipWith keep (Nothing : map Just list) list
  where
    keep before entry = entry {gap = gap entry && maybe False (not . opensBlock . line) before}
    opensBlock content = case content of
      Own _ _ -> False
      Printed anchor _ -> SourceLine.isOpening anchor

-- | The lines: columns line up in rows that nothing separates, and so do the comments behind them.
written :: [Entry] -> [Text]
written list = commented (go list)
  where
    go es = case es of
      [] -> []
      Entry {gap, line = Own deep text} : rest ->
        blank gap <> [(Text.replicate deep " " <> text, Nothing)] <> go rest
      Entry {gap, line = Printed anchor tail'} : rest ->
        let (run, others) = span joins rest
            together = (anchor, tail') : [(a, t) | Entry {line = Printed a t} <- run]
         in blank gap
              <> zip (Alignment.render (map (row . fst) together)) (map snd together)
              <> go others
    joins entry = not (gap entry) && isRow (line entry)
    isRow content = case content of
      Own _ _ -> False
      Printed _ _ -> True
    blank gap = [("", Nothing) | gap]

-- | Put the comments behind their lines.
commented :: [(Text, Maybe Text)] -> [Text]
commented list = case list of
  [] -> []
  (line, Nothing) : rest -> line : commented rest
  _ ->
    let (run, others) = span (Maybe.isJust . snd) list
        column = maximum (commentColumn : [Text.length line + 2 | (line, _) <- run])
     in [Text.justifyLeft column ' ' line <> Maybe.fromMaybe "" comment | (line, comment) <- run]
          <> commented others

-- | Comments stand so far from the margin, unless the lines before them are longer.
commentColumn :: Int
commentColumn = 39
