-- | SVG files for CAD programs: the drawing at its true size, with coordinates in mm. The y axis of
-- SVG points down, so each y has the opposite sign. Heights are left out.
module Export.Svg
  ( document,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), Rad (..))
import Data.Char (isAlpha, isAlphaNum, isControl)
import Data.Containers.ListUtils (nubOrd)
import Data.Foldable (toList, traverse_)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Lazy qualified as Lazy
import Export.Bezier (CubicBezier (..))
import Export.Bezier qualified as Bezier
import Export.CadDrawing
  ( CadDrawing (..),
    CadForm (..),
    CadLayer (..),
    CadObject (..),
    OutlinePiece (..),
  )
import Export.CadDrawing qualified as CadDrawing
import Export.Coordinate qualified as Coordinate
import Export.UniqueName qualified as UniqueName
import Geometry.Carrier (Circle (Circle))
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Text.Blaze.Svg (Svg)
import Text.Blaze.Svg.Renderer.Text qualified as Blaze
import Text.Blaze.Svg11 (customAttribute, toSvg, toValue, (!))
import Text.Blaze.Svg11 qualified as Svg
import Text.Blaze.Svg11.Attributes qualified as Attribute

-- | The text of a file.
document :: CadDrawing -> Text
document CadDrawing {title, unit, objects} =
  Lazy.toStrict (Blaze.renderSvg (Svg.docTypeSvg ! frame $ rows (heading : layers)))
  where
    BoundingBox left bottom right top =
      BoundingBox.inflate margin (fromMaybe (BoundingBox 0 0 0 0) (CadDrawing.extent objects))
    frame =
      Attribute.version "1.1"
        <> customAttribute "xmlns:inkscape" "http://www.inkscape.org/namespaces/inkscape"
        <> Attribute.width (measure (right - left))
        <> Attribute.height (measure (top - bottom))
        <> Attribute.viewbox
          (toValue (Text.unwords (map Coordinate.text [left, -top, right - left, top - bottom])))
    measure x =
      toValue (Coordinate.text (Coordinate.inUnit unit x) <> Decimal.unitText unit)
    heading = Svg.title (toSvg (Text.filter (not . isControl) title))
    layers =
      [ layerOf kind shown
        | kind <- [minBound ..],
          shown@(_ : _) <- [[form o | o <- objects, layer o == kind]]
      ]

-- | The width of the space around the drawing.
margin :: Mm
margin = Mm 1

-- | Elements one after the other, each on a line of its own.
rows :: [Svg] -> Svg
rows things = toSvg newLine *> traverse_ (\thing -> thing *> toSvg newLine) things
  where
    newLine = "\n" :: Text

-- | A layer as Inkscape knows it. A contour of the part has an identity.
layerOf :: CadLayer -> [CadForm] -> Svg
layerOf kind forms =
  Svg.g
    ! Attribute.id_ (toValue name)
    ! customAttribute "inkscape:groupmode" "layer"
    ! customAttribute "inkscape:label" (toValue name)
    ! Attribute.fill "none"
    ! Attribute.stroke (toValue (colour kind))
    ! Attribute.strokeWidth "0.1"
    $ rows (shapes <> map (path . runData) (runs forms))
  where
    name = CadDrawing.layerName kind
    shapes = case kind of
      PartLayer -> zipWith identified (identities forms) (concatMap shape forms)
      _ -> concatMap shape forms
    identified i element = element ! Attribute.id_ (toValue i)
    runData segments = move (Segment.start (NonEmpty.head segments)) <> foldMap segmentData segments

-- | The identities of contours in the file: their names, made unique among each other and among the
-- layers.
identities :: [CadForm] -> [Text]
identities forms =
  UniqueName.distinguished
    (map CadDrawing.layerName [minBound ..])
    [valid t | Outline t _ _ _ <- forms]

-- | A name in which each character may occur in an identity of XML.
valid :: Text -> Text
valid t = case Text.uncons letters of
  Just (c, _) | isAlpha c || c == '_' -> letters
  _ -> "_" <> letters
  where
    letters = Text.map (\c -> if isAlphaNum c || c `elem` ("-_." :: String) then c else '_') t

