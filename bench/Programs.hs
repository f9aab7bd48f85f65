-- | Part programs of any size, for the benchmark of the whole compiler.
module Programs
  ( Kind (..),
    name,
    most,
    Written (..),
    written,
  )
where

import Base.Decimal qualified as Decimal
import Data.List (nub)
import Data.Text (Text)
import Data.Text qualified as Text
import Noise qualified

-- | The kinds of part programs.
data Kind
  = -- | a contour of points
    Corners
  | -- | a contour of circles linked by tangents
    Lobes
  | -- | statements of many kinds: points, circles, tangent lines, functions and their calls,
    -- assertions, contours, holes
    Statements
  | -- | a closed spline through the rows of a table, 3 mm apart, so smooth that one arc follows
    -- many rows
    Rows
  | -- | as 'Rows', with noise of 0.1 mm: the curve bends at every row
    Wavy
  | -- | closed arcs through the rows of a file of comma-separated values, 19 mm apart, with noise
    -- of 2 mm: each arc needs a frame of its own
    ArcsFile
  | -- | a polyline through the rows of a file, 3 mm apart, with noise of 0.5 mm, milled @on@: each
    -- line needs a frame of its own
    LinesFile
  | -- | as 'LinesFile', milled @outside@: the cutter does not reach the inner corners, which are
    -- half of all corners, and rounds the outer ones on an arc
    CornersFile
  | -- | a hole at each row of a file, 3 mm apart
    HolesFile
  | -- | a round pocket, cleared by as many loops
    RoundPocket
  | -- | a pocket with as many slots along one side
    Comb
  | -- | a square pocket with as many round islands
    Islands
  | -- | the same, cleared by a larger cutter and then, where that left something, by a smaller one
    Rests
  | -- | as many @mill@ statements of one spline contour
    OneContour
  | -- | as many spline contours, each around the one before, with a @mill@ statement for each
    Nested
  | -- | as many islands, each milled outside in four depths, and two holes in each, over stock,
    -- with two clamps, and tools whose flutes are shorter than the depth and that have holders
    Plate
  | -- | the same without stock, clamps, flutes and holders
    PlainPlate
  | -- | the union of as many circles, of which each meets its neighbours in a grid
    Circles
  | -- | as many engraved letters, in lines of 50
    Engraved
  | -- | as many V-carved letters of the font @letters.ttf@, in lines of 50
    Carved
  deriving stock (Eq, Show, Read, Enum, Bounded)

-- | The name of a kind in the tables.
name :: Kind -> Text
name kind = case kind of
  Corners -> "corners"
  Lobes -> "lobes"
  Statements -> "statements"
  Rows -> "smooth rows"
  Wavy -> "noisy rows"
  ArcsFile -> "arcs, csv"
  LinesFile -> "lines, csv"
  CornersFile -> "corners, csv"
  HolesFile -> "holes, csv"
  RoundPocket -> "round pocket"
  Comb -> "comb"
  Islands -> "islands"
  Rests -> "islands, two cutters"
  OneContour -> "one contour"
  Nested -> "nested contours"
  Plate -> "plate with stock"
  PlainPlate -> "plate"
  Circles -> "union of circles"
  Engraved -> "engraved letters"
  Carved -> "V-carved letters"

-- | The largest number of elements. With ten times as many, the program would need more than a
-- million frames or ten thousand passes, or coordinates beyond the largest one, or pockets that
-- take minutes; programs written by hand are smaller. The last seven kinds have tables of their
-- own.
most :: Kind -> Int
most kind
  | kind `elem` [Rows, Wavy, LinesFile] = 1000000
  | kind `elem` [RoundPocket, Comb, Islands, Rests] = 10000
  | kind `elem` [OneContour, Nested, Plate, PlainPlate, Circles, Engraved, Carved] = 64
  | otherwise = 100000

-- | The text of a program, and the files that it reads, by their names.
data Written = Written {text :: Text, files :: [(FilePath, Text)]}

