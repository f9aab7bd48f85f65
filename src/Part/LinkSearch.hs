-- | Search for changes of a contour with which it has no fault: neighbouring items in exchanged
-- order, an element in the opposite direction, exchanged near points, and tangents in place of
-- lines between circles. Reports offer them as fixes.
module Part.LinkSearch
  ( explained,
  )
where

import Base.Region (Located (..), Region)
import Data.Containers.ListUtils (nubOrd)
import Data.List (tails)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe, mapMaybe)
import Geometry.Carrier (Line (..))
import Geometry.Carrier qualified as Carrier
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.ContourError (ContourFault (..), LinkFault (..))
import Part.ContourError qualified as ContourError
import Part.FilletSearch qualified as FilletSearch
import Part.Link (Link (..))
import Part.LinkElement (LinkedElement (..))
import Part.LinkError qualified as LinkError

-- | The faults of a contour with changes that mend it. If one of the changes that this module
-- searches for mends it, the result is one fault. @fits@ is true of elements without a fault.
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
  | Just (a, b) <- exchangedPoints fits linked =
    NearExchanged (NonEmpty.head mended) a b :| []
  | Just (element, word) <- reversed fits suspected linked =
    AgainstTravel (NonEmpty.head mended) element word :| []
  | Just (a, b) <- exchanged fits suspected linked =
    OutOfOrder (NonEmpty.head mended) a b :| []
  | otherwise = mended
  where
    mended = fmap (withLargest fits linked) faults
    suspected = concatMap unordered (NonEmpty.toList faults)
    untouched = concat [neighbours j | NotLinked j cause <- NonEmpty.toList faults, isApart cause]
    isApart cause = case cause of
      NotSmooth _ _ -> True
      TurnsBack _ -> True
      _ -> False
    -- A fillet of another radius or sense mends the fault, and is more likely.
    isMended f = case f of
      NotLinked _ (NoFillet _ _ (Just _) _) -> True
      NotLinked _ (NoFillet _ _ _ (Just _)) -> True
      NotLinked _ (TurnsBack (_ : _)) -> True
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
          w {carrier = OnCircle (Carrier.oppositeSense sense) c}
      _ -> w
    leavingOutMends j =
      maybe False fits $
        NonEmpty.nonEmpty
          (NonEmpty.filter ((/= snd (ContourError.items j)) . itemRegion) linked)

-- | A line or circle in whose opposite direction the contour has no fault, and for a circle the
-- region of its sense. @fits@ is true of elements without a fault. The element has to be
-- @suspected@, or beside an element or a link that is. Each item of the contour has to give one
-- element.
reversed ::
  (NonEmpty LinkedElement -> Bool) ->
  [Region] ->
  NonEmpty LinkedElement ->
  Maybe (Located ElementCarrier, Maybe Region)
reversed fits suspected linked
  | length (nubOrd (map itemRegion elements)) < length elements = Nothing
  | otherwise =
    listToMaybe
      [ (Located at (carrier w), word)
        | at <- nubOrd (suspected <> map elementRegion beside),
          w <- filter ((== at) . elementRegion) elements,
          Just (turnedElement, word) <- [opposite w],
          fits (fmap (\v -> if elementRegion v == at then turnedElement else v) linked)
      ]
  where
    elements = NonEmpty.toList linked
    beside =
      concat
        [ [a, b]
          | (a, b) <- zip elements (drop 1 (cycle elements)),
            any (`elem` suspected) ([elementRegion a, elementRegion b] <> linkRegion a)
        ]
    linkRegion w = [at | Just (at, _) <- [link w]]
    opposite w = case carrier w of
      OnLine (Line p q) ->
        Just
          ( w
              { carrier = OnLine (Line q p),
                ownStart = ownEnd w,
                ownEnd = ownStart w
              },
            Nothing
          )
      OnCircle sense c -> do
        word <- LinkError.senseRegion (itemRegion w) (Located (elementRegion w) (carrier w))
        Just (w {carrier = OnCircle (Carrier.oppositeSense sense) c}, Just word)
      OnCurve _ -> Nothing
      AtPoint _ -> Nothing

-- | Two links that meet near points and leave the contour without a fault if their points are
-- exchanged: the regions of these links and their points. @fits@ is true of elements without a
-- fault. At most 'mostNearPoints' links are looked at.
exchangedPoints ::
  (NonEmpty LinkedElement -> Bool) ->
  NonEmpty LinkedElement ->
  Maybe ((Region, Point), (Region, Point))
exchangedPoints fits linked =
  listToMaybe
    [ (a, b)
      | a : others <- tails (take mostNearPoints given),
        b <- others,
        fits (fmap (exchange a b) linked)
    ]
  where
    given = [(at, p) | LinkedElement {link = Just (at, Meet (Just p))} <- NonEmpty.toList linked]
    exchange (at, p) (at', q) w = case link w of
      Just (here, Meet (Just _))
        | here == at -> w {link = Just (here, Meet (Just q))}
        | here == at' -> w {link = Just (here, Meet (Just p))}
      _ -> w

-- | The largest number of links whose near points are exchanged with one another.
mostNearPoints :: Int
mostNearPoints = 8

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
