-- | Functions of regions and shapes: unions, differences, intersections, offsets, areas and centres
-- of gravity; rectangles, slots, polygons, ellipses and gears.
--
-- 'apply' tries three functions in turn. Each of them computes one group of the built-in functions,
-- and yields 'Nothing' for all other functions and arguments.
module Part.RegionBuiltin
  ( apply,
    regionOf,
    settled,
    contourOfCircle,
  )
where

import Base.Crash (bug)
import Base.Name (Name (..))
import Base.Quantity (Mm (..), Rad (..), total)
import Base.Region (Located (..), Region)
import Checked.Builtin qualified as Builtin
import Checked.Syntax (Builtin (..))
import Data.Foldable (asum)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Vector qualified as Vector
import Geometry.Carrier (Circle (..))
import Geometry.Polyarc (Ends (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Vec qualified as Vec
import Offset.RegionBoolean (BooleanOperation (..))
import Part.Error (ValueFact (..))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Parameter (LimitedQuantity (..), Range (FromTo))
import Part.Parameter qualified as Parameter
import Part.Part (Contour (..), Element (..), plainFinish, polyarcOf)
import Part.PlaneRegion (PlaneRegion (..), RegionFault (..))
import Part.PlaneRegion qualified as PlaneRegion
import Part.RegionError (RegionMistake (..))
import Part.Shape (Gear (..), ShapeFault (..), ShapeSegment (..))
import Part.Shape qualified as Shape
import Part.Value

-- | Computes a function of regions, or a shape. @region@ is the region of the call in the program.
-- 'Nothing' if @builtin@ with these arguments is another function.
apply :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
apply at builtin arguments = asum [f at builtin arguments | f <- [regionFunction, measure, shape]]

-- Regions

-- | Computes a function whose result is a region, or the contours of one. 'Nothing' for any other
-- function.
regionFunction :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
regionFunction at builtin arguments = case (builtin, arguments) of
  (RegionOf, [Plain v]) -> Just (operation Union [v])
  (UnionOf, [Plain v]) -> Just (operation Union [v])
  (UnionOf, [Plain a, Plain b]) -> Just (operation Union [a, b])
  (Intersection, [Plain a, Plain b]) | any isOutlined [a, b] -> Just (operation Common [a, b])
  (DifferenceOf, [Plain a, Plain b]) -> Just (operation Difference [a, b])
  (OffsetOf, [Plain v, Plain (Quantity d)]) ->
    Just (RegionValue <$> offsetOf at (named at builtin) v d)
  (OutlinesOf, [Plain (RegionValue r)]) -> Just (pure (contours (map PlaneRegion.outer (parts r))))
  (HolesOf, [Plain (RegionValue r)]) ->
    Just (pure (contours (concatMap PlaneRegion.holes (parts r))))
  _ -> Nothing
  where
    contours = ListValue . Vector.fromList . map ContourValue
    operation how vs = do
      regions <- concat <$> traverse (regionsOf at) vs
      spendOn at regions
      RegionValue <$> settled at (PlaneRegion.combined (named at builtin) how regions)
    isOutlined v = case v of
      RegionValue _ -> True
      ContourValue _ -> True
      _ -> False

-- | The name of the contours that a function makes, which is its own.
named :: Region -> Builtin -> Located Name
named at builtin = Located at (Name (Builtin.name builtin))

-- | Counts a step for each element of regions.
spendOn :: Region -> [PlaneRegion] -> Eval ()
spendOn at regions =
  Evaluation.spend at (sum [length (elements c) | r <- regions, c <- PlaneRegion.contoursOf r])

-- | The regions that a value gives: the inside of a contour or of a circle, or those of a list.
regionsOf :: Region -> Value -> Eval [PlaneRegion]
regionsOf at v = case v of
  RegionValue r -> pure [r]
  ContourValue c -> pure <$> settled at (PlaneRegion.inside c)
  CircleValue c -> pure <$> settled at (PlaneRegion.inside (contourOfCircle at c))
  ListValue vs -> concat <$> traverse (regionsOf at) (Vector.toList vs)
  _ -> bug "a region of something else"

-- | One region of a value.
regionOf :: Region -> Value -> Eval PlaneRegion
regionOf at v = do
  regions <- regionsOf at v
  settled at (PlaneRegion.combined (named at RegionOf) Union regions)

-- | Reports the fault of a region.
settled :: Region -> Either RegionFault a -> Eval a
settled at found = case found of
  Right a -> pure a
  Left (OpenOutline c) ->
    let Located there name = contourName c in mistake (OpenOperand at name there)
  Left (OutlineCrosses c a b) ->
    mistake (CrossingOperand at (value (contourName c)) (origin a) (origin b))
  Left RegionUndecided -> mistake (UndecidedRegion at)

mistake :: RegionMistake -> Eval a
mistake = Evaluation.mistake . InRegion

-- | The points within a distance of a value, or, with a negative distance, inside it.
offsetOf :: Region -> Located Name -> Value -> Double -> Eval PlaneRegion
offsetOf at name v d = do
  within at d
  case v of
    ContourValue c
      | ends c == Open ->
        if d > 0
          then moved [c]
          else mistake (InsideOfOpen at (Mm d))
    _ -> regionOf at v >>= \r -> if d == 0 then pure r else moved (PlaneRegion.contoursOf r)
  where
    moved contours = do
      Evaluation.spend at (sum (map (length . elements) contours))
      settled at (PlaneRegion.offsetBy at name (Mm d) contours)

-- | Computes an area, a perimeter or a centre of gravity. 'Nothing' for any other function.
measure :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
measure at builtin arguments = case (builtin, arguments) of
  (AreaOf, [Plain v]) -> Just (regionOf at v >>= finite at . PlaneRegion.area)
  (LengthOf, [Plain (RegionValue r)]) ->
    let Mm l = total (map (Polyarc.length . polyarcOf) (PlaneRegion.contoursOf r))
     in Just (finite at l)
  (CentroidOf, [Plain v]) -> Just $ do
    r <- regionOf at v
    maybe (mistake (EmptyRegion at)) (spatial at . offset) (PlaneRegion.centroid r)
  _ -> Nothing

-- Shapes

-- | Computes a function whose result is a shape. 'Nothing' for any other function.
shape :: Region -> Builtin -> [Argument] -> Maybe (Eval Value)
shape at builtin arguments = made <$> asum [f at builtin arguments | f <- [cornered, curved]]
  where
    made answer = do
      segments <- answer >>= either (mistake . NoSuchShape at) pure
      Evaluation.spend at (length segments)
      pure (ContourValue (contourOfShape at (named at builtin) segments))

-- | A shape that is evaluated, or the reason why there is none.
type Shaped = Eval (Either ShapeFault (NonEmpty ShapeSegment))

-- | Computes a rectangle, a bar, a slot or a polygon.
cornered :: Region -> Builtin -> [Argument] -> Maybe Shaped
cornered at builtin arguments = case (builtin, arguments) of
  (MakeRectangle, [Plain (Spatial p), Plain (Spatial q)]) ->
    Just (pure (Shape.rectangle (fromOrigin p) (fromOrigin q)))
  (MakeRectangle, [Plain (Spatial p), Plain (Quantity w), Plain (Quantity h)]) ->
    Just (Shape.rectangle (fromOrigin p) <$> corner (fromOrigin p) w h)
  (MakeBar, [Plain (Quantity d), Plain (Quantity l)]) ->
    Just (Shape.rectangle (Vec.point (-l) 0) <$> corner (Vec.point (-l) 0) l (d / 2))
  (MakeRounded, [Plain (Spatial p), Plain (Spatial q), Plain (Quantity r)]) ->
    Just (Shape.rounded (fromOrigin p) (fromOrigin q) <$> size at r)
  (MakeRounded, [Plain (Spatial p), Plain (Quantity w), Plain (Quantity h), Plain (Quantity r)]) ->
    Just (Shape.rounded (fromOrigin p) <$> corner (fromOrigin p) w h <*> size at r)
  (MakeSlot, [Plain (Spatial p), Plain (Spatial q), Plain (Quantity w)]) ->
    Just (Shape.slot (fromOrigin p) (fromOrigin q) <$> size at w)
  (MakePolygon, [Plain (ListValue vs)]) ->
    Just (pure (polygon [fromOrigin v | Spatial v <- Vector.toList vs]))
  (MakePolygon, [Plain (CircleValue c), Plain (Quantity n)]) -> Just (regular c n 0)
  (MakePolygon, [Plain (CircleValue c), Plain (Quantity n), Plain (Quantity a)]) ->
    Just (regular c n a)
  _ -> Nothing
  where
    corner p w h = do
      Mm w' <- size at w
      Mm h' <- size at h
      pure (Vec.shift (Vec.vec w' h') p)
    atLeast low what n
      | n < low = Evaluation.mistake (NotWhole at what (FromTo (round low) 10000000) n)
      | otherwise = do
        count <- whole at what n
        count <$ Evaluation.spend at count
    polygon ps = maybe (Left TooFewCorners) Shape.polygon (NonEmpty.nonEmpty ps)
    regular (Circle o r) n a = do
      count <- atLeast 3 Parameter.CornerCount n
      pure
        ( polygon
            [ Vec.shift (Vec.polar r (Rad (a + 2 * pi * fromIntegral k / fromIntegral count))) o
              | k <- [0 .. count - 1]
            ]
        )

-- | Computes an ellipse or a gear.
curved :: Region -> Builtin -> [Argument] -> Maybe Shaped
curved at builtin arguments = case (builtin, arguments) of
  (MakeEllipse, [Plain (Spatial o), Plain (Quantity a), Plain (Quantity b)]) ->
    Just (ellipse o a b 0)
  (MakeEllipse, [Plain (Spatial o), Plain (Quantity a), Plain (Quantity b), Plain (Quantity t)]) ->
    Just (ellipse o a b t)
  (MakeGear, [Plain (Quantity m), Plain (Quantity z)]) -> Just (gear m z (20 * pi / 180))
  (MakeGear, [Plain (Quantity m), Plain (Quantity z), Plain (Quantity a)]) -> Just (gear m z a)
  _ -> Nothing
  where
    ellipse o a b turn =
      (\a' b' -> Right (Shape.ellipse (fromOrigin o) a' b' (Rad turn)))
        <$> size at a <*> size at b
    gear m z a = do
      Mm m' <- size at m
      teeth <- whole at Parameter.ToothCount z
      -- The fit of a flank takes some time for each tooth.
      Evaluation.spend at (10 * teeth)
      pure (Shape.gear Gear {gearModule = m', teeth, pressureAngle = a})

-- | A size of a shape, which is above 0.
size :: Region -> Double -> Eval Mm
size at x
  | x <= 0 = Evaluation.mistake (NotPositive at ShapeSize x)
  | otherwise = Mm x <$ within at x

-- | The contour of a circle, which is counter-clockwise.
contourOfCircle :: Region -> Circle -> Contour
contourOfCircle at c = contourOfShape at (named at MakeCircle) (Shape.circle c)

-- | The contour of a shape. Its elements are at the place of the call.
contourOfShape :: Region -> Located Name -> NonEmpty ShapeSegment -> Contour
contourOfShape at name segments =
  Contour
    { contourName = name,
      ends = Closed,
      elements = fmap element segments,
      breaks = [],
      writtenElements = []
    }
  where
    element s =
      Element
        { segment = shapeSegment s,
          origin = at,
          finish = plainFinish,
          continues = isContinued s,
          ofCurve = isOfCurve s,
          replaced = shapeCurve s,
          bevel = Nothing
        }
