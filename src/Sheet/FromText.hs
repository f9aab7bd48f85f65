-- | Reader of input sheets: makes a sheet from its text.
--
-- A sheet has the general data, the points of the approach, and arrays of pieces. After each array
-- come points to which the tool moves. A piece is a curve with a cipher, which is a number. Each
-- digit of the cipher names a recalculation, which shifts the curve along its normal. The end mark
-- is the word @-0@.
--
-- The reader reports all words that are neither numbers nor signs nor end marks. If there are none,
-- it reports only the first mistake, because a number that is missing or written twice shifts the
-- meaning of all later numbers. The reader is a state monad over the words still to be read.
module Sheet.FromText
  ( read,
  )
where

import Base.Region (Located (..), Region (..))
import Base.Result (Result (..))
import Control.Monad (forM_, unless, when)
import Control.Monad.State.Strict (StateT, evalStateT, gets, lift, modify')
import Data.Either (lefts, rights)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Sheet.Error
  ( ApproachFault (..),
    Error (..),
    Expected (..),
    GeneralFault (..),
    LinkNumber (..),
    NumberPosition (..),
    RetractFault (..),
  )
import Sheet.PieceFromWords qualified as PieceFromWords
import Sheet.Sheet
import Sheet.Word (SheetWord (..), WordValue (..), figure)
import Sheet.Word qualified as Word
import Prelude hiding (read)

-- | The sheet that a text describes.
read :: Text -> Result w Error Sheet
read text
  | not (null (lefts found)) = Result [] (lefts found) Nothing
  | otherwise =
    either
      (\e -> Result [] [e] Nothing)
      (Result [] [] . Just)
      ( evalStateT
          sheet
          ( Input
              { unread = rights found,
                last' = NumberPosition (Region 0 0) 1,
                piecesHaveFeeds = False
              }
          )
      )
  where
    found = Word.entries text

-- Reading

-- | The words that are still to be read, and the position of the last word that was read.
-- @piecesHaveFeeds@ is True if the general data say that every piece gives a feed.
data Input = Input {unread :: [SheetWord], last' :: NumberPosition, piecesHaveFeeds :: Bool}

type Reader = StateT Input (Either Error)

-- | Stops reading with an error.
refuse :: Error -> Reader a
refuse = lift . Left

-- | Reads a word; Nothing at the end of the sheet.
next :: Reader (Maybe SheetWord)
next = do
  input <- gets unread
  case input of
    [] -> pure Nothing
    e : rest -> Just e <$ modify' (\b -> b {unread = rest, last' = position e})

-- | The next word, which stays unread; Nothing at the end of the sheet.
peek :: Reader (Maybe SheetWord)
peek = gets (listToMaybe . unread)

-- | The position of the last word that was read.
latest :: Reader NumberPosition
latest = gets last'

-- | Reads a word. At the end of the sheet it fails with the error that @expected@ is missing.
needed :: Expected -> Reader SheetWord
needed expected = next >>= maybe (latest >>= \s -> refuse (EndMissing s expected)) pure

-- | Reads the words before the next end mark, and the mark. Without a further mark it fails with
-- the error that @expected@ is missing.
upToMark :: Expected -> Reader ([SheetWord], SheetWord)
upToMark expected = do
  (inside, rest) <- gets (break ((== Mark) . symbol) . unread)
  case rest of
    mark : others -> (inside, mark) <$ modify' (\b -> b {unread = others, last' = position mark})
    [] -> do
      mapM_ (\e -> modify' (\b -> b {last' = position e})) (listToMaybe (reverse inside))
      latest >>= \s -> refuse (EndMissing s expected)

-- Parts of the sheet

sheet :: Reader Sheet
sheet = do
  general <- generalData
  approach <- approachPoints
  (first, hasMore) <- array 1
  others <- if hasMore then furtherArrays 2 else pure []
  remainder <- peek
  mapM_ (refuse . AfterTheEnd . position) remainder
  pure Sheet {general, approach, first, others}

