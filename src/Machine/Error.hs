{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | The mistakes of machine descriptions, and their reports.
module Machine.Error
  ( Error (..),
    AxisKind (..),
    HoleFault (..),
    ServiceFault (..),
    FrameFault (..),
    TableFault (..),
    CommandFault (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name qualified as Name
import Base.Quantity (Mm (..), Rad)
import Base.Quantity qualified as Quantity
import Base.Region (Region)
import Data.List qualified as List
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.ControllerError (ControllerFault)
import Machine.ControllerError qualified as ControllerError
import Machine.DecodingError (DecodingFault (..))
import Machine.DecodingError qualified as DecodingError
import Report.Fix (Fix)
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), at, quote)

-- | A mistake in a description, with its region.
data Error
  = -- | unexpected token: the token found, and the kind of token expected
    Unexpected Region Text Text
  | -- | opening brace without a closing one
    Unclosed Region
  | -- | closing brace without an opening one
    Unopened Region
  | -- | block nested more deeply than this limit
    TooDeep Region Int
  | -- | unknown key: the key as written, the name of the section, and the keys that it allows
    UnknownKey Region Text Text [Text]
  | -- | repeated entry: its name, and the region of the first entry
    Twice Region Text Region
  | -- | missing key: the name of the section, the key, and an example
    Missing Region Text Text Text
  | -- | malformed statement: its key, and the forms that it may have
    Malformed Region Text [Text]
  | -- | pulse with the unit of the other kind of axes: the name of the axis
    WrongUnit Region AxisKind Text
  | -- | value without a mark of provenance, the count of further such values in the section, and
    -- the offsets at which all these values end
    Unmarked Region Int [Int]
  | -- | number out of range: the name of the number, the lowest and the highest value
    OutOfRange Region Text Text Text
  | -- | mistake in the holes of a row
    BadHoles Region HoleFault
  | -- | characters that the code lacks: the name of the part that needs them, and the characters
    NotInCode Region Text [Char]
  | -- | frames that cannot be decoded uniquely
    NotDecodable Region DecodingFault
  | -- | mistake in the holes beside the digits of a word
    BadService Region ServiceFault
  | -- | conflict between the words of the frame and the machine
    BadFrame Region FrameFault
  | -- | mistake in a table of codes
    BadTable Region TableFault
  | -- | mistake in the numbers of a command
    BadCommand Region CommandFault
  | -- | conflict between the controller and the other sections
    BadController Region ControllerFault
  deriving stock (Eq, Ord, Show)

-- | Kind of an axis, which decides the unit of its pulse.
data AxisKind = LinearAxis | TurningAxis
  deriving stock (Eq, Ord, Show)

-- | Mistake in the holes of a row.
data HoleFault
  = -- | pattern of holes with a digit other than 0 and 1, or with too many or too few digits. The
    -- arguments are the largest and the least count of digits that a pattern may have.
    WrongWidth Int Int
  | -- | hole in the parity track, which has this number
    InParityTrack Int
  | -- | digit, sign or point with a hole in the service track, which has this number
    InServiceTrack Int
  | -- | same holes as another symbol: that symbol and its region
    SameHoles Text Region
  | -- | row that a tape reader skips, although it is the row of this symbol
    SkippedSymbol Text
  | -- | one track for both service and parity
    SharedTrack
  | -- | fewer than the seven tracks that ASCII needs
    TooFewTracks
  deriving stock (Eq, Ord, Show)

-- | Mistake in the holes beside the digits of a word.
data ServiceFault
  = -- | holes, although the code has no service track
    NoTrack
  | -- | count of holes that differs from the count of digits: these two counts, in this order
    WrongCount Int Int
  | -- | holes beside the digits of a number without fixed length
    AnyLength
  | -- | two holes with the same meaning: the name of the meaning
    SameMeaning Text
  | -- | gap in the bits of a command, since a bit below the highest one is missing: the name of the
    -- command
    BitGap Text
  | -- | bits of a command in a word that not every frame contains: the name of the command
    OptionalBits Text
  | -- | no hole that marks braking, although the machine brakes in frames with such a hole
    NoBrakingHole
  deriving stock (Eq, Ord, Show)

-- | Conflict between the words of the frame and the machine.
data FrameFault
  = -- | word for an axis that the machine lacks
    NoSuchAxis Text
  | -- | two words with the same content: its name, and the region of the first word
    TwoWords Text Region
  | -- | missing word: the name of its content
    NoWord Text
  | -- | form that does not suit the content: the name of the content, and the reason
    Unsuited Text Text
  | -- | pulse that is not one unit of the last decimal of its axis's word: the count of decimals,
    -- and the pulse
    PulseNotDecimal Int Mm
  | -- | the same for a rotary axis, with the angle of its pulse
    AngleNotDecimal Int Rad
  | -- | code of a motion that has too many digits for its word, or is used twice
    BadMotion Int
  | -- | centre word along the axis with this name, which is z or a rotary axis
    CentreAlong Text
  | -- | modulus for which some sums have no check digit
    NoCheckDigit Int
  | -- | word of an axis without a sign
    NoSign Text
  | -- | braking to a feed in mm/min, although the values of the codes are in pulses per second
    BrakedFrequencies
  deriving stock (Eq, Ord, Show)

-- | Mistake in a table, or in the codes of feeds.
data TableFault
  = EmptyTable
  | -- | value for this code that is not between 0 and 10^9
    NoValue Int
  | -- | code that does not fit the feed word, and the largest code that does
    CodeTooLarge Int Int
  | -- | code that the table lacks
    NoSuchCode Int
  | -- | range of codes that is reversed or too long, or that begins below 1 in a line @direct@: its
    -- first and its last number
    BadRange Int Int
  | -- | feed at the end of braking that is outside the machine's feeds; the numbers are the lowest
    -- and the highest feed of the machine, in mm/min
    NoSuchFeed Double Double
  deriving stock (Eq, Ord, Show)

-- | Mistake in a line of the section @commands@, such as @set M 8@. The line gives the number 8 to
-- the word or the bits @M@ at one event. An event has a key, such as @coolant-on@.
data CommandFault
  = -- | name for which the frame has neither a word nor bits, and the names that it has
    UnknownCommandName Text [Text]
  | -- | number that does not fit the word or the bits, and the largest number that does
    NumberTooLarge Int Int
  | -- | kind of value that the event does not allow: the name of the kind, the key of the event
    NoSuchValue Text Text
  | -- | whole number in a word with decimals
    InDecimals
  | -- | the number 0 in a word that is 0 if no command is given
    ZeroIsNoCommand
  deriving stock (Eq, Ord, Show)

-- | Converts an error to its report.
toReport :: Error -> Report
toReport err = case err of
  Unexpected region found expected ->
    (at region "E1001" ("found " <> found <> ", expected " <> expected))
      { label = "here",
        hints =
          [ "A line is a key, its arguments, perhaps a mark, perhaps a block in braces: pitch 2.54 \
            \mm reconstructed"
          ]
      }
  Unclosed region ->
    (at region "E1001" "the brace is not closed")
      { label = "opened here",
        hints = ["A block ends with } on a line of its own."]
      }
  Unopened region ->
    (at region "E1001" "a closing brace without an opening one")
      { hints =
          ["Is the { missing at the end of the line that begins the block?"]
      }
  TooDeep region limit ->
    at region "E1001" ("blocks are nested more than " <> Decimal.whole limit <> " deep")
  UnknownKey region key section known ->
    (at region "E1002" (quote key <> " is no key of " <> section))
      { message = ["The keys of " <> section <> " are " <> Text.intercalate ", " known <> "."],
        fixes = nearestFixes region key known,
        hints =
          ["Write one of them, or leave the line out." | null (nearestFixes region key known)]
      }
  Twice region what first ->
    (at region "E1003" (what <> " is given twice"))
      { others = [Label first "first given here"],
        hints = ["Keep the one that is true."]
      }
  Missing region section key form ->
    (at region "E1004" (quote key <> " is missing in " <> section))
      { hints = ["Write, for example: " <> form]
      }
  Malformed region key forms ->
    (at region "E1005" ("the values of " <> quote key <> " are wrong"))
      { hints = ["It is written: " <> Text.intercalate ", or: " forms]
      }
  WrongUnit region kind axis -> unitReport region kind axis
  Unmarked region more ends ->
    ( at
        region
        "E1006"
        ( "nothing says how this is known"
            <> (if more == 0 then "" else ", nor " <> Decimal.whole more <> " more of this section")
        )
    )
      { message =
          [ "Every value of a machine carries a mark: sourced (printed in a document), \
            \corrected (printed there, but the print contradicts itself) or reconstructed (chosen, \
            \because no document says it)."
          ],
        hints =
          [ "Write the mark after it, and where it is printed: sourced \"manual, page 12\"",
            "A mark before a block, or on the line of the machine, holds for all within that have \
            \none."
          ],
        fixes =
          [ Fix.proposed . Fix.joined "Mark what no document says: reconstructed." $
              [Fix.insertion "" at' " reconstructed" | at' <- ends]
          ]
      }
  OutOfRange region what low high ->
    (at region "E1007" (what <> " cannot be this number"))
      { message = ["It lies between " <> low <> " and " <> high <> "."],
        fixes =
          [ Fix.proposed (Fix.exchange ("Write the " <> which <> ": " <> limit <> ".") region limit)
            | (which, limit) <- [("least", low), ("largest", high)]
          ]
      }
  BadHoles region fault -> holeReport region fault
  NotInCode region what chars ->
    (at region "E1009" (what <> " needs " <> listed chars <> ", which the code lacks"))
      { hints =
          [ "Add the row of each to the symbols of the code: \""
              <> Text.take 1 (Text.pack chars)
              <> "\" = 00101"
          ]
      }
  NotDecodable region fault -> DecodingError.toReport region fault
  BadService region fault -> serviceReport region fault
  BadFrame region fault -> frameReport region fault
  BadTable region fault -> tableReport region fault
  BadCommand region fault -> commandReport region fault
  BadController region fault -> ControllerError.toReport region fault
  where
    listed cs =
      Text.intercalate ", " (map (quote . Text.pack . unquoted . show) (take 12 cs))
        <> (if length cs > 12 then " …" else "")
    -- Turns @s@, the output of 'show' for a character, into the text of the report. A line feed
    -- becomes @\n@. An apostrophe, a backslash and every other ASCII control character stay as
    -- 'show' writes them. All remaining characters become themselves.
    unquoted s = case s of
      "'\\n'" -> "\\n"
      ['\'', c, '\''] -> [c]
      '\'' : '\\' : number | [(n, "'")] <- reads number -> [toEnum n]
      _ -> s

-- | Report about a pulse with a wrong unit.
unitReport :: Region -> AxisKind -> Text -> Report
unitReport region kind axis = case kind of
  LinearAxis ->
    (wrong ("the pulse of " <> axis <> " is a length in mm, and not in this unit"))
      { message = ["The axes x, y and z move along a line; only a and b turn."],
        hints = ["Write the pulse in mm: 10 µm are 0.01 mm."]
      }
  TurningAxis ->
    (wrong ("the pulse of " <> axis <> " is an angle in deg, and not in this unit"))
      { message = ["The axes a and b turn; only x, y and z move along a line."],
        hints = ["Write the pulse in deg: 3.6 seconds of arc are 0.001 deg."]
      }
  where
    wrong = at region "E1005"

holeReport :: Region -> HoleFault -> Report
holeReport region fault = case fault of
  WrongWidth tracks least ->
    (at region "E1008" "a row of other tracks than the tape's")
      { hints =
          [ "A pattern has a digit for each track, the highest first, 1 for a hole: "
              <> (if least < tracks then Decimal.whole least <> " or " else "")
              <> Decimal.whole tracks
              <> " digits."
          ]
      }
  InParityTrack track ->
    (at region "E1008" "a hole in the track of the parity")
      { hints = ["Track " <> Decimal.whole track <> " gets its holes by itself: leave 0 there."]
      }
  InServiceTrack track ->
    (at region "E1008" "a symbol of numbers has a hole in the service track")
      { hints =
          [ "What a hole in track "
              <> Decimal.whole track
              <> " means at a digit, the words of the frame say: leave 0 there."
          ]
      }
  SameHoles other first ->
    (at region "E1008" ("these are the holes of " <> quote other))
      { others = [Label first "the other symbol"],
        hints = ["No two symbols have the same holes."]
      }
  SkippedSymbol other ->
    (at region "E1008" ("a row to skip is the symbol " <> quote other))
      { hints = ["Skip only rows that mean nothing."]
      }
  SharedTrack ->
    (at region "E1008" "one track for service and for parity")
      { hints =
          ["Give each a track of its own."]
      }
  TooFewTracks ->
    (at region "E1008" "ASCII needs seven tracks")
      { hints =
          ["Give the row of each symbol: X = 0101"]
      }

serviceReport :: Region -> ServiceFault -> Report
serviceReport region fault = case fault of
  NoTrack ->
    (wrong "the code has no track for these holes")
      { hints =
          ["Name the track in the code: service-track 5"]
      }
  WrongCount named digits ->
    (wrong (Decimal.whole named <> " holes for " <> Decimal.whole digits <> " digits"))
      { hints =
          [ "Say for each digit what a hole beside it means, - where there never is one: \
            \holes minus - - -"
          ]
      }
  AnyLength ->
    (wrong "a number of any length has no fixed place for holes")
      { hints =
          ["Give it a fixed length: digits 4"]
      }
  SameMeaning meaning ->
    (wrong (quote meaning <> " has two places"))
      { hints =
          ["A hole that says the same stands in one place of a frame."]
      }
  BitGap name ->
    (wrong ("the bits of " <> quote name <> " have a gap"))
      { hints =
          ["They are counted from 0, without a gap: " <> name <> ":1 " <> name <> ":0"]
      }
  OptionalBits name ->
    (wrong ("the bits of " <> quote name <> " are not in every frame"))
      { hints =
          ["Let the word stand in every frame: leave out ‘when’."]
      }
  NoBrakingHole ->
    (wrong "no hole says that a frame is braked")
      { hints =
          ["Name it in the word of the feed: holes braking -"]
      }
  where
    wrong = at region "E1011"

frameReport :: Region -> FrameFault -> Report
frameReport region fault = case fault of
  NoSuchAxis axis ->
    (wrong ("the machine has no axis " <> axis))
      { hints =
          ["Leave the word out, or describe the axis: axis " <> axis <> " { … }"]
      }
  TwoWords what first ->
    (wrong ("two words hold the same: " <> what))
      { others = [Label first "the other word"],
        hints = ["Keep one."]
      }
  NoWord what ->
    (wrong ("the frame has no word for this: " <> what)) {hints = ["Add it to the frame: word …"]}
  Unsuited what why -> (wrong ("this does not suit the word: " <> what)) {message = [why]}
  PulseNotDecimal decimals (Mm pulse) -> notDecimal decimals (Decimal.exact pulse) "mm"
  AngleNotDecimal decimals pulse ->
    notDecimal decimals (Decimal.short 9 (Quantity.degrees pulse)) "deg"
  BadMotion n ->
    (wrong ("a motion cannot be " <> Decimal.whole n))
      { hints =
          ["Each kind of motion has a number of its own that fits the digits of the word."]
      }
  CentreAlong axis ->
    (wrong ("arcs have no centre along " <> axis)) {hints = ["Arcs lie in the plane of x and y."]}
  NoCheckDigit modulus ->
    (wrong ("no digit makes every sum a multiple of " <> Decimal.whole modulus))
      { message = ["The weights of the digits 0 to 9 have to leave every remainder."],
        hints = ["Let every digit count itself: weights { digits }"]
      }
  NoSign what ->
    (wrong ("this word cannot say which way: " <> what))
      { hints =
          ["Say how: sign minus, sign both, sign priority 5 6 1 2, or holes minus …"]
      }
  BrakedFrequencies ->
    (wrong "frames cannot be braked to a feed where codes are frequencies")
      { hints =
          ["Write: by slow-frames, or by control; or give the feeds in mm/min."]
      }
  where
    wrong = at region "E1012"
    tenth n = Decimal.exact (10 ^^ negate (n :: Int))
    notDecimal decimals pulse unit =
      (wrong ("the last decimal is not a pulse of " <> pulse <> " " <> unit))
        { message =
            [ "A number with a point is in " <> unit
                <> ", so its last decimal has to be the pulse of its axis."
            ],
          hints =
            [ "Write decimals "
                <> Decimal.whole wanted
                <> "."
              | Just wanted <- [List.elemIndex pulse (map tenth [0 .. 9])]
            ]
              <> [ "With "
                     <> Decimal.whole decimals
                     <> " decimals the pulse is "
                     <> Decimal.exact (10 ^^ negate decimals)
                     <> " "
                     <> unit
                     <> "."
                 ]
        }

tableReport :: Region -> TableFault -> Report
tableReport region fault = case fault of
  EmptyTable -> (wrong "the table is empty") {hints = ["Write a line for each code: 1 = 15"]}
  NoValue n ->
    (wrong ("the value of " <> Decimal.whole n <> " is no number above 0"))
      { hints =
          ["Feeds and speeds are above 0, and below 1000000000."]
      }
  CodeTooLarge n largest ->
    ( wrong
        ( "the codes of the feeds go up to "
            <> Decimal.whole n
            <> ", but the word of the feed holds at most "
            <> Decimal.whole largest
        )
    )
      { hints =
          [ "End the codes at "
              <> Decimal.whole largest
              <> ". Or give the word of the feed more digits, and holes for each of them."
          ]
      }
  NoSuchCode n ->
    (wrong ("the table has no code " <> Decimal.whole n))
      { hints =
          ["Name a code of the table, or write: rapid highest"]
      }
  BadRange a b ->
    (wrong ("the range " <> Decimal.whole a <> ".." <> Decimal.whole b <> " is none"))
      { hints =
          ["A range goes from a number to one that is not below it, over 10000 numbers at most."]
      }
  NoSuchFeed low high ->
    (wrong "the machine has no such feed")
      { hints =
          ["Its feeds are " <> Decimal.short 3 low <> " to " <> Decimal.short 3 high <> " mm/min."]
      }
  where
    wrong = at region "E1013"

commandReport :: Region -> CommandFault -> Report
commandReport region fault = case fault of
  UnknownCommandName name known ->
    (wrong ("the frame has no place for " <> quote name))
      { fixes = nearestFixes region name known,
        hints = ["Give it a word in the frame: word \"" <> name <> "\" command " <> name]
      }
  NumberTooLarge n largest ->
    (wrong ("the number " <> Decimal.whole n <> " does not fit"))
      { hints =
          ["Its place in the frame holds 0 to " <> Decimal.whole largest <> "."]
      }
  NoSuchValue value event ->
    (wrong (quote value <> " means nothing for " <> quote event))
      { hints =
          ["Give it a number: set M 8"]
      }
  InDecimals ->
    (wrong "a whole number in a word with decimals")
      { hints =
          ["Only a diameter or a time goes into a word with decimals."]
      }
  ZeroIsNoCommand ->
    (wrong "0 stands there when nothing is asked")
      { hints =
          ["Give it another number, or let the word stand only where it is needed: when needed"]
      }
  where
    wrong = at region "E1014"

-- | Fix that writes the known word that is most like a word.
nearestFixes :: Region -> Text -> [Text] -> [Fix]
nearestFixes region word known =
  [ Fix.exchange ("Write " <> w <> ".") region w
    | w <- take 1 (Name.lookAlike word known <> Name.nearest word known)
  ]
