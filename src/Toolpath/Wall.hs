-- | The walls of a toolpath: the contours that its statements machine, indexed by boxes, so that
-- the elements near a move are found fast.
--
-- Statements that machine equal contours with equal tolerances share a wall. So a move is compared
-- once with a contour that many statements machine.
module Toolpath.Wall
  ( WallIndex,
    Wall (..),
    index,
    statements,
    top,
    near,
  )
where

import Base.Quantity (Mm (..))
import Base.Region (Located (..))
import Data.Either (fromRight)
import Data.Function (on)
import Data.List (foldl', partition, sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (isJust, mapMaybe)
import Data.Set (Set)
import Data.Set qualified as Set
import Geometry.Carrier qualified as Carrier
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Part.Part
  ( Accuracy,
    Contour (elements),
    Element,
    Milling (contour, side),
    Side (..),
  )
import Part.Part qualified as Part
import Toolpath.MillingSide (leadingSide)
import Toolpath.Swivel qualified as Swivel
import Toolpath.Toolpath (Block (..))
import Toolpath.Toolpath qualified as Toolpath

-- | All walls of a toolpath.
data WallIndex = WallIndex
  { -- | the groups of elements of all walls
    groups :: BoxTree Group,
    -- | the height above which a move cuts nothing; the top of the part is 0
    top :: Mm,
    -- | the numbers of all milling and pocket statements that have a contour to machine
    statements :: Set Int
  }

-- | The contours of one milling or pocket statement, or of several statements with equal contours.
data Wall = Wall
  { -- | the numbers of the statements
    machinedBy :: Set Int,
    -- | the tolerance of each of these statements
    tolerance :: Accuracy,
    -- | the side of the contours on which the cutter moves, in the direction of travel; Nothing if
    -- the statement is wrong
    cutterSide :: Maybe Carrier.Side
  }

-- | At most 'groupSize' consecutive elements of a wall, which share one bounding box. A box for
-- each element would take more memory than the element.
data Group = Group
  { wall :: Wall,
    -- | number of the group among those of all walls, from 0
    rank :: Int,
    -- | a list that begins with the elements of the group. Its rest is the rest of the contour, and
    -- is ignored. Such lists share their memory
    beginning :: NonEmpty Element
  }

-- | The largest number of elements in a group.
groupSize :: Int
groupSize = 16

-- | Collects the walls of the blocks of a toolpath. The passes of a statement have the same
-- contours, and the first pass represents them.
index :: [Block] -> WallIndex
index blocks =
  WallIndex
    { groups = tree (zipWith (\n (w, es) -> Group w n es) [0 ..] (concatMap groupsOf shared)),
      -- The top of the part is at the height 0. While a blade cuts, its z axis may be above that
      -- height.
      top = maximum (Mm 0 : [Swivel.highest milling | Machining {milling} <- machinings]),
      statements = Set.fromList (map statement machinings)
    }
  where
    machinings =
      map NonEmpty.head (NonEmpty.groupBy ((==) `on` statement) (mapMaybe machiningOf blocks))
    shared = sharedWalls machinings
    -- The groups of one wall are in the order of its contour, so that neighbours are close. Several
    -- walls may lie around one another.
    tree = case shared of
      [_] -> BoxTree.index groupBox
      _ -> BoxTree.sortedIndex groupBox

-- | The wall with each of its groups.
groupsOf :: (Wall, [NonEmpty Element]) -> [(Wall, NonEmpty Element)]
groupsOf (w, contours) = concatMap (grouped . NonEmpty.toList) contours
  where
    grouped es = case es of
      [] -> []
      e : rest -> (w, e :| rest) : grouped (drop groupSize es)

-- | The box around the elements of a group.
groupBox :: Group -> BoundingBox
groupBox Group {beginning = e :| es} =
  foldl'
    (\box other -> BoundingBox.union box (BoundingBox.ofSegment (Part.segment other)))
    (BoundingBox.ofSegment (Part.segment e))
    (take (groupSize - 1) es)

-- | The contours that a statement machines.
data Machining = Machining
  { -- | number of the statement
    statement :: Int,
    milling :: Milling,
    -- | the side of the contours on which the cutter moves, in the direction of travel
    leading :: Maybe Carrier.Side,
    -- | the elements of each contour
    machined :: [NonEmpty Element]
  }

-- | The statement to which the pass of a block belongs, with the contours that the pass machines.
-- Nothing for blocks other than passes, and when the centre of the cutter moves on the contour.
machiningOf :: Block -> Maybe Machining
machiningOf b = case b of
  Cutting {job = Located _ milling, pass}
    | value (side milling) /= On ->
      Just (Machining (Toolpath.number pass) milling (sideOf milling) [elements (contour milling)])
    | otherwise -> Nothing
  Clearing {pocket = Located _ p}
    -- The cutter runs over the contours of a surface.
    | isJust (Part.surface p) -> Nothing
  Clearing {pocket = Located _ p, pass} ->
    Just
      ( Machining
          (Toolpath.number pass)
          (Part.wall p)
          (sideOf (Part.wall p))
          (map elements (contour (Part.wall p) : Part.islands p))
      )
  Travelling {} -> Nothing
  Holing _ _ -> Nothing
  Carved {} -> Nothing
  Commanding _ -> Nothing
  where
    sideOf milling = fromRight Nothing (leadingSide milling)

-- | Makes one wall of statements whose contours are equal, element by element, and whose tolerances
-- and sides are equal. Each wall comes with the elements of its contours. Only contours that begin
-- at the same point are compared.
sharedWalls :: [Machining] -> [(Wall, [NonEmpty Element])]
sharedWalls machinings = concatMap separated (Map.elems byStart)
  where
    byStart = Map.fromListWith (flip (<>)) [(beginningOf m, [m]) | m <- machinings]
    beginningOf m =
      [ (Vec.x p, Vec.y p)
        | es <- take 1 (machined m),
          let p = Segment.start (Part.segment (NonEmpty.head es))
      ]
    separated ms = case ms of
      [] -> []
      m : more ->
        let (same, others) = partition (isSame m) more
         in ( Wall
                { machinedBy = Set.fromList (map statement (m : same)),
                  tolerance = Part.tolerance (milling m),
                  cutterSide = leading m
                },
              machined m
            ) :
            separated others
    isSame m n =
      Part.tolerance (milling m) == Part.tolerance (milling n)
        && leading m == leading n
        && machined m == machined n

-- | The elements whose boxes meet a box, each with its wall, if @holds@ is true of the wall. The
-- elements of a wall are in the order of its contours.
near :: (Wall -> Bool) -> BoundingBox -> WallIndex -> [(Wall, Element)]
near holds box WallIndex {groups} =
  [ (wall, e)
    | Group {wall, beginning} <- sortOn rank (filter (holds . wall) (BoxTree.within box groups)),
      e <- NonEmpty.take groupSize beginning,
      BoundingBox.meets box (BoundingBox.ofSegment (Part.segment e))
  ]
