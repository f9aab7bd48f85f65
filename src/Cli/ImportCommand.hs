-- | The subcommand @import@: part programs from input sheets and from drawings.
module Cli.ImportCommand
  ( ImportOptions (..),
    importOptions,
    importFile,
  )
where

import Base.Quantity (LengthUnit (..), Mm)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Base.Result qualified as Result
import Cli.InputFile (displayName, readBytes, readProgram)
import Cli.OptionReader (choice, joiningDistance)
import Cli.Outcome (failWith)
import Cli.Output (Exit (..), Reporter)
import Cli.Output qualified as Output
import Cli.OutputFile (writeText)
import Control.Applicative (many, optional)
import Data.List (intercalate)
import Data.Maybe (fromMaybe, isJust)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Drawing.FileFormat (formatOf)
import Drawing.OutlineTolerance qualified as Tolerance
import Options.Applicative qualified as Opt
import Report.Report (Report)
import Sheet.Error qualified as Sheet
import Sheet.FromText qualified as Sheet
import Sheet.ToSurface qualified as Sheet
import Surface.DrawingError qualified as DrawingError
import Surface.DrawingProgram qualified as DrawingProgram

-- | Choices of the subcommand @import@.
data ImportOptions = ImportOptions
  { -- | an input sheet, or a drawing by its name
    importedFile :: FilePath,
    -- | the unit of a drawing whose file does not give it
    statedUnit :: Maybe LengthUnit,
    -- | the largest distance of ends of a drawing that are joined
    joinedWithin :: Maybe Mm,
    -- | the layers of a drawing that are imported; all if none is named
    importedLayers :: [Text],
    -- | the program to write; absent for standard output
    programFile :: Maybe FilePath
  }
  deriving stock (Eq, Show)

-- | Parser of the options; @outputFile@ is that of the file to write.
importOptions :: Opt.Parser FilePath -> Opt.Parser ImportOptions
importOptions outputFile =
  ImportOptions
    <$> Opt.strArgument
      ( Opt.metavar "FILE"
          <> Opt.help "A drawing (.dxf, .svg) or an input sheet; - for a sheet on standard input"
          <> Opt.action "file"
      )
    <*> optional
      ( Opt.option
          (choice units)
          ( Opt.long "unit"
              <> Opt.metavar (intercalate "|" (map fst units))
              <> Opt.help "The unit of a drawing whose file does not give it"
              <> Opt.completeWith (map fst units)
          )
      )
    <*> optional
      ( Opt.option
          joiningDistance
          ( Opt.long "within"
              <> Opt.metavar "MM"
              <> Opt.help "The largest gap between ends of a drawing that are joined; usually 0.001"
          )
      )
    <*> many
      ( Opt.strOption
          ( Opt.long "layer"
              <> Opt.metavar "NAME"
              <> Opt.help "Import only this layer of a drawing; may be repeated"
          )
      )
    <*> optional outputFile
  where
    units = [("mm", Millimetres), ("in", Inches)]

-- | Converts an input sheet or a drawing to a part program.
importFile :: Reporter -> ImportOptions -> IO Exit
importFile reporter options
  | isJust (formatOf (Text.pack (importedFile options))) = importDrawing reporter options
  | otherwise = importSheet reporter (importedFile options) (programFile options)

importSheet :: Reporter -> FilePath -> Maybe FilePath -> IO Exit
importSheet reporter file wanted = do
  content <- readProgram file
  case content of
    Left e -> failWith reporter (displayName file) e
    Right text ->
      written reporter file wanted text $
        Sheet.text <$> Result.mapErrors id Sheet.toReport (Sheet.read text)

importDrawing :: Reporter -> ImportOptions -> IO Exit
importDrawing reporter options = do
  content <- readBytes file
  case content of
    Left e -> failWith reporter (displayName file) e
    Right bytes ->
      let shown = Encoding.decodeLatin1 bytes
       in written reporter file (programFile options) shown $
            Result.mapErrors DrawingError.toReport DrawingError.toReport $
              DrawingProgram.convert
                (displayName file)
                (statedUnit options)
                within
                (importedLayers options)
                shown
                bytes
  where
    file = importedFile options
    within = fromMaybe Tolerance.joining (joinedWithin options)

-- | Shows the reports, and writes the program if none of them stops the command. @text@ is the text
-- of the file.
written :: Reporter -> FilePath -> Maybe FilePath -> Text -> Result Report Report Text -> IO Exit
written reporter file wanted text result = do
  isStopped <-
    Output.showReports
      reporter
      (displayName file)
      (Region.fromText (displayName file) text)
      (errors result <> warnings result)
  case output result of
    Just made | not isStopped -> writeText reporter (displayName file) [file] wanted made
    _ -> pure Failed
