-- | The built-in machines, which the files in the folder @machines/@ describe. A description is
-- read when its machine is first used.
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

-- | Names of all built-in machines, in alphabetical order.
names :: [MachineName]
names = map fst builtIn

-- | Finds a machine by its name; 'Nothing' if no built-in machine has the name.
find :: MachineName -> Maybe Machine
find name = snd <$> lookup name builtIn

-- | All built-in machines, in the order of their names.
machines :: [Machine]
machines = [m | (_, (_, m)) <- builtIn]

-- | The text that describes the built-in machine with the given name; 'Nothing' if no built-in
-- machine has the name.
text :: MachineName -> Maybe Text
text name = fst <$> lookup name builtIn

-- | Each machine with its name and the text that describes it. The name of the machine is the name
-- of the file without the extension.
builtIn :: [(MachineName, (Text, Machine))]
builtIn =
  [ (name, machineIn name bytes)
    | (file, bytes) <- sortOn fst Embedded.files,
      Just n <- [Text.stripSuffix ".machine" (Text.pack file)],
      let name = MachineName n
  ]

-- | Text of a description and the machine that it describes, from the name of the machine and the
-- bytes of the file. A mistake in a built-in description is a bug of this program, and ends it.
machineIn :: MachineName -> ByteString -> (Text, Machine)
machineIn (MachineName name) bytes = (content, machine)
  where
    content = fromRight (Crash.bug (name <> ".machine is not UTF-8")) (Encoding.decodeUtf8' bytes)
    machine = case Result.ifSound (FromText.read content) of
      Just m -> m
      Nothing -> Crash.bug (name <> ".machine does not read")
