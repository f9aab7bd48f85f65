-- | The law of cutter compensation by the control: from its input, a control makes the moves of the
-- toolpath.
--
-- The model of the control follows LinuxCNC move by move. It shares no code with the computation of
-- offsets.
module Toolpath.CompensationSpec (spec) where

import Base.Quantity (Mm (..), Rad (..))
import Base.Region (Located (..), Region (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)
import Generate (Case (..))
import Generate.ByControl (beginning, blocksOf, cases, firstAndLast)
import Geometry.Carrier (Sense (..), Side (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Milling)
import Part.Part qualified as Part
import Test.Hspec hiding (before)
import Test.QuickCheck
import Toolpath.Toolpath (Sent)
import Toolpath.Toolpath qualified as Toolpath

spec :: Spec
spec =
  describe "a control" $ do
    it
      "makes the moves of the toolpath from the edge that it receives (catches an edge that does \
      \not begin on the tangent from the approach, a lead of the wrong radius, a last outer corner \
      \without its arc)"
      $ property $
        forAll cases $ \(c, job) -> case sentOf job of
          Nothing -> property Discard
          Just _ | turnsIn c -> property Discard
          Just (r, sent, moves) ->
            let made =
                  unbroken
                    ( map Toolpath.segment (Toolpath.before sent)
                        <> control r sent
                        <> map Toolpath.segment (Toolpath.behind sent)
                    )
                proven = unbroken (map Toolpath.segment moves)
             in counterexample
                  (show (made, proven, side c))
                  (length made === length proven .&&. conjoin (zipWith same made proven))
    it
      "gets a straight approach that is longer than the cutter's radius (catches an approach that \
      \is measured too long)"
      $ property $
        forAll ((,) <$> cases <*> choose (0.1, 3)) $ \((_, job), share) ->
          case sentOf (nearer share job) of
            Nothing -> property Discard
            Just (r, sent, _) ->
              let Mm l =
                    Segment.length (Toolpath.segment (Toolpath.entry sent))
               in counterexample (show (l, r)) (l > r)

-- | Two segments agree at four of their points.
same :: Segment -> Segment -> Property
same a b =
  conjoin
    [ let Mm d =
            Vec.distance (Segment.at t a) (Segment.at t b)
       in counterexample (show (t, a, b)) (d < 1e-5)
      | t <- [0, 0.3, 0.7, 1]
    ]

-- The control

-- | The moves of the cutter's centre that a control makes from its input, from the entry to the
-- exit. The number is the cutter's radius in mm.
control :: Double -> Sent -> [Segment]
control r sent = onto : go entered (NonEmpty.toList edges)
  where
    left = if Toolpath.side sent == LeftOf then 1 else -1
    edges = fmap Toolpath.segment (Toolpath.edge sent)
    entry = Toolpath.segment (Toolpath.entry sent)
    first = NonEmpty.head edges
    entered =
      meeting
        (beside (Segment.startDirection entry) (Segment.end entry))
        (Segment.startDirection entry)
        (beside (Segment.startDirection first) (Segment.start first))
        (Segment.startDirection first)
    onto = Straight (Segment.start entry) entered
    beside d p = Vec.shift (Vec.scale (left * r) (Vec.left d)) p
    go at es = case es of
      [] -> [Straight at (Segment.end (Toolpath.segment (Toolpath.exit sent)))]
      e : rest ->
        let finish = beside (Segment.endDirection e) (Segment.end e)
            along = case e of
              Straight _ _ -> Straight at finish
              Arc {centre, sweep} -> Arc {Segment.start = at, Segment.end = finish, centre, sweep}
         in along : case rest of
              next : _
                | Rad t <- Vec.signedAngle (Segment.endDirection e) (Segment.startDirection next),
                  abs t > 1e-6 ->
                  let out = beside (Segment.startDirection next) (Segment.start next)
                   in Segment.arc
                        (if left > 0 then Clockwise else CounterClockwise)
                        (Segment.end e)
                        finish
                        out :
                      go out rest
              _ -> go finish rest

-- | True when the contour has a slight corner towards the cutter. There a control moves straight
-- on, while the toolpath goes to the intersection of the offsets. The two differ by less than
-- 'Offset.Tolerance.slightRest'.
turnsIn :: Case -> Bool
turnsIn c =
  or
    [ t * left > 1e-7
      | (_, a, b) <- Polyarc.neighbours (contour c),
        let Rad t = Vec.signedAngle (Segment.endDirection a) (Segment.startDirection b)
    ]
  where
    left = if side c == LeftOf then 1 else -1

-- | The intersection of two lines, each given by a point and a direction.
meeting :: Point -> Vec.Vec -> Point -> Vec.Vec -> Point
meeting p u q v = Vec.shift (Vec.scale (Vec.cross (Vec.to p q) v / Vec.cross u v) u) p

-- | Removes moves of length 0 and merges consecutive collinear lines.
unbroken :: [Segment] -> [Segment]
unbroken = foldr join [] . filter long
  where
    long s = let Mm l = Segment.length s in l > 1e-6
    join s rest = case (s, rest) of
      (Straight a b, Straight _ c : more)
        | Rad t <- Vec.signedAngle (Vec.to a b) (Vec.to b c),
          abs t < 1e-6 ->
          Straight a c : more
      _ -> s : rest

-- Milling statements

-- | Moves the start of a statement's approach to a distance of @share@ radii from the first point
-- of the toolpath.
nearer :: Double -> Milling -> Milling
nearer share job =
  case ( firstAndLast
           job {Part.controlCompensation = Nothing, Part.approach = [], Part.retract = []},
         Part.approach job
       ) of
    (Just (begin, _), [s]) ->
      let Mm r = Part.radius job
          p = Segment.start begin
          v = Vec.unit (Vec.to p (value (Part.place s)))
       in job
            { Part.approach =
                [ s
                    { Part.place =
                        Located
                          nowhere
                          (Vec.shift (Vec.scale (share * r) v) p)
                    }
                ]
            }
    _ -> job

-- | The cutter's radius in mm, the control's input, and the moves of the toolpath. Nothing if the
-- compiler refuses the statement because a control would refuse the input.
sentOf :: Milling -> Maybe (Double, Sent, [Toolpath.Move])
sentOf job =
  case blocksOf
    (maybe (beginning job) (value . Part.place) (listToMaybe (Part.approach job)))
    job of
    Just [b@Toolpath.Cutting {Toolpath.sent = Just s}] ->
      let Mm r =
            Part.radius job
       in Just (r, s, Toolpath.moves b)
    _ -> Nothing

nowhere :: Region
nowhere = Region 0 0
