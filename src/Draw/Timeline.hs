-- | Drawing of a dispatcher's timeline: the content of the cell U, and below it a row for the
-- interpolation cycles and one for each job, by priority. One A4 page.
--
-- The content of U is drawn from the ticks of the overflows alone: it grows in equal steps from one
-- overflow to the next. A job or a cycle of k ticks books its k steps at its start. The rest that
-- an overflow leaves in U is less than one step and is not drawn.
module Draw.Timeline
  ( plot,
    contentCorners,
  )
where

import Base.Decimal qualified as Decimal
import Data.List (sortOn)
import Data.Text (Text)
import Draw.Chart (Chart (..))
import Draw.Chart qualified as Chart
import Draw.LineStyle qualified as LineStyle
import Draw.Page (Area (..))
import Draw.Page qualified as Page
import Draw.Svg (Anchor (..), Pen (..), Svg, TextStyle (..))
import Draw.Svg qualified as Svg
import Geometry.Segment (Segment (Straight))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Controller (ControlJob (..), IntegratorControl (..))
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Pulse.ControllerRun (JobRun (..), Tick)
import Pulse.JobTimeline (JobTimeline (..), Tooth (..))

-- | Draws a timeline as an SVG document. The third argument is the name of the tape.
plot :: Machine -> IntegratorControl -> Text -> JobTimeline -> Text
plot machine control name timeline =
  Svg.document
    Page.wholePage
    title
    [ Svg.layer "page" [Svg.rectangle (Pen "none" 0 []) "white" Page.wholePage],
      Svg.layer "grid" (gridLines content rows timeline),
      Svg.layer "content" (contentLine content timeline),
      Svg.layer "rows" (rowNames control ordered),
      Svg.layer "waits" (concatMap (waitOf rows ordered) (jobRuns timeline)),
      Svg.layer "cycles" (map (cycleBar rows) (cycles timeline)),
      Svg.layer "jobs" (concatMap (jobBar rows ordered) (jobRuns timeline)),
      Svg.layer "borders" (map Chart.border [content, rows]),
      Svg.layer "legend" (heading control title timeline <> legend)
    ]
  where
    MachineName machineName = Machine.name machine
    title = name <> " on " <> machineName <> ": jobs of the dispatcher"
    ordered = sortOn priority (jobs control)
    across = (fromIntegral (firstTick timeline), fromIntegral (lastTick timeline))
    content = Chart contentArea across (0, 1.08)
    rows = Chart (rowsArea (length ordered)) across (0, fromIntegral (1 + length ordered))

-- | Left and right edge of both charts.
leftEdge, rightEdge :: Double
leftEdge = 52
rightEdge = 287

-- | Area of the cell U.
contentArea :: Area
contentArea = Area leftEdge 32 rightEdge 66

-- | Area of the rows, for a count of jobs.
rowsArea :: Int -> Area
rowsArea count = Area leftEdge top rightEdge (top + rowHeight count * fromIntegral (1 + count))
  where
    top = lower contentArea + 4

-- | Height of a row for a count of jobs.
rowHeight :: Int -> Double
rowHeight count = min 10 (120 / fromIntegral (1 + count))

-- | Vertical position of the middle of a row, in rows from the lower edge.
middleOf :: Chart -> Int -> Double
middleOf rows i = snd (upwards rows) - fromIntegral i - 0.5

-- Lines -------------------------------------------------------------------------------------------

framePen, contentPen, waitPen, overflowPen :: Pen
framePen = Pen LineStyle.black 0.2 [2, 1]
contentPen = Pen LineStyle.blue 0.25 []
waitPen = Pen LineStyle.red 0.25 []
overflowPen = Pen LineStyle.blue 0.1 [0.8, 0.8]

-- | Colours of the bars of cycles and of jobs.
cycleColour, jobColour :: Text
cycleColour = LineStyle.blue
jobColour = "#505050"

