{-# LANGUAGE CApiFFI #-}

-- | The terminal to which reports are written.
module Cli.Terminal
  ( columns,
  )
where

import Control.Exception (IOException, try)
import Data.Either (fromRight)
import Foreign.C.Types (CInt (..), CULong (..), CUShort)
import Foreign.Marshal.Array (allocaArray)
import Foreign.Ptr (Ptr)
import Foreign.Storable (peekElemOff)
import System.Environment (lookupEnv)
import System.IO (Handle, hIsTerminalDevice)
import System.Posix.IO (stdError)
import System.Posix.Types (Fd (Fd))
import Text.Read (readMaybe)

-- | The count of columns of the terminal to which @handle@ writes; nothing if it is no terminal.
-- The environment variable @COLUMNS@ overrides the width that the terminal gives. Standard error is
-- asked, because reports go there. The function of @ansi-terminal@ would not do: it asks the
-- terminal through standard input, which may be the program to compile.
columns :: Handle -> IO (Maybe Int)
columns handle = do
  isTerminal <- fromRight False <$> tried (hIsTerminalDevice handle)
  if isTerminal
    then do
      said <- (>>= readMaybe) <$> lookupEnv "COLUMNS"
      case said of
        Just n | n > 0 -> pure (Just n)
        _ -> windowColumns
    else pure Nothing
  where
    tried :: IO a -> IO (Either IOException a)
    tried = try

-- | The width that the terminal of standard error gives.
windowColumns :: IO (Maybe Int)
windowColumns = allocaArray 4 $ \size -> do
  status <- ioctl descriptor requestWindowSize size
  if status == 0 then known . fromIntegral <$> peekElemOff size 1 else pure Nothing
  where
    Fd descriptor = stdError
    known n = if n > 0 then Just n else Nothing

-- | Asks a device. For the window's size, the answer is four numbers: rows, columns, and the width
-- and the height in pixels.
foreign import capi unsafe "sys/ioctl.h ioctl"
  ioctl :: CInt -> CULong -> Ptr CUShort -> IO CInt

-- | The request for the size of a terminal's window.
foreign import capi "sys/ioctl.h value TIOCGWINSZ"
  requestWindowSize :: CULong
