-- | An independent check of the frames for modern controls, by the interpreter of LinuxCNC: the
-- command @rs274@. It prints canonical calls, which say what a machine would do, with four
-- decimals. It may accept a program but understand it differently. So the moves of its calls are
-- compared with the toolpath.
module LinuxCnc
  ( installed,

    -- * The output of the interpreter
    Canonical (..),
    Position (..),
    canonical,
    parse,

    -- * The moves of the cutter
    Move (..),
    Speed (..),
    movesFrom,

    -- * The comparison with the expected moves
    Leg (..),
    exactly,
    differences,
    radii,
    legs,
  )
where

import Base.Quantity (Feed (..), Mm (..), Rad (..))
import Base.Region (Located (..))
import Data.Bifunctor (first)
import Data.Char (isSpace)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Read qualified as Read
import Geometry.Carrier (Sense (..))
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.CutFeed qualified as CutFeed
import Part.Part (Pace (..), SpacePoint (..))
import Part.Part qualified as Part
import System.Directory (findExecutable)
import System.Exit (ExitCode (..))
import System.IO.Temp (withSystemTempDirectory)
import System.Process (readProcessWithExitCode)
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | Is the interpreter installed?
installed :: IO Bool
installed = (/= Nothing) <$> findExecutable "rs274"

-- | A position: x, y and z in mm.
data Position = Position Double Double Double
  deriving stock (Eq, Show)

-- | A call that moves the cutter to a position. Feeds are in mm/min.
data Canonical
  = -- | a rapid move
    Traverse Position
  | -- | a straight move: its feed and its end
    Feeding Double Position
  | -- | an arc in the plane of x and y, or a helix: feed, sense, centre, end
    Rounding Double Sense Point Position
  deriving stock (Eq, Show)

-- | Runs a file and yields the calls that move the cutter. Yields the reason instead if the
-- interpreter complains, or if it prints an unknown call. The interpreter keeps its tool table in
-- the home folder, where another run could truncate it; so each run has a home folder of its own.
canonical :: FilePath -> IO (Either Text [Canonical])
canonical file = withSystemTempDirectory "partc-rs274" $ \home -> do
  (status, out, err) <- readProcessWithExitCode "env" ["HOME=" <> home, "rs274", "-g", file] ""
  -- The interpreter also prints "executing" on standard error, which is no complaint.
  let complaint = Text.strip (Text.unlines (filter (/= "executing") (Text.lines (Text.pack err))))
  pure $ case status of
    ExitFailure n ->
      Left (if Text.null complaint then "rs274 fails with status " <> said n else complaint)
    ExitSuccess
      | Text.null complaint -> parse (Text.pack out)
      | otherwise -> Left complaint

-- Canonical calls ---------------------------------------------------------------------------------

-- | The modal state: the unit of length in mm, the feed in such units per minute, and true if arcs
-- lie in the plane of x and y.
data State = State {scale :: Double, feed :: Double, isInXY :: Bool}

-- | Parses the calls that the interpreter prints, and keeps those that move the cutter.
parse :: Text -> Either Text [Canonical]
parse printed = go (State 1 0 True) (filter (not . Text.all isSpace) (Text.lines printed))
  where
    go _ [] = Right []
    go state (line : rest) = do
      (next, move) <- first (\why -> why <> ": " <> Text.strip line) (call state line)
      maybe id (:) move <$> go next rest

-- | Parses one call, given the state before it. Yields the state after it, and the call if it moves
-- the cutter.
call :: State -> Text -> Either Text (State, Maybe Canonical)
call state line = case name of
  "USE_LENGTH_UNITS" -> case arguments of
    ["CANON_UNITS_MM"] -> Right (state {scale = 1}, Nothing)
    ["CANON_UNITS_INCHES"] -> Right (state {scale = 25.4}, Nothing)
    _ -> Left "a unit that is not known"
  "SELECT_PLANE" -> Right (state {isInXY = arguments == ["CANON_PLANE_XY"]}, Nothing)
  "SET_FEED_RATE" -> (\ns -> (state {feed = sum ns}, Nothing)) <$> traverse number arguments
  "STRAIGHT_TRAVERSE" -> moved (fmap Traverse . place)
  "STRAIGHT_FEED" -> moved (fmap (Feeding rate) . place)
  "ARC_FEED" -> moved arc
  _
    -- Coordinates refer to the origin that these calls set.
    | name `elem` origins ->
      traverse number (drop (if name == "SET_G5X_OFFSET" then 1 else 0) arguments) >>= \ns ->
        if all (== 0) ns then nothing else Left "the zero has moved"
    | name `elem` harmless -> nothing
    | otherwise -> Left "a call that is not known"
  where
    -- A call comes after its number and the number of its line: "   18 N..... ARC_FEED(10.0000,
    -- 20.0000, …)".
    (name, given) = Text.breakOn "(" (Text.unwords (drop 2 (Text.words line)))
    arguments =
      filter
        (not . Text.null)
        (Text.split (`elem` [',', ' ']) (Text.dropWhileEnd (== ')') (Text.drop 1 given)))
    nothing = Right (state, Nothing)
    rate = feed state * scale state
    moved make = (\m -> (state, Just m)) <$> (traverse number arguments >>= make)
    place ns = case map (* scale state) ns of
      [x, y, z, 0, 0, 0] -> Right (Position x y z)
      _ -> Left "other axes move"
    arc ns = case ns of
      [x, y, i, j, turns, z, 0, 0, 0]
        | not (isInXY state) -> Left "an arc in another plane"
        | abs turns /= 1 -> Left "an arc of several turns"
        | otherwise ->
          Rounding
            rate
            (if turns > 0 then CounterClockwise else Clockwise)
            (Vec.point (i * scale state) (j * scale state))
            <$> place [x, y, z, 0, 0, 0]
      _ -> Left "an arc that is not understood"

