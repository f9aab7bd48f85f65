-- | The words that each family of controls has. A G or M number is in tenths: G61.1 is 611.
--
-- Sources: the G-code and M-code pages of LinuxCNC 2.9; gcode.c of GRBL 1.1; the G-code pages of
-- Marlin 2; Fanuc's operator's manual for the series 0i, model F, as Haas follows it.
module Gcode.Dialect
  ( WordKnowledge (..),
    gKnowledge,
    mKnowledge,
    letters,
    dwellPerUnit,
    groupOfG,
    groupOfM,
  )
where

import Machine.ProgramForm (Dialect (..))

-- | Knowledge of a word.
data WordKnowledge
  = -- | The control has it, and "Gcode.Run" carries it out.
    Known
  | -- | The control has it, but what it does depends on facts outside of the file.
    Unproven
  | -- | The control does not have it.
    Absent
  deriving stock (Eq, Show)

-- | Knowledge of the G word with this number of tenths.
gKnowledge :: Dialect -> Int -> WordKnowledge
gKnowledge dialect code
  | code `elem` known = Known
  | code `elem` unproven = Unproven
  | otherwise = Absent
  where
    common = [0, 10, 20, 30, 40, 170, 180, 190, 200, 210, 900, 910] <> offsets
    offsets = [540, 550, 560, 570, 580, 590]
    known = case dialect of
      LinuxCnc ->
        common
          <> [70, 80, 400, 530, 430, 490, 610, 611, 640, 800, 901, 911, 930, 940, 950, 960]
          <> [970, 980, 990]
      Grbl -> common <> [400, 530, 490, 610, 800, 911, 930, 940]
      Marlin -> common
      Fanuc -> common <> [280, 400, 500, 530, 430, 490, 610, 640, 690, 800, 940, 950, 980, 990]
    unproven = case dialect of
      LinuxCnc ->
        [50, 51, 52, 53, 100, 172, 182, 192, 280, 281, 300, 301, 330, 331, 410, 411, 420, 421]
          <> [431, 432, 520, 591, 592, 593, 700, 710, 711, 712, 720, 721, 722, 730, 740, 760]
          <> [810, 820, 830, 840, 850, 860, 870, 880, 890, 920, 921, 922, 923]
          <> [382, 383, 384, 385]
      Grbl -> [100, 280, 281, 300, 301, 382, 383, 384, 385, 431, 920, 921]
      Marlin ->
        [50, 60, 100, 110, 120, 260, 270, 280, 290, 300, 310, 320, 330, 340, 350, 380]
          <> [420, 425, 530, 591, 592, 593, 600, 610, 760, 800, 920]
      Fanuc ->
        [50, 90, 100, 110, 150, 160, 270, 290, 300, 310, 410, 420, 440, 510, 520, 600, 620]
          <> [630, 650, 660, 670, 680, 730, 740, 760, 810, 820, 830, 840, 850, 860, 870, 880]
          <> [890, 920, 930, 960, 970, 541, 1030, 1870]

-- | Knowledge of the M word with this number of tenths.
mKnowledge :: Dialect -> Int -> WordKnowledge
mKnowledge dialect code
  | code `elem` known = Known
  | code `elem` unproven = Unproven
  | otherwise = Absent
  where
    common = [0, 10, 30, 40, 50, 80, 90]
    known = case dialect of
      LinuxCnc -> common <> [20, 60, 70, 300]
      Grbl -> common <> [20, 300]
      Marlin -> common <> [70, 4000]
      Fanuc -> common <> [20, 60, 70, 300]
    unproven = case dialect of
      LinuxCnc ->
        [190, 480, 490, 500, 510, 520, 530, 600, 610, 620, 630, 640, 650, 660, 670, 680, 700]
          <> [710, 720, 730, 980, 990]
          <> [10 * m | m <- [100 .. 199]]
      Grbl -> [70, 560]
      Marlin -> [10 * m | m <- [1 .. 999], m `notElem` [2, 6]]
      Fanuc -> [10 * m | m <- [1 .. 999]]

-- | Letters that may begin a word.
letters :: Dialect -> [Char]
letters dialect = case dialect of
  LinuxCnc -> "GMNXYZIJKRFSTHPQLD"
  Grbl -> "GMNXYZIJKRFSTP"
  Marlin -> "GMXYZIJRFSTP"
  Fanuc -> "GMNOXYZIJKRFSTHPD"

-- | Seconds for each unit of the number of a dwell.
dwellPerUnit :: Dialect -> Double
dwellPerUnit dialect = case dialect of
  LinuxCnc -> 1
  Grbl -> 1
  Marlin -> 0.001
  Fanuc -> 0.001

-- | Modal group of a G word: a line may have one word of each group.
groupOfG :: Dialect -> Int -> Int
groupOfG dialect code
  | code == 800 && dialect == Fanuc = 9
  | code `elem` [0, 10, 20, 30, 800, 331, 730, 810, 820, 830, 840, 850] = 1
  | code `elem` [170, 180, 190] = 2
  | code `elem` [900, 910] = 3
  | code `elem` [901, 911] = 4
  | code `elem` [930, 940, 950] = 5
  | code `elem` [200, 210] = 6
  | code == 400 = 7
  | code `elem` [430, 490] = 8
  | code `elem` [980, 990] = 10
  | code `elem` [540, 550, 560, 570, 580, 590] = 12
  | code `elem` [610, 611, 640] = 13
  | code `elem` [960, 970] = 14
  | code `elem` [70, 80] = 15
  | otherwise = 0

-- | Modal group of an M word: a line may have one word of each group. Fanuc and Haas have one M
-- word in a line.
groupOfM :: Dialect -> Int -> Int
groupOfM dialect code
  | dialect == Fanuc = 4
  | code `elem` [0, 10, 20, 300] = 4
  | code == 60 = 6
  | code `elem` [30, 40, 50] = 7
  | code `elem` [70, 80, 90] = 8
  | otherwise = 100 + code
