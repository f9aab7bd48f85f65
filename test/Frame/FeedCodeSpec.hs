-- | Laws of feed codes.
module Frame.FeedCodeSpec (spec) where

import Base.PulseVector (Pulses3 (..))
import Base.Quantity (Feed (..), Pulses (..))
import Base.Region (Located (..), Region (Region))
import Base.Result qualified as Result
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Files (readText)
import Frame.Error (Error (..), Warning (..))
import Frame.FeedCode qualified as FeedCode
import Frame.Frame (Frame (..), FrameMotion (Linear), PlannedFrame (frame))
import Frame.Frame qualified as Frame
import Frame.Made qualified as Made
import Geometry.Segment (Segment (Straight))
import Geometry.Vec qualified as Vec
import Machine.Machine (Axis (..), CommandName (..), FeedCode (..), Machine)
import Machine.Machine qualified as Machine
import Machines qualified
import Part.CutFeed (CutFeed (..), SpindleRate (..))
import Part.Part (Pace (..))
import Part.Part qualified as Part
import Test.Hspec
import Test.QuickCheck
import Toolpath.Toolpath (Block (..), Toolpath (blocks))

-- | A straight frame with these increments and this feed code.
moving :: Int -> Int -> Int -> Frame
moving x y code =
  (Frame.commandFrame [])
    { motion = Linear,
      increment = Pulses3 (Pulses x) (Pulses y) 0,
      feedCode = FeedCode code
    }

