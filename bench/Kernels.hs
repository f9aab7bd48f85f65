-- | The offset kernel compared with its peers: time, growth, memory, agreement.
module Kernels
  ( Peers (..),
    compared,
  )
where

import Base.Decimal qualified as Decimal
import ContourFile qualified
import Contours (Family (..))
import Contours qualified
import Control.Monad (forM)
import Data.List (sortOn)
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.IO qualified as Text
import Peer (Outcome (..), Peer)
import Peer qualified
import System.Directory (createDirectoryIfMissing)
import System.FilePath ((</>))
import System.IO (hFlush, stdout)
import Table qualified

-- | The compared programs: the kernel of partc, the peers that keep arcs, and the peers that use
-- chords only, each as a function of the sagitta in mm.
data Peers = Peers {ours :: Peer, arcPeers :: [Peer], chordPeers :: [Double -> Peer]}

-- | The outcomes for one contour and one distance. @exact@ are those of partc and of the peers with
-- arcs. @chorded@ and @finer@ are those of the peers with chords, at the coarse and the fine
-- sagitta; they are empty for contours for which these peers were not run.
data Case = Case
  { family :: Family,
    segments :: Int,
    distance :: Double,
    exact :: [Either Text Outcome],
    chorded :: [Either Text Outcome],
    finer :: [Either Text Outcome]
  }

-- | The sagittas of the chords in mm. Times are measured with the coarse one.
coarse, fine :: Double
coarse = 0.01
fine = 0.001

-- | Runs all cases up to about @most@ segments, with their files in a folder. Returns the tables,
-- each with the name of its markers in the page, and the violated expectations.
compared :: FilePath -> Int -> Peers -> IO ([(Text, Text)], [Text])
compared folder most peers = do
  createDirectoryIfMissing True folder
  cases <-
    sortOn (\c -> (fromEnum (family c), negate (distance c), segments c)) . concat
      <$> forM
        [(f, n) | f <- [minBound ..], n <- Contours.sizes f, 10 * n <= 11 * most]
        (uncurry (ofContour folder peers))
  pure
    ( [ ("times", timesOf peers cases),
        ("memory", memoryOf peers cases),
        ("agreement", agreement cases),
        ("chords", chordsOf peers cases)
      ],
      concatMap (broken (length (arcPeers peers))) cases
    )

-- | The cases of one contour, one for each distance.
ofContour :: FilePath -> Peers -> Family -> Int -> IO [Case]
ofContour folder peers family segments = do
  small <- written (Contours.small family)
  file <- written segments
  forM (Contours.distances family) (ofDistance peers family segments small file)
  where
    written n = do
      let file = folder </> Text.unpack (Contours.name family) <> "_" <> show n <> ".bin"
      ContourFile.write file (Contours.contour family n)
      pure file

-- | The case of one contour and one distance. The files contain the small contour for warming up
-- and the measured one.
ofDistance :: Peers -> Family -> Int -> FilePath -> FilePath -> Double -> IO Case
ofDistance peers family segments small file distance = do
  Text.putStr
    ( Text.unwords
        [ Contours.name family,
          signed distance <> ",",
          Decimal.whole segments,
          "segments:"
        ]
    )
  exact <- Peer.interleaved rounds small file distance runs batches (ours peers : arcPeers peers)
  chorded <- if isBearable then withChords coarse few' few' 1 else pure []
  finer <- if isMiddling then withChords fine 1 1 0 else pure []
  Text.putStrLn
    ( Text.concat
        [ "  " <> either (const "fails") (Table.number . perSegment segments) o
          | o <- exact <> chorded
        ]
    )
  hFlush stdout
  pure Case {family, segments, distance, exact, chorded, finer}
  where
    withChords sagitta rounds' runs' batches' =
      Peer.interleaved
        rounds'
        small
        file
        distance
        runs'
        batches'
        (map ($ sagitta) (chordPeers peers))
    few' = if isSmall then 3 else 1
    isSmall = segments <= 2000
    isMiddling = segments > 2000 && segments <= 20000
    isLargest = segments > 200000 || (family == FixedStar && segments > 20000)
    -- The peers with chords would need minutes for larger contours.
    isBearable = segments <= 200000 && (family /= FixedStar || segments <= 20000)
    (rounds, runs, batches)
      | isSmall = (5, 20, 5)
      | isMiddling = (3, 2, 3)
      | isLargest = (1, 1, 1)
      | otherwise = (3, 1, 2)

