-- | Letters of single strokes, as they are engraved.
module Font.Font
  ( Letter (..),
    Font,
  )
where

import Base.Quantity (Mm)
import Data.Map.Strict (Map)
import Geometry.Polyarc (Polyarc)

-- | A letter whose capitals are 1 mm high. It begins at x = 0 and stands on the x axis. Its width
-- contains half of the gap to each of its neighbours. Only the space has no strokes.
data Letter = Letter {width :: Mm, strokes :: [Polyarc]}
  deriving stock (Eq, Show)

-- | The letters of a font by their characters.
type Font = Map Char Letter
