-- | The stock that a toolpath leaves, and the solids that the program avoids, in a drawing.
--
-- The drawing shows the stock from above. It is the darker the higher it is left, and has the
-- colour of the paper where nothing is left.
module Draw.StockPlot
  ( StockPlot (..),
    stockPlot,
    isEmpty,
    hasStock,
    onPage,
    boxes,
    stockAreas,
    avoidedAreas,
  )
where

import Base.Quantity (Mm (..), minus, over)
import Base.Region (Located (..))
import Data.Foldable (toList)
import Draw.LineStyle (LineStyles (..))
import Draw.LineStyle qualified as LineStyle
import Draw.Page (Page)
import Draw.Page qualified as Page
import Draw.Svg (Svg)
import Draw.Svg qualified as Svg
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Polyarc (Ends (Closed), Polyarc)
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment)
import Part.Part (Solid (..))
import Part.Part qualified as Part
import Toolpath.StockLayer (StockLayer (..))
import Toolpath.StockLayer qualified as StockLayer
import Toolpath.Toolpath (Setup (avoided, stock), Toolpath (setup))

-- | Outlines of the stock and of the avoided solids. Each outline is a closed chain of segments.
data StockPlot = StockPlot
  { -- | outlines of the stock before the first operation
    blank :: [[Segment]],
    -- | sections of the stock that is left, from the lowest one, each with the height of its top: 0
    -- at the bottom of the stock, 1 at its top
    sections :: [(Double, [[Segment]])],
    avoidedOutlines :: [[Segment]]
  }

-- | Picture of the stock that a toolpath leaves, and of the avoided solids. Without sections if
-- rounding decides them.
stockPlot :: Toolpath -> StockPlot
stockPlot path =
  StockPlot
    { blank = concat [outlinesOf s | Just (Located _ s) <- [stock (setup path)]],
      sections =
        concat
          [ either (const []) (map (sectionOf s)) (StockLayer.stockLayers path s)
            | Just (Located _ s) <- [stock (setup path)]
          ],
      avoidedOutlines = concat [outlinesOf s | Located _ s <- avoided (setup path)]
    }
  where
    outlinesOf = map (chain . Part.polyarcOf) . outlines
    sectionOf s layer =
      ( over (minus (top layer) (lowest s)) (minus (highest s) (lowest s)),
        map chain (section layer)
      )

-- | Segments of a polyarc.
chain :: Polyarc -> [Segment]
chain = toList . Polyarc.segments

-- | True if there is neither stock nor an avoided solid.
isEmpty :: StockPlot -> Bool
isEmpty picture = null (blank picture) && null (avoidedOutlines picture)

-- | True if the program gives the stock.
hasStock :: StockPlot -> Bool
hasStock = not . null . blank

-- | Picture on paper.
onPage :: Page -> StockPlot -> StockPlot
onPage page picture =
  StockPlot
    { blank = placed (blank picture),
      sections = [(h, placed s) | (h, s) <- sections picture],
      avoidedOutlines = placed (avoidedOutlines picture)
    }
  where
    placed = map (map (Page.segment page))

-- | Bounding boxes of all outlines, in mm of the part.
boxes :: StockPlot -> [BoundingBox]
boxes picture = map Page.extent (concat (blank picture <> avoidedOutlines picture))

-- | Stock that is left, and its outline before the first operation.
stockAreas :: LineStyles -> StockPlot -> [Svg]
stockAreas styles picture =
  [ Svg.areas (LineStyle.stockColour styles height) s
    | (height, s) <- sections picture,
      not (null s)
  ]
    <> [Svg.outlines (stockPen styles) (closed (blank picture <> concatMap snd (sections picture)))]

-- | Avoided solids.
avoidedAreas :: LineStyles -> StockPlot -> [Svg]
avoidedAreas styles picture =
  [ Svg.areas (avoidedColour styles) (avoidedOutlines picture),
    Svg.outlines (avoidedPen styles) (closed (avoidedOutlines picture))
  ]

-- | Closed chains for 'Svg.outlines'.
closed :: [[Segment]] -> [(Ends, [Segment])]
closed = map (Closed,)
