-- | The controller of a machine, as data: how it makes pulses of frames, and at which times. The
-- folder @src/Pulse@ has the model that runs a tape on it.
--
-- A tick is one period of the controller's clock. All times of a controller are whole ticks.
module Machine.Controller
  ( Controller (..),
    StepControl (..),
    InterpolationMethod (..),
    IntegratorControl (..),
    PathControl (..),
    CornerPolicy (..),
    TapeReader (..),
    SpeedRamp (..),
    FrequencyLimits (..),
    frequencyLimits,
    noLimits,

    -- * Jobs of the feed integrator
    ControlJob (..),
    JobRequest (..),
    jobFor,
    requestInterval,
    ticksIn,
    makesPulses,
    capacity,
  )
where

import Base.Quantity (Seconds (..))
import Data.List (find)
import Data.Text (Text)
import Machine.FrameLayout (CommandName)

-- | Controller of a machine.
data Controller
  = -- | pulses in time, from a digital differential analyser or from evaluation functions
    Stepping StepControl
  | -- | pulses in time, from a feed integrator and a dispatcher, which runs all other jobs
    Integrating IntegratorControl
  | -- | no pulses: only the times of motions are modelled
    Planning PathControl
  deriving stock (Eq, Show)

-- | True if the model of a controller makes pulses in time.
makesPulses :: Controller -> Bool
makesPulses control = case control of
  Stepping _ -> True
  Integrating _ -> True
  Planning _ -> False

-- | Control that makes pulses of one frame after the other and does nothing else.
data StepControl = StepControl
  { interpolation :: InterpolationMethod,
    -- | frequency of the clock, in ticks per second
    stepClock :: Int,
    -- | ramp at a rising feed; 'Nothing' if the feed jumps
    ramp :: Maybe SpeedRamp,
    -- | 'Nothing' if the controller works away from the machine, so that no frame is waited for
    stepReader :: Maybe TapeReader,
    stepLimits :: FrequencyLimits
  }
  deriving stock (Eq, Show)

-- | Algorithm that distributes the pulses of a frame over the axes.
data InterpolationMethod
  = -- | The leading axis steps evenly, the others by their remainders. There are no arcs.
    DifferentialAnalyser
  | -- | One axis steps at a time. The sign of an evaluation function decides which one.
    EvaluationFunction
  deriving stock (Eq, Show)

-- | Limits of the drives of the axes, in pulses per second. 'Nothing' for a limit that is not
-- known.
data FrequencyLimits = FrequencyLimits
  { -- | highest mean frequency of an axis in a frame
    highestFrequency :: Maybe Double,
    -- | largest jump of the frequency of an axis at the joint of two frames
    largestJump :: Maybe Double
  }
  deriving stock (Eq, Show)

-- | Acceleration in mm/s², and the time from one change of the feed to the next.
data SpeedRamp = SpeedRamp {acceleration :: Double, interval :: Seconds}
  deriving stock (Eq, Show)

-- | Reader of the tape.
data TapeReader = TapeReader
  { rowsPerSecond :: Double,
    -- | time from the start of the tape to the reading of its next row
    startTime :: Seconds,
    -- | count of frames that are read before the first one begins
    framesAhead :: Int,
    -- | signal of the control if it cannot read a frame
    faultSignal :: Maybe Text
  }
  deriving stock (Eq, Show)

-- | Control with a feed integrator. In each tick a cell U grows by the content of a cell V, which
-- is the feed. Each overflow of U starts one interpolation cycle.
data IntegratorControl = IntegratorControl
  { -- | frequency of the clock, in ticks per second
    clock :: Int,
    -- | count of bits of the cell U, whose capacity is 2 to the power of this count
    bits :: Int,
    reader :: TapeReader,
    -- | acceleration along the path, in mm/s²
    pathAcceleration :: Double,
    -- | positions of the switch that corrects the feed, in percent, the lowest first
    override :: [Int],
    -- | ticks of an interpolation cycle on a line
    lineCycle :: Int,
    -- | ticks of an interpolation cycle on an arc
    arcCycle :: Int,
    -- | count of switches that correct a dimension, such as the radius of a cutter
    switches :: Int,
    driveLimits :: FrequencyLimits,
    -- | all other jobs, the most urgent first
    jobs :: [ControlJob]
  }
  deriving stock (Eq, Show)

-- | Job of the dispatcher beside the interpolation cycle.
data ControlJob = ControlJob
  { jobName :: Text,
    -- | duration in ticks
    duration :: Int,
    -- | The waiting job with the lowest number is the first to be tried.
    priority :: Int,
    request :: JobRequest
  }
  deriving stock (Eq, Show)

-- | Event that requests a job.
data JobRequest
  = -- | A character of the next frame is read.
    AtCharacter
  | -- | The last character of a word of the next frame is read.
    AtNumber
  | -- | The frame is finished, and the next one is read.
    AtTransfer
  | -- | The next frame is read, and cutter compensation is on.
    AtCompensation
  | -- | On an arc, the first number of interpolation cycles has passed. The job computes V for the
    -- direction that the arc has after the second number of cycles.
    AtDirection Int Int
  | -- | This time has passed. The job changes V by the acceleration.
    AtAcceleration Seconds
  | -- | This time has passed.
    Periodic Seconds
  | -- | A frame has given this command. The job is requested after this time, this many times.
    AfterCommand CommandName Seconds Int
  deriving stock (Eq, Show)

-- | Control of which only the times of motions are modelled.
data PathControl = PathControl
  { -- | acceleration along the path, in mm/s²
    plannedAcceleration :: Double,
    corners :: CornerPolicy
  }
  deriving stock (Eq, Show)

-- | Motion from one frame to the next.
data CornerPolicy
  = -- | The machine stops at the end of each frame.
    ExactStop
  | -- | The next frame begins when the present one starts to decelerate.
    Blending
  deriving stock (Eq, Show)

-- | Limits of the drives of a machine.
frequencyLimits :: Controller -> FrequencyLimits
frequencyLimits control = case control of
  Stepping c -> stepLimits c
  Integrating c -> driveLimits c
  Planning _ -> noLimits

-- | Limits that are not known.
noLimits :: FrequencyLimits
noLimits = FrequencyLimits {highestFrequency = Nothing, largestJump = Nothing}

-- | First job with a request that satisfies the predicate.
jobFor :: (JobRequest -> Bool) -> IntegratorControl -> Maybe ControlJob
jobFor wanted control = find (wanted . request) (jobs control)

-- | Whole number of ticks that is nearest to a time, at least 1, for a clock of the given
-- frequency in ticks per second.
ticksIn :: Int -> Seconds -> Int
ticksIn frequency (Seconds t) = max 1 (round (t * fromIntegral frequency))

-- | Ticks between two requests of a job, if the clock or the speed of the reader sets them.
requestInterval :: IntegratorControl -> JobRequest -> Maybe Int
requestInterval control r = case r of
  AtCharacter -> Just (max 1 (floor (perSecond / rowsPerSecond (reader control))))
  AtAcceleration t -> Just (ticksIn (clock control) t)
  Periodic t -> Just (ticksIn (clock control) t)
  AtNumber -> Nothing
  AtTransfer -> Nothing
  AtCompensation -> Nothing
  AtDirection _ _ -> Nothing
  AfterCommand {} -> Nothing
  where
    perSecond = fromIntegral (clock control)

-- | Capacity of the cell U: the sum at which it overflows.
capacity :: IntegratorControl -> Int
capacity control = 2 ^ bits control