-- | A program of @n@ elements, statements or rows.
written :: Kind -> Int -> Written
written kind n = case kind of
  Corners -> Written (ring 5 n (\x y -> "(" <> x <> ", " <> y <> ")")) []
  Lobes -> Written (ring 6 n (\x y -> "ccw circle((" <> x <> ", " <> y <> "), 4) tangent")) []
  Statements -> Written (statements n) []
  Rows -> inline 0
  Wavy -> inline 0.1
  ArcsFile ->
    Written
      (curved "closed_arcs" "outside" "" (6 * fromIntegral n) "table t from \"rows.csv\"\n")
      [("rows.csv", Text.unlines ("x,y" : rows "," n 6 2))]
  LinesFile -> cornered "on" ""
  CornersFile -> cornered "outside" " rest allowed"
  HolesFile ->
    Written
      ( header "holes" 2 (0.7 * fromIntegral n + 40)
          <> "clearance 5 mm\ntable t from \"rows.csv\"\ndrill at points_of(t) depth 3 mm\n"
      )
      [("rows.csv", Text.unlines ("x,y" : rows "," n 1 0.5))]
  RoundPocket -> Written (roundPocket n) []
  Comb -> Written (comb n) []
  Islands -> Written (islands n "") []
  Rests -> Written (islands n rest) []
  OneContour -> Written (mills (replicate n 0)) []
  Nested -> Written (mills [0 .. n - 1]) []
  Plate -> Written (plate True n) []
  PlainPlate -> Written (plate False n) []
  Circles -> Written (circles n) []
  Engraved ->
    Written (plateOf n (\_ line at -> "engrave " <> line <> at <> " { depth 0.3 plunge 200 }")) []
  Carved ->
    Written
      ( plateOf n $ \k line at ->
          let region = "line" <> Decimal.whole k
           in "contours " <> region <> " from \"letters.ttf\" text " <> line <> at
                <> "\nvcarve "
                <> region
                <> " { depth 2 plunge 200 }"
      )
      []
  where
    cornered side more =
      Written
        (curved "polyline" side more (fromIntegral n) "table t from \"rows.csv\"\n")
        [("rows.csv", Text.unlines ("x,y" : take (n + 1) (cycle (rows "," n 1 0.5))))]
    inline noise =
      Written
        ( curved
            "closed_spline"
            "outside"
            ""
            (fromIntegral n)
            (Text.unlines (["table t {", "x y"] <> rows " " n 1 noise <> ["}"]))
        )
        []

-- | A program whose elements lie on a circle. @half@ is half of the distance between neighbours in
-- mm; the function writes an element from its x and y.
ring :: Double -> Int -> (Text -> Text -> Text) -> Text
ring half n element =
  header "ring" 10 (r + 20)
    <> "contour c closed {\n"
    <> Text.unlines
      [ "  " <> element (coordinate (r * cos a)) (coordinate (r * sin a))
        | k <- [0 .. n - 1],
          let a = 2 * pi * fromIntegral k / fromIntegral n
      ]
    <> "}\nmill c outside { }\n"
  where
    r = half / sin (pi / fromIntegral n)

-- | A closed curve through a table: the function that makes it, the side, further settings, the
-- radius in mm, the statement of the table.
curved :: Text -> Text -> Text -> Double -> Text -> Text
curved through side more r table =
  header "wave" 6 (0.7 * r + 40)
    <> table
    <> ( "curve skin = "
           <> through
           <> "(t)\ncontour c closed { skin }\nmill c "
           <> side
           <> " { start near ("
       )
    <> coordinate r
    <> (", 0)" <> more <> " }\n")

-- | @n@ rows of x and y on a circle with five waves, @3·scale@ mm apart, with noise in mm.
rows :: Text -> Int -> Double -> Double -> [Text]
rows separator n scale noise = map row [0 .. n - 1]
  where
    count = fromIntegral n :: Double
    row k =
      let a = 2 * pi * fromIntegral k / count
          d =
            0.5 * scale * count * (1 + 0.1 * sin (5 * a))
              + noise * (2 * Noise.uniform 7 (fromIntegral k) - 1)
       in coordinate (d * cos a) <> separator <> coordinate (d * sin a)

-- | A round pocket that @n@ loops clear.
roundPocket :: Int -> Text
roundPocket n =
  header "round" 1 (r + 20)
    <> ("clearance 5 mm\ncontour c closed { ccw circle((0, 0), " <> coordinate r <> ") }\n")
    <> "pocket c step 0.8 { depth 1 mm }\n"
  where
    r = 0.8 * fromIntegral n + 0.5

