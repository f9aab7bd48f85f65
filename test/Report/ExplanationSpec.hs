-- | Every code has an explanation, and its examples are right: the wrong program raises the code,
-- the corrected one raises no report.
module Report.ExplanationSpec (spec) where

import Base.Region qualified as Region
import Codes qualified
import Control.Monad (forM_)
import Data.ByteString qualified as ByteString
import Data.Either (lefts, rights)
import Data.List (nub, sort)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Files (readText)
import Report.Embedded qualified as Embedded
import Report.Explanation (Example (..), Explanation (..), Language (..))
import Report.Explanation qualified as Explanation
import Report.Report (ReportCode (..), ReportPlace (..))
import Report.Report qualified as Report
import Reports qualified
import System.Directory (listDirectory)
import System.FilePath (dropExtension, takeExtension, (</>))
import Test.Hspec hiding (Example)

-- | The codes that no part program can raise, grouped by what raises them. Their examples are lines
-- of a terminal or rows of a tape; those of all other codes are programs.
raisedElsewhere :: [(String, [Text])]
raisedElsewhere =
  [ ("a program that no page holds", ["E0116"]),
    ("coordinates that rounding only just tells apart", ["E0368"]),
    ("a tape or a file", ["E0601", "E0602", "E0603"]),
    ("a tape that is made, which a check of the program does not do", ["W0507"]),
    ( "an input sheet",
      [ "E0901",
        "E0902",
        "E0903",
        "E0904",
        "E0905",
        "E0906",
        "E0907",
        "E0908",
        "E0909",
        "E0910",
        "E0911",
        "E0912",
        "E0913",
        "E0914"
      ]
    ),
    ( "a program that is to become a sheet",
      ["E0921", "E0922", "E0923", "E0924", "E0925", "E0926", "E0927"]
    ),
    ( "the description of a machine",
      [ "E1001",
        "E1002",
        "E1003",
        "E1004",
        "E1005",
        "E1006",
        "E1007",
        "E1008",
        "E1009",
        "E1010",
        "E1011",
        "E1012",
        "E1013",
        "E1014",
        "E1015"
      ]
    ),
    ( "a tape and its program",
      [ "E0701",
        "E0702",
        "E0703",
        "E0704",
        "E0705",
        "E0706",
        "E0707",
        "E0708",
        "E0709",
        "E0710",
        "E0711",
        "E0712",
        "E0713",
        "E0714",
        "E0715",
        "E0716",
        "E0717",
        "E0718",
        "E0719",
        "E0720",
        "E0721",
        "E0722",
        "E0723",
        "E0724",
        "E0725",
        "E0726",
        "E0727",
        "E0728",
        "E0729",
        "E0730",
        "E0731",
        "E0732",
        "E0733",
        "E0734",
        "E0735",
        "E0736",
        "E0737",
        "E0738",
        "E0739",
        "E0740",
        "E0741",
        "E0742",
        "E0747",
        "E0748",
        "E0750"
      ]
    ),
    ( "files and the command line",
      [ "E0112",
        "E0113",
        "E0114",
        "E0115",
        "E0117",
        "E0118",
        "E0119",
        "E0123",
        "E0124",
        "E0125",
        "E0126",
        "E0127",
        "E0801",
        "E0802",
        "E0803",
        "E0804",
        "E0805",
        "E0806",
        "E0807",
        "E0808",
        "E0809",
        "E0810",
        "E0811",
        "E0812",
        "E0815",
        "E0816",
        "E0817",
        "E0818",
        "E0819",
        "E0820",
        "E0821",
        "E0822",
        "E0823",
        "E0824",
        "W0101",
        "W0102",
        "W0103",
        "W0104",
        "W0105",
        "W0801",
        "W0802"
      ]
    )
  ]

-- | Control stops of the Minsk-22 system. If a report mentions one of them, so does its
-- explanation.
controlStops :: [Text]
controlStops = ["14174", "14441", "14623", "15074", "17533", "17535"]

