-- | The words that the language keeps for itself.
--
-- Words that only ever stand where no name can (@depth@, @step@, @by@ …) are not among them.
module Surface.Keyword
  ( statements,
    softStatements,
    blocks,
    beginsItem,
    settingsOf,
    isReserved,
    reservedWords,
  )
where

import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Surface.Token (unitName)

-- | The words that begin a statement and nothing else.
statements :: [Text]
statements =
  ["part", "machine", "import", "tool", "feed", "tolerance", "clearance", "from"]
    <> ["let", "param", "table", "curve", "piece", "contour", "assert"]
    <> ["mill", "turn", "drill", "rapid", "move", "change", "spindle", "coolant", "aux", "with"]

-- | The words that begin a statement where one can begin, and are names elsewhere: @contour pocket
-- closed@.
softStatements :: [Text]
softStatements = ["pocket"]

-- | The words that begin a statement with a block, and an item of a contour as well.
blocks :: [Text]
blocks = ["for", "if"]

-- | Whether a word begins an item of a block.
beginsItem :: Text -> Bool
beginsItem word = word `elem` (["for", "if", "cw", "ccw", "approach", "retract"] <> settings)
  where
    settings =
      [ "depth",
        "lead",
        "allowance",
        "corners",
        "climb",
        "conventional",
        "compensation",
        "start",
        "plunge",
        "peck",
        "islands",
        "rest"
      ]

-- | How the settings begin that may stand in the block of a statement.
settingsOf :: Text -> [Text]
settingsOf statement = case statement of
  "mill" ->
    ways
      <> ["start near", "climb", "conventional"]
      <> passes
      <> ["depth", "plunge", "compensation", "rest"]
  "pocket" ->
    [ "islands",
      "approach",
      "retract",
      "climb",
      "conventional",
      "allowance",
      "depth",
      "plunge",
      "rest"
    ]
  "turn" -> ways <> passes
  _ -> ["peck", "plunge"]
  where
    ways = ["approach", "retract", "lead in", "lead out"]
    passes = ["allowance", "corners"]

-- | Whether a word can not be the name of a value.
isReserved :: Text -> Bool
isReserved word = Set.member word reserved

-- | The words that can not be names, in the order of the manual.
reservedWords :: [Text]
reservedWords =
  statements
    <> blocks
    <> ["open", "closed", "in", "cw", "ccw", "else", "then", "and", "or", "not"]
    <> ["meet", "near", "smooth", "tangent", "fillet", "chamfer", "slow", "allowance", "bevel"]
    <> [ "outside",
         "inside",
         "left",
         "right",
         "on",
         "within",
         "first",
         "last",
         "approach",
         "retract"
       ]
    <> filter (/= "in") (map unitName [minBound .. maxBound])

reserved :: Set Text
reserved = Set.fromList reservedWords
