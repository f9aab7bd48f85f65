-- | Parts that an input sheet has no numbers for.
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
import Report.Report (Report (..), ReportCode, ReportPlace (..), Severity (..), report)
import Sheet.Sheet (maxArrays)

-- | A fact about a part that no sheet can hold; the region comes first.
data Unfit
  = -- | an operation, or a setting of one
    NoNumbers Region Feature
  | -- | an element or a contour that is no array of pieces
    NoPiece Region PieceFault
  | NoLink Region LinkFeature
  | -- | the recalculations of the piece that this element is
    NoCipher Region UnsupportedCipher
  | NoFeed Region FeedFault
  | -- | a setting that a sheet has once, and that differs from the one of the first contour
    TwoOfOne Region SharedSetting
  | -- | a toolpath that does not begin or end as the one of a sheet does
    NoPath PathFault
  | -- | the first contour beyond 'maxArrays'
    ManyArrays Region
  deriving stock (Eq, Ord, Show)

-- | A feature of the language without numbers on a sheet.
data Feature
  = PocketClearing
  | DrillingHoles
  | SpindleCommand
  | CoolantCommand
  | AuxiliaryCommand
  | SecondTool
  | BandTolerance
  | OutsideOfContour
  | InsideOfContour
  | TurningContour
  | Depth
  | Lead
  | ContourAllowance
  | SharpCorner
  | ControlCompensation
  deriving stock (Eq, Ord, Show)

-- | The reason why an element or a contour is no array of pieces.
data PieceFault
  = NoPoints
  | -- | neither a natural spline nor a straight line
    OtherCurve
  | -- | not a curve
    PlainElement
  | ClosedContour
  | -- | a contour that is transformed or reversed
    DerivedContour
  | -- | a contour as an element
    NestedContour
  deriving stock (Eq, Ord, Show)

-- | A link without a sign on a sheet.
data LinkFeature = ChosenIntersection | TangentLink | ChamferLink
  deriving stock (Eq, Ord, Show)

-- | The reason why recalculations have no cipher.
data UnsupportedCipher
  = AllowanceOfFour
  | GrowthBetweenPoints
  | HasJoggle
  | DifferentBevels
  | DifferentHeights
  | DistanceNotSquare
  | -- | a blade that does not swivel on a piece with a bevel
    NotSwivelling
  | -- | a blade that swivels by another bevel than the piece's
    OtherSwivel
  deriving stock (Eq, Ord, Show)

-- | The reason why a feed cannot be written.
data FeedFault
  = -- | a feed after a contour that differs from the contour's own
    LeavingFeed
  | -- | 'Sheet.Sheet.rapidFeed' or more
    FeedTooHigh
  | FeedOfElement
  deriving stock (Eq, Ord, Show)

-- | A setting that holds for a whole sheet.
data SharedSetting = SharedTool | SharedTolerance | SharedSide
  deriving stock (Eq, Ord, Show)

-- | The reason why the moves of a program are not those of a sheet.
data PathFault
  = NoStart
  | NothingMilled
  | -- | a point after the first contour without a height, for a swivelling blade
    NoHeight Region
  | -- | no point after this contour
    NoRetract Region
  deriving stock (Eq, Ord, Show)

-- | The report of a fact.
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

at :: Region -> ReportCode -> Text -> Report
at region code = report Error code (InSource region)

featureText :: Feature -> Text
featureText feature = case feature of
  PocketClearing -> "the clearing of a pocket"
  DrillingHoles -> "drilling"
  SpindleCommand -> "a command to the spindle"
  CoolantCommand -> "a command to the coolant"
  AuxiliaryCommand -> "an auxiliary command"
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

-- | The subject of the title, and the hint.
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
    writePieces = "Write its pieces down where they are walked."

linkText :: LinkFeature -> Text
linkText feature = case feature of
  ChosenIntersection -> "an intersection with a choice"
  TangentLink -> "a tangent"
  ChamferLink -> "a chamfer"

-- | The end of the title, and the hint.
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

-- | The title and the hint.
feedTexts :: FeedFault -> (Text, Text)
feedTexts fault = case fault of
  LeavingFeed ->
    ( "the tool leaves a contour at another feed than that of the contour",
      "On a sheet a feed holds from a point on: go to the first point behind a contour at the \
      \contour's feed, and from there as you like."
    )
  FeedTooHigh -> ("a feed of 9999 mm/min or more", "On a sheet 9999 means rapid.")
  FeedOfElement ->
    ("an element with a feed of its own", "On a sheet all pieces of an array have one feed.")

sharedText :: SharedSetting -> Text
sharedText setting = case setting of
  SharedTool -> "tool"
  SharedTolerance -> "tolerance"
  SharedSide -> "side of the walk"

-- | The place and the title.
pathTexts :: PathFault -> (ReportPlace, Text)
pathTexts fault = case fault of
  NoStart -> (InFile, "the program does not say where the tool stands")
  NothingMilled -> (InFile, "the program mills nothing")
  NoHeight region ->
    (InSource region, "a swivelling blade leaves its height, and this point does not say one")
  NoRetract region -> (InSource region, "behind this contour the tool goes to no point")
