module Preview.ContainerSpec
  ( spec,
  )
where

import Data.Aeson ((.=))
import Data.ByteString qualified as Strict
import Data.ByteString.Lazy qualified as ByteString
import Data.Text qualified as Text
import Preview.Answer qualified as Answer
import Preview.Container (Numbers (..))
import Preview.Container qualified as Container
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "encode" $ do
  it "writes arrays that the page reads, whatever the lengths before them" $
    property $ \title numbers whole octets ->
      let answer =
            Answer.decode $
              Container.encode
                ["title" .= Text.pack title]
                [ ("octets", Octets (Strict.pack octets)),
                  ("wholes", Wholes (map fromIntegral (whole :: [Int]))),
                  ("reals", Reals numbers)
                ]
       in (Answer.member "title" answer, Answer.wholes "wholes" answer, Answer.reals "reals" answer)
            === (Text.pack (filter (/= '\xD800') title), whole, numbers)
  it "begins every array at a multiple of 8 bytes" $
    property $ \octets title ->
      let bytes =
            Container.encode
              ["title" .= Text.pack title]
              [("octets", Octets (Strict.pack octets)), ("reals", Reals [1.5])]
       in ByteString.length bytes `mod` 8 === 0
