{-# LANGUAGE BangPatterns #-}

-- | From the part to the cutter's path: the equidistant of every contour to be machined, pass by
-- pass, the ways in and out, holes, and the moves between.
module Toolpath.FromPart
  ( lay,
    leadingSide,
    touchedRadius,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Base.Region (Located (..), Region (..))
import Base.Result (Result (..))
import Data.Bifunctor (first)
import Data.Function (on)
import Data.List (foldl', groupBy, minimumBy, nubBy, sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, isNothing, listToMaybe, mapMaybe)
import Data.Ord (comparing)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier (Sense (..))
import Geometry.Carrier qualified as Carrier
import Geometry.Distance (ClosestPoint (..))
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (Arc, Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.Equidistant qualified as Equidistant
import Offset.Tolerance qualified as Tolerance
import Part.Part
  ( Contour (elements),
    Drilling,
    Milling (contour, feed, radius, side),
    Operation (..),
    Part,
    Side (..),
    SpacePoint (..),
    Work (..),
  )
import Part.Part qualified as Part
import Toolpath.Compensation (Ways (Ways))
import Toolpath.Compensation qualified as Compensation
import Toolpath.Error (Error (..), Intrusion (..), Unsent (..), Warning (..))
import Toolpath.Error qualified as Error
import Toolpath.LinkingMove (Visit (Visit))
import Toolpath.LinkingMove qualified as LinkingMove
import Toolpath.OffsetRefusal qualified as OffsetRefusal
import Toolpath.PocketMove qualified as PocketMove
import Toolpath.RestMaterial (Remaining (Remaining, places, tool, word))
import Toolpath.RestMaterial qualified as RestMaterial
import Toolpath.Swivel qualified as Swivel
import Toolpath.Toolpath (Block (..), Manner (Manner), Move (Move), Pass (..), Toolpath (Toolpath))
import Toolpath.Toolpath qualified as Toolpath
import Toolpath.Warning qualified as Warning

-- | Lay the path. No path when an operation has none, or when there are operations but the start is
-- unknown, which is reported already; a part that is only drawn has a path without moves.
lay :: Part -> Result Warning Error Toolpath
lay part = case (Part.start part, Part.operations part) of
  (Nothing, []) ->
    Result
      []
      []
      (Just (Toolpath (Located (Region 0 0) (SpacePoint (Vec.point 0 0) (Mm 0))) [] False))
  (Nothing, _) -> Result [] [] Nothing
  -- Of the operations nothing is held behind their blocks.
  (Just begin, operations) | !tool <- maybe (Mm 0) Part.cutterRadius (Part.firstCutter part) ->
    case collect 0 tool (value begin) operations of
      ([], blocks) ->
        let path = Toolpath begin blocks (turns part)
            wrong = intrusions path
         in Result
              (staying path <> (if null wrong then Warning.warnings path else []))
              wrong
              (Just path)
      (errors, _) -> Result [] errors Nothing

-- | Whether the part is turned on a lathe: something is turned, or there is a tool for it.
turns :: Part -> Bool
turns part = or [isTurning c | Just c <- [Part.firstCutter part]] || any asks (Part.operations part)
  where
    asks operation = case operation of
      Mill (Located _ milling) -> Part.work milling == Turned
      Command (Located _ (Part.ChangeTool _ c)) -> isTurning c
      _ -> False
    isTurning c = Part.kind c == Part.TurningCutter

-- | What stays beside milled contours; what one cutter leaves at a statement that is gone through
-- several times is one warning.
staying :: Toolpath -> [Warning]
staying path =
  [ Leaves word tool (concatMap (map fst . NonEmpty.toList . places) (r : more))
    | r@Remaining {word, tool} :| more <- Map.elems statements
  ]
  where
    statements =
      Map.fromListWith
        (<>)
        ( reverse
            [ ((word, Error.radius tool, Error.leaves tool), r :| [])
              | r@Remaining {word, tool} <- RestMaterial.ofPath path
            ]
        )

-- | The blocks one after the other; an operation without a path leaves the cutter where it was.
collect :: Int -> Mm -> SpacePoint -> [Operation] -> ([Error], [Block])
collect number tool at operations = case operations of
  [] -> ([], [])
  o : rest -> case blocksOf number tool at o of
    Left e -> first (e :) (collect next tool' at rest)
    Right bs ->
      (bs <>) <$> collect next tool' (LinkingMove.arriving at (concatMap Toolpath.moves bs)) rest
    where
      !next = case o of
        Mill _ -> number + 1
        Pocket _ -> number + 1
        _ -> number
      !tool' = case o of
        Command (Located _ (Part.ChangeTool _ c)) -> Part.cutterRadius c
        _ -> tool

blocksOf :: Int -> Mm -> SpacePoint -> Operation -> Either Error [Block]
blocksOf number tool at operation = case operation of
  Travel stops -> Right [Travelling tool (LinkingMove.ways at (NonEmpty.toList stops))]
  Command c -> Right [Commanding c]
  Drill d -> Right [Holing d (holing at d)]
  Pocket job -> PocketMove.blocks number at job
  Mill (Located region given) -> do
    possible region given
    milling <- asWalked <$> oriented region given
    let job = Located region milling
        -- In an array once for all passes: they are many, and lie far apart in memory.
        numbered =
          let es =
                elements (contour milling)
           in Vector.fromListN (NonEmpty.length es) (NonEmpty.toList es)
        passes =
          [ (a, z)
            | a <- NonEmpty.toList (Part.allowances milling),
              z <- if null (Part.levels milling) then [standing milling] else Part.levels milling
          ]
    if null (Part.levels milling) && standing milling > Mm 0
      then Left (CutsAir (keyword region) (standing milling))
      else do
        side' <- leadingSide milling
        reverse . snd
          <$> foldl (next job side' numbered (length passes)) (Right (at, [])) (zip [1 ..] passes)
  where
    -- How the contour was written is not asked any more; it is much to keep.
    asWalked milling = milling {contour = (contour milling) {Part.legs = []}}
    -- Without depth the cutter stays at the height to which it was brought last.
    standing milling =
      fromMaybe (height at) (listToMaybe (mapMaybe Part.level (reverse (Part.approach milling))))
    next job side' numbered count before (k, (allowance, z)) = do
      (spot, done) <- before
      (found, rests) <- along job side' numbered allowance
      let !cuts = length found
          one before' (n, pieces) = do
            (spot', done') <- before'
            b <-
              passOf
                number
                job
                side'
                numbered
                (k == 1 && n == 1)
                (k == count && n == cuts)
                spot'
                allowance
                z
                pieces
                (if n == 1 then rests else [])
            Right (LinkingMove.arriving spot' (Toolpath.moves b), b : done')
      foldl one (Right (spot, done)) (zip [1 :: Int ..] (NonEmpty.toList found))

-- Machining a contour

-- | One pass, or one way of it, from where the cutter stands: its side, the elements by their
-- numbers, whether it is the first one and the last one, what it leaves, its height, the way beside
-- the contour, what stays there.
passOf ::
  Int ->
  Located Milling ->
  Maybe Carrier.Side ->
  Vector Part.Element ->
  Bool ->
  Bool ->
  SpacePoint ->
  Mm ->
  Mm ->
  NonEmpty Equidistant.OffsetSegment ->
  [Equidistant.UnreachedPart] ->
  Either Error Block
passOf
  number
  job@(Located region milling)
  side'
  numbered
  isFirst
  isLast
  at
  allowance
  z
  pieces
  rests =
    do
      swivels <- Swivel.axis (keyword region) milling side' pieces
      let pace = Part.At (feed milling)
          level' = (plus z (Mm 0), plus z (Mm 0))
          -- Most pieces go alike, and share it.
          plainly = Manner level' pace False
          raised = maybe (NonEmpty.repeat level') (fmap (\(a, b) -> (plus z a, plus z b))) swivels
          cut =
            move False (NonEmpty.head raised) (NonEmpty.head pieces)
              :| following pieces (NonEmpty.tail raised)
          following (previous :| rest) hs = case (rest, hs) of
            (piece : more, h : higher) ->
              let m =
                    move (goesOn previous piece) h piece
               in m `seq` (m : following (piece :| more) higher)
            _ -> []
          numberOf piece = case Equidistant.origin piece of
            Equidistant.Along i -> i
            Equidistant.Around i -> i
          -- A feed of its own holds on the element, not round its corners; nor does it slow down
          -- there.
          move continues heights piece =
            let e = numbered Vector.! numberOf piece
                own = case Equidistant.origin piece of
                  Equidistant.Along _ -> Part.ownFeed (Part.finish e)
                  Equidistant.Around _ -> Nothing
                slows = case Equidistant.origin piece of
                  Equidistant.Along _ -> Part.slow (Part.finish e)
                  Equidistant.Around _ -> False
             in Move
                  (Equidistant.segment piece)
                  ( if isNothing own && not slows && null swivels
                      then plainly
                      else Manner heights (maybe pace Part.At own) slows
                  )
                  (Part.origin e)
                  continues
          -- Behind an arc in which the cutter stands still there may be a corner.
          goesOn previous piece = case (Equidistant.origin previous, Equidistant.origin piece) of
            (Equidistant.Along i, Equidistant.Along j) ->
              j == i + 1 && Part.continues (numbered Vector.! j)
            _ -> False
          !around = Compensation.endsAround milling pieces
          -- From here on the moves are asked, so that a piece need not be kept behind its move.
          !firstSegment = Toolpath.segment (NonEmpty.head cut)
          !lastSegment = Toolpath.segment (NonEmpty.last cut)
          entry = Segment.start firstSegment
          exit = Segment.end lastSegment
          leadIn =
            leading
              region
              milling
              side'
              LeadingIn
              ( setOut
                  Segment.startDirection
                  firstSegment
                  (NonEmpty.head (elements (contour milling)))
              )
              entry
          leadOut =
            case leading
              region
              milling
              side'
              LeadingOut
              (setOut Segment.endDirection lastSegment (NonEmpty.last (elements (contour milling))))
              exit of
              [] -> if around then Compensation.onward (keyword region) milling firstSegment else []
              moves -> moves
          -- A cutter that fills a hollow stands still in it; then the contour tells the direction.
          setOut direction s e =
            direction (if Segment.length s > Tolerance.coincident then s else Part.segment e)
          begin = maybe entry (Segment.start . Toolpath.segment) (listToMaybe leadIn)
          finish = maybe exit (Segment.end . Toolpath.segment) (listToMaybe (reverse leadOut))
          -- The axis of a blade stands higher or lower.
          (inZ, outZ) =
            if null swivels
              then level'
              else (fst (NonEmpty.head raised), snd (NonEmpty.last raised))
          level h = Toolpath.atHeights (h, h)
          visit =
            Visit
              { LinkingMove.word = keyword region,
                LinkingMove.milling,
                LinkingMove.isFirst,
                LinkingMove.isLast,
                LinkingMove.from = at
              }
          (before, behind') = case (Part.levels milling, Part.clearance milling) of
            (_ : _, Just clear) -> LinkingMove.deep visit clear (inZ, outZ) begin finish
            _ -> LinkingMove.flat visit z (inZ, outZ) begin finish
          inwards = map (level inZ) leadIn
          outwards = map (level outZ) leadOut
      sent <-
        Compensation.sent
          (keyword region)
          milling
          side'
          Ways
            { Compensation.before,
              Compensation.inwards,
              Compensation.cut,
              Compensation.outwards,
              Compensation.behind = behind'
            }
      Right
        Cutting
          { job,
            pass =
              Pass
                { number,
                  reach = plus (touchedRadius milling) allowance,
                  left = allowance,
                  atHeight = z
                },
            approach = before <> inwards,
            cut,
            retract = outwards <> behind',
            rests,
            sent
          }

data Leading = LeadingIn | LeadingOut
  deriving stock (Eq)

-- | The way onto the path, or off it, from its end in a direction: straight on, or on a quarter of
-- a circle that curves away from the material.
leading :: Region -> Milling -> Maybe Carrier.Side -> Leading -> Vec.Vec -> Point -> [Move]
leading region milling side' which direction p =
  case if which == LeadingIn then Part.leadIn milling else Part.leadOut milling of
    Nothing -> []
    Just (Part.LeadLine, Mm l) ->
      let q =
            Vec.shift (Vec.scale (back * l) direction) p
       in [lead (pair (Straight q p) (Straight p q))]
    Just (Part.LeadArc, Mm r) ->
      let centre = Vec.shift (Vec.scale (free * r) (Vec.left direction)) p
          q = Vec.shift (Vec.scale (back * r) direction) centre
          turn = if free > 0 then CounterClockwise else Clockwise
       in [lead (pair (Segment.arc turn centre q p) (Segment.arc turn centre p q))]
  where
    back = if which == LeadingIn then -1 else 1
    pair onto off = if which == LeadingIn then onto else off
    lead s = Move s (Manner (Mm 0, Mm 0) (Part.At (feed milling)) False) (keyword region) False
    free = case side' of
      Just Carrier.RightOf -> -1
      _ -> 1 :: Double

-- | The cutter's ways along the contour itself on a side, by its elements, with so much left
-- standing; where material may stay, what stays.
along ::
  Located Milling ->
  Maybe Carrier.Side ->
  Vector Part.Element ->
  Mm ->
  Either Error (NonEmpty (NonEmpty Equidistant.OffsetSegment), [Equidistant.UnreachedPart])
along (Located region milling) side' numbered allowance = case side' of
  Nothing ->
    Right
      ( NonEmpty.zipWith
          (\i e -> Equidistant.OffsetSegment (Equidistant.Along i) (Part.segment e))
          (0 :| [1 ..])
          (elements (contour milling))
          :| [],
        []
      )
  Just s -> case (Equidistant.styled style s r outline, Part.rest milling) of
    (Right pieces, _) -> Right (pieces :| [], [])
    (Left _, Part.Allowed)
      | Just asked <- Part.byControl milling ->
        Left (NotForControl asked Unreached)
    (Left o, Part.Allowed) -> case Equidistant.reachableFitting style s r outline of
      ([], _) -> Left (NoPathAlong (keyword region) (contour milling) allowance)
      (_, []) -> Left (refusal o)
      (w : ws, rests) -> Right (fmap Equidistant.pieces (w :| ws), rests)
    (Left o, Part.Refused) -> Left (refusal o)
  where
    outline = Part.outline (contour milling)
    r = plus (radius milling) allowance
    style =
      Equidistant.CornerStyle
        { Equidistant.sharp = Part.corners milling == Part.Sharp,
          Equidistant.extra
        }
    -- Mostly nothing is left on any element by itself; then none need be looked at again.
    extra
      | plain = const (Mm 0)
      | otherwise = allowanceOf . (numbered Vector.!)
    !plain = all ((== Mm 0) . allowanceOf) numbered
    allowanceOf = Part.allowance . Part.finish
    refusal = OffsetRefusal.refusal region (RestMaterial.toolOf milling allowance) numbered
-- Else the outline is shared by all passes, and kept as long.
{-# NOINLINE along #-}

-- | The distance of the cutter's centre from the contour when nothing is left standing.
touchedRadius :: Milling -> Mm
touchedRadius milling = case value (side milling) of
  On -> Mm 0
  Outside -> radius milling
  Inside -> radius milling
  LeftSide -> radius milling
  RightSide -> radius milling

-- | The side of the walk on which the cutter stands; none when it runs on the contour. A turned
-- profile lies between the tool and the axis of the spindle, @y = 0@, when it is turned outside.
leadingSide :: Milling -> Either Error (Maybe Carrier.Side)
leadingSide milling = case (value (side milling), Part.ends (contour milling)) of
  (_, Part.Closed)
    | Part.work milling == Turned ->
      Left (TurnsClosed (region (side milling)) (value name) (region name))
  (LeftSide, _) -> Right (Just Carrier.LeftOf)
  (RightSide, _) -> Right (Just Carrier.RightOf)
  (On, _) -> Right Nothing
  (Outside, Part.Closed) ->
    Right (Just (if counterClockwise then Carrier.RightOf else Carrier.LeftOf))
  (Inside, Part.Closed) ->
    Right (Just (if counterClockwise then Carrier.LeftOf else Carrier.RightOf))
  (Outside, Part.Open)
    | Part.work milling == Turned ->
      Right (Just (if toTheRight then Carrier.LeftOf else Carrier.RightOf))
  (Inside, Part.Open)
    | Part.work milling == Turned ->
      Right (Just (if toTheRight then Carrier.RightOf else Carrier.LeftOf))
  (s, Part.Open) -> Left (SideOfOpen (region (side milling)) s (value name) (region name))
  where
    counterClockwise = Polyarc.areaOf Part.segment (elements (contour milling)) > 0
    toTheRight =
      Vec.x (Segment.end (Part.segment (NonEmpty.last (elements (contour milling)))))
        >= Vec.x (Segment.start (Part.segment (NonEmpty.head (elements (contour milling)))))
    name = Part.contourName (contour milling)

-- | What a statement asks has to make sense on its contour.
possible :: Region -> Milling -> Either Error ()
possible region milling
  | e : _ <-
      [ e
        | Part.work milling == Turned,
          let Mm slack = Tolerance.coincident,
          e <- list,
          lowest (Part.segment e) < -slack
      ] =
    Left (BelowAxis (keyword region) e)
  | value (side milling) == On
      && ( any (> Mm 0) (Part.allowances milling)
             || any ((> Mm 0) . Part.allowance . Part.finish) list
         ) =
    Left (AllowanceOnContour (keyword region))
  | otherwise = Right ()
  where
    list = NonEmpty.toList (elements (contour milling))
    lowest s = case s of
      Arc from _ centre _
        | Mm r <- Segment.radius centre from,
          Segment.spans s (Vec.point (Vec.x centre) (Vec.y centre - r)) ->
          Vec.y centre - r
      _ -> min (Vec.y (Segment.start s)) (Vec.y (Segment.end s))

-- | The contour walked so that the teeth meet the material as is asked: a spindle that turns
-- clockwise cuts climb with the material on the right of the walk.
oriented :: Region -> Milling -> Either Error Milling
oriented region milling = case Part.sense milling of
  Nothing -> Right milling
  Just (Located at sense) -> do
    now <- leadingSide milling
    let climbs = (sense == Part.Climb) == (Part.spin milling == Part.Clockwise)
        wanted = if climbs then Carrier.LeftOf else Carrier.RightOf
    case now of
      Nothing -> Left (SenseOnContour at (keyword region))
      Just side'
        | side' == wanted -> Right milling
        | value (side milling) `elem` [LeftSide, RightSide] ->
          Left (SenseAgainstSide at (region' (side milling)))
        | otherwise -> Right milling {contour = Part.backwards (contour milling)}
  where
    region' (Located r _) = r

-- Holes

-- | Over each hole at the clearance height, down at the feed, up in rapid.
holing :: SpacePoint -> Located Drilling -> [Move]
holing at (Located region d) =
  LinkingMove.rise at clear (keyword region)
    <> go (SpacePoint (plane at) (max clear (height at))) (NonEmpty.toList (Part.holes d))
  where
    clear = Part.clear d
    go from places = case places of
      [] -> []
      Located place p : rest ->
        let over = LinkingMove.ways from [Part.Stop (Located place p) (Just clear) Part.Rapid]
         in over
              <> [ Move down (Manner heights pace False) place False
                   | let down = Straight p p,
                     (heights, pace) <- strokes
                 ]
              <> go (SpacePoint p clear) rest
    -- Down and up, the same at each hole.
    strokes = concat (zipWith stroke (Nothing : map Just depths) depths)
    stroke before z =
      let start' = maybe clear (\b -> min clear (plus b peckGap)) before
       in [((clear, start'), Part.Rapid) | start' /= clear]
            <> [((start', z), Part.At (Part.drillFeed d)), ((z, clear), Part.Rapid)]
    depths = depthsOf d

-- | The depths to which a drill goes down, one after the other: equal pecks, none deeper than is
-- asked.
depthsOf :: Drilling -> [Mm]
depthsOf d = case Part.pecked d of
  Nothing -> [Part.bottom d]
  Just (Mm most) ->
    let Mm bottom = Part.bottom d
        count = max 1 (min 10000 (ceiling (-bottom / most - Tolerance.equal))) :: Int
     in [Mm (bottom * fromIntegral k / fromIntegral count) | k <- [1 .. count]]

-- | How far above the last depth a drill stops its way down in rapid.
peckGap :: Mm
peckGap = Mm 0.5

-- Ways that cut where they should not

-- | Moves that cut into a machined contour deeper than its tolerance: ways in and out and between,
-- and cuts along other contours. Cuts along the contour itself are the equidistant's concern. A
-- move wholly above the top of the part cuts nothing.
intrusions :: Toolpath -> [Error]
intrusions path = worst (concatMap inBlock (Toolpath.blocks path))
  where
    -- Of a stop that cuts in several places or passes the worst.
    worst errors =
      map
        (minimumBy (comparing depth))
        (Map.elems (Map.fromListWith (flip (<>)) [(placeOf e, [e]) | e <- errors]))
    placeOf e = case e of
      CutsPart at _ _ _ _ _ -> at
      HoleCuts at _ _ _ -> at
      MillsAnother at _ _ _ _ -> at
      _ -> Region 0 0
    jobs =
      map
        NonEmpty.head
        (NonEmpty.groupBy ((==) `on` (\(n, _, _) -> n)) (mapMaybe wallsOf (Toolpath.blocks path)))
    wallsOf b = case b of
      Cutting {job = Located _ milling, pass}
        | value (side milling) /= On ->
          Just (number pass, milling, [contour milling])
      Clearing {pocket = Located _ p, pass} ->
        Just (number pass, Part.wall p, contour (Part.wall p) : Part.islands p)
      _ -> Nothing
    index =
      BoxTree.index
        (BoxTree.around . snd)
        [ ( (n, milling),
            BoxTree.index boxOf (concatMap (grouped . NonEmpty.toList . elements) walls)
          )
          | (n, milling, walls) <- jobs
        ]
    -- A box for each element would take more memory than the elements, and few are asked for: a box
    -- is about some, from one on.
    grouped es = case es of
      [] -> []
      e : rest -> (e :| rest) : grouped (drop some es)
    boxOf (e :| es) =
      foldl'
        (\box other -> BoundingBox.union box (BoundingBox.ofSegment (Part.segment other)))
        (BoundingBox.ofSegment (Part.segment e))
        (take (some - 1) es)
    some = 16
    inBlock b = case b of
      Commanding _ -> []
      Travelling tool ms -> concatMap (intrusion tool Nothing) ms
      Holing (Located _ d) ms -> map hole (concatMap (intrusion (Part.drillRadius d) Nothing) ms)
      Cutting {job = Located at milling, pass, approach, cut, retract} ->
        concatMap
          ( intrusionLeaving
              (Just (number pass, minimum (Part.allowances milling)))
              (radius milling)
              Nothing
          )
          (approach <> retract)
          <> take
            1
            ( concatMap
                (map (another (keyword at)) . intrusion (radius milling) (Just (number pass)))
                (if isAlone (number pass) then [] else NonEmpty.toList cut)
            )
      Clearing {pocket = Located at p, approach, cleared, retract} ->
        let tool = radius (Part.wall p)
         in concatMap (intrusion tool Nothing) (approach <> retract)
              <> take
                1
                ( concatMap
                    (map (another (LinkingMove.keyword 6 at)) . intrusion tool Nothing)
                    (NonEmpty.toList cleared)
                )
    -- Where nothing else is machined the cuts along a contour meet nothing else.
    isAlone own = all (\(n, _, _) -> n == own) jobs
    -- A cut along another contour is no way that could be chosen otherwise.
    another word e = case e of
      CutsPart milled _ element deep _ p -> MillsAnother word milled element deep p
      _ -> e
    hole e = case e of
      CutsPart at way element deep _ _ -> HoleCuts at (Segment.end way) element deep
      _ -> e
    intrusion = intrusionLeaving Nothing
    -- On the contour of one statement, by its number, so much is left in the end.
    intrusionLeaving leaving tool own m
      | fst (Toolpath.heights m) > top && snd (Toolpath.heights m) > top = []
      | otherwise =
        nubBy
          samePlace
          (map deepest (groupBy ((==) `on` fst) (sortOn fst (hits leaving tool own m))))
    -- The axis of a blade may stand above the top of the part while the blade is in it.
    top = maximum (Mm 0 : [Swivel.highest milling | (_, milling, _) <- jobs])
    -- A contour that is milled several times is cut once.
    samePlace e f = case (e, f) of
      (CutsPart _ _ _ _ _ p, CutsPart _ _ _ _ _ q) -> Vec.near p q
      _ -> False
    hits leaving tool own m =
      [ ( n,
          CutsPart
            (Toolpath.origin m)
            (Toolpath.segment m)
            element
            (minus (if how == Taking then kept else tool) d)
            how
            p
        )
        | let reach =
                BoundingBox.inflate
                  (plus tool (maybe (Mm 0) snd leaving))
                  (BoundingBox.ofSegment (Toolpath.segment m)),
          ((n, milling), walls) <- BoxTree.within reach index,
          Just n /= own,
          group <- BoxTree.within reach walls,
          element <- NonEmpty.take some group,
          BoundingBox.meets reach (BoundingBox.ofSegment (Part.segment element)),
          let ClosestPoint d p = Distance.segments (Toolpath.segment m) (Part.segment element),
          let allowed = plus (fst (Part.deepest (Part.tolerance milling))) Tolerance.clearance,
          let kept = case leaving of Just (leaver, left) | n == leaver -> plus tool left; _ -> tool,
          let how = intrusionAt d (plus d allowed < tool),
          plus d allowed < kept
            || d <= Tolerance.coincident
              && goesThrough allowed (Toolpath.segment m) (Part.segment element)
      ]
    intrusionAt d isDeep
      | d <= Tolerance.coincident = Crossing
      | isDeep = CuttingIn
      | otherwise = Taking
    -- A point of a tool cuts nothing beside it.
    goesThrough most way wall = case wall of
      Straight a b ->
        let aside q = Mm (Vec.cross (Vec.unit (Vec.to a b)) (Vec.to a q))
         in opposite most (aside (Segment.start way)) (aside (Segment.end way))
      Arc from _ centre _ ->
        let r = Segment.radius centre from
            beyond q = minus (Vec.distance centre q) r
            ends = (beyond (Segment.start way), beyond (Segment.end way))
         in uncurry (opposite most) ends
              || fst ends > Mm 0 && snd ends > Mm 0 && minus r (Distance.toPoint centre way) > most
    opposite :: Mm -> Mm -> Mm -> Bool
    opposite most p q = min p q < times (-1) most && max p q > most
    deepest found = minimumBy (comparing depth) (map snd found)
    depth e = case e of
      CutsPart _ _ _ (Mm d) _ _ -> -d
      HoleCuts _ _ _ (Mm d) -> -d
      MillsAnother _ _ _ (Mm d) _ -> -d
      _ -> 0

-- | The first word of a statement that mills or turns.
keyword :: Region -> Region
keyword = LinkingMove.keyword 4
