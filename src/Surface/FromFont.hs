-- | Statements that a text in a font gives: the place of the text, a contour for each outline of
-- its letters, and the region that the outlines bound.
module Surface.FromFont
  ( statements,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (..), Region (Region))
import Base.Region qualified as Region
import Data.List (nub)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (catMaybes, fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Drawing.Drawing (Entity (Entity), PathPart (..), Shape (Path))
import Drawing.Drawing qualified as Drawing
import Drawing.Filling qualified as Filling
import Drawing.Nesting (Crossing (..))
import Drawing.Outline (DrawnPart (..), Outline (..))
import Drawing.PathPart qualified as PathPart
import Font.TextOutline (TextOutline (..))
import Font.TextOutline qualified as TextOutline
import Font.TrueType (FontFault, Glyph, GlyphRun (..))
import Font.TrueType qualified as TrueType
import Geometry.Polyarc (Ends (Closed))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Surface.DrawnContour qualified as DrawnContour
import Surface.FontError (FontMistake (..))
import Surface.FromDrawing qualified as FromDrawing
import Surface.Syntax hiding (Closed, statements)
import Surface.Syntax qualified as Surface
import Surface.TextPlace qualified as TextPlace

-- | The statements in place of a text in a font, or its mistakes. @at@ is the region of the
-- statement, @file@ the name of the font, and @answer@ its glyphs of the text, or their fault.
statements ::
  Region ->
  Located Name ->
  Located Text ->
  Lettering ->
  Either FontFault GlyphRun ->
  Either [FontMistake] [Statement]
statements at name file@(Located fileAt fileName) text answer
  | Around circle _ <- course text = Left [RoundCircle (region circle)]
  | Text.length (value (lettered text)) > TrueType.mostCharacters =
    Left [LongText (region (lettered text)) (Text.length (value (lettered text)))]
  | otherwise = do
    run <- either (Left . pure . BadFont fileAt fileName) Right answer
    glyphs <- complete file (lettered text) run
    height <- maybe (Left [NoCapitals fileAt fileName]) Right (capitalHeight run)
    let outlines = TextOutline.outlines height TextPlace.capitals (share text) glyphs
    case Filling.filled (map (outlineOf (lettered text)) outlines) of
      Left crossings -> Left (nub (map crossing (NonEmpty.toList crossings)))
      Right [] -> Left [NothingToOutline (region (lettered text))]
      Right found ->
        Right
          ( Located at (DrawnText name file text) :
            FromDrawing.asRegion at name (contourOf at (value name) regionOf) found
          )
  where
    regionOf = characterRegion (lettered text) . Drawing.line
    crossing (Crossing a b _) = CrossingGlyphs (regionOf a) (regionOf b)

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

-- | The closed outline of a letter. Its entity has the index of the character, from 0, in place of
-- a line, and the character as its word.
outlineOf :: Located Text -> TextOutline -> Outline
outlineOf text (TextOutline k path) = Outline Closed (fmap (DrawnPart letter) path)
  where
    letter = Entity k (Text.take 1 (Text.drop k (value text))) "" [] [] (Path Closed path)

-- | The contour of an outline with the name @own@, for a text whose region has the name @name@.
contourOf :: Region -> Name -> (Entity -> Region) -> Located Name -> Outline -> Statement
contourOf at name regionOf own outline =
  Located at (Contour own (Located at Surface.Closed) (concatMap items (parts outline)))
  where
    items p =
      element p (placed p (PathPart.start (part p))) :
        [ element p (DrawnContour.call (here p) "bezier" [Located (here p) (List points)])
          | Bezier controls _ <- [part p],
            let points = map (placed p) (NonEmpty.toList controls)
        ]
    here = regionOf . entity
    element p e = Located (here p) (Element Nothing e [] Nothing)
    placed = pointOf name . here

-- | The point of a text from its position in the outlines, in mm.
pointOf :: Name -> Region -> Point -> Expr
pointOf name at p =
  named TextPlace.origin
    `plus` (times (Vec.x p) TextPlace.along `plus` times (Vec.y p) TextPlace.upward)
  where
    named word = Located at (Variable (word name))
    plus a b = Located at (Binary Add a b)
    times v word = Located at (Binary Multiply (DrawnContour.number at Nothing v) (named word))
