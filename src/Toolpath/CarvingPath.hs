-- | The moves of a V-carving.
module Toolpath.CarvingPath
  ( moves,
  )
where

import Base.Quantity (Mm (..))
import Base.Region (Located (..))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Part.Part (Carving, SpacePoint (..))
import Part.Part qualified as Part
import Toolpath.Error (Error)
import Toolpath.LinkingMove qualified as LinkingMove
import Toolpath.Toolpath (Manner (Manner), Move (Move))

-- | The moves of a V-carving; @at@ is the position of the tool before the statement.
moves :: SpacePoint -> Located Carving -> Either Error (NonEmpty Move)
moves at (Located region c) =
  Right
    ( case LinkingMove.rise at clear word <> over of
        [] -> down :| [up]
        m : more -> m :| more <> [down, up]
    )
  where
    word = LinkingMove.keyword 6 region
    clear = Part.carvingTravel c
    (outline, _) = NonEmpty.head (Part.carvedAreas c)
    p = Segment.start (Part.segment (NonEmpty.head (Part.elements outline)))
    from = SpacePoint (plane at) (max clear (height at))
    over = LinkingMove.straightMoves from [Part.Stop (Located word p) (Just clear) Part.Rapid]
    feed = fromMaybe (Part.carvingFeed c) (Part.carvingPlunge c)
    down = Move (Straight p p) (Manner (clear, Mm 0) (Part.At feed) False) word False
    up = Move (Straight p p) (Manner (Mm 0, clear) Part.Rapid False) word False
