-- | The kinds of text that may come at the cursor: a statement, a word of the grammar, a value of
-- some type, and others.
module Query.Slot
  ( Slot (..),
    Typings (..),
    slots,
  )
where

import Checked.Builtin (ArgumentLabel (NoLabel, Rank), Form)
import Checked.Builtin qualified as Builtin
import Checked.Dimension qualified as Dimension
import Checked.Syntax (Builtin, Selector (..))
import Checked.Type (Type (..))
import Checked.Type qualified as Type
import Data.List (nub)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isJust, listToMaybe, mapMaybe)
import Data.Text (Text)
import Query.Cursor (Cursor (..), Level (..), Opening (..), isWord, segments, wantsOperand, wordsOf)
import Query.SlotWord (GrammarWord (GrammarWord), Slot (..))
import Query.SlotWord qualified as SlotWord
import Surface.HoleForm qualified as HoleForm
import Surface.Keyword qualified as Keyword
import Surface.Token (Token (..), Token_ (Number, Symbol))

-- | The types of the names that are visible at the cursor.
data Typings = Typings
  { -- | the types of the parameters of a function of the program
    parametersOf :: Text -> [Type],
    -- | the columns of the table through which a curve passes, by the name of the curve or table
    columnsOf :: Text -> [(Text, Type)]
  }

-- | The kinds of text that may come at the cursor. The list is empty where only a new name can
-- come.
slots :: Typings -> Cursor -> [Slot]
slots typings cursor = nub (withColumns (inLevel typings cursor (levels cursor)) <> unit)
  where
    unit = [AtUnit | isAfterNumber cursor]
    withColumns found = [AtColumn columns | not (null columns), any isValue found] <> found
    columns = nub (concatMap (columnsOf typings) (tablesAround cursor))
    isValue slot = case slot of
      AtValue _ _ -> True
      _ -> False

-- | The names after the word @in@ of the repetitions around the cursor, and after the word @at@ of
-- a work on holes before its sizes. If such a name is that of a table, the names of its
-- columns are values at the cursor.
tablesAround :: Cursor -> [Text]
tablesAround cursor = drilled <> concatMap repeatedIn (NonEmpty.tail (levels cursor))
  where
    repeatedIn l = case reverse (heads l) of
      first : rest | isWord first ["for"] -> wordsOf (drop 1 (dropWhile (not . isIn) rest))
      _ -> []
    isIn t = isWord t ["in"]
    drilled = case mapMaybe workOnHoles (NonEmpty.toList (levels cursor)) of
      (sizes, rest) : _
        | any (`isWord` sizes) (take 1 (reverse (filter isSize rest))) ->
          wordsOf (takeWhile (not . isSize) rest)
      _ -> []
    -- The sizes that may name columns, and the tokens after the keyword.
    workOnHoles l = case reverse (heads l) of
      first : rest
        | isWord first ["drill"] -> Just (["depth"], rest)
        | work : _ <- mapMaybe HoleForm.named (wordsOf [first]) ->
          Just (map HoleForm.sizeWord (filter (HoleForm.isByRow work) [minBound ..]), rest)
      _ -> Nothing
    isSize t = isWord t (map HoleForm.sizeWord [minBound ..])

inLevel :: Typings -> Cursor -> NonEmpty Level -> [Slot]
inLevel typings cursor (top :| outer) = case opening top of
  File -> inStatements cursor top
  Statements -> inStatements cursor top
  Items -> inItems typings cursor top
  SettingsOf k -> inSettings cursor k top
  TableLines -> [AtUnit | not (null (heads top)), all (null . numbersOf) (heads top)]
  CallOf f -> inCall typings f (reverse (heads top))
  CutterOf kind -> inCutter kind (reverse (heads top))
  CipherOf digit -> inCipher (columns outer) digit (reverse (heads top))
  Parameters -> []
  Parenthesis -> concatMap (inside (reverse (heads top))) around
  ListBracket -> inList around (reverse (heads top))
  where
    around = case NonEmpty.nonEmpty outer of
      Just levels' -> [s | s@(AtValue _ _) <- inLevel typings cursor levels']
      Nothing -> []
    columns ls = nub (concat [columnsOf typings w | l <- take 1 ls, w <- wordsOf (heads l)])
    numbersOf t = case shape t of
      Number n _ -> [n]
      _ -> []

