{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Examples of statements, settings and elements, for reports on those that cannot be parsed.
module Surface.StatementForm
  ( formHint,
    settingTitle,
    isItemStart,
    blockWord,
  )
where

import Data.List (find)
import Data.Maybe (listToMaybe, mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Report (quote)
import Surface.HoleForm qualified as HoleForm
import Surface.Keyword qualified as Keyword
import Surface.Token (Token (..), Token_ (..), describe)
import Surface.TokenContext (TokenContext (..))

-- | The hint that shows how the statement, the setting or the element around a wrong token is
-- written. Empty if it has no keyword.
--
-- @isStart@ tells if a setting or an element was to begin at the wrong token.
formHint :: Bool -> TokenContext -> [Text]
formHint isStart around = case reverse onLine of
  Word word : _
    | isInSettings, Just example <- listToMaybe nearestSetting -> [shown example]
    | Just example <- cutterForm -> [shown example]
    | not isInSettings, Just example <- lookup word statementForms -> [shown example]
  _
    | isInSettings ->
      [ "The settings of " <> quote keyword <> " are: "
          <> Text.intercalate ", " (Keyword.settingsOf keyword)
          <> "."
      ]
    | keyword == "contour" ->
      [ "Elements of a contour are written: line(a, b) fillet 3, or cw circle(a, 5) tangent, or a \
        \point (0, 0)"
      ]
    | Just example <- lookup keyword statementForms -> [shown example]
  _ -> []
  where
    keyword = blockWord around
    isInSettings = keyword `elem` settingBlocks && Symbol "{" `elem` map shape (before around)
    shown example = "It is written: " <> example
    onLine = if isStart && isLineStart around then [] else map shape (lineTokens around)
    lineWords = [w | Word w <- onLine]
    -- The words before the brace are those of the statement.
    nearestSetting =
      mapMaybe (`lookup` settingForms) [w | Word w <- takeWhile (/= Symbol "{") onLine]
    cutterForm =
      listToMaybe
        [ form
          | keyword `elem` ["tool", "change"],
            w <- lineWords,
            Just form <- [lookup w cutterForms]
        ]

-- | Examples of cutters by their kind.
cutterForms :: [(Text, Text)]
cutterForms =
  [ ( "mill",
      "mill(diameter 6 mm), or mill(diameter 6 mm, flutes 18 mm, stickout 30 mm, holder 40 mm)"
    ),
    ("drill", "drill(diameter 5 mm), or drill(diameter 5 mm, flutes 40 mm)"),
    ("tap", "tap(diameter 6 mm)"),
    ("threadmill", "threadmill(diameter 6 mm, pitch 1 mm)"),
    ("cone", "cone(diameter 20 mm, bevel 5 deg, height 30 mm)"),
    ("vbit", "vbit(angle 60 deg, tip 0.2 mm, diameter 6 mm)"),
    ("blade", "blade(diameter 20 mm, gear 70 mm)"),
    ("turn", "turn(nose 0.8 mm), or turn(nose 0.8 mm, tip 2)")
  ]

-- | The tokens before the wrong one on its line, the nearest first. If it begins a line, those of
-- the line before that begin no block.
lineTokens :: TokenContext -> [Token]
lineTokens around
  | isLineStart around, t : _ <- before around, shape t `elem` map Symbol ["{", "}"] = []
  | otherwise = case break newLine (before around) of
    (same, first : _) -> same <> [first]
    (same, []) -> same

settingBlocks :: [Text]
settingBlocks =
  ["mill", "pocket", "rest", "face", "engrave", "vcarve", "turn", "drill"] <> HoleForm.words'

-- | The keyword of the statement around a token; empty if there is none.
blockWord :: TokenContext -> Text
blockWord around = case shape <$> listToMaybe (reverse (before around)) of
  Just (Word word) -> word
  _ -> ""

-- | The title for a token that begins no setting in the braces of a statement, or that comes after
-- a complete setting. 'Nothing' if the expected words are not those of settings.
settingTitle :: Token_ -> [Text] -> TokenContext -> Maybe Text
settingTitle token expected around
  | isElement && isLineStart around = Just (describe token <> " begins no element of a contour")
  | isElement = Just ("the element is complete before " <> describe token)
  | not (any ((`elem` expected) . quote) ["plunge", "peck", "retract"]) = Nothing
  | isLineStart around = Just (describe token <> " is no setting of " <> quote (blockWord around))
  | Just word <- settingBefore =
    Just ("the setting " <> quote word <> " is complete before " <> describe token)
  | otherwise = Just (describe token <> " is no setting of " <> quote (blockWord around))
  where
    isElement = blockWord around == "contour" && quote "cw" `elem` expected
    settingBefore =
      find
        Keyword.beginsItem
        [word | Word word <- takeWhile (/= Symbol "{") (map shape (lineTokens around))]

-- | True if the expected words are those with which settings or elements begin.
isItemStart :: [Text] -> Bool
isItemStart expected = any ((`elem` expected) . quote) ["plunge", "peck", "cw", "clearance"]

-- | Examples of statements by their keyword.
statementForms :: [(Text, Text)]
statementForms =
  [ ("part", "part bracket \"Bracket 12 mm\""),
    ("units", "units in, or units mm"),
    ("machine", "machine iso6983"),
    ("import", "import \"ear.part\""),
    ("tool", "tool mill(diameter 12 mm)"),
    ("feed", "feed 60 mm/min"),
    ("tolerance", "tolerance 0.02 mm, or tolerance inside 0.01 outside 0.02"),
    ("clearance", "clearance 5 mm"),
    ("from", "from (0, 0)"),
    ("work", "work 54"),
    ("program", "program 1234"),
    ("safe", "safe 40 mm"),
    ("stock", "stock blank from -20 to 0"),
    ("avoid", "avoid clamp from 0 to 12"),
    ("let", "let a = 5 mm, or for a function let f(x) = 2 * x"),
    ("param", "param a = 5 mm"),
    ("contour", "contour edge closed { … }, or open instead of closed"),
    ( "contours",
      "contours parts from \"plate.dxf\" layer \"CUT\", \
      \or contours sign from \"sans.ttf\" text \"12\" at (10, 20) height 8"
    ),
    ( "table",
      "table points { … }, with a line of names such as x y, and below it a row for each point"
    ),
    ("curve", "curve c = spline(points)"),
    ("piece", "piece q = c cipher 2(1.5) left"),
    ("assert", "assert a < b, or assert a = b within 0.01"),
    ("mill", "mill edge outside { depth 10 step 5 }"),
    ("pocket", "pocket recess step 5 { depth 4 }"),
    ("rest", "rest of rough step 2 { depth 4 }"),
    ("face", "face blank step 20 { depth 0 step 1 }"),
    ("engrave", "engrave \"12\" at (10, 20) height 8 { depth 0.3 }"),
    ("vcarve", "vcarve letters { depth 2 }"),
    ("turn", "turn profile outside { allowance 1, 0 }"),
    ("drill", "drill at (10, 20) depth 15 { peck 5 }"),
    ("spot", "spot at (10, 20) depth 1, or spot at (10, 20) diameter 3"),
    ("ream", "ream at (10, 20) depth 15"),
    ("countersink", "countersink at (10, 20) angle 90 diameter 8"),
    ("counterbore", "counterbore at (10, 20) diameter 11 depth 6"),
    ("bore", "bore at (10, 20) diameter 20 depth 10 pitch 1"),
    ("tap", "tap at (10, 20) pitch 1 depth 12"),
    ("thread", "thread at (10, 20) diameter 6 pitch 1 depth 12 inside"),
    ("rapid", "rapid (0, 0)"),
    ("move", "move (0, 0) feed 30"),
    ("change", "change 2 drill(diameter 5 mm), or change 2 drill(diameter 5 mm) at (0, 0)"),
    ("spindle", "spindle cw 900 rpm, or spindle off, or spindle manual"),
    ("coolant", "coolant on, or coolant off"),
    ("aux", "aux 8"),
    ("stop", "stop"),
    ("optional", "optional stop"),
    ("dwell", "dwell 2 s"),
    ("for", "for i in 1..3 { … }"),
    ("if", "if a < b { … } else { … }"),
    ("with", "with moved((10, 0)) { … }")
  ]

-- | Examples of settings by their first word.
settingForms :: [(Text, Text)]
settingForms =
  [ ("approach", "approach (0, 0) rapid, (5, 5)"),
    ("retract", "retract (5, 5), (0, 0) rapid"),
    ("depth", "depth 10 step 5"),
    ("lead", "lead in line 10, or lead out arc 5"),
    ("allowance", "allowance 0.5, 0"),
    ("corners", "corners round, or corners sharp"),
    ("climb", "climb"),
    ("conventional", "conventional"),
    ("compensation", "compensation controller, or compensation compiler"),
    ("start", "start near (0, 0)"),
    ("plunge", "plunge 30"),
    ("ramp", "ramp 3 deg"),
    ("helix", "helix pitch 1"),
    ("spiral", "spiral"),
    ("tabs", "tabs 4 width 6 height 2"),
    ("tab", "tab at (0, 20) width 6 height 2"),
    ("peck", "peck 4"),
    ("shortest", "shortest"),
    ("chip", "chip break 0.3"),
    ("dwell", "dwell 0.5 s"),
    ("pitch", "pitch 0.5"),
    ("hand", "hand left, or hand right"),
    ("floating", "floating"),
    ("islands", "islands boss, rib"),
    ("rest", "rest allowed"),
    ("angle", "angle 45")
  ]
