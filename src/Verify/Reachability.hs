-- | The parts of a contour that a cutter can touch at all, for a program that lets stay what it
-- cannot.
--
-- A cutter that touches an element at a place has its centre square above it, at its radius. It can
-- stand there when no other element is nearer to that centre. This looks at one element and its
-- neighbourhood at a time, by distances; it knows nothing of how the path was found.
module Verify.Reachability
  ( parts,
    rim,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, times)
import Data.List (foldl', sort)
import Geometry.Carrier (Side (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec
import Offset.Tolerance qualified as Tolerance

-- | The parts of a segment that a cutter touches with its centre at a distance on a side, among all
-- segments of the contour by the distances that the centre keeps from them. Where more is kept from
-- another one than from this one, that counts square above it: beside its ends the way steps back.
parts :: Side -> Mm -> [(Mm, BoxTree Segment)] -> Segment -> [Segment]
parts side distance others segment = case beside side distance segment of
  Nothing -> []
  Just centres ->
    [piece segment a b | (a, b) <- foldl' (without centres) [(0, 1)] others, b - a > Tolerance.hair]
  where
    without centres free (kept, all') =
      let near = BoxTree.within (BoundingBox.inflate kept (BoundingBox.ofSegment centres)) all'
          open = common free (Distance.uncovered (less (min kept distance)) near centres)
       in case compare kept distance of
            GT -> concatMap (outside centres kept near) open
            EQ -> open
            LT ->
              concatMap
                ( onThisSide
                    centres
                    ( BoxTree.within
                        ( BoundingBox.union
                            (BoundingBox.ofSegment segment)
                            (BoundingBox.ofSegment centres)
                        )
                        all'
                    )
                )
                open
    -- Over an element from which less is kept a centre might be far enough from it on its other
    -- side.
    onThisSide centres near (a, b) =
      let marks =
            sort
              [ t
                | s <- near,
                  t <-
                    [ Segment.fraction segment p
                      | p <- [Segment.start s, Segment.end s] <> Distance.crossings segment s
                    ]
                      <> [Segment.fraction centres p | p <- Distance.crossings centres s],
                  t > a,
                  t < b
              ]
          isBehind t s =
            let foot =
                  Segment.at t segment
             in any
                  (\p -> Vec.distance foot p > Tolerance.clearance)
                  (Distance.crossings (Straight foot (Segment.at t centres)) s)
       in [ (from, to)
            | (from, to) <- zip (a : marks) (marks <> [b]),
              not (any (isBehind ((from + to) / 2)) near)
          ]
    common xs ys = [(max a c, min b d) | (a, b) <- xs, (c, d) <- ys, max a c < min b d]
    -- Half of what the path takes for room in which the cutter just fits.
    less d = minus d (times 0.5 Tolerance.clearance)
    outside centres kept near (a, b) =
      let borders =
            [ c
              | s <- near,
                c <-
                  maybe
                    []
                    ( \c ->
                        [ c,
                          Straight (Segment.start s) (Segment.start c),
                          Straight (Segment.end s) (Segment.end c)
                        ]
                    )
                    (beside side kept s)
            ]
          marks =
            sort
              [ t
                | c <- borders,
                  p <- Distance.crossings centres c,
                  let t = Segment.fraction centres p,
                  t > a,
                  t < b
              ]
          isAbove p s = Segment.spans s p && Distance.toPoint p s < less kept
       in [ (from, to)
            | (from, to) <- zip (a : marks) (marks <> [b]),
              not (any (isAbove (Segment.at ((from + to) / 2) centres)) near)
          ]

-- | Where the centre can be at a distance to the left of closed walks, or to the right: beside
-- their segments and round their outer corners, with the place of the segment in all of them; none
-- of these is nearer.
rim :: Side -> Mm -> BoxTree Segment -> [[Segment]] -> [(Int, Segment)]
rim side distance all' walks =
  concatMap free (concat (zipWith around (scanl (+) 0 (map length walks)) walks))
  where
    around first walk =
      concat
        ( zipWith3
            ( \i s next ->
                [(i, c) | Just c <- [beside side distance s] <> [outerCorner side distance s next]]
            )
            [first ..]
            walk
            (drop 1 walk <> take 1 walk)
        )
    free (i, s) =
      [ (i, piece s a b)
        | (a, b) <-
            Distance.uncovered
              (minus distance Tolerance.clearance)
              (BoxTree.within (BoundingBox.inflate distance (BoundingBox.ofSegment s)) all')
              s,
          b - a > Tolerance.hair
      ]

-- | A part of a segment, between shares of its length.
piece :: Segment -> Double -> Double -> Segment
piece s a b
  | a <= 0 && b >= 1 = s
  | a <= 0 = fst (Segment.cutAt b s)
  | b >= 1 = snd (Segment.cutAt a s)
  | otherwise = snd (Segment.cutAt (a / b) (fst (Segment.cutAt b s)))

-- | A corner that turns by less than this, in radians, has no way round it worth a look.
turnsAtAll :: Double
turnsAtAll = 1e-9

-- | Where the centre is while the cutter rolls round the corner behind a segment, if that turns
-- away from it.
outerCorner :: Side -> Mm -> Segment -> Segment -> Maybe Segment
outerCorner side (Mm d) s next
  | leftward * t < negate turnsAtAll =
    Just
      Arc
        { start = off (Segment.endDirection s),
          end = off (Segment.startDirection next),
          centre,
          sweep = turned
        }
  | otherwise = Nothing
  where
    turned@(Rad t) = Vec.turn (Segment.endDirection s) (Segment.startDirection next)
    centre = Segment.end s
    off direction = Vec.shift (Vec.scale (leftward * d) (Vec.left (Vec.unit direction))) centre
    leftward = case side of
      LeftOf -> 1
      RightOf -> -1

-- | Where the centre is while the cutter rolls along a segment alone, if it can.
beside :: Side -> Mm -> Segment -> Maybe Segment
beside side (Mm d) segment = case segment of
  Straight a b
    | a == b -> Nothing
    | otherwise ->
      let n =
            Vec.scale (leftward * d) (Vec.left (Vec.unit (Vec.to a b)))
       in Just (Straight (Vec.shift n a) (Vec.shift n b))
  Arc {start, end, centre, sweep = sweep@(Rad s)}
    | r <= 0 || grown <= 0 -> Nothing
    | otherwise -> Just Arc {start = moved start, end = moved end, centre, sweep}
    where
      Mm r = Segment.radius centre start
      -- The centre of an arc lies on the left when it is walked counter-clockwise.
      grown = if signum s == leftward then r - d else r + d
      moved p = Vec.shift (Vec.scale (grown / r) (Vec.to centre p)) centre
  where
    leftward = case side of
      LeftOf -> 1
      RightOf -> -1
