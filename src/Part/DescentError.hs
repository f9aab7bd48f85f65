-- | Faults of the way down into the material, and of tabs.
module Part.DescentError
  ( DescentMisfit (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (LengthUnit, Mm (..), Rad, degrees)
import Base.Region (Region)
import Data.Text (Text)
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), at, quote)

-- | A fault of a descent or of tabs. The first field of every constructor is the region that the
-- report points at. The comment of a constructor names the other fields in order.
data DescentMisfit
  = -- | a setting of a statement without a depth: the word of the setting
    WithoutDepth Region Text
  | -- | a spiral of a statement whose depth has no step
    WithoutStep Region
  | -- | a lead-in before a descent that begins on the path: the word of the descent, and the region
    -- of the lead-in
    WithLead Region Text Region
  | -- | a setting beside compensation by the control: the word of the setting, and the region of
    -- the other one
    WithControl Region Text Region
  | -- | a setting for a blade that swivels: the word of the setting
    ForBlade Region Text
  | -- | a spiral along an open contour: its name
    OpenSpiral Region Name
  | -- | a helix that leaves a core: the diameter of its path, and that of the cutter
    CoreStays Region Mm Mm
  | -- | an angle that is not between the plane and the axis: the angle
    WrongSlope Region Rad
  | -- | tabs that are as high as the depth or higher: their height, the depth and its region
    TabsTooHigh Region Mm Mm Region
  deriving stock (Eq, Show)

-- | The report of a fault.
toReport :: LengthUnit -> DescentMisfit -> Report
toReport unit misfit = case misfit of
  WithoutDepth region word ->
    (at region "E0374" (quote word <> " needs the depth of the statement"))
      { hints = ["Write for example depth 6 mm step 2 mm."]
      }
  WithoutStep region ->
    (at region "E0374" "a spiral needs the depth of a lap")
      { hints = ["Write it as the step of the depth: depth 6 mm step 2 mm."]
      }
  WithLead region word lead ->
    (at region "E0374" (quote word <> " begins on the path, so there can be no lead-in"))
      { others = [Label lead "the lead-in"],
        hints = ["Leave the lead-in out. A lead-out is possible."]
      }
  WithControl region word there ->
    (at region "E0374" (quote word <> " is not possible with compensation by the control"))
      { others = [Label there "the control computes the offset"],
        fixes = [Fix.proposed (Fix.removal "Let the compiler compute the offset." there)]
      }
  ForBlade region word ->
    at region "E0374" (quote word <> " is not for a blade, whose height turns it")
  OpenSpiral region (Name name) ->
    (at region "E0374" ("the contour " <> quote name <> " is open, and a spiral goes round"))
      { hints = ["Write a ramp: it goes along the contour and back."]
      }
  CoreStays region path cutter ->
    (at region "E0374" "this helix leaves a core in its middle")
      { message =
          [ "The cutter's centre moves on a circle of "
              <> inUnit path
              <> ", and the cutter has a diameter of "
              <> inUnit cutter
              <> "."
          ],
        fixes =
          [Fix.proposed (Fix.exchange ("Write " <> inUnit cutter <> ".") region (inUnit cutter))],
        hints = ["The diameter of the helix is that of the path of the cutter's centre."]
      }
  WrongSlope region angle ->
    ( at
        region
        "E0374"
        ( "the angle has to be above 0 deg and below 90 deg, and this one is "
            <> Decimal.short 4 (degrees angle)
            <> " deg"
        )
    )
      { hints = ["It is the angle to the plane of x and y."]
      }
  TabsTooHigh region height depth there ->
    (at region "E0375" "these tabs are as high as the material, so nothing is cut at them")
      { message =
          ["They are " <> inUnit height <> " high, and the depth is " <> inUnit depth <> "."],
        others = [Label there "the depth"],
        hints = ["Write a height below the depth."]
      }
  where
    inUnit = Decimal.inUnit unit
