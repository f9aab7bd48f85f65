-- | The choice of one of several answers to a construction: near a point, on a side of a line,
-- inside or outside a circle, first or last along a line or a curve.
--
-- A choice does not refer to the directions of the x and y axes. It therefore selects the same
-- answer after the drawing is moved and rotated.
module Part.Selection
  ( Answers (..),
    answerPoints,
    picked,
  )
where

import Base.Crash (bug)
import Base.Quantity (Mm (..))
import Base.Region (Region)
import Checked.Syntax (Rank (..), Selector (..))
import Data.List (sortOn)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Carrier (Circle (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.ConstructionError (ConstructionFault (..), NoAnswer (..), Sought (..))
import Part.Error (ValueFact (..))
import Part.ErrorText (Candidate (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Value (Argument (..), Value (..), fromOrigin)

-- | The answers to a construction, and the functions that measure them for a choice.
data Answers a = Answers
  { sought :: Sought,
    -- | the form of an answer in a report
    candidate :: a -> Candidate,
    -- | the point of an answer, by which distances and sides are measured
    keyPoint :: a -> Point,
    -- | one function for each line or curve of the construction: the position of an answer along
    -- it, in mm. The first function decides which answer is @first@ and which is @last@
    stations :: [a -> Mm],
    -- | answers are equally near to a point if their distances from it differ by at most this
    tie :: Mm,
    answers :: [a]
  }

-- | Answers that are points. @tie@ is the largest difference of distances that count as equal. The
-- functions @stations@ give the position of a point along each line or curve of the construction.
answerPoints :: Mm -> [Point -> Mm] -> [Point] -> Answers Point
answerPoints tie stations answers =
  Answers {sought = SoughtPoint, candidate = APoint, keyPoint = id, stations, tie, answers}

-- | The answer that the words in @choice@ select, such as @near@ with a point. Fails unless exactly
-- one answer fits. Without a choice there must be only one answer.
picked :: Region -> Answers a -> [Argument] -> Eval a
picked region Answers {sought, candidate, keyPoint, stations, tie = Mm tie, answers} choice =
  case (answers, choice) of
    ([], _) -> fault (NoAnswer region (NothingTouches sought))
    ([one], []) -> pure one
    (_, []) -> fault (Several region sought candidates)
    (_, Choosing Near (Spatial p) : _) -> nearest (fromOrigin p)
    (_, Choosing ToLeft (LineValue l) : _) -> only (\a -> leftOf l a > tolerance)
    (_, Choosing ToRight (LineValue l) : _) -> only (\a -> leftOf l a < -tolerance)
    (_, Choosing ToInside (CircleValue c) : _) -> only (\a -> depth c a > tolerance)
    (_, Choosing ToOutside (CircleValue c) : _) -> only (\a -> depth c a < -tolerance)
    (_, Ranking rank : _)
      | station : _ <- stations -> pure (ranked rank (NonEmpty.fromList (sortOn station answers)))
    _ -> bug "a choice of another kind"
  where
    fault = Evaluation.mistake . InConstruction
    candidates = map candidate answers
    only fits = case filter fits answers of
      [one] -> pure one
      [] -> fault (NoneFits region sought candidates)
      fitting -> fault (SeveralFit region sought (map candidate fitting))
    nearest p = case sortOn (distance p) answers of
      a : b : _
        | abs (distance p a - distance p b) <= tie -> fault (SeveralFit region sought candidates)
      a : _ -> pure a
      [] -> fault (NoneFits region sought candidates)
    distance p a = let Mm d = Vec.distance p (keyPoint a) in d
    Mm tolerance = Tolerance.coincident
    leftOf l a = let Mm d = Carrier.signedDistance l (keyPoint a) in d
    depth (Circle c (Mm r)) a = let Mm d = Vec.distance c (keyPoint a) in r - d
    ranked rank as = case rank of
      First -> NonEmpty.head as
      Last -> NonEmpty.last as
