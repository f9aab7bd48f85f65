-- | Random contours of lines and arcs (convex and concave, smooth and with corners, open and
-- closed, of either sense), and random motions and frames.
module Generate
  ( Case (..),
    closedCase,
    openCase,
    smoothCase,
    radiusOf,
    milled,
    job,
    noPlaces,
    begin,
    outside,
    settings,
    partOf,
    straightPath,
    Motion (..),
    motion,
    move,
    movePoint,
    frames,
  )
where

import Base.Name (Name (..))
import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Feed (..), LengthUnit (..), Mm (..), Pulses (..), Rad (..), plus)
import Base.Region (Located (..), Region (..))
import Base.Result qualified as Result
import Data.List (sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Frame.Frame (Frame)
import Frame.Frame qualified as Frame
import Geometry.Carrier (Line (..), Sense (..), Side (..))
import Geometry.Construction.Fillet (Fillet (..))
import Geometry.Construction.Fillet qualified as Fillet
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (Arc, Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Offset.Equidistant (OffsetSegment)
import Offset.Equidistant qualified as Equidistant
import Part.ContourElement qualified as ContourElement
import Part.CutFeed (CutFeed (..))
import Part.Part (Element (..), Milling (Milling), Operation (..), Part (Part), Stop (Stop))
import Part.Part qualified as Part
import Test.QuickCheck
import Toolpath.FromPart qualified as FromPart
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | A contour, the side of the cutter, the radius of a cutter that fits, and the segments of the
-- equidistant.
data Case = Case {contour :: Polyarc, side :: Side, radius :: Mm, pieces :: NonEmpty OffsetSegment}
  deriving stock (Show)

-- | The radius of a case's cutter in mm.
radiusOf :: Case -> Double
radiusOf c = let Mm r = radius c in r

-- | Closed contours of either sense, some with sharp outer corners. The cutter is on either side.
closedCase :: Gen Case
closedCase = fitting (oneof [polygon True, arcPolygon]) =<< elements [LeftOf, RightOf]

-- | Closed contours without corners.
smoothCase :: Gen Case
smoothCase = fitting (polygon False) =<< elements [LeftOf, RightOf]

-- | An open contour: the first segments of a closed one.
openCase :: Gen Case
openCase = do
  s <- elements [LeftOf, RightOf]
  flip fitting s $ do
    Polyarc _ ss <- polygon True
    k <- choose (1, NonEmpty.length ss - 1)
    pure (Polyarc Open (NonEmpty.fromList (NonEmpty.take k ss)))

-- | A case from a generator of contours and a side. Contours and radii are generated until the
-- cutter fits.
fitting :: Gen Polyarc -> Side -> Gen Case
fitting gen side = do
  c <- gen
  reversed <- arbitrary
  r <- oneof [choose (0.1, 3), choose (3, 15)]
  let c' = if reversed then Polyarc.reverse c else c
  case Equidistant.equidistant side (Mm r) c' of
    Right pieces -> pure Case {contour = c', side, radius = Mm r, pieces}
    Left _ -> fitting gen side

-- | A star-shaped polygon with rounded corners. If the flag is true, some outer corners are sharp.
polygon :: Bool -> Gen Polyarc
polygon sharp = do
  vs <- vertices
  let n = length vs
      corner k = (vs !! ((k + n - 1) `mod` n), vs !! (k `mod` n), vs !! ((k + 1) `mod` n))
  roundings <- traverse (rounding . corner) [0 .. n - 1]
  let ends k = roundings !! (k `mod` n)
      sides =
        concat
          [ [Straight (snd' (ends k)) (fst' (ends (k + 1)))] <> middle' (ends (k + 1))
            | k <- [0 .. n - 1]
          ]
  pure (Polyarc Closed (NonEmpty.fromList (chained (filter ((> Mm 1e-3) . Segment.length) sides))))
  where
    chained ss = NonEmpty.toList (Polyarc.closeGaps id const Closed (NonEmpty.fromList ss))
    fst' (a, _, _) = a
    snd' (_, b, _) = b
    middle' (_, _, m) = m
    rounding (a, b, c) = do
      let u = Vec.unit (Vec.to a b)
          v = Vec.unit (Vec.to b c)
          Rad turned = Vec.signedAngle u v
          isOuter = turned > 0
          Mm before = Vec.distance a b
          Mm after = Vec.distance b c
          most = 0.45 * min before after / tan (abs turned / 2)
          sense = if isOuter then CounterClockwise else Clockwise
      r <- choose (0.3 * most, most)
      isSharp <- frequency [(2, pure False), (1, pure (sharp && isOuter))]
      pure $
        if isSharp || abs turned < 0.02
          then (b, b, [])
          else case Fillet.between (Mm r) sense (OnLine (Line a b)) (OnLine (Line b c)) of
            Fillet m p q : _ -> (p, q, [Segment.arc sense m p q])
            [] -> (b, b, [])

-- | A convex polygon of arcs, curved outwards or nearly straight, with sharp corners.
arcPolygon :: Gen Polyarc
arcPolygon = do
  n <- choose (2, 6)
  r <- choose (20, 60)
  let vs =
        [ Vec.shift
            (Vec.polar (Mm r) (Rad (2 * pi * fromIntegral k / fromIntegral n)))
            (Vec.point 7 (-3))
          | k <- [0 .. n - 1 :: Int]
        ]
  arcs <- traverse (uncurry arcOver) (zip vs (drop 1 vs <> take 1 vs))
  pure (Polyarc Closed (NonEmpty.fromList arcs))
  where
    -- An arc to the right of its chord, of a sweep of at most 100°.
    arcOver a b = do
      half <- choose (0.02, 0.87)
      let Mm chord = Vec.distance a b
          deep = chord / 2 / tan half
          c =
            Vec.shift (Vec.scale deep (Vec.left (Vec.unit (Vec.to a b)))) (Vec.interpolate 0.5 a b)
      pure (Segment.arc CounterClockwise c a b)

-- | The corners of a star-shaped polygon, counter-clockwise.
vertices :: Gen [Point]
vertices = do
  n <- choose (3, 9 :: Int)
  jitters <- sort <$> vectorOf n (choose (0, 0.8))
  radii <- vectorOf n (choose (30, 90))
  x <- choose (-200, 200)
  y <- choose (-200, 200)
  let angle k j = 2 * pi * (fromIntegral k + j) / fromIntegral n
  pure
    [ Vec.shift (Vec.polar (Mm r) (Rad (angle k j))) (Vec.point x y)
      | (k, j, r) <- zip3 [0 :: Int ..] jitters radii
    ]

-- | The toolpath of a case, milled with this tolerance.
milled :: Mm -> Case -> Maybe Toolpath
milled tolerance c =
  Result.output
    ( FromPart.toToolpath
        ( partOf
            (begin c)
            (Mill (Located (Region 0 0) (job c) {Part.tolerance = Part.OnPath tolerance}))
        )
    )

-- | The beginning of the equidistant of a case.
begin :: Case -> Point
begin c = Segment.start (Equidistant.segment (NonEmpty.head (pieces c)))

-- | Is the cutter outside the closed contour?
outside :: Case -> Bool
outside c = (Polyarc.signedArea (contour c) > 0) == (side c == RightOf)

-- | The milling of a case, with a rapid approach to the beginning of the equidistant.
job :: Case -> Milling
job c =
  Milling
    { Part.contour =
        Part.Contour
          (here (Name "c"))
          (ends (contour c))
          ( fmap
              (\s -> Element s (Region 0 0) Part.plainFinish False False Nothing Nothing)
              (segments (contour c))
          )
          []
          [],
      Part.givesStart = False,
      Part.work = Part.Milled,
      Part.side = here (case side c of LeftOf -> Part.LeftSide; RightOf -> Part.RightSide),
      Part.radius = radius c,
      Part.gear = Nothing,
      Part.engraver = Nothing,
      Part.places = noPlaces,
      Part.tolerance = Part.OnPath (Mm 0.02),
      Part.feed = here (PerMinute (Feed 60)),
      Part.approach = [Stop (here (begin c)) Nothing Part.Rapid],
      Part.retract = [],
      Part.levels = [],
      Part.clearance = Nothing,
      Part.plunge = Nothing,
      Part.descent = here Part.Plunging,
      Part.materialTop = Mm 0,
      Part.tabs = Nothing,
      Part.leadIn = Nothing,
      Part.leadOut = Nothing,
      Part.allowances = Mm 0 :| [],
      Part.corners = Part.Round,
      Part.sense = Nothing,
      Part.spindleSense = Part.Clockwise,
      Part.controlCompensation = Nothing,
      Part.rest = Part.Refused
    }
  where
    here = Located (Region 0 0)

-- | The places of a milling that no program gives.
noPlaces :: Part.MillingPlaces
noPlaces = Part.MillingPlaces (Region 0 0) Nothing (Region 0 0) Nothing Nothing Nothing

-- | Random settings of a milling: leads, corners, allowances and another starting point.
settings :: Gen (Milling -> Milling)
settings = do
  arc <- elements [Nothing, Just (Part.LeadLine, Mm 3), Just (Part.LeadArc, Mm 2)]
  out <- elements [Nothing, Just (Part.LeadLine, Mm 1), Just (Part.LeadArc, Mm 4)]
  style <- elements [Part.Round, Part.Sharp]
  several <- elements [Mm 0 :| [], Mm 0.2 :| [Mm 0]]
  near <- oneof [pure Nothing, Just <$> (Vec.point <$> choose (-200, 200) <*> choose (-200, 200))]
  pure $ \m ->
    m
      { Part.leadIn = arc,
        Part.leadOut = out,
        Part.corners = style,
        Part.allowances = several,
        Part.approach = [],
        Part.contour = maybe (Part.contour m) (`ContourElement.startingNear` Part.contour m) near
      }

-- | A part with one operation. The cutter starts at the point, at height 0.
partOf :: Point -> Operation -> Part
partOf at operation =
  Part
    { Part.name = Nothing,
      Part.title = Nothing,
      Part.machine = Nothing,
      Part.unit = Millimetres,
      Part.start = Just (Located (Region 0 0) (Part.SpacePoint at (Mm 0))),
      Part.firstCutter = cutter,
      Part.firstToolNumber = Nothing,
      Part.workOffset = Nothing,
      Part.programNumber = Nothing,
      Part.safeHeight = Nothing,
      Part.stock = Nothing,
      Part.avoided = [],
      Part.contours = [],
      Part.operations = [operation],
      Part.fittings = [],
      Part.assertedSizes = [],
      Part.readings = [],
      Part.namedPoints = []
    }
  where
    cutter = case operation of
      Part.Mill (Located _ m) -> mill m
      Part.Pocket (Located _ p) -> mill (Part.wall p)
      Part.Drill (Located _ d) ->
        Just (tool Part.DrillingCutter (Part.drillRadius d))
      Part.Carve (Located _ c) -> Just (vBit c)
      Part.Travel _ -> Nothing
      Part.Command _ -> Nothing
    tool kind r = Part.Cutter kind r Nothing Nothing r Part.plainBody
    vBit c =
      (tool Part.VBitCutter (plus (Part.carvingTip c) (Part.carvingDepth c)))
        { Part.tipRadius = Part.carvingTip c,
          Part.body =
            Part.plainBody {Part.pointAngle = Just (Rad (let Rad a = Part.halfAngle c in 2 * a))}
        }
    mill m = Just (tool Part.MillingCutter (Part.radius m))

-- | A toolpath of one rapid move, from (0, 0) to a point by its coordinates in mm.
straightPath :: Double -> Double -> Toolpath
straightPath x y =
  Toolpath.Toolpath
    (Located nowhere (Part.SpacePoint (Vec.point 0 0) (Mm 0)))
    [ Toolpath.Travelling
        (Mm 0)
        []
        [ Toolpath.Move
            (Straight (Vec.point 0 0) (Vec.point x y))
            (Toolpath.Manner (Mm 0, Mm 0) Part.Rapid False)
            nowhere
            False
        ]
    ]
    False
    Toolpath.noSetup
    Millimetres
  where
    nowhere = Region 0 0

-- | A motion of the plane: a reflection in the x axis if @mirrored@, a rotation, a translation.
data Motion = Motion {mirrored :: Bool, turned :: Rad, shifted :: Vec}
  deriving stock (Show)

-- | Random motions of the plane.
motion :: Gen Motion
motion =
  Motion
    <$> arbitrary
      <*> (Rad <$> choose (-4, 4))
      <*> (Vec.vec <$> choose (-500, 500) <*> choose (-500, 500))

-- | The image of a point.
movePoint :: Motion -> Point -> Point
movePoint m p = Vec.shift (shifted m) (Vec.shift (Vec.rotate (turned m) v) (Vec.point 0 0))
  where
    v = if mirrored m then Vec.vec (Vec.x p) (-(Vec.y p)) else Vec.vec (Vec.x p) (Vec.y p)

-- | The image of a segment.
move :: Motion -> Segment -> Segment
move m s = case s of
  Straight a b -> Straight (movePoint m a) (movePoint m b)
  Arc a b c (Rad sweep) ->
    Arc (movePoint m a) (movePoint m b) (movePoint m c) (Rad (if mirrored m then -sweep else sweep))

-- | Frames that the machine's tape can contain: straight motions, some with a command, and frames
-- with only a command.
frames :: Machine -> Gen [Frame]
frames machine = listOf (oneof (moving : [commanding | not (null commands)]))
  where
    moving = do
      d <- increment' `suchThat` (/= 0)
      code <- elements codes
      os <- frequency ((3, pure []) : [(1, given) | not (null commands)])
      pure
        (Frame.commandFrame os)
          { Frame.motion = Frame.Linear,
            Frame.increment = d,
            Frame.feedCode = code
          }
    commanding = Frame.commandFrame <$> given
    given = sequenceA [(o,) <$> choose (1, most) | (o, most) <- take 1 commands]
    commands =
      [ (o, most)
        | Machine.CommandWord {Machine.commandName = o, Machine.value = Machine.Argument} <-
            Machine.auxiliary (Machine.commandWords machine),
          Just most <- [Machine.commandCapacity machine o]
      ]
    codes = case Machine.codes (Machine.feeds machine) of
      Machine.Listed table -> Map.keys table
      Machine.Direct a b -> map Machine.FeedCode [a, (a + b) `div` 2, b]
    increment' = Pulses3 <$> part Machine.X <*> part Machine.Y <*> part Machine.Z
    part axis = do
      let Pulses c = min 1000000 (Machine.capacity machine axis)
      Pulses <$> oneof [pure 0, choose (-c, c), elements [c, -c, min c 1, -min c 1]]
