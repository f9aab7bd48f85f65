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
import Control.Applicative ((<|>))
import Data.Char (isAsciiLower, isAsciiUpper, isDigit, isSpace, toUpper)
import Data.List (find)
import Data.Maybe (mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.ProgramForm (Dialect (..))

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
    column :: Int,
    -- | true if the number is written with a point
    hasPoint :: Bool
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
  | -- | a character that this control reads in another way than others
    OtherMeaning Char
  | -- | a character on which the control acts at once, wherever it stands
    RealTimeCharacter Char
  | -- | an end of a line of one control in the middle of a line of another
    LoneReturn
  | -- | a comment that the control carries out
    ActiveComment
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
  | -- | a number without a point, of this word
    PointMissing Text
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
  | -- | a canned cycle whose height R is below the bottom or above the tool, or without pecks
    BadCycle
  | -- | a line with more characters than the control reads: the largest count
    LineTooLong Int
  | -- | words behind the end of the program
    BehindEnd
  deriving stock (Eq, Show)

-- | Lines of a file with words or comments, numbered from @first@ on; a fault for a line that
-- cannot be divided into words. A line that consists of a percent sign begins the program; a second
-- one ends it, and what follows is not read. The list is made as it is used.
blocks :: Dialect -> Int -> Text -> [Either Fault GcodeBlock]
blocks dialect first file =
  mapMaybe block (upToEnd False (zip [first ..] (map bare (Text.lines file))))
  where
    bare = Text.dropWhileEnd (== '\r')
    hasPercents = dialect `elem` [LinuxCnc, Fanuc]
    upToEnd begun list = case list of
      [] -> []
      (n, line) : more
        | hasPercents && Text.strip line == "%" -> if begun then [] else upToEnd True more
        | otherwise -> (n, line) : upToEnd (begun || not (Text.null (Text.strip line))) more
    block (n, line) = case maybe (wordsOf n line) Left (signFault dialect n line) of
      Left fault -> Just (Left fault)
      Right (ws, cs)
        | null ws && null cs -> Nothing
        | otherwise -> Just (Right (GcodeBlock n ws cs (isOptionalLine line)))
    isOptionalLine = Text.isPrefixOf "/" . Text.stripStart

-- | Fault of a line in which the control reads a character in another way than 'wordsOf' does.
--
-- Sources: protocol.c and serial.c of GRBL 1.1 (real-time commands, ends of lines, the percent
-- sign); parser.cpp of Marlin 2 (parentheses and small letters only with options of the build);
-- LinuxCNC, G-code overview (active comments); Fanuc and Haas (a semicolon ends the block).
signFault :: Dialect -> Int -> Text -> Maybe Fault
signFault dialect n line
  | Just at <- columnOf (== '\r') line = Just (Fault n at LoneReturn)
  | otherwise = case dialect of
    LinuxCnc
      | Text.any (`elem` ("(;" :: String)) line ->
        Fault n 1 ActiveComment <$ find isActive (commentsOf line)
      | otherwise -> Nothing
    Grbl -> character RealTimeCharacter isRealTime line <|> character OtherMeaning (== '%') bare
    Marlin -> character OtherMeaning isForeign (Text.takeWhile (/= ';') line)
    Fanuc
      | (code, rest) <- Text.breakOn ";" bare,
        not (Text.null (Text.strip (Text.drop 1 rest))) ->
        Just (Fault n (Text.length code + 1) (OtherMeaning ';'))
      | otherwise -> Nothing
  where
    character reason test text =
      (\at -> Fault n at (reason (Text.index text (at - 1)))) <$> columnOf test text
    columnOf test text = (+ 1) <$> Text.findIndex test text
    isRealTime c = c `elem` ("!?~" :: String) || c > '~' || c < ' ' && c /= '\t'
    isForeign c = isAsciiLower c || c `elem` ("(/%" :: String)
    isActive comment =
      any
        (`Text.isPrefixOf` Text.toLower (Text.filter (not . isSpace) comment))
        ["py,", "pyrun", "pyreload", "log", "probeopen", "probeclose", "abort"]
    commentsOf text = either (const []) snd (wordsOf n text)
    -- Comments in parentheses are blanks of the same length.
    bare = blanked line
    blanked text = case Text.breakOn "(" text of
      (before, rest)
        | Text.null rest -> before
        | otherwise ->
          let (comment, after) = Text.breakOn ")" rest
           in before <> Text.replicate (Text.length comment + 1) " " <> blanked (Text.drop 1 after)

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
          Just (Right (number, hasPoint, after)) -> do
            (ws, cs) <- go (at + 1 + Text.length rest - Text.length after) after
            Right (GcodeWord (toUpper c) number at hasPoint : ws, cs)
        | otherwise -> Left (Fault n at (StrayCharacter c))

-- | Number at the beginning of a text, true if it has a point, and the text behind it. Nothing if
-- no number begins there; Left if it has too many digits.
numberFrom :: Text -> Maybe (Either () (GcodeNumber, Bool, Text))
numberFrom text
  | Text.null whole && Text.null fraction = Nothing
  | Text.length whole > mostWhole || decimals > mostDecimals = Just (Left ())
  | otherwise = Just (Right (GcodeNumber (sign * value) decimals, hasPoint, rest))
  where
    decimals = Text.length fraction
    (sign, unsigned) = case Text.uncons text of
      Just ('-', more) -> (-1, more)
      Just ('+', more) -> (1, more)
      _ -> (1, text)
    (whole, afterWhole) = Text.span isDigit unsigned
    hasPoint = "." `Text.isPrefixOf` afterWhole
    (fraction, rest)
      | hasPoint = Text.span isDigit (Text.drop 1 afterWhole)
      | otherwise = ("", afterWhole)
    value = digitsOf (digitsOf 0 whole) fraction
    digitsOf = Text.foldl' (\v c -> 10 * v + fromEnum c - fromEnum '0')

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
