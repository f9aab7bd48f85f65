{-# OPTIONS_GHC -fno-full-laziness #-}

-- | @kernel SMALL FILE D RUNS BATCHES@: offsets a closed counter-clockwise contour by D mm,
-- positive outwards, RUNS times in each batch. Prints for every batch the nanoseconds of processor
-- time of one run, then the result of the last run and the rise of peak memory in the first run.
-- Before that it offsets the contour of SMALL a hundred times, so that the code and the allocation
-- area are in memory. The peers in bench/peers have the same arguments and output.
module Main (main) where

import Base.Quantity (Mm (..))
import ContourFile qualified
import Control.Exception (evaluate)
import Control.Monad (forM_, replicateM, replicateM_, when)
import Data.Primitive.PrimArray qualified as PrimArray
import Equidistant qualified
import Geometry.FlatPolyarc (FlatPolyarc)
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Offset.Kernel (ReachableRegion)
import System.CPUTime (getCPUTime)
import System.Environment (getArgs)
import System.Exit (die)
import System.Mem (performGC)
import Text.Read (readMaybe)

main :: IO ()
main = do
  arguments <- getArgs
  case arguments of
    [small, file, d, r, b]
      | Just distance <- readMaybe d,
        Just runs <- readMaybe r,
        Just batches <- readMaybe b ->
        measure small file distance runs batches
    _ -> die "kernel SMALL FILE D RUNS BATCHES"

-- | Measures and prints.
measure :: FilePath -> FilePath -> Double -> Int -> Int -> IO ()
measure small file distance runs batches = do
  begin <- ContourFile.read small
  replicateM_ 100 (once distance begin)
  source <- ContourFile.read file
  performGC
  writeFile "/proc/self/clear_refs" "5"
  before <- peak
  (first, reach) <- timed 1 distance source
  after <- peak
  when (batches == 0) $ putStrLn ("run " <> show first)
  times <- replicateM batches (fst <$> timed runs distance source)
  let result = Equidistant.outlines reach
  forM_ times $ \t -> putStrLn ("run " <> show t)
  putStrLn ("area " <> show (sum (map FlatPolyarc.area result)))
  putStrLn ("length " <> show (sum [l | o <- result, let Mm l = FlatPolyarc.length o]))
  putStrLn ("loops " <> show (length result) <> "\nopen 0")
  putStrLn ("vertices " <> show (sum (map (PrimArray.sizeofPrimArray . FlatPolyarc.xs) result)))
  putStrLn ("memory " <> show (1024 * (after - before)))

-- | The mean nanoseconds of processor time of @runs@ runs, and the result of the last one. Garbage
-- collection during the runs counts; earlier garbage is collected before the clock starts.
timed :: Int -> Double -> FlatPolyarc -> IO (Integer, ReachableRegion)
timed runs distance source = do
  performGC
  begin <- getCPUTime
  result <- go runs
  end <- getCPUTime
  pure ((end - begin) `div` (1000 * fromIntegral runs), result)
  where
    go left = do
      result <- once distance source
      if left <= 1 then pure result else go (left - 1)

-- | One run.
once :: Double -> FlatPolyarc -> IO ReachableRegion
once distance source = do
  found <- evaluate (Equidistant.offset distance source)
  either (\why -> die ("kernel: " <> why)) evaluate found
{-# NOINLINE once #-}

-- | The peak memory of the process, in kilobytes.
peak :: IO Int
peak = do
  status <- readFile "/proc/self/status"
  -- Evaluated now: the file is read lazily.
  evaluate
    ( sum
        [ k
          | line <- lines status,
            "VmHWM:" : number : _ <- [words line],
            Just k <- [readMaybe number]
        ]
    )
