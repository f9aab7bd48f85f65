-- | The command @fmt@: programs in the canonical layout.
module Cli.Formatter
  ( fmt,
  )
where

import Base.Region qualified as Region
import Base.Result (Result (..))
import Cli.Error (Error (..))
import Cli.Error qualified as Cli
import Cli.Output (Exit (..), Reporter)
import Cli.Output qualified as Output
import Compile qualified
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Report.Report (Report)
import Surface.Error qualified as Surface
import Surface.Formatter qualified as Formatter
import Surface.Parser qualified as Parser
import Surface.Syntax (Program)

-- | Lay out one program in its place, from standard input to standard output. When only asked,
-- write nothing but the name of a program that is not laid out.
fmt :: Reporter -> Bool -> FilePath -> IO Exit
fmt reporter onlyAsked file
  | Compile.isSheet file = complain reporter (Text.pack file) SheetLaidOut
  | otherwise = layOut reporter onlyAsked file

layOut :: Reporter -> Bool -> FilePath -> IO Exit
layOut reporter onlyAsked file = do
  bytes <- Output.readBytes file
  case fmap Encoding.decodeUtf8' bytes of
    Left why -> complain reporter name (CannotRead why)
    Right (Left _) -> complain reporter name NotUtf8
    Right (Right text) -> case Formatter.format text of
      Nothing -> Failed <$ mistakes reporter name text
      Just new
        | onlyAsked -> if new == text then pure Done else Failed <$ printed reporter (name <> "\n")
        | file == "-" -> printed reporter new
        | new == text -> pure Done
        | otherwise ->
          Output.writeFileWhole file (Encoding.encodeUtf8 new) >>= delivered reporter name
  where
    name = if file == "-" then "<stdin>" else Text.pack file

-- | Report what is wrong with the form of a program.
mistakes :: Reporter -> Text -> Text -> IO Bool
mistakes reporter name text =
  Output.show' reporter name (Region.fromText name plain) (map Surface.toReport (errors parsed))
  where
    -- A mark of the byte order is not part of the text.
    plain = Text.dropWhile (== '\xFEFF') (Text.take 1 text) <> Text.drop 1 text
    parsed = Parser.parse 0 plain :: Result Report Surface.Error Program

printed :: Reporter -> Text -> IO Exit
printed reporter text = Output.result text >>= delivered reporter "to standard output"

delivered :: Reporter -> Text -> Either Text () -> IO Exit
delivered reporter place written = case written of
  Left why -> complain reporter "" (CannotWrite place why)
  Right () -> pure Done

-- | A mistake that belongs to a file as a whole.
complain :: Reporter -> Text -> Error -> IO Exit
complain reporter name e =
  Failed <$ Output.show' reporter name (Region.fromText name "") [Cli.toReport e]
