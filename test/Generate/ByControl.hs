-- | Random milling jobs with cutter compensation by the control.
module Generate.ByControl
  ( cases,
    firstAndLast,
    blocksOf,
    path,
    beginning,
  )
where

import Base.Quantity (Mm (..), Rad (..))
import Base.Region (Located (..), Region (..))
import Base.Result qualified as Result
import Data.List (sort)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, listToMaybe)
import Generate (Case (..))
import Generate qualified
import Geometry.Carrier (Side (..))
import Geometry.Polyarc (segments)
import Geometry.Segment (Segment (Arc))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Offset.Equidistant qualified as Equidistant
import Part.Part (Milling, Operation (..))
import Part.Part qualified as Part
import Test.QuickCheck
import Toolpath.FromPart qualified as FromPart
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | A milling job with an approach and a retract on the free side of its contour, and the offset
-- problem of which it is made.
cases :: Gen (Case, Milling)
cases = do
  drawn <- oneof [Generate.closedCase, Generate.openCase, Generate.smoothCase]
  c <- frequency [(3, pure drawn), (1, snug drawn <$> choose (0.081, 0.2))]
  far <- choose (1.2, 9)
  angle <- choose (-0.4, 2)
  lead <- elements [Nothing, Just (Part.LeadLine, Mm 3), Just (Part.LeadArc, Mm 2)]
  out <- elements [Nothing, Just (Part.LeadLine, Mm 1), Just (Part.LeadArc, Mm 4)]
  let plain = (Generate.job c) {Part.approach = [], Part.leadIn = lead, Part.leadOut = out}
  pure $ case firstAndLast plain of
    Nothing -> (c, plain)
    Just (begin, finish) ->
      let Mm r = radius c
          free = if side c == LeftOf then -1 else 1
          -- Behind the start of the first move, rotated to the free side.
          from =
            Vec.shift
              ( Vec.scale
                  (-(far * r))
                  (Vec.rotate (Rad (free * angle)) (Segment.startDirection begin))
              )
              (Segment.start begin)
          to' =
            Vec.shift
              (Vec.scale (3 * r) (Vec.rotate (Rad (-(free * 0.5))) (Segment.endDirection finish)))
              (Segment.end finish)
       in ( c,
            plain
              { Part.approach = [stop from],
                Part.retract = [stop to'],
                Part.controlCompensation = Just nowhere
              }
          )
  where
    stop p = Part.Stop (Located nowhere p) Nothing Part.Rapid

-- | A case with a cutter that is only slightly smaller than the smallest concave arc: its radius is
-- smaller by @less@ mm. If no such cutter fits, the case is unchanged.
snug :: Case -> Double -> Case
snug c less =
  case sort
    [ old - less
      | Arc from _ centre (Rad a) <- NonEmpty.toList (segments (contour c)),
        (a > 0) == (side c == LeftOf),
        let Mm old = Segment.radius centre from,
        old > less + 0.1,
        old < 20
    ] of
    r : _
      | Right pieces <- Equidistant.equidistant (side c) (Mm r) (contour c) ->
        c {radius = Mm r, pieces}
    _ -> c

-- | The first and the last segment of the cutter's path along a contour, including the leads.
firstAndLast :: Milling -> Maybe (Segment, Segment)
firstAndLast job = case blocksOf (beginning job) job of
  Just (Toolpath.Cutting {Toolpath.approach, Toolpath.cut, Toolpath.retract} : _) ->
    let leads =
          [ Toolpath.segment m
            | m <- reverse (take 1 (reverse approach)),
              Just _ <- [Part.leadIn job]
          ]
        cuts = fmap Toolpath.segment cut
        retracting = map Toolpath.segment retract
     in Just
          ( fromMaybe (NonEmpty.head cuts) (listToMaybe leads),
            fromMaybe (NonEmpty.last cuts) (listToMaybe (reverse retracting))
          )
  _ -> Nothing

-- | The blocks of the toolpath of a milling job, from the point at which the cutter starts.
blocksOf :: Point -> Milling -> Maybe [Toolpath.Block]
blocksOf at job = Toolpath.blocks <$> path at job

-- | The toolpath of a milling job, from the point at which the cutter starts.
path :: Point -> Milling -> Maybe Toolpath
path at job = Result.output (FromPart.toToolpath (Generate.partOf at (Mill (Located nowhere job))))

-- | The point at which the contour of a milling job begins.
beginning :: Milling -> Point
beginning job = Segment.start (Part.segment (NonEmpty.head (Part.elements (Part.contour job))))

nowhere :: Region
nowhere = Region 0 0
