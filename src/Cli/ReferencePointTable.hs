-- | The tables of reference points in the subcommand @report@, with the option @--points@: for each
-- row of a curve's table the point of the curve, the point of the contour after the ciphers, and
-- the position of the cutter's centre. Lengths are in the unit of the program.
module Cli.ReferencePointTable
  ( tables,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (LengthUnit, Mm (..))
import Base.Region (Located (..), Position (..), Region (..), Source)
import Base.Region qualified as Region
import Cli.Table (Align (..))
import Cli.Table qualified as Table
import Data.List.NonEmpty (NonEmpty)
import Data.Text (Text)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Milling, Part, SpacePoint (..))
import Part.Part qualified as Part
import Toolpath.ReferencePoint (PieceRows (..), ReferencePoint (..))
import Toolpath.ReferencePoint qualified as ReferencePoint
import Toolpath.Toolpath (Move, Pass)

-- | The tables of one pass along a contour, one for each curve that has a table. @passWord@ says
-- the height and the allowance of the pass.
tables :: Source -> Part -> Located Milling -> Pass -> Text -> NonEmpty Move -> [Text]
tables source part (Located _ job) pass passWord cut =
  map
    (table (Part.unit part) source (contourName <> passWord))
    (ReferencePoint.ofPass part job pass cut)
  where
    Name contourName = value (Part.contourName (Part.contour job))

-- | The table of one piece. The column z is left out if all heights are 0.
table :: LengthUnit -> Source -> Text -> PieceRows -> Text
table unit source contour piece =
  "Reference points of "
    <> contour
    <> ", curve in line "
    <> lineWord source (element piece)
    <> ": "
    <> Decimal.whole (length (points piece))
    <> " of "
    <> Decimal.whole (rowCount piece)
    <> " rows on the contour\n"
    <> if null (points piece)
      then ""
      else
        "\n"
          <> Table.columns
            (map (const ToRight) titles)
            (titles : map row' (points piece))
  where
    titles =
      ["row", "curve x", "curve y", "part x", "part y", "x", "y"] <> ["z" | hasHeights]
    hasHeights = or [height z /= Mm 0 | p <- points piece, Just z <- [centre p]]
    row' p =
      [Decimal.whole (row p)]
        <> coordinates unit (given p)
        <> coordinates unit (onPart p)
        <> maybe
          ("not reached" : "" : ["" | hasHeights])
          (\c -> coordinates unit (plane c) <> [fixed3 unit (height c) | hasHeights])
          (centre p)

-- | The number, from 1, of the line in which a region begins. If the line is in an imported file,
-- the name of the file precedes the number.
lineWord :: Source -> Region -> Text
lineWord source region =
  (if file == Region.mainFile source then "" else file <> ":") <> Decimal.whole line
  where
    Position {file, line} = Region.position source (start region)

coordinates :: LengthUnit -> Point -> [Text]
coordinates unit p = [fixed3 unit (Mm (Vec.x p)), fixed3 unit (Mm (Vec.y p))]

-- | A length without its unit: three decimals in mm, four in inches.
fixed3 :: LengthUnit -> Mm -> Text
fixed3 unit = Decimal.fixedIn unit 3
