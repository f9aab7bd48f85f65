-- | The flange of the Ural paper: its nodes, its frames, its proof.
module FlangeSpec (spec) where

import Base.Quantity (Mm (..))
import Base.Result qualified as Result
import Compile (Analysis (..))
import Compile qualified
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text.IO qualified as Text
import Flange qualified
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Machine.Lkp01f (lkp01f)
import Path.Path (Block (..), Move (segment))
import Path.Path qualified as Path
import Test.Hspec
import Verify.Proof qualified as Proof

spec :: Spec
spec = do
  it "all 18 nodes of the equidistant agree with the drawing to 0.001 mm" $ do
    length nodes `shouldBe` 18
    [(e, d) | e <- Flange.exactNodes, let d = minimum (map (apart e) nodes), d > 0.001] `shouldBe` []
  it "the nodes come in the paper's order; node 0 of the paper is the second from the entry" $
    [e | (e, n) <- zip Flange.exactNodes (drop 1 nodes <> take 1 nodes), apart e n > 0.001] `shouldBe` []
  it "its tape is proven, within tolerance and one pulse" $ do
    let proof = Compile.prove lkp01f (path Flange.analysis) Flange.program Flange.frames
    Result.errors proof `shouldBe` []
    fmap Proof.isProven (Result.output proof) `shouldBe` Just True
  it "its page shows the table as printed, corrected and computed" $ do
    page <- Text.readFile "docs/flange.md"
    page `shouldSatisfy` (/= "")
  where
    nodes = [(Vec.x p, Vec.y p) | Cutting {cut} <- Path.blocks (path Flange.analysis), m <- NonEmpty.toList cut, let p = Segment.start (segment m)]
    apart (a, b) (c, d) = let Mm l = Vec.distance (Vec.point a b) (Vec.point c d) in l
