-- | The toolpath: the exact path of the cutter's centre in mm, before any rounding to pulses, with
-- the requested feed of every move.
module Toolpath.Toolpath
  ( Toolpath (..),
    Setup (..),
    noSetup,
    Block (..),
    CarvingRest (..),
    Pass (..),
    Sent (..),
    Move (..),
    Manner (..),
    heights,
    pace,
    isBraked,
    withPace,
    withoutBraking,
    atHeights,
    moves,
    passNumbers,
    withTools,
    toolIndices,
    openSideOf,
    curveRuns,
    isCurve,
    isFlat,
    isCompensated,
    end,
    withoutCuts,
  )
where

import Base.Name (Name)
import Base.Quantity (LengthUnit, Mm (..))
import Base.Region (Located (..), Region)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isNothing)
import Data.Text (Text)
import Geometry.Carrier (Side)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Offset.Equidistant qualified as Equidistant
import Part.Part
  ( Carving,
    Command,
    Cutter,
    Drilling,
    Milling,
    Pace,
    Pocketing,
    Solid,
    SpacePoint (..),
    Stop,
  )
import Part.Part qualified as Part
import Part.TurnedArea (OpenSide (..))

-- | The cutter's starting position, and the blocks in the order of execution.
data Toolpath = Toolpath
  { start :: Located SpacePoint,
    blocks :: [Block],
    -- | true if the part is turned on a lathe
    isTurned :: Bool,
    setup :: Setup,
    -- | the unit in which reports and tables give lengths
    unit :: LengthUnit
  }
  deriving stock (Eq, Show)

-- | The settings of the whole program for the control and the operator. Each is absent if the
-- program does not make it.
data Setup = Setup
  { -- | name and title of the part; the title may be empty
    partName :: Maybe Name,
    partTitle :: Text,
    -- | tool in the spindle at the start
    firstCutter :: Maybe Cutter,
    -- | number of this tool, from 1 to 99
    firstToolNumber :: Maybe (Located Int),
    -- | number of the work offset, from 54 to 59
    workOffset :: Maybe (Located Int),
    -- | number of the program, from 1 to 9999
    programNumber :: Maybe (Located Int),
    -- | height above all clamps, in mm, at least every clearance height
    safeHeight :: Maybe (Located Mm),
    -- | stock before the first operation, with the region of its statement
    stock :: Maybe (Located Solid),
    -- | solids that no tool may touch, each with the region of its statement
    avoided :: [Located Solid]
  }
  deriving stock (Eq, Show)

-- | The setup of a program without settings.
noSetup :: Setup
noSetup = Setup Nothing "" Nothing Nothing Nothing Nothing Nothing Nothing []

-- | The moves of one statement, or of one of its passes.
data Block
  = -- | radius of the tool, the points of a statement of moves, and the moves from point to point
    Travelling Mm [Stop] [Move]
  | -- | one pass along a contour. If the pass has several paths, because the cutter does not reach
    -- all of the contour, each path is a block
    Cutting
      { job :: Located Milling,
        pass :: Pass,
        approach :: [Move],
        -- | moves of a ramp, a helix or a spiral, and those that follow it to the beginning of the
        -- cut; empty if the cutter goes straight down
        descent :: [Move],
        -- | moves along the contour, raised over the tabs
        cut :: NonEmpty Move,
        -- | positions of the cutter's centre in the middles of the tabs over which it rises
        tabs :: [Point],
        retract :: [Move],
        -- | parts of the contour that the cutter does not reach; of several blocks of one pass,
        -- only the first one lists them
        rests :: [Equidistant.UnreachedPart],
        -- | input for a control that does the cutter compensation; Nothing if the program does not
        -- ask for such compensation
        sent :: Maybe Sent
      }
  | -- | one pass of a pocket; the contours of @pocket@ are oriented in the direction of travel
    Clearing
      { pocket :: Located Pocketing,
        pass :: Pass,
        approach :: [Move],
        -- | moves along loops and detours, and from each loop to the next
        cleared :: NonEmpty Move,
        retract :: [Move],
        -- | parts of the walls that the cutter does not reach; their element numbers count the
        -- elements of the outer contour, then those of the islands in order
        rests :: [Equidistant.UnreachedPart]
      }
  | -- | the holes of a drilling statement
    Holing (Located Drilling) [Move]
  | -- | the V-carving of a region, and what it leaves because its tip is too wide
    Carved (Located Carving) (NonEmpty Move) (Maybe CarvingRest)
  | -- | a command to the machine, such as a tool change
    Commanding (Located Command)
  deriving stock (Eq, Show)

