-- | Numbers that a program writes without a unit, with the types that they get from their places.
module Checked.BareNumber
  ( typesOfNames,
    bareNumbers,
    besideInches,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (Name))
import Base.Region (Located (..), Region (..))
import Checked.Builtin (Form (..))
import Checked.Builtin qualified as Builtin
import Checked.Dimension qualified as Dimension
import Checked.Syntax (Mention (Mention, definition, place, typing), MentionType (OfValue))
import Checked.Type (Type (ListOf))
import Checked.Type qualified as Type
import Data.Foldable (toList)
import Data.List (nub)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Fix qualified as Fix
import Report.Report (Label (Label), Report (fixes, others), ReportPlace (InSource), report)
import Report.Report qualified as Report
import Surface.FileUnit qualified as FileUnit
import Surface.Syntax
import Surface.SyntaxWalk qualified as SyntaxWalk
import Surface.Token (Unit (FtPerMin, InPerMin, Inch))

-- | The types of the values that a program names, by the regions of their definitions.
typesOfNames :: [Mention] -> Map Region Type
typesOfNames mentions =
  Map.fromList
    [ (place, t)
      | Mention {place, definition = Just d, typing = OfValue t} <- mentions,
        d == place
    ]

-- | The numbers without a unit in a statement, outside of the blocks of statements in it, each with
-- its type if its place decides it. @typeAt@ is the result of 'typesOfNames'.
bareNumbers :: Map Region Type -> Statement -> [(Expr, Type)]
bareNumbers typeAt s = case value s of
  LetValue n e -> bare (Map.lookup (region n) typeAt) e
  Param n e -> bare (Map.lookup (region n) typeAt) e
  _ -> concat [bare t e | (t, e) <- typedExpressions s]

-- | Warnings about numbers without a unit that are taken for mm or mm/min, in files that give other
-- numbers in inches: one for each file, at the first such number. Files that give their unit have
-- none. A number 0 is the same in every unit. @fileOf@ is the file of a region, and @typeAt@ is the
-- result of 'typesOfNames'.
besideInches :: Ord file => (Region -> file) -> Map Region Type -> Program -> [Report]
besideInches fileOf typeAt program
  | null inches = []
  | otherwise =
    Map.elems (Map.intersectionWith warned (byFile region numbers) (byFile id inches))
  where
    warned found@(Located at _ :| _)
      | fileOf at == fileOf (Region 0 0) = warning (unitsPlace program) found
      | otherwise = warning Nothing found
    statements' = concatMap SyntaxWalk.statementsIn (statements program)
    numbers =
      [ Located at (BareNumber digits t)
        | s <- statements',
          (Located at (Literal Numeral {digits, amount} Nothing), t) <- bareNumbers typeAt s,
          amount /= 0,
          not (FileUnit.isGivenAt program at),
          t == Type.len || t == Type.feed
      ]
    inches =
      [ at
        | s <- statements',
          e <- SyntaxWalk.ofStatement s,
          Located at (Literal _ (Just unit)) <- SyntaxWalk.everywhere e,
          unit `elem` [Inch, InPerMin, FtPerMin]
      ]
    byFile place found =
      Map.map
        (NonEmpty.sortWith place)
        (Map.fromListWith (<>) [(fileOf (place x), x :| []) | x <- found])

-- | A length or a feed without a unit: its digits and its type.
data BareNumber = BareNumber Text Type

-- | The offset in the program's own file at which a @units@ statement belongs.
unitsPlace :: Program -> Maybe Int
unitsPlace program = case statements program of
  Located _ (Part _ _) : below : _ -> Just (start (region below))
  Located _ (Part _ _) : _ -> Nothing
  first : _ -> Just (start (region first))
  [] -> Nothing

