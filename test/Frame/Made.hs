-- | Frames for the laws: toolpaths of small programs, their frames, and the segments that the
-- frames describe.
module Frame.Made
  ( pathOf,
    pathAlong,
    quantised,
    program,
    frameSegments,
    arcCount,
    isArc,
    largestDistance,
    nodesOf,
  )
where

import Base.Quantity (LengthUnit (..), Mm (..))
import Base.Region (Located (..), Region (Region))
import Base.Result (Result)
import Base.Result qualified as Result
import Checked.FromSurface qualified as Checked
import Data.Functor.Identity (runIdentity)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Frame.Error (Error, Warning)
import Frame.Frame (Frame (..), FrameProgram (plannedFrames), PlannedFrame (frame))
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as FromToolpath
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Machine.Machine (Machine)
import Part.FromChecked qualified as Part
import Part.Part (Pace, SpacePoint (SpacePoint))
import Surface.Import qualified as Surface
import Surface.Parameter qualified as Surface
import Toolpath.FromPart qualified as Toolpath
import Toolpath.Toolpath (Block (..), Move (Move), Toolpath (Toolpath))
import Toolpath.Toolpath qualified as Toolpath

-- | Toolpath of a program without errors.
pathOf :: Text -> Toolpath
pathOf text = need "path" (Toolpath.toToolpath part)
  where
    loaded = runIdentity (Surface.load (Surface.byName (const (pure (Left "")))) "test.part" text)
    assigned = need "assignments" (Surface.assign [] (need "syntax" (Surface.surface loaded)))
    part = need "part" (Part.evaluate (need "types" (Checked.check assigned)))
    need :: String -> Result w e a -> a
    need what = fromMaybe (error ("the program of the test has no " <> what)) . Result.output

-- | Toolpath of linking moves along consecutive segments, at one height.
pathAlong :: Pace -> [Segment] -> Toolpath
pathAlong pace segments = case segments of
  [] -> error "a path of nothing"
  s : _ ->
    Toolpath
      (Located nowhere (SpacePoint (Segment.start s) (Mm 0)))
      [ Travelling
          (Mm 0)
          []
          [Move x (Toolpath.Manner (Mm 0, Mm 0) pace False) nowhere False | x <- segments]
      ]
      False
      Toolpath.noSetup
      Millimetres
  where
    nowhere = Region 0 0

quantised :: Machine -> Toolpath -> Result Warning Error FrameProgram
quantised = FromToolpath.quantise

program :: Machine -> Toolpath -> Maybe FrameProgram
program machine = Result.ifSound . quantised machine

-- | Line or arc of each frame in the plane.
frameSegments :: Machine -> FrameProgram -> [Segment]
frameSegments machine p =
  zipWith (Frame.segment machine) (scanl (+) (Frame.start p) (map increment frames)) frames
  where
    frames = map frame (plannedFrames p)

isArc :: Frame -> Bool
isArc f = case motion f of
  Frame.Circular _ -> True
  _ -> False

arcCount :: FrameProgram -> Int
arcCount = length . filter (isArc . frame) . plannedFrames

-- | Largest distance in mm of the points of @these@ from @those@. Each segment has up to 25 points,
-- fewer if there are many segments.
largestDistance :: [Segment] -> [Segment] -> Double
largestDistance those these =
  maximum
    ( 0 :
        [ minimum [d | s <- those, let Mm d = Distance.toPoint p s]
          | t <- these,
            k <- [0 .. parts],
            let p = Segment.at (fromIntegral k / fromIntegral parts) t
        ]
    )
  where
    parts = max 2 (min 24 (1000 `div` max 1 (length these))) :: Int

-- | Ends of the moves along contours.
nodesOf :: Toolpath -> [Point]
nodesOf path =
  [ Segment.end (Toolpath.segment m)
    | Cutting {cut} <- Toolpath.blocks path,
      m <- NonEmpty.toList cut
  ]
