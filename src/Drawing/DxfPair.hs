-- | The pairs of a DXF file in the form of text: the code of a group on one line, and its value on
-- the next.
module Drawing.DxfPair
  ( Pair (..),
    fromBytes,
  )
where

import Data.ByteString (ByteString)
import Data.ByteString.Char8 qualified as Bytes
import Data.Char (isDigit)
import Data.Maybe (fromMaybe)
import Data.Text.Encoding qualified as Encoding
import Drawing.Error (Container (..), DrawingFault (..), Error (Error))

-- | A pair of a code and a value.
data Pair = Pair
  { -- | number of the line of the code, from 1
    line :: Int,
    code :: Int,
    -- | the bytes of the value, without blanks around them
    content :: ByteString
  }
  deriving stock (Eq, Show)

-- | The pairs of a file up to the one with the word EOF, which is left out, and without comments
-- (code 999). Lines end with CR LF, LF or CR. An error if a code is not a whole number, or if the
-- file ends before EOF.
fromBytes :: ByteString -> Either Error [Pair]
fromBytes bytes
  | "AutoCAD Binary DXF" `Bytes.isPrefixOf` bytes = Left (Error 1 BinaryDxf)
  | isDwg bytes = Left (Error 1 (DwgFile (Encoding.decodeLatin1 (Bytes.take 6 bytes))))
  | otherwise = go [] 1 (fromMaybe bytes (Bytes.stripPrefix "\xEF\xBB\xBF" bytes))
  where
    go found number rest
      | Bytes.all isBlank rest = Left (Error (max 1 (number - 1)) (EndsEarly WholeFile))
      | otherwise = let (codeLine, after) = cutLine rest in pairAt found number codeLine after
    pairAt found number codeLine after = do
      code <- maybe (Left (notACode number codeLine)) Right (codeOf codeLine)
      let (content, more) = cutLine after
      case code of
        _ | Bytes.null after -> Left (Error number (EndsEarly Group))
        0 | content == "EOF" -> Right (reverse found)
        999 -> go found (number + 2) more
        _ -> go (Pair {line = number, code, content} : found) (number + 2) more
    notACode number text = Error number (NotACode (Encoding.decodeLatin1 text))

-- | True of a file of AutoCAD's own format, which begins with its version, as @AC1032@.
isDwg :: ByteString -> Bool
isDwg bytes = case Bytes.stripPrefix "AC" bytes of
  Just rest -> Bytes.length version == 4 && Bytes.all (\c -> isDigit c || c == '.') version
    where
      version = Bytes.take 4 rest
  Nothing -> False

-- | The first line without its end and the blanks around it, and the text after its end.
cutLine :: ByteString -> (ByteString, ByteString)
cutLine bytes = (stripped before, Bytes.drop ending rest)
  where
    (before, rest) = Bytes.break (\c -> c == '\n' || c == '\r') bytes
    ending = if "\r\n" `Bytes.isPrefixOf` rest then 2 else 1

stripped :: ByteString -> ByteString
stripped = Bytes.dropWhileEnd isBlank . Bytes.dropWhile isBlank

isBlank :: Char -> Bool
isBlank c = c == ' ' || c == '\t' || c == '\n' || c == '\r'

-- | The code of a group: a whole number of at most five characters. Codes are −5 to 1071.
codeOf :: ByteString -> Maybe Int
codeOf text
  | Bytes.length text > 5 = Nothing
  | otherwise = case Bytes.readInt text of
    Just (code, "") -> Just code
    _ -> Nothing
