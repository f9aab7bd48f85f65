-- | Answer to the request @rows@: the meanings of rows of a tape.
module Preview.TapeMeaning
  ( rowList,
  )
where

import Base.LazyList qualified as LazyList
import Data.Aeson (Value, object, (.=))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Preview.TapeRun (TapeRun (..))
import Tape.Punch (TapeFrame (frameRead, rowsRead))
import Tape.Punch qualified as Punch
import Tape.RowMeaning (Row (frame, meaning))

-- | Meanings of the rows from an index to another one, at most 'mostRows'; none for a text.
rowList :: TapeRun -> Int -> Int -> [Value]
rowList played from to = case text played of
  Just _ -> []
  Nothing ->
    [ object ["row" .= n, "meaning" .= words', "frame" .= fmap (subtract 1) number]
      | (n, (number, words')) <- take count (drop first (zip [0 :: Int ..] (meanings played)))
    ]
  where
    first = max 0 from
    count = min mostRows (max 0 (to - first))

-- | Greatest count of rows in an answer.
mostRows :: Int
mostRows = 500

-- | Number of the frame and meaning of each row. The rows of a frame that was read are those that
-- would be written for it, aligned at its end: a tape from elsewhere may have more blank rows
-- before a frame.
meanings :: TapeRun -> [(Maybe Int, Text)]
meanings TapeRun {machine, start, rows} = aligned (map rowsRead read') groups
  where
    read' = LazyList.toList (Punch.readInTurn machine start rows)
    groups = case NonEmpty.groupBy same (Punch.rows machine start (map frameRead read')) of
      leader : first : more
        | Nothing <- frame (NonEmpty.head leader) -> (leader <> first) : more
      other -> other
    same a b = frame a == frame b
    aligned counts written = case (counts, written) of
      (n : more, group : others) ->
        let own = [(frame r, meaning r) | r <- NonEmpty.toList group]
            size = length own
         in replicate (n - size) (Nothing, "") <> drop (size - n) own <> aligned more others
      ([], trailer : others) ->
        [(frame r, meaning r) | r <- NonEmpty.toList trailer] <> aligned [] others
      (_, []) -> []
