-- | The code 5121: a decimal digit as a sum of the weights 5, 1, 2, 1 (Ural paper, Table 6).
module Machine.Code5121
  ( code5121,
  )
where

import Machine.Machine (DigitCode (..))

-- | Tracks 4, 3, 2, 1 hold the word as it is printed. The word of 0 is not in the table: reconstructed.
code5121 :: DigitCode
code5121 =
  DigitCode
    { codeName = "5121",
      digitWords = [0x0, 0x1, 0x5, 0x6, 0x7, 0x8, 0x9, 0xA, 0xB, 0xF]
    }
