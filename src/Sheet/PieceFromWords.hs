-- | The words of one piece into what they mean. How many there are follows from its cipher.
module Sheet.PieceFromWords
  ( cipherOf,
    pieceOf,
  )
where

import Base.Region (Located (..), Region (..))
import Control.Monad (when)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)
import Data.Text qualified as Text
import Sheet.Error (Error (..), NumberPosition (..), PieceMisfit (..))
import Sheet.Sheet
import Sheet.Word (SheetWord (..), WordValue (..), figure, isSign)

-- | The digits of a cipher, and whether it has a minus sign.
cipherOf :: SheetWord -> Either Error (Bool, [Digit])
cipherOf e = case symbol e of
  Figure 0 -> pure (False, [])
  Figure c
    | abs c == fromInteger (round c') && c' < 1e9 ->
      (c < 0,) <$> traverse digit (show (round c' :: Int))
    where
      c' = abs c
  Figure _ -> unknown "A cipher is a whole number of at most nine digits."
  Mark -> unknown "Here stands an end mark; a piece begins with its cipher."
  Plus -> unknown "Here stands a sign without a number; a piece begins with its cipher."
  Minus -> unknown "Here stands a sign without a number; a piece begins with its cipher."
  where
    unknown why = Left (CipherUnknown (spot e) why)
    digit c = case c of
      '1' -> pure One
      '2' -> pure Two
      '4' -> pure Four
      '6' -> pure Six
      _ -> unknown ("It has the digit " <> Text.singleton c <> ".")

-- | The data of a piece: its cipher, the words up to the end mark, the mark. It has no allowance
-- yet.
pieceOf :: SheetWord -> Bool -> [Digit] -> [SheetWord] -> SheetWord -> Either Error Piece
pieceOf opening negative digits inside mark = do
  mapM_ (\e -> Left (PieceMisfit (spot e) (spot opening) LoneSign)) (filter isSign inside)
  let numbers = [n | e <- inside, Just n <- [figure e]]
      count = length numbers
      (points, odd') = (count - before - behind - 1) `divMod` (each + again)
  when (odd' /= 0) (misfit (CountOff before each behind again count))
  when (points < 2) (misfit PointsFew)
  let (heads, afterHeads) = splitAt before numbers
      (body, afterBody) = splitAt (points * each) afterHeads
      (tails, afterTails) = splitAt behind afterBody
      (given, flag) = splitAt (points * again) afterTails
      right = negative || any ((< 0) . value) (take 1 heads)
  when (negative && any ((/= 0) . value) (take 1 heads)) $
    Left
      ( CipherUnknown
          (spot opening)
          "The sign before the first distance says the side; a cipher has a minus sign only where \
          \there is no such distance."
      )
  slow <-
    maybe
      (Left (misfitAt (maybe (spot mark) spot (listToMaybe (reverse inside))) FlagOff))
      Right
      (listToMaybe flag >>= flagOf)
  rows <- maybe (misfit PointsFew) Right (NonEmpty.nonEmpty (map row (groups each body)))
  let heads' = zipWith (\k h -> if k == (0 :: Int) then fmap abs h else h) [0 ..] heads
  pure
    Piece
      { towards = Located (site (spot opening)) (if right then RightSide else LeftSide),
        cipher =
          Located (site (spot opening)) (recalculations digits heads' tails (groups points given)),
        rows,
        slow,
        allowance = Located (site (spot mark)) 0
      }
  where
    before = length (filter (`elem` [One, Two]) digits)
    each = if Four `elem` digits then 4 else 2
    behind = length (filter (== One) digits)
    again = length (filter (== Six) digits)
    misfitAt s = PieceMisfit s (spot opening)
    misfit :: PieceMisfit -> Either Error a
    misfit = Left . misfitAt (spot mark)
    flagOf n = case value n of
      0 -> Just (False <$ n)
      1 -> Just (True <$ n)
      _ -> Nothing

row :: [Number] -> PointRow
row numbers = case numbers of
  [px, py, mu, flange] -> PointRow {px, py, surface = Just Surface {mu, flange}}
  px : py : _ -> PointRow {px, py, surface = Nothing}
  _ -> PointRow {px = nowhere, py = nowhere, surface = Nothing}
  where
    -- Groups are of two or of four.
    nowhere = Located (Region 0 0) 0

-- | Stretches of one length.
groups :: Int -> [a] -> [[a]]
groups size list = case splitAt size list of
  ([], _) -> []
  (one, rest) -> one : groups size rest

-- | The recalculations of a cipher: its digits, the distances before the points, those behind them,
-- those for each point.
recalculations :: [Digit] -> [Number] -> [Number] -> [[Number]] -> [Recalculation]
recalculations digits heads tails given = case (digits, heads, tails, given) of
  (One : ds, h : hs, t : ts, _) -> Growing h t : recalculations ds hs ts given
  (Two : ds, h : hs, _, _) -> Constant h : recalculations ds hs tails given
  (Four : ds, _, _, _) -> Bevelled : recalculations ds heads tails given
  (Six : ds, _, _, g : gs)
    | Just g' <- NonEmpty.nonEmpty g ->
      Pointwise g' : recalculations ds heads tails gs
  _ -> []
