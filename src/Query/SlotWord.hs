-- | The words of the grammar that say what comes after them: keywords of statements and settings,
-- and the words inside them.
module Query.SlotWord
  ( Slot (..),
    GrammarWord (..),
    statement,
    setting,
    item,
    element,
    afterElement,
    cutterWords,
    cipherTypes,
  )
where

import Checked.Type (Type (..))
import Checked.Type qualified as Type
import Data.Text (Text)
import Surface.HoleForm qualified as HoleForm
import Surface.Syntax (HoleWork (..))

-- | A kind of text that may come at the cursor.
data Slot
  = -- | a statement; the keywords of the statements of this block so far
    AtStatement [Text]
  | -- | a setting of the statement with this keyword; the first words of the settings so far
    AtSetting Text [Text]
  | AtWord [GrammarWord]
  | -- | a value of one of these types, of any type if there are none; true if it is a factor or a
    -- divisor
    AtValue [Type] Bool
  | -- | a column of a table, each with the type of its cells
    AtColumn [(Text, Type)]
  | -- | a point that chooses one of several answers
    AtChoice
  | AtUnit
  | AtMachine
  | AtCutter
  deriving stock (Eq, Show)

-- | A word of the grammar, and the text that is inserted for it. This text may contain the marks of
-- snippets, such as @${1:6}@.
data GrammarWord = GrammarWord {word :: Text, text :: Text}
  deriving stock (Eq, Show)

-- | The slots directly after a word of a statement, and those after its operand. 'Nothing' if the
-- word has no such meaning in the statement with this keyword.
statement :: Text -> Text -> Maybe ([Slot], [Slot])
statement keyword w = lookup w (entries keyword)

