-- | Random pockets, and a simple, slow offset of their walls.
module Generate.Pocket
  ( Pocket (..),
    pocket,
    rectangle,
    roomOf,
    insetOf,
    pocketing,
    toolpathOf,
  )
where

import Base.Name (Name (..))
import Base.Quantity (Feed (..), Mm (..), Rad (..), plus)
import Base.Region (Located (Located), Region (Region))
import Base.Result (Result (..))
import Data.List (minimumBy, sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Ord (comparing)
import Generate qualified
import Geometry.Carrier (Circle (Circle), Sense (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox (BoundingBox))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Part.CutFeed (CutFeed (..))
import Part.Part (Milling (Milling), Pocketing (Pocketing))
import Part.Part qualified as Part
import Test.QuickCheck
import Toolpath.FromPart qualified as FromPart
import Toolpath.Pocket (Loop, PocketRoom (..))
import Toolpath.Toolpath (Toolpath)

-- | A pocket: its wall and its islands as loops with the free space on their left, the cutter's
-- radius, the allowance, the stepover.
data Pocket = Pocket {loops :: NonEmpty Loop, cutter :: Mm, left :: Mm, step :: Mm}
  deriving stock (Show)

-- | A pocket with up to three islands.
pocket :: Gen Pocket
pocket = do
  c <- Generate.contour <$> Generate.closedCase
  let outline = Polyarc.segments (if Polyarc.signedArea c > 0 then c else Polyarc.reverse c)
  islands <- foldl (\earlier _ -> earlier >>= island outline) (pure []) [1 :: Int .. 3]
  sized' (outline :| islands)

-- | A rectangle without islands, a few passes wide.
rectangle :: Gen Pocket
rectangle = do
  (w, h) <- (,) <$> choose (20, 90) <*> choose (20, 90)
  let ps = [Vec.point 0 0, Vec.point w 0, Vec.point w h, Vec.point 0 h]
  sized' (NonEmpty.fromList (zipWith Straight ps (drop 1 ps <> take 1 ps)) :| [])

-- | A pocket with the given loops, and a random cutter.
sized' :: NonEmpty Loop -> Gen Pocket
sized' loops = do
  r <- choose (2, 9)
  s <- oneof [choose (0.3, 1), choose (1, 2), pure 1, pure 2, choose (1.7, 2)]
  left <- oneof [pure 0, choose (0, 1)]
  pure Pocket {loops, cutter = Mm r, left = Mm left, step = Mm (r * s)}

-- | Adds a random island inside the outline, if it is more than 1 mm away from the outline and from
-- the islands before.
island :: Loop -> [Loop] -> Gen [Loop]
island outline before = do
  p <- Vec.point <$> choose (l, right) <*> choose (bottom, top)
  r <- choose (1, 9)
  k <- choose (3, 5)
  a <- choose (0, 2 * pi)
  round' <- arbitrary
  let corners =
        [ Vec.shift
            (Vec.polar (Mm r) (Rad (a - 2 * pi * fromIntegral i / fromIntegral (k :: Int))))
            p
          | i <- [0 .. k - 1]
        ]
      circle =
        let (one, other) =
              Segment.cutAt
                0.5
                ( Segment.fullCircle
                    Clockwise
                    (Circle p (Mm r))
                    (Vec.shift (Vec.polar (Mm r) (Rad a)) p)
                )
         in one :| [other]
      polygon = NonEmpty.fromList (zipWith Straight corners (drop 1 corners <> take 1 corners))
      fits =
        WindingNumber.about p outline /= 0
          && all
            (\s -> Distance.toPoint p s > Mm (r + 1))
            (concatMap NonEmpty.toList (outline : before))
          && all ((== 0) . WindingNumber.about p) before
  pure ([if round' then circle else polygon | fits] <> before)
  where
    BoundingBox l bottom right top = foldr1 BoundingBox.union (fmap BoundingBox.ofSegment outline)

-- | The pocketing of a pocket, 1.5 mm deep, with a clockwise spindle. There is an earlier pass for
-- each length of the list; its allowance is larger than that of the last pass by this length.
pocketing :: [Mm] -> Pocket -> Pocketing
pocketing before p =
  Pocketing
    { Part.wall =
        Milling
          { Part.contour = contourOf outline,
            Part.givesStart = False,
            Part.work = Part.Milled,
            Part.side = here Part.Inside,
            Part.radius = cutter p,
            Part.gear = Nothing,
            Part.engraver = Nothing,
            Part.places = Generate.noPlaces,
            Part.tolerance = Part.OnPath (Mm 0.03),
            Part.feed = here (PerMinute (Feed 60)),
            Part.approach = [],
            Part.retract = [],
            Part.levels = [Mm (-1.5)],
            Part.clearance = Just (Mm 5),
            Part.plunge = Nothing,
            Part.descent = here Part.Plunging,
            Part.materialTop = Mm 0,
            Part.tabs = Nothing,
            Part.leadIn = Nothing,
            Part.leadOut = Nothing,
            Part.allowances =
              foldr (\more rest -> plus more (left p) NonEmpty.<| rest) (left p :| []) before,
            Part.corners = Part.Round,
            Part.sense = Nothing,
            Part.spindleSense = Part.Clockwise,
            Part.controlCompensation = Nothing,
            Part.rest = Part.Allowed
          },
      Part.islands = map contourOf islands,
      Part.stepover = step p,
      Part.extent = Part.WholePocket
    }
  where
    outline :| islands = loops p
    contourOf loop =
      Part.Contour
        (here (Name "c"))
        Polyarc.Closed
        (fmap (\s -> Part.Element s (Region 0 0) Part.plainFinish False False Nothing Nothing) loop)
        []
        []

-- | The toolpath of a pocket, if the cutter has room in it.
toolpathOf :: Pocketing -> Maybe Toolpath
toolpathOf p =
  case FromPart.toToolpath
    (Generate.partOf (Vec.point 0 0) (Part.Pocket (here p)))
      { Part.start =
          Just (here (Part.SpacePoint (Vec.point 0 0) (Mm 20)))
      } of
    Result _ [] path -> path
    Result {} -> Nothing

here :: a -> Located a
here = Located (Region 0 0)

-- | The room of the cutter's centre, with offsets by 'insetOf'.
roomOf :: Pocket -> PocketRoom
roomOf p =
  PocketRoom
    { walls = NonEmpty.fromList (concatMap NonEmpty.toList (loops p)),
      offsetBy = insetOf (NonEmpty.toList (loops p)),
      insetOfLoops = \_ _ -> Nothing,
      radius = cutter p,
      leaves = left p,
      isReversed = False
    }

-- | The offset loops at a distance on the left of walls. Moves all segments, rounds all corners,
-- divides the segments where they intersect, keeps the parts that are not too near to the walls,
-- and joins them.
insetOf :: [Loop] -> Mm -> [Loop]
insetOf walls d@(Mm d') =
  joined [section | (i, s) <- numbered, section <- divided (others i) s, isAdmissible section]
  where
    numbered = zip [0 :: Int ..] (filter (\s -> Segment.length s > Mm 1e-9) (concatMap raw walls))
    others i = [s | (j, s) <- numbered, j /= i]
    raw loop =
      concat
        ( zipWith
            (\s next -> moved d' s <> rounding d' s next)
            (NonEmpty.toList loop)
            (NonEmpty.tail loop <> [NonEmpty.head loop])
        )
    isAdmissible section =
      Segment.length section > Mm 1e-7
        && all
          (\w -> Distance.toPoint (Segment.at 0.5 section) w > Mm (d' - 1e-7))
          (concatMap NonEmpty.toList walls)
        && d > Mm 0

-- | A segment moved to its left by a distance in mm; nothing if an arc vanishes.
moved :: Double -> Segment -> [Segment]
moved d s = case s of
  Straight a b ->
    let n = Vec.scale d (Vec.left (Vec.unit (Vec.to a b)))
     in [Straight (Vec.shift n a) (Vec.shift n b)]
  Arc {start = a, end = b, centre, sweep = w@(Rad angle)} ->
    let Mm r = Segment.radius centre a
        r' = r - signum angle * d
        to p = Vec.shift (Vec.scale (r' / r) (Vec.to centre p)) centre
     in [Arc {start = to a, end = to b, centre, sweep = w} | r' > 1e-6]

-- | The arc on the left at the corner between two segments, if the corner turns right.
rounding :: Double -> Segment -> Segment -> [Segment]
rounding d s next =
  [ Arc
      { start = beside (Segment.endDirection s),
        end = beside (Segment.startDirection next),
        centre = Segment.end s,
        sweep = Rad t
      }
    | t < -1e-9
  ]
  where
    Rad t = Vec.signedAngle (Segment.endDirection s) (Segment.startDirection next)
    beside direction = Vec.shift (Vec.scale d (Vec.left direction)) (Segment.end s)

-- | A segment, divided at its intersections with others.
divided :: [Segment] -> Segment -> [Segment]
divided others s =
  [ snd (Segment.cutAt (if b > 0 then a / b else 0) (fst (Segment.cutAt b s)))
    | (a, b) <- zip marks (drop 1 marks),
      b - a > 1e-9
  ]
  where
    marks =
      sort
        ( 0 :
          1 :
            [ t
              | other <- others,
                p <- Distance.intersections s other,
                let t = Segment.fraction s p,
                t > 1e-9,
                t < 1 - 1e-9
            ]
        )

-- | Joins segments whose ends coincide into loops.
joined :: [Segment] -> [Loop]
joined segments = case segments of
  [] -> []
  first : rest -> go (first :| []) rest
  where
    go chain rest
      | Vec.distance (end (NonEmpty.head chain)) (start (NonEmpty.last chain)) < Mm 1e-5 =
        NonEmpty.reverse chain : joined rest
      | otherwise = case rest of
        [] -> []
        some ->
          let (k, _) =
                minimumBy
                  (comparing snd)
                  (zip [0 ..] [Vec.distance (end (NonEmpty.head chain)) (start s) | s <- some])
              (before, from) = splitAt k some
           in case from of
                s : others
                  | Vec.distance (end (NonEmpty.head chain)) (start s) < Mm 1e-5 ->
                    go (NonEmpty.cons s chain) (before <> others)
                _ -> joined rest
