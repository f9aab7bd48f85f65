-- | Mistakes in drawings that a program names, and their reports. Their places are in the text of
-- the program or in the file of the drawing.
module Surface.DrawingError
  ( DrawingMistake (..),
    GapPlace (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit (Millimetres), Mm (..))
import Base.Region (Region)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Drawing.FileFormat qualified as FileFormat
import Drawing.OutlineTolerance qualified as OutlineTolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Report.Report (Label (..), Report (..), ReportPlace (..), Severity (..), at, quote, report)
import Report.Report qualified as Report
import Surface.FontError (FontMistake)
import Surface.FontError qualified as FontError

-- | A mistake in a drawing, or a remark about it.
data DrawingMistake
  = -- | a file that is no drawing, by its name
    NotADrawing Region Text
  | -- | a drawing that is damaged, or that has what the reader refuses: the title, the message and
    -- the hints of the report
    BadDrawing Region Text [Text] [Text]
  | -- | a distance for joined ends that is no length, or not above 0
    BadDistance Region
  | -- | a selection without entities: the region of the selection or of the file, the words for
    -- it, the names that exist
    NothingSelected Region Text [Text]
  | -- | entities without an outline among them: the region of the file
    NoOutline Region
  | -- | several outlines where one is asked for: the region of the name of the file, the count, the
    -- first entities
    SeveralOutlines Region Int (NonEmpty Region)
  | -- | an outline that is open where all have to be closed: the entity at one end, the places of
    -- both ends
    OpenOutline Region Point Point
  | -- | more than two ends at a point: the entities
    BranchingOutline Point (NonEmpty Region)
  | -- | two entities along each other: the entities, the length that they have in common, its
    -- middle
    OverlappingEntities Region Region Mm Point
  | -- | two entities of closed outlines that cross or touch: the entities, the point; both are one
    -- entity if it crosses itself
    CrossingEntities Region Region Point
  | -- | no circle for a table: the region of the file
    NoCircle Region
  | -- | two circles of different sizes on one centre for a table: their entities, their diameters,
    -- and the count of further such pairs
    ConcentricCircles (Region, Region) (Mm, Mm) Int
  | -- | gaps between ends that were closed: the region of the file, the places
    ClosedGaps Region (NonEmpty GapPlace)
  | -- | an entity that is left out: its place, what it is, and the reason
    LeftOut Region Text
  | -- | an entity that is left out because it coincides with another one
    SameEntity Region Region
  | -- | a mistake in a text with outlines of a font
    InFont FontMistake
  | -- | a drawing whose unit may not be the one that is meant: the place of its page or of its
    -- unit, the unit if the file gives it, the width and the height with this unit, or with pixels
    -- of 1\/96 in
    UnitPresumed Region (Maybe Text) Mm Mm
  | -- | an open outline whose ends are near to each other: the entities at both ends, the distance
    -- of the ends, and the ends
    NearlyClosed Region Region Mm Point Point
  deriving stock (Eq, Ord, Show)

-- | A gap that was closed: the entities before and after it, its width and its place.
data GapPlace = GapPlace Region Region Mm Point
  deriving stock (Eq, Ord, Show)

-- | The report of a mistake, or of a remark.
toReport :: DrawingMistake -> Report
toReport fault = case fault of
  NotADrawing region name ->
    (at region "E0123" (quote name <> " is no drawing by its name"))
      { hints =
          [ if FileFormat.isFont name
              then "A font needs a text: contours sign from \"sans.ttf\" text \"12\" at p height 8"
              else "The name of a drawing ends in .dxf or .svg."
          ]
      }
  BadDrawing region title message hints -> (at region "E0123" title) {message, hints}
  BadDistance region ->
    (at region "E0123" "ends are joined within a length above 0")
      { hints = ["Write: within 0.01"]
      }
  NothingSelected region what names ->
    (at region "E0124" ("the drawing has no " <> what))
      { hints = listed names
      }
  NoOutline region ->
    (at region "E0124" "this part of the drawing has no outline")
      { hints = ["Lines, arcs, circles, ellipses, splines and polylines make outlines."]
      }
  NoCircle region ->
    (at region "E0124" "this part of the drawing has neither circles nor points")
      { hints = ["A table from a drawing has a row for each circle and for each point."]
      }
  SeveralOutlines region count firsts ->
    (at region "E0125" ("these are " <> Decimal.whole count <> " outlines, not one"))
      { others = [Label r "an outline begins here" | r <- NonEmpty.take 4 firsts],
        hints = ["Take all of them with contours, or only one by its layer, id or class."]
      }
  OpenOutline region p q ->
    (at region "E0125" "this outline is not closed")
      { message = ["It leads from " <> place p <> " to " <> place q <> "."],
        hints =
          [ "Close it in the drawing. If its ends nearly meet, state the gap at the end of the \
            \statement, as in within 0.1."
          ]
      }
  BranchingOutline p (first :| more) ->
    (at first "E0125" "more than two ends meet here")
      { others = [Label r "so does this one" | r <- more],
        message = ["They meet at " <> place p <> "."],
        hints = ["Remove what does not belong to the outline, or put it on another layer."]
      }
  OverlappingEntities a b long p ->
    (at b "E0125" "this runs along another entity")
      { others = [Label a "the other one"],
        message =
          [ "They have " <> Decimal.inUnit Millimetres long <> " in common, about " <> place p
              <> "."
          ],
        hints = ["Remove one of the two from the drawing, or shorten it."]
      }
  CrossingEntities a b p
    | a == b ->
      (at a "E0125" "this crosses or touches itself")
        { message = ["It does at " <> place p <> "."],
          hints = ["Mend the outline in the drawing."]
        }
    | otherwise ->
      (at b "E0125" "this crosses or touches another entity")
        { others = [Label a "the other one"],
          message = ["They meet at " <> place p <> ", so inside and outside are not clear."],
          hints =
            [ "Mend the drawing, or put the outlines on layers of their own and combine them with \
              \union or difference."
            ]
        }
  ConcentricCircles (a, b) (c, d) more ->
    (at b "E0125" "this circle has the same centre as another one")
      { others = [Label a "the other one"],
        message =
          [ "Their diameters are " <> length' c <> " and " <> length' d
              <> ", and a row for each would drill two holes there."
          ]
            <> ["So it is at " <> Decimal.whole more <> " more places." | more > 1]
            <> ["So it is at one more place." | more == 1],
        hints = ["Put the circles of one size on a layer of their own, and choose this layer."]
      }
  ClosedGaps region gaps ->
    (warning region "W0101" (gapsTitle (NonEmpty.length gaps) <> widest gaps))
      { message = map gapText (NonEmpty.take 8 gaps) <> andMore (NonEmpty.length gaps - 8),
        others = [Label r "before a gap" | GapPlace r _ _ _ <- NonEmpty.take 4 gaps]
      }
  LeftOut region text -> warning region "W0102" text
  SameEntity region original ->
    (warning region "W0103" "this coincides with another entity and is left out")
      { others = [Label original "the other one"]
      }
  InFont mistake -> FontError.toReport mistake
  UnitPresumed region (Just unit) width height ->
    (warning region "W0104" ("the unit of this drawing is " <> unit <> ", and it is very large"))
      { message =
          [ "It is " <> length' width <> " wide and " <> length' height <> " high."
          ],
        hints =
          [ "If its numbers are mm, save it with that unit: $INSUNITS is 4 for mm, and 1 for \
            \inches."
          ]
      }
  UnitPresumed region Nothing (Mm width) (Mm height) ->
    (warning region "W0104" "the drawing has no unit of length; a pixel counts as 1/96 in")
      { message =
          [ "It is " <> Decimal.short 2 width <> " mm wide and " <> Decimal.short 2 height
              <> " mm high then."
          ],
        hints =
          [ "State the unit of its numbers: write unit mm at the end of the statement, or \
            \--unit mm for partc import."
          ]
      }
  NearlyClosed a b gap p q ->
    (warning a "W0105" ("this outline is open by " <> gapSize gap <> " mm"))
      { others = [Label b "its other end" | a /= b],
        message = ["Its ends are " <> place p <> " and " <> place q <> "."],
        hints =
          [ "To close it, write within " <> gapSize gap
              <> " mm at the end of the statement, or --within "
              <> gapSize gap
              <> " for partc import."
          ]
      }
  where
    place = Vec.toText Millimetres 4
    length' = Decimal.inUnit Millimetres
    gapText (GapPlace _ _ (Mm d) p) =
      "At " <> place p <> " it was " <> Decimal.short 6 d <> " mm wide."
    andMore n = ["There are " <> Decimal.whole n <> " more." | n > 0]

-- | The number of mm by which ends at a distance are joined: the distance, rounded up at the fourth
-- decimal.
gapSize :: Mm -> Text
gapSize (Mm d) = Decimal.short 4 (fromIntegral (ceiling (1e4 * (d - rounding)) :: Int) / 1e4)
  where
    Mm rounding = OutlineTolerance.rounding

-- | The title for gaps that were closed.
gapsTitle :: Int -> Text
gapsTitle count
  | count == 1 = "a gap between two ends was closed"
  | otherwise = Decimal.whole count <> " gaps between ends were closed"

-- | The largest width of some gaps.
widest :: NonEmpty GapPlace -> Text
widest gaps = ", at most " <> Decimal.short 6 (maximum widths) <> " mm wide"
  where
    widths = [d | GapPlace _ _ (Mm d) _ <- NonEmpty.toList gaps]

warning :: Region -> Report.ReportCode -> Text -> Report
warning region code = report Warning code (InSource region)

-- | The hint that lists the names that exist.
listed :: [Text] -> [Text]
listed names
  | null names = []
  | otherwise =
    [ "There are: " <> Text.intercalate ", " (map quote (take 12 names))
        <> (if length names > 12 then ", and more." else ".")
    ]
