-- | A drawing that another program made, as its file gives it: entities in mm, with y upwards. DXF
-- and SVG files are read to this type.
module Drawing.Drawing
  ( Drawing (..),
    PresumedSize (..),
    Entity (..),
    Shape (..),
    PathPart (..),
    Ellipse (..),
    ellipsePoint,
    Spline (..),
    Remark (..),
    RemarkKind (..),
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Data.List.NonEmpty (NonEmpty)
import Data.Text (Text)
import Geometry.Carrier (Circle)
import Geometry.Polyarc (Ends)
import Geometry.Segment (Segment)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | A drawing.
data Drawing = Drawing
  { -- | the entities in the order of the file; those of an inserted block are at the position of
    -- the insertion
    entities :: [Entity],
    -- | the things that were left out or changed, in the order of the file
    remarks :: [Remark],
    -- | the size of a drawing whose unit may not be the one that is meant
    presumed :: Maybe PresumedSize
  }
  deriving stock (Eq, Show)

-- | The size in mm of the page, or of all that is drawn if there is no page.
data PresumedSize = PresumedSize
  { -- | the line of the file at which the page begins, or that gives the unit
    sizeLine :: Int,
    -- | the unit of a DXF drawing that is very large. Nothing for an SVG drawing whose unit neither
    -- the file nor the program gives, so that a pixel counts as 1\/96 in
    largeUnit :: Maybe Text,
    width :: Mm,
    height :: Mm
  }
  deriving stock (Eq, Show)

-- | An entity of a drawing.
data Entity = Entity
  { -- | number of the line of the file on which the word of the entity stands, from 1
    line :: Int,
    -- | the word of the file for this kind of entity, as @LWPOLYLINE@ or @path@
    word :: Text,
    -- | the layer of a DXF file; of an SVG file, the innermost group that is a layer of Inkscape,
    -- or else the empty text
    layer :: Text,
    -- | the identifiers of an SVG element and of the groups around it, from the inside
    identifiers :: [Text],
    -- | the classes of an SVG element and of the groups around it
    classes :: [Text],
    shape :: Shape
  }
  deriving stock (Eq, Show)

-- | The shape of an entity.
data Shape
  = -- | consecutive parts; each begins where the one before it ends
    Path Ends (NonEmpty PathPart)
  | FullCircle Circle
  | FullEllipse Ellipse
  | Dot Point
  deriving stock (Eq, Show)

-- | A part of a path.
data PathPart
  = -- | a line or an arc
    Plain Segment
  | -- | a part of an ellipse, from one parameter in radians to another ('ellipsePoint'). The second
    -- one is smaller if the part runs clockwise
    EllipseArc Ellipse Double Double
  | -- | a Bézier curve of degree 2 or higher: its control points, and their weights if it is
    -- rational
    Bezier (NonEmpty Point) (Maybe (NonEmpty Double))
  | BSpline Spline
  deriving stock (Eq, Show)

-- | An ellipse: its centre, its semi-axes, the larger one first, and the direction of the larger
-- one.
data Ellipse = Ellipse {middle :: Point, major :: Mm, minor :: Mm, direction :: Rad}
  deriving stock (Eq, Show)

-- | The point of an ellipse at a parameter in radians: 0 is the end of the larger semi-axis in its
-- direction, π\/2 is the end of the other one, a quarter turn counter-clockwise from it.
ellipsePoint :: Ellipse -> Double -> Point
ellipsePoint Ellipse {middle, major = Mm a, minor = Mm b, direction} t =
  Vec.shift (Vec.rotate direction (Vec.vec (a * cos t) (b * sin t))) middle

-- | A B-spline with clamped ends: the first and the last @degree + 1@ knots are equal, so that the
-- curve begins and ends at a control point. Inner knots occur @degree@ times at most.
data Spline = Spline
  { degree :: Int,
    -- | one for each control point and @degree + 1@ more, in ascending order
    knots :: [Double],
    controls :: NonEmpty Point,
    -- | a positive weight for each control point, if the spline is rational
    weights :: Maybe (NonEmpty Double)
  }
  deriving stock (Eq, Show)

-- | Something that the reader of a drawing left out or changed: the line of the file, the layer,
-- the identifiers and the classes as those of an entity.
data Remark = Remark
  { remarkLine :: Int,
    remarkKind :: RemarkKind,
    remarkLayer :: Text,
    remarkIdentifiers :: [Text],
    remarkClasses :: [Text]
  }
  deriving stock (Eq, Ord, Show)

-- | The kinds of remarks.
data RemarkKind
  = -- | an entity or an element that the reader does not understand: its word
    NotUnderstood Text
  | -- | an entity whose numbers make no curve: its word and the reason
    Unusable Text Text
  | -- | an entity that is not parallel to the plane of the drawing: its word
    NotInPlane Text
  | -- | a spline that is given only by points through which it goes: its word
    ThroughPoints Text
  | -- | a polyline that was smoothed to a spline and is read as the polyline that draws it: its
    -- word
    Smoothed Text
  | -- | an entity on a page for printing: its word
    InPaperSpace Text
  | -- | an entity or an element that is not visible and is not read: its word
    Invisible Text
  | -- | an entity on a layer that is frozen or off, and is not read: its word and the layer
    OnHiddenLayer Text Text
  | -- | an element that the file clips or masks, and that is read as a whole: its word
    Unclipped Text
  deriving stock (Eq, Ord, Show)
