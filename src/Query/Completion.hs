-- | The words and values that may come at the cursor, for completion in an editor.
module Query.Completion
  ( Completion (..),
    CompletionItem (..),
    CompletionKind (..),
    completion,
  )
where

import Base.Region (Region (..))
import Base.Region qualified as Region
import Checked.Builtin (Form (..))
import Checked.Builtin qualified as Builtin
import Checked.Dimension (Dimension)
import Checked.Dimension qualified as Dimension
import Checked.Syntax (Builtin)
import Checked.Type (Type (..))
import Checked.Type qualified as Type
import Data.Containers.ListUtils (nubOrdOn)
import Data.List (sortOn)
import Data.Maybe (mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Project.Target qualified as Target
import Query.Candidate qualified as Candidate
import Query.Cursor (Cursor (..))
import Query.Cursor qualified as Cursor
import Query.Manual (ManualEntry)
import Query.Manual qualified as Manual
import Query.Mention (MentionType (..))
import Query.Scope (ScopedName (..))
import Query.Scope qualified as Scope
import Query.Slot (Slot (..))
import Query.Slot qualified as Slot
import Query.SlotWord (GrammarWord (..))
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Query.Snippet qualified as Snippet
import Surface.Keyword qualified as Keyword
import Surface.Token qualified as Token

-- | The items for one cursor, the best first, and the region of the word that they replace.
data Completion = Completion {replaced :: Region, items :: [CompletionItem]}
  deriving stock (Eq, Show)

-- | A word or a value that may come at the cursor.
data CompletionItem = CompletionItem
  { label :: Text,
    kind :: CompletionKind,
    -- | the type, the value or the form of a call, in a few words
    detail :: Text,
    -- | further forms of a call
    forms' :: [Text],
    about :: Maybe ManualEntry,
    -- | the text to insert, with the marks of snippets
    snippet :: Text,
    -- | 0 for an item that fits; higher for one that fits only as a part of an expression
    rank :: Int
  }
  deriving stock (Eq, Show)

-- | The kind of an item, which an editor shows by a picture.
data CompletionKind
  = StatementItem
  | SettingItem
  | WordItem
  | ValueItem
  | ContourItem
  | FunctionItem
  | ConstantItem
  | ColumnItem
  | UnitItem
  | MachineItem
  | PointItem
  deriving stock (Eq, Show, Enum, Bounded)

-- | The items for the offset @at@ of the present text. @now@ is the snapshot of the present text,
-- and @before@ the last snapshot without errors. 'Nothing' in a comment or a text.
completion :: Snapshot -> Maybe Snapshot -> Int -> Maybe Completion
completion now before at = found <$> Cursor.at (Region.text (Snapshot.source now)) at
  where
    found cursor =
      let names = Scope.scope now before cursor
          slots = Slot.slots (Scope.typings names) cursor
       in Completion
            { replaced = Cursor.typed cursor,
              items =
                map inFileUnit $
                  sortOn rank (nubOrdOn label (concatMap (ofSlot now cursor names) slots))
            }
    inFileUnit i = i {snippet = Snippet.inUnit (Snapshot.unit now) (snippet i)}

-- | The items for one kind of text.
ofSlot :: Snapshot -> Cursor -> [ScopedName] -> Slot -> [CompletionItem]
ofSlot now cursor names slot = case slot of
  AtStatement given -> statements given
  AtSetting keyword given -> settings keyword given
  AtWord words' -> map wordItem words'
  AtValue types isFactor -> values names types isFactor
  AtColumn columns -> [item ColumnItem c (Type.describe t) 0 | (c, t) <- columns]
  AtChoice ->
    [ (item PointItem text note n) {rank = 0}
      | (n, (text, note)) <- zip [0 ..] (Candidate.candidates now cursor)
    ]
  AtUnit -> units
  AtMachine -> [item MachineItem name "a machine" 0 | name <- Target.builtInNames]
  AtCutter -> [(wordItem (GrammarWord k text)) {detail = "a cutter"} | (k, text) <- Snippet.cutters]

-- | An item that inserts its label.
item :: CompletionKind -> Text -> Text -> Int -> CompletionItem
item kind label detail rank =
  CompletionItem {label, kind, detail, forms' = [], about = Nothing, snippet = label, rank}

wordItem :: GrammarWord -> CompletionItem
wordItem (GrammarWord w text) = (item WordItem w "" 0) {about = Manual.word w, snippet = text}

-- | The statements. Those that a program has only once are left out if they are among @given@, the
-- keywords so far. A program begins with @part@.
statements :: [Text] -> [CompletionItem]
statements given =
  [ (item StatementItem k "a statement" (if isNext k then 0 else 1))
      { about = Manual.word k,
        snippet = text
      }
    | (k, text) <- Snippet.statements,
      k `notElem` Snippet.onceOnly || k `notElem` given,
      k /= "units" || all (== "part") given
  ]
  where
    isNext k = not (null given) || k == "part"

-- | The settings that a statement may have and that are not among @given@.
settings :: Text -> [Text] -> [CompletionItem]
settings keyword given =
  [ (item SettingItem s ("a setting of " <> keyword) 0)
      { about = Manual.word s,
        snippet = Snippet.setting s
      }
    | s <- Keyword.settingsOf keyword,
      Text.takeWhile (/= ' ') s `notElem` filter (/= "lead") given
  ]

units :: [CompletionItem]
units =
  [ (item UnitItem name (Type.describe (fst (Type.ofUnit u))) 0) {about = Manual.word name}
    | u <- [minBound .. maxBound],
      let name = Token.unitName u
  ]

-- Values

-- | The names, functions and constants whose values fit one of the types. Without types, every
-- value fits.
values :: [ScopedName] -> [Type] -> Bool -> [CompletionItem]
values names types isFactor =
  mapMaybe (named types isFactor) names
    <> mapMaybe (builtin types isFactor) (filter isVisible [minBound .. maxBound])
    <> pair
  where
    isVisible b = Builtin.name b `notElem` map name names
    pair =
      [ (item PointItem "(x, y)" (Type.describe t) 1) {snippet = "(${1:x}, ${2:y})"}
        | t <- take 1 (filter isPlane types)
      ]
    isPlane t = case t of
      Spatial _ -> True
      _ -> False

-- | The item of a name of the program, if its value fits.
named :: [Type] -> Bool -> ScopedName -> Maybe CompletionItem
named types isFactor n = case typing n of
  OfValue t -> valued <$> rankOf types isFactor t
  OfFunction parameters t -> called parameters <$> rankOf types isFactor t
  Untyped -> Just (item ValueItem (name n) (meaning n) 1)
  where
    valued rank =
      (item (if isContour n then ContourItem else ValueItem) (name n) detail rank)
        { forms' = []
        }
      where
        detail = meaning n <> maybe "" (", " <>) (value n)
    called parameters rank =
      (item FunctionItem (name n) (Builtin.callText (name n) (map fst parameters)) rank)
        { forms' = [meaning n],
          snippet = name n <> "($0)"
        }

-- | The item of a built-in function or constant, if the result of one of its forms fits.
builtin :: [Type] -> Bool -> Builtin -> Maybe CompletionItem
builtin types isFactor b = case mapMaybe (rankOf types isFactor . result) allForms of
  [] -> Nothing
  ranks ->
    Just
      ( item
          (if Builtin.isConstant b then ConstantItem else FunctionItem)
          label
          (Text.concat (take 1 texts))
          (1 + minimum ranks)
      )
        { about = Manual.function label,
          forms' = texts,
          snippet = if Builtin.isConstant b then label else label <> "($0)"
        }
  where
    label = Builtin.name b
    texts = Builtin.formTexts b
    allForms =
      Builtin.forms
        Builtin.Fresh {Builtin.dimension = unknown, Builtin.anything = Variable 0}
        b

unknown :: Dimension
unknown = Dimension.atom (Dimension.Unknown 0)

-- | The rank of a value of a type where one of @types@ is wanted: 0 if it fits, 3 if it may be a
-- part of an expression that fits. 'Nothing' if it cannot occur there.
rankOf :: [Type] -> Bool -> Type -> Maybe Int
rankOf types isFactor t
  | null types = Just 0
  | otherwise = case mapMaybe (\w -> rankFor w isFactor t) types of
    [] -> Nothing
    ranks -> Just (minimum ranks)

rankFor :: Type -> Bool -> Type -> Maybe Int
rankFor wanted isFactor t = case (wanted, t) of
  (Variable _, _) -> Just 0
  (_, Variable _) -> Just 0
  (_, Wrong) -> Just 0
  (Quantity d, Quantity e)
    | isFactor -> Just (if e == Dimension.none then 0 else 3)
    | d == e || not (Dimension.isKnown e) || not (Dimension.isKnown d) -> Just 0
    | e == Dimension.none -> Just 3
    | otherwise -> Nothing
  (Spatial d, Spatial e) -> Just (if d == e || not (Dimension.isKnown e) then 0 else 3)
  (ListOf a, ListOf b) -> rankFor a isFactor b
  (Curve _, Curve _) -> Just 0
  (Table _, Table _) -> Just 0
  _ | wanted == t -> Just 0
  _ -> Nothing
