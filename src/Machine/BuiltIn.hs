-- | The machines that partc knows by itself: the descriptions in the folder @machines/@. Each is
-- read when it is asked for.
module Machine.BuiltIn
  ( names,
    find,
    machines,
    text,
  )
where

import Base.Crash qualified as Crash
import Base.Result qualified as Result
import Data.ByteString (ByteString)
import Data.Either (fromRight)
import Data.List (sortOn)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Machine.Embedded qualified as Embedded
import Machine.FromText qualified as FromText
import Machine.Machine (Machine, MachineName (..))

-- | In the order of the alphabet.
names :: [MachineName]
names = map fst known

find :: MachineName -> Maybe Machine
find name = snd <$> lookup name known

-- | All of them, in the order of their names.
machines :: [Machine]
machines = [m | (_, (_, m)) <- known]

-- | The description of a machine.
text :: MachineName -> Maybe Text
text name = fst <$> lookup name known

-- | Each file is named for its machine.
known :: [(MachineName, (Text, Machine))]
known =
  [ (name, described name bytes)
    | (file, bytes) <- sortOn fst Embedded.files,
      Just n <- [Text.stripSuffix ".machine" (Text.pack file)],
      let name = MachineName n
  ]

described :: MachineName -> ByteString -> (Text, Machine)
described (MachineName name) bytes = (content, machine)
  where
    content = fromRight (Crash.bug (name <> ".machine is not UTF-8")) (Encoding.decodeUtf8' bytes)
    machine = case Result.settled (FromText.read content) of
      Just m -> m
      Nothing -> Crash.bug (name <> ".machine does not read")
