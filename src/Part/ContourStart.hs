-- | Starts of closed contours that a program leaves open: a statement that gives neither a start,
-- nor an approach, nor a lead may begin anywhere on its closed contour.
module Part.ContourStart
  ( isFree,
    moved,
  )
where

import Base.Region (Located (..))
import Data.List (mapAccumL)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (isNothing)
import Geometry.Vec (Point)
import Part.ContourElement qualified as ContourElement
import Part.Part (Milling (..), Operation (..), Part (..))
import Part.Part qualified as Part

-- | Test that a milling statement may begin anywhere on its contour.
isFree :: Milling -> Bool
isFree milling =
  Part.ends (contour milling) == Part.Closed
    && not (givesStart milling)
    && null (approach milling)
    && isNothing (leadIn milling)
    && isNothing (leadOut milling)

-- | Part whose contours begin near other points. The keys of the map are the numbers of the milling
-- statements, in the order of execution from 0; pocket statements count too. Nothing if one of
-- these statements does not leave its start open.
moved :: Map Int Point -> Part -> Maybe Part
moved starts part
  | all (`elem` [n | (n, Mill (Located _ m)) <- numbered, isFree m]) (Map.keys starts) =
    Just part {operations = map restarted numbered}
  | otherwise = Nothing
  where
    numbered = snd (mapAccumL (\n o -> (n + count o, (n, o))) (0 :: Int) (operations part))
    count o = case o of
      Mill _ -> 1
      Pocket _ -> 1
      _ -> 0
    restarted (n, o) = case (o, Map.lookup n starts) of
      (Mill (Located at m), Just p) ->
        Mill (Located at m {contour = ContourElement.startingNear p (contour m)})
      _ -> o
