-- | Proof of tapes along curves: sequences of short arcs that continue one another.
module Verify.CurveSpec (spec) where

import Base.Quantity (Mm (..))
import Base.Region (Located (..), Region (Region))
import Base.Result qualified as Result
import Data.List.NonEmpty qualified as NonEmpty
import Frame.Frame (Frame (..), FrameProgram)
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as FromToolpath
import Generate qualified
import Generate.Run qualified as Curve
import Geometry.Distance qualified as Distance
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point)
import Machine.Machine (Machine)
import Machines qualified
import Part.Part (Milling)
import Part.Part qualified as Part
import Test.Hspec
import Test.QuickCheck
import Toolpath.FromPart qualified as Toolpath
import Toolpath.Toolpath (Toolpath)
import Verify.FromTape qualified as Verify
import Verify.Proof (Finding (..))
import Verify.Proof qualified as Proof

spec :: Spec
spec = do
  it
    "closed curves are proven, whatever the tolerance (catches the two sides of a band exchanged)"
    $ property $
      forAll ((,) <$> Curve.curveCase <*> accuracy) $ \(c, tolerance) ->
        punched (Generate.begin c) ((Curve.jobAlong c) {Part.tolerance = tolerance}) $
          \path program ->
            proven path program
  it
    "curves between lines and arcs are proven, and have about as many frames as the arcs that they \
    \replace (catches a run that includes its neighbours)"
    $ property $
      forAll (Generate.smoothCase >>= \c -> (c,) <$> vectorOf 60 (choose (1, 40))) $ \(c, counts) ->
        let job = (Generate.job c) {Part.tolerance = Part.OnPath (Mm 0.02)}
         in punched (Generate.begin c) job $ \_ undivided ->
              punched (Generate.begin c) (inParts counts job) $ \path program ->
                counterexample (show (frameCount undivided, frameCount program)) $
                  proven path program
                    .&&. abs (frameCount undivided - frameCount program)
                      <= length (Part.elements (Part.contour job))
  it "backwards, a curve is not followed" $
    property $
      forAll Curve.curveCase $ \c ->
        punched (Generate.begin c) (Curve.jobAlong c) $ \path program ->
          let back =
                reverse
                  [ f {increment = negate (increment f)}
                    | f <- map Frame.frame (Frame.plannedFrames program)
                  ]
           in counterexample
                (show (findings path program back))
                (not (null [() | NotFollowed _ <- findings path program back]))
  it
    "a chord that cuts across a curve by more than is allowed is refused (catches a deviation that \
    \is not measured between the ends)"
    $ property $
      forAll ((,,) <$> Curve.curveCase <*> choose (0, 1) <*> choose (2, 400)) $ \(c, from, count) ->
        punched (Generate.begin c) (Curve.jobAlong c) $ \path program ->
          let (across, distance) = shortened program from count
           in distance > 0.07
                ==> counterexample (show distance) (not (null (findings path program across)))
  it
    "a tape that leaves a curve out, or ends on it, is refused (catches a slack as long as the \
    \curve)"
    $ property $
      forAll ((,) <$> Curve.curveCase <*> choose (0.1, 0.9)) $ \(c, share) ->
        punched (Generate.begin c) (Curve.jobAlong c) $ \path program ->
          let fs = map Frame.frame (Frame.plannedFrames program)
              some = take (max 1 (floor (share * fromIntegral (length fs) :: Double))) fs
           in not (null (findings path program []))
                .&&. not (null (findings path program some))
                .&&. not (null (findings path program (drop (length some) fs)))
  where
    accuracy =
      oneof
        [ Part.OnPath . Mm <$> elements [0.005, 0.02, 0.1],
          Part.Band <$> (Mm <$> elements [0.01, 0.03]) <*> (Mm <$> elements [0.01, 0.06]),
          pure (Part.Band (Mm 0.01) (Mm 0.06))
        ]
    proven path program =
      let found =
            findings path program (map Frame.frame (Frame.plannedFrames program))
       in found === []
    findings path program fs = Proof.findings (Verify.prove lkp01f path program fs)
    frameCount = length . Frame.plannedFrames

lkp01f :: Machine
lkp01f = Machines.named "lkp-01f"

-- | Law of the toolpath and the planned frames of a milling, from a start point.
punched :: Testable p => Point -> Milling -> (Toolpath -> FrameProgram -> p) -> Property
punched begin job holds =
  case Toolpath.toToolpath (Generate.partOf begin (Part.Mill (Located (Region 0 0) job))) of
    Result.Result _ [] (Just path) -> case Result.output (FromToolpath.quantise lkp01f path) of
      Just program -> property (holds path program)
      Nothing -> counterexample "no frames" False
    r -> counterexample (show (Result.errors r)) False

-- | Milling with each arc divided into as many arcs as the list of counts says.
inParts :: [Int] -> Milling -> Milling
inParts counts job =
  job
    { Part.contour =
        (Part.contour job)
          { Part.elements =
              NonEmpty.fromList
                ( Curve.elements
                    (zipWith cut counts (NonEmpty.toList (Part.elements (Part.contour job))))
                )
          }
    }
  where
    cut n e = case Part.segment e of
      Straight _ _ -> [Part.segment e]
      Arc {} -> Curve.parts n (Part.segment e)

-- | Frames of a program with some of them replaced by one: their first one is given as a fraction
-- of all, and their count. The number is the largest distance of the new chord from the old
-- positions.
shortened :: FrameProgram -> Double -> Int -> ([Frame], Double)
shortened program from count =
  ( earlier <> [f {increment = sum (map increment (f : more))} | f : more <- [replaced]] <> later,
    maximum (0 : map distance positions)
  )
  where
    frames = map Frame.frame (Frame.plannedFrames program)
    (earlier, others) = splitAt (floor (from * fromIntegral (length frames - 1))) frames
    (replaced, later) = splitAt count others
    start = Frame.start program + sum (map increment earlier)
    positions = map (Frame.position lkp01f) (scanl (+) start (map increment replaced))
    chord =
      Straight
        (Frame.position lkp01f start)
        (Frame.position lkp01f (start + sum (map increment replaced)))
    distance p = let Mm d = Distance.toPoint p chord in d
