-- | Chains of branches of a medial axis: paths along which a tool carves without being lifted.
--
-- The ends of the branches are the nodes of a graph. A chain begins where only one branch ends, if
-- there is such a node, and goes on along branches that are not yet carved for as long as there are
-- any. Where several are left, it first carves a short branch to a free end, there and back, such
-- as a branch into a corner: that is usually quicker than to lift the tool for it.
module Toolpath.CarvingChain
  ( chains,
    deepParts,
  )
where

import Base.Quantity (Mm (..), minus, over, total)
import Data.IntMap.Strict (IntMap)
import Data.IntMap.Strict qualified as IntMap
import Data.IntSet (IntSet)
import Data.IntSet qualified as IntSet
import Data.List (mapAccumL, partition)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Offset.MedialAxis (Branch, Disc (..), Stretch (..))
import Offset.MedialAxis qualified as MedialAxis
import Toolpath.Tolerance qualified as Tolerance

-- | The parts of a branch whose discs have at least the radius @tip@.
deepParts :: Mm -> Branch -> [Branch]
deepParts tip branch = collect (map cut (NonEmpty.toList branch))
  where
    cut s = case s of
      Level _ _ -> Just s
      Sloping d e
        | a >= tip && b >= tip -> Just s
        | a < tip && b < tip -> Nothing
        | a < tip -> Just (Sloping (at d e) e)
        | otherwise -> Just (Sloping d (at d e))
        where
          (a, b) = (discRadius d, discRadius e)
    at d e =
      let t = over (minus tip (discRadius d)) (minus (discRadius e) (discRadius d))
       in Disc (Vec.interpolate t (discCentre d) (discCentre e)) tip
    collect list = case list of
      [] -> []
      Nothing : more -> collect more
      Just s : more -> let (same, others) = run more in (s :| same) : collect others
    -- A stretch that was cut at its end ends the run.
    run list = case list of
      Just s : more | not (isCutAtStart s) -> let (same, others) = run more in (s : same, others)
      _ -> ([], list)
    isCutAtStart s = case s of
      Sloping d e -> discRadius d == tip && discRadius e > tip
      Level _ _ -> False

-- | The branches of a medial axis in chains. A branch without length is a chain by itself, if no
-- other branch ends there. Branches up to the length @most@ are carved there and back.
chains :: Mm -> [Branch] -> [NonEmpty Branch]
chains most found = walks (IntMap.keys freeEnds <> IntMap.keys from) graph IntSet.empty
  where
    (_, joined) = mapAccumL withNodes (Nodes 0 Map.empty) found
    -- One numbering for all, so that no number stands for two branches.
    (long, short) = partition (hasExtent . snd) (zip [0 ..] joined)
    hasExtent (_, _, b) = any hasLength (NonEmpty.toList b)
    from = IntMap.unionWith const (fanned long) (IntMap.map (take 1) (fanned short))
    fanned list =
      IntMap.fromListWith
        (flip (<>))
        (concat [[(a, [(k, z, b)]), (z, [(k, a, backwards b)])] | (k, (a, z, b)) <- list])
    freeEnds = IntMap.filter ((== 1) . length) from
    graph = fmap (map outward) from
    outward (k, next, b) =
      Outward {edge = k, next, along = b, returns = isFree next && branchLength b <= most}
    isFree n = IntMap.member n freeEnds

-- | A branch at a node: its number, the node at its other end, the branch in the direction away
-- from the node, and true if it is short and leads to a free end.
data Outward = Outward {edge :: Int, next :: Int, along :: Branch, returns :: Bool}

-- | Chains from the nodes @starts@, in their order. @graph@ has the branches at each node. The
-- branches with the numbers @done@ are left out.
walks :: [Int] -> IntMap [Outward] -> IntSet -> [NonEmpty Branch]
walks starts graph done = case starts of
  [] -> []
  n : more -> case walk n done of
    ([], _) -> walks more graph done
    (b : bs, after) -> (b :| bs) : walks starts graph after
  where
    walk n visited =
      case [o | o <- IntMap.findWithDefault [] n graph, not (IntSet.member (edge o) visited)] of
        [] -> ([], visited)
        o : others
          | short : _ <- filter returns (o : others),
            not (null others) ->
            onto [along short, backwards (along short)] (walk n (with short visited))
          | otherwise -> onto [along o] (walk (next o) (with o visited))
    with o = IntSet.insert (edge o)
    onto bs (more, visited) = (bs <> more, visited)

-- | True for a stretch with a length.
hasLength :: Stretch -> Bool
hasLength s = case s of
  Sloping d e -> discCentre d /= discCentre e
  Level g _ -> Segment.length g > Mm 0

-- | The length of the path of the centre along a branch.
branchLength :: Branch -> Mm
branchLength = total . map lengthOf . NonEmpty.toList
  where
    lengthOf s = case s of
      Sloping d e -> Vec.distance (discCentre d) (discCentre e)
      Level g _ -> Segment.length g

-- | The count of the known nodes, and the nodes by the cells of a grid.
data Nodes = Nodes Int (Map (Int, Int) [(Int, Disc)])

-- | The nodes at both ends of a branch, which then begins and ends exactly there.
withNodes :: Nodes -> Branch -> (Nodes, (Int, Int, Branch))
withNodes nodes branch = (after, (a, b, beginAt p (backwards (beginAt q (backwards branch)))))
  where
    (between, (a, p)) = nodeAt nodes (MedialAxis.firstDisc branch)
    (after, (b, q)) = nodeAt between (MedialAxis.lastDisc branch)
    beginAt d (s :| more) = (:| more) $ case s of
      Sloping _ e -> Sloping d e
      Level (Straight _ y) r -> Level (Straight (discCentre d) y) r
      Level g@Arc {} r -> Level g {start = discCentre d} r

-- | The node near a disc, which is made if there is none.
nodeAt :: Nodes -> Disc -> (Nodes, (Int, Disc))
nodeAt nodes@(Nodes count cells) d = case filter (isNear . snd) near of
  found : _ -> (nodes, found)
  [] -> (Nodes (count + 1) (Map.insertWith (<>) cell [(count, d)] cells), (count, d))
  where
    Mm size = Tolerance.sameNode
    index v = floor (v / (2 * size))
    cell@(i, j) = (index (Vec.x (discCentre d)), index (Vec.y (discCentre d)))
    near = concat [Map.findWithDefault [] (i + k, j + l) cells | k <- [-1, 0, 1], l <- [-1, 0, 1]]
    isNear e = Vec.distance (discCentre e) (discCentre d) <= Tolerance.sameNode

-- | A branch in the opposite direction.
backwards :: Branch -> Branch
backwards = NonEmpty.reverse . fmap turned
  where
    turned s = case s of
      Sloping d e -> Sloping e d
      Level g r -> Level (Segment.reverse g) r
