-- | Writes the frames of a program as G-code for a modern control: a head of comments, a safe
-- beginning, the motions, safe changes of the tool, and a safe end.
--
-- /Away/ means that the tool is at the retract height. From there x and y go to their position, and
-- then z comes down. On a lathe the tool is away when X and Z are at their retract positions. X
-- leaves the work first and comes back last; after the inside of a part was turned, it is Z.
module Gcode.Writer
  ( ToolFile (..),
    write,
    landing,
  )
where

import Base.Decimal qualified as Decimal
import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (LengthUnit (..), Mm (..), Pulses (..))
import Data.Map.Strict qualified as Map
import Data.Maybe (isJust, isNothing, listToMaybe, mapMaybe, maybeToList)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Command qualified as Command
import Frame.Frame (Frame (..), FrameMotion (..), FrameProgram (..), PlannedFrame (..), passNumber)
import Frame.Frame qualified as Frame
import Gcode.CommentText qualified as CommentText
import Gcode.ControlAction (ControlAction (..), actionsOf, setsSpindle)
import Gcode.Cycle qualified as Cycle
import Gcode.FileTime qualified as FileTime
import Gcode.Heading (FileHeading (..))
import Gcode.Heading qualified as Heading
import Gcode.HoleCycle (AfterTap, FoundCycle)
import Gcode.HoleCycle qualified as HoleCycle
import Gcode.ModalState (CannedCycle (..))
import Gcode.ToolTip qualified as ToolTip
import Gcode.WordText
import Geometry.Carrier qualified as Carrier
import Machine.Machine
  ( Axis (..),
    CommandName,
    CommandWord (..),
    CommandWords (..),
    Content (..),
    FeedCode (..),
    Machine,
    MachineName (..),
    ProgramForm (..),
  )
import Machine.Machine qualified as Machine
import Machine.ProgramForm (Dialect (..), Lathe (..), Retract (..), XMeaning (..))
import Machine.ProgramForm qualified as ProgramForm

-- | A file, and the number of its tool if each tool has a file of its own.
data ToolFile = ToolFile {toolOfFile :: Maybe Int, fileText :: Text}
  deriving stock (Eq, Show)

-- | State while the lines are written.
data Writing = Writing
  { at :: Pulses3,
    isAway :: Bool,
    -- | feed code that is in force; Nothing if the next feed has to be written
    feedWritten :: Maybe FeedCode,
    -- | true if feeds are for one turn of the spindle
    isPerTurn :: Bool,
    hasCoolant :: Bool,
    -- | true from a change of the tool on, which switches the coolant off, until it is on again
    isCoolantPaused :: Bool,
    -- | true if the spindle turns
    turns :: Bool,
    -- | from the centre of the tool to the point that the control leads
    tipOffset :: Pulses3,
    -- | true after a cut on the inside of a turned part
    isInside :: Bool,
    -- | the canned cycle in force, and its words that stay
    cycleNow :: Maybe (CannedCycle, [Text]),
    -- | spindle words after a tap
    afterTap :: Maybe AfterTap
  }

-- | Files of a program. @bound@ is the largest deviation in mm from the path that the control may
-- make at corners; Nothing for an exact path.
write :: Machine -> ProgramForm -> FileHeading -> Maybe Mm -> FrameProgram -> [ToolFile]
write machine form given bound program =
  [ ToolFile
      (if isOneFile then Nothing else toolOf part)
      (Text.unlines (fileLines context (FileNumber k (length parts)) part))
    | (k, part) <- zip [1 ..] parts
  ]
  where
    context = Context {machine, form, heading, bound}
    heading = Heading.raised machine form program given
    isOneFile = ProgramForm.changesTools (dialect form)
    frames = dropEnd (length (Command.finalFrames machine)) (plannedFrames program)
    whole = FilePart (firstTool heading) (start program) False frames
    parts = if isOneFile then [whole] else byTool machine whole
    dropEnd n xs = take (length xs - n) xs

-- | Number of a file, from 1, and the count of files.
data FileNumber = FileNumber Int Int

