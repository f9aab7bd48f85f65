-- | The renaming of a name in all files of a program.
--
-- A renaming is tried before it is answered: the changed texts are checked, and every name must
-- mean the same as before. So a renaming never changes the meaning of a program.
module Query.Rename
  ( prepare,
    rename,
    applied,
  )
where

import Base.Region (Region (..))
import Base.Region qualified as Region
import Base.Result (Result (..))
import Checked.Builtin qualified as Builtin
import Checked.FromSurface qualified as Checked
import Checked.Syntax qualified as Checked
import Data.List (find, sort)
import Data.Maybe (isJust)
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram
import Query.Mention qualified as Mention
import Query.Reference (References (..))
import Query.Reference qualified as Reference
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Report.Report (quote)
import Surface.Keyword qualified as Keyword
import Surface.Lexer qualified as Lexer
import Surface.Token (Token (..), Token_ (..))

-- | The name at the offset @at@ that can be renamed: its region and its text. Otherwise the reason
-- why nothing there can be renamed.
prepare :: Snapshot -> Int -> Either Text (Region, Text)
prepare now at = do
  found <- named now at
  pure (here found, textAt now (here found))

-- | The regions of all mentions of the name at the offset @at@, which are to be replaced by the new
-- name. They may lie in several files. Otherwise the reason why the renaming is refused.
rename :: Snapshot -> Int -> Text -> Either Text [Region]
rename now at new = do
  found <- named now at
  let old = textAt now (here found)
  legal new
  refuseIf (not (null (hidden now old (places found)))) $
    quote old <> " also occurs where the text has a mistake; correct this first"
  if old == new then pure [] else places found <$ tried now (places found) new

-- | The mentions of the name at an offset, if it can be renamed.
named :: Snapshot -> Int -> Either Text References
named now at = case Reference.references now Nothing at of
  Nothing -> Left "there is no name here"
  Just found
    | null (definition found) -> Left (quote (word found) <> " belongs to the language")
    | Just other <- find ((/= word found) . textAt now) (places found) ->
      Left (quote (textAt now other) <> " is written in another way in a file of the program")
    | otherwise -> Right found
  where
    word found = textAt now (here found)

refuseIf :: Bool -> Text -> Either Text ()
refuseIf isRefused why = if isRefused then Left why else Right ()

-- | Refuses a text that cannot be a name.
legal :: Text -> Either Text ()
legal new = do
  refuseIf (Keyword.isReserved new) (quote new <> " is a word of the language")
  refuseIf (isJust (Builtin.lookup new)) (quote new <> " belongs to the language")
  refuseIf (map shape (fst (Lexer.tokens 0 new)) /= [Word new]) $
    quote new
      <> " is no name: a name consists of letters, digits and _, and does not begin with a digit"

-- | The occurrences of a name outside of the regions @known@, in a program with mistakes of form,
-- names or types. They may mean this name, but nothing is known of them.
hidden :: Snapshot -> Text -> [Region] -> [Region]
hidden now old known
  | not (isWrong (Snapshot.reloaded now [] (Region.text (Snapshot.source now)))) = []
  | otherwise =
    [ place t
      | t <- fst (Lexer.tokens 0 (Region.text (Snapshot.source now))),
        shape t == Word old,
        place t `Set.notMember` otherMentions,
        place t `notElem` known
    ]
  where
    otherMentions = Set.fromList (map Mention.place (Mention.mentions (Snapshot.facts now)))

-- | Tries a renaming. Refuses it if a name would then mean something else, or would mean nothing.
tried :: Snapshot -> [Region] -> Text -> Either Text ()
tried now places' new
  | bindings (moved . Mention.place) (fmap moved . Mention.definition) before == after = Right ()
  | otherwise = Left (quote new <> " is taken" <> where')
  where
    before = Mention.mentions (Snapshot.facts now)
    after = bindings Mention.place Mention.definition (mentionsOf changed)
    changed =
      let texts = applied now places' new
       in Snapshot.reloaded now (drop 1 texts) (Text.concat (map snd (take 1 texts)))
    delta = Text.length new - sum [end r - start r | r <- take 1 places']
    moved (Region a b) = Region (shifted a) (shifted b)
    shifted offset = offset + delta * length (filter ((< offset) . start) places')
    where' = case [Mention.place m | m <- before, Mention.word m == new] of
      r : _ ->
        let position = Region.position (Snapshot.source now) (start r)
         in ": see " <> Region.file position <> ", line " <> Text.pack (show (Region.line position))
      [] -> ", or the program would no longer mean the same"

-- | The mentions of a program as pairs: the region of a mention, the region of its definition.
bindings ::
  (Mention.Mention -> Region) ->
  (Mention.Mention -> Maybe Region) ->
  [Mention.Mention] ->
  Set (Region, Maybe Region)
bindings place' definition' ms = Set.fromList [(place' m, definition' m) | m <- ms]

-- | The texts of all files after the replacement of these regions by a new name, each with the path
-- of its file. The program's own file is the first.
applied :: Snapshot -> [Region] -> Text -> [(Text, Text)]
applied now places' new = zipWith changed bases files
  where
    files = Region.files (Snapshot.source now)
    bases = scanl (\base (_, text) -> base + Text.length text + 1) 0 files
    changed base (path, text) =
      (path, replaced 0 text (sort [r | r <- places', isIn base text r]))
      where
        replaced from rest rs = case rs of
          [] -> rest
          r : more ->
            Text.take (start r - base - from) rest
              <> new
              <> replaced (end r - base) (Text.drop (end r - base - from) rest) more
    isIn base text r = base <= start r && end r <= base + Text.length text

-- | The mentions that a check of the program finds.
mentionsOf :: LoadedProgram -> [Mention.Mention]
mentionsOf loaded = case output (LoadedProgram.surface loaded) of
  Just program -> maybe [] Checked.mentions (output (Checked.check program))
  Nothing -> []

-- | True if a program has mistakes of form, names or types.
isWrong :: LoadedProgram -> Bool
isWrong loaded =
  not (null (errors (LoadedProgram.surface loaded)))
    || maybe True (not . null . errors . Checked.check) (output (LoadedProgram.surface loaded))

-- | The text of a region.
textAt :: Snapshot -> Region -> Text
textAt now region = Text.concat (Region.linesIn (Snapshot.source now) region)
