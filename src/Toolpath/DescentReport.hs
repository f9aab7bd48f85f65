-- | Reports of ways down for which there is no room, and of tabs.
module Toolpath.DescentReport
  ( DescentFault (..),
    toReport,
    tabReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..))
import Base.Region (Region)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Report.Report (Label (..), Report (..), at)
import Toolpath.Tab (TabFault (..))

-- | A fault of a way down. The first field of every constructor is the region of the setting. The
-- comment of a constructor names the other fields in order.
data DescentFault
  = -- | a ramp or a spiral along a path without length, or in more than so many laps, strokes or
    -- turns
    TooManyTurns Region Int
  | -- | a helix without room: its centre, its diameter if the program gives it, and the largest
    -- diameter of the path of the centre for which there is room
    NoRoomForHelix Region Point (Maybe Mm) Mm
  | -- | a helix of a milling statement without an approach
    HelixWithoutApproach Region
  | -- | a helix with a wall between it and the first pass: its centre
    HelixBehindWall Region Point
  | -- | a spiral along a contour that the cutter does not reach everywhere
    SpiralInterrupted Region
  deriving stock (Eq, Show)

-- | The report of a fault of a way down.
toReport :: LengthUnit -> DescentFault -> Report
toReport unit fault = case fault of
  TooManyTurns region most ->
    ( at
        region
        "E0425"
        ("this way down takes more than " <> Decimal.whole most <> " turns")
    )
      { message = ["The path on which the cutter goes down is too short for so flat a slope."],
        hints = ["Write a larger angle or a larger pitch, or go straight down."]
      }
  NoRoomForHelix region p asked largest ->
    (at region "E0424" ("there is no room for this helix at " <> Vec.toText unit 3 p))
      { message =
          [ case asked of
              Just d ->
                "Its path has a diameter of " <> inUnit d <> ", and " <> inUnit largest <> " fits."
              Nothing -> "The largest path that fits has a diameter of " <> inUnit largest <> "."
          ],
        hints = ["Write a ramp along the path, another approach point, or a smaller diameter."]
      }
  HelixWithoutApproach region ->
    (at region "E0424" "the helix has no place")
      { hints = ["Its centre is the last approach point: approach (10, 10) rapid."]
      }
  HelixBehindWall region p ->
    ( at
        region
        "E0424"
        ( "a wall lies between the helix at "
            <> Vec.toText unit 3 p
            <> " and the first pass"
        )
    )
      { hints = ["Choose another approach point, or leave it out."]
      }
  SpiralInterrupted region ->
    (at region "E0425" "a spiral cannot follow a contour that the cutter does not reach everywhere")
      { hints = ["Write a ramp, or take a smaller cutter."]
      }
  where
    inUnit = Decimal.inUnit unit

-- | The report of a tab without room. @region@ is that of the setting, and @long@ the length of the
-- path on which the cutter rises over one tab.
tabReport :: LengthUnit -> Region -> Mm -> TabFault -> Report
tabReport unit region long fault = case fault of
  NoRoomFor k n ->
    ( at
        region
        "E0426"
        ("there is no room for tab " <> Decimal.whole k <> " of " <> Decimal.whole n)
    )
      { message =
          [ "Every tab has its share of the contour, and the cutter rises over "
              <> inUnit long
              <> " of its path, away from corners and small radii."
          ],
        hints = ["Write fewer or narrower tabs, or say where they are: tab at …"]
      }
  NoRoomNear there nearest ->
    (at there "E0426" "there is no room for a tab here")
      { message =
          [ "The cutter rises over "
              <> inUnit long
              <> " of its path, away from corners, small radii and the beginning of the contour."
          ],
        others = [Label region "the tabs"],
        hints =
          [ maybe
              "Write a narrower tab, or a steeper angle."
              ( \p ->
                  "The nearest place with room has the cutter's centre at "
                    <> Vec.toText unit 3 p
                    <> "."
              )
              nearest
          ]
      }
  TabsMeet a b ->
    (at b "E0426" "this tab meets another one")
      { others = [Label a "the other one"],
        hints = ["Leave one of them out, or move them apart."]
      }
  where
    inUnit = Decimal.inUnit unit