spec :: Spec
spec = do
  names <- runIO (sort . filter ((== ".md") . takeExtension) <$> listDirectory "explain")
  found <- runIO (traverse readOne names)
  describe "the folder explain/" $ do
    it "explains every code of the sources, and no other" $ do
      codes <- Codes.inSources
      let explained = Set.fromList (map (Text.pack . dropExtension) names)
          lacking c = "the code " <> c <> " lacks an explanation: write explain/" <> c <> ".md"
          needless c = "no report has the code " <> c <> ": explain/" <> c <> ".md explains nothing"
      map lacking (Set.toList (Set.difference codes explained)) `shouldBe` []
      map needless (Set.toList (Set.difference explained codes)) `shouldBe` []
    it
      "has files of one form: # CODE: title, paragraphs, a block ```part wrong or ```text wrong, a \
      \block with right"
      $ [file <> " is not of this form" | file <- lefts found] `shouldBe` []
    it "is embedded in the program unchanged" $ do
      contents <- traverse (ByteString.readFile . ("explain" </>)) names
      sort (map fst Embedded.files) `shouldBe` names
      [file | (file, content) <- zip names contents, lookup file Embedded.files /= Just content]
        `shouldBe` []
    it "fits a terminal of 80 columns" $
      [(code e, l) | e <- rights found, l <- Text.lines (Explanation.render e), Text.length l > 80]
        `shouldBe` []
  describe "explanations" $
    forM_ (rights found) $ \e -> do
      let ReportCode c = code e
      it (Text.unpack (c <> " " <> title e)) $
        if c `elem` concatMap snd raisedElsewhere
          then languageOf (wrong e) `shouldBe` Session
          else do
            (languageOf (wrong e), languageOf (right e)) `shouldBe` (Part, Part)
            let reports = reportsOn (wrong e)
            nub (map Report.code reports) `shouldBe` [code e]
            map Report.place reports `shouldSatisfy` all isInSource
            let isNamedIn stop r =
                  Report.controlStop r == Just stop || any (Text.isInfixOf stop) (Report.message r)
                isReported stop = any (isNamedIn stop) reports
                isExplained stop = Text.isInfixOf stop (prose e)
            filter (\stop -> isReported stop /= isExplained stop) controlStops `shouldBe` []
            -- The machine of the examples does not drive the z axis, so drilling raises a warning.
            let isUnwanted r =
                  Report.isError r
                    || Report.code r == code e
                    || Report.code r `notElem` ["W0503", "W0504"]
            map Report.title (filter isUnwanted (reportsOn (right e))) `shouldBe` []
  describe "find" $ do
    let codes = [c | e <- Explanation.everything, let ReportCode c = code e]
        asked word = [c | e <- Explanation.find word, let ReportCode c = code e]
    it "finds every code as a report writes it" $
      [c | c <- codes, asked c /= [c] || asked ("error[" <> c <> "]") /= [c]] `shouldBe` []
    it "accepts small letters, spaces, and codes without letter or leading zeros" $
      map asked ["e0314", " E314 ", "314", "w501", "0314"]
        `shouldBe` [["E0314"], ["E0314"], ["E0314"], ["W0501"], ["E0314"]]
    it "finds the error and the warning of a number without a letter" $
      asked "501" `shouldBe` ["E0501", "W0501"]
    it "finds nothing for a word that is no code" $
      map asked ["", "E", "E9999", "EE314", "E03l4", "E31415", "E00000314 5"]
        `shouldBe` replicate 7 []
  describe "near" $ do
    it "suggests a code with two digits exchanged" $
      take 1 (Explanation.near "E0250") `shouldBe` ["E0205"]
    it "suggests the code with the other letter" $
      Explanation.near "w0314" `shouldBe` ["E0314"]
    it "suggests neighbours of a number that no code has" $
      Explanation.near "E0400" `shouldSatisfy` elem "E0401"
    it "suggests nothing for a word that is no code" $
      map Explanation.near ["", "tangent", "E9999"] `shouldBe` [[], [], []]
  where
    readOne file =
      maybe (Left file) Right . Explanation.parse file <$> readText ("explain" </> file)
    languageOf (Example language _) = language
    reportsOn (Example _ text) = Reports.onProgram (Region.fromText "example" text)
    isInSource place = case place of
      InSource _ -> True
      InTape _ -> False
      InFile -> False
      InCommandLine -> False
