-- | The words that the language keeps for itself.
module Surface.Keyword
  ( statements,
    beginsItem,
    isReserved,
  )
where

import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Surface.Token (unitName)

-- | The words that begin a statement.
statements :: [Text]
statements =
  ["part", "machine", "tool", "feed", "tolerance", "from", "let", "contour", "mill", "rapid", "move"]

-- | Whether a word begins an item of a block.
beginsItem :: Text -> Bool
beginsItem word = word `elem` ["for", "cw", "ccw", "approach", "retract"]

-- | Whether a word can not be the name of a value.
isReserved :: Text -> Bool
isReserved word = Set.member word reserved

reserved :: Set Text
reserved =
  Set.fromList
    ( statements
        <> ["open", "closed", "for", "cw", "ccw"]
        <> ["meet", "near", "smooth", "tangent", "fillet", "chamfer"]
        <> ["outside", "inside", "left", "right", "on", "approach", "retract", "diameter"]
        <> map unitName [minBound .. maxBound]
    )
