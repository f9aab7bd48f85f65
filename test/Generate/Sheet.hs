-- | Random input sheets.
module Generate.Sheet
  ( sheet,
    cut,
    number,
  )
where

import Base.Region (Located (..), Region (..))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Sheet.Sheet
import Test.QuickCheck hiding (tolerance)

-- | An input sheet with arbitrary curves, as its reader could give it, except that all its regions
-- are equal.
sheet :: Gen Sheet
sheet = do
  general <- generalData
  approach <- waypoints (0, 3)
  linking <- choose (0, 3) >>= \k -> vectorOf k (waypoints (0, 2))
  before <- traverse array linking
  final <- waypoints (0, 2) >>= array . stopped
  pure $ case before <> [final] of
    [] -> Sheet {general, approach, first = final, others = []}
    a : as -> Sheet {general, approach, first = a, others = as}
  where
    stopped ps = NonEmpty.fromList (NonEmpty.init ps <> [(NonEmpty.last ps) {feed = here 0}])

-- | An input sheet that can be milled. The cutter's centre moves on the pieces themselves. The
-- pieces are nearly straight, far from one another, and shifted by small distances.
cut :: Gen Sheet
cut = do
  s <- sheet
  count <- choose (1, 3 :: Int)
  alone <- traverse gentle [1 .. count]
  ways <- vectorOf (count - 1) (onePoint 60)
  let arraysOf =
        zipWith
          (\p w -> Array {joined = [], final = p, retract = w :| []})
          alone
          (ways <> [(plain 900 900) {feed = here 0}])
  pure $ case arraysOf of
    [] -> s
    a : as ->
      s
        { general =
            (general s)
              { gear = here 0,
                bevel = here 0,
                height = here 0,
                diameter = here 6,
                tolerance = here 0.05,
                side = here Nothing
              },
          approach = plain (-300) 0 :| [],
          first = a,
          others = as
        }
  where
    plain a b = Waypoint {x = here a, y = here b, z = here 0, feed = here 60}
    onePoint f = (\a b -> (plain a b) {feed = here f}) <$> choose (-500, 500) <*> choose (-500, 500)

-- | A nearly straight piece, in the strip of the drawing that has the given number.
gentle :: Int -> Gen Piece
gentle strip = do
  digits <- resize 3 (listOf (elements [minBound .. maxBound]))
  n <- choose (2, 8)
  rows <-
    NonEmpty.fromList
      <$> traverse
        (\k -> row (Four `elem` digits) (fromIntegral k * 40) (fromIntegral strip * 120))
        [0 .. n - 1 :: Int]
  side <- elements [minBound .. maxBound]
  cipher <- traverse (recalculation n (choose (0, 3))) digits
  slow <- arbitrary
  ownFeed <- frequency [(3, pure Nothing), (1, Just . here . fromInteger <$> choose (5, 200))]
  pure
    Piece
      { shiftSide = here (if null cipher then LeftSide else side),
        cipher = here cipher,
        rows,
        slow = here slow,
        allowance = here 0,
        ownFeed
      }
  where
    row steep px py = do
      dx <- choose (0, 5)
      dy <- choose (0, 5)
      mu <- choose (-4, 4)
      h <- choose (5, 20)
      pure
        PointRow
          { px = here (rounded (px + dx)),
            py = here (rounded (py + dy)),
            surface =
              if steep
                then Just Surface {mu = here (rounded mu), flangeHeight = here (rounded h)}
                else Nothing
          }
    rounded v = fromIntegral (round (v * 100 :: Double) :: Int) / 100

here :: a -> Located a
here = Located (Region 0 0)

-- | A number of an input sheet.
number :: Gen Double
number =
  oneof
    [ fromIntegral <$> choose (-500, 500 :: Int),
      (/ 100) . fromIntegral <$> choose (-50000, 50000 :: Int),
      choose (-1000, 1000)
    ]

above :: Gen Double
above = (abs <$> number) `suchThat` (> 0)

generalData :: Gen General
generalData = do
  productCipher <- whole
  partCipher <- whole
  program <- whole
  diameter <- here <$> above
  (gear, bevel, height) <- oneof [pure (0, 0, 0), (,0,0) <$> above, (0,,) <$> above <*> above]
  tolerance <- here <$> above
  side <- here <$> elements [Nothing, Just LeftSide, Just RightSide]
  pure
    General
      { productCipher,
        partCipher,
        program,
        diameter,
        gear = here gear,
        bevel = here bevel,
        height = here height,
        tolerance,
        side
      }
  where
    whole = here . fromIntegral <$> choose (0, 999999999 :: Int)

-- | Waypoints. The pair has the least and the largest count of points before the last one. The feed
-- of the last point applies to the pieces after it, so it is not the rapid feed.
waypoints :: (Int, Int) -> Gen (NonEmpty Waypoint)
waypoints range = do
  before <-
    choose range >>= \k ->
      vectorOf k (waypoint (frequency [(2, above), (1, pure rapidFeed)]))
  final <- waypoint (above `suchThat` (/= rapidFeed))
  pure (NonEmpty.fromList (before <> [final]))
  where
    waypoint f =
      Waypoint <$> coordinate <*> coordinate <*> (here <$> oneof [pure 0, number]) <*> (here <$> f)

coordinate :: Gen Number
coordinate = here <$> number

array :: NonEmpty Waypoint -> Gen Array
array retract = do
  count <- choose (0, 3 :: Int)
  joined <- vectorOf count (LinkedPiece <$> piece <*> (here <$> link))
  final <- piece
  pure Array {joined, final, retract}

link :: Gen Link
link = oneof [pure Joint, pure Intersection, Rounding <$> (number `suchThat` (/= 0))]

piece :: Gen Piece
piece = do
  digits <- resize 4 (listOf (elements [minBound .. maxBound]))
  n <- choose (2, 6)
  rows <- NonEmpty.fromList <$> vectorOf n (row (Four `elem` digits))
  side <- elements [minBound .. maxBound]
  cipher <- normal <$> traverse (recalculation n number) digits
  slow <- arbitrary
  allowance <- oneof [pure (here 0), coordinate]
  ownFeed <- frequency [(3, pure Nothing), (1, Just . here <$> choose (0.5, 9998))]
  pure
    Piece
      { shiftSide = here (if null cipher then LeftSide else side),
        cipher = here cipher,
        rows,
        slow = here slow,
        allowance,
        ownFeed
      }
  where
    row steep =
      PointRow <$> coordinate <*> coordinate
        <*> if steep
          then Just <$> (Surface <$> coordinate <*> coordinate)
          else pure Nothing
    -- The sign of the first constant or growing distance only says the side, so it is positive.
    normal list = case break isGiven list of
      (before, Growing a b : rest) -> before <> (Growing (fmap abs a) b : rest)
      (before, Constant a : rest) -> before <> (Constant (fmap abs a) : rest)
      _ -> list
    isGiven r = case r of
      Growing _ _ -> True
      Constant _ -> True
      Bevelled -> False
      Pointwise _ -> False

-- | The recalculation with a digit, for a piece of @n@ points. The generator gives its distances.
recalculation :: Int -> Gen Double -> Digit -> Gen Recalculation
recalculation n size digit = case digit of
  One -> Growing <$> one <*> one
  Two -> Constant <$> one
  Four -> pure Bevelled
  Six -> Pointwise . NonEmpty.fromList <$> vectorOf n one
  where
    one = here <$> size
