-- | Reader of the containers that the preview sends, for tests: as the page reads them.
module Preview.Answer
  ( Answer,
    decode,
    member,
    reals,
    wholes,
    followedFile,
    running,
  )
where

import Base.Result (Result (..))
import Data.Aeson (FromJSON, Value (..))
import Data.Aeson qualified as Aeson
import Data.Aeson.Key qualified as Key
import Data.Aeson.KeyMap qualified as KeyMap
import Data.Bits (shiftL, (.|.))
import Data.ByteString.Lazy (ByteString)
import Data.ByteString.Lazy qualified as ByteString
import Data.Int (Int32, Int64)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.IO qualified as Text
import Data.Word (Word64)
import GHC.Float (castWord64ToDouble)
import Preview.Subject (Followed)
import Preview.Subject qualified as Subject
import Preview.TapeRun (TapeRun)
import Preview.TapeRun qualified as TapeRun
import Project.LoadedProgram qualified as LoadedProgram

-- | Header and the bytes behind it.
data Answer = Answer {header :: Aeson.Object, body :: ByteString}

-- | Reads a container.
decode :: ByteString -> Answer
decode bytes = case Aeson.decode (ByteString.take size (ByteString.drop 8 bytes)) of
  Just header -> Answer {header, body = ByteString.drop (8 + size) bytes}
  Nothing -> error "the header is no JSON"
  where
    size = fromIntegral (number (ByteString.take 4 bytes)) :: Int64

-- | Member of the header.
member :: FromJSON a => Text -> Answer -> a
member name answer = case Aeson.fromJSON found of
  Aeson.Success a -> a
  Aeson.Error why -> error (Text.unpack name <> ": " <> why)
  where
    found = fromMaybe Null (KeyMap.lookup (Key.fromText name) (header answer))

-- | Array of floating-point numbers.
reals :: Text -> Answer -> [Double]
reals name answer = map (castWord64ToDouble . number) (pieces 8 (bytesOf "f64" 8 name answer))

-- | Array of whole numbers.
wholes :: Text -> Answer -> [Int]
wholes name answer =
  [ fromIntegral (fromIntegral (number piece) :: Int32)
    | piece <- pieces 4 (bytesOf "i32" 4 name answer)
  ]

bytesOf :: Text -> Int64 -> Text -> Answer -> ByteString
bytesOf kind size name answer = case KeyMap.lookup (Key.fromText name) arrays of
  Just (Object entry)
    | Just (String kind) == KeyMap.lookup "type" entry ->
      ByteString.take
        (size * field "length" entry)
        (ByteString.drop (field "offset" entry) (body answer))
  _ -> error ("no array " <> Text.unpack name)
  where
    arrays = member "arrays" answer :: Aeson.Object
    field key entry = case Aeson.fromJSON (fromMaybe Null (KeyMap.lookup key entry)) of
      Aeson.Success n -> n
      Aeson.Error why -> error why

pieces :: Int64 -> ByteString -> [ByteString]
pieces size bytes
  | ByteString.null bytes = []
  | otherwise = let (a, more) = ByteString.splitAt size bytes in a : pieces size more

-- | Number from its bytes, the least significant one first.
number :: ByteString -> Word64
number = ByteString.foldr (\w n -> n `shiftL` 8 .|. fromIntegral w) 0

-- | State of the preview after it has read a program from a file.
followedFile :: FilePath -> IO Followed
followedFile file = do
  text <- Text.readFile file
  let name = Text.pack file
  pure
    ( Subject.following
        []
        (LoadedProgram.fromText name text)
        (Subject.nothingYet name Nothing)
    )

-- | Tape of the state for a machine.
running :: Text -> Followed -> IO TapeRun
running machine followed = case Subject.sound followed of
  Just (_, subject) -> case TapeRun.fromSound subject machine of
    Result {errors = [], output = Just run} -> pure run
    result -> fail (show (errors result))
  Nothing -> fail "the program has mistakes"
