-- | The limits and tolerances of the readers of drawings, by name. Lengths are in mm where a
-- comment says so, else in the unit of the file.
module Drawing.Tolerance
  ( -- * Limits
    mostParts,
    mostNesting,
    mostElementDepth,
    mostEntityLength,
    mostExpansion,
    mostDigits,
    mostErrors,
    mostNameLength,
    largeUnit,
    largeDrawing,

    -- * Tolerances
    sameHeight,
    uprightNormal,
    fullTurn,
    sameAxes,
    closedSpline,
    flatArc,
  )
where

import Base.Quantity (Mm (..))
import Geometry.Tolerance qualified as Tolerance

-- | The largest count of parts of a drawing after all insertions: entities, remarks, insertions and
-- the points of shapes. It bounds the memory for a small file whose blocks contain one another.
mostParts :: Int
mostParts = 500000

-- | The largest depth of blocks or elements within one another.
mostNesting :: Int
mostNesting = 64

-- | The largest depth of XML elements within one another.
mostElementDepth :: Int
mostElementDepth = 500

-- | The largest count of characters of an XML entity that a file declares. Programs declare the
-- names of namespaces.
mostEntityLength :: Int
mostEntityLength = 1000

-- | The largest count of characters that all references to declared entities may have together.
mostExpansion :: Int
mostExpansion = 20000000

-- | The largest count of digits of a number.
mostDigits :: Int
mostDigits = 400

-- | The largest count of errors that a reader reports for one file.
mostErrors :: Int
mostErrors = 20

-- | The largest count of characters of a wrong word that an error repeats.
mostNameLength :: Int
mostNameLength = 40

-- | A drawing is suspected to have a wrong unit if its unit is longer than this, and its width or
-- height larger than 'largeDrawing'. Some libraries write metres into each file.
largeUnit :: Mm
largeUnit = Mm 100

largeDrawing :: Mm
largeDrawing = Mm 10000

-- | The largest difference of the heights of an entity's points that count as equal, in the unit of
-- the file.
sameHeight :: Double
sameHeight = 1e-6

-- | The largest component along x or y, as a share of the component along z, of an extrusion that
-- is square to the plane of the drawing.
uprightNormal :: Double
uprightNormal = 1e-9

-- | The largest difference in radians between the range of an ellipse's parameters and a full turn.
-- Some programs write six digits only, so that a full turn ends at 6.28318.
fullTurn :: Double
fullTurn = 1e-5

-- | The largest difference of the semi-axes of an ellipse, as a share of the larger one, with which
-- it counts as a circle. It is some rounding errors of a product of maps.
sameAxes :: Double
sameAxes = 1e-12

-- | The largest distance between the ends of a spline that the file calls closed, as a share of the
-- largest distance of its control points from the first one. Knot insertion rounds each end
-- separately.
closedSpline :: Double
closedSpline = 1e-9

-- | The largest sagitta of an arc that counts as a line if its radius is out of reach.
flatArc :: Mm
flatArc = Tolerance.coincident
