-- | The words of a sheet: numbers, end marks, lone signs.
module Sheet.Word
  ( WordValue (..),
    SheetWord (..),
    entries,
    figure,
    isSign,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Located (..), Region (..))
import Data.Char (isSpace)
import Data.Text (Text)
import Data.Text qualified as Text
import Sheet.Error (Error (..), NumberPosition (..))
import Sheet.Sheet (Number)

-- | What a word of the sheet is.
data WordValue
  = Figure Double
  | -- | @-0@
    Mark
  | -- | a sign without digits
    Plus
  | Minus
  deriving stock (Eq, Show)

data SheetWord = SheetWord {spot :: NumberPosition, symbol :: WordValue}

-- | The words of a text; what is no number is an error.
entries :: Text -> [Either Error SheetWord]
entries text = zipWith entry [1 ..] (wordsOf text)

-- | The words of a text with their places.
wordsOf :: Text -> [Located Text]
wordsOf = go 0
  where
    go at rest = case Text.break isSpace here of
      ("", _) -> []
      (word, after) ->
        Located (Region from (from + Text.length word)) word : go (from + Text.length word) after
      where
        here = Text.dropWhile isSpace rest
        from = at + Text.length rest - Text.length here

entry :: Int -> Located Text -> Either Error SheetWord
entry number (Located at word) =
  maybe (Left (NotANumber here word)) (Right . SheetWord here) $ case Text.uncons word of
    Just ('+', "") -> Just Plus
    Just ('-', "") -> Just Minus
    Just ('+', digits) -> Figure <$> Decimal.amount digits
    Just ('-', digits) ->
      (\x -> if x == 0 then Mark else Figure (negate x)) <$> Decimal.amount digits
    _ -> Figure <$> Decimal.amount word
  where
    here = NumberPosition at number

-- | A number with its place.
figure :: SheetWord -> Maybe Number
figure e = case symbol e of
  Figure x -> Just (Located (site (spot e)) x)
  Mark -> Nothing
  Plus -> Nothing
  Minus -> Nothing

-- | Whether a word is a sign without digits.
isSign :: SheetWord -> Bool
isSign e = case symbol e of
  Plus -> True
  Minus -> True
  Figure _ -> False
  Mark -> False