-- | The colour of a layer.
colour :: CadLayer -> Text
colour kind = case kind of
  PartLayer -> "#000000"
  HoleLayer -> "#009e9e"
  StockLayer -> "#808080"
  ClampLayer -> "#d00000"
  CutLayer -> "#0000e0"
  LinkLayer -> "#009e00"
  RapidLayer -> "#d000d0"
  NodeLayer -> "#e07000"

-- | The elements of an object: one for a contour or a hole, two for a node. Moves are drawn by
-- 'runs'.
shape :: CadForm -> [Svg]
shape form = case form of
  Outline _ ends _ pieces -> case CadDrawing.circleOf ends pieces of
    Just c -> [circle c]
    Nothing ->
      [ path
          ( move (startOf pieces)
              <> foldMap pieceData pieces
              <> (case ends of Closed -> "Z"; Open -> "")
          )
      ]
  HoleMark c _ -> [circle c]
  NodeMark k p _ -> [circle (Circle p (Mm 0.5)), number k p]
  Motion _ _ -> []
  where
    startOf pieces = case NonEmpty.head pieces of
      Chain segments -> Segment.start (NonEmpty.head segments)
      Smooth curves -> Bezier.start (NonEmpty.head curves)

-- | The number of a node beside it.
number :: Int -> Point -> Svg
number k p =
  Svg.text_
    ! Attribute.x (toValue (Coordinate.text (Vec.x p + CadDrawing.letterGap)))
    ! Attribute.y (toValue (Coordinate.text (-(Vec.y p) - CadDrawing.letterGap)))
    ! Attribute.fontSize (toValue (Coordinate.text CadDrawing.letterHeight))
    ! Attribute.fill (toValue (colour NodeLayer))
    ! Attribute.stroke "none"
    $ toSvg (Decimal.whole k)

circle :: Circle -> Svg
circle (Circle c (Mm r)) =
  Svg.circle
    ! Attribute.cx (toValue (Coordinate.text (Vec.x c)))
    ! Attribute.cy (toValue (Coordinate.text (-(Vec.y c))))
    ! Attribute.r (toValue (Coordinate.text r))

path :: Text -> Svg
path d = Svg.path ! Attribute.d (toValue d)

-- | The moves of a layer in the plane, those that follow one another in one run. Moves at the same
-- place but at other heights occur once.
runs :: [CadForm] -> [NonEmpty Segment]
runs forms = joined (nubOrd [s | Motion s _ <- forms, Segment.length s > Mm 0])
  where
    joined segments = case segments of
      [] -> []
      s : more -> case joined more of
        run@(next :| _) : others
          | Segment.end s == Segment.start next -> NonEmpty.cons s run : others
        others -> (s :| []) : others

-- Path data ---------------------------------------------------------------------------------------

pieceData :: OutlinePiece -> Text
pieceData piece = case piece of
  Chain segments -> foldMap segmentData segments
  Smooth curves ->
    mconcat ["C" <> Text.unwords (map pointData [b, c, d]) | CubicBezier _ b c d <- toList curves]

-- | The data of a line, or of the arcs into which a segment is divided: each of them sweeps at most
-- 120°. SVG gives an arc by its ends and its radius, from which the centre of half a circle follows
-- with only half of the digits.
segmentData :: Segment -> Text
segmentData s = case s of
  Straight _ q -> "L" <> pointData q
  Arc {end, centre, sweep = Rad sweep} ->
    let count = max 1 (ceiling (abs sweep / (2 * pi / 3) - 1e-9)) :: Int
        ends = [Segment.at (fromIntegral k / fromIntegral count) s | k <- [1 .. count - 1]] <> [end]
        Mm a = Segment.radius centre (Segment.start s)
        Mm b = Segment.radius centre end
        radius = Coordinate.text ((a + b) / 2)
        turn = if sweep > 0 then " 0 0 0 " else " 0 0 1 "
     in mconcat ["A" <> radius <> " " <> radius <> turn <> pointData q | q <- ends]

move :: Point -> Text
move p = "M" <> pointData p

pointData :: Point -> Text
pointData p = Coordinate.text (Vec.x p) <> " " <> Coordinate.text (-(Vec.y p))
