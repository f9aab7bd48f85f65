-- | Lengths in the attributes of SVG elements, in px, and the maps of viewports.
module Drawing.SvgLength
  ( Viewport (..),
    Direction (..),
    given,
    givenOr,
    unitOf,
    viewBox,
    boxMap,
  )
where

import Data.List (find)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Drawing.AffineMap (AffineMap (..))
import Drawing.AffineMap qualified as AffineMap
import Drawing.Error (DrawingFault (..), Error (Error))
import Drawing.Number qualified as Number
import Drawing.SvgNumber (numbers)
import Drawing.Tolerance qualified as Tolerance
import Drawing.XmlElement (XmlElement (line), attribute, nameOf)

-- | The width and the height in user units of the area that 100 % means.
data Viewport = Viewport Double Double

-- | The direction of a length, which says what 100 % are.
data Direction = Horizontal | Vertical | Oblique

-- | The length of an attribute in px, if the element has the attribute and its value is not @auto@.
given :: Viewport -> Direction -> Text -> XmlElement -> Either Error (Maybe Double)
given (Viewport width height) direction name element = case attribute name element of
  Nothing -> Right Nothing
  Just "auto" -> Right Nothing
  Just text -> case Number.leading text of
    Just (x, rest)
      | Text.compareLength text Tolerance.mostDigits /= GT,
        Just factor <- lookup (Text.strip rest) units ->
        Right (Just (x * factor))
    _ -> Left (wrong element name text)
  where
    units =
      [ ("", 1),
        ("px", 1),
        ("mm", 96 / 25.4),
        ("cm", 960 / 25.4),
        ("in", 96),
        ("pt", 96 / 72),
        ("pc", 16),
        ("Q", 24 / 25.4),
        ("%", whole / 100)
      ]
    whole = case direction of
      Horizontal -> width
      Vertical -> height
      Oblique -> sqrt ((width * width + height * height) / 2)

-- | The length of an attribute in px, or the given one.
givenOr :: Double -> Viewport -> Direction -> Text -> XmlElement -> Either Error Double
givenOr standard viewport direction name element =
  fromMaybe standard <$> given viewport direction name element

-- | The unit of length of an attribute, if the element has the attribute and its value has one. A
-- pixel is none, since programs draw with pixels of several sizes.
unitOf :: Text -> XmlElement -> Maybe Text
unitOf name element = do
  (_, rest) <- Number.leading =<< attribute name element
  find (== Text.strip rest) ["mm", "cm", "in", "pt", "pc", "Q"]

-- | The rectangle of the attribute @viewBox@: x, y, width, height. Nothing if the element has none.
viewBox :: XmlElement -> Either Error (Maybe (Double, Double, Double, Double))
viewBox element = case attribute "viewBox" element of
  Nothing -> Right Nothing
  Just text -> case numbers text of
    Right [x, y, width, height] | width > 0 && height > 0 -> Right (Just (x, y, width, height))
    _ -> Left (wrong element "viewBox" text)

-- | The map from the rectangle of a view box to the area from (0, 0) with a width and a height, by
-- the attribute @preserveAspectRatio@.
boxMap ::
  XmlElement -> (Double, Double, Double, Double) -> (Double, Double) -> Either Error AffineMap
boxMap element (x, y, width, height) (areaWidth, areaHeight) =
  case Text.words (fromMaybe "xMidYMid" (attribute name element)) of
    "defer" : rest -> by rest
    rest -> by rest
  where
    name = "preserveAspectRatio"
    (sx, sy) = (areaWidth / width, areaHeight / height)
    by choice = case choice of
      ["none"] -> Right (placed sx sy 0 0)
      ["none", _] -> Right (placed sx sy 0 0)
      [align] -> aligned align (min sx sy)
      [align, "meet"] -> aligned align (min sx sy)
      [align, "slice"] -> aligned align (max sx sy)
      _ -> Left (wrong element name (Text.unwords choice))
    aligned align s = case (share (Text.take 4 align), share (Text.drop 4 align)) of
      (Just h, Just v) ->
        Right (placed s s (h * (areaWidth - s * width)) (v * (areaHeight - s * height)))
      _ -> Left (wrong element name align)
    share part = lookup (Text.drop 1 part) [("Min", 0), ("Mid", 0.5), ("Max", 1)]
    placed kx ky dx dy = (AffineMap.scaling kx ky) {dx = dx - kx * x, dy = dy - ky * y}

wrong :: XmlElement -> Text -> Text -> Error
wrong element name text = Error (line element) (WrongAttribute (nameOf element) name text)
