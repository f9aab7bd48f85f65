-- | What is known of the names of a program: where each stands, what it means, what its value is.
module Query.Facts
  ( Facts (..),
    Mention (..),
    none,
    facts,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (..), Region (..), Source)
import Base.Region qualified as Region
import Checked.Builtin qualified as Builtin
import Compile (Analysis)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.Syntax (Expr, Expr_ (..), Item, Item_ (..), Link_ (..), Pace (..), Program (..), Setting_ (..), Statement, Statement_ (..), Stop (..))

-- | One occurrence of a name, its definition included. Names of the language have no definition.
data Mention = Mention {place :: Region, definition :: Maybe Region, name :: Text, meaning :: Text}
  deriving stock (Eq, Show)

-- | All names of a program, and the values of what it defines: the place of the name, the value in words.
data Facts = Facts {mentions :: [Mention], values :: [(Region, Text)]}
  deriving stock (Eq, Show)

-- | Nothing is known.
none :: Facts
none = Facts [] []

-- | The facts of a program, as far as it could be read and checked. This is the stand-in for what the
-- checker will tell: it follows the names of the syntax tree and shows definitions as they are written.
facts :: Source -> Program -> Maybe Analysis -> Facts
facts source program _ = Facts {mentions = concat found, values = concatMap (valueOf source) (statements program)}
  where
    (_, found) = foldl next (Map.empty, []) (statements program)
    next (scope, done) s = let (scope', new) = statement scope s in (scope', done <> [new])

-- | A name that can be used: where it is defined, and what it is.
data Known = Known Region Text

type Scope = Map Name Known

-- | The names that are known behind a statement, and those that stand in it.
statement :: Scope -> Statement -> (Scope, [Mention])
statement scope s = case value s of
  Part what _ -> (scope, [definitionOf what "the part"])
  Machine _ -> (scope, [])
  Tool e -> (scope, expr scope e)
  Feed e -> (scope, expr scope e)
  Tolerance e -> (scope, expr scope e)
  From e -> (scope, expr scope e)
  LetValue what e -> (define what "a value" scope, definitionOf what "a value" : expr scope e)
  LetFunction what parameters body ->
    let kind = "a function of (" <> Text.intercalate ", " [n | Located _ (Name n) <- NonEmpty.toList parameters] <> ")"
        inner = foldr (`define` "a parameter") scope parameters
     in ( define what kind scope,
          definitionOf what kind : map (`definitionOf` "a parameter") (NonEmpty.toList parameters) <> expr inner body
        )
  Contour what _ items -> (define what "a contour" scope, definitionOf what "a contour" : concatMap (item scope) items)
  Mill what _ settings -> (scope, expr scope what <> concatMap (setting scope . value) settings)
  Travel stops -> (scope, concatMap (stop scope) stops)
  -- Of what cannot be read nothing is said, so that the last sound text may answer.
  Broken _ what -> (maybe scope (\(Located _ n) -> Map.delete n scope) what, [])

define :: Located Name -> Text -> Scope -> Scope
define (Located region name) kind = Map.insert name (Known region kind)

definitionOf :: Located Name -> Text -> Mention
definitionOf (Located region (Name name)) meaning = Mention {place = region, definition = Just region, name, meaning}

item :: Scope -> Item -> [Mention]
item scope i = case value i of
  Element _ e link -> expr scope e <> maybe [] (linked . value) link
  For variable list items ->
    definitionOf variable each : expr scope list <> concatMap (item (define variable each scope)) items
  BrokenItem _ -> []
  where
    each = "each of a list in turn"
    linked l = case l of
      Meet near -> maybe [] (expr scope) near
      Smooth -> []
      Tangent -> []
      Fillet e -> expr scope e
      Chamfer e -> expr scope e

setting :: Scope -> Setting_ -> [Mention]
setting scope s = case s of
  Approach stops -> concatMap (stop scope) stops
  Retract stops -> concatMap (stop scope) stops
  BrokenSetting -> []

stop :: Scope -> Stop -> [Mention]
stop scope Stop {point, pace} =
  expr scope point <> case pace of
    Cutting -> []
    Rapid -> []
    AtFeed e -> expr scope e

expr :: Scope -> Expr -> [Mention]
expr scope e = case value e of
  Literal _ _ -> []
  Variable name -> use scope (region e) name
  Call (Located at name) arguments -> use scope at name <> concatMap (expr scope) arguments
  Negate a -> expr scope a
  Binary _ a b -> expr scope a <> expr scope b
  Pair a b -> expr scope a <> expr scope b
  List es -> concatMap (expr scope) es

use :: Scope -> Region -> Name -> [Mention]
use scope place found@(Name name) = case Map.lookup found scope of
  Just (Known region meaning) -> [Mention {place, definition = Just region, name, meaning}]
  Nothing
    | Maybe.isJust (Builtin.lookup name) -> [Mention {place, definition = Nothing, name, meaning = "a name of the language"}]
    | otherwise -> []

-- | A definition's value, as it is written.
valueOf :: Source -> Statement -> [(Region, Text)]
valueOf source s = case value s of
  LetValue what e -> [(region what, slice (region e))]
  _ -> []
  where
    slice (Region from to) = Text.take (to - from) (Text.drop from (Region.text source))
