-- | Regions and shapes in programs.
module Part.RegionSpec (spec) where

import Base.Name (Name (..))
import Base.Quantity (Mm (..))
import Base.Region (Located (..))
import Base.Result qualified as Result
import Compile (Analysis (..))
import Compile qualified
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Machines qualified
import Part.Part
  ( Contour (contourName),
    Element (finish, ofCurve),
    Milling,
    Operation (..),
    Part (..),
  )
import Part.Part qualified as Part
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report (ReportCode (..))
import Report.Report qualified as Report
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = do
  describe "regions" regions
  describe "machining of regions" machining
  describe "shapes" shapes

regions :: Spec
regions = do
  it "have the areas of the drawing" $
    holding
      [ "area_of(difference(rectangle((0, 0), 40, 30), circle((20, 15), 5)))\
        \ = 1200 * sq - 25 * pi * sq within small",
        "area_of(union(rectangle((0, 0), 10, 10), rectangle((10, 0), 10, 10))) = 200 * sq\
        \ within small",
        "area_of(intersection(region(circle((0, 0), 5)), rectangle((0, 0), 9, 9)))\
        \ = 25 * pi / 4 * sq within small",
        "area_of(offset_of(rectangle((0, 0), 10, 10), 2)) = 100 * sq + 80 * sq + 4 * pi * sq\
        \ within small",
        "area_of(offset_of(rectangle((0, 0), 10, 10), -2)) = 36 * sq within small",
        "length_of(difference(circle((0, 0), 10), circle((0, 0), 5))) = 30 mm * pi within 0.000001"
      ]
  it "have their centres of gravity" $
    holding
      [ "x_of(centroid_of(union(rectangle((0, 0), 10, 10), rectangle((10, 0), 30, 10)))) = 20\
        \ within 0.000001",
        -- The centre of a half circle is 4 r / 3 pi from its straight side.
        "y_of(centroid_of(intersection(region(circle((7, 3), 6)), rectangle((0, 3), 20, 20))))\
        \ = 3 + 4 * 6 / (3 * pi) within 0.000001",
        "distance(centroid_of(difference(circle((0, 0), 10), circle((0, 0), 5))), (0, 0)) = 0\
        \ within 0.000001"
      ]
  it "join what touches along an edge to one line" $
    map
      length
      ( contourSegments
          (partOf "let r = union(rectangle((0, 0), 10, 10), rectangle((10, 0), 10, 10))\n")
      )
      `shouldBe` [4]
  it "keep the allowance of an element, and not its neighbour's" $
    [ allowance
      | c <-
          contours
            ( partOf
                "contour a closed { line((0, 0), (40, 0)) allowance 2 line((40, 0), (40, 30)) \
                \line((40, 30), (0, 0)) }\n\
                \let r = difference(a, rectangle((10, -5), 5, 10))\n"
            ),
        Located _ (Name "r") <- [contourName c],
        e <- NonEmpty.toList (Part.elements c),
        let Mm allowance = Part.allowance (finish e),
        allowance > 0
    ]
      `shouldBe` [2, 2]
  it "are transformed, and stay on the left of their contours when they are mirrored" $
    holding
      [ "area_of(mirrored(difference(rectangle((0, 0), 10, 10), circle((5, 5), 2)), vertical(20)))\
        \ = 100 * sq - 4 * pi * sq within small",
        "area_of(scaled(region(rectangle((0, 0), 10, 10)), 2)) = 400 * sq within small"
      ]
  it "draw what other regions are not made of" $
    [ name
      | c <-
          contours
            ( partOf
                "let a = region(rectangle((0, 0), 9, 9))\n\
                \let b = difference(a, circle((4, 4), 2))\n"
            ),
        Located _ (Name name) <- [contourName c]
    ]
      `shouldBe` ["b", "b"]
  it "leave their names to programs that define them (catches an old contour called slot)" $
    codesOf
      "contour slot closed { rectangle((0, 0), 40, 10) }\nlet union = 5 mm\n\
      \let gear(x) = x + union\nlet y = gear(2)\n"
      `shouldBe` []
  it "give their contours the name of the let, but not the program's own (catches a renamed slot)" $
    [ name
      | c <-
          contours
            ( partOf
                "contour slot closed { rectangle((0, 0), 40, 10) }\nlet again = region(slot)\n\
                \let pad = region(rounded((50, 0), 9, 9, 2))\n"
            ),
        Located _ (Name name) <- [contourName c]
    ]
      `shouldBe` ["slot", "slot", "pad"]
  it "are refused for what has no inside" $
    map
      codesOf
      [ "contour e open { (0, 0) (5, 0) }\nlet r = region(e)\n",
        "contour e open { (0, 0) (5, 0) }\nlet r = offset_of(e, -1)\n",
        "let r = region(polygon([(0, 0), (4, 4), (4, 0), (0, 4)]))\n",
        "let r = centroid_of(offset_of(rectangle((0, 0), 4, 4), -3))\n"
      ]
      `shouldBe` [["E0366"], ["E0366"], ["E0367"], ["E0369"]]

