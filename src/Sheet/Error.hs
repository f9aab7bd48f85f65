{-# OPTIONS_GHC -O0 #-}

-- | What can be wrong with the numbers of a sheet.
module Sheet.Error
  ( Error (..),
    Spot (..),
    Misfit (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Region)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Report (Code, Label (..), Place (..), Report (..), Severity (..), quote, report)
import Sheet.Sheet (address, generalWords, mostArrays)

-- | A number of the sheet: where it stands, and the how-manieth it is, from 1.
data Spot = Spot {site :: Region, number :: Int}
  deriving stock (Eq, Ord, Show)

data Error
  = -- | a word that is no number
    NotANumber Spot Text
  | -- | the general data end too early: the word at which they do, or the last one, and how many there are
    GeneralShort Spot Int
  | -- | a number of the general data that cannot be: what it is, what it has to be
    GeneralWrong Spot Text Text
  | -- | the points of the approach: where it shows, and how
    ApproachShifted Spot Text
  | -- | the points behind an array: where it shows, and how
    OnwardShifted Spot Text
  | -- | a cipher that the system does not have, and why
    CipherUnknown Spot Text
  | -- | data that do not fit the cipher: where it shows, the cipher, what it asks
    PieceMisfit Spot Spot Misfit
  | -- | one array more than there may be begins here
    TooManyArrays Spot
  | -- | the sheet ends where something else is expected: its last word, what is expected
    EndMissing Spot Text
  | -- | behind the end mark of a piece there is no link or no allowance
    LinkMissing Spot Text
  | -- | numbers behind the end of the program
    BehindTheEnd Spot
  | -- | the way to the pieces ends with a feed at which nothing can be cut
    NoWorkingFeed Spot
  deriving stock (Eq, Ord, Show)

-- | How a piece does not fit its cipher.
data Misfit
  = -- | so many numbers before the points, for each point, behind the points, for each point once more; so many are there
    CountOff Int Int Int Int Int
  | -- | fewer than two points
    PointsFew
  | -- | the flag is another number
    FlagOff
  | -- | a sign without a number among the data
    LoneSign
  deriving stock (Eq, Ord, Show)

-- | The words for it.
toReport :: Error -> Report
toReport err = case err of
  NotANumber spot text ->
    (at spot "E0901" (quote text <> " is not a number"))
      { message = [counted spot],
        hints = wordHint text
      }
  GeneralShort spot have ->
    (at spot "E0902" ("the general data are incomplete: " <> Decimal.whole have <> " of " <> Decimal.whole generalWords <> " numbers"))
      { message = [counted spot, "The addresses 0070 to 0107 hold the general data."],
        hints = ["Write 0 for what is not used."]
      }
  GeneralWrong spot what needed ->
    (at spot "E0903" (what <> " cannot be this number"))
      { message = [counted spot, needed],
        hints = ["Is a number of the general data left out or doubled before this one?"]
      }
  ApproachShifted spot how ->
    (at spot "E0904" "the points of the approach are shifted")
      { message = [counted spot, how, stop "13555"],
        hints = ["Each point has x, y, z and a feed above 0; -0 closes them. Look for a number that is missing or written twice."]
      }
  OnwardShifted spot how ->
    (at spot "E0905" "the points behind the array are shifted")
      { message = [counted spot, how, stop "13570"],
        hints = ["Each point has x, y, z and a feed. -0 closes them before the next array; the feed 0 ends the program."]
      }
  CipherUnknown spot why ->
    (at spot "E0906" "there is no such cipher")
      { message = [counted spot, why, stop "14441"],
        hints = ["A cipher is made of the digits 1, 2, 4 and 6, in the order in which the curve is recalculated; 0 leaves it as it is."]
      }
  PieceMisfit spot opened misfit -> misfitReport spot opened misfit
  TooManyArrays spot ->
    (at spot "E0908" ("more than " <> Decimal.whole mostArrays <> " arrays"))
      { message = [counted spot, stop "10746"],
        hints = ["Make two programs of it."]
      }
  EndMissing spot expected ->
    (at spot "E0909" ("the sheet ends before " <> expected))
      { message = [counted spot],
        hints = ["Pieces and points of approach are closed by -0; the feed 0 of its last point ends a program."]
      }
  LinkMissing spot expected ->
    (at spot "E0910" ("here stands no " <> expected))
      { message = [counted spot],
        hints = ["Behind the -0 of a piece stand two numbers: its link (+R, -R, + or -, and 0 at the end of an array), and its allowance."]
      }
  BehindTheEnd spot ->
    (at spot "E0911" "the program has ended before this number")
      { message = [counted spot, "The feed 0 ends a program."],
        hints = ["Give the point before it a feed if the program goes on."]
      }
  NoWorkingFeed spot ->
    (at spot "E0912" "the pieces would be cut in rapid")
      { message = [counted spot, "A feed holds from its point on; that of the last point before an array is the feed of its pieces."],
        hints = ["Write the feed of the pieces here."]
      }

misfitReport :: Spot -> Spot -> Misfit -> Report
misfitReport spot opened misfit =
  (at spot "E0907" ("the data of the piece do not fit its cipher" <> short))
    { others = [Label (site opened) "the cipher of the piece"],
      message = [counted spot, long, stop "14623"],
      hints = ["Look for a number that is missing or written twice, and for a 0 with a minus sign."]
    }
  where
    (short, long) = case misfit of
      CountOff before each behind again have ->
        ( "",
          "It asks " <> Text.intercalate ", " ([numbers before <> " before the points" | before > 0] <> [numbers each <> " for each point"] <> [numbers behind <> " behind them" | behind > 0] <> [numbers again <> " more for each point" | again > 0] <> ["the flag of the feed"])
            <> "; there are "
            <> Decimal.whole have
            <> " numbers, which is no whole number of points."
        )
      PointsFew -> (": fewer than two points", "A curve needs two points at least.")
      FlagOff -> (": the flag of the feed is neither 0 nor 1", "The last number before -0 is the flag: 1 slows down at the end of the piece, 0 does not.")
      LoneSign -> (": a sign without a number", "A sign alone is a link, which stands behind the -0 of a piece.")
    numbers n = if n == 1 then "1 number" else Decimal.whole n <> " numbers"

at :: Spot -> Code -> Text -> Report
at spot code = report Error code (InSource (site spot))

-- | Which number it is.
counted :: Spot -> Text
counted spot = "This is number " <> Decimal.whole (number spot) <> " of the sheet, at the address " <> address (number spot) <> "."

stop :: Text -> Text
stop number' = "The Minsk-22 system stopped here with " <> number' <> "."

wordHint :: Text -> [Text]
wordHint text
  | Text.any (== ',') text = ["Write the decimal point as a point: 59.3"]
  | Text.any (`elem` ("−–—" :: String)) text = ["Write the minus sign as -."]
  | otherwise = ["A sheet holds numbers alone, like 41, -0.5 or +6, with spaces or line ends between them."]
