-- | The header of a DXF file: the encoding of names and the unit of lengths.
module Drawing.DxfHeader
  ( encoding,
    millimetres,
    largeUnit,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit, Mm (..), millimetresIn)
import Control.Monad (join)
import Data.List (find)
import Data.Text (Text)
import Data.Text.Encoding qualified as Encoding
import Drawing.CodePage (Encoding)
import Drawing.CodePage qualified as CodePage
import Drawing.DxfPair (Pair (..))
import Drawing.Error (DrawingFault (..), Error (Error))
import Drawing.Number qualified as Number
import Drawing.Tolerance qualified as Tolerance

-- | The encoding of the names in a file with this header.
encoding :: [Pair] -> Encoding
encoding header = CodePage.fromHeader (textOf "$ACADVER") (textOf "$DWGCODEPAGE")
  where
    textOf name = latin <$> variable name header

-- | The length of the file's unit in mm. The variable @$INSUNITS@ gives it, or the program states
-- it. An error if neither does, or if they differ.
millimetres :: Maybe LengthUnit -> [Pair] -> Either Error Double
millimetres stated header = case variable "$INSUNITS" header of
  Nothing -> withoutVariable 1
  Just pair@Pair {line} -> case unitOf (latin pair) of
    Nothing -> Left (Error (line + 1) (UnitUnknown (latin pair)))
    Just Nothing -> withoutVariable (line + 1)
    Just (Just (name, size)) -> case stated of
      Just unit
        | millimetresIn unit /= size ->
          Left (Error (line + 1) (UnitConflict name (Decimal.unitText unit)))
      _ -> Right size
  where
    withoutVariable line = maybe (Left (Error line UnitMissing)) (Right . millimetresIn) stated

-- | The unit of the file, if one unit is longer than 'Tolerance.largeUnit': the line that gives it,
-- and its name.
largeUnit :: [Pair] -> Maybe (Int, Text)
largeUnit header = do
  pair@Pair {line} <- variable "$INSUNITS" header
  (name, size) <- join (unitOf (latin pair))
  if Mm size > Tolerance.largeUnit then Just (line + 1, name) else Nothing

-- | The first pair of the value of a header variable.
variable :: Text -> [Pair] -> Maybe Pair
variable name header = case break isName header of
  (_, _ : value@Pair {code} : _) | code /= 9 -> Just value
  _ -> Nothing
  where
    isName pair@Pair {code} = code == 9 && latin pair == name

latin :: Pair -> Text
latin Pair {content} = Encoding.decodeLatin1 content

-- | The unit with the number of a text: its name and its length in mm, or nothing for 0, which
-- means that the drawing has no unit. Nothing at all for other texts.
unitOf :: Text -> Maybe (Maybe (Text, Double))
unitOf text = do
  number <- Number.number text
  if number == 0
    then Just Nothing
    else Just <$> (snd <$> find ((== number) . fst) (zip [1 ..] units))

-- | The units of the DXF reference for @$INSUNITS@, from 1 on. The US survey foot is 1200\/3937 m.
-- The astronomical units are those of the IAU: 149597870700 m, 9460730472580800 m and
-- 648000\/π astronomical units.
units :: [(Text, Double)]
units =
  [ ("in", 25.4),
    ("ft", 304.8),
    ("mi", 1609344),
    ("mm", 1),
    ("cm", 10),
    ("m", 1000),
    ("km", 1e6),
    ("microinches", 25.4e-6),
    ("mil", 0.0254),
    ("yd", 914.4),
    ("Å", 1e-7),
    ("nm", 1e-6),
    ("µm", 1e-3),
    ("dm", 100),
    ("dam", 1e4),
    ("hm", 1e5),
    ("Gm", 1e12),
    ("astronomical units", 149597870700e3),
    ("light years", 9460730472580800e3),
    ("parsecs", 149597870700e3 * 648000 / pi),
    ("US survey feet", 1200e3 / 3937),
    ("US survey inches", 100e3 / 3937),
    ("US survey yards", 3600e3 / 3937),
    ("US survey miles", 5280 * 1200e3 / 3937)
  ]
