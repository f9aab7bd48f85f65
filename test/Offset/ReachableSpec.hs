-- | The laws of reachable paths beside contours where the cutter may not fit everywhere. Each law
-- names the bug that it catches.
module Offset.ReachableSpec (spec, Subject (..), subject, reached, laws) where

import Base.Quantity (Mm (..), Rad (..), plus)
import Data.List (nub)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Generate qualified
import Generate.Outline qualified as Outlines
import Geometry.Carrier (Side (..))
import Geometry.Distance qualified as Distance
import Geometry.FlatPolyarc (FlatPolyarc)
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.SelfIntersection qualified as SelfIntersection
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Offset.Equidistant
  ( Cause (..),
    CornerStyle (..),
    Obstacle (..),
    OffsetSegment (..),
    Origin (..),
    RestMaterial (..),
    TrimmedOffset (pieces),
    UnreachedPart (..),
  )
import Offset.Equidistant qualified as Equidistant
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "laws of reachable paths" $ do
  mapM_
    ( \(title, law) ->
        it
          title
          ( property
              (withMaxSuccess 1000 (forAll subject (conjoin . map (`counterexample` False) . law)))
          )
    )
    laws
  it
    "covers gaps at inner corners, at concave arcs and between distant elements"
    $ checkCoverage . forAll subject $ \s ->
      let causes = map (cause . stop) (snd (reached s))
       in cover 30 (not (null causes)) "rest material"
            . cover 20 (any isCorner causes) "corners"
            . cover 0.5 (or [True | SameAs _ <- map restMaterial (snd (reached s))]) "several gaps"
            . cover
              10
              ( ends (contour s) == Closed
                  && not (null causes)
                  && notElem Unbounded (map restMaterial (snd (reached s)))
              )
              "bounded"
            . cover 2 (any isConcave causes) "concave arcs"
            $ cover 5 (any isCollision causes) "collisions" True

-- | A contour with the side and the radius in mm of a cutter that may not fit everywhere.
data Subject = Subject {contour :: Polyarc, side :: Side, radius :: Double}
  deriving stock (Show)

-- | A law; its result lists the violations.
type Law = Subject -> [String]

laws :: [(String, Law)]
laws =
  [ ( "paths: every point is at the cutter's radius, and each segment begins where the one before \
      \ends (catches a segment of the wrong loop)",
      pathsLaw
    ),
    ( "whole: a point at the radius from an element, and further from all others, is on a path \
      \(catches a path that is lost)",
      wholeLaw
    ),
    ( "reported: where a part beside an element cannot be reached, there is rest material (catches \
      \a gap that is not reported)",
      reportedLaw
    ),
    ( "centre: where the cutter is stopped, it touches the elements that stop it (catches the \
      \centre at another gap)",
      centreLaw
    ),
    ( "material: beside a closed contour, exactly the points that are farther than the radius from \
      \all paths are rest material (catches edges of the cutter that intersect)",
      materialLaw
    ),
    ( "boundary: it is closed, and its last segment is the cutter's edge at the gap (catches an \
      \edge in the wrong sense)",
      boundaryLaw
    ),
    ( "largest: a cutter of the reported radius is not stopped there, a slightly larger one is \
      \(catches a bisection that is left out)",
      largestLaw
    ),
    ( "evaluated: with sharp corners and with different distances all paths and rest materials can \
      \be evaluated (catches a crash in a lazy part)",
      evaluatedLaw
    )
  ]

-- | Closed and open contours of lines and arcs: smooth, with corners, on grids, degenerate.
subject :: Gen Subject
subject = do
  c <- frequency [(2, rooms), (5, anyhow)]
  side <- elements [LeftOf, RightOf]
  let Mm l = Polyarc.length c
  radius <- frequency [(3, (l *) <$> choose (0.002, 0.06)), (1, elements [0.25, 0.5, 1, 2, 3])]
  pure Subject {contour = c, side, radius}
  where
    anyhow =
      oneof
        [ outlined Outlines.problem,
          outlined Outlines.open,
          Generate.contour <$> Generate.closedCase,
          Generate.contour <$> Generate.openCase
        ]
    outlined gen = do
      c <- gen
      case Outlines.outlines c of
        o : _
          | Just ss <-
              NonEmpty.nonEmpty
                ( filter
                    ((> Tolerance.coincident) . Segment.length)
                    (FlatPolyarc.segments (straightened o))
                ),
            whole <- Polyarc (FlatPolyarc.ends o) ss,
            Nothing <- SelfIntersection.firstSelfIntersection whole ->
            pure whole
        _ -> outlined gen

