-- | Lead-in and lead-out: the moves onto the offset of a contour and off it.
module Toolpath.Lead
  ( Which (..),
    lead,
  )
where

import Base.Quantity (Mm (..))
import Base.Region (Region)
import Data.Maybe (fromMaybe)
import Geometry.Carrier qualified as Carrier
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Milling (feed))
import Part.Part qualified as Part
import Toolpath.Toolpath (Manner (Manner), Move (Move))

-- | The lead-in or the lead-out.
data Which = In | Out
  deriving stock (Eq, Show)

-- | The lead-in at the start of a path, or the lead-out at its end; empty if the program asks for
-- none. It is a straight line in the direction of the path, or a quarter of a circle that curves
-- away from the material. @side@ is the cutter's side of the contour; if it is Nothing, the circle
-- is on the left of the path. @keyword@ is the region of the statement's first word. @p@ is the
-- start of the path for a lead-in and its end for a lead-out; @direction@ is the unit direction of
-- the path at @p@. The heights of the move are 0; the caller sets them.
lead :: Region -> Milling -> Maybe Carrier.Side -> Which -> Vec.Vec -> Point -> [Move]
lead keyword milling side which direction p =
  case if which == In then Part.leadIn milling else Part.leadOut milling of
    Nothing -> []
    Just (Part.LeadLine, Mm l) ->
      let q = Vec.shift (Vec.scale (outwards * l) direction) p
       in [move (oriented (Straight q p) (Straight p q))]
    Just (Part.LeadArc, Mm r) ->
      let centre = Carrier.beside freeSide (Mm r) direction p
          q = Vec.shift (Vec.scale (outwards * r) direction) centre
          sense = Carrier.senseTowards freeSide
       in [move (oriented (Segment.arc sense centre q p) (Segment.arc sense centre p q))]
  where
    outwards = if which == In then -1 else 1
    oriented onto off = if which == In then onto else off
    move s = Move s (Manner (Mm 0, Mm 0) (Part.At (feed milling)) False) keyword False
    freeSide = fromMaybe Carrier.LeftOf side
