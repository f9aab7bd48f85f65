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
import Data.List (groupBy, maximumBy, minimumBy, nub, nubBy, sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (isNothing, mapMaybe)
import Data.Ord (comparing)
import Data.Set qualified as Set
import Geometry.Carrier qualified as Carrier
import Geometry.Distance (ClosestPoint (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (Arc, Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Offset.Tolerance qualified as Tolerance
import Part.ContourElement qualified as ContourElement
import Part.Part (Accuracy, Contour (elements), Milling (contour, radius, side, work), Side (..))
import Part.Part qualified as Part
import Part.WallDepth qualified as WallDepth
import Toolpath.Error (ContourBeginning (..), Error (..), Intrusion (..))
import Toolpath.HoleReport (HoleCut (HoleCut, also, centre))
import Toolpath.HoleReport qualified as HoleReport
import Toolpath.LinkingMove qualified as LinkingMove
import Toolpath.LinkingMoveError (CheckedMoves (CheckedMoves), LinkingMoveError (OnOtherSide))
import Toolpath.LinkingMoveError qualified as LinkingMoveError
import Toolpath.MillingSide (keyword, leadingSide)
import Toolpath.PointedIntrusion (PointedIntrusion (PointedIntrusion))
import Toolpath.PointedIntrusion qualified as PointedIntrusion
import Toolpath.Tolerance qualified as PathTolerance
import Toolpath.Toolpath (Block (..), Move, Pass (..), Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Toolpath.Wall (WallIndex)
import Toolpath.Wall qualified as Wall

-- | The intrusions of a toolpath that are deeper than the tolerance of the statement that machines
-- the contour. A region of the program may ask for several moves that intrude; it gets one error,
-- for the deepest intrusion. Of the cuts in one pass, only the first one that intrudes counts.
intrusions :: Toolpath -> [Error]
intrusions path = worst (concatMap (intrusionsOfBlock machined profiles) blocks)
  where
    blocks = Toolpath.blocks path
    machined = Wall.index blocks
    profiles = Wall.index [b | b@Cutting {} <- blocks]
    worst errors =
      map deepest (Map.elems (Map.fromListWith (flip (<>)) [(regionOf e, [e]) | e <- errors]))
    deepest errors = case minimumBy (comparing depth) errors of
      HoleCuts cut ->
        HoleCuts cut {also = nub [q | HoleCuts HoleCut {centre = q} <- errors, q /= centre cut]}
      e -> e
    regionOf e = case e of
      CutsPart at _ _ _ _ _ _ -> at
      WrongLink fault -> LinkingMoveError.place fault
      HoleCuts cut -> HoleReport.hole cut
      MillsItself at _ _ _ _ -> at
      MillsAnother _ at _ _ _ _ -> at
      _ -> Region 0 0

-- | A sort key: minus the depth of an intrusion in mm, so that the deepest one is the least.
depth :: Error -> Double
depth e = case e of
  CutsPart _ _ _ (Mm d) _ _ _ -> -d
  HoleCuts HoleCut {HoleReport.depth = Mm d} -> -d
  MillsItself _ _ _ (Mm d) _ -> -d
  MillsAnother _ _ _ _ (Mm d) _ -> -d
  _ -> 0

-- | A tool, and the contours from which it has to keep its distance.
data Intruder = Intruder
  { -- | radius of the tool
    tool :: Mm,
    -- | number of the statement whose contour is not checked, because the moves are cuts along that
    -- contour; Nothing if all contours are checked
    own :: Maybe Int,
    -- | for linking moves: the number of their statement, and the allowance that remains after its
    -- last pass. The moves must not cut into this allowance. Nothing if no allowance is checked
    leaving :: Maybe (Int, Mm),
    -- | the work on holes to which the moves belong, if they do
    working :: Maybe Part.Drilling
  }

-- | A tool that keeps its distance from all contours.
plainIntruder :: Mm -> Intruder
plainIntruder tool = Intruder {tool, own = Nothing, leaving = Nothing, working = Nothing}

-- | The intrusions of the moves of a block. The second index has the walls without those of
-- pockets.
intrusionsOfBlock :: WallIndex -> WallIndex -> Block -> [Error]
intrusionsOfBlock machined profiles b = case b of
  Commanding _ -> []
  Travelling radius' _ ms -> concatMap (found (plainIntruder radius')) ms
  Holing (Located _ d) ms ->
    let widthOf = widthIn d
     in map
          (asHole d)
          (concat [found (plainIntruder (widthOf m)) {working = Just d} m | m <- ms])
  Carved (Located at c) ms _ -> intrusionsOfCarving profiles at c (NonEmpty.toList ms)
  Cutting {} -> intrusionsOfPass machined b
  Clearing {pocket = job@(Located _ p), pass, approach, cleared, retract} ->
    let clearing = plainIntruder (radius (Part.wall p))
        left = Just (number pass, NonEmpty.last (Part.allowances (Part.wall p)))
        -- All contours end at the top of the part, down to which a surface may be faced.
        mayCut m = isNothing (Part.surface p) || isBelowTop m
     in concatMap (found clearing {leaving = left}) (filter mayCut (approach <> retract))
          <> take
            1
            ( concatMap
                (map (asMilling Part.Milled (LinkingMove.pocketKeyword job)) . found clearing)
                (filter mayCut (NonEmpty.toList cleared))
            )
  where
    found = intrusionsOfMove machined
    asHole d e = case e of
      CutsPart at move element deep _ _ _ ->
        HoleCuts
          HoleCut
            { HoleReport.hole = at,
              centre = nearestCentre d (Segment.end move),
              also = [],
              HoleReport.element = element,
              HoleReport.depth = deep,
              HoleReport.drilling = d
            }
      _ -> e

-- | True for a move that goes below the top of the part.
isBelowTop :: Move -> Bool
isBelowTop m = uncurry min (Toolpath.heights m) < Mm 0

-- | The intrusion of the tip of a V-carving into a profile. Its flank may be over other contours;
-- the proof compares it with the carved region. A pocket may have cleared a part of this region, so
-- the walls of pockets do not count. @at@ is the region of the statement.
intrusionsOfCarving :: WallIndex -> Region -> Part.Carving -> [Move] -> [Error]
intrusionsOfCarving profiles at c ms =
  take
    1
    [ CarvesAcross (LinkingMove.keyword 6 at) element p
      | m <- filter isBelowTop ms,
        CutsPart _ _ element _ _ p _ <-
          intrusionsOfMove profiles (plainIntruder (Part.carvingTip c)) m
    ]

-- | The centre of the hole of a statement that is nearest to a point.
nearestCentre :: Part.Drilling -> Vec.Point -> Vec.Point
nearestCentre d p =
  minimumBy
    (comparing (Vec.distance p))
    [c | Part.Hole (Located _ c) _ _ <- NonEmpty.toList (Part.holes d)]

-- | True for a cut into the wall on which a statement works: an arc about the centre of a hole. The
-- teeth of a thread and a reamer go below the wall, and a countersink cuts its rim. @side@ is the
-- side of the arc on which its cutter moves.
isOwnCylinder :: Part.Drilling -> Maybe Carrier.Side -> Error -> Bool
isOwnCylinder d side' e = case e of
  CutsPart _ _ element deep _ _ _ ->
    or
      [ deep <= plus most Tolerance.resolution
        | Part.Hole (Located _ p) _ mouth <- NonEmpty.toList (Part.holes d),
          WallDepth.worksOn (Part.form d) p side' (Part.segment element),
          Just most <- [WallDepth.wallDepth d mouth]
      ]
  _ -> False

-- | The radius of the tool of a drilling statement during a move. A pointed tool is no wider than
-- the mouth of its hole; away from the centres of the holes it counts as wide as the widest mouth.
widthIn :: Part.Drilling -> Move -> Mm
widthIn d = \m -> min (Part.drillRadius d) (Map.findWithDefault (maximum mouths) (placeOf m) mouths)
  where
    mouths =
      Map.fromListWith
        max
        [ (coordinates p, mouth)
          | Part.Hole (Located _ p) _ mouth <- NonEmpty.toList (Part.holes d)
        ]
    placeOf = coordinates . Segment.end . Toolpath.segment
    coordinates p = (Vec.x p, Vec.y p)

-- | The intrusions of the moves of a pass along a contour. Empty for other blocks.
intrusionsOfPass :: WallIndex -> Block -> [Error]
intrusionsOfPass machined b = case b of
  Cutting {job = Located at milling, pass, approach = before, descent, cut, retract} ->
    let left = Just (number pass, minimum (Part.allowances milling))
        linking = foundBy milling (\tool -> (plainIntruder tool) {leaving = left})
        cutting = foundBy milling (\tool -> (plainIntruder tool) {own = Just (number pass)})
        approach = before <> descent
        (ahead, onto) = splitAt (length approach - 1) approach
        isClear = null . linking
        word = keyword milling at
        links =
          map (onItself milling word) (concatMap linking (ahead <> retract))
            <> [ onItself milling word e
                 | m <- onto,
                   e <- map (beginning milling (Toolpath.reach pass) isClear m) (linking m)
               ]
        along =
          mapMaybe (throughProfile milling) (approach <> retract)
            <> take
              1
              ( concatMap
                  (map (asMilling (work milling) word . onItself milling word) . cutting)
                  (if isAlone (number pass) then [] else NonEmpty.toList cut)
              )
     in case diagnosed (null . concatMap linking) b links of
          -- The other intrusions may follow from the wrong side.
          [e@(WrongLink OnOtherSide {})] -> [e]
          found'
            -- The program does not write the links of a text.
            | work milling == Part.Engraved -> map (asMilling Part.Engraved word) found' <> along
            | otherwise -> found' <> along
  _ -> []
  where
    -- The tool is as wide as it is at the top of the part during the move.
    foundBy milling intruder m =
      let tip = uncurry min (Toolpath.heights m)
       in intrusionsOfMove machined (intruder (Part.radiusAtTop tip milling)) m
    -- If no other statement has a contour, the cuts of statement @n@ need no check.
    isAlone n = all (== n) (Wall.statements machined)

-- | The common cause of the errors of the linking moves of a pass, if it is known, otherwise these
-- errors. @isClear@ is true of moves that cut nothing that they should not.
diagnosed :: ([Move] -> Bool) -> Block -> [Error] -> [Error]
diagnosed isClear b errors = case b of
  Cutting {job = Located _ milling, approach, descent, cut, retract, sent = Nothing}
    | Right (Just side') <- leadingSide milling,
      first : more <- [(e, -depth err) | err@(CutsPart _ _ e _ _ _ _) <- errors],
      (element, deepest) <- maximumBy (comparing snd) (first :| more),
      Just fault <-
        LinkingMoveError.diagnosis
          milling
          side'
          (CheckedMoves (approach <> descent) cut retract isClear)
          (element, Mm deepest) ->
      [WrongLink fault]
  _ -> errors

-- | The error of a cut along a contour: it names the element along which the cutter moves, instead
-- of the move. @word@ is the region of the statement's first word.
asMilling :: Part.Work -> Region -> Error -> Error
asMilling kind word e = case e of
  CutsPart milled _ element deep _ p _ -> MillsAnother kind word milled element deep p
  _ -> e

-- | The error of a cut into the contour on which a statement moves the cutter's centre. All other
-- errors stay as they are. @word@ is the region of the statement's first word.
onItself :: Milling -> Region -> Error -> Error
onItself milling word e = case e of
  CutsPart _ _ element deep _ _ _
    | value (side milling) == On,
      any (isSame (Part.segment element) . Part.segment) (elements (contour milling)) ->
      MillsItself word (region (side milling)) element deep (Part.ends (contour milling))
  _ -> e
  where
    isSame a b = a == b || Segment.reverse a == b

-- | Adds the beginning of the contour to an intrusion of the move @m@ that leads to it. The
-- cutter's centre has to keep the distance @kept@ from the contour. @isClear@ is true of moves that
-- cut nothing that they should not.
beginning :: Milling -> Mm -> (Move -> Bool) -> Move -> Error -> Error
beginning milling kept isClear m e = case e of
  CutsPart at move element deep how p _ ->
    CutsPart at move element deep how p . Just $
      ContourBeginning
        { beginsAt = Segment.start (Part.segment (NonEmpty.head (elements (contour milling)))),
          mayMove = if mayBeginElsewhere then Just (Part.places milling) else Nothing
        }
  _ -> e
  where
    from = Segment.start (Toolpath.segment m)
    moved = ContourElement.startingNear from (contour milling)
    first = Part.segment (NonEmpty.head (elements moved))
    mayBeginElsewhere =
      Part.ends (contour milling) == Part.Closed
        && not (Part.givesStart milling)
        && null (Part.leadIn milling)
        && isOnCutterSide milling from
        && or [isClear m {Toolpath.segment = Straight from begin} | Just begin <- [newBegin]]
    newBegin = case leadingSide milling of
      Right (Just side') ->
        let Mm d = kept
            across = Vec.left (Segment.startDirection first)
         in Just (Vec.shift (Vec.scale (d * Carrier.sideSign side') across) (Segment.start first))
      _ -> Nothing

-- | True for a point on the side of a closed contour on which the statement cuts.
isOnCutterSide :: Milling -> Vec.Point -> Bool
isOnCutterSide milling p = case leadingSide milling of
  Right (Just side') ->
    let isCounterClockwise = Polyarc.areaOf Part.segment (elements (contour milling)) > 0
        cutsOutside = (side' == Carrier.RightOf) == isCounterClockwise
     in cutsOutside /= WindingNumber.encloses (Part.polyarcOf (contour milling)) p
  _ -> False

-- | The intrusion of a linking move of a pointed tool into the material behind its own profile;
-- Nothing for other tools, and when the tool moves on the profile.
throughProfile :: Milling -> Move -> Maybe Error
throughProfile milling m
  | radius milling <= Mm 0,
    Right (Just side') <- leadingSide milling,
    Just (PointedIntrusion element deep p) <-
      PointedIntrusion.deepest side' allowed (contour milling) path =
    Just (CutsPart (Toolpath.origin m) path element deep CutsContour p Nothing)
  | otherwise = Nothing
  where
    path = Toolpath.segment m
    allowed = allowedDepth (Part.tolerance milling) path

-- | The depth in mm to which a move may cut into a contour: the tolerance, and rounding. An arc may
-- cut less deep ('PathTolerance.arcIntrusion'), because its chords need the tolerance, too.
allowedDepth :: Accuracy -> Segment -> Mm
allowedDepth accuracy path = plus Tolerance.clearance $ case path of
  Straight _ _ -> inwards
  Arc {} -> min inwards PathTolerance.arcIntrusion
  where
    inwards = fst (Part.deviationLimits accuracy)

-- | The deepest intrusion of a move into the contours of each statement. If several of these are at
-- one point, only the first is listed, because the statements then mill the same contour.
intrusionsOfMove :: WallIndex -> Intruder -> Move -> [Error]
intrusionsOfMove machined intruder m
  | before > Wall.top machined && after > Wall.top machined = []
  | otherwise =
    nubBy
      isSamePoint
      (map deepest (groupBy ((==) `on` fst) (sortOn fst (hits machined intruder m))))
  where
    (before, after) = Toolpath.heights m
    isSamePoint e f = case (e, f) of
      (CutsPart _ _ _ _ _ p _, CutsPart _ _ _ _ _ q _) -> Vec.isNear p q
      _ -> False
    deepest errors = minimumBy (comparing depth) (map snd errors)

-- | The intrusions of the move @m@ into the elements near it, each with the number of a statement
-- that machines the element. Of several statements with equal contours, only the first one is
-- named, and the one that leaves an allowance: the intrusions into the contours of the others are
-- the same.
hits :: WallIndex -> Intruder -> Move -> [(Int, Error)]
hits machined Intruder {tool, own, leaving, working} m =
  [ (n, e)
    | (wall, element) <- Wall.near (not . null . keeping) reach machined,
      (n, kept) <- keeping wall,
      Just e <- [hit tool kept (Wall.tolerance wall) m element],
      not (any (\d -> isOwnCylinder d (Wall.cutterSide wall) e) working)
  ]
  where
    reach =
      BoundingBox.inflate
        (plus tool (maybe (Mm 0) snd leaving))
        (BoundingBox.ofSegment (Toolpath.segment m))
    -- The statements to name, each with the distance to keep from its contours.
    keeping wall =
      [ (n, tool)
        | n <- take 1 (filter isOther (Set.toAscList (Wall.machinedBy wall)))
      ]
        <> [(n, plus tool left) | Just (n, left) <- [leaving], n `Set.member` Wall.machinedBy wall]
    isOther n = Just n /= own && Just n /= fmap fst leaving

-- | The intrusion of the move @m@ into the element. Nothing if the move keeps its distance, within
-- the tolerance @accuracy@ of the element's statement. @tool@ is the radius of the tool. @kept@ is
-- the distance that the tool's centre has to keep from the element.
hit :: Mm -> Mm -> Accuracy -> Move -> Part.Element -> Maybe Error
hit tool kept accuracy m element
  | plus d allowed < kept || d <= Tolerance.coincident && goesThrough allowed path wall =
    Just
      ( CutsPart
          (Toolpath.origin m)
          path
          element
          (minus (if how == CutsAllowance then kept else tool) d)
          how
          p
          Nothing
      )
  | otherwise = Nothing
  where
    path = Toolpath.segment m
    wall = Part.segment element
    ClosestPoint d p = Distance.segments path wall
    allowed = allowedDepth accuracy path
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
