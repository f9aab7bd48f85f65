-- | The section @commands@ of a description: what a frame says for each command of a program.
module Machine.CommandFromText
  ( CommandContext (..),
    commands,
    check,
  )
where

import Base.Region (Located (..))
import Base.Result (Result (..))
import Base.Result qualified as Result
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Machine.Error (CommandFault (..), Error (..))
import Machine.FeedFromText qualified as FeedFromText
import Machine.Machine
  ( CommandName (..),
    CommandValue (..),
    CommandWord (CommandWord, order),
    CommandWords (..),
    CompensationCommands (..),
    Content (..),
    Machine,
    NumberForm (..),
    Service (..),
    Word' (..),
  )
import Machine.Machine qualified as Machine
import Machine.Section
import Machine.Syntax

-- | The commands, and each of their numbers where it stands with the event that it is for.
data CommandContext = CommandContext {orders :: CommandWords, each :: [(Text, Located CommandWord)]}

commands :: Statement -> Result w Error CommandContext
commands s = do
  ((), section) <- opened ["commands { … }"] "the commands" none s
  let event word = optional word [] (eventFrom word) section
  made <-
    (,,,,,,,,)
      <$> event "spindle-clockwise"
      <*> event "spindle-counterclockwise"
      <*> event "spindle-off"
      <*> event "coolant-on"
      <*> event "coolant-off"
      <*> event "tool-change"
      <*> event "auxiliary"
      <*> optional "compensation" Nothing (fmap Just . compensationFrom) section
      <*> optional "finish" [] finishFrom section
      <* known
        [ "spindle-clockwise",
          "spindle-counterclockwise",
          "spindle-off",
          "coolant-on",
          "coolant-off",
          "tool-change",
          "auxiliary",
          "compensation",
          "finish"
        ]
        []
        section
  let (cw, ccw, off, on', off', tool', aux, comp, end) = made
      given =
        concat
          [ [ (w, o)
              | (w, os) <-
                  [ ("spindle-clockwise", cw),
                    ("spindle-counterclockwise", ccw),
                    ("spindle-off", off),
                    ("coolant-on", on'),
                    ("coolant-off", off'),
                    ("tool-change", tool'),
                    ("auxiliary", aux)
                  ],
                o <- os
            ],
            [("compensation", o) | Just (a, b, c) <- [comp], o <- [a, b, c]],
            [("finish", o) | os <- end, o <- NonEmpty.toList os]
          ]
      plainly = map value
  pure
    CommandContext
      { orders =
          CommandWords
            (plainly cw)
            (plainly ccw)
            (plainly off)
            (plainly on')
            (plainly off')
            (plainly tool')
            (plainly aux)
            ((\(a, b, c) -> CompensationCommands (value a) (value b) (value c)) <$> comp)
            (map (fmap value) end),
        each = given
      }

none :: [Argument] -> Maybe (Result w Error ())
none args = if null args then Just (pure ()) else Nothing

-- | The lines @set M 8@ of an event.
eventFrom :: Text -> Statement -> Result w Error [Located CommandWord]
eventFrom word s = do
  ((), section) <- opened [word <> " { set M 8 }"] ("‘" <> word <> "’") none s
  NonEmpty.toList <$> setsFrom section

-- | At least one number, each of another word.
setsFrom :: Section -> Result w Error (NonEmpty (Located CommandWord))
setsFrom section = do
  found <-
    traverse orderFrom (filter ((== Just "set") . keyWord) (entries section))
      <* known [] ["set"] section
  case NonEmpty.nonEmpty found of
    Nothing -> Result.failed (Missing (place section) (what section) "set" "set M 8")
    Just some -> Result.failing (twice (NonEmpty.toList some)) some
  where
    twice os =
      [ Twice r ("the number of ‘" <> n <> "’") first
        | (k, Located r o) <- zip [0 ..] os,
          let CommandName n = order o,
          Located first _ <- take 1 [p | p <- take k os, order (value p) == order o]
      ]

orderFrom :: Statement -> Result w Error (Located CommandWord)
orderFrom s = case (arguments s, block s) of
  ([name, Located _ (Word "steps")], Just ss)
    | not (broken s),
      Nothing <- formula s,
      Just n <- named name ->
      placed n . Step
        <$> FeedFromText.table Section {what = "the steps", place = told s, entries = ss}
  _ -> plain ["set M 8", "set S argument", "set D diameter", "set S steps { 1 = 63 … }"] simple s
  where
    placed n v = Located (told s) (CommandWord (CommandName n) v)
    named a = case value a of
      Word n -> Just n
      Quoted n -> Just n
      _ -> Nothing
    simple args = case args of
      [name, Located _ (Word "argument")] -> pure . (`placed` Argument) <$> named name
      [name, Located _ (Word "diameter")] -> pure . (`placed` Diameter) <$> named name
      [name, a] -> do
        n <- named name
        fmap (placed n . Fixed) <$> wholeIn "the number" 0 999999999 a
      _ -> Nothing

compensationFrom ::
  Statement ->
  Result w Error (Located CommandWord, Located CommandWord, Located CommandWord)
compensationFrom s = do
  ((), section) <-
    opened ["compensation { left { … } right { … } off { … } }"] "the compensation" none s
  (,,)
    <$> side "left" section
      <*> side "right" section
      <*> side "off" section <* known ["left", "right", "off"] [] section
  where
    side word = required word (word <> " { set D diameter }") (one word)
    one word e = do
      found <- eventFrom word e
      case found of
        [o] -> pure o
        _ -> malformed [word <> " { set D diameter }, with one number"] e

-- | The frames at the end of a program.
finishFrom :: Statement -> Result w Error [NonEmpty (Located CommandWord)]
finishFrom s = do
  ((), section) <- opened ["finish { frame { set M 2 } }"] "the end of a program" none s
  traverse frame (filter ((== Just "frame") . keyWord) (entries section))
    <* known [] ["frame"] section
  where
    frame e = opened ["frame { set M 2 }"] "this frame" none e >>= setsFrom . snd

-- | What the commands ask of the frame.
check :: Machine -> CommandContext -> [Error]
check machine given = concatMap one (each given)
  where
    names =
      [ n
        | w <- Machine.wordsOf machine,
          CommandName n <- [o | Command o <- [content w]] <> [o | OrderBit o _ <- service (form w)]
      ]
    one (event, Located r (CommandWord (CommandName n) v)) =
      case Machine.orderCapacity machine (CommandName n) of
        Nothing -> [BadCommand r (NoPlace n names)]
        Just most ->
          fits r n most v
            <> means r event v
            <> [ BadCommand r AsksNothing
                 | asksZero v,
                   not (Machine.canOrder machine (CommandName n) 0)
               ]
    asksZero v = case v of
      Fixed k -> k == 0
      Step t -> Map.member 0 t
      Argument -> False
      Diameter -> False
    fits r n most v = case v of
      Fixed k -> tooLarge r most [k] <> whole r n
      Argument -> whole r n
      Step t -> tooLarge r most (take 1 (filter (> most) (Map.keys t))) <> whole r n
      Diameter -> []
    tooLarge r most ks = [BadCommand r (TooLarge k most) | k <- ks, k > most]
    whole r n =
      [ BadCommand r InDecimals
        | w <- Machine.wordsOf machine,
          content w == Command (CommandName n),
          decimals (form w) > 0
      ]
    means r event v = case v of
      Fixed _ -> []
      Argument ->
        [ BadCommand r (NoSuchValue "argument" event)
          | event
              `notElem` [ "spindle-clockwise",
                          "spindle-counterclockwise",
                          "tool-change",
                          "auxiliary"
                        ]
        ]
      Step _ ->
        [ BadCommand r (NoSuchValue "steps" event)
          | event `notElem` ["spindle-clockwise", "spindle-counterclockwise"]
        ]
      Diameter -> [BadCommand r (NoSuchValue "diameter" event) | event /= "compensation"]
