-- | The formatter: the canonical layout of a program text with its comments.
--
-- The syntax tree is printed anew and the comments are placed among the printed lines. A comment on
-- a line of its own stays above the text that it precedes. A trailing comment, which follows other
-- text on its line, stays after that text.
--
-- The source may have a text on several lines, with comments between them, that is now printed on
-- one line. These comments go above the printed line. There is one exception: a single trailing
-- comment goes to the end of the printed line, if that line has no other trailing comment.
--
-- An offset is the index of a character in the source, from 0.
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

-- | Formats a text; 'Nothing' if it has mistakes. If the new layout ever changed the meaning or the
-- comments, which would be a bug, the text is left unchanged.
format :: Text -> Maybe Text
format text = fmap checked (layout text)
  where
    checked new = if (isSame `on` content) (normalised text) new then new else text
    isSame a b = Maybe.isJust a && a == b
    content t =
      fmap
        (\p -> (Unlocated.statements (statements p), map (Text.stripEnd . value) (comments p)))
        (parsed t)

-- | The canonical layout of a text, 'Nothing' if the text has mistakes. Unlike 'format' it does not
-- check that meaning and comments are kept; tests use it for this reason.
layout :: Text -> Maybe Text
layout text = fmap (laidOut (normalised text)) (parsed (normalised text))

-- | The syntax tree of a text; 'Nothing' if the text has mistakes.
parsed :: Text -> Maybe Program
parsed text = case Parser.parse 0 text :: Result () Error Program of
  Result {errors = [], output} -> output
  _ -> Nothing

-- | The text with LF as line end and without a byte order mark.
normalised :: Text -> Text
normalised text =
  Text.replace
    "\r"
    "\n"
    (Text.replace "\r\n" "\n" (Maybe.fromMaybe text (Text.stripPrefix "\xFEFF" text)))

-- | The canonical layout of a text, given the text and its syntax tree.
laidOut :: Text -> Program -> Text
laidOut text program =
  Text.unlines (renderEntries (withoutLeadingGaps (entries source remarks rows)))
  where
    source = Region.fromText "" text
    remarks = map (remark source) (comments program)
    tokens = fst (Lexer.tokens 0 text)
    offsets = map offset remarks
    isAnyBetween set from to = maybe False (< to) (Set.lookupGE from set)
    positions =
      CommentPositions
        { isBetween = isAnyBetween (Set.fromList offsets),
          isAtComma = isAnyBetween (Set.fromList (offsetsAtCommas tokens offsets))
        }
    rows =
      concatMap
        (splitEmptyBlock positions)
        (SourceLine.withSources tokens (PrintProgram.rows positions (statements program)))

-- | Selects the offsets of comments that have a comma as the token before or after them. Tokens and
-- offsets are in the order of the text.
offsetsAtCommas :: [Token] -> [Int] -> [Int]
offsetsAtCommas = go False
  where
    -- @isAfterComma@ tells if the token before those in @tokens@ is a comma.
    go isAfterComma tokens offsets = case (tokens, offsets) of
      (_, []) -> []
      ([], _) -> if isAfterComma then offsets else []
      (t : rest, at : others)
        | start (Token.place t) < at -> go (isComma t) rest offsets
        | isAfterComma || isComma t -> at : go isAfterComma tokens others
        | otherwise -> go isAfterComma tokens others
    isComma t = Token.shape t == Symbol ","

-- Comments

-- | A comment of the source.
data Remark = Remark
  { -- | the offset of the comment's start
    offset :: Int,
    text :: Text,
    -- | true if other text precedes the comment on its line
    isTrailing :: Bool,
    -- | true if the comment has a line of its own, and the line above is blank
    isApart :: Bool
  }
  deriving stock (Eq, Show)

remark :: Source -> Located Text -> Remark
remark source (Located region text) =
  Remark
    { offset = start region,
      text = Text.stripEnd text,
      isTrailing,
      isApart = not isTrailing && isBlankAbove source (start region)
    }
  where
    Region.Position {Region.column} = Region.position source (start region)
    before = Text.take (column - 1) (Region.lineText source (start region))
    isTrailing = not (Text.null (Text.strip before))

