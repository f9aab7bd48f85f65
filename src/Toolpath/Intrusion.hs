-- | Moves that cut into a machined contour where the program does not allow it.
--
-- Most moves are checked against all contours: approaches, retracts, drilling, all moves in
-- pockets, and the moves of the statements @rapid@ and @move@. The cuts along a contour are checked
-- against the contours of other statements only: "Offset.Equidistant" already ensures that they do
-- not gouge their own contour. A move wholly above the top of the part cuts nothing. An /intrusion/
-- is a cut of a move into a contour, or into the allowance on a contour.
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
import Toolpath.MillingSide (keyword, leadingSide)
import Toolpath.PointedIntrusion (PointedIntrusion (PointedIntrusion))
import Toolpath.PointedIntrusion qualified as PointedIntrusion
import Toolpath.Swivel qualified as Swivel
import Toolpath.Tolerance qualified as PathTolerance
import Toolpath.Toolpath (Block (..), Move, Pass (..), Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | The intrusions of a toolpath that are deeper than the tolerance of the statement that machines
-- the contour. A region of the program may ask for several moves that intrude; it gets one error,
-- for the deepest intrusion. Of the cuts in one pass, only the first one that intrudes counts.
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

-- | A sort key: minus the depth of an intrusion in mm, so that the deepest one is the least.
depth :: Error -> Double
depth e = case e of
  CutsPart _ _ _ (Mm d) _ _ -> -d
  HoleCuts _ _ _ (Mm d) -> -d
  MillsAnother _ _ _ (Mm d) _ -> -d
  _ -> 0

-- | All machined contours of a program.
data Machined = Machined
  { index :: BoxTree Wall,
    -- | the height above which a move cuts nothing; the top of the part is 0
    top :: Mm,
    -- | the numbers of all milling and pocket statements that have a contour to machine
    statements :: [Int]
  }

-- | The contours of one milling or pocket statement.
data Wall = Wall
  { -- | number of the statement
    statement :: Int,
    milling :: Milling,
    -- | one bounding box for each 'groupSize' consecutive elements. The list at a box begins with
    -- these elements; the rest of the list is the rest of the contour, and is ignored. Such lists
    -- share their memory. A box for each element would take more memory than the element
    groups :: BoxTree (NonEmpty Part.Element)
  }

-- | The largest number of elements in one bounding box.
groupSize :: Int
groupSize = 16

-- | Collects the machined contours. The passes of a statement have the same contours, and the first
-- pass represents them.
machinedOf :: [Block] -> Machined
machinedOf blocks =
  Machined
    { index = BoxTree.index (BoxTree.boundingBox . groups) walls,
      -- The top of the part is at the height 0. While a blade cuts, its z axis may be above that
      -- height.
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

-- | The statement to which the pass of a block belongs: its number, the statement itself, and the
-- contours that the pass machines. Nothing for blocks other than passes, and when the centre of the
-- cutter moves on the contour.
contoursOf :: Block -> Maybe (Int, Milling, [Contour])
contoursOf b = case b of
  Cutting {job = Located _ milling, pass}
    | value (side milling) /= On -> Just (number pass, milling, [contour milling])
    | otherwise -> Nothing
  Clearing {pocket = Located _ p, pass} ->
    Just (number pass, Part.wall p, contour (Part.wall p) : Part.islands p)
  Travelling {} -> Nothing
  Holing _ _ -> Nothing
  Commanding _ -> Nothing

-- | A tool, and the contours from which it has to keep its distance.
data Intruder = Intruder
  { -- | radius of the tool
    tool :: Mm,
    -- | number of the statement whose contour is not checked, because the moves are cuts along that
    -- contour; Nothing if all contours are checked
    own :: Maybe Int,
    -- | for linking moves: the number of their statement, and the allowance that remains after its
    -- last pass. The moves must not cut into this allowance. Nothing if no allowance is checked
    leaving :: Maybe (Int, Mm)
  }

-- | The intrusions of the moves of a block.
intrusionsOfBlock :: Machined -> Block -> [Error]
intrusionsOfBlock machined b = case b of
  Commanding _ -> []
  Travelling radius' _ ms -> concatMap (found (Intruder radius' Nothing Nothing)) ms
  Holing (Located _ d) ms ->
    map asHole (concatMap (found (Intruder (Part.drillRadius d) Nothing Nothing)) ms)
  Cutting {job = Located at milling, pass, approach, cut, retract} ->
    let left = Just (number pass, minimum (Part.allowances milling))
        linking = Intruder {tool = radius milling, own = Nothing, leaving = left}
        cutting = Intruder {tool = radius milling, own = Just (number pass), leaving = Nothing}
     in concatMap (found linking) (approach <> retract)
          <> mapMaybe (throughProfile milling) (approach <> retract)
          <> take
            1
            ( concatMap
                (map (asMilling (keyword at)) . found cutting)
                (if isAlone (number pass) then [] else NonEmpty.toList cut)
            )
  Clearing {pocket = Located at p, pass, approach, cleared, retract} ->
    let clearing = Intruder (radius (Part.wall p)) Nothing Nothing
        left = Just (number pass, NonEmpty.last (Part.allowances (Part.wall p)))
     in concatMap (found clearing {leaving = left}) (approach <> retract)
          <> take
            1
            ( concatMap
                (map (asMilling (LinkingMove.keyword 6 at)) . found clearing)
                (NonEmpty.toList cleared)
            )
  where
    found = intrusionsOfMove machined
    -- If no other statement has a contour, the cuts of statement @n@ need no check.
    isAlone n = all (== n) (statements machined)
    -- For a cut, the report names the element along which the cutter moves, instead of the move.
    asMilling word e = case e of
      CutsPart milled _ element deep _ p -> MillsAnother word milled element deep p
      _ -> e
    asHole e = case e of
      CutsPart at move element deep _ _ -> HoleCuts at (Segment.end move) element deep
      _ -> e

