-- | Dimensions of quantities: products of powers of length, angle, time and unknowns.
--
-- Dimensions form a free commutative group. Equations between them are solved as linear equations
-- over the integers (Kennedy, Programming Languages and Dimensions, 1996).
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

-- | A generator of the group of dimensions. 'PointWeight' distinguishes points and vectors: a point
-- has weight 1, a vector 0, and the difference of two points is a vector.
data Atom = Length | Angle | Time | PointWeight | Unknown Int
  deriving stock (Eq, Ord, Show)

-- | A product of powers, by the exponents that are not zero.
newtype Dimension = Dimension (Map Atom Int)
  deriving newtype (Eq)
  deriving stock (Show)

-- | The dimension of a number that is not a quantity: all exponents are 0.
none :: Dimension
none = Dimension Map.empty

-- | The first power of an atom.
atom :: Atom -> Dimension
atom a = Dimension (Map.singleton a 1)

-- | The product of two dimensions.
times :: Dimension -> Dimension -> Dimension
times (Dimension a) (Dimension b) = Dimension (Map.filter (/= 0) (Map.unionWith (+) a b))

-- | An integer power of a dimension.
power :: Int -> Dimension -> Dimension
power n (Dimension a) = if n == 0 then none else Dimension (fmap (n *) a)

exponent :: Atom -> Dimension -> Int
exponent a (Dimension m) = Map.findWithDefault 0 a m

-- | The numbers of the unknowns in a dimension.
unknowns :: Dimension -> [Int]
unknowns (Dimension m) = [n | Unknown n <- Map.keys m]

-- | Tells if a dimension has no unknowns.
isKnown :: Dimension -> Bool
isKnown = null . unknowns

-- | Tells if a dimension contains unknowns and all its exponents are even.
isUnknownSquare :: Dimension -> Bool
isUnknownSquare d@(Dimension m) = not (isKnown d) && all even (Map.elems m)

-- | The result of one step towards the solution of an equation.
data UnificationStep
  = Solved
  | Impossible
  | -- | the number of an unknown and its value. If the value contains the fresh unknown, the
    -- equation is not solved yet
    Replace Int Dimension

-- | Makes one step towards the solution of the equation that a dimension is 'none'. @fresh@ is the
-- number of an unknown that is not used yet.
--
-- The unknown with the exponent of smallest absolute value is eliminated. If that exponent does not
-- divide the other ones, the quotients are rounded down and the fresh unknown represents the
-- remainders.
solve :: Int -> Dimension -> UnificationStep
solve fresh (Dimension m) = case pivot of
  Nothing -> if Map.null m then Solved else Impossible
  Just (n, e)
    | all (\k -> k `mod` e == 0) (Map.elems m) -> Replace n (rest n (\k -> negate (k `div` e)))
    | length (unknowns (Dimension m)) == 1 -> Impossible
    | otherwise -> Replace n (times (atom (Unknown fresh)) (rest n (\k -> negate (k `div` e))))
  where
    -- The unknown with the smallest exponent; of equal ones the newest.
    pivot = case [(abs e, negate n, e, n) | (Unknown n, e) <- Map.toList m] of
      [] -> Nothing
      candidates -> let (_, _, e, n) = minimum candidates in Just (n, e)
    rest n f = Dimension (Map.filter (/= 0) (fmap f (Map.delete (Unknown n) m)))

-- | Replaces the unknown of a number by a dimension within another dimension.
substitute :: Int -> Dimension -> Dimension -> Dimension
substitute n d whole@(Dimension m) = case Map.lookup (Unknown n) m of
  Nothing -> whole
  Just e -> times (power e d) (Dimension (Map.delete (Unknown n) m))

-- | Describes a dimension in the words of a drawing, with its article.
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

-- | The name of a dimension's default unit: @mm@, @deg@, @mm^2@, @mm/min@.
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

-- | The factor that turns a number without a unit into a quantity of a dimension. The number is in
-- mm, minutes and degrees, the quantity in mm, minutes and radians.
defaultUnit :: Dimension -> Double
defaultUnit d = case exponent Angle d of
  0 -> 1
  n -> (pi / 180) ^^ n
