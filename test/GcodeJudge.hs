-- | A simple judge of edited G-code files, independent of the proof: does the edited file cut the
-- same as the file before the edit, and in a safe state? It compares both files motion by motion.
--
-- The judge is stricter or more lenient than the proof in places. Only two things are demanded of
-- the proof: whatever this judge finds changed is refused, and whatever is accepted has a reason
-- here.
module GcodeJudge
  ( Verdict (..),
    Reason (..),
    verdict,
    clearsTheSame,
    reasonText,
  )
where

import Control.Monad (zipWithM)
import Data.List (isPrefixOf, nub)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, isNothing)
import GcodeTrace (Control (..), Event (..), Place, above, codeOf, trace)

-- | Verdict about an edited file.
data Verdict
  = -- | it cuts something else, or in an unsafe state: why
    Changed String
  | -- | it cuts the same: what differs. Nothing for a difference that the judge cannot explain.
    Same [Maybe Reason]
  deriving stock (Eq, Show)

-- | Reason why an edited file may be accepted.
data Reason
  = -- | nothing but comments, numbers of lines, empty lines, or text behind the end
    NotRead
  | -- | a word that sets what is in force already, or that no motion uses
    InForce
  | -- | a position, or the centre of an arc, that differs by no more than is allowed
    InTolerance
  | -- | a feed or a speed that is rounded to the same number
    RoundedRate
  | -- | another bound of the deviation at corners, within what is allowed
    OtherBound
  | -- | a longer or shorter wait for the spindle, or none
    SpindleWait
  | -- | a rapid move in the same line as the one before it, in the same direction
    DividedMove
  | -- | a straight cut in several lines
    DividedCut
  | -- | another way to the machine's zero of z or from there, with the same lowest points
    AboveAll
  | -- | spindle or coolant differ only while the tool is at the machine's zero of z, or after the
    -- last motion: M6 and M2 stop the spindle
    IdleState
  | -- | a stop with the tool at the machine's zero of z in place of the height over the same point
    StopAbove
  | -- | M30 in place of M2
    OtherEnd
  | -- | other loops of a pocket that clear the same
    OtherLoops
  deriving stock (Eq, Ord, Show, Enum, Bounded)

-- | Words for a reason.
reasonText :: Reason -> String
reasonText reason = case reason of
  NotRead -> "a comment, the number of a line, an empty line, or what the control does not read"
  InForce -> "sets what is in force already, or what no motion uses"
  InTolerance -> "a position or a centre within the tolerance"
  RoundedRate -> "a feed or speed that is rounded to the same number"
  OtherBound -> "another bound of the path mode, within the tolerance"
  SpindleWait -> "the wait for the spindle is longer, shorter or left out"
  DividedMove -> "a rapid move in one or more lines"
  DividedCut -> "a straight cut in more lines"
  AboveAll -> "another way at the retract height, with the same lowest points"
  IdleState -> "spindle or coolant differ only at the retract height or after the last motion"
  StopAbove -> "a stop at the retract height, over the same point"
  OtherEnd -> "M30 in place of M2"
  OtherLoops -> "other loops of a pocket that clear the same"

-- | Compares an edited file with the one before the edit. @allowed@ is the tolerance of the program
-- and one pulse, in mm.
verdict :: Double -> [String] -> [String] -> Verdict
verdict allowed before after = case (trace before, trace after) of
  (Left why, _) -> Changed ("the file before the edit is not understood: " <> why)
  (_, Left why) -> Changed why
  -- A straight cut in several lines is the same cut.
  (Right old, Right new)
    | joinedCuts new /= new, joinedCuts new `sameBut` joinedCuts old -> Same [Just DividedCut]
  (Right old, Right new) -> case changes allowed old new of
    (_, why) : _ -> Changed why
    []
      | old == withLines old new, codes before == codes after -> Same [Just NotRead]
      | otherwise -> Same (nub (reasons allowed old new (before, after)))
  where
    codes = takeWhile (/= "M2") . filter (not . null) . map (dropNumber . codeOf)
    dropNumber line = case words line of
      ('N' : _) : rest -> unwords rest
      ws -> unwords ws

-- | Events in which cuts in one direction, at the same feed and in the same state, are one cut.
joinedCuts :: [Event] -> [Event]
joinedCuts events = case events of
  Moves n 1 from mid Nothing s : Moves _ 1 mid' to Nothing s' : rest
    | mid == mid', s == s', isBetween from mid to -> joinedCuts (Moves n 1 from to Nothing s : rest)
  e : rest -> e : joinedCuts rest
  [] -> []
  where
    isBetween a b c = case (sequence a, sequence b, sequence c) of
      (Just p, Just q, Just r) ->
        let part = zipWith (-) q p
            whole = zipWith (-) r p
            square = sum (map (^ (2 :: Int)) whole)
            share = sum (zipWith (*) part whole) / square
         in square > 0
              && share > 0
              && share < 1
              && and (zipWith (\d w -> abs (d - share * w) < 1.0e-6) part whole)
      _ -> False

