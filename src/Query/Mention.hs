-- | The names in a program: where each is mentioned, its meaning, its value.
module Query.Mention
  ( Mentions (..),
    Mention (..),
    none,
    facts,
  )
where

import Base.Region (Region)
import Checked.Syntax (Mention (..))
import Data.Text (Text)
import Part.Part (Part)
import Part.Part qualified as Part

-- | All mentions of names, and the values of the definitions: the region of the defined name, the
-- value as text.
data Mentions = Mentions {mentions :: [Mention], values :: [(Region, Text)]}
  deriving stock (Eq, Show)

-- | The facts of a program that cannot be checked.
none :: Mentions
none = Mentions [] []

-- | The facts of a program that can be checked and evaluated.
facts :: Maybe ([Mention], Part) -> Mentions
facts known = case known of
  Nothing -> none
  Just (mentions, part) -> Mentions {mentions, values = Part.readings part}
