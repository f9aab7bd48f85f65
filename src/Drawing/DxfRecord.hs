-- | Records of a DXF file: a pair with code 0 and the pairs after it up to the next one. An entity,
-- an entry of a table, and the beginning and the end of a section are records.
module Drawing.DxfRecord
  ( Record (..),
    fromPairs,

    -- * Values
    value,
    text,
    name,
    real,
    realOr,
    needed,
    reals,
    whole,
    wholeOr,
    groups,
  )
where

import Data.Bifunctor (first)
import Data.ByteString (ByteString)
import Data.List (find)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text.Encoding qualified as Encoding
import Drawing.CodePage (Encoding)
import Drawing.CodePage qualified as CodePage
import Drawing.DxfPair (Pair (..))
import Drawing.Error (DrawingFault (..), Error (Error))
import Drawing.Number qualified as Number

-- | A record.
data Record = Record
  { -- | number of the line of its word, or of the first value of a part of a record
    begin :: Int,
    -- | the value of its pair with code 0
    word :: Text,
    -- | pairs of the record after the first one
    pairs :: [Pair]
  }
  deriving stock (Eq, Show)

-- | The records of a file. An error if the first pair does not have the code 0.
fromPairs :: [Pair] -> Either Error [Record]
fromPairs = go []
  where
    go found rest = case rest of
      [] -> Right (reverse found)
      Pair {line, code, content} : more
        | code /= 0 -> Left (Error (line + 1) (Misplaced (latin content)))
        | otherwise ->
          let (own, others) = break (\Pair {code = other} -> other == 0) more
           in go (Record {begin = line + 1, word = latin content, pairs = own} : found) others

-- | The first pair of a record with a code.
value :: Int -> Record -> Maybe Pair
value wanted = find (\Pair {code} -> code == wanted) . pairs

-- | The value with a code as text of ASCII, such as the name of a header variable.
text :: Int -> Record -> Maybe Text
text wanted record = (\Pair {content} -> latin content) <$> value wanted record

-- | The name with a code, in the encoding of the file, if the record has it.
name :: Encoding -> Int -> Record -> Either Error (Maybe Text)
name encoding wanted record = traverse decoded (value wanted record)
  where
    decoded Pair {line, content} = first (Error (line + 1)) (CodePage.decode encoding content)

-- | The number with a code, if the record has it.
real :: Int -> Record -> Either Error (Maybe Double)
real wanted record = traverse realOf (value wanted record)

-- | The number with a code, or the given one if the record does not have it.
realOr :: Double -> Int -> Record -> Either Error Double
realOr standard wanted record = fromMaybe standard <$> real wanted record

-- | The number with a code, which the record must have.
needed :: Int -> Record -> Either Error Double
needed wanted record = maybe missing Right =<< real wanted record
  where
    missing = Left (Error (begin record) (ValueMissing (word record) wanted))

-- | All numbers with a code, in their order.
reals :: Int -> Record -> Either Error [Double]
reals wanted = traverse realOf . filter (\Pair {code} -> code == wanted) . pairs

realOf :: Pair -> Either Error Double
realOf Pair {line, content} =
  maybe (Left (Error (line + 1) (NotANumber (latin content)))) Right (Number.number (latin content))

-- | The whole number with a code, if the record has it: at most 10⁹ in size.
whole :: Int -> Record -> Either Error (Maybe Int)
whole wanted record = case value wanted record of
  Nothing -> Right Nothing
  Just pair@Pair {line, content} -> do
    x <- realOf pair
    let n = truncate x
    if abs x <= 1e9 && fromIntegral n == x
      then Right (Just n)
      else Left (Error (line + 1) (NotANumber (latin content)))

-- | The whole number with a code, or the given one if the record does not have it.
wholeOr :: Int -> Int -> Record -> Either Error Int
wholeOr standard wanted record = fromMaybe standard <$> whole wanted record

-- | The parts of a record that begin with the pairs of a code: the vertices of a polyline begin
-- with the code 10. The pairs before the first one are left out.
groups :: Int -> Record -> [Record]
groups wanted record = go (dropWhile isOther (pairs record))
  where
    isOther Pair {code} = code /= wanted
    go rest = case rest of
      [] -> []
      opening@Pair {line} : more ->
        let (own, others) = span isOther more
         in record {begin = line + 1, pairs = opening : own} : go others

-- | Bytes as text, each byte a character. The words and numbers of a file are ASCII.
latin :: ByteString -> Text
latin = Encoding.decodeLatin1
