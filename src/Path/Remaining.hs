-- | What stays of the part because the cutter does not reach it.
module Path.Remaining
  ( Remaining (..),
    ofPath,
    toolOf,
  )
where

import Base.Quantity (Mm)
import Base.Region (Located (..), Region)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (mapMaybe)
import Data.Vector qualified as Vector
import Geometry.Offset (Rest)
import Part.Part (Contour, Milling)
import Part.Part qualified as Part
import Path.Error (Stay, Tool (..))
import Path.Obstacle qualified as Obstacle
import Path.Path (Block (..), Pass (..), Path)
import Path.Path qualified as Path
import Path.Way qualified as Way

-- | Beside the contours of one statement after its last pass: the first word, the cutter, the contours in order, the places, and
-- how far from the contour the cutter's centre goes.
data Remaining = Remaining {word :: Region, tool :: Tool, walls :: NonEmpty Contour, places :: NonEmpty (Stay, Rest), beside :: Mm}

-- | Once for each statement that leaves something, in their order.
ofPath :: Path -> [Remaining]
ofPath path = Map.elems (Map.fromList (mapMaybe ofBlock (Path.blocks path)))

ofBlock :: Block -> Maybe (Int, Remaining)
ofBlock block = case block of
  Cutting {job = Located region m, pass, rests} -> stayed (Way.keyword 4 region) m [] pass <$> NonEmpty.nonEmpty rests
  Clearing {pocket = Located region p, pass, rests} -> stayed (Way.keyword 6 region) (Part.wall p) (Part.islands p) pass <$> NonEmpty.nonEmpty rests
  Travelling _ _ -> Nothing
  Holing _ _ -> Nothing
  Commanding _ -> Nothing

-- | What a pass leaves beside a contour and islands in it.
stayed :: Region -> Milling -> [Contour] -> Pass -> NonEmpty Rest -> (Int, Remaining)
stayed word milling islands pass rests = (number pass, Remaining {word, tool, walls, places = NonEmpty.zip (Obstacle.stays tool elements rests) rests, beside = reach pass})
  where
    tool = toolOf milling (Path.left pass)
    walls = Part.contour milling :| islands
    elements = Vector.fromList (concatMap (NonEmpty.toList . Part.elements) walls)

-- | The cutter that leaves so much.
toolOf :: Milling -> Mm -> Tool
toolOf milling allowance = Tool {work = Part.work milling, radius = Part.radius milling, leaves = allowance}
