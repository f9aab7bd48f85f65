-- | Tokens of a description into statements. Every line that cannot be read is reported, and the
-- next one is read.
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

data Parsed = Parsed
  { statements :: [Statement],
    mistakes :: [Error],
    -- | the braces fit
    closed :: Bool
  }

-- | The statements of a text.
parse :: Text -> Parsed
parse text = Parsed {statements = ss, mistakes = es, closed = not (any isBrace es)}
  where
    (ss, es) = topLevel (Text.length text) (tokens text)
    isBrace e = case e of
      Unclosed _ -> True
      Unopened _ -> True
      TooDeep _ _ -> True
      _ -> False

topLevel :: Int -> [Token] -> ([Statement], [Error])
topLevel size ts = case several size 0 ts of
  (ss, es, Located region (Sign "}") : rest) ->
    let (more, es') =
          topLevel size rest
     in (ss <> more, es <> [Unopened region] <> es')
  (ss, es, _) -> (ss, es)

-- | Statements up to a closing brace, which is left, or to the end.
several :: Int -> Int -> [Token] -> ([Statement], [Error], [Token])
several size depth ts = case dropWhile ((== LineEnd) . value) ts of
  [] -> ([], [], [])
  rest@(Located _ (Sign "}") : _) -> ([], [], rest)
  rest ->
    let (s, es, behind) = statement size depth rest
        (more, es', end) = several size depth behind
     in (s <> more, es <> es', end)

-- | One statement with its block.
statement :: Int -> Int -> [Token] -> ([Statement], [Error], [Token])
statement size depth ts = case argument ts of
  Left e ->
    let (_, es, behind) = blockOf size depth (snd (toLineEnd ts))
     in ([], e : es, behind)
  Right (first, rest) ->
    let (args, stopped, rest1) = argumentsOf rest
        (computed, stopped2, rest2) = formulaOf rest1
        (known, rest3) = noteOf rest2
        (skipped, rest4) = toLineEnd rest3
        (inner, es, rest5) = blockOf size depth rest4
        (rubbish, rest6) = toLineEnd rest5
        faults =
          take
            1
            ( stopped
                <> stopped2
                <> [ Unexpected (region t) (describe (value t)) "the end of the line"
                     | t <- take 1 skipped
                   ]
            )
        told =
          Region.span
            (Region.region first)
            (maybe (Region.region (last (first : args))) region computed)
        s =
          Statement
            { key = first,
              arguments = args,
              formula = computed,
              note = known,
              block = inner,
              told,
              broken = not (null faults)
            }
     in ( [s],
          faults
            <> es
            <> [ Unexpected (region t) (describe (value t)) "the end of the line"
                 | t <- take 1 rubbish
               ],
          rest6
        )

-- | Arguments as far as they go; what stopped them, if that is no part of a statement.
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

-- | What stands behind @=@.
formulaOf :: [Token] -> (Maybe (Located Formula), [Error], [Token])
formulaOf ts = case ts of
  Located r (Sign "=") : rest -> case sums rest of
    Right (f, behind) ->
      (Just (Located (foldl Region.merge r (map region (used rest behind))) f), [], behind)
    Left e -> (Nothing, [e], rest)
  _ -> (Nothing, [], ts)
  where
    used rest behind = case behind of
      t : _ -> takeWhile ((< Region.start (region t)) . Region.start . region) rest
      [] -> rest

type Reader a = [Token] -> Either Error (a, [Token])

sums, products, powers, factor :: Reader Formula
sums ts = products ts >>= uncurry (chain products [("+", Add), ("-", Subtract)])
products ts = powers ts >>= uncurry (chain powers [("*", Multiply), ("/", Divide)])
-- A power binds to the right, and more than the minus before it.
powers ts = case ts of
  Located _ (Sign "-") : rest -> do
    (a, behind) <- powers rest
    Right (Negative a, behind)
  _ -> do
    (a, rest) <- factor ts
    case rest of
      Located _ (Sign "^") : behind -> do
        (b, end) <- powers behind
        Right (Binary Power a b, end)
      _ -> Right (a, rest)
factor ts = case ts of
  Located _ (Numeral s v) : rest -> Right (Constant s v, rest)
  Located _ (Name "n") : rest -> Right (Variable, rest)
  Located _ (Sign "(") : rest -> do
    (a, behind) <- sums rest
    case behind of
      Located _ (Sign ")") : end -> Right (a, end)
      Located r t : _ -> Left (Unexpected r (describe t) "‘)’")
      [] -> Left (Unexpected (Region 0 0) "the end" "‘)’")
  Located r t : _ -> Left (Unexpected r (describe t) "a number, ‘n’ or ‘(’")
  [] -> Left (Unexpected (Region 0 0) "the end" "a number, ‘n’ or ‘(’")

-- | Operators of one rank, from left to right.
chain ::
  Reader Formula ->
  [(Text, Operator)] ->
  Formula ->
  [Token] ->
  Either Error (Formula, [Token])
chain next operators a ts = case ts of
  Located _ (Sign s) : rest | Just o <- lookup s operators -> do
    (b, behind) <- next rest
    chain next operators (Binary o a b) behind
  _ -> Right (a, ts)

noteOf :: [Token] -> (Maybe (Located Note), [Token])
noteOf ts = case ts of
  Located r (Name w) : Located r' (Text s) : rest
    | Just m <- lookup w marks ->
      (Just (Located (Region.span r r') (Note m (Just s))), rest)
  Located r (Name w) : rest | Just m <- lookup w marks -> (Just (Located r (Note m Nothing)), rest)
  _ -> (Nothing, ts)

marks :: [(Text, Provenance)]
marks = [("sourced", Sourced), ("corrected", Corrected), ("reconstructed", Reconstructed)]

blockOf :: Int -> Int -> [Token] -> (Maybe [Statement], [Error], [Token])
blockOf size depth ts = case ts of
  Located r (Sign "{") : rest
    | depth >= deepest -> (Nothing, [TooDeep r deepest], [])
    | otherwise -> case several size (depth + 1) rest of
      (ss, es, Located _ (Sign "}") : behind) -> (Just ss, es, behind)
      (ss, es, behind) -> (Just ss, es <> [Unclosed r], behind)
  _ -> (Nothing, [], ts)

-- | No description needs blocks within blocks so deep.
deepest :: Int
deepest = 16

-- | What is left of a line, up to a brace.
toLineEnd :: [Token] -> ([Token], [Token])
toLineEnd = break ((`elem` [LineEnd, Sign "{", Sign "}"]) . value)
