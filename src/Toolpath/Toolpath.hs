{-# LANGUAGE BangPatterns #-}

-- | The path of the cutter's centre in mm, exact, with the feed asked on every move.
module Toolpath.Toolpath
  ( Toolpath (..),
    Block (..),
    Pass (..),
    Sent (..),
    Move (..),
    Manner (..),
    heights,
    pace,
    braked,
    unbraked,
    atHeights,
    moves,
    passNumbers,
    runs,
    isCurve,
    isFlat,
    end,
    withoutCuts,
  )
where

import Base.Quantity (Mm (..))
import Base.Region (Located (..), Region)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isNothing)
import Geometry.Carrier (Side)
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Offset.Equidistant qualified as Equidistant
import Part.Part (Command, Drilling, Milling, Pace, Pocketing, SpacePoint (..))
import Part.Part qualified as Part

-- | Where the cutter starts, and what it does then.
data Toolpath = Toolpath
  { start :: Located SpacePoint,
    blocks :: [Block],
    -- | the part is turned on a lathe
    isTurned :: Bool
  }
  deriving stock (Eq, Show)

-- | What one statement, or one pass of it, asks of the machine.
data Block
  = -- | with a cutter of this radius
    Travelling Mm [Move]
  | Cutting
      { job :: Located Milling,
        pass :: Pass,
        approach :: [Move],
        -- | along the contour
        cut :: NonEmpty Move,
        retract :: [Move],
        -- | what stays on the contour where the cutter does not reach, in the first cut of the pass
        rests :: [Equidistant.UnreachedPart],
        -- | if the control keeps the cutter beside the contour
        sent :: Maybe Sent
      }
  | -- | one pass of a pocket; its outline and islands are walked as the cutter walks along them
    Clearing
      { pocket :: Located Pocketing,
        pass :: Pass,
        approach :: [Move],
        -- | along loops, and from each to the next
        cleared :: NonEmpty Move,
        retract :: [Move],
        -- | what stays at the walls in the end, by the elements of the outline and of the islands
        -- in order
        rests :: [Equidistant.UnreachedPart]
      }
  | Holing (Located Drilling) [Move]
  | Commanding (Located Command)
  deriving stock (Eq, Show)

-- | One pass along a contour, or in a pocket: the number of the milling statement as it is carried
-- out, from 0; the distance of the cutter's centre from the contour; what of it is left to be cut;
-- the height.
data Pass = Pass {number :: Int, reach :: Mm, left :: Mm, atHeight :: Mm}
  deriving stock (Eq, Show)

-- | What a control is sent instead of the moves of a pass when it keeps the cutter beside the
-- contour by itself: the edge of the part. What it makes of that are the moves of the pass, with
-- the same ends but for where compensation begins.
data Sent = Sent
  { -- | moves of the cutter's centre up to where compensation is switched on
    before :: [Move],
    side :: Side,
    -- | straight, from where the centre stands to where the edge begins
    entry :: Move,
    -- | in the order of the walk: the lead in, the elements of the contour, the lead out. The
    -- control goes round outer corners on arcs
    edge :: NonEmpty Move,
    -- | straight, from the end of the edge to where the centre arrives when compensation is off
    exit :: Move,
    -- | moves of the centre behind that
    behind :: [Move]
  }
  deriving stock (Eq, Show)

-- | One move, in the plane and in height, and the place in the program that asks for it. A move
-- straight up or down has a segment without length.
data Move = Move
  { segment :: Segment,
    manner :: Manner,
    origin :: Region,
    -- | it goes on, without a corner, with the curve of the move before
    continues :: Bool
  }
  deriving stock (Eq, Show)

-- | How a move goes. Most moves along a contour go alike, and share it.
data Manner = Manner
  { -- | at the beginning and at the end of the move
    between :: (Mm, Mm),
    at :: Pace,
    -- | slow down at the end
    slowing :: Bool
  }
  deriving stock (Eq, Show)

-- | The heights of a move at its beginning and at its end.
heights :: Move -> (Mm, Mm)
heights = between . manner

pace :: Move -> Pace
pace = at . manner

-- | Whether a move slows down at its end.
braked :: Move -> Bool
braked = slowing . manner

-- | The same move between other heights.
atHeights :: (Mm, Mm) -> Move -> Move
atHeights zs m = m {manner = (manner m) {between = zs}}

-- | The same move without slowing down.
unbraked :: Move -> Move
unbraked m = m {manner = (manner m) {slowing = False}}

-- | The moves of a block in order.
moves :: Block -> [Move]
moves block = case block of
  Travelling _ ms -> ms
  Cutting {approach, cut, retract} -> approach <> NonEmpty.toList cut <> retract
  Clearing {approach, cleared, retract} -> approach <> NonEmpty.toList cleared <> retract
  Holing _ ms -> ms
  Commanding _ -> []

-- | How many passes along contours and in pockets stand before each block.
passNumbers :: [Block] -> [Int]
passNumbers = go 0
  where
    -- A block is not held until the one behind it is asked for.
    go :: Int -> [Block] -> [Int]
    go n bs = case bs of
      [] -> [n]
      b : more -> let !next = if isPass b then n + 1 else n in n : go next more
    isPass b = case b of
      Cutting {} -> True
      Clearing {} -> True
      Travelling _ _ -> False
      Holing _ _ -> False
      Commanding _ -> False

-- | Moves in order, those together that go along one curve: each but the first continues the one
-- before.
runs :: [Move] -> [NonEmpty Move]
runs ms = case ms of
  [] -> []
  -- Most moves are alone.
  m : rest@(following : _) | not (continues following) -> (m :| []) : runs rest
  m : rest -> let (along, others) = span continues rest in (m :| along) : runs others

-- | Whether a run goes along a curve that is replaced by arcs, rather than along one line or arc.
isCurve :: NonEmpty Move -> Bool
isCurve run = case run of
  m :| [] -> continues m
  _ -> True

-- | Whether the cutter stays at the height at which it starts.
isFlat :: Toolpath -> Bool
isFlat path = all (\m -> heights m == (z, z)) (concatMap moves (blocks path))
  where
    z = height' (start path)
    height' (Located _ (SpacePoint _ h)) = h

-- | Where the cutter stands at the end.
end :: Toolpath -> SpacePoint
end path =
  foldl
    (\_ m -> SpacePoint (Segment.end (segment m)) (snd (heights m)))
    (value (start path))
    (concatMap moves (blocks path))

-- | With no more of each way along a contour or in a pocket than its first and its last move: the
-- rest of a large path need not be held by those who do not ask for it. Such a cut keeps its
-- height; that of a blade stays whole.
withoutCuts :: Toolpath -> Toolpath
withoutCuts path = foldr seq () brief `seq` path {blocks = brief}
  where
    brief = map shortened (blocks path)
    shortened block = case block of
      Cutting {job = Located _ milling, cut}
        | isNothing (Part.gear milling) ->
          let !ends =
                endsOf cut
           in block {cut = ends}
      Cutting {} -> block
      Clearing {cleared} -> let !ends = endsOf cleared in block {cleared = ends}
      Travelling _ _ -> block
      Holing _ _ -> block
      Commanding _ -> block
    endsOf way = case way of
      _ :| [] -> way
      first :| _ -> let !final = NonEmpty.last way in first :| [final]
