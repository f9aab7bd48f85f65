-- | What can be wrong with the contours of a pocket and the distance of its passes.
module Part.PocketError
  ( PocketMisfit (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (Mm (..), times)
import Base.Region (Region)
import Data.Text (Text)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Report.Report (Label (..), Report (..), ReportCode, ReportPlace (..), quote, report)
import Report.Report qualified as Report

-- | The place in the statement comes first.
data PocketMisfit
  = -- | an open contour as the outline or an island: its name, where it is defined
    OpenContour Region Name Region
  | -- | an island that does not lie inside the outline: both names
    Outside Region Name Name
  | -- | an island that lies inside another one: both names
    InIsland Region Name Name
  | -- | an island that crosses or touches another contour of its pocket: both names, whether that
    -- is the outline, where
    Meets Region Name Name Bool Point
  | -- | passes that lie further apart than the diameter of the cutter
    StepTooWide Region Mm Mm
  deriving stock (Eq, Show)

-- | The words for it.
toReport :: PocketMisfit -> Report
toReport misfit = case misfit of
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
  Meets region (Name name) (Name other) isOutline p ->
    ( at
        region
        "E0358"
        ( "the island "
            <> quote name
            <> " meets "
            <> (if isOutline then "the outline of the pocket" else "the island " <> quote other)
        )
    )
      { message =
          [ "They cross or touch at "
              <> Vec.written 4 p
              <> (if isOutline then "; the outline is " <> quote other <> "." else ".")
          ],
        hints =
          [ if isOutline
              then "What is joined to the wall is a part of the outline: draw the outline round it."
              else "Draw islands that grow together as one contour."
          ]
      }
  StepTooWide region apart diameter ->
    (at region "E0359" ("passes " <> Decimal.mm apart <> " apart leave material between them"))
      { message =
          [ "The cutter has a diameter of "
              <> Decimal.mm diameter
              <> "; a pass clears no more than that."
          ],
        hints =
          ["A usual step is half of the diameter: step " <> Decimal.mm (times 0.5 diameter) <> "."]
      }

at :: Region -> ReportCode -> Text -> Report
at region code = report Report.Error code (InSource region)
