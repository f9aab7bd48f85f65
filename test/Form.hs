-- | The rules on the form of the code, as data and as a check: widths, lengths, first words of
-- comments, tuning pragmas, names of types, and the data of a stage. The exceptions are here with
-- their reasons.
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

import Data.Char (isLetter, isUpper)
import Data.List (nub)
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
  | -- | a comment that begins with a word such as /What/: the number of its line, and the word
    VagueComment Int Text
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

-- | Modules that may have tuning pragmas, by the beginning of their names, and the reason. Faster
-- twins may have them too.
tunedModules :: [(Text, Text)]
tunedModules =
  [ ("Offset.", "the offset kernel, per segment"),
    ("Geometry.", "arithmetic, per segment"),
    ("Frame.Arc.", "the search for centres in whole pulses, per candidate: 0.7 % slower without"),
    ("Frame.Rounding", "the ends of chords, per chord: 2.8 % slower without"),
    ("Tape.FrameReader", "reading, per word"),
    ("Tape.FrameWriter", "writing, per row"),
    ("Tape.Layout", "the digits of a number, per word"),
    ("Tape.NumberReader", "reading, per row"),
    ("Tape.Punch", "writing, per row"),
    ("Tape.Symbol", "the digit of a row"),
    ("Pulse.DifferentialAnalyser", "a cycle on a line, per pulse"),
    ("Pulse.FeedIntegrator", "the tick of a cycle, per pulse"),
    ("Pulse.IntegratorRun", "the cycles between arrivals, per pulse: 40 % slower without"),
    ("Pulse.Interpolator", "a cycle, per pulse"),
    ("Surface.Combinator", "the parser, per token"),
    ("Base.", "flat arrays and positions")
  ]

-- | True of a module that may have a tuning pragma.
mayBeTuned :: Text -> Bool
mayBeTuned name =
  ".Fast" `Text.isSuffixOf` name
    || any ((`Text.isPrefixOf` name) . fst) tunedModules

-- The check -----------------------------------------------------------------------------------

-- | The violations in one file.
problems :: Exceptions -> Source -> [Problem]
problems excepted (Source path text) =
  [WideLine n w | (n, l) <- zip [1 ..] rows, let w = Text.length l, w > widestLine]
    <> [LongModule count | let count = length rows, count > longestModule]
    <> [VagueComment n word | (n, word) <- commentStarts rows, word `elem` vagueStarts]
    <> concatMap ofDefinition own
    <> [Tuned pragma | isLibrary, not (mayBeTuned name), pragma <- tuningPragmas rows]
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

-- | First words of all comments, with the numbers of their lines.
commentStarts :: [Text] -> [(Int, Text)]
commentStarts rows =
  [ (n, Text.takeWhile isLetter (Text.dropWhile (`elem` ("-|^ " :: String)) row))
    | (n, before, row) <- zip3 [1 ..] ("" : stripped) stripped,
      isComment row,
      not (isComment before) || "-- |" `Text.isPrefixOf` row || before == "--"
  ]
  where
    stripped = map Text.strip rows
    isComment = Text.isPrefixOf "--"

-- | Words with which no comment begins, as docs/glossary.md says.
vagueStarts :: [Text]
vagueStarts = ["What", "Whether", "How", "Where", "Of"]

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
            t <- nub (exportedTypes (tokenise text)),
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
  VagueComment n word -> "line " <> number n <> " begins a comment with ‘" <> word <> "’"
  Tuned pragma -> "may not have the tuning pragma " <> pragma
  NeedlessException d -> d <> " is an exception in test/Form.hs without need"
  where
    number = Text.pack . show
    limit n = ", at most " <> number n

-- The exceptions ------------------------------------------------------------------------------

-- | The exceptions of this project. Every one has a reason.
exceptions :: Exceptions
exceptions = Exceptions {long = longFunctions, wide = manyParameters, shared = sharedNames}

