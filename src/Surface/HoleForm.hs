-- | The forms of the statements that work on holes: their words, and the sizes that they give.
module Surface.HoleForm
  ( word,
    named,
    sizeForms,
    sizeWord,
    isByRow,
    words',
  )
where

import Data.Text (Text)
import Surface.Syntax (HoleSize (..), HoleWork (..))

-- | The word with which the statement of a work begins.
word :: HoleWork -> Text
word work = case work of
  Spotting -> "spot"
  Reaming -> "ream"
  Countersinking -> "countersink"
  Counterboring -> "counterbore"
  Boring -> "bore"
  Tapping -> "tap"
  Threading -> "thread"

-- | The work whose statement begins with a word.
named :: Text -> Maybe HoleWork
named text = lookup text [(word w, w) | w <- [minBound ..]]

-- | The words of all works.
words' :: [Text]
words' = map word [minBound ..]

-- | The sizes that a statement gives, in their order; several lists if it has several forms.
sizeForms :: HoleWork -> [[HoleSize]]
sizeForms work = case work of
  Spotting -> [[HoleDepth], [HoleDiameter]]
  Reaming -> [[HoleDepth]]
  Countersinking -> [[HoleAngle, HoleDiameter]]
  Counterboring -> [[HoleDiameter, HoleDepth]]
  Boring -> [[HoleDiameter, HoleDepth, HolePitch]]
  Tapping -> [[HolePitch, HoleDepth]]
  Threading -> [[HoleDiameter, HolePitch, HoleDepth]]

-- | The word before a size.
sizeWord :: HoleSize -> Text
sizeWord size = case size of
  HoleDiameter -> "diameter"
  HoleDepth -> "depth"
  HolePitch -> "pitch"
  HoleAngle -> "angle"

-- | True for a size that may be another one in each row of a table: the depth, and the diameter at
-- the top that a pointed tool makes.
isByRow :: HoleWork -> HoleSize -> Bool
isByRow work size = case size of
  HoleDepth -> True
  HoleDiameter -> work `elem` [Spotting, Countersinking]
  HolePitch -> False
  HoleAngle -> False
