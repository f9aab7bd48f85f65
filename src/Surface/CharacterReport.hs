{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | The words for characters that have no place in a program.
module Surface.CharacterReport
  ( strayTitle,
    strayHint,
    lookAlikeHint,
  )
where

import Base.Name qualified as Name
import Base.Region (Region (..))
import Data.Char (GeneralCategory (..), generalCategory, ord)
import Data.Text (Text)
import Data.Text qualified as Text
import Numeric (showHex)
import Report.Report (quote)
import Surface.CharacterFix qualified as CharacterFix
import Surface.TokenContext (TokenContext (..))

-- | Title of the report of a character that has no place in a program.
strayTitle :: Char -> TokenContext -> Text
strayTitle c around
  | c == '.',
    Just (owner, own) <- CharacterFix.qualified around =
    quote (owner <> "." <> own) <> " is no name: a name has no point"
  | generalCategory c `elem` [Format, Control] =
    "the invisible character U+" <> codePoint c <> " has no place in a program"
  | otherwise =
    "the character "
      <> quote (Text.singleton c)
      <> (if Text.null name then "" else ", " <> name <> ",")
      <> " has no place in a program"
  where
    name = CharacterFix.characterName c

-- | Number of a character in hexadecimal digits.
codePoint :: Char -> Text
codePoint c = Text.justifyRight 4 '0' (Text.toUpper (Text.pack (showHex (ord c) "")))

-- | Hint for a character that has no place in a program, beside its fixes.
strayHint :: Char -> TokenContext -> [Text]
strayHint c around
  | c `elem` ("“”„«»'" :: String) =
    [ "A text begins and ends with the straight mark \"."
      | null (CharacterFix.characterFixes (Region 0 0) c around)
    ]
  | c == '^',
    null (CharacterFix.characterFixes (Region 0 0) c around) =
    ["There are no powers: write x * x, and sqrt(x) for a root."]
  | c == '±' = ["A tolerance is a statement of its own: tolerance 0.02 mm"]
  | c == ';' && not (null (after around)) = ["If a comment begins here, write --."]
  | c == '.',
    Just (_, own) <- CharacterFix.qualified around =
    [ "The names of an imported file are used without the name of the file."
      | own `notElem` CharacterFix.properties
    ]
  | c == '.' = ["A number has digits before its point: 0.5, 5.0 or 5."]
  | otherwise = []

-- | Names the letters of the other alphabet in a word that looks like a known one.
lookAlikeHint :: Text -> [Text] -> [Text]
lookAlikeHint word known =
  [ "In " <> quote word <> " the letter " <> quote (Text.singleton a) <> " is " <> alphabet a <> "."
    | w <- take 1 (Name.lookAlike word known),
      (a, b) <- take 1 (filter (uncurry (/=)) (Text.zip word w)),
      a /= b
  ]
  where
    alphabet c = if c > '~' then "Cyrillic" else "Latin"
