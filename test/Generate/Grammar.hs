-- | The grammars of the manual: a reader, a generator of sentences, and a recogniser.
module Generate.Grammar
  ( Grammar,
    fromText,
    loose,
    literals,
    sentence,
    sentenceWith,
    recognises,
    contains,
  )
where

import Data.Char (isAlpha, isSpace)
import Data.List (elemIndex, sort, (\\))
import Data.Map (Map)
import Data.Map qualified as Map
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.Keyword qualified as Keyword
import Surface.Token (Token (..), Token_ (..), unitName)
import Test.QuickCheck

-- | Rules by their names. The start symbol is @program@.
newtype Grammar = Grammar (Map Text Rule)
  deriving stock (Show)

-- | The right-hand side of a rule.
data Rule
  = -- | a word or symbol in quotation marks
    Literal Text
  | -- | another rule, or a terminal of the lexer
    Named Text
  | Sequence [Rule]
  | Choice [Rule]
  | Many Rule
  | Optional Rule
  deriving stock (Show)

-- | The terminals of the lexer.
terminals :: [Text]
terminals = ["name", "number", "text", "machine-name"]

-- Reading

-- | The grammar in a text of rules @name = … ;@.
fromText :: Text -> Grammar
fromText = Grammar . Map.fromList . rules . marks

-- | The tokens of a grammar: words, symbols, and literals, each with its opening quotation mark.
marks :: Text -> [Text]
marks text = case Text.uncons (Text.stripStart text) of
  Nothing -> []
  Just ('"', rest) ->
    let (inside, after) =
          Text.breakOn "\"" rest
     in ("\"" <> inside) : marks (Text.drop 1 after)
  Just (c, rest)
    | isAlpha c ->
      let (word, after) =
            Text.span (\x -> isAlpha x || x == '-') (Text.stripStart text)
       in word : marks after
    | isSpace c -> marks rest
    | otherwise -> Text.singleton c : marks rest

rules :: [Text] -> [(Text, Rule)]
rules ms = case ms of
  name : "=" : rest -> let (rule, after) = alternatives rest in (name, rule) : rules (drop 1 after)
  _ -> []

alternatives :: [Text] -> (Rule, [Text])
alternatives ms = case rest of
  "|" : more -> let (others, after) = alternatives more in (joined one others, after)
  _ -> (one, rest)
  where
    (one, rest) = inOrder ms
    joined a b = case b of
      Choice bs -> Choice (a : bs)
      _ -> Choice [a, b]

