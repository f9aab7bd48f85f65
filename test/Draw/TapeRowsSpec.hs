-- | Picture of a tape: tracks, sprocket holes, the meaning of a row, ranges.
module Draw.TapeRowsSpec (spec) where

import Data.Text (Text)
import Data.Text qualified as Text
import Draw.TapeRows (RowRange (..))
import Draw.TapeRows qualified as TapeRows
import Machine.Machine (Machine)
import Machines (iso6983, kontur3p, lkp01f, n55)
import Tape.Journey (journey, start)
import Tape.Punch qualified as Punch
import Tape.RowMeaning qualified as RowMeaning
import Test.Hspec

spec :: Spec
spec = do
  it
    "draws five tracks with the sprocket holes between tracks 3 and 2 (catches mirrored tracks)"
    $ take 5 (drawn lkp01f Everything)
      `shouldBe` [ "   row  5 4 3 ∘ 2 1",
                   "     1  ⋮ ⋮ ⋮ ∘ ⋮ ⋮  leader, 25 rows",
                   "    26  · · · ∘ · ·  frame 1: x thousands 0",
                   "    27  · · · ∘ · ·  frame 1: x hundreds 0",
                   "    28  · · · ∘ · ·  frame 1: x tens 0"
                 ]
  it "draws eight tracks with the sprocket holes between tracks 4 and 3" $
    take 4 (drop 2 (drawn n55 Everything))
      `shouldBe` [ "    26  ● · ● · · ∘ ● · ●  opening ‘%’",
                   "    27  · · · · ● ∘ · ● ·  opening LF",
                   "    28  · ● · · ● ∘ ● ● ·  frame 1: frame number, address ‘N’",
                   "    29  · · ● ● · ∘ · · ·  frame 1: frame number hundreds 0"
                 ]
  it "draws a range of frames or of rows (catches a range that is off by one)" $ do
    let frames = drop 1 (drawn kontur3p (Frames 2 3))
    filter (not . Text.isInfixOf "frame ") frames `shouldBe` []
    ( any (Text.isInfixOf "frame 2:") frames,
      any (Text.isInfixOf "frame 3:") frames,
      any (Text.isInfixOf "frame 4:") frames
      )
      `shouldBe` (True, True, False)
    length (drawn kontur3p (Rows 26 29)) `shouldBe` 5
  it
    "draws nothing for a range after the end, and tells the end (catches a picture without rows)"
    $ do
      let (frames, rows) = (length (journey kontur3p), rowsOf kontur3p)
          beyond machine range =
            ( TapeRows.picture machine range (rowsOf machine),
              TapeRows.extent machine range (rowsOf machine)
            )
      beyond kontur3p (Frames (frames + 1) 999) `shouldBe` (Nothing, ("frame", frames))
      beyond kontur3p (Rows (length rows + 1) 9999) `shouldBe` (Nothing, ("row", length rows))
      length (drawn kontur3p (Frames frames 999)) `shouldSatisfy` (> 1)
      beyond iso6983 (Rows 999 999)
        `shouldBe` (Nothing, ("line", length (drawn iso6983 Everything)))
  it "draws a text line by line with the meaning of its words" $
    take 1 (drop 2 (drawn iso6983 Everything))
      `shouldBe` [ "     3  G41.1 D0.001                                  frame 1: command left \
                   \0.001"
                 ]

-- | Lines of the picture of the machine's journey.
drawn :: Machine -> RowRange -> [Text]
drawn machine range = maybe [] Text.lines (TapeRows.picture machine range (rowsOf machine))

rowsOf :: Machine -> [RowMeaning.Row]
rowsOf machine = Punch.rows machine start (journey machine)
