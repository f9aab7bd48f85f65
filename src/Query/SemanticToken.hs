-- | The words, numbers and comments of a text with their meanings, by which an editor colours them.
module Query.SemanticToken
  ( SemanticToken (..),
    TokenKind (..),
    semanticTokens,
  )
where

import Base.Region (Located (..), Region (..))
import Base.Region qualified as Region
import Checked.Type (Type (..))
import Data.List (sortOn)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (isJust, isNothing, mapMaybe)
import Query.Manual qualified as Manual
import Query.Mention (Mention, MentionType (..))
import Query.Mention qualified as Mention
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Surface.Lexer qualified as Lexer
import Surface.Token (Token (..), Token_ (..))

-- | A region of one line with its kind. A definition is the region in which a name is defined.
data SemanticToken = SemanticToken
  { place' :: Region,
    kind :: TokenKind,
    isDefinition :: Bool,
    -- | true for a function or a constant of the language
    isOfLanguage :: Bool
  }
  deriving stock (Eq, Show)

-- | The kind of a token.
data TokenKind
  = KeywordToken
  | NumberToken
  | TextToken
  | CommentToken
  | ValueToken
  | FunctionToken
  | ContourToken
  deriving stock (Eq, Show, Enum, Bounded)

-- | The tokens of the program's own text, in order.
semanticTokens :: Snapshot -> [SemanticToken]
semanticTokens now = sortOn place' (mapMaybe (semantic mentions) tokens <> map comment comments)
  where
    (tokens, comments) = Lexer.tokens 0 (Region.text (Snapshot.source now))
    comment (Located r _) = plain r CommentToken
    mentions =
      Map.fromList [(Mention.place m, m) | m <- Mention.mentions (Snapshot.facts now)]

plain :: Region -> TokenKind -> SemanticToken
plain r kind = SemanticToken {place' = r, kind, isDefinition = False, isOfLanguage = False}

-- | The token with its meaning; 'Nothing' for a sign, and for a name of which nothing is known.
semantic :: Map Region Mention -> Token -> Maybe SemanticToken
semantic mentions token = case (shape token, Map.lookup (place token) mentions) of
  (Word _, Just m) ->
    Just
      SemanticToken
        { place' = place token,
          kind = kindOf m,
          isDefinition = Mention.definition m == Just (place token),
          isOfLanguage = isNothing (Mention.definition m)
        }
  (Word w, Nothing) | isJust (Manual.word w) -> Just (plain (place token) KeywordToken)
  (Word _, Nothing) -> Nothing
  (Number _ _, _) -> Just (plain (place token) NumberToken)
  (BadNumber _, _) -> Just (plain (place token) NumberToken)
  (Text _, _) -> Just (plain (place token) TextToken)
  (OpenText, _) -> Just (plain (place token) TextToken)
  (Symbol _, _) -> Nothing
  (Stray _, _) -> Nothing
  where
    kindOf m = case Mention.typing m of
      OfFunction _ _ -> FunctionToken
      OfValue Contour -> ContourToken
      OfValue _ -> ValueToken
      Untyped -> if isNothing (Mention.definition m) then FunctionToken else ValueToken
