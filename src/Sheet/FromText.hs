-- | A text of numbers into a sheet. Words that are no numbers are all reported; of what the numbers
-- mean, the first mistake, since everything behind it is shifted.
module Sheet.FromText
  ( read,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Located (..), Region (..))
import Base.Result (Result (..))
import Control.Monad (unless, when)
import Control.Monad.State.Strict (StateT, evalStateT, gets, lift, modify', put)
import Data.Either (lefts, rights)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Sheet.Error (Error (..), NumberPosition (..))
import Sheet.PieceFromWords qualified as PieceFromWords
import Sheet.Sheet
import Sheet.Word (SheetWord (..), WordValue (..), figure)
import Sheet.Word qualified as Word
import Prelude hiding (read)

-- | Read a sheet.
read :: Text -> Result w Error Sheet
read text
  | not (null (lefts found)) = Result [] (lefts found) Nothing
  | otherwise =
    either
      (\e -> Result [] [e] Nothing)
      (Result [] [] . Just)
      (evalStateT sheet (Before {left = rights found, final' = NumberPosition (Region 0 0) 1}))
  where
    found = Word.entries text

-- Reading

-- | What is still to be read, and the word that was read last.
data Before = Before {left :: [SheetWord], final' :: NumberPosition}

type Reader = StateT Before (Either Error)

refuse :: Error -> Reader a
refuse = lift . Left

-- | The next word, if there is one.
next :: Reader (Maybe SheetWord)
next = do
  before <- gets left
  case before of
    [] -> pure Nothing
    e : rest -> Just e <$ put Before {left = rest, final' = spot e}

peek :: Reader (Maybe SheetWord)
peek = gets (listToMaybe . left)

latest :: Reader NumberPosition
latest = gets final'

-- | The next word; at the end of the sheet, the complaint that something is expected.
needed :: Text -> Reader SheetWord
needed what = next >>= maybe (latest >>= \s -> refuse (EndMissing s what)) pure

-- | The words up to an end mark, and the mark.
upToMark :: Text -> Reader ([SheetWord], SheetWord)
upToMark what = do
  (inside, behind) <- gets (break ((== Mark) . symbol) . left)
  case behind of
    mark : rest -> (inside, mark) <$ put Before {left = rest, final' = spot mark}
    [] -> do
      mapM_ (\e -> modify' (\b -> b {final' = spot e})) (listToMaybe (reverse inside))
      latest >>= \s -> refuse (EndMissing s what)

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
    productCipher
      : partCipher
      : program
      : diameter
      : gear
      : bevel
      : height
      : tolerance
      : sideWord
      : reserve ->
        do
          mapM_
            (uncurry wholeNumber)
            [ ("the cipher of the product", productCipher),
              ("the cipher of the part", partCipher),
              ("the number of the program", program)
            ]
          mapM_
            ( \n ->
                wrong
                  n
                  "a word that is not used"
                  "The addresses 0101 to 0107 are not used and hold 0."
            )
            [n | n <- reserve, value (snd n) /= 0]
          when
            (value (snd diameter) <= 0)
            (wrong diameter "the diameter of the tool" "It is above 0.")
          when (value (snd tolerance) <= 0) (wrong tolerance "the tolerance" "It is above 0.")
          mapM_
            (\(what, n) -> when (value (snd n) < 0) (wrong n what "It is 0 or above."))
            [("the diameter of the wheel", gear), ("the height of the cone", height)]
          when
            (value (snd gear) /= 0)
            ( mapM_
                ( \n ->
                    when
                      (value (snd n) /= 0)
                      ( wrong
                          n
                          "a cone's dimension"
                          "A tool is a swivelling blade or a cone, not both."
                      )
                )
                [bevel, height]
            )
          when
            (value (snd bevel) == 0 && value (snd height) /= 0)
            (wrong height "the height of the cone" "A tool without a bevel is no cone.")
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
      unless
        ( value (snd n) >= 0
            && value (snd n) < 1e9
            && value (snd n) == fromInteger (round (value (snd n)))
        )
        $ wrong n what "It is a whole number of at most nine digits."
    sideOf n = case value (snd n) of
      1 -> pure (Located (region (snd n)) (Just LeftSide))
      -1 -> pure (Located (region (snd n)) (Just RightSide))
      0 -> pure (Located (region (snd n)) Nothing)
      _ ->
        wrong
          n
          "the side of the tool"
          "It is 1, left of the walk, -1, right of it, or 0, on the pieces themselves."

wrong :: (NumberPosition, Number) -> Text -> Text -> Reader a
wrong (s, _) what must = refuse (GeneralWrong s what must)

-- | One of the general data, counted from 1.
generalWord :: Int -> Reader (NumberPosition, Number)
generalWord count = do
  e <- next
  s <- latest
  maybe (refuse (GeneralShort s (count - 1))) (pure . (s,)) (e >>= figure)

-- | The points up to the first array, the first of which is where the cutter stands.
approachPoints :: Reader (NonEmpty Waypoint)
approachPoints = do
  (inside, mark) <- upToMark "the -0 behind the points of the approach"
  mapM_
    ( \e ->
        refuse (ApproachShifted (spot e) "A sign without a number is no coordinate and no feed.")
    )
    (filter Word.isSign inside)
  case fours [(spot e, n) | e <- inside, Just n <- [figure e]] of
    Just (p : ps) -> do
      mapM_
        ( \(s, w) ->
            when (value (feed w) <= 0) (refuse (ApproachShifted s "This feed is not above 0."))
        )
        (p : ps)
      working (NonEmpty.last (p :| ps))
      pure (fmap snd (p :| ps))
    Just [] -> refuse (ApproachShifted (spot mark) "There is no point at all.")
    Nothing ->
      refuse
        ( ApproachShifted
            (spot mark)
            ( "Before this -0 stand "
                <> Decimal.whole (length inside)
                <> " numbers, which is no whole number of points."
            )
        )

-- | The last point before an array: the spot of its feed.
working :: (NumberPosition, Waypoint) -> Reader ()
working (s, w) = when (value (feed w) == rapidFeed) (refuse (NoWorkingFeed s))

-- | Numbers by fours as points, each with the spot of its feed.
fours :: [(NumberPosition, Number)] -> Maybe [(NumberPosition, Waypoint)]
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

piecesOfArray :: Reader ([LinkedPiece], Piece)
piecesOfArray = do
  (one, link) <- piece
  case link of
    Nothing -> pure ([], one)
    Just l -> do
      (rest, final) <- piecesOfArray
      pure (LinkedPiece one l : rest, final)

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
onwardPoint :: Reader (NumberPosition, Waypoint)
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
        Just found ->
          maybe
            (refuse (OnwardShifted s "Here no coordinate and no feed stands."))
            pure
            (figure found)

-- Pieces

-- | A piece, and its link unless it is the last one of its array.
piece :: Reader (Piece, Maybe (Located Link))
piece = do
  opening <- needed "a piece, or the feed 0 of the last point"
  (negative, digits) <- either refuse pure (PieceFromWords.cipherOf opening)
  (inside, mark) <- upToMark "the -0 behind a piece"
  body <- either refuse pure (PieceFromWords.pieceOf opening negative digits inside mark)
  link <- linkOf =<< needed "the link of a piece"
  left' <- needed "the allowance of a piece"
  allowance <- maybe (refuse (LinkMissing (spot left') "allowance")) pure (figure left')
  pure (body {allowance}, link)

linkOf :: SheetWord -> Reader (Maybe (Located Link))
linkOf e = case symbol e of
  Figure 0 -> pure Nothing
  Figure r -> here (Rounding r)
  Plus -> here Joint
  Minus -> here Intersection
  Mark -> refuse (LinkMissing (spot e) "link")
  where
    here = pure . Just . Located (site (spot e))
