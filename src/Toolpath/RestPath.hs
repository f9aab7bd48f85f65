-- | The toolpath that clears what a larger cutter has left in a pocket.
--
-- The larger cutter, of radius R, has cleared every point within R of a position that its centre
-- could take. These positions, C, are those whose distance from the walls is at least R plus the
-- allowance that was left. A position of the smaller cutter, of radius r, is /idle/ if its distance
-- from C is at most R − r plus 'thinnest': all that the cutter covers there has been cleared, but
-- for a layer that is no thicker than 'thinnest'.
--
-- The loops of the smaller cutter are those of a pocket, at increasing distances from the walls,
-- and the path consists of the parts of these loops that are not idle. That is enough. Take a point
-- Q that the larger cutter has left and on which the smaller cutter's centre may lie. On the
-- shortest line from Q to the walls there is a position on a loop that is no further from Q than
-- the distance between loops, which is at most r. The cutter covers Q there, so the position is not
-- idle. A point Q nearer to the walls is covered from a position on the outermost loop, and for the
-- same reason it is not idle. Loops whose distance from the walls is that of C are idle all along.
--
-- The walls stay as they are, because the loops keep their distance from them. What the cutter
-- covers beyond the rest has been cleared, because that too is in the pocket. No boolean operation
-- on regions is needed, and none can fail.
--
-- A /chain/ is a part of a loop that is not idle, longer at both ends by 'overlap'. So the cutter
-- goes down, and comes up, where the material is cleared. A chain that returns to its beginning is
-- a whole loop. An /area/ is a chain of the outermost loop with the chains further inside that lie
-- beside it; these are cut first.
module Toolpath.RestPath
  ( RestArea,
    areas,
    sections,
  )
where

import Base.Quantity (Mm (..), minus, plus, times, total)
import Data.List (minimumBy)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, mapMaybe)
import Data.Ord (comparing)
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.Tolerance qualified as Tolerance
import Part.Part (Roughing (..))
import Toolpath.Pocket (PocketMove (..), PocketRoom (..))
import Toolpath.Pocket qualified as Pocket
import Toolpath.PocketTree (Loop)

-- | A chain with the areas further inside, which are cut before it.
data RestArea = RestArea {chain :: Chain, inner :: [RestArea]}

-- | A part of a loop, in the direction in which it is cut.
data Chain = Chain
  { -- | the distance of the loop from the walls
    wallDistance :: Mm,
    path :: NonEmpty Segment,
    isClosed :: Bool
  }

-- Areas -------------------------------------------------------------------------------------------

-- | The areas that the cutter of the @room@ has to clear after the larger one. @distances@ are
-- those of the loops from the walls, from the least on. Nothing if the chains have more than
-- 'Pocket.mostSegments'.
areas :: PocketRoom -> Roughing -> [Mm] -> Maybe [RestArea]
areas room roughing distances
  | sum (map (NonEmpty.length . path) (concat levels)) > Pocket.mostSegments = Nothing
  | otherwise = Just (foldr outside [] levels)
  where
    cleared = roughedDistance roughing
    reached =
      BoxTree.index BoundingBox.ofSegment (concatMap NonEmpty.toList (offsetBy room cleared))
    levels =
      [ map directed (concatMap (chainsOf idleReach longer reached c) loops)
        | (c, loops) <- loopsAt room (takeWhile (< cleared) distances)
      ]
    idleReach = plus (minus (roughRadius roughing) (radius room)) thinnest
    longer = overlap room
    directed c
      | isReversed room = c {path = NonEmpty.reverse (fmap Segment.reverse (path c))}
      | otherwise = c
    outside own others = areasAround (times 1.5 (radius room)) own others

-- | The distance from the walls within which the larger cutter's centre counts as able to move. It
-- is larger than the true one by more than the accuracy of an offset, so that a passage that is
-- hardly wider than that cutter counts as not cleared.
roughedDistance :: Roughing -> Mm
roughedDistance roughing =
  plus
    (plus (roughRadius roughing) (roughAllowance roughing))
    (times 5 Tolerance.clearance)

