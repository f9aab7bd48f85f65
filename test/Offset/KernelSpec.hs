-- | The laws of the offset kernel. Each law names the bug that it catches.
module Offset.KernelSpec (spec) where

import Base.Quantity (Mm (..))
import CaseCount (askedCount)
import Data.List (tails)
import Data.Maybe (fromMaybe)
import Data.Primitive.PrimArray (sizeofPrimArray)
import Generate.Outline (Case (..), Family (..), turned)
import Generate.Outline qualified as Generate
import Geometry.Carrier (Side (..))
import Geometry.ClosedPolyarcs qualified as ClosedPolyarcs
import Geometry.FlatPolyarc (FlatPolyarc)
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Polyarc (Ends (..))
import Offset.Judge (Verdict (..))
import Offset.Judge qualified as Judge
import Offset.Kernel (Corners (..), OffsetFault (..), OffsetRequest (..))
import Offset.Kernel qualified as Kernel
import Offset.Loop qualified as Loop
import Test.Hspec
import Test.QuickCheck
import Test.QuickCheck.Gen (unGen)
import Test.QuickCheck.Random (mkQCGen)

spec :: Spec
spec = do
  count <- runIO (fromMaybe 3000 <$> askedCount "PARTC_CONTOURS")
  describe "laws of the offset kernel" $ do
    each
      count
      "reach: a point lies inside the result exactly if it is far enough from the contours, and \
      \the boundary is at the distance (catches a slice kept with the wrong winding number)"
      Generate.problem
      Judge.reach
    each
      (count `div` 3)
      "reach, beside open contours (catches an end without an arc about it)"
      Generate.open
      Judge.reach
    each
      (count `div` 3)
      "uneven: when segments have different distances, each holds beside its own segment (catches \
      \a missing line between two distances)"
      Generate.uneven
      Judge.reach
    each
      (count `div` 3)
      "sameness: rotation by quarter turns and mirroring change no digit of the loops; another \
      \first vertex, motion and reversal keep the area (catches an order of edges that depends on \
      \the axes)"
      Generate.problem
      Judge.sameness
    each
      (count `div` 6)
      "sameness, beside open contours (catches a side that depends on the first end)"
      Generate.open
      Judge.sameness
    each
      (count `div` 3)
      "composition: an offset by a and then by b is one by a + b; an offset, its inverse and the \
      \offset again is the offset (catches nested contours of one sense that are accepted)"
      Generate.problem
      Judge.composition
    each
      (count `div` 3)
      "identity: an offset and its inverse give the contours again, when a larger cutter fits \
      \everywhere (catches a trimmed arc with the bulge of the whole arc)"
      Generate.problem
      Judge.identity
    each
      (count `div` 3)
      "uncrossed: no two segments of a result cross (catches a loop with a vertex of another one)"
      Generate.problem
      Judge.uncrossed
    it "zero: the offset by 0 is the contour itself (catches a joint that adds a segment)" $
      property . forAll Generate.simple $ \o -> forAll (elements [LeftOf, RightOf]) $ \s ->
        fmap (map FlatPolyarc.vertices) (loopsOf s 0 [o]) === Right [FlatPolyarc.vertices o]
    it
      "zero: the offset by 0 of a square with a narrow slit is the contour itself (catches two \
      \nearly parallel lines that are cut at their intersection)"
      $ let o =
              Generate.loop
                [(10, 0, 0), (10, 10, 0), (0, 10, 0), (0, 0, 0), (5, 5, 0), (1.001, 1, 0)]
         in [fmap (map FlatPolyarc.vertices) (loopsOf s 0 [o]) | s <- [LeftOf, RightOf]]
              `shouldBe` replicate 2 (Right [FlatPolyarc.vertices o])
    each
      (count `div` 3)
      "zero, for all contours: the offset by 0 keeps area and length (catches an arc that is lost \
      \at the distance 0)"
      Generate.problem
      Judge.zero
    it
      "Steiner, with arcs: the same formulas hold around an offset of a convex polygon (catches an \
      \arc that keeps its radius)"
      $ property . forAll Generate.convex $ \vs ->
        forAll (choose (0.01, 5)) $ \r -> forAll (choose (0.01, 5)) $ \r' ->
          case loopsOf RightOf r' [Generate.loop vs] of
            Right [o] -> steiner o r
            other -> counterexample (show other) False
    it
      "Steiner: around a convex polygon the area is A + LR + πR², the length L + 2πR (catches a \
      \corner that is cut off)"
      $ property . forAll Generate.convex $ \vs ->
        forAll (choose (0.01, 5)) $ \r -> steiner (Generate.loop vs) r
    it
      "back: an offset of a convex polygon outwards and then inwards is the polygon (catches two \
      \sides of the cutter that give one side of the contour)"
      $ property . forAll Generate.convex $ \vs -> forAll (choose (0.01, 5)) $ \r ->
        let o = Generate.loop vs
         in fmap (sum . map FlatPolyarc.area) (loopsOf RightOf r [o] >>= loopsOf LeftOf r)
              `nearly` Right (FlatPolyarc.area o)
    it "crossed: two sides that cross are reported (catches a self-intersection that is accepted)" $
      property (forAll bowTie crossedLaw)
    it
      "far out: short arcs tangent to lines give no corners, neither in the result nor in the raw \
      \offset (catches a comparison of directions that is finer than their rounding)"
      $ do
        let made = Kernel.offset (Kernel.roundOffset RightOf (Mm 3)) [lobes 10000]
        fmap (map FlatPolyarc.size . found) made `shouldBe` Right [20000]
        fmap (\region -> sizeofPrimArray (ClosedPolyarcs.xs (Kernel.raw region))) made
          `shouldBe` Right (20000 + 1)
    it
      "cusp: the area beside a contour with a cusp does not depend on its first vertex (catches an \
      \outermost point just before the end of an arc)"
      $ let horn =
              [ (-20.625495970237296, -11.829756256299746, 0),
                (-20.625495970237296, -10.329756256299746, 0),
                (-19.625495970237296, -10.329756256299746, 0),
                (-19.625495970237296, -10.829756256299746, 0.4142135623730951)
              ]
            areaFrom k = areaOf LeftOf 0.5 [Generate.loop (drop k horn <> take k horn)]
         in mapM_ (\k -> areaFrom k `nearly` areaFrom 0) [1 .. 3]
    it
      "covers degenerate contours: repeated vertices, spikes, vertices on straight lines, touching \
      \contours, integer coordinates, nearly straight arcs and nearly full circles"
      $ [ name
          | (name, has) <- degenerate,
            length
              (filter has (take 3000 [unGen Generate.problem (mkQCGen seed) 30 | seed <- [1 ..]]))
              < 20
        ]
        `shouldBe` []
  describe "slots, pockets and islands" $ do
    it "a cutter exactly as wide as a slot has no loop" $
      loopsOf LeftOf 1 [Generate.loop [(0, 0, 0), (10, 0, 0), (10, 2, 0), (0, 2, 0)]]
        `shouldBe` Right []
    it "a cutter with the radius of a round pocket has no loop" $
      loopsOf LeftOf 2 [circle 2] `shouldBe` Right []
    it
      "a cutter much larger than a round pocket has no loop (catches a loop that turns inside out)"
      $ map (\r -> loopsOf LeftOf r [circle 2]) [2.5, 4, 10, 1000] `shouldBe` replicate 4 (Right [])
    it "a cutter that covers all of a pocket but its corners has no loop" $
      loopsOf LeftOf 0.7 [lens] `shouldBe` Right []
    it "a pocket that is too small does not change the result of the one beside it" $
      areaOf LeftOf 1 [square 0 0 10, turned 1 0 (20, 5) (circle 0.4)] `nearly` Right 64
    it "the cutter goes around an island in a pocket" $
      areaOf LeftOf 1 [square 0 0 10, FlatPolyarc.reverse (square 4 4 2)]
        `nearly` Right (64 - (4 + 8 + pi))
    it "the cutter goes around islands without a pocket" $
      areaOf LeftOf 1 [FlatPolyarc.reverse (square 0 0 2), FlatPolyarc.reverse (square 10 0 2)]
        `nearly` Right (-(2 * (4 + 8 + pi)))
    it "islands with a gap narrower than the cutter have one common loop" $
      fmap
        length
        (loopsOf LeftOf 1 [FlatPolyarc.reverse (square 0 0 2), FlatPolyarc.reverse (square 3 0 2)])
        `shouldBe` Right 1
    it "a contour inside another one of the same sense is refused" $
      loopsOf LeftOf 1 [square 0 0 10, square 4 4 2] `shouldBe` Left WrongNesting
    it "contours that touch at corners or along sides are accepted" $
      fmap length (loopsOf RightOf 0.25 [square 0 0 1, square 1 1 1, square 1 0 1])
        `shouldBe` Right 1
    it "sharp corners are at the intersections of the offset lines" $
      fmap
        (map FlatPolyarc.vertices . found)
        (Kernel.offset (Kernel.roundOffset RightOf (Mm 1)) {corners = Sharp} [square 0 0 2])
        `nearly'` [(-1, -1), (3, -1), (3, 3), (-1, 3)]
    it
      "a larger distance inside a crevice does not hold on the other side of the material (catches \
      \an arc about a cusp that is open towards the cutter)"
      $ fmap
        (maximum . concatMap (\o -> [y | (_, y, _) <- FlatPolyarc.vertices o]) . found)
        ( Kernel.offset
            (Kernel.roundOffset RightOf (Mm 1))
              { extra =
                  Just (\i -> Mm (if i == 1 || i == 2 then 4 else 0))
              }
            [ Generate.loop
                [(0, 0, 0), (3, 0, 1), (4, 0, 1), (5, 0, 0), (8, 0, 0), (8, 1.5, 0), (0, 1.5, 0)]
            ]
        )
        `nearly` Right 2.5
    it "the loop of an open line is on both sides of it and about both ends" $
      areaOf LeftOf 1 [FlatPolyarc.fromVertices Open [(0, 0, 0), (5, 0, 0)]]
        `nearly` Right (-(10 + pi))
    it "the side of an open contour changes only the sense of its loop" $
      areaOf RightOf 1 [FlatPolyarc.fromVertices Open [(0, 0, 0), (5, 0, 0), (5, 5, 0)]]
        `nearly` Right (20 + pi - 1 + pi / 4)

