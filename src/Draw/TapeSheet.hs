-- | Drawing of a tape at its true size, as SVG: the paper, its sprocket holes and its punched
-- holes, and beside them the frames and the meaning of each row.
--
-- A long tape is cut into strips. They lie beside one another on pages of A4, and the pages lie one
-- below the other. Marks show where to cut the paper, so that the strips can be joined, laid over
-- a real tape, or punched by hand.
--
-- The sizes are those of ISO 1154: holes of 1.83 mm and sprocket holes of 1.17 mm, tracks 2.54 mm
-- apart. The line of the sprocket holes is 9.96 mm from the edge of the tape beside which three
-- tracks lie. A tape of another width than that of the standard has the difference at both edges.
--
-- The tape may also be punched into 35 mm film, as for the ЛКП-01Ф (sourced). The film has its own
-- perforations, with the sizes of ISO 491, type KS. The holes are those of the paper tape, because
-- the same punch makes both (sourced). Their position in the middle of the film, and the 2.54 mm
-- from row to row, are reconstructed.
module Draw.TapeSheet
  ( sheet,
    pages,
    TapeGeometry,
    TapeMaterial (..),
    geometryOf,
    filmPerforations,
    trackPosition,
    sprocketPosition,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..))
import Data.Bits (testBit)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isJust, listToMaybe, mapMaybe)
import Data.Text (Text)
import Draw.LineStyle qualified as LineStyle
import Draw.Page (Area (..))
import Draw.Svg (Anchor (..), Pen (..), Svg, TextStyle (..))
import Draw.Svg qualified as Svg
import Draw.TapeRows qualified as TapeRows
import Geometry.Segment (Segment (Straight))
import Geometry.Vec qualified as Vec
import Machine.Machine (Machine, MachineName (..), Medium)
import Machine.Machine qualified as Machine
import Tape.Layout (RowKind (..))
import Tape.RowMeaning (Row (..))

-- | Material into which a tape is punched.
data TapeMaterial = PaperTape | Film
  deriving stock (Eq, Show)

-- | Sizes of a tape in mm.
data TapeGeometry = TapeGeometry
  { material :: TapeMaterial,
    trackCount :: Int,
    -- | from one row to the next
    step :: Double,
    paperWidth :: Double
  }
  deriving stock (Eq, Show)

-- | Sizes of a punched tape; Nothing for a text, which is not punched.
geometryOf :: TapeMaterial -> Medium -> Maybe TapeGeometry
geometryOf material medium = case Machine.pitch medium of
  Nothing -> Nothing
  Just (Mm p) ->
    Just
      TapeGeometry
        { material,
          trackCount = n,
          step = p,
          paperWidth = case material of
            PaperTape -> maybe (standardWidth n) (\(Mm w) -> w) (Machine.width medium)
            Film -> filmWidth
        }
  where
    n = Machine.tracks medium

-- | Width in mm of a tape with a count of tracks: eleven sixteenths of an inch up to five tracks,
-- and else an inch.
standardWidth :: Int -> Double
standardWidth n = if n <= 5 then 17.46 else 25.4

-- | Sizes of 35 mm film in mm: its width, the distance of the perforations from one another and of
-- their middles from the edge, and the sizes of a perforation along and across the film.
filmWidth, perforationStep, perforationEdge, perforationLength, perforationWidth :: Double
filmWidth = 34.975
perforationStep = 4.75
perforationEdge = 2.01 + 2.8 / 2
perforationLength = 1.98
perforationWidth = 2.8

-- | Distance in mm of the sprocket holes of a paper tape from the left edge. The highest track is
-- on the left. On film this place, in the middle of the tracks, has no hole.
sprocketPosition :: TapeGeometry -> Double
sprocketPosition g
  | material g == Film = (filmWidth + apart * fromIntegral (trackCount g - 2 * before)) / 2
  | trackCount g <= 5 = fromEdge
  | otherwise = paperWidth g - fromEdge
  where
    fromEdge = 9.96 + (paperWidth g - standardWidth (trackCount g)) / 2
    before = TapeRows.sprocket (trackCount g)

-- | Distance in mm of a track, from 1, from the left edge.
trackPosition :: TapeGeometry -> Int -> Double
trackPosition g k
  | k > before = sprocketPosition g - apart * fromIntegral (k - before)
  | otherwise = sprocketPosition g + apart * fromIntegral (before + 1 - k)
  where
    before = TapeRows.sprocket (trackCount g)