-- Statements, settings and items

inStatements :: Cursor -> Level -> [Slot]
inStatements cursor top = case reverse (heads top) of
  _ | isLineStart cursor, not (isOpen top) -> [AtStatement (given top)]
  [] -> [AtStatement (given top)]
  first : rest -> case wordsOf [first] of
    [k] -> afterMarker (SlotWord.statement k) k rest
    _ -> []

-- | True if an operand has to come next at this level.
isOpen :: Level -> Bool
isOpen = any wantsOperand . take 1 . heads

inSettings :: Cursor -> Text -> Level -> [Slot]
inSettings cursor keyword top = case reverse (heads top) of
  _ | isLineStart cursor, not (isOpen top) -> setting
  [] -> setting
  first : rest -> case wordsOf [first] of
    [k]
      | k `elem` ["climb", "conventional", "shortest"] -> setting
      | otherwise -> afterMarker (fmap (fmap (<> setting)) . SlotWord.setting) k rest
    _ -> []
  where
    setting = [AtSetting keyword (given top)]

inItems :: Typings -> Cursor -> Level -> [Slot]
inItems typings cursor top = case reverse (heads top) of
  [] -> SlotWord.element
  _ | isLineStart cursor, not (isOpen top) -> SlotWord.element <> SlotWord.afterElement
  first : rest -> withColumns $ case wordsOf [first] of
    [k] | Just _ <- SlotWord.item k -> afterMarker SlotWord.item k rest
    _ -> afterMarker SlotWord.item "" (first : rest)
  where
    withColumns found
      | any (`isWord` ["bevel"]) (take 1 (heads top)) =
        AtColumn (concatMap (columnsOf typings) (wordsOf (heads top))) : found
      | otherwise = found

-- | The slots after the last marker of a construct. A marker is a word or a sign that says what
-- comes after it. @known@ gives the slots directly after a marker, and those after its operand.
-- @first@ is the first marker, and @rest@ are the tokens after it.
afterMarker :: (Text -> Maybe ([Slot], [Slot])) -> Text -> [Token] -> [Slot]
afterMarker known first rest = case known marker of
  Just (follows, after) -> operand follows after segment
  Nothing -> []
  where
    (marker, segment) = go (first, rest) rest
    go found ts = case ts of
      [] -> found
      t : more -> go (maybe found (,more) (markerOf t)) more
    markerOf t =
      listToMaybe [w | w <- wordsOf [t] <> ["=" | shape t == Symbol "="], isJust (known w)]

-- | The slots in an expression of which the tokens @written@ precede the cursor: @follows@ if an
-- operand has to come, @after@ if the expression may end.
operand :: [Slot] -> [Slot] -> [Token] -> [Slot]
operand follows after written = case conditional [] written of
  Condition -> [AtValue [Boolean] False]
  Branch ts -> case reverse ts of
    [] -> follows
    t : _
      | isWord t ["and", "or", "not"] -> [AtValue [Boolean] False]
      | shape t `elem` map Symbol ["*", "/"] -> map factor follows
      | shape t `elem` map Symbol ["=", "!=", "<", "<=", ">", ">="] -> [AtValue [] False]
      | wantsOperand t -> follows
      | otherwise -> after
  where
    factor s = case s of
      AtValue types _ -> AtValue types True
      _ -> s

-- | The part of an expression that contains its end: a condition after @if@, or another expression.
data Branch = Condition | Branch [Token]

conditional :: [Token] -> [Token] -> Branch
conditional found ts = case ts of
  [] -> Branch (reverse found)
  t : rest
    | isWord t ["if"] -> if any (`isWord` ["then"]) rest then conditional [] rest else Condition
    | isWord t ["then", "else"] -> conditional [] rest
    | otherwise -> conditional (t : found) rest

-- Brackets

-- | The slots in parentheses that are no call, in an expression with the slot @around@. The
-- parentheses may be those of a pair.
inside :: [Token] -> Slot -> [Slot]
inside written around = case around of
  AtValue types isFactor
    | null types -> operand [AtValue [] isFactor] [] current
    | any isPair types ->
      operand [AtValue ([Type.len] <> [t | isFirst, t <- types]) isFactor] [] current
    | isFirst -> operand [around] [] current
    | otherwise -> []
  _ -> []
  where
    parts = segments written
    current = last parts
    isFirst = null (drop 1 parts)
    isPair t = case t of
      Spatial _ -> True
      SpacePoint -> True
      _ -> False

