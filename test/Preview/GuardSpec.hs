module Preview.GuardSpec
  ( spec,
  )
where

import Preview.Guard (Asked (..), Door (..), Rejection (..), Resource (..))
import Preview.Guard qualified as Guard
import Test.Hspec

spec :: Spec
spec = describe "judge" $ do
  it "accepts the page, its files and its questions" $ do
    judge own {path = [secret]} `shouldBe` Right (PageFile "")
    judge own {path = [secret, "main.js"]} `shouldBe` Right (PageFile "main.js")
    judge own {path = [secret, "events"]} `shouldBe` Right Events
    judge own {path = [secret, "run"], query = [("version", Just "1"), ("machine", Just "n55")]}
      `shouldBe` Right (Run "n55")
    judge
      own
        { path = [secret, "rows"],
          query = [("machine", Just "n55"), ("from", Just "3"), ("to", Just "9")]
        }
      `shouldBe` Right (RowsOf "n55" 3 9)
  it "accepts localhost and the page's own origin" $ do
    judge own {host = Just "localhost:8123"} `shouldBe` Right Drawing
    judge own {origin = Just "http://127.0.0.1:8123", fetchSite = Just "same-origin"}
      `shouldBe` Right Drawing
  it "refuses a wrong token, also one that begins rightly" $ do
    judge own {path = ["secre0", "drawing"]} `shouldBe` Left NotFound
    judge own {path = ["secret0", "drawing"]} `shouldBe` Left NotFound
    judge own {path = ["drawing"]} `shouldBe` Left NotFound
    judge own {path = []} `shouldBe` Left NotFound
  it "refuses another host, another port and no host" $ do
    judge own {host = Just "evil.example:8123"} `shouldBe` Left WrongHost
    judge own {host = Just "127.0.0.1:80"} `shouldBe` Left WrongHost
    judge own {host = Just "127.0.0.1"} `shouldBe` Left WrongHost
    judge own {host = Nothing} `shouldBe` Left WrongHost
  it "refuses other origins and other sites" $ do
    judge own {origin = Just "http://evil.example"} `shouldBe` Left WrongOrigin
    judge own {origin = Just "null"} `shouldBe` Left WrongOrigin
    judge own {origin = Just "https://127.0.0.1:8123"} `shouldBe` Left WrongOrigin
    judge own {fetchSite = Just "cross-site"} `shouldBe` Left WrongOrigin
    judge own {fetchSite = Just "same-site"} `shouldBe` Left WrongOrigin
  it "refuses methods that ask for nothing here" $ do
    judge own {method = "DELETE"} `shouldBe` Left WrongMethod
    judge own {method = "OPTIONS"} `shouldBe` Left WrongMethod
    judge own {path = [secret, "show"]} `shouldBe` Left WrongMethod
    judge own {method = "POST"} `shouldBe` Left NotFound
  it "refuses a large body, and one of unknown length" $ do
    let shown n = judge own {method = "POST", path = [secret, "show"], bodyLength = n}
    shown (Just 60) `shouldBe` Right ShowPlace
    shown (Just 4097) `shouldBe` Left TooLarge
    shown Nothing `shouldBe` Left TooLarge
  it "refuses questions without their facts" $ do
    judge own {path = [secret, "run"]} `shouldBe` Left BadQuery
    judge own {path = [secret, "run"], query = [("machine", Nothing)]} `shouldBe` Left BadQuery
    judge own {path = [secret, "run"], query = [("machine", Just "\xFF")]} `shouldBe` Left BadQuery
    judge
      own
        { path = [secret, "rows"],
          query = [("machine", Just "n55"), ("from", Just "x"), ("to", Just "9")]
        }
      `shouldBe` Left BadQuery
  where
    judge = Guard.judge Door {port = 8123, token = secret}
    secret = "secret"
    own =
      Asked
        { method = "GET",
          path = [secret, "drawing"],
          query = [],
          host = Just "127.0.0.1:8123",
          origin = Nothing,
          fetchSite = Nothing,
          bodyLength = Just 0
        }
