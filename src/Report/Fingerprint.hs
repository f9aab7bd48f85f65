-- | Fingerprints of lines, by which a code scanner recognises a result when the lines above it have
-- changed.
--
-- They are those that GitHub computes for results without fingerprints (@primaryLocationLineHash@,
-- <https://github.com/github/codeql-action/blob/main/src/fingerprints.ts>).
module Report.Fingerprint
  ( ofLines,
  )
where

import Base.Decimal qualified as Decimal
import Data.Char (ord)
import Data.List (foldl', mapAccumL)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Word (Word64)
import Numeric (showHex)

-- | The fingerprint of each line of a text, which is given as its lines without their line ends. It
-- is a hash of the hundred characters from the start of the line, which may reach into the next
-- lines, and then a colon and the number of the line among the lines with the same hash, from 1.
-- Spaces and tabs do not count.
ofLines :: [Text] -> [Text]
ofLines = snd . mapAccumL numbered Map.empty . map hash . continued
  where
    hash = foldl' (\h unit -> 37 * h + unit) 0 . take window
    numbered :: Map Word64 Int -> Word64 -> (Map Word64 Int, Text)
    numbered counts h =
      let count = Map.findWithDefault 0 h counts + 1
       in (Map.insert h count counts, Text.pack (showHex h "") <> ":" <> Decimal.whole count)

-- | The code units from the start of each line to the end of the text. Each line end is a line
-- feed. Zeros follow the mark of the end.
continued :: [Text] -> [[Word64]]
continued = foldr before []
  where
    before line following =
      (significant (Text.unpack line) <> continuation following) : following
    continuation following = case following of
      [] -> endOfText : replicate window 0
      next : _ -> lineFeed : next
    lineFeed = 10
    endOfText = 65535

-- | The count of characters that a hash covers.
window :: Int
window = 100

-- | The UTF-16 code units of a line without spaces and tabs.
significant :: String -> [Word64]
significant = concatMap units . filter (`notElem` [' ', '\t'])
  where
    units c
      | ord c < 0x10000 = [fromIntegral (ord c)]
      | otherwise =
        let beyond = ord c - 0x10000
         in [ fromIntegral (0xD800 + beyond `div` 0x400),
              fromIntegral (0xDC00 + beyond `mod` 0x400)
            ]
