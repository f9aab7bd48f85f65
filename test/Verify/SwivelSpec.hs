-- | Proof of a swivelling blade: its bevel along an element.
module Verify.SwivelSpec (spec) where

import Base.PulseVector (Pulses3 (..))
import Base.Result qualified as Result
import Compile (Analysis (..), Punched (..))
import Compile qualified
import Control.Monad (forM_)
import Data.Text qualified as Text
import Files (readText)
import Frame.Frame (Frame (..))
import Frame.Frame qualified as Frame
import Machines (iso6983)
import Project.LoadedProgram qualified as LoadedProgram
import Test.Hspec
import Verify.FromTape qualified as Verify
import Verify.Proof qualified as Proof

spec :: Spec
spec =
  it
    "an element between two outer corners has its own bevel (catches a proof of its ends \
    \alone, where the blade may have any bevel between two)"
    $ do
      text <- readText "test/programs/tool/good/blade-upright-ends.part"
      -- At round corners the direction of the cutter shows the bevel. At sharp ones, nothing does.
      forM_ [text, Text.replace "left {" "left { corners sharp" text] $ \source -> do
        let analysis = Compile.analyse [] (LoadedProgram.fromText "blade.part" source)
        (toolpath, program) <-
          maybe (fail "the program has errors") pure . Result.ifSound $
            analysis `Result.thenSound` \a ->
              Compile.punch iso6983 (path a) `Result.thenSound` \p -> pure (path a, program p)
        let frames = map Frame.frame (Frame.plannedFrames program)
            (onto, along) = break rises frames
            rises f = let Pulses3 _ _ z = increment f in z > 0
            -- Frames with a smaller descent before the element and a smaller rise after it.
            risen d = case (reverse onto, along) of
              (element : final : earlier, first : later) ->
                reverse earlier <> [final `by` d, element, first `by` negate d] <> later
              _ -> frames
            by f d = let Pulses3 x y z = increment f in f {increment = Pulses3 x y (z + d)}
            isProven d = Proof.isProven (Verify.prove iso6983 toolpath program (risen d))
        filter isProven [0, 500, 1000, 2000]
          `shouldBe` [0]
