-- | Features of parts that the numbers of an input sheet cannot express, and the reports on them.
--
-- An input sheet is the form of numbers that the Minsk-22 system reads. A piece is a curve with its
-- recalculations, each of which shifts the curve along its normal. The cipher of a piece has a
-- digit 1, 2, 4 or 6 for each recalculation. An array is a sequence of linked pieces.
module Sheet.Unsupported
  ( Unfit (..),
    Feature (..),
    PieceFault (..),
    LinkFeature (..),
    UnsupportedCipher (..),
    FeedFault (..),
    SharedSetting (..),
    PathFault (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Region (..))
import Data.Text (Text)
import Report.Report (Report (..), ReportPlace (..), Severity (..), at, report)
import Sheet.Sheet (maxArrays)

-- | The reason why a part cannot become a sheet. The region is the part of the program's text that
-- is at fault.
data Unfit
  = -- | A sheet has no numbers for this statement or for one of its settings.
    NoNumbers Region Feature
  | -- | An element cannot become a piece, or a contour cannot become an array of pieces.
    NoPiece Region PieceFault
  | -- | A sheet has no number for the link after this element.
    NoLink Region LinkFeature
  | -- | No cipher expresses the recalculations of this element.
    NoCipher Region UnsupportedCipher
  | -- | A sheet has no number for this feed.
    NoFeed Region FeedFault
  | -- | A sheet has this setting only once, but the contour's value differs from that of the first
    -- contour.
    TwoOfOne Region SharedSetting
  | -- | A sheet cannot express the toolpath of the program.
    NoPath PathFault
  | -- | The contour at this region is one more than 'maxArrays' allows.
    ManyArrays Region
  deriving stock (Eq, Ord, Show)

-- | A feature of the language that the numbers of a sheet cannot express.
data Feature
  = PocketClearing
  | DrillingHoles
  | CarvingRegion
  | SpindleCommand
  | CoolantCommand
  | AuxiliaryCommand
  | StopCommand
  | DwellCommand
  | SecondTool
  | -- | different tolerances inside and outside of the contour
    BandTolerance
  | -- | the side @outside@; a sheet has left and right only
    OutsideOfContour
  | -- | the side @inside@; a sheet has left and right only
    InsideOfContour
  | TurningContour
  | Depth
  | -- | a lead-in or a lead-out
    Lead
  | -- | an allowance for the whole contour
    ContourAllowance
  | -- | the setting by which the offset keeps sharp corners
    SharpCorner
  | -- | cutter compensation by the control
    ControlCompensation
  deriving stock (Eq, Ord, Show)

-- | The reason why an element cannot become a piece, or a contour an array of pieces.
data PieceFault
  = -- | a curve without points
    NoPoints
  | -- | a curve that is neither a natural spline nor a straight line
    OtherCurve
  | -- | an element that is not a curve: a line, a circle or a point
    PlainElement
  | ClosedContour
  | -- | a contour that is computed from others, so that the program does not write its elements
    DerivedContour
  | -- | an element of a contour that is itself a contour
    NestedContour
  deriving stock (Eq, Ord, Show)

-- | A link that a sheet does not have.
data LinkFeature
  = -- | an intersection with a selector, such as @near@
    ChosenIntersection
  | TangentLink
  | ChamferLink
  deriving stock (Eq, Ord, Show)

-- | The reason why the recalculations of a piece have no cipher.
data UnsupportedCipher
  = -- | a recalculation with digit 4 and an allowance
    AllowanceOfFour
  | -- | a recalculation with digit 1 whose distance changes only between two given points
    GrowthBetweenPoints
  | HasJoggle
  | -- | several recalculations with different bevels
    DifferentBevels
  | -- | several recalculations with digit 4 and different flange heights
    DifferentHeights
  | -- | a distance that is not measured square to the surface, on a piece with a bevel
    DistanceNotSquare
  | -- | a blade that does not swivel on a piece with a bevel
    NotSwivelling
  | -- | a blade that swivels by a bevel other than that of the piece
    OtherSwivel
  deriving stock (Eq, Ord, Show)

-- | The reason why a feed has no number on a sheet.
data FeedFault
  = -- | the move from a contour to the next point has another feed than the contour
    LeavingFeed
  | -- | the feed is 'Sheet.Sheet.rapidFeed' or more
    FeedTooHigh
  | -- | the feed is for one turn of the spindle
    FeedForTurn
  deriving stock (Eq, Ord, Show)

-- | A setting that applies to a whole sheet.
data SharedSetting = SharedTool | SharedTolerance | SharedSide
  deriving stock (Eq, Ord, Show)

-- | The reason why the toolpath of a program is not that of a sheet.
data PathFault
  = -- | the program gives no starting position
    NoStart
  | NothingMilled
  | -- | for a swivelling blade: a point after the first contour, without a height
    NoHeight Region
  | -- | no point to which the tool retracts after the contour at this region
    NoRetract Region
  deriving stock (Eq, Ord, Show)

-- | The report for a part that cannot become a sheet.
toReport :: Unfit -> Report
toReport unfit = case unfit of
  NoNumbers region feature ->
    (at region "E0921" (featureText feature <> " has no numbers on a sheet"))
      { hints =
          [ "A sheet has one tool that mills open contours at the height to which it is \
            \brought. Leave this out, or keep the program as it is."
          ]
      }
  NoPiece region fault ->
    let (title, advice) = pieceTexts fault
     in (at region "E0922" (title <> " is no piece of a sheet")) {hints = [advice]}
  NoLink region feature ->
    (at region "E0923" (linkText feature <> " is no link of a sheet"))
      { hints =
          [ "A sheet has three links: the intersection (meet), the joint (smooth) and the arc \
            \(fillet)."
          ]
      }
  NoCipher region fault ->
    let (detail, advice) = cipherTexts fault
     in (at region "E0924" ("a sheet has no cipher for this piece: " <> detail)) {hints = [advice]}
  NoFeed region fault ->
    let (title, advice) = feedTexts fault in (at region "E0925" title) {hints = [advice]}
  TwoOfOne region setting ->
    ( at
        region
        "E0926"
        ( "a sheet has one "
            <> sharedText setting
            <> ", and this contour has another than the first one"
        )
    )
      { hints = ["Make a program of its own for it."]
      }
  NoPath fault ->
    let (place, title) = pathTexts fault
     in (report Error "E0927" place title)
          { hints =
              [ "A sheet begins with the place of the tool, mills an array at least, and ends \
                \with a point: from, mill … { retract … }."
              ]
          }
  ManyArrays region ->
    (at region "E0908" ("more than " <> Decimal.whole maxArrays <> " contours"))
      { message = ["The Minsk-22 system stopped here with 10746."],
        hints = ["Make two programs of it."]
      }

featureText :: Feature -> Text
featureText feature = case feature of
  PocketClearing -> "the clearing of a pocket"
  DrillingHoles -> "drilling"
  CarvingRegion -> "a V-carving"
  SpindleCommand -> "a command to the spindle"
  CoolantCommand -> "a command to the coolant"
  AuxiliaryCommand -> "an auxiliary command"
  StopCommand -> "a stop"
  DwellCommand -> "a dwell"
  SecondTool -> "a second tool"
  BandTolerance -> "a tolerance that differs inside and outside"
  OutsideOfContour -> "the outside of a contour"
  InsideOfContour -> "the inside of a contour"
  TurningContour -> "turning"
  Depth -> "a depth"
  Lead -> "a lead"
  ContourAllowance -> "an allowance of all of a contour"
  SharpCorner -> "a sharp corner"
  ControlCompensation -> "a compensation by the control"

-- | The subject of the title, and the hint, of the report on a piece. An empty text means no hint.
pieceTexts :: PieceFault -> (Text, Text)
pieceTexts fault = case fault of
  NoPoints -> ("a curve of no points", "")
  OtherCurve ->
    ( "this curve",
      "The curve of a piece is a spline through the points of a table, or a polyline through two \
      \points."
    )
  PlainElement ->
    ( "this element",
      "Elements of a sheet are curves: write a line as polyline([p, q]), a curve as \
      \spline(table), and those of another contour once more."
    )
  ClosedContour -> ("a closed contour", "A sheet joins its pieces to open contours.")
  DerivedContour -> ("a contour that is moved, turned, or made of others", writePieces)
  NestedContour -> ("a contour in a contour", writePieces)
  where
    writePieces = "Write its pieces down one by one."

linkText :: LinkFeature -> Text
linkText feature = case feature of
  ChosenIntersection -> "an intersection with a choice"
  TangentLink -> "a tangent"
  ChamferLink -> "a chamfer"

-- | The end of the title, and the hint, of the report on recalculations without a cipher.
cipherTexts :: UnsupportedCipher -> (Text, Text)
cipherTexts fault = case fault of
  AllowanceOfFour ->
    ("its 4 has an allowance", "Write the allowance behind the element: allowance 0.5")
  GrowthBetweenPoints ->
    ( "its 1 changes between two points",
      "On a sheet the distance changes along the whole piece: make pieces of the parts."
    )
  HasJoggle -> ("it has a joggle", "Keep the program as it is, or make pieces of the parts.")
  DifferentBevels ->
    ( "its bevels differ from one recalculation to another",
      "On a sheet a point has one bevel."
    )
  DifferentHeights ->
    ("its heights differ from one 4 to another", "On a sheet a point has one height.")
  DistanceNotSquare ->
    ( "a distance is not square to the surface",
      "On a sheet, distances of a piece with a bevel are square to the surface: 2(h, mu)."
    )
  NotSwivelling ->
    ( "the blade does not swivel by the bevel of its cipher",
      "Behind an element with a 4 write: bevel mu"
    )
  OtherSwivel ->
    ( "the blade swivels by another bevel than that of its cipher",
      "Behind an element with a 4 write: bevel mu; behind another one: bevel 0"
    )

-- | The title and the hint of the report on a feed.
feedTexts :: FeedFault -> (Text, Text)
feedTexts fault = case fault of
  LeavingFeed ->
    ( "the tool leaves a contour at another feed than that of the contour",
      "On a sheet a feed holds from a point on: go to the first point behind a contour at the \
      \contour's feed, and from there as you like."
    )
  FeedTooHigh -> ("a feed of 9999 mm/min or more", "On a sheet 9999 means rapid.")
  FeedForTurn -> ("a feed for one turn of the spindle", "The feeds of a sheet are in mm/min.")

sharedText :: SharedSetting -> Text
sharedText setting = case setting of
  SharedTool -> "tool"
  SharedTolerance -> "tolerance"
  SharedSide -> "milling side"

-- | The position and the title of the report on a toolpath.
pathTexts :: PathFault -> (ReportPlace, Text)
pathTexts fault = case fault of
  NoStart -> (InFile, "the program does not say where the tool stands")
  NothingMilled -> (InFile, "the program mills nothing")
  NoHeight region ->
    (InSource region, "a swivelling blade leaves its height, and this point does not say one")
  NoRetract region -> (InSource region, "behind this contour the tool goes to no point")
