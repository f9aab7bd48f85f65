-- | A small interpreter of G-code for a milling machine with LinuxCNC, for tests. It shares no code
-- with the compiler, and knows no more than the files of the tests need. It is deliberately simple:
-- a file that it does not understand is one that nobody may run.
module GcodeTrace
  ( Control (..),
    Event (..),
    Place,
    above,
    trace,
    codeOf,
  )
where

import Control.Applicative ((<|>))
import Control.Monad (foldM, unless, when)
import Data.Char (isSpace)
import Data.List (nub, partition, (\\))
import Data.Maybe (fromMaybe, isNothing)
import Text.Read (readMaybe)

-- | State of the control; Nothing for what no line has set.
data Control = Control
  { isMetric :: Maybe Bool,
    -- | 17, 18 or 19
    plane :: Maybe Int,
    isAbsolute :: Maybe Bool,
    -- | true if I and J are positions
    hasAbsoluteCentres :: Maybe Bool,
    -- | 93, 94 or 95
    feedWay :: Maybe Int,
    feed :: Maybe Double,
    offset :: Maybe Int,
    selected :: Maybe Int,
    loaded :: Maybe Int,
    -- | number of the tool whose length counts
    lengthOf :: Maybe Int,
    -- | 3 or 4 while the spindle turns
    turns :: Maybe Int,
    rpm :: Maybe Double,
    coolants :: [Int],
    -- | largest deviation at corners; Nothing if there is no bound
    blending :: Maybe Double,
    isRadius :: Maybe Bool,
    isPlain :: Maybe Bool,
    -- | 0 to 3, or the number of a canned cycle
    way :: Maybe Int,
    -- | 98 or 99: the height at the end of a canned cycle
    returns :: Maybe Int
  }
  deriving stock (Eq, Show)

-- | Position along x, y and z; Nothing for an unknown one. A z of 'above' is the machine's zero.
type Place = [Maybe Double]

-- | Height that stands for the zero of the machine.
above :: Double
above = 1000

data Event
  = -- | line, way, ends, centre of an arc, state
    Moves Int Int Place Place (Maybe (Double, Double)) Control
  | -- | M0 or M1
    Stops Int
  | -- | seconds; true if the spindle started and nothing was cut since
    Waits Double Bool
  | -- | M6, with the position
    Changes Place
  | Ends
  deriving stock (Eq, Show)

-- | State between lines.
data Run = Run
  { control :: Control,
    place :: Place,
    isStarting :: Bool,
    isOver :: Bool,
    -- | in a canned cycle: the height before it, and the words that stay, in mm and seconds
    cycleBegin :: Maybe Double,
    cycleWords :: [(Char, Double)]
  }

-- | Events of a file, or the reason why nobody may run it.
trace :: [String] -> Either String [Event]
trace file = do
  (end, events) <- foldM step (begin, []) (zip [1 ..] file)
  unless (isOver end) (Left "the program does not end")
  pure (reverse events)
  where
    begin = Run nothing [Nothing, Nothing, Nothing] False False Nothing []
    nothing =
      Control
        { isMetric = Nothing,
          plane = Nothing,
          isAbsolute = Nothing,
          hasAbsoluteCentres = Nothing,
          feedWay = Nothing,
          feed = Nothing,
          offset = Nothing,
          selected = Nothing,
          loaded = Nothing,
          lengthOf = Nothing,
          turns = Nothing,
          rpm = Nothing,
          coolants = [],
          blending = Nothing,
          isRadius = Nothing,
          isPlain = Nothing,
          way = Nothing,
          returns = Nothing
        }
    step (now, events) (n, line)
      | isOver now = Right (now, events)
      | otherwise = do
        ws <- wordsOf (codeOf line)
        (next, made) <- runLine n ws now
        Right (next, reverse made <> events)

-- | A line without its comments, and without spaces at both ends.
codeOf :: String -> String
codeOf = strip . uncommented
  where
    uncommented line = case line of
      '(' : rest -> uncommented (drop 1 (dropWhile (/= ')') rest))
      ';' : _ -> ""
      c : rest -> c : uncommented rest
      "" -> ""
    strip = dropWhile isSpace . reverse . dropWhile isSpace . reverse

