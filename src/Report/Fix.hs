-- | Fixes: changes of the program's text that mend the mistake of a report.
module Report.Fix
  ( Fix (..),
    FixEdit (..),
    FixText (..),
    exchange,
    insertion,
    removal,
    enclosure,
    swap,
    move,
    joined,
    proposed,
    newText,
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
  deriving stock (Eq, Ord, Show)

-- | Region of the program whose text is replaced, and the parts of the new text. An empty region is
-- a place for new text.
data FixEdit = FixEdit {replaced :: Region, parts :: [FixText]}
  deriving stock (Eq, Ord, Show)

-- | Part of a new text: words of the fix, or the text of a region of the program.
data FixText = Written Text | Copied Region
  deriving stock (Eq, Ord, Show)

-- | Fix that writes another text in a region.
exchange :: Text -> Region -> Text -> Fix
exchange title region new = Fix {title, isProposal = False, edits = [FixEdit region [Written new]]}

-- | Fix that writes a text at an offset.
insertion :: Text -> Int -> Text -> Fix
insertion title offset = exchange title (Region offset offset)

-- | Fix that removes the text of a region.
removal :: Text -> Region -> Fix
removal title region = Fix {title, isProposal = False, edits = [FixEdit region []]}

-- | Fix that writes one text before and one after a region.
enclosure :: Text -> Text -> Region -> Text -> Fix
enclosure title before region after =
  Fix
    { title,
      isProposal = False,
      edits =
        [ FixEdit (Region (start region) (start region)) [Written before],
          FixEdit (Region (end region) (end region)) [Written after]
        ]
    }

-- | Fix that exchanges the texts of two regions, which do not overlap.
swap :: Text -> Region -> Region -> Fix
swap title a b =
  Fix {title, isProposal = False, edits = [FixEdit a [Copied b], FixEdit b [Copied a]]}

-- | Fix that moves the text of a region to an offset outside of it, and writes a line end after it.
move :: Text -> Region -> Int -> Fix
move title region offset =
  Fix
    { title,
      isProposal = False,
      edits =
        [FixEdit (Region offset offset) [Copied region, Written "\n"], FixEdit region []]
    }

-- | Fix that makes the changes of several fixes, which do not overlap, at once.
joined :: Text -> [Fix] -> Fix
joined title fs = Fix {title, isProposal = any isProposal fs, edits = concatMap edits fs}

-- | The fix as a proposal.
proposed :: Fix -> Fix
proposed f = f {isProposal = True}

-- | Text that an edit writes in place of the region.
newText :: Source -> FixEdit -> Text
newText source e = Text.concat (map part (parts e))
  where
    part p = case p of
      Written text -> text
      Copied (Region from to) -> Text.take (to - from) (Text.drop from (Region.text source))

-- | True if a fix changes and copies only the text of the program itself, not of its imports.
isWithin :: Source -> Fix -> Bool
isWithin source fix = all isOwn (concatMap regions (edits fix))
  where
    isOwn region = end region <= Text.length (Region.text source)
    regions e = replaced e : [region | Copied region <- parts e]

-- | Text of the program after edits that do not overlap.
applied :: Source -> [FixEdit] -> Text
applied source es = Text.concat (go 0 (sortOn replaced es))
  where
    whole = Region.text source
    go from list = case list of
      [] -> [Text.drop from whole]
      e : more ->
        Text.take (start (replaced e) - from) (Text.drop from whole) :
        newText source e :
        go (end (replaced e)) more
