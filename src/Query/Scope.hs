-- | The names that are visible at the cursor, with their types.
--
-- The names come from the tokens of the present text, so that they are known in a text that is
-- broken. Their types come from the check of the present text. If this check has no type for a
-- name, its type in the last text without errors is taken.
module Query.Scope
  ( ScopedName (..),
    scope,
    typings,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (Located), Region)
import Base.Region qualified as Region
import Checked.Type (Type (..))
import Control.Applicative ((<|>))
import Data.Containers.ListUtils (nubOrdOn)
import Data.List (find)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Query.Cursor (BoundName (BoundName), Cursor)
import Query.Cursor qualified as Cursor
import Query.Mention (Mention, MentionType (..))
import Query.Mention qualified as Mention
import Query.Slot (Typings (..))
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Surface.SyntaxWalk qualified as SyntaxWalk

-- | A visible name: its type, its description in words, its value, and the statement that defines
-- it.
data ScopedName = ScopedName
  { name :: Text,
    typing :: MentionType,
    meaning :: Text,
    value :: Maybe Text,
    -- | true for a contour
    isContour :: Bool
  }
  deriving stock (Eq, Show)

-- | The names that are visible at the cursor. @now@ is the snapshot of the present text, @before@
-- the last snapshot without errors. A name that hides another of the same spelling is the only one.
scope :: Snapshot -> Maybe Snapshot -> Cursor -> [ScopedName]
scope now before cursor = map scoped (nubOrdOn Cursor.name (own <> imported))
  where
    own = Cursor.visible cursor
    imported =
      [ BoundName n at
        | Located _ s <- Snapshot.imported now <> maybe [] Snapshot.imported before,
          Just (Located at (Name n)) <- [SyntaxWalk.definedName s]
      ]
    present = definitionsOf now
    earlier = Map.fromList [(Mention.word m, m) | m <- maybe [] (Map.elems . definitionsOf) before]
    scoped (BoundName n at) =
      ScopedName
        { name = n,
          typing = maybe Untyped Mention.typing found,
          meaning = maybe "" Mention.meaning found,
          value =
            find ((== n) . Mention.word) found >>= \m ->
              Map.lookup (Mention.place m) valuesAt,
          isContour = fmap Mention.typing found == Just (OfValue Contour)
        }
      where
        found = Map.lookup at present <|> Map.lookup n earlier
    valuesAt =
      Map.fromListWith
        (\_ first -> first)
        (concatMap (Mention.values . Snapshot.facts) (now : maybe [] pure before))

-- | The mentions of names in their own definitions, by the region of the name.
definitionsOf :: Snapshot -> Map Region Mention
definitionsOf snapshot =
  Map.fromList
    [ (Mention.place m, m)
      | m <- Mention.mentions (Snapshot.facts snapshot),
        Mention.definition m == Just (Mention.place m)
    ]

-- | The types that 'Query.Slot.slots' needs, from the visible names.
typings :: [ScopedName] -> Typings
typings names =
  Typings
    { parametersOf = \f -> case typing <$> named f of
        Just (OfFunction parameters _) -> map snd parameters
        _ -> [],
      columnsOf = \n -> case typing <$> named n of
        Just (OfValue (Curve (Fields cs))) -> map plain cs
        Just (OfValue (Table (Fields cs))) -> map plain cs
        _ -> []
    }
  where
    named n = find ((== n) . name) names
    plain (column, t) = (Region.value column, t)
