-- | Bits of a command that have holes at several digits: the readings of the auxiliary command of
-- the ЛКП-01Ф that its source leaves open.
module Tape.CommandBitSpec (spec) where

import Base.Result qualified as Result
import Control.Monad (forM_)
import Data.ByteString qualified as ByteString
import Data.Either (isLeft)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Word (Word8)
import Frame.Frame (Frame)
import Frame.Frame qualified as Frame
import Machine.BuiltIn qualified as BuiltIn
import Machine.Error (Error)
import Machine.FromText qualified as FromText
import Machine.Machine (CommandName (..), Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Tape.Punch qualified as Punch
import Tape.Tape (Tape (..))
import Test.Hspec hiding (before)

spec :: Spec
spec =
  describe "the auxiliary command of the ЛКП-01Ф" $ do
    it "is punched as three bits beside x, as its description reads the source" $
      fmap (`rowsOf` 5) (BuiltIn.find (MachineName "lkp-01f"))
        `shouldBe` Just [0, 16, 0, 16, 0, 0, 0, 0, 0, 0, 0, 16, 0, 0, 0]
    forM_ readings $ \(title, holesOfX, holesOfY, holesOfZ, most, value, rows) ->
      describe title $ case described holesOfX holesOfY holesOfZ of
        Nothing -> it "has a description" (expectationFailure "there is none")
        Just machine -> do
          it "has this largest number" $
            Machine.commandCapacity machine auxiliary `shouldBe` Just most
          it "is punched at these digits (catches a bit with a hole at one of its digits only)" $
            rowsOf machine value `shouldBe` rows
          it "is read back (catches a bit that counts once for each of its holes)" $
            Punch.read machine 0 (punched machine value) `shouldBe` Right [command value]
          it "is refused if one of its holes is missing" $
            [ k
              | (k, row) <- zip [0 ..] rows,
                row == 16,
                k /= markerRow,
                let Tape whole = punched machine value,
                let (before, behind) = ByteString.splitAt (leader + k) whole,
                let other = Tape (before <> "\0" <> ByteString.drop 1 behind),
                not (isLeft (Punch.read machine 0 other))
            ]
              `shouldBe` []

-- | Readings of the source: a title; the holes of x, y and z; the largest number of the command; a
-- number, and the rows of a frame with this number alone. A row of 16 has a hole in track 5. The
-- rows are those of docs/machines.md: 1–4 are the digits of x, 5–8 those of y, 9–11 those of z, and
-- 12 is the feed with the marker.
readings :: [(String, Text, Text, Text, Int, Int, [Word8])]
readings =
  [ ( "as one bit at the second to fourth digit of x",
      "minus aux:0 aux:0 aux:0",
      "minus - - -",
      "minus - -",
      1,
      1,
      [0, 16, 16, 16, 0, 0, 0, 0, 0, 0, 0, 16, 0, 0, 0]
    ),
    ( "as three bits beside x and y",
      "minus aux:2 aux:1 aux:0",
      "minus aux:2 aux:1 aux:0",
      "minus - -",
      7,
      5,
      [0, 16, 0, 16, 0, 16, 0, 16, 0, 0, 0, 16, 0, 0, 0]
    ),
    ( "as one bit beside x, y and z",
      "minus aux:0 aux:0 aux:0",
      "minus aux:0 aux:0 aux:0",
      "minus aux:0 aux:0",
      1,
      1,
      [0, 16, 16, 16, 0, 16, 16, 16, 0, 16, 16, 16, 0, 0, 0]
    )
  ]

-- | The description of @lkp-01f@ with these holes at the digits of x, y and z.
described :: Text -> Text -> Text -> Maybe Machine
described x y z =
  BuiltIn.text (MachineName "lkp-01f")
    >>= Result.ifSound . reading
      . Text.replace "holes minus aux:2 aux:1 aux:0" ("holes " <> x)
      . Text.replace "holes minus - - -" ("holes " <> y)
      . Text.replace "holes minus - -  " ("holes " <> z <> " ")
  where
    reading :: Text -> Result.Result () Error Machine
    reading = FromText.read

-- | The rows of the only frame on the tape of 'punched'.
rowsOf :: Machine -> Int -> [Word8]
rowsOf machine value = take 15 (drop leader (ByteString.unpack tape))
  where
    Tape tape = punched machine value

-- | A tape with one frame, which gives the auxiliary command this number.
punched :: Machine -> Int -> Tape
punched machine value = Punch.write machine 0 [command value]

command :: Int -> Frame
command value = Frame.commandFrame [(auxiliary, value)]

auxiliary :: CommandName
auxiliary = CommandName "aux"

-- | The number of blank rows before the first frame.
leader :: Int
leader = 25

-- | The row of the marker in a frame, counted from 0.
markerRow :: Int
markerRow = 11
