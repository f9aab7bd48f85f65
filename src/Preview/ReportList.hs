-- | Reports and texts for the page, as JSON.
module Preview.ReportList
  ( reportList,
    fileList,
    FileLines,
    fileLines,
    lineOf,
  )
where

import Base.Region (Position (..), Region (..), Source)
import Base.Region qualified as Region
import Data.Aeson (Value, object, (.=))
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Human qualified as Human
import Report.Report (Report (..), ReportCode (..), ReportPlace (..))
import Report.Report qualified as Report

-- | Finds the file and the line of an offset in a source.
data FileLines = FileLines {text :: Source, indices :: Map Text Int}

-- | FileLines in a source.
fileLines :: Source -> FileLines
fileLines source =
  FileLines {text = source, indices = Map.fromList (zip (map fst (Region.files source)) [0 ..])}

-- | Index of the file in which a region begins, and its line from 1; −1 and 0 for a region in no
-- file.
lineOf :: FileLines -> Region -> (Int, Int)
lineOf FileLines {text, indices} region = (Map.findWithDefault (-1) file indices, line)
  where
    Position {file, line} = Region.position text (start region)

-- | Names and texts of all files of a source, the program first.
fileList :: Source -> [Value]
fileList source =
  [object ["name" .= name, "text" .= content] | (name, content) <- Region.files source]

-- | The lines of the program in a report that is rendered for people, without its heading and
-- without the sentences below them, which the page shows in its own form.
excerptOf :: Text -> Text
excerptOf rendered =
  Text.intercalate "\n" (takeWhile (not . isSentence) (drop 2 (Text.lines rendered)))
  where
    isSentence l = any (`Text.isPrefixOf` Text.stripStart l) ["= ", "error", "warning"]

-- | Reports in the order of the text. The name is that of the file for reports without a place.
reportList :: Text -> Source -> [Report] -> [Value]
reportList name source reports = map one (Report.sorted reports)
  where
    known = fileLines source
    one r =
      object
        ( [ "severity" .= Report.severityWord (severity r),
            "code" .= codeText (code r),
            "text" .= title r,
            "message" .= message r,
            "hint" .= listToMaybe (Report.remedies r),
            "excerpt" .= excerptOf (Human.render Human.Plain name source r)
          ]
            <> placed (place r)
        )
    codeText (ReportCode c) = c
    placed at = case at of
      InSource region ->
        let from = Region.position source (start region)
            to = Region.position source (end region)
         in [ "file" .= fst (lineOf known region),
              "line" .= line from,
              "column" .= column from,
              "endLine" .= line to,
              "endColumn" .= column to
            ]
      InTape row -> ["file" .= none, "row" .= row]
      InFile -> ["file" .= none]
      InCommandLine -> ["file" .= none]
    none = -1 :: Int
