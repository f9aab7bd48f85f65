{-# LANGUAGE TemplateHaskell #-}

-- | The files of the folder @fonts/@ as they are when the program is built. "Font.FromText" reads
-- them.
module Font.Embedded
  ( files,
  )
where

import Data.ByteString (ByteString)
import Data.FileEmbed (embedDir)
import Language.Haskell.TH.Syntax (addDependentFile)

-- | Names and contents of the files. A changed file makes GHC recompile this module. So does a new
-- file, because it changes @partc.cabal@, which is generated with a list of the files.
files :: [(FilePath, ByteString)]
files = $(addDependentFile "partc.cabal" *> embedDir "fonts")
