-- | Drawings that become programs, and these programs drawings again.
module Export.DrawingBackSpec
  ( spec,
  )
where

import Base.Quantity (LengthUnit (Millimetres), Mm (..))
import Base.Result (Result (..))
import Base.Result qualified as Result
import Compile (Analysis (Analysis))
import Compile qualified
import Control.Monad (forM_)
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.List (deleteFirstsBy, isInfixOf, isSuffixOf, sort)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Semigroup (sconcat)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Drawing.Drawing (Entity)
import Drawing.Drawing qualified as Drawing
import Drawing.Dxf qualified as Dxf
import Drawing.Outline qualified as Outline
import Drawing.OutlineTolerance qualified as Tolerance
import Drawing.PathPart qualified as PathPart
import Drawing.Svg qualified as Svg
import Export.Dxf qualified as ExportedDxf
import Export.FromPart qualified as Export
import Files (filesBelow)
import Generate.Area (area)
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Numeric (showFFloat)
import Project.LoadedProgram qualified as LoadedProgram
import Surface.DrawingProgram qualified as DrawingProgram
import System.FilePath (takeExtension, takeFileName)
import Test.Hspec
import Test.QuickCheck hiding (Result (..))

spec :: Spec
spec = describe "from a drawing to a program and back" $ do
  files <- runIO (sort <$> filesBelow "test/data/drawings")
  forM_ [f | f <- files, takeExtension f `elem` [".dxf", ".svg"]] $ \file ->
    it ("keeps areas and lengths of " <> takeFileName file) $ do
      content <- ByteString.readFile file
      let sizes = sizesOf (entitiesOf file content)
          found = sizesOf (back file content)
      [(sizes, found) | not (agree 2e-5 sizes found)] `shouldBe` []
  it "keeps areas and lengths of lines and arcs to 1e-9 (catches bulges with few digits)" $
    property $
      forAll area $ \loops ->
        let content = dxfOf loops
            sizes = sizesOf (entitiesOf "area.dxf" content)
            found = sizesOf (back "area.dxf" content)
         in counterexample (show (sizes, found)) $
              not (null sizes) .&&. agree 0 sizes found
  where
    stated file = if "_r12" `isInfixOf` file then Just Millimetres else Nothing
    entitiesOf file content = either (const []) Drawing.entities (reader file (stated file) content)
    reader file = if ".svg" `isSuffixOf` file then Svg.fromSvg else Dxf.fromDxf
    back file content = case programOf file (stated file) content >>= exported of
      Just text ->
        [ e
          | e <- entitiesOf "back.dxf" (Encoding.encodeUtf8 text),
            Drawing.layer e == "PART"
        ]
      Nothing -> []

-- | The program of a drawing; Nothing if the drawing has a mistake.
programOf :: FilePath -> Maybe LengthUnit -> ByteString -> Maybe Text
programOf file stated content =
  output
    (DrawingProgram.convert (Text.pack file) stated Tolerance.joining [] shown content)
  where
    shown = Encoding.decodeLatin1 content

-- | The DXF drawing of a program; Nothing if the program has a mistake.
exported :: Text -> Maybe Text
exported text = do
  Analysis {Compile.part = part, Compile.path = path} <-
    Result.ifSound (Compile.analyse [] (LoadedProgram.fromText "p.part" text))
  pure (ExportedDxf.document (Export.drawing part path))

-- | The area and the length of each outline of some entities, in ascending order, without circles,
-- which may become tables. The area of an open outline is 0.
sizesOf :: [Entity] -> [(Double, Double)]
sizesOf entities =
  sort . filter (not . isCircle) $
    [ (areaOf (Outline.ends o) ss, lengthOf ss)
      | o <- Outline.outlines (Outline.joined Tolerance.joining entities),
        let ss = sconcat (fmap (PathPart.segments . Outline.part) (Outline.parts o))
    ]
  where
    isCircle (a, l) = l * l - 4 * pi * a < 1e-6 * l * l
    areaOf closing ss = case closing of
      Closed -> abs (Polyarc.signedArea (Polyarc Closed ss))
      Open -> 0
    lengthOf :: NonEmpty Segment -> Double
    lengthOf ss = sum [l | s <- NonEmpty.toList ss, let Mm l = Segment.length s]

-- | True for equal counts of outlines with areas and lengths that agree to 1e-9 of them, or whose
-- boundaries are at most @off@ mm from each other.
agree :: Double -> [(Double, Double)] -> [(Double, Double)] -> Bool
agree off sizes found = null (deleteFirstsBy near sizes found) && length sizes == length found
  where
    near (a, l) (b, m) =
      abs (a - b) <= 1e-9 * a + off * l && abs (l - m) <= 1e-9 * l + 100 * off

-- | A DXF file of closed polylines with bulges.
dxfOf :: NonEmpty Polyarc -> ByteString
dxfOf loops =
  Encoding.encodeUtf8 . Text.unlines $
    ["0", "SECTION", "2", "HEADER", "9", "$INSUNITS", "70", "4", "0", "ENDSEC"]
      <> ["0", "SECTION", "2", "ENTITIES"]
      <> concatMap polyline (NonEmpty.toList loops)
      <> ["0", "ENDSEC", "0", "EOF"]
  where
    polyline loop =
      let ss = concatMap halves (NonEmpty.toList (segments loop))
       in ["0", "LWPOLYLINE", "8", "CUT", "90", Text.pack (show (length ss)), "70", "1"]
            <> concatMap vertex ss
    vertex s =
      let p = Segment.start s
       in ["10", number (Vec.x p), "20", number (Vec.y p), "42", number (Segment.bulge s)]
    -- A full circle has no bulge.
    halves s
      | Segment.start s == Segment.end s = [Segment.between 0 0.5 s, Segment.between 0.5 1 s]
      | otherwise = [s]
    number v = Text.pack (showFFloat (Just 16) v "")
