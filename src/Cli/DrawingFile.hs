-- | Files of drawings. A drawing is SVG; a file whose name ends in @.png@ or @.pdf@ is converted by
-- a renderer, which is another program on this computer.
module Cli.DrawingFile
  ( writeDrawing,
  )
where

import Cli.Error (Error (..))
import Cli.Outcome (failWith)
import Cli.Output (Exit, Reporter)
import Cli.OutputFile (writeBytes, writeText)
import Cli.Progress qualified as Progress
import Control.Exception (IOException, bracket, try)
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.Char (toLower)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
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

-- | Writes a drawing to the file @wanted@, or to standard output if this is nothing or @-@. The
-- name of the file determines its form. @name@ is the program's name in reports. @sources@ are the
-- files that must not be replaced.
writeDrawing :: Reporter -> Text -> [FilePath] -> Maybe FilePath -> Text -> IO Exit
writeDrawing reporter name sources wanted svg = case wanted of
  Just path | Just form <- formOf path -> do
    rendered <- Progress.during ("converting " <> Text.pack path) (render form svg)
    case rendered of
      Left e -> failWith reporter name e
      Right bytes -> writeBytes reporter name sources path bytes
  _ -> writeText reporter name sources wanted svg

-- | Form of a file by the ending of its name; nothing for SVG.
formOf :: FilePath -> Maybe RenderedForm
formOf path = case map toLower (takeExtension path) of
  ".png" -> Just Png
  ".pdf" -> Just Pdf
  _ -> Nothing

-- | Converts a drawing by the first renderer that can do it.
render :: RenderedForm -> Text -> IO (Either Error ByteString)
render form svg = do
  result <- try (bracket folder removeDirectoryRecursive convert)
  pure (either failed id result)
  where
    folder = getTemporaryDirectory >>= \parent -> mkdtemp (parent </> "partc-")
    convert inside = do
      ByteString.writeFile (inside </> "drawing.svg") (Encoding.encodeUtf8 svg)
      ByteString.writeFile (inside </> "drawing.html") (Encoding.encodeUtf8 (framed svg))
      attempt (outputOf form inside) Nothing (renderers form inside svg)
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
-- folder. The pixels of a PNG are 1/200 inch wide.
renderers :: RenderedForm -> FilePath -> Text -> [(FilePath, [String])]
renderers form inside svg =
  [ ("rsvg-convert", ["--unlimited", "-d", "200", "-p", "200", "-f", word, "-o", out, source]),
    ( "inkscape",
      ["--export-type=" <> word, "--export-dpi=200", "--export-filename=" <> out, source]
    ),
    ("chromium", browser <> browserOutput <> ["file://" <> inside </> "drawing.html"])
  ]
  where
    (source, out) = (inside </> "drawing.svg", outputOf form inside)
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
    pixels side = show (ceiling (millimetres side svg * 96 / 25.4) :: Int)

-- | Page of a browser that contains a drawing, without margins and in its true size.
framed :: Text -> Text
framed svg =
  "<!DOCTYPE html><html><head><meta charset=\"utf-8\"><style>@page { size: "
    <> size "width"
    <> " "
    <> size "height"
    <> "; margin: 0 } body { margin: 0 } svg { display: block }</style></head><body>"
    <> snd (Text.breakOn "<svg" svg)
    <> "</body></html>"
  where
    size side = Text.pack (show (millimetres side svg)) <> "mm"

-- | Width or height of a drawing in mm.
millimetres :: Text -> Text -> Double
millimetres side svg = case reads (Text.unpack (Text.takeWhile (/= 'm') value)) of
  [(mm, "")] -> mm
  _ -> 210
  where
    value = Text.drop (Text.length key) (snd (Text.breakOn key svg))
    key = " " <> side <> "=\""
