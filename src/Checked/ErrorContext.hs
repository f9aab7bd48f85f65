-- | Adds to errors the facts that only the whole program gives: numbers as they are written, the
-- statements around a region, names that are free, and the uses of a name.
module Checked.ErrorContext
  ( complete,
  )
where

import Base.Name (Name (..))
import Base.Quantity (LengthUnit (..))
import Base.Region (Located (..), Region (..))
import Checked.Builtin qualified as Builtin
import Checked.CallError qualified as CallError
import Checked.Error (Error (..), StatementMove (..))
import Checked.Error qualified as Error
import Checked.ErrorFix
  ( WrittenTerm
      ( WrittenTerm,
        callForm,
        curve,
        definitions,
        freeName,
        isOwnCall,
        isPairList,
        literal,
        sense,
        statement
      ),
  )
import Checked.ErrorFix qualified as ErrorFix
import Checked.ListError qualified as ListError
import Checked.Type qualified as Type
import Data.Char (isDigit, toUpper)
import Data.Foldable (toList)
import Data.List (find, sortOn)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isJust, isNothing, listToMaybe, mapMaybe, maybeToList)
import Data.Ord (Down (..))
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Report (ReportPlace (..), place)
import Surface.Keyword qualified as Keyword
import Surface.PrintExpression qualified as PrintExpression
import Surface.Syntax (Expr_ (..), Item_ (..), Operator (..), Spin (..), Statement, Statement_ (..))
import Surface.Syntax qualified as Surface
import Surface.SyntaxWalk qualified as SyntaxWalk
import Surface.Token (Numeral (..), unitName)

-- | Completes the errors of a program, whose statements are given.
complete :: [Statement] -> [Error] -> [Error]
complete statements errors = case errors of
  [] -> []
  _ ->
    oncePerSum . map (completed statements) . oncePerPoint statements . oncePerName
      . CallError.oncePerCall statements
      . map (numberLetter statements)
      . besideSpaces statements
      $ besideElements statements (filter (not . isLost) errors)
  where
    -- The name of a definition that cannot be parsed is unknown, and may be any that is missing.
    -- A table that cannot be read may have a column with any name.
    isLost e = case e of
      UndefinedName {} -> isNameLost || isTableLost
      UndefinedFunction {} -> isNameLost
      _ -> False
    isNameLost = or [fromMaybe "let" k `elem` definers | (k, Nothing) <- broken]
    isTableLost = Just "table" `elem` map fst broken
    definers = ["let", "param", "contour", "table", "curve", "piece"]
    broken =
      [ (keyword, name)
        | Located _ (Surface.Broken keyword name) <- concatMap SyntaxWalk.statementsIn statements
      ]

