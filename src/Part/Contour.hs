-- | The contours of the evaluated part. Lines and arcs are exact. A curve is replaced by arcs and
-- lines, which keep it.
module Part.Contour
  ( Contour (..),
    ContourElement (..),
    Element (..),
    ReplacedCurve (..),
    transformedCurve,
    Finish (..),
    plainFinish,
    curveRuns,
    polyarcOf,
    reversedContour,
  )
where

import Base.Name (Name)
import Base.Quantity (Mm (..), times)
import Base.Region (Located, Region)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Traversable (mapAccumR)
import Data.Tuple (swap)
import Geometry.Curve (Curve)
import Geometry.Curve qualified as Curve
import Geometry.ElementCarrier (ElementCarrier)
import Geometry.Polyarc (Ends (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Transformation (Transformation)
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point)
import Part.Curve (PartCurve)
import Part.CutFeed (CutFeed)
import Part.Link (Link)

-- | A contour of the part.
data Contour = Contour
  { contourName :: Located Name,
    ends :: Ends,
    -- | the segments of the contour; each begins where the segment before it ends
    elements :: NonEmpty Element,
    -- | the points at which the contour may have a break: where the changes of distance of its
    -- pieces begin and end
    breaks :: [Point],
    -- | the elements as the program writes them. The list is empty if they no longer describe the
    -- contour, because it was transformed, reversed, or given another start. It is also empty in a
    -- toolpath, to save memory
    writtenElements :: [ContourElement]
  }
  deriving stock (Eq, Show)

-- | An element of a contour as the program writes it.
data ContourElement = ContourElement
  { elementRegion :: Region,
    elementCarrier :: ElementCarrier,
    -- | the exact curve, if the element is a curve
    elementCurve :: Maybe PartCurve,
    elementFinish :: Finish,
    -- | the link to the element after this one; absent if the program writes none
    link :: Maybe Link
  }
  deriving stock (Eq, Show)

-- | One segment of a contour, with the properties of the element that it is a part of, or of the
-- link that inserted it.
data Element = Element
  { segment :: Segment,
    -- | the region of this element or link
    origin :: Region,
    finish :: Finish,
    -- | true if the segment continues the segment before it in the same element, without a corner.
    -- In a smooth closed curve, the first segment continues the last one
    continues :: Bool,
    -- | true if the segment is one of the arcs and lines that replace a curve
    ofCurve :: Bool,
    -- | the curve that the segment replaces a part of. It is absent for lines and arcs, and for the
    -- offset of a curve. It is evaluated when it is needed
    replaced :: Maybe ReplacedCurve,
    -- | the bevels at the start and at the end of the segment, in radians; absent if the program
    -- gives the element no bevel. A bevel is the angle between the part's surface and the tool axis
    bevel :: Maybe (Double, Double)
  }
  deriving stock (Eq, Show)

-- | A curve that arcs and lines replace in a contour. It may have the opposite direction.
data ReplacedCurve = ReplacedCurve
  { exact :: Curve,
    -- | the largest distance of the arcs and lines from the curve
    deviation :: Mm
  }
  deriving stock (Show)

-- | Segments that are equal replace equal curves. A comparison of the curves would evaluate them.
instance Eq ReplacedCurve where
  _ == _ = True

-- | The image of a curve and its arcs and lines under a transformation.
transformedCurve :: Transformation -> ReplacedCurve -> ReplacedCurve
transformedCurve s ReplacedCurve {exact, deviation} =
  ReplacedCurve
    { exact = Curve.transformed s exact,
      deviation = times (Transformation.factor s) deviation
    }

-- | The effect of the modifiers of one element: feed, slow-down and allowance.
data Finish = Finish
  { -- | the feed along the element; without it, the feed of the machining statement applies
    ownFeed :: Maybe (Located CutFeed),
    -- | true if the cutter slows down at the element's end
    slow :: Bool,
    -- | the material to leave on the element, in addition to the allowance of the pass
    allowance :: Mm
  }
  deriving stock (Eq, Show)

-- | The finish of an element without modifiers.
plainFinish :: Finish
plainFinish = Finish {ownFeed = Nothing, slow = False, allowance = Mm 0}

-- | Groups the segments that continue one another. Each group is one line, one arc, or one curve
-- without corners.
curveRuns :: [Element] -> [NonEmpty Element]
curveRuns es = case es of
  [] -> []
  e : rest -> let (same, others) = span continues rest in (e :| same) : curveRuns others

-- | The contour in the opposite direction. If segment B continues segment A in the given contour,
-- A continues B in the result.
reversedContour :: Contour -> Contour
reversedContour c =
  c {elements = NonEmpty.reverse opposite, writtenElements = []}
  where
    opposite = snd (mapAccumR reversed first (elements c))
    first = continues (NonEmpty.head (elements c))
    reversed next e =
      ( continues e,
        e {segment = Segment.reverse (segment e), bevel = fmap swap (bevel e), continues = next}
      )

-- | The segments of a contour as a polyarc. Each list cell of the result is evaluated together with
-- its segment. Otherwise the unevaluated segment would keep an 'Element' in memory.
polyarcOf :: Contour -> Polyarc.Polyarc
polyarcOf contour = Polyarc.Polyarc (ends contour) (segment first :| segmentsOf others)
  where
    first :| others = elements contour
    segmentsOf es = case es of
      [] -> []
      e : rest -> let s = segment e in s `seq` (s : segmentsOf rest)
