-- | Lists with items that are lists themselves beside items that are not. Such a list is reported
-- at the items that do not fit.
module Checked.Inference.List
  ( areFlat,
  )
where

import Base.Region (Region)
import Checked.Error (Error (..))
import Checked.Inference (Infer)
import Checked.Inference qualified as Inference
import Checked.Type (Type)
import Checked.Type qualified as Type
import Control.Applicative ((<|>))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)

-- | Reports the items of a list that are lists of what each item has to be. @needed@ is the type
-- that the place of the list needs of each item; if it needs none, the items that are not lists
-- decide. The result is true if nothing was reported.
areFlat :: Region -> Maybe Type -> [(Region, Type)] -> Infer Bool
areFlat at needed items = do
  found <- mapM (traverse Inference.resolved) items
  let single = listToMaybe [item | item <- found, isSingle (snd item)]
      wanted = needed <|> (snd <$> single)
      lists = [(r, t) | (r, t@(Type.ListOf _)) <- found, maybe False (isListOf t) wanted]
  case NonEmpty.nonEmpty lists of
    Nothing -> pure True
    Just some -> do
      Inference.mistake (ListAmongItems at needed some single Nothing [])
      pure False
  where
    isListOf t item = case t of
      Type.ListOf inner ->
        isListOf inner item || (isSingle inner && Inference.isCompatible inner item)
      _ -> False

-- | True of a type that is known and no list.
isSingle :: Type -> Bool
isSingle t = case t of
  Type.ListOf _ -> False
  Type.Variable _ -> False
  Type.Wrong -> False
  _ -> True
