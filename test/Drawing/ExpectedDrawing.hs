-- | Drawings of other programs with what they contain, which these programs or other libraries say:
-- files @NAME.expected.json@ beside the drawings in @test/data/drawings@.
module Drawing.ExpectedDrawing
  ( Expected (..),
    ExpectedLayer (..),
    readExpected,
    differences,
  )
where

import Base.Quantity (Mm (..))
import Data.Aeson (FromJSON (..), eitherDecodeFileStrict, withObject, (.!=), (.:), (.:?))
import Data.List (sort)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (isJust)
import Data.Text (Text)
import Data.Text qualified as Text
import Drawing.Drawing
import Drawing.ShapePoint (lengthOf, pieceEnds, shapeAt)
import Geometry.Carrier (Circle (Circle))
import Geometry.Segment (Segment (..))
import Geometry.Vec qualified as Vec

-- | The contents of a drawing.
data Expected = Expected
  { unit :: Text,
    -- | contents by the name of the layer, or by the identifier of an SVG element outside of all
    -- layers
    layers :: Map Text ExpectedLayer,
    -- | layers that are not read
    hiddenLayers :: [Text],
    -- | words of entities that are not read
    ignored :: [Text],
    -- | distance in mm within which the program joins ends
    joinTolerance :: Double
  }

-- | The contents of a layer.
data ExpectedLayer = ExpectedLayer {loops :: [ExpectedLoop], circles :: [[Double]]}

-- | A chain of curves.
data ExpectedLoop = ExpectedLoop
  { vertices :: [[Double]],
    kinds :: [Text],
    -- | nothing for a spline that is given by points only
    loopLength :: Maybe Double
  }

instance FromJSON Expected where
  parseJSON = withObject "drawing" $ \o ->
    Expected
      <$> o .: "unit"
      <*> o .: "layers"
      <*> ((<>) <$> o .:? "frozen_layers" .!= [] <*> o .:? "off_layers" .!= [])
      <*> o .: "ignored"
      <*> o .:? "join_tolerance" .!= 0

instance FromJSON ExpectedLayer where
  parseJSON = withObject "layer" $ \o -> ExpectedLayer <$> o .: "loops" <*> o .: "circles"

instance FromJSON ExpectedLoop where
  parseJSON = withObject "loop" $ \o ->
    ExpectedLoop <$> o .: "vertices" <*> o .: "kinds" <*> o .:? "length"

-- | The contents that a file states.
readExpected :: FilePath -> IO Expected
readExpected file = either fail pure =<< eitherDecodeFileStrict file

-- | The differences between a drawing and what it has to contain, each as a text.
differences :: Expected -> Drawing -> [Text]
differences Expected {layers, hiddenLayers, joinTolerance} drawing =
  [ "layers: " <> shown (Map.keys own)
    | Map.keys own /= Map.keys wanted
  ]
    <> concat (Map.elems (Map.intersectionWithKey (layerDifferences joinTolerance) wanted own))
  where
    wanted =
      Map.filter (not . null . fst)
        . fmap withoutPoints
        . Map.filterWithKey (\name _ -> name `notElem` hiddenLayers)
        $ layers
    own =
      Map.fromListWith
        (flip (<>))
        [(groupOf e, [shape e]) | e <- entities drawing, not (isDot (shape e))]
    isDot s = case s of
      Dot _ -> True
      _ -> False
    -- a spline through points is not read
    withoutPoints layer =
      let read' = [l | l <- loops layer, isJust (loopLength l)]
       in (map Left read' <> map Right (circles layer), layer {loops = read'})

-- | The layer of an entity, or the innermost identifier of one without.
groupOf :: Entity -> Text
groupOf e
  | Text.null (layer e) = Text.concat (take 1 (identifiers e))
  | otherwise = layer e

layerDifferences ::
  Double -> Text -> ([Either ExpectedLoop [Double]], ExpectedLayer) -> [Shape] -> [Text]
layerDifferences joinTolerance name (_, ExpectedLayer {loops, circles}) shapes =
  map ((name <> ": ") <>) $
    ["missing vertex " <> shown v | v <- wanted, not (any (isAt v) corners || any (isOn v) turns)]
      <> ["unexpected vertex " <> shown p | p <- corners, not (any (isAt p) wanted)]
      <> [ "kinds " <> shown (ownKinds, wantedKinds)
           | ownKinds /= wantedKinds
         ]
      <> ["circles " <> shown (ownCircles, circles) | not circlesAgree]
      <> [ "length " <> shown (ownLength, wantedLength)
           | abs (ownLength - wantedLength) > 1e-4 + slack
         ]
  where
    wanted = [Vec.point x y | l <- loops, [x, y] <- vertices l]
    corners = concat [concatMap pieceEnds (NonEmpty.toList ps) | Path _ ps <- shapes]
    turns = [s | s@(FullEllipse _) <- shapes]
    slack = 10 * joinTolerance
    isAt p q = let Mm d = Vec.distance p q in d <= 1e-6 + joinTolerance
    isOn p s = any (isAt' 1e-2 p) [shapeAt (t / 10000) s | t <- [0 .. 10000]]
    isAt' limit p q = let Mm d = Vec.distance p q in d <= limit
    ownKinds = Map.fromListWith (+) [(k, 1 :: Int) | k <- concatMap kindsOf shapes]
    wantedKinds = Map.fromListWith (+) [(k, 1) | l <- loops, k <- kinds l]
    ownCircles = sort [(Vec.x c, Vec.y c, r) | FullCircle (Circle c (Mm r)) <- shapes]
    circlesAgree =
      length ownCircles == length circles
        && and [any (`isCircle` c) ownCircles | c <- circles]
    isCircle (x, y, r) numbers = and (zipWith (\a b -> abs (a - b) <= 1e-6) [x, y, r] numbers)
    ownLength = sum [lengthOf s | s <- shapes, not (isCircle' s)]
    isCircle' s = case s of
      FullCircle _ -> True
      _ -> False
    wantedLength = sum [length' | l <- loops, Just length' <- [loopLength l]]

kindsOf :: Shape -> [Text]
kindsOf s = case s of
  Path _ parts -> map ofPiece (NonEmpty.toList parts)
  FullEllipse _ -> ["ellipse"]
  FullCircle _ -> []
  Dot _ -> []
  where
    ofPiece part = case part of
      Plain Straight {} -> "line"
      Plain Arc {} -> "arc"
      EllipseArc {} -> "ellipse"
      Bezier _ _ -> "spline"
      BSpline _ -> "spline"

shown :: Show a => a -> Text
shown = Text.pack . show
