-- | Answer to the request @run@: the frames of a tape with their times. The README of this folder
-- describes it.
module Preview.Playback
  ( runContainer,
    refusedContainer,
    isPulsed,
    dispatcherJobs,
  )
where

import Base.Decimal qualified as Decimal
import Base.LazyList (LazyList)
import Base.LazyList qualified as LazyList
import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..), degrees)
import Data.Aeson (Value, object, (.=))
import Data.Aeson.Types (Pair)
import Data.ByteString.Lazy (ByteString)
import Data.Maybe (fromMaybe, isJust, isNothing)
import Data.Text (Text)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Frame.Frame (Frame (braking))
import Machine.Axis (axisName, rotaryName)
import Machine.Controller (ControlJob (jobName), Controller (..), IntegratorControl (jobs))
import Machine.Machine (CommandName (..), Machine, MachineName (..), RotaryForm (pulseAngle))
import Machine.Machine qualified as Machine
import Preview.Container (Numbers (..))
import Preview.Container qualified as Container
import Preview.ReportList qualified as ReportList
import Preview.Subject (Followed (..))
import Preview.Subject qualified as Subject
import Preview.TapeRun (FrameFact (FrameFact), TapeRun (..))
import Preview.TapeRun qualified as TapeRun
import Pulse.Controller qualified as Controller
import Pulse.ControllerRun (StopReason (Unreadable))
import Pulse.FramePath (FramePath (..))
import Pulse.FramePath qualified as FramePath
import Pulse.RunMeasure (FrameMeasure (..), RunTotal (..))
import Pulse.RunMeasure qualified as Measure
import Pulse.Steps (Pulses5 (..))
import Pulse.Steps qualified as Steps
import Pulse.StopText qualified as StopText
import Report.Report (Report)
import Tape.Punch (TapeFrame (rowsRead))
import Tape.Punch qualified as Punch
import Tape.Tape (Tape (..))

-- | Answer to the request @run@ for a tape. The cutter moves evenly within the frames if the
-- controller is not described or makes no pulses.
runContainer :: Followed -> TapeRun -> [Report] -> ByteString
runContainer followed played reports = Container.encode members columns
  where
    members =
      commonMembers followed played (reports <> damages)
        <> [ "clock" .= fromMaybe 1 (Controller.ticksPerSecond (machine played)),
             "start" .= millimetresOf (machine played) (startOf played),
             "stop" .= maybe "" (StopText.stopText (machine played) . stopReason) total,
             "pulsed" .= isNothing uneven,
             "why" .= uneven,
             "text" .= fmap fst (text played),
             "jobs" .= map jobName (dispatcherJobs (machine played)),
             "commands" .= concatMap commandEntries (zip [0 ..] frames)
           ]
    columns =
      [ ("frame", Reals (concat (zipWith (motionNumbers (machine played)) positions frames))),
        ("frameNumber", Wholes (map number frames)),
        ("frameTick", Reals (concatMap tickNumbers frames)),
        ("frameInfo", Wholes (concatMap (infoNumbers played) frames)),
        ("frameFeed", Reals (concatMap (feedNumbers (machine played)) frames)),
        ("frameRow", Wholes (concatMap (rowNumbers (rowsOfFrames played)) frames)),
        ("tape", Octets (if isJust (text played) then "" else punchedRows))
      ]
    damages = case stopReason <$> total of
      Just (Unreadable damage) -> [Punch.toReport damage]
      _ -> []
    uneven = unevenReason played total
    Tape punchedRows = rows played
    measured = measuresOf played
    frames = maybe [] LazyList.toList measured
    total = LazyList.end <$> measured
    positions = startOf played : map (Steps.plus (startOf played) . positionAfter) frames

-- | Answer to the request @run@ for a machine for which the program has no tape.
refusedContainer :: Followed -> Text -> [Report] -> ByteString
refusedContainer followed name reports =
  Container.encode
    ( headMembers followed name name reports
        <> [ "clock" .= (1 :: Int),
             "start" .= [0, 0, 0 :: Double],
             "stop" .= ("" :: Text),
             "pulsed" .= False,
             "why" .= ("There is no tape for this machine." :: Text),
             "axes" .= ([] :: [Value]),
             "tracks" .= (0 :: Int),
             "text" .= (Nothing :: Maybe Text),
             "jobs" .= ([] :: [Text]),
             "commands" .= ([] :: [Value])
           ]
    )
    [ ("frame", Reals []),
      ("frameNumber", Wholes []),
      ("frameTick", Reals []),
      ("frameInfo", Wholes []),
      ("frameFeed", Reals []),
      ("frameRow", Wholes []),
      ("tape", Octets "")
    ]

headMembers :: Followed -> Text -> Text -> [Report] -> [Pair]
headMembers followed name title reports =
  [ "version" .= version followed,
    "machine" .= name,
    "title" .= title,
    "reports" .= ReportList.reportList (fileName followed) (Subject.soundSource followed) reports
  ]

commonMembers :: Followed -> TapeRun -> [Report] -> [Pair]
commonMembers followed played@TapeRun {machine} reports =
  headMembers followed name (Machine.title machine) reports
    <> [ "axes" .= axisEntries machine,
         "tracks"
           .= if isJust (text played) then 0 else Machine.tracks (Machine.medium machine)
       ]
  where
    MachineName name = Machine.name machine

