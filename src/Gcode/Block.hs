-- | Lines of a G-code file as words: letters with their numbers. The words have no meaning yet.
--
-- A block is one line. A comment is in parentheses, or goes from a semicolon to the end of the
-- line. Expressions, parameters and control flow are not understood, so they are refused: the
-- motions of such a file would be unknown.
module Gcode.Block
  ( GcodeBlock (..),
    GcodeWord (..),
    GcodeNumber (..),
    Fault (..),
    FaultReason (..),
    blocks,
    isWhole,
    scaled,
    numberText,
  )
where

import Base.Decimal qualified as Decimal
import Data.Char (isAsciiLower, isAsciiUpper, isDigit, toUpper)
import Data.Text (Text)
import Data.Text qualified as Text

-- | One line of a file.
data GcodeBlock = GcodeBlock
  { -- | number of the line, from 1
    lineNumber :: Int,
    gcodeWords :: [GcodeWord],
    -- | texts of the comments, without their marks
    comments :: [Text],
    -- | true for a line that begins with a slash: the operator may choose to leave it out
    isOptional :: Bool
  }
  deriving stock (Eq, Show)

-- | A letter with a number.
data GcodeWord = GcodeWord
  { -- | capital letter
    letter :: Char,
    number :: GcodeNumber,
    -- | first column of the word, from 1
    column :: Int
  }
  deriving stock (Eq, Show)

-- | A decimal number, exactly: its digits as a whole number with a sign, and how many of the digits
-- are after the point.
data GcodeNumber = GcodeNumber {digits :: Int, decimals :: Int}
  deriving stock (Eq, Show)

-- | Line that is not understood: its number, its first column, and the reason.
data Fault = Fault Int Int FaultReason
  deriving stock (Eq, Show)

-- | Reason why a line is not understood.
data FaultReason
  = -- | a character that begins no word
    StrayCharacter Char
  | -- | a letter without a number
    NumberMissing Char
  | -- | a number with more digits than the proof can hold
    NumberTooLong
  | -- | a comment without its end
    CommentOpen
  | -- | the file has no line of words
    NoWords
  | -- | a word that the control does not have
    UnknownWord Text
  | -- | a word that the control may have, but whose effect the proof does not know
    UnprovenWord Text
  | -- | two words of one group, such as G0 and G1, or the same letter twice
    RepeatedWord Text
  | -- | a word without the word that it needs: both words
    WordMissing Text Text
  | -- | a word that no other word of the line uses
    UnusedWord Text
  | -- | a number that should be whole, of this word
    NotWhole Text
  | -- | a number that should not be negative, of this word
    NegativeNumber Text
  | -- | a distance word before any kind of motion is chosen
    NoMotionMode
  | -- | a position that depends on where the machine stands
    UnknownPosition Char
  | -- | an arc whose centre is missing, or at its beginning or end
    BadArc
  | -- | a line with more characters than the control reads: the largest count
    LineTooLong Int
  | -- | words behind the end of the program
    BehindEnd
  deriving stock (Eq, Show)

-- | Lines of a file, numbered from @first@ on; a fault for the first line that cannot be divided
-- into words. A line that consists of a percent sign begins the program; a second one ends it, and
-- what follows is not read.
blocks :: Int -> Text -> Either Fault [GcodeBlock]
blocks first file =
  concat <$> traverse block (upToEnd False (zip [first ..] (map bare (Text.lines file))))
  where
    bare = Text.dropWhileEnd (== '\r')
    upToEnd begun list = case list of
      [] -> []
      (n, line) : more
        | Text.strip line == "%" -> if begun then [] else upToEnd True more
        | otherwise -> (n, line) : upToEnd (begun || not (Text.null (Text.strip line))) more
    block (n, line) = case wordsOf n line of
      Left fault -> Left fault
      Right (ws, cs)
        | null ws && null cs -> Right []
        | otherwise -> Right [GcodeBlock n ws cs ("/" `Text.isPrefixOf` Text.stripStart line)]

-- | Words and comments of the line with a number.
wordsOf :: Int -> Text -> Either Fault ([GcodeWord], [Text])
wordsOf n line = go 1 line
  where
    blank = Text.length line - Text.length (Text.stripStart line)
    go at text = case Text.uncons text of
      Nothing -> Right ([], [])
      Just (c, rest)
        | c == ' ' || c == '\t' -> go (at + 1) rest
        | c == '/' && at == blank + 1 -> go (at + 1) rest
        | c == ';' -> Right ([], [rest])
        | c == '(' -> case Text.breakOn ")" rest of
          (comment, end)
            | Text.null end -> Left (Fault n at CommentOpen)
            | otherwise ->
              fmap (comment :) <$> go (at + Text.length comment + 2) (Text.drop 1 end)
        | isAsciiUpper c || isAsciiLower c -> case numberFrom (Text.stripStart rest) of
          Nothing -> Left (Fault n at (NumberMissing (toUpper c)))
          Just (Left ()) -> Left (Fault n at NumberTooLong)
          Just (Right (number, after)) -> do
            let taken = Text.length rest - Text.length after
            (ws, cs) <- go (at + 1 + taken) after
            Right (GcodeWord (toUpper c) number at : ws, cs)
        | otherwise -> Left (Fault n at (StrayCharacter c))

-- | Number at the beginning of a text, and the text behind it. Nothing if no number begins there;
-- Left if it has too many digits.
numberFrom :: Text -> Maybe (Either () (GcodeNumber, Text))
numberFrom text
  | Text.null whole && Text.null fraction = Nothing
  | Text.length whole > mostWhole || Text.length fraction > mostDecimals = Just (Left ())
  | otherwise = Just (Right (GcodeNumber (sign * value) (Text.length fraction), rest))
  where
    (sign, unsigned) = case Text.uncons text of
      Just ('-', more) -> (-1, more)
      Just ('+', more) -> (1, more)
      _ -> (1, text)
    (whole, afterWhole) = Text.span isDigit unsigned
    (fraction, rest) = case Text.uncons afterWhole of
      Just ('.', more) -> Text.span isDigit more
      _ -> ("", afterWhole)
    value = Text.foldl' (\v c -> 10 * v + fromEnum c - fromEnum '0') 0 (whole <> fraction)

-- | Largest count of digits before the point, and after it.
mostWhole, mostDecimals :: Int
mostWhole = 8
mostDecimals = 8

-- | The whole number that a number is; Nothing if it has a fraction.
isWhole :: GcodeNumber -> Maybe Int
isWhole (GcodeNumber d k)
  | r == 0 = Just q
  | otherwise = Nothing
  where
    (q, r) = d `quotRem` (10 ^ k)

-- | The number times 10 to the power @k@; digits behind it are cut off.
scaled :: Int -> GcodeNumber -> Int
scaled k (GcodeNumber d n)
  | k >= n = d * 10 ^ (k - n)
  | otherwise = d `quot` (10 ^ (n - k))

-- | Number as text, without zeros at the end of its decimals.
numberText :: GcodeNumber -> Text
numberText (GcodeNumber d n)
  | Text.null fraction = sign <> whole
  | otherwise = sign <> whole <> "." <> fraction
  where
    sign = if d < 0 then "-" else ""
    padded = Text.justifyRight (n + 1) '0' (Decimal.whole (abs d))
    (whole, decimal) = Text.splitAt (Text.length padded - n) padded
    fraction = Text.dropWhileEnd (== '0') decimal
