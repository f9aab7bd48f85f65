-- | Evaluates rest machining: the clearing of what a larger cutter has left in a pocket.
module Part.RestMachining
  ( restOf,
  )
where

import Base.Crash (bug)
import Base.Quantity (Mm (..), over, plus, times)
import Base.Region (Located (..), Region)
import Checked.Syntax (Expr)
import Checked.Syntax qualified as Checked
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
import Part.PocketError
  ( PocketMisfit (RestElsewhere, RestNotSmaller, RestTooDeep, RestWithoutDepth, StepTooWide),
  )
import Part.Value (ClearedPockets (..), Value (..))

-- | Evaluates the clearing of what the statement @e@ has left in its pocket. @at@ is the region of
-- the statement and @step@ the expression of the stepover. Without a depth it has the passes of
-- that statement.
restOf :: Context -> Region -> Expr -> Expr -> Checked.Settings -> Eval (Maybe [Pocketing])
restOf context at e step settings = do
  Machining.checkCutter context at RestStatement
  v <- Expression.evaluate (environment context) e
  stepover <- lengthOf (environment context) Parameter.Stepover step
  let cleared = case v of
        ClearingValue c -> c
        _ -> bug "a value that is no pocket operation where one was checked"
      diameter = times 2 . cutterRadius <$> cutter context
      tooWide = [StepTooWide (region step) stepover d | Just d <- [diameter], stepover > d]
  found <- traverse (restIn context at e settings) (pockets cleared)
  case misfits context (region e) cleared <> tooWide <> tooDeep settings cleared found of
    [] -> do
      sequence_ [Machining.checkPassCount (region step) (count stepover p) | Just p <- found]
      pure (map (afterwards cleared stepover) <$> sequence found)
    faults -> Evaluation.mistakes [Error (InPocket m) [] [] | m <- faults]
  where
    count stepover (rough, _) =
      over (plus (radius (wall rough)) (allowanceOf rough)) stepover

-- | The faults of clearing what a statement has left: it is outside of a transformation around this
-- one, it has no depth, or its cutter is not larger. @at@ is the region of its name.
misfits :: Context -> Region -> ClearedPockets -> [PocketMisfit]
misfits context at cleared =
  [RestElsewhere at (clearedAt cleared) | isElsewhere cleared]
    <> take
      1
      ( [RestWithoutDepth at (clearedAt cleared) | p <- walls, null (levels p)]
          <> [ RestNotSmaller at (clearedAt cleared) (cutterRadius c) (radius p)
               | p <- walls,
                 Just c <- [cutter context],
                 cutterRadius c >= radius p
             ]
      )
  where
    walls = map wall (pockets cleared)

-- | The fault of a depth below that of the pocket.
tooDeep :: Checked.Settings -> ClearedPockets -> [Maybe (Pocketing, Milling)] -> [PocketMisfit]
tooDeep settings cleared found =
  take
    1
    [ RestTooDeep (region depth) (clearedAt cleared) (lowestOf own) (lowestOf (wall rough))
      | Just (depth, _) <- [Checked.depth settings],
        Just (rough, own) <- found,
        not (null (levels (wall rough))),
        lowestOf own < lowestOf (wall rough)
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
afterwards :: ClearedPockets -> Mm -> (Pocketing, Milling) -> Pocketing
afterwards cleared stepover (rough, own) =
  rough
    { wall = own {levels = if null (levels own) then levels (wall rough) else levels own},
      stepover,
      extent =
        RestOfPocket
          Roughing
            { roughedAt = clearedAt cleared,
              roughRadius = radius (wall rough),
              roughAllowance = allowanceOf rough,
              roughedDownTo = lowestOf (wall rough)
            }
    }
