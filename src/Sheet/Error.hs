{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Mistakes in the numbers of an input sheet.
--
-- A word is a number, a sign without digits, or the end mark @-0@. A sheet begins with the general
-- data (16 numbers on part and tool) and the points of the approach. Then come arrays of pieces,
-- with points after each array. A point has four numbers: x, y, z and the feed of the move to the
-- next point. The mark @-0@ ends the approach, the numbers of each piece, and the points between
-- two arrays.
--
-- A piece is a curve through points of the drawing. The first number of a piece is its cipher. Each
-- digit of the cipher names a recalculation, which shifts the curve along its normal. Two words
-- come after the end mark of a piece: its link to the next piece, and its allowance. The allowance
-- is the thickness of the material that is left on the piece.
module Sheet.Error
  ( Error (..),
    NumberPosition (..),
    GeneralFault (..),
    ApproachFault (..),
    RetractFault (..),
    CipherFault (..),
    Expected (..),
    LinkNumber (..),
    PieceMisfit (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Region)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Fix (Fix)
import Report.Fix qualified as Fix
import Report.Report
  ( Label (..),
    Report (..),
    ReportCode,
    ReportPlace (..),
    Severity (..),
    quote,
    report,
  )
import Sheet.Sheet (address, generalCount, maxArrays)

-- | Position of a word of the sheet: its region in the text, and its ordinal number from 1.
data NumberPosition = NumberPosition {site :: Region, number :: Int}
  deriving stock (Eq, Ord, Show)

-- | Mistake in a sheet. The first field is the position at which the report points.
data Error
  = -- | The word is not a number, an end mark or a sign; the text is the word.
    NotANumber NumberPosition Text
  | -- | The general data are incomplete: the sheet ends in them, or they contain an end mark or a
    -- sign. The last field is the count of the numbers that were found.
    GeneralShort NumberPosition Int
  | -- | A number of the general data is wrong.
    GeneralWrong NumberPosition GeneralFault
  | -- | The points of the approach have a fault. Its usual cause is a number that is missing or
    -- written twice.
    ApproachShifted NumberPosition ApproachFault
  | -- | The points after an array have a fault. Its usual cause is a number that is missing or
    -- written twice.
    RetractShifted NumberPosition RetractFault
  | -- | The cipher of a piece is wrong.
    CipherUnknown NumberPosition CipherFault
  | -- | The numbers of a piece do not fit its cipher. The second position is that of the cipher.
    PieceMisfit NumberPosition NumberPosition PieceMisfit
  | -- | An array begins at this position, although the sheet already has 'maxArrays' arrays.
    TooManyArrays NumberPosition
  | -- | The sheet ends too early. The position is that of its last word.
    EndMissing NumberPosition Expected
  | -- | The word at this position, after the end mark of a piece, is not the link, the allowance
    -- or the feed that belongs there.
    LinkMissing NumberPosition LinkNumber
  | -- | A number follows the end of the program.
    AfterTheEnd NumberPosition
  | -- | The last point before an array has the rapid feed, which would be the feed of the array's
    -- pieces.
    NoWorkingFeed NumberPosition
  deriving stock (Eq, Ord, Show)

-- | A fault of the general data. The ciphers of the product and of the part are identification
-- numbers; all other ciphers are those of pieces.
data GeneralFault
  = ProductCipherNotWhole
  | PartCipherNotWhole
  | -- | the number of the program is not whole
    ProgramNotWhole
  | DiameterNotPositive
  | ToleranceNotPositive
  | -- | negative diameter of the wheel that swivels a blade
    NegativeGear
  | -- | negative height of a cone
    NegativeHeight
  | -- | a swivelling blade whose bevel or height is not 0, though these belong to a cone
    BladeWithCone
  | -- | a height of a cone, but no bevel
    HeightWithoutBevel
  | -- | a side of the tool that is not 1, -1 or 0
    UnknownSide
  | -- | a number that should say if every piece gives a feed, other than 0 and 1
    UnknownFeeds
  | -- | a number other than 0 at an unused address
    UnusedWord
  deriving stock (Eq, Ord, Show)

-- | A fault of the points of the approach.
data ApproachFault
  = -- | a sign without digits
    SignInApproach
  | ApproachFeedNotPositive
  | NoApproachPoint
  | -- | a count of numbers that is not a multiple of four, although a point has four numbers
    ApproachCount Int
  deriving stock (Eq, Ord, Show)

-- | A fault of the points after an array.
data RetractFault
  = NegativeFeed
  | -- | the sheet ends before a point with the feed 0, which marks the last point of the sheet
    NoLastFeed
  | -- | an end mark or a sign in place of a coordinate or a feed
    NotACoordinate
  deriving stock (Eq, Ord, Show)

-- | A fault of a cipher.
data CipherFault
  = CipherNotWhole
  | -- | an end mark in place of the cipher
    MarkInsteadOfCipher
  | -- | a sign without digits in place of the cipher
    SignInsteadOfCipher
  | -- | a digit other than 1, 2, 4 and 6
    UnknownDigit Char
  | -- | a minus sign before a cipher, although the first distance before the points is not 0 and
    -- its sign already gives the side of the piece
    SignTwice
  deriving stock (Eq, Ord, Show)

-- | The part of the sheet that is missing if the sheet ends too early.
data Expected
  = -- | another piece, or the feed 0 of the last point
    PieceOrLastFeed
  | -- | the end mark of the approach
    MarkAfterApproach
  | -- | the end mark of a piece
    MarkAfterPiece
  | LinkOfPiece
  | AllowanceOfPiece
  | FeedOfPiece
  deriving stock (Eq, Ord, Show)

-- | The number that is missing after the end mark of a piece: its link to the next piece, its
-- allowance, or its feed.
data LinkNumber = LinkNumber | AllowanceNumber | FeedNumber
  deriving stock (Eq, Ord, Show)

-- | The reason why the numbers of a piece do not fit its cipher.
data PieceMisfit
  = -- | No whole count of points is possible. The first four fields are the counts of numbers that
    -- the cipher demands, without the flag of the feed: before all points; for each point; after
    -- all points, for the whole piece; at the end, again for each point. The last field is the
    -- count of all numbers of the piece, with the flag.
    CountOff Int Int Int Int Int
  | -- | fewer than two points
    PointsFew
  | -- | a flag of the feed, the last number of a piece, that is neither 0 nor 1
    FlagOff
  | -- | a sign without digits
    LoneSign
  deriving stock (Eq, Ord, Show)

-- | The report of a mistake.
toReport :: Error -> Report
toReport err = case err of
  NotANumber position text ->
    (at position "E0901" (quote text <> " is not a number"))
      { message = [counted position],
        fixes = wordFixes position text,
        hints =
          [ "Write numbers alone, like 41, -0.5 or +6, with spaces or line ends between them."
            | null (wordFixes position text)
          ]
      }
  GeneralShort position count ->
    ( at
        position
        "E0902"
        ( "the general data are incomplete: "
            <> Decimal.whole count
            <> " of "
            <> Decimal.whole generalCount
            <> " numbers"
        )
    )
      { message = [counted position, "The addresses 0070 to 0107 hold the general data."],
        hints = ["Write 0 for what is not used."]
      }
  GeneralWrong position fault ->
    let (subject, needed) = generalTexts fault
     in (at position "E0903" (subject <> " cannot be this number"))
          { message = [counted position, needed],
            fixes = [Fix.exchange "Write 0." (site position) "0" | fault == UnusedWord],
            hints = ["Is a number of the general data left out or doubled before this one?"]
          }
  ApproachShifted position fault ->
    (at position "E0904" "the points of the approach are shifted")
      { message = [counted position, approachText fault, stop "13555"],
        hints =
          [ "Each point has x, y, z and a feed above 0; -0 closes them. Look for a number that is \
            \missing or written twice."
          ]
      }
  RetractShifted position fault ->
    (at position "E0905" "the points behind the array are shifted")
      { message = [counted position, retractText fault, stop "13570"],
        hints =
          [ "Each point has x, y, z and a feed. -0 closes them before the next array; the feed 0 \
            \ends the program."
          ]
      }
  CipherUnknown position fault ->
    (at position "E0906" "there is no such cipher")
      { message = [counted position, cipherText fault, stop "14441"],
        hints =
          [ "A cipher is made of the digits 1, 2, 4 and 6, in the order in which the curve is \
            \recalculated; 0 leaves it as it is."
          ]
      }
  PieceMisfit position cipher misfit -> misfitReport position cipher misfit
  TooManyArrays position ->
    (at position "E0908" ("more than " <> Decimal.whole maxArrays <> " arrays"))
      { message = [counted position, stop "10746"],
        hints = ["Make two programs of it."]
      }
  EndMissing position expected ->
    (at position "E0909" ("the sheet ends before " <> expectedText expected))
      { message = [counted position],
        hints =
          [ "Pieces and points of approach are closed by -0; the feed 0 of its last point ends a \
            \program."
          ]
      }
  LinkMissing position missing ->
    (at position "E0910" ("here stands no " <> linkNumberText missing))
      { message = [counted position],
        hints =
          [ "Behind the -0 of a piece stand two numbers: its link (+R, -R, + or -, and 0 at the \
            \end of an array), and its allowance."
          ]
      }
  AfterTheEnd position ->
    (at position "E0911" "the program ends before this number")
      { message = [counted position, "The feed 0 ends a program."],
        hints = ["Give the point before it a feed if the program goes on."]
      }
  NoWorkingFeed position ->
    (at position "E0912" "the pieces would be cut in rapid")
      { message =
          [ counted position,
            "A feed holds from its point on; that of the last point before an array is the feed of \
            \its pieces."
          ],
        hints = ["Write the feed of the pieces here."]
      }

-- | The name of a number of the general data, and the sentence on its allowed range.
generalTexts :: GeneralFault -> (Text, Text)
generalTexts fault = case fault of
  ProductCipherNotWhole -> ("the cipher of the product", nineDigits)
  PartCipherNotWhole -> ("the cipher of the part", nineDigits)
  ProgramNotWhole -> ("the number of the program", nineDigits)
  DiameterNotPositive -> ("the diameter of the tool", "It is above 0.")
  ToleranceNotPositive -> ("the tolerance", "It is above 0.")
  NegativeGear -> ("the diameter of the wheel", "It is 0 or above.")
  NegativeHeight -> ("the height of the cone", "It is 0 or above.")
  BladeWithCone -> ("a cone's dimension", "A tool is a swivelling blade or a cone, not both.")
  HeightWithoutBevel -> ("the height of the cone", "A tool without a bevel is no cone.")
  UnknownSide ->
    ( "the side of the tool",
      "It is 1, left of the direction of travel, -1, right of it, or 0, on the pieces."
    )
  UnknownFeeds ->
    ( "the word about the feeds of pieces",
      "It is 1 if every piece gives a feed after its allowance, and 0 if none does."
    )
  UnusedWord ->
    ("a word that is not used", "The addresses 0102 to 0107 are not used and hold 0.")
  where
    nineDigits = "It is a whole number of at most nine digits."

approachText :: ApproachFault -> Text
approachText fault = case fault of
  SignInApproach -> "A sign without a number is no coordinate and no feed."
  ApproachFeedNotPositive -> "This feed is not above 0."
  NoApproachPoint -> "There is no point at all."
  ApproachCount count ->
    "Before this -0 stand "
      <> Decimal.whole count
      <> " numbers, which is no whole number of points."

retractText :: RetractFault -> Text
retractText fault = case fault of
  NegativeFeed -> "This feed is below 0."
  NoLastFeed -> "The sheet ends here, and no feed was 0."
  NotACoordinate -> "Here no coordinate and no feed stands."

cipherText :: CipherFault -> Text
cipherText fault = case fault of
  CipherNotWhole -> "A cipher is a whole number of at most nine digits."
  MarkInsteadOfCipher -> "Here stands an end mark; a piece begins with its cipher."
  SignInsteadOfCipher -> "Here stands a sign without a number; a piece begins with its cipher."
  UnknownDigit digit -> "It has the digit " <> Text.singleton digit <> "."
  SignTwice ->
    "The sign before the first distance says the side; a cipher has a minus sign only where there \
    \is no such distance."

expectedText :: Expected -> Text
expectedText expected = case expected of
  PieceOrLastFeed -> "a piece, or the feed 0 of the last point"
  MarkAfterApproach -> "the -0 behind the points of the approach"
  MarkAfterPiece -> "the -0 behind a piece"
  LinkOfPiece -> "the link of a piece"
  AllowanceOfPiece -> "the allowance of a piece"
  FeedOfPiece -> "the feed of a piece"

linkNumberText :: LinkNumber -> Text
linkNumberText missing = case missing of
  LinkNumber -> "link"
  AllowanceNumber -> "allowance"
  FeedNumber -> "feed"

misfitReport :: NumberPosition -> NumberPosition -> PieceMisfit -> Report
misfitReport position cipher misfit =
  (at position "E0907" ("the data of the piece do not fit its cipher" <> short))
    { others = [Label (site cipher) "the cipher of the piece"],
      message = [counted position, long, stop "14623"],
      hints = ["Look for a number that is missing or written twice, and for a 0 with a minus sign."]
    }
  where
    (short, long) = misfitTexts misfit

-- | The end of the report's title, and the report's message.
misfitTexts :: PieceMisfit -> (Text, Text)
misfitTexts misfit = case misfit of
  CountOff before each after again count ->
    let asked =
          [numbers before <> " before the points" | before > 0]
            <> [numbers each <> " for each point"]
            <> [numbers after <> " behind them" | after > 0]
            <> [numbers again <> " more for each point" | again > 0]
            <> ["the flag of the feed"]
     in ( "",
          "It asks "
            <> Text.intercalate ", " asked
            <> "; there are "
            <> Decimal.whole count
            <> " numbers, which is no whole number of points."
        )
  PointsFew -> (": fewer than two points", "A curve needs two points at least.")
  FlagOff ->
    ( ": the flag of the feed is neither 0 nor 1",
      "The last number before -0 is the flag: 1 slows down at the end of the piece, 0 does not."
    )
  LoneSign ->
    ( ": a sign without a number",
      "A sign alone is a link, which stands behind the -0 of a piece."
    )
  where
    numbers n = if n == 1 then "1 number" else Decimal.whole n <> " numbers"

-- | A report at a position, with its code and its title.
at :: NumberPosition -> ReportCode -> Text -> Report
at position code = report Error code (InSource (site position))

-- | The sentence that gives the number of a word on the sheet and the word's octal address.
counted :: NumberPosition -> Text
counted position =
  "This is number "
    <> Decimal.whole (number position)
    <> " of the sheet, at the address "
    <> address (number position)
    <> "."

-- | The sentence that gives the control stop: the number @code@ with which the Minsk-22 system
-- stopped at the mistake.
stop :: Text -> Text
stop code = "The Minsk-22 system stopped here with " <> code <> "."

-- | Fixes of a word that is a number in another notation: with a decimal comma, with a minus or a
-- letter that only looks right.
wordFixes :: NumberPosition -> Text -> [Fix]
wordFixes position text =
  [ Fix.exchange ("Write " <> number' <> ".") (site position) number'
    | number' <- [Text.concatMap plain text],
      number' /= text,
      not (Text.null number'),
      Text.all (`elem` ("0123456789.-+" :: String)) number',
      Text.count "." number' <= 1
  ]
  where
    plain c = case c of
      ',' -> "."
      '−' -> "-"
      '–' -> "-"
      '—' -> "-"
      'O' -> "0"
      'o' -> "0"
      'О' -> "0"
      'о' -> "0"
      'l' -> "1"
      'З' -> "3"
      ';' -> ""
      _ -> Text.singleton c