-- | Long definitions by reason.
longFunctions :: Map Text Text
longFunctions =
  Map.fromList $
    because
      "a table with one arm or entry per constructor"
      [ "Checked.Builtin.forms",
        "Checked.Builtin.name",
        "Checked.Error.toReport",
        "Checked.ErrorFix.conversions",
        "Checked.PieceError.toReport",
        "Cli.Error.toReport",
        "Cli.Options.commands",
        "Frame.Error.toReport",
        "Frame.Error.warningReport",
        "Gcode.FaultReport.wordsOf",
        "Machine.DecodingError.toReport",
        "Machine.Error.frameReport",
        "Machine.Error.holeReport",
        "Machine.Error.toReport",
        "Part.ConstructionError.toReport",
        "Part.ContourError.toReport",
        "Part.CurveError.toReport",
        "Part.DescentError.toReport",
        "Part.Error.notWholeReport",
        "Part.Parameter.name",
        "Toolpath.DescentReport.toReport",
        "Part.Error.factReport",
        "Part.LinkError.faultReport",
        "Part.PocketError.toReport",
        "Project.Error.reportWith",
        "Sheet.Error.toReport",
        "Sheet.Unsupported.toReport",
        "Surface.DrawingError.toReport",
        "Surface.Error.toReport",
        "Surface.Grammar.statementForms",
        "Surface.StatementForm.statementForms",
        "Tape.Damage.reasonText",
        "Toolpath.Error.toReport",
        "Toolpath.WarningReport.warningReport",
        "Verify.Proof.toReport"
      ]
      <> because
        "a table of words"
        [ "Checked.NameMeaning.meanings",
          "Drawing.CodePageTable.rows",
          "Query.Manual.settings",
          "Query.Manual.statements",
          "Surface.WordMeaning.meanings",
          "Surface.WordMeaning.statementMeant"
        ]
      <> because
        "one arm per constructor; the longer arms are functions of their own"
        [ "Checked.Expression.inferred",
          "Checked.FromSurface.statement",
          "Checked.Settings.setting",
          "Checked.RequiredSetting.requirement",
          "Part.Expression.evaluate",
          "Part.FromChecked.step",
          "Query.Symbol.symbol",
          "Surface.PrintProgram.statement",
          "Surface.SyntaxWalk.ofStatement",
          "Surface.Unlocated.statement",
          "Verify.RequiredMove.itemsOfBlock"
        ]
      <> because
        "one inner loop: its parts would take more than ten unboxed numbers each"
        [ "Offset.RawOffset.offsetPolyarc",
          "Offset.SegmentIntersection.arcs",
          "Offset.SegmentIntersection.lineArc"
        ]
      <> because
        "GHC 9.0.2 panics at -O2 in the callers of the parts into which it would be split"
        ["Geometry.ArcFitting.LongestBiarc.along"]

-- | Definitions with many parameters.
manyParameters :: Map Text Text
manyParameters =
  Map.fromList $
    because
      "unboxed numbers in an inner loop; a record of them would be allocated for every segment"
      [ "Geometry.ArcFitting.CubicFit.advance",
        "Geometry.ArcFitting.CubicFit.biarcDistances",
        "Geometry.ArcFitting.PolyarcFit.advance",
        "Geometry.ArcFitting.PolyarcFit.biarcDistances",
        "Geometry.ArcFitting.PolyarcFit.isTooFar",
        "Geometry.Index.SegmentBoxTree.around",
        "Geometry.Index.SegmentBoxTree.putBox",
        "Geometry.Index.SegmentBoxTree.runBox",
        "Geometry.Segment.Fast.bearing",
        "Offset.RawOffset.offsetPolyarc",
        "Offset.RawOffset.raw"
      ]

-- | The same reason for several definitions.
because :: Text -> [Text] -> [(Text, Text)]
because reason names = [(name, reason) | name <- names]

