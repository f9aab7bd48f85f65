-- | Law of works on the wall or the rim of a milled hole: where their tools may cut, and how deep.
module Verify.RimWorkSpec
  ( spec,
  )
where

import Base.Quantity (Mm (..))
import Base.Region (Region (Region))
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.Made qualified as Made
import Geometry.Carrier (Circle (Circle), Sense (..), Side (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Part.Part (Element (Element))
import Part.Part qualified as Part
import Test.Hspec
import Test.QuickCheck
import Toolpath.Toolpath (Toolpath)
import Verify.Gouge (KeepOut (required))
import Verify.Motion qualified as Motion
import Verify.RimWork qualified as RimWork

spec :: Spec
spec =
  it
    "a tool cuts into the walls of its own work only, and no deeper than this work (catches a stud \
    \that is taken for the wall of a hole)"
    $ property $
      forAll (elements works) $ \work ->
        forAll arc $ \(Wall radius sense side isBeside) ->
          let tool = toolRadius work
              facesAxis = (sense == CounterClockwise) == (side == LeftOf)
              depth = depthIn work radius
              mayCut = not isBeside && facesAxis == isInside work
              Mm found = kept work radius sense side isBeside
              wanted = if mayCut then tool - depth else tool
           in checkCoverage $
                cover 5 (mayCut && depth > 0) "cuts" $
                  cover 5 (not mayCut && depth > 0) "must not cut" $
                    counterexample (show (found, wanted)) (abs (found - wanted) < 1e-9)

-- | A work on a cylinder about (0, 0).
data Work = Work
  { written :: Text,
    -- | radius of the tool in mm
    toolRadius :: Double,
    isInside :: Bool,
    -- | depth in mm below the wall of a cylinder, by its radius
    depthIn :: Double -> Double
  }

instance Show Work where
  show = Text.unpack . written

works :: [Work]
works =
  [ Work (at "tap(diameter 20)" "tap" "pitch 1.5 depth 10") 10 True (upTo coarse . (10 -)),
    Work (at "drill(diameter 20)" "ream" "depth 10") 10 True (upTo 2 . (10 -)),
    Work
      (at "drill(diameter 24, angle 90 deg)" "countersink" "angle 90 diameter 20")
      10
      True
      (max 0 . (10 -)),
    Work
      (at threadmill "thread" "diameter 20 pitch 1.5 depth 5 inside")
      2
      True
      (upTo coarse . (10 -)),
    Work
      (at threadmill "thread" "diameter 17 pitch 1.5 depth 5 outside")
      2
      False
      (\r -> upTo coarse (r - (8.5 - coarse)))
  ]
  where
    at tool word rest =
      Text.unlines
        [ "part p",
          "machine linuxcnc-mill",
          "tool 1 " <> tool,
          "feed 60 mm/min",
          "tolerance 0.02 mm",
          "clearance 3 mm",
          "from (0, 0, 3)",
          "spindle cw 400 rpm",
          word <> " at (0, 0) " <> rest
        ]
    threadmill = "threadmill(diameter 4, pitch 1.5)"
    -- Depth of an outside thread with the pitch 1.5 mm (ISO 68-1).
    coarse = 17 / 24 * 1.5 * sqrt 3 / 2
    upTo most d = if d > 0 && d <= most + 1e-6 then d else 0

-- | An arc of a contour: its radius, its sense, the side on which its cutter moves, and whether its
-- centre is beside the axis of the work.
data Wall = Wall Double Sense Side Bool
  deriving stock (Show)

arc :: Gen Wall
arc =
  Wall <$> elements [7, 7.25 .. 13] <*> elements [Clockwise, CounterClockwise]
    <*> elements [LeftOf, RightOf]
    <*> frequency [(1, pure True), (4, pure False)]

-- | Distance that the tool of a work keeps from a circle while it is on the axis.
kept :: Work -> Double -> Sense -> Side -> Bool -> Mm
kept work r sense side isBeside =
  required (RimWork.keepOut (worksIn motion) (Just side) (Mm (toolRadius work))) element origin
  where
    origin = Vec.point 0 0
    centre = Vec.point (if isBeside then 0.5 else 0) 0
    motion = (Motion.ofNoLength origin (Mm 3)) {Motion.toHeight = Mm (-2)}
    worksIn = RimWork.rimWorks path (const [0])
    path :: Toolpath
    path = Made.pathOf (written work)
    element =
      Element
        ( Segment.fullCircle
            sense
            (Circle centre (Mm r))
            (Vec.shift (Vec.vec r 0) centre)
        )
        (Region 0 0)
        Part.plainFinish
        False
        False
        Nothing
        Nothing
