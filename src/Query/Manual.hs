{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | One sentence about every word of the language, and the section of the manual that describes it.
module Query.Manual
  ( ManualEntry (..),
    word,
    function,
    sectionTitle,
  )
where

import Data.Char (toUpper)
import Data.Text (Text)
import Data.Text qualified as Text

-- | A sentence about a word, and the section of the manual: the page in the folder of documents, a
-- number sign, and the name of the section.
data ManualEntry = ManualEntry {sentence :: Text, section :: Text}
  deriving stock (Eq, Show)

-- | The entry of a keyword, a setting, a unit, or another word of a statement.
word :: Text -> Maybe ManualEntry
word text = lookup text words'

-- | The entry of a built-in function or constant.
function :: Text -> Maybe ManualEntry
function text = lookup text functions

-- | The title of a section for people, such as "Rest material".
sectionTitle :: ManualEntry -> Text
sectionTitle = capital . Text.replace "-" " " . Text.drop 1 . Text.dropWhile (/= '#') . section
  where
    capital t = Text.map toUpper (Text.take 1 t) <> Text.drop 1 t

-- | Entries that share one section: the section, and each word with its sentence.
under :: Text -> [(Text, Text)] -> [(Text, ManualEntry)]
under section entries = [(name, ManualEntry {sentence, section}) | (name, sentence) <- entries]

words' :: [(Text, ManualEntry)]
words' = concat [statements, definitions, contours, machining, holes, settings, units]

statements :: [(Text, ManualEntry)]
statements =
  under
    "language.md#units"
    [("units", "Gives the unit of the lengths and feeds that the file writes without a unit.")]
    <> under
      "language.md#statements"
      [ ("part", "Names the part; it is the first statement of a program."),
        ("machine", "Names the machine for which the tape is made."),
        ("tool", "Gives the tool at the beginning: its kind and its size."),
        ("feed", "Gives the feed from here on; after an element or a point, the feed there."),
        ("clearance", "Gives the height from here on at which rapid moves pass over everything."),
        ("from", "Gives the position of the cutter's centre when the tape begins."),
        ("diameter", "Gives the diameter of a tool."),
        ("nose", "Gives the radius of the nose of a turning tool."),
        ("tip", "Gives the direction of the tip of a turning tool, as a tool table has it.")
      ]
    <> controlSettings
    <> under
      "language.md#tolerance"
      [("tolerance", "Gives the permitted chord error.")]
    <> under
      "language.md#stock"
      [("stock", "Gives the region and the heights of the stock.")]
    <> under
      "language.md#clamps"
      [("avoid", "Gives a region in which no tool may be, such as that of a clamp.")]
    <> under
      "language.md#the-body-of-a-tool"
      [ ("flutes", "Gives the length of the cutting edges of a tool."),
        ("stickout", "Gives the length of a tool from its tip to the holder."),
        ("holder", "Gives the diameter of a cylinder of the holder.")
      ]
    <> under
      "language.md#tools-for-surfaces-that-lean"
      [ ("cone", "Is a conical mill: the diameter of its tip, its bevel, and the contact height."),
        ("blade", "Is a swivelling blade: its diameter, and that of the wheel that swivels it."),
        ("gear", "Gives the diameter of the wheel that swivels a blade."),
        ( "height",
          "Gives the height above the tip at which a cone touches the contour, or that of a \
          \cylinder of the holder."
        )
      ]
    <> under
      "language.md#blocks"
      [ ("for", "Repeats a block for every item of a list or row of a table."),
        ("if", "Chooses between two blocks, items or values by a condition."),
        ("else", "Begins what is chosen if the condition is false."),
        ("then", "Begins the value that is chosen if the condition is true.")
      ]
    <> under
      "language.md#transformations"
      [("with", "Applies a transformation to the machining in its block.")]

controlSettings :: [(Text, ManualEntry)]
controlSettings =
  under
    "language.md#settings-for-modern-controls"
    [ ("work", "Gives the work offset, from 54 to 59."),
      ("program", "Gives the number of the program, from 1 to 9999."),
      ("safe", "Gives the height above all clamps, for controls without homing.")
    ]

definitions :: [(Text, ManualEntry)]
definitions =
  under
    "language.md#statements"
    [("let", "Defines a value or a function.")]
    <> under
      "language.md#parameters-assertions-imports"
      [ ("param", "Defines a value that the command line may replace."),
        ("import", "Takes the definitions of another file."),
        ("assert", "Demands that a condition is true."),
        ("within", "Gives the tolerance of an equation or of a fit.")
      ]
    <> under
      "language.md#tables"
      [("table", "Defines points, with further columns of values.")]
    <> under "language.md#curves" [("curve", "Gives a name to a curve.")]
    <> under
      "language.md#pieces"
      [("piece", "Defines a curve at given distances from another curve.")]
    <> under
      "language.md#ciphers"
      [("cipher", "Says by which rules the curve is shifted, each by a digit with its values.")]
    <> under
      "language.md#joggles"
      [("joggle", "Makes a local step of a piece.")]
    <> under
      "language.md#values"
      [ ("and", "Is true if both conditions are true."),
        ("or", "Is true if one of the conditions is true."),
        ("not", "Is true if the condition is false."),
        ("in", "Comes before the list of a repetition; after a number it is the unit inch.")
      ]
    <> under
      "functions.md#choice"
      [ ("near", "Chooses the answer that is nearest to a point."),
        ("first", "Chooses the first point along the line or curve."),
        ("last", "Chooses the last point along the line or curve.")
      ]

contours :: [(Text, ManualEntry)]
contours =
  under
    "language.md#contours"
    [("contour", "Defines a contour of the part by its elements, or takes it from a drawing.")]
    <> under
      "drawing-files.md#in-a-program"
      [("contours", "Takes all outlines of a drawing, or of a text in a font, as a region.")]
    <> under
      "drawing-files.md#letters-of-a-font"
      [("text", "Writes a text in a font, whose outlines make a region.")]
    <> under
      "language.md#open-and-closed"
      [ ("open", "Makes a contour that begins and ends at its first and last element."),
        ("closed", "Makes a contour whose last element is joined to its first.")
      ]
    <> under
      "language.md#elements"
      [ ("cw", "Follows the circle clockwise; for a spindle, turns it clockwise."),
        ("ccw", "Follows the circle counter-clockwise; for a spindle, turns it so.")
      ]
    <> under
      "language.md#links"
      [ ("meet", "Joins two elements at their intersection."),
        ("smooth", "Joins two elements that touch."),
        ("tangent", "Joins two circles by their common tangent."),
        ("fillet", "Joins two elements by an arc: clockwise, or counter-clockwise with a minus."),
        ("chamfer", "Cuts the corner of two elements off.")
      ]
    <> under
      "language.md#modifiers"
      [ ("slow", "Slows the cutter down at the end of the element."),
        ("bevel", "Gives the angle between the surface and the axis of the tool.")
      ]

machining :: [(Text, ManualEntry)]
machining =
  under
    "language.md#milling"
    [ ("mill", "Mills along a contour; in a tool, it is a milling cutter."),
      ("outside", "Keeps the cutter outside; as a choice, takes the answer outside a circle."),
      ("inside", "Keeps the cutter inside; as a choice, takes the answer inside a circle."),
      ("left", "Keeps to the left, as seen in the direction of travel."),
      ("right", "Keeps to the right, as seen in the direction of travel."),
      ("on", "Lets the centre of the cutter follow the contour; switches the coolant on.")
    ]
    <> clearing
    <> under
      "language.md#drilling"
      [ ("drill", "Drills holes; in a tool, it is a drill."),
        ("at", "Comes before the points of the holes, or before the point of a tool change.")
      ]
    <> under "language.md#turning" [("turn", "Turns a profile; in a tool, it is a turning tool.")]
    <> under
      "language.md#moves-and-commands"
      [ ("rapid", "Moves as fast as the machine can."),
        ("move", "Moves with the feed in force."),
        ("change", "Changes the tool."),
        ("spindle", "Starts the spindle in a sense and with a speed, or stops it."),
        ("coolant", "Switches the coolant on or off."),
        ("off", "Stops the spindle, or switches the coolant off."),
        ("aux", "Gives an auxiliary command by its number."),
        ("manual", "Says that the spindle is switched by hand."),
        ("limit", "Gives the largest speed of the spindle at a constant cutting speed."),
        ("stop", "Stops until the operator starts the program again."),
        ("optional", "Begins a stop that a switch of the control turns on."),
        ("dwell", "Stops the axes for a time in seconds."),
        ("s", "Is the second, after the time of a dwell.")
      ]

clearing :: [(Text, ManualEntry)]
clearing =
  under
    "language.md#pockets"
    [ ("pocket", "Clears the inside of a closed contour or a circle."),
      ("step", "Gives the stepover of a pocket, or the largest stepdown of a depth.")
    ]
    <> under
      "language.md#rest-machining"
      [ ("rest of", "Clears what a larger cutter or a V-carving has left."),
        ("of", "Comes before the name of the operation whose rest is cleared."),
        ("as", "Gives the clearing of a pocket or a V-carving a name.")
      ]
    <> under
      "language.md#facing"
      [ ("face", "Clears the surface of a region with parallel passes."),
        ("angle", "Gives the direction of the passes over a surface.")
      ]
    <> under
      "language.md#v-carving"
      [ ("vcarve", "Carves a region with a pointed tool, deeper where the region is wider."),
        ("vbit", "Is a V-bit: its angle from flank to flank, its tip, its diameter.")
      ]
    <> under
      "language.md#engraving"
      [ ("engrave", "Engraves a text with letters of single strokes."),
        ("direction", "Gives the direction of the line on which a text stands."),
        ("around", "Lets the letters of a text stand on a circle."),
        ("align", "Says which part of a text lies at its point."),
        ("centre", "Puts the middle of a text at its point.")
      ]

-- | The works on holes.
holes :: [(Text, ManualEntry)]
holes =
  under
    "language.md#works-on-holes"
    [ ("spot", "Marks the centres of holes with the point of a tool."),
      ("ream", "Reams holes: in and out at the feed."),
      ("countersink", "Makes cones at the mouths of holes."),
      ("counterbore", "Mills flat-bottomed cylinders."),
      ("bore", "Mills holes along their walls in a helix."),
      ("tap", "Taps threads; in a tool, it is a tap."),
      ("thread", "Mills threads in a helix."),
      ("threadmill", "Is a thread mill."),
      ("angle", "Gives the angle of a countersink, or of the point of a drill."),
      ("pitch", "Gives the pitch of a thread, or the largest height of one turn of a helix."),
      ("hand", "Says if a thread is a right-hand or a left-hand one."),
      ("floating", "Says that the tap is in a floating holder.")
    ]

settings :: [(Text, ManualEntry)]
settings =
  under
    "language.md#milling"
    [ ("approach", "Gives the stops on the way to the contour."),
      ("retract", "Gives the stops on the way from the contour."),
      ("lead", "Gives the line or arc on which the cutter comes to the contour or leaves it."),
      ("lead in", "Gives the line or arc on which the cutter comes to the contour."),
      ("lead out", "Gives the line or arc on which the cutter leaves the contour."),
      ("start", "Chooses where a closed contour begins."),
      ("start near", "Begins a closed contour at its corner nearest to a point.")
    ]
    <> under
      "language.md#depth"
      [ ("depth", "Gives the depth of the last pass, and the largest step down."),
        ("plunge", "Gives the feed of moves down into the material.")
      ]
    <> under
      "language.md#going-down"
      [ ("ramp", "Goes down along the path, at this angle at most."),
        ("helix", "Goes down by a helix."),
        ("pitch", "Gives the largest height of one turn of a helix."),
        ("spiral", "Goes down all the depth in laps without a stop.")
      ]
    <> under
      "language.md#tabs"
      [ ("tabs", "Leaves so many tabs along the contour, which hold the part."),
        ("tab", "Leaves tabs at points, which hold the part."),
        ("tab at", "Leaves tabs at points, which hold the part."),
        ("width", "Gives the width of the tabs at their narrowest."),
        ("angle", "Gives the angle of the sides of the tabs.")
      ]
    <> under
      "language.md#passes"
      [("allowance", "Gives the material that each pass leaves.")]
    <> under
      "language.md#corners"
      [("corners", "Says if the cutter goes round outer corners in an arc or sharply.")]
    <> under
      "language.md#direction"
      [ ("climb", "Demands climb milling."),
        ("conventional", "Demands conventional milling.")
      ]
    <> otherSettings

otherSettings :: [(Text, ManualEntry)]
otherSettings =
  under
    "language.md#compensation-by-the-control"
    [("compensation", "Says if the compiler or the control computes the offset.")]
    <> under
      "language.md#rest-material"
      [ ( "rest",
          "Permits material that the cutter does not reach; before of, clears what is left."
        ),
        ("rest allowed", "Permits material that the cutter does not reach.")
      ]
    <> under
      "language.md#pockets"
      [("islands", "Names closed contours or circles inside the pocket that are left uncut.")]
    <> under
      "language.md#drilling"
      [ ("peck", "Gives the depth that is drilled before the drill is lifted."),
        ("shortest", "Has the holes made in the order of a short way."),
        ("chip", "Gives the height by which the drill rises after each peck."),
        ("chip break", "Gives the height by which the drill rises after each peck."),
        ("break", "Belongs to chip break, the rise after each peck.")
      ]

units :: [(Text, ManualEntry)]
units =
  under
    "language.md#units"
    [ ("mm", "Is the millimetre; without units in, a length without a unit is in mm."),
      ("cm", "Is the centimetre, 10 mm."),
      ("m", "Is the metre, 1000 mm."),
      ("deg", "Is the degree; an angle without a unit is in deg."),
      ("rad", "Is the radian, 57.296 deg."),
      ( "mm/min",
        "Is the millimetre per minute; without units in, a feed without a unit is in mm/min."
      ),
      ("m/min", "Is the metre per minute, 1000 mm/min."),
      ("in/min", "Is the inch per minute, 25.4 mm/min."),
      ("ft/min", "Is the foot per minute, 304.8 mm/min; for cutting speeds."),
      ("rpm", "Is the turn per minute.")
    ]

functions :: [(Text, ManualEntry)]
functions =
  concat
    [ constructions,
      curveFunctions,
      shapes,
      measures,
      transformations,
      patterns,
      numbers
    ]

constructions :: [(Text, ManualEntry)]
constructions =
  under
    "functions.md#points-and-vectors"
    [ ("polar", "Gives the vector of a length and a direction."),
      ("midpoint", "Gives the point half-way between two points."),
      ("foot_of", "Gives the point of a line or curve that is nearest to a point."),
      ("centre_of", "Gives the centre of a circle."),
      ("point_on", "Gives the point of a circle in a direction from its centre."),
      ("intersection", "Gives a point in which two lines, circles or curves meet."),
      ("tangency", "Gives the point in which two things touch."),
      ("lift", "Gives a point of the plane a height.")
    ]
    <> under
      "functions.md#lines"
      [ ("line", "Gives the line through points, in a direction, or tangent to circles."),
        ("horizontal", "Gives the horizontal line at a y, directed to the right."),
        ("vertical", "Gives the vertical line at an x, directed upwards."),
        ("parallel", "Gives the parallel at a distance or through a point."),
        ("perpendicular", "Gives the line through a point at a right angle to a line.")
      ]
    <> under
      "functions.md#circles"
      [ ("circle", "Gives a circle by its centre and radius, by points, or by what it touches."),
        ("concentric", "Gives the circle with the same centre and a larger or smaller radius.")
      ]

curveFunctions :: [(Text, ManualEntry)]
curveFunctions =
  under
    "functions.md#curves"
    [ ("polyline", "Gives straight lines from point to point."),
      ("spline", "Gives a cubic spline through points."),
      ("closed_spline", "Gives a cubic spline that closes."),
      ("bezier", "Gives a Bézier curve by its control points and their weights."),
      ("bspline", "Gives a B-spline by its degree, control points, knots and weights."),
      ("parabola", "Gives parabolas through points 1–3, 3–5 and so on."),
      ("arcs", "Gives smooth arcs through points, or along a curve within a tolerance."),
      ("closed_arcs", "Gives smooth arcs through points, and closes."),
      ("fit", "Gives the fewest lines, parabolas and arcs that fit the points."),
      ("sections", "Gives lines and parabolas through chosen rows of a table."),
      ("rows_of", "Gives a table of those rows whose numbers are in a list."),
      ("points_of", "Gives the points of a table as a list."),
      ("point_at_x", "Gives the point of a curve at an x."),
      ("point_along", "Gives the point of a curve at a length from its beginning."),
      ("length_along", "Gives the length of a curve from its beginning to a point."),
      ("start_of", "Gives the beginning of a curve."),
      ("end_of", "Gives the end of a curve."),
      ("tangent_of", "Gives the direction of a curve at its point nearest to a point."),
      ("normal_of", "Gives the direction of the left normal of a curve near a point."),
      ("curvature_of", "Gives the curvature of a curve near a point: 1 / radius.")
    ]

shapes :: [(Text, ManualEntry)]
shapes =
  under
    "functions.md#shapes"
    [ ("rectangle", "Gives the contour of a rectangle."),
      ("bar", "Gives the half section of a bar: its diameter, its length."),
      ("rounded", "Gives the contour of a rectangle with round corners."),
      ("slot", "Gives the contour of a slot between two centres."),
      ("polygon", "Gives the contour through points, or that of a regular polygon."),
      ("ellipse", "Gives the contour of an ellipse."),
      ("gear", "Gives the contour of a gear wheel with involute teeth.")
    ]
    <> under
      "functions.md#regions"
      [ ("region", "Gives the region inside contours or circles."),
        ("union", "Gives all points of one region or another."),
        ("difference", "Gives the points of a region that are not in others."),
        ("offset_of", "Gives all points within a distance of a region, or so far inside it."),
        ("outlines_of", "Gives the outer contours of a region."),
        ("holes_of", "Gives the contours around the holes of a region."),
        ("area_of", "Gives the area of a region."),
        ("centroid_of", "Gives the centre of gravity of a region.")
      ]

measures :: [(Text, ManualEntry)]
measures =
  under
    "functions.md#measures"
    [ ("distance", "Gives the distance between points, lines or curves."),
      ("direction_of", "Gives the angle of a line or a vector."),
      ("radius_of", "Gives the radius of a circle."),
      ("length_of", "Gives the length of a contour, a line, a vector or a curve."),
      ("x_of", "Gives the x of a point or a vector."),
      ("y_of", "Gives the y of a point or a vector.")
    ]

transformations :: [(Text, ManualEntry)]
transformations =
  under
    "functions.md#transformations"
    [ ("moved", "Moves something by a vector; alone, gives the transformation."),
      ("rotated", "Rotates something by an angle; alone, gives the transformation."),
      ("mirrored", "Mirrors something in a line; alone, gives the transformation."),
      ("scaled", "Enlarges something; alone, gives the transformation."),
      ("reversed", "Reverses a contour, a curve, a line or a list.")
    ]

patterns :: [(Text, ManualEntry)]
patterns =
  under
    "functions.md#lists-and-patterns"
    [ ("row", "Gives points in a row."),
      ("grid", "Gives points in rows and columns."),
      ("around", "Gives points around a circle."),
      ("count_of", "Gives the number of items of a list."),
      ("item_of", "Gives an item of a list by its number, from 1.")
    ]

numbers :: [(Text, ManualEntry)]
numbers =
  under
    "functions.md#numbers"
    [ ("pi", "Is 3.14159…, a plain number."),
      ("true", "Is the truth value of a condition that holds."),
      ("false", "Is the truth value of a condition that does not hold."),
      ("sin", "Gives the sine of an angle."),
      ("cos", "Gives the cosine of an angle."),
      ("tan", "Gives the tangent of an angle."),
      ("asin", "Gives the angle that has a sine."),
      ("acos", "Gives the angle that has a cosine."),
      ("atan2", "Gives the angle of the direction (x, y), from y and x."),
      ("sqrt", "Gives the square root."),
      ("abs", "Gives the absolute value."),
      ("min", "Gives the smaller of two values."),
      ("max", "Gives the larger of two values."),
      ("floor", "Gives the largest whole number that is not above a value.")
    ]