-- | Distance of neighbouring tracks in mm.
apart :: Double
apart = 2.54

-- | Numbered rows of a tape as an SVG document. @title@ names the tape. Nothing for a text, and if
-- there are no rows.
sheet :: TapeMaterial -> Machine -> Text -> [(Int, Row)] -> Maybe Text
sheet material machine title rows =
  document machine title
    <$> geometryOf material (Machine.medium machine)
    <*> NonEmpty.nonEmpty rows

-- | The pages of the drawing of 'sheet', each as a document.
pages :: TapeMaterial -> Machine -> Text -> [(Int, Row)] -> [Text]
pages material machine title rows =
  case (geometryOf material (Machine.medium machine), NonEmpty.nonEmpty rows) of
    (Just g, Just some) ->
      let (pageCount, layersOn) = drawn machine title g some
       in [Svg.document (pageArea k) title (layersOn (== k)) | k <- [1 .. pageCount]]
    _ -> []

-- Pages -------------------------------------------------------------------------------------------

-- | Part of a tape on a page: its number from 1, its rows, and its upper left corner on the paper.
data Strip = Strip
  { stripNumber :: Int,
    stripRows :: NonEmpty (Int, Row),
    left :: Double,
    top :: Double
  }

-- | Sizes of a page in mm: A4 in portrait, its margin, and the space for the strips.
pageWidth, pageHeight, margin, stripsTop, stripsBottom :: Double
pageWidth = 210
pageHeight = 297
margin = 12
stripsTop = 30
stripsBottom = 280

document :: Machine -> Text -> TapeGeometry -> NonEmpty (Int, Row) -> Text
document machine title g rows =
  Svg.document
    (Area 0 0 pageWidth (pageHeight * fromIntegral pageCount))
    title
    (layersOn (const True))
  where
    (pageCount, layersOn) = drawn machine title g rows

-- | Count of the pages, and the layers of the drawing on the pages with the given numbers, from 1.
drawn :: Machine -> Text -> TapeGeometry -> NonEmpty (Int, Row) -> (Int, (Int -> Bool) -> [Svg])
drawn machine title g rows =
  ( pageCount,
    \isShown -> layers (filter isShown [1 .. pageCount]) (filter (isShown . pageOf) strips)
  )
  where
    layers numbers shown =
      [ Svg.layer "pages" [Svg.rectangle (Pen "none" 0 []) "white" (pageArea k) | k <- numbers],
        Svg.layer "paper" (map (paper g) shown),
        Svg.layer
          "perforations"
          [Svg.rectangle (Pen "none" 0 []) "white" a | a <- concatMap perforations shown],
        Svg.layer "positions" [Svg.dots "#c8bfa6" 0.3 (positions g s) | s <- shown],
        Svg.layer "sprocket-holes" [Svg.dots LineStyle.black 1.17 (sprockets g s) | s <- shown],
        Svg.layer "holes" [Svg.dots LineStyle.black 1.83 (punched g s) | s <- shown],
        Svg.layer "cut-marks" (concatMap (cutMarks g) shown),
        Svg.layer "frames" (concatMap (frameMarks g) shown),
        Svg.layer "words" (concatMap (rowTexts g frameColumn) shown),
        Svg.layer "title" (concatMap (pageTitle machine title g rows pageCount) numbers)
      ]
    perforations s = filmPerforations g (left s, top s, bottom g s)
    strips = arranged g (columnWidth g frameColumn rows) rows
    pageCount = maximum (1 : map pageOf strips)
    pageOf s = 1 + floor (top s / pageHeight) :: Int
    frameNumbers = mapMaybe (frame . snd) (NonEmpty.toList rows)
    frameColumn = maximum (0 : map (wide . Decimal.whole) frameNumbers)
    wide t = Svg.textWidth (size letters) t + 1

-- | Area of a page, from 1.
pageArea :: Int -> Area
pageArea k = Area 0 (pageHeight * fromIntegral (k - 1)) pageWidth (pageHeight * fromIntegral k)

-- | Width of a strip with its texts, in mm.
columnWidth :: TapeGeometry -> Double -> NonEmpty (Int, Row) -> Double
columnWidth g frameColumn rows =
  numberSpace + paperWidth g + bracketSpace + frameColumn + longest + 4
  where
    longest = maximum (fmap (Svg.textWidth (size letters) . meaning . snd) rows)

