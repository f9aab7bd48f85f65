-- | Tables of rest material: the regions of the part that the cutter does not reach.
module Cli.RestMaterialTable
  ( tables,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (LengthUnit, Mm (..))
import Base.Region (Located (..))
import Cli.Table (Align (..))
import Cli.Table qualified as Table
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Polyarc (Ends (..), Polyarc (Polyarc))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Vec qualified as Vec
import Offset.Equidistant (RestMaterial (..), UnreachedPart (..))
import Part.Part qualified as Part
import Toolpath.Error (RestPosition (..), Tool)
import Toolpath.Error qualified as Error
import Toolpath.RestMaterial (Remaining (Remaining, tool, walls))
import Toolpath.RestMaterial qualified as RestMaterial
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | One table for each statement that leaves rest material. Each row describes one region of rest
-- material. It has a position, the area, the size of the largest cutter that would
-- reach the region, and the reason why the cutter of the program does not.
--
-- If the material remains in an inner corner, the position is the vertex of the corner. Otherwise
-- it is the point at which the cutter's centre has to stop. The area is empty if the boundary of
-- the region is not known, or if another row has the area of this region. The size is empty for an
-- inner corner, because no round cutter reaches the vertex.
tables :: Toolpath -> [Text]
tables path = map (table (Toolpath.unit path)) (RestMaterial.ofPath path)

table :: LengthUnit -> Remaining -> Text
table unit Remaining {tool, walls, RestMaterial.positions = regions} =
  "Left along "
    <> Text.intercalate
      ", "
      [n | Part.Contour {Part.contourName = Located _ (Name n)} <- NonEmpty.toList walls]
    <> " by "
    <> Error.cutter unit tool
    <> "\n\n"
    <> Table.columns
      [ToRight, ToRight, ToRight, ToRight, ToLeft]
      ( [ "x",
          "y",
          "area " <> Decimal.unitText unit
            <> "²",
          "largest",
          "place"
        ] :
        map (row unit tool) (NonEmpty.toList regions)
      )

-- | The row of one region. @tool@ is the cutter that leaves the region. @stay@ says where on the
-- contour the material stays, such as in an inner corner. @rest@ contains the boundary of the
-- region.
row :: LengthUnit -> Tool -> (RestPosition, UnreachedPart) -> [Text]
row unit tool (stay, rest) = case stay of
  InCorner _ _ p -> at p "" "inner corner"
  AtBreak _ p thick -> at p "" ("break, " <> Decimal.inUnit unit thick <> " thick")
  InConcaveArc _ radius largest ->
    at (cutterCentre rest) (fitting largest) ("concave radius of " <> Decimal.inUnit unit radius)
  Between _ _ p largest -> at p (fitting largest) "narrow place, with the cutter's centre here"
  where
    at p largest why = case restMaterial rest of
      Within outline ->
        from p (areaText (Polyarc.signedArea (Polyarc Closed outline))) largest why
      SameAs q -> from p "" largest (why <> ", part of what stays at " <> Vec.toText unit 3 q)
      Unbounded -> from p "" largest why
    from p area largest why =
      [coordinate (Vec.x p), coordinate (Vec.y p), area, largest, why]
    areaText = Decimal.areaIn unit 3 . abs
    coordinate = Decimal.fixedIn unit 3 . Mm
    fitting = maybe "none" (Error.fittingSize unit tool)
