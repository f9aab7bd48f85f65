-- | Machining and all that belongs to it, transformed.
module Part.Transform
  ( operation,
  )
where

import Base.Region (Located (..))
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Similarity (Similarity)
import Geometry.Similarity qualified as Similarity
import Part.Part

-- | An operation on the part transformed: its contour and its ways change, the cutter and the heights
-- do not.
operation :: Similarity -> Operation -> Operation
operation s o = case o of
  Mill (Located at m) -> Mill (Located at (milling m))
  Pocket (Located at p) -> Pocket (Located at p {wall = milling (wall p), islands = map shape (islands p)})
  Drill (Located at d) -> Drill (Located at d {holes = fmap (fmap (Similarity.point s)) (holes d)})
  Travel stops -> Travel (NonEmpty.map stop stops)
  Command c -> Command c
  where
    milling m =
      m
        { contour = shape (contour m),
          side = fmap swapped (side m),
          approach = map stop (approach m),
          retract = map stop (retract m)
        }
    stop p = p {place = fmap (Similarity.point s) (place p)}
    shape c = c {elements = fmap (\e -> e {segment = Similarity.segment s (segment e)}) (elements c), legs = []}
    swapped side'
      | Similarity.mirrors s = case side' of
        LeftSide -> RightSide
        RightSide -> LeftSide
        Outside -> Outside
        Inside -> Inside
        On -> On
      | otherwise = side'
