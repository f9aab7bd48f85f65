-- | All nodes of one kind in a syntax tree, for passes that look at all of them.
module Surface.SyntaxWalk
  ( statementsIn,
    blocks,
    definedName,
    itemsOf,
    ofStatement,
    ofSetting,
    parts,
    everywhere,
    mapParts,
    mentionsAny,
    isRadians,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (..))
import Data.Foldable (toList)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (maybeToList)
import Data.Set (Set)
import Data.Set qualified as Set
import Surface.Syntax

-- | True of a number that is computed of @pi@ and of numbers without units by multiplication and
-- division, such as @2 * pi / 3@.
isRadians :: Expr -> Bool
isRadians e = hasPi e && isPlain e
  where
    hasPi x = or [True | Located _ (Variable (Name "pi")) <- everywhere x]
    isPlain (Located _ x) = case x of
      Literal _ Nothing -> True
      Variable (Name "pi") -> True
      Negate y -> isPlain y
      Binary op l r -> op `elem` [Multiply, Divide] && isPlain l && isPlain r
      _ -> False

-- | A statement and all statements in its blocks, the outer ones first.
statementsIn :: Statement -> [Statement]
statementsIn s = s : concatMap statementsIn (blocks s)

-- | The statements in the blocks of a statement.
blocks :: Statement -> [Statement]
blocks (Located _ s) = case s of
  Repeat _ _ body -> body
  When _ body others -> body <> others
  With _ body -> body
  _ -> []

-- | The name that a statement defines, or was to define if it is broken.
definedName :: Statement_ -> Maybe (Located Name)
definedName s = case s of
  LetValue n _ -> Just n
  LetFunction n _ _ -> Just n
  Param n _ -> Just n
  Contour n _ _ -> Just n
  Drawn _ n _ -> Just n
  DrawnText n _ _ _ -> Just n
  Table n _ -> Just n
  Curve n _ -> Just n
  Piece n _ _ _ _ -> Just n
  Pocket _ _ n _ -> n
  Vcarve _ n _ -> n
  Broken _ n -> n
  _ -> Nothing

-- | All items of a contour, those in blocks among them; none of another statement.
itemsOf :: Statement -> [Item]
itemsOf (Located _ s) = case s of
  Contour _ _ items -> concatMap itemsIn items
  _ -> []

itemsIn :: Item -> [Item]
itemsIn i =
  i : case value i of
    Element {} -> []
    For _ _ body -> concatMap itemsIn body
    Choose _ body others -> concatMap itemsIn (body <> others)
    BrokenItem _ -> []

-- | The expressions of a text that is cut that are not parts of other expressions.
ofLettering :: Lettering -> [Expr]
ofLettering Lettering {textPoint, textHeight, course} =
  textPoint :
  textHeight : case course of
    Level -> []
    Inclined e -> [e]
    Around e _ -> [e]

-- | The expressions of a statement that are not parts of other expressions. Those of the statements
-- in its blocks are left out.
ofStatement :: Statement -> [Expr]
ofStatement (Located _ s) = case s of
  Part _ _ -> []
  Units _ -> []
  Machine _ -> []
  Import _ -> []
  Tool number c -> maybeToList number <> ofCutter c
  Feed e -> [e]
  Tolerance (Within e) -> [e]
  Tolerance (Between a b) -> [a, b]
  Clearance e -> [e]
  From e -> [e]
  WorkOffset e -> [e]
  ProgramNumber e -> [e]
  SafeHeight e -> [e]
  Stock e zs -> e : ofHeights zs
  Avoid e zs -> e : ofHeights zs
  LetValue _ e -> [e]
  LetFunction _ _ e -> [e]
  Param _ e -> [e]
  Contour _ _ items -> concatMap ofItem items
  Drawn _ _ part -> maybeToList (joinedWithin part)
  DrawnText _ _ text _ -> ofLettering text
  Table _ (WrittenLines ls) -> concatMap ofLine ls
  Table _ (LinesFromFile _) -> []
  Table _ (LinesFromDrawing part) -> maybeToList (joinedWithin part)
  Curve _ e -> [e]
  Piece _ e ciphers _ joggles -> e : concatMap ofCipher ciphers <> concatMap ofJoggle joggles
  Assert e within -> e : maybeToList within
  Mill e _ settings -> e : concatMap ofSetting settings
  Pocket e stepover _ settings -> e : stepover : concatMap ofSetting settings
  RestOf e stepover settings -> e : stepover : concatMap ofSetting settings
  Face e stepover settings -> e : stepover : concatMap ofSetting settings
  Engrave text settings -> ofLettering text <> concatMap ofSetting settings
  Vcarve e _ settings -> e : concatMap ofSetting settings
  Turn e _ settings -> e : concatMap ofSetting settings
  Drill e deep settings -> e : deep : concatMap ofSetting settings
  Hole _ e sizes _ settings -> e : map snd sizes <> concatMap ofSetting settings
  Travel _ stops -> concatMap ofStop (NonEmpty.toList stops)
  Change e c place -> e : ofCutter c <> maybeToList place
  Spindle spin -> ofSpin spin
  Coolant _ -> []
  Auxiliary e -> [e]
  ProgramStop -> []
  OptionalStop -> []
  Dwell e -> [e]
  Repeat _ e _ -> [e]
  When e _ _ -> [e]
  With e _ -> [e]
  Broken _ _ -> []

-- | Speed of a spindle statement, if it has one.
ofSpin :: Spin -> [Expr]
ofSpin spin = case spin of
  Spinning _ speed limit -> maybeToList speed <> maybeToList limit
  SpindleStop -> []
  SpindleByHand -> []

