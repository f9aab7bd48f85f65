-- | Commands: which words a machine has for one, and in which frames they stand.
module Frame.Command
  ( Told (..),
    told,
    kept,
    released,
    Waiting (..),
    add,
    atTheEnd,
  )
where

import Base.Quantity (Mm (..), times)
import Base.Region (Located (Located), Region)
import Data.List (elemIndex, minimumBy, nub, sortOn)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Ord (comparing)
import Frame.Error (CommandKind (..), Error (..), Warning (..))
import Geometry.Carrier (Side (..))
import Machine.Machine
  ( CommandName,
    CommandValue (..),
    CommandWord (..),
    CommandWords
      ( auxiliary,
        coolantOff,
        coolantOn,
        spindleClockwise,
        spindleCounterClockwise,
        spindleOff,
        toolChange
      ),
    CompensationCommands (..),
    Content (..),
    Machine,
    Service (..),
    Word' (..),
  )
import Machine.Machine qualified as Machine
import Part.Part (Command, Sense (..), Switch (..))
import Part.Part qualified as Part

-- | What a machine makes of a command.
data Told = Told {numbers :: [(CommandName, Int)], warnings :: [Warning], errors :: [Error]}

-- | The words for a command with their numbers.
told :: Machine -> Located Command -> Told
told machine (Located region c) = case wordsFor (Machine.orders machine) c of
  [] -> case c of
    Part.Auxiliary n -> Told [] [] [NoSuchCommand region AuxiliaryCommand n 0]
    _ -> Told [] [ByHand region kind] []
  orders -> case concatMap value' orders of
    [] -> Told [] [SpeedUnsaid region] []
    ns ->
      Told
        ns
        (concatMap stepWarning orders)
        [ NoSuchCommand region kind n most
          | (o, n) <- ns,
            Just most <- [Machine.orderCapacity machine o],
            n > most
        ]
  where
    kind = kindOf c
    value' CommandWord {order, value} = map (order,) $ case value of
      Fixed n -> [n]
      Argument -> argument
      Step table -> [n | Just turns <- [speed], Just (n, _) <- [nearestStep table turns]]
      Diameter -> []
    argument = case c of
      Part.Auxiliary n -> [n]
      Part.ChangeTool n _ -> [n]
      _ -> maybe [] (pure . round) speed
    speed = case c of
      Part.SpindleOn _ turns -> turns
      Part.SpindleOff -> Nothing
      Part.CoolantTo _ -> Nothing
      Part.Auxiliary _ -> Nothing
      Part.ChangeTool _ _ -> Nothing
    stepWarning CommandWord {value} = case (value, speed) of
      (Step table, Just turns) ->
        [ SpeedDiffers region turns got
          | Just (_, got) <- [nearestStep table turns],
            isOff turns got
        ]
      (Argument, Just turns)
        | isOff turns (fromIntegral (round turns :: Int)) ->
          [SpeedDiffers region turns (fromIntegral (round turns :: Int))]
      _ -> []
    isOff turns got = abs (got - turns) > stepSlack * turns

-- | The words that tell the control to keep a cutter of this radius on a side of the contour, with
-- the diameter in their decimals. On a machine whose plane is mirrored left is right.
kept :: Machine -> Region -> Side -> Mm -> Told
kept machine asked side radius@(Mm r) = case Machine.compensation (Machine.orders machine) of
  Nothing -> Told [] [] [NoCompensation asked]
  Just c -> case numberOf (if leftHanded then keepLeft c else keepRight c) of
    Just n -> Told [n] [] []
    Nothing -> Told [] [] [DiameterBeyond asked (times 2 radius)]
  where
    leftHanded = (side == LeftOf) /= Machine.isMirrored machine
    numberOf CommandWord {order, value} = case value of
      Fixed n -> Just (order, n)
      Diameter
        | Machine.canOrder machine order n && abs (fromIntegral n / scale - 2 * r) <= pulse ->
          Just (order, n)
        | otherwise -> Nothing
        where
          n = round (2 * r * scale)
          scale = 10 ^ Machine.orderDecimals machine order
      Argument -> Nothing
      Step _ -> Nothing
    Mm pulse = Machine.pulse machine

