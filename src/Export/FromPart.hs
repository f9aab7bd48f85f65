-- | The drawing of a part and its toolpath for CAD programs.
module Export.FromPart
  ( drawing,
  )
where

import Base.Name (Name (..))
import Base.Quantity (Mm (..))
import Base.Region (Located (..))
import Data.Containers.ListUtils (nubOrd)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isJust, isNothing)
import Data.Semigroup (sconcat)
import Draw.FromPart (isCut, isLastPass, sidedContours)
import Export.CadDrawing
  ( CadDrawing (..),
    CadForm (..),
    CadLayer (..),
    CadObject (..),
    OutlinePiece (..),
  )
import Export.ElementCurve qualified as ElementCurve
import Geometry.Carrier (Circle (Circle))
import Geometry.Segment qualified as Segment
import Geometry.Vec qualified as Vec
import Part.Part
  ( Contour (elements, ends),
    Element (origin, replaced, segment),
    Part,
    Solid (..),
  )
import Part.Part qualified as Part
import Toolpath.Toolpath (Block (..), Move, Pass, Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | The drawing of a part and its toolpath. Contours are those that pictures show: where they are
-- milled, or as the program gives them if nothing mills them.
drawing :: Part -> Toolpath -> CadDrawing
drawing part path =
  CadDrawing
    { title = fromMaybe (maybe "" text (Part.name part)) (Part.title part),
      unit = Part.unit part,
      objects =
        [ CadObject PartLayer (outline (piecesOf c) (Mm 0, Mm 0) c)
          | (c, _, _) <- sidedContours part
        ]
          <> map (CadObject HoleLayer) (holesOf part)
          <> concat [solid StockLayer s | Just (Located _ s) <- [Part.stock part]]
          <> concat [solid ClampLayer s | Located _ s <- Part.avoided part]
          <> concatMap motionsOf (Toolpath.blocks path)
          <> concatMap (nodesOf (isLastPass path)) (Toolpath.blocks path)
    }

-- | The outlines of a solid, from its bottom to its top. Curves are arcs here.
solid :: CadLayer -> Solid -> [CadObject]
solid layer Solid {outlines, lowest, highest} =
  [ CadObject layer (outline (Chain (fmap segment (elements c)) :| []) (lowest, highest) c)
    | c <- outlines
  ]

outline :: NonEmpty OutlinePiece -> (Mm, Mm) -> Contour -> CadForm
outline pieces heights c = Outline name (ends c) heights pieces
  where
    Located _ (Name name) = Part.contourName c

-- | The pieces of a contour. The arcs of a curve become the curve, where 'ElementCurve.along' finds
-- its part.
piecesOf :: Contour -> NonEmpty OutlinePiece
piecesOf c =
  merged (sconcat (fmap piecesOfRun (NonEmpty.groupBy1 isOneCurve (elements c))))
  where
    isOneCurve a b = isJust (replaced a) && isJust (replaced b) && origin a == origin b
    piecesOfRun run
      | isNothing (replaced (NonEmpty.head run)) = chain run :| []
      | otherwise = case along run of
        Just piece -> piece :| []
        -- One region can have several curves, one after the other.
        Nothing -> case Part.curveRuns (NonEmpty.toList run) of
          first : others -> fmap (\r -> fromMaybe (chain r) (along r)) (first :| others)
          [] -> chain run :| []
    along run@(e :| _) = do
      curve <- replaced e
      Smooth <$> ElementCurve.along curve (fmap segment run)
    chain = Chain . fmap segment

-- | Pieces in which neighbouring chains are one chain.
merged :: NonEmpty OutlinePiece -> NonEmpty OutlinePiece
merged (first :| others) = case others of
  [] -> first :| []
  next : more -> case (first, merged (next :| more)) of
    (Chain a, Chain b :| rest) -> Chain (a <> b) :| rest
    (_, rest) -> NonEmpty.cons first rest

-- | The holes of a part, each once for its circle and its bottom.
holesOf :: Part -> [CadForm]
holesOf part =
  [ HoleMark (Circle p (Mm r)) (Mm z)
    | (p, r, z) <-
        nubOrd
          [ (p, r, z)
            | Part.Drill (Located _ d) <- Part.operations part,
              Part.Hole (Located _ p) (Mm z) (Mm r) <- NonEmpty.toList (Part.holes d)
          ]
  ]

-- | The moves of a block. Moves without length are left out.
motionsOf :: Block -> [CadObject]
motionsOf block = case block of
  Travelling _ _ ms -> map (between LinkLayer) (moving ms)
  Cutting {approach, descent, cut, retract} ->
    links (approach <> descent) <> cuts (NonEmpty.toList cut) <> links retract
  Clearing {approach, cleared, retract} ->
    links approach
      <> [ between (if isCut m then CutLayer else LinkLayer) m
           | m <- moving (NonEmpty.toList cleared)
         ]
      <> links retract
  Holing _ ms -> cuts ms
  Carved _ ms _ -> cuts (NonEmpty.toList ms)
  Commanding _ -> []
  where
    links = map (between LinkLayer) . moving
    cuts = map (between CutLayer) . moving
    moving =
      filter
        (\m -> Segment.length (Toolpath.segment m) > Mm 0 || uncurry (/=) (Toolpath.heights m))

-- | A move on the layer for moves at feed, or on that of rapid moves.
between :: CadLayer -> Move -> CadObject
between atFeed m =
  CadObject
    { layer = case Toolpath.pace m of
        Part.Rapid -> RapidLayer
        Part.At _ -> atFeed,
      form = Motion (Toolpath.segment m) (Toolpath.heights m)
    }

-- | The nodes of a cut, with the numbers of the tables and pictures: the ends of its lines, arcs
-- and curves.
nodesOf :: (Pass -> Bool) -> Block -> [CadObject]
nodesOf isLast block = case block of
  Cutting {pass, cut}
    | isLast pass ->
      let runs = Toolpath.curveRuns (NonEmpty.toList cut)
          entry = NonEmpty.head cut
          begin = Segment.start (Toolpath.segment entry)
          places =
            (begin, fst (Toolpath.heights entry)) :
              [ (Segment.end (Toolpath.segment m), snd (Toolpath.heights m))
                | m <- map NonEmpty.last runs
              ]
          isClosed = Vec.isNear begin (fst (last places))
          shown = if isClosed then init places else places
       in [CadObject NodeLayer (NodeMark k p z) | (k, (p, z)) <- zip [0 ..] shown]
  Cutting {} -> []
  Clearing {} -> []
  Travelling {} -> []
  Holing _ _ -> []
  Carved {} -> []
  Commanding _ -> []
