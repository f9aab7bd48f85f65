-- | What has to hold of the contours of a pocket: all of them are closed, and the islands lie
-- inside the outline and apart from it and from one another.
module Part.PocketCheck
  ( misfits,
    halfWidth,
    Named (..),
  )
where

import Base.Name (Name)
import Base.Quantity (Mm (..))
import Base.Region (Located (..), Region)
import Data.List (nubBy)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.WindingNumber qualified as WindingNumber
import Part.Part (Contour (..), Ends (..))
import Part.Part qualified as Part
import Part.PocketError (PocketMisfit (..))

-- | A contour, and where the statement names it.
data Named = Named {place :: Region, contour :: Contour}

-- | Why a pocket of this outline and these islands cannot be.
misfits :: Named -> [Named] -> [PocketMisfit]
misfits outline islands = case filter isOpen (outline : islands) of
  [] -> map met meetings <> [f | k <- loose, Just f <- [astray k]]
  open -> [OpenContour (place n) (nameOf n) (placeOf n) | n <- open]
  where
    isOpen n = ends (contour n) == Open
    numbered = zip [0 ..] (outline : islands)
    meetings = nubBy (\(i, j, _) (k, l, _) -> (i, j) == (k, l)) (crossings numbered)
    met (i, j, p) =
      let (a, b) = (named j, named i) in Meets (place a) (nameOf a) (nameOf b) (i == 0) p
    named i = (outline : islands) !! i
    -- Of islands that meet something it is said already.
    loose =
      [(k, n) | (k, n) <- drop 1 numbered, k `notElem` concat [[i, j] | (i, j, _) <- meetings]]
    -- An island meets nothing, so all of it lies where its beginning lies.
    astray (k, n)
      | not (WindingNumber.encloses (Part.outline (contour outline)) (beginning n)) =
        Just (Outside (place n) (nameOf n) (nameOf outline))
      | otherwise =
        case [ m
               | (l, m) <- drop 1 numbered,
                 l /= k,
                 BoundingBox.meets (boxOf n) (boxOf m),
                 WindingNumber.encloses (Part.outline (contour m)) (beginning n)
             ] of
          m : _ -> Just (InIsland (place n) (nameOf n) (nameOf m))
          [] -> Nothing

-- | Where elements of two of some numbered contours cross or touch: the lower number first.
crossings :: [(Int, Named)] -> [(Int, Int, Point)]
crossings numbered =
  [ (i, j, p)
    | (j, n) <- numbered,
      s <- segments n,
      (i, other) <- BoxTree.within (BoundingBox.ofSegment s) index,
      i < j,
      p <- take 1 (Distance.crossings s other)
  ]
  where
    index =
      BoxTree.index (BoundingBox.ofSegment . snd) [(i, s) | (i, n) <- numbered, s <- segments n]

segments :: Named -> [Segment]
segments n = NonEmpty.toList (Polyarc.segments (Part.outline (contour n)))

boxOf :: Named -> BoundingBox
boxOf n =
  let s :| more =
        fmap BoundingBox.ofSegment (Polyarc.segments (Part.outline (contour n)))
   in foldl BoundingBox.union s more

-- | No place in the contour lies further from it.
halfWidth :: Named -> Mm
halfWidth n = let BoundingBox.BoundingBox l b r t = boxOf n in Mm (min (r - l) (t - b) / 2)

beginning :: Named -> Point
beginning n = Segment.start (Part.segment (NonEmpty.head (elements (contour n))))

nameOf :: Named -> Name
nameOf n = let Located _ name = contourName (contour n) in name

placeOf :: Named -> Region
placeOf n = let Located there _ = contourName (contour n) in there
