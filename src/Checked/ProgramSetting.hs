{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | The settings that a statement makes for the statements below it or for the whole program.
module Checked.ProgramSetting
  ( ProgramSetting (..),
    description,
    example,
  )
where

import Data.Text (Text)

-- | A setting that a statement such as @tool@ makes. Other statements may need it above them.
data ProgramSetting
  = PartSetting
  | MachineSetting
  | ToolSetting
  | FeedSetting
  | ToleranceSetting
  | FromSetting
  | ClearanceSetting
  | WorkSetting
  | NumberSetting
  | SafeSetting
  | StockSetting
  deriving stock (Eq, Ord, Show)

-- | The words for a setting in a report.
description :: ProgramSetting -> Text
description setting = case setting of
  PartSetting -> "the name of the part"
  MachineSetting -> "the machine"
  ToolSetting -> "the tool"
  FeedSetting -> "the feed"
  ToleranceSetting -> "the tolerance"
  FromSetting -> "the starting point"
  ClearanceSetting -> "the clearance height"
  WorkSetting -> "the work offset"
  NumberSetting -> "the number of the program"
  SafeSetting -> "the safe height"
  StockSetting -> "the stock"

-- | A statement that makes a setting.
example :: ProgramSetting -> Text
example setting = case setting of
  PartSetting -> "part NAME"
  MachineSetting -> "machine lkp-01f"
  ToolSetting -> "tool mill(diameter 20 mm)"
  FeedSetting -> "feed 60 mm/min"
  ToleranceSetting -> "tolerance 0.02 mm"
  FromSetting -> "from (0, 0)"
  ClearanceSetting -> "clearance 5 mm"
  WorkSetting -> "work 54"
  NumberSetting -> "program 1"
  SafeSetting -> "safe 40 mm"
  StockSetting -> "stock rectangle(100, 60) from -20 to 0"
