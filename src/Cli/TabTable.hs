-- | Tables of the tabs that hold a part.
module Cli.TabTable
  ( tables,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (LengthUnit, Mm (..), degrees)
import Base.Region (Located (..))
import Cli.Table (Align (..))
import Cli.Table qualified as Table
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Milling, Tabs)
import Part.Part qualified as Part
import Toolpath.Toolpath (Block (Cutting, job, pass, tabs), Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | One table for each milling statement that leaves tabs. A row has the position of the cutter's
-- centre over the middle of a tab in the last pass, its width, the height of its top, and the angle
-- of its sides.
tables :: Toolpath -> [Text]
tables path =
  [table (Toolpath.unit path) milling asked middles | (milling, asked, middles) <- Map.elems last']
  where
    last' =
      Map.fromList
        [ (Toolpath.number pass, (milling, asked, tabs))
          | Cutting {job = Located _ milling, pass, tabs} <- Toolpath.blocks path,
            not (null tabs),
            Just (Located _ asked) <- [Part.tabs milling]
        ]

table :: LengthUnit -> Milling -> Tabs -> [Point] -> Text
table unit milling asked middles =
  "Tabs of "
    <> (let Name n = value (Part.contourName (Part.contour milling)) in n)
    <> "\n\n"
    <> Table.columns
      [ToRight, ToRight, ToRight, ToRight, ToRight, ToRight]
      (["tab", "x", "y", "width", "top", "sides"] : zipWith row [1 :: Int ..] middles)
  where
    row k p =
      [ Decimal.whole k,
        fixed (Mm (Vec.x p)),
        fixed (Mm (Vec.y p)),
        fixed (Part.tabWidth asked),
        fixed (Part.tabTop asked),
        Decimal.short 2 (degrees (Part.tabSides asked)) <> "°"
      ]
    fixed :: Mm -> Text
    fixed = Decimal.fixedInUnit unit 3
