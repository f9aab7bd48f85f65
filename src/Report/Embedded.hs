{-# LANGUAGE TemplateHaskell #-}

-- | Files of the folder @explain/@, compiled into the program. "Report.Explanation" parses them.
module Report.Embedded
  ( files,
  )
where

import Data.ByteString (ByteString)
import Data.FileEmbed (embedDir)
import Language.Haskell.TH.Syntax (addDependentFile)

-- | Names and contents of the files. GHC compiles this module again when one of the files changes.
-- It also does so when a file is added, because @partc.cabal@ then changes.
files :: [(FilePath, ByteString)]
files = $(addDependentFile "partc.cabal" *> embedDir "explain")
