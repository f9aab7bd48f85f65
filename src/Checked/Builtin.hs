-- | The functions and constants that the language brings along, with their types.
module Checked.Builtin
  ( Signature (..),
    lookup,
    names,
    name,
  )
where

import Checked.Dimension qualified as Dimension
import Checked.Syntax (Builtin (..))
import Checked.Type (Type (..))
import Checked.Type qualified as Type
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Prelude hiding (lookup)

-- | What a function takes, each argument with its name, and what it gives. The dimension is a
-- fresh unknown at every use.
data Signature = Signature {parameters :: [(Text, Type)], result :: Type}

-- | The builtin of a name, and its signature for a fresh unknown dimension.
lookup :: Text -> Maybe (Builtin, Dimension.Dimension -> Signature)
lookup word = (\b -> (b, signature b)) <$> Map.lookup word table

-- | All names that are taken.
names :: [Text]
names = Map.keys table

table :: Map Text Builtin
table = Map.fromList [(name b, b) | b <- [minBound .. maxBound]]

-- | How a program writes it.
name :: Builtin -> Text
name builtin = case builtin of
  Pi -> "pi"
  Polar -> "polar"
  MakeCircle -> "circle"
  MakeLine -> "line"
  Distance -> "distance"
  Sin -> "sin"
  Cos -> "cos"
  Tan -> "tan"
  Asin -> "asin"
  Acos -> "acos"
  Atan2 -> "atan2"
  Sqrt -> "sqrt"
  Abs -> "abs"
  Min -> "min"
  Max -> "max"
  Floor -> "floor"

signature :: Builtin -> Dimension.Dimension -> Signature
signature builtin d = case builtin of
  Pi -> Signature [] Type.number
  Polar -> Signature [("length", Type.len), ("angle", Type.angle)] (Spatial d)
  MakeCircle -> Signature [("centre", Type.aPoint), ("radius", Type.len)] Circle
  MakeLine -> Signature [("from", Type.aPoint), ("to", Type.aPoint)] Line
  Distance -> Signature [("from", Type.aPoint), ("to", Type.aPoint)] Type.len
  Sin -> Signature [("angle", Type.angle)] Type.number
  Cos -> Signature [("angle", Type.angle)] Type.number
  Tan -> Signature [("angle", Type.angle)] Type.number
  Asin -> Signature [("sine", Type.number)] Type.angle
  Acos -> Signature [("cosine", Type.number)] Type.angle
  Atan2 -> Signature [("y", Quantity d), ("x", Quantity d)] Type.angle
  Sqrt -> Signature [("value", Quantity (Dimension.power 2 d))] (Quantity d)
  Abs -> Signature [("value", Quantity d)] (Quantity d)
  Min -> Signature [("first", Quantity d), ("second", Quantity d)] (Quantity d)
  Max -> Signature [("first", Quantity d), ("second", Quantity d)] (Quantity d)
  Floor -> Signature [("value", Type.number)] Type.number
