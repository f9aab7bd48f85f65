-- | The tape-to-code converter ЛКП-01Ф of the Ural paper: straight moves only.
module Machine.Lkp01f
  ( lkp01f,
  )
where

import Base.Quantity (Feed (..), Mm (..))
import Data.List.NonEmpty (NonEmpty (..))
import Machine.Code5121 (code5121)
import Machine.Machine

-- | 15 rows a frame: four digits of x, four of y, three of z, the speed, a gap of three.
lkp01f :: Machine
lkp01f =
  Machine
    { name = MachineName "lkp-01f",
      title = "ЛКП-01Ф, tape-to-code converter for the milling machine 6Н13ГЭ-1",
      tracks = 5,
      pulse = Mm 0.02,
      layout =
        Layout
          { fields =
              [ Field (Increment X) (MinusHole :| [AuxiliaryBit 2, AuxiliaryBit 1, AuxiliaryBit 0]),
                Field (Increment Y) (MinusHole :| [NoHole, NoHole, NoHole]),
                Field (Increment Z) (MinusHole :| [NoHole, NoHole]),
                Field Speed (Marker :| [])
              ],
            code = code5121,
            gap = 3,
            evenShift = 2
          },
      feeds =
        (FeedCode 1, Feed 15)
          :| [ (FeedCode 2, Feed 20),
               (FeedCode 3, Feed 30),
               (FeedCode 4, Feed 40),
               (FeedCode 5, Feed 60),
               (FeedCode 6, Feed 80),
               (FeedCode 7, Feed 120),
               (FeedCode 8, Feed 160),
               (FeedCode 9, Feed 240)
             ],
      driven = [X, Y],
      deceleration = 5,
      leader = 25,
      pitch = Mm 2.54,
      facts =
        [ Fact Sourced "five-track paper tape, 19 mm wide",
          Fact Sourced "code 5121 for the digits 1 to 9; four digits of x, four of y, three of z, one of speed, in this order",
          Fact Sourced "the fifth track holds the sign at a number's first digit, the auxiliary command at others, and the frame marker at the speed",
          Fact Sourced "straight moves in x and y only, although the frame has z",
          Fact Sourced "even frames are shifted by two units",
          Fact Reconstructed "a unit of that shift is one row of the tape",
          Fact Reconstructed "the code word of 0 is 0000; the six other words are rejected",
          Fact Reconstructed "the auxiliary command has three bits, at the second to fourth digit of x",
          Fact Reconstructed "a pulse is 0.02 mm",
          Fact Reconstructed "the speeds 1 to 9 are 15, 20, 30, 40, 60, 80, 120, 160 and 240 mm/min; rapid is 9",
          Fact Reconstructed "a cutter that slows down does so by 5 mm/s², at the lowest speed",
          Fact Reconstructed "a gap of three blank rows behind a frame; 25 blank rows of leader and trailer; 2.54 mm from row to row"
        ]
    }
