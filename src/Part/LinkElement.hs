-- | The elements of a contour before their links are solved.
module Part.LinkElement
  ( LinkedElement (..),
    edgesOf,
  )
where

import Base.Region (Region)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.Polyarc (Ends (..))
import Geometry.Vec (Point)
import Part.Curve (PartCurve)
import Part.Link (Link (..))
import Part.Part (Finish)

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
