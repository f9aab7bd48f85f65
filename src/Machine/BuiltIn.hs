-- | The machines that partc knows by itself.
module Machine.BuiltIn
  ( machines,
    find,
  )
where

import Data.List qualified as List
import Machine.Lkp01f (lkp01f)
import Machine.Machine (Machine, MachineName)
import Machine.Machine qualified as Machine

machines :: [Machine]
machines = [lkp01f]

find :: MachineName -> Maybe Machine
find name = List.find ((== name) . Machine.name) machines
