-- | The syntax tree of a checked program.
--
-- Every name is resolved and every term has the right type. All numbers are in mm, radians, minutes
-- and turns. Statements that contain a mistake are left out. A type whose name ends in an
-- underscore has no region; the type without the underscore adds it.
module Checked.Syntax
  ( Program (..),
    Mention (..),
    MentionType (..),
    Statement,
    Statement_ (..),
    Cutter,
    Cutter_ (..),
    BodySize,
    BodySize_ (..),
    Columns (..),
    PointColumns (..),
    VisitOrder (..),
    Cells (..),
    Cipher,
    Cipher_ (..),
    Joggle,
    Joggle_ (..),
    Accuracy (..),
    Spin (..),
    Engraving (..),
    TextLine (..),
    TextPlace (..),
    Assertion (..),
    Settings (..),
    DescentForm (..),
    Tabs (..),
    TabPlaces (..),
    Expr,
    Expr_ (..),
    namesIn,
    Argument (..),
    Item,
    Item_ (..),
    Modifier,
    Modifier_ (..),
    Link,
    Link_ (..),
    CutFeedExpr (..),
    Stop (..),
    Pace (..),
    Builtin (..),

    -- * As in the surface syntax
    Selector (..),
    Closure (..),
    Corners (..),
    Compensation (..),
    CutSense (..),
    Lead (..),
    LeadForm (..),
    HoleWork (..),
    HoleSize (..),
    TextAlignment (..),
    MachineRef (..),
    Operator (..),
    Rank (..),
    Side (..),
    Switch (..),
    Sense (..),
  )
where

import Base.Name (Name)
import Base.NumberTable (NumberTable)
import Base.Quantity (LengthUnit)
import Base.Region (Located (..), Region)
import Checked.Dimension (Dimension)
import Checked.Type (Type)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Font.TextOutline (LetterShape)
import Surface.Syntax
  ( Closure (..),
    Compensation (..),
    Corners (..),
    CutSense (..),
    HoleSize (..),
    HoleWork (..),
    Lead (..),
    LeadForm (..),
    MachineRef (..),
    Operator (..),
    Rank (..),
    Selector (..),
    Sense (..),
    Side (..),
    Switch (..),
    TextAlignment (..),
  )

-- | A checked program.
data Program = Program
  { name :: Maybe Name,
    title :: Maybe Text,
    machine :: Maybe (Located MachineRef),
    -- | the unit in which reports about the program give lengths
    unit :: LengthUnit,
    statements :: [Statement],
    -- | all mentions of names, in no particular order
    mentions :: [Mention]
  }
  deriving stock (Eq, Show)

-- | A name where it is defined or used. 'definition' is the region of its definition, or 'Nothing'
-- for a built-in name. 'meaning' describes the name in words, for editors.
data Mention = Mention
  { place :: Region,
    definition :: Maybe Region,
    word :: Text,
    meaning :: Text,
    typing :: MentionType
  }
  deriving stock (Eq, Show)

-- | The type of a mentioned name. In it, every type and dimension that inference has not found is
-- the unknown with the number 0.
data MentionType
  = -- | a value: its type
    OfValue Type
  | -- | a function of the program: its parameters with their types, and the type of its result
    OfFunction [(Text, Type)] Type
  | -- | a name without a type: a name of the language, or the name of the part
    Untyped
  deriving stock (Eq, Show)

-- | A statement of the checked program, with its region.
type Statement = Located Statement_

