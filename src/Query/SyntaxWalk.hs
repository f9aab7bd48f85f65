-- | All nodes of one kind in a syntax tree.
module Query.SyntaxWalk
  ( inside,
    links,
    elementsOf,
    blocks,
    expressions,
    subexpressions,
    regionsAround,
    typedExpressions,
  )
where

import Base.Region (Located (..), Region (..))
import Checked.Type (Type)
import Checked.Type qualified as Type
import Data.List.NonEmpty qualified as NonEmpty
import Surface.Syntax

-- | A statement and all statements in its blocks, the outer ones first.
inside :: Statement -> [Statement]
inside s = s : concatMap inside (blocks s)

-- | The statements in the blocks of a statement.
blocks :: Statement -> [Statement]
blocks (Located _ s) = case s of
  Repeat _ _ body -> body
  When _ body others -> body <> others
  With _ body -> body
  _ -> []

-- | All links of the contours in a statement.
links :: Statement -> [Link]
links s = [l | Located _ (Element _ _ _ (Just l)) <- elementsOf s]

-- | All items of the contours in a statement, those in blocks among them.
elementsOf :: Statement -> [Item]
elementsOf s = concat [concatMap items is | Located _ (Contour _ _ is) <- inside s]
  where
    items i =
      i : case value i of
        For _ _ body -> concatMap items body
        Choose _ body others -> concatMap items (body <> others)
        Element {} -> []
        BrokenItem _ -> []

-- | The outermost expressions of a statement, without those in its blocks.
expressions :: Statement -> [Expr]
expressions s = case value s of
  Tool c -> cutter c
  Feed e -> [e]
  Tolerance (Within e) -> [e]
  Tolerance (Between a b) -> [a, b]
  Clearance e -> [e]
  From e -> [e]
  LetValue _ e -> [e]
  LetFunction _ _ e -> [e]
  Param _ e -> [e]
  Contour {} -> concatMap item (elementsOf s)
  Curve _ e -> [e]
  Piece _ e ciphers _ joggles ->
    e :
    concat [NonEmpty.toList es | Located _ (Cipher _ es) <- ciphers]
      <> concat [[a, b, c, d] | Located _ (Joggle a b c d) <- joggles]
  Assert e within -> e : maybe [] pure within
  Mill e _ settings -> e : concatMap setting settings
  Pocket e f settings -> e : f : concatMap setting settings
  Turn e _ settings -> e : concatMap setting settings
  Drill e f settings -> e : f : concatMap setting settings
  Travel _ stops -> concatMap stop (NonEmpty.toList stops)
  Change e c -> e : cutter c
  Spindle (Spinning _ e) -> maybe [] pure e
  Spindle SpindleStop -> []
  Auxiliary e -> [e]
  Repeat _ e _ -> [e]
  When e _ _ -> [e]
  With e _ -> [e]
  _ -> []

item :: Item -> [Expr]
item (Located _ i) = case i of
  Element _ e modifiers link -> e : concatMap modifier modifiers <> maybe [] linked link
  For _ e _ -> [e]
  Choose e _ _ -> [e]
  BrokenItem _ -> []
  where
    modifier m = case value m of
      ElementFeed e -> [e]
      ElementAllowance e -> [e]
      Bevel e -> [e]
      Slow -> []
    linked l = case value l of
      Meet e -> maybe [] pure e
      Fillet e -> [e]
      Chamfer e -> [e]
      Smooth -> []
      Tangent -> []

cutter :: Cutter -> [Expr]
cutter (Located _ c) = case c of
  MillCutter e -> [e]
  DrillCutter e -> [e]
  TurningCutter e -> [e]
  ConeCutter d a h -> [d, a, h]
  BladeCutter d g -> [d, g]

