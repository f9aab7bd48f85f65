-- | The unit of a file: the unit of the lengths and feeds that it writes without a unit.
--
-- The statement @units@ gives it, at the beginning of the file. Without this statement the unit is
-- the millimetre. An imported file has a unit of its own.
module Surface.FileUnit
  ( program,
    ofProgram,
    unitAt,
    isGivenAt,
    withUnit,
    misplaced,
  )
where

import Base.Quantity (LengthUnit (..))
import Base.Region (Located (..), Region (..))
import Data.List (find)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, isJust, listToMaybe)
import Data.Text (Text)
import Surface.Error (Error (UnitsMisplaced))
import Surface.Syntax
import Surface.SyntaxWalk qualified as SyntaxWalk

-- | The program that consists of one file. @begin@ is the offset of its first character.
program :: Int -> [Statement] -> [Located Text] -> Program
program begin written remarks =
  Program {statements = written, comments = remarks, units = Map.singleton begin given}
  where
    given = listToMaybe [unit | Located _ (Units unit) <- written]

-- | The unit of the program's own file.
ofProgram :: Program -> LengthUnit
ofProgram p = unitAt p (Region 0 0)

-- | The unit of the file that contains a region.
unitAt :: Program -> Region -> LengthUnit
unitAt Program {units}
  | all (== Millimetres) (Map.map (fromMaybe Millimetres) units) = const Millimetres
  | otherwise = \at -> fromMaybe Millimetres (Map.lookupLE (start at) units >>= snd)

-- | Tells if the file that contains a region gives its unit by a @units@ statement.
isGivenAt :: Program -> Region -> Bool
isGivenAt Program {units} at = isJust (Map.lookupLE (start at) units >>= snd)

-- | The program in which numbers at the region @at@ have the unit @unit@, whatever the unit of the
-- file around it.
withUnit :: LengthUnit -> Region -> Program -> Program
withUnit unit at p =
  p {units = Map.insert (start at) (Just unit) (Map.insert (end at) (Just before) (units p))}
  where
    before = unitAt p at

-- | The mistakes of @units@ statements that do not stand at the beginning of their file, where only
-- @part@ may stand above them. @written@ are the statements of one file.
misplaced :: [Statement] -> [Error]
misplaced written =
  [ UnitsMisplaced at (find (/= at) (take 1 found)) place
    | at <- found,
      Just at /= fmap region (listToMaybe below)
  ]
  where
    found = [at | Located at (Units _) <- concatMap SyntaxWalk.statementsIn written]
    below = dropWhile isBefore written
    -- A broken statement may be the one with the name of the part.
    isBefore (Located _ s) = case s of
      Part _ _ -> True
      Broken _ _ -> True
      _ -> False
    place = maybe 0 (start . region) (listToMaybe below)
