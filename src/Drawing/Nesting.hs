-- | The nesting of closed outlines: how many others each one lies in.
module Drawing.Nesting
  ( depths,
  )
where

import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Drawing.Drawing (PathPart (..))
import Drawing.Outline (DrawnPart (..), Outline (..))
import Drawing.PathPart qualified as PathPart
import Geometry.Index.BoundingBox (BoundingBox)
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Index.BoxTree qualified as BoxTree
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Segment (Segment (Straight))
import Geometry.WindingNumber qualified as WindingNumber

-- | Count of the other outlines around each outline. The outlines are closed, and no two of them
-- cross or touch. A curve counts as a polygon through points of it; an outline between
-- this polygon and the curve is not told apart.
depths :: [Outline] -> [Int]
depths outlines =
  [ length
      [ ()
        | (j, _, around) <- BoxTree.within (BoundingBox.ofPoints p []) index,
          j /= k,
          WindingNumber.encloses around p
      ]
    | (k, o) <- zip [0 :: Int ..] outlines,
      let p = PathPart.start (part (NonEmpty.head (parts o)))
  ]
  where
    index =
      BoxTree.index
        (\(_, box, _) -> box)
        [ (k, boxOf s, Polyarc Closed s)
          | (k, o) <- zip [0 :: Int ..] outlines,
            let s = segmentsOf o
        ]

boxOf :: NonEmpty Segment -> BoundingBox
boxOf segments = foldr1 BoundingBox.union (fmap BoundingBox.ofSegment segments)

-- | The segments of an outline, with curves replaced by polygons.
segmentsOf :: Outline -> NonEmpty Segment
segmentsOf o = case concatMap (ofPiece . part) (NonEmpty.toList (parts o)) of
  s : more -> s :| more
  [] -> let p = PathPart.start (part (NonEmpty.head (parts o))) in Straight p p :| []

ofPiece :: PathPart -> [Segment]
ofPiece p = case p of
  Plain s -> [s]
  _ -> let ps = PathPart.points p in zipWith Straight ps (drop 1 ps)
