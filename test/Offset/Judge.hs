-- | The laws of the offset kernel as functions of one problem. Most compare the kernel's result
-- with the distances and winding numbers of "Offset.Naive" at many points.
module Offset.Judge
  ( Verdict (..),
    reach,
    sameness,
    composition,
    identity,
    uncrossed,
    zero,
  )
where

import Base.Quantity (Mm (..))
import Control.Applicative ((<|>))
import Data.Bits (shiftR, xor)
import Data.List (foldl', sort, tails)
import Data.Maybe (listToMaybe, mapMaybe)
import Data.Word (Word64)
import Generate.Outline (Case (..), Family (..), turned)
import Geometry.Carrier (Side (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Distance qualified as Distance
import Geometry.FlatPolyarc (FlatPolyarc)
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Offset.Kernel (OffsetFault (..))
import Offset.Kernel qualified as Kernel
import Offset.Loop qualified as Loop
import Offset.Naive (Piece (..))
import Offset.Naive qualified as Naive

-- | The verdict of a law on one problem.
data Verdict
  = -- | the law holds
    Holds
  | -- | the kernel refused the problem, and nothing was compared
    Refused
  | -- | the law is broken; a description
    Broken String
  deriving stock (Eq, Show)

-- | 'Holds' without descriptions of broken laws, else the first of them.
verdictOf :: [String] -> Verdict
verdictOf = maybe Holds Broken . listToMaybe

-- | The kernel's result for a problem.
result :: Case -> Either OffsetFault Kernel.ReachableRegion
result c =
  Kernel.offset (Kernel.roundOffset (side c) (Mm (radius c))) {Kernel.extra = more} (outlines c)
  where
    more = case extras c of
      [] -> Nothing
      es -> Just (\i -> Mm (es !! (i `mod` length es)))

-- | The size of a problem in mm, to which the allowed errors are proportional: the sum of the
-- largest coordinate and the distances.
scaleOf :: Case -> Double
scaleOf c =
  radius c
    + maximum (0 : extras c)
    + maximum (1e-3 : [max (abs x) (abs y) | o <- outlines c, (x, y, _) <- FlatPolyarc.vertices o])

-- | The boundary of the result has the required distance from the source. A point lies inside the
-- result exactly if it lies in the free region of the source and is far enough from the source. A
-- source that does not intersect itself is not refused.
reach :: Case -> Verdict
reach c = case result c of
  _ | illConditioned c && not (null (extras c)) -> Holds
  Left Uncertain -> Broken "uncertain"
  Left fault
    | sound c -> Broken ("fault of a sound source: " <> show fault)
    | areApart c -> Broken ("fault of a source whose segments are apart: " <> show fault)
    | SelfIntersecting i j <- fault, not (meeting i j) -> Broken ("no crossing: " <> show fault)
    | otherwise -> Refused
  Right region -> maybe Holds Broken (brokenAt c region)
  where
    segments = concatMap (FlatPolyarc.segments . straightened) (outlines c)
    meeting i j =
      let Mm d =
            Distance.distance (Distance.segments (segments !! i) (segments !! j))
       in d < 1e-5 * scaleOf c

-- | The result for a rotated, mirrored or moved problem, for other first vertices and for reversed
-- polyarcs is the corresponding one.
sameness :: Case -> Verdict
sameness c = case result c of
  Left _ -> Refused
  Right region ->
    verdictOf
      ( concat
          ( (if illConditioned c then [] else exactly region)
              <> [ same "start" (started 1),
                   same "start" (started 3),
                   same "reversed" (map FlatPolyarc.reverse (outlines c)),
                   same "moved" (map (turned 1 1.234 (3, -7)) (outlines c))
                 ]
          )
      )
    where
      started k = map (fromVertex k) (outlines c)
      total = Loop.area (Kernel.loops region)
      size = scaleOf c
      same name os
        | name == ("start" :: String) && any ((== Open) . FlatPolyarc.ends) (outlines c) = []
        | not (null (extras c)) || illConditioned c = []
        | otherwise =
          case result
            c
              { outlines = os,
                side = if name == "reversed" then Carrier.oppositeSide (side c) else side c
              } of
            Left fault -> [name <> ": " <> show fault]
            Right r
              | abs (abs (Loop.area (Kernel.loops r)) - abs total) <= 1e-8 * size * perimeter -> []
              | otherwise ->
                [name <> " area " <> show (Loop.area (Kernel.loops r)) <> " not " <> show total]
      perimeter =
        size + sum [l | o <- Loop.polyarcs (Kernel.loops region), let Mm l = FlatPolyarc.length o]
      exactly r =
        [ sameDigits "quarter" quarter False r,
          sameDigits "half" (quarter . quarter) False r,
          sameDigits "mirror" mirror True r
        ]
      sameDigits name f flipped r =
        case result
          c
            { outlines = map f (outlines c),
              side = if flipped then Carrier.oppositeSide (side c) else side c
            } of
          Left fault -> [name <> ": " <> show fault]
          Right r'
            | cyclic (map f (Loop.polyarcs (Kernel.loops r)))
                == cyclic (Loop.polyarcs (Kernel.loops r')) ->
              []
            | otherwise ->
              [ name
                  <> " differs: "
                  <> show
                    ( take
                        2
                        ( zip
                            (cyclic (map f (Loop.polyarcs (Kernel.loops r))))
                            (cyclic (Loop.polyarcs (Kernel.loops r')))
                        )
                    )
              ]
      quarter o =
        FlatPolyarc.fromVertices
          (FlatPolyarc.ends o)
          [(-y, x, b) | (x, y, b) <- FlatPolyarc.vertices o]
      mirror o =
        FlatPolyarc.fromVertices
          (FlatPolyarc.ends o)
          [(-x, y, -b) | (x, y, b) <- FlatPolyarc.vertices o]
      cyclic = sort . map (canonical . FlatPolyarc.vertices)
      canonical vs =
        let n = length vs; best = snd (minimum (zip vs [0 ..])) in take n (drop best (cycle vs))

-- | A polyarc that begins at vertex k.
fromVertex :: Int -> FlatPolyarc -> FlatPolyarc
fromVertex k o =
  FlatPolyarc.fromVertices
    (FlatPolyarc.ends o)
    (let (a, b) = splitAt k (FlatPolyarc.vertices o) in b <> a)

-- | True for a problem with nearly full circles. Their radii depend on the last digits of the gap
-- between their ends.
illConditioned :: Case -> Bool
illConditioned c = or [abs b > 100 | o <- outlines c, (_, _, b) <- FlatPolyarc.vertices o]

-- | Two offsets that follow each other have the area of one by the sum of the distances. An offset,
-- its inverse, and the offset again have the area of the first offset.
composition :: Case -> Verdict
composition c = case result c of
  Left _ -> Refused
  Right region ->
    if illConditioned c || not (null (extras c))
      then Holds
      else verdictOf (steps <> (if family c == Cells then [] else back region))
    where
      size = scaleOf c
      total = Loop.area (Kernel.loops region)
      go s d os = Kernel.loops <$> Kernel.offset (Kernel.roundOffset s (Mm d)) os
      steps =
        close
          "in two steps"
          ( go (side c) (0.375 * radius c) (outlines c)
              >>= go (side c) (0.625 * radius c) . Loop.polyarcs
          )
      back r =
        close
          "there and back"
          ( go (Carrier.oppositeSide (side c)) (radius c) (Loop.polyarcs (Kernel.loops r))
              >>= go (side c) (radius c) . Loop.polyarcs
          )
      close name r = case r of
        Left fault -> [name <> ": " <> show fault]
        Right l
          | abs (Loop.area l - total) <= 1e-7 * size * size -> []
          | otherwise -> [name <> " area " <> show (Loop.area l) <> " not " <> show total]

-- | An offset and its inverse give the polyarcs again, when a larger cutter fits everywhere. Such
-- polyarcs are themselves an offset and its inverse: no concave arc, inner corner or slot of them
-- is too narrow.
identity :: Case -> Verdict
identity c = case result c >>= offset' (Carrier.oppositeSide (side c)) (radius c) . loopsOf of
  Left _ -> Refused
  Right region
    | illConditioned c || null (loopsOf region) -> Holds
    | otherwise -> verdictOf (concatMap (again (loopsOf region)) [0.9, 0.35])
  where
    loopsOf = Loop.polyarcs . Kernel.loops
    offset' s d = Kernel.offset (Kernel.roundOffset s (Mm d))
    again swept part =
      case offset' (side c) (part * radius c) swept
        >>= offset' (Carrier.oppositeSide (side c)) (part * radius c) . loopsOf of
        Left fault -> [show part <> ": " <> show fault]
        Right back ->
          let same :: String -> ([FlatPolyarc] -> Double) -> Double -> [String]
              same name f allowed =
                [ show part
                    <> ": "
                    <> name
                    <> " "
                    <> show (f (loopsOf back))
                    <> " not "
                    <> show (f swept)
                  | abs (f (loopsOf back) - f swept) > allowed
                ]
           in same "loops" (fromIntegral . length) 0
                <> same "area" (sum . map FlatPolyarc.area) (1e-8 * scaleOf c * scaleOf c)
                <> same
                  "length"
                  (\os -> sum [l | o <- os, let Mm l = FlatPolyarc.length o])
                  (1e-6 * scaleOf c)

-- | No two segments of the result cross between their ends.
uncrossed :: Case -> Verdict
uncrossed c = case result c of
  Left _ -> Refused
  Right region ->
    let segments =
          concatMap (FlatPolyarc.segments . straightened) (Loop.polyarcs (Kernel.loops region))
     in verdictOf
          [ show a <> " crosses " <> show b <> " at " <> show p
            | a : more <- tails segments,
              b <- more,
              p <- Distance.intersections a b,
              all (clearly p) [a, b],
              slant a b p
          ]
  where
    clearly p s =
      all
        (\q -> let Mm d = Vec.distance p q in d > 1e-5 * scaleOf c)
        [Segment.start s, Segment.end s]
    slant a b p =
      abs
        ( Vec.cross
            (Segment.directionAt (Segment.fraction a p) a)
            (Segment.directionAt (Segment.fraction b p) b)
        )
        > 1e-3

-- | An offset by 0 keeps the area. It keeps the length, too, unless segments touch or coincide:
-- coinciding segments are no boundary.
zero :: Case -> Verdict
zero c = case result c {radius = 0} of
  Left _ -> Refused
  Right region ->
    let same :: String -> (FlatPolyarc -> Double) -> Double -> [String]
        same name f allowed =
          [ name <> " " <> show (total os) <> " not " <> show (total (outlines c))
            | let os = Loop.polyarcs (Kernel.loops region); total = sum . map f,
              abs (total os - total (outlines c)) > allowed
          ]
     in verdictOf
          ( same "area" FlatPolyarc.area (1e-9 * scaleOf c * scaleOf c)
              <> ( if areApart c
                     then
                       same
                         "length"
                         (\o -> let Mm l = FlatPolyarc.length o in l)
                         (1e-8 * scaleOf c)
                     else []
                 )
          )

-- | True when all segments are clearly apart, except at the vertices that they share.
areApart :: Case -> Bool
areApart c =
  notElem True [b /= 0 && abs b < 1e-5 | o <- outlines c, (_, _, b) <- FlatPolyarc.vertices o]
    && and [clear (i, a) (j, b) | (i, a) : more <- tails numbered, (j, b) <- more]
  where
    numbered =
      zip
        [0 :: Int ..]
        (concatMap (\o -> map (o,) (FlatPolyarc.segments (straightened o))) (outlines c))
    total = length numbered
    clear (i, (o, a)) (j, (_, b))
      | j == i + 1 || (i == 0 && j == total - 1 && FlatPolyarc.ends o == Closed) = trimmed a b i j
      | otherwise = far a b
    trimmed a b i j
      | j == i + 1 = far (front a) (back b)
      | otherwise = far (front b) (back a)
    far a b = let Mm d = Distance.distance (Distance.segments a b) in d > 1e-6
    front s = fst (Segment.cutAt 0.99999 s)
    back :: Segment -> Segment
    back s = snd (Segment.cutAt 0.00001 s)

-- | Replaces nearly straight arcs by their chords: distances from their centres lose too many
-- digits.
straightened :: FlatPolyarc -> FlatPolyarc
straightened o =
  FlatPolyarc.fromVertices
    (FlatPolyarc.ends o)
    [(x, y, if abs b < 2e-6 then 0 else b) | (x, y, b) <- FlatPolyarc.vertices o]

-- | The first broken condition of 'reach', tested along the boundary of the result, at points just
-- beside it, and at random points.
brokenAt :: Case -> Kernel.ReachableRegion -> Maybe String
brokenAt c region =
  firstJust boundary offsets <|> firstJust beside spots <|> firstJust thin loops
  where
    firstJust f = listToMaybe . mapMaybe f
    loops = Loop.polyarcs (Kernel.loops region)
    offsets = concatMap Naive.pieces loops
    sources = concatMap Naive.pieces (outlines c)
    isOpen = any ((== Open) . FlatPolyarc.ends) (outlines c)
    scale = scaleOf c
    near = 2e-9 * scale
    d = radius c
    -- The distances of a pocket's walls hold inside the pocket only.
    tooNear (x, y) =
      or
        [ Naive.blocked leftward d ps x y
          | (isPocket, ps) <- asked,
            not isPocket || Naive.winding (map fst ps) x y /= 0
        ]
    leftward = if side c == LeftOf then 1 else -1
    asked =
      zipWith
        ( \o ps ->
            ( not isOpen && leftward * FlatPolyarc.area o > 0,
              if isOpen then ps <> map backwards (reverse ps) else ps
            )
        )
        (outlines c)
        . withDistances (outlines c)
        $ map (d +) (cycle (if null (extras c) then [0] else extras c))
    withDistances os es = case os of
      [] -> []
      o : rest ->
        let ps =
              Naive.pieces o
            (mine, others) = splitAt (length ps) es
         in [(p, e) | (p, e) <- zip ps mine, abs (x0 p - x1 p) + abs (y0 p - y1 p) > 1e-9 * scale] :
            withDistances rest others
    backwards (Piece ax ay bx by b, e) = (Piece bx by ax ay (-b), e)
    blocked = case side c of
      LeftOf -> free c - 1
      RightOf -> free c + 1
    boundary p =
      listToMaybe
        [ "distance off by " <> show (e, x, y, p)
          | t <- [0, 0.03, 0.5, 0.97],
            let (x, y, _, _) = on p t,
            let e = Naive.distance sources x y - d,
            if null (extras c) then abs e > near || isNaN e else e < -near
        ]
    thin o
      | family c `elem` [Cells, Lattice]
          && abs (FlatPolyarc.area o) < 1e-12 * scale * (let Mm l = FlatPolyarc.length o in l) =
        Just ("no area " <> show (FlatPolyarc.area o))
      | otherwise = Nothing
    spots =
      concat
        [ [(x - h * ny, y + h * nx), (x + h * ny, y - h * nx)]
          | p <- offsets,
            t <- [0.04, 0.6],
            let (x, y, nx, ny) = on p t
        ]
        <> take 24 scattered
    h = 1e-6 * scale
    beside (x, y)
      | null (extras c) && abs (far - d) <= 0.3 * h = Nothing
      | not (null (extras c)),
        any ((/= tooNear (x, y)) . tooNear) [(x + h, y), (x - h, y), (x, y + h), (x, y - h)] =
        Nothing
      | not isOpen && far > h && start /= free c && start /= blocked =
        Just ("crossed source not noticed " <> show (x, y, start))
      | number == expected = Nothing
      | otherwise =
        Just
          ( "wrong number "
              <> show number
              <> " not "
              <> show expected
              <> " at "
              <> show (x, y)
              <> " distance "
              <> show far
              <> " source "
              <> show start
          )
      where
        far = Naive.distance sources x y
        start = if isOpen then free c else Naive.winding sources x y
        number = Naive.winding offsets x y
        expected =
          if start == free c && (if null (extras c) then far > d else not (tooNear (x, y)))
            then free c
            else blocked
    corners = [(x0 p, y0 p) | p <- sources]
    (lx, hx, ly, hy) =
      foldl'
        (\(a, b, a', b') (x, y) -> (min a x, max b x, min a' y, max b' y))
        (1 / 0, -1 / 0, 1 / 0, -1 / 0)
        corners
    margin = 1.3 * (d + maximum (0 : extras c)) + 0.1 * (hx - lx)
    scattered =
      pairs (randoms (fromIntegral (length offsets) + truncate (1e6 * abs (sum (map fst corners)))))
    pairs us = case us of
      u : v : more ->
        (lx - margin + u * (hx - lx + 2 * margin), ly - margin + v * (hy - ly + 2 * margin)) :
        pairs more
      _ -> []

-- | The point at a fraction of a segment's sweep or length, and the unit direction there.
on :: Piece -> Double -> (Double, Double, Double, Double)
on (Piece ax ay bx by b) t
  | b == 0 = (ax + t * dx, ay + t * dy, dx / l, dy / l)
  | otherwise =
    ( ax + m * (co * dx + si * dy),
      ay + m * (co * dy - si * dx),
      (co' * dx + si' * dy) / l,
      (co' * dy - si' * dx) / l
    )
  where
    (dx, dy) = (bx - ax, by - ay)
    l = sqrt (dx * dx + dy * dy)
    half = 2 * atan b
    -- The chord to the point deviates from the whole chord by half the remaining sweep.
    m = sin (t * half) / sin half
    (co, si) = (cos ((1 - t) * half), sin ((1 - t) * half))
    (co', si') = (cos ((1 - 2 * t) * half), sin ((1 - 2 * t) * half))

-- | Pseudo-random numbers from 0 to 1, from a seed.
randoms :: Word64 -> [Double]
randoms = map unit . drop 1 . iterate step . (+ 88172645463325252)
  where
    step s0 = let s1 = s0 `xor` (s0 * 8192); s2 = s1 `xor` (s1 `shiftR` 7) in s2 `xor` (s2 * 131072)
    unit s = fromIntegral (s `shiftR` 11) / 9007199254740992
