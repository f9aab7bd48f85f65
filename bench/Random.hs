-- | @random COUNT SEED FILE PEER [LIMIT [JUDGE]]@: writes COUNT random contours with their offsets
-- to a file, offsets them with a peer (bench/peers/cavalier, @areas@) and with the kernel, and
-- compares areas, lengths and numbers of loops. The peer answers twice, the second time with a
-- millionth of its tolerances; agreement with one of both answers is enough.
--
-- Differences are judged. The region beyond an offset is the limit of the regions beyond slightly
-- larger offsets, and those are in general position. So the peer answers again for slightly larger
-- and slightly smaller offsets, and an independent judge (bench/peers/judge.py) for a slightly
-- larger one. The kernel's answer is right if it is the limit of the larger offsets. The program
-- prints the number of differences of each class, and at most LIMIT of those that the judges do not
-- decide for the kernel.
--
-- @random - SEED INDEX@ prints one contour.
module Main (main) where

import Base.Quantity (Mm (..))
import ContourFile qualified
import Control.Monad (forM_, when)
import Data.ByteString.Builder qualified as Builder
import Data.List (zipWith4)
import Data.Maybe (fromMaybe, listToMaybe)
import Data.Primitive.PrimArray qualified as PrimArray
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.IO qualified as Text
import Data.Word (Word64)
import Equidistant qualified
import Geometry.FlatPolyarc (FlatPolyarc)
import Geometry.FlatPolyarc qualified as FlatPolyarc
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
    ["-", s, i]
      | Just seed <- readMaybe s,
        Just index <- readMaybe i ->
        printed (RandomContour.contour seed index)
    c : s : file : peer : rest
      | Just count <- readMaybe c,
        Just seed <- readMaybe s ->
        compared
          Task
            { seed,
              file,
              peer,
              limit = fromMaybe 20 (readMaybe =<< listToMaybe rest),
              judge = drop 1 rest
            }
          count
    _ -> die "random COUNT SEED FILE PEER [LIMIT [JUDGE]] or random - SEED INDEX"

-- | The offset, then x y bulge for each vertex.
printed :: (FlatPolyarc, Double) -> IO ()
printed (o, d) = do
  print d
  forM_ [0 .. PrimArray.sizeofPrimArray (FlatPolyarc.xs o) - 1] $ \i ->
    putStrLn
      ( unwords
          [ show (PrimArray.indexPrimArray a i)
            | a <- [FlatPolyarc.xs o, FlatPolyarc.ys o, FlatPolyarc.bulges o]
          ]
      )

-- | The arguments of the program: the seed, the file to write, the peer's program, the largest
-- number of contours to print, and the judge's program with its arguments (empty without a judge).
data Task = Task
  { seed :: Word64,
    file :: FilePath,
    peer :: FilePath,
    limit :: Int,
    judge :: [String]
  }

-- | The measures of an offset: area in mm², length in mm, numbers of closed loops and open
-- polyarcs.
data Sums = Sums {area :: Double, long :: Double, loops :: Int, open :: Int}

-- | All answers for one contour, with its index: that of the kernel, both of the peer, and the
-- peer's answer for a slightly larger offset.
data Answer = Answer
  { index :: Int,
    ours :: Either Text Sums,
    theirs :: Sums,
    narrower :: Sums,
    larger :: Sums
  }

-- | Further answers for a contour: the peer's for a slightly smaller offset, and the judge's for a
-- slightly larger one.
data Beside = Beside {smaller :: Sums, judged :: Maybe Sums}

-- | The classes of differences.
data Class
  = -- | the kernel gives no answer
    Failed
  | -- | according to one of the judges, the kernel's answer is not the limit of larger offsets
    Undecided
  | -- | the kernel's answer is the limit of larger offsets, the peer's that of smaller ones
    Passage
  | -- | the kernel's answer is the limit of larger offsets, the peer's is not and has open sections
    Torn
  | -- | the kernel's answer is the limit of larger offsets, the peer's is neither that nor the
    -- limit of smaller ones
    Mixed
  | -- | both answers are the limit of larger offsets; they differ in their digits
    Digits
  deriving stock (Eq, Enum, Bounded)

