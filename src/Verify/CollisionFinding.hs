-- | Contacts of a tool with what it must not touch, and their reports.
module Verify.CollisionFinding
  ( Collision (..),
    ToolPart (..),
    Contact (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), minus, plus)
import Base.Region (Region)
import Data.Text (Text)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Report.Report (Label (..), Report (hints, message, others), ReportPlace (..), report)
import Report.Report qualified as Report

-- | Contact of a tool with an avoided solid or with stock.
data Collision = Collision
  { -- | number of the frame, from 1
    frameOfCollision :: Int,
    -- | text in the program that asks for the frame; Nothing if the tape has other frames than
    -- planned
    asked :: Maybe Region,
    toolPart :: ToolPart,
    -- | height of the lower end of this part above the tip of the tool
    partAbove :: Mm,
    -- | lowest height of the tip on the part of the motion that collides
    tipHeight :: Mm,
    -- | true if the body has no top, so that no height would do
    isEndless :: Bool,
    contact :: Contact
  }
  deriving stock (Eq, Show)

-- | Part of a tool.
data ToolPart
  = -- | the cutter, from the tip upwards
    CutterPart
  | -- | what is above the flutes
    ShankPart
  | HolderPart
  deriving stock (Eq, Show)

-- | Body that a tool touches.
data Contact
  = -- | a solid that the program avoids: the region of its statement, its top, how deep the tool
    -- enters it, and the distance from it that the cutter's centre has to keep
    AvoidedSolid Region Mm Mm Mm
  | -- | stock: a point at which it still reaches above the lower end of the part
    StockLeft Point
  deriving stock (Eq, Show)

-- | Report of a collision.
toReport :: LengthUnit -> Collision -> Report
toReport unit c = case contact c of
  AvoidedSolid region top deep away ->
    (wrong "E0743" (word <> " enters what the program avoids, by " <> inUnit deep))
      { others = [Label region (extent top)],
        message = tipSentence,
        hints = [wayPast unit c top away]
      }
  StockLeft p -> case toolPart c of
    CutterPart ->
      (wrong "E0744" ("frame " <> number' <> " moves in rapid into stock"))
        { message = ["At " <> at p <> " there is still stock."] <> tipSentence,
          hints = ["Move at a feed there, or go over it."]
        }
    _ ->
      (wrong "E0745" (word <> " runs into stock"))
        { message =
            ["At " <> at p <> " there is stock above its lower end, " <> lowerEnd <> "."]
              <> tipSentence,
          hints = [longerTool (toolPart c)]
        }
  where
    wrong code = report Report.Error code (maybe InFile InSource (asked c))
    number' = Decimal.whole (frameOfCollision c)
    inUnit = Decimal.inUnit unit
    at = Vec.toText unit 3
    lowerEnd = inUnit (plus (tipHeight c) (partAbove c))
    extent top
      | isEndless c = "this has no upper end"
      | otherwise = "this reaches up to " <> inUnit top
    tipSentence =
      ["The tip of the tool comes down to " <> inUnit (tipHeight c) <> "." | not (isEndless c)]
    word = partWord (toolPart c) <> " in frame " <> number'

-- | Advice after a collision with a solid: the height above its top, and the distance @away@ from
-- it that the cutter's centre has to keep.
wayPast :: LengthUnit -> Collision -> Mm -> Mm -> Text
wayPast unit c top away =
  "The move passes " <> over <> "beside it if the cutter's centre keeps " <> inUnit away
    <> " away from it."
  where
    over
      | isEndless c = ""
      | otherwise =
        "over it if the tip is at " <> inUnit (minus top (partAbove c)) <> " or higher, and "
    inUnit = Decimal.inUnit unit

-- | Words for a part of a tool.
partWord :: ToolPart -> Text
partWord part = case part of
  CutterPart -> "the cutter"
  ShankPart -> "the shank above the flutes"
  HolderPart -> "the holder"

-- | Advice after a collision of a part of a tool with stock.
longerTool :: ToolPart -> Text
longerTool part = case part of
  HolderPart -> "Let the tool stick out further, or clear the place for the holder before."
  _ ->
    "Take a tool with longer flutes, or go down in more passes. The word flutes gives the length \
    \of the cutting edges, not their count."
