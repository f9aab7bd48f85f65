-- | A progress message for work that takes longer than a second, on a terminal only.
module Cli.Progress
  ( during,
  )
where

import Base.Decimal qualified as Decimal
import Control.Concurrent (forkIO, killThread, threadDelay)
import Control.Exception (IOException, finally, try)
import Control.Monad (void)
import Data.Text (Text)
import Data.Text.IO qualified as Text
import System.IO (hFlush, hIsTerminalDevice, stderr)

-- | Runs an action. If it takes longer than a second, the terminal shows @text@ and the elapsed
-- seconds until the action ends. The message goes to standard error, if that is a terminal.
during :: Text -> IO a -> IO a
during text work = do
  isTerminal <- hIsTerminalDevice stderr
  if not isTerminal
    then work
    else do
      ticker <- forkIO (tick (1 :: Int))
      work `finally` (killThread ticker *> write "\r\ESC[K")
  where
    tick n = do
      threadDelay 1000000
      write ("\r" <> text <> " … " <> Decimal.whole n <> " s")
      tick (n + 1)
    write line =
      void (try (Text.hPutStr stderr line *> hFlush stderr) :: IO (Either IOException ()))
