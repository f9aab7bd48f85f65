-- | Run of a tape as a table, as JSON lines, or as a stream of pulses.
--
-- All forms are streams: a line is written when its frame has ended, so a long tape needs little
-- memory. Columns have fixed widths for the same reason.
module Cli.RunTable
  ( frameLines,
    frameJson,
    totalLines,
    totalJson,
    pulseLines,
    axisNames,
  )
where

import Base.Decimal qualified as Decimal
import Base.LazyList (LazyList)
import Base.LazyList qualified as LazyList
import Cli.Table (Align (..))
import Cli.Table qualified as Table
import Data.Aeson (object, (.=))
import Data.Aeson qualified as Aeson
import Data.Aeson.Key qualified as Key
import Data.ByteString.Builder (Builder)
import Data.ByteString.Builder qualified as Builder
import Data.ByteString.Lazy qualified as LazyByteString
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Machine.Axis (axisName, rotaryName)
import Machine.Machine
  ( AxisForm (axis, reversed),
    CommandName (..),
    Machine,
    RotaryForm (rotaryAxis, turnsReversed),
  )
import Machine.Machine qualified as Machine
import Pulse.ControllerRun (ControllerRun (..), FrameStart (..), StopReason (..), Tick)
import Pulse.FramePath (AskedFeed (..))
import Pulse.RunMeasure (FrameMeasure, FrequencyPeak (..), JobLoad (..), RunTotal (..))
import Pulse.RunMeasure qualified as Measure
import Pulse.Steps (Pulses5)
import Pulse.Steps qualified as Steps
import Pulse.StopText qualified as StopText

-- | Axes of a machine: the index of each in a vector of five pulses, and its name.
axisNames :: Machine -> [(Int, Text)]
axisNames machine =
  [ (fromEnum a, axisName a)
    | a <- [minBound ..],
      a `elem` map axis (NonEmpty.toList (Machine.axes machine))
  ]
    <> [ (3 + fromEnum a, rotaryName a)
         | a <- [minBound ..],
           a `elem` map rotaryAxis (Machine.rotaryAxes machine)
       ]

-- Frames ------------------------------------------------------------------------------------------

-- | Lines of the table for all frames. The second argument is the frequency of the clock; the third
-- tells which frames are shown, by their numbers.
frameLines ::
  Machine -> Int -> (Int -> Bool) -> LazyList RunTotal FrameMeasure -> LazyList RunTotal Builder
frameLines machine clock isShown measured =
  LazyList.Next (textLine heading) (eachShown isShown (textLine . row) measured)
  where
    axes = axisNames machine
    heading =
      cells
        ( ["frame", "begins s", "takes s", "waits s"]
            <> map snd axes
            <> ["asked", "mean", "least", "highest", "Hz", "jump"]
        )
        <> "  commands"
    row m =
      cells
        ( [ Decimal.whole (Measure.number m),
            seconds clock (Measure.beginsAt m),
            seconds clock (Measure.endsAt m - Measure.beginsAt m),
            if Measure.waitedFor m > 0 then seconds clock (Measure.waitedFor m) else ""
          ]
            <> [Decimal.whole (Steps.component k (Measure.pulses m)) | (k, _) <- axes]
            <> [maybe "" askedText (Measure.asked m)]
            <> maybe ["", "", ""] feedTexts (Measure.feeds m)
            <> [frequency (Measure.frequencies m), frequency (Measure.jumps m)]
        )
        <> Text.concat
          ["  " <> c <> " " <> Decimal.whole n | (_, CommandName c, n) <- Measure.commands m]
    feedTexts (a, b, c) = map (Decimal.short 2) [a, b, c]
    frequency hz = let v = maximum (0 : hz) in if v > 0 then Decimal.short 1 v else ""
    cells ts = Text.concat (zipWith (\w t -> Text.justifyRight w ' ' (" " <> t)) (7 : repeat 10) ts)

-- | A part for each frame that is shown.
eachShown ::
  (Int -> Bool) -> (FrameMeasure -> Builder) -> LazyList e FrameMeasure -> LazyList e Builder
