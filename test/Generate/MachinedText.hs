-- | Texts of random programs with machining: milling, pockets, holes, turning, blades, splines and
-- moves, on every machine. The contours have arcs, fillets, cusps, and elements with a feed or an
-- allowance of their own. Many of the programs cannot be made, and are refused before the tape.
module Generate.MachinedText
  ( program,
    commanded,
    compensatedCurve,
  )
where

import Control.Monad (replicateM)
import Data.List (foldl', sort)
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Numeric (showFFloat)
import Test.QuickCheck

-- | x and y in mm.
type Vertex = (Double, Double)

-- | An edge from a vertex to the next one: a line, or an arc through a third point.
data Edge = Line Vertex Vertex | Arc Vertex Vertex Vertex

-- | A random program for this machine.
program :: Machine -> Gen Text
program machine =
  headed machine $
    frequency
      ( [(8, milling hasZ), (2, pocket hasZ), (2, curveMilling hasZ), (1, turning)]
          <> [(2, atOneContour machine)]
          <> [(1, drilling) | hasZ]
          <> [(1, blade) | hasZ]
          <> [(2, compensation) | name == "iso6983"]
      )
  where
    name = nameOf machine
    hasZ = movesZ machine

-- | A random program for this machine with several statements at one contour, and with commands.
commanded :: Machine -> Gen Text
commanded machine = headed machine (atOneContour machine)

headed :: Machine -> Gen [Text] -> Gen Text
headed machine = fmap (Text.unlines . (["part p", "machine " <> nameOf machine] <>))

nameOf :: Machine -> Text
nameOf machine = let MachineName name = Machine.name machine in name

movesZ :: Machine -> Bool
movesZ machine = nameOf machine /= "kontur-2p"

-- Numbers -----------------------------------------------------------------------------------------

number :: Double -> Text
number v = Text.pack (if v < 0 then "-" <> digits (abs v) else digits v)
  where
    digits a = case break (== '.') (showFFloat (Just 4) a "") of
      (whole, fraction) -> case reverse (dropWhile (== '0') (reverse fraction)) of
        "." -> whole
        shorter -> whole <> shorter

point :: Vertex -> Text
point (x, y) = "(" <> number x <> ", " <> number y <> ")"

-- | A number in the range, with this many digits after the point.
decimal :: Int -> Double -> Double -> Gen Double
decimal digits low high = roundedTo digits <$> choose (low, high)

roundedTo :: Int -> Double -> Double
roundedTo digits v = fromIntegral (round (v * 10 ^ digits) :: Int) / 10 ^ digits

rounded :: Int -> Vertex -> Vertex
rounded digits (x, y) = (roundedTo digits x, roundedTo digits y)

-- | Nothing, or one of the values.
maybeOf :: Int -> [Text] -> Gen [Text]
maybeOf weight values = frequency [(3, pure []), (weight, (: []) <$> elements values)]

-- Contours ----------------------------------------------------------------------------------------

-- | The edges of a closed contour about the origin that does not cross itself, clockwise or
-- counter-clockwise.
outline :: Gen [Edge]
outline = do
  edges <- frequency [(3, starred), (2, notched)]
  isReversed <- arbitrary
  pure (if isReversed then reverse (map backwards edges) else edges)
  where
    backwards e = case e of
      Line a b -> Line b a
      Arc a m b -> Arc b m a

-- | A star-shaped polygon with arcs in place of some edges.
starred :: Gen [Edge]
starred = do
  n <- choose (3, 9)
  digits <- elements [0, 1, 4]
  size <- elements [8, 20, 50]
  angles <- replicateM n (choose (0.15, 0.85))
  radii <- replicateM n (choose (0.45 * size, size))
  let vertices =
        [ rounded digits (r * cos a, r * sin a)
          | (i, t, r) <- zip3 [0 ..] angles radii,
            let a = 2 * pi * (fromIntegral (i :: Int) + t) / fromIntegral n
        ]
  traverse (uncurry (edge digits)) (zip vertices (drop 1 vertices <> take 1 vertices))

-- | A line, or an arc with a random sagitta.
edge :: Int -> Vertex -> Vertex -> Gen Edge
edge digits a b = frequency [(3, pure (Line a b)), (1, arc)]
  where
    arc = do
      bulge <- elements [-0.35, -0.15, -0.05, 0.05, 0.15, 0.35, 0.5]
      let ((ax, ay), (bx, by)) = (a, b)
          middle = ((ax + bx) / 2 + bulge * (by - ay), (ay + by) / 2 - bulge * (bx - ax))
      pure (Arc a (rounded (max 1 digits) middle) b)

-- | A rectangle whose upper side has steps and slots. A step is a half circle, so that it has a
-- smooth corner at one end and a cusp at the other. A slot has a flat or a round bottom.
notched :: Gen [Edge]
notched = do
  n <- choose (1, 3)
  features <- replicateM n feature
  turns <- choose (0, 3)
  let (edges, (x, y)) = foldl' append ([], (0, 0)) features
      bottom = minimum (0 : concatMap heightsOf edges) - 20
      end = (x + 12, y)
      rest =
        [ Line (x, y) end,
          Line end (x + 12, bottom),
          Line (x + 12, bottom) (0, bottom),
          Line (0, bottom) (0, 0)
        ]
  pure (map (turnedBy turns) (edges <> rest))
  where
    append (es, at) next = let (new, at') = next at in (es <> new, at')
    heightsOf e = case e of
      Line (_, a) (_, b) -> [a, b]
      Arc (_, a) (_, m) (_, b) -> [a, m, b]

-- | One feature of an upper side: its edges from a vertex on, and the vertex after it.
feature :: Gen (Vertex -> ([Edge], Vertex))
feature = do
  gap <- elements [0.5, 3, 10]
  radius <- elements [0.5, 2, 4, 7, 12]
  slope <- elements [0, 0, 0, 0.05, 0.0001]
  up <- elements [1, -1]
  side <- elements [1, -1]
  depth <- elements [3, 10, 17.5]
  kind <- choose (0, 2 :: Int)
  let step (x, y) =
        let t@(tx, ty) = (x + gap + radius, y + slope)
            end = (tx, ty + up * 2 * radius)
            top = (tx + side * radius, ty + up * radius)
            next = (tx + radius + gap, snd end)
         in ([Line (x, y) t, Arc t top end, Line end next], next)
      slot isRound (x, y) =
        let a@(ax, ay) = (x + gap, y)
            b = (ax + slope, ay - depth)
            c = (ax + 2 * radius, ay - depth)
            d = (ax + 2 * radius, ay)
            floor'
              | isRound = Arc b (ax + radius, ay - depth - radius) c
              | otherwise = Line b c
         in ([Line (x, y) a, Line a b, floor', Line c d], d)
  pure (if kind == 0 then slot (up > 0) else step)

turnedBy :: Int -> Edge -> Edge
turnedBy n e = case e of
  Line a b -> Line (turn a) (turn b)
  Arc a m b -> Arc (turn a) (turn m) (turn b)
  where
    turn p = iterate (\(x, y) -> (-y, x)) p !! n

-- | The text of a contour with this name. If @mayKeep@ is true, elements may have allowances. Such
-- contours have no fillets and chamfers: the proof refuses some right tapes with short elements
-- between two allowances.
contour :: Bool -> Text -> Text -> [Edge] -> Gen [Text]
contour mayKeep name ends edges = do
  isSpecial <- frequency [(3, pure False), (1, pure True)]
  links <- traverse (link (isSpecial && mayKeep)) (zip edges (drop 1 edges <> take 1 edges))
  modifiers <- traverse (const (if isSpecial then modifier else pure "")) edges
  pure
    ( ["contour " <> name <> " " <> ends <> " {"]
        <> zipWith3 (\e m l -> "  " <> element e <> m <> l) edges modifiers (closing links)
        <> ["}"]
    )
  where
    -- The last element of an open contour has no link.
    closing links = if ends == "open" then take (length edges - 1) links <> [""] else links
    link isPlain (e, next) = case (e, next) of
      (Line _ b, Line _ _)
        | not isPlain ->
          frequency
            [ (6, pure (" meet near " <> point b)),
              (1, (" fillet " <>) . number <$> elements [-3, 0.5, 2, 5]),
              (1, pure " chamfer 1")
            ]
      (_, _) -> pure (" meet near " <> point (endOf e))
    modifier =
      frequency
        ( [(3, pure ""), (1, pure " slow"), (1, pure " feed 30")]
            <> [(1, (" allowance " <>) <$> elements ["0.5", "1", "3"]) | mayKeep]
        )

endOf :: Edge -> Vertex
endOf e = case e of
  Line _ b -> b
  Arc _ _ b -> b

element :: Edge -> Text
element e = case e of
  Line a b -> "line(" <> point a <> ", " <> point b <> ")"
  Arc a@(ax, ay) m@(mx, my) b@(bx, by) ->
    (if (bx - ax) * (my - ay) - (by - ay) * (mx - ax) > 0 then "cw " else "ccw ")
      <> ("circle(" <> point a <> ", " <> point m <> ", " <> point b <> ")")

-- | The first edges of a closed contour.
opened :: [Edge] -> Gen [Edge]
opened edges = (`take` edges) <$> choose (1, max 1 (length edges - 1))

-- Settings ----------------------------------------------------------------------------------------

-- | Tool, feed, tolerance, clearance and start.
settings :: Bool -> Text -> Gen [Text]
settings hasZ tool = do
  feed <- elements [20, 45, 60, 120]
  tolerance <-
    elements
      [ "0.005",
        "0.02",
        "0.02",
        "0.05",
        "inside 0 outside 0.05",
        "inside 0.02 outside 0",
        "inside 0.01 outside 0.06"
      ]
  digits <- elements [0, 4]
  x <- decimal digits (-80) 80
  y <- decimal digits (-80) 80
  let start
        | hasZ = "(" <> number x <> ", " <> number y <> ", 5)"
        | otherwise = point (x, y)
  pure
    ( ["tool " <> tool, "feed " <> number feed, "tolerance " <> tolerance]
        <> ["clearance 3" | hasZ]
        <> ["from " <> start]
    )

mill :: Gen Text
mill = (\d -> "mill(diameter " <> d <> ")") <$> elements ["1", "2", "4", "5.3", "8", "12"]

-- | The settings that milling along a contour and clearing a pocket have in common.
depths :: Bool -> Gen [Text]
depths hasZ
  | hasZ = (<>) <$> frequency [(1, pure []), (3, deep)] <*> maybeOf 1 ["plunge 20"]
  | otherwise = pure []
  where
    deep = (: []) <$> elements ["depth 3", "depth 4 step 2", "depth 5 step 1.9"]

statement :: Text -> [[Text]] -> [Text]
statement head' parts = [head' <> " {"] <> map ("  " <>) (concat parts) <> ["}"]

stops :: Bool -> Gen Text
stops hasZ = do
  n <- choose (1, 3 :: Int)
  Text.intercalate ", " <$> replicateM n stop
  where
    stop = do
      x <- decimal 1 (-70) 70
      y <- decimal 1 (-70) 70
      z <- elements (["", ""] <> [", 3" | hasZ] <> [", 8" | hasZ])
      pace <- elements ["", "", " rapid", " feed 30"]
      pure ("(" <> number x <> ", " <> number y <> z <> ")" <> pace)

-- Statements --------------------------------------------------------------------------------------

-- | Milling along one or two closed or open contours, and moves.
milling :: Bool -> Gen [Text]
milling hasZ = do
  tool <- frequency [(6, mill), (1, pure "cone(diameter 6, bevel 5 deg, height 4)")]
  set <- settings hasZ tool
  n <- elements [1, 1, 1, 2 :: Int]
  jobs <- traverse job (take n ["a", "b"])
  moves <-
    frequency
      [ (3, pure []),
        (1, (: []) . ("rapid " <>) <$> stops hasZ),
        (1, (: []) . ("move " <>) <$> stops hasZ)
      ]
  pure (set <> concatMap fst jobs <> moves <> concatMap snd jobs)
  where
    job name = do
      edges <- outline
      isClosed <- frequency [(3, pure True), (1, pure False)]
      isRestAllowed <- frequency [(3, pure True), (1, pure False)]
      let written = contour True name
      text <- if isClosed then written "closed" edges else opened edges >>= written "open"
      side <-
        if isClosed
          then elements ["outside", "inside", "outside", "inside", "on"]
          else elements ["left", "right", "on"]
      sets <- millSettings hasZ isClosed
      pure
        (text, statement ("mill " <> name <> " " <> side) [["rest allowed" | isRestAllowed], sets])

millSettings :: Bool -> Bool -> Gen [Text]
millSettings hasZ isClosed = do
  deep <- depths hasZ
  allowance <- maybeOf 1 ["allowance 1, 0", "allowance 0.5", "allowance 2, 0.3, 0"]
  leads <-
    maybeOf
      1
      ["lead in line 3 lead out line 2", "lead in arc 2 lead out arc 3", "lead out line 1.5"]
  corners <- maybeOf 1 ["corners sharp", "corners round"]
  sense <- if isClosed then maybeOf 1 ["climb", "conventional"] else pure []
  near <- if isClosed then startNear else pure []
  approach <- frequency [(3, pure []), (1, (\s -> ["approach " <> s]) <$> stops hasZ)]
  retract <- frequency [(3, pure []), (1, (\s -> ["retract " <> s]) <$> stops hasZ)]
  pure (deep <> allowance <> leads <> corners <> sense <> near <> approach <> retract)
  where
    startNear = do
      x <- decimal 1 (-60) 60
      y <- decimal 1 (-60) 60
      elements [[], ["start near " <> point (x, y)]]

pocket :: Bool -> Gen [Text]
pocket hasZ = do
  tool <- mill
  set <- settings hasZ tool
  edges <- outline
  text <- contour False "a" "closed" edges
  island <- elements [[], [], ["contour i closed { ccw circle((1, 2), 3) }"]]
  share <- elements [0.3, 0.5, 0.8, 1]
  let stepover = number (share * read (Text.unpack (Text.dropEnd 1 (Text.drop 14 tool))))
  deep <- depths hasZ
  allowance <- maybeOf 1 ["allowance 1, 0", "allowance 0.5"]
  sense <- maybeOf 1 ["climb", "conventional"]
  pure
    ( set <> text <> island
        <> statement
          ("pocket a step " <> stepover)
          [deep, allowance, sense, ["rest allowed"], ["islands i" | not (null island)]]
    )

-- | Several statements that cut at the same contour, with feeds, cutters and allowances of their
-- own, and with commands and moves between them. Some statements are written twice.
atOneContour :: Machine -> Gen [Text]
atOneContour machine = do
  set <- mill >>= settings hasZ
  edges <- outline
  text <- contour False "a" "closed" edges
  isInside <- arbitrary
  written <- choose (2, 3 :: Int) >>= \n -> replicateM n (job isInside)
  copies <- traverse (const (frequency [(3, pure 1), (1, pure 2)])) written
  between <- traverse (const (listOf' 2 change)) written
  pure (set <> text <> concat (zipWith (<>) (concat <$> zipWith replicate copies written) between))
  where
    hasZ = movesZ machine
    listOf' most one = choose (0, most) >>= \n -> concat <$> replicateM n one
    job isInside = do
      -- Only heights show on a tape where one pocket ends and the next begins.
      isPocket <- frequency [(2, pure False), (1, pure (isInside && hasZ))]
      if isPocket then clearing else along (if isInside then "inside" else "outside")
    along side = do
      sets <- millSettings hasZ True
      pure (statement ("mill a " <> side) [["rest allowed"], sets])
    clearing = do
      deep <- depths hasZ
      stepover <- elements ["0.7", "1.5", "3"]
      allowance <- maybeOf 1 ["allowance 1, 0", "allowance 0.5"]
      pure (statement ("pocket a step " <> stepover) [deep, allowance, ["rest allowed"]])
    change =
      fmap (: []) . oneof $
        [ ("feed " <>) <$> elements ["20", "30", "60"],
          elements commands,
          ("rapid " <>) <$> stops hasZ
        ]
          -- The other tapes do not show where the tool is changed.
          <> [("change 2 " <>) <$> mill | name `elem` ["kontur-2p", "kontur-3p", "n55", "iso6983"]]
    commands =
      ["coolant on", "coolant off", "spindle cw 800 rpm", "spindle off"]
        <> ["aux 3" | name `elem` ["lkp-01f", "kontur-2p", "kontur-3p"]]
    name = nameOf machine

drilling :: Gen [Text]
drilling = do
  set <- settings True "drill(diameter 5)"
  n <- choose (1, 5 :: Int)
  ps <- replicateM n ((,) <$> decimal 1 (-60) 60 <*> decimal 1 (-60) 60)
  depth <- elements ["3", "8", "12.5"]
  peck <- maybeOf 3 ["peck 2", "peck 4.5"]
  plunge <- maybeOf 3 ["plunge 20"]
  let points = "[" <> Text.intercalate ", " (map point ps) <> "]"
  pure (set <> statement ("drill at " <> points <> " depth " <> depth) [peck, plunge])

-- | Turning along a profile that rises or falls.
turning :: Gen [Text]
turning = do
  nose <- elements ["0", "0.4", "1"]
  set <- settings False ("turn(nose " <> nose <> ")")
  n <- choose (2, 5 :: Int)
  xs <- replicateM n (elements [3, 7.5, 12])
  ys <- replicateM n (decimal 1 5 30)
  isRising <- arbitrary
  let ends = zip (map negate (scanl1 (+) xs)) (if isRising then sort ys else reverse (sort ys))
  edges <- traverse (uncurry (edge 1)) (zip ends (drop 1 ends))
  text <- contour False "a" "open" edges
  side <- elements ["outside", "outside", "left", "right"]
  allowance <- maybeOf 1 ["allowance 1.5, 0", "allowance 0.2"]
  rest <- elements [[], ["rest allowed"]]
  approach <- elements [[], ["approach (5, 45) rapid"]]
  retract <- elements [[], ["retract (-60, 50) rapid, (10, 50) rapid"]]
  pure (set <> text <> statement ("turn a " <> side) [allowance, rest, approach, retract])

-- | A blade along an open or a closed contour with a bevel.
blade :: Gen [Text]
blade = do
  set <- settings True "blade(diameter 8, gear 60)"
  edges <- outline
  isClosed <- arbitrary
  bevels <- traverse (const (elements ["", " bevel 3 deg", " bevel 5 deg", " bevel -4 deg"])) edges
  used <- if isClosed then pure edges else opened edges
  side <- if isClosed then elements ["outside", "inside"] else elements ["left", "right"]
  rest <- frequency [(3, pure ["rest allowed"]), (1, pure [])]
  leads <- maybeOf 1 ["lead in line 3 lead out line 2"]
  let ends = if isClosed then "closed" else "open"
  pure
    ( set
        <> ["contour a " <> ends <> " {"]
        <> zipWith3
          (\e b isLast -> "  " <> element e <> b <> if isLast then "" else meeting e)
          used
          (first bevels)
          (replicate (length used - 1) False <> [not isClosed])
        <> ["}"]
        <> statement ("mill a " <> side) [rest, leads]
    )
  where
    meeting e = " meet near " <> point (endOf e)
    first bs = case bs of
      "" : more -> " bevel 2 deg" : more
      _ -> bs

-- | A closed contour milled with compensation by the control.
compensation :: Gen [Text]
compensation = do
  tool <- mill
  set <- settings True tool
  edges <- outline
  text <- contour False "a" "closed" edges
  side <- elements ["outside", "inside"]
  sets <- millSettings True True
  x <- decimal 1 (-60) 60
  y <- decimal 1 (-60) 60
  pure
    ( set <> text
        <> statement
          ("mill a " <> side)
          [ sets,
            ["approach " <> point (x, y), "retract " <> point (y, x), "compensation controller"]
          ]
    )

-- | A program for iso6983 in which the control compensates along a closed spline. The cutter is not
-- much smaller than the smallest concave radius, so that its path is much shorter than the edge.
compensatedCurve :: Gen Text
compensatedCurve = do
  set <- settings False "mill(diameter d)"
  mean <- choose (10, 40)
  share <- choose (0, 0.35)
  lobes <- elements [2, 3, 4, 5 :: Int]
  spare <- elements [0.09, 0.12, 0.2, 0.5, 1, 2]
  (side, isInside) <- elements [("outside", False), ("outside", False), ("inside", True)]
  perLobe <- choose (3, 6)
  offset <- choose (-1.5, 1.5)
  leads <- maybeOf 1 ["lead in arc 1 lead out arc 1", "lead in line 2 lead out line 2"]
  let wave = share * mean
      n = lobes * perLobe
      at k =
        let a = 2 * pi * fromIntegral k / fromIntegral n
            r = mean + wave * cos (fromIntegral lobes * a)
         in rounded 3 (r * cos a, r * sin a)
      -- Radius of curvature where the radius about the origin is @r@, and its second derivative is
      -- @r''@: @r² / |r − r''|@.
      bend = wave * fromIntegral (lobes * lobes)
      concave
        | isInside = (mean + wave) ^ two / (mean + wave + bend)
        | bend > mean - wave = (mean - wave) ^ two / (bend - (mean - wave))
        | otherwise = mean
      cutter = roundedTo 3 (min (mean / 2) (max 0.5 (concave - spare)))
      start
        | isInside = (0, 0)
        | otherwise = rounded 2 (mean + wave + 3 * cutter + 3, offset * cutter)
  pure . Text.unlines $
    ["part p", "machine iso6983", "let d = " <> number (2 * cutter)]
      <> set
      <> ["curve c = closed_spline([" <> listed (map at [0 .. n - 1]) <> "])"]
      <> ["contour a closed { c }"]
      <> statement
        ("mill a " <> side)
        [["approach " <> point start, "retract " <> point start, "compensation controller"], leads]
  where
    two = 2 :: Int
    listed = Text.intercalate ", " . map point

-- | Milling along a spline, or along a piece that ciphers make of it.
curveMilling :: Bool -> Gen [Text]
curveMilling hasZ = do
  tool <- mill
  set <- settings hasZ tool
  n <- choose (4, 8 :: Int)
  steps <- replicateM n (elements [10, 17, 28])
  ys <- replicateM n (decimal 1 (-6) 6)
  mus <- replicateM n (decimal 1 2 8)
  ciphers <- frequency [(1, pure []), (2, someCiphers)]
  shiftSide <- elements [" left", " right"]
  side <- elements ["left", "right", "on"]
  isRestAllowed <- frequency [(3, pure True), (1, pure False)]
  sets <- millSettings hasZ False
  let row x y m = "  " <> Text.unwords (map number [x, y, m])
      rows = zipWith3 row (scanl (+) 0 steps) ys mus
      used = if null ciphers then "skin" else "edge"
  pure
    ( set
        <> ["table hull {", "  x y mu deg"]
        <> rows
        <> ["}", "curve skin = spline(hull)"]
        <> [ "piece edge = skin cipher " <> Text.intercalate ", " ciphers <> shiftSide
             | not (null ciphers)
           ]
        <> ["contour a open { " <> used <> " }"]
        <> statement ("mill a " <> side) [["rest allowed" | isRestAllowed], sets]
    )

-- | Up to four ciphers, which use the column @mu@.
someCiphers :: Gen [Text]
someCiphers = do
  n <- choose (1, 4 :: Int)
  replicateM n $
    elements
      [ "2(2)",
        "2(1, mu)",
        "4(mu, 15)",
        "4(mu, 10)",
        "1(2, 3)",
        "1(3, 2, mu)",
        "6(mu / 4 deg)",
        "2(-1)"
      ]