-- | Words of a line: letters with their numbers.
wordsOf :: String -> Either String [(Char, Double)]
wordsOf line
  | line == "%" = Right []
  | otherwise = filter ((/= 'N') . fst) <$> go (filter (not . isSpace) line)
  where
    go text = case text of
      "" -> Right []
      c : rest
        | c `elem` ("GMNXYZIJFSTHPQRD" :: String) ->
          let (number, after) = span (`elem` ("+-.0123456789" :: String)) rest
           in case readMaybe (haskell number) of
                Just v -> ((c, v) :) <$> go after
                Nothing -> Left ("no number after " <> [c])
        | otherwise -> Left ("no word: " <> text)
    haskell number = case number of
      '+' : rest -> haskell rest
      '-' : rest -> '-' : haskell rest
      '.' : _ -> '0' : number
      _ | (whole, ".") <- break (== '.') number -> whole
      _ -> number

-- | Words of which a line may have only one.
groups :: [[(Char, Double)]]
groups =
  [ map ('G',) (80 : 0 : 1 : 2 : 3 : map fromIntegral cannedCycles),
    map ('G',) [98, 99],
    map ('G',) [17, 18, 19],
    map ('G',) [90, 91],
    map ('G',) [90.1, 91.1],
    map ('G',) [93, 94, 95],
    map ('G',) [20, 21],
    map ('G',) [43, 49],
    map ('G',) [54 .. 59],
    map ('G',) [61, 61.1, 64],
    map ('G',) [7, 8],
    map ('G',) [40],
    map ('G',) [4, 53],
    map ('M',) [0, 1, 2, 30],
    map ('M',) [3, 4, 5],
    map ('M',) [6],
    map ('M',) [7, 8, 9]
  ]

-- | Canned cycles in the plane of x and y: chip breaking, drilling, drilling with a pause, pecking,
-- and boring with a feed out.
cannedCycles :: [Int]
cannedCycles = [73, 81, 82, 83, 85]

isCanned :: Control -> Bool
isCanned c = maybe False (`elem` cannedCycles) (way c)

-- | Runs the words of a line, in the order in which the control takes them.
runLine :: Int -> [(Char, Double)] -> Run -> Either String (Run, [Event])
runLine n ws now = do
  let (codes, values) = partition ((`elem` ("GM" :: String)) . fst) ws
      has = (`elem` codes)
      value c = lookup c values
  when (codes /= nub codes) (Left "a code twice")
  when (any ((> 1) . length . (`only` codes)) groups) (Left "two words of a group")
  unless (null (codes \\ concat groups)) (Left "a word that nobody knows")
  when (map fst values /= nub (map fst values)) (Left "a letter twice")
  let changed = afterChange has value (control now)
      c = afterModes has value changed
      moved =
        displaced (control now) c $
          now
            { control = c,
              cycleBegin = if isCanned c then cycleBegin now else Nothing,
              cycleWords = if way c == way (control now) then cycleWords now else []
            }
      users = userLetters has c
  when (any ((`notElem` users) . fst) values) (Left "a word that nothing uses")
  when (has ('G', 4) && isNothing (value 'P')) (Left "a dwell without its time")
  (ended, motion) <- moveOf n has values moved
  let starts = has ('M', 3) || has ('M', 4)
      waits = [Waits s (isStarting now || starts) | has ('G', 4), Just s <- [value 'P']]
      stops = [Stops (round m) | ('M', m) <- codes, m `elem` [0, 1]]
      isEnd = has ('M', 2) || has ('M', 30)
      cutsNow = or [k > 0 | Moves _ k _ _ _ _ <- motion]
  Right
    ( ended {isStarting = not cutsNow && (isStarting now || starts), isOver = isEnd},
      [Changes (place now) | has ('M', 6)] <> waits <> motion <> stops <> [Ends | isEnd]
    )
  where
    only group = filter (`elem` group)

-- | Letters that something in a line uses.
userLetters :: ((Char, Double) -> Bool) -> Control -> String
userLetters has c =
  (if has ('G', 4) then "" else "XYZ")
    <> "FST"
    <> concat
      [ letters
        | (True, letters) <-
            [ (has ('G', 43), "H"),
              (has ('G', 4) /= has ('G', 64), "P"),
              (has ('G', 64), "Q"),
              (way c `elem` [Just 2, Just 3], "IJ"),
              (isCanned c, "R"),
              (way c `elem` map Just [82, 89], "P"),
              (way c `elem` map Just [73, 83], "Q")
            ]
      ]

