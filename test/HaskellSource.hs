-- | A simple parser of Haskell sources, for the tests of the code's form. It knows the lexical
-- grammar and where top-level definitions begin and end. It does not know types and scopes.
module HaskellSource
  ( -- * Tokens
    Token (..),
    tokenise,

    -- * The header of a module
    imports,
    listsExports,
    exportedTypes,

    -- * Top-level definitions
    Definition (..),
    definitions,
    parameterCount,
  )
where

import Data.Char (isAlpha, isAlphaNum, isAscii, isPunctuation, isSpace, isSymbol, isUpper)
import Data.List (foldl')
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text

-- Tokens ------------------------------------------------------------------------------------

-- | A token of a source, simplified. Comments, pragmas and character literals are left out.
data Token
  = -- | a keyword, a name, a qualified name or a number
    Word Text
  | -- | a string literal, without its content
    Literal
  | -- | an operator, or a single bracket, comma or other mark
    Mark Text
  deriving stock (Eq, Show)

-- | The tokens of a source.
tokenise :: Text -> [Token]
tokenise source = case Text.uncons source of
  Nothing -> []
  Just (c, rest)
    | isSpace c -> tokenise (Text.dropWhile isSpace rest)
    | "{-" `Text.isPrefixOf` source -> tokenise (afterComment (Text.drop 2 source))
    | c == '"' -> Literal : tokenise (afterString rest)
    | c == '\'' -> tokenise (afterQuote rest)
    | isOperatorChar c -> case Text.span isOperatorChar source of
      (operator, next)
        | isDashes operator -> tokenise (Text.dropWhile (/= '\n') next)
        | otherwise -> Mark operator : tokenise next
    | isWordChar c ->
      let word = Text.dropWhileEnd (== '.') (Text.takeWhile isWordChar source)
       in Word word : tokenise (Text.drop (Text.length word) source)
    | otherwise -> Mark (Text.singleton c) : tokenise rest
  where
    isDashes operator = Text.length operator >= 2 && Text.all (== '-') operator

-- | The text after a block comment, given the text after its opening @{-@. Comments nest.
afterComment :: Text -> Text
afterComment = go (1 :: Int)
  where
    go 0 text = text
    go depth text
      | Text.null text = text
      | "{-" `Text.isPrefixOf` text = go (depth + 1) (Text.drop 2 text)
      | "-}" `Text.isPrefixOf` text = go (depth - 1) (Text.drop 2 text)
      | otherwise = go depth (Text.drop 1 text)

-- | The text after a string literal, given the text after its opening quotation mark.
afterString :: Text -> Text
afterString text = case Text.unpack (Text.take 2 unremarkable) of
  '\\' : '^' : _ -> afterString (Text.drop 3 unremarkable)
  '\\' : c : _
    | isSpace c ->
      afterString (Text.drop 1 (Text.dropWhile isSpace (Text.drop 1 unremarkable)))
  '\\' : _ -> afterString (Text.drop 2 unremarkable)
  _ -> Text.drop 1 unremarkable
  where
    unremarkable = Text.dropWhile (`notElem` ("\\\"" :: String)) text

-- | The text after a character literal, given the text after its opening quote. A quote that opens
-- no literal marks a promoted name and is ignored.
afterQuote :: Text -> Text
afterQuote text = case Text.unpack (Text.take 2 text) of
  '\\' : _ -> Text.drop 1 (Text.dropWhile (/= '\'') (Text.drop 2 text))
  [_, '\''] -> Text.drop 2 text
  _ -> text

isWordChar :: Char -> Bool
isWordChar c = isAlphaNum c || c `elem` ("_'." :: String)

isOperatorChar :: Char -> Bool
isOperatorChar c
  | isAscii c = c `elem` ("!#$%&*+./<=>?@\\^|-~:" :: String)
  | otherwise = isSymbol c || isPunctuation c

-- The header of a module -----------------------------------------------------------------

-- | The names of the modules that a module imports, in the order of the source.
imports :: [Token] -> [Text]
imports tokens = case tokens of
  Word "foreign" : Word "import" : rest -> imports rest
  Word "import" : rest -> case dropWhile isModifier rest of
    Word name : rest' | isModuleName name -> name : imports rest'
    rest' -> imports rest'
  _ : rest -> imports rest
  [] -> []
  where
    isModifier token = token `elem` [Word "qualified", Word "safe", Literal]
    isModuleName = Text.any isAlpha

-- | Does the header of a module have an export list?
listsExports :: [Token] -> Bool
listsExports tokens = case dropWhile (/= Word "module") tokens of
  Word "module" : Word _ : Mark "(" : _ -> True
  _ -> False

-- | The types that a module declares and exports, in the order of its export list.
exportedTypes :: [Token] -> [Text]
exportedTypes tokens = filter (`Set.member` declared) (exportList tokens)
  where
    declared = Set.fromList (declaredTypes tokens)

-- | The names of types and constructors in the export list.
exportList :: [Token] -> [Text]
exportList tokens = case dropWhile (/= Word "module") tokens of
  Word "module" : Word _ : Mark "(" : rest ->
    [name | Word name <- takeWhile (/= Word "where") rest, Text.any isUpper (Text.take 1 name)]
  _ -> []

-- | The types that a module declares.
declaredTypes :: [Token] -> [Text]
declaredTypes tokens = case tokens of
  Word keyword : Word name : rest
    | keyword `elem` ["data", "newtype", "type"] -> name : declaredTypes rest
  _ : rest -> declaredTypes rest
  [] -> []

-- Top-level definitions -----------------------------------------------------------------------

-- | A function or value at the top level.
data Definition = Definition
  { name :: Text,
    -- | how many lines its equations take, without comments and blank lines
    extent :: Int,
    -- | how many parameters its type signature has; 0 without a signature
    parameters :: Int
  }
  deriving stock (Eq, Show)

-- | The definitions of a module in the order of their names.
definitions :: Text -> [Definition]
definitions source =
  [ Definition {name, extent, parameters = Map.findWithDefault 0 name signatures}
    | (name, extent) <- Map.toList extents
  ]
  where
    blocks = topLevelBlocks (Text.lines source)
    signatures =
      Map.fromList [(n, parameterCount rest) | b <- blocks, Just (n, rest) <- [signatureOf b]]
    extents = foldl' addExtent Map.empty blocks

-- | Adds the number of lines of an equation to that of its definition. Ignores other blocks.
addExtent :: Map Text Int -> [Text] -> Map Text Int
addExtent known block = case tokenise (Text.unlines block) of
  Word name : rest
    | name `notElem` declarations,
      Nothing <- signatureOf block,
      Mark "=" `elem` rest || Mark "|" `elem` rest ->
      Map.insertWith (+) name (length block) known
  _ -> known
  where
    declarations =
      ["data", "newtype", "type", "class", "instance", "deriving", "import", "module", "where"]

-- | The name that a type signature declares, and the tokens after its @::@. Nothing for other
-- blocks.
signatureOf :: [Text] -> Maybe (Text, [Token])
signatureOf block = case tokenise (Text.unlines block) of
  Word name : Mark "::" : rest -> Just (name, rest)
  _ -> Nothing

-- | The lines of a source in groups. Each group begins with a line whose first column is not blank.
-- Comments and blank lines are left out.
topLevelBlocks :: [Text] -> [[Text]]
topLevelBlocks source = case filter isCode source of
  [] -> []
  first : rest ->
    let (continued, others) = span (Text.all isSpace . Text.take 1) rest
     in (first : continued) : topLevelBlocks others
  where
    isCode l = not (Text.null (Text.strip l)) && not ("--" `Text.isPrefixOf` Text.stripStart l)

-- | Count of the parameters of a type signature: its arrows outside of brackets, after the
-- constraints.
parameterCount :: [Token] -> Int
parameterCount = go (0 :: Int) 0
  where
    go depth count tokens = case tokens of
      Mark m : rest
        | m `elem` ["(", "[", "{"] -> go (depth + 1) count rest
        | m `elem` [")", "]", "}"] -> go (depth - 1) count rest
        | m == "->" && depth == 0 -> go depth (count + 1) rest
        | m == "=>" && depth == 0 -> go depth 0 rest
      _ : rest -> go depth count rest
      [] -> count