-- | Rooms in a row with passages between them, some of which are too narrow for a cutter.
rooms :: Gen Polyarc
rooms = do
  count <- choose (2, 5)
  heights <- vectorOf (2 * count - 1) (choose (1, 12))
  lengths <- vectorOf (2 * count - 1) (choose (0, 1))
  turned <- choose (0, 2 * pi)
  let widths = [if even k then 3 + 6 * l else 0.1 + 3 * l | (k, l) <- zip [0 :: Int ..] lengths]
      walls =
        zip3
          (scanl (+) 0 widths)
          widths
          [if even k then h + 8 else h / 2 | (k, h) <- zip [0 :: Int ..] heights]
      below = concat [[Vec.point x (-h), Vec.point (x + w) (-h)] | (x, w, h) <- walls]
      above = concat [[Vec.point (x + w) h, Vec.point x h] | (x, w, h) <- reverse walls]
      corners =
        map
          (\p -> Vec.shift (Vec.rotate (Rad turned) (Vec.to (Vec.point 0 0) p)) (Vec.point 3 4))
          (below <> above)
  pure
    ( Polyarc
        Closed
        (NonEmpty.fromList (zipWith Straight corners (drop 1 corners <> take 1 corners)))
    )

-- | Replaces arcs that are nearly straight by their chords: distances from their centres lose too
-- many digits.
straightened :: FlatPolyarc -> FlatPolyarc
straightened o =
  FlatPolyarc.fromVertices
    (FlatPolyarc.ends o)
    [(x, y, if abs b < 1e-5 then 0 else b) | (x, y, b) <- FlatPolyarc.vertices o]

style :: CornerStyle
style = CornerStyle {sharp = False, extra = const (Mm 0)}

-- | The reachable paths, and the parts of the contour that are not reached.
reached :: Subject -> ([TrimmedOffset], [UnreachedPart])
reached s = Equidistant.reachable style (side s) (Mm (radius s)) (contour s)

-- | The allowed error of points, in mm.
slack :: Subject -> Double
slack s =
  1e-9
    * ( radius s
          + sum [abs (Vec.x p) + abs (Vec.y p) | p <- take 1 (map Segment.start (elementsOf s))]
          + l
      )
    + 1e-9
  where
    Mm l = Polyarc.length (contour s)

elementsOf :: Subject -> [Segment]
elementsOf = NonEmpty.toList . segments . contour

distanceTo :: Point -> Segment -> Double
distanceTo p s = let Mm d = Distance.toPoint p s in d

gap :: Point -> Point -> Double
gap p q = let Mm d = Vec.distance p q in d

pathsLaw :: Law
pathsLaw s = concatMap ofPath (fst (reached s))
  where
    ofPath w =
      let ps = map segment (NonEmpty.toList (pieces w))
       in [ "a gap of " <> show (gap (Segment.end a) (Segment.start b))
            | (a, b) <-
                zip
                  ps
                  ( drop 1 ps
                      <> [NonEmpty.head (fmap segment (pieces w)) | Equidistant.ends w == Closed]
                  ),
              gap (Segment.end a) (Segment.start b) > slack s
          ]
            <> [ "distance " <> show d <> " at " <> show p
                 | a <- ps,
                   t <- [0, 0.1, 0.5, 0.8],
                   let p = Segment.at t a,
                   let d = minimum (map (distanceTo p) (elementsOf s)),
                   abs (d - radius s) > slack s
               ]

