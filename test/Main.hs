-- | Runs all tests, or those that the arguments choose. A choice that fits no test is an error.
--
-- The seed of the random input is printed first, so that a run that is stopped can be repeated.
module Main (main) where

import Control.Monad (when)
import Spec qualified
import System.Environment (getArgs, withArgs)
import System.Exit (die)
import System.IO (BufferMode (LineBuffering), hSetBuffering, stdout)
import System.Timeout (timeout)
import Test.Hspec (around_, expectationFailure, parallel)
import Test.Hspec.Runner
  ( Config (..),
    Summary (..),
    defaultConfig,
    evaluateSummary,
    readConfig,
    runSpec,
  )
import Test.QuickCheck (choose, generate)

main :: IO ()
main = do
  hSetBuffering stdout LineBuffering
  config <- readConfig defaultConfig =<< getArgs
  seed <- maybe (generate (choose (0, 999999999))) pure (configQuickCheckSeed config)
  putStrLn ("seed " <> show seed)
  summary <-
    withArgs [] $
      runSpec
        (parallel (around_ limited Spec.spec))
        config {configQuickCheckSeed = Just seed}
  when (summaryExamples summary == 0) (die "no test fits these words")
  evaluateSummary summary

-- | Longest time for one test, or for one random input of a law, in minutes. A test that computes
-- without end fails with its input, instead of stopping the run.
limitMinutes :: Int
limitMinutes = 10

limited :: IO () -> IO ()
limited test =
  timeout (limitMinutes * 60 * 1000000) test
    >>= maybe (expectationFailure ("takes longer than " <> show limitMinutes <> " minutes")) pure
