-- | Search for fillets with which a contour has no fault, for reports on fillets that do not fit.
module Part.FilletSearch
  ( inPlaceOf,
    largest,
    turned,
  )
where

import Base.Quantity (Mm (..))
import Base.Region (Region)
import Data.Containers.ListUtils (nubOrd)
import Data.List (find)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe, mapMaybe)
import Geometry.Carrier (Sense (..))
import Geometry.Carrier qualified as Carrier
import Part.Link (Link (..))
import Part.LinkElement (LinkedElement (..))
import Part.LinkError (FittingFillets (FittingFillets))
import Part.Tolerance qualified as Tolerance

-- | Fillets that, with the other sense, leave the contour without a fault. @isMeant@ says of the
-- region of a fillet if it may be changed. Each of these fillets is first changed alone, and then
-- all fillets of the same radius and sense together. At most 'mostTurned' elements are looked at.
turned ::
  (NonEmpty LinkedElement -> Bool) ->
  NonEmpty LinkedElement ->
  (Region -> Bool) ->
  Maybe FittingFillets
turned fits linked isMeant =
  find isEnough (map alone given <> map together (take 1 given))
  where
    all' = filletsOf linked
    given = take mostTurned (filter (\(at, _, _) -> isMeant at) all')
    alone (at, sense, r) = FittingFillets [(at, Carrier.oppositeSense sense, r)]
    together (_, sense, r) =
      FittingFillets (nubOrd [(at, turnedSense, r) | (at, s, r') <- all', s == sense, r' == r])
      where
        turnedSense = Carrier.oppositeSense sense
    isEnough (FittingFillets changed) = fits (fmap (turn [at | (at, _, _) <- changed]) linked)
    turn chosen w = case link w of
      Just (at, Fillet sense r)
        | at `elem` chosen -> w {link = Just (at, Fillet (Carrier.oppositeSense sense) r)}
      _ -> w

-- | A fillet that, in place of the link in the given region, leaves the contour without a fault:
-- the largest of a few round radii that fits.
inPlaceOf ::
  (NonEmpty LinkedElement -> Bool) -> NonEmpty LinkedElement -> Region -> Maybe FittingFillets
inPlaceOf fits linked at =
  listToMaybe
    [ FittingFillets [(at, sense, r)]
      | r <- [Mm 10, Mm 5, Mm 2, Mm 1],
        sense <- [Clockwise, CounterClockwise],
        fits (fmap (rounded sense r) linked)
    ]
  where
    rounded sense r w
      | fmap fst (link w) == Just at = w {link = Just (at, Fillet sense r)}
      | otherwise = w

-- | The fillets of a contour: region, sense and radius.
filletsOf :: NonEmpty LinkedElement -> [(Region, Sense, Mm)]
filletsOf linked =
  [ (at, sense, r)
    | LinkedElement {link = Just (at, Fillet sense r)} <- NonEmpty.toList linked
  ]

-- | The largest number of fillets that are tried with the other sense, one after the other.
mostTurned :: Int
mostTurned = 100

-- | The largest fillet radius, below the one that the program gives, with which the contour has no
-- fault. A report gives it as a hint. @links@ are the regions of the fillets to change. Each of
-- them is first changed alone. If no such change helps, it is changed together with all fillets of
-- the same radius. 'Nothing' if no radius fits.
largest ::
  (NonEmpty LinkedElement -> Bool) -> NonEmpty LinkedElement -> [Region] -> Maybe FittingFillets
largest fits linked links =
  listToMaybe (mapMaybe bisected (map alone given <> map together given))
  where
    fillets = filletsOf linked
    given = [(at, r) | (at, _, r) <- fillets, at `elem` links]
    alone (at, r) = (r, \at' _ -> at' == at)
    together (_, r) = (r, \_ r' -> r' == r)
    bisected (Mm r, chosen) =
      listToMaybe
        [ FittingFillets
            (nubOrd [(at, sense, largestRadius) | (at, sense, r') <- fillets, chosen at r'])
          | low <- takeWhile (> smallest) (drop 1 (iterate (/ 2) r)),
            isFitting chosen low,
            let largestRadius = bisect chosen low (2 * low)
        ]
    Mm smallest = Tolerance.smallestFillet
    bisect chosen low high
      | high - low <= low * 1e-9 = Mm low
      | isFitting chosen middle = bisect chosen middle high
      | otherwise = bisect chosen low middle
      where
        middle = (low + high) / 2
    isFitting chosen r = fits (fmap (with chosen r) linked)
    with chosen r w = case link w of
      Just (at, Fillet sense r') | chosen at r' -> w {link = Just (at, Fillet sense (Mm r))}
      _ -> w
