-- | Laws of curves on machines with circular interpolation.
module Frame.ArcFittingSpec (spec) where

import Base.Quantity (Feed (..), Mm (..))
import Base.Region (Located (..), Region (Region))
import Base.Result qualified as Result
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Frame.ArcFitting qualified as ArcFitting
import Frame.Frame (Frame (..), PlannedFrame (frame))
import Frame.Frame qualified as Frame
import Frame.Made qualified as Made
import Generate (Case (..))
import Generate qualified
import Generate.Run qualified as Run
import Geometry.Carrier (Side (..))
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Segment qualified as Segment
import Machine.Machine (BrakingForm (..), Machine)
import Machine.Machine qualified as Machine
import Machines qualified
import Offset.Equidistant qualified as Equidistant
import Part.CutFeed (CutFeed (..))
import Part.Part qualified as Part
import Test.Hspec
import Test.QuickCheck
import Toolpath.FromPart qualified as FromPart
import Toolpath.Toolpath (Block (..), Move (..), Toolpath)
import Toolpath.Toolpath qualified as Toolpath

spec :: Spec
spec = describe "a curve" $ do
  it
    "has frames within the tolerance and a pulse, along all of it (catches arcs beside the curve)"
    $ thirtyTimes $
      forAll Run.curveCase $ \c ->
        forAll
          ( elements
              [ Part.OnPath (Mm 0.02),
                Part.OnPath (Mm 0.1),
                Part.Band (Mm 0.02) (Mm 0.1),
                Part.Band (Mm 0) (Mm 0.05)
              ]
          )
          $ \accuracy ->
            onMachine accuracy c $ \m path program ->
              let most = case accuracy of
                    Part.OnPath (Mm y) -> y
                    Part.Band (Mm a) (Mm b) -> min a b
               in staysWithin most m path program
  it
    "with centres that fit no field has frames within the tolerance and a pulse (catches chords of \
    \arcs that deviate themselves)"
    $ thirtyTimes $
      forAll nearlyStraight $ \c ->
        forAll (elements [0, 0.005, 0.05]) $ \y ->
          onMachineNamed "lki-fm" (Part.OnPath (Mm y)) c $ \path program ->
            staysWithin y (Machines.named "lki-fm") path program
  it
    "with centres that fit no field takes no more chords than on a machine without arcs (catches a \
    \tolerance that is reserved for fitted arcs although there are none)"
    $ thirtyTimes $
      forAll nearlyStraight $ \c ->
        let cuts name =
              fmap (\p -> length [() | f <- Frame.plannedFrames p, Frame.role f == Frame.Cutting 0])
                . Made.program (withoutBraking (Machines.named name))
                =<< toolpathOf (Part.OnPath (Mm 0.05)) c
         in counterexample
              (show (cuts "lki-fm", cuts "lkp-01f"))
              (fmap Just (cuts "lki-fm") <= fmap (Just . (+ 2)) (cuts "lkp-01f"))
  it
    "keeps the machine's rules, and ends where it begins (catches arcs cut off at the end of a run)"
    $ thirtyTimes $
      forAll Run.curveCase $ \c -> onMachine (Part.OnPath (Mm 0.02)) c $ \m _ program ->
        Frame.violations m (map frame (Frame.plannedFrames program))
          === []
            .&&. sum
              [ increment (frame p)
                | p <- Frame.plannedFrames program,
                  Frame.role p == Frame.Cutting 0
              ]
          === 0
  it "becomes few arcs (catches the thousands that approximate it exactly)" $
    thirtyTimes $
      forAll Run.curveCase $ \c ->
        onMachineNamed "lki-u" (Part.OnPath (Mm 0.1)) c $ \path program ->
          let exactly = sum [length cut | Cutting {cut} <- Toolpath.blocks path]
              made = length (Frame.plannedFrames program)
           in counterexample
                (show (exactly, made))
                (classify (exactly > 300) "many" (exactly <= 300 || 4 * made <= exactly))
  it "takes no more arcs for a larger tolerance (catches a tolerance that is ignored)" $
    thirtyTimes $
      forAll Run.curveCase $ \c -> case toolpathOf (Part.OnPath (Mm 0.02)) c of
        Nothing -> counterexample "no path" False
        Just path ->
          conjoin
            [ counterexample (show counts) (head counts >= last counts)
              | Cutting {cut} <- Toolpath.blocks path,
                let counts = [NonEmpty.length (ArcFitting.arcs (Mm y) cut) | y <- [0.005, 0.05]]
            ]

-- | The law that frames and toolpath are nowhere further apart than the tolerance and a pulse.
staysWithin :: Double -> Machine -> Toolpath -> Frame.FrameProgram -> Property
staysWithin tolerance m path program =
  counterexample
    (show (Made.largestDistance exact actual, Made.largestDistance actual exact, most))
    (Made.largestDistance exact actual <= most .&&. Made.largestDistance actual exact <= most)
  where
    exact = concatMap (map segment . Toolpath.moves) (Toolpath.blocks path)
    actual = filter (\s -> Segment.length s > Mm 0) (Made.frameSegments m program)
    Mm pulse = Machine.planeResolution m
    most = tolerance + pulse + 1e-6

-- | Wave of arcs with radii of about 2 m and more.
nearlyStraight :: Gen Case
nearlyStraight = do
  a <- choose (0.3, 3)
  l <- choose (200, 400)
  far <- choose (100, 300)
  chain <- Run.wave a l far <$> choose (20, 60)
  let contour = Polyarc Open (NonEmpty.fromList chain)
  case Equidistant.equidistant LeftOf (Mm 1) contour of
    Right pieces -> pure Case {contour, side = LeftOf, radius = Mm 1, pieces}
    Left _ -> nearlyStraight

-- | Law with few cases, because curves of many arcs take long.
thirtyTimes :: Testable t => t -> Property
thirtyTimes = withMaxSuccess 30 . property

toolpathOf :: Part.Accuracy -> Case -> Maybe Toolpath
toolpathOf accuracy c =
  Result.output
    ( FromPart.toToolpath
        ( Generate.partOf
            (Generate.begin c)
            ( Part.Mill
                ( Located
                    (Region 0 0)
                    (Run.jobAlong c)
                      { Part.tolerance = accuracy,
                        Part.feed = Located (Region 0 0) (PerMinute (Feed 100))
                      }
                )
            )
        )
    )

onMachine ::
  Testable t =>
  Part.Accuracy ->
  Case ->
  (Machine -> Toolpath -> Frame.FrameProgram -> t) ->
  Property
onMachine accuracy c law =
  forAll (elements ["lki-fm", "lki-u", "lki-un", "n55", "iso6983"]) $ \m ->
    onMachineNamed m accuracy c (law (Machines.named m))

onMachineNamed ::
  Testable t =>
  Text ->
  Part.Accuracy ->
  Case ->
  (Toolpath -> Frame.FrameProgram -> t) ->
  Property
onMachineNamed m accuracy c law = case toolpathOf accuracy c of
  Nothing -> counterexample "no path" False
  Just path -> case Made.program (withoutBraking (Machines.named m)) path of
    Nothing ->
      counterexample
        ("no frames: " <> show (Result.errors (Made.quantised (Machines.named m) path)))
        False
    Just program -> property (law path program)

withoutBraking :: Machine -> Machine
withoutBraking machine =
  machine {Machine.braking = (Machine.braking machine) {Machine.brakingForm = ByControl}}