-- | The errors, with one error for all numbers of a point that lacks its brackets.
oncePerPoint :: [Statement] -> [Error] -> [Error]
oncePerPoint statements errors = case errors of
  [] -> []
  e : rest -> case spanNumbers e rest of
    (r : _, others)
      | Just first <- number e ->
        BareCoordinates (Region (start first) (end r)) : oncePerPoint statements others
    _ -> e : oncePerPoint statements rest
  where
    number e = case e of
      Mismatch r wanted (Type.Quantity _) _ _
        | wanted == Type.aPoint && not (any (contains r) pieces) -> Just r
      _ -> Nothing
    -- The values of a cipher are separate.
    pieces = [region s | s@(Located _ (Piece {})) <- concatMap SyntaxWalk.statementsIn statements]
    -- The regions of the numbers after the first, the last one first, and the other errors.
    spanNumbers e rest = case (number e, rest) of
      (Just r, next : more)
        | Just r' <- number next,
          start r' > end r,
          start r' <= end r + 2 ->
          let (others, left) = spanNumbers next more in (others <> [r'], left)
      _ -> ([], rest)

-- | The errors, with one error for each sum of points: the one that knows the whole calculation.
oncePerSum :: [Error] -> [Error]
oncePerSum errors = [e | (k, e) <- zip [0 :: Int ..] errors, not (isRepeated k e)]
  where
    isRepeated k e = case e of
      PointsAdded at _ _ half ->
        or
          [ isNothing half && isJust half' || (isJust half == isJust half') && n < k
            | (n, PointsAdded at' _ _ half') <- zip [0 ..] errors,
              at' == at,
              n /= k
          ]
      _ -> False

-- | The errors, with one error for an unknown name in a contour and the value after it that can be
-- no element. The name of an element may mean a link; names elsewhere cannot.
besideElements :: [Statement] -> [Error] -> [Error]
besideElements statements errors = mapMaybe joined errors
  where
    joined e = case e of
      UndefinedName at name known _
        | next : _ <- [r | NotAnElement r _ _ <- errors, isNext at r] ->
          Just (UnknownLink at name next (if isElement at then filter (`elem` links) known else []))
        | not (isElement at) -> Just (UndefinedName at name (filter (`notElem` links) known) [])
      UndefinedName at name known _
        | next : _ <- [r | SenseMissing r <- errors, isNext at r] ->
          Just (UnknownLink at name next (filter (`elem` ["cw", "ccw"]) known))
      SenseMissing r | or [isNext at r | UndefinedName at _ _ _ <- errors] -> Nothing
      NotAnElement r _ _ | or [isNext at r | UndefinedName at _ _ _ <- errors] -> Nothing
      _ -> Just e
    isNext at r = start r > end at && start r <= end at + 3
    isElement at = at `elem` elements
    elements = map region (elementsIn statements)
    links = ["fillet", "chamfer", "tangent", "smooth", "meet", "feed", "slow", "allowance", "bevel"]

-- | The expressions that are elements of contours.
elementsIn :: [Statement] -> [Surface.Expr]
elementsIn statements =
  [ x
    | s <- concatMap SyntaxWalk.statementsIn statements,
      Located _ (Element _ x _ _) <- SyntaxWalk.itemsOf s
  ]

-- | The errors, with one error for the name of a function and its arguments after a space, which
-- look like two elements of a contour.
besideSpaces :: [Statement] -> [Error] -> [Error]
besideSpaces statements errors = mapMaybe joined errors
  where
    joined e = case e of
      FunctionAsValue at name _ Nothing
        | next : _ <- tuplesBehind at -> Just (CallApart at name (Region (end at) (start next)))
      _ | isInArguments e -> Nothing
      _ -> Just e
    tuplesBehind at =
      [ r
        | Located r x <- elementsIn statements,
          isTuple x,
          start r > end at,
          start r <= end at + 3
      ]
    isTuple x = case x of
      Pair _ _ -> True
      Triple {} -> True
      _ -> False
    apart = [r | FunctionAsValue at _ _ Nothing <- errors, r <- tuplesBehind at]
    isInArguments e = case place (Error.toReport Millimetres e) of
      InSource r -> any (contains r) apart
      _ -> False

-- | An error of a number with the letter that G-code has before it: T before the number of a tool,
-- G before a work offset, O before the number of a program.
numberLetter :: [Statement] -> Error -> Error
numberLetter statements e = case e of
  UndefinedName at name@(Name text) _ _
    | Just (letter, digits') <- Text.uncons text,
      Text.all isDigit digits' && not (Text.null digits'),
      (_, what) : _ <- [n | (r, n) <- numbers, r == at, fst n == toUpper letter] ->
      NumberLetter at name digits' what
  _ -> e
  where
    numbers =
      [ (region n, what)
        | s <- concatMap SyntaxWalk.statementsIn statements,
          (n, what) <- lettered (value s)
      ]
    lettered s = case s of
      Change n _ _ -> [(n, ('T', "the number of the tool"))]
      Tool (Just n) _ -> [(n, ('T', "the number of the tool"))]
      WorkOffset n -> [(n, ('G', "the work offset"))]
      ProgramNumber n -> [(n, ('O', "the number of the program"))]
      _ -> []

-- | The errors, with one error for each unknown name.
oncePerName :: [Error] -> [Error]
oncePerName errors = case errors of
  [] -> []
  UndefinedName at name known others : rest ->
    let again = [at' | UndefinedName at' name' _ _ <- rest, name' == name]
        isOther e = case e of
          UndefinedName _ name' _ _ -> name' /= name
          _ -> True
     in UndefinedName at name known (others <> again) : oncePerName (filter isOther rest)
  e : rest -> e : oncePerName rest

completed :: [Statement] -> Error -> Error
completed statements e = case e of
  Mismatch at wanted found elsewhere _
    | sum' : _ <- mapMaybe (addedPoints statements . fst) ((at, wanted) : elsewhere),
      isSpatial wanted && isSpatial found ->
      sum'
  Mismatch at wanted (Type.Quantity _) _ _
    | wanted == Type.aPoint,
      first : _ <- [l | Binary Subtract l _ <- termsAt statements at] ->
      CommaMissing at (end (region first))
  UnknownUnit at n unit word _ -> UnknownUnit at n unit word (spindleSpeed statements at)
  Mismatch at wanted found elsewhere _ ->
    Mismatch at wanted found elsewhere (termAt statements at)
  ListAmongItems at needed lists single _ _ ->
    let first = mapMaybe written (termsAt statements (fst (NonEmpty.head lists)))
        found = ListError.listFixesAt statements at (NonEmpty.toList lists)
     in ListAmongItems at needed lists single (listToMaybe first) found
  Disagree at operator left right elsewhere _ ->
    Disagree at operator left right elsewhere $
      if isOwnCall (termAt statements at)
        then Nothing
        else Just (termAt statements (fst left), termAt statements (fst right))
  NotAnElement at t _ -> NotAnElement at t (termAt statements at)
  UsedBeforeDefinition at name defined _ ->
    UsedBeforeDefinition at name defined (moveAbove statements at defined)
  DefinedTwice at name before _ _ ->
    DefinedTwice at name before (definitionAt statements at name) (usesOf statements at name)
  NameTaken at name _ _ ->
    NameTaken at name (definitionAt statements at name) (usesOf statements at name)
  NoForm at name given known misfits changes _ points ->
    let commas
          | Type.SpacePoint `elem` map snd given = decimalCommasOfPoints statements
          | otherwise = decimalCommas statements (map fst given)
     in NoForm at name given known misfits changes commas points
  NoSuchCall at name known changes call@(Just (given, _)) _ points ->
    NoSuchCall at name known changes call (decimalCommas statements given) points
  ArgumentCount at name wanted given _ points _ ->
    let commas = decimalCommas statements given
     in ArgumentCount at name wanted given commas points $
          CallError.writtenCall statements name given
  _ -> e

isSpatial :: Type.Type -> Bool
isSpatial t = case t of
  Type.Spatial _ -> True
  _ -> False

-- | The error of a sum of points, if the term at a region is a sum, or a multiple of one.
addedPoints :: [Statement] -> Region -> Maybe Error
addedPoints statements at =
  listToMaybe (mapMaybe ofTerm (termsAt statements at))
  where
    ofTerm x = case x of
      Binary Add l r -> Just (added Nothing l r)
      Binary Divide (Located _ (Binary Add l r)) (Located _ (Literal n Nothing))
        | amount n == 2 -> Just (half l r)
      Binary Multiply (Located _ (Binary Add l r)) (Located _ (Literal n Nothing))
        | amount n == 0.5 -> Just (half l r)
      Binary Multiply (Located _ (Literal n Nothing)) (Located _ (Binary Add l r))
        | amount n == 0.5 -> Just (half l r)
      _ -> Nothing
    half = added (Just at)
    added whole l r =
      PointsAdded
        (Region (start (region l)) (end (region r)))
        (region l)
        (region r)
        whole

-- | The speed of the spindle in turns per minute at the statement that contains a region. 'Nothing'
-- if the program does not give it as a number, or if it is not certain which statement gave it.
spindleSpeed :: [Statement] -> Region -> Maybe Double
spindleSpeed program at = go Nothing program
  where
    go speed statements = case statements of
      [] -> Nothing
      s : rest
        | contains at (region s) -> inside speed s
        | otherwise -> go (after speed s) rest
    inside speed s = case value s of
      -- The turns after the first begin with the speed at the end of the block.
      Repeat _ _ body -> go (if any (isCommand . value) (everyIn body) then Nothing else speed) body
      When _ body others -> go speed (if any (contains at . region) body then body else others)
      With _ body -> go speed body
      _ -> speed
    after speed s = case value s of
      Spindle (Spinning _ (Just (Located _ (Literal n _))) Nothing) -> Just (amount n)
      _ | any (isCommand . value) (SyntaxWalk.statementsIn s) -> Nothing
      _ -> speed
    everyIn = concatMap SyntaxWalk.statementsIn
    isCommand s = case s of
      Spindle _ -> True
      Change {} -> True
      _ -> False

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

-- | The commas of points with a height that may be decimal commas: one comma of the point has no
-- space beside it, and the other has.
decimalCommasOfPoints :: [Statement] -> [Region]
decimalCommasOfPoints statements =
  concat
    [ take 1 tight
      | s <- concatMap SyntaxWalk.statementsIn statements,
        Located _ (Triple x y z) <- concatMap SyntaxWalk.everywhere (SyntaxWalk.ofStatement s),
        let tight = decimalCommas statements (map region [x, y, z]),
        length tight == 1
    ]

-- | The facts about the term at a region.
termAt :: [Statement] -> Region -> WrittenTerm
termAt statements at =
  WrittenTerm
    { literal = listToMaybe [(digits n, unit) | Literal n (Just unit) <- terms],
      statement = region <$> listToMaybe around,
      freeName =
        listToMaybe
          ( [(name, free statements name) | Variable (Name name) <- terms]
              <> [ (PrintExpression.oneLine (Located at x), free statements "edge")
                   | x@(Call _ _) <- terms
                 ]
          ),
      ErrorFix.words = listToMaybe (mapMaybe written terms),
      isPairList = or [length es `elem` [2, 3] | List es <- terms],
      isOwnCall = or [isNothing (Builtin.lookup name) | Call (Located _ (Name name)) _ <- terms],
      callForm = CallError.formAround statements at,
      curve = listToMaybe [c | Variable n <- terms, Just c <- [curveThrough statements at n]],
      sense = if isMilledOutside then "cw" else "ccw",
      definitions =
        [ region e
          | Located _ (LetValue _ e) <- concatMap SyntaxWalk.statementsIn statements,
            isCalculation (value e)
        ]
    }
  where
    isMilledOutside =
      or [True | Located _ (Mill e (Located _ Surface.Outside) _) <- around, region e == at]
    isCalculation x = case x of
      Literal _ _ -> False
      Variable _ -> False
      _ -> True
    around = innermostFirst at (concatMap SyntaxWalk.statementsIn statements)
    terms = termsAt statements at

-- | The name of a curve through the points of a table that is defined above a region.
curveThrough :: [Statement] -> Region -> Name -> Maybe Text
curveThrough statements at table =
  listToMaybe
    [ name
      | Located _ (Curve (Located r (Name name)) (Located _ (Call _ as))) <-
          concatMap SyntaxWalk.statementsIn statements,
        Surface.Given (Located _ (Variable n)) <- take 1 (toList as),
        n == table,
        start r < start at
    ]

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
          [region s | s <- innermostFirst at everything, Just n <- [nameOf s], region n == at],
      freeName = Just (name, free statements name),
      ErrorFix.words = Just name,
      isOwnCall = False,
      isPairList = False,
      callForm = Nothing,
      curve = Nothing,
      sense = "ccw",
      definitions = []
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
    isStatement = or [region n == at | s <- maybeToList own, Just n <- [nameOf s]]
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
        <> [text | s <- everything, Just (Located _ (Name text)) <- [nameOf s]]
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

nameOf :: Statement -> Maybe (Located Name)
nameOf = SyntaxWalk.definedName . value
