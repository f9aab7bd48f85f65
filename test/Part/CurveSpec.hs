-- | Laws of curves, from the text of a program to the toolpath: the part and the toolpath have the
-- geometry of the exact curves.
module Part.CurveSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Base.Result qualified as Result
import Compile (Analysis (..))
import Compile qualified
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Vector qualified as Vector
import Generate.Curve qualified as Curves
import Geometry.ArcFitting.Biarc qualified as Biarc
import Geometry.Carrier (Line (Line))
import Geometry.Curve (Curve, Distance (..), EndCondition (..), Growth (..), Side (..))
import Geometry.Curve qualified as Curve
import Geometry.Distance qualified as Distance
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (Arc, Straight))
import Geometry.Segment qualified as Segment
import Geometry.Transformation (Transformation)
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part qualified as Part
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report (ReportCode (..))
import Report.Report qualified as Report
import Test.Hspec hiding (after, before)
import Test.Hspec.QuickCheck (modifyMaxSuccess)
import Test.QuickCheck
import Toolpath.Toolpath qualified as Toolpath

spec :: Spec
spec = do
  describe "a spline through the points of a circle" $ do
    it
      "is milled like the circle (catches an offset of chords, and a gap between the arcs that \
      \approximate a curve)"
      $ property $
        forAll ((,,) <$> elements ["outside", "inside"] <*> written 1 30 <*> shares) $
          \(side, r, ts) ->
            let text =
                  header r
                    <> "curve ring = closed_spline(around(circle((10, 20), 50), 60))\ncontour k \
                       \closed { ring }\nmill k "
                    <> side
                    <> " { }\n"
                radius = if side == "outside" then 50 + r else 50 - r
                c = Vec.point 10 20
             in milled text $ \cut ->
                  conjoin [near radius (Segment.at t s `apart` c) | s <- cut, t <- ts]
                    .&&. near (2 * pi * radius) (sum (map lengthOf cut))
    it
      "is joined to a line by the fillet of the circle (catches a fillet that touches a chord, or \
      \the wrong side of a curve)"
      $ property $
        forAll rounding $ \rounding'@Rounding {middle, filletRadius, first, touches} ->
          case ( filletOf (rounded "ring" rounding'),
                 filletOf (rounded "ccw circle(c, 50)" rounding')
               ) of
            (Just onCurve, Just onCircle) ->
              conjoin
                [ coincide 1e-4 middle (centreOf onCurve),
                  coincide 1e-4 (centreOf onCircle) (centreOf onCurve),
                  near filletRadius (Segment.start onCurve `apart` centreOf onCurve),
                  coincide 1e-4 first (Segment.start onCurve),
                  coincide 1e-4 touches (Segment.end onCurve)
                ]
            (a, b) -> counterexample (show (a, b)) False
  describe "a contour" $ do
    it
      "of arcs keeps its arcs, also when it is reversed or transformed (catches arcs that are \
      \approximated by other arcs)"
      $ property $
        forAll ((,,) <$> pathPoints <*> motion <*> shares) $ \(points, (s, _, (begin, rest)), ts) ->
          let text =
                "part p\ncurve a = arcs([" <> Text.intercalate ", " (map point points) <> "])\n"
              own =
                maybe [] (NonEmpty.toList . Biarc.through Polyarc.Open) (NonEmpty.nonEmpty points)
              on segments p =
                minimum [d | g <- segments, let { Mm d = Distance.toPoint p g }] `atMost` 1e-8
           in conjoin
                [ elementsOf (text <> "contour k open { " <> what <> " }\n") `soundly` \found ->
                    conjoin [on found (moved (Segment.at t g)) | g <- own, t <- ts]
                      .&&. near (sum (map lengthOf own)) (sum (map lengthOf found))
                  | (what, moved) <-
                      [ ("a", id),
                        ("reversed(a)", id),
                        (begin <> "a" <> rest, Transformation.point s)
                      ]
                ]
    it
      "of two curves that cross follows each curve from one intersection to the other (catches a \
      \curve that is followed beyond the intersection, or whose wrong part is followed)"
      $ property $
        forAll crossing $ \(upper, lower) ->
          let text =
                "part p\n"
                  <> splineOf "a" Natural upper
                  <> splineOf "b" Natural lower
                  <> "contour k closed {\n  a meet near (100, 0)\n  b meet near (0, 0)\n}\n"
              a = exactly Natural upper
              b = exactly Natural lower
           in elementsOf text `soundly` \segments ->
                let corners =
                      [ Segment.start s
                        | (s, p) <- zip segments (drop (length segments - 1) (cycle segments)),
                          isCorner p s
                      ]
                 in conjoin
                      [ min (p `offCurve` a) (p `offCurve` b) `atMost` 2e-5
                        | s <- segments,
                          t <- [0, 0.3, 0.7, 1],
                          let p = Segment.at t s
                      ]
                      .&&. case corners of
                        [p, q] ->
                          conjoin
                            [max (c `offCurve` a) (c `offCurve` b) `atMost` 2e-5 | c <- [p, q]]
                            .&&. near
                              (lengthBetween p q a + lengthBetween p q b)
                              (sum (map lengthOf segments))
                        _ -> counterexample (show corners) False
    it
      "of curves has the same geometry when it is reversed (catches a reversed contour whose arcs \
      \are not reversed)"
      $ property $
        forAll ((,) <$> pathPoints <*> shares) $ \(points, ts) ->
          let text =
                "part p\n"
                  <> splineOf "a" Natural points
                  <> "contour k open { a line(end_of(a), end_of(a) + polar(30, tangent_of(a, \
                     \end_of(a)))) }\n"
              back = text <> "contour l open { reversed(k) }\n"
           in elementsOf back `soundly` \both ->
                let (there, home) = splitAt (length both `div` 2) both
                 in near (sum (map lengthOf there)) (sum (map lengthOf home))
                      .&&. coincide 1e-9 (Segment.start (head' there)) (Segment.end (last home))
                      .&&. conjoin
                        [ coincide 1e-9 (Segment.at t s) (Segment.at (1 - t) r)
                          | (s, r) <- zip there (reverse home),
                            t <- ts
                        ]
  describe "a piece" . modifyMaxSuccess (const 50) $ do
    it
      "is transformed to the piece of the transformed curve, and a reflection swaps its sides \
      \(catches a side or a column that is not transformed)"
      $ property $
        forAll ((,,) <$> pieceCase <*> motion <*> shares) $ \(c, (s, mirrors, (begin, rest)), ts) ->
          let plain = pieceText c
              words' e = begin <> e <> rest
              of' = contourOf c
              other = if mirrors then swapped c else c
              moved =
                "curve moved_skin = "
                  <> words' "skin"
                  <> "\n"
                  <> pieceNamed "moved_piece" "moved_skin" other
           in case ( elementsOf (plain <> of' "edge"),
                     elementsOf (plain <> of' (words' "edge")),
                     elementsOf (plain <> moved <> of' "moved_piece")
                   ) of
                (Just here, Just there, Just there') ->
                  conjoin [along s ts here there, along s ts here there']
                (Nothing, Nothing, Nothing) -> discard
                (a, b, d) ->
                  counterexample (show (fmap length a, fmap length b, fmap length d)) False
    it
      "follows the exact curve (catches a cipher on the wrong side, in the wrong order, or left \
      \out)"
      $ property $
        forAll ((,) <$> pieceCase <*> shares) $ \(c, ts) ->
          case elementsOf (pieceText c <> contourOf c "edge") of
            Nothing -> discard
            Just segments ->
              conjoin [Segment.at t s `offCurve` pieceOf c `atMost` 1.2e-5 | s <- segments, t <- ts]
    it
      "is milled at the radius of the cutter from the exact curve (catches an offset of an \
      \approximated offset, and a cut on the wrong side)"
      $ property $
        forAll ((,,,) <$> pieceCase <*> elements [LeftOf, RightOf] <*> written 0.5 6 <*> shares) $
          \(c, side, r, ts) ->
            let text =
                  header r
                    <> dropPart (pieceText c)
                    <> contourOf c "edge"
                    <> "mill k "
                    <> word side
                    <> " { }\n"
                exact = pieceOf c
             in case cutsOf text of
                  Nothing -> discard
                  Just cut ->
                    conjoin
                      [near r (p `offCurve` exact) | s <- cut, t <- ts, let p = Segment.at t s]
                      .&&. counterexample
                        "side"
                        ( conjoin
                            [ signOf side
                                * Vec.cross (Curve.tangent exact u) (Vec.to (Curve.at exact u) p)
                                  > 0
                              | s <- cut,
                                let p = Segment.at 0.5 s,
                                let u = Curve.nearest p exact
                            ]
                        )

-- Numbers

near :: Double -> Double -> Property
near a b = counterexample (show (a, b)) (abs (a - b) < 1e-4)

atMost :: Double -> Double -> Property
atMost a b = counterexample (show a <> " > " <> show b) (a <= b)

-- | Two points less than this many mm apart.
coincide :: Double -> Point -> Point -> Property
coincide slack a b = counterexample (show (a, b)) (a `apart` b < slack)

apart :: Point -> Point -> Double
apart a b = let Mm d = Vec.distance a b in d

-- | The distance of a point from a curve in mm.
offCurve :: Point -> Curve -> Double
offCurve p c = p `apart` Curve.at c (Curve.nearest p c)

-- | The length of a curve between two of its points.
lengthBetween :: Point -> Point -> Curve -> Double
lengthBetween p q c = abs (at p - at q)
  where
    at x = let Mm s = Curve.lengthAt c (Curve.nearest x c) in s

lengthOf :: Segment -> Double
lengthOf s = let Mm l = Segment.length s in l

-- | Fractions of a segment's length, from 0 to 1.
shares :: Gen [Double]
shares = vectorOf 3 (choose (0, 1))

-- | A number between two limits, with the three decimals that the program will contain.
written :: Double -> Double -> Gen Double
written a b = (/ 1000) . fromIntegral <$> choose (round (a * 1000), round (b * 1000) :: Int)

-- | The centre of an arc; the start of a line.
centreOf :: Segment -> Point
centreOf s = case s of
  Arc {Segment.centre = c} -> c
  Straight {Segment.start = p} -> p

signOf :: Side -> Double
signOf side = case side of
  LeftOf -> 1
  RightOf -> -1

word :: Side -> Text
word side = case side of
  LeftOf -> "left"
  RightOf -> "right"

head' :: [a] -> a
head' xs = case xs of
  x : _ -> x
  [] -> error "nothing"

-- Fillets

-- | A line to a circle of radius 50, and the fillet between them.
data Rounding = Rounding
  { -- | the direction of the line in degrees
    heading :: Double,
    -- | the distance from the circle's centre to the line, positive to the left of the heading
    offset :: Double,
    clockwise :: Bool,
    filletRadius :: Double,
    -- | the centre of the fillet
    middle :: Point,
    -- | the start of the fillet, on the line
    first :: Point,
    -- | the end of the fillet, on the circle
    touches :: Point,
    -- | the angle on the circle, in degrees, at which the curve begins and ends
    final :: Double
  }
  deriving stock (Show)

-- | If the line is parallel to x at the height h and the circle's centre is the origin, the centre
-- of the fillet lies at the height @h ∓ R@ and at the distance @50 ± R@ from the origin.
rounding :: Gen Rounding
rounding = do
  heading <- written 0 360
  offset <- written (-15) 15
  clockwise <- arbitrary
  r <- written 2 10
  let high = if clockwise then offset - r else offset + r
      away = if clockwise then 50 + r else 50 - r
      far = (if clockwise then negate else id) (sqrt (away * away - high * high))
      turned x y =
        Transformation.point
          (Transformation.rotation (Rad (heading * pi / 180)) (Vec.point 0 0))
          (Vec.point x y)
      place x y = let p = turned x y in Vec.point (Vec.x p + 10) (Vec.y p + 20)
      Rad a = Vec.angle (Vec.to (Vec.point 0 0) (turned far high))
  pure
    Rounding
      { heading,
        offset,
        clockwise,
        filletRadius = r,
        middle = place far high,
        first = place far offset,
        touches = place (far * 50 / away) (high * 50 / away),
        -- The curve begins and ends shortly after the fillet.
        final = fromIntegral (round ((a * 180 / pi + 30) * 1000) :: Int) / 1000
      }

-- | A program with an open contour: the line, the fillet, and an element up to a point of the
-- circle.
rounded :: Text -> Rounding -> Text
rounded element Rounding {heading, offset, clockwise, filletRadius, final} =
  Text.unlines
    [ "part p",
      "let c = (10, 20)",
      "let foot = c + polar(" <> number offset <> ", " <> number (heading + 90) <> ")",
      "curve ring = closed_spline(around(circle(c, 50), 60, " <> number final <> "))",
      "contour k open {",
      "  line(foot + polar(-100, "
        <> number heading
        <> "), foot) fillet "
        <> number (if clockwise then filletRadius else -filletRadius),
      "  " <> element,
      "  c + polar(50, " <> number final <> ")",
      "}"
    ]

-- | The second segment of a contour.
filletOf :: Text -> Maybe Segment
filletOf text = case elementsOf text of
  Just (_ : s : _) -> Just s
  _ -> Nothing

-- Curves

-- | Two curves that cross near (0, 0) and near (100, 0).
crossing :: Gen ([Point], [Point])
crossing = (,) <$> arched 1 <*> (reverse <$> arched (-1))
  where
    arched s = do
      ends <- vectorOf 2 (written 5 20)
      tops <- vectorOf 3 (written 10 30)
      pure
        ( zipWith
            Vec.point
            [-15, 20, 50, 80, 115]
            (map (s *) (zipWith (*) [-1, 1, 1, 1, -1] (take 1 ends <> tops <> drop 1 ends)))
        )

-- | Points of a path that may be vertical and reverse its direction, but does not cross itself.
pathPoints :: Gen [Point]
pathPoints = do
  n <- frequency [(1, pure 2), (3, choose (3, 8)), (1, choose (12, 16))]
  begin <- elements [0, pi / 2, pi, 1]
  whole <- choose (-3, 3)
  bends <- vectorOf n (choose (-0.15, 0.15))
  steps <- vectorOf n (choose (12, 18))
  let headings =
        [begin + whole * fromIntegral k / fromIntegral n + b | (k, b) <- zip [0 :: Int ..] bends]
  pure
    ( map
        rounded'
        ( scanl
            (\p (a, s) -> Vec.shift (Vec.polar (Mm s) (Rad a)) p)
            (Vec.point 0 0)
            (zip headings steps)
        )
    )
  where
    rounded' p = Vec.point (digits (Vec.x p)) (digits (Vec.y p))
    digits x = fromIntegral (round (x * 1000) :: Int) / 1000

exactly :: EndCondition -> [Point] -> Curve
exactly ends = Curves.ok . Curve.spline ends . Vector.fromList

-- | The statement that defines a spline through points, with this name.
splineOf :: Text -> EndCondition -> [Point] -> Text
splineOf name ends points =
  "curve "
    <> name
    <> " = "
    <> (case ends of Periodic -> "closed_spline"; _ -> "spline")
    <> "(["
    <> Text.intercalate ", " (map point points)
    <> "])\n"

-- Pieces

-- | A cipher as the program writes it, with its numbers: 1, 2, 4 or 6.
data Cipher = Evenly Double Double | Steady Double | Leaning Double | Rowwise Double
  deriving stock (Show)

-- | A piece: the rows of its table (a point, a bevel in degrees, a thickness in mm), its ciphers
-- and its side. A closed one has a closed spline.
data PieceCase = PieceCase
  { table :: [(Point, Double, Double)],
    closed :: Bool,
    ciphers :: [Cipher],
    side' :: Side
  }
  deriving stock (Show)

pieceCase :: Gen PieceCase
pieceCase = do
  closed <- frequency [(3, pure False), (1, pure True)]
  points <- if closed then closedPoints else pathPoints
  bevels <- vectorOf (length points) (written (-8) 8)
  thick <- vectorOf (length points) (written 0.5 2)
  ciphers <- choose (0, 3) >>= \n -> vectorOf n cipher
  PieceCase (zip3 points bevels thick) closed ciphers <$> elements [LeftOf, RightOf]
  where
    cipher =
      oneof
        [ Evenly <$> written (-1) 2 <*> written 0 2,
          Steady <$> written (-2) 2,
          Leaning <$> written 2 12,
          Rowwise <$> written (-1) 1
        ]
    closedPoints = do
      Curves.Table _ ps <- Curves.closedRing `suchThat` (\(Curves.Table _ ps) -> length ps <= 14)
      pure
        [ Vec.point (digits (Vec.x p)) (digits (Vec.y p))
          | p <-
              if length ps > 1 && Vec.isNear (head' ps) (last ps)
                then drop 1 ps
                else ps
        ]
    digits x = fromIntegral (round (x * 1000) :: Int) / 1000

swapped :: PieceCase -> PieceCase
swapped c = c {side' = case side' c of LeftOf -> RightOf; RightOf -> LeftOf}

-- | A program with the curve @skin@ and the piece @edge@ of it.
pieceText :: PieceCase -> Text
pieceText c@PieceCase {table, closed} =
  Text.unlines
    ( ["part p", "table rows {", "  x y mu deg t mm"]
        <> ["  " <> Text.unwords (map number [Vec.x p, Vec.y p, a, t]) | (p, a, t) <- table]
        <> ["}", "curve skin = " <> (if closed then "closed_spline" else "spline") <> "(rows)"]
    )
    <> pieceNamed "edge" "skin" c

-- | The statement that defines a contour of one element, a curve or piece.
contourOf :: PieceCase -> Text -> Text
contourOf c what =
  "contour k " <> (if closed c then "closed" else "open") <> " { " <> what <> " }\n"

dropPart :: Text -> Text
dropPart = Text.drop (Text.length "part p\n")

-- | The statement that defines a piece with this name of a curve with this name.
pieceNamed :: Text -> Text -> PieceCase -> Text
pieceNamed name base PieceCase {ciphers, side'} =
  "piece "
    <> name
    <> " = "
    <> base
    <> (if null ciphers then "" else " cipher " <> Text.intercalate ", " (map cipher ciphers))
    <> " "
    <> word side'
    <> "\n"
  where
    cipher c = case c of
      Evenly a b -> "1(" <> number a <> ", " <> number b <> ")"
      Steady h -> "2(" <> number h <> ")"
      Leaning h -> "4(mu, " <> number h <> ")"
      Rowwise k -> "6(" <> number k <> " * t)"

-- | The piece computed with exact curves, without the language.
pieceOf :: PieceCase -> Curve
pieceOf PieceCase {table, closed, ciphers, side'} =
  foldl shifted (exactly (if closed then Periodic else Natural) [p | (p, _, _) <- table]) ciphers
  where
    shifted c cipher = Curve.shifted side' (distance c cipher) c
    distance c cipher = case cipher of
      Evenly a b -> Growing Growth {from = Mm a, to = Mm b, between = Nothing}
      Steady h -> Constant (Mm h)
      Leaning h ->
        Bevelled
          (Curve.column c (column (\(_, a, _) -> a * pi / 180)))
          (Curve.column c (column (const h)))
          (Mm 0)
      Rowwise k -> Pointwise (Curve.column c (column (\(_, _, t) -> k * t)))
    column f = Vector.fromList (map f table)

-- | A motion of the plane, true for a reflection, and the call of the language that transforms a
-- thing: its text before and after the thing.
motion :: Gen (Transformation, Bool, (Text, Text))
motion = do
  a <- written (-200) 200
  x <- written (-50) 50
  y <- written (-50) 50
  elements
    [ ( Transformation.translation (Vec.vec x y),
        False,
        ("moved(", ", (" <> number x <> ", " <> number y <> "))")
      ),
      ( Transformation.rotation (Rad (a * pi / 180)) (Vec.point x y),
        False,
        ("rotated(", ", " <> number a <> " deg, (" <> number x <> ", " <> number y <> "))")
      ),
      ( Transformation.reflection (Line (Vec.point x y) (Vec.point (x + 3) (y + 1))),
        True,
        ( "mirrored(",
          ", line(("
            <> number x
            <> ", "
            <> number y
            <> "), ("
            <> number (x + 3)
            <> ", "
            <> number (y + 1)
            <> ")))"
        )
      )
    ]

-- | Checks that the images of some segments follow others from the same start to the same end. The
-- segments of both are within 10⁻⁵ mm of their exact curves.
along :: Transformation -> [Double] -> [Segment] -> [Segment] -> Property
along s ts before after =
  conjoin
    [ minimum
        [d | g <- after, let Mm d = Distance.toPoint (Transformation.point s (Segment.at t b)) g]
        `atMost` 2.5e-5
      | b <- before,
        t <- ts
    ]
    .&&. coincide
      1e-6
      (Transformation.point s (Segment.start (head' before)))
      (Segment.start (head' after))
    .&&. coincide
      1e-6
      (Transformation.point s (Segment.end (last before)))
      (Segment.end (last after))

-- Programs

header :: Double -> Text
header r =
  "part p\ntool mill(diameter "
    <> number (2 * r)
    <> ")\nfeed 60\ntolerance 0.02\nfrom (-300, -300)\n"

point :: Point -> Text
point p = "(" <> number (Vec.x p) <> ", " <> number (Vec.y p) <> ")"

-- | A number with six decimals.
number :: Double -> Text
number x = Text.pack (if n < 0 then '-' : digits (-n) else digits n)
  where
    n = round (x * 1e6) :: Integer
    digits m =
      let (w, f) = m `divMod` 1000000
       in show w <> "." <> replicate (6 - length (show f)) '0' <> show f

-- | The elements of all contours of a program without mistakes.
elementsOf :: Text -> Maybe [Segment]
elementsOf text = case Compile.analyse [] (LoadedProgram.fromText "p.part" text) of
  r
    | null (Result.errors r) ->
      concatMap (map Part.segment . NonEmpty.toList . Part.elements) . Part.contours . part
        <$> Result.output r
  _ -> Nothing

-- | A property of the elements of a program's contours; fails when the program has mistakes.
soundly :: Maybe [Segment] -> ([Segment] -> Property) -> Property
soundly elements' holds = maybe (counterexample "the program has mistakes" False) holds elements'

-- | The cuts of a program's millings. Only an approach that gouges (E0405) is no failure.
cutsOf :: Text -> Maybe [Segment]
cutsOf text = case Compile.analyse [] (LoadedProgram.fromText "p.part" text) of
  r
    | all ((== ReportCode "E0405") . Report.code) (Result.errors r) ->
      concatMap cuts . Toolpath.blocks . path <$> Result.output r
  _ -> Nothing
  where
    cuts b = case b of
      Toolpath.Cutting {Toolpath.cut} -> map Toolpath.segment (NonEmpty.toList cut)
      _ -> []

-- | A property of the cuts of a program; fails when the program has mistakes.
milled :: Text -> ([Segment] -> Property) -> Property
milled text holds = maybe (counterexample (Text.unpack text) False) holds (cutsOf text)

-- | Do two segments meet at a corner?
isCorner :: Segment -> Segment -> Bool
isCorner a b = abs angle > 1e-3
  where
    Rad angle = Vec.signedAngle (Segment.endDirection a) (Segment.startDirection b)
