-- | Works on the wall or the rim of a cylinder that the program mills: threads, reaming and
-- countersinking. Their tools cut a little into the cylinder, as the statement demands. All other
-- cutters keep away from it.
module Verify.RimWork
  ( RimWork,
    rimWorks,
    keepOut,
  )
where

import Base.Quantity (Mm (..), minus, plus)
import Base.Region (Located (..))
import Data.IntMap.Strict qualified as IntMap
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Carrier (Side)
import Geometry.Segment (Segment (Arc, centre, start))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Element, HoleForm)
import Part.Part qualified as Part
import Part.WallDepth (wallDepth, worksOn)
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.Gouge (KeepOut (..))
import Verify.Gouge qualified as Gouge
import Verify.Motion (CutterMotion (segment))
import Verify.Motion qualified as Motion

-- | A work on a cylinder.
data RimWork = RimWork
  { form :: HoleForm,
    -- | point of the axis of the cylinder in the plane
    axis :: Point,
    -- | depth in mm to which the tool may go below the wall, by the radius of the tool and the
    -- radius of the cylinder
    depthBelow :: Mm -> Mm -> Mm
  }

-- | Works that a motion may do. @toolsIn@ are the indices of the tools that may be in the spindle.
-- There are none if these are several.
rimWorks :: Toolpath -> (CutterMotion -> [Int]) -> CutterMotion -> [RimWork]
rimWorks path toolsIn = \m -> case toolsIn m of
  [t] -> [w | (isFor, w) <- IntMap.findWithDefault [] t works, isFor m]
  _ -> []
  where
    blocks = Toolpath.blocks path
    works =
      IntMap.fromListWith
        (<>)
        [ (t, [(isFor p, RimWork (Part.form d) p deep)])
          | (t, Toolpath.Holing (Located _ d) _) <- zip (Toolpath.toolIndices blocks) blocks,
            Part.Hole (Located _ p) _ mouth <- NonEmpty.toList (Part.holes d),
            Just most <- [wallDepth d mouth],
            (isFor, deep) <- [depthOf d (plus most slack)]
        ]
    depthOf d most = case Part.form d of
      Part.Threaded h -> (\_ _ -> True, \_ r -> upTo most (toothDepth h r))
      _ -> (isOnAxis, \tool r -> upTo most (minus tool r))
    toothDepth h r
      | Part.isInside h = minus (Part.toothRadius h) r
      | otherwise = minus r (Part.toothRadius h)
    upTo most d = if d <= most then d else Mm 0
    isOnAxis p m = Motion.isVertical m && Vec.distance p (Segment.end (segment m)) <= nearAxis

-- | Uncertainty of a depth by rounding, in mm.
slack :: Mm
slack = Mm 0.001

-- | Distance from its axis within which a tool works on a cylinder, in mm: some pulses.
nearAxis :: Mm
nearAxis = Mm 0.05

-- | Distance that a cutter of a radius keeps from the elements of a contour. On the cylinder of one
-- of its works it is smaller. @side@ is the side of the contour on which its cutter moves; Nothing
-- if the cutter's centre moves on the contour.
keepOut :: [RimWork] -> Maybe Side -> Mm -> KeepOut
keepOut works side radius
  | null works = constant
  | otherwise = constant {required = \e _ -> minus radius (deepestIn e)}
  where
    constant = Gouge.constantKeepOut radius
    deepestIn e = maximum (Mm 0 : map (depthIn side radius e) works)

-- | Depth to which a tool may go below an element; 0 for an element that is no wall of the
-- cylinder.
depthIn :: Maybe Side -> Mm -> Element -> RimWork -> Mm
depthIn side radius e RimWork {form, axis, depthBelow} = case Part.segment e of
  s@Arc {start, centre}
    | worksOn form axis side s -> depthBelow radius (Segment.radius centre start)
  _ -> Mm 0
