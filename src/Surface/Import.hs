-- | A program together with the files that it imports.
--
-- An import is replaced by the definitions of the imported file and of the files that it imports
-- itself. All other statements of an imported file are dropped. Each imported file is read once.
-- The name of a table file is replaced by the lines of the table.
module Surface.Import
  ( Reader (..),
    byName,
    GlyphRuns,
    ImportedProgram (..),
    load,
  )
where

import Base.Name (Name)
import Base.Name qualified as Name
import Base.Quantity (LengthUnit, Mm)
import Base.Region (Located (..), Region, Source)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Control.Monad.State.Strict (StateT, get, gets, lift, modify', put, runStateT)
import Data.ByteString (ByteString)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, listToMaybe)
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Drawing.Drawing (Entity)
import Drawing.FileFormat qualified as FileFormat
import Font.TrueType (FontFault, GlyphRun)
import Surface.Csv qualified as Csv
import Surface.DrawingError (DrawingMistake (InFont))
import Surface.Error (Error (..))
import Surface.FileUnit qualified as FileUnit
import Surface.FontError (FontMistake (NotAFont))
import Surface.FromDrawing (Converted (..), DrawingText (drawing))
import Surface.FromDrawing qualified as FromDrawing
import Surface.FromFont qualified as FromFont
import Surface.Parser qualified as Parser
import Surface.Syntax
  ( DrawingReference (..),
    Lettering (lettered),
    Lines (..),
    Program (..),
    Statement,
    Statement_ (..),
    TableLine,
  )
import System.FilePath
  ( dropExtension,
    isAbsolute,
    joinPath,
    normalise,
    splitDirectories,
    takeDirectory,
    takeExtension,
    takeFileName,
    (</>),
  )

-- | Access to files.
data Reader m = Reader
  { -- | the text of a file, or the reason why it cannot be read
    contents :: FilePath -> m (Either Text Text),
    -- | the bytes of a file, or the reason why it cannot be read
    bytes :: FilePath -> m (Either Text ByteString),
    -- | the glyphs of a text in a font file, or the reason why the file cannot be read
    glyphs :: FilePath -> Text -> m (Either Text (Either FontFault GlyphRun)),
    -- | the identity of a file: the same result for all paths that lead to the same file
    identity :: FilePath -> m FilePath,
    -- | the names of the files in a folder; none if they are not known
    listing :: FilePath -> m [FilePath]
  }

-- | The glyphs of texts, by the paths of their fonts and the texts.
type GlyphRuns = Map (FilePath, Text) (Either FontFault GlyphRun)

-- | A reader that treats files with different paths as different files, and knows no folders and no
-- fonts. The bytes of a file are its text in UTF-8.
byName :: Monad m => (FilePath -> m (Either Text Text)) -> Reader m
byName contents =
  Reader
    { contents,
      bytes = fmap (fmap Encoding.encodeUtf8) . contents,
      glyphs = \_ _ -> pure (Left "fonts are not read here"),
      identity = pure,
      listing = const (pure [])
    }

-- | A program with its imports replaced, and the texts of all files.
data ImportedProgram = ImportedProgram
  { -- | the texts of the program and of all files read
    source :: Source,
    -- | the program with its imports replaced
    surface :: Result Error Error Program,
    -- | the regions of the names of imported files and table files, with the paths of these files
    imports :: [(Region, Text)],
    -- | the glyphs of the texts in fonts
    glyphRuns :: GlyphRuns
  }

-- | The results so far, while files are being read.
data Progress = Progress
  { -- | the texts of the files read
    texts :: Source,
    -- | the identities of the program and of the imported files read so far
    seen :: Set FilePath,
    -- | the mistakes, the newest first
    found :: [Error],
    -- | the remarks about drawings, the newest first
    noted :: [Error],
    -- | the drawings read so far, by their paths and the units that statements give them; Nothing
    -- for one with a mistake
    drawings :: Map (FilePath, Maybe LengthUnit) (Maybe DrawingText),
    -- | the glyphs of the texts in fonts so far
    runs :: GlyphRuns,
    -- | the outlines of these glyphs
    outlined :: FromFont.KnownGlyphs,
    -- | the regions of the names of imported files and table files, with the paths of these files,
    -- the newest first
    named :: [(Region, Text)],
    -- | the units of the imported files, by the offsets of their first characters
    unitsFound :: Map Int (Maybe LengthUnit)
  }