-- | Scales, lines between the rows, overflows and frames.
gridLines :: Chart -> Chart -> JobTimeline -> [Svg]
gridLines content rows timeline =
  map (upright Chart.gridPen) ticks
    <> Chart.grid rows [1 .. snd (upwards rows) - 1]
    <> Chart.grid content [0, 0.5, 1]
    <> [ Svg.text LineStyle.small End (Vec.shift (Vec.vec (-1.2) 0.9) (at content (left, v))) t
         | (v, t) <- [(0, "0"), (0.5, "C/2"), (1, "C")]
       ]
    <> [upright overflowPen (fromIntegral t) | (t, _) <- cycles timeline, isWithin t]
    <> concat [frameStart t n | (t, n) <- frameStarts timeline, isWithin t]
    <> Chart.bottomLabels rows (Decimal.whole . round) ticks
    <> [Svg.text LineStyle.small Start (Vec.point 10 (lower (area rows) + 4)) "tick of the clock"]
  where
    at = Chart.place
    (left, right) = across rows
    step = max 1 (Chart.stepFor 18 (rightEdge - leftEdge) (right - left))
    ticks = Chart.roundSteps step (left, right)
    isWithin t = t >= firstTick timeline && t <= lastTick timeline
    upright pen x =
      Svg.stroke pen [Straight (at content (x, snd (upwards content))) (at rows (x, 0))]
    frameStart t n =
      let p = Vec.shift (Vec.vec 0.4 (-1)) (at content (fromIntegral t, snd (upwards content)))
       in [ upright framePen (fromIntegral t),
            Svg.text LineStyle.small Start p ("frame " <> Decimal.whole n)
          ]

-- | Saw-tooth line of the cell U.
contentLine :: Chart -> JobTimeline -> [Svg]
contentLine content timeline =
  concat
    [ Chart.polyline contentPen (cut (contentCorners timeline tooth))
      | tooth <- teeth timeline
    ]
    <> [Svg.text LineStyle.small {bold = True} Start (Vec.point 10 (y + 0.9)) "cell U"]
  where
    y = (upper contentArea + lower contentArea) / 2
    (left, right) = across content
    cut corners = map (Chart.place content) (within left right corners)

