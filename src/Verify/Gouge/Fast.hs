{-# LANGUAGE BangPatterns #-}

-- | A fast test that excludes a gouge for most motions of a tape. "Verify.Gouge" decides about the
-- other motions exactly.
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

-- | False only if the motion @m@ gouges none of the given elements deeper than @best@, the deepest
-- gouge so far. True means that the exact test has to decide. @bounding@ are the bounding paths of
-- the motion, between which the cutter's centre stays ("Control.Motion"). After rounding, an arc
-- may have different radii at its start and its end. Its bounding paths then deviate from its
-- segment by at most the difference of the radii. A test of the segment therefore adds this
-- difference to the distance that is required.
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