-- | The warning about numbers of a file that are taken for mm or mm/min. @inches@ are the regions
-- of its numbers in inches. @place@ is the offset for a @units@ statement, if there is one.
warning :: Maybe Int -> NonEmpty (Located BareNumber) -> NonEmpty Region -> Report
warning place numbers@(Located at (BareNumber digits t) :| more) (inch :| _) =
  ( report
      Report.Warning
      "W0201"
      (InSource at)
      ( digits <> " is taken for " <> digits <> " " <> unitOf "mm" t
          <> ", and other numbers are in inches"
      )
  )
    { others = [Label inch "in inches"],
      fixes = map written ["mm", "in"] <> concatMap stated ["mm", "in"]
    }
  where
    stated unit =
      [ Fix.proposed $
          Fix.insertion
            ("Write units " <> unit <> " below part.")
            offset
            ("units " <> unit <> "\n")
        | Just offset <- [place]
      ]
    written unit =
      Fix.proposed $
        Fix.joined
          (title unit)
          [ Fix.insertion "" (end place') (" " <> unitOf unit t')
            | Located place' (BareNumber _ t') <- NonEmpty.toList numbers
          ]
    title unit
      | null more = "Write its unit: " <> digits <> " " <> unitOf unit t <> "."
      | otherwise =
        "Write " <> Text.intercalate " and " (mapMaybe (after unit) counts) <> " without a unit."
    after unit (n, noun, t') = case n of
      0 -> Nothing
      1 -> Just (unitOf unit t' <> " after the " <> noun)
      _ -> Just (unitOf unit t' <> " after the " <> Decimal.whole n <> " " <> noun <> "s")
    counts = [(countOf Type.len, "length", Type.len), (countOf Type.feed, "feed", Type.feed)]
    countOf t' = length [() | Located _ (BareNumber _ u) <- NonEmpty.toList numbers, u == t']
    unitOf unit t' = if t' == Type.feed then unit <> "/min" else unit

-- | The numbers without a unit in an expression of this type.
bare :: Maybe Type -> Expr -> [(Expr, Type)]
bare t e = case value e of
  Literal _ Nothing -> [(e, found) | Just found <- [t]]
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
parameterTypes :: Name -> NonEmpty Argument -> [Maybe Type]
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

-- | The expressions of a statement with the types that its grammar demands; 'Nothing' where it
-- demands none. Definitions of values are left out.
typedExpressions :: Statement -> [(Maybe Type, Expr)]
typedExpressions s = case value s of
  Feed e -> [(Just Type.feed, e)]
  Clearance e -> [(Just Type.len, e)]
  Tolerance _ -> lengths
  SafeHeight e -> [(Just Type.len, e)]
  Stock e zs -> (Nothing, e) : typedHeights zs
  Avoid e zs -> (Nothing, e) : typedHeights zs
  Tool _ _ -> []
  Change _ _ place -> [(Nothing, e) | Just e <- [place]]
  Spindle _ -> [(Just Type.spindleSpeed, e) | e <- SyntaxWalk.ofStatement s]
  Drill e f settings -> (Nothing, e) : (Just Type.len, f) : concatMap typedSetting settings
  Hole _ e sizes _ settings ->
    (Nothing, e) :
    [(Just (if size == HoleAngle then Type.angle else Type.len), x) | (size, x) <- sizes]
      <> concatMap typedSetting settings
  Mill e _ settings -> (Nothing, e) : concatMap typedSetting settings
  Turn e _ settings -> (Nothing, e) : concatMap typedSetting settings
  Pocket e f _ settings -> (Nothing, e) : (Just Type.len, f) : concatMap typedSetting settings
  RestOf e f settings -> (Nothing, e) : (Just Type.len, f) : concatMap typedSetting settings
  Face e f settings -> (Nothing, e) : (Just Type.len, f) : concatMap typedSetting settings
  DrawnText _ _ text _ -> typedLettering text
  Vcarve e _ settings -> (Nothing, e) : concatMap typedSetting settings
  Engrave text settings -> typedLettering text <> concatMap typedSetting settings
  Contour {} -> concatMap typedItem (SyntaxWalk.itemsOf s)
  LetValue _ _ -> []
  LetFunction {} -> []
  Param _ _ -> []
  _ -> [(Nothing, e) | e <- SyntaxWalk.ofStatement s]
  where
    lengths = [(Just Type.len, e) | e <- SyntaxWalk.ofStatement s]
    typedHeights zs = [(Just Type.len, z) | Just (a, b) <- [zs], z <- [a, b]]

typedLettering :: Lettering -> [(Maybe Type, Expr)]
typedLettering Lettering {textPoint, textHeight, course} =
  (Nothing, textPoint) :
  (Just Type.len, textHeight) : case course of
    Level -> []
    Inclined e -> [(Just Type.angle, e)]
    Around e _ -> [(Nothing, e)]

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
  Ramp e -> [(Just Type.angle, e)]
  Tabs places width height angle ->
    [(Nothing, e) | e <- placed places]
      <> [(Just Type.len, width), (Just Type.len, height)]
      <> [(Just Type.angle, e) | e <- toList angle]
  Approach _ -> plain
  Retract _ -> plain
  StartNear _ -> plain
  Islands _ -> plain
  Angle e -> [(Just Type.angle, e)]
  Pause _ -> plain
  _ -> [(Just Type.len, e) | e <- SyntaxWalk.ofSetting s]
  where
    plain = [(Nothing, e) | e <- SyntaxWalk.ofSetting s]
    placed places = case places of
      TabCount n -> [n]
      TabsAt ps -> toList ps
