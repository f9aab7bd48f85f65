-- | The frames for modern controls, run by the interpreter of LinuxCNC. @make@ installs it with the
-- other packages; without it these tests are pending.
module LinuxCncSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Base.Result qualified as Result
import Command (inFolder, partc)
import Compile (Analysis (..))
import Compile qualified
import Control.Exception (IOException, try)
import Control.Monad (forM_)
import Data.Bifunctor (first)
import Data.ByteString qualified as ByteString
import Data.Either (isLeft)
import Data.List (sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Files (readText)
import Generate.CannedCycle qualified as CannedCycle
import Geometry.Carrier (Circle (Circle), Sense (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import LinuxCnc (Canonical (..), Leg (..), Position (..), Speed (..))
import LinuxCnc qualified
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report qualified as Report
import Surface.Import qualified as Import
import System.Directory (listDirectory)
import System.Exit (ExitCode (..))
import System.FilePath (takeBaseName, takeExtension, (<.>), (</>))
import Test.Hspec
import Test.QuickCheck hiding (within)

spec :: Spec
spec = do
  describe "canonical calls" $ do
    it "are read in mm, whichever unit holds (a program in inches would be 25 times too small)" $
      LinuxCnc.parse
        ( Text.unlines
            [ "    1 N..... USE_LENGTH_UNITS(CANON_UNITS_INCHES)",
              "    2 N0020  SET_FEED_RATE(10.0000)",
              "    3 N..... ARC_FEED(1.0000, 2.0000, 1.0000, 1.0000, 1, 0.0000, 0.0000, 0.0000, \
              \0.0000)"
            ]
        )
        `shouldBe` Right
          [Rounding 254 CounterClockwise (Vec.point 25.4 25.4) (Position 25.4 50.8 0)]
    it "that are unknown are refused (a probe or a moved zero would look like no move)" $
      map
        LinuxCnc.parse
        [ "    1 N..... STRAIGHT_PROBE(1.0, 2.0, 3.0, 0.0, 0.0, 0.0)",
          "    1 N..... SET_G5X_OFFSET(2, 5.0, 0.0, 0.0, 0.0, 0.0, 0.0)",
          "    1 N..... MESSAGE(\"hello\")",
          "    1 N..... STRAIGHT_FEED(1.0, 2.0, 3.0, 4.0, 0.0, 0.0)"
        ]
        `shouldSatisfy` all isLeft

  describe "the comparison" $ do
    let onward = Feeding 60 (Position 10 5 0)
        back = Rounding 60 Clockwise (p (15, 5)) (Position 20 5 0)
        made = LinuxCnc.movesFrom (Position 0 0 0) [Traverse (Position 10 0 0), onward, back]
        instead moves =
          LinuxCnc.differences
            wanted
            (LinuxCnc.movesFrom (Position 0 0 0) (Traverse (Position 10 0 0) : moves))
        wanted =
          [ rapid (0, 0) (10, 0),
            feed60 (Straight (p (10, 0)) (p (10, 5))),
            feed60 (halfTurn (15, 5) (10, 5) (20, 5))
          ]
    it "finds no difference in moves that follow the legs" $
      LinuxCnc.differences wanted made `shouldBe` []
    it "notices a leg that is left out" $
      LinuxCnc.differences wanted (take 2 made) `shouldSatisfy` some
    it "notices a move too many" $ LinuxCnc.differences (take 2 wanted) made `shouldSatisfy` some
    it "notices an arc in the other sense, which has the same ends" $
      instead [onward, Rounding 60 CounterClockwise (p (15, 5)) (Position 20 5 0)]
        `shouldSatisfy` some
    it "notices an end that deviates by 0.003 mm" $
      instead [Feeding 60 (Position 10 5.003 0), back] `shouldSatisfy` some
    it "notices a move in the wrong order" $
      LinuxCnc.differences wanted (reverse made) `shouldSatisfy` some
    it "notices a rapid move instead of a cut, and a wrong feed" $ do
      instead [Traverse (Position 10 5 0), back] `shouldSatisfy` some
      instead [Feeding 62 (Position 10 5 0), back] `shouldSatisfy` some
    it "notices a wrong height" $
      instead
        [Feeding 60 (Position 10 5 (-1)), Rounding 60 Clockwise (p (15, 5)) (Position 20 5 (-1))]
        `shouldSatisfy` some
    let round60 =
          [ rapid (0, 0) (10, 0),
            feed60 (Segment.fullCircle CounterClockwise (Circle (p (0, 0)) (Mm 10)) (p (10, 0)))
          ]
        half sense to = Rounding 60 sense (p (0, 0)) (Position to 0 0)
    it "accepts several moves on one leg, and a full circle as two arcs" $
      LinuxCnc.differences
        round60
        ( LinuxCnc.movesFrom
            (Position 0 0 0)
            [ Traverse (Position 4 0 0),
              Traverse (Position 10 0 0),
              half CounterClockwise (-10),
              half CounterClockwise 10
            ]
        )
        `shouldBe` []
    it "does not accept a half circle, forth and back, as a full circle" $
      LinuxCnc.differences
        round60
        ( LinuxCnc.movesFrom
            (Position 0 0 0)
            [Traverse (Position 10 0 0), half CounterClockwise (-10), half Clockwise 10]
        )
        `shouldSatisfy` some
    it "notices radii that differ by 0.003 mm, which LinuxCNC itself accepts" $
      [ null
          ( LinuxCnc.radii
              ( LinuxCnc.movesFrom
                  (Position 0 (-10) 0)
                  [Rounding 60 CounterClockwise (p (0, 0)) (Position 0 (10 + d) 0)]
              )
          )
        | d <- [0, 0.001, 0.003]
      ]
        `shouldBe` [True, True, False]

  present <- runIO LinuxCnc.installed
  examples <-
    runIO
      (sort . filter ((`elem` [".part", ".sheet"]) . takeExtension) <$> listDirectory "examples")
  describe "LinuxCNC" $
    if present
      then do
        interpreter
        it
          "expands random canned cycles as the reader of files does (catches a return that is too \
          \high, and a cycle that comes back to another height)"
          $ property (forAll CannedCycle.lines' expandsAlike)
        describe "retraces the path of every example" $
          forM_ examples $ \file ->
            it file (retraced ("examples" </> file))
      else
        it
          "runs programs"
          (pendingWith "rs274 is not installed (scripts/setup.sh installs linuxcnc-uspace)")
  where
    some = not . null

-- | The behaviour of the interpreter that the comparison relies on.
interpreter :: Spec
interpreter = do
  it "retraces lines, arcs of both senses, a circle in two halves and a descent" $
    run
      [ "G0 X10 Y0 Z5",
        "G1 Z-2 F20",
        "X20 F60",
        "G3 X30 Y10 I0 J10",
        "G2 X40 Y20 I10 J0",
        "G2 X60 Y20 I10 J0",
        "G2 X40 Y20 I-10 J0",
        "G0 Z5"
      ]
      >>= \result ->
        fmap (LinuxCnc.differences everything . LinuxCnc.movesFrom (Position 0 0 0)) result
          `shouldBe` Right []
  it "gives the radius of an arc at both ends as it was written" $
    run ["G0 X0 Y-10", "G3 X0 Y10.001 I0 J10 F60", "G3 X0 Y-10 I0 J-10.0005"] >>= \result ->
      fmap (LinuxCnc.radii . LinuxCnc.movesFrom (Position 0 0 0)) result `shouldBe` Right []
  it "refuses an arc whose radii differ by 0.03 mm (bad centres would go to the machine)" $
    run ["G0 X0 Y-10", "G3 X0 Y10.03 I0 J10 F60"] >>= refused "Radius to end of arc differs"
  it "refuses to cut without a feed" $ run ["G1 X10"] >>= refused "zero feed rate"
  it "refuses a letter twice, and a program without its end" $ do
    run ["G0 X10 X20"] >>= refused "Multiple x words"
    inFolder
      ( \folder ->
          ByteString.writeFile (folder </> "a.ngc") "%\nG21\nG0 X10\n"
            >> LinuxCnc.canonical (folder </> "a.ngc")
      )
      >>= refused "no percent sign"
  it "is not trusted when it prints a message" $
    run ["(MSG, tighten the clamp)", "G0 X1"] >>= refused "MESSAGE"
  describe "with the correction of the cutter's radius" $ do
    it
      "keeps the cutter on the programmed side, round an outer corner and in an inner one"
      $ do
        let contour = ["G1 X0 Y-15 F60", "Y40", "X60", "Y80", "G40", "G1 X20 Y100"]
            beside word legs' =
              ( \result ->
                  fmap
                    ( LinuxCnc.differences (rapid (0, 0) (0, -40) : map feed60 legs')
                        . LinuxCnc.movesFrom (Position 0 0 0)
                    )
                    result
              )
                <$> run (["G0 X0 Y-40", word] <> contour)
        left <-
          beside
            "G41.1 D20"
            ( lines' [(0, -40), (-10, -15), (-10, 40)]
                <> [arcTo (0, 40) (-10, 40) (0, 50)]
                <> lines' [(0, 50), (50, 50), (50, 80), (20, 100)]
            )
        left `shouldBe` Right []
        right <-
          beside
            "G42.1 D20"
            ( lines' [(0, -40), (10, -15), (10, 30), (60, 30)]
                <> [arcAbout (60, 40) (60, 30) (70, 40)]
                <> lines' [(70, 40), (70, 80), (20, 100)]
            )
        right `shouldBe` Right []
    -- On the lines on which compensation begins and ends, the cutter's centre is on the toolpath if
    -- the edge is right.
    mapM_
      ( \name ->
          it
            ( "retraces the path of the program "
                <> name
                <> ", from its edge (catches a wrong edge or diameter)"
            )
            (retraced ("test/programs/mill/good/compensation-" <> name <> ".part"))
      )
      ["lead-arc", "lead-arc-right", "corner", "open", "flange", "depth", "curve", "two-tools"]
    it "refuses an entry that is no longer than the radius" $ do
      run ["G0 X0 Y-25", "G41.1 D20", "G1 X0 Y-15 F60", "Y40", "G40", "G1 X-40"]
        >>= refused "entry move is not greater than the tool radius"
      run ["G0 X0 Y-25.001", "G41.1 D20", "G1 X0 Y-15 F60", "Y40", "G40", "G1 X-40"]
        >>= (`shouldNotSatisfy` isLeft)
    it "refuses an arc into which the cutter does not fit" $
      run ["G0 X-40 Y0", "G41.1 D20", "G1 X0 Y0 F60", "G3 X8 Y8 I0 J8", "G40", "G1 Y50"]
        >>= refused "Tool radius not less than arc radius"
    it "refuses a corner whose side is too short" $
      run ["G0 X-40 Y0", "G41.1 D20", "G1 X0 F60", "X40", "Y9", "X80", "G40", "G1 Y40"]
        >>= refused "concave corner cannot be reached"
    it "refuses to leave along an arc" $
      run ["G0 X0 Y-40", "G41.1 D20", "G1 X0 Y-15 F60", "Y40", "G40", "G2 X10 Y50 I10 J0"]
        >>= refused "must be straight"
  where
    everything =
      [ Leg
          { chain = (still (0, 0) (10, 0), (0, 5)) :| [],
            within = LinuxCnc.exactly,
            wanted = InRapid
          },
        Leg
          { chain = (still (10, 0) (10, 0), (5, -2)) :| [],
            within = LinuxCnc.exactly,
            wanted = AtFeed 20
          }
      ]
        <> map
          (lowered (-2) . feed60)
          [ Straight (p (10, 0)) (p (20, 0)),
            arcAbout (20, 10) (20, 0) (30, 10),
            arcTo (40, 10) (30, 10) (40, 20),
            Segment.fullCircle Clockwise (Circle (p (50, 20)) (Mm 10)) (p (40, 20))
          ]
        <> [ Leg
               { chain = (still (40, 20) (40, 20), (-2, 5)) :| [],
                 within = LinuxCnc.exactly,
                 wanted = InRapid
               }
           ]
    still a b = Straight (p a) (p b)
    lowered z leg = leg {chain = fmap (\(s, _) -> (s, (z, z))) (chain leg)}
    arcTo centre from to = Segment.arc Clockwise (p centre) (p from) (p to)
    arcAbout centre from to = Segment.arc CounterClockwise (p centre) (p from) (p to)
    lines' corners = zipWith still corners (drop 1 corners)

-- | Runs the interpreter on a program of these lines, after a common head.
run :: [Text] -> IO (Either Text [Canonical])
run written = inFolder $ \folder -> do
  let file = folder </> "program.ngc"
  ByteString.writeFile
    file
    ( Encoding.encodeUtf8
        (Text.unlines (["%", "G21 G17 G90 G94 G40 G49 G80"] <> written <> ["M5", "M30", "%"]))
    )
  LinuxCnc.canonical file

-- | Expects that the interpreter complains, with these words in its complaint.
refused :: Text -> Either Text [Canonical] -> Expectation
refused why result = case result of
  Left said -> said `shouldSatisfy` Text.isInfixOf why
  Right moves -> expectationFailure ("it was accepted: " <> show moves)

p :: (Double, Double) -> Point
p (x, y) = Vec.point x y

rapid :: (Double, Double) -> (Double, Double) -> Leg
rapid a b =
  Leg {chain = (Straight (p a) (p b), (0, 0)) :| [], within = LinuxCnc.exactly, wanted = InRapid}

feed60 :: Segment -> Leg
feed60 s = Leg {chain = (s, (0, 0)) :| [], within = LinuxCnc.exactly, wanted = AtFeed 60}

halfTurn :: (Double, Double) -> (Double, Double) -> (Double, Double) -> Segment
halfTurn centre from to = Arc {start = p from, end = p to, centre = p centre, sweep = Rad (-pi)}

-- | Expects the same moves of lines with canned cycles from LinuxCNC and from the reader of files.
expandsAlike :: [Text] -> Property
expandsAlike written = ioProperty $ do
  result <- run written
  pure $ case result of
    Left said -> counterexample (Text.unpack said) False
    Right calls ->
      counterexample (show (zip calls read')) $
        length moves === length read' .&&. conjoin (zipWith isNear moves read')
      where
        moves = CannedCycle.distinct (map CannedCycle.ofCanonical calls)
  where
    read' = CannedCycle.distinct (CannedCycle.readMoves written)
    isNear (isRapid, a) (isRapid', b) =
      property (isRapid == isRapid' && and (zipWith (\x y -> abs (x - y) < 0.002) a b))

-- | Compiles a part program for a modern control, and expects that LinuxCNC accepts the text
-- without a message and moves along the toolpath.
retraced :: FilePath -> Expectation
retraced file = inFolder $ \folder -> do
  let text = folder </> takeBaseName file <.> "ngc"
  (status, _, err) <- partc ["--quiet", "compile", file, "--target", "iso6983", "-o", text]
  (status, err) `shouldBe` (ExitSuccess, "")
  loaded <- LoadedProgram.load (Import.byName reader) file =<< readText file
  let outcome = Compile.analyse [] loaded
  case Result.ifSound outcome of
    Nothing -> expectationFailure (show (map Report.title (Result.errors outcome)))
    Just analysis -> do
      let (from, wanted) = LinuxCnc.legs (path analysis)
      result <- LinuxCnc.canonical text
      fmap
        ( \calls ->
            let made = LinuxCnc.movesFrom from calls
             in LinuxCnc.differences wanted made <> LinuxCnc.radii made
        )
        result
        `shouldBe` Right []
  where
    reader name = first why <$> try (readText name)
    why :: IOException -> Text
    why = Text.pack . show