-- | Frames of one file: the tool that is in the spindle first, the position before the first frame,
-- and true if the coolant was on before it.
data FilePart = FilePart
  { toolOf :: Maybe Int,
    begins :: Pulses3,
    isCooled :: Bool,
    framesOf :: [PlannedFrame]
  }

-- | Parts of a program with one tool each.
byTool :: Machine -> FilePart -> [FilePart]
byTool machine part = case span (null . changesIn . frame) (framesOf part) of
  (_, []) -> [part]
  (own, change : more) ->
    part {framesOf = own} :
    byTool
      machine
      FilePart
        { toolOf = listToMaybe (changesIn (frame change)),
          begins = begins part + sum (map (increment . frame) own),
          isCooled = last (isCooled part : coolantIn (map frame own)),
          framesOf = change {frame = withoutChange (frame change)} : more
        }
  where
    changesIn f = [n | ToTool n <- actionsOf machine f]
    coolantIn fs = [isOn | f <- fs, CoolantSwitch isOn <- actionsOf machine f]
    withoutChange f = f {commands = [c | c <- commands f, fst c `notElem` changeNames f]}
    changeNames f =
      [ commandName w
        | not (null (changesIn f)),
          w <- toolChange (Machine.commandWords machine)
      ]

-- | Facts that are the same for all lines.
data Context = Context
  { machine :: Machine,
    form :: ProgramForm,
    heading :: FileHeading,
    bound :: Maybe Mm
  }

-- | Lines of one file.
fileLines :: Context -> FileNumber -> FilePart -> [Text]
fileLines context number part =
  [percent | hasPercent]
    <> programLine
    <> concatMap (commentLines context) (headTexts context number part)
    <> numbered (form context) body
    <> [percent | hasPercent]
  where
    body =
      concat
        [ modeLines context,
          retractLines context False,
          toolLines context (toolOf part),
          motions,
          retractLines context (isInside final),
          ["M5" | not (isSpindleByHand (heading context))],
          ["M9" | hasCoolant final],
          finishLines context
        ]
    percent = "%"
    hasPercent = dialect (form context) `elem` [LinuxCnc, Fanuc]
    programLine =
      [ "O" <> Text.justifyRight 4 '0' (Decimal.whole n)
        | dialect (form context) == Fanuc,
          n <- maybeToList (programNumber (heading context))
      ]
    (final, motions) = frameLines context now (framesOf part)
    now =
      Writing
        { at = begins part,
          isAway = True,
          feedWritten = Nothing,
          isPerTurn = False,
          hasCoolant = isCooled part,
          isCoolantPaused = isCooled part,
          turns = False,
          tipOffset = tipOf context (toolOf part),
          isInside = False,
          cycleNow = Nothing,
          afterTap = Nothing
        }

-- | Position at which the tool comes down first: after a rapid move straight up, if that is the
-- first motion.
landing :: Pulses3 -> [Frame] -> Pulses3
landing begin frames = case filter Frame.isMoving frames of
  f : _ | isRise f -> begin + increment f
  _ -> begin

-- | True for a rapid move straight up.
isRise :: Frame -> Bool
isRise f = case increment f of
  Pulses3 0 0 z -> motion f == Rapid && z > 0
  _ -> False

-- | Texts of the comments at the head of a file.
headTexts :: Context -> FileNumber -> FilePart -> [(Text, Text)]
headTexts context@Context {machine, form, heading} (FileNumber k count) part =
  [("part", partName heading <> (if title == "" then "" else ", " <> title))]
    <> [("machine", name)]
    <> [ ("file", Decimal.whole k <> " of " <> Decimal.whole count)
         | count > 1
       ]
    <> [("remark", remark form) | remark form /= ""]
    <> [("time", FileTime.timeText duration)]
    <> [ ("tool " <> Decimal.whole n, text)
         | (n, text) <- toolList heading,
           ProgramForm.changesTools (dialect form) || Just n == toolOf part
       ]
    <> [("before the start", text) | text <- operatorTexts form heading (k == 1)]
    <> [("the build needs", text) | dialect form == Marlin, text <- marlinTexts context part]
  where
    duration = FileTime.timeOf machine (begins part) (map frame (framesOf part))
    title = partTitle heading
    MachineName name = Machine.name machine

