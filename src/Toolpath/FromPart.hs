{-# LANGUAGE BangPatterns #-}

-- | From the part to the toolpath: the offset of every contour to be machined, pass by pass, with
-- approaches and retracts, holes, and the linking moves between them.
--
-- A milling statement becomes one block for each pass. "Toolpath.CuttingPass" makes the moves of a
-- pass, "Toolpath.PocketMove" those of a pocket, "Toolpath.DrillMove" those of holes. A toolpath
-- that cuts a contour where the program does not allow it is refused ("Toolpath.Intrusion").
module Toolpath.FromPart
  ( toToolpath,
    leadingSide,
    touchedRadius,
  )
where

import Base.Quantity (Mm (..), plus)
import Base.Region (Located (..), Region (..))
import Base.Result (Result (..))
import Control.Monad (foldM)
import Data.Bifunctor (first)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, listToMaybe, mapMaybe)
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier qualified as Carrier
import Geometry.Vec qualified as Vec
import Offset.Equidistant qualified as Equidistant
import Part.Part
  ( Contour (elements),
    Milling (contour, radius),
    Operation (..),
    Part,
    SpacePoint (..),
    Work (..),
  )
import Part.Part qualified as Part
import Toolpath.CuttingPass (CuttingPass (CuttingPass), touchedRadius)
import Toolpath.CuttingPass qualified as CuttingPass
import Toolpath.DrillMove qualified as DrillMove
import Toolpath.Error (Error (..), Unsupported (..), Warning (..))
import Toolpath.Error qualified as Error
import Toolpath.Intrusion qualified as Intrusion
import Toolpath.LinkingMove qualified as LinkingMove
import Toolpath.MillingSide (keyword, leadingSide, oriented, possible)
import Toolpath.OffsetRefusal qualified as OffsetRefusal
import Toolpath.PocketMove qualified as PocketMove
import Toolpath.RestMaterial (Remaining (Remaining, positions, tool, word))
import Toolpath.RestMaterial qualified as RestMaterial
import Toolpath.Toolpath (Block (..), Toolpath (Toolpath))
import Toolpath.Toolpath qualified as Toolpath
import Toolpath.Warning qualified as Warning

-- | Computes the toolpath of a part. There is no toolpath when an operation fails. Nor is there one
-- when the part has operations but no start, which an earlier compiler pass reports. A part
-- without operations has a toolpath without moves.
toToolpath :: Part -> Result Warning Error Toolpath
toToolpath part = case (Part.start part, Part.operations part) of
  (Nothing, []) ->
    Result
      []
      []
      (Just (Toolpath (Located (Region 0 0) (SpacePoint (Vec.point 0 0) (Mm 0))) [] False))
  (Nothing, _) -> Result [] [] Nothing
  -- The operations are consumed one by one, so that each can be freed after its blocks are made.
  (Just begin, operations) | !tool <- maybe (Mm 0) Part.cutterRadius (Part.firstCutter part) ->
    case collect 0 tool (value begin) operations of
      ([], blocks) ->
        let path = Toolpath begin blocks (turns part)
            wrong = Intrusion.intrusions path
         in Result
              (restWarnings path <> (if null wrong then Warning.warnings path else []))
              wrong
              (Just path)
      (errors, _) -> Result [] errors Nothing

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

