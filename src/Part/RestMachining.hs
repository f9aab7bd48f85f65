-- | Evaluates rest machining: the clearing of what a larger cutter has left in a pocket, or of the
-- floor that a V-carving has left.
module Part.RestMachining
  ( restOf,
  )
where

import Base.Crash (bug)
import Base.Quantity (Mm (..), over, plus, times)
import Base.Region (Located (..), Region)
import Checked.Syntax (Expr)
import Checked.Syntax qualified as Checked
import Control.Monad (filterM)
import Data.List.NonEmpty qualified as NonEmpty
import Part.Error (CutterStatement (RestStatement), Error (..), ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression qualified as Expression
import Part.Machining (Context (..))
import Part.Machining qualified as Machining
import Part.Measure (lengthOf)
import Part.Parameter qualified as Parameter
import Part.Part
import Part.PlaneRegion (PlaneRegion (PlaneRegion))
import Part.PlaneRegion qualified as PlaneRegion
import Part.PocketCheck qualified as PocketCheck
import Part.PocketError
  ( EarlierOperation (..),
    PocketMisfit
      ( NoFloor,
        RestElsewhere,
        RestNotSmaller,
        RestTooDeep,
        RestWithoutDepth,
        StepTooWide
      ),
  )
import Part.RegionBuiltin qualified as RegionBuiltin
import Part.Value (MachinedBefore (..), NamedOperation (..), Value (..))

-- | Evaluates the clearing of what the operation @e@ has left. @at@ is the region of the statement
-- and @step@ the expression of the stepover. Without a depth it has the passes of the pocket, or
-- the depth of the V-carving.
restOf :: Context -> Region -> Expr -> Expr -> Checked.Settings -> Eval (Maybe [Pocketing])
restOf context at e step settings = do
  Machining.checkCutter context at RestStatement
  v <- Expression.evaluate (environment context) e
  let operation = case v of
        OperationValue o -> o
        _ -> bug "a value that is no operation where one was checked"
  case machinedBefore operation of
    Pockets pockets -> restOfPockets context at (e, step, settings) operation pockets
    Carved c -> floorsOf context at (e, step, settings) operation c

-- | The expressions of a statement: what it clears, its stepover, and its settings.
type Arguments = (Expr, Expr, Checked.Settings)

-- | Evaluates the clearing of what an operation has left in its pockets.
restOfPockets ::
  Context -> Region -> Arguments -> NamedOperation -> [Pocketing] -> Eval (Maybe [Pocketing])
restOfPockets context at (e, step, settings) operation pockets = do
  stepover <- lengthOf (environment context) Parameter.Stepover step
  let diameter = times 2 . cutterRadius <$> cutter context
      tooWide = [StepTooWide (region step) stepover d | Just d <- [diameter], stepover > d]
  found <- traverse (restIn context at e settings) pockets
  let lowest =
        [ (lowestOf (wall rough), lowestOf own)
          | Just (rough, own) <- found,
            not (null (levels (wall rough)))
        ]
      unfit = misfits context (region e) operation (map wall pockets)
  case unfit <> tooWide <> tooDeep settings EarlierPocket operation lowest of
    [] -> do
      sequence_ [Machining.checkPassCount (region step) (count stepover p) | Just p <- found]
      pure (map (afterwards operation stepover) <$> sequence found)
    faults -> refused faults
  where
    count stepover (rough, _) =
      over (plus (radius (wall rough)) (allowanceOf rough)) stepover

refused :: [PocketMisfit] -> Eval a
refused faults = Evaluation.mistakes [Error (InPocket m) [] [] | m <- faults]

-- | Evaluates the clearing of the floors that a V-carving has left. They are the points that are at
-- least as far from the contours as the axis of the cone at its largest depth. Floors into which
-- the cutter does not fit are left out.
floorsOf ::
  Context -> Region -> Arguments -> NamedOperation -> Carving -> Eval (Maybe [Pocketing])
floorsOf context at (e, step, settings) operation c
  | isElsewhere operation = refused [RestElsewhere EarlierCarving (region e) there]
  | otherwise = do
    floors <- concat <$> traverse (inset (carvingReach c)) (NonEmpty.toList (carvedAreas c))
    wide <- filterM fits floors
    case (cutter context, wide) of
      (Just t, []) -> refused [NoFloor (region e) there (times 2 (cutterRadius t))]
      _ -> do
        pockets <- traverse pocketOf wide
        let lowest = [(bottom, lowestOf (wall p)) | Just p <- pockets]
        case tooDeep settings EarlierCarving operation lowest of
          [] -> pure (map deepened <$> sequence pockets)
          faults -> refused faults
  where
    there = operationAt operation
    bottom = times (-1) (carvingDepth c)
    inset d (outline, holes') = do
      let name = contourName outline
      PlaneRegion found <-
        RegionBuiltin.settled (region e) $
          PlaneRegion.offsetBy (region e) name (times (-1) d) (outline : holes')
      pure [(PlaneRegion.outer p, PlaneRegion.holes p) | p <- found]
    fits part' = case cutter context of
      Nothing -> pure True
      Just t -> not . null <$> inset (cutterRadius t) part'
    pocketOf (outline, holes') =
      Machining.pocketIn context at step settings (named outline) (map named holes')
    named = PocketCheck.Named (region e)
    deepened p
      | null (levels (wall p)) = p {wall = (wall p) {levels = [bottom]}}
      | otherwise = p

-- | The faults of clearing what an operation has left in its pockets: it is outside of a
-- transformation around this statement, it has no depth, or its cutter is not larger. @at@ is the
-- region of its name.
misfits :: Context -> Region -> NamedOperation -> [Milling] -> [PocketMisfit]
misfits context at operation walls =
  [RestElsewhere EarlierPocket at there | isElsewhere operation]
    <> take
      1
      ( [RestWithoutDepth at there | p <- walls, null (levels p)]
          <> [ RestNotSmaller at there (cutterRadius c) (radius p)
               | p <- walls,
                 Just c <- [cutter context],
                 cutterRadius c >= radius p
             ]
      )
  where
    there = operationAt operation

-- | The fault of a depth below that of an earlier operation. The pairs are the lowest heights of
-- both.
tooDeep :: Checked.Settings -> EarlierOperation -> NamedOperation -> [(Mm, Mm)] -> [PocketMisfit]
tooDeep settings kind operation heights =
  take
    1
    [ RestTooDeep kind (region depth) (operationAt operation) own before
      | Just (depth, _) <- [Checked.depth settings],
        (before, own) <- heights,
        own < before
    ]

-- | The height of the lowest pass of a milling with a depth.
lowestOf :: Milling -> Mm
lowestOf = foldr min (Mm 0) . levels

-- | The allowance that a pocket leaves in the end.
allowanceOf :: Pocketing -> Mm
allowanceOf = NonEmpty.last . allowances . wall

-- | Evaluates the settings of a statement that clears what the statement @e@ has left in a pocket.
-- The result has this pocket and the milling of its wall with these settings.
restIn ::
  Context -> Region -> Expr -> Checked.Settings -> Pocketing -> Eval (Maybe (Pocketing, Milling))
restIn context at e settings rough = do
  let outline = contour (wall rough)
  Evaluation.spend at (sum (map (length . elements) (outline : islands rough)))
  found <- Machining.millingOf context Milled at settings outline (Located (region e) Inside)
  pure ((rough,) <$> found)

-- | The clearing of what a pocket has left, with this milling of its wall.
afterwards :: NamedOperation -> Mm -> (Pocketing, Milling) -> Pocketing
afterwards operation stepover (rough, own) =
  rough
    { wall = own {levels = if null (levels own) then levels (wall rough) else levels own},
      stepover,
      extent =
        RestOfPocket
          Roughing
            { roughedAt = operationAt operation,
              roughRadius = radius (wall rough),
              roughAllowance = allowanceOf rough,
              roughedDownTo = lowestOf (wall rough)
            }
    }
