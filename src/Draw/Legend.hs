-- | Legend of a plot: the symbols that occur in it, with their meaning.
module Draw.Legend
  ( Legend,
    Entry,
    entries,
    rowsIn,
    legend,
  )
where

import Data.Text (Text)
import Draw.CutClass (CutClass (..))
import Draw.Descent (DescentKind (..))
import Draw.Descent qualified as Descent
import Draw.LineStyle (LineStyles (..))
import Draw.LineStyle qualified as LineStyle
import Draw.NodeLabel qualified as NodeLabel
import Draw.Page (Area (..))
import Draw.Scene
  ( Cut (holderRadius, isOnContour, showsCutter),
    MaterialSide (..),
    Scene (..),
    Shape (..),
  )
import Draw.StockPlot qualified as StockPlot
import Draw.Svg (Anchor (..), Pen (..), Svg)
import Draw.Svg qualified as Svg
import Geometry.Segment (Segment (Straight))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | Entries of a legend.
type Legend = [Entry]

-- | Function that draws a symbol to the right of a given point, and the meaning of the symbol.
type Entry = (Point -> [Svg], Text)

-- | Entries for the symbols that a scene uses, and for the classes of its cuts.
entries :: LineStyles -> [CutClass] -> Scene -> Legend
entries styles classes scene =
  [(sample, words') | (True, sample, words') <- possible]
    <> [ (line (LineStyle.classPen styles i), caption c)
         | length classes > 1 || map caption classes /= ["cutter path"],
           (i, c) <- zip [0 ..] classes
       ]
  where
    possible = areaEntries styles classes scene <> symbolEntries styles scene

-- | Entries for contours and areas.
areaEntries :: LineStyles -> [CutClass] -> Scene -> [(Bool, Point -> [Svg], Text)]
areaEntries styles classes Scene {shapes, cuts, restMaterial, stock} =
  [ ( any ((== Unknown) . materialSide) shapes || not (null shapes || isTinted),
      line (contourPen styles),
      "contour"
    ),
    ( isTinted && any ((/= Unknown) . materialSide) shapes,
      \p -> tint (materialColour styles) p <> line (contourPen styles) p,
      "part"
    ),
    (not (null restMaterial), surface (restColour styles), "material left"),
    ( not (null cuts) && (isPlain || isTinted),
      \p ->
        tint (sweptColour styles) p <> (if isPlain then line (pathPen styles) p else []),
      if isPlain then "cutter path" else "swept"
    ),
    ( StockPlot.hasStock stock,
      \p -> surface (LineStyle.stockColour styles 1) p <> line (stockPen styles) p,
      "stock left"
    ),
    ( not (null (StockPlot.avoidedOutlines stock)),
      \p -> surface (avoidedColour styles) p <> line (avoidedPen styles) p,
      "avoided"
    ),
    ( any isOnContour cuts,
      \p -> concatMap (`line` p) [edgePen styles, bedPen styles, pathPen styles],
      "on a contour"
    )
  ]
  where
    isPlain = map caption classes == ["cutter path"]
    isTinted = not (StockPlot.hasStock stock)
    tint = if isTinted then surface else \_ _ -> []
    surface colour p =
      [ Svg.rectangle
          (Pen "none" 0 [])
          colour
          (Area (Vec.x p) (Vec.y p) (Vec.x p + 8) (Vec.y p + 2))
      ]

-- | Entries for moves and symbols.
symbolEntries :: LineStyles -> Scene -> [(Bool, Point -> [Svg], Text)]
symbolEntries styles scene =
  [ (not (null (NodeLabel.shown (cuts scene))), LineStyle.node styles True `at` 4, "node"),
    (not (null (feeds scene)), linkingMove feedPen, "move at feed"),
    (not (null (rapids scene)), linkingMove rapidPen, "rapid move"),
    (descends Plunge, LineStyle.descent styles Plunge `under` 1, "plunge"),
    (descends Ramp, LineStyle.descent styles Ramp `under` 1, "ramp"),
    (descends Helix, LineStyle.descent styles Helix `under` 0, "helix"),
    (not (null (tabs scene)), LineStyle.tab styles `under` 0, "tab"),
    (not (null (cuts scene)), LineStyle.cutter styles 2 `under` 0, "cutter"),
    ( any (\c -> showsCutter c && holderRadius c > 0) (cuts scene),
      \p -> [Svg.ring (holderPen styles) 2 (Vec.shift (Vec.vec 4 0) p)],
      "holder"
    ),
    (True, LineStyle.start styles `under` 0, "start"),
    (True, LineStyle.origin styles `under` 0, "origin")
  ]
  where
    descends kind = any ((== kind) . Descent.kind) (descents scene)
    symbol `at` x = \p -> [symbol (Vec.shift (Vec.vec x 0) p)]
    symbol `under` y = \p -> symbol (Vec.shift (Vec.vec 4 y) p)
    linkingMove pen p =
      line (pen styles) p
        <> [Svg.arrow (linkingColour styles) 2.4 (Vec.vec 1 0) (Vec.shift (Vec.vec 5.2 0) p)]

-- | Line with a pen, as a symbol.
line :: Pen -> Point -> [Svg]
line pen p = [Svg.stroke pen [Straight p (Vec.shift (Vec.vec 8 0) p)]]

-- | Count of rows of a legend in a strip of this width in mm.
rowsIn :: Double -> Legend -> Int
rowsIn wide given = (length given + columns - 1) `div` columns
  where
    columns = columnsIn wide given

columnsIn :: Double -> Legend -> Int
columnsIn wide given = max 1 (floor ((wide - 3) / columnWidth given))

-- | Width of a column in mm, in which every entry has room.
columnWidth :: Legend -> Double
columnWidth given = maximum (29 : [12 + Svg.textWidth 2.5 words' | (_, words') <- given])

-- | Legend in an area. The entries fill the columns one after the other; the rows are the given
-- distance apart.
legend :: LineStyles -> Double -> Area -> Legend -> [Svg]
legend styles apart area given = concat (zipWith entry [0 ..] given)
  where
    rows = max 1 (rowsIn (rightmost area - leftmost area) given)
    entry i (sample, words') =
      let (column, row) = (i :: Int) `divMod` rows
          p =
            Vec.point
              (leftmost area + 3 + columnWidth given * fromIntegral column)
              (upper area + 4.5 + apart * fromIntegral row)
       in sample p
            <> [ Svg.text
                   (LineStyle.lettering styles 2.5)
                   Start
                   (Vec.shift (Vec.vec 10 0.9) p)
                   words'
               ]
