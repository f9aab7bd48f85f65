-- | Laws of outlines: entities in any order and direction, gaps, branches, overlaps and repeated
-- entities.
module Drawing.OutlineSpec
  ( spec,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List (sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Drawing.Drawing (Entity (..), PathPart (..), Shape (..))
import Drawing.Outline (ClosedGap (..), DrawnPart (..), JoinFault (..), Joining (..), Outline (..))
import Drawing.Outline qualified as Outline
import Drawing.OutlineTolerance qualified as Tolerance
import Drawing.PathPart qualified as PathPart
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (Arc, Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  it
    "lines and arcs in any order and direction make the outlines from which they come (catches \
    \chains that are joined without being reversed)"
    $ property $
      forAll (choose (1, 4) >>= traverse ring . enumFromTo 1) $ \rings ->
        forAll (mixed (concat rings)) $ \entities ->
          let Joining {outlines, gaps, repeated, faults} = Outline.joined Tolerance.joining entities
           in conjoin
                [ map ends outlines === map (const Closed) rings,
                  sort (map (cornersOf . parts) outlines)
                    === sort (map (sort . map (coordinates . PathPart.start)) rings),
                  counterexample (show (gaps, faults)) (null gaps && null faults && null repeated)
                ]
  it
    "ends are joined up to the distance, each gap is told with its width, and parts follow one \
    \another exactly (catches gaps that are closed silently)"
    $ property $
      forAll (ring 1) $ \parts' ->
        forAll (elements [0.004, 0.009, 0.011, 0.02]) $ \gap ->
          let moved = case parts' of
                Plain (Straight p q) : more -> Plain (Straight (beside gap p) q) : more
                _ -> parts'
              Joining {outlines, gaps} = Outline.joined (Mm 0.01) (entitiesOf moved)
           in isLine (take 1 parts')
                ==> if gap < 0.01
                  then
                    conjoin
                      [ map ends outlines === [Closed],
                        counterexample (show gaps) (map (isWide gap . width) gaps === [True]),
                        conjoin (map follows outlines)
                      ]
                  else conjoin [map ends outlines === [Open], gaps === []]
  it
    "a third end at a joint, a part along another one and a repeated entity are found (catches \
    \faults that are looked for at ends only)"
    $ property $
      forAll (ring 1) $ \parts' ->
        forAll (choose (0, length parts' - 1)) $ \k ->
          let chosen = parts' !! k
              corner = PathPart.start chosen
              spur = Plain (Straight corner (beside 500 corner))
              part = Plain (Segment.between 0.2 0.7 (segmentOf chosen))
              foundWith more = Outline.joined Tolerance.joining (entitiesOf (parts' <> more))
           in conjoin
                [ counterexample "branch" (any isBranch (faults (foundWith [spur]))),
                  counterexample "overlap" (any isOverlap (faults (foundWith [part]))),
                  counterexample "repeated" $
                    let j = foundWith [PathPart.reversed chosen]
                     in (length (repeated j), length (faults j)) === (1, 0)
                ]
  it "arcs whose ends nearly meet are circles, and short lines stay open" $ do
    let shortLine = Plain (Straight (Vec.point 0 0) (Vec.point 0.0005 0))
        arc a = Plain (Arc (Vec.point 10 0) (Vec.shift (Vec.polar (Mm 10) a) o) o a)
        o = Vec.point 0 0
        joinedAlone p =
          [ (ends x, fmap (lengthOf . part) (parts x))
            | x <- outlines (Outline.joined Tolerance.joining (entitiesOf [p]))
          ]
        lengthOf p = case p of
          Plain s -> let Mm v = Segment.length s in fromIntegral (round (v * 1e4) :: Int) / 1e4
          _ -> 0 :: Double
    joinedAlone shortLine `shouldBe` [(Open, 0.0005 :| [])]
    joinedAlone (arc (Rad (2 * pi - 1e-6))) `shouldBe` [(Closed, 62.8319 :| [])]
    joinedAlone (arc (Rad 1e-5)) `shouldBe` [(Open, 0.0001 :| [])]
  where
    isBranch f = case f of Branch _ _ -> True; Overlap {} -> False
    isOverlap f = case f of Overlap {} -> True; Branch _ _ -> False
    isLine ps = case ps of
      [Plain (Straight _ _)] -> True
      _ -> False
    isWide gap (Mm w) = abs (w - gap) < 1e-9
    beside d p = Vec.shift (Vec.vec (d * 0.6) (d * 0.8)) p
    segmentOf p = case p of
      Plain s -> s
      _ -> error "not a segment"
    follows o =
      let list = NonEmpty.toList (fmap part (parts o))
          starts = map PathPart.start list
       in map PathPart.end list === drop 1 starts <> take 1 starts

-- | The parts of a ring of lines and arcs around (200·k, 0), each with an end at the next one.
ring :: Int -> Gen [PathPart]
ring k = do
  count <- choose (3, 9)
  radii <- vectorOf count (choose (20, 60))
  bulges <- vectorOf count (frequency [(1, pure 0), (1, choose (0.05, 0.2))])
  let corner i r =
        Vec.shift
          (Vec.polar (Mm r) (toRad (2 * pi * fromIntegral i / fromIntegral count)))
          (Vec.point (200 * fromIntegral k) 0)
      corners = zipWith corner [0 :: Int ..] radii
      side (p, q) b = Plain (if b == 0 then Straight p q else Segment.fromBulge p q b)
  pure (zipWith side (zip corners (drop 1 corners <> take 1 corners)) bulges)
  where
    toRad = Rad

-- | Entities of one part each.
entitiesOf :: [PathPart] -> [Entity]
entitiesOf ps = [Entity k "LINE" "" [] [] (Path Open (p :| [])) | (k, p) <- zip [1 ..] ps]

-- | The parts in a random order, each in a random direction, as entities.
mixed :: [PathPart] -> Gen [Entity]
mixed ps = do
  shuffled <- shuffle ps
  turned <- traverse (\p -> elements [p, PathPart.reversed p]) shuffled
  pure (entitiesOf turned)

cornersOf :: NonEmpty DrawnPart -> [(Double, Double)]
cornersOf = sort . map (coordinates . PathPart.start . part) . NonEmpty.toList

coordinates :: Point -> (Double, Double)
coordinates p = (rounded (Vec.x p), rounded (Vec.y p))
  where
    rounded v = fromIntegral (round (v * 1e6) :: Int) / 1e6
