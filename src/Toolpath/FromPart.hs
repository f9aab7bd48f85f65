-- | From the part to the toolpath: the offset of every contour to be machined, pass by pass, with
-- approaches and retracts, holes, and the linking moves between them.
--
-- A milling statement becomes one block for each pass. "Toolpath.CuttingPass" makes the moves of a
-- pass, "Toolpath.PocketMove" those of a pocket, "Toolpath.DrillMove" those of holes,
-- "Toolpath.CarvingPath" those of a V-carving. A toolpath that cuts a contour where the program
-- does not allow it is refused ("Toolpath.Intrusion").
module Toolpath.FromPart
  ( toToolpath,
    leadingSide,
    touchedRadius,
  )
where

import Base.Quantity (Mm (..), minus, plus)
import Base.Region (Located (..), Region (..))
import Base.Result (Result (..))
import Control.Monad (foldM)
import Data.Bifunctor (first)
import Data.List (tails)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, isJust, listToMaybe, mapMaybe)
import Data.Semigroup (sconcat)
import Data.Set qualified as Set
import Data.Vector qualified as Vector
import Geometry.Carrier qualified as Carrier
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec
import Part.Part
  ( Contour (elements),
    Milling (contour),
    Operation (..),
    Part,
    SpacePoint (..),
    Work (..),
  )
import Part.Part qualified as Part
import Toolpath.CarvingArea (CarvedArea)
import Toolpath.CarvingArea qualified as CarvingArea
import Toolpath.CarvingPath qualified as CarvingPath
import Toolpath.CuttingPass (CuttingPass (CuttingPass), touchedRadius)
import Toolpath.CuttingPass qualified as CuttingPass
import Toolpath.DrillMove qualified as DrillMove
import Toolpath.Error (Error (..), Warning (..))
import Toolpath.Error qualified as Error
import Toolpath.FeedRate qualified as FeedRate
import Toolpath.Intrusion qualified as Intrusion
import Toolpath.LinkingMove qualified as LinkingMove
import Toolpath.MillingSide (keyword, leadingSide, oriented, possible)
import Toolpath.MoveOver qualified as MoveOver
import Toolpath.OffsetPath qualified as OffsetPath
import Toolpath.PocketMove qualified as PocketMove
import Toolpath.RestMaterial (Remaining (Remaining, positions, tool, word))
import Toolpath.RestMaterial qualified as RestMaterial
import Toolpath.Tab qualified as Tab
import Toolpath.Toolpath (Block (..), Setup (Setup), Toolpath (Toolpath))
import Toolpath.Toolpath qualified as Toolpath
import Toolpath.Warning qualified as Warning

-- | Computes the toolpath of a part. There is no toolpath when an operation fails, or when the part
-- has operations but no start; an earlier compiler pass reports the missing start. A part without
-- operations has a toolpath without moves.
toToolpath :: Part -> Result Warning Error Toolpath
toToolpath part = case (Part.start part, Part.operations part) of
  (Nothing, []) ->
    Result
      []
      []
      (Just (Toolpath nowhere [] False (setupOf part) (Part.unit part)))
  (Nothing, _) -> Result [] [] Nothing
  (Just begin, operations) ->
    case collect (firstState part (value begin)) (FeedRate.withRates operations) of
      ([], blocks) ->
        let setup = setupOf part
            over = MoveOver.overSolids (Toolpath.avoided setup) (Toolpath.withTools setup blocks)
            path = Toolpath begin over (turns part) setup (Part.unit part)
            errors = Intrusion.intrusions path
         in Result
              (restWarnings path <> (if null errors then others path else []))
              errors
              (Just path)
      (errors, _) -> Result [] errors Nothing
  where
    others path = idleWarnings part path <> Warning.warnings path
    nowhere = Located (Region 0 0) (SpacePoint (Vec.point 0 0) (Mm 0))

-- | The settings of the whole program.
setupOf :: Part -> Setup
setupOf part =
  Setup
    { Toolpath.partName = Part.name part,
      Toolpath.partTitle = fromMaybe "" (Part.title part),
      Toolpath.firstCutter = Part.firstCutter part,
      Toolpath.firstToolNumber = Part.firstToolNumber part,
      Toolpath.workOffset = Part.workOffset part,
      Toolpath.programNumber = Part.programNumber part,
      Toolpath.safeHeight = Part.safeHeight part,
      Toolpath.stock = fmap asTurned <$> Part.stock part,
      Toolpath.avoided = map (fmap asTurned) (Part.avoided part)
    }
  where
    -- On a lathe all moves are in one plane, and solids have no heights.
    asTurned s
      | turns part = s {Part.lowest = minus (Mm 0) Tolerance.reach, Part.highest = Tolerance.reach}
      | otherwise = s