-- | Part of a line between two horizontal positions. The points lie from left to right.
within :: Double -> Double -> [(Double, Double)] -> [(Double, Double)]
within left right points = concat (zipWith part points (drop 1 points))
  where
    part (x, y) (x', y')
      | x' < left || x > right = []
      | x == x' = [(x, y), (x', y')]
      | otherwise =
        [(t, y + (y' - y) * (t - x) / (x' - x)) | t <- [max left x, min right x']]

-- | Corners of the content of U over a tooth, as ticks and fractions of the capacity.
contentCorners :: JobTimeline -> Tooth -> [(Double, Double)]
contentCorners timeline (Tooth from to) =
  (fromIntegral from, 0) :
  concat
    [ [(fromIntegral a, share a), (fromIntegral a, share b), (fromIntegral b, share b)]
      | (a, b) <- booked
    ]
    <> [(fromIntegral to, 1), (fromIntegral to, 0)]
  where
    share t = min 1 (fromIntegral (t - from) / fromIntegral (max 1 (to - from)))
    booked =
      sortOn
        fst
        ( [(a, b) | (a, b) <- cycles timeline, a >= from, a < to]
            <> [(beganAt j, endedAt j) | j <- jobRuns timeline, beganAt j >= from, beganAt j < to]
        )

-- Rows --------------------------------------------------------------------------------------------

-- | Names of the rows, with the priorities and the lengths of the jobs.
rowNames :: IntegratorControl -> [ControlJob] -> [Svg]
rowNames control ordered = concat (zipWith line [0 ..] (cycleRow : map jobRow ordered))
  where
    cycleRow = ("", "interpolation", Decimal.whole (lineCycle control) <> " or " <> arc)
    arc = Decimal.whole (arcCycle control)
    jobRow j = (Decimal.whole (priority j), jobName j, Decimal.whole (duration j))
    high = rowHeight (length ordered)
    line :: Int -> (Text, Text, Text) -> [Svg]
    line i (rank, name, ticks) =
      let y = upper (rowsArea (length ordered)) + high * (fromIntegral i + 0.5) + 0.9
       in [ Svg.text LineStyle.small End (Vec.point 14 y) rank,
            Svg.text LineStyle.small Start (Vec.point 16 y) name,
            Svg.text LineStyle.small End (Vec.point (leftEdge - 2) y) ticks
          ]

-- | Bar of an interpolation cycle.
cycleBar :: Chart -> (Tick, Tick) -> Svg
cycleBar rows = bar rows cycleColour 0

-- | Bar of a job, in the row of its kind.
jobBar :: Chart -> [ControlJob] -> JobRun -> [Svg]
jobBar rows ordered r =
  [ bar rows jobColour i (beganAt r, endedAt r)
    | fromIntegral (beganAt r) < snd (across rows),
      i <- rowOf ordered r
  ]

-- | Index of the row of a job; the row 0 is that of the interpolation cycles.
rowOf :: [ControlJob] -> JobRun -> [Int]
rowOf ordered r = [i | (i, j) <- zip [1 ..] ordered, j == job r]

-- | Bar in a row between two ticks, as far as the chart reaches.
bar :: Chart -> Text -> Int -> (Tick, Tick) -> Svg
bar rows colour i (from, to) =
  Svg.rectangle (Pen "none" 0 []) colour (Area (Vec.x p) (Vec.y p) (Vec.x q) (Vec.y q))
  where
    (left, right) = across rows
    p = Chart.place rows (max left (fromIntegral from), middleOf rows i + 0.3)
    q = Chart.place rows (min right (fromIntegral to), middleOf rows i - 0.3)

-- | Line from the request of a job to its start, with a mark at the request; none if the job starts
-- at once.
waitOf :: Chart -> [ControlJob] -> JobRun -> [Svg]
waitOf rows ordered r =
  concat
    [ Svg.stroke waitPen [Straight (at from) (at to)] :
        [requestMark (at from) | fromIntegral (requestedAt r) >= left]
      | from < to,
        i <- rowOf ordered r,
        let at t = Chart.place rows (t, middleOf rows i)
    ]
  where
    (left, right) = across rows
    from = max left (fromIntegral (requestedAt r))
    to = min right (fromIntegral (beganAt r))

-- | Mark at the request of a job.
requestMark :: Point -> Svg
requestMark p =
  Svg.stroke waitPen [Straight (Vec.shift (Vec.vec 0 (-1)) p) (Vec.shift (Vec.vec 0 1) p)]

-- Legend ------------------------------------------------------------------------------------------

-- | Title, and the length of a tick.
heading :: IntegratorControl -> Text -> JobTimeline -> [Svg]
heading control title timeline =
  [ Svg.text TextStyle {size = 4, ink = LineStyle.black, bold = True} Start (Vec.point 10 14) title,
    Svg.text
      LineStyle.small
      End
      (Vec.point rightEdge 14)
      ( Decimal.whole (lastTick timeline - firstTick timeline)
          <> " ticks of "
          <> Decimal.short 3 (1000000 / fromIntegral (clock control))
          <> " µs"
      ),
    Svg.text LineStyle.small Start (Vec.point 10 (lower contentArea + 3)) "priority, job",
    Svg.text LineStyle.small End (Vec.point (leftEdge - 2) (lower contentArea + 3)) "ticks"
  ]

-- | Legend of the lines and bars.
legend :: [Svg]
legend =
  Chart.legendRow
    (Vec.point 10 20)
    [ (line contentPen, "content of the cell U, capacity C"),
      (line overflowPen, "overflow"),
      (box cycleColour, "interpolation cycle"),
      (box jobColour, "job"),
      (\p -> line waitPen p <> [requestMark p], "from request to start"),
      (line framePen, "start of a frame")
    ]
  where
    line :: Pen -> Point -> [Svg]
    line pen p = [Svg.stroke pen [Straight p (Vec.shift (Vec.vec 8 0) p)]]
    box colour p =
      [ Svg.rectangle
          (Pen "none" 0 [])
          colour
          (Area (Vec.x p) (Vec.y p - 1) (Vec.x p + 8) (Vec.y p + 1))
      ]
