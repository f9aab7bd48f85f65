-- | What a part program can say and a sheet of numbers cannot.
module Sheet.Unsupported
  ( Unfit (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Region (..))
import Data.Text (Text)
import Report.Report (Report (..), ReportCode, ReportPlace (..), Severity (..), report)
import Sheet.Sheet (mostArrays)

data Unfit
  = -- | an operation, or a setting of one: where, and what it is
    NoNumbers Region Text
  | -- | an element or a contour that is no row of pieces: where, what it is, what to do
    NoPiece Region Text Text
  | -- | a link: where, and what it is
    NoLink Region Text
  | -- | a recalculation: where its piece is walked, what there is about it, what to do
    NoCipher Region Text Text
  | -- | a feed: where, what there is about it, what to do
    NoFeed Region Text Text
  | -- | what a sheet says once and this contour says otherwise than the first one
    TwoOfOne Region Text
  | -- | the way does not begin or end as that of a sheet: where if there is a place, what is
    -- missing
    NoWay (Maybe Region) Text
  | -- | one contour more than there may be arrays
    ManyArrays Region
  deriving stock (Eq, Ord, Show)

-- | The words for it.
toReport :: Unfit -> Report
toReport unfit = case unfit of
  NoNumbers region what ->
    (at region "E0921" (what <> " has no numbers on a sheet"))
      { hints =
          [ "A sheet has one tool that mills open contours at the height to which it is \
            \brought. Leave this out, or keep the program as it is."
          ]
      }
  NoPiece region what advice ->
    (at region "E0922" (what <> " is no piece of a sheet"))
      { hints = [advice]
      }
  NoLink region what ->
    (at region "E0923" (what <> " is no link of a sheet"))
      { hints =
          [ "A sheet has three links: the intersection (meet), the joint (smooth) and the arc \
            \(fillet)."
          ]
      }
  NoCipher region what advice ->
    (at region "E0924" ("a sheet has no cipher for this piece: " <> what))
      { hints = [advice]
      }
  NoFeed region what advice ->
    (at region "E0925" what)
      { hints = [advice]
      }
  TwoOfOne region what ->
    ( at
        region
        "E0926"
        ("a sheet has one " <> what <> ", and this contour has another than the first one")
    )
      { hints = ["Make a program of its own for it."]
      }
  NoWay place what ->
    (report Error "E0927" (maybe InFile InSource place) what)
      { hints =
          [ "A sheet begins with the place of the tool, mills an array at least, and ends \
            \with a point: from, mill … { retract … }."
          ]
      }
  ManyArrays region ->
    (at region "E0908" ("more than " <> Decimal.whole mostArrays <> " contours"))
      { message = ["The Minsk-22 system stopped here with 10746."],
        hints = ["Make two programs of it."]
      }

at :: Region -> ReportCode -> Text -> Report
at region code = report Error code (InSource region)
