-- | Laws of the toolpaths of pockets: the passes sweep the whole floor, cut into no wall, and
-- follow one another in a sensible order.
module Toolpath.PocketSpec (spec) where

import Base.Quantity (Mm (..), Rad (..), plus)
import Data.List (tails)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Generate.Pocket (Pocket (..))
import Generate.Pocket qualified as Generate
import Geometry.Distance (ClosestPoint (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox (BoundingBox))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Polyarc (Ends (Closed), Polyarc (Polyarc))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Test.Hspec
import Test.Hspec.QuickCheck (modifyMaxSuccess, prop)
import Test.QuickCheck
import Toolpath.Inset qualified as Inset
import Toolpath.Pocket (PocketMove (..), PocketRoom (..))
import Toolpath.Pocket qualified as Pocket

spec :: Spec
spec = modifyMaxSuccess (const 60) $ do
  describe "the passes in a pocket" $ do
    prop
      "sweep every point of the floor that the cutter can reach (catches residue in corners, in \
      \nooks and in the middle)"
      $ forAll Generate.pocket $ \p ->
        let sections =
              cleared p
         in forAllBlind (floorPoints p sections) $ \ps -> conjoin (map (swept p sections) ps)
    prop "keep their distance from all walls (catches a link straight through an island)" $
      forAll Generate.pocket $ \p ->
        conjoin [deepEnough p s | s <- concatMap Pocket.segments (cleared p)]
    prop "begin where the previous section ends (catches a loop that loses its first part)" $
      forAll Generate.pocket $ \p ->
        let sections =
              cleared p
         in conjoin (zipWith joined sections (drop 1 sections))
    prop
      "keep the free space on the left, or all of them on the right (catches a detour that is not \
      \reversed)"
      $ forAll Generate.pocket $ \p ->
        let sections = cleared p
            back = clear (Generate.roomOf p) {isReversed = True} (step p) Nothing
         in counterexample "joined" (conjoin (zipWith joined back (drop 1 back)))
              .&&. counterexample
                (show (area sections, area back))
                (abs (area sections + area back) <= 1e-6 * abs (area sections))
    prop "come ever nearer to the wall of a rectangle (catches passes from the outside in)" $
      forAll Generate.rectangle $ \p ->
        let ds =
              [d | AlongLoop d _ <- cleared p]
         in ds === reverse (sorted ds)
    prop
      "have links no longer than the stepover in a rectangle (catches a loop that is entered at an \
      \arbitrary point)"
      $ forAll Generate.rectangle $ \p ->
        [section | section <- cleared p, isLifted section || isLong p section] === []
    prop "come after those that they enclose (catches an inner region left for the end)" $
      forAll (Generate.pocket `suchThat` (null . NonEmpty.tail . loops)) $ \p ->
        let rounds = [(d, ss) | AlongLoop d ss <- cleared p]
         in [ (d, d')
              | (d, ss) : later <- tails rounds,
                Vec.isNear (Segment.start (NonEmpty.head ss)) (Segment.end (NonEmpty.last ss)),
                (d', s :| _) <- later,
                d' > plus d (Mm 1e-3),
                WindingNumber.about (Segment.start s) ss /= 0
            ]
              === []
    it "contain detours in some pockets, and lifted links in some" . withMaxSuccess 1 $
      forAllBlind (map cleared . take 2000 <$> infiniteListOf Generate.pocket) $ \pockets ->
        let some kind = length (take 6 (filter (any kind) pockets))
         in (some isDetour, some isLifted) === (6, 6)
    it "begin at the given plunge position" $
      fmap
        Pocket.startPoint
        (take 1 (clear (Generate.roomOf plain) (Mm 5) (Just (Vec.point 30 20))))
        `shouldBe` [Vec.point 30 20]
    it "are missing if the cutter does not fit into the pocket" $
      Pocket.clear (Generate.roomOf plain {cutter = Mm 21}) (Mm 5) Nothing `shouldBe` Just []
    it "are not computed if there are too many (catches a pocket that takes all memory)" $
      Pocket.clear (Generate.roomOf plain {cutter = Mm 1}) (Mm 5e-5) Nothing `shouldBe` Nothing
  describe "the passes made of loops of the kernel" $ do
    prop
      "sweep every point of the floor that the cutter can reach (catches a loop whose free space \
      \the passes put on the wrong side)"
      $ forAll Generate.pocket $ \p ->
        let sections =
              byKernel p
         in forAllBlind (floorPoints p sections) $ \ps -> conjoin (map (swept p sections) ps)
    prop
      "keep their distance from all walls (catches walls with the free space on the wrong side)"
      $ forAll Generate.pocket $ \p ->
        conjoin [deepEnough p s | s <- concatMap Pocket.segments (byKernel p)]
  describe "the passes along the walls" $
    prop "sweep the allowance of the first passes (catches a pass too few)" $
      forAll Generate.pocket $ \p -> forAll (choose (0, 6)) $ \more ->
        let room = Generate.roomOf p
            leaving = plus (left p) (Mm more)
            rough = clear room {leaves = leaving} (step p) Nothing
            sections = rough <> fromMaybe [] (Pocket.finishWalls room (step p) leaving Nothing)
         in forAllBlind (floorPoints p sections) $ \ps -> conjoin (map (swept p sections) ps)
  where
    plain = Pocket {loops = rectangle 60 40 :| [], cutter = Mm 5, left = Mm 0, step = Mm 5}
    rectangle w h =
      let ps =
            [Vec.point 0 0, Vec.point w 0, Vec.point w h, Vec.point 0 h]
       in NonEmpty.fromList (zipWith Segment.Straight ps (drop 1 ps <> take 1 ps))
    sorted = foldr insert []
    insert x xs = let (a, b) = span (< x) xs in a <> [x] <> b
    -- The sum of the areas that all passes enclose, counter-clockwise positive.
    area sections =
      sum [areaUnder s | section <- sections, isPass section, s <- Pocket.segments section]
    areaUnder s =
      Vec.cross (Vec.to origin (Segment.start s)) (Vec.to origin (Segment.end s)) / 2
        + beyondChord s
    beyondChord s = case s of
      Segment.Straight _ _ -> 0
      Segment.Arc {Segment.start = a, Segment.centre, Segment.sweep = Rad w} ->
        let Mm r =
              Segment.radius centre a
         in r * r * (w - sin w) / 2
    origin = Vec.point 0 0

-- | True for a loop, a part of one, or a detour.
isPass :: PocketMove -> Bool
isPass section = case section of
  AlongLoop _ _ -> True
  Detour _ -> True
  DirectLink _ -> False
  LiftedLink _ _ -> False

isDetour :: PocketMove -> Bool
isDetour section = isPass section && null [() | AlongLoop _ _ <- [section]]

-- | True for a straight link longer than the stepover.
isLong :: Pocket -> PocketMove -> Bool
isLong p section = or [Segment.length s > plus (step p) (Mm 1e-6) | DirectLink s <- [section]]

-- | The sections that clear a pocket, with loops of the offset kernel. The walls are given to it in
-- the opposite sense, so that it has to orient them.
byKernel :: Pocket -> [PocketMove]
byKernel p =
  clear
    (Generate.roomOf p)
      { offsetBy = Inset.inset (Inset.oriented outline islands),
        insetOfLoops = Inset.insetOfLoops
      }
    (step p)
    Nothing
  where
    outline :| islands = fmap (Polyarc.reverse . Polyarc Closed) (loops p)

-- | The sections that clear a pocket, with the simple and slow offset of "Generate.Pocket".
cleared :: Pocket -> [PocketMove]
cleared p = clear (Generate.roomOf p) (step p) Nothing

-- | The sections that clear a pocket whose loops are not too many.
clear :: PocketRoom -> Mm -> Maybe Point -> [PocketMove]
clear room by from = fromMaybe [] (Pocket.clear room by from)

isLifted :: PocketMove -> Bool
isLifted section = case section of
  LiftedLink _ _ -> True
  AlongLoop _ _ -> False
  Detour _ -> False
  DirectLink _ -> False

-- | The first section ends where the second one begins.
joined :: PocketMove -> PocketMove -> Property
joined a b =
  counterexample (show (a, b)) (Vec.distance (Pocket.endPoint a) (Pocket.startPoint b) <= Mm 1e-5)

-- | On a segment the cutter's centre keeps its distance from the walls.
deepEnough :: Pocket -> Segment -> Property
deepEnough p s =
  conjoin
    [ counterexample (show (s, w, d)) (d >= plus nearest (Mm (-2e-5)))
      | w <- NonEmpty.toList (walls (Generate.roomOf p)),
        let ClosestPoint d _ = Distance.segments s w
    ]
  where
    nearest = plus (cutter p) (left p)

-- | Random points in the bounding box of the pocket, and some near the ends of segments, where
-- passes change direction.
floorPoints :: Pocket -> [PocketMove] -> Gen [Point]
floorPoints p sections =
  (<>) <$> vectorOf 150 anywhere <*> (if null ends then pure [] else vectorOf 300 beside)
  where
    BoundingBox l b r t =
      foldr1 BoundingBox.union (fmap BoundingBox.ofSegment (walls (Generate.roomOf p)))
    anywhere = Vec.point <$> choose (l, r) <*> choose (b, t)
    ends = [Segment.end s | section <- sections, s <- Pocket.segments section]
    Mm far = step p
    beside =
      (\q d a -> Vec.shift (Vec.polar (Mm d) (Rad a)) q)
        <$> elements ends <*> choose (0, far) <*> choose (0, 2 * pi)

-- | The cutter sweeps a point, or cannot reach it.
swept :: Pocket -> [PocketMove] -> Point -> Property
swept p sections q =
  counterexample
    (show (q, distanceToPath))
    (not reachable || distanceToPath <= plus (cutter p) (Mm 1e-4))
  where
    room = Generate.roomOf p
    borders = concatMap NonEmpty.toList (offsetBy room (plus (cutter p) (left p)))
    reachable =
      WindingNumber.about q borders > 0
        || any (\s -> Distance.toPoint q s <= plus (cutter p) (Mm (-1e-4))) borders
    distanceToPath =
      minimum
        ( Mm (1 / 0) :
            [ Distance.toPoint q s
              | section <- sections,
                isPass section,
                s <- Pocket.segments section
            ]
        )
