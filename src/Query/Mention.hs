-- | The names in a program: the regions that mention them, their meanings and their values.
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

-- | All mentions of names, and the values of the definitions. A value is a text, beside the region
-- of the name in the definition.
data Mentions = Mentions {mentions :: [Mention], values :: [(Region, Text)]}
  deriving stock (Eq, Show)

-- | No mentions and no values, as for a program that cannot be checked.
none :: Mentions
none = Mentions [] []

-- | The mentions that the checker found, with the values of the evaluated part. Yields 'none' for a
-- program that cannot be checked.
facts :: Maybe ([Mention], Part) -> Mentions
facts known = case known of
  Nothing -> none
  Just (mentions, part) -> Mentions {mentions, values = Part.readings part}
