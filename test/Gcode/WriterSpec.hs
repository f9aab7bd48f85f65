-- | Law of files for modern controls: what the writer writes, the reader reads as the same frames.
module Gcode.WriterSpec (spec) where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..))
import Base.Region (Region (Region))
import Control.Monad (forM_)
import Data.List (foldl', mapAccumL)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, isNothing, maybeToList)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Command (Pending (..))
import Frame.Command qualified as Command
import Frame.CommandState (CommandState (..))
import Frame.CommandState qualified as CommandState
import Frame.Frame
  ( Frame (..),
    FrameMotion (..),
    FrameProgram (..),
    PlannedFrame (PlannedFrame),
    Role (..),
  )
import Frame.Frame qualified as Frame
import Gcode.Heading (FileHeading (..))
import Gcode.Writer qualified as Writer
import Geometry.Carrier qualified as Carrier
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine
  ( FeedCode (..),
    Machine (programForm),
    MachineName (..),
    ProgramForm (mostCharacters),
  )
import Part.Part (Sense (..))
import Test.Hspec
import Test.QuickCheck
import Verify.FromGcode qualified as FromGcode

spec :: Spec
spec = describe "files for modern controls" $ do
  forM_ ["linuxcnc-mill", "grbl", "marlin", "haas", "fanuc"] $ \name ->
    it ("are read as the frames that were written, for " <> Text.unpack name) $
      forAll (programs (machineNamed name)) $ \program ->
        readBack (machineNamed name) program === Right (framesOf program)
  it "have no line that is longer than the control reads, and only harmless characters" $
    forAll ((,) <$> elements ["linuxcnc-mill", "grbl", "marlin"] <*> titles) $ \(name, title) ->
      let written =
            concatMap
              (Text.lines . Writer.fileText)
              (textsOf (machineNamed name) heading {partTitle = title} oneMove)
          comments = filter (\l -> Text.take 1 l `elem` ["(", ";"]) written
       in conjoin
            [ counterexample (show l) $
                Text.length l <= mostCharacters (formOf name)
                  && Text.all isPlain (Text.drop 1 (bare l))
              | l <- comments
            ]
  where
    formOf = fromMaybe (error "no form") . programForm . machineNamed
    bare l = if ")" `Text.isSuffixOf` l then Text.dropEnd 1 l else l
    isPlain c = c >= ' ' && c <= '~' && c `notElem` ("()%;!?~" :: String)
    titles =
      Text.pack <$> listOf (frequency [(3, elements "MSG,debug()%;!?~\n\rµ"), (1, arbitrary)])
    oneMove =
      programOf
        (machineNamed "linuxcnc-mill")
        (Pulses3 0 0 20000)
        [(CommandState.initial {tool = Just 1}, line (Pulses3 1000 0 0))]

machineNamed :: Text -> Machine
machineNamed name = fromMaybe (error "no such machine") (BuiltIn.find (MachineName name))

heading :: FileHeading
heading =
  FileHeading
    { partName = "plate",
      partTitle = "Cover",
      workOffset = 55,
      programNumber = Just 12,
      firstTool = Just 1,
      toolList = [(1, "mill, diameter 8 mm")],
      toolOrder = [1],
      safeHeight = Just (Mm 60),
      freeHeight = Mm 5,
      isSpindleByHand = False,
      cutters = Map.empty,
      insidePasses = Set.empty,
      turnings = [],
      tapNeeds = Map.empty
    }

textsOf :: Machine -> FileHeading -> FrameProgram -> [Writer.ToolFile]
textsOf machine given program = case programForm machine of
  Just form -> Writer.write machine form given Nothing program
  Nothing -> []

-- | Frames that are read from the files of a program; Left with the fault of a line.
readBack :: Machine -> FrameProgram -> Either String [Frame]
readBack machine program = case programForm machine of
  Nothing -> Left "no form"
  Just form ->
    either (Left . show) (Right . FromGcode.framesRead) $
      FromGcode.readTexts
        machine
        form
        given
        program
        (map Writer.fileText (textsOf machine given program))
  where
    given = heading {toolOrder = 1 : changesOf program}
    changesOf p = [n | f <- framesOf p, (name, n) <- commands f, show name == "CommandName \"T\""]

framesOf :: FrameProgram -> [Frame]
framesOf = map Frame.frame . plannedFrames

-- | Random programs: motions with random commands between them, below the safe height.
programs :: Machine -> Gen FrameProgram
programs machine = do
  z <- choose (5000, 30000)
  count <- choose (1, 25)
  states <- vectorOf count states'
  moves <- vectorOf count moves'
  first <- elements [[], [rapid (Pulses3 0 0 7000)]]
  pure
    ( programOf
        machine
        (Pulses3 1000 (-2000) (Pulses z))
        (zip (drop 1 (scanl keep begin states)) (take count (first <> moves)))
    )
  where
    begin = CommandState.initial {tool = Just 1}
    keep earlier now = if isNothing (tool now) then now {tool = tool earlier} else now
    states' =
      CommandState
        <$> frequency [(6, pure Nothing), (1, Just <$> elements [1, 2, 3, 4])]
        <*> oneof
          [ pure Nothing,
            curry Just
              <$> elements [Clockwise, CounterClockwise]
              <*> (CommandState.TurnNumber <$> choose (100, 9000))
          ]
        <*> arbitrary
    moves' =
      oneof
        [ rapid <$> increments,
          line <$> increments,
          arc <$> elements [Carrier.Clockwise, Carrier.CounterClockwise] <*> choose (500, 9000)
        ]
    increments =
      (Pulses3 <$> small <*> small <*> (Pulses <$> choose (-900, 900))) `suchThat` (/= 0)
    small = Pulses <$> frequency [(1, pure 0), (3, choose (-5000, 5000))]

-- | Program of motions, each with the state of tool, spindle and coolant that it needs.
programOf :: Machine -> Pulses3 -> [(CommandState, Frame)] -> FrameProgram
programOf machine start moves = FrameProgram start (map planned (concat made <> rest <> ends))
  where
    ((_, left), made) = mapAccumL add (CommandState.initial {tool = Just 1}, Nothing) moves
    rest = [Frame.commandFrame (given p) | p <- maybeToList left]
    ends = map Frame.commandFrame (Command.finalFrames machine)
    planned f = PlannedFrame f Linking (Region 0 0) (Mm 0) 0
    add (earlier, waiting) (now, f) =
      let (full, left') =
            foldl' group ([], waiting) (CommandState.between machine earlier now)
       in ( (now, Nothing),
            map (Frame.commandFrame . given) full <> [f {commands = maybe [] given left'}]
          )
    group (full, waiting) ws =
      let (more, pending') =
            Command.add machine (Region 0 0) (Command.Translation ws False [] []) waiting
       in (full <> more, pending')

rapid, line :: Pulses3 -> Frame
rapid d = (Frame.commandFrame []) {motion = Rapid, increment = d}
line d = (Frame.commandFrame []) {motion = Linear, increment = d, feedCode = FeedCode 300}

-- | Half a circle with a radius in pulses.
arc :: Carrier.Sense -> Int -> Frame
arc sense r =
  (Frame.commandFrame [])
    { motion = Circular sense,
      increment = Pulses3 (Pulses (2 * r)) 0 0,
      centre = Pulses2 (Pulses r) 0,
      feedCode = FeedCode 120
    }
