-- | Parses the tokens of a description into statements.
--
-- A statement is one line: its key, then arguments, perhaps a formula after @=@, perhaps a mark;
-- and perhaps a block of statements in braces. A mark is the word @sourced@, @corrected@ or
-- @reconstructed@, which says how a value is known.
--
-- The parser recovers at the end of each line: it reports a line that it cannot read, and
-- continues with the next one.
module Machine.Parser
  ( Parsed (..),
    parse,
  )
where

import Base.Region (Located (..), Region (Region))
import Base.Region qualified as Region
import Data.Char (digitToInt)
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.Error (Error (..))
import Machine.Lexer (Token, Token_ (..), describe, tokens)
import Machine.Machine (Provenance (..))
import Machine.Syntax

-- | Statements of a description, and the mistakes that the parser has found.
data Parsed = Parsed
  { statements :: [Statement],
    mistakes :: [Error],
    -- | true if the braces match, and no block is nested too deeply
    closed :: Bool
  }

-- | Parses the text of a description.
parse :: Text -> Parsed
parse text = Parsed {statements = ss, mistakes = es, closed = not (any isBraceError es)}
  where
    (ss, es) = topLevel (tokens text)
    isBraceError e = case e of
      Unclosed _ -> True
      Unopened _ -> True
      TooDeep _ _ -> True
      _ -> False

