-- | The machines that a program can be compiled for: the built-in machines, and those described in
-- files of the user.
--
-- 'load' reads a description file with a function that its caller supplies. The functions that find
-- a machine are pure and search the loaded files.
module Project.MachineDescription
  ( Descriptions,
    load,
    isFileName,
    find,
    findBuiltIn,
    findDescribed,
    Missing (..),
  )
where

import Base.Result (Result (..), mapErrors)
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.BuiltIn qualified as BuiltIn
import Machine.Error qualified as Machine
import Machine.FromText qualified as Machine
import Machine.Machine (Machine, MachineName (..))
import Report.Report (Report)
import System.FilePath ((</>))

-- | Description files, by their names in the program or on the command line. Each has its text, or
-- the reason why it cannot be read.
type Descriptions = [(Text, Either Text Text)]

-- | Loads a description file, given a function that reads a file, a folder, and the file's name
-- relative to the folder. Yields the name with the text, or with the reason why it cannot be read.
load ::
  Monad m =>
  (FilePath -> m (Either Text Text)) ->
  FilePath ->
  Text ->
  m (Text, Either Text Text)
load contents folder file = (file,) <$> contents (folder </> Text.unpack file)

-- | Is this the name of a description file rather than of a built-in machine? Such a name contains
-- a slash or ends in @.machine@.
isFileName :: Text -> Bool
isFileName name = Text.any (== '/') name || Text.isSuffixOf ".machine" name

-- | The reason why a machine cannot be used.
data Missing
  = -- | no built-in machine has this name
    NoSuchMachine
  | -- | the description cannot be read, for this reason
    NoDescription Text
  | -- | the description has errors: its text, and the reports
    BadDescription Text [Report]

-- | Finds a machine by its name, or by the name of its description file.
find :: Descriptions -> Text -> Either Missing Machine
find descriptions name
  | isFileName name = findDescribed descriptions name
  | otherwise = findBuiltIn name

-- | Finds a built-in machine by its name.
findBuiltIn :: Text -> Either Missing Machine
findBuiltIn name = maybe (Left NoSuchMachine) Right (BuiltIn.find (MachineName name))

-- | Finds a description file by its name, and parses the machine that it describes.
findDescribed :: Descriptions -> Text -> Either Missing Machine
findDescribed descriptions file = case lookup file descriptions of
  Nothing -> Left (NoDescription "it was not looked for")
  Just (Left why) -> Left (NoDescription why)
  Just (Right text) -> case mapErrors id Machine.toReport (Machine.read text) of
    Result {errors = [], output = Just machine} -> Right machine
    Result {errors} -> Left (BadDescription text errors)
