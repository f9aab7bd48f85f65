-- | Items of a contour from an outline of a drawing.
--
-- A line needs only its two ends, which are elements. Between the ends of an arc stands its circle,
-- and between the ends of a curve the curve.
module Surface.DrawnContour
  ( items,
    closure,
    size,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (Mm (..), Rad (..))
import Base.Region (Located (..), Region)
import Data.Foldable (toList)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Drawing.Drawing (Ellipse (..), PathPart (..), Spline (..))
import Drawing.Outline (DrawnPart (..), Outline (..))
import Drawing.OutlineTolerance qualified as Tolerance
import Drawing.PathPart qualified as PathPart
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Surface.Syntax (Argument (Given), Closure, Expr, Expr_ (..), Item, Item_ (..), Numeral (..))
import Surface.Syntax qualified as Surface
import Surface.Token (Unit (..))

-- | The items of the contour of an outline, each with its part. @regionOf@ gives the region of a
-- part. Lengths have the unit @unit@; the numbers are in mm.
items :: (DrawnPart -> Region) -> Maybe Unit -> Outline -> [(DrawnPart, Item)]
items regionOf unit outline = case NonEmpty.toList (parts outline) of
  [p] | ends outline == Closed -> [(p, element p e) | e <- wholeElement (at p) unit (part p)]
  list ->
    concatMap ofPiece list
      <> [ (p, element p (Nothing, point (at p) unit (PathPart.end (part p))))
           | ends outline == Open,
             p <- take 1 (reverse list)
         ]
  where
    at = regionOf
    element p (sense, e) = Located (at p) (Element (Located (at p) <$> sense) e [] Nothing)
    ofPiece p =
      (p, element p (Nothing, point (at p) unit (PathPart.start (part p)))) :
        [(p, element p e) | e <- betweenEnds (at p) unit (part p)]

-- | The closure of the contour of an outline.
closure :: Outline -> Closure
closure outline = case ends outline of
  Closed -> Surface.Closed
  Open -> Surface.Open

-- | The elements of a part that is closed by itself.
wholeElement :: Region -> Maybe Unit -> PathPart -> [(Maybe Surface.Sense, Expr)]
wholeElement at unit part = case part of
  EllipseArc Ellipse {middle, major, minor, direction = Rad a} _ _ ->
    [ ( Nothing,
        call
          at
          "ellipse"
          ([point at unit middle, long major, long minor] <> [radians at a | a /= 0])
      )
    ]
  _ -> betweenEnds at unit part
  where
    long (Mm v) = size at unit v

-- | The element between the ends of a part; none for a line.
betweenEnds :: Region -> Maybe Unit -> PathPart -> [(Maybe Surface.Sense, Expr)]
betweenEnds at unit part = case part of
  Plain (Straight _ _) -> []
  Plain (Arc begin _ centre (Rad sweep)) ->
    let Mm r = Segment.radius centre begin
        sense = if sweep > 0 then Surface.CounterClockwise else Surface.Clockwise
     in [(Just sense, call at "circle" [point at unit centre, size at unit r])]
  _ -> [(Nothing, curveOf at unit part)]

-- | The call that makes the curve of a part.
curveOf :: Region -> Maybe Unit -> PathPart -> Expr
curveOf at unit part = case part of
  Plain s -> call at "line" [point at unit (Segment.start s), point at unit (Segment.end s)]
  EllipseArc Ellipse {middle, major = Mm a, minor = Mm b, direction = Rad turned} from to ->
    call at "ellipse" $
      [point at unit middle, size at unit a, size at unit b]
        <> map (radians at) [turned, from, to]
  Bezier points weights' -> call at "bezier" (listOf points : map plainList (toList weights'))
  BSpline Spline {degree, knots, controls, weights} ->
    call at "bspline" $
      [ number at Nothing (fromIntegral degree),
        listOf controls,
        Located at (List (map (number at Nothing) knots))
      ]
        <> map plainList (toList weights)
  where
    listOf = Located at . List . map (point at unit) . NonEmpty.toList
    plainList = Located at . List . map (number at Nothing) . NonEmpty.toList

-- | A point, from a position in mm.
point :: Region -> Maybe Unit -> Point -> Expr
point at unit p = Located at (Pair (size at unit (Vec.x p)) (size at unit (Vec.y p)))

-- | A length in mm, rounded to 'Tolerance.decimals'.
size :: Region -> Maybe Unit -> Double -> Expr
size at unit v = number at unit (if abs v < 1e5 then fromIntegral rounded / scale else v)
  where
    scale = 10 ^ Tolerance.decimals :: Double
    rounded = round (v * scale) :: Int

-- | A number that is read as exactly the same value.
number :: Region -> Maybe Unit -> Double -> Expr
number at unit v
  | v < 0 = Located at (Negate (Located at (literal (negate v))))
  | otherwise = Located at (literal v)
  where
    literal x = Literal (Numeral (Decimal.exact x) x) unit

radians :: Region -> Double -> Expr
radians at = number at (Just Radian)

-- | A call of a function of the language.
call :: Region -> Text -> [Expr] -> Expr
call at function arguments = case map Given arguments of
  first : more -> Located at (Call (Located at (Name function)) (first :| more))
  [] -> Located at (Variable (Name function))