setting :: Setting -> [Expr]
setting (Located _ s) = case s of
  Approach stops -> concatMap stop (NonEmpty.toList stops)
  Retract stops -> concatMap stop (NonEmpty.toList stops)
  Depth e f -> e : maybe [] pure f
  LeadBy _ _ e -> [e]
  Allowances es -> NonEmpty.toList es
  StartNear e -> [e]
  Plunge e -> [e]
  Peck e -> [e]
  Islands es -> NonEmpty.toList es
  CornerStyle _ -> []
  CutBy _ -> []
  CompensationBy _ -> []
  RestAllowed -> []
  BrokenSetting -> []

stop :: Stop -> [Expr]
stop (Stop e pace) =
  e : case pace of
    AtFeed f -> [f]
    Cutting -> []
    Rapid -> []

-- | The expressions directly in an expression.
subexpressions :: Expr -> [Expr]
subexpressions (Located _ e) = case e of
  Literal _ _ -> []
  Variable _ -> []
  Call _ arguments ->
    concat
      [ case a of
          Given x -> [x]
          Chosen _ x -> [x]
          Ranked _ -> []
        | a <- NonEmpty.toList arguments
      ]
  Negate a -> [a]
  Not a -> [a]
  Binary _ a b -> [a, b]
  Range a b c -> a : b : maybe [] pure c
  If a b c -> [a, b, c]
  Pair a b -> [a, b]
  Triple a b c -> [a, b, c]
  List es -> es
  Each a _ b -> [a, b]

-- | The regions of all nodes of a statement that contain an offset, the outermost first.
regionsAround :: Int -> Statement -> [Region]
regionsAround at s
  | not (contains (region s)) = []
  | otherwise =
    region s :
    concatMap (regionsAround at) (blocks s)
      <> [region i | i <- elementsOf s, contains (region i)]
      <> settings
      <> concatMap inExpression (expressions s)
  where
    contains (Region a b) = a <= at && at <= b
    inExpression e
      | contains (region e) = region e : concatMap inExpression (subexpressions e)
      | otherwise = []
    settings = case value s of
      Mill _ _ ss -> [region x | x <- ss, contains (region x)]
      Pocket _ _ ss -> [region x | x <- ss, contains (region x)]
      Turn _ _ ss -> [region x | x <- ss, contains (region x)]
      Drill _ _ ss -> [region x | x <- ss, contains (region x)]
      _ -> []

-- | The expressions of a statement with the types that its grammar demands; 'Nothing' where it
-- demands none. Definitions of values are left out.
typedExpressions :: Statement -> [(Maybe Type, Expr)]
typedExpressions s = case value s of
  Feed e -> [(Just Type.feed, e)]
  Clearance e -> [(Just Type.len, e)]
  Tolerance _ -> lengths
  Tool _ -> []
  Change _ _ -> []
  Spindle _ -> [(Just Type.spindleSpeed, e) | e <- expressions s]
  Drill e f settings -> (Nothing, e) : (Just Type.len, f) : concatMap typedSetting settings
  Mill e _ settings -> (Nothing, e) : concatMap typedSetting settings
  Turn e _ settings -> (Nothing, e) : concatMap typedSetting settings
  Pocket e f settings -> (Nothing, e) : (Just Type.len, f) : concatMap typedSetting settings
  Contour {} -> concatMap typedItem (elementsOf s)
  LetValue _ _ -> []
  LetFunction {} -> []
  Param _ _ -> []
  _ -> [(Nothing, e) | e <- expressions s]
  where
    lengths = [(Just Type.len, e) | e <- expressions s]

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
  _ -> [(Nothing, e) | e <- item i]

typedSetting :: Setting -> [(Maybe Type, Expr)]
typedSetting s = case value s of
  Plunge e -> [(Just Type.feed, e)]
  Approach _ -> plain
  Retract _ -> plain
  StartNear _ -> plain
  Islands _ -> plain
  _ -> [(Just Type.len, e) | e <- setting s]
  where
    plain = [(Nothing, e) | e <- setting s]
