-- | What is to be drawn, laid on paper: contours, cuts and the ways between them.
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
import Draw.Sheet (Sheet)
import Draw.Sheet qualified as Sheet
import Geometry.Box (Box)
import Geometry.Box qualified as Box
import Geometry.Contour (Ends (..))
import Geometry.Contour qualified as Contour
import Geometry.Offset qualified as Offset
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Shape (Circle (Circle), Turn (..))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Milling (contour, radius), Operation (..), Pace (..), Part)
import Part.Part qualified as Part
import Path.FromPart qualified as Path
import Path.Path (Block (Clearing, Commanding, Cutting, Holing, Travelling, approach, cleared, cut, job, pass, pocket, retract), Move, Path)
import Path.Path qualified as Path
import Path.Remaining (Remaining (Remaining, beside, places))
import Path.Remaining qualified as Remaining
import Prelude hiding (lines)

-- | What is drawn, on paper.
data Scene = Scene
  { sheet :: Sheet,
    shapes :: [Shape],
    cuts :: [Cut],
    -- | what stays standing because the cutter does not get there
    rests :: [[Segment]],
    -- | straight moves without cutting
    feeds :: [Segment],
    rapids :: [Segment],
    start :: Point,
    -- | what all tools do, and the radii of the cutters or noses in mm of the part
    tools :: [(Part.Work, Mm)]
  }

-- | A contour of the part, or a hole in it.
data Shape = Shape {ends :: Ends, matter :: Matter, outline :: [Segment]}

-- | Where the material is.
data Matter
  = -- | within the contour
    Within
  | -- | around it
    Beyond
  | -- | the drawing does not say
    Unknown
  deriving stock (Eq)

-- | The way of the cutter's centre along a contour.
data Cut = Cut
  { -- | between nodes: one line or arc, or the arcs of one curve
    course :: NonEmpty (NonEmpty Segment),
    -- | the radius of the cutter
    reach :: Double,
    -- | the side of the walk that is away from the contour: +1 when it is its right
    away :: Double,
    -- | whether it runs on the contour itself
    upon :: Bool,
    -- | whether its nodes have numbers: not in a pocket
    numbered :: Bool,
    -- | whether the cutter is drawn where it begins: in a pocket where it goes down first
    entered :: Bool
  }

-- | All segments of a cut.
lines :: Cut -> NonEmpty Segment
lines = sconcat . course

-- | Lay a part and a path on a sheet that holds them.
set :: Part -> Path -> Scene
set part path =
  Scene
    { sheet,
      shapes = map (shapeOf sheet millingsAt) contours <> map (holeOf sheet) (nubOrd (concatMap holesOf (Part.operations part))),
      cuts = concatMap (cutsOf sheet) (drawnOnce (Path.blocks path)),
      rests = map (map (Sheet.segment sheet)) (restsOf path),
      feeds = along (\pace -> pace /= Rapid),
      rapids = along (== Rapid),
      start = Sheet.place sheet begin,
      tools = nubOrd [(Part.work m, radius m) | m <- millings]
    }
  where
    begin = Part.plane (value (Path.start path))
    millings = concatMap millingOf (Part.operations part)
    contours = distinct (Part.contours part <> map contour millings)
    millingsAt = Map.fromListWith (flip (<>)) [(beginning (contour m), [m]) | m <- millings]
    between = concatMap movesBetween (Path.blocks path)
    along wanted = map (Sheet.segment sheet) (nubOrd [Path.segment m | m <- between, wanted (Path.pace m)])
    sheet = Sheet.lay (foldl Box.union (Box.ofPoints begin []) (boxesOf contours path))

-- | Contours that are not earlier among themselves.
distinct :: [Part.Contour] -> [Part.Contour]
distinct = catMaybes . snd . List.mapAccumL next Map.empty
  where
    next known c
      | c `elem` Map.findWithDefault [] (beginning c) known = (known, Nothing)
      | otherwise = (Map.insertWith (<>) (beginning c) [c] known, Just c)

-- | Where a contour begins.
beginning :: Part.Contour -> Point
beginning = Segment.start . Part.segment . NonEmpty.head . Part.elements

millingOf :: Operation -> [Milling]
millingOf operation = case operation of
  Mill job -> [value job]
  Pocket (Located _ p) -> Part.wall p : [(Part.wall p) {contour = i, Part.side = Part.Outside <$ Part.side (Part.wall p)} | i <- Part.islands p]
  Drill _ -> []
  Travel _ -> []
  Command _ -> []

-- | What stays beside contours: its outline, or where that is not known a circle where the cutter turns back.
restsOf :: Path -> [[Segment]]
restsOf path = nubOrd (concatMap drawn (Remaining.ofPath path))
  where
    drawn Remaining {beside, places} = concatMap (\(_, f) -> material beside f) (NonEmpty.toList places)
    material beside f = case Offset.standing f of
      Offset.Within outline -> [NonEmpty.toList outline]
      Offset.SameAs _ -> []
      Offset.Unbounded -> [spot (Offset.middle f) beside]
    spot p (Mm r) = [Segment.fullCircle CounterClockwise (Circle p (Mm (r / 4))) (Vec.shift (Vec.vec (r / 4) 0) p)]

