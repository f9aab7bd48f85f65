-- | Choices that a user makes for a plot.
module Draw.PlotSettings
  ( PlotSettings (..),
    standard,
  )
where

import Draw.CutClass (Colouring (..))
import Draw.LineStyle (Appearance (..))
import Draw.Page (PageFormat (..))

-- | Format of the page, the property of the cuts that their colours show, and the appearance.
data PlotSettings = PlotSettings
  { format :: PageFormat,
    colouring :: Colouring,
    appearance :: Appearance
  }
  deriving stock (Eq, Show)

-- | Settings of a plot for which the user chooses nothing.
standard :: PlotSettings
standard = PlotSettings {format = A4, colouring = OneColour, appearance = Screen}
