-- | Random edits of the examples, with undo: the settled diagnostics are those of a fresh session.
--
-- @PARTC_EDITS@ is the count of edits of each example.
module Lsp.RandomEditSpec (spec) where

import CaseCount (askedCount)
import Control.Monad (forM_)
import Data.Aeson (Value (..), object, (.=))
import Data.List (sort)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Files (filesBelow, readText)
import Lsp.Talk
import System.FilePath (takeExtension)
import Test.Hspec
import Test.Hspec.QuickCheck (modifyMaxSuccess, prop)
import Test.QuickCheck

spec :: Spec
spec = do
  count <- runIO (fromMaybe 4 <$> askedCount "PARTC_EDITS")
  examples <- runIO (sort . filter ((== ".part") . takeExtension) <$> filesBelow "examples")
  describe "random edits with undo" . modifyMaxSuccess (const 1) . forM_ examples $ \file -> do
    text <- runIO (readText file)
    prop ("of " <> file <> " keep the diagnostics those of the text") $
      forAll (vectorOf count (edit text)) $ \edits ->
        conjoin (checked (pause 0 (open addressOf 1 text (running (object [])))) text 2 edits)

-- | An edit: the share of the text before it, the count of characters that it removes, the text
-- that it inserts. @isUndone@ is true if the next edit restores the text.
data RandomEdit = RandomEdit
  { share :: Double,
    removed :: Int,
    inserted :: Text,
    isUndone :: Bool
  }
  deriving stock (Show)

-- | An edit that inserts a piece of the text itself, or a piece that is likely to be wrong.
edit :: Text -> Gen RandomEdit
edit text = do
  share <- choose (0, 1)
  removed <- frequency [(2, pure 0), (2, choose (1, 4)), (1, choose (5, 80))]
  from <- choose (0, Text.length text)
  size <- choose (0, 60)
  inserted <-
    frequency
      [ (2, elements ["", "1", "ж", "🙂", "\n", "(", "}", " mm", "\"", "-- ", "near (0, 0)"]),
        (1, pure (Text.take size (Text.drop from text)))
      ]
  isUndone <- arbitrary
  pure RandomEdit {share, removed, inserted, isUndone}

-- | The comparison after each edit of a conversation in which @text@ is open. @version@ is the next
-- version of the document.
checked :: Talk -> Text -> Int -> [RandomEdit] -> [Property]
checked talk text version edits = case edits of
  [] -> []
  e : more ->
    let from = beforePair text (round (share e * fromIntegral (Text.length text)))
        to = beforePair text (min (Text.length text) (from + removed e))
        old = Text.take (to - from) (Text.drop from text)
        changed = Text.concat [Text.take from text, inserted e, Text.drop to text]
        talk' = applied talk version text (from, to) (inserted e)
        there = from + Text.length (inserted e)
        undone = applied talk' (version + 1) changed (from, there) old
     in settled talk' changed :
        if isUndone e && isWhole changed from && isWhole changed there
          then settled undone text : checked undone text (version + 2) more
          else checked talk' changed (version + 1) more
  where
    settled t now = map snd' (take 1 (reverse (published t))) === [squiggles now]
    snd' (_, _, found) = found
    isWhole t place = beforePair t place == place

-- | The offset, or the one before it if it lies between CR and LF.
beforePair :: Text -> Int -> Int
beforePair text place
  | place > 0 && Text.take 2 (Text.drop (place - 1) text) == "\r\n" = place - 1
  | otherwise = place

-- | Replaces a part of an open text, given by two offsets.
applied :: Talk -> Int -> Text -> (Int, Int) -> Text -> Talk
applied talk version text (from, to) new =
  pause 400 $
    change
      addressOf
      version
      [ object
          [ "range"
              .= object
                ["start" .= at (positionIn text from), "end" .= at (positionIn text to)],
            "text" .= String new
          ]
      ]
      talk
