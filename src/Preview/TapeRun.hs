-- | Tape that the page plays, with what it needs to know of each frame.
module Preview.TapeRun
  ( TapeRun (..),
    FrameFact (..),
    fromSound,
  )
where

import Base.LazyList qualified as LazyList
import Base.PulseVector (Pulses3)
import Base.Result (Result (..))
import Compile (Punched (..))
import Compile qualified
import Control.Applicative ((<|>))
import Data.ByteString qualified as ByteString
import Data.IntMap.Strict (IntMap)
import Data.IntMap.Strict qualified as IntMap
import Data.List qualified as List
import Data.Maybe (fromMaybe, listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Data.Text.Encoding.Error qualified as Encoding
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Draw.ToolUse qualified as ToolUse
import Frame.Frame (PlannedFrame (cutterRadius, origin, role), Role (..))
import Frame.Frame qualified as Frame
import Gcode.Heading qualified as Heading
import Gcode.ToFrames (readFrames, readFrom)
import Gcode.Writer qualified as Writer
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Part.Part qualified as Part
import Preview.ReportList (FileLines)
import Preview.ReportList qualified as ReportList
import Preview.Subject
import Project.Job (Verification (Verified))
import Project.LoadedProgram (LoadedProgram (descriptions, source))
import Project.Target qualified as Target
import Pulse.Controller (Console)
import Pulse.Controller qualified as Controller
import Report.Report (Report)
import Tape.Punch (TapeFrame (rowsRead))
import Tape.Punch qualified as Punch
import Tape.Tape (Tape (Tape))
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.FromGcode qualified as FromGcode

-- | Tape with its machine.
data TapeRun = TapeRun
  { machine :: Machine,
    console :: Console,
    -- | position of the cutter before the tape
    start :: Pulses3,
    rows :: Tape,
    -- | facts of the frames in order; empty for a tape without its program
    facts :: Vector FrameFact,
    -- | for a machine that reads a text: the text, and the line of each frame
    text :: Maybe (Text, [Int])
  }

-- | Facts of a frame in the program: its tool as an index, or −1; the index of the file and the
-- line that ask for it.
data FrameFact = FrameFact {isCut :: Bool, tool :: Int, file :: Int, line :: Int}
  deriving stock (Eq, Show)

-- | Tape of a subject for the machine with a name. A tape without its program has only one machine.
fromSound :: Sound -> Text -> Result Report Report TapeRun
fromSound subject name = case subject of
  SoundProgram state -> ofProgram state name
  TapeAlone TapeState {tapeMachine, aloneTape, gcodeText} ->
    pure
      TapeRun
        { machine = tapeMachine,
          console = Controller.neutral,
          start = 0,
          rows = aloneTape,
          facts = Vector.empty,
          text = gcodeText <|> plainText tapeMachine 0 aloneTape
        }

ofProgram :: ProgramState -> Text -> Result Report Report TapeRun
ofProgram ProgramState {loaded, part, path} name =
  Target.targets (descriptions loaded) [name] part path >>= \case
    machine : _
      | all (null . Toolpath.moves) (Toolpath.blocks path) ->
        withFrames loaded path machine <$> Compile.punch machine path
      | otherwise ->
        -- The files of a modern control depend on the proof: it bounds the deviation at corners.
        withFrames loaded path machine . Compile.punched
          <$> Compile.makeTape Verified path machine
    [] -> Result [] [] Nothing

withFrames :: LoadedProgram -> Toolpath -> Machine -> Punched -> TapeRun
withFrames loaded path machine punched@Punched {program, tape} =
  TapeRun
    { machine,
      console = Controller.consoleFor machine planned,
      start = Frame.start program,
      rows = tape,
      facts = Vector.fromList (frameFacts (ReportList.fileLines (source loaded)) path planned),
      text = writtenText machine path punched <|> plainText machine (Frame.start program) tape
    }
  where
    planned = Frame.plannedFrames program

-- | Files for a modern control, one after the other, and the line of each frame in them; Nothing
-- for a machine that reads a tape.
writtenText :: Machine -> Toolpath -> Punched -> Maybe (Text, [Int])
writtenText machine path Punched {program, files} = written <$> Machine.programForm machine
  where
    texts = map Writer.fileText files
    written form =
      ( Text.concat texts,
        either
          (const [])
          (map readFrom . readFrames)
          (FromGcode.readTexts machine form (Heading.fromToolpath path) program texts)
      )

-- | Text of a machine whose medium is a text without a form of programs, and the line in which each
-- frame ends; Nothing for a punched tape.
plainText :: Machine -> Pulses3 -> Tape -> Maybe (Text, [Int])
plainText machine start tape@(Tape bytes) = case Machine.pitch (Machine.medium machine) of
  Just _ -> Nothing
  Nothing ->
    Just
      ( Encoding.decodeUtf8With Encoding.lenientDecode bytes,
        linesOf 1 (ByteString.elemIndices 10 bytes) (drop 1 (scanl (+) 0 counts))
      )
  where
    counts = map rowsRead (LazyList.toList (Punch.readInTurn machine start tape))
    linesOf n breaks ends = case (breaks, ends) of
      (b : more, e : _) | b + 1 < e -> linesOf (n + 1) more ends
      (_, _ : others) -> n : linesOf n breaks others
      (_, []) -> []

-- | Facts of planned frames. A pass and a block of drilling have the tool of their block. Between
-- them, a frame has the next tool if that has the radius of its cutter, else the last one.
frameFacts :: FileLines -> Toolpath -> [PlannedFrame] -> [FrameFact]
frameFacts known path planned = zipWith fact planned tools
  where
    radii = map (Part.cutterRadius . ToolUse.cutter) (ToolUse.uses path)
    (ofPasses, ofBlocks) = toolsOfBlocks path
    own p = case role p of
      Drilling n -> IntMap.lookup n ofBlocks
      Carving n -> IntMap.lookup n ofBlocks
      other -> Frame.passNumber other >>= (`IntMap.lookup` ofPasses)
    laterTools = drop 1 (scanr (\p later -> own p <|> later) Nothing planned)
    tools = snd (List.mapAccumL next (-1) (zip planned laterTools))
    next now (p, later) = let tool = fromMaybe (between now p later) (own p) in (tool, tool)
    between now p later = case later of
      Just tool | now < 0 || listToMaybe (drop tool radii) == Just (cutterRadius p) -> tool
      _ -> now
    fact p tool =
      let (file, line) = ReportList.lineOf known (origin p)
       in FrameFact {isCut = cuts (role p), tool, file, line}
    cuts role' = case role' of
      Cutting _ -> True
      Drilling _ -> True
      Carving _ -> True
      Approaching _ -> False
      Retracting _ -> False
      Linking -> False
      Commanding -> False

-- | Tools of the passes by their numbers, and of the blocks of drilling and carving by the
-- numbers of the blocks.
toolsOfBlocks :: Toolpath -> (IntMap Int, IntMap Int)
toolsOfBlocks path =
  ( IntMap.fromList [(pass, tool) | ((Just tool, b), _, pass) <- inUse, isPass b],
    IntMap.fromList [(n, tool) | ((Just tool, b), n, _) <- inUse, hasRole b]
  )
  where
    inUse =
      zip3
        (ToolUse.blocksWithTools path)
        [0 ..]
        (Toolpath.passNumbers (Toolpath.blocks path))
    hasRole b = case b of
      Toolpath.Holing _ _ -> True
      Toolpath.Carved {} -> True
      _ -> False
    isPass b = case b of
      Toolpath.Cutting {} -> True
      Toolpath.Clearing {} -> True
      Toolpath.Travelling {} -> False
      Toolpath.Holing _ _ -> False
      Toolpath.Carved {} -> False
      Toolpath.Commanding _ -> False