perSegment :: Int -> Outcome -> Double
perSegment segments o = Peer.middle (times o) / fromIntegral segments

signed :: Double -> Text
signed d =
  (if d > 0 then "+" else "−")
    <> (if abs d == fromIntegral whole then Decimal.whole whole else Decimal.fixed 1 (abs d))
  where
    whole = round (abs d) :: Int

label :: Case -> Text
label c = Contours.name (family c) <> " " <> signed (distance c)

-- | The cell of an outcome, which may be missing.
cell :: (Outcome -> Text) -> Maybe (Either Text Outcome) -> Text
cell shown = maybe "–" (either (const "fails") shown)

at :: Int -> [a] -> Maybe a
at i list = listToMaybe (drop i list)

timesOf :: Peers -> [Case] -> Text
timesOf peers cases =
  Table.table
    ( ["input", "segments", Peer.title (ours peers)]
        <> map Peer.title (arcPeers peers)
        <> map (Peer.title . ($ coarse)) (chordPeers peers)
        <> ["ours / " <> Peer.title k | k <- arcPeers peers]
        <> ["growth of " <> Peer.title p | p <- ours peers : arcPeers peers]
    )
    (map (\c -> row c (before c)) cases)
  where
    count = 1 + length (arcPeers peers)
    before c =
      foldl
        (\found x -> if label x == label c && segments x < segments c then Just x else found)
        Nothing
        cases
    row c earlier =
      [label c, Decimal.whole (segments c)]
        <> [cell (Table.number . perSegment (segments c)) (Just o) | o <- exact c]
        <> [ cell (Table.number . perSegment (segments c)) (at i (chorded c))
             | i <- [0 .. length (chordPeers peers) - 1]
           ]
        <> [maybe "–" Table.number (quotient (exact c) i) | i <- [1 .. count - 1]]
        <> [maybe "" growth (both i c earlier) | i <- [0 .. count - 1]]
    quotient outcomes i = case (at 0 outcomes, at i outcomes) of
      (Just (Right a), Just (Right b)) -> Just (Peer.middle (times a) / Peer.middle (times b))
      _ -> Nothing
    both i c earlier = case (at i (exact c), earlier >>= at i . exact, earlier) of
      (Just (Right now), Just (Right then'), Just e) ->
        Just ((segments e, Peer.middle (times then')), (segments c, Peer.middle (times now)))
      _ -> Nothing
    growth (a, b) = Decimal.fixed 2 (Table.exponent a b)

-- | The memory per segment in bytes.
memoryOf :: Peers -> [Case] -> Text
memoryOf peers cases =
  Table.table
    ( ["input", "segments"]
        <> map Peer.title (ours peers : arcPeers peers)
        <> map (Peer.title . ($ coarse)) (chordPeers peers)
    )
    [ [label c, Decimal.whole (segments c)]
        <> [cell (bytes c) (Just o) | o <- exact c]
        <> [cell (bytes c) (at i (chorded c)) | i <- [0 .. length (chordPeers peers) - 1]]
      | c <- cases
    ]
  where
    bytes c o = Table.number (max 0 (memory o) / fromIntegral (segments c))

-- | The differences between the results of partc and of the first peer with arcs.
agreement :: [Case] -> Text
agreement cases =
  Table.table
    [ "input",
      "segments",
      "area, mm²",
      "apart",
      "length, mm",
      "apart",
      "loops",
      "of the peer",
      "open"
    ]
    [row c | c <- cases]
  where
    row c = case exact c of
      Right a : Right b : _ ->
        [ label c,
          Decimal.whole (segments c),
          Decimal.fixed 2 (area a),
          relative area a b,
          Decimal.fixed 2 (long a),
          relative long a b,
          Decimal.whole (loops a),
          Decimal.whole (loops b),
          Decimal.whole (open b)
        ]
      Right a : _ ->
        [ label c,
          Decimal.whole (segments c),
          Decimal.fixed 2 (area a),
          "–",
          Decimal.fixed 2 (long a),
          "–",
          Decimal.whole (loops a),
          "–",
          "–"
        ]
      _ -> [label c, Decimal.whole (segments c)] <> replicate 7 "–"
    relative part a b = scientific (apart part a b)

apart :: (Outcome -> Double) -> Outcome -> Outcome -> Double
apart part a b = abs (part a - part b) / max 1e-300 (abs (part a))

-- | A number with one decimal and a power of ten.
scientific :: Double -> Text
scientific x
  | x == 0 = "0"
  | otherwise =
    let e =
          floor (logBase 10 x) :: Int
     in Decimal.fixed 1 (x / 10 ^^ e)
          <> "e"
          <> (if e < 0 then "−" <> Decimal.whole (-e) else Decimal.whole e)

-- | The mean distance of the boundaries with chords from that of partc, in sagittas: the difference
-- of the areas divided by the length.
chordsOf :: Peers -> [Case] -> Text
chordsOf peers cases =
  Table.table
    ( ["input", "segments"]
        <> concat
          [ [Peer.title (p coarse) <> ", " <> s | s <- ["0.01 mm", "0.001 mm"]]
            | p <- chordPeers peers
          ]
    )
    [ [label c, Decimal.whole (segments c)]
        <> concat
          [ [shown c coarse (at i (chorded c)), shown c fine (at i (finer c))]
            | i <- [0 .. length (chordPeers peers) - 1]
          ]
      | c <- cases,
        not (null (finer c))
    ]
  where
    shown c sagitta o = case (exact c, o) of
      (Right a : _, Just (Right b)) -> Decimal.fixed 2 (sagittas sagitta a b)
      (_, Just (Left _)) -> "fails"
      _ -> "–"

sagittas :: Double -> Outcome -> Outcome -> Double
sagittas sagitta a b = abs (area a - area b) / long a / sagitta

-- | The violated expectations of a case.
broken :: Int -> Case -> [Text]
broken kept c =
  map
    ((label c <> ", " <> Decimal.whole (segments c) <> " segments: ") <>)
    (failures <> differences <> chords <> known)
  where
    failures = [why | Left why <- take 1 (exact c)]
    others = take kept (drop 1 (exact c))
    differences = case exact c of
      Right a : _ ->
        [ what
            <> " of the peer differs by the fraction "
            <> scientific d
            <> ( if open b > 0
                   then "; open pieces in its result: " <> Decimal.whole (open b)
                   else ""
               )
          | Right b <- others,
            (what, d) <- [("the area", apart area a b), ("the length", apart long a b)],
            d > 1e-9
        ]
      _ -> []
    -- The chords of the contour and those of the offset may each add a sagitta.
    chords = case exact c of
      Right a : _ ->
        [ Decimal.fixed 2 (sagittas s a b)
            <> " sagittas of "
            <> Decimal.fixed 3 s
            <> " mm between ours and a peer with chords"
          | (s, os) <- [(coarse, chorded c), (fine, finer c)],
            Right b <- os,
            sagittas s a b > 2
        ]
      _ -> []
    -- The value of independent computations.
    known = case (family c, segments c, distance c, exact c) of
      (Star, 1000000, 5, Right a : _)
        | loops a /= 1 || abs (area a - 79584382771.36) > 1e-9 * area a ->
          [ "one loop of 79584382771.36 mm² was expected, not "
              <> Decimal.whole (loops a)
              <> " of "
              <> Decimal.fixed 2 (area a)
          ]
      _ -> []
