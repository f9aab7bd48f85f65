-- | Mends a program by the fixes of its reports.
--
-- A report with one fix says what the user meant. A report with several fixes, or with a proposal,
-- leaves a choice, and is left alone. A change is kept only if the passes up to the one that made
-- the report find no more mistakes than before. Later passes may find more, because an earlier
-- mistake hides theirs.
module Project.FixRun
  ( AppliedFix (..),
    Mended (..),
    mend,
  )
where

import Base.Region (Position, Region (..), Source)
import Base.Region qualified as Region
import Data.List (foldl')
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Fix (Fix (..), FixEdit (replaced))
import Report.Fix qualified as Fix
import Report.Report (Report (code, fixes), ReportCode (..))

-- | Fix that was applied: its place in the text before it, and its title.
data AppliedFix = AppliedFix {place :: Position, summary :: Text}
  deriving stock (Eq, Show)

-- | Result of mending: the new text, the changes in order, and the reports that are left, with the
-- source to which their regions refer.
data Mended = Mended {newText :: Text, changes :: [AppliedFix], left :: [Report], source :: Source}

-- | Text with the fixes that led to it, its source and its reports.
data State = State {seen :: Set Text, result :: Mended}

-- | Mends the program of a text. The first argument checks a text; it gives the source and the
-- sorted reports.
mend :: Monad m => (Text -> m (Source, [Report])) -> Text -> m Mended
mend check text = do
  (source, left) <- check text
  let begin = Mended {newText = text, changes = [], left, source}
  step State {seen = Set.singleton text, result = begin} (choices begin)
  where
    step state untried = case untried of
      [] -> pure (result state)
      chosen : others
        | Set.member new (seen state) || Set.size (seen state) > mostTexts -> step state others
        | otherwise -> do
          (source', left') <- check new
          let known = state {seen = Set.insert new (seen state)}
              mended =
                Mended
                  { newText = new,
                    changes = changes now <> map (applied (source now) . snd) chosen,
                    left = left',
                    source = source'
                  }
          if isBetter (map fst chosen) (left now) left'
            then step known {result = mended} (choices mended)
            else step known others
        where
          now = result state
          new = Fix.applied (source now) (concatMap (edits . snd) chosen)

-- | Largest count of texts that are checked, so that mending ends.
mostTexts :: Int
mostTexts = 200

-- | True if the passes up to those of the mended reports find no more mistakes than before.
isBetter :: [Report] -> [Report] -> [Report] -> Bool
isBetter mended before now = count now <= count before
  where
    count = length . filter ((<= last') . passOf)
    last' = maximum (map passOf mended)

-- | Number of the pass that makes a report: the first two digits of its code.
passOf :: Report -> Text
passOf r = let ReportCode c = code r in Text.take 2 (Text.drop 1 c)

-- | Sets of fixes with their reports that are tried one after the other: all that do not overlap at
-- once, then each one alone.
choices :: Mended -> [[(Report, Fix)]]
choices mended = case apart single of
  [] -> []
  [one] -> [[one]]
  together -> together : map pure single
  where
    single =
      [ (r, f)
        | r <- left mended,
          [f] <- [fixes r],
          not (isProposal f),
          Fix.isWithin (source mended) f
      ]

-- | Fixes of a list that overlap none before them.
apart :: [(Report, Fix)] -> [(Report, Fix)]
apart = reverse . foldl' add []
  where
    add kept f = if any (overlaps (snd f) . snd) kept then kept else f : kept
    overlaps f g = or [meet (replaced a) (replaced b) | a <- edits f, b <- edits g]
    meet (Region a b) (Region c d) = a <= d && c <= b

applied :: Source -> Fix -> AppliedFix
applied source f = AppliedFix {place = Region.position source first, summary = title f}
  where
    first = minimum (maxBound : map (start . replaced) (edits f))
