-- | Reports of an earlier text, shown in a later one.
--
-- The passes after evaluation may take long. Until they have ended, an editor shows their reports
-- on the last text that they have seen, at the positions that correspond in the present text.
module Query.CarriedReport
  ( carried,
  )
where

import Base.Region (Region)
import Base.Region qualified as Region
import Data.Maybe (mapMaybe)
import Query.RegionMap (RegionMap)
import Query.RegionMap qualified as RegionMap
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Report.Fix (Fix (..), FixEdit (..), FixText (..))
import Report.Report (Label (..), Report (..), ReportPlace (..))
import Report.Report qualified as Report

-- | The reports of a snapshot that has only the results of evaluation, together with the reports of
-- later passes in a settled snapshot @before@. A report on a part of the text that has changed is
-- left out.
carried :: Snapshot -> Snapshot -> [Report]
carried before now = Report.sorted (Snapshot.reports now <> mapMaybe (moved regionMap) later)
  where
    later = Snapshot.laterReports before
    regionMap = RegionMap.between (textOf before) (textOf now)
    textOf = Region.text . Snapshot.source

-- | The report at the corresponding place; nothing if its place has changed.
moved :: RegionMap -> Report -> Maybe Report
moved regionMap r = case place r of
  InSource region -> placed . InSource <$> forward region
  _ -> Just (placed (place r))
  where
    placed there =
      r
        { place = there,
          others = [Label there' note | Label at note <- others r, Just there' <- [forward at]],
          fixes = mapMaybe fix (fixes r)
        }
    fix f = withEdits f <$> traverse edit (edits f)
    withEdits f moved' = f {edits = moved'}
    edit e = FixEdit <$> forward (replaced e) <*> traverse part (parts e)
    part p = case p of
      Written _ -> Just p
      Copied region -> Copied <$> forward region
    forward :: Region -> Maybe Region
    forward = RegionMap.forward regionMap
