-- | Evaluates tables and pieces. A piece is a curve that is recalculated by ciphers and then
-- joggled (Kolsanova, sections 2 and 5).
--
-- A cipher shifts every point of the curve along its normal; its digit 1, 2, 4 or 6 says how the
-- distance changes along the curve. A joggle is a local step of the curve, with a ramp at each of
-- its two ends. A bevel is the angle between the surface of the part and the axis of the tool.
module Part.Piece
  ( table,
    piece,
    bevelled,
    mentions,
  )
where

import Base.Crash (bug)
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
    PointColumns (..),
    Side (..),
  )
import Checked.Syntax qualified as Checked
import Control.Monad (foldM, when)
import Data.Foldable (find)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
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
import Part.CurveError (CurveMistake (..))
import Part.Error (ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression (Environment)
import Part.Expression qualified as Expression
import Part.Parameter qualified as Parameter
import Part.Tolerance qualified as Tolerance
import Part.Value (Value (..))
import Part.Value qualified as Value

-- | Evaluates the rows of a table, and turns polar coordinates into x and y. Fails if the absolute
-- value of x, y or a radius exceeds 'Tolerance.reach', or if a radius is negative. The count of
-- evaluation steps is limited, but rows of numbers take no steps: the length of the text already
-- limits the count of such rows.
table :: Environment -> Columns -> Eval PartTable
table env (Columns coordinates names written) = do
  parts <- Evaluation.collect (fmap pure . evaluated) written
  pure PartTable {rows = NumberTable.concatenated (2 + length names) parts, names = map fst names}
  where
    evaluated cells = case cells of
      Numbers rows -> placed rows
      Written at es -> do
        vs <- traverse (fmap Expression.number . Expression.evaluate env) es
        placed (NumberTable.fromList [(at, PrimArray.primArrayFromList vs)])
    placed rows =
      let turned = case coordinates of
            CartesianRows -> rows
            PolarRows -> NumberTable.mapPairs (\r a -> (r * cos a, r * sin a)) rows
       in turned <$ Evaluation.collect (checked rows) [0 .. NumberTable.count rows - 1]
    checked :: NumberTable -> Int -> Eval [()]
    checked rows k = do
      let at = NumberTable.regionOf rows k
          first = NumberTable.cell rows k 0
      Value.within at first
      [] <$ case coordinates of
        CartesianRows -> Value.within at (NumberTable.cell rows k 1)
        PolarRows ->
          when (first < 0) (Evaluation.mistake (Negative at Parameter.PolarRadius first))

-- | Recalculates the curve @base@ by @ciphers@ in their order, and then applies @joggles@ in their
-- order. All ciphers and joggles shift the curve to the given side, left or right of its direction.
piece :: Environment -> PartCurve -> [Cipher] -> Located Side -> [Joggle] -> Eval PartCurve
piece env base ciphers (Located _ side) joggles = do
  ciphered <- foldM (recalculated env base side') (exact base) ciphers
  joggled <- foldM (joggledBy env side') ciphered joggles
  pure (Curve.curve (tableColumns base) Nothing joggled)
  where
    side' = case side of
      LeftSide -> Carrier.LeftOf
      RightSide -> Carrier.RightOf
      Outside -> bug "a piece outside a curve"
      Inside -> bug "a piece inside a curve"
      On -> bug "a piece on a curve"

-- Ciphers

-- | Shifts the curve @lower@ to a side by one cipher. @lower@ is the result of the ciphers before
-- this one, and @base@ is the curve before all ciphers. A row of the curve's table has the same
-- parameter on both curves. So the columns of the table can be used for @lower@, too.
recalculated ::
  Environment ->
  PartCurve ->
  Carrier.Side ->
  Exact.Curve ->
  Cipher ->
  Eval Exact.Curve
recalculated env base side lower (Located at cipher) = do
  distance <- case cipher of
    Constant h mu -> lengthIn h >>= square mu . Exact.Constant
    Pointwise h mu -> column h >>= square mu . Exact.Pointwise
    Bevelled mu height delta ->
      Exact.Bevelled <$> bevels mu <*> column height <*> maybe (pure (Mm 0)) lengthIn delta
    Growing h1 h2 mu span' -> do
      from <- lengthIn h1
      to <- lengthIn h2
      between <- traverse ends span'
      square mu (Exact.Growing Growth {from, to, between})
  shiftedBy at side distance lower
  where
    lengthIn e = do
      x <- Expression.number <$> Expression.evaluate env e
      Mm x <$ Value.within (region e) x
    column e = Exact.column lower <$> alongRows env base e
    bevels e = Exact.column lower <$> (alongRows env base e >>= checkedBevels base e)
    square mu distance = case mu of
      Nothing -> pure distance
      Just e -> (`Exact.Square` distance) <$> bevels e
    ends (p, q) = do
      a <- parameter p
      b <- parameter q
      if a < b then pure (a, b) else mistake (GrowthEnds at)
    parameter e =
      (\v -> atBreak (Exact.nearest (Expression.point v) lower)) <$> Expression.evaluate env e
    -- The parameter of a break between two smooth stretches if its point is the same. Rounding
    -- would otherwise leave a tiny stretch between them.
    atBreak u =
      fromMaybe
        u
        (find (\b -> Vec.distance (at' b) (at' u) <= Tolerance.curve) (Exact.breaks lower))
    at' = Exact.at lower

mistake :: CurveMistake -> Eval a
mistake = Evaluation.mistake . InCurve

-- | The values of the expression @e@ at the rows of a curve's table. If @e@ names no column of the
-- table, it is evaluated once, and its value applies to every row.
alongRows :: Environment -> PartCurve -> Expr -> Eval (Vector Double)
alongRows env base e
  | mentions names e = Vector.fromList <$> Evaluation.gather (map atRow [0 .. count - 1])
  | otherwise = Vector.replicate count . Expression.number <$> Expression.evaluate env e
  where
    names = map fst (tableColumns base)
    count = Exact.rowCount (exact base)
    atRow k = Expression.number <$> Expression.evaluate (foldl (bound k) env (tableColumns base)) e
    bound k env' (n, values) = Expression.bind n (Quantity (values Vector.! k)) env'

-- | True if the expression uses the name of one of these columns.
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

-- | The curve @lower@, shifted to a side by @distance@. Fails if the shift opens a gap at a corner,
-- or a step at a slight corner, or if the shifted curve turns back in a cusp. At a corner that an
-- earlier shift has made, there is mostly no gap, because the shift joins both sides
-- ("Geometry.Curve.ShiftedCurve").
shiftedBy :: Region -> Carrier.Side -> Distance -> Exact.Curve -> Eval Exact.Curve
shiftedBy at side distance lower = do
  let whole = Exact.shifted side distance lower
  case [u | u <- Exact.corners lower, gapAt whole u > Tolerance.curve || hasStep whole u] of
    u : _ -> mistake (ShiftsCorner at (Exact.at lower u) (cornerAngle u))
    [] -> pure ()
  case Cusp.firstCusp whole of
    Just f -> mistake (Folds at (Cusp.place f) (Cusp.requested f) (Cusp.curvatureRadius f))
    Nothing -> pure whole
  where
    cornerAngle u = angleBetween (Exact.tangentFrom Exact.Before lower u) (leaving lower u)
    leaving = Exact.tangentFrom Exact.After
    -- A curve that is shifted by d has closed the gap dθ at a slight corner of the angle θ. Along
    -- the curve this changes nothing; across the curve it moves points if d varies.
    hasStep whole u =
      let turned@(Rad turn) = cornerAngle u
          Rad slope = angleBetween (leaving lower u) (leaving whole u)
          Mm d = Exact.shiftDistance whole u
       in turned <= Tolerance.kink && Mm (abs d * turn * sin slope) > Tolerance.smoothGap
    angleBetween v w = let Rad a = Vec.signedAngle v w in Rad (abs a)

-- | The distance between the end of one span of a curve and the start of the next one, at the
-- parameter @u@. If @u@ is 0 or less, the distance between the curve's end and its start.
gapAt :: Exact.Curve -> Double -> Mm
gapAt whole u = Vec.distance before (Exact.pointFrom Exact.After whole (max 0 u))
  where
    before = Exact.pointFrom Exact.Before whole (if u <= 0 then Exact.domain whole else u)

-- Joggles

-- | The curve @lower@ with a joggle to a side. The joggle lies between two points of @lower@, which
-- are given by their x coordinates.
--
-- Fails if both points are the same, or if an x coordinate does not belong to exactly one point of
-- @lower@. For a wrong coordinate the Minsk-22 system stopped with the code 15074 (Kolsanova).
-- Fails, too, if the radius is too small for the depth, or so large that the two ramps do not fit
-- between the points. For a radius that was too large, the code was 14174.
joggledBy :: Environment -> Carrier.Side -> Exact.Curve -> Joggle -> Eval Exact.Curve
joggledBy env side lower (Located at (Joggle from to depth radius)) = do
  a <- parameterAtX env lower from
  b <- parameterAtX env lower to
  when (a == b) (mistake (JoggleNowhere at))
  d <- joggleMeasure env depth
  r <- joggleMeasure env radius
  let joggle =
        ShiftDistance.Joggle
          { ShiftDistance.begins = min a b,
            ShiftDistance.ends = max a b,
            ShiftDistance.depth = d,
            ShiftDistance.radius = r
          }
  case Exact.fitJoggle joggle lower of
    Left Exact.DeepJoggle -> mistake (JoggleDepth (region radius) r (times 0.5 d))
    Left (Exact.LongJoggle _ available) ->
      mistake (JoggleRadius (region radius) r available (largestRadius d available))
    Left _ -> mistake (JoggleNowhere at)
    Right distance -> shiftedBy at side distance lower

-- | The parameter of the point whose x coordinate is the value of @e@. Fails unless the curve has
-- exactly one such point.
parameterAtX :: Environment -> Exact.Curve -> Expr -> Eval Double
parameterAtX env lower e = do
  x <- Expression.number <$> Expression.evaluate env e
  case Exact.atX x lower of
    [u] -> pure u
    us ->
      let points = map (Exact.at lower) us
       in mistake (JoggleCoordinate (region e) (Mm x) points (Curve.xRange lower))

-- | Evaluates the depth or the radius of a joggle, which must be above 0 and at most
-- 'Tolerance.reach'.
joggleMeasure :: Environment -> Expr -> Eval Mm
joggleMeasure env e = do
  x <- Expression.number <$> Expression.evaluate env e
  when (x <= 0) (Evaluation.mistake (NotPositive (region e) Parameter.JoggleMeasure x))
  Mm x <$ Value.within (region e) x

-- | The largest radius r with which a joggle of depth d fits into the length l. A report suggests
-- it. A joggle has two ramps, each √(d·(4r − d)) long. With the largest radius both ramps together
-- are as long as l. 'Nothing' if r would be at most d/2, which is too small for the depth.
largestRadius :: Mm -> Mm -> Maybe Mm
largestRadius depth@(Mm d) (Mm l) = if over r depth > 0.5 then Just r else Nothing
  where
    r = Mm ((l * l / 4) / (4 * d) + 0.25 * d)

-- Bevels

-- | Evaluates the bevels along an element. A pair of the result is a station (the arc length from
-- the start of the element, in mm) and the bevel there in radians. If @on@ is a curve, the stations
-- are measured along the lines and arcs that replace @on@. If @on@ is 'Nothing', the element is a
-- line or a circle and has one bevel.
bevelled :: Environment -> Maybe PartCurve -> Expr -> Eval [(Double, Double)]
bevelled env on e = case on of
  Nothing -> do
    a <- Expression.number <$> Expression.evaluate env e
    when (abs a >= bevelLimit) (mistake (SteepBevel (region e) Nothing (Rad a)))
    pure [(0, a)]
  Just c -> Curve.alongPolyarc c <$> (alongRows env c e >>= checkedBevels c e)

-- | Returns the bevels @values@ unchanged: one for each row of the curve's table, in radians. Fails
-- if the absolute value of a bevel reaches 'bevelLimit'. @e@ is the expression of the bevels.
checkedBevels :: PartCurve -> Expr -> Vector Double -> Eval (Vector Double)
checkedBevels c e values = case find ((>= bevelLimit) . abs . snd) numbered of
  Just (k, a) -> mistake (SteepBevel (region e) (if byRow then Just k else Nothing) (Rad a))
  Nothing -> pure values
  where
    numbered = zip [1 ..] (Vector.toList values)
    byRow = mentions (map fst (tableColumns c)) e

-- | The limit, in radians, that the absolute value of a bevel must stay below. It is just under a
-- right angle, whose tangent is infinite.
bevelLimit :: Double
bevelLimit = pi / 2 - 1e-6
