-- | The machines, and all that is known of one.
module Cli.MachineSheet
  ( machineList,
    machineSheet,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Feed (..))
import Cli.Table (Align (..))
import Cli.Table qualified as Table
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.Machine (Fact (..), FeedCode (..), Field, Machine, MachineName (..), Mark (..), Service (..))
import Machine.Machine qualified as Machine

-- | A line for every machine.
machineList :: [Machine] -> Text
machineList ms = Table.columns [ToLeft, ToLeft] [[n, Machine.title m] | m <- ms, let MachineName n = Machine.name m]

-- | All that is known of one machine, with how it is known.
machineSheet :: Machine -> Text
machineSheet m =
  Text.unlines [n <> ": " <> Machine.title m, ""]
    <> Table.columns
      [ToLeft, ToLeft]
      [ ["tracks", Decimal.whole (Machine.tracks m)],
        ["pulse", Decimal.mm (Machine.pulse m)],
        ["digit code", Machine.codeName (Machine.code layout)],
        ["rows from a frame to the next", Decimal.whole (sum (map Machine.digits (Machine.fields layout)) + Machine.gap layout) <> ", the last " <> Decimal.whole (Machine.gap layout) <> " blank; " <> Decimal.whole (Machine.evenShift layout) <> " more before even frames"],
        ["leader and trailer", Decimal.whole (Machine.leader m) <> " blank rows each"]
      ]
    <> "\nThe rows of a frame\n\n"
    <> Table.columns [ToRight, ToLeft, ToLeft] (["row", "digit of", "service track"] : zipWith fieldRow [1 :: Int ..] (concatMap fieldRows (Machine.fields layout)))
    <> "\nThe speeds\n\n"
    <> Table.columns [ToRight, ToRight, ToLeft] (["code", "mm/min", ""] : [[Decimal.whole c, Decimal.short 2 f, if FeedCode c == Machine.rapidCode m then "rapid" else ""] | (FeedCode c, Feed f) <- NonEmpty.toList (Machine.feeds m)])
    <> "\nHow it is known\n\n"
    <> Table.columns [ToLeft, ToLeft] [[markWord mark, fact] | Fact mark fact <- Machine.facts m]
  where
    MachineName n = Machine.name m
    layout = Machine.layout m
    fieldRow k (what, service) = [Decimal.whole k, what, service]

fieldRows :: Field -> [(Text, Text)]
fieldRows f = [(Machine.contentWord (Machine.content f), serviceWord s) | s <- NonEmpty.toList (Machine.service f)]

serviceWord :: Service -> Text
serviceWord service = case service of
  MinusHole -> "minus"
  AuxiliaryBit k -> "auxiliary command, bit " <> Decimal.whole k
  Marker -> "frame marker, always a hole"
  NoHole -> "no hole"

markWord :: Mark -> Text
markWord mark = case mark of
  Sourced -> "sourced"
  Corrected -> "corrected"
  Reconstructed -> "reconstructed"
