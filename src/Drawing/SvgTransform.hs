-- | The attribute @transform@ of SVG elements: a list of maps, of which the last one applies first.
module Drawing.SvgTransform
  ( fromText,
  )
where

import Base.Quantity (Rad (..), radians)
import Data.Text (Text)
import Data.Text qualified as Text
import Drawing.AffineMap (AffineMap (..), after)
import Drawing.AffineMap qualified as AffineMap
import Drawing.SvgNumber (numbers, skipBlanks, skipComma)
import Geometry.Vec qualified as Vec

-- | The product of the maps of a text. The rest of the text at the first mistake in 'Left'.
fromText :: Text -> Either Text AffineMap
fromText text = case skipBlanks text of
  "none" -> Right AffineMap.identity
  list -> go AffineMap.identity list
  where
    go product' rest
      | Text.null rest = Right product'
      | otherwise = do
        (m, more) <- single rest
        go (product' `after` m) (skipComma more)

-- | The map at the beginning of a text, and the text after it.
single :: Text -> Either Text (AffineMap, Text)
single text = case Text.uncons afterName of
  Just ('(', more) -> case Text.breakOn ")" more of
    (inside, rest)
      | Text.null rest -> Left text
      | otherwise -> do
        values <- numbers inside
        m <- maybe (Left text) Right (named (Text.strip name) values)
        Right (m, Text.drop 1 rest)
  _ -> Left text
  where
    (name, afterName) = Text.break (== '(') text

-- | The map with a name and its numbers.
named :: Text -> [Double] -> Maybe AffineMap
named name values = case (name, values) of
  ("matrix", [a, b, c, d, e, f]) ->
    Just AffineMap {xx = a, yx = b, xy = c, yy = d, dx = e, dy = f}
  ("translate", [x]) -> Just (translation x 0)
  ("translate", [x, y]) -> Just (translation x y)
  ("scale", [k]) -> Just (AffineMap.scaling k k)
  ("scale", [kx, ky]) -> Just (AffineMap.scaling kx ky)
  ("rotate", [a]) -> Just (rotation a)
  ("rotate", [a, x, y]) ->
    Just (translation x y `after` rotation a `after` translation (negate x) (negate y))
  ("skewX", [a]) -> Just AffineMap.identity {xy = tangent a}
  ("skewY", [a]) -> Just AffineMap.identity {yx = tangent a}
  _ -> Nothing
  where
    translation x y = AffineMap.translation (Vec.vec x y)
    rotation = AffineMap.rotation . radians
    tangent degrees = let Rad a = radians degrees in tan a
