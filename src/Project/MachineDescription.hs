-- | The machines for which a program can be compiled: the built-in machines, and machines that
-- users describe in files.
--
-- 'load' reads a description file, by a function that the caller supplies. The functions that find
-- a machine read no files. They search the built-in machines and the descriptions already loaded.
module Project.MachineDescription
  ( Descriptions,
    DescriptionText (..),
    placed,
    load,
    isFileName,
    isDescription,
    find,
    findBuiltIn,
    findDescribed,
    Missing (..),
  )
where

import Base.Region (Source)
import Base.Region qualified as Region
import Base.Result (Result (..), mapErrors)
import Data.List (mapAccumL)
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.BuiltIn qualified as BuiltIn
import Machine.Error qualified as Machine
import Machine.FromText qualified as Machine
import Machine.Machine (Machine, MachineName (..))
import Report.Report (Report)
import System.FilePath ((</>))

-- | The loaded description files as pairs. The first component is the name of the file, as in the
-- program or on the command line. The second one is the text of the file, or in 'Left' the reason
-- why it cannot be read.
type Descriptions = [(Text, Either Text DescriptionText)]

-- | The text of a machine description. If the program's source contains it, 'base' is the offset at
-- which it begins there.
data DescriptionText = DescriptionText {base :: Maybe Int, text :: Text}
  deriving stock (Eq, Show)

-- | Loads a description file. @contents@ reads a file, and @file@ is a name relative to @folder@.
-- The result is the name with the text, or in 'Left' with the reason why the file cannot be read.
load ::
  Monad m =>
  (FilePath -> m (Either Text Text)) ->
  FilePath ->
  Text ->
  m (Text, Either Text DescriptionText)
load contents folder file =
  (file,) . fmap (DescriptionText Nothing) <$> contents (folder </> Text.unpack file)

-- | Appends the texts of the descriptions that have errors to the source of the program that names
-- them, so that reports on the program can point at these errors. @paths@ has the paths of the
-- descriptions, in the same order.
placed :: Source -> [Text] -> Descriptions -> (Source, Descriptions)
placed source paths descriptions = mapAccumL place source (zip paths descriptions)
  where
    place s (path, (name, found)) = case found of
      Right d@DescriptionText {text}
        | Left (BadDescription _ _) <- findDescribed [(name, found)] name ->
          (Region.addFile path text s, (name, Right d {base = Just (Region.nextOffset s)}))
      _ -> (s, (name, found))

-- | True if the name means a description file, and not a built-in machine: it contains a slash or
-- ends in @.machine@.
isFileName :: Text -> Bool
isFileName name = Text.any (== '/') name || isDescription name

-- | True if the name of a file is that of a machine description: it ends in @.machine@.
isDescription :: Text -> Bool
isDescription = Text.isSuffixOf ".machine"

-- | The reason why a machine cannot be used.
data Missing
  = -- | no built-in machine has this name
    NoSuchMachine
  | -- | the description cannot be read: the reason
    NoDescription Text
  | -- | the description has errors: the description, and the errors
    BadDescription DescriptionText [Report]

-- | Finds a machine by the name of a built-in machine, or by the name of a loaded description file.
find :: Descriptions -> Text -> Either Missing Machine
find descriptions name
  | isFileName name = findDescribed descriptions name
  | otherwise = findBuiltIn name

-- | Finds a built-in machine by its name.
findBuiltIn :: Text -> Either Missing Machine
findBuiltIn name = maybe (Left NoSuchMachine) Right (BuiltIn.find (MachineName name))

-- | Finds a loaded description file by its name, and parses the machine that it describes.
findDescribed :: Descriptions -> Text -> Either Missing Machine
findDescribed descriptions file = case lookup file descriptions of
  Nothing -> Left (NoDescription "it was not looked for")
  Just (Left why) -> Left (NoDescription why)
  Just (Right d) -> case mapErrors id Machine.toReport (Machine.read (text d)) of
    Result {errors = [], output = Just machine} -> Right machine
    Result {errors} -> Left (BadDescription d errors)