-- | Groups of exported types that share a name.
sharedNames :: [(Text, [Text], Text)]
sharedNames =
  inGroup
    "errors and warnings of a stage"
    [ ( "Error",
        [ "Checked.Error",
          "Cli.Error",
          "Drawing.Error",
          "Frame.Error",
          "Machine.Error",
          "Part.Error",
          "Project.Error",
          "Sheet.Error",
          "Surface.Error",
          "Toolpath.Error"
        ]
      ),
      ("Warning", ["Cli.Error", "Frame.Error", "Toolpath.WarningReport"])
    ]
    <> inGroup
      "the syntax of the two languages, part programs and machine descriptions"
      [ ("Argument", ["Checked.Syntax", "Machine.Syntax", "Part.Value", "Surface.Syntax"]),
        ("Operator", ["Machine.Syntax", "Surface.Syntax"]),
        ("Statement", ["Checked.Syntax", "Machine.Syntax", "Surface.Syntax"]),
        ("Token", ["Machine.Lexer", "Surface.Token"]),
        ("Token_", ["Machine.Lexer", "Surface.Token"])
      ]
    <> inGroup
      "drawings of other programs, which have no stage in common with the other type"
      [ ("Shape", ["Draw.Scene", "Drawing.Drawing"])
      ]
    <> inGroup
      "one concept at stages that follow one another"
      [ ("Accuracy", ["Checked.Syntax", "Part.Part", "Surface.Syntax"]),
        ("BodySize", ["Checked.Syntax", "Surface.Syntax"]),
        ("BodySize_", ["Checked.Syntax", "Surface.Syntax"]),
        ("Cipher", ["Checked.Syntax", "Surface.Syntax"]),
        ("Cipher_", ["Checked.Syntax", "Surface.Syntax"]),
        ("Corners", ["Offset.RawOffset", "Surface.Syntax"]),
        ("Cutter", ["Checked.Syntax", "Part.Cutter", "Surface.Syntax"]),
        ("Descent", ["Draw.Descent", "Part.Part"]),
        ("Slope", ["Toolpath.Descent", "Verify.Descent"]),
        ("TabPlaces", ["Checked.Syntax", "Part.Part", "Surface.Syntax"]),
        ("Tabs", ["Checked.Syntax", "Part.Part"]),
        ("Cutter_", ["Checked.Syntax", "Surface.Syntax"]),
        ("Expr", ["Checked.Syntax", "Surface.Syntax"]),
        ("Expr_", ["Checked.Syntax", "Surface.Syntax"]),
        ("Item", ["Checked.Syntax", "Surface.Syntax"]),
        ("Item_", ["Checked.Syntax", "Surface.Syntax"]),
        ("Joggle", ["Checked.Syntax", "Geometry.Curve.ShiftDistance", "Surface.Syntax"]),
        ("Joggle_", ["Checked.Syntax", "Surface.Syntax"]),
        ("Link", ["Checked.Syntax", "Part.Link", "Sheet.Sheet", "Surface.Syntax"]),
        ("Link_", ["Checked.Syntax", "Surface.Syntax"]),
        ("Modifier", ["Checked.Syntax", "Surface.Syntax"]),
        ("Modifier_", ["Checked.Syntax", "Surface.Syntax"]),
        ("Pace", ["Checked.Syntax", "Part.Part", "Surface.Syntax"]),
        ("Program", ["Checked.Syntax", "Surface.Syntax"]),
        ("Region", ["Base.Region"]),
        ("Sense", ["Geometry.Carrier", "Surface.Syntax"]),
        ("Side", ["Geometry.Carrier", "Sheet.Sheet", "Surface.Syntax"]),
        ("Spin", ["Checked.Syntax", "Surface.Syntax"]),
        ("Statement_", ["Checked.Syntax", "Surface.Syntax"]),
        ("Stop", ["Checked.Syntax", "Part.Part", "Surface.Syntax"])
      ]
  where
    inGroup reason groups = [(name, modules, reason) | (name, modules) <- groups]