-- | The intrusion of a linking move of a pointed tool into the material behind its own profile;
-- Nothing for other tools, and when the tool moves on the profile.
throughProfile :: Milling -> Move -> Maybe Error
throughProfile milling m
  | radius milling <= Mm 0,
    Right (Just side') <- leadingSide milling,
    Just (PointedIntrusion element deep p) <-
      PointedIntrusion.deepest side' (allowedDepth milling path) (contour milling) path =
    Just (CutsPart (Toolpath.origin m) path element deep CutsContour p)
  | otherwise = Nothing
  where
    path = Toolpath.segment m

-- | The depth in mm to which a move may cut into a contour: the tolerance, and rounding. An arc may
-- cut less deep ('PathTolerance.arcIntrusion'), because its chords need the tolerance, too.
allowedDepth :: Milling -> Segment -> Mm
allowedDepth milling path = plus Tolerance.clearance $ case path of
  Straight _ _ -> inwards
  Arc {} -> min inwards PathTolerance.arcIntrusion
  where
    inwards = fst (Part.deviationLimits (Part.tolerance milling))

-- | The deepest intrusion of a move into the contours of each statement. If several of these are at
-- one point, only the first is listed, because the statements then mill the same contour.
intrusionsOfMove :: Machined -> Intruder -> Move -> [Error]
intrusionsOfMove machined intruder m
  | fst (Toolpath.heights m) > top machined && snd (Toolpath.heights m) > top machined = []
  | otherwise =
    nubBy
      isSamePoint
      (map deepest (groupBy ((==) `on` fst) (sortOn fst (hits machined intruder m))))
  where
    isSamePoint e f = case (e, f) of
      (CutsPart _ _ _ _ _ p, CutsPart _ _ _ _ _ q) -> Vec.isNear p q
      _ -> False
    deepest errors = minimumBy (comparing depth) (map snd errors)

-- | The intrusions of the move @m@ into the elements near it, each with the number of the element's
-- statement.
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

-- | The intrusion of the move @m@ into the element. Nothing if the move keeps its distance, within
-- the tolerance of the element's statement @milling@. @tool@ is the radius of the tool. @kept@ is
-- the distance that the tool's centre has to keep from the element.
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
    allowed = allowedDepth milling path
    how
      | d <= Tolerance.coincident = Crossing
      | plus d allowed < tool = CutsContour
      | otherwise = CutsAllowance

-- | True if the ends of @path@ lie on opposite sides of @wall@, both at a distance of more than
-- @allowed@. The sides of an arc are the inside and the outside of its circle. True also if @path@
-- enters this circle from the outside, deeper than @allowed@, and leaves it again. The check is for
-- pointed tools: their radius is 0, so no distance from a wall is too small.
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
