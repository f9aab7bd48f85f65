-- | Reads fonts: letters as chains of lines and arcs. @fonts/README.md@ describes the format.
module Font.FromText
  ( read,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..), minus)
import Control.Monad (foldM, guard)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Font.Font (Font, Letter (..))
import Geometry.Carrier (Sense (..))
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Prelude hiding (read)

-- | The part of a font that is read so far.
data State = State
  { -- | the height of the capitals in the unit of the file; 'Nothing' before its line
    height :: Maybe Double,
    -- | the gap between letters in this unit; 'Nothing' before its line
    gap :: Maybe Double,
    -- | the character of the letter to which the next stroke belongs
    current :: Maybe Char,
    known :: Font
  }

-- | Reads a font. 'Left' is the number of the first line that is wrong, from 1.
read :: Text -> Either Int Font
read content = known <$> foldM step (State Nothing Nothing Nothing Map.empty) numbered
  where
    numbered = zip [1 ..] (Text.lines content)
    step state (n, line) = maybe (Left n) Right (afterLine state line)

-- | The state after a line; 'Nothing' if the line is wrong.
afterLine :: State -> Text -> Maybe State
afterLine state line
  | "--" `Text.isPrefixOf` line || Text.null (Text.strip line) = Just state
  | " " `Text.isPrefixOf` line = withStroke state (Text.words line)
  | otherwise = case Text.words line of
    ["height", h] -> (\x -> state {height = Just x}) <$> positive h
    ["gap", g] -> (\x -> state {gap = Just x}) <$> Decimal.parse g
    ["letter", name, "width", w] -> do
      c <- characterOf name
      guard (Map.notMember c (known state))
      unit <- recip <$> height state
      total <- (+) <$> positive w <*> gap state
      Just
        state
          { current = Just c,
            known = Map.insert c (Letter (Mm (total * unit)) []) (known state)
          }
    _ -> Nothing
  where
    positive word = Decimal.parse word >>= \x -> x <$ guard (x > 0)

-- | The character of a letter by its name.
characterOf :: Text -> Maybe Char
characterOf name = case Text.unpack name of
  "space" -> Just ' '
  [c] -> Just c
  _ -> Nothing

-- | The state with one more stroke of the current letter.
withStroke :: State -> [Text] -> Maybe State
withStroke state written = do
  c <- current state
  unit <- recip <$> height state
  side <- (/ 2) <$> gap state
  let position word = pointOf word >>= \(x, y) -> Just (Vec.point ((x + side) * unit) (y * unit))
  stroke <- case written of
    first : rest -> position first >>= \p -> segmentsFrom position p rest >>= polyarc
    [] -> Nothing
  let added l = l {strokes = strokes l <> [stroke]}
  Just state {known = Map.adjust added c (known state)}

-- | The segments of a stroke from a point on. @position@ reads a point.
segmentsFrom :: (Text -> Maybe Point) -> Point -> [Text] -> Maybe [Segment]
segmentsFrom position from written = case written of
  [] -> Just []
  "cw" : to : "about" : centre : rest -> arc Clockwise to centre rest
  "ccw" : to : "about" : centre : rest -> arc CounterClockwise to centre rest
  to : rest -> do
    p <- position to
    guard (p /= from)
    (Straight from p :) <$> segmentsFrom position p rest
  where
    arc sense to centre rest = do
      p <- position to
      m <- position centre
      let Mm difference = minus (Vec.distance m p) (Vec.distance m from)
      guard (p /= from && abs difference <= Tolerance.equal)
      (Segment.arc sense m from p :) <$> segmentsFrom position p rest

-- | The stroke of these segments, closed if it ends where it begins.
polyarc :: [Segment] -> Maybe Polyarc
polyarc found = do
  segments <- NonEmpty.nonEmpty found
  let first :| _ = segments
      ends = if Segment.end (NonEmpty.last segments) == Segment.start first then Closed else Open
  Just Polyarc {ends, segments}

-- | The two numbers of a point.
pointOf :: Text -> Maybe (Double, Double)
pointOf word = case Text.splitOn "," word of
  [x, y] -> (,) <$> signed x <*> signed y
  _ -> Nothing
  where
    signed number = case Text.stripPrefix "-" number of
      Just size -> negate <$> Decimal.parse size
      Nothing -> Decimal.parse number