-- | Tasks of the operator before the start. In the first file of several the tool is touched off
-- along all axes. Later ones leave the zero of x and y, at which the tools before have cut.
operatorTexts :: ProgramForm -> FileHeading -> Bool -> [Text]
operatorTexts form heading isFirst =
  zeroTexts
    <> safeTexts
    <> ["switch the spindle on by hand" | isSpindleByHand heading]
  where
    zeroTexts
      | ProgramForm.takesLengths (dialect form) =
        [ "set the work offset G"
            <> Decimal.whole (workOffset heading)
            <> " and the tool lengths"
            <> otherOffsets
        ]
      | isFirst = ["touch off x, y and z of this tool"]
      | otherwise = ["touch off z of this tool, and leave x and y"]
    otherOffsets = case dialect form of
      LinuxCnc -> ", without G92"
      Fanuc -> ", without G92, G52, G51 and G68"
      Grbl -> ""
      Marlin -> ""
    safeTexts = case Heading.safeHeightOn form heading of
      Just z ->
        [ "the tool stands no higher than z " <> Decimal.inUnit (fileUnit form) z,
          "nothing is above the tool on its way up to that height"
        ]
      Nothing -> []

-- | Options of the firmware without which it passes over commands of the file, and goes on.
marlinTexts :: Context -> FilePart -> [Text]
marlinTexts Context {machine, form, heading} part =
  ["CNC_COORDINATE_SYSTEMS and CNC_WORKSPACE_PLANES"]
    <> ["INCH_MODE_SUPPORT" | fileUnit form == Inches]
    <> ["ARC_SUPPORT" | any (isArc . frame) (framesOf part)]
    <> ["SPINDLE_FEATURE with CUTTER_POWER_UNIT RPM" | not (isSpindleByHand heading)]
    <> ["COOLANT_CONTROL with COOLANT_FLOOD" | isCooled part || not (null cooling)]
    <> ["a display or EMERGENCY_PARSER, for the stops" | not (null stops)]
  where
    isArc f = case motion f of
      Circular _ -> True
      _ -> False
    actions = concatMap (actionsOf machine . frame) (framesOf part)
    cooling = [() | CoolantSwitch _ <- actions]
    stops = [() | OtherCommand (name, _) <- actions, name `elem` stopNames]
    stopNames = map commandName (programStop (Machine.commandWords machine))

-- | A comment with a fixed word before the text, in as many lines as it needs. Controls act on some
-- characters and on some first words of comments, so only harmless characters are kept.
commentLines :: Context -> (Text, Text) -> [Text]
commentLines Context {form} (word, text) = map comment $ case words' text of
  [] -> [key <> " "]
  ws -> divided ws
  where
    comment content = case dialect form of
      Marlin -> cut ("; " <> content)
      _ -> cut ("(" <> content) <> ")"
    key = word <> ":"
    words' = Text.words . Text.filter isHarmless . CommentText.plain
    isHarmless c = c `notElem` ("()%;!?~\\^$*[]#" :: String)
    cut = Text.take (mostCharacters form - 1)
    -- As many words in a line as have room, but at least one.
    divided ws =
      let longer = drop 1 (scanl (\line w -> line <> " " <> w) key ws)
          (now, more) = splitAt (max 1 (length (takeWhile fits longer))) ws
       in Text.unwords (key : now) : if null more then [] else divided more
    fits line = Text.length line + 2 <= mostCharacters form

-- | Lines that set every part of the state that the motions need.
modeLines :: Context -> [Text]
modeLines Context {form, heading, bound} = case dialect form of
  LinuxCnc ->
    [ units <> " " <> plane <> " G90 G91.1 G94 " <> meaning <> " G40 G49 G80",
      offset,
      maybe "G61" blended bound
    ]
  Fanuc -> [units <> " G17 G90 G94 G40 G49 G80", offset, "G61"]
  Grbl -> [units <> " G17 G90 G91.1 G94 G40 G49 G80", offset]
  Marlin -> [units, "G17", "G90", offset]
  where
    (plane, meaning) = case meaningOfX <$> lathe form of
      Nothing -> ("G17", "G8")
      Just XRadius -> ("G18", "G8")
      Just XDiameter -> ("G18", "G7")
    offset = "G" <> Decimal.whole (workOffset heading)
    units = case fileUnit form of
      Millimetres -> "G21"
      Inches -> "G20"
    blended p = "G64 P" <> Decimal.fixedIn (fileUnit form) 3 p <> " Q0"

