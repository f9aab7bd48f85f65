-- | Files for lathes: the frames that are written are read again, the point that the tool table
-- measures is led, and LinuxCNC's interpreter makes the same motions.
module Gcode.ToolTipSpec (spec) where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..))
import Base.Region (Region (Region))
import Command (partc)
import Control.Monad (forM_)
import Data.List (foldl', isInfixOf, mapAccumL)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, maybeToList)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.IO qualified as Text
import Data.Text.Read qualified as Read
import Files (filesBelow)
import Frame.Command (Pending (..))
import Frame.Command qualified as Command
import Frame.CommandState (CommandState (..), SpindleNumbers (..))
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
import Gcode.ModalState (MotionMode (..))
import Gcode.Run (Action (..), Coordinate (..), Step (..), ToolPlace (..), Travel (..))
import Gcode.Run qualified as Run
import Gcode.Writer qualified as Writer
import Geometry.Carrier qualified as Carrier
import LinuxCnc qualified
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine
  ( FeedChoice (..),
    FeedCode (..),
    Machine (programForm),
    MachineName (..),
    ProgramForm,
  )
import Machine.Machine qualified as Machine
import Part.Part (Cutter (..), CutterKind (..), Sense (..), plainBody)
import System.Directory (listDirectory)
import System.Exit (ExitCode (..))
import System.FilePath (takeExtension, (</>))
import System.IO.Temp (withSystemTempDirectory)
import System.Process (readProcessWithExitCode)
import Test.Hspec
import Test.QuickCheck
import Verify.FromGcode qualified as FromGcode

spec :: Spec
spec = describe "files for lathes" $ do
  forM_ [("mm", lathe), ("inches", Machine.inInches lathe)] $ \(unit, machine) ->
    it ("are read as the frames that were written, in " <> unit) $
      forAll ((,) <$> headings <*> programs machine) $ \(given, program) ->
        readBack machine given program === Right (framesOf program)
  it "have cutting speeds in feet and feeds for one turn in inches, in inches" $ do
    let machine = Machine.inInches lathe
        speed = initial {CommandState.spindle = Just (Clockwise, SurfaceNumbers 182880 (Just 2500))}
        feed = [code | Just (Given code _) <- [Machine.chooseTurn machine 0.254]]
        given = headingOf [(1, turning 0 9)]
        text = Text.lines . textOf machine given . programOf machine
        along code =
          (Frame.commandFrame [])
            { motion = Linear,
              increment = Pulses3 (-10000) 0 0,
              feedCode = code
            }
    text [(speed, along code, Linking) | code <- feed]
      `shouldSatisfy` (\ls -> all (`elem` ls) ["G96 D2500 S600 M3", "G95", "G1 Z-0.5000 F0.01"])
  it "lead the point of the tool that the tool table measures" $
    forAll (choose (1, 9)) $ \tip' ->
      forAll (elements [0, 0.2, 0.4, 0.8, 1.2]) $ \radius ->
        forAll onePass $ \program ->
          let given = headingOf [(1, turning radius tip')]
           in placesIn (textOf lathe given program) === map (moved radius tip') (centresOf program)
  examples <- runIO (filter ((== ".part") . takeExtension) <$> filesBelow "examples/cnc")
  lathes <- runIO (concat <$> traverse ofLathe examples)
  isThere <- runIO LinuxCnc.installed
  it "has examples" $ length lathes `shouldSatisfy` (>= 3)
  forM_ lathes $ \file ->
    it ("makes the motions of LinuxCNC's interpreter: " <> file) $
      if isThere
        then sameMotions file
        else pendingWith "rs274 is not installed (scripts/setup.sh installs linuxcnc-uspace)"
  where
    ofLathe file = do
      text <- Text.readFile file
      pure [file | "linuxcnc-lathe" `isInfixOf` Text.unpack text]

lathe :: Machine
lathe = fromMaybe (error "no lathe") (BuiltIn.find (MachineName "linuxcnc-lathe"))

formOf :: Machine -> ProgramForm
formOf = fromMaybe (error "no form") . programForm

-- Programs ----------------------------------------------------------------------------------------

turning :: Double -> Int -> Cutter
turning radius n =
  Cutter
    { kind = TurningCutter,
      cutterRadius = Mm radius,
      cutterSize = Nothing,
      tip = Just n,
      tipRadius = Mm radius,
      body = plainBody
    }

headingOf :: [(Int, Cutter)] -> FileHeading
headingOf tools =
  FileHeading
    { partName = "shaft",
      partTitle = "",
      workOffset = 54,
      programNumber = Nothing,
      firstTool = Just 1,
      toolList = [],
      toolOrder = map fst tools,
      safeHeight = Nothing,
      freeHeight = Mm 0,
      isSpindleByHand = False,
      cutters = Map.fromList tools,
      insidePasses = Set.empty,
      turnings = [],
      tapNeeds = Map.empty
    }

headings :: Gen FileHeading
headings = do
  tools <- vectorOf 3 (turning <$> elements [0, 0.4, 0.8] <*> choose (1, 9))
  inside <- sublistOf [0 .. 2]
  pure (headingOf (zip [1 ..] tools)) {insidePasses = Set.fromList inside}

-- | Random programs with changes of the tool, speeds of both kinds and feeds of both kinds.
programs :: Machine -> Gen FrameProgram
programs machine = do
  count <- choose (1, 25)
  states <- vectorOf count states'
  moves <- vectorOf count moves'
  roles <- vectorOf count (oneof [pure Linking, Cutting <$> choose (0, 2)])
  let kept = drop 1 (scanl keep initial states)
  pure (programOf machine (zip3 kept moves roles))
  where
    keep earlier now = case tool now of
      Nothing -> now {tool = tool earlier}
      Just _ -> now
    states' =
      CommandState
        <$> frequency [(6, pure Nothing), (1, Just <$> elements [1, 2, 3])]
        <*> oneof
          [ pure Nothing,
            curry Just <$> elements [Clockwise, CounterClockwise] <*> speeds
          ]
        <*> arbitrary
    speeds =
      oneof
        [ TurnNumber <$> choose (50, 3000),
          SurfaceNumbers . (* 1000) . fromIntegral
            <$> choose (20 :: Int, 400)
            <*> (Just <$> choose (500, 4000))
        ]

-- | Random motions with the first tool.
onePass :: Gen FrameProgram
onePass = do
  count <- choose (1, 20)
  moves <- vectorOf count moves'
  let turns = initial {CommandState.spindle = Just (Clockwise, TurnNumber 800)}
  pure (programOf lathe [(turns, m, Linking) | m <- moves])

initial :: CommandState
initial = CommandState.initial {tool = Just 1}

moves' :: Gen Frame
moves' =
  oneof
    [ (\d -> still {motion = Rapid, increment = d}) <$> increments,
      (\d f -> still {motion = Linear, increment = d, feedCode = f}) <$> increments <*> feeds,
      arc
        <$> elements [Carrier.Clockwise, Carrier.CounterClockwise]
        <*> choose (500, 9000)
        <*> feeds
    ]
  where
    still = Frame.commandFrame []
    feeds = oneof [FeedCode <$> choose (1, 900), TurnCode <$> choose (1, 9000)]
    increments = (Pulses3 <$> small <*> small <*> pure 0) `suchThat` (/= 0)
    small = Pulses <$> frequency [(1, pure 0), (3, choose (-5000, 5000))]
    arc sense r code =
      still
        { motion = Circular sense,
          increment = Pulses3 (Pulses (2 * r)) 0 0,
          centre = Pulses2 (Pulses r) 0,
          feedCode = code
        }

programOf :: Machine -> [(CommandState, Frame, Role)] -> FrameProgram
programOf machine moves = FrameProgram begin (concat made <> map commanding (rest <> ends))
  where
    begin = Pulses3 5000 30000 0
    ((_, left), made) = mapAccumL add (initial, Nothing) moves
    rest = [Frame.commandFrame (given p) | p <- maybeToList left]
    ends = map Frame.commandFrame (Command.finalFrames machine)
    commanding f = PlannedFrame f Commanding (Region 0 0) (Mm 0) 0
    add (earlier, waiting) (now, f, role) =
      let (full, left') = foldl' group ([], waiting) (CommandState.between machine earlier now)
          own = f {commands = maybe [] given left'}
       in ( (now, Nothing),
            map (commanding . Frame.commandFrame . given) full
              <> [PlannedFrame own role (Region 0 0) (Mm 0) 0]
          )
    group (full, waiting) ws =
      let (more, pending') =
            Command.add machine (Region 0 0) (Command.Translation ws False [] []) waiting
       in (full <> more, pending')

framesOf :: FrameProgram -> [Frame]
framesOf = map Frame.frame . plannedFrames

textOf :: Machine -> FileHeading -> FrameProgram -> Text
textOf machine given program =
  Text.concat (map Writer.fileText (Writer.write machine (formOf machine) given Nothing program))

readBack :: Machine -> FileHeading -> FrameProgram -> Either String [Frame]
readBack machine given program =
  either (Left . show) (Right . FromGcode.framesRead) $
    FromGcode.readTexts machine (formOf machine) given program [textOf machine given program]

-- The measured point ------------------------------------------------------------------------------

-- | Positions of the centre at the ends of all motions, in micrometres along Z and X.
centresOf :: FrameProgram -> [(Int, Int)]
centresOf (FrameProgram begin planned) =
  map place (drop 1 (scanl (+) begin [increment f | PlannedFrame f _ _ _ _ <- planned, moves f]))
  where
    moves f = Frame.isMoving f
    place (Pulses3 (Pulses x) (Pulses y) _) = (x, y)

-- | Position of the measured point beside that of the centre. The words are those of the manual of
-- LinuxCNC, seen from the centre: towards the axis or away from it, towards the chuck or away.
moved :: Double -> Int -> (Int, Int) -> (Int, Int)
moved radius n (z, x)
  | n `elem` [1, 4, 5] = (z + r, x + across)
  | n `elem` [2, 3, 7] = (z - r, x + across)
  | otherwise = (z, x + across)
  where
    r = round (1000 * radius)
    across
      | n `elem` [1, 2, 6] = -r
      | n `elem` [3, 4, 8] = r
      | otherwise = 0

-- | Positions at the ends of the motions of a file in work coordinates, in micrometres along Z and
-- X, after the tool has come down. The words of X are halved here.
placesIn :: Text -> [(Int, Int)]
placesIn text = case Run.run (formOf lathe) Nothing 1 text of
  Left fault -> error (show fault)
  Right steps ->
    [ (z `div` 1000000, x `div` 1000000)
      | Step {action = Travels travel} <- steps,
        isKnown (from travel),
        ToolPlace {placeX = At x, placeZ = At z} <- [to travel]
    ]
  where
    isKnown p = case (placeX p, placeZ p) of
      (At _, At _) -> True
      _ -> False

-- LinuxCNC ----------------------------------------------------------------------------------------

-- | Motion: its kind, its end in mm along Z and X if it is known, and the centre of an arc.
data Motion = Motion Text (Maybe Double, Maybe Double) (Maybe (Double, Double))
  deriving stock (Show)

-- | Compares the motions that the interpreter makes of the file of an example with those that
-- "Gcode.Run" reads.
sameMotions :: FilePath -> Expectation
sameMotions part = withSystemTempDirectory "partc-lathe" $ \folder -> do
  (status, _, reports) <- partc ["compile", "-o", folder <> "/", part]
  (status, reports) `shouldBe` (ExitSuccess, "")
  names <- listDirectory folder
  let file = folder </> concat (take 1 names)
  text <- Text.readFile file
  Text.writeFile (folder </> "tools.tbl") (Text.unlines (map tool' [1 .. 9 :: Int]))
  (ended, out, complaint) <-
    readProcessWithExitCode
      "env"
      ["HOME=" <> folder, "rs274", "-g", "-t", folder </> "tools.tbl", file]
      ""
  (ended, complaint) `shouldBe` (ExitSuccess, "executing\n")
  case Run.run (formOf lathe) Nothing 1 text of
    Left fault -> expectationFailure (show fault)
    Right steps -> do
      let own = [motionOf travel | Step {action = Travels travel} <- steps]
          made = concatMap (canonical (unitOf text)) (Text.lines (Text.pack out))
      length made `shouldBe` length own
      [(a, b) | (a, b) <- zip own made, not (agrees (unitOf text) a b)] `shouldSatisfy` null
      length [() | Motion "ARC" _ _ <- made] `shouldSatisfy` (> 0)
  where
    unitOf text = if "G20" `Text.isInfixOf` text then 25.4 else 1
    tool' n =
      let s = Text.pack (show n)
       in "T" <> s <> " P" <> s <> " X0.5 Z" <> s <> " D0.05 Q2"

motionOf :: Travel -> Motion
motionOf travel = Motion kindOf (known (placeZ end), known (placeX end)) centre'
  where
    end = to travel
    kindOf = case mode travel of
      RapidMode -> "TRAVERSE"
      LinearMode -> "FEED"
      ArcMode Carrier.Clockwise -> "ARC"
      ArcMode Carrier.CounterClockwise -> "COUNTER ARC"
      CycleMode _ -> "CYCLE"
    known c = case c of
      At p -> Just (Run.picometres p)
      Retracted -> Nothing
      InMachine _ -> Nothing
      Anywhere -> Nothing
    centre' = (\(a, b) -> (Run.picometres a, Run.picometres b)) <$> about travel

-- | Motion of a call of the interpreter, with numbers in units of @unit@ mm; empty for a call that
-- is none.
canonical :: Double -> Text -> [Motion]
canonical unit l = case Text.breakOn "(" (Text.unwords (drop 2 (Text.words l))) of
  ("STRAIGHT_TRAVERSE", given') | x : _ : z : _ <- numbers given' -> [plain "TRAVERSE" z x]
  ("STRAIGHT_FEED", given') | x : _ : z : _ <- numbers given' -> [plain "FEED" z x]
  ("ARC_FEED", given')
    | z : x : cz : cx : turns : _ <- numbers given' ->
      [ Motion
          (if turns > 0 then "COUNTER ARC" else "ARC")
          (Just z, Just x)
          (Just (cz, cx))
      ]
  _ -> []
  where
    plain kind' z x = Motion kind' (Just z, Just x) Nothing
    numbers =
      map (either (error . show) ((* unit) . fst) . Read.signed Read.double)
        . filter (not . Text.null)
        . Text.split (`elem` [',', ' ', ')'])
        . Text.drop 1

-- | Test that two motions are the same, as far as their ends are known. The calls have four
-- decimals, in units of @unit@ mm.
agrees :: Double -> Motion -> Motion -> Bool
agrees unit (Motion k (z, x) c) (Motion k' (z', x') c') =
  k == k'
    && near z z'
    && near x x'
    && near (fst <$> c) (fst <$> c')
    && near (snd <$> c) (snd <$> c')
  where
    near (Just a) (Just b) = abs (a - b) < 1.0e-4 * unit
    near Nothing _ = True
    near _ Nothing = False
