-- | A text of numbers into a sheet. Words that are no numbers are all reported; of what the numbers mean, the
-- first mistake, since everything behind it is shifted.
module Sheet.FromText
  ( read,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Located (..), Region (..))
import Base.Result (Result (..))
import Control.Monad (unless, when)
import Control.Monad.State.Strict (StateT, evalStateT, gets, lift, modify', put)
import Data.Char (isSpace)
import Data.Either (lefts, rights)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Sheet.Error (Error (..), Misfit (..), Spot (..))
import Sheet.Sheet
import Prelude hiding (read)

-- | What a word of the sheet is.
data Symbol
  = Figure Double
  | -- | @-0@
    Mark
  | -- | a sign without digits
    Plus
  | Minus
  deriving stock (Eq, Show)

data Entry = Entry {spot :: Spot, symbol :: Symbol}

-- | Read a sheet.
read :: Text -> Result w Error Sheet
read text
  | not (null (lefts found)) = Result [] (lefts found) Nothing
  | otherwise = either (\e -> Result [] [e] Nothing) (Result [] [] . Just) (evalStateT sheet (Before {left = rights found, final' = Spot (Region 0 0) 1}))
  where
    found = zipWith entry [1 ..] (wordsOf text)

-- Words

-- | The words of a text with their places.
wordsOf :: Text -> [Located Text]
wordsOf = go 0
  where
    go at rest = case Text.break isSpace here of
      ("", _) -> []
      (word, after) -> Located (Region from (from + Text.length word)) word : go (from + Text.length word) after
      where
        here = Text.dropWhile isSpace rest
        from = at + Text.length rest - Text.length here

entry :: Int -> Located Text -> Either Error Entry
entry number (Located at word) = maybe (Left (NotANumber here word)) (Right . Entry here) $ case Text.uncons word of
  Just ('+', "") -> Just Plus
  Just ('-', "") -> Just Minus
  Just ('+', digits) -> Figure <$> Decimal.amount digits
  Just ('-', digits) -> (\x -> if x == 0 then Mark else Figure (negate x)) <$> Decimal.amount digits
  _ -> Figure <$> Decimal.amount word
  where
    here = Spot at number

-- Reading

-- | What is still to be read, and the word that was read last.
data Before = Before {left :: [Entry], final' :: Spot}

type Reader = StateT Before (Either Error)

refuse :: Error -> Reader a
refuse = lift . Left

-- | The next word, if there is one.
next :: Reader (Maybe Entry)
next = do
  before <- gets left
  case before of
    [] -> pure Nothing
    e : rest -> Just e <$ put Before {left = rest, final' = spot e}

peek :: Reader (Maybe Entry)
peek = gets (listToMaybe . left)

latest :: Reader Spot
latest = gets final'

-- | The next word; at the end of the sheet, the complaint that something is expected.
needed :: Text -> Reader Entry
needed what = next >>= maybe (latest >>= \s -> refuse (EndMissing s what)) pure

-- | The words up to an end mark, and the mark.
upToMark :: Text -> Reader ([Entry], Entry)
upToMark what = do
  (inside, behind) <- gets (break ((== Mark) . symbol) . left)
  case behind of
    mark : rest -> (inside, mark) <$ put Before {left = rest, final' = spot mark}
    [] -> do
      mapM_ (\e -> modify' (\b -> b {final' = spot e})) (listToMaybe (reverse inside))
      latest >>= \s -> refuse (EndMissing s what)

-- | A number with its place.
figure :: Entry -> Maybe Number
figure e = case symbol e of
  Figure x -> Just (Located (site (spot e)) x)
  Mark -> Nothing
  Plus -> Nothing
  Minus -> Nothing

-- Parts of the sheet

sheet :: Reader Sheet
sheet = do
  general <- generalData
  approach <- approachPoints
  (first, more) <- array 1
  others <- if more then furtherArrays 2 else pure []
  behind <- peek
  mapM_ (refuse . BehindTheEnd . spot) behind
  pure Sheet {general, approach, first, others}

furtherArrays :: Int -> Reader [Array]
furtherArrays count = do
  (one, more) <- array count
  (one :) <$> if more then furtherArrays (count + 1) else pure []

generalData :: Reader General
generalData = do
  given <- traverse generalWord [1 .. generalWords]
  case given of
    productCipher : partCipher : program : diameter : gear : bevel : height : tolerance : sideWord : reserve -> do
      mapM_ (uncurry wholeNumber) [("the cipher of the product", productCipher), ("the cipher of the part", partCipher), ("the number of the program", program)]
      mapM_ (\n -> wrong n "a word that is not used" "The addresses 0101 to 0107 are not used and hold 0.") [n | n <- reserve, value (snd n) /= 0]
      when (value (snd diameter) <= 0) (wrong diameter "the diameter of the tool" "It is above 0.")
      when (value (snd tolerance) <= 0) (wrong tolerance "the tolerance" "It is above 0.")
      mapM_ (\(what, n) -> when (value (snd n) < 0) (wrong n what "It is 0 or above.")) [("the diameter of the wheel", gear), ("the height of the cone", height)]
      when (value (snd gear) /= 0) (mapM_ (\n -> when (value (snd n) /= 0) (wrong n "a cone's dimension" "A tool is a swivelling blade or a cone, not both.")) [bevel, height])
      when (value (snd bevel) == 0 && value (snd height) /= 0) (wrong height "the height of the cone" "A tool without a bevel is no cone.")
      side <- sideOf sideWord
      pure
        General
          { productCipher = snd productCipher,
            partCipher = snd partCipher,
            program = snd program,
            diameter = snd diameter,
            gear = snd gear,
            bevel = snd bevel,
            height = snd height,
            tolerance = snd tolerance,
            side
          }
    _ -> latest >>= \s -> refuse (GeneralShort s (length given))
  where
    wholeNumber what n =
      unless (value (snd n) >= 0 && value (snd n) < 1e9 && value (snd n) == fromInteger (round (value (snd n)))) $
        wrong n what "It is a whole number of at most nine digits."
    sideOf n = case value (snd n) of
      1 -> pure (Located (region (snd n)) (Just LeftSide))
      -1 -> pure (Located (region (snd n)) (Just RightSide))
      0 -> pure (Located (region (snd n)) Nothing)
      _ -> wrong n "the side of the tool" "It is 1, left of the walk, -1, right of it, or 0, on the pieces themselves."

wrong :: (Spot, Number) -> Text -> Text -> Reader a
wrong (s, _) what must = refuse (GeneralWrong s what must)

-- | One of the general data, counted from 1.
generalWord :: Int -> Reader (Spot, Number)
generalWord count = do
  e <- next
  s <- latest
  maybe (refuse (GeneralShort s (count - 1))) (pure . (s,)) (e >>= figure)

-- | The points up to the first array, the first of which is where the cutter stands.
approachPoints :: Reader (NonEmpty Waypoint)
approachPoints = do
  (inside, mark) <- upToMark "the -0 behind the points of the approach"
  mapM_ (\e -> refuse (ApproachShifted (spot e) "A sign without a number is no coordinate and no feed.")) (filter ((`elem` [Plus, Minus]) . symbol) inside)
  case fours [(spot e, n) | e <- inside, Just n <- [figure e]] of
    Just (p : ps) -> do
      mapM_ (\(s, w) -> when (value (feed w) <= 0) (refuse (ApproachShifted s "This feed is not above 0."))) (p : ps)
      working (NonEmpty.last (p :| ps))
      pure (fmap snd (p :| ps))
    Just [] -> refuse (ApproachShifted (spot mark) "There is no point at all.")
    Nothing -> refuse (ApproachShifted (spot mark) ("Before this -0 stand " <> Decimal.whole (length inside) <> " numbers, which is no whole number of points."))

-- | The last point before an array: the spot of its feed.
working :: (Spot, Waypoint) -> Reader ()
working (s, w) = when (value (feed w) == rapidFeed) (refuse (NoWorkingFeed s))

-- | Numbers by fours as points, each with the spot of its feed.
fours :: [(Spot, Number)] -> Maybe [(Spot, Waypoint)]
fours numbers = case numbers of
  [] -> Just []
  (_, x) : (_, y) : (_, z) : (s, feed) : rest -> ((s, Waypoint {x, y, z, feed}) :) <$> fours rest
  _ -> Nothing

-- | The array with this number, and whether another one follows.
array :: Int -> Reader (Array, Bool)
array count = do
  begin <- peek
  when (count > mostArrays) (mapM_ (refuse . TooManyArrays . spot) begin)
  (joined, final) <- piecesOfArray
  (onward, more) <- onwardPoints
  pure (Array {joined, final, onward}, more)

piecesOfArray :: Reader ([Joined], Piece)
piecesOfArray = do
  (one, link) <- piece
  case link of
    Nothing -> pure ([], one)
    Just l -> do
      (rest, final) <- piecesOfArray
      pure (Joined one l : rest, final)

-- | The points behind an array, and whether another one follows.
onwardPoints :: Reader (NonEmpty Waypoint, Bool)
onwardPoints = go []
  where
    go before = do
      (s, point) <- onwardPoint
      let points = NonEmpty.reverse (point :| before)
      when (value (feed point) < 0) (refuse (OnwardShifted s "This feed is below 0."))
      behind <- peek
      case symbol <$> behind of
        _ | value (feed point) == 0 -> pure (points, False)
        Just Mark -> do
          working (s, point)
          (points, True) <$ next
        _ -> go (point : before)

-- | A point, and the spot of its feed.
onwardPoint :: Reader (Spot, Waypoint)
onwardPoint = do
  x <- coordinate
  y <- coordinate
  z <- coordinate
  feed <- coordinate
  s <- latest
  pure (s, Waypoint {x, y, z, feed})
  where
    coordinate = do
      e <- next
      s <- latest
      case e of
        Nothing -> refuse (OnwardShifted s "The sheet ends here, and no feed was 0.")
        Just found -> maybe (refuse (OnwardShifted s "Here no coordinate and no feed stands.")) pure (figure found)

-- Pieces

-- | A piece, and its link unless it is the last one of its array.
piece :: Reader (Piece, Maybe (Located Link))
piece = do
  opening <- needed "a piece, or the feed 0 of the last point"
  (negative, digits) <- cipherOf opening
  (inside, mark) <- upToMark "the -0 behind a piece"
  body <- either refuse pure (pieceOf opening negative digits inside mark)
  link <- linkOf =<< needed "the link of a piece"
  left' <- needed "the allowance of a piece"
  allowance <- maybe (refuse (LinkMissing (spot left') "allowance")) pure (figure left')
  pure (body {allowance}, link)

linkOf :: Entry -> Reader (Maybe (Located Link))
linkOf e = case symbol e of
  Figure 0 -> pure Nothing
  Figure r -> here (Rounding r)
  Plus -> here Joint
  Minus -> here Intersection
  Mark -> refuse (LinkMissing (spot e) "link")
  where
    here = pure . Just . Located (site (spot e))

-- | The digits of a cipher, and whether it has a minus sign.
cipherOf :: Entry -> Reader (Bool, [Digit])
cipherOf e = case symbol e of
  Figure 0 -> pure (False, [])
  Figure c | abs c == fromInteger (round c') && c' < 1e9 -> (c < 0,) <$> traverse digit (show (round c' :: Int))
    where
      c' = abs c
  Figure _ -> unknown "A cipher is a whole number of at most nine digits."
  Mark -> unknown "Here stands an end mark; a piece begins with its cipher."
  Plus -> unknown "Here stands a sign without a number; a piece begins with its cipher."
  Minus -> unknown "Here stands a sign without a number; a piece begins with its cipher."
  where
    unknown why = refuse (CipherUnknown (spot e) why)
    digit c = case c of
      '1' -> pure One
      '2' -> pure Two
      '4' -> pure Four
      '6' -> pure Six
      _ -> unknown ("It has the digit " <> Text.singleton c <> ".")

-- | The data of a piece: its cipher, the words up to the end mark, the mark. It has no allowance yet.
pieceOf :: Entry -> Bool -> [Digit] -> [Entry] -> Entry -> Either Error Piece
pieceOf opening negative digits inside mark = do
  mapM_ (\e -> Left (PieceMisfit (spot e) (spot opening) LoneSign)) (filter ((`elem` [Plus, Minus]) . symbol) inside)
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
    Left (CipherUnknown (spot opening) "The sign before the first distance says the side; a cipher has a minus sign only where there is no such distance.")
  slow <- maybe (Left (misfitAt (maybe (spot mark) spot (listToMaybe (reverse inside))) FlagOff)) Right (listToMaybe flag >>= flagOf)
  rows <- maybe (misfit PointsFew) Right (NonEmpty.nonEmpty (map row (groups each body)))
  let heads' = zipWith (\k h -> if k == (0 :: Int) then fmap abs h else h) [0 ..] heads
  pure
    Piece
      { towards = Located (site (spot opening)) (if right then RightSide else LeftSide),
        cipher = Located (site (spot opening)) (recalculations digits heads' tails (groups points given)),
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
    misfit :: Misfit -> Either Error a
    misfit = Left . misfitAt (spot mark)
    flagOf n = case value n of
      0 -> Just (False <$ n)
      1 -> Just (True <$ n)
      _ -> Nothing

row :: [Number] -> Row
row numbers = case numbers of
  [px, py, mu, flange] -> Row {px, py, surface = Just Surface {mu, flange}}
  px : py : _ -> Row {px, py, surface = Nothing}
  _ -> Row {px = nowhere, py = nowhere, surface = Nothing}
  where
    -- Groups are of two or of four.
    nowhere = Located (Region 0 0) 0

-- | Stretches of one length.
groups :: Int -> [a] -> [[a]]
groups size list = case splitAt size list of
  ([], _) -> []
  (one, rest) -> one : groups size rest

-- | The recalculations of a cipher: its digits, the distances before the points, those behind them, those for
-- each point.
recalculations :: [Digit] -> [Number] -> [Number] -> [[Number]] -> [Recalculation]
recalculations digits heads tails given = case (digits, heads, tails, given) of
  (One : ds, h : hs, t : ts, _) -> Growing h t : recalculations ds hs ts given
  (Two : ds, h : hs, _, _) -> Constant h : recalculations ds hs tails given
  (Four : ds, _, _, _) -> Bevelled : recalculations ds heads tails given
  (Six : ds, _, _, g : gs) | Just g' <- NonEmpty.nonEmpty g -> Pointwise g' : recalculations ds heads tails gs
  _ -> []