machining :: Spec
machining = do
  it "mills the holes from within first, and then the outline" $
    [ (sideOf m, area m)
      | Mill (Located _ m) <- operationsOf (plate <> "mill plate outside { depth 2 }\n")
    ]
      `shouldBe` [("inside", 78.54), ("outside", 1121.46 + 78.54)]
  it "clears each part of a region around its holes" $
    [ (length (Part.islands p), areaIn (Part.contour (Part.wall p)))
      | Pocket (Located _ p) <-
          operationsOf
            ( plate
                <> "pocket union(plate, rectangle((60, 0), 20, 20)) step 1 {\
                   \ depth 2 plunge 50 rest allowed }\n"
            )
    ]
      `shouldBe` [(1, 1200), (0, 400)]
  it
    "of random regions is proven, or refused before there is a tape (catches a hole on the side of \
    \the part)"
    $ withMaxSuccess 60 . forAll expression $ \e ->
      forAll (Test.QuickCheck.elements ["iso6983", "linuxcnc-mill", "lki-un"]) $ \machine ->
        conjoin
          [ let outcome =
                  Compile.compile
                    (Machines.jobFor (Machines.named machine) [])
                    (LoadedProgram.fromText "p.part" (header <> statement))
                codes = [code | r <- Result.errors outcome, ReportCode code <- [Report.code r]]
                shown = Text.unpack statement <> show codes
             in cover 20 (null codes) "tapes" . counterexample shown $
                  not (any ("E07" `Text.isPrefixOf`) codes)
            | statement <-
                [ "mill " <> e <> " outside { depth 2 plunge 40 rest allowed }\n",
                  "mill " <> e <> " inside { depth 2 plunge 40 rest allowed }\n",
                  "pocket " <> e <> " step 1.2 { depth 1 plunge 40 climb rest allowed }\n"
                ]
          ]
  it "is refused for an empty region" $
    map
      (codesOf . (plate <>))
      [ "mill difference(plate, rectangle((-1, -1), 99, 99)) outside { depth 2 }\n",
        "pocket offset_of(plate, -30) step 1 { depth 2 }\n"
      ]
      `shouldBe` [["E0369"], ["E0369"]]
  where
    plate = "let plate = difference(rectangle((0, 0), 40, 30), circle((20, 15), 5))\n"
    area = areaIn . Part.contour
    sideOf :: Milling -> Text
    sideOf m = Text.toLower (Text.pack (show (value (Part.side m))))
    areaIn :: Contour -> Double
    areaIn c = fromIntegral (round (100 * abs (Polyarc.signedArea (Part.polyarcOf c))) :: Int) / 100
    operationsOf = operations . partOf

shapes :: Spec
shapes = do
  it "take links at every corner, whatever their turn" $
    holding
      [ "area_of(round_square) = 400 * sq - (16 - 4 * pi) * sq within small",
        "area_of(cut_square) = 400 * sq - 8 * sq within small"
      ]
  it "follow the formula of the involute to 0.000001 mm" $
    property $
      forAll gears $ \(m, z, angle) ->
        let text = "contour g closed { gear(" <> sizes <> ") }\n"
            sizes = Text.intercalate ", " (map number [m, z, angle])
            base = m * z / 2 * cos (angle * pi / 180)
            half = pi / (2 * z) + tan (angle * pi / 180) - angle * pi / 180
            flankOff s =
              [ abs (base * (abs (turned - toothAt) - (half - (roll - atan roll))))
                | t <- [0, 0.1 .. 1],
                  let p = Segment.at t s
                      (x, y) = (Vec.x p, Vec.y p)
                      r = sqrt (x * x + y * y)
                      turned = atan2 y x
                      toothAt = 2 * pi / z * fromIntegral (round (turned * z / (2 * pi)) :: Int)
                      roll = sqrt (max 0 (r * r / (base * base) - 1))
              ]
            curves =
              [ Part.segment e
                | c <- contours (partOf text),
                  e <- NonEmpty.toList (Part.elements c),
                  ofCurve e
              ]
         in not (null curves)
              .&&. counterexample (show (m, z, angle)) (all (< 1e-6) (concatMap flankOff curves))
  it "follow the ellipse to 0.000001 mm" $
    property $
      forAll ((,) <$> choose (1, 60) <*> choose (1, 60)) $ \(a, b) ->
        let text = "contour o closed { ellipse((0, 0), " <> number a <> ", " <> number b <> ") }\n"
            a' = read (Text.unpack (number a)) :: Double
            b' = read (Text.unpack (number b)) :: Double
            off s =
              [ abs f / sqrt (gx * gx + gy * gy)
                | t <- [0, 0.1 .. 1],
                  let p = Segment.at t s
                      (x, y) = (Vec.x p, Vec.y p)
                      f = x * x / (a' * a') + y * y / (b' * b') - 1
                      (gx, gy) = (2 * x / (a' * a'), 2 * y / (b' * b'))
              ]
         in counterexample
              (show (a, b))
              (all (< 1.01e-6) (concatMap off (concat (contourSegments (partOf text)))))
  it "are refused if their sizes contradict each other" $
    map
      (\e -> codesOf ("let s = " <> e <> "\n"))
      [ "rectangle((0, 0), (5, 0))",
        "rounded((0, 0), 9, 5, 3)",
        "slot((1, 1), (1, 1), 3)",
        "polygon([(0, 0), (1, 0)])",
        "polygon(circle((0, 0), 5), 2)",
        "ellipse((0, 0), 5, 0)",
        "gear(2, 4, 40)",
        "gear(2, 20, 70)"
      ]
      `shouldBe` (["E0370"] <$ [1 .. 4 :: Int]) <> [["E0338"], ["E0306"], ["E0370"], ["E0370"]]
  where
    gears = do
      z <- choose (8, 80 :: Int)
      m <- elements [0.5, 1, 2.5, 6]
      angle <- elements [14.5, 20, 25]
      pure (m, fromIntegral z, angle)