-- | The loops at each of the increasing distances from the walls, up to the first distance without
-- loops.
loopsAt :: PocketRoom -> [Mm] -> [(Mm, [Loop])]
loopsAt room distances = case distances of
  [] -> []
  c : more -> go c (offsetBy room c) more
  where
    go c loops more
      | null loops = []
      | otherwise =
        (c, loops) : case more of
          [] -> []
          next : others -> go next (inwards loops (minus next c) next) others
    inwards loops d c = fromMaybe (offsetBy room c) (insetOfLoops room loops d)

-- | The areas of the chains of one loop distance. The areas @others@, which lie further inside,
-- become parts of the areas whose chains they are beside: not further away than @near@. Those that
-- are beside none stay areas of their own.
areasAround :: Mm -> [Chain] -> [RestArea] -> [RestArea]
areasAround near own others =
  [RestArea c (Map.findWithDefault [] k inside) | (k, c) <- numbered] <> alone
  where
    numbered = zip [0 :: Int ..] own
    index =
      BoxTree.index
        (BoundingBox.ofSegment . snd)
        [(k, s) | (k, c) <- numbered, s <- NonEmpty.toList (path c)]
    placed = [(chainBeside a, a) | a <- others]
    inside = Map.fromListWith (flip (<>)) [(k, [a]) | (Just k, a) <- placed]
    alone = [a | (Nothing, a) <- placed]
    chainBeside a = case BoxTree.closest (Distance.toPoint p . snd) p index of
      Just (d, (k, _)) | d <= near -> Just k
      _ -> Nothing
      where
        p = middleOf (path (chain a))
    middleOf ss = Segment.at 0.5 (ss NonEmpty.!! (NonEmpty.length ss `div` 2))

-- Chains ------------------------------------------------------------------------------------------

-- | The chains of a loop at the distance @wallDistance@ from the walls: its parts that are further
-- than @idleReach@ from the border @reached@ of the positions of the larger cutter, longer at both
-- ends by @longer@. The loop lies outside of these positions.
chainsOf :: Mm -> Mm -> BoxTree Segment -> Mm -> Loop -> [Chain]
chainsOf idleReach (Mm longer) reached wallDistance loop
  | null open = []
  | otherwise = case joined whole [(a - longer, b + longer) | (a, b) <- open] of
    [(a, b)] | b - a >= whole -> [Chain {wallDistance, path = loop, isClosed = True}]
    parts ->
      [ Chain {wallDistance, path, isClosed = False}
        | path <- mapMaybe NonEmpty.nonEmpty (cutOut parts (around placed))
      ]
  where
    Mm whole = total (map Segment.length (NonEmpty.toList loop))
    placed = placedFrom 0 (NonEmpty.toList loop)
    open =
      [ (at + a * long, at + b * long)
        | Placed at long s <- placed,
          (a, b) <- Distance.uncovered idleReach (near s) s
      ]
    near s = BoxTree.within (BoundingBox.inflate idleReach (BoundingBox.ofSegment s)) reached
    -- The loop three times, the second time from the position 0 on.
    around ss = concat [[p {position = position p + k * whole} | p <- ss] | k <- [-1, 0, 1]]

-- | A segment of a loop: its position along the loop and its length in mm.
data Placed = Placed {position :: Double, long :: Double, placedSegment :: Segment}

placedFrom :: Double -> [Segment] -> [Placed]
placedFrom at segments = case segments of
  [] -> []
  s : more -> let Mm long = Segment.length s in Placed at long s : placedFrom (at + long) more

-- | Intervals of positions along a loop of the length @whole@, in order, with those joined that
-- meet. The last one may meet the first one round the beginning of the loop.
joined :: Double -> [(Double, Double)] -> [(Double, Double)]
joined whole intervals = case foldr add [] intervals of
  first : more@(_ : _)
    | (from, to) <- last more,
      to >= fst first + whole ->
      init more <> [(from, max to (snd first + whole))]
  parts -> parts
  where
    add (a, b) parts = case parts of
      (c, d) : more | c <= b -> (a, max b d) : more
      _ -> (a, b) : parts

