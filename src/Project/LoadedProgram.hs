-- | A part program with the files that belong to it: imported files, table files, and the machine
-- descriptions that it names. An input sheet, a list of numbers for the Minsk-22 system, is
-- converted to a part program when it is loaded.
--
-- Nothing here reads the disk: a 'Surface.Reader', which the caller supplies, gives the texts.
-- Names are resolved and values are computed by later compiler passes.
module Project.LoadedProgram
  ( LoadedProgram (..),
    load,
    fromText,
    isInputSheet,
    isProgram,
    withoutSurface,
  )
where

import Base.Region (Located (..), Region, Source)
import Base.Region qualified as Region
import Base.Result (Result (..), mapErrors)
import Data.Containers.ListUtils (nubOrd)
import Data.Functor.Identity (runIdentity)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Project.MachineDescription (Descriptions)
import Project.MachineDescription qualified as MachineDescription
import Report.Report (Report)
import Sheet.Error qualified as Sheet
import Sheet.FromText qualified as Sheet
import Sheet.ToSurface qualified as Sheet
import Surface.Error qualified as Surface
import Surface.Import qualified as Surface
import Surface.Syntax qualified as Surface
import System.FilePath (normalise, takeDirectory, takeExtension, (</>))

-- | A part program and its files.
data LoadedProgram = LoadedProgram
  { -- | the texts of the program, its imports and its table files; reports find the line and the
    -- column of a region in them
    source :: Source,
    -- | the syntax tree of the program, in which each import is replaced by the imported
    -- definitions, and each name of a table file by the lines of the table
    surface :: Result Report Report Surface.Program,
    -- | true for an input sheet
    isSheet :: Bool,
    -- | the regions of the names of imports and of table files, with the paths of these files
    imports :: [(Region, Text)],
    -- | the glyphs of the texts in fonts
    glyphRuns :: Surface.GlyphRuns,
    -- | the machine descriptions that the program names
    descriptions :: Descriptions,
    -- | the paths of the imports, the table files and the machine descriptions
    files :: [Text],
    -- | the paths of the program, the imports and the table files, each with the identity of the
    -- file: the same path for all paths that lead to the same file
    identities :: [(Text, Text)]
  }

-- | Loads a program or an input sheet with the text @text@. Reports name it by @path@. A machine
-- description is looked for in the folder of @path@. An imported file or a table file is looked for
-- in the folder of the file that names it.
load :: Monad m => Surface.Reader m -> FilePath -> Text -> m LoadedProgram
load reader path text
  | isInputSheet path = pure (fromInputSheet path text)
  | otherwise = do
    loaded <- Surface.load reader path text
    found <-
      traverse
        (MachineDescription.load (Surface.contents reader) (takeDirectory path))
        (maybe [] describedMachines (output (Surface.surface loaded)))
    identities <-
      traverse
        (\p -> (p,) . Text.pack <$> Surface.identity reader (Text.unpack p))
        (nubOrd (Text.pack path : map snd (Surface.imports loaded)))
    let paths = [Text.pack (takeDirectory path </> Text.unpack name) | (name, _) <- found]
        (source, descriptions) =
          MachineDescription.placed (Surface.source loaded) (map normal paths) found
        normal = Text.pack . normalise . Text.unpack
    pure
      LoadedProgram
        { source,
          surface = mapErrors Surface.toReport Surface.toReport (Surface.surface loaded),
          isSheet = False,
          imports = Surface.imports loaded,
          glyphRuns = Surface.glyphRuns loaded,
          descriptions,
          files = map snd (Surface.imports loaded) <> paths,
          identities
        }

-- | The part program that an input sheet with the text @text@ describes.
fromInputSheet :: FilePath -> Text -> LoadedProgram
fromInputSheet path text =
  LoadedProgram
    { source = Region.fromText (Text.pack path) text,
      surface = Sheet.program <$> mapErrors id Sheet.toReport (Sheet.read text),
      isSheet = True,
      imports = [],
      glyphRuns = Map.empty,
      descriptions = [],
      files = [],
      identities = [(Text.pack path, Text.pack path)]
    }

-- | The names of the machine description files that a program names.
describedMachines :: Surface.Program -> [Text]
describedMachines program =
  [ file
    | Located _ (Surface.Machine (Located _ (Surface.Described file))) <-
        Surface.statements program
  ]

-- | Loads a program that consists of the text @text@. Reports name it by @path@. The name of
-- another file in the program, such as an import, is an error, because no other file can be read.
fromText :: Text -> Text -> LoadedProgram
fromText path text = runIdentity (load withoutFiles (Text.unpack path) text)
  where
    withoutFiles = Surface.byName (const (pure (Left "only one text is looked at")))

-- | True if the file name means a program or an input sheet, and not a tape.
isProgram :: FilePath -> Bool
isProgram path = takeExtension path == ".part" || isInputSheet path

-- | True if the file name means an input sheet, that is, if it ends in @.sheet@.
isInputSheet :: FilePath -> Bool
isInputSheet = (== ".sheet") . takeExtension

-- | Drops the syntax tree, and the reports of its mistakes, to free memory. All other fields are
-- kept.
withoutSurface :: LoadedProgram -> LoadedProgram
withoutSurface loaded = loaded {surface = Result [] [] Nothing}
