-- | Laws of faced regions: the path covers them, and the proof sees what it does not cover.
module Toolpath.FacePathSpec (spec) where

import Base.Quantity (LengthUnit (..), Mm (..), Rad (..), plus, times)
import Base.Region (Located (..), Region (Region))
import Base.Result qualified as Result
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Frame.Frame (FrameProgram)
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as FromToolpath
import Generate.Pocket (Pocket (..))
import Generate.Pocket qualified as Generate
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox (BoundingBox (BoundingBox))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Segment (Segment)
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Machine.Machine (Machine)
import Machines qualified
import Part.Part (Pocketing)
import Part.Part qualified as Part
import Test.Hspec
import Test.Hspec.QuickCheck (modifyMaxSuccess, prop)
import Test.QuickCheck
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.FromTape qualified as Verify
import Verify.Proof (Finding (..), Proof (..))
import Verify.Proof qualified as Proof

spec :: Spec
spec = modifyMaxSuccess (const 60) $ do
  prop "random regions that are faced are proven (catches a region that is not covered)" $
    forAll ((,,) <$> Generate.pocket <*> faced <*> elements machines) $ \(p, Blind how, m) ->
      forAllPath (how p) $ \path -> Proof.toReports Millimetres m (proofOf m path) === []
  prop "every point of a faced region is within the radius of a cut (catches lines too far apart)" $
    forAll ((,) <$> Generate.pocket <*> faced) $ \(p, Blind how) ->
      forAllPath (how p) $ \path ->
        forAllBlind (vectorOf 200 (anywhere p)) $ \ps -> conjoin (map (covered p (cuts path)) ps)
  prop "a region without one of its lines is not proven (catches a surface that is not seen)" $
    forAll ((,) <$> Generate.rectangle <*> faced) $ \(p, Blind how) ->
      forAllPath (how p {step = times 2 (cutter p)}) $ \path ->
        case (framesOf path, framesOf (withoutLongest path)) of
          (Just program, Just fewer) ->
            let Proof {findings} =
                  Verify.prove iso path program (map Frame.frame (Frame.plannedFrames fewer))
             in counterexample (show findings) (any isFloor findings)
          _ -> property False
  where
    faced = Blind <$> ways
    isFloor f = case f of
      NotCleared {} -> True
      _ -> False

-- | Ways to face the region of a pocket: with or without a milling direction, at an angle, from a
-- height on.
ways :: Gen (Pocket -> Pocketing)
ways = do
  angle <- oneof [elements [0, pi / 2], choose (-4, 4)]
  sense <- elements [Nothing, Just Part.Climb, Just Part.Conventional]
  levels <- elements [[0], [-1], [2, 1, 0], [1, -1]]
  pure $ \p ->
    let asked = Generate.pocketing [] p
     in asked
          { Part.extent = Part.Surface (Part.Facing (Vec.polar (Mm 1) (Rad angle))),
            Part.wall =
              (Part.wall asked)
                { Part.levels = map Mm levels,
                  Part.allowances = Mm 0 :| [],
                  Part.sense = Located (Region 0 0) <$> sense
                }
          }

forAllPath :: Pocketing -> (Toolpath -> Property) -> Property
forAllPath p holds = maybe discard holds (Generate.toolpathOf p)

-- | The level moves of the lowest pass at feed.
cuts :: Toolpath -> [Segment]
cuts path =
  [ Toolpath.segment m
    | Toolpath.Clearing {Toolpath.cleared, Toolpath.pass} <- Toolpath.blocks path,
      Toolpath.atHeight pass == lowest,
      m <- NonEmpty.toList cleared,
      Toolpath.heights m == (lowest, lowest)
  ]
  where
    lowest =
      minimum
        [Toolpath.atHeight pass | Toolpath.Clearing {Toolpath.pass} <- Toolpath.blocks path]

covered :: Pocket -> [Segment] -> Point -> Property
covered p path q =
  counterexample
    (show q)
    ( WindingNumber.about q (concatMap NonEmpty.toList (loops p)) == 0
        || minimum (map (Distance.toPoint q) path) <= plus (cutter p) (Mm 1e-6)
    )

anywhere :: Pocket -> Gen Point
anywhere p =
  let BoundingBox l b r t =
        foldr1
          BoundingBox.union
          (map BoundingBox.ofSegment (concatMap NonEmpty.toList (loops p)))
   in Vec.point <$> choose (l, r) <*> choose (b, t)

-- | The toolpath without a longest cut of each pass.
withoutLongest :: Toolpath -> Toolpath
withoutLongest path = path {Toolpath.blocks = map shorter (Toolpath.blocks path)}
  where
    shorter b = case b of
      Toolpath.Clearing {Toolpath.cleared} ->
        let most = maximum (fmap long (NonEmpty.filter isLevel cleared))
         in case break (\m -> isLevel m && long m >= most) (NonEmpty.toList cleared) of
              (first : front, _ : others) -> b {Toolpath.cleared = first :| front <> others}
              ([], _ : first : others) -> b {Toolpath.cleared = first :| others}
              _ -> b
      _ -> b
    isLevel m = Toolpath.pace m /= Part.Rapid && uncurry (==) (Toolpath.heights m)
    long = Segment.length . Toolpath.segment

machines :: [Machine]
machines = [iso, Machines.named "lkp-01f", Machines.named "n55"]

iso :: Machine
iso = Machines.named "iso6983"

framesOf :: Toolpath -> Maybe FrameProgram
framesOf path = Result.output (FromToolpath.quantise iso path)

proofOf :: Machine -> Toolpath -> Proof
proofOf m path =
  maybe
    (error "no frames")
    (\program -> Verify.prove m path program (map Frame.frame (Frame.plannedFrames program)))
    (Result.output (FromToolpath.quantise m path))
