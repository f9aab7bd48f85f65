-- | Frames as a table or as JSON lines. Increments, turns and arc centres are in pulses, positions
-- in mm, feeds in mm\/min. The column @speed@ has the feed code, by which the tape names a feed. If
-- the feed codes of the machine are frequencies, as on the Контур, there are columns for the pulses
-- per second of each axis.
module Cli.FrameTable
  ( frames,
    framesJson,
    decoded,
  )
where

import Base.Decimal qualified as Decimal
import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Feed (..), LengthUnit (..), Mm (..), Pulses (..))
import Base.Region (Position (..), Region (..), Source)
import Base.Region qualified as Region
import Cli.Table (Align (..))
import Cli.Table qualified as Table
import Data.Aeson (object, (.=))
import Data.Aeson.Encoding (encodingToLazyByteString)
import Data.Aeson.Encoding qualified as Aeson
import Data.Aeson.Key qualified as Key
import Data.Aeson.Types (Pair)
import Data.ByteString.Lazy qualified as LazyByteString
import Data.Containers.ListUtils (nubOrd)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Frame.FeedCode qualified as FeedCode
import Frame.Frame (Frame (..), FrameMotion (..), FrameProgram, PlannedFrame (..), Role (..))
import Frame.Frame qualified as Frame
import Geometry.Carrier (Sense (..))
import Geometry.Vec qualified as Vec
import Machine.Machine (CommandName (..), Machine, RotaryAxis, RotaryForm (..))
import Machine.Machine qualified as Machine

-- | A column: its alignment, its heading, and the function that makes its cell for a row.
data Column a = Column {align :: Align, title :: Text, cell :: a -> Text}

-- | A frame with its number, from 1, and the position of the cutter at its end, in pulses.
data Numbered = Numbered {number :: Int, planned :: PlannedFrame, to :: Pulses3}

