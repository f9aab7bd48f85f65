-- | Words of a line of G-code, sorted by what they do, and the values of their numbers.
module Gcode.BlockWords
  ( Sorted (..),
    sorted,
    given,
    decimal,
    mmOfNumber,
    picometresOf,
    picometres,
    faultAt,
    faultOf,
    wordText,
  )
where

import Control.Monad (forM_, unless, when)
import Data.Maybe (isJust, listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Gcode.Block
import Gcode.Cycle qualified as Cycle
import Gcode.Dialect
import Gcode.ModalState
import Machine.ProgramForm (Dialect (..), ProgramForm (..))

-- | Words of a line, sorted by what they do.
data Sorted = Sorted
  { block :: GcodeBlock,
    -- | the numbers of the G words and of the M words, in tenths
    gCodes :: [Int],
    mCodes :: [Int],
    -- | the words of all other letters
    others :: [GcodeWord]
  }

-- | Sorts the words of a line, and refuses words that the control does not have, and repetitions.
sorted :: ProgramForm -> GcodeBlock -> Either Fault Sorted
sorted form b = do
  checkForm form b
  gs <- codes 'G' (knowledgeOfG form) (groupOfG (dialect form))
  ms <- codes 'M' (mKnowledge (dialect form)) (groupOfM (dialect form))
  let others = [w | w <- gcodeWords b, letter w `notElem` ("GMN" :: String)]
  forM_ (gcodeWords b) $ \w ->
    unless
      (letter w `elem` letters (dialect form) && not (isJust (lathe form) && isOfY w))
      (faultOf b w (UnknownWord (wordText w)))
  forM_ (zip [0 ..] others) $ \(k, w) ->
    when
      (letter w `elem` map letter (take k others))
      (faultOf b w (RepeatedWord (Text.singleton (letter w))))
  pure Sorted {block = b, gCodes = gs, mCodes = ms, others}
  where
    -- A lathe has no axis Y.
    isOfY w = letter w `elem` ("YJ" :: String)
    codes c knowledge group = do
      let found = [w | w <- gcodeWords b, letter w == c]
      numbers <- traverse (code knowledge) found
      forM_ (zip3 [0 ..] found numbers) $ \(k, w, n) ->
        when
          (group n `elem` map group (take k numbers) && group n > 0 || n `elem` take k numbers)
          (faultOf b w (RepeatedWord (wordText w)))
      pure numbers
    code knowledge w = case isWhole (tenfold (number w)) of
      Just n -> case knowledge n of
        Known -> Right n
        Unproven -> faultOf b w (UnprovenWord (wordText w))
        Absent -> faultOf b w (UnknownWord (wordText w))
      Nothing -> faultOf b w (UnknownWord (wordText w))
    tenfold (GcodeNumber d k) = GcodeNumber (10 * d) k

-- | Knowledge of the G word with this number of tenths: canned cycles are known by the description
-- of the machine.
knowledgeOfG :: ProgramForm -> Int -> WordKnowledge
knowledgeOfG form code
  | code `elem` map (Cycle.codeOf . fst) (Cycle.known (cycles form)) = Known
  | otherwise = gKnowledge (dialect form) code

-- | Refuses lines that the operator may leave out, and for Marlin lines with two commands or with
-- words before the command.
checkForm :: ProgramForm -> GcodeBlock -> Either Fault ()
checkForm form b
  | isOptional b && dialect form `elem` [LinuxCnc, Fanuc] = faultAt b 1 (UnprovenWord "/")
  | dialect form == Marlin, _ : w : _ <- commandWords = faultOf b w (RepeatedWord (wordText w))
  | dialect form == Marlin,
    w : _ <- gcodeWords b,
    letter w `notElem` ("GMT" :: String) =
    faultOf b w NoMotionMode
  | dialect form == Marlin,
    [w] <- commandWords,
    letter w == 'M',
    isWhole (number w) `elem` [Just 0, Just 1],
    -- With a time the control goes on by itself.
    other : _ <- filter (/= w) (gcodeWords b) =
    faultOf b other (UnprovenWord (wordText other))
  | dialect form == Fanuc,
    w : _ <- filter isWithoutPoint (gcodeWords b) =
    faultOf b w (PointMissing (wordText w))
  | otherwise = Right ()
  where
    isWithoutPoint w =
      letter w `elem` ("XYZIJKRFQ" :: String) && not (hasPoint w) && digits (number w) /= 0
    commandWords = [w | w <- gcodeWords b, letter w `elem` ("GM" :: String)]

faultAt :: GcodeBlock -> Int -> FaultReason -> Either Fault a
faultAt b at reason = Left (Fault (lineNumber b) at reason)

faultOf :: GcodeBlock -> GcodeWord -> FaultReason -> Either Fault a
faultOf b w = faultAt b (column w)

wordText :: GcodeWord -> Text
wordText w = Text.singleton (letter w) <> numberText (number w)

-- | Number of the first word with a letter.
given :: Char -> Sorted -> Maybe GcodeNumber
given c s = listToMaybe [number w | w <- others s, letter w == c]

-- | Value of a number as a floating-point number.
decimal :: GcodeNumber -> Double
decimal (GcodeNumber d k) = fromIntegral d / 10 ^ k

-- | Value in mm of a number, in the units of the state.
mmOfNumber :: ModalState -> GcodeNumber -> Double
mmOfNumber m k = decimal k * (if valueOf (units m) == Just Inches then 25.4 else 1)

-- | Value in picometres of a number, in the units of the state.
picometresOf :: ModalState -> GcodeNumber -> Int
picometresOf m k = case valueOf (units m) of
  Just Inches -> scaled 8 k * 254
  _ -> scaled 8 k * 10

-- | Value in mm of a count of picometres.
picometres :: Int -> Double
picometres n = fromIntegral n / 1.0e9
