-- | The provenance of each value of a description: how the value is known. A mark says the
-- provenance: @sourced@, @corrected@ or @reconstructed@. It is written on the line of a value, on
-- the line that opens a block around the value, or on the line of the machine. The innermost mark
-- is valid.
module Machine.Provenance
  ( describedValues,
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

-- | Lists the values of a description, one for each line that describes a value and has a
-- provenance. Each value is a sentence: the lines that open the blocks around the line, the line
-- itself, and the text of its mark, which says where the source prints the value. The arguments are
-- the text of the description, the mark of the machine and the statements.
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

-- | Reports the first line without provenance in each section, with the count of further such lines
-- in the section. No report is made if @ofMachine@, the mark of the machine, is given.
unmarked :: Maybe (Located Mark) -> [Statement] -> [Error]
unmarked ofMachine sections = case ofMachine of
  Just _ -> []
  Nothing ->
    [Unmarked first (length more) | s <- sections, first : more <- [unmarkedLines s]]
  where
    unmarkedLines s
      | isJust (mark s) || broken s = []
      | otherwise = [extent s | isDescriptive s] <> concatMap unmarkedLines (inner s)

-- | True if the line itself describes a value. A line with a block does not, with three exceptions.
-- They are a word of the frame, because its line says at which position the frame contains it; the
-- number of a command; and a line with a mark.
isDescriptive :: Statement -> Bool
isDescriptive s =
  isNothing (block s) || keyWord s `elem` [Just "word", Just "set"] || isJust (mark s)

inner :: Statement -> [Statement]
inner s = concat (block s)
