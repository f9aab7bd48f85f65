-- | Syntax trees without regions: the region of every node is replaced by one fixed region. Two
-- texts that differ only in layout have equal trees without regions.
module Surface.Unlocated
  ( statements,
    expressionAt,
  )
where

import Base.Decimal qualified as Decimal
import Base.NumberTable qualified as NumberTable
import Base.Region (Located (Located), Region (..))
import Data.Bifunctor (bimap)
import Data.List.NonEmpty qualified as NonEmpty
import Font.TextOutline (LetterShape (..))
import Surface.Syntax hiding (statements)

-- | Statements without regions, for the comparison of two texts. Rows of numbers from files become
-- rows of literals.
statements :: [Statement] -> [Statement]
statements = map (unlocated statement)

expr :: Expr -> Expr
expr = expressionAt nowhere

-- | Replaces the region of a node by 'nowhere' and applies @inside@ to its content.
unlocated :: (a -> a) -> Located a -> Located a
unlocated inside (Located _ a) = Located nowhere (inside a)

-- | Replaces the region of a node by 'nowhere', for a node whose content has no regions.
here :: Located a -> Located a
here = unlocated id

lettering :: Lettering -> Lettering
lettering (Lettering text at height course alignment) =
  Lettering (here text) (expr at) (expr height) (courseOf course) alignment
  where
    courseOf c = case c of
      Level -> Level
      Inclined e -> Inclined (expr e)
      Around e side -> Around (expr e) (fmap here side)

letterShape :: LetterShape -> LetterShape
letterShape s = s {shapeLetters = fmap here (shapeLetters s)}