-- | True if the part is turned on a lathe: a statement turns, or there is a turning tool.
turns :: Part -> Bool
turns part = or [isTurning c | Just c <- [Part.firstCutter part]] || any asks (Part.operations part)
  where
    asks operation = case operation of
      Mill (Located _ milling) -> Part.work milling == Turned
      Command (Located _ (Part.ChangeTool _ c)) -> isTurning c
      _ -> False
    isTurning c = Part.kind c == Part.TurningCutter

-- | The warnings about rest material beside contours. A statement that is executed several times
-- with the same cutter and allowance gets one warning.
restWarnings :: Toolpath -> [Warning]
restWarnings path =
  [ LeavesRestMaterial word tool (concatMap (map fst . NonEmpty.toList . positions) (r : more))
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

-- | The warnings about statements that clear the rest of a pocket and find nothing to clear, not
-- even in one part of a region.
idleWarnings :: Part -> Toolpath -> [Warning]
idleWarnings part path =
  Map.elems
    ( Map.fromList
        [ (region, NothingLeft (LinkingMove.pocketKeyword job) (LinkingMove.keyword 6 rough))
          | Pocket job@(Located region p) <- Part.operations part,
            region `Set.notMember` moving,
            Just Part.Roughing {Part.roughedAt = rough} <- [Part.roughing p]
        ]
    )
  where
    moving = Set.fromList [region | Clearing {pocket = Located region _} <- Toolpath.blocks path]

-- | The state between two operations. The fields are strict, so that a state has no reference to
-- the operations before it.
data State = State
  { -- | number of the next milling or pocket statement, from 0
    number :: Int,
    -- | radius of the tool in the spindle
    toolRadius :: Mm,
    -- | position of the tool
    at :: SpacePoint,
    -- | the areas of the V-carvings that are still to come
    carvedAreas :: [NonEmpty CarvedArea]
  }

-- | The state before the first operation, given the start. Without a cutter the radius is 0.
firstState :: Part -> SpacePoint -> State
firstState part begin =
  State
    { number = 0,
      toolRadius = maybe (Mm 0) Part.cutterRadius (Part.firstCutter part),
      at = begin,
      carvedAreas = CarvingArea.ofCarvings [c | Carve (Located _ c) <- Part.operations part]
    }

-- | The state after an operation; @bs@ are the blocks of the operation. An operation that fails has
-- no blocks, and does not move the tool.
stateAfter :: Operation -> [Block] -> State -> State
stateAfter operation bs State {number, toolRadius, at, carvedAreas} =
  State
    { number = case operation of
        Mill _ -> number + 1
        Pocket _ -> number + 1
        _ -> number,
      toolRadius = case operation of
        Command (Located _ (Part.ChangeTool _ c)) -> Part.cutterRadius c
        _ -> toolRadius,
      at = LinkingMove.endPosition at (concatMap Toolpath.moves bs),
      carvedAreas = case operation of
        Carve _ -> drop 1 carvedAreas
        _ -> carvedAreas
    }

-- | The blocks of operations in order, and the errors of those that fail.
collect :: State -> [Operation] -> ([Error], [Block])
collect state operations = case operations of
  [] -> ([], [])
  o : rest -> case blocksOf state o of
    Left e -> first (e :) (collect (stateAfter o [] state) rest)
    Right bs -> (bs <>) <$> collect (stateAfter o bs state) rest

-- | The blocks of one operation, or the error by which it fails.
blocksOf :: State -> Operation -> Either Error [Block]
blocksOf State {number, toolRadius, at, carvedAreas} operation = case operation of
  Travel stops ->
    let ends = NonEmpty.toList stops
     in Right [Travelling toolRadius ends (LinkingMove.straightMoves at ends)]
  Command c -> Right [Commanding c]
  Drill d -> Right [Holing d (DrillMove.moves at d)]
  Carve c ->
    (\(ms, rest) -> [Carved c ms rest])
      <$> CarvingPath.moves (concatMap NonEmpty.toList (take 1 carvedAreas)) at c
  Pocket job -> PocketMove.blocks number at job
  Mill (Located region given) -> do
    possible region given
    milling <- withoutWrittenElements <$> oriented region given
    if null (Part.levels milling) && heightOf milling > Mm 0
      then Left (CutsAir (keyword milling region) (heightOf milling) (lastHeight milling))
      else do
        side <- leadingSide milling
        first (roundable milling given) $
          passBlocks number at (Located region milling) side (passesOf milling)
  where
    -- The contour as written is not needed any more; it takes much memory.
    withoutWrittenElements milling =
      milling {contour = (contour milling) {Part.writtenElements = []}}
    -- A statement without a depth mills at the height of its last approach point that has one, or
    -- else at the current height.
    heightOf milling =
      fromMaybe (height at) (listToMaybe (mapMaybe Part.level (reverse (Part.approach milling))))
    lastHeight milling =
      listToMaybe [Part.place s | s <- reverse (Part.approach milling), isJust (Part.level s)]
    passesOf milling =
      [ (a, heights)
        | a <- NonEmpty.toList (Part.allowances milling),
          heights <- case Part.levels milling of
            [] -> [(heightOf milling, heightOf milling)]
            zs -> zip (Part.materialTop milling : zs) zs
      ]

-- | Marks an inner corner at which the program may write a fillet: the contour is milled as
-- written, and the element before the corner is no point and has no link. @milling@ is the milling
-- without the written elements, @given@ the one with them.
roundable :: Milling -> Milling -> Error -> Error
roundable milling given e = case e of
  InnerCorner word tool a b p largest _ ->
    InnerCorner word tool a b p largest $
      elements (contour milling) == elements (contour given)
        && or
          [ True
            | Part.ContourElement {Part.elementRegion, Part.elementCarrier, Part.link = Nothing} <-
                Part.writtenElements (contour given),
              elementRegion == Part.origin a,
              isEdge elementCarrier
          ]
  _ -> e
  where
    isEdge carrier = case carrier of
      OnLine _ -> True
      OnCircle _ _ -> True
      OnCurve _ -> True
      AtPoint _ -> False

-- | The blocks of all passes of a milling statement. @number@ is the number of the statement in the
-- order of execution, from 0. @at@ is the position of the cutter before the statement. @side@ is
-- the cutter's side of the contour; Nothing when its centre moves on the contour. Each pass is
-- given by its allowance, the height down to which the material is cut before it, and its height.
passBlocks ::
  Int ->
  SpacePoint ->
  Located Milling ->
  Maybe Carrier.Side ->
  [(Mm, (Mm, Mm))] ->
  Either Error [Block]
passBlocks number at job side passes = do
  tabCentres <- tabsOf job side numbered
  reverse . snd <$> foldM (pass tabCentres) (at, []) (zip [1 :: Int ..] passes)
  where
    -- All passes share one array, because the many elements of a contour, as a list, would be
    -- scattered over memory.
    numbered =
      let es = elements (contour (value job))
       in Vector.fromListN (NonEmpty.length es) (NonEmpty.toList es)
    count = length passes
    pass tabCentres before (k, (allowance, (above, level))) = do
      (paths, rests) <- OffsetPath.paths job side numbered allowance
      let cut (from, done) (isFirstPath, isLastPath, path) = do
            b <-
              CuttingPass.block
                CuttingPass
                  { CuttingPass.statement = number,
                    CuttingPass.milled = job,
                    CuttingPass.cutterSide = side,
                    CuttingPass.numbered,
                    CuttingPass.isFirst = k == 1 && isFirstPath,
                    CuttingPass.isLast = k == count && isLastPath,
                    CuttingPass.from,
                    CuttingPass.allowance,
                    CuttingPass.level,
                    CuttingPass.above,
                    CuttingPass.tabCentres,
                    CuttingPass.restMaterial = if isFirstPath then rests else []
                  }
                path
            Right (LinkingMove.endPosition from (Toolpath.moves b), b : done)
      foldM cut before (withEnds paths)

-- | The positions of the cutter's centre in the middles of the tabs of a statement, on the path of
-- its last allowance. All passes have their tabs there.
tabsOf ::
  Located Milling -> Maybe Carrier.Side -> Vector.Vector Part.Element -> Either Error [Vec.Point]
tabsOf job side numbered = case (Part.tabs milling, Part.levels milling) of
  (Just (Located at tabs), lowest : more) -> do
    let left = NonEmpty.last (Part.allowances milling)
        bottom = NonEmpty.last (lowest :| more)
    (paths, _) <- OffsetPath.paths job side numbered left
    first
      (NoTab at (Tab.raisedLength tabs (Part.radius milling) bottom))
      ( Tab.chosen
          tabs
          (Part.radius milling)
          (plus (touchedRadius milling) left)
          bottom
          (sconcat paths)
      )
  _ -> Right []
  where
    milling = value job

-- | Each item with two flags: true for the first one, and true for the last one.
withEnds :: NonEmpty a -> [(Bool, Bool, a)]
withEnds (item :| others) =
  zip3 (True : repeat False) (map null (tails others)) (item : others)
