-- | Rest material: the parts of a contour that the cutter does not reach, for each statement.
module Toolpath.RestMaterial
  ( Remaining (..),
    ofPath,
    toolOf,
  )
where

import Base.Quantity (Mm (..), over)
import Base.Region (Located (..), Region)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (mapMaybe)
import Data.Set qualified as Set
import Data.Vector qualified as Vector
import Geometry.Transformation qualified as Transformation
import Offset.Equidistant (UnreachedPart)
import Offset.Equidistant qualified as Equidistant
import Offset.RestMaterial (RestMaterial (Within))
import Part.Break qualified as Break
import Part.Part (Contour, Milling, Pocketing)
import Part.Part qualified as Part
import Toolpath.Error (RestPosition, Tool (..))
import Toolpath.LinkingMove qualified as LinkingMove
import Toolpath.OffsetRefusal qualified as OffsetRefusal
import Toolpath.Toolpath (Block (..), Pass (..), Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | Rest material at the contours of one statement after its last pass.
data Remaining = Remaining
  { -- | region of the statement's first word
    word :: Region,
    tool :: Tool,
    -- | the contour; of a pocket, the outer contour and the islands
    walls :: NonEmpty Contour,
    positions :: NonEmpty (RestPosition, UnreachedPart),
    -- | distance of the cutter's centre from the contours in the last pass
    offsetDistance :: Mm
  }

-- | One entry for each statement that leaves rest material, in the order of execution. A pocket is
-- left out if a later statement clears down to its depth what it has left: what remains then is the
-- rest of that statement.
ofPath :: Toolpath -> [Remaining]
ofPath path =
  Map.elems (Map.fromList (mapMaybe ofBlock (filter (not . isClearedLater) blocks)))
  where
    blocks = Toolpath.blocks path
    isClearedLater block = case block of
      Clearing {pocket = Located region _} -> region `Set.member` cleared
      _ -> False
    cleared =
      Set.fromList
        [ Part.roughedAt r
          | Clearing {pocket = Located _ p, pass} <- blocks,
            Just r <- [Part.roughing p],
            Toolpath.atHeight pass <= Part.roughedDownTo r
        ]

-- | The number of a block's statement, and the rest material of the block; Nothing if it leaves
-- none.
ofBlock :: Block -> Maybe (Int, Remaining)
ofBlock block = case block of
  Cutting {job = Located region m, pass, rests} ->
    remaining (LinkingMove.keyword 4 region) m [] pass <$> NonEmpty.nonEmpty rests
  Clearing {pocket = job@(Located _ p), pass, rests} ->
    remaining (LinkingMove.pocketKeyword job) (Part.wall p) (Part.islands p) pass
      <$> NonEmpty.nonEmpty (map (atFloor p pass) rests)
  Travelling {} -> Nothing
  Holing _ _ -> Nothing
  Carved {} -> Nothing
  Commanding _ -> Nothing

-- | The rest in a corner of the floor of a V-carving. Between it and the contours the flank is
-- carved. So it is that of a cutter with the allowance, shrunk towards the centre of the cutter
-- until only the cutter is left. This is exact between straight contours.
atFloor :: Pocketing -> Pass -> UnreachedPart -> UnreachedPart
atFloor p pass rest = case Equidistant.restMaterial rest of
  Within boundary
    | Part.extent p == Part.FloorOfCarving ->
      rest {Equidistant.restMaterial = Within (fmap (Transformation.segment shrunk) boundary)}
  _ -> rest
  where
    shrunk =
      Transformation.scaling
        (over (Part.radius (Part.wall p)) (reach pass))
        (Equidistant.cutterCentre rest)

-- | The rest material of a pass, with the number of the pass's statement. @islands@ is empty for a
-- pass along a contour. @word@ is the region of the statement's first word.
remaining :: Region -> Milling -> [Contour] -> Pass -> NonEmpty UnreachedPart -> (Int, Remaining)
remaining word milling islands pass rests =
  ( number pass,
    Remaining
      { word,
        tool,
        walls,
        positions = NonEmpty.zip (positionsOf rests) rests,
        offsetDistance = reach pass
      }
  )
  where
    tool = toolOf milling (Toolpath.left pass)
    walls = Part.contour milling :| islands
    positionsOf = OffsetRefusal.restPositions tool (reach pass) breaks elements
    breaks = concatMap Break.breaksOf (NonEmpty.toList walls)
    elements = Vector.fromList (concatMap (NonEmpty.toList . Part.elements) walls)

-- | The cutter of a statement, with the allowance that a pass leaves.
toolOf :: Milling -> Mm -> Tool
toolOf milling allowance =
  Tool
    { work = Part.work milling,
      radius = Part.radius milling,
      leaves = allowance,
      places = Part.places milling
    }
