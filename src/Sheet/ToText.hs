-- | Writer of input sheets, the forms of numbers that the Minsk-22 system reads. It writes a line
-- for each point and for each group of numbers, and an empty line before each piece.
--
-- A piece is a curve with its recalculations, each of which shifts the curve along its normal. The
-- cipher of a piece has a digit for each recalculation. A waypoint is a point with a feed. An array
-- is a sequence of linked pieces with the waypoints after them. An end mark @-0@ closes the
-- waypoints before an array, and the numbers of a piece.
--
-- 'Sheet.FromText.read' gives the same sheet again, except for the regions of its numbers.
module Sheet.ToText
  ( write,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Located (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isJust)
import Data.Text (Text)
import Data.Text qualified as Text
import Sheet.Sheet

-- | The text of a sheet.
write :: Sheet -> Text
write sheet =
  Text.unlines $
    generalData hasFeeds (general sheet)
      <> [""]
      <> map waypoint (NonEmpty.toList (approach sheet))
      <> ["-0"]
      <> concat
        (zipWith (array hasFeeds (length (others sheet))) [0 ..] (NonEmpty.toList (arrays sheet)))
  where
    hasFeeds = any (any (isJust . ownFeed) . pieces) (arrays sheet)

-- | The lines of the general data. @hasFeeds@ is True if every piece gives a feed.
generalData :: Bool -> General -> [Text]
generalData hasFeeds g =
  [ line [productCipher g, partCipher g, program g],
    line [diameter g, gear g, bevel g, height g],
    line [tolerance g] <> " " <> sideText (value (side g)),
    (if hasFeeds then "1" else "0") <> " 0 0 0 0 0 0"
  ]
  where
    sideText s = case s of
      Just LeftSide -> "1"
      Just RightSide -> "-1"
      Nothing -> "0"

waypoint :: Waypoint -> Text
waypoint w = line [x w, y w, z w, feed w]

-- | The lines of an array. @lastArray@ is the index of the sheet's last array, @number'@ that of
-- this array, both from 0. An end mark follows every array but the last.
array :: Bool -> Int -> Int -> Array -> [Text]
array hasFeeds lastArray number' a =
  concatMap (\(LinkedPiece p (Located _ l)) -> piece hasFeeds p (linkText l)) (joined a)
    <> piece hasFeeds (final a) "0"
    <> [""]
    <> map waypoint (NonEmpty.toList (retract a))
    <> ["-0" | number' < lastArray]

-- | The lines of a piece; @link@ is the text of its link. @hasFeeds@ is True if every piece gives a
-- feed. The sign of the first distance before the
-- points gives the side to which the piece is shifted: a minus means right. If there is no such
-- distance or it is 0, the sign of the cipher gives the side.
piece :: Bool -> Piece -> Text -> [Text]
piece hasFeeds p link =
  ["", cipherText]
    <> [line' signed | not (null heads)]
    <> map row (NonEmpty.toList (rows p))
    <> [line tails | not (null tails)]
    <> concatMap (map line . tens . NonEmpty.toList) given
    <> [if value (slow p) then "1" else "0", "-0", Text.unwords (link : map number left)]
  where
    left = [value (allowance p)] <> [maybe 0 value (ownFeed p) | hasFeeds]
    recalculations = value (cipher p)
    digits = Text.concat (map (digitText . digitOf) recalculations)
    heads = concatMap headOf recalculations
    tails = [t | Growing _ t <- recalculations]
    given = [g | Pointwise g <- recalculations]
    isRight = value (shiftSide p) == RightSide
    isSignedFirst = any ((/= 0) . value) (take 1 heads)
    cipherText
      | null recalculations = "0"
      | isRight && not isSignedFirst = "-" <> digits
      | otherwise = digits
    signed =
      case map value heads of
        h : others' | isRight && isSignedFirst -> negate h : others'
        distances -> distances
    line' = Text.unwords . map number

-- | The distance of a recalculation that the sheet has before the points; empty for digits 4 and 6.
headOf :: Recalculation -> [Number]
headOf r = case r of
  Growing h _ -> [h]
  Constant h -> [h]
  Bevelled -> []
  Pointwise _ -> []

row :: PointRow -> Text
row r = line ([px r, py r] <> maybe [] (\s -> [mu s, flangeHeight s]) (surface r))

linkText :: Link -> Text
linkText link = case link of
  Joint -> "+"
  Intersection -> "-"
  Rounding r -> (if r > 0 then "+" else "") <> number r

-- | Numbers on one line.
line :: [Number] -> Text
line = Text.unwords . map (number . value)

-- | A number with as many digits as determine it exactly.
number :: Double -> Text
number = Decimal.exact

-- | Splits a list into groups of ten; the last group may be shorter.
tens :: [a] -> [[a]]
tens list = case splitAt 10 list of
  ([], _) -> []
  (some, rest) -> some : tens rest
