-- | Evaluates the facing of a region: parallel passes that clear its surface.
module Part.FaceMilling
  ( facing,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus, over, plus, times)
import Base.Region (Located (..), Region)
import Checked.Syntax (Expr)
import Checked.Syntax qualified as Checked
import Control.Monad (when)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Vec)
import Geometry.Vec qualified as Vec
import Part.Error (CutterStatement (FaceStatement), ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression qualified as Expression
import Part.Machining (Context (..))
import Part.Machining qualified as Machining
import Part.Measure (lengthOf, notNegative)
import Part.Parameter (Range (UpTo))
import Part.Parameter qualified as Parameter
import Part.Part
import Part.PlaneRegion (PlaneRegion (..), RegionPart (outer))
import Part.PlaneRegion qualified as PlaneRegion
import Part.PocketError (PocketMisfit (StepTooWide))
import Part.RegionBuiltin qualified as RegionBuiltin
import Part.RegionError (RegionMistake (EmptyRegion))

-- | Evaluates the facing of a region, which gives one operation for each of its parts. @stockTop@
-- is the height of the top of the stock, if the program gives a stock. @at@ is the region of the
-- statement, @e@ the expression of the region, and @step@ that of the stepover.
facing ::
  Context -> Maybe Mm -> Region -> Expr -> Expr -> Checked.Settings -> Eval (Maybe [Pocketing])
facing context stockTop at e step settings = do
  Machining.checkCutter context at FaceStatement
  v <- Expression.evaluate env e
  PlaneRegion found <- RegionBuiltin.regionOf (region e) v
  when (null found) (Evaluation.mistake (InRegion (EmptyRegion (region e))))
  stepover <- lengthOf env Parameter.Stepover step
  sequence_
    [ Evaluation.mistake (InPocket (StepTooWide (region step) stepover d))
      | Just d <- [times 2 . cutterRadius <$> cutter context],
        stepover > d
    ]
  let box = foldr1 BoundingBox.union (map (boxOf . outer) found)
  passDirection <- maybe (pure (alongLongerSide box)) directionOf (Checked.passAngle settings)
  heights <- levelsOf context stockTop (Checked.depth settings)
  Machining.checkPassCount (region step) (over (diagonal box) stepover)
  sequence <$> traverse (faced stepover passDirection heights) found
  where
    env = environment context
    directionOf angle = do
      x <- Expression.number <$> Expression.evaluate env angle
      pure (Vec.polar (Mm 1) (Rad x))
    faced stepover passDirection heights part = do
      Evaluation.spend at (sum (map (length . elements) (outer part : PlaneRegion.holes part)))
      fmap (over' stepover passDirection heights part) <$> wallOf part
    wallOf part =
      let plain = settings {Checked.depth = Nothing}
       in Machining.millingOf context Milled at plain (outer part) (Located (region e) Inside)
    over' stepover passDirection heights part wall =
      Pocketing
        { wall =
            wall
              { levels = heights,
                places = (places wall) {depthAt = region . fst <$> Checked.depth settings}
              },
          islands = PlaneRegion.holes part,
          stepover,
          extent = Surface Facing {passDirection}
        }

-- | The heights of the passes from the highest to the lowest. The lowest is @depth@ below the top
-- of the part, which is 0 without a depth. The steps begin at the top of the stock, if it is above
-- the part, or else at the top of the part.
levelsOf :: Context -> Maybe Mm -> Maybe (Expr, Maybe Expr) -> Eval [Mm]
levelsOf context stockTop depth = case depth of
  Nothing -> pure [Mm 0]
  Just (deep, most) -> do
    bottom <- times (-1) <$> notNegative env Parameter.Depth deep
    stepdown <- traverse (lengthOf env Parameter.PassDepth) most
    let high = minus top bottom
        count = maybe 1 (\s -> max 1 (ceiling (over high s - Tolerance.equal))) stepdown :: Int
    when
      (count > 10000)
      ( Evaluation.mistake
          (NotWhole (region deep) Parameter.PassCount (UpTo 10000) (fromIntegral count))
      )
    pure
      [ plus bottom (times (fromIntegral (count - k) / fromIntegral count) high)
        | k <- [1 .. count]
      ]
  where
    env = environment context
    top = case stockTop of
      Just z | z > Mm 0, z < Tolerance.reach -> z
      _ -> Mm 0

-- | The direction of the longer side of a box, the horizontal one if both are equally long.
alongLongerSide :: BoundingBox -> Vec
alongLongerSide (BoundingBox l b r t)
  | r - l >= t - b = Vec.vec 1 0
  | otherwise = Vec.vec 0 1

diagonal :: BoundingBox -> Mm
diagonal (BoundingBox l b r t) = Mm (Vec.norm (Vec.vec (r - l) (t - b)))

boxOf :: Contour -> BoundingBox
boxOf c =
  foldr1 BoundingBox.union (map (BoundingBox.around . segment) (NonEmpty.toList (elements c)))
