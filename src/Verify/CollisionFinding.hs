-- | Contacts of a tool with what it must not touch, and their reports.
module Verify.CollisionFinding
  ( Collision (..),
    ToolPart (..),
    CoreTool (..),
    Contact (..),
    SolidContact (..),
    ContactPlace (..),
    HoleKind (..),
    LowTravel (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), minus, plus, times)
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
  = -- | a solid that the program avoids
    AvoidedSolid SolidContact
  | -- | stock: a point at which it still reaches above the lower end of the part, and the reason if
    -- the statement moves the tool too low
    StockLeft Point (Maybe LowTravel)
  | -- | stock where a tool needs a hole, or a stud: the radius that has to be free, and a point at
    -- which stock is left above the tip
    CoreLeft CoreTool Mm Point
  deriving stock (Eq, Show)

-- | Tool that needs a hole, or a stud, that is there before.
data CoreTool = TapInHole | ReamerInHole | ThreadMillAtWall
  deriving stock (Eq, Show)

-- | Contact with a solid that the program avoids.
data SolidContact = SolidContact
  { -- | region of its statement
    avoidStatement :: Region,
    solidTop :: Mm,
    -- | how deep the tool enters it
    depth :: Mm,
    -- | distance from it that the cutter's centre has to keep
    distanceToKeep :: Mm,
    -- | place of the tool's axis
    axisAt :: Point,
    contactPlace :: ContactPlace
  }
  deriving stock (Eq, Show)

-- | Place of a contact in the program.
data ContactPlace
  = -- | the start of the program: the tool is in the solid before its first move
    AtStart
  | -- | a hole at which the tool cannot stand: its kind and its centre, and true if the centre is
    -- within the solid
    AtHole HoleKind Point Bool
  | -- | anywhere else
    OnTheWay
  deriving stock (Eq, Show)

-- | Kind of a hole, for the words of a report.
data HoleKind = HoleInside | ThreadOutside
  deriving stock (Eq, Show)

-- | Clearance height of a statement, and the top of the stock above it.
data LowTravel = LowTravel {travelClearance :: Mm, stockTop :: Mm}
  deriving stock (Eq, Show)

-- | Report of a collision.
toReport :: LengthUnit -> Collision -> Report
toReport unit c = case contact c of
  AvoidedSolid touched -> solidReport unit c touched
  StockLeft p low -> case toolPart c of
    CutterPart ->
      (wrong c "E0744" ("frame " <> frameNumber c <> " moves in rapid into stock"))
        { message =
            ["At " <> at p <> " there is still stock."]
              <> tipSentence unit c
              <> maybe [] (lowSentence inUnit) low,
          hints = maybe ["Move at a feed there, or go over it."] (lowHints inUnit) low
        }
    _ ->
      (wrong c "E0745" (partInFrame c <> " runs into stock"))
        { message =
            ["At " <> at p <> " there is stock above its lower end, " <> lowerEnd <> "."]
              <> tipSentence unit c,
          hints = [longerTool (toolPart c)]
        }
  CoreLeft tool needed p ->
    (wrong c "E0746" (coreToolWord tool <> " in frame " <> frameNumber c <> " runs into stock"))
      { message =
          [ "At " <> at p <> " there is stock above the height " <> inUnit (tipHeight c)
              <> ", to which the tip comes down."
          ],
        hints = coreHints tool (inUnit (times 2 needed))
      }
  where
    inUnit = Decimal.inUnit unit
    at = Vec.toText unit 3
    lowerEnd = inUnit (plus (tipHeight c) (partAbove c))

-- | Words for a tool that needs a hole.
coreToolWord :: CoreTool -> Text
coreToolWord tool = case tool of
  TapInHole -> "the tap"
  ReamerInHole -> "the reamer"
  ThreadMillAtWall -> "the thread mill"

