{-# LANGUAGE TemplateHaskell #-}

-- | Files of the folder @explain/@, compiled into the program. "Report.Explanation" parses them.
module Report.Embedded
  ( files,
  )
where

import Data.ByteString (ByteString)
import Data.FileEmbed (embedDir)
import Language.Haskell.TH.Syntax (addDependentFile)

-- | Names and contents of the files. GHC compiles this module again when one of the files changes,
-- and when one is added, because that changes @partc.cabal@.
files :: [(FilePath, ByteString)]
files = $(addDependentFile "partc.cabal" *> embedDir "explain")