-- | Reads the arrays from number @count@ on; the first array of the sheet has number 1.
furtherArrays :: Int -> Reader [Array]
furtherArrays count = do
  (one, hasMore) <- array count
  (one :) <$> if hasMore then furtherArrays (count + 1) else pure []

-- General data

-- | A number with its position.
type Positioned = (NumberPosition, Number)

generalData :: Reader General
generalData = do
  given <- traverse generalWord [1 .. generalCount]
  case given of
    product'
      : part'
      : program'
      : diameter'
      : gear'
      : bevel'
      : height'
      : tolerance'
      : sideWord
      : feedsWord
      : unused ->
        do
          check ProductCipherNotWhole isWhole product'
          check PartCipherNotWhole isWhole part'
          check ProgramNotWhole isWhole program'
          mapM_ (check UnusedWord (== 0)) unused
          check DiameterNotPositive (> 0) diameter'
          check ToleranceNotPositive (> 0) tolerance'
          checkTool gear' bevel' height'
          side <- sideOf sideWord
          check UnknownFeeds (`elem` [0, 1]) feedsWord
          modify' (\b -> b {piecesHaveFeeds = value (snd feedsWord) == 1})
          pure
            General
              { productCipher = snd product',
                partCipher = snd part',
                program = snd program',
                diameter = snd diameter',
                gear = snd gear',
                bevel = snd bevel',
                height = snd height',
                tolerance = snd tolerance',
                side
              }
    _ -> latest >>= \s -> refuse (GeneralShort s (length given))
  where
    isWhole x = x >= 0 && x < 1e9 && x == fromInteger (round x)

