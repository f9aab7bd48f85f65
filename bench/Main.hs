-- | What each stage costs and how it grows: programs of 100 to 10,000 written elements.
--
-- A stage is timed as the difference of two whole runs, from the text to its end and to the end of the
-- one before, so nothing but the summary of the last output has to be forced. The best of a few runs counts.
module Main (main) where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), Pulses (..), total)
import Base.Region qualified as Region
import Base.Result qualified as Result
import Checked.FromSurface qualified as Checked
import Checked.Syntax qualified as Checked
import Compile (Analysis (..), Punched (..))
import Compile qualified
import Control.Exception (evaluate)
import Control.Monad (forM, forM_)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.IO qualified as Text
import Frame.Frame (increment)
import Frame.Frame qualified as Frame
import Frame.FromPath qualified as Frame
import Geometry.Segment qualified as Segment
import Linear.V3 (V3 (..))
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine (Machine, MachineName (..))
import Part.FromChecked qualified as Part
import Part.Part qualified as Part
import Path.Path qualified as Path
import Surface.Parser qualified as Surface
import Surface.Syntax qualified as Surface
import System.CPUTime (getCPUTime)
import Tape.Tape qualified as Tape
import Verify.Proof qualified as Proof

main :: IO ()
main = do
  flange <- Text.readFile "examples/flange.part"
  putStrLn "milliseconds of processor time for each stage, best of several runs; growth is the exponent from the program before"
  forM_ [("flange", [(18, flange)]), ("polygon", [(n, polygon n) | n <- [100, 1000, 10000]]), ("statements", [(n, statements n) | n <- [1000, 5000, 20000]]), ("rows", [(n, rows [] n) | n <- [100, 1000, 10000]]), ("ciphers", [(n, rows ["2(2.5)", "4(mu, H)"] n) | n <- [100, 1000]])] $ \(name, programs) -> do
    lines' <- forM programs $ \(n, text) -> (n,) <$> forM stages (\(_, run) -> timed (if n > 1000 then 3 else 7) text run)
    Text.putStrLn ("\n" <> Text.justifyLeft 10 ' ' name <> Text.concat (map (Text.justifyRight 9 ' ' . fst) stages))
    forM_ (zip lines' (Nothing : map Just lines')) $ \((n, times), before) -> do
      let own = zipWith (-) times (0 : times)
      Text.putStrLn (Text.justifyRight 10 ' ' (Decimal.whole n) <> Text.concat [Text.justifyRight 9 ' ' (Decimal.fixed 2 (max 0 t)) | t <- own])
      forM_ before $ \(m, times') -> do
        let own' = zipWith (-) times' (0 : times')
            growth a b = if a < 0.05 || b < 0.05 then "–" else Decimal.fixed 2 (logBase (fromIntegral n / fromIntegral m) (a / b))
        Text.putStrLn (Text.justifyRight 10 ' ' "growth" <> Text.concat (zipWith (\a b -> Text.justifyRight 9 ' ' (growth a b)) own own'))

-- | Stages in order: each runs from the text and gives a number that needs its whole output.
stages :: [(Text, Text -> Int)]
stages =
  [ ("parse", sum . map itemsOf . Surface.statements . sound . Surface.parse 0),
    ("check", round . sum . map weight . Checked.statements . checked),
    ("part", \t -> sum [round (sumOf c) | c <- Part.contours (sound (Part.evaluate (checked t)))]),
    ("path", \t -> round (lengthOf (path (sound (analyse t))))),
    ("frames", \t -> sum (map (distance . increment . Frame.frame) (Frame.planned (framesOf t)))),
    ("tape", Tape.rowCount . tape . punched),
    ("verify", \t -> length (show (Proof.findings (proof t))))
  ]
  where
    checked t = sound (Checked.check (sound (Surface.parse 0 t)))
    analyse t = Compile.analyse [] (Compile.alone "bench" t)
    framesOf t = sound (Frame.quantise lkp01f (path (sound (analyse t))))
    punched t = sound (Compile.punch lkp01f (path (sound (analyse t))))
    proof t =
      let a = sound (analyse t)
          p = sound (Compile.punch lkp01f (path a))
       in sound (Compile.prove lkp01f (path a) (program p) (sound (Compile.readTape lkp01f (Frame.start (program p)) (tape p))))
    itemsOf s = case Region.value s of
      Surface.Contour _ _ items -> sum [1 | Region.Located _ (Surface.Element _ e _ _) <- items, Region.start (Region.region e) >= 0]
      _ -> 1
    weight s = case Region.value s of
      Checked.Contour _ _ items -> sum [x + y | Region.Located _ (Checked.Element _ (Region.Located _ (Checked.Pair (Region.Located _ (Checked.Number x)) (Region.Located _ (Checked.Number y)))) _ _) <- items]
      _ -> 1
    sumOf c = let Mm l = total (map (Segment.length . Part.segment) (NonEmpty.toList (Part.elements c))) in l :: Double
    lengthOf p = let Mm l = total (map (Segment.length . Path.segment) (concatMap Path.moves (Path.blocks p))) in l :: Double
    distance (V3 (Pulses x) (Pulses y) (Pulses z)) = abs x + abs y + abs z

lkp01f :: Machine
lkp01f = fromMaybe (error "no such machine") (BuiltIn.find (MachineName "lkp-01f"))

sound :: Result.Result w e a -> a
sound r = case Result.settled r of
  Just a -> a
  Nothing -> error "a program of the benchmark has errors"

-- | Milliseconds of the fastest of so many runs. Every run gets a text of its own, so that none can be shared.
timed :: Int -> Text -> (Text -> Int) -> IO Double
timed count text run = minimum <$> forM [1 .. count] once
  where
    once k = do
      fresh <- evaluate (text <> Text.replicate k "\n")
      begin <- getCPUTime
      _ <- evaluate (run fresh)
      end <- getCPUTime
      pure (fromIntegral (end - begin) / 1e9)

-- | A program of so many statements of many kinds: points, circles, tangent lines, functions and their
-- calls, assertions, contours, holes.
statements :: Int -> Text
statements n =
  Text.unlines
    ( ["part many", "machine lkp-01f", "tool mill(diameter 2 mm)", "feed 60 mm/min", "tolerance 0.02 mm", "clearance 5 mm", "from (-20, -20, 5)", "let twice(x) = 2 * x"]
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

-- | A closed spline through a table of so many rows, recalculated by some ciphers.
rows :: [Text] -> Int -> Text
rows ciphers n =
  Text.unlines
    ( ["part wave", "machine lkp-01f", "tool mill(diameter 6 mm)", "feed 60 mm/min", "tolerance 0.02 mm", "from (" <> coordinate (0.7 * r + 40) <> ", 0)", "table t {", "x y mu H"]
        <> map row [0 .. n - 1]
        <> ["}", "curve skin = closed_spline(t)"]
        <> ["piece p = skin cipher " <> Text.intercalate ", " ciphers <> " right" | not (null ciphers)]
        <> ["contour c closed { " <> (if null ciphers then "skin" else "p") <> " }", "mill c outside { start near (" <> coordinate r <> ", 0) }"]
    )
  where
    r = fromIntegral n :: Double
    row :: Int -> Text
    row k =
      let a = 2 * pi * fromIntegral k / fromIntegral n
          d = 0.5 * r * (1 + 0.1 * sin (5 * a))
       in Text.unwords (map coordinate [d * cos a, d * sin a, 2 + sin a, 18 + cos a])

-- | A part with a regular polygon of so many written corners.
polygon :: Int -> Text
polygon n =
  Text.unlines
    ( [ "part polygon",
        "machine lkp-01f",
        "tool mill(diameter 10 mm)",
        "feed 60 mm/min",
        "tolerance 0.02 mm",
        "from (" <> coordinate (r + 20) <> ", -20)",
        "contour c closed {"
      ]
        <> [corner (2 * pi * fromIntegral k / fromIntegral n) | k <- [0 .. n - 1]]
        <> ["}", "mill c outside { }"]
    )
  where
    -- Sides of 10 mm.
    r = 5 / sin (pi / fromIntegral n) :: Double
    corner a = "  (" <> coordinate (r * cos a) <> ", " <> coordinate (r * sin a) <> ")"

coordinate :: Double -> Text
coordinate = Decimal.fixed 6