eachShown isShown part = go
  where
    go list = case list of
      LazyList.End total -> LazyList.End total
      LazyList.Next m more
        | isShown (Measure.number m) -> LazyList.Next (part m) (go more)
        | otherwise -> go more

askedText :: AskedFeed -> Text
askedText a = case a of
  Along v -> Decimal.short 2 v
  Turning v -> Decimal.short 2 v
  OfLeadingAxis hz -> Decimal.short 1 hz <> " Hz"

-- | Time in seconds with three decimals.
seconds :: Int -> Tick -> Text
seconds clock t = Decimal.fixed 3 (fromIntegral t / fromIntegral clock)

textLine :: Text -> Builder
textLine t = Encoding.encodeUtf8Builder (Text.stripEnd t <> "\n")

-- | JSON objects of all frames, one on each line.
frameJson ::
  Machine -> Int -> (Int -> Bool) -> LazyList RunTotal FrameMeasure -> LazyList RunTotal Builder
frameJson machine clock isShown = eachShown isShown (jsonLine . value)
  where
    value m =
      object
        [ "frame" .= Measure.number m,
          "begins" .= inSeconds clock (Measure.beginsAt m),
          "ends" .= inSeconds clock (Measure.endsAt m),
          "waited" .= inSeconds clock (Measure.waitedFor m),
          "pulses" .= perAxis machine (Measure.pulses m),
          "position" .= perAxis machine (Measure.positionAfter m),
          "asked" .= fmap askedJson (Measure.asked m),
          "feed"
            .= fmap
              (\(a, b, c) -> object ["mean" .= a, "least" .= b, "highest" .= c])
              (Measure.feeds m),
          "frequency" .= perAxisOf (Measure.frequencies m),
          "jump" .= perAxisOf (Measure.jumps m),
          "commands"
            .= [ object ["name" .= c, "number" .= n, "at" .= inSeconds clock t]
                 | (t, CommandName c, n) <- Measure.commands m
               ]
        ]
    -- A frame that takes no time has no frequencies.
    perAxisOf hz =
      object [Key.fromText name .= v | (k, name) <- axisNames machine, v <- take 1 (drop k hz)]
    askedJson a = case a of
      Along v -> object ["mm/min" .= v]
      Turning v -> object ["degrees/min" .= v]
      OfLeadingAxis hz -> object ["Hz" .= hz]

inSeconds :: Int -> Tick -> Double
inSeconds clock t = fromIntegral t / fromIntegral clock

perAxis :: Machine -> Pulses5 -> Aeson.Value
perAxis machine v =
  object [Key.fromText name .= Steps.component k v | (k, name) <- axisNames machine]

jsonLine :: Aeson.Value -> Builder
jsonLine v = Builder.lazyByteString (Aeson.encode v <> LazyByteString.singleton 10)

-- Totals ------------------------------------------------------------------------------------------

-- | The tables after the frames: times of the whole tape, pulses and frequencies of its axes, and
-- the load of the dispatcher.
totalLines :: Machine -> Int -> RunTotal -> Text
totalLines machine clock total =
  Text.concat
    [ "\n" <> table
      | table <- [timeTable machine clock total, axisTable machine total, jobTable clock total],
        not (Text.null table)
    ]

timeTable :: Machine -> Int -> RunTotal -> Text
timeTable machine clock total =
  Table.columns
    [ToLeft, ToLeft]
    [ ["time", seconds clock (totalTicks total) <> " s"],
      ["waits for the reader", seconds clock (totalWaited total) <> " s"],
      [ "frames that wait between two feed moves",
        Decimal.whole (starved total)
          <> maybe "" ((", the first is frame " <>) . Decimal.whole) (firstStarved total)
      ],
      ["stops", StopText.stopText machine (stopReason total)]
    ]

