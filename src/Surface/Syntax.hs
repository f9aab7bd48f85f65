-- | The syntax tree of a program as written: names unresolved, units as given, every node with its
-- region.
--
-- Statements, items, settings and lines of tables that contain a mistake are kept as broken nodes.
-- A broken statement or item keeps the name that it was to define, so that no later compiler pass
-- reports this name as unknown.
--
-- A stop is a point to which the cutter moves. The pace of a motion is rapid or a feed.
--
-- A piece is a curve with its recalculations, each of which shifts the curve along its normal. A
-- cipher names one recalculation by a digit. A joggle is a local step of a piece, blended with a
-- radius.
module Surface.Syntax
  ( Program (..),
    Statement,
    Statement_ (..),
    HoleWork (..),
    HoleSize (..),
    Lettering (..),
    TextCourse (..),
    TextAlignment (..),
    Cutter,
    Cutter_ (..),
    BodySize,
    BodySize_ (..),
    Accuracy (..),
    DefaultPace (..),
    Spin (..),
    Switch (..),
    Expr,
    Expr_ (..),
    Numeral (..),
    Operator (..),
    Argument (..),
    Selector (..),
    Rank (..),
    Closure (..),
    Item,
    Item_ (..),
    Sense (..),
    Lines (..),
    DrawnOutlines (..),
    DrawingReference (..),
    DrawingSelection (..),
    TableLine,
    TableLine_ (..),
    Cell (..),
    Heading (..),
    Cipher,
    Cipher_ (..),
    Joggle,
    Joggle_ (..),
    Modifier,
    Modifier_ (..),
    Link,
    Link_ (..),
    Side (..),
    MachineRef (..),
    Setting,
    Setting_ (..),
    TabPlaces (..),
    Lead (..),
    LeadForm (..),
    Corners (..),
    CutSense (..),
    Compensation (..),
    Stop (..),
    Pace (..),
  )
where

import Base.Name (Name)
import Base.NumberTable (NumberTable)
import Base.Quantity (LengthUnit)
import Base.Region (Located)
import Data.List.NonEmpty (NonEmpty)
import Data.Map.Strict (Map)
import Data.Text (Text)
import Font.TextOutline (LetterShape)
import Surface.Token (Numeral (..), Unit)

-- | A program: its statements and its comments, each list in the order of the text. 'units' are the
-- units that the files of the program give for lengths without a unit, each by the offset of its
-- file's first character; 'Nothing' for a file without a @units@ statement.
data Program = Program
  { statements :: [Statement],
    comments :: [Located Text],
    units :: Map Int (Maybe LengthUnit)
  }
  deriving stock (Eq, Show)

-- | A statement as the program writes it, with its region.
type Statement = Located Statement_

