-- | The report: one error or warning as a user reads it.
--
-- Every stage converts its errors and warnings to reports by its own @toReport@. The other modules
-- of this folder render a report for a terminal, for an editor, as JSON and as SARIF.
module Report.Report
  ( Report (..),
    Severity (..),
    ReportCode (..),
    ReportPlace (..),
    Label (..),
    report,
    quote,
    severityWord,
    isError,
    sorted,
  )
where

import Base.Region (Region)
import Data.List (sortOn)
import Data.List.NonEmpty qualified as NonEmpty
import Data.String (IsString)
import Data.Text (Text)
import Data.Text qualified as Text

-- | Severity of a report. An error prevents the tape; a warning does not.
data Severity = Error | Warning
  deriving stock (Eq, Ord, Show)

-- | Stable code of a report, a letter and four digits: @E0412@, @W0501@.
newtype ReportCode = ReportCode Text
  deriving newtype (Eq, Ord, IsString)
  deriving stock (Show)

-- | Place to which a report points.
data ReportPlace
  = -- | a region of the program
    InSource Region
  | -- | a row of the tape, from 1
    InTape Int
  | -- | the file as a whole
    InFile
  deriving stock (Eq, Ord, Show)

-- | Region of the program with a few words that are printed beside it.
data Label = Label {region :: Region, words :: Text}
  deriving stock (Eq, Show)

-- | Error or warning, with its place, its reason and its remedy.
data Report = Report
  { severity :: Severity,
    code :: ReportCode,
    -- | the mistake on one line, in lower case and without a full stop
    title :: Text,
    place :: ReportPlace,
    -- | words printed beside the place; may be empty
    label :: Text,
    -- | further regions that explain the mistake
    others :: [Label],
    -- | the reason, as whole sentences
    message :: [Text],
    -- | remedies; lazy, because some need a search for similar names, which only a rendered report
    -- pays for
    hints :: ~[Text]
  }
  deriving stock (Eq, Show)

-- | Makes a report with a title and a place; all other fields are empty.
report :: Severity -> ReportCode -> ReportPlace -> Text -> Report
report severity code place title =
  Report {severity, code, title, place, label = "", others = [], message = [], hints = []}

-- | Puts a word of the program in quotation marks. If it has more than 60 characters, only the
-- first 57 are shown.
quote :: Text -> Text
quote text = "‘" <> (if Text.length text > 60 then Text.take 57 text <> "…" else text) <> "’"

-- | Word for a severity in all renderings.
severityWord :: Severity -> Text
severityWord severity = case severity of
  Error -> "error"
  Warning -> "warning"

-- | True of a report that prevents the tape.
isError :: Report -> Bool
isError r = case severity r of
  Error -> True
  Warning -> False

-- | Sorts reports by place, severity, code and title. Of several reports that are equal in all
-- four, only the first stays.
sorted :: [Report] -> [Report]
sorted = map NonEmpty.head . NonEmpty.group . sortOn (\r -> (place r, severity r, code r, title r))
