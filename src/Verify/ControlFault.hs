-- | Faults of the state of a modern control, and their reports. "Verify.ControlState" finds them.
module Verify.ControlFault
  ( ControlFinding (..),
    ControlFault (..),
    ControlMode (..),
    changesReading,
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..))
import Base.Region (Region)
import Data.Maybe (isNothing)
import Data.Text (Text)
import Gcode.ModalState (Coolant (..))
import Machine.ProgramForm (Lathe (..), ProgramForm (..), Retract (..), XMeaning (..))
import Report.Report (Report (hints, label, message, others), ReportCode, ReportPlace (..), report)
import Report.Report qualified as Report
import Verify.ControlText

-- | Fault of the state at a line, and the line that set the wrong value; Nothing if none did.
data ControlFinding = ControlFinding
  { atLine :: Int,
    setAt :: Maybe Int,
    fault :: ControlFault
  }
  deriving stock (Eq, Show)

data ControlFault
  = -- | the spindle is off, or no line starts it
    SpindleOff
  | -- | the spindle has no speed: no line sets one, or it is 0
    NoSpeed
  | -- | no line takes the length of a tool
    LengthNotTaken
  | -- | G49: the control takes no length into account
    LengthOff
  | -- | M6: the control keeps the length of the tool before
    LengthOfToolBefore
  | -- | the length is that of another tool: the number of the length, the number of the tool
    LengthOfAnother Int (Maybe Int)
  | -- | the plane is another one, or no line selects one
    WrongPlane
  | -- | no line sets the units
    UnitsUnknown
  | -- | no line sets a mode
    ModeUnknown ControlMode
  | -- | words of X are diameters, not radii
    XInDiameters
  | -- | words of X are radii, not diameters
    XInRadii
  | -- | the feed is per turn or the inverse of a time
    NotPerMinute
  | -- | no line sets the feed, or it is 0
    NoFeed
  | -- | the coolant is not the one that the program switches on
    OtherCoolant Coolant
  | -- | the work offset that the program asks for, and that of the file; Nothing if it selects none
    WrongOffset Int (Maybe Int)
  | -- | the control may leave the path by any distance
    NoBound
  | -- | the control may leave the path by more than a program without contours allows: by so many
    -- mm, and what is allowed
    BoundTooLarge Mm Mm
  | -- | no line sets the path mode
    PathModeUnknown
  | -- | x or y moves while the tool is not above everything
    UnsafeMove
  | -- | a rapid move of several axes, which may arrive one after the other, below the clearance
    -- height or together with z
    BoxMove
  | -- | z goes down before x and y have a position in work coordinates
    UnsafeDescent
  | -- | z moves to a height that is not known
    UnknownHeight
  | -- | the tool is changed below the height at which it is above everything
    LowChange
  | -- | on a lathe, X and Z move at the same time or in a wrong order to or from their retract
    -- positions
    LatheOrder
  | -- | on a lathe, the way to a retract position, or back, passes through the part
    ThroughProfile
  | -- | a constant cutting speed without a limit of the turns of the spindle
    NoSpeedLimit
  | -- | the file ends while the spindle turns
    SpindleLeftOn
  | -- | a tap is moved outside of a tapping cycle
    TapUnguided
  | -- | a tap is moved by another pitch: this pitch, and that of the program
    OtherTapPitch Mm Mm
  deriving stock (Eq, Ord, Show)

-- | Mode in which the control reads numbers, or computes the path.
data ControlMode
  = -- | positions: absolute or incremental
    DistanceMode
  | -- | words of X: radii or diameters
    DiameterMode
  | -- | cutter compensation by the control
    CompensationMode
  | -- | unit of the feed: per minute, per turn or the inverse of a time
    FeedUnit
  | -- | meaning of the speed: turns per minute or a constant cutting speed
    SpeedUnit
  | -- | I and J: from the beginning of the arc or from the work zero
    ArcCentreMode
  deriving stock (Eq, Ord, Show)

