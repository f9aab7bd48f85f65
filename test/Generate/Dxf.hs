-- | Random DXF files in the form of text, each with the entities that a reader has to find. The
-- versions, the units, the line ends, the encodings of names and the forms of numbers vary.
module Generate.Dxf
  ( DxfText (..),
    Wanted (..),
    dxfText,
  )
where

import Base.Quantity (LengthUnit (..), Mm (..), radians)
import Control.Monad (replicateM)
import Data.ByteString (ByteString)
import Data.ByteString.Char8 qualified as Bytes
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Drawing.AffineMap (AffineMap, after)
import Drawing.AffineMap qualified as AffineMap
import Drawing.Drawing (Ellipse (Ellipse), PathPart (..), Shape (..), Spline (Spline))
import Generate.DrawingShape qualified as Shape
import Geometry.Carrier (Circle (Circle))
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Numeric (showHex)
import Test.QuickCheck

-- | A file, the unit that the program states, and the entities in mm.
data DxfText = DxfText {bytes :: ByteString, stated :: Maybe LengthUnit, wanted :: [Wanted]}

instance Show DxfText where
  show t = Bytes.unpack (bytes t) <> show (stated t, wanted t)

-- | An entity to be found: the line of its word, its word, its layer and its shape in mm.
data Wanted = Wanted {line :: Int, word :: Text, layer :: Text, shape :: Shape}
  deriving stock (Show)

-- | A record of the file. Its tag identifies it among the records; its line is found at the end.
data Record = Record {tag :: Int, pairs :: [(Int, ByteString)]}

-- | An entity with the tag of its record, in the unit of the file.
data Item = Item Int Text Text Shape

