-- | The path of the cutter's centre in mm, exact, with the feed asked on every move.
module Path.Path
  ( Path (..),
    Block (..),
    Move (..),
    moves,
    end,
  )
where

import Base.Region (Located (..), Region)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Part.Part (Milling, Pace)

-- | Where the cutter starts, and what it does then.
data Path = Path {start :: Located Point, blocks :: [Block]}
  deriving stock (Eq, Show)

-- | The moves of one statement.
data Block
  = Travelling [Move]
  | Cutting
      { job :: Located Milling,
        approach :: [Move],
        -- | along the contour
        cut :: NonEmpty Move,
        retract :: [Move]
      }
  deriving stock (Eq, Show)

-- | One move, and the place in the program that asks for it.
data Move = Move {segment :: Segment, pace :: Pace, origin :: Region}
  deriving stock (Eq, Show)

-- | The moves of a block in order.
moves :: Block -> [Move]
moves block = case block of
  Travelling ms -> ms
  Cutting {approach, cut, retract} -> approach <> NonEmpty.toList cut <> retract

-- | Where the cutter stands at the end.
end :: Path -> Point
end path = foldl (\_ m -> Segment.end (segment m)) (value (start path)) (concatMap moves (blocks path))
