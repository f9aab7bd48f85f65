-- | The height of a swivelling blade's axis along a contour.
--
-- The /axis/ is the machine's z axis. It does not lift a blade, but turns the blade to the bevel
-- @μ@ of the surface, through a wheel of the diameter @D2@. In the middle position of the axis the
-- blade is upright. The height of the axis above that position is @z = ∓π·μ°·D2/360@: minus if the
-- blade is on the right in the direction of travel, plus if it is on the left (Kolsanova, section
-- 3, corrected: the print divides by 360 twice; its paired signs ± ∓ ∓ give the minus on the
-- right). On an element without a bevel, the bevel changes linearly with the arc length, from the
-- bevel of the element before to that of the element after.
module Toolpath.Swivel
  ( axis,
    highest,
    bevels,
  )
where

import Base.Quantity (Mm (..))
import Base.Region (Region)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isJust, isNothing)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier (Side)
import Geometry.Carrier qualified as Carrier
import Geometry.Segment qualified as Segment
import Offset.Equidistant (OffsetSegment (..))
import Offset.Equidistant qualified as Equidistant
import Part.Part (Contour, Element, Ends (..), Milling)
import Part.Part qualified as Part
import Toolpath.Error (Error (..))

-- | The heights of the axis above its middle position, at the beginning and at the end of every
-- segment of an offset. Nothing for a tool that does not swivel. Refuses a contour on which no
-- element has a bevel, a blade that moves on the contour, and a jump of the bevel ('checkJoints').
-- @region@ is the region of the statement's first word. @side@ is the blade's side of the contour;
-- Nothing if the blade moves on the contour.
axis ::
  Region ->
  Milling ->
  Maybe Side ->
  NonEmpty OffsetSegment ->
  Either Error (Maybe (NonEmpty (Mm, Mm)))
axis region milling side offsetSegments = case Part.gear milling of
  Nothing -> Right Nothing
  Just gear -> do
    elementBevels <- maybe (Left (NoBevel region)) Right (bevels (Part.contour milling))
    sign <- maybe (Left onContour) (Right . Carrier.sideSign) side
    checkJoints region elements elementBevels offsetSegments
    let heightsOf (a, b) = (height sign gear a, height sign gear b)
    Right (Just (fmap heightsOf (angles elementBevels offsetSegments)))
  where
    onContour = BladeOnContour region (Part.side milling) (Part.ends (Part.contour milling))
    elements = Vector.fromList (NonEmpty.toList (Part.elements (Part.contour milling)))
    height sign (Mm gear) angle = Mm (sign * angle * gear / 2)

-- | The largest distance of the axis from its middle position along the contour of a statement, in
-- mm; 0 for a tool that does not swivel.
highest :: Milling -> Mm
highest milling =
  Mm
    ( maximum
        ( 0 :
            [ abs angle * gear / 2
              | Just (Mm gear) <- [Part.gear milling],
                Just elementBevels <- [bevels (Part.contour milling)],
                (a, b) <- Vector.toList elementBevels,
                angle <- [a, b]
            ]
        )
    )

-- | The bevels of all elements, in radians, each at the beginning and at the end of the element.
-- Nothing when no element has a bevel.
bevels :: Contour -> Maybe (Vector (Double, Double))
bevels contour = case span (isNothing . Part.bevel) list of
  (_, []) -> Nothing
  (open, known)
    -- In a closed contour, elements without a bevel may lie on both sides of its beginning. They
    -- are interpolated together.
    | Part.ends contour == Closed ->
      let (after, before) =
            splitAt (length known) (filled Nothing (known <> open <> take 1 known))
       in Just (Vector.fromList (take (length open) before <> after))
    | otherwise -> Just (Vector.fromList (filled Nothing list))
  where
    list = NonEmpty.toList (Part.elements contour)
    filled before es = case span (isNothing . Part.bevel) es of
      ([], e : rest) | Just (a, b) <- Part.bevel e -> (a, b) : filled (Just b) rest
      (open, rest) ->
        between before (nextOf rest) open <> (if null rest then [] else filled before rest)
    nextOf es = case es of
      e : _ -> fst <$> Part.bevel e
      [] -> Nothing
    between before next open = case (before, next) of
      (Just a, Just b) ->
        [(a + (b - a) * s, a + (b - a) * t) | (s, t) <- shares (map (lengthOf . Part.segment) open)]
      (Just a, Nothing) -> map (const (a, a)) open
      (Nothing, Just b) -> map (const (b, b)) open
      (Nothing, Nothing) -> map (const (0, 0)) open
    lengthOf s = let Mm l = Segment.length s in l

-- | The beginning and the end of each of several consecutive parts, as fractions from 0 to 1 of the
-- total length. The argument has the lengths of the parts in mm.
shares :: [Double] -> [(Double, Double)]
shares ls = zip marks (drop 1 marks)
  where
    marks = scanl (\s l -> s + l / sum ls) 0 ls

-- | The bevels at the beginning and the end of each segment of an offset, in radians.
-- @elementBevels@ has the bevels at the beginning and the end of each element. On the arc round a
-- corner the bevel changes linearly from the bevel of the element before the corner to that of the
-- element after it.
angles :: Vector (Double, Double) -> NonEmpty OffsetSegment -> NonEmpty (Double, Double)
angles elementBevels offsetSegments =
  NonEmpty.fromList
    ( concatMap
        group
        (NonEmpty.groupBy (\p q -> isJust (cornerOf p) && cornerOf p == cornerOf q) offsetSegments)
    )
  where
    cornerOf p = case origin p of
      Equidistant.Along _ -> Nothing
      Equidistant.Around i -> Just i
    group ps@(p :| _) = case origin p of
      Equidistant.Along i -> [elementBevels Vector.! i]
      Equidistant.Around i ->
        let a = snd (elementBevels Vector.! i)
            b = fst (elementBevels Vector.! ((i + 1) `mod` Vector.length elementBevels))
         in [ (a + (b - a) * s, a + (b - a) * t)
              | (s, t) <-
                  shares [l | q <- NonEmpty.toList ps, let Mm l = Segment.length (segment q)]
            ]

-- | Refuses consecutive segments along two elements, without an arc between them, if the bevels of
-- the elements differ there: the blade would have to swivel at one point. @region@ is the region of
-- the statement's first word.
checkJoints ::
  Region ->
  Vector Element ->
  Vector (Double, Double) ->
  NonEmpty OffsetSegment ->
  Either Error ()
checkJoints region elements elementBevels offsetSegments =
  mapM_ joint (zip (NonEmpty.toList offsetSegments) (NonEmpty.tail offsetSegments))
  where
    joint (p, q) = case (origin p, origin q) of
      (Equidistant.Along i, Equidistant.Along j)
        | abs (snd (elementBevels Vector.! i) - fst (elementBevels Vector.! j)) > bevelTolerance ->
          Left
            ( BevelJumps
                region
                (elements Vector.! i)
                (elements Vector.! j)
                (snd (elementBevels Vector.! i))
                (fst (elementBevels Vector.! j))
            )
      _ -> Right ()

-- | Largest difference between bevels that count as equal, in radians.
bevelTolerance :: Double
bevelTolerance = 1e-6