-- | Advice for a tool that needs a hole of a diameter.
coreHints :: CoreTool -> Text -> [Text]
coreHints tool diameter = case tool of
  ThreadMillAtWall -> ["Make the hole or the stud before, at least as deep as the thread."]
  _ ->
    [ "Make a hole of at least " <> diameter
        <> " before. A drill has its full diameter only above its point, so drill deeper."
    ]

-- | Cause of a rapid move into stock, if the clearance height is below the top of the stock.
lowSentence :: (Mm -> Text) -> LowTravel -> [Text]
lowSentence inUnit (LowTravel clear high) =
  [ "The clearance of " <> inUnit clear <> " is below the top of the stock at " <> inUnit high
      <> "."
  ]

-- | Advice if the clearance height is below the top of the stock.
lowHints :: (Mm -> Text) -> LowTravel -> [Text]
lowHints inUnit (LowTravel _ high) =
  ["Raise the clearance and the start above " <> inUnit high <> ", or clear this stock first."]

-- | Report of a contact with an avoided solid.
solidReport :: LengthUnit -> Collision -> SolidContact -> Report
solidReport unit c touched =
  (wrong c "E0743" title)
    { others = [Label (avoidStatement touched) extent],
      message = place,
      hints = wayPast unit c touched
    }
  where
    inUnit = Decimal.inUnit unit
    at = Vec.toText unit 3
    by = ", by " <> inUnit (depth touched)
    title = case contactPlace touched of
      AtStart ->
        partWord (toolPart c) <> " is in what the program avoids where the program begins" <> by
      _ -> partInFrame c <> " enters what the program avoids" <> by
    extent
      | isEndless c = "this has no upper end"
      | otherwise = "this reaches up to " <> inUnit (solidTop touched)
    place = case contactPlace touched of
      AtStart -> ["The tip of the tool is at " <> inUnit (tipHeight c) <> "." | not (isEndless c)]
      AtHole kind p isUnder -> (holeAt kind p <> (if isUnder then under else beside)) : tip
      OnTheWay -> ("At " <> at (axisAt touched) <> " the axis of the tool is too near to it.") : tip
    holeAt kind p = "The " <> kindWord kind <> " at " <> at p
    under = " lies under it."
    beside = " lies so near to it that the tool enters it."
    tip = tipSentence unit c

-- | Report with the place of a collision in the program.
wrong :: Collision -> Report.ReportCode -> Text -> Report
wrong c code = report Report.Error code (maybe InFile InSource (asked c))

-- | Sentence on the height of the tip, unless no height would do.
tipSentence :: LengthUnit -> Collision -> [Text]
tipSentence unit c =
  [ "The tip of the tool comes down to " <> Decimal.inUnit unit (tipHeight c) <> "."
    | not (isEndless c)
  ]

partInFrame, frameNumber :: Collision -> Text
partInFrame c = partWord (toolPart c) <> " in frame " <> frameNumber c
frameNumber = Decimal.whole . frameOfCollision

-- | Advice after a collision with a solid.
wayPast :: LengthUnit -> Collision -> SolidContact -> [Text]
wayPast unit c touched = case contactPlace touched of
  AtHole kind _ _ ->
    ["Leave this " <> kindWord kind <> " out, or move the clamp."]
      <> [longerTool HolderPart | toolPart c == HolderPart]
  AtStart -> ["Begin " <> above " or higher, or " <> "with the cutter's centre " <> beside <> "."]
  OnTheWay ->
    [ "The move passes " <> over <> "beside it if the cutter's centre keeps " <> beside <> "."
    ]
  where
    inUnit = Decimal.inUnit unit
    beside = inUnit (distanceToKeep touched) <> " away from it"
    free = inUnit (minus (solidTop touched) (partAbove c))
    above end
      | isEndless c = ""
      | otherwise = "with the tip at " <> free <> end
    over
      | isEndless c = ""
      | otherwise = "over it if the tip is at " <> free <> " or higher, and "

-- | Word for a hole or a thread.
kindWord :: HoleKind -> Text
kindWord kind = case kind of
  HoleInside -> "hole"
  ThreadOutside -> "thread"

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
