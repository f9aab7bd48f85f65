-- | The usage errors of an option that a subcommand does not have, and of a parameter's value that
-- is not written as one word with its name.
module Cli.OptionError
  ( explained,
  )
where

import Base.Name qualified as Name
import Data.List (find, stripPrefix, tails)
import Data.Maybe (catMaybes, fromMaybe, listToMaybe, mapMaybe)
import Data.Text qualified as Text
import Options.Applicative (ParserInfo)
import Options.Applicative.Common qualified as Opt
import Options.Applicative.Types (OptName (..), OptReader (..))
import Options.Applicative.Types qualified as Opt

-- | An option of a subcommand: its short and long names with their dashes, and the word for its
-- value, which is empty for an option without one.
data OptionForm = OptionForm {names :: [String], value :: String}

-- | The lines that report a mistake in these arguments better than the library does. The second
-- argument is the text of the library. 'Nothing' if that text is to be shown.
explained :: ParserInfo a -> String -> [String] -> Maybe String
explained info failure arguments =
  listToMaybe (catMaybes [unknownOption info failure arguments, valueApart failure arguments])

-- | The lines that report the name of a parameter without its value.
valueApart :: String -> [String] -> Maybe String
valueApart failure arguments = do
  _ <- stripPrefix "option --set: " failure
  (name, following) <-
    listToMaybe
      [ (name, more)
        | "--set" : name : more <- tails arguments,
          '=' `notElem` name
      ]
  pure . unlines $
    [ "‘" <> name <> "’ has no value",
      "Write the name and the value as one word: --set "
        <> name
        <> "="
        <> fromMaybe "VALUE" (find isNumber following)
    ]
  where
    isNumber text = all (`elem` ("0123456789.-" :: String)) text && text /= ""

-- | The lines that report an option which the subcommand of these arguments does not have. The
-- second argument is the text in which the library reports the mistake. 'Nothing' for other
-- mistakes, and for an option that stands before the subcommand.
unknownOption :: ParserInfo a -> String -> [String] -> Maybe String
unknownOption info failure arguments = do
  typed <- takeWhile (/= '\'') <$> stripPrefix "Invalid option `" failure
  let subcommands = subcommandsOf info
      (before, rest) = break (`elem` map fst subcommands) arguments
  (command, behind) <- listToMaybe [(c, others) | typed `notElem` before, c : others <- [rest]]
  forms <- lookup command subcommands
  let (word, given) = break (== '=') typed
      following = drop 1 (dropWhile (/= typed) behind)
      argument = listToMaybe (filter (/= "") [drop 1 given] <> filter isValue (take 1 following))
  pure . unlines $
    ["partc " <> command <> " has no option " <> word]
      <> ["Write " <> written form argument <> "." | Just form <- [meant word forms]]
      <> ["‘partc " <> command <> " --help’ lists its options."]
  where
    isValue text = take 1 text /= "-"

-- | The option as it is written with a value. Without a value, the word for it stands there.
written :: OptionForm -> Maybe String -> String
written form argument
  | value form == "" = name
  | otherwise = name <> " " <> fromMaybe (value form) argument
  where
    name = head (names form)

-- | The option that the user may have meant: one with another word for the same thing, or one whose
-- name is nearly the same.
meant :: String -> [OptionForm] -> Maybe OptionForm
meant word forms = listToMaybe (mapMaybe withName (synonym <> near))
  where
    bare = dropWhile (== '-') word
    withName name = find (elem name . names) forms
    synonym = [known | (others, known) <- synonyms, bare `elem` others]
    near =
      map Text.unpack (Name.nearest (Text.pack word) (map Text.pack (concatMap names forms)))

-- | Words of other programs for an option, and the option.
synonyms :: [([String], String)]
synonyms =
  [ (["machine", "control", "controller", "post", "m"], "--target"),
    (["out", "outfile", "to"], "--output"),
    (["no-proof", "unproven", "skip-verify"], "--no-verify"),
    (["param", "parameter", "define", "D"], "--set"),
    (["silent", "no-warnings"], "--quiet")
  ]

-- | The names of the subcommands with their options.
subcommandsOf :: ParserInfo a -> [(String, [OptionForm])]
subcommandsOf info = concat (Opt.mapParser (const inside) (Opt.infoParser info))
  where
    inside :: Opt.Option x -> [(String, [OptionForm])]
    inside option = case Opt.optMain option of
      CmdReader _ words' parserOf ->
        [(w, optionsOf command) | w <- words', Just command <- [parserOf w]]
      _ -> []

-- | The options of a subcommand.
optionsOf :: ParserInfo a -> [OptionForm]
optionsOf info = concat (Opt.mapParser (const form) (Opt.infoParser info))
  where
    form :: Opt.Option x -> [OptionForm]
    form option = case Opt.optMain option of
      OptReader words' _ _ -> [OptionForm (map nameText words') (Opt.propMetaVar props)]
      FlagReader words' _ -> [OptionForm (map nameText words') ""]
      ArgReader _ -> []
      CmdReader {} -> []
      where
        props = Opt.optProps option

nameText :: OptName -> String
nameText name = case name of
  OptShort c -> ['-', c]
  OptLong text -> "--" <> text
