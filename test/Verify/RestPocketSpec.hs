-- | Proof of pockets that a larger cutter clears and a smaller one finishes.
module Verify.RestPocketSpec (spec) where

import Base.Quantity (LengthUnit (..), Mm (..), minus, plus, times)
import Base.Region (Located (..), Region (Region))
import Base.Result (Result (..))
import Base.Result qualified as Result
import CaseCount (askedCount)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Frame.Frame (Frame, FrameProgram)
import Frame.Frame qualified as Frame
import Frame.FromToolpath qualified as FromToolpath
import Generate qualified
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
import Part.Part (Operation (Command), Part (..), Pocketing, SpacePoint (..))
import Part.Part qualified as Part
import System.Directory (findExecutable)
import System.Exit (ExitCode (ExitSuccess))
import System.Process (readProcessWithExitCode)
import Test.Hspec
import Test.Hspec.QuickCheck (modifyMaxSuccess, prop)
import Test.QuickCheck
import Toolpath.FromPart qualified as FromPart
import Toolpath.Pocket (PocketRoom (..))
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.FromTape qualified as Verify
import Verify.Proof (Finding (..), Proof (..))
import Verify.Proof qualified as Proof

spec :: Spec
spec = modifyMaxSuccess (const 60) $ do
  cases <- runIO (fromMaybe 18 <$> askedCount "PARTC_RESTS")
  it "a judge of the G-code finds rests cleared and regions faced (catches a proof of nothing)" $ do
    program <- findExecutable "partc" >>= maybe (fail "partc is not on the path") pure
    (code, out, _) <-
      readProcessWithExitCode
        "/usr/bin/python3"
        ["-B", "test/rests/rests.py", program, show cases, "1"]
        ""
    if code == ExitSuccess then pure () else expectationFailure out
  prop
    "random pockets with two cutters are proven (catches a rest that is demanded where none is)"
    $ forAll ((,) <$> pair <*> elements machines) $ \(two, m) ->
      forAllPath two $ \path -> Proof.toReports Millimetres m (proofOf m path) === []
  prop
    "two cutters clear all that the smaller one alone could (catches a rest that is overlooked)"
    $ forAll pair $ \two ->
      forAllPath two $ \path ->
        forAllBlind (vectorOf 200 (anywhere (small two))) $ \ps ->
          conjoin (map (swept two (cuts path)) ps)
  prop
    "the smaller cutter cuts only where the larger one has left something, or beside it (catches a \
    \second clearing of the whole pocket)"
    $ forAll pair $ \two ->
      forAllPath two $ \path -> conjoin (map (isUseful two) (chainsOf path))
  prop
    "chains along walls that are left out are found (catches a demand that is dropped)"
    $ forAll (rectangles `suchThat` (\two -> rough two > times 1.6 (cutter (small two)))) $ \two ->
      forAllPath two $ \path ->
        case (framesOf iso path, framesOf iso (withoutWalls two path)) of
          (Just program, Just fewer) ->
            counterexample
              "no finding"
              ( property
                  ( any
                      isLeft
                      (findings (Verify.prove iso path program (framesAlone fewer)))
                  )
              )
          _ -> property False
  prop
    "a cut along the walls in place of the chains is found (catches a floor that is not compared)"
    $ forAll (Generate.rectangle >>= withRough) $ \two ->
      let wide = two {rough = times 9 (cutter (small two)), roughLeft = left (small two)}
       in forAllPath wide $ \path ->
            case (framesOf iso path, framesOf iso =<< pathOf wide alongWalls) of
              (Just program, Just fewer) ->
                let found = findings (Verify.prove iso path program (framesAlone fewer))
                 in counterexample (show found) (any isFloor found)
              _ -> property False
  where
    isFloor f = case f of
      NotCleared {} -> True
      _ -> False
    isLeft f = case f of
      NotCleared {} -> True
      Excess {} -> True
      _ -> False
    pair = Generate.pocket >>= withRough
    rectangles = Generate.rectangle >>= withRough

-- | A pocket for the smaller cutter, the radius of the larger one and the allowance that it leaves.
data Two = Two {small :: Pocket, rough :: Mm, roughLeft :: Mm}
  deriving stock (Show)

