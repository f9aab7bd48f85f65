-- | Rendering of reports as a SARIF 2.1.0 log, the format in which code scanners give their
-- results. The log contains no time, so equal runs give equal logs. It has what GitHub requires
-- (<https://docs.github.com/en/code-security/reference/code-scanning/sarif-files/sarif-support>).
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
import Data.Aeson.Key qualified as Key
import Data.ByteString qualified as ByteString
import Data.ByteString.Lazy qualified as LazyByteString
import Data.Char (chr, intToDigit, isAlphaNum, isAscii, toUpper)
import Data.List (nub)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map (Map)
import Data.Map qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Report.Explanation (Explanation)
import Report.Explanation qualified as Explanation
import Report.Fingerprint qualified as Fingerprint
import Report.Fix (Fix)
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), ReportCode (..), ReportPlace (..))
import Report.Report qualified as Report
import Prelude hiding (log)

-- | A report with the facts that its rendering needs. @path@ is the file's name, which is
-- written if the report's place is not a region of the program. @source@ is the text to which the
-- regions refer.
data Filed = Filed {path :: Text, source :: Source, report :: Report}

-- | Renders the log of one run of partc. @version@ is that of partc. A report code is called a rule
-- in SARIF. The log lists the codes that occur in it, each with its explanation if there is one.
log :: Text -> [Explanation] -> [Filed] -> Text
log version explanations filed =
  Encoding.decodeUtf8 (LazyByteString.toStrict (encodingToLazyByteString whole)) <> "\n"
  where
    whole =
      pairs $
        "$schema" .= ("https://json.schemastore.org/sarif-2.1.0.json" :: Text)
          <> "version" .= ("2.1.0" :: Text)
          <> pair "runs" (list pairs [run])
    run =
      pair "tool" (pairs (pair "driver" (pairs driver)))
        <> pair "originalUriBaseIds" (pairs (pair (Key.fromText root) (pairs folder)))
        <> "columnKind" .= ("unicodeCodePoints" :: Text)
        <> pair "results" (list (result indices (fingerprints filed)) filed)
    driver =
      "name" .= ("partc" :: Text)
        <> "semanticVersion" .= semantic version
        <> pair "rules" (list (rule explanations) examples)
    folder = pair "description" (message' "the folder in which partc was run")
    -- The first report of each code.
    examples = map NonEmpty.head (NonEmpty.groupAllWith Report.code (map report filed))
    indices = Map.fromList (zip (map Report.code examples) [0 ..])

-- | Makes a version of three numbers, as semantic versions are, of one that may have more.
semantic :: Text -> Text
semantic = Text.intercalate "." . take 3 . Text.splitOn "."

-- | Encodes the rule of a report's code. The help text of the rule is what @partc explain@ prints.
-- The title of the report describes a rule without an explanation.
rule :: [Explanation] -> Report -> Encoding
rule explanations r =
  pairs $
    "id" .= name
      <> pair "shortDescription" (pairs short)
      <> pair "fullDescription" (pairs full)
      <> pair "help" (pairs help)
      <> pair "defaultConfiguration" (pairs ("level" .= severe))
      <> pair
        "properties"
        ( pairs
            ( "tags" .= Explanation.subjects (Report.code r)
                <> "precision" .= precision
                <> "problem.severity" .= severe
            )
        )
  where
    ReportCode name = Report.code r
    severe = Report.severityWord (severity r)
    -- An error is certain, a warning is a guess.
    precision :: Text
    precision = if Report.isError r then "very-high" else "high"
    (short, full, help) = case [e | e <- explanations, Explanation.code e == Report.code r] of
      e : _ ->
        ( "text" .= Explanation.plain (Explanation.title e)
            <> "markdown" .= Explanation.title e,
          "text" .= Explanation.plain (Explanation.firstParagraph e)
            <> "markdown" .= Explanation.firstParagraph e,
          "text" .= Explanation.render e <> "markdown" .= Explanation.markdown e
        )
      [] -> let said = "text" .= title r in (said, said, said)

-- | The fingerprints of the lines of each file, by the file's name.
fingerprints :: [Filed] -> Map Text (Vector Text)
fingerprints filed =
  Map.fromList
    [ (file, Vector.fromList (Fingerprint.ofLines (fileLines source (start region))))
      | Filed {source, report = Report {place = InSource region}} <- filed,
        let Position {file} = Region.position source (start region)
    ]

-- | The lines of the file that contains an offset.
fileLines :: Source -> Int -> [Text]
fileLines source offset = Region.linesIn source (Region (first 0 offset) (Region.nextOffset source))
  where
    fileAt o = let Position {file} = Region.position source o in file
    -- The least offset of the file that is at least @low@; @high@ is in the file.
    first low high
      | low == high = high
      | fileAt middle == fileAt offset = first low middle
      | otherwise = first (middle + 1) high
      where
        middle = (low + high) `div` 2

-- | Encodes one report. @indices@ has for each code the index of its rule in the log, from 0.
-- @lines'@ has the fingerprints of the lines of each file.
result :: Map ReportCode Int -> Map Text (Vector Text) -> Filed -> Encoding
result indices lines' Filed {path, source, report = r} =
  pairs $
    "ruleId" .= code
      <> foldMap ("ruleIndex" .=) (Map.lookup (Report.code r) indices)
      <> "level" .= Report.severityWord (severity r)
      <> pair "message" (message' sentences)
      <> pair "locations" (list pairs located)
      <> (if null (others r) then mempty else pair "relatedLocations" (list related places))
      <> foldMap identified fingerprint
      <> (if null own then mempty else pair "fixes" (list (pairs . fixed source) own))
  where
    identified f =
      pair "partialFingerprints" (pairs ("primaryLocationLineHash" .= (f :: Text)))
    fingerprint = case place r of
      InSource region ->
        let Position {file, line} = Region.position source (start region)
         in Map.lookup file lines' >>= (Vector.!? (line - 1))
      _ -> Nothing
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
      -- GitHub shows no result without a line, so the first one stands for the file.
      InFile -> [at path (pair "region" (pairs firstLine)) | path /= ""]
      InCommandLine -> []
    firstLine = foldMap (.= (1 :: Int)) ["startLine", "startColumn", "endLine", "endColumn"]
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
      pair "artifactLocation" (pairs (artifact (Region.mainFile source)))
        <> pair "replacements" (list (pairs . replacement) (Fix.edits f))
    replacement e =
      pair "deletedRegion" (pairs (stretchOf source (Fix.replaced e)))
        <> pair "insertedContent" (pairs ("text" .= Fix.newText source e))

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
  pair "physicalLocation" (pairs (pair "artifactLocation" (pairs (artifact path)) <> region))

-- | Location of a file. A relative path is based on the folder in which partc was run.
artifact :: Text -> Series
artifact path =
  "uri" .= uri path <> (if "/" `Text.isPrefixOf` path then mempty else "uriBaseId" .= root)

-- | The name of the folder in which partc was run. GitHub takes it for the root of the repository.
root :: Text
root = "%SRCROOT%"

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
