-- | Tests of machine descriptions: the built-in ones, descriptions with mistakes, and random ones.
module Machine.FromTextSpec (spec) where

import Base.Quantity (Feed (..), Mm (..), radians)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Base.Result qualified as Result
import Control.Monad (forM_)
import Data.Bits (popCount, testBit)
import Data.List (nub, sort)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, isJust)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Word (Word8)
import Files (expected, filesBelow, readText)
import Generate.Controller (controllerFor)
import Generate.Machine (machine)
import Machine.BuiltIn qualified as BuiltIn
import Machine.Error (Error)
import Machine.Error qualified as Error
import Machine.FromText qualified as FromText
import Machine.Machine hiding (choose)
import Machine.Machine qualified as Machine
import Machine.ToText (toText)
import Report.Human qualified as Human
import Report.Report (ReportPlace (..))
import Report.Report qualified as Report
import System.FilePath (takeExtension, (-<.>))
import Test.Hspec
import Test.QuickCheck hiding (Fixed, Result)

spec :: Spec
spec = do
  describe "the built-in machines" builtInMachines
  describe "wrong descriptions give their reports, and no machine" $ do
    files <-
      runIO (sort . filter ((== ".machine") . takeExtension) <$> filesBelow "test/machines/bad")
    forM_ files $ \file -> it file $ do
      text <- readText file
      let outcome = reading text
      Result.ifSound outcome `shouldBe` Nothing
      let source = Region.fromText (Text.pack file) text
      expected
        (file -<.> "report")
        ( Text.concat
            [ Human.render Human.Plain (Text.pack file) source r <> "\n"
              | r <- Report.sorted (map Error.toReport (errors outcome))
            ]
        )
    it "every report code occurs for one of them (catches a code that nothing raises)" $ do
      reports <- Text.concat <$> traverse (readText . (-<.> "report")) files
      let isRaised c = ("[E" <> Text.pack (show c) <> "]") `Text.isInfixOf` reports
      filter (not . isRaised) [1001 .. 1014 :: Int] `shouldBe` []
  describe "the guide docs/new-machine.md" $
    it
      "contains examples/machines/fm-8.machine, which describes a machine (catches a guide that \
      \nobody can follow)"
      $ do
        text <- readText "examples/machines/fm-8.machine"
        guide <- readText "docs/new-machine.md"
        map titleOf (errors (reading text)) `shouldBe` []
        guide `shouldSatisfy` Text.isInfixOf ("```machine\n" <> text <> "```")
  describe "reading" (laws >> provenanceLaws)

reading :: Text -> Result () Error Machine
reading = FromText.read

titleOf :: Error -> Text
titleOf = Report.title . Error.toReport

-- The built-in machines ---------------------------------------------------------------------------

