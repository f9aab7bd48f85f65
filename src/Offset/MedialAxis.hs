-- | The medial axis of an area bounded by lines and arcs: the centres of the discs that lie in the
-- area and touch its boundary at two points or more. Discs can be limited to a largest radius;
-- those of this radius touch the boundary at one point, and their centres are an offset.
--
-- The method follows the boundary. A site is an element of it: a line, an arc, or a reflex corner.
-- The largest disc that touches a site at a point is the smallest of those that touch the site
-- there and one other site, and each of these has a closed form (Held, "On the Computational
-- Geometry of Pocket Machining", chapter 4, has the bisectors). As the point moves along the site,
-- the centre moves along the axis; it comes to a branching point where another site takes over. So
-- every branch is found twice, once from each of its two sites, and the first of them gives it.
module Offset.MedialAxis
  ( Disc (..),
    Stretch (..),
    Branch,
    branches,
    firstDisc,
    lastDisc,
    moved,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List (sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, mapMaybe)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc (Polyarc (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Offset.Tolerance qualified as Tolerance

-- | A disc in the area.
data Disc = Disc {discCentre :: Point, discRadius :: Mm}
  deriving stock (Eq, Show)

-- | A stretch of the path of the centre of a disc.
data Stretch
  = -- | a straight line between the centres of two discs; the radius changes evenly
    Sloping Disc Disc
  | -- | an arc on which the radius stays the same
    Level Segment Mm
  deriving stock (Eq, Show)

-- | Stretches of which each begins where the one before it ends. A branch that is only a point has
-- one stretch of length 0.
type Branch = NonEmpty Stretch

-- | The disc at the beginning and at the end of a branch.
firstDisc, lastDisc :: Branch -> Disc
firstDisc b = case NonEmpty.head b of
  Sloping d _ -> d
  Level s r -> Disc (Segment.start s) r
lastDisc b = case NonEmpty.last b of
  Sloping _ d -> d
  Level s r -> Disc (Segment.end s) r

-- | A branch moved by a vector.
moved :: Vec -> Branch -> Branch
moved v = fmap $ \case
  Sloping d e -> Sloping (disc d) (disc e)
  Level s r -> Level (Transformation.segment (Transformation.translation v) s) r
  where
    disc (Disc c r) = Disc (Vec.shift v c) r

-- Sites -------------------------------------------------------------------------------------------

-- | An element of the boundary, with the area on its left.
data Site
  = Side Segment
  | -- | a corner, the unit normal into the area at the end of the side before it, and the angle to
    -- the normal of the next side. It is negative at a reflex corner
    Corner Point Vec Double

-- | The sites of an area: the sides have the numbers from 0, and the corners those after them. The
-- corner at the start of the side k has the number k plus the count of the sides.
data Sites = Sites
  { sites :: Vector Site,
    tree :: BoxTree (Int, Site),
    -- | the numbers of the sides before and after each side
    before :: Vector Int,
    after :: Vector Int
  }

sitesOf :: NonEmpty Polyarc -> Sites
sitesOf loops =
  Sites
    { sites = list,
      tree = BoxTree.index (boxOf . snd) (zip [0 ..] (Vector.toList list)),
      before = Vector.fromList (concat (zipWith numbersBefore firsts counts)),
      after = Vector.fromList (concat (zipWith numbersAfter firsts counts))
    }
  where
    list = Vector.fromList (map Side (concatMap sidesOf loops) <> concatMap cornersOf loops)
    sidesOf = NonEmpty.toList . segments
    counts = map (NonEmpty.length . segments) (NonEmpty.toList loops)
    firsts = scanl (+) 0 counts
    numbersBefore first count = (first + count - 1) : [first .. first + count - 2]
    numbersAfter first count = [first + 1 .. first + count - 1] <> [first]
    cornersOf loop =
      let ss = sidesOf loop in zipWith corner (drop (length ss - 1) (cycle ss)) ss
    corner a b =
      let n = Vec.left (Segment.endDirection a)
          Rad turn = Vec.signedAngle (Segment.endDirection a) (Segment.startDirection b)
       in Corner (Segment.start b) n turn

boxOf :: Site -> BoundingBox
boxOf site = case site of
  Side s -> BoundingBox.ofSegment s
  Corner p _ _ -> BoundingBox.ofPoints p []

-- | The point of a site at a share of it, and the unit normal into the area there.
contact :: Site -> Double -> (Point, Vec)
contact site u = case site of
  Side s -> (Segment.at u s, Vec.left (Segment.directionAt u s))
  Corner p n turn -> (p, Vec.rotate (Rad (u * turn)) n)

-- | The radius in mm of the disc that touches one site at the point @p@, with the unit normal @n@
-- into the area there, and that touches another site; Nothing if no such disc touches it from the
-- area, or if the radius is not above the first argument.
radiusBetween :: Mm -> Point -> Vec -> Site -> Maybe Double
radiusBetween (Mm least) p n site = case carrierRadius p n site of
  Just r | r > least && touches site (Vec.shift (Vec.scale r n) p) -> Just r
  _ -> Nothing
  where
    touches (Side s) c = Segment.hasFootOf s c
    touches Corner {} _ = True

-- | The radius in mm of the disc that touches one site at the point @p@, with the unit normal @n@
-- into the area there, and the whole line or circle of another site; Nothing if there is none.
--
-- A disc of radius r has its centre at p + r·n. For each kind of site the condition that it touches
-- is linear in r.
carrierRadius :: Point -> Vec -> Site -> Maybe Double
carrierRadius p n site = case site of
  Corner q _ _ -> let d = Vec.to p q in quotient (Vec.dot d d) (2 * Vec.dot n d)
  Side (Straight a b) ->
    let m = Vec.left (Vec.unit (Vec.to a b))
     in quotient (Vec.dot m (Vec.to a p)) (1 - Vec.dot m n)
  Side Arc {start, centre = o, sweep = Rad w} ->
    let Mm big = Segment.radius o start
        d = Vec.to o p
        excess = big * big - Vec.dot d d
     in if w > 0
          then quotient excess (2 * (big + Vec.dot n d))
          else quotient (-excess) (2 * (big - Vec.dot n d))
  where
    quotient over under
      | under <= Tolerance.tangential = Nothing
      | otherwise = Just (over / under)

-- | The distance in mm along the line or the arc of a side, or nearly so, from an end of it to the
-- foot of the point @c@. It is positive beyond the end, which is the last point of the side if
-- @isLast@ is true, else the first one.
beyond :: Bool -> Segment -> Point -> Double
beyond isLast s c = case s of
  Straight _ _ -> Vec.dot outward (Vec.to end' c)
  Arc {centre = o} ->
    let Mm far = Vec.distance o c
        Mm big = Segment.radius o end'
     in if far > 0 then big * Vec.dot outward (Vec.to o c) / far else 0
  where
    end' = if isLast then Segment.end s else Segment.start s
    outward = if isLast then Segment.endDirection s else Vec.scale (-1) (Segment.startDirection s)

-- Following a site --------------------------------------------------------------------------------

-- | The bound on the largest disc at a point of a site.
data Bound
  = -- | another site, by its number
    Other Int
  | -- | the radius of the site itself, a concave arc
    Itself
  | -- | the largest radius of the discs
    Limit
  deriving stock (Eq)

-- | A share of a site, with the radius and the bound of the largest disc there.
data Sample = Sample {share :: Double, radius :: Double, bound :: Bound}

-- | A site that is followed: the sites of the area, the largest radius, its own number, itself, and
-- for a side, the numbers of the sides beyond the convex corners at its start and at its end.
data Followed = Followed
  { around :: Sites,
    most :: Double,
    own :: Int,
    site :: Site,
    beyondStart :: Maybe Int,
    beyondEnd :: Maybe Int
  }

-- | The site of an area with a number, which is to be followed.
follow :: Sites -> Double -> Int -> Followed
follow around most own =
  Followed
    { around,
      most,
      own,
      site = sites around Vector.! own,
      beyondStart = if isConvex around own then Just (before around Vector.! own) else Nothing,
      beyondEnd = if any (isConvex around) next then next else Nothing
    }
  where
    next = after around Vector.!? own

-- | True for a side with a convex corner at its start.
isConvex :: Sites -> Int -> Bool
isConvex around k = case sites around Vector.!? (k + Vector.length (before around)) of
  Just (Corner _ _ turn) -> turn > Tolerance.tangential
  _ -> False

-- | The largest disc at a share of a site. @expected@ is a guess of its radius in mm, near which
-- the search begins.
sample :: Followed -> Double -> Double -> Sample
sample f expected u
  | Just neighbour <- atConvexCorner f u = Sample u 0 (Other neighbour)
  | otherwise = within firstReach
  where
    (p, n) = contact (site f) u
    (start, startBound) = case site f of
      Side Arc {start = a, centre = o, sweep = Rad w}
        | w > 0, let Mm big = Segment.radius o a, big <= most f -> (big, Itself)
      _ -> (most f, Limit)
    -- All discs that touch the site at the point lie one in another. So if a disc of some radius
    -- meets a site that bounds it, the least bound is among the sites that it meets.
    within r
      | r >= start = fromNear start
      | radius found < r = found
      | otherwise = within (4 * r)
      where
        found = fromNear r
    fromNear r =
      foldl least (Sample u start startBound) (BoxTree.within (boxAbout r) (tree (around f)))
    boxAbout r =
      let c = Vec.shift (Vec.scale r n) p
       in BoundingBox (Vec.x c - r) (Vec.y c - r) (Vec.x c + r) (Vec.y c + r)
    firstReach = max (1.1 * expected) (most f / 64)
    least s (k, other)
      | k /= own f,
        Just r <- radiusTo f p n (k, other),
        r < radius s - smallest =
        Sample u r (Other k)
      | otherwise = s
    -- Equal radii but for rounding are those of the site that comes first.
    Mm smallest = Tolerance.smallestDisc

-- | The number of the side beyond the convex corner at a share of a side, if it is at one.
atConvexCorner :: Followed -> Double -> Maybe Int
atConvexCorner f u
  | u * extent (site f) <= smallest, Just k <- beyondStart f = Just k
  | (1 - u) * extent (site f) <= smallest = beyondEnd f
  | otherwise = Nothing
  where
    Mm smallest = Tolerance.smallestDisc

-- | The length of a site in mm.
extent :: Site -> Double
extent s = case s of
  Side g -> let Mm l = Segment.length g in l
  Corner {} -> 0

-- | The radius of the disc that touches a site at a point and also the site with the number @k@.
-- Across a convex corner it may be as small as one likes.
radiusTo :: Followed -> Point -> Vec -> (Int, Site) -> Maybe Double
radiusTo f p n (k, other) = radiusBetween least p n other
  where
    least = if Just k `elem` [beyondStart f, beyondEnd f] then Mm 0 else Tolerance.smallestDisc

-- | Pieces of a site, each from a share to another one, with one bound.
pieces :: Followed -> [(Double, Double, Bound)]
pieces f = joined (concat (zipWith between found (drop 1 found)))
  where
    found = samples f
    between a b = case crossing f a b of
      _ | isOne a b -> [(share a, share b, bound a)]
      Just w
        | bound m == bound a && bound n == bound b ->
          [piece | piece@(u, v, _) <- [(share a, w, bound a), (w, share b, bound b)], v > u]
        | otherwise -> halved a m <> halved m n <> halved n b
        where
          m = if w - near' > share a then sample f (radius a) (w - near') else a
          n = if w + near' < share b then sample f (radius b) (w + near') else b
      Nothing -> halved a b
    halved a b
      | isOne a b = [(share a, share b, bound a)]
      | otherwise = between a m <> between m b
      where
        m = sample f (max (radius a) (radius b)) ((share a + share b) / 2)
    isOne a b = bound a == bound b || share b - share a <= Tolerance.finestShare
    near' = Tolerance.crossingShare
    joined list = case list of
      (a, _, x) : (_, b, y) : more | x == y -> joined ((a, b, x) : more)
      one : more -> one : joined more
      [] -> []

-- | The share between two samples at which the bound changes from that of the first one to that of
-- the second one; Nothing if none is found. Steps of the Illinois method, a form of regula falsi.
crossing :: Followed -> Sample -> Sample -> Maybe Double
crossing f a b = go (20 :: Int) (0 :: Int) (share a) (test (share a)) (share b) (test (share b))
  where
    test = fromMaybe difference (jointTest f (bound a) (bound b))
    -- The bound that comes first is taken if both radii are equal but for 'Tolerance.smallestDisc'.
    difference u = carrierRadiusOf f u (bound a) - carrierRadiusOf f u (bound b) - preference
    preference = if isBefore (bound a) (bound b) then smallest else -smallest
    isBefore (Other i) (Other j) = i < j
    isBefore _ (Other _) = True
    isBefore _ _ = False
    Mm smallest = Tolerance.smallestDisc
    -- The end that stays for a second time counts half. @side@ is the sign of the last step's
    -- value.
    go steps side u du v dv
      | du > 0 || dv < 0 || isInfinite du || isInfinite dv || du == dv = Nothing
      | steps == 0 || abs dw <= 0.1 * smallest && isNear = Just w
      | dw < 0 = go (steps - 1) (-1) w dw v (if side < 0 then dv / 2 else dv)
      | otherwise = go (steps - 1) 1 u (if side > 0 then du / 2 else du) w dw
      where
        w = u - du * (v - u) / (dv - du)
        dw = test w
        isNear = min (w - u) (v - w) <= Tolerance.crossingShare

-- | For the bounds of two consecutive elements without a convex corner between them: a number for
-- each share that is negative where the disc touches the first of them, and positive where it
-- touches the second one. Both radii are equal at their joint, but do not cross there.
jointTest :: Followed -> Bound -> Bound -> Maybe (Double -> Double)
jointTest f x y = case (x, y) of
  (Other i, Other j)
    | isSide i && isEnd i j -> Just (past True i)
    | isSide i && isStart i j -> Just (past False i)
    | isSide j && isEnd j i -> Just (negate . past True j)
    | isSide j && isStart j i -> Just (negate . past False j)
  _ -> Nothing
  where
    count = Vector.length (before (around f))
    isSide k = k < count
    following k = after (around f) Vector.! k
    preceding k = before (around f) Vector.! k
    isSmoothAt k = not (isConvex (around f) k)
    isEnd k other =
      isSmoothAt (following k) && other `elem` [following k, following k + count]
    isStart k other = isSmoothAt k && other `elem` [preceding k, k + count]
    past isLast k u = case sites (around f) Vector.! k of
      Side s | Just r <- carrierRadius p n (Side s) -> beyond isLast s (Vec.shift (Vec.scale r n) p)
      _ -> 1 / 0
      where
        (p, n) = contact (site f) u

-- | The radius that a bound gives at a share of a site; very large if it gives none there.
radiusOf :: Followed -> Double -> Bound -> Double
radiusOf f u = radiusBy f $ \k -> radiusTo f p n (k, sites (around f) Vector.! k)
  where
    (p, n) = contact (site f) u

-- | The radius as 'radiusOf' gives it, but for the whole line or circle of the bound.
carrierRadiusOf :: Followed -> Double -> Bound -> Double
carrierRadiusOf f u = radiusBy f $ \k -> carrierRadius p n (sites (around f) Vector.! k)
  where
    (p, n) = contact (site f) u

-- | The radius of a bound; very large if there is none. @other@ gives that of another site.
radiusBy :: Followed -> (Int -> Maybe Double) -> Bound -> Double
radiusBy f other b = case b of
  Limit -> most f
  Itself -> case site f of
    Side Arc {start, centre = o} -> let Mm big = Segment.radius o start in big
    _ -> most f
  Other k -> fromMaybe (1 / 0) (other k)

-- | The first samples of a site, in the order of their shares: some at even distances, and those at
-- which it is nearest to another site, if one of them is convex.
samples :: Followed -> [Sample]
samples f = map snd (dropEqual (sortOn fst (evenly <> map sampled others)))
  where
    sampled u = (u, sample f widest u)
    evenly = [(share s, s) | s <- scanl next (sample f 0 0) [1 .. count]]
    next s k = sample f (radius s) (fromIntegral k / fromIntegral count)
    count = 4 :: Int
    others = filter isInside (mapMaybe near found)
    isInside u = u > Tolerance.finestShare && u < 1 - Tolerance.finestShare
    -- On a site that is shorter than the radius, discs between two samples are about as large.
    reach' = Mm (2 * (if extent (site f) <= widest then widest else most f))
    widest = maximum (map (radius . snd) evenly)
    found = BoxTree.within (BoundingBox.inflate reach' (boxOf (site f))) (tree (around f))
    near (k, other)
      | k == own f = Nothing
      | otherwise = case (middleOf (site f), other) of
        (_, Corner q _ turn) | turn < 0 -> Just (towards q)
        (_, Side Arc {centre = o, sweep = Rad w}) | w < 0 -> Just (towards o)
        (Just o, Side s) -> Just (towards (snd (Distance.nearest o s)))
        _ -> Nothing
    middleOf s = case s of
      Corner q _ _ -> Just q
      Side Arc {centre = o, sweep = Rad w} | w < 0 -> Just o
      Side _ -> Nothing
    towards q = case site f of
      Side s -> Segment.fraction s q
      Corner p n turn -> let Rad a = Vec.signedAngle n (Vec.to p q) in a / turn
    dropEqual list = case list of
      a : b : more
        | fst b - fst a <= Tolerance.finestShare -> dropEqual (a : more)
        | otherwise -> a : dropEqual (b : more)
      _ -> list

-- Branches ----------------------------------------------------------------------------------------

-- | The branches of the medial axis of an area. The first argument is the largest deviation in mm
-- of a straight stretch from the axis, and of the radius along it; the second one the largest
-- radius of the discs in mm. The area lies on the left of closed loops that neither cross nor
-- touch.
branches :: Mm -> Mm -> NonEmpty Polyarc -> [Branch]
branches (Mm tolerance) (Mm most) loops =
  concat
    [ concatMap (branchOf tolerance f) (pieces f)
      | (k, s) <- zip [0 ..] (Vector.toList (sites around)),
        isFollowed s,
        let f = follow around most k
    ]
  where
    around = sitesOf loops
    isFollowed s = case s of
      Side _ -> True
      Corner _ _ turn -> turn < -Tolerance.tangential

-- | The branch along a piece of a site; none if another site gives it.
branchOf :: Double -> Followed -> (Double, Double, Bound) -> [Branch]
branchOf tolerance f (a, b, bound') = case bound' of
  Other k | k < own f -> []
  Itself -> [Sloping (discAt a) (discAt a) :| []]
  _ | isLevel, Just s <- levelArc f first a b -> [Level s (Mm first) :| []]
  _ -> [straight a (discAt a) b (discAt b)]
  where
    Mm first = discRadius (discAt a)
    isLevel = all (\t -> abs (radiusAt (a + t * (b - a)) - first) <= smallest) compared
    radiusAt u = let Mm r = discRadius (discAt u) in r
    compared = [0.25, 0.5, 1]
    Mm smallest = Tolerance.smallestDisc
    discAt u =
      let (p, n) = contact (site f) u
          r = min (most f) (radiusOf f u bound' `orAt` radius (sample f 0 u))
       in Disc (Vec.shift (Vec.scale r n) p) (Mm r)
    orAt r other = if isInfinite r then other else r
    -- Stretches between two shares, halved until they are near enough to the axis.
    straight u d v e
      | v - u <= Tolerance.finestShare || all (isNear d e) [0.25, 0.5, 0.75] = Sloping d e :| []
      | otherwise = let m = (u + v) / 2; h = discAt m in straight u d m h <> straight m h v e
      where
        isNear x y t = deviation x y (discAt (u + t * (v - u))) <= tolerance
    deviation x@(Disc _ (Mm r0)) y@(Disc _ (Mm r1)) (Disc c (Mm r)) =
      let axis = Vec.to (discCentre x) (discCentre y)
          l = Vec.dot axis axis
          t = if l > 0 then Vec.dot axis (Vec.to (discCentre x) c) / l else 0
          Mm off = Vec.distance (Vec.interpolate t (discCentre x) (discCentre y)) c
       in max off (abs (r0 + t * (r1 - r0) - r))

-- | The arc on which the centre of a disc of the radius @r@ moves along a piece of an arc or of a
-- corner; Nothing for a line.
levelArc :: Followed -> Double -> Double -> Double -> Maybe Segment
levelArc f r a b = case site f of
  Side (Straight _ _) -> Nothing
  Side Arc {centre = o, sweep = Rad w} -> Just (arcAbout o (w * (b - a)))
  Corner p _ turn -> Just (arcAbout p (turn * (b - a)))
  where
    arcAbout o w =
      let (p, n) = contact (site f) a
          begin = Vec.shift (Vec.scale r n) p
          stop = let (q, m) = contact (site f) b in Vec.shift (Vec.scale r m) q
       in if begin == stop && abs w <= pi then Straight begin stop else Arc begin stop o (Rad w)
