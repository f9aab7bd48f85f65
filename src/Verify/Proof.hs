-- | What the comparison of a tape with the part has shown.
module Verify.Proof
  ( Proof (..),
    ContourProof (..),
    Witness (..),
    Finding (..),
    Speed (..),
    Refusal (..),
    refusedFrame,
    isProven,
    toReports,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name)
import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Feed (..), Mm (..), Pulses (..))
import Base.Region (Located, Region)
import Control.Compensation (Unkept (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Frame (Broken)
import Frame.Frame qualified as Frame
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (CommandName (..), FeedCode (..), Machine)
import Machine.Machine qualified as Machine
import Report.Report (Report (label, message), ReportPlace (..), report)
import Report.Report qualified as Report

-- | A deviation of so much, in a frame, at an element of the part; where the point of the part or
-- the cutter's centre is.
data Witness = Witness {amount :: Mm, frame :: Int, element :: Region, place :: Point}
  deriving stock (Eq, Show)

-- | How one milled contour came out. A gouge or excess of less than nothing has no witness.
data ContourProof = ContourProof
  { contour :: Located Name,
    -- | the deepest cut into the part
    gouge :: Maybe Witness,
    -- | the most material left standing
    excess :: Maybe Witness,
    -- | tolerance and one pulse, into the material and out of it
    allowedGouge :: Mm,
    allowedExcess :: Mm
  }
  deriving stock (Eq, Show)

data Proof = Proof
  { frames :: Int,
    passages :: [ContourProof],
    -- | the last position less the one where the tape should end
    closure :: Pulses3,
    -- | the largest increment of each axis, whatever its sign
    largest :: Pulses3,
    -- | the first frame that is not as the program's own
    firstDifference :: Maybe Int,
    -- | in the order of the tape; none when the tape is proven
    findings :: [Finding]
  }
  deriving stock (Eq, Show)

-- | Why a tape is wrong.
data Finding
  = -- | the first frame that cuts too deep, the worst one, what is allowed
    Gouge Witness Witness Mm
  | -- | the first frame that leaves too much, the worst one, what is allowed
    Excess Witness Witness Mm
  | -- | the cutter runs along an element on its wrong side
    WrongSide Int Region
  | -- | the beginning of the contour is never reached
    NeverBegun Region
  | -- | the contour is not followed in order from its beginning to its end
    NotFollowed Region
  | -- centre of the cutter that would

    -- | a place of the floor of a pocket that the cutter can reach is not cleared at a height: the
    -- pocket, the height, the
    NotCleared Region Mm Point
  | -- | the depths of a pocket are not cut one after the other as the program does
    NotInOrder Region
  | -- | a frame that leaves the plane of the part
    OffPlane Int
  | -- | a hole that the tape does not drill to its depth
    HoleMissing Region Point
  | -- | a frame that goes below the top of the part where, or deeper than, the program does not:
    -- where
    CutsElsewhere Int Point
  | -- | the frame, its speed on the tape, the one that belongs there, what asks for it
    WrongFeed Int Speed Speed Region
  | -- | the frame, the command, its number on the tape and the one that belongs there, as far as
    -- there are any
    WrongCommand Int CommandName (Maybe Int) (Maybe Int)
  | -- | a frame that the control would not take
    Refused Refusal
  | -- may be

    -- | the frame at the end of which the cutter is too fast to come down to what follows: how fast
    -- it is, how fast it
    TooFast Int Feed Feed
  | NotClosed Pulses3
  deriving stock (Eq, Show)

-- | How fast a frame goes: in a rapid motion, or by its code; whether it slows down to that.
data Speed = Speed {rapidly :: Bool, code :: FeedCode, braking :: Bool}
  deriving stock (Eq, Show)

-- | Why a control would refuse a frame.
data Refusal
  = -- | a rule of the frames
    ByRule Broken
  | -- | the end of an arc is so much further from its centre than its beginning
    UnequalRadii Int Mm
  | -- | an arc whose end lies in the direction of its beginning from the centre, or at the centre
    NoSweep Int
  | -- | the cutter cannot be kept beside the contour
    NotKept Unkept
  deriving stock (Eq, Show)

isProven :: Proof -> Bool
isProven = null . findings

-- | The words for all findings.
toReports :: Machine -> Proof -> [Report]
toReports machine proof = map (withDifference . toReport machine) (findings proof)
  where
    withDifference r = r {message = message r <> difference}
    difference = case firstDifference proof of
      Just n ->
        ["The first frame that differs from this program's own is frame " <> Decimal.whole n <> "."]
      Nothing -> []

toReport :: Machine -> Finding -> Report
toReport machine finding = case finding of
  Gouge first worst allowed ->
    ( wrong
        "E0701"
        (InSource (element first))
        (frameWord (frame first) <> " cuts " <> micro (amount first) <> " into the part")
    )
      { label = "into this element",
        message =
          [ "The cutter's centre is then at "
              <> Vec.written 3 (place first)
              <> ". Allowed is a gouge of "
              <> micro allowed
              <> ", the tolerance and one pulse."
          ]
            <> [ "The deepest gouge is "
                   <> micro (amount worst)
                   <> ", in frame "
                   <> Decimal.whole (frame worst)
                   <> "."
                 | frame worst /= frame first
               ]
      }
  Excess w worst allowed ->
    ( wrong
        "E0702"
        (InSource (element w))
        (frameWord (frame w) <> " leaves " <> micro (amount w) <> " of material standing")
    )
      { label = "at this element",
        message =
          [ "It is worst at "
              <> Vec.written 3 (place w)
              <> ". Allowed is an excess of "
              <> micro allowed
              <> ", the tolerance and one pulse."
          ]
            <> [ "The most that is left is "
                   <> micro (amount worst)
                   <> ", in frame "
                   <> Decimal.whole (frame worst)
                   <> "."
                 | frame worst /= frame w
               ]
      }
  WrongSide n region ->
    wrong "E0703" (InSource region) (frameWord n <> " runs along this element on its wrong side")
  NeverBegun region ->
    wrong "E0704" (InSource region) "the tape never reaches the beginning of this contour"
  NotFollowed region ->
    wrong
      "E0709"
      (InSource region)
      "the tape does not follow this contour from its beginning to its end in the direction of the \
      \walk"
  NotCleared region z p ->
    ( wrong
        "E0714"
        (InSource region)
        ("the tape does not clear the floor of this pocket at " <> Vec.written 3 p)
    )
      { label = "at the height " <> Decimal.mm z,
        message = ["The cutter can stand there, and no frame comes within its radius."]
      }
  NotInOrder region ->
    wrong
      "E0715"
      (InSource region)
      "the tape does not clear the depths of this pocket in their order"
  OffPlane n -> wrong "E0705" InFile (frameWord n <> " leaves the plane of the part (it moves z)")
  HoleMissing region p ->
    wrong
      "E0710"
      (InSource region)
      ("the tape drills no hole of the right depth at " <> Vec.written 3 p)
  CutsElsewhere n p ->
    ( wrong
        "E0711"
        InFile
        (frameWord n <> " goes into the material where the program does not, or deeper")
    )
      { message = ["The cutter's centre is then at " <> Vec.written 3 p <> "."]
      }
  WrongFeed n found wanted region ->
    ( wrong
        "E0706"
        (InSource region)
        (frameWord n <> " runs at a wrong feed: " <> speed machine found)
    )
      { message = ["Here belongs " <> speed machine wanted <> "."]
      }
  WrongCommand n (CommandName name) found wanted ->
    ( wrong
        "E0708"
        InFile
        ( frameWord n
            <> maybe
              (" lacks the command " <> name)
              (\v -> " gives the command " <> name <> " " <> Decimal.whole v)
              found
        )
    )
      { message =
          [ maybe
              "The program gives no such command there."
              (\v -> "The program gives " <> name <> " " <> Decimal.whole v <> " there.")
              wanted
          ]
      }
  Refused refusal ->
    let (n, why, more) =
          refusalWords refusal
     in (wrong "E0712" InFile (frameWord n <> " " <> why)) {message = more}
  TooFast n (Feed is) (Feed may) ->
    ( wrong
        "E0713"
        InFile
        (frameWord n <> " is too fast at its end: " <> Decimal.short 2 is <> " mm/min")
    )
      { message =
          [ "To come down to the feeds that follow, or to the end of the tape, it may have "
              <> Decimal.short 2 may
              <> " mm/min there."
          ]
      }
  NotClosed (Pulses3 x y z) ->
    wrong
      "E0707"
      InFile
      ( "the tape does not end where it should: it misses by "
          <> Text.intercalate
            ", "
            [pulses d <> " in " <> axis | (axis, d) <- [("x", x), ("y", y), ("z", z)], d /= 0]
      )
  where
    wrong = report Report.Error
    frameWord n = "frame " <> Decimal.whole n
    micro (Mm x) = Decimal.fixed 4 x <> " mm"

-- | The frame that is refused.
refusedFrame :: Refusal -> Int
refusedFrame refusal = let (n, _, _) = refusalWords refusal in n

-- | The number of a frame, why a control refuses it, and what there is to say besides.
refusalWords :: Refusal -> (Int, Text, [Text])
refusalWords refusal = case refusal of
  ByRule broken -> case broken of
    Frame.OverCapacity n axis d ->
      (n, "moves " <> axisWord axis <> " by " <> pulses d <> ", more than its field holds", [])
    Frame.BadCentre n ->
      (n, "has no centre for its arc", ["It is missing, or it is more than its fields hold."])
    Frame.NoSuchSpeed n (FeedCode c) ->
      (n, "has the feed code " <> Decimal.whole c <> ", which the machine does not know there", [])
    Frame.NoSuchMotion n ->
      ( n,
        "asks for a motion that the machine does not have",
        [ "That is an arc where there are none, or one that rises or leaves its quadrant or is a \
          \full circle where it must not, or a motion that goes nowhere."
        ]
      )
    Frame.NoSuchOrder n (CommandName o) ->
      (n, "gives the command " <> o <> " twice, or with a number that it does not have", [])
    Frame.Idle n -> (n, "neither moves nor commands anything", [])
  UnequalRadii n (Mm d) ->
    ( n,
      "is an arc that ends "
        <> Decimal.fixed 4 (abs d)
        <> " mm "
        <> (if d > 0 then "further from" else "nearer to")
        <> " its centre than it begins",
      ["The two may differ by 2 pulses."]
    )
  NotKept unkept -> unkeptWords unkept
  NoSweep n ->
    ( n,
      "is an arc without a sweep",
      ["Its end lies in the same direction from the centre as its beginning, at another distance."]
    )
  where
    axisWord a = case a of
      Machine.X -> "x"
      Machine.Y -> "y"
      Machine.Z -> "z"

-- | The same of a control that keeps the cutter beside the contour.
unkeptWords :: Unkept -> (Int, Text, [Text])
unkeptWords unkept = case unkept of
  ShortEntry n l r ->
    ( n,
      "switches compensation on in a move that is too short",
      [ "It is "
          <> lengthOf l
          <> " long, and has to be longer than the cutter's radius, "
          <> lengthOf r
          <> "."
      ]
    )
  RoundEntry n -> (n, "switches compensation on in an arc", ["That takes a straight move."])
  RoundExit n -> (n, "leaves compensation in an arc", ["That takes a straight move."])
  TightArc n old r ->
    ( n,
      "is an arc of radius "
        <> lengthOf old
        <> " about whose inside the cutter has no room to roll",
      ["Its radius is " <> lengthOf r <> "."]
    )
  Unreached n ->
    ( n,
      "is too short for a corner into which the cutter does not fit",
      ["The cutter would cut into the move beside it."]
    )
  OnTwice n -> (n, "switches compensation on while it is on", [])
  ToolChanged n -> (n, "changes the tool while compensation is on", [])
  NeverReleased n -> (n, "ends the tape while compensation is on", [])
  where
    lengthOf (Mm x) = Decimal.fixed 3 x <> " mm"

-- | A speed as a person writes it.
speed :: Machine -> Speed -> Text
speed machine s = (if rapidly s then "rapid" else told) <> (if braking s then ", braking" else "")
  where
    told =
      "speed "
        <> Decimal.whole number
        <> maybe
          ""
          (\v -> " (" <> Decimal.short 2 v <> unit <> ")")
          (Machine.valueOf machine (code s))
    FeedCode number = code s
    unit = case Machine.feedMeasure (Machine.feeds machine) of
      Machine.AlongPath -> " mm/min"
      Machine.LeadingAxis -> " pulses a second"

pulses :: Pulses -> Text
pulses (Pulses n) = Decimal.whole n <> (if abs n == 1 then " pulse" else " pulses")
