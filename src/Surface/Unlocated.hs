-- | Trees without places, for those who ask whether two texts mean the same.
module Surface.Unlocated
  ( statements,
  )
where

import Base.Decimal qualified as Decimal
import Base.NumberTable qualified as NumberTable
import Base.Region (Located (Located), Region (..))
import Data.List.NonEmpty qualified as NonEmpty
import Surface.Syntax hiding (statements)

-- | Statements, all at one place.
statements :: [Statement] -> [Statement]
statements = map (moved statement)

-- | An expression, all of it at one place.
expr :: Expr -> Expr
expr = moved expression

moved :: (a -> a) -> Located a -> Located a
moved inside (Located _ a) = Located nowhere (inside a)

here :: Located a -> Located a
here = moved id

statement :: Statement_ -> Statement_
statement s = case s of
  Part name title -> Part (here name) (fmap here title)
  Machine ref -> Machine (here ref)
  Import file -> Import (here file)
  Tool c -> Tool (moved cutter c)
  Feed e -> Feed (expr e)
  Tolerance (Within e) -> Tolerance (Within (expr e))
  Tolerance (Between a b) -> Tolerance (Between (expr a) (expr b))
  Clearance e -> Clearance (expr e)
  From e -> From (expr e)
  LetValue name e -> LetValue (here name) (expr e)
  LetFunction name parameters e -> LetFunction (here name) (fmap here parameters) (expr e)
  Param name e -> Param (here name) (expr e)
  Contour name closure items -> Contour (here name) closure (map (moved item) items)
  Table name (LinesOf file) -> Table (here name) (LinesOf (here file))
  Table name (WrittenLines ls) -> Table (here name) (WrittenLines (concatMap line ls))
  Curve name e -> Curve (here name) (expr e)
  Piece name e ciphers side joggles ->
    Piece (here name) (expr e) (map (moved cipher) ciphers) (here side) (map (moved joggle) joggles)
  Assert e within -> Assert (expr e) (fmap expr within)
  Mill e side settings -> Mill (expr e) (here side) (map (moved setting) settings)
  Pocket e step settings -> Pocket (expr e) (expr step) (map (moved setting) settings)
  Turn e side settings -> Turn (expr e) (here side) (map (moved setting) settings)
  Drill at depth settings -> Drill (expr at) (expr depth) (map (moved setting) settings)
  Travel motion stops -> Travel motion (fmap stop stops)
  Change place c -> Change (expr place) (moved cutter c)
  Spindle (Spinning sense speed) -> Spindle (Spinning sense (fmap expr speed))
  Spindle Still -> Spindle Still
  Coolant switch -> Coolant switch
  Auxiliary e -> Auxiliary (expr e)
  Repeat name from inside -> Repeat (here name) (expr from) (statements inside)
  When condition yes no -> When (expr condition) (statements yes) (statements no)
  With e inside -> With (expr e) (statements inside)
  Broken word name -> Broken word (fmap here name)

line :: TableLine -> [TableLine]
line (Located _ l) = map (Located nowhere) $ case l of
  Header columns -> [Header (fmap (\(Heading name unit) -> Heading (here name) unit) columns)]
  Entries es -> [Entries (fmap expr es)]
  Numbers rows ->
    [ maybe BrokenLine Entries (NonEmpty.nonEmpty (map bare (NumberTable.cells rows k)))
      | k <- [0 .. NumberTable.count rows - 1]
    ]
  BrokenLine -> [BrokenLine]

-- | A number as it is written in a program.
bare :: Double -> Expr
bare x
  | x < 0 = Located nowhere (Negate (bare (negate x)))
  | otherwise = Located nowhere (Literal (Numeral (Decimal.exact x) x) Nothing)

nowhere :: Region
nowhere = Region 0 0

cipher :: Cipher_ -> Cipher_
cipher (Cipher digit es) = Cipher (here digit) (fmap expr es)

joggle :: Joggle_ -> Joggle_
joggle (Joggle from to depth radius) = Joggle (expr from) (expr to) (expr depth) (expr radius)

cutter :: Cutter_ -> Cutter_
cutter c = case c of
  MillCutter e -> MillCutter (expr e)
  DrillCutter e -> DrillCutter (expr e)
  TurningCutter e -> TurningCutter (expr e)
  ConeCutter d a h -> ConeCutter (expr d) (expr a) (expr h)
  BladeCutter d g -> BladeCutter (expr d) (expr g)

expression :: Expr_ -> Expr_
expression e = case e of
  Literal number unit -> Literal number unit
  Variable name -> Variable name
  Call name arguments -> Call (here name) (fmap argument arguments)
  Negate a -> Negate (expr a)
  Not a -> Not (expr a)
  Binary operator a b -> Binary operator (expr a) (expr b)
  Range a b step -> Range (expr a) (expr b) (fmap expr step)
  If condition a b -> If (expr condition) (expr a) (expr b)
  Pair a b -> Pair (expr a) (expr b)
  Triple a b c -> Triple (expr a) (expr b) (expr c)
  List es -> List (map expr es)
  Each a name from -> Each (expr a) (here name) (expr from)

argument :: Argument -> Argument
argument a = case a of
  Given e -> Given (expr e)
  Chosen choice e -> Chosen (here choice) (expr e)
  Ranked which -> Ranked (here which)

item :: Item_ -> Item_
item i = case i of
  Element sense e modifiers link ->
    Element (fmap here sense) (expr e) (map (moved modifier) modifiers) (fmap (moved linked) link)
  For name from inside -> For (here name) (expr from) (map (moved item) inside)
  Choose condition yes no -> Choose (expr condition) (map (moved item) yes) (map (moved item) no)
  BrokenItem name -> BrokenItem (fmap here name)

modifier :: Modifier_ -> Modifier_
modifier m = case m of
  AtElementFeed e -> AtElementFeed (expr e)
  Slow -> Slow
  ElementAllowance e -> ElementAllowance (expr e)
  Bevel e -> Bevel (expr e)

linked :: Link_ -> Link_
linked l = case l of
  Meet near -> Meet (fmap expr near)
  Smooth -> Smooth
  Tangent -> Tangent
  Fillet e -> Fillet (expr e)
  Chamfer e -> Chamfer (expr e)

setting :: Setting_ -> Setting_
setting s = case s of
  Approach stops -> Approach (fmap stop stops)
  Retract stops -> Retract (fmap stop stops)
  Depth e step -> Depth (expr e) (fmap expr step)
  LeadBy lead form e -> LeadBy lead form (expr e)
  Allowances es -> Allowances (fmap expr es)
  CornerStyle style -> CornerStyle style
  CutBy sense -> CutBy sense
  CompensationBy who -> CompensationBy who
  StartNear p -> StartNear (expr p)
  Plunge e -> Plunge (expr e)
  Peck e -> Peck (expr e)
  Islands es -> Islands (fmap expr es)
  RestAllowed -> RestAllowed
  BrokenSetting -> BrokenSetting

stop :: Stop -> Stop
stop (Stop point pace) = Stop (expr point) $ case pace of
  Cutting -> Cutting
  Rapid -> Rapid
  AtFeed e -> AtFeed (expr e)
