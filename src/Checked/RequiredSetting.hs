-- | Checks that a program has the statements that it needs, in the right order.
--
-- A program begins with @part@. A setting of the whole program, such as the tolerance, may occur
-- only once and not in a block. A machining statement or a move without cutting needs certain
-- settings above it, such as the tool and the feed.
module Checked.RequiredSetting
  ( check,
  )
where

import Base.Region (Located (..), Region (..))
import Checked.Error (Error (..), StatementMove (..))
import Checked.ProgramSetting (ProgramSetting (..))
import Control.Applicative ((<|>))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (isJust, isNothing, listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.HoleForm qualified as HoleForm
import Surface.Syntax (Statement)
import Surface.Syntax qualified as Surface

-- | Checks the statements of a program. The mistakes are in the order of the text.
check :: [Statement] -> [Error]
check statements = partFirst statements <> go Map.empty (concatMap (flatten Nothing) statements)
  where
    go seen ss = case ss of
      s : rest | (seen', errors) <- step seen s rest -> seen' `seq` (errors <> go seen' rest)
      [] -> []

-- | Reports a program whose first statement is not @part@. Broken statements do not count: one of
-- them may be the statement that is missing.
partFirst :: [Statement] -> [Error]
partFirst statements = case dropWhile isBroken statements of
  Located _ (Surface.Part _ _) : _ -> []
  Located at _ : _ | not (any isBroken (take 1 statements)) -> [NoPart at {end = start at}]
  _ -> [NoPart (Region 0 0) | null statements]
  where
    isBroken (Located _ s) = case s of
      Surface.Broken _ _ -> True
      _ -> False

-- | A statement that may be in a block: the start of the outermost statement with a block around
-- it, if there is one.
type Placed = (Maybe Int, Statement)

-- | The statements in the blocks of a statement; for a statement without blocks, the statement
-- itself. @outer@ is the start of the outermost statement around it.
flatten :: Maybe Int -> Statement -> [Placed]
flatten outer s@(Located at _) = case s of
  Located _ (Surface.Repeat _ _ body) -> concatMap (flatten top) body
  Located _ (Surface.When _ body others) -> concatMap (flatten top) (body <> others)
  Located _ (Surface.With _ body) -> concatMap (flatten top) body
  _ -> [(outer, s)]
  where
    top = outer <|> Just (start at)

-- | The settings that occurred so far, with the regions of their first statements. If a setting is
-- missing, it is reported and added without a region, so that it is reported only once.
type Seen = Map ProgramSetting (Maybe Region)

-- | Checks one statement. @seen@ are the settings above it, and @below@ are the statements below
-- it. The result contains the settings for the next statement, and the mistakes.
step :: Seen -> Placed -> [Placed] -> (Seen, [Error])
step seen (outer, Located at s) below = (seen', misplaced <> missing <> repeated)
  where
    Requirement {keywordLength, given = own, needed, isGlobal} = requirement s
    keyword = at {end = start at + keywordLength}
    misplaced =
      [ NotInBlock keyword (globalKeyword s) (StatementMove at offset)
        | isGlobal,
          Just offset <- [outer]
      ]
    missing = case NonEmpty.nonEmpty (filter (not . (`Map.member` seen)) needed) of
      Just settings ->
        [SettingsMissing keyword (machiningKeyword s) (fmap (\n -> (n, givenBelow n)) settings)]
      Nothing -> []
    repeated =
      [ SettingTwice at setting before
        | Just setting <- [own],
          setting `notElem` [FeedSetting, ClearanceSetting],
          not (isChange s),
          null misplaced,
          Just (Just before) <- [Map.lookup setting seen]
      ]
    -- The statement below that gives a setting, unless one of them is in a block.
    givenBelow setting =
      listToMaybe
        [ there
          | isNothing outer,
            (Nothing, Located there other) <- below,
            given (requirement other) == Just setting,
            not (isChange other)
        ]
    now = [(setting, Nothing) | setting <- needed] <> [(setting, Just at) | Just setting <- [own]]
    seen' = Map.unionWith (<|>) seen (Map.fromList now)

-- | The keyword of a statement that needs settings.
machiningKeyword :: Surface.Statement_ -> Text
machiningKeyword s = case s of
  Surface.Mill {} -> "mill"
  Surface.Pocket {} -> "pocket"
  Surface.RestOf {} -> "rest"
  Surface.Face {} -> "face"
  Surface.Engrave {} -> "engrave"
  Surface.Vcarve {} -> "vcarve"
  Surface.Turn {} -> "turn"
  Surface.Drill {} -> "drill"
  Surface.Hole work _ _ _ _ -> HoleForm.word work
  Surface.Travel Surface.RapidMotion _ -> "rapid"
  Surface.Change {} -> "change"
  _ -> "move"

-- | Is a statement a @change@, which sets another tool? A program may have several @change@
-- statements, but only one @tool@ statement.
isChange :: Surface.Statement_ -> Bool
isChange s = case s of
  Surface.Change {} -> True
  Surface.Broken (Just "change") _ -> True
  _ -> False

-- | The setting that a statement makes, and the settings that it needs above it.
data Requirement = Requirement
  { -- | the number of characters of the statement's keyword; reports point at the keyword
    keywordLength :: Int,
    -- | the setting that the statement makes; 'Nothing' if it makes none of type 'ProgramSetting'
    given :: Maybe ProgramSetting,
    -- | the settings that must occur above the statement
    needed :: [ProgramSetting],
    -- | true if the statement applies to the whole program and is not allowed in a block
    isGlobal :: Bool
  }

requirement :: Surface.Statement_ -> Requirement
requirement s = case s of
  Surface.Part _ _ -> global PartSetting
  Surface.Machine _ -> global MachineSetting
  Surface.Tool _ _ -> global ToolSetting
  Surface.Tolerance _ -> global ToleranceSetting
  Surface.From _ -> global FromSetting
  Surface.WorkOffset _ -> global WorkSetting
  Surface.ProgramNumber _ -> global NumberSetting
  Surface.SafeHeight _ -> global SafeSetting
  Surface.Stock _ _ -> global StockSetting
  Surface.Avoid _ _ -> none {keywordLength = 5}
  Surface.Import _ -> none {keywordLength = 6, isGlobal = True}
  Surface.Param _ _ -> none {keywordLength = 5, isGlobal = True}
  Surface.Feed _ -> none {given = Just FeedSetting}
  Surface.Clearance _ -> none {given = Just ClearanceSetting}
  Surface.Change _ _ place ->
    none {keywordLength = 6, given = Just ToolSetting, needed = [FromSetting | isJust place]}
  Surface.Mill _ _ options -> none {needed = milling <> forDepth options}
  Surface.Pocket _ _ _ options -> none {keywordLength = 6, needed = milling <> forDepth options}
  Surface.RestOf {} -> none {needed = ClearanceSetting : milling}
  Surface.Face {} -> none {needed = ClearanceSetting : milling}
  Surface.Engrave {} -> none {keywordLength = 7, needed = ClearanceSetting : milling}
  Surface.Vcarve {} -> none {keywordLength = 6, needed = ClearanceSetting : milling}
  Surface.Turn {} -> none {needed = milling}
  Surface.Drill {} ->
    none {keywordLength = 5, needed = [ToolSetting, FeedSetting, FromSetting, ClearanceSetting]}
  Surface.Hole work _ _ _ _ ->
    none
      { keywordLength = Text.length (HoleForm.word work),
        needed =
          [ToolSetting, FromSetting, ClearanceSetting]
            <> [FeedSetting | work /= Surface.Tapping]
            <> [ToleranceSetting | work `elem` milledWorks]
      }
  Surface.Travel Surface.RapidMotion _ -> none {keywordLength = 5, needed = [FromSetting]}
  Surface.Travel Surface.FeedMotion stops ->
    none
      { needed =
          FromSetting :
            [FeedSetting | any ((== Surface.Cutting) . Surface.pace) (NonEmpty.toList stops)]
      }
  Surface.Broken keyword _ -> none {given = keyword >>= (`lookup` settingByKeyword)}
  _ -> none
  where
    none = Requirement {keywordLength = 4, given = Nothing, needed = [], isGlobal = False}
    global setting =
      Requirement
        { keywordLength = Text.length (globalKeyword s),
          given = Just setting,
          needed = [],
          isGlobal = True
        }
    milledWorks = [Surface.Boring, Surface.Counterboring, Surface.Threading]
    milling = [ToolSetting, FeedSetting, ToleranceSetting, FromSetting]
    forDepth options = [ClearanceSetting | or [True | Located _ (Surface.Depth _ _) <- options]]

-- | The keywords of the statements that make settings, each with its setting. They serve statements
-- of which the parser could read only the keyword.
settingByKeyword :: [(Text, ProgramSetting)]
settingByKeyword =
  [ ("part", PartSetting),
    ("machine", MachineSetting),
    ("tool", ToolSetting),
    ("change", ToolSetting),
    ("feed", FeedSetting),
    ("tolerance", ToleranceSetting),
    ("clearance", ClearanceSetting),
    ("from", FromSetting),
    ("work", WorkSetting),
    ("program", NumberSetting),
    ("safe", SafeSetting),
    ("stock", StockSetting)
  ]

-- | The keyword of a statement that applies to the whole program, for the report of such a
-- statement in a block.
globalKeyword :: Surface.Statement_ -> Text
globalKeyword s = case s of
  Surface.Part _ _ -> "part"
  Surface.Machine _ -> "machine"
  Surface.Tool _ _ -> "tool"
  Surface.Tolerance _ -> "tolerance"
  Surface.From _ -> "from"
  Surface.WorkOffset _ -> "work"
  Surface.ProgramNumber _ -> "program"
  Surface.SafeHeight _ -> "safe"
  Surface.Stock _ _ -> "stock"
  Surface.Import _ -> "import"
  Surface.Param _ _ -> "param"
  _ -> "this"
