{-# LANGUAGE RankNTypes #-}

-- | The grammar of programs, by recursive descent with one token of lookahead.
--
-- A mistake ends the statement, or the item of a block, in which it occurs. Parsing continues at
-- the next statement or item, so that all mistakes are reported at once. Two parsers use the rules.
-- The explaining parser of "Surface.Combinator" reports mistakes. The fast parser of
-- "Surface.Combinator.Fast" only accepts programs without a mistake. Each rule parses the construct
-- that its comment names.
module Surface.Grammar
  ( explainedProgram,
    fastProgram,
    explainedExpression,
  )
where

import Base.Name (Name (..))
import Base.Name qualified as Name
import Base.Quantity (LengthUnit (..))
import Base.Region (Located (..), span)
import Base.Region qualified as Region
import Control.Monad (void)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe qualified as Maybe
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Report (quote)
import Surface.Combinator
import Surface.Combinator.Fast (FastParser)
import Surface.Combinator.Fast qualified as FastCombinator
import Surface.DrawingGrammar (allOutlines, drawingReference, fromFile)
import Surface.EngravingGrammar (engraving)
import Surface.Error (Enclosure (..))
import Surface.HoleForm qualified as HoleForm
import Surface.HoleGrammar (cutter, hole)
import Surface.Keyword qualified as Keyword
import Surface.Syntax
import Surface.Token (Token (..), Token_ (..))
import Surface.Token qualified as Token
import Surface.TokenGrammar
import Text.Megaparsec ((<?>), (<|>))
import Text.Megaparsec qualified as Parsec
import Prelude hiding (span)

-- | The rule for a program, for the explaining parser.
explainedProgram :: Explaining [Statement]
explainedProgram = program

-- | The rule for a program, for the fast parser.
fastProgram :: FastParser [Statement]
fastProgram = program

-- | The rule for an expression that is the whole text, for the explaining parser.
explainedExpression :: Explaining Expr
explainedExpression = expr <* (Parsec.eof <?> "the end of the value")

-- Statements

program :: Parser [Statement]
program = Parsec.manyTill (recovering brokenStatement statement) Parsec.eof

statement :: Parser Statement
statement = located (statement_ <* endOfLine)

statement_ :: Parser Statement_
statement_ = do
  begin <- Parsec.lookAhead Parsec.anySingle
  case shape begin of
    Word word | Just rest <- lookup word statementForms -> keyword word *> rest
    Word word -> Parsec.customFailure (NoStatement word)
    _ -> Parsec.empty <?> "a statement"

-- | The keywords of statements, each with the rule for the text after the keyword.
statementForms :: Grammar p => [(Text, p Statement_)]
statementForms =
  [ ("part", Part <$> name <*> Parsec.optional (onThisLine text')),
    ("units", Units <$> ((Millimetres <$ keyword "mm") <|> (Inches <$ keyword "in"))),
    ("machine", Machine <$> (onThisLine (located machine) <?> "the name of a machine")),
    ("import", Import <$> (text' <?> "the name of a file in quotation marks")),
    ("tool", firstTool),
    ("feed", Feed <$> onSameLine "a feed" expr),
    ("tolerance", Tolerance <$> accuracy),
    ("clearance", Clearance <$> expr),
    ("from", From <$> expr),
    ("work", WorkOffset <$> onSameLine "the number of a work offset" expr),
    ("program", ProgramNumber <$> onSameLine "the number of the program" expr),
    ("safe", SafeHeight <$> onSameLine "a height" expr),
    ("stock", Stock <$> onSameLine "a region" expr <*> heights),
    ("avoid", Avoid <$> onSameLine "a region" expr <*> heights),
    ("let", definition),
    ("param", Param <$> name <* symbol "=" <*> expr),
    ("contour", contour),
    ("contours", allOutlines number expr),
    ("table", Table <$> name <*> lines'),
    ("curve", Curve <$> name <* symbol "=" <*> expr),
    ("piece", piece),
    ("assert", Assert <$> expr <*> Parsec.optional (keyword "within" *> expr)),
    ("mill", machining "mill" Mill),
    ("pocket", Pocket <$> expr <*> stepover <*> ownName <*> settings "pocket"),
    ("rest", RestOf <$> (keyword "of" *> expr) <*> stepover <*> settings "rest"),
    ("face", Face <$> expr <*> stepover <*> settings "face"),
    ("engrave", engraving expr settings),
    ("vcarve", Vcarve <$> expr <*> ownName <*> settings "vcarve"),
    ("turn", machining "turn" Turn),
    ( "drill",
      keyword "at"
        *> ( Drill
               <$> expr
                 <* keyword "depth" <*> expr <*> Parsec.option [] (onThisLine (settings "drill"))
           )
    ),
    ("rapid", Travel RapidMotion <$> stops),
    ("move", Travel FeedMotion <$> stops),
    ( "change",
      Change <$> onSameLine "the number of a tool" expr
        <*> onSameLine "a cutter" (cutter expr)
        <*> Parsec.optional (onThisLine (keyword "at" *> expr))
    ),
    ("spindle", Spindle <$> spin),
    ("coolant", Coolant <$> ((SwitchOn <$ keyword "on") <|> (SwitchOff <$ keyword "off"))),
    ("aux", Auxiliary <$> expr),
    ("stop", pure ProgramStop),
    ("optional", OptionalStop <$ onSameLine "‘stop’" (keyword "stop")),
    ( "dwell",
      Dwell <$> onSameLine "a number of seconds" expr <* onSameLine "‘s’" (keyword "s")
    ),
    ( "for",
      forEach >>= \(variable, from) ->
        Repeat variable from <$> statementBlock RepetitionBlock statement
    ),
    ( "if",
      When <$> expr <*> statementBlock (BlockOf "if") statement <*> Parsec.option [] otherwise'
    ),
    ("with", With <$> expr <*> statementBlock (BlockOf "with") statement)
  ]
    <> [(HoleForm.word work, hole expr settings work) | work <- [minBound ..]]
  where
    stepover = keyword "step" *> expr
    ownName = Parsec.optional (onThisLine (keyword "as" *> name))
    otherwise' =
      keyword "else"
        *> ((: []) <$> located elseIf <|> statementBlock (BlockOf "else") statement)
    elseIf =
      keyword "if"
        *> ( When
               <$> expr
                 <*> statementBlock (BlockOf "if") statement
                 <*> Parsec.option [] otherwise'
           )

-- | The first tool after its keyword: a cutter, with a number or a name before it if the tool has a
-- number. A name is the number only if another word follows it; otherwise it is a wrong cutter.
firstTool :: Parser Statement_
firstTool = onSameLine "a cutter" $ do
  next <- remaining
  case map shape (take 2 next) of
    Number _ _ : _ -> numbered number
    [Word word, Word _] | not (Keyword.isReserved word) -> numbered variableOrCall
    _ -> Tool Nothing <$> cutter expr
  where
    numbered first = Tool . Just <$> first <*> onSameLine "a cutter" (cutter expr)

-- | The heights of the bottom and of the top of a body after its region: @from -20 to 0@.
heights :: Parser (Maybe (Expr, Expr))
heights = Parsec.optional (onThisLine ((,) <$> (keyword "from" *> expr) <*> (keyword "to" *> expr)))

-- | A tolerance: one value for both sides of the curve, or one inside and one outside.
accuracy :: Parser Accuracy
accuracy =
  (keyword "inside" *> (Between <$> expr <* keyword "outside" <*> expr)) <|> (Within <$> expr)

-- | The command to a spindle: a sense with an optional speed, @off@ or @manual@.
spin :: Parser Spin
spin =
  (SpindleStop <$ keyword "off")
    <|> (SpindleByHand <$ keyword "manual")
    <|> ( do
            turning <- sense
            speed <- Parsec.optional (onThisLine expr)
            limit <- maybe (pure Nothing) (const (Parsec.optional (keyword "limit" *> expr))) speed
            pure (Spinning turning speed limit)
        )

-- | The definition of a value or of a function, after the keyword @let@.
definition :: Parser Statement_
definition = do
  what <- name
  parameters <- Parsec.optional (touching *> parens (name `sepBy1` ","))
  void (symbol "=")
  body <- expr
  pure (maybe (LetValue what body) (\ps -> LetFunction what ps body) parameters)

-- | A contour statement after its keyword: the name, and @open@ or @closed@ with the block of
-- items, or @from@ with a part of a drawing.
contour :: Parser Statement_
contour = do
  what <- name
  drawn what <|> written what
  where
    drawn what = keyword "from" *> (Drawn OneOutline what <$> drawingReference number)
    written what = do
      closure <- located ((Closed <$ keyword "closed") <|> (Open <$ keyword "open"))
      Contour what closure <$> block (ContourBlock (Name.text (value what))) BrokenItem item

-- | The lines of a table in braces, or the name of a file, with a part of it if it is a drawing.
lines' :: Parser Lines
lines' =
  (fromFile <$> (keyword "from" *> drawingReference number))
    <|> (WrittenLines <$> block TableBlock (const BrokenLine) line)

-- | A line of a table: one or more headings, or one or more cells. Their counts are not compared.
line :: Parser TableLine_
line =
  (Header <$> onLine NotInHeadings column)
    <|> (Entries <$> onLine NotInRow cell)
    <|> misfit NotInRow
  where
    onLine problem p = (:|) <$> p <*> zeroOrMore (onThisLine p) <* lineDone problem
    column = Heading <$> usedName <*> Parsec.optional (onThisLine unit)
    unit = Parsec.choice [u <$ keyword (Token.unitName u) | u <- Token.columnUnits]
    cell = Parsec.hidden (TextCell <$> text') <|> (ValueCell <$> (signed <|> parens expr))
    signed = number <|> Parsec.hidden (located (Negate <$> (symbol "-" *> magnitude)))
    magnitude = number <|> misfit NotInRow

-- | A piece: @q = skin cipher 2(2.5), 4(mu, H) left joggle from 10 to 40 depth 2 radius 5@.
piece :: Parser Statement_
piece = do
  what <- name <* symbol "="
  base <- expr
  ciphers <-
    Parsec.option [] (keyword "cipher" *> (NonEmpty.toList <$> (located cipher `sepBy1` ",")))
  side <- located ((LeftSide <$ keyword "left") <|> (RightSide <$ keyword "right") <|> missingSide)
  Piece what base ciphers side <$> zeroOrMore (located joggle)
  where
    -- Reports a missing side if the statement ends here, or if the next word is @outside@,
    -- @inside@, @on@ or @joggle@.
    missingSide = do
      next <- remaining
      case next of
        t : _
          | not (newLine t) && shape t `notElem` map Word ["outside", "inside", "on", "joggle"] ->
            Parsec.empty
        _ -> Parsec.customFailure NoSide
    cipher =
      Cipher
        <$> located (token "the digit of a cipher" digit)
          <*> ( (touching *> parens (expr `sepBy1` ","))
                  <?> "a bracket with the values of the cipher right after its digit"
              )
    digit t = case shape t of
      Number x Nothing -> Just x
      _ -> Nothing
    joggle =
      Joggle
        <$> (keyword "joggle" *> keyword "from" *> expr)
          <*> (keyword "to" *> expr)
          <*> (keyword "depth" *> expr)
          <*> (keyword "radius" *> expr)

-- | An item of a contour.
item :: Parser Item_
item = isWordNext >>= \ahead -> if ahead then repetition <|> choice <|> element else element

-- | The variable and the list after the keyword @for@: @x in list@.
forEach :: Parser (Located Name, Expr)
forEach = (,) <$> name <* (keyword "in" <?> "‘in’") <*> expr

-- | A repetition of items of a contour: @for x in list { … }@.
repetition :: Parser Item_
repetition = do
  (variable, from) <- keyword "for" *> forEach
  For variable from <$> nested (block RepetitionBlock BrokenItem item)

-- | A choice of items, @if c { … }@, or an element with a conditional value, @if c then a else b@.
choice :: Parser Item_
choice = do
  Located region (condition, then') <- located (keyword "if" *> ((,) <$> expr <*> branch))
  case then' of
    Right items -> Choose condition items <$> Parsec.option [] (keyword "else" *> otherwise')
    Left (a, b) ->
      Element Nothing (Located region (If condition a b))
        <$> zeroOrMore (located modifier) <*> Parsec.optional (located link)
  where
    branch =
      (Left <$> alternatives) <|> (Right <$> nested (block (BlockOf "if") BrokenItem item))
    otherwise' =
      ((: []) <$> located choice) <|> nested (block (BlockOf "else") BrokenItem item)

-- | An element with its modifiers and the link to the next one.
element :: Parser Item_
element = do
  isWord <- isWordNext
  direction <- if isWord then Parsec.optional (located sense) else pure Nothing
  what <- expr
  isWordAfter <- isWordNext
  if isWordAfter
    then Element direction what <$> zeroOrMore (located modifier) <*> Parsec.optional (located link)
    else pure (Element direction what [] Nothing)

-- | A modifier of an element: @feed f@, @slow@, @allowance a@ or @bevel b@.
modifier :: Parser Modifier_
modifier =
  (keyword "feed" *> (ElementFeed <$> expr))
    <|> (Slow <$ keyword "slow")
    <|> (keyword "allowance" *> (ElementAllowance <$> expr))
    <|> (keyword "bevel" *> (Bevel <$> expr))

-- | The link of an element to the next one: @meet@, @smooth@, @tangent@, @fillet r@ or @chamfer d@.
link :: Parser Link_
link =
  (keyword "meet" *> (Meet <$> Parsec.optional (keyword "near" *> expr)))
    <|> (Smooth <$ keyword "smooth")
    <|> (Tangent <$ keyword "tangent")
    <|> (keyword "fillet" *> Parsec.optional (symbol "+") *> (Fillet <$> radius))
    <|> (keyword "chamfer" *> (Chamfer <$> onSameLine "a length" expr))
  where
    radius = onSameLine "a radius" expr

-- | A machining statement after its keyword @word@: a contour, a side, and settings. @make@ makes
-- the statement from these three.
machining :: Text -> (Expr -> Located Side -> [Setting] -> Statement_) -> Parser Statement_
machining word make =
  make <$> expr <*> located cutterSide <*> settings word

-- | The block of settings of a statement with the keyword @word@.
settings :: Text -> Parser [Setting]
settings word =
  block
    (BlockOf word)
    (const BrokenSetting)
    (setting (concatMap (take 1 . Text.words) (Keyword.settingsOf word)))

-- | A setting. Reports of a mistake name @offered@, the first words of the settings that the
-- statement allows. Settings of other statements are parsed as well, so that checking can refuse
-- them by name.
setting :: [Text] -> Parser Setting_
setting offered = do
  begin <- Parsec.lookAhead Parsec.anySingle
  case shape begin of
    Word word | Just rest <- lookup word settingForms -> keyword word *> rest
    _ ->
      Parsec.choice
        [ (Parsec.empty <?> Text.unpack (quote word)) `asTypeOf` rest
          | (word, rest) <- settingForms,
            word `elem` offered
        ]

-- | The first words of settings, each with the rule for the text after the word.
settingForms :: Grammar p => [(Text, p Setting_)]
settingForms =
  [ ("approach", Approach <$> stops),
    ("retract", Retract <$> stops),
    ("depth", Depth <$> onSameLine "a depth" expr <*> Parsec.optional (keyword "step" *> expr)),
    ( "lead",
      LeadBy
        <$> ((LeadIn <$ keyword "in") <|> (LeadOut <$ keyword "out"))
          <*> ((LeadLine <$ keyword "line") <|> (LeadArc <$ keyword "arc"))
          <*> onSameLine "a length" expr
    ),
    ("allowance", Allowances <$> (expr `sepBy1` ",")),
    ("corners", CornerStyle <$> ((Round <$ keyword "round") <|> (Sharp <$ keyword "sharp"))),
    ("climb", pure (CutBy Climb)),
    ("conventional", pure (CutBy Conventional)),
    ( "compensation",
      CompensationBy
        <$> ((ByCompiler <$ keyword "compiler") <|> (ByController <$ keyword "controller"))
    ),
    ("start", keyword "near" *> (StartNear <$> expr)),
    ("plunge", Plunge <$> onSameLine "a feed" expr),
    ("ramp", Ramp <$> onSameLine "an angle" expr),
    ( "helix",
      keyword "pitch"
        *> (Helix <$> onSameLine "a pitch" expr <*> Parsec.optional (keyword "diameter" *> expr))
    ),
    ("spiral", pure Spiral),
    ("tabs", onSameLine "a number" expr >>= tabSizes . Tabs . TabCount),
    ("tab", keyword "at" *> (Tabs . TabsAt <$> (expr `sepBy1` ",")) >>= tabSizes),
    ("peck", Peck <$> onSameLine "a depth" expr),
    ("shortest", pure ShortestWay),
    ("angle", Angle <$> onSameLine "an angle" expr),
    ("chip", keyword "break" *> (ChipBreak <$> onSameLine "a length" expr)),
    ("dwell", Pause <$> onSameLine "a number of seconds" expr <* onSameLine "‘s’" (keyword "s")),
    ("pitch", TurnPitch <$> onSameLine "a length" expr),
    ("hand", Hand <$> ((LeftSide <$ keyword "left") <|> (RightSide <$ keyword "right"))),
    ("floating", pure Floating),
    ("islands", Islands <$> (expr `sepBy1` ",")),
    ("rest", RestAllowed <$ keyword "allowed")
  ]

-- | The width, the height and the angle of the sides of tabs. An @angle@ on the next line is a
-- setting of its own.
tabSizes :: Grammar p => (Expr -> Expr -> Maybe Expr -> a) -> p a
tabSizes tabs =
  tabs <$> (keyword "width" *> expr)
    <*> (keyword "height" *> expr)
    <*> Parsec.optional (onThisLine (keyword "angle" *> expr))

-- | One or more points. Each may have the pace of the motion to it: @rapid@ or a feed.
stops :: Parser (NonEmpty Stop)
stops = stop `sepBy1` ","
  where
    stop = Stop <$> expr <*> (Maybe.fromMaybe Cutting <$> Parsec.optional (onThisLine pace'))
    pace' = (Rapid <$ keyword "rapid") <|> (AtFeed <$> (keyword "feed" *> expr))

-- Expressions, the operators of lowest precedence first

-- | An expression. Most expressions are a single operand, so that an operand is tried first.
expr :: Parser Expr
expr = do
  begin <- remaining
  case begin of
    t : _ | Just first <- operand t -> first >>= operated
    _ -> conditional <|> disjunction

-- | The rule for an operand that begins with the token @t@; 'Nothing' if none begins with it.
operand :: Grammar p => Token -> Maybe (p Expr)
operand t = case shape t of
  Number _ _ -> Just number
  Word word | not (Keyword.isReserved word) -> Just variableOrCall
  Symbol "(" -> Just pairOrGroup
  Symbol "[" -> Just list
  Symbol "-" -> Just negative
  _ -> Nothing

-- | The whole expression that begins with the operand @first@: parses the operators and operands
-- after it.
operated :: Grammar p => Expr -> p Expr
operated first = do
  next <- remaining
  case next of
    t : _
      | isOperator t ->
        moreFactors first
          >>= moreSummands
          >>= moreOfRange
          >>= compared
          >>= moreConjuncts
          >>= moreDisjuncts
    _ -> pure first
  where
    isOperator t = case shape t of
      Symbol s -> Text.any isOperatorCharacter s
      Word word -> word == "and" || word == "or"
      _ -> False
    isOperatorCharacter c = case c of
      '(' -> False
      ')' -> False
      ',' -> False
      _ -> c `elem` ("+-*/<>=!." :: String)

-- | A conditional expression: @if c then a else b@.
conditional :: Parser Expr
conditional = located ((\c (a, b) -> If c a b) <$> (keyword "if" *> nested expr) <*> alternatives)

alternatives :: Parser (Expr, Expr)
alternatives = (,) <$> (keyword "then" *> nested expr) <*> (keyword "else" *> nested expr)

disjunction :: Parser Expr
disjunction = conjunction >>= moreDisjuncts

moreDisjuncts :: Grammar p => Expr -> p Expr
moreDisjuncts = chain (Parsec.hidden (Or <$ keyword "or")) conjunction

conjunction :: Parser Expr
conjunction = negation >>= moreConjuncts

moreConjuncts :: Grammar p => Expr -> p Expr
moreConjuncts = chain (Parsec.hidden (And <$ keyword "and")) negation

negation :: Parser Expr
negation = Parsec.hidden (located (Not <$> (keyword "not" *> nested negation))) <|> comparison

comparison :: Parser Expr
comparison = range >>= compared

-- | The comparison that begins with the operand @left@; the operand alone if no comparison sign
-- follows. Only one sign may follow: @a < b < c@ is not an expression.
compared :: Grammar p => Expr -> p Expr
compared left = (operators table >>= \op -> joined op left <$> range) <|> pure left
  where
    table =
      [("<=", AtMost), (">=", AtLeast), ("!=", Unequal), ("<", Less), (">", Greater), ("=", Equal)]

range :: Parser Expr
range = sum' >>= moreOfRange

-- | The range that begins with the lower end @low@, after which @..b by s@ is parsed; @low@ alone
-- if no @..@ follows.
moreOfRange :: Grammar p => Expr -> p Expr
moreOfRange low =
  ( Parsec.hidden (symbol "..")
      *> (to <$> sum' <*> Parsec.optional (Parsec.hidden (keyword "by") *> sum'))
  )
    <|> pure low
  where
    to high step =
      Located
        (span (Region.region low) (Region.region (Maybe.fromMaybe high step)))
        (Range low high step)

sum' :: Parser Expr
sum' = product' >>= moreSummands

moreSummands :: Grammar p => Expr -> p Expr
moreSummands = chain (operators [("+", Add), ("-", Subtract)]) product'

product' :: Parser Expr
product' = factor >>= moreFactors

moreFactors :: Grammar p => Expr -> p Expr
moreFactors = chain (operators [("*", Multiply), ("/", Divide)]) factor

operators :: [(Text, Operator)] -> Parser Operator
operators table = Parsec.hidden (token "an operator" operatorOf)
  where
    operatorOf t = case shape t of
      Symbol s -> lookup s table
      _ -> Nothing

-- | Parses the operators and operands after the first operand, and joins all from left to right.
-- The arguments are the rule for an operator, the rule for an operand, and the first operand.
chain :: Grammar p => p Operator -> p Expr -> Expr -> p Expr
chain operator next = more
  where
    more left = (operator >>= \op -> next >>= \right -> more (joined op left right)) <|> pure left

joined :: Operator -> Expr -> Expr -> Expr
joined op left right =
  Located (span (Region.region left) (Region.region right)) (Binary op left right)

factor :: Parser Expr
factor = do
  begin <- remaining
  case begin of
    t : _ | Just found <- operand t -> found
    _ -> Parsec.hidden negative <|> primary

negative :: Parser Expr
negative = located (Negate <$> (symbol "-" *> nested factor))

primary :: Parser Expr
primary = (number <|> variableOrCall <|> pairOrGroup <|> list) <?> "a value"

number :: Parser Expr
number = token "a number" numberOf
  where
    numberOf t = case shape t of
      Number x unit -> Just (Located (Token.place t) (Literal x unit))
      _ -> Nothing

-- | A list, @[a, b, c]@, or a comprehension, @[e for x in list]@.
list :: Parser Expr
list = located (brackets (Parsec.option (List []) (expr >>= more)))
  where
    more e =
      (each e <$> (Parsec.hidden (keyword "for") *> forEach))
        <|> (List . (e :) <$> zeroOrMore (symbol "," *> expr))
    each e (variable, from) = Each e variable from

variableOrCall :: Parser Expr
variableOrCall = located $ do
  what <- usedName
  next <- remaining
  case next of
    t : _ | isTouchingParenthesis t -> Call what <$> parens (argument `sepBy1` ",")
    _ -> pure (Variable (value what))

argument :: Parser Argument
argument = do
  begin <- remaining
  case begin of
    t : _ | not (isWord' t) -> Given <$> expr
    _ -> Parsec.hidden (chosen <|> ranked) <|> (Given <$> expr)
  where
    chosen = Chosen <$> located (Parsec.choice [c <$ keyword k | (k, c) <- choices]) <*> expr
    choices =
      [ ("near", Near),
        ("left", ToLeft),
        ("right", ToRight),
        ("inside", ToInside),
        ("outside", ToOutside),
        ("within", WithinTolerance)
      ]
    ranked = Ranked <$> located ((First <$ keyword "first") <|> (Last <$ keyword "last"))
    isWord' t = case shape t of
      Word _ -> True
      _ -> False

-- | An expression in parentheses, a point or a vector @(a, b)@, or a point with a height
-- @(a, b, c)@.
pairOrGroup :: Parser Expr
pairOrGroup = fastPath FastCombinator.plainPair $ do
  Located region es <- located (parens (expr `sepBy1` ","))
  case NonEmpty.toList es of
    [a] -> pure a
    [a, b] -> pure (Located region (Pair a b))
    [a, b, c] -> pure (Located region (Triple a b c))
    _ -> Parsec.customFailure (ManyCoordinates region)