-- | The table of the frames of a program. Each row ends with the number of the program's line from
-- which the frame is made, and with the commands of the frame. The columns of kinds of motion, arc
-- centres, braking, heights and commands are left out if no frame needs them. Positions and feeds
-- have the given unit of lengths.
frames :: LengthUnit -> Machine -> Source -> FrameProgram -> Text
frames unit machine source program = table columns rows
  where
    rows = numbered program
    all' = map (frame . planned) rows
    hasHeights = any (\f -> let Pulses3 _ _ z = increment f in z /= 0) all'
    columns =
      [ Column ToRight "frame" (Decimal.whole . number),
        Column ToLeft "for" (roleWord . role . planned)
      ]
        <> map (via (frame . planned)) (motionColumns machine all')
        <> [Column ToRight "speed" (speedWord . frame . planned), Column ToRight feedTitle feedOf]
        <> map (via (frame . planned)) (frequencyColumns machine all')
        <> map (via (frame . planned)) (brakeColumn all')
        <> [ Column ToRight "to x" (coordinate . Vec.x . endOf),
             Column ToRight "to y" (coordinate . Vec.y . endOf)
           ]
        <> [ Column ToRight "to z" (\n -> let Mm z = Frame.height machine (to n) in coordinate z)
             | hasHeights
           ]
        <> [Column ToRight "line" (lineWord source . planned)]
        <> map (via (frame . planned)) (commandColumns all')
    endOf n = Frame.position machine (to n)
    feedOf n = feedWord unit machine (frame (planned n))
    coordinate = Decimal.fixedIn unit 3 . Mm
    feedTitle = Decimal.unitText unit <> "/min"

-- | The frames of a program as JSON, one object on each line. Every object has all fields, except
-- that only arcs have @centre@, only frames of machines with rotary axes have @turn@, only straight
-- frames of machines whose feed codes are frequencies have @frequencies@, in pulses per second, and
-- only frames with a feed for one turn of the spindle have @feedPerTurn@, in mm; a feed that is not
-- known is @null@.
framesJson :: Machine -> Source -> FrameProgram -> Text
framesJson machine source program = Text.concat (map row (numbered program))
  where
    row n =
      let f = frame (planned n)
          s = Machine.codeNumber (feedCode f)
          p = Frame.position machine (to n)
       in jsonLine
            ( [ "frame" .= number n,
                "role" .= roleWord (role (planned n)),
                "motion" .= motionWord (motion f)
              ]
                <> distancesJson machine f
                <> [ "speed" .= s,
                     "feed"
                       .= ( (\(Feed v) -> v)
                              <$> FeedCode.feedOf machine f (FeedCode.frameLength machine f)
                          ),
                     "braking" .= braking f,
                     "commands" .= object [Key.fromText o .= v | (CommandName o, v) <- commands f],
                     "to" .= [Vec.x p, Vec.y p, let Mm z = Frame.height machine (to n) in z],
                     "file"
                       .= ( let Position {file} =
                                  Region.position source (start (origin (planned n)))
                             in file
                          ),
                     "line" .= lineOf source (planned n)
                   ]
                <> ["feedPerTurn" .= d | Just d <- [Machine.forTurn machine (feedCode f)]]
                <> [ "frequencies"
                       .= object
                         [ Key.fromText (Machine.contentName (Machine.Along a)) .= hertz
                           | (a, hertz) <- found
                         ]
                     | found@(_ : _) <- [FeedCode.frequencies machine f]
                   ]
            )
    jsonLine pairs =
      Encoding.decodeUtf8
        (LazyByteString.toStrict (encodingToLazyByteString (Aeson.value (object pairs))))
        <> "\n"

-- | The fields for the pulses of a frame: increments, turns, the centre of an arc.
distancesJson :: Machine -> Frame -> [Pair]
distancesJson machine f =
  ["increment" .= [dx, dy, dz]]
    <> [ "turn" .= object [Key.fromText (rotaryWord a) .= n | (a, Pulses n) <- turns]
         | not (null turns)
       ]
    <> ["centre" .= [i, j] | isArc f]
  where
    Pulses3 (Pulses dx) (Pulses dy) (Pulses dz) = increment f
    Pulses2 (Pulses i) (Pulses j) = centre f
    turns = [(a, Frame.turnAbout a f) | a <- map rotaryAxis (Machine.rotaryAxes machine)]

-- | The table of frames that were read from a tape. It has no positions and no lines of a program,
-- because the tape does not contain the start position and the program.
decoded :: Machine -> [Frame] -> Text
decoded machine fs = table columns (zip [1 :: Int ..] fs)
  where
    columns =
      [Column ToRight "frame" (Decimal.whole . fst)]
        <> map (via snd) (motionColumns machine fs)
        <> [ Column ToRight "speed" (speedWord . snd),
             Column
               ToRight
               "mm/min"
               (feedWord Millimetres machine . snd)
           ]
        <> map (via snd) (frequencyColumns machine fs <> brakeColumn fs <> commandColumns fs)

table :: [Column a] -> [a] -> Text
table columns rows =
  Table.columns (map align columns) (map title columns : map (\r -> map (`cell` r) columns) rows)

-- | Makes a column for rows of type @b@ from a column for rows of type @a@. @get@ takes the @a@
-- out of a row.
via :: (b -> a) -> Column a -> Column b
via get c = c {cell = cell c . get}

-- | Columns for the increments in pulses. If some frames are arcs or rapid moves, there is also a
-- column for the kind of motion. If some frames turn rotary axes, there is a column for each
-- rotary axis of the machine. If some frames are arcs, there are also columns for their centres.
motionColumns :: Machine -> [Frame] -> [Column Frame]
motionColumns machine fs =
  [ Column ToLeft "motion" (motionWord . motion)
    | any ((`notElem` [NoMotion, Linear]) . motion) fs
  ]
    <> [ Column ToRight "dx" (\f -> let Pulses3 x _ _ = increment f in pulses x),
         Column ToRight "dy" (\f -> let Pulses3 _ y _ = increment f in pulses y),
         Column ToRight "dz" (\f -> let Pulses3 _ _ z = increment f in pulses z)
       ]
    <> [ Column ToRight ("d" <> rotaryWord a) (pulses . Frame.turnAbout a)
         | any ((/= 0) . turn) fs,
           a <- map rotaryAxis (Machine.rotaryAxes machine)
       ]
    <> concat
      [ [ Column ToRight "i" (ofCentre (\(Pulses2 i _) -> i)),
          Column ToRight "j" (ofCentre (\(Pulses2 _ j) -> j))
        ]
        | any isArc fs
      ]
  where
    pulses (Pulses n) = Decimal.whole n
    ofCentre get f = if isArc f then pulses (get (centre f)) else ""

-- | A column of the pulses per second for each axis that some frame moves; the empty list on a
-- machine whose feed codes are no frequencies.
frequencyColumns :: Machine -> [Frame] -> [Column Frame]
frequencyColumns machine fs =
  [ Column ToRight ("Hz " <> Machine.contentName (Machine.Along axis)) (frequencyWord axis)
    | axis <- [Machine.X, Machine.Y, Machine.Z],
      any (maybe False (> 0) . lookup axis . FeedCode.frequencies machine) fs
  ]
  where
    frequencyWord axis f = maybe "" (Decimal.short 3) (lookup axis (FeedCode.frequencies machine f))

-- | A column that marks the frames of braking sections; the empty list if no frame brakes.
brakeColumn :: [Frame] -> [Column Frame]
brakeColumn fs = [Column ToLeft "" (\f -> if braking f then "brakes" else "") | any braking fs]

-- | One column for each command that occurs in the frames. A cell has the number that the frame
-- gives to the command, such as the number of the tool in a tool change.
commandColumns :: [Frame] -> [Column Frame]
commandColumns fs =
  [ Column ToRight name (maybe "" Decimal.whole . lookup o . commands)
    | o@(CommandName name) <- nubOrd (concatMap (map fst . commands) fs)
  ]

-- | Name of a rotary axis.
rotaryWord :: RotaryAxis -> Text
rotaryWord axis = Machine.contentName (Machine.About axis)

isArc :: Frame -> Bool
isArc f = case motion f of
  Circular _ -> True
  NoMotion -> False
  Rapid -> False
  Linear -> False

motionWord :: FrameMotion -> Text
motionWord m = case m of
  NoMotion -> ""
  Rapid -> "rapid"
  Linear -> "line"
  Circular Clockwise -> "arc cw"
  Circular CounterClockwise -> "arc ccw"

-- | The frames with their numbers, from 1, and their end positions. An end position is the start
-- position of the program plus all increments up to this frame.
numbered :: FrameProgram -> [Numbered]
numbered program =
  zipWith3
    Numbered
    [1 ..]
    ps
    (drop 1 (scanl (+) (Frame.start program) (map (increment . frame) ps)))
  where
    ps = Frame.plannedFrames program

-- | The number, from 1, of the program's line from which a frame is made. If that line is in an
-- imported file, the name of the file precedes the number.
lineWord :: Source -> PlannedFrame -> Text
lineWord source p =
  (if file == Region.mainFile source then "" else file <> ":") <> Decimal.whole (lineOf source p)
  where
    Position {file} = Region.position source (start (origin p))

lineOf :: Source -> PlannedFrame -> Int
lineOf source p = line (Region.position source (start (origin p)))

roleWord :: Role -> Text
roleWord r = case r of
  Approaching _ -> "approach"
  Cutting _ -> "cut"
  Retracting _ -> "retract"
  Linking -> "travel"
  Drilling _ -> "drill"
  Carving _ -> "carve"
  Commanding -> "command"

speedWord :: Frame -> Text
speedWord = Decimal.whole . Machine.codeNumber . feedCode

-- | Feed of a frame: per minute, or with a stroke the feed for one turn of the spindle.
feedWord :: LengthUnit -> Machine -> Frame -> Text
feedWord unit machine f = case Machine.forTurn machine (feedCode f) of
  Just d -> Decimal.shortIn unit 4 (Mm d) <> "/rev"
  Nothing ->
    maybe
      ""
      (\(Feed v) -> Decimal.shortIn unit 2 (Mm v))
      (FeedCode.feedOf machine f (FeedCode.frameLength machine f))
