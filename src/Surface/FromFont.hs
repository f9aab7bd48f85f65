-- | The shapes of the letters of a text in a font: outlines, and the depths that say which of them
-- are holes.
module Surface.FromFont
  ( KnownGlyphs,
    shapes,
  )
where

import Base.Region (Located (..), Region (Region))
import Base.Region qualified as Region
import Data.Either (partitionEithers)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Lazy (Map)
import Data.Map.Lazy qualified as Map
import Data.Maybe (catMaybes, fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Drawing.Drawing (Entity (Entity), PathPart, Shape (Path))
import Drawing.Filling qualified as Filling
import Drawing.Outline (DrawnPart (..), Outline (..))
import Font.TextOutline
  ( FilledOutlines,
    GlyphName (..),
    GlyphPlace (..),
    LetterShape (..),
  )
import Font.TextOutline qualified as TextOutline
import Font.TrueType (FontFault, Glyph, GlyphRun (..))
import Font.TrueType qualified as TrueType
import Geometry.Polyarc (Ends (Closed))
import Surface.FontError (FontMistake (..))
import Surface.Syntax (Lettering (..), TextAlignment (..), TextCourse (..))

-- | The glyphs of earlier texts.
type KnownGlyphs = Map GlyphName GlyphArea

-- | The area that the outlines of a glyph bound.
data GlyphArea
  = Bounded FilledOutlines
  | -- | of a glyph that encloses nothing, such as a space
    NoArea
  | -- | outlines that cross or touch
    Unclear

-- | The shapes of the letters of a text in a font, or its mistakes; and all glyphs that are known
-- then. @path@ is the path of the font, @file@ its name, and @answer@ its glyphs of the text, or
-- their fault.
shapes ::
  KnownGlyphs ->
  FilePath ->
  Located Text ->
  Lettering ->
  Either FontFault GlyphRun ->
  Either [FontMistake] (KnownGlyphs, [LetterShape])
shapes before path file@(Located fileAt fileName) text answer
  | Around circle _ <- course text = Left [RoundCircle (region circle)]
  | Text.length (value (lettered text)) > TrueType.mostCharacters =
    Left [LongText (region (lettered text)) (Text.length (value (lettered text)))]
  | otherwise = do
    run <- either (Left . pure . BadFont fileAt fileName) Right answer
    glyphs <- complete file (lettered text) run
    height <- maybe (Left [NoCapitals fileAt fileName]) Right (capitalHeight run)
    let found =
          [ (GlyphName path (Text.index (value (lettered text)) first), letters, outlines)
            | (letters@(GlyphPlace first _ :| _), outlines) <-
                TextOutline.shapes height TextOutline.capitals (share text) glyphs
          ]
        known = Map.union before (Map.fromList [(n, filled outlines) | (n, _, outlines) <- found])
    case partitionEithers [shape (lettered text) known n letters | (n, letters, _) <- found] of
      ([], made)
        | null (catMaybes made) -> Left [NothingToOutline (region (lettered text))]
        | otherwise -> Right (known, catMaybes made)
      (crossings, _) -> Left crossings

-- | The shape of equal letters, if they enclose anything.
shape ::
  Located Text ->
  KnownGlyphs ->
  GlyphName ->
  NonEmpty GlyphPlace ->
  Either FontMistake (Maybe LetterShape)
shape text known shapeGlyph letters = case Map.findWithDefault NoArea shapeGlyph known of
  Bounded outlines -> Right (Just (LetterShape shapeGlyph (fmap placed letters) outlines))
  NoArea -> Right Nothing
  Unclear -> Left (CrossingGlyph (regionOf (NonEmpty.head letters)))
  where
    placed g = Located (regionOf g) (begin g)
    regionOf = characterRegion text . character

-- | The area of a glyph with closed outlines.
filled :: NonEmpty (NonEmpty PathPart) -> GlyphArea
filled outlines = case Filling.filled (map outlineOf (NonEmpty.toList outlines)) of
  Nothing -> Unclear
  Just found ->
    maybe NoArea Bounded . NonEmpty.nonEmpty $
      [(fmap part (parts o), depth) | (o, depth) <- found]
  where
    outlineOf path =
      Outline Closed (fmap (DrawnPart (Entity 0 "" "" [] [] (Path Closed path))) path)

-- | The part of the width of a text that lies before its point.
share :: Lettering -> Double
share text = case fromMaybe AlignLeft (alignment text) of
  AlignLeft -> 0
  AlignCentre -> 0.5
  AlignRight -> 1

-- | The glyphs of a text, or the mistakes of the characters that the font lacks.
complete :: Located Text -> Located Text -> GlyphRun -> Either [FontMistake] [Glyph]
complete (Located _ fileName) text run
  | null unknown = Right (catMaybes (characterGlyphs run))
  | otherwise = Left unknown
  where
    unknown =
      [ NoGlyph (characterRegion text k) c fileName
        | (k, c, Nothing) <- zip3 [0 ..] (Text.unpack (value text)) (characterGlyphs run)
      ]

-- | The region of a character of a text, by its index from 0. The text begins behind its quotation
-- mark.
characterRegion :: Located Text -> Int -> Region
characterRegion (Located at _) k = Region from (from + 1)
  where
    from = Region.start at + 1 + k