-- | A file with up to two blocks and up to six entities. The second block can contain the first.
dxfText :: Gen DxfText
dxfText = do
  version <- elements ["AC1009", "AC1015", "AC1021", "AC1032"]
  (size, insUnits, stated) <- elements units
  lineEnd <- elements ["\r\n", "\n", "\r"]
  inner <- block version "INNER" 100 []
  outer <- block version "Outer" 200 [inner]
  (records, items) <- content version 300 [inner, outer]
  pad <- elements [id, \code -> Bytes.replicate (3 - Bytes.length code) ' ' <> code]
  let header =
        Record 0 $
          [(0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, version)]
            <> concat [[(9, "$INSUNITS"), (70, code)] | Just code <- [insUnits]]
      whole =
        [header, end, Record 1 [(0, "SECTION"), (2, "BLOCKS")]]
          <> concatMap (\(_, _, rs, _) -> rs) [inner, outer]
          <> [end, Record 2 [(999, "a comment"), (0, "SECTION"), (2, "ENTITIES")]]
          <> records
          <> [end, Record 3 [(0, "EOF")]]
      starts = scanl (+) 1 (map ((2 *) . length . pairs) whole)
      lines' = Map.fromList (zip (map tag whole) (map (+ 1) starts))
      toMm = AffineMap.scaling size size
  pure
    DxfText
      { bytes =
          Bytes.concat
            [ pad (Bytes.pack (show code)) <> lineEnd <> value <> lineEnd
              | Record {pairs} <- whole,
                (code, value) <- pairs
            ],
        stated,
        wanted =
          [ Wanted (Map.findWithDefault 0 t lines') word layer (AffineMap.shape toMm shape)
            | Item t word layer shape <- items
          ]
      }
  where
    end = Record 4 [(0, "ENDSEC")]

-- | Units: the length in mm, the number in the file, and the unit that the program states.
units :: [(Double, Maybe ByteString, Maybe LengthUnit)]
units =
  [ (1, Just "4", Nothing),
    (1, Just "     4", Just Millimetres),
    (25.4, Just "1", Nothing),
    (10, Just "5", Nothing),
    (0.001, Just "13", Nothing),
    (1, Nothing, Just Millimetres),
    (25.4, Just "0", Just Inches)
  ]

-- | A block: its name, its base point, its records and its items.
type Block = (ByteString, Point, [Record], [Item])

block :: ByteString -> ByteString -> Int -> [Block] -> Gen Block
block version name first inside = do
  (base, basePairs) <- pointAt 10
  (records, items) <- content version (first + 1) inside
  pure
    ( name,
      base,
      [Record first ([(0, "BLOCK"), (8, "0"), (2, name), (70, "0")] <> basePairs)]
        <> records
        <> [Record (first + 99) [(0, "ENDBLK")]],
      items
    )

-- | Entities and insertions with tags from a number on.
content :: ByteString -> Int -> [Block] -> Gen ([Record], [Item])
content version first blocks = do
  count <- choose (1, 4)
  parts <- traverse part (take count [first ..])
  pure (concatMap fst parts, concatMap snd parts)
  where
    part t = case blocks of
      [] -> entity version t
      _ -> frequency [(3, entity version t), (1, elements blocks >>= insert version t)]

-- | An entity on a layer.
entity :: ByteString -> Int -> Gen ([Record], [Item])
entity version t = do
  (word, body, shape) <- oneof (figures <> [polyline | version == "AC1009"])
  (layer, name) <- layerName version
  pure
    ( [Record t ([(0, word), (8, name)] <> body)],
      [Item t (Encoding.decodeLatin1 word) layer shape]
    )

-- | An insertion of a block. Entities of the block on layer 0 take the layer of the insertion.
insert :: ByteString -> Int -> Block -> Gen ([Record], [Item])
insert version t (name, base, _, items) = do
  (p, position) <- pointAt 10
  (layer, layerBytes) <- layerName version
  (sx, sxText) <- oneof [factor, pure (1, "1")]
  (sy, syText) <- oneof [factor, pure (1, "1.0")]
  (angle, angleText) <- number (-180) 180
  columns <- choose (1, 2) :: Gen Int
  rows <- choose (1, 2) :: Gen Int
  (dx, dxText) <- number (-20) 20
  (dy, dyText) <- number (-20) 20
  isBehind <- elements [False, False, True]
  let surroundings = if isBehind then AffineMap.scaling (-1) 1 else AffineMap.identity
      place i j =
        surroundings
          `after` AffineMap.translation (Vec.to origin p)
          `after` AffineMap.rotation (radians angle)
          `after` AffineMap.translation (Vec.vec (fromIntegral i * dx) (fromIntegral j * dy))
          `after` AffineMap.scaling sx sy
          `after` AffineMap.translation (Vec.to base origin)
      numbers = [(70, shown columns), (71, shown rows), (44, dxText), (45, dyText)]
      extrusion = [(210, "0"), (220, "0.0"), (230, "-1.0")]
  pure
    ( [ Record t $
          [(0, "INSERT"), (8, layerBytes), (2, name)] <> position
            <> [(41, sxText), (42, syText), (50, angleText)]
            <> numbers
            <> (if isBehind then extrusion else [])
      ],
      [ moved (place i j) layer item
        | j <- [0 .. rows - 1],
          i <- [0 .. columns - 1],
          item <- items
      ]
    )
  where
    factor = oneof [number 0.5 2, number (-2) (-0.5)]
    moved :: AffineMap -> Text -> Item -> Item
    moved m onto (Item t' word layer shape) =
      Item t' word (if layer == "0" then onto else layer) (AffineMap.shape m shape)

-- | A layer and its name in the encoding of a version.
layerName :: ByteString -> Gen (Text, ByteString)
layerName version = do
  name <- elements ["0", "0", "CUT", "Контур №1"]
  pure (name, if version >= "AC1021" then Encoding.encodeUtf8 name else escaped name)
  where
    escaped = Bytes.concat . map character . Text.unpack
    character c
      | c < '\x80' = Bytes.singleton c
      | otherwise =
        let digits = showHex (fromEnum c) ""
         in Bytes.pack ("\\U+" <> replicate (4 - length digits) '0' <> digits)

-- Figures -------------------------------------------------------------------------------------

-- | The word of an entity, its pairs without the layer, and its shape.
type Figure = (ByteString, [(Int, ByteString)], Shape)

figures :: [Gen Figure]
figures = [line', circle, arc, lightPolyline, ellipse, spline, dot]

line' :: Gen Figure
line' = do
  (a, from) <- pointAt 10
  (b, to) <- pointAt 11 `suchThat` ((/= a) . fst)
  pure ("LINE", from <> to, Path Open (Plain (Straight a b) :| []))

dot :: Gen Figure
dot = (\(p, at) -> ("POINT", at, Dot p)) <$> pointAt 10

circle :: Gen Figure
circle = do
  (c, at) <- pointAt 10
  (r, text) <- number 0.1 50
  pure ("CIRCLE", at <> [(40, text)], FullCircle (Circle c (Mm r)))

arc :: Gen Figure
arc = do
  (c, at) <- pointAt 10
  (r, text) <- number 0.1 50
  (from, fromText) <- number (-360) 360
  (turn, _) <- number 1 359
  let to = fromIntegral (round ((from + turn) * 10000) :: Int) / 10000
      on angle = Vec.shift (Vec.polar (Mm r) (radians angle)) c
      s = Arc {start = on from, end = on to, centre = c, sweep = radians (to - from)}
  pure
    ( "ARC",
      at <> [(40, text), (50, fromText), (51, shown (to :: Double))],
      Path Open (Plain s :| [])
    )

lightPolyline :: Gen Figure
lightPolyline = do
  (isClosed, vertices) <- corners
  pure
    ( "LWPOLYLINE",
      [(90, shown (length vertices)), (70, if isClosed then "1" else "0")]
        <> concat [at <> [(42, b) | b /= "0"] | (_, at, _, b) <- vertices],
      chain isClosed vertices
    )

-- | A polyline of R12, with its vertices as records of their own.
polyline :: Gen Figure
polyline = do
  (isClosed, vertices) <- corners
  pure
    ( "POLYLINE",
      [(66, "1"), (70, if isClosed then "1" else "0")]
        <> concat [(0, "VERTEX") : (8, "0") : at <> [(42, b)] | (_, at, _, b) <- vertices]
        <> [(0, "SEQEND"), (8, "0")],
      chain isClosed vertices
    )

type Corner = (Point, [(Int, ByteString)], Double, ByteString)

corners :: Gen (Bool, [Corner])
corners = do
  isClosed <- arbitrary
  count <- choose (2, 6)
  vertices <- replicateM count $ do
    (p, at) <- pointAt 10
    (bulge, text) <- oneof [pure (0, "0"), number 0.01 2, number (-2) (-0.01)]
    pure (p, at, bulge, text)
  let points = [p | (p, _, _, _) <- vertices]
      differ = and (zipWith (/=) points (drop 1 points <> take 1 points))
  if differ then pure (isClosed, vertices) else corners

chain :: Bool -> [Corner] -> Shape
chain isClosed vertices =
  Path (if isClosed then Closed else Open) . NonEmpty.fromList $
    [Plain (Segment.fromBulge p q b) | ((p, _, b, _), (q, _, _, _)) <- zip vertices following]
  where
    following = drop 1 vertices <> [head vertices | isClosed]

ellipse :: Gen Figure
ellipse = do
  (c, at) <- pointAt 10
  (end, axis) <- pointAt 11 `suchThat` (isLong . fst)
  (ratio, text) <- number 0.1 0.9
  (from, fromText) <- number 0 6
  (turn, _) <- number 0.1 6
  isWhole <- arbitrary
  let to = from + turn
      e = Ellipse c a (Mm (ratio * let Mm l = a in l)) (Vec.angle (Vec.to origin end))
      a = Vec.distance origin end
  pure $
    if isWhole
      then
        ( "ELLIPSE",
          at <> axis <> [(40, text), (41, "0.0"), (42, shown (2 * pi :: Double))],
          FullEllipse e
        )
      else
        ( "ELLIPSE",
          at <> axis <> [(40, text), (41, fromText), (42, shown to)],
          Path Open (EllipseArc e from to :| [])
        )
  where
    isLong p = Vec.distance origin p > Mm 1

spline :: Gen Figure
spline = do
  s@(Spline degree knots controls weights) <- Shape.spline
  let rational = maybe [] NonEmpty.toList weights
  pure
    ( "SPLINE",
      [(70, if null rational then "8" else "12"), (71, shown degree)]
        <> [(40, shown k) | k <- knots]
        <> concat
          [ [(10, shown (Vec.x p)), (20, shown (Vec.y p)), (30, "0.0")]
            | p <- NonEmpty.toList controls
          ]
        <> [(41, shown w) | w <- rational],
      Path Open (BSpline s :| [])
    )

-- Numbers -------------------------------------------------------------------------------------

origin :: Point
origin = Vec.point 0 0

-- | A point, and the pairs of its coordinates, sometimes with a height of 0.
pointAt :: Int -> Gen (Point, [(Int, ByteString)])
pointAt code = do
  (x, xText) <- number (-100) 100
  (y, yText) <- number (-100) 100
  height <- elements [[], [(code + 20, "0.0")]]
  pure (Vec.point x y, [(code, xText), (code + 10, yText)] <> height)

-- | A number with four decimals in a range, and its text in one of the forms that programs write.
number :: Double -> Double -> Gen (Double, ByteString)
number low high = do
  n <- choose (ceiling (low * 10000), floor (high * 10000)) :: Gen Int
  text <- elements [plain n, plain n <> "00000", "   " <> plain n, signed n, power n, bare n]
  pure (fromIntegral n / 10000, text)
  where
    plain n = minus n <> shown (abs n `div` 10000) <> "." <> places n
    places n =
      let digits = shown (abs n `mod` 10000)
       in Bytes.replicate (4 - Bytes.length digits) '0' <> digits
    minus n = if n < 0 then "-" else ""
    signed n = if n < 0 then plain n else "+" <> plain n
    power n = shown n <> "E-04"
    bare n = if abs n < 10000 then minus n <> "." <> places n else plain n

shown :: Show a => a -> ByteString
shown = Bytes.pack . show
