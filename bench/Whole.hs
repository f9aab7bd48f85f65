-- | The whole compiler: its stages and their growth, and @partc compile@ compared with LinuxCNC's
-- interpreter on the result.
module Whole
  ( Tools (..),
    staged,
    doubled,
    stocked,
    lettered,
    besideBefore,
    besideInterpreter,
  )
where

import Base.Decimal qualified as Decimal
import Control.Monad (foldM, forM, forM_, when)
import Data.List (sort, transpose)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.IO qualified as Text
import Peer qualified
import Programs (Kind (..), Written (..))
import Programs qualified
import System.Directory (copyFile, createDirectoryIfMissing, doesFileExist)
import System.FilePath ((</>))
import System.IO (hFlush, stdout)
import Table qualified
import Text.Read (readMaybe)

-- | The commands that are run: the program that times the stages, partc, the program that times a
-- command, and the interpreter if it is installed.
data Tools = Tools
  { timer :: FilePath,
    partc :: FilePath,
    cost :: [String],
    interpreter :: Maybe FilePath
  }

-- Stages ------------------------------------------------------------------------------------------

-- | The milliseconds of each stage, in order, and the peak memory in kilobytes.
data Staged = Staged {stages :: [(Text, Double)], peak :: Double}

-- | Every kind of program on two machines, with powers of ten up to @most@ elements. A size is left
-- out if the one before it predicts more than @allowed@ seconds.
staged :: Tools -> Int -> Double -> IO Text
staged tools most allowed =
  Table.table (["program", "machine", "size"] <> names <> ["sum", "µs per element", "MB"]) . concat
    <$> forM
      [(k, m) | k <- [minBound ..], Programs.most k >= 100, m <- ["lkp-01f", "iso6983"]]
      (ofKind tools most allowed)
  where
    names = ["parse", "check", "part", "path", "frames", "tape", "verify"]

-- | A size and its runs, or the reason why there are none.
type Size = (Int, Either Text [Staged])

-- | The rows of one kind of program on one machine. All sizes are run in turn, so that a temporary
-- slow-down affects all of them: growth compares measurements that are close in time.
ofKind :: Tools -> Int -> Double -> (Kind, Text) -> IO [Table.Row]
ofKind tools most allowed (kind, machine) = do
  once <- foldM first [] (takeWhile (<= min most largest) [100, 1000, 10000, 100000, 1000000])
  sizes <- foldM (\sizes turn -> traverse (again turn) sizes) (reverse once) [2 .. 5]
  let medians = [(n, middles <$> runs) | (n, runs) <- sizes]
      thousand = [(n, s) | (n, Right s) <- medians, n == 1000]
  forM_ medians $ \(n, s) ->
    Text.putStrLn
      ( Text.intercalate ", " [Programs.name kind <> " on " <> machine, Decimal.whole n]
          <> ": "
          <> either id (\s' -> Table.number (total s') <> " ms") s
      )
  hFlush stdout
  pure (concatMap (\(n, s) -> sizeRows (start n) thousand n s) medians)
  where
    start n = [Programs.name kind, machine, Decimal.whole n]
    -- A million rows only on one machine.
    largest = if machine == "iso6983" then Programs.most kind else min 100000 (Programs.most kind)
    first before n =
      (: before) . (n,)
        <$> ( if expectedTime before > 1000 * allowed
                then pure (Left "–")
                else fmap (: []) <$> run n
            )
    again turn (n, runs) = case runs of
      Right done | turn <= turns n (middles done) -> (\new -> (n, (: done) <$> new)) <$> run n
      _ -> pure (n, runs)
    run :: Int -> IO (Either Text Staged)
    run n =
      (>>= parsed)
        <$> Peer.command (round (3 * allowed)) [timer tools, show kind, show n, Text.unpack machine]

-- | The expected milliseconds of the next size: ten times as many elements take somewhat more than
-- ten times as long.
expectedTime :: [Size] -> Double
expectedTime before = case before of
  (_, Right runs) : _ -> 15 * total (middles runs)
  (_, Left _) : _ -> 1 / 0
  [] -> 0

-- | The number of runs of a size: 5, 3 or 1, but fewer if they would take more than about twelve
-- seconds.
turns :: Int -> Staged -> Int
turns n s = min (if n <= 1000 then 5 else if n <= 100000 then 3 else 1) (ceiling (12000 / total s))

