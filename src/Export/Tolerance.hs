-- | Tolerances of exported drawings.
module Export.Tolerance
  ( cubic,
    onCurve,
    arcEnd,
    curvedPath,
  )
where

import Base.Quantity (Mm (..))

-- | The largest distance between a curve of the part and the cubics that represent it in a drawing,
-- where the curve is not cubic itself: a shifted curve, or an arc within a curve. It is a tenth of
-- the distance that the arcs of the part may have from the curve.
cubic :: Mm
cubic = Mm 1e-6

-- | The largest distance between a curve and a node of the arcs that replace it in a contour, in
-- addition to the distance that these arcs may have from the curve. The drawing's cubics are within
-- 'cubic' of the curve. The rest is for the links, which join the arcs to their neighbours.
onCurve :: Mm
onCurve = Mm 1e-5

-- | The largest distance between the end of an arc and the end that a program computes from the
-- arc's centre, radius and angle. The centre of a flat arc is so far away that rounding exceeds
-- this distance; such an arc is written by its ends and its bulge.
arcEnd :: Mm
arcEnd = Mm 1e-10

-- | The largest distance between a rising arc of the toolpath and the cubics that represent it, in
-- the plane and in height.
curvedPath :: Mm
curvedPath = Mm 1e-5