axisTable :: Machine -> RunTotal -> Text
axisTable machine total =
  Table.columns
    [ToLeft, ToRight, ToRight, ToRight, ToRight, ToRight]
    ( ["axis", "pulses", "highest Hz", "in frame", "largest jump Hz", "in frame"] :
        [ [name, Decimal.whole (Steps.component k (totalPulses total))]
            <> concatMap peakCells (take 1 (drop k (peaks total)))
            <> concatMap peakCells (take 1 (drop k (largestJumps total)))
          | (k, name) <- axisNames machine
        ]
    )
  where
    peakCells peak
      | peakFrame peak == 0 = ["", ""]
      | otherwise = [Decimal.short 1 (peakHz peak), Decimal.whole (peakFrame peak)]

-- | Empty for a controller without a dispatcher.
jobTable :: Int -> RunTotal -> Text
jobTable clock total
  | Map.null (loads total) = ""
  | otherwise =
    Table.columns
      [ToLeft, ToRight, ToRight, ToRight]
      ( ["job", "runs", "load %", "longest wait ms"] :
          [ [ name,
              Decimal.whole (runCount l),
              Decimal.fixed 2 (100 * share (runTicks l)),
              Decimal.fixed 3 (1000 * inSeconds clock (longestWait l))
            ]
            | (name, l) <- Map.toList (loads total)
          ]
      )
  where
    share t = fromIntegral t / fromIntegral (max 1 (totalTicks total))

-- | JSON object with the times, pulses and loads of the whole tape.
totalJson :: Machine -> Int -> RunTotal -> Builder
totalJson machine clock total =
  jsonLine
    ( object
        [ "total"
            .= object
              [ "time" .= inSeconds clock (totalTicks total),
                "waited" .= inSeconds clock (totalWaited total),
                "starved" .= starved total,
                "firstStarved" .= firstStarved total,
                "pulses" .= perAxis machine (totalPulses total),
                "highestFrequency" .= perAxisPeaks (peaks total),
                "largestJump" .= perAxisPeaks (largestJumps total),
                "stop" .= StopText.stopText machine (stopReason total),
                "jobs"
                  .= object
                    [ Key.fromText name
                        .= object
                          [ "runs" .= runCount l,
                            "time" .= inSeconds clock (runTicks l),
                            "longestWait" .= inSeconds clock (longestWait l)
                          ]
                      | (name, l) <- Map.toList (loads total)
                    ]
              ]
        ]
    )
  where
    perAxisPeaks found =
      object
        [ Key.fromText name .= object ["Hz" .= peakHz peak, "frame" .= peakFrame peak]
          | (k, name) <- axisNames machine,
            peak <- take 1 (drop k found)
        ]

-- Pulses ------------------------------------------------------------------------------------------

-- | Pulses of the frames that are shown, one on each line: the axis, the sign, and the tick. The
-- signs are those of the machine's axes, as on the tape.
pulseLines :: Machine -> (Int -> Bool) -> ControllerRun -> LazyList StopReason Builder
pulseLines machine isShown = go False
  where
    axes = [(k, name, if isReversed k then -1 else 1) | (k, name) <- axisNames machine]
    isReversed k =
      or [reversed f | f <- NonEmpty.toList (Machine.axes machine), fromEnum (axis f) == k]
        || or [turnsReversed f | f <- Machine.rotaryAxes machine, 3 + fromEnum (rotaryAxis f) == k]
    go shown run = case run of
      FrameBegins s more -> go (isShown (number s)) more
      Stepped t steps more
        | shown -> LazyList.Next (mconcat [line t steps axis | axis <- axes]) (go shown more)
        | otherwise -> go shown more
      FrameEnds _ more -> go shown more
      Commanded _ _ _ more -> go shown more
      JobDone _ more -> go shown more
      Stopped _ why -> LazyList.End why
    line t steps (k, name, sign) = case sign * Steps.onAxis k steps of
      0 -> mempty
      s ->
        Encoding.encodeUtf8Builder name
          <> Builder.charUtf8 ' '
          <> Builder.charUtf8 (if s > 0 then '+' else '-')
          <> Builder.charUtf8 ' '
          <> Builder.intDec t
          <> Builder.charUtf8 '\n'
