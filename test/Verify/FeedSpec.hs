-- | Proof of feeds: frame by frame, along contours on tapes with other frames, and before slower
-- frames.
module Verify.FeedSpec (spec) where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Feed (..), LengthUnit (..), Mm (..), Pulses (..))
import Base.Region (Located (..), Region (Region))
import Base.Result qualified as Result
import Data.List.NonEmpty (NonEmpty (..))
import Data.Maybe (fromMaybe)
import Frame.Frame
  ( Frame (..),
    FrameMotion (..),
    FrameProgram (FrameProgram),
    PlannedFrame (PlannedFrame),
    Role (..),
  )
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as FromToolpath
import Generate (Case (..))
import Generate qualified
import Geometry.Carrier (Side (..))
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Segment (Segment (Straight))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (CommandName (..), FeedCode (..), Machine)
import Machine.Machine qualified as Machine
import Machines qualified
import Offset.Equidistant qualified as Equidistant
import Part.CutFeed (CutFeed (..))
import Part.Part qualified as Part
import Test.Hspec
import Toolpath.FromPart qualified as Toolpath
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.FromTape qualified as Verify
import Verify.Proof (Finding (..))
import Verify.Proof qualified as Proof

spec :: Spec
spec = do
  describe "braking" $ do
    -- 1000 mm/min are 16.667 mm/s, 10 are 0.167: 27.775 mm to come down at 5 mm/s².
    it
      "has to come before the end of the tape, early enough (catches a law of single frames)"
      $ [tooFast [go 40 100, slower 0 mm] | mm <- [27.84, 27.7, 27]] `shouldBe` [[], [1], [1]]
    it
      "has to come before a slower frame, also several frames later (catches a law of two \
      \successive frames)"
      $ do
        tooFast [go 40 100, go 20 5, slower 0 60] `shouldBe` [1]
        tooFast [go 40 100, slower 20 28, go 20 5, slower 0 60] `shouldBe` []
        tooFast [go 40 100, slower 20 5, slower 20 23, go 20 5, slower 0 60] `shouldBe` []
        tooFast [go 40 100, slower 20 5, go 20 23, slower 0 60] `shouldBe` [1]
    it
      "is not needed to become faster, nor on machines that brake by themselves (catches a law \
      \with its sign exchanged)"
      $ do
        tooFast [go 0 10, go 20 10, go 40 100, slower 0 28] `shouldBe` []
        [n | TooFast n _ _ <- prove (Machines.named "n55") resting [] [go 900 10, go 10 10]]
          `shouldBe` []
    it "is reported with the speed of the cutter and the largest possible one" $
      [ (round v, round most)
        | TooFast _ (Feed v) (Feed most) <- prove lki resting [] [go 40 100, slower 0 10]
      ]
        `shouldBe` [(1000, 601 :: Int) :: (Int, Int)]
  describe "the program's own frames" $
    it "are compared by code, by braking and by rapid motion" $
      [ [n | WrongFeed n _ _ _ <- prove machine resting [f] [g]]
        | (machine, f, g) <-
            [ (lki, slower 0 10, slower 0 10),
              (lki, slower 0 10, slower 1 10),
              (lki, slower 0 10, go 0 10),
              (Machines.named "n55", go 0 10, (go 0 10) {motion = Rapid})
            ]
      ]
        `shouldBe` [[], [1], [1], [1]]
  describe "a foreign tape" $ do
    it
      "has the code of the demanded feed along a contour, or a lower one in a braking frame \
      \(catches a tape that cuts in rapid)"
      $ [ [n | WrongFeed n _ _ _ <- prove lki along [] [f]]
          | f <- [cut 15, cut 14, cut 40, (cut 14) {braking = True}, (cut 16) {braking = True}]
        ]
        `shouldBe` [[], [1], [1], [], [1]]
    it
      "has the frequency of the leading axis if the machine has such codes: v/60·n/L (catches the \
      \feed along the path in its place)"
      $ do
        -- 60 mm/min along (3, 4) mm of 5 mm: 80 Hz of 0.01 mm; straight along x 100 Hz.
        map (wrongFeeds slanted) [aslant 42, aslant 43, aslant 41]
          `shouldBe` [[], [1], [1]]
        map (wrongFeeds along) [ahead 43, ahead 42]
          `shouldBe` [[], [1]]
    it
      "goes down into the material at the feed of the program (catches a plunge in rapid on a tape \
      \with another number of frames)"
      $ case map Frame.frame . Frame.plannedFrames <$> plunge of
        Just (over : down : more) ->
          let halves = replicate 2 over {increment = Pulses3 500 0 0}
              rapid = down {motion = Rapid, feedCode = FeedCode 0}
           in map
                plungeFaults
                [ over : down : more,
                  halves <> (down : more),
                  halves <> (rapid : more),
                  halves <> (down {feedCode = FeedCode 60} : more)
                ]
                `shouldBe` [[], [], [3], [3]]
        other -> expectationFailure (show other)
  describe "commands" $ do
    it
      "are compared one after the other on a tape with another number of frames (catches a \
      \comparison by the numbers of frames)"
      $ [ [ (n, o, a, b)
            | WrongCommand n (CommandName o) a b <-
                prove
                  (Machines.named "n55")
                  resting
                  [go 60 10, Frame.commandFrame [(CommandName "M", 2)]]
                  fs
          ]
          | fs <-
              [ [go 60 5, go 60 5, Frame.commandFrame [(CommandName "M", 2)]],
                [go 60 5, go 60 5, Frame.commandFrame [(CommandName "M", 3)]],
                [go 60 5, go 60 5, go 60 1],
                [go 60 5, Frame.commandFrame [(CommandName "M", 2)], go 60 5]
              ]
        ]
        `shouldBe` [ [],
                     [(3, "M", Just 3, Just 2)],
                     [(3, "M", Nothing, Just 2)],
                     [(2, "M", Just 2, Nothing)]
                   ]
    it
      "are compared word by word, also those that are missing at the end (catches a lost word of \
      \the last frame)"
      $ [ [ (n, o, a, b)
            | WrongCommand n (CommandName o) a b <-
                prove
                  (Machines.named "n55")
                  resting
                  [go 60 10, Frame.commandFrame [(CommandName "M", 2)]]
                  fs
          ]
          | fs <-
              [ [go 60 10, Frame.commandFrame [(CommandName "M", 2)]],
                [go 60 10, Frame.commandFrame [(CommandName "M", 3)]],
                [go 60 10],
                [ (go 60 10) {commands = [(CommandName "S", 4), (CommandName "T", 2)]},
                  Frame.commandFrame [(CommandName "M", 2)]
                ]
              ]
        ]
        `shouldBe` [ [],
                     [(2, "M", Just 3, Just 2)],
                     [(2, "M", Nothing, Just 2)],
                     [(1, "S", Just 4, Nothing), (1, "T", Just 2, Nothing)]
                   ]
  where
    lki = Machines.named "lki-u"
    kontur = Machines.named "kontur-3p"
    wrongFeeds path f = [n | WrongFeed n _ _ _ <- prove kontur path [] [f]]
    tooFast fs = [n | TooFast n _ _ <- prove lki resting [] fs]
    -- Frame along x by a length in mm, with pulses of 0.02 mm.
    go code mm =
      Frame
        { motion = Linear,
          increment = Pulses3 (Pulses (round (mm / 0.02 :: Double))) 0 0,
          turn = 0,
          centre = 0,
          feedCode = FeedCode code,
          braking = False,
          commands = []
        }
    slower code mm = (go code mm) {braking = True}
    along = edge (Vec.point 30 0)
    slanted = edge (Vec.point 30 40)
    cut code = go code 30
    ahead code = (go code 30) {increment = Pulses3 3000 0 0}
    aslant code = (go code 0) {increment = Pulses3 3000 4000 0}
    n55 = Machines.named "n55"
    plunge = Result.output (FromToolpath.quantise n55 plunging)
    plungeFaults fs =
      [ n
        | Just program <- [plunge],
          WrongFeed n _ _ _ <- Proof.findings (Verify.prove n55 plunging program fs)
      ]

