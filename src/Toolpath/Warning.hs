-- | Warnings about toolpaths that are probably mistakes: a rapid move through the part, or
-- cutting with a spindle at rest.
module Toolpath.Warning
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
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Part.Part (Milling, Pace (..), Side (..), Work (..))
import Part.Part qualified as Part
import Toolpath.Error (Warning (..))
import Toolpath.Toolpath (Block (..), Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | All warnings about a toolpath: first rapid moves through the part, then tool changes after
-- which the spindle is not started again.
warnings :: Toolpath -> [Warning]
warnings path = throughPart path <> stoppedSpindles path

-- | A closed contour. @isMaterial@ is true if the part is inside it, and false if the part is
-- outside.
data Body = Body {named :: Part.Contour, outline :: Polyarc.Polyarc, isMaterial :: Bool}

-- | Warnings about rapid moves through the part; at most one for each region of the program that
-- asks for such moves. Vertical moves are left out. A move goes through the part if it goes below
-- the top of the part, and the innermost contour around it contains material. When the whole
-- toolpath has one height, that height counts as below the top. A move that crosses a contour is an
-- error ("Toolpath.Intrusion"). So a move lies inside a contour if its midpoint does.
throughPart :: Toolpath -> [Warning]
throughPart path =
  [ RapidThroughPart region (Toolpath.segment m) (Part.contourName (named body))
    | (region, m) <-
        Map.toList
          ( Map.fromListWith
              (\_ first -> first)
              [ (Toolpath.origin m, m)
                | m <- concatMap linkingMoves (Toolpath.blocks path),
                  Toolpath.pace m == Rapid,
                  Segment.length (Toolpath.segment m) > Tolerance.coincident,
                  isLow m
              ]
          ),
      Just body <- [innermost (Segment.at 0.5 (Toolpath.segment m))],
      isMaterial body
  ]
  where
    isLow m = uncurry min (Toolpath.heights m) < Mm 0 || isFlat
    isFlat = Toolpath.isFlat path
    -- Moves along a contour are never rapid.
    linkingMoves b = case b of
      Cutting {approach, retract} -> approach <> retract
      _ -> Toolpath.moves b
    index = BoxTree.index boxOf (concatMap NonEmpty.toList (mapMaybe bodiesOf firsts))
    boxOf body =
      foldr1 BoundingBox.union (fmap BoundingBox.ofSegment (Polyarc.segments (outline body)))
    -- All passes of one statement have the same contours.
    firsts =
      Map.elems
        (Map.fromListWith (\_ first -> first) [(n, b) | b <- Toolpath.blocks path, n <- numberOf b])
    innermost p =
      case filter
        ((`WindingNumber.encloses` p) . outline)
        (BoxTree.within (BoundingBox.ofPoints p []) index) of
        [] -> Nothing
        found -> Just (minimumBy (comparing (abs . Polyarc.signedArea . outline)) found)
    numberOf b = case b of
      Cutting {pass} -> [Toolpath.number pass]
      Clearing {pass} -> [Toolpath.number pass]
      _ -> []

-- | The bodies at which a pass cuts: for a pass along a contour those of 'bodyOf', for a pocket its
-- outer contour and its islands. Nothing if there are none.
bodiesOf :: Block -> Maybe (NonEmpty.NonEmpty Body)
bodiesOf b = case b of
  Cutting {job = Located _ milling} -> NonEmpty.nonEmpty (bodyOf milling)
  Clearing {pocket = Located _ p} ->
    let outer =
          Part.contour (Part.wall p)
     in Just
          ( Body
              outer
              (Part.polyarcOf outer)
              False
              NonEmpty.:| [Body island (Part.polyarcOf island) True | island <- Part.islands p]
          )
  _ -> Nothing

-- | The body of a milling statement's contour. Empty if the cutter's centre moves on the contour,
-- and for an open contour. The one exception is a profile turned outside: it is open, but the axis
-- of the spindle closes it.
bodyOf :: Milling -> [Body]
bodyOf milling = case (Part.ends contour, value (Part.side milling)) of
  (Part.Closed, Outside) -> [whole True]
  (Part.Closed, Inside) -> [whole False]
  (Part.Closed, LeftSide) -> [whole (not isCounterClockwise)]
  (Part.Closed, RightSide) -> [whole isCounterClockwise]
  -- A turned part extends from its profile to the axis of the spindle.
  (Part.Open, Outside)
    | Part.work milling == Turned ->
      [ Body
          contour
          ( Polyarc.Polyarc
              Part.Closed
              ( segments
                  <> ( Straight
                         end
                         onAxis
                         NonEmpty.:| [Straight onAxis before, Straight before begin]
                     )
              )
          )
          True
      ]
  _ -> []
  where
    contour = Part.contour milling
    whole = Body contour (Part.polyarcOf contour)
    isCounterClockwise = Polyarc.signedArea (Part.polyarcOf contour) > 0
    segments = Polyarc.segments (Part.polyarcOf contour)
    begin = Segment.start (NonEmpty.head segments)
    end = Segment.end (NonEmpty.last segments)
    onAxis = Vec.point (Vec.x end) 0
    before = Vec.point (Vec.x begin) 0

-- | Warnings about tool changes that stop a turning spindle, if the tool then cuts or drills
-- although the program has not started the spindle again. A toolpath for a lathe has no such
-- warnings, because the part keeps turning.
stoppedSpindles :: Toolpath -> [Warning]
stoppedSpindles path = if Toolpath.isTurned path then [] else go Resting (Toolpath.blocks path)
  where
    go spindle blocks = case (spindle, blocks) of
      (_, []) -> []
      (_, Commanding (Located at c) : rest) -> go (commanded spindle at c) rest
      (_, Travelling _ _ : rest) -> go spindle rest
      (Stopped at, _ : rest) -> SpindleAtRest at : go Resting rest
      (_, _ : rest) -> go spindle rest
    commanded spindle at c = case (c, spindle) of
      (Part.SpindleOn _ _, _) -> Turning
      (Part.SpindleOff, _) -> Resting
      (Part.ChangeTool _ _, Turning) -> Stopped at
      _ -> spindle

-- | The state of the spindle while the blocks are executed.
data Spindle
  = -- | switched off, never switched on by the program, or already warned about; needs no warning
    Resting
  | Turning
  | -- | stopped by the tool change in this region
    Stopped Region
