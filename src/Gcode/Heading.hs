-- | What a G-code file says besides its motions: the part, the tools, the work offset.
module Gcode.Heading
  ( Heading (..),
    fromToolpath,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), times)
import Base.Region (Located (..))
import Data.Text (Text)
import Part.Part (Command (ChangeTool), Cutter (..), CutterKind (..))
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | What a file says besides its frames.
data Heading = Heading
  { partName :: Text,
    partTitle :: Text,
    -- | number of the work offset, 54 to 59
    workOffset :: Int,
    programNumber :: Maybe Int,
    -- | number of the tool that is in the spindle first
    firstTool :: Maybe Int,
    -- | the tools in the order of their use, each with its number and a description
    toolList :: [(Int, Text)],
    -- | height in mm that is above everything, in work coordinates
    safeHeight :: Maybe Mm,
    isSpindleByHand :: Bool
  }
  deriving stock (Eq, Show)

-- | Heading of the files of a toolpath.
fromToolpath :: Toolpath -> Heading
fromToolpath path =
  Heading
    { partName = "",
      partTitle = "",
      workOffset = 54,
      programNumber = Nothing,
      firstTool = Just 1,
      toolList =
        [ (n, cutterText cutter)
          | Toolpath.Commanding (Located _ (ChangeTool n cutter)) <- Toolpath.blocks path
        ],
      safeHeight = Nothing,
      isSpindleByHand = False
    }

-- | Description of a tool: its kind and its diameter, or the radius of its nose.
cutterText :: Cutter -> Text
cutterText cutter = case kind cutter of
  MillingCutter -> "mill, diameter " <> diameter
  _ -> "tool, diameter " <> diameter
  where
    diameter = Decimal.mm (times 2 (cutterRadius cutter))