-- | Test that events are the same, but for the numbers of their lines.
sameBut :: [Event] -> [Event] -> Bool
sameBut new old = length new == length old && withLines old new == old

-- | Events with the numbers of lines of others.
withLines :: [Event] -> [Event] -> [Event]
withLines old new
  | length old == length new = zipWith same old new
  | otherwise = new
  where
    same a b = case (a, b) of
      (Moves n _ _ _ _ _, Moves _ k from to c s) -> Moves n k from to c s
      _ -> b

-- Changes -----------------------------------------------------------------------------------------

-- | A change of the path only, or also of something else.
data ChangeKind = InPath | InState
  deriving stock (Eq)

-- | Differences that change what is cut, or cut in an unsafe state.
changes :: Double -> [Event] -> [Event] -> [(ChangeKind, String)]
changes allowed old new =
  cutChanges
    <> map
      (InState,)
      ( ["rapid moves in the material" | isSameCount, not isSameLow]
          <> concatMap (unsafeMove allowed demanded) new
          <> ["another stop" | isSameCount, stopsOf old /= stopsOf new]
          <> ["another wait" | isSameCount, not (sameWaits (waitsOf old) (waitsOf new))]
      )
  where
    isSameLow = sameLow allowed (lowRapids old) (lowRapids new)
    isSameCount = length (cuts old) == length (cuts new)
    cutChanges
      | isSameCount =
        concat
          ( zipWith
              (changedCut allowed)
              (withNeighbours (cuts old))
              (withNeighbours (cuts new))
          )
      | otherwise = [(InPath, "cuts are lost or added")]
    demanded = case cuts old of
      Moves _ _ _ _ _ c : _ -> offset c
      _ -> Nothing
    sameWaits as bs = map fst as == map fst bs && and (zipWith sameTime as bs)
    sameTime a b = abs (snd a - snd b) < 0.0005

-- | Motions that cut. A line without length is none, and one to the machine's zero of z or from
-- there neither.
cuts :: [Event] -> [Event]
cuts events = [e | e@(Moves _ k from to _ _) <- events, k > 1 || k > 0 && isCut from to]
  where
    isCut from to = from /= to && all ((/= Just above) . heightOf) [from, to]

heightOf :: Place -> Maybe Double
heightOf p = case drop 2 p of
  z : _ -> z
  [] -> Nothing

-- | Things that happen, each with the count of cuts before it.
counted :: (Event -> Maybe a) -> [Event] -> [(Int, a)]
counted f = go 0
  where
    go n events = case events of
      [] -> []
      e : rest -> [(n, a) | Just a <- [f e]] <> go (if null (cuts [e]) then n else n + 1) rest

stopsOf :: [Event] -> [(Int, Int)]
stopsOf = counted $ \case
  Stops k -> Just k
  _ -> Nothing

-- | Waits, without those for the spindle.
waitsOf :: [Event] -> [(Int, Double)]
waitsOf = counted $ \case
  Waits s False -> Just s
  _ -> Nothing

-- | Each cut with the paths of its neighbours and of itself.
withNeighbours :: [Event] -> [(Event, [[Place]])]
withNeighbours list = zip list (zipWith (\a b -> a <> b) before (map (take 2) (suffixes paths)))
  where
    paths = map path list
    before = [] : map pure paths
    suffixes xs = if null xs then [] else xs : suffixes (drop 1 xs)

