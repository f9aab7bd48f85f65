-- | Descriptions of machines: the ones that partc has, ones that are wrong, and random ones.
module Machine.FromTextSpec (spec) where

import Base.Quantity (Feed (..), Mm (..))
import Base.Region qualified as Region
import Base.Result (Result (..))
import Base.Result qualified as Result
import Control.Monad (forM_)
import Data.Bits (popCount, testBit)
import Data.List (nub, sort)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Word (Word8)
import Files (expected, readText, walk)
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
  describe "the machines that partc has" builtIn
  describe "wrong descriptions give their reports, and no machine" $ do
    files <- runIO (sort . filter ((== ".machine") . takeExtension) <$> walk "test/machines/bad")
    forM_ files $ \file -> it file $ do
      text <- readText file
      let outcome = reading text
      Result.settled outcome `shouldBe` Nothing
      let source = Region.fromText (Text.pack file) text
      expected
        (file -<.> "report")
        ( Text.concat
            [ Human.render Human.Plain (Text.pack file) source r <> "\n"
              | r <- Report.sorted (map Error.toReport (errors outcome))
            ]
        )
    it "every kind of report has a description (a code that nothing raises is dead)" $ do
      reports <- Text.concat <$> traverse (readText . (-<.> "report")) files
      [c | c <- [1001 .. 1014 :: Int], not (Text.isInfixOf ("[E" <> Text.pack (show c) <> "]") reports)]
        `shouldBe` []
  describe "the guide docs/new-machine.md" $
    it
      "holds examples/machines/fm-8.machine, and that is a machine (a guide that nobody can follow)"
      $ do
        text <- readText "examples/machines/fm-8.machine"
        guide <- readText "docs/new-machine.md"
        map titleOf (errors (reading text)) `shouldBe` []
        guide `shouldSatisfy` Text.isInfixOf ("```machine\n" <> text <> "```")
  describe "reading" laws

reading :: Text -> Result () Error Machine
reading = FromText.read

titleOf :: Error -> Text
titleOf = Report.title . Error.toReport

-- The machines that partc has ---------------------------------------------------------------------

