-- | Law of the model of cutter compensation: LinuxCNC makes the same path of the same tape. The
-- tapes are those of the compiler, and damaged ones.
module Control.CompensationSpec (spec) where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..), Rad (..), minus)
import Base.Region (Located (..))
import Base.Result qualified as Result
import Command (inFolder)
import Control.Compensation (CompensationError (..), Moved (..))
import Control.Compensation qualified as Compensation
import Control.Motion qualified as Motion
import Data.ByteString qualified as ByteString
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Frame (Frame (..), FrameMotion (..))
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as FromToolpath
import Generate.ByControl qualified as ByControl
import Geometry.Carrier (Sense (..))
import Geometry.Segment (Segment (Arc, Straight, sweep))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import LinuxCnc qualified
import Machine.Machine (CommandName (..))
import Machines (iso6983)
import Part.Part qualified as Part
import System.FilePath ((</>))
import Tape.Punch qualified as Punch
import Tape.Tape (Tape (..))
import Test.Hspec
import Test.QuickCheck hiding (within)

spec :: Spec
spec = do
  present <- runIO LinuxCnc.installed
  describe "the model of a control" $ do
    if present
      then do
        it
          "does what LinuxCNC does, with tapes of the compiler (catches another path at a corner, \
          \at the entry or at the exit)"
          $ compared (Mm 0.001) pure
        it
          "does what LinuxCNC does, with damaged tapes, and refuses whatever LinuxCNC refuses \
          \(catches a model that repairs a tape)"
          $ compared (Mm 0.03) damaged
      else
        it
          "does what LinuxCNC does"
          (pendingWith "rs274 is not installed (scripts/setup.sh installs linuxcnc-uspace)")
    it "refuses what a control refuses, and for the same reason" $
      [ (what, expected, snd (Compensation.run iso6983 (const (Mm 0)) 0 fs))
        | (what, expected, fs) <- refusals,
          snd (Compensation.run iso6983 (const (Mm 0)) 0 fs) /= expected
      ]
        `shouldBe` []

-- | Law: the paths of the model and of LinuxCNC differ by less than @close@. For a damaged tape
-- @close@ is larger: the radii of an arc differ by rounding, and this moves an intersection of two
-- paths that meet at a small angle.
compared :: Mm -> ([Frame] -> Gen [Frame]) -> Property
compared close change =
  withMaxSuccess 150 $
    forAll ByControl.cases $ \(_, job) -> case programOf job of
      Nothing -> property Discard
      Just (begin, own) -> forAll (change own) $ \fs -> ioProperty $ do
        made <- interpreted begin fs
        let (moved, unkept) = Compensation.run iso6983 (const (Mm 0)) begin fs
            broken = Frame.violations iso6983 fs
        pure $ case made of
          Left why ->
            classify
              True
              "refused"
              ( counterexample
                  (show (why, unkept))
                  ( not (null unkept)
                      || not (null broken)
                      || Text.isInfixOf "Radius to end of arc" why
                  )
              )
          -- The model may refuse more than LinuxCNC.
          Right traversed
            | not (null unkept)
                || not (null broken)
                || any flat fs
                || any spirals (Motion.run begin fs) ->
              classify True "refused by the model alone" (property True)
            | otherwise ->
              let found =
                    differences
                      close
                      (concatMap (NonEmpty.toList . centrePath) moved)
                      (map LinuxCnc.segment traversed)
               in counterexample (unlines found <> show fs) (null found)
  where
    flat f = case motion f of
      Circular _ -> not (Motion.isRound f)
      _ -> False
    -- LinuxCNC uses either radius of such an arc; the proof refuses it. No tape of the compiler has
    -- one.
    spirals s =
      maybe False (\(a, b) -> max (minus a b) (minus b a) >= Mm 0.03) (Motion.radii iso6983 s)

-- | Start position and frames of a milling.
programOf :: Part.Milling -> Maybe (Pulses3, [Frame])
programOf job = do
  from <- listToMaybe [p | Part.Stop (Located _ p) _ _ <- Part.approach job]
  path <- ByControl.path (Vec.shift (Vec.vec 7 5) from) job
  program <- Result.output (FromToolpath.quantise iso6983 path)
  Just (Frame.start program, map Frame.frame (Frame.plannedFrames program))

-- | Path that LinuxCNC makes of frames. It starts at the zero of the part and is moved to the start
-- position first.
interpreted :: Pulses3 -> [Frame] -> IO (Either Text [LinuxCnc.Move])
interpreted begin fs = inFolder $ \folder -> do
  let file = folder </> "a.ngc"
      onto = [(Frame.commandFrame []) {motion = Rapid, increment = begin} | begin /= 0]
      Tape rows = Punch.write iso6983 0 (onto <> fs)
  ByteString.writeFile file rows
  fmap (drop (length onto) . LinuxCnc.movesFrom (LinuxCnc.Position 0 0 0))
    <$> LinuxCnc.canonical file

-- | First difference between two paths. Moves that are no longer than the rounding of printed
-- numbers may be missing.
differences :: Mm -> [Segment] -> [Segment] -> [String]
differences close model real = case (model, real) of
  ([], []) -> []
  (m : ms, r : rs) | same m r -> differences close ms rs
  (m : ms, _) | tiny m -> differences close ms real
  (_, r : rs) | tiny r -> differences close model rs
  _ -> ["the model: " <> show (take 1 model) <> ", LinuxCNC: " <> show (take 1 real)]
  where
    tiny s = Vec.distance (Segment.start s) (Segment.end s) < Mm 0.003
    near p q = Vec.distance p q < close
    same a b =
      near (Segment.start a) (Segment.start b)
        && near (Segment.end a) (Segment.end b)
        && case (a, b) of
          (Straight _ _, Straight _ _) -> True
          (Arc {Segment.centre = c, sweep = Rad x}, Arc {Segment.centre = d, sweep = Rad y}) ->
            near c d && signum x == signum y
          _ -> False

