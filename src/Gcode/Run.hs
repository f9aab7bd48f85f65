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
import Control.Monad (foldM, forM_, unless, when)
import Data.Maybe (fromMaybe, isJust, isNothing, listToMaybe, mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Gcode.Block
import Gcode.Dialect
import Gcode.ModalState
import Geometry.Carrier (Sense (..))
import Machine.ProgramForm (Dialect (..), Lathe (..), ProgramForm (..), Retract (..))

-- | One action, with the state in which it happens.
data Step = Step
  { -- | number of the line, from 1
    line :: Int,
    state :: ModalState,
    action :: Action
  }
  deriving stock (Eq, Show)

data Action
  = Travels Travel
  | -- | the control takes the tool with this number, at a position; Nothing if no T word came
    -- before
    Changes ToolPlace (Maybe Int)
  | Dwells Seconds
  | -- | M0
    Stops
  | -- | M1
    StopsOnDemand
  | -- | the file ends without a word that ends the program
    FileEnds
  | -- | M2 or M30
    Ends
  deriving stock (Eq, Show)

-- | A motion.
data Travel = Travel
  { mode :: MotionMode,
    from :: ToolPlace,
    to :: ToolPlace,
    -- | centre of an arc in its plane, by the two axes of the plane in the order x y or z x
    about :: Maybe (Int, Int)
  }
  deriving stock (Eq, Show)

-- | Position of the tool, along the axes X, Y and Z of the control.
data ToolPlace = ToolPlace {placeX :: Coordinate, placeY :: Coordinate, placeZ :: Coordinate}
  deriving stock (Eq, Show)

-- | Position along one axis.
data Coordinate
  = -- | unknown: where the machine stands
    Anywhere
  | -- | in machine coordinates, in picometres; Nothing for the reference point. It is not known
    -- where this is in the work
    InMachine (Maybe Int)
  | -- | the retract height, above everything
    Retracted
  | -- | in work coordinates, in picometres
    At Int
  deriving stock (Eq, Show)

-- | State between two lines.
data Running = Running {modal :: ModalState, place :: ToolPlace, isEnded :: Bool}

-- | Actions of a file in order; a fault for the first line that is not understood. @tool@ is the
-- number of the tool that the operator has put into the spindle for this file, if there is one.
-- Lines are numbered from @first@ on.
run :: ProgramForm -> Maybe Int -> Int -> Text -> Either Fault [Step]
run form tool first text = do
  lines' <- blocks (dialect form) first text
  checkNames lines'
  when (null lines') (Left (Fault first 1 NoWords))
  checkLengths form first text
  (final, steps) <- foldM next (begin, []) lines'
  let end = [Step (lineNumber (last lines')) (modal final) FileEnds | not (isEnded final)]
  pure (concat (reverse (end : steps)))
  where
    state0 = initial (dialect form)
    begin =
      Running
        { modal = state0 {toolInSpindle = maybe Unset (SetAt 0) tool},
          place = ToolPlace Anywhere Anywhere Anywhere,
          isEnded = False
        }
    next (now, done) b = do
      (now', steps) <- runBlock form now b
      pure (now', steps : done)

-- | Refuses the name of a program behind the first words of a file: another program begins there.
checkNames :: [GcodeBlock] -> Either Fault ()
checkNames list = case filter (not . null . gcodeWords) list of
  [] -> Right ()
  _ : more -> forM_ more $ \b ->
    forM_ [w | w <- gcodeWords b, letter w == 'O'] $ \w ->
      faultOf b w (UnprovenWord (wordText w))

-- | Refuses lines that are longer than the control reads.
checkLengths :: ProgramForm -> Int -> Text -> Either Fault ()
checkLengths form first text = case filter (isTooLong . snd) (zip [first ..] (Text.lines text)) of
  (n, _) : _ -> Left (Fault n (mostCharacters form + 1) (LineTooLong (mostCharacters form)))
  [] -> Right ()
  where
    isTooLong l = Text.length (Text.dropWhileEnd (== '\r') l) > mostCharacters form

-- | Words of a line, sorted by what they do.
data Sorted = Sorted
  { block :: GcodeBlock,
    -- | the numbers of the G words and of the M words, in tenths
    gCodes :: [Int],
    mCodes :: [Int],
    -- | the words of all other letters
    others :: [GcodeWord]
  }

-- | Runs one line.
runBlock :: ProgramForm -> Running -> GcodeBlock -> Either Fault (Running, [Step])
runBlock form now b = do
  s <- sorted form b
  when (isEnded now && not (null (gcodeWords b))) (faultAt b 1 BehindEnd)
  before <- modesBefore (dialect form) s (modal now)
  (changed, changeSteps) <- toolChange form s now {modal = before}
  let running = modesBehind form s changed
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

-- | Sorts the words of a line, and refuses words that the control does not have, and repetitions.
sorted :: ProgramForm -> GcodeBlock -> Either Fault Sorted
sorted form b = do
  checkForm form b
  gs <- codes 'G' (gKnowledge (dialect form)) (groupOfG (dialect form))
  ms <- codes 'M' (mKnowledge (dialect form)) (groupOfM (dialect form))
  let others = [w | w <- gcodeWords b, letter w `notElem` ("GMN" :: String)]
  forM_ (gcodeWords b) $ \w ->
    unless
      (letter w `elem` letters (dialect form) && not (isJust (lathe form) && isOfY w))
      (faultOf b w (UnknownWord (wordText w)))
  forM_ (zip [0 ..] others) $ \(k, w) ->
    when
      (letter w `elem` map letter (take k others))
      (faultOf b w (RepeatedWord (Text.singleton (letter w))))
  pure Sorted {block = b, gCodes = gs, mCodes = ms, others}
  where
    -- A lathe has no axis Y.
    isOfY w = letter w `elem` ("YJ" :: String)
    codes c knowledge group = do
      let found = [w | w <- gcodeWords b, letter w == c]
      numbers <- traverse (code knowledge) found
      forM_ (zip3 [0 ..] found numbers) $ \(k, w, n) ->
        when
          (group n `elem` map group (take k numbers) && group n > 0 || n `elem` take k numbers)
          (faultOf b w (RepeatedWord (wordText w)))
      pure numbers
    code knowledge w = case isWhole (tenfold (number w)) of
      Just n -> case knowledge n of
        Known -> Right n
        Unproven -> faultOf b w (UnprovenWord (wordText w))
        Absent -> faultOf b w (UnknownWord (wordText w))
      Nothing -> faultOf b w (UnknownWord (wordText w))
    tenfold (GcodeNumber d k) = GcodeNumber (10 * d) k

-- | Refuses lines that the operator may leave out, and for Marlin lines with two commands or with
-- words before the command.
checkForm :: ProgramForm -> GcodeBlock -> Either Fault ()
checkForm form b
  | isOptional b && dialect form `elem` [LinuxCnc, Fanuc] = faultAt b 1 (UnprovenWord "/")
  | dialect form == Marlin, _ : w : _ <- commandWords = faultOf b w (RepeatedWord (wordText w))
  | dialect form == Marlin,
    w : _ <- gcodeWords b,
    letter w `notElem` ("GMT" :: String) =
    faultOf b w NoMotionMode
  | dialect form == Marlin,
    [w] <- commandWords,
    letter w == 'M',
    isWhole (number w) `elem` [Just 0, Just 1],
    -- With a time the control goes on by itself.
    other : _ <- filter (/= w) (gcodeWords b) =
    faultOf b other (UnprovenWord (wordText other))
  | dialect form == Fanuc,
    w : _ <- filter isWithoutPoint (gcodeWords b) =
    faultOf b w (PointMissing (wordText w))
  | otherwise = Right ()
  where
    isWithoutPoint w =
      letter w `elem` ("XYZIJKRFQ" :: String) && not (hasPoint w) && digits (number w) /= 0
    commandWords = [w | w <- gcodeWords b, letter w `elem` ("GM" :: String)]

faultAt :: GcodeBlock -> Int -> FaultReason -> Either Fault a
faultAt b at reason = Left (Fault (lineNumber b) at reason)

faultOf :: GcodeBlock -> GcodeWord -> FaultReason -> Either Fault a
faultOf b w = faultAt b (column w)

wordText :: GcodeWord -> Text
wordText w = Text.singleton (letter w) <> numberText (number w)

-- | Number of the first word with a letter.
given :: Char -> Sorted -> Maybe GcodeNumber
given c s = listToMaybe [number w | w <- others s, letter w == c]

-- | The modes that are set before a tool change: feed mode, feed, speed and selected tool.
modesBefore :: Dialect -> Sorted -> ModalState -> Either Fault ModalState
modesBefore dialect' s m = do
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

-- | Value of a number as a floating-point number.
decimal :: GcodeNumber -> Double
decimal (GcodeNumber d k) = fromIntegral d / 10 ^ k

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
modesBehind form s now = now {modal = changed, place = placeAfter form m changed (place now)}
  where
    n = lineNumber (block s)
    m = modal now
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
          arcCentres = choose (arcCentres m) [(901, Absolute), (911, Incremental)],
          motionMode = motionAfter s m
        }

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
    [ (0, RapidMode),
      (10, LinearMode),
      (20, ArcMode Clockwise),
      (30, ArcMode CounterClockwise)
    ]

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

-- | Value in mm of a number, in the units of the state.
mmOfNumber :: ModalState -> GcodeNumber -> Double
mmOfNumber m k = decimal k * (if valueOf (units m) == Just Inches then 25.4 else 1)

-- | Value in picometres of a number, in the units of the state.
picometresOf :: ModalState -> GcodeNumber -> Int
picometresOf m k = case valueOf (units m) of
  Just Inches -> scaled 8 k * 254
  _ -> scaled 8 k * 10

-- | Value in mm of a count of picometres.
picometres :: Int -> Double
picometres n = fromIntegral n / 1.0e9

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
  | null axisWords && null arcWords = unusedWords s now >> Right (now, [])
  | otherwise = do
    mode' <- maybe (faultAt b 1 NoMotionMode) Right (valueOf (motionMode (modal now)))
    target <- targetOf form s now
    centre' <- case mode' of
      ArcMode sense -> Just <$> arcCentre s sense now target
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

-- | Centre of an arc, in the plane of the state.
arcCentre :: Sorted -> Sense -> Running -> ToolPlace -> Either Fault (Int, Int)
arcCentre s sense now target = do
  (begin, finish) <- maybe (faultAt b 1 (UnknownPosition 'X')) Right ends
  -- LinuxCNC refuses the offset along the axis of the plane, and offsets beside a radius.
  case [w | w <- others s, letter w `elem` useless] of
    w : _ -> faultOf b w (UnusedWord (Text.singleton (letter w)))
    [] -> Right ()
  case given 'R' s of
    Just r -> maybe (faultAt b 1 BadArc) Right (centreByRadius sense r' begin finish)
      where
        r' = picometresOf m r
    Nothing -> do
      let offsets = map (`given` s) letters'
      unless (any isJust offsets) (faultAt b 1 BadArc)
      let centre' = byOffsets begin (map (fmap (picometresOf m)) offsets)
      when (centre' == begin || centre' == finish) (faultAt b 1 BadArc)
      pure centre'
  where
    b = block s
    m = modal now
    useless
      | isJust (given 'R' s) = "IJK"
      | otherwise = filter (`notElem` letters') "IJK"
    inPlane p = case valueOf (plane m) of
      Just PlaneZX -> (placeZ p, placeX p)
      Just PlaneYZ -> (placeY p, placeZ p)
      _ -> (placeX p, placeY p)
    letters' = case valueOf (plane m) of
      Just PlaneZX -> ['K', 'I']
      Just PlaneYZ -> ['J', 'K']
      _ -> ['I', 'J']
    ends = case (inPlane (place now), inPlane target) of
      ((At a, At c), (At d, At e)) -> Just ((a, c), (d, e))
      _ -> Nothing
    byOffsets (x, y) offsets = case offsets of
      [i, j]
        | valueOf (arcCentres m) == Just Absolute -> (fromMaybe x i, fromMaybe y j)
        | otherwise -> (x + fromMaybe 0 i, y + fromMaybe 0 j)
      _ -> (x, y)

-- | Centre of an arc by its radius: of the two centres, a positive radius takes the one with the
-- smaller sweep. Nothing if the ends are equal or too far from one another.
centreByRadius :: Sense -> Int -> (Int, Int) -> (Int, Int) -> Maybe (Int, Int)
centreByRadius sense radius (x, y) (x', y')
  | chord == 0 || h2 < -1.0e-6 * r * r = Nothing
  | otherwise = Just (round (mx - k * dy), round (my + k * dx))
  where
    r = fromIntegral radius :: Double
    (dx, dy) = (fromIntegral (x' - x), fromIntegral (y' - y)) :: (Double, Double)
    chord = sqrt (dx * dx + dy * dy)
    (mx, my) = (fromIntegral x + dx / 2, fromIntegral y + dy / 2)
    h2 = r * r - chord * chord / 4
    k = side * sqrt (max 0 h2) / chord
    side = if (sense == CounterClockwise) == (radius > 0) then 1 else -1

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
      | letter w `elem` ("IJKR" :: String) = if isArc (modal now) then Nothing else Just w
      | letter w == 'H' = if 430 `elem` gs then Nothing else Just w
      | letter w == 'P' = if any (`elem` gs) [40, 640] then Nothing else Just w
      | letter w == 'D' = if 960 `elem` gs then Nothing else Just w
      | letter w == 'Q' = if 640 `elem` gs then Nothing else Just w
      | otherwise = Just w
