-- | Evaluates V-carvings. A conical tool carves a region so that its cone touches the edges of the
-- region at the top of the part.
module Part.Carving
  ( carving,
    checkDepth,
  )
where

import Base.Quantity (Mm (..), Rad (..), minus)
import Base.Region (Located (..), Region)
import Checked.Syntax (Expr)
import Checked.Syntax qualified as Checked
import Control.Monad (when)
import Data.Foldable (for_)
import Data.List.NonEmpty (NonEmpty (..))
import Geometry.Tolerance qualified as Tolerance
import Part.CarvingError (CarvingMistake (..))
import Part.CutterBody qualified as CutterBody
import Part.Error (CutterStatement (CarveStatement), ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression qualified as Expression
import Part.Machining (Context (..))
import Part.Machining qualified as Machining
import Part.Measure (feedOf, lengthOf)
import Part.Parameter qualified as Parameter
import Part.Part
  ( Carving (..),
    Contour (elements),
    Cutter (tipRadius),
    RestPolicy (..),
    ToolBody (pointAngle),
  )
import Part.Part qualified as Part
import Part.PlaneRegion (PlaneRegion (..), RegionPart (..))
import Part.PocketCheck qualified as PocketCheck
import Part.PocketError (PocketMisfit (Meets))
import Part.RegionBuiltin qualified as RegionBuiltin
import Part.RegionError (RegionMistake (EmptyRegion))

-- | Evaluates the carving of a region, which the expression @e@ gives. @at@ is the region of the
-- statement. 'Nothing' if a setting that the statement needs has no value, because a mistake in it
-- is reported.
carving :: Context -> Region -> Expr -> Checked.Settings -> Eval (Maybe Carving)
carving context at e settings = do
  Machining.checkCutter context at CarveStatement
  PlaneRegion found <- Expression.evaluate env e >>= RegionBuiltin.regionOf (region e)
  plunge <- traverse (feedOf env) (Checked.plunge settings)
  depthAt <- maybe (mistake (NothingDeep at)) (pure . fst) (Checked.depth settings)
  deep <- lengthOf env Parameter.Depth depthAt
  for_ (cutter context) (checkDepth (region depthAt) deep)
  Evaluation.spend at (sum [length (elements c) | p <- found, c <- outer p : holes p])
  case found of
    [] -> Evaluation.mistake (InRegion (EmptyRegion (region e)))
    first : more -> do
      mapM_ (checkHoles e) found
      pure $ do
        tool <- cutter context
        Rad point <- pointAngle (Part.body tool)
        Located _ tolerance <- chordError context
        feed <- modalFeed context
        travel <- clearanceHeight context
        Just
          Carving
            { carvedAreas = fmap (\p -> (outer p, holes p)) (first :| more),
              carvingTip = tipRadius tool,
              halfAngle = Rad (point / 2),
              carvingDepth = deep,
              carvingDepthAt = region depthAt,
              carvingTolerance = tolerance,
              carvingFeed = feed,
              carvingPlunge = plunge,
              carvingTravel = travel,
              carvingRest = maybe Refused (const Allowed) (Checked.restAllowed settings)
            }
  where
    env = environment context

-- | Fails if a depth is larger than the height of the flank of a conical tool. @at@ is the region
-- of the depth.
checkDepth :: Region -> Mm -> Cutter -> Eval ()
checkDepth at deep tool =
  when
    (flank > Mm 0 && minus deep flank > Tolerance.coincident)
    (mistake (DeeperThanFlank at deep flank))
  where
    flank = CutterBody.flankHeight tool

-- | Fails if contours of one area of a region touch. @e@ is the expression of the region.
checkHoles :: Expr -> RegionPart -> Eval ()
checkHoles e p =
  for_ (take 1 [at | Meets _ _ _ _ _ at _ <- misfits]) $ \at ->
    mistake (ContoursMeet (region e) at)
  where
    misfits = PocketCheck.misfits Nothing (named (outer p)) (map named (holes p))
    named = PocketCheck.Named (region e)

mistake :: CarvingMistake -> Eval a
mistake = Evaluation.mistake . InCarving
