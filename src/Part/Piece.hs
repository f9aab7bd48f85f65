-- | Tables, and the recalculations that make a piece of a part out of a curve (Kolsanova, sections 2 and 5).
module Part.Piece
  ( table,
    piece,
    bevelled,
  )
where

import Base.Crash (bug)
import Base.Decimal qualified as Decimal
import Base.Name (Name)
import Base.Quantity (Mm (..), Rad (..), over, times)
import Base.Region (Located (..), Region)
import Base.Rows (Rows)
import Base.Rows qualified as Rows
import Checked.Syntax (Cells (..), Cipher, Cipher_ (..), Columns (..), Expr, Expr_ (..), Joggle, Joggle_ (..), Side (..))
import Checked.Syntax qualified as Checked
import Control.Monad (foldM, when)
import Data.Foldable (find)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Primitive.PrimArray qualified as PrimArray
import Data.Vector (Vector)
import Data.Vector qualified as Vector
import Geometry.Curve (Distance, Growth (..))
import Geometry.Curve qualified as Exact
import Geometry.Curve.Distance qualified as Distance
import Geometry.Curve.Fold qualified as Fold
import Geometry.Offset qualified as Offset
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec
import Part.Curve (Curve (..), Table (..))
import Part.Curve qualified as Curve
import Part.Data (Value (..))
import Part.Data qualified as Data
import Part.Error (Fact (..))
import Part.Eval (Eval)
import Part.Eval qualified as Eval
import Part.Value (Environment)
import Part.Value qualified as Value

-- | The rows of a table.
table :: Environment -> Columns -> Eval Table
table env (Columns names written) = do
  found <- Eval.collect (fmap pure . evaluated) written
  pure Table {rows = Rows.joined (2 + length names) found, names = map fst names}
  where
    evaluated cells = case cells of
      Numbers rows -> rows <$ Eval.collect (number rows) [0 .. Rows.count rows - 1]
      Written at es -> do
        vs <- traverse (fmap Value.number . Value.evaluate env) es
        Rows.fromList [(at, PrimArray.primArrayFromList vs)] <$ mapM_ (Data.within at) (take 2 vs)
    -- Numbers take no steps: there are no more than were written.
    number :: Rows -> Int -> Eval [()]
    number rows k = do
      let at = Rows.place rows k
      Data.within at (Rows.cell rows k 0)
      [] <$ Data.within at (Rows.cell rows k 1)