-- | Lines that take the tool to the retract height: z alone, upwards. On a lathe X and Z go one
-- after the other to their retract positions; Z is first if the inside of the part was turned.
retractLines :: Context -> Bool -> [Text]
retractLines context@Context {form, heading} inside = case retract form of
  MachineHeight h -> inOrder inside (crossLines <> ["G53 G0 Z" <> short h])
  ReferencePoint -> ["G91 G28 Z0.", "G90"]
  SafeHeight _ -> ["G0 " <> height <> rapidFeed context]
  where
    height = case Heading.safeHeightOn form heading of
      Just z -> "Z" <> Decimal.fixedIn (fileUnit form) 3 z
      Nothing -> ""
    short = Decimal.shortIn (fileUnit form) 3
    crossLines =
      [ "G53 G0 X" <> short (Mm (xFactor form * x))
        | Just Lathe {crossRetract = Mm x} <- [lathe form]
      ]

-- | Lines of a lathe, those of X first, in the order in which the tool leaves the work.
inOrder :: Bool -> [Text] -> [Text]
inOrder inside ls = if inside then reverse ls else ls

-- | Offset of the point that the control leads from the centre of a tool, in pulses.
tipOf :: Context -> Maybe Int -> Pulses3
tipOf Context {machine, form, heading} tool = case lathe form of
  Nothing -> 0
  Just _ -> maybe 0 (ToolTip.offset machine) (tool >>= (`Map.lookup` cutters heading))

-- | Lines that put a tool into the spindle and take its length.
toolLines :: Context -> Maybe Int -> [Text]
toolLines Context {form} tool =
  [ line
    | ProgramForm.changesTools (dialect form),
      n <- maybeToList tool,
      line <-
        [ "G53 G0 X" <> short x <> " Y" <> short y
          | (x, y) <- maybeToList (changePlace form)
        ]
          <> ["T" <> Decimal.whole n <> " M6", "G43 H" <> Decimal.whole n]
  ]
  where
    short = Decimal.shortIn (fileUnit form) 3

-- | Lines that end the program.
finishLines :: Context -> [Text]
finishLines Context {machine} =
  [ Text.unwords (map (commandText machine) ws)
    | ws <- Command.finalFrames machine
  ]

-- | Word of a command.
commandText :: Machine -> (CommandName, Int) -> Text
commandText machine (name, n) = scaledText machine (Machine.Command name) (Pulses n)

-- Frames ------------------------------------------------------------------------------------------

-- | Lines of the frames, and the state after them. Frames that go on with the spindle turned back
-- after a tap have a line for it.
frameLines :: Context -> Writing -> [PlannedFrame] -> (Writing, [Text])
frameLines context now frames = case (afterTap now, frames) of
  (Just tapped, PlannedFrame {frame = f} : _)
    | not (any setsSpindle (actionsOf (machine context) f)) ->
      let turn = Turning (HoleCycle.ofFrames tapped)
          (turned, own) = actionLine context now {cycleNow = Nothing, afterTap = Nothing} turn
          (final, behind) = inForce turned
       in (final, ["G80" | isJust (cycleNow now)] <> own <> behind)
  _ -> inForce now
  where
    inForce now' = linesInForce context now' frames