-- | Test that numbers of the file mean something else because of a fault, so that the motions or
-- the feeds that are read are not those of the control.
changesReading :: ControlFault -> Bool
changesReading f = case f of
  SpindleOff -> False
  NoSpeed -> False
  LengthNotTaken -> False
  LengthOff -> False
  LengthOfToolBefore -> False
  LengthOfAnother _ _ -> False
  WrongPlane -> True
  UnitsUnknown -> True
  ModeUnknown _ -> True
  XInDiameters -> True
  XInRadii -> True
  NotPerMinute -> True
  NoFeed -> True
  OtherCoolant _ -> False
  WrongOffset _ _ -> False
  NoBound -> False
  BoundTooLarge _ _ -> False
  PathModeUnknown -> False
  UnsafeMove -> False
  UnsafeDescent -> False
  UnknownHeight -> False
  LowChange -> False
  BoxMove -> False
  LatheOrder -> False
  ThroughProfile -> False
  NoSpeedLimit -> False
  SpindleLeftOn -> False
  TapUnguided -> False
  OtherTapPitch _ _ -> False

-- | Report of a finding. @lineRegion@ gives the region of a line of the file.
toReport :: ProgramForm -> (Int -> Region) -> ControlFinding -> Report
toReport form lineRegion (ControlFinding n set f) =
  (report Report.Error (codeOf f) (InSource (lineRegion n)) (title words'))
    { label = here words',
      others = [Report.Label (lineRegion k) (there words') | Just k <- [set], k /= n],
      message = [reason words'],
      hints = [remedy words']
    }
  where
    words' = wordsOf form (isNothing set) f

codeOf :: ControlFault -> ReportCode
codeOf f = case f of
  SpindleOff -> "E0723"
  NoSpeed -> "E0724"
  LengthNotTaken -> "E0725"
  LengthOff -> "E0725"
  LengthOfToolBefore -> "E0725"
  LengthOfAnother _ _ -> "E0726"
  WrongPlane -> "E0727"
  UnitsUnknown -> "E0728"
  ModeUnknown _ -> "E0729"
  XInDiameters -> "E0729"
  XInRadii -> "E0729"
  NotPerMinute -> "E0729"
  NoFeed -> "E0706"
  OtherCoolant _ -> "E0708"
  WrongOffset _ _ -> "E0730"
  NoBound -> "E0731"
  BoundTooLarge _ _ -> "E0736"
  PathModeUnknown -> "E0731"
  UnsafeMove -> "E0732"
  UnsafeDescent -> "E0732"
  UnknownHeight -> "E0732"
  LowChange -> "E0735"
  BoxMove -> "E0734"
  LatheOrder -> "E0737"
  ThroughProfile -> "E0738"
  NoSpeedLimit -> "E0739"
  SpindleLeftOn -> "E0741"
  TapUnguided -> "E0750"
  OtherTapPitch _ _ -> "E0750"

-- | Words for a fault. @isUnset@ is true if no line has set the value.
wordsOf :: ProgramForm -> Bool -> ControlFault -> Wording
wordsOf form isUnset f = case f of
  SpindleOff -> spindleOff isUnset
  NoSpeed -> noSpeed isUnset
  LengthNotTaken ->
    withoutLength "" (kept "tool length" <> " It may be that of another tool.")
  LengthOff ->
    withoutLength "no length from here on" "G49 takes no length into account."
  LengthOfToolBefore ->
    withoutLength
      "the tool is changed here"
      "After M6 the control keeps the length of the tool before."
  LengthOfAnother h tool -> lengthOfAnother h tool
  WrongPlane -> wrongPlane form isUnset
  UnitsUnknown -> unitsUnknown
  ModeUnknown mode -> modeUnknown form mode
  XInDiameters -> xInDiameters
  XInRadii -> xInRadii
  NotPerMinute ->
    wrongMode cuts "the feed is not per minute" "The feeds of the program are per minute." "G94"
  NoFeed -> noFeed isUnset
  OtherCoolant asked -> otherCoolant asked
  WrongOffset wanted found -> wrongOffset wanted found
  NoBound -> noBound
  BoundTooLarge found most -> boundTooLarge found most
  PathModeUnknown -> pathModeUnknown
  UnsafeMove -> unsafeMove form
  UnsafeDescent -> unsafeDescent form
  UnknownHeight -> unknownHeight form
  LowChange -> lowChange form
  BoxMove -> boxMove
  LatheOrder -> latheOrder
  ThroughProfile -> throughProfile
  NoSpeedLimit -> noSpeedLimit
  SpindleLeftOn -> spindleLeftOn
  TapUnguided -> tapUnguided
  OtherTapPitch found wanted -> otherTapPitch found wanted

-- | Labels of motions.
cuts, descends :: Text
cuts = "this motion cuts"
descends = "the tool comes down or cuts here"

-- | Sentence about a value that no line sets.
kept :: Text -> Text
kept what = "The control keeps the " <> what <> " of the program that it ran before."

unitsUnknown :: Wording
unitsUnknown =
  Wording
    { title = "no line sets the units of the numbers",
      here = descends,
      there = "",
      reason = kept "units",
      remedy = "Write G21 for mm or G20 for inches before the first motion."
    }

spindleOff :: Bool -> Wording
spindleOff isUnset =
  Wording
    { title = "the spindle is off at this cut",
      here = cuts,
      there = "the spindle is off from here on",
      reason =
        if isUnset
          then "No line before it starts the spindle."
          else "M5 stops the spindle, and so does M6.",
      remedy = "Write the speed and M3 or M4 before the cut, as in S8000 M3."
    }

noSpeed :: Bool -> Wording
noSpeed isUnset =
  Wording
    { title = "the spindle has no speed at this cut",
      here = cuts,
      there = "the speed is 0 from here on",
      reason =
        if isUnset
          then kept "spindle speed"
          else "At the speed 0 the spindle does not turn.",
      remedy = "Write the speed before the cut, as in S8000 M3."
    }

-- | Words for a length that is not taken, with the label of its line and the reason.
withoutLength :: Text -> Text -> Wording
withoutLength there reason =
  Wording
    { title = "the length of the tool is not taken",
      here = descends,
      there,
      reason,
      remedy = "Write G43 H with the number of the tool before the tool comes down."
    }

lengthOfAnother :: Int -> Maybe Int -> Wording
lengthOfAnother h tool =
  Wording
    { title = "the length is that of another tool",
      here = descends,
      there = "this length is taken",
      reason =
        "The length is that of tool " <> Decimal.whole h <> case tool of
          Just t -> ", but tool " <> Decimal.whole t <> " is in the spindle."
          Nothing -> ", but no line says which tool is in the spindle.",
      remedy = case tool of
        Just t -> "Write G43 H" <> Decimal.whole t <> " after the change of the tool."
        Nothing -> "Write T" <> Decimal.whole h <> " M6 before it."
    }

wrongPlane :: ProgramForm -> Bool -> Wording
wrongPlane form isUnset =
  Wording
    { title =
        if isUnset
          then "no line selects the plane of this cut"
          else "this cut is in another plane than the part",
      here = cuts,
      there = "another plane from here on",
      reason =
        if isUnset
          then kept "plane"
          else "The arcs of the part are in the plane of " <> axes <> ".",
      remedy = "Write " <> word <> " before the cut."
    }
  where
    (axes, word) = case lathe form of
      Nothing -> ("x and y", "G17")
      Just _ -> ("Z and X", "G18")

-- | Words for a mode that no line sets.
modeUnknown :: ProgramForm -> ControlMode -> Wording
modeUnknown form mode =
  Wording
    { title = "no line says " <> question,
      here = if mode `elem` [FeedUnit, SpeedUnit, ArcCentreMode] then cuts else descends,
      there = "",
      reason = kept "mode",
      remedy
    }
  where
    (question, remedy) = modeWords form mode

-- | The question that no line answers, and the remedy.
modeWords :: ProgramForm -> ControlMode -> (Text, Text)
modeWords form mode = case mode of
  DistanceMode ->
    ( "whether positions are absolute or incremental",
      "Write G90 for absolute or G91 for incremental positions before this motion."
    )
  DiameterMode ->
    ("whether X gives radii or diameters", "Write " <> meaning <> " before this motion.")
  CompensationMode -> ("that cutter compensation is off", "Write G40 before this motion.")
  FeedUnit -> ("in what unit the feed is", "Write G94 before the cut.")
  SpeedUnit ->
    ( "whether S gives turns or a cutting speed",
      "Write G97 for turns per minute, or G96 D S for a constant cutting speed."
    )
  ArcCentreMode ->
    ( "from where I and J are counted",
      "Write G91.1 before the arc: I and J then lead from its beginning to its centre."
    )
  where
    meaning = if (meaningOfX <$> lathe form) == Just XDiameter then "G7" else "G8"

-- | Words for a mode that a line sets wrongly, with the word that sets it right.
wrongMode :: Text -> Text -> Text -> Text -> Wording
wrongMode here title reason word =
  Wording
    { title,
      here,
      there = "another mode from here on",
      reason,
      remedy = "Write " <> word <> " before this motion."
    }

xInDiameters, xInRadii :: Wording
xInDiameters =
  wrongMode
    descends
    "X gives diameters here"
    "The positions of the program are not diameters."
    "G8"
xInRadii =
  wrongMode
    descends
    "X gives radii here"
    "The file of this lathe gives diameters."
    "G7"

noFeed :: Bool -> Wording
noFeed isUnset =
  Wording
    { title = "this cut has no feed",
      here = cuts,
      there = "the feed is 0 from here on",
      reason =
        if isUnset
          then kept "feed"
          else "F0 sets the feed to 0, and so do G93, G94 and G95 on LinuxCNC.",
      remedy = "Write the feed in the line of the cut or before it, as in G1 X10 F300."
    }

-- | Words for a coolant that the program does not switch on. @asked@ is the one that it switches
-- on.
otherCoolant :: Coolant -> Wording
otherCoolant asked =
  Wording
    { title = "the coolant is not that of the program",
      here = "",
      there = "this coolant from here on",
      reason = "The program switches on " <> name <> " alone on this machine.",
      remedy = "Write " <> word <> " in place of the other word, or M9 before it."
    }
  where
    (name, word) = if asked == Mist then ("mist (M7)", "M7") else ("flood (M8)", "M8")

wrongOffset :: Int -> Maybe Int -> Wording
wrongOffset wanted found =
  Wording
    { title = case found of
        Nothing -> "no line selects the work offset"
        Just _ -> "the work offset is not that of the program",
      here = descends,
      there = "another work offset from here on",
      reason = case found of
        Nothing -> kept "work offset" <> " This program needs G" <> Decimal.whole wanted <> "."
        Just n ->
          "The program needs G"
            <> Decimal.whole wanted
            <> ", and the file has G"
            <> Decimal.whole n
            <> ".",
      remedy =
        "Write G" <> Decimal.whole wanted <> " before the tool comes down" <> case found of
          Nothing -> "."
          Just n -> ", or ‘work " <> Decimal.whole n <> "’ in the program."
    }

noBound :: Wording
noBound =
  Wording
    { title = "the control may round corners here by any distance",
      here = "",
      there = "this path mode",
      reason = "G64 without P, or with P0, has no bound.",
      remedy = pathRemedy
    }

boundTooLarge :: Mm -> Mm -> Wording
boundTooLarge (Mm found) (Mm most) =
  Wording
    { title = "the control may leave the path by " <> Decimal.short 4 found <> " mm",
      here = "",
      there = "this path mode",
      reason =
        "The program has no contour whose tolerance would allow it, so only one pulse is allowed: "
          <> Decimal.short 4 most
          <> " mm.",
      remedy = "Write G61 for the exact path."
    }

pathModeUnknown :: Wording
pathModeUnknown =
  Wording
    { title = "no line says how far the control may round corners",
      here = "",
      there = "",
      reason = kept "path mode",
      remedy = pathRemedy
    }

pathRemedy :: Text
pathRemedy = "Write the largest deviation, as in G64 P0.02 Q0, or write G61 for the exact path."

unsafeMove :: ProgramForm -> Wording
unsafeMove =
  unsafe
    "the tool moves across, but not at the retract height"
    "It may hit a clamp or the part on its way."

unsafeDescent :: ProgramForm -> Wording
unsafeDescent =
  unsafe
    "the tool comes down at an unknown place"
    "No line gives its position in x and y, so it may hit a clamp or the part."

unknownHeight :: ProgramForm -> Wording
unknownHeight =
  unsafe
    "z moves to a height that is not known"
    "The part or a clamp may be on its way."

lowChange :: ProgramForm -> Wording
lowChange form =
  Wording
    { title = "the tool is changed, but not at the retract height",
      here = "",
      there = "",
      reason = "The next tool may be longer, and then it is in the part or in a clamp at once.",
      remedy = case lathe form of
        Nothing -> "Move z alone, " <> toRetractHeight form <> ", before the change."
        Just _ -> "Move X or Z to its retract position by G53 G0 before the change."
    }

-- | Words for a motion that may hit something, with its title and the reason.
unsafe :: Text -> Text -> ProgramForm -> Wording
unsafe title reason form =
  Wording
    { title,
      here = "",
      there = "",
      reason,
      remedy = "Move z alone first, " <> toRetractHeight form <> ", then x and y, then z."
    }

-- | The way to the retract height.
toRetractHeight :: ProgramForm -> Text
toRetractHeight form = case retract form of
  MachineHeight (Mm h) -> "by G53 G0 Z" <> Decimal.short 3 h
  ReferencePoint -> "by G91 G28 Z0"
  SafeHeight _ -> "up to the safe height of the program"

boxMove :: Wording
boxMove =
  Wording
    { title = "the axes of this rapid move may arrive one after the other",
      here = "",
      there = "",
      reason =
        "In rapid this control does not move along a straight line, so the tool may hit a clamp or \
        \the part.",
      remedy =
        "Move one axis alone, or x and y together at the clearance height or above it."
    }

latheOrder :: Wording
latheOrder =
  Wording
    { title = "X and Z leave the work, or come to it, in an unsafe order",
      here = "",
      there = "",
      reason =
        "The tool is outside of the work only when X or Z is at its retract position. Until then \
        \only one of them may move.",
      remedy =
        "Move X alone to its retract position by G53 G0, then Z; and back Z first, then X. In a \
        \bore it is the reverse."
    }

throughProfile :: Wording
throughProfile =
  Wording
    { title = "the tool passes through the part on its way to or from the retract position",
      here = "",
      there = "",
      reason = "The way along this axis meets a turned profile.",
      remedy = "Move the other axis first, or write ‘retract’ with a place outside of the part."
    }

noSpeedLimit :: Wording
noSpeedLimit =
  Wording
    { title = "the spindle has a constant cutting speed without a limit",
      here = cuts,
      there = "no D in this line",
      reason =
        "Near the axis the control turns the spindle as fast as it can, and the chuck may lose the \
        \part.",
      remedy = "Write the largest speed with D, as in G96 D2500 S180."
    }

spindleLeftOn :: Wording
spindleLeftOn =
  Wording
    { title = "the spindle still turns at the end of the file",
      here = "the file ends here",
      there = "starts the spindle",
      reason =
        "No word ends the program, so the control leaves the spindle on, and the operator reaches \
        \to the tool.",
      remedy = "Write M5 as the last line."
    }
