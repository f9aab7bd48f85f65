-- | The report: one error or warning as a user reads it.
--
-- Every compiler pass converts its errors to reports by its own @toReport@, and its warnings, if it
-- has any, by @warningReport@. The other modules of this folder render a report for a terminal, for
-- an editor, as JSON and as SARIF.
module Report.Report
  ( Report (..),
    Severity (..),
    ReportCode (..),
    ReportPlace (..),
    Label (..),
    report,
    at,
    withControlStop,
    remedies,
    force,
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
import Report.Fix (Fix)
import Report.Fix qualified as Fix

-- | Severity of a report. After an error the compiler makes no tape; after a warning it does.
data Severity = Error | Warning
  deriving stock (Eq, Ord, Show)

-- | Code of a report, the same in all versions of partc. It is E for an error or W for a warning,
-- and four digits, such as @E0412@.
newtype ReportCode = ReportCode Text
  deriving newtype (Eq, Ord, IsString)
  deriving stock (Show)

-- | The thing to which a report points: a region, a row or a file.
data ReportPlace
  = -- | a region of the program
    InSource Region
  | -- | a row of the tape, from 1
    InTape Int
  | -- | the file as a whole
    InFile
  | -- | the command line
    InCommandLine
  deriving stock (Eq, Ord, Show)

-- | Region of the program with a few words that are printed beside it.
data Label = Label {region :: Region, words :: Text}
  deriving stock (Eq, Show)

-- | Error or warning, with the thing to which it points, the reason and the remedy.
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
    -- | number of the control stop at which the Minsk-22 system halted for the same mistake
    controlStop :: Maybe Text,
    -- | remedies in words; lazy, because some need a slow comparison with similar names, which is
    -- left out for a report that is not shown
    hints :: ~[Text],
    -- | Changes of the program that mend the mistake, the most likely one first. Their titles are
    -- remedies too.
    fixes :: ~[Fix]
  }
  deriving stock (Eq, Show)

-- | Makes a report with a title and a place; all other fields are empty.
report :: Severity -> ReportCode -> ReportPlace -> Text -> Report
report severity code place title =
  Report
    { severity,
      code,
      title,
      place,
      label = "",
      others = [],
      message = [],
      controlStop = Nothing,
      hints = [],
      fixes = []
    }

-- | Error at a region of the program, with its code and its title; all other fields are empty.
at :: Region -> ReportCode -> Text -> Report
at region code = report Error code (InSource region)

-- | The report of a mistake on an input sheet: its message also names the control stop.
withControlStop :: Report -> Report
withControlStop r = case controlStop r of
  Just stop ->
    r {message = message r <> ["The Minsk-22 system stopped here with " <> stop <> "."]}
  Nothing -> r

-- | Remedies as sentences: the titles of the fixes, and the hints.
remedies :: Report -> [Text]
remedies r = map Fix.title (fixes r) <> hints r

-- | Evaluates all texts of a report.
force :: Report -> ()
force r = foldr seq () (message r <> remedies r) `seq` length (others r) `seq` ()

-- | Puts a word of the program in quotation marks. If it has more than 60 characters, only the
-- first 57 are shown.
quote :: Text -> Text
quote text = "‘" <> (if Text.length text > 60 then Text.take 57 text <> "…" else text) <> "’"

-- | Word for a severity in all renderings.
severityWord :: Severity -> Text
severityWord severity = case severity of
  Error -> "error"
  Warning -> "warning"

-- | True of an error, false of a warning.
isError :: Report -> Bool
isError r = case severity r of
  Error -> True
  Warning -> False

-- | Sorts reports by place, severity, code and title. Of several reports that are equal in these
-- four fields, only the first is kept.
sorted :: [Report] -> [Report]
sorted = map NonEmpty.head . NonEmpty.group . sortOn (\r -> (place r, severity r, code r, title r))