statement :: Statement_ -> Statement_
statement s = case s of
  Part name title -> Part (here name) (fmap here title)
  Units unit -> Units unit
  Machine ref -> Machine (here ref)
  Import file -> Import (here file)
  Tool number c -> Tool (fmap expr number) (unlocated cutter c)
  Feed e -> Feed (expr e)
  Tolerance a -> Tolerance (accuracy a)
  Clearance e -> Clearance (expr e)
  From e -> From (expr e)
  WorkOffset e -> WorkOffset (expr e)
  ProgramNumber e -> ProgramNumber (expr e)
  SafeHeight e -> SafeHeight (expr e)
  Stock e zs -> Stock (expr e) (fmap (bimap expr expr) zs)
  Avoid e zs -> Avoid (expr e) (fmap (bimap expr expr) zs)
  LetValue name e -> LetValue (here name) (expr e)
  LetFunction name parameters e -> LetFunction (here name) (fmap here parameters) (expr e)
  Param name e -> Param (here name) (expr e)
  Contour name closure items -> Contour (here name) (here closure) (map (unlocated item) items)
  Drawn outlines name part -> Drawn outlines (here name) (drawingReference part)
  DrawnText name font text shapes ->
    DrawnText (here name) (here font) (lettering text) (map letterShape shapes)
  Table name ls -> Table (here name) (lines' ls)
  Curve name e -> Curve (here name) (expr e)
  Piece name e cs side joggles ->
    let ciphers = map (unlocated cipher) cs
     in Piece (here name) (expr e) ciphers (here side) (map (unlocated joggle) joggles)
  Assert e within -> Assert (expr e) (fmap expr within)
  Mill e side settings -> Mill (expr e) (here side) (map (unlocated setting) settings)
  Pocket e step own settings ->
    Pocket (expr e) (expr step) (fmap here own) (map (unlocated setting) settings)
  RestOf e step settings -> RestOf (expr e) (expr step) (map (unlocated setting) settings)
  Face e step settings -> Face (expr e) (expr step) (map (unlocated setting) settings)
  Vcarve e own settings -> Vcarve (expr e) (fmap here own) (map (unlocated setting) settings)
  Engrave text settings -> Engrave (lettering text) (map (unlocated setting) settings)
  Turn e side settings -> Turn (expr e) (here side) (map (unlocated setting) settings)
  Drill at depth settings -> Drill (expr at) (expr depth) (map (unlocated setting) settings)
  Hole work at sizes side settings ->
    let sizes' = fmap (fmap expr) sizes
     in Hole work (expr at) sizes' (fmap here side) (map (unlocated setting) settings)
  Travel motion stops -> Travel motion (fmap stop stops)
  Change number c place -> Change (expr number) (unlocated cutter c) (fmap expr place)
  Spindle spin -> Spindle (command spin)
  Coolant switch -> Coolant switch
  Auxiliary e -> Auxiliary (expr e)
  ProgramStop -> ProgramStop
  OptionalStop -> OptionalStop
  Dwell e -> Dwell (expr e)
  Repeat name from inside -> Repeat (here name) (expr from) (statements inside)
  When condition yes no -> When (expr condition) (statements yes) (statements no)
  With e inside -> With (expr e) (statements inside)
  Broken word name -> Broken word (fmap here name)

accuracy :: Accuracy -> Accuracy
accuracy a = case a of
  Within e -> Within (expr e)
  Between inside outside -> Between (expr inside) (expr outside)

command :: Spin -> Spin
command spin = case spin of
  Spinning sense speed limit -> Spinning sense (fmap expr speed) (fmap expr limit)
  SpindleStop -> SpindleStop
  SpindleByHand -> SpindleByHand

lines' :: Lines -> Lines
lines' ls = case ls of
  LinesFromFile file -> LinesFromFile (here file)
  LinesFromDrawing part -> LinesFromDrawing (drawingReference part)
  WrittenLines written -> WrittenLines (concatMap line written)

drawingReference :: DrawingReference -> DrawingReference
drawingReference (DrawingReference file chosen unit within) =
  DrawingReference (here file) (here <$> chosen) (here <$> unit) (expr <$> within)

line :: TableLine -> [TableLine]
line (Located _ l) = map (Located nowhere) $ case l of
  Header columns -> [Header (fmap (\(Heading name unit) -> Heading (here name) unit) columns)]
  Entries cells -> [Entries (fmap cell cells)]
  Numbers rows ->
    [ maybe BrokenLine (Entries . fmap (ValueCell . literal)) (NonEmpty.nonEmpty numbers)
      | k <- [0 .. NumberTable.count rows - 1],
        let numbers = NumberTable.cells rows k
    ]
  BrokenLine -> [BrokenLine]

cell :: Cell -> Cell
cell c = case c of
  ValueCell e -> ValueCell (expr e)
  TextCell t -> TextCell (here t)

-- | A number as an expression: a literal, or for a negative number a negated literal.
literal :: Double -> Expr
literal x
  | x < 0 = Located nowhere (Negate (literal (negate x)))
  | otherwise = Located nowhere (Literal (Numeral (Decimal.exact x) x) Nothing)

-- | The region that replaces all regions of a syntax tree.
nowhere :: Region
nowhere = Region 0 0

cipher :: Cipher_ -> Cipher_
cipher (Cipher digit es) = Cipher (here digit) (fmap expr es)

joggle :: Joggle_ -> Joggle_
joggle (Joggle from to depth radius) = Joggle (expr from) (expr to) (expr depth) (expr radius)

cutter :: Cutter_ -> Cutter_
cutter c = case c of
  MillCutter e sizes -> MillCutter (expr e) (map (unlocated bodySize) sizes)
  DrillCutter e sizes -> DrillCutter (expr e) (map (unlocated bodySize) sizes)
  TapCutter e sizes -> TapCutter (expr e) (map (unlocated bodySize) sizes)
  ThreadMillCutter e pitch sizes ->
    ThreadMillCutter (expr e) (expr pitch) (map (unlocated bodySize) sizes)
  TurningCutter e tip -> TurningCutter (expr e) (fmap expr tip)
  ConeCutter d a h -> ConeCutter (expr d) (expr a) (expr h)
  VBitCutter a t d -> VBitCutter (expr a) (expr t) (expr d)
  BladeCutter d g -> BladeCutter (expr d) (expr g)

bodySize :: BodySize_ -> BodySize_
bodySize s = case s of
  Flutes e -> Flutes (expr e)
  StickOut e -> StickOut (expr e)
  PointAngle e -> PointAngle (expr e)
  HolderCylinder d h -> HolderCylinder (expr d) (fmap expr h)

-- | An expression in which all regions are replaced by the region @at@.
expressionAt :: Region -> Expr -> Expr
expressionAt at (Located _ e) = Located at $ case e of
  Literal number unit -> Literal number unit
  Variable name -> Variable name
  Call name arguments -> Call (moved name) (fmap argument arguments)
  Negate a -> Negate (again a)
  Not a -> Not (again a)
  Binary operator a b -> Binary operator (again a) (again b)
  Range a b step -> Range (again a) (again b) (fmap again step)
  If condition a b -> If (again condition) (again a) (again b)
  Pair a b -> Pair (again a) (again b)
  Triple a b c -> Triple (again a) (again b) (again c)
  List es -> List (map again es)
  Each a name from -> Each (again a) (moved name) (again from)
  where
    again = expressionAt at
    moved (Located _ a) = Located at a
    argument a = case a of
      Given x -> Given (again x)
      Chosen choice x -> Chosen (moved choice) (again x)
      Ranked which -> Ranked (moved which)

item :: Item_ -> Item_
item i = case i of
  Element sense e modifiers link ->
    Element
      (fmap here sense)
      (expr e)
      (map (unlocated modifier) modifiers)
      (fmap (unlocated linked) link)
  For name from inside -> For (here name) (expr from) (map (unlocated item) inside)
  Choose condition yes no ->
    Choose (expr condition) (map (unlocated item) yes) (map (unlocated item) no)
  BrokenItem name -> BrokenItem (fmap here name)

modifier :: Modifier_ -> Modifier_
modifier m = case m of
  ElementFeed e -> ElementFeed (expr e)
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
  Ramp e -> Ramp (expr e)
  Helix p d -> Helix (expr p) (expr <$> d)
  Spiral -> Spiral
  Tabs (TabCount n) w h a -> Tabs (TabCount (expr n)) (expr w) (expr h) (expr <$> a)
  Tabs (TabsAt ps) w h a -> Tabs (TabsAt (fmap expr ps)) (expr w) (expr h) (expr <$> a)
  Peck e -> Peck (expr e)
  Angle e -> Angle (expr e)
  ChipBreak e -> ChipBreak (expr e)
  Pause e -> Pause (expr e)
  TurnPitch e -> TurnPitch (expr e)
  Hand side -> Hand side
  Floating -> Floating
  Islands es -> Islands (fmap expr es)
  ShortestWay -> ShortestWay
  RestAllowed -> RestAllowed
  BrokenSetting -> BrokenSetting

stop :: Stop -> Stop
stop (Stop point pace) = Stop (expr point) $ case pace of
  Cutting -> Cutting
  Rapid -> Rapid
  AtFeed e -> AtFeed (expr e)