origins, harmless :: [Text]
origins = ["SET_G5X_OFFSET", "SET_G92_OFFSET", "SET_XY_ROTATION", "USE_TOOL_LENGTH_OFFSET"]
harmless =
  ["COMMENT", "SET_FEED_REFERENCE", "SET_FEED_MODE", "ON_RESET", "PROGRAM_END", "PALLET_SHUTTLE"]
    <> [ "SET_SPINDLE_SPEED",
         "SET_SPINDLE_MODE",
         "START_SPINDLE_CLOCKWISE",
         "START_SPINDLE_COUNTERCLOCKWISE",
         "STOP_SPINDLE_TURNING"
       ]
    <> [ "DWELL",
         "SET_MOTION_CONTROL_MODE",
         "SET_NAIVECAM_TOLERANCE",
         "DISABLE_FEED_OVERRIDE",
         "ENABLE_FEED_OVERRIDE",
         "DISABLE_SPEED_OVERRIDE",
         "ENABLE_SPEED_OVERRIDE"
       ]
    <> [ "FLOOD_ON",
         "FLOOD_OFF",
         "MIST_OFF",
         "MIST_ON",
         "SELECT_TOOL",
         "CHANGE_TOOL",
         "START_CHANGE"
       ]

number :: Text -> Either Text Double
number t = case Read.signed Read.double t of
  Right (n, "") -> Right n
  _ -> Left ("no number: " <> t)

-- Moves -------------------------------------------------------------------------------------------

-- | A move: its segment in the plane, the heights of its start and its end in mm, and its speed.
data Move = Move {segment :: Segment, heights :: (Double, Double), speed :: Speed}
  deriving stock (Eq, Show)

-- | The speed of a move.
data Speed
  = InRapid
  | -- | mm/min
    AtFeed Double
  deriving stock (Eq, Show)

-- | The moves of some calls, beginning at the given position.
movesFrom :: Position -> [Canonical] -> [Move]
movesFrom _ [] = []
movesFrom from@(Position _ _ height) (c : rest) = case c of
  Traverse to -> straight to InRapid
  Feeding f to -> straight to (AtFeed f)
  Rounding f sense centre to ->
    let (a, b) = (flat from, flat to)
        whole =
          Segment.Arc
            { start = a,
              end = b,
              centre,
              sweep = Rad (if sense == Clockwise then -2 * pi else 2 * pi)
            }
     in continue to (if a == b then whole else Segment.arc sense centre a b) (AtFeed f)
  where
    straight to = continue to (Straight (flat from) (flat to))
    continue to@(Position _ _ z) moved speed = Move moved (height, z) speed : movesFrom to rest

-- | The point of the plane below a position.
flat :: Position -> Point
flat (Position x y _) = Vec.point x y

-- | A leg of the expected path: a chain of segments that the control may cut into other moves. Each
-- segment has the heights of its start and its end in mm. @within@ is the allowed distance of the
-- cutter from the chain, and @wanted@ its speed.
data Leg = Leg {chain :: NonEmpty (Segment, (Double, Double)), within :: Mm, wanted :: Speed}
  deriving stock (Eq, Show)

-- | The allowed distance from a line or arc that the control can make exactly. It covers the
-- rounding of both ends on the tape and the four printed decimals.
exactly :: Mm
exactly = Mm 0.002

-- | The allowed difference of feeds in mm/min. On the tape, feeds are whole numbers.
roundedFeed :: Double
roundedFeed = 0.5 + 1e-6