-- | Space in mm for the numbers of the rows, and for the brackets of the frames.
numberSpace, bracketSpace :: Double
numberSpace = 8
bracketSpace = 4

-- | Strips of a tape in their places.
arranged :: TapeGeometry -> Double -> NonEmpty (Int, Row) -> [Strip]
arranged g column rows = zipWith place [0 ..] (chunks perStrip (NonEmpty.toList rows))
  where
    perStrip = max 1 (floor ((stripsBottom - stripsTop) / step g)) :: Int
    perPage = max 1 (floor ((pageWidth - 2 * margin) / column)) :: Int
    place k part =
      let (page, inPage) = k `divMod` perPage
       in Strip
            { stripNumber = k + 1,
              stripRows = part,
              left = margin + numberSpace + column * fromIntegral inPage,
              top = pageHeight * fromIntegral page + stripsTop
            }
    chunks n list = case splitAt n list of
      ([], _) -> []
      (x : xs, more) -> (x :| xs) : chunks n more

-- The tape ----------------------------------------------------------------------------------------

-- | Height on the paper of the middle of each row of a strip, in mm, with the row and its number.
placed :: TapeGeometry -> Strip -> [(Double, (Int, Row))]
placed g s =
  [ (top s + step g * (fromIntegral k + 0.5), row)
    | (k, row) <- zip [0 :: Int ..] (NonEmpty.toList (stripRows s))
  ]

-- | Lower edge of a strip.
bottom :: TapeGeometry -> Strip -> Double
bottom g s = top s + step g * fromIntegral (NonEmpty.length (stripRows s))

paper :: TapeGeometry -> Strip -> Svg
paper g s =
  Svg.rectangle
    (Pen "#8a7f63" 0.1 [])
    (case material g of PaperTape -> "#f4ecd6"; Film -> "#e4e6e8")
    (Area (left s) (top s) (left s + paperWidth g) (bottom g s))

sprockets :: TapeGeometry -> Strip -> [Vec.Point]
sprockets g s =
  [Vec.point (left s + sprocketPosition g) y | material g == PaperTape, (y, _) <- placed g s]

-- | Perforations of a strip of film, which has its left edge, its top and its bottom at these
-- positions. A paper tape has none.
filmPerforations :: TapeGeometry -> (Double, Double, Double) -> [Area]
filmPerforations g (x, y, end) =
  [ Area (c - perforationWidth / 2) m (c + perforationWidth / 2) (m + perforationLength)
    | material g == Film,
      m <- takeWhile (< end - perforationLength) [y + perforationStep * (k + 0.3) | k <- [0 ..]],
      c <- [x + perforationEdge, x + filmWidth - perforationEdge]
  ]

-- | Centres of the punched holes.
punched :: TapeGeometry -> Strip -> [Vec.Point]
punched g s =
  [ Vec.point (left s + trackPosition g k) y
    | (y, (_, row)) <- placed g s,
      k <- [1 .. trackCount g],
      testBit (holes row) (k - 1)
  ]

-- | Positions without a hole.
positions :: TapeGeometry -> Strip -> [Vec.Point]
positions g s =
  [ Vec.point (left s + trackPosition g k) y
    | (y, (_, row)) <- placed g s,
      k <- [1 .. trackCount g],
      not (testBit (holes row) (k - 1))
  ]

-- Marks and texts ---------------------------------------------------------------------------------

letters :: TextStyle
letters = TextStyle {size = 1.7, ink = LineStyle.black, bold = False}

-- | Marks at the corners of a strip, and a note of the strip that joins it.
cutMarks :: TapeGeometry -> Strip -> [Svg]
cutMarks g s =
  [ Svg.stroke (Pen LineStyle.black 0.1 []) [Straight (Vec.point x y) (Vec.point x' y')]
    | (x, outX) <- [(left s, -1), (left s + paperWidth g, 1)],
      (y, outY) <- [(top s, -1), (bottom g s, 1)],
      (x', y') <- [(x + 1.5 * outX, y), (x, y + 2.5 * outY)]
  ]
    <> [ Svg.text letters {bold = True} Middle (Vec.point middle (top s - 5)) name,
         Svg.text letters Middle (Vec.point middle (bottom g s + 5)) "cut between the marks"
       ]
    <> [ Svg.text letters Middle (Vec.point (left s + position) (top s - 1.2)) label
         | (position, label) <-
             [(sprocketPosition g, "∘") | material g == PaperTape]
               <> [(trackPosition g k, Decimal.whole k) | k <- [1 .. trackCount g]]
       ]
  where
    middle = left s + paperWidth g / 2
    name = "strip " <> Decimal.whole (stripNumber s)

