-- | Proof of tapes along contours: the flange, random contours, and damaged tapes of both.
module Verify.FromTapeSpec (spec) where

import Base.PulseVector (Pulses2 (..), Pulses3 (..))
import Base.Quantity (LengthUnit (..), Mm (..), Pulses (..), Rad (..))
import Base.Region (Located (..), Region (Region))
import Base.Result qualified as Result
import Compile (Analysis (..))
import Compile qualified
import Data.List.NonEmpty qualified as NonEmpty
import Files (readText)
import Flange qualified
import Frame.Frame (Frame (commands, feedCode, increment, motion, turn), FrameMotion (..))
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as FromToolpath
import Generate qualified
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Machine.Machine (CommandName (..), FeedCode (..), Machine, RotaryAxis (..))
import Machines qualified
import Part.Part qualified as Part
import Project.LoadedProgram qualified as LoadedProgram
import Test.Hspec
import Test.QuickCheck
import Toolpath.FromPart qualified as Toolpath
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.FromTape qualified as Verify
import Verify.Proof (Finding (..), Proof (..))
import Verify.Proof qualified as Proof

spec :: Spec
spec = do
  it "the planned frames of the flange are proven" $
    findings (proofOf Flange.frames) `shouldBe` []
  it
    "a digit changed to another legal one is found, with the number of its frame; if the path \
    \leaves the band, a deviation is found as well"
    $ property $
      withMaxSuccess 4000 $
        forAllBlind (elements changes) $ \(n, f, fs) ->
          let p = proofOf fs
           in counterexample (show (n, f, findings p)) (isFound n f p)
  it "a changed speed code is a wrong feed in its frame" $
    [ (n, s)
      | (n, f) <- zip [1 ..] Flange.frames,
        s <- map FeedCode [1 .. 9],
        s /= feedCode f,
        wrongFeeds (proofOf (replaceFrame n f {feedCode = s})) /= [n]
    ]
      `shouldBe` []
  it "a frame left out, doubled or swapped with the next is found" $
    [ (n, what)
      | n <- [3, 17, 60, 111, 139],
        (what, fs) <-
          [("left out" :: String, without n), ("doubled", doubled n), ("swapped", swapped n)],
        fs /= Flange.frames,
        Proof.isProven (proofOf fs)
    ]
      `shouldBe` []
  it
    "a program whose planned frames do not end where its toolpath ends is refused, also on a tape \
    \with these frames (catches an end that is compared with the frames)"
    $ let (analysis, own) =
            punched "contour l open { line((-10, 0), (10, 0)) }\nmill l on { depth 1 }"
          further =
            own
              { Frame.plannedFrames =
                  Frame.plannedFrames own
                    <> take
                      1
                      (reverse (filter (Frame.isMoving . Frame.frame) (Frame.plannedFrames own)))
              }
       in findings
            ( Verify.prove
                lkp01f
                (path analysis)
                further
                (map Frame.frame (Frame.plannedFrames further))
            )
            `shouldSatisfy` any isOpen
  it "two lobes that are never cut, although the path closes, are an excess" $
    findings (proofOf shortcut) `shouldSatisfy` any isExcess
  it
    "half of a circle that is never cut is an excess, also where the cutter runs on the circle \
    \itself (catches an arc taken for the full circle on which it lies)"
    $ do
      text <- readText "test/programs/mill/good/on-circle.part"
      case Compile.analyse [] (LoadedProgram.fromText "on-circle.part" text) of
        r
          | Just a <- Result.ifSound r,
            Just program <- Result.output (FromToolpath.quantise iso6983 (path a)) ->
            let fs = map Frame.frame (Frame.plannedFrames program)
                halves = [n | (n, f) <- zip [0 ..] fs, Frame.centre f /= 0]
                others k = take k fs <> drop (k + 1) fs
             in [ any isExcess (findings (Verify.prove iso6983 (path a) program (others n)))
                  | n <- halves
                ]
                  `shouldBe` [True, True]
          | otherwise -> expectationFailure (show (Result.errors r))
  it "a tape along the contour in the opposite direction does not follow it" $
    findings (proofOf backwards) `shouldSatisfy` any isNotFollowed
  it
    "a command that the program does not give is found, also when the frames cannot be compared \
    \one by one"
    $ findings (proofOf (commanded (doubledFirst Flange.frames))) `shouldSatisfy` any isCommand
  it
    "a tape that turns a rotary axis is refused, whatever else it does, and its first turn is \
    \named (catches a proof of three of five axes)"
    $ case Result.output (FromToolpath.quantise n55 (path Flange.analysis)) of
      Nothing -> property False
      Just own ->
        let fs = map Frame.frame (Frame.plannedFrames own)
            proofWith = findings . Verify.prove n55 (path Flange.analysis) own
            turning t = (Frame.commandFrame []) {motion = Linear, feedCode = FeedCode 60, turn = t}
         in forAll (choose (0, length fs - 1)) $ \k ->
              forAll (elements [(A, Pulses2 1 0), (B, Pulses2 0 (-500))]) $ \(axis, t) ->
                let (earlier, later) = splitAt k fs
                    turned = [f {turn = t} | f <- take 1 later, motion f `elem` [Linear, Rapid]]
                 in proofWith fs === []
                      .&&. proofWith (earlier <> [turning t, turning (-t)] <> later)
                      === [TurnsAxis (k + 1) axis]
                      .&&. conjoin
                        [ proofWith (earlier <> [f] <> drop 1 later) === [TurnsAxis (k + 1) axis]
                          | f <- turned
                        ]
  it
    "random contours with random cutters are proven; for a tolerance that their chords exceed they \
    \are not (catches a proof of the nodes alone)"
    $ property $
      forAll (Generate.closedCase `suchThat` ((> 0.4) . Generate.radiusOf)) $ \c ->
        case (Generate.milled (Mm 0.3) c, Generate.milled (Mm 0.003) c) of
          (Just rough, Just fine) -> case Result.output (FromToolpath.quantise lkp01f rough) of
            Just program ->
              let fs = map Frame.frame (Frame.plannedFrames program)
                  coarse = any ((> 0.06) . chordError) (cutSegments rough)
               in classify coarse "with coarse chords" $
                    findings (Verify.prove lkp01f rough program fs) === []
                      .&&. ( null (findings (Verify.prove lkp01f fine program fs))
                               === not coarse .||. property (not coarse)
                           )
            Nothing -> counterexample "no frames" False
          _ -> counterexample "no path" False

  it
    "a tape that drills deeper or elsewhere, or mills deeper, than its program is not proven \
    \(catches a hole that only has to be deep enough)"
    $ [ (tape, program)
        | (tape, program) <-
            [ ("drill at (0, 0) depth 25", "drill at (0, 0) depth 4"),
              ("drill at [(0, 0), (10, 0)] depth 4", "drill at (0, 0) depth 4"),
              ("mill k inside { depth 9 step 4.5 }", "mill k inside { depth 4.5 }"),
              ( "mill k inside { depth 2 }\nmove (0, 0, -2)\nmove (0, 0, 3)",
                "mill k inside { depth 2 }\nmove (0, 0, 3)"
              )
            ],
          Proof.isProven (against tape program)
      ]
      `shouldBe` []
  it
    "leads, corners, several passes and depths are proven (catches a search for a pass at \
    \another height or distance)"
    $ property $
      forAll
        ( (,,)
            <$> (Generate.settings <*> (Generate.job <$> Generate.closedCase))
              <*> elements [[], [Mm (-1)], [Mm (-1.5), Mm (-3)]]
              <*> elements [Part.OnPath (Mm 0.05), Part.Band (Mm 0.02) (Mm 0.06)]
        )
        $ \(settled, levels, tolerance) ->
          let job =
                settled
                  { Part.levels = levels,
                    Part.clearance = Just (Mm 5),
                    Part.tolerance = tolerance,
                    Part.approach = []
                  }
              pieces =
                maybe
                  []
                  entries
                  ( Result.output
                      ( Toolpath.toToolpath
                          (Generate.partOf (Vec.point 0 0) (Part.Mill (Located (Region 0 0) job)))
                      )
                  )
           in case pieces of
                [] -> discard
                entry : _ ->
                  case Toolpath.toToolpath
                    (Generate.partOf entry (Part.Mill (Located (Region 0 0) job))) of
                    Result.Result _ [] (Just toolpath) ->
                      case Result.output (FromToolpath.quantise lkp01f toolpath) of
                        Nothing -> discard
                        Just program ->
                          counterexample
                            ( show
                                ( Part.corners job,
                                  Part.leadIn job,
                                  Part.leadOut job,
                                  Part.allowances job,
                                  Part.radius job,
                                  levels,
                                  tolerance
                                )
                            )
                            $ Proof.toReports
                              Millimetres
                              lkp01f
                              ( Verify.prove
                                  lkp01f
                                  toolpath
                                  program
                                  (map Frame.frame (Frame.plannedFrames program))
                              )
                              === []
                    _ -> discard
  it
    "with a tolerance of 0 towards the material, no gouge is deeper than a pulse (catches chords \
    \that cut the corner of the band)"
    $ property $
      forAll (Generate.closedCase `suchThat` ((> 0.4) . Generate.radiusOf)) $ \c ->
        case Result.output
          ( Toolpath.toToolpath
              ( Generate.partOf
                  (Generate.begin c)
                  ( Part.Mill
                      ( Located
                          (Region 0 0)
                          (Generate.job c) {Part.tolerance = Part.Band (Mm 0) (Mm 0.1)}
                      )
                  )
              )
          ) of
          Nothing -> discard
          Just toolpath -> case Result.output (FromToolpath.quantise lkp01f toolpath) of
            Nothing -> discard
            Just program ->
              let p =
                    Verify.prove
                      lkp01f
                      toolpath
                      program
                      (map Frame.frame (Frame.plannedFrames program))
               in findings p
                    === []
                      .&&. conjoin
                        [ counterexample (show w) (Proof.amount w <= Mm 0.0201)
                          | Just w <- map Proof.gouge (Proof.contourProofs p)
                        ]
  where
    -- Proof of the tape of one program for another program.
    against tape program' =
      let (tapeAnalysis, tapeProgram) = punched tape
          (analysis, own) = punched program'
       in tapeAnalysis
            `seq` Verify.prove
              lkp01f
              (path analysis)
              own
              (map Frame.frame (Frame.plannedFrames tapeProgram))
    punched text = case analysed (deepHead <> text <> "\n") of
      r
        | Just a <- Result.ifSound r,
          Just p <- Result.output (FromToolpath.quantise lkp01f (path a)) ->
          (a, p)
        | otherwise -> error (show (Result.errors r))
    analysed = Compile.analyse [] . LoadedProgram.fromText "p.part"
    deepHead =
      "part p\nmachine lkp-01f\ntool mill(diameter 6 mm)\nfeed 60\ntolerance 0.02\nclearance 3\n\
      \from (0, 0, 3)\ncontour k closed { ccw circle((0, 0), 30) }\n"
    -- End of the first linking move with a length: the start of the lead-in or of the contour.
    entries toolpath =
      [ Segment.end (Toolpath.segment m)
        | b <- take 1 (Toolpath.blocks toolpath),
          m <- Toolpath.moves b,
          Segment.length (Toolpath.segment m) > Mm 0
      ]

