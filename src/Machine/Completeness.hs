-- | Checks the words of a frame against the machine: each value that the machine needs has exactly
-- one word, and no word is for a value that the machine lacks.
module Machine.Completeness
  ( check,
  )
where

import Base.Quantity (Mm (..))
import Base.Quantity qualified as Quantity
import Base.Region (Located (..), Region)
import Data.List (nub, sort)
import Data.Map.Strict qualified as Map
import Data.Maybe (catMaybes, isNothing)
import Machine.Axis (axisName, rotaryName)
import Machine.Error (Error (..), FrameFault (..), ServiceFault (..))
import Machine.Machine

-- | Lists the mistakes in the words of a frame. The arguments are the machine, the contents that
-- its linear and rotary axes need, the regions of the sections on arcs and on feeds, and the items
-- of the frame.
check :: Machine -> [Located Content] -> Region -> Region -> [(Region, LayoutItem)] -> [Error]
check machine locatedAxes arcsRegion feedsRegion locatedItems =
  concat
    [ concatMap (wordFaults machine) locatedWords,
      duplicates locatedWords,
      [ BadFrame r (NoWord (contentName c))
        | Located r c <- locatedAxes,
          isNothing (wordFor machine c)
      ],
      [BadFrame feedsRegion (NoWord (contentName FeedWord)) | isNothing (wordFor machine FeedWord)],
      arcFaults machine arcsRegion,
      bitFaults locatedWords,
      [ BadFrame r (NoCheckDigit m)
        | (r, CheckDigit m) <- locatedItems,
          not (hasAllRemainders (code machine) m)
      ]
    ]
  where
    locatedWords = [(r, w) | (r, AWord w) <- locatedItems]

-- | Reports the mistakes in one word. The rules: the word of an axis or of a centre is for an axis
-- that the machine has, and its number has a sign. If this number has decimals, one unit of the
-- last decimal is one pulse, in mm or in degrees. No word of a centre is for z. The codes of a
-- motion word differ from each other, and fit its digits.
wordFaults :: Machine -> (Region, Word') -> [Error]
wordFaults machine (r, w) = case content w of
  Along a -> axisFaults a
  About a -> rotaryFaults a
  Centre Z -> [BadFrame r (CentreAlong (axisName Z))]
  Centre a -> axisFaults a
  Motion m -> motionFaults m
  FrameNumber -> []
  FeedWord -> []
  Command _ -> []
  where
    axisFaults a = case axisForm machine a of
      Nothing -> [BadFrame r (NoSuchAxis (axisName a))]
      Just f ->
        let Mm p = resolution f in decimalFaults (PulseNotDecimal places (resolution f)) p
    rotaryFaults a = case rotaryForm machine a of
      Nothing -> [BadFrame r (NoSuchAxis (rotaryName a))]
      Just f ->
        decimalFaults (AngleNotDecimal places (pulseAngle f)) (Quantity.degrees (pulseAngle f))
    decimalFaults fault pulse =
      [BadFrame r fault | places > 0, abs (pulse * 10 ^ places - 1) >= pulseTolerance]
        <> [BadFrame r (NoSign (contentName (content w))) | sign (form w) == Unsigned]
    places = decimals (form w)
    motionFaults m =
      let ns = catMaybes [rapid m, Just (straight m), clockwise m, counterClockwise m]
       in [ BadFrame r (BadMotion n)
            | (k, n) <- zip [0 ..] ns,
              n `elem` take k ns || n >= 10 ^ digits (form w)
          ]

-- | Relative difference below which the resolution of an axis counts as equal to one unit of the
-- last decimal of the axis's word.
pulseTolerance :: Double
pulseTolerance = 1e-9

-- | Reports each word that has the same content as an earlier word.
duplicates :: [(Region, Word')] -> [Error]
duplicates locatedWords =
  [ BadFrame r (TwoWords (contentName (content w)) first)
    | (k, (r, w)) <- zip [0 ..] locatedWords,
      (first, _) <- take 1 [p | p@(_, v) <- take k locatedWords, isSame (content v) (content w)]
  ]
  where
    isSame a b = case (a, b) of
      (Motion _, Motion _) -> True
      _ -> a == b

-- | Reports words and axes that a machine with arcs needs but lacks. The region is that of the
-- section on arcs.
arcFaults :: Machine -> Region -> [Error]
arcFaults machine r = case arcs machine of
  NoArcs -> []
  Arcs {} ->
    [ BadFrame r (NoWord (contentName (Centre a)))
      | a <- [X, Y],
        isNothing (wordFor machine (Centre a))
    ]
      <> [BadFrame r (NoWord "the direction of an arc") | not (any hasBothSenses (wordsOf machine))]
      <> [BadFrame r (NoSuchAxis (axisName a)) | a <- [X, Y], isNothing (axisForm machine a)]
  where
    hasBothSenses w = case content w of
      Motion MotionCodes {clockwise = Just _, counterClockwise = Just _} -> True
      _ -> False

-- | A bit of a command, which is a hole in the service track beside a digit of another word. Bits
-- are numbered from 0, the lowest.
data LocatedBit = LocatedBit
  { wordRegion :: Region,
    command :: CommandName,
    bit :: Int,
    -- | true if some frames lack the word
    isOptional :: Bool
  }

-- | Checks the holes in the service track. The rules: each bit of a command occurs in words that
-- every frame contains. It may occur at several digits, which then all have its hole, or none of
-- them. The bits of a command have all numbers from 0 to the highest one. A command with bits has
-- no word of its own. At most one hole is a 'BrakingHole', which makes the machine slow down.
bitFaults :: [(Region, Word')] -> [Error]
bitFaults locatedWords =
  concat
    [ [BadService r (BitGap (commandText c)) | (r, c) <- firsts, hasGap c],
      [ BadService (wordRegion b) (OptionalBits (commandText (command b)))
        | b <- bits,
          isOptional b
      ],
      [ BadFrame r (TwoWords (contentName (Command c)) r')
        | (r, c) <- firsts,
          (r', w) <- locatedWords,
          content w == Command c
      ],
      [BadService r (SameMeaning "braking") | r <- drop 1 brakingHoles]
    ]
  where
    bits =
      [ LocatedBit {wordRegion = r, command = c, bit = k, isOptional = presence w /= Always}
        | (r, w) <- locatedWords,
          CommandBit c k <- service (form w)
      ]
    brakingHoles =
      [r | (r, w) <- locatedWords, _ <- filter (== BrakingHole) (service (form w))]
    firsts =
      Map.elems
        (Map.fromListWith (\_ first -> first) [(command b, (wordRegion b, command b)) | b <- bits])
    hasGap c =
      let ks = nub (sort [bit b | b <- bits, command b == c])
       in ks /= [0 .. length ks - 1]
    commandText (CommandName n) = n

-- | True if the weights of the digits have every remainder modulo @modulus@, so that there is a
-- check digit for each sum.
hasAllRemainders :: TapeCode -> Int -> Bool
hasAllRemainders c modulus =
  length (nub [Map.findWithDefault 0 d (weights c) `mod` modulus | d <- ['0' .. '9']]) == modulus
