-- | Random SVG files, each with the entities that a reader has to find: paths of all commands and
-- basic shapes, in groups, layers and uses with transforms.
module Generate.Svg
  ( SvgText (..),
    svgText,
  )
where

import Base.Quantity (Mm (..), Rad (..), radians)
import Data.ByteString (ByteString)
import Data.List (intercalate, isPrefixOf)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Drawing.AffineMap (AffineMap (..), after)
import Drawing.AffineMap qualified as AffineMap
import Drawing.Drawing (Ellipse (Ellipse), PathPart (..), Shape (..))
import Generate.Dxf (Wanted (..))
import Geometry.Carrier (Circle (Circle))
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Numeric (showFFloat)
import Test.QuickCheck

-- | A file, and its entities in mm.
data SvgText = SvgText {svgBytes :: ByteString, svgWanted :: [Wanted]}

instance Show SvgText where
  show t = Text.unpack (Encoding.decodeUtf8 (svgBytes t)) <> show (svgWanted t)

-- | A row of the file, with the tag of the element whose tag begins there.
data Row = Row (Maybe Int) String

-- | An element with a tag, in user units.
data Item = Item Int String Text Shape

-- | A file.
svgText :: Gen SvgText
svgText = do
  (attributes, toPage) <- elements pages
  lineEnd <- elements ["\n", "\r\n"]
  (used, usedItems) <- figure 900
  (rows, items) <- children 2 1 usedItems
  let whole =
        [ Row Nothing "<?xml version=\"1.0\" encoding=\"UTF-8\"?>",
          Row Nothing ("<svg " <> names <> attributes <> ">"),
          Row Nothing "<defs>"
        ]
          <> used
          <> [Row Nothing "</defs>", Row Nothing "<!-- a comment -->"]
          <> rows
          <> [Row Nothing "</svg>"]
      starts = Map.fromList [(tag, n) | (n, Row (Just tag) _) <- zip [1 ..] whole]
  pure
    SvgText
      { svgBytes = Encoding.encodeUtf8 (Text.pack (intercalate lineEnd [row | Row _ row <- whole])),
        svgWanted =
          [ Wanted row (Text.pack word) layer (AffineMap.shape toPage s)
            | Item tag word layer s <- items,
              let row = Map.findWithDefault 0 tag starts
          ]
      }
  where
    names =
      "xmlns=\"http://www.w3.org/2000/svg\" xmlns:k=\"http://www.w3.org/1999/xlink\" "
        <> "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" "

-- | Attributes of the outermost element, and the map from its user units to mm that they mean.
pages :: [(String, AffineMap)]
pages =
  [ ("width=\"120mm\" height=\"80mm\" viewBox=\"0 0 120 80\"", placed 1 1 0 80),
    ("width='960' height='480px'", placed px px 0 (480 * px)),
    ("viewBox='-10,-20 300 200'", placed px px (10 * px) (180 * px)),
    ("width='4in' height='2in' viewBox='-1000 -500 2000 1000'", placed 0.0508 0.0508 50.8 25.4),
    (square "", placed 1 1 25 100),
    (square "preserveAspectRatio='xMinYMax meet'", placed 1 1 0 100),
    (square "preserveAspectRatio='xMaxYMid'", placed 1 1 50 100),
    (square "preserveAspectRatio='none'", placed 2 1 0 100),
    (square "preserveAspectRatio='xMidYMid slice'", placed 2 2 0 150),
    (square "preserveAspectRatio='xMidYMin slice'", placed 2 2 0 100)
  ]
  where
    square more = "width='10cm' height='100mm' viewBox='0 0 50 100' " <> more
    px = 25.4 / 96
    placed kx ky dx dy = (AffineMap.scaling kx (negate ky)) {dx, dy}

-- | Up to three elements with tags from a number on, the depth of groups that may follow, and the
-- items of the element in the definitions.
children :: Int -> Int -> [Item] -> Gen ([Row], [Item])
children depth first used = do
  count <- choose (1, 3)
  found <- traverse child (take count [first, first + 10 ^ depth ..])
  pure (concatMap fst found, concatMap snd found)
  where
    child t
      | depth == 0 = figure t
      | otherwise = frequency [(3, figure t), (2, group depth t used), (1, use t used)]

