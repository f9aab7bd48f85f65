-- | The built-in functions and constants of the language, with their types.
--
-- A function may have several forms. A form is one list of parameters with the type of the result.
-- A call chooses a form by the number, the labels and the types of its arguments. The types of a
-- form may contain unknowns. An unknown is a type or a dimension that type inference has yet to
-- find; it is identified by a number.
module Checked.Builtin
  ( Form (..),
    Parameter (..),
    ArgumentLabel (..),
    Fresh (..),
    lookup,
    forms,
    labelled,
    unlabelled,
    isOverloaded,
    isConstant,
    mayBeHidden,
    names,
    name,
    formText,
    description,
    formTexts,
    formsForReports,
    callText,
  )
where

import Checked.Dimension (Dimension)
import Checked.Dimension qualified as Dimension
import Checked.Syntax (Builtin (..), Selector (..))
import Checked.Type (Type (..))
import Checked.Type qualified as Type
import Data.Containers.ListUtils (nubOrd)
import Data.Map.Lazy qualified as Lazy
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Surface.Keyword qualified as Keyword
import Prelude hiding (lookup)

-- | A form: the parameters of a call, and the type of its result.
data Form = Form {parameters :: [Parameter], result :: Type}

-- | A parameter of a form: its label, its name for reports, and its type. The label 'Rank' is the
-- word @first@ or @last@ itself, without a value; name and type are then meaningless.
data Parameter = Parameter {label :: ArgumentLabel, title :: Text, type' :: Type}

-- | The label of an argument: none, or a word before its value, such as @near@. A rank is the word
-- @first@ or @last@; no value follows it.
data ArgumentLabel = NoLabel | Word Selector | Rank
  deriving stock (Eq, Ord, Show)

-- | The unknowns that occur in the types of a form: one dimension and one type. Each call gets new
-- ones.
data Fresh = Fresh {dimension :: Dimension, anything :: Type}

-- | Finds a built-in function or constant by its name in programs.
lookup :: Text -> Maybe Builtin
lookup word = Map.lookup word table

-- | The names of all built-in functions and constants.
names :: [Text]
names = Map.keys table

table :: Map Text Builtin
table = Map.fromList [(name b, b) | b <- [minBound .. maxBound]]

-- | The name of a built-in function or constant, as programs write it.
name :: Builtin -> Text
name builtin = case builtin of
  Pi -> "pi"
  Truth -> "true"
  Falsehood -> "false"
  Polar -> "polar"
  Intersection -> "intersection"
  CentreOf -> "centre_of"
  Midpoint -> "midpoint"
  Foot -> "foot_of"
  Tangency -> "tangency"
  PointOn -> "point_on"
  MakeLine -> "line"
  Horizontal -> "horizontal"
  Vertical -> "vertical"
  Parallel -> "parallel"
  Perpendicular -> "perpendicular"
  MakeCircle -> "circle"
  Concentric -> "concentric"
  Distance -> "distance"
  DirectionOf -> "direction_of"
  RadiusOf -> "radius_of"
  LengthOf -> "length_of"
  RegionOf -> "region"
  UnionOf -> "union"
  DifferenceOf -> "difference"
  OffsetOf -> "offset_of"
  OutlinesOf -> "outlines_of"
  HolesOf -> "holes_of"
  AreaOf -> "area_of"
  CentroidOf -> "centroid_of"
  MakeRectangle -> "rectangle"
  MakeRounded -> "rounded"
  MakeSlot -> "slot"
  MakePolygon -> "polygon"
  MakeEllipse -> "ellipse"
  MakeGear -> "gear"
  MakeBar -> "bar"
  XOf -> "x_of"
  YOf -> "y_of"
  MakeBezier -> "bezier"
  MakeBSpline -> "bspline"
  MakeSpline -> "spline"
  ClosedSpline -> "closed_spline"
  Polyline -> "polyline"
  Parabola -> "parabola"
  Biarcs -> "arcs"
  ClosedBiarcs -> "closed_arcs"
  Fit -> "fit"
  Sections -> "sections"
  RowsOf -> "rows_of"
  PointsOf -> "points_of"
  PointAtX -> "point_at_x"
  PointAlong -> "point_along"
  LengthAlong -> "length_along"
  StartOf -> "start_of"
  EndOf -> "end_of"
  TangentOf -> "tangent_of"
  NormalOf -> "normal_of"
  CurvatureOf -> "curvature_of"
  Moved -> "moved"
  Rotated -> "rotated"
  Mirrored -> "mirrored"
  Scaled -> "scaled"
  Reversed -> "reversed"
  Row -> "row"
  Grid -> "grid"
  Around -> "around"
  Count -> "count_of"
  ItemOf -> "item_of"
  Lift -> "lift"
  Sin -> "sin"
  Cos -> "cos"
  Tan -> "tan"
  Asin -> "asin"
  Acos -> "acos"
  Atan2 -> "atan2"
  Sqrt -> "sqrt"
  Abs -> "abs"
  Min -> "min"
  Max -> "max"
  Floor -> "floor"

-- | Is a built-in name a constant, that is, without arguments?
isConstant :: Builtin -> Bool
isConstant builtin = builtin `elem` [Pi, Truth, Falsehood]

-- | May a program define the name of a function for something else? Then it means this below.
-- Functions of regions and shapes, and those of Bézier curves, have such names, because older
-- programs use some of them.
mayBeHidden :: Text -> Bool
mayBeHidden word =
  maybe False (`elem` [RegionOf .. MakeBar] <> [MakeBezier, MakeBSpline]) (lookup word)

-- | The forms of a function, with the given unknowns in their types. If several forms still fit a
-- call when its statement has been checked to the end, the first of them in this list is chosen.
forms :: Fresh -> Builtin -> [Form]
forms Fresh {dimension = d, anything} builtin = case builtin of
  Pi -> [Form [] Type.number]
  Truth -> [Form [] Boolean]
  Falsehood -> [Form [] Boolean]
  Polar -> [Form [length', angle] (Spatial d)]
  Intersection ->
    [ Form ([given (word a) a, given (word b) b] <> selector) Type.aPoint
      | a <- [Line, Circle, Curve anything],
        b <- [Line, Circle, Curve anything],
        selector <- [] : [[Parameter Rank "" Wrong] | a /= Circle || b /= Circle] <> map pure chosen
    ]
      <> [ Form [given (word a) a, given (word b) b] PlaneRegion
           | a <- outlined,
             b <- outlined,
             a /= Circle || b /= Circle
         ]
  CentreOf -> [Form [circle] Type.aPoint]
  Midpoint -> [Form [given "first" Type.aPoint, given "second" Type.aPoint] Type.aPoint]
  Foot -> [Form [point, line] Type.aPoint, Form [point, curve] Type.aPoint]
  Tangency ->
    [ Form [given (word a) a, given (word b) b] Type.aPoint
      | (a, b) <- [(Line, Circle), (Circle, Line), (Circle, Circle)]
    ]
      <> [Form [point, c] Type.aPoint | c <- circle : sided "circle" Circle]
  PointOn -> [Form [circle, angle] Type.aPoint]
  MakeLine ->
    [ Form [given "from" Type.aPoint, given "to" Type.aPoint] Line,
      Form [given "from" Type.aPoint, angle] Line
    ]
      <> [Form [given "from" Type.aPoint, c] Line | c <- circle : sided "circle" Circle]
      <> [Form [c, given "to" Type.aPoint] Line | c <- circle : sided "circle" Circle]
      <> [ Form [c, e] Line
           | c <- circle : sided "first" Circle,
             e <- circle : sided "second" Circle
         ]
  Horizontal -> [Form [given "y" Type.len] Line]
  Vertical -> [Form [given "x" Type.len] Line]
  Parallel -> [Form [line, by] Line | by <- sided "distance" Type.len] <> [Form [line, point] Line]
  Perpendicular -> [Form [line, point] Line]
  MakeCircle ->
    [ Form [given "centre" Type.aPoint, radius] Circle,
      Form [given "centre" Type.aPoint, line] Circle,
      Form [given "first" Type.aPoint, given "second" Type.aPoint, given "third" Type.aPoint] Circle
    ]
      <> [ Form ([radius, a, b] <> selector) Circle
           | a <- touched,
             b <- touched,
             selector <- [] : map pure chosen
         ]
  Concentric -> [Form [circle, given "distance" Type.len] Circle]
  Distance ->
    [ Form [given (word a) a, given (word b) b] Type.len
      | (a, b) <-
          [ (Type.aPoint, Type.aPoint),
            (Type.aPoint, Line),
            (Line, Type.aPoint),
            (Line, Line),
            (Type.aPoint, Curve anything),
            (Curve anything, Type.aPoint)
          ]
    ]
  DirectionOf -> [Form [line] Type.angle, Form [given "vector" Type.aVector] Type.angle]
  RadiusOf -> [Form [circle] Type.len]
  LengthOf ->
    [ Form [given "contour" Contour] Type.len,
      Form [line] Type.len,
      Form [given "vector" Type.aVector] Type.len,
      Form [curve] Type.len,
      Form [given "region" PlaneRegion] Type.len
    ]
  RegionOf -> [Form [given (word t) t] PlaneRegion | t <- outlined <> map ListOf outlined]
  UnionOf ->
    [Form [given "first" a, given "second" b] PlaneRegion | a <- outlined, b <- outlined]
      <> [Form [given "list" (ListOf t)] PlaneRegion | t <- outlined]
  DifferenceOf ->
    [ Form [given "whole" a, given "less" b] PlaneRegion
      | a <- outlined,
        b <- outlined <> map ListOf outlined
    ]
  OffsetOf -> [Form [given (word t) t, given "distance" Type.len] PlaneRegion | t <- outlined]
  OutlinesOf -> [Form [given "region" PlaneRegion] (ListOf Contour)]
  HolesOf -> [Form [given "region" PlaneRegion] (ListOf Contour)]
  AreaOf -> [Form [given (word t) t] area | t <- outlined]
  CentroidOf -> [Form [given (word t) t] Type.aPoint | t <- outlined]
  MakeRectangle -> [Form corners Contour | corners <- rectangles]
  MakeRounded -> [Form (corners <> [radius]) Contour | corners <- rectangles]
  MakeSlot ->
    [Form [given "first" Type.aPoint, given "second" Type.aPoint, given "width" Type.len] Contour]
  MakePolygon ->
    [ Form [given "points" points] Contour,
      Form [circle, given "count" Type.number] Contour,
      Form [circle, given "count" Type.number, given "from" Type.angle] Contour
    ]
  MakeEllipse ->
    [ Form (given "centre" Type.aPoint : map (`given` Type.len) ["first", "second"] <> more) Contour
      | more <- [[], [angle]]
    ]
      <> [ Form
             [ given "centre" Type.aPoint,
               given "first" Type.len,
               given "second" Type.len,
               angle,
               given "from" Type.angle,
               given "to" Type.angle
             ]
             (Curve (Fields []))
         ]
  MakeBar -> [Form [given "diameter" Type.len, given "length" Type.len] Contour]
  MakeGear ->
    [ Form (given "module" Type.len : given "teeth" Type.number : more) Contour
      | more <- [[], [given "pressure_angle" Type.angle]]
    ]
  XOf -> [Form [given "point" (Spatial d)] Type.len]
  YOf -> [Form [given "point" (Spatial d)] Type.len]
  MakeBezier -> [f | more <- [[], [weights]], f <- curveBy [] more]
  MakeBSpline ->
    [ f
      | more <- [[], [weights]],
        f <- curveBy [given "degree" Type.number] (given "knots" (ListOf Type.number) : more)
    ]
  MakeSpline ->
    curveThrough []
      <> curveThrough [given "first_direction" Type.angle, given "last_direction" Type.angle]
  ClosedSpline -> curveThrough []
  Polyline -> curveThrough []
  Parabola -> curveThrough []
  Biarcs -> curveThrough [] <> [Form [curve, tolerance] (Curve (Fields []))]
  ClosedBiarcs -> curveThrough []
  Fit -> curveThrough [tolerance]
  Sections -> curveThrough [given "rows" (ListOf (ListOf Type.number))]
  RowsOf -> [Form [table', given "numbers" (ListOf Type.number)] (Table anything)]
  PointsOf -> [Form [table'] points]
  PointAtX ->
    [ Form ([curve, given "x" Type.len] <> selector) Type.aPoint
      | selector <- [] : [Parameter Rank "" Wrong] : map pure chosen
    ]
  PointAlong -> [Form [curve, given "length" Type.len] Type.aPoint]
  LengthAlong -> [Form [curve, point] Type.len]
  StartOf -> [Form [curve] Type.aPoint]
  EndOf -> [Form [curve] Type.aPoint]
  TangentOf -> [Form [curve, point] Type.angle]
  NormalOf -> [Form [curve, point] Type.angle]
  CurvatureOf -> [Form [curve, point] (Quantity (Dimension.power (-1) (Type.dimensionOf Type.len)))]
  Moved -> transforming [[given "by" Type.aVector]]
  Rotated -> transforming [[angle], [angle, given "about" Type.aPoint]]
  Mirrored -> transforming [[given "axis" Line]]
  Scaled ->
    transforming
      [[given "factor" Type.number], [given "factor" Type.number, given "about" Type.aPoint]]
  Reversed ->
    [Form [given (word t) t] t | t <- [Contour, Line, Curve anything]]
      <> [Form [given "list" (ListOf anything)] (ListOf anything)]
  Row ->
    [Form [given "first" Type.aPoint, given "step" Type.aVector, given "count" Type.number] points]
  Grid ->
    [ Form
        [ given "first" Type.aPoint,
          given "step" Type.aVector,
          given "count" Type.number,
          given "other_step" Type.aVector,
          given "rows" Type.number
        ]
        points
    ]
  Around ->
    [ Form [circle, given "count" Type.number] points,
      Form [circle, given "count" Type.number, given "from" Type.angle] points,
      Form
        [circle, given "count" Type.number, given "from" Type.angle, given "to" Type.angle]
        points
    ]
  Count -> [Form [given "list" (ListOf anything)] Type.number]
  ItemOf -> [Form [given "list" (ListOf anything), given "number" Type.number] anything]
  Lift -> [Form [point, given "z" Type.len] SpacePoint]
  Sin -> [Form [angle] Type.number]
  Cos -> [Form [angle] Type.number]
  Tan -> [Form [angle] Type.number]
  Asin -> [Form [given "sine" Type.number] Type.angle]
  Acos -> [Form [given "cosine" Type.number] Type.angle]
  Atan2 -> [Form [given "y" (Quantity d), given "x" (Quantity d)] Type.angle]
  Sqrt -> [Form [given "value" (Quantity (Dimension.power 2 d))] (Quantity d)]
  Abs -> [Form [given "value" (Quantity d)] (Quantity d)]
  Min -> [Form [given "first" (Quantity d), given "second" (Quantity d)] (Quantity d)]
  Max -> [Form [given "first" (Quantity d), given "second" (Quantity d)] (Quantity d)]
  Floor -> [Form [given "value" Type.number] Type.number]
  where
    given = Parameter NoLabel
    length' = given "length" Type.len
    angle = given "angle" Type.angle
    radius = given "radius" Type.len
    point = given "point" Type.aPoint
    line = given "line" Line
    circle = given "circle" Circle
    curve = given "curve" (Curve anything)
    table' = given "table" (Table anything)
    tolerance = Parameter (Word WithinTolerance) "tolerance" Type.len
    -- The forms of a function that makes a curve through the rows of a table or through points.
    -- @more@ are the other parameters. Points have no columns besides x and y.
    curveThrough more =
      [ Form (table' : more) (Curve anything),
        Form (given "points" points : more) (Curve (Fields []))
      ]
    -- The forms of a function that makes a curve by control points, which the curve does not pass.
    -- @before@ and @after@ are the parameters before and after them.
    curveBy before after =
      [Form (before <> (by : after)) (Curve (Fields [])) | by <- [given "points" points, table']]
    weights = given "weights" (ListOf Type.number)
    points = ListOf Type.aPoint
    -- The types of values that have an inside.
    outlined = [Contour, PlaneRegion, Circle]
    area = Quantity (Dimension.power 2 (Type.dimensionOf Type.len))
    rectangles =
      [ [given "first" Type.aPoint, given "opposite" Type.aPoint],
        [given "corner" Type.aPoint, given "width" Type.len, given "height" Type.len]
      ]
    word t = Text.unwords (drop 1 (Text.words (Type.describe t)))
    sided title t = [Parameter (Word side) title t | side <- [ToLeft, ToRight]]
    -- The labelled parameters of a construction that may have several solutions. The argument of
    -- such a parameter chooses one of them.
    chosen =
      [Parameter (Word Near) "point" Type.aPoint]
        <> sided "line" Line
        <> [Parameter (Word side) "circle" Circle | side <- [ToInside, ToOutside]]
    -- The possible parameters for one condition on a circle of a given radius. The circle passes
    -- through the point, or touches the line or the circle that is given. A label chooses the side
    -- of this line or circle.
    touched =
      [point, line, circle]
        <> sided "line" Line
        <> [Parameter (Word side) "circle" Circle | side <- [ToInside, ToOutside]]
    -- The forms of a function such as @rotated@. Its first parameter is the value to transform.
    -- Each item of @extra@ is a possible list of the other parameters. A call without a value to
    -- transform yields the transformation itself.
    transforming extra =
      concat
        [ Form more Transformation :
            [ Form (given "what" t : more) t
              | t <-
                  [ Type.aPoint,
                    Circle,
                    Line,
                    Contour,
                    PlaneRegion,
                    Curve anything,
                    ListOf (Curve anything),
                    ListOf Type.aPoint,
                    ListOf Circle,
                    ListOf Line,
                    ListOf Contour
                  ]
            ]
          | more <- extra
        ]

-- | The forms of a function whose parameters have exactly the given labels, in this order. The
-- given unknowns occur in their types.
labelled :: Fresh -> Builtin -> [ArgumentLabel] -> [Form]
labelled Fresh {dimension, anything} builtin labels =
  map made (maybe [] (Map.findWithDefault [] labels) (Lazy.lookup builtin byLabels))
  where
    made form =
      form
        { parameters = [p {type' = own (type' p)} | p <- parameters form],
          result = own (result form)
        }
    own =
      Type.substitute
        (Dimension.substitute anyUnknown dimension)
        (\n -> if n == anyUnknown then anything else Variable n)

-- | The forms of each function, grouped by the labels of their parameters. In the types of the
-- forms, 'anyUnknown' represents every unknown.
byLabels :: Lazy.Map Builtin (Map [ArgumentLabel] [Form])
byLabels =
  Lazy.fromList
    [ ( b,
        Map.fromListWith
          (flip (<>))
          [(map label (parameters f), [f]) | f <- forms unknownTemplate b]
      )
      | b <- [minBound .. maxBound]
    ]

unknownTemplate :: Fresh
unknownTemplate =
  Fresh {dimension = Dimension.atom (Dimension.Unknown anyUnknown), anything = Variable anyUnknown}

-- | The forms of a function that have exactly @count@ parameters, all without labels. The flag of a
-- form is true if its types contain no unknowns.
unlabelled :: Builtin -> Int -> [(Form, Bool)]
unlabelled builtin count = maybe [] (Map.findWithDefault [] count) (Lazy.lookup builtin byCount)

byCount :: Lazy.Map Builtin (Map Int [(Form, Bool)])
byCount =
  fmap
    ( \labels ->
        Map.fromList
          [ (length ls, [(f, isKnown f) | f <- fs])
            | (ls, fs) <- Map.toList labels,
              all (== NoLabel) ls
          ]
    )
    byLabels
  where
    isKnown f =
      all
        (\t -> null (Type.dimensions t) && null (Type.variables t))
        (result f : map type' (parameters f))

-- | Has a function several forms?
isOverloaded :: Builtin -> Bool
isOverloaded builtin = not (null (drop 1 (forms unknownTemplate builtin)))

-- | The number that represents every unknown in 'byLabels'. No unknown of type inference has this
-- number, because inference numbers its unknowns from 0.
anyUnknown :: Int
anyUnknown = -1

-- | The text of a form, written as a call with the names of its parameters, for reports.
formText :: Builtin -> Form -> Text
formText builtin form = callText (name builtin) (map parameter (parameters form))
  where
    parameter p = case label p of
      NoLabel -> title p
      Rank -> "first or last"
      Word choice -> Keyword.selectorWord choice <> " " <> title p

-- | The description of a built-in function or constant, for editors: its first four forms.
description :: Builtin -> Text
description builtin = "of the language: " <> Text.intercalate "; " (take 4 (formTexts builtin))

-- | All forms of a function as calls with the names of their parameters, without repetitions.
formTexts :: Builtin -> [Text]
formTexts builtin =
  nubOrd (map (formText builtin) (formsForReports builtin))

-- | All forms of a function, with a type that fits every other one for their unknowns.
formsForReports :: Builtin -> [Form]
formsForReports = forms Fresh {dimension = Dimension.none, anything = Wrong}

-- | A call of @function@ with the arguments @titles@, as text.
callText :: Text -> [Text] -> Text
callText function titles = function <> "(" <> Text.intercalate ", " titles <> ")"
