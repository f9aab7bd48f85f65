-- | Expressions as documents, with brackets only where the tree would be read differently without
-- them.
module Surface.PrintExpression
  ( CommentPositions (..),
    noComments,
    value,
    element,
    list,
    callDocument,
    member,
    spaced,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (Located), Region (..))
import Base.Region qualified as Region
import Data.Char (isAlphaNum)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.PrettyPrinter (Document (..), Member (..))
import Surface.PrettyPrinter qualified as PrettyPrinter
import Surface.Syntax hiding (Statement_ (..))
import Surface.Token (unitName)

-- | Where the text that is laid out has comments: whether there is any between two offsets, and
-- whether there is one beside a comma.
data CommentPositions = CommentPositions {isBetween :: Int -> Int -> Bool, isAtComma :: Int -> Int -> Bool}

-- | No comments.
noComments :: CommentPositions
noComments = CommentPositions {isBetween = \_ _ -> False, isAtComma = \_ _ -> False}

-- | How tightly an expression holds together. An operand is bracketed when it is looser than its
-- place asks.
data Tightness
  = Loose
  | Disjunction
  | Conjunction
  | Negation
  | Comparison
  | Ranged
  | Sum
  | Product
  | Factor
  | Primary
  deriving stock (Eq, Ord)

-- | An expression where any may stand.
value :: CommentPositions -> Expr -> Document
value comments = operand comments Loose

-- | An element of a contour, which must not be taken for the rest of the one before it.
element :: CommentPositions -> Expr -> Document
element comments e = if misleading (PrettyPrinter.firstText doc) then bracketed doc else doc
  where
    doc = value comments e
    misleading text =
      "-" `Text.isPrefixOf` text || Text.takeWhile (\c -> isAlphaNum c || c == '_') text == "by"

-- | Things with commas between them, each with its region; broken where a comment stands.
list :: CommentPositions -> NonEmpty (Region, Document) -> NonEmpty Member
list comments things = NonEmpty.zipWith piece (NonEmpty.zip before things) commas
  where
    before = Nothing :| map (Just . fst) (NonEmpty.toList things)
    commas = NonEmpty.fromList (replicate (length things - 1) "," <> [""])
    piece (previous, (region, doc)) comma =
      Member
        { startsLine = maybe False (\p -> isAtComma comments (end p) (start region)) previous,
          content = Beside [doc, Text comma]
        }

-- | A piece that begins no line of itself.
member :: Document -> Member
member = Member False

-- | Words and values with spaces between them.
spaced :: [Document] -> Document
spaced docs = Beside (drop 1 (concatMap (\d -> [Text " ", d]) docs))

bracketed :: Document -> Document
bracketed doc = Beside [Text "(", doc, Text ")"]

operand :: CommentPositions -> Tightness -> Expr -> Document
operand comments asked e = if tightness (Region.value e) < asked then bracketed doc else doc
  where
    doc = bare comments e

tightness :: Expr_ -> Tightness
tightness e = case e of
  Literal _ _ -> Primary
  Variable _ -> Primary
  Call _ _ -> Primary
  Negate _ -> Factor
  Not _ -> Negation
  Binary operator _ _ -> ofOperator operator
  Range {} -> Ranged
  If {} -> Loose
  Pair _ _ -> Primary
  Triple {} -> Primary
  List _ -> Primary
  Each {} -> Primary

ofOperator :: Operator -> Tightness
ofOperator operator = case operator of
  Add -> Sum
  Subtract -> Sum
  Multiply -> Product
  Divide -> Product
  Less -> Comparison
  AtMost -> Comparison
  Greater -> Comparison
  AtLeast -> Comparison
  Equal -> Comparison
  Unequal -> Comparison
  And -> Conjunction
  Or -> Disjunction

sign :: Operator -> Text
sign operator = case operator of
  Add -> "+"
  Subtract -> "-"
  Multiply -> "*"
  Divide -> "/"
  Less -> "<"
  AtMost -> "<="
  Greater -> ">"
  AtLeast -> ">="
  Equal -> "="
  Unequal -> "!="
  And -> "and"
  Or -> "or"

