-- | The objects of a drawing, from the part and its toolpath, in mm of the part.
module Draw.FromPart
  ( scene,
    extent,
    sidedContours,
    restMaterialOf,
    isLastPass,
    isCut,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), Rad (..), times, total)
import Base.Region (Located (..))
import Data.Containers.ListUtils (nubOrd, nubOrdOn)
import Data.Function (on)
import Data.List qualified as List
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (catMaybes, isJust, isNothing, mapMaybe)
import Data.Text (Text)
import Draw.Descent qualified as Descent
import Draw.DimensionLine qualified as DimensionLine
import Draw.Page qualified as Page
import Draw.Scene (Cut (..), MaterialSide (..), Rest (..), Scene (..), Shape (..))
import Draw.StockPlot qualified as StockPlot
import Draw.ToolUse qualified as ToolUse
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
import Part.CutFeed (CutFeed)
import Part.CutFeed qualified as CutFeed
import Part.Part (Milling (contour, radius), Operation (..), Pace (..), Part)
import Part.Part qualified as Part
import Toolpath.Error (RestPosition (..), Tool)
import Toolpath.Error qualified as Error
import Toolpath.FromPart qualified as Toolpath
import Toolpath.RestMaterial (Remaining (Remaining, offsetDistance, positions))
import Toolpath.RestMaterial qualified as RestMaterial
import Toolpath.Toolpath
  ( Block
      ( Carved,
        Clearing,
        Commanding,
        Cutting,
        Holing,
        Travelling,
        approach,
        cleared,
        cut,
        descent,
        job,
        pass,
        pocket,
        retract
      ),
    Move,
    Toolpath,
  )
import Toolpath.Toolpath qualified as Toolpath

-- | Converts a part and its toolpath to the objects of a drawing.
scene :: Part -> Toolpath -> Scene
scene part path =
  Scene
    { shapes =
        map (shapeOf millingsAt) (drawnContours part) <> map holeOf circles,
      holes = [(p, r) | Circle p (Mm r) <- circles],
      cuts =
        map withHolder $
          concatMap (cutsOf (isLastPass path)) (drawnOnce (ToolUse.blocksWithTools path)),
      leads = leadsOf path,
      restMaterial = restMaterialOf path,
      feeds = along (\pace -> pace /= Rapid),
      rapids = along (== Rapid),
      descents =
        Descent.deepest (concatMap (Descent.ofMoves . downwards) (Toolpath.blocks path)),
      tabs = tabsOf path,
      dimensions =
        nubOrd
          (map (DimensionLine.ofSize (Part.unit part)) (filter isDrawn (Part.assertedSizes part))),
      start = Part.plane (value (Toolpath.start path)),
      spindleAxis = if Toolpath.isTurned path then Just (Vec.point 0 0) else Nothing,
      tools,
      stock = StockPlot.stockPlot path
    }
  where
    tools = ToolUse.uses path
    withHolder cut =
      cut
        { holderRadius =
            maximum
              (0 : [r | Just k <- [tool cut], t <- take 1 (drop k tools), Mm r <- holderRadii t])
        }
    holderRadii t = map Part.holderRadius (Part.holder (Part.body (ToolUse.cutter t)))
    isDrawn = sizeIsDrawn (drawnContours part) circles
    millingsAt = millingsByStart part
    circles = nubOrd (concatMap holesOf (Part.operations part))
    between = concatMap movesBetween (Toolpath.blocks path)
    along wanted = nubOrd [Toolpath.segment m | m <- between, wanted (Toolpath.pace m)]

-- | Contours that are drawn, each with the side on which its material lies, and the lowest height
-- at which it is milled.
sidedContours :: Part -> [(Part.Contour, MaterialSide, Mm)]
sidedContours part =
  [(c, materialSideOf millings c, depthOf (millingsOf millings c)) | c <- drawnContours part]
  where
    millings = millingsByStart part
    depthOf of' = minimum (Mm 0 : concatMap heightsOf of')
    heightsOf m = Part.levels m <> mapMaybe Part.level (Part.approach m)