-- | A statement, with one constructor for each form. The comment on a constructor is an example.
data Statement_
  = -- | @part flange "title"@
    Part (Located Name) (Maybe (Located Text))
  | -- | @units in@
    Units LengthUnit
  | -- | @machine lkp-01f@
    Machine (Located MachineRef)
  | -- | @import "bolts.part"@
    Import (Located Text)
  | -- | @tool mill(diameter 20 mm)@ and @tool 1 mill(diameter 20 mm)@: the number, the cutter
    Tool (Maybe Expr) Cutter
  | -- | @feed 60 mm/min@
    Feed Expr
  | -- | @tolerance 0.02 mm@
    Tolerance Accuracy
  | -- | @clearance 5 mm@
    Clearance Expr
  | -- | @from (0, 0)@
    From Expr
  | -- | @work 54@: the number of the work offset
    WorkOffset Expr
  | -- | @program 1234@: the number of the program
    ProgramNumber Expr
  | -- | @safe 40 mm@: the safe height
    SafeHeight Expr
  | -- | @stock blank from -20 to 0@: the region, the heights of its bottom and of its top
    Stock Expr (Maybe (Expr, Expr))
  | -- | @avoid clamp from 0 to 12@: the region, the heights of its bottom and of its top
    Avoid Expr (Maybe (Expr, Expr))
  | -- | @let r = 9@
    LetValue (Located Name) Expr
  | -- | @let lug(a) = …@
    LetFunction (Located Name) (NonEmpty (Located Name)) Expr
  | -- | @param d = 25 mm@
    Param (Located Name) Expr
  | -- | @contour outline closed { … }@
    Contour (Located Name) (Located Closure) [Item]
  | -- | @contour edge from "stand.dxf" layer "CUT"@: one outline of a drawing, and
    -- @contours parts from "stand.dxf" layer "CUT"@: all of them, as a region
    Drawn DrawnOutlines (Located Name) DrawingReference
  | -- | @contours sign from "sans.ttf" text "12" at p height 8@: the name, the file of the font,
    -- the text, and the shapes of its letters, of which there are none until the font is read
    DrawnText (Located Name) (Located Text) Lettering [LetterShape]
  | -- | @table profile { x y … }@ and @table profile from "profile.csv"@
    Table (Located Name) Lines
  | -- | @curve skin = spline(profile)@
    Curve (Located Name) Expr
  | -- | @piece flange = skin cipher 2(2.5), 4(mu, H) left joggle …@
    Piece (Located Name) Expr [Cipher] (Located Side) [Joggle]
  | -- | @assert distance(p, q) = 41 within 0.1@
    Assert Expr (Maybe Expr)
  | -- | @mill outline outside { … }@
    Mill Expr (Located Side) [Setting]
  | -- | @pocket window step 4 mm as rough { … }@: the contour to clear, the stepover, the name of
    -- the operation
    Pocket Expr Expr (Maybe (Located Name)) [Setting]
  | -- | @rest of rough step 2 mm { … }@: the operation that left the material, the stepover
    RestOf Expr Expr [Setting]
  | -- | @face blank step 30 mm { … }@: the region to clear, the stepover
    Face Expr Expr [Setting]
  | -- | @engrave "12" at p height 8 { … }@
    Engrave Lettering [Setting]
  | -- | @vcarve letters as sign { … }@: the region to carve, the name of the operation
    Vcarve Expr (Maybe (Located Name)) [Setting]
  | -- | @turn profile outside { … }@
    Turn Expr (Located Side) [Setting]
  | -- | @drill at holes depth 12 mm { … }@
    Drill Expr Expr [Setting]
  | -- | @ream at holes depth 12 mm { … }@ and the other works on holes: the work, the points, the
    -- sizes of the holes, the side of a thread, the settings
    Hole HoleWork Expr [(HoleSize, Expr)] (Maybe (Located Side)) [Setting]
  | -- | @rapid p, q@ and @move p, q feed f@
    Travel DefaultPace (NonEmpty Stop)
  | -- | @change 2 drill(diameter 5 mm)@ and @change 2 drill(diameter 5 mm) at (0, 0)@: the number,
    -- the cutter, the point at which the tool is changed
    Change Expr Cutter (Maybe Expr)
  | -- | @spindle cw 800 rpm@
    Spindle Spin
  | -- | @coolant on@
    Coolant Switch
  | -- | @aux 3@
    Auxiliary Expr
  | -- | @stop@: the program waits for the operator
    ProgramStop
  | -- | @optional stop@: it waits if a switch of the control asks for it
    OptionalStop
  | -- | @dwell 2 s@: the number of seconds
    Dwell Expr
  | -- | @for p in holes { … }@
    Repeat (Located Name) Expr [Statement]
  | -- | @if with_slot { … } else { … }@
    When Expr [Statement] [Statement]
  | -- | @with rotated(60 deg) { … }@
    With Expr [Statement]
  | -- | a statement with a mistake: its keyword, and the name that it was to define; 'Nothing' for
    -- one that the parser could not find
    Broken (Maybe Text) (Maybe (Located Name))
  deriving stock (Eq, Show)

-- | A work on holes other than drilling.
data HoleWork
  = Spotting
  | Reaming
  | Countersinking
  | Counterboring
  | Boring
  | Tapping
  | Threading
  deriving stock (Eq, Show, Enum, Bounded)

-- | A size of a hole.
data HoleSize = HoleDiameter | HoleDepth | HolePitch | HoleAngle
  deriving stock (Eq, Show, Enum, Bounded)

-- | A text to be cut: the text in quotation marks, the point to which it is aligned, and the
-- height of its capitals.
data Lettering = Lettering
  { lettered :: Located Text,
    textPoint :: Expr,
    textHeight :: Expr,
    course :: TextCourse,
    alignment :: Maybe TextAlignment
  }
  deriving stock (Eq, Show)

-- | The line on which the letters of a text stand.
data TextCourse
  = -- | along x
    Level
  | -- | @direction 30@: a straight line in this direction
    Inclined Expr
  | -- | @around ring inside@: a circle, and the side on which the letters stand
    Around Expr (Maybe (Located Side))
  deriving stock (Eq, Show)

-- | The part of a text that lies at its point.
data TextAlignment = AlignLeft | AlignCentre | AlignRight
  deriving stock (Eq, Show, Enum, Bounded)

-- | A machine by its name, or by the file with its description.
data MachineRef = Named Text | Described Text
  deriving stock (Eq, Show)

