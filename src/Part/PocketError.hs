-- | Faults of a pocket: of its contours, and of the stepover between its passes.
module Part.PocketError
  ( PocketMisfit (..),
    EarlierOperation (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (LengthUnit, Mm (..), times)
import Base.Region (Region (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), at, quote)

-- | A fault of a pocket. The first field of every constructor is the region of the wrong expression
-- in the pocket statement. The comment of a constructor names the other fields in order.
data PocketMisfit
  = -- | an open contour as the outline or as an island: the name, and the region of the definition
    OpenContour Region Name Region
  | -- | an island that lies outside of the outline: the names of the island and of the outline
    Outside Region Name Name
  | -- | an island that lies inside another island: the names of the inner and of the outer island
    InIsland Region Name Name
  | -- | an island that crosses or touches another contour: the names of the island and of that
    -- contour, the regions of their definitions, true if that contour is the outline, a common
    -- point, and the diameter of the cutter if it is known
    Meets Region Name Name (Region, Region) Bool Point (Maybe Mm)
  | -- | a stepover that exceeds the diameter of the cutter: the stepover, and the diameter
    StepTooWide Region Mm Mm
  | -- | a pocket whose rest is to be cleared, and which is cleared outside of the transformation:
    -- the region of its statement
    RestElsewhere EarlierOperation Region Region
  | -- | such a pocket without a depth: the region of its statement
    RestWithoutDepth Region Region
  | -- | a cutter that is not smaller than that of the pocket: the region of the pocket's statement,
    -- and the radii of the cutter and of that of the pocket
    RestNotSmaller Region Region Mm Mm
  | -- | a depth below that of the pocket: the region of the pocket's statement, and the lowest
    -- heights of the rest operation and of the pocket
    RestTooDeep EarlierOperation Region Region Mm Mm
  | -- | a cutter that fits into no floor of a V-carving: the region of the V-carving, and the
    -- diameter of the cutter
    NoFloor Region Region Mm
  deriving stock (Eq, Show)

-- | The kind of an operation that leaves something to a later one.
data EarlierOperation = EarlierPocket | EarlierCarving
  deriving stock (Eq, Show)

-- | The report of a fault.
toReport :: LengthUnit -> PocketMisfit -> Report
toReport unit misfit = case misfit of
  OpenContour region (Name name) there ->
    (at region "E0356" ("the contour " <> quote name <> " is open and has no inside"))
      { others = [Label there "this contour is open"],
        hints =
          [ "The outline of a pocket and its islands are closed contours: contour "
              <> name
              <> " closed { … }"
          ]
      }
  Outside region (Name name) (Name outline) ->
    (at region "E0357" ("the island " <> quote name <> " lies outside the pocket"))
      { message = ["The outline of the pocket is " <> quote outline <> "."],
        hints = ["Correct the numbers, or leave the island out."]
      }
  InIsland region (Name name) (Name other) ->
    (at region "E0357" ("the island " <> quote name <> " lies inside the island " <> quote other))
      { message = ["All of " <> quote other <> " stays standing already."],
        hints = ["Leave one of them out. A hollow in an island is a pocket of its own."]
      }
  Meets region (Name name) (Name outline) (island, there) True p cutter ->
    (at region "E0358" ("the island " <> quote name <> " meets the outline of the pocket"))
      { others = [Label island "the island", Label there "the outline"],
        message =
          [ "They cross or touch at "
              <> Vec.toText unit 4 p
              <> "; the outline is "
              <> quote outline
              <> "."
          ]
            <> roomText unit cutter,
        hints =
          [ "Correct the place or the size of "
              <> quote name
              <> ". Or, if it is to be joined to the wall, draw the outline round it."
          ]
      }
  Meets region (Name name) (Name other) (first, second) False p cutter ->
    (at region "E0358" ("the island " <> quote name <> " meets the island " <> quote other))
      { others = [Label r "this island" | r <- [first, second]],
        message = ["They cross or touch at " <> Vec.toText unit 4 p <> "."] <> roomText unit cutter,
        hints =
          [ "Correct the place or the size of one of them. Or draw islands that grow together as \
            \one contour."
          ]
      }
  StepTooWide region stepover diameter ->
    ( at
        region
        "E0359"
        ("passes with a step of " <> Decimal.inUnit unit stepover <> " leave material between them")
    )
      { message =
          [ "The cutter has a diameter of "
              <> Decimal.inUnit unit diameter
              <> "; a pass clears no more than that."
          ],
        fixes =
          [ Fix.proposed
              ( Fix.exchange
                  ("Write half of the diameter, a usual step: " <> half <> ".")
                  region
                  half
              )
            | let half = Decimal.inUnit unit (times 0.5 diameter)
          ]
      }
  RestElsewhere kind region there ->
    ( at
        region
        "E0382"
        (before kind "this pocket is cleared" "this region is carved" <> " outside of the block")
    )
      { others =
          [ Label (firstWord there) $
              before kind "the pocket is cleared here" "the region is carved here"
          ],
        message =
          [ "The transformation would move what is to be cleared away from the " <> noun kind <> "."
          ],
        hints =
          [ "Write the " <> noun kind <> " into the same block, or this statement outside of it."
          ]
      }
  NoFloor region there diameter ->
    (at region "E0378" "the cutter fits into no floor of this V-carving")
      { others = [Label (firstWord there) "this V-carving"],
        message =
          [ "The cutter has a diameter of " <> Decimal.inUnit unit diameter
              <> " and has to stay clear of the flanks."
          ],
        hints = ["Change to a smaller cutter, or leave the statement out if there is no floor."]
      }
  RestWithoutDepth region there ->
    (at region "E0383" "the pocket has no depth, so what it leaves cannot be cleared")
      { others = [Label (firstWord there) "this pocket"],
        message = ["From one place of the rest to the next the cutter has to be lifted."],
        hints = ["Give the pocket a depth, for example depth 5."]
      }
  RestNotSmaller region there own rough ->
    (at region "E0380" "the cutter is not smaller than that of the pocket")
      { others = [Label (firstWord there) "this pocket"],
        message =
          [ "The cutter has a diameter of " <> Decimal.inUnit unit (times 2 own)
              <> ", that of the pocket "
              <> Decimal.inUnit unit (times 2 rough)
              <> ". It reaches nothing more."
          ],
        hints = ["Change to a smaller cutter before this statement."]
      }
  RestTooDeep kind region there own rough ->
    ( at
        region
        "E0381"
        ("the " <> noun kind <> " is only " <> deep rough <> " deep")
    )
      { others = [Label (firstWord there) ("this " <> noun kind)],
        message = ["Down to " <> deep own <> " the cutter would be in the full material."],
        fixes =
          [ Fix.proposed
              ( Fix.exchange
                  ("Write the depth of the " <> noun kind <> ", " <> deep rough <> ".")
                  region
                  (deep rough)
              )
          ],
        hints =
          [ before
              kind
              "Without a depth, the rest is cleared in the passes of the pocket."
              "Without a depth, the floor is cleared at the depth of the V-carving."
          ]
      }
  where
    noun kind = before kind "pocket" "V-carving"
    before kind ofPocket ofCarving = case kind of
      EarlierPocket -> ofPocket
      EarlierCarving -> ofCarving :: Text
    deep z = Decimal.inUnit unit (times (-1) z)
    firstWord there = there {end = start there + Text.length "pocket"}

-- | The sentence about the room that a cutter of the given diameter needs.
roomText :: LengthUnit -> Maybe Mm -> [Text]
roomText unit cutter =
  [ "To pass between them, the cutter needs its diameter of " <> Decimal.inUnit unit d <> "."
    | Just d <- [cutter]
  ]