-- | Tells if the line above the one that contains the offset @at@ is blank.
isBlankAbove :: Source -> Int -> Bool
isBlankAbove source at =
  line > 1 && Text.null (Text.strip (Region.lineText source (Region.offset source (line - 1) 1)))
  where
    Region.Position {Region.line} = Region.position source at

-- | Moves the closing brace of a printed line to a line of its own, if the line ends with @{ }@ and
-- the source has a comment between these braces. Leaves any other line unchanged.
splitEmptyBlock :: CommentPositions -> SourceLine -> [SourceLine]
splitEmptyBlock positions sourceLine = case (shapesBackwards, sourcesBackwards) of
  (Symbol "}" : Symbol "{" : _, Just close : Just open : _)
    | isBetween positions (start (Token.place open)) (start (Token.place close)) ->
      [ sourceLine
          { row =
              (row sourceLine)
                { cells =
                    WholeLine (Text.dropEnd 2 (Alignment.unaligned (row sourceLine)))
                },
            shapes = init (shapes sourceLine),
            sources = init (sources sourceLine)
          },
        SourceLine
          { row =
              AlignedLine
                { indent = indent (row sourceLine),
                  cells = WholeLine "}",
                  isContinuation = False
                },
            shapes = [Symbol "}"],
            sources = [Just close]
          }
      ]
  _ -> [sourceLine]
  where
    shapesBackwards = reverse (shapes sourceLine)
    sourcesBackwards = reverse (sources sourceLine)

-- Lines

-- | A line of the output. @hasGap@ is true if a blank line is printed above it.
data Entry = Entry {hasGap :: Bool, line :: Content}
  deriving stock (Eq, Show)

-- | The content of a line.
data Content
  = -- | a comment on a line of its own: the indentation in characters, the text
    Own Int Text
  | -- | a printed line, and the text of the comment at its end if there is one
    Printed SourceLine (Maybe Text)
  deriving stock (Eq, Show)

-- | Places the comments of the source, in order, among the printed lines.
entries :: Source -> [Remark] -> [SourceLine] -> [Entry]
entries source remarks rows = go (zip rows (extents rows)) remarks []
  where
    -- @above@ has the comments that go above the first line of @left@. @rest@ has the comments
    -- after these.
    go left rest above = case left of
      [] -> map (ownLine 0) (above <> rest)
      (sourceLine, extent) : more ->
        let next = fst . snd <$> Maybe.listToMaybe more
            shares = shareOut extent next rest
         in rowEntries source sourceLine (fst extent) above shares
              <> go more (later shares) (below shares)

-- | Comments of the source, divided by their positions relative to one printed line.
data Shares = Shares
  { -- | before the line in the source: printed above it
    early :: [Remark],
    -- | inside the line in the source, but printed above it
    displaced :: [Remark],
    -- | printed at the end of the line
    trailing :: Maybe Remark,
    -- | printed between the line and the next one
    below :: [Remark],
    -- | after the start of the next printed line in the source: belong to the later lines
    later :: [Remark]
  }

-- | Divides comments by their positions relative to a printed line. In the source, the line reaches
-- from offset @from@ to offset @finish@, and the next printed line begins at offset @next@, which
-- is 'Nothing' after the last line.
shareOut :: (Int, Int) -> Maybe Int -> [Remark] -> Shares
shareOut (from, finish) next remarks = case (inside, trailingRemark) of
  ([r], Nothing) | isTrailing r -> Shares {early, displaced = [], trailing = Just r, below, later}
  _ -> Shares {early, displaced = inside, trailing = trailingRemark, below, later}
  where
    (early, others) = span ((< from) . offset) remarks
    (own, later) = maybe (others, []) (\n -> span ((< n) . offset) others) next
    (inside, after) = span ((< finish) . offset) own
    (trailingRemark, below) = case after of
      r : rs | isTrailing r -> (Just r, rs)
      _ -> (Nothing, after)