-- | A cutter as the program writes it, with its region.
type Cutter = Located Cutter_

-- | A cutter as written.
data Cutter_
  = -- | @mill(diameter d)@ and @mill(diameter d, flutes f, stickout s, holder h)@
    MillCutter Expr [BodySize]
  | -- | @drill(diameter d)@, with the same sizes
    DrillCutter Expr [BodySize]
  | -- | @turn(nose r)@ and @turn(nose r, tip n)@: the radius of the nose, the direction of its tip
    TurningCutter Expr (Maybe Expr)
  | -- | @cone(diameter d, bevel a, height h)@: a conical mill. The arguments are the diameter of
    -- the tip of the mill, the bevel of its flank, and the height of the contour above the tip.
    ConeCutter Expr Expr Expr
  | -- | @vbit(angle a, tip d, diameter e)@: the angle from flank to flank, the diameters of the tip
    -- and at the top of the flank
    VBitCutter Expr Expr Expr
  | -- | @tap(diameter d)@, with the sizes of its body
    TapCutter Expr [BodySize]
  | -- | @threadmill(diameter d, pitch p)@, with the sizes of its body
    ThreadMillCutter Expr Expr [BodySize]
  | -- | @blade(diameter d, gear e)@: a swivelling blade. The arguments are the diameter of the
    -- blade and the diameter of the gear wheel that swivels the blade.
    BladeCutter Expr Expr
  deriving stock (Eq, Show)

-- | A size of the body of a tool as the program writes it, with its region.
type BodySize = Located BodySize_

-- | A size of the body of a tool as written.
data BodySize_
  = -- | @flutes f@: the length of the cutting edges, from the tip
    Flutes Expr
  | -- | @stickout s@: the length from the tip to the holder
    StickOut Expr
  | -- | @angle a@: the angle of the point of a drill
    PointAngle Expr
  | -- | @holder d@ and @holder d height h@: the diameter of a cylinder of the holder, its height
    HolderCylinder Expr (Maybe Expr)
  deriving stock (Eq, Show)

-- | The allowed distance between a curve and its chords.
data Accuracy
  = -- | the same distance on both sides of the curve
    Within Expr
  | -- | the distance inside the material, and the distance outside
    Between Expr Expr
  deriving stock (Eq, Show)

-- | The pace of a motion to a stop that is written without a pace: rapid in a @rapid@ statement,
-- the feed in force in a @move@ statement.
data DefaultPace = RapidMotion | FeedMotion
  deriving stock (Eq, Show, Enum, Bounded)

-- | The command to a spindle: a sense with an optional speed, a stop, or the statement that it is
-- switched by hand.
data Spin = Spinning Sense (Maybe Expr) (Maybe Expr) | SpindleStop | SpindleByHand
  deriving stock (Eq, Show)

-- | The command to the coolant: on or off.
data Switch = SwitchOn | SwitchOff
  deriving stock (Eq, Show, Enum, Bounded)

-- | An expression as the program writes it, with its region.
type Expr = Located Expr_