-- | A statement. Imports do not occur, because the imported definitions have replaced them.
data Statement_
  = -- | the number of the tool, if the program gives one, and the tool
    Tool (Maybe Expr) Cutter
  | Feed CutFeedExpr
  | Tolerance Accuracy
  | Clearance Expr
  | From Expr
  | -- | the number of the work offset
    WorkOffset Expr
  | ProgramNumber Expr
  | SafeHeight Expr
  | -- | the region, and the heights of its bottom and of its top in mm
    Stock Expr (Maybe (Expr, Expr))
  | -- | a region in which no tool may be, and the heights of its bottom and of its top in mm
    Avoid Expr (Maybe (Expr, Expr))
  | -- | the name, the dimension of the quantities in the value, and the expression of the value
    LetValue (Located Name) Dimension Expr
  | LetFunction Name (NonEmpty Name) Expr
  | Table (Located Name) Columns
  | -- | the name, the curve, the ciphers, the side to which they shift the curve, and the joggles
    Piece (Located Name) Expr [Cipher] (Located Side) [Joggle]
  | Contour (Located Name) (Located Closure) [Item]
  | -- | a text in a font: the name of its region, its place, and the shapes of its letters
    Letters (Located Name) TextPlace [LetterShape]
  | Assert Assertion
  | Mill Expr (Located Side) Settings
  | -- | the contour, the stepover in mm, the name of the operation, and the settings
    Pocket Expr Expr (Maybe (Located Name)) Settings
  | -- | the operation that left the material, the stepover in mm, and the settings
    RestOf Expr Expr Settings
  | -- | the region to clear, the stepover in mm, and the settings
    Face Expr Expr Settings
  | -- | the text, and the settings
    Engrave Engraving Settings
  | -- | the region to carve, the name of the operation, and the settings
    Vcarve Expr (Maybe (Located Name)) Settings
  | Turn Expr (Located Side) Settings
  | -- | the point or the list of points, the depth in mm, and the settings
    Drill Expr Expr Settings
  | -- | the work, the point or the list of points, the sizes in mm and radians, the side of a
    -- thread, and the settings
    Hole HoleWork Expr [(HoleSize, Expr)] (Maybe (Located Side)) Settings
  | Travel (NonEmpty Stop)
  | -- | the number of the tool, the tool, and the point at which it is changed
    Change Expr Cutter (Maybe Expr)
  | -- | a tool change with a mistake: the tool is unknown from here on
    UnknownChange
  | Spindle Spin
  | Coolant Switch
  | Auxiliary Expr
  | ProgramStop
  | OptionalStop
  | -- | the number of seconds
    Dwell Expr
  | -- | the variable, the dimension of the quantities in its values, the list, and the block
    Repeat (Located Name) Dimension Expr [Statement]
  | When Expr [Statement] [Statement]
  | With Expr [Statement]
  deriving stock (Eq, Show)

-- | The rows of a table. The list holds the further columns, which give no coordinates, with their
-- dimensions. The first two cells of a row are its coordinates: x and y, or radius and angle. Then
-- come those of the further columns, in the order of that list.
data Columns = Columns PointColumns [(Name, Dimension)] [Cells]
  deriving stock (Eq, Show)

-- | The two columns that give the points of a table: x and y, or radius and angle.
data PointColumns = CartesianRows | PolarRows
  deriving stock (Eq, Show)

