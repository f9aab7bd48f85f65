-- | The rib of examples/: the distances of its edge from the skin, and its page in docs/.
module RibSpec (spec) where

import Base.Quantity (LengthUnit (..))
import Base.Result qualified as Result
import Cli.FrameTable qualified as FrameTable
import Cli.NodeTable qualified as NodeTable
import Compile (Analysis (..), Punched (..))
import Compile qualified
import Data.Text (Text)
import Data.Text qualified as Text
import Files (readText)
import Machines (lkp01f)
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report qualified as Report
import Test.Hspec

spec :: Spec
spec = do
  it "the edge has the distance that each of its ciphers asks for" $ do
    program' <- readText file
    map Report.title (Result.errors (Compile.analyse [] (loaded (program' <> distances))))
      `shouldBe` []
  it "its page shows the program of examples/" $ do
    page <- readText "docs/rib.md"
    program' <- readText file
    page `shouldSatisfy` Text.isInfixOf (snd (Text.breakOn "part rib" program'))
  it "its page shows the nodes of the last pass" $ do
    page <- readText "docs/rib.md"
    (analysis, punched) <- compiled
    let shown =
          takeWhile
            (/= "    …")
            (dropWhile (not . Text.isPrefixOf "section  kind") (Text.lines page))
        report = NodeTable.nodes Nothing (Just (lkp01f, punched)) analysis
        -- The table begins after the heading of the last contour and an empty line.
        printed = drop 2 (Text.lines (snd (Text.breakOnEnd "Contour outside_edge" report)))
    length shown `shouldBe` 9
    take 9 printed `shouldBe` shown
  it "its page counts the chords of the upper edge, the slow one at its end included" $ do
    page <- readText "docs/rib.md"
    program' <- readText file
    (_, punched) <- compiled
    let edgeLine =
          showText
            (1 + length (takeWhile (not . Text.isPrefixOf "  top slow") (Text.lines program')))
        rows =
          map
            Text.words
            ( Text.lines
                ( FrameTable.frames
                    Millimetres
                    lkp01f
                    (LoadedProgram.source (loaded program'))
                    (program punched)
                )
            )
        onEdge =
          [(n, feed) | n : "cut" : rest@(_ : _ : _ : _ : feed : _) <- rows, last rest == edgeLine]
        -- The frames of the last pass up to the slow one; their numbers are consecutive.
        counted = case reverse [n | (n, "15") <- onEdge] of
          end : _ ->
            length
              ( takeWhile
                  (`elem` map fst onEdge)
                  [showText k | k <- [number end, number end - 1 ..]]
              )
          [] -> 0
    page `shouldSatisfy` Text.isInfixOf (showText counted <> " chords")
  where
    file = "examples/rib.part"
    loaded = LoadedProgram.fromText (Text.pack file) :: Text -> LoadedProgram
    compiled = do
      text <- readText file
      maybe (fail "the rib has errors") pure . Result.ifSound $
        Compile.analyse [] (loaded text) `Result.thenSound` \a ->
          Compile.punch lkp01f (path a) `Result.thenSound` \p -> pure (a, p)
    showText = Text.pack . show :: Int -> Text
    number = Text.foldl' (\n c -> 10 * n + fromEnum c - fromEnum '0') 0

-- | Assertions on the dimensions of the drawing: for the upper edge at its row x = 240 and under
-- the strap, and for the lower edge in the middle of the pad.
distances :: Text
distances =
  Text.unlines
    [ "",
      "piece under_skin = spline(upper) cipher 2(1.6, mu) right",
      "piece set_back   = under_skin cipher 4(mu, H) right",
      "piece under_low  = spline(lower) cipher 2(1.2, mu) right",
      "let at_row       = foot_of((240, 25.16), under_skin)",
      "assert distance((240, 25.16), at_row) = 1.6 / cos(2.1 deg) within 0.0001",
      "assert distance(at_row, set_back) = 17.2 * tan(2.1 deg) within 0.001",
      "assert distance(start_of(set_back), skinned) = 0 within 0.0001",
      "assert distance(end_of(set_back), skinned) = 0.8 within 0.0001",
      "assert distance(point_at_x(skinned, 145), top) = 1.2 within 0.0001",
      "assert distance(foot_of((150, -15.89), under_low), bottom) = 1 within 0.001"
    ]
