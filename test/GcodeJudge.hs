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
    reasonText,
  )
where

import Data.Maybe (isNothing)
import Data.List (nub)
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
  | -- | another way to the machine's zero of z or from there, with the same lowest points
    AboveAll
  | -- | spindle or coolant differ only while the tool is at the machine's zero of z, or after the
    -- last motion: M6 and M2 stop the spindle
    IdleState
  | -- | a stop with the tool at the machine's zero of z in place of the height over the same point
    StopAbove
  | -- | M30 in place of M2
    OtherEnd
  deriving stock (Eq, Ord, Show, Enum, Bounded)

-- | Words for a reason.
reasonText :: Reason -> String
reasonText reason = case reason of
  NotRead -> "a comment, the number of a line, an empty line, or text that the control does not read"
  InForce -> "sets what is in force already, or what no motion uses"
  InTolerance -> "a position or a centre within the tolerance"
  RoundedRate -> "a feed or speed that is rounded to the same number"
  OtherBound -> "another bound of the path mode, within the tolerance"
  SpindleWait -> "the wait for the spindle is longer, shorter or left out"
  DividedMove -> "a rapid move in one or more lines"
  AboveAll -> "another way at the retract height, with the same lowest points"
  IdleState -> "spindle or coolant differ only at the retract height or after the last motion"
  StopAbove -> "a stop at the retract height, over the same point"
  OtherEnd -> "M30 in place of M2"

-- | Compares an edited file with the one before the edit. @allowed@ is the tolerance of the program
-- and one pulse, in mm.
verdict :: Double -> [String] -> [String] -> Verdict
verdict allowed before after = case (trace before, trace after) of
  (Left why, _) -> Changed ("the file before the edit is not understood: " <> why)
  (_, Left why) -> Changed why
  (Right old, Right new) -> case concat (changes allowed old new) of
    why : _ -> Changed why
    []
      | old == withLines old new, codes before == codes after -> Same [Just NotRead]
      | otherwise -> Same (nub (reasons allowed old new (before, after)))
  where
    codes = takeWhile (/= "M2") . filter (not . null) . map (dropNumber . codeOf)
    dropNumber line = case words line of
      ('N' : _) : rest -> unwords rest
      ws -> unwords ws

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

-- | Differences that change what is cut, or cut in an unsafe state.
changes :: Double -> [Event] -> [Event] -> [[String]]
changes allowed old new =
  [ ["cuts are lost or added" | length (cuts old) /= length (cuts new)],
    concat (zipWith (changedCut allowed) (cuts old) (cuts new)),
    ["rapid moves in the material" | not (sameLow allowed (lowRapids old) (lowRapids new))],
    concatMap (unsafeMove allowed demanded) new,
    ["another stop" | stopsOf old /= stopsOf new],
    ["another wait" | not (sameWaits (waitsOf old) (waitsOf new))]
  ]
  where
    demanded = case cuts old of
      Moves _ _ _ _ _ c : _ -> offset c
      _ -> Nothing
    sameWaits as bs = map fst as == map fst bs && and (zipWith (\a b -> abs (snd a - snd b) < 0.0005) as bs)

-- | Motions that cut. A line without length is none.
cuts :: [Event] -> [Event]
cuts events = [e | e@(Moves _ k from to _ _) <- events, k > 0, k > 1 || from /= to]

-- | Things that happen, each with the count of cuts before it.
counted :: (Event -> Maybe a) -> [Event] -> [(Int, a)]
counted f = go 0
  where
    go n events = case events of
      [] -> []
      e : rest -> [(n, a) | Just a <- [f e]] <> go (if null (cuts [e]) then n else n + 1) rest

stopsOf :: [Event] -> [(Int, Int)]
stopsOf = counted $ \e -> case e of
  Stops k -> Just k
  _ -> Nothing

-- | Waits, without those for the spindle.
waitsOf :: [Event] -> [(Int, Double)]
waitsOf = counted $ \e -> case e of
  Waits s False -> Just s
  _ -> Nothing

