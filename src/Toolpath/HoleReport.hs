-- | The report of a hole that cuts into a contour.
module Toolpath.HoleReport
  ( HoleCut (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), minus, times)
import Base.Region (Located (..), Region)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.ErrorText (andMore)
import Part.Part (Drilling, Element (origin))
import Part.Part qualified as Part
import Report.Report (Label (..), Report (..), at)
import Toolpath.ErrorFix qualified as ErrorFix
import Toolpath.WarningReport (shape)

-- | A hole that cuts into a contour.
data HoleCut = HoleCut
  { -- | the region of the hole
    hole :: Region,
    centre :: Point,
    -- | the centres of other holes of this region that cut into a contour
    also :: [Point],
    -- | the element that is cut
    element :: Element,
    depth :: Mm,
    -- | the statement of the hole
    drilling :: Drilling
  }
  deriving stock (Eq, Show)

-- | The words for a hole and for its tool, and the radius of the tool in the hole.
data Words = Words Text Text Mm

-- | The report of a hole that cuts into a contour.
toReport :: LengthUnit -> HoleCut -> Report
toReport unit HoleCut {hole, centre, also, element, depth, drilling} =
  ( at hole "E0413" $
      "the " <> name <> " at " <> point centre <> " cuts into a contour by "
        <> Decimal.inUnit unit depth
  )
    { others =
        [ Label (origin element) ("it cuts " <> shape unit element)
          | origin element /= hole
        ],
      message =
        ["The " <> tool <> " has a diameter of " <> Decimal.inUnit unit (times 2 radius) <> "."]
          <> [ "So " <> (case also of [_] -> "does the " <> name; _ -> "do the " <> name <> "s")
                 <> " at "
                 <> Text.intercalate " and " (map point (take 3 also))
                 <> andMore 3 also
                 <> "."
               | not (null also)
             ],
      fixes =
        if isDrill
          then ErrorFix.drillFixes unit (Part.drillSize drilling) (minus radius depth)
          else [],
      hints =
        [ "Correct the place of the " <> name <> " or the contour, or "
            <> (if isDrill then "change the tool before drilling." else "take another tool.")
        ]
    }
  where
    Words name tool radius = wordsFor drilling centre
    isDrill = tool == "drill"
    point = Vec.toText unit 3

-- | The words for the hole of a statement whose centre is at a point.
wordsFor :: Drilling -> Point -> Words
wordsFor drilling p = case Part.form drilling of
  Part.Reamed -> Words "hole" "reamer" radius
  Part.Tapped _ -> Words "thread" "tap" radius
  Part.Threaded _ -> Words "thread" "thread mill" radius
  Part.Bored _ -> Words "hole" "cutter" radius
  Part.Plunged
    | mouth : _ <- [m | Part.Hole (Located _ c) _ m <- holes, Vec.isNear c p, m < radius] ->
      Words "countersink" "countersink" mouth
    | otherwise -> Words "hole" "drill" radius
  where
    radius = Part.drillRadius drilling
    holes = NonEmpty.toList (Part.holes drilling)
