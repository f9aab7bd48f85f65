-- | The texts that an editor inserts for statements and settings. They contain the marks of
-- snippets of the Language Server Protocol: @${1:6}@ is a part to fill in, @$0@ is the position of
-- the cursor at the end.
module Query.Snippet
  ( statements,
    setting,
    cutters,
    onceOnly,
    inUnit,
    plain,
  )
where

import Base.Quantity (LengthUnit (..))
import Data.Char (isDigit)
import Data.Foldable (foldl')
import Data.Text (Text)
import Data.Text qualified as Text

-- | The statements, in the order of a usual program: each by its keyword, with its text.
statements :: [(Text, Text)]
statements =
  [ ("part", "part ${1:name} \"${2:title}\""),
    ("units", "units ${1:in}"),
    ("machine", "machine ${1:lkp-01f}"),
    ("tool", "tool mill(diameter ${1:6 mm})"),
    ("feed", "feed ${1:60 mm/min}"),
    ("tolerance", "tolerance ${1:0.02 mm}"),
    ("clearance", "clearance ${1:3 mm}"),
    ("from", "from (${1:0}, ${2:0})"),
    ("work", "work ${1:54}"),
    ("program", "program ${1:1}"),
    ("safe", "safe ${1:40 mm}"),
    ("stock", "stock ${1:region} from ${2:-20 mm} to ${3:0 mm}"),
    ("avoid", "avoid ${1:region} from ${2:0 mm} to ${3:12 mm}"),
    ("let", "let ${1:name} = $0"),
    ("param", "param ${1:name} = $0"),
    ("contour", "contour ${1:name} closed {\n  $0\n}")
  ]
    <> cuttingStatements
    <> [ ("rapid", "rapid (${1:0}, ${2:0})"),
         ("move", "move (${1:0}, ${2:0})"),
         ("change", "change ${1:2} drill(diameter ${2:5 mm})"),
         ("spindle", "spindle ${1:cw}"),
         ("coolant", "coolant ${1:on}"),
         ("aux", "aux ${1:1}"),
         ("stop", "stop"),
         ("optional", "optional stop"),
         ("dwell", "dwell ${1:2} s"),
         ("for", "for ${1:p} in ${2:list} {\n  $0\n}"),
         ("if", "if ${1:condition} {\n  $0\n}"),
         ("with", "with ${1:rotated(90 deg)} {\n  $0\n}"),
         ("table", "table ${1:name} {\n  x y\n  $0\n}"),
         ("curve", "curve ${1:name} = spline(${2:table})"),
         ("piece", "piece ${1:name} = ${2:curve} cipher 2(${3:1 mm}) ${4:left}"),
         ("import", "import \"${1:file.part}\""),
         ("assert", "assert $0")
       ]

-- | The statements that cut, as in 'statements'.
cuttingStatements :: [(Text, Text)]
cuttingStatements =
  [ ("mill", "mill ${1:contour} ${2:outside} {\n  approach (${3:0}, ${4:0})\n  $0\n}"),
    ("pocket", "pocket ${1:contour} step ${2:3 mm} {\n  approach (${3:0}, ${4:0})\n  $0\n}"),
    ("face", "face ${1:blank} step ${2:20 mm} {\n  depth ${3:0 mm}\n  $0\n}"),
    ( "engrave",
      "engrave \"${1:text}\" at (${2:0}, ${3:0}) height ${4:5 mm} {\n  depth ${5:0.3 mm}\n  $0\n}"
    ),
    ("vcarve", "vcarve ${1:region} {\n  depth ${2:2 mm}\n  $0\n}"),
    ("rest", "rest of ${1:rough} step ${2:1 mm} {\n  depth ${3:5 mm}\n  $0\n}"),
    ("drill", "drill at ${1:points} depth ${2:5 mm}"),
    ("turn", "turn ${1:contour} ${2:outside} {\n  approach (${3:0}, ${4:0})\n  $0\n}")
  ]
    <> holes

-- | The works on holes, each by its keyword, with its text.
holes :: [(Text, Text)]
holes =
  [ ("spot", "spot at ${1:points} depth ${2:1 mm}"),
    ("ream", "ream at ${1:points} depth ${2:10 mm}"),
    ("countersink", "countersink at ${1:points} angle ${2:90 deg} diameter ${3:10 mm}"),
    ("counterbore", "counterbore at ${1:points} diameter ${2:11 mm} depth ${3:6 mm}"),
    ("bore", "bore at ${1:points} diameter ${2:20 mm} depth ${3:10 mm} pitch ${4:1 mm}"),
    ("tap", "tap at ${1:points} pitch ${2:1 mm} depth ${3:10 mm}"),
    ( "thread",
      "thread at ${1:points} diameter ${2:6 mm} pitch ${3:1 mm} depth ${4:10 mm} ${5:inside}"
    )
  ]

-- | The text of a setting that begins with these one or two words.
setting :: Text -> Text
setting words' = case words' of
  "approach" -> "approach (${1:0}, ${2:0})"
  "retract" -> "retract (${1:0}, ${2:0})"
  "depth" -> "depth ${1:5 mm}"
  "lead in" -> "lead in arc ${1:5 mm}"
  "lead out" -> "lead out arc ${1:5 mm}"
  "allowance" -> "allowance ${1:0.3 mm}, ${2:0 mm}"
  "corners" -> "corners ${1:sharp}"
  "compensation" -> "compensation ${1:controller}"
  "start near" -> "start near (${1:0}, ${2:0})"
  "plunge" -> "plunge ${1:20 mm/min}"
  "ramp" -> "ramp ${1:3 deg}"
  "helix" -> "helix pitch ${1:1 mm}"
  "tabs" -> "tabs ${1:4} width ${2:6 mm} height ${3:2 mm}"
  "tab at" -> "tab at (${1:0}, ${2:0}) width ${3:6 mm} height ${4:2 mm}"
  "peck" -> "peck ${1:3 mm}"
  "chip break" -> "chip break ${1:0.3 mm}"
  "dwell" -> "dwell ${1:0.5} s"
  "pitch" -> "pitch ${1:0.5 mm}"
  "hand" -> "hand ${1:left}"
  "islands" -> "islands ${1:contour}"
  "rest" -> "rest allowed"
  "angle" -> "angle ${1:45 deg}"
  _ -> words'

-- | The cutters, each by its keyword, with its text.
cutters :: [(Text, Text)]
cutters =
  [ ("mill", "mill(diameter ${1:6 mm})"),
    ("drill", "drill(diameter ${1:5 mm})"),
    ("tap", "tap(diameter ${1:6 mm})"),
    ("threadmill", "threadmill(diameter ${1:6 mm}, pitch ${2:1 mm})"),
    ("turn", "turn(nose ${1:0.4 mm})"),
    ("cone", "cone(diameter ${1:6 mm}, bevel ${2:5 deg}, height ${3:3 mm})"),
    ("vbit", "vbit(angle ${1:60 deg}, tip ${2:0.1 mm}, diameter ${3:6 mm})"),
    ("blade", "blade(diameter ${1:40 mm}, gear ${2:20 mm})")
  ]

-- | The keywords of the statements that a program has at most once.
onceOnly :: [Text]
onceOnly =
  ["part", "units", "machine", "tool", "tolerance", "from", "work", "program", "safe", "stock"]

-- | The snippet for a program with this unit of lengths: sizes and feeds that are usual in it.
inUnit :: LengthUnit -> Text -> Text
inUnit unit snippet = case unit of
  Millimetres -> snippet
  Inches -> foldl' exchanged snippet inchSizes
  where
    exchanged text (metric, inch) = Text.replace (":" <> metric <> "}") (":" <> inch <> "}") text

-- | The sizes and feeds of the snippets, each with a usual one in inches.
inchSizes :: [(Text, Text)]
inchSizes =
  [ ("0 mm", "0 in"),
    ("0.02 mm", "0.001 in"),
    ("0.1 mm", "0.005 in"),
    ("0.3 mm", "0.01 in"),
    ("0.4 mm", "0.016 in"),
    ("1 mm", "0.04 in"),
    ("2 mm", "0.08 in"),
    ("3 mm", "0.1 in"),
    ("5 mm", "0.2 in"),
    ("6 mm", "0.25 in"),
    ("10 mm", "0.4 in"),
    ("11 mm", "0.45 in"),
    ("12 mm", "0.5 in"),
    ("20 mm", "0.8 in"),
    ("-20 mm", "-0.8 in"),
    ("40 mm", "1.5 in"),
    ("20 mm/min", "1 in/min"),
    ("60 mm/min", "10 in/min")
  ]

-- | The text of a snippet without its marks, for a client that does not know them.
plain :: Text -> Text
plain snippet = case Text.breakOn "$" snippet of
  (before, rest)
    | Text.null rest -> before
    | "${" `Text.isPrefixOf` rest ->
      let (inner, after) = Text.breakOn "}" (Text.drop 2 rest)
       in before <> Text.drop 1 (Text.dropWhile (/= ':') inner) <> plain (Text.drop 1 after)
    | otherwise -> before <> plain (Text.dropWhile isDigit (Text.drop 1 rest))
