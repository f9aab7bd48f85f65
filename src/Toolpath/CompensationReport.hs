{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Texts of the errors about cutter compensation by the control.
module Toolpath.CompensationReport
  ( Unsupported (..),
    unsupported,
    shortMove,
    wrongWay,
    tightArc,
    tinyElement,
    slightCorner,
    sharpTip,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), Rad (..), times)
import Base.Region (Region)
import Data.Text (Text)
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Part (Element (..))
import Report.Report (Label (..), Report (..), at)
import Toolpath.ErrorFix qualified as ErrorFix
import Toolpath.Tolerance qualified as Tolerance
import Toolpath.WarningReport (inDegrees, secondLabel, shape)

-- | Requests that the input of a control with cutter compensation cannot express.
data Unsupported
  = -- | the cutter's centre moves on the contour
    OnContour
  | -- | a blade swivels
    Swivelling
  | -- | sharp outer corners instead of arcs
    SharpCorners
  | -- | an allowance
    LeavingMaterial
  | -- | rest material: parts of the contour that the cutter does not reach
    Unreached
  deriving stock (Eq, Show)

-- | Report of a request that a control cannot express; @region@ asks for compensation. The
-- arguments are the fields of 'Toolpath.Error.NotForControl'.
unsupported :: Region -> Unsupported -> Report
unsupported region what =
  (at region "E0416" "the control cannot compensate for the cutter here")
    { message = [unsent what],
      fixes = [ErrorFix.compensationFix region],
      hints = ["Or " <> unsentHint what | what /= Swivelling]
    }

-- | Report of an approach or retract that is too short, or is missing. The arguments are the fields
-- of 'Toolpath.Error.ShortForControl'.
shortMove :: LengthUnit -> Region -> Region -> Bool -> Mm -> Mm -> Report
shortMove unit region asked isIn length' radius' =
  ( at
      region
      "E0417"
      ( if length' > Mm 0
          then
            "the straight move "
              <> word
              <> " the contour is "
              <> Decimal.inUnit unit length'
              <> " long, but a control needs one longer than the cutter's radius, "
              <> Decimal.inUnit unit radius'
          else
            "there is no straight move "
              <> word
              <> " the contour on which a control could "
              <> act
      )
  )
    { others = [Label asked "asked here"],
      message =
        [ "On it the control goes over "
            <> ( if isIn
                   then "from the centre of the cutter to the edge of the part."
                   else "from the edge of the part to the centre of the cutter."
               )
        ],
      fixes = [ErrorFix.compensationFix asked],
      hints =
        [ if isIn
            then "Let the last approach point lie further away, at the height of the pass."
            else
              "Put a retract point beside the end of the contour, further away; without a \
              \height of its own."
        ]
    }
  where
    word = if isIn then "onto" else "away from"
    act =
      if isIn then "switch cutter compensation on" else "switch cutter compensation off"

-- | Report of an approach from a direction that a control does not accept. The arguments are the
-- fields of 'Toolpath.Error.WrongWayForControl'.
wrongWay :: LengthUnit -> Region -> Region -> Point -> Report
wrongWay unit region asked p =
  (at region "E0418" "a control cannot make this move onto the contour")
    { others = [Label asked "asked here"],
      message =
        [ "It ends at "
            <> Vec.toText unit 3 p
            <> ", and comes there out of the part, against the direction of travel, or nearly \
               \along an arc with a thin cutter."
        ],
      fixes = [ErrorFix.compensationFix asked],
      hints =
        [ "Let the last approach point lie beside the beginning of the contour or behind it, or \
          \lead in along an arc."
        ]
    }

