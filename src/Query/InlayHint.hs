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
import Surface.Syntax
import Surface.SyntaxWalk qualified as SyntaxWalk

-- | A text that is shown after the character before the offset.
data InlayHint = InlayHint {offset :: Int, text :: Text, isType :: Bool}
  deriving stock (Eq, Show)

-- | The hints in a region of the program's own text, in order.
inlayHints :: Snapshot -> Region -> [InlayHint]
inlayHints now (Region from to) =
  sortOn offset (filter isInside (types <> concatMap units inner <> radii))
  where
    isInside h = from <= offset h && offset h <= to
    inner = concatMap SyntaxWalk.statementsIn (statements (Snapshot.program now))
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
      _ -> concat [bare t e | (t, e) <- typedExpressions s]
    radii =
      [ InlayHint {offset = end (region e), text = "radius " <> Decimal.mm r, isType = False}
        | Located _ (Element (Just _) e _ _) <- concatMap SyntaxWalk.itemsOf inner,
          Just r <- [Map.lookup (region e) walked]
      ]
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
  _ -> concatMap (bare Nothing) (SyntaxWalk.parts e)
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

-- | The expressions of a statement with the types that its grammar demands; 'Nothing' where it
-- demands none. Definitions of values are left out.
typedExpressions :: Statement -> [(Maybe Type, Expr)]
typedExpressions s = case value s of
  Feed e -> [(Just Type.feed, e)]
  Clearance e -> [(Just Type.len, e)]
  Tolerance _ -> lengths
  Tool _ -> []
  Change _ _ -> []
  Spindle _ -> [(Just Type.spindleSpeed, e) | e <- SyntaxWalk.ofStatement s]
  Drill e f settings -> (Nothing, e) : (Just Type.len, f) : concatMap typedSetting settings
  Mill e _ settings -> (Nothing, e) : concatMap typedSetting settings
  Turn e _ settings -> (Nothing, e) : concatMap typedSetting settings
  Pocket e f settings -> (Nothing, e) : (Just Type.len, f) : concatMap typedSetting settings
  Contour {} -> concatMap typedItem (SyntaxWalk.itemsOf s)
  LetValue _ _ -> []
  LetFunction {} -> []
  Param _ _ -> []
  _ -> [(Nothing, e) | e <- SyntaxWalk.ofStatement s]
  where
    lengths = [(Just Type.len, e) | e <- SyntaxWalk.ofStatement s]

typedItem :: Item -> [(Maybe Type, Expr)]
typedItem i = case value i of
  Element _ e modifiers link ->
    (Nothing, e) :
    concat
      [ case m of
          ElementFeed f -> [(Just Type.feed, f)]
          ElementAllowance a -> [(Just Type.len, a)]
          Bevel a -> [(Just Type.angle, a)]
          Slow -> []
        | Located _ m <- modifiers
      ]
      <> case fmap value link of
        Just (Fillet r) -> [(Just Type.len, r)]
        Just (Chamfer r) -> [(Just Type.len, r)]
        Just (Meet (Just p)) -> [(Nothing, p)]
        _ -> []
  For _ e _ -> [(Nothing, e)]
  Choose e _ _ -> [(Nothing, e)]
  BrokenItem _ -> []

typedSetting :: Setting -> [(Maybe Type, Expr)]
typedSetting s = case value s of
  Plunge e -> [(Just Type.feed, e)]
  Approach _ -> plain
  Retract _ -> plain
  StartNear _ -> plain
  Islands _ -> plain
  _ -> [(Just Type.len, e) | e <- SyntaxWalk.ofSetting s]
  where
    plain = [(Nothing, e) | e <- SyntaxWalk.ofSetting s]
