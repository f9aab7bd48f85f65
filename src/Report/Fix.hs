-- | Fixes: changes of the program's text that mend the mistake of a report.
module Report.Fix
  ( Fix (..),
    FixEdit (..),
    exchange,
    insertion,
    removal,
    enclosure,
    proposed,
    isWithin,
    applied,
  )
where

import Base.Region (Region (..), Source)
import Base.Region qualified as Region
import Data.List (sortOn)
import Data.Text (Text)
import Data.Text qualified as Text

-- | Change that mends a mistake.
data Fix = Fix
  { -- | what the change does: a sentence that begins with a verb
    title :: Text,
    -- | true if the fix changes what the program means, so that the user has to decide
    isProposal :: Bool,
    -- | edits that do not overlap
    edits :: [FixEdit]
  }
  deriving stock (Eq, Show)

-- | Region of the program whose text is replaced, and the new text. An empty region is a place for
-- new text.
data FixEdit = FixEdit {replaced :: Region, newText :: Text}
  deriving stock (Eq, Show)

-- | Fix that writes another text in a region.
exchange :: Text -> Region -> Text -> Fix
exchange title region new = Fix {title, isProposal = False, edits = [FixEdit region new]}

-- | Fix that writes a text at an offset.
insertion :: Text -> Int -> Text -> Fix
insertion title offset = exchange title (Region offset offset)

-- | Fix that removes the text of a region.
removal :: Text -> Region -> Fix
removal title region = Fix {title, isProposal = False, edits = [FixEdit region ""]}

-- | Fix that writes one text before and one after a region.
enclosure :: Text -> Text -> Region -> Text -> Fix
enclosure title before region after =
  Fix
    { title,
      isProposal = False,
      edits =
        [ FixEdit (Region (start region) (start region)) before,
          FixEdit (Region (end region) (end region)) after
        ]
    }

-- | The fix as a proposal.
proposed :: Fix -> Fix
proposed f = f {isProposal = True}

-- | True if a fix changes only the text of the program itself, not of its imports.
isWithin :: Source -> Fix -> Bool
isWithin source fix = all isOwn (edits fix)
  where
    isOwn e = end (replaced e) <= Text.length (Region.text source)

-- | Text of the program after edits that do not overlap.
applied :: Source -> [FixEdit] -> Text
applied source es = Text.concat (go 0 (sortOn replaced es))
  where
    whole = Region.text source
    go from list = case list of
      [] -> [Text.drop from whole]
      e : more ->
        Text.take (start (replaced e) - from) (Text.drop from whole) :
        newText e :
        go (end (replaced e)) more
