-- | Runs all tests, or those that the arguments choose. A choice that fits no test is an error.
module Main (main) where

import Control.Monad (when)
import Spec qualified
import System.Exit (die)
import Test.Hspec (parallel)
import Test.Hspec.Runner (Summary (..), defaultConfig, evaluateSummary, hspecWithResult)

main :: IO ()
main = do
  summary <- hspecWithResult defaultConfig (parallel Spec.spec)
  when (summaryExamples summary == 0) (die "no test fits these words")
  evaluateSummary summary
