{-# LANGUAGE BangPatterns #-}

-- | A test for gouges by fast bounds, for every motion of a tape. "Verify.Gouge" decides about the
-- motions that it cannot exclude.
module Verify.Gouge.Fast
  ( mayGougeDeeper,
  )
where

import Base.Quantity (Mm (..))
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Segment (Segment)
import Verify.Edge (Edge (shape))
import Verify.Gouge (KeepOut (..))
import Verify.Motion (CutterMotion (segment), connectors)
import Verify.Proof (Witness)
import Verify.Proof qualified as Proof

-- | False only if no element is gouged deeper than by the deepest gouge so far. @bounding@ are the
-- bounding paths of the motion. Those of an arc are no further from its segment than its two radii
-- differ.
mayGougeDeeper :: KeepOut -> Maybe Witness -> CutterMotion -> [Segment] -> [Edge] -> Bool
mayGougeDeeper keepOut best m bounding = go
  where
    go edges = case edges of
      [] -> False
      e : more -> mayGouge (shape e) || go more
    mayGouge e =
      FastDistance.apartAtLeast centrePath e < least + difference
        && FastDistance.apart centrePath e < least + difference
        && ( difference <= 0
               || any (\path -> FastDistance.apart path e < least) (bounding <> connectors m)
           )
    !centrePath = segment m
    !difference = FastDistance.uneven centrePath
    !least = case best of
      Nothing -> d + FastDistance.unsure
      Just gouge -> let Mm a = Proof.amount gouge in d - a + FastDistance.unsure
    !(Mm d) = largest keepOut
