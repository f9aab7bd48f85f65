module Drawing.DxfSpec
  ( spec,
  )
where

import Base.Quantity (LengthUnit (..), Mm (..), Rad (..))
import Control.Monad (forM_)
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.ByteString.Char8 qualified as Bytes
import Data.List (isSuffixOf, sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text qualified as Text
import Drawing.Drawing
import Drawing.Dxf (fromDxf)
import Drawing.Error (Container (..), DrawingFault (..), Error (Error))
import Drawing.Error qualified as Error
import Drawing.ExpectedDrawing (Expected (..), differences, readExpected)
import Drawing.ShapePoint (isOn, shapeAt)
import Files (filesBelow)
import Generate.Dxf (DxfText (..), Wanted (Wanted), dxfText)
import Geometry.Carrier (Circle (Circle))
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (..))
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "the reader of DXF files" $ do
  it "reads the entities that a file contains (catches a wrong order of an insertion's maps)" $
    withMaxSuccess 400 $
      forAll dxfText $ \DxfText {bytes, stated, wanted} -> case fromDxf stated bytes of
        Left errors -> counterexample (show errors) False
        Right drawing ->
          counterexample (show (entities drawing)) $
            remarks drawing === [] .&&. map facts (entities drawing) === map wantedFacts wanted
              .&&. and (zipWith alike (entities drawing) wanted)
  files <- runIO (sort . filter (".dxf" `isSuffixOf`) <$> filesBelow "test/data/drawings")
  it "has files of other programs" $ length files `shouldSatisfy` (>= 15)
  describe "reads the file of another program" $
    forM_ files $ \file -> it file $ do
      wanted <- readExpected (file <> ".expected.json")
      bytes <- ByteString.readFile file
      let stated = if unit wanted `elem` ["missing", "unitless"] then Just Millimetres else Nothing
      case fromDxf stated bytes of
        Left errors -> expectationFailure (show errors)
        Right drawing -> do
          differences wanted drawing `shouldBe` []
          sort (map snd (leftOut drawing)) `shouldBe` sort (readable (ignored wanted))
  units
  refusals
  details

-- | The line, the word and the layer of an entity.
facts :: Entity -> (Int, Text.Text, Text.Text)
facts e = (line e, word e, layer e)

wantedFacts :: Wanted -> (Int, Text.Text, Text.Text)
wantedFacts (Wanted l w onLayer _) = (l, w, onLayer)

alike :: Entity -> Wanted -> Bool
alike e (Wanted _ _ _ s) = and [isOn t (shapeAt t s) (shape e) | t <- [0, 0.05 .. 1]]

-- | The words of entities that were left out because they have no shape in the drawing.
leftOut :: Drawing -> [(Int, Text.Text)]
leftOut drawing =
  [(l, w) | Remark {remarkLine = l, remarkKind = kind} <- remarks drawing, Just w <- [wordOf kind]]
    <> [(line e, word e) | e@Entity {shape = Dot _} <- entities drawing]
  where
    wordOf kind = case kind of
      NotUnderstood w -> Just w
      NotInPlane w -> Just w
      _ -> Nothing

-- | The words of the file in place of those of the list.
readable :: [Text.Text] -> [Text.Text]
readable = map (fst . Text.breakOn ":")

