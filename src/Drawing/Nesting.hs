-- | Closed outlines in the plane: the points at which they cross or touch, and how many
-- others each one lies in.
module Drawing.Nesting
  ( ClosedBoundary,
    boundary,
    sense,
    Crossing (..),
    crossings,
    crossingPairs,
    depths,
    enclosing,
  )
where

import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (mapMaybe)
import Data.Semigroup (sconcat)
import Drawing.Drawing (Entity)
import Drawing.Outline (DrawnPart (..), Outline (..))
import Drawing.PathPart qualified as PathPart
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.SelfIntersection qualified as SelfIntersection
import Geometry.Vec (Point)
import Geometry.WindingNumber qualified as WindingNumber

-- | The lines and arcs along a closed outline, each with its entity.
newtype ClosedBoundary = ClosedBoundary (NonEmpty (Entity, Segment))

-- | The boundary of a closed outline.
boundary :: Outline -> ClosedBoundary
boundary o = ClosedBoundary (sconcat (fmap along (parts o)))
  where
    along p = (entity p,) <$> PathPart.segments (part p)

-- | The sense of a boundary: 1 if it runs counter-clockwise, -1 if it runs clockwise.
sense :: ClosedBoundary -> Int
sense (ClosedBoundary list)
  | Polyarc.signedArea (Polyarc Closed (fmap snd list)) < 0 = -1
  | otherwise = 1

-- | A point at which two entities cross or touch elsewhere than at a common end.
data Crossing = Crossing Entity Entity Point
  deriving stock (Eq, Show)

-- | A crossing of each boundary with itself, and one of each two boundaries that cross or touch.
crossings :: [ClosedBoundary] -> [Crossing]
crossings = map snd . crossingPairs

-- | The 'crossings', each with the indices of its boundaries from 0. The indices are equal for a
-- crossing of a boundary with itself.
crossingPairs :: [ClosedBoundary] -> [((Int, Int), Crossing)]
crossingPairs bs =
  mapMaybe withItself (zip [0 ..] bs)
    <> Map.toList (Map.fromListWith (\_ earlier -> earlier) (concatMap withOthers numbered))
  where
    numbered =
      [ (k, e, s)
        | (k, ClosedBoundary list) <- zip [0 :: Int ..] bs,
          (e, s) <- NonEmpty.toList list
      ]
    index = BoxTree.index (\(_, _, s) -> BoundingBox.ofSegment s) numbered
    withOthers (k, a, s) =
      [ ((k, j), Crossing a b p)
        | (j, b, t) <- BoxTree.within (BoundingBox.ofSegment s) index,
          j > k,
          p <- take 1 (Distance.intersections s t)
      ]
    withItself (k, ClosedBoundary list) = do
      (i, j, p) <- SelfIntersection.firstSelfIntersectionBy snd Closed list
      pure ((k, k), Crossing (fst (list NonEmpty.!! i)) (fst (list NonEmpty.!! j)) p)

-- | Count of the other boundaries around each one, for boundaries without 'crossings'.
depths :: [ClosedBoundary] -> [Int]
depths = map length . enclosing

-- | The indices, from 0, of the other boundaries around the first point of each one.
enclosing :: [ClosedBoundary] -> [[Int]]
enclosing bs =
  [ [ j
      | (j, _, around) <- BoxTree.within (BoundingBox.ofPoints p []) index,
        j /= k,
        WindingNumber.encloses around p
    ]
    | (k, ClosedBoundary list) <- zip [0 :: Int ..] bs,
      let p = Segment.start (snd (NonEmpty.head list))
  ]
  where
    index =
      BoxTree.index
        (\(_, box, _) -> box)
        [ (k, boxOf segments, Polyarc Closed segments)
          | (k, ClosedBoundary list) <- zip [0 :: Int ..] bs,
            let segments = fmap snd list
        ]

boxOf :: NonEmpty Segment -> BoundingBox
boxOf segments = foldr1 BoundingBox.union (fmap BoundingBox.ofSegment segments)
