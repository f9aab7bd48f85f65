-- | Drawings for CAD programs: objects at their true places, in mm of the part, each on a layer.
module Export.CadDrawing
  ( CadDrawing (..),
    CadObject (..),
    CadForm (..),
    OutlinePiece (..),
    CadLayer (..),
    layerName,
    circleOf,
    extent,
    letterGap,
    letterHeight,
  )
where

import Base.Quantity (LengthUnit, Mm (..), Rad (..))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Export.Bezier (CubicBezier (..))
import Export.Tolerance qualified as Tolerance
import Geometry.Carrier (Circle (Circle))
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Geometry
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | A drawing: its title, the unit of the program, and the objects in order.
data CadDrawing = CadDrawing {title :: Text, unit :: LengthUnit, objects :: [CadObject]}
  deriving stock (Eq, Show)

-- | An object on its layer.
data CadObject = CadObject {layer :: CadLayer, form :: CadForm}
  deriving stock (Eq, Show)

-- | The form of an object. Heights are 0 at the top of the part and negative in the material.
data CadForm
  = -- | a contour: its name, its ends, the heights of its lower and of its upper edge, which are
    -- equal for a contour of the part, and its pieces, each of which begins where the one before it
    -- ends
    Outline Text Ends (Mm, Mm) (NonEmpty OutlinePiece)
  | -- | a move: its path in the plane, and its heights at the beginning and at the end
    Motion Segment (Mm, Mm)
  | -- | a hole: its circle at the top of the part, and the height of its bottom
    HoleMark Circle Mm
  | -- | a node: its number, its place, and its height
    NodeMark Int Point Mm
  deriving stock (Eq, Show)

-- | A piece of a contour.
data OutlinePiece
  = -- | lines and arcs
    Chain (NonEmpty Segment)
  | -- | a curve
    Smooth (NonEmpty CubicBezier)
  deriving stock (Eq, Show)

-- | The kinds of objects.
data CadLayer
  = -- | contours of the part
    PartLayer
  | HoleLayer
  | -- | the stock before the first operation
    StockLayer
  | -- | the solids that the program avoids
    ClampLayer
  | -- | moves that cut along contours, in pockets and in holes
    CutLayer
  | -- | the other moves at feed: approaches, leads, ramps, retracts
    LinkLayer
  | RapidLayer
  | -- | the nodes of the last pass along each contour
    NodeLayer
  deriving stock (Eq, Ord, Show, Enum, Bounded)

-- | The name of a layer in files.
layerName :: CadLayer -> Text
layerName layer = case layer of
  PartLayer -> "PART"
  HoleLayer -> "HOLES"
  StockLayer -> "STOCK"
  ClampLayer -> "CLAMPS"
  CutLayer -> "PATH_CUTS"
  LinkLayer -> "PATH_LINKS"
  RapidLayer -> "PATH_RAPIDS"
  NodeLayer -> "NODES"

-- | The circle that the pieces of a closed contour are: arcs about one centre that make one turn.
-- Nothing for any other contour.
circleOf :: Ends -> NonEmpty OutlinePiece -> Maybe Circle
circleOf ends pieces = case (ends, pieces) of
  (Closed, Chain (arc@Arc {centre} :| others) :| [])
    | all (isAbout centre) others,
      Rad turn <- foldl plusSweep (sweep arc) others,
      abs (abs turn - 2 * pi) <= Geometry.equal ->
      Just (Circle centre (Segment.radius centre (start arc)))
  _ -> Nothing
  where
    isAbout c s = case s of
      Straight _ _ -> False
      Arc {centre} -> Vec.distance c centre <= Tolerance.arcEnd
    plusSweep (Rad a) s = case s of
      Straight _ _ -> Rad a
      Arc {sweep = Rad b} -> Rad (a + b)

-- | A box, in mm, around objects; nothing if there are none. A curve lies between its control
-- points.
extent :: [CadObject] -> Maybe BoundingBox
extent objects = case concatMap (boxes . form) objects of
  [] -> Nothing
  first : others -> Just (foldl BoundingBox.union first others)
  where
    boxes f = case f of
      Outline _ _ _ pieces -> concatMap piece pieces
      Motion segment _ -> [BoundingBox.around segment]
      HoleMark (Circle p r) _ -> [BoundingBox.inflate r (BoundingBox.ofPoints p [])]
      -- A digit is at most two thirds as wide as it is high.
      NodeMark k p _ ->
        let width = letterHeight * 2 / 3 * fromIntegral (length (show k))
            corner = Vec.vec (letterGap + width) (letterGap + letterHeight)
         in [BoundingBox.ofPoints p [Vec.shift corner p]]
    piece p = case p of
      Chain segments -> map BoundingBox.around (NonEmpty.toList segments)
      Smooth curves ->
        [BoundingBox.ofPoints a [b, c, d] | CubicBezier a b c d <- NonEmpty.toList curves]

-- | The distance of the number of a node from the node in x and in y, in mm.
letterGap :: Double
letterGap = 0.5

-- | The height of the numbers of nodes, in mm.
letterHeight :: Double
letterHeight = 2
