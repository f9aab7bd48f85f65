-- | The machines that a project can use: built in, or described in files of its own.
--
-- The description files are loaded first, by whoever may read files; the look-up itself is pure.
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

-- | Description files by the names that the program or the command line gives them: each with its
-- text, or with the reason why it cannot be read.
type Descriptions = [(Text, Either Text Text)]

-- | Loads a description file whose name is relative to a folder.
load ::
  Monad m =>
  (FilePath -> m (Either Text Text)) ->
  FilePath ->
  Text ->
  m (Text, Either Text Text)
load contents folder file = (file,) <$> contents (folder </> Text.unpack file)

-- | Is this the name of a description file rather than of a built-in machine?
isFileName :: Text -> Bool
isFileName name = Text.any (== '/') name || Text.isSuffixOf ".machine" name

-- | The reason why a machine cannot be used.
data Missing
  = -- | no built-in machine has this name
    NoSuchMachine
  | -- | the description cannot be read, and why
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

-- | Finds a machine by the name of its description file, and reads the description.
findDescribed :: Descriptions -> Text -> Either Missing Machine
findDescribed descriptions file = case lookup file descriptions of
  Nothing -> Left (NoDescription "it was not looked for")
  Just (Left why) -> Left (NoDescription why)
  Just (Right text) -> case mapErrors id Machine.toReport (Machine.read text) of
    Result {errors = [], output = Just machine} -> Right machine
    Result {errors} -> Left (BadDescription text errors)
