{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | The reports of calls whose arguments are in the wrong number, order, place or form.
module Checked.CallReport
  ( BothUses (..),
    WrittenCall (..),
    unwrittenCall,
    apartReport,
    argumentCountReport,
    bothReport,
    swappedReport,
    numberLetterReport,
    vectorReport,
    arguments,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Region (..))
import Checked.ErrorFix qualified as ErrorFix
import Checked.Type (Type)
import Checked.Type qualified as Type
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Fix (Fix)
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), at, quote)

-- | The report of a space between the name of a function and its bracket, which is at @gap@.
apartReport :: Region -> Text -> Region -> Report
apartReport region name gap =
  ( at
      region
      "E0210"
      ("there is a space between " <> quote name <> " and the bracket of its arguments")
  )
    { fixes = [Fix.removal "Write the bracket of a call right after the name." gap]
    }

-- | Facts about a call from the text of the program: the region at which its function is defined,
-- with the parameters, and the arguments as they are written.
data WrittenCall = WrittenCall {definition :: Maybe Region, writtenArguments :: [Text]}
  deriving stock (Eq, Show)

-- | A call of which nothing is known.
unwrittenCall :: WrittenCall
unwrittenCall = WrittenCall {definition = Nothing, writtenArguments = []}

-- | The report of a call with a wrong number of arguments: the function, its parameters, the
-- regions of the arguments, the call as it is written, and the fixes.
argumentCountReport ::
  Region -> Text -> [Text] -> [Region] -> WrittenCall -> [Fix] -> Report
argumentCountReport region name wanted given call fixes =
  ( at
      region
      "E0208"
      ( quote name
          <> " takes "
          <> arguments (length wanted)
          <> ", but "
          <> Decimal.whole (length given)
          <> (if length given == 1 then " is" else " are")
          <> " given"
      )
  )
    { message =
        ["It is called as " <> name <> "(" <> Text.intercalate ", " wanted <> ")."],
      others = [Label r "defined here" | Just r <- [definition call]],
      fixes,
      hints =
        [ "Write the value of " <> ErrorFix.joinedWords missing <> " in place of …: " <> added
          | null fixes,
            isWritten
        ]
    }
  where
    missing = drop (length given) wanted
    added = name <> "(" <> Text.intercalate ", " completed <> ")"
    completed = writtenArguments call <> map (const "…") missing
    isWritten = not (null missing) && length (writtenArguments call) == length given

-- | The report of two arguments, with the given indices, in the wrong order. @form@ is the call in
-- the right order.
swappedReport :: Region -> Text -> [(Region, Type)] -> Text -> (Int, Int) -> Report
swappedReport region name given form (i, j) =
  (at region "E0218" ("two arguments of " <> quote name <> " are in the wrong order"))
    { message = ["It is called as " <> form <> "."],
      others = [Label r (Type.describe t) | (r, t) <- given],
      fixes =
        [ Fix.swap "Exchange these two arguments." a b
          | (a, _) : _ <- [drop i given],
            (b, _) : _ <- [drop j given]
        ]
    }

-- | An argument that two calls use as different types.
data BothUses = BothUses
  { -- | the argument as it is written
    argument :: Text,
    -- | the use that was found first: its region, its type, and the call as it is written
    firstUse :: (Region, Type, Text),
    -- | the type and the call of the other use
    otherUse :: (Type, Text),
    -- | the two arguments of each of the calls, with the call as it is written
    exchanges :: [(Text, Region, Region)]
  }
  deriving stock (Eq, Show)

-- | The report of an argument that two calls use as different types. It points at the other use.
bothReport :: Region -> BothUses -> Report
bothReport region BothUses {argument, firstUse = (r, t, call), otherUse = (t', call'), exchanges} =
  ( at
      region
      "E0205"
      ( quote argument
          <> " is "
          <> Type.describe t
          <> " in "
          <> call
          <> " and "
          <> Type.describe t'
          <> " in "
          <> call'
      )
  )
    { label = Type.describe t' <> " here",
      others = [Label r (Type.describe t <> " here")],
      message = ["One of these calls has its arguments in the wrong order."],
      fixes =
        [ Fix.proposed (Fix.swap ("Exchange the arguments of " <> written <> ".") a b)
          | (written, a, b) <- exchanges
        ]
    }

-- | The report of a number that is written with a letter before it. @what@ names the number.
numberLetterReport :: Region -> Text -> Text -> Text -> Report
numberLetterReport region name digits what =
  (at region "E0201" ("nothing is named " <> quote name))
    { fixes =
        [ Fix.exchange
            ("Write " <> what <> " without " <> Text.take 1 name <> ": " <> digits)
            region
            digits
        ]
    }

-- | The report of numbers as arguments of a function, in place of vectors. Each has the name of its
-- parameter. @form@ is the call with the names of all parameters.
vectorReport :: Region -> Text -> [(Region, Text)] -> Text -> Report
vectorReport region name numbers form =
  ( at
      region
      "E0205"
      ( ErrorFix.joinedWords (map (quote . snd) numbers)
          <> " of "
          <> quote name
          <> ( if isOne
                 then " is a vector (x, y), but this is a number"
                 else " are vectors (x, y), but these are numbers"
             )
      )
  )
    { message = ["It is called as " <> form <> "."],
      others = [Label r (quote title') | (r, title') <- drop 1 numbers],
      fixes =
        [ Fix.joined
            ( if isOne
                then "Write it as a vector: (x, 0) along x, or (0, y) along y."
                else "Write each as a vector: (x, 0) along x, and (0, y) along y."
            )
            [ if Text.isPrefixOf "other" title'
                then Fix.enclosure "" "(0, " r ")"
                else Fix.enclosure "" "(" r ", 0)"
              | (r, title') <- numbers
            ]
        ]
    }
  where
    isOne = length numbers == 1

-- | The count of arguments in words.
arguments :: Int -> Text
arguments n = if n == 1 then "1 argument" else Decimal.whole n <> " arguments"
