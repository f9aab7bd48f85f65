-- | Faults of a pocket: of its contours, and of the stepover between its passes.
module Part.PocketError
  ( PocketMisfit (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (LengthUnit, Mm (..), times)
import Base.Region (Region)
import Data.Text (Text)
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

-- | The sentence about the room that a cutter of the given diameter needs.
roomText :: LengthUnit -> Maybe Mm -> [Text]
roomText unit cutter =
  [ "To pass between them, the cutter needs its diameter of " <> Decimal.inUnit unit d <> "."
    | Just d <- [cutter]
  ]
