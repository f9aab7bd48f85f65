-- | Objects of a drawing, converted to paper: contours, cuts, linking moves and rest material.
module Draw.Scene
  ( Scene (..),
    Shape (..),
    Matter (..),
    Cut (..),
    lines,
    set,
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
  { sheet :: Page,
    shapes :: [Shape],
    cuts :: [Cut],
    -- | outlines of rest material
    rests :: [[Segment]],
    -- | straight linking moves at feed
    feeds :: [Segment],
    rapids :: [Segment],
    start :: Point,
    -- | work of each tool, with the radius of its cutter or nose in mm of the part
    tools :: [(Part.Work, Mm)]
  }

-- | Contour of the part, or a drilled hole.
data Shape = Shape {ends :: Ends, matter :: Matter, outline :: [Segment]}

-- | Side of a contour on which the material lies.
data Matter
  = -- | within the contour
    Within
  | -- | around it
    Beyond
  | -- | the drawing does not say
    Unknown
  deriving stock (Eq)

-- | Path of the cutter's centre in one cut.
data Cut = Cut
  { -- | between nodes: one line or arc, or the arcs of one curve
    course :: NonEmpty (NonEmpty Segment),
    -- | radius of the cutter in mm of paper
    reach :: Double,
    -- | side of the path that is away from the contour: +1 for its right, -1 for its left
    away :: Double,
    -- | true if the cutter runs on the contour itself
    upon :: Bool,
    -- | true if the nodes have numbers; false in a pocket
    numbered :: Bool,
    -- | true if the cutter is drawn at the begin of the cut; in a pocket, at the first plunge
    entered :: Bool
  }

-- | All segments of a cut.
lines :: Cut -> NonEmpty Segment
lines = sconcat . course

-- | Converts a part and its toolpath to the objects of a drawing.
set :: Part -> Toolpath -> Scene
set part path =
  Scene
    { sheet,
      shapes =
        map (shapeOf sheet millingsAt) contours
          <> map (holeOf sheet) (nubOrd (concatMap holesOf (Part.operations part))),
      cuts = concatMap (cutsOf sheet) (drawnOnce (Toolpath.blocks path)),
      rests = map (map (Page.segment sheet)) (restsOf path),
      feeds = along (\pace -> pace /= Rapid),
      rapids = along (== Rapid),
      start = Page.place sheet begin,
      tools = nubOrd [(Part.work m, radius m) | m <- millings]
    }
  where
    begin = Part.plane (value (Toolpath.start path))
    millings = concatMap millingOf (Part.operations part)
    contours = distinct (Part.contours part <> map contour millings)
    millingsAt = Map.fromListWith (flip (<>)) [(beginning (contour m), [m]) | m <- millings]
    between = concatMap movesBetween (Toolpath.blocks path)
    along wanted =
      map
        (Page.segment sheet)
        (nubOrd [Toolpath.segment m | m <- between, wanted (Toolpath.pace m)])
    sheet =
      Page.lay (foldl BoundingBox.union (BoundingBox.ofPoints begin []) (boxesOf contours path))

-- | Drops contours that are equal to earlier ones.
distinct :: [Part.Contour] -> [Part.Contour]
distinct = catMaybes . snd . List.mapAccumL next Map.empty
  where
    next known c
      | c `elem` Map.findWithDefault [] (beginning c) known = (known, Nothing)
      | otherwise = (Map.insertWith (<>) (beginning c) [c] known, Just c)

-- | First point of a contour.
beginning :: Part.Contour -> Point
beginning = Segment.start . Part.segment . NonEmpty.head . Part.elements

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

-- | Outlines of rest material. If an outline is not known, a circle marks the position where the
-- cutter turns back.
restsOf :: Toolpath -> [[Segment]]
restsOf path = nubOrd (concatMap drawn (RestMaterial.ofPath path))
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

-- | Drilled holes of an operation.
holesOf :: Operation -> [Circle]
holesOf operation = case operation of
  Mill _ -> []
  Pocket _ -> []
  Drill (Located _ d) ->
    [Circle p (Part.drillRadius d) | Located _ p <- NonEmpty.toList (Part.holes d)]
  Travel _ -> []
  Command _ -> []

movesBetween :: Block -> [Move]
movesBetween block = case block of
  Travelling _ moves -> moves
  Cutting {approach, retract} -> approach <> retract
  Clearing {approach, cleared, retract} ->
    approach <> filter (not . isCut) (NonEmpty.toList cleared) <> retract
  Holing _ moves -> moves
  Commanding _ -> []

-- | Bounding boxes of everything that has to be on the page.
boxesOf :: [Part.Contour] -> Toolpath -> [BoundingBox]
boxesOf contours path =
  [Page.extent s | c <- contours, s <- NonEmpty.toList (Polyarc.segments (Part.polyarcOf c))]
    <> [Page.extent (Toolpath.segment m) | b <- Toolpath.blocks path, m <- Toolpath.moves b]
    <> concatMap cutterBox (Toolpath.blocks path)

cutterBox :: Block -> [BoundingBox]
cutterBox block = case block of
  Travelling _ _ -> []
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

-- | Converts a contour to paper. The map has the millings of the contours that begin at a point.
shapeOf :: Page -> Map Point [Milling] -> Part.Contour -> Shape
shapeOf sheet millings c =
  Shape
    { ends = Part.ends c,
      matter,
      outline = map (Page.segment sheet) (NonEmpty.toList (Polyarc.segments bare))
    }
  where
    bare = Part.polyarcOf c
    matter =
      case mapMaybe
        sideOf
        ( filter
            (\m -> Part.polyarcOf (contour m) == bare)
            (Map.findWithDefault [] (beginning c) millings)
        ) of
        side : _
          | Part.ends c == Closed ->
            if (side == Carrier.LeftOf) == (Polyarc.signedArea bare > 0) then Beyond else Within
        _ -> Unknown

holeOf :: Page -> Circle -> Shape
holeOf sheet circle@(Circle c r) =
  Shape {ends = Closed, matter = Beyond, outline = [Page.segment sheet whole]}
  where
    whole = Segment.fullCircle CounterClockwise circle (Vec.shift (Vec.polar r (Rad 0)) c)

-- | Side of the contour on which the cutter runs; nothing if it runs on the contour.
sideOf :: Milling -> Maybe Carrier.Side
sideOf milling = case Toolpath.leadingSide milling of
  Left _ -> Nothing
  Right side -> side

cutsOf :: Page -> Block -> [Cut]
cutsOf sheet block = case block of
  Travelling _ _ -> []
  Holing _ _ -> []
  Commanding _ -> []
  Cutting {job = Located _ milling, cut} ->
    [ (along milling cut)
        { away = awayFrom milling,
          upon = isNothing (sideOf milling),
          numbered = True
        }
    ]
  -- Moves in a pocket between two lifts are one cut.
  Clearing {pocket = Located _ p, cleared} ->
    zipWith
      (\entered ms -> (along (Part.wall p) ms) {entered})
      (True : repeat False)
      [ms | ms@(m :| _) <- NonEmpty.groupBy (\a b -> isCut a == isCut b) cleared, isCut m]
  where
    along milling ms =
      Cut
        { course =
            fmap
              (fmap (Page.segment sheet . Toolpath.segment))
              (NonEmpty.groupBy1 (\_ m -> Toolpath.continues m) ms),
          reach = Page.onPaper sheet (radius milling),
          away = 1,
          upon = False,
          numbered = False,
          entered = True
        }

-- | True of a move in a pocket that cuts.
isCut :: Move -> Bool
isCut m = Toolpath.pace m /= Rapid && uncurry (==) (Toolpath.heights m)

-- | Keeps the first of those passes of a pocket that differ in depth only.
drawnOnce :: [Block] -> [Block]
drawnOnce blocks = map snd (nubOrdOn key (zip [0 ..] blocks))
  where
    key :: (Int, Block) -> Either Int (Int, Mm)
    key (i, b) = case b of
      Clearing {pass} -> Right (Toolpath.number pass, Toolpath.left pass)
      _ -> Left i

-- | Side on which labels are placed. A cutter on the contour itself leaves neither side free;
-- labels are then outside.
awayFrom :: Milling -> Double
awayFrom milling = case (sideOf milling, Part.ends (contour milling)) of
  (Just Carrier.LeftOf, _) -> -1
  (Just Carrier.RightOf, _) -> 1
  (Nothing, Closed) -> signum (Polyarc.signedArea (Part.polyarcOf (contour milling)))
  (Nothing, Open) -> -1