-- | An expression without brackets of its own.
bare :: CommentPositions -> Expr -> Document
bare comments (Located region e) = case e of
  Literal number unit -> Text (digits number <> maybe "" ((" " <>) . unitName) unit)
  Variable (Name name) -> Text name
  Call (Located _ (Name name)) arguments ->
    group (name <> "(") (NonEmpty.toList (list comments (fmap (argument comments) arguments))) ")"
  Negate inner ->
    let doc = operand comments Factor inner
     in Beside [Text (if "-" `Text.isPrefixOf` PrettyPrinter.firstText doc then "- " else "-"), doc]
  Not inner -> spaced [Text "not", operand comments Negation inner]
  Binary operator left right -> case ofOperator operator of
    Comparison ->
      Series [member (operand comments Ranged left), signed operator (operand comments Ranged right)]
    looser -> Series (chain comments looser (Located region e))
  Range low high step ->
    Beside $
      [operand comments Sum low, Text "..", operand comments Sum high]
        <> maybe [] (\s -> [Text " by ", operand comments Sum s]) step
  If condition yes no ->
    Series
      [ member (spaced [Text "if", sub condition]),
        member (spaced [Text "then", sub yes]),
        member (spaced [Text "else", sub no])
      ]
  Pair x y -> group "(" (coordinates (x :| [y])) ")"
  Triple x y z -> group "(" (coordinates (x :| [y, z])) ")"
  List items -> case NonEmpty.nonEmpty items of
    Nothing -> Text "[]"
    Just some -> group "[" (coordinates some) "]"
  Each item (Located _ (Name name)) from ->
    group "[" [member (sub item), member (spaced [Text ("for " <> name <> " in"), sub from])] "]"
  where
    sub = value comments
    group = Brackets (isBetween comments (start region) (end region))
    coordinates es = NonEmpty.toList (list comments (fmap (\x -> (Region.region x, sub x)) es))

-- | Values with commas between them behind an opening bracket, with the region of the whole.
callDocument :: CommentPositions -> Region -> Text -> NonEmpty Expr -> Document
callDocument comments region open es =
  Brackets
    (isBetween comments (start region) (end region))
    open
    (NonEmpty.toList (list comments (fmap (\x -> (Region.region x, value comments x)) es)))
    ")"

-- | A chain of operators of one rank: @a@, @+ b@, @- c@.
chain :: CommentPositions -> Tightness -> Expr -> [Member]
chain comments looser = reverse . go
  where
    go (Located region e) = case e of
      Binary operator left right
        | ofOperator operator == looser ->
          signed operator (operand comments (tighter looser) right) : go left
      _ -> [member (operand comments looser (Located region e))]

signed :: Operator -> Document -> Member
signed operator right = member (spaced [Text (sign operator), right])

-- | What is asked of an operand to the right of an operator.
tighter :: Tightness -> Tightness
tighter looser = case looser of
  Loose -> Disjunction
  Disjunction -> Conjunction
  Conjunction -> Negation
  Negation -> Comparison
  Comparison -> Ranged
  Ranged -> Sum
  Sum -> Product
  Product -> Factor
  Factor -> Primary
  Primary -> Primary

argument :: CommentPositions -> Argument -> (Region, Document)
argument comments a = case a of
  Given e -> (Region.region e, value comments e)
  Chosen (Located region choice) e ->
    ( Region (start region) (end (Region.region e)),
      spaced [Text (choiceName choice), value comments e]
    )
  Ranked (Located region which) -> (region, Text (rankName which))

choiceName :: Selector -> Text
choiceName choice = case choice of
  Near -> "near"
  ToLeft -> "left"
  ToRight -> "right"
  Within' -> "inside"
  Beyond -> "outside"
  UpTo -> "within"

rankName :: Rank -> Text
rankName which = case which of
  First -> "first"
  Last -> "last"
