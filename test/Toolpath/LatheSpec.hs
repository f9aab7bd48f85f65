-- | Programs for a lathe, on machines whose axes have other directions there.
module Toolpath.LatheSpec (spec) where

import Base.PulseVector (Pulses3 (..))
import Base.Result qualified as Result
import Compile (Analysis (..), Punched (..))
import Compile qualified
import Data.Text (Text)
import Files (readText)
import Frame.Frame (Frame (..))
import Machines (kontur3p)
import Project.LoadedProgram qualified as LoadedProgram
import Project.Target qualified as Target
import Tape.Punch qualified as Punch
import Test.Hspec

spec :: Spec
spec =
  it
    "moves towards the spindle's axis are positive on Контур-3П-68, also without a turned profile \
    \(catches a lathe that is recognised by turned profiles only)"
    $ do
      moves <- readText "test/programs/turn/good/facing-by-moves.part"
      profile <- readText "test/programs/turn/good/outside.part"
      concat <$> traverse depthOf [moves, profile] `shouldReturn` [1000, 2400]
  where
    -- The first increment in y on the tape of a program, in pulses.
    depthOf text = do
      punched <- punchedFrom text
      pure
        ( take
            1
            [ y
              | Right fs <- [Punch.read kontur3p 0 (tape punched)],
                f <- fs,
                let Pulses3 _ y _ = increment f,
                y /= 0
            ]
        )

punchedFrom :: Text -> IO Punched
punchedFrom text =
  maybe (fail "the program has errors") pure . Result.ifSound $
    Compile.analyse [] (LoadedProgram.fromText "lathe.part" text) `Result.thenSound` \a ->
      Compile.punch (Target.setUpFor (path a) kontur3p) (path a)
