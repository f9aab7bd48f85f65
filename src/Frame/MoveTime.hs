-- | The lengths of moves in space, and the times that they take on a machine.
module Frame.MoveTime
  ( moveTime,
    pathTime,
    moveLength,
  )
where

import Base.Quantity (Feed (..), Mm (..), Seconds (..), total, travelTime)
import Base.Region (Located (..))
import Frame.FeedCode qualified as FeedCode
import Geometry.Segment qualified as Segment
import Machine.Machine (Machine)
import Part.CutFeed qualified as CutFeed
import Part.Part (Command (Dwell), Pace (..))
import Toolpath.Toolpath (Block (Commanding), Move (..), Toolpath (blocks), heights, pace)
import Toolpath.Toolpath qualified as Toolpath

-- | The time of a move at the feed of the machine; without a machine, at the feed of the program.
-- A rapid move counts as 0 s if its speed is unknown. That is the case without a machine, and if
-- the description of the machine gives none.
moveTime :: Maybe Machine -> Move -> Seconds
moveTime machine move = maybe (Seconds 0) (travelTime (moveLength move)) (feedOf (pace move))
  where
    feedOf p = case (p, machine) of
      (Rapid, Nothing) -> Nothing
      (Rapid, Just m) -> case FeedCode.rapidFeed m of
        Feed 0 -> Nothing
        feed -> Just feed
      (At (Located _ v), Nothing) -> CutFeed.perMinuteAlong (segment move) v
      (At (Located _ v), Just m) ->
        FeedCode.expectedFeed m <$> CutFeed.perMinuteAlong (segment move) v

-- | The time of all moves and dwells of a toolpath. A stop counts as 0 s.
pathTime :: Maybe Machine -> Toolpath -> Seconds
pathTime machine path =
  total
    ( map (moveTime machine) (concatMap Toolpath.moves (blocks path))
        <> [t | Commanding (Located _ (Dwell t)) <- blocks path]
    )

-- | The length of a move in space: the hypotenuse of its length in the plane and its change of
-- height.
moveLength :: Move -> Mm
moveLength move =
  let Mm l = Segment.length (segment move)
      (Mm a, Mm b) = heights move
   in Mm (sqrt (l * l + (b - a) * (b - a)))
