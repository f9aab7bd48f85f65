-- | Random parts with several operations: milling along contours, pockets, holes, and moves.
module Generate.Operations
  ( part,
    start,
  )
where

import Base.Quantity (Feed (..), Mm (..))
import Base.Region (Located (..), Region (Region))
import Control.Monad (replicateM)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Generate qualified
import Generate.Pocket qualified as Pocket
import Geometry.Polyarc (Ends (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Vec qualified as Vec
import Part.CutFeed (CutFeed (..))
import Part.Part (Drilling (Drilling), Milling, Operation, Part, SpacePoint (..), Stop (Stop))
import Part.Part qualified as Part
import Test.QuickCheck

-- | The position of the cutter before the first operation.
start :: SpacePoint
start = SpacePoint (Vec.point (-150) (-150)) clear

-- | The height at which rapid moves are free.
clear :: Mm
clear = Mm 5

-- | A part with one to three operations.
part :: Gen Part
part = do
  operations <- choose (1, 3 :: Int) >>= \n -> replicateM n operation
  let first :| _ = NonEmpty.fromList operations
  pure
    (Generate.partOf (plane start) first)
      { Part.start = Just (here start),
        Part.operations = operations
      }

operation :: Gen Operation
operation =
  frequency
    [ (5, Part.Mill . here <$> milling),
      (2, Part.Drill . here <$> drilling),
      (2, Part.Pocket . here <$> pocketing),
      (2, Part.Travel <$> stops)
    ]

here :: a -> Located a
here = Located (Region 0 0)

-- | Milling along a closed or an open contour, in one or several passes.
milling :: Gen Milling
milling = do
  c <- oneof [Generate.closedCase, Generate.openCase] `suchThat` ((> 0.4) . Generate.radiusOf)
  settled <- Generate.settings
  levels <- elements [[Mm (-1)], [Mm (-1.5), Mm (-3)], [Mm (-4)]]
  tolerance <-
    elements [Part.OnPath (Mm 0.05), Part.OnPath (Mm 0.02), Part.Band (Mm 0.02) (Mm 0.06)]
  plunge <- elements [Nothing, Just (here (PerMinute (Feed 20)))]
  rest <- elements [Part.Refused, Part.Allowed]
  sense <- elements [Nothing, Just (here Part.Climb), Just (here Part.Conventional)]
  let m = settled (Generate.job c)
      isClosed = Polyarc.ends (Generate.contour c) == Closed
  pure
    m
      { -- Only a closed contour may start elsewhere.
        Part.contour = Part.contour (if isClosed then m else Generate.job c),
        Part.levels = levels,
        Part.clearance = Just clear,
        Part.tolerance = tolerance,
        Part.plunge = plunge,
        Part.descent = here Part.Plunging,
        Part.materialTop = Mm 0,
        Part.tabs = Nothing,
        Part.rest = rest,
        Part.corners = Part.Round,
        Part.sense = if isClosed then sense else Nothing,
        Part.side =
          if isClosed
            then here (if Generate.outside c then Part.Outside else Part.Inside)
            else Part.side m
      }

-- | Holes that are more than 15 mm apart, with or without pecking.
drilling :: Gen Drilling
drilling = do
  n <- choose (1, 5)
  ps <- vectorOf n (Vec.point <$> coordinate <*> coordinate)
  deep <- vectorOf n (elements [3, 8, 12])
  visits <- elements [Part.AsListed, Part.Shortest]
  peck <- elements [Nothing, Just (Mm 3), Just (Mm 4.5)]
  let apart = foldr addApart [] (zip ps deep)
  pure
    Drilling
      { Part.holes = NonEmpty.fromList (map hole apart),
        Part.visits,
        Part.drillSize = Nothing,
        Part.drillRadius = Mm 2.5,
        Part.travelHeight = clear,
        Part.peckDepth = peck,
        Part.chipRise = Nothing,
        Part.bottomPause = Nothing,
        Part.form = Part.Plunged,
        Part.drillFeed = here (PerMinute (Feed 40))
      }
  where
    addApart (p, z) others =
      [(p, z) | all ((> Mm 15) . Vec.distance p . fst) others] <> others
    hole (p, z) = Part.Hole (here p) (Mm (-z)) (Mm 2.5)

-- | A small pocket, sometimes with islands, cleared at one or two depths.
pocketing :: Gen Part.Pocketing
pocketing = do
  before <- elements [[], [Mm 0.4]]
  p <- Pocket.pocketing before <$> oneof [Pocket.rectangle, Pocket.pocket]
  levels <- elements [[Mm (-1.5)], [Mm (-2), Mm (-4)]]
  pure p {Part.wall = (Part.wall p) {Part.levels = levels, Part.clearance = Just clear}}

-- | Moves at or above the clearance height, at a feed or in rapid.
stops :: Gen (NonEmpty Stop)
stops = do
  n <- choose (0, 3)
  (:|) <$> stop <*> vectorOf n stop
  where
    stop = do
      p <- Vec.point <$> coordinate <*> coordinate
      z <- elements [Nothing, Just clear, Just (Mm 9)]
      pace <-
        elements
          (Part.Rapid : [Part.At (here (PerMinute (Feed f))) | f <- [60, 80]])
      pure (Stop (here p) z pace)

-- | A coordinate in whole tenths of a millimetre.
coordinate :: Gen Double
coordinate = (/ 10) . fromIntegral <$> choose (-900, 900 :: Int)
