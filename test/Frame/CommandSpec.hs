-- | Laws of commands.
module Frame.CommandSpec (spec) where

import Base.Quantity (Feed (..), Mm (..), Seconds (..))
import Base.Region (Located (..), Region (Region))
import Base.Result qualified as Result
import Data.Text (Text)
import Data.Text qualified as Text
import Files (readText)
import Frame.Error (CommandKind (..), Error (..), Warning (..))
import Frame.Frame (Frame (..), PlannedFrame (frame))
import Frame.Frame qualified as Frame
import Frame.Made qualified as Made
import Geometry.Segment (Segment (Straight))
import Geometry.Vec qualified as Vec
import Machine.FromText qualified as FromText
import Machine.Machine (CommandName (..), Machine)
import Machines qualified
import Part.CutFeed (CutFeed (..), SpindleRate (..))
import Part.Part (Command (..), CutterKind (..), Pace (..), Sense (..), Switch (..))
import Part.Part qualified as Part
import Test.Hspec
import Test.QuickCheck
import Toolpath.Toolpath (Block (..), Toolpath (blocks))

spec :: Spec
spec = do
  describe "commands" $ do
    it
      "are in the frame of the next move, after the last one in a frame of their own (catches a \
      \command that is lost or late)"
      $ commandsOf kontur [c (Auxiliary 7), go, go, c (Auxiliary 8)]
        `shouldBe` [(True, [("aux", 7)]), (True, []), (False, [("aux", 8)])]
    it "are pending until a move has a frame (catches a command in a frame that is dropped)" $
      commandsOf kontur [c (Auxiliary 7), stay, go] `shouldBe` [(True, [("aux", 7)])]
    it "are in the order of the layout's words (catches the order of the program in a frame)" $
      commandsOf
        kontur
        [c (CoolantTo SwitchOn), c (tool 3), c (SpindleOn Clockwise (TurnsPerMinute 500)), go]
        `shouldBe` [(True, [("spindle", 10), ("tool", 3), ("aux", 51)])]
    it
      "that need the same word twice take several frames, in the order of the program (catches a \
      \number that is overwritten)"
      $ commandsOf kontur [c (Auxiliary 7), c (CoolantTo SwitchOn), c (tool 3), c (Auxiliary 9), go]
        `shouldBe` [ (False, [("aux", 7)]),
                     (False, [("tool", 3), ("aux", 51)]),
                     (True, [("aux", 9)])
                   ]
    it "keep the words of one command together (catches a speed a frame before its spindle)" $
      commandsOf iso [c (tool 2), c (SpindleOn CounterClockwise (TurnsPerMinute 999.6)), go]
        `shouldBe` [ (False, [("T", 2), ("M", 6)]),
                     (True, [("S", 1000), ("M", 4)]),
                     (False, [("M", 5)]),
                     (False, [("M", 30)])
                   ]
    it "without a spindle speed leave out the word for it" $
      commandsOf iso [c (SpindleOn Clockwise NoRate), go]
        `shouldBe` [(True, [("M", 3)]), (False, [("M", 5)]), (False, [("M", 30)])]
    it
      "are never lost, never twice in a frame, and keep their order word by word (catches a group \
      \that is dropped)"
      $ property $
        forAll
          ( listOf
              ( frequency
                  [ (3, Auxiliary <$> choose (1, 99)),
                    (1, tool <$> choose (1, 9)),
                    (1, elements [CoolantTo SwitchOn, CoolantTo SwitchOff])
                  ]
                  >>= \x ->
                    elements [[c x], [c x, go], [c x, stay]]
              )
          )
          $ \parts ->
            let steps = concat parts
                frames = commandsOf kontur steps
                numbersOf word = [n | (_, os) <- frames, (w, n) <- os, w == word]
                asked :: Text -> [Int]
                asked word = concat [numbers word x | Left x <- steps]
                numbers word x = case x of
                  Auxiliary n | word == "aux" -> [n]
                  CoolantTo SwitchOn | word == "aux" -> [51]
                  CoolantTo SwitchOff | word == "aux" -> [57]
                  ChangeTool n _ | word == "tool" -> [n]
                  _ -> []
             in counterexample (show frames) $
                  (numbersOf "aux", numbersOf "tool")
                    === (asked "aux", asked "tool") .&&. length (filter fst frames)
                    === length [() | Right d <- steps, d > 0]
  describe "spindle steps" $ do
    it "are the nearest, the lower one of two" $
      [commandsOf kontur [c (SpindleOn Clockwise (TurnsPerMinute v)), go] | v <- [499, 1, 1e5]]
        `shouldBe` [[(True, [("spindle", n)])] | n <- [10, 1, 15]]
    it
      "that miss the speed by more than a tenth give a warning (catches a wrong spindle speed \
      \without a report)"
      $ [ length
            [ ()
              | SpindleSpeedDiffers {} <-
                  Result.warnings
                    (quantised kontur [c (SpindleOn Clockwise (TurnsPerMinute v)), go])
            ]
          | v <- [500, 560, 460, 1e5]
        ]
        `shouldBe` [0, 1, 0, 1]
  describe "a stop" $ do
    it
      "has a frame of its own, after the commands before it (catches a stop in the frame of a \
      \move, which is made first)"
      $ commandsOf iso [c (SpindleOn Clockwise NoRate), c ProgramStop, go, c OptionalStop, go]
        `shouldBe` [ (False, [("M", 3)]),
                     (False, [("M", 0)]),
                     (True, []),
                     (False, [("M", 1)]),
                     (True, []),
                     (False, [("M", 5)]),
                     (False, [("M", 30)])
                   ]
    it
      "and a dwell are refused on a machine without words for them (catches a machine that runs \
      \on)"
      $ [ [kind | CannotWait _ kind <- Result.errors (quantised (Machines.named m) [c x, go])]
          | (m, x) <-
              [ ("lkp-01f", ProgramStop),
                ("n55", OptionalStop),
                ("iso6983", OptionalStop),
                ("iso6983", Dwell (Seconds 2))
              ]
        ]
        `shouldBe` [[StopCommand], [StopCommand], [], [DwellCommand]]
  describe "a dwell" $
    it
      "is never shorter than asked, and longer by less than one unit (catches a time that is \
      \rounded down)"
      $ ioProperty $ do
        description <- readText "test/machines/dwell.machine"
        let machineWith unit =
              Result.ifSound
                (FromText.read (Text.replace "pause seconds" ("pause " <> unit) description))
            found = [(machineWith "seconds", 100), (machineWith "milliseconds", 100000)]
        pure . forAll (choose (0.0001, 0.0999)) $ \t ->
          conjoin
            [ case (\m -> commandsOf m [c (Dwell (Seconds t)), go]) <$> machine of
                Just ((False, [("pause", n)]) : (True, []) : _) ->
                  let excess = fromIntegral n - t * unitsInSecond :: Double
                   in counterexample (show excess) (excess >= -1e-6 && excess < 1)
                frames -> counterexample (show frames) False
              | (machine, unitsInSecond) <- found
            ]
  describe "the spindle by hand" $
    it "has no frame and no warning on any machine" $
      [ (length (commandsOf m byHand), Result.warnings (quantised m byHand))
        | m <- [kontur, Machines.named "lkp-01f"]
      ]
        `shouldBe` [(1, []), (1, [])]
  describe "a command without a word" $ do
    it "is left to the operator" $
      [ Result.warnings (quantised (Machines.named m) [c x, go])
        | (m, x) <-
            [ ("lki-u", CoolantTo SwitchOn),
              ("n55", SpindleOn CounterClockwise (TurnsPerMinute 100)),
              ("kontur-3p", SpindleOn Clockwise NoRate)
            ]
      ]
        `shouldBe` [ [ManualCommand (Region 0 0) CoolantCommand],
                     [ManualCommand (Region 0 0) SpindleCommand],
                     [SpindleSpeedMissing (Region 0 0)]
                   ]
    it
      "is refused if it is an auxiliary one, as is a number that does not fit (catches a number \
      \cut off to its digits)"
      $ [ [ (k, n, most)
            | NoSuchCommand _ k n most <- Result.errors (quantised (Machines.named m) [c x, go])
          ]
          | (m, x) <-
              [ ("lki-u", Auxiliary 1),
                ("lkp-01f", Auxiliary 8),
                ("lkp-01f", Auxiliary 7),
                ("kontur-3p", tool 100),
                ("iso6983", SpindleOn Clockwise (TurnsPerMinute 1e6))
              ]
        ]
        `shouldBe` [ [(AuxiliaryCommand, 1, 0)],
                     [(AuxiliaryCommand, 8, 7)],
                     [],
                     [(ToolCommand, 100, 99)],
                     [(SpindleCommand, 1000000, 99999)]
                   ]
  where
    byHand = [c SpindleByHand, go]
    c = Left
    go = Right (1 :: Double)
    stay = Right 0
    tool n = ChangeTool n (Part.Cutter MillingCutter (Mm 1) Nothing Nothing (Mm 1) Part.plainBody)
    kontur = Machines.named "kontur-3p"
    iso = Machines.named "iso6983"

-- | Frames of commands and of moves along x, whose lengths are given in mm.
quantised :: Machine -> [Either Command Double] -> Result.Result Warning Error Frame.FrameProgram
quantised m parts = Made.quantised m (base {blocks = blocksFrom 0 parts})
  where
    base = Made.pathAlong Rapid [Straight (Vec.point 0 0) (Vec.point 1 0)]
    blocksFrom x ps = case ps of
      [] -> []
      Left command : more -> Commanding (Located (Region 0 0) command) : blocksFrom x more
      Right d : more ->
        blocks
          ( Made.pathAlong
              (At (Located (Region 0 0) (PerMinute (Feed 60))))
              [Straight (Vec.point x 0) (Vec.point (x + d) 0)]
          )
          <> blocksFrom (x + d) more

-- | Commands of each frame, and True for a frame with a motion.
commandsOf :: Machine -> [Either Command Double] -> [(Bool, [(Text, Int)])]
commandsOf m parts =
  [ (Frame.isMoving f, [(w, n) | (CommandName w, n) <- commands f])
    | Just p <- [Result.ifSound (quantised m parts)],
      f <- map frame (Frame.plannedFrames p)
  ]
