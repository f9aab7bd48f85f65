-- | The whole compile: its stages and their growth, and @partc compile@ beside LinuxCNC's interpreter reading the result.
module Whole
  ( Tools (..),
    staged,
    besideInterpreter,
  )
where

import Base.Decimal qualified as Decimal
import Control.Monad (foldM, forM, forM_)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.IO qualified as Text
import Peer qualified
import Programs (Kind (..), Written (..))
import Programs qualified
import System.Directory (createDirectoryIfMissing)
import System.FilePath ((</>))
import System.IO (hFlush, stdout)
import Table qualified
import Text.Read (readMaybe)

-- | The programs that are run: the one that times stages, partc, the one that tells what a command costs, the interpreter if it is there.
data Tools = Tools {timer :: FilePath, partc :: FilePath, cost :: [String], interpreter :: Maybe FilePath}

-- Stages ------------------------------------------------------------------------------------------

-- | Milliseconds of each stage, in order, and the peak of memory in kilobytes.
data Staged = Staged {stages :: [(Text, Double)], peak :: Double}

-- | Every kind of program on two machines, by tens up to so many elements, if there can be so many. A size is left out when the one before it lets expect more than
-- the seconds that are allowed.
staged :: Tools -> Int -> Double -> IO Text
staged tools most allowed =
  Table.table (["program", "machine", "size"] <> map fst names <> ["sum", "µs per element", "MB"]) . concat
    <$> forM [(k, m) | k <- [minBound ..], m <- ["lkp-01f", "iso6983"]] (ofKind tools most allowed)
  where
    names = [(n, ()) | n <- ["parse", "check", "part", "path", "frames", "tape", "verify"]] :: [(Text, ())]

