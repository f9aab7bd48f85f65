-- | Random edits of the examples, with undo: the settled diagnostics are those of a fresh session.
--
-- After a few edits nearly every text has mistakes of form, and later passes find nothing more. So
-- every third edit is followed by the text of the example, as if its file was loaded again.
--
-- @PARTC_EDITS@ is the count of edits of each example.
module Lsp.RandomEditSpec (spec) where

import CaseCount (askedCount)
import Control.Monad (forM_)
import Data.Aeson (Value (..), object, (.=))
import Data.Char (isDigit)
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
        let talk = pause 0 (open addressOf 1 text (running (object [])))
         in conjoin (restoring (text, squiggles text) talk 2 edits)

-- | An edit: the share of the text before it, the count of characters that it removes, the text
-- that it inserts. @isAtDigit@ is true if it is moved to the next digit. @isUndone@ is true if the
-- next edit restores the text.
data RandomEdit = RandomEdit
  { share :: Double,
    isAtDigit :: Bool,
    removed :: Int,
    inserted :: Text,
    isUndone :: Bool
  }
  deriving stock (Show)

-- | An edit that changes a digit, inserts a piece of the text itself, or inserts a piece that is
-- likely to be wrong.
edit :: Text -> Gen RandomEdit
edit text = frequency [(1, digitEdit), (1, pieceEdit text)]

digitEdit :: Gen RandomEdit
digitEdit = do
  share <- choose (0, 1)
  inserted <- Text.singleton <$> choose ('0', '9')
  isUndone <- arbitrary
  pure RandomEdit {share, isAtDigit = True, removed = 1, inserted, isUndone}

pieceEdit :: Text -> Gen RandomEdit
pieceEdit text = do
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
  pure RandomEdit {share, isAtDigit = False, removed, inserted, isUndone}

-- | The comparisons of a conversation in which the example is open, with its text after every third
-- edit. The pair has this text and its diagnostics. @version@ is the next version of the document.
restoring :: (Text, [Squiggle]) -> Talk -> Int -> [RandomEdit] -> [Property]
restoring original@(text, expected) talk version edits = case splitAt 3 edits of
  ([], _) -> []
  (some, more) ->
    let (talk', found) = checked talk text version some
        restored = pause 400 (replace addressOf (version + 6) text talk')
     in found
          <> [latest restored === [expected]]
          <> restoring original restored (version + 7) more

-- | The conversation after some edits, and the comparison after each of them. In the conversation
-- @text@ is open. @version@ is the next version of the document.
checked :: Talk -> Text -> Int -> [RandomEdit] -> (Talk, [Property])
checked talk text version edits = case edits of
  [] -> (talk, [])
  e : more ->
    let from = beforePair text (place e text)
        to = beforePair text (min (Text.length text) (from + removed e))
        old = Text.take (to - from) (Text.drop from text)
        changed = Text.concat [Text.take from text, inserted e, Text.drop to text]
        talk' = applied talk version text (from, to) (inserted e)
        there = from + Text.length (inserted e)
        undone = applied talk' (version + 1) changed (from, there) old
     in (settled talk' changed :)
          <$> if isUndone e && isWhole changed from && isWhole changed there
            then (settled undone text :) <$> checked undone text (version + 2) more
            else checked talk' changed (version + 1) more
  where
    settled t now = latest t === [squiggles now]
    isWhole t at' = beforePair t at' == at'

-- | The diagnostics that were published last.
latest :: Talk -> [[Squiggle]]
latest talk = [found | (_, _, found) <- take 1 (reverse (published talk))]

-- | The offset of an edit in the present text.
place :: RandomEdit -> Text -> Int
place e text
  | isAtDigit e = at' + Text.length (Text.takeWhile (not . isDigit) (Text.drop at' text))
  | otherwise = at'
  where
    at' = round (share e * fromIntegral (Text.length text))

-- | The offset, or the one before it if it lies between CR and LF.
beforePair :: Text -> Int -> Int
beforePair text at'
  | at' > 0 && Text.take 2 (Text.drop (at' - 1) text) == "\r\n" = at' - 1
  | otherwise = at'

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
