-- | Adds to errors the facts that only the whole program gives: numbers as they are written, the
-- statements around a region, names that are free, and the uses of a name.
module Checked.ErrorContext
  ( complete,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (..), Region (..))
import Checked.Builtin qualified as Builtin
import Checked.Error (Error (..), StatementMove (..))
import Checked.ErrorFix (WrittenTerm (WrittenTerm, freeName, isOwnCall, literal, statement))
import Checked.ErrorFix qualified as ErrorFix
import Data.List (find, sortOn)
import Data.Maybe (fromMaybe, isNothing, listToMaybe, mapMaybe, maybeToList)
import Data.Ord (Down (..))
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.Keyword qualified as Keyword
import Surface.Syntax (Expr_ (..), Statement, Statement_ (..))
import Surface.Syntax qualified as Surface
import Surface.SyntaxWalk qualified as SyntaxWalk
import Surface.Token (Numeral (..), unitName)

-- | Completes the errors of a program, whose statements are given.
complete :: [Statement] -> [Error] -> [Error]
complete statements errors = case errors of
  [] -> []
  _ -> map (completed statements) errors

completed :: [Statement] -> Error -> Error
completed statements e = case e of
  Mismatch at wanted found elsewhere _ ->
    Mismatch at wanted found elsewhere (termAt statements at)
  Disagree at operator left right elsewhere _ ->
    Disagree at operator left right elsewhere $
      if isOwnCall (termAt statements at)
        then Nothing
        else Just (termAt statements (fst left), termAt statements (fst right))
  NotAnElement at t _ -> NotAnElement at t (termAt statements at)
  UsedBeforeDefinition at name defined _ ->
    UsedBeforeDefinition at name defined (moveAbove statements at defined)
  DefinedTwice at name before _ -> DefinedTwice at name before (definitionAt statements at name)
  NameTaken at name _ _ ->
    NameTaken at name (definitionAt statements at name) (usesOf statements at name)
  NoForm at name given known misfits changes _ ->
    NoForm at name given known misfits changes (decimalCommas statements (map fst given))
  NoSuchCall at name known changes (Just (given, parameters)) _ ->
    NoSuchCall at name known changes (Just (given, parameters)) (decimalCommas statements given)
  ArgumentCount at name wanted given _ ->
    ArgumentCount at name wanted given (decimalCommas statements given)
  _ -> e

-- | The commas between arguments that may be decimal commas: those between two numbers without
-- units, with no space on either side.
decimalCommas :: [Statement] -> [Region] -> [Region]
decimalCommas statements given =
  [ Region (end a) (start b)
    | (a, b) <- zip given (drop 1 given),
      end a + 1 == start b,
      isNumber a,
      isNumber b
  ]
  where
    isNumber r = or [True | Literal _ Nothing <- termsAt statements r]

-- | The facts about the term at a region.
termAt :: [Statement] -> Region -> WrittenTerm
termAt statements at =
  WrittenTerm
    { literal = listToMaybe [(digits n, unit) | Literal n (Just unit) <- terms],
      statement = region <$> listToMaybe around,
      freeName = listToMaybe [(name, free statements name) | Variable (Name name) <- terms],
      ErrorFix.words = listToMaybe (mapMaybe written terms),
      isOwnCall = or [isNothing (Builtin.lookup name) | Call (Located _ (Name name)) _ <- terms]
    }
  where
    around = innermostFirst at (concatMap SyntaxWalk.statementsIn statements)
    terms = termsAt statements at

-- | A number or a name as it is written.
written :: Expr_ -> Maybe Text
written x = case x of
  Literal n unit -> Just (digits n <> maybe "" ((" " <>) . unitName) unit)
  Negate (Located _ y) -> ("-" <>) <$> written y
  Variable (Name name) -> Just name
  Call (Located _ (Name name)) _ -> Just (name <> "(…)")
  _ -> Nothing

-- | The terms with a region.
termsAt :: [Statement] -> Region -> [Expr_]
termsAt statements at =
  [ value x
    | s <- innermostFirst at (concatMap SyntaxWalk.statementsIn statements),
      x <- concatMap SyntaxWalk.everywhere (SyntaxWalk.ofStatement s),
      region x == at
  ]

-- | The facts about the definition of a name at a region. There is no statement if the name is a
-- parameter or the variable of a repetition.
definitionAt :: [Statement] -> Region -> Name -> WrittenTerm
definitionAt statements at (Name name) =
  WrittenTerm
    { literal = Nothing,
      statement =
        listToMaybe
          [region s | s <- innermostFirst at everything, Just n <- [definedName s], region n == at],
      freeName = Just (name, free statements name),
      ErrorFix.words = Just name,
      isOwnCall = False
    }
  where
    everything = concatMap SyntaxWalk.statementsIn statements

-- | The uses of a name that is defined at a region: as a value, or in calls if it is defined as a
-- function.
usesOf :: [Statement] -> Region -> Name -> [Region]
usesOf statements at name = concatMap use (concatMap everyTerm (filter isReached everything))
  where
    everything = concatMap SyntaxWalk.statementsIn statements
    everyTerm = concatMap SyntaxWalk.everywhere . SyntaxWalk.ofStatement
    own = listToMaybe (innermostFirst at everything)
    isStatement = or [region n == at | s <- maybeToList own, Just n <- [definedName s]]
    isFunction = isStatement && or [True | Located _ (LetFunction {}) <- maybeToList own]
    isReached s
      | isStatement = start (region s) > start at
      | otherwise = Just (region s) == fmap region own
    use x = case value x of
      Variable n | n == name && not isFunction -> [region x]
      Call n _ | value n == name && isFunction -> [region n]
      _ -> []

-- | The move of the statement that defines a name above the first statement that uses it, if both
-- are outside of blocks.
moveAbove :: [Statement] -> Region -> Region -> Maybe StatementMove
moveAbove statements at defined = case (containing at, containing defined) of
  (use : _, definition : _)
    | start (region use) < start (region definition) ->
      Just (StatementMove (region definition) (start (region use)))
  _ -> Nothing
  where
    containing r = filter (contains r . region) statements

innermostFirst :: Region -> [Statement] -> [Statement]
innermostFirst at = sortOn (Down . start . region) . filter (contains at . region)

contains :: Region -> Region -> Bool
contains inner outer = start outer <= start inner && end inner <= end outer

-- | A name that begins with the given one and that nothing in the program has.
free :: [Statement] -> Text -> Text
free statements name = fromMaybe name (find (`Set.notMember` used) candidates)
  where
    candidates = [name <> Text.pack (show n) | n <- [1 :: Int ..]]
    used = usedNames statements

usedNames :: [Statement] -> Set Text
usedNames statements =
  Set.fromList
    ( Builtin.names
        <> Keyword.reservedWords
        <> [text | s <- everything, Just (Located _ (Name text)) <- [definedName s]]
        <> concatMap
          named
          (concatMap SyntaxWalk.everywhere (concatMap SyntaxWalk.ofStatement everything))
    )
  where
    everything = concatMap SyntaxWalk.statementsIn statements
    named x = case value x of
      Variable (Name text) -> [text]
      Call (Located _ (Name text)) _ -> [text]
      _ -> []

-- | The name that a statement defines.
definedName :: Statement -> Maybe (Located Name)
definedName (Located _ s) = case s of
  LetValue n _ -> Just n
  LetFunction n _ _ -> Just n
  Param n _ -> Just n
  Contour n _ _ -> Just n
  Table n _ -> Just n
  Curve n _ -> Just n
  Piece n _ _ _ _ -> Just n
  Surface.Broken _ n -> n
  _ -> Nothing
