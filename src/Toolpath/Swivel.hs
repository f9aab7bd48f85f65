-- | The height of a swivelling blade's axis along a contour.
--
-- The blade is turned to the bevel of the surface by the axis, which moves through a wheel of the
-- diameter D2:
-- @z = ∓π·μ°·D2/360@, minus on the right of the walk, plus on the left (Kolsanova, section 3). It
--  is not the tool that
-- moves in height. An element that does not say how far it leans takes the blade from the bevel of
-- the element before it to that of the one behind it, evenly along its length.
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
import Geometry.Carrier (Side (..))
import Geometry.Segment qualified as Segment
import Offset.Equidistant (OffsetSegment (..))
import Offset.Equidistant qualified as Equidistant
import Part.Part (Contour, Element, Ends (..), Milling)
import Part.Part qualified as Part
import Toolpath.Error (Error (..))

-- | For every piece of an equidistant by how much the axis stands above its middle position, at the
-- beginning and at the end of the piece; in mm. Nothing for a tool that does not swivel.
axis ::
  Region ->
  Milling ->
  Maybe Side ->
  NonEmpty OffsetSegment ->
  Either Error (Maybe (NonEmpty (Mm, Mm)))
axis region milling side pieces = case Part.gear milling of
  Nothing -> Right Nothing
  Just gear -> do
    leans <- maybe (Left (NoBevel region)) Right (bevels (Part.contour milling))
    sign <- maybe (Left (BladeOnContour region)) (Right . signOf) side
    smooth region elements leans pieces
    Right (Just (fmap (\(a, b) -> (height sign gear a, height sign gear b)) (angles leans pieces)))
  where
    elements = Vector.fromList (NonEmpty.toList (Part.elements (Part.contour milling)))
    signOf s = case s of
      LeftOf -> 1
      RightOf -> -1
    height sign (Mm gear) angle = Mm (sign * angle * gear / 2)

-- | By how much the axis may stand above its middle position along a contour at most.
highest :: Milling -> Mm
highest milling =
  Mm
    ( maximum
        ( 0 :
            [ abs angle * gear / 2
              | Just (Mm gear) <- [Part.gear milling],
                Just leans <- [bevels (Part.contour milling)],
                (a, b) <- Vector.toList leans,
                angle <- [a, b]
            ]
        )
    )

-- | The bevels of all elements at their beginnings and ends, in radians; none when no element has
-- one.
bevels :: Contour -> Maybe (Vector (Double, Double))
bevels contour = case span (isNothing . Part.bevel) list of
  (_, []) -> Nothing
  (open, known)
    -- A closed contour goes on over its beginning.
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

-- | Where each of some lengths begins and ends on the whole, from 0 to 1.
shares :: [Double] -> [(Double, Double)]
shares ls = zip marks (drop 1 marks)
  where
    marks = scanl (\s l -> s + l / sum ls) 0 ls

-- | The bevels along the pieces; round a corner the blade turns from one to the other.
angles :: Vector (Double, Double) -> NonEmpty OffsetSegment -> NonEmpty (Double, Double)
angles leans pieces =
  NonEmpty.fromList
    ( concatMap
        group
        (NonEmpty.groupBy (\p q -> isJust (cornerOf p) && cornerOf p == cornerOf q) pieces)
    )
  where
    cornerOf p = case origin p of
      Equidistant.Along _ -> Nothing
      Equidistant.Around i -> Just i
    group ps@(p :| _) = case origin p of
      Equidistant.Along i -> [leans Vector.! i]
      Equidistant.Around i ->
        let a = snd (leans Vector.! i)
            b = fst (leans Vector.! ((i + 1) `mod` Vector.length leans))
         in [ (a + (b - a) * s, a + (b - a) * t)
              | (s, t) <-
                  shares [l | q <- NonEmpty.toList ps, let Mm l = Segment.length (segment q)]
            ]

-- | Where two elements go over into one another without a corner, their bevels have to agree.
smooth ::
  Region ->
  Vector Element ->
  Vector (Double, Double) ->
  NonEmpty OffsetSegment ->
  Either Error ()
smooth region elements leans pieces =
  mapM_ joint (zip (NonEmpty.toList pieces) (NonEmpty.tail pieces))
  where
    joint (p, q) = case (origin p, origin q) of
      (Equidistant.Along i, Equidistant.Along j)
        | abs (snd (leans Vector.! i) - fst (leans Vector.! j)) > sameBevel ->
          Left
            ( BevelJumps
                region
                (elements Vector.! i)
                (elements Vector.! j)
                (snd (leans Vector.! i))
                (fst (leans Vector.! j))
            )
      _ -> Right ()

-- | Bevels that differ by no more, in radians, are one.
sameBevel :: Double
sameBevel = 1e-6