-- | @n@ circles of radius 4 around a large one, joined by tangents.
lobes :: Int -> FlatPolyarc
lobes n =
  FlatPolyarc.fromVertices
    Closed
    ( concat
        [ [at (a - half) k, at (a + half) 0]
          | i <- [0 .. n - 1],
            let a = 2 * half * fromIntegral i,
            let at b bulge = (r * cos a + 4 * cos b, r * sin a + 4 * sin b, bulge)
        ]
    )
  where
    half = pi / fromIntegral n
    k = tan (half / 2)
    r = 6 / sin half

-- | A law for @count@ random problems. A failure reports the seeds of the problems that break it.
each :: Int -> String -> Gen Case -> (Case -> Verdict) -> Spec
each count title gen law = it title (filter isBroken verdicts `shouldBe` [])
  where
    verdicts = [(seed, law (unGen gen (mkQCGen seed) 30)) | seed <- [1 .. count]]
    isBroken (_, v) = case v of
      Broken _ -> True
      Holds -> False
      Refused -> False

-- | Kinds of degenerate contours that the generator must produce, with their tests.
degenerate :: [(String, Case -> Bool)]
degenerate =
  [ ("repeated vertices", anyVertex (\_ (x, y, _) (x', y', _) -> (x, y) == (x', y'))),
    ( "spikes",
      anyVertex
        ( \(x, y, _) (x1, y1, b1) (x', y', b') ->
            b1 == 0 && b' == 0 && (x, y) == (x', y') && (x, y) /= (x1, y1)
        )
    ),
    ( "vertices on straight lines",
      anyVertex
        ( \(x, y, b) (x1, y1, b1) (x2, y2, _) ->
            b == 0
              && b1 == 0
              && (x1 - x) * (y2 - y1) == (y1 - y) * (x2 - x1)
              && (x1 - x) * (x2 - x1) + (y1 - y) * (y2 - y1) > 0
        )
    ),
    ( "contours that touch",
      \c ->
        or
          [ (x, y) == (x', y')
            | (o, p) <- pairs (outlines c),
              (x, y, _) <- FlatPolyarc.vertices o,
              (x', y', _) <- FlatPolyarc.vertices p
          ]
    ),
    ( "a contour that touches itself",
      \c ->
        or
          [ (x, y) == (x', y')
            | o <- outlines c,
              let vs = zip [0 :: Int ..] (FlatPolyarc.vertices o),
              (i, (x, y, _)) <- vs,
              (j, (x', y', _)) <- vs,
              j > i + 1,
              not (i == 0 && j == length vs - 1)
          ]
    ),
    ( "integer coordinates",
      anyVertex
        ( \_ (x, y, _) _ ->
            all (\v -> v == fromIntegral (round v :: Int)) [x, y] && x /= 0 && y /= 0
        )
    ),
    ("nearly straight arcs", anyVertex (\_ (_, _, b) _ -> b /= 0 && abs b < 1e-5)),
    ("nearly full circles", anyVertex (\_ (_, _, b) _ -> abs b > 1e3)),
    ( "a slot or a pocket of the cutter's size",
      \c -> family c == Cells && radius c `elem` [0.5, 1, 1.5, 2]
    )
  ]
  where
    anyVertex f c =
      or
        [ f u v w
          | o <- outlines c,
            let vs = FlatPolyarc.vertices o,
            (u, v, w) <- zip3 (drop (length vs - 1) vs <> vs) vs (drop 1 vs <> vs)
        ]
    pairs os = [(o, p) | o : more <- tails os, p <- more]

found :: Kernel.ReachableRegion -> [FlatPolyarc]
found = Loop.polyarcs . Kernel.loops

loopsOf :: Side -> Double -> [FlatPolyarc] -> Either OffsetFault [FlatPolyarc]
loopsOf s r os = found <$> Kernel.offset (Kernel.roundOffset s (Mm r)) os

areaOf :: Side -> Double -> [FlatPolyarc] -> Either OffsetFault Double
areaOf s r os = sum . map FlatPolyarc.area <$> loopsOf s r os

nearly :: Either OffsetFault Double -> Either OffsetFault Double -> Expectation
nearly a b = case (a, b) of
  (Right x, Right y) -> x `shouldSatisfy` (\v -> abs (v - y) < 1e-9 * (1 + abs y))
  _ -> a `shouldBe` b

nearly' :: Either OffsetFault [[(Double, Double, Double)]] -> [(Double, Double)] -> Expectation
nearly' a expected = case a of
  Right [vs] ->
    [(x, y) | (x, y) <- expected, not (any (\(x', y', _) -> abs (x - x') + abs (y - y') < 1e-9) vs)]
      `shouldBe` []
  _ -> fmap length a `shouldBe` Right 1

square :: Double -> Double -> Double -> FlatPolyarc
square x y a = Generate.loop [(x, y, 0), (x + a, y, 0), (x + a, y + a, 0), (x, y + a, 0)]

circle :: Double -> FlatPolyarc
circle r = Generate.loop [(-r, 0, 1), (r, 0, 1)]

-- | A square with two opposite corners rounded.
lens :: FlatPolyarc
lens =
  turned
    1
    (pi / 4)
    (0, 0)
    ( Generate.loop
        [ (0, 0, 0),
          (0.75, 0, tan (pi / 8)),
          (1, 0.25, 0),
          (1, 1, 0),
          (0.25, 1, tan (pi / 8)),
          (0, 0.75, 0)
        ]
    )

-- | Steiner's formulas for the offset by r around a convex contour.
steiner :: FlatPolyarc -> Double -> Property
steiner o r = case loopsOf RightOf r [o] of
  Right [q] ->
    let Mm l = FlatPolyarc.length o
        Mm l' = FlatPolyarc.length q
     in counterexample
          (show q)
          ( abs (FlatPolyarc.area q - (FlatPolyarc.area o + l * r + pi * r * r))
              < 1e-9 * FlatPolyarc.area q
                && abs (l' - (l + 2 * pi * r))
              < 1e-9 * l'
          )
  other -> counterexample (show other) False

-- | A simple polygon in which two neighbouring vertices are exchanged, so that two sides cross; and
-- the numbers of these sides.
bowTie :: Gen (FlatPolyarc, Int, Int)
bowTie = do
  o <- Generate.simple
  let vs = FlatPolyarc.vertices o
      n = length vs
  k <- choose (0, n - 1)
  let (a, b) = splitAt k vs
      at i = (b <> a) !! (i `mod` n)
      exchanged = [at 0, at 2, at 1] <> map at [3 .. n - 1]
      point i = let (x, y, _) = exchanged !! (i `mod` n) in (x, y)
  if n >= 4 && crossing (point 0) (point 1) (point 2) (point 3)
    then pure (Generate.loop exchanged, 0, 2)
    else bowTie

crossing :: (Double, Double) -> (Double, Double) -> (Double, Double) -> (Double, Double) -> Bool
crossing a b c d = side' a b c * side' a b d < 0 && side' c d a * side' c d b < 0

side' :: (Double, Double) -> (Double, Double) -> (Double, Double) -> Double
side' (ax, ay) (bx, by) (cx, cy) = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)

-- | The reported sides cross. They may be others than those of 'bowTie'.
crossedLaw :: (FlatPolyarc, Int, Int) -> Property
crossedLaw (o, _, _) = case loopsOf LeftOf 0.1 [o] of
  Left (SelfIntersecting i j) ->
    counterexample (show (i, j)) (crossing (point i) (point (i + 1)) (point j) (point (j + 1)))
  other -> counterexample (show other) False
  where
    vs = FlatPolyarc.vertices o
    point i = let (x, y, _) = vs !! (i `mod` length vs) in (x, y)
