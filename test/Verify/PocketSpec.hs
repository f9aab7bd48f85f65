-- | Proof of pockets.
module Verify.PocketSpec (spec) where

import Base.Decimal qualified as Decimal
import Base.PulseVector (Pulses3 (..))
import Base.Quantity (LengthUnit (..), Mm (..), minus, plus, times)
import Base.Region (Located (..), Region (Region))
import Base.Result qualified as Result
import Compile (Analysis (path))
import Compile qualified
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Frame (Frame (increment), FrameProgram)
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
import Project.LoadedProgram qualified as LoadedProgram
import Test.Hspec
import Test.Hspec.QuickCheck (modifyMaxSuccess, prop)
import Test.QuickCheck
import Toolpath.Pocket (PocketRoom (..))
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.FromTape qualified as Verify
import Verify.Proof (Finding (..), Proof (..))
import Verify.Proof qualified as Proof

spec :: Spec
spec = modifyMaxSuccess (const 60) $ do
  prop
    "random pockets are proven, on arcs and on chords (catches a rim or a floor that is demanded \
    \where no cutter fits)"
    $ forAll ((,,) <$> Generate.pocket <*> more <*> Test.QuickCheck.elements machines) $
      \(p, first, m) ->
        forAllPath (Generate.pocketing first p) $ \path ->
          Proof.toReports Millimetres m (proofOf m path) === []
  prop
    "random pockets that ask for a direction are proven (catches a linking move that counts as a \
    \cut along a wall)"
    $ forAll ((,,) <$> Generate.pocket <*> directions <*> Test.QuickCheck.elements machines) $
      \(p, direction, m) ->
        forAllPath (towards direction (Generate.pocketing [] p)) $ \path ->
          Proof.toReports Millimetres m (proofOf m path) === []
  prop
    "a pocket that is cut in the other direction is found (catches a proof of the material alone)"
    $ forAll ((,) <$> Generate.rectangle <*> directions) $ \(p, (asked, spindle)) ->
      let other = if asked == Part.Climb then Part.Conventional else Part.Climb
       in forAllPath (towards (asked, spindle) (Generate.pocketing [] p)) $ \path ->
            forAllPath (towards (other, spindle) (Generate.pocketing [] p)) $ \wrong ->
              case (framesOf iso path, framesOf iso wrong) of
                (Just program, Just opposite) ->
                  map kind (findings (Verify.prove iso path program (framesAlone opposite)))
                    === ["direction"]
                _ -> property False
  prop
    "in a proven pocket, points that the cutter can reach lie within its radius of the motions \
    \(catches a proof of nothing)"
    $ forAll ((,) <$> Generate.pocket <*> Test.QuickCheck.elements machines) $ \(p, m) ->
      forAllPath (Generate.pocketing [] p) $ \path ->
        forAllBlind (vectorOf 200 (anywhere p)) $ \ps -> conjoin (map (swept p (cuts m path)) ps)
  prop
    "passes further apart than the cutter is wide are found (catches a floor that is not compared)"
    $ forAll (Generate.rectangle `suchThat` \p -> roomy (cutter p) p) $ \p ->
      forAllPath (Generate.pocketing [] p {step = times 3.5 (cutter p)}) $ \path ->
        map kind (findings (proofOf iso path)) === ["floor"]
  prop
    "a loop that is left out is found, on the floor or at the walls (catches motions that count \
    \where there are none)"
    $ forAll (Generate.rectangle `suchThat` \p -> roomy (times 1.6 (cutter p)) p) $ \p ->
      forAll (Test.QuickCheck.elements [0, 1]) $ \k ->
        let asked = Generate.pocketing [] p {step = times 1.6 (cutter p)}
         in forAllPath asked $ \path ->
              let short =
                    without
                      ( plus
                          (plus (cutter p) (left p))
                          (times (1.6 * fromIntegral (k :: Int)) (cutter p))
                      )
                      p
                      path
               in case (framesOf iso path, framesOf iso short) of
                    (Just program, Just fewer) ->
                      counterexample
                        (show k)
                        ( property
                            ( any
                                ((`elem` ["floor", "excess"]) . kind)
                                (findings (Verify.prove iso path program (framesAlone fewer)))
                            )
                        )
                    _ -> property False
  prop "a frame left out, doubled, or shifted is found (catches a proof by the number of frames)" $
    forAll Generate.rectangle $ \p ->
      forAllPath (Generate.pocketing [] p) $ \path -> case framesOf iso path of
        Nothing -> property False
        Just program ->
          let fs = framesAlone program
           in forAll (choose (0, length fs - 2)) $ \n ->
                let (done, rest) = splitAt n fs
                    spoilt = case rest of
                      f : next : later ->
                        [ ("left out", done <> (next : later)),
                          ("doubled", done <> (f : f : next : later))
                        ]
                          <> [ ("shifted", done <> (moved 300 f : moved (-300) next : later))
                               | isAside
                                   path
                                   ( Frame.start program
                                       + sum (map increment (done <> [moved 300 f]))
                                   )
                             ]
                      _ -> []
                 in conjoin
                      [ counterexample
                          (what <> show n)
                          (not (Proof.isProven (Verify.prove iso path program fs')))
                        | (what, fs') <- spoilt
                      ]
  prop
    "the depths of a pocket in another order are found (catches a proof of the material that is \
    \left at the end)"
    $ forAll Generate.rectangle $ \p ->
      let asked = Generate.pocketing [] p
          at zs =
            Generate.toolpathOf asked {Part.wall = (Part.wall asked) {Part.levels = map Mm zs}}
       in case (at [-1, -2], at [-2, -1]) of
            (Just path, Just other) -> case (framesOf iso path, framesOf iso other) of
              (Just program, Just reversed) ->
                filter
                  (== "order")
                  (map kind (findings (Verify.prove iso path program (framesAlone reversed))))
                  === ["order"]
              _ -> property False
            _ -> discard
  prop
    "a tape that leaves a little more at the walls of a pocket is found (catches a tolerance that \
    \grows)"
    $ forAll Generate.rectangle $ \p ->
      case ( Generate.toolpathOf (Generate.pocketing [] p),
             Generate.toolpathOf (Generate.pocketing [] p {left = plus (left p) (Mm 0.08)})
           ) of
        (Just wide, Just narrow) -> case (framesOf iso wide, framesOf iso narrow) of
          (Just program, Just other) ->
            let less = map kind (findings (Verify.prove iso wide program (framesAlone other)))
                deeper = map kind (findings (Verify.prove iso narrow other (framesAlone program)))
                hasOtherCount = length (framesAlone other) /= length (framesAlone program)
             in counterexample
                  (show (less, deeper))
                  ( "excess" `elem` less
                      && (hasOtherCount || "gouge" `elem` deeper)
                  )
          _ -> property False
        _ -> discard
  it
    "each of several pockets is compared by itself (catches motions that are taken for those of \
    \another one)"
    $ do
      let asked = three (replicate 3 right)
          wrong k what = three [if j == k then what else right | j <- [0 .. 2 :: Int]]
          found other = case (framesOf iso asked, framesOf iso other) of
            (Just program, Just others) ->
              map kind (findings (Verify.prove iso asked program (framesAlone others)))
            _ -> ["no frames"]
          foundIn text = [found (wrong k text) | k <- [0 .. 2]]
      found asked `shouldBe` []
      let exchanged = "pocket c step 3 { depth 2 }\n pocket c step 3 { depth 1 }"
      map (filter (== "order")) (foundIn exchanged)
        `shouldBe` replicate 3 ["order"]
      map
        (take 1 . filter (`elem` ["floor", "excess"]))
        (foundIn "pocket smaller step 3 { depth 2 step 1 }")
        `shouldBe` replicate 3 ["excess"]
      map (take 1 . filter (== "gouge")) (foundIn "pocket larger step 3 { depth 2 step 1 }")
        `shouldBe` replicate 3 ["gouge"]
  where
    right = "pocket c step 3 { depth 2 step 1 }"
    more = oneof [pure [], pure [Mm 0.5], pure [Mm 2, Mm 0.3]]
    anywhere p =
      let BoundingBox l b r t =
            foldr1 BoundingBox.union (fmap BoundingBox.ofSegment (walls (Generate.roomOf p)))
       in Vec.point <$> choose (l, r) <*> choose (b, t)
    -- Test that one loop at the walls does not clear the whole pocket.
    roomy d p =
      let BoundingBox l b r t =
            foldr1 BoundingBox.union (fmap BoundingBox.ofSegment (walls (Generate.roomOf p)))
       in Mm (min (r - l) (t - b))
            > plus (times 4 (cutter p)) (plus (times 2 (left p)) (times 2 (plus d (Mm 2))))
    -- Test that a position is below the top of the part and off all cuts. A frame that is shifted
    -- along its neighbour does no harm.
    isAside path at =
      Frame.height iso at < Mm 0
        && all (\s -> Distance.toPoint (Frame.position iso at) s > Mm 0.1) (cuts iso path)
    moved k f = f {increment = increment f + Pulses3 k k 0}

-- | Toolpath of three pockets side by side, each with its own statement.
three :: [Text] -> Toolpath
three pockets =
  maybe
    (error "no path")
    path
    (Result.output (Compile.analyse [] (LoadedProgram.fromText "p.part" text)))
  where
    text =
      Text.unlines
        ( [ "part p",
            "tool mill(diameter 6 mm)",
            "feed 60 mm/min",
            "tolerance 0.02 mm",
            "clearance 5 mm",
            "from (-20, -20, 5)",
            "contour c closed { ccw circle((0, 0), 10) }",
            "contour smaller closed { ccw circle((0, 0), 9.5) }",
            "contour larger closed { ccw circle((0, 0), 10.5) }"
          ]
            <> [ "with moved((" <> Decimal.whole (22 * k) <> ", 0)) {\n" <> p <> "\n}"
                 | (k, p) <- zip [0 ..] pockets
               ]
        )

machines :: [Machine]
machines = [iso, Machines.named "lkp-01f", Machines.named "n55"]

iso :: Machine
iso = Machines.named "iso6983"

-- | The directions that a pocket may ask for, with the sense of the spindle.
directions :: Gen (Part.CutSense, Part.Sense)
directions =
  (,)
    <$> Test.QuickCheck.elements [Part.Climb, Part.Conventional]
      <*> Test.QuickCheck.elements [Part.Clockwise, Part.CounterClockwise]

-- | A pocket that asks for a direction.
towards :: (Part.CutSense, Part.Sense) -> Pocketing -> Pocketing
towards (asked, spindle) p =
  p
    { Part.wall =
        (Part.wall p)
          { Part.sense = Just (Located (Region 0 0) asked),
            Part.spindleSense = spindle
          }
    }

forAllPath :: Pocketing -> (Toolpath -> Property) -> Property
forAllPath p holds = maybe discard holds (Generate.toolpathOf p)

framesOf :: Machine -> Toolpath -> Maybe FrameProgram
framesOf m path = Result.output (FromToolpath.quantise m path)

framesAlone :: FrameProgram -> [Frame]
framesAlone = map Frame.frame . Frame.plannedFrames

proofOf :: Machine -> Toolpath -> Proof
proofOf m path =
  maybe
    (error "no frames")
    (\program -> Verify.prove m path program (framesAlone program))
    (framesOf m path)

kind :: Finding -> String
kind f = case f of
  NotCleared {} -> "floor"
  Excess {} -> "excess"
  Gouge {} -> "gouge"
  NotInOrder _ -> "order"
  AgainstSense {} -> "direction"
  other -> show other

-- | Paths of the centre in all level frames below the top of the part.
cuts :: Machine -> Toolpath -> [Segment]
cuts m path = case framesOf m path of
  Nothing -> []
  Just program ->
    [ Frame.segment m at f
      | let fs = framesAlone program,
        (at, f) <- zip (scanl (+) (Frame.start program) (map increment fs)) fs,
        let Pulses3 _ _ dz = increment f,
        dz == 0,
        Frame.height m at < Mm 0
    ]

-- | Law: a point that the cutter can reach is within its radius of a path of the centre.
swept :: Pocket -> [Segment] -> Point -> Property
swept p path' q =
  counterexample
    (show q)
    (not reachable || minimum (map (Distance.toPoint q) path') <= plus (cutter p) (Mm 0.06))
  where
    room = Generate.roomOf p
    borders = concatMap NonEmpty.toList (offsetBy room (plus (cutter p) (left p)))
    reachable =
      WindingNumber.about q borders > 0
        || any (\s -> Distance.toPoint q s <= minus (cutter p) (Mm 1e-4)) borders

-- | Toolpath without the loop at a distance from the walls.
without :: Mm -> Pocket -> Toolpath -> Toolpath
without away p path = path {Toolpath.blocks = map emptied (Toolpath.blocks path)}
  where
    emptied b = case b of
      Toolpath.Clearing {Toolpath.cleared = first :| others} ->
        b {Toolpath.cleared = first :| filter (not . isThere) others}
      _ -> b
    isThere m =
      all
        (\k -> abs' (minus (fromWalls (Segment.at k (Toolpath.segment m))) away) < Mm 0.01)
        [0.1, 0.5, 0.9]
    fromWalls q = minimum (fmap (Distance.toPoint q) (walls (Generate.roomOf p)))
    abs' (Mm x) = Mm (abs x)
