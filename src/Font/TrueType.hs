{-# LANGUAGE ForeignFunctionInterface #-}

-- | The glyphs of a text from the bytes of a TrueType or OpenType font, in the units of the font
-- and without hints. The library FreeType reads them, by the foreign call in @truetype.c@.
--
-- The call is in IO. A program is loaded through a "Surface.Import" reader, which asks for the
-- glyphs; those that it has got are kept with the program, so that an editor can load another text
-- of it without IO.
module Font.TrueType
  ( GlyphRun (..),
    Glyph (..),
    GlyphContour (..),
    GlyphCurve (..),
    FontFault (..),
    mostBytes,
    mostCharacters,
    glyphs,
  )
where

import Base.Crash qualified as Crash
import Data.ByteString (ByteString)
import Data.ByteString qualified as ByteString
import Data.ByteString.Unsafe qualified as Unsafe
import Data.Char (ord)
import Data.Int (Int32)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Word (Word32)
import Foreign
  ( Ptr,
    alloca,
    finalizerFree,
    newForeignPtr,
    peek,
    peekArray,
    withArrayLen,
    withForeignPtr,
  )
import Foreign.C.Types (CChar, CInt (..), CSize (..))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec

-- | The glyphs of a text. All lengths are in units of the font.
data GlyphRun = GlyphRun
  { -- | the height of the capitals; 'Nothing' if the font does not state it and has no H
    capitalHeight :: Maybe Double,
    -- | the glyph of each character; 'Nothing' for a character that the font lacks
    characterGlyphs :: [Maybe Glyph]
  }
  deriving stock (Eq, Show)

-- | A glyph. Its origin is (0, 0), and y goes upwards.
data Glyph = Glyph
  { -- | the distance from its origin to that of the next glyph
    advance :: Double,
    -- | what is added to this distance before the character that follows in the text
    kerning :: Double,
    glyphContours :: [GlyphContour]
  }
  deriving stock (Eq, Show)

-- | A closed contour: the point at which it begins, and its curves.
data GlyphContour = GlyphContour Point [GlyphCurve]
  deriving stock (Eq, Show)

-- | A line or a Bézier curve from the point that is reached: its further control points.
data GlyphCurve
  = LineTo Point
  | QuadraticTo Point Point
  | CubicTo Point Point Point
  deriving stock (Eq, Show)

-- | A reason for which a font gives no glyphs.
data FontFault
  = -- | bytes that are no TrueType or OpenType font, or a damaged one
    NoFont
  | -- | a font that has only pictures of its letters
    WithoutOutlines
  | -- | a font that does not say which glyphs belong to which characters of Unicode
    WithoutCharacters
  | -- | a font whose glyphs are put together by instructions for a size
    ByInstructions
  | -- | more than 'mostBytes' or 'mostCharacters', or glyphs that need more memory than the limit
    TooMuch
  | -- | a glyph that cannot be read
    DamagedGlyph
  deriving stock (Eq, Ord, Show, Enum, Bounded)

-- | The largest size of a font file in bytes.
mostBytes :: Int
mostBytes = 32 * 1024 * 1024

-- | The largest count of characters of a text.
mostCharacters :: Int
mostCharacters = 1000

foreign import ccall safe "partc_font_text"
  partcFontText ::
    Ptr CChar -> CSize -> Ptr Word32 -> CSize -> Ptr (Ptr Int32) -> Ptr CSize -> IO CInt

-- | The glyphs of the characters of a text.
glyphs :: ByteString -> Text -> IO (Either FontFault GlyphRun)
glyphs font text
  | ByteString.length font > mostBytes || Text.length text > mostCharacters = pure (Left TooMuch)
  | ByteString.take 4 font `notElem` beginnings = pure (Left NoFont)
  | otherwise = decoded <$> numbersOf font text
  where
    -- The first bytes of TrueType, of OpenType with cubic curves, of TrueType by Apple, and of
    -- several fonts in one file.
    beginnings = ["\0\1\0\0", "OTTO", "true", "ttcf"]
    decoded answer = case answer of
      (0, numbers) -> Right (runOf (Text.length text) numbers)
      (code, _) -> Left (faultOf code)

-- | The result of the foreign call and its numbers. They are copied, and the memory of the call is
-- freed when nothing refers to it, also if the thread is stopped while they are copied.
numbersOf :: ByteString -> Text -> IO (CInt, [Int])
numbersOf font text =
  Unsafe.unsafeUseAsCStringLen font $ \(bytes, size) ->
    withArrayLen (map (fromIntegral . ord) (Text.unpack text)) $ \count characters ->
      alloca $ \result ->
        alloca $ \lengthOf -> do
          code <-
            partcFontText bytes (fromIntegral size) characters (fromIntegral count) result lengthOf
          numbers <- newForeignPtr finalizerFree =<< peek result
          n <- peek lengthOf
          copied <- withForeignPtr numbers (peekArray (fromIntegral n))
          pure (code, map fromIntegral copied)

-- | The fault of a result of the foreign call.
faultOf :: CInt -> FontFault
faultOf code = case code of
  1 -> NoFont
  2 -> WithoutOutlines
  3 -> WithoutCharacters
  4 -> ByInstructions
  5 -> TooMuch
  _ -> DamagedGlyph

-- | The glyphs from the numbers of the foreign call, for a count of characters.
runOf :: Int -> [Int] -> GlyphRun
runOf count numbers = case numbers of
  height : rest ->
    GlyphRun
      { capitalHeight = if height > 0 then Just (fromIntegral height) else Nothing,
        characterGlyphs = glyphsFrom count rest
      }
  [] -> wrongNumbers

glyphsFrom :: Int -> [Int] -> [Maybe Glyph]
glyphsFrom count numbers = case numbers of
  _ | count == 0 -> []
  0 : rest -> Nothing : glyphsFrom (count - 1) rest
  _ : wide : near : rest ->
    let (found, after) = contoursFrom rest
        glyph =
          Glyph
            { advance = fromIntegral wide,
              kerning = fromIntegral near,
              glyphContours = found
            }
     in Just glyph : glyphsFrom (count - 1) after
  _ -> wrongNumbers

-- | The contours up to the end of a glyph, and the numbers after it.
contoursFrom :: [Int] -> ([GlyphContour], [Int])
contoursFrom numbers = case numbers of
  0 : rest -> ([], rest)
  1 : x : y : rest ->
    let (curves, after) = curvesFrom rest
        (more, final) = contoursFrom after
     in (GlyphContour (pointOf x y) curves : more, final)
  _ -> wrongNumbers

-- | The curves up to the end of a contour, and the numbers after them.
curvesFrom :: [Int] -> ([GlyphCurve], [Int])
curvesFrom numbers = case numbers of
  2 : x : y : rest -> onto (LineTo (pointOf x y)) rest
  3 : a : b : x : y : rest -> onto (QuadraticTo (pointOf a b) (pointOf x y)) rest
  4 : a : b : c : d : x : y : rest ->
    onto (CubicTo (pointOf a b) (pointOf c d) (pointOf x y)) rest
  _ -> ([], numbers)
  where
    onto curve rest = let (more, after) = curvesFrom rest in (curve : more, after)

-- | A point from the doubled coordinates of the foreign call.
pointOf :: Int -> Int -> Point
pointOf x y = Vec.point (fromIntegral x / 2) (fromIntegral y / 2)

-- | The end of this program for numbers in another order than the foreign call writes them.
wrongNumbers :: a
wrongNumbers = Crash.bug "the glyphs of a font are out of order"
