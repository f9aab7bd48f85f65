-- | Result of the comparison of a tape with the part: the findings, the largest deviations of each
-- contour, and the reports for a user. A tape without findings is proven.
module Verify.Proof
  ( Proof (..),
    ContourProof (..),
    Witness (..),
    deepest,
    deeper,
    Finding (..),
    tapeOrder,
    isOffContour,
    Speed (..),
    Refusal (..),
    isProven,
    toReports,
    findingReports,
    frameOf,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name)
import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Feed (..), LengthUnit (..), Mm (..), Pulses (..))
import Base.Region (Located, Region)
import Control.Compensation (CompensationError)
import Control.CompensationCheck qualified as CompensationCheck
import Data.List (foldl')
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Frame (Violation)
import Frame.Frame qualified as Frame
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (CommandName (..), FeedCode, Machine, RotaryAxis)
import Machine.Machine qualified as Machine
import Part.Part (CutSense (..))
import Report.Report (Label (..), Report (hints, label, message, others), ReportPlace (..), report)
import Report.Report qualified as Report
import Verify.CollisionFinding (Collision (frameOfCollision))
import Verify.CollisionFinding qualified as CollisionFinding
import Verify.ControlFault (ControlFinding)

-- | Witness of a deviation from the part: how large the deviation is, and where.
data Witness = Witness
  { -- | size of the deviation, in mm
    amount :: Mm,
    -- | number of the frame, from 1; if 'location' is a point of an element or of a rim, the number
    -- of the frame whose motion is nearest to it
    frame :: Int,
    -- | region of the contour element in the part program
    element :: Region,
    -- | position of the cutter's centre; for excess on an element, a point of the element; for
    -- excess in a pocket, a point of the pocket's rim ("Verify.Pocket")
    location :: Point
  }
  deriving stock (Eq, Show)

-- | Witness of the larger of two deviations; the first one if they are equal. If the first one is
-- Nothing, the result is the second one.
deeper :: Maybe Witness -> Witness -> Witness
deeper best w = case best of
  Just b | amount b >= amount w -> b
  _ -> w

-- | Witness of the largest deviation, and of several equal ones the first; Nothing for an empty
-- list.
deepest :: [Witness] -> Maybe Witness
deepest = foldl' (\best w -> Just (deeper best w)) Nothing

-- | Deviations of one contour in one pass.
data ContourProof = ContourProof
  { contour :: Located Name,
    -- | deepest gouge; Nothing if the cutter keeps its distance everywhere
    gouge :: Maybe Witness,
    -- | largest excess; Nothing if no material remains
    excess :: Maybe Witness,
    -- | allowed deviations into the part and away from it: the tolerance plus one pulse each; the
    -- allowed excess in a pocket is a little larger ("Verify.PocketDeviation")
    allowedGouge :: Mm,
    allowedExcess :: Mm
  }
  deriving stock (Eq, Show)

-- | Proof of a tape: the result of its comparison with the part.
data Proof = Proof
  { -- | number of frames on the tape
    frames :: Int,
    contourProofs :: [ContourProof],
    -- | last position on the tape minus the position where it has to end
    closure :: Pulses3,
    -- | largest increment in one frame, along each axis, without its sign
    largestIncrement :: Pulses3,
    -- | number, from 1, of the first frame that differs from the planned one; Nothing if no frame
    -- does
    firstDifference :: Maybe Int,
    -- | in the order of the tape; empty if the tape is proven
    findings :: [Finding],
    -- | faults of the state of a modern control; empty for a tape
    controlFindings :: [ControlFinding],
    -- | what a modern control may leave the path by, and what positions are away from the grid of
    -- the machine, in mm; it counts in all deviations
    mayLeave :: Mm
  }
  deriving stock (Eq, Show)

-- | Fault of a tape. An 'Int' is the number of a frame, from 1, unless the comment says otherwise.
data Finding
  = -- | Gouge: the deviation in the first frame that cuts too deep, the deepest deviation, the
    -- allowed depth.
    Gouge Witness Witness Mm
  | -- | Excess: the deviation in the first frame that leaves too much, the largest deviation, the
    -- allowed excess.
    Excess Witness Witness Mm
  | -- | The cutter runs along an element on its wrong side: the frame, the element.
    WrongSide Int Region
  | -- | The tape never reaches the start of a contour: the statement, the position and the height
    -- at which the cutter's centre should begin; the top of the part is 0.
    NeverBegun Region Point Mm
  | -- | The tape does not follow a contour from its start to its end: the statement.
    NotFollowed Region
  | -- | The tape leaves material on the floor of a pocket: the statement, the height, a position
    -- that the cutter's centre can reach but that is not cleared.
    NotCleared Region Mm Point
  | -- | The tape does not clear the depths of a pocket in the order of the program: the statement.
    NotInOrder Region
  | -- | A wall of a pocket is cut in the direction that the program does not ask for: the frame,
    -- the region that asks for a direction, this direction.
    AgainstSense Int Region CutSense
  | -- | A frame leaves the plane of a flat part.
    OffPlane Int
  | -- | A tool touches what it must not.
    Collides Collision
  | -- | The first frame that turns a rotary axis, which the proof cannot judge: the frame, the
    -- axis. All findings of such a tape are of this kind.
    TurnsAxis Int RotaryAxis
  | -- | A hole is not drilled to its depth: the region of the hole, its centre.
    HoleMissing Region Point
  | -- | The cone of a V-carving cuts beyond the edge of its area: the frame, the position of the
    -- centre, how far beyond the edge, the statement.
    CarvesBeyond Int Point Mm Region
  | -- | A V-carving leaves material at an edge of its area: the statement, a point of the edge.
    EdgeNotCarved Region Point
  | -- | A frame cuts below the top of the part where the program does not cut, or deeper than the
    -- program does: the frame, the position of the cutter's centre.
    CutsElsewhere Int Point
  | -- | A frame runs along none of the moves that the program asks for at this place in the order:
    -- the frame, the position of the cutter's centre at its end.
    NotAsked Int Point
  | -- | The tape lacks a move: the region that asks for it, its end.
    MoveMissing Region Point
  | -- | Wrong feed: the frame, its speed, the demanded speed, the region that demands it.
    WrongFeed Int Speed Speed Region
  | -- | Wrong command: the frame, the command, its number on the tape, its number in the program.
    -- A number is Nothing if the command is not given there.
    WrongCommand Int CommandName (Maybe Int) (Maybe Int)
  | -- | The control refuses a frame.
    Refused Refusal
  | -- | The cutter is too fast at the end of a frame to slow down for the frames after it: the
    -- frame, the speed there, the largest speed that is possible there.
    TooFast Int Feed Feed
  | -- | The control may leave a contour by more than is allowed: the contour, what the path mode
    -- allows, the deviation of the path, and what is allowed in all.
    LeavesPath Region Mm Mm Mm
  | -- | The tape does not end where it has to: its last position minus the required one, in pulses.
    NotClosed Pulses3
  deriving stock (Eq, Show)

-- | Sort key of findings: the number of the frame, and a rank within the frame, lower for more
-- important findings. Findings without a frame come first, a wrong last position comes last.
tapeOrder :: Finding -> (Int, Int)
tapeOrder finding = case finding of
  Gouge w _ _ -> (frame w, 0)
  Excess w _ _ -> (frame w, 1)
  WrongSide n _ -> (n, 2)
  NeverBegun {} -> (0, 3)
  NotFollowed _ -> (0, 3)
  NotCleared {} -> (0, 3)
  NotInOrder _ -> (0, 3)
  AgainstSense n _ _ -> (n, 3)
  Collides c -> (frameOfCollision c, 4)
  OffPlane n -> (n, 4)
  TurnsAxis n _ -> (n, 4)
  HoleMissing _ _ -> (0, 4)
  CarvesBeyond n _ _ _ -> (n, 0)
  EdgeNotCarved _ _ -> (0, 4)
  CutsElsewhere n _ -> (n, 4)
  NotAsked n _ -> (n, 4)
  MoveMissing _ _ -> (0, 4)
  WrongFeed n _ _ _ -> (n, 5)
  TooFast n _ _ -> (n, 6)
  WrongCommand n _ _ _ -> (n, 7)
  Refused refusal -> (refusedFrame refusal, 8)
  LeavesPath {} -> (0, 8)
  NotClosed _ -> (maxBound, 9)

-- | Test that a finding means that the cutter leaves a contour or a pocket. A wrong last position
-- is then a consequence, and is not reported.
isOffContour :: Finding -> Bool
isOffContour finding = case finding of
  Gouge {} -> True
  Excess {} -> True
  WrongSide {} -> True
  NeverBegun {} -> True
  NotFollowed {} -> True
  NotCleared {} -> True
  NotInOrder {} -> False
  AgainstSense {} -> False
  Collides {} -> False
  OffPlane {} -> False
  TurnsAxis {} -> False
  HoleMissing {} -> False
  CarvesBeyond {} -> False
  EdgeNotCarved {} -> False
  CutsElsewhere {} -> False
  NotAsked {} -> False
  MoveMissing {} -> False
  WrongFeed {} -> False
  WrongCommand {} -> False
  TooFast {} -> False
  Refused _ -> False
  LeavesPath {} -> False
  NotClosed {} -> False

-- | Speed of a frame: the feed code, or rapid if @rapidly@ is true. If @braking@ is true, it is the
-- speed at the end of the frame.
data Speed = Speed {rapidly :: Bool, code :: FeedCode, braking :: Bool}
  deriving stock (Eq, Show)

-- | Reason why a control refuses a frame.
data Refusal
  = -- | A rule of the frames is broken.
    ByRule Violation
  | -- | The radii of an arc differ: the number of the frame, the end radius minus the start radius.
    UnequalRadii Int Mm
  | -- | An arc has no sweep: the number of its frame. The end of such an arc lies at its centre,
    -- or, as seen from the centre, in the direction of its start but at another distance.
    NoSweep Int
  | -- | Cutter compensation fails.
    NotCompensated CompensationError
  deriving stock (Eq, Show)

-- | Test that a tape has no findings.
isProven :: Proof -> Bool
isProven proof = null (findings proof) && null (controlFindings proof)

-- | Reports of all findings, in their order.
toReports :: LengthUnit -> Machine -> Proof -> [Report]
toReports unit machine proof = findingReports unit machine (findings proof)

-- | Reports of findings, in their order.
findingReports :: LengthUnit -> Machine -> [Finding] -> [Report]
findingReports unit machine = map (toReport unit machine)

-- | Number, from 1, of the frame that a finding is about. Nothing if it is about a frame that is
-- missing.
frameOf :: Finding -> Maybe Int
frameOf finding = case tapeOrder finding of
  (n, _) | n > 0 && n < maxBound -> Just n
  _ -> Nothing

toReport :: LengthUnit -> Machine -> Finding -> Report
toReport unit machine finding = case finding of
  Gouge first worst allowed ->
    ( wrong
        "E0701"
        (InSource (element first))
        (frameWord (frame first) <> " cuts " <> micro (amount first) <> " into the part")
    )
      { label = "into this element",
        message =
          [ "The cutter's centre is then at "
              <> Vec.toText unit 3 (location first)
              <> ". A gouge of up to "
              <> micro allowed
              <> " is allowed: the tolerance and one pulse."
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
        (frameWord (frame w) <> " leaves " <> micro (amount w) <> " of material on the part")
    )
      { label = "at this element",
        message =
          [ "The most is left at "
              <> Vec.toText unit 3 (location w)
              <> ". Up to "
              <> micro allowed
              <> " is allowed: the tolerance and one pulse."
          ]
            <> [ "The most that any frame leaves is "
                   <> micro (amount worst)
                   <> ", in frame "
                   <> Decimal.whole (frame worst)
                   <> "."
                 | frame worst /= frame w
               ]
      }
  WrongSide n region ->
    wrong "E0703" (InSource region) (frameWord n <> " runs along this element on the wrong side")
  NeverBegun region p height ->
    wrong
      "E0704"
      (InSource region)
      ( "the cutter never comes to "
          <> Vec.toText unit 3 p
          <> (if height == Mm 0 then "" else " at the height " <> Decimal.inUnit unit height)
          <> ", where this contour begins"
      )
  NotFollowed region ->
    wrong
      "E0709"
      (InSource region)
      "the tape does not follow this contour from its start to its end in the direction of travel"
  NotCleared region z p ->
    ( wrong
        "E0714"
        (InSource region)
        ("the tape does not clear the floor of this pocket at " <> Vec.toText unit 3 p)
    )
      { label = "at the height " <> Decimal.inUnit unit z,
        message = ["The cutter has room there, but no frame brings it near enough to this point."]
      }
  NotInOrder region ->
    wrong
      "E0715"
      (InSource region)
      "the tape does not clear the depths of this pocket in their order"
  AgainstSense n region asked ->
    (wrong "E0742" InFile (frameWord n <> " cuts in the other direction than the program asks for"))
      { others = [Label region (case asked of Climb -> "climb"; Conventional -> "conventional")],
        message =
          ["The chips are then cut from the other end, and the wall gets another size and surface."]
      }
  Collides c -> CollisionFinding.toReport unit c
  OffPlane n -> wrong "E0705" InFile (frameWord n <> " moves z, but the program does not")
  TurnsAxis n axis ->
    (wrong "E0718" InFile (frameWord n <> " turns the rotary axis " <> rotaryWord axis))
      { message =
          [ "The proof follows the cutter along x, y and z only. It cannot judge a tape that turns \
            \the part or the head."
          ]
      }
  CarvesBeyond n p far region ->
    ( wrong
        "E0747"
        InFile
        (frameWord n <> " carves beyond the edge of the region")
    )
      { others = [Label region "this carving"],
        message =
          [ "At " <> Vec.toText unit 3 p <> " its cone goes " <> Decimal.inUnit unit far
              <> " beyond the edge."
          ]
      }
  EdgeNotCarved region p ->
    wrong
      "E0748"
      (InSource region)
      ("the tape does not carve the edge of this region at " <> Vec.toText unit 3 p)
  HoleMissing region p ->
    wrong
      "E0710"
      (InSource region)
      ("the tape drills no hole of the right depth at " <> Vec.toText unit 3 p)
  CutsElsewhere n p ->
    ( wrong
        "E0711"
        InFile
        (frameWord n <> " cuts where the program does not, or deeper than the program")
    )
      { message = ["The cutter's centre is then at " <> Vec.toText unit 3 p <> "."]
      }
  NotAsked n p ->
    ( wrong
        "E0716"
        InFile
        (frameWord n <> " makes a move that the program does not ask for at this point")
    )
      { message = ["It moves the cutter's centre to " <> Vec.toText unit 3 p <> "."]
      }
  MoveMissing region p ->
    wrong
      "E0717"
      (InSource region)
      ("the tape does not make this move, which ends at " <> Vec.toText unit 3 p)
  WrongFeed n found wanted region ->
    ( wrong
        "E0706"
        (InSource region)
        (frameWord n <> " runs at a wrong feed: " <> speed unit machine found)
    )
      { message = ["The program asks for " <> speed unit machine wanted <> " there."]
      }
  WrongCommand n (CommandName name) found wanted ->
    ( wrong
        (if isLimit (CommandName name) then "E0740" else "E0708")
        InFile
        ( frameWord n
            <> maybe
              (" lacks the command " <> name <> maybe "" ((" " <>) . Decimal.whole) wanted)
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
          refusalWords unit refusal
     in (wrong "E0712" InFile (frameWord n <> " " <> why)) {message = more}
  TooFast n is may ->
    ( wrong
        "E0713"
        InFile
        (frameWord n <> " is too fast at its end: " <> Decimal.feedIn unit 2 is)
    )
      { message =
          [ "To slow down in time for the frames that follow, or for the end of the tape, it may \
            \have at most "
              <> Decimal.feedIn unit 2 may
              <> " there."
          ]
      }
  LeavesPath region p found allowed ->
    ( wrong
        "E0733"
        (InSource region)
        "the control may leave this contour by more than the tolerance"
    )
      { message =
          [ "The path mode lets it leave the path by "
              <> micro p
              <> ". The path itself deviates by "
              <> micro found
              <> ", and "
              <> micro allowed
              <> " is allowed in all: the tolerance and one pulse."
          ],
        hints = ["Write a smaller P after G64, with Q0, or write G61."]
      }
  NotClosed (Pulses3 x y z) ->
    wrong
      "E0707"
      InFile
      ( "the tape does not end where the program does: it is off by "
          <> Text.intercalate
            ", "
            [pulses d <> " in " <> axis | (axis, d) <- [("x", x), ("y", y), ("z", z)], d /= 0]
      )
  where
    wrong = report Report.Error
    frameWord n = "frame " <> Decimal.whole n
    -- True for the limit of the spindle at a constant cutting speed.
    isLimit name =
      name
        `elem` [ Machine.commandName w
                 | w <-
                     Machine.surfaceClockwise (Machine.commandWords machine)
                       <> Machine.surfaceCounterClockwise (Machine.commandWords machine),
                   Machine.value w == Machine.SpeedLimit
               ]
    micro x = Decimal.fixedInUnit unit 4 x

-- | Number of the refused frame.
refusedFrame :: Refusal -> Int
refusedFrame refusal = let (n, _, _) = refusalWords Millimetres refusal in n

-- | Number of a frame, the reason why a control refuses it, and further sentences. The reason
-- completes a sentence that begins with the frame.
refusalWords :: LengthUnit -> Refusal -> (Int, Text, [Text])
refusalWords unit refusal = case refusal of
  ByRule broken -> case broken of
    Frame.OverCapacity n axis d ->
      (n, "moves " <> axisWord axis <> " by " <> pulses d <> ", more than its field holds", [])
    Frame.TurnOverCapacity n axis d ->
      (n, "turns " <> rotaryWord axis <> " by " <> pulses d <> ", more than its field holds", [])
    Frame.BadCentre n ->
      (n, "has no centre for its arc", ["It is missing, or it is more than its fields hold."])
    Frame.NoSuchFeedCode n c ->
      (n, "has the feed code " <> codeText c <> ", which the machine does not know there", [])
    Frame.NoSuchMotion n ->
      ( n,
        "asks for a motion that the machine does not have",
        [ "It is an arc, but the machine has none or none of this kind (one that rises, crosses a \
          \quadrant or is a full circle), or a motion that goes nowhere."
        ]
      )
    Frame.UnknownCommand n (CommandName o) ->
      (n, "gives the command " <> o <> " twice, or with a number that it does not have", [])
    Frame.EmptyFrame n -> (n, "neither moves nor commands anything", [])
  UnequalRadii n (Mm d) ->
    ( n,
      "is an arc that ends "
        <> Decimal.fixedInUnit unit 4 (Mm (abs d))
        <> " "
        <> (if d > 0 then "further from" else "nearer to")
        <> " its centre than it begins",
      ["The two may differ by 2 pulses."]
    )
  NotCompensated err -> CompensationCheck.wordsOf err
  NoSweep n ->
    ( n,
      "is an arc without a sweep",
      ["Its end lies in the same direction from the centre as its beginning, at another distance."]
    )
  where
    codeText = Decimal.whole . Machine.codeNumber
    axisWord a = Machine.contentName (Machine.Along a)

-- | Name of a rotary axis.
rotaryWord :: RotaryAxis -> Text
rotaryWord axis = Machine.contentName (Machine.About axis)

-- | Speed in words.
speed :: LengthUnit -> Machine -> Speed -> Text
speed unit machine s =
  (if rapidly s then "rapid" else feed)
    <> (if braking s then ", braking" else "")
  where
    feed = "speed " <> Decimal.whole (Machine.codeNumber (code s)) <> meaning
    meaning = case Machine.forTurn machine (code s) of
      Just d -> " (" <> Decimal.shortIn unit 4 (Mm d) <> " " <> Decimal.unitText unit <> "/rev)"
      Nothing ->
        maybe
          ""
          (\v -> " (" <> measured v <> ")")
          (Machine.valueOf machine (code s))
    measured v = case Machine.feedMeasure (Machine.feeds machine) of
      Machine.AlongPath -> Decimal.feedIn unit 2 (Feed v)
      Machine.LeadingAxis -> Decimal.short 2 v <> " pulses a second"

pulses :: Pulses -> Text
pulses (Pulses n) = Decimal.whole n <> (if abs n == 1 then " pulse" else " pulses")
