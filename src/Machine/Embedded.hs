{-# LANGUAGE TemplateHaskell #-}

-- | The files of the folder @machines/@, as they were when the program was built. What they mean is
-- read in "Machine.FromText".
module Machine.Embedded
  ( files,
  )
where

import Data.ByteString (ByteString)
import Data.FileEmbed (embedDir)
import Language.Haskell.TH.Syntax (addDependentFile)

-- | Names and contents. A changed file compiles this module anew by itself; a new one does through
-- @partc.cabal@, which is generated with the list of them.
files :: [(FilePath, ByteString)]
files = $(addDependentFile "partc.cabal" *> embedDir "machines")