-- | Checks the diameter of a swivelling blade's wheel, and the bevel and the height of a cone. The
-- diameter and the height must not be negative. If the diameter is not 0, the tool is a blade, so
-- the bevel and the height must be 0. If the bevel is 0, the tool is no cone, so the height must
-- be 0.
checkTool :: Positioned -> Positioned -> Positioned -> Reader ()
checkTool gear' bevel' height' = do
  check NegativeGear (>= 0) gear'
  check NegativeHeight (>= 0) height'
  when (value (snd gear') /= 0) (mapM_ (check BladeWithCone (== 0)) [bevel', height'])
  when (value (snd bevel') == 0) (check HeightWithoutBevel (== 0) height')

-- | Fails with @fault@ if the predicate is False for a number of the general data.
check :: GeneralFault -> (Double -> Bool) -> Positioned -> Reader ()
check fault isRight (s, n) = unless (isRight (value n)) (refuse (GeneralWrong s fault))

sideOf :: Positioned -> Reader (Located (Maybe Side))
sideOf (s, n) = case value n of
  1 -> pure (Located (region n) (Just LeftSide))
  -1 -> pure (Located (region n) (Just RightSide))
  0 -> pure (Located (region n) Nothing)
  _ -> refuse (GeneralWrong s UnknownSide)

-- | Reads number @count@ of the general data, counted from 1. Fails if the sheet ends before it, or
-- if the word is a mark or a sign.
generalWord :: Int -> Reader Positioned
generalWord count = do
  e <- next
  s <- latest
  maybe (refuse (GeneralShort s (count - 1))) (pure . (s,)) (e >>= figure)

-- Points

-- | Reads the points up to the first array; the first one is the cutter's starting position.
approachPoints :: Reader (NonEmpty Waypoint)
approachPoints = do
  (inside, mark) <- upToMark MarkAfterApproach
  mapM_ (refuse . (`ApproachShifted` SignInApproach) . position) (filter Word.isSign inside)
  case fours [(position e, n) | e <- inside, Just n <- [figure e]] of
    Just (p : ps) -> do
      forM_ (p : ps) $ \(s, w) ->
        when (value (feed w) <= 0) (refuse (ApproachShifted s ApproachFeedNotPositive))
      checkWorkingFeed (NonEmpty.last (p :| ps))
      pure (fmap snd (p :| ps))
    Just [] -> refuse (ApproachShifted (position mark) NoApproachPoint)
    Nothing -> refuse (ApproachShifted (position mark) (ApproachCount (length inside)))

-- | Fails if the last point before an array has the rapid feed. The position is that of the feed.
checkWorkingFeed :: (NumberPosition, Waypoint) -> Reader ()
checkWorkingFeed (s, w) = when (value (feed w) == rapidFeed) (refuse (NoWorkingFeed s))

-- | Makes points of groups of four numbers; each point has the position of its feed. Nothing if the
-- count of numbers is not a multiple of four.
fours :: [Positioned] -> Maybe [(NumberPosition, Waypoint)]
fours numbers = case numbers of
  [] -> Just []
  (_, x) : (_, y) : (_, z) : (s, feed) : rest -> ((s, Waypoint {x, y, z, feed}) :) <$> fours rest
  _ -> Nothing

-- | Reads the points after an array. The Bool is True if another array follows.
retractPoints :: Reader (NonEmpty Waypoint, Bool)
retractPoints = go []
  where
    go before = do
      (s, point) <- retractPoint
      let points = NonEmpty.reverse (point :| before)
      when (value (feed point) < 0) (refuse (RetractShifted s NegativeFeed))
      following <- peek
      case symbol <$> following of
        _ | value (feed point) == 0 -> pure (points, False)
        Just Mark -> do
          checkWorkingFeed (s, point)
          (points, True) <$ next
        _ -> go (point : before)

-- | Reads one point after an array. The position is that of its feed.
retractPoint :: Reader (NumberPosition, Waypoint)
retractPoint = do
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
        Nothing -> refuse (RetractShifted s NoLastFeed)
        Just found -> maybe (refuse (RetractShifted s NotACoordinate)) pure (figure found)

-- Arrays and pieces

-- | Reads array @count@, counted from 1. The Bool is True if another array follows.
array :: Int -> Reader (Array, Bool)
array count = do
  begin <- peek
  when (count > maxArrays) (mapM_ (refuse . TooManyArrays . position) begin)
  (joined, final) <- piecesOfArray
  (retract, hasMore) <- retractPoints
  pure (Array {joined, final, retract}, hasMore)

-- | Reads the pieces of an array: all but the last one, each with its link, and the last one.
piecesOfArray :: Reader ([LinkedPiece], Piece)
piecesOfArray = do
  (one, link) <- piece
  case link of
    Nothing -> pure ([], one)
    Just l -> do
      (rest, final) <- piecesOfArray
      pure (LinkedPiece one l : rest, final)

-- | Reads a piece and its link to the next piece. The link is Nothing after the last piece of an
-- array.
piece :: Reader (Piece, Maybe (Located Link))
piece = do
  opening <- needed PieceOrLastFeed
  (isNegative, digits) <- either refuse pure (PieceFromWords.cipherOf opening)
  (inside, mark) <- upToMark MarkAfterPiece
  body <- either refuse pure (PieceFromWords.pieceOf opening isNegative digits inside mark)
  link <- linkOf =<< needed LinkOfPiece
  allowanceWord <- needed AllowanceOfPiece
  allowance <-
    maybe
      (refuse (LinkMissing (position allowanceWord) AllowanceNumber))
      pure
      (figure allowanceWord)
  hasFeed <- gets piecesHaveFeeds
  ownFeed <- if hasFeed then pieceFeed else pure Nothing
  pure (body {allowance, ownFeed}, link)

-- | Reads the feed of a piece. It is Nothing for 0, which means the feed of the array's pieces.
pieceFeed :: Reader (Maybe Number)
pieceFeed = do
  e <- needed FeedOfPiece
  case figure e of
    Just n
      | value n == 0 -> pure Nothing
      | value n > 0 && value n < rapidFeed -> pure (Just n)
    _ -> refuse (LinkMissing (position e) FeedNumber)

-- | The link that a word means. Nothing for the number 0, which ends an array.
linkOf :: SheetWord -> Reader (Maybe (Located Link))
linkOf e = case symbol e of
  Figure 0 -> pure Nothing
  Figure r -> here (Rounding r)
  Plus -> here Joint
  Minus -> here Intersection
  Mark -> refuse (LinkMissing (position e) LinkNumber)
  where
    here = pure . Just . Located (site (position e))
