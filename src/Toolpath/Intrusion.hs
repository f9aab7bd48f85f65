-- | Moves that cut into a machined contour where they should not.
--
-- This checks approaches, retracts and linking moves against all contours, and cuts against the
-- contours of other statements. "Offset.Equidistant" keeps cuts along the contour itself clear of
-- it. A move wholly above the top of the part cuts nothing.
module Toolpath.Intrusion
  ( intrusions,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Base.Region (Located (..), Region (..))
import Data.Function (on)
import Data.List (foldl', groupBy, minimumBy, nubBy, sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (mapMaybe)
import Data.Ord (comparing)
import Geometry.Distance (ClosestPoint (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (Arc, Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec
import Offset.Tolerance qualified as Tolerance
import Part.Part
  ( Contour (elements),
    Milling (contour, radius, side),
    Side (..),
  )
import Part.Part qualified as Part
import Toolpath.Error (Error (..), Intrusion (..))
import Toolpath.LinkingMove qualified as LinkingMove
import Toolpath.MillingSide (keyword)
import Toolpath.Swivel qualified as Swivel
import Toolpath.Toolpath (Block (..), Move, Pass (..), Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | The moves of a path that cut into a contour deeper than its tolerance. For each position in the
-- program only the worst one is listed.
intrusions :: Toolpath -> [Error]
intrusions path = worst (concatMap (intrusionsOfBlock machined) (Toolpath.blocks path))
  where
    machined = machinedOf (Toolpath.blocks path)
    worst errors =
      map
        (minimumBy (comparing depth))
        (Map.elems (Map.fromListWith (flip (<>)) [(regionOf e, [e]) | e <- errors]))
    regionOf e = case e of
      CutsPart at _ _ _ _ _ -> at
      HoleCuts at _ _ _ -> at
      MillsAnother at _ _ _ _ -> at
      _ -> Region 0 0

-- | The sort key of an intrusion: the deepest one is the least.
depth :: Error -> Double
depth e = case e of
  CutsPart _ _ _ (Mm d) _ _ -> -d
  HoleCuts _ _ _ (Mm d) -> -d
  MillsAnother _ _ _ (Mm d) _ -> -d
  _ -> 0

-- | All machined contours of a program.
data Machined = Machined
  { index :: BoxTree Wall,
    -- | the largest height at which a tool still cuts, in mm
    top :: Mm,
    -- | the number of every milling statement that has walls
    statements :: [Int]
  }

-- | The contours of one milling statement, by its number. A bounding box holds several elements:
-- one for each element would take more memory than the elements, and few are asked for.
data Wall = Wall
  { statement :: Int,
    milling :: Milling,
    groups :: BoxTree (NonEmpty Part.Element)
  }

-- | The number of elements in one bounding box.
groupSize :: Int
groupSize = 16

machinedOf :: [Block] -> Machined
machinedOf blocks =
  Machined
    { index = BoxTree.index (BoxTree.boundingBox . groups) walls,
      -- The axis of a blade may be above the top of the part while the blade is in it.
      top = maximum (Mm 0 : [Swivel.highest milling | Wall {milling} <- walls]),
      statements = map statement walls
    }
  where
    walls =
      [ Wall n milling (BoxTree.index boxOf (concatMap groupsOf cs))
        | (n, milling, cs) <-
            map NonEmpty.head (NonEmpty.groupBy ((==) `on` numberOf) (mapMaybe contoursOf blocks))
      ]
    numberOf (n, _, _) = n
    groupsOf = grouped . NonEmpty.toList . elements
    grouped es = case es of
      [] -> []
      e : rest -> (e :| rest) : grouped (drop groupSize es)
    boxOf (e :| es) =
      foldl'
        (\box other -> BoundingBox.union box (BoundingBox.ofSegment (Part.segment other)))
        (BoundingBox.ofSegment (Part.segment e))
        (take (groupSize - 1) es)

-- | The number of the statement of a pass, its settings, and the contours that it machines.
contoursOf :: Block -> Maybe (Int, Milling, [Contour])
contoursOf b = case b of
  Cutting {job = Located _ milling, pass}
    | value (side milling) /= On -> Just (number pass, milling, [contour milling])
    | otherwise -> Nothing
  Clearing {pocket = Located _ p, pass} ->
    Just (number pass, Part.wall p, contour (Part.wall p) : Part.islands p)
  Travelling _ _ -> Nothing
  Holing _ _ -> Nothing
  Commanding _ -> Nothing

-- | A tool in the moves of one statement.
data Intruder = Intruder
  { -- | radius of the tool
    tool :: Mm,
    -- | the number of the statement whose contour is not checked, since the moves are cuts along it
    own :: Maybe Int,
    -- | the number of a statement, and the material that it leaves on its contour in the end
    leaving :: Maybe (Int, Mm)
  }

intrusionsOfBlock :: Machined -> Block -> [Error]
intrusionsOfBlock machined b = case b of
  Commanding _ -> []
  Travelling radius' ms -> concatMap (found (Intruder radius' Nothing Nothing)) ms
  Holing (Located _ d) ms ->
    map asHole (concatMap (found (Intruder (Part.drillRadius d) Nothing Nothing)) ms)
  Cutting {job = Located at milling, pass, approach, cut, retract} ->
    let left = Just (number pass, minimum (Part.allowances milling))
        linking = Intruder {tool = radius milling, own = Nothing, leaving = left}
        cutting = Intruder {tool = radius milling, own = Just (number pass), leaving = Nothing}
     in concatMap (found linking) (approach <> retract)
          <> take
            1
            ( concatMap
                (map (asMilling (keyword at)) . found cutting)
                (if isAlone (number pass) then [] else NonEmpty.toList cut)
            )
  Clearing {pocket = Located at p, approach, cleared, retract} ->
    let clearing = Intruder (radius (Part.wall p)) Nothing Nothing
     in concatMap (found clearing) (approach <> retract)
          <> take
            1
            ( concatMap
                (map (asMilling (LinkingMove.keyword 6 at)) . found clearing)
                (NonEmpty.toList cleared)
            )
  where
    found = intrusionsOfMove machined
    -- Where nothing else is machined, the cuts along a contour meet nothing else.
    isAlone n = all (== n) (statements machined)
    -- A cut along another contour is no move that could be chosen otherwise.
    asMilling word e = case e of
      CutsPart milled _ element deep _ p -> MillsAnother word milled element deep p
      _ -> e
    asHole e = case e of
      CutsPart at move element deep _ _ -> HoleCuts at (Segment.end move) element deep
      _ -> e

-- | The deepest intrusion of a move into each statement's contours. A contour that is milled
-- several times is listed once.
intrusionsOfMove :: Machined -> Intruder -> Move -> [Error]
intrusionsOfMove machined intruder m
  | fst (Toolpath.heights m) > top machined && snd (Toolpath.heights m) > top machined = []
  | otherwise =
    nubBy
      isSamePoint
      (map deviationLimits (groupBy ((==) `on` fst) (sortOn fst (hits machined intruder m))))
  where
    isSamePoint e f = case (e, f) of
      (CutsPart _ _ _ _ _ p, CutsPart _ _ _ _ _ q) -> Vec.isNear p q
      _ -> False
    deviationLimits errors = minimumBy (comparing depth) (map snd errors)

-- | All elements that a move cuts into, with the numbers of their statements.
hits :: Machined -> Intruder -> Move -> [(Int, Error)]
hits machined Intruder {tool, own, leaving} m =
  [ (statement wall, e)
    | wall <- BoxTree.within reach (index machined),
      Just (statement wall) /= own,
      group <- BoxTree.within reach (groups wall),
      element <- NonEmpty.take groupSize group,
      BoundingBox.meets reach (BoundingBox.ofSegment (Part.segment element)),
      Just e <- [hit tool (keptFrom wall) (milling wall) m element]
  ]
  where
    reach =
      BoundingBox.inflate
        (plus tool (maybe (Mm 0) snd leaving))
        (BoundingBox.ofSegment (Toolpath.segment m))
    keptFrom wall = case leaving of
      Just (leaver, left) | statement wall == leaver -> plus tool left
      _ -> tool

-- | The intrusion of a move into an element, given the tool's radius and the distance that its
-- centre has to keep.
hit :: Mm -> Mm -> Milling -> Move -> Part.Element -> Maybe Error
hit tool kept milling m element
  | plus d allowed < kept || d <= Tolerance.coincident && goesThrough allowed path wall =
    Just
      ( CutsPart
          (Toolpath.origin m)
          path
          element
          (minus (if how == CutsAllowance then kept else tool) d)
          how
          p
      )
  | otherwise = Nothing
  where
    path = Toolpath.segment m
    wall = Part.segment element
    ClosestPoint d p = Distance.segments path wall
    allowed = plus (fst (Part.deviationLimits (Part.tolerance milling))) Tolerance.clearance
    how
      | d <= Tolerance.coincident = Crossing
      | plus d allowed < tool = CutsContour
      | otherwise = CutsAllowance

-- | Whether a segment leads from one side of a wall to the other, by more than an allowed distance
-- on both sides. The tip of a pointed tool cuts nothing beside it.
goesThrough :: Mm -> Segment -> Segment -> Bool
goesThrough allowed path wall = case wall of
  Straight a b ->
    let aside q = Mm (Vec.cross (Vec.unit (Vec.to a b)) (Vec.to a q))
     in isOpposite (aside (Segment.start path)) (aside (Segment.end path))
  Arc from _ centre _ ->
    let r = Segment.radius centre from
        beyond q = minus (Vec.distance centre q) r
        (before, after) = (beyond (Segment.start path), beyond (Segment.end path))
     in isOpposite before after
          || before > Mm 0 && after > Mm 0 && minus r (Distance.toPoint centre path) > allowed
  where
    isOpposite p q = min p q < times (-1) allowed && max p q > allowed
