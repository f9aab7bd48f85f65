{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Tables of machines: the list of all, and the data of one.
module Cli.MachineTable
  ( machineList,
    machineDetails,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Feed (..), Pulses (..), degrees)
import Cli.ControllerTable (controllerRows)
import Cli.Table (Align (..))
import Cli.Table qualified as Table
import Data.Bits (testBit)
import Data.List (nub)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (maybeToList)
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.Machine

-- | The list of machines: one line for each, with its name and its title.
machineList :: [Machine] -> Text
machineList ms = Table.columns [ToLeft, ToLeft] [[n, title m] | m <- ms, let MachineName n = name m]

-- | The data of one machine: tape, code, axes, frames, feeds, braking, commands, and the
-- provenance of each value (sourced, corrected or reconstructed).
machineDetails :: Machine -> Text
machineDetails m =
  n
    <> ": "
    <> title m
    <> "\n"
    <> Text.concat
      [ "\n" <> heading <> "\n\n" <> Table.columns aligns rows
        | (heading, aligns, rows) <- tables,
          not (null rows)
      ]
  where
    MachineName n = name m
    tables =
      [ ("The tape", [ToLeft, ToLeft], tapeRows m),
        ( "The code " <> codeName (code m),
          if hasCheck m then [ToLeft, ToRight, ToLeft] else [ToLeft, ToLeft],
          codeRows m
        ),
        ("The axes", [ToLeft, ToRight, ToRight, ToLeft], axisRows m),
        if isGrid m
          then ("The rows of a frame", [ToRight, ToLeft, ToLeft], gridRows m)
          else ("The words of a frame", [ToLeft, ToLeft, ToLeft, ToLeft, ToLeft], wordRows m),
        ("The kinds of motion", [ToRight, ToLeft], motionRows m),
        (feedHeading m, [ToRight, ToRight, ToLeft], feedRows m),
        ("Slowing down", [ToLeft, ToLeft], brakingRows m),
        ("The commands", [ToLeft, ToLeft], commandRows m),
        ("The controller", [ToLeft, ToLeft], maybe [] controllerRows (controller m)),
        ( "How it is known",
          [ToLeft, ToLeft],
          [[markWord mark, fact] | DescribedValue mark fact <- describedValues m]
        )
      ]

-- The tape ----------------------------------------------------------------------------------------

tapeRows :: Machine -> [[Text]]
tapeRows m =
  [ ["tracks", Decimal.whole (tracks t)],
    ["from row to row", maybe "a text, not punched" Decimal.mm (pitch t)],
    ["width", maybe "-" Decimal.mm (width t)]
  ]
    <> [["punch", "at most " <> Decimal.exact r <> " rows a minute"] | Just r <- [punchRate t]]
    <> [ ["name of the file", "ends with ." <> suffix t],
         ["leader and trailer", blanks (leader t) <> " each"],
         [ "behind a frame",
           blanks (gap t)
             <> if evenShift t == 0
               then ""
               else "; before an even frame " <> Decimal.whole (evenShift t) <> " more"
         ],
         ["further blank rows", case spare t of Counted -> "none"; Skipped -> "passed over"]
       ]
    <> [["before the first frame", quoted (opening t)] | opening t /= ""]
    <> [["behind the last frame", quoted (closing t)] | closing t /= ""]
    <> [ ["limit", "at most " <> Decimal.whole k <> " contours"]
         | Just k <- [mostContours (limits m)]
       ]
  where
    t = medium m
    blanks k = Decimal.whole k <> " blank row" <> (if k == 1 then "" else "s")

-- | The table of the symbols that frames use. A row has a symbol and its tracks as binary digits,
-- the highest track first; 1 is a hole. If frames have a check digit, the row also has the weight
-- with which the symbol counts in the check sum.
codeRows :: Machine -> [[Text]]
codeRows m =
  line "symbol" "weight" ("tracks " <> Text.concat (map Decimal.whole tracksDown)) :
  [ line
      (quoted (Text.singleton c))
      (Decimal.whole (Map.findWithDefault 0 c (weights (code m))))
      ("       " <> holes row)
    | (c, row) <- Map.toList here
  ]
    <> [ line
           "others"
           ""
           ( Decimal.whole (Map.size (symbols (code m)) - Map.size here)
               <> " more that frames do not need"
           )
         | Map.size here < Map.size (symbols (code m))
       ]
    <> [ line "" "" ("track " <> Decimal.whole k <> " makes the number of holes even")
         | Just k <- [evenTrack (code m)]
       ]
    <> [ line "" "" ("track " <> Decimal.whole k <> " holds signs and marks")
         | Just k <- [serviceTrack (code m)]
       ]
    <> [line "" "" ("       " <> holes row <> " is passed over") | row <- skips (code m)]
  where
    line a b c = if hasCheck m then [a, b, c] else [a, c]
    here = Map.filterWithKey (\c _ -> c `elem` used) (symbols (code m))
    tracksDown = reverse [1 .. tracks (medium m)]
    holes row = Text.pack [if testBit row (k - 1) then '1' else '0' | k <- tracksDown]
    used =
      nub
        ( ['0' .. '9']
            <> "+-."
            <> concatMap symbolsOf (NonEmpty.toList (items (layout m)))
            <> Text.unpack (separator (layout m) <> opening (medium m) <> closing (medium m))
        )
    symbolsOf item = case item of
      Literal t -> Text.unpack t
      AWord w -> Text.unpack (address w)
      CheckDigit _ -> []

-- | True if the frames of a machine have a check digit. It makes the sum of the weights of a
-- frame's symbols a multiple of a given number.
hasCheck :: Machine -> Bool
hasCheck m = or [True | CheckDigit _ <- NonEmpty.toList (items (layout m))]

-- The axes ----------------------------------------------------------------------------------------

axisRows :: Machine -> [[Text]]
axisRows m =
  ["axis", "pulse", "largest number", ""] :
  [ [ contentName (Along (axis a)),
      Decimal.mm (resolution a),
      let Pulses k = capacity m (axis a) in Decimal.whole k,
      remarks a
    ]
    | a <- NonEmpty.toList (axes m)
  ]
    <> [ [ contentName (About (rotaryAxis a)),
           Decimal.short 9 (degrees (pulseAngle a)) <> " deg",
           let Pulses k = turnCapacity m (rotaryAxis a) in Decimal.whole k,
           if turnsReversed a then against else ""
         ]
         | a <- rotaryAxes m
       ]
    <> [["arcs", arcText, "", ""]]
  where
    remarks a =
      Text.intercalate
        "; "
        ( [against | reversed a]
            <> ["on a lathe the other way" | reversedOnLathe a]
            <> ["not known to be moved" | not (isDriven a)]
        )
    against = "points against that of the part"
    arcText = case arcs m of
      NoArcs -> "none"
      Arcs {quadrants, fullCircle, rising} ->
        (if quadrants then "within a quadrant" else "any")
          <> (if fullCircle then ", full circles too" else "")
          <> (if rising then ", helices too" else "")

-- The frame ---------------------------------------------------------------------------------------

-- | True if all frames of a machine have the same count of rows and each row has a fixed meaning.
-- Other machines have frames of words with addresses.
isGrid :: Machine -> Bool
isGrid m = all fixed (NonEmpty.toList (items (layout m)))
  where
    fixed item = case item of
      Literal _ -> True
      CheckDigit _ -> True
      AWord w ->
        address w == ""
          && presence w == Always
          && padded (form w)
          && sign (form w) `elem` [Unsigned, ServiceSign]

-- | The table of a frame with fixed rows, see 'isGrid'. For each row of the frame it has the row's
-- number, counted from 1; the row's content; and the meaning of a hole in the service track. The
-- content is the quantity of which the row is one digit, or a fixed symbol, or the check digit.
-- The service track is for minus signs, bits of commands and other signals that are no digits.
gridRows :: Machine -> [[Text]]
gridRows m =
  ["row", "digit of", "service track"] :
  zipWith
    (:)
    (map Decimal.whole [1 :: Int ..])
    (concatMap rowsOf (NonEmpty.toList (items (layout m))))
  where
    rowsOf item = case item of
      Literal t -> [[quoted (Text.singleton c), ""] | c <- Text.unpack t]
      CheckDigit k -> [["check: the sum is a multiple of " <> Decimal.whole k, ""]]
      AWord w ->
        [ [contentName (content w), s]
          | s <-
              map serviceWord (service (form w))
                <> replicate (digits (form w) - length (service (form w))) ""
        ]

-- | The table of a frame with words. The row of a word has its address, the quantity that it
-- contains, the count of its digits, the form of its sign, and the frames in which it occurs.
-- Other rows are for fixed symbols, the check digit, and the symbols between words. The last row
-- says how the words give the motion of an axis.
wordRows :: Machine -> [[Text]]
wordRows m =
  ["address", "holds", "digits", "sign", "stands"] :
  map row (NonEmpty.toList (items (layout m)))
    <> [["between words", quoted (separator (layout m)), "", "", ""] | separator (layout m) /= ""]
    <> [["", measured, "", "", ""]]
  where
    measured = case measure (layout m) of
      Increments -> "axes are told by increments"
      Positions -> "axes are told by positions"
    row item = case item of
      Literal t -> [quoted t, "", "", "", "always"]
      CheckDigit k -> ["", "check: the sum is a multiple of " <> Decimal.whole k, "1", "", "always"]
      AWord w ->
        [ if address w == "" then "" else quoted (address w),
          contentName (content w),
          digitText (form w),
          signText (sign (form w)) <> servicesText (service (form w)),
          presenceText (presence w)
        ]
    digitText f =
      (if padded f then "" else "at most ")
        <> Decimal.whole (digits f)
        <> ( if decimals f == 0
               then ""
               else ", " <> Decimal.whole (decimals f) <> " behind the point"
           )
    servicesText ss =
      if all (== NoHole) ss then "" else "holes: " <> Text.intercalate ", " (map serviceWord ss)

-- | The table of motion codes: each number that frames use, with the kind of motion that it means.
motionRows :: Machine -> [[Text]]
motionRows m =
  concat
    [ [ [Decimal.whole k, kind]
        | (Just k, kind) <-
            [ (rapid c, "rapid"),
              (Just (straight c), "straight"),
              (clockwise c, "arc clockwise"),
              (counterClockwise c, "arc counter-clockwise")
            ]
      ]
      | w <- wordsOf m,
        Motion c <- [content w]
    ]

signText :: Sign -> Text
signText s = case s of
  Unsigned -> ""
  ServiceSign -> "in the service track; "
  MinusSign -> "minus below zero"
  EitherSign -> "plus or minus"
  Priority a b c d ->
    "leading + "
      <> Decimal.whole a
      <> ", leading - "
      <> Decimal.whole b
      <> ", following + "
      <> Decimal.whole c
      <> ", following - "
      <> Decimal.whole d

presenceText :: Presence -> Text
presenceText p = case p of
  Always -> "always"
  InMotion -> "in moves"
  WhenNeeded -> "when needed"
  WhenChanged -> "when it changes"

serviceWord :: Service -> Text
serviceWord s = case s of
  MinusHole -> "minus"
  CommandBit (CommandName n) k -> "command " <> n <> ", bit " <> Decimal.whole k
  Marker -> "frame marker, always a hole"
  BrakingHole -> "the frame slows down"
  NoHole -> "no hole"

-- Feeds, braking, commands ------------------------------------------------------------------------

feedHeading :: Machine -> Text
feedHeading m = case rule (feeds m) of
  NotAbove -> "The feeds; taken is the highest that does not exceed the one asked"
  Nearest -> "The feeds; taken is the one nearest to that asked"

feedRows :: Machine -> [[Text]]
feedRows m = ["code", unit, ""] : listed
  where
    f = feeds m
    unit = case feedMeasure f of
      AlongPath -> "mm/min"
      LeadingAxis -> "Hz of the leading axis"
    listed = case codes f of
      Direct a b -> [[Decimal.whole a <> " to " <> Decimal.whole b, "the code itself", ""]]
      Listed t ->
        abbreviated
          [ [ Decimal.whole c,
              Decimal.short 2 v,
              if not (hasRapidMotion m) && FeedCode c == rapidCode m then "rapid" else ""
            ]
            | (FeedCode c, v) <- Map.toList t
          ]

-- | Shortens a table of three columns that has more than 13 rows. It keeps the first ten rows and
-- the last two, with a row of dots between them.
abbreviated :: [[Text]] -> [[Text]]
abbreviated rows
  | length rows <= longest + 1 = rows
  | otherwise = take (longest - 2) rows <> [["…", "…", ""]] <> drop (length rows - 2) rows
  where
    longest = 12

brakingRows :: Machine -> [[Text]]
brakingRows m =
  [ ["deceleration", Decimal.short 3 (deceleration (braking m)) <> " mm/s²"],
    [ "done",
      case brakingForm (braking m) of
        ByControl -> "by the control itself"
        SlowFrames -> "where the program says so, in a frame at the lowest feed"
        BrakedFrames (Feed v) ->
          "in frames with a hole of their own; at the end down to "
            <> Decimal.short 3 v
            <> " mm/min"
    ]
  ]

commandRows :: Machine -> [[Text]]
commandRows m =
  [ [event, Text.intercalate ", " (map commandText os)]
    | (event, os) <-
        [ ("spindle clockwise", spindleClockwise o),
          ("spindle counter-clockwise", spindleCounterClockwise o),
          ("cutting speed clockwise", surfaceClockwise o),
          ("cutting speed counter-clockwise", surfaceCounterClockwise o),
          ("spindle off", spindleOff o),
          ("coolant on", coolantOn o),
          ("coolant off", coolantOff o),
          ("tool change", toolChange o),
          ("auxiliary", auxiliary o),
          ("stop", programStop o),
          ("optional stop", optionalStop o),
          ("dwell", dwell o)
        ]
          <> concat
            [ [ ("cutter left", [compensateLeft c]),
                ("cutter right", [compensateRight c]),
                ("cutter on the contour", [cancelCompensation c]),
                ("switch of the cutter's radius", maybeToList (radiusSwitch c))
              ]
              | Just c <- [compensation o]
            ]
          <> [("at the end", NonEmpty.toList f) | f <- finish o],
      not (null os)
  ]
  where
    o = commandWords m

commandText :: CommandWord -> Text
commandText (CommandWord (CommandName n) v) = n <> " " <> valueText v

valueText :: CommandValue -> Text
valueText v = case v of
  Fixed k -> Decimal.whole k
  Argument -> "the number given"
  Step t -> "the step of " <> stepText t
  Diameter -> "the cutter's diameter"
  InSeconds -> "the seconds given"
  InMilliseconds -> "the milliseconds of the seconds given"
  SurfaceSpeed step -> "the cutting speed in " <> (if step == 1000 then "m/min" else "ft/min")
  SpeedLimit -> "the limit in turns a minute"

stepText :: Map Int Double -> Text
stepText t = case (Map.lookupMin t, Map.lookupMax t) of
  (Just (a, v), Just (b, w)) ->
    Decimal.whole a
      <> " to "
      <> Decimal.whole b
      <> ", "
      <> Decimal.short 1 v
      <> " to "
      <> Decimal.short 1 w
      <> " turns a minute"
  _ -> "none"

markWord :: Provenance -> Text
markWord mark = case mark of
  Sourced -> "sourced"
  Corrected -> "corrected"
  Reconstructed -> "reconstructed"

-- | Tape symbols between quotation marks; a line feed is shown as @\\n@.
quoted :: Text -> Text
quoted t = "‘" <> Text.replace "\n" "\\n" t <> "’"
