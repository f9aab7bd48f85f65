-- | Drawing of a run over time: the feed along the path, and below it a strip for each axis with
-- its pulse frequency. One A4 page, made to be printed; its size does not grow with the tape.
module Draw.SpeedPlot
  ( columns,
    plot,
    feedRange,
    hasMotion,
  )
where

import Base.Decimal qualified as Decimal
import Base.LazyList qualified as LazyList
import Data.List (mapAccumL)
import Data.Text (Text)
import Data.Text qualified as Text
import Draw.Chart (Chart (..))
import Draw.Chart qualified as Chart
import Draw.LineStyle qualified as LineStyle
import Draw.Page (Area (..))
import Draw.Page qualified as Page
import Draw.Svg (Anchor (..), Pen (..), Svg, TextStyle (..))
import Draw.Svg qualified as Svg
import Draw.TimeColumn (Band (..), TimeColumns)
import Draw.TimeColumn qualified as TimeColumn
import Geometry.Segment (Segment (Straight))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Pulse.ControllerRun (ControllerRun, StopReason)
import Pulse.RunSample (SampleKind (..))
import Pulse.RunSample qualified as RunSample

-- | Columns of the frames whose numbers satisfy the predicate, and the reason why the run stops.
-- The second argument is the frequency of the clock.
columns :: Machine -> Int -> (Int -> Bool) -> ControllerRun -> (TimeColumns, StopReason)
columns machine clock isShown =
  go (TimeColumn.empty mostColumns) . RunSample.samples machine clock isShown
  where
    go c list = case list of
      LazyList.Next s more -> let c' = TimeColumn.add s c in c' `seq` go c' more
      LazyList.End why -> (c, why)

-- | Largest count of columns. A column is then at most a third of a millimetre wide.
mostColumns :: Int
mostColumns = 1600

-- | Scene: the columns, the seconds of a tick, and the charts of the feed and of the axes.
data SpeedScene = SpeedScene
  { drawn :: TimeColumns,
    secondsOf :: Int -> Double,
    feedChart :: Chart,
    axisCharts :: [(Int, Text, Chart)]
  }

-- | Draws columns as an SVG document. The arguments are also the axes of the machine by their index
-- and name, the frequency of the clock, and the name of the tape.
plot :: Machine -> [(Int, Text)] -> Int -> Text -> TimeColumns -> Text
plot machine axes clock name c =
  Svg.document
    Page.wholePage
    title
    [ Svg.layer "page" [Svg.rectangle (Pen "none" 0 []) "white" Page.wholePage],
      Svg.layer "waits" (waits s),
      Svg.layer "grid" (gridLines s),
      Svg.layer "frames" (frames s),
      Svg.layer "feed" (feedLines s),
      Svg.layer "frequencies" (concatMap (frequencyLines s) (axisCharts s)),
      Svg.layer "borders" (map Chart.border (charts s)),
      Svg.layer "legend" (heading title s <> legend s)
    ]
  where
    s = scene axes clock c
    MachineName machineName = Machine.name machine
    title = name <> " on " <> machineName <> ": feed and pulse frequencies"

charts :: SpeedScene -> [Chart]
charts s = feedChart s : [chart | (_, _, chart) <- axisCharts s]

-- | Left and right edge of the charts, upper edge of the first and lower edge of the last one.
chartArea :: Area
chartArea = Area 33 30 287 192

-- | Height in mm of a strip for an axis without pulses, and the gap between two charts.
stillHeight, gap :: Double
stillHeight = 6
gap = 3

