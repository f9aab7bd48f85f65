-- | Answers of the readers of drawings to any file: without an exception, and within bounded
-- allocations.
module Drawing.BoundedAnswer
  ( answers,
  )
where

import Control.Exception (AllocationLimitExceeded (..), SomeException, evaluate, fromException, try)
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.ByteString.Char8 qualified as Bytes
import Data.Int (Int64)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text qualified as Text
import Drawing.Drawing (Drawing (..), Entity (..), Remark (..))
import Drawing.Error (Error)
import Drawing.Error qualified as Error
import Drawing.ShapeCheck qualified as ShapeCheck
import System.Mem (disableAllocationLimit, enableAllocationLimit, setAllocationCounter)
import Test.QuickCheck (Property, counterexample, ioProperty, label)

-- | True if a reader answers to a file, and names only lines that the file has.
answers :: (ByteString -> Either (NonEmpty Error) Drawing) -> ByteString -> Property
answers reader bytes = ioProperty $ do
  setAllocationCounter (limit bytes)
  enableAllocationLimit
  answer <- try (evaluate (forceList (forced (reader bytes))))
  disableAllocationLimit
  pure $ case answer of
    Right lines'
      | null strange ->
        label (either (const "refused") (const "read") (reader bytes)) True
      | otherwise -> counterexample ("lines " <> show strange <> "\n" <> show bytes) False
      where
        strange = [l | l <- lines', l < 1 || l > count]
    Left e -> counterexample (cause e <> "\n" <> show bytes) False
  where
    count = 1 + Bytes.count '\n' bytes + Bytes.count '\r' bytes

-- | Bytes that a reader may allocate: 4 kB for each byte of the file, and 4 GB for the drawing with
-- the most parts that is allowed.
limit :: ByteString -> Int64
limit bytes = 4000 * fromIntegral (ByteString.length bytes) + 4000000000

cause :: SomeException -> String
cause e = case fromException e of
  Just AllocationLimitExceeded -> "allocates without bound"
  Nothing -> show e

-- | Computes all of an answer, and gives the lines that it names.
forced :: Either (NonEmpty Error) Drawing -> [Int]
forced answer = case answer of
  Left errors ->
    [ Error.line e
      | e <- NonEmpty.toList errors,
        Text.length (Error.title e <> Error.message e <> Text.concat (Error.hints e)) > 0
    ]
  Right Drawing {entities, remarks} ->
    [line | e@Entity {line} <- entities, size e > 0]
      <> [remarkLine | r@Remark {remarkLine} <- remarks, not (null (show r))]
  where
    size Entity {line, word, layer, identifiers, classes, shape} =
      line + Text.length word + Text.length layer + sum (map Text.length (identifiers <> classes))
        + ShapeCheck.size shape

-- | Computes a list with its elements.
forceList :: [Int] -> [Int]
forceList ns = sum ns `seq` ns