-- | An expression and all its parts.
everywhere :: Expr -> [Expr]
everywhere e = e : concatMap everywhere (parts e)

-- | The expressions directly in an expression.
parts :: Expr -> [Expr]
parts (Located _ e) = case e of
  Literal _ _ -> []
  Variable _ -> []
  Call _ arguments -> concatMap ofArgument (NonEmpty.toList arguments)
  Negate a -> [a]
  Not a -> [a]
  Binary _ a b -> [a, b]
  Range a b step -> a : b : maybeToList step
  If a b c -> [a, b, c]
  Pair a b -> [a, b]
  Triple a b c -> [a, b, c]
  List es -> es
  Each a _ list -> [a, list]

-- | An expression with a function applied to the expressions directly in it.
mapParts :: (Expr -> Expr) -> Expr -> Expr
mapParts f (Located at e) = Located at $ case e of
  Literal _ _ -> e
  Variable _ -> e
  Call name arguments -> Call name (fmap argument arguments)
  Negate a -> Negate (f a)
  Not a -> Not (f a)
  Binary op a b -> Binary op (f a) (f b)
  Range a b step -> Range (f a) (f b) (fmap f step)
  If a b c -> If (f a) (f b) (f c)
  Pair a b -> Pair (f a) (f b)
  Triple a b c -> Triple (f a) (f b) (f c)
  List es -> List (map f es)
  Each a n list -> Each (f a) n (f list)
  where
    argument a = case a of
      Given x -> Given (f x)
      Chosen selector x -> Chosen selector (f x)
      Ranked rank -> Ranked rank

-- | True if an expression in a statement or in its blocks is one of the names, or calls it.
mentionsAny :: Set Name -> Statement -> Bool
mentionsAny names s =
  or
    [ True
      | s' <- statementsIn s,
        Located _ e <- concatMap everywhere (ofStatement s'),
        isNamed e
    ]
  where
    isNamed e = case e of
      Variable n -> Set.member n names
      Call n _ -> Set.member (value n) names
      _ -> False

ofArgument :: Argument -> [Expr]
ofArgument a = case a of
  Given e -> [e]
  Chosen _ e -> [e]
  Ranked _ -> []

ofCutter :: Cutter -> [Expr]
ofCutter (Located _ c) = case c of
  MillCutter e sizes -> e : concatMap ofBodySize sizes
  DrillCutter e sizes -> e : concatMap ofBodySize sizes
  TapCutter e sizes -> e : concatMap ofBodySize sizes
  ThreadMillCutter e pitch sizes -> e : pitch : concatMap ofBodySize sizes
  TurningCutter e tip -> e : maybeToList tip
  ConeCutter a b d -> [a, b, d]
  VBitCutter a b d -> [a, b, d]
  BladeCutter a b -> [a, b]

ofBodySize :: BodySize -> [Expr]
ofBodySize (Located _ s) = case s of
  Flutes e -> [e]
  StickOut e -> [e]
  PointAngle e -> [e]
  HolderCylinder d h -> d : maybeToList h

ofHeights :: Maybe (Expr, Expr) -> [Expr]
ofHeights = maybe [] (\(a, b) -> [a, b])

ofItem :: Item -> [Expr]
ofItem (Located _ i) = case i of
  Element _ e modifiers link -> e : concatMap ofModifier modifiers <> concatMap ofLink link
  For _ e items -> e : concatMap ofItem items
  Choose e items others -> e : concatMap ofItem (items <> others)
  BrokenItem _ -> []

ofModifier :: Modifier -> [Expr]
ofModifier (Located _ m) = case m of
  ElementFeed e -> [e]
  Slow -> []
  ElementAllowance e -> [e]
  Bevel e -> [e]

ofLink :: Link -> [Expr]
ofLink (Located _ l) = case l of
  Meet e -> maybeToList e
  Smooth -> []
  Tangent -> []
  Fillet e -> [e]
  Chamfer e -> [e]

ofLine :: TableLine -> [Expr]
ofLine (Located _ l) = case l of
  Header _ -> []
  Entries cells -> [e | ValueCell e <- NonEmpty.toList cells]
  Numbers _ -> []
  BrokenLine -> []

ofCipher :: Cipher -> [Expr]
ofCipher (Located _ (Cipher _ es)) = NonEmpty.toList es

ofJoggle :: Joggle -> [Expr]
ofJoggle (Located _ (Joggle a b d r)) = [a, b, d, r]

-- | The expressions of a setting that are not parts of other expressions.
ofSetting :: Setting -> [Expr]
ofSetting (Located _ s) = case s of
  Approach stops -> concatMap ofStop (NonEmpty.toList stops)
  Retract stops -> concatMap ofStop (NonEmpty.toList stops)
  Depth a b -> a : maybeToList b
  LeadBy _ _ e -> [e]
  Allowances es -> NonEmpty.toList es
  CornerStyle _ -> []
  CutBy _ -> []
  CompensationBy _ -> []
  StartNear e -> [e]
  Plunge e -> [e]
  Ramp e -> [e]
  Helix p d -> p : toList d
  Spiral -> []
  Tabs (TabCount n) w h a -> [n, w, h] <> toList a
  Tabs (TabsAt ps) w h a -> toList ps <> [w, h] <> toList a
  Peck e -> [e]
  ShortestWay -> []
  Angle e -> [e]
  ChipBreak e -> [e]
  Pause e -> [e]
  TurnPitch e -> [e]
  Hand _ -> []
  Floating -> []
  Islands es -> NonEmpty.toList es
  RestAllowed -> []
  BrokenSetting -> []

ofStop :: Stop -> [Expr]
ofStop (Stop e atPace) = case atPace of
  Cutting -> [e]
  Rapid -> [e]
  AtFeed f -> [e, f]
