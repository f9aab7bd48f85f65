-- | Biarcs computed on unpacked coordinates and without angles, for searches that try many biarcs.
-- They equal those of "Geometry.ArcFitting.Biarc" where both end directions make an angle of less
-- than a quarter turn with the chord. The only exceptions are biarcs with a nearly straight arc:
-- their chord ratio can differ, see 'chordRatio'. A pose is a position with a direction. A chord
-- ratio is the length of the second arc's chord divided by that of the first.
--
-- The formulas are those in the header of "Geometry.ArcFitting.Biarc", with the same letters. The
-- sines and cosines of the half angles α/2 and β/2 are computed by square roots. @e^{iγ/2}@ is the
-- conjugate of @w/|w|@. An arc with the chord c and the sweep 2φ has the curvature @2·sin φ/c@ and
-- the bulge @tan(φ/2)@.
module Geometry.ArcFitting.Biarc.Fast
  ( Pose (..),
    meanPose,
    isCorner,
    FastBiarc (..),
    biarc,
    Biarcs,
    between,
    withRatio,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Geometry.Tolerance qualified as Tolerance

-- | Position in mm and direction of length 1.
data Pose = Pose {px :: Double, py :: Double, dx :: Double, dy :: Double}

-- | Pose @b@ with the mean of its direction and that of @a@. Both have the same position.
meanPose :: Pose -> Pose -> Pose
meanPose a b = b {dx = sx / s, dy = sy / s}
  where
    sx = dx a + dx b
    sy = dy a + dy b
    s = sqrt (sx * sx + sy * sy)

-- | True if the directions of two poses differ by more than 'Tolerance.kink'.
isCorner :: Pose -> Pose -> Bool
isCorner a b = not (dx a * dx b + dy a * dy b > 0 && abs (dx a * dy b - dy a * dx b) <= sin kink)
  where
    Rad kink = Tolerance.kink

-- | Biarc from one pose to another: two arcs with a common tangent at the joint.
data FastBiarc = FastBiarc
  { -- | True if one line or arc suffices; it is then the first arc, and 'joint' is the end pose
    single :: Bool,
    -- | curvature of the first arc in 1/mm, positive to the left
    bend1 :: Double,
    -- | tangent of a quarter of the first arc's sweep
    bulge1 :: Double,
    -- | end of the first arc and start of the second
    joint :: {-# UNPACK #-} Pose,
    -- | curvature of the second arc in 1/mm, positive to the left
    bend2 :: Double,
    -- | tangent of a quarter of the second arc's sweep
    bulge2 :: Double
  }

-- | Biarc from one pose to another. Its chord ratio is that of 'Geometry.ArcFitting.Biarc.join'
-- times the factor @times@. Curvatures and bulges are NaN if an end direction makes an angle of a
-- quarter turn or more with the chord, or if the ends coincide. A caller's test of the deviation
-- then fails.
biarc :: Double -> Pose -> Pose -> FastBiarc
biarc times from end = withRatio times (between from end)
{-# INLINE biarc #-}

-- | All biarcs from one pose to another, one for each chord ratio.
data Biarcs
  = -- | the same line or arc for every ratio, or numbers that are NaN
    -- (curvatures and bulges) if there is no biarc
    Only FastBiarc
  | -- | numbers that do not depend on the chord ratio: the start in mm; the chord as a vector in
    -- mm, its length and its direction; cosine and sine of half the angle from the chord to the
    -- direction at the start (a) and at the end (b); the sines of the whole angles; and the chord
    -- ratio of 'Geometry.ArcFitting.Biarc.join'
    Biarcs
      { x0 :: Double,
        y0 :: Double,
        cx :: Double,
        cy :: Double,
        l :: Double,
        ux :: Double,
        uy :: Double,
        ca :: Double,
        sa :: Double,
        cb :: Double,
        sb :: Double,
        sinA :: Double,
        sinB :: Double,
        chords :: Double
      }

-- | The biarcs from one pose to another, one for each chord ratio. If a single line or arc joins
-- the poses, it takes the place of all of them. If an end direction makes an angle of a quarter
-- turn or more with the chord, or if the ends coincide, curvatures and bulges are NaN.
between :: Pose -> Pose -> Biarcs
between (Pose x0 y0 sx sy) final@(Pose x1 y1 ex ey)
  | not (l > coincident && cosA > 0 && cosB > 0) =
    Only (FastBiarc False (0 / 0) (0 / 0) final (0 / 0) (0 / 0))
  | abs sinA <= straight && abs sinB <= straight = Only (FastBiarc True 0 0 final 0 0)
  | abs (sinA * cosB + cosA * sinB) <= oneArc =
    let s = sb * ca - cb * sa
     in Only (FastBiarc True (2 * s / l) (s / (1 + cb * ca + sb * sa)) final 0 0)
  | otherwise =
    Biarcs x0 y0 cx cy l ux uy ca sa cb sb sinA sinB (ratio sinA cosA sinB cosB)
  where
    cx = x1 - x0
    cy = y1 - y0
    l = sqrt (cx * cx + cy * cy)
    ux = cx / l
    uy = cy / l
    cosA = ux * sx + uy * sy
    sinA = ux * sy - uy * sx
    cosB = ux * ex + uy * ey
    sinB = ux * ey - uy * ex
    -- Cosines and sines of half the angles from the chord to the directions at start and end.
    ca = sqrt (0.5 + 0.5 * cosA)
    sa = sinA / (2 * ca)
    cb = sqrt (0.5 + 0.5 * cosB)
    sb = sinB / (2 * cb)
    Mm coincident = Tolerance.coincident
    Rad straight = Tolerance.straight
    Rad oneArc = Tolerance.oneArc

-- | The biarc among @biarcs@ that has the chord ratio of 'Geometry.ArcFitting.Biarc.join' times the
-- factor @times@; see 'chordRatio' for nearly straight arcs.
withRatio :: Double -> Biarcs -> FastBiarc
withRatio times biarcs = case biarcs of
  Only pair -> pair
  Biarcs {x0, y0, cx, cy, l, ux, uy, ca, sa, cb, sb} ->
    FastBiarc
      { single = False,
        bend1 = 2 * s1 / (l / size),
        bulge1 = bulge s1 c1,
        joint,
        bend2 = 2 * s2 / (r * l / size),
        bulge2 = bulge s2 c2
      }
    where
      r = chordRatio times biarcs
      wr = ca + r * cb
      wi = sa + r * sb
      square = wr * wr + wi * wi
      size = sqrt square
      -- Cosine and sine of half the angle from the chord to the direction at the joint.
      cg = wr / size
      sg = -(wi / size)
      -- Sines and cosines of half the sweeps.
      s1 = sg * ca - cg * sa
      c1 = cg * ca + sg * sa
      s2 = sb * cg - cb * sg
      c2 = cb * cg + sb * sg
      along = (1 + r * (ca * cb + sa * sb)) / square
      beside = r * (sa * cb - ca * sb) / square
      cosG = cg * cg - sg * sg
      sinG = 2 * cg * sg
      joint =
        Pose
          { px = x0 + along * cx - beside * cy,
            py = y0 + along * cy + beside * cx,
            dx = cosG * ux - sinG * uy,
            dy = cosG * uy + sinG * ux
          }
      bulge s c = let b = s / (1 + c) in if abs b <= 0.25 * straight then 0 else b
  where
    Rad straight = Tolerance.straight

-- | Chord ratio of the biarc that 'withRatio' makes. It is usually r, the chord ratio of
-- 'Geometry.ArcFitting.Biarc.join' times the factor @times@. If r gives an arc whose sweep is
-- negligible, this arc becomes a line. Then the result is the ratio for which the arc is exactly a
-- line, so that there is no kink at the joint. If this ratio differs from r by a factor of 2 or
-- more, the result is r nevertheless.
chordRatio :: Double -> Biarcs -> Double
chordRatio times biarcs = case biarcs of
  Only _ -> 1
  Biarcs {ca, sa, cb, sb, sinA, sinB, chords}
    | abs ((sa + r * sb) * ca + (ca + r * cb) * sa) <= negligible -> near (-(sinA / halfSum))
    | abs ((ca + r * cb) * sb + (sa + r * sb) * cb) <= negligible -> near (-(halfSum / sinB))
    | otherwise -> r
    where
      r = times * chords
      halfSum = sa * cb + ca * sb
      negligible = 0.5 * straight * (1 + r)
      near exact
        | 0.5 * r < exact && exact < 2 * r = exact
        | otherwise = r
  where
    Rad straight = Tolerance.straight
{-# INLINE chordRatio #-}

-- | Default chord ratio, as 'Geometry.ArcFitting.Biarc.ratio' gives it. It is computed from sines
-- and cosines of the angles from the chord to the directions at the start (A) and at the end (B).
-- It is 1, except where the angles have opposite signs and one is more than twice the other in
-- size.
ratio :: Double -> Double -> Double -> Double -> Double
ratio sinA cosA sinB cosB
  | sinA * sinB >= 0
      || abs sinA <= near * abs sinB && abs sinB <= near * abs sinA
      || limited == gamma =
    1
  | otherwise = max 0.25 (min 4 (-(sin ((alpha + limited) / 2) / sin ((limited + beta) / 2))))
  where
    alpha = atan2 sinA cosA
    beta = atan2 sinB cosB
    gamma = -((alpha + beta) / 2)
    limited = max (min alpha beta / 2) (min (max alpha beta / 2) gamma)
    -- If neither sine exceeds the other by more than this factor, the angles (below a quarter turn)
    -- differ by less than the factor 2.
    near = 1.4
{-# NOINLINE ratio #-}