ofKind :: Tools -> Int -> Double -> (Kind, Text) -> IO [Table.Row]
ofKind tools most allowed (kind, machine) = reverse . fst <$> foldM size ([], Nothing) (takeWhile (<= min most (Programs.most kind)) [100, 1000, 10000, 100000, 1000000])
  where
    size (rows, before) n
      | Just (_, Nothing) <- before = pure (rows, before)
      | expected before > 1000 * allowed = pure (row n (replicate 10 "–") : rows, Just (n, Nothing))
      | otherwise = do
        found <- Peer.repeated (if expected before > 6000 then 1 else repeats n) (Peer.command (round (3 * allowed)) [timer tools, show kind, show n, Text.unpack machine])
        let outcome = found >>= middles
        Text.putStrLn (Programs.name kind <> " on " <> machine <> ", " <> Decimal.whole n <> ": " <> either id (\s -> Table.number (total s) <> " ms") outcome)
        hFlush stdout
        pure $ case outcome of
          Left why -> (row n [Text.take 80 why] : rows, Just (n, Nothing))
          Right s -> ([growth b s | Just (m, Just old) <- [before], b <- [(m, n, old)]] <> [row n (map (Table.number . snd) (stages s) <> [Table.number (total s), Table.number (1000 * total s / fromIntegral n), Table.number (peak s / 1024)])] <> rows, Just (n, Just s))
    row n cells = [Programs.name kind, machine, Decimal.whole n] <> cells
    growth (m, n, old) s = ["", "", "growth"] <> zipWith (\(_, a) (_, b) -> exponentOf (m, a) (n, b)) (stages old) (stages s) <> [exponentOf (m, total old) (n, total s), "", ""]
    exponentOf a@(_, t) b@(_, t') = if t < 0.3 || t' < 0.3 then "" else Decimal.fixed 2 (Table.exponent a b)
    -- A program of ten times as many elements takes somewhat more than ten times as long.
    expected before = case before of
      Just (_, Just s) -> 15 * total s
      _ -> 0
    repeats n
      | n <= 1000 = 5
      | n <= 100000 = 3
      | otherwise = 1

total :: Staged -> Double
total = sum . map snd . stages

-- | The medians of several runs.
middles :: [Text] -> Either Text Staged
middles outputs = case traverse parsed outputs of
  Just runs@(first : _) -> Right Staged {stages = [(name, Peer.middle [t | r <- runs, (n, t) <- stages r, n == name]) | (name, _) <- stages first], peak = Peer.middle (map peak runs)}
  _ -> Left "what was printed is not understood"
  where
    parsed out = do
      numbers <- traverse (pair . Text.words) (Text.lines out)
      pure Staged {stages = filter ((/= "memory") . fst) numbers, peak = sum [v | ("memory", v) <- numbers]}
    pair line = case line of
      [name, value] -> (name,) <$> readMaybe (Text.unpack value)
      _ -> Nothing

-- The interpreter ---------------------------------------------------------------------------------

-- | @partc compile -t iso6983@, proof included, beside @rs274 -g@ on what it wrote, in turns.
besideInterpreter :: Tools -> FilePath -> [(Kind, Int)] -> Double -> IO Text
besideInterpreter tools folder programs allowed = do
  createDirectoryIfMissing True folder
  Table.table ["program", "size", "lines written", "partc, s", "rs274, s", "ratio", "partc, µs per element", "rs274, µs per line", "MB"] <$> (reverse . snd <$> foldM further ([], []) programs)
  where
    -- What takes too long takes longer still when it is larger.
    further (failed, rows) (kind, n)
      | kind `elem` failed = pure (failed, ([Programs.name kind, Decimal.whole n] <> replicate 7 "–") : rows)
      | otherwise = do
        (fails, row) <- beside (kind, n)
        pure ([kind | fails] <> failed, row : rows)
    -- A short one is asked more often, a long one not again.
    turns done action = do
      turn <- action
      case fst turn of
        Right (s, _) | done < (if s < 0.6 then 15 else if s < 4 then 5 else 1) -> (turn :) <$> turns (done + 1) action
        _ -> pure [turn]
    beside (kind, n) = do
      let Written {text, files} = Programs.written kind n
          (source, result) = (folder </> "program.part", folder </> "program.ngc")
      forM_ ((source, text) : [(folder </> name, t) | (name, t) <- files]) (uncurry Text.writeFile)
      rounds <- turns (1 :: Int) $ do
        compiled <- timed [partc tools, "compile", source, "-t", "iso6983", "-o", result]
        judged <- case (compiled, interpreter tools) of
          (Right _, Just rs274) -> timed [rs274, "-g", result]
          (Left _, _) -> pure (Left "nothing to read")
          (_, Nothing) -> pure (Left "rs274 is not installed")
        pure (compiled, judged)
      count <- either (const (pure 0)) (const (length . Text.lines <$> Text.readFile result)) (traverse fst rounds)
      let ours = traverse fst rounds
          theirs = traverse snd rounds
          cells = either (const "–") Table.number
      Text.putStrLn (Programs.name kind <> ", " <> Decimal.whole n <> ": partc " <> either id (\rs -> Table.number (seconds rs) <> " s") ours <> ", rs274 " <> either id (\rs -> Table.number (seconds rs) <> " s") theirs)
      hFlush stdout
      let fails = either (const True) (const False) ours
          row =
            [ Programs.name kind,
              Decimal.whole n,
              if count == 0 then "–" else Decimal.whole count,
              either (Text.take 80) (Table.number . seconds) ours,
              cells (seconds <$> theirs),
              cells ((\a b -> seconds a / seconds b) <$> ours <*> theirs),
              cells ((\rs -> 1e6 * seconds rs / fromIntegral n) <$> ours),
              cells ((\rs -> 1e6 * seconds rs / fromIntegral (max 1 count)) <$> theirs),
              cells ((\rs -> maximum (0 : map snd rs) / 1024) <$> ours)
            ]
      pure (fails, row)
    seconds = Peer.middle . map fst
    timed words' = (>>= costs) <$> Peer.command (round allowed) (cost tools <> words')
    costs out = case map (readMaybe . Text.unpack) (Text.words out) of
      [Just s, Just k] -> Right (s :: Double, k :: Double)
      _ -> Left ("not understood: " <> Text.take 80 out)
