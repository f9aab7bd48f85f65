-- | Laws of the entities of DXF files.
module Export.DxfEntitySpec (spec) where

import Base.Quantity (LengthUnit (..), Mm (..), Rad (..), millimetresIn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Export.CadDrawing (CadForm (..), CadLayer (..), CadObject (..), OutlinePiece (..))
import Export.DxfEntity (DxfEntity (..))
import Export.DxfEntity qualified as DxfEntity
import Export.DxfGroup qualified as DxfGroup
import Generate qualified
import Geometry.Polyarc (Ends (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec = describe "entities of DXF files" $ do
  it "a contour is one closed polyline with the same segments (catches an arc to the other side)" $
    forAll (Generate.contour <$> Generate.closedCase) $ \polyarc ->
      forAll (elements [Millimetres, Inches]) $ \unit ->
        let segments = Polyarc.segments polyarc
            form = Outline "c" Closed (Mm 0, Mm 0) (Chain segments :| [])
         in case DxfEntity.entities unit (CadObject PartLayer form) of
              [DxfEntity {kind = "LWPOLYLINE", groups}] ->
                let drawn = polylineOf unit (values groups)
                 in counterexample (show drawn) $ sameLine (NonEmpty.toList segments) drawn
              others -> counterexample (show others) False
  it "an arc of a path has its ends and its sweep (catches ends that are exchanged)" $
    forAll arc $ \segment -> forAll (choose (-5, 5)) $ \z ->
      case DxfEntity.entities Millimetres (CadObject CutLayer (Motion segment (Mm z, Mm z))) of
        [DxfEntity {kind = "ARC", groups}] -> arcLaw segment z (values groups)
        [DxfEntity {kind = "LWPOLYLINE", groups}] ->
          property (sameLine [segment] (open (polylineOf Millimetres (values groups))))
        others -> counterexample (show others) False
  where
    open segments = take (length segments - 1) segments

-- | The codes and the values of groups.
values :: [DxfGroup.DxfGroup] -> [(Int, Text)]
values groups = pairs (Text.lines (DxfGroup.render groups))
  where
    pairs rows = case rows of
      code : value : more -> (read (Text.unpack code), value) : pairs more
      _ -> []

-- | The segments of a polyline, in mm, with the one that closes it.
polylineOf :: LengthUnit -> [(Int, Text)] -> [Segment]
polylineOf unit groups = zipWith joined vertices (drop 1 vertices <> take 1 vertices)
  where
    of' code = [real v | (c, v) <- groups, c == code]
    vertices = zip (zipWith place (of' 10) (of' 20)) (of' 42)
    place x y = Vec.point (x * millimetresIn unit) (y * millimetresIn unit)
    joined (p, bulge) (q, _) = Segment.fromBulge p q bulge

-- | True if the vertices and the middles of segments are the same. An arc may be divided in two.
sameLine :: [Segment] -> [Segment] -> Bool
sameLine wanted drawn = case (wanted, drawn) of
  ([], []) -> True
  (s : more, d : others)
    | near (Segment.start s) (Segment.start d),
      near (Segment.end s) (Segment.end d),
      near (Segment.at 0.5 s) (Segment.at 0.5 d) ->
      sameLine more others
    | near (Segment.start s) (Segment.start d),
      near (Segment.at 0.5 s) (Segment.end d),
      near (Segment.at 0.25 s) (Segment.at 0.5 d) ->
      sameLine (snd (Segment.cutAt 0.5 s) : more) others
  _ -> False

near :: Point -> Point -> Bool
near p q = Vec.distance p q <= Mm 1e-9

real :: Text -> Double
real = read . Text.unpack

-- | The law of an ARC: from the first to the second angle counter-clockwise, at a height.
arcLaw :: Segment -> Double -> [(Int, Text)] -> Property
arcLaw segment z groups =
  counterexample (show groups) $
    near (if turn > 0 then first else final) (Segment.start segment)
      && near (if turn > 0 then final else first) (Segment.end segment)
      && abs (swept - abs turn) <= 1e-9
      && value 30 == z
  where
    Rad turn = sweep segment
    value code = case [real v | (c, v) <- groups, c == code] of
      v : _ -> v
      [] -> 0 / 0
    at code = Vec.shift (Vec.polar (Mm (value 40)) (Rad (value code * pi / 180))) middle
    middle = Vec.point (value 10) (value 20)
    (first, final) = (at 50, at 51)
    swept =
      let d = (value 51 - value 50) * pi / 180
       in if d < 0 then d + 2 * pi else d

-- | Arcs of less than a full circle, some of them flat.
arc :: Gen Segment
arc = do
  r <- elements [0.5, 10, 300, 1e6]
  from <- choose (-pi, pi)
  turn <- (*) <$> elements [-1, 1] <*> (if r > 1e3 then choose (1e-5, 1e-3) else choose (0.1, 6))
  let m = Vec.point 7 (-3)
      at a = Vec.shift (Vec.polar (Mm r) (Rad a)) m
  pure Arc {start = at from, end = at (from + turn), centre = m, sweep = Rad turn}