named :: Class -> String
named c = case c of
  Failed -> "on which the kernel gives no answer"
  Undecided -> "not decided for the kernel"
  Passage ->
    "where the kernel is right and the peer gives the limit of smaller offsets: passages that the \
    \offset closes exactly are kept"
  Torn -> "where the kernel is right and the peer leaves pieces open"
  Mixed ->
    "where the kernel is right and the peer gives the limit of neither: some passages are kept, \
    \others closed"
  Digits -> "where both are right but for digits"

-- | Writes the contours, runs the peer, compares, runs the judges, prints the result.
compared :: Task -> Int -> IO ()
compared task count = do
  given <- answersOf task 1 (file task) [peer task, file task] indices
  second <- precise 1 "" indices
  largers <- precise (1 + nudge) ".larger" indices
  begin <- getCPUTime
  let found = zipWith4 (\i -> Answer i (kernels (seed task) i)) indices given second largers
      different = filter isDifferent found
      those = map index different
  end <- length different `seq` getCPUTime
  smallers <- precise (1 - nudge) ".smaller" those
  judgeds <- judgedAnswers task those
  let besides = zipWith Beside smallers judgeds
      classes = [(classOf task a b, a, b) | (a, b) <- zip different besides]
  mapM_
    (Text.putStrLn . line task)
    (take (limit task) [(a, b) | (c, a, b) <- classes, c == Failed || c == Undecided])
  printClasses count [(c, index a) | (c, a, _) <- classes]
  putStrLn
    ( show (length different)
        <> " of "
        <> show count
        <> " differ; "
        <> show ((end - begin) `div` 1000000000)
        <> " ms for ours"
    )
  where
    indices = [0 .. count - 1]
    -- The peer with small tolerances.
    precise factor ending =
      answersOf
        task
        factor
        (file task <> ending)
        [peer task, file task <> ending, "1e-11"]
    isDifferent a =
      not (same task a (theirs a) || same task a (narrower a)) || not (isLimit task a)

-- | The answers of the judge, if there is one.
judgedAnswers :: Task -> [Int] -> IO [Maybe Sums]
judgedAnswers task those
  | null (judge task) = pure (map (const Nothing) those)
  | otherwise = map Just <$> answersOf task (1 + chordNudge) judged (judge task <> [judged]) those
  where
    judged = file task <> ".judged"

