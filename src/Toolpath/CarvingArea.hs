-- | The chains of branches along which a V-carving carves each connected area of a region, and what
-- its tip leaves there.
module Toolpath.CarvingArea
  ( CarvedArea (..),
    ofCarvings,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (mapMaybe)
import Geometry.ArcFitting.PolyarcFit qualified as PolyarcFit
import Geometry.Polyarc (Polyarc)
import Geometry.TranslatedCopy qualified as TranslatedCopy
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Offset.MedialAxis (Branch, Disc (..))
import Offset.MedialAxis qualified as MedialAxis
import Part.Part (Carving)
import Part.Part qualified as Part
import Toolpath.CarvingChain qualified as CarvingChain
import Toolpath.Tolerance qualified as Tolerance
import Toolpath.Toolpath (CarvingRest (..))

-- | An area of a V-carving.
data CarvedArea = CarvedArea
  { chains :: [NonEmpty Branch],
    -- | the corners and narrow places that the tip leaves because it is too wide, if they are
    -- thicker than the tolerance
    rests :: [CarvingRest]
  }
  deriving stock (Eq, Show)

-- | The settings of a V-carving on which its path depends.
data Setting = Setting
  { tip :: Mm,
    -- | the largest radius of the discs
    reach :: Mm,
    -- | the way of the tool from the top of the part to the height of rapid moves, and back
    lift :: Mm,
    -- | the smaller and the larger limit of deviations
    limits :: (Mm, Mm)
  }
  deriving stock (Eq, Ord)

-- | The areas of each of some V-carvings. Areas that are translated copies of each other, such as
-- equal letters, are computed once.
ofCarvings :: [Carving] -> [NonEmpty CarvedArea]
ofCarvings carvings =
  TranslatedCopy.shared area moved [(settingOf c,) <$> Part.carvingContours c | c <- carvings]

settingOf :: Carving -> Setting
settingOf c =
  Setting
    { tip = Part.carvingTip c,
      reach = Part.carvingReach c,
      lift = times 2 (Part.carvingTravel c),
      limits = Part.deviationLimits (Part.carvingTolerance c)
    }

-- | The area with some contours, the outline first.
area :: Setting -> NonEmpty Polyarc -> CarvedArea
area setting loops =
  CarvedArea
    { chains = CarvingChain.chains (lift setting) deep,
      rests = restsOf setting axis
    }
  where
    deep = concatMap (CarvingChain.deepParts (tip setting)) axis
    axis =
      MedialAxis.branches
        (Mm (Tolerance.axisShare * limit))
        (reach setting)
        (fmap (PolyarcFit.simplified allowed) loops)
    allowed = times Tolerance.contourShare (Mm limit)
    Mm limit = uncurry min (limits setting)

-- | An area moved by a vector.
moved :: Vec -> CarvedArea -> CarvedArea
moved v (CarvedArea found left) =
  CarvedArea
    { chains = map (fmap (MedialAxis.moved v)) found,
      rests = [r {restAt = Vec.shift v (restAt r)} | r <- left]
    }

-- | The material in corners and narrow places along a medial axis that the tip leaves: the places
-- that are thicker than the tolerance.
restsOf :: Setting -> [Branch] -> [CarvingRest]
restsOf setting axis =
  [ CarvingRest {restCount = 1, thickest = thickness, restAt = p}
    | (thickness, p) <- mapMaybe (narrowest (tip setting)) axis,
      thickness > uncurry max (limits setting)
  ]

-- | The thickness of what a tip of some radius leaves along a branch, and the point there. The
-- discs that are smaller than the tip go beyond the nearest one as large as the tip by this
-- thickness. If all are smaller, it is the diameter of the largest one.
narrowest :: Mm -> Branch -> Maybe (Mm, Point)
narrowest tip branch = case (filter isNarrow discs, ends) of
  ([], _) -> Nothing
  (small, []) -> Just (largest [(times 2 (discRadius d), discCentre d) | d <- small])
  (small, _) -> Just (largest [(minimum (map (beyond d) ends), discCentre d) | d <- small])
  where
    discs = MedialAxis.firstDisc branch : map final (NonEmpty.toList branch)
    final s = MedialAxis.lastDisc (s :| [])
    isNarrow d = discRadius d < tip
    ends =
      concat
        [ [MedialAxis.firstDisc b, MedialAxis.lastDisc b]
          | b <- CarvingChain.deepParts tip branch
        ]
    beyond (Disc p r) (Disc q _) = minus (plus (Vec.distance p q) r) tip
    largest = foldr1 (\a b -> if fst a >= fst b then a else b)
