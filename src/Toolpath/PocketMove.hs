-- | The moves of a pocket: for each pass the plunge, the loops from the inside outwards, and the
-- retract. A /section/ is a part of a pass in the plane: a part of a loop, a detour, or a linking
-- move between loops ("Toolpath.Pocket").
module Toolpath.PocketMove
  ( blocks,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Base.Region (Located (..), Region)
import Control.Monad (foldM, unless, when)
import Data.Foldable (for_, toList)
import Data.List (find)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, isJust, isNothing, listToMaybe, mapMaybe)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier qualified as Carrier
import Geometry.Distance (ClosestPoint (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.Equidistant qualified as Equidistant
import Offset.Tolerance qualified as Tolerance
import Part.Part
  ( ClearedExtent (..),
    Element,
    Milling (contour, feed),
    Pocketing (extent, islands, stepover, wall),
    SpacePoint (..),
  )
import Part.Part qualified as Part
import Toolpath.Descent (Way)
import Toolpath.Descent qualified as Descent
import Toolpath.DescentChoice qualified as DescentChoice
import Toolpath.DescentReport (DescentFault (HelixBehindWall))
import Toolpath.Error (Error (..))
import Toolpath.FacePath qualified as FacePath
import Toolpath.HelixPlace qualified as HelixPlace
import Toolpath.Inset qualified as Inset
import Toolpath.LinkingMove (Visit (Visit))
import Toolpath.LinkingMove qualified as LinkingMove
import Toolpath.OffsetRefusal qualified as OffsetRefusal
import Toolpath.Pocket (PocketMove (..), PocketRoom (..))
import Toolpath.Pocket qualified as Pocket
import Toolpath.RestMaterial qualified as RestMaterial
import Toolpath.RestPath qualified as RestPath
import Toolpath.Toolpath (Block (..), Manner (Manner), Move (Move), Pass (..))
import Toolpath.Toolpath qualified as Toolpath

-- | The passes of a pocket statement: all depths for the first allowance, then all depths for the
-- next one. @number@ is the statement's number in the order of execution, from 0; @at@ is the
-- position of the cutter before the pocket. Refuses pockets into which the cutter does not fit, and
-- pockets without a depth in which the cutter would have to rise. Refuses also elements that have a
-- larger allowance than the last pass, and pockets with too many loops.
blocks :: Int -> SpacePoint -> Located Pocketing -> Either Error [Block]
blocks number at (Located region given) = do
  unless isSurface $
    for_
      (find ((> NonEmpty.last (Part.allowances milling)) . Part.allowance . Part.finish) elements)
      (Left . KeepsMore word)
  when
    (isNothing (clearanceAndLevels milling) && currentHeight > Mm 0)
    (Left (CutsAir word currentHeight lastHeight))
  rests <- if isSurface then Right [] else restAtWalls word pocket
  reverse . snd <$> foldM (addPass rests) (at, []) (zip [1 ..] passes)
  where
    word = LinkingMove.pocketKeyword (Located region given)
    pocket = oriented given
    isSurface = isJust (Part.surface given)
    milling = wall pocket
    elements = elementsOf pocket
    currentHeight =
      fromMaybe (height at) (listToMaybe (mapMaybe Part.level (reverse (Part.approach milling))))
    passes = filter hasMoves (passesOf pocket currentHeight)
    -- A larger cutter may have left nothing for a pass.
    hasMoves pass =
      isNothing (Part.roughing pocket) || maybe True (not . null) (sectionsFrom pass Nothing)
    lastHeight =
      listToMaybe [Part.place s | s <- reverse (Part.approach milling), isJust (Part.level s)]
    addPass rests (position, done) (k, pass) = do
      let visit =
            Visit
              { LinkingMove.word,
                LinkingMove.milling,
                LinkingMove.isFirst = k == 1,
                LinkingMove.isLast = k == length passes,
                LinkingMove.from = position
              }
      b <- blockOf number (Located region pocket) rests visit pass
      Right (LinkingMove.endPosition position (Toolpath.moves b), b : done)

-- | One pass of a pocket before its moves are computed.
data PocketPass = PocketPass
  { -- | allowance at the walls
    allowance :: Mm,
    -- | height of the pass
    level :: Mm,
    -- | height down to which the material is cut before the pass
    above :: Mm,
    -- | the sections of the pass from a plunge position; for Nothing, the cutter plunges at the
    -- beginning of the first loop. The result is Nothing if there are too many loops
    sectionsFrom :: Maybe Point -> Maybe [PocketMove]
  }

-- | All passes of a pocket: all depths for the first allowance, then all depths for the next one.
-- @currentHeight@ is the height of the passes if the pocket has no depth.
passesOf :: Pocketing -> Mm -> [PocketPass]
passesOf pocket currentHeight = concat (NonEmpty.zipWith withAllowance allowances sections)
  where
    milling = wall pocket
    allowances = Part.allowances milling
    sections = sectionsFor pocket
    withAllowance allowance sectionsFrom = case clearanceAndLevels milling of
      Nothing ->
        [PocketPass {allowance, level = currentHeight, above = currentHeight, sectionsFrom}]
      -- At every depth the cutter plunges at the same point, and the sections are the same.
      Just (_, levels) ->
        let down = sectionsFrom (plungePoint milling)
         in [ PocketPass {allowance, level, above, sectionsFrom = const down}
              | (above, level) <-
                  zip (Part.materialTop milling : NonEmpty.toList levels) (NonEmpty.toList levels)
            ]

-- | The clearance height and the heights of the passes. Nothing for a pocket without a depth; the
-- cutter cannot be lifted in such a pocket.
clearanceAndLevels :: Milling -> Maybe (Mm, NonEmpty Mm)
clearanceAndLevels milling = case (Part.levels milling, Part.clearance milling) of
  (first : more, Just clearanceHeight) -> Just (clearanceHeight, first :| more)
  _ -> Nothing

-- | The block of a pass. @number@ is the number of the statement; @rests@ are the parts of the
-- walls that remain unreached after the last pass.
blockOf ::
  Int ->
  Located Pocketing ->
  [Equidistant.UnreachedPart] ->
  Visit ->
  PocketPass ->
  Either Error Block
blockOf number job rests visit pass@PocketPass {allowance, level} = do
  (approach, cleared, retract) <-
    passOf (value job) visit (fst <$> clearanceAndLevels milling) pass
  Right
    Clearing
      { pocket = job,
        pass =
          Pass
            { number,
              reach = plus (Part.radius milling) allowance,
              left = allowance,
              atHeight = level
            },
        approach,
        cleared,
        retract,
        rests = if allowance == NonEmpty.last (Part.allowances milling) then rests else []
      }
  where
    milling = wall (value job)

-- | The plunge position of the cutter: the last approach point. Nothing if the program gives none.
lastApproach :: Milling -> Maybe Point
lastApproach milling = value . Part.place <$> listToMaybe (reverse (Part.approach milling))

-- | The position at which the cutter goes down: the last approach point. Nothing if the program
-- gives none, and for a ramp, which begins on the first loop.
plungePoint :: Milling -> Maybe Point
plungePoint milling = case value (Part.descent milling) of
  Part.Ramping _ -> Nothing
  _ -> lastApproach milling

-- | The moves before, in and after a pass. @travelHeight@ is the clearance height; Nothing if the
-- pocket has no depth, so that the cutter cannot be lifted.
passOf ::
  Pocketing -> Visit -> Maybe Mm -> PocketPass -> Either Error ([Move], NonEmpty Move, [Move])
passOf pocket visit travelHeight pass@PocketPass {allowance, level = z, sectionsFrom} = do
  found <- maybe (Left (TooManyLoops word Pocket.mostSegments)) Right (sectionsFrom from)
  sections <- fitting (NonEmpty.nonEmpty found)
  (visit', sections') <- case (sections, travelHeight) of
    (LiftedLink p _ :| _, Just _)
      | Part.Helical _ _ <- value (Part.descent milling) ->
        Left (NoDescent (HelixBehindWall (region (Part.descent milling)) p))
    -- A wall lies between the plunge position and the first loop, so the cutter goes straight to
    -- the clearance height, and moves over the wall at this height.
    (LiftedLink _ q :| next : more, Just c) ->
      Right
        (visit {LinkingMove.milling = goingOver word c q milling}, next :| more)
    (_, Just _) -> Right (visit, sections)
    (_, Nothing) ->
      maybe
        (Right (visit, sections))
        (\(p, q) -> Left (HasToRise word p q))
        (listToMaybe [(p, q) | LiftedLink p q <- toList sections])
  way <- maybe (Right Nothing) (const (wayDown (plungePoint milling) sections')) travelHeight
  let begin = Pocket.startPoint (NonEmpty.head sections')
      finish = Pocket.endPoint (NonEmpty.last sections')
      (before, after) = case travelHeight of
        Nothing -> LinkingMove.withoutDepth visit' z (z, z) begin finish
        Just clear -> LinkingMove.withDepth visit' clear (z, z) way begin finish
      slope = maybe [] (slopeTo begin) way
  along <- movesOf wayDown slopeTo visit z travelHeight (NonEmpty.toList sections')
  cleared <- fitting (NonEmpty.nonEmpty (slope <> along))
  Right (before, cleared, after)
  where
    Visit {LinkingMove.word, LinkingMove.milling} = visit
    fitting = maybe (Left (NoPathInPocket word (contour milling) allowance)) Right
    wayDown = wayInPocket pocket pass
    slopeTo = slopeMoves word milling
    currentPoint = plane (LinkingMove.from visit)
    from = case (travelHeight, lastApproach milling) of
      (Just _, p) -> p
      (Nothing, Just p) | LinkingMove.isFirst visit -> Just p
      (Nothing, _) -> Just currentPoint

-- | The milling with an approach that goes straight to the clearance height @c@, and on to the
-- point @q@ at this height. @word@ is the region of the statement's first word.
goingOver :: Region -> Mm -> Point -> Milling -> Milling
goingOver word c q milling =
  milling {Part.approach = Part.approach milling <> straight <> [over]}
  where
    over = Part.Stop (Located word q) (Just c) Part.Rapid
    straight =
      [ s {Part.level = Just c, Part.pace = Part.Rapid}
        | s <- take 1 (reverse (Part.approach milling)),
          maybe False (/= c) (Part.level s)
      ]

-- | The way down to the first of some sections; Nothing if the cutter goes straight down. @about@
-- is the centre of a helix. If it is Nothing, the helix is near the beginning of the sections.
wayInPocket ::
  Pocketing -> PocketPass -> Maybe Point -> NonEmpty PocketMove -> Either Error (Maybe Way)
wayInPocket pocket PocketPass {allowance, level, above} about sections =
  case value (Part.descent milling) of
    Part.Plunging -> Right Nothing
    Part.Helical _ _ -> choice (fromMaybe (HelixPlace.near reach walls path) about)
    _ -> choice begin
  where
    milling = wall pocket
    reach = plus (Part.radius milling) allowance
    walls = map Part.segment (Vector.toList (elementsOf pocket))
    begin = Pocket.startPoint (NonEmpty.head sections)
    path = Pocket.firstLoop sections
    choice p =
      DescentChoice.inPocket milling reach (above, level) (p, HelixPlace.roomAt walls p) path

-- | The moves of a way down, and the straight move from its end to the point @begin@ at its height.
slopeMoves :: Region -> Milling -> Point -> Way -> [Move]
slopeMoves word milling begin way = slope <> [link | not (Vec.isNear end begin)]
  where
    slope = map snd (NonEmpty.toList (LinkingMove.slopeMoves word milling way))
    final = NonEmpty.last (Descent.slope way)
    end = Segment.end (Descent.piece final)
    z = snd (Descent.heights final)
    link = Move (Straight end begin) (Manner (z, z) (Part.At (feed milling)) False) word False

-- | The moves of the sections of a pass at the height @z@. A linking move over a wall rises to the
-- clearance height @travelHeight@ and goes down again as the statement asks: @wayDown@ gives the
-- way down to the sections after it, and @slopeTo@ the moves of that way to a point.
movesOf ::
  (Maybe Point -> NonEmpty PocketMove -> Either Error (Maybe Way)) ->
  (Point -> Way -> [Move]) ->
  Visit ->
  Mm ->
  Maybe Mm ->
  [PocketMove] ->
  Either Error [Move]
movesOf wayDown slopeTo Visit {LinkingMove.word, LinkingMove.milling} z travelHeight = go
  where
    go sections = case sections of
      [] -> Right []
      LiftedLink p q : next : more
        | Just c <- travelHeight -> do
          way <- wayDown Nothing (next :| more)
          (overWall c p q way <>) <$> go (next : more)
      section : more ->
        ( [ Move s (Manner (z, z) (Part.At (feed milling)) False) word False
            | s <- Pocket.segments section
          ]
            <>
        )
          <$> go more
    overWall c p q way =
      let down = maybe q Descent.entry way
          low = maybe z Descent.entryHeight way
       in [Move (Straight p p) (Manner (z, c) Part.Rapid False) word False | c /= z]
            <> [Move (Straight p down) (Manner (c, c) Part.Rapid False) word False]
            <> [ Move
                   (Straight down down)
                   (Manner (c, low) (LinkingMove.descentPace milling) False)
                   word
                   False
                 | c /= low
               ]
            <> maybe [] (slopeTo q) way

-- | The sections of the passes for each allowance, in the order of the allowances, as functions of
-- the plunge position. The passes with the first allowance clear the floor, or what a larger cutter
-- has left of it; the others finish the walls. The result of a function is Nothing if there are too
-- many loops.
sectionsFor :: Pocketing -> NonEmpty (Maybe Point -> Maybe [PocketMove])
sectionsFor pocket = case extent pocket of
  Surface face -> (Just . FacePath.sections pocket face) :| []
  WholePocket -> whole
  FloorOfCarving -> whole
  RestOfPocket rough ->
    let along a distances =
          let found = RestPath.areas (room a) rough distances
           in \from -> (\areas -> RestPath.sections (room a) rough areas from) <$> found
     in along first (Pocket.clearingDistances (room first) step)
          :| zipWith
            (\before a -> along a (Pocket.finishingDistances (room a) step before))
            (first : more)
            more
  where
    whole =
      (\from -> Pocket.clear (room first) step from)
        :| zipWith (\before a -> Pocket.finishWalls (room a) step before) (first : more) more
    first :| more = Part.allowances (wall pocket)
    step = stepover pocket
    contours =
      Inset.oriented (Part.polyarcOf (contour (wall pocket))) (map Part.polyarcOf (islands pocket))
    inset = Inset.inset contours
    -- Only the loops nearest to the walls also enter passages of exactly the cutter's width.
    insetFrom nearest d = if d == nearest then Inset.insetWithSlots inset d else inset d
    room leaves =
      PocketRoom
        { walls = foldr1 (<>) (fmap Polyarc.segments contours),
          offsetBy = insetFrom (plus (Part.radius (wall pocket)) leaves),
          insetOfLoops = Inset.insetOfLoops,
          radius = Part.radius (wall pocket),
          leaves,
          isReversed = hasSpaceOnRight pocket
        }

-- | True when the free space lies on the right of the direction of travel. With a clockwise
-- spindle, climb milling has the material on the right and the free space on the left.
hasSpaceOnRight :: Pocketing -> Bool
hasSpaceOnRight pocket = climbs /= (Part.spindleSense (wall pocket) == Part.Clockwise)
  where
    climbs = maybe True ((== Part.Climb) . value) (Part.sense (wall pocket))

-- | The outer contour and the islands, oriented in the cutter's direction of travel.
oriented :: Pocketing -> Pocketing
oriented pocket =
  pocket
    { wall = (wall pocket) {contour = orient (not isReversed) (contour (wall pocket))},
      islands = map (orient isReversed) (islands pocket)
    }
  where
    isReversed = hasSpaceOnRight pocket
    orient counterClockwise c =
      if (Polyarc.signedArea (Part.polyarcOf c) > 0) == counterClockwise
        then c
        else Part.reversedContour c

-- | The elements of all walls: those of the outer contour, then those of the islands in order.
elementsOf :: Pocketing -> Vector Element
elementsOf pocket =
  Vector.fromList
    (concatMap (NonEmpty.toList . Part.elements) (contour (wall pocket) : islands pocket))

-- Rest material

-- | The parts of the walls that the cutter does not reach in the last pass. The element numbers in
-- these parts are indices of 'elementsOf'. If the program does not allow rest material, such a part
-- is an error. @word@ is the region of the statement's first word.
restAtWalls :: Region -> Pocketing -> Either Error [Equidistant.UnreachedPart]
restAtWalls word pocket = case (Part.rest milling, found) of
  (Part.Refused, o : _) -> Left (OffsetRefusal.refusal word tool (elementsOf pocket) o)
  (Part.Refused, []) -> Right []
  (Part.Allowed, _) ->
    Right
      ( concat (zipWith rests starts contours)
          <> [ Equidistant.UnreachedPart
                 { Equidistant.stop = g,
                   Equidistant.cutterCentre = p,
                   Equidistant.restMaterial = Equidistant.Unbounded
                 }
               | g@Equidistant.Obstacle {Equidistant.cause = Equidistant.Collision _ _ p} <- gaps
             ]
      )
  where
    milling = wall pocket
    left = NonEmpty.last (Part.allowances milling)
    r = plus (Part.radius milling) left
    tool = RestMaterial.toolOf milling left
    contours = contour milling : islands pocket
    starts = scanl (+) 0 (map (length . Part.elements) contours)
    side = if hasSpaceOnRight pocket then Carrier.RightOf else Carrier.LeftOf
    style = Equidistant.CornerStyle {Equidistant.sharp = False, Equidistant.extra = const (Mm 0)}
    found =
      [ OffsetRefusal.renumbered n o
        | (n, c) <- zip starts contours,
          Left o <- [Equidistant.styled style side r (Part.polyarcOf c)]
      ]
        <> gaps
    rests n c = case Equidistant.styled style side r (Part.polyarcOf c) of
      Right _ -> []
      Left _ ->
        [ rest {Equidistant.stop = OffsetRefusal.renumbered n (Equidistant.stop rest)}
          | rest <- snd (Equidistant.reachableFitting style side r (Part.polyarcOf c))
        ]
    gaps = gapsBetween r (map Part.polyarcOf contours)

-- | One obstacle for each pair of contours between which a circle of the radius @r@ does not pass:
-- the narrowest point between the two. Elements are numbered from 0 over all contours in order.
gapsBetween :: Mm -> [Polyarc.Polyarc] -> [Equidistant.Obstacle]
gapsBetween r contours =
  [ Equidistant.Obstacle
      { Equidistant.cause = Equidistant.Collision i j p,
        Equidistant.largest = Just (times 0.5 d)
      }
    | (d, (i, j, p)) <- Map.elems (Map.fromListWith narrower found)
  ]
  where
    numbered =
      zip
        [0 :: Int ..]
        [(k, s) | (k, c) <- zip [0 :: Int ..] contours, s <- NonEmpty.toList (Polyarc.segments c)]
    index = BoxTree.index (BoundingBox.ofSegment . snd . snd) numbered
    widest = minus (times 2 r) (times 2 Tolerance.clearance)
    found =
      [ ((k, l), (d, (i, j, centre p s')))
        | (i, (k, s)) <- numbered,
          (j, (l, s')) <-
            BoxTree.within (BoundingBox.inflate widest (BoundingBox.ofSegment s)) index,
          k < l,
          let ClosestPoint d p = Distance.segments s s',
          d < widest
      ]
    narrower a b = if fst a <= fst b then a else b
    centre p s' =
      let q =
            snd (Distance.nearest p s')
          Mm r' = r
       in if Vec.isNear p q then p else Vec.shift (Vec.scale r' (Vec.unit (Vec.to p q))) p
