-- | The reference points of pieces (опорные точки): for each row of a curve's table, the position
-- of the cutter's centre where the cutter touches the part at this row.
--
-- Kolsanova's system printed them (sections 3 and 4): the path is in one-to-one correspondence with
-- the points of the surface. A row that a link has cut off the contour has no reference point, and
-- neither has a row that the cutter does not reach. At a corner of a curve the cutter has many
-- positions; the one behind the corner is given, or else the one before it.
module Toolpath.ReferencePoint
  ( PieceRows (..),
    ReferencePoint (..),
    ofPass,
  )
where

import Base.Quantity (Mm (..), minus, plus, times)
import Base.Region (Region)
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)
import Data.Vector qualified as Vector
import Geometry.Curve qualified as Curve
import Geometry.Curve.BasisCurve qualified as BasisCurve
import Geometry.Distance qualified as Distance
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree (BoxTree)
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Segment (Segment)
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Curve (PartCurve (exact))
import Part.Part (Contour, ContourElement, Milling, Part, SpacePoint (..))
import Part.Part qualified as Part
import Toolpath.Toolpath (Move, Pass, heights)
import Toolpath.Toolpath qualified as Toolpath

-- | A curve of a contour that has a table, and the points of its rows that lie on the contour.
data PieceRows = PieceRows
  { -- | the element of the contour as the program writes it
    element :: Region,
    -- | the count of rows of the table, also of those that are not on the contour
    rowCount :: Int,
    points :: [ReferencePoint]
  }
  deriving stock (Eq, Show)

-- | The reference point of a row.
data ReferencePoint = ReferencePoint
  { -- | the number of the row, from 1, in the direction of the curve
    row :: Int,
    -- | the point of the curve before the ciphers and joggles of a piece
    given :: Point,
    -- | the point of the contour, after the ciphers and joggles of a piece
    onPart :: Point,
    -- | the cutter's centre, with the height of the machine's z axis; Nothing if the cutter does
    -- not touch this point of the contour
    centre :: Maybe SpacePoint
  }
  deriving stock (Eq, Show)

-- | The reference points of a pass along a contour: its pieces in the order of the program. @part@
-- has the curves of the contour, which a toolpath does not keep. @cut@ are the moves along the
-- contour.
ofPass :: Part -> Milling -> Pass -> NonEmpty Move -> [PieceRows]
ofPass part job pass cut =
  [ PieceRows
      { element = Part.elementRegion e,
        rowCount = Curve.rowCount (exact c),
        points = pointsOf e (exact c)
      }
    | e <- writtenIn part (Part.contour job),
      Just c <- [Part.elementCurve e],
      Curve.rowCount (exact c) > 0
  ]
  where
    path = BoxTree.index (BoundingBox.ofSegment . Toolpath.segment) (NonEmpty.toList cut)
    pointsOf e curve =
      [ ReferencePoint {row = k, given, onPart, centre = centreAt path reach curve u}
        | (k, knot) <- zip [1 ..] (Vector.toList (BasisCurve.rows (Curve.base curve))),
          let u = BasisCurve.at knot,
          let given = BasisCurve.knotPoint knot,
          let onPart = Curve.at curve u,
          isNear Tolerance.curve id onPart edges
      ]
      where
        reach = plus (Toolpath.reach pass) (Part.allowance (Part.elementFinish e))
        edges =
          BoxTree.index
            BoundingBox.ofSegment
            [ Part.segment s
              | s <- NonEmpty.toList (Part.elements (Part.contour job)),
                Part.origin s == Part.elementRegion e
            ]

-- | The elements of a contour as the program writes them. A contour with another start or direction
-- no longer has them; then they are those of the contour with the same name.
writtenIn :: Part -> Contour -> [ContourElement]
writtenIn part contour =
  maybe [] Part.writtenElements . listToMaybe $
    [ c
      | c <- Part.contours part,
        Part.contourName c == Part.contourName contour
    ]

-- | The cutter's centre on the path, at the distance @reach@ from the curve's point with the
-- parameter @u@, along the curve's normal.
centreAt :: BoxTree Move -> Mm -> Curve.Curve -> Double -> Maybe SpacePoint
centreAt path (Mm reach) curve u =
  listToMaybe
    [ SpacePoint p (heightOn m p)
      | approach <- [Curve.After, Curve.Before],
        let normal = Vec.left (Curve.tangentFrom approach curve u),
        side <- [1, -1],
        let p = Vec.shift (Vec.scale (side * reach) normal) (Curve.at curve u),
        Just (d, m) <- [BoxTree.closest (Distance.toPoint p . Toolpath.segment) p path],
        d <= onPath
    ]
  where
    -- The arcs of the contour and those of the path both deviate from their curves.
    onPath = plus (times 2 Tolerance.curve) Tolerance.coincident
    heightOn m p =
      let (a, b) = heights m
          t = Distance.nearestFraction p (Toolpath.segment m)
       in plus a (times t (minus b a))

-- | True if a point is within the distance @d@ of one of the things, which have segments.
isNear :: Mm -> (a -> Segment) -> Point -> BoxTree a -> Bool
isNear d segmentOf p tree =
  case BoxTree.closest (Distance.toPoint p . segmentOf) p tree of
    Just (found, _) -> found <= plus d Tolerance.coincident
    Nothing -> False
