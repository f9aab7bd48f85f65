-- | Centres of the arcs of a file.
module Gcode.ArcCentre
  ( arcCentre,
  )
where

import Control.Monad (unless, when)
import Data.Maybe (fromMaybe, isJust)
import Data.Text qualified as Text
import Gcode.Block
import Gcode.BlockWords
import Gcode.ControlMotion (Coordinate (..), ToolPlace (..))
import Gcode.ModalState
import Geometry.Carrier (Sense (..))

-- | Centre of an arc from one position to another, in the plane of the state.
arcCentre ::
  Sorted -> Sense -> ModalState -> ToolPlace -> ToolPlace -> Either Fault (Int, Int)
arcCentre s sense m begins target = do
  (begin, finish) <- maybe (faultAt b 1 (UnknownPosition 'X')) Right ends
  -- LinuxCNC refuses the offset along the axis of the plane, and offsets beside a radius.
  case [w | w <- others s, letter w `elem` useless] of
    w : _ -> faultOf b w (UnusedWord (Text.singleton (letter w)))
    [] -> Right ()
  case given 'R' s of
    Just r -> maybe (faultAt b 1 BadArc) Right (centreByRadius sense r' begin finish)
      where
        r' = picometresOf m r
    Nothing -> do
      let offsets = map (`given` s) letters'
      unless (any isJust offsets) (faultAt b 1 BadArc)
      let centre' = byOffsets begin (map (fmap (picometresOf m)) offsets)
      when (centre' == begin || centre' == finish) (faultAt b 1 BadArc)
      pure centre'
  where
    b = block s
    useless
      | isJust (given 'R' s) = "IJK"
      | otherwise = filter (`notElem` letters') "IJK"
    inPlane p = case valueOf (plane m) of
      Just PlaneZX -> (placeZ p, placeX p)
      Just PlaneYZ -> (placeY p, placeZ p)
      _ -> (placeX p, placeY p)
    letters' = case valueOf (plane m) of
      Just PlaneZX -> ['K', 'I']
      Just PlaneYZ -> ['J', 'K']
      _ -> ['I', 'J']
    ends = case (inPlane begins, inPlane target) of
      ((At a, At c), (At d, At e)) -> Just ((a, c), (d, e))
      _ -> Nothing
    byOffsets (x, y) offsets = case offsets of
      [i, j]
        | valueOf (arcCentres m) == Just Absolute -> (fromMaybe x i, fromMaybe y j)
        | otherwise -> (x + fromMaybe 0 i, y + fromMaybe 0 j)
      _ -> (x, y)

-- | Centre of an arc by its radius: of the two centres, a positive radius takes the one with the
-- smaller sweep. Nothing if the ends are equal or too far from one another.
centreByRadius :: Sense -> Int -> (Int, Int) -> (Int, Int) -> Maybe (Int, Int)
centreByRadius sense radius (x, y) (x', y')
  | chord == 0 || h2 < -1.0e-6 * r * r = Nothing
  | otherwise = Just (round (mx - k * dy), round (my + k * dx))
  where
    r = fromIntegral radius :: Double
    (dx, dy) = (fromIntegral (x' - x), fromIntegral (y' - y)) :: (Double, Double)
    chord = sqrt (dx * dx + dy * dy)
    (mx, my) = (fromIntegral x + dx / 2, fromIntegral y + dy / 2)
    h2 = r * r - chord * chord / 4
    k = side * sqrt (max 0 h2) / chord
    side = if (sense == CounterClockwise) == (radius > 0) then 1 else -1
