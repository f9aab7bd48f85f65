-- | Edits of G-code files, such as somebody makes with a text editor: a line that is lost, a word
-- that is changed, a number, a foreign line. The files are those that the compiler writes, with one
-- space between the words of a line.
module Generate.GcodeEdit
  ( GcodeEdit (..),
    gcodeEdit,
    editKinds,
  )
where

import Data.List (sort)
import Data.Maybe (fromMaybe)
import Numeric (showFFloat)
import Test.QuickCheck
import Text.Read (readMaybe)

-- | An edited file.
data GcodeEdit = GcodeEdit
  { kind :: String,
    -- | what was changed, for a report
    change :: String,
    edited :: [String]
  }
  deriving stock (Eq, Show)

-- | Kinds of edits, each with how often it is made.
editKinds :: [(Int, String, [String] -> Gen GcodeEdit)]
editKinds =
  [ (8, "line left out", lineLost),
    (4, "line doubled", lineDoubled),
    (8, "two lines exchanged", linesExchanged),
    (8, "word left out", wordLost),
    (12, "mode or command replaced", codeReplaced),
    (6, "kind of motion replaced", motionReplaced),
    (14, "number changed a little", numberChanged [0.001, 0.002, 0.005, 0.01, 0.02, 0.025, 0.04]),
    (14, "number changed much", numberChanged [0.1, 0.5, 1, 2, 10, 100]),
    (3, "number replaced", numberReplaced),
    (14, "foreign line inserted", lineInserted),
    (1, "slash before a line", slashed),
    (2, "comment, number or space", harmless)
  ]

-- | A random edit of a file.
gcodeEdit :: [String] -> Gen GcodeEdit
gcodeEdit file = frequency [(n, make file) | (n, _, make) <- editKinds]

-- | An edit of one line, chosen among those that fit. The file is unchanged if none fits.
atLine :: String -> ([String] -> Bool) -> ([String] -> Gen [[String]]) -> [String] -> Gen GcodeEdit
atLine kind fits change file = do
  n <- elements [k | (k, line) <- zip [0 ..] file, isCode line, fits (words line)]
  let (before, rest) = splitAt n file
      old = take 1 rest
  new <- map unwords <$> change (words (concat old))
  pure
    GcodeEdit
      { kind,
        change = "line " <> show (n + 1) <> ": " <> show (concat old) <> " becomes " <> show new,
        edited = before <> new <> drop 1 rest
      }
  where
    isCode line = take 1 line `notElem` ["(", "%"]

-- | Any line, comments and percent signs included.
anyLine :: [String] -> Gen Int
anyLine file = choose (0, length file - 1)

lineLost, lineDoubled, linesExchanged, wordLost, codeReplaced :: [String] -> Gen GcodeEdit
lineLost file = do
  n <- anyLine file
  let (before, rest) = splitAt n file
      what = "without line " <> at n <> concat (take 1 rest)
  pure (GcodeEdit "line left out" what (before <> drop 1 rest))
lineDoubled file = do
  n <- anyLine file
  let (before, rest) = splitAt n file
      what = "twice line " <> at n <> concat (take 1 rest)
  pure (GcodeEdit "line doubled" what (before <> take 1 rest <> rest))
linesExchanged file = do
  n <- choose (0, length file - 2)
  next <- arbitrary
  m <- if next then pure (n + 1) else choose (n + 1, length file - 1)
  let line k = file !! k
      change = "lines " <> at n <> line n <> " and " <> at m <> line m
      new k old
        | k == n = line m
        | k == m = line n
        | otherwise = old
  pure (GcodeEdit "two lines exchanged" change (zipWith new [0 ..] file))
wordLost = atLine "word left out" (const True) $ \ws -> do
  k <- choose (0, length ws - 1)
  pure [take k ws <> drop (k + 1) ws]
codeReplaced = atLine "mode or command replaced" (not . all (null . others)) $ \ws -> do
  k <- elements [i | (i, w) <- zip [0 ..] ws, not (null (others w))]
  new <- elements (others (ws !! k))
  pure [take k ws <> [new] <> drop (k + 1) ws]

at :: Int -> String
at n = show (n + 1) <> ": "