lkp01f :: Machine
lkp01f = Machines.named "lkp-01f"

n55 :: Machine
n55 = Machines.named "n55"

iso6983 :: Machine
iso6983 = Machines.named "iso6983"

proofOf :: [Frame] -> Proof
proofOf = Verify.prove lkp01f (path Flange.analysis) Flange.program

-- | Chord error in mm of an arc that is divided for a tolerance of 0.3 mm.
chordError :: Segment -> Double
chordError s = case s of
  Straight _ _ -> 0
  Arc {start, centre, sweep = Rad a} ->
    let Mm r = Segment.radius centre start
     in r * (1 - cos (abs a / fromIntegral (FromToolpath.chordCount lkp01f (Mm 0.3) s) / 2))

-- | Segments of all cuts of a toolpath.
cutSegments :: Toolpath -> [Segment]
cutSegments p =
  [ Toolpath.segment m
    | Toolpath.Cutting {Toolpath.cut} <- Toolpath.blocks p,
      m <- NonEmpty.toList cut
  ]

-- | Legal tapes that differ in one digit or one sign: the number of the frame, the changed frame,
-- all frames.
changes :: [(Int, Frame, [Frame])]
changes =
  [ (n, f', replaceFrame n f')
    | (n, f) <- zip [1 ..] Flange.frames,
      Pulses3 x y z <- [increment f],
      d <-
        [Pulses3 x' y z | x' <- digitChanges 4 x]
          <> [Pulses3 x y' z | y' <- digitChanges 4 y]
          <> [Pulses3 x y z' | z' <- digitChanges 3 z],
      d /= 0,
      let f' = f {increment = d}
  ]