-- | A pocket with @n@ slots, 2 mm wide and 5 mm deep, along one side.
comb :: Int -> Text
comb n =
  header "comb" 1 20
    <> "clearance 5 mm\ncontour c closed {\n"
    <> Text.unlines
      ( map point ([(4 * n, 0), (0, 0), (0, -10)] <> concatMap slot [0 .. n - 1] <> [(4 * n, -10)])
      )
    <> "}\npocket c step 0.8 { depth 1 mm  rest allowed }\n"
  where
    slot k = [(4 * k + 1, -10), (4 * k + 1, -15), (4 * k + 3, -15), (4 * k + 3, -10)]

-- | A square pocket with @n@ round islands, and further statements.
islands :: Int -> Text -> Text
islands n more =
  header "islands" 1 20
    <> "clearance 5 mm\ncontour c closed {\n"
    <> Text.unlines (map point [(0, 0), (3 * side, 0), (3 * side, 3 * side), (0, 3 * side)])
    <> "}\n"
    <> Text.unlines [island k (k `div` side) (k `mod` side) | k <- [0 .. n - 1]]
    <> (if Text.null more then "" else "change 1 mill(diameter 2.2 mm)\n")
    <> "pocket c step 0.8"
    <> (if Text.null more then "" else " as rough")
    <> " { depth 1 mm  rest allowed  islands "
    <> Text.intercalate ", " ["i" <> Decimal.whole k | k <- [0 .. n - 1]]
    <> " }\n"
    <> more
  where
    side = ceiling (sqrt (fromIntegral n :: Double)) :: Int
    island k row column =
      Text.concat
        [ "contour i" <> Decimal.whole k <> " closed { ccw circle((",
          coordinate (3 * fromIntegral column + 1.5) <> ", ",
          coordinate (3 * fromIntegral row + 1.5) <> "), 0.5) }"
        ]

-- | The clearing of what is left in the pocket of 'islands' by a smaller cutter.
rest :: Text
rest = "change 2 mill(diameter 0.8 mm)\nrest of rough step 0.3 { rest allowed }\n"

-- | A @mill@ statement for each number k of the list: of the spline contour through 100 rows at
-- about @100 + 10·k@ mm from the origin.
mills :: [Int] -> Text
mills numbers =
  header "mills" 6 (fromIntegral (10 * maximum numbers + 140))
    <> "clearance 5 mm\n"
    <> Text.unlines (concatMap contour (nub numbers) <> map mill numbers)
  where
    contour k =
      ["table t" <> Decimal.whole k <> " {", "x y"]
        <> rows " " 100 (2 + 0.2 * fromIntegral k) 0
        <> [ "}",
             Text.replace
               "#"
               (Decimal.whole k)
               "curve s# = closed_spline(t#)\ncontour c# closed { s# }"
           ]
    mill k =
      Text.concat
        [ "mill c" <> Decimal.whole k <> " outside { depth 1 mm  start near (",
          Decimal.whole (10 * k + 100) <> ", 0) }"
        ]

-- | A plate with @n@ islands and two holes in each, with or without stock, clamps and bodies of the
-- tools.
plate :: Bool -> Int -> Text
plate hasStock n =
  Text.unlines $
    [ "part plate",
      "machine iso6983",
      "tool 1 mill(diameter 6" <> only ", flutes 6, stickout 30, holder 40" <> ")",
      "feed 600",
      "tolerance 0.01",
      "clearance 5",
      "from (-40, -40, 50)"
    ]
      <> [ line
           | hasStock,
             line <-
               [ "stock rectangle((-20, -20), (770, " <> whole (high + 20) <> ")) from -12 to 0",
                 "avoid rectangle((-60, 0), (-12, 40)) from -12 to 12",
                 "avoid rectangle((762, 0), (810, 40)) from -12 to 12"
               ]
         ]
      <> ["spindle cw 8000 rpm"]
      <> [ "mill rounded(" <> at (x - 9) (y - 9) <> ", " <> at (x + 9) (y + 9)
             <> ", 4) outside { depth 11 step 2.75 }"
           | (x, y) <- places
         ]
      <> [ "change 2 drill(diameter 4" <> only ", flutes 40" <> ")",
           "spindle cw 3000 rpm",
           "drill at [" <> Text.intercalate ", " holes <> "] depth 10 { peck 4 }",
           "rapid (0, 0, 50)"
         ]
  where
    only words' = if hasStock then words' else ""
    whole = Decimal.whole
    columns = 25
    high = 30 * ((n + columns - 1) `div` columns)
    places =
      [ (30 * column + 15, 30 * row + 15)
        | k <- [0 .. n - 1],
          let (row, column) = k `divMod` columns
      ]
    holes = concat [[at (x - 3) y, at (x + 3) y] | (x, y) <- places]
    at x y = "(" <> whole x <> ", " <> whole y <> ")"

