-- | Dimensions: products of powers of length, angle and time, possibly with unknowns,
-- and the solving of equations between them.
--
-- The dimensions form a commutative group, so an equation is solved as a linear one
-- over the whole numbers (Kennedy's unification of units of measure).
module Checked.Dimension
  ( Dimension,
    Atom (..),
    none,
    atom,
    times,
    power,
    unknowns,
    UnificationStep (..),
    solve,
    substitute,
    describe,
    unitWord,
    defaultUnit,
    isKnown,
    isUnknownSquare,
  )
where

import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Prelude hiding (exponent)

-- | What dimensions are made of. 'PointWeight' counts how far a pair is a point rather than a vector:
-- the difference of two points (1 each) is a vector (0).
data Atom = Length | Angle | Time | PointWeight | Unknown Int
  deriving stock (Eq, Ord, Show)

-- | The exponents that are not zero.
newtype Dimension = Dimension (Map Atom Int)
  deriving newtype (Eq)
  deriving stock (Show)

-- | The dimension of a plain number.
none :: Dimension
none = Dimension Map.empty

atom :: Atom -> Dimension
atom a = Dimension (Map.singleton a 1)

times :: Dimension -> Dimension -> Dimension
times (Dimension a) (Dimension b) = Dimension (Map.filter (/= 0) (Map.unionWith (+) a b))

power :: Int -> Dimension -> Dimension
power n (Dimension a) = if n == 0 then none else Dimension (fmap (n *) a)

exponent :: Atom -> Dimension -> Int
exponent a (Dimension m) = Map.findWithDefault 0 a m

unknowns :: Dimension -> [Int]
unknowns (Dimension m) = [n | Unknown n <- Map.keys m]

isKnown :: Dimension -> Bool
isKnown = null . unknowns

-- | Whether it is known only that the dimension is a square.
isUnknownSquare :: Dimension -> Bool
isUnknownSquare d@(Dimension m) = not (isKnown d) && all even (Map.elems m)

-- | How an equation is solved: done, impossible, or one unknown replaced and the rest to be solved.
data UnificationStep
  = Solved
  | Impossible
  | -- | an unknown and what it is
    Replace Int Dimension

-- | One step towards making a dimension equal to 'none'; the number is a fresh unknown.
solve :: Int -> Dimension -> UnificationStep
solve fresh (Dimension m) = case pivot of
  Nothing -> if Map.null m then Solved else Impossible
  Just (n, e)
    | all (\k -> k `mod` e == 0) (Map.elems m) -> Replace n (rest n (\k -> negate (k `div` e)))
    | length (unknowns (Dimension m)) == 1 -> Impossible
    | otherwise -> Replace n (times (atom (Unknown fresh)) (rest n (\k -> negate (k `div` e))))
  where
    -- The unknown with the smallest exponent; of equal ones the youngest.
    pivot = case [(abs e, negate n, e, n) | (Unknown n, e) <- Map.toList m] of
      [] -> Nothing
      candidates -> let (_, _, e, n) = minimum candidates in Just (n, e)
    rest n f = Dimension (Map.filter (/= 0) (fmap f (Map.delete (Unknown n) m)))

-- | Put a dimension in an unknown's place.
substitute :: Int -> Dimension -> Dimension -> Dimension
substitute n d whole@(Dimension m) = case Map.lookup (Unknown n) m of
  Nothing -> whole
  Just e -> times (power e d) (Dimension (Map.delete (Unknown n) m))

-- | In the words of a drawing, with its article.
describe :: Dimension -> Text
describe d@(Dimension m)
  | d == none = "a number"
  | d == atom Length = "a length"
  | d == atom Angle = "an angle"
  | d == times (atom Length) (power (-1) (atom Time)) = "a feed"
  | d == power 2 (atom Length) = "an area"
  | d == atom Time = "a time"
  | d == power (-1) (atom Time) = "a speed of rotation"
  | isUnknownSquare d = "an area or another square"
  | Map.null known = "a quantity"
  | otherwise = "a quantity in " <> unitWord d
  where
    known = Map.filterWithKey (\a _ -> case a of Unknown _ -> False; _ -> True) m

-- | The default unit of a dimension: @mm@, @deg@, @mm^2@, @mm/min@.
unitWord :: Dimension -> Text
unitWord (Dimension m) = case (factors (> 0), factors (< 0)) of
  ([], []) -> ""
  (up, []) -> Text.intercalate "·" up
  (up, down) ->
    (if null up then "1" else Text.intercalate "·" up) <> "/" <> Text.intercalate "/" down
  where
    factors keep = [name a <> raised (abs e) | (a, e) <- Map.toList m, keep e, known a]
    raised e = if e == 1 then "" else "^" <> Text.pack (show e)
    known a = case a of
      Unknown _ -> False
      _ -> True
    name a = case a of
      Length -> "mm"
      Angle -> "deg"
      Time -> "min"
      PointWeight -> "point"
      Unknown _ -> ""

-- | The size of a bare number of a dimension: lengths in mm, times in minutes, angles in degrees.
defaultUnit :: Dimension -> Double
defaultUnit d = case exponent Angle d of
  0 -> 1
  n -> (pi / 180) ^^ n
