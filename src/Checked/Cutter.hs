-- | Checks cutters: their sizes have to be lengths and angles.
module Checked.Cutter
  ( cutter,
  )
where

import Base.Region (Located (..))
import Checked.Deferred (Deferred)
import Checked.Expression (TypingEnvironment, expect)
import Checked.Inference (Infer)
import Checked.Syntax qualified as Checked
import Checked.Type qualified as Type
import Surface.Syntax qualified as Surface

-- | Checks a cutter with the sizes of its body.
cutter :: TypingEnvironment -> Surface.Cutter -> Infer (Deferred Checked.Cutter)
cutter env (Located at c) = fmap (Located at .) $ case c of
  Surface.MillCutter e sizes -> sized Checked.MillCutter e sizes
  Surface.DrillCutter e sizes -> sized Checked.DrillCutter e sizes
  Surface.TapCutter e sizes -> sized Checked.TapCutter e sizes
  Surface.ThreadMillCutter e pitch sizes ->
    (\pitch' made sol -> made sol (pitch' sol))
      <$> len pitch <*> sized (\e' sizes' p -> Checked.ThreadMillCutter e' p sizes') e sizes
  Surface.TurningCutter e tip ->
    (\e' tip' sol -> Checked.TurningCutter (e' sol) (($ sol) <$> tip'))
      <$> len e <*> traverse (expect env Type.number) tip
  Surface.ConeCutter d a h ->
    (\d' a' h' sol -> Checked.ConeCutter (d' sol) (a' sol) (h' sol))
      <$> len d <*> expect env Type.angle a <*> len h
  Surface.VBitCutter a t d ->
    (\a' t' d' sol -> Checked.VBitCutter (a' sol) (t' sol) (d' sol))
      <$> expect env Type.angle a <*> len t <*> len d
  Surface.BladeCutter d g ->
    (\d' g' sol -> Checked.BladeCutter (d' sol) (g' sol)) <$> len d <*> len g
  where
    len = expect env Type.len
    sized make e sizes =
      (\e' sizes' sol -> make (e' sol) (map ($ sol) sizes'))
        <$> len e <*> traverse (bodySize env) sizes

bodySize :: TypingEnvironment -> Surface.BodySize -> Infer (Deferred Checked.BodySize)
bodySize env (Located at s) = fmap (Located at .) $ case s of
  Surface.Flutes e -> (Checked.Flutes .) <$> len e
  Surface.StickOut e -> (Checked.StickOut .) <$> len e
  Surface.PointAngle e -> (Checked.PointAngle .) <$> expect env Type.angle e
  Surface.HolderCylinder d h ->
    (\d' h' sol -> Checked.HolderCylinder (d' sol) (($ sol) <$> h')) <$> len d <*> traverse len h
  where
    len = expect env Type.len
