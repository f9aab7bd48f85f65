-- | Motions that are brought to the height of their pass, so that the comparisons in the plane take
-- them for a part of it.
module Verify.LevelledMotion
  ( Levelled (..),
  )
where

import Verify.Motion (CutterMotion)

-- | Motions, some of which got the height of their pass.
data Levelled = Levelled
  { motions :: [CutterMotion],
    -- | test that a motion has the heights that its pass demands during the whole motion. A motion
    -- without them can be at the height of a pass all the same
    isAsDemanded :: CutterMotion -> Bool
  }