entries :: Text -> [(Text, ([Slot], [Slot]))]
entries keyword = case keyword of
  "units" -> own [AtWord [GrammarWord w w | w <- ["in", "mm"]]] []
  "machine" -> own [AtMachine] []
  "tool" -> own [AtCutter] [AtCutter] <> [(k, ([], [])) | k <- cutterKinds]
  "feed" -> own (value Type.feed) []
  "tolerance" ->
    own (words' ["inside"] <> value Type.len) []
      <> [("inside", (value Type.len, words' ["outside"])), ("outside", (value Type.len, []))]
  "clearance" -> own (value Type.len) []
  "from" -> own stops []
  "work" -> own [AtWord [GrammarWord n n | n <- ["54", "55", "56", "57", "58", "59"]]] []
  "program" -> own (value Type.number) []
  "safe" -> own (value Type.len) []
  "stock" -> body
  "avoid" -> body
  "let" -> [(keyword, ([], [])), ("=", (anything, []))]
  "param" -> [(keyword, ([], [])), ("=", (anything, []))]
  "curve" -> [(keyword, ([], [])), ("=", (value (Curve (Variable 0)), []))]
  "piece" -> pieceEntries
  "assert" -> own anything (words' ["within"]) <> [("within", (anything, []))]
  "mill" -> onContour (words' sides)
  "turn" -> onContour (words' sides)
  "drill" ->
    own (words' ["at"]) []
      <> [ ("at", (drilled, words' ["depth"])),
           ("depth", (value Type.len, []))
         ]
  "with" -> own (value Transformation) []
  "for" -> own [] (words' ["in"]) <> [("in", (repeated, []))]
  "if" -> own (value Boolean) [] <> [("else", (words' ["if"], []))]
  _ -> drawnEntries keyword
  where
    own follows after = [(keyword, (follows, after))]
    body =
      own (value Contour) (words' ["from"])
        <> [("from", (value Type.len, words' ["to"])), ("to", (value Type.len, []))]
    onContour after = own (value Contour) after <> [(s, ([], [])) | s <- sides]

-- | The entries of statements that may take something from a drawing, and those of
-- 'clearingEntries'.
drawnEntries :: Text -> [(Text, ([Slot], [Slot]))]
drawnEntries keyword = case keyword of
  "contour" -> named ["closed", "open", "from"] <> [("closed", ([], [])), ("open", ([], []))]
  "contours" ->
    [ (keyword, ([], words' ["from"])),
      ("from", ([], words' ("text" : chosen))),
      ("text", ([], words' ["at"]))
    ]
      <> filter ((`notElem` ["around", "inside", "outside"]) . fst) (letteringEntries ["direction"])
  "table" -> named ["from"]
  _ -> clearingEntries keyword
  where
    named after =
      [ (keyword, ([], words' after)),
        ("from", ([], words' chosen))
      ]
    chosen = ["layer", "id", "class", "unit", "within"]

-- | The entries of statements that clear pockets and surfaces, and those of 'commandEntries'.
clearingEntries :: Text -> [(Text, ([Slot], [Slot]))]
clearingEntries keyword = case keyword of
  "pocket" ->
    own (value Contour) (words' ["step"])
      <> [("step", (value Type.len, words' ["as"])), ("as", ([], []))]
  "face" -> own (value Contour) (words' ["step"]) <> [("step", (value Type.len, []))]
  "vcarve" -> own (value Contour) (words' ["as"]) <> [("as", ([], []))]
  "rest" ->
    own (words' ["of"]) []
      <> [("of", (value Clearing, words' ["step"])), ("step", (value Type.len, []))]
  "engrave" -> (keyword, ([], words' ["at"])) : letteringEntries ["direction", "around"]
  _ -> commandEntries keyword
  where
    own follows after = [(keyword, (follows, after))]

-- | The entries of the place of a text; @courses@ are the words for the lines on which it may
-- stand.
letteringEntries :: [Text] -> [(Text, ([Slot], [Slot]))]
letteringEntries courses =
  [ ("at", (value Type.aPoint, words' ["height"])),
    ("height", (value Type.len, words' (courses <> ["align"]))),
    ("direction", (value Type.angle, words' ["align"])),
    ("around", (value Circle, words' ["inside", "outside", "align"])),
    ("inside", ([], words' ["align"])),
    ("outside", ([], words' ["align"])),
    ("align", (words' ["left", "centre", "right"], []))
  ]

-- | The entries of a work on holes: its points, and each size after the one before it.
holeEntries :: HoleWork -> [(Text, ([Slot], [Slot]))]
holeEntries work =
  [ (HoleForm.word work, (words' ["at"], [])),
    ("at", (drilled, words' firsts))
  ]
    <> [ (word, (value (if word == "angle" then Type.angle else Type.len), words' after))
         | (word, after) <- followers
       ]
    <> [(side, ([], [])) | work == Threading, side <- ["inside", "outside"]]
  where
    forms = map (map HoleForm.sizeWord) (HoleForm.sizeForms work)
    firsts = concatMap (take 1) forms
    followers = concatMap (\ws -> zip ws (map pure (drop 1 ws) <> [final])) forms
    final = if work == Threading then ["inside", "outside"] else []

-- | The entries of moves and commands.
commandEntries :: Text -> [(Text, ([Slot], [Slot]))]
commandEntries keyword = case keyword of
  "rapid" -> own stops (words' ["feed"]) <> [("feed", (value Type.feed, []))]
  "move" -> own stops (words' ["feed", "rapid"]) <> [("feed", (value Type.feed, []))]
  "change" ->
    own (value Type.number) [AtCutter] <> [(k, ([], words' ["at"])) | k <- cutterKinds]
      <> [("at", (stops, []))]
  "spindle" ->
    own (words' ["cw", "ccw", "off", "manual"]) []
      <> [(sense, (value Type.spindleSpeed, words' ["limit"])) | sense <- ["cw", "ccw"]]
      <> [("limit", (value Type.spindleSpeed, []))]
  "coolant" -> own (words' ["on", "off"]) []
  "aux" -> own (value Type.number) []
  "optional" -> own (words' ["stop"]) []
  "dwell" -> own (value Type.number) (words' ["s"])
  _ -> maybe [] holeEntries (HoleForm.named keyword)
  where
    own follows after = [(keyword, (follows, after))]

cutterKinds :: [Text]
cutterKinds = ["mill", "drill", "tap", "threadmill", "turn", "cone", "vbit", "blade"]

pieceEntries :: [(Text, ([Slot], [Slot]))]
pieceEntries =
  [ ("piece", ([], [])),
    ("=", (value (Curve (Variable 0)), words' ["cipher", "left", "right"])),
    ("cipher", ([AtWord digits], words' ["left", "right"])),
    ("left", ([AtWord [GrammarWord "joggle" joggle]], [])),
    ("right", ([AtWord [GrammarWord "joggle" joggle]], [])),
    ("joggle", (words' ["from"], [])),
    ("from", (value Type.len, words' ["to"])),
    ("to", (value Type.len, words' ["depth"])),
    ("depth", (value Type.len, words' ["radius"])),
    ("radius", (value Type.len, words' ["joggle"]))
  ]
  where
    joggle = "joggle from ${1:x1} to ${2:x2} depth ${3:1 mm} radius ${4:5 mm}"
    digits =
      [ GrammarWord "1" "1(${1:start}, ${2:end})",
        GrammarWord "2" "2(${1:distance})",
        GrammarWord "4" "4(${1:bevel}, ${2:height})",
        GrammarWord "6" "6(${1:distance})"
      ]

-- | As 'statement', for the settings of machining statements.
setting :: Text -> Maybe ([Slot], [Slot])
setting w = case w of
  "approach" -> Just (stops, words' ["rapid", "feed"])
  "retract" -> Just (stops, words' ["rapid", "feed"])
  "feed" -> Just (value Type.feed, [])
  "depth" -> Just (value Type.len, words' ["step"])
  "step" -> Just (value Type.len, [])
  "lead" -> Just (words' ["in", "out"], [])
  "in" -> Just (words' ["line", "arc"], [])
  "out" -> Just (words' ["line", "arc"], [])
  "line" -> Just (value Type.len, [])
  "arc" -> Just (value Type.len, [])
  "allowance" -> Just (value Type.len, [])
  "corners" -> Just (words' ["round", "sharp"], [])
  "compensation" -> Just (words' ["compiler", "controller"], [])
  "start" -> Just (words' ["near"], [])
  "near" -> Just (AtChoice : value Type.aPoint, [])
  "plunge" -> Just (value Type.feed, [])
  "ramp" -> Just (value Type.angle, [])
  "helix" -> Just (words' ["pitch"], [])
  "pitch" -> Just (value Type.len, words' ["diameter"])
  "diameter" -> Just (value Type.len, [])
  "spiral" -> Just ([], [])
  "tabs" -> Just (value Type.number, words' ["width"])
  "tab" -> Just (words' ["at"], [])
  "at" -> Just (value Type.aPoint, words' ["width"])
  "width" -> Just (value Type.len, words' ["height"])
  "height" -> Just (value Type.len, words' ["angle"])
  "peck" -> Just (value Type.len, [])
  "chip" -> Just (words' ["break"], [])
  "break" -> Just (value Type.len, [])
  "dwell" -> Just (value Type.number, words' ["s"])
  "hand" -> Just (words' ["left", "right"], [])
  "islands" -> Just ([AtValue [Contour, ListOf Contour] False], [])
  "rest" -> Just (words' ["allowed"], [])
  "angle" -> Just (value Type.angle, [])
  _ -> Nothing

-- | As 'statement', for the items of a contour. The empty word is the beginning of an item.
item :: Text -> Maybe ([Slot], [Slot])
item w = case w of
  "" -> Just (element, next)
  "cw" -> Just (value Circle, next)
  "ccw" -> Just (value Circle, next)
  "feed" -> Just (value Type.feed, next)
  "slow" -> Just (next, next)
  "allowance" -> Just (value Type.len, next)
  "bevel" -> Just (value Type.angle, next)
  "meet" -> Just (words' ["near"] <> element, next)
  "near" -> Just (AtChoice : value Type.aPoint, element)
  "smooth" -> Just (element, next)
  "tangent" -> Just (element, next)
  "fillet" -> Just (value Type.len, element)
  "chamfer" -> Just (value Type.len, element)
  "for" -> Just ([], words' ["in"])
  "in" -> Just (repeated, [])
  "if" -> Just (value Boolean, [])
  "else" -> Just (words' ["if"], [])
  _ -> Nothing
  where
    next = afterElement <> element

-- | The slots at the beginning of an item of a contour.
element :: [Slot]
element =
  [ words1 ["cw", "ccw"],
    AtWord
      [ GrammarWord "for" "for ${1:a} in ${2:list} {\n  $0\n}",
        GrammarWord "if" "if ${1:condition} {\n  $0\n}"
      ],
    AtValue [Line, Type.aPoint, Curve (Variable 0), Contour] False
  ]

-- | The words that may come after an element of a contour.
afterElement :: [Slot]
afterElement =
  words' ["meet", "smooth", "tangent", "fillet", "chamfer", "feed", "slow", "allowance", "bevel"]

-- | The words in the parentheses of a cutter of this kind, in order.
cutterWords :: Text -> [Text]
cutterWords kind = case kind of
  "mill" -> ["diameter", "flutes", "stickout", "holder"]
  "drill" -> ["diameter", "angle", "flutes", "stickout", "holder"]
  "tap" -> ["diameter", "flutes", "stickout", "holder"]
  "threadmill" -> ["diameter", "pitch", "flutes", "stickout", "holder"]
  "turn" -> ["nose", "tip"]
  "cone" -> ["diameter", "bevel", "height"]
  "vbit" -> ["angle", "tip", "diameter"]
  "blade" -> ["diameter", "gear"]
  _ -> ["diameter"]

-- | The types of a value of a cipher: the digit of the cipher, and the index of the value from 0.
cipherTypes :: Text -> Int -> [Type]
cipherTypes digit index = case (digit, index) of
  ("1", 0) -> [Type.len]
  ("1", 1) -> [Type.len]
  ("1", 2) -> [Type.angle, Type.aPoint]
  ("1", 3) -> [Type.aPoint]
  ("1", 4) -> [Type.aPoint]
  ("2", 0) -> [Type.len]
  ("2", 1) -> [Type.angle]
  ("4", 0) -> [Type.angle]
  ("4", 1) -> [Type.len]
  ("4", 2) -> [Type.len]
  ("6", 0) -> [Type.len]
  ("6", 1) -> [Type.angle]
  _ -> []

sides :: [Text]
sides = ["outside", "inside", "left", "right", "on"]

-- | The slot of the places of holes.
drilled :: [Slot]
drilled = [AtValue [ListOf Type.aPoint, Type.aPoint, Table (Variable 0)] False]

-- | The slot of what a repetition goes through.
repeated :: [Slot]
repeated = [AtValue [ListOf (Variable 0), Table (Variable 0)] False]

value :: Type -> [Slot]
value t = [AtValue [t] False]

anything :: [Slot]
anything = [AtValue [] False]

-- | A stop: a point of the plane or with a height.
stops :: [Slot]
stops = [AtValue [Type.aPoint, SpacePoint] False]

words' :: [Text] -> [Slot]
words' ws = [words1 ws]

words1 :: [Text] -> Slot
words1 ws = AtWord [GrammarWord w (w <> if w `elem` final then "" else " ") | w <- ws]
  where
    final =
      ["open", "closed", "off", "on", "round", "sharp", "compiler", "controller", "allowed", "slow"]
        <> ["inside", "outside", "left", "right", "smooth", "tangent", "meet", "rapid"]
        <> ["manual", "stop", "s"]
