-- | Laws of closed outlines in the plane: their crossings and their depths.
module Drawing.NestingSpec
  ( spec,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List.NonEmpty (NonEmpty (..))
import Drawing.Drawing (Ellipse (..), Entity (..), PathPart (..), Shape (..))
import Drawing.Nesting (ClosedBoundary, Crossing (..))
import Drawing.Nesting qualified as Nesting
import Drawing.Outline qualified as Outline
import Drawing.OutlineTolerance qualified as Tolerance
import Geometry.Carrier (Circle (Circle))
import Geometry.Polyarc (Ends (Closed))
import Geometry.Segment (Segment (Straight))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  it "the depth of an outline is the count of those around it (catches boxes for outlines)" $
    property $
      forAll (vectorOf 6 (elements [0, 1])) $ \places ->
        let -- Circles about two centres, the larger ones around the smaller ones, and small circles
            -- in corners of the boxes of the larger ones.
            circles =
              [ (place :: Int, Entity k "CIRCLE" "" [] [] (FullCircle ring))
                | (k, place) <- zip [1 ..] places,
                  let ring = Circle (centre place) (Mm (5 * fromIntegral k))
              ]
            inCorner =
              [ Entity 7 "CIRCLE" "" [] [] (FullCircle (Circle (Vec.point (x + 23) 23) (Mm 1)))
                | x <- [0, 100]
              ]
            centre place = Vec.point (fromIntegral place * 100) 0
            outer k p = length [() | (q, _) <- drop k circles, q == p]
            expected = [outer k p | (k, (p, _)) <- zip [1 ..] circles] <> [0, 0]
            entities = map snd circles <> inCorner
         in Nesting.depths (boundaries entities) === expected
  it
    "closed outlines that cross one another or themselves are found, and no others (catches curves \
    \that count as polygons)"
    $ property $
      forAll ((,,) <$> size <*> size <*> size) $ \(r, s, b) ->
        forAll (elements [0, 8, 30, 100]) $ \apart ->
          conjoin
            [ counterexample "circles" $
                found [circle 1 0 r, circle 2 apart s]
                  === [(1, 2) | abs (r - s) <= apart, apart <= r + s, (apart, r) /= (0, s)],
              counterexample "an ellipse and a circle" $
                found [ellipse 1 (b + 10) b, circle 2 0 r] === [(1, 2) | b <= r, r <= b + 10],
              counterexample "a polygon that crosses itself" $
                found
                  [ polygon 1 [(0, 0), (s, r), (s, 0), (0, r)],
                    polygon 2 [(0, -1), (s, -1), (s, -1 - r)]
                  ]
                  === [(1, 1)]
            ]
  where
    size = choose (1, 60)
    found es = [(line a, line b) | Crossing a b _ <- Nesting.crossings (boundaries es)]
    ellipse k a b = entity k (FullEllipse (Ellipse (Vec.point 0 0) (Mm a) (Mm b) (Rad 0.7)))
    circle k x r = entity k (FullCircle (Circle (Vec.point x 0) (Mm r)))

-- | The boundaries of closed entities.
boundaries :: [Entity] -> [ClosedBoundary]
boundaries = map Nesting.boundary . Outline.outlines . Outline.joined Tolerance.joining

-- | The entity of a shape, with its line.
entity :: Int -> Shape -> Entity
entity k = Entity k "PATH" "" [] []

-- | A closed path of lines through points.
polygon :: Int -> [(Double, Double)] -> Entity
polygon k corners = entity k (Path Closed (sides (map (uncurry Vec.point) corners)))

-- | The lines that join points to a closed path.
sides :: [Point] -> NonEmpty PathPart
sides ps = case zipWith Straight ps (drop 1 ps <> take 1 ps) of
  s : more -> fmap Plain (s :| more)
  [] -> error "no points"
