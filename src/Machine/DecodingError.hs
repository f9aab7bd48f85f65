{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Reasons why the frames of a description cannot be decoded uniquely, and their reports.
module Machine.DecodingError
  ( DecodingFault (..),
    toReport,
  )
where

import Base.Region (Region)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Report
  ( Label (..),
    Report (..),
    ReportPlace (..),
    Severity (..),
    quote,
    report,
  )

-- | Reason why frames cannot be decoded uniquely.
data DecodingFault
  = -- | optional word without an address
    NoAddress
  | -- | address that an earlier word has too: the address, and the region of the earlier word
    SameAddress Text Region
  | -- | address or separator that begins like a number
    LikeNumber Text
  | -- | item whose symbols begin with those of another item that may come at the same position. The
    -- arguments are the shorter symbols, the longer ones, and the region of the item with the
    -- shorter ones
    Prefix Text Text Region
  | -- | number without fixed length before an item that may begin with a digit
    NumberRunsOn Region
  | -- | number without fixed length before closing symbols that begin with a digit
    NumberRunsIntoClosing
  | -- | number without fixed length before skipped blank rows that read as this digit
    NumberRunsIntoBlank Char
  | -- | no item that every frame contains
    NoFixedItem
  | -- | blank rows are skipped, but a frame may begin with one
    BlankStart
  | -- | second check digit, and the region of the first one
    TwoChecks Region
  | -- | closing symbols that begin like a frame
    ClosingLikeFrame
  deriving stock (Eq, Ord, Show)

-- | Report of a fault; the region is that of the item of the frame.
toReport :: Region -> DecodingFault -> Report
toReport region fault = case fault of
  NoAddress ->
    (because "A word that need not stand in a frame is known by its address only.")
      { hints =
          [ "Give the word an address: word \"X\" along x",
            "Or let it stand in every frame: leave out ‘when’."
          ]
      }
  SameAddress address first ->
    (because ("Two words have the address " <> quote address <> "."))
      { others = [Label first "the other word"],
        hints = ["Give each word an address of its own."]
      }
  LikeNumber text ->
    (because (quote text <> " begins like a number."))
      { hints = ["Begin with what is neither a digit nor a sign nor a point."]
      }
  Prefix short long other ->
    (because (quote long <> " begins with " <> quote short <> ", which may stand in its place."))
      { others = [Label other (quote short)],
        hints =
          [ "Change one of the two, or let the longer one stand first if its rest cannot be a \
            \number."
          ]
      }
  NumberRunsOn next ->
    (because "The number has any length, and what follows it may begin with a digit.")
      { others = [Label next "follows it"],
        hints =
          ["Give the number a fixed length: digits " <> "4", "Or give what follows an address."]
      }
  NumberRunsIntoClosing ->
    (because "The number has any length, and the symbols behind the last frame begin with a digit.")
      { hints =
          [ "Give the number a fixed length: digits 4",
            "Or end every frame with a symbol: symbols \"\\n\""
          ]
      }
  NumberRunsIntoBlank digit ->
    ( because
        ( "The number has any length, and a blank row, which is skipped behind the frame, reads as "
            <> quote (Text.singleton digit)
            <> "."
        )
    )
      { hints = ["Give the number a fixed length: digits 4", "Or let the blank rows be ‘counted’."]
      }
  NoFixedItem ->
    ( because
        "No word and no symbol stands in every frame, so nothing tells one frame from the next."
    )
      { hints = ["End every frame with a symbol: symbols \"\\n\""]
      }
  BlankStart ->
    (because "Blank rows are skipped, but a frame may begin with one.")
      { hints =
          ["Begin the frame with a symbol that has holes, or let the blank rows be ‘counted’."]
      }
  TwoChecks first ->
    (because "With two check digits one of them can be any digit.")
      { others = [Label first "the other one"],
        hints = ["Keep one."]
      }
  ClosingLikeFrame ->
    (because "The symbols behind the last frame begin like a frame.")
      { hints =
          ["Let them begin with a symbol that begins no frame."]
      }
  where
    because why =
      (report Error "E1010" (InSource region) "such frames cannot be read back") {message = [why]}
