{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | The repair of a statement that cannot be parsed: the smallest changes of its tokens with which
-- it can be.
--
-- A best-first search over the candidates of "Surface.RepairCandidate", each of which is tried by
-- parsing. It is the minimum-distance correction of Aho and Peterson (1972), with the candidates
-- of one place only. Several repairs of the same cost leave a choice to the user.
module Surface.StatementRepair
  ( Trial,
    repairs,
    transposed,
    renamed,
    statementAround,
  )
where

import Base.Region (Region (..))
import Data.List (findIndex, sortOn, transpose)
import Data.Maybe (fromMaybe, listToMaybe)
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Fix (Fix (..), FixEdit (..), FixText (..))
import Report.Fix qualified as Fix
import Surface.FailureContext (Failing (..))
import Surface.Keyword qualified as Keyword
import Surface.RepairCandidate qualified as RepairCandidate
import Surface.Token (Token (..), Token_ (..), spelling)
import Surface.TokenRepair (RepairCandidate (..))
import Surface.TokenRepair qualified as TokenRepair

-- | Parses the tokens of a statement. Gives the indices of the tokens at which parsing fails, in
-- order, each with the words that would be right there.
type Trial = [Token] -> [(Int, [Text])]

-- | A statement after some changes: their cost and count, the words for the last one, the tokens,
-- and the failure of the tokens before the last changes.
data State = State
  { spent :: Int,
    steps :: Int,
    said :: Text,
    now :: [Token],
    -- | the count of tokens from the one at which parsing failed
    limit :: Int,
    -- | the index of the first token on the line of that token
    lineStart :: Int
  }

-- | The repairs of a statement whose tokens cannot be parsed at an index, at most three. They are
-- proposals if there are several.
repairs :: Trial -> [Token] -> Int -> [Text] -> [Fix]
repairs try original index wanted
  | length original > mostTokens = []
  | otherwise = case solutions of
    [one] | spent one < doubtful -> [toFix original one]
    several -> map (Fix.proposed . toFix original) (take 3 several)
  where
    begin =
      State
        { spent = 0,
          steps = 0,
          said = "",
          now = original,
          limit = length original - index,
          lineStart = startOfLine original index
        }
    solutions = search fromLine Nothing mostTrials Set.empty (nextStates begin index wanted)
    -- Mistakes on lines above have reports of their own.
    fromLine ts = filter ((>= startOfLine original (index - 1)) . fst) (try ts)

-- | The index of the first token on the line of the token with an index.
startOfLine :: [Token] -> Int -> Int
startOfLine ts k = maximum (0 : [n | (n, t) <- zip [0 .. k] ts, newLine t])

-- | Cost from which a repair changes what the statement means, so that it is only proposed.
doubtful :: Int
doubtful = 4

-- | Largest cost of a repair.
mostCost :: Int
mostCost = 6

-- | The fix of a table that lies on its side, each line of which has a name and the values of a
-- column.
transposed :: [Token] -> [Fix]
transposed statement = case (before, columns) of
  (opening : _, first : second : _)
    | all isColumn columns,
      all ((== length first) . length) columns,
      length first > 2 ->
      [ Fix
          { title =
              "Write one line for each point: the first line is "
                <> Text.unwords (map (cellText . head) columns)
                <> ", the second "
                <> Text.unwords (map (cellText . (!! 1)) columns)
                <> ".",
            isProposal = False,
            edits =
              [ FixEdit
                  (Region (end (place opening)) (end (place (last (last (last columns))))))
                  (concatMap row (transpose columns))
              ]
          }
        | second /= first
      ]
  _ -> []
  where
    (before, inside) = case break ((== Symbol "{") . shape) statement of
      (_, brace : rest) -> ([brace], takeWhile ((/= Symbol "}") . shape) rest)
      (_, []) -> ([], [])
    columns = map cells (inLines inside)
    isColumn column = case column of
      [name] : numbers | Word _ <- shape name -> all (all isNumeric) numbers
      _ -> False
    isNumeric t = case shape t of
      Number _ _ -> True
      Symbol "-" -> True
      _ -> False
    cellText = Text.concat . map (spelling . shape)
    row own = Written "\n " : concatMap (\c -> [Written " ", copied c]) own
    copied ts = Copied (Region (start (place (head ts))) (end (place (last ts))))

-- | Tokens by their lines.
inLines :: [Token] -> [[Token]]
inLines ts = case ts of
  [] -> []
  t : rest -> let (same, more) = break newLine rest in (t : same) : inLines more

-- | The cells of a line of a table; a minus and its number are one cell.
cells :: [Token] -> [[Token]]
cells ts = case ts of
  a : b : rest | shape a == Symbol "-" -> [a, b] : cells rest
  a : rest -> [a] : cells rest
  [] -> []

-- | The fix that renames a word of the language which a definition at a region gives to a value: at
-- the definition, and where the word is used as a value below.
renamed :: [Token] -> Region -> Text -> Text -> [Fix]
renamed tokens region word free =
  [ Fix.joined
      ( "Name it " <> free
          <> (if null uses then "." else ", here and where it is used.")
      )
      [Fix.exchange "" r free | r <- region : uses]
  ]
  where
    uses =
      [ place t
        | (before, t) <- zip tokens (drop 1 tokens),
          start (place t) > start region,
          shape t == Word word,
          not (newLine t),
          shape before `elem` map Symbol ["(", ",", "=", "+", "-", "*", "/", "<", ">", "["]
      ]

-- | The tokens of the statement around a region, at whose start it cannot be parsed, and the index
-- of the first token that does not begin before the region.
statementAround :: [Token] -> Region -> ([Token], Int)
statementAround tokens region = (upToEnd outer (reverse own <> from), length own)
  where
    -- The brace that closes nothing is one of the statement, unless a block is around it.
    outer = if sum (map balance (take begin before)) > 0 then 0 else 1 :: Int
    (before, from) = span ((< start region) . start . place) tokens
    own = reverse (drop begin before)
    begin = case reverse starts of
      [] -> 0
      nearest : _ -> case [n | n <- starts, isContour n, isOpenAfter n] of
        n : _ -> n
        [] -> nearest
    starts = [n | (n, t) <- zip [0 ..] before, beginsStatement t]
    isContour n = map shape (take 1 (drop n before)) == [Word "contour"]
    -- True if the first brace after the start of a statement is still open.
    isOpenAfter n =
      let depths = scanl1 (+) (map balance (dropWhile ((/= Symbol "{") . shape) (drop n before)))
       in not (null depths) && all (> 0) depths
    upToEnd open list = case list of
      [] -> []
      t : rest
        | newLine t && open <= outer && beginsStatement t && start (place t) > start region -> []
        | open + balance t < 0 -> []
        | otherwise -> t : upToEnd (open + balance t) rest
    beginsStatement t = case shape t of
      Word w ->
        newLine t && w `elem` (Keyword.statements <> Keyword.softStatements <> Keyword.blocks)
      _ -> False

balance :: Token -> Int
balance t = case shape t of
  Symbol "{" -> 1
  Symbol "}" -> -1
  _ -> 0

-- | Largest count of tokens of a statement that is repaired.
mostTokens :: Int
mostTokens = 400

-- | Largest count of trials for one mistake.
mostTrials :: Int
mostTrials = 200

-- | Largest count of changes in a repair.
mostSteps :: Int
mostSteps = 3

-- | The cheapest states whose line can be parsed. The states to try are sorted by their cost;
-- @best@ is the cost of the repairs found so far, and @left@ the count of trials that are left.
search :: Trial -> Maybe Int -> Int -> Set [Token_] -> [State] -> [State]
search try best left seen states = case states of
  [] -> []
  s : rest
    | left <= 0 || spent s > fromMaybe mostCost best -> []
    | Set.member (shapes s) seen -> search try best left seen rest
    | otherwise ->
      let seen' = Set.insert (shapes s) seen
       in case if isSensible (now s) then try (now s) else [(0, [])] of
            [] -> s : search try (Just (spent s)) (left - 1) seen' rest
            (k, wanted) : _
              | k > changedEnd s -> s : search try (Just (spent s)) (left - 1) seen' rest
              | steps s < mostSteps,
                length (now s) - k < limit s ->
                search
                  try
                  best
                  (left - 1)
                  seen'
                  ( sortOn
                      spent
                      (rest <> nextStates (failedAt k s) k wanted)
                  )
              | otherwise -> search try best (left - 1) seen' rest
  where
    shapes s = map shape (now s)

-- | False if a word that takes a value is written anew before a word of the language, which is then
-- parsed as the name of a value.
isSensible :: [Token] -> Bool
isSensible ts = null [() | (a, b) <- zip ts (drop 1 ts), isNew a, takesValue a, isOfLanguage b]
  where
    isNew t = end (place t) == start (place t)
    takesValue t = shape t `elem` map Word measures
    isOfLanguage t = case shape t of
      Word w -> w `elem` measures || Keyword.beginsItem w
      _ -> False
    measures =
      Text.words
        "diameter flutes stickout holder height width angle bevel gear pitch nose step line arc"

-- | The index after the last token of the line on which the last token lies that is followed by
-- unchanged ones only.
changedEnd :: State -> Int
changedEnd s = fromMaybe (length (now s)) (lineEndFrom failing)
  where
    failing = max (lineStart s) (length (now s) - limit s)
    lineEndFrom k = (+ (k + 1)) <$> findIndex newLine (drop (k + 1) (now s))

-- | A state whose tokens cannot be parsed at an index.
failedAt :: Int -> State -> State
failedAt k s = s {limit = length (now s) - k, lineStart = startOfLine (now s) k}

-- | The states after one more change at the index at which parsing fails.
nextStates :: State -> Int -> [Text] -> [State]
nextStates s index expected =
  sortOn
    spent
    [ s
        { spent = spent s + cost c,
          steps = steps s + 1,
          said = words' c,
          now = TokenRepair.changed (changes c) (now s)
        }
      | c <- RepairCandidate.candidates failing
    ]
  where
    failing =
      Failing
        { tokens = now s,
          index,
          wanted =
            sortOn
              (\w -> (w `notElem` ["outside", "closed", "line"], w == "ccw"))
              [Text.dropAround (`elem` ("‘’" :: String)) w | w <- expected, isQuoted w],
          isValueWanted = "a value" `elem` expected,
          isNameWanted = "a name" `elem` expected
        }
    isQuoted w = Text.isPrefixOf "‘" w

-- | The fix that writes the tokens of a state in place of the original ones.
toFix :: [Token] -> State -> Fix
toFix original s =
  Fix
    { title = (if steps s == 1 then said s else "Write") <> ": " <> shownLine (now s) shownAt,
      isProposal = False,
      edits = [edit original same old new (drop (length same + length new) (now s))]
    }
  where
    same = map fst (takeWhile (uncurry isSame') (zip original (now s)))
    isSame' a b = a {attached = False} == b {attached = False}
    (old, new) = withoutEnd (drop (length same) original) (drop (length same) (now s))
    withoutEnd a b =
      let equal = length (takeWhile (uncurry isSame) (zip (reverse a) (reverse b)))
       in (take (length a - equal) a, take (length b - equal) b)
    -- The end of a line that has lost its last token.
    shownAt
      | null new,
        not (any newLine (take 1 old)),
        maybe True newLine (listToMaybe (drop (length same) (now s))) =
        max 0 (length same - 1)
      | otherwise = length same
    isSame a b = place a == place b && shape a == shape b && end (place a) > start (place a)

-- | The edit that writes the tokens @new@ in place of the tokens @old@; @same@ are the tokens
-- before, and @later@ those after.
edit :: [Token] -> [Token] -> [Token] -> [Token] -> [Token] -> FixEdit
edit original same old new later = FixEdit (Region from to) (leading <> inner <> trailing)
  where
    ending = maybe 0 (end . place) (lastOf same)
    -- True if the change is at the start of a line, whose indentation stays.
    isAtStart =
      null same
        || any newLine (take 1 old)
        || null old && or [newLine n && not (newLine t) | n : _ <- [new], t : _ <- [later]]
    from
      | isAtStart, t : _ <- old <> later = start (place t)
      | otherwise = ending
    to
      | isAtStart, null new, t : _ <- later, not (newLine t) = start (place t)
      | t : _ <- reverse old = end (place t)
      | otherwise = from
    leading = concat [gap b t | not isAtStart, t : _ <- [new], Just b <- [lastOf same]]
    inner = concat (zipWith part (Nothing : map Just new) new)
    part before t = maybe [] (\b -> gap b t) before <> [copied t]
    gap b t
      | newLine t, p : _ <- predecessors t, beganLine t = [between p t]
      | p : _ <- predecessors t, p == b = [between p t]
      | newLine t = [Written (if isStatement t then "\n" else "\n  ")]
      | isTight (Just b) t = []
      | otherwise = [Written " "]
    isStatement t = shape t `elem` map Word Keyword.statements
    between p t = Copied (Region (end (place p)) (start (place t)))
    beganLine t = or [newLine o | o <- original, place o == place t]
    predecessors t =
      [p | isOld t, (p, t') <- zip original (drop 1 original), place t' == place t]
    trailing =
      [ Written " "
        | t : _ <- [later],
          not (newLine t),
          not isAtStart || not (null new),
          any attachedOriginally [t] || isAtStart && null old,
          not (isTight (lastOf (same <> new)) t)
      ]
    attachedOriginally t = or [attached o | o <- original, place o == place t]
    copied t = if isOld t then Copied (place t) else Written (spelling (shape t))
    isOld t = end (place t) > start (place t)

lastOf :: [a] -> Maybe a
lastOf = foldl (const Just) Nothing

-- | True if no space is written between two tokens.
isTight :: Maybe Token -> Token -> Bool
isTight before t =
  attached t || shape t `elem` map Symbol [")", ",", "]", ".."]
    || fmap shape before `elem` map (Just . Symbol) ["(", "[", ".."]

-- | The line with the token at an index, as the repair writes it.
shownLine :: [Token] -> Int -> Text
shownLine ts k = Text.concat (zipWith shown (Nothing : map Just line) line)
  where
    first = maximum (0 : [n | (n, t) <- zip [0 ..] (take (k + 1) ts), newLine t])
    line = case drop first ts of
      [] -> []
      t : rest -> t : takeWhile (not . newLine) rest
    shown before t = case before of
      Nothing -> spelling (shape t)
      Just _
        | isTight before t -> spelling (shape t)
        | otherwise -> " " <> spelling (shape t)