-- | Differences of two cuts.
changedCut :: Double -> (Event, [[Place]]) -> (Event, [[Place]]) -> [(ChangeKind, String)]
changedCut allowed (old, oldPaths) (new, newPaths) = case (old, new) of
  (Moves _ k _ _ _ c, Moves n _ _ _ _ c') ->
    [(InPath, at n "a cut elsewhere") | not (isNearly (allowed / 2) old new), isElsewhere]
      <> [(InState, at n what) | (True, what) <- stateChanges k c c']
  _ -> [(InState, "no cuts")]
  where
    at n what = "line " <> show n <> ": " <> what
    isElsewhere = any (isOff oldPaths) (path new) || any (isOff newPaths) (path old)
    isOff paths p = all (\way' -> awayFrom way' p > allowed + 0.001) paths

-- | Test that two motions of a kind have nearly the same ends and the same centre.
isNearly :: Double -> Event -> Event -> Bool
isNearly most old new = case (old, new) of
  (Moves _ k from to middle _, Moves _ k' from' to' middle' _) ->
    k == k'
      && and (zipWith near [from, to, centre middle] [from', to', centre middle'])
  _ -> False
  where
    near a b = a == b || distance a b <= most
    centre = maybe [] (\(x, y) -> [Just x, Just y])

-- | Differences of the states of two cuts of a kind.
stateChanges :: Int -> Control -> Control -> [(Bool, String)]
stateChanges k c c' =
  [ (differs 0.5 (feed c) (feed c'), "another feed"),
    (differs 0.5 (rpm c) (rpm c') || turns c /= turns c', "the spindle"),
    (plane c' /= Just 17, "the plane"),
    (feedWay c' /= Just 94, "the kind of feed"),
    (isNothing (hasAbsoluteCentres c') && k > 1, "centres of arcs"),
    (loaded c /= loaded c', "another tool"),
    (coolants c /= coolants c', "the coolant")
  ]

-- | Points along a motion, at most 0.3 mm apart, and so near that their chords leave an arc by less
-- than 0.001 mm.
path :: Event -> [Place]
path event = case event of
  Moves _ k [Just x, Just y, Just z] [Just x', Just y', Just z'] middle _ -> case middle of
    Nothing ->
      [ map Just [x + t * (x' - x), y + t * (y' - y), z + t * (z' - z)]
        | t <- steps (sqrt ((x' - x) ^ two + (y' - y) ^ two + (z' - z) ^ two) / 0.3)
      ]
    Just (i, j) ->
      [ map Just [i + r * cos a, j + r * sin a, z + t * (z' - z)]
        | t <- steps (abs turned * max 20 (radius x y / 0.3)),
          let a = begin + t * turned
              r = radius x y + t * (radius x' y' - radius x y)
      ]
      where
        radius a b = sqrt ((a - i) ^ two + (b - j) ^ two)
        begin = atan2 (y - j) (x - i)
        rest = atan2 (y' - j) (x' - i) - begin
        turned
          | k == 2 = if rest >= -1e-9 then rest - 2 * pi else rest
          | otherwise = if rest <= 1e-9 then rest + 2 * pi else rest
  _ -> []
  where
    two = 2 :: Int
    steps :: Double -> [Double]
    steps count =
      let n = max 1 (ceiling count) :: Int
       in [fromIntegral m / fromIntegral n | m <- [0 .. n]]

-- | Distance of a position from a chain of straight lines.
awayFrom :: [Place] -> Place -> Double
awayFrom chain p = case chain of
  [] -> 1e9
  [a] -> distance a p
  _ -> minimum (zipWith segment chain (drop 1 chain))
  where
    segment a b = case (sequence a, sequence b, sequence p) of
      (Just a', Just b', Just p') ->
        let along = zipWith (-) b' a'
            square = sum (map (\v -> v * v) along)
            product' = sum (zipWith (*) along (zipWith (-) p' a'))
            t = if square == 0 then 0 else max 0 (min 1 (product' / square))
         in distance (map Just p') [Just (v + t * d) | (v, d) <- zip a' along]
      _ -> 1e9

-- Pockets -----------------------------------------------------------------------------------------

-- | Test that the motions of an edited file differ only in their path, at the same states and
-- heights, that the tools clear the same cells of a raster, and that wherever only one of the files
-- cuts, it does so inside a round loop.
clearsTheSame :: Double -> [String] -> [String] -> Bool
clearsTheSame allowed before after = case (trace before, trace after) of
  (Right old, Right new) ->
    and [kind == InPath | (kind, _) <- changes allowed old new]
      && all ((`elem` map states (cuts old)) . states) (cuts new)
      && isInner old old new
      && isInner old new old
  _ -> False
  where
    radii = toolRadii before
    isInner old a b =
      all (\(_, p) -> any (isInLoop p) (cuts old)) (pointsOff a b)
        && cleared radii 0.3 (pointsOf a) `isWithin` cleared radii 0 (pointsOf b)
    pointsOf events = [(loaded c, p) | e@(Moves _ _ _ _ _ c) <- cuts events, p <- path e]
    -- Inside the circle of a loop at the same height, the tool stays in what the loop surrounds.
    isInLoop p event = case (event, p) of
      (Moves _ _ [Just x, Just y, Just z] _ (Just (i, j)) _, [Just px, Just py, Just pz]) ->
        hypotenuse (px - i) (py - j) <= hypotenuse (x - i) (y - j) && abs (pz - z) < 1e-9
      _ -> False
    hypotenuse a b = sqrt (a * a + b * b)
    pointsOff a b =
      [(n, p) | (n, p) <- pointsOf a, all (\e -> awayFrom (path e) p > allowed) (cuts b)]
    states event = case event of
      Moves _ _ from to _ c ->
        (heightOf from, heightOf to, (feed c, rpm c, turns c), (loaded c, coolants c))
      _ -> (Nothing, Nothing, (Nothing, Nothing, Nothing), (Nothing, []))
    isWithin a b =
      and [maybe False (<= z + allowed) (Map.lookup cell b) | (cell, z) <- Map.toList a]

-- | Radii of the tools, from the comments at the head of a file.
toolRadii :: [String] -> [(Int, Double)]
toolRadii file =
  [ (read (takeWhile (/= ':') n), read (takeWhile (/= ' ') d) / 2)
    | line <- file,
      "(tool" `isPrefixOf` line,
      (n : ws) <- [drop 1 (words line)],
      (d : _) <- [drop 1 (dropWhile (/= "diameter") ws)]
  ]

-- | Lowest height in each cell of 0.25 mm that tools at these positions clear, with radii that are
-- smaller by an amount.
cleared :: [(Int, Double)] -> Double -> [(Maybe Int, Place)] -> Map (Int, Int) Double
cleared radii less points =
  Map.fromListWith
    min
    [ (cell, z)
      | (Just tool, place) <- points,
        let r = fromMaybe 0 (lookup tool radii) - less,
        Just [x, y, z] <- [sequence place],
        z < 0,
        cell <- cellsAround r x y
    ]
  where
    cellsAround r x y =
      [ (i, j)
        | i <- [ceiling ((x - r) / size) .. floor ((x + r) / size)],
          j <- [ceiling ((y - r) / size) .. floor ((y + r) / size)],
          let (dx, dy) = (fromIntegral i * size - x, fromIntegral j * size - y),
          dx * dx + dy * dy <= r * r
      ]
    size = 0.25 :: Double

-- | Test that two numbers differ by more than a half: rates are rounded.
differs :: Double -> Maybe Double -> Maybe Double -> Bool
differs most a b = case (a, b) of
  (Just x, Just y) -> abs (x - y) > most
  _ -> a /= b

-- | Distance of two positions; unknown ones are far from all others.
distance :: Place -> Place -> Double
distance a b = maybe 1e9 (sqrt . sum) (zipWithM square a b)
  where
    square p q = (\x y -> (x - y) * (x - y)) <$> p <*> q

-- | Parts of rapid moves below the top of the material, each with the count of cuts before it.
lowRapids :: [Event] -> [(Int, (Place, Place))]
lowRapids = counted $ \case
  Moves _ 0 from@[_, _, Just z] to@[_, _, Just z'] _ _
    | min z z' < 0, from /= to -> Just (clipped from to, clipped to from)
  _ -> Nothing
  where
    -- The end of a move, or the point of it at the top of the material.
    clipped p q = case (p, q) of
      ([Just x, Just y, Just z], [Just x', Just y', Just z'])
        | z > 0, t <- z / (z - z') -> [Just (x + t * (x' - x)), Just (y + t * (y' - y)), Just 0]
      _ -> p

sameLow :: Double -> [(Int, (Place, Place))] -> [(Int, (Place, Place))] -> Bool
sameLow allowed old new = length old == length new && and (zipWith same old new)
  where
    same (n, (a, b)) (m, (a', b')) = n == m && distance a a' <= allowed && distance b b' <= allowed

-- | Dangers of one motion by itself.
unsafeMove :: Double -> Maybe Int -> Event -> [String]
unsafeMove allowed demanded event = case event of
  Moves n k from to _ c ->
    [ "line " <> show n <> ": " <> what
      | (True, what) <-
          [ (sideways from to && heightOf from /= Just above, "sideways at an unknown height"),
            (isNothing (heightOf to), "to an unknown height"),
            (isLow to && any isNothing to, "down at an unknown place"),
            (isLow to && lengthOf c /= loaded c, "the length of another tool"),
            (isLow to && isNothing (loaded c), "an unknown tool"),
            (isLow to && offset c /= demanded, "the work offset"),
            (isLow to && (k > 0 || take 1 from /= take 1 to) && isRadius c /= Just True, "G8"),
            (isLow to && isPlain c /= Just True, "G40"),
            (isLow to && any isNothing [isMetric c, isAbsolute c], "units or distances"),
            ((isLow from || isLow to) && isTooFar (blending c), "the path mode")
          ]
    ]
  Changes p | heightOf p /= Just above -> ["the tool is changed too low"]
  _ -> []
  where
    isTooFar = maybe True (> allowed + 1e-9)
    sideways a b = take 2 a /= take 2 b && isNothing (heightOf a)
    isLow p = maybe False (< above) (heightOf p)

-- Reasons -----------------------------------------------------------------------------------------

-- | Differences of two files that cut the same, each with its reason.
reasons :: Double -> [Event] -> [Event] -> ([String], [String]) -> [Maybe Reason]
reasons allowed old new files = case filter (/= Just InForce) found of
  [] -> [Just InForce]
  others -> others
  where
    found =
      concat (zipWith (cutReasons allowed) (cuts old) (cuts new))
        <> concat (zipWith (gapReasons allowed) (gaps old) (gaps new))
        <> [Just SpindleWait | spins old /= spins new]
        <> [Just IdleState | idle old /= idle new]
        <> zipWith stopReason (stopPlaces old) (stopPlaces new)
        <> [Just OtherEnd | ends (fst files) /= ends (snd files)]
    stopReason a b
      | a == b = Just InForce
      | heightOf b == Just above && take 2 a == take 2 b = Just StopAbove
      | otherwise = if distance a b <= allowed then Just InTolerance else Nothing
    spins = counted $ \case
      Waits s True -> Just s
      _ -> Nothing
    ends = take 1 . filter (`elem` ["M2", "M30"]) . map codeOf

-- | States of spindle and coolant at the machine's zero of z.
idle :: [Event] -> [(Int, ([Int], Maybe Int))]
idle = counted $ \case
  Moves _ _ _ [_, _, Just z] _ c | z == above -> Just (coolants c, turns c)
  _ -> Nothing

-- | Heights of the stops.
stopPlaces :: [Event] -> [Place]
stopPlaces = go []
  where
    go here events = case events of
      Moves _ _ _ to _ _ : rest -> go to rest
      Stops _ : rest -> here : go here rest
      _ : rest -> go here rest
      [] -> []

cutReasons :: Double -> Event -> Event -> [Maybe Reason]
cutReasons _ old new = case (old, new) of
  (Moves _ _ from to middle c, Moves _ _ from' to' middle' c') ->
    [Just InTolerance | (from, to, middle) /= (from', to', middle')]
      <> [Just RoundedRate | (feed c, rpm c) /= (feed c', rpm c')]
      <> [Just OtherBound | blending c /= blending c']
  _ -> [Nothing]

-- | Rapid moves between the cuts, as the positions that they lead to, with their states.
gaps :: [Event] -> [[(Place, Control)]]
gaps events = case break isCut events of
  (before, rest) -> route before : if null rest then [] else gaps (drop 1 rest)
  where
    isCut e = not (null (cuts [e]))
    route es = case [(from, c) | Moves _ _ from _ _ c <- take 1 (moves es)] of
      first -> first <> [(to, c) | Moves _ _ _ to _ c <- moves es]
    moves es = [e | e@(Moves _ _ from to _ _) <- es, from /= to]

-- | Reasons why two ways between two cuts may differ.
gapReasons :: Double -> [(Place, Control)] -> [(Place, Control)] -> [Maybe Reason]
gapReasons allowed old new
  | map fst old == map fst new = states
  | length old == length new && and (zipWith (near `onFirst`) old new) = Just InTolerance : states
  | merged old == merged new = [Just DividedMove]
  | isAway old || isAway new,
    all (\p -> awayFrom (ways old) p <= allowed) (ways new) =
    [Just AboveAll]
  | otherwise = [Nothing]
  where
    onFirst f a b = f (fst a) (fst b)
    near a b = a == b || distance a b <= allowed
    isAway route = any ((== Just above) . heightOf . fst) route
    ways route = [p | (p, _) <- route, notAbove p]
    notAbove p = maybe False (< above) (heightOf p)
    merged = straightened . map fst
    states =
      [Just OtherBound | map (blending . snd) old /= map (blending . snd) new]
        <> [ Nothing
             | or [notAbove a && used c /= used c' | ((a, c), (_, c')) <- zip old new]
           ]
    used c = (coolants c, turns c, loaded c, (lengthOf c, offset c))

-- | Positions without those in the line between their neighbours.
straightened :: [Place] -> [Place]
straightened places = case places of
  a : b : c : rest
    | a == b -> straightened (b : c : rest)
    | isBetween a b c -> straightened (a : c : rest)
    | otherwise -> a : straightened (b : c : rest)
  _ -> places
  where
    isBetween a b c = abs (distance a b + distance b c - distance a c) < 1e-9
