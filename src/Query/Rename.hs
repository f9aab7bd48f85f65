-- | The renaming of a name in all files of a program, and in the open programs that share them.
--
-- A renaming is tried before it is answered: the changed texts are checked, and every name must
-- mean the same as before in every one of these programs. So a renaming never changes the meaning
-- of an open program.
module Query.Rename
  ( prepare,
    rename,
    applied,
  )
where

import Base.Region (Region (..), Source)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Checked.Builtin qualified as Builtin
import Checked.FromSurface qualified as Checked
import Data.Containers.ListUtils (nubOrdOn)
import Data.Foldable (traverse_)
import Data.List (find, sort)
import Data.Maybe (fromMaybe, isJust)
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram
import Query.Mention (Mention)
import Query.Mention qualified as Mention
import Query.Reference (References (..))
import Query.Reference qualified as Reference
import Query.SharedFile (FileMentions (..), FilePlace (..), OpenProgram (..), SharedFile (..))
import Query.SharedFile qualified as SharedFile
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

-- | The mentions of the name at the offset @at@, which are to be replaced by the new name. They lie
-- in the files of the program and in the programs among @others@ that share these files. Otherwise
-- the reason why the renaming is refused.
rename :: [OpenProgram] -> Snapshot -> Int -> Text -> Either Text [FileMentions]
rename others now at new = do
  found <- named now at
  let old = textAt now (here found)
      programs = relatedPrograms others now
      places' = placesIn programs found
      edited = Set.map file places'
      concerned = filter (any (`Set.member` edited) . dependencies) programs
      mentions' = SharedFile.grouped (concatMap files concerned) places'
  legal new
  traverse_ (refuseStale mentions') concerned
  traverse_ (refuseUnanalysed edited old) others
  traverse_ (refuseOther old) mentions'
  traverse_ (refuseHidden old (Set.union places' (allPlaces concerned))) concerned
  if old == new then pure [] else mentions' <$ traverse_ (tried mentions' places' new) concerned

-- | The mention of a name at an offset with all others in the program, if it can be renamed.
named :: Snapshot -> Int -> Either Text References
named now at = case Reference.references now Nothing at of
  Nothing -> Left "there is no name here"
  Just found
    | null (definition found) -> Left (quote (word found) <> " belongs to the language")
    | Just other <- find ((/= word found) . textAt now) (places found) ->
      Left (otherSpelling (textAt now other))
    | otherwise -> Right found
  where
    word found = textAt now (here found)

otherSpelling :: Text -> Text
otherSpelling other = quote other <> " is written in another way in a file of the program"

refuseIf :: Bool -> Text -> Either Text ()
refuseIf isRefused why = if isRefused then Left why else Right ()

-- | Refuses a text that cannot be a name.
legal :: Text -> Either Text ()
legal new = do
  refuseIf (Keyword.isReserved new) (quote new <> " is a word of the language")
  refuseIf
    (isJust (Builtin.lookup new) && not (Builtin.mayBeHidden new))
    (quote new <> " belongs to the language")
  refuseIf (map shape (fst (Lexer.tokens 0 new)) /= [Word new]) $
    quote new
      <> " is no name: a name consists of letters, digits and _, and does not begin with a digit"

-- Programs ----------------------------------------------------------------------------------------

-- | A program that may mention the name. @isAsked@ is true for the program in which the renaming
-- was asked for. @changed@ loads the program with new texts of some files, given by the identities
-- of these files.
data RelatedProgram = RelatedProgram
  { isAsked :: Bool,
    files :: [SharedFile],
    -- | the identities of the program's own file and of all files that it names
    dependencies :: [Text],
    loaded :: LoadedProgram,
    mentions :: ~[Mention],
    changed :: [(Text, Text)] -> LoadedProgram
  }

-- | The program of the snapshot @now@ first, then the other open programs whose present texts are
-- analysed, then the imported files of all these as programs of their own.
relatedPrograms :: [OpenProgram] -> Snapshot -> [RelatedProgram]
relatedPrograms others now =
  nubOrdOn
    (map identity . take 1 . files)
    ( concatMap (take 1) programs
        <> concatMap (drop 1) programs
    )
  where
    programs =
      [ map (related isAsked s) (SharedFile.ownPrograms s)
        | (isAsked, s) <- (True, now) : [(False, present o) | o <- others, isAnalysed o]
      ]

-- | The program with the given path and text, whose imports are among the files of the snapshot.
related :: Bool -> Snapshot -> (Text, Text) -> RelatedProgram
related isAsked now (path, text) =
  RelatedProgram
    { isAsked,
      files = SharedFile.filesOf identified (LoadedProgram.source loaded),
      dependencies = map snd (LoadedProgram.identities loaded),
      loaded,
      mentions = Mention.ofLoaded loaded,
      changed = \texts ->
        let new = lookup (identified path) texts
         in Snapshot.loadedWith now texts path (fromMaybe text new)
    }
  where
    identified = Snapshot.identityOf now
    loaded = Snapshot.loadedWith now [] path text

-- | The places of all mentions of a name in these programs. The first program is the one in which
-- the name was found.
placesIn :: [RelatedProgram] -> References -> Set FilePlace
placesIn programs found =
  Set.fromList
    [ place
      | own <- take 1 programs,
        Just d <- [definition found >>= SharedFile.inFile (files own)],
        p <- programs,
        m <- mentions p,
        Mention.word m == name found,
        (Mention.definition m >>= SharedFile.inFile (files p)) == Just d,
        Just place <- [SharedFile.inFile (files p) (Mention.place m)]
    ]

-- | The places of all mentions of names that have a meaning in one of these programs.
allPlaces :: [RelatedProgram] -> Set FilePlace
allPlaces programs =
  Set.fromList
    [ place
      | p <- programs,
        Just place <- map (SharedFile.inFile (files p) . Mention.place) (mentions p)
    ]

-- Refusals ----------------------------------------------------------------------------------------

-- | Refuses a renaming if a program was analysed with another text of a file than the one that is
-- to be changed.
refuseStale :: [FileMentions] -> RelatedProgram -> Either Text ()
refuseStale edited p =
  traverse_
    (\f -> Left (Text.concat ["the present text of ", path f, " is not analysed yet"]))
    [ f
      | FileMentions f _ <- edited,
        other <- files p,
        identity other == identity f,
        content other /= content f
    ]

-- | Refuses a renaming if an open program, whose present text is not analysed, contains the old
-- name, and is one of the changed files or may import one of them.
refuseUnanalysed :: Set Text -> Text -> OpenProgram -> Either Text ()
refuseUnanalysed edited old OpenProgram {present, isAnalysed} =
  refuseIf (not isAnalysed && mayImport && not (null (wordsIn old text))) $
    quote old <> " also occurs in " <> Region.mainFile (Snapshot.source present)
      <> ", which is not analysed yet"
  where
    text = Region.text (Snapshot.source present)
    own = Snapshot.identityOf present (Region.mainFile (Snapshot.source present))
    mayImport = own `Set.member` edited || not (null (wordsIn "import" text))

-- | Refuses a renaming if a mention is written in another way than the old name.
refuseOther :: Text -> FileMentions -> Either Text ()
refuseOther old (FileMentions f found) =
  traverse_
    (\other -> refuseIf (other /= old) (otherSpelling other))
    [Text.take (end r - start r) (Text.drop (start r) (content f)) | r <- found]

-- | Refuses a renaming if the old name occurs outside of the places @known@ in a program with
-- mistakes of form, names or types. It may mean this name, but nothing is known of it.
refuseHidden :: Text -> Set FilePlace -> RelatedProgram -> Either Text ()
refuseHidden old known p =
  traverse_
    (\at -> Left (quote old <> " also occurs where " <> at <> " has a mistake; correct this first"))
    [ if isAsked p && base f == 0 then "the text" else path f
      | isWrong (loaded p),
        f <- files p,
        r <- wordsIn old (content f),
        FilePlace (identity f) r `Set.notMember` known
    ]

-- | The regions of a word in a text.
wordsIn :: Text -> Text -> [Region]
wordsIn word text = [place t | t <- fst (Lexer.tokens 0 text), shape t == Word word]

-- | Tries a renaming in a program. Refuses it if a name would then mean something else, or would
-- mean nothing.
tried :: [FileMentions] -> Set FilePlace -> Text -> RelatedProgram -> Either Text ()
tried edited places' new p
  | isSame && (isWrong (loaded p) || not (isWrong after)) = Right ()
  | otherwise = Left (quote new <> " is taken" <> where')
  where
    isSame = bindings moved (mentions p) == bindings id (Mention.ofLoaded after)
    after = changed p [(identity f, text) | (f, text) <- applied edited new]
    starts = Set.fromList (map start here')
    here' = concatMap (SharedFile.inProgram (files p)) (Set.toList places')
    delta = Text.length new - sum [end r - start r | r <- take 1 here']
    moved (Region a b) = Region (shifted a) (shifted b)
    shifted offset = offset + delta * Set.size (fst (Set.split offset starts))
    where' = case [Mention.place m | m <- mentions p, Mention.word m == new] of
      r : _ -> ": see " <> lineOf (LoadedProgram.source (loaded p)) r
      []
        | isAsked p -> ", or the program would no longer mean the same"
        | otherwise -> ", or " <> Text.concat (map path (take 1 (files p))) <> wouldDiffer
    wouldDiffer = " would no longer mean the same"

-- | The file and the line of a region.
lineOf :: Source -> Region -> Text
lineOf source r =
  let position = Region.position source (start r)
   in Region.file position <> ", line " <> Text.pack (show (Region.line position))

-- | The mentions of a program as pairs: the region of a mention, the region of its definition. Each
-- region is moved.
bindings :: (Region -> Region) -> [Mention] -> Set (Region, Maybe Region)
bindings moved ms =
  Set.fromList [(moved (Mention.place m), moved <$> Mention.definition m) | m <- ms]

-- | The texts of the files after the replacement of all mentions by a new name.
applied :: [FileMentions] -> Text -> [(SharedFile, Text)]
applied edited new = [(f, replaced 0 (content f) (sort found)) | FileMentions f found <- edited]
  where
    replaced from rest rs = case rs of
      [] -> rest
      r : more ->
        Text.take (start r - from) rest
          <> new
          <> replaced (end r) (Text.drop (end r - from) rest) more

-- | True if a program has mistakes of form, names or types.
isWrong :: LoadedProgram -> Bool
isWrong p =
  not (null (errors (LoadedProgram.surface p)))
    || maybe True (not . null . errors . Checked.check) (output (LoadedProgram.surface p))

-- | The text of a region.
textAt :: Snapshot -> Region -> Text
textAt now region = Text.concat (Region.linesIn (Snapshot.source now) region)
