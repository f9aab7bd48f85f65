{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Mistakes in calls that show only in the whole program: two arguments in the wrong order whose
-- types other uses decide, numbers for vectors, and a space before the bracket of a call.
module Checked.CallError
  ( inOrder,
    oncePerCall,
    formAround,
    writtenCall,
    suspects,
    isDoubtful,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (..), Region (..))
import Checked.Builtin qualified as Builtin
import Checked.CallReport (BothUses (..), WrittenCall (..))
import Checked.Error (Error (..))
import Checked.Syntax qualified as Checked
import Checked.Type (Type)
import Checked.Type qualified as Type
import Data.List (sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, listToMaybe, mapMaybe)
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.PrintExpression (oneLine)
import Surface.Syntax
import Surface.SyntaxWalk qualified as SyntaxWalk

-- | A call of a function of the language with its only form that has no labels.
data KnownCall = KnownCall
  { place :: Region,
    name :: Name,
    values :: [Region],
    form :: Text,
    parameters :: [(Text, Type)]
  }

-- | The calls of functions that have one form.
knownCalls :: [Statement] -> [KnownCall]
knownCalls statements =
  [ KnownCall
      { place = region c,
        name = value callee,
        values = map region es,
        form = Builtin.formText builtin f,
        parameters = [(Builtin.title p, Builtin.type' p) | p <- Builtin.parameters f]
      }
    | s <- concatMap SyntaxWalk.statementsIn statements,
      c@(Located _ (Call callee as)) <- concatMap SyntaxWalk.everywhere (SyntaxWalk.ofStatement s),
      let Name text = value callee,
      Just builtin <- [Builtin.lookup text],
      Just es <- [traverse given (NonEmpty.toList as)],
      [f] <- [formsOf builtin (length es)]
  ]
  where
    given a = case a of
      Given e -> Just e
      _ -> Nothing

formsOf :: Checked.Builtin -> Int -> [Builtin.Form]
formsOf builtin count = case Builtin.formsForReports builtin of
  [f] | length (Builtin.parameters f) == count -> [f]
  _ -> []

-- | The call around an argument with a region, with the names of all its parameters. 'Nothing' if
-- the function has one parameter, or several forms.
formAround :: [Statement] -> Region -> Maybe Text
formAround statements at = case calls of
  c : _ -> Just (form c)
  [] -> Nothing
  where
    calls = [c | c <- knownCalls statements, at `elem` values c, length (values c) > 1]

-- | The facts about a call of a function, whose arguments have the given regions.
writtenCall :: [Statement] -> Name -> [Region] -> WrittenCall
writtenCall statements function given =
  WrittenCall
    { definition =
        listToMaybe
          [ Region (start (region n)) (end (region (NonEmpty.last ps)))
            | Located _ (LetFunction n ps _) <- concatMap SyntaxWalk.statementsIn statements,
              value n == function
          ],
      writtenArguments = map oneLine (concatMap (termsAt statements) given)
    }

-- | The terms at a region.
termsAt :: [Statement] -> Region -> [Expr]
termsAt statements at =
  [ e
    | s <- concatMap SyntaxWalk.statementsIn statements,
      x <- SyntaxWalk.ofStatement s,
      e <- SyntaxWalk.everywhere x,
      region e == at
  ]

-- | The errors, with one error for a call whose two arguments are in the wrong order. Exchanging
-- them has to remove an error, and may cause no other. If an exchange in either of two calls does
-- that equally well, the error names both. @recheck@ gives the errors of other statements.
inOrder :: ([Statement] -> [Error]) -> [Statement] -> [Error] -> [Error]
inOrder recheck statements errors = case sortOn (length . left) (known <> solutions) of
  [] -> errors
  best : rest
    | both : _ <- mapMaybe (usedAsBoth statements best) (filter (isEqual best) rest) ->
      both : left best
    | fault best `elem` errors -> errors
    | otherwise -> fault best : left best
  where
    isEqual a b = length (left a) == length (left b)
    -- Calls that inference has found in the wrong order, but because of uses elsewhere.
    known =
      [ Exchange e at (map fst given) (fromMaybe (filter (/= e) errors) (exchanged at))
        | e@(Swapped at _ given _ _ (_ : _)) <- errors
      ]
    solutions =
      [ Exchange
          (Swapped (place c) (name c) [(a, second), (b, first)] (form c) (0, 1) [])
          (place c)
          [a, b]
          errors'
        | c <- take 4 (filter isSuspect (knownCalls statements)),
          [a, b] <- [values c],
          [(_, first), (_, second)] <- [parameters c],
          Just errors' <- [exchanged (place c)]
      ]
    isSuspect c =
      place c `notElem` map call known && or [within r v | r <- contradicted errors, v <- values c]
    within r v = start v <= start r && end r <= end v
    exchanged at
      | length errors' < length errors && all (`elem` errors) errors' = Just errors'
      | otherwise = Nothing
      where
        errors' = recheck (map (exchangedAt at) statements)

-- | The exchange of the arguments of a call: the error that asks for it, the regions of the call
-- and of its arguments, and the errors that are left after it.
data Exchange = Exchange {fault :: Error, call :: Region, operands :: [Region], left :: [Error]}

-- | The error of an argument that two calls have in common and use as different types. 'Nothing' if
-- they have no name in common.
usedAsBoth :: [Statement] -> Exchange -> Exchange -> Maybe Error
usedAsBoth statements one another =
  listToMaybe
    [ UsedAsBoth
        other
        BothUses
          { argument = text,
            firstUse = (first, t, written (call a)),
            otherUse = (t', written (call b)),
            exchanges = [(written (call e), r, r') | e <- [a, b], [r, r'] <- [operands e]]
          }
      | (first, text, t) <- uses a,
        (other, text', t') <- uses b,
        text == text',
        t /= t'
    ]
  where
    (a, b) = if call one < call another then (one, another) else (another, one)
    written r = Text.concat (take 1 (map oneLine (termsAt statements r)))
    uses e =
      [ (r, text, snd p)
        | c <- knownCalls statements,
          place c == call e,
          (r, p) <- zip (values c) (parameters c),
          Located _ (Variable (Name text)) <- termsAt statements r
      ]

-- | The regions of terms to which several uses give different types.
contradicted :: [Error] -> [Region]
contradicted errors =
  concat
    ( [at : map fst elsewhere | Mismatch at _ _ elsewhere@(_ : _) _ <- errors]
        <> [map fst elsewhere | Swapped _ _ _ _ _ elsewhere <- errors]
    )

-- | A statement with the two arguments of the call at a region exchanged.
exchangedAt :: Region -> Statement -> Statement
exchangedAt at (Located r s) = Located r $ case s of
  LetValue n e -> LetValue n (inside e)
  LetFunction n ps e -> LetFunction n ps (inside e)
  Param n e -> Param n (inside e)
  Curve n e -> Curve n (inside e)
  Contour n closure items -> Contour n closure (map item items)
  _ -> s
  where
    item (Located at' i) = Located at' $ case i of
      Element sense e modifiers link -> Element sense (inside e) modifiers link
      For n e items -> For n (inside e) (map item items)
      Choose e items others -> Choose (inside e) (map item items) (map item others)
      BrokenItem n -> BrokenItem n
    inside e = case e of
      Located at' (Call callee (a :| [b])) | at' == at -> Located at' (Call callee (b :| [a]))
      _ -> SyntaxWalk.mapParts inside e

-- | The names that errors of types are about, if several uses of a name decide its type, and all
-- names whose definitions use them.
suspects :: [Statement] -> [Error] -> Set Name
suspects statements errors
  | Set.null first = first
  | otherwise = go first
  where
    decided = contradicted errors
    first =
      Set.fromList
        [ n
          | s <- statements,
            s' <- SyntaxWalk.statementsIn s,
            Located r (Variable n) <- concatMap SyntaxWalk.everywhere (SyntaxWalk.ofStatement s'),
            r `elem` decided
        ]
    go known =
      let more =
            Set.union
              known
              ( Set.fromList
                  [ value n
                    | s <- statements,
                      SyntaxWalk.mentionsAny known s,
                      s' <- SyntaxWalk.statementsIn s,
                      Just n <- [SyntaxWalk.definedName (value s')]
                  ]
              )
       in if Set.size more == Set.size known then known else go more

-- | True of the region of a statement that uses or defines one of some names.
isDoubtful :: [Statement] -> Set Name -> Region -> Bool
isDoubtful statements names at =
  or
    [ SyntaxWalk.mentionsAny names s || definesAny s
      | s <- statements,
        region s == at
    ]
  where
    definesAny s =
      or [Set.member (value n) names | Just n <- [SyntaxWalk.definedName (value s)]]

-- | The errors, with one error for all numbers that a call has in place of vectors.
oncePerCall :: [Statement] -> [Error] -> [Error]
oncePerCall statements errors
  | null (concatMap number errors) = errors
  | otherwise = go errors
  where
    calls = knownCalls statements
    number e = case e of
      Mismatch at wanted (Type.Quantity _) _ _ | wanted == Type.aVector -> [at]
      _ -> []
    go es = case es of
      [] -> []
      e : rest
        | [at] <- number e,
          c : _ <- [c' | c' <- calls, at `elem` values c'] ->
          let others = [r | r <- concatMap number rest, r `elem` values c]
              isOther e' = not (any (`elem` others) (number e'))
           in NumberForVector
                at
                (name c)
                [ (r, title)
                  | (r, (title, _)) <- zip (values c) (parameters c),
                    r `elem` (at : others)
                ]
                (form c) :
              go (filter isOther rest)
        | otherwise -> e : go rest
