-- | A small drawing of the part in which whatever is at the cursor is emphasised, for panels beside
-- the text.
module Query.Drawing
  ( drawing,
  )
where

import Base.Name qualified as Name
import Base.Quantity (Rad (..))
import Base.Region (Region (Region))
import Base.Region qualified as Region
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (isNothing, listToMaybe)
import Data.Text (Text)
import Draw.Page (Area (..))
import Draw.Svg (Pen (Pen))
import Draw.Svg qualified as Svg
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Contour (contourName, elements), Element (origin, segment), Part (contours))
import Part.Part qualified as Part
import Query.Name qualified as Query
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Toolpath.Toolpath (Block (..), Toolpath (blocks))
import Toolpath.Toolpath qualified as Toolpath

-- | The drawing of the part in SVG. The contour, element, link or machining statement at the offset
-- @at@ is emphasised. @now@ is the snapshot of the present text, and @before@ the last snapshot
-- without errors. 'Nothing' if the part has no contours.
drawing :: Snapshot -> Maybe Snapshot -> Int -> Maybe Text
drawing now before at = listToMaybe [d | s <- now : maybe [] pure before, Just d <- [ofSnapshot s]]
  where
    definedAt = Query.hover now before at >>= Query.definedAt
    ofSnapshot s = do
      part <- Snapshot.part s
      let segments = concatMap outline (contours part)
      box <- boxOf (segments <> concat (path s))
      let scale = paperScale box
          drawn = map (onPaper box scale)
      Just
        ( Svg.document
            (Area 0 0 (width box * scale + 2 * margin) (depth box * scale + 2 * margin))
            (maybe "" Name.text (Part.name part))
            [ Svg.layer "contours" [Svg.stroke thin (drawn (outline c)) | c <- contours part],
              Svg.layer "path" [Svg.stroke pathPen (drawn ms) | ms <- path s],
              Svg.layer
                "emphasis"
                [Svg.stroke bold (drawn [e]) | c <- contours part, e <- emphasised c]
            ]
        )
    emphasised c
      | Just (Region.region (contourName c)) == definedAt = outline c
      | otherwise =
        [segment e | e <- NonEmpty.toList (elements c), contains (origin e), isNothing definedAt]
    contains (Region a b) = a <= at && at <= b
    -- The moves of the machining statement at the cursor.
    path s =
      [ map Toolpath.segment (Toolpath.moves block)
        | Just toolpath <- [Snapshot.path s],
          block <- blocks toolpath,
          Just r <- [statementOf block],
          contains r
      ]

outline :: Contour -> [Segment]
outline = map segment . NonEmpty.toList . elements

-- | The region of the machining statement of a block.
statementOf :: Block -> Maybe Region
statementOf block = case block of
  Cutting {job} -> Just (Region.region job)
  Clearing {pocket} -> Just (Region.region pocket)
  Holing d _ -> Just (Region.region d)
  Carved c _ _ -> Just (Region.region c)
  Travelling {} -> Nothing
  Commanding _ -> Nothing

boxOf :: [Segment] -> Maybe BoundingBox
boxOf segments = case map BoundingBox.ofSegment segments of
  [] -> Nothing
  b : bs -> Just (foldr BoundingBox.union b bs)

width :: BoundingBox -> Double
width (BoundingBox left _ right _) = right - left

depth :: BoundingBox -> Double
depth (BoundingBox _ bottom _ top) = top - bottom

-- | The scale with which the larger side of a box is 'paperSize' long.
paperScale :: BoundingBox -> Double
paperScale box = paperSize / max 0.001 (max (width box) (depth box))

-- | The length in mm of the larger side of the drawing, without its margins.
paperSize :: Double
paperSize = 100

-- | The width in mm of the margins.
margin :: Double
margin = 4

-- | A segment in mm of paper, with y downwards.
onPaper :: BoundingBox -> Double -> Segment -> Segment
onPaper (BoundingBox left _ _ top) scale s = case s of
  Straight a b -> Straight (point a) (point b)
  Arc {start, end, centre, sweep = Rad a} ->
    Arc {start = point start, end = point end, centre = point centre, sweep = Rad (-a)}
  where
    point :: Point -> Point
    point p =
      Vec.point (margin + (Vec.x p - left) * scale) (margin + (top - Vec.y p) * scale)

thin :: Pen
thin = Pen "black" 0.35 []

bold :: Pen
bold = Pen "#d03030" 0.9 []

pathPen :: Pen
pathPen = Pen "#3060c0" 0.35 []
