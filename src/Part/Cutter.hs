-- | Tools of the evaluated part, as the program gives them.
module Part.Cutter
  ( Cutter (..),
    CutterKind (..),
    ToolBody (..),
    plainBody,
    HolderCylinder (..),
    radiusAbove,
  )
where

import Base.Quantity (Mm (..), Rad (..), plus, times)
import Base.Region (Region)

-- | A tool: its kind, and the radius at which it touches the part.
data Cutter = Cutter
  { kind :: CutterKind,
    cutterRadius :: Mm,
    -- | the region of the diameter, or of the radius of the nose; absent for a cone
    -- and for a V-bit
    cutterSize :: Maybe Region,
    -- | the direction of the tip of a turning tool, from 1 to 9, as the tool table of a control has
    -- it; absent if the program does not give it
    tip :: Maybe Int,
    -- | the radius at the tip; the same as 'cutterRadius' unless the tool is conical
    tipRadius :: Mm,
    body :: ToolBody
  }
  deriving stock (Eq, Show)

-- | The body of a tool, as far as the program gives it. Above the tip the tool has its radius up to
-- the holder. Lengths are measured from the tip.
data ToolBody = ToolBody
  { -- | the length of the cutting edges
    fluteLength :: Maybe Mm,
    -- | the length up to the holder
    stickOut :: Maybe Mm,
    -- | the cylinders of the holder, from below. The highest one has no end
    holder :: [HolderCylinder],
    -- | the angle of the point of a drill, of a cone or of a V-bit; absent for other tools
    pointAngle :: Maybe Rad
  }
  deriving stock (Eq, Show)

-- | A body of which the program gives nothing.
plainBody :: ToolBody
plainBody = ToolBody Nothing Nothing [] Nothing

-- | A cylinder of a holder, and the height of its lower end above the tip of the tool.
data HolderCylinder = HolderCylinder {holderRadius :: Mm, aboveTip :: Mm}
  deriving stock (Eq, Show)

-- | The radius of a tool at a height above its tip, which is not negative. The flank of a V-bit
-- widens upwards, up to the radius of its top. All other tools count as wide as where they touch
-- the part.
radiusAbove :: Mm -> Cutter -> Mm
radiusAbove height c = case (kind c, pointAngle (body c)) of
  (VBitCutter, Just (Rad a)) ->
    min (cutterRadius c) (plus (tipRadius c) (times (tan (a / 2)) (max (Mm 0) height)))
  _ -> cutterRadius c

-- | The kind of a tool.
data CutterKind
  = -- | a cutter with a flank parallel to its axis
    MillingCutter
  | -- | a cutter with a conical flank that is narrowest at the tip
    ConeCutter
  | -- | a cutter with a conical flank, given by the angle of its point. It is narrowest at the tip
    VBitCutter
  | -- | a cutter with a conical flank that is widest at the tip
    DovetailCutter
  | -- | a blade that swivels along the contour. The field is the diameter of the wheel that swivels
    -- the blade
    BladeCutter Mm
  | DrillingCutter
  | TappingCutter
  | -- | a thread mill with teeth of this pitch
    ThreadCutter Mm
  | TurningCutter
  deriving stock (Eq, Show)
