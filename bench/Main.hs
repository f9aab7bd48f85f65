-- | The benchmark: the offset kernel and its peers, the stages of the compiler, the whole compiler
-- and LinuxCNC's interpreter.
--
-- scripts/bench.sh starts it as @bench PAGE FOLDER NAME=VALUE…@. It prints its progress and writes
-- its tables between the markers of the page.
module Main (main) where

import Control.Monad (forM_, unless, when)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.IO qualified as Text
import Kernels (Peers (..))
import Kernels qualified
import Peer (Peer (Peer))
import Peer qualified
import Programs (Kind (..))
import System.Environment (getArgs)
import System.Exit (die)
import System.FilePath ((</>))
import Table qualified
import Text.Read (readMaybe)
import Whole (Tools (..))
import Whole qualified

main :: IO ()
main = do
  arguments <- getArgs
  case arguments of
    page : folder : options ->
      run page folder [(name, drop 1 value) | o <- options, let (name, value) = break (== '=') o]
    _ -> die "bench PAGE FOLDER NAME=COMMAND…"

-- | The font of the V-carved letters.
boldFont :: FilePath
boldFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf"

-- | Runs the benchmark. The options are commands that are required (kernel, stages, pulses, partc,
-- cost) and optional (cavalier, chords, rs274), and the following. parts: the parts of the
-- benchmark to run. most: the largest number of segments and elements. seconds: the longest
-- expected time of a run of the stages. about: lines about the machine. before: the build folder
-- of an earlier state, which takes turns with this one.
run :: FilePath -> FilePath -> [(String, String)] -> IO ()
run page folder options = do
  place "machine" (Text.unlines ["- " <> l | l <- Text.lines (Text.pack (option "about" ""))])
  when ("kernel" `elem` parts) $ do
    (tables, broken) <- Kernels.compared (folder </> "contours") most peers
    forM_ tables (uncurry place)
    let notes = if null broken then ["Nothing differs."] else map ("- " <>) broken
    place "differences" (Text.unlines notes)
  when ("stages" `elem` parts) $ Whole.staged tools most seconds >>= place "stages"
  when ("mills" `elem` parts) $ Whole.doubled tools >>= place "mills"
  when ("stock" `elem` parts) $ Whole.stocked tools (folder </> "programs") >>= place "stock"
  when ("letters" `elem` parts) $
    Whole.lettered tools (folder </> "programs") boldFont
      >>= place "letters"
  when ("controllers" `elem` parts) $
    Peer.command 600 [option "pulses" "pulses"] >>= either (die . Text.unpack) (place "controllers")
  forM_ (lookup "before" options) $ \earlier -> do
    ratios <- Whole.besideBefore tools (earlier </> "build/stages/stages") most
    place "before" ratios
  when ("whole" `elem` parts) $
    Whole.besideInterpreter tools (folder </> "programs") (programs most) (2 * seconds)
      >>= place "whole"
  where
    option name otherwise' = fromMaybe otherwise' (lookup name options)
    parts = words (option "parts" "kernel stages mills stock letters controllers whole")
    most = fromMaybe 1000000 (readMaybe (option "most" ""))
    seconds = fromMaybe 20 (readMaybe (option "seconds" "")) :: Double
    place :: Text -> Text -> IO ()
    place name text = do
      Text.putStrLn ("\n" <> name <> "\n" <> text)
      found <- Table.replace page name text
      unless found (die ("the page has no place for " <> Text.unpack name))
    peers =
      Peers
        { ours = Peer "ours" (words (option "kernel" "kernel")),
          arcPeers =
            [Peer "cavalier_contours" (words c) | Just c <- [lookup "cavalier" options]]
              <> [ Peer "before" [earlier </> "build/kernel/kernel"]
                   | Just earlier <- [lookup "before" options]
                 ],
          chordPeers =
            [ \sagitta -> Peer title (words c <> [library, show sagitta])
              | Just c <- [lookup "chords" options],
                (title, library) <- [("GEOS", "geos"), ("Clipper2", "clipper2")]
            ]
        }
    tools =
      Tools
        { timer = option "stages" "stages",
          partc = option "partc" "partc",
          cost = words (option "cost" "cost.py"),
          interpreter = lookup "rs274" options
        }

-- | The programs for the whole compiler.
programs :: Int -> [(Kind, Int)]
programs most =
  [ (k, n)
    | (k, n) <-
        [ (k, n)
          | k <- [Corners, Lobes, Rows, Wavy, ArcsFile, LinesFile, CornersFile, HolesFile],
            n <- [10000, 100000]
        ]
          <> [(LinesFile, 1000000)],
      n <= most
  ]
