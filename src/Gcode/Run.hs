-- | Runs the lines of a G-code file: each motion and each command, with the state of the control.
--
-- The words of a line act in the order of the RS274/NGC interpreter (Kramer, Proctor and Messina,
-- NISTIR 6556, table 8), whatever their order in the line. A line that the control would not take,
-- or whose motion cannot be known, is a fault.
--
-- Positions are whole picometres (10^-9 mm) along the axes of the control, so decimal numbers in mm
-- and in inches are exact.
module Gcode.Run
  ( Step (..),
    Action (..),
    Travel (..),
    ToolPlace (..),
    Coordinate (..),
    run,
    picometres,
  )
where

import Base.Quantity (Mm (..), Seconds (..))
import Control.Monad (foldM, forM_, join, unless, when)
import Data.Foldable (traverse_)
import Data.List (foldl')
import Data.Maybe (fromMaybe, isJust, isNothing, listToMaybe, mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Gcode.ArcCentre (arcCentre)
import Gcode.Block
import Gcode.BlockWords
import Gcode.ControlMotion
import Gcode.Cycle qualified as Cycle
import Gcode.Dialect
import Gcode.ModalState
import Geometry.Carrier (Sense (..))
import Machine.ProgramForm (Dialect (..), Lathe (..), ProgramForm (..), Retract (..))

-- | State between two lines.
data Running = Running
  { modal :: ModalState,
    place :: ToolPlace,
    isEnded :: Bool,
    -- | number of the last line
    reached :: Int,
    -- | true behind the first line with words
    hasWords :: Bool,
    -- | the sizes of the canned cycle in force that stay for its next lines, by their letters:
    -- lengths in picometres, and the time in seconds
    cycleSizes :: [(Char, GcodeNumber)],
    -- | height before the canned cycles in force, in picometres; Nothing outside of them
    cycleLevel :: Maybe Int
  }

-- | Actions of a file in order; a fault for the first line that is not understood. @tool@ is the
-- number of the tool that the operator has put into the spindle for this file, if there is one.
-- Lines are numbered from @first@ on.
run :: ProgramForm -> Maybe Int -> Int -> Text -> Either Fault [Step]
run form tool first text = do
  (final, steps) <- foldM next (begin, []) (blocks (dialect form) first text)
  when (reached final < first) (Left (Fault first 1 NoWords))
  maybe (Right ()) Left tooLong
  let end = [Step (reached final) (modal final) FileEnds | not (isEnded final)]
  pure (reverse (end <> steps))
  where
    tooLong = longLine form first text
    state0 = initial (dialect form)
    begin =
      Running
        { modal = state0 {toolInSpindle = maybe Unset (SetAt 0) tool},
          place = ToolPlace Anywhere Anywhere Anywhere,
          isEnded = False,
          reached = first - 1,
          hasWords = False,
          cycleSizes = [],
          cycleLevel = Nothing
        }
    next (now, done) line' = do
      b <- line'
      forM_ tooLong $ \fault@(Fault n _ _) -> when (lineNumber b >= n) (Left fault)
      when (hasWords now) (checkNames b)
      (now', steps) <- runBlock form now b
      let after = foldl' (\before step -> step `seq` step : before) done steps
      -- Steps that wait to be evaluated would keep their lines in memory.
      after `seq` pure (behind b now', after)
    behind b now =
      now {reached = lineNumber b, hasWords = hasWords now || not (null (gcodeWords b))}

-- | Refuses the name of a program in a line behind the first words of a file: another program
-- begins there.
checkNames :: GcodeBlock -> Either Fault ()
checkNames b =
  forM_ [w | w <- gcodeWords b, letter w == 'O'] $ \w -> faultOf b w (UnprovenWord (wordText w))

-- | Fault of the first line that is longer than the control reads, if there is one.
longLine :: ProgramForm -> Int -> Text -> Maybe Fault
longLine form first text =
  listToMaybe
    [ Fault n (mostCharacters form + 1) (LineTooLong (mostCharacters form))
      | (n, l) <- zip [first ..] (Text.lines text),
        isTooLong l
    ]
  where
    isTooLong l = Text.length (Text.dropWhileEnd (== '\r') l) > mostCharacters form

-- | Runs one line.
runBlock :: ProgramForm -> Running -> GcodeBlock -> Either Fault (Running, [Step])
runBlock form now b = do
  s <- sorted form b
  when (isEnded now && not (null (gcodeWords b))) (faultAt b 1 BehindEnd)
  before <- modesBefore (dialect form) s (modal now)
  (changed, changeSteps) <- toolChange form s now {modal = before}
  let running = cyclesBehind now (modesBehind form s changed)
  dwelt <- dwellOf form s
  (moved, motionSteps) <- motionOf form s running
  let stopSteps =
        [step moved Stops | 0 <- mCodes s]
          <> [step moved StopsOnDemand | 10 <- mCodes s]
          <> [step moved Ends | m <- mCodes s, m `elem` [20, 300]]
      ended = isEnded moved || any (`elem` [20, 300]) (mCodes s)
  pure
    ( moved {isEnded = ended},
      changeSteps <> [step running (Dwells t) | Just t <- [dwelt]] <> motionSteps <> stopSteps
    )
  where
    step r = Step (lineNumber b) (modal r)

-- | The modes that are set before a tool change: feed mode, feed, speed and selected tool.
modesBefore :: Dialect -> Sorted -> ModalState -> Either Fault ModalState
modesBefore dialect' s m
  | onlyMoves s = Right m
  | otherwise = do
    tool <- traverse whole (given 'T' s)
    when (960 `elem` gCodes s && isNothing (given 'S' s)) $
      faultAt (block s) 1 (WordMissing "S" "G96")
    pure
      m
        { feedMode = choose (feedMode m) [(930, InverseTime), (940, PerMinute), (950, PerTurn)],
          speed = maybe (speed m) (SetAt n . decimal) (given 'S' s),
          speedMode = choose (speedMode m) [(960, ConstantCutting limit), (970, ConstantTurns)],
          -- The control starts the spindle before it sets the units of the same line.
          speedUnits = if isOfSpeed then units m else speedUnits m,
          selectedTool = maybe (selectedTool m) (SetAt n) tool,
          units = newUnits,
          feed = feedAfter
        }
  where
    newUnits = choose (units m) [(200, Inches), (210, Millimetres)]
    -- LinuxCNC takes F before the units of the same line, and its words for the kind of feed set
    -- the feed to 0.
    feedAfter = case given 'F' s of
      Just k
        | dialect' /= LinuxCnc -> SetAt n (mmOfNumber m {units = newUnits} k)
        | isNothing (valueOf (units m)) -> Unset
        | otherwise -> SetAt n (mmOfNumber m k)
      Nothing
        | dialect' == LinuxCnc && any (`elem` gCodes s) [930, 940, 950] -> SetAt n 0
        | otherwise -> feed m
    isOfSpeed =
      isJust (given 'S' s)
        || any (`elem` gCodes s) [960, 970]
        || any (`elem` mCodes s) [30, 40]
    n = lineNumber (block s)
    choose = chosen n (gCodes s)
    limit = round . decimal <$> given 'D' s
    whole k = case isWhole k of
      Just t
        | t >= 0 -> Right t
        | otherwise -> faultAt (block s) 1 (NegativeNumber "T")
      Nothing -> faultAt (block s) 1 (NotWhole "T")

-- | True for a line that changes no mode but the kind of motion. Most lines are like this.
onlyMoves :: Sorted -> Bool
onlyMoves s =
  null (mCodes s)
    && all (`elem` [0, 10, 20, 30]) (gCodes s)
    && not (any ((`elem` ("FST" :: String)) . letter) (others s))

-- | Part of the state after a line with these codes: the value of the code that it has, else the
-- value before.
chosen :: Int -> [Int] -> Modal a -> [(Int, a)] -> Modal a
chosen n codes before table = case [a | (c, a) <- table, c `elem` codes] of
  a : _ -> SetAt n a
  [] -> before

-- | Changes the tool if the line has M6. The spindle stops, and the control keeps the length of the
-- tool before. Many machines go to a place of their own for the change, but no nearer to the work.
toolChange :: ProgramForm -> Sorted -> Running -> Either Fault (Running, [Step])
toolChange form s now
  | 60 `notElem` mCodes s = Right (now, [])
  | otherwise =
    Right
      ( now {modal = changed, place = ToolPlace across Anywhere (kept (placeZ (place now)))},
        [Step n changed (Changes (place now) (valueOf (selectedTool m)))]
      )
  where
    n = lineNumber (block s)
    m = modal now
    across = if isJust (lathe form) then kept (placeX (place now)) else Anywhere
    kept c = case c of
      Retracted -> Retracted
      _ -> Anywhere
    changed =
      m
        { toolInSpindle = maybe Unset (SetAt n) (valueOf (selectedTool m)),
          toolLength = SetAt n LengthOfOther,
          spindle = SetAt n SpindleStopped
        }

-- | The modes that are set after a tool change and before the motion. A change of the zero of the
-- work coordinates makes the position unknown.
modesBehind :: ProgramForm -> Sorted -> Running -> Running
modesBehind form s now
  | onlyMoves s =
    if valueOf mode == valueOf (motionMode m) then now else now {modal = m {motionMode = mode}}
  | otherwise = now {modal = changed, place = placeAfter form m changed (place now)}
  where
    n = lineNumber (block s)
    m = modal now
    mode = motionAfter s m
    choose = chosen n (gCodes s)
    chooseM = chosen n (mCodes s)
    changed =
      m
        { spindle =
            chooseM
              (spindle m)
              [ (30, SpindleTurning Clockwise),
                (40, SpindleTurning CounterClockwise),
                (50, SpindleStopped)
              ],
          coolant = coolantAfter n (mCodes s) (coolant m),
          plane = choose (plane m) [(170, PlaneXY), (180, PlaneZX), (190, PlaneYZ)],
          diameters = choose (diameters m) [(70, True), (80, False)],
          compensates = choose (compensates m) [(400, False)],
          toolLength = lengthAfter s m,
          workOffset = choose (workOffset m) [(10 * k, k) | k <- [54 .. 59]],
          pathMode = choose (pathMode m) [(610, ExactPath), (611, ExactPath), (640, blended s m)],
          distances = choose (distances m) [(900, Absolute), (910, Incremental)],
          returnsToPlane = choose (returnsToPlane m) [(980, False), (990, True)],
          arcCentres = choose (arcCentres m) [(901, Absolute), (911, Incremental)],
          motionMode = mode
        }

-- | The sizes of canned cycles after a line that follows the state @before@: those of another cycle
-- do not count.
cyclesBehind :: Running -> Running -> Running
cyclesBehind before now = case valueOf (motionMode (modal now)) of
  Just (CycleMode c)
    | valueOf (motionMode (modal before)) == Just (CycleMode c) -> now
    | otherwise -> now {cycleSizes = []}
  _ -> now {cycleSizes = [], cycleLevel = Nothing}

-- | The length of the tool after a line.
lengthAfter :: Sorted -> ModalState -> Modal ToolLength
lengthAfter s m
  | 490 `elem` gCodes s = SetAt n NoLength
  | 430 `elem` gCodes s = case given 'H' s of
    Just k -> maybe Unset (SetAt n . LengthOf) (isWhole k)
    Nothing -> maybe Unset (SetAt n . LengthOf) (valueOf (toolInSpindle m))
  | otherwise = toolLength m
  where
    n = lineNumber (block s)

-- | The path mode of G64. Q is the tolerance of the merging of short motions; without Q it is P.
blended :: Sorted -> ModalState -> PathMode
blended s m = Blended $ case (given 'P' s, given 'Q' s) of
  (Just p, Nothing) | digits p > 0 -> Just (Mm (2 * mm p))
  (Just p, Just q) | digits p > 0, digits q >= 0 -> Just (Mm (mm p + mm q))
  _ -> Nothing
  where
    mm = mmOfNumber m

-- | The motion mode after a line. G80 ends all motion modes; Fanuc may have another one beside it.
motionAfter :: Sorted -> ModalState -> Modal MotionMode
motionAfter s m =
  chosen
    (lineNumber (block s))
    (gCodes s)
    (if 800 `elem` gCodes s then Unset else motionMode m)
    ( [ (0, RapidMode),
        (10, LinearMode),
        (20, ArcMode Clockwise),
        (30, ArcMode CounterClockwise)
      ]
        <> [(Cycle.codeOf c, CycleMode c) | c <- [minBound ..]]
    )

-- | The position in work coordinates after a change of the state from @before@ to @after@: unknown
-- where the zero of the coordinates has changed.
placeAfter :: ProgramForm -> ModalState -> ModalState -> ToolPlace -> ToolPlace
placeAfter form before after p
  | valueOf (workOffset after) /= valueOf (workOffset before) =
    withoutHeight {placeX = moved (placeX p), placeY = moved (placeY p)}
  | valueOf (toolLength after) /= valueOf (toolLength before) =
    -- The tool table of a lathe has a length along X too.
    if isJust (lathe form) then withoutHeight {placeX = moved (placeX p)} else withoutHeight
  | otherwise = p
  where
    withoutHeight = p {placeZ = moved (placeZ p)}
    moved c = case c of
      At _ -> Anywhere
      InMachine q -> InMachine q
      Retracted -> Retracted
      Anywhere -> Anywhere

-- | Coolant after a line with these M codes. Mist and flood may run together.
coolantAfter :: Int -> [Int] -> Modal Coolant -> Modal Coolant
coolantAfter n codes before
  | 90 `elem` codes = SetAt n CoolantOff
  | 70 `elem` codes = with Mist Flood
  | 80 `elem` codes = with Flood Mist
  | otherwise = before
  where
    with new other
      | valueOf before `elem` [Just other, Just MistAndFlood] = SetAt n MistAndFlood
      | otherwise = SetAt n new

-- | The dwell of a line.
dwellOf :: ProgramForm -> Sorted -> Either Fault (Maybe Seconds)
dwellOf form s
  | 40 `notElem` gCodes s = Right Nothing
  | Just p <- given 'P' s, digits p < 0 = faultAt (block s) 1 (NegativeNumber "P")
  | Just p <- given 'P' s = Right (Just (Seconds (decimal p * perUnit)))
  | Just p <- given 'S' s, dialect form == Marlin = Right (Just (Seconds (decimal p)))
  | Just x <- given 'X' s, dialect form == Fanuc = Right (Just (Seconds (decimal x)))
  | otherwise = faultAt (block s) 1 (WordMissing "P" "G4")
  where
    perUnit = dwellPerUnit (dialect form)

-- Motions -----------------------------------------------------------------------------------------

-- | Carries out the motion of a line.
motionOf :: ProgramForm -> Sorted -> Running -> Either Fault (Running, [Step])
motionOf form s now
  | 40 `elem` gCodes s = wordsBesideDwell form s >> Right (now, [])
  | 280 `elem` gCodes s = toReference form s now
  | 530 `elem` gCodes s && null axisWords = faultAt b 1 (WordMissing "Z0" "G53")
  | Just (CycleMode c) <- valueOf (motionMode (modal now)),
    530 `notElem` gCodes s =
    cycleOf form c s now
  | null axisWords && null arcWords = unusedWords s now >> Right (now, [])
  | otherwise = do
    mode' <- maybe (faultAt b 1 NoMotionMode) Right (valueOf (motionMode (modal now)))
    target <- targetOf form s now
    centre' <- case mode' of
      ArcMode sense -> Just <$> arcCentre s sense (modal now) (place now) target
      _ -> Right Nothing
    unusedWords s now
    let travel = Travel mode' (place now) target centre'
        -- The machine takes the tool to where the target is, so the state keeps it.
        moved = now {place = target}
    pure (moved, [Step (lineNumber b) (modal now) (Travels travel)])
  where
    b = block s
    axisWords = [w | w <- others s, letter w `elem` ("XYZ" :: String)]
    arcWords = [w | w <- others s, letter w `elem` ("IJKR" :: String), isArc (modal now)]

-- | Carries out a canned cycle: the tool goes over the hole, down to the height R, and makes the
-- hole. A line without words of positions or of R only sets what stays for the next lines.
cycleOf :: ProgramForm -> CannedCycle -> Sorted -> Running -> Either Fault (Running, [Step])
cycleOf form c s now
  | null moving && Cycle.codeOf c `notElem` gCodes s = unusedWords s now >> Right (kept, [])
  | otherwise = do
    unless (valueOf (distances m) == Just Absolute) (faultAt b 1 (WordMissing "G90" (Cycle.name c)))
    unless (valueOf (plane m) == Just PlaneXY) (faultAt b 1 (WordMissing "G17" (Cycle.name c)))
    unusedWords s now
    target <- targetOf form s now
    let start = place now
        beside = (placeX target, placeY target) /= (placeX start, placeY start)
    z <- case (placeX target, placeY target, placeZ start) of
      (At _, At _, At z) -> Right z
      (At _, At _, _) -> faultAt b 1 (UnknownPosition 'Z')
      (At _, _, _) -> faultAt b 1 (UnknownPosition 'Y')
      _ -> faultAt b 1 (UnknownPosition 'X')
    when (c == SynchronousCycle && beside) (faultAt b 1 (UnprovenWord (Cycle.name c)))
    (sizes, level) <- cycleForm form c b kept z
    pitch <- traverse (cycleSize c b kept) ['K' | c == SynchronousCycle]
    let rises = start {placeZ = At (max z (Cycle.plane sizes))}
        over = target {placeZ = placeZ rises}
        rapid p p' = Step (lineNumber b) m (Travels (Travel RapidMode p p' Nothing))
        (end, made) =
          foldl'
            (cycleStep (lineNumber b) (fedBy pitch m))
            ((over, m), [])
            (Cycle.RapidTo (Cycle.plane sizes) : Cycle.steps sizes)
    pure
      ( kept {place = fst end, cycleLevel = Just level},
        [rapid p p' | (p, p') <- [(start, rises), (rises, over)], p /= p'] <> reverse made
      )
  where
    b = block s
    m = modal now
    moving = [w | w <- others s, letter w `elem` ("XYZR" :: String)]
    written = [(letter w, number w) | w <- others s, letter w `elem` ("ZRQPK" :: String)]
    kept = now {cycleSizes = written <> cycleSizes now}

-- | A size of a cycle, by its letter, from this line or from one before it.
cycleSize :: CannedCycle -> GcodeBlock -> Running -> Char -> Either Fault GcodeNumber
cycleSize c b now l =
  maybe
    (faultAt b 1 (WordMissing (Text.singleton l) (Cycle.name c)))
    Right
    (lookup l (cycleSizes now))

-- | The sizes of a cycle that begins at the height @z@, and the height to which G98 leads back.
cycleForm ::
  ProgramForm ->
  CannedCycle ->
  GcodeBlock ->
  Running ->
  Int ->
  Either Fault (Cycle.CycleForm Int, Int)
cycleForm form c b now z = do
  bottom <- inPicometres <$> needed 'Z'
  r <- if c == SynchronousCycle then Right z else inPicometres <$> needed 'R'
  q <- traverse (fmap inPicometres . needed) ['Q' | c `elem` [PeckingCycle, ChipCycle]]
  traverse_ needed ['P' | c == DwellingCycle]
  -- Controls differ in the way up to a height R above the tool.
  when (r < bottom || any (<= 0) q || z < r && dialect form /= LinuxCnc) (faultAt b 1 BadCycle)
  let level = maximum [r, z, fromMaybe z (cycleLevel now)]
  final <- case valueOf (returnsToPlane (modal now)) of
    Just True -> Right r
    Just False -> Right level
    Nothing
      | level == r -> Right r
      | otherwise -> faultAt b 1 (WordMissing "G98" (Cycle.name c))
  pure
    ( Cycle.CycleForm
        { Cycle.canned = c,
          Cycle.dialect = dialect form,
          Cycle.plane = r,
          Cycle.bottom = bottom,
          Cycle.final = if c == SynchronousCycle then r else final,
          Cycle.peck = listToMaybe q,
          Cycle.back = maybe 0 lengthOf (join (lookup c (Cycle.known (cycles form)))),
          Cycle.wait =
            Seconds . (* dwellPerUnit (dialect form)) . decimal <$> lookup 'P' (cycleSizes now)
        },
      level
    )
  where
    needed = cycleSize c b now
    inPicometres = picometresOf (modal now)
    lengthOf (Mm l) = round (l * 1.0e9)

-- | State in which a tap is fed in step with the spindle, by the pitch; other cycles have the feed
-- in force.
fedBy :: [GcodeNumber] -> ModalState -> ModalState
fedBy pitch m = case (pitch, valueOf (speed m)) of
  ([k], Just n) ->
    m {feed = maybe Unset (`SetAt` (mmOfNumber m k * n)) (lineOf (speed m)), feedMode = perMinute}
  _ -> m
  where
    perMinute = maybe (SetAt 0 PerMinute) (`SetAt` PerMinute) (lineOf (feedMode m))

-- | Carries out a step of a canned cycle, after the place and the state before it and the steps
-- before it, of which the last one comes first. @fed@ is the state with the feed of the cycle.
cycleStep ::
  Int ->
  ModalState ->
  ((ToolPlace, ModalState), [Step]) ->
  Cycle.CycleStep Int ->
  ((ToolPlace, ModalState), [Step])
cycleStep n fed ((at, m), done) step = case step of
  Cycle.RapidTo z -> go RapidMode m z
  Cycle.FeedTo z -> go LinearMode m {feed = feed fed, feedMode = feedMode fed} z
  Cycle.Wait t -> ((at, m), Step n m (Dwells t) : done)
  Cycle.Reversal -> ((at, m {spindle = turned (spindle m)}), done)
  Cycle.Forward -> ((at, m {spindle = turned (spindle m)}), done)
  where
    go kind' m' z
      | to' == at = ((at, m), done)
      | otherwise = ((to', m), Step n m' (Travels (Travel kind' at to' Nothing)) : done)
      where
        to' = at {placeZ = At z}
    turned part = case part of
      SetAt k (SpindleTurning Clockwise) -> SetAt k (SpindleTurning CounterClockwise)
      SetAt k (SpindleTurning CounterClockwise) -> SetAt k (SpindleTurning Clockwise)
      other -> other

-- | True if the kind of motion in force is an arc.
isArc :: ModalState -> Bool
isArc m = case valueOf (motionMode m) of
  Just (ArcMode _) -> True
  _ -> False

-- | Position at the end of the motion of a line.
targetOf :: ProgramForm -> Sorted -> Running -> Either Fault ToolPlace
targetOf form s now = ToolPlace <$> along 'X' placeX <*> along 'Y' placeY <*> along 'Z' placeZ
  where
    b = block s
    m = modal now
    along c at = case given c s of
      Nothing -> Right (at (place now))
      Just k
        | 530 `elem` gCodes s -> inMachine c k
        | valueOf (distances m) == Just Incremental -> case at (place now) of
          At p -> Right (At (p + value c k))
          _ -> faultAt b 1 (UnknownPosition c)
        | otherwise -> Right (At (value c k))
    value c k
      | c == 'X' && valueOf (diameters m) == Just True = picometresOf m k `div` 2
      | otherwise = picometresOf m k
    inMachine c k
      | valueOf (motionMode m) `notElem` [Just RapidMode, Just LinearMode] =
        faultAt b 1 (WordMissing "G0" "G53")
      | valueOf (distances m) /= Just Absolute = faultAt b 1 (WordMissing "G90" "G53")
      | c == 'Z',
        MachineHeight (Mm h) <- retract form,
        isJust (valueOf (units m)) || digits k == 0,
        abs (picometres (picometresOf m k) - h) < 1.0e-6 =
        Right Retracted
      | c == 'X',
        Just Lathe {crossRetract = Mm h} <- lathe form,
        isJust (valueOf (diameters m)),
        isJust (valueOf (units m)) || digits k == 0,
        abs (picometres (value c k) - h) < 1.0e-6 =
        Right Retracted
      | otherwise = Right (InMachine (Just (value c k)))

-- | Carries out G28: the axes that the line names go to the reference point. Only G28 with
-- increments of 0 is understood, because any other goes through another point first.
toReference :: ProgramForm -> Sorted -> Running -> Either Fault (Running, [Step])
toReference form s now
  -- The zero of a Haas is its reference point.
  | retract form `notElem` [ReferencePoint, MachineHeight (Mm 0)] =
    faultAt b 1 (UnprovenWord "G28")
  | null axes = faultAt b 1 (WordMissing "Z0" "G28")
  | valueOf (distances (modal now)) /= Just Incremental = faultAt b 1 (WordMissing "G91" "G28")
  | any ((/= 0) . digits . number) axes = faultAt b 1 (UnprovenWord "G28")
  | otherwise =
    Right (now {place = target}, [Step (lineNumber b) (modal now) (Travels travel)])
  where
    b = block s
    axes = [w | w <- others s, letter w `elem` ("XYZ" :: String)]
    names c = c `elem` map letter axes
    p = place now
    target =
      ToolPlace
        (if names 'X' then InMachine Nothing else placeX p)
        (if names 'Y' then InMachine Nothing else placeY p)
        (if names 'Z' then Retracted else placeZ p)
    travel = Travel RapidMode p target Nothing

-- | Refuses words of motions in the line of a dwell: some controls would move as well. Fanuc has
-- the time in X.
wordsBesideDwell :: ProgramForm -> Sorted -> Either Fault ()
wordsBesideDwell form s = case filter isOfMotion (others s) of
  w : _ -> faultOf (block s) w (UnusedWord (Text.singleton (letter w)))
  [] -> Right ()
  where
    isOfMotion w =
      letter w `elem` ("XYZIJKRHQ" :: String) && not (letter w == 'X' && dialect form == Fanuc)

-- | Refuses words that nothing in the line uses.
unusedWords :: Sorted -> Running -> Either Fault ()
unusedWords s now = case mapMaybe unused (others s) of
  w : _ -> faultOf (block s) w (UnusedWord (Text.singleton (letter w)))
  [] -> Right ()
  where
    gs = gCodes s
    unused w
      | letter w `elem` ("XYZFSTNO" :: String) = Nothing
      | Just (CycleMode c) <- valueOf (motionMode (modal now)),
        letter w `elem` Cycle.words' c =
        Nothing
      | letter w `elem` ("IJKR" :: String) = if isArc (modal now) then Nothing else Just w
      | letter w == 'H' = if 430 `elem` gs then Nothing else Just w
      | letter w == 'P' = if any (`elem` gs) [40, 640] then Nothing else Just w
      | letter w == 'D' = if 960 `elem` gs then Nothing else Just w
      | letter w == 'Q' = if 640 `elem` gs then Nothing else Just w
      | otherwise = Just w