-- | A random region as the program writes it. Its coordinates are halves of mm, so that many of its
-- elements touch or coincide.
expression :: Gen Text
expression = sized (go . min 3 . (`div` 20) . (+ 20))
  where
    go :: Int -> Gen Text
    go n
      | n <= 0 = outline
      | otherwise =
        oneof
          [ do
              word <- Test.QuickCheck.elements ["union", "difference", "intersection"]
              call word <$> sequence [("region(" <>) . (<> ")") <$> go (n - 1), go (n - 1)],
            do
              e <- go (n - 1)
              d <- Test.QuickCheck.elements ["1", "-1", "2.5"]
              pure (call "offset_of" [e, d]),
            do
              e <- go (n - 1)
              a <- Test.QuickCheck.elements ["90", "30", "45"]
              pure (call "rotated" [call "region" [e], a])
          ]
    outline =
      oneof
        [ call "rectangle" <$> sequence [place, size, size],
          call "rounded" <$> sequence [place, size, size, pure "1.5"],
          call "slot" <$> sequence [place, place, pure "4"],
          call "circle" <$> sequence [place, size],
          (\p r n -> call "polygon" [call "circle" [p, r], n])
            <$> place <*> size <*> Test.QuickCheck.elements ["3", "4", "6"],
          (\p a b -> call "ellipse" [p, a, b]) <$> place <*> size <*> size
        ]
    place = (\x y -> "(" <> x <> ", " <> y <> ")") <$> half (-20) 20 <*> half (-20) 20
    size = half 7 40
    half :: Int -> Int -> Gen Text
    half low high = number . (/ 2) . fromIntegral <$> choose (low, high)
    call word arguments = word <> "(" <> Text.intercalate ", " arguments <> ")"

-- | Holds if assertions hold in a program with two squares.
holding :: [Text] -> Expectation
holding assertions =
  codesOf
    ( "contour round_square closed { rectangle((0, 0), 20, 20) fillet 2 }\n\
      \contour cut_square closed { rectangle((0, 0), 20, 20) chamfer 2 }\n"
        <> Text.unlines (map ("assert " <>) assertions)
    )
    `shouldBe` []

header :: Text
header =
  "part p\ntool mill(diameter 2)\nfeed 60\ntolerance 0.02\nclearance 5\nfrom (-30, -30, 20)\n\
  \let sq = 1 mm * 1 mm\nlet small = 0.000001 * sq\n"

codesOf :: Text -> [Text]
codesOf text =
  [ code
    | r <- Result.errors (Compile.analyse [] (LoadedProgram.fromText "p.part" (header <> text))),
      ReportCode code <- [Report.code r]
  ]

partOf :: Text -> Part
partOf text = case Compile.analyse [] (LoadedProgram.fromText "p.part" (header <> text)) of
  r | Just a <- Result.output r -> part a
  r -> error (show (map Report.title (Result.errors r)))

contourSegments :: Part -> [[Segment]]
contourSegments p = [map Part.segment (NonEmpty.toList (Part.elements c)) | c <- contours p]

number :: Double -> Text
number x = Text.pack (show (fromIntegral (round (x * 1000) :: Int) / 1000 :: Double))
