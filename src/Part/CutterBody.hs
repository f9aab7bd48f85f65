-- | Forms of tools that count for stock and for clamps.
module Part.CutterBody
  ( Cylinder (..),
    cylindersOf,
    removalRadius,
    widensUpwards,
    pointHeight,
    flankHeight,
    pointOf,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus)
import Part.Part (Cutter (..), CutterKind (..), HolderCylinder (..), ToolBody (..))

-- | A part of a tool: its radius, and the height of its lower end above the tip. It counts as if it
-- had no upper end.
data Cylinder = Cylinder {radius :: Mm, above :: Mm}
  deriving stock (Eq, Show)

-- | The cylinders of a tool: the cutter, then those of the holder. A conical cutter has its largest
-- radius that is known.
cylindersOf :: Cutter -> [Cylinder]
cylindersOf c =
  Cylinder {radius = max (cutterRadius c) (tipRadius c), above = Mm 0} :
    [Cylinder {radius = r, above = z} | HolderCylinder r z <- holder (body c)]

-- | The radius within which a tool surely removes all stock above its tip, and above its point.
removalRadius :: Cutter -> Mm
removalRadius c = case kind c of
  MillingCutter -> cutterRadius c
  ConeCutter -> tipRadius c
  VBitCutter -> tipRadius c
  DovetailCutter -> Mm 0
  BladeCutter _ -> Mm 0
  DrillingCutter -> cutterRadius c
  -- They remove only the grooves of a thread.
  TappingCutter -> Mm 0
  ThreadCutter _ -> Mm 0
  TurningCutter -> cutterRadius c

-- | Test that a tool is a cone, whose radius nowhere falls with the height above the tip.
widensUpwards :: Cutter -> Bool
widensUpwards c = case kind c of
  ConeCutter -> tipRadius c <= cutterRadius c
  VBitCutter -> True
  _ -> False

-- | The height of the point of a drill; 0 for other tools.
pointHeight :: Cutter -> Mm
pointHeight c = case kind c of
  DrillingCutter -> let Mm r = cutterRadius c in Mm (r / tan (pointOf c / 2))
  _ -> Mm 0

-- | The height of the flank of a V-bit, and that of a cone up to the height at which it touches a
-- contour; 0 for other tools. The flank begins at the tip.
flankHeight :: Cutter -> Mm
flankHeight c = case (kind c, pointAngle (body c)) of
  (ConeCutter, Just (Rad a)) -> height a
  (VBitCutter, Just (Rad a)) -> height a
  _ -> Mm 0
  where
    height a = let Mm wider = minus (cutterRadius c) (tipRadius c) in Mm (wider / tan (a / 2))

-- | The angle in radians of the point of a drill: the usual 118° if the program does not give it.
pointOf :: Cutter -> Double
pointOf c = case pointAngle (body c) of
  Just (Rad a) -> a
  Nothing -> 118 * pi / 180