-- | The segments in each of the intervals of positions, which are in order and apart.
cutOut :: [(Double, Double)] -> [Placed] -> [[Segment]]
cutOut intervals placed = case intervals of
  [] -> []
  (from, to) : more ->
    let ahead = dropWhile (\p -> position p + long p <= from + shortest) placed
        during = takeWhile (\p -> position p < to - shortest) ahead
     in map (cut from to) during : cutOut more ahead
  where
    Mm shortest = Tolerance.coincident
    cut from to p
      | position p >= from - shortest && position p + long p <= to + shortest = placedSegment p
      | otherwise =
        Segment.between
          (max 0 ((from - position p) / long p))
          (min 1 ((to - position p) / long p))
          (placedSegment p)

-- | The thickness up to which a layer that the larger cutter has left is no rest.
thinnest :: Mm
thinnest = times 0.5 Tolerance.thinnestRest

-- | The length by which a chain leads into the cleared material: a tenth of the cutter's diameter.
overlap :: PocketRoom -> Mm
overlap room = times 0.2 (radius room)

-- Order -------------------------------------------------------------------------------------------

-- | The state while the order of the areas is chosen, as in "Toolpath.Pocket": the position of the
-- cutter, and the sections so far, the last one first.
data Progress = Progress {current :: Maybe Point, done :: [PocketMove]}

-- | The sections along all areas, with the linking moves between them. @from@ is the cutter's
-- plunge position; Nothing if the cutter plunges at the beginning of the first chain. From chain to
-- chain the cutter goes straight if no wall is in the way and the way is not longer than the
-- diameter of the larger cutter: in one corner it never is. Otherwise it is lifted.
sections :: PocketRoom -> Roughing -> [RestArea] -> Maybe Point -> [PocketMove]
sections room roughing found from = reverse (done (visitAll start found))
  where
    start = Progress {current = from, done = []}
    visitAll progress list = case nextOf progress list of
      Nothing -> progress
      Just (a, others) -> visitAll (visit progress a) others
    visit progress a = cutAlong (visitAll progress (inner a)) (chain a)
    cutAlong progress c =
      let begun = maybe c (begunNear c) (current progress)
       in Progress
            { current = Just (Segment.end (NonEmpty.last (path begun))),
              done =
                AlongLoop (wallDistance begun) (path begun) :
                reverse (maybe [] (`link` beginning begun) (current progress)) <> done progress
            }
    link p q = case linked p q of
      [DirectLink (Straight _ _)] | Vec.distance p q > longest -> [LiftedLink p q]
      moves -> moves
    linked = Pocket.linked room
    longest = times 2 (roughRadius roughing)

-- | The next area and the others: the one whose first chain begins nearest to the cutter. While
-- very many are left, it is the first of the list.
nextOf :: Progress -> [RestArea] -> Maybe (RestArea, [RestArea])
nextOf progress list = case (list, current progress) of
  ([], _) -> Nothing
  (first : others, Just p)
    | null (drop 2000 list) ->
      let away = map (Vec.distance p . entrance) list
          number = fst (minimumBy (comparing snd) (zip [0 :: Int ..] away))
       in case splitAt number list of
            (before, a : after) -> Just (a, before <> after)
            (_, []) -> Just (first, others)
  (first : others, _) -> Just (first, others)

-- | The point at which the cutting of an area begins.
entrance :: RestArea -> Point
entrance a = case inner a of
  [] -> beginning (chain a)
  first : _ -> entrance first

beginning :: Chain -> Point
beginning = Segment.start . NonEmpty.head . path

-- | A whole loop from its segment that begins nearest to @p@; another chain has its own beginning.
begunNear :: Chain -> Point -> Chain
begunNear c p
  | isClosed c = case splitAt number list of
    (before, s : after) -> c {path = s :| after <> before}
    (_, []) -> c
  | otherwise = c
  where
    list = NonEmpty.toList (path c)
    number =
      fst
        (minimumBy (comparing snd) (zip [0 :: Int ..] (map (Vec.distance p . Segment.start) list)))