spec :: Spec
spec = do
  describe "a machine whose feed codes are frequencies of the leading axis" $ do
    it
      "begins the shaft of its manual as printed (catches feeds along the path, and commands after \
      \the move)"
      $ fmap (map brief . Frame.plannedFrames) (Made.program kontur shaftPath)
        `shouldBe` Just [((0, -6000), 27, [("spindle", 10)]), ((-4200, 0), 32, [])]
    it
      "gets within a step of the feed asked for, in every direction (catches the length and the \
      \leading axis exchanged)"
      $ property $
        forAll ((,,) <$> choose (-80, 80) <*> choose (-80, 80) <*> choose (9, 500)) $ \(x, y, v) ->
          abs x + abs y
            > 1
              ==> case Made.program
                kontur
                (Made.pathAlong (At (here v)) [Straight (Vec.point 0 0) (Vec.point x y)]) of
                Nothing -> counterexample "no frames" False
                Just p ->
                  conjoin
                    [ counterexample (show (f, g)) (g > v / 1.45 && g < v * 1.45)
                      | f <- framesOf p,
                        let g = obtained f
                    ]
    -- П27 is 900 Hz and П32 is 33.4 Hz (NC course); 33.4 · 1500/3000 = 16.7.
    it
      "gives the leading axis the frequency of the code, and the others their share of it (catches \
      \the frequency of the code on every axis)"
      $ do
        FeedCode.frequencies kontur (moving 0 6000 27) `shouldBe` [(X, 0), (Y, 900), (Z, 0)]
        FeedCode.frequencies kontur (moving (-4200) 0 32) `shouldBe` [(X, 33.4), (Y, 0), (Z, 0)]
        FeedCode.frequencies kontur (moving 1500 (-3000) 32)
          `shouldBe` [(X, 16.7), (Y, 33.4), (Z, 0)]
    it
      "has no frequencies in a frame without motion, and for a code that it lacks (catches the \
      \frequency of the frame before)"
      $ map (FeedCode.frequencies kontur) [Frame.commandFrame [], moving 10 0 99]
        `shouldBe` [[], []]
    it
      "changes its codes along an arc, and gives one warning with the range obtained (catches a \
      \warning for each chord)"
      $ do
        text <- readText "test/programs/machine/good/feed-along-an-arc.part"
        let made = Made.quantised kontur (Made.pathOf text)
            codesOf p = [c | f <- framesOf p, FeedCode c <- [feedCode f]]
            ranges =
              [ (v, low < 0.9 * v, v < high)
                | FeedDiffers _ (Feed v) (Feed low) (Feed high) <- Result.warnings made
              ]
        length
          ( foldr
              (\c cs -> if c `elem` cs then cs else c : cs)
              []
              (maybe [] codesOf (Result.output made))
          )
          `shouldSatisfy` (> 1)
        ranges `shouldBe` [(53.6, True, True)]
    it
      "refuses a feed outside of its frequencies, and reports both ranges (catches the nearest \
      \code for any feed)"
      $ [ (needed, low, slow)
          | FrequencyOutOfRange _ _ needed (low, Feed slow) _ <-
              Result.errors
                ( Made.quantised
                    kontur
                    (Made.pathAlong (At (here 5)) [Straight (Vec.point 0 0) (Vec.point 10 0)])
                )
        ]
        `shouldBe` [(5 / 60 / 0.01, 10, 6)]
  describe "a machine whose feed codes are feeds along the path" $ do
    it "runs at the feed of its code (catches a feed that depends on the length of the frame)" $
      property $
        forAll (elements (map Machines.named ["lkp-01f", "lki-u", "n55"])) $ \m ->
          forAll (choose (20, 200)) $ \v ->
            case Made.program
              m
              (Made.pathAlong (At (here v)) [Straight (Vec.point 0 0) (Vec.point 300 50)]) of
              Nothing -> counterexample "no frames" False
              Just p ->
                conjoin
                  [ FeedCode.feedOf m f (FeedCode.frameLength m f)
                      === fmap Feed (Machine.valueOf m (feedCode f))
                    | f <- take 1 (framesOf p)
                  ]
    it "refuses a feed outside of its codes with one report" $
      [ (v, low, high)
        | FeedOutOfRange _ (Feed v) (Feed low) (Feed high) <-
            Result.errors
              ( Made.quantised
                  (Machines.named "lkp-01f")
                  ( Made.pathAlong
                      (At (here 300))
                      (replicate 3 (Straight (Vec.point 0 0) (Vec.point 1 0)))
                  )
              )
      ]
        `shouldBe` [(300, 15, 240)]
  describe "rapid moves" $
    it "have a motion of their own where there is one, else the code for rapid moves" $
      [ fmap
          (map (\f -> (motion f, feedCode f)) . filter Frame.isMoving . framesOf)
          ( Made.program
              (Machines.named m)
              (Made.pathAlong Rapid [Straight (Vec.point 0 0) (Vec.point 0.1 0)])
          )
        | m <- ["n55", "kontur-3p", "lkp-01f"]
      ]
        `shouldBe` map
          (Just . pure)
          [ (Frame.Rapid, FeedCode 0),
            (Frame.Linear, FeedCode 27),
            (Frame.Linear, FeedCode 9)
          ]
  where
    -- The feed in mm/min: the frequency times the pulse of 0.01 mm gives the speed of the leading
    -- axis; the speed along the path is higher.
    obtained f =
      let Pulses3 (Pulses x) (Pulses y) _ = increment f
          (dx, dy) = (fromIntegral (abs x), fromIntegral (abs y)) :: (Double, Double)
       in 60
            * fromMaybe 0 (Machine.valueOf kontur (feedCode f))
            * 0.01
            * sqrt (dx * dx + dy * dy) / max dx dy
    brief p =
      let f =
            frame p
          Pulses3 (Pulses x) (Pulses y) _ = increment f
          c = Machine.codeNumber (feedCode f)
       in ( (x, y),
            c,
            [(n, k) | (CommandName n, k) <- commands f]
          ) ::
            ((Int, Int), Int, [(Text, Int)])

framesOf :: Frame.FrameProgram -> [Frame]
framesOf = map frame . Frame.plannedFrames

here :: Double -> Located CutFeed
here = Located (Region 0 0) . PerMinute . Feed

kontur :: Machine
kontur = Machine.forTurning (Machines.named "kontur-3p")

-- | First moves of the shaft.
shaftPath :: Toolpath
shaftPath =
  toward
    { blocks =
        Commanding (Located (Region 0 0) (Part.SpindleOn Part.Clockwise (TurnsPerMinute 500))) :
        blocks toward
          <> blocks (Made.pathAlong (At (here 20)) [Straight (Vec.point 2 50) (Vec.point (-40) 50)])
    }
  where
    toward = Made.pathAlong Rapid [Straight (Vec.point 2 110) (Vec.point 2 50)]