-- | State after feed, speed, tool and tool change.
afterChange :: ((Char, Double) -> Bool) -> (Char -> Maybe Double) -> Control -> Control
afterChange has value c
  | has ('M', 6) = set {loaded = selected set, lengthOf = Nothing, turns = Nothing}
  | otherwise = set
  where
    set =
      c
        { feed = newFeed,
          rpm = value 'S' <|> rpm c,
          selected = maybe (selected c) (Just . round) (value 'T')
        }
    -- F counts in the units before the line, and G94 takes the feed away.
    newFeed = case value 'F' of
      Just f -> (\isMm -> if isMm then f else 25.4 * f) <$> isMetric c
      Nothing
        | any (has . ('G',)) [93, 94, 95] -> Nothing
        | otherwise -> feed c

-- | State after the other words.
afterModes :: ((Char, Double) -> Bool) -> (Char -> Maybe Double) -> Control -> Control
afterModes has value c =
  c
    { turns = if has ('M', 5) then Nothing else pick 'M' [3, 4] (turns c),
      coolants = if has ('M', 9) then [] else nub (coolants c <> newCoolants),
      plane = pick 'G' [17, 18, 19] (plane c),
      isMetric = flag 21 20 (isMetric c),
      isPlain = flag 40 41 (isPlain c),
      isRadius = flag 8 7 (isRadius c),
      lengthOf = newLength,
      offset = pick 'G' [54 .. 59] (offset c),
      blending = newBlending,
      isAbsolute = flag 90 91 (isAbsolute c),
      hasAbsoluteCentres = flag 90.1 91.1 (hasAbsoluteCentres c),
      feedWay = pick 'G' [93, 94, 95] (feedWay c),
      way = if has ('G', 80) then Nothing else pick 'G' ([0 .. 3] <> cannedCycles) (way c),
      returns = pick 'G' [98, 99] (returns c)
    }
  where
    newCoolants = [m | m <- [7, 8], has ('M', fromIntegral m)]
    pick letter numbers old = case filter (has . (letter,) . fromIntegral) numbers of
      k : _ -> Just (k :: Int)
      [] -> old
    flag yes no old
      | has ('G', yes) = Just True
      | has ('G', no) = Just False
      | otherwise = old
    newLength
      | has ('G', 49) = Nothing
      | has ('G', 43) = maybe (loaded c) wholeOf (value 'H')
      | otherwise = lengthOf c
    wholeOf h = if h == fromIntegral (round h :: Int) then Just (round h) else Nothing
    newBlending
      | has ('G', 61) || has ('G', 61.1) = Just 0
      | has ('G', 64) = case value 'P' of
        Just p | p > 0, all (>= 0) (value 'Q') -> Just (p + fromMaybe p (value 'Q'))
        _ -> Nothing
      | otherwise = blending c

-- | Takes away the positions that another zero makes unknown.
displaced :: Control -> Control -> Run -> Run
displaced old new now
  | offset old /= offset new = now {place = [Nothing, Nothing, upper]}
  | (lengthOf old, loaded old) /= (lengthOf new, loaded new) =
    now {place = take 2 (place now) <> [upper]}
  | otherwise = now
  where
    upper = case drop 2 (place now) of
      [Just z] | z == above -> Just above
      _ -> Nothing

-- | Motion of a line.
moveOf :: Int -> ((Char, Double) -> Bool) -> [(Char, Double)] -> Run -> Either String (Run, [Event])
moveOf n has values now
  | has ('G', 53) && null axes = Left "a motion to nowhere"
  | null axes && not (arcs && maybe False (> 1) (way c)) = Right (now, [])
  | otherwise = case way c of
    Nothing -> Left "no kind of motion"
    Just k
      | isCanned c -> cannedMoves n values now
      | has ('G', 53) && (k > 1 || isAbsolute c /= Just True) -> Left "G53 needs G0 and G90"
      | k > 0 && feed c `elem` [Nothing, Just 0] -> Left "no feed"
      | otherwise -> do
        target <- traverse along (zip "XYZ" (place now))
        middle <- if k > 1 then Just <$> centreOf k target else Right Nothing
        Right (now {place = target}, [Moves n k (place now) target middle c])
  where
    c = control now
    axes = filter ((`elem` ("XYZ" :: String)) . fst) values
    arcs = any ((`elem` ("IJ" :: String)) . fst) values
    unit = if isMetric c == Just False then 25.4 else 1
    along (letter, old) = case lookup letter values of
      Nothing -> Right old
      Just v
        | has ('G', 53) -> Right (if letter == 'Z' && v == 0 then Just above else Nothing)
        | isAbsolute c == Just False ->
          maybe (Left "from nowhere") (Right . Just . (+ v * unit)) old
        | otherwise -> Right (Just (v * unit))
    centreOf k target = case (place now, target) of
      ([Just x, Just y, _], [Just x', Just y', _])
        | not arcs -> Left "no centre"
        | abs (radius x y - radius x' y') > 0.005 -> Left "two radii"
        | radius x y < 0.0005 || radius x' y' < 0.0005 -> Left "no radius"
        | otherwise -> Right middle
        where
          radius a b = sqrt ((a - fst middle) ^ (2 :: Int) + (b - snd middle) ^ (2 :: Int))
          middle = (centreAlong 'I' x, centreAlong 'J' y)
      _ -> Left ("an arc from nowhere, " <> show (k :: Int))
    centreAlong letter from
      | hasAbsoluteCentres c == Just True = maybe from (* unit) (lookup letter values)
      | otherwise = from + unit * fromMaybe 0 (lookup letter values)

