-- | The tokens around a token at which a program cannot be parsed.
module Surface.TokenContext
  ( TokenContext (..),
    previous,
    following,
  )
where

import Data.Maybe (listToMaybe)
import Report.Fix (Fix)
import Surface.Token (Token)

-- | Tokens of the statement around a wrong token.
data TokenContext = TokenContext
  { -- | tokens from the start of the statement up to the wrong one, the nearest first
    before :: [Token],
    -- | tokens after the wrong one on its line, the nearest first
    after :: [Token],
    -- | true if the wrong token is the first one on its line, or the end of the text
    isLineStart :: Bool,
    -- | repairs of the statement, with which it can be parsed; lazy, because they are searched for
    -- only if the report is shown
    repairs :: ~[Fix]
  }
  deriving stock (Eq, Ord, Show)

-- | The token before the wrong one.
previous :: TokenContext -> Maybe Token
previous = listToMaybe . before

-- | The token after the wrong one on its line.
following :: TokenContext -> Maybe Token
following = listToMaybe . after
