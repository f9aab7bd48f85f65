-- | Elements of a contour, in a bounding-box tree, for the comparison with a tape. Each element is
-- stored with the numbers that every comparison needs.
module Verify.Edge
  ( Edge (..),
    edgesOf,
    isCurved,
    largestAllowance,
    leastExcess,
    leftwardness,
  )
where

import Base.Quantity (Mm (..))
import Data.List (foldl')
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Corner qualified as Corner
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Contour, Element)
import Part.Part qualified as Part

-- | Element of a contour, with its numbers, so that they are not computed again for each motion.
data Edge = Edge
  { element :: Element,
    -- | number of the element in the contour, from 0
    rank :: Int,
    -- | arc length from the start of the contour to the start of the element, in mm
    startsAt :: Double,
    -- | length of the element, in mm
    long :: Double,
    -- | allowance of the element itself, in addition to that of the pass
    ownAllowance :: Mm,
    -- | true if this element and the one before it replace the same curve of the part
    continues :: Bool,
    -- | segment of the element
    shape :: Segment
  }

-- | Bounding-box tree of the elements of a contour.
edgesOf :: Contour -> BoxTree Edge
edgesOf contour =
  BoxTree.indexFirst
    (NonEmpty.length elements)
    (FastDistance.box . shape)
    (go 0 0 (NonEmpty.toList elements))
  where
    elements = Part.elements contour
    -- Strict in the sum of lengths, so that no thunk keeps the earlier elements in memory.
    go :: Int -> Double -> [Element] -> [Edge]
    go rank startsAt rest = case rest of
      [] -> []
      element : more ->
        let Mm long = Segment.length (Part.segment element)
            endsAt = startsAt + long
            edge =
              Edge
                { element,
                  rank,
                  startsAt,
                  long,
                  ownAllowance = Part.allowance (Part.finish element),
                  continues = Part.continues element,
                  shape = Part.segment element
                }
         in edge `seq` endsAt `seq` (edge : go (rank + 1) endsAt more)

-- | Test that a contour has curves. It has one if an element and the element before it replace the
-- same curve.
isCurved :: BoxTree Edge -> Bool
isCurved = BoxTree.foldl' (\is e -> is || continues e) False

-- | Largest allowance of a single element, in mm; -∞ without elements.
largestAllowance :: BoxTree Edge -> Mm
largestAllowance = BoxTree.foldl' (\most e -> max most (ownAllowance e)) (Mm (-1 / 0))

-- | Least excess distance in mm of the elements @near@, but at most @limit@. The excess distance of
-- an element is its distance from the point @p@ minus its allowance, which @allowanceOf@ gives. A
-- cutter with its centre at @p@ touches the elements whose excess distance is about the least one.
leastExcess :: (Edge -> Mm) -> Double -> [Edge] -> Point -> Double
leastExcess allowanceOf limit near p = foldl' lesser limit near
  where
    lesser least e
      | Mm a <- allowanceOf e,
        far <- min limit (least + a),
        FastDistance.mayLieWithin far (long e) (shape e) (Vec.x p) (Vec.y p) =
        min least (FastDistance.distance (shape e) (Vec.x p) (Vec.y p) - a)
      | otherwise = least

-- | Signed distance in mm of the point @p@ from a contour ('Corner.leftwardness'). @foot@ is the
-- point of the contour that is nearest to @p@.
leftwardness :: BoxTree Edge -> Point -> Point -> Double
leftwardness edges foot p =
  Corner.leftwardness
    ( map
        shape
        ( BoxTree.within
            (BoundingBox.inflate Tolerance.coincident (BoundingBox.ofPoints foot []))
            edges
        )
    )
    foot
    p