-- | Material that the tip of a V-carving leaves in corners and narrow places.
data CarvingRest = CarvingRest
  { -- | the count of the places
    restCount :: Int,
    -- | the largest thickness
    thickest :: Mm,
    -- | the point of the largest thickness
    restAt :: Point
  }
  deriving stock (Eq, Show)

-- | One pass along a contour or in a pocket.
data Pass = Pass
  { -- | number of the milling or pocket statement in the order of execution, from 0
    number :: Int,
    -- | distance of the cutter's centre from the contour; in a pocket, distance of the outermost
    -- loop from the walls
    reach :: Mm,
    -- | allowance that the pass leaves on the contour
    left :: Mm,
    -- | height of the pass; the top of the part is 0
    atHeight :: Mm
  }
  deriving stock (Eq, Show)

-- | The input for a control that does the cutter compensation. The /edge/ is the contour of the
-- part, with the leads. From the edge the control computes the moves of the cutter's centre. Each
-- computed move ends where the corresponding move of the toolpath ends. The one exception is the
-- move on which compensation begins: its end depends on the kind of control.
data Sent = Sent
  { -- | moves of the cutter's centre until compensation begins
    before :: [Move],
    -- | side of the edge, in the direction of travel, on which the cutter moves
    side :: Side,
    -- | straight move on which compensation begins: from the end of @before@, a position of the
    -- centre, to the beginning of the edge
    entry :: Move,
    -- | moves along the edge in the direction of travel: the lead-in, the elements of the contour,
    -- the lead-out. The arcs round outer corners are missing, because the control inserts them
    edge :: NonEmpty Move,
    -- | straight move on which compensation ends: from the end of the edge to a position of the
    -- centre
    exit :: Move,
    -- | moves of the centre after the exit
    behind :: [Move]
  }
  deriving stock (Eq, Show)

-- | One move of the cutter's centre. A vertical move has a segment of length 0.
data Move = Move
  { -- | path in the plane
    segment :: Segment,
    manner :: Manner,
    -- | region of the program that asks for the move
    origin :: Region,
    -- | true if the move continues the curve of the previous move, without a corner
    continues :: Bool
  }
  deriving stock (Eq, Show)

-- | Heights, pace and braking of a move. Most moves along a contour share one 'Manner' in memory.
data Manner = Manner
  { -- | the heights at the beginning and at the end of the move
    between :: (Mm, Mm),
    at :: Pace,
    -- | true if the cutter slows down at the end of the move
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

-- | Replaces the heights of a move at its beginning and at its end.
atHeights :: (Mm, Mm) -> Move -> Move
atHeights zs m = m {manner = (manner m) {between = zs}}

-- | Replaces the speed of a move.
withPace :: Pace -> Move -> Move
withPace speed m = m {manner = (manner m) {at = speed}}

-- | Removes the braking of a move.
withoutBraking :: Move -> Move
withoutBraking m = m {manner = (manner m) {isBraking = False}}

-- | The moves of a block in order.
moves :: Block -> [Move]
moves block = case block of
  Travelling _ _ ms -> ms
  Cutting {approach, descent, cut, retract} ->
    approach <> descent <> NonEmpty.toList cut <> retract
  Clearing {approach, cleared, retract} -> approach <> NonEmpty.toList cleared <> retract
  Holing _ ms -> ms
  Carved _ ms _ -> NonEmpty.toList ms
  Commanding _ -> []

-- | The count of passes before each block; at the end of the list, the count of all passes. Each
-- 'Cutting' block and each 'Clearing' block counts as a pass.
passNumbers :: [Block] -> [Int]
passNumbers = go 0
  where
    -- The block @b@ is examined before its count @n@ is returned. So the rest of the list, while it
    -- is not yet computed, has no reference to @b@, and @b@ can be freed.
    go :: Int -> [Block] -> [Int]
    go n bs = case bs of
      [] -> [n]
      b : more
        | isPass b -> n : go (n + 1) more
        | otherwise -> n : go n more
    isPass b = case b of
      Cutting {} -> True
      Clearing {} -> True
      Travelling {} -> False
      Holing _ _ -> False
      Carved {} -> False
      Commanding _ -> False

-- | The blocks of a toolpath, each with the tool in the spindle. The tool is Nothing before the
-- first tool change of a program without a first tool.
withTools :: Setup -> [Block] -> [(Maybe Cutter, Block)]
withTools setup' = go (firstCutter setup')
  where
    go cutter bs = case bs of
      [] -> []
      b@(Commanding (Located _ (Part.ChangeTool _ c))) : more -> (cutter, b) : go (Just c) more
      b : more -> (cutter, b) : go cutter more