-- | Reads a program and the files that it imports. The path of the program appears in reports. The
-- path of an import is relative to the folder of the file that contains the import.
load :: Monad m => Reader m -> FilePath -> Text -> m ImportedProgram
load reader path text = do
  itself <- identity reader (simplified path)
  let Result {errors, output} = Parser.parse 0 text
      begin =
        Progress
          { texts = Region.fromText (Text.pack path) text,
            seen = Set.singleton itself,
            found = [],
            noted = [],
            drawings = Map.empty,
            runs = Map.empty,
            outlined = Map.empty,
            named = [],
            unitsFound = Map.empty
          }
  case output of
    Nothing ->
      pure
        ImportedProgram
          { source = texts begin,
            surface = Result [] errors Nothing,
            imports = [],
            glyphRuns = Map.empty
          }
    Just whole -> do
      let chain =
            Chain {open = [(itself, simplified path)], file = path, unitAt = FileUnit.unitAt whole}
      (statements', progress) <-
        runStateT (replaceImports reader chain (statements whole)) begin
      pure
        ImportedProgram
          { source = texts progress,
            surface =
              Result
                (reverse (noted progress))
                (errors <> FileUnit.misplaced (statements whole) <> reverse (found progress))
                (Just whole {statements = statements', units = units whole <> unitsFound progress}),
            imports = reverse (named progress),
            glyphRuns = runs progress
          }

-- | The file whose statements are being read, and the files through which the program imports it.
-- An import of a file that is in this chain already is an import cycle.
data Chain = Chain
  { -- | the identity and the path of each file: the file being read is the first of the list, the
    -- program the last
    open :: [(FilePath, FilePath)],
    -- | the path of the file being read
    file :: FilePath,
    -- | the unit of a number without one, at a region of the file
    unitAt :: Region -> LengthUnit
  }

-- | The file that an @import@ statement names: the region of the name, the name as written, the
-- path of the file and its identity.
data ImportedFile = ImportedFile
  { importRegion :: Region,
    importName :: Text,
    importPath :: FilePath,
    importIdentity :: FilePath
  }

-- | Replaces each import in the statements of a file by definitions, and each name of a table file
-- by the lines of the table.
replaceImports :: Monad m => Reader m -> Chain -> [Statement] -> StateT Progress m [Statement]
replaceImports reader chain = fmap concat . mapM replace
  where
    replace s = case s of
      Located _ (Import (Located at name)) -> do
        path <- namedPath chain at name
        itself <- lift (identity reader path)
        importFile
          reader
          chain
          ImportedFile
            { importRegion = at,
              importName = name,
              importPath = path,
              importIdentity = itself
            }
      Located region (Table name (LinesFromFile (Located at file))) -> do
        path <- namedPath chain at file
        rows <- tableLines reader at path file
        pure
          [ case rows of
              Just ls -> Located region (Table name (WrittenLines ls))
              Nothing -> Located region (Broken (Just "table") (Just name))
          ]
      Located region (Table name (LinesFromDrawing part)) -> do
        rows <- fromDrawing reader chain part $ \text nameAt chosen ->
          FromDrawing.tableLines text nameAt chosen
        let table = maybe (Broken (Just "table") (Just name)) (Table name . WrittenLines) rows
        pure [Located region table]
      Located region (Drawn asked name part) -> do
        made <- fromDrawing reader chain part $ \text nameAt chosen ->
          FromDrawing.contours text region nameAt asked name chosen
        pure (fromMaybe [Located region (Broken (Just "contour") (Just name))] made)
      Located region (DrawnText name font text _) -> do
        made <- fromFont reader chain name font text
        pure [Located region (fromMaybe (Broken (Just "contours") (Just name)) made)]
      _ -> pure [s]

-- | The statement of a text in a font, with the shapes of its letters. Records mistakes; 'Nothing'
-- if there are any.
fromFont ::
  Monad m =>
  Reader m ->
  Chain ->
  Located Name ->
  Located Text ->
  Lettering ->
  StateT Progress m (Maybe Statement_)
fromFont reader chain name font@(Located at file) text = do
  path <- namedPath chain at file
  answer <-
    if FileFormat.isFont file
      then Just <$> lift (glyphs reader path (value (lettered text)))
      else pure Nothing
  case answer of
    Nothing -> mistakes' [NotAFont at file]
    Just (Left reason) -> do
      near <- lift (neighbour reader path file [".ttf", ".otf", ".ttc"] [])
      Nothing <$ modify' (\p -> p {found = FileMissing at "font" file reason near : found p})
    Just (Right run) -> do
      modify' (\p -> p {runs = Map.insert (path, value (lettered text)) run (runs p)})
      known <- gets outlined
      case FromFont.shapes known path font text run of
        Left faults -> mistakes' faults
        Right (known', made) ->
          Just (DrawnText name font text made) <$ modify' (\p -> p {outlined = known'})
  where
    mistakes' faults = recorded (Converted (map InFont faults) [] Nothing)

-- | Result of @make@ for a part of a drawing, from the drawing, the region of the name of its
-- file, the distance of ends that are joined, and the chosen entities. Records mistakes and
-- remarks; 'Nothing' if there are mistakes.
fromDrawing ::
  Monad m =>
  Reader m ->
  Chain ->
  DrawingReference ->
  (DrawingText -> Region -> (Mm, [Entity]) -> Converted a) ->
  StateT Progress m (Maybe a)
fromDrawing reader chain part make = do
  path <- namedPath chain at name
  read' <- drawingText reader part path
  case (,) <$> read' <*> pure (FromDrawing.distance (unitAt chain at) (joinedWithin part)) of
    Nothing -> pure Nothing
    Just (_, Left fault) -> recorded (Converted [fault] [] Nothing)
    Just (text, Right tolerance) -> do
      let remarks = FromDrawing.remarksIn text (selection part)
      recorded $ case FromDrawing.chosenFrom at (selection part) (drawing text) of
        Left fault -> Converted [fault] remarks Nothing
        Right chosen ->
          let made = make text at (tolerance, chosen)
           in made {notes = remarks <> notes made, given = Just (given made)}
  where
    Located at name = drawingFile part

-- | Records the mistakes and the remarks of what a drawing gives, the same remark once. 'Nothing'
-- if there are mistakes.
recorded :: Monad m => Converted (Maybe a) -> StateT Progress m (Maybe a)
recorded Converted {mistakes, notes, given} = do
  modify' $ \p ->
    p
      { found = reverse (map InDrawing mistakes) <> found p,
        noted = foldl withNote (noted p) (map InDrawing notes)
      }
  pure (if null mistakes then given else Nothing)
  where
    withNote before note = if note `elem` before then before else note : before

-- | The drawing that a part of a drawing names, by its path. It is read once for each unit that
-- statements give it. Records its mistakes and remarks; 'Nothing' if it cannot be read.
drawingText ::
  Monad m => Reader m -> DrawingReference -> FilePath -> StateT Progress m (Maybe DrawingText)
drawingText reader part path = do
  known <- gets (Map.lookup key . drawings)
  case known of
    Just before -> pure before
    Nothing -> do
      content <- lift (bytes reader path)
      result <- case content of
        Left reason -> do
          near <- lift (neighbour reader path name [".dxf", ".svg"] [])
          Nothing <$ modify' (\p -> p {found = FileMissing at "drawing" name reason near : found p})
        Right content' -> do
          progress <- get
          let begin = Region.nextOffset (texts progress)
              shown = Encoding.decodeLatin1 content'
              (faults, remarks, made) =
                FromDrawing.fromBytes (drawingFile part) unit (begin, shown) content'
          put
            progress
              { texts = Region.addFile (Text.pack path) shown (texts progress),
                found = reverse (map InDrawing faults) <> found progress,
                noted = reverse (map InDrawing remarks) <> noted progress
              }
          pure made
      result <$ modify' (\p -> p {drawings = Map.insert key result (drawings p)})
  where
    Located at name = drawingFile part
    unit = value <$> drawingUnit part
    key = (path, unit)

-- | Records that the file being read names another file at the region @at@. Gives the path of the
-- other file, whose name is relative to the folder of the file being read.
namedPath :: Monad m => Chain -> Region -> Text -> StateT Progress m FilePath
namedPath chain at name = do
  let path = simplified (takeDirectory (file chain) </> Text.unpack name)
  modify' (\p -> p {named = (at, Text.pack path) : named p})
  pure path

-- | The definitions of an imported file. The list is empty if another import has already read the
-- file. If the file cannot be imported, the list has one broken statement, and the error is
-- recorded.
importFile :: Monad m => Reader m -> Chain -> ImportedFile -> StateT Progress m [Statement]
importFile reader chain i
  | Just firstPath <- lookup (importIdentity i) (open chain) =
    let between = map snd (takeWhile ((/= importIdentity i) . fst) (open chain))
        cycle' = reverse (importPath i : between <> [firstPath])
     in failed (importRegion i) (ImportCycle (importRegion i) (map Text.pack cycle'))
  | length (open chain) > maxDepth =
    failed (importRegion i) (ImportTooDeep (importRegion i) (importName i) maxDepth)
  | otherwise = do
    isKnown <- gets (Set.member (importIdentity i) . seen)
    if isKnown
      then pure []
      else
        if takeExtension (importPath i) == ".sheet"
          then failed (importRegion i) (ImportOfSheet (importRegion i) (importName i))
          else readProgram reader chain i

-- | Reads an imported program and gives its definitions.
readProgram :: Monad m => Reader m -> Chain -> ImportedFile -> StateT Progress m [Statement]
readProgram reader chain i = do
  content <- lift (contents reader (importPath i))
  case content of
    Left reason -> do
      near <- lift (neighbour reader (importPath i) (importName i) [".part"] (map snd (open chain)))
      failed (importRegion i) (ImportMissing (importRegion i) (importName i) reason near)
    Right text -> do
      progress <- get
      let Result {errors, output} = Parser.parse (Region.nextOffset (texts progress)) text
      put
        progress
          { texts = Region.addFile (Text.pack (importPath i)) text (texts progress),
            seen = Set.insert (importIdentity i) (seen progress),
            found =
              reverse (errors <> maybe [] (FileUnit.misplaced . statements) output)
                <> found progress,
            unitsFound = maybe Map.empty units output <> unitsFound progress
          }
      filter isDefinition
        <$> replaceImports
          reader
          Chain
            { open = (importIdentity i, importPath i) : open chain,
              file = importPath i,
              unitAt = maybe (unitAt chain) FileUnit.unitAt output
            }
          (maybe [] statements output)

-- | Reads the lines of a table from the file that is named at the region @at@. Records the errors;
-- 'Nothing' if there are any. A file that several tables name is read for each of them, so that the
-- lines of each table have regions of their own.
tableLines ::
  Monad m =>
  Reader m ->
  Region ->
  FilePath ->
  Text ->
  StateT Progress m (Maybe [TableLine])
tableLines reader at path name = do
  content <- lift (contents reader path)
  case content of
    Left reason -> do
      near <- lift (neighbour reader path name [".csv", ".txt"] [])
      Nothing <$ modify' (\p -> p {found = FileMissing at "table" name reason near : found p})
    Right text -> do
      progress <- get
      let (errors, rows) = Csv.table (Region.nextOffset (texts progress)) text
      put
        progress
          { texts = Region.addFile (Text.pack path) text (texts progress),
            found = reverse errors <> found progress
          }
      pure (if null errors then Just rows else Nothing)

-- | The file that may be meant by a name for which there is no file: the name of the nearest file
-- in the same folder, written like the given name. It has the extension of the name, or else one of
-- the given ones, the more likely ones first. It is none of the files @others@.
neighbour :: Monad m => Reader m -> FilePath -> Text -> [String] -> [FilePath] -> m (Maybe Text)
neighbour reader path name extensions others = do
  listed <- listing reader (takeDirectory path)
  let own = takeFileName path
      files = filter (`notElem` map takeFileName others) listed
      likely = takeExtension own : filter (/= takeExtension own) extensions
      candidates e = [Text.pack (dropExtension f) | f <- files, takeExtension f == e]
      near =
        [ base <> Text.pack e
          | e <- likely,
            base <- take 1 (Name.nearest (Text.pack (dropExtension own)) (candidates e))
        ]
      folder = Text.dropEnd (length own) name
  pure (if own `elem` files then Nothing else (folder <>) <$> listToMaybe near)

-- | Records an error of an import and gives a broken statement instead of the imported definitions.
-- A name that the import would define is then no further error: in a program with a broken
-- statement, checking does not report names without a definition.
failed :: Monad m => Region -> Error -> StateT Progress m [Statement]
failed at e =
  [Located at (Broken (Just "import") Nothing)] <$ modify' (\p -> p {found = e : found p})

-- | The largest depth of imports. The files that the program itself imports have the depth 1, those
-- that they import the depth 2.
maxDepth :: Int
maxDepth = 100

-- | Tells if a statement is a definition, which an import keeps. A broken statement, that is one
-- with a mistake, counts as a definition in two cases: if the parser could read the name that it
-- was to define, and if it is an import.
isDefinition :: Statement -> Bool
isDefinition (Located _ s) = case s of
  LetValue _ _ -> True
  LetFunction {} -> True
  Param _ _ -> True
  Contour {} -> True
  Drawn {} -> True
  DrawnText {} -> True
  Table _ _ -> True
  Curve _ _ -> True
  Piece {} -> True
  Broken _ (Just _) -> True
  Broken (Just "import") _ -> True
  _ -> False

-- | Removes from a path each @.@, and each name of a folder together with a @..@ after it. So
-- different spellings of a path become equal.
simplified :: FilePath -> FilePath
simplified path = if null parts then "." else joinPath parts
  where
    parts = foldl step [] (splitDirectories (normalise path))
    step before part = case (part, reverse before) of
      (".", _) -> before
      ("..", final : rest) | final /= ".." && not (isAbsolute final) -> reverse rest
      _ -> before <> [part]