-- | Findings for a tape, with the toolpath and the program's own frames.
prove :: Machine -> Toolpath -> [Frame] -> [Frame] -> [Finding]
prove machine path own fs =
  Proof.findings
    ( Verify.prove
        machine
        path
        (FrameProgram begin [PlannedFrame f Linking (Region 0 0) (Mm 0) 0 | f <- own])
        fs
    )
  where
    Located _ (Part.SpacePoint p _) = Toolpath.start path
    Mm pulse = Machine.planeResolution machine
    begin = Pulses3 (Pulses (round (Vec.x p / pulse))) (Pulses (round (Vec.y p / pulse))) 0

-- | Toolpath without moves.
resting :: Toolpath
resting =
  Toolpath.Toolpath
    (Located (Region 0 0) (Part.SpacePoint (Vec.point 0 0) (Mm 0)))
    []
    False
    Toolpath.noSetup
    Millimetres

-- | Toolpath 10 mm along x in rapid, 4 mm down at 30 mm/min, and up again in rapid.
plunging :: Toolpath
plunging =
  fromMaybe
    (error "no path")
    (Result.output (Toolpath.toToolpath (Generate.partOf (Vec.point 0 0) (Part.Travel stops))))
  where
    stops = stop Nothing Part.Rapid :| [stop (Just (Mm (-4))) slowly, stop (Just (Mm 0)) Part.Rapid]
    slowly = Part.At (Located (Region 0 0) (PerMinute (Feed 30)))
    stop = Part.Stop (Located (Region 0 0) (Vec.point 10 0))

-- | Toolpath along a line from (0, 0) to a point, with a cutter of radius 5 on its left; the cutter
-- is at the start of the cut.
edge :: Point -> Toolpath
edge end = case Equidistant.equidistant LeftOf (Mm 5) contour of
  Right pieces
    | c <- Case {contour, side = LeftOf, radius = Mm 5, pieces},
      Just path <-
        Result.output
          ( Toolpath.toToolpath
              ( Generate.partOf
                  (Generate.begin c)
                  (Part.Mill (Located (Region 0 0) (Generate.job c)))
              )
          ) ->
      path
  _ -> error "no path"
  where
    contour = Polyarc Open (Straight (Vec.point 0 0) end :| [])
