-- | Evaluates rest machining: the clearing of what a larger cutter has left in a pocket, or of the
-- floor that a V-carving has left.
module Part.RestMachining
  ( restOf,
  )
where

import Base.Crash (bug)
import Base.Quantity (Mm (..), minus, over, plus, times)
import Base.Region (Located (..), Region)
import Checked.Syntax (Expr)
import Checked.Syntax qualified as Checked
import Control.Monad (filterM)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (catMaybes)
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
import Part.Tolerance qualified as Tolerance
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

-- | Evaluates the clearing of the floors that a V-carving has left, one in each of its areas. The
-- cutter leaves the room that the flank of the tool has at its largest depth. Areas whose floor it
-- does not fit are left out.
floorsOf ::
  Context -> Region -> Arguments -> NamedOperation -> Carving -> Eval (Maybe [Pocketing])
floorsOf context at (e, step, settings) operation c
  | isElsewhere operation = refused [RestElsewhere EarlierCarving (region e) there]
  | otherwise = do
    wide <- filterM (fits (Mm 0)) (NonEmpty.toList (carvedAreas c))
    pockets <- traverse pocketOf wide
    cleared <- filterM fitsWithAllowance (catMaybes pockets)
    let lowest = [(bottom, lowestOf (wall p)) | p <- cleared]
    case (cutter context, cleared, tooDeep settings EarlierCarving operation lowest) of
      (Just t, [], _)
        | length pockets == length (catMaybes pockets) ->
          refused [NoFloor (region e) there (times 2 (cutterRadius t))]
      (_, _, faults@(_ : _)) -> refused faults
      _ -> pure (map floorOf cleared <$ sequence pockets)
  where
    there = operationAt operation
    bottom = times (-1) (carvingDepth c)
    -- True if the cutter fits into an area with an allowance. The transformation around the
    -- statement scales the contours after this.
    fits allowance (outline, holes') = case cutter context of
      Nothing -> pure True
      Just t -> do
        let room = plus (carvingFlank c) (plus (cutterRadius t) allowance)
            inwards = times (-1 / scaledBy context) (minus room Tolerance.floorRoom)
        PlaneRegion found <-
          RegionBuiltin.settled (region e) $
            PlaneRegion.offsetBy (region e) (contourName outline) inwards (outline : holes')
        pure (not (null found))
    fitsWithAllowance p = fits (allowanceOf p) (contour (wall p), islands p)
    pocketOf (outline, holes') =
      Machining.pocketIn context at step settings (named outline) (map named holes')
    named = PocketCheck.Named (region e)
    floorOf p =
      p
        { extent = FloorOfCarving,
          wall =
            (wall p)
              { levels = if null (levels (wall p)) then [bottom] else levels (wall p),
                allowances = fmap (plus (carvingFlank c)) (allowances (wall p))
              }
        }

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
