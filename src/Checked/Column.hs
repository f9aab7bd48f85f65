-- | The further columns of a table, which give no coordinates, as names in expressions. A column
-- consists of its name with the region of its heading, and of the type of its cells.
module Checked.Column
  ( ofCurve,
    ofRows,
    inScope,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (..))
import Checked.Inference (Infer)
import Checked.Inference qualified as Inference
import Checked.Scheme (Binding (..))
import Checked.Type (Type)
import Checked.Type qualified as Type
import Data.Text (Text)

-- | The columns that values along a curve of type @t@ may name. Empty if @t@ is not the type of a
-- curve. 'Nothing' if inference does not know the columns, or if the curve is already reported as
-- wrong.
ofCurve :: Type -> Infer (Maybe [(Located Text, Type)])
ofCurve t = do
  t' <- Inference.resolved t
  pure $ case t' of
    Type.Curve (Type.Fields cs) -> Just cs
    Type.Curve _ -> Nothing
    Type.Wrong -> Nothing
    _ -> Just []

-- | The columns that values in the rows of a table of type @t@ may name. 'Nothing' if @t@ is not
-- the type of a table.
ofRows :: Type -> Infer (Maybe [(Located Text, Type)])
ofRows t = do
  found <- Inference.resolved t
  case found of
    Type.Table (Type.Fields columns) -> pure (Just columns)
    Type.Table _ -> do
      Inference.settle
      settled <- Inference.resolved t
      pure $ case settled of
        Type.Table (Type.Fields columns) -> Just columns
        _ -> Just []
    _ -> pure Nothing

-- | Runs an inference in which the columns are local names. They hide names of the program. As
-- values they cannot be defined again in the block of a @for@.
inScope :: [(Located Text, Type)] -> Infer a -> Infer a
inScope columns inside = Inference.scoped (mapM_ bind columns *> inside)
  where
    bind (Located at text, t) = Inference.define (Name text) (Value at t)
