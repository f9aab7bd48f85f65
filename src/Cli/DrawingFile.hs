-- | Files of drawings. A picture is SVG; a file whose name ends in @.png@ or @.pdf@ is converted by
-- a renderer, which is another program on this computer. A drawing for CAD programs is DXF or SVG.
module Cli.DrawingFile
  ( writeDrawing,
    writePages,
    writeExport,
  )
where

import Cli.Error (Error (..))
import Cli.Outcome (failWith)
import Cli.Output (Exit, Reporter)
import Cli.OutputFile (unlessSource, writeBytes, writeText)
import Cli.Progress qualified as Progress
import Control.Exception (IOException, bracket, try)
import Control.Monad (zipWithM_)
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.Char (toLower)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Export.CadDrawing (CadDrawing)
import Export.Dxf qualified as Dxf
import Export.Svg qualified as Svg
import System.Directory
  ( findExecutable,
    getTemporaryDirectory,
    removeDirectoryRecursive,
  )
import System.Exit (ExitCode (..))
import System.FilePath (takeExtension, (</>))
import System.Posix.Temp (mkdtemp)
import System.Process (readProcessWithExitCode)

-- | Form of a file that a renderer makes.
data RenderedForm = Png | Pdf

-- | Form of a file.
data Form
  = Svg
  | Rendered RenderedForm
  | -- | none: the ending of the name is that of something else
    NoForm Text

-- | Writes a drawing to the file @wanted@, or to standard output if this is nothing or @-@. The
-- name of the file determines its form. @name@ is the program's name in reports. @sources@ are the
-- files that must not be replaced.
writeDrawing :: Reporter -> Text -> [FilePath] -> Maybe FilePath -> Text -> IO Exit
writeDrawing reporter name sources wanted svg = writePages reporter name sources wanted svg [svg]

-- | Does the same for a drawing of several pages, which are pages of their own in a PDF. @whole@
-- has all of them, one below the other.
writePages :: Reporter -> Text -> [FilePath] -> Maybe FilePath -> Text -> [Text] -> IO Exit
writePages reporter name sources wanted whole pages = case wanted of
  Just path
    | NoForm ending <- formOf path ->
      unlessSource
        reporter
        name
        sources
        path
        (failWith reporter name (NoSuchForm ending ".svg, .png or .pdf"))
  Just path | Rendered form <- formOf path -> do
    let drawings = case form of
          Pdf -> pages
          Png -> [whole]
    rendered <- Progress.during ("converting " <> Text.pack path) (render form drawings)
    case rendered of
      Left e -> failWith reporter name e
      Right bytes -> writeBytes reporter name sources path bytes
  _ -> writeText reporter name sources wanted whole

-- | Writes a drawing for CAD programs, as DXF or SVG by the ending of the name. Without an ending,
-- and on standard output, it is DXF. The arguments are those of 'writeDrawing'.
writeExport :: Reporter -> Text -> [FilePath] -> Maybe FilePath -> CadDrawing -> IO Exit
writeExport reporter name sources wanted drawing = case wanted of
  Nothing -> written (Dxf.document drawing)
  Just "-" -> written (Dxf.document drawing)
  Just path -> case map toLower (takeExtension path) of
    "" -> written (Dxf.document drawing)
    ".dxf" -> written (Dxf.document drawing)
    ".svg" -> written (Svg.document drawing)
    _ ->
      unlessSource
        reporter
        name
        sources
        path
        (failWith reporter name (NoSuchForm (Text.pack (takeExtension path)) ".dxf or .svg"))
  where
    written = writeText reporter name sources wanted

-- | Form of a file by the ending of its name. A name without an ending means SVG.
formOf :: FilePath -> Form
formOf path = case map toLower (takeExtension path) of
  "" -> Svg
  ".svg" -> Svg
  ".png" -> Rendered Png
  ".pdf" -> Rendered Pdf
  _ -> NoForm (Text.pack (takeExtension path))

