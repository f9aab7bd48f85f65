-- | How a pocket came out, by distances alone: no stroke cuts into its walls, and nothing that the
-- cutter can reach stays in it.
--
-- Let A be all places of the cutter's centre that are no nearer to the walls than its radius and
-- what is left. What the cutter can reach lies within its radius of A. Two things are shown of each
-- depth:
--
-- * rim: every place of the edge of A has a stroke right there. Then the walls are cut wherever a
--   cutter touches them; and a place
--   that the cutter reaches and that lies outside A is within the radius of such an edge, so it is
--   cleared, corners included;
-- * floor: every place of A lies within the radius of a stroke. Squares about the pocket are
--   divided until each lies
--   within the radius of one stroke, or of two that it lies between, or outside A.
module Verify.Pocket
  ( Pocket (..),
    ClearingPass (..),
    pocketsOf,
    holds,
    isInOrder,
    examine,
  )
where

import Base.Quantity (Mm (..), plus, times)
import Base.Region (Located (..), Region)
import Data.Either (fromRight)
import Data.Function (on)
import Data.List (foldl', maximumBy, minimumBy, sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, listToMaybe, mapMaybe, maybeToList)
import Data.Ord (comparing)
import Data.Vector qualified as Vector
import Geometry.Carrier (Side (..))
import Geometry.Distance qualified as Distance
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox (BoundingBox (BoundingBox))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Offset.Tolerance qualified as Tolerance
import Part.Part (Element, Milling, Pocketing)
import Part.Part qualified as Part
import Toolpath.FromPart qualified as Toolpath (leadingSide)
import Toolpath.Toolpath (Block)
import Toolpath.Toolpath qualified as Toolpath
import Verify.Coverage qualified as Coverage
import Verify.Deviation (Spared (..))
import Verify.Deviation qualified as Deviation
import Verify.Motion (CutterMotion (number), box, courses, heights, line)
import Verify.Motion qualified as Motion
import Verify.PassSearch (Edge (Edge, element))
import Verify.PassSearch qualified as PassSearch
import Verify.Proof (ContourProof (..), Finding (..), Witness (Witness, amount, frame, place))
import Verify.Proof qualified
import Verify.Reachability qualified as Reachability

-- | A pocket, and its passes in the order of the tape.
data Pocket = Pocket
  { statement :: Region,
    milling :: Milling,
    -- | the side of the walk on which the free space lies
    side :: Side,
    walls :: BoxTree Edge,
    about :: BoundingBox,
    -- | the edge of what the centre can reach in the last passes, with the elements beside it
    rim :: [(Element, Segment)],
    -- | the distance of the edge from the walls
    away :: Mm,
    passes :: NonEmpty ClearingPass
  }

-- | One pass: its number among all passes of the path, its height, the distance of the cutter's
-- centre from the walls; whether it is the last one at its height; the moves before and behind it.
data ClearingPass = ClearingPass
  { order :: Int,
    level :: Mm,
    reach :: Mm,
    isFinal :: Bool,
    aside :: [Segment]
  }

-- | The pockets of a path.
pocketsOf :: [Block] -> [Pocket]
pocketsOf blocks =
  map
    pocketOf
    ( NonEmpty.groupBy
        ((==) `on` (\(_, _, p, _) -> Toolpath.number p))
        [ (n, job, pass, map Toolpath.segment (approach <> retract))
          | ( n,
              Toolpath.Clearing
                { Toolpath.pocket = job,
                  Toolpath.pass,
                  Toolpath.approach,
                  Toolpath.retract
                }
              ) <-
              zip (Toolpath.passNumbers blocks) blocks
        ]
    )

pocketOf :: NonEmpty (Int, Located Pocketing, Toolpath.Pass, [Segment]) -> Pocket
pocketOf found@((_, Located statement job, _, _) :| _) =
  Pocket {statement, milling, side, walls, about, rim, away, passes}
  where
    milling = Part.wall job
    side = fromMaybe LeftOf (fromRight Nothing (Toolpath.leadingSide milling))
    contours = map (NonEmpty.toList . Part.elements) (Part.contour milling : Part.islands job)
    elements = Vector.fromList (concat contours)
    walls =
      BoxTree.index
        (BoundingBox.ofSegment . Part.segment . element)
        [ Edge
            { element = e,
              PassSearch.rank = i,
              PassSearch.before = 0,
              PassSearch.long = 0,
              PassSearch.left = Mm 0,
              PassSearch.continues = False,
              PassSearch.course = Part.segment e
            }
          | (i, e) <- Vector.toList (Vector.indexed elements)
        ]
    about =
      foldr1
        BoundingBox.union
        (fmap (BoundingBox.ofSegment . Part.segment) (Part.elements (Part.contour milling)))
    away = plus (plus (Part.radius milling) (NonEmpty.last (Part.allowances milling))) margin
    -- Where contours nearly touch, a place beside one of them may lie within the other.
    rim = [(elements Vector.! i, s) | (i, s) <- inRim, isInside side walls (Segment.at 0.5 s)]
    inRim =
      Reachability.rim
        side
        away
        (BoxTree.index BoundingBox.ofSegment (map Part.segment (Vector.toList elements)))
        (map (map Part.segment) contours)
    passes = fmap pass found
    pass (order, _, p, aside) =
      ClearingPass
        { order,
          level = Toolpath.atHeight p,
          reach = Toolpath.reach p,
          isFinal = Toolpath.left p == NonEmpty.last (Part.allowances milling),
          aside
        }

-- | Where the cutter has so little room, more than its own, it need not go: by rounding it may have
-- none.
margin :: Mm
margin = times 3 Tolerance.clearance

-- | Whether a point lies in a pocket.
holds :: Pocket -> Point -> Bool
holds pocket = isInside (side pocket) (walls pocket)

-- | Whether strokes cut the passes of a pocket depth by depth in their order.
isInOrder :: Machine -> Pocket -> [CutterMotion] -> Bool
isInOrder machine pocket whole =
  go (map NonEmpty.head (NonEmpty.group (map level (NonEmpty.toList (passes pocket))))) whole
  where
    go levels traces = case (levels, traces) of
      ([], _) -> True
      (_, []) -> False
      (z : more, t : rest)
        | cuts z t || goesDownTo z t && not (any (cuts z) whole) -> go more rest
        | otherwise -> go levels rest
    cuts z t = isLevel t && isThere z t
    isThere z t =
      Deviation.atLevel machine z (snd (heights t)) && holds pocket (Segment.at 0.5 (line t))
    isLevel t = uncurry (==) (heights t) && not (Motion.isUpright t)
    -- Where there is room for less than a pulse that is all.
    goesDownTo z t = Motion.isUpright t && uncurry (>) (heights t) && isThere z t

-- | How one pass came out: whether it is the first one of its pocket; all strokes, those that may
-- touch what lies in a box, and those of the pass.
examine ::
  Machine ->
  Bool ->
  (CutterMotion -> Mm) ->
  [CutterMotion] ->
  (BoundingBox -> [CutterMotion]) ->
  (CutterMotion -> Bool) ->
  Pocket ->
  Bool ->
  ClearingPass ->
  (ContourProof, [Finding])
examine machine flat toolOf traces nearby isOwn pocket isFirst pass = (passage, findings)
  where
    pulse = Machine.pulse machine
    (inside, outside) =
      Deviation.allowedOff
        (any Part.continues (Part.elements (Part.contour (milling pocket))))
        (milling pocket)
    mayGouge = plus inside pulse
    mayLeave = plus (plus (max inside outside) pulse) margin
    -- Where a stroke begins in the pocket, none is nearer to a place of it than those as far around
    -- it as it is wide.
    atHeight =
      let near =
            filter isThere (nearby (BoundingBox.inflate (across (about pocket)) (about pocket)))
       in if any (isWithin (about pocket) . Segment.start . line) near
            then near
            else filter isThere traces
    isThere t =
      (flat || Deviation.isAt machine (level pass) t) && toolOf t >= Part.radius (milling pocket)
    across (BoundingBox left bottom right top) =
      Mm (Vec.norm (Vec.vec (right - left) (top - bottom)))
    isWithin around p = BoundingBox.meets around (BoundingBox.ofPoints p [])
    strokes = BoxTree.index box atHeight
    looked =
      filter
        (\t -> belowTop t && (isFirst || isOwn t))
        (nearby (BoundingBox.inflate (reach pass) (about pocket)))
    belowTop t = fst (heights t) <= Mm 0 || snd (heights t) <= Mm 0
    spared t =
      let d =
            if isOwn t then reach pass else toolOf t
       in Spared {upTo = d, most = d, required = \_ _ -> d}
    gouges = mapMaybe (\t -> Deviation.gougeOf (spared t) (walls pocket) t) looked
    deepest =
      foldl'
        ( \best t ->
            if Deviation.mayExceed
              (spared t)
              best
              t
              (courses t)
              (BoxTree.within (BoundingBox.inflate (upTo (spared t)) (box t)) (walls pocket))
              then maybe best (deeper best) (Deviation.gougeOf (spared t) (walls pocket) t)
              else best
        )
        Nothing
        looked
    deeper best w = case best of
      Just b | amount b >= amount w -> best
      _ -> Just w
    missed = if isFinal pass then unreached mayLeave strokes (rim pocket) else []
    worst = listToMaybe (sortOn (negated . amount) missed)
    negated (Mm x) = -x
    passage =
      ContourProof
        { contour = Part.contourName (Part.contour (milling pocket)),
          gouge = deepest,
          excess = worst,
          allowedGouge = mayGouge,
          allowedExcess = mayLeave
        }
    tooMuch = sortOn frame (filter ((> mayLeave) . amount) missed)
    findings =
      [ Gouge first most' mayGouge
        | Just most' <- [deepest],
          amount most' > mayGouge,
          first : _ <- [filter ((> mayGouge) . amount) gouges]
      ]
        <> [Excess first (fromMaybe first worst) mayLeave | first : _ <- [tooMuch]]
        <> [ NotCleared (statement pocket) (level pass) p
             | isFinal pass,
               null tooMuch,
               p <-
                 maybeToList
                   ( uncleared
                       pocket
                       (plus (Part.radius (milling pocket)) mayLeave)
                       (BoxTree.byPlace box atHeight)
                   )
           ]

-- | For each stretch of the rim how far its furthest place is from the strokes, as far as that is
-- more than of those before or more than is allowed.
unreached :: Mm -> BoxTree CutterMotion -> [(Element, Segment)] -> [Witness]
unreached allowance strokes = go (Mm 0)
  where
    go least stretches = case stretches of
      [] -> []
      (e, s) : rest
        | surely least s -> go least rest
        | otherwise -> case Coverage.furthest others Nothing least s of
          Nothing -> go least rest
          Just Coverage.Beyond {Coverage.most = most', Coverage.place = p, Coverage.around} ->
            let nearest = minimumBy (comparing (Coverage.distanceTo p . Motion.ways)) around
                next = if most' > allowance then least else most'
             in Witness
                  { amount = most',
                    frame = number nearest,
                    Verify.Proof.element = Part.origin e,
                    place = p
                  } :
                go next rest
    surely least@(Mm d) s =
      FastDistance.isCovered
        d
        courses
        (const True)
        (BoxTree.within (BoundingBox.inflate least (BoundingBox.ofSegment s)) strokes)
        s
    others =
      Coverage.Others
        { Coverage.index = strokes,
          Coverage.lines = Motion.ways,
          Coverage.counts = const True,
          Coverage.reach = Mm 0,
          Coverage.allowance = allowance
        }

-- The floor

-- | A place that the centre can reach and that lies within a distance of no stroke, to
-- 'floorResolution'.
uncleared :: Pocket -> Mm -> BoxTree CutterMotion -> Maybe Point
uncleared pocket (Mm r) strokes =
  listToMaybe
    ( look
        Nothing
        False
        ((left + right) / 2)
        ((bottom + top) / 2)
        (max (right - left) (top - bottom) / 2)
    )
  where
    BoundingBox left bottom right top = about pocket
    Mm d = away pocket
    -- A square about a place, half as wide; a stroke that may well cover it, and whether it is
    -- known to lie in the pocket.
    look :: Maybe [Segment] -> Bool -> Double -> Double -> Double -> [Point]
    look hint known x y half
      | corner < r, Just cs <- hint, rangeOf x y cs + corner <= r' = []
      | corner < r, Just cs <- stroke', rangeOf x y cs + corner <= r' || isBetween cs = []
      | otherwise = case nearestWall (walls pocket) p of
        Nothing -> [p]
        Just (Mm w, e)
          | w + corner < d -> []
          | w > corner && not known && not (free p e) -> []
          | corner <= finest -> [p | w >= d, known || w > corner || free p e]
          | otherwise ->
            let h =
                  half / 2
             in concat
                  [ look stroke' (known || w > corner) (x + a * h) (y + b * h) h
                    | (a, b) <- [(-1, -1), (1, -1), (1, 1), (-1, 1)]
                  ]
      where
        p = Vec.point x y
        free = isFree (side pocket) (walls pocket)
        corner = half * sqrt 2
        stroke' = if corner < r then nearestStroke x y else Nothing
        corners = [(x + a * half, y + b * half) | (a, b) <- [(-1, -1), (1, -1), (1, 1), (-1, 1)]]
        -- The distance from a straight stroke is convex, and so is its mean from two: it is largest
        -- at a corner. The nearer one is no further than that.
        isBetween cs =
          all FastDistance.isLine cs && case nearestStroke fx fy of
            Just ds ->
              all FastDistance.isLine ds
                && all (\(u, v) -> rangeOf u v cs + rangeOf u v ds <= 2 * r') corners
            Nothing -> False
          where
            (fx, fy) = maximumBy (comparing (\(u, v) -> rangeOf u v cs)) corners
    -- What is within the distance of a stroke is found to be at the finest squares, too.
    r' = r + finest
    Mm finest = floorResolution
    nearestStroke x y =
      courses . snd <$> BoxTree.closest (\t -> Mm (rangeOf x y (courses t))) (Vec.point x y) strokes
    rangeOf x y = foldl' (\m c -> max m (FastDistance.distance c x y)) 0

-- | Squares of the floor are divided until no place of them lies further from their middle. So much
-- further than it may a place lie from a stroke.
floorResolution :: Mm
floorResolution = Mm 0.02

-- | Whether a point lies between walls on whose side the free space lies.
isInside :: Side -> BoxTree Edge -> Point -> Bool
isInside side walls p = maybe False (isFree side walls p . snd) (nearestWall walls p)

-- | The wall nearest to a point, and how far it is.
nearestWall :: BoxTree Edge -> Point -> Maybe (Mm, Edge)
nearestWall walls p =
  BoxTree.closest
    (\e -> Mm (FastDistance.distance (PassSearch.course e) (Vec.x p) (Vec.y p)))
    p
    walls

-- | Whether a point lies on the free side of the wall nearest to it. Nearest to a corner, it is on
-- the same side of both walls there.
isFree :: Side -> BoxTree Edge -> Point -> Edge -> Bool
isFree side walls p e = (leftward > 0) == (side == LeftOf)
  where
    foot = snd (Distance.nearest p (Part.segment (element e)))
    touching =
      filter
        (\o -> Distance.toPoint foot (Part.segment (element o)) <= Tolerance.coincident)
        ( BoxTree.within
            (BoundingBox.inflate Tolerance.coincident (BoundingBox.ofPoints foot []))
            walls
        )
    leftward =
      sum
        [ Vec.cross (directionBeside foot (Part.segment (element o))) (Vec.to foot p)
          | o <- touching
        ]

-- | The direction of a segment at one of its points.
directionBeside :: Point -> Segment -> Vec.Vec
directionBeside p s
  | Vec.near p (Segment.start s) = Segment.startDirection s
  | Vec.near p (Segment.end s) = Segment.endDirection s
  | otherwise = Segment.directionAt (Segment.fraction s p) s