-- | Words that somebody may write for a word by mistake.
others :: String -> [String]
others w = case w of
  "M0" -> ["M1", "M5", "M2"]
  "M1" -> ["M0", "M30"]
  "M2" -> ["M30", "M0"]
  "M3" -> ["M4", "M5", "M6"]
  "M4" -> ["M3", "M5"]
  "M5" -> ["M3", "M4", "M9"]
  "M6" -> ["M5", "M0"]
  "M8" -> ["M7", "M9"]
  "M9" -> ["M8", "M7", "M5"]
  "G43" -> ["G49", "G40"]
  "G49" -> ["G43", "G40"]
  "G17" -> ["G18", "G19"]
  "G54" -> ["G55", "G59"]
  "G55" -> ["G54", "G56"]
  "G90" -> ["G91", "G90.1"]
  "G21" -> ["G20"]
  "G64" -> ["G61", "G61.1"]
  "G61" -> ["G64", "G61.1"]
  "G91.1" -> ["G90.1", "G91"]
  "G94" -> ["G93", "G95"]
  "G53" -> ["G54", "G28", "G49"]
  "G40" -> ["G41", "G42"]
  "G8" -> ["G7"]
  "G80" -> ["G81", "G0"]
  "G4" -> ["G1", "G64"]
  _ -> []

motionReplaced, numberReplaced, lineInserted, slashed, harmless :: [String] -> Gen GcodeEdit
motionReplaced = atLine "kind of motion replaced" (any (`elem` motions)) $ \ws -> do
  new <- elements motions
  pure [[if w `elem` motions then other new w else w | w <- ws]]
  where
    motions = ["G0", "G1", "G2", "G3"]
    other new w
      | new /= w = new
      | w == "G0" = "G1"
      | otherwise = "G0"
numberReplaced = numberEdit "number replaced" (const (elements [-1, 0, 1, 2, 9, 99, 9999]))
slashed = atLine "slash before a line" (const True) (\ws -> pure [["/" <> unwords ws]])
harmless = atLine "comment, number or space" (const True) $ \ws ->
  elements
    [ [ws <> ["(checked)"]],
      ["N100" : ws],
      [["(by hand)"], ws],
      ["" : ws],
      [[], ws],
      [ws <> ["; checked"]]
    ]
lineInserted file = do
  n <- choose (1, length file - 1)
  new <- elements foreignLines
  pure
    ( GcodeEdit
        "foreign line inserted"
        ("before line " <> show (n + 1) <> ": " <> new)
        (take n file <> [new] <> drop n file)
    )

-- | Lines that the control knows, at a place where they may do harm.
foreignLines :: [String]
foreignLines =
  ["G20", "G21", "G91", "G90", "G18", "G17", "G7", "G8", "G93", "G95", "G94", "G90.1", "G91.1"]
    <> ["G54", "G55", "G49", "G43", "G43 H9", "G43 H1", "G43 H2", "G40", "G41 D1", "G80", "G92 X0"]
    <> ["G64", "G64 P0.01", "G64 P0.005 Q0", "G64 P1 Q0", "G64 P0.05 Q-0.045", "G61", "G61.1"]
    <> ["M0", "M1", "M2", "M30", "M3", "M4", "M5", "M6", "M7", "M8", "M9", "M48", "T9", "T2 M6"]
    <> ["S100", "S9000", "S0", "F10", "F1000", "G4 P1", "G4 P0.01", "G28", "G10 L2 P1 X5"]
    <> ["G0 X15 Y10", "G0 X15.5", "G0 Z-5", "G0 Z50", "G1 X15 Y10 F500", "G1 Z-2 F50", "Z-1"]
    <> ["G53 G0 Z0", "G53 G0 Z-50", "G53 G0 X0", "G53 G1 Z-50 F100", "G0", "G1", "G53", "X15"]
    <> ["G4 P1 X15", "G1 I2", "#1=5", "O100 sub", "(a comment)"]

-- | Changes a number by one of these amounts.
numberChanged :: [Double] -> [String] -> Gen GcodeEdit
numberChanged amounts = numberEdit kind $ \old -> do
  amount <- elements amounts
  sign <- elements [-1, 1]
  pure (old + sign * amount)
  where
    kind = if all (< 0.1) amounts then "number changed a little" else "number changed much"

-- | Changes the number of a word to one that depends on the old one.
numberEdit :: String -> (Double -> Gen Double) -> [String] -> Gen GcodeEdit
numberEdit kind changed = atLine kind (any isNumbered) $ \ws -> do
  k <- elements [i | (i, w) <- zip [0 ..] ws, isNumbered w]
  let word = ws !! k
  new <- changed (numberOf word)
  pure [take k ws <> [take 1 word <> shown new] <> drop (k + 1) ws]
  where
    isNumbered w = take 1 w `elem` map pure (sort "FSTHDIJXYZPQ")
    numberOf w = fromMaybe 0 (readMaybe (drop 1 w))
    shown v
      | v == fromIntegral (round v :: Int) = show (round v :: Int)
      | otherwise = showFFloat (Just 3) v ""