-- | Millings of a contour, among those that the result of 'millingsByStart' has.
millingsOf :: Map Point [Milling] -> Part.Contour -> [Milling]
millingsOf millings c =
  filter
    (\m -> Part.polyarcOf (contour m) == Part.polyarcOf c)
    (Map.findWithDefault [] (beginning c) millings)

-- | Millings of a part, in order, by the first points of their contours.
millingsByStart :: Part -> Map Point [Milling]
millingsByStart part =
  Map.fromListWith
    (<>)
    [(beginning (contour m), [m]) | m <- reverse (concatMap millingOf (Part.operations part))]

-- | True if a size is that of something drawn. A circle is drawn if it is a hole, or if a contour
-- has an arc of it. Distances have lines that lead to their points.
sizeIsDrawn :: [Part.Contour] -> [Circle] -> Part.AssertedSize -> Bool
sizeIsDrawn contours circles size = case size of
  Part.AssertedDistance p q _ -> not (Vec.isNear p q)
  Part.AssertedRadius (Circle c (Mm r)) _ ->
    any (isSame c r) (circles <> concatMap arcsOf contours)
  where
    isSame c r (Circle d (Mm s)) = Vec.isNear c d && abs (r - s) < 1e-6
    arcsOf contour' =
      [ Circle centre (Segment.radius centre start)
        | Segment.Arc {Segment.centre, Segment.start} <-
            map Part.segment (NonEmpty.toList (Part.elements contour'))
      ]

-- | Bounding box, in mm of the part, of all that has to be on the page.
extent :: Part -> Toolpath -> BoundingBox
extent part path =
  foldl
    BoundingBox.union
    (BoundingBox.ofPoints (Part.plane (value (Toolpath.start path))) [])
    (boxesOf contours path <> StockPlot.boxes (StockPlot.stockPlot path) <> mirrored)
  where
    contours = drawnContours part
    mirrored = if Toolpath.isTurned path then map mirrorImage (contourBoxes contours) else []
    mirrorImage b =
      b {BoundingBox.bottom = -(BoundingBox.top b), BoundingBox.top = -(BoundingBox.bottom b)}

-- | Contours that are drawn: those that are milled, where they are milled, and those that nothing
-- mills. A contour of which only images are milled is drawn as these images. An image has the name
-- and the length of its contour.
drawnContours :: Part -> [Part.Contour]
drawnContours part = distinct (filter isShown (Part.contours part) <> milled)
  where
    milled =
      concat [map contour (millingOf o) <> carvedContours o | o <- Part.operations part]
    images =
      Map.fromListWith (<>) [(definedAt c, [(c, lengthOf c)]) | c <- distinct milled]
    isShown c =
      let ofName = Map.findWithDefault [] (definedAt c) images
       in any (((==) `on` Part.elements) c . fst) ofName || not (any (isImage c . snd) ofName)
    definedAt c = let Located region _ = Part.contourName c in region
    isImage c (Mm l) = let Mm own = lengthOf c in abs (l - own) <= 1e-6 * (1 + own)
    lengthOf c = total (map (Segment.length . Part.segment) (NonEmpty.toList (Part.elements c)))

-- | Drops contours whose elements are equal to those of earlier ones in the list.
distinct :: [Part.Contour] -> [Part.Contour]
distinct = catMaybes . snd . List.mapAccumL next Map.empty
  where
    next known c
      | Part.elements c `elem` Map.findWithDefault [] (beginning c) known = (known, Nothing)
      | otherwise = (Map.insertWith (<>) (beginning c) [Part.elements c] known, Just c)

-- | First point of a contour.
beginning :: Part.Contour -> Point
beginning = Segment.start . Part.segment . NonEmpty.head . Part.elements

-- | Contours that an operation mills, each with its side and its cutter. For a pocket they are its
-- wall and its islands.
millingOf :: Operation -> [Milling]
millingOf operation = case operation of
  Mill job -> [value job]
  Pocket (Located _ p) ->
    let wall = Part.wall p
        along side' c = wall {contour = c, Part.side = side' <$ Part.side wall}
        (inside, beside)
          -- The cutter runs over the contours of a surface.
          | isJust (Part.surface p) = (Part.On, Part.On)
          | otherwise = (Part.Inside, Part.Outside)
     in along inside (contour wall) : map (along beside) (Part.islands p)
  Drill _ -> []
  Carve _ -> []
  Travel _ -> []
  Command _ -> []

-- | Contours between which an operation carves.
carvedContours :: Operation -> [Part.Contour]
carvedContours operation = case operation of
  Carve (Located _ c) ->
    concat [outer : inner | (outer, inner) <- NonEmpty.toList (Part.carvedAreas c)]
  _ -> []

-- | Rest material of all statements. If the boundary of some rest material was not found, a circle
-- is drawn instead. Its centre is the point at which the cutter's centre has to stop before this
-- material. Its radius is a quarter of the distance between the cutter's centre and the contour in
-- the last pass.
restMaterialOf :: Toolpath -> [Rest]
restMaterialOf path = nubOrdOn around (concatMap drawn (RestMaterial.ofPath path))
  where
    drawn remaining@Remaining {offsetDistance, positions} =
      concatMap (material (RestMaterial.tool remaining) offsetDistance) (NonEmpty.toList positions)
    material tool offsetDistance (stay, f) =
      [ Rest
          { around = outline,
            centre = Equidistant.cutterCentre f,
            reason = reasonOf (Toolpath.unit path) tool stay
          }
        | outline <- case Equidistant.restMaterial f of
            Equidistant.Within outline -> [NonEmpty.toList outline]
            Equidistant.SameAs _ -> []
            Equidistant.Unbounded -> [spot (Equidistant.cutterCentre f) offsetDistance]
      ]
    spot p (Mm r) =
      [ Segment.fullCircle
          CounterClockwise
          (Circle p (Mm (r / 4)))
          (Vec.shift (Vec.vec (r / 4) 0) p)
      ]

-- | Reason why a tool leaves material at a position, in a few words.
reasonOf :: LengthUnit -> Tool -> RestPosition -> Text
reasonOf unit tool stay = case stay of
  InCorner {} -> "inner corner, cutter " <> r (Error.radius tool)
  AtBreak {} -> "break, cutter " <> r (Error.radius tool)
  InConcaveArc _ arc _ -> r (Error.radius tool) <> " does not reach " <> r arc
  Between {} -> "too narrow for " <> r (Error.radius tool)
  where
    r size = "r " <> Decimal.shortIn unit 2 size

-- | Drilled holes of an operation, as circles on the part.
holesOf :: Operation -> [Circle]
holesOf operation = case operation of
  Mill _ -> []
  Pocket _ -> []
  Carve _ -> []
  Drill (Located _ d) ->
    [Circle p r | Part.Hole (Located _ p) _ r <- NonEmpty.toList (Part.holes d)]
  Travel _ -> []
  Command _ -> []

-- | Linking moves of a block of the toolpath.
movesBetween :: Block -> [Move]
movesBetween block = case block of
  Travelling _ _ moves -> moves
  Cutting {approach, descent, retract} -> approach <> descent <> retract
  Clearing {approach, cleared, retract} ->
    approach <> filter (not . isCut) (NonEmpty.toList cleared) <> retract
  Holing _ moves -> moves
  Carved _ moves _ -> filter (not . isCarving) (NonEmpty.toList moves)
  Commanding _ -> []

-- | Moves at feed that are no cuts, but whose lower end is not above the highest pass.
leadsOf :: Toolpath -> [(Double, Segment)]
leadsOf path =
  nubOrd
    [ (r, s)
      | (Mm r, _, ms) <- worked,
        m <- ms,
        Toolpath.pace m /= Rapid,
        uncurry min (Toolpath.heights m) <= highest,
        let s = Toolpath.segment m,
        Segment.length s > Mm 0
    ]
  where
    worked = mapMaybe work (Toolpath.blocks path)
    highest = maximum (Mm (-1 / 0) : [z | (_, z, _) <- worked])
    work block = case block of
      Cutting {job = Located _ milling, pass} -> found milling pass block
      Clearing {pocket = Located _ p, pass} -> found (Part.wall p) pass block
      Travelling {} -> Nothing
      Holing _ _ -> Nothing
      Carved {} -> Nothing
      Commanding _ -> Nothing
    found milling pass block =
      Just (radius milling, Toolpath.atHeight pass, movesBetween block)

-- | Middles of the tabs, and the heights of their tops, each once.
tabsOf :: Toolpath -> [(Point, Mm)]
tabsOf path =
  nubOrdOn
    (\(p, _) -> (Vec.x p, Vec.y p))
    [ (p, Part.tabTop asked)
      | Toolpath.Cutting {Toolpath.job = Located _ milling, Toolpath.tabs = places} <-
          Toolpath.blocks path,
        Just (Located _ asked) <- [Part.tabs milling],
        p <- places
    ]

-- | Linking moves of a block among which there may be descents. A drill makes none, and the axis of
-- a blade swivels it.
downwards :: Block -> [Move]
downwards block = case block of
  Holing _ _ -> []
  Cutting {job = Located _ milling} | isJust (Part.gear milling) -> []
  _ -> movesBetween block

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

-- | Bounding boxes, on the part, of the areas over which cutters sweep, and of the drilled holes of
-- a block.
cutterBox :: Block -> [BoundingBox]
cutterBox block = case block of
  Travelling {} -> []
  Holing (Located _ d) _ ->
    [ BoundingBox.inflate r (BoundingBox.ofPoints p [])
      | Part.Hole (Located _ p) _ r <- NonEmpty.toList (Part.holes d)
    ]
  Carved {} -> []
  Commanding _ -> []
  Cutting {job = Located _ milling, cut} -> sweptBy milling (NonEmpty.toList cut)
  Clearing {pocket = Located _ p, cleared} -> sweptBy (Part.wall p) (NonEmpty.toList cleared)
  where
    sweptBy milling ms =
      [BoundingBox.inflate (radius milling) (Page.extent (Toolpath.segment m)) | m <- ms]

-- | Shape of a contour. The first argument is the result of 'millingsByStart'.
shapeOf :: Map Point [Milling] -> Part.Contour -> Shape
shapeOf millings c =
  Shape
    { ends = Part.ends c,
      materialSide = materialSideOf millings c,
      outline = NonEmpty.toList (Polyarc.segments (Part.polyarcOf c))
    }

-- | Side of a contour on which its material lies: the one opposite to the cutter. The cutter's side
-- is that of the first milling of this contour in which the cutter runs beside it. The first
-- argument is the result of 'millingsByStart'.
materialSideOf :: Map Point [Milling] -> Part.Contour -> MaterialSide
materialSideOf millings c =
  case mapMaybe sideOf (millingsOf millings c) of
    side : _
      | Part.ends c == Closed ->
        if (side == Carrier.LeftOf) == (Polyarc.signedArea bare > 0) then Outside else Inside
    _ -> Unknown
  where
    bare = Part.polyarcOf c

-- | Shape of a drilled hole.
holeOf :: Circle -> Shape
holeOf circle@(Circle c r) =
  Shape {ends = Closed, materialSide = Outside, outline = [whole]}
  where
    whole = Segment.fullCircle CounterClockwise circle (Vec.shift (Vec.polar r (Rad 0)) c)

-- | Side of the contour on which the cutter runs; Nothing if the cutter's centre runs on the
-- contour.
sideOf :: Milling -> Maybe Carrier.Side
sideOf milling = case Toolpath.leadingSide milling of
  Left _ -> Nothing
  Right side -> side

-- | Cuts of a block of the toolpath, with the position of its tool.
cutsOf :: (Toolpath.Pass -> Bool) -> (Maybe Int, Block) -> [Cut]
cutsOf isLast (tool, block) = case block of
  Travelling {} -> []
  Holing _ _ -> []
  Commanding _ -> []
  Carved (Located _ c) moves _ ->
    [ (cutAlong tool (Part.carvingTip c) (times (-1) (Part.carvingDepth c)) ms)
        { isOnContour = True,
          showsCutter = False
        }
      | ms@(m :| _) <- NonEmpty.groupBy ((==) `on` isCarving) moves,
        isCarving m
    ]
  Cutting {job = Located _ milling, pass, cut} ->
    [ (along milling pass cut)
        { away = awayFrom milling,
          isOnContour = isNothing (sideOf milling),
          numbered = isLast pass
        }
    ]
  -- The moves from one plunge to the next lift in a pocket are one cut.
  Clearing {pocket = Located _ p, pass, cleared} ->
    zipWith
      (\showsCutter ms -> (along (Part.wall p) pass ms) {showsCutter})
      (True : repeat False)
      [ms | ms@(m :| _) <- NonEmpty.groupBy (\a b -> isCut a == isCut b) cleared, isCut m]
  where
    along milling pass = cutAlong tool (radius milling) (Toolpath.atHeight pass)

-- | Cut along moves with a tool, by the position of the tool and its radius. The first height is
-- that of the pass.
cutAlong :: Maybe Int -> Mm -> Mm -> NonEmpty Move -> Cut
cutAlong tool (Mm cutterRadius) height ms =
  Cut
    { sections =
        fmap (fmap Toolpath.segment) (NonEmpty.groupBy1 (\_ m -> Toolpath.continues m) ms),
      feedRuns =
        [ (f, map Toolpath.segment (NonEmpty.toList run))
          | run <- NonEmpty.groupBy ((==) `on` feedOf) (NonEmpty.toList ms),
            Just f <- [feedOf (NonEmpty.head run)]
        ],
      height,
      tool,
      cutterRadius,
      holderRadius = 0,
      away = 1,
      isOnContour = False,
      numbered = False,
      showsCutter = True
    }

-- | Feed of a move as the program gives it; Nothing for a rapid move.
feedOf :: Move -> Maybe CutFeed
feedOf m = case Toolpath.pace m of
  Rapid -> Nothing
  At (Located _ f) -> Just (CutFeed.atRate CutFeed.NoRate f)

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

-- | True if a move of a V-carving cuts: it is at feed and does not go straight down or up.
isCarving :: Move -> Bool
isCarving m = Toolpath.pace m /= Rapid && Segment.length (Toolpath.segment m) > Mm 0

-- | Drops blocks that would be drawn over others. If passes differ only in their depth, the last of
-- them remains, which is the deepest.
drawnOnce :: [(Maybe Int, Block)] -> [(Maybe Int, Block)]
drawnOnce = reverse . map snd . nubOrdOn key . zip [0 ..] . reverse
  where
    key :: (Int, (Maybe Int, Block)) -> Either Int (Int, Mm, Segment)
    key (i, (_, b)) = case b of
      Clearing {pass, cleared} -> passKey pass cleared
      Cutting {pass, cut} -> passKey pass cut
      _ -> Left i
    passKey pass (first :| _) =
      Right (Toolpath.number pass, Toolpath.left pass, Toolpath.segment first)

-- | Value of 'away' for the cuts of a milling: +1 to place labels on the right of the path, -1 on
-- its left. If the cutter's centre is on the contour, labels are outside of a closed contour and on
-- the left of an open one.
awayFrom :: Milling -> Double
awayFrom milling = case (sideOf milling, Part.ends (contour milling)) of
  (Just Carrier.LeftOf, _) -> -1
  (Just Carrier.RightOf, _) -> 1
  (Nothing, Closed) -> signum (Polyarc.signedArea (Part.polyarcOf (contour milling)))
  (Nothing, Open) -> -1
