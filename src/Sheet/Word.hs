-- | The words of the text of an input sheet: numbers, signs without digits, and end marks @-0@. An
-- end mark closes a list of points or the numbers of a piece, which is a curve of the part.
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

-- | The meaning of a word.
data WordValue
  = -- | a number; 0 is never negative, because @-0@ is an end mark
    Figure Double
  | -- | the end mark @-0@
    Mark
  | -- | a plus sign without digits: the link between pieces that touch
    Plus
  | -- | a minus sign without digits: the link between pieces that intersect
    Minus
  deriving stock (Eq, Show)

-- | A word with its position.
data SheetWord = SheetWord {position :: NumberPosition, symbol :: WordValue}

-- | The words of a text in order. A word is an error if it is not a number, an end mark or a sign.
entries :: Text -> [Either Error SheetWord]
entries text = zipWith entry [1 ..] (wordsOf text)

-- | The words of a text with their regions.
wordsOf :: Text -> [Located Text]
wordsOf = go 0
  where
    go at text = case Text.break isSpace trimmed of
      ("", _) -> []
      (word, after) ->
        let to = from + Text.length word in Located (Region from to) word : go to after
      where
        trimmed = Text.dropWhile isSpace text
        from = at + Text.length text - Text.length trimmed

-- | The meaning of a word, whose position among all words is @number@, counted from 1.
entry :: Int -> Located Text -> Either Error SheetWord
entry number (Located at word) =
  maybe (Left (NotANumber here word)) (Right . SheetWord here) $ case Text.uncons word of
    Just ('+', "") -> Just Plus
    Just ('-', "") -> Just Minus
    Just ('+', digits) -> Figure <$> Decimal.parse digits
    Just ('-', digits) ->
      (\x -> if x == 0 then Mark else Figure (negate x)) <$> Decimal.parse digits
    _ -> Figure <$> Decimal.parse word
  where
    here = NumberPosition at number

-- | The number of a word with its region; Nothing for end marks and signs.
figure :: SheetWord -> Maybe Number
figure e = case symbol e of
  Figure x -> Just (Located (site (position e)) x)
  Mark -> Nothing
  Plus -> Nothing
  Minus -> Nothing

-- | True if a word is a sign without digits.
isSign :: SheetWord -> Bool
isSign e = case symbol e of
  Plus -> True
  Minus -> True
  Figure _ -> False
  Mark -> False
