-- | Facts about the finished tape of a program, which an editor shows when the tape is made.
module Query.TapeFacts
  ( TapeFacts (..),
    tapeFacts,
  )
where

import Base.Result qualified as Result
import Compile (Compiled (..), Punched (..))
import Compile qualified
import Data.Text (Text)
import Project.Job qualified as Job
import Project.LoadedProgram (LoadedProgram)
import Tape.Tape qualified as Tape

-- | The length of the tape in m, if it is a tape of paper that was made; and true if the tape is
-- proven, false if the proof has found something.
data TapeFacts = TapeFacts {metres :: Maybe Double, isProven :: Bool}
  deriving stock (Eq, Show)

-- | Makes the tape for the machine that the program names, and proves it. @values@ has the names of
-- parameters and the texts of their values.
tapeFacts :: [(Text, Text)] -> LoadedProgram -> TapeFacts
tapeFacts values loaded =
  case Result.ifSound (Compile.compile (Job.forOwnMachine values loaded) loaded) of
    Just (Compiled {machine, punched} : _) ->
      TapeFacts {metres = Tape.metres machine (tape punched), isProven = True}
    _ -> TapeFacts {metres = Nothing, isProven = False}