-- | The rows of a size, made from the first cells, the medians of 1,000 elements (for the growth),
-- the size and its medians.
sizeRows :: [Text] -> [(Int, Staged)] -> Int -> Either Text Staged -> [Table.Row]
sizeRows start thousand n outcome = case outcome of
  Left why -> [start <> (if why == "–" then replicate 10 why else [Text.take 80 why])]
  Right s ->
    ( start
        <> map (Table.number . snd) (stages s)
        <> [ Table.number (total s),
             Table.number (1000 * total s / fromIntegral n),
             Table.number (peak s / 1024)
           ]
    ) :
      [ ["", "", "growth"]
          <> zipWith (\(_, a) (_, b) -> growth (m, a) (n, b)) (stages old) (stages s)
          <> [growth (m, total old) (n, total s), "", ""]
        | n > 1000,
          (m, old) <- thousand
      ]
  where
    growth a@(_, t) b@(_, t') =
      if t < 0.3 || t' < 0.3 then "" else Decimal.fixed 2 (Table.exponent a b)

total :: Staged -> Double
total = sum . map snd . stages

-- | The medians of several runs, all of the same stages.
middles :: [Staged] -> Staged
middles runs =
  Staged
    { stages =
        [ (name, Peer.middle [t | r <- runs, (n, t) <- stages r, n == name])
          | (name, _) <- concatMap stages (take 1 runs)
        ],
      peak = Peer.middle (map peak runs)
    }

parsed :: Text -> Either Text Staged
parsed out = do
  numbers <-
    maybe
      (Left "what was printed is not understood")
      Right
      (traverse (pair . Text.words) (Text.lines out))
  pure
    Staged
      { stages = filter ((/= "memory") . fst) numbers,
        peak = sum [v | ("memory", v) <- numbers]
      }
  where
    pair line = case line of
      [name, value] -> (name,) <$> readMaybe (Text.unpack value)
      _ -> Nothing

-- | The toolpath stage of 16, 32 and 64 statements that mill spline contours: the medians of five
-- runs, the ratio to the time of half as many statements, and the time of all stages.
doubled :: Tools -> IO Text
doubled tools =
  Table.table ["program", "statements", "path", "of half as many", "sum"] . concat
    <$> mapM rowsOf [OneContour, Nested]
  where
    rowsOf kind = do
      turns' <- mapM (const (mapM (run kind) [16, 32, 64])) [1 .. 5 :: Int]
      let medians = fmap middles . sequence <$> transpose turns'
          halves = Left "" : medians
      pure (zipWith3 (row kind) [16, 32, 64] halves medians)
    row :: Kind -> Int -> Either Text Staged -> Either Text Staged -> Table.Row
    row kind n half outcome =
      [Programs.name kind, Decimal.whole n] <> case outcome of
        Left why -> [Text.take 80 why, "", ""]
        Right s ->
          [ Table.number (path s),
            either (const "") (\h -> Decimal.fixed 2 (path s / path h)) half,
            Table.number (total s)
          ]
    path s = sum [t | ("path", t) <- stages s]
    run :: Kind -> Int -> IO (Either Text Staged)
    run kind n =
      (>>= parsed) <$> Peer.command 300 [timer tools, show kind, show n, "lkp-01f"]

-- Stock -------------------------------------------------------------------------------------------

-- | Plates with stock and clamps and the same without, and unions of circles: the seconds that
-- @compile@, @verify@ and @report@ take, and the ratio of the first one to that of half the size.
stocked :: Tools -> FilePath -> IO Text
stocked tools folder = do
  createDirectoryIfMissing True folder
  Table.table ["program", "size", "compile, s", "of half as many", "verify, s", "report, s"]
    . concat
    <$> mapM
      rowsOf
      [(Plate, [125, 250, 500]), (PlainPlate, [125, 250, 500]), (Circles, [256, 529, 1024])]
  where
    rowsOf (kind, sizes) = do
      measured <- mapM (measure kind) sizes
      pure (zipWith3 (row kind) sizes (Left "" : map compiling measured) measured)
    compiling (c, _, _) = c
    row kind n half (compiled, verified, reported) =
      [ Programs.name kind,
        Decimal.whole n,
        cell compiled,
        either (const "") (Decimal.fixed 2) ((/) <$> compiled <*> half),
        cell verified,
        cell reported
      ]
    cell = either (const "–") Table.number
    measure kind n = do
      Text.writeFile source (Programs.text (Programs.written kind n))
      compiled <- timed ["compile", source, "-o", result]
      verified <- timed ["verify", source, result]
      reported <- timed ["report", source]
      pure (compiled, verified, reported)
    (source, result) = (folder </> "stock.part", folder </> "stock.ngc")
    -- The median of five runs.
    timed :: [String] -> IO (Either Text Double)
    timed arguments =
      fmap (Peer.middle . map fst) . sequence
        <$> mapM (const (costOf tools 60 (partc tools : arguments))) [1 .. 5 :: Int]

-- Letters -----------------------------------------------------------------------------------------

-- | Name plates with engraved and with V-carved letters: the seconds that @compile@ takes, and the
-- ratio to that of half the size. The V-carved letters are those of a font.
lettered :: Tools -> FilePath -> FilePath -> IO Text
lettered tools folder font = do
  createDirectoryIfMissing True folder
  hasFont <- doesFileExist font
  when hasFont (copyFile font (folder </> "letters.ttf"))
  Table.table ["program", "letters", "compile, s", "of half as many"] . concat
    <$> mapM rowsOf ([Engraved] <> [Carved | hasFont])
  where
    sizes = [500, 1000, 2000]
    rowsOf kind = do
      measured <- mapM (measure kind) sizes
      pure (zipWith3 (row kind) sizes (Left "" : measured) measured)
    row :: Kind -> Int -> Either Text Double -> Either Text Double -> Table.Row
    row kind n half compiled =
      [ Programs.name kind,
        Decimal.whole n,
        either (const "–") Table.number compiled,
        either (const "") (Decimal.fixed 2) ((/) <$> compiled <*> half)
      ]
    measure kind n = do
      Text.writeFile (folder </> "plate.part") (Programs.text (Programs.written kind n))
      fmap (Peer.middle . map fst) . sequence
        <$> mapM (const (costOf tools 120 command)) [1 .. 5 :: Int]
    command = [partc tools, "compile", folder </> "plate.part", "-o", folder </> "plate.ngc"]

-- The state before -------------------------------------------------------------------------------

-- | The stages of this build in ratio to those of a build of an earlier state. In each of eleven
-- turns the earlier one runs, then this one, then the earlier one again.
--
-- Each program has two rows of medians: this build in ratio to the earlier one, and the earlier one
-- in ratio to itself with half the interquartile range of these ratios. A ratio that exceeds 1.03
-- by more than this spread is bold.
besideBefore :: Tools -> FilePath -> Int -> IO Text
besideBefore tools before most =
  Table.table (["program", "machine", "size", "build"] <> ratioNames) . concat
    <$> sequence
      [ rowsOf kind machine n
        | kind <- [minBound ..],
          machine <- ["lkp-01f", "iso6983"],
          n <- takeWhile (<= min most (Programs.most kind)) [1000, 10000]
      ]
  where
    ratioNames = ["parse", "check", "part", "path", "frames", "tape", "verify", "sum", "memory"]
    rowsOf :: Kind -> Text -> Int -> IO [Table.Row]
    rowsOf kind machine n = do
      outcomes <- mapM (const (turn kind machine n)) [1 .. 11 :: Int]
      let rows = case sequence outcomes of
            Left why -> [["", Text.take 80 why]]
            Right turns' -> ratioRows turns'
          begin = [Programs.name kind, machine, Decimal.whole n]
          table = map (begin <>) rows
      mapM_ (Text.putStrLn . Text.unwords) table
      hFlush stdout
      pure table
    turn kind machine n = do
      a <- run before
      b <- run (timer tools)
      c <- run before
      pure ((,,) <$> a <*> b <*> c)
      where
        run program =
          (>>= parsed)
            <$> Peer.command 300 [program, show kind, show n, Text.unpack machine]

-- | The two rows of a program: the ratios of this build, and those of the earlier build to itself.
-- Each turn holds the earlier build, this one, and the earlier one again.
ratioRows :: [(Staged, Staged, Staged)] -> [Table.Row]
ratioRows turns' = [" now" : map fst cells, "before" : map snd cells]
  where
    cells = map cell (transpose [(\(a, b, c) -> zip3 a b c) (figures t) | t <- turns'])
    figures (a, b, c) = (numbers a, numbers b, numbers c)
    numbers s = map snd (stages s) <> [total s, peak s]
    cell values = (if now > 1.03 + spread then "**" <> shown now <> "**" else shown now, itself)
      where
        now = ratio [(b, (a + c) / 2) | (a, b, c) <- values]
        own = sort [c / max 1e-9 a | (a, _, c) <- values]
        spread = (quartile 3 own - quartile 1 own) / 2
        itself = shown (Peer.middle own) <> " ± " <> shown spread
    ratio pairs = Peer.middle [b / max 1e-9 a | (b, a) <- pairs]
    quartile k values = sum (take 1 (drop (k * length values `div` 4) values))
    shown = Decimal.fixed 2

-- The interpreter ---------------------------------------------------------------------------------

-- | @partc compile -t iso6983@, with verification, and @rs274 -g@ on its output, in turn.
besideInterpreter :: Tools -> FilePath -> [(Kind, Int)] -> Double -> IO Text
besideInterpreter tools folder programs allowed = do
  createDirectoryIfMissing True folder
  Table.table
    [ "program",
      "size",
      "lines written",
      "partc, s",
      "rs274, s",
      "ratio",
      "partc, µs per element",
      "rs274, µs per line",
      "MB"
    ]
    <$> (reverse . snd <$> foldM further ([], []) programs)
  where
    -- A larger program of a kind that took too long is not run.
    further (failed, rows) (kind, n)
      | kind `elem` failed =
        pure (failed, ([Programs.name kind, Decimal.whole n] <> replicate 7 "–") : rows)
      | otherwise = do
        (isFailed, row) <- compiledAndInterpreted tools folder allowed kind n
        pure ([kind | isFailed] <> failed, row : rows)

-- | Seconds and peak kilobytes of a command, or the reason of its failure.
type Cost = Either Text (Double, Double)

-- | The cost of a command that may take this many seconds.
costOf :: Tools -> Int -> [String] -> IO Cost
costOf tools allowed arguments = (>>= costs) <$> Peer.command allowed (cost tools <> arguments)
  where
    costs out = case map (readMaybe . Text.unpack) (Text.words out) of
      [Just s, Just k] -> Right (s, k)
      _ -> Left ("not understood: " <> Text.take 80 out)

-- | Runs partc and the interpreter on one program. The result is True if partc failed, with the row
-- of the table.
compiledAndInterpreted :: Tools -> FilePath -> Double -> Kind -> Int -> IO (Bool, Table.Row)
compiledAndInterpreted tools folder allowed kind n = do
  forM_ ((source, text) : [(folder </> name, t) | (name, t) <- files]) (uncurry Text.writeFile)
  rounds <- turnsOf (1 :: Int)
  let ours = traverse fst rounds
      theirs = traverse snd rounds
  count <-
    either (const (pure 0)) (const (length . Text.lines <$> Text.readFile result)) ours
  Text.putStrLn
    ( Text.intercalate ", " [Programs.name kind, Decimal.whole n]
        <> (": partc " <> shownSeconds ours <> ", rs274 " <> shownSeconds theirs)
    )
  hFlush stdout
  pure (either (const True) (const False) ours, costRow kind n count ours theirs)
  where
    Written {text, files} = Programs.written kind n
    (source, result) = (folder </> "program.part", folder </> "program.ngc")
    -- At most about four seconds for ours.
    turnsOf done = do
      turn <- bothOnce
      case fst turn of
        Right (s, _) | done < min 7 (ceiling (4 / s)) -> (turn :) <$> turnsOf (done + 1)
        _ -> pure [turn]
    bothOnce = do
      compiled <- timed [partc tools, "compile", source, "-t", "iso6983", "-o", result]
      judged <- case (compiled, interpreter tools) of
        (Right _, Just rs274) -> timed [rs274, "-g", result]
        (Left _, _) -> pure (Left "nothing to read")
        (_, Nothing) -> pure (Left "rs274 is not installed")
      pure (compiled, judged)
    timed = costOf tools (round allowed)
    shownSeconds = either id (\runs -> Table.number (medianSeconds runs) <> " s")

medianSeconds :: [(Double, Double)] -> Double
medianSeconds = Peer.middle . map fst

costRow ::
  Kind ->
  Int ->
  Int ->
  Either Text [(Double, Double)] ->
  Either Text [(Double, Double)] ->
  Table.Row
costRow kind n count ours theirs =
  [ Programs.name kind,
    Decimal.whole n,
    if count == 0 then "–" else Decimal.whole count,
    either (Text.take 80) (Table.number . medianSeconds) ours,
    cell (medianSeconds <$> theirs),
    cell ((\a b -> medianSeconds a / medianSeconds b) <$> ours <*> theirs),
    cell ((\runs -> 1e6 * medianSeconds runs / fromIntegral n) <$> ours),
    cell ((\runs -> 1e6 * medianSeconds runs / fromIntegral (max 1 count)) <$> theirs),
    cell ((\runs -> maximum (0 : map snd runs) / 1024) <$> ours)
  ]
  where
    cell = either (const "–") Table.number