-- | Charts side by side in time: the feed above, the axes below it.
scene :: [(Int, Text)] -> Int -> TimeColumns -> SpeedScene
scene axes clock c =
  SpeedScene
    { drawn = c,
      secondsOf,
      feedChart = Chart chartArea {lower = upper chartArea + feedHeight} across (0, highestFeed c),
      axisCharts
    }
  where
    secondsOf t = fromIntegral t / fromIntegral clock
    across = (secondsOf (TimeColumn.origin c), secondsOf (TimeColumn.finish c))
    ranges = [frequencyRange k c | (k, _) <- axes]
    moving = length (filter (/= (0, 0)) ranges)
    stillCount = length axes - moving
    room =
      lower chartArea - upper chartArea
        - gap * fromIntegral (length axes)
        - stillHeight * fromIntegral stillCount
    movingHeight = min 36 (room * 0.6 / fromIntegral (max 1 moving))
    feedHeight = room - movingHeight * fromIntegral moving
    (_, axisCharts) =
      mapAccumL strip (upper chartArea + feedHeight + gap) (zip axes ranges)
    strip top ((k, name), range) =
      let high = if range == (0, 0) then stillHeight else movingHeight
          area = chartArea {upper = top, lower = top + high}
       in (top + high + gap, (k, name, Chart area across (padded range)))
    padded (a, b) = if a == b then (-1, 1) else (a - 0.06 * (b - a), b + 0.06 * (b - a))

-- | Least and highest frequency of an axis, and 0.
frequencyRange :: Int -> TimeColumns -> (Double, Double)
frequencyRange k c = (minimum (0 : map least bs), maximum (0 : map highest bs))
  where
    bs = map snd (TimeColumn.bands (AxisFrequency k) c)

-- | Least and highest feed that is measured; Nothing if nothing moves.
feedRange :: TimeColumns -> Maybe (Double, Double)
feedRange c = case map snd (TimeColumn.bands FeedMeasured c) of
  [] -> Nothing
  bs -> Just (minimum (map least bs), maximum (map highest bs))

-- | True if anything moves.
hasMotion :: TimeColumns -> Bool
hasMotion c =
  or [highest band > 0 | k <- [FeedMeasured, TurningMeasured], (_, band) <- TimeColumn.bands k c]

-- | Feed at the upper edge of the chart. A feed that is asked counts only up to three times the
-- highest feed that is measured: rapid moves may ask a feed that no controller reaches.
highestFeed :: TimeColumns -> Double
highestFeed c = headroom * maximum (1e-3 : most : filter isReached asked)
  where
    -- Room for the arrows at feeds that lie above the chart.
    headroom = if all isReached asked then 1.06 else 1.15
    isReached v = v <= 3 * most
    most = maximum (0 : concatMap highestOf [FeedMeasured, TurningMeasured])
    asked = highestOf FeedAsked
    highestOf k = map (highest . snd) (TimeColumn.bands k c)

-- Lines -------------------------------------------------------------------------------------------

measuredPen, turningPen, askedPen, frequencyPen, frameLinePen :: Pen
measuredPen = Pen LineStyle.blue 0.3 []
turningPen = Pen LineStyle.blue 0.3 [1.5, 0.8]
askedPen = Pen LineStyle.red 0.15 []
frequencyPen = Pen LineStyle.black 0.2 []
frameLinePen = Pen "#c8c8c8" 0.1 []

-- | Colours of the area between least and highest value, for feeds and for frequencies, and of
-- waits.
feedBandColour, frequencyBandColour, waitColour :: Text
feedBandColour = "#b9cbea"
frequencyBandColour = "#cfcfcf"
waitColour = "#f6e3b0"

-- | Waits for the reader, as areas over all charts.
waits :: SpeedScene -> [Svg]
waits s =
  [ Svg.rectangle (Pen "none" 0 []) waitColour chartArea {leftmost = x, rightmost}
    | (t, band) <- TimeColumn.bands ReaderWait (drawn s),
      let x = acrossAt s t,
      let rightmost = max (x + 0.2) (acrossAt s (t + ticks band))
  ]

-- | Horizontal position of a tick.
acrossAt :: SpeedScene -> Int -> Double
acrossAt s t = Vec.x (Chart.place (feedChart s) (secondsOf s t, 0))

