module Drawing.SvgSpec
  ( spec,
  )
where

import Base.Quantity (LengthUnit (..), Mm (..))
import Control.Monad (forM_)
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.ByteString.Char8 qualified as Bytes
import Data.List (isSuffixOf, sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text.Encoding qualified as Encoding
import Drawing.Drawing
import Drawing.Error (DrawingFault (..), Error (Error))
import Drawing.ExpectedDrawing (Expected (ignored), differences, readExpected)
import Drawing.PathPart qualified as PathPart
import Drawing.ShapePoint (isOn, shapeAt)
import Drawing.Svg (fromSvg)
import Files (filesBelow)
import Generate.Dxf (Wanted (Wanted))
import Generate.RelativePath (RelativePath (..), relativePath)
import Generate.Svg (SvgText (..), svgText)
import Geometry.Carrier (Circle (Circle))
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (..))
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck (counterexample, forAll, property, withMaxSuccess, (.&&.), (===))

spec :: Spec
spec = describe "the reader of SVG files" $ do
  it "reads the elements that a file contains (catches the large arc for the small one)" $
    withMaxSuccess 600 $
      forAll svgText $ \SvgText {svgBytes, svgWanted} -> case reading svgBytes of
        Left errors -> counterexample (show errors) False
        Right drawing ->
          counterexample (show (entities drawing)) $
            remarks drawing === []
              .&&. map facts (entities drawing) === map wantedFacts svgWanted
              .&&. and (zipWith alike (entities drawing) svgWanted)
  it
    "closes relative paths with as many elements as they have steps (catches a short line back to \
    \the start)"
    $ property $
      forAll relativePath $ \RelativePath {steps, svgOfPath} ->
        case shapes (reading svgOfPath) of
          [Path Closed parts'] ->
            let list = NonEmpty.toList parts'
             in length list === length steps
                  .&&. map PathPart.end list
                    === drop 1 (map PathPart.start list) <> take 1 (map PathPart.start list)
          found -> counterexample (show found) False
  files <- runIO (sort . filter (".svg" `isSuffixOf`) <$> filesBelow "test/data/drawings")
  it "has files of other programs" $ length files `shouldSatisfy` (>= 8)
  describe "reads the file of another program" $
    forM_ files $ \name -> it name $ do
      wanted <- readExpected (name <> ".expected.json")
      bytes <- ByteString.readFile name
      case reading bytes of
        Left errors -> expectationFailure (show errors)
        Right drawing -> do
          differences wanted drawing `shouldBe` []
          [w | Remark {remarkKind = NotUnderstood w} <- remarks drawing] `shouldBe` ignored wanted
  pathsOf
  structure
  units
  refusals

facts :: Entity -> (Int, Text, Text)
facts e = (line e, word e, layer e)

wantedFacts :: Wanted -> (Int, Text, Text)
wantedFacts (Wanted l w onLayer _) = (l, w, onLayer)

alike :: Entity -> Wanted -> Bool
alike e (Wanted _ _ _ s) = and [isOn t (shapeAt t s) (shape e) | t <- [0, 0.05 .. 1]]

pathsOf :: Spec
pathsOf = describe "paths" $ do
  it "reads numbers that run together" $
    shapes (path "M1-2.5.5e1.5l-.5.5")
      `shouldBe` [Path Open (straight (1, 2.5) (5, -0.5) :| [straight (5, -0.5) (4.5, -1)])]
  it "reads implicit lines after a move" $
    shapes (path "m 1 1 2 0 0 2z")
      `shouldBe` [ Path
                     Closed
                     ( straight (1, -1) (3, -1)
                         :| [straight (3, -1) (3, -3), straight (3, -3) (1, -1)]
                     )
                 ]
  it "begins a subpath where the closed one began" $
    shapes (path "M 1 1 h 2 v 2 z h -1")
      `shouldSatisfy` \case
        [Path Closed _, Path Open (part :| [])] -> part == straight (1, -1) (0, -1)
        _ -> False
  it "reads flags of arcs that touch" $
    shapes (path "M0 0a5 5 0 0110 0")
      `shouldSatisfy` \case
        [Path Open (Plain Arc {centre = c} :| [])] -> Vec.distance c (Vec.point 5 0) < Mm 1e-12
        _ -> False
  it "lengthens radii that are too short" $
    shapes (path "M0 0A1 1 0 0 1 10 0")
      `shouldSatisfy` \case
        [Path Open (Plain Arc {centre = c} :| [])] -> Vec.distance c (Vec.point 5 0) < Mm 1e-12
        _ -> False
  it "takes an arc with a radius of 0 for a line" $
    shapes (path "M0 0A0 1 0 0 1 10 0") `shouldBe` [Path Open (straight (0, 0) (10, 0) :| [])]
  it "leaves out what has no length" $
    kinds (path "M0 0L0 0") `shouldBe` [Unusable "path" "its length is 0"]
  where
    straight (a, b) (c, d) = Plain (Straight (Vec.point a b) (Vec.point c d))
    path d = inMm ("<path d='" <> d <> "'/>")

structure :: Spec
structure = describe "the structure" $ do
  it "keeps identifiers and classes from the inside" $
    map
      (\e -> (identifiers e, classes e, layer e))
      ( drawn . inMm $
          "<g id='a' class='x y' inkscape:groupmode='layer' inkscape:label='L'><g id='b'>"
            <> "<circle id='c' class='z' r='1'/></g></g>"
      )
      `shouldBe` [(["c", "b", "a"], ["z", "x", "y"], "L")]
  it "draws symbols in the area of their use only" $
    shapes
      ( inMm $
          "<symbol id='s' viewBox='0 0 10 10'><circle cx='5' cy='5' r='5'/></symbol>"
            <> "<use href='#s' x='20' y='30' width='20' height='20'/>"
      )
      `shouldBe` [FullCircle (Circle (Vec.point 30 (-40)) (Mm 10))]
  it "places nested areas" $
    shapes
      (inMm "<svg x='10' y='20' width='20' height='40' viewBox='0 0 10 10'><circle r='1'/></svg>")
      `shouldBe` [FullCircle (Circle (Vec.point 10 (-30)) (Mm 2))]
  it "takes shares of the area" $
    shapes (inMm "<svg width='20' height='40'><line x2='50%' y2='25%'/></svg>")
      `shouldBe` [Path Open (Plain (Straight (Vec.point 0 0) (Vec.point 10 (-10))) :| [])]
  it "draws no definitions" $
    shapes (inMm "<defs><circle r='1'/></defs><clipPath><circle r='1'/></clipPath>") `shouldBe` []
  it "leaves out what is not visible, with remarks" $
    kinds
      ( inMm $
          "<g display='none'><circle r='1'/></g><circle r='1' style='display : none'/>"
            <> "<g visibility='hidden'><rect width='1' height='1'/>"
            <> "<circle r='1' visibility='visible'/></g>"
      )
      `shouldBe` [Invisible "circle", Invisible "g", Invisible "rect"]
  it "leaves out texts and images, with remarks" $
    kinds (inMm "<text>a<tspan>b</tspan></text><image href='x.png'/><foreignObject/>")
      `shouldBe` [NotUnderstood "foreignObject", NotUnderstood "image", NotUnderstood "text"]
  it "remarks that what is clipped is read as a whole" $
    kinds (inMm "<circle r='1' clip-path='url(#c)'/>") `shouldBe` [Unclipped "circle"]
  it "reads other encodings" $ do
    layers ("\xEF\xBB\xBF" <> file (onLayer (Encoding.encodeUtf8 "Ж"))) `shouldBe` ["Ж"]
    layers ("<?xml version='1.0' encoding='windows-1251'?>" <> file (onLayer "\xC6"))
      `shouldBe` ["Ж"]
    layers (Encoding.encodeUtf16LE ("\xFEFF" <> Encoding.decodeUtf8 (file (onLayer "A"))))
      `shouldBe` ["A"]
  where
    onLayer name =
      "<g inkscape:groupmode='layer' inkscape:label='" <> name <> "'><circle r='1'/></g>"

units :: Spec
units = describe "units" $ do
  it "takes the unit of the program for user units if the file names none" $
    map
      (shapes . fromSvg (Just Inches) . withPage)
      ["", "width='50' height='30px'", "viewBox='1 -2 8 4'", "width='100%' viewBox='1 -2 8 4'"]
      `shouldBe` [ [circleAt 50.8 0 25.4],
                   [circleAt 50.8 762 25.4],
                   [circleAt 25.4 50.8 25.4],
                   [circleAt 25.4 50.8 25.4]
                 ]
  it "refuses a unit of the program that is not that of the file" $ do
    let inCentimetres = withPage "width='5cm' height='4' viewBox='0 0 50 40'"
    faults (fromSvg (Just Inches) (withPage "width='5mm' height='4mm'"))
      `shouldBe` [(1, UnitConflict "mm" "in")]
    faults (fromSvg (Just Millimetres) inCentimetres) `shouldBe` [(1, UnitConflict "cm" "mm")]
    shapes (fromSvg (Just Inches) (withPage "height='4in' viewBox='0 0 8 4'"))
      `shouldBe` [circleAt 50.8 101.6 25.4]
  it "tells the size that pixels give if nobody names a unit" $
    map
      (either (const Nothing) presumed . reading . withPage)
      ["width='96' height='48px'", "viewBox='0 0 960 96'", "", "width='9mm'"]
      `shouldBe` [ Just (PresumedSize 1 Nothing (Mm 25.4) (Mm 12.7)),
                   Just (PresumedSize 1 Nothing (Mm 254) (Mm 25.4)),
                   Just (PresumedSize 1 Nothing (Mm (3 * pixel - pixel)) (Mm (2 * pixel))),
                   Nothing
                 ]
  where
    pixel = 25.4 / 96
    withPage attributes = "<svg " <> attributes <> "><circle cx='2' r='1'/></svg>"
    circleAt x y r = FullCircle (Circle (Vec.point x y) (Mm r))

refusals :: Spec
refusals = describe "refuses" $ do
  it "texts that are no XML" $ do
    faults (reading "0\nSECTION\n") `shouldBe` [(1, NotXml "it has no element.")]
    faults (reading "<svg>\n<g>\n</svg>") `shouldBe` [(3, NotXml "this tag ends no element.")]
    faults (reading "<svg>\n<g>\n</g>") `shouldBe` [(1, NotXml "this element has no end.")]
    faults (reading "<svg>\n<g x=1/></svg>") `shouldBe` [(2, NotXml "this is not well-formed XML.")]
  it "other files of XML" $ faults (reading "\n<html/>") `shouldBe` [(2, NotSvg "html")]
  it "attributes with mistakes, and reports all" $
    faults
      ( reading $
          "<svg>\n<path d='M 0 0 L 1'/>\n<g transform='turn(3)'/>\n"
            <> "<circle r='2em'/></svg>"
      )
      `shouldBe` [ (2, WrongAttribute "path" "d" ""),
                   (3, WrongAttribute "g" "transform" "turn(3)"),
                   (4, WrongAttribute "circle" "r" "2em")
                 ]
  it "elements that use themselves" $
    faults (inMm "<g id='a'><use href='#b'/></g>\n<g id='b'><use href='#a'/></g>")
      `shouldBe` [(1, Cycle ["b", "a", "b"]), (2, Cycle ["a", "b", "a"])]
  it "elements that are not there" $
    faults (inMm "<use href='#x'/>") `shouldBe` [(1, ReferenceUnknown "x")]
  it "uses that multiply" $
    kindsOf (inMm ("<g id='u0'/>" <> foldMap doubled [1 .. 40 :: Int] <> "<use href='#u40'/>"))
      `shouldBe` [TooManyParts]
  it "entities that multiply" $
    kindsOf (reading (withEntity "'aaa'" <> repeated 30000 "&a;" <> "</svg>"))
      `shouldBe` [NotXml "it has too many references to entities."]
  it "files outside" $
    shapes (reading (withEntity "SYSTEM 'file:///etc/passwd'" <> "&a;<circle r='96'/></svg>"))
      `shouldBe` [FullCircle (Circle (Vec.point 0 0) (Mm 25.4))]
  it "elements that are nested too deeply" $
    kindsOf (inMm (repeated 600 "<g>" <> repeated 600 "</g>"))
      `shouldBe` [TooDeep]
  where
    doubled i =
      let shown = Bytes.pack (show i)
          below = Bytes.pack (show (i - 1))
          row = "<use href='#u" <> below <> "'/>"
       in "<defs><g id='u" <> shown <> "'>" <> row <> row <> "</g></defs>"
    withEntity value = "<!DOCTYPE svg [<!ENTITY a " <> value <> ">]><svg>"
    repeated count text = Bytes.concat (replicate count text)
    kindsOf = map snd . faults

-- Texts ---------------------------------------------------------------------------------------

-- | The drawing of a file for which the program states no unit.
reading :: ByteString -> Either (NonEmpty Error) Drawing
reading = fromSvg Nothing

-- | A file whose user unit is 1 mm and whose upper edge lies at 0.
inMm :: ByteString -> Either (NonEmpty Error) Drawing
inMm body = reading (file body)

file :: ByteString -> ByteString
file body =
  "<svg xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' width='100mm' height='0.0mm'"
    <> " preserveAspectRatio='xMinYMin slice' viewBox='0 0 100 100'>"
    <> body
    <> "</svg>"

drawn :: Either (NonEmpty Error) Drawing -> [Entity]
drawn = either (const []) entities

shapes :: Either (NonEmpty Error) Drawing -> [Shape]
shapes = map shape . drawn

kinds :: Either (NonEmpty Error) Drawing -> [RemarkKind]
kinds = either (const []) (map remarkKind . remarks)

layers :: ByteString -> [Text]
layers = map layer . drawn . reading

faults :: Either (NonEmpty Error) Drawing -> [(Int, DrawingFault)]
faults = either (map (\(Error l f) -> (l, f)) . NonEmpty.toList) (const [])
