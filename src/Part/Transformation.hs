-- | Machining and all that belongs to it, transformed.
module Part.Transformation
  ( operation,
  )
where

import Base.Region (Located (..))
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Transformation (Transformation)
import Geometry.Transformation qualified as Transformation
import Part.Part

-- | An operation on the part transformed: its contour and its ways change, the cutter and the
-- heights do not.
operation :: Transformation -> Operation -> Operation
operation s o = case o of
  Mill (Located at m) -> Mill (Located at (milling m))
  Pocket (Located at p) ->
    Pocket (Located at p {wall = milling (wall p), islands = map shape (islands p)})
  Drill (Located at d) ->
    Drill (Located at d {holes = fmap (fmap (Transformation.point s)) (holes d)})
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
    stop p = p {place = fmap (Transformation.point s) (place p)}
    shape c =
      c
        { elements = fmap (\e -> e {segment = Transformation.segment s (segment e)}) (elements c),
          legs = []
        }
    swapped side'
      | Transformation.mirrors s = case side' of
        LeftSide -> RightSide
        RightSide -> LeftSide
        Outside -> Outside
        Inside -> Inside
        On -> On
      | otherwise = side'
