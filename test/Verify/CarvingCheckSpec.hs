-- | Laws of the proof of V-carvings: the tapes of random areas are proven, and those that carve
-- deeper or less deep are refused.
module Verify.CarvingCheckSpec
  ( spec,
  )
where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (LengthUnit (Millimetres), Mm (..), Pulses (..), Rad (..), minus, plus)
import Base.Region (Located (..))
import Base.Result qualified as Result
import CaseCount (askedCount)
import Compile (Analysis (Analysis))
import Compile qualified
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Frame (Frame (..), FrameMotion (Rapid), FrameProgram, PlannedFrame (..), Role (..))
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as FromToolpath
import Geometry.Distance qualified as Distance
import Geometry.Polyarc qualified as Polyarc
import Geometry.RandomSegment qualified as RandomSegment
import Geometry.Segment (Segment)
import Machines qualified
import Numeric (showFFloat)
import Part.Part qualified as Part
import Project.LoadedProgram qualified as LoadedProgram
import Project.Target qualified as Target
import Report.Report qualified as Report
import Test.Hspec
import Test.QuickCheck
import Toolpath.Toolpath (Block (Carved, Clearing, cleared, pocket), Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.CarvingCheck qualified as CarvingCheck
import Verify.FromTape qualified as Verify
import Verify.Proof qualified as Proof

spec :: Spec
spec = do
  count <- runIO (fromMaybe 50 <$> askedCount "PARTC_CARVINGS")
  it
    "V-carvings of random areas are proven (catches a floor that is carved beside its walls only)"
    $ withMaxSuccess count $
      forAllBlind carved $ \(text, path, program) ->
        counterexample (Text.unpack text) $
          codesOf path program (map Frame.frame (Frame.plannedFrames program)) === []
  it "a disc that goes beyond an edge is not left out (catches a path that crosses a line)" $
    withMaxSuccess 5000 $
      forAll ((,,) <$> RandomSegment.segment <*> swept <*> choose (0, 5)) $ \(edge, discs, by) ->
        let (over, _) = CarvingCheck.overlap discs edge
         in counterexample (show over) (CarvingCheck.mayOverlap (over - by) discs edge)
  it "a move that carves deeper goes beyond the edge (catches a cone that is judged at its tip)" $
    withMaxSuccess count $
      forAllBlind carved $ \(text, path, program) ->
        forAll (elements (places isAlong program)) $ \n ->
          refused text path program "E0747" [(n, -deviation), (n + 1, deviation)]
  it
    "a chain that is carved less deep leaves an edge (catches edges that a smaller disc may carve)"
    $ withMaxSuccess count $
      forAllBlind carved $ \(text, path, program) ->
        forAll (elements (longChains path program)) $ \(n, up) ->
          refused text path program "E0748" [(n, deviation), (up, -deviation)]
  it
    "a move from groove to groove goes beyond the edges (catches edges that are crossed unseen)"
    $ withMaxSuccess count $
      forAllBlind twoGrooves $ \(text, (path, program), pitch) ->
        let frames = map Frame.frame (Frame.plannedFrames program)
            n = longest (places isAlong program) program
            (front, rest) = splitAt n frames
            long = frames !! n
            half = halved (increment long)
            step v = long {increment = v}
            aside x = step (Pulses3 (Pulses x) 0 0)
            altered = [step half, aside pitch, aside (-pitch), step (increment long - half)]
            found = codesOf path program (front <> altered <> drop 1 rest)
         in counterexample (Text.unpack text <> show (n, found)) ("E0747" `elem` found)
  it "a mill clears the floors and keeps off the flanks (catches a floor as wide as its region)" $
    withMaxSuccess count $
      forAllBlind floored $ \(text, path, program) ->
        counterexample (Text.unpack text) $
          conjoin
            [ codesOf path program (map Frame.frame (Frame.plannedFrames program)) === [],
              conjoin
                [ counterexample (show m) $
                    and
                      [ Distance.distance (Distance.segments (Toolpath.segment m) s) >= limit
                        | s <- edges
                      ]
                  | Clearing {pocket = Located _ p, cleared} <- Toolpath.blocks path,
                    m <- NonEmpty.toList cleared,
                    snd (Toolpath.heights m) < Mm 0,
                    (flank, edges) <- [grooveOf path],
                    let limit = minus (plus flank (Part.radius (Part.wall p))) (Mm 1e-6)
                ]
            ]
  where
    deviation = 300
    refused text path program code changes =
      let frames = raised changes (map Frame.frame (Frame.plannedFrames program))
          found = codesOf path program frames
       in counterexample (Text.unpack text <> show (changes, found)) (code `elem` found)
    isAlong f = isFeed f && (x /= 0 || y /= 0)
      where
        Pulses3 x y _ = increment (Frame.frame f)
    isDown f = isFeed f && vertical f < 0
    isUp f = not (isFeed f) && vertical f > 0
    isFeed f = motion (Frame.frame f) /= Rapid
    vertical f = case increment (Frame.frame f) of
      Pulses3 0 0 z -> z
      _ -> 0
    -- The room of the flank of the first carving of a path, and its contours.
    grooveOf path =
      case [c | Carved (Located _ c) _ _ <- Toolpath.blocks path] of
        c : _ -> (Part.carvingFlank c, concatMap edgesOf (NonEmpty.toList (Part.carvedAreas c)))
        [] -> (Mm 0, [])
    edgesOf (o, hs) =
      concatMap (NonEmpty.toList . Polyarc.segments . Part.polyarcOf) (o : hs)
    -- Frames of the carving, by their numbers from 0.
    places has program =
      [n | (n, f) <- zip [0 :: Int ..] (Frame.plannedFrames program), isCarving (role f), has f]
    isCarving r = case r of
      Carving _ -> True
      _ -> False
    -- Chains of at least 5 mm, each by the frames that go down before it and up after it. Those
    -- along which the disc only grows as fast as its centre moves carve nothing but one corner,
    -- and the sides of a nearly straight corner are also carved by others.
    longChains path program =
      [ (n, up)
        | (n, up) <- zip (places isDown program) (places isUp program),
          let chain = take (up - n) (drop n (Frame.plannedFrames program)),
          sum (map lengthOf chain) > 5000,
          sum (map (beyondGrowth path) (drop 1 chain)) > 100
      ]
    beyondGrowth path f = sqrt (fromIntegral (x * x + y * y)) - grown
      where
        Pulses3 (Pulses x) (Pulses y) (Pulses z) = increment (Frame.frame f)
        grown = abs (fromIntegral z) * growthOf path
    growthOf path =
      maximum
        [ tan a
          | Carved (Located _ c) _ _ <- Toolpath.blocks path,
            Rad a <- [Part.halfAngle c]
        ] ::
        Double
    halved (Pulses3 (Pulses x) (Pulses y) z) =
      Pulses3 (Pulses (x `div` 2)) (Pulses (y `div` 2)) z
    longest list program =
      snd (maximum [(lengthOf (Frame.plannedFrames program !! k), k) | k <- list])
    lengthOf f = let Pulses3 (Pulses x) (Pulses y) _ = increment (Frame.frame f) in abs x + abs y
    raised changes frames =
      [ f {increment = increment f + Pulses3 0 0 (Pulses (sum [z | (k, z) <- changes, k == n]))}
        | (n, f) <- zip [0 ..] frames
      ]

-- | The codes of the findings of a tape.
codesOf :: Toolpath -> FrameProgram -> [Frame] -> [Text]
codesOf path program frames =
  [ code
    | Report.Report {Report.code = Report.ReportCode code} <-
        Proof.toReports Millimetres machine (Verify.prove machine path program frames)
  ]
  where
    machine = Machines.iso6983

-- | A program that carves a random area, its toolpath and its planned frames.
carved :: Gen (Text, Toolpath, FrameProgram)
carved = carvedAnd 0 ""

-- | A program that carves a random area and clears the floors with a mill, its toolpath and its
-- planned frames.
floored :: Gen (Text, Toolpath, FrameProgram)
floored = do
  diameter <- choose (0.5, 4)
  tip <- elements [0, 0.4, 1.5]
  carvedAnd tip $
    "change 2 mill(diameter " <> number diameter <> ")\nrest of groove step "
      <> number (diameter * 0.4)
      <> " { rest allowed }\n"

-- | A program that carves a random area with a tip of some diameter in mm, and then has the given
-- statements.
carvedAnd :: Double -> Text -> Gen (Text, Toolpath, FrameProgram)
carvedAnd tip more = do
  count <- choose (3, 9)
  radii <- vectorOf count (choose (14, 40))
  hole <- elements ["", "circle((0, 0), 3)", "circle((1, 1), 2), slot((-4, -2), (4, -3), 1)"]
  rounding <- elements [0, 1, -1.5]
  angle <- elements [30, 60, 90, 120]
  deep <- choose (0.5, 9)
  let corner i r =
        let t = 2 * pi * fromIntegral (i :: Int) / fromIntegral count
         in "(" <> number (r * cos t) <> ", " <> number (r * sin t) <> ")"
      text =
        Text.unlines
          [ "part p",
            "machine iso6983",
            "tool 1 vbit(angle " <> number angle <> ", tip " <> number tip <> ", diameter 60)",
            "feed 300",
            "tolerance 0.02",
            "clearance 2",
            "from (0, 0, 2)",
            "contour star closed { " <> Text.unwords (zipWith corner [0 ..] radii) <> " }",
            "let area = offset_of(region(star), " <> number rounding <> ")",
            if Text.null hole then "" else "let holes = region([" <> hole <> "])",
            "vcarve " <> (if Text.null hole then "area" else "difference(area, holes)")
              <> " as groove { depth "
              <> number deep
              <> (if tip > 0 then " rest allowed }" else " }"),
            more
          ]
  case taped text of
    Nothing -> carvedAnd tip more
    Just (path, program) -> pure (text, path, program)

-- | A program that carves two slanted grooves side by side, its toolpath and its planned frames,
-- and the distance in pulses from one groove to the other along x.
twoGrooves :: Gen (Text, (Toolpath, FrameProgram), Int)
twoGrooves = do
  slant <- choose (-40, 40)
  width <- choose (3, 8)
  wall <- choose (0.3, 2)
  let pitch = fromIntegral (round (1000 * (width + wall)) :: Int) / 1000 :: Double
      groove name x =
        "contour " <> name <> " closed { "
          <> Text.unwords
            [ "(" <> number (x + a) <> ", " <> number b <> ")"
              | (a, b) <- [(0, 0), (width, 0), (slant + width, 40), (slant, 40)]
            ]
          <> " }"
      text =
        Text.unlines
          [ "part p",
            "machine iso6983",
            "tool 1 vbit(angle 60, tip 0, diameter 60)",
            "feed 300",
            "tolerance 0.02",
            "clearance 2",
            "from (0, 0, 2)",
            groove "a" 0,
            groove "b" pitch,
            "vcarve region([a, b]) { depth 12 }"
          ]
  maybe twoGrooves (\made -> pure (text, made, round (1000 * pitch))) (taped text)

number :: Double -> Text
number v = Text.pack (showFFloat (Just 3) v "")

-- | The toolpath and the planned frames of a text; Nothing if it has an error.
taped :: Text -> Maybe (Toolpath, FrameProgram)
taped text = do
  Analysis {Compile.path = path} <-
    Result.ifSound (Compile.analyse [] (LoadedProgram.fromText "p.part" text))
  (path,)
    <$> Result.ifSound (FromToolpath.quantise (Target.setUpFor path Machines.iso6983) path)

-- | A path with the radii of the discs at its ends.
swept :: Gen (Segment, Double, Double)
swept = (,,) <$> RandomSegment.segment <*> radius <*> radius
  where
    radius = choose (-5, 40)