-- | Differences of two cuts.
changedCut :: Double -> Event -> Event -> [String]
changedCut allowed old new = case (old, new) of
  (Moves _ k from to middle c, Moves n k' from' to' middle' c') ->
    [ "line " <> show n <> ": " <> what
      | (True, what) <-
          [ (k /= k', "another kind of cut"),
            (distance from from' > allowed || distance to to' > allowed, "a cut elsewhere"),
            (apart middle middle', "an arc about another centre"),
            (differs 0.5 (feed c) (feed c'), "another feed"),
            (differs 0.5 (rpm c) (rpm c') || turns c /= turns c', "the spindle"),
            (plane c' /= Just 17, "the plane"),
            (feedWay c' /= Just 94, "the kind of feed"),
            (isNothing (hasAbsoluteCentres c') && k > 1, "centres of arcs"),
            (loaded c /= loaded c', "another tool"),
            (coolants c /= coolants c', "the coolant")
          ]
    ]
  _ -> ["no cuts"]
  where
    apart a b = case (a, b) of
      (Just (x, y), Just (x', y')) -> distance [Just x, Just y] [Just x', Just y'] > allowed
      _ -> False

-- | Test that two numbers differ by more than a half: rates are rounded.
differs :: Double -> Maybe Double -> Maybe Double -> Bool
differs most a b = case (a, b) of
  (Just x, Just y) -> abs (x - y) > most
  _ -> a /= b

-- | Distance of two positions; unknown ones are far from all others.
distance :: Place -> Place -> Double
distance a b = maybe 1e9 (sqrt . sum) (sequence (zipWith square a b))
  where
    square p q = (\x y -> (x - y) * (x - y)) <$> p <*> q

-- | Parts of rapid moves below the top of the material, each with the count of cuts before it.
lowRapids :: [Event] -> [(Int, (Place, Place))]
lowRapids = counted $ \e -> case e of
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
  Moves n _ from to _ c ->
    [ "line " <> show n <> ": " <> what
      | (True, what) <-
          [ (sideways from to && height from /= Just above, "sideways at an unknown height"),
            (isNothing (height to), "to an unknown height"),
            (isLow to && any isNothing to, "down at an unknown place"),
            (isLow to && (lengthOf c /= loaded c || isNothing (loaded c)), "the length of the tool"),
            (isLow to && offset c /= demanded, "the work offset"),
            (isLow to && (isRadius c /= Just True || isPlain c /= Just True), "G8 or G40"),
            (isLow to && any isNothing [isMetric c, isAbsolute c], "units or distances"),
            ((isLow from || isLow to) && maybe True (> allowed + 1e-9) (blending c), "the path mode")
          ]
    ]
  _ -> []
  where
    height p = case drop 2 p of
      z : _ -> z
      [] -> Nothing
    sideways a b = take 2 a /= take 2 b && isNothing (height a)
    isLow p = maybe False (< above) (height p)

-- Reasons -----------------------------------------------------------------------------------------

-- | Differences of two files that cut the same, each with its reason.
reasons :: Double -> [Event] -> [Event] -> ([String], [String]) -> [Maybe Reason]
reasons allowed old new files = if null found then [Just InForce] else found
  where
    found =
      concat (zipWith (cutReasons allowed) (cuts old) (cuts new))
        <> concat (zipWith (gapReasons allowed) (gaps old) (gaps new))
        <> [Just SpindleWait | spins old /= spins new]
        <> [Just IdleState | idle old /= idle new]
        <> [Just StopAbove | stopPlaces old /= stopPlaces new]
        <> [Just OtherEnd | ends (fst files) /= ends (snd files)]
    spins = counted $ \e -> case e of
      Waits s True -> Just s
      _ -> Nothing
    ends = take 1 . filter (`elem` ["M2", "M30"]) . map codeOf

-- | States of spindle and coolant at the machine's zero of z.
idle :: [Event] -> [(Int, ([Int], Maybe Int))]
idle = counted $ \e -> case e of
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
  | isAway old && isAway new && ways old `near'` ways new = [Just AboveAll]
  | otherwise = [Nothing]
  where
    onFirst f a b = f (fst a) (fst b)
    near a b = a == b || distance a b <= allowed
    near' as bs = length as == length bs && and (zipWith near as bs)
    isAway route = or [True | ([_, _, Just z], _) <- route, z == above]
    ways route = [p | p <- merged route, p /= [] , notAbove p]
    notAbove p = case p of
      [_, _, Just z] -> z < above
      _ -> False
    merged = straightened . map fst
    states =
      [Just OtherBound | map (blending . snd) old /= map (blending . snd) new]
        <> [ Nothing
             | or [isWorking a && used c /= used c' | ((a, c), (_, c')) <- zip old new]
           ]
    isWorking p = notAbove p
    used c = (coolants c, turns c, loaded c, lengthOf c, offset c)

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
