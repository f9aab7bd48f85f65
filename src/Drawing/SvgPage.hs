-- | The page of an SVG file: the area of its outermost element, with the unit of its lengths.
module Drawing.SvgPage
  ( SvgPage (..),
    page,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), millimetresIn)
import Data.Maybe (mapMaybe)
import Drawing.AffineMap (AffineMap (..), after)
import Drawing.AffineMap qualified as AffineMap
import Drawing.Error (DrawingFault (..), Error (Error))
import Drawing.SvgLength (Direction (..), Viewport (..))
import Drawing.SvgLength qualified as SvgLength
import Drawing.XmlElement (XmlElement)
import Drawing.XmlElement qualified as XmlElement

-- | A page.
data SvgPage = SvgPage
  { -- | the map from the user units of the outermost element to mm, with y upwards
    toPage :: AffineMap,
    viewport :: Viewport,
    -- | true if the file or the program gives the unit of its lengths
    hasUnit :: Bool,
    -- | width and height in mm, if the file gives them
    size :: Maybe (Mm, Mm)
  }

-- | The page of an outermost element. Its width and height may give the unit; pixels do not. If
-- they do not, the user units are in the unit that the program states, or else 1\/96 in. An error
-- if the program states another unit than the file. Without a width or a height the view box gives
-- it; without a view box either, the page has no height, and the upper edge lies at 0.
page :: Maybe LengthUnit -> XmlElement -> Either Error SvgPage
page stated element = do
  box <- SvgLength.viewBox element
  let (boxWidth, boxHeight) = maybe (0, 0) (\(_, _, w, h) -> (w, h)) box
      inBox = Viewport boxWidth boxHeight
  width <- SvgLength.given inBox Horizontal "width" element
  height <- SvgLength.given inBox Vertical "height" element
  let (pageWidth, pageHeight) = case (width, height) of
        (Just w, Just h) -> (w, h)
        (Just w, Nothing) -> (w, if boxWidth > 0 then w * boxHeight / boxWidth else 0)
        (Nothing, Just h) -> (if boxHeight > 0 then h * boxWidth / boxHeight else 0, h)
        (Nothing, Nothing) -> (boxWidth, boxHeight)
      whole = Viewport pageWidth pageHeight
      upright k bottom = (AffineMap.scaling k (negate k)) {dy = k * bottom}
      inPixels = upright pixel pageHeight
      inMm = Mm . (pixel *)
      size =
        if min pageWidth pageHeight > 0 then Just (inMm pageWidth, inMm pageHeight) else Nothing
      made toPage viewport hasUnit = SvgPage {toPage, viewport, hasUnit, size}
  case (units, stated) of
    (name : _, Just unit)
      | Decimal.unitText unit `notElem` units ->
        Left (Error (XmlElement.line element) (UnitConflict name (Decimal.unitText unit)))
    ([], Just unit) ->
      let k = millimetresIn unit
       in Right $ case box of
            Nothing -> made (upright k pageHeight) whole True
            Just (x, y, _, h) ->
              let m = upright k (y + h) in made m {dx = negate (k * x)} inBox True
    _ -> case box of
      Nothing -> Right (made inPixels whole (not (null units)))
      Just area -> do
        m <- SvgLength.boxMap element area (pageWidth, pageHeight)
        Right (made (inPixels `after` m) inBox (not (null units)))
  where
    units = mapMaybe (`SvgLength.unitOf` element) ["width", "height"]

-- | The length of a pixel in mm.
pixel :: Double
pixel = 25.4 / 96
