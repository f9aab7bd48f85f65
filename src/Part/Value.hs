-- | What a name can stand for, and what the functions of the language have in common.
module Part.Value
  ( Value (..),
    Argument (..),
    spatial,
    lifted,
    within,
    finite,
    place,
    offset,
    whole,
    picked,
  )
where

import Base.Crash (bug)
import Base.Quantity (Mm (..))
import Base.Region (Region)
import Checked.Syntax (Rank (..), Selector (..))
import Data.List (sortOn)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Vector (Vector)
import Geometry.Carrier (Circle (..), Line (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Tolerance qualified as Tolerance
import Geometry.Transformation (Transformation)
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Part.Curve (PartCurve, PartTable)
import Part.Error (Candidate (..), ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Part (Contour)

-- | What a name can stand for. Numbers are in mm, radians, minutes and turns.
data Value
  = Quantity Double
  | -- | a point or a vector
    Spatial Vec
  | -- | a point with a height
    SpaceValue Point Mm
  | TruthValue Bool
  | CircleValue Circle
  | LineValue Line
  | ContourValue Contour
  | ListValue (Vector Value)
  | PlacementValue Transformation
  | TableValue PartTable
  | CurveValue PartCurve
  deriving stock (Eq, Show)

-- | An argument with the word before it.
data Argument = Plain Value | Choosing Selector Value | Ranking Rank
  deriving stock (Eq, Show)

-- | A point or vector that a machine reaches.
spatial :: Region -> Vec -> Eval Value
spatial region v = Spatial v <$ within region (Vec.norm v)

-- | A point with a height that a machine reaches.
lifted :: Region -> Point -> Mm -> Eval Value
lifted region p z@(Mm h) =
  SpaceValue p z <$ (within region (Vec.norm (offset p)) *> within region h)

-- | A length that a machine reaches.
within :: Region -> Double -> Eval ()
within region x
  | abs x <= limit = pure ()
  | otherwise = Evaluation.mistake (OutOfReach region Tolerance.reach)
  where
    Mm limit = Tolerance.reach

-- | A number that can be held.
finite :: Region -> Double -> Eval Value
finite region x
  | isNaN x || isInfinite x = Evaluation.mistake (TooLarge region)
  | otherwise = pure (Quantity x)

-- | The place that a vector from (0, 0) reaches.
place :: Vec -> Point
place v = Vec.shift v (Vec.point 0 0)

offset :: Point -> Vec
offset = Vec.to (Vec.point 0 0)

-- | A whole number from 1 upwards.
whole :: Region -> Text -> Double -> Eval Int
whole region what x
  | abs (x - fromIntegral n) > Tolerance.equal || n < 1 || x > 1e7 =
    Evaluation.mistake (NotWhole region what "from 1 to 10000000" x)
  | otherwise = pure n
  where
    n = if abs x > 1e8 then 0 else round x :: Int

-- | The one answer that is meant. Distances that differ by no more than the length given are a tie.
-- The function tells the point by which an answer is chosen; the ways tell how far along something
-- an answer lies, so that there is a first and a last.
picked ::
  Mm ->
  Region ->
  Text ->
  (a -> Candidate) ->
  (a -> Point) ->
  [a -> Mm] ->
  [a] ->
  [Argument] ->
  Eval a
picked (Mm tie) region what candidate key ways found choice = case (found, choice) of
  ([], _) ->
    Evaluation.mistake
      ( NoAnswer
          region
          what
          ( "No "
              <> what
              <> " of this size touches both things on these sides, or goes through them."
          )
      )
  ([one], []) -> pure one
  (_, []) -> Evaluation.mistake (Several region what all')
  (_, Choosing Near (Spatial p) : _) -> case sortOn (Vec.distance (place p) . key) found of
    a : b : _
      | near (Vec.distance (place p) (key a)) (Vec.distance (place p) (key b)) ->
        Evaluation.mistake (SeveralFit region what all')
    a : _ -> pure a
    [] -> only []
  (_, Choosing ToLeft (LineValue l) : _) -> only (filter (\a -> sideOf l a > tolerance) found)
  (_, Choosing ToRight (LineValue l) : _) -> only (filter (\a -> sideOf l a < -tolerance) found)
  (_, Choosing Within' (CircleValue c) : _) -> only (filter (\a -> depth c a > tolerance) found)
  (_, Choosing Beyond (CircleValue c) : _) -> only (filter (\a -> depth c a < -tolerance) found)
  (_, Ranking rank : _)
    | along : _ <- ways ->
      pure (ranked rank (NonEmpty.fromList (sortOn along found)))
  _ -> bug "a choice of another kind"
  where
    all' = map candidate found
    only fitting = case fitting of
      [one] -> pure one
      [] -> Evaluation.mistake (NoneFits region what all')
      _ -> Evaluation.mistake (SeveralFit region what (map candidate fitting))
    Mm tolerance = Tolerance.coincident
    near (Mm a) (Mm b) = abs (a - b) <= tie
    sideOf l a = let Mm d = Carrier.signedDistance l (key a) in d
    depth (Circle c (Mm r)) a = let Mm d = Vec.distance c (key a) in r - d
    ranked rank as = case rank of
      First -> NonEmpty.head as
      Last -> NonEmpty.last as
