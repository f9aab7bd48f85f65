-- | Charts: areas of a page in which a horizontal and a vertical scale place values, with their
-- labels. Lengths are in mm of paper.
module Draw.Chart
  ( Chart (..),
    place,
    roundSteps,
    stepFor,
    grid,
    valueLabels,
    bottomLabels,
    border,
    polyline,
    filled,
    simplified,
    gridPen,
    legendRow,
  )
where

import Base.Decimal qualified as Decimal
import Data.List (mapAccumL)
import Data.Text (Text)
import Data.Text qualified as Text
import Draw.LineStyle qualified as LineStyle
import Draw.Page (Area (..))
import Draw.Page qualified as Page
import Draw.Svg (Anchor (..), Pen (..), Svg)
import Draw.Svg qualified as Svg
import Geometry.Segment (Segment (Straight))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | Area of a chart, and the values at its left and right edge and at its lower and upper edge.
data Chart = Chart {area :: Area, across :: (Double, Double), upwards :: (Double, Double)}

-- | Point on paper of a pair of values, rounded to 0.01 mm.
place :: Chart -> (Double, Double) -> Point
place Chart {area, across = (a, b), upwards = (c, d)} (x, y) =
  Vec.point
    (rounded (leftmost area + (rightmost area - leftmost area) * part a b x))
    (rounded (lower area - (lower area - upper area) * part c d y))
  where
    part from to v = if to > from then (v - from) / (to - from) else 0.5
    rounded v = fromIntegral (round (100 * v) :: Int) / 100

-- | Step of a scale: the least of the series … 0.5, 1, 2, 5, 10 … for which neighbours are at least
-- @apart@ mm apart, on a scale of @long@ mm for a range of @size@.
stepFor :: Double -> Double -> Double -> Double
stepFor apart long size = if step >= wanted * (1 - 1e-9) then step else Page.round125 (2.6 * step)
  where
    wanted = max 1e-9 (size * apart / max 1 long)
    step = Page.round125 wanted

-- | Multiples of a step within a range.
roundSteps :: Double -> (Double, Double) -> [Double]
roundSteps step (a, b) =
  [step * fromIntegral k | k <- [ceiling (a / step - 1e-6) .. floor (b / step + 1e-6) :: Int]]

-- | Pen of the lines of a grid.
gridPen :: Pen
gridPen = Pen "#dcdcdc" 0.1 []

-- | Horizontal lines at values.
grid :: Chart -> [Double] -> [Svg]
grid c vs = [Svg.stroke (penOf v) [Straight (at a v) (at b v)] | v <- vs]
  where
    penOf v = if v == 0 then zeroPen else gridPen
    (a, b) = across c
    at x v = place c (x, v)
    zeroPen = gridPen {colour = "#909090"}

-- | Values beside the left edge.
valueLabels :: Chart -> [Double] -> [Svg]
valueLabels c vs =
  [ Svg.text LineStyle.small End (Vec.shift (Vec.vec (-1.2) 0.9) (place c (a, v))) (written v)
    | v <- vs
  ]
  where
    (a, _) = across c
    written v = Text.replace "-" "−" (Decimal.short 3 v)

-- | Marks and values below the lower edge.
bottomLabels :: Chart -> (Double -> Text) -> [Double] -> [Svg]
bottomLabels c written vs =
  concat
    [ [ Svg.stroke LineStyle.axisPen [Straight p (Vec.shift (Vec.vec 0 1.2) p)],
        Svg.text LineStyle.small Middle (Vec.shift (Vec.vec 0 4) p) (written v)
      ]
      | v <- vs,
        let p = place c (v, fst (upwards c))
    ]

-- | Border of the area.
border :: Chart -> Svg
border c = Svg.rectangle LineStyle.axisPen {colour = LineStyle.black} "none" (area c)

-- | Line through points; none for fewer than two.
polyline :: Pen -> [Point] -> [Svg]
polyline pen points = case segments points of
  [] -> []
  lines' -> [Svg.stroke pen lines']

-- | Area within a polygon.
filled :: Text -> [Point] -> [Svg]
filled colour points = case segments points of
  [] -> []
  lines' -> [Svg.area colour lines']

segments :: [Point] -> [Segment]
segments points = zipWith Straight points (drop 1 points)

-- | Line with fewer points. Each point that is left out is at most the tolerance above or below the
-- line. The points lie from left to right. Algorithm: the cone intersection of Williams (1978).
simplified :: Double -> [Point] -> [Point]
simplified tolerance points = case points of
  p : q : more -> p : from p q (cone p q) more
  _ -> points
  where
    from start reached (low, high) rest = case rest of
      [] -> [reached]
      q : more
        | low <= slope start q && slope start q <= high,
          (low', high') <- cone start q ->
          from start q (max low low', min high high') more
        | otherwise -> reached : from reached q (cone reached q) more
    slope p q = (Vec.y q - Vec.y p) / run p q
    run p q = max 1e-9 (Vec.x q - Vec.x p)
    cone p q = (slope p q - tolerance / run p q, slope p q + tolerance / run p q)

-- | Row of a legend that begins at a point: samples, each drawn by a function of its left end, with
-- their texts.
legendRow :: Point -> [(Point -> [Svg], Text)] -> [Svg]
legendRow start = concat . snd . mapAccumL entry start
  where
    entry p (sample, words') =
      ( Vec.shift (Vec.vec (12 + 0.92 * Svg.textWidth 2.5 words') 0) p,
        sample p <> [Svg.text LineStyle.small Start (Vec.shift (Vec.vec 9.5 0.9) p) words']
      )