-- | The lines of the output for one printed line: the comments above it, then the line itself. In
-- the source the printed line begins at offset @from@. @above@ is the 'below' of the previous
-- printed line: comments that are printed between the two lines. @shares@ has the comments after
-- these.
rowEntries :: Source -> SourceLine -> Int -> [Remark] -> Shares -> [Entry]
rowEntries source sourceLine from above shares =
  [own {hasGap = hasGap own && isStart} | own <- map (ownLine deep) (above <> early shares)]
    <> [ Entry {hasGap = isGapWanted && isFirst, line = Own deep (text r)}
         | (r, isFirst) <- zip (displaced shares) (True : repeat False)
       ]
    <> [ Entry
           { hasGap = isGapWanted && null (displaced shares),
             line = Printed sourceLine (text <$> trailing shares)
           }
       ]
  where
    deep = indent (row sourceLine) + (if SourceLine.isClosing sourceLine then 2 else 0)
    isStart = not (isContinuation (row sourceLine))
    isGapWanted =
      isStart
        && not (SourceLine.isClosing sourceLine)
        && isFirstOnLine
        && isBlankAbove source from
    isFirstOnLine = case sources sourceLine of
      Just t : _ -> Token.newLine t
      _ -> False

-- | A comment on a line of its own, indented by @deep@ characters.
ownLine :: Int -> Remark -> Entry
ownLine deep r = Entry {hasGap = isApart r, line = Own deep (text r)}

-- | The offsets at which each printed line begins and ends in the source. A line without tokens in
-- the source begins and ends where the line before it ends. A line ends before a comma that is its
-- last token, so that a comment before this comma is a trailing one.
extents :: [SourceLine] -> [(Int, Int)]
extents = go 0
  where
    go previousEnd sourceLines = case sourceLines of
      [] -> []
      sourceLine : rest -> case map Token.place (Maybe.catMaybes (sources sourceLine)) of
        [] -> (previousEnd, previousEnd) : go previousEnd rest
        first : more ->
          let finish = end (last (first : beforeComma sourceLine more))
           in (start first, finish) : go (end (last (first : more))) rest
    beforeComma sourceLine regions =
      if drop (length (shapes sourceLine) - 1) (shapes sourceLine) == [Symbol ","]
        then take (length regions - 1) regions
        else regions

-- | Removes the blank lines at the beginning of the text and at the beginning of each block.
withoutLeadingGaps :: [Entry] -> [Entry]
withoutLeadingGaps list = zipWith keep (Nothing : map Just list) list
  where
    keep before entry =
      entry {hasGap = hasGap entry && maybe False (not . isBlockStart . line) before}
    isBlockStart content = case content of
      Own _ _ -> False
      Printed sourceLine _ -> SourceLine.isOpening sourceLine

-- | Renders the lines. Columns are aligned among consecutive printed lines, as far as no blank line
-- and no comment line separates them. Trailing comments are aligned too.
renderEntries :: [Entry] -> [Text]
renderEntries list = withComments (go list)
  where
    go es = case es of
      [] -> []
      Entry {hasGap, line = Own deep text} : rest ->
        blank hasGap <> [(Text.replicate deep " " <> text, Nothing)] <> go rest
      Entry {hasGap, line = Printed sourceLine comment} : rest ->
        let (run, others) = span isJoined rest
            together = (sourceLine, comment) : [(a, t) | Entry {line = Printed a t} <- run]
         in blank hasGap
              <> zip (Alignment.render (map (row . fst) together)) (map snd together)
              <> go others
    isJoined entry = not (hasGap entry) && isRow (line entry)
    isRow content = case content of
      Own _ _ -> False
      Printed _ _ -> True
    blank isWanted = [("", Nothing) | isWanted]

-- | Puts trailing comments after their lines. Comments of neighbouring lines begin in one column.
withComments :: [(Text, Maybe Text)] -> [Text]
withComments list = case list of
  [] -> []
  (line, Nothing) : rest -> line : withComments rest
  _ ->
    let (run, others) = span (Maybe.isJust . snd) list
        column = maximum (commentColumn : [Text.length line + 2 | (line, _) <- run])
     in [Text.justifyLeft column ' ' line <> Maybe.fromMaybe "" comment | (line, comment) <- run]
          <> withComments others

-- | The column of trailing comments, in characters from 0. If one of several consecutive lines is
-- too long for it, the comments of all these lines begin further right.
commentColumn :: Int
commentColumn = 39
