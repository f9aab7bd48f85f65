-- | The only deliberate crash of the program: for a state that only a bug in partc can reach.
--
-- A user's mistake becomes a report instead. The command line turns the exception 'Bug' into exit
-- status 70 and asks the user to send in the part program.
module Base.Crash
  ( Bug (..),
    bug,
  )
where

import Control.Exception (Exception, throw)
import Data.Text (Text)
import Data.Text qualified as Text
import GHC.Stack (HasCallStack, callStack, prettyCallStack)

-- | A description of the impossible state (@what@), and the call stack in partc's source (@place@).
data Bug = Bug {what :: Text, place :: Text}

instance Show Bug where
  show Bug {what, place} = Text.unpack what <> "\n" <> Text.unpack place

instance Exception Bug

-- | Throws a 'Bug' with the description @what@ of the impossible state.
bug :: HasCallStack => Text -> a
bug what = throw Bug {what, place = Text.pack (prettyCallStack callStack)}
