-- | The side of a contour on which the cutter moves, and the direction of travel.
--
-- The module refuses statements that are impossible on their contour, such as @outside@ on an open
-- contour.
module Toolpath.MillingSide
  ( leadingSide,
    possible,
    oriented,
    keyword,
  )
where

import Base.Quantity (Mm (..))
import Base.Region (Located (..), Region)
import Data.List.NonEmpty qualified as NonEmpty
import Geometry.Carrier qualified as Carrier
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (Arc))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec
import Part.Part
  ( Contour (elements),
    Milling (contour, side),
    Side (..),
    Work (..),
  )
import Part.Part qualified as Part
import Toolpath.Error (Error (..))
import Toolpath.LinkingMove qualified as LinkingMove

-- | The side of the contour, in the direction of travel, on which the cutter moves; Nothing when
-- its centre moves on the contour. A profile that is turned outside lies between the tool and the
-- spindle's axis, @y = 0@. Refuses @outside@ and @inside@ for open contours that are milled, and
-- for profiles that end at the x at which they begin. Refuses closed contours that are turned.
leadingSide :: Milling -> Either Error (Maybe Carrier.Side)
leadingSide milling = case (value (side milling), Part.ends (contour milling)) of
  (_, Part.Closed)
    | Part.work milling == Turned ->
      Left (TurnsClosed (region (side milling)) (value name) (region name))
  (LeftSide, _) -> Right (Just Carrier.LeftOf)
  (RightSide, _) -> Right (Just Carrier.RightOf)
  (On, _) -> Right Nothing
  (Outside, Part.Closed) ->
    Right (Just (if counterClockwise then Carrier.RightOf else Carrier.LeftOf))
  (Inside, Part.Closed) ->
    Right (Just (if counterClockwise then Carrier.LeftOf else Carrier.RightOf))
  (s, Part.Open)
    | Part.work milling /= Turned ->
      Left (SideOfOpen (region (side milling)) s (value name) (region name))
    | abs alongAxis <= slack ->
      Left (SideOfFace (region (side milling)) s (value name) (region name))
    | (alongAxis > 0) == (s == Outside) -> Right (Just Carrier.LeftOf)
    | otherwise -> Right (Just Carrier.RightOf)
  where
    counterClockwise = Polyarc.areaOf Part.segment (elements (contour milling)) > 0
    -- Distance in mm along the spindle from the beginning of the profile to its end.
    alongAxis =
      Vec.x (Segment.end (Part.segment (NonEmpty.last (elements (contour milling)))))
        - Vec.x (Segment.start (Part.segment (NonEmpty.head (elements (contour milling)))))
    Mm slack = Tolerance.coincident
    name = Part.contourName (contour milling)

-- | Refuses a turned profile that goes below the spindle's axis, and an allowance when the centre
-- of the cutter moves on the contour. @region@ is the region of the statement.
possible :: Region -> Milling -> Either Error ()
possible region milling
  | e : _ <-
      [ e
        | Part.work milling == Turned,
          let Mm slack = Tolerance.coincident,
          e <- list,
          lowest (Part.segment e) < -slack
      ] =
    Left (BelowAxis (keyword milling region) e)
  | value (side milling) == On
      && ( any (> Mm 0) (Part.allowances milling)
             || any ((> Mm 0) . Part.allowance . Part.finish) list
         ) =
    Left
      ( AllowanceOnContour
          (keyword milling region)
          (Part.side milling)
          (Part.ends (contour milling))
      )
  | otherwise = Right ()
  where
    list = NonEmpty.toList (elements (contour milling))
    lowest s = case s of
      Arc from _ centre _
        | Mm r <- Segment.radius centre from,
          Segment.hasFootOf s (Vec.point (Vec.x centre) (Vec.y centre - r)) ->
          Vec.y centre - r
      _ -> min (Vec.y (Segment.start s)) (Vec.y (Segment.end s))

-- | Reverses the contour if the program asks for climb or conventional milling and the contour has
-- the wrong sense for that. With a spindle that turns clockwise, climb milling has the material on
-- the right of the direction of travel. Refuses the request when the cutter's centre moves on the
-- contour, and when the request contradicts the side @left@ or @right@ of the program. @region@ is
-- the region of the statement.
oriented :: Region -> Milling -> Either Error Milling
oriented region milling = case Part.sense milling of
  Nothing -> Right milling
  Just (Located at sense) -> do
    now <- leadingSide milling
    let climbs = (sense == Part.Climb) == (Part.spindleSense milling == Part.Clockwise)
        wanted = if climbs then Carrier.LeftOf else Carrier.RightOf
    case now of
      Nothing -> Left (SenseOnContour at (keyword milling region))
      Just side'
        | side' == wanted -> Right milling
        | value (side milling) `elem` [LeftSide, RightSide] ->
          Left (SenseAgainstSide at (region' (side milling)))
        | otherwise -> Right milling {contour = Part.reversedContour (contour milling)}
  where
    region' (Located r _) = r

-- | Shortens the region of the statement of a milling to its keyword.
keyword :: Milling -> Region -> Region
keyword milling = LinkingMove.keyword $ case Part.work milling of
  Milled -> 4
  Turned -> 4
  Engraved -> 7
