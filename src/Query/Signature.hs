-- | The forms of the function whose call contains the cursor, and the argument at the cursor.
module Query.Signature
  ( Signature (..),
    signature,
  )
where

import Base.Region qualified as Region
import Checked.Builtin qualified as Builtin
import Data.Containers.ListUtils (nubOrd)
import Data.List (elemIndex, find)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Query.Cursor (Level (..), Opening (..))
import Query.Cursor qualified as Cursor
import Query.Manual (ManualEntry)
import Query.Manual qualified as Manual
import Query.Mention (MentionType (..))
import Query.Scope qualified as Scope
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Surface.Token (Token)

-- | The forms of a function as texts, each with the texts of its parameters.
data Signature = Signature
  { forms :: [(Text, [Text])],
    -- | the index of the form that fits the arguments written so far, from 0
    active :: Int,
    -- | the index of the argument at the cursor, from 0
    argument :: Int,
    about :: Maybe ManualEntry
  }
  deriving stock (Eq, Show)

-- | The signature of the innermost call around the offset @at@. @now@ is the snapshot of the
-- present text, and @before@ the last snapshot without errors. 'Nothing' outside of calls.
signature :: Snapshot -> Maybe Snapshot -> Int -> Maybe Signature
signature now before at = do
  cursor <- Cursor.at (Region.text (Snapshot.source now)) at
  (function, written) <- callAround (NonEmpty.toList (Cursor.levels cursor))
  let arguments = Cursor.segments (reverse written)
      index = length arguments - 1
      names = Scope.scope now before cursor
      made forms about =
        Signature {forms, active = bestForm arguments (map snd forms), argument = index, about}
  case (find ((== function) . Scope.name) names, Builtin.lookup function) of
    (Just n, _) -> case Scope.typing n of
      OfFunction parameters _ ->
        let titles = map fst parameters
         in Just (made [(Builtin.callText function titles, titles)] Nothing)
      _ -> Nothing
    (Nothing, Just builtin) ->
      let texts = nubOrd [(t, parametersIn t) | t <- Builtin.formTexts builtin]
          about' = Manual.function function
       in if Builtin.isConstant builtin then Nothing else Just (made texts about')
    (Nothing, Nothing) -> Nothing

-- | The innermost call among the levels around the cursor: its function and its tokens, the newest
-- first.
callAround :: [Level] -> Maybe (Text, [Token])
callAround levels = case levels of
  [] -> Nothing
  l : rest -> case opening l of
    CallOf f -> Just (f, heads l)
    Parenthesis -> callAround rest
    ListBracket -> callAround rest
    _ -> Nothing

-- | The texts of the parameters in the text of a form.
parametersIn :: Text -> [Text]
parametersIn form = filter (/= "") (Text.splitOn ", " inner)
  where
    inner = Text.dropEnd 1 (Text.drop 1 (Text.dropWhile (/= '(') form))

-- | The index of the first form that has the most in common with the written arguments: the same
-- words before them, and enough parameters.
bestForm :: [[Token]] -> [[Text]] -> Int
bestForm arguments forms = case forms of
  [] -> 0
  _ -> fromMaybe 0 (elemIndex (maximum scores) scores)
  where
    scores = map score forms
    score parameters =
      ( length parameters >= length arguments,
        length (filter id (zipWith agrees arguments parameters)),
        negate (length parameters)
      )
    agrees written parameter = case Cursor.wordsOf (take 1 written) of
      [w] | w `elem` choices -> Text.takeWhile (/= ' ') parameter == w || isRank w parameter
      _ -> Text.takeWhile (/= ' ') parameter `notElem` choices
    isRank w parameter = w `elem` ["first", "last"] && parameter == "first or last"
    choices = ["near", "left", "right", "inside", "outside", "within", "first", "last"]