-- | Lines of frames for which the spindle turns as they ask.
linesInForce :: Context -> Writing -> [PlannedFrame] -> (Writing, [Text])
linesInForce context now frames = case frames of
  [] -> (ended, stop)
  _
    | not (isAway now),
      Just c <- HoleCycle.found (machine context) (form context) taps before' frames ->
      let (moved, own) = cycleLines context now c
          (final, behind) = frameLines context moved (HoleCycle.others c)
       in (final, own <> behind)
  -- The tool stands over its first hole: its commands and its way down come before the cycle.
  p@PlannedFrame {frame = f, role = Frame.Drilling _} : more
    | isSink f,
      not (null (commands f)) ->
      let (commanded, before) = actionLines context ended (actionsOf (machine context) f)
          bare = p {frame = f {commands = []}}
          (final, behind) = frameLines context commanded {afterTap = Nothing} (bare : more)
       in (final, stop <> before <> behind)
    | isSink f && isAway now,
      isJust (HoleCycle.found (machine context) (form context) taps before' frames) ->
      let arrived = now {isAway = False, isCoolantPaused = False, feedWritten = Nothing}
          (final, behind) = frameLines context arrived frames
       in (final, descentLines context now <> behind)
  p@PlannedFrame {frame = f} : more ->
    let (commanded, before) = actionLines context ended (actionsOf (machine context) f)
        (moved, own) = motionLines context commanded {afterTap = Nothing} f
        (final, behind) = frameLines context moved {isInside = isInsideAt p moved} more
     in (final, stop <> before <> own <> behind)
  where
    taps n = Map.lookup n (tapNeeds (heading context))
    before' = (at now, HoleCycle.byControl <$> afterTap now)
    stop = ["G80" | isJust (cycleNow now)]
    ended = now {cycleNow = Nothing}
    isSink f = case increment f of
      Pulses3 0 0 z -> motion f == Linear && z < 0
      _ -> False
    isInsideAt p now' = case passNumber (role p) of
      Just n -> Set.member n (insidePasses (heading context))
      Nothing -> isInside now'

-- | Line of a canned cycle. The words that stay in force are written only if they change.
cycleLines :: Context -> Writing -> FoundCycle -> (Writing, [Text])
cycleLines context@Context {machine, form} now c =
  (after, [Text.unwords (code <> place <> lasting) <> feedText])
  where
    sizes = HoleCycle.form c
    cycle' = Cycle.canned sizes
    isNew = fmap fst (cycleNow now) /= Just cycle'
    isSynchronous = cycle' == SynchronousCycle
    code = ["G98" | isNothing (cycleNow now), not isSynchronous] <> [Cycle.name cycle' | isNew]
    place
      | isSynchronous = []
      | otherwise = mapMaybe (axisText machine form (HoleCycle.over c)) [X, Y]
    lasting
      | Just (cycle', sizeWords) == cycleNow now = []
      | otherwise = sizeWords
    sizeWords =
      ["Z" <> heightText machine (Cycle.bottom sizes)]
        <> ["R" <> heightText machine (Cycle.plane sizes) | not isSynchronous]
        <> ["P" <> waitText form t | Just t <- [Cycle.wait sizes]]
        <> [ "Q" <> heightText machine q
             | cycle' `elem` [PeckingCycle, ChipCycle],
               q <- maybeToList (Cycle.peck sizes)
           ]
        <> [ "K" <> lengthText form (HoleCycle.tapPitch t)
             | isSynchronous,
               t <- maybeToList (HoleCycle.tap c)
           ]
    feedText
      | isSynchronous = ""
      | otherwise = feedWord context (feedWritten now) (HoleCycle.feed c)
    after =
      now
        { at = HoleCycle.over c,
          isCoolantPaused = False,
          cycleNow = if isSynchronous then Nothing else Just (cycle', sizeWords),
          afterTap = HoleCycle.afterTap c,
          feedWritten = if isSynchronous then feedWritten now else Just (HoleCycle.feed c)
        }

-- | Lines of commands.
actionLines :: Context -> Writing -> [ControlAction] -> (Writing, [Text])
actionLines context now actions = case actions of
  [] -> (now, [])
  a : more ->
    let (now', own) = actionLine context now a
        (final, behind) = actionLines context now' more
     in (final, own <> behind)

actionLine :: Context -> Writing -> ControlAction -> (Writing, [Text])
actionLine context@Context {machine, form, heading} now action = case action of
  ToTool n ->
    ( now
        { isAway = True,
          turns = False,
          isCoolantPaused = hasCoolant now,
          feedWritten = Nothing,
          tipOffset = tipOf context (Just n)
        },
      retractLines context (isInside now)
        <> ["M5" | not (isSpindleByHand heading)]
        <> ["M9" | hasCoolant now]
        <> toolLines context (Just n)
    )
  Turning ws | Just ws == (HoleCycle.byControl <$> afterTap now) -> (now {turns = True}, [])
  Turning ws ->
    ( now {turns = True},
      [turnLine, dwellLine form (spinUp form)]
    )
    where
      -- A line for Marlin begins with its command.
      turnLine = Text.unwords ((if dialect form == Marlin then reverse else id) texts)
      texts = map (commandText machine) ws
  StopSpindle -> (now {turns = False}, ["M5"])
  CoolantSwitch isOn ->
    (now {hasCoolant = isOn, isCoolantPaused = False}, [if isOn then "M8" else "M9"])
  -- A stop or a dwell has the coolant of the program.
  OtherCommand c ->
    ( now {isCoolantPaused = False},
      ["M8" | isCoolantPaused now] <> [commandText machine c]
    )

-- | Lines of the motion of a frame. A tool that is away comes down first.
motionLines :: Context -> Writing -> Frame -> (Writing, [Text])
motionLines context@Context {form} now f
  | not (Frame.isMoving f) = (now, [])
  -- The tool comes from above, so it comes down to the end of the move.
  | isAway now && isRise f = (moved, descentLines context now {at = end})
  | otherwise =
    (moved, (if isAway now then descentLines context now else []) <> modes <> [own])
  where
    end = at now + increment f
    own =
      motionText context (end + tipOffset now) f <> case motion f of
        Rapid -> rapidFeed context
        _ -> feedWord context written (feedCode f)
    modes = [if perTurn then "G95" else "G94" | motion f /= Rapid, perTurn /= isPerTurn now]
    perTurn = case feedCode f of
      TurnCode _ -> True
      FeedCode _ -> False
    written = if isAway now then Nothing else feedWritten now
    moved =
      now
        { at = end,
          isAway = False,
          isCoolantPaused = False,
          isPerTurn = if motion f == Rapid then isPerTurn now else perTurn,
          feedWritten = case motion f of
            Rapid -> if dialect form == Marlin then Nothing else written
            _ -> Just (feedCode f)
        }

-- | Lines that take a tool from the retract height to its position: x and y first, then z. On a
-- lathe the axis that left the work first comes back last.
descentLines :: Context -> Writing -> [Text]
descentLines context@Context {machine, form} now =
  ["M8" | isCoolantPaused now]
    <> [ "G0 " <> Text.unwords (mapMaybe here axes) <> rapidFeed context
         | axes <- if isJust (lathe form) then latheAxes else [[X, Y], [Z]]
       ]
  where
    latheAxes = if isInside now then [[Y], [X]] else [[X], [Y]]
    here = axisText machine form (at now + tipOffset now)

-- | Words of the motion of a frame to a position, without its feed.
motionText :: Context -> Pulses3 -> Frame -> Text
motionText Context {machine, form} end f = Text.unwords (motionWord : axisWords <> centreWords)
  where
    motionWord = case motion f of
      Rapid -> "G0"
      Circular Carrier.Clockwise -> "G2"
      Circular Carrier.CounterClockwise -> "G3"
      _ -> "G1"
    axisWords =
      [ word
        | axis <- [X, Y, Z],
          component axis (increment f) /= 0 || isFullCircle && axis /= Z,
          word <- maybeToList (axisText machine form end axis)
      ]
    isFullCircle = case (motion f, increment f) of
      (Circular _, Pulses3 0 0 _) -> True
      _ -> False
    centreWords = case motion f of
      Circular _ ->
        let Pulses2 i j = centre f
         in [scaledText machine (Centre axis) n | (axis, n) <- [(X, i), (Y, j)]]
      _ -> []

-- | Feed word of a cut, if its feed is not in force.
feedWord :: Context -> Maybe FeedCode -> FeedCode -> Text
feedWord Context {machine, form} written code
  | written == Just code = ""
  | otherwise = " F" <> feedNumber machine form code

-- | Feed word of a rapid move, on controls that need one.
rapidFeed :: Context -> Text
rapidFeed Context {machine, form} = case dialect form of
  Marlin -> " F" <> feedNumber machine form (Machine.rapidCode machine)
  _ -> ""
