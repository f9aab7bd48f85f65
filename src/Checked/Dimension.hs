-- | Dimensions of quantities: products of powers of length, angle, time and unknowns. An unknown is
-- a dimension that type inference has yet to find; it is identified by a number.
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

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit (..), millimetresIn)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Prelude hiding (exponent)

-- | A factor from which dimensions are made. 'PointWeight' distinguishes points from vectors, which
-- both are pairs of lengths. Its exponent is 1 for a point and 0 for a vector. A sum adds the
-- exponents and a difference subtracts them, so the difference of two points is a vector.
data Atom = Length | Angle | Time | PointWeight | Unknown Int
  deriving stock (Eq, Ord, Show)

-- | A product of powers of atoms. The map holds the exponents that are not 0.
newtype Dimension = Dimension (Map Atom Int)
  deriving newtype (Eq)
  deriving stock (Show)

-- | The dimension of a plain number: all exponents are 0.
none :: Dimension
none = Dimension Map.empty

-- | The dimension that is the first power of an atom.
atom :: Atom -> Dimension
atom a = Dimension (Map.singleton a 1)

-- | The product of two dimensions.
times :: Dimension -> Dimension -> Dimension
times (Dimension a) (Dimension b) = Dimension (Map.filter (/= 0) (Map.unionWith (+) a b))

-- | The power of a dimension with the integer exponent @n@.
power :: Int -> Dimension -> Dimension
power n (Dimension a) = if n == 0 then none else Dimension (fmap (n *) a)

exponent :: Atom -> Dimension -> Int
exponent a (Dimension m) = Map.findWithDefault 0 a m

-- | The numbers of the unknowns that a dimension contains.
unknowns :: Dimension -> [Int]
unknowns (Dimension m) = [n | Unknown n <- Map.keys m]

-- | Does a dimension contain no unknowns?
isKnown :: Dimension -> Bool
isKnown = null . unknowns

-- | True if a dimension contains unknowns and all its exponents are even. It is then a square for
-- all values of the unknowns.
isUnknownSquare :: Dimension -> Bool
isUnknownSquare d@(Dimension m) = not (isKnown d) && all even (Map.elems m)

-- | The result of 'solve', which makes one step towards the solution of an equation: the equation
-- holds already, or it has no solution, or an unknown is replaced.
data UnificationStep
  = Solved
  | Impossible
  | -- | an unknown, by its number, is equal to a dimension. If that dimension contains the unknown
    -- @fresh@ of 'solve', further steps are needed
    Replace Int Dimension

-- | Makes one step towards the solution of an equation. The equation says that a dimension is equal
-- to 'none'. @fresh@ is the number of an unknown that does not occur anywhere yet.
--
-- The step replaces the unknown whose exponent @e@ has the smallest absolute value. Its value is
-- the product of the other factors; a factor with the exponent @k@ gets the exponent @-k/e@. If @e@
-- does not divide every @k@, the quotients @k/e@ are rounded down, and the value has the unknown
-- @fresh@ as a further factor. The equation for @fresh@ then has the remainders as exponents.
-- Further steps solve it.
solve :: Int -> Dimension -> UnificationStep
solve fresh (Dimension m) = case pivot of
  Nothing -> if Map.null m then Solved else Impossible
  Just (n, e)
    | all (\k -> k `mod` e == 0) (Map.elems m) -> Replace n (rest n (\k -> negate (k `div` e)))
    | length (unknowns (Dimension m)) == 1 -> Impossible
    | otherwise -> Replace n (times (atom (Unknown fresh)) (rest n (\k -> negate (k `div` e))))
  where
    -- The number and the exponent of the unknown whose exponent has the smallest absolute value. Of
    -- several such unknowns, the one with the largest number is taken.
    pivot = case [(abs e, negate n, e, n) | (Unknown n, e) <- Map.toList m] of
      [] -> Nothing
      candidates -> let (_, _, e, n) = minimum candidates in Just (n, e)
    rest n f = Dimension (Map.filter (/= 0) (fmap f (Map.delete (Unknown n) m)))

-- | Replaces the unknown with the number @n@ by the dimension @d@, within the dimension @whole@.
substitute :: Int -> Dimension -> Dimension -> Dimension
substitute n d whole@(Dimension m) = case Map.lookup (Unknown n) m of
  Nothing -> whole
  Just e -> times (power e d) (Dimension (Map.delete (Unknown n) m))

-- | The description of a dimension in the words of a drawing, such as "a length".
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
  | otherwise = "a quantity in " <> unitWord Millimetres d
  where
    known = Map.filterWithKey (\a _ -> case a of Unknown _ -> False; _ -> True) m

-- | The unit of a dimension as reports write it: @mm@, @deg@, @mm^2@, @mm/min@, with the given unit
-- of lengths. Unknowns are left out. The text is empty for a plain number.
unitWord :: LengthUnit -> Dimension -> Text
unitWord unit (Dimension m) = case (factors (> 0), factors (< 0)) of
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
      Length -> Decimal.unitText unit
      Angle -> "deg"
      Time -> "min"
      PointWeight -> "point"
      Unknown _ -> ""

-- | The factor for a number of dimension @d@ that a file writes without a unit. Such a number is
-- written in the unit of the file, in minutes and degrees. The factor converts it to mm, minutes
-- and radians. An unknown counts as a plain number: where inference leaves it open which factor of
-- a product has the dimension of a length, the product is the same in each case.
defaultUnit :: LengthUnit -> Dimension -> Double
defaultUnit unit d = raised Length (millimetresIn unit) * raised Angle (pi / 180)
  where
    raised a factor = case exponent a d of
      0 -> 1
      n -> factor ^^ n