builtInMachines :: Spec
builtInMachines = do
  it
    "are read without a report, each under the name of its file (catches a machine whose mistake \
    \stops the program)"
    $ forM_ BuiltIn.names $ \n -> do
      fmap (map titleOf . errors . reading) (BuiltIn.text n) `shouldBe` Just []
      fmap name (BuiltIn.find n) `shouldBe` Just n
  it "are these" $
    [n | MachineName n <- BuiltIn.names]
      `shouldBe` [ "fanuc",
                   "grbl",
                   "haas",
                   "iso6983",
                   "kontur-2p",
                   "kontur-3p",
                   "linuxcnc-lathe",
                   "linuxcnc-mill",
                   "lki-fm",
                   "lki-u",
                   "lki-un",
                   "lkp-01f",
                   "marlin",
                   "n55"
                 ]
  it "list the provenance of more than 30 values each (catches values without provenance)" $
    forM_ BuiltIn.machines $ \m -> length (describedValues m) `shouldSatisfy` (> 30)
  it "punch the digits of code 5121 as in Table 6 of Ural (catches a digit punched as another)" $
    forM_ ["lkp-01f", "lki-u"] $ \n ->
      rows n "0123456789" `shouldBe` [0x0, 0x1, 0x5, 0x6, 0x7, 0x8, 0x9, 0xA, 0xB, 0xF]
  it
    "punch a letter of БЦК-5 as its number and a hole in track 5, as the NC course says (catches a \
    \letter read as another)"
    $ do
      rows "kontur-3p" "0123456789" `shouldBe` [0 .. 9]
      rows "kontur-3p" "НЕДТКПШСВЯ" `shouldBe` [16 .. 25]
      fmap (\m -> map (`Map.lookup` weights (code m)) "НЕДТКПШСВЯ") (found "kontur-3p")
        `shouldBe` Just (map Just [0 .. 9])
  it "punch X, 3 and + of ISO-7bit as the NC course prints them (catches a wrong parity)" $
    map (holesOf "n55") "X3+" `shouldBe` [[4, 5, 7, 8], [1, 2, 5, 6], [1, 2, 4, 6]]
  it "give the frames of lkp-01f four digits of x, four of y, three of z and one of the feed" $
    fmap (\m -> [(contentName (content w), digits (form w)) | w <- wordsOf m]) (found "lkp-01f")
      `shouldBe` Just [("x", 4), ("y", 4), ("z", 3), ("feed", 1)]
  it "have the speed of the punch that Ural prints, 300 rows a minute, and no other" $
    [(n, r) | m <- BuiltIn.machines, let MachineName n = name m, Just r <- [punchRate (medium m)]]
      `shouldBe` [("lkp-01f", 300)]
  it "move z on Контур-3П-68, but not on lkp-01f and Контур-2П" $
    map (fmap drivenAxes . found) ["lkp-01f", "kontur-2p", "kontur-3p"]
      `shouldBe` [Just [X, Y], Just [X, Y], Just [X, Y, Z]]
  it "have these resolutions in the plane, in mm (catches a part of the wrong size)" $
    [ fmap (\m -> let Mm p = planeResolution m in p) (BuiltIn.find (MachineName n))
      | n <- ["iso6983", "kontur-2p", "kontur-3p", "lki-fm", "lki-u", "lki-un", "lkp-01f", "n55"]
    ]
      `shouldBe` map Just [0.001, 0.01, 0.01, 0.02, 0.02, 0.01, 0.02, 0.01]
  it "have the feeds of their tables (catches a feed other than the requested one)" $ do
    fmap (`valueOf` FeedCode 5) (found "lkp-01f") `shouldBe` Just (Just 60)
    fmap (`valueOf` FeedCode 20) (found "lki-fm") `shouldBe` Just (Just 100)
    map (\k -> fmap (`valueOf` FeedCode k) (found "kontur-3p")) [27, 32, 33, 43]
      `shouldBe` map (Just . Just) [900, 33.4, 10, 100]
    fmap rapidCode (found "kontur-3p") `shouldBe` Just (FeedCode 27)
    fmap (\m -> choose' m (20 / 60 / 0.01)) (found "kontur-3p")
      `shouldBe` Just (Given (FeedCode 32) 33.4)
    fmap feedRange (found "lki-un") `shouldBe` Just (1, 999)
  it "weigh 9Д56000П27Ш08Н as 50 on Контур-3П-68, as the NC course says" $
    fmap
      (\m -> sum [Map.findWithDefault 0 c (weights (code m)) | c <- "9Д56000П27Ш08Н"])
      (found "kontur-3p")
      `shouldBe` Just 50
  it
    "have auxiliary commands up to 7 on lkp-01f and 99 on Контур-3П-68 (catches a command that no \
    \frame can contain)"
    $ [capacity' m "aux" | Just m <- map found ["lkp-01f", "kontur-3p"]]
      `shouldBe` [Just 7, Just 99]
  where
    found = BuiltIn.find . MachineName
    rows :: Text -> String -> [Word8]
    rows n cs = case found n of
      Just m -> [p | c <- cs, Just p <- [Map.lookup c (symbols (code m))]]
      Nothing -> []
    capacity' m n = commandCapacity m (CommandName n)
    choose' = Machine.choose
    holesOf n c = case found n of
      Just m
        | Just p <- Map.lookup c (symbols (code m)) ->
          [k | k <- [1 .. 7], testBit p (k - 1)]
            <> [k | odd (popCount p), Just k <- [evenTrack (code m)]]
      _ -> []

-- Laws --------------------------------------------------------------------------------------------

laws :: Spec
laws = do
  whole <- runIO (traverse readText ["examples/machines/fm-8.machine", "machines/lkp-01f.machine"])
  it
    "a machine that is written as a description is read as the same machine (catches a field that \
    \the language cannot express)"
    $ forAll (furnished . describable =<< machine) $ \m ->
      let outcome = reading (toText m)
       in counterexample
            (Text.unpack (toText m <> "\n" <> Text.unlines (map titleOf (errors outcome))))
            $ fmap (\read' -> read' {describedValues = []}) (Result.ifSound outcome)
              === Just m {describedValues = []}
  it
    "no text makes the reader crash, and every report lies within the text (catches an exception, \
    \a report outside of the file)"
    $ forAll (mutilated =<< elements whole) isSound
  it "each missing line is reported (catches a value that is invented)" $ do
    text <- readText "machines/lki-un.machine"
    let ls = Text.lines text
        needed =
          [ k
            | (k, l) <- zip [0 ..] ls,
              w <- take 1 (Text.words l),
              w `elem` requiredKeys
          ]
        isAccepted ls' = isJust (Result.ifSound (reading (Text.unlines ls')))
    [l | k <- needed, (front, l : rest) <- [splitAt k ls], isAccepted (front <> rest)]
      `shouldBe` []
  where
    requiredKeys =
      Text.words
        "tracks pitch suffix leader gap spare pulse numbers digits straight measure direct rule \
        \rapid deceleration by arcs"
    isSound text =
      let outcome = reading text
          regions =
            [region | InSource region <- map (Report.place . Error.toReport) (errors outcome)]
          isInText (Region.Region a b) = a >= 0 && a <= b && b <= Text.length text
       in length (show outcome) > 0 .&&. all isInText regions

