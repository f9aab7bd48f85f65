-- | The names in a program: the regions that mention them, their meanings, and their values.
module Query.Mention
  ( Mentions (..),
    Mention (..),
    MentionType (..),
    none,
    facts,
    ofLoaded,
  )
where

import Base.Region (Region)
import Base.Result (Result (..))
import Checked.FromSurface qualified as Checked
import Checked.Syntax (Mention (..), MentionType (..))
import Checked.Syntax qualified as Checked
import Data.Text (Text)
import Part.Part (Part)
import Part.Part qualified as Part
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram

-- | All mentions of names in a program, and the values of its definitions. Each pair in @values@ is
-- the region of the defined name and the value as text.
data Mentions = Mentions {mentions :: [Mention], values :: [(Region, Text)]}
  deriving stock (Eq, Show)

-- | No mentions and no values, for a program that cannot be checked.
none :: Mentions
none = Mentions [] []

-- | Combines the mentions that the type checker has found with the values of the evaluated part. If
-- the program could not be checked, the result is 'none'.
facts :: Maybe ([Mention], Part) -> Mentions
facts known = case known of
  Nothing -> none
  Just (mentions, part) -> Mentions {mentions, values = Part.readings part}

-- | The mentions that the type checker finds in a loaded program.
ofLoaded :: LoadedProgram -> [Mention]
ofLoaded loaded = case output (LoadedProgram.surface loaded) of
  Just program -> maybe [] Checked.mentions (output (Checked.check program))
  Nothing -> []