-- | One or more rows of a table: rows of numbers, or one row that contains other expressions, with
-- its region.
data Cells = Numbers {-# UNPACK #-} NumberTable | Written Region [Expr]
  deriving stock (Eq, Show)

-- | A cipher of the checked program, with its region.
type Cipher = Located Cipher_

-- | A recalculation of a curve: a shift by a distance (Kolsanova, section 5). A bevel is the angle
-- between the part's surface and the axis of the tool. If cipher 1, 2 or 6 has a bevel, its
-- distance is measured square to the surface, otherwise in the plane of the part. A flange height
-- is the height of the part's flange at a point. Bevels, flange heights and the distance of cipher
-- 6 may name columns of the table; they then vary along the curve.
data Cipher_
  = -- | cipher 1: the distance at the start and at the end, the bevel, and two points of the curve.
    -- The distance changes evenly with the arc length; if points are given, only between them
    Growing Expr Expr (Maybe Expr) (Maybe (Expr, Expr))
  | -- | cipher 2: the distance, which is the same along the whole curve, and the bevel
    Constant Expr (Maybe Expr)
  | -- | cipher 4: the bevel and the flange height, from which the distance follows, and an
    -- allowance that is added to the distance
    Bevelled Expr Expr (Maybe Expr)
  | -- | cipher 6: the distance at each row of the table, and the bevel
    Pointwise Expr (Maybe Expr)
  deriving stock (Eq, Show)

-- | A joggle of the checked program, with its region.
type Joggle = Located Joggle_

-- | A joggle: the x at which it begins, the x at which it ends, its depth, and its radius, all in
-- mm.
data Joggle_ = Joggle Expr Expr Expr Expr
  deriving stock (Eq, Show)

-- | A cutter of the checked program, with its region.
type Cutter = Located Cutter_

-- | A tool: a cutter or a drill by its diameter in mm, a turning tool by the radius of its nose in
-- mm, and by the direction of its tip if the program gives it.
data Cutter_
  = MillCutter Expr [BodySize]
  | DrillCutter Expr [BodySize]
  | TapCutter Expr [BodySize]
  | -- | a thread mill: its diameter and the pitch of its teeth
    ThreadMillCutter Expr Expr [BodySize]
  | TurningCutter Expr (Maybe Expr)
  | -- | a conical cutter: the diameter of its tip, the bevel of its flank, and the height above the
    -- tip at which the flank touches the contour
    ConeCutter Expr Expr Expr
  | -- | a V-bit: the angle from flank to flank in radians, the diameters of its tip and of its top
    VBitCutter Expr Expr Expr
  | -- | a swivelling blade: its diameter, and the diameter of the wheel that swivels it
    BladeCutter Expr Expr
  deriving stock (Eq, Show)

-- | A size of the body of a tool, with its region.
type BodySize = Located BodySize_

-- | A size of the body of a tool in mm: the length of the cutting edges, the length from the tip to
-- the holder, or the diameter of a cylinder of the holder and its height; or the angle of the point
-- of a drill in radians.
data BodySize_
  = Flutes Expr
  | StickOut Expr
  | PointAngle Expr
  | HolderCylinder Expr (Maybe Expr)
  deriving stock (Eq, Show)

-- | The allowed chord error in mm: the same on both sides of the toolpath, or one towards the
-- material and one away from it.
data Accuracy = Within Expr | Between Expr Expr
  deriving stock (Eq, Show)

-- | A command to the spindle: to rotate in a sense, with a speed in turns per minute if there is
-- one, or to stop. The last constructor says that the spindle is switched by hand.
data Spin
  = Spinning Sense (Maybe Expr)
  | -- | a constant cutting speed and the limit of the speed of the spindle
    CuttingAt Sense Expr Expr
  | SpindleStop
  | SpindleByHand
  deriving stock (Eq, Show)

-- | A condition that must hold; otherwise evaluation reports a mistake.
data Assertion
  = -- | an expression that is true or false, and is no comparison
    Holds Expr
  | -- | a comparison other than equality: the dimension of its operands, the region of the
    -- comparison, the operator, and the left and the right operand
    Compares Dimension Region Operator Expr Expr
  | -- | an equality: the dimension of its operands, the left and the right operand, and the
    -- tolerance if there is one
    Agrees Dimension Expr Expr (Maybe Expr)
  deriving stock (Eq, Show)

-- | The order in which the holes of a statement are drilled: that of the program, or that of a
-- short way.
data VisitOrder = AsListed | Shortest
  deriving stock (Eq, Show)

-- | A text to be engraved: the text, the point to which it is aligned, and the height of its
-- capitals in mm.
data Engraving = Engraving
  { engraved :: Located Text,
    anchor :: Expr,
    capitalHeight :: Expr,
    textLine :: TextLine,
    textAlignment :: TextAlignment
  }
  deriving stock (Eq, Show)

-- | The line on which the letters of a text stand.
data TextLine
  = AlongX
  | -- | a straight line in the direction of an angle
    InDirection Expr
  | -- | a circle; true if the letters stand inside it
    OnCircle Expr Bool
  deriving stock (Eq, Show)

-- | The place of a text in a font: the point to which it is aligned, the height of its capitals in
-- mm, and its direction, which is 'Nothing' along x.
data TextPlace = TextPlace {textPoint :: Expr, textHeight :: Expr, textDirection :: Maybe Expr}
  deriving stock (Eq, Show)

-- | The settings in the block of a machining statement. Lengths are in mm, feeds in mm/min.
data Settings = Settings
  { approach :: [Stop],
    retract :: [Stop],
    -- | the depth of the lowest pass, and the largest stepdown if there are several passes
    depth :: Maybe (Expr, Maybe Expr),
    -- | the form of the lead-in, and the length of its line or the radius of its arc
    leadIn :: Maybe (LeadForm, Expr),
    -- | the form of the lead-out, and the length of its line or the radius of its arc
    leadOut :: Maybe (LeadForm, Expr),
    -- | the material that each pass leaves, in the order of the passes
    allowances :: Maybe (NonEmpty Expr),
    corners :: Corners,
    sense :: Maybe (Located CutSense),
    compensation :: Maybe (Located Compensation),
    -- | the region of the setting, and its point
    startNear :: Maybe (Located Expr),
    -- | the feed of moves down into the material
    plunge :: Maybe CutFeedExpr,
    -- | the region of the setting that gives the way down into the material, and this way
    descent :: Maybe (Located DescentForm),
    tabs :: Maybe (Located Tabs),
    -- | the largest depth of a peck, which is a step of drilling before the drill is retracted
    peck :: Maybe Expr,
    -- | the order in which holes are drilled
    visits :: VisitOrder,
    -- | the rise after each peck that does not leave the hole, with the region of the setting
    chipBreak :: Maybe (Located Expr),
    -- | the seconds at the bottom of a hole
    pause :: Maybe Expr,
    -- | the depth of one turn of a counterbore
    turnPitch :: Maybe Expr,
    -- | the hand of a thread: left or right
    hand :: Maybe Side,
    -- | the region of the setting that allows a floating tap holder
    floating :: Maybe Region,
    -- | the islands of a pocket: expressions of contours and of lists of contours
    islands :: [Expr],
    -- | the region of the setting that allows rest material; without it, rest material is a mistake
    restAllowed :: Maybe Region,
    -- | the direction of parallel passes
    passAngle :: Maybe Expr
  }
  deriving stock (Eq, Show)

-- | The way down into the material.
data DescentForm
  = -- | along the path, at this angle at most
    Ramp Expr
  | -- | by a helix: its largest pitch, and the diameter of the path of the cutter's centre
    Helix Expr (Maybe Expr)
  | -- | along a closed path, down all the depth in laps without a stop
    Spiral
  deriving stock (Eq, Show)

-- | Tabs: material that is left along a contour to hold the part.
data Tabs = Tabs
  { tabPlaces :: TabPlaces,
    tabWidth :: Expr,
    -- | the height above the lowest pass
    tabHeight :: Expr,
    -- | the angle of the sides against the floor
    tabAngle :: Maybe Expr
  }
  deriving stock (Eq, Show)

-- | The places of tabs: so many of them along the contour, or one near each point.
data TabPlaces = TabCount Expr | TabsAt (NonEmpty Expr)
  deriving stock (Eq, Show)

-- | An expression of the checked program, with its region.
type Expr = Located Expr_

-- | An expression.
data Expr_
  = -- | a number in mm, radians, minutes and turns, or in a product of their powers
    Number Double
  | Variable Name
  | -- | a call of a function that the program defines
    Apply Name {-# UNPACK #-} (NonEmpty Expr)
  | Builtin Builtin [Argument]
  | Negate {-# UNPACK #-} Expr
  | Not Expr
  | Binary Operator {-# UNPACK #-} Expr {-# UNPACK #-} Expr
  | Range Expr Expr (Maybe Expr)
  | If Expr Expr Expr
  | Pair {-# UNPACK #-} Expr {-# UNPACK #-} Expr
  | Triple Expr Expr Expr
  | List [Expr]
  | Each Expr Name Expr
  deriving stock (Eq, Show)

-- | An argument of a built-in function: a value, a value after a word such as @near@, or a rank,
-- which is @first@ or @last@.
data Argument = Given {-# UNPACK #-} Expr | Chosen Selector Expr | Ranked Rank
  deriving stock (Eq, Show)

-- | The built-in functions and constants. "Checked.Builtin" gives their names and types.
data Builtin
  = Pi
  | Truth
  | Falsehood
  | Polar
  | Intersection
  | CentreOf
  | Midpoint
  | Foot
  | Tangency
  | PointOn
  | MakeLine
  | Horizontal
  | Vertical
  | Parallel
  | Perpendicular
  | MakeCircle
  | Concentric
  | Distance
  | DirectionOf
  | RadiusOf
  | LengthOf
  | RegionOf
  | UnionOf
  | DifferenceOf
  | OffsetOf
  | OutlinesOf
  | HolesOf
  | AreaOf
  | CentroidOf
  | MakeRectangle
  | MakeRounded
  | MakeSlot
  | MakePolygon
  | MakeEllipse
  | MakeGear
  | MakeBar
  | XOf
  | YOf
  | MakeBezier
  | MakeBSpline
  | MakeSpline
  | ClosedSpline
  | Polyline
  | Parabola
  | Biarcs
  | ClosedBiarcs
  | Fit
  | Sections
  | RowsOf
  | PointsOf
  | PointAtX
  | PointAlong
  | LengthAlong
  | StartOf
  | EndOf
  | TangentOf
  | NormalOf
  | CurvatureOf
  | Moved
  | Rotated
  | Mirrored
  | Scaled
  | Reversed
  | Row
  | Grid
  | Around
  | Count
  | ItemOf
  | Lift
  | Sin
  | Cos
  | Tan
  | Asin
  | Acos
  | Atan2
  | Sqrt
  | Abs
  | Min
  | Max
  | Floor
  deriving stock (Eq, Ord, Show, Enum, Bounded)

-- | An item of a contour of the checked program, with its region.
type Item = Located Item_

-- | An item in the braces of a contour: an element, a repetition of items, or a choice between
-- items.
data Item_
  = -- | a circle with its sense, or a line, a point, a curve or a contour without a sense; the
    -- modifiers of the element, and the link to the next one
    Element (Maybe Sense) {-# UNPACK #-} Expr [Modifier] (Maybe Link)
  | For Name Expr [Item]
  | Choose Expr [Item] [Item]
  deriving stock (Eq, Show)

-- | A modifier of the checked program, with its region.
type Modifier = Located Modifier_

-- | A property of one element of a contour: feed, slow-down at its end, allowance, or bevel.
data Modifier_ = ElementFeed CutFeedExpr | Slow | ElementAllowance Expr | Bevel Expr
  deriving stock (Eq, Show)

-- | A link of the checked program, with its region.
type Link = Located Link_

-- | The link between two elements of a contour.
data Link_
  = Meet (Maybe Expr)
  | Smooth
  | Tangent
  | -- | the radius in mm; a positive one means a clockwise arc, a negative one a counter-clockwise
    -- arc
    Fillet {-# UNPACK #-} Expr
  | -- | the distance in mm that the chamfer takes off each element, measured from their
    -- intersection
    Chamfer {-# UNPACK #-} Expr
  deriving stock (Eq, Show)

-- | A feed: for a minute, or for one turn of the spindle, with the region of the whole feed.
data CutFeedExpr = ForMinute Expr | ForTurn Region Expr
  deriving stock (Eq, Show)

-- | A stop: the point at which a move without cutting ends, and the speed of the move.
data Stop = Stop {point :: Expr, pace :: Pace}
  deriving stock (Eq, Show)

-- | The speed of a move without cutting: the feed in force, the highest speed of the machine, or a
-- feed of its own.
data Pace = Cutting | Rapid | AtFeed CutFeedExpr
  deriving stock (Eq, Show)

-- | The names of values in an expression, with repetitions.
namesIn :: Expr -> [Name]
namesIn (Located _ e) = case e of
  Number _ -> []
  Variable name -> [name]
  Apply _ arguments -> concatMap namesIn (NonEmpty.toList arguments)
  Builtin _ arguments -> concat [namesIn x | a <- arguments, x <- given a]
  Negate x -> namesIn x
  Not x -> namesIn x
  Binary _ a b -> concatMap namesIn [a, b]
  Range a b step -> concatMap namesIn (a : b : maybe [] pure step)
  If a b c -> concatMap namesIn [a, b, c]
  Pair a b -> concatMap namesIn [a, b]
  Triple a b c -> concatMap namesIn [a, b, c]
  List items -> concatMap namesIn items
  Each item _ list -> concatMap namesIn [item, list]
  where
    given a = case a of
      Given x -> [x]
      Chosen _ x -> [x]
      Ranked _ -> []
