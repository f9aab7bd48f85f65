-- | The text of an XML file from its bytes, with LF at the end of every line.
module Drawing.XmlText
  ( fromBytes,
  )
where

import Data.ByteString (ByteString)
import Data.ByteString.Char8 qualified as Bytes
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Data.Text.Encoding.Error qualified as Encoding
import Drawing.CodePage qualified as CodePage
import Drawing.Error (DrawingFault (..), Error (Error))

-- | The text of a file in UTF-8, in UTF-16 with a byte order mark, in ISO 8859-1, or in a code page
-- of single bytes that the XML declaration names.
fromBytes :: ByteString -> Either Error Text
fromBytes bytes
  | Just rest <- Bytes.stripPrefix "\xEF\xBB\xBF" bytes = unixLines <$> utf8 rest
  | Just rest <- Bytes.stripPrefix "\xFF\xFE" bytes =
    Right (unixLines (Encoding.decodeUtf16LEWith Encoding.lenientDecode rest))
  | Just rest <- Bytes.stripPrefix "\xFE\xFF" bytes =
    Right (unixLines (Encoding.decodeUtf16BEWith Encoding.lenientDecode rest))
  | otherwise = unixLines <$> decoded (Text.toUpper (declared bytes))
  where
    decoded name
      | name `elem` ["", "UTF-8", "UTF8", "US-ASCII", "ASCII"] = utf8 bytes
      | name `elem` ["ISO-8859-1", "LATIN1"] = Right (Encoding.decodeLatin1 bytes)
      | otherwise = byLine (CodePage.singleBytes name) bytes
    utf8 = byLine (either (const (Left (NotInEncoding "UTF-8"))) Right . Encoding.decodeUtf8')

-- | The encoding that the XML declaration names, or an empty text.
declared :: ByteString -> Text
declared bytes
  | not ("<?xml" `Bytes.isPrefixOf` bytes) = ""
  | otherwise = case Bytes.breakSubstring "encoding" declaration of
    (_, found) ->
      let quoted = Bytes.drop 1 (Bytes.dropWhile (`notElem` quotes) found)
       in Encoding.decodeLatin1 (Bytes.takeWhile (`notElem` quotes) quoted)
  where
    declaration = Bytes.takeWhile (/= '>') (Bytes.take 200 bytes)
    quotes = "\"'" :: String

-- | Decodes bytes that have their line ends in ASCII. An error has the line.
byLine :: (ByteString -> Either DrawingFault Text) -> ByteString -> Either Error Text
byLine decode bytes = case decode bytes of
  Right text -> Right text
  Left fault -> case [n | (n, Left _) <- zip [1 ..] (map decode (Bytes.split '\n' bytes))] of
    n : _ -> Left (Error n fault)
    [] -> Left (Error 1 fault)

unixLines :: Text -> Text
unixLines = Text.replace "\r" "\n" . Text.replace "\r\n" "\n"