-- | Bracket beside the rows of each frame.
frameMarks :: TapeGeometry -> Strip -> [Svg]
frameMarks g s =
  [ bracket y (fst (NonEmpty.last group))
    | group@((y, (_, first)) :| _) <- NonEmpty.groupBy together (placed g s),
      isJust (frame first)
  ]
  where
    together (_, (_, a)) (_, (_, b)) = frame a == frame b
    x = left s + paperWidth g + 2
    half = step g / 2 - 0.3
    bracket from to =
      Svg.stroke
        (Pen LineStyle.blue 0.25 [])
        [ Straight (Vec.point (x + 1) (from - half)) (Vec.point x (from - half)),
          Straight (Vec.point x (from - half)) (Vec.point x (to + half)),
          Straight (Vec.point x (to + half)) (Vec.point (x + 1) (to + half))
        ]

-- | Numbers of the rows, numbers of the frames, and the meanings of the rows. Blank rows with the
-- same meaning have one text.
rowTexts :: TapeGeometry -> Double -> Strip -> [Svg]
rowTexts g frameColumn s =
  [ Svg.text letters {ink = "#606060"} End (Vec.point (left s - 2) (y + lowered)) (Decimal.whole n)
    | (y, (n, _)) <- rows,
      n `mod` 5 == 0 || Just n == (fst . snd <$> listToMaybe rows)
  ]
    <> [ Svg.text letters {bold = True} Start (Vec.point x (y + lowered)) (Decimal.whole k)
         | (before, (y, (_, row))) <- pairs,
           Just k <- [frame row],
           fmap frame before /= Just (Just k)
       ]
    <> [ Svg.text letters Start (Vec.point (x + frameColumn) (y + lowered)) (meaning row)
         | (before, (y, (_, row))) <- pairs,
           not (isBlank row && fmap meaning before == Just (meaning row))
       ]
  where
    rows = placed g s
    pairs = zip (Nothing : map (Just . snd . snd) rows) rows
    x = left s + paperWidth g + bracketSpace
    lowered = 0.36 * size letters
    isBlank row = case kind row of
      Blank _ -> True
      _ -> False

-- | Title of a page, with a bar by which the size of the print can be measured.
pageTitle :: Machine -> Text -> TapeGeometry -> NonEmpty (Int, Row) -> Int -> Int -> [Svg]
pageTitle machine title g rows pageCount k =
  [ Svg.text heading Start (Vec.point margin (y + 12)) title,
    Svg.text letters {size = 2.6} Start (Vec.point margin (y + 17)) facts,
    Svg.text letters {size = 2.6} Start (Vec.point margin (y + 21)) onFilm,
    Svg.text letters {size = 2.6} End (Vec.point (pageWidth - margin) (y + 12)) page,
    Svg.stroke
      (Pen LineStyle.black 0.3 [])
      [ Straight (Vec.point (end - 50) (y + 15)) (Vec.point (end - 50) (y + 17)),
        Straight (Vec.point (end - 50) (y + 17)) (Vec.point end (y + 17)),
        Straight (Vec.point end (y + 17)) (Vec.point end (y + 15))
      ],
    Svg.text letters {size = 2.2} Middle (Vec.point (end - 25) (y + 16)) "50 mm: print at 100 %"
  ]
  where
    y = pageHeight * fromIntegral (k - 1)
    end = pageWidth - margin
    heading = TextStyle {size = 4.5, ink = LineStyle.black, bold = True}
    MachineName name = Machine.name machine
    count = NonEmpty.length rows
    onFilm = case material g of
      PaperTape -> ""
      Film -> "35 mm film; the positions of the rows on it are reconstructed"
    page = "page " <> Decimal.whole k <> " of " <> Decimal.whole pageCount
    facts =
      name
        <> ": "
        <> Decimal.whole (trackCount g)
        <> " tracks, "
        <> Decimal.short 2 (paperWidth g)
        <> " mm wide, "
        <> Decimal.whole count
        <> (if count == 1 then " row, " else " rows, ")
        <> Decimal.short 3 (fromIntegral count * step g / 1000)
        <> " m. The first row is at the top of strip 1."
