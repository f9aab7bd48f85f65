-- | Lays out texts: the letters of a text side by side on a line or on a circle, and the order in
-- which their strokes are cut.
module Font.Lettering
  ( BaseLine (..),
    layout,
    textWidth,
    measuredRadius,
    inOrder,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, over, plus, times, total)
import Data.List qualified as List
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Ord (comparing)
import Font.Font (Letter (..))
import Geometry.Carrier (Circle (Circle))
import Geometry.Polyarc (Polyarc (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment qualified as Segment
import Geometry.Transformation (Transformation)
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The line on which the letters of a text stand.
data BaseLine
  = -- | the straight line through a point in a direction
    StraightLine Point Rad
  | -- | a circle, with the direction from its centre to the point of the text. The letters stand
    -- outside, and the text leads clockwise
    AroundCircle Circle Rad
  | -- | the same circle. The letters stand inside, and the text leads counter-clockwise
    WithinCircle Circle Rad
  deriving stock (Eq, Show)

-- | The radius of the circle on which the widths of letters with capitals of the height @size@ are
-- measured, for letters on the circle @circle@. It is the circle on which neighbours are nearest to
-- one another: the one at the feet outside, and the one at the tops of the capitals inside.
measuredRadius :: BaseLine -> Mm -> Circle -> Mm
measuredRadius line size (Circle _ r) = case line of
  StraightLine _ _ -> r
  AroundCircle _ _ -> r
  WithinCircle _ _ -> minus r size

-- | The width of a text with capitals of the height @size@. On a circle it is the length of an
-- arc of the radius 'measuredRadius'.
textWidth :: Mm -> [Letter] -> Mm
textWidth (Mm size) = times size . total . map width

-- | The strokes of each letter of a text, in the order of the text. @size@ is the height of the
-- capitals. @share@ is the part of the width that lies before the point of the text, from 0 to 1.
--
-- On a circle, each letter is turned as a whole: the middle of its width lies on the circle, and
-- its foot touches it there.
layout :: BaseLine -> Mm -> Double -> [Letter] -> [[Polyarc]]
layout line (Mm size) share letters =
  [ map (Transformation.polyarc (placing line (plus begin (half w)) (half w) size)) (strokes l)
    | (l, begin) <- zip letters begins,
      let w = times size (width l)
  ]
  where
    begins = scanl plus ahead (map (times size . width) letters)
    ahead = times (negate share) (textWidth (Mm size) letters)
    half = times 0.5

-- | The transformation of a letter of the font. @middle@ is the distance of the middle of the
-- letter from the point of the text, along the line; @halfWidth@ is half of its width.
placing :: BaseLine -> Mm -> Mm -> Double -> Transformation
placing line (Mm middle) (Mm halfWidth) size = case line of
  StraightLine p direction ->
    turned direction (Vec.shift (Vec.polar (Mm middle) direction) p)
  AroundCircle circle (Rad towards) -> onCircle circle (Rad (towards - angleOn circle)) (-pi / 2)
  WithinCircle circle (Rad towards) -> onCircle circle (Rad (towards + angleOn circle)) (pi / 2)
  where
    origin = Vec.point 0 0
    angleOn circle = over (Mm middle) (measuredRadius line (Mm size) circle)
    onCircle (Circle centre r) (Rad a) quarter =
      turned (Rad (a + quarter)) (Vec.shift (Vec.polar r (Rad a)) centre)
    -- The middle of the foot of the letter comes to the point @foot@.
    turned direction foot =
      Transformation.translation (Vec.to origin foot)
        `Transformation.after` Transformation.rotation direction origin
        `Transformation.after` Transformation.translation (Vec.vec (-halfWidth) 0)
        `Transformation.after` Transformation.scaling size origin

-- | The strokes of the letters, cut one after the other from the point @from@ on: letter by letter,
-- and in each letter always the stroke with the nearest end. A stroke that ends nearer than it
-- begins is reversed.
inOrder :: Point -> [[Polyarc]] -> [[Polyarc]]
inOrder from letters = case letters of
  [] -> []
  l : rest -> let (done, end) = nearestFirst from l in done : inOrder end rest

-- | The strokes of one letter in the order in which they are cut, and the end of the last one.
nearestFirst :: Point -> [Polyarc] -> ([Polyarc], Point)
nearestFirst from strokes' = case strokes' of
  [] -> ([], from)
  s : more ->
    let candidates = [(k, c) | (k, p) <- zip [0 :: Int ..] (s : more), c <- [p, Polyarc.reverse p]]
        (chosen, next) = List.minimumBy (comparing (Vec.distance from . beginOf . snd)) candidates
        others = [p | (k, p) <- zip [0 ..] (s : more), k /= chosen]
        (done, end) = nearestFirst (endOf next) others
     in (next : done, end)
  where
    beginOf p = let first :| _ = segments p in Segment.start first
    endOf = Segment.end . NonEmpty.last . segments