-- | The slots in the brackets of a list.
inList :: [Slot] -> [Token] -> [Slot]
inList around written = case break (`isWord` ["for"]) current of
  (_, _ : rest) -> case break (`isWord` ["in"]) rest of
    (_, _ : list) -> operand [AtValue [ListOf (Variable 0), Table (Variable 0)] False] [] list
    ([_], []) -> [AtWord [GrammarWord "in" "in "]]
    _ -> []
  (segment, []) -> operand [AtValue items False] [AtWord [GrammarWord "for" "for "]] segment
  where
    current = last (segments written)
    items = concat [[t | ListOf t <- types] | AtValue types _ <- around]

-- | The slots in the arguments of a call.
inCall :: Typings -> Text -> [Token] -> [Slot]
inCall typings function written = case Builtin.lookup function of
  Just builtin | null (parametersOf typings function) -> inBuiltin builtin parts
  _ -> operand [AtValue own False] [] (last parts)
  where
    parts = segments written
    own = take 1 (drop (length parts - 1) (parametersOf typings function))

inBuiltin :: Builtin -> [[Token]] -> [Slot]
inBuiltin builtin parts = case current of
  t : rest
    | Just selector <- selectorOf t ->
      let chosen = AtValue (ofLabel (Builtin.Word selector)) False
       in operand ([AtChoice | selector == Near] <> [chosen]) [] rest
  _ -> operand ([AtValue (ofLabel NoLabel) False | ofLabel NoLabel /= []] <> choices) [] current
  where
    current = last parts
    index = length parts - 1
    fitting =
      [ p
        | form <- allForms builtin,
          let parameters = Builtin.parameters form,
          map labelOf (init parts) == take index (map Builtin.label parameters),
          p <- take 1 (drop index parameters)
      ]
    ofLabel l = nub [Builtin.type' p | p <- fitting, Builtin.label p == l]
    choices =
      [ AtWord
          ( [ GrammarWord (Keyword.selectorWord s) (Keyword.selectorWord s <> " ")
              | Builtin.Word s <- nub (map Builtin.label fitting)
            ]
              <> [GrammarWord w w | Rank `elem` map Builtin.label fitting, w <- ["first", "last"]]
          )
        | any ((/= NoLabel) . Builtin.label) fitting
      ]

-- | The label of a written argument.
labelOf :: [Token] -> ArgumentLabel
labelOf part = case part of
  t : _
    | Just selector <- selectorOf t -> Builtin.Word selector
    | isWord t ["first", "last"] -> Rank
  _ -> NoLabel

selectorOf :: Token -> Maybe Selector
selectorOf t =
  listToMaybe
    [ s
      | s <- [Near, ToLeft, ToRight, ToInside, ToOutside, WithinTolerance],
        isWord t [Keyword.selectorWord s]
    ]

-- | All forms of a function, with the unknown 0 for every unknown.
allForms :: Builtin -> [Form]
allForms =
  Builtin.forms
    Builtin.Fresh
      { Builtin.dimension = Dimension.atom (Dimension.Unknown 0),
        Builtin.anything = Variable 0
      }

inCutter :: Text -> [Token] -> [Slot]
inCutter kind written = case drop (length parts - 1) (SlotWord.cutterWords kind) of
  [] -> []
  w : _ -> case last parts of
    [] -> [AtWord [GrammarWord w (w <> " ")]]
    _ : rest -> operand [AtValue [typeOf w] False] [] rest
  where
    parts = segments written
    typeOf w = case w of
      "bevel" -> Type.angle
      "tip" -> Type.number
      _ -> Type.len

-- | The slots in the values of a cipher. Values along the curve may name the columns of its table.
inCipher :: [(Text, Type)] -> Text -> [Token] -> [Slot]
inCipher columns digit written = case SlotWord.cipherTypes digit index of
  [] -> []
  types -> operand ([AtColumn columns | isAlong types] <> [AtValue types False]) [] (last parts)
  where
    parts = segments written
    index = length parts - 1
    isAlong types = Type.angle `elem` types || (digit, index) `elem` [("4", 1), ("6", 0)]