-- | An expression.
data Expr_
  = -- | a number with an optional unit
    Literal {-# UNPACK #-} Numeral (Maybe Unit)
  | Variable Name
  | -- | @f(a, near p)@
    Call {-# UNPACK #-} (Located Name) {-# UNPACK #-} (NonEmpty Argument)
  | Negate {-# UNPACK #-} Expr
  | Not Expr
  | Binary Operator {-# UNPACK #-} Expr {-# UNPACK #-} Expr
  | -- | @a..b@ and @a..b by s@
    Range Expr Expr (Maybe Expr)
  | -- | @if c then a else b@
    If Expr Expr Expr
  | -- | @(x, y)@: a point or a vector
    Pair {-# UNPACK #-} Expr {-# UNPACK #-} Expr
  | -- | @(x, y, z)@: a point with a height
    Triple Expr Expr Expr
  | List [Expr]
  | -- | @[e for x in list]@
    Each Expr (Located Name) Expr
  deriving stock (Eq, Show)

-- | A binary operator.
data Operator
  = Add
  | Subtract
  | Multiply
  | Divide
  | Less
  | AtMost
  | Greater
  | AtLeast
  | Equal
  | Unequal
  | And
  | Or
  deriving stock (Eq, Show, Enum, Bounded)

-- | An argument of a call. A selector (a word before a value) or a rank (@first@ or @last@) chooses
-- one of several geometric solutions.
data Argument
  = -- | a value alone
    Given {-# UNPACK #-} Expr
  | -- | @near p@, @left l@, @inside c@ …
    Chosen (Located Selector) Expr
  | -- | @first@ and @last@
    Ranked (Located Rank)
  deriving stock (Eq, Show)

-- | The word before an argument, which says how the argument chooses a solution.
data Selector
  = Near
  | ToLeft
  | ToRight
  | -- | @inside c@
    ToInside
  | ToOutside
  | -- | @within d@: the tolerance of a fit, which chooses no solution
    WithinTolerance
  deriving stock (Eq, Ord, Show, Enum, Bounded)

-- | The lines of a table.
data Lines
  = WrittenLines [TableLine]
  | -- | the name of a file of comma-separated values
    LinesFromFile (Located Text)
  | -- | the circles of a drawing
    LinesFromDrawing DrawingReference
  deriving stock (Eq, Show)

-- | The outlines of a drawing that a statement takes.
data DrawnOutlines
  = -- | the only one
    OneOutline
  | -- | all of them; the regions inside of an even number of others are filled
    AllOutlines
  deriving stock (Eq, Show)

-- | A part of a drawing: @"stand.dxf" layer "CUT" unit mm within 0.01@.
data DrawingReference = DrawingReference
  { drawingFile :: Located Text,
    -- | absent if the whole drawing is meant
    selection :: Maybe (Located DrawingSelection),
    -- | the unit of the drawing; absent if its file states it
    drawingUnit :: Maybe (Located LengthUnit),
    -- | the largest distance between two ends that are joined, as a number
    joinedWithin :: Maybe Expr
  }
  deriving stock (Eq, Show)

-- | The choice of entities of a drawing.
data DrawingSelection
  = -- | those of a layer
    OnLayer Text
  | -- | the element of an SVG file with an identifier, and those inside of it
    WithIdentifier Text
  | -- | those with a class
    WithClass Text
  deriving stock (Eq, Show)

-- | A line of a table as the program writes it, with its region.
type TableLine = Located TableLine_

-- | A line of a table, or consecutive lines of a table file.
data TableLine_
  = -- | @x y mu deg H@: the headings
    Header (NonEmpty Heading)
  | -- | one cell for each column
    Entries {-# UNPACK #-} (NonEmpty Cell)
  | -- | consecutive lines of a table file; each has one number without a unit for each column
    Numbers {-# UNPACK #-} NumberTable
  | -- | a line with a mistake
    BrokenLine
  deriving stock (Eq, Show)

-- | A cell of a table: a value, or a text in quotation marks, which is for people only.
data Cell = ValueCell Expr | TextCell (Located Text)
  deriving stock (Eq, Show)

-- | The name of a column with the unit of its numbers.
data Heading = Heading (Located Name) (Maybe Unit)
  deriving stock (Eq, Show)

-- | A cipher as the program writes it, with its region.
type Cipher = Located Cipher_

-- | A recalculation of a curve: its digit and its values.
data Cipher_ = Cipher (Located Numeral) (NonEmpty Expr)
  deriving stock (Eq, Show)

-- | A joggle as the program writes it, with its region.
type Joggle = Located Joggle_

-- | @joggle from x1 to x2 depth d radius r@
data Joggle_ = Joggle {from :: Expr, to :: Expr, depth :: Expr, radius :: Expr}
  deriving stock (Eq, Show)

-- | The choice of one solution by its order along a line or a curve.
data Rank = First | Last
  deriving stock (Eq, Ord, Show, Enum, Bounded)

-- | The two kinds of contours.
data Closure = Open | Closed
  deriving stock (Eq, Show, Enum, Bounded)

-- | An item of a contour as the program writes it, with its region.
type Item = Located Item_

-- | An item in the braces of a contour.
data Item_
  = -- | an element with its sense, its modifiers, and the link to the next element
    Element (Maybe (Located Sense)) {-# UNPACK #-} Expr [Modifier] (Maybe Link)
  | -- | @for a in list { … }@
    For (Located Name) Expr [Item]
  | -- | @if c { … } else { … }@
    Choose Expr [Item] [Item]
  | -- | an item with a mistake: the name that the item was to define; 'Nothing' if there is none
    BrokenItem (Maybe (Located Name))
  deriving stock (Eq, Show)

-- | The sense of a circle in a contour or of a spindle.
data Sense = Clockwise | CounterClockwise
  deriving stock (Eq, Show, Enum, Bounded)

-- | A modifier as the program writes it, with its region.
type Modifier = Located Modifier_

-- | A modifier: a property of one element of a contour.
data Modifier_
  = -- | the feed along the element
    ElementFeed Expr
  | -- | a lower feed at the end of the element
    Slow
  | -- | the thickness of the material that is left on the element
    ElementAllowance Expr
  | -- | the angle of the element's surface to the axis of the tool
    Bevel Expr
  deriving stock (Eq, Show)

-- | A link as the program writes it, with its region.
type Link = Located Link_

-- | The link between an element and the next one.
data Link_
  = -- | The elements meet at an intersection, the one nearest to the point if a point is given.
    Meet (Maybe Expr)
  | Smooth
  | Tangent
  | -- | an arc with this radius, positive for a clockwise arc, negative for a counter-clockwise one
    Fillet {-# UNPACK #-} Expr
  | -- | a line that cuts the corner off; each of its ends has this distance from the intersection
    -- of the elements
    Chamfer {-# UNPACK #-} Expr
  deriving stock (Eq, Show)

-- | The side of a contour on which the cutter moves.
data Side = Outside | Inside | LeftSide | RightSide | On
  deriving stock (Eq, Show, Enum, Bounded)

-- | A setting as the program writes it, with its region.
type Setting = Located Setting_

-- | A setting in the block of a machining statement.
data Setting_
  = Approach (NonEmpty Stop)
  | Retract (NonEmpty Stop)
  | -- | @depth 12 step 4@: the depth and the largest stepdown
    Depth Expr (Maybe Expr)
  | -- | @lead in arc 5@
    LeadBy Lead LeadForm Expr
  | -- | @allowance 1, 0.3, 0@: the material that each pass leaves
    Allowances (NonEmpty Expr)
  | -- | @corners sharp@
    CornerStyle Corners
  | -- | @climb@ and @conventional@
    CutBy CutSense
  | -- | @compensation controller@
    CompensationBy Compensation
  | -- | @start near p@
    StartNear Expr
  | -- | @plunge 20 mm/min@: the feed downwards
    Plunge Expr
  | -- | @ramp 3 deg@: the steepest way down along the path
    Ramp Expr
  | -- | @helix pitch 1 diameter 8@: the way down by a helix, and the diameter of the centre's path
    Helix Expr (Maybe Expr)
  | -- | @spiral@: down all the depth in laps without a stop
    Spiral
  | -- | @tabs 4 width 6 height 2 angle 45 deg@: material that is left to hold the part, its width,
    -- its height and the angle of its sides
    Tabs TabPlaces Expr Expr (Maybe Expr)
  | -- | @peck 3 mm@: the depth that is drilled between two retracts
    Peck Expr
  | -- | @shortest@: the holes in the order of a short way
    ShortestWay
  | -- | @angle 45@: the direction of the passes
    Angle Expr
  | -- | @chip break 0.5 mm@: the rise after each peck that does not leave the hole
    ChipBreak Expr
  | -- | @dwell 0.5 s@: the number of seconds at the bottom of a hole
    Pause Expr
  | -- | @pitch 0.5 mm@: the depth of one turn of a counterbore
    TurnPitch Expr
  | -- | @hand left@ and @hand right@: the hand of a thread
    Hand Side
  | -- | @floating@: the tap is held in a floating holder
    Floating
  | -- | @islands a, b@: contours in a pocket that are left uncut
    Islands (NonEmpty Expr)
  | -- | @rest allowed@: rest material is accepted
    RestAllowed
  | -- | a setting with a mistake
    BrokenSetting
  deriving stock (Eq, Show)

-- | The places of tabs: so many of them along the contour, or one near each point.
data TabPlaces = TabCount Expr | TabsAt (NonEmpty Expr)
  deriving stock (Eq, Show)

-- | The linking move onto the contour or away from it.
data Lead = LeadIn | LeadOut
  deriving stock (Eq, Show, Enum, Bounded)

-- | The form of a lead-in or lead-out.
data LeadForm = LeadLine | LeadArc
  deriving stock (Eq, Show, Enum, Bounded)

-- | The form of the toolpath around an outer corner.
data Corners = Round | Sharp
  deriving stock (Eq, Show, Enum, Bounded)

-- | The milling direction.
data CutSense = Climb | Conventional
  deriving stock (Eq, Show, Enum, Bounded)

-- | Says what computes the offset of the toolpath: the compiler, or the control by cutter
-- compensation.
data Compensation = ByCompiler | ByController
  deriving stock (Eq, Show, Enum, Bounded)

-- | A stop: the end point of a motion, and the pace of the motion.
data Stop = Stop {point :: Expr, pace :: Pace}
  deriving stock (Eq, Show)

-- | The pace of the motion to a stop.
data Pace
  = -- | No pace is written. The motion is rapid in a @rapid@ statement; elsewhere it has the feed
    -- in force.
    Cutting
  | Rapid
  | AtFeed Expr
  deriving stock (Eq, Show)
