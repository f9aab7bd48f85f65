{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Fixes of the errors of toolpaths: another size of the tool, another side, another start of the
-- contour, rest material, compensation by the compiler. All of them are proposals, because they
-- change the part or the way in which it is made.
module Toolpath.ErrorFix
  ( sizeFixes,
    restFix,
    filletFixes,
    sideFixes,
    startFix,
    compensationFix,
    heightFix,
    drillFixes,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), Rad (..), plus, times)
import Base.Region (Region)
import Base.Region qualified as Region
import Data.Text (Text)
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Element (..), MillingPlaces (..), Side (..), Work (..), plainFinish)
import Report.Fix (Fix)
import Report.Fix qualified as Fix
import Toolpath.Tolerance qualified as Tolerance
import Toolpath.WarningReport (Tool (..), fittingSize)

-- | Fix that writes the size of the largest tool that fits. @largest@ is its radius.
sizeFixes :: LengthUnit -> Tool -> Maybe Mm -> [Fix]
sizeFixes unit tool largest =
  [ Fix.proposed (Fix.exchange (largestText <> size <> ".") place size)
    | Just r <- [largest],
      r >= Tolerance.smallestCutter,
      let size = fittingSize unit tool r,
      Just place <- [toolSize (places tool)]
  ]
  where
    largestText = case work tool of
      Turned -> "Take the largest nose that fits: radius "
      _ -> "Take the largest cutter that fits: diameter "

-- | Fix that accepts the material that the tool does not reach.
restFix :: MillingPlaces -> Fix
restFix = setting "Let the material that it does not reach stay: rest allowed." "rest allowed"

-- | Fix that writes a setting at the end of a statement's block.
setting :: Text -> Text -> MillingPlaces -> Fix
setting title text milling =
  Fix.proposed (Fix.insertion title (Region.end (statement milling) - 1) ("  " <> text <> "\n"))

-- | Fix that rounds the corner between two lines with a fillet of the tool's radius. There is none
-- if the fillet takes more than half of a line.
filletFixes :: LengthUnit -> Tool -> Element -> Element -> [Fix]
filletFixes unit tool first second =
  [ Fix.proposed
      ( Fix.insertion
          ("Round the corner for this tool: " <> text <> ".")
          (Region.end (origin first))
          (" " <> text)
      )
    | finish first == plainFinish,
      Just r <- [filletRadius unit tool first second],
      let text = "fillet " <> (if turn first second > 0 then "-" else "") <> Decimal.inUnit unit r
  ]

-- | Radius of the fillet that the tool can follow at the corner between two lines, rounded up to
-- 0.001 mm or 0.0001 in. 'Nothing' if it takes more than half of one of them.
filletRadius :: LengthUnit -> Tool -> Element -> Element -> Maybe Mm
filletRadius unit tool first second = case (segment first, segment second) of
  (Straight a b, Straight _ c)
    | share <= half a b && share <= half b c -> Just (Mm r)
  _ -> Nothing
  where
    Mm least = plus (radius tool) (leaves tool)
    r = fromIntegral (ceiling (least * steps + 1) :: Int) / steps
    steps = Decimal.stepsPerMm unit
    share = Mm (r * tan (abs (turn first second) / 2))
    half p q = times 0.5 (Vec.distance p q)

-- | Angle from the direction of the first element to that of the second one; positive to the left.
turn :: Element -> Element -> Double
turn first second =
  let Rad a =
        Vec.signedAngle
          (Segment.endDirection (segment first))
          (Segment.startDirection (segment second))
   in a

-- | Fixes that put another side in place of the one in a region.
sideFixes :: Region -> [Side] -> [Fix]
sideFixes region sides =
  [ Fix.proposed (Fix.exchange ("Write " <> word <> ", " <> meaning <> ".") region word)
    | side <- sides,
      let (word, meaning) = wordOf side
  ]
  where
    wordOf side = case side of
      LeftSide -> ("left", "left of the direction of travel")
      RightSide -> ("right", "right of the direction of travel")
      On -> ("on", "with the centre of the cutter on the contour")
      Outside -> ("outside", "around the contour")
      Inside -> ("inside", "within the contour")

-- | Fix that lets a contour begin near the point from which the cutter comes.
startFix :: LengthUnit -> MillingPlaces -> Point -> Fix
startFix unit milling from =
  let text = "start near " <> Vec.toText unit 3 from
   in setting ("Let the contour begin where the cutter comes from: " <> text <> ".") text milling

-- | Fix that leaves the compensation to the compiler. @asked@ is the setting that asks the control
-- for it.
compensationFix :: Region -> Fix
compensationFix asked =
  Fix.proposed
    ( Fix.exchange
        "Let the compiler compute the path of the cutter's centre: compensation compiler."
        asked
        "compensation compiler"
    )

-- | Fix that lets an approach end at the top of the part.
heightFix :: LengthUnit -> Region -> Point -> Fix
heightFix unit region p =
  let text = "(" <> Vec.coordinates unit p <> ", 0)"
   in Fix.proposed (Fix.exchange ("Approach at the top of the part: " <> text <> ".") region text)

-- | Fix that takes the largest drill that keeps clear of a contour. @r@ is its radius.
drillFixes :: LengthUnit -> Maybe Region -> Mm -> [Fix]
drillFixes unit size (Mm r) =
  [ Fix.proposed (Fix.exchange ("Take the largest drill that fits: " <> text <> ".") place text)
    | Mm r >= Tolerance.smallestCutter,
      let text = Decimal.inUnit unit (Decimal.roundedDown unit (Mm (2 * r))),
      Just place <- [size]
  ]