-- | Horizontal lines with their values, the names of the charts, and the scale of time.
gridLines :: SpeedScene -> [Svg]
gridLines s =
  chartName "feed" "mm/min" (feedChart s)
    <> valued 7 (feedChart s)
    <> concat [chartName name "Hz" chart <> valued 5 chart | (_, name, chart) <- axisCharts s]
    <> Chart.bottomLabels bottom (Decimal.short 6) (Chart.roundSteps step (across bottom))
    <> [Svg.text LineStyle.small Start (Vec.point 10 (lower chartArea + 4)) "time, s"]
  where
    bottom = last (charts s)
    (a, b) = across bottom
    step = Chart.stepFor 16 (rightmost chartArea - leftmost chartArea) (b - a)
    valued apart chart =
      let (low, high) = upwards chart
          size = lower (area chart) - upper (area chart)
          vs
            | size <= stillHeight = [0]
            | otherwise = Chart.roundSteps (Chart.stepFor apart size (high - low)) (low, high)
       in Chart.grid chart vs <> Chart.valueLabels chart vs
    chartName name unit chart =
      let y = (upper (area chart) + lower (area chart)) / 2 + 0.9
          unitAt = if name == "feed" then Vec.point 10 (y + 3.5) else Vec.point 14 y
       in [ Svg.text LineStyle.small {bold = True} Start (Vec.point 10 y) name,
            Svg.text LineStyle.small Start unitAt unit
          ]

