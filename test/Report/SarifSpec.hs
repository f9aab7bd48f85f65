-- | Logs in SARIF: their content, and that the published schema of version 2.1.0 accepts them.
module Report.SarifSpec (spec) where

import Base.Region (Region (..))
import Base.Region qualified as Region
import Data.Aeson (Value, object, (.=))
import Data.Aeson qualified as Aeson
import Data.Aeson.Key qualified as Key
import Data.Aeson.KeyMap qualified as KeyMap
import Data.ByteString qualified as ByteString
import Data.Foldable (toList)
import Data.Maybe (fromMaybe, isNothing)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Report.Explanation (Example (..))
import Report.Explanation qualified as Explanation
import Report.Report
  ( Label (..),
    Report (..),
    ReportCode (..),
    ReportPlace (..),
    Severity (..),
    report,
  )
import Report.Sarif (Filed (Filed))
import Report.Sarif qualified as Sarif
import Reports qualified
import System.Exit (ExitCode (..))
import System.FilePath ((</>))
import System.IO.Temp (withSystemTempDirectory)
import System.Process (readProcessWithExitCode)
import Test.Hspec hiding (Example)

spec :: Spec
spec = do
  describe "the schema" $ do
    it "accepts a log without results" $
      validated (logged []) `shouldReturn` (ExitSuccess, "")
    it "accepts every report that a program of the explanations raises" $ do
      length everyReport `shouldSatisfy` (> 60)
      validated (logged everyReport) `shouldReturn` (ExitSuccess, "")
    it "accepts reports on a tape, on a file, without a file, and without an explanation" $
      validated (logged [onTape, onFile, onNothing, unexplained]) `shouldReturn` (ExitSuccess, "")
    it "refuses a log without its version (catches a test that does not ask the schema)" $ do
      (code, _) <- validated "{\"runs\": []}"
      code `shouldNotBe` ExitSuccess
  describe "a log" $ do
    it "is the same for the same reports" $
      logged everyReport `shouldBe` logged everyReport
    it "has each code that occurs as one rule, and the results refer to the rules" $ do
      let log' = decoded (logged (everyReport <> [onTape, onFile]))
          rules = log' `at` "runs" `at` "tool" `at` "driver" `at` "rules"
          ids = [i | r <- items rules, Just i <- [textAt r "id"]]
          results = items (log' `at` "runs" `at` "results")
      length ids `shouldSatisfy` (> 60)
      [textAt r "ruleId" | r <- results]
        `shouldBe` [ Just (ids !! i)
                     | r <- results,
                       Aeson.Success i <- [Aeson.fromJSON (r `at` "ruleIndex")]
                   ]
    it "counts columns in characters, and a region ends after its last character" $
      let region =
            head (items (decoded (logged [inProgram]) `at` "runs" `at` "results"))
              `at` "locations"
              `at` "physicalLocation"
              `at` "region"
       in region
            `shouldBe` object
              [ "startLine" .= (2 :: Int),
                "startColumn" .= (5 :: Int),
                "endLine" .= (2 :: Int),
                "endColumn" .= (8 :: Int)
              ]
    it "gives the row of a tape as one byte of the file" $
      head (items (decoded (logged [onTape]) `at` "runs" `at` "results"))
        `at` "locations"
        `at` "physicalLocation"
        `shouldBe` object
          [ "artifactLocation"
              .= object ["uri" .= ("x.tape" :: Text), "uriBaseId" .= ("%SRCROOT%" :: Text)],
            "region" .= object ["byteOffset" .= (299 :: Int), "byteLength" .= (1 :: Int)]
          ]
    it "has no location for a report without a file" $
      head (items (decoded (logged [onNothing]) `at` "runs" `at` "results"))
        `at` "locations" `shouldBe` Aeson.toJSON ([] :: [Value])
    it "doubles braces, because single ones would enclose placeholders" $
      head (items (decoded (logged [inProgram]) `at` "runs" `at` "results")) `at` "message"
        `shouldBe` object
          ["text" .= ("found ‘{{’\nOne sentence.\nhint: mill c outside {{ }}" :: Text)]
    it "has the other regions with their labels" $
      items
        ( head (items (decoded (logged [inProgram]) `at` "runs" `at` "results"))
            `at` "relatedLocations"
        )
        `shouldSatisfy` \case
          [one] -> one `at` "message" == object ["text" .= ("the part" :: Text)]
          _ -> False
  describe "GitHub" $ do
    it "finds the version of the schema, and the name and the version of partc" $ do
      let log' = decoded (logged [])
          driver = log' `at` "runs" `at` "tool" `at` "driver"
      textAt log' "version" `shouldBe` Just "2.1.0"
      textAt log' "$schema" `shouldSatisfy` maybe False ("https://" `Text.isPrefixOf`)
      textAt driver "name" `shouldBe` Just "partc"
      textAt driver "semanticVersion" `shouldBe` Just "1.2.3"
    it "finds the texts, the level and the tags of each rule" $ do
      let log' = decoded (logged everyReport)
          rules = items (log' `at` "runs" `at` "tool" `at` "driver" `at` "rules")
          missing r = filter (isNothing . textBelow r) ruleTexts
          isLong r key = Text.length (fromMaybe "" (textBelow r [key, "text"])) > 1024
      [(textAt r "id", missing r) | r <- rules, not (null (missing r))] `shouldBe` []
      [textAt r "id" | r <- rules, null (items (r `at` "properties" `at` "tags"))] `shouldBe` []
      -- GitHub takes at most 1,024 characters of a description.
      [textAt r "id" | r <- rules, any (isLong r) ["shortDescription", "fullDescription"]]
        `shouldBe` []
    it "finds a message, a place and a fingerprint of each result in a program" $ do
      let results = items (decoded (logged everyReport) `at` "runs" `at` "results")
          physical r = r `at` "locations" `at` "physicalLocation"
          missing r =
            filter (isNothing . textBelow r) resultTexts
              <> filter
                (isNothing . textBelow (physical r))
                [["artifactLocation", "uri"], ["artifactLocation", "uriBaseId"]]
          numbers r =
            map
              (numberAt (physical r `at` "region"))
              ["startLine", "startColumn", "endLine", "endColumn"]
      [(textAt r "ruleId", missing r) | r <- results, not (null (missing r))] `shouldBe` []
      [textAt r "ruleId" | r <- results, any (< 1) (numbers r)] `shouldBe` []
    it "finds the first line for a report on a file, and the file of an absolute path" $ do
      let physical filed' =
            head (items (decoded (logged [filed']) `at` "runs" `at` "results"))
              `at` "locations"
              `at` "physicalLocation"
      numberAt (physical onFile `at` "region") "startLine" `shouldBe` 1
      physical (without "/tmp/x.part" (report Error "E0801" InFile "cannot read"))
        `at` "artifactLocation"
        `shouldBe` object ["uri" .= ("file:///tmp/x.part" :: Text)]
  describe "uri" $ do
    it "keeps relative paths of letters, digits and -._~/ but drops a leading ./" $
      map Sarif.uri ["flange.part", "a/b-1_c~.part", "./x/y.part", "../x.part"]
        `shouldBe` ["flange.part", "a/b-1_c~.part", "x/y.part", "../x.part"]
    it "percent-encodes reserved characters and all that are not ASCII" $
      map Sarif.uri ["my part.part", "50%.part", "a#b?.part", "c:d.part", "<stdin>", "фланец.part"]
        `shouldBe` [ "my%20part.part",
                     "50%25.part",
                     "a%23b%3F.part",
                     "c%3Ad.part",
                     "%3Cstdin%3E",
                     "%D1%84%D0%BB%D0%B0%D0%BD%D0%B5%D1%86.part"
                   ]
    it "gives an absolute path as a file: address" $
      Sarif.uri "/tmp/my part.part" `shouldBe` "file:///tmp/my%20part.part"

-- | The log of reports, as the command writes it.
logged :: [Filed] -> Text
logged = Sarif.log "1.2.3.4" Explanation.everything

-- | Reports that the wrong programs of all explanations raise.
everyReport :: [Filed]
everyReport =
  [ Filed file source r
    | e <- Explanation.everything,
      let ReportCode c = Explanation.code e
          Example _ text = Explanation.wrong e
          file = "explain/" <> c <> ".part"
          source = Region.fromText file text,
      r <- Reports.onProgram source
  ]

inProgram, onTape, onFile, onNothing, unexplained :: Filed
inProgram =
  Filed "x.part" (Region.fromText "x.part" "part p \"Фланец\"\n😀 é ‘x’ {") $
    (report Error "E0101" (InSource (Region 20 23)) "found ‘{’")
      { message = ["One sentence."],
        hints = ["mill c outside { }"],
        others = [Label (Region 0 4) "the part"]
      }
onTape = without "x.tape" (report Error "E0601" (InTape 300) "row 300")
onFile = without "x.part" (report Warning "W0801" InFile "not proven")
onNothing = without "" (report Error "E0802" InFile "cannot write")
unexplained = without "x.part" (report Error "E9999" InFile "a code to come")

-- | A report on a file whose text is empty.
without :: Text -> Report -> Filed
without file = Filed file (Region.fromText file "")

decoded :: Text -> Value
decoded text = either error id (Aeson.eitherDecodeStrict (Encoding.encodeUtf8 text))

-- | A field of an object, or of the only item of a list.
at :: Value -> Text -> Value
at value key = case value of
  Aeson.Object fields | Just v <- KeyMap.lookup (Key.fromText key) fields -> v
  Aeson.Array vs | [one] <- toList vs -> one `at` key
  _ -> error ("no field " <> Text.unpack key)

-- | The paths of the fields of a rule that are texts.
ruleTexts :: [[Text]]
ruleTexts =
  [ ["shortDescription", "text"],
    ["fullDescription", "text"],
    ["help", "text"],
    ["help", "markdown"],
    ["defaultConfiguration", "level"],
    ["properties", "precision"],
    ["properties", "problem.severity"]
  ]

-- | The paths of the fields of a result that are texts.
resultTexts :: [[Text]]
resultTexts =
  [ ["ruleId"],
    ["level"],
    ["message", "text"],
    ["partialFingerprints", "primaryLocationLineHash"]
  ]

-- | The text at the end of a path of fields; nothing if a field is missing.
textBelow :: Value -> [Text] -> Maybe Text
textBelow value path = case (path, value) of
  ([], Aeson.String t) | t /= "" -> Just t
  (key : rest, Aeson.Object fields) ->
    KeyMap.lookup (Key.fromText key) fields >>= (`textBelow` rest)
  _ -> Nothing

-- | A number in a field; 0 if there is none.
numberAt :: Value -> Text -> Int
numberAt value key = case Aeson.fromJSON (value `at` key) of
  Aeson.Success n -> n
  Aeson.Error _ -> 0

textAt :: Value -> Text -> Maybe Text
textAt value key = case value `at` key of
  Aeson.String t -> Just t
  _ -> Nothing

items :: Value -> [Value]
items value = case value of
  Aeson.Array vs -> toList vs
  _ -> []

-- | Exit status and error text of Python's jsonschema for a log.
validated :: Text -> IO (ExitCode, String)
validated text = withSystemTempDirectory "partc" $ \folder -> do
  ByteString.writeFile (folder </> "log.sarif") (Encoding.encodeUtf8 text)
  (code, _, err) <-
    readProcessWithExitCode
      "python3"
      ["-c", program, "test/data/sarif-2.1.0-rtm.5.json", folder </> "log.sarif"]
      ""
  pure (code, err)
  where
    program =
      unlines
        [ "import json, sys, jsonschema",
          "schema, log = [json.load(open(f, encoding='utf-8')) for f in sys.argv[1:]]",
          "jsonschema.Draft4Validator.check_schema(schema)",
          "jsonschema.Draft4Validator(schema).validate(log)"
        ]
