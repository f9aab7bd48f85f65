module Gcode.CommentTextSpec (spec) where

import Data.Char (isAscii, isPrint)
import Data.Text qualified as Text
import Gcode.CommentText qualified as CommentText
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "texts of comments" $ do
  it "have Russian letters in Latin letters" $ do
    CommentText.plain "Рычаг, подъём 15" `shouldBe` "Rychag, podieem 15"
    CommentText.plain "Щека Юстировочная" `shouldBe` "Shcheka Iustirovochnaia"
    CommentText.plain "Ось" `shouldBe` "Os"
  it "show that other letters are missing" $
    CommentText.plain "Gehäuse\t12 × 5\r" `shouldBe` "Geh_use 12 _ 5 "
  it "are printable ASCII" $
    forAll (Text.pack <$> arbitrary) $ \text ->
      let written = CommentText.plain text
       in Text.all (\c -> isAscii c && isPrint c) written
  it "keep printable ASCII" $
    forAll (Text.pack <$> listOf (choose (' ', '~'))) $ \text ->
      CommentText.plain text === text