-- | Converts the pages of a drawing by the first renderer that can do it.
render :: RenderedForm -> [Text] -> IO (Either Error ByteString)
render form drawings = do
  result <- try (bracket folder removeDirectoryRecursive convert)
  pure (either failed id result)
  where
    folder = getTemporaryDirectory >>= \parent -> mkdtemp (parent </> "partc-")
    convert inside = do
      let files = [inside </> "drawing" <> n <> ".svg" | n <- "" : map show [2 .. length drawings]]
      zipWithM_ (\file -> ByteString.writeFile file . Encoding.encodeUtf8) files drawings
      ByteString.writeFile (inside </> "drawing.html") (Encoding.encodeUtf8 (framed drawings))
      let first = Text.concat (take 1 drawings)
      attempt (outputOf form inside) Nothing (renderers form inside files first)
    failed :: IOException -> Either Error ByteString
    failed = Left . RendererFails . Text.pack . show

-- | Tries renderers one after the other until one has written the file @out@. Each is the name of
-- a program with its arguments. @before@ is the failure of an earlier one.
attempt :: FilePath -> Maybe Error -> [(FilePath, [String])] -> IO (Either Error ByteString)
attempt out before candidates = case candidates of
  [] -> pure (Left (fromMaybe NoRenderer before))
  (program, arguments) : others -> do
    found <- findExecutable program
    case found of
      Nothing -> attempt out before others
      Just executable -> do
        (code, _, complaint) <- readProcessWithExitCode executable arguments ""
        written <- try (ByteString.readFile out)
        case (code, written) of
          (ExitSuccess, Right bytes) | not (ByteString.null bytes) -> pure (Right bytes)
          (_, Left e) -> next (complaint <> show (e :: IOException))
          (_, Right _) -> next complaint
    where
      next complaint = attempt out (Just (RendererFails (said complaint))) others
      said complaint =
        Text.pack program
          <> ": "
          <> Text.strip (Text.takeWhile (/= '\n') (Text.strip (Text.pack complaint)))

-- | File in a folder that the renderers write. Browsers want the ending of its form.
outputOf :: RenderedForm -> FilePath -> FilePath
outputOf form inside =
  inside </> case form of
    Png -> "drawing.png"
    Pdf -> "drawing.pdf"

-- | Renderers, the preferred one first, with the arguments by which each converts the drawing in a
-- folder, whose pages are in these files. The pixels of a PNG are 1/200 inch wide. Inkscape makes
-- one page only.
renderers :: RenderedForm -> FilePath -> [FilePath] -> Text -> [(FilePath, [String])]
renderers form inside files first =
  ("rsvg-convert", ["--unlimited", "-d", "200", "-p", "200", "-f", word, "-o", out] <> files) :
  [ ("inkscape", ["--export-type=" <> word, "--export-dpi=200", "--export-filename=" <> out, file])
    | [file] <- [files]
  ]
    <> [ ("chromium", browser <> browserOutput <> ["file://" <> inside </> "drawing.html"])
       ]
  where
    out = outputOf form inside
    word = drop 1 (takeExtension out)
    -- The browser shows nothing but this drawing, so it needs no sandbox. As root it would refuse
    -- to start with one.
    browser = ["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"]
    browserOutput = case form of
      Pdf -> ["--no-pdf-header-footer", "--print-to-pdf=" <> out]
      Png ->
        [ "--screenshot=" <> out,
          "--force-device-scale-factor=2.0833",
          "--window-size=" <> pixels "width" <> "," <> pixels "height"
        ]
    pixels side = show (ceiling (millimetres side first * 96 / 25.4) :: Int)

-- | Page of a browser that contains the pages of a drawing, without margins and in their true size.
framed :: [Text] -> Text
framed drawings =
  "<!DOCTYPE html><html><head><meta charset=\"utf-8\"><style>@page { size: "
    <> size "width"
    <> " "
    <> size "height"
    <> "; margin: 0 } body { margin: 0 } svg { display: block }</style></head><body>"
    <> Text.concat (map (snd . Text.breakOn "<svg") drawings)
    <> "</body></html>"
  where
    size side = Text.pack (show (millimetres side (Text.concat (take 1 drawings)))) <> "mm"

-- | Width or height of a drawing in mm.
millimetres :: Text -> Text -> Double
millimetres side svg = case reads (Text.unpack (Text.takeWhile (/= 'm') value)) of
  [(mm, "")] -> mm
  _ -> 210
  where
    value = Text.drop (Text.length key) (snd (Text.breakOn key svg))
    key = " " <> side <> "=\""
