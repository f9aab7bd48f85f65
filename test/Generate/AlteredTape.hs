-- | Tapes of programs with holes, pockets and contours in steps, of which moves in and out of the
-- material were altered, dropped or exchanged.
module Generate.AlteredTape
  ( program,
    altered,
    kinds,
  )
where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Mm (..), Pulses (..))
import Data.List (inits)
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Frame (Frame (..), FrameMotion (..), FrameProgram (..), PlannedFrame (..), Role (..))
import Frame.Frame qualified as Frame
import Machine.Machine (Axis (Z), Machine)
import Machine.Machine qualified as Machine
import Numeric (showFFloat)
import Test.QuickCheck

-- | A random program with holes in pecks, a pocket in steps, and a contour in steps.
program :: Text -> Gen Text
program machine = do
  r <- choose (2, 4)
  w <- choose (4, 12)
  h <- choose (4, 12)
  x <- choose (-20, 20)
  deep <- choose (3, 8)
  peck <- choose (0.3, 0.9)
  inPocket <- elements ["", " ramp 4", " helix pitch 1.5"]
  round' <-
    elements ["", " ramp 6", " helix pitch 1.5", " spiral", " tabs 3 width 4 height 1", tabbedRamp]
  statements <-
    shuffle
      [ "pocket window step " <> number r <> " { depth " <> number deep <> " step "
          <> number (deep / 2)
          <> " plunge 40"
          <> inPocket
          <> " }",
        "drill at [(" <> number (x + 60) <> ", 3), (" <> number (x + 60) <> ", 33)] depth "
          <> number deep
          <> " { peck "
          <> number (peck * deep)
          <> " }",
        "mill edge outside { start near (" <> number (x - 40) <> ", 0) approach ("
          <> number (x - 60)
          <> ", 0) depth "
          <> number deep
          <> " step "
          <> number (deep / 2)
          <> round'
          <> " }"
      ]
  count <- choose (1, 3)
  pure . Text.unlines $
    [ "part p",
      "machine " <> machine,
      "tool mill(diameter " <> number (2 * r) <> ")",
      "feed 60",
      "tolerance 0.02",
      "clearance 5",
      "from (-100, -100, 5)",
      "let window = rounded((" <> number (x - w - r) <> ", " <> number (-h - r) <> "), ("
        <> number (x + w + r)
        <> ", "
        <> number (h + r)
        <> "), "
        <> number (r + 0.5)
        <> ")",
      "let edge = rectangle((" <> number (x - 40) <> ", -40), (" <> number (x + 40) <> ", 40))"
    ]
      <> take count statements
  where
    tabbedRamp = " ramp 6 tabs 2 width 4 height 1 angle 60"
    number v = Text.pack (showFFloat (Just 3) (v :: Double) "")

-- | The names of the alterations.
kinds :: [String]
kinds = map fst alterations

-- | An altered tape of a program, with the name of the alteration. Nothing if the tape has no frame
-- for this alteration.
altered :: Machine -> FrameProgram -> Gen (Maybe (String, [Frame]))
altered machine p = do
  (kind, alter) <- elements alterations
  case alter machine (plannedFrames p) of
    [] -> pure Nothing
    tapes -> Just . (kind,) <$> elements tapes

-- | All tapes that an alteration can make of planned frames.
type Alteration = Machine -> [PlannedFrame] -> [[Frame]]

