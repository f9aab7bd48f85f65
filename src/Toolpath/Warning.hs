-- | Warnings about toolpaths that are probably mistakes: a rapid move through the part, or
-- cutting with a spindle at rest.
module Toolpath.Warning
  ( warnings,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Mm (..))
import Base.Region (Located (..), Region)
import Data.List (minimumBy, sortOn)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (isJust, mapMaybe)
import Data.Ord (comparing)
import Data.Text (Text)
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (Straight))
import Geometry.Segment qualified as Segment
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Geometry.WindingNumber qualified as WindingNumber
import Part.CutFeed (SpindleRate (..))
import Part.Part (Milling, Pace (..), Side (..), Work (..))
import Part.Part qualified as Part
import Toolpath.CarvingFloor (Floor (carvedBy))
import Toolpath.CarvingFloor qualified as CarvingFloor
import Toolpath.Error (Warning (..))
import Toolpath.LinkingMove qualified as LinkingMove
import Toolpath.Toolpath (Block (..), Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | All warnings about a toolpath: first rapid moves through the part, then rapid moves into
-- material that is not cleared or drilled yet, then tool changes after which the spindle is not
-- started again, then V-carvings whose tip is too wide, and those whose floor stays.
warnings :: Toolpath -> [Warning]
warnings path =
  concat
    [ throughPart path,
      intoContent path,
      intoHoles path,
      stoppedSpindles path,
      wideTips,
      map floorStays (CarvingFloor.uncleared path)
    ]
  where
    floorStays f = FloorStays f {carvedBy = LinkingMove.keyword 6 (carvedBy f)}
    wideTips =
      [ TipTooWide (LinkingMove.keyword 6 region) rest
        | Carved (Located region _) _ (Just rest) <- Toolpath.blocks path
      ]

-- | A closed contour. @isMaterial@ is true if the part is inside it, and false if the part is
-- outside.
data Body = Body {named :: Part.Contour, outline :: Polyarc.Polyarc, isMaterial :: Bool}

-- | Warnings about rapid moves through the part. A move goes through the part if it goes below the
-- top of the part, and the innermost contour around it contains material. When the whole toolpath
-- has one height, that height counts as below the top. A move that crosses a contour is an error
-- ("Toolpath.Intrusion"). So a move lies inside a contour if its midpoint does. Vertical moves are
-- left out. Of the moves that one region of the program asks for, only the first rapid one below
-- the top is examined.
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
    bore = boreRadius path
    -- Moves along a contour are never rapid.
    linkingMoves b = case b of
      Cutting {approach, descent, retract} -> approach <> descent <> retract
      _ -> Toolpath.moves b
    index =
      BoxTree.index
        boxOf
        (concatMap NonEmpty.toList (mapMaybe (bodiesOf bore . snd) (firstPasses path)))
    innermost p =
      case filter
        ((`WindingNumber.encloses` p) . outline)
        (BoxTree.within (BoundingBox.ofPoints p []) index) of
        [] -> Nothing
        found -> Just (minimumBy (comparing (abs . Polyarc.signedArea . outline)) found)

-- | Warnings about rapid moves into the content of a pocket or of a window before it is cleared; at
-- most one for each region of the program that asks for such moves. A /window/ is a closed contour
-- that is milled from its inside. Its content counts as cleared down to the height of each pass
-- that is done. Vertical moves upwards and the moves of drilling statements are left out. If the
-- whole toolpath has one height, it is not known where the cutter may enter, and there are no
-- warnings.
intoContent :: Toolpath -> [Warning]
intoContent path
  | Toolpath.isFlat path = []
  | otherwise =
    Map.elems (Map.fromListWith (\_ first -> first) (go Map.empty (Toolpath.blocks path)))
  where
    go cleared blocks = case blocks of
      [] -> []
      b : more -> case b of
        Travelling _ _ ms -> found cleared ms <> go cleared more
        Cutting {pass, approach, descent, retract} ->
          around cleared pass (approach <> descent) retract more
        Clearing {pass, approach, retract} -> around cleared pass approach retract more
        Holing _ _ -> go cleared more
        Carved {} -> go cleared more
        Commanding _ -> go cleared more
    around cleared pass approach retract more =
      let after = Map.insertWith min (Toolpath.number pass) (Toolpath.atHeight pass) cleared
       in found cleared approach <> found after retract <> go after more
    found cleared ms =
      [ (Toolpath.origin m, RapidIntoContent (Toolpath.origin m) p z (Part.contourName contour))
        | m <- ms,
          Toolpath.pace m == Rapid,
          Just (p, z) <- [lowestOf m],
          Just contour <- [holder bodies cleared p z]
      ]
    bodies =
      BoxTree.index
        (boxOf . snd)
        [ (n, body)
          | (n, b) <- firstPasses path,
            Just ofPass <- [bodiesOf (Mm 0) b],
            body <- NonEmpty.toList ofPass
        ]

-- | Hole of a drilling statement: the number of the block, the centre, the drill's radius, the
-- height of its bottom.
data DrilledHole = DrilledHole
  { holeBlock :: Int,
    holeAt :: Located Point,
    holeRadius :: Mm,
    holeBottom :: Mm
  }

-- | Warnings about rapid moves into the column of a hole before it is drilled down to there; at
-- most one for each region of the program that asks for such moves. Moves that rise vertically and
-- the moves of the drilling statements are left out.
intoHoles :: Toolpath -> [Warning]
intoHoles path =
  Map.elems
    ( Map.fromListWith
        (\_ first -> first)
        [ (Toolpath.origin m, RapidIntoHole (Toolpath.origin m) p z (region (holeAt hole)))
          | (n, b) <- numbered,
            m <- linksOf b,
            Toolpath.pace m == Rapid,
            Just (p, z) <- [lowestOf m],
            hole : _ <- [filter (isSolid n p z) (holesAt p)]
        ]
    )
  where
    numbered = zip [0 ..] (Toolpath.blocks path)
    linksOf b = case b of
      Travelling _ _ ms -> ms
      Cutting {approach, descent, retract} -> approach <> descent <> retract
      Clearing {approach, retract} -> approach <> retract
      Holing _ _ -> []
      Carved {} -> []
      Commanding _ -> []
    -- The hole @h@ is material at the height @z@ if no block before the block @n@ drills so deep.
    isSolid n p z h =
      holeBottom h < z && not (any (\o -> holeBlock o < n && holeBottom o <= z) (holesAt p))
    holesAt p =
      filter
        (\h -> Vec.distance p (value (holeAt h)) < holeRadius h)
        (BoxTree.within (BoundingBox.ofPoints p []) holes)
    holes =
      BoxTree.index
        (\h -> BoundingBox.inflate (holeRadius h) (BoundingBox.ofPoints (value (holeAt h)) []))
        [ DrilledHole n h mouth bottom
          | (n, Holing (Located _ d) _) <- numbered,
            Part.Hole h bottom mouth <- NonEmpty.toList (Part.holes d)
        ]

-- | The contour that still holds material at the point @p@ and the height @z@: the innermost one
-- around the point, if it is a window, and no window around the point is cleared to the height.
-- @bodies@ are all bodies with the numbers of their statements; @cleared@ has the height down to
-- which each statement has cleared, by its number.
holder :: BoxTree (Int, Body) -> Map Int Mm -> Point -> Mm -> Maybe Part.Contour
holder bodies cleared p z = case sortOn (area . snd) enclosing of
  (_, innermost) : _
    | not (isMaterial innermost) && all (isHeld . fst) windows -> Just (named innermost)
  _ -> Nothing
  where
    enclosing =
      filter
        ((`WindingNumber.encloses` p) . outline . snd)
        (BoxTree.within (BoundingBox.ofPoints p []) bodies)
    windows = filter (not . isMaterial . snd) enclosing
    isHeld n = z < Map.findWithDefault (Mm 0) n cleared
    area = abs . Polyarc.signedArea . outline

-- | The lowest position of a move below the top of the part: its middle if it is level, else its
-- lower end. Nothing for a move that rises vertically, and for one that is not below the top.
lowestOf :: Toolpath.Move -> Maybe (Point, Mm)
lowestOf m
  | min from to >= Mm 0 = Nothing
  | from == to = Just (Segment.at 0.5 s, to)
  | from > to = Just (Segment.end s, to)
  | Segment.length s > Tolerance.coincident = Just (Segment.start s, from)
  | otherwise = Nothing
  where
    s = Toolpath.segment m
    (from, to) = Toolpath.heights m

-- | The bounding box of a body.
boxOf :: Body -> BoundingBox
boxOf body = foldr1 BoundingBox.union (fmap BoundingBox.ofSegment (Polyarc.segments (outline body)))

-- | The first pass of each milling or pocket statement, with the number of the statement. All
-- passes of one statement have the same contours.
firstPasses :: Toolpath -> [(Int, Block)]
firstPasses path =
  Map.toList
    (Map.fromListWith (\_ first -> first) [(n, b) | b <- Toolpath.blocks path, n <- numberOf b])
  where
    numberOf b = case b of
      Cutting {pass} -> [Toolpath.number pass]
      Clearing {pass} -> [Toolpath.number pass]
      _ -> []

-- | The bodies at which a pass cuts: for a pass along a contour those of 'bodyOf', for a pocket its
-- outer contour and its islands. Nothing if there are none. @bore@ is the radius of a bore along
-- the axis of the spindle.
bodiesOf :: Mm -> Block -> Maybe (NonEmpty.NonEmpty Body)
bodiesOf bore b = case b of
  Cutting {job = Located _ milling} -> NonEmpty.nonEmpty (bodyOf bore milling)
  Clearing {pocket = Located _ p} | isJust (Part.surface p) -> Nothing
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
-- of the spindle closes it, or the bore of this radius.
bodyOf :: Mm -> Milling -> [Body]
bodyOf (Mm bore) milling = case (Part.ends contour, value (Part.side milling)) of
  (Part.Closed, Outside) -> [whole True]
  (Part.Closed, Inside) -> [whole False]
  (Part.Closed, LeftSide) -> [whole (not isCounterClockwise)]
  (Part.Closed, RightSide) -> [whole isCounterClockwise]
  -- A turned part extends from its profile to the axis of the spindle, or to its bore.
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
    inner = min bore (min (Vec.y begin) (Vec.y end))
    onAxis = Vec.point (Vec.x end) inner
    before = Vec.point (Vec.x begin) inner

-- | Largest radius to which a toolpath turns the inside of a part; 0 if it does not.
boreRadius :: Toolpath -> Mm
boreRadius path =
  maximum
    ( Mm 0 :
        [ Mm (max (Vec.y (Segment.start s)) (Vec.y (Segment.end s)))
          | Cutting {job = Located _ milling} <- Toolpath.blocks path,
            Part.work milling == Turned,
            value (Part.side milling) == Inside,
            s <- map Part.segment (NonEmpty.toList (Part.elements (Part.contour milling)))
        ]
    )

-- | Warnings about tool changes that stop a turning spindle, if the tool then cuts or drills
-- although the program has not started the spindle again. A toolpath for a lathe has no such
-- warnings, because the part keeps turning.
stoppedSpindles :: Toolpath -> [Warning]
stoppedSpindles path = if Toolpath.isTurned path then [] else go Resting (Toolpath.blocks path)
  where
    go spindle blocks = case (spindle, blocks) of
      (_, []) -> []
      (_, Commanding (Located at c) : rest) -> go (commanded spindle at c) rest
      (_, Travelling {} : rest) -> go spindle rest
      (Stopped at before', _ : rest) -> SpindleAtRest at before' : go Resting rest
      (_, _ : rest) -> go spindle rest
    commanded spindle at c = case (c, spindle) of
      (Part.SpindleOn sense speed, _) -> Turning (spindleText sense speed)
      (Part.SpindleOff, _) -> Resting
      (Part.SpindleByHand, _) -> Resting
      (Part.ChangeTool _ _, Turning text) -> Stopped at text
      _ -> spindle
    spindleText sense speed =
      "spindle "
        <> (case sense of Part.Clockwise -> "cw"; Part.CounterClockwise -> "ccw")
        <> case speed of
          NoRate -> ""
          TurnsPerMinute n -> " " <> Decimal.short 4 n <> " rpm"
          CuttingSpeed v limit ->
            " " <> Decimal.short 4 (v / 1000) <> " m/min limit " <> Decimal.short 4 limit <> " rpm"

-- | The state of the spindle while the blocks are executed.
data Spindle
  = -- | switched off, switched by hand, never switched on by the program, or already warned about;
    -- needs no warning
    Resting
  | -- | turning; the text is the statement that started it
    Turning Text
  | -- | stopped by the tool change in this region; the text is the statement that started it before
    Stopped Region Text
