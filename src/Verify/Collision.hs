-- | Contacts of a tool with what it must not touch: solids that the program avoids, and stock.
--
-- - No part of a tool may enter an avoided solid.
-- - A rapid move may not bring the cutter into stock. Without a @stock@ statement, only the holes
--   and the pockets of the program are known to be in metal.
-- - The shank above the flutes, and the holder, may not touch stock. The finished part is within
--   the stock that is left. Without a @stock@ statement, all is stock below the top of the part.
--
-- A tool is a pile of cylinders about its axis. Each of them counts as if it had no upper end.
-- Contacts within the tolerance and one pulse do not count. The comparison is exact over whole
-- motions in the plane. A motion whose height changes counts by its lowest height.
module Verify.Collision
  ( collisions,
    inProgram,
  )
where

import Base.Quantity (Mm (..), minus, over, plus, times)
import Base.Region (Located (..), Region)
import Data.IntMap.Strict (IntMap)
import Data.IntMap.Strict qualified as IntMap
import Data.IntSet (IntSet)
import Data.IntSet qualified as IntSet
import Data.List (foldl', sortOn)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (catMaybes, fromMaybe, isJust, listToMaybe, mapMaybe)
import Data.Set qualified as Set
import Frame.Frame (Frame, FrameProgram, PlannedFrame)
import Frame.Frame qualified as Frame
import Geometry.Carrier (Circle (Circle), Sense (CounterClockwise))
import Geometry.Distance.Fast qualified as FastDistance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Axis (Z), Machine)
import Machine.Machine qualified as Machine
import Machine.ProgramForm (RapidPath (BoxPath))
import Machine.ProgramForm qualified as ProgramForm
import Part.AvoidedSolid (AvoidedSolid)
import Part.AvoidedSolid qualified as AvoidedSolid
import Part.CutterBody qualified as CutterBody
import Part.Part (Cutter (..), ToolBody (..))
import Part.Part qualified as Part
import Toolpath.Toolpath (Block, Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.CollisionFinding
  ( Collision (..),
    Contact (..),
    ContactPlace (..),
    HoleKind (..),
    LowTravel (..),
    SolidContact (..),
    ToolPart (..),
  )
import Verify.CoreHole (CoreHoleFault (..))
import Verify.CoreHole qualified as CoreHole
import Verify.ForeignCut qualified as ForeignCut
import Verify.Motion (CutterMotion (..))
import Verify.Motion qualified as Motion
import Verify.Proof (Finding (Collides))
import Verify.ProofSubject (ProofSubject (..))
import Verify.ProofSubject qualified as Subject
import Verify.RemainingStock
  ( Base (Everywhere),
    Probe (Probe),
    Removal (Removal),
    StockSolid (StockSolid),
  )
import Verify.RemainingStock qualified as Stock
import Verify.SpindleCutter qualified as SpindleCutter

-- | Facts that all comparisons need.
data Facts = Facts
  { subject :: ProofSubject,
    -- | radius of the cutter in a motion
    radiusOf :: CutterMotion -> Mm,
    -- | tools that may be in the spindle in a frame, each with its index
    toolsIn :: Int -> [(Int, Cutter)],
    rapidFrames :: IntSet,
    -- | distance of the points from a motion's line through which the control may lead a rapid move
    -- whose axes arrive one after the other; 0 for other motions
    strays :: CutterMotion -> Mm,
    -- | depth of a contact, in the plane, that does not count
    allowed :: Mm,
    -- | the same along z
    allowedHeight :: Mm,
    -- | blocks of the toolpath by their numbers, and by the numbers of their passes
    blockAt :: ~(IntMap Block),
    passBlockAt :: ~(IntMap Block)
  }

-- | Cylinder of a tool: the part of the tool, its radius, and the height of its lower end above the
-- tip.
data Cylinder = Cylinder ToolPart Mm Mm

-- | Findings for the first contacts of a tape: one for each pair of an avoided solid and a
-- statement, one for a rapid move into stock, one for the shank or the holder in stock.
collisions :: ProofSubject -> (CutterMotion -> Mm) -> [Finding]
collisions subject radiusOf =
  map
    Collides
    ( concatMap (intoAvoided facts) (Toolpath.avoided (Toolpath.setup (path subject)))
        <> take 1 (rapidsIntoStock facts (metal (path subject)))
        <> take 1 (bodiesInStock facts)
        <> coreHolesIn facts
    )
  where
    facts =
      Facts
        { subject,
          radiusOf,
          toolsIn = SpindleCutter.cuttersOf subject,
          rapidFrames,
          strays = \m ->
            if hasBoxPaths && IntSet.member (number m) rapidFrames
              then halfWidth (segment m)
              else Mm 0,
          allowed =
            plus
              (ForeignCut.largestTolerance (path subject))
              (Machine.planeResolution (machine subject)),
          allowedHeight = Machine.resolutionOf (machine subject) Z,
          blockAt = IntMap.fromList (zip [0 ..] blocks'),
          passBlockAt =
            IntMap.fromList
              [(n, b) | (n, k, b) <- zip3 counts (drop 1 counts) blocks', k > n]
        }
    blocks' = Toolpath.blocks (path subject)
    counts = Toolpath.passNumbers blocks'
    rapidFrames = rapidsOf subject
    hasBoxPaths =
      fmap ProgramForm.rapidPath (Machine.programForm (machine subject)) == Just BoxPath

-- | Distance of the corners of a line's box from the line. All of the box is so near to the line.
halfWidth :: Segment -> Mm
halfWidth s = if l > 0 then Mm (abs (dx * dy) / l) else Mm 0
  where
    (a, b) = (Segment.start s, Segment.end s)
    (dx, dy) = (Vec.x b - Vec.x a, Vec.y b - Vec.y a)
    Mm l = Vec.distance a b

-- | Findings for the planned frames of a program that gives stock, solids to avoid, or bodies of
-- tools. They need no tape, so an editor can show them. Empty for any other program.
inProgram :: Machine -> Toolpath -> FrameProgram -> [Finding]
inProgram machine path program
  | isAsked = collisions subject (Subject.toolIn subject [])
  | otherwise = []
  where
    subject = Subject.subjectOf machine path program (map Frame.frame (Frame.plannedFrames program))
    setup = Toolpath.setup path
    isAsked =
      isJust (Toolpath.stock setup)
        || not (null (Toolpath.avoided setup))
        || any ((/= Part.plainBody) . body) (catMaybes (SpindleCutter.cutters path))

-- Tools -------------------------------------------------------------------------------------------

-- | Parts of the holder of a tool.
holderParts :: Cutter -> [Cylinder]
holderParts c =
  [Cylinder HolderPart r z | CutterBody.Cylinder r z <- drop 1 (CutterBody.cylindersOf c)]

-- | Numbers of the frames that are rapid moves. A machine without a code for them has a feed code
-- instead, which is no sign of a rapid move if the program cuts with it.
rapidsOf :: ProofSubject -> IntSet
rapidsOf ProofSubject {machine, program, frames} =
  IntSet.fromList [n | (n, f) <- zip [1 ..] frames, isRapid machine cutsAtRapid f]
  where
    cutsAtRapid =
      or
        [ Frame.feedCode (Frame.frame p) == Machine.rapidCode machine
          | p <- Frame.plannedFrames program,
            Frame.Cutting _ <- [Frame.role p]
        ]

-- | Test that a frame is a rapid move.
isRapid :: Machine -> Bool -> Frame -> Bool
isRapid machine cutsAtRapid f
  | Machine.hasRapidMotion machine = Frame.motion f == Frame.Rapid
  | otherwise =
    Frame.isMoving f && Frame.feedCode f == Machine.rapidCode machine && not cutsAtRapid

-- Avoided solids ----------------------------------------------------------------------------------

-- | Motion that brings a part of the tool into an avoided solid.
data Touch = Touch
  { touchMotion :: CutterMotion,
    cylinder :: Cylinder,
    -- | lowest height of the tip in the solid
    lowestTip :: Mm,
    -- | how deep the part enters the solid
    entered :: Mm,
    -- | radius of the part with its strays
    reached :: Mm,
    -- | place of the tool's axis
    axis :: Point
  }

-- | Contacts of the tools with an avoided solid, in the order of the tape: the one where the
-- program begins, and the first one of each statement.
intoAvoided :: Facts -> Located Part.Solid -> [Collision]
intoAvoided facts@Facts {subject} located@(Located _ solid) =
  map atStart begun
    <> firstOfEach
      [ (statementOf facts =<< planned, solidCollision facts located planned touch)
        | (planned, touch) <- plannedWith subject later
      ]
  where
    ready = AvoidedSolid.prepared solid
    touches = touchesOf facts ready (BoxTree.within near (motionIndex subject))
    near = BoundingBox.inflate (widestIn facts) (AvoidedSolid.boundingBox ready)
    (begun, later) = case unlevelledMotions subject of
      m : _ | t : _ <- touchesOf facts ready [standing m] -> ([t], entering (Just m) touches)
      _ -> ([], entering Nothing touches)
    standing m =
      let p = Segment.start (segment m) in m {segment = Straight p p, toHeight = fromHeight m}
    atStart t =
      (solidCollision facts located Nothing t)
        { asked = Just (region (Toolpath.start (path subject))),
          contact = AvoidedSolid (solidContact located t AtStart)
        }

-- | Contacts without those of motions that only leave the solid, because the contact before ended
-- at their start. If the program begins in the solid, @first@ is its first motion.
entering :: Maybe CutterMotion -> [Touch] -> [Touch]
entering first touches = concat (zipWith arriving (begin : map end groups) groups)
  where
    groups = NonEmpty.groupBy (\a b -> Motion.isSame (touchMotion a) (touchMotion b)) touches
    arriving before group
      | before == Just (startOf (touchMotion (NonEmpty.head group))) = []
      | otherwise = NonEmpty.toList group
    begin = startOf <$> first
    end = Just . Motion.endPosition . touchMotion . NonEmpty.head
    startOf m = (Segment.start (segment m), fromHeight m)

-- | First of the collisions for each statement.
firstOfEach :: [(Maybe Region, Collision)] -> [Collision]
firstOfEach = go Set.empty
  where
    go seen cs = case cs of
      [] -> []
      (key, c) : more
        | Set.member key seen -> go seen more
        | otherwise -> c : go (Set.insert key seen) more

-- | Contacts of motions with an avoided solid.
touchesOf :: Facts -> AvoidedSolid -> [CutterMotion] -> [Touch]
touchesOf facts@Facts {strays, allowed, allowedHeight} ready motions' =
  [ Touch {touchMotion, cylinder, lowestTip, entered, reached, axis}
    | touchMotion <- motions',
      cylinder@(Cylinder _ r above) <- cylindersIn facts touchMotion,
      let reached = plus r (strays touchMotion),
      Just (lowestTip, part) <-
        [lowPart (minus (minus (AvoidedSolid.top ready) above) allowedHeight) touchMotion],
      let entered = AvoidedSolid.depthOf ready reached part,
      entered > allowed,
      Just axis <- [AvoidedSolid.deepestPoint ready reached part]
  ]

-- | Cylinders of the tools in a motion.
cylindersIn :: Facts -> CutterMotion -> [Cylinder]
cylindersIn Facts {radiusOf, toolsIn} m =
  Cylinder CutterPart (radiusOf m) (Mm 0) :
    [ Cylinder (if above == Mm 0 then CutterPart else HolderPart) r above
      | (_, c) <- toolsIn (number m),
        CutterBody.Cylinder r above <- CutterBody.cylindersOf c
    ]

-- | Largest distance from its path that a part of a tool reaches in a motion of the tape.
widestIn :: Facts -> Mm
widestIn facts@Facts {subject, strays} =
  foldl'
    max
    (Mm 0)
    [ plus r (strays m)
      | m <- unlevelledMotions subject,
        Cylinder _ r _ <- cylindersIn facts m
    ]

-- | Planned frame of each contact, in the order of the tape. Nothing if the tape has other frames
-- than planned.
plannedWith :: ProofSubject -> [Touch] -> [(Maybe PlannedFrame, Touch)]
plannedWith subject
  | Subject.isAligned subject = go 1 (Frame.plannedFrames (program subject))
  | otherwise = map (Nothing,)
  where
    go n fs touches = case touches of
      [] -> []
      t : more ->
        let m = number (touchMotion t)
            fs' = drop (m - n) fs
         in (listToMaybe fs', t) : go m fs' more

-- | Collision of a contact with an avoided solid.
solidCollision :: Facts -> Located Part.Solid -> Maybe PlannedFrame -> Touch -> Collision
solidCollision facts located@(Located _ solid) planned touch =
  (collisionOf facts m (cylinder touch) (lowestTip touch) (Part.highest solid) touched)
    { asked = Frame.origin <$> planned
    }
  where
    m = touchMotion touch
    r = reached touch
    touched = AvoidedSolid (solidContact located touch place)
    place = fromMaybe OnTheWay $ do
      Toolpath.Holing (Located _ drilling) _ <- blockOf facts =<< planned
      listToMaybe (holesAt drilling)
    end = Segment.end (segment m)
    depthAt q = AvoidedSolid.depthOf (AvoidedSolid.prepared solid) r (Straight q q)
    holesAt drilling =
      [ AtHole (kindOf (Part.form drilling)) centre (depthAt centre > r)
        | depthAt end > allowed facts,
          (centre, away) <-
            take 1 . sortOn (Vec.distance end . fst) $
              [ (c, plus mouth (times 2 (Part.drillRadius drilling)))
                | Part.Hole (Located _ c) _ mouth <- NonEmpty.toList (Part.holes drilling)
              ],
          Vec.distance centre end <= away
      ]
    kindOf form = case form of
      Part.Threaded h | not (Part.isInside h) -> ThreadOutside
      _ -> HoleInside

-- | Contact with an avoided solid at a place.
solidContact :: Located Part.Solid -> Touch -> ContactPlace -> SolidContact
solidContact (Located region solid) Touch {entered, reached, axis} place =
  SolidContact
    { avoidStatement = region,
      solidTop = Part.highest solid,
      depth = entered,
      distanceToKeep = reached,
      axisAt = axis,
      contactPlace = place
    }

-- | Collision of a part of the tool in a motion with a body: the lowest height of the tip, and the
-- top of the body.
collisionOf :: Facts -> CutterMotion -> Cylinder -> Mm -> Mm -> Contact -> Collision
collisionOf Facts {subject} m (Cylinder toolPart _ above) low top contact =
  Collision
    { frameOfCollision = number m,
      asked = Frame.origin <$> plannedFrameOf subject m,
      toolPart,
      partAbove = above,
      tipHeight = low,
      isEndless = top >= Tolerance.reach,
      contact
    }

-- | Planned frame of a motion. Nothing if the tape has other frames than planned.
plannedFrameOf :: ProofSubject -> CutterMotion -> Maybe PlannedFrame
plannedFrameOf subject m
  | Subject.isAligned subject =
    listToMaybe (drop (number m - 1) (Frame.plannedFrames (program subject)))
  | otherwise = Nothing

-- | Block of the toolpath to which a planned frame belongs; Nothing for a frame of a move or of a
-- command.
blockOf :: Facts -> PlannedFrame -> Maybe Block
blockOf Facts {blockAt, passBlockAt} planned = case Frame.role planned of
  Frame.Drilling n -> IntMap.lookup n blockAt
  Frame.Carving n -> IntMap.lookup n blockAt
  role -> Frame.passNumber role >>= (`IntMap.lookup` passBlockAt)

-- | Region of the statement of a planned frame.
statementOf :: Facts -> PlannedFrame -> Maybe Region
statementOf facts planned = case blockOf facts planned of
  Just Toolpath.Cutting {Toolpath.job = Located region _} -> Just region
  Just Toolpath.Clearing {Toolpath.pocket = Located region _} -> Just region
  Just (Toolpath.Holing (Located region _) _) -> Just region
  Just (Toolpath.Carved (Located region _) _ _) -> Just region
  _ -> Just (Frame.origin planned)

-- | Part of a motion in which the tip is below a height, and the lowest height of the tip there.
-- Nothing if it is nowhere below.
lowPart :: Mm -> CutterMotion -> Maybe (Mm, Segment)
lowPart limit m
  | low >= limit = Nothing
  | high < limit || Segment.length whole <= Mm 0 = Just (low, whole)
  | fromHeight m < limit = Just (low, Segment.between 0 share whole)
  | otherwise = Just (low, Segment.between share 1 whole)
  where
    whole = boundingPath m
    (low, high) = (min (fromHeight m) (toHeight m), max (fromHeight m) (toHeight m))
    share = over (minus limit (fromHeight m)) (minus (toHeight m) (fromHeight m))

-- | Path of a motion; of an arc whose radii differ, the one with the radius of its start.
boundingPath :: CutterMotion -> Segment
boundingPath = NonEmpty.head . Motion.paths

-- Stock -------------------------------------------------------------------------------------------

-- | Solids that are known to be stock: that of the program, or else the holes and the pockets.
metal :: Toolpath -> [StockSolid]
metal path = case Toolpath.stock (Toolpath.setup path) of
  Just (Located _ s) -> catMaybes [stockSolid s]
  Nothing
    | Toolpath.isFlat path -> []
    | otherwise ->
      mapMaybe
        (Stock.solidOver (endless, Mm 0))
        (concatMap outlinesOf (Toolpath.blocks path))

-- | Solid of a @stock@ statement.
stockSolid :: Part.Solid -> Maybe StockSolid
stockSolid s =
  Stock.solidOver
    (Part.lowest s, Part.highest s)
    (concatMap segmentsOf (Part.outlines s))
  where
    segmentsOf = map Part.segment . NonEmpty.toList . Part.elements

-- | Bottom of a solid that has none: below a hole and below a pocket there is metal.
endless :: Mm
endless = Mm (-1 / 0)

-- | Outlines of the holes and of the pocket of a block, each as its segments.
outlinesOf :: Block -> [[Segment]]
outlinesOf block = case block of
  Toolpath.Holing (Located _ d) _ ->
    [ [circle mouth p]
      | makesHole (Part.form d),
        Part.Hole (Located _ p) _ mouth <- NonEmpty.toList (Part.holes d)
    ]
  Toolpath.Clearing {Toolpath.pocket = Located _ p} ->
    [concatMap segmentsOf (Part.contour (Part.wall p) : Part.islands p)]
  _ -> []
  where
    segmentsOf = map Part.segment . NonEmpty.toList . Part.elements
    -- The others work on holes and studs that are there before.
    makesHole form = case form of
      Part.Plunged -> True
      Part.Bored _ -> True
      Part.Reamed -> False
      Part.Tapped _ -> False
      Part.Threaded _ -> False
    circle r@(Mm x) p =
      Segment.fullCircle CounterClockwise (Circle p r) (Vec.shift (Vec.vec x 0) p)

-- | Rapid moves of the cutter into solids of stock.
rapidsIntoStock :: Facts -> [StockSolid] -> [Collision]
rapidsIntoStock facts@Facts {subject, rapidFrames} solids =
  [ collisionOf facts m (Cylinder CutterPart (Mm 0) (Mm 0)) low top $
      StockLeft p (lowTravel facts m low top)
    | not (null solids),
      (k, before, m) <- zip3 [0 ..] (Nothing : map Just ms) ms,
      IntSet.member (number m) rapidFrames,
      not (any (risesInItsCut facts m) before),
      fst (bounds m) < highestTop,
      (low, top, p) <- take 1 (contacts k m)
  ]
  where
    ms = unlevelledMotions subject
    highestTop = foldl' max (Mm (-1 / 0)) (map Stock.top solids)
    index = BoxTree.index boxOf solids
    boxOf = Stock.boxOfSolid
    removals = removalsIn facts
    contacts k m =
      [ (low, Stock.top solid, p)
        | (t, c) <- toolsIn facts (number m),
          let r = minus (plus (cuttingRadius facts m c) (strays facts m)) (allowed facts),
          solid <-
            BoxTree.within (BoundingBox.inflate (plus r (allowed facts)) (Motion.box m)) index,
          Just (low, part) <- [lowPart (minus (Stock.top solid) (allowedHeight facts)) m],
          Just p <-
            [Stock.remaining removals solid (Probe k part r (plus low (allowedHeight facts)) t)]
      ]

-- | Clearance height of the statement of a motion, and the top of the stock above it: the cause of
-- a contact of a tip that stays at this clearance height or above it.
lowTravel :: Facts -> CutterMotion -> Mm -> Mm -> Maybe LowTravel
lowTravel facts@Facts {subject, allowedHeight} m low top = do
  _ <- Toolpath.stock (Toolpath.setup (path subject))
  clear <- clearanceOf =<< blockOf facts =<< plannedFrameOf subject m
  if clear < top && plus low allowedHeight >= clear then Just (LowTravel clear top) else Nothing
  where
    clearanceOf block = case block of
      Toolpath.Cutting {Toolpath.job = Located _ j} -> Part.clearance j
      Toolpath.Clearing {Toolpath.pocket = Located _ p} -> Part.clearance (Part.wall p)
      Toolpath.Holing (Located _ d) _ -> Just (Part.travelHeight d)
      Toolpath.Carved (Located _ c) _ _ -> Just (Part.carvingTravel c)
      _ -> Nothing

-- | Test that a motion goes straight up from the end of the motion before it, with the same cone.
-- No part of a cone is wider than the parts above it, so it leaves by the space that it cut.
risesInItsCut :: Facts -> CutterMotion -> CutterMotion -> Bool
risesInItsCut facts m before =
  Segment.start (segment m) == Segment.end (segment m)
    && Segment.end (segment before) == Segment.start (segment m)
    && fromHeight m == toHeight before
    && toHeight m >= fromHeight m
    && case (toolsIn facts (number before), toolsIn facts (number m)) of
      ([(t0, _)], [(t, c)]) -> t0 == t && CutterBody.widensUpwards c
      _ -> False

-- | Taps, reamers and thread mills that run into the stock of the program.
coreHolesIn :: Facts -> [Collision]
coreHolesIn facts@Facts {subject} =
  [ collisionOf facts coreMotion (Cylinder CutterPart needed (Mm 0)) coreLowest (Mm 0) $
      CoreLeft coreTool needed stockAt
    | CoreHoleFault {coreMotion, coreTool, needed, coreLowest, stockAt} <-
        CoreHole.coreHoleFaults motionsInStock
  ]
  where
    motionsInStock =
      CoreHole.MotionsInStock
        { CoreHole.toolpath = path subject,
          CoreHole.motions = unlevelledMotions subject,
          CoreHole.isRapid = \m -> IntSet.member (number m) (rapidFrames facts),
          CoreHole.toolsIn = toolsIn facts . number,
          CoreHole.removals = removalsIn facts,
          CoreHole.solids =
            [ solid
              | Just (Located _ s) <- [Toolpath.stock (Toolpath.setup (path subject))],
                Just solid <- [stockSolid s]
            ],
          CoreHole.allowed = allowed facts,
          CoreHole.allowedHeight = allowedHeight facts
        }

-- | Largest radius, and radius within which stock is surely removed, of a cutter in a motion. They
-- differ only for conical cutters and blades.
cuttingRadius, removingRadius :: Facts -> CutterMotion -> Cutter -> Mm
cuttingRadius facts m c = max (radiusIn facts m c) $ case kind c of
  -- The frames of a V-carving have the radius of the tip.
  Part.VBitCutter -> cutterRadius c
  _ | isConical c -> tipRadius c
  _ -> Mm 0
removingRadius facts m c
  | isConical c = min (radiusIn facts m c) (CutterBody.removalRadius c)
  | otherwise = radiusIn facts m c

-- | Radius of a cutter that may be in the spindle in a motion. If it is the only one, the frames
-- show its radius.
radiusIn :: Facts -> CutterMotion -> Cutter -> Mm
radiusIn facts m c = case toolsIn facts (number m) of
  [_] -> radiusOf facts m
  _ -> cutterRadius c

-- | Test that the radius of a tool is not the same at all heights.
isConical :: Cutter -> Bool
isConical c = CutterBody.removalRadius c < cutterRadius c || tipRadius c /= cutterRadius c

-- | Lowest and highest height of the tip in a motion.
bounds :: CutterMotion -> (Mm, Mm)
bounds m = (min (fromHeight m) (toHeight m), max (fromHeight m) (toHeight m))

-- | Contacts of the shanks and the holders of tools with stock.
bodiesInStock :: Facts -> [Collision]
bodiesInStock facts@Facts {subject}
  | not (any hasBody (catMaybes (SpindleCutter.cutters (path subject)))) = []
  | otherwise =
    [ collisionOf facts m cylinder low (Stock.top solid) (StockLeft p Nothing)
      | (k, m) <- zip [0 ..] (unlevelledMotions subject),
        (t, c) <- toolsIn facts (number m),
        cylinder@(Cylinder _ r above) <- bodyParts c,
        solid <- solids,
        Just (low, part) <-
          [lowPart (minus (minus (Stock.top solid) above) (allowedHeight facts)) m],
        let level = plus (plus low above) (allowedHeight facts),
        Just p <-
          [Stock.remaining removals solid (Probe k part (minus r (allowed facts)) level t)]
    ]
  where
    removals = removalsIn facts
    solids = case Toolpath.stock (Toolpath.setup (path subject)) of
      Just (Located _ s) -> catMaybes [stockSolid s]
      Nothing -> [StockSolid Everywhere endless (Mm 0)]
    hasBody c = isJust (fluteLength (body c)) || not (null (holder (body c)))
    bodyParts c =
      [Cylinder ShankPart (cutterRadius c) z | Just z <- [fluteLength (body c)]] <> holderParts c

-- | Motions of the tape that remove stock.
removalsIn :: Facts -> Stock.Removals
removalsIn facts@Facts {subject, rapidFrames} =
  Stock.removalsOf
    [ Removal
        { Stock.order = k,
          Stock.track = boundingPath m,
          Stock.fromTip = fromHeight m,
          Stock.toTip = toHeight m,
          Stock.width = minus (removingRadius facts m c) (Mm (uneven m)),
          Stock.point = CutterBody.pointHeight c,
          Stock.tool = t,
          Stock.openSide = Toolpath.openSideOf (path subject) t
        }
      | (k, m) <- zip [0 ..] (unlevelledMotions subject),
        not (IntSet.member (number m) rapidFrames),
        (t, c) <- take 1 (narrowest (toolsIn facts (number m)))
    ]
  where
    uneven m = FastDistance.uneven (segment m)
    narrowest tools = case tools of
      _ : _ : _ -> [foldl1 (\a b -> if removed b < removed a then b else a) tools]
      _ -> tools
    removed = CutterBody.removalRadius . snd