-- | Increments with one of @count@ digits changed, or with the opposite sign.
digitChanges :: Int -> Pulses -> [Pulses]
digitChanges count (Pulses v) =
  [ Pulses (signum' v * changed)
    | k <- [0 .. count - 1],
      step <- [1 .. 9],
      let changed = digitShifted k step,
      changed /= abs v
  ]
    <> [Pulses (-v) | v /= 0]
  where
    signum' n = if n < 0 then -1 else 1
    digitShifted k step =
      let digit = abs v `div` 10 ^ k `mod` 10
       in abs v + ((digit + step) `mod` 10 - digit) * 10 ^ k

replaceFrame :: Int -> Frame -> [Frame]
replaceFrame n f = take (n - 1) Flange.frames <> [f] <> drop n Flange.frames

without, doubled, swapped :: Int -> [Frame]
without n = take (n - 1) Flange.frames <> drop n Flange.frames
doubled n = take n Flange.frames <> drop (n - 1) Flange.frames
swapped n =
  take (n - 1) Flange.frames
    <> [Flange.frames !! n, Flange.frames !! (n - 1)]
    <> drop (n + 1) Flange.frames

-- | Flange with one straight frame in place of all frames between its first and its last ones.
shortcut :: [Frame]
shortcut =
  take 10 Flange.frames
    <> [(Flange.frames !! 10) {increment = sum (map increment (take 120 (drop 10 Flange.frames)))}]
    <> drop 130 Flange.frames

-- | Flange with the contour in the opposite direction, between the same linking moves.
backwards :: [Frame]
backwards = approach <> reverse [f {increment = negate (increment f)} | f <- along] <> retract
  where
    numbered = zip (map Frame.role (Frame.plannedFrames Flange.program)) Flange.frames
    approach = take 2 Flange.frames
    along = [f | (Frame.Cutting _, f) <- numbered]
    retract = drop (2 + length along) Flange.frames

-- | Frames with the first one divided in two halves.
doubledFirst :: [Frame] -> [Frame]
doubledFirst fs = case fs of
  f : rest ->
    [f {increment = half (increment f)}, f {increment = increment f - half (increment f)}] <> rest
  [] -> []
  where
    half (Pulses3 x y z) = Pulses3 (x `div` 2) (y `div` 2) (z `div` 2)

-- | Frames with an auxiliary command in the last one.
commanded :: [Frame] -> [Frame]
commanded fs = case reverse fs of
  f : rest -> reverse (f {commands = [(CommandName "aux", 7)]} : rest)
  [] -> []

isNotFollowed :: Finding -> Bool
isNotFollowed finding = case finding of
  NotFollowed _ -> True
  _ -> False

isCommand :: Finding -> Bool
isCommand finding = case finding of
  WrongCommand {} -> True
  _ -> False

-- | Test that a changed frame is found: it is the first one that differs, and the tape misses its
-- end or leaves the band. A change along the contour by more than the allowance leaves the band in
-- this frame or later.
isFound :: Int -> Frame -> Proof -> Bool
isFound n f p =
  firstDifference p == Just n
    && closure p /= 0
    && any
      (\finding -> isOpen finding || leavesBandFrom (if cutting then n else 1) finding)
      (findings p)
    && (not cutting || moved <= 3 || any (leavesBandFrom n) (findings p))
  where
    Pulses3 (Pulses x) (Pulses y) _ = increment f - increment (Flange.frames !! (n - 1))
    moved = max (abs x) (abs y)
    cutting =
      Frame.role (Frame.plannedFrames Flange.program !! (n - 1)) == Frame.Cutting 0
        && n < length Flange.frames - 12

-- | Test for a gouge or an excess in a frame or in a later one.
leavesBandFrom :: Int -> Finding -> Bool
leavesBandFrom n finding = case finding of
  Gouge w _ _ -> Proof.frame w >= n
  Excess w _ _ -> Proof.frame w >= n
  OffPlane m -> m == n
  _ -> False

isExcess :: Finding -> Bool
isExcess finding = case finding of
  Excess {} -> True
  _ -> False

isOpen :: Finding -> Bool
isOpen finding = case finding of
  NotClosed _ -> True
  _ -> False

-- | Numbers of the frames with a wrong feed.
wrongFeeds :: Proof -> [Int]
wrongFeeds p = [n | WrongFeed n _ _ _ <- findings p]
