-- | Drawings that @partc plot@ writes, for tests.
module Plotted
  ( drawing,
    drawingOf,
    withProgram,
  )
where

import Command (inFolder, partc)
import Data.ByteString qualified as ByteString
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import System.FilePath ((</>))

-- | The drawing that @partc plot@ writes with these arguments.
drawing :: [String] -> IO Text
drawing arguments = do
  (_, svg, _) <- partc ("plot" : arguments)
  pure (Text.pack svg)

-- | Runs an action with the file of a program.
withProgram :: Text -> (FilePath -> IO a) -> IO a
withProgram text action = inFolder $ \folder -> do
  ByteString.writeFile (folder </> "p.part") (Encoding.encodeUtf8 text)
  action (folder </> "p.part")

-- | The drawing of a program, with options of @partc plot@.
drawingOf :: [String] -> [Text] -> IO Text
drawingOf options program =
  withProgram (Text.unlines program) (\file -> drawing (file : "-q" : options))
