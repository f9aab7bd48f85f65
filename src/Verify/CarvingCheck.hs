-- | V-carvings on the tape: the cone may not leave the area at the top of the part, and it has to
-- carve the edges of the area.
--
-- A motion cuts, at the top of the part, a disc about each position of its centre. The radius of
-- the disc grows evenly with the depth. So on a straight motion the least distance of the disc from
-- a point is at an end of the motion, or where the derivative of its distance vanishes. This has a
-- closed form. From a line or an arc it can also be least where the motion crosses it.
module Verify.CarvingCheck
  ( carvingFindings,
    overlap,
    mayOverlap,
  )
where

import Base.Quantity (Mm (..), Rad (..), plus)
import Base.Region (Located (..), Region)
import Data.IntMap.Strict qualified as IntMap
import Data.List (foldl')
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Semigroup (sconcat)
import Frame.Frame (FrameProgram)
import Frame.Frame qualified as Frame
import Geometry.ArcFitting.PolyarcFit qualified as PolyarcFit
import Geometry.Distance qualified as Distance
import Geometry.Distance.Fast qualified as Fast
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc (Polyarc)
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Transformation qualified as Transformation
import Geometry.TranslatedCopy qualified as TranslatedCopy
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Part.Part (Carving)
import Part.Part qualified as Part
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.Motion (CutterMotion (number, segment))
import Verify.Motion qualified as Motion
import Verify.Proof (Finding (CarvesBeyond, EdgeNotCarved))

-- | A V-carving that is compared with the tape.
data Carved = Carved
  { statement :: Region,
    carving :: Carving,
    setting :: Setting,
    -- | the areas by their bounding boxes, each with its segments, which have it on their left
    areas :: BoxTree (BoundingBox, BoxTree Segment),
    -- | all segments
    edges :: BoxTree Segment,
    -- | discs along the edges
    discs :: [EdgeDisc]
  }

-- | A point of an edge, and the centre and the radius in mm of the largest disc in the area, up to
-- the radius of the cone at the largest depth, that touches the edge there.
data EdgeDisc = EdgeDisc Point Point Double

-- | The segments of a connected area, which have it on their left, and discs along them.
data CheckedArea = CheckedArea (NonEmpty Segment) [EdgeDisc]

-- | Findings for the V-carvings of a program. @isAligned@ is true if each frame of the tape ends
-- where the planned frame of the same number does; the planned frames then say which motions carve.
-- Otherwise these are all motions below the top of the part, near the area, with the same tool.
-- @toolsIn@ are the indices of the tools that may be in the spindle.
carvingFindings ::
  Machine ->
  Toolpath ->
  FrameProgram ->
  Bool ->
  (CutterMotion -> [Int]) ->
  [CutterMotion] ->
  [Finding]
carvingFindings machine path program isAligned toolsIn motions =
  concat
    [ findingsOf (carvedOf machine region c areas) (filter isLow (ofBlock n tool c))
      | ((n, tool, region, c), areas) <- zip carvings checked
    ]
  where
    blocks = Toolpath.blocks path
    checked = checkedAreas machine [c | (_, _, _, c) <- carvings]
    carvings =
      [ (n, tool, region, c)
        | (n, tool, Toolpath.Carved (Located region c) _ _) <-
            zip3 [0 ..] (Toolpath.toolIndices blocks) blocks
      ]
    isLow m = uncurry min (Motion.heights m) < Mm 0
    ofBlock n tool c
      | isAligned = IntMap.findWithDefault [] n aligned
      | otherwise = [m | m <- motions, tool `elem` toolsIn m, isNear c m]
    roles = IntMap.fromList (zip [1 ..] (map Frame.role (Frame.plannedFrames program)))
    aligned =
      IntMap.fromListWith
        (<>)
        [ (n, [m])
          | m <- reverse motions,
            Just (Frame.Carving n) <- [IntMap.lookup (number m) roles]
        ]
    isNear c m = BoundingBox.meets (Motion.box m) (boxOf c)
    boxOf c =
      boxAround (sconcat (sconcat (fmap (fmap Polyarc.segments) (Part.carvingContours c))))

boxAround :: NonEmpty Segment -> BoundingBox
boxAround = foldr1 BoundingBox.union . fmap BoundingBox.ofSegment

-- | The share of the allowed deviation by which the compared contours may deviate from those of the
-- part. Contours of curves have very many arcs; fewer of them take their place.
contourShare :: Double
contourShare = 0.05

-- | The numbers on which the comparison with a V-carving depends, in mm.
data Setting = Setting
  { -- | the deviation by which the compared contours may deviate from those of the part
    contourDeviation :: Double,
    -- | the deviation that is allowed at the top of the part
    allowed :: Double,
    -- | the radius at the top of the part of a tip that is one pulse deep
    least :: Double,
    -- | the radius of the cone at the largest depth
    widest :: Double
  }
  deriving stock (Eq, Ord)

settingOf :: Machine -> Carving -> Setting
settingOf machine c =
  Setting
    { contourDeviation = contourShare * most,
      allowed = (1 - contourShare) * most + pulse + pulseZ * slope c,
      least = tip + pulseZ * slope c,
      widest
    }
  where
    Mm most = uncurry max (Part.deviationLimits (Part.carvingTolerance c))
    Mm pulse = Machine.planeResolution machine
    Mm pulseZ = Machine.resolutionOf machine Machine.Z
    Mm tip = Part.carvingTip c
    Mm widest = Part.carvingReach c

-- | The areas of each of some V-carvings. Those that are translated copies are computed once.
checkedAreas :: Machine -> [Carving] -> [NonEmpty CheckedArea]
checkedAreas machine carvings =
  TranslatedCopy.shared
    checkedArea
    moved
    [(settingOf machine c,) <$> Part.carvingContours c | c <- carvings]

-- | The area with some contours.
checkedArea :: Setting -> NonEmpty Polyarc -> CheckedArea
checkedArea setting contours = CheckedArea segments (discsOf setting segments)
  where
    segments = sconcat (fmap (Polyarc.segments . simpler) contours)
    simpler = PolyarcFit.simplified (Mm (contourDeviation setting))

-- | An area moved by a vector.
moved :: Vec -> CheckedArea -> CheckedArea
moved v (CheckedArea segments discs) =
  CheckedArea
    (fmap (Transformation.segment (Transformation.translation v)) segments)
    [EdgeDisc (Vec.shift v p) (Vec.shift v c) r | EdgeDisc p c r <- discs]

carvedOf :: Machine -> Region -> Carving -> NonEmpty CheckedArea -> Carved
carvedOf machine statement carving found =
  Carved
    { statement,
      carving,
      setting = settingOf machine carving,
      areas = BoxTree.index fst [(boxAround ss, treeOf ss) | ss <- NonEmpty.toList segments],
      edges = treeOf (sconcat segments),
      discs = concat [ds | CheckedArea _ ds <- NonEmpty.toList found]
    }
  where
    segments = fmap (\(CheckedArea ss _) -> ss) found

treeOf :: NonEmpty Segment -> BoxTree Segment
treeOf = BoxTree.index BoundingBox.ofSegment . NonEmpty.toList

-- | The radius by which the cone grows for each mm of height.
slope :: Carving -> Double
slope c = let Rad half = Part.halfAngle c in tan half

-- | The radius in mm of the disc that a tip at some height cuts at the top of the part; negative if
-- it does not reach down to there.
radiusAt :: Carving -> Mm -> Double
radiusAt c (Mm z)
  | z > 0 = -(z * slope c)
  | otherwise = let Mm tip = Part.carvingTip c in tip - z * slope c

findingsOf :: Carved -> [CutterMotion] -> [Finding]
findingsOf carved ms =
  take
    1
    [ CarvesBeyond (number m) p (Mm far) (statement carved)
      | (before, m) <- zip (Nothing : map Just ms) ms,
        Just (p, far) <- [beyond carved before m]
    ]
    <> take 1 [EdgeNotCarved (statement carved) p | p <- uncarved carved ms]

-- The cone ----------------------------------------------------------------------------------------

-- | A point beyond the edges of the area to which the cone of a motion cuts, and the distance from
-- there to the edge, if it is more than is allowed. @before@ is the motion before it.
--
-- A disc that is larger than is allowed cannot get to the other side of an edge without going
-- beyond the edge on its way. So the side is looked for only where discs become so large, and where
-- a motion does not go on from the one before it.
beyond :: Carved -> Maybe CutterMotion -> CutterMotion -> Maybe (Point, Double)
beyond carved before m
  | far > allowed (setting carved) = Just (p, far)
  | otherwise = case filter isOutside unknown of
    (q, r) : _ -> Just (q, r)
    [] -> Nothing
  where
    c = carving carved
    (begin, stop) = endDiscs c m
    (r0, r1) = (snd begin, snd stop)
    paths = Motion.pathList m
    isLarge (_, r) = r > allowed (setting carved)
    unknown
      | isLarge begin = [begin | fmap (snd . endDiscs c) before /= Just begin]
      | otherwise = filter isLarge [stop]
    isOutside (q, _) =
      all
        (\(_, area) -> WindingNumber.about q (BoxTree.toList area) /= 1)
        (BoxTree.within (BoundingBox.ofPoints q []) (areas carved))
    near path =
      BoxTree.within (BoundingBox.inflate widest (BoundingBox.ofSegment path)) (edges carved)
    widest = Mm (max 0 (max r0 r1))
    (far, p) =
      foldl'
        (\a b -> if fst b > fst a then b else a)
        (0, Segment.start (segment m))
        [ overlap (path, r0, r1) e
          | path <- paths,
            e <- near path,
            mayOverlap (allowed (setting carved)) (path, r0, r1) e
        ]

-- | The centre and the radius of the disc at the beginning and at the end of a motion.
endDiscs :: Carving -> CutterMotion -> ((Point, Double), (Point, Double))
endDiscs c m =
  ((Segment.start (segment m), radiusAt c from), (Segment.end (segment m), radiusAt c to))
  where
    (from, to) = Motion.heights m

-- | False only if the discs along a path, as for 'overlap', go beyond an edge by at most @most@, in
-- mm. The result is exact for most edges that the discs touch.
--
-- The distance from a line changes evenly along a straight path. The distance from a circle around
-- the path is a concave function, so that the discs go furthest beyond it at an end. From any other
-- circle, a point is at least as far as it lies beyond one of its tangents.
mayOverlap :: Double -> (Segment, Double, Double) -> Segment -> Bool
mayOverlap most (path, r0, r1) edge = case (path, edge) of
  (Arc {}, _) -> max r0 r1 - Fast.apart path edge > limit
  (Straight a b, Straight x y) ->
    let n = Vec.left (Vec.unit (Vec.to x y))
        (s0, s1) = (Vec.dot n (Vec.to x a), Vec.dot n (Vec.to x b))
     in beside (abs s0) (abs s1) || s0 * s1 < 0
  (Straight a b, Arc {start, centre = o})
    | d0 <= big && d1 <= big -> beside (big - d0) (big - d1)
    | otherwise -> beside s0 s1
    where
      Mm big = Segment.radius o start
      (Mm d0, Mm d1) = (Vec.distance o a, Vec.distance o b)
      u = Vec.unit (Vec.to o (Vec.interpolate 0.5 a b))
      (s0, s1) = (Vec.dot u (Vec.to o a) - big, Vec.dot u (Vec.to o b) - big)
  where
    beside d0 d1 = not (r0 - d0 <= limit && r1 - d1 <= limit)
    Mm slack = Tolerance.coincident
    limit = most - slack

-- | The largest amount by which the discs along a path go beyond an edge, and the centre of the
-- disc that does. The radius changes evenly along the path.
overlap :: (Segment, Double, Double) -> Segment -> (Double, Point)
overlap (path, r0, r1) edge = case path of
  Straight a b ->
    maximum' (map (over a b) (0 : 1 : map crossing crossings <> concatMap (stationary a b) centres))
  Arc {} ->
    let closest = Distance.segments path edge
        Mm d = Distance.distance closest
     in (max r0 r1 - d, Distance.nearestPoint closest)
  where
    maximum' = foldr1 (\x y -> if fst x >= fst y then x else y)
    over a b t =
      let q = Vec.interpolate t a b
          Mm d = Distance.toPoint q edge
       in (r0 + t * (r1 - r0) - d, q)
    crossings = Distance.intersections path edge
    crossing p = min 1 (max 0 (Segment.fraction path p))
    centres = case edge of
      Straight x y -> [x, y]
      Arc {start = x, end = y, centre = o} -> [x, y, o]
    -- The distance of a point x from the line changes like the radius where the angle between the
    -- line and the direction to x has the cosine (r1 - r0) / length.
    stationary a b x
      | l <= 0 || abs k >= 1 = []
      | otherwise =
        [ t
          | side <- [-1, 1],
            let t = (along + side * abs across * k / sqrt (1 - k * k)) / l,
            t > 0,
            t < 1
        ]
      where
        Mm l = Vec.distance a b
        u = Vec.unit (Vec.to a b)
        k = (r1 - r0) / l
        along = Vec.dot u (Vec.to a x)
        across = Vec.cross u (Vec.to a x)

-- The edges ---------------------------------------------------------------------------------------

-- | The largest distance in mm between points of an edge at which the proof looks for the disc that
-- carves it.
sampleStep :: Mm
sampleStep = Mm 0.5

-- | Discs at points of the edges of an area, where the largest one is larger than the tip.
discsOf :: Setting -> NonEmpty Segment -> [EdgeDisc]
discsOf setting segments =
  [ EdgeDisc p centre r
    | s <- NonEmpty.toList segments,
      u <- sampled s,
      let p = Segment.at u s
          (centre, r) = largest setting area p (Vec.left (Segment.directionAt u s)),
      r > least setting
  ]
  where
    area = treeOf segments
    sampled s =
      let Mm long = Segment.length s
          Mm step = sampleStep
          count = ceiling (long / step) :: Int
       in [(fromIntegral k + 0.5) / fromIntegral count | k <- [0 .. count - 1]]

-- | Points of the edges at which the largest disc that the tool can cut there is not cut, nor a
-- larger one that reaches the point. A larger one is cut where an edge bends sharply: there the
-- largest disc depends on changes of the contour that are far below the tolerance.
uncarved :: Carved -> [CutterMotion] -> [Point]
uncarved carved ms =
  [ p
    | EdgeDisc p centre r <- discs carved,
      not (any (isCut centre r) (near (Mm slack) centre)),
      not (any (isReached p r) (near (plus (Part.carvingReach (carving carved)) (Mm slack)) p))
  ]
  where
    index = BoxTree.index Motion.box ms
    slack = 2 * allowed (setting carved)
    near far p = BoxTree.within (BoundingBox.inflate far (BoundingBox.ofPoints p [])) index
    isCut centre r m = any (isAlong centre r (radii m)) (Motion.pathList m)
    isAlong centre r (r0, r1) path =
      let t = Distance.nearestFraction centre path
          Mm d = Vec.distance centre (Segment.at t path)
       in d + abs (r0 + t * (r1 - r0) - r) <= slack
    isReached p r m = any (reaches p r (radii m)) (Motion.pathList m)
    reaches p r (r0, r1) path = case path of
      Straight _ _ ->
        let (beyondPoint, q) = overlap (path, r0, r1) (Straight p p)
            Mm d = Vec.distance q p
         in beyondPoint >= -slack && beyondPoint + d >= r + 0.5 * slack
      Arc {} ->
        let Mm d = Distance.toPoint p path
         in max r0 r1 - d >= -slack && max r0 r1 >= r + 0.5 * slack
    radii m =
      let (from, to) = Motion.heights m
       in (radiusAt (carving carved) from, radiusAt (carving carved) to)

-- | The largest disc in the area, up to the radius of the cone at the largest depth, that touches
-- the edge at the point @p@ with the unit normal @n@: its centre and its radius. A disc that is too
-- large is replaced by the one that touches the edge at its nearest point, until none is nearer
-- (Ma, Bae and Choi, "3D medial axis point approximation using nearest neighbors and the normal
-- field").
largest :: Setting -> BoxTree Segment -> Point -> Vec -> (Point, Double)
largest setting area p n = go (100 :: Int) (widest setting)
  where
    go steps r
      | steps == 0 || r <= 0 = (c, max 0 r)
      | otherwise = case nearestWithin c (r - within) of
        Nothing -> (c, r)
        Just q ->
          let d = Vec.to p q
              under = 2 * Vec.dot n d
           in if under <= 0 then (p, 0) else go (steps - 1) (min (r - within) (Vec.dot d d / under))
      where
        c = Vec.shift (Vec.scale r n) p
    within = 0.01 * allowed setting
    nearestWithin c r = case BoxTree.closest (Distance.toPoint c) c area of
      Just (Mm d, e) | d < r -> Just (snd (Distance.nearest c e))
      _ -> Nothing
