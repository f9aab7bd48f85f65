-- | Tapes of random program texts: whatever passes the compiler's passes is proven.
module Verify.OwnTapeSpec (spec) where

import Base.Result qualified as Result
import CaseCount (askedCount)
import Compile qualified
import Data.Maybe (fromMaybe, isNothing)
import Data.Text qualified as Text
import FixedSeed (fixed)
import Generate.MachinedText qualified as MachinedText
import Machines qualified
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report qualified as Report
import Test.Hspec
import Test.Hspec.QuickCheck (modifyArgs)
import Test.QuickCheck
import Verify.Proof qualified as Proof

-- | PARTC_PROGRAMS sets another number of programs. They are then random; without it, the programs
-- are always the same.
spec :: Spec
spec = do
  asked <- runIO (askedCount "PARTC_PROGRAMS")
  let programs = fromMaybe 300 asked
  modifyArgs (if isNothing asked then fixed else id)
    . it
      "a program that the compiler's passes accept is not refused by its own proof"
    $ withMaxSuccess programs $
      forAllBlind (elements Machines.known) $ \machine ->
        forAllBlind (MachinedText.program machine) $ \text ->
          let result =
                Compile.compile
                  (Machines.jobFor machine [])
                  (LoadedProgram.fromText "p.part" text)
           in counterexample (Text.unpack text) $
                label (outcome result) $
                  maybe [] (concatMap findings) (Result.output result) === []
  where
    outcome result = case Result.errors result of
      [] -> "taped"
      e : _ -> "refused: " <> show (Report.code e)
    findings = maybe [] (map show . Proof.findings) . Compile.proof
