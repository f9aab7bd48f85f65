-- | The one sanctioned crash: a state that only a bug in partc can reach.
--
-- A user's fault never comes here; it becomes a report. The command line turns
-- the exception into exit status 70 and a request to send us the program.
module Base.Crash
  ( Bug (..),
    bug,
  )
where

import Control.Exception (Exception, throw)
import Data.Text (Text)
import Data.Text qualified as Text
import GHC.Stack (HasCallStack, callStack, prettyCallStack)

-- | What went wrong, and where in partc's own source.
data Bug = Bug {what :: Text, place :: Text}

instance Show Bug where
  show Bug {what, place} = Text.unpack what <> "\n" <> Text.unpack place

instance Exception Bug

-- | Stop because of a bug of our own.
bug :: HasCallStack => Text -> a
bug what = throw Bug {what, place = Text.pack (prettyCallStack callStack)}
