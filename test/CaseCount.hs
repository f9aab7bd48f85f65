-- | Counts of random cases that the environment sets, for longer runs of the tests.
module CaseCount
  ( askedCount,
  )
where

import System.Environment (lookupEnv)
import Text.Read (readMaybe)

-- | Count in an environment variable; 'Nothing' if it is not set, or is not a number.
askedCount :: String -> IO (Maybe Int)
askedCount variable = (>>= readMaybe) <$> lookupEnv variable