-- | Moves of a canned cycle, as the manual of LinuxCNC gives them. Only cycles in mm with absolute
-- positions are understood.
cannedMoves :: Int -> [(Char, Double)] -> Run -> Either String (Run, [Event])
cannedMoves n values now = case place now of
  [Just x0, Just y0, Just z0] -> do
    mapM_ (\(isWrong, why) -> when isWrong (Left why)) unfit
    bottom <- sizeOf 'Z'
    r <- sizeOf 'R'
    pause <- if code == 82 then sizeOf 'P' else Right 0
    peck <- if code `elem` [73, 83] then sizeOf 'Q' else Right 1
    let begin = fromMaybe z0 (cycleBegin now)
        end = if returns c == Just 98 then max begin r else r
        (x, y) = (fromMaybe x0 (lookup 'X' values), fromMaybe y0 (lookup 'Y' values))
        over = [(0, [x0, y0, r]) | z0 < r] <> [(0, [x, y, max z0 r]), (0, [x, y, r])]
        (down, up) = cycleHeights code (r, bottom, peck)
        at z = [x, y, z]
        atBottom = over <> map (fmap at) down
        (before, place') = chain n c [x0, y0, z0] atBottom
        (after, _) = chain n c place' (map (fmap at) up <> [(0, at end)])
    when (isNothing (returns c) && begin > r) (Left "a cycle to an unknown height")
    when (r < bottom || peck <= 0 || pause < 0) (Left "a cycle with wrong sizes")
    Right
      ( now {place = map Just (at end), cycleBegin = Just begin, cycleWords = sizes},
        before <> [Waits pause False | code == 82] <> after
      )
  _ -> Left "a cycle from nowhere"
  where
    c = control now
    code = fromMaybe 0 (way c)
    sizes = [v | v@(letter, _) <- values, letter `elem` ("ZRPQ" :: String)] <> cycleWords now
    sizeOf letter = maybe (Left ("a cycle without " <> [letter])) Right (lookup letter sizes)
    unfit =
      [ (isMetric c /= Just True || isAbsolute c /= Just True, "a cycle in other units"),
        (plane c /= Just 17, "a cycle in another plane"),
        (feed c `elem` [Nothing, Just 0], "no feed"),
        (turns c `notElem` [Just 3, Just 4], "a cycle without the spindle")
      ]

-- | Heights of a canned cycle down to the bottom, and up to R, each with 0 for a rapid move or 1
-- for a feed. LinuxCNC returns to 0.01 inch above the last peck.
cycleHeights :: Int -> (Double, Double, Double) -> ([(Int, Double)], [(Int, Double)])
cycleHeights code (r, bottom, peck) = (concatMap between pecks <> [(1, bottom)], [(out, r)])
  where
    out = if code == 85 then 1 else 0
    pecks
      | code `elem` [73, 83] = takeWhile (> bottom) (drop 1 (iterate (subtract peck) r))
      | otherwise = []
    between z = (1, z) : [(0, r) | code == 83] <> [(0, z + 0.254)]

-- | Straight moves from one position to the next, without those to the same position, and the last
-- position.
chain :: Int -> Control -> [Double] -> [(Int, [Double])] -> ([Event], [Double])
chain n c from list = case list of
  [] -> ([], from)
  (k, to) : rest ->
    let (events, final) = chain n c to rest
     in ([Moves n k (map Just from) (map Just to) Nothing c | to /= from] <> events, final)
