-- | Independence of the proof from the toolpath: 'Verify.Requirement' works out the side of the
-- cutter, its distance from the contour and the bevels of a blade from the part.
--
-- A law that demands a proven tape also tests the toolpath. If the toolpath chooses a wrong side,
-- the program still compiles, and only the proof can refuse its tape. The mutants of these laws are
-- in the toolpath.
module Verify.RequirementSpec (spec) where

import Base.Quantity (Mm (..))
import Base.Region (Located (..))
import Base.Result qualified as Result
import Compile (Analysis (..), Punched (..))
import Compile qualified
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Vector qualified as Vector
import Files (readText)
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as FromToolpath
import Generate qualified
import Machine.Machine (Machine)
import Machines (iso6983)
import Machines qualified
import Part.Part (Milling)
import Part.Part qualified as Part
import Project.LoadedProgram qualified as LoadedProgram
import Test.Hspec
import Test.QuickCheck
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.FromTape qualified as Verify
import Verify.Proof (Finding (..), Proof)
import Verify.Proof qualified as Proof
import Verify.Requirement qualified as Requirement

spec :: Spec
spec = do
  describe "the side of the cutter" $
    mapM_
      onItsSide
      [ ("outside a closed contour", "mill c outside { depth 2 }"),
        ("inside a closed contour", "mill c inside { depth 2 }"),
        ("outside a clockwise contour", "mill d outside { depth 2 }"),
        ("on the left", "mill l left { depth 2 }"),
        ("on the right", "mill l right { depth 2 }"),
        ("in a pocket", "pocket c step 4 { depth 2 }")
      ]
  describe "the side of a turning tool" $
    mapM_
      onItsSideOfAShaft
      [ ("outside", "turn shaft outside { approach (20, 20) }"),
        ("inside", "turn shaft inside { approach (20, 20) }")
      ]
  describe "the linking moves" $
    mapM_
      areThoseOfThePart
      [ ("leads on arcs", "mill c outside { depth 2  lead in arc 3  lead out arc 3 }"),
        ("plunges at their own feed", "mill c outside { depth 2  plunge 20 }"),
        ( "approaches of several passes",
          "mill c outside { depth 4 step 2  approach (60, -30), (50, -10)  retract (50, 20) }"
        ),
        ("moves of a statement", "mill c outside { depth 2 }\nmove (90, 90, 5), (-20, 90, 5)")
      ]
  it
    "the bevel of a blade is proven between elements of different length (catches a bevel that \
    \changes by the number of elements)"
    $ do
      (path', proof) <-
        proven iso6983 =<< readText "test/programs/tool/good/blade-between-two-bevels.part"
      Proof.findings proof `shouldBe` []
      map (fmap (map inDegrees . Vector.toList) . Requirement.bevels) (contoursOf path')
        `shouldBe` [Just [(0, 0), (0, 2), (2, 8), (8, 8)]]
  it
    "the distance of the cutter is that of the part (catches a proof with the distance that the \
    \toolpath gives)"
    $ property $
      forAll (Generate.closedCase `suchThat` ((> 0.4) . Generate.radiusOf)) $ \c ->
        case Generate.milled (Mm 0.02) c of
          Nothing -> discard
          Just toolpath -> case Result.output (FromToolpath.quantise lkp01f toolpath) of
            Nothing -> discard
            Just program ->
              let prove path' =
                    Proof.findings
                      ( Verify.prove
                          lkp01f
                          path'
                          program
                          (map Frame.frame (Frame.plannedFrames program))
                      )
                  withLarger m = m {Part.radius = Mm (Generate.radiusOf c + 0.2)}
                  larger = withJobs withLarger toolpath
               in prove (withReach (Mm 0) toolpath) === []
                    .&&. counterexample "a larger cutter" (any isGouge (prove larger))
  where
    onItsSide (name, statement) =
      it (name <> " is that of the part (catches a toolpath on the other side)") $ do
        (_, proof) <- proven iso6983 (millingProgram statement)
        Proof.findings proof `shouldBe` []
    areThoseOfThePart (name, statement) =
      it (name <> " are those of the part (catches a toolpath with other moves)") $ do
        (_, proof) <- proven iso6983 (millingProgram statement)
        Proof.findings proof `shouldBe` []
    onItsSideOfAShaft (name, statement) =
      it (name <> " is that of the part (catches a toolpath on the other side)") $ do
        (_, proof) <- proven lkp01f (turningProgram statement)
        Proof.findings proof `shouldBe` []
    isGouge finding = case finding of
      Gouge {} -> True
      _ -> False
    inDegrees (a, b) = (rounded a, rounded b)
    rounded angle = fromIntegral (round (angle * 180 / pi * 1000) :: Int) / (1000 :: Double)

lkp01f :: Machine
lkp01f = Machines.named "lkp-01f"

-- | Toolpath of a program and the proof of its own tape.
proven :: Machine -> Text -> IO (Toolpath, Proof)
proven machine text =
  maybe (fail "the program has errors") pure . Result.ifSound $
    Compile.analyse [] (LoadedProgram.fromText "p.part" text) `Result.thenSound` \a ->
      Compile.punch machine (path a) `Result.thenSound` \p ->
        pure (path a, proofOf (path a) (program p))
  where
    proofOf path' program' =
      Verify.prove machine path' program' (map Frame.frame (Frame.plannedFrames program'))

-- | Program whose toolpath exists on both sides of each contour: the cutter goes down where it
-- begins to cut.
millingProgram :: Text -> Text
millingProgram statement =
  Text.unlines
    [ "part p",
      "tool mill(diameter 6 mm)",
      "feed 60 mm/min",
      "tolerance 0.02 mm",
      "clearance 5 mm",
      "from (0, 0, 10)",
      "contour c closed { ccw circle((0, 0), 30) }",
      "contour d closed { cw circle((0, 0), 30) }",
      "contour l open { line((0, 0), (40, 10)) }",
      statement
    ]

turningProgram :: Text -> Text
turningProgram statement =
  Text.unlines
    [ "part p",
      "machine lkp-01f",
      "tool turn(nose 1 mm)",
      "feed 40",
      "tolerance 0.01",
      "from (20, 40)",
      "contour shaft open { line((0, 20), (-30, 20)) }",
      statement
    ]

-- | Contours of the cuts of a toolpath.
contoursOf :: Toolpath -> [Part.Contour]
contoursOf p = [Part.contour m | Toolpath.Cutting {Toolpath.job = Located _ m} <- Toolpath.blocks p]

-- | Toolpath with other statements.
withJobs :: (Milling -> Milling) -> Toolpath -> Toolpath
withJobs change p = p {Toolpath.blocks = map changed (Toolpath.blocks p)}
  where
    changed block = case block of
      Toolpath.Cutting {Toolpath.job = Located at m} -> block {Toolpath.job = Located at (change m)}
      _ -> block

-- | Toolpath that claims another distance from the contour.
withReach :: Mm -> Toolpath -> Toolpath
withReach reach p = p {Toolpath.blocks = map changed (Toolpath.blocks p)}
  where
    changed block = case block of
      Toolpath.Cutting {Toolpath.pass} ->
        block {Toolpath.pass = pass {Toolpath.reach = reach}}
      _ -> block