-- | The holes that are drilled.
holesOf :: Operation -> [Circle]
holesOf operation = case operation of
  Mill _ -> []
  Pocket _ -> []
  Drill (Located _ d) -> [Circle p (Part.drillRadius d) | Located _ p <- NonEmpty.toList (Part.holes d)]
  Travel _ -> []
  Command _ -> []

movesBetween :: Block -> [Move]
movesBetween block = case block of
  Travelling _ moves -> moves
  Cutting {approach, retract} -> approach <> retract
  Clearing {approach, cleared, retract} -> approach <> filter (not . isCut) (NonEmpty.toList cleared) <> retract
  Holing _ moves -> moves
  Commanding _ -> []

-- | What has to be on the page.
boxesOf :: [Part.Contour] -> Path -> [Box]
boxesOf contours path =
  [Sheet.extent s | c <- contours, s <- NonEmpty.toList (Contour.segments (Part.outline c))]
    <> [Sheet.extent (Path.segment m) | b <- Path.blocks path, m <- Path.moves b]
    <> concatMap cutterBox (Path.blocks path)

cutterBox :: Block -> [Box]
cutterBox block = case block of
  Travelling _ _ -> []
  Holing (Located _ d) _ -> [Box.inflate (Part.drillRadius d) (Box.ofPoints p []) | Located _ p <- NonEmpty.toList (Part.holes d)]
  Commanding _ -> []
  Cutting {job = Located _ milling, cut} -> [cutterAt milling cut]
  Clearing {pocket = Located _ p, cleared} -> [cutterAt (Part.wall p) cleared]
  where
    cutterAt milling ms = Box.inflate (radius milling) (Box.ofPoints (Segment.start (Path.segment (NonEmpty.head ms))) [])

-- | With the millings of the contours that begin there.
shapeOf :: Sheet -> Map Point [Milling] -> Part.Contour -> Shape
shapeOf sheet millings c = Shape {ends = Part.ends c, matter, outline = map (Sheet.segment sheet) (NonEmpty.toList (Contour.segments bare))}
  where
    bare = Part.outline c
    matter = case mapMaybe sideOf (filter (\m -> Part.outline (contour m) == bare) (Map.findWithDefault [] (beginning c) millings)) of
      side : _ | Part.ends c == Closed -> if (side == Offset.LeftOf) == (Contour.signedArea bare > 0) then Beyond else Within
      _ -> Unknown

holeOf :: Sheet -> Circle -> Shape
holeOf sheet circle@(Circle c r) = Shape {ends = Closed, matter = Beyond, outline = [Sheet.segment sheet whole]}
  where
    whole = Segment.fullCircle CounterClockwise circle (Vec.shift (Vec.polar r (Rad 0)) c)

-- | The side of the walk on which the cutter stands, if it stands on one.
sideOf :: Milling -> Maybe Offset.Side
sideOf milling = case Path.leadingSide milling of
  Left _ -> Nothing
  Right side -> side

cutsOf :: Sheet -> Block -> [Cut]
cutsOf sheet block = case block of
  Travelling _ _ -> []
  Holing _ _ -> []
  Commanding _ -> []
  Cutting {job = Located _ milling, cut} -> [(along milling cut) {away = awayFrom milling, upon = isNothing (sideOf milling), numbered = True}]
  -- What is cut without being lifted is one cut.
  Clearing {pocket = Located _ p, cleared} -> zipWith (\entered ms -> (along (Part.wall p) ms) {entered}) (True : repeat False) [ms | ms@(m :| _) <- NonEmpty.groupBy (\a b -> isCut a == isCut b) cleared, isCut m]
  where
    along milling ms =
      Cut
        { course = fmap (fmap (Sheet.segment sheet . Path.segment)) (NonEmpty.groupBy1 (\_ m -> Path.continues m) ms),
          reach = Sheet.onPaper sheet (radius milling),
          away = 1,
          upon = False,
          numbered = False,
          entered = True
        }

-- | Whether a move in a pocket cuts.
isCut :: Move -> Bool
isCut m = Path.pace m /= Rapid && uncurry (==) (Path.heights m)

-- | Passes of a pocket that differ in their depth alone, once.
drawnOnce :: [Block] -> [Block]
drawnOnce blocks = map snd (nubOrdOn key (zip [0 ..] blocks))
  where
    key :: (Int, Block) -> Either Int (Int, Mm)
    key (i, b) = case b of
      Clearing {pass} -> Right (Path.number pass, Path.left pass)
      _ -> Left i

-- | A cutter on the contour itself leaves no side free; the labels then stand outside.
awayFrom :: Milling -> Double
awayFrom milling = case (sideOf milling, Part.ends (contour milling)) of
  (Just Offset.LeftOf, _) -> -1
  (Just Offset.RightOf, _) -> 1
  (Nothing, Closed) -> signum (Contour.signedArea (Part.outline (contour milling)))
  (Nothing, Open) -> -1