units :: Spec
units = describe "units" $ do
  it "reads all units of the reference" $
    map (radiusOfCircle Nothing) [1 .. 24]
      `shouldBe` [ Just 25.4,
                   Just 304.8,
                   Nothing,
                   Just 1,
                   Just 10,
                   Just 1000,
                   Just 1e6,
                   Just 25.4e-6,
                   Just 0.0254,
                   Just 914.4,
                   Just 1e-7,
                   Just 1e-6,
                   Just 1e-3,
                   Just 100,
                   Just 1e4,
                   Just 1e5,
                   Nothing,
                   Nothing,
                   Nothing,
                   Nothing,
                   Just (1200e3 / 3937),
                   Just (100e3 / 3937),
                   Just (3600e3 / 3937),
                   Nothing
                 ]
  it "asks for a unit if the file has none" $
    faults (fromDxf Nothing (withHeader [])) `shouldBe` [(1, UnitMissing)]
  it "takes the unit of the program if the file has none" $
    radiusOfCircle (Just Inches) 0 `shouldBe` Just 25.4
  it "refuses a unit of the program that is not that of the file" $
    faults (fromDxf (Just Inches) (withHeader ["9", "$INSUNITS", "70", "4"]))
      `shouldBe` [(8, UnitConflict "mm" "in")]
  it "doubts a unit of metres or more if the drawing is very large (catches a part of 80 m)" $
    map
      (either (const Nothing) presumed . uncurry ofRadius)
      [("6", "5.1"), ("6", "4.9"), ("4", "5100"), ("7", "0.0051")]
      `shouldBe` [ Just (PresumedSize 8 (Just "m") (Mm 10200) (Mm 10200)),
                   Nothing,
                   Nothing,
                   Just (PresumedSize 8 (Just "km") (Mm 10200) (Mm 10200))
                 ]
  it "refuses the number of no unit" $
    faults (fromDxf Nothing (withHeader ["9", "$INSUNITS", "70", "77"]))
      `shouldBe` [(8, UnitUnknown "77")]
  where
    shown = Bytes.pack . show :: Int -> ByteString
    radiusOfCircle stated number =
      case fromDxf stated (withHeader ["9", "$INSUNITS", "70", shown number]) of
        Right Drawing {entities = [Entity {shape = FullCircle (Circle _ (Mm r))}]} -> Just r
        _ -> Nothing
    withHeader variables = withCircle variables "1"
    ofRadius number = fromDxf Nothing . withCircle ["9", "$INSUNITS", "70", number]
    withCircle variables r =
      Bytes.unlines (["0", "SECTION", "2", "HEADER"] <> variables <> ["0", "ENDSEC"])
        <> entitySection ["0", "CIRCLE", "10", "0", "20", "0", "40", r]

refusals :: Spec
refusals = describe "refuses" $ do
  it "the binary form" $ faults (inMm "AutoCAD Binary DXF\r\n\SUB\NUL") `shouldBe` [(1, BinaryDxf)]
  it "DWG files" $ faults (inMm "AC1032\NUL\NUL") `shouldBe` [(1, DwgFile "AC1032")]
  it "files of another kind" $ faults (inMm "<svg/>\n<g/>\n") `shouldBe` [(1, NotACode "<svg/>")]
  it "an empty file" $ faults (inMm "") `shouldBe` [(1, EndsEarly WholeFile)]
  it "a file without its end" $
    faults (inMm (Bytes.unlines ["0", "SECTION", "2", "ENTITIES", "0", "LINE", "10", "0"]))
      `shouldBe` [(8, EndsEarly WholeFile)]
  it "a file that ends within a group" $
    faults (inMm "0\nSECTION\n2") `shouldBe` [(3, EndsEarly Group)]
  it "a section without its end" $
    faults (inMm (Bytes.unlines ["0", "SECTION", "2", "ENTITIES", "0", "EOF"]))
      `shouldBe` [(2, EndsEarly OneSection)]
  it "a file without entities" $ faults (inMm "0\nEOF\n") `shouldBe` [(1, EndsEarly EntitySection)]
  it "numbers that are none, and reports all" $
    faults
      ( inMm . section $
          ["0", "CIRCLE", "10", "x", "20", "0", "40", "1"]
            <> ["0", "CIRCLE", "10", "0", "20", "nan", "40", "1"]
            <> ["0", "CIRCLE", "10", "0", "20", "0", "40", "1e999"]
      )
      `shouldBe` [(8, NotANumber "x"), (18, NotANumber "nan"), (28, NotANumber "1e999")]
  it "an entity without a coordinate" $
    faults (inMm (section ["0", "LINE", "10", "0", "20", "0", "11", "1"]))
      `shouldBe` [(6, ValueMissing "LINE" 21)]
  it "an entity out of reach" $
    faults (inMm (section ["0", "CIRCLE", "10", "2e6", "20", "0", "40", "1"]))
      `shouldBe` [(6, OutOfReach "CIRCLE")]
  it "an unknown block" $
    faults (inMm (section ["0", "INSERT", "2", "A", "10", "0", "20", "0"]))
      `shouldBe` [(6, BlockUnknown "A")]
  it "a block that contains itself" $
    faults (inMm (withBlocks [("A", insertOf "B" 1), ("b", insertOf "a" 1)] (insertOf "A" 1)))
      `shouldBe` [(38, Cycle ["a", "B", "a"])]
  it "blocks that multiply" $
    faults
      ( inMm
          ( withBlocks
              (("A0", circleAt 0) : [(name i, insertOf (name (i - 1)) 10) | i <- [1 .. 20]])
              (insertOf "A20" 10)
          )
      )
      `shouldBe` [(512, TooManyParts)]
  it "blocks that are nested too deeply" $
    map
      snd
      ( faults
          ( inMm
              ( withBlocks
                  (("A0", circleAt 0) : [(name i, insertOf (name (i - 1)) 1) | i <- [1 .. 70]])
                  (insertOf "A70" 1)
              )
          )
      )
      `shouldBe` [TooDeep]
  where
    name i = "A" <> Bytes.pack (show (i :: Int))

