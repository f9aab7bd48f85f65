-- | The meaning of the words of one piece of an input sheet. A piece is a curve with a cipher,
-- which is a number. Each digit of the cipher names a recalculation, which shifts the curve along
-- its normal. The numbers of the piece follow the cipher. The digits determine their count and
-- order:
--
-- * for each digit 1 and each digit 2, a distance;
-- * for each point, x and y; if there is a digit 4, also the bevel and the height of the flange;
-- * for each digit 1, a second distance;
-- * for each digit 6, a distance for each point;
-- * the flag of the feed: 1 to slow down at the end of the piece, else 0.
module Sheet.PieceFromWords
  ( cipherOf,
    pieceOf,
  )
where

import Base.Region (Located (..), Region (..))
import Control.Monad (when)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)
import Sheet.Error (CipherFault (..), Error (..), NumberPosition (..), PieceMisfit (..))
import Sheet.Sheet
import Sheet.Word (SheetWord (..), WordValue (..), figure, isSign)

-- | The digits of a cipher. The Bool is True if the cipher has a minus sign. The number 0 is a
-- cipher without digits.
cipherOf :: SheetWord -> Either Error (Bool, [Digit])
cipherOf e = case symbol e of
  Figure 0 -> pure (False, [])
  Figure c
    | abs c == fromInteger (round (abs c)) && abs c < 1e9 ->
      (c < 0,) <$> traverse digit (show (round (abs c) :: Int))
  Figure _ -> unknown CipherNotWhole
  Mark -> unknown MarkInsteadOfCipher
  Plus -> unknown SignInsteadOfCipher
  Minus -> unknown SignInsteadOfCipher
  where
    unknown fault = Left (CipherUnknown (position e) fault)
    digit c = case c of
      '1' -> pure One
      '2' -> pure Two
      '4' -> pure Four
      '6' -> pure Six
      _ -> unknown (UnknownDigit c)

-- | The counts of numbers that a cipher demands. The flag of the feed is not included.
data Layout = Layout
  { -- | count of the numbers before all points
    before :: Int,
    -- | count of the numbers of each point: 2 or 4
    each :: Int,
    -- | count of the numbers after the last point that hold for the whole piece
    after :: Int,
    -- | count of the further numbers of each point, which come after those of the whole piece
    again :: Int
  }

layoutOf :: [Digit] -> Layout
layoutOf digits =
  Layout
    { before = length (filter (`elem` [One, Two]) digits),
      each = if Four `elem` digits then 4 else 2,
      after = length (filter (== One) digits),
      again = length (filter (== Six) digits)
    }

-- | The numbers of a piece by their meaning.
data Parts = Parts
  { -- | the distances before the points
    heads :: [Number],
    -- | the numbers of each point: x, y, and with digit 4 the bevel and the flange height
    pointRows :: [[Number]],
    -- | the second distances of the digits 1, after the points
    tails :: [Number],
    -- | a list for each digit 6, in the order of the digits; it has a distance for each point
    given :: [[Number]],
    -- | the flag of the feed
    flag :: Maybe Number
  }

-- | Divides the numbers of a piece, whose count of points is @points@, by their meaning.
partsOf :: Layout -> Int -> [Number] -> Parts
partsOf Layout {before, each, after, again} points numbers =
  Parts
    { heads,
      pointRows = groups each body,
      tails,
      given = groups points givenNumbers,
      flag = listToMaybe rest
    }
  where
    (heads, afterHeads) = splitAt before numbers
    (body, afterBody) = splitAt (points * each) afterHeads
    (tails, afterTails) = splitAt after afterBody
    (givenNumbers, rest) = splitAt (points * again) afterTails