-- | Lines at the beginnings of frames, and the numbers of frames where there is room.
frames :: SpeedScene -> [Svg]
frames s =
  [upright x | (x, n) <- starts, n `elem` numbered || isApart x]
    <> [written (x + 0.3) (Decimal.whole n) | (x, n) <- starts, n `elem` numbered]
    <> [written 10 "frame"]
  where
    upright x =
      Svg.stroke
        frameLinePen
        [Straight (Vec.point x (upper chartArea)) (Vec.point x (lower chartArea))]
    written x = Svg.text small Start (Vec.point x (upper chartArea - 1))
    small = LineStyle.small {size = 2.2}
    starts = [(acrossAt s t, n) | (t, n) <- TimeColumn.frameStarts (drawn s)]
    numbered = labelled 0 starts
    labelled from list = case list of
      [] -> []
      (x, n) : more
        | x >= from -> n : labelled (x + 1.2 + Svg.textWidth 2.2 (Decimal.whole n)) more
        | otherwise -> labelled from more
    isApart x = null [() | (x', _) <- starts, x' /= x, abs (x' - x) < 1.2]

-- | Feed asked and feed measured.
feedLines :: SpeedScene -> [Svg]
feedLines s =
  concatMap (bandAreas s chart feedBandColour) [FeedMeasured, TurningMeasured]
    <> concatMap (Chart.polyline measuredPen) (meanLines s chart FeedMeasured)
    <> concatMap (Chart.polyline turningPen) (meanLines s chart TurningMeasured)
    <> concatMap asked (runsOfAsked (TimeColumn.bands FeedAsked (drawn s)))
  where
    chart = feedChart s
    (_, top) = upwards chart
    asked (from, to, v)
      | v <= top =
        Chart.polyline askedPen [Chart.place chart (t, v) | t <- [secondsOf s from, secondsOf s to]]
      | otherwise = tooHigh (acrossAt s from) (acrossAt s to) v
    tooHigh x x' v =
      let p = Vec.point ((x + x') / 2) (upper chartArea + 0.4)
       in Svg.arrow LineStyle.red 1.6 (Vec.vec 0 (-1)) p :
            [ Svg.text style Middle (Vec.shift (Vec.vec 0 3.8) p) (Decimal.short 0 v)
              | x' - x > Svg.textWidth 2.2 (Decimal.short 0 v)
            ]
    style = LineStyle.small {size = 2.2, ink = LineStyle.red}
    runsOfAsked found = joinRuns [(t, t + width', mean') | (t, b) <- found, let mean' = highest b]
    width' = TimeColumn.width (drawn s)

-- | Joins neighbouring columns of one value.
joinRuns :: [(Int, Int, Double)] -> [(Int, Int, Double)]
joinRuns runs = case runs of
  (a, b, v) : (c, d, w) : more
    | b == c && v == w -> joinRuns ((a, d, v) : more)
    | otherwise -> (a, b, v) : joinRuns ((c, d, w) : more)
  _ -> runs

-- | Frequency of an axis.
frequencyLines :: SpeedScene -> (Int, Text, Chart) -> [Svg]
frequencyLines s (k, _, chart) =
  bandAreas s chart frequencyBandColour (AxisFrequency k)
    <> concatMap (Chart.polyline frequencyPen) (meanLines s chart (AxisFrequency k))

-- | Lines through the means of the columns, one for each run of neighbouring columns.
meanLines :: SpeedScene -> Chart -> SampleKind -> [[Point]]
meanLines s chart k = map line (neighbours s (TimeColumn.bands k (drawn s)))
  where
    line bs = Chart.simplified 0.02 (map (at 0) (take 1 bs) <> map (at 0.5) bs <> [at 1 (last bs)])
    at share (t, b) =
      Chart.place chart (min end (secondsOf s t + share * wide), TimeColumn.mean b)
    wide = secondsOf s (TimeColumn.width (drawn s))
    (_, end) = across chart

-- | Areas between the least and the highest value, where they differ visibly.
bandAreas :: SpeedScene -> Chart -> Text -> SampleKind -> [Svg]
bandAreas s chart colour k = concatMap polygon (concatMap (split . map corner) runs)
  where
    runs = neighbours s (TimeColumn.bands k (drawn s))
    width' = TimeColumn.width (drawn s)
    corner (t, b) =
      let p = Chart.place chart (secondsOf s t, highest b)
          q = Chart.place chart (secondsOf s (t + width'), least b)
       in (p, q)
    isWide (p, q) = Vec.y q - Vec.y p > 0.15
    split cs = case dropWhile (not . isWide) cs of
      [] -> []
      wide -> let (now, later) = span isWide wide in now : split later
    polygon cs =
      Chart.filled
        colour
        ( concat [[p, Vec.point (Vec.x q) (Vec.y p)] | (p, q) <- cs]
            <> concat [[q, Vec.point (Vec.x p) (Vec.y q)] | (p, q) <- reverse cs]
        )

-- | Runs of columns without a gap.
neighbours :: SpeedScene -> [(Int, Band)] -> [[(Int, Band)]]
neighbours s = foldr add []
  where
    reach = 2 * TimeColumn.width (drawn s)
    add b runs = case runs of
      (first : rest) : more | (t, _) : _ <- [first], t - fst b <= reach -> (b : first : rest) : more
      _ -> [b] : runs

-- Legend ------------------------------------------------------------------------------------------

-- | Title, and the time and frames that are shown.
heading :: Text -> SpeedScene -> [Svg]
heading title s =
  [ Svg.text TextStyle {size = 4, ink = LineStyle.black, bold = True} Start (Vec.point 10 14) title,
    Svg.text
      LineStyle.small
      End
      (Vec.point (rightmost chartArea) 14)
      (Text.intercalate ", " (framesShown <> [Decimal.fixed 3 (b - a) <> " s"]))
  ]
  where
    (a, b) = across (feedChart s)
    numbers = map snd (TimeColumn.frameStarts (drawn s))
    framesShown = case numbers of
      [] -> []
      [n] -> ["frame " <> Decimal.whole n]
      n : more -> ["frames " <> Decimal.whole n <> "–" <> Decimal.whole (last more)]

-- | Legend of the lines and areas that occur.
legend :: SpeedScene -> [Svg]
legend s =
  Chart.legendRow
    (Vec.point 10 20)
    ( [(line measuredPen, "feed measured over each mm") | has FeedMeasured]
        <> [(line turningPen, "the same in °/min, only a and b turn") | has TurningMeasured]
        <> [(line askedPen, "feed asked") | has FeedAsked]
        <> [(line frequencyPen, "pulse frequency")]
        <> [(halves, "least to highest")]
        <> [(box waitColour 0 8, "wait for the reader") | has ReaderWait]
    )
  where
    has k = not (null (TimeColumn.bands k (drawn s)))
    line pen p = [Svg.stroke pen [Straight p (Vec.shift (Vec.vec 8 0) p)]]
    halves p = box feedBandColour 0 4 p <> box frequencyBandColour 4 8 p
    box colour from to p =
      [ Svg.rectangle
          (Pen "none" 0 [])
          colour
          (Area (Vec.x p + from) (Vec.y p - 1) (Vec.x p + to) (Vec.y p + 1))
      ]
