-- | Classes of cuts, which a drawing shows in different line styles: by depth, by tool or by feed.
module Draw.CutClass
  ( Colouring (..),
    CutClass (..),
    classes,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..))
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Draw.Scene (Cut (..), Scene (cuts, tools))
import Draw.Scene qualified as Scene
import Draw.ToolUse (ToolUse)
import Draw.ToolUse qualified as ToolUse
import Geometry.Segment (Segment)

-- | Property of the cuts that their line styles show.
data Colouring = OneColour | ByDepth | ByTool | ByFeed
  deriving stock (Eq, Show, Enum, Bounded)

-- | Class: the words for it, and the paths of its cuts.
data CutClass = CutClass {caption :: Text, chains :: [[Segment]]}

-- | Classes that occur in a scene, in the order of the legend: depths from the top down, tools in
-- the order of their use, feeds from the slowest. Many depths or feeds are put into few ranges.
classes :: Colouring -> LengthUnit -> Scene -> [CutClass]
classes colouring unit scene = case colouring of
  OneColour -> [CutClass "cutter path" (map chain (cuts scene)) | not (null (cuts scene))]
  ByDepth ->
    [ CutClass ("z " <> depthRange unit ends) paths
      | (ends, paths) <- inRanges (sorted [(downwards (height c), [chain c]) | c <- cuts scene])
    ]
  ByTool ->
    [ CutClass (maybe "no tool" (nameOf unit) (k >>= toolAt)) paths
      | (k, paths) <- Map.toList (sorted [(tool c, [chain c]) | c <- cuts scene])
    ]
  ByFeed ->
    [ CutClass (ToolUse.feedText unit (NonEmpty.toList ends)) paths
      | (ends, paths) <- inRanges (sorted [(f, [ss]) | c <- cuts scene, (f, ss) <- feedRuns c])
    ]
  where
    chain = NonEmpty.toList . Scene.lines
    toolAt k = case drop k (tools scene) of
      t : _ -> Just t
      [] -> Nothing
    downwards (Mm z) = Mm (negate z)

-- | Lists of each key in their order. From the end, each list is put before a longer one in
-- constant time.
sorted :: Ord k => [(k, [a])] -> Map k [a]
sorted = Map.fromListWith (<>) . reverse

-- | Name of a tool in the legend.
nameOf :: LengthUnit -> ToolUse -> Text
nameOf unit t =
  Text.unwords (filter (/= "") [ToolUse.numberText t, ToolUse.sizeText unit t])

-- | Range of depths below the top, as heights.
depthRange :: LengthUnit -> NonEmpty Mm -> Text
depthRange unit ends
  | first == final = first
  | otherwise = first <> " … " <> final
  where
    first = written (NonEmpty.head ends)
    final = written (NonEmpty.last ends)
    written (Mm d) = Text.replace "-" "−" (Decimal.shortIn unit 2 (Mm (negate d)))

-- | Values and their paths, in at most 'most' ranges of neighbouring values with as many values
-- each.
inRanges :: Map k [a] -> [(NonEmpty k, [a])]
inRanges values =
  [ (k :| map fst more, concatMap snd run)
    | run@((k, _) : more) <- pieces (Map.toList values)
  ]
  where
    width = (Map.size values + most - 1) `div` most
    pieces list = case splitAt width list of
      ([], _) -> []
      (run, rest) -> run : pieces rest

-- | Greatest count of ranges, for each of which there is a colour.
most :: Int
most = 6
