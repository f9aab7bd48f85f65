-- | A sign of life for work that takes longer than a second, on a terminal only.
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

-- | Do some work; after a second say what is being done, and wipe it out in the end.
during :: Text -> IO a -> IO a
during what work = do
  terminal <- hIsTerminalDevice stderr
  if not terminal
    then work
    else do
      ticker <- forkIO (tick (1 :: Int))
      work `finally` (killThread ticker *> write "\r\ESC[K")
  where
    tick n = do
      threadDelay 1000000
      write ("\r" <> what <> " … " <> Decimal.whole n <> " s")
      tick (n + 1)
    write text =
      void (try (Text.hPutStr stderr text *> hFlush stderr) :: IO (Either IOException ()))
