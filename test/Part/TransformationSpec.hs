-- | Laws of transformations: the toolpath of the transformed part is the transformed toolpath.
module Part.TransformationSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Base.Region (Located (..), Region (..))
import Base.Result qualified as Result
import Compile qualified
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Generate (Case)
import Generate qualified
import Geometry.Carrier (Line (..))
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Transformation (Transformation)
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.ContourElement qualified as ContourElement
import Part.Part (Milling, Operation (..))
import Part.Part qualified as Part
import Part.Transformation qualified as Transformation
import Project.LoadedProgram qualified as LoadedProgram
import Test.Hspec hiding (after, before)
import Test.QuickCheck hiding (total)
import Toolpath.FromPart qualified as FromPart
import Toolpath.Toolpath qualified as Toolpath

spec :: Spec
spec = do
  describe "similarities" $ do
    it
      "compose to one similarity (catches angles that are added although one similarity is a \
      \reflection)"
      $ property $
        forAll ((,,) <$> similarity <*> similarity <*> somePoint) $ \(a, b, p) ->
          Transformation.point b (Transformation.point a p)
            `shouldBeNear` Transformation.point (Transformation.after b a) p
    it "move the points of an arc with it (catches an arc that keeps its sense in a reflection)" $
      property $
        forAll ((,) <$> similarity <*> Generate.closedCase) $ \(s, c) ->
          conjoin
            [ Segment.at t (Transformation.segment s g)
                `shouldBeNear` Transformation.point s (Segment.at t g)
              | g <- segmentsOf c,
                t <- [0.2, 0.5, 0.9]
            ]
  describe "the toolpath" $ do
    it
      "of a transformed milling is the transformed toolpath (catches a side that a reflection does \
      \not swap, and a lead on the wrong side)"
      $ property $
        forAll ((,) <$> motion <*> (Generate.settings <*> (millingOf <$> Generate.closedCase))) $
          \(s, job) ->
            case ( movesOf job,
                   movesOfOperation
                     (Transformation.point s (beginning job))
                     (Transformation.operation s (Mill (here job)))
                 ) of
              (Just before, Just after) ->
                conjoin (zipWith (sameMove s) before after) .&&. length before === length after
              (Nothing, Nothing) -> property True
              (a, b) -> counterexample (show (fmap length a, fmap length b)) False
    it "with an allowance is that of a larger cutter (catches an allowance that is subtracted)" $
      property $
        forAll ((,) <$> Generate.closedCase <*> choose (0.01, 0.4)) $ \(c, d) ->
          let job = millingOf c
              Mm r = Part.radius job
           in fmap (map Toolpath.segment) (movesOf job {Part.allowances = Mm d :| []})
                === fmap (map Toolpath.segment) (movesOf job {Part.radius = Mm (r + d)})
    it
      "climbs with the material on the right, whatever the direction of the contour (catches climb \
      \and conventional milling exchanged)"
      $ property $
        forAll Generate.closedCase $ \c ->
          let job =
                (millingOf c)
                  { Part.sense = Just (here Part.Climb),
                    Part.side = here (if isOutside c then Part.Outside else Part.Inside)
                  }
           in case movesOf job of
                Nothing -> property Discard
                Just moves ->
                  let g =
                        Toolpath.segment (longest moves)
                   in counterexample (show g) (materialRight c g)
  describe "a contour" $ do
    it
      "that begins elsewhere is the same contour (catches a segment that is lost or occurs twice)"
      $ property $
        forAll ((,) <$> Generate.closedCase <*> somePoint) $ \(c, p) ->
          let before = Part.contour (millingOf c)
              after = ContourElement.startingNear p before
              total k =
                sum
                  [ l
                    | e <- NonEmpty.toList (Part.elements k),
                      let Mm l = Segment.length (Part.segment e)
                  ]
              begin = Segment.start (Part.segment (NonEmpty.head (Part.elements after)))
              joined =
                and
                  [ Vec.isNear (Segment.end (Part.segment a)) (Segment.start (Part.segment b))
                    | (a, b) <- zip es (drop 1 es <> take 1 es)
                  ]
              es = NonEmpty.toList (Part.elements after)
              Mm reached = Vec.distance p begin
              nearest =
                minimum
                  [ d
                    | g <- segmentsOf c,
                      k <- [0 .. 200 :: Int],
                      let Mm d = Vec.distance p (Segment.at (fromIntegral k / 200) g)
                  ]
           in counterexample
                (show (begin, reached, nearest))
                (abs (total before - total after) < 1e-6 && joined && reached <= nearest + 1e-6)
    it
      "built on transformed points is the transformed contour (catches a construction that depends \
      \on the axes)"
      $ property $
        forAll ((,) <$> angles <*> corners) $ \((a, x, y), ps) ->
          let plain = contourOf id ps
              turned =
                contourOf
                  ( \p ->
                      "rotated(moved("
                        <> p
                        <> ", ("
                        <> number x
                        <> ", "
                        <> number y
                        <> ")), "
                        <> number a
                        <> " deg)"
                  )
                  ps
              s =
                Transformation.after
                  (Transformation.rotation (Rad (a * pi / 180)) (Vec.point 0 0))
                  (Transformation.translation (Vec.vec x y))
           in counterexample (Text.unpack (program turned)) $
                case ( elementsOf (program plain),
                       elementsOf (program turned),
                       elementsOf (program plain <> moved a x y)
                     ) of
                  (Just before, Just after, Just after') ->
                    conjoin (zipWith (sameSegment s) before after)
                      .&&. length before === length after
                      .&&. conjoin (zipWith (sameSegment s) before (drop (length before) after'))
                  (b, t, _) -> fmap length b === fmap length t
  where
    moved a x y =
      "contour d open { rotated(moved(k, ("
        <> number x
        <> ", "
        <> number y
        <> ")), "
        <> number a
        <> " deg) }\n"

here :: a -> Located a
here = Located (Region 0 0)

-- | Two points less than 10⁻⁶ mm apart.
shouldBeNear :: Point -> Point -> Property
shouldBeNear a b = let Mm d = Vec.distance a b in counterexample (show (a, b)) (d < 1e-6)

-- Transformations

somePoint :: Gen Point
somePoint = Vec.point <$> choose (-200, 200) <*> choose (-200, 200)

-- | A translation, a rotation, a reflection, or a composition of these.
motion :: Gen Transformation
motion =
  oneof
    [ Transformation.translation <$> (Vec.vec <$> choose (-200, 200) <*> choose (-200, 200)),
      Transformation.rotation <$> (Rad <$> choose (-7, 7)) <*> somePoint,
      Transformation.reflection <$> (Line <$> somePoint <*> somePoint),
      Transformation.after <$> motion <*> motion
    ]

-- | A motion, a scaling, or a composition of both.
similarity :: Gen Transformation
similarity =
  oneof
    [ motion,
      Transformation.scaling <$> choose (0.2, 4) <*> somePoint,
      Transformation.after <$> motion <*> (Transformation.scaling <$> choose (0.2, 4) <*> somePoint)
    ]

-- Millings

segmentsOf :: Case -> [Segment]
segmentsOf c = map Part.segment (NonEmpty.toList (Part.elements (Part.contour (millingOf c))))

millingOf :: Case -> Milling
millingOf = Generate.job

-- | The moves of a milling, whose cutter begins at the start of the contour.
movesOf :: Milling -> Maybe [Toolpath.Move]
movesOf job = movesOfOperation (beginning job) (Mill (here job))

-- | The start of the contour that is milled.
beginning :: Milling -> Point
beginning job = Segment.start (Part.segment (NonEmpty.head (Part.elements (Part.contour job))))

-- | The cuts and retracts of an operation, with their leads. The cutter begins at the point.
-- Errors, such as an approach that gouges, are ignored.
movesOfOperation :: Point -> Operation -> Maybe [Toolpath.Move]
movesOfOperation at operation =
  fmap
    (concatMap cuts . Toolpath.blocks)
    (Result.output (FromPart.toToolpath (Generate.partOf at operation)))
  where
    cuts b = case b of
      Toolpath.Cutting {Toolpath.cut, Toolpath.retract} -> NonEmpty.toList cut <> retract
      _ -> []

-- | The second move is the image of the first one.
sameMove :: Transformation -> Toolpath.Move -> Toolpath.Move -> Property
sameMove s a b = sameSegment s (Toolpath.segment a) (Toolpath.segment b)

-- | The second segment is the image of the first one, at four of its points.
sameSegment :: Transformation -> Segment -> Segment -> Property
sameSegment s a b =
  conjoin
    [Segment.at t b `shouldBeNear` Transformation.point s (Segment.at t a) | t <- [0, 0.3, 0.7, 1]]

-- | Is the cutter outside of the contour?
isOutside :: Case -> Bool
isOutside = Generate.outside

longest :: [Toolpath.Move] -> Toolpath.Move
longest moves = snd (maximum' [(l, m) | m <- moves, let Mm l = Segment.length (Toolpath.segment m)])
  where
    maximum' = foldr1 (\a b -> if fst a >= fst b then a else b)

-- | Does the contour lie to the right of the middle of a cut?
materialRight :: Case -> Segment -> Bool
materialRight c g = Vec.cross (Segment.directionAt 0.5 g) (Vec.to middle foot) < 0
  where
    middle = Segment.at 0.5 g
    foot =
      snd
        ( minimum'
            [ (d, q)
              | h <- segmentsOf c,
                k <- [0 .. 400 :: Int],
                let q = Segment.at (fromIntegral k / 400) h,
                let Mm d = Vec.distance middle q
            ]
        )
    minimum' = foldr1 (\a b -> if fst a <= fst b then a else b)

-- Programs

-- | An angle in degrees, and the two components of a vector in mm.
angles :: Gen (Double, Double, Double)
angles = (,,) <$> written 400 <*> written 300 <*> written 300
  where
    -- At most three decimals, so that a program can contain the number exactly.
    written n = (/ 1000) . fromIntegral <$> choose (-1000 * n, 1000 * n :: Int)

-- | Corners of a counter-clockwise polygon, and a link or modifier for each.
corners :: Gen [(Double, Double, Text)]
corners = do
  n <- choose (3, 7 :: Int)
  mapM (corner n) [0 .. n - 1]
  where
    corner n k = do
      r <- choose (60, 70)
      j <- choose (0, 0.3)
      link <-
        elements ["", " fillet -4", " fillet -9.5", " chamfer 3", " feed 30 fillet -2", " slow"]
      let a = 2 * pi * (fromIntegral k + j) / fromIntegral n
      pure (r * cos a, r * sin a, link)

-- | An open contour along the edges of the polygon. The function writes its points.
contourOf :: (Text -> Text) -> [(Double, Double, Text)] -> Text
contourOf write ps =
  Text.unlines
    ( ["contour k open {"]
        <> [ "  line(" <> at p <> ", " <> at q <> ")" <> (if k + 1 < length edges then link else "")
             | (k, (p, q@(_, _, link))) <- zip [0 ..] edges
           ]
        <> ["}"]
    )
  where
    edges = zip ps (drop 1 ps)
    at (x, y, _) = write ("(" <> number x <> ", " <> number y <> ")")

number :: Double -> Text
number x = Text.pack (if x < 0 then '-' : digits (-x) else digits x)
  where
    digits d =
      let n =
            round (d * 1e6) :: Integer
          (w, f) = n `divMod` 1000000
       in show w <> "." <> replicate (6 - length (show f)) '0' <> show f

program :: Text -> Text
program text = "part p\n" <> text

-- | The elements of all contours of a program.
elementsOf :: Text -> Maybe [Segment]
elementsOf text = case Compile.analyse [] (LoadedProgram.fromText "p.part" text) of
  r
    | null (Result.errors r) ->
      concatMap (map Part.segment . NonEmpty.toList . Part.elements) . Part.contours . Compile.part
        <$> Result.output r
  _ -> Nothing
