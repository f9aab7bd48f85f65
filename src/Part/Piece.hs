-- | Tables, and the recalculations that make a piece of a part out of a curve (Kolsanova, sections
-- 2 and 5).
module Part.Piece
  ( table,
    piece,
    bevelled,
  )
where

import Base.Crash (bug)
import Base.Decimal qualified as Decimal
import Base.Name (Name)
import Base.NumberTable (NumberTable)
import Base.NumberTable qualified as NumberTable
import Base.Quantity (Mm (..), Rad (..), over, times)
import Base.Region (Located (..), Region)
import Checked.Syntax
  ( Cells (..),
    Cipher,
    Cipher_ (..),
    Columns (..),
    Expr,
    Expr_ (..),
    Joggle,
    Joggle_ (..),
    Side (..),
  )
import Checked.Syntax qualified as Checked
import Control.Monad (foldM, when)
import Data.Foldable (find)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Primitive.PrimArray qualified as PrimArray
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Carrier qualified as Carrier
import Geometry.Curve (Distance, Growth (..))
import Geometry.Curve qualified as Exact
import Geometry.Curve.Cusp qualified as Cusp
import Geometry.Curve.ShiftDistance qualified as ShiftDistance
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec
import Part.Curve (PartCurve (..), PartTable (..))
import Part.Curve qualified as Curve
import Part.Error (ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression (Environment)
import Part.Expression qualified as Expression
import Part.Value (Value (..))
import Part.Value qualified as Value

-- | The rows of a table.
table :: Environment -> Columns -> Eval PartTable
table env (Columns names written) = do
  found <- Evaluation.collect (fmap pure . evaluated) written
  pure PartTable {rows = NumberTable.joined (2 + length names) found, names = map fst names}
  where
    evaluated cells = case cells of
      Numbers rows -> rows <$ Evaluation.collect (number rows) [0 .. NumberTable.count rows - 1]
      Written at es -> do
        vs <- traverse (fmap Expression.number . Expression.evaluate env) es
        NumberTable.fromList [(at, PrimArray.primArrayFromList vs)]
          <$ mapM_ (Value.within at) (take 2 vs)
    -- Numbers take no steps: there are no more than were written.
    number :: NumberTable -> Int -> Eval [()]
    number rows k = do
      let at = NumberTable.place rows k
      Value.within at (NumberTable.cell rows k 0)
      [] <$ Value.within at (NumberTable.cell rows k 1)

-- | A curve recalculated by ciphers, one after the other, and joggled, to one side of the walk.
piece :: Environment -> PartCurve -> [Cipher] -> Located Side -> [Joggle] -> Eval PartCurve
piece env base ciphers (Located _ side) joggles = do
  ciphered <- foldM (recalculated env base side') (exact base) ciphers
  joggled <- foldM (joggledBy env side') ciphered joggles
  pure (Curve.curve (fields base) Nothing joggled)
  where
    side' = case side of
      LeftSide -> Carrier.LeftOf
      RightSide -> Carrier.RightOf
      Outside -> bug "a piece outside a curve"
      Inside -> bug "a piece inside a curve"
      On -> bug "a piece on a curve"

-- | One cipher. Columns give a value for every row of the table, which goes along the curve as the
-- points do.
recalculated ::
  Environment ->
  PartCurve ->
  Carrier.Side ->
  Exact.Curve ->
  Cipher ->
  Eval Exact.Curve
recalculated env base side lower (Located at cipher) = do
  distance <- case cipher of
    Constant h mu -> fixed h >>= square mu . Exact.Constant
    Pointwise h mu -> column h >>= square mu . Exact.Pointwise
    Bevelled mu height delta ->
      Exact.Bevelled <$> bevels mu <*> column height <*> maybe (pure (Mm 0)) fixed delta
    Growing h1 h2 mu span' -> do
      from <- fixed h1
      to <- fixed h2
      between <- traverse ends span'
      square mu (Exact.Growing Growth {from, to, between})
  shiftedBy at side distance lower
  where
    fixed e = do
      x <- Expression.number <$> Expression.evaluate env e
      Mm x <$ Value.within (region e) x
    column e = Exact.column lower <$> alongRows env base e
    bevels e = Exact.column lower <$> (alongRows env base e >>= upright base e)
    square mu distance = case mu of
      Nothing -> pure distance
      Just e -> (`Exact.Square` distance) <$> bevels e
    ends (p, q) = do
      a <- parameter p
      b <- parameter q
      if a < b then pure (a, b) else Evaluation.mistake (GrowthEnds at)
    parameter e = (\v -> Exact.nearest (Expression.point v) lower) <$> Expression.evaluate env e

-- | The values of an expression at the rows of a curve's table.
alongRows :: Environment -> PartCurve -> Expr -> Eval (Vector Double)
alongRows env base e
  | mentions names e = Vector.fromList <$> Evaluation.gather (map atRow [0 .. count - 1])
  | otherwise = Vector.replicate count . Expression.number <$> Expression.evaluate env e
  where
    names = map fst (fields base)
    count = Exact.rowCount (exact base)
    atRow k = Expression.number <$> Expression.evaluate (foldl (bound k) env (fields base)) e
    bound k env' (n, values) = Expression.bind n (Quantity (values Vector.! k)) env'

-- | Whether one of some names stands in an expression.
mentions :: [Name] -> Expr -> Bool
mentions names (Located _ e) = case e of
  Number _ -> False
  Variable name -> name `elem` names
  Apply _ arguments -> any again (NonEmpty.toList arguments)
  Builtin _ arguments -> any inArgument arguments
  Negate a -> again a
  Not a -> again a
  Binary _ a b -> again a || again b
  Range a b c -> again a || again b || maybe False again c
  If a b c -> any again [a, b, c]
  Pair a b -> again a || again b
  Triple a b c -> any again [a, b, c]
  List es -> any again es
  Each a name b -> again b || mentions (filter (/= name) names) a
  where
    again = mentions names
    inArgument a = case a of
      Checked.Given x -> again x
      Checked.Chosen _ x -> again x
      Checked.Ranked _ -> False

-- | A shift, if it tears no corner open and does not fold the curve.
shiftedBy :: Region -> Carrier.Side -> Distance -> Exact.Curve -> Eval Exact.Curve
shiftedBy at side distance lower = do
  let corners = Exact.corners lower
      whole = Exact.shifted side distance lower
  -- A curve that is put together stays together.
  case [u | u <- corners, torn whole u > Tolerance.curve] of
    u : _ -> Evaluation.mistake (ShiftsCorner at (Exact.at lower u) (turnAt u))
    [] -> pure ()
  case Cusp.fold whole of
    Just f -> Evaluation.mistake (Folds at (Cusp.place f) (Cusp.asked f) (Cusp.largest f))
    Nothing -> pure whole
  where
    torn whole u
      | u <= 0 =
        Vec.distance
          (Exact.placeFrom Exact.Before whole (Exact.domain whole))
          (Exact.placeFrom Exact.After whole 0)
      | otherwise =
        Vec.distance (Exact.placeFrom Exact.Before whole u) (Exact.placeFrom Exact.After whole u)
    turnAt u =
      let Rad a =
            Vec.turn
              (Exact.tangentFrom Exact.Before lower u)
              (Exact.tangentFrom Exact.After lower u)
       in Rad (abs a)

-- | A joggle between two coordinates of the curve (Kolsanova, control stops 15074 and 14174).
joggledBy :: Environment -> Carrier.Side -> Exact.Curve -> Joggle -> Eval Exact.Curve
joggledBy env side lower (Located at (Joggle from to depth radius)) = do
  a <- coordinate from
  b <- coordinate to
  when (a == b) (Evaluation.mistake (JoggleNowhere at))
  deep <- lengthOf depth
  r <- lengthOf radius
  let joggle =
        ShiftDistance.Joggle
          { ShiftDistance.begins = min a b,
            ShiftDistance.ends = max a b,
            ShiftDistance.depth = deep,
            ShiftDistance.radius = r
          }
  case Exact.joggled joggle lower of
    Left Exact.DeepJoggle -> Evaluation.mistake (JoggleDepth (region radius) r (times 0.5 deep))
    Left (Exact.LongJoggle _ there) ->
      Evaluation.mistake (JoggleRadius (region radius) r there (largest deep there))
    Left _ -> Evaluation.mistake (JoggleNowhere at)
    Right distance -> shiftedBy at side distance lower
  where
    coordinate e = do
      x <- Expression.number <$> Expression.evaluate env e
      case Exact.atX x lower of
        [u] -> pure u
        us ->
          Evaluation.mistake
            (JoggleCoordinate (region e) (Mm x) (map (Exact.at lower) us) (Curve.abscissas lower))
    lengthOf e = do
      x <- Expression.number <$> Expression.evaluate env e
      when
        (x <= 0)
        (Evaluation.mistake (NotPositive (region e) "a measure of a joggle" (Decimal.mm (Mm x))))
      Mm x <$ Value.within (region e) x
    -- Two ramps of @√(d·(4r − d))@ take all of the length.
    largest deep there =
      let r =
            Mm
              ( (let Mm l = there in l * l / 4) / (4 * (let Mm d = deep in d))
                  + (let Mm d = times 0.25 deep in d)
              )
       in if over r deep > 0.5 then Just r else Nothing

-- | How far the surface of an element leans, along the chain that stands for its curve.
bevelled :: Environment -> Maybe PartCurve -> Expr -> Eval [(Double, Double)]
bevelled env on e = case on of
  Nothing -> do
    a <- Expression.number <$> Expression.evaluate env e
    when (abs a >= steepest) (Evaluation.mistake (SteepBevel (region e) Nothing (Rad a)))
    pure [(0, a)]
  Just c -> Curve.along c <$> (alongRows env c e >>= upright c e)

-- | Bevels of less than a right angle.
upright :: PartCurve -> Expr -> Vector Double -> Eval (Vector Double)
upright c e values = case find ((>= steepest) . abs . snd) (zip [1 ..] (Vector.toList values)) of
  Just (k, a) ->
    Evaluation.mistake
      (SteepBevel (region e) (if mentions (map fst (fields c)) e then Just k else Nothing) (Rad a))
  Nothing -> pure values

-- | No bevel comes nearer to a right angle, in radians.
steepest :: Double
steepest = pi / 2 - 1e-6