-- | Five axes with their pulses in mm or in degrees.
axisEntries :: Machine -> [Value]
axisEntries machine =
  [ object ["name" .= axisName a, "pulse" .= (if a `elem` driven then pulseOf a else 0)]
    | a <- [minBound .. maxBound]
  ]
    <> [ object
           [ "name" .= rotaryName a,
             "pulse" .= maybe 0 (degrees . pulseAngle) (Machine.rotaryForm machine a)
           ]
         | a <- [minBound .. maxBound]
       ]
  where
    driven = Machine.drivenAxes machine
    pulseOf a = let Mm p = Machine.resolutionOf machine a in p

-- | Jobs of the dispatcher; none without a dispatcher.
dispatcherJobs :: Machine -> [ControlJob]
dispatcherJobs machine = case Machine.controller machine of
  Just (Integrating control) -> jobs control
  Just (Stepping _) -> []
  Just (Planning _) -> []
  Nothing -> []

measuresOf :: TapeRun -> Maybe (LazyList RunTotal FrameMeasure)
measuresOf TapeRun {machine, console, start, rows} = Controller.measured machine console start rows

startOf :: TapeRun -> Pulses5
startOf TapeRun {start = Pulses3 (Pulses x) (Pulses y) (Pulses z)} = Pulses5 x y z 0 0

-- | Position along x, y and z in mm.
millimetresOf :: Machine -> Pulses5 -> [Double]
millimetresOf machine (Pulses5 x y z _ _) =
  [ fromIntegral n * p
    | (n, a) <- zip [x, y, z] [minBound .. maxBound],
      let Mm p = Machine.resolutionOf machine a
  ]

-- | Reason why the page moves the cutter evenly within each frame; Nothing if it gets the pulses.
unevenReason :: TapeRun -> Maybe RunTotal -> Maybe Text
unevenReason played total = case (Machine.controller (machine played), total) of
  (Nothing, _) -> Just "The description of this machine has no controller."
  (Just (Planning _), _) ->
    Just
      "The model of this control gives times only: within a frame the cutter is shown at its mean \
      \feed."
  (_, Just t)
    | sum (Steps.toList (totalPulses t)) > mostPulses ->
      Just
        ( "The run has more than "
            <> Decimal.whole mostPulses
            <> " pulses: within a frame the cutter is shown at its mean feed."
        )
  _ -> Nothing

-- | True if the page gets the pulses of a tape.
isPulsed :: TapeRun -> Bool
isPulsed played = isNothing (unevenReason played (LazyList.end <$> measuresOf played))

-- | Greatest count of pulses that the page gets.
mostPulses :: Int
mostPulses = 4000000

-- | Nine numbers of the motion of a frame from a position: a segment, and the heights of its ends.
motionNumbers :: Machine -> Pulses5 -> FrameMeasure -> [Double]
motionNumbers machine from f = case (millimetresOf machine from, millimetresOf machine to) of
  ([x, y, z], [x', y', z']) -> [x, y, x', y'] <> round' x y <> [z, z']
  _ -> []
  where
    to = maybe from (Steps.plus from . FramePath.endOf) (centrePath f)
    Mm pulse = Machine.planeResolution machine
    round' x y = case centrePath f of
      Just path@Arc {clockwise, FramePath.from = (a, b)} ->
        [ x - fromIntegral a * pulse,
          y - fromIntegral b * pulse,
          (if clockwise then negate else id) (FramePath.sweep path)
        ]
      Just (Line _) -> [0, 0, 0]
      Nothing -> [0, 0, 0]

tickNumbers :: FrameMeasure -> [Double]
tickNumbers f = map fromIntegral [beginsAt f, endsAt f, waitedFor f]

-- | Kind, tool, file, line and braking of a frame.
infoNumbers :: TapeRun -> FrameMeasure -> [Int]
infoNumbers TapeRun {machine, facts} f = [kind, tool, file, line, fromEnum (braking (frame f))]
  where
    known = facts Vector.!? (number f - 1)
    FrameFact {TapeRun.isCut, TapeRun.tool, TapeRun.file, TapeRun.line} =
      fromMaybe (FrameFact True (-1) (-1) 0) known
    kind
      | isNothing (centrePath f) = 3
      | not (Measure.isAtFeed machine (frame f)) = 0
      | isCut = 2
      | otherwise = 1

-- | Feed that a frame asks and its mean feed, in mm\/min.
feedNumbers :: Machine -> FrameMeasure -> [Double]
feedNumbers machine f =
  [ fromMaybe 0 (centrePath f >>= \p -> asked f >>= FramePath.feedAlong machine p),
    maybe 0 (\(mean, _, _) -> mean) (feeds f)
  ]

commandEntries :: (Int, FrameMeasure) -> [Value]
commandEntries (index, f) =
  [ object ["frame" .= index, "tick" .= t, "text" .= (c <> " " <> Decimal.whole n)]
    | (t, CommandName c, n) <- commands f
  ]

-- | First row of each frame in order, and at the end the row behind the last frame; for a text, the
-- index of its line and of the next one.
rowsOfFrames :: TapeRun -> Vector (Int, Int)
rowsOfFrames played@TapeRun {machine, start, rows} = Vector.fromList $ case text played of
  Just (_, numbers) -> [(n - 1, n) | n <- numbers]
  Nothing ->
    let ends = scanl (+) 0 (map rowsRead (LazyList.toList (Punch.readInTurn machine start rows)))
     in zip ends (drop 1 ends)

rowNumbers :: Vector (Int, Int) -> FrameMeasure -> [Int]
rowNumbers ranges f = maybe [0, 0] (\(a, b) -> [a, b]) (ranges Vector.!? (number f - 1))
