-- | Programs that offset a contour, run one after the other.
module Peer
  ( Peer (..),
    Outcome (..),
    interleaved,
    command,
    middle,
  )
where

import Control.Monad (foldM)
import Data.Functor ((<&>))
import Data.List (sort)
import Data.Text (Text)
import Data.Text qualified as Text
import System.Exit (ExitCode (..))
import System.Process (readProcessWithExitCode)
import Text.Read (readMaybe)

-- | A program that offsets contours: its name, and its command line without the last arguments,
-- which are two files, the distance, and the numbers of runs and batches.
data Peer = Peer {title :: Text, start :: [String]}

-- | The result of a program. @times@ are the nanoseconds of one run, for each batch. @area@ (mm²)
-- and @long@, the length (mm), are those of the offset; @loops@, @open@ and @vertices@ count its
-- closed loops, open polyarcs and vertices. @memory@ is in bytes.
data Outcome = Outcome
  { times :: [Double],
    area :: Double,
    long :: Double,
    loops :: Int,
    open :: Int,
    vertices :: Int,
    memory :: Double
  }
  deriving stock (Eq, Show)

-- | Runs every program once in each round, each time as a new process, so that none profits from an
-- earlier one. A program that fails is not run again. The first file is the small contour for
-- warming up, the second the measured one.
interleaved ::
  Int ->
  FilePath ->
  FilePath ->
  Double ->
  Int ->
  Int ->
  [Peer] ->
  IO [Either Text Outcome]
interleaved rounds small file distance runs batches peers =
  foldM once (map (const (Right Nothing)) peers) [1 .. rounds]
    <&> map (>>= maybe (Left "not run") Right)
  where
    once found _ = traverse further (zip peers found)
    further (peer, before) = case before of
      Left why -> pure (Left why)
      Right earlier -> do
        new <- offset peer small file distance runs batches
        pure (fmap (\o -> Just o {times = maybe [] times earlier <> times o}) new)

-- | Runs a program once.
offset :: Peer -> FilePath -> FilePath -> Double -> Int -> Int -> IO (Either Text Outcome)
offset peer small file distance runs batches =
  (>>= read') <$> command 300 (start peer <> [small, file, show distance, show runs, show batches])
  where
    read' out =
      let found key =
            [ v
              | line <- Text.lines out,
                [k, w] <- [Text.words line],
                k == key,
                Just v <- [readMaybe (Text.unpack w)]
            ]
       in case ( found "run",
                 found "area",
                 found "length",
                 map found ["loops", "open", "vertices"],
                 found "memory"
               ) of
            (ts@(_ : _), [area], [long], [[loops], [open], [vertices]], [memory]) ->
              Right Outcome {times = ts, area, long, loops, open, vertices, memory}
            _ -> Left ("what it printed is not understood: " <> Text.take 200 out)

-- | The output of a command; or the reason if it fails or takes longer than @seconds@. The reason
-- of a failure is the first line that the command prints; further lines only give positions.
command :: Int -> [String] -> IO (Either Text Text)
command seconds wanted = do
  (status, out, err) <- readProcessWithExitCode "timeout" (show seconds : wanted) ""
  pure $ case status of
    ExitSuccess -> Right (Text.pack out)
    ExitFailure 124 -> Left ("longer than " <> Text.pack (show seconds) <> " s")
    ExitFailure n ->
      Left
        ( Text.unwords (concatMap Text.words (take 1 (Text.lines (Text.pack (err <> out)))))
            <> " (status "
            <> Text.pack (show n)
            <> ")"
        )

-- | The median.
middle :: [Double] -> Double
middle values = case drop ((length values - 1) `div` 2) (sort values) of
  low : high : _ | even (length values) -> (low + high) / 2
  m : _ -> m
  [] -> 0
