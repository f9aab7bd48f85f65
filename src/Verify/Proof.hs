-- | What the comparison of a tape with the part has shown.
module Verify.Proof
  ( Proof (..),
    Passage (..),
    Witness (..),
    Finding (..),
    isProven,
    toReports,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name)
import Base.Quantity (Feed (..), Mm (..), Pulses (..))
import Base.Region (Located, Region)
import Data.Text qualified as Text
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Linear.V3 (V3 (..))
import Machine.Machine (FeedCode (..), Machine)
import Machine.Machine qualified as Machine
import Report.Report (Place (..), Report (label, message), report)
import Report.Report qualified as Report

-- | A deviation of so much, in a frame, at an element of the part; where the point of the part or the
-- cutter's centre is.
data Witness = Witness {amount :: Mm, frame :: Int, element :: Region, place :: Point}
  deriving stock (Eq, Show)

-- | How one milled contour came out. A gouge or excess of less than nothing has no witness.
data Passage = Passage
  { contour :: Located Name,
    -- | the deepest cut into the part
    gouge :: Maybe Witness,
    -- | the most material left standing
    excess :: Maybe Witness,
    -- | tolerance and one pulse, into the material and out of it
    allowedGouge :: Mm,
    allowedExcess :: Mm
  }
  deriving stock (Eq, Show)

data Proof = Proof
  { frames :: Int,
    passages :: [Passage],
    -- | the last position less the one where the tape should end
    closure :: V3 Pulses,
    -- | the largest increment of each axis, whatever its sign
    largest :: V3 Pulses,
    -- | the first frame that is not as the program's own
    firstDifference :: Maybe Int,
    -- | in the order of the tape; none when the tape is proven
    findings :: [Finding]
  }
  deriving stock (Eq, Show)

-- | Why a tape is wrong.
data Finding
  = -- | the first frame that cuts too deep, the worst one, what is allowed
    Gouge Witness Witness Mm
  | -- | the first frame that leaves too much, the worst one, what is allowed
    Excess Witness Witness Mm
  | -- | the cutter runs along an element on its wrong side
    WrongSide Int Region
  | -- | the beginning of the contour is never reached
    NeverBegun Region
  | -- | the contour is not followed in order from its beginning to its end
    NotFollowed Region
  | -- | a frame that leaves the plane of the part
    OffPlane Int
  | -- | a hole that the tape does not drill to its depth
    HoleMissing Region Point
  | -- | a frame that goes below the top of the part where, or deeper than, the program does not: where
    CutsElsewhere Int Point
  | -- | the frame, the code on the tape, the code that belongs there, what asks for it
    WrongFeed Int FeedCode FeedCode Region
  | -- | the frame, the auxiliary command on the tape, the one that belongs there
    WrongCommand Int Int Int
  | NotClosed (V3 Pulses)
  deriving stock (Eq, Show)

isProven :: Proof -> Bool
isProven = null . findings

-- | The words for all findings.
toReports :: Machine -> Proof -> [Report]
toReports machine proof = map (withDifference . toReport machine) (findings proof)
  where
    withDifference r = r {message = message r <> difference}
    difference = case firstDifference proof of
      Just n -> ["The first frame that differs from this program's own is frame " <> Decimal.whole n <> "."]
      Nothing -> []

toReport :: Machine -> Finding -> Report
toReport machine finding = case finding of
  Gouge first worst allowed ->
    (wrong "E0701" (InSource (element first)) (frameWord (frame first) <> " cuts " <> micro (amount first) <> " into the part"))
      { label = "into this element",
        message =
          ["The cutter's centre is then at " <> Vec.written 3 (place first) <> ". Allowed is a gouge of " <> micro allowed <> ", the tolerance and one pulse."]
            <> ["The deepest gouge is " <> micro (amount worst) <> ", in frame " <> Decimal.whole (frame worst) <> "." | frame worst /= frame first]
      }
  Excess w worst allowed ->
    (wrong "E0702" (InSource (element w)) (frameWord (frame w) <> " leaves " <> micro (amount w) <> " of material standing"))
      { label = "at this element",
        message =
          ["It is worst at " <> Vec.written 3 (place w) <> ". Allowed is an excess of " <> micro allowed <> ", the tolerance and one pulse."]
            <> ["The most that is left is " <> micro (amount worst) <> ", in frame " <> Decimal.whole (frame worst) <> "." | frame worst /= frame w]
      }
  WrongSide n region -> wrong "E0703" (InSource region) (frameWord n <> " runs along this element on its wrong side")
  NeverBegun region -> wrong "E0704" (InSource region) "the tape never reaches the beginning of this contour"
  NotFollowed region -> wrong "E0709" (InSource region) "the tape does not follow this contour from its beginning to its end in the direction of the walk"
  OffPlane n -> wrong "E0705" InFile (frameWord n <> " leaves the plane of the part (it moves z)")
  HoleMissing region p -> wrong "E0710" (InSource region) ("the tape drills no hole of the right depth at " <> Vec.written 3 p)
  CutsElsewhere n p ->
    (wrong "E0711" InFile (frameWord n <> " goes into the material where the program does not, or deeper"))
      { message = ["The cutter's centre is then at " <> Vec.written 3 p <> "."]
      }
  WrongFeed n found wanted region ->
    (wrong "E0706" (InSource region) (frameWord n <> " runs at a wrong feed: speed " <> code found))
      { message = ["Here belongs speed " <> code wanted <> "."]
      }
  WrongCommand n found wanted ->
    (wrong "E0708" InFile (frameWord n <> " gives the auxiliary command " <> Decimal.whole found))
      { message = [if wanted == 0 then "The program commands nothing there." else "The program commands " <> Decimal.whole wanted <> " there."]
      }
  NotClosed (V3 x y z) ->
    wrong "E0707" InFile ("the tape does not end where it should: it misses by " <> Text.intercalate ", " [pulses d <> " in " <> axis | (axis, d) <- [("x", x), ("y", y), ("z", z)], d /= 0])
  where
    wrong = report Report.Error
    frameWord n = "frame " <> Decimal.whole n
    micro (Mm x) = Decimal.fixed 4 x <> " mm"
    pulses (Pulses n) = Decimal.whole n <> (if abs n == 1 then " pulse" else " pulses")
    code c@(FeedCode n) = Decimal.whole n <> maybe "" (\(Feed f) -> " (" <> Decimal.short 2 f <> " mm/min)") (Machine.feedOf machine c)
