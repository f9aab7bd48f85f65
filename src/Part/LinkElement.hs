-- | The elements of a contour before their links are solved.
module Part.LinkElement
  ( LinkedElement (..),
    edgesOf,
    breakBetween,
  )
where

import Base.Quantity (Rad (..))
import Base.Region (Region)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Curve qualified as Exact
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.Polyarc (Ends (..))
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Curve (PartCurve (exact))
import Part.Link (Link (..))
import Part.Part (Finish, ReplacedCurve)
import Part.Tolerance qualified as PartTolerance

-- | An element of a contour, and the link to the element after it.
data LinkedElement = LinkedElement
  { elementRegion :: Region,
    -- | the item of the contour that gives the element: its sense, element, modifiers and link
    itemRegion :: Region,
    carrier :: ElementCarrier,
    -- | the start and the end of the element as the program defines it, before any link shortens
    -- it. A circle has neither
    ownStart :: Maybe Point,
    ownEnd :: Maybe Point,
    finish :: Finish,
    -- | the bevels of the element's surface: pairs of a station in mm and an angle in radians, with
    -- rising stations. A single pair holds for the whole element
    bevel :: [(Double, Double)],
    -- | the exact curve, if the element is a curve
    sourceCurve :: Maybe PartCurve,
    -- | the curve that the segments replace: that of 'sourceCurve', or that of the contour that is
    -- used as an element
    replacedCurve :: Maybe ReplacedCurve,
    -- | the points at which the element may have a break ("Part.Break")
    breaks :: [Point],
    -- | the region of the link, and the link; absent if the program writes no link. The element
    -- then meets the next one, unless it is the last of an open contour
    link :: Maybe (Region, Link)
  }
  deriving stock (Eq, Show)

-- | If all elements of a contour are points: the region of each point that has a point before it,
-- and the point before it.
edgesOf :: Ends -> NonEmpty LinkedElement -> [(Region, Point)]
edgesOf ends linked = case traverse asPoint (NonEmpty.toList linked) of
  Just points@(first : others)
    | ends == Closed -> zip (map fst points) (snd (last points) : map snd points)
    | not (isRounded (NonEmpty.head linked)) ->
      zip (map fst others) (snd first : map snd others)
  _ -> []
  where
    -- The first point of an open contour is no corner.
    isRounded w = case link w of
      Just (_, Fillet _ _) -> True
      Just (_, Chamfer _) -> True
      _ -> False
    asPoint w = case carrier w of
      AtPoint p -> Just (elementRegion w, p)
      OnLine _ -> Nothing
      OnCircle _ _ -> Nothing
      OnCurve _ -> Nothing

-- | End of the first element and start of the second one, if they are pieces between which there is
-- a break ("Part.Break"): the curves from which the pieces are made continue one another smoothly,
-- but the distances of the pieces change differently there. So the pieces meet at a slight corner.
breakBetween :: LinkedElement -> LinkedElement -> Maybe (Point, Point)
breakBetween a b = case (sourceCurve a, sourceCurve b) of
  (Just c, Just d)
    | areOne (Exact.end (exact c)) (Exact.start (exact d)),
      areOne (Exact.end (theoretical c)) (Exact.start (theoretical d)),
      turn (theoretical c) (theoretical d) <= PartTolerance.smoothTurn,
      turn (exact c) (exact d) > PartTolerance.smoothTurn,
      turn (exact c) (exact d) <= Tolerance.joinedCorner ->
      Just (Exact.end (exact c), Exact.start (exact d))
  _ -> Nothing
  where
    theoretical = Exact.unshifted . exact
    areOne p q = Vec.distance p q <= PartTolerance.smoothGap
    turn c d =
      let Rad angle =
            Vec.signedAngle
              (Exact.tangentFrom Exact.Before c (Exact.domain c))
              (Exact.tangentFrom Exact.After d 0)
       in Rad (abs angle)
