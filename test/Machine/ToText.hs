-- | Writes a machine as a description with all its values, for the law that reading it again gives
-- the same machine.
module Machine.ToText
  ( toText,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Feed (..), Mm (..), degrees)
import Data.Bits (testBit)
import Data.Char (ord)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.ControllerToText (controllerLines)
import Machine.Machine
import Numeric (showHex)

-- | Writes a description. Every value is marked as reconstructed.
toText :: Machine -> Text
toText m =
  Text.unlines
    ( ["machine " <> quoted n <> " " <> quoted (title m) <> " reconstructed"]
        <> block "tape" (tapeLines (medium m))
        <> block ("code " <> quoted (codeName (code m))) (codeLines (tracks (medium m)) (code m))
        <> concatMap axisLines (NonEmpty.toList (axes m))
        <> concatMap rotaryLines (rotaryAxes m)
        <> ["arcs " <> arcsText (arcs m)]
        <> block "frame" (frameLines (layout m))
        <> block "feeds" (feedLines (feeds m))
        <> block "braking" (brakingLines (braking m))
        <> block "commands" (commandLines (commandWords m))
        <> concat [block "controller" (controllerLines c) | Just c <- [controller m]]
        <> block "limits" ["contours " <> Decimal.whole k | Just k <- [mostContours (limits m)]]
    )
  where
    MachineName n = name m

block :: Text -> [Text] -> [Text]
block heading ls = [heading <> " {"] <> map ("  " <>) ls <> ["}"]

quoted :: Text -> Text
quoted t = "\"" <> Text.concatMap escaped t <> "\""
  where
    escaped c
      | c == '"' || c == '\\' = Text.pack ['\\', c]
      | c < ' ' = "\\u" <> Text.justifyRight 4 '0' (Text.pack (showHex (ord c) ""))
      | otherwise = Text.singleton c

tapeLines :: Medium -> [Text]
tapeLines t =
  [ "tracks " <> Decimal.whole (tracks t),
    "pitch " <> maybe "none" millimetres (pitch t)
  ]
    <> ["width " <> millimetres w | Just w <- [width t]]
    <> ["punch " <> Decimal.exact r <> " rows/min" | Just r <- [punchRate t]]
    <> [ "suffix " <> quoted (suffix t),
         "leader " <> Decimal.whole (leader t),
         "gap " <> Decimal.whole (gap t),
         "even-shift " <> Decimal.whole (evenShift t),
         "spare " <> case spare t of
           Counted -> "counted"
           Skipped -> "skipped",
         "opening " <> quoted (opening t),
         "closing " <> quoted (closing t)
       ]

millimetres :: Mm -> Text
millimetres (Mm x) = Decimal.exact x <> " mm"

codeLines :: Int -> TapeCode -> [Text]
codeLines n c =
  block "symbols" [quoted (Text.singleton s) <> " = " <> row p | (s, p) <- Map.toList (symbols c)]
    <> block
      "weights"
      [quoted (Text.singleton s) <> " = " <> Decimal.whole w | (s, w) <- Map.toList (weights c)]
    <> ["parity-track " <> Decimal.whole t | Just t <- [evenTrack c]]
    <> ["service-track " <> Decimal.whole t | Just t <- [serviceTrack c]]
    <> ["skip " <> Text.unwords (map row (skips c)) | not (null (skips c))]
  where
    row p = Text.pack [if testBit p (t - 1) then '1' else '0' | t <- reverse [1 .. n]]

axisLines :: AxisForm -> [Text]
axisLines a =
  block
    ("axis " <> contentName (Along (axis a)))
    ( ["pulse " <> millimetres (resolution a)]
        <> ["direction reversed" | reversed a]
        <> ["lathe reversed" | reversedOnLathe a]
        <> ["moves unsure" | not (isDriven a)]
    )

rotaryLines :: RotaryForm -> [Text]
rotaryLines a =
  block
    ("axis " <> contentName (About (rotaryAxis a)))
    ( ["pulse " <> Decimal.fixed 9 (degrees (pulseAngle a)) <> " deg"]
        <> ["direction reversed" | turnsReversed a]
    )

arcsText :: Arcs -> Text
arcsText a = case a of
  NoArcs -> "none"
  Arcs {quadrants, fullCircle, rising} ->
    (if quadrants then "quadrant" else "any") <> (if fullCircle then " full-circle" else "")
      <> (if rising then " rising" else "")

frameLines :: Layout -> [Text]
frameLines l =
  [ "numbers " <> case measure l of
      Increments -> "increments"
      Positions -> "positions"
  ]
    <> ["separator " <> quoted (separator l)]
    <> concatMap itemLines (NonEmpty.toList (items l))
  where
    itemLines item = case item of
      Literal t -> ["symbols " <> quoted t]
      CheckDigit k -> ["check modulo " <> Decimal.whole k]
      AWord w ->
        block
          ( "word "
              <> (if address w == "" then "" else quoted (address w) <> " ")
              <> contentText (content w)
          )
          (wordLines w)

