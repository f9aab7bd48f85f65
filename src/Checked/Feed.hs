-- | Checks the feed of a cut. It is a feed per minute, or a length for each turn of the spindle:
-- @0.2 mm\/rev@. The word @rev@ is a unit only behind the stroke of a feed, and a name of the
-- program hides it.
module Checked.Feed
  ( cutFeed,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (..))
import Checked.Deferred (Deferred)
import Checked.Expression (TypingEnvironment, expect)
import Checked.Inference (Infer)
import Checked.Inference qualified as Inference
import Checked.Syntax qualified as Checked
import Checked.Type qualified as Type
import Surface.Syntax qualified as Surface

-- | Checks the feed that an expression gives.
cutFeed :: TypingEnvironment -> Surface.Expr -> Infer (Deferred Checked.CutFeedExpr)
cutFeed env e = case value e of
  Surface.Binary Surface.Divide advance (Located _ (Surface.Variable name@(Name "rev"))) -> do
    known <- Inference.find name
    case known of
      Nothing -> (Checked.ForTurn (region e) .) <$> expect env Type.len advance
      Just _ -> perMinute
  _ -> perMinute
  where
    perMinute = (Checked.ForMinute .) <$> expect env Type.feed e
