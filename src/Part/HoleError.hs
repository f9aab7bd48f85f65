-- | Faults of the statements that work on holes.
module Part.HoleError
  ( HoleMistake (..),
    ThreadMistake (..),
    TapMistake (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), Rad, degrees)
import Base.Region (Region)
import Data.Text (Text)
import Part.Part (Sense (..))
import Report.Fix qualified as Fix
import Report.Report (Report (..), at)

-- | A fault of a work on holes. The first field of every constructor is the region that the report
-- points at. The comment of a constructor names the other fields in order.
data HoleMistake
  = -- | a chip break without pecks
    BreakWithoutPeck Region
  | -- | a hole that is not wider than the tool: the diameters of the hole and of the tool
    NotWider Region Mm Mm
  | -- | a mouth of a hole that the tool cannot make: its diameter, and the smallest and the largest
    -- diameter that the point of the tool makes
    BeyondPoint Region Mm Mm Mm
  | -- | a countersink whose angle is not that of the tool: both angles
    OtherAngle Region Rad Rad
  | -- | a point of a tool with an angle that is no angle of a point
    NoPoint Region Rad
  | InThread ThreadMistake
  deriving stock (Eq, Show)

-- | A fault of a thread, in the form of 'HoleMistake'.
data ThreadMistake
  = -- | a thread whose pitch is not that of the thread mill: both pitches
    OtherPitch Region Mm Mm
  | -- | a thread mill that does not fit into the hole before threading: the diameters of the tool
    -- and of the hole
    CoreTooNarrow Region Mm Mm
  | -- | a thread mill whose pitch is longer than its radius: the pitch and the diameter
    PitchTooLong Region Mm Mm
  | -- | an outside thread whose pitch leaves no core: the pitch and the diameter
    NoCoreLeft Region Mm Mm
  | InTap TapMistake
  deriving stock (Eq, Show)

-- | A fault of a tap, in the form of 'HoleMistake'.
data TapMistake
  = -- | a tap where the spindle has no constant speed
    TapWithoutSpeed Region
  | -- | a tap that would turn out of the thread: the sense in which the spindle turns
    TapTurnsBack Region Sense
  deriving stock (Eq, Show)

-- | The report of a fault.
toReport :: LengthUnit -> HoleMistake -> Report
toReport unit mistake = case mistake of
  BreakWithoutPeck region ->
    (at region "E0390" "a chip break needs pecks")
      { message = ["It says how far the drill rises after each peck."],
        hints = ["Write the largest depth of a peck too, for example peck 3 mm."]
      }
  NotWider region hole tool ->
    (at region "E0391" ("this hole is not wider than the mill of " <> inUnit tool))
      { message = ["Its diameter is " <> inUnit hole <> "."],
        hints = ["Change to a thinner mill, or drill the hole."]
      }
  BeyondPoint region mouth least most ->
    (at region "E0392" ("the point of the tool does not make a diameter of " <> inUnit mouth))
      { message =
          [ "It makes diameters above "
              <> inUnit least
              <> " and up to "
              <> inUnit most
              <> "."
          ],
        hints = ["Change to a tool of the right diameter."]
      }
  OtherAngle region asked given ->
    (at region "E0393" ("the point of the tool has " <> inDegrees given))
      { message = ["The countersink is to have " <> inDegrees asked <> "."],
        hints =
          [ "A tool for it is drill(diameter 10 mm, angle " <> inDegrees asked
              <> "), with your diameter."
          ]
      }
  NoPoint region angle ->
    (at region "E0395" ("a point cannot have an angle of " <> inDegrees angle))
      { message = ["The angle of a point is measured from flank to flank, as 118 deg of a drill."],
        hints = ["Write an angle above 0 deg and up to 180 deg."]
      }
  InThread fault -> threadReport unit fault
  where
    inUnit = Decimal.inUnit unit

-- | The report of a fault of a thread.
threadReport :: LengthUnit -> ThreadMistake -> Report
threadReport unit mistake = case mistake of
  OtherPitch region asked given ->
    (at region "E0394" ("the thread mill has a pitch of " <> inUnit given))
      { message = ["The thread is to have a pitch of " <> inUnit asked <> "."],
        fixes =
          [Fix.proposed (Fix.exchange ("Write " <> inUnit given <> ".") region (inUnit given))],
        hints = ["Or change to the thread mill for this pitch."]
      }
  CoreTooNarrow region tool core ->
    (at region "E0391" ("the thread mill of " <> inUnit tool <> " does not fit into this hole"))
      { message =
          ["Before threading, the hole has a diameter of " <> inUnit core <> ": that of the core."],
        hints = ["Change to a thinner thread mill."]
      }
  PitchTooLong region own diameter ->
    (at region "E0394" "this pitch is too long for the thread mill")
      { message =
          [ "It is " <> inUnit own <> ", and the diameter of the mill is " <> inUnit diameter
              <> ": its teeth would be deeper than its radius leaves room for."
          ],
        hints = ["Give the pitch of its teeth, at most half of the diameter."]
      }
  NoCoreLeft region own diameter ->
    (at region "E0394" "this pitch is too long for the thread")
      { message =
          [ "It is " <> inUnit own <> ", and the diameter of the thread is " <> inUnit diameter
              <> ": nothing would be left within the thread."
          ],
        hints = ["Correct the pitch or the diameter."]
      }
  InTap fault -> tapReport fault
  where
    inUnit = Decimal.inUnit unit

-- | The report of a fault of a tap.
tapReport :: TapMistake -> Report
tapReport mistake = case mistake of
  TapWithoutSpeed region ->
    (at region "E0396" "a tap needs the speed of the spindle")
      { message = ["For each turn of the spindle the tap moves by the pitch."],
        hints = ["Write the speed before it, as in spindle cw 400 rpm."]
      }
  TapTurnsBack region sense ->
    (at region "E0397" ("the spindle turns " <> senseText sense <> ", out of this thread"))
      { message =
          ["A right-hand thread is tapped clockwise, and a left-hand thread counterclockwise."],
        hints = ["Correct the sense of the spindle, or the hand of the thread: hand left."]
      }

-- | An angle with its unit.
inDegrees :: Rad -> Text
inDegrees a = Decimal.short 3 (degrees a) <> " deg"

-- | The name of a sense.
senseText :: Sense -> Text
senseText sense = case sense of
  Clockwise -> "clockwise"
  CounterClockwise -> "counterclockwise"
