-- | Descents: the moves by which a tool goes down into the material. The holes of a drill are no
-- descents.
module Draw.Descent
  ( Descent (..),
    DescentKind (..),
    ofMoves,
    deepest,
  )
where

import Base.Quantity (Mm (..))
import Data.List (sortOn)
import Data.Map.Strict qualified as Map
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Toolpath.Toolpath (Move)
import Toolpath.Toolpath qualified as Toolpath

-- | Consecutive moves down: their kind, the point at which they end, and the height of this point.
data Descent = Descent {kind :: DescentKind, at :: Point, bottom :: Mm}
  deriving stock (Eq, Show)

-- | Form of a descent.
data DescentKind
  = -- | straight down
    Plunge
  | -- | down along lines
    Ramp
  | -- | down along arcs
    Helix
  deriving stock (Eq, Ord, Show)

-- | Descents among linking moves that end below the top of the part.
ofMoves :: [Move] -> [Descent]
ofMoves moves = case dropWhile (not . isDown) moves of
  [] -> []
  down ->
    let (run, rest) = span isDown down
     in [ Descent {kind = kindOf run, at = Segment.end (Toolpath.segment m), bottom = z}
          | m <- take 1 (reverse run),
            let z = snd (Toolpath.heights m)
        ]
          <> ofMoves rest
  where
    -- Moves down that end above the part belong to no descent.
    isDown m = let (a, b) = Toolpath.heights m in b < a && b < Mm 0

-- | Kind of a run of moves down.
kindOf :: [Move] -> DescentKind
kindOf run
  | any isArc segments = Helix
  | any ((> Mm 1e-6) . Segment.length) segments = Ramp
  | otherwise = Plunge
  where
    segments = map Toolpath.segment run
    isArc s = case s of
      Arc {} -> True
      Straight _ _ -> False

-- | Deepest one of the descents of a kind that end at the same point.
deepest :: [Descent] -> [Descent]
deepest descents =
  map snd . sortOn fst . Map.elems $
    Map.fromListWith
      deeper
      [((at d, kind d), (i, d)) | (i, d) <- zip [0 :: Int ..] descents]
  where
    deeper (i, a) (j, b) = (min i j, if bottom a < bottom b then a else b)
