-- | Chooses among the forms of an overloaded built-in function. A form is one list of parameters
-- with the type of the result. A label is a word before an argument, such as @near@, or a rank
-- (@first@ or @last@).
--
-- A form is chosen by the number of the arguments, by their labels, and by those of their types
-- that are known. Until exactly one form fits, the call is a deferred constraint. An unknown is a
-- type or a dimension that inference has yet to find. A type is resolved when the unknowns in it
-- that have a value are replaced by this value.
module Checked.Inference.Overload
  ( solveCall,
    chooseFirst,
  )
where

import Base.Name (Name (..))
import Base.Region (Region (..))
import Checked.Builtin (ArgumentLabel (..), Form, Fresh (..), label)
import Checked.Builtin qualified as Builtin
import Checked.Call (byLikeness, pointFixes)
import Checked.Dimension qualified as Dimension
import Checked.Error (Error (..), LabelChange (..))
import Checked.ErrorFix (unwritten)
import Checked.Inference.State
import Checked.Scheme (OverloadedCall (..))
import Checked.Syntax qualified as Checked
import Checked.Type (Type (..))
import Control.Monad (unless)
import Data.Containers.ListUtils (nubOrd)
import Data.Maybe (mapMaybe)
import Surface.Keyword qualified as Keyword

-- | Solves a call if exactly one form fits, and reports it if no form fits. The result is 'False'
-- if several forms fit, so that the call remains a constraint.
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

-- | Solves a call by the first form that fits. Does nothing if no form fits.
chooseFirst :: OverloadedCall -> Infer ()
chooseFirst call = fittingForms call >>= mapM_ (chooseForm call) . take 1

-- | Solves a call by a form: unifies the types of the arguments and of the result with those of the
-- form.
chooseForm :: OverloadedCall -> Form -> Infer ()
chooseForm call form = do
  mapM_ (\((region, t), p) -> equate region p t) (zip (arguments call) (parameterTypes form))
  equate (callRegion call) (callType call) (Builtin.result form)

-- | Reports a call that fits no form; @types@ are the resolved types of its arguments. The report
-- points at the argument that 'oneMisfit' finds for the first form for which it finds one. If it
-- finds none for any form, the report points at the whole call.
reportMisfit :: OverloadedCall -> [Type] -> Infer ()
reportMisfit call types = case mapMaybe (oneMisfit call types) (formsByLabels call) of
  (region, wanted, written, found) : _ -> do
    elsewhere <- decidedElsewhere [(region, written, found)]
    mistakeOnce (map fst elsewhere) (Mismatch region wanted found elsewhere unwritten)
  [] -> case mapMaybe (\f -> (f,) <$> exchanged types (parameterTypes f)) exchangeable of
    (form, order) : _ -> reportOrder call types form order
    [] ->
      mistake
        ( NoForm
            (callRegion call)
            name
            given
            ( nubOrd
                ( map
                    (Builtin.formText (builtin call))
                    (byLikeness types (Builtin.forms plainUnknowns (builtin call)))
                )
            )
            (mapMaybe (singleMisfit given) (formsByLabels call))
            (mapMaybe (oneLabel call types) formsByCount)
            []
            ( if all (== NoLabel) (labels call)
                then pointFixes name given (Builtin.forms plainUnknowns (builtin call))
                else []
            )
        )
  where
    name = Builtin.name (builtin call)
    given = zip (map fst (arguments call)) types
    formsByCount =
      [ f
        | f <- Builtin.forms plainUnknowns (builtin call),
          length (Builtin.parameters f) == length (labels call)
      ]
    -- The operands of a difference are never exchanged: that would be another region.
    exchangeable = if builtin call == Checked.DifferenceOf then [] else formsByLabels call

-- | Reports a call with two arguments in the wrong order: the indices of these arguments, and the
-- form that the call has in the right order. @types@ are the resolved types of its arguments.
reportOrder :: OverloadedCall -> [Type] -> Form -> (Int, Int) -> Infer ()
reportOrder call types form order = do
  elsewhere <- decidedElsewhere [(r, t, t') | ((r, t), t') <- zip (arguments call) types]
  mistake
    ( Swapped
        (callRegion call)
        (Name (Builtin.name (builtin call)))
        (zip (map fst (arguments call)) types)
        (Builtin.formText (builtin call) form)
        order
        elsewhere
    )

-- | The word before one argument with which a call has a form; @types@ are the types of its
-- arguments.
oneLabel :: OverloadedCall -> [Type] -> Form -> Maybe LabelChange
oneLabel call types form =
  case [ (region, label p)
         | (own, (region, _), p) <-
             zip3 (labels call) (arguments call) (Builtin.parameters form),
           own /= label p
       ] of
    [(region, Word selector)]
      | length types == length (labels call),
        and (zipWith isCompatible types (parameterTypes form)) ->
        Just
          ( LabelChange
              (Region (start region) (start region))
              (Keyword.selectorWord selector <> " ")
          )
    _ -> Nothing

-- | The only one of some arguments that does not fit a form: its region, the wanted type and its
-- own.
singleMisfit :: [(Region, Type)] -> Form -> Maybe (Region, Type, Type)
singleMisfit given form =
  case [ (region, wanted, found)
         | ((region, found), wanted) <- zip given (parameterTypes form),
           not (isCompatible found wanted)
       ] of
    [one] -> Just one
    _ -> Nothing

-- | The only argument that does not fit a form. The result is 'Nothing' if several arguments do not
-- fit. It is also 'Nothing' unless the types of the argument and of the parameter are both
-- quantities, or both points or vectors.
--
-- The result contains the region of the argument, the type of the parameter, the type of the
-- argument before it is resolved, and its resolved type.
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

-- | The types of the parameters that take a value: all parameters of a form except ranks.
parameterTypes :: Form -> [Type]
parameterTypes form = map Builtin.type' (filter ((/= Rank) . label) (Builtin.parameters form))

-- | The forms of the called function that have the same labels as the call.
formsByLabels :: OverloadedCall -> [Form]
formsByLabels call = Builtin.labelled plainUnknowns (builtin call) (labels call)

-- | Replacements for the unknowns of forms, for reports: the dimension of plain numbers, and the
-- type 'Wrong', which fits every type.
plainUnknowns :: Fresh
plainUnknowns = Fresh {dimension = Dimension.none, anything = Wrong}

-- | The forms that fit a call, as far as its types are known. The types of the arguments select
-- forms. Then the type that the context requires of the call selects among these. If this type
-- would leave no form, it is ignored. A wrong use of the call is thus not reported as a wrong
-- argument.
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