-- | Frames with one number changed; the next frame may make up for it.
damaged :: [Frame] -> Gen [Frame]
damaged own = do
  n <- elements [k | (k, f) <- zip [0 ..] own, Frame.isMoving f]
  d <- Pulses <$> elements [1, -1, 10, -10, 300, -300, 5000, -5000]
  let f = own !! n
      with f' = take n own <> [f'] <> drop (n + 1) own
      madeUp f' = case drop (n + 1) own of
        g : rest
          | Frame.isMoving g ->
            take n own <> [f', g {increment = increment g + increment f - increment f'}] <> rest
        _ -> with f'
  frequency
    [ (2, pure (madeUp f {increment = increment f + Pulses3 d 0 0})),
      (2, pure (madeUp f {increment = increment f + Pulses3 0 d 0})),
      (1, pure (take n own <> drop (n + 1) own)),
      ( 1,
        pure
          ( with
              f
                { commands =
                    [ ( o,
                        if o `elem` [CommandName "left", CommandName "right"]
                          then
                            v
                              + let Pulses k =
                                      abs d
                                 in k
                          else v
                      )
                      | (o, v) <- commands f
                    ]
                }
          )
      ),
      (1, pure (map exchanged own)),
      (1, pure (with (if centre f == 0 then f else f {centre = centre f + Pulses2 d d})))
    ]

exchanged :: Frame -> Frame
exchanged f = f {commands = [(other o, v) | (o, v) <- commands f]}
  where
    other o
      | o == CommandName "left" = CommandName "right"
      | o == CommandName "right" = CommandName "left"
      | otherwise = o

-- | Frames with a name and the errors of the model.
refusals :: [(String, [CompensationError], [Frame])]
refusals =
  [ ("a correct tape", [], good),
    ("a short entry", [ShortEntry 1 (Mm 10) (Mm 10)], begun 10 : drop 1 good),
    ( "a vertical entry",
      [ShortEntry 1 (Mm 0) (Mm 10)],
      (begun 0) {increment = Pulses3 0 0 1000} : drop 1 good
    ),
    ( "an arc to begin with",
      [ArcEntry 1],
      (begun 40) {motion = Circular CounterClockwise, centre = Pulses2 20000 0} : drop 1 good
    ),
    ( "an arc to end with",
      [ArcExit 4],
      take 3 good
        <> [ (straight (-40) 0)
               { motion = Circular Clockwise,
                 centre = Pulses2 (-20000) 0,
                 commands = [(CommandName "release", 0)]
               }
           ]
    ),
    ( "an arc as tight as the cutter",
      [TightArc 3 (Mm 10) (Mm 10)],
      take 2 good
        <> [(straight (-10) 10) {motion = Circular CounterClockwise, centre = Pulses2 (-10000) 0}]
        <> drop 3 good
    ),
    ( "an arc after a corner of 0.02 mm that counts as none, which makes the arc longer",
      [],
      take 2 good <> [onArc 400] <> drop 3 good
    ),
    ( "an arc that becomes longer than a control allows",
      [CornerNotReached 3],
      take 2 good <> [onArc 600] <> drop 3 good
    ),
    ( "a tip at which the path turns by 176 degrees",
      [],
      take 2 good <> [straight (0.07 * 40) (-40)] <> drop 3 good
    ),
    ( "a tip at which the path turns by 178 degrees",
      [CornerNotReached 2],
      take 2 good <> [straight (0.035 * 40) (-40)] <> drop 3 good
    ),
    ( "a corner that is not reached",
      [CornerNotReached 2],
      [begun 40, straight 0 9, straight 50 0, off]
    ),
    ( "switched on twice",
      [SwitchedOnTwice 2],
      [begun 40, (straight 0 50) {commands = [(CommandName "left", 20000)]}] <> drop 2 good
    ),
    ( "switched on twice in one frame",
      [SwitchedOnTwice 1],
      (begun 40) {commands = [(CommandName "left", 20000), (CommandName "right", 20000)]} :
      map (\f -> f {commands = []}) (drop 1 good)
    ),
    ( "a tool changed while compensation is on",
      [ToolChanged 2],
      [begun 40, Frame.commandFrame [(CommandName "T", 2), (CommandName "M", 6)]] <> drop 1 good
    ),
    ( "another command while compensation is on",
      [],
      [begun 40, Frame.commandFrame [(CommandName "M", 8)]] <> drop 1 good
    ),
    ("never switched off", [NotSwitchedOff 3], take 3 good)
  ]
  where
    good = [begun 40, straight 0 50, straight 50 0, off]
    begun x = (straight x 0) {commands = [(CommandName "left", 20000)]}
    -- Quarter of a circle after a corner to the right; @aside@ pulses set the corner.
    onArc aside =
      (straight 0 0)
        { motion = Circular CounterClockwise,
          increment = Pulses3 (-20000) (20000 + aside) 0,
          centre = Pulses2 (-20000) aside
        }
    off = (straight 0 40) {commands = [(CommandName "release", 0)]}
    straight x y =
      (Frame.commandFrame [])
        { motion = Linear,
          increment = Pulses3 (Pulses (round (1000 * x))) (Pulses (round (1000 * y))) 0
        }
      where
        _ = x + y :: Double