-- | Makes a piece. @opening@ is the word of its cipher. @isNegative@ tells if the cipher has a
-- minus sign; @digits@ are its digits. @inside@ are the words up to the end mark @mark@. The piece
-- gets the allowance 0 and no feed, because their words come after the end mark.
pieceOf :: SheetWord -> Bool -> [Digit] -> [SheetWord] -> SheetWord -> Either Error Piece
pieceOf opening isNegative digits inside mark = do
  mapM_ (\e -> Left (misfitAt e LoneSign)) (filter isSign inside)
  points <- pointCount layout (length numbers) misfit
  let parts = partsOf layout points numbers
      firstDistance = listToMaybe (heads parts)
      isRight = isNegative || any ((< 0) . value) firstDistance
  when (isNegative && any ((/= 0) . value) firstDistance) $
    Left (CipherUnknown (position opening) SignTwice)
  slow <- maybe (Left (misfitAt lastWord FlagOff)) Right (flag parts >>= flagOf)
  rows <- maybe (misfit PointsFew) Right (NonEmpty.nonEmpty (map row (pointRows parts)))
  pure
    Piece
      { shiftSide = Located (site (position opening)) (if isRight then RightSide else LeftSide),
        cipher =
          Located
            (site (position opening))
            (recalculations digits (unsigned (heads parts)) (tails parts) (given parts)),
        rows,
        slow,
        allowance = Located (site (position mark)) 0,
        ownFeed = Nothing
      }
  where
    layout = layoutOf digits
    numbers = [n | e <- inside, Just n <- [figure e]]
    lastWord = if null inside then mark else last inside
    misfitAt e = PieceMisfit (position e) (position opening)
    misfit :: PieceMisfit -> Either Error a
    misfit = Left . misfitAt mark
    -- The first distance's sign is kept as the side, so the distance itself becomes positive.
    unsigned distances = case distances of
      [] -> []
      h : others -> fmap abs h : others

-- | The count of points of a piece that has @count@ numbers. If the count of points is not whole or
-- is less than two, the result is the error that @misfit@ makes from the reason.
pointCount :: Layout -> Int -> (PieceMisfit -> Either Error Int) -> Either Error Int
pointCount Layout {before, each, after, again} count misfit
  | remainder /= 0 = misfit (CountOff before each after again count)
  | points < 2 = misfit PointsFew
  | otherwise = Right points
  where
    (points, remainder) = (count - before - after - 1) `divMod` (each + again)

-- | The flag of the feed: True for 1, which slows down at the end of the piece, False for 0.
-- Nothing for any other number.
flagOf :: Number -> Maybe (Located Bool)
flagOf n = case value n of
  0 -> Just (False <$ n)
  1 -> Just (True <$ n)
  _ -> Nothing

-- | A point from its two or four numbers.
row :: [Number] -> PointRow
row numbers = case numbers of
  [px, py, mu, flangeHeight] -> PointRow {px, py, surface = Just Surface {mu, flangeHeight}}
  px : py : _ -> PointRow {px, py, surface = Nothing}
  _ -> PointRow {px = nowhere, py = nowhere, surface = Nothing}
  where
    -- Unreachable: points have two or four numbers.
    nowhere = Located (Region 0 0) 0

-- | Splits a list into groups of @size@ elements; the last group may be shorter.
groups :: Int -> [a] -> [[a]]
groups size list = case splitAt size list of
  ([], _) -> []
  (one, rest) -> one : groups size rest

-- | The recalculations that the digits of a cipher name. @heads@ are the distances before the
-- points, @tails@ the second distances of the digits 1. @given@ has a list for each digit 6, with a
-- distance for each point.
recalculations :: [Digit] -> [Number] -> [Number] -> [[Number]] -> [Recalculation]
recalculations digits heads tails given = case (digits, heads, tails, given) of
  (One : ds, h : hs, t : ts, _) -> Growing h t : recalculations ds hs ts given
  (Two : ds, h : hs, _, _) -> Constant h : recalculations ds hs tails given
  (Four : ds, _, _, _) -> Bevelled : recalculations ds heads tails given
  (Six : ds, _, _, g : gs)
    | Just g' <- NonEmpty.nonEmpty g ->
      Pointwise g' : recalculations ds heads tails gs
  _ -> []
