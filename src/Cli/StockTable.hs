-- | Tables of what the proof follows: the stock, the solids that the program avoids, and the bodies
-- of the tools.
module Cli.StockTable
  ( tables,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit (..), Mm (..), Seconds (..), millimetresIn, times, total)
import Base.Region (Located (..))
import Cli.Table (Align (..))
import Cli.Table qualified as Table
import Data.Foldable (toList)
import Data.Maybe (maybeToList)
import Data.Text (Text)
import Draw.Page qualified as Page
import Frame.MoveTime (moveTime)
import Geometry.Index.BoundingBox (BoundingBox (BoundingBox))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)
import Part.Part (Cutter (body, cutterRadius), HolderCylinder (..), Solid (..), ToolBody (..))
import Part.Part qualified as Part
import Toolpath.StockLayer qualified as StockLayer
import Toolpath.Toolpath (Setup (..), Toolpath (setup))
import Toolpath.Toolpath qualified as Toolpath

-- | A table of the stock, one of the avoided solids, and one of the tools with sizes of their
-- bodies. Each of them is left out if the program gives nothing for it.
tables :: LengthUnit -> Maybe Machine -> Toolpath -> [Text]
tables unit machine path =
  [stockTable unit machine path s | Located _ s <- maybeToList (stock (setup path))]
    <> avoidedTable unit (Toolpath.isTurned path) (map value (avoided (setup path)))
    <> toolTable unit (toolsOf path)

-- | The volumes of the stock, and the time of the moves at feed that reach below its top.
stockTable :: LengthUnit -> Maybe Machine -> Toolpath -> Solid -> Text
stockTable unit machine path solid =
  "Stock " <> (if Toolpath.isTurned path then "of the turned part" else heightsText unit solid)
    <> "\n\n"
    <> Table.columns [ToLeft, ToRight, ToLeft] rows
  where
    rows
      | isEndless solid && not (Toolpath.isTurned path) = [inCut]
      | Toolpath.isTurned path && isBelowAxis =
        [["volume", "", "the stock goes below the axis"], inCut]
      | otherwise = case StockLayer.stockLayers path solid of
        Left _ -> [["volume removed", "", "rounding decides"], inCut]
        Right layers ->
          let removed = StockLayer.removedVolume path solid layers
              left = StockLayer.volume path layers
           in [ volumeRow "stock" (removed + left),
                volumeRow "volume removed" removed,
                volumeRow "volume left" left,
                inCut
              ]
    isBelowAxis = let BoundingBox _ low _ _ = extentOf solid in low < -1e-6
    inCut = ["time in the cut", let Seconds s = time in Decimal.fixed 1 s, "s"]
    time =
      total
        [ moveTime machine m
          | m <- concatMap Toolpath.moves (Toolpath.blocks path),
            Toolpath.pace m /= Part.Rapid,
            uncurry min (Toolpath.heights m) < highest solid
        ]
    volumeRow word v = case unit of
      Millimetres -> [word, Decimal.fixed 3 (v / 1000), "cm³"]
      Inches -> [word, Decimal.fixed 4 (v / millimetresIn Inches ^ (3 :: Int)), "in³"]

-- | True of a solid without heights.
isEndless :: Solid -> Bool
isEndless solid = highest solid >= Tolerance.reach

heightsText :: LengthUnit -> Solid -> Text
heightsText unit solid
  | isEndless solid = "at all heights"
  | otherwise =
    "from " <> Decimal.inUnit unit (lowest solid) <> " to " <> Decimal.inUnit unit (highest solid)

-- | The extents of the avoided solids.
avoidedTable :: LengthUnit -> Bool -> [Solid] -> [Text]
avoidedTable unit isTurned solids =
  [ "Avoided by all tools\n\n"
      <> Table.columns
        (if isTurned then replicate 4 ToRight else replicate 6 ToRight)
        (heading : map row solids)
    | not (null solids)
  ]
  where
    heading = ["x from", "to", "y from", "to"] <> (if isTurned then [] else ["z from", "to"])
    row s =
      let BoundingBox x y x' y' = extentOf s
       in map (fixed . Mm) [x, x', y, y']
            <> if isTurned then [] else heightsOf s
    heightsOf s = if isEndless s then ["all", ""] else map fixed [lowest s, highest s]
    fixed = Decimal.fixedIn unit 3

-- | Bounding box of the base of a solid.
extentOf :: Solid -> BoundingBox
extentOf s = case [Page.extent (Part.segment e) | c <- outlines s, e <- toList (Part.elements c)] of
  [] -> BoundingBox.ofPoints (Vec.point 0 0) []
  b : bs -> foldr BoundingBox.union b bs

-- | The tools of a toolpath that have sizes of a body, each with its number if it has one.
toolsOf :: Toolpath -> [(Maybe Int, Cutter)]
toolsOf path =
  [ (n, c)
    | (n, c) <- first <> changed,
      body c /= Part.plainBody
  ]
  where
    first = [(value <$> firstToolNumber (setup path), c) | Just c <- [firstCutter (setup path)]]
    changed =
      [ (Just n, c)
        | Toolpath.Commanding (Located _ (Part.ChangeTool n c)) <- Toolpath.blocks path
      ]

-- | The bodies of the tools. Lengths are measured from the tip.
toolTable :: LengthUnit -> [(Maybe Int, Cutter)] -> [Text]
toolTable unit tools =
  [ "Bodies of the tools\n\n"
      <> Table.columns
        [ToRight, ToRight, ToRight, ToRight, ToLeft]
        (["tool", "diameter", "flutes", "stick-out", "holder"] : map row tools)
    | not (null tools)
  ]
  where
    row (n, c) =
      [ maybe "" Decimal.whole n,
        short (times 2 (cutterRadius c)),
        maybe "" short (fluteLength (body c)),
        maybe "" short (stickOut (body c)),
        holderText (holder (body c))
      ]
    short = Decimal.shortIn unit 3
    holderText cylinders = case cylinders of
      [] -> ""
      [h] -> cylinder h
      h : more -> cylinder h <> ", " <> holderText more
    cylinder (HolderCylinder r z) = "Ø " <> short (times 2 r) <> " from " <> short z
