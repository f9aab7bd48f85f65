-- | Text of a DXF file from its bytes: the encoding of the file, and the escapes in names.
module Drawing.CodePage
  ( Encoding,
    fromHeader,
    decode,
    singleBytes,
  )
where

import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.Char (chr, isDigit, isHexDigit)
import Data.Maybe (fromMaybe, mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Data.Text.Read qualified as Read
import Data.Vector.Unboxed (Vector)
import Data.Vector.Unboxed qualified as Vector
import Drawing.CodePageTable qualified as CodePageTable
import Drawing.Error (DrawingFault (..))

-- | The encoding of the names of a DXF file.
data Encoding
  = Utf8
  | -- | the characters of the bytes from 128 on
    SingleByte Text (Vector Char)
  | -- | a code page that is not in 'CodePageTable.upperHalf'
    Unknown Text
  | -- | UTF-8, or windows-1252 for a name that is not UTF-8: the file states no code page
    NotStated

-- | The encoding by the header variables @$ACADVER@ and @$DWGCODEPAGE@. Files of version AC1021
-- (2007) and later are in UTF-8, whatever the code page says.
fromHeader :: Maybe Text -> Maybe Text -> Encoding
fromHeader version page
  | maybe False isUnicode version = Utf8
  | otherwise = case page of
    Nothing -> NotStated
    Just name
      | number `elem` ["", "ASCII"] -> NotStated
      | otherwise -> maybe (Unknown name) (SingleByte name) (CodePageTable.upperHalf number)
      where
        number = withoutMaker (Text.toUpper name)

isUnicode :: Text -> Bool
isUnicode version = case Text.stripPrefix "AC" version of
  Just number -> Text.length number == 4 && Text.all isDigit number && number >= "1021"
  Nothing -> False

-- | The number of a code page without the name of its maker: @1251@ of @ANSI_1251@.
withoutMaker :: Text -> Text
withoutMaker name = case mapMaybe (`Text.stripPrefix` name) makers of
  number : _ -> Text.dropWhile (`elem` ("-_ " :: String)) number
  [] -> name
  where
    makers = ["ANSI_", "ANSI", "DOS", "WINDOWS", "CP"]

-- | The text of a name, with its escapes resolved: @\\U+0416@ is the character of that number, and
-- a pair of surrogates is one character. Escapes @\\M+@ of multi-byte code pages remain as they
-- are.
decode :: Encoding -> ByteString -> Either DrawingFault Text
decode encoding bytes
  | ByteString.all (< 128) bytes = Right (unescaped (Encoding.decodeLatin1 bytes))
  | otherwise = unescaped <$> decoded
  where
    decoded = case encoding of
      Utf8 -> either (const (Left (NotInEncoding "UTF-8"))) Right (Encoding.decodeUtf8' bytes)
      SingleByte page table -> byTable page table bytes
      Unknown page -> Left (CodePageUnknown page)
      NotStated -> case Encoding.decodeUtf8' bytes of
        Left _ -> singleBytes "windows-1252" bytes
        Right text -> Right text

-- | The text of bytes in a code page of single bytes, such as @windows-1251@.
singleBytes :: Text -> ByteString -> Either DrawingFault Text
singleBytes page bytes = case CodePageTable.upperHalf (withoutMaker (Text.toUpper page)) of
  Just table -> byTable page table bytes
  Nothing -> Left (CodePageUnknown page)

byTable :: Text -> Vector Char -> ByteString -> Either DrawingFault Text
byTable page table bytes
  | Text.any (== noCharacter) text = Left (NotInEncoding page)
  | otherwise = Right text
  where
    text = Text.pack (map (character table . fromEnum) (ByteString.unpack bytes))

character :: Vector Char -> Int -> Char
character table byte
  | byte < 128 = chr byte
  | otherwise = fromMaybe noCharacter (table Vector.!? (byte - 128))

-- | The replacement character: the table has it for bytes without a character.
noCharacter :: Char
noCharacter = '\xFFFD'

-- | The text with its escapes replaced by their characters.
unescaped :: Text -> Text
unescaped text = case Text.breakOn escape text of
  (_, "") -> text
  _ -> Text.concat (parts text)
  where
    parts rest = case Text.breakOn escape rest of
      (before, "") -> [before]
      (before, found) -> case codeUnit found of
        Nothing -> before : escape : parts (Text.drop (Text.length escape) found)
        Just (high, more)
          | isHigh high,
            Just (low, after) <- codeUnit more,
            isLow low ->
            before :
            Text.singleton (chr (0x10000 + (high - 0xD800) * 0x400 + low - 0xDC00)) :
            parts after
          | isHigh high || isLow high -> before : Text.singleton noCharacter : parts more
          | otherwise -> before : Text.singleton (chr high) : parts more
    isHigh unit = unit >= 0xD800 && unit < 0xDC00
    isLow unit = unit >= 0xDC00 && unit < 0xE000

-- | The number of an escape at the beginning of a text, and the text after it.
codeUnit :: Text -> Maybe (Int, Text)
codeUnit text = do
  rest <- Text.stripPrefix escape text
  let (digits, more) = Text.splitAt 4 rest
  if Text.length digits == 4 && Text.all isHexDigit digits
    then either (const Nothing) (\(n, _) -> Just (n, more)) (Read.hexadecimal digits)
    else Nothing

escape :: Text
escape = "\\U+"
