-- | The choice among the forms of an overloaded built-in function.
--
-- A form is chosen by the number of the arguments, by their labels, and by those of their types
-- that are known. A call is a deferred constraint until exactly one form fits.
module Checked.Inference.Overload
  ( solveCall,
    chooseFirst,
  )
where

import Base.Region (Region)
import Checked.Builtin (ArgumentLabel (..), Form, Fresh (..), label)
import Checked.Builtin qualified as Builtin
import Checked.Dimension qualified as Dimension
import Checked.Error (Error (..))
import Checked.Inference.State
import Checked.Scheme (OverloadedCall (..))
import Checked.Type (Type (..))
import Control.Monad (unless)
import Data.Containers.ListUtils (nubOrd)
import Data.Maybe (mapMaybe)

-- | Solves a call by the only form that fits, or reports that none fits. Gives 'False' if several
-- forms fit.
solveCall :: OverloadedCall -> Infer Bool
solveCall call = do
  candidates <- fittingForms call
  types <- traverse (resolved . snd) (arguments call)
  case candidates of
    [] -> do
      unless (Wrong `elem` types) (reportMisfit call types)
      taint
      True <$ equate (callRegion call) (callType call) Wrong
    [only] -> True <$ chooseForm call only
    _ -> pure False

-- | Solves a call by the first form that fits, if there is one.
chooseFirst :: OverloadedCall -> Infer ()
chooseFirst call = fittingForms call >>= mapM_ (chooseForm call) . take 1

-- | Unifies the types of the arguments and of the result of a call with those of a form.
chooseForm :: OverloadedCall -> Form -> Infer ()
chooseForm call form = do
  mapM_ (\((region, t), p) -> equate region p t) (zip (arguments call) (parameterTypes form))
  equate (callRegion call) (callType call) (Builtin.result form)

-- | Reports a call that fits no form. The report points at one argument if a form differs in that
-- argument only, and both its types are quantities or both are spatial. Otherwise it points at the
-- whole call.
reportMisfit :: OverloadedCall -> [Type] -> Infer ()
reportMisfit call types = case mapMaybe (oneMisfit call types) (formsByLabels call) of
  (region, wanted, written, found) : _ -> do
    elsewhere <- decidedElsewhere [(region, written, found)]
    mistakeOnce (map fst elsewhere) (Mismatch region wanted found elsewhere)
  [] ->
    mistake
      ( NoForm
          (callRegion call)
          (Builtin.name (builtin call))
          (zip (map fst (arguments call)) types)
          (nubOrd (map (Builtin.formText (builtin call)) (formsByLabels call <> formsByCount)))
      )
  where
    formsByCount =
      [ f
        | f <- Builtin.forms plainUnknowns (builtin call),
          length (Builtin.parameters f) == length (labels call)
      ]

-- | Finds the only argument that does not fit a form. Its type and the wanted type must both be
-- quantities or both be spatial. Gives its region, the wanted type, its unresolved and its resolved
-- type.
oneMisfit :: OverloadedCall -> [Type] -> Form -> Maybe (Region, Type, Type, Type)
oneMisfit call types form =
  case [ (region, wanted, written, found)
         | ((region, written), found, wanted) <-
             zip3 (arguments call) types (parameterTypes form),
           not (isCompatible found wanted)
       ] of
    [misfit@(_, wanted, _, found)] | isSameKind found wanted -> Just misfit
    _ -> Nothing
  where
    isSameKind a b = case (a, b) of
      (Quantity _, Quantity _) -> True
      (Spatial _, Spatial _) -> True
      _ -> False

-- | The types of those parameters of a form that take values: all but the ranks.
parameterTypes :: Form -> [Type]
parameterTypes form = map Builtin.type' (filter ((/= Rank) . label) (Builtin.parameters form))

-- | The forms with the labels of a call.
formsByLabels :: OverloadedCall -> [Form]
formsByLabels call = Builtin.labelled plainUnknowns (builtin call) (labels call)

-- | Known types in the positions of unknowns, for forms that are only shown or compared.
plainUnknowns :: Fresh
plainUnknowns = Fresh {dimension = Dimension.none, anything = Wrong}

-- | The forms that fit the types of a call that are known. First the arguments select forms, then
-- the use of the result. A use that fits no form is ignored here, so that no report blames the
-- arguments for it.
fittingForms :: OverloadedCall -> Infer [Form]
fittingForms call = do
  types <- traverse (resolved . snd) (arguments call)
  fresh <- Fresh <$> freshDimension <*> freshType
  use <- resolved (callType call)
  let byLabels = Builtin.labelled fresh (builtin call) (labels call)
      byArguments = [f | f <- byLabels, and (zipWith isCompatible types (parameterTypes f))]
  pure $ case filter (isCompatible use . Builtin.result) byArguments of
    [] -> byArguments
    byUse -> byUse