-- | Report of a concave arc that a control cannot follow. The arguments are the fields of
-- 'Toolpath.Error.TightForControl'.
tightArc :: LengthUnit -> Region -> Region -> Maybe Element -> Mm -> Mm -> Report
tightArc unit region asked element old radius' =
  ( at
      (maybe region origin element)
      "E0419"
      ( "a control cannot keep a cutter of diameter "
          <> Decimal.inUnit unit (times 2 radius')
          <> " in a concave radius of "
          <> Decimal.inUnit unit old
      )
  )
    { label = maybe "the lead" (shape unit) element,
      others = [Label asked "asked here"],
      message =
        [ "The radius has to be larger than the cutter's by "
            <> Decimal.inUnit unit Tolerance.controlArc
            <> "."
        ],
      fixes = [ErrorFix.compensationFix asked],
      hints = ["Take a smaller cutter" <> maybe ", or a larger lead." (const ".") element]
    }

-- | Report of an element that is too short. The arguments are the fields of
-- 'Toolpath.Error.TinyForControl'.
tinyElement :: LengthUnit -> Region -> Region -> Maybe Element -> Mm -> Mm -> Report
tinyElement unit region asked element length' needed =
  ( at
      (maybe region origin element)
      "E0419"
      ("an element of " <> Decimal.inUnit unit length' <> " is too short for a control to follow")
  )
    { label = maybe "the lead" (shape unit) element,
      others = [Label asked "asked here"],
      message =
        [ if needed > Tolerance.controlLength
            then
              "Rounded to pulses it could seem to turn aside, and about the arc behind it the \
              \cutter has little room. Before that arc a line has to be "
                <> Decimal.inUnit unit needed
                <> " long, an arc as large in radius."
            else
              "Rounded to pulses it could seem to turn into the part. Elements have to be "
                <> Decimal.inUnit unit Tolerance.controlLength
                <> " long."
        ],
      fixes = [ErrorFix.compensationFix asked],
      hints =
        [ if maybe False ofCurve element
            then
              "A curve is cut where the cutter begins on it, which leaves such a piece here. \
              \Begin elsewhere: start near …"
            else "Leave it out, or let a neighbour take its place."
        ]
    }

-- | Report of a slight corner that a control ignores. The arguments are the fields of
-- 'Toolpath.Error.SlightForControl'.
slightCorner :: LengthUnit -> Region -> Element -> Element -> Rad -> Mm -> Report
slightCorner unit asked first second (Rad turned) deep =
  ( at
      (origin first)
      "E0419"
      ( "a control would cut " <> Decimal.inUnit unit deep
          <> " off the slight corner behind this element"
      )
  )
    { label = shape unit first,
      others = secondLabel unit first second <> [Label asked "asked here"],
      message =
        [ "It turns by "
            <> inDegrees (abs turned)
            <> ", and a control takes a corner of less than "
            <> inDegrees (let Rad b = Tolerance.controlBend in b)
            <> " for none; an arc behind it may then be refused."
        ],
      fixes = [ErrorFix.compensationFix asked],
      hints =
        [ "Join the elements smoothly, for instance with a fillet, or begin elsewhere: start \
          \near …"
        ]
    }

-- | Report of a corner at which the contour almost reverses. The arguments are the fields of
-- 'Toolpath.Error.BackForControl'.
sharpTip :: LengthUnit -> Region -> Element -> Element -> Rad -> Report
sharpTip unit asked first second (Rad turned) =
  (at (origin first) "E0419" "a control cannot follow the corner behind this element")
    { label = shape unit first,
      others = secondLabel unit first second <> [Label asked "asked here"],
      message =
        [ "It turns by "
            <> inDegrees (abs turned)
            <> ", and a control takes a corner of more than "
            <> inDegrees (let Rad b = Tolerance.controlBend in pi - b)
            <> " for one in which it cannot move."
        ],
      fixes = [ErrorFix.compensationFix asked],
      hints = ["Round the tip, for instance with a fillet."]
    }

-- | The reason why a control's input cannot express a request.
unsent :: Unsupported -> Text
unsent what = case what of
  OnContour -> "The cutter runs on the contour itself and has no side."
  Swivelling -> "A blade swivels while it cuts, and the control would not know how far."
  SharpCorners -> "The control goes round corners on arcs."
  LeavingMaterial -> "The control is told the diameter of the cutter, and leaves nothing standing."
  Unreached ->
    "The control goes along all of the edge, also where the cutter does not reach it: there it \
    \would cut into the part."

-- | The hint for a request that the input of a control cannot express.
unsentHint :: Unsupported -> Text
unsentHint what = case what of
  OnContour -> "take a side."
  Swivelling -> "take a mill."
  SharpCorners -> "leave out corners sharp."
  LeavingMaterial -> "mill the passes that leave something in a statement of their own."
  Unreached -> "take a smaller cutter."