details :: Spec
details = describe "details" $ do
  it "gives an entity on layer 0 the layer of the insertion" $
    map layer (drawn (withBlocks [("A", circleAt 0)] (insertOf "a" 1))) `shouldBe` ["CUT"]
  it "reads arcs by angles that pass 0°" $
    map shape (drawn (section (circlePairs "ARC" <> ["50", "270", "51", "90"])))
      `shouldSatisfy` \case
        [Path Open (Plain Arc {sweep = Rad s} :| [])] -> abs (s - pi) < 1e-12
        _ -> False
  it "reads a circle seen from behind" $
    map shape (drawn (section (circlePairs "CIRCLE" <> ["210", "0", "220", "0", "230", "-1"])))
      `shouldBe` [FullCircle (Circle (Vec.point (-3) 4) (Mm 2))]
  it "leaves out entities in other planes" $
    leftOutOf (circlePairs "CIRCLE" <> ["210", "1", "220", "0", "230", "0"])
      `shouldBe` [NotInPlane "CIRCLE"]
  it "leaves out lines that rise" $
    leftOutOf ["0", "LINE", "10", "0", "20", "0", "30", "1", "11", "1", "21", "0", "31", "2"]
      `shouldBe` [NotInPlane "LINE"]
  it "leaves out invisible entities and those on pages for printing" $
    leftOutOf (circlePairs "CIRCLE" <> ["60", "1"] <> circlePairs "CIRCLE" <> ["67", "1"])
      `shouldBe` [Invisible "CIRCLE", InPaperSpace "CIRCLE"]
  it "leaves out a spline that is given by points only" $
    leftOutOf ["0", "SPLINE", "70", "8", "71", "3", "11", "0", "21", "0", "11", "1", "21", "1"]
      `shouldBe` [ThroughPoints "SPLINE"]
  it "leaves out entities without size" $
    map
      (\x -> leftOutOf ["0", "LINE", "10", "0", "20", "0", "11", x, "21", "0"])
      ["0", "0.000001", "0.00001"]
      `shouldBe` [[Unusable "LINE" "its length is 0"], [Unusable "LINE" "its length is 0"], []]
  it "closes polylines that return to their start but for rounding" $
    map
      shape
      ( drawn . section $
          ["0", "LWPOLYLINE", "70", "1"]
            <> concat [["10", x, "20", y] | (x, y) <- [("0", "0"), ("5", "0"), ("5", "2")]]
            <> ["10", "0.00000000000001", "20", "0"]
      )
      `shouldBe` [ Path
                     Closed
                     ( line' (0, 0) (5, 0)
                         :| [line' (5, 0) (5, 2), line' (5, 2) (0, 0)]
                     )
                 ]
  it "reads the vertices of a smoothed polyline, not its frame" $
    (map shape (drawn smoothed), map remarkKind (either (const []) remarks (inMm smoothed)))
      `shouldBe` ( [ Path Open (Plain (Straight (Vec.point 0 0) (Vec.point 2 1)) :| [])
                   ],
                   [Smoothed "POLYLINE"]
                 )
  it "reads the code page of older files, and refuses others" $ do
    map layer (drawn (codePage "ANSI_1251" "\xCA\xEE\xED\xF2\xF3\xF0")) `shouldBe` ["Контур"]
    map layer (drawn (codePage "dos866" "\x8A\xAE\xAD\xE2\xE3\xE0")) `shouldBe` ["Контур"]
    map layer (drawn (codePage "ANSI_1252" "\\U+041a\\U+D83D\\U+DE00")) `shouldBe` ["К😀"]
    faults (inMm (codePage "ANSI_932" "\x83\x4A")) `shouldBe` [(24, CodePageUnknown "ANSI_932")]
    faults (inMm (codePage "ANSI_1252" "\x81")) `shouldBe` [(24, NotInEncoding "ANSI_1252")]
  it "has words for every fault" $
    [ Error.message (Error 7 (NotANumber (Text.replicate 60 "x"))),
      Error.title (Error 7 TooDeep),
      Text.unwords (Error.hints (Error 7 UnitMissing))
    ]
      `shouldBe` [ "Line 7: ‘" <> Text.replicate 40 "x" <> "…’ has to be a number.",
                   "The drawing is nested too deeply",
                   "State the unit: write unit mm or unit in after the file and the layer, or \
                   \--unit for partc import."
                 ]
  where
    line' (a, b) (c, d) = Plain (Straight (Vec.point a b) (Vec.point c d))
    drawn bytes = either (const []) entities (inMm bytes)
    leftOutOf pairs = either (const []) (map remarkKind . remarks) (inMm (section pairs))
    vertex x y flags = ["0", "VERTEX", "10", x, "20", y, "70", flags]
    smoothed =
      section $
        ["0", "POLYLINE", "66", "1", "70", "4"]
          <> vertex "0" "0" "16"
          <> vertex "0" "0" "8"
          <> vertex "5" "5" "16"
          <> vertex "2" "1" "8"
          <> ["0", "SEQEND"]
    codePage page name =
      Bytes.unlines
        ["0", "SECTION", "2", "HEADER", "9", "$DWGCODEPAGE", "3", page, "0", "ENDSEC"]
        <> entitySection (circlePairs "CIRCLE" <> ["8", name])

