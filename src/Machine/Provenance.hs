-- | How each value of a description is known: by the mark on its line, on the block around it, or
-- on the line of the machine.
module Machine.Provenance
  ( facts,
    unmarked,
  )
where

import Base.Region (Located (..))
import Control.Applicative ((<|>))
import Data.Maybe (isJust, isNothing)
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.Error (Error (..))
import Machine.Machine (DescribedValue (..), Provenance)
import Machine.Syntax

-- | A fact for every line that says something: the sections around it and the line as it is
-- written; behind it, where it is printed.
facts :: Text -> Maybe (Located Note) -> [Statement] -> [DescribedValue]
facts text whole = concatMap (walk [] (markOf =<< whole))
  where
    walk path above s =
      [DescribedValue m (line path s) | saysSomething s, Just m <- [mark]]
        <> concatMap (walk (path <> [written text (told s)]) mark) (inner s)
      where
        mark = (note s >>= markOf) <|> above
    line path s =
      Text.intercalate ": " (path <> [written text (told s)])
        <> maybe "" (" — " <>) (note s >>= place)
    place (Located _ (Note _ where')) = where'

markOf :: Located Note -> Maybe Provenance
markOf (Located _ (Note m _)) = Just m

-- | The sections with lines that say something, and nothing says how it is known: the first of
-- them, and how many more.
unmarked :: Maybe (Located Note) -> [Statement] -> [Error]
unmarked whole sections = case whole of
  Just _ -> []
  Nothing -> [Unmarked first (length more) | s <- sections, first : more <- [walk s]]
  where
    walk s
      | isJust (note s) || broken s = []
      | otherwise = [told s | saysSomething s] <> concatMap walk (inner s)

-- | A heading says nothing by itself; but that of a word says what stands at this place of a frame.
saysSomething :: Statement -> Bool
saysSomething s =
  isNothing (block s) || keyWord s `elem` [Just "word", Just "set"] || isJust (note s)

inner :: Statement -> [Statement]
inner s = concat (block s)
