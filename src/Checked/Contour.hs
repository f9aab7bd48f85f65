-- | Checks the items of a contour: elements with modifiers and links, repetitions, and choices. A
-- modifier is a property of one element, such as a feed or an allowance.
--
-- The functions yield 'Deferred' terms, which are complete only when type inference has found all
-- dimensions of the program. Such a term takes these dimensions, the solution of inference, as an
-- argument, here @sol@.
module Checked.Contour
  ( item,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (..))
import Checked.Column qualified as Column
import Checked.Deferred (Deferred, mapStrict, resolveAll)
import Checked.Expression
  ( TypingEnvironment,
    contourElement,
    expect,
    repetition,
  )
import Checked.Feed (cutFeed)
import Checked.Inference (Infer)
import Checked.Inference qualified as Inference
import Checked.Scheme (Binding (..))
import Checked.Syntax qualified as Checked
import Checked.Type (Type)
import Checked.Type qualified as Type
import Data.Maybe (isNothing)
import Data.Text (Text)
import Surface.Syntax qualified as Surface

-- | Checks one item in the braces of a contour.
item :: TypingEnvironment -> Surface.Item -> Infer (Deferred Checked.Item)
item env (Located at i) = case i of
  Surface.BrokenItem name -> do
    mapM_ (\n -> Inference.define (value n) (Poisoned (region n))) name
    Inference.taint
    pure (const (Located at (Checked.For (Name "") (Located at (Checked.List [])) [])))
  Surface.For counter list items -> do
    (t, columns, list') <- repetition env counter list
    items' <- Column.inScope columns (Inference.withLocals [(counter, t)] (mapM (item env) items))
    pure (\sol -> Located at (Checked.For (value counter) (list' sol) (resolveAll sol items')))
  Surface.Choose e items others -> do
    e' <- expect env Type.Boolean e
    items' <- mapM (item env) items
    others' <- mapM (item env) others
    pure
      ( \sol ->
          Located at (Checked.Choose (e' sol) (resolveAll sol items') (resolveAll sol others'))
      )
  Surface.Element sense e modifiers link -> do
    (t, e') <- contourElement env sense e
    modifiers' <- elementModifiers env t modifiers
    link' <- traverse (linkTo env) link
    let element sol =
          Checked.Element
            (mapStrict value sense)
            (e' sol)
            (resolveAll sol modifiers')
            (mapStrict ($ sol) link')
    pure (Located at . element)

-- | Checks the modifiers of an element of type @t@. A bevel may name the columns of the table
-- through which the element's curve passes. Bevels are left out if inference does not know these
-- columns, for example because the element is already reported as wrong.
elementModifiers ::
  TypingEnvironment -> Type -> [Surface.Modifier] -> Infer [Deferred Checked.Modifier]
elementModifiers env t modifiers
  | null modifiers = pure []
  | otherwise = do
    columns <- Column.ofCurve t
    mapM
      (modifier env (concat columns))
      (if isNothing columns then filter (not . isBevel) modifiers else modifiers)

isBevel :: Surface.Modifier -> Bool
isBevel (Located _ m) = case m of
  Surface.Bevel _ -> True
  Surface.ElementFeed _ -> False
  Surface.Slow -> False
  Surface.ElementAllowance _ -> False

-- | Checks a modifier of an element. @columns@ are the columns that a bevel may name, with the
-- types of their values.
modifier ::
  TypingEnvironment ->
  [(Located Text, Type)] ->
  Surface.Modifier ->
  Infer (Deferred Checked.Modifier)
modifier env columns (Located at m) = fmap (Located at .) $ case m of
  Surface.ElementFeed e -> (Checked.ElementFeed .) <$> cutFeed env e
  Surface.Slow -> pure (const Checked.Slow)
  Surface.ElementAllowance e -> (Checked.ElementAllowance .) <$> expect env Type.len e
  Surface.Bevel e ->
    (Checked.Bevel .) <$> Column.inScope columns (expect env Type.angle e)

-- | Checks the link from an element to the next one.
linkTo :: TypingEnvironment -> Surface.Link -> Infer (Deferred Checked.Link)
linkTo env (Located at l) = fmap (Located at .) $ case l of
  Surface.Meet near -> do
    near' <- traverse (expect env Type.aPoint) near
    pure (\sol -> Checked.Meet (($ sol) <$> near'))
  Surface.Smooth -> pure (const Checked.Smooth)
  Surface.Tangent -> pure (const Checked.Tangent)
  Surface.Fillet e -> (Checked.Fillet .) <$> expect env Type.len e
  Surface.Chamfer e -> (Checked.Chamfer .) <$> expect env Type.len e
