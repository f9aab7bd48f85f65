-- | Drawings of the examples for CAD programs, read by libraries of other people.
module Export.FromPartSpec (spec) where

import Base.Name (Name (..))
import Base.Quantity (Mm (..), Rad (..), millimetresIn)
import Base.Region (Located (..))
import Base.Result qualified as Result
import Command (inFolder)
import Compile (Analysis (..))
import Compile qualified
import Data.Aeson (Value, object, (.=))
import Data.Aeson qualified as Aeson
import Data.ByteString.Lazy qualified as LazyByteString
import Data.List (sort)
import Data.List.NonEmpty qualified as NonEmpty
import Draw.FromPart (sidedContours)
import Files (readText)
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Vec qualified as Vec
import Part.Part (Contour, Solid (..))
import Part.Part qualified as Part
import Project.LoadedProgram qualified as LoadedProgram
import PythonJudge qualified
import Surface.Import qualified as Import
import System.Directory (listDirectory)
import System.FilePath (takeExtension, (</>))
import Test.Hspec
import Toolpath.Toolpath qualified as Toolpath

spec :: Spec
spec =
  it "drawings of all examples are the part and the path (pending without ezdxf)" $
    inFolder $ \folder -> do
      own <- programsIn "examples"
      modern <- programsIn ("examples" </> "cnc")
      expected <- traverse expectation (own <> modern)
      LazyByteString.writeFile (folder </> "expected.json") (Aeson.encode expected)
      PythonJudge.agrees
        "test/drawings/judge.py"
        [("ezdxf", "python3-ezdxf"), ("svgpathtools", "svgpathtools from PyPI")]
        [folder </> "expected.json", folder]

-- | The programs and the input sheets of a folder.
programsIn :: FilePath -> IO [FilePath]
programsIn folder =
  map (folder </>)
    . sort
    . filter ((`elem` [".part", ".sheet"]) . takeExtension)
    <$> listDirectory folder

-- | All that the drawing of a program has to show, from the part and the toolpath.
expectation :: FilePath -> IO Value
expectation file = do
  text <- readText file
  loaded <- LoadedProgram.load (Import.byName (fmap Right . readText)) file text
  case Result.ifSound (Compile.analyse [] loaded) of
    Nothing -> fail (file <> " has mistakes")
    Just Analysis {part, path} ->
      pure
        ( object
            [ "file" .= file,
              "unit" .= millimetresIn (Part.unit part),
              "contours" .= [contour c | (c, _, _) <- sidedContours part],
              "stock" .= [s | Just (Located _ solid) <- [Part.stock part], s <- solids solid],
              "clamps" .= concat [solids solid | Located _ solid <- Part.avoided part],
              "moves" .= map move (concatMap Toolpath.moves (Toolpath.blocks path)),
              "holes"
                .= [ [Vec.x p, Vec.y p, r, z]
                     | Part.Drill (Located _ d) <- Part.operations part,
                       Part.Hole (Located _ p) (Mm z) (Mm r) <- NonEmpty.toList (Part.holes d)
                   ]
            ]
        )

contour :: Contour -> Value
contour c =
  object
    [ "name" .= name,
      "closed" .= (Part.ends c == Part.Closed),
      "area" .= (if Part.ends c == Part.Closed then Polyarc.signedArea polyarc else 0),
      "length" .= (let Mm l = Polyarc.length polyarc in l),
      "segments" .= map (segment . Part.segment) (NonEmpty.toList (Part.elements c)),
      "ofCurve" .= map Part.ofCurve (NonEmpty.toList (Part.elements c))
    ]
  where
    polyarc = Part.polyarcOf c
    Located _ (Name name) = Part.contourName c

-- | The outlines of a solid with its heights.
solids :: Solid -> [Value]
solids Solid {outlines, lowest = Mm low, highest = Mm high} =
  [object ["outline" .= contour c, "heights" .= [low, high]] | c <- outlines]

move :: Toolpath.Move -> Value
move m =
  object
    [ "segment" .= segment (Toolpath.segment m),
      "heights" .= [low, high],
      "rapid" .= (Toolpath.pace m == Part.Rapid)
    ]
  where
    (Mm low, Mm high) = Toolpath.heights m

-- | The ends of a segment; of an arc also its centre and its sweep in radians.
segment :: Segment -> [Double]
segment s = case s of
  Straight p q -> [Vec.x p, Vec.y p, Vec.x q, Vec.y q]
  Arc {start, end, centre, sweep = Rad sweep} ->
    [Vec.x start, Vec.y start, Vec.x end, Vec.y end, Vec.x centre, Vec.y centre, sweep]