provenanceLaws :: Spec
provenanceLaws = do
  it
    "every value keeps its mark, and the mark of a line overrides that of the block around it \
    \(catches a provenance that is better than the truth)"
    $ do
      values <- valuesOf <$> readText "examples/machines/fm-8.machine"
      take 2 (filter (Text.isInfixOf "axis z" . snd) values)
        `shouldBe` [ ( Corrected,
                       "axis z: pulse 0.0125 mm — manual, page 1: 0.125 mm, which would make its \
                       \travel of 2 m one of 20 m"
                     ),
                     (Sourced, "axis z: direction reversed — manual, page 1: plus is into the part")
                   ]
      lookup Corrected (filter (Text.isInfixOf "25 = " . snd) values)
        `shouldBe` Just "feeds: table: 25 = 420 — manual, page 10: 42, between 300 and 600"
  it
    "the mark of a word overrides that of the frame (catches a provenance that is better than the \
    \truth)"
    $ do
      values <- valuesOf <$> readText "machines/kontur-3p.machine"
      filter (isPresenceOfWord . snd) values
        `shouldBe` [ (Sourced, "frame: word \"Е\" along x: when needed"),
                     (Reconstructed, "frame: word \"Т\" along z: when needed"),
                     ( Reconstructed,
                       "frame: word \"П\" feed: when moving — П stands in the frames of the example"
                     )
                   ]
  where
    valuesOf text =
      [ (mark, fact)
        | Just m <- [Result.ifSound (reading text)],
          DescribedValue mark fact <- describedValues m
      ]
    isPresenceOfWord fact =
      "when" `Text.isInfixOf` fact
        && any (\w -> ("frame: word " <> w) `Text.isPrefixOf` fact) ["\"Е\"", "\"Т\"", "\"П\""]

-- | Replaces, inserts and deletes characters of a text, at 1 to 5 random points.
mutilated :: Text -> Gen Text
mutilated text = do
  n <- choose (1, 5 :: Int)
  foldl (\t _ -> t >>= changed) (pure text) [1 .. n]
  where
    changed t = do
      k <- choose (0, Text.length t)
      c <-
        elements
          (["", "", "{", "}", "\"", "=", "..", "0", "-", "\n", "(", "^", ":"] <> keywordsAndEscapes)
      deleted <- choose (0, 3)
      pure (Text.take k t <> c <> Text.drop (k + deleted) t)
    keywordsAndEscapes = ["reconstructed", "word", "\\"]