-- | A curve recalculated by ciphers, one after the other, and joggled, to one side of the walk.
piece :: Environment -> Curve -> [Cipher] -> Located Side -> [Joggle] -> Eval Curve
piece env base ciphers (Located _ side) joggles = do
  ciphered <- foldM (recalculated env base side') (exact base) ciphers
  joggled <- foldM (joggledBy env side') ciphered joggles
  pure (Curve.curve (fields base) Nothing joggled)
  where
    side' = case side of
      LeftSide -> Offset.LeftOf
      RightSide -> Offset.RightOf
      Outside -> bug "a piece outside a curve"
      Inside -> bug "a piece inside a curve"
      On -> bug "a piece on a curve"

-- | One cipher. Columns give a value for every row of the table, which goes along the curve as the points do.
recalculated :: Environment -> Curve -> Offset.Side -> Exact.Curve -> Cipher -> Eval Exact.Curve
recalculated env base side lower (Located at cipher) = do
  distance <- case cipher of
    Constant h mu -> fixed h >>= square mu . Exact.Constant
    Pointwise h mu -> column h >>= square mu . Exact.Pointwise
    Bevelled mu height delta -> Exact.Bevelled <$> bevels mu <*> column height <*> maybe (pure (Mm 0)) fixed delta
    Growing h1 h2 mu span' -> do
      from <- fixed h1
      to <- fixed h2
      between <- traverse ends span'
      square mu (Exact.Growing Growth {from, to, between})
  shiftedBy at side distance lower
  where
    fixed e = do
      x <- Value.number <$> Value.evaluate env e
      Mm x <$ Data.within (region e) x
    column e = Exact.column lower <$> alongRows env base e
    bevels e = Exact.column lower <$> (alongRows env base e >>= upright base e)
    square mu distance = case mu of
      Nothing -> pure distance
      Just e -> (`Exact.Square` distance) <$> bevels e
    ends (p, q) = do
      a <- parameter p
      b <- parameter q
      if a < b then pure (a, b) else Eval.mistake (GrowthEnds at)
    parameter e = (\v -> Exact.nearest (Value.point v) lower) <$> Value.evaluate env e

-- | The values of an expression at the rows of a curve's table.
alongRows :: Environment -> Curve -> Expr -> Eval (Vector Double)
alongRows env base e
  | mentions names e = Vector.fromList <$> Eval.gather (map atRow [0 .. count - 1])
  | otherwise = Vector.replicate count . Value.number <$> Value.evaluate env e
  where
    names = map fst (fields base)
    count = Exact.rowCount (exact base)
    atRow k = Value.number <$> Value.evaluate (foldl (bound k) env (fields base)) e
    bound k env' (n, values) = Value.bind n (Quantity (values Vector.! k)) env'

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
shiftedBy :: Region -> Offset.Side -> Distance -> Exact.Curve -> Eval Exact.Curve
shiftedBy at side distance lower = do
  let corners = Exact.corners lower
      whole = Exact.shifted side distance lower
  -- A curve that is put together stays together.
  case [u | u <- corners, torn whole u > Tolerance.curve] of
    u : _ -> Eval.mistake (ShiftsCorner at (Exact.at lower u) (turnAt u))
    [] -> pure ()
  case Fold.fold whole of
    Just f -> Eval.mistake (Folds at (Fold.place f) (Fold.asked f) (Fold.largest f))
    Nothing -> pure whole
  where
    torn whole u
      | u <= 0 = Vec.distance (Exact.placeFrom Exact.Before whole (Exact.domain whole)) (Exact.placeFrom Exact.After whole 0)
      | otherwise = Vec.distance (Exact.placeFrom Exact.Before whole u) (Exact.placeFrom Exact.After whole u)
    turnAt u = let Rad a = Vec.turn (Exact.tangentFrom Exact.Before lower u) (Exact.tangentFrom Exact.After lower u) in Rad (abs a)

-- | A joggle between two coordinates of the curve (Kolsanova, control stops 15074 and 14174).
joggledBy :: Environment -> Offset.Side -> Exact.Curve -> Joggle -> Eval Exact.Curve
joggledBy env side lower (Located at (Joggle from to depth radius)) = do
  a <- coordinate from
  b <- coordinate to
  when (a == b) (Eval.mistake (JoggleNowhere at))
  deep <- lengthOf depth
  r <- lengthOf radius
  let joggle = Distance.Joggle {Distance.begins = min a b, Distance.ends = max a b, Distance.depth = deep, Distance.radius = r}
  case Exact.joggled joggle lower of
    Left Exact.DeepJoggle -> Eval.mistake (JoggleDepth (region radius) r (times 0.5 deep))
    Left (Exact.LongJoggle _ there) -> Eval.mistake (JoggleRadius (region radius) r there (largest deep there))
    Left _ -> Eval.mistake (JoggleNowhere at)
    Right distance -> shiftedBy at side distance lower
  where
    coordinate e = do
      x <- Value.number <$> Value.evaluate env e
      case Exact.atX x lower of
        [u] -> pure u
        us -> Eval.mistake (JoggleCoordinate (region e) (Mm x) (map (Exact.at lower) us) (Curve.abscissas lower))
    lengthOf e = do
      x <- Value.number <$> Value.evaluate env e
      when (x <= 0) (Eval.mistake (NotPositive (region e) "a measure of a joggle" (Decimal.mm (Mm x))))
      Mm x <$ Data.within (region e) x
    -- Two ramps of @√(d·(4r − d))@ take all of the length.
    largest deep there =
      let r = Mm ((let Mm l = there in l * l / 4) / (4 * (let Mm d = deep in d)) + (let Mm d = times 0.25 deep in d))
       in if over r deep > 0.5 then Just r else Nothing

-- | How far the surface of an element leans, along the chain that stands for its curve.
bevelled :: Environment -> Maybe Curve -> Expr -> Eval [(Double, Double)]
bevelled env on e = case on of
  Nothing -> do
    a <- Value.number <$> Value.evaluate env e
    when (abs a >= steepest) (Eval.mistake (SteepBevel (region e) Nothing (Rad a)))
    pure [(0, a)]
  Just c -> Curve.along c <$> (alongRows env c e >>= upright c e)

-- | Bevels of less than a right angle.
upright :: Curve -> Expr -> Vector Double -> Eval (Vector Double)
upright c e values = case find ((>= steepest) . abs . snd) (zip [1 ..] (Vector.toList values)) of
  Just (k, a) -> Eval.mistake (SteepBevel (region e) (if mentions (map fst (fields c)) e then Just k else Nothing) (Rad a))
  Nothing -> pure values

-- | No bevel comes nearer to a right angle, in radians.
steepest :: Double
steepest = pi / 2 - 1e-6
