-- | Short texts that an editor shows within a line: the units of numbers without a unit, the types
-- of definitions, and the radii of circles along which a contour leads.
module Query.InlayHint
  ( InlayHint (..),
    inlayHints,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (Name))
import Base.Region (Located (..), Region (..))
import Checked.Builtin (Form (..))
import Checked.Builtin qualified as Builtin
import Checked.Dimension qualified as Dimension
import Checked.Type (Type (ListOf))
import Checked.Type qualified as Type
import Data.List (nub, sortOn)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Geometry.Segment qualified as Segment
import Part.Part qualified as Part
import Query.Mention (MentionType (..))
import Query.Mention qualified as Mention
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Query.SyntaxWalk qualified as SyntaxWalk
import Surface.Syntax

-- | A text that is shown after the character before the offset.
data InlayHint = InlayHint {offset :: Int, text :: Text, isType :: Bool}
  deriving stock (Eq, Show)

-- | The hints in a region of the program's own text, in order.
inlayHints :: Snapshot -> Region -> [InlayHint]
inlayHints now (Region from to) =
  sortOn offset (filter isInside (types <> concatMap units inner <> radii))
  where
    isInside h = from <= offset h && offset h <= to
    inner = concatMap SyntaxWalk.inside (statements (Snapshot.program now))
    typeAt =
      Map.fromList
        [ (Mention.place m, t)
          | m <- Mention.mentions (Snapshot.facts now),
            Mention.definition m == Just (Mention.place m),
            OfValue t <- [Mention.typing m]
        ]
    types =
      [ InlayHint {offset = end at, text = ": " <> Type.describe t, isType = True}
        | Located _ s <- inner,
          Just (Located at _) <- [definedValue s],
          Just t <- [Map.lookup at typeAt]
      ]
    units s = case value s of
      LetValue n e -> bare (Map.lookup (region n) typeAt) e
      Param n e -> bare (Map.lookup (region n) typeAt) e
      _ -> concat [bare t e | (t, e) <- SyntaxWalk.typedExpressions s]
    radii =
      [ InlayHint {offset = end (region e), text = "radius " <> Decimal.mm r, isType = False}
        | s <- inner,
          isTop s,
          Located _ (Element (Just _) e _ _) <- SyntaxWalk.elementsOf s,
          Just r <- [Map.lookup (region e) walked]
      ]
    isTop s = case value s of
      Contour {} -> True
      _ -> False
    walked =
      Map.fromList
        [ (Part.origin x, Segment.radius centre start')
          | Just part <- [Snapshot.part now],
            c <- Part.contours part,
            x <- NonEmpty.toList (Part.elements c),
            Segment.Arc {Segment.centre = centre, Segment.start = start'} <- [Part.segment x]
        ]

-- | The name of a value that a statement defines without saying its type.
definedValue :: Statement_ -> Maybe (Located Name)
definedValue s = case s of
  LetValue n _ -> Just n
  Param n _ -> Just n
  _ -> Nothing

-- | The hints of the numbers without a unit in an expression of this type.
bare :: Maybe Type -> Expr -> [InlayHint]
bare t e = case value e of
  Literal _ Nothing ->
    [ InlayHint {offset = end (region e), text = unit, isType = False}
      | Just unit <- [t >>= unitOf]
    ]
  Literal _ (Just _) -> []
  Variable _ -> []
  Pair a b -> concatMap (bare (Just Type.len)) [a, b]
  Triple a b c -> concatMap (bare (Just Type.len)) [a, b, c]
  Negate a -> bare t a
  Binary op a b | op `elem` [Add, Subtract] -> concatMap (bare t) [a, b]
  If c a b -> bare Nothing c <> bare t a <> bare t b
  List es -> concatMap (bare (t >>= itemType)) es
  Call (Located _ name) arguments ->
    concat (zipWith argument (parameterTypes name arguments) (NonEmpty.toList arguments))
  _ -> concatMap (bare Nothing) (SyntaxWalk.subexpressions e)
  where
    argument t' a = case a of
      Given x -> bare t' x
      Chosen _ x -> bare t' x
      Ranked _ -> []
    itemType u = case u of
      ListOf item -> Just item
      _ -> Nothing

-- | The types of the arguments of a call, each if all forms of the function with this number of
-- arguments agree about it.
parameterTypes :: Name -> NonEmpty.NonEmpty Argument -> [Maybe Type]
parameterTypes (Name name) arguments = case Builtin.lookup name of
  Nothing -> map (const Nothing) (NonEmpty.toList arguments)
  Just builtin ->
    [ case nub [Builtin.type' (parameters f !! i) | f <- fitting builtin] of
        [t] -> Just t
        _ -> Nothing
      | i <- [0 .. length arguments - 1]
    ]
  where
    fitting b = filter ((== length arguments) . length . parameters) (Builtin.forms fresh b)
    fresh =
      Builtin.Fresh
        { Builtin.dimension = Dimension.atom (Dimension.Unknown 0),
          Builtin.anything = Type.Variable 0
        }

-- | The unit of a number without a unit that has this type; 'Nothing' for a plain number.
unitOf :: Type -> Maybe Text
unitOf t
  | t == Type.len = Just "mm"
  | t == Type.angle = Just "deg"
  | t == Type.feed = Just "mm/min"
  | t == Type.spindleSpeed = Just "rpm"
  | otherwise = Nothing