-- | A group, sometimes a layer.
group :: Int -> Int -> [Item] -> Gen ([Row], [Item])
group depth t used = do
  (attribute, m) <- transforms
  layer <- elements [Nothing, Nothing, Just "Контур", Just "A&B"]
  (rows, items) <- children (depth - 1) (t + 1) used
  let mark = case layer of
        Nothing -> ""
        Just name -> " inkscape:groupmode='layer' inkscape:label='" <> escaped name <> "'"
      onLayer l = if Text.null l then fromMaybe "" layer else l
  pure
    ( [Row Nothing ("<g" <> attribute <> mark <> ">")] <> rows <> [Row Nothing "</g>"],
      [Item tag word (onLayer l) (AffineMap.shape m s) | Item tag word l s <- items]
    )
  where
    escaped = Text.unpack . Text.replace "&" "&amp;"

-- | A use of the element in the definitions.
use :: Int -> [Item] -> Gen ([Row], [Item])
use _ used = do
  (attribute, m) <- transforms
  (x, xText) <- decimal
  (y, yText) <- decimal
  href <- elements ["href", "k:href"]
  let position = "' x='" <> xText <> "' y='" <> yText <> "'"
      row = "<use " <> href <> "='#shared" <> position <> attribute <> "/>"
      place = m `after` AffineMap.translation (Vec.vec x y)
  pure
    ( [Row Nothing row],
      [Item tag word layer (AffineMap.shape place s) | Item tag word layer s <- used]
    )

-- | An attribute @transform@ of up to three maps, and their product.
transforms :: Gen (String, AffineMap)
transforms = do
  count <- choose (0, 3 :: Int)
  maps <- vectorOf count single
  separator <- elements [" ", ",", "", " , "]
  pure
    ( if null maps then "" else " transform=\"" <> intercalate separator (map fst maps) <> "\"",
      foldl after AffineMap.identity (map snd maps)
    )
  where
    single =
      oneof
        [ do
            (x, xText) <- decimal
            (y, yText) <- decimal
            elements
              [ ("translate(" <> xText <> ")", moved x 0),
                ("translate(" <> xText <> "," <> yText <> ")", moved x y)
              ],
          do
            (k, kText) <- factor
            (l, lText) <- factor
            elements
              [ ("scale(" <> kText <> ")", AffineMap.scaling k k),
                ("scale( " <> kText <> " " <> lText <> " )", AffineMap.scaling k l)
              ],
          do
            (a, aText) <- decimal
            (x, xText) <- decimal
            (y, yText) <- decimal
            let turned = AffineMap.rotation (radians a)
                about = moved x y `after` turned `after` moved (negate x) (negate y)
            elements
              [ ("rotate(" <> aText <> ")", turned),
                ("rotate (" <> unwords [aText, xText, yText] <> ")", about)
              ],
          do
            (a, aText) <- steps (-4000) 4000
            elements
              [ ("skewX(" <> aText <> ")", AffineMap.identity {xy = tan (a * pi / 180)}),
                ("skewY(" <> aText <> ")", AffineMap.identity {yx = tan (a * pi / 180)})
              ],
          do
            (a, aText) <- factor
            (d, dText) <- factor
            (e, eText) <- decimal
            let numbers = [aText, "0", "0.5", dText, eText, "-3"]
            pure
              ( "matrix(" <> intercalate "," numbers <> ")",
                AffineMap {xx = a, yx = 0, xy = 0.5, yy = d, dx = e, dy = -3}
              )
        ]
    moved x y = AffineMap.translation (Vec.vec x y)
    factor = oneof [steps 5000 20000, steps (-20000) (-5000)]

-- Figures -------------------------------------------------------------------------------------

