{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Names of functions and values in other languages, with what the language has for them.
module Checked.NameMeaning
  ( meanings,
    linksMeant,
    advice,
  )
where

import Data.Text (Text)
import Data.Text qualified as Text

-- | The names of the language that an unknown name may mean, the most likely one first.
meanings :: Text -> [Text]
meanings name = [new | (new, olds) <- table, Text.toLower name `elem` Text.words olds]
  where
    table =
      [ ("distance", "dist hypot hypotenuse len length dst gap"),
        ("length_of", "len length norm magnitude mag perimeter arclength arc_length"),
        ("count_of", "size count len num length"),
        ("moved", "move translate translated shift shifted offset displaced"),
        ("rotated", "rotate rot turn turned rotation"),
        ("mirrored", "mirror flip reflect reflected flipped"),
        ("scaled", "scale resize"),
        ("reversed", "reverse backwards inverted"),
        ("midpoint", "mid middle mid_point average mean halfway"),
        ("centre_of", "center centre center_of centerpoint"),
        ("intersection", "intersect inters cross crossing meet intersect_of cut"),
        ("foot_of", "project projection projected perpendicular_foot foot"),
        ("perpendicular", "perp normal_line orthogonal"),
        ("parallel", "par offset_line"),
        ("circle", "circ disc disk circle2d"),
        ("line", "segment seg edge line2d lineto"),
        ("polyline", "polygon poly path lines"),
        ("spline", "bspline nurbs interpolate spl curve cubic"),
        ("arcs", "biarc biarcs"),
        ("radius_of", "rad radius getradius"),
        ("direction_of", "angle angle_of heading bearing slope azimuth direction"),
        ("x_of", "x getx xcoord px"),
        ("y_of", "y gety ycoord py"),
        ("start_of", "start startpoint begin first_point"),
        ("end_of", "end endpoint last_point finish"),
        ("item_of", "item get nth at index element"),
        ("grid", "array matrix rectangular_pattern pattern"),
        ("row", "linear_pattern series array linear"),
        ("around", "bolt_circle polar_array circular_pattern pcd ring polar_pattern holes"),
        ("polar", "from_angle polarpoint pol"),
        ("atan2", "atan arctan arctan2"),
        ("asin", "arcsin"),
        ("acos", "arccos"),
        ("sqrt", "root squareroot square_root sqr_root"),
        ("abs", "absolute fabs"),
        ("floor", "int trunc round"),
        ("min", "minimum least"),
        ("max", "maximum largest"),
        ("pi", "π m_pi"),
        ("true", "yes"),
        ("false", "no")
      ]

-- | The words of links and senses that an unknown name in a contour may mean.
linksMeant :: Text -> [Text]
linksMeant name = [new | (new, olds) <- table, Text.toLower name `elem` Text.words olds]
  where
    table =
      [ ("fillet", "radius round rounded blend r rad corner arc"),
        ("chamfer", "cham bevelled c"),
        ("tangent", "tangential"),
        ("smooth", "smoothly"),
        ("feed", "f feedrate speed"),
        ("cw", "clockwise cwise"),
        ("ccw", "counterclockwise anticlockwise acw")
      ]

-- | The way in which the language says what a function of another language computes. 'Nothing' for
-- functions that have a counterpart or of which nothing is known.
advice :: Text -> Maybe Text
advice name = lookup (Text.toLower name) table
  where
    table =
      [ (old, new)
        | (olds, new) <-
            [ ("pow power sq sqr square exp2", "There are no powers: write x * x."),
              ("hypot", "The hypotenuse is sqrt(a * a + b * b), or distance(p, q) of two points."),
              ( "atan arctan",
                "The angle of a slope is atan2(slope, 1), and that of y / x is atan2(y, x)."
              ),
              ("round", "The nearest whole number is floor(x + 0.5)."),
              ("ceil ceiling", "The next whole number is -floor(-x)."),
              ("mod fmod remainder", "The remainder is x - n * floor(x / n)."),
              ("radians deg2rad torad", "An angle in degrees is written with its unit: 30 deg."),
              ("degrees rad2deg todeg", "An angle in radians is written with its unit: x * 1 rad."),
              ( "arc arcto arc_to",
                "An arc of a contour is a circle with its sense: cw circle(c, r). Its ends are \
                \where it meets its neighbours."
              ),
              ( "rect rectangle square box",
                "A rectangle is a contour of its four corners: contour r closed { (0, 0) (40, 0) \
                \(40, 20) (0, 20) }"
              ),
              ( "slot hexagon ellipse",
                "Write its contour of lines, circles with their senses, and points."
              ),
              ("range seq linspace", "A list of numbers is written 0..3, or 0..10 by 2."),
              ("print echo write", "A program prints nothing; partc report shows what it makes."),
              ("exp log ln log10", "There are no powers and no logarithms.")
            ],
          old <- Text.words olds
      ]
