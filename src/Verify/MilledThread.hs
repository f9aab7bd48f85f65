-- | Threads that are milled on a cylinder of the program. The teeth go below the cylinder, as the
-- statement demands. All other cutters keep away from it.
module Verify.MilledThread
  ( Thread,
    threadsOf,
    keepOut,
  )
where

import Base.Quantity (Mm (..), minus)
import Base.Region (Located (..))
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Segment (Segment (Arc, centre, start))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Cutter, CutterKind (ThreadCutter), Element)
import Part.Part qualified as Part
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.Gouge (KeepOut (..))
import Verify.Gouge qualified as Gouge

-- | Axis of a thread, and the helix that its teeth make.
data Thread = Thread Point Part.ThreadHelix

-- | Threads of a toolpath, for the tools that may be in the spindle. Empty if one of the tools is
-- no thread mill.
threadsOf :: Toolpath -> [Cutter] -> [Thread]
threadsOf path = \tools -> if not (null tools) && all isThreadMill tools then threads else []
  where
    isThreadMill c = case Part.kind c of
      ThreadCutter _ -> True
      _ -> False
    threads =
      [ Thread p helix
        | Toolpath.Holing (Located _ d) _ <- Toolpath.blocks path,
          Part.Threaded helix <- [Part.form d],
          Part.Hole (Located _ p) _ _ <- NonEmpty.toList (Part.holes d)
      ]

-- | Distance that a cutter of a radius keeps from the elements of a contour. On the cylinder of a
-- thread it is smaller by the depth of the teeth.
keepOut :: [Thread] -> Mm -> KeepOut
keepOut threads radius
  | null threads = constant
  | otherwise = constant {required = \e _ -> minus radius (deepestIn e)}
  where
    constant = Gouge.constantKeepOut radius
    deepestIn e = maximum (Mm 0 : map (depthIn e) threads)

-- | Depth of the teeth of a thread below an element; 0 for an element that is no arc about the axis
-- of the thread.
depthIn :: Element -> Thread -> Mm
depthIn e (Thread axis helix) = case Part.segment e of
  Arc {start, centre}
    | Vec.isNear centre axis ->
      let r = Segment.radius centre start
          tooth = Part.toothRadius helix
       in if Part.isInside helix then minus tooth r else minus r tooth
  _ -> Mm 0
