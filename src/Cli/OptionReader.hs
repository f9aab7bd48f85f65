-- | Readers of the values of options.
module Cli.OptionReader
  ( tickRange,
    switchRadius,
    joiningDistance,
    fromTo,
    portNumber,
    choice,
    assignment,
  )
where

import Base.Quantity (Mm (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Options.Applicative qualified as Opt
import Text.Read (readMaybe)

-- | Reads a range of ticks that is short enough for one page.
tickRange :: Opt.ReadM (Int, Int)
tickRange = do
  (a, b) <- rangeFrom 0
  if a < b && b - a <= most
    then pure (a, b)
    else
      Opt.readerError
        ("a timeline ends after its first tick, and at most " <> show most <> " ticks later")
  where
    most = 5000 :: Int

-- | The number of a switch, and the radius in mm at it: @1=5.02@.
switchRadius :: Opt.ReadM (Int, Mm)
switchRadius = Opt.maybeReader $ \text -> case break (== '=') text of
  (n, '=' : radius) -> (,) <$> readMaybe n <*> (readMaybe radius >>= positive)
  _ -> Nothing
  where
    positive r = if r >= 0 && r < 1e6 then Just (Mm r) else Nothing

-- | A distance in mm above 0.
joiningDistance :: Opt.ReadM Mm
joiningDistance = Opt.eitherReader $ \word -> case readMaybe word of
  Just d | d > 0 && d < 1e6 -> Right (Mm d)
  _ -> Left ("‘" <> word <> "’ is not a distance in mm above 0")

-- | Reads a range of numbers that count from 1, for example @3..8@; @3@ means @3..3@. The result
-- is the first and the last number of the range.
fromTo :: Opt.ReadM (Int, Int)
fromTo = rangeFrom 1

-- | Reads a range of numbers that count from @least@.
rangeFrom :: Int -> Opt.ReadM (Int, Int)
rangeFrom least =
  Opt.eitherReader $ \word ->
    case traverse (readMaybe . Text.unpack) (Text.splitOn ".." (Text.pack word)) of
      Just [a] | a >= least -> Right (a, a)
      Just [a, b] | least <= a, a <= b -> Right (a, b)
      _ -> Left ("‘" <> word <> "’ is not a range such as 3..8")

-- | Reads one of the words in @table@, and gives the value beside it. Any other word is an error;
-- its message lists the words of the table.
choice :: [(String, a)] -> Opt.ReadM a
choice table = Opt.eitherReader $ \word ->
  maybe
    (Left ("‘" <> word <> "’ is none of: " <> unwords (map fst table)))
    Right
    (lookup word table)

-- | Reads a parameter's name and its value, as in @d=25 mm@. The value is not parsed here.
assignment :: Opt.ReadM (Text, Text)
assignment = Opt.eitherReader $ \word -> case Text.breakOn "=" (Text.pack word) of
  (name, rest)
    | not (Text.null name),
      not (Text.null rest) ->
      Right (Text.strip name, Text.drop 1 rest)
  _ -> Left ("‘" <> word <> "’ is not NAME=VALUE")

-- | Reads the number of a port.
portNumber :: Opt.ReadM Int
portNumber = Opt.eitherReader $ \word -> case readMaybe word of
  Just n | n >= 1 && n <= 65535 -> Right n
  _ -> Left ("‘" <> word <> "’ is not a port from 1 to 65535")