-- | The union of @n@ circles in a grid.
circles :: Int -> Text
circles n =
  header "circles" 2 100
    <> "clearance 5 mm\nlet line_at(j) = union([region(circle((5 * i, 5 * j), 3)) for i in 0.."
    <> Decimal.whole (side - 1)
    <> "])\nlet all = union([line_at(j) for j in 0.."
    <> Decimal.whole (side - 1)
    <> "])\nfor c in outlines_of(all) { mill c outside { depth 1 mm rest allowed } }\n"
  where
    side = ceiling (sqrt (fromIntegral n :: Double)) :: Int

-- | A name plate of @n@ letters in lines of up to 50. The function writes the statements of a line
-- from its number, its text in quotation marks, and its place.
plateOf :: Int -> (Int -> Text -> Text -> Text) -> Text
plateOf n statementsOf =
  Text.unlines $
    [ "part plate",
      "machine linuxcnc-mill",
      "tool 1 vbit(angle 60 deg, tip 0, diameter 6)",
      "feed 600",
      "tolerance 0.02",
      "clearance 2",
      "from (0, 0, 2)",
      "spindle cw 12000 rpm"
    ]
      <> [ statementsOf k ("\"" <> line <> "\"") (at k)
           | (k, line) <- zip [0 ..] (Text.chunksOf 50 letters)
         ]
  where
    at k = " at (0, " <> Decimal.whole (8 * k) <> ") height 5"
    letters = Text.take n (Text.replicate (n `div` 15 + 1) "ABDEGKMNOPRSTUV")

-- | A point with whole coordinates in mm.
point :: (Int, Int) -> Text
point (x, y) = "  (" <> Decimal.whole x <> ", " <> Decimal.whole y <> ")"

header :: Text -> Int -> Double -> Text
header part diameter away =
  Text.unlines
    [ "part " <> part,
      "machine lkp-01f",
      "tool mill(diameter " <> Decimal.whole diameter <> " mm)",
      "feed 60 mm/min",
      "tolerance 0.02 mm",
      "from (" <> Decimal.whole (ceiling away) <> ", -20)"
    ]

statements :: Int -> Text
statements n =
  Text.unlines
    ( [ "part many",
        "machine lkp-01f",
        "tool mill(diameter 2 mm)",
        "feed 60 mm/min",
        "tolerance 0.02 mm",
        "clearance 5 mm",
        "from (-20, -20, 5)",
        "let twice(x) = 2 * x"
      ]
        <> take n (concatMap group [0 ..])
    )
  where
    group :: Int -> [Text]
    group k =
      let i = Decimal.whole k
          x = Decimal.whole (20 * (k `mod` 1000))
          y = Decimal.whole (20 * (k `div` 1000))
       in [ "let p" <> i <> " = (" <> x <> ", " <> y <> ") + polar(twice(1), 30)",
            "let c" <> i <> " = circle(p" <> i <> ", twice(2 mm))",
            "let t" <> i <> " = line((-50, -50), right c" <> i <> ")",
            "let f" <> i <> "(a) = moved(c" <> i <> ", polar(twice(a), 90 deg))",
            "assert distance(p" <> i <> ", centre_of(f" <> i <> "(1))) = 2 mm within 0.001",
            "let q" <> i <> " = intersection(t" <> i <> ", f" <> i <> "(1), near p" <> i <> ")",
            "contour k" <> i <> " closed { ccw c" <> i <> " }",
            "mill k" <> i <> " inside { depth 2 }",
            "drill at p" <> i <> " depth 3 mm"
          ]

coordinate :: Double -> Text
coordinate = Decimal.fixed 6
