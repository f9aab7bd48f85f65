-- | Rendering of reports as a SARIF 2.1.0 log, the format in which code scanners give their
-- results. The log contains neither a time nor the version of partc, so equal runs give equal logs.
--
-- Numbers in brackets are paragraphs of
-- <https://docs.oasis-open.org/sarif/sarif/v2.1.0/sarif-v2.1.0.html>.
module Report.Sarif
  ( Filed (..),
    log,
    uri,
  )
where

import Base.Region (Position (..), Region (..), Source)
import Base.Region qualified as Region
import Data.Aeson (Encoding, Series, (.=))
import Data.Aeson.Encoding (encodingToLazyByteString, list, pair, pairs)
import Data.ByteString qualified as ByteString
import Data.ByteString.Lazy qualified as LazyByteString
import Data.Char (chr, intToDigit, isAlphaNum, isAscii, toUpper)
import Data.List (nub, sort)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Report.Explanation (Explanation)
import Report.Explanation qualified as Explanation
import Report.Fix (Fix)
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), ReportCode (..), ReportPlace (..))
import Report.Report qualified as Report
import Prelude hiding (log)

-- | A report with the facts that its rendering needs. @path@ is the file's name, which is
-- written if the report's place is not a region of the program. @source@ is the text to which the
-- regions refer.
data Filed = Filed {path :: Text, source :: Source, report :: Report}

-- | Renders the log of one run of partc. A report code is called a rule in SARIF. The log lists the
-- codes that occur in it, each with its explanation if there is one.
log :: [Explanation] -> [Filed] -> Text
log explanations filed =
  Encoding.decodeUtf8 (LazyByteString.toStrict (encodingToLazyByteString whole)) <> "\n"
  where
    whole =
      pairs $
        "$schema" .= ("https://json.schemastore.org/sarif-2.1.0.json" :: Text)
          <> "version" .= ("2.1.0" :: Text)
          <> pair "runs" (list pairs [run])
    run =
      pair "tool" (pairs (pair "driver" (pairs driver)))
        <> "columnKind" .= ("unicodeCodePoints" :: Text)
        <> pair "results" (list (result indices) filed)
    driver = "name" .= ("partc" :: Text) <> pair "rules" (list (rule explanations) codes)
    codes = nub (sort (map (Report.code . report) filed))
    indices = Map.fromList (zip codes [0 ..])

-- | Encodes the rule of a report code. The help text of the rule is what @partc explain@ prints.
rule :: [Explanation] -> ReportCode -> Encoding
rule explanations code@(ReportCode name) = pairs ("id" .= name <> maybe mempty explained found)
  where
    found = listToMaybe [e | e <- explanations, Explanation.code e == code]
    explained e =
      pair "shortDescription" (pairs ("text" .= Explanation.title e))
        <> pair
          "help"
          (pairs ("text" .= Explanation.render e <> "markdown" .= Explanation.markdown e))

-- | Encodes one report. @indices@ has for each code the index of its rule in the log, from 0.
result :: Map ReportCode Int -> Filed -> Encoding
result indices Filed {path, source, report = r} =
  pairs $
    "ruleId" .= code
      <> foldMap ("ruleIndex" .=) (Map.lookup (Report.code r) indices)
      <> "level" .= Report.severityWord (severity r)
      <> pair "message" (message' sentences)
      <> pair "locations" (list pairs located)
      <> (if null (others r) then mempty else pair "relatedLocations" (list related places))
      <> (if null own then mempty else pair "fixes" (list (pairs . fixed source) own))
  where
    ReportCode code = Report.code r
    sentences = Text.intercalate "\n" (title r : message r <> map ("hint: " <>) (Report.remedies r))
    located = case place r of
      InSource region ->
        [ inSource source region
            <> (if label r == "" then mempty else pair "message" (message' (label r)))
        ]
      -- A tape is binary: each row is one byte (3.30.3).
      InTape row ->
        [ at
            path
            (pair "region" (pairs ("byteOffset" .= max 0 (row - 1) <> "byteLength" .= (1 :: Int))))
        ]
      InFile -> [at path mempty | path /= ""]
    own = filter (Fix.isWithin source) (fixes r)
    -- The related locations of a result must differ from one another (3.27.22).
    places = nub (others r)
    related (Label region words') =
      pairs
        ( inSource source region
            <> (if words' == "" then mempty else pair "message" (message' words'))
        )

-- | Encodes a fix. All its edits change the file of the program (3.55).
fixed :: Source -> Fix -> Series
fixed source f =
  pair "description" (message' (Fix.title f)) <> pair "artifactChanges" (list pairs [change])
  where
    change =
      pair "artifactLocation" (pairs ("uri" .= uri (Region.mainFile source)))
        <> pair "replacements" (list (pairs . replacement) (Fix.edits f))
    replacement e =
      pair "deletedRegion" (pairs (stretchOf source (Fix.replaced e)))
        <> pair "insertedContent" (pairs ("text" .= Fix.newText e))

-- | Location of a region: its file, and its lines and columns. Columns count characters from 1; the
-- end is the position after the last character (3.30.8).
inSource :: Source -> Region -> Series
inSource source region = at file (pair "region" (pairs (stretchOf source region)))
  where
    Position {file} = Region.position source (start region)

-- | Lines and columns of a region.
stretchOf :: Source -> Region -> Series
stretchOf source region =
  "startLine" .= line
    <> "startColumn" .= column
    <> "endLine" .= endLine
    <> "endColumn" .= endColumn
  where
    Position {line, column} = Region.position source (start region)
    Position {line = endLine, column = endColumn} = Region.position source (end region)

-- | Physical location in the file @path@. @region@ is the field for a region in this file; it is
-- 'mempty' for the file as a whole.
at :: Text -> Series -> Series
at path region =
  pair "physicalLocation" (pairs (pair "artifactLocation" (pairs ("uri" .= uri path)) <> region))

-- | Encodes a message. Braces are doubled, because single braces enclose placeholders (3.11.5).
message' :: Text -> Encoding
message' words' = pairs ("text" .= Text.replace "}" "}}" (Text.replace "{" "{{" words'))

-- | Converts a path to a URI reference (RFC 3986): relative for a relative path. All bytes except
-- ASCII letters, digits and @-._~/@ are percent-encoded.
uri :: Text -> Text
uri path = case Text.stripPrefix "/" path of
  Just rest -> "file:///" <> encoded rest
  Nothing -> encoded (dropHere path)
  where
    encoded = Text.concat . map byte . ByteString.unpack . Encoding.encodeUtf8
    byte w
      | isAscii c && (isAlphaNum c || c `elem` ("-._~/" :: String)) = Text.singleton c
      | otherwise = Text.pack ['%', digit (w `div` 16), digit (w `mod` 16)]
      where
        c = chr (fromIntegral w)
    digit = toUpper . intToDigit . fromIntegral
    -- Drops @./@, because viewers compare the reference with paths that do not begin with it.
    dropHere p = maybe p dropHere (Text.stripPrefix "./" p)
