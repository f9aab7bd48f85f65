-- | Causes of linking moves that cut into the part: an approach on the wrong side of the contour,
-- and leads that are too large. One cause often makes several moves cut in, and is then reported
-- once.
module Toolpath.LinkingMoveError
  ( LinkingMoveError (..),
    LeadFit (..),
    CheckedMoves (..),
    place,
    diagnosis,
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (LengthUnit, Mm (..), plus, times)
import Base.Region (Located (..), Region)
import Data.List (nub)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Carrier qualified as Carrier
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Part.Part
  ( Contour (contourName, elements),
    Element (origin),
    LeadForm (..),
    Milling (contour),
  )
import Part.Part qualified as Part
import Report.Fix qualified as Fix
import Report.Report (Label (Label), Report (fixes, hints, others), at)
import Toolpath.Lead (Which (..))
import Toolpath.Lead qualified as Lead
import Toolpath.Toolpath (Move)
import Toolpath.Toolpath qualified as Toolpath
import Toolpath.WarningReport (shape)

-- | The cause of intrusions of linking moves.
data LinkingMoveError
  = -- | an approach or a retract on the side of a closed contour on which the cutter does not mill:
    -- the points, the first of which is reported; the region of the side, the name of the contour,
    -- and True if the points are within it
    OnOtherSide (NonEmpty (Located Point)) Region Name Bool
  | -- | leads that are too large: the leads, the element that the cutter comes too near, and by how
    -- much
    LeadTooLarge (NonEmpty LeadFit) Element Mm
  deriving stock (Eq, Show)

-- | A lead that is too large: its form, the region of its length or radius, this length or radius,
-- and the largest one with which the cutter comes too near to nothing.
data LeadFit = LeadFit
  { which :: Which,
    form :: LeadForm,
    sizeAt :: Region,
    given :: Mm,
    largest :: Mm
  }
  deriving stock (Eq, Show)

-- | The region to which the report of a cause points.
place :: LinkingMoveError -> Region
place fault = case fault of
  OnOtherSide (first :| _) _ _ _ -> region first
  LeadTooLarge (first :| _) _ _ -> sizeAt first

-- Diagnosis ---------------------------------------------------------------------------------------

-- | The moves of a pass along a contour, and a test that is true of moves that cut into nothing.
data CheckedMoves = CheckedMoves
  { approach :: [Move],
    cut :: NonEmpty Move,
    retract :: [Move],
    isClear :: [Move] -> Bool
  }

-- | The cause for which linking moves of a pass along a contour cut into the part; Nothing if none
-- is known. @side@ is the cutter's side of the contour. @element@ is the element into which a
-- linking move cuts deepest, and @depth@ that depth.
diagnosis :: Milling -> Carrier.Side -> CheckedMoves -> (Element, Mm) -> Maybe LinkingMoveError
diagnosis milling side moves (element, depth) =
  case (NonEmpty.nonEmpty wrong, traverse fitted badLeads) of
    (Just stops, _) -> Just (OnOtherSide stops (region (Part.side milling)) name isWithin)
    (Nothing, Just (first : more)) -> Just (LeadTooLarge (first :| more) element depth)
    _ -> Nothing
  where
    Located _ name = contourName (contour milling)
    isCounterClockwise = Polyarc.areaOf Part.segment (elements (contour milling)) > 0
    isWithin = (side == Carrier.RightOf) == isCounterClockwise
    wrong =
      [ p
        | Part.ends (contour milling) == Part.Closed,
          Part.Stop p _ _ <- lastOf (Part.approach milling) <> take 1 (Part.retract milling),
          isWithin == WindingNumber.encloses (Part.polyarcOf (contour milling)) (value p)
      ]
    lastOf = take 1 . reverse
    badLeads =
      [leadOf In | not (isClear moves (take 2 (reverse (approach moves))))]
        <> [leadOf Out | not (isClear moves (take 2 (retract moves)))]
    leadOf which = case which of
      In -> sized which <$> Part.leadIn milling <*> Part.leadInSize (Part.places milling)
      Out -> sized which <$> Part.leadOut milling <*> Part.leadOutSize (Part.places milling)
    sized which (form, given) sizeAt = LeadFit {which, form, sizeAt, given, largest = given}
    fitted maybeLead = do
      lead <- maybeLead
      r <- largestClear (isClear moves . movesWith milling side moves lead) (given lead)
      pure lead {largest = r}

-- | A lead of another length or radius, and the linking move beside it.
movesWith :: Milling -> Carrier.Side -> CheckedMoves -> LeadFit -> Mm -> [Move]
movesWith milling side CheckedMoves {approach, cut, retract} LeadFit {which, form} r = case which of
  In ->
    let m = NonEmpty.head cut
        path = Toolpath.segment m
        sized = milling {Part.leadIn = Just (form, r)}
        (z, _) = Toolpath.heights m
     in concat
          [ l : map (to (Segment.start (Toolpath.segment l))) (take 1 (drop 1 (reverse approach)))
            | l <- leads m sized (Segment.startDirection path) (Segment.start path) z
          ]
  Out ->
    let m = NonEmpty.last cut
        path = Toolpath.segment m
        sized = milling {Part.leadOut = Just (form, r)}
        (_, z) = Toolpath.heights m
     in concat
          [ l : map (from (Segment.end (Toolpath.segment l))) (take 1 (drop 1 retract))
            | l <- leads m sized (Segment.endDirection path) (Segment.end path) z
          ]
  where
    leads m sized direction p z =
      map
        (Toolpath.atHeights (z, z))
        (Lead.lead (Toolpath.origin m) sized (Just side) which direction p)
    to p m = m {Toolpath.segment = Straight (Segment.start (Toolpath.segment m)) p}
    from p m = m {Toolpath.segment = Straight p (Segment.end (Toolpath.segment m))}

-- | The largest size below @given@ that is clear, to 0.1 mm, or to 0.01 mm if it is less than 1 mm.
-- It is found by bisection: a smaller lead is clear if a larger one is. Nothing if none is found.
largestClear :: (Mm -> Bool) -> Mm -> Maybe Mm
largestClear isClear given
  | rounded > Mm 0 && isClear rounded = Just rounded
  | otherwise = Nothing
  where
    Mm most = bisect (40 :: Int) (Mm 0) given
    rounded = Mm (if most >= 1 then down 10 else down 100)
    down n = fromIntegral (floor (most * n) :: Int) / n
    bisect n low high
      | n == 0 = low
      | isClear middle = bisect (n - 1) middle high
      | otherwise = bisect (n - 1) low middle
      where
        middle = times 0.5 (plus low high)

-- Reports -----------------------------------------------------------------------------------------

-- | The report of a cause.
toReport :: LengthUnit -> LinkingMoveError -> Report
toReport unit cause = case cause of
  OnOtherSide stops side name isWithin -> otherSideReport unit stops side name isWithin
  LeadTooLarge leads element depth -> leadReport unit leads element depth

otherSideReport :: LengthUnit -> NonEmpty (Located Point) -> Region -> Name -> Bool -> Report
otherSideReport unit (Located first p :| more) side (Name name) isWithin =
  ( at
      first
      "E0405"
      ( Vec.toText unit 3 p
          <> (if isWithin then " lies within ‘" else " lies outside of ‘")
          <> name
          <> "’, and the cutter mills "
          <> (if isWithin then "around it" else "within it")
      )
  )
    { others =
        Label side ("on this side of the contour the cutter is " <> here) :
          [Label again "so does this point" | Located again _ <- more, again /= first],
      -- If the retract begins there as well, the side is the likely mistake.
      hints =
        [ if null more
            then "Choose a point " <> where' <> ". Or mill its other side: " <> otherSide <> "."
            else "Mill its other side: " <> otherSide <> ". Or choose points " <> where' <> "."
        ]
    }
  where
    here = if isWithin then "outside" else "inside"
    where' = here <> " of ‘" <> name <> "’"
    otherSide = if isWithin then "inside" else "outside"

leadReport :: LengthUnit -> NonEmpty LeadFit -> Element -> Mm -> Report
leadReport unit leads@(first :| more) element depth =
  (at (sizeAt first) "E0405" (leadText unit first <> " is too large here"))
    { others =
        [Label (sizeAt l) (leadText unit l <> " as well") | l <- more]
          <> [ Label
                 (origin element)
                 ( "the cutter comes " <> Decimal.inUnit unit depth <> " too near to "
                     <> shape unit element
                 )
             ],
      fixes =
        [ Fix.proposed . Fix.joined title $
            [Fix.exchange title (sizeAt l) (Decimal.inUnit unit (largest l)) | l <- first : more]
        ]
    }
  where
    title =
      "Write the largest that fits: "
        <> Text.intercalate
          " and "
          (nub (map (Decimal.inUnit unit . largest) (NonEmpty.toList leads)))
        <> "."

leadText :: LengthUnit -> LeadFit -> Text
leadText unit LeadFit {which, form, given} =
  (if which == In then "the lead-in " else "the lead-out ")
    <> (case form of LeadLine -> "line of length "; LeadArc -> "arc of radius ")
    <> Decimal.inUnit unit given
