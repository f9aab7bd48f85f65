{-# LANGUAGE TemplateHaskell #-}

-- | Files of the page, as they are when the program is built.
module Preview.Page
  ( find,
  )
where

import Data.ByteString (ByteString)
import Data.FileEmbed (embedDir)
import Data.Text (Text)
import Data.Text qualified as Text
import Language.Haskell.TH.Syntax (addDependentFile)
import System.FilePath (takeExtension)

-- | File of the page by its name, with its media type. The empty name is the page itself.
find :: Text -> Maybe (ByteString, ByteString)
find name = (,) (mediaType name') <$> lookup name' files
  where
    name' = if Text.null name then "index.html" else Text.unpack name

-- | Media type of a file by its extension.
mediaType :: FilePath -> ByteString
mediaType name = case takeExtension name of
  ".html" -> "text/html; charset=utf-8"
  ".css" -> "text/css; charset=utf-8"
  ".js" -> "text/javascript; charset=utf-8"
  ".svg" -> "image/svg+xml"
  _ -> "application/octet-stream"

-- | Names and contents of all files. GHC compiles this module again when one of them changes, or
-- when there is a new one, because @partc.cabal@ then changes.
files :: [(FilePath, ByteString)]
files = $(addDependentFile "partc.cabal" *> embedDir "preview")
