module Preview.DrawingSpec
  ( spec,
  )
where

import Data.Aeson (Value)
import Data.Text (Text)
import Preview.Answer (Answer)
import Preview.Answer qualified as Answer
import Preview.Drawing qualified as Drawing
import Preview.Subject (Followed)
import Preview.Subject qualified as Subject
import Project.LoadedProgram qualified as LoadedProgram
import Test.Hspec

spec :: Spec
spec = describe "container" $ do
  it "has the contour of the flange, with the circles of the drawing" $ do
    answer <- drawn <$> Answer.followedFile "examples/flange.part"
    let segments = groupsOf 7 (Answer.reals "contour" answer)
        radii =
          [ sqrt ((x - a) ^ two + (y - b) ^ two)
            | [x, y, _, _, a, b, turn] <- segments,
              turn /= 0
          ]
    length segments `shouldBe` 18
    length [r | r <- radii, abs (r - 9) < 1e-9] `shouldBe` 3
    length [r | r <- radii, abs (r - 8) < 1e-9] `shouldBe` 6
    length [r | r <- radii, abs (r - 36) < 1e-9] `shouldBe` 3
  it "joins the moves: each begins where the one before ends" $ do
    answer <- drawn <$> Answer.followedFile "examples/plate.part"
    let moves = groupsOf 9 (Answer.reals "move" answer)
    [(m !! 2, m !! 3, m !! 8) | m <- init moves]
      `shouldBe` [(head m, m !! 1, m !! 7) | m <- tail moves]
  it "gives each move the tool that makes it" $ do
    answer <- drawn <$> Answer.followedFile "examples/cnc/cover.part"
    let tools = Answer.member "tools" answer :: [Value]
        used = [t | [_, t, _, _, _] <- groupsOf 5 (Answer.wholes "moveInfo" answer)]
    length tools `shouldSatisfy` (> 1)
    [t | t <- [0 .. length tools - 1], t `notElem` used] `shouldBe` []
  it "keeps the last picture while the text has mistakes, with the reports of the present text" $ do
    first <- Answer.followedFile "examples/flange.part"
    let wrong = changed "contour outline" first
        answer = drawn wrong
        again = drawn (changed "part ok" wrong)
    Answer.member "present" answer `shouldBe` False
    length (Answer.member "reports" answer :: [Value]) `shouldSatisfy` (> 0)
    Answer.reals "contour" answer `shouldBe` Answer.reals "contour" (drawn first)
    map (Answer.member "version") [drawn first, answer, again] `shouldBe` [1, 2, 3 :: Int]
    (Answer.member "name" answer :: Text) `shouldBe` "examples/flange.part"
  it "has nothing to draw before a text without mistakes" $ do
    let answer = drawn (changed "contour" (Subject.nothingYet "new.part" Nothing))
    Answer.member "drawn" answer `shouldBe` False
    Answer.member "present" answer `shouldBe` False
  where
    two = 2 :: Int
    changed text = Subject.following [] (LoadedProgram.fromText "examples/flange.part" text)

drawn :: Followed -> Answer
drawn = Answer.decode . Drawing.container False

groupsOf :: Int -> [a] -> [[a]]
groupsOf n list = case splitAt n list of
  ([], _) -> []
  (group, more) -> group : groupsOf n more
