-- | Laws of the chains along which a V-carving goes.
module Toolpath.CarvingChainSpec
  ( spec,
  )
where

import Base.Quantity (Mm (..))
import Data.List (nub, sort)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.MedialAxis (Branch, Disc (..), Stretch (..))
import Offset.MedialAxis qualified as MedialAxis
import Test.Hspec
import Test.Hspec.QuickCheck (prop)
import Test.QuickCheck
import Toolpath.CarvingChain qualified as CarvingChain

spec :: Spec
spec =
  prop
    "a branch is carved once, or there and back if it is short and ends freely (catches long \
    \branches that are carved back)"
    $ forAll graph $ \edges -> forAll (listOf node) $ \points -> forAll (choose (0, 10)) $ \most ->
      forAll (shuffle (map branch (edges <> [(p, p) | p <- points]))) $ \branches ->
        let found = CarvingChain.chains (Mm most) branches
            carved = Map.fromListWith (+) [(endsOf b, 1) | c <- found, b <- NonEmpty.toList c]
            alone = [(p, p) | p <- nub points, not (any (touches p) edges)]
            isFree (p, q) = any (\n -> length (filter (touches n) edges) == 1) [p, q]
            mayReturn e@(p, q) = e `elem` edges && isFree e && Vec.distance p q <= Mm most
         in counterexample (show found) $
              conjoin
                [ conjoin [property (isConnected c) | c <- found],
                  Map.keys carved === sort (edges <> alone),
                  conjoin
                    [ counterexample (show e) (count == 1 || count == 2 && mayReturn e)
                      | (e, count) <- Map.toList (carved :: Map.Map (Point, Point) Int)
                    ]
                ]
  where
    touches n (p, q) = n `elem` [p, q]
    isConnected c =
      and (zipWith (\a b -> MedialAxis.lastDisc a == MedialAxis.firstDisc b) chain (drop 1 chain))
      where
        chain = NonEmpty.toList c

-- | The centres at both ends of a branch, in order.
endsOf :: Branch -> (Point, Point)
endsOf b = ordered (discCentre (MedialAxis.firstDisc b)) (discCentre (MedialAxis.lastDisc b))

ordered :: Point -> Point -> (Point, Point)
ordered p q = (min p q, max p q)

-- | A straight branch of two stretches.
branch :: (Point, Point) -> Branch
branch (p, q) = Sloping (disc p) (disc m) :| [Sloping (disc m) (disc q)]
  where
    m = Vec.interpolate 0.5 p q
    disc c = Disc c (Mm 1)

-- | The edges of a graph: those of a tree, and a few more, also apart from it.
graph :: Gen [(Point, Point)]
graph = do
  nodes <- nub <$> (choose (2, 12) >>= \n -> vectorOf n node) `suchThat` ((> 1) . length . nub)
  tree <- sequence [(,) n <$> elements (take k nodes) | (k, n) <- zip [1 ..] (drop 1 nodes)]
  more <- listOf ((,) <$> oneof [node, elements nodes] <*> elements nodes)
  pure (nub [ordered p q | (p, q) <- tree <> take 2 more, p /= q])

node :: Gen Point
node = Vec.point <$> whole <*> whole
  where
    whole = fromIntegral <$> chooseInt (0, 10)
