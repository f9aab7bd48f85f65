-- | Biarcs in plain numbers, without angles: what "Geometry.ArcFitting.Biarc" makes of two ends
-- whose directions lean to the chord by less than a quarter turn, for loops that try many.
--
-- With the notation of that module: the half angles come from the cosines by roots, @e^{iγ/2}@ is
-- the conjugate of
-- @w/|w|@, and an arc over a chord c that turns by 2φ has the curvature @2·sin φ/c@ and the bulge
--  @tan(φ/2)@.
module Geometry.ArcFitting.Biarc.Fast
  ( Pose (..),
    FastBiarc (..),
    joined,
    Biarcs,
    between,
    among,
    FastArc (..),
    frame,
    forwards,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Geometry.Tolerance qualified as Tolerance

-- | A place in mm and a direction of length 1.
data Pose = Pose {px :: Double, py :: Double, dx :: Double, dy :: Double}

-- | Two arcs that go over into one another at a joint.
data FastBiarc = FastBiarc
  { -- | one line or arc is enough: the first one, up to the end
    single :: Bool,
    -- | in 1/mm, positive to the left
    bend1 :: Double,
    -- | the tangent of a quarter of what it turns by
    bulge1 :: Double,
    joint :: {-# UNPACK #-} Pose,
    bend2 :: Double,
    bulge2 :: Double
  }

-- | The biarc from one pose to another, its second chord so many times as long as
-- 'Geometry.ArcFitting.Biarc.join' has it. Its numbers are no numbers where an end leans to the
-- chord by a quarter turn or more, or where the ends are one point.
joined :: Double -> Pose -> Pose -> FastBiarc
joined times from end = among times (between from end)
{-# INLINE joined #-}

-- | All biarcs from one pose to another.
data Biarcs
  = -- | the only one
    Only FastBiarc
  | -- its direction; the cosines and sines of half the angles of the ends from it, and the sines of
    -- the whole ones; the ratio of 'Geometry.ArcFitting.Biarc.join'

    -- | what those have in common that differ by the ratio of their chords: where they begin; the
    -- way between, its length and
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

-- | All from one pose to another.
between :: Pose -> Pose -> Biarcs
between (Pose x0 y0 sx sy) final@(Pose x1 y1 ex ey)
  | not (l > coincident && cosA > 0 && cosB > 0) =
    Only (FastBiarc False (0 / 0) (0 / 0) final (0 / 0) (0 / 0))
  | abs sinA <= straight && abs sinB <= straight = Only (FastBiarc True 0 0 final 0 0)
  | abs (sinA * cosB + cosA * sinB) <= oneArc =
    let s =
          sb * ca - cb * sa
     in Only (FastBiarc True (2 * s / l) (s / (1 + cb * ca + sb * sa)) final 0 0)
  | otherwise =
    Biarcs
      { x0,
        y0,
        cx,
        cy,
        l,
        ux,
        uy,
        ca,
        sa,
        cb,
        sb,
        sinA,
        sinB,
        chords = ratio sinA cosA sinB cosB
      }
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
    -- Half of the angles from the chord.
    ca = sqrt (0.5 + 0.5 * cosA)
    sa = sinA / (2 * ca)
    cb = sqrt (0.5 + 0.5 * cosB)
    sb = sinB / (2 * cb)
    Mm coincident = Tolerance.coincident
    Rad straight = Tolerance.straight
    Rad oneArc = Tolerance.oneArc

-- | The one whose second chord is so many times as long as 'Geometry.ArcFitting.Biarc.join' has it.
among :: Double -> Biarcs -> FastBiarc
among times biarcs = case biarcs of
  Only pair -> pair
  Biarcs {x0, y0, cx, cy, l, ux, uy, ca, sa, cb, sb, sinA, sinB, chords} ->
    FastBiarc
      { single = False,
        bend1 = 2 * s1 / (l / size),
        bulge1 = bulge s1 c1,
        joint,
        bend2 = 2 * s2 / (r * l / size),
        bulge2 = bulge s2 c2
      }
    where
      usual = times * chords
      -- An arc that turns by next to nothing is put as a line; the ratio with which it is one
      -- leaves no kink.
      r
        | abs ((sa + usual * sb) * ca + (ca + usual * cb) * sa) <= hardly = near (-(sinA / halved))
        | abs ((ca + usual * cb) * sb + (sa + usual * sb) * cb) <= hardly = near (-(halved / sinB))
        | otherwise = usual
      halved = sa * cb + ca * sb
      hardly = 0.5 * straight * (1 + usual)
      near exact = if 0.5 * usual < exact && exact < 2 * usual then exact else usual
      wr = ca + r * cb
      wi = sa + r * sb
      square = wr * wr + wi * wi
      size = sqrt square
      -- Half of the angle to the joint's direction.
      cg = wr / size
      sg = -(wi / size)
      -- Half of what the arcs turn by.
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

-- | The ratio of the chords, as 'Geometry.ArcFitting.Biarc.ratio' chooses it: 1 unless a curve that
-- bends to one side leans more than twice as much at one of its ends as at the other.
ratio :: Double -> Double -> Double -> Double -> Double
ratio sinA cosA sinB cosB
  | sinA * sinB >= 0
      || abs sinA <= near * abs sinB && abs sinB <= near * abs sinA
      || held == gamma =
    1
  | otherwise = max 0.25 (min 4 (-(sin ((alpha + held) / 2) / sin ((held + beta) / 2))))
  where
    alpha = atan2 sinA cosA
    beta = atan2 sinB cosB
    gamma = -((alpha + beta) / 2)
    held = max (min alpha beta / 2) (min (max alpha beta / 2) gamma)
    -- Sines that differ by no more are of angles below a quarter turn that differ by less than the
    -- factor 2.
    near = 1.4
{-# NOINLINE ratio #-}

-- | An arc: where it begins, its curvature, where it ends, and the cosine and the sine of what it
-- turns by.
data FastArc = FastArc
  { origin :: {-# UNPACK #-} Pose,
    bend :: Double,
    limit :: {-# UNPACK #-} Pose,
    cosine :: Double,
    sine :: Double
  }

-- | From its beginning, its curvature in 1/mm and its end.
frame :: Pose -> Double -> Pose -> FastArc
frame origin bend limit =
  FastArc
    { origin,
      bend,
      limit,
      cosine = dx origin * dx limit + dy origin * dy limit,
      sine = dx origin * dy limit - dy origin * dx limit
    }
{-# INLINE frame #-}

-- | Whether an arc turns by less than a quarter turn.
forwards :: FastArc -> Bool
forwards f = cosine f > 0
{-# INLINE forwards #-}
