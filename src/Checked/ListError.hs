{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | The report of lists among the items of a list, and its fixes, which need the whole program.
module Checked.ListError
  ( listFixesAt,
    listReport,
  )
where

import Base.Region (Located (..), Region (..))
import Checked.Type (Type)
import Checked.Type qualified as Type
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Fix (Fix (..), FixEdit (..), FixText (..))
import Report.Fix qualified as Fix
import Report.Report (Label (Label), Report (fixes, hints, label, others), at, quote)
import Surface.PrintExpression (oneLine)
import Surface.Syntax
import Surface.SyntaxWalk qualified as SyntaxWalk

-- | The report of the items @lists@ of a list that are lists themselves: the type that the place of
-- the list needs of each item, an item that is no list, and the first of @lists@ as it is written.
listReport ::
  Maybe Type ->
  NonEmpty (Region, Type) ->
  Maybe (Region, Type) ->
  Maybe Text ->
  [Fix] ->
  Report
listReport needed ((first, t) :| more) single written fixes =
  (at first "E0205" (title (maybe "this" quote written)))
    { label = Type.describe t,
      others = [Label r (Type.describe t') | (r, t') <- more <> maybe [] pure single],
      fixes,
      hints =
        [ "Lists cannot be joined to one list: use them, and the other items, one after the \
          \other."
          | null fixes
        ]
    }
  where
    title name = case needed of
      Just item ->
        "each item of this list has to be " <> Type.describe item <> ", but " <> name <> " is "
          <> Type.describe t
      Nothing -> name <> " is " <> Type.describe t <> " among items that are no lists"

-- | Fixes of the list at a region, in which the items @lists@ are lists of the given types: without
-- their brackets if they are written there, or as several statements if the list has the places of
-- a statement @drill@.
listFixesAt :: [Statement] -> Region -> [(Region, Type)] -> [Fix]
listFixesAt statements whole lists = case (inner, drills) of
  (Just brackets, _) ->
    [Fix.proposed (Fix.joined "Leave out the brackets inside this list." brackets)]
  (Nothing, (statement, es) : _)
    | all (isFlat . snd) lists ->
      [divided (drillsAt (grouped es)) (region statement) whole (map asPlaces (grouped es))]
  (Nothing, _) -> []
  where
    written = [x | s <- everything, e <- SyntaxWalk.ofStatement s, x <- SyntaxWalk.everywhere e]
    everything = concatMap SyntaxWalk.statementsIn statements
    isFlat t = case t of
      Type.ListOf (Type.ListOf _) -> False
      _ -> True
    inner = traverse (bracketsOf . fst) lists
    bracketsOf r = case [es | Located r' (List es) <- written, r' == r] of
      es : _
        | Just items <- NonEmpty.nonEmpty es ->
          Just
            ( Fix.joined
                ""
                [ Fix.removal "" (Region (start r) (start (region (NonEmpty.head items)))),
                  Fix.removal "" (Region (end (region (NonEmpty.last items))) (end r))
                ]
            )
      _ -> Nothing
    drills = [(s, es) | s@(Located _ (Drill (Located r (List es)) _ _)) <- everything, r == whole]
    isList e = region e `elem` map fst lists
    grouped = NonEmpty.groupBy (\a b -> not (isList a) && not (isList b))
    drillsAt groups = Text.intercalate " and " ["drill at " <> shown es <> " …" | es <- groups]
    shown es = case NonEmpty.toList es of
      [e] -> oneLine e
      several -> "[" <> Text.intercalate ", " (map oneLine several) <> "]"
    asPlaces es
      | length es == 1 = [Copied between]
      | otherwise = [Written "[", Copied between, Written "]"]
      where
        between = Region (start (region (NonEmpty.head es))) (end (region (NonEmpty.last es)))

-- | The fix that writes a statement once for each of the places, which take the place of a list.
-- The statements as they are written are for its title.
divided :: Text -> Region -> Region -> [[FixText]] -> Fix
divided written statement list places =
  Fix.proposed
    Fix
      { Fix.title = "Write one statement for each: " <> written,
        isProposal = True,
        edits = case places of
          [] -> []
          first : more ->
            [ FixEdit list first,
              FixEdit (Region (end statement) (end statement)) (concatMap again more)
            ]
      }
  where
    again place =
      [Written "\n", Copied (Region (start statement) (start list))]
        <> place
        <> [Copied (Region (end list) (end statement))]
