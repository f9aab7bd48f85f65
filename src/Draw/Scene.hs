-- | Objects of a drawing in mm of paper: contours, cuts, linking moves and rest material. A cut is
-- a part of the toolpath that removes material; linking moves are all other moves. Rest material is
-- material that the cutter cannot reach. An outline is the chain of segments along a contour or a
-- drilled hole, or around an area of rest material.
module Draw.Scene
  ( Scene (..),
    Shape (..),
    MaterialSide (..),
    Cut (..),
    lines,
    fromPart,
    sidedContours,
    restMaterialOf,
    isLastPass,
    isCut,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Base.Region (Located (..))
import Data.Containers.ListUtils (nubOrd, nubOrdOn)
import Data.List qualified as List
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (catMaybes, isNothing, mapMaybe)
import Data.Semigroup (sconcat)
import Draw.Page (Page)
import Draw.Page qualified as Page
import Geometry.Carrier (Circle (Circle), Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Polyarc (Ends (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.Equidistant qualified as Equidistant
import Part.Part (Milling (contour, radius), Operation (..), Pace (..), Part)
import Part.Part qualified as Part
import Toolpath.FromPart qualified as Toolpath
import Toolpath.RestMaterial (Remaining (Remaining, offsetDistance, positions))
import Toolpath.RestMaterial qualified as RestMaterial
import Toolpath.Toolpath
  ( Block
      ( Clearing,
        Commanding,
        Cutting,
        Holing,
        Travelling,
        approach,
        cleared,
        cut,
        job,
        pass,
        pocket,
        retract
      ),
    Move,
    Toolpath,
  )
import Toolpath.Toolpath qualified as Toolpath
import Prelude hiding (lines)

-- | All objects of a drawing, in mm of paper.
data Scene = Scene
  { -- | scale and position of the part
    page :: Page,
    -- | contours and drilled holes
    shapes :: [Shape],
    -- | moves that cut
    cuts :: [Cut],
    -- | outlines of rest material
    restMaterial :: [[Segment]],
    -- | linking moves at feed
    feeds :: [Segment],
    -- | linking moves that are rapid moves
    rapids :: [Segment],
    -- | starting position of the cutter
    start :: Point,
    -- | height of the axis of the spindle on the paper; Nothing for a milled part
    spindleAxis :: Maybe Double,
    -- | tools in the order of their use, each as its kind and a radius in mm of the part: that of
    -- the cutter, or that of the turning tool's nose
    tools :: [(Part.CutterKind, Mm)]
  }

-- | Contour of the part, or circle of a drilled hole, in mm of paper.
data Shape = Shape {ends :: Ends, materialSide :: MaterialSide, outline :: [Segment]}

-- | Side of a contour on which the material of the part lies.
data MaterialSide
  = -- | inside the contour
    Inside
  | -- | outside the contour
    Outside
  | -- | not known, because the contour is open or no cutter moves beside it
    Unknown
  deriving stock (Eq)

-- | Toolpath of one cut: one pass along a contour, or the moves in a pocket from one plunge to the
-- next lift.
data Cut = Cut
  { -- | parts of the cut in order, each of them one line, one arc, or all arcs of one curve. The
    -- ends of the parts are the nodes
    sections :: NonEmpty (NonEmpty Segment),
    -- | radius of the cutter in mm of paper
    cutterRadius :: Double,
    -- | side of the path that faces away from the contour: +1 for its right, -1 for its left. It is
    -- a factor for 'Vec.left', which points to the right on paper, because y points down there
    away :: Double,
    -- | True if the cutter's centre is on the contour
    isOnContour :: Bool,
    -- | True if the nodes have numbers: in the last pass of a milling statement, but not in a
    -- pocket
    numbered :: Bool,
    -- | True if the cutter is drawn where the cut begins; in a pocket only for the first cut of a
    -- pass
    showsCutter :: Bool
  }

-- | All segments of a cut.
lines :: Cut -> NonEmpty Segment
lines = sconcat . sections

-- | Converts a part and its toolpath to the objects of a drawing.
fromPart :: Part -> Toolpath -> Scene
fromPart part path =
  Scene
    { page,
      shapes =
        map (shapeOf page millingsAt) contours
          <> map (holeOf page) (nubOrd (concatMap holesOf (Part.operations part))),
      cuts = concatMap (cutsOf page (isLastPass path)) (drawnOnce (Toolpath.blocks path)),
      restMaterial = map (map (Page.segment page)) (restMaterialOf path),
      feeds = along (\pace -> pace /= Rapid),
      rapids = along (== Rapid),
      start = Page.place page begin,
      spindleAxis =
        if Toolpath.isTurned path then Just (Vec.y (Page.place page (Vec.point 0 0))) else Nothing,
      tools = List.nub [(Part.kind c, Part.cutterRadius c) | c <- cuttersOf path]
    }
  where
    begin = Part.plane (value (Toolpath.start path))
    contours = drawnContours part
    millingsAt = millingsByStart part
    between = concatMap movesBetween (Toolpath.blocks path)
    along wanted =
      map
        (Page.segment page)
        (nubOrd [Toolpath.segment m | m <- between, wanted (Toolpath.pace m)])
    page =
      Page.choose (foldl BoundingBox.union (BoundingBox.ofPoints begin []) (boxes <> mirrored))
    boxes = boxesOf contours path
    mirrored = if Toolpath.isTurned path then map mirrorImage (contourBoxes contours) else []
    mirrorImage b =
      b {BoundingBox.bottom = -(BoundingBox.top b), BoundingBox.top = -(BoundingBox.bottom b)}

-- | Contours of a drawing in mm of the part, each with the side on which its material lies.
sidedContours :: Part -> [(Part.Contour, MaterialSide)]
sidedContours part = [(c, materialSideOf millings c) | c <- drawnContours part]
  where
    millings = millingsByStart part

-- | Contours of a drawing: those of the part, and those that are milled.
drawnContours :: Part -> [Part.Contour]
drawnContours part =
  distinct (Part.contours part <> map contour (concatMap millingOf (Part.operations part)))

-- | Millings of a part by the first point of their contours.
millingsByStart :: Part -> Map Point [Milling]
millingsByStart part =
  Map.fromListWith
    (flip (<>))
    [(beginning (contour m), [m]) | m <- concatMap millingOf (Part.operations part)]

-- | Cutters with which a toolpath cuts, in the order of their use.
cuttersOf :: Toolpath -> [Part.Cutter]
cuttersOf path = go (Toolpath.firstCutter (Toolpath.setup path)) (Toolpath.blocks path)
  where
    go cutter blocks = case blocks of
      [] -> []
      Toolpath.Commanding (Located _ (Part.ChangeTool _ c)) : more -> go (Just c) more
      block : more -> [c | isWork block, Just c <- [cutter]] <> go cutter more
    isWork block = case block of
      Toolpath.Cutting {} -> True
      Toolpath.Clearing {} -> True
      Toolpath.Holing {} -> True
      Toolpath.Travelling {} -> False
      Toolpath.Commanding _ -> False

-- | Drops contours that are equal to earlier ones in the list.
distinct :: [Part.Contour] -> [Part.Contour]
distinct = catMaybes . snd . List.mapAccumL next Map.empty
  where
    next known c
      | c `elem` Map.findWithDefault [] (beginning c) known = (known, Nothing)
      | otherwise = (Map.insertWith (<>) (beginning c) [c] known, Just c)

-- | First point of a contour.
beginning :: Part.Contour -> Point
beginning = Segment.start . Part.segment . NonEmpty.head . Part.elements

-- | Contours that an operation mills, each with its side and its cutter. For a pocket they are its
-- wall and its islands.
millingOf :: Operation -> [Milling]
millingOf operation = case operation of
  Mill job -> [value job]
  Pocket (Located _ p) ->
    Part.wall p :
      [ (Part.wall p) {contour = i, Part.side = Part.Outside <$ Part.side (Part.wall p)}
        | i <- Part.islands p
      ]
  Drill _ -> []
  Travel _ -> []
  Command _ -> []

-- | Outlines of rest material, in mm of the part. If the boundary of some rest material was not
-- found, a circle is drawn instead. Its centre is the point at which the cutter's centre has to
-- stop before this material. Its radius is a quarter of the distance between the cutter's centre
-- and the contour in the last pass.
restMaterialOf :: Toolpath -> [[Segment]]
restMaterialOf path = nubOrd (concatMap drawn (RestMaterial.ofPath path))
  where
    drawn Remaining {offsetDistance, positions} =
      concatMap (\(_, f) -> material offsetDistance f) (NonEmpty.toList positions)
    material offsetDistance f = case Equidistant.restMaterial f of
      Equidistant.Within outline -> [NonEmpty.toList outline]
      Equidistant.SameAs _ -> []
      Equidistant.Unbounded -> [spot (Equidistant.cutterCentre f) offsetDistance]
    spot p (Mm r) =
      [ Segment.fullCircle
          CounterClockwise
          (Circle p (Mm (r / 4)))
          (Vec.shift (Vec.vec (r / 4) 0) p)
      ]

-- | Drilled holes of an operation, as circles on the part.
holesOf :: Operation -> [Circle]
holesOf operation = case operation of
  Mill _ -> []
  Pocket _ -> []
  Drill (Located _ d) ->
    [Circle p (Part.drillRadius d) | Located _ p <- NonEmpty.toList (Part.holes d)]
  Travel _ -> []
  Command _ -> []

-- | Linking moves of a block of the toolpath.
movesBetween :: Block -> [Move]
movesBetween block = case block of
  Travelling _ _ moves -> moves
  Cutting {approach, retract} -> approach <> retract
  Clearing {approach, cleared, retract} ->
    approach <> filter (not . isCut) (NonEmpty.toList cleared) <> retract
  Holing _ moves -> moves
  Commanding _ -> []

-- | Bounding boxes of everything that has to be on the page: contours, moves, cutters and drilled
-- holes. Their coordinates are those of the part, not those of the paper.
boxesOf :: [Part.Contour] -> Toolpath -> [BoundingBox]
boxesOf contours path =
  contourBoxes contours
    <> [Page.extent (Toolpath.segment m) | b <- Toolpath.blocks path, m <- Toolpath.moves b]
    <> concatMap cutterBox (Toolpath.blocks path)

-- | Bounding boxes of the segments of contours.
contourBoxes :: [Part.Contour] -> [BoundingBox]
contourBoxes contours =
  [Page.extent s | c <- contours, s <- NonEmpty.toList (Polyarc.segments (Part.polyarcOf c))]

-- | Bounding boxes, on the part, of the drawn cutters and of the drilled holes of a block.
cutterBox :: Block -> [BoundingBox]
cutterBox block = case block of
  Travelling {} -> []
  Holing (Located _ d) _ ->
    [ BoundingBox.inflate (Part.drillRadius d) (BoundingBox.ofPoints p [])
      | Located _ p <- NonEmpty.toList (Part.holes d)
    ]
  Commanding _ -> []
  Cutting {job = Located _ milling, cut} -> [cutterAt milling cut]
  Clearing {pocket = Located _ p, cleared} -> [cutterAt (Part.wall p) cleared]
  where
    cutterAt milling ms =
      BoundingBox.inflate
        (radius milling)
        (BoundingBox.ofPoints (Segment.start (Toolpath.segment (NonEmpty.head ms))) [])

-- | Converts a contour to paper. @millings@ gives for each point the millings of all contours that
-- begin at this point. The material of the contour lies on the side opposite to the cutter. The
-- cutter's side is that of the first milling of this contour in which the cutter runs beside it.
shapeOf :: Page -> Map Point [Milling] -> Part.Contour -> Shape
shapeOf page millings c =
  Shape
    { ends = Part.ends c,
      materialSide = materialSideOf millings c,
      outline = map (Page.segment page) (NonEmpty.toList (Polyarc.segments (Part.polyarcOf c)))
    }

-- | Side of a contour on which its material lies. The first argument is that of 'shapeOf'.
materialSideOf :: Map Point [Milling] -> Part.Contour -> MaterialSide
materialSideOf millings c =
  case mapMaybe
    sideOf
    ( filter
        (\m -> Part.polyarcOf (contour m) == bare)
        (Map.findWithDefault [] (beginning c) millings)
    ) of
    side : _
      | Part.ends c == Closed ->
        if (side == Carrier.LeftOf) == (Polyarc.signedArea bare > 0) then Outside else Inside
    _ -> Unknown
  where
    bare = Part.polyarcOf c

-- | Converts a drilled hole, given as a circle on the part, to paper.
holeOf :: Page -> Circle -> Shape
holeOf page circle@(Circle c r) =
  Shape {ends = Closed, materialSide = Outside, outline = [Page.segment page whole]}
  where
    whole = Segment.fullCircle CounterClockwise circle (Vec.shift (Vec.polar r (Rad 0)) c)

-- | Side of the contour on which the cutter runs; Nothing if the cutter's centre runs on the
-- contour.
sideOf :: Milling -> Maybe Carrier.Side
sideOf milling = case Toolpath.leadingSide milling of
  Left _ -> Nothing
  Right side -> side

-- | Cuts of a block of the toolpath, converted to paper.
cutsOf :: Page -> (Toolpath.Pass -> Bool) -> Block -> [Cut]
cutsOf page isLast block = case block of
  Travelling {} -> []
  Holing _ _ -> []
  Commanding _ -> []
  Cutting {job = Located _ milling, pass, cut} ->
    [ (along milling cut)
        { away = awayFrom milling,
          isOnContour = isNothing (sideOf milling),
          numbered = isLast pass
        }
    ]
  -- The moves from one plunge to the next lift in a pocket are one cut.
  Clearing {pocket = Located _ p, cleared} ->
    zipWith
      (\showsCutter ms -> (along (Part.wall p) ms) {showsCutter})
      (True : repeat False)
      [ms | ms@(m :| _) <- NonEmpty.groupBy (\a b -> isCut a == isCut b) cleared, isCut m]
  where
    along milling ms =
      Cut
        { sections =
            fmap
              (fmap (Page.segment page . Toolpath.segment))
              (NonEmpty.groupBy1 (\_ m -> Toolpath.continues m) ms),
          cutterRadius = Page.onPaper page (radius milling),
          away = 1,
          isOnContour = False,
          numbered = False,
          showsCutter = True
        }

-- | Test that a pass is the last one of its milling statement.
isLastPass :: Toolpath -> Toolpath.Pass -> Bool
isLastPass path = isFinal
  where
    isFinal pass = Map.lookup (Toolpath.number pass) final == Just pass
    -- It is computed once for all passes.
    final = Map.fromList [(Toolpath.number p, p) | Cutting {pass = p} <- Toolpath.blocks path]

-- | True if a move in a pocket cuts: it is at feed and does not change the height.
isCut :: Move -> Bool
isCut m = Toolpath.pace m /= Rapid && uncurry (==) (Toolpath.heights m)

-- | Drops blocks that would be drawn over others. If passes of a pocket differ only in their depth,
-- the first of them remains.
drawnOnce :: [Block] -> [Block]
drawnOnce blocks = map snd (nubOrdOn key (zip [0 ..] blocks))
  where
    key :: (Int, Block) -> Either Int (Int, Mm)
    key (i, b) = case b of
      Clearing {pass} -> Right (Toolpath.number pass, Toolpath.left pass)
      _ -> Left i

-- | Value of 'away' for the cuts of a milling: +1 to place labels on the right of the path, -1 on
-- its left. If the cutter's centre is on the contour, labels are outside of a closed contour and on
-- the left of an open one.
awayFrom :: Milling -> Double
awayFrom milling = case (sideOf milling, Part.ends (contour milling)) of
  (Just Carrier.LeftOf, _) -> -1
  (Just Carrier.RightOf, _) -> 1
  (Nothing, Closed) -> signum (Polyarc.signedArea (Part.polyarcOf (contour milling)))
  (Nothing, Open) -> -1
