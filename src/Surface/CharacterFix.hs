{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Fixes for characters that have no place in a program, and for numbers, units and texts that are
-- written in another way.
module Surface.CharacterFix
  ( characterName,
    characterFixes,
    signRegion,
    qualified,
    properties,
    powerFixes,
    numberFixes,
    unitMeant,
    textFixes,
  )
where

import Base.Region (Region (..))
import Data.Char (GeneralCategory (..), chr, generalCategory, isAlpha, isDigit, ord)
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Fix (Fix (..), FixEdit (..), FixText (..))
import Report.Fix qualified as Fix
import Report.Report (quote)
import Surface.Token (Numeral (..), Token (..), Token_ (..), unitName)
import Surface.TokenContext (TokenContext (..), following, previous)

-- Characters

-- | Name of a character that has no place in a program; empty for one that everybody can name.
characterName :: Char -> Text
characterName c
  | c `elem` ("−–—" :: String) = "a long minus sign"
  | c `elem` ("“”„«»‘’‚‹›" :: String) = "a curved quotation mark"
  | c `elem` ("⌀∅" :: String) = "the sign of a diameter"
  | c == '×' = "a sign of multiplication"
  | c == '·' = "a raised dot"
  | c == '÷' = "a sign of division"
  | c == '°' = "the sign of degrees"
  | c == ';' = "a semicolon"
  | isFullWidth c = "a wide form of " <> quote (Text.singleton (narrow c))
  | otherwise = ""

-- | Fixes for a character that has no place in a program.
characterFixes :: Region -> Char -> TokenContext -> [Fix]
characterFixes region c around
  | c `elem` ("−–—" :: String) = [put "Write the minus sign as -." "-"]
  | c `elem` ("×·" :: String) = [put "Write the product with *." "*"]
  | c == '÷' = [put "Write the quotient with /." "/"]
  | c == '≤' = [put "Write <= instead." "<="]
  | c == '≥' = [put "Write >= instead." ">="]
  | c == '≠' = [put "Write != instead." "!="]
  | c == ':' = [Fix.removal "Remove the colon." region]
  | c == '#' = [put "Begin the comment with --." "--"]
  | c == ';' && null (after around) = [Fix.removal "Remove the semicolon." region]
  | c == ';' = [put "Begin a new line instead." "\n"]
  | c == '°' = [put "Write degrees as deg." " deg"]
  | c == '&' = [Fix.exchange "Write ‘and’ instead." (signRegion region c around) " and "]
  | c == '|' = [Fix.exchange "Write ‘or’ instead." (signRegion region c around) " or "]
  | c == '!' = [put "Write ‘not’ instead." "not "]
  | c `elem` quotationMarks = quotationFixes region around
  | c `elem` ("⌀∅" :: String) = diameterFixes region around
  | c == '^' = powersFixes region around
  | c == '.', Just _ <- qualified around = qualifiedFixes around
  | c == '.' = pointFixes region around
  | isFullWidth c = [put ("Write " <> narrowed <> " instead.") narrowed]
  | generalCategory c `elem` [Format, Control] =
    [Fix.removal "Remove the invisible character." region]
  | otherwise = []
  where
    put title = Fix.exchange title region
    narrowed = Text.singleton (narrow c)

-- | The region of a character that has no place in a program, with the second character of the
-- signs @&&@ and @||@.
signRegion :: Region -> Char -> TokenContext -> Region
signRegion region c around = case following around of
  Just t
    | c `elem` ("&|" :: String) && shape t == Stray c && attached t ->
      Region (start region) (end (place t))
  _ -> region

quotationMarks :: String
quotationMarks = "“”„«»‘’‚‹›'"

isFullWidth :: Char -> Bool
isFullWidth c = c >= '\xFF01' && c <= '\xFF5E'

-- | The character of ASCII of which a character is the wide form.
narrow :: Char -> Char
narrow c = chr (ord c - 0xFEE0)

-- | Writes straight marks instead of all curved ones on the line.
quotationFixes :: Region -> TokenContext -> [Fix]
quotationFixes region around =
  [ Fix.joined
      "Write the quotation marks as \"."
      [Fix.exchange "" r "\"" | r <- region : others]
    | odd (length others)
  ]
  where
    others = [place t | t <- after around, Stray c <- [shape t], c `elem` quotationMarks]

-- | Fixes for the sign of a diameter before a number.
diameterFixes :: Region -> TokenContext -> [Fix]
diameterFixes region around = case (before around, following around) of
  (t : _, _) | shape t == Symbol "(", isCutter (before around) -> [put "diameter "]
  (_, Just t)
    | Number _ _ <- shape t ->
      [ Fix.joined
          "Write the radius: half the diameter."
          [Fix.removal "" region, Fix.insertion "" (end (place t)) " / 2"]
      ]
  _ -> []
  where
    put = Fix.exchange "Write diameter instead." region
    isCutter ts = case map shape ts of
      _ : Word kind : _ -> kind `elem` ["mill", "drill", "cone", "vbit", "blade"]
      _ -> False

-- | Writes all powers on the rest of a line as products.
powersFixes :: Region -> TokenContext -> [Fix]
powersFixes region around = case concat fixes' of
  [] -> []
  [one] -> [one]
  several -> [Fix.joined "Write the powers as products." several]
  where
    fixes' =
      powerFixes region around :
        [ powerFixes (place t) around {before = [base], after = [count]}
          | (base, t, count) <- zip3 (after around) (drop 1 (after around)) (drop 2 (after around)),
            shape t == Stray '^'
        ]

-- | Writes a power as a product.
powerFixes :: Region -> TokenContext -> [Fix]
powerFixes region around = case (previous around, following around) of
  (Just base, Just count)
    | Number (Numeral digits _) Nothing <- shape count,
      digits `elem` ["2", "3"],
      isSingle (shape base) ->
      [ Fix
          { title = "Write the power as a product.",
            isProposal = False,
            edits =
              [ FixEdit
                  (Region (start region) (end (place count)))
                  (concat (replicate (if digits == "2" then 1 else 2) (factor base)))
              ]
          }
      ]
  _ -> []
  where
    factor base = [Written " * ", Copied (place base)]
    isSingle token = case token of
      Word _ -> True
      Number _ _ -> True
      _ -> False

-- | Writes the 0 before a decimal point.
pointFixes :: Region -> TokenContext -> [Fix]
pointFixes region around = case following around of
  Just t
    | attached t,
      Number (Numeral digits _) _ <- shape t,
      not (Text.any (== '.') digits) ->
      [Fix.insertion "Write 0 before the decimal point." (start region) "0"]
  _ -> []

-- | The names before and after a wrong token between two names without spaces, as in @ear.eye@.
qualified :: TokenContext -> Maybe (Text, Text)
qualified around = case (map shape (before around), after around) of
  (Word owner : _, t : _) | Word own <- shape t, attached t -> Just (owner, own)
  _ -> Nothing

-- | Writes the names with a point, on the rest of the line, without what is before the point. A
-- property, such as @c.radius@, becomes a call.
qualifiedFixes :: TokenContext -> [Fix]
qualifiedFixes around = case names of
  [] -> []
  (title', _) : _ -> [Fix.joined title' (map snd names)]
  where
    line = take 1 (before around) <> here <> after around
    here = case (before around, after around) of
      (owner : _, own : _) ->
        [own {place = Region (end (place owner)) (start (place own)), shape = Stray '.'}]
      _ -> []
    names =
      [ renamed owner own (place a) (place b)
        | (a, t, b) <- zip3 line (drop 1 line) (drop 2 line),
          attached t && attached b,
          Word owner <- [shape a],
          Stray '.' <- [shape t],
          Word own <- [shape b]
      ]
    renamed owner own a b =
      let new
            | own `elem` properties = own <> "_of(" <> owner <> ")"
            | otherwise = own
       in ("Write " <> new <> ".", Fix.exchange "" (Region (start a) (end b)) new)

-- | Names of properties, which become functions by the ending @_of@.
properties :: [Text]
properties = Text.words "x y z centre radius length direction points start end"

-- | Fix for a text without its closing quotation mark.
textFixes :: Region -> TokenContext -> [Fix]
textFixes region around
  | Just t <- previous around,
    Number _ Nothing <- shape t,
    end (place t) == start region =
    [ Fix.exchange
        "Write the inches as in."
        (Region (start region) (start region + 1))
        " in"
    ]
  | otherwise =
    [ Fix.insertion "Write \" at the end of the line." (end region) "\""
      | t : _ <- [reverse (before around)],
        shape t `elem` map Word ["part", "import", "machine", "table"]
    ]

-- Numbers and units

-- | The unit that a user means by a word; 'Nothing' if it resembles none.
unitMeant :: Text -> Maybe Text
unitMeant word = listToMaybe ([u | u <- units, u == small] <> [u | (w, u) <- others, w == small])
  where
    small = Text.toLower word
    units = map unitName [minBound .. maxBound]
    others =
      concat
        [ map (,"mm") (Text.words "мм millimetre millimetres millimeter millimeters mms"),
          map (,"cm") (Text.words "см centimetre centimetres centimeter centimeters"),
          map (,"m") (Text.words "м metre metres meter meters"),
          map (,"in") (Text.words "inch inches дюйм дюйма"),
          map (,"deg") (Text.words "degree degrees degs grad град градус градусов гр"),
          map (,"rad") (Text.words "radian radians рад радиан"),
          map (,"mm/min") (Text.words "mmpm mm_min mmmin mm_per_min"),
          map (,"in/min") (Text.words "ipm inpm"),
          map (,"ft/min") (Text.words "sfm fpm sfpm"),
          map (,"rpm") (Text.words "об r/min revs rev upm u/min revolutions")
        ]

-- | Fixes for a text that begins like a number but is none.
numberFixes :: Region -> Text -> TokenContext -> [Fix]
numberFixes region text around
  | Just unit <- unitMeant rest, isPlain = [put (digits <> " " <> unit)]
  | rest == "s" && isPlain && isDwell = [put (digits <> " s")]
  | Text.all (\c -> isDigit c || c == '_') text = [put (Text.filter isDigit text)]
  | Just zeros <- exponentOf rest, Text.all isDigit digits = [put (digits <> zeros)]
  | [_, _, _] <- Text.splitOn "." text,
    Text.all (\c -> isDigit c || c == '.') text =
    let (a, b) = Text.breakOn "." text
        (c, d) = Text.breakOn "." (Text.drop 1 b)
     in map
          (Fix.proposed . put)
          [a <> "." <> c <> Text.drop 1 d, a <> c <> "." <> Text.drop 1 d]
  | isName && isDefined = [Fix.proposed (put (rest <> digits))]
  | isName && isPlain = [Fix.proposed (put (digits <> " * " <> rest))]
  | otherwise = []
  where
    (digits, rest) = Text.span (\c -> isDigit c || c == '.') text
    isPlain = Text.count "." digits <= 1 && not (Text.null rest)
    isName = maybe False (isAlpha . fst) (Text.uncons rest) && not (Text.any (== '.') rest)
    isDwell = take 1 (reverse (map shape (before around))) == [Word "dwell"]
    isDefined = case map shape (before around) of
      [Word word] -> word `elem` ["let", "param", "contour", "table", "curve", "piece", "part"]
      _ -> False
    put new = Fix.exchange ("Write " <> new <> ".") region new

-- | The zeros of the power of ten that a text such as @e3@ means.
exponentOf :: Text -> Maybe Text
exponentOf text = case Text.uncons (Text.toLower text) of
  Just ('e', count)
    | [(n, "")] <- reads (Text.unpack count),
      n > 0,
      n < (7 :: Int) ->
      Just (Text.replicate n "0")
  _ -> Nothing
