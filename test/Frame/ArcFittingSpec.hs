-- | The laws of curves on machines that walk arcs.
module Frame.ArcFittingSpec (spec) where

import Base.Quantity (Feed (..), Mm (..))
import Base.Region (Located (..), Region (Region))
import Base.Result qualified as Result
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Frame.ArcFitting qualified as ArcFitting
import Frame.Frame (Frame (..), Planned (frame))
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
    $ few $
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
               in keepsTo most m path program
  it
    "with centres that fit no field has frames within the tolerance and a pulse (catches chords of \
    \arcs that deviate themselves)"
    $ few $
      forAll slight $ \c ->
        forAll (elements [0, 0.005, 0.05]) $ \y ->
          onArcs "lki-fm" (Part.OnPath (Mm y)) c $ \path program ->
            keepsTo y (Machines.named "lki-fm") path program
  it
    "with centres that fit no field takes no more chords than on a machine without arcs (catches a \
    \tolerance that is reserved for fitted arcs although there are none)"
    $ few $
      forAll slight $ \c ->
        let cuts name =
              fmap (\p -> length [() | f <- Frame.planned p, Frame.role f == Frame.Cutting 0])
                . Made.program (unbraked (Machines.named name))
                =<< laid (Part.OnPath (Mm 0.05)) c
         in counterexample
              (show (cuts "lki-fm", cuts "lkp-01f"))
              (fmap Just (cuts "lki-fm") <= fmap (Just . (+ 2)) (cuts "lkp-01f"))
  it
    "keeps the machine's rules, and closes (catches arcs that are cut off at the end of their run)"
    $ few $
      forAll Run.curveCase $ \c -> onMachine (Part.OnPath (Mm 0.02)) c $ \m _ program ->
        Frame.invariants m (map frame (Frame.planned program))
          === []
            .&&. sum
              [increment (frame p) | p <- Frame.planned program, Frame.role p == Frame.Cutting 0]
          === 0
  it "becomes few arcs (catches the thousands that approximate it exactly)" $
    few $
      forAll Run.curveCase $ \c -> onArcs "lki-u" (Part.OnPath (Mm 0.1)) c $ \path program ->
        let exactly = sum [length cut | Cutting {cut} <- Toolpath.blocks path]
            made = length (Frame.planned program)
         in counterexample
              (show (exactly, made))
              (classify (exactly > 300) "many" (exactly <= 300 || 4 * made <= exactly))
  it "takes no more arcs for a larger tolerance (catches a tolerance that is ignored)" $
    few $
      forAll Run.curveCase $ \c -> case laid (Part.OnPath (Mm 0.02)) c of
        Nothing -> counterexample "no path" False
        Just path ->
          conjoin
            [ counterexample (show counts) (head counts >= last counts)
              | Cutting {cut} <- Toolpath.blocks path,
                let counts = [NonEmpty.length (ArcFitting.arcs (Mm y) cut) | y <- [0.005, 0.05]]
            ]

-- | Whether frames and path are nowhere further from each other than so much and a pulse.
keepsTo :: Double -> Machine -> Toolpath -> Frame.FrameProgram -> Property
keepsTo tolerance m path program =
  counterexample
    (show (Made.worstOff exact walk, Made.worstOff walk exact, most))
    (Made.worstOff exact walk <= most .&&. Made.worstOff walk exact <= most)
  where
    exact = concatMap (map segment . Toolpath.moves) (Toolpath.blocks path)
    walk = filter (\s -> Segment.length s > Mm 0) (Made.walked m program)
    Mm grain = Machine.pulse m
    most = tolerance + grain + 1e-6

-- | A wave whose arcs are larger than 2 m, or nearly so.
slight :: Gen Case
slight = do
  a <- choose (0.3, 3)
  l <- choose (200, 400)
  far <- choose (100, 300)
  chain <- Run.wave a l far <$> choose (20, 60)
  let contour = Polyarc Open (NonEmpty.fromList chain)
  case Equidistant.equidistant LeftOf (Mm 1) contour of
    Right pieces -> pure Case {contour, side = LeftOf, radius = Mm 1, pieces}
    Left _ -> slight

-- | Curves of many arcs take their time.
few :: Testable t => t -> Property
few = withMaxSuccess 30 . property

laid :: Part.Accuracy -> Case -> Maybe Toolpath
laid accuracy c =
  Result.output
    ( FromPart.lay
        ( Generate.partOf
            (Generate.begin c)
            ( Part.Mill
                ( Located
                    (Region 0 0)
                    (Run.jobAlong c)
                      { Part.tolerance = accuracy,
                        Part.feed = Located (Region 0 0) (Feed 100)
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
    onArcs m accuracy c (law (Machines.named m))

onArcs ::
  Testable t =>
  Text ->
  Part.Accuracy ->
  Case ->
  (Toolpath -> Frame.FrameProgram -> t) ->
  Property
onArcs m accuracy c law = case laid accuracy c of
  Nothing -> counterexample "no path" False
  Just path -> case Made.program (unbraked (Machines.named m)) path of
    Nothing ->
      counterexample
        ("no frames: " <> show (Result.errors (Made.made (Machines.named m) path)))
        False
    Just program -> property (law path program)

unbraked :: Machine -> Machine
unbraked machine =
  machine {Machine.braking = (Machine.braking machine) {Machine.brakingForm = ByControl}}
