-- | What a path asks of the machine that hardly can be meant: a rapid move through the part, a tool that cuts and does not turn.
module Path.Caution
  ( warnings,
  )
where

import Base.Quantity (Mm (..))
import Base.Region (Located (..), Region)
import Data.List (minimumBy)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (mapMaybe)
import Data.Ord (comparing)
import Geometry.Box qualified as Box
import Geometry.Contour qualified as Contour
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec
import Geometry.Winding qualified as Winding
import Part.Part (Milling, Pace (..), Side (..), Work (..))
import Part.Part qualified as Part
import Path.Error (Warning (..))
import Path.Path (Block (..), Path)
import Path.Path qualified as Path

warnings :: Path -> [Warning]
warnings path = throughPart path <> standing path

-- | A closed line, and whether there is material inside it, as far as the program says.
data Body = Body {named :: Part.Contour, outline :: Contour.Contour, isMaterial :: Bool}

-- | Rapid moves below the top of the part, sideways, through what the innermost contour about them says to be the part; one for each stop. Where all is at one
-- height, that is below the top. A move that meets no contour is on one side of each all along; others are errors.
throughPart :: Path -> [Warning]
throughPart path =
  [ Through region (Path.segment m) (Part.contourName (named body))
    | (region, m) <- Map.toList (Map.fromListWith (\_ first -> first) [(Path.origin m, m) | m <- concatMap ways (Path.blocks path), Path.pace m == Rapid, Segment.length (Path.segment m) > Tolerance.coincident, isLow m]),
      Just body <- [innermost (Segment.at 0.5 (Path.segment m))],
      isMaterial body
  ]
  where
    isLow m = uncurry min (Path.heights m) < Mm 0 || isFlat
    isFlat = Path.isFlat path
    -- No move along a contour is rapid.
    ways b = case b of
      Cutting {approach, retract} -> approach <> retract
      _ -> Path.moves b
    index = Box.index boxOf (concatMap NonEmpty.toList (mapMaybe bodiesOf firsts))
    boxOf body = foldr1 Box.union (fmap Box.ofSegment (Contour.segments (outline body)))
    -- Passes of one statement tell the same.
    firsts = Map.elems (Map.fromListWith (\_ first -> first) [(n, b) | b <- Path.blocks path, n <- numberOf b])
    innermost p = case filter ((`Winding.encloses` p) . outline) (Box.within (Box.ofPoints p []) index) of
      [] -> Nothing
      found -> Just (minimumBy (comparing (abs . Contour.signedArea . outline)) found)
    numberOf b = case b of
      Cutting {pass} -> [Path.number pass]
      Clearing {pass} -> [Path.number pass]
      _ -> []

-- | What the contours of a pass say.
bodiesOf :: Block -> Maybe (NonEmpty.NonEmpty Body)
bodiesOf b = case b of
  Cutting {job = Located _ milling} -> NonEmpty.nonEmpty (bodyOf milling)
  Clearing {pocket = Located _ p} -> let room = Part.contour (Part.wall p) in Just (Body room (Part.outline room) False NonEmpty.:| [Body island (Part.outline island) True | island <- Part.islands p])
  _ -> Nothing

bodyOf :: Milling -> [Body]
bodyOf milling = case (Part.ends contour, value (Part.side milling)) of
  (Part.Closed, Outside) -> [whole True]
  (Part.Closed, Inside) -> [whole False]
  (Part.Closed, LeftSide) -> [whole (not isCounterClockwise)]
  (Part.Closed, RightSide) -> [whole isCounterClockwise]
  -- A turned part reaches to the axis of the spindle.
  (Part.Open, Outside) | Part.work milling == Turned -> [Body contour (Contour.Contour Part.Closed (segments <> (Straight end onAxis NonEmpty.:| [Straight onAxis before, Straight before begin]))) True]
  _ -> []
  where
    contour = Part.contour milling
    whole = Body contour (Part.outline contour)
    isCounterClockwise = Contour.signedArea (Part.outline contour) > 0
    segments = Contour.segments (Part.outline contour)
    begin = Segment.start (NonEmpty.head segments)
    end = Segment.end (NonEmpty.last segments)
    onAxis = Vec.point (Vec.x end) 0
    before = Vec.point (Vec.x begin) 0

-- | Tool changes behind which something is machined while nobody has let the spindle turn again. On a lathe the part turns, and goes on.
standing :: Path -> [Warning]
standing path = if Path.isTurned path then [] else go Resting (Path.blocks path)
  where
    go spindle blocks = case (spindle, blocks) of
      (_, []) -> []
      (_, Commanding (Located at c) : rest) -> go (commanded spindle at c) rest
      (_, Travelling _ _ : rest) -> go spindle rest
      (Stopped at, _ : rest) -> Standing at : go Resting rest
      (_, _ : rest) -> go spindle rest
    commanded spindle at c = case (c, spindle) of
      (Part.SpindleOn _ _, _) -> Turning
      (Part.SpindleOff, _) -> Resting
      (Part.ChangeTool _ _, Turning) -> Stopped at
      _ -> spindle

data Spindle
  = -- | or nothing is known of it
    Resting
  | Turning
  | -- | to change the tool
    Stopped Region