-- | Points at the radius from the elements, on the cutter's side. Each has the number of the
-- element and the distance from the nearest other element.
beside :: Subject -> [(Int, Point, Double)]
beside s =
  [ (i, p, minimum (1 / 0 : [distanceTo p o | (j, o) <- numbered, j /= i]))
    | (i, e) <- numbered,
      t <- [0.13, 0.5, 0.77],
      Just p <- [aside e t]
  ]
  where
    numbered = zip [0 ..] (elementsOf s)
    left = if side s == LeftOf then 1 else -1
    moved e t =
      Vec.shift (Vec.scale (left * radius s) (Vec.left (Segment.directionAt t e))) (Segment.at t e)
    -- The point beside fraction t of an element; none at the centre of an arc, or beyond it.
    aside e t
      | gap (moved e 0) (moved e 0.5) > 1e-5 && distanceTo (moved e t) e > radius s - slack s =
        Just (moved e t)
      | otherwise = Nothing

wholeLaw :: Law
wholeLaw s =
  [ "not on a path: " <> show p <> " beside " <> show i
    | (i, p, near) <- beside s,
      near > radius s + 1e-5,
      all (\w -> all ((> slack s) . distanceTo p . segment) (pieces w)) paths
  ]
  where
    paths = fst (reached s)

reportedLaw :: Law
reportedLaw s =
  [ "no rest material though "
      <> show p
      <> " beside "
      <> show i
      <> " is "
      <> show near
      <> " from another one"
    | not (null paths),
      null rests,
      (i, p, near) <- take 1 [b | b@(_, _, near) <- beside s, near < radius s - 1e-3]
  ]
  where
    (paths, rests) = reached s

centreLaw :: Law
centreLaw s =
  concatMap
    ( \r ->
        [ "rest " <> show (cause (stop r)) <> " at " <> show (cutterCentre r) <> ": " <> show d
          | d <- map (distanceTo (cutterCentre r) . (elementsOf s !!)) (touched (cause (stop r))),
            abs (d - radius s) > slack s
        ]
    )
    (snd (reached s))
  where
    n = length (elementsOf s)
    -- A concave arc stops the cutter where the cutter touches the elements before and after it.
    touched c = case c of
      Concave i _ -> [(i + n - 1) `mod` n, (i + 1) `mod` n]
      InnerCorner i j _ -> [i, j]
      Collision i j _ -> [i, j]

materialLaw :: Law
materialLaw s
  | ends (contour s) == Open || null paths || any ((== Unbounded) . restMaterial) rests = []
  | otherwise =
    [ "remains " <> show remains <> ", reported " <> show reported <> " at " <> show p
      | p <- points,
        let far = minimum (map (distanceTo p) pathSegments),
        abs (far - radius s) > 1e-5,
        let remains = far > radius s,
        let reported = any ((/= 0) . WindingNumber.about p) boundaries,
        remains /= reported
    ]
  where
    (paths, rests) = reached s
    pathSegments = map segment (concatMap (NonEmpty.toList . pieces) paths)
    boundaries = [NonEmpty.toList boundary | Within boundary <- map restMaterial rests]
    -- Points on the cutter's side of the contour, nearer to it than the radius.
    points =
      [ p
        | e <- elementsOf s,
          t <- [0.1, 0.3, 0.5, 0.7, 0.9],
          share <- [0.1, 0.3, 0.5, 0.7, 0.9],
          let p =
                Vec.shift
                  (Vec.scale (left * share * radius s) (Vec.left (Segment.directionAt t e)))
                  (Segment.at t e),
          minimum (map (distanceTo p) (elementsOf s)) > 1e-5,
          (WindingNumber.about p (elementsOf s) /= 0) == isInside
      ]
    left = if side s == LeftOf then 1 else -1
    isInside = (Polyarc.signedArea (contour s) > 0) == (side s == LeftOf)

