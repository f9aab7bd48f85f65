{-# LANGUAGE BangPatterns #-}

-- | The toolpath: the path of the cutter's centre, exact, in mm, with the requested feed of every
-- move.
module Toolpath.Toolpath
  ( Toolpath (..),
    Block (..),
    Pass (..),
    Sent (..),
    Move (..),
    Manner (..),
    heights,
    pace,
    isBraked,
    withoutBraking,
    atHeights,
    moves,
    passNumbers,
    curveRuns,
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

-- | The start of the cutter, and the blocks in order.
data Toolpath = Toolpath
  { start :: Located SpacePoint,
    blocks :: [Block],
    -- | the part turns in a lathe
    isTurned :: Bool
  }
  deriving stock (Eq, Show)

-- | The moves of one statement, or of one pass of it.
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
        -- | parts of the contour that the cutter does not reach; only in the first cut of the
        -- pass
        rests :: [Equidistant.UnreachedPart],
        -- | the input for a control that does the cutter compensation
        sent :: Maybe Sent
      }
  | -- | one pass of a pocket; its outer contour and islands are oriented in the cutter's
    -- direction of travel
    Clearing
      { pocket :: Located Pocketing,
        pass :: Pass,
        approach :: [Move],
        -- | along loops, and from each to the next
        cleared :: NonEmpty Move,
        retract :: [Move],
        -- | parts of the walls that remain unreached, by the elements of the outer contour and
        -- the islands in order
        rests :: [Equidistant.UnreachedPart]
      }
  | Holing (Located Drilling) [Move]
  | Commanding (Located Command)
  deriving stock (Eq, Show)

-- | One pass along a contour or in a pocket: the number of the milling statement in order of
-- execution, from 0; the distance of the cutter's centre from the contour; the allowance that
-- the pass leaves; the height.
data Pass = Pass {number :: Int, reach :: Mm, left :: Mm, atHeight :: Mm}
  deriving stock (Eq, Show)

-- | The input for a control that does the cutter compensation: the edge of the part. From it the
-- control computes the moves of the pass. Their ends agree with the toolpath except where
-- compensation begins.
data Sent = Sent
  { -- | moves of the cutter's centre until compensation begins
    before :: [Move],
    side :: Side,
    -- | straight, from the current centre to the beginning of the edge
    entry :: Move,
    -- | in the direction of travel: the lead-in, the elements of the contour, the lead-out. At
    -- outer corners the control moves on arcs
    edge :: NonEmpty Move,
    -- | straight, from the end of the edge to the centre's position after compensation ends
    exit :: Move,
    -- | moves of the centre after that
    behind :: [Move]
  }
  deriving stock (Eq, Show)

-- | One move, in the plane and in height, and the region of the program that asks for it. A
-- vertical move has a segment of length 0.
data Move = Move
  { segment :: Segment,
    manner :: Manner,
    origin :: Region,
    -- | it continues the curve of the move before, without a corner
    continues :: Bool
  }
  deriving stock (Eq, Show)

-- | Heights, pace and braking of a move. Most moves along a contour share one value.
data Manner = Manner
  { -- | the heights at the beginning and at the end of the move
    between :: (Mm, Mm),
    at :: Pace,
    -- | slow down at the end
    isBraking :: Bool
  }
  deriving stock (Eq, Show)

-- | The heights of a move at its beginning and at its end.
heights :: Move -> (Mm, Mm)
heights = between . manner

-- | The feed of a move, or rapid.
pace :: Move -> Pace
pace = at . manner

-- | True when a move slows down at its end.
isBraked :: Move -> Bool
isBraked = isBraking . manner

-- | Changes the heights of a move.
atHeights :: (Mm, Mm) -> Move -> Move
atHeights zs m = m {manner = (manner m) {between = zs}}

-- | Removes the braking of a move.
withoutBraking :: Move -> Move
withoutBraking m = m {manner = (manner m) {isBraking = False}}

-- | The moves of a block in order.
moves :: Block -> [Move]
moves block = case block of
  Travelling _ ms -> ms
  Cutting {approach, cut, retract} -> approach <> NonEmpty.toList cut <> retract
  Clearing {approach, cleared, retract} -> approach <> NonEmpty.toList cleared <> retract
  Holing _ ms -> ms
  Commanding _ -> []

-- | The count of passes, along contours and in pockets, before each block, and at last the total.
passNumbers :: [Block] -> [Int]
passNumbers = go 0
  where
    -- Lazy in the list: a block is not held in memory until the next one is demanded.
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

-- | Groups moves that follow one curve: every move of a group except the first continues the one
-- before.
curveRuns :: [Move] -> [NonEmpty Move]
curveRuns ms = case ms of
  [] -> []
  -- Most moves are a group of their own.
  m : rest@(following : _) | not (continues following) -> (m :| []) : curveRuns rest
  m : rest -> let (along, others) = span continues rest in (m :| along) : curveRuns others

-- | True when a group follows a curve that is approximated by arcs, and not a single line or arc.
isCurve :: NonEmpty Move -> Bool
isCurve run = case run of
  m :| [] -> continues m
  _ -> True

-- | True when the cutter keeps the height at which it starts.
isFlat :: Toolpath -> Bool
isFlat path = all (\m -> heights m == (z, z)) (concatMap moves (blocks path))
  where
    z = height' (start path)
    height' (Located _ (SpacePoint _ h)) = h

-- | The final position of the cutter.
end :: Toolpath -> SpacePoint
end path =
  foldl
    (\_ m -> SpacePoint (Segment.end (segment m)) (snd (heights m)))
    (value (start path))
    (concatMap moves (blocks path))

-- | Reduces each cut along a contour or in a pocket to its first and last move. A large toolpath
-- then needs little memory where the moves between are not needed. The height of such a cut is
-- constant; the cuts of a blade are kept whole, because theirs varies.
withoutCuts :: Toolpath -> Toolpath
withoutCuts path = foldr seq () abridged `seq` path {blocks = abridged}
  where
    abridged = map shortened (blocks path)
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
    endsOf cutMoves = case cutMoves of
      _ :| [] -> cutMoves
      first :| _ -> let !final = NonEmpty.last cutMoves in first :| [final]