contentText :: Content -> Text
contentText c = case c of
  FrameNumber -> "frame-number"
  Motion _ -> "motion"
  Along _ -> "along " <> contentName c
  About _ -> "along " <> contentName c
  Centre _ -> contentName c
  FeedWord -> "feed"
  Command (CommandName n) -> "command " <> quoted n

wordLines :: Word' -> [Text]
wordLines w =
  [ "digits " <> (if padded f then "" else "at-most ") <> Decimal.whole (digits f),
    "decimals " <> Decimal.whole (decimals f)
  ]
    <> ["sign " <> s | Just s <- [signText (sign f)]]
    <> ["holes " <> Text.unwords (map serviceText (service f)) | not (null (service f))]
    <> [ "when " <> case presence w of
           Always -> "always"
           InMotion -> "moving"
           WhenNeeded -> "needed"
           WhenChanged -> "changed"
       ]
    <> case content w of
      Motion c ->
        ["rapid " <> Decimal.whole k | Just k <- [rapid c]]
          <> ["straight " <> Decimal.whole (straight c)]
          <> ["clockwise " <> Decimal.whole k | Just k <- [clockwise c]]
          <> ["counterclockwise " <> Decimal.whole k | Just k <- [counterClockwise c]]
      _ -> []
  where
    f = form w
    signText s = case s of
      Unsigned -> Just "none"
      ServiceSign -> Nothing
      MinusSign -> Just "minus"
      EitherSign -> Just "both"
      Priority a b c d -> Just ("priority " <> Text.unwords (map Decimal.whole [a, b, c, d]))
    serviceText s = case s of
      MinusHole -> "minus"
      CommandBit (CommandName n) k -> quoted n <> ":" <> Decimal.whole k
      Marker -> "marker"
      BrakingHole -> "braking"
      NoHole -> "-"

feedLines :: Feeds -> [Text]
feedLines f =
  [ "measure " <> case feedMeasure f of
      AlongPath -> "mm/min"
      LeadingAxis -> "Hz"
  ]
    <> case codes f of
      Direct a b -> ["direct " <> Decimal.whole a <> ".." <> Decimal.whole b]
      Listed t ->
        block
          "table"
          [Decimal.whole (codeNumber c) <> " = " <> Decimal.exact v | (c, v) <- Map.toList t]
    <> [ "rule " <> case rule f of
           NotAbove -> "not-above"
           Nearest -> "nearest",
         "rapid " <> case rapidFeed f of
           Highest -> "highest"
           ByCode c -> "code " <> Decimal.whole (codeNumber c)
       ]
    <> [ "per-turn "
           <> Decimal.exact (turnStep t)
           <> " mm/rev "
           <> Decimal.whole (lowestTurn t)
           <> ".."
           <> Decimal.whole (highestTurn t)
         | Just t <- [turnFeeds f]
       ]

brakingLines :: Braking -> [Text]
brakingLines b =
  [ "deceleration " <> Decimal.exact (deceleration b) <> " mm/s2",
    "by " <> case brakingForm b of
      ByControl -> "control"
      SlowFrames -> "slow-frames"
      BrakedFrames (Feed v) -> "braked-frames " <> Decimal.exact v <> " mm/min"
  ]

commandLines :: CommandWords -> [Text]
commandLines o =
  concat [block event (concatMap commandWordLines os) | (event, os) <- events, not (null os)]
    <> concat
      [ block
          "compensation"
          ( block "left" (commandWordLines (compensateLeft c))
              <> block "right" (commandWordLines (compensateRight c))
              <> block "off" (commandWordLines (cancelCompensation c))
              <> concat [block "switch" (commandWordLines w) | Just w <- [radiusSwitch c]]
          )
        | Just c <- [compensation o]
      ]
    <> block
      "finish"
      (concat [block "frame" (concatMap commandWordLines (NonEmpty.toList os)) | os <- finish o])
  where
    events =
      [ ("spindle-clockwise", spindleClockwise o),
        ("spindle-counterclockwise", spindleCounterClockwise o),
        ("spindle-off", spindleOff o),
        ("coolant-on", coolantOn o),
        ("coolant-off", coolantOff o),
        ("tool-change", toolChange o),
        ("auxiliary", auxiliary o),
        ("stop", programStop o),
        ("optional-stop", optionalStop o),
        ("dwell", dwell o),
        ("surface-clockwise", surfaceClockwise o),
        ("surface-counterclockwise", surfaceCounterClockwise o)
      ]
    commandWordLines (CommandWord (CommandName n) v) = case v of
      Fixed k -> ["set " <> quoted n <> " " <> Decimal.whole k]
      Argument -> ["set " <> quoted n <> " argument"]
      Diameter -> ["set " <> quoted n <> " diameter"]
      InSeconds -> ["set " <> quoted n <> " seconds"]
      InMilliseconds -> ["set " <> quoted n <> " milliseconds"]
      SurfaceSpeed _ -> ["set " <> quoted n <> " cutting-speed"]
      SpeedLimit -> ["set " <> quoted n <> " limit"]
      Step t ->
        block
          ("set " <> quoted n <> " steps")
          [Decimal.whole k <> " = " <> Decimal.exact x | (k, x) <- Map.toList t]
