-- | Calls of functions as the program writes them: their arguments, labels, and the forms that they
-- resemble. A label is a word such as @near@ before an argument.
module Checked.Call
  ( Call (..),
    argumentValues,
    unlabelled,
    labelOf,
    withLabels,
    labelChanges,
    nearestForm,
    placeholders,
    pointFixes,
    byLikeness,
    fitsCount,
  )
where

import Base.Name (Name)
import Base.Region (Located (..), Region (..))
import Checked.Builtin (ArgumentLabel, Form (..))
import Checked.Builtin qualified as Builtin
import Checked.Error (LabelChange (..))
import Checked.ErrorFix qualified as ErrorFix
import Checked.Syntax qualified as Checked
import Checked.Type (Type)
import Checked.Type qualified as Type
import Data.Containers.ListUtils (nubOrd)
import Data.List (sortOn)
import Data.Text (Text)
import Report.Fix (Fix)
import Report.Fix qualified as Fix
import Surface.Keyword qualified as Keyword
import Surface.Syntax qualified as Surface

-- | A call as the program writes it.
data Call = Call
  { callRegion :: Region,
    callee :: Located Name,
    written :: [Surface.Argument]
  }

-- | The arguments of a call. 'Nothing' if one of them has a label, such as @near@.
unlabelled :: Call -> Maybe [Surface.Expr]
unlabelled c = traverse given (written c)
  where
    given a = case a of
      Surface.Given e -> Just e
      Surface.Chosen _ _ -> Nothing
      Surface.Ranked _ -> Nothing

labelOf :: Surface.Argument -> ArgumentLabel
labelOf a = case a of
  Surface.Given _ -> Builtin.NoLabel
  Surface.Chosen word _ -> Builtin.Word (value word)
  Surface.Ranked _ -> Builtin.Rank

-- | The values of the arguments of a call. The labels @first@ and @last@ have no value.
argumentValues :: Call -> [Surface.Expr]
argumentValues c = concatMap valueOf (written c)
  where
    valueOf a = case a of
      Surface.Given e -> [e]
      Surface.Chosen _ e -> [e]
      Surface.Ranked _ -> []

-- | The arguments of a checked call: the checked values @vs@, with the labels of the written
-- arguments @as@.
withLabels :: [Surface.Argument] -> [Checked.Expr] -> [Checked.Argument]
withLabels as vs = case (as, vs) of
  (Surface.Given _ : more, v : rest) -> Checked.Given v : withLabels more rest
  (Surface.Chosen word _ : more, v : rest) -> Checked.Chosen (value word) v : withLabels more rest
  (Surface.Ranked rank : more, _) -> Checked.Ranked (value rank) : withLabels more vs
  _ -> []

-- | The changes of one label with which a call has the labels of one of the forms.
labelChanges :: Call -> [Form] -> [LabelChange]
labelChanges c forms =
  nubOrd
    [ change
      | form <- forms,
        length (Builtin.parameters form) == length (written c),
        [change] <- [changesTo (map Builtin.label (Builtin.parameters form))]
    ]
  where
    changesTo labels =
      [ changed a label
        | (a, label) <- zip (written c) labels,
          labelOf a /= label
      ]
    changed a label = LabelChange (before a) (word label)
    -- The region of the label of an argument, with the space after it.
    before a = case a of
      Surface.Given e -> Region (start (region e)) (start (region e))
      Surface.Chosen l e -> Region (start (region l)) (start (region e))
      Surface.Ranked l -> region l
    word label = case label of
      Builtin.NoLabel -> ""
      Builtin.Word selector -> Keyword.selectorWord selector <> " "
      Builtin.Rank -> "first"

-- | The parameters of the form without labels whose number of parameters is nearest to @count@.
nearestForm :: Int -> [Form] -> [(Text, Maybe Text)]
nearestForm count forms =
  concatMap
    (placeholders . snd)
    (take 1 (sortOn fst [(abs (size f - count), f) | f <- forms, isPlain f]))
  where
    size = length . Builtin.parameters
    isPlain f = all ((== Builtin.NoLabel) . Builtin.label) (Builtin.parameters f)

-- | Fixes that write brackets around two numbers, so that the arguments fit a form: their regions
-- and types, and the forms without labels.
pointFixes :: Text -> [(Region, Type)] -> [Form] -> [Fix]
pointFixes function given forms' =
  take
    1
    [ Fix.joined
        ("Write each point in brackets: " <> shown form <> ".")
        [Fix.enclosure "" "(" r ")" | r <- pairs]
      | form <- sortOn (length . Builtin.parameters) forms',
        all ((== Builtin.NoLabel) . Builtin.label) (Builtin.parameters form),
        Just pairs <- [paired given (map Builtin.type' (Builtin.parameters form))],
        not (null pairs)
    ]
  where
    paired args types = case (args, types) of
      ([], []) -> Just []
      ((_, t) : rest, wanted : more) | isAlike t wanted -> paired rest more
      ((a, t) : (b, t') : rest, Type.Spatial _ : more)
        | isNumeric t && isNumeric t' -> (Region (start a) (end b) :) <$> paired rest more
      _ -> Nothing
    isAlike t wanted = case (t, wanted) of
      (Type.Quantity _, Type.Quantity _) -> True
      (Type.Spatial _, Type.Spatial _) -> True
      (Type.Circle, Type.Circle) -> True
      (Type.Line, Type.Line) -> True
      _ -> False
    isNumeric t = case t of
      Type.Quantity _ -> True
      _ -> False
    shown form =
      Builtin.callText
        function
        [ case Builtin.type' p of
            Type.Spatial _ -> "(x, y)"
            _ -> Builtin.title p
          | p <- Builtin.parameters form
        ]

-- | Forms of a function, those first whose parameters are most like the given types.
byLikeness :: [Type] -> [Form] -> [Form]
byLikeness types forms' = sortOn distance (filter isNear forms')
  where
    -- Forms with another count of parameters are shown only if all arguments fit them.
    isNear form =
      not (any (hasCount . Builtin.parameters) forms')
        || hasCount (Builtin.parameters form)
        || misfits form == 0
    hasCount ps = length ps == length types
    misfits form =
      length (filter not (zipWith isAlike types (map Builtin.type' (Builtin.parameters form))))
    distance form =
      ( misfits form,
        abs (length types - length (Builtin.parameters form)),
        length (filter ((/= Builtin.NoLabel) . Builtin.label) (Builtin.parameters form))
      )
    isAlike t wanted = case (t, wanted) of
      (Type.Quantity _, Type.Quantity _) -> True
      (Type.Spatial _, Type.Spatial _) -> True
      _ -> t == wanted

-- | The parameters of a form, each with a value that could stand in its place.
placeholders :: Form -> [(Text, Maybe Text)]
placeholders form =
  [(Builtin.title p, ErrorFix.placeholder (Builtin.type' p)) | p <- Builtin.parameters form]

-- | Tells if a word may be a function with this count of arguments.
fitsCount :: Text -> Int -> Bool
fitsCount word count = case Builtin.lookup word of
  Just builtin -> count `elem` map (length . Builtin.parameters) (Builtin.formsForReports builtin)
  Nothing -> word `notElem` Keyword.reservedWords