withRough :: Pocket -> Gen Two
withRough p = do
  k <- choose (1.05, 3.5)
  more <- oneof [pure 0, choose (0, 1.5)]
  r <- choose (1, 4)
  step' <- choose (0.4, 2)
  let small = p {cutter = Mm r, step = Mm (r * step')}
  pure Two {small, rough = times k (Mm r), roughLeft = plus (left p) (Mm more)}

-- | The statement of the larger cutter, and that of the smaller one.
statements :: Two -> (Located Pocketing, Located Pocketing)
statements two = (Located roughAt first, Located (Region 10 11) second)
  where
    roughAt = Region 0 1
    asked = Generate.pocketing []
    first =
      asked (small two) {cutter = rough two, left = roughLeft two, step = times 0.9 (rough two)}
    second =
      (asked (small two))
        { Part.extent =
            Part.RestOfPocket
              Part.Roughing
                { Part.roughedAt = roughAt,
                  Part.roughRadius = rough two,
                  Part.roughAllowance = roughLeft two,
                  Part.roughedDownTo = Mm (-1.5)
                }
        }

-- | The toolpath of both statements; Nothing if one of the cutters has no room, or if the larger
-- one leaves nothing.
toolpathOf :: Two -> Maybe Toolpath
toolpathOf two = case pathOf two Part.Pocket of
  Just path | not (null (chainsOf path)) -> Just path
  _ -> Nothing

-- | The toolpath with another operation, made of the second statement, in place of that statement.
pathOf :: Two -> (Located Pocketing -> Operation) -> Maybe Toolpath
pathOf two make = case FromPart.toToolpath part of
  Result _ [] path -> path
  Result {} -> Nothing
  where
    (first, second) = statements two
    part =
      (Generate.partOf (Vec.point 0 0) (Part.Pocket first))
        { start = Just (here (SpacePoint (Vec.point 0 0) (Mm 20))),
          firstCutter = Just (mill (rough two)),
          operations =
            [ Part.Pocket first,
              Command (here (Part.ChangeTool 2 (mill (cutter (small two))))),
              make second
            ]
        }
    mill r = Part.Cutter Part.MillingCutter r Nothing Nothing r Part.plainBody

-- | The milling of a pocket's wall alone.
alongWalls :: Located Pocketing -> Operation
alongWalls (Located at p) = Part.Mill (Located at (Part.wall p))

here :: a -> Located a
here = Located (Region 0 0)

forAllPath :: Two -> (Toolpath -> Property) -> Property
forAllPath two holds = maybe discard holds (toolpathOf two)

-- | The cuts of the smaller cutter, without links: its level moves at feed, chain by chain.
chainsOf :: Toolpath -> [[Segment]]
chainsOf path =
  [ chain
    | Toolpath.Clearing {Toolpath.pocket = Located _ p, Toolpath.cleared} <- Toolpath.blocks path,
      Just _ <- [Part.roughing p],
      chain <- groups [] (NonEmpty.toList cleared)
  ]
  where
    groups found ms = case ms of
      [] -> [reverse found | not (null found)]
      m : more
        | uncurry (==) (Toolpath.heights m),
          Toolpath.pace m /= Part.Rapid ->
          groups (Toolpath.segment m : found) more
        | otherwise -> [reverse found | not (null found)] <> groups [] more

-- | Law: some position of a chain covers a point that the larger cutter could not reach. Judged by
-- the slow offsets of 'Generate.roomOf'.
isUseful :: Two -> [Segment] -> Property
isUseful two chain =
  counterexample (show (take 3 chain)) $
    null borders
      || maximum (map fromCleared chain) > minus (rough two) (cutter (small two))
  where
    borders =
      concatMap
        NonEmpty.toList
        (offsetBy (Generate.roomOf (small two)) (plus (rough two) (roughLeft two)))
    fromCleared s =
      maximum [minimum (map (Distance.toPoint (Segment.at k s)) borders) | k <- [0, 0.1 .. 1]]

anywhere :: Pocket -> Gen Point
anywhere p =
  let BoundingBox l b r t =
        foldr1 BoundingBox.union (fmap BoundingBox.ofSegment (walls (Generate.roomOf p)))
   in Vec.point <$> choose (l, r) <*> choose (b, t)

-- | Law: a point that the smaller cutter can reach is within a radius of a cut of one of the two.
-- Each cut comes with its radius.
swept :: Two -> [(Mm, Segment)] -> Point -> Property
swept two cuts' q =
  counterexample
    (show q)
    (not reachable || or [Distance.toPoint q s <= plus r (Mm 0.02) | (r, s) <- cuts'])
  where
    p = small two
    room = Generate.roomOf p
    borders = concatMap NonEmpty.toList (offsetBy room (plus (cutter p) (left p)))
    reachable =
      WindingNumber.about q borders > 0
        || any (\s -> Distance.toPoint q s <= minus (cutter p) (Mm 1e-4)) borders

-- | The level moves of a toolpath below the top of the part, each with the radius of its cutter.
cuts :: Toolpath -> [(Mm, Segment)]
cuts path =
  [ (Part.radius (Part.wall p), Toolpath.segment move)
    | Toolpath.Clearing {Toolpath.pocket = Located _ p, Toolpath.cleared} <- Toolpath.blocks path,
      move <- NonEmpty.toList cleared,
      snd (Toolpath.heights move) < Mm 0,
      uncurry (==) (Toolpath.heights move)
  ]

-- | The toolpath without the moves of the smaller cutter along the walls.
withoutWalls :: Two -> Toolpath -> Toolpath
withoutWalls two = withoutMoves (isAtWalls two)

-- | Tells if a move follows the walls at the distance of the smaller cutter.
isAtWalls :: Two -> Toolpath.Move -> Bool
isAtWalls two m = all (\k -> off (Segment.at k (Toolpath.segment m)) < 0.01) [0.1, 0.5, 0.9]
  where
    off q =
      let Mm d = minus (fromWalls q) (plus (cutter (small two)) (left (small two))) in abs d
    fromWalls q = minimum (fmap (Distance.toPoint q) (walls (Generate.roomOf (small two))))

-- | The toolpath without some moves of the smaller cutter.
withoutMoves :: (Toolpath.Move -> Bool) -> Toolpath -> Toolpath
withoutMoves isLeftOut path = path {Toolpath.blocks = map emptied (Toolpath.blocks path)}
  where
    emptied b = case b of
      Toolpath.Clearing {Toolpath.pocket = Located _ p, Toolpath.cleared = first :| others}
        | Just _ <- Part.roughing p ->
          b {Toolpath.cleared = first :| filter (not . isLeftOut) others}
      _ -> b

machines :: [Machine]
machines = [iso, Machines.named "lkp-01f", Machines.named "n55"]

iso :: Machine
iso = Machines.named "iso6983"

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