-- | Replaces the title, the braking, the limits, the choice of feeds and the commands of a machine
-- by random ones that its frame can express.
furnished :: Machine -> Gen Machine
furnished m = do
  heading <- elements ["", "a \"mill\" \\ with words", "Фрезерный станок"]
  brakingForm' <-
    elements [ByControl, SlowFrames, BrakedFrames (Feed (snd (feedRange m)))]
  a <- choose (0.001, 1000)
  contours <- elements [Nothing, Just 1, Just 30]
  measured <- elements [AlongPath, LeadingAxis]
  rounding <- elements [NotAbove, Nearest]
  rapid' <- elements [Highest, ByCode (fst (slowest m))]
  perTurn <- elements [Nothing, Just (TurnFeeds 0.001 1 20000), Just (TurnFeeds 1 2 7)]
  commands' <- commandsFor m
  let hasBrakingHole = BrakingHole `elem` concatMap (service . form) (wordsOf m)
      canBrakeByFrames = hasBrakingHole && measured == AlongPath
  let whole =
        m
          { title = heading,
            braking = Braking a (if canBrakeByFrames then brakingForm' else ByControl),
            limits = Limits contours,
            feeds =
              (feeds m)
                { feedMeasure = measured,
                  rule = rounding,
                  rapidFeed = rapid',
                  turnFeeds = perTurn
                },
            commandWords = commands'
          }
  control <- controllerFor whole
  pure whole {Machine.controller = control}

-- | Random commands for the words and bits of a machine.
commandsFor :: Machine -> Gen CommandWords
commandsFor m = do
  listed <- traverse (const event) [1 .. 9 :: Int]
  dwells <- sublistOf names >>= traverse dwellWord
  surface <- sublistOf names >>= traverse surfaceWord
  ends <- resize 3 (listOf (fixedWord m =<< elements ("" : names)))
  compensated <- elements [Nothing, Just False, Just True]
  pure $ case (listed, names) of
    ([b, c, d, e, f, g, h, i, j], n : _) ->
      CommandWords
        { spindleClockwise = b,
          spindleCounterClockwise = c,
          spindleOff = onlyFixed d,
          coolantOn = onlyFixed e,
          coolantOff = onlyFixed f,
          toolChange = withoutSteps g,
          auxiliary = withoutSteps h,
          programStop = onlyFixed i,
          optionalStop = onlyFixed j,
          dwell = dwells,
          surfaceClockwise = surface,
          surfaceCounterClockwise = reverse surface,
          compensation = compensationBy m n <$> compensated,
          finish = [o NonEmpty.:| [] | Just o <- ends]
        }
    _ -> noCommandWords
  where
    names = namesOfCommands m
    event = sublistOf names >>= traverse (commandWord m)
    onlyFixed os = [o | o@(CommandWord _ (Fixed _)) <- os]
    withoutSteps os = [o | o@(CommandWord _ v) <- os, not (isStep v)]
    isStep v = case v of
      Step _ -> True
      Fixed _ -> False
      Argument -> False
      Diameter -> False
      InSeconds -> False
      InMilliseconds -> False
      SurfaceSpeed _ -> False
      SpeedLimit -> False
    surfaceWord n = CommandWord (CommandName n) <$> elements [SurfaceSpeed 1000, SpeedLimit]
    dwellWord n = CommandWord (CommandName n) <$> elements [InSeconds, InMilliseconds]

-- | Names of the commands for which a frame has a word or bits.
namesOfCommands :: Machine -> [Text]
namesOfCommands m =
  nub
    [ n
      | w <- wordsOf m,
        CommandName n <- [o | Command o <- [content w]] <> [o | CommandBit o _ <- service (form w)],
        leastNumber m n <= mostNumber m n
    ]

compensationBy :: Machine -> Text -> Bool -> CompensationCommands
compensationBy m n hasSwitch =
  CompensationCommands
    (CommandWord (CommandName n) Diameter)
    (CommandWord (CommandName n) Diameter)
    least
    (if hasSwitch then Just least else Nothing)
  where
    least = CommandWord (CommandName n) (Fixed (leastNumber m n))

-- | A random value for the word of a command: a number, the program's argument, or a table of
-- steps.
commandWord :: Machine -> Text -> Gen CommandWord
commandWord m n = do
  k <- choose (leastNumber m n, mostNumber m n)
  v <- elements [Fixed k, Argument, Step (Map.fromList [(k, 63), (leastNumber m n, 12.5)])]
  pure (CommandWord (CommandName n) v)

-- | A random fixed number for the word of a command; 'Nothing' for an empty name.
fixedWord :: Machine -> Text -> Gen (Maybe CommandWord)
fixedWord m n
  | n == "" = pure Nothing
  | otherwise =
    Just . CommandWord (CommandName n) . Fixed <$> choose (leastNumber m n, mostNumber m n)

-- | Least number of a command: 1 if the word or the bits are in every frame, because 0 then means
-- that no command is given; else 0.
leastNumber :: Machine -> Text -> Int
leastNumber m n = if canEncode m (CommandName n) 0 then 0 else 1

-- | Largest number of a command.
mostNumber :: Machine -> Text -> Int
mostNumber m n = fromMaybe 0 (commandCapacity m (CommandName n))

-- | Changes a random machine into one that a description can express. An axis gets the resolution
-- of the last decimal of its word, in mm or in degrees. A feed word that is not in every frame is
-- in frames with a new feed; a command word, in frames that give the command.
describable :: Machine -> Machine
describable m =
  m
    { axes = fmap pulsed (axes m),
      rotaryAxes = map turning (rotaryAxes m),
      layout = (layout m) {items = fmap fitting (items (layout m))}
    }
  where
    pulsed a = case places [Along (axis a), Centre (axis a)] of
      k : _ -> a {resolution = Mm (10 ^^ negate k)}
      [] -> a
    turning a = case places [About (rotaryAxis a)] of
      k : _ -> a {pulseAngle = radians (10 ^^ negate k)}
      [] -> a
    places contents =
      nub
        [decimals (form w) | w <- wordsOf m, content w `elem` contents, decimals (form w) > 0]
    fitting item = case item of
      AWord w -> AWord w {presence = expressible (content w) (presence w)}
      Literal _ -> item
      CheckDigit _ -> item
    expressible c p = case (c, p) of
      (FeedWord, WhenNeeded) -> WhenChanged
      (Command _, InMotion) -> WhenNeeded
      _ -> p
