-- | Laws of boolean operations on regions, and the comparison with GEOS. The variable
-- @PARTC_REGIONS@ sets the count of random cases.
module Offset.RegionBooleanSpec (spec) where

import CaseCount (askedCount)
import Data.Aeson (Value, encode, object, (.=))
import Data.ByteString.Lazy.Char8 qualified as ByteString
import Data.Either (lefts)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Generate.Operands (OperandFamily (..), Operands (..))
import Generate.Operands qualified as Generate
import Geometry.FlatPolyarc qualified as FlatPolyarc
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Offset.RegionBoolean (BooleanFault (..), BooleanOperation (..), ResultSegment)
import Offset.RegionBoolean qualified as RegionBoolean
import System.Exit (ExitCode (..))
import System.Process (readProcessWithExitCode)
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "boolean operations on regions" $ do
  count <- runIO (fromMaybe 2000 <$> askedCount "PARTC_REGIONS")
  let law f = withMaxSuccess count (forAll Generate.operands f)
  it "give union and intersection the areas of the operands together" $
    law $ \Operands {first = a, second = b} ->
      decided (two Union a b) $ \u -> decided (two Common a b) $ \i ->
        near (1e-12 * (areaOf a + areaOf b)) (areaOf u + areaOf i) (areaOf a + areaOf b)
  it "divide a region into what is left and what is common" $
    law $ \Operands {first = a, second = b} ->
      decided (two Difference a b) $ \d -> decided (two Common a b) $ \i ->
        near (1e-12 * (areaOf a + areaOf b)) (areaOf d + areaOf i) (areaOf a)
  it "do not depend on the order of the regions (catches a segment of the wrong operand)" $
    law $ \Operands {first = a, second = b} ->
      conjoin
        [ decided (two o a b) $ \ab -> decided (two o b a) $ \ba -> same ab ba
          | o <- [Union, Common]
        ]
  it "do not depend on how three regions are joined" $
    law $ \Operands {first = a, second = b, third = c} ->
      conjoin
        [ decided (two o a b >>= \ab -> two o ab c) $ \left ->
            decided (two o b c >>= two o a) $ \right ->
              decided (combined o [a, b, c]) $ \all' -> same left right .&&. same left all'
          | o <- [Union, Common]
        ]
  it "keep the law of De Morgan in a frame" $
    law $ \Operands {first = a, second = b} ->
      decided (two Union a b >>= two Difference frame) $ \outside ->
        decided
          (do x <- two Difference frame a; y <- two Difference frame b; two Common x y)
          (same outside)
  it "take away two regions as one takes away their union" $
    law $ \Operands {first = a, second = b, third = c} ->
      decided (combined Difference [a, b, c]) $ \both ->
        decided (two Union b c >>= two Difference a) (same both)
  it "have segments of the operands, and loops that close (catches an arc about another centre)" $
    law $ \Operands {first = a, second = b} ->
      either (const (property True)) (conjoin . map (closes (a <> b))) (combine Union [a, b])
  it "are all decided on a grid, and elsewhere but for one in 10,000" $ do
    cases <- generate (vectorOf count Generate.operands)
    let results = [(Generate.family c, two o (first c) (second c)) | c <- cases, o <- [minBound ..]]
        undecided family = length (lefts [r | (f, r) <- results, f == family])
    undecided OnGrid `shouldBe` 0
    (undecided WithArcs + undecided WithNoise) `shouldSatisfy` (<= 1 + count `div` 10000)
  it "agree with GEOS in area within the error of its chords (pending without shapely)" $ do
    (found, _, _) <- readProcessWithExitCode "/usr/bin/python3" ["-c", "import shapely"] ""
    if found /= ExitSuccess
      then pendingWith "the package python3-shapely is not installed"
      else do
        cases <- generate (vectorOf count Generate.operands)
        (code, out, complaint) <-
          readProcessWithExitCode
            "/usr/bin/python3"
            ["test/geos/areas.py"]
            (unlines (map (ByteString.unpack . encode . caseValue) cases))
        (code, out, complaint) `shouldBe` (ExitSuccess, "", "")
  where
    frame = [polyarc [(-50, -50), (50, -50), (50, 50), (-50, 50)]]
    polyarc ps =
      Polyarc
        Closed
        (NonEmpty.fromList (FlatPolyarc.segments (flat [(x, y, 0) | (x, y) <- ps])))
    flat = FlatPolyarc.fromVertices Closed

combine :: BooleanOperation -> [[Polyarc]] -> Either BooleanFault [NonEmpty ResultSegment]
combine = RegionBoolean.combine

-- | A result as a region.
combined :: BooleanOperation -> [[Polyarc]] -> Either BooleanFault [Polyarc]
combined operation regions =
  map (Polyarc Closed . fmap RegionBoolean.segment) <$> combine operation regions

two :: BooleanOperation -> [Polyarc] -> [Polyarc] -> Either BooleanFault [Polyarc]
two operation a b = combined operation [a, b]

areaOf :: [Polyarc] -> Double
areaOf = sum . map (FlatPolyarc.area . fst . FlatPolyarc.fromPolyarc)

-- | Holds if there is no result: another test counts these cases.
decided :: Either BooleanFault a -> (a -> Property) -> Property
decided = flip (either (const (property True)))

-- | Holds if two areas differ by at most @most@ mm².
near :: Double -> Double -> Double -> Property
near most x y = counterexample (show (x, y, x - y)) (abs (x - y) <= most)

-- | Holds if two regions are the same, but for slivers.
same :: [Polyarc] -> [Polyarc] -> Property
same a b =
  conjoin
    [ decided (two Difference x y) $ \rest ->
        counterexample (show (areaOf x, areaOf y, areaOf rest)) (areaOf rest <= 1e-8)
      | (x, y) <- [(a, b), (b, a)]
    ]

-- | Holds if each segment begins where the one before ends, and is a part of its source.
closes :: [Polyarc] -> NonEmpty ResultSegment -> Property
closes operands loop =
  conjoin (zipWith joins segments (drop 1 segments <> take 1 segments))
    .&&. conjoin (map isPart (NonEmpty.toList loop))
  where
    segments = map RegionBoolean.segment (NonEmpty.toList loop)
    joins a b = Segment.end a === Segment.start b
    sources = concatMap (NonEmpty.toList . Polyarc.segments) operands
    isPart r =
      let s = RegionBoolean.segment r
          whole = sources !! RegionBoolean.source r
          p = Segment.at 0.5 s
       in -- The centre of a flat arc is too distant to measure from it.
          counterexample
            (show (r, whole))
            (isFlat whole || nearestOn whole p < 1e-9)
    isFlat s = abs (Segment.bulge s) < 1e-5 && Segment.bulge s /= 0
    nearestOn whole p =
      let t = Segment.fraction whole p
          q = Segment.at t whole
       in Vec.norm (Vec.to p q)

-- | A case with the areas of its results, for the comparison.
caseValue :: Operands -> Value
caseValue c =
  object
    [ "regions" .= map (map vertices) [first c, second c],
      "areas" .= [either (const (-1)) areaOf (two o (first c) (second c)) | o <- [minBound ..]]
    ]
  where
    vertices p = FlatPolyarc.vertices (fst (FlatPolyarc.fromPolyarc p))
