-- | The stock that a toolpath leaves, for reports and pictures. The proof follows the stock on the
-- tape by other means.
--
-- A move at feed removes the stock within the radius of its cutter, above the tip. A sloping move
-- counts by its highest height, a vertical one by its lowest. So at each height the stock is
-- removed in the union of the areas that the moves at or below this height sweep. It changes only
-- at the heights of moves. Between two of them the stock is a /layer/. The grooves of V-carvings
-- are left out, because each of their many slopes would be a layer.
module Toolpath.StockLayer
  ( StockLayer (..),
    stockLayers,
    volume,
    removedVolume,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, plus)
import Data.Containers.ListUtils (nubOrd)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Set qualified as Set
import Geometry.Polyarc (Ends (Closed), Polyarc (Polyarc))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.RegionBoolean (BooleanFault, BooleanOperation (..))
import Offset.RegionBoolean qualified as RegionBoolean
import Part.CutterBody qualified as CutterBody
import Part.Part (Solid (..))
import Part.Part qualified as Part
import Part.TurnedArea (OpenSide)
import Part.TurnedArea qualified as TurnedArea
import Toolpath.Toolpath (Move, Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | The stock between two heights, with its section, which is the same at all heights between them.
-- The polyarcs have the section on their left.
data StockLayer = StockLayer {bottom :: Mm, top :: Mm, section :: [Polyarc]}
  deriving stock (Eq, Show)

-- | The layers of the stock that a toolpath leaves, from the lowest one. The fault is that rounding
-- decides the region of a layer.
stockLayers :: Toolpath -> Solid -> Either BooleanFault [StockLayer]
stockLayers path solid
  | Toolpath.isTurned path = do
    gone <- joined (concat [turnedArea side r s | (side, r, s) <- nubOrd (turnedWays path)])
    layers gone (lowest solid) (highest solid)
  | otherwise = go Set.empty [] (Map.toAscList (sweeps path)) (lowest solid)
  where
    whole = map Part.polyarcOf (outlines solid)
    -- The passes of a statement at several depths sweep the same areas. Each is joined once.
    go known gone levels from = case levels of
      (z, ways) : more
        | z < highest solid -> do
          done <- layers gone from (max from z)
          let new = filter (`Set.notMember` known) (nubOrd ways)
          swept <- joined (map (uncurry sweptArea) new)
          gone' <- joined [gone, swept]
          (done <>) <$> go (foldr Set.insert known new) gone' more (max from z)
      _ -> layers gone from (highest solid)
    layers gone from to
      | from >= to = Right []
      | null gone = Right [StockLayer {bottom = from, top = to, section = whole}]
      | otherwise = do
        left <- combined Difference [whole, gone]
        Right [StockLayer {bottom = from, top = to, section = left}]

-- | The volume of the layers in mm³. A turned part turns about the axis y = 0, so its volume is 2π
-- times the first moment of its section (Pappus).
volume :: Toolpath -> [StockLayer] -> Double
volume path ls
  | Toolpath.isTurned path = 2 * pi * sum (map moment (concatMap section ls))
  | otherwise =
    sum
      [ let Mm h = minus (top l) (bottom l) in h * sum (map Polyarc.signedArea (section l))
        | l <- ls
      ]
  where
    moment = Vec.dot (Vec.vec 0 1) . Polyarc.firstMoment (Vec.point 0 0)

-- | The volume in mm³ that is removed of a solid so that the layers are left.
removedVolume :: Toolpath -> Solid -> [StockLayer] -> Double
removedVolume path solid ls = volume path [whole] - volume path ls
  where
    whole =
      StockLayer
        { bottom = lowest solid,
          top = highest solid,
          section = map Part.polyarcOf (outlines solid)
        }

-- | The radii and the paths of the moves that remove stock, by the height down to which each does.
sweeps :: Toolpath -> Map Mm [(Mm, Segment)]
sweeps path =
  Map.fromListWith (<>) . reverse $
    [ (plus (heightOf m) (CutterBody.pointHeight cutter), [(r, s)])
      | (Just cutter, b) <- Toolpath.withTools (Toolpath.setup path) (Toolpath.blocks path),
        let r = CutterBody.removalRadius cutter,
        r > Mm 0,
        not (isCarved b),
        m <- Toolpath.moves b,
        Toolpath.pace m /= Part.Rapid,
        s <- quarters (Toolpath.segment m)
    ]

-- | True for a V-carving.
isCarved :: Toolpath.Block -> Bool
isCarved b = case b of
  Toolpath.Carved {} -> True
  _ -> False

-- | The radii and the paths of the moves of turning tools at feed, each with the side from which
-- the tool comes, if it comes from one side only.
turnedWays :: Toolpath -> [(Maybe OpenSide, Mm, Segment)]
turnedWays path =
  [ (Toolpath.openSideOf path k, CutterBody.removalRadius cutter, s)
    | (k, (Just cutter, b)) <-
        zip (Toolpath.toolIndices blocks) (Toolpath.withTools (Toolpath.setup path) blocks),
      m <- Toolpath.moves b,
      Toolpath.pace m /= Part.Rapid,
      s <- quarters (Toolpath.segment m)
  ]
  where
    blocks = Toolpath.blocks path

-- | The area of the nose of a turning tool on its path, and the area behind it.
turnedArea :: Maybe OpenSide -> Mm -> Segment -> [[Polyarc]]
turnedArea side r s =
  [sweptArea r s | r > Mm 0]
    <> [ [if Polyarc.signedArea area < 0 then Polyarc.reverse area else area]
         | Just open <- [side],
           p : ps@(_ : _) <- [distinct (TurnedArea.areaBehind (Mm 0) open r s)],
           let ends' = NonEmpty.fromList (ps <> [p])
               area = Polyarc Closed (NonEmpty.zipWith Straight (p :| ps) ends'),
           abs (Polyarc.signedArea area) > 0
       ]
  where
    distinct ps = map NonEmpty.head (NonEmpty.group ps)

-- | The height down to which a move removes the stock.
heightOf :: Move -> Mm
heightOf m = case Toolpath.segment m of
  Straight p q | p == q -> min from to
  _ -> max from to
  where
    (from, to) = Toolpath.heights m

-- | A line, or the parts of an arc with sweeps of at most a quarter of a turn.
quarters :: Segment -> [Segment]
quarters s = case s of
  Straight _ _ -> [s]
  Arc {sweep = Rad w} ->
    let n = max 1 (ceiling (abs w / (pi / 2))) :: Int
        at k = fromIntegral k / fromIntegral n
     in [Segment.between (at k) (at (k + 1)) s | k <- [0 .. n - 1]]

-- | The region within a distance of a line, or of an arc of at most a quarter of a turn.
sweptArea :: Mm -> Segment -> [Polyarc]
sweptArea (Mm r) s = case s of
  Straight p q
    | p == q -> [Polyarc Closed (half p 0 :| [half p pi])]
    | otherwise ->
      let n = Vec.scale r (Vec.left (Vec.unit (Vec.to p q)))
          (a, b) = (beside p n, beside q n)
          (c, d) = (beside q (Vec.scale (-1) n), beside p (Vec.scale (-1) n))
       in [Polyarc Closed (Straight d c :| [cap q c b pi, Straight b a, cap p a d pi])]
  Arc {start, end, centre, sweep = Rad w}
    | w < 0 -> sweptArea (Mm r) (Segment.reverse s)
    | otherwise -> [Polyarc Closed (aroundArc r start end centre w)]
  where
    half p t = cap p (around p t) (around p (t + pi)) pi
    around p t = beside p (Vec.polar (Mm r) (Rad t))

-- | The outline of the region within the distance @r@ of a counter-clockwise arc of at most a
-- quarter of a turn. Where the arc's radius is less than @r@, the circles about its ends meet on
-- the inside.
aroundArc :: Double -> Point -> Point -> Point -> Double -> NonEmpty Segment
aroundArc r a b centre w
  | rho > r =
    outer :| [cap b b' b'' pi, inner, cap a a'' a' pi]
  | otherwise = outer :| [capTo b b' meeting, capTo a meeting a']
  where
    Mm rho = Vec.distance centre a
    outwards p d = beside p (Vec.scale d (Vec.unit (Vec.to centre p)))
    (a', b') = (outwards a r, outwards b r)
    (a'', b'') = (outwards a (-r), outwards b (-r))
    outer = Arc {start = a', end = b', centre, sweep = Rad w}
    inner = Arc {start = b'', end = a'', centre, sweep = Rad (-w)}
    middle = Vec.interpolate 0.5 a b
    chord = Vec.to a b
    Mm long = Vec.distance a b
    meeting =
      beside middle (Vec.scale (sqrt (max 0 (r * r - long * long / 4))) (Vec.left (Vec.unit chord)))
    capTo c from to =
      let Rad t = Vec.signedAngle (Vec.to c from) (Vec.to c to)
       in cap c from to (if t < 0 then t + 2 * pi else t)

-- | A counter-clockwise arc about a centre.
cap :: Point -> Point -> Point -> Double -> Segment
cap centre start end w = Arc {start, end, centre, sweep = Rad w}

beside :: Point -> Vec.Vec -> Point
beside p v = Vec.shift v p

-- | The union of regions. They are joined in halves, so that segments inside it are dropped early.
joined :: [[Polyarc]] -> Either BooleanFault [Polyarc]
joined regions = case filter (not . null) regions of
  [] -> Right []
  [one] -> Right one
  some -> do
    let (front, back) = splitAt (length some `div` 2) some
    a <- joined front
    b <- joined back
    combined Union [a, b]

-- | The result of a boolean operation as polyarcs.
combined :: BooleanOperation -> [[Polyarc]] -> Either BooleanFault [Polyarc]
combined operation regions =
  map (Polyarc Closed . fmap RegionBoolean.segment) <$> RegionBoolean.combine operation regions
