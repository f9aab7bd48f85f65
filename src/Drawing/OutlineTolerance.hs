-- | Tolerances of the outlines of drawings.
module Drawing.OutlineTolerance
  ( joining,
    same,
    rounding,
    decimals,
    nearEnds,
    nearShare,
    farShare,
  )
where

import Base.Quantity (Mm (..))

-- | The largest distance between two ends that are joined, in mm, unless a program states another
-- one. Drawing programs write six decimals or more; hand-made ends are farther apart.
joining :: Mm
joining = Mm 0.001

-- | Distance in mm below which two positions of a drawing count as the same. Numbers with six
-- decimals are rounded by less.
same :: Mm
same = Mm 1e-6

-- | Distance in mm below which two positions differ by the rounding of doubles only.
rounding :: Mm
rounding = Mm 1e-9

-- | Decimals in mm to which the lengths of a drawing are rounded. Transformations leave further
-- decimals that are rounding only.
decimals :: Int
decimals = 10

-- | The largest distance in mm between the ends of an open outline that is told, since the outline
-- is probably meant to be closed.
nearEnds :: Mm
nearEnds = Mm 1

-- | The share of the length of a long open outline up to which the distance between its ends is
-- told.
nearShare :: Double
nearShare = 0.01

-- | The share of the length of a short open outline above which the distance between its ends is
-- not told: a line of less than a millimetre is meant to be open.
farShare :: Double
farShare = 0.1