-- | The blocks of operations in order, and the errors of those that fail. The arguments are the
-- number of the next milling or pocket statement, the radius of the tool, and its position. An
-- operation that fails does not move the tool.
collect :: Int -> Mm -> SpacePoint -> [Operation] -> ([Error], [Block])
collect number tool at operations = case operations of
  [] -> ([], [])
  o : rest -> case blocksOf number tool at o of
    Left e -> first (e :) (collect next tool' at rest)
    Right bs ->
      (bs <>) <$> collect next tool' (LinkingMove.endPosition at (concatMap Toolpath.moves bs)) rest
    where
      !next = case o of
        Mill _ -> number + 1
        Pocket _ -> number + 1
        _ -> number
      !tool' = case o of
        Command (Located _ (Part.ChangeTool _ c)) -> Part.cutterRadius c
        _ -> tool

-- | The blocks of one operation, with the arguments of 'collect'.
blocksOf :: Int -> Mm -> SpacePoint -> Operation -> Either Error [Block]
blocksOf number tool at operation = case operation of
  Travel stops -> Right [Travelling tool (LinkingMove.straightMoves at (NonEmpty.toList stops))]
  Command c -> Right [Commanding c]
  Drill d -> Right [Holing d (DrillMove.moves at d)]
  Pocket job -> PocketMove.blocks number at job
  Mill (Located region given) -> do
    possible region given
    milling <- withoutWrittenElements <$> oriented region given
    if null (Part.levels milling) && heightOf milling > Mm 0
      then Left (CutsAir (keyword region) (heightOf milling))
      else do
        side <- leadingSide milling
        passBlocks number at (Located region milling) side (passesOf milling)
  where
    -- The contour as written is not needed any more; it takes much memory.
    withoutWrittenElements milling =
      milling {contour = (contour milling) {Part.writtenElements = []}}
    -- A statement without a depth mills at the height of its last approach point that has one, or
    -- else at the current height.
    heightOf milling =
      fromMaybe (height at) (listToMaybe (mapMaybe Part.level (reverse (Part.approach milling))))
    passesOf milling =
      [ (a, z)
        | a <- NonEmpty.toList (Part.allowances milling),
          z <- if null (Part.levels milling) then [heightOf milling] else Part.levels milling
      ]

-- | The blocks of all passes of a milling statement, whose number is the first argument. The
-- position is that of the cutter before the statement. Each pass is given by its allowance and its
-- height.
passBlocks ::
  Int ->
  SpacePoint ->
  Located Milling ->
  Maybe Carrier.Side ->
  [(Mm, Mm)] ->
  Either Error [Block]
passBlocks number at job side passes =
  reverse . snd <$> foldM pass (at, []) (zip [1 ..] passes)
  where
    -- All passes share one array. A contour may have many elements, which as a list are scattered
    -- over memory.
    numbered =
      let es = elements (contour (value job))
       in Vector.fromListN (NonEmpty.length es) (NonEmpty.toList es)
    count = length passes
    pass before (k, (allowance, level)) = do
      (paths, rests) <- along job side numbered allowance
      let !pathCount = length paths
          cut (from, done) (n, path) = do
            b <-
              CuttingPass.block
                CuttingPass
                  { CuttingPass.statement = number,
                    CuttingPass.milled = job,
                    CuttingPass.cutterSide = side,
                    CuttingPass.numbered,
                    CuttingPass.isFirst = k == 1 && n == 1,
                    CuttingPass.isLast = k == count && n == pathCount,
                    CuttingPass.from,
                    CuttingPass.allowance,
                    CuttingPass.level,
                    CuttingPass.restMaterial = if n == 1 then rests else []
                  }
                path
            Right (LinkingMove.endPosition from (Toolpath.moves b), b : done)
      foldM cut before (zip [1 :: Int ..] (NonEmpty.toList paths))

-- | The paths of the cutter's centre beside a contour, or on it when there is no side, with an
-- allowance. There are several paths only where rest material is allowed and occurs; the second
-- result is that rest material.
along ::
  Located Milling ->
  Maybe Carrier.Side ->
  Vector Part.Element ->
  Mm ->
  Either Error (NonEmpty (NonEmpty Equidistant.OffsetSegment), [Equidistant.UnreachedPart])
along (Located region milling) side numbered allowance = case side of
  Nothing ->
    Right
      ( NonEmpty.zipWith
          (\i e -> Equidistant.OffsetSegment (Equidistant.Along i) (Part.segment e))
          (0 :| [1 ..])
          (elements (contour milling))
          :| [],
        []
      )
  Just s -> case (Equidistant.styled style s r polyarcOf, Part.rest milling) of
    (Right pieces, _) -> Right (pieces :| [], [])
    (Left _, Part.Allowed)
      | Just elementFinish <- Part.controlCompensation milling ->
        Left (NotForControl elementFinish Unreached)
    (Left o, Part.Allowed) -> case Equidistant.reachableFitting style s r polyarcOf of
      ([], _) -> Left (NoPathAlong (keyword region) (contour milling) allowance)
      (_, []) -> Left (refusal o)
      (p : ps, rests) -> Right (fmap Equidistant.pieces (p :| ps), rests)
    (Left o, Part.Refused) -> Left (refusal o)
  where
    polyarcOf = Part.polyarcOf (contour milling)
    r = plus (radius milling) allowance
    style =
      Equidistant.CornerStyle
        { Equidistant.sharp = Part.corners milling == Part.Sharp,
          Equidistant.extra
        }
    -- Mostly no element has an allowance of its own, and then the allowances are not looked up.
    extra
      | hasNoAllowances = const (Mm 0)
      | otherwise = allowanceOf . (numbered Vector.!)
    !hasNoAllowances = all ((== Mm 0) . allowanceOf) numbered
    allowanceOf = Part.allowance . Part.finish
    refusal = OffsetRefusal.refusal region (RestMaterial.toolOf milling allowance) numbered
-- If this were inlined, all passes would share the polyarc of the contour and keep it in memory.
{-# NOINLINE along #-}
