-- | The data of the SVG element @path@: its attribute @d@, by the grammar of SVG 1.1, section 8.3.
module Drawing.SvgPath
  ( fromText,
    arcPiece,
  )
where

import Base.Quantity (Mm (..), Rad (..), radians)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Drawing.Drawing (PathPart (..), Shape (..))
import Drawing.Ellipse qualified as Ellipse
import Drawing.Number qualified as Number
import Drawing.SvgNumber (skipBlanks, skipComma)
import Geometry.Polyarc (Ends (..))
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec

-- | The state of the pen.
data Pen = Pen
  { -- | the point at which the present subpath begins
    origin :: Point,
    -- | the end of the last part
    current :: Point,
    -- | the last control point of the command before, if it was a cubic or a quadratic curve
    control :: Control,
    -- | the parts of the present subpath in reverse
    parts :: [PathPart],
    -- | the subpaths before, in reverse
    subpaths :: [Shape]
  }

-- | The last control point of a curve, for the commands that continue it smoothly.
data Control = NoControl | Cubic Point | Quadratic Point

-- | The subpaths of a text as paths. A subpath that only moves has no path. The rest of the text at
-- the first mistake in 'Left'.
fromText :: Text -> Either Text [Shape]
fromText text = case Text.uncons start of
  Nothing -> Right []
  Just ('M', rest) -> go 'M' rest
  Just ('m', rest) -> go 'm' rest
  Just _
    | Text.strip start == "none" -> Right []
    | otherwise -> Left start
  where
    start = skipBlanks text
    zero = Vec.point 0 0
    go first rest = commands (Pen zero zero NoControl [] []) first rest

-- | Carries out a command with the text after its letter, and all commands after it.
commands :: Pen -> Char -> Text -> Either Text [Shape]
commands pen letter text = do
  (next, rest) <- command pen letter (skipBlanks text)
  let more = skipComma rest
  case Text.uncons (skipBlanks rest) of
    Nothing -> Right (reverse (subpaths (finished Open next)))
    Just (c, after)
      | c `elem` letters -> commands next c after
      | letter `elem` ("Zz" :: String) -> Left (skipBlanks rest)
      | otherwise -> commands next (repeated letter) more
  where
    letters = "MmLlHhVvCcSsQqTtAaZz" :: String

-- | The command that further numbers after those of a command mean.
repeated :: Char -> Char
repeated letter = case letter of
  'M' -> 'L'
  'm' -> 'l'
  _ -> letter

-- | Carries out one command with its numbers.
command :: Pen -> Char -> Text -> Either Text (Pen, Text)
command pen letter text = case letter of
  'M' -> point text >>= move
  'm' -> point text >>= move . relative
  'L' -> point text >>= line
  'l' -> point text >>= line . relative
  'H' -> number text >>= \(x, rest) -> line (Vec.point x (Vec.y here), rest)
  'h' -> number text >>= \(x, rest) -> line (Vec.shift (Vec.vec x 0) here, rest)
  'V' -> number text >>= \(y, rest) -> line (Vec.point (Vec.x here) y, rest)
  'v' -> number text >>= \(y, rest) -> line (Vec.shift (Vec.vec 0 y) here, rest)
  'C' -> points 3 text >>= curve
  'c' -> points 3 text >>= curve . allRelative
  'S' -> points 2 text >>= curve . reflected
  's' -> points 2 text >>= curve . reflected . allRelative
  'Q' -> points 2 text >>= curve
  'q' -> points 2 text >>= curve . allRelative
  'T' -> points 1 text >>= curve . smooth
  't' -> points 1 text >>= curve . smooth . allRelative
  'A' -> arc pen text id
  'a' -> arc pen text (`countedFrom` here)
  _ -> Right (closed pen, text)
  where
    here = current pen
    move (p, rest) =
      Right ((finished Open pen) {origin = p, current = p, control = NoControl}, rest)
    line (p, rest) = Right (drawn (Plain (Straight here p)) p NoControl pen, rest)
    relative (p, rest) = (p `countedFrom` here, rest)
    allRelative (ps, rest) = (map (`countedFrom` here) ps, rest)
    curve (ps, rest) = case ps of
      [a, b, p] -> Right (drawn (bezier [a, b, p]) p (Cubic b) pen, rest)
      [a, p] -> Right (drawn (bezier [a, p]) p (Quadratic a) pen, rest)
      _ -> Left text
    bezier ps = Bezier (here :| ps) Nothing
    reflected (ps, rest) = (mirrored (case control pen of Cubic c -> c; _ -> here) : ps, rest)
    smooth (ps, rest) = (mirrored (case control pen of Quadratic c -> c; _ -> here) : ps, rest)
    mirrored c = Vec.shift (Vec.to c here) here

-- | A point whose coordinates count from another one.
countedFrom :: Point -> Point -> Point
countedFrom p = Vec.shift (Vec.to (Vec.point 0 0) p)

