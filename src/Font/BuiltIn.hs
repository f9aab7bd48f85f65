-- | The built-in letters, which the files in the folder @fonts/@ describe. The files are read when
-- the first letter is needed.
module Font.BuiltIn
  ( letters,
    fonts,
  )
where

import Base.Crash qualified as Crash
import Data.Either (fromRight)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Font.Embedded qualified as Embedded
import Font.Font (Font)
import Font.FromText qualified as FromText

-- | The letters of all fonts. Each character is in one font only.
letters :: Font
letters = Map.unions (map snd fonts)

-- | The fonts by the names of their files. A mistake in such a file is a bug of this program, and
-- ends it.
fonts :: [(Text, Font)]
fonts =
  [ (name, either (\n -> fault name (Text.pack (show n))) id (FromText.read content))
    | (file, bytes) <- Embedded.files,
      let name = Text.pack file,
      ".font" `Text.isSuffixOf` name,
      let content = fromRight (fault name "0") (Encoding.decodeUtf8' bytes)
  ]
  where
    fault name line = Crash.bug ("line " <> line <> " of fonts/" <> name <> " does not read")
