{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | The report of a @units@ statement that does not stand at the beginning of its file.
module Surface.FileUnitReport
  ( misplaced,
  )
where

import Base.Region (Region)
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), at)

-- | The report of a @units@ statement at the region @region@. @first@ is the region of the first
-- one in the file if this is not the first. @offset@ is where the statement belongs.
misplaced :: Region -> Maybe Region -> Int -> Report
misplaced region first offset = case first of
  Just other ->
    (at region "E0122" "the units are given twice")
      { others = [Label other "given here"],
        fixes = [Fix.proposed (Fix.removal "Remove the second statement." region)]
      }
  Nothing ->
    (at region "E0122" "‘units’ does not stand at the beginning of the program")
      { fixes = [Fix.move "Move it to the beginning." region offset],
        hints = ["Only part may stand above units, which hold for all lengths of the file."]
      }
