-- | Diagnostics for programs of several files.
module Lsp.DiagnosticSpec (spec) where

import Base.Region (Region (Region), Source)
import Base.Region qualified as Region
import Data.Aeson (Value (..), object)
import Data.Text (Text)
import Lsp.Capability qualified as Capability
import Lsp.Diagnostic qualified as Diagnostic
import Lsp.Document (Document (..))
import Lsp.Location qualified as Location
import Lsp.Message (Outgoing (..))
import Lsp.Talk (at, field)
import Lsp.Uri (Uri (..))
import Project.LoadedProgram qualified as LoadedProgram
import Query.Snapshot qualified as Snapshot
import Report.Report (Report, ReportPlace (..), Severity (..), report)
import Test.Hspec

spec :: Spec
spec = do
  it "a report on an imported file is at the import statement and gives its position in the file" $
    shown (report Error "E0101" (InSource (Region 9 10)) "wrong")
      `shouldBe` [(at (1, 0), String "/tmp/ж.part:2:3: wrong")]
  it "a report on the whole file is at its beginning" $
    shown (report Error "E0804" InFile "wrong") `shouldBe` [(at (0, 0), String "wrong")]
  it "a report on the document is at its region" $
    shown (report Error "E0101" (InSource (Region 3 4)) "wrong")
      `shouldBe` [(at (1, 0), String "wrong")]
  it "a location in the document has the client's address, one in another file that of its path" $
    map (field "uri" . Location.location uri' source) [Region 3 4, Region 9 10]
      `shouldBe` [String "file:///tmp/%61.part", String "file:///tmp/%D0%B6.part"]

uri' :: Uri
uri' = Uri "file:///tmp/%61.part"

text' :: Text
text' = "🙂\r\nx"

-- | The source of the document and of a file that it imports.
source :: Source
source = Region.addFile "/tmp/ж.part" "a\nbcd" (Region.fromText "/tmp/a.part" text')

shown :: Report -> [(Value, Value)]
shown r =
  case Diagnostic.publish
    (Capability.fromInitialize (object []))
    (Document uri' Nothing text')
    (Just snapshot) of
    Notify _ params
      | Array ds <- field "diagnostics" params ->
        [(field "start" (field "range" d), field "message" d) | d <- foldMap pure ds]
    other -> error (show other)
  where
    snapshot =
      (Snapshot.take (Snapshot.checkWith []) (LoadedProgram.fromText "/tmp/a.part" ""))
        { Snapshot.source = source,
          Snapshot.reports = [r],
          Snapshot.imports = [(Region 3 4, "/tmp/ж.part")]
        }