-- | A shape with a tag; the tag 900 has the identifier @shared@.
figure :: Int -> Gen ([Row], [Item])
figure t = do
  (word, attributes, shapes) <- oneof [path, path, path, rectangle, circle, ellipse, lines']
  let key = if t == 900 then " id='shared'" else ""
  pure
    ( [Row (Just t) ("<" <> word <> key <> attributes <> "/>")],
      [Item t word "" s | s <- shapes]
    )

type Figure = (String, String, [Shape])

attributesOf :: [(String, String)] -> String
attributesOf pairs = concat [" " <> name <> "=\"" <> value <> "\"" | (name, value) <- pairs]

circle :: Gen Figure
circle = do
  (x, xText) <- decimal
  (y, yText) <- decimal
  (r, rText) <- steps 1000 400000
  pure
    ( "circle",
      attributesOf [("cx", xText), ("cy", yText), ("r", rText)],
      [FullCircle (Circle (Vec.point x y) (Mm r))]
    )

ellipse :: Gen Figure
ellipse = do
  (x, xText) <- decimal
  (y, yText) <- decimal
  (b, bText) <- steps 1000 200000
  (a, aText) <- steps 210000 400000
  isUpright <- arbitrary
  let texts = if isUpright then [("rx", bText), ("ry", aText)] else [("rx", aText), ("ry", bText)]
      angle = if isUpright then pi / 2 else 0
  pure
    ( "ellipse",
      attributesOf ([("cx", xText), ("cy", yText)] <> texts),
      [FullEllipse (Ellipse (Vec.point x y) (Mm a) (Mm b) (Rad angle))]
    )

lines' :: Gen Figure
lines' = do
  count <- choose (3, 6)
  vertices <- vectorOf count ((,) <$> decimal <*> decimal)
  separator <- elements [",", " ", " , "]
  let points = [Vec.point x y | ((x, _), (y, _)) <- vertices]
      text = unwords [x <> separator <> y | ((_, x), (_, y)) <- vertices]
      chained ends ps = [Path ends (NonEmpty.fromList (zipWith straight ps (drop 1 ps)))]
  elements
    [ ("polyline", attributesOf [("points", text)], chained Open points),
      ("polygon", attributesOf [("points", text)], chained Closed (points <> take 1 points))
    ]

straight :: Point -> Point -> PathPart
straight a b = Plain (Straight a b)

rectangle :: Gen Figure
rectangle = do
  (x, xText) <- decimal
  (y, yText) <- decimal
  (w, wText) <- steps 100000 400000
  (h, hText) <- steps 100000 400000
  (r, rText) <- steps 1000 40000
  isRound <- arbitrary
  let place = [("x", xText), ("y", yText), ("width", wText), ("height", hText)]
      p i j = Vec.point (x + i) (y + j)
      corner i j from = EllipseArc (Ellipse (p i j) (Mm r) (Mm r) (Rad 0)) from (from + pi / 2)
      rounded =
        straight (p r 0) (p (w - r) 0)
          :| [ corner (w - r) r (negate pi / 2),
               straight (p w r) (p w (h - r)),
               corner (w - r) (h - r) 0,
               straight (p (w - r) h) (p r h),
               corner r (h - r) (pi / 2),
               straight (p 0 (h - r)) (p 0 r),
               corner r r pi
             ]
      sharp =
        straight (p 0 0) (p w 0)
          :| [straight (p w 0) (p w h), straight (p w h) (p 0 h), straight (p 0 h) (p 0 0)]
  pure
    ( "rect",
      attributesOf (place <> [("rx", rText) | isRound]),
      [Path Closed (if isRound then rounded else sharp)]
    )

-- Paths ---------------------------------------------------------------------------------------

-- | A path of one or two subpaths.
path :: Gen Figure
path = do
  count <- choose (1, 2 :: Int)
  found <- vectorOf count subpath
  -- a subpath after one that is closed may begin with a relative move from its beginning; here all
  -- moves are absolute
  pure ("path", attributesOf [("d", unwords (map fst found))], map snd found)

subpath :: Gen (String, Shape)
subpath = do
  ((x, xText), (y, yText)) <- (,) <$> decimal <*> decimal
  count <- choose (1, 5 :: Int)
  isClosed <- arbitrary
  let start = Vec.point x y
  (texts, parts, end) <- follow count start Nothing
  z <- elements ["z", " Z"]
  let back = [straight end start | isClosed, end /= start]
  pure
    ( "M" <> xText <> "," <> yText <> concat texts <> (if isClosed then z else ""),
      Path (if isClosed then Closed else Open) (NonEmpty.fromList (parts <> back))
    )

-- | Commands from a point on, given the last control point of a smooth curve.
follow :: Int -> Point -> Maybe (Bool, Point) -> Gen ([String], [PathPart], Point)
follow count here control
  | count == 0 = pure ([], [], here)
  | otherwise = do
    (text, part, end, next) <- command here control
    (texts, parts, final) <- follow (count - 1) end next
    pure (text : texts, part : parts, final)

type Command = (String, PathPart, Point, Maybe (Bool, Point))

command :: Point -> Maybe (Bool, Point) -> Gen Command
command here control = do
  isRelative <- arbitrary
  join' <- elements [",", " "]
  (a, b, c) <- (,,) <$> somewhere <*> somewhere <*> somewhere
  let offset p = if isRelative then Vec.to here p else Vec.to (Vec.point 0 0) p
      letter l = if isRelative then l else [toEnum (fromEnum k - 32) | k <- l]
      pair p = let Vec.Vec dx' dy' = offset p in decimalText dx' <> join' <> decimalText dy'
      both l ps = letter l <> intercalate join' (map pair ps)
      reflected isCubic = case control of
        Just (kind, k) | kind == isCubic -> Vec.shift (Vec.to k here) here
        _ -> here
      bezier ps = Bezier (here :| ps) Nothing
      level = Vec.point (Vec.x a) (Vec.y here)
      upright = Vec.point (Vec.x here) (Vec.y a)
      Vec.Vec alongX alongY = offset a
  oneof
    [ pure (both "l" [a], straight here a, a, Nothing),
      pure (letter "h" <> decimalText alongX, straight here level, level, Nothing),
      pure (letter "v" <> decimalText alongY, straight here upright, upright, Nothing),
      pure (both "c" [a, b, c], bezier [a, b, c], c, Just (True, b)),
      pure (both "s" [b, c], bezier [reflected True, b, c], c, Just (True, b)),
      pure (both "q" [a, c], bezier [a, c], c, Just (False, a)),
      pure (both "t" [c], bezier [reflected False, c], c, Just (False, reflected False)),
      arc here isRelative
    ]
  where
    somewhere = Vec.point <$> (fst <$> decimal) <*> (fst <$> decimal)

-- | An arc by its centre, from which its end and its flags follow. The flags have no separator.
arc :: Point -> Bool -> Gen Command
arc here isRelative = do
  (ry, ryText) <- steps 10000 200000
  isRound <- arbitrary
  (larger, largerText) <- steps 210000 400000
  (degrees, degreesText) <- decimal
  from <- choose (-3, 3)
  size <- oneof [choose (0.1, 3), choose (3.3, 6)]
  side <- elements [1, -1]
  let (rx, rxText) = if isRound then (ry, ryText) else (larger, largerText)
      turn = side * size
      on t = Vec.rotate (radians degrees) (Vec.vec (rx * cos t) (ry * sin t))
      centre = Vec.shift (Vec.negate (on from)) here
      end = Vec.shift (on (from + turn)) centre
      Vec.Vec x y = if isRelative then Vec.to here end else Vec.to (Vec.point 0 0) end
      flags = (if size > pi then "1" else "0") <> (if side > 0 then "1" else "0")
      letter = if isRelative then "a" else "A"
      radii = rxText <> " " <> ryText <> "," <> degreesText <> " "
      text = letter <> radii <> flags <> exact x <> " " <> exact y
  pure
    ( text,
      EllipseArc (Ellipse centre (Mm rx) (Mm ry) (radians degrees)) from (from + turn),
      end,
      Nothing
    )
  where
    exact v = showFFloat Nothing (v :: Double) ""

-- Numbers -------------------------------------------------------------------------------------

-- | A number from −100 to 100, and its text.
decimal :: Gen (Double, String)
decimal = steps (-1000000) 1000000

-- | A whole number of steps of 0.0001, and its text in one of several forms.
steps :: Int -> Int -> Gen (Double, String)
steps low high = do
  n <- choose (low, high)
  let x = fromIntegral n / 10000 :: Double
  text <- elements [decimalText x, show n <> "e-4", show n <> "E-04"]
  pure (x, text)

-- | A number with twelve decimals and without a zero before its point, as programs that save
-- characters write it.
decimalText :: Double -> String
decimalText v = case showFFloat (Just 12) v "" of
  '-' : rest | "0." `isPrefixOf` rest -> '-' : drop 1 rest
  text | "0." `isPrefixOf` text -> drop 1 text
  text -> text
