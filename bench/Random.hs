-- | @random COUNT SEED FILE PEER [LIMIT]@: writes so many random contours with their offsets to a file, lets a peer (bench/peers/cavalier,
-- @areas@) offset them, offsets them with the kernel, and lists those whose areas, lengths or numbers of loops differ. The peer
-- answers twice, the second time with a millionth of its tolerance for equal places: what agrees with one of both answers is not listed.
-- @random - SEED INDEX@ prints one contour.
module Main (main) where

import Base.Quantity (Mm (..))
import ContourFile qualified
import Control.Monad (forM_, when)
import Data.ByteString.Builder qualified as Builder
import Data.Maybe (catMaybes, fromMaybe)
import Data.Primitive.PrimArray qualified as PrimArray
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.IO qualified as Text
import Data.Word (Word64)
import Equidistant qualified
import Geometry.Outline (Outline)
import Geometry.Outline qualified as Outline
import RandomContour qualified
import System.CPUTime (getCPUTime)
import System.Environment (getArgs)
import System.Exit (die)
import System.IO (IOMode (..), withBinaryFile)
import System.Process (readProcess)
import Text.Read (readMaybe)

main :: IO ()
main = do
  arguments <- getArgs
  case arguments of
    ["-", s, i] | Just seed <- readMaybe s, Just index <- readMaybe i -> printed (RandomContour.contour seed index)
    c : s : file : peer : rest | Just count <- readMaybe c, Just seed <- readMaybe s -> compared count seed file peer (fromMaybe 20 (readMaybe =<< safeHead rest))
    _ -> die "random COUNT SEED FILE PEER [LIMIT] or random - SEED INDEX"
  where
    safeHead list = case list of
      a : _ -> Just a
      [] -> Nothing

-- | The offset, then x y bulge for each vertex.
printed :: (Outline, Double) -> IO ()
printed (o, d) = do
  print d
  forM_ [0 .. PrimArray.sizeofPrimArray (Outline.xs o) - 1] $ \i ->
    putStrLn (unwords [show (PrimArray.indexPrimArray a i) | a <- [Outline.xs o, Outline.ys o, Outline.bulges o]])

-- | What an offset comes to: area, length, closed loops, open pieces.
data Sums = Sums {area :: Double, long :: Double, loops :: Int, open :: Int}

-- | Write, let the peer work, compare.
compared :: Int -> Word64 -> FilePath -> FilePath -> Int -> IO ()
compared count seed file peer limit = do
  withBinaryFile file WriteMode $ \handle -> forM_ [0 .. count - 1] $ \i -> do
    let (o, d) = RandomContour.contour seed i
    Builder.hPutBuilder handle (Builder.word64LE (fromIntegral (PrimArray.sizeofPrimArray (Outline.xs o))) <> Builder.doubleLE d <> ContourFile.builder o)
  theirs <- answers []
  narrower <- answers ["1e-11"]
  begin <- getCPUTime
  found <- concat <$> traverse (\(i, a, b) -> judged seed i a b) (zip3 [0 ..] theirs narrower)
  end <- getCPUTime
  mapM_ Text.putStrLn (take limit [line | (_, _, line) <- found])
  forM_ (zip [0 ..] ["on a grid", "with arcs", "noisy"]) $ \(kind, name) ->
    putStrLn (name <> ": " <> show (length [() | (k, False, _) <- found, k == (kind :: Int)]) <> " of " <> show ((count + 2 - kind) `div` 3) <> " differ; where the peer returned open pieces, " <> show (length [() | (k, True, _) <- found, k == kind]))
  putStrLn (show ((end - begin) `div` 1000000000) <> " ms for ours")
  where
    answers more = do
      theirs <- map sums . Text.lines . Text.pack <$> readProcess peer (file : more) ""
      when (length theirs /= count) $ die ("the peer answers for " <> show (length theirs) <> " contours of " <> show count)
      pure theirs
    sums line = case Text.words line of
      [a, l, c, o] -> Sums <$> read' a <*> read' l <*> read' c <*> read' o
      _ -> Nothing
    read' :: Read a => Text -> Maybe a
    read' = readMaybe . Text.unpack

-- | How ours differs from both answers of the peer on a contour: its kind, whether the peer left pieces open, what to print.
judged :: Word64 -> Int -> Maybe Sums -> Maybe Sums -> IO [(Int, Bool, Text)]
judged seed index given narrower = case (given, Equidistant.offset d source) of
  (Nothing, _) -> pure [(index `mod` 3, True, place <> "what the peer printed is not understood")]
  (_, Left why) -> pure [(index `mod` 3, False, place <> "ours fails: " <> Text.pack why)]
  (Just theirs, Right result) -> do
    let ours = sumsOf (Equidistant.outlines result)
    let against other = catMaybes [differs "area" area' ours other, differs "length" long' ours other, if loops ours == loops other then Nothing else Just ("loops " <> shown (loops ours) <> ", theirs " <> shown (loops other))]
        lines' = if maybe False (null . against) narrower then [] else against theirs
    pure [(index `mod` 3, open theirs > 0, place <> Text.intercalate "; " lines' <> (if open theirs > 0 then "; open " <> shown (open theirs) else "")) | not (null lines')]
  where
    (source, d) = RandomContour.contour seed index
    -- What a result of rounding errors alone may come to is measured by the source.
    size = abs (Outline.area source)
    Mm around = Outline.length source
    area' = (area, size)
    long' = (long, around)
    place = "contour " <> shown index <> ", offset " <> shown d <> ": "
    differs name (part, least) a b =
      let (p, q) = (part a, part b)
       in if abs (p - q) <= 1e-9 * maximum [abs p, abs q, least] then Nothing else Just (name <> " " <> shown p <> ", theirs " <> shown q)

sumsOf :: [Outline] -> Sums
sumsOf result = Sums {area = sum (map Outline.area result), long = sum [l | o <- result, let Mm l = Outline.length o], loops = length result, open = 0}

shown :: Show a => a -> Text
shown = Text.pack . show
