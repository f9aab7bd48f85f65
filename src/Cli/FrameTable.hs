-- | Frames as a table or as JSON lines.
module Cli.FrameTable
  ( frames,
    framesJson,
    decoded,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Feed (..), Mm (..), Pulses (..))
import Base.Region (Position (..), Region (..), Source)
import Base.Region qualified as Region
import Cli.Table (Align (..))
import Cli.Table qualified as Table
import Data.Aeson (object, (.=))
import Data.Aeson.Encoding (encodingToLazyByteString)
import Data.Aeson.Encoding qualified as Aeson
import Data.ByteString.Lazy qualified as LazyByteString
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Encoding qualified as Encoding
import Frame.Frame (Frame (..), Planned (..), Program, Role (..))
import Frame.Frame qualified as Frame
import Geometry.Vec qualified as Vec
import Linear.V3 (V3 (..))
import Machine.Machine (FeedCode (..), Machine)
import Machine.Machine qualified as Machine

-- | One frame a line, with the line of the program that it came from.
frames :: Machine -> Source -> Program -> Text
frames machine source program =
  Table.columns
    ([ToRight, ToLeft, ToRight, ToRight, ToRight, ToRight, ToRight, ToRight, ToRight, ToRight] <> [ToRight | rises] <> [ToRight | commands])
    ((["frame", "for", "dx", "dy", "dz", "speed", "mm/min", "to x", "to y"] <> ["to z" | rises] <> ["line"] <> ["aux" | commands]) : map row (numbered program))
  where
    -- Columns that say something.
    rises = any (\p -> let Frame (V3 _ _ z) _ _ = frame p in z /= 0) (Frame.planned program)
    commands = any ((/= 0) . auxiliary . frame) (Frame.planned program)
    row (n, planned, at) =
      let Frame (V3 dx dy dz) (FeedCode s) aux = frame planned
          p = Frame.position machine at
       in [Decimal.whole n, roleWord (role planned), pulses dx, pulses dy, pulses dz, Decimal.whole s, feedWord machine (FeedCode s), coordinate (Vec.x p), coordinate (Vec.y p)]
            <> [let Mm z = Frame.height machine at in coordinate z | rises]
            <> [lineWord source planned]
            <> [if aux == 0 then "" else Decimal.whole aux | commands]
    pulses (Pulses n) = Decimal.whole n
    coordinate = Decimal.fixed 3

-- | Frames as JSON lines: increments in pulses, positions in mm.
framesJson :: Machine -> Source -> Program -> Text
framesJson machine source program = Text.concat (map row (numbered program))
  where
    row (n, planned, at) =
      let Frame (V3 (Pulses dx) (Pulses dy) (Pulses dz)) (FeedCode s) aux = frame planned
          p = Frame.position machine at
       in jsonLine
            [ "frame" .= n,
              "role" .= roleWord (role planned),
              "increment" .= [dx, dy, dz],
              "speed" .= s,
              "feed" .= ((\(Feed f) -> f) <$> Machine.feedOf machine (FeedCode s)),
              "auxiliary" .= aux,
              "to" .= [Vec.x p, Vec.y p, let Mm z = Frame.height machine at in z],
              "file" .= (let Position {file} = Region.position source (start (origin planned)) in file),
              "line" .= lineOf source planned
            ]
    jsonLine pairs = Encoding.decodeUtf8 (LazyByteString.toStrict (encodingToLazyByteString (Aeson.value (object pairs)))) <> "\n"

-- | The frames with their numbers and the positions where they end.
numbered :: Program -> [(Int, Planned, V3 Pulses)]
numbered program = zip3 [1 ..] (Frame.planned program) (drop 1 (scanl (+) (Frame.start program) (map (increment . frame) (Frame.planned program))))

-- | The line, with the file when it is not the program's own.
lineWord :: Source -> Planned -> Text
lineWord source planned = (if file == Region.mainFile source then "" else file <> ":") <> Decimal.whole (lineOf source planned)
  where
    Position {file} = Region.position source (start (origin planned))

lineOf :: Source -> Planned -> Int
lineOf source planned = line (Region.position source (start (origin planned)))

roleWord :: Role -> Text
roleWord r = case r of
  Approaching _ -> "approach"
  Cutting _ -> "cut"
  Retracting _ -> "retract"
  Travelling -> "travel"
  Drilling -> "drill"
  Commanding -> "command"

feedWord :: Machine -> FeedCode -> Text
feedWord machine code = maybe "" (\(Feed f) -> Decimal.short 2 f) (Machine.feedOf machine code)

-- | The frames that were read from a tape.
decoded :: Machine -> [Frame] -> Text
decoded machine fs =
  Table.columns
    [ToRight, ToRight, ToRight, ToRight, ToRight, ToRight, ToRight]
    (["frame", "dx", "dy", "dz", "speed", "mm/min", "auxiliary"] : zipWith row [1 ..] fs)
  where
    row n (Frame (V3 (Pulses dx) (Pulses dy) (Pulses dz)) (FeedCode s) aux) =
      [Decimal.whole n, Decimal.whole dx, Decimal.whole dy, Decimal.whole dz, Decimal.whole s, feedWord machine (FeedCode s), if aux == 0 then "" else Decimal.whole aux]