-- | The pen after a part that ends at a point.
drawn :: PathPart -> Point -> Control -> Pen -> Pen
drawn part end control pen = pen {current = end, control, parts = part : parts pen}

-- | The pen after the subpath has been closed by a line to its beginning.
closed :: Pen -> Pen
closed pen = (finished Closed back) {current = origin pen, control = NoControl}
  where
    back
      | current pen == origin pen || null (parts pen) = pen
      | otherwise = drawn (Plain (Straight (current pen) (origin pen))) (origin pen) NoControl pen

-- | The pen with the present subpath among those before. A subpath that ends where it begins is
-- closed, too.
finished :: Ends -> Pen -> Pen
finished ends pen = case NonEmpty.nonEmpty (reverse (parts pen)) of
  Nothing -> pen
  Just whole -> pen {parts = [], subpaths = Path really whole : subpaths pen}
  where
    really = if current pen == origin pen then Closed else ends

-- Arcs ----------------------------------------------------------------------------------------

-- | The command for an arc: radii, angle of the first axis in degrees, two flags, end. An arc with
-- a radius of 0 is a line, and one that ends where it begins is left out.
arc :: Pen -> Text -> (Point -> Point) -> Either Text (Pen, Text)
arc pen text place = do
  (rx, afterX) <- number text
  (ry, afterY) <- number (skipComma afterX)
  (degrees, afterAngle) <- number (skipComma afterY)
  (isLarge, afterLarge) <- flag (skipComma afterAngle)
  (isPositive, afterFlags) <- flag (skipComma afterLarge)
  (p, rest) <- point (skipComma afterFlags)
  let here = current pen
      end = place p
      u = Vec.polar (Mm (abs rx)) (radians degrees)
      v = Vec.left (Vec.polar (Mm (abs ry)) (radians degrees))
      part
        | rx == 0 || ry == 0 = Just (Plain (Straight here end))
        | here == end = Nothing
        | otherwise = Just (ellipticalArc (u, v) (isLarge, isPositive) here end)
  Right (maybe pen (\q -> drawn q end NoControl pen) part, rest)

-- | The arc of an ellipse with two semi-axes from one point to another. In the coordinates of the
-- semi-axes the ellipse is a circle of radius 1. The centre lies on the normal of the chord at its
-- midpoint, on the left of the chord if the arc is small and runs from x to y, or large and runs
-- the other way. Semi-axes that are too short for the chord are lengthened (SVG 1.1, section
-- F.6.6).
ellipticalArc :: (Vec, Vec) -> (Bool, Bool) -> Point -> Point -> PathPart
ellipticalArc (u, v) (isLarge, isPositive) start end =
  arcPiece (start, end) centre (scaled u, scaled v) from (from + turn)
  where
    inAxes w = Vec.vec (Vec.dot w u / Vec.dot u u) (Vec.dot w v / Vec.dot v v)
    half = Vec.scale 0.5 (inAxes (Vec.to start end))
    k = max 1 (Vec.norm half)
    scaled = Vec.scale k
    h = Vec.scale (1 / k) half
    side = if isLarge == isPositive then -1 else 1
    out = Vec.scale (side * sqrt (max 0 (1 / Vec.dot h h - 1))) (Vec.left h)
    atStart = Vec.negate (Vec.add h out)
    atEnd = Vec.add h (Vec.negate out)
    Rad from = Vec.angle atStart
    Rad short = Vec.signedAngle atStart atEnd
    turn
      | isPositive && short < 0 = short + 2 * pi
      | not isPositive && short > 0 = short - 2 * pi
      | otherwise = short
    centre = Vec.shift (combined out) (Vec.interpolate 0.5 start end)
    combined (Vec.Vec x y) = Vec.add (Vec.scale x (scaled u)) (Vec.scale y (scaled v))

-- | The part of an ellipse with conjugate semi-diameters between two parameters, with given ends.
arcPiece :: (Point, Point) -> Point -> (Vec, Vec) -> Double -> Double -> PathPart
arcPiece (start, end) centre (u, v) from to = case Ellipse.part centre u v from to of
  Plain segment -> Plain segment {start, end}
  part -> part

-- Numbers -------------------------------------------------------------------------------------

number :: Text -> Either Text (Double, Text)
number text = maybe (Left text) Right (Number.leading text)

-- | A flag of an arc is one digit, so that it needs no separator after it.
flag :: Text -> Either Text (Bool, Text)
flag text = case Text.uncons text of
  Just ('0', rest) -> Right (False, rest)
  Just ('1', rest) -> Right (True, rest)
  _ -> Left text

point :: Text -> Either Text (Point, Text)
point text = do
  (x, afterX) <- number text
  (y, rest) <- number (skipComma afterX)
  Right (Vec.point x y, rest)

points :: Int -> Text -> Either Text ([Point], Text)
points count text
  | count == 0 = Right ([], text)
  | otherwise = do
    (p, rest) <- point text
    (ps, more) <- if count == 1 then Right ([], rest) else points (count - 1) (skipComma rest)
    Right (p : ps, more)