-- | The differences between expected legs and moves, in words. The moves must follow the legs in
-- order. Each leg takes the moves that lie on it, until it is covered and its end is reached.
differences :: [Leg] -> [Move] -> [Text]
differences expected = go (zip [1 :: Int ..] expected)
  where
    go remaining made = case remaining of
      [] ->
        [ said (length made) <> " moves too many, first " <> said (take 1 made)
          | not (null made)
        ]
      (n, leg) : others ->
        let near = takeWhile (liesOn leg) made
         in case [k | k <- [1 .. length near], isCoveredBy leg (take k near)] of
              k : _ ->
                ["leg " <> said n <> why | w <- take k near, why <- wrongSpeed leg w]
                  <> go others (drop k made)
              []
                | isSmall leg -> go others made
                | otherwise ->
                  [ "leg "
                      <> said n
                      <> " is not retraced: "
                      <> said leg
                      <> "; "
                      <> said (length near)
                      <> " moves lie on it, the next ones are "
                      <> said (take 2 (drop (length near) made))
                  ]
    isSmall leg =
      all
        (\(s, (a, b)) -> Segment.length s <= within leg && abs (b - a) <= mm (within leg))
        (chain leg)
    wrongSpeed leg w = [" runs at another speed: " <> said w | not (isSame (speed w) (wanted leg))]
    isSame a b = case (a, b) of
      (InRapid, InRapid) -> True
      (AtFeed f, AtFeed g) -> abs (f - g) <= roundedFeed
      _ -> False

said :: Show a => a -> Text
said = Text.pack . show

-- | Do the moves cover the whole leg, and do they end at the leg's end?
isCoveredBy :: Leg -> [Move] -> Bool
isCoveredBy leg made = case reverse made of
  [] -> False
  final : _ ->
    Vec.distance (Segment.end (segment final)) (Segment.end goal) <= exactly
      && abs (snd (heights final) - top) <= mm exactly
      && all (\(s, _) -> null (Distance.uncovered (within leg) (map segment made) s)) (chain leg)
  where
    (goal, (_, top)) = NonEmpty.last (chain leg)

-- | Does a move lie on the leg, in the plane and in height?
liesOn :: Leg -> Move -> Bool
liesOn leg move =
  null (Distance.uncovered (within leg) (map fst (NonEmpty.toList (chain leg))) (segment move))
    && and [any (contains p h) (chain leg) | (p, h) <- ends]
  where
    ends =
      [ (Segment.start (segment move), fst (heights move)),
        (Segment.end (segment move), snd (heights move))
      ]
    contains p h (s, (a, b))
      | Distance.toPoint p s > within leg = False
      | Segment.length s <= within leg =
        min a b - mm (within leg) <= h && h <= max a b + mm (within leg)
      | otherwise =
        abs (a + along s p * (b - a) - h)
          <= mm (within leg) * (1 + abs (b - a) / mm (Segment.length s))
    -- Close to the start of an arc, 'Segment.fraction' may yield the fraction of a full circle.
    along s p
      | Vec.distance p (Segment.start s) <= within leg && Segment.start s /= Segment.end s = 0
      | otherwise = max 0 (min 1 (Segment.fraction s p))

mm :: Mm -> Double
mm (Mm d) = d

-- | The arcs whose radii at start and end differ by more than 'exactly', in words. A control with a
-- stricter check than LinuxCNC would refuse such an arc.
radii :: [Move] -> [Text]
radii made = mapMaybe uneven [s | Move {segment = s@Arc {}} <- made]
  where
    uneven s =
      let (Mm a, Mm b) =
            (Vec.distance (centre s) (Segment.start s), Vec.distance (centre s) (Segment.end s))
       in if abs (a - b) <= mm exactly
            then Nothing
            else
              Just
                ("the radius is " <> said a <> " at the start and " <> said b <> " at the end")

-- | The start of a toolpath, and its legs on a machine with arcs. Lines and arcs allow the distance
-- 'exactly', curves the tolerance of their milling.
legs :: Toolpath -> (Position, [Leg])
legs path =
  ( beginning,
    concatMap
      (\block -> map (leg (allowed block)) (Toolpath.curveRuns (Toolpath.moves block)))
      (Toolpath.blocks path)
  )
  where
    beginning =
      let Located _ (SpacePoint p (Mm h)) = Toolpath.start path in Position (Vec.x p) (Vec.y p) h
    leg slack moves =
      Leg
        { chain = fmap whole moves,
          within = if Toolpath.isCurve moves then slack else exactly,
          wanted = asked (Toolpath.pace (NonEmpty.head moves))
        }
    whole m = let (Mm a, Mm b) = Toolpath.heights m in (Toolpath.segment m, (a, b))
    allowed block = case block of
      Toolpath.Cutting {Toolpath.job = Located _ job} ->
        let (Mm a, Mm b) =
              Part.deviationLimits (Part.tolerance job)
         in Mm (max a b + mm exactly)
      _ -> exactly
    asked pace = case pace of
      Rapid -> InRapid
      At (Located _ v) -> AtFeed (maybe 0 (\(Feed f) -> f) (CutFeed.perMinute v))
