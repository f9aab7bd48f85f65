-- | Failures of the explaining parser, and the errors that they become.
module Surface.Failure
  ( ParseFailure,
    Problem (..),
    maxNesting,
    toErrors,
  )
where

import Base.Region (Region (..))
import Data.List (find)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Surface.Error (Enclosure, Error, FoundText (..))
import Surface.Error qualified as Error
import Surface.Keyword qualified as Keyword
import Surface.Token (Token (..), Token_ (..))
import Surface.Token qualified as Token
import Surface.TokenContext (TokenContext (..))
import Surface.TokenStream (TokenStream)
import Text.Megaparsec (ErrorItem (..), ParseError (..))
import Text.Megaparsec qualified as Parsec

-- | A failure in the form of the library megaparsec; its offset is the index of a token, from 0.
type ParseFailure = ParseError TokenStream Problem

-- | Failures that are more specific than an unexpected token.
data Problem
  = -- | an enclosure without its closing bracket: the region of the opening bracket, the enclosure
    UnclosedBlock Region Enclosure
  | -- | a word that begins no statement
    NoStatement Text
  | -- | a reserved word where a statement should define a name
    NoName Text
  | -- | the end of a line before something that has to be on it, which the text describes
    LineEnds Text
  | -- | a token after a complete statement on the same line
    TextAfterStatement Token_
  | -- | a token that begins no cell, in a row of a table
    NotInRow Token_
  | -- | a token that begins no heading, among the headings of a table
    NotInHeadings Token_
  | -- | a @piece@ statement that does not say on which side of its curve the piece lies
    NoSide
  | -- | a statement in a block that cannot contain statements: its keyword
    Misplaced Text
  | -- | parentheses with more than three values: their region
    ManyCoordinates Region
  | -- | brackets nested deeper than 'maxNesting'
    TooDeep
  deriving stock (Eq, Ord, Show)

-- | The largest nesting depth of brackets.
maxNesting :: Int
maxNesting = 500

-- | The errors for failures in the tokens @tokens@ of a text, which ends at the offset @finish@.
toErrors :: [Token] -> Int -> [ParseFailure] -> [Error]
toErrors tokens finish = map (fromFailure (Vector.fromList tokens) finish)

-- | The error for a failure. The tokens are those of the whole text, which ends at offset @finish@.
fromFailure :: Vector Token -> Int -> ParseFailure -> Error
fromFailure ts finish failure = case failure of
  FancyError _ problems | Parsec.ErrorCustom problem : _ <- Set.toList problems -> case problem of
    UnclosedBlock opened what -> Error.Unclosed region opened what around
    NoStatement word ->
      Error.UnknownStatement
        region
        word
        (Keyword.statements <> Keyword.softStatements <> Keyword.blocks)
        around
    NoName word -> Error.Reserved region word (freeName ts word) []
    LineEnds what -> Error.Unexpected region found [what] around
    TextAfterStatement shape' -> Error.Trailing region shape' around
    NotInRow shape' -> Error.NotInRow region shape' around
    NotInHeadings shape' -> Error.NotInHeadings region shape' around
    NoSide -> Error.NoSide region found around
    Misplaced word -> Error.Misplaced region word (enclosing ts index) around
    ManyCoordinates place -> Error.ManyCoordinates place (tokensIn place ts)
    TooDeep -> Error.TooDeep region maxNesting
  FancyError _ _ -> Error.Unexpected region found [] around
  TrivialError _ _ expected ->
    Error.Unexpected region found (concatMap wanted (Set.toList expected)) around
  where
    index = Parsec.errorOffset failure
    around = surroundings ts index
    here = ts Vector.!? index
    region = maybe (Region finish finish) Token.place here
    found = maybe FoundEnd (FoundToken . shape) here
    wanted expected' = case expected' of
      Label text -> [Text.pack (NonEmpty.toList text)]
      Parsec.Tokens _ -> []
      EndOfInput -> []

-- | The tokens of the statement around the token with the given index.
surroundings :: Vector Token -> Int -> TokenContext
surroundings ts index =
  TokenContext
    { before = statement,
      after = line,
      isLineStart = maybe True newLine (ts Vector.!? index),
      repairs = []
    }
  where
    statement = upToStart (Vector.toList (Vector.reverse (Vector.take index ts)))
    line = takeWhile (not . newLine) (Vector.toList (Vector.drop (index + 1) ts))
    upToStart tokens = case tokens of
      [] -> []
      t : rest
        | beginsStatement t -> [t]
        | otherwise -> t : upToStart rest

-- | The start of the statement in whose braces the token with the given index is. 'Nothing' if it
-- is in no braces.
enclosing :: Vector Token -> Int -> Maybe Int
enclosing ts index = go (0 :: Int) (Vector.toList (Vector.reverse (Vector.take index ts)))
  where
    go open tokens = case tokens of
      [] -> Nothing
      t : rest -> case shape t of
        Symbol "}" -> go (open + 1) rest
        Symbol "{"
          | open == 0 -> start . Token.place <$> find beginsStatement rest
          | otherwise -> go (open - 1) rest
        _ -> go open rest

-- | Tells if a token is a keyword that begins a statement, and the first one on its line.
beginsStatement :: Token -> Bool
beginsStatement t = case shape t of
  Word word ->
    newLine t && word `elem` (Keyword.statements <> Keyword.softStatements <> Keyword.blocks)
  _ -> False

tokensIn :: Region -> Vector Token -> [Token]
tokensIn (Region from to) = filter isInside . Vector.toList
  where
    isInside t = start (Token.place t) >= from && end (Token.place t) <= to

-- | A name that begins with the given word and does not occur among the tokens.
freeName :: Vector Token -> Text -> Text
freeName ts word = head (filter (`Set.notMember` used) candidates)
  where
    candidates = [word <> Text.pack (show n) | n <- [1 :: Int ..]]
    used = Set.fromList [w | Token {shape = Word w} <- Vector.toList ts]
