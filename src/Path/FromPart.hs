-- | From the part to the cutter's path: the equidistant of every contour to be milled, the ways in
-- and out, and the moves between.
module Path.FromPart
  ( lay,
    leadingSide,
  )
where

import Base.Quantity (Mm (..), minus, plus)
import Base.Region (Located (..), Region (..))
import Base.Result (Result (..))
import Data.Bifunctor (first)
import Data.List (minimumBy)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Ord (comparing)
import Data.Vector qualified as Vector
import Geometry.Box qualified as Box
import Geometry.Contour qualified as Contour
import Geometry.Distance (Nearest (..))
import Geometry.Distance qualified as Distance
import Geometry.Offset qualified as Offset
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Contour (..), Element, Milling (contour, feed, radius, side, tolerance), Operation (..), Part, Side (..), Stop)
import Part.Part qualified as Part
import Path.Error (Error (..))
import Path.Path (Block (..), Move (..), Path (Path, blocks))
import Path.Path qualified as Path

-- | Lay the path. No path when an operation has none, or when there are operations but the start is
-- unknown, which is reported already; a part that is only drawn has a path without moves.
lay :: Part -> Result w Error Path
lay part = case (Part.start part, Part.operations part) of
  (Nothing, []) -> Result [] [] (Just (Path (Located (Region 0 0) (Vec.point 0 0)) []))
  (Nothing, _) -> Result [] [] Nothing
  (Just begin, _) -> case collect (value begin) (Part.operations part) of
    ([], blocks) ->
      let path = Path begin blocks
       in Result [] (intrusions path) (Just path)
    (errors, _) -> Result [] errors Nothing

-- | The blocks one after the other; an operation without a path leaves the cutter where it was.
collect :: Point -> [Operation] -> ([Error], [Block])
collect at operations = case operations of
  [] -> ([], [])
  o : rest -> case block at o of
    Left e -> first (e :) (collect at rest)
    Right b -> (b :) <$> collect (foldl (\_ m -> Segment.end (segment m)) at (Path.moves b)) rest

block :: Point -> Operation -> Either Error Block
block at operation = case operation of
  Travel stops -> Right (Travelling (ways at (NonEmpty.toList stops)))
  Mill job@(Located region milling) -> do
    pieces <- along job
    let entry = Segment.start (Offset.segment (NonEmpty.head pieces))
        exit = Segment.end (Offset.segment (NonEmpty.last pieces))
        pace = Part.At (feed milling)
        before = ways at (Part.approach milling <> [Part.Stop (Located (keyword region) entry) pace])
        origins = Vector.fromList (map Part.origin (NonEmpty.toList (elements (contour milling))))
        number origin = case origin of
          Offset.Along i -> i
          Offset.Around i -> i
        cut = fmap (\p -> Move (Offset.segment p) pace (origins Vector.! number (Offset.origin p))) pieces
    Right Cutting {job, approach = before, cut, retract = ways exit (Part.retract milling)}

-- | Straight moves from stop to stop; a stop where the cutter already stands needs none.
ways :: Point -> [Stop] -> [Move]
ways at stops = case stops of
  [] -> []
  Part.Stop (Located region p) pace : rest
    | Vec.near at p -> ways at rest
    | otherwise -> Move (Straight at p) pace region : ways p rest

-- | The cutter's way along the contour itself.
along :: Located Milling -> Either Error (NonEmpty Offset.Piece)
along (Located region milling) = do
  side <- leadingSide milling
  case side of
    Nothing -> Right (NonEmpty.zipWith (\i e -> Offset.Piece (Offset.Along i) (Part.segment e)) (0 :| [1 ..]) (elements (contour milling)))
    Just s -> first obstacle (Offset.equidistant s r (Part.outline (contour milling)))
  where
    r = radius milling
    element i = elements (contour milling) NonEmpty.!! i
    obstacle (Offset.Obstacle cause largest) = case cause of
      Offset.Concave i old -> ConcaveRadius region r (element i) old largest
      Offset.InnerCorner i j p -> InnerCorner region r (element i) (element j) p largest
      Offset.Collision i j p -> Collision region r (element i) (element j) p largest

-- | The side of the walk on which the cutter stands; none when it runs on the contour.
leadingSide :: Milling -> Either Error (Maybe Offset.Side)
leadingSide milling = case (value (side milling), ends (contour milling)) of
  (LeftSide, _) -> Right (Just Offset.LeftOf)
  (RightSide, _) -> Right (Just Offset.RightOf)
  (On, _) -> Right Nothing
  (Outside, Part.Closed) -> Right (Just (if counterClockwise then Offset.RightOf else Offset.LeftOf))
  (Inside, Part.Closed) -> Right (Just (if counterClockwise then Offset.LeftOf else Offset.RightOf))
  (s, Part.Open) -> Left (SideOfOpen (region (side milling)) s (value name) (region name))
  where
    counterClockwise = Contour.signedArea (Part.outline (contour milling)) > 0
    name = contourName (contour milling)

-- | Moves that cut into a milled contour deeper than its tolerance: ways in and out and between, and
-- cuts along other contours. Cuts along the contour itself are the equidistant's concern.
intrusions :: Path -> [Error]
intrusions path = concat (zipWith against [0 :: Int ..] (blocks path))
  where
    against n b = case b of
      Travelling _ -> []
      Cutting {job = Located _ milling} -> case value (side milling) of
        On -> []
        _ ->
          let index = Box.index (Box.ofSegment . Part.segment) (NonEmpty.toList (elements (contour milling)))
           in concat (zipWith (foreign' milling index n) [0 ..] (blocks path))
    foreign' milling index n k b = case b of
      Travelling ms -> concatMap (intrusion milling index) ms
      Cutting {job, approach, cut, retract} ->
        concatMap (intrusion milling index) (approach <> retract)
          <> take 1 (if n == k then [] else concatMap (map (another job) . intrusion milling index) (NonEmpty.toList cut))
    -- A cut along another contour is no way that could be chosen otherwise.
    another (Located statement _) e = case e of
      CutsPart milled _ element depth _ p -> MillsAnother (keyword statement) milled element depth p
      _ -> e

-- | The first word of a milling statement.
keyword :: Region -> Region
keyword r = r {end = start r + 4}

-- | Where a move cuts deepest into a contour, if it does.
intrusion :: Milling -> Box.Index Element -> Move -> [Error]
intrusion milling index move
  | null deep = []
  | otherwise = [minimumBy (comparing depth) deep]
  where
    depth e = case e of
      CutsPart _ _ _ (Mm d) _ _ -> -d
      _ -> 0
    deep =
      [ CutsPart (Path.origin move) (Path.segment move) element (minus (radius milling) d) (d <= Tolerance.coincident) p
        | element <- Box.within (Box.inflate (radius milling) (Box.ofSegment (Path.segment move))) index,
          let Nearest d p = Distance.segments (Path.segment move) (Part.segment element),
          plus d (tolerance milling) < radius milling
      ]
