-- | The provenance of each value of a description: how the value is known. A mark says the
-- provenance: @sourced@, @corrected@ or @reconstructed@. It is written on the line of a value, on
-- the line that opens a block around the value, or on the line of the machine. If several marks
-- apply to a value, the innermost one gives its provenance.
module Machine.Provenance
  ( describedValues,
    unmarked,
  )
where

import Base.Region (Located (..), Region (end))
import Control.Applicative ((<|>))
import Data.Maybe (isJust, isNothing)
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.Error (Error (..))
import Machine.Machine (DescribedValue (..), Provenance)
import Machine.Syntax

-- | Lists the values of a description with their provenance, one for each line that describes a
-- value and has a provenance. Each value is given as a text. The text consists of the lines that
-- open the blocks around the line, the line itself, and the text of the line's mark. The arguments
-- are the text of the description, the mark on the line of the machine, and the statements.
describedValues :: Text -> Maybe (Located Mark) -> [Statement] -> [DescribedValue]
describedValues text ofMachine = concatMap (valuesIn [] (provenanceOf =<< ofMachine))
  where
    valuesIn path outer s =
      [DescribedValue p (sentence path s) | isDescriptive s, Just p <- [provenance]]
        <> concatMap (valuesIn (path <> [sourceText text (extent s)]) provenance) (inner s)
      where
        provenance = (mark s >>= provenanceOf) <|> outer
    sentence path s =
      Text.intercalate ": " (path <> [sourceText text (extent s)])
        <> maybe "" (" — " <>) (mark s >>= printedAt)
    printedAt (Located _ (Mark _ location)) = location

provenanceOf :: Located Mark -> Maybe Provenance
provenanceOf (Located _ (Mark p _)) = Just p

-- | Reports the first line without provenance in each section, with the count of further such
-- lines in the section. No report is made if @ofMachine@, the mark of the machine, is given.
unmarked :: Maybe (Located Mark) -> [Statement] -> [Error]
unmarked ofMachine sections = case ofMachine of
  Just _ -> []
  Nothing ->
    [ Unmarked (extent first) (length more) (map (end . extent) found)
      | s <- sections,
        found@(first : more) <- [unmarkedLines s]
    ]
  where
    unmarkedLines s
      | isJust (mark s) || broken s = []
      | otherwise = [s | isDescriptive s] <> concatMap unmarkedLines (inner s)

-- | True if the line itself describes a value. Every line without a block does. A line with a
-- block does so in three cases only:
--
-- * its key is @word@: its position among the lines gives the position of the word in the frame;
-- * its key is @set@: it gives the number of a command;
-- * it has a mark.
isDescriptive :: Statement -> Bool
isDescriptive s =
  isNothing (block s) || keyWord s `elem` [Just "word", Just "set"] || isJust (mark s)

inner :: Statement -> [Statement]
inner s = concat (block s)