boundaryLaw :: Law
boundaryLaw s = concatMap one (snd (reached s))
  where
    rests = snd (reached s)
    edgesIn chain =
      [a | a@Arc {centre} <- chain, any ((<= slack s) . gap centre . cutterCentre) rests]
    one r = case restMaterial r of
      Unbounded -> []
      SameAs p ->
        [ "no rest material is listed at that centre"
          | null [() | o <- rests, cutterCentre o == p, Within _ <- [restMaterial o]]
        ]
      Within boundary@(first :| more) ->
        let chain = NonEmpty.toList boundary
         in [ "a gap of " <> show (gap (Segment.end a) (Segment.start b))
              | (a, b) <- zip chain (more <> [first]),
                gap (Segment.end a) (Segment.start b) > slack s
            ]
              <> [ "not the cutter's edge"
                   | Arc {centre, start} <- take 1 (reverse chain),
                     gap centre (cutterCentre r) > slack s
                       || abs (gap centre start - radius s) > slack s
                 ]
              <> [ "it contains the cutter: " <> show (cause (stop r))
                   | edge <- take 1 (reverse chain),
                     WindingNumber.about
                       (Vec.interpolate (-0.5) (cutterCentre r) (Segment.at 0.5 edge))
                       chain
                       /= 0
                 ]
              <> [ "a path goes through it: " <> show (cause (stop r))
                   | w <- fst (reached s),
                     p <- NonEmpty.toList (pieces w),
                     let at = Segment.at 0.5 (segment p),
                     all ((> radius s / 2) . distanceTo at) (edgesIn chain),
                     WindingNumber.about at chain /= 0
                 ]
              <> [ "not on the cutter's side: " <> show (cause (stop r), a)
                   | let a = Polyarc.signedArea (Polyarc Closed (first :| more)),
                     (if side s == LeftOf then a else -a) <= 0
                 ]

largestLaw :: Law
largestLaw s = concatMap one (nub (map stop (snd (reached s))))
  where
    one o = case (cause o, largest o) of
      (InnerCorner {}, Nothing) -> []
      (InnerCorner {}, Just r) -> ["a cutter fits into a corner: " <> show r]
      (c, Nothing) ->
        ["a cutter of radius 0.001 fits: " <> show c | not (stopped c (Mm 1e-3))]
      (c, Just r)
        | r >= Mm (radius s) -> ["not smaller: " <> show r]
        | stopped c r -> ["stopped: " <> show (c, r)]
        | not (stopped c (plus r (Mm 1e-4))) && plus r (Mm 1e-4) < Mm (radius s) ->
          ["a larger one is not stopped: " <> show (c, r)]
        | otherwise -> []
    -- True when the cause is reported again, or its elements are not reached at all.
    stopped c r =
      let (paths, rests) = Equidistant.reachable style (side s) r (contour s)
       in any (sameAs c . cause . stop) rests || any (\e -> not (isOn paths e)) (about c)
    isOn paths i = or [number (origin p) == i | w <- paths, p <- NonEmpty.toList (pieces w)]
    number o = case o of
      Along i -> i
      Around i -> i
    about c = case c of
      Concave i _ -> [i]
      InnerCorner i j _ -> [i, j]
      Collision i j _ -> [i, j]
    sameAs a b = case (a, b) of
      (Concave i _, Concave j _) -> i == j
      (Collision i j _, Collision k l _) -> (i, j) == (k, l) || (i, j) == (l, k)
      _ -> False

evaluatedLaw :: Law
evaluatedLaw s =
  [ show answer
    | answer <-
        [ Equidistant.reachable
            CornerStyle {sharp = isSharp, extra = more}
            (side s)
            (Mm (radius s))
            (contour s)
          | isSharp <- [False, True],
            more <- [const (Mm 0), \i -> Mm (if even i then 0 else 0.3 * radius s)]
        ],
      length (show answer) < 0
  ]

isCorner, isConcave, isCollision :: Cause -> Bool
isCorner c = case c of
  InnerCorner {} -> True
  Concave {} -> False
  Collision {} -> False
isConcave c = case c of
  Concave {} -> True
  InnerCorner {} -> False
  Collision {} -> False
isCollision c = case c of
  Collision {} -> True
  InnerCorner {} -> False
  Concave {} -> False