-- | Prints the number of contours in each class, separately for the three kinds of contours.
printClasses :: Int -> [(Class, Int)] -> IO ()
printClasses count classes =
  forM_ [minBound ..] $ \c ->
    forM_ (zip [0 ..] ["on a grid", "with arcs", "noisy"]) $ \(kind, name) -> do
      let n = length [() | (c', i) <- classes, c' == c, i `mod` 3 == (kind :: Int)]
      when (n > 0) $
        putStrLn
          (name <> ": " <> show n <> " of " <> show ((count + 2 - kind) `div` 3) <> " " <> named c)

-- | The shares of the distance by which slightly larger and smaller offsets differ: for the peer,
-- and, larger, for a judge that uses chords.
nudge, chordNudge :: Double
nudge = 1e-8
chordNudge = 1e-7

-- | The answers of a command for contours. Writes the contours to a file, with their offsets
-- multiplied by a factor, and runs the command on this file.
answersOf :: Task -> Double -> FilePath -> [String] -> [Int] -> IO [Sums]
answersOf task factor to command those = do
  withBinaryFile to WriteMode $ \handle -> forM_ those $ \i -> do
    let (o, d) = RandomContour.contour (seed task) i
    Builder.hPutBuilder
      handle
      ( Builder.word64LE (fromIntegral (PrimArray.sizeofPrimArray (FlatPolyarc.xs o)))
          <> Builder.doubleLE (factor * d)
          <> ContourFile.builder o
      )
  printed' <- case command of
    program : arguments -> readProcess program arguments ""
    [] -> pure ""
  case traverse (sums . Text.words) (Text.lines (Text.pack printed')) of
    Just answers | length answers == length those -> pure answers
    _ -> die (unwords command <> ": its answers are not understood, or not as many as contours")
  where
    sums numbers = case numbers of
      [a, l, c, o] -> Sums <$> read' a <*> read' l <*> read' c <*> read' o
      _ -> Nothing
    read' :: Read a => Text -> Maybe a
    read' = readMaybe . Text.unpack

-- | The kernel's answer.
kernels :: Word64 -> Int -> Either Text Sums
kernels s i = case Equidistant.offset d source of
  Left why -> Left (Text.pack why)
  Right reach ->
    let result = Equidistant.outlines reach
     in Right
          Sums
            { area = sum (map FlatPolyarc.area result),
              long = sum [l | o <- result, let Mm l = FlatPolyarc.length o],
              loops = length result,
              open = 0
            }
  where
    (source, d) = RandomContour.contour s i

-- | Is the kernel's answer equal to another one but for rounding?
same :: Task -> Answer -> Sums -> Bool
same task a other = case ours a of
  Left _ -> False
  Right own ->
    loops own == loops other
      && open other == 0
      && near (abs (FlatPolyarc.area source)) (area own) (area other)
      && near around (long own) (long other)
  where
    (source, _) = RandomContour.contour (seed task) (index a)
    -- Rounding errors are relative to the size of the source.
    Mm around = FlatPolyarc.length source
    near least p q = abs (p - q) <= 1e-9 * maximum [abs p, abs q, least]

-- | Is the kernel's answer the limit of the peer's answers for larger offsets?
isLimit :: Task -> Answer -> Bool
isLimit task a = either (const False) (\own -> limitOf task a nudge own (larger a)) (ours a)

-- | Is one answer the limit of others? It has the same number of loops, and the relative difference
-- @by@ of the offsets explains the differences of area and length. Two tangent arcs of radius d
-- lose 4d√(2ε) of their lengths when both grow by the ratio ε; on a grid there are up to twenty
-- such pairs.
limitOf :: Task -> Answer -> Double -> Sums -> Sums -> Bool
limitOf task a by own other =
  loops own == loops other
    && open own == 0
    && abs (area own - area other) <= margin
    && abs (long own - long other) <= margin
  where
    (source, d) = RandomContour.contour (seed task) (index a)
    Mm around = FlatPolyarc.length source
    margin = 20 * (4 * abs d * sqrt (2 * by) + around * abs d * by)

classOf :: Task -> Answer -> Beside -> Class
classOf task a beside = case ours a of
  Left _ -> Failed
  Right own
    | not (limit' nudge own (larger a))
        || not (maybe True (limit' chordNudge own) (judged beside)) ->
      Undecided
    | any (\t -> limit' nudge t (larger a)) peers -> Digits
    | any (\t -> limit' nudge t (smaller beside)) peers -> Passage
    | all ((> 0) . open) peers -> Torn
    | otherwise -> Mixed
  where
    limit' = limitOf task a
    peers = [theirs a, narrower a]

line :: Task -> (Answer, Beside) -> Text
line task (a, beside) =
  Text.intercalate
    "; "
    ( ("contour " <> shown (index a) <> ", offset " <> shown d) :
      either ("the kernel fails: " <>) (described "ours") (ours a) :
      described "theirs" (theirs a) :
      described "narrower" (narrower a) :
      described "larger" (larger a) :
      described "smaller" (smaller beside) : maybe [] (pure . described "judge") (judged beside)
    )
  where
    (_, d) = RandomContour.contour (seed task) (index a)
    described who s =
      who
        <> " "
        <> Text.unwords
          [ shown (area s),
            shown (long s),
            shown (loops s) <> (if open s > 0 then "+" <> shown (open s) else "")
          ]

shown :: Show a => a -> Text
shown = Text.pack . show
