-- | Descriptions of what is at the cursor.
module Query.DescriptionSpec (spec) where

import Data.Maybe (isJust)
import Data.Text (Text)
import Data.Text qualified as Text
import Query.Description (Description (..))
import Query.Description qualified as Description
import Query.Drawing qualified as Drawing
import Query.Manual qualified as Manual
import Query.Marked (header, marked)
import Test.Hspec

spec :: Spec
spec = do
  it "measures a contour" $
    (facts <$> at' (Text.replace "contour box" "contour ^box" milled))
      `shouldBe` Just
        [ ("length", "113.1327 mm"),
          ("area", "786.27 mm²"),
          ("box", "40 × 20 mm, from (0, 0) to (40, 20)"),
          ("tightest radius inside", "4 mm"),
          ("largest cutter inside", "diameter 8 mm"),
          ("cutter outside", "any")
        ]
  it "measures a fillet and finds the largest radius" $
    (facts <$> at' (Text.replace "(0, 0), (40, 0)) fillet" "(0, 0), (40, 0)) ^fillet" milled))
      `shouldBe` Just
        [ ("from", "(36, 0)"),
          ("to", "(40, 4)"),
          ("length", "6.2832 mm"),
          ("centre", "(36, 4)"),
          ("radius", "4 mm"),
          ("angle", "90 deg"),
          ("largest radius here", "16 mm")
        ]
  it "counts the passes, the time and the frames of a machining statement" $ do
    let found = at' (Text.replace "mill box" "^mill box" milled)
    fmap (map fst . facts) found `shouldBe` Just ["passes", "length", "time", "frames"]
    (found >>= lookup "passes" . facts) `shouldBe` Just "1"
  it "shows the range and the pulse of a machine" $
    (take 2 . facts <$> at' "part p\nmachine lkp-^01f\n")
      `shouldBe` Just [("pulse", "0.02 mm"), ("feeds", "15 to 240 mm/min")]
  it "shows all values of a name in a repetition" $ do
    (facts <$> at' "part p\nfor k in 1..3 {\n  let ^a = 2 * k\n}\n")
      `shouldBe` Just [("values", "2, 4, 6 (3)")]
    (facts <$> at' "part p\nfor ^k in 1..3 {\n}\n") `shouldBe` Just [("values", "1, 2, 3 (3)")]
  it "shows the value of a name" $
    (values <$> at' "part p\nlet ^a = 41 mm\n") `shouldBe` Just ["41 mm"]
  it "explains keywords, settings, units and functions" $ do
    explained "part p\n^feed 60 mm/min\n" `shouldSatisfy` isJust
    explained "part p\nmill a outside {\n  ^depth 4\n}\n" `shouldSatisfy` isJust
    explained "part p\nfeed 60 mm^/min\n"
      `shouldBe` Just
        "Is the millimetre per minute; without units in, a feed without a unit is in mm/min."
    explained "part p\nlet a = ^sqrt(4)\n" `shouldBe` Just "Gives the square root."
  it "has nothing to say on a number, a sign and a new name" $
    map at' ["part p\nlet a = 4^1\n", "part p\nlet a ^= 4\n", "part p\n^\n"]
      `shouldBe` [Nothing, Nothing, Nothing]
  it "draws the part with the contour at the cursor" $ do
    let (now, at) = marked (Text.replace "mill box" "mill ^box" milled)
        svg = Drawing.drawing now Nothing at
    fmap (Text.isInfixOf "emphasis") svg `shouldBe` Just True
    fmap (Text.count "#d03030") svg `shouldBe` Just 8

-- | A program with a contour that is milled.
milled :: Text
milled =
  header
    <> "contour box closed {\n  line((0, 0), (40, 0)) fillet -4\n"
    <> "  line((40, 0), (40, 20)) fillet -4\n"
    <> "  line((40, 20), (0, 20)) fillet -4\n  line((0, 20), (0, 0)) fillet -4\n}\n"
    <> "mill box outside {\n  approach (20, -9)\n  retract (20, -9)\n}\n"

at' :: Text -> Maybe Description
at' text = let (now, offset) = marked text in Description.description now Nothing offset

explained :: Text -> Maybe Text
explained text = fmap Manual.sentence . entry =<< at' text
