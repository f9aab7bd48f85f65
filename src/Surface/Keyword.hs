-- | The keywords of the language.
--
-- Only reserved words are refused as names. Words that occur only where no name can occur (@depth@,
-- @step@, @by@ …) are not reserved.
module Surface.Keyword
  ( statements,
    softStatements,
    blocks,
    beginsItem,
    settingsOf,
    selectorWord,
    isReserved,
    reservedWords,
  )
where

import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Surface.HoleForm qualified as HoleForm
import Surface.Syntax (Selector (..))
import Surface.Token (unitName)

-- | The keywords that are reserved and, at the start of a line, begin a statement.
statements :: [Text]
statements =
  ["part", "machine", "import", "tool", "feed", "tolerance", "clearance", "from"]
    <> ["let", "param", "table", "curve", "piece", "contour", "assert"]
    <> ["mill", "turn", "drill", "rapid", "move", "change", "spindle", "coolant", "aux", "with"]

-- | The words that begin a statement at the start of a line and are names elsewhere, as in
-- @contour pocket closed@. Some of them are whole statements, some need a word after them.
softStatements :: [Text]
softStatements =
  ["pocket", "rest", "face", "engrave", "vcarve"]
    <> ["units", "work", "program", "safe", "stock", "avoid"]
    <> ["contours", "stop", "optional", "dwell"]
    <> HoleForm.words'

-- | The keywords that begin a repetition or a choice, either of statements or of items of a
-- contour.
blocks :: [Text]
blocks = ["for", "if"]

-- | Tells if a word is a keyword that begins an item of a contour, or a setting.
beginsItem :: Text -> Bool
beginsItem word = word `elem` (["for", "if", "cw", "ccw"] <> settings)
  where
    settings =
      ["approach", "retract", "depth", "lead", "allowance", "corners", "climb", "conventional"]
        <> ["compensation", "start", "plunge", "peck", "shortest", "islands", "rest"]
        <> ["angle", "ramp", "helix", "spiral", "tabs", "tab"]
        <> ["chip", "dwell", "pitch", "hand", "floating"]

-- | The settings that are allowed in the block of a statement, each by the one or two words with
-- which it begins. @statement@ is the keyword of the statement.
settingsOf :: Text -> [Text]
settingsOf statement = case statement of
  "mill" ->
    linkingMoves
      <> ["start near", "climb", "conventional"]
      <> passes
      <> ["depth", "plunge", "ramp", "helix", "spiral", "tabs", "tab at", "compensation", "rest"]
  "pocket" -> "islands" : clearing <> ["ramp", "helix"]
  "rest" -> clearing
  "face" ->
    ["approach", "retract", "climb", "conventional", "angle", "depth", "plunge"]
  "engrave" -> ["depth", "plunge", "ramp"]
  "vcarve" -> ["depth", "plunge", "rest"]
  "turn" -> linkingMoves <> passes
  "drill" -> ["peck", "chip break", "dwell", "plunge", "shortest"]
  "spot" -> ["dwell", "plunge", "shortest"]
  "countersink" -> ["dwell", "plunge", "shortest"]
  "counterbore" -> ["pitch", "dwell", "plunge", "climb", "conventional", "shortest"]
  "bore" -> ["plunge", "climb", "conventional", "shortest"]
  "thread" -> ["hand", "plunge", "climb", "conventional", "shortest"]
  "tap" -> ["hand", "floating", "shortest"]
  _ -> ["plunge", "shortest"]
  where
    linkingMoves = ["approach", "retract", "lead in", "lead out"]
    passes = ["allowance", "corners"]
    clearing =
      ["approach", "retract", "climb", "conventional", "allowance", "depth", "plunge", "rest"]

-- | The word for a selector, such as @near@ in the argument @near p@.
selectorWord :: Selector -> Text
selectorWord selector = case selector of
  Near -> "near"
  ToLeft -> "left"
  ToRight -> "right"
  ToInside -> "inside"
  ToOutside -> "outside"
  WithinTolerance -> "within"

-- | Tells if a word is refused as a name.
isReserved :: Text -> Bool
isReserved word = Set.member word reserved

-- | The words that are refused as names, in the order of the manual.
reservedWords :: [Text]
reservedWords =
  statements
    <> blocks
    <> ["open", "closed", "in", "cw", "ccw", "else", "then", "and", "or", "not"]
    <> ["meet", "near", "smooth", "tangent", "fillet", "chamfer", "slow", "allowance", "bevel"]
    <> ["outside", "inside", "left", "right", "on", "within", "first", "last"]
    <> ["approach", "retract"]
    <> filter (/= "in") (map unitName [minBound .. maxBound])

reserved :: Set Text
reserved = Set.fromList reservedWords