inOrder :: [Text] -> (Rule, [Text])
inOrder = go []
  where
    go before ms = case ms of
      "{" : rest -> bracket Many rest
      "[" : rest -> bracket Optional rest
      "(" : rest -> bracket id rest
      word : rest
        | "\"" `Text.isPrefixOf` word -> go (Literal (Text.drop 1 word) : before) rest
        | Text.any isAlpha (Text.take 1 word) -> go (Named word : before) rest
      _ -> (sequence' (reverse before), ms)
      where
        bracket make rest =
          let (inside, after) = alternatives rest in go (make inside : before) (drop 1 after)

sequence' :: [Rule] -> Rule
sequence' rs = case rs of
  [r] -> r
  _ -> Sequence rs

-- | Names that are used but have no rule, and rules and terminals that are not used.
loose :: Grammar -> [Text]
loose (Grammar known) =
  (used \\ (Map.keys known <> terminals)) <> ((Map.keys known <> terminals) \\ ("program" : used))
  where
    used = Set.toList (Set.fromList (concatMap names (Map.elems known)))
    names rule = case rule of
      Literal _ -> []
      Named name -> [name]
      Sequence rs -> concatMap names rs
      Choice rs -> concatMap names rs
      Many r -> names r
      Optional r -> names r

-- | The words and symbols in quotation marks.
literals :: Grammar -> [Text]
literals (Grammar known) = sort (Set.toList (Set.fromList (concatMap inside (Map.elems known))))
  where
    inside rule = case rule of
      Literal text -> [text]
      Named _ -> []
      Sequence rs -> concatMap inside rs
      Choice rs -> concatMap inside rs
      Many r -> inside r
      Optional r -> inside r

-- Sentences

-- | An element of a sentence: a word or symbol, the end of a line, or the absence of a space.
data Mark = Written Text | LineEnd | Touching
  deriving stock (Eq, Show)

-- | A random sentence. Statements and the lines of tables begin on lines of their own, and the
-- parenthesis of a call touches its name.
sentence :: Grammar -> Gen Text
sentence grammar =
  choose (16, 44) >>= \fuel -> spaced <$> derive grammar fuel (Named "program")

-- | A random sentence that contains a literal of the grammar. The derivation goes to the literal by
-- the fewest named rules; everything beside this path is random.
sentenceWith :: Text -> Grammar -> Gen Text
sentenceWith literal grammar@(Grammar known) =
  choose (16, 44) >>= \fuel -> spaced <$> toward fuel (Named "program")
  where
    toward :: Int -> Rule -> Gen [Mark]
    toward fuel rule = case rule of
      Literal text -> pure [Written text]
      Sequence rs -> case elemIndex (distance rule) (map distance rs) of
        Just k -> concat <$> traverse (part k) (zip [0 ..] rs)
        Nothing -> pure []
        where
          part k (j, r) = if j == k then toward fuel r else derive grammar fuel r
      Choice rs -> elements [r | r <- rs, distance r == distance rule] >>= toward fuel
      Many r -> toward fuel r
      Optional r -> toward fuel r
      Named name -> around name (toward (below name fuel) (ruleOf grammar name))
    distance = distanceIn distances
    distances = settle known distanceIn
    -- The fewest named rules between a rule and the literal.
    distanceIn now rule = case rule of
      Literal text -> if text == literal then 0 else unreached
      Named name -> 1 + Map.findWithDefault unreached name now
      Sequence rs -> minimum (unreached : map (distanceIn now) rs)
      Choice rs -> minimum (unreached : map (distanceIn now) rs)
      Many r -> distanceIn now r
      Optional r -> distanceIn now r

-- | A random derivation of a rule. The fuel bounds its depth: rules whose height exceeds the fuel
-- are avoided.
derive :: Grammar -> Int -> Rule -> Gen [Mark]
derive grammar@(Grammar known) = go
  where
    go :: Int -> Rule -> Gen [Mark]
    go fuel rule = case rule of
      Literal text -> pure [Written text]
      Sequence rs -> concat <$> traverse (go fuel) rs
      Choice rs -> elements (affordable fuel rs) >>= go fuel
      Many r
        | height r > fuel -> pure []
        | otherwise -> times r >>= \k -> concat <$> vectorOf k (go fuel r)
      Optional r
        | height r > fuel -> pure []
        | otherwise -> frequency [(3, pure []), (1, go fuel r)]
      Named "name" -> word ["a", "lug", "радиус", "depth", "step", "at", "line"]
      Named "number" -> word ["0", "41", "59.3", "007"]
      Named "text" -> word ["\"\"", "\"Фланец, фиг. 2\""]
      Named "machine-name" -> word ["lkp-01f", "2.5-ax"]
      Named name -> around name (go (below name fuel) (ruleOf grammar name))
    word texts = (\text -> [Written text]) <$> elements texts
    -- There are several statements and items, but few operators, so that sentences stay short.
    times r = case r of
      Named name | name `elem` ["statement", "item", "setting"] -> choose (0, 3 :: Int)
      _ -> frequency [(10, pure 0), (2, pure 1), (1, pure 2)]
    -- The alternatives whose height is at most the fuel, or else those of least height.
    affordable fuel rs = case filter ((<= fuel) . height) rs of
      [] -> [r | r <- rs, height r == minimum (map height rs)]
      some -> some
    height = heightIn heights
    heights = settle known heightIn

-- | The right-hand side of a named rule.
ruleOf :: Grammar -> Text -> Rule
ruleOf (Grammar known) name = Map.findWithDefault (Sequence []) name known

-- | The fuel that is left inside a named rule. Blocks and expressions use up much of it.
below :: Text -> Int -> Int
below name fuel
  | name `elem` ["items", "statements"] = fuel - 9
  | name == "expr" = min 32 fuel - 6
  | otherwise = fuel - 1

-- | A derivation of a named rule, with the ends of lines and the absent spaces before it.
around :: Text -> Gen [Mark] -> Gen [Mark]
around name marked = case name of
  "statement" -> (LineEnd :) <$> marked
  "line" -> (LineEnd :) <$> marked
  "arguments" -> (Touching :) <$> marked
  "values" -> (Touching :) <$> marked
  "parameters" -> (Touching :) <$> marked
  -- An item that begins with a minus would continue the line before it.
  "item" -> marked `suchThat` ((/= [Written "-"]) . take 1)
  _ -> marked

-- | The number of a rule that has none.
unreached :: Int
unreached = 1000

-- | The least numbers of all rules that agree with one another.
settle :: Map Text Rule -> (Map Text Int -> Rule -> Int) -> Map Text Int
settle known number = go (fmap (const unreached) known)
  where
    go now = let new = fmap (number now) known in if new == now then now else go new

-- | The height of a rule: the least number of named rules inside one another in a derivation.
heightIn :: Map Text Int -> Rule -> Int
heightIn heights rule = case rule of
  Literal _ -> 0
  Named name -> maybe 0 (+ 1) (Map.lookup name heights)
  Sequence rs -> maximum (0 : map (heightIn heights) rs)
  Choice rs -> minimum (map (heightIn heights) rs)
  Many _ -> 0
  Optional _ -> 0

-- | The text of a sentence.
spaced :: [Mark] -> Text
spaced written = case written of
  [] -> "\n"
  Written text : rest -> " " <> text <> spaced rest
  LineEnd : rest -> "\n" <> spaced rest
  Touching : Written text : rest -> text <> spaced rest
  Touching : rest -> spaced rest

-- Recognition

-- | Tells if tokens are a sentence of a grammar. Line ends are ignored.
recognises :: Grammar -> [Token] -> Bool
recognises (Grammar known) tokens = Set.member finish (ends 0 (Named "program"))
  where
    words' = Map.fromAscList (zip [0 ..] (concatMap (parts . shape) tokens))
    finish = Map.size words'
    -- The ends of every rule from every index, computed lazily.
    table = Map.map (\rule -> Map.fromAscList [(at, ends at rule) | at <- [0 .. finish]]) known
    ends :: Int -> Rule -> Set Int
    ends at rule = case rule of
      Literal text -> one at (`elem` [Word text, Symbol text])
      Named name -> case Map.lookup name table of
        Just row -> Map.findWithDefault Set.empty at row
        Nothing -> one at (terminal name)
      Sequence rs ->
        foldl (\from r -> unions [ends x r | x <- Set.toList from]) (Set.singleton at) rs
      Choice rs -> unions (map (ends at) rs)
      Many r -> closure r (Set.singleton at) (Set.singleton at)
      Optional r -> Set.insert at (ends at r)
    one at fits = case Map.lookup at words' of
      Just word | fits word -> Set.singleton (at + 1)
      _ -> Set.empty
    closure r seen fresh
      | Set.null fresh = seen
      | otherwise =
        let new = unions [ends x r | x <- Set.toList fresh] `Set.difference` seen
         in closure r (Set.union seen new) new
    unions = Set.unions :: [Set Int] -> Set Int

-- | Tells if a literal is among tokens.
contains :: Text -> [Token] -> Bool
contains literal = any (`elem` [Word literal, Symbol literal]) . concatMap (parts . shape)

-- | The tokens of the grammar for a token of the lexer: a number and its unit are two tokens.
parts :: Token_ -> [Token_]
parts token = case token of
  Number n (Just unit) -> [Number n Nothing, Word (unitName unit)]
  _ -> [token]

-- | Tells if a token is the terminal of the given name.
terminal :: Text -> Token_ -> Bool
terminal name token = case (name, token) of
  ("name", Word word) -> not (Keyword.isReserved word)
  ("machine-name", Word _) -> True
  ("number", Number _ Nothing) -> True
  ("text", Text _) -> True
  _ -> False
