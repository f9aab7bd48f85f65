-- | Tools of a program in the order of their use, each with its feeds and the time of its work.
module Draw.ToolUse
  ( ToolUse (..),
    uses,
    blocksWithTools,
    sizeText,
    numberText,
    feedText,
    cutFeed,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Feed (..), LengthUnit, Mm (..), Seconds (..), plus, times, total)
import Base.Region (Located (..))
import Data.Containers.ListUtils (nubOrd)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.MoveTime qualified as MoveTime
import Part.CutFeed (CutFeed (..), SpindleRate (..))
import Part.CutFeed qualified as CutFeed
import Part.Part (Cutter, CutterKind, Pace (..))
import Part.Part qualified as Part
import Toolpath.Toolpath (Block (..), Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | One tool of a program. The same tool that comes again has one entry.
data ToolUse = ToolUse
  { -- | number of the tool; Nothing if the program gives none
    number :: Maybe Int,
    cutter :: Cutter,
    -- | feeds at which the tool cuts, the smallest one first
    feeds :: [CutFeed],
    -- | time of all moves with this tool at the feeds of the program; rapid moves count as 0 s
    time :: Seconds
  }

-- | Tools that cut, in the order of their use. The second number of a pair in 'blocksWithTools' is
-- a position in this list.
uses :: Toolpath -> [ToolUse]
uses path =
  [ ToolUse
      { number = n,
        cutter = c,
        feeds = nubOrd (concatMap feedsOf (Map.findWithDefault [] k blocksOf)),
        time = total (map timeOf (Map.findWithDefault [] k blocksOf))
      }
    | (k, (n, c)) <- workers path
  ]
  where
    blocksOf =
      Map.fromListWith
        (<>)
        [(keyOf tool, [b]) | (Just tool, b) <- reverse (inSpindle path)]
    timeOf b = total (map (MoveTime.moveTime Nothing) (Toolpath.moves b)) `plus` dwellOf b
    dwellOf b = case b of
      Commanding (Located _ (Part.Dwell t)) -> t
      _ -> Seconds 0

-- | Key by which the same tool is found again: its number, kind and radius.
type ToolKey = (Maybe Int, Text, Mm)

keyOf :: (Maybe Int, Cutter) -> ToolKey
keyOf (n, c) = (n, wordOf (Part.kind c), Part.cutterRadius c)

-- | Tools that cut, each once.
workers :: Toolpath -> [(ToolKey, (Maybe Int, Cutter))]
workers path = [(k, tool) | k <- nubOrd (map fst found), Just tool <- [Map.lookup k firsts]]
  where
    found = [(keyOf tool, tool) | (Just tool, b) <- inSpindle path, isWork b]
    firsts = Map.fromListWith (\_ old -> old) found

-- | Blocks of a toolpath, each with the position of its tool in 'uses'; Nothing if no tool is known
-- or if it never cuts.
blocksWithTools :: Toolpath -> [(Maybe Int, Block)]
blocksWithTools path = [(tool >>= position, b) | (tool, b) <- inSpindle path]
  where
    position t = Map.lookup (keyOf t) positions
    positions :: Map ToolKey Int
    positions = Map.fromList (zip (map fst (workers path)) [0 ..])

-- | Blocks of a toolpath, each with the tool in the spindle.
inSpindle :: Toolpath -> [(Maybe (Maybe Int, Cutter), Block)]
inSpindle path = go first (Toolpath.blocks path)
  where
    setup = Toolpath.setup path
    first = (value <$> Toolpath.firstToolNumber setup,) <$> Toolpath.firstCutter setup
    go tool blocks = case blocks of
      [] -> []
      b@(Commanding (Located _ (Part.ChangeTool n c))) : more ->
        (Just (Just n, c), b) : go (Just (Just n, c)) more
      b : more -> (tool, b) : go tool more

isWork :: Block -> Bool
isWork block = case block of
  Cutting {} -> True
  Clearing {} -> True
  Holing {} -> True
  Carved {} -> True
  Travelling {} -> False
  Commanding _ -> False

-- | Feeds at which a block cuts.
feedsOf :: Block -> [CutFeed]
feedsOf block = case block of
  Cutting {cut} -> paced (NonEmpty.toList cut)
  Clearing {cleared} -> paced (filter (uncurry (==) . Toolpath.heights) (NonEmpty.toList cleared))
  Holing (Located _ d) _ -> [cutFeed (value (Part.drillFeed d))]
  Carved (Located _ c) _ _ -> [cutFeed (value (Part.carvingFeed c))]
  Travelling {} -> []
  Commanding _ -> []
  where
    paced ms = nubOrd (mapMaybe (ofPace . Toolpath.pace) ms)
    ofPace p = case p of
      Rapid -> Nothing
      At (Located _ f) -> Just (cutFeed f)

-- | Feed as the program gives it, without the rate of the spindle.
cutFeed :: CutFeed -> CutFeed
cutFeed = CutFeed.atRate NoRate

-- | Number of a tool in the form T1; empty without a number.
numberText :: ToolUse -> Text
numberText = maybe "" (\n -> "T" <> Decimal.whole n) . number

-- | Kind and size of a tool, such as @cutter Ø 12@, without the unit.
sizeText :: LengthUnit -> ToolUse -> Text
sizeText unit ToolUse {cutter} = wordOf (Part.kind cutter) <> " " <> Decimal.shortIn unit 4 size
  where
    size = case Part.kind cutter of
      Part.TurningCutter -> Part.cutterRadius cutter
      _ -> times 2 (Part.cutterRadius cutter)

-- | Feeds of a tool with their unit: one, or the smallest and the largest; empty without a feed.
feedText :: LengthUnit -> [CutFeed] -> Text
feedText unit given = Text.intercalate ", " (range perMinute "/min" <> range perTurn "/rev")
  where
    perMinute = [Mm v | PerMinute (Feed v) <- given]
    perTurn = [d | PerTurn d _ <- given]
    written = Decimal.shortIn unit 3
    range values per = case values of
      [] -> []
      _
        | minimum values == maximum values -> [written (minimum values) <> unitPer per]
        | otherwise -> [written (minimum values) <> "–" <> written (maximum values) <> unitPer per]
    unitPer per = " " <> Decimal.unitText unit <> per

-- | Word for a tool and its size.
wordOf :: CutterKind -> Text
wordOf kind = case kind of
  Part.MillingCutter -> "cutter Ø"
  Part.DrillingCutter -> "drill Ø"
  Part.ConeCutter -> "cone Ø"
  Part.VBitCutter -> "V-bit Ø"
  Part.DovetailCutter -> "dovetail Ø"
  Part.BladeCutter _ -> "blade Ø"
  Part.TappingCutter -> "tap Ø"
  Part.ThreadCutter _ -> "thread mill Ø"
  Part.TurningCutter -> "nose R"
