-- | Whether the words of a frame say what the machine needs, and nothing of what it lacks.
module Machine.Completeness
  ( check,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..))
import Base.Region (Located (..), Region)
import Data.List (nub, sort)
import Data.Map.Strict qualified as Map
import Data.Maybe (catMaybes, isNothing)
import Data.Text (Text)
import Machine.Error (Error (..), FrameMisfit (..), ServiceFault (..))
import Machine.Machine

-- | What is wrong: the machine, where its axes, arcs and feeds stand, the items of its frame.
check :: Machine -> [Located AxisForm] -> Region -> Region -> [(Region, LayoutItem)] -> [Error]
check machine axes' arcsAt feedsAt items' =
  concat
    [ concatMap (strange machine) placed,
      twice placed,
      [ Unfit r (NoWord (contentWord (Along (axis a))))
        | Located r a <- axes',
          isNothing (wordFor machine (Along (axis a)))
      ],
      [Unfit feedsAt (NoWord (contentWord FeedWord)) | isNothing (wordFor machine FeedWord)],
      arcWords machine arcsAt,
      bits placed,
      [Unfit r (NoCheckDigit m) | (r, CheckDigit m) <- items', not (solves (code machine) m)]
    ]
  where
    placed = [(r, w) | (r, AWord w) <- items']

-- | A word for what is not there, or of another measure.
strange :: Machine -> (Region, Word') -> [Error]
strange machine (r, w) = case content w of
  Along a -> onAxis a
  Centre Z -> [Unfit r CentreOfZ]
  Centre a -> onAxis a
  Motion m -> motions m
  FrameNumber -> []
  FeedWord -> []
  Command _ -> []
  where
    onAxis a = case axisForm machine a of
      Nothing -> [Unfit r (NoSuchAxis (axisText a))]
      Just f ->
        [ Unfit r (PulseNotDecimal (decimals (form w)) (step f))
          | decimals (form w) > 0,
            not (isLast (decimals (form w)) (step f))
        ]
          <> [Unfit r (NoSign (contentWord (content w))) | sign (form w) == Unsigned]
    isLast n (Mm p) = abs (p * 10 ^ n - 1) < samePulse
    motions m =
      let ns = catMaybes [rapid m, Just (straight m), clockwise m, counterClockwise m]
       in [ Unfit r (BadMotion n)
            | (k, n) <- zip [0 ..] ns,
              n `elem` take k ns || n >= 10 ^ digits (form w)
          ]

-- | Pulses are the same when they differ by this part.
samePulse :: Double
samePulse = 1e-9

axisText :: Axis -> Text
axisText a = case a of
  X -> "x"
  Y -> "y"
  Z -> "z"

-- | Words that hold the same.
twice :: [(Region, Word')] -> [Error]
twice placed =
  [ Unfit r (TwoWords (contentWord (content w)) first)
    | (k, (r, w)) <- zip [0 ..] placed,
      (first, _) <- take 1 [p | p@(_, v) <- take k placed, same (content v) (content w)]
  ]
  where
    same a b = case (a, b) of
      (Motion _, Motion _) -> True
      _ -> a == b

-- | What arcs need.
arcWords :: Machine -> Region -> [Error]
arcWords machine r = case arcs machine of
  NoArcs -> []
  Arcs {} ->
    [ Unfit r (NoWord (contentWord (Centre a)))
      | a <- [X, Y],
        isNothing (wordFor machine (Centre a))
    ]
      <> [ Unfit r (NoWord "the direction of an arc")
           | null
               [ ()
                 | w <- wordsOf machine,
                   Motion MotionCodes {clockwise = Just _, counterClockwise = Just _} <- [content w]
               ]
         ]
      <> [Unfit r (NoSuchAxis (axisText a)) | a <- [X, Y], isNothing (axisForm machine a)]

-- | The bits of commands: each once, without a gap, in words that are always there, and no word for
-- them besides.
bits :: [(Region, Word')] -> [Error]
bits placed =
  [ BadService r (SameMeaning (bitText o k))
    | (i, (r, o, k, _)) <- zip [0 ..] given,
      or [(o, k) == (o', k') | (_, o', k', _) <- take i given]
  ]
    <> [ BadService r (BitGap (orderText o))
         | (r, o) <- firsts,
           nub (sort [k | (_, o', k, _) <- given, o' == o])
             /= [0 .. length (nub [k | (_, o', k, _) <- given, o' == o]) - 1]
       ]
    <> [BadService r (BitsMayLack (orderText o)) | (r, o, _, Just ()) <- given]
    <> [ Unfit r (TwoWords (contentWord (Command o)) r')
         | (r, o) <- firsts,
           (r', w) <- placed,
           content w == Command o
       ]
    <> [ BadService r (SameMeaning "braking")
         | (r, _) <-
             drop 1 [b | b@(_, w) <- placed, _ <- filter (== BrakingHole) (service (form w))]
       ]
  where
    given =
      [ (r, o, k, if presence w == Always then Nothing else Just ())
        | (r, w) <- placed,
          OrderBit o k <- service (form w)
      ]
    firsts = Map.elems (Map.fromListWith (\_ first -> first) [(o, (r, o)) | (r, o, _, _) <- given])
    orderText (CommandName n) = n
    bitText (CommandName n) k = n <> ":" <> Decimal.whole k

-- | Whether for every sum there is a digit that makes it a multiple.
solves :: TapeCode -> Int -> Bool
solves c modulus =
  length (nub [Map.findWithDefault 0 d (weights c) `mod` modulus | d <- ['0' .. '9']]) == modulus
