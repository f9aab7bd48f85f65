-- | Texts with a mark @^@ at the cursor, for tests of queries.
module Query.Marked
  ( look,
    marked,
    header,
    unmarked,
  )
where

import Data.Text (Text)
import Data.Text qualified as Text
import Project.LoadedProgram qualified as LoadedProgram
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot

-- | The snapshot of a text.
look :: Text -> Snapshot
look = Snapshot.take (Snapshot.checkWith []) . LoadedProgram.fromText "a.part"

-- | The snapshot of a marked text without its mark, and the offset of the mark.
marked :: Text -> (Snapshot, Int)
marked text = (look (unmarked text), Text.length (fst (Text.breakOn "^" text)))

-- | A text without its mark.
unmarked :: Text -> Text
unmarked = Text.replace "^" ""

-- | The first statements of a program.
header :: Text
header =
  "part p\nmachine lkp-01f\ntool mill(diameter 2 mm)\nfeed 60 mm/min\ntolerance 0.02 mm\nfrom (0, \
  \0)\n"
