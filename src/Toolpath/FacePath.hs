-- | The toolpath that faces a region: parallel lines over it.
--
-- The lines are at most the stepover apart, and the strips that the cutter clears along them cover
-- the region. The cutter runs along a line wherever its strip contains a point
-- of the region, and on by 'overrun' at both ends. So it clears every point of the region there,
-- and goes down, and comes up, beside it. Where the strip leaves the region for longer, the line
-- has a gap, over which the cutter is lifted.
--
-- Without a milling direction the lines are cut forwards and backwards in turn. With one they are
-- all cut in the same direction, and between them the cutter is lifted.
module Toolpath.FacePath
  ( sections,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, over, plus, times)
import Base.Region (Located (..))
import Data.List (sort, sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox (BoundingBox))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Part.Part (Facing (..), Milling (contour, radius, sense, spindleSense), Pocketing (..))
import Part.Part qualified as Part
import Toolpath.Pocket (PocketMove (..))

-- | The sections that face a region, with the linking moves between them. @from@ is the cutter's
-- plunge position; Nothing if the cutter plunges at the beginning of the first line.
sections :: Pocketing -> Facing -> Maybe Point -> [PocketMove]
sections pocket Facing {passDirection} from = linked from (map turnedBack lines')
  where
    Rad angle = Vec.signedAngle (Vec.vec 1 0) passDirection
    turned = Transformation.segment (Transformation.rotation (Rad (-angle)) origin)
    turnedBack = Transformation.segment (Transformation.rotation (Rad angle) origin)
    origin = Vec.point 0 0
    r = radius (wall pocket)
    outlines =
      map
        turned
        (concatMap (NonEmpty.toList . Polyarc.segments . Part.polyarcOf) contours)
    contours = contour (wall pocket) : islands pocket
    lines' = concat (zipWith inOrder (directions (wall pocket)) cutsOnLines)
    cutsOnLines = cutsOn r (stepover pocket) outlines
    linked at cuts = case cuts of
      [] -> []
      s : more ->
        maybe [] (\p -> link p (Segment.start s)) at
          <> (AlongLoop (Mm 0) (s :| []) : linked (Just (Segment.end s)) more)
    link p q
      | Vec.isNear p q = []
      | Nothing <- sense (wall pocket), Vec.distance p q <= times 4 r = [DirectLink (Straight p q)]
      | otherwise = [LiftedLink p q]

-- | True for each line that is cut in the direction of the passes. With a clockwise spindle, climb
-- milling has the material that is still to be cut on the right: on the left of the first line lie
-- the others.
directions :: Milling -> [Bool]
directions milling = case sense milling of
  Nothing -> cycle [True, False]
  Just (Located _ asked) ->
    repeat ((asked == Part.Climb) /= (spindleSense milling == Part.Clockwise))

-- | The cuts of a line in their order.
inOrder :: Bool -> [Segment] -> [Segment]
inOrder isForward cuts
  | isForward = cuts
  | otherwise = reverse (map Segment.reverse cuts)

-- | The cuts on each line, from the lowest line to the highest, all in the direction of x. The
-- region is bounded by @outlines@, @r@ is the cutter's radius, and @step@ the stepover.
cutsOn :: Mm -> Mm -> [Segment] -> [[Segment]]
cutsOn r step outlines =
  [ [Straight (Vec.point a y) (Vec.point b y) | (a, b) <- extentsNear r (overrun r) border box y]
    | Mm y <- heights
  ]
  where
    border = BoxTree.index BoundingBox.ofSegment outlines
    box@(BoundingBox _ bottom _ top) = foldr1 BoundingBox.union (map BoundingBox.around outlines)
    high = Mm (top - bottom)
    count = 1 + max 0 (ceiling (over (minus high (times 2 r)) step - Tolerance.equal)) :: Int
    -- The strips reach beyond the region on both sides, as far as the stepover allows.
    beyond = min (times 0.1 r) (times 0.5 (minus (plus (spread step) (times 2 r)) high))
    spread = times (fromIntegral (count - 1))
    heights
      | count == 1 = [Mm ((bottom + top) / 2)]
      | otherwise =
        [ plus
            (plus (minus (Mm bottom) beyond) r)
            ( times
                (fromIntegral k / fromIntegral (count - 1))
                (minus (plus high (times 2 beyond)) (times 2 r))
            )
          | k <- [0 .. count - 1]
        ]

-- | The length by which the cutter runs on beyond the region: until it has left it.
overrun :: Mm -> Mm
overrun = times 1.1

-- | The intervals of x in which the strip of the half width @r@ about the height @y@ contains
-- points of a region, each longer at both ends by @longer@. The x of a connected part of the strip
-- are those of its border, which consists of parts of the region's border and of the strip's edges.
extentsNear :: Mm -> Mm -> BoxTree Segment -> BoundingBox -> Double -> [(Double, Double)]
extentsNear (Mm r) (Mm longer) border (BoundingBox left _ right _) y =
  joined
    ( sort
        [ (a - longer, b + longer)
          | (a, b) <- concatMap alongBorder near <> concatMap alongEdge [y - r, y + r]
        ]
    )
  where
    near = BoxTree.within (BoundingBox left (y - r) right (y + r)) border
    edge z = Straight (Vec.point (left - 1) z) (Vec.point (right + 1) z)
    alongBorder s =
      [ (a, b)
        | part <- partsBetween (map edge [y - r, y + r]) s,
          abs (Vec.y (Segment.at 0.5 part) - y) <= r,
          let BoundingBox a _ b _ = BoundingBox.around part
      ]
    alongEdge z =
      let crossing = BoxTree.within (BoundingBox left z right z) border
          xs = sort (map Vec.x (concatMap (Distance.intersections (edge z)) crossing))
       in [ (a, b)
            | (a, b) <- zip xs (drop 1 xs),
              a < b,
              WindingNumber.about (Vec.point ((a + b) / 2) z) (BoxTree.toList border) /= 0
          ]

-- | The parts of a segment between its intersections with lines.
partsBetween :: [Segment] -> Segment -> [Segment]
partsBetween edges s = zipWith (\a b -> Segment.between a b s) marks (drop 1 marks)
  where
    marks =
      sortOn id ([0, 1] <> [t | e <- edges, p <- Distance.intersections s e, let t = share p])
    share p = max 0 (min 1 (Segment.fraction s p))

-- | Intervals in order, with those joined that meet.
joined :: [(Double, Double)] -> [(Double, Double)]
joined intervals = case intervals of
  (a, b) : (c, d) : more
    | c <= b -> joined ((a, max b d) : more)
    | otherwise -> (a, b) : joined ((c, d) : more)
  _ -> intervals