alterations :: [(String, Alteration)]
alterations =
  [ ("a descent in rapid", \m -> changing isDescent (\f -> [rapid m f])),
    ("a descent too deep, and back", \m -> changing isDescent (\f -> [deeper m f, higher m f])),
    ("a descent without its end", \m -> changing isDescent (\f -> [shorter m f])),
    ("frames there and back dropped", const thereAndBack),
    ("a pass dropped", const withoutPass),
    ("a rise dropped", const (changing isRise (const []))),
    ("two frames exchanged", const exchanged),
    ("a slope too deep, and back", \m -> changing isSlope (\f -> [deeper m f, higher m f])),
    ("a slope straight down at its end", const (changing isSlope (\f -> [flat f, sunk f]))),
    ("a slope straight up at its end", const (changing isLift (\f -> [flat f, sunk f]))),
    ("a move in rapid that was at feed", \m -> changing isCut (\f -> [rapid m f]))
  ]
  where
    isDescent p = zOf (frame p) < 0 && isVertical (frame p) && isFeed (frame p)
    isSlope p = zOf (frame p) < -lowSlope && isFeed (frame p) && isAlong (frame p)
    isLift p = zOf (frame p) > lowSlope && isFeed (frame p) && isAlong (frame p)
    -- Slopes of a few pulses may stay within the tolerance.
    lowSlope = 20
    flat f = f {increment = let Pulses3 x y _ = increment f in Pulses3 x y 0}
    sunk f = f {motion = Linear, increment = Pulses3 0 0 (zPulses f), centre = 0}
    isRise p = zOf (frame p) > 0 && isVertical (frame p)
    isCut p = case role p of
      Cutting _ -> motion (frame p) == Linear && isFeed (frame p)
      _ -> False
    deeper m f = f {increment = increment f - Pulses3 0 0 (depth m)}
    higher m f = f {increment = Pulses3 0 0 (depth m)}
    shorter m f = f {increment = Pulses3 0 0 (min 0 (zPulses f + depth m))}
    depth m = let Mm step = Machine.resolutionOf m Z in Pulses (ceiling (0.7 / step))

-- | The tapes in which one frame that has a property is replaced.
changing :: (PlannedFrame -> Bool) -> (Frame -> [Frame]) -> [PlannedFrame] -> [[Frame]]
changing has alter ps =
  [ map frame before <> alter (frame p) <> map frame after
    | (before, p : after) <- zip (inits ps) (suffixes ps),
      has p
  ]

-- | A frame as a rapid move.
rapid :: Machine -> Frame -> Frame
rapid m f
  | Machine.hasRapidMotion m = f {motion = Rapid, feedCode = Machine.FeedCode 0}
  | otherwise = f {feedCode = Machine.rapidCode m}

-- | The tapes without two or three frames that go down or up and lead back to where they begin,
-- such as a peck. Level ones end a helix or a ramp, and the passes of the pocket cut their material
-- too.
thereAndBack :: [PlannedFrame] -> [[Frame]]
thereAndBack ps =
  [ map frame (before <> after)
    | (before, rest) <- zip (inits ps) (suffixes ps),
      n <- [2, 3],
      let (some, after) = splitAt n rest,
      length some == n,
      sum (map (increment . frame) some) == 0,
      any ((/= 0) . zOf . frame) some,
      any (\p -> isFeed (frame p) && Frame.isMoving (frame p)) some,
      all (null . commands . frame) some
  ]

-- | The tapes without the frames of one pass that lead back to where they begin.
withoutPass :: [PlannedFrame] -> [[Frame]]
withoutPass ps =
  [ map frame (filter (not . isIn) ps)
    | n <- [0 .. 8],
      let isIn p = role p == Cutting n
          some = filter isIn ps,
      not (null some),
      sum (map (increment . frame) some) == 0,
      all (null . commands . frame) some
  ]

-- | The tapes with two neighbouring frames exchanged, of which one goes down or up and the other
-- one across.
exchanged :: [PlannedFrame] -> [[Frame]]
exchanged ps =
  [ map frame before <> [frame b, frame a] <> map frame after
    | (before, a : b : after) <- zip (inits ps) (suffixes ps),
      all (null . commands . frame) [a, b],
      isVertical (frame a) /= isVertical (frame b),
      zOf (frame a) /= 0 || zOf (frame b) /= 0
  ]

suffixes :: [a] -> [[a]]
suffixes list = case list of
  [] -> [[]]
  _ : rest -> list : suffixes rest

zPulses :: Frame -> Pulses
zPulses f = let Pulses3 _ _ z = increment f in z

zOf :: Frame -> Int
zOf f = let Pulses n = zPulses f in fromIntegral n

isVertical :: Frame -> Bool
isVertical f = let Pulses3 x y z = increment f in x == 0 && y == 0 && z /= 0

-- | True for a frame that moves in the plane.
isAlong :: Frame -> Bool
isAlong f = let Pulses3 x y _ = increment f in x /= 0 || y /= 0

isFeed :: Frame -> Bool
isFeed f = motion f /= Rapid && Frame.isMoving f
