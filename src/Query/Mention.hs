-- | What is known of the names of a program: where each stands, what it means, what its value is.
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

-- | All names of a program, and the values of what it defines: the place of the name, the value in
-- words.
data Mentions = Mentions {mentions :: [Mention], values :: [(Region, Text)]}
  deriving stock (Eq, Show)

-- | Nothing is known.
none :: Mentions
none = Mentions [] []

-- | The facts of a program, as far as it could be checked and computed.
facts :: Maybe ([Mention], Part) -> Mentions
facts known = case known of
  Nothing -> none
  Just (mentions, part) -> Mentions {mentions, values = Part.readings part}
