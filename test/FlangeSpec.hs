-- | The flange of the Ural paper: its nodes, its frames, its proof.
module FlangeSpec (spec) where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), Seconds (..))
import Compile (Analysis (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text qualified as Text
import Data.Text.IO qualified as Text
import Data.Text.Read qualified as Text (double)
import Flange qualified
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Machines (lkp01f)
import Tape.Tape qualified as Tape
import Test.Hspec
import Toolpath.Toolpath (Block (..), Move (segment))
import Toolpath.Toolpath qualified as Toolpath
import Verify.Proof qualified as Proof

spec :: Spec
spec = do
  it "all 18 nodes of the equidistant agree with the drawing to 0.001 mm" $ do
    length nodes `shouldBe` 18
    [(e, d) | e <- Flange.exactNodes, let d = minimum (map (apart e) nodes), d > 0.001]
      `shouldBe` []
  it "the nodes are in the paper's order, beginning with the paper's last node" $
    [e | (e, n) <- zip Flange.exactNodes (drop 1 nodes <> take 1 nodes), apart e n > 0.001]
      `shouldBe` []
  it "its tape is proven, within tolerance and one pulse" $ do
    fmap Proof.isProven Flange.proof `shouldBe` Just True
  it "its page shows the computed nodes, and the number of frames and the length of the tape" $ do
    page <- Text.readFile "docs/flange.md"
    let rows =
          [ (ours, x, y)
            | [_, ours, _, _, _, _, x, y, _] <- map cells (Text.lines page),
              Just _ <- [number ours]
          ]
    let wrong =
          [ (n, px, py)
            | (n, px, py) <- rows,
              Just k <- [number n],
              (x, y) <- take 1 (drop (round k) nodes),
              (px, py) /= (Decimal.fixed 3 x, Decimal.fixed 3 y)
          ]
    wrong `shouldBe` []
    length rows `shouldBe` 18
    Text.lines page `shouldContain` ["| frames | " <> Decimal.whole (length Flange.frames) <> " |"]
    page
      `shouldSatisfy` Text.isInfixOf
        (maybe "?" (Decimal.fixed 2) (Tape.metres lkp01f Flange.tape) <> " m")
  -- 2322 rows at 300 rows a minute: 7.74 min = 464.4 s.
  it "its tape takes 464.4 s to punch" $ do
    Tape.rowCount Flange.tape `shouldBe` 2322
    fmap (\(Seconds t) -> Decimal.fixed 6 t) (Tape.punchingTime lkp01f Flange.tape)
      `shouldBe` Just "464.400000"
  it "README.md shows the program of examples/" $ do
    page <- Text.readFile "README.md"
    page `shouldSatisfy` Text.isInfixOf (Text.strip (snd (Text.breakOn "part flange" Flange.text)))
  where
    cells line = map Text.strip (drop 1 (init (Text.splitOn "|" line)))
    number text = either (const Nothing) (Just . fst) (Text.double text)
    nodes =
      [ (Vec.x p, Vec.y p)
        | Cutting {cut} <- Toolpath.blocks (path Flange.analysis),
          m <- NonEmpty.toList cut,
          let p = Segment.start (segment m)
      ]
    apart (a, b) (c, d) = let Mm l = Vec.distance (Vec.point a b) (Vec.point c d) in l
