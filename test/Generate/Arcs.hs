-- | Frames with arcs by a simple method, and their deviation from a contour by sampling. The tests
-- of the verification use both, because they do not depend on the code that is tested.
module Generate.Arcs
  ( quantise,
    Deviation (..),
    deviation,
    pathDeviation,
    change,
  )
where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Feed (..), Mm (..), Pulses (..), Rad (..))
import Base.Region (Located (..))
import Data.List (minimumBy)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Ord (comparing)
import Frame.Frame
  ( Frame (..),
    FrameMotion (..),
    FrameProgram (FrameProgram),
    PlannedFrame (PlannedFrame, cutterRadius, origin, toolIndex),
    Role (..),
  )
import Frame.Frame qualified as Frame
import Geometry.Carrier (Sense (..))
import Geometry.Segment (Segment (Arc, Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Axis (..), FeedCode (..), Machine)
import Machine.Machine qualified as Machine
import Part.CutFeed qualified as CutFeed
import Part.Part (SpacePoint (..))
import Part.Part qualified as Part
import Test.QuickCheck
import Toolpath.Toolpath (Move, Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | The frames of a toolpath on a machine with arcs, without braking and without commands. Every
-- number of the frames must fit the machine's words.
quantise :: Machine -> Toolpath -> FrameProgram
quantise machine path =
  FrameProgram begin (go begin (concat (zipWith block [0 ..] (Toolpath.blocks path))))
  where
    Located _ (SpacePoint p z) = Toolpath.start path
    begin = rounded machine (p, z)
    block n b = case b of
      Toolpath.Travelling r _ ms -> map (Linking,r,) ms
      Toolpath.Holing (Located _ d) ms -> map (Drilling n,Part.drillRadius d,) ms
      Toolpath.Carved (Located _ c) ms _ ->
        map (Carving n,Part.carvingTip c,) (NonEmpty.toList ms)
      Toolpath.Commanding _ -> []
      Toolpath.Clearing
        { Toolpath.pocket = Located _ pocket,
          Toolpath.approach,
          Toolpath.cleared,
          Toolpath.retract
        } ->
          let r = Part.radius (Part.wall pocket)
           in map (Approaching n,r,) approach
                <> map (Cutting n,r,) (NonEmpty.toList cleared)
                <> map (Retracting n,r,) retract
      Toolpath.Cutting
        { Toolpath.job = Located _ m,
          Toolpath.approach,
          Toolpath.cut,
          Toolpath.retract
        } ->
          map (Approaching n,Part.radius m,) approach
            <> map (Cutting n,Part.radius m,) (NonEmpty.toList cut)
            <> map (Retracting n,Part.radius m,) retract
    go at moves = case moves of
      [] -> []
      (role, cutterRadius, m) : rest ->
        let fs = framesOf machine at m
         in [ PlannedFrame
                { Frame.frame = f,
                  Frame.role = role,
                  origin = Toolpath.origin m,
                  cutterRadius,
                  toolIndex = 0
                }
              | f <- fs
            ]
              <> go (at + sum (map increment fs)) rest

-- | A position, given by its point in the plane and its height, rounded to whole pulses.
rounded :: Machine -> (Point, Mm) -> Pulses3
rounded machine (p, Mm z) = Pulses3 (on X (Vec.x p)) (on Y (Vec.y p)) (on Z z)
  where
    on axis v = let Mm step = Machine.resolutionOf machine axis in Pulses (round (v / step))

-- | The frames of one move, from the given position.
framesOf :: Machine -> Pulses3 -> Move -> [Frame]
framesOf machine at m = case Toolpath.segment m of
  s@Arc {} -> snd (foldl next (at, []) (inQuadrants s))
  Straight _ q
    | isRapid -> map rapidly (straight (FeedCode 0) at (rounded machine (q, above)))
    | otherwise -> straight speed' at (rounded machine (q, above))
  where
    (_, above) = Toolpath.heights m
    isRapid = Toolpath.pace m == Part.Rapid && Machine.hasRapidMotion machine
    rapidly f = f {motion = Rapid}
    next (p, done) part =
      let fs =
            arcFrames machine speed' (fst (Toolpath.heights m)) p part
       in (p + sum (map increment fs), done <> fs)
    speed' = case Toolpath.pace m of
      Part.Rapid -> Machine.rapidCode machine
      Part.At (Located _ f) -> case Machine.choose machine . inMm <$> CutFeed.perMinute f of
        Just (Machine.Given c _) -> c
        _ -> Machine.rapidCode machine
    inMm (Feed v) = v
    inQuadrants s = case Machine.arcs machine of
      Machine.Arcs {Machine.quadrants = True} -> quarters s
      _ -> [s]

straight :: FeedCode -> Pulses3 -> Pulses3 -> [Frame]
straight code from to =
  [ Frame
      { motion = Linear,
        increment = to - from,
        turn = 0,
        centre = 0,
        feedCode = code,
        braking = False,
        commands = []
      }
    | to /= from
  ]

-- | An arc, divided where it crosses the axes through its centre.
quarters :: Segment -> [Segment]
quarters s = case s of
  Straight _ _ -> [s]
  Arc begins _ middle (Rad turned) ->
    let Rad begin = Vec.angle (Vec.to middle begins)
        cuts =
          [ t
            | k <- [-8 .. 8 :: Int],
              let t = (fromIntegral k * pi / 2 - begin) / turned,
              t > 1e-6,
              t < 1 - 1e-6
          ]
        marks = 0 : (if turned > 0 then cuts else reverse cuts) <> [1]
     in [section a b | (a, b) <- zip marks (drop 1 marks)]
  where
    section a b =
      let upTo =
            if b < 1 then fst (Segment.cutAt b s) else s
       in if a > 0 then snd (Segment.cutAt (a / b) upTo) else upTo

-- | The frames of an arc at the height @z@, from the position @at@. One frame is enough if, with a
-- centre in whole pulses, it deviates from the arc by at most one pulse. Otherwise the arc is
-- halved.
arcFrames :: Machine -> FeedCode -> Mm -> Pulses3 -> Segment -> [Frame]
arcFrames machine code z at s = case (Segment.sagitta s, candidates) of
  (Mm sagitta, _) | sagitta < pulse / 2 -> straight code at end
  (_, []) -> halves
  (_, fs) ->
    let (d, f) =
          minimumBy (comparing fst) [(arcDeviation machine at s f', f') | f' <- fs]
     in if d <= pulse then [f] else halves
  where
    Mm pulse = Machine.planeResolution machine
    end = rounded machine (Segment.end s, z)
    candidates =
      [ f
        | f <- [about (Pulses2 (i + Pulses a) (j + Pulses b)) | a <- [-3 .. 3], b <- [-3 .. 3]],
          null (Frame.violations machine [f]),
          apart f <= 2 * pulse
      ]
    Pulses3 i j _ = rounded machine (Segment.centre s, z) - at
    about c =
      Frame
        { motion = Circular (if positive then CounterClockwise else Clockwise),
          increment = end - at,
          turn = 0,
          centre = c,
          feedCode = code,
          braking = False,
          commands = []
        }
    Rad turned = Segment.sweep s
    positive = turned > 0
    apart f = let (a, b) = arcRadii machine at f in abs (a - b)
    halves =
      let (a, b) = Segment.cutAt 0.5 s
          first = arcFrames machine code z at a
       in first <> arcFrames machine code z (at + sum (map increment first)) b

-- | The largest distance between a frame's arc and the intended arc, at sample points, in mm. A
-- control may use the radius at the start or at the end of the frame, so both are sampled. A frame
-- whose sweep differs by more than 1 rad has the distance 1e9.
arcDeviation :: Machine -> Pulses3 -> Segment -> Frame -> Double
arcDeviation machine at s f =
  maximum
    ( (if abs (sweep - turned) > 1 then 1e9 else 0) :
        [ abs
            ( between
                (Vec.shift (Vec.polar (Mm r) (Rad (begin + sweep * k / 8))) c)
                (Segment.centre s)
                - exact
            )
          | r <- [a, b],
            k <- [0 .. 8]
        ]
    )
  where
    c = Frame.centreOf machine at f
    (a, b) = arcRadii machine at f
    exact = between (Segment.start s) (Segment.centre s)
    Rad turned = Segment.sweep s
    Rad sweep = Segment.sweep (Frame.segment machine at f)
    Rad begin = Vec.angle (Vec.to c (Frame.position machine at))

-- | The distances of a frame's start and end from the centre of its arc, in mm.
arcRadii :: Machine -> Pulses3 -> Frame -> (Double, Double)
arcRadii machine at f =
  ( between (Frame.position machine at) c,
    between (Frame.position machine (at + increment f)) c
  )
  where
    c = Frame.centreOf machine at f

between :: Point -> Point -> Double
between p q = let Mm d = Vec.distance p q in d

-- | The deepest gouge and the largest excess, in mm.
data Deviation = Deviation {deepestGouge :: Double, largestExcess :: Double}
  deriving stock (Show)

-- | Deviation of frames from a contour, in mm, for a cutter of this radius that begins at @begin@.
deviation :: Machine -> Pulses3 -> [Frame] -> [Segment] -> Double -> Deviation
deviation machine begin frames =
  pathDeviation (zipWith (Frame.segment machine) (scanl (+) begin (map increment frames)) frames)

-- | Deviation of a path of the cutter's centre from a contour, in mm, by dense samples of both.
pathDeviation :: [Segment] -> [Segment] -> Double -> Deviation
pathDeviation path contour radius =
  Deviation
    { deepestGouge = radius - minimum [nearest onContour p | p <- onPath],
      largestExcess = maximum [nearest onPath q | q <- onContour] - radius
    }
  where
    onContour = concatMap (dense 0.4) contour
    onPath = concatMap (dense 0.2) path
    nearest ps q =
      sqrt (minimum [(Vec.x p - Vec.x q) ^ (2 :: Int) + (Vec.y p - Vec.y q) ^ (2 :: Int) | p <- ps])

-- | Points of a segment with its ends, at most @apart@ mm from one another. On an arc they are also
-- at most an eighth of a turn apart, because a short arc may have a large sweep, and so near that
-- the arc is nowhere further than 0.0003 mm from the tangent at the nearest point.
dense :: Double -> Segment -> [Point]
dense apart s = [Segment.at (fromIntegral k / fromIntegral n) s | k <- [0 .. n]]
  where
    Mm l = Segment.length s
    n = max 1 (max (ceiling (l / apart)) onArc) :: Int
    onArc = case s of
      Straight _ _ -> 1
      Arc {Segment.start = a, Segment.centre = c, Segment.sweep = Rad sweep} ->
        let Mm r = Vec.distance a c
         in ceiling (max (abs sweep * 4 / pi) (l / sqrt (0.0024 * max 0.001 r)))

-- | Frames with one random mistake, and a description of the mistake.
change :: [Frame] -> Gen (String, [Frame])
change frames = do
  n <- choose (0, length frames - 1)
  d <- Pulses <$> elements [1, -1, 2, -2, 3, -3, 100, -100]
  let f = frames !! n
      with f' = take n frames <> [f'] <> drop (n + 1) frames
      -- If @isCompensated@, the next frame has the opposite change of its increment.
      changed isCompensated f' = case drop (n + 1) frames of
        g : rest
          | isCompensated ->
            take n frames <> [f', g {increment = increment g + increment f - increment f'}] <> rest
        _ -> with f'
      Pulses3 x y _ = increment f
      Pulses2 i j = centre f
  isCompensated <- arbitrary
  oneof $
    [ pure ("x by " <> show d, changed isCompensated f {increment = increment f + Pulses3 d 0 0}),
      pure ("y by " <> show d, changed isCompensated f {increment = increment f + Pulses3 0 d 0}),
      pure ("lost", take n frames <> drop (n + 1) frames),
      pure ("doubled", take (n + 1) frames <> drop n frames)
    ]
      <> case motion f of
        Circular sense ->
          [ pure ("i by " <> show d, with f {centre = centre f + Pulses2 d 0}),
            pure ("j by " <> show d, with f {centre = centre f + Pulses2 0 d}),
            pure
              ( "the long way round",
                with
                  f {motion = Circular (if sense == Clockwise then CounterClockwise else Clockwise)}
              ),
            pure ("the centre on the other side", with f {centre = Pulses2 (x - i) (y - j)}),
            pure
              ( "both",
                with
                  f
                    { motion =
                        Circular
                          (if sense == Clockwise then CounterClockwise else Clockwise),
                      centre = Pulses2 (x - i) (y - j)
                    }
              ),
            pure ("its chord", with f {motion = Linear, centre = 0})
          ]
        _ -> []