-- | The words that tell the control to keep the cutter beside the contour no longer.
released :: Machine -> Told
released machine =
  Told
    [ (order o, n)
      | Just c <- [Machine.compensation (Machine.orders machine)],
        let o = release c,
        Fixed n <- [value o]
    ]
    []
    []

-- | A step that differs from the turns asked by more than this share is worth a warning.
stepSlack :: Double
stepSlack = 0.1

-- | The step with the nearest value; of two the lower.
nearestStep :: Map.Map Int Double -> Double -> Maybe (Int, Double)
nearestStep table turns = case Map.toList table of
  [] -> Nothing
  steps -> Just (minimumBy (comparing (\(n, v) -> (abs (v - turns), n))) steps)

wordsFor :: CommandWords -> Command -> [CommandWord]
wordsFor orders c = case c of
  Part.SpindleOn Clockwise _ -> spindleClockwise orders
  Part.SpindleOn CounterClockwise _ -> spindleCounterClockwise orders
  Part.SpindleOff -> spindleOff orders
  Part.CoolantTo SwitchOn -> coolantOn orders
  Part.CoolantTo SwitchOff -> coolantOff orders
  Part.Auxiliary _ -> auxiliary orders
  Part.ChangeTool _ _ -> toolChange orders

-- | What a command is about.
kindOf :: Command -> CommandKind
kindOf c = case c of
  Part.Auxiliary _ -> AuxiliaryCommand
  Part.SpindleOn _ _ -> SpindleCommand
  Part.SpindleOff -> SpindleCommand
  Part.CoolantTo _ -> CoolantCommand
  Part.ChangeTool _ _ -> ToolCommand

-- Where they stand --------------------------------------------------------------------------------

-- | Commands that wait for the next move: what they say, in the order of the layout's words, and
-- the place of the first.
data Waiting = Waiting {place :: Region, given :: [(CommandName, Int)]}
  deriving stock (Eq, Show)

-- | The words of a command join those that wait, if no word would be said twice; else those that
-- wait need a frame of their own, and so do the first of the command's words when it says one twice
-- itself.
add :: Machine -> Region -> [(CommandName, Int)] -> Maybe Waiting -> ([Waiting], Maybe Waiting)
add machine region orders waiting = case (parts orders, waiting) of
  ([], _) -> ([], waiting)
  ([only], Just before)
    | not (any ((`elem` map fst (given before)) . fst) only) ->
      ([], Just before {given = inOrder machine (given before <> only)})
  (several, before) ->
    (maybe [] pure before <> map alone (init several), Just (alone (last several)))
  where
    alone part = Waiting {place = region, given = inOrder machine part}
    -- Without a word twice in one.
    parts os = case os of
      [] -> []
      o : more -> case parts more of
        part : others | fst o `notElem` map fst part -> (o : part) : others
        others -> [o] : others

-- | In the order of the words of a frame, and of the bits in their service track.
inOrder :: Machine -> [(CommandName, Int)] -> [(CommandName, Int)]
inOrder machine = sortOn (\(o, _) -> elemIndex o names)
  where
    names = nub (concatMap namesOf (Machine.wordsOf machine))
    namesOf w = case content w of
      Command o -> [o]
      FrameNumber -> bits w
      Motion _ -> bits w
      Along _ -> bits w
      Centre _ -> bits w
      FeedWord -> bits w
    bits w = [o | OrderBit o _ <- Machine.service (form w)]

-- | What stands in the frames at the very end.
atTheEnd :: Machine -> [[(CommandName, Int)]]
atTheEnd machine =
  [ inOrder machine [(order o, n) | o <- NonEmpty.toList group, Fixed n <- [value o]]
    | group <- Machine.finish (Machine.orders machine)
  ]
