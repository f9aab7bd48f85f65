-- | The area that closed outlines fill by the rule of letters: a point belongs to it if the
-- outlines wind around the point in one sense more often than in the other.
module Drawing.Filling
  ( filled,
  )
where

import Data.Foldable (toList)
import Data.Graph (flattenSCC, stronglyConnComp)
import Data.List (nub)
import Data.Map.Strict qualified as Map
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Drawing.Nesting qualified as Nesting
import Drawing.Outline (Outline)

-- | Outlines of one sense, by their indices, that are connected by crossings. Together they bound
-- what is inside at least one of them.
data Cluster = Cluster {members :: Set Int, sense :: Int}

-- | The outlines that bound the filled area, each with its depth: the outlines of an even depth add
-- what is inside at least one of them, those of an odd depth take it away from what the lower
-- depths have given. Outlines without filled area on one side only are left out.
--
-- Outlines that cross one another are joined if they run in the same sense and are not within an
-- area that another outline fills. Nothing if others cross.
filled :: [Outline] -> Maybe [(Outline, Int)]
filled outlines
  | any isFault pairs = Nothing
  | otherwise =
    Just [(o, length others) | (k, o) <- zip [0 ..] outlines, Just others <- [keptAround k]]
  where
    boundaries = map Nesting.boundary outlines
    senses = Vector.fromList (map Nesting.sense boundaries)
    around = Vector.fromList (Nesting.enclosing boundaries)
    pairs = map fst (Nesting.crossingPairs boundaries)
    isFault (i, j) = i == j || sense' i /= sense' j || isHole i
    sense' i = senses Vector.! i
    clusterOf = clusters senses pairs
    isHole i = let w = winding senses around (clusterOf Vector.! i) i in w * sense' i < 0
    keptAround k
      | bounds senses around (clusterOf Vector.! k) k =
        let others = [clusterOf Vector.! j | j <- around Vector.! k, j `Set.notMember` own k]
         in Just (nub [Set.findMin (members c) | c <- others, keeps c])
      | otherwise = Nothing
    own k = members (clusterOf Vector.! k)
    keeps c = let j = Set.findMin (members c) in bounds senses around c j

-- | The cluster of each outline, from the senses of the outlines and the pairs that cross.
clusters :: Vector Int -> [(Int, Int)] -> Vector Cluster
clusters senses pairs =
  Vector.generate (Vector.length senses) (byMember Map.!)
  where
    neighbours =
      Map.fromListWith (<>) (concat [[(i, [j]), (j, [i])] | (i, j) <- pairs])
    byMember =
      Map.fromList
        [ (k, Cluster {members = Set.fromList ks, sense = senses Vector.! k})
          | component <-
              stronglyConnComp
                [ (k, k, Map.findWithDefault [] k neighbours)
                  | k <- [0 .. Vector.length senses - 1]
                ],
            let ks = flattenSCC component,
            k <- toList ks
        ]

-- | The winding number, about the outline @k@ of a cluster, of the outlines outside of the cluster.
winding :: Vector Int -> Vector [Int] -> Cluster -> Int -> Int
winding senses around cluster k =
  sum [senses Vector.! j | j <- around Vector.! k, j `Set.notMember` members cluster]

-- | True for an outline @k@ of a cluster that has filled area on one side only.
bounds :: Vector Int -> Vector [Int] -> Cluster -> Int -> Bool
bounds senses around cluster k = (before == 0) /= (before + sense cluster == 0)
  where
    before = winding senses around cluster k
