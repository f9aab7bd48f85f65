-- | A program together with what it imports.
--
-- An imported file gives its definitions (@let@, @param@, @contour@, and what it imports itself);
-- its settings and motions stay behind. Each file is read once, however often it is imported.
module Surface.Import
  ( Reader (..),
    byName,
    ImportedProgram (..),
    load,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Located (..), Region, Source)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Control.Monad.State.Strict (StateT, get, gets, lift, modify', put, runStateT)
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.Csv qualified as Csv
import Surface.Error (Error (..))
import Surface.Parser qualified as Parser
import Surface.Syntax (Lines (..), Program (..), Statement, Statement_ (..), TableLine)
import System.FilePath
  ( isAbsolute,
    joinPath,
    normalise,
    splitDirectories,
    takeDirectory,
    takeExtension,
    (</>),
  )

-- | How files are read.
data Reader m = Reader
  { -- | the text of a file, or why it cannot be read
    contents :: FilePath -> m (Either Text Text),
    -- | a name that is the same for all paths to one file
    identity :: FilePath -> m FilePath
  }

-- | Where each file has one path.
byName :: Monad m => (FilePath -> m (Either Text Text)) -> Reader m
byName contents = Reader {contents, identity = pure}

-- | All texts, and one program of them; where each import stands, and the file that it names.
data ImportedProgram = ImportedProgram
  { source :: Source,
    surface :: Result Error Error Program,
    imports :: [(Region, Text)]
  }

-- | What is known between two files.
data Progress = Progress
  { texts :: Source,
    seen :: Set FilePath,
    found :: [Error],
    named :: [(Region, Text)]
  }

-- | Read a program and what it imports: the name of its file, for reports and for the places of the
-- others; its text.
load :: Monad m => Reader m -> FilePath -> Text -> m ImportedProgram
load reader path text = do
  itself <- identity reader (simple path)
  let Result {errors, output} = Parser.parse 0 text
      begin =
        Progress
          { texts = Region.fromText (Text.pack path) text,
            seen = Set.singleton itself,
            found = [],
            named = []
          }
  case output of
    Nothing ->
      pure ImportedProgram {source = texts begin, surface = Result [] errors Nothing, imports = []}
    Just whole -> do
      (statements', progress) <-
        runStateT (imported reader [(itself, simple path)] path (statements whole)) begin
      pure
        ImportedProgram
          { source = texts progress,
            surface =
              Result
                []
                (errors <> reverse (found progress))
                (Just whole {statements = statements'}),
            imports = reverse (named progress)
          }

-- | The statements of a file with its imports replaced by what they bring. The files that are being
-- read stand on a stack, by what they are and by the paths that they were named by.
imported ::
  Monad m =>
  Reader m ->
  [(FilePath, FilePath)] ->
  FilePath ->
  [Statement] ->
  StateT Progress m [Statement]
imported reader stack path = fmap concat . mapM one
  where
    one s = case s of
      Located _ (Import (Located at name)) -> do
        let file = simple (takeDirectory path </> Text.unpack name)
        modify' (\p -> p {named = (at, Text.pack file) : named p})
        itself <- lift (identity reader file)
        bring at itself file name
      Located region (Table name (LinesOf (Located at file))) -> do
        let path' = simple (takeDirectory path </> Text.unpack file)
        modify' (\p -> p {named = (at, Text.pack path') : named p})
        rows <- linesIn reader at path' file
        pure
          [ maybe
              (Located region (Broken (Just "table") (Just name)))
              (Located region . Table name . WrittenLines)
              rows
          ]
      _ -> pure [s]
    bring at itself file name
      | Just begun <- lookup itself stack =
        mistake
          at
          ( ImportCycle
              at
              ( map
                  Text.pack
                  (reverse (file : map snd (takeWhile ((/= itself) . fst) stack) <> [begun]))
              )
          )
      | length stack > deepest =
        mistake
          at
          ( ImportMissing
              at
              name
              ("imports are nested more than " <> Decimal.whole deepest <> " deep")
          )
      | otherwise = do
        known <- gets (Set.member itself . seen)
        if known then pure [] else readIn at itself file name
    readIn at itself file name
      | takeExtension file == ".sheet" =
        mistake
          at
          (ImportMissing at name "it is an input sheet, of which partc import makes a program")
      | otherwise = readPart at itself file name
    readPart at itself file name = do
      content <- lift (contents reader file)
      case content of
        Left why -> mistake at (ImportMissing at name why)
        Right text -> do
          progress <- get
          let Result {errors, output} = Parser.parse (Region.next (texts progress)) text
          put
            progress
              { texts = Region.add (Text.pack file) text (texts progress),
                seen = Set.insert itself (seen progress),
                found = reverse errors <> found progress
              }
          filter defines
            <$> imported reader ((itself, file) : stack) file (maybe [] statements output)

-- | The lines of a table in a file. It may be read several times; each reading has places of its
-- own.
linesIn ::
  Monad m =>
  Reader m ->
  Region ->
  FilePath ->
  Text ->
  StateT Progress m (Maybe [TableLine])
linesIn reader at file name = do
  content <- lift (contents reader file)
  case content of
    Left why -> Nothing <$ modify' (\p -> p {found = LinesMissing at name why : found p})
    Right text -> do
      progress <- get
      let (errors, rows) = Csv.table (Region.next (texts progress)) text
      put
        progress
          { texts = Region.add (Text.pack file) text (texts progress),
            found = reverse errors <> found progress
          }
      pure (if null errors then Just rows else Nothing)

-- | What is missing leaves a gap, so that nobody misses the names that it would have brought.
mistake :: Monad m => Region -> Error -> StateT Progress m [Statement]
mistake at e =
  [Located at (Broken (Just "import") Nothing)] <$ modify' (\p -> p {found = e : found p})

-- | Imports are not nested deeper.
deepest :: Int
deepest = 100

-- | Whether a statement is something that an import brings.
defines :: Statement -> Bool
defines (Located _ s) = case s of
  LetValue _ _ -> True
  LetFunction {} -> True
  Param _ _ -> True
  Contour {} -> True
  Table _ _ -> True
  Curve _ _ -> True
  Piece {} -> True
  Broken _ (Just _) -> True
  Broken (Just "import") _ -> True
  _ -> False

-- | A path without detours, so that one file has one name.
simple :: FilePath -> FilePath
simple path = if null parts then "." else joinPath parts
  where
    parts = foldl step [] (splitDirectories (normalise path))
    step before part = case (part, reverse before) of
      (".", _) -> before
      ("..", final : rest) | final /= ".." && not (isAbsolute final) -> reverse rest
      _ -> before <> [part]
