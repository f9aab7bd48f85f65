-- | The reader of DXF files in the form of text, from R12 to 2018.
--
-- It reads LINE, ARC, CIRCLE, LWPOLYLINE, POLYLINE, SPLINE, ELLIPSE, POINT and INSERT. On every
-- other entity the drawing has a remark. Binary DXF and DWG are refused.
module Drawing.Dxf
  ( fromDxf,
  )
where

import Base.Quantity (LengthUnit, Mm)
import Data.Bifunctor (first)
import Data.ByteString (ByteString)
import Data.List.NonEmpty (NonEmpty)
import Data.Text (Text)
import Drawing.Drawing (Drawing (..), PresumedSize (..))
import Drawing.DxfExpansion qualified as DxfExpansion
import Drawing.DxfHeader qualified as DxfHeader
import Drawing.DxfPair qualified as DxfPair
import Drawing.DxfRecord qualified as DxfRecord
import Drawing.DxfSection (Sections (header))
import Drawing.DxfSection qualified as DxfSection
import Drawing.EntityBoundingBox qualified as EntityBoundingBox
import Drawing.Error (Error)
import Drawing.Tolerance qualified as Tolerance

-- | The drawing of a DXF file, in mm. The unit is that of the file, or the one that the program
-- states if the file has none. All errors of the entities are reported, or else the first error in
-- the form of the file.
fromDxf :: Maybe LengthUnit -> ByteString -> Either (NonEmpty Error) Drawing
fromDxf stated bytes = do
  records <- first pure (DxfRecord.fromPairs =<< DxfPair.fromBytes bytes)
  sections <- first pure (DxfSection.fromRecords records)
  unit <- first pure (DxfHeader.millimetres stated (header sections))
  drawing <- DxfExpansion.drawing (DxfHeader.encoding (header sections)) unit sections
  let doubt = largeSize (EntityBoundingBox.extent (entities drawing))
  Right drawing {presumed = doubt =<< DxfHeader.largeUnit (header sections)}

-- | The size of a drawing, if it is larger than 'Tolerance.largeDrawing', with the line and the
-- name of its unit.
largeSize :: (Mm, Mm) -> (Int, Text) -> Maybe PresumedSize
largeSize (width, height) (sizeLine, name)
  | max width height > Tolerance.largeDrawing =
    Just PresumedSize {sizeLine, largeUnit = Just name, width, height}
  | otherwise = Nothing
