-- | The printer of expressions, with parentheses only where the syntax tree needs them. It makes
-- documents, which "Surface.PrettyPrinter" breaks into lines. If the source has a comment inside an
-- expression, the printer breaks the line there, so that the comment keeps its position.
module Surface.PrintExpression
  ( CommentPositions (..),
    noComments,
    oneLine,
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
import Surface.Keyword qualified as Keyword
import Surface.PrettyPrinter (Doc (..), Member (..))
import Surface.PrettyPrinter qualified as PrettyPrinter
import Surface.Syntax hiding (Statement_ (..))
import Surface.Token (unitName)

-- | The positions of comments in the source. An offset is the index of a character in the source.
-- 'isBetween' tells if a comment begins at the first offset or after it, but before the second one.
-- 'isAtComma' answers the same question, but only about comments next to a comma.
data CommentPositions = CommentPositions
  { isBetween :: Int -> Int -> Bool,
    isAtComma :: Int -> Int -> Bool
  }

-- | The comment positions of a text that contains no comment: every answer is False.
noComments :: CommentPositions
noComments = CommentPositions {isBetween = \_ _ -> False, isAtComma = \_ _ -> False}

-- | An expression as it is written on one line.
oneLine :: Expr -> Text
oneLine e = Text.unwords (map PrettyPrinter.text (PrettyPrinter.render 0 (value noComments e)))

-- | The precedence of an expression, the lowest first. An operand is put in parentheses if its
-- precedence is lower than the one that the operator before or after it demands.
data Precedence
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

-- | The document of an expression that is not an operand of an operator. It needs no parentheses.
value :: CommentPositions -> Expr -> Doc
value comments = operand comments Loose

-- | The document of a contour element. An element that begins with a minus or with @by@ is put in
-- parentheses, because it would otherwise continue the expression on the line before.
element :: CommentPositions -> Expr -> Doc
element comments e = if isContinuation (PrettyPrinter.firstText doc) then bracketed doc else doc
  where
    doc = value comments e
    isContinuation text =
      "-" `Text.isPrefixOf` text || Text.takeWhile (\c -> isAlphaNum c || c == '_') text == "by"

-- | Puts commas between documents, each of which is given with its region in the source. A document
-- begins a new line if the source has a comment next to the comma that precedes the document.
list :: CommentPositions -> NonEmpty (Region, Doc) -> NonEmpty Member
list comments things = NonEmpty.zipWith piece (NonEmpty.zip before things) commas
  where
    before = Nothing :| map (Just . fst) (NonEmpty.toList things)
    commas = NonEmpty.fromList (replicate (length things - 1) "," <> [""])
    piece (previous, (region, doc)) comma =
      Member
        { startsLine = maybe False (\p -> isAtComma comments (end p) (start region)) previous,
          content = Beside [doc, Text comma]
        }

-- | A member that need not begin a line.
member :: Doc -> Member
member = Member False

-- | Puts a space, but no line break, between documents.
spaced :: [Doc] -> Doc
spaced docs = Beside (drop 1 (concatMap (\d -> [Text " ", d]) docs))

bracketed :: Doc -> Doc
bracketed doc = Beside [Text "(", doc, Text ")"]

-- | The document of the operand @e@, in parentheses if its precedence is lower than @asked@.
operand :: CommentPositions -> Precedence -> Expr -> Doc
operand comments asked e = if precedence (Region.value e) < asked then bracketed doc else doc
  where
    doc = withoutParentheses comments e

precedence :: Expr_ -> Precedence
precedence e = case e of
  Literal _ _ -> Primary
  Variable _ -> Primary
  Call _ _ -> Primary
  Negate _ -> Factor
  Not _ -> Negation
  Binary operator _ _ -> operatorPrecedence operator
  Range {} -> Ranged
  If {} -> Loose
  Pair _ _ -> Primary
  Triple {} -> Primary
  List _ -> Primary
  Each {} -> Primary

operatorPrecedence :: Operator -> Precedence
operatorPrecedence operator = case operator of
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

-- | The document of an expression, without parentheses around the whole.
withoutParentheses :: CommentPositions -> Expr -> Doc
withoutParentheses comments (Located region e) = case e of
  Literal number unit -> Text (digits number <> maybe "" ((" " <>) . unitName) unit)
  Variable (Name name) -> Text name
  Call (Located _ (Name name)) arguments ->
    group (name <> "(") (NonEmpty.toList (list comments (fmap (argument comments) arguments))) ")"
  Negate inner ->
    let doc = operand comments Factor inner
     in Beside [Text (if "-" `Text.isPrefixOf` PrettyPrinter.firstText doc then "- " else "-"), doc]
  Not inner -> spaced [Text "not", operand comments Negation inner]
  -- The unit mm/rev or in/rev.
  Binary Divide (Located _ (Literal number (Just unit))) (Located _ (Variable (Name "rev"))) ->
    Text (digits number <> " " <> unitName unit <> "/rev")
  Binary operator left right -> case operatorPrecedence operator of
    Comparison ->
      Series
        [member (operand comments Ranged left), signed operator (operand comments Ranged right)]
    rank -> Series (chain comments rank (Located region e))
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

-- | The document of the values @es@ between the text @open@, such as @f(@, and a closing
-- parenthesis. @region@ is that of the whole in the source; if a comment lies in it, the document
-- is broken.
callDocument :: CommentPositions -> Region -> Text -> NonEmpty Expr -> Doc
callDocument comments region open es =
  Brackets
    (isBetween comments (start region) (end region))
    open
    (NonEmpty.toList (list comments (fmap (\x -> (Region.region x, value comments x)) es)))
    ")"

-- | The members of a series for an expression with operators of precedence @rank@: the first
-- operand, then each operator with its right operand, as in @a@, @+ b@, @- c@.
chain :: CommentPositions -> Precedence -> Expr -> [Member]
chain comments rank = reverse . go
  where
    go (Located region e) = case e of
      Binary operator left right
        | operatorPrecedence operator == rank ->
          signed operator (operand comments (rightDemand rank) right) : go left
      _ -> [member (operand comments rank (Located region e))]

signed :: Operator -> Doc -> Member
signed operator right = member (spaced [Text (sign operator), right])

-- | The least precedence that an operator of precedence @rank@ demands of its right operand.
rightDemand :: Precedence -> Precedence
rightDemand rank = case rank of
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

argument :: CommentPositions -> Argument -> (Region, Doc)
argument comments a = case a of
  Given e -> (Region.region e, value comments e)
  Chosen (Located region choice) e ->
    ( Region.span region (Region.region e),
      spaced [Text (Keyword.selectorWord choice), value comments e]
    )
  Ranked (Located region which) -> (region, Text (rankName which))

rankName :: Rank -> Text
rankName which = case which of
  First -> "first"
  Last -> "last"