-- | Parses all statements. A closing brace without an opening one is reported and skipped.
topLevel :: [Token] -> ([Statement], [Error])
topLevel ts = case statementsOf 0 ts of
  (ss, es, Located region (Sign "}") : rest) ->
    let (more, es') = topLevel rest
     in (ss <> more, es <> [Unopened region] <> es')
  (ss, es, _) -> (ss, es)

-- | Parses statements up to the end or up to a closing brace, which it does not consume. @depth@
-- is the number of blocks around the statements. The result has the remaining tokens.
statementsOf :: Int -> [Token] -> ([Statement], [Error], [Token])
statementsOf depth ts = case dropWhile ((== LineEnd) . value) ts of
  [] -> ([], [], [])
  rest@(Located _ (Sign "}") : _) -> ([], [], rest)
  rest ->
    let (s, es, afterOne) = statement depth rest
        (more, es', afterAll) = statementsOf depth afterOne
     in (s <> more, es <> es', afterAll)

-- | Parses one statement and its block. @depth@ is the number of blocks around the statement. A
-- line without a key gives no statement, but the errors in its block are reported. The result has
-- the remaining tokens.
statement :: Int -> [Token] -> ([Statement], [Error], [Token])
statement depth ts = case argument ts of
  Left e ->
    let (_, es, rest) = blockOf depth (snd (toLineEnd ts))
     in ([], e : es, rest)
  Right (first, rest) ->
    let (line, faults, afterLine) = lineOf first rest
        (inner, es, afterBlock) = blockOf depth afterLine
        (extra, afterExtra) = toLineEnd afterBlock
     in ([line {block = inner}], faults <> es <> unexpectedIn extra, afterExtra)

-- | Parses the rest of a line after its key @first@, up to the end of the line or a brace:
-- arguments, formula and mark of provenance. Returns the statement without its block, at most one
-- error, and the remaining tokens.
lineOf :: Argument -> [Token] -> (Statement, [Error], [Token])
lineOf first ts = (line, faults, afterLine)
  where
    (args, argumentFaults, afterArguments) = argumentsOf ts
    (computed, formulaFaults, afterFormula) = formulaOf afterArguments
    (marked, afterMark) = markOf afterFormula
    (extra, afterLine) = toLineEnd afterMark
    faults = take 1 (argumentFaults <> formulaFaults <> unexpectedIn extra)
    extent =
      Region.span
        (Region.region first)
        (maybe (Region.region (last (first : args))) region computed)
    line =
      Statement
        { key = first,
          arguments = args,
          formula = computed,
          mark = marked,
          block = Nothing,
          extent,
          broken = not (null faults)
        }

-- | Reports the first of the tokens that follow a complete statement on its line.
unexpectedIn :: [Token] -> [Error]
unexpectedIn extra =
  [Unexpected (region t) (describe (value t)) "the end of the line" | t <- take 1 extra]

-- | Parses arguments up to the end of the line, a brace, a formula or a mark. Any other token that
-- begins no argument is an error.
argumentsOf :: [Token] -> ([Argument], [Error], [Token])
argumentsOf ts = case ts of
  [] -> ([], [], [])
  t : _
    | value t `elem` [LineEnd, Sign "{", Sign "}", Sign "="] || isMark t -> ([], [], ts)
    | otherwise -> case argument ts of
      Left e -> ([], [e], ts)
      Right (a, rest) -> let (more, es, end) = argumentsOf rest in (a : more, es, end)
  where
    isMark t = case value t of
      Name w -> w `elem` map fst marks
      _ -> False

-- | Parses one argument, and gives the tokens after it; an error if the first token begins no
-- argument.
argument :: [Token] -> Either Error (Argument, [Token])
argument ts = case ts of
  Located r (Numeral a _) : Located _ (Sign "..") : Located r' (Numeral b _) : rest
    | Just m <- whole a, Just n <- whole b -> Right (Located (Region.span r r') (Range m n), rest)
  Located r t : Located _ (Sign ":") : Located r' (Numeral b _) : rest
    | Just w <- nameOf t, Just k <- whole b -> Right (Located (Region.span r r') (Bit w k), rest)
  Located r (Name w) : rest -> Right (Located r (Word w), rest)
  Located r (Text s) : rest -> Right (Located r (Quoted s), rest)
  Located r (Numeral s v) : rest -> Right (Located r (Number s v), rest)
  Located r (Sign "-") : rest -> Right (Located r Dash, rest)
  Located r t : _ ->
    Left (Unexpected r (describe t) "a word, a number or a text in quotation marks")
  [] -> Left (Unexpected (Region 0 0) "the end" "a statement")
  where
    nameOf t = case t of
      Name w -> Just w
      Text s -> Just s
      _ -> Nothing
    whole s =
      if Text.length s <= 9 && Text.all (/= '.') s
        then Just (Text.foldl' (\n d -> 10 * n + digitToInt d) 0 s)
        else Nothing

-- | Parses @=@ and the formula after it; without @=@ there is no formula. The region of the
-- formula includes the @=@.
formulaOf :: [Token] -> (Maybe (Located Formula), [Error], [Token])
formulaOf ts = case ts of
  Located r (Sign "=") : rest -> case sums rest of
    Right (f, after) ->
      (Just (Located (foldl Region.merge r (map region (used rest after))) f), [], after)
    Left e -> (Nothing, [e], rest)
  _ -> (Nothing, [], ts)
  where
    used rest after = case after of
      t : _ -> takeWhile ((< Region.start (region t)) . Region.start . region) rest
      [] -> rest

-- | Parser that returns a value and the remaining tokens.
type Reader a = [Token] -> Either Error (a, [Token])

-- Parses a formula by precedence climbing: a sum consists of products, a product of powers, and a
-- power of factors.
sums, products, powers, factor :: Reader Formula
sums ts = products ts >>= uncurry (chain products [("+", Add), ("-", Subtract)])
products ts = powers ts >>= uncurry (chain powers [("*", Multiply), ("/", Divide)])
-- A power is right-associative, and binds more tightly than the minus before it.
powers ts = case ts of
  Located _ (Sign "-") : rest -> do
    (a, after) <- powers rest
    Right (Negative a, after)
  _ -> do
    (a, rest) <- factor ts
    case rest of
      Located _ (Sign "^") : after -> do
        (b, end) <- powers after
        Right (Binary Power a b, end)
      _ -> Right (a, rest)
factor ts = case ts of
  Located _ (Numeral s v) : rest -> Right (Constant s v, rest)
  Located _ (Name "n") : rest -> Right (Variable, rest)
  Located _ (Sign "(") : rest -> do
    (a, after) <- sums rest
    case after of
      Located _ (Sign ")") : end -> Right (a, end)
      Located r t : _ -> Left (Unexpected r (describe t) "‘)’")
      [] -> Left (Unexpected (Region 0 0) "the end" "‘)’")
  Located r t : _ -> Left (Unexpected r (describe t) "a number, ‘n’ or ‘(’")
  [] -> Left (Unexpected (Region 0 0) "the end" "a number, ‘n’ or ‘(’")

-- | Parses the rest of a formula after its first operand @a@: an operator of @operators@, an
-- operand, and so on. All @operators@ have one precedence and are left-associative. @next@ parses
-- one operand.
chain ::
  Reader Formula ->
  [(Text, Operator)] ->
  Formula ->
  [Token] ->
  Either Error (Formula, [Token])
chain next operators a ts = case ts of
  Located _ (Sign s) : rest | Just o <- lookup s operators -> do
    (b, after) <- next rest
    chain next operators (Binary o a b) after
  _ -> Right (a, ts)

-- | Parses the mark of provenance at the end of a line. A text may follow the mark; it says where
-- the source prints the value. 'Nothing' if the next token is no mark.
markOf :: [Token] -> (Maybe (Located Mark), [Token])
markOf ts = case ts of
  Located r (Name w) : Located r' (Text s) : rest
    | Just m <- lookup w marks ->
      (Just (Located (Region.span r r') (Mark m (Just s))), rest)
  Located r (Name w) : rest | Just m <- lookup w marks -> (Just (Located r (Mark m Nothing)), rest)
  _ -> (Nothing, ts)

marks :: [(Text, Provenance)]
marks = [("sourced", Sourced), ("corrected", Corrected), ("reconstructed", Reconstructed)]

-- | Parses the block after a line, if there is one. @depth@ is the number of blocks around the
-- line. The parser stops at a block that is nested too deeply.
blockOf :: Int -> [Token] -> (Maybe [Statement], [Error], [Token])
blockOf depth ts = case ts of
  Located r (Sign "{") : rest
    | depth >= deepest -> (Nothing, [TooDeep r deepest], [])
    | otherwise -> case statementsOf (depth + 1) rest of
      (ss, es, Located _ (Sign "}") : after) -> (Just ss, es, after)
      (ss, es, after) -> (Just ss, es <> [Unclosed r], after)
  _ -> (Nothing, [], ts)

-- | Largest depth to which blocks may be nested.
deepest :: Int
deepest = 16

-- | Splits the tokens at the next line end or brace, which is the first token of the second part.
toLineEnd :: [Token] -> ([Token], [Token])
toLineEnd = break ((`elem` [LineEnd, Sign "{", Sign "}"]) . value)
