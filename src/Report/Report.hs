-- | The one type of report. Every stage turns its errors and warnings into it with
-- its own @toReport@; how a report looks is decided by the renderings beside this module.
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

-- | Errors stop the tape, warnings do not.
data Severity = Error | Warning
  deriving stock (Eq, Ord, Show)

-- | The stable code of a report, a letter and four digits: @E0412@, @W0501@.
newtype ReportCode = ReportCode Text
  deriving newtype (Eq, Ord, IsString)
  deriving stock (Show)

-- | Where a report points.
data ReportPlace
  = -- | a stretch of the program
    InSource Region
  | -- | a row of the tape, from 1
    InTape Int
  | -- | the file as a whole
    InFile
  deriving stock (Eq, Ord, Show)

-- | A stretch of the program with a few words beside it.
data Label = Label {region :: Region, words :: Text}
  deriving stock (Eq, Show)

-- | What is wrong, where, why, and what to do about it.
data Report = Report
  { severity :: Severity,
    code :: ReportCode,
    -- | one line, lower case, no full stop
    title :: Text,
    place :: ReportPlace,
    -- | words beside the place itself; may be empty
    label :: Text,
    -- | other places that matter
    others :: [Label],
    -- | whole sentences
    message :: [Text],
    -- | what to do; looked for when it is told
    hints :: ~[Text]
  }
  deriving stock (Eq, Show)

-- | A report with a title and a place and nothing else yet.
report :: Severity -> ReportCode -> ReportPlace -> Text -> Report
report severity code place title =
  Report {severity, code, title, place, label = "", others = [], message = [], hints = []}

-- | A word of the program in a sentence, the beginning of a very long one.
quote :: Text -> Text
quote text = "‘" <> (if Text.length text > 60 then Text.take 57 text <> "…" else text) <> "’"

severityWord :: Severity -> Text
severityWord severity = case severity of
  Error -> "error"
  Warning -> "warning"

-- | Whether the report stops the tape.
isError :: Report -> Bool
isError r = case severity r of
  Error -> True
  Warning -> False

-- | By place, each once.
sorted :: [Report] -> [Report]
sorted = map NonEmpty.head . NonEmpty.group . sortOn (\r -> (place r, severity r, code r, title r))