-- | The count of tool changes before each block.
toolIndices :: [Block] -> [Int]
toolIndices = scanl (\n b -> if isToolChange b then n + 1 else n) 0

-- | True for a block that changes the tool.
isToolChange :: Block -> Bool
isToolChange b = case b of
  Commanding (Located _ (Part.ChangeTool _ _)) -> True
  _ -> False

-- | The side from which a turning tool comes, by the count of tool changes before it: from below
-- the profile if it bores in all statements that use it, from above if it never bores. Nothing for
-- a milled part and for a tool that does both.
openSideOf :: Toolpath -> Int -> Maybe OpenSide
openSideOf path
  | isTurned path = (`lookup` sides)
  | otherwise = const Nothing
  where
    sides = [(k, side) | (k, Just side) <- zip [0 ..] (map sideOf (usesOf (blocks path)))]
    -- For each tool, the statements that turn with it: true for a bore.
    usesOf bs = case break isToolChange bs of
      (front, []) -> [bores front]
      (front, _ : more) -> bores front : usesOf more
    bores bs = [value (Part.side (value job)) == Part.Inside | Cutting {job} <- bs]
    sideOf used
      | and used && not (null used) = Just (Below (Mm (-1)))
      | or used = Nothing
      | otherwise = Just (Above beyond)
    beyond =
      maximum
        (Mm 1 : [Mm (y + 1) | Just (Located _ s) <- [stock (setup path)], y <- topsOf s])
    topsOf s =
      [ BoundingBox.top (BoundingBox.ofSegment (Part.segment e))
        | c <- Part.outlines s,
          e <- NonEmpty.toList (Part.elements c)
      ]

-- | Groups consecutive moves along one curve of the contour. In each group, all moves except the
-- first continue the previous move. A move along a single line or arc is a group of its own.
curveRuns :: [Move] -> [NonEmpty Move]
curveRuns ms = case ms of
  [] -> []
  -- Most moves are a group of their own.
  m : rest@(following : _) | not (continues following) -> (m :| []) : curveRuns rest
  m : rest -> let (along, others) = span continues rest in (m :| along) : curveRuns others

-- | True when a group of 'curveRuns' follows a curve that is approximated by arcs, and not a single
-- line or arc.
isCurve :: NonEmpty Move -> Bool
isCurve run = case run of
  m :| [] -> continues m
  _ -> True

-- | True when all moves of the toolpath are at the height of its start.
isFlat :: Toolpath -> Bool
isFlat path = all (\m -> heights m == (z, z)) (concatMap moves (blocks path))
  where
    z = height' (start path)
    height' (Located _ (SpacePoint _ h)) = h

-- | True when a control does the cutter compensation in a pass of the toolpath.
isCompensated :: Toolpath -> Bool
isCompensated path = or [True | Cutting {sent = Just _} <- blocks path]

-- | The final position of the cutter; the start if there are no moves.
end :: Toolpath -> SpacePoint
end path =
  foldl
    (\_ m -> SpacePoint (Segment.end (segment m)) (snd (heights m)))
    (value (start path))
    (concatMap moves (blocks path))

-- | Reduces the cut of each pass to its first and last move, so that a large toolpath needs little
-- memory. The ramps and helices of a pocket stay. The cuts of a blade, and those over tabs, stay
-- whole, because their heights vary between the ends.
withoutCuts :: Toolpath -> Toolpath
withoutCuts path = foldr seq () abridged `seq` path {blocks = abridged}
  where
    abridged = map shortened (blocks path)
    shortened block = case block of
      Cutting {job = Located _ milling, tabs, cut}
        | isNothing (Part.gear milling) && null tabs -> block {cut = endsOf cut}
      Cutting {} -> block
      Clearing {cleared} -> block {cleared = endsAndSlopes cleared}
      Travelling {} -> block
      Holing _ _ -> block
      -- The proof asks for each of its moves.
      Carved {} -> block
      Commanding _ -> block
    endsAndSlopes ms = case ms of
      first :| more
        | any isSlope ms -> first :| (filter isSlope more <> [NonEmpty.last ms | not (null more)])
      _ -> endsOf ms
    isSlope m = uncurry (/=) (heights m) && Segment.length (segment m) > Mm 0
    endsOf cutMoves = case cutMoves of
      _ :| [] -> cutMoves
      -- The last move is computed here, so that the result has no reference to the others.
      first :| _ -> let final = NonEmpty.last cutMoves in final `seq` (first :| [final])