builtIn :: Spec
builtIn = do
  it "read without a report, each under the name of its file (a machine that stops the program)" $
    forM_ BuiltIn.names $ \n -> do
      fmap (map titleOf . errors . reading) (BuiltIn.text n) `shouldBe` Just []
      fmap name (BuiltIn.find n) `shouldBe` Just n
  it "are these eight" $
    [n | MachineName n <- BuiltIn.names]
      `shouldBe` [ "iso6983",
                   "kontur-2p",
                   "kontur-3p",
                   "lki-fm",
                   "lki-u",
                   "lki-un",
                   "lkp-01f",
                   "n55"
                 ]
  it "are known value by value: a fact for every line that says one (a value without its history)" $
    forM_ BuiltIn.machines $ \m -> length (facts m) `shouldSatisfy` (> 30)
  it "5121 is Table 6 of the Ural paper (a digit punched as another)" $
    forM_ ["lkp-01f", "lki-u"] $ \n ->
      rows n "0123456789" `shouldBe` [0x0, 0x1, 0x5, 0x6, 0x7, 0x8, 0x9, 0xA, 0xB, 0xF]
  it
    "БЦК-5 is that of the course: a letter is its number and a hole in track 5 (a letter read as \
    \another)"
    $ do
      rows "kontur-3p" "0123456789" `shouldBe` [0 .. 9]
      rows "kontur-3p" "НЕДТКПШСВЯ" `shouldBe` [16 .. 25]
      fmap (\m -> map (`Map.lookup` weights (code m)) "НЕДТКПШСВЯ") (found "kontur-3p")
        `shouldBe` Just (map Just [0 .. 9])
  it "ISO-7bit has the holes that the course prints for X, 3 and + (a wrong parity)" $
    map (holesOf "n55") "X3+" `shouldBe` [[4, 5, 7, 8], [1, 2, 5, 6], [1, 2, 4, 6]]
  it "frames of lkp-01f have four digits of x, four of y, three of z and one of speed" $
    fmap (\m -> [(contentWord (content w), digits (form w)) | w <- wordsOf m]) (found "lkp-01f")
      `shouldBe` Just [("x", 4), ("y", 4), ("z", 3), ("feed", 1)]
  it "lkp-01f is not known to move z, and Контур-2П has none" $
    map (fmap driven . found) ["lkp-01f", "kontur-2p", "kontur-3p"]
      `shouldBe` [Just [X, Y], Just [X, Y], Just [X, Y, Z]]
  it "pulses are those of the table of machines (a part of another size)" $
    [fmap (\m -> let Mm p = pulse m in p) (BuiltIn.find n) | n <- BuiltIn.names]
      `shouldBe` map Just [0.001, 0.01, 0.01, 0.02, 0.02, 0.01, 0.02, 0.01]
  it "feeds are those of the tables (another feed than asked)" $ do
    fmap (`valueOf` FeedCode 5) (found "lkp-01f") `shouldBe` Just (Just 60)
    fmap (`valueOf` FeedCode 20) (found "lki-fm") `shouldBe` Just (Just 100)
    map (\k -> fmap (`valueOf` FeedCode k) (found "kontur-3p")) [27, 32, 33, 43]
      `shouldBe` map (Just . Just) [900, 33.4, 10, 100]
    fmap rapidCode (found "kontur-3p") `shouldBe` Just (FeedCode 27)
    fmap (\m -> choose' m (20 / 60 / 0.01)) (found "kontur-3p")
      `shouldBe` Just (Given (FeedCode 32) 33.4)
    fmap feedRange (found "lki-un") `shouldBe` Just (1, 999)
  it "the check of Контур makes 9Д56000П27Ш08Н add to 50, as the course says" $
    fmap
      (\m -> sum [Map.findWithDefault 0 c (weights (code m)) | c <- "9Д56000П27Ш08Н"])
      (found "kontur-3p")
      `shouldBe` Just 50
  it "a commands' number fits its place (a command that no frame holds)" $
    [capacity' m "aux" | Just m <- map found ["lkp-01f", "kontur-3p"]] `shouldBe` [Just 7, Just 99]
  where
    found = BuiltIn.find . MachineName
    rows n cs =
      maybe
        []
        (\m -> [p | c <- cs, Just p <- [Map.lookup c (symbols (code m))]])
        (found n) ::
        [Word8]
    capacity' m n = orderCapacity m (CommandName n)
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
  it "what is written is read again as the same machine (a field that the language cannot say)" $
    forAll (furnished . describable =<< machine) $ \m ->
      let outcome = reading (toText m)
       in counterexample
            (Text.unpack (toText m <> "\n" <> Text.unlines (map titleOf (errors outcome))))
            $ fmap (\read' -> read' {facts = []}) (Result.settled outcome) === Just m {facts = []}
  it
    "every fact keeps its mark, and the line's own comes before that around it (history made nicer \
    \than it is)"
    $ do
      text <- readText "examples/machines/fm-8.machine"
      let marks =
            [ (mark, fact)
              | Just m <- [Result.settled (reading text)],
                DescribedValue mark fact <- facts m
            ]
      take 2 (filter (Text.isInfixOf "axis z" . snd) marks)
        `shouldBe` [ ( Corrected,
                       "axis z: pulse 0.0125 mm — manual, page 1: 0.125 mm, which would make its \
                       \travel of 2 m one of 20 m"
                     ),
                     (Sourced, "axis z: direction reversed — manual, page 1: plus is into the part")
                   ]
      lookup Corrected (filter (Text.isInfixOf "25 = " . snd) marks)
        `shouldBe` Just "feeds: table: 25 = 420 — manual, page 10: 42, between 300 and 600"
      -- Words with a mark of their own within a frame with another one.
      kontur <- readText "machines/kontur-3p.machine"
      [(mark, fact) | Just m <- [Result.settled (reading kontur)], DescribedValue mark fact <- facts m, w <- ["\"Е\"", "\"Т\"", "\"П\""], ("frame: word " <> w) `Text.isPrefixOf` fact, "when" `Text.isInfixOf` fact]
        `shouldBe` [ (Sourced, "frame: word \"Е\" along x: when needed"),
                     (Reconstructed, "frame: word \"Т\" along z: when needed"),
                     ( Reconstructed,
                       "frame: word \"П\" feed: when moving — П stands in the frames of the example"
                     )
                   ]
  it
    "no text stops the reader, and what it says lies in the text (an exception, a report beside \
    \the file)"
    $ forAll (mutilated =<< elements whole) sound
  it "a missing line is noticed, whichever (a value made up)" $ do
    text <- readText "machines/lki-un.machine"
    let ls = Text.lines text
        needed =
          [ k
            | (k, l) <- zip [0 ..] ls,
              w <- take 1 (Text.words l),
              w
                `elem` [ "tracks",
                         "pitch",
                         "suffix",
                         "leader",
                         "gap",
                         "spare",
                         "pulse",
                         "numbers",
                         "digits",
                         "straight",
                         "measure",
                         "direct",
                         "rule",
                         "rapid",
                         "deceleration",
                         "by",
                         "arcs"
                       ]
          ]
    [l | k <- needed, (front, l : behind) <- [splitAt k ls], Just _ <- [Result.settled (reading (Text.unlines (front <> behind)))]]
      `shouldBe` []
  where
    sound text =
      let outcome = reading text
          places =
            [region | InSource region <- map (Report.place . Error.toReport) (errors outcome)]
       in length (show outcome)
            > 0 .&&. and [a >= 0 && a <= b && b <= Text.length text | Region.Region a b <- places]

-- | A text with some characters gone, doubled or changed.
mutilated :: Text -> Gen Text
mutilated text = do
  n <- choose (1, 5 :: Int)
  foldl (\t _ -> t >>= changed) (pure text) [1 .. n]
  where
    changed t = do
      k <- choose (0, Text.length t)
      c <-
        elements
          [ "",
            "",
            "{",
            "}",
            "\"",
            "=",
            "..",
            "0",
            "-",
            "\n",
            "(",
            "^",
            ":",
            "reconstructed",
            "word",
            "\\"
          ]
      gone <- choose (0, 3)
      pure (Text.take k t <> c <> Text.drop (k + gone) t)

-- | The machine with any braking, any limit, any title, and commands for the words that it has.
furnished :: Machine -> Gen Machine
furnished m = do
  heading <- elements ["", "a \"mill\" \\ with words", "Фрезерный станок"]
  slow <- oneof [pure ByControl, pure SlowFrames, pure (BrakedFrames (Feed (snd (feedRange m))))]
  a <- choose (0.001, 1000)
  contours <- elements [Nothing, Just 1, Just 30]
  measured <- elements [AlongPath, LeadingAxis]
  nearest <- elements [NotAbove, Nearest]
  quick <- elements [Highest, ByCode (fst (slowest m))]
  listed <- traverse (const event) [1 .. 7 :: Int]
  ends <- resize 3 (listOf (fixed =<< elements ("" : places)))
  beside <- elements [Nothing, Just ()]
  let holed = BrakingHole `elem` concatMap (service . form) (wordsOf m)
      finish' = [o NonEmpty.:| [] | Just o <- ends]
      orders' = case (listed, places) of
        ([b, c, d, e, f, g, h], n : _) ->
          CommandWords
            b
            c
            (kept d)
            (kept e)
            (kept f)
            (unstepped g)
            (unstepped h)
            ( CompensationCommands
                (CommandWord (CommandName n) Diameter)
                (CommandWord (CommandName n) Diameter)
                (CommandWord (CommandName n) (Fixed (least n)))
                <$ beside
            )
            finish'
        _ -> noOrders
  pure
    m
      { title = heading,
        braking = Braking a (if holed && measured == AlongPath then slow else ByControl),
        limits = Limits contours,
        feeds = (feeds m) {feedMeasure = measured, rule = nearest, rapidFeed = quick},
        orders = orders'
      }
  where
    places =
      nub
        [ n
          | w <- wordsOf m,
            CommandName n <-
              [o | Command o <- [content w]] <> [o | OrderBit o _ <- service (form w)],
            least n <= most n
        ]
    event = do
      chosen <- sublistOf places
      traverse order' chosen
    order' n = do
      k <- choose (least n, most n)
      v <- elements [Fixed k, Argument, Step (Map.fromList [(k, 63), (least n, 12.5)])]
      pure (CommandWord (CommandName n) v)
    fixed n =
      if n == ""
        then pure Nothing
        else Just . CommandWord (CommandName n) . Fixed <$> choose (least n, most n)
    -- In a word that stands in every frame, 0 is no command.
    least n = if canOrder m (CommandName n) 0 then 0 else 1
    most n = fromMaybe 0 (orderCapacity m (CommandName n))
    kept os = [o | o@(CommandWord _ (Fixed _)) <- os]
    unstepped os = [o | o@(CommandWord _ v) <- os, isPlain v]
    isPlain v = case v of
      Step _ -> False
      Fixed _ -> True
      Argument -> True
      Diameter -> True

-- | The machine as a description may have it: a word with decimals has the pulse of its axis, a
-- feed stands where it changes, a command where it is given.
describable :: Machine -> Machine
describable m =
  m {axes = fmap pulsed (axes m), layout = (layout m) {items = fmap fitting (items (layout m))}}
  where
    pulsed a =
      case nub
        [ decimals (form w)
          | w <- wordsOf m,
            content w `elem` [Along (axis a), Centre (axis a)],
            decimals (form w) > 0
        ] of
        k : _ -> a {step = Mm (10 ^^ negate k)}
        [] -> a
    fitting item = case item of
      AWord w -> AWord w {presence = stands (content w) (presence w)}
      Literal _ -> item
      CheckDigit _ -> item
    stands c p = case (c, p) of
      (FeedWord, WhenNeeded) -> WhenChanged
      (Command _, InMotion) -> WhenNeeded
      _ -> p
