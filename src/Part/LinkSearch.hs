-- | Search for changes of a contour with which it has no fault: neighbouring items in exchanged
-- order, and tangents in place of lines between circles. Reports offer them as fixes.
module Part.LinkSearch
  ( explained,
  )
where

import Base.Region (Located (..), Region)
import Data.Containers.ListUtils (nubOrd)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe, mapMaybe)
import Geometry.Carrier (Sense (..))
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.Vec qualified as Vec
import Part.ContourError (ContourFault (..), LinkFault (..))
import Part.ContourError qualified as ContourError
import Part.FilletSearch qualified as FilletSearch
import Part.Link (Link (..))
import Part.LinkElement (LinkedElement (..))
import Part.LinkError qualified as LinkError

-- | The faults of a contour with changes that mend it. If another order of two items mends it, or
-- tangents in place of lines, the result is one fault. @fits@ is true of elements without a fault.
-- @isMeantClosed@ is the region of the word @open@ of a contour that has no fault if it is closed.
explained ::
  (NonEmpty LinkedElement -> Bool) ->
  Maybe Region ->
  NonEmpty LinkedElement ->
  NonEmpty ContourFault ->
  NonEmpty ContourFault
explained fits isMeantClosed linked faults
  | Just word <- isMeantClosed,
    first@(CrossesItself _ _ _ p _ _) : _ <- NonEmpty.toList faults,
    any (Vec.isNear p) (ownStart (NonEmpty.head linked)) =
    ClosedMeant word first :| []
  | any isMended mended = mended
  | Just lines' <- tangents fits (`elem` untouched) linked =
    TangentMeant (NonEmpty.head mended) lines' :| []
  | Just (a, b) <- exchanged fits (concatMap unordered (NonEmpty.toList faults)) linked =
    OutOfOrder (NonEmpty.head mended) a b :| []
  | otherwise = mended
  where
    mended = fmap (withLargest fits linked) faults
    untouched = concat [neighbours j | NotLinked j cause <- NonEmpty.toList faults, isApart cause]
    isApart cause = case cause of
      NotSmooth _ _ -> True
      TurnsBack _ -> True
      _ -> False
    -- A fillet of another radius or sense mends the fault, and is more likely.
    isMended f = case f of
      NotLinked _ (NoFillet _ _ (Just _) _) -> True
      NotLinked _ (NoFillet _ _ _ (Just _)) -> True
      Overrun _ _ _ _ (Just _) -> True
      CrossesItself _ _ _ _ _ (Just _) -> True
      _ -> False
    -- The elements of a fault that the order of elements may cause.
    unordered f = case f of
      NotLinked j (ParallelLines _) -> neighbours j
      NotLinked j (NoMeeting _) -> neighbours j
      NotLinked j (TurnsBack []) -> neighbours j
      NotLinked j (NoFillet _ _ Nothing Nothing) -> neighbours j
      Overrun at _ _ _ _ -> [at]
      CrossesItself _ a b _ _ _ -> [a, b]
      _ -> []
    neighbours j = [at | Located at _ <- [ContourError.before j, ContourError.after j]]

-- | If the fault may be caused by a fillet that is too large, adds the largest radius that fits.
withLargest ::
  (NonEmpty LinkedElement -> Bool) -> NonEmpty LinkedElement -> ContourFault -> ContourFault
withLargest fits linked fault = case fault of
  NotLinked j (NoFillet sense r _ _) ->
    NotLinked
      j
      ( NoFillet
          sense
          r
          (FilletSearch.largest fits linked [ContourError.link j])
          (FilletSearch.turned fits linked (== ContourError.link j))
      )
  NotLinked j (NotSmooth gap _) ->
    NotLinked j (NotSmooth gap (FilletSearch.inPlaceOf fits linked (ContourError.link j)))
  NotLinked j (TurnsBack _) ->
    let circles = [at | (at, _, _, _) <- LinkError.turnable j]
     in NotLinked j (TurnsBack (filter (\at -> fits (fmap (turnedAt at) linked)) circles))
  NotLinked j (Kinked angle _) -> NotLinked j (Kinked angle (fits (withoutLink j)))
  NotLinked j (SameCurve _) -> NotLinked j (SameCurve (leavingOutMends j))
  NotLinked j (CoincidentTangent _) -> NotLinked j (CoincidentTangent (leavingOutMends j))
  Overrun at shape overlap links _ ->
    Overrun at shape overlap links (FilletSearch.largest fits linked links)
  CrossesItself name a b p hasFillets _ ->
    CrossesItself name a b p hasFillets (FilletSearch.turned fits linked (const True))
  _ -> fault
  where
    withoutLink j = fmap (unlinkedFrom (ContourError.link j)) linked
    unlinkedFrom at w = if fmap fst (link w) == Just at then w {link = Nothing} else w
    turnedAt at w = case carrier w of
      OnCircle sense c
        | elementRegion w == at ->
          w {carrier = OnCircle (case sense of Clockwise -> CounterClockwise; _ -> Clockwise) c}
      _ -> w
    leavingOutMends j =
      maybe False fits $
        NonEmpty.nonEmpty
          (NonEmpty.filter ((/= snd (ContourError.items j)) . itemRegion) linked)

-- | Two neighbouring items in whose exchanged order the contour has no fault. @fits@ is true of
-- elements without a fault. One of the two has to be among the @suspected@ elements. Each item of
-- the contour has to give one element.
exchanged ::
  (NonEmpty LinkedElement -> Bool) ->
  [Region] ->
  NonEmpty LinkedElement ->
  Maybe (Region, Region)
exchanged fits suspected linked
  | length (nubOrd (map itemRegion elements)) < length elements = Nothing
  | otherwise =
    listToMaybe
      [ (itemRegion a, itemRegion b)
        | (n, x, y) <- zip3 [0 ..] elements (drop 1 elements),
          any ((`elem` suspected) . elementRegion) [x, y],
          (front, a : b : back) <- [splitAt n elements],
          Just changed <- [NonEmpty.nonEmpty (front <> (b : a : back))],
          fits changed
      ]
  where
    elements = NonEmpty.toList linked

-- | Lines between two circles, both joined to them by @smooth@, whose replacement by tangents
-- leaves the contour without a fault: the region of the link before each line, and the item of the
-- line. @fits@ is true of elements without a fault, and @isUnfit@ of the elements that may be
-- replaced. Nothing if there are no such lines.
tangents ::
  (NonEmpty LinkedElement -> Bool) ->
  (Region -> Bool) ->
  NonEmpty LinkedElement ->
  Maybe (NonEmpty (Region, Region))
tangents fits isUnfit linked = do
  replaced <-
    NonEmpty.nonEmpty (concatMap replaceable (zip3 elements (drop 1 around) (drop 2 around)))
  changed <- NonEmpty.nonEmpty (mapMaybe (changedBy replaced) elements)
  if fits changed then Just replaced else Nothing
  where
    elements = NonEmpty.toList linked
    around = cycle elements
    replaceable (a, b, c) =
      [ (at, itemRegion b)
        | isUnfit (elementRegion b),
          OnCircle _ _ <- [carrier a],
          OnLine _ <- [carrier b],
          OnCircle _ _ <- [carrier c],
          Just (at, Smooth) <- [link a],
          Just (_, Smooth) <- [link b]
      ]
    changedBy replaced w
      | any ((== itemRegion w) . snd) replaced = Nothing
      | Just (at, _) <- link w, any ((== at) . fst) replaced = Just w {link = Just (at, Tangent)}
      | otherwise = Just w
