-- | The parts of a drawing as a reader finds them, and the drawing that they make.
module Drawing.Assembly
  ( DrawingPart (..),
    partOf,
    assembled,
  )
where

import Data.List.NonEmpty (NonEmpty (..))
import Data.Set qualified as Set
import Drawing.Drawing (Drawing (Drawing), Entity (..), Remark (..), RemarkKind (..))
import Drawing.Drawing qualified as Drawing
import Drawing.Error (DrawingFault (..), Error (Error))
import Drawing.ShapeCheck (Judgement (..))
import Drawing.ShapeCheck qualified as ShapeCheck
import Drawing.Tolerance qualified as Tolerance

-- | A part of a drawing.
data DrawingPart
  = Drawn Entity
  | Remarked Remark
  | Wrong Error
  | -- | an element that was visited, with its line
    Visited Int

-- | The part that an entity in mm becomes: itself, a remark that it is no curve, or an error.
partOf :: Entity -> DrawingPart
partOf entity@Entity {line, word, layer, identifiers, classes, shape} =
  case ShapeCheck.judge shape of
    Usable usable -> Drawn entity {shape = usable}
    Degenerate reason ->
      Remarked
        Remark
          { remarkLine = line,
            remarkKind = Unusable word reason,
            remarkLayer = layer,
            remarkIdentifiers = identifiers,
            remarkClasses = classes
          }
    TooFar -> Wrong (Error line (OutOfReach word))

-- | The drawing of its parts, or their errors up to a limit. A remark or an error of an entity that
-- is inserted several times is given once. An error if there are more parts than the limit; the
-- list may be longer than memory.
assembled :: [DrawingPart] -> Either (NonEmpty Error) Drawing
assembled = go Tolerance.mostParts [] Set.empty []
  where
    go left drawn remarks errors parts = case parts of
      [] -> case reverse errors of
        e : es -> Left (e :| take (Tolerance.mostErrors - 1) es)
        [] ->
          Right
            Drawing
              { Drawing.entities = reverse drawn,
                Drawing.remarks = Set.toAscList remarks,
                Drawing.presumed = Nothing
              }
      part : rest
        | left < 0 -> Left (pure (Error (lineOf part) TooManyParts))
        | length errors >= Tolerance.mostErrors -> go left drawn remarks errors []
        | otherwise -> case part of
          Drawn e -> go (left - ShapeCheck.size (shape e)) (e : drawn) remarks errors rest
          Remarked r -> go (left - 1) drawn (Set.insert r remarks) errors rest
          Wrong e | e `elem` errors -> go (left - 1) drawn remarks errors rest
          Wrong e -> go (left - 1) drawn remarks (e : errors) rest
          Visited _ -> go (left - 1) drawn remarks errors rest
    lineOf part = case part of
      Drawn Entity {line} -> line
      Remarked Remark {remarkLine} -> remarkLine
      Wrong (Error line _) -> line
      Visited line -> line
