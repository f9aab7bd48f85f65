-- | The rules on the form of the code, as data and as a check: widths, lengths, tuning pragmas,
-- names of types, and the data of a stage. The exceptions stand here with their reasons.
module Form
  ( Source (..),
    moduleName,
    Problem (..),
    problems,
    sharedTypes,
    Exceptions (..),
    exceptions,
    sentence,
  )
where

import Data.Char (isUpper)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import HaskellSource
import System.FilePath (dropExtension, splitDirectories)

-- | A file as found: its path from the root of the project, and its text.
data Source = Source FilePath Text

-- | The name that a file's path gives to its module.
moduleName :: FilePath -> Text
moduleName path =
  Text.intercalate "." (map Text.pack (drop 1 (splitDirectories (dropExtension path))))

-- | One violation in one file.
data Problem
  = -- | the number of the line, and its width
    WideLine Int Int
  | -- | the number of lines of the module
    LongModule Int
  | -- | the name and the number of lines
    LongFunction Text Int
  | -- | the name and the number of parameters
    ManyParameters Text Int
  | -- | a tuning pragma outside of the modules that may have one
    Tuned Text
  | -- | an exception whose reason is gone
    NeedlessException Text
  deriving stock (Eq, Ord, Show)

-- | Definitions and modules to which a rule does not apply.
data Exceptions = Exceptions
  { -- | definitions by their qualified names, each with the reason for its length
    long :: Map Text Text,
    -- | definitions by their qualified names, each with the reason for its parameters
    wide :: Map Text Text,
    -- | groups of types that share a name, each with its modules and the reason
    shared :: [(Text, [Text], Text)]
  }

-- Limits --------------------------------------------------------------------------------------

-- | Columns of a line.
widestLine :: Int
widestLine = 100

-- | Lines of a module.
longestModule :: Int
longestModule = 600

-- | Lines of a definition, without comments, blank lines and the signature.
longestFunction :: Int
longestFunction = 40

-- | Parameters of a definition.
mostParameters :: Int
mostParameters = 6

-- | Modules that may be tuned: the faster twins, the offset kernel and what it works on, arc
-- fitting and the reading and writing of tapes, all of which work per segment or per row.
isTuned :: Text -> Bool
isTuned name =
  ".Fast" `Text.isSuffixOf` name || any (`Text.isPrefixOf` name) kernels
  where
    kernels =
      ["Offset.", "Geometry.Index.", "Geometry.ClosedPolyarcs", "Geometry.ArcFitting.", "Tape."]

-- The check -----------------------------------------------------------------------------------

-- | The violations in one file.
problems :: Exceptions -> Source -> [Problem]
problems excepted (Source path text) =
  [WideLine n w | (n, l) <- zip [1 ..] rows, let w = Text.length l, w > widestLine]
    <> [LongModule count | let count = length rows, count > longestModule]
    <> concatMap ofDefinition own
    <> [Tuned pragma | isLibrary, not (isTuned name), pragma <- tuningPragmas rows]
    <> [NeedlessException d | isLibrary, d <- needless]
  where
    rows = Text.lines text
    name = moduleName path
    isLibrary = take 1 (splitDirectories path) == ["src"]
    own = if isLibrary then definitions text else []
    qualified d = name <> "." <> HaskellSource.name d
    ofDefinition d =
      [LongFunction (qualified d) (extent d) | isLong d, qualified d `Map.notMember` long excepted]
        <> [ ManyParameters (qualified d) (parameters d)
             | isWide d,
               qualified d `Map.notMember` wide excepted
           ]
    isLong d = extent d > longestFunction
    isWide d = parameters d > mostParameters
    needless = unneeded (long excepted) isLong <> unneeded (wide excepted) isWide
    unneeded known keeps =
      [d | d <- Map.keys known, inThisModule d, d `notElem` map qualified (filter keeps own)]
    inThisModule d = Text.dropWhileEnd (/= '.') d == name <> "."

-- | The pragmas that tell the compiler how to optimise.
tuningPragmas :: [Text] -> [Text]
tuningPragmas rows = [pragma | row <- rows, pragma <- known, pragma `Text.isInfixOf` row]
  where
    known = ["-O2", "BangPatterns", "{-# INLINE", "{-# NOINLINE", "{-# SPECIAL", "MagicHash"]

-- | The exported types of one name that no group allows: the name and its modules.
sharedTypes :: Exceptions -> [Source] -> [(Text, [Text])]
sharedTypes excepted sources =
  [(t, ms) | (t, ms) <- Map.toList homes, length ms > 1, not (isAllowed t ms)]
  where
    homes =
      Map.fromListWith
        (flip (<>))
        [ (t, [moduleName path])
          | Source path text <- sources,
            t <- exportedTypes (tokenise text),
            Text.any isUpper (Text.take 1 t)
        ]
    isAllowed t ms = or [all (`elem` allowed) ms | (t', allowed, _) <- shared excepted, t == t']

-- | One line for a person.
sentence :: Problem -> Text
sentence problem = case problem of
  WideLine n w -> "line " <> number n <> " has " <> number w <> " columns" <> limit widestLine
  LongModule n -> "has " <> number n <> " lines" <> limit longestModule
  LongFunction d n -> d <> " has " <> number n <> " lines" <> limit longestFunction
  ManyParameters d n -> d <> " has " <> number n <> " parameters" <> limit mostParameters
  Tuned pragma -> "may not have the tuning pragma " <> pragma
  NeedlessException d -> d <> " is an exception in test/Form.hs without need"
  where
    number = Text.pack . show
    limit n = ", at most " <> number n

-- The exceptions ------------------------------------------------------------------------------

exceptions :: Exceptions
exceptions = Exceptions {long = Map.empty, wide = Map.empty, shared = []}