-- Texts ---------------------------------------------------------------------------------------

inMm :: ByteString -> Either (NonEmpty Error) Drawing
inMm = fromDxf (Just Millimetres)

faults :: Either (NonEmpty Error) Drawing -> [(Int, DrawingFault)]
faults = either (map (\(Error l f) -> (l, f)) . NonEmpty.toList) (const [])

section :: [ByteString] -> ByteString
section = entitySection

-- | The section of entities and the end of a file.
entitySection :: [ByteString] -> ByteString
entitySection pairs =
  Bytes.unlines (["0", "SECTION", "2", "ENTITIES"] <> pairs <> ["0", "ENDSEC", "0", "EOF"])

-- | A file with blocks, each by its name and its entities.
withBlocks :: [(ByteString, [ByteString])] -> [ByteString] -> ByteString
withBlocks blocks pairs =
  Bytes.unlines (["0", "SECTION", "2", "BLOCKS"] <> concatMap block blocks <> ["0", "ENDSEC"])
    <> entitySection pairs
  where
    block (name, own) = ["0", "BLOCK", "2", name, "10", "0", "20", "0"] <> own <> ["0", "ENDBLK"]

insertOf :: ByteString -> Int -> [ByteString]
insertOf name columns =
  ["0", "INSERT", "8", "CUT", "2", name, "10", "0", "20", "0", "70", count, "44", "1"]
  where
    count = Bytes.pack (show columns)

circleAt :: Int -> [ByteString]
circleAt x = ["0", "CIRCLE", "8", "0", "10", Bytes.pack (show x), "20", "0", "40", "1"]

circlePairs :: ByteString -> [ByteString]
circlePairs name = ["0", name, "10", "3", "20", "4", "40", "2"]
