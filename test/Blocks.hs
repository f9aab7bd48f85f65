-- | The part programs in the documents, and the pictures below them.
module Blocks
  ( Block (..),
    documents,
    blocks,
    load,
  )
where

import Control.Exception (IOException, try)
import Data.Bifunctor (first)
import Data.List (sort)
import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Data.Text qualified as Text
import Files (readText)
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram
import Surface.Import qualified as Import
import System.Directory (listDirectory)
import System.FilePath (takeExtension, (</>))

-- | A part program of a document: the text between @```part@ and @```@, and the name of the picture
-- directly below it, if there is one.
data Block = Block {program :: Text, picture :: Maybe Text}

-- | The paths of all documents: README.md and docs/*.md.
documents :: IO [FilePath]
documents =
  ("README.md" :) . map ("docs" </>) . sort . filter ((== ".md") . takeExtension)
    <$> listDirectory "docs"

-- | The programs of a document.
blocks :: Text -> [Block]
blocks text =
  [ Block {program, picture = pictureBelow (Text.drop 3 rest)}
    | block <- drop 1 (Text.splitOn "```part\n" text),
      let (program, rest) = Text.breakOn "```" block
  ]

-- | The picture directly below a program: @![…](pictures/NAME.svg)@.
pictureBelow :: Text -> Maybe Text
pictureBelow below =
  case Text.breakOn "](pictures/" (Text.takeWhile (/= '\n') (Text.stripStart below)) of
    (before, rest)
      | Text.isPrefixOf "![" before,
        (name, end) <- Text.breakOn ".svg)" (Text.drop 11 rest),
        not (Text.null end) ->
        Just name
    _ -> Nothing

-- | Loads a program of a document. A program without a @part@ statement is put after the statements
-- of the first program of docs/language.md. Imports are relative to the document's folder.
load :: FilePath -> Block -> IO LoadedProgram
load file block = do
  manual <- readText "docs/language.md"
  let head' = Text.concat [program b <> "\n" | b <- take 1 (blocks manual)]
      isWhole = "part " `elem` map (Text.take 5) (Text.lines (program block))
      title = Maybe.fromMaybe "example" (picture block)
      named =
        Text.replace
          "part example \"One head for the examples\""
          ("part " <> Text.replace "-" "_" title)
          head'
  LoadedProgram.load
    (Import.byName reader)
    file
    (if isWhole then program block else named <> program block)
  where
    reader there = first why <$> try (readText there)
    why :: IOException -> Text
    why = Text.pack . show
