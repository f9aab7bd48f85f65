-- | Checks texts that are cut: their points, heights, directions and circles.
module Checked.Lettering
  ( check,
    checkPlace,
  )
where

import Base.Region (value)
import Checked.Deferred (Deferred)
import Checked.Expression (TypingEnvironment, expect)
import Checked.Inference (Infer)
import Checked.Syntax qualified as Checked
import Checked.Type qualified as Type
import Data.Maybe (fromMaybe)
import Surface.Syntax qualified as Surface

-- | Checks a text. A text without alignment begins at its point.
check :: TypingEnvironment -> Surface.Lettering -> Infer (Deferred Checked.Engraving)
check env text = do
  point <- expect env Type.aPoint (Surface.textPoint text)
  height <- expect env Type.len (Surface.textHeight text)
  line <- case Surface.course text of
    Surface.Level -> pure (const Checked.AlongX)
    Surface.Inclined e -> fmap Checked.InDirection <$> expect env Type.angle e
    Surface.Around e side ->
      (\e' sol -> Checked.OnCircle (e' sol) (fmap value side == Just Surface.Inside))
        <$> expect env Type.Circle e
  pure $ \sol ->
    Checked.Engraving
      { Checked.engraved = Surface.lettered text,
        Checked.anchor = point sol,
        Checked.capitalHeight = height sol,
        Checked.textLine = line sol,
        Checked.textAlignment = fromMaybe Surface.AlignLeft (Surface.alignment text)
      }

-- | Checks the place of a text in a font. A text round a circle has been refused where its font was
-- read.
checkPlace :: TypingEnvironment -> Surface.Lettering -> Infer (Deferred Checked.TextPlace)
checkPlace env text = do
  point <- expect env Type.aPoint (Surface.textPoint text)
  height <- expect env Type.len (Surface.textHeight text)
  direction <- case Surface.course text of
    Surface.Level -> pure (const Nothing)
    Surface.Inclined e -> fmap Just <$> expect env Type.angle e
    Surface.Around _ _ -> pure (const Nothing)
  pure (\sol -> Checked.TextPlace (point sol) (height sol) (direction sol))
