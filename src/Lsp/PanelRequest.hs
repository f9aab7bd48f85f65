-- | The request of a panel beside the text: what is at a position, as data and as a drawing.
module Lsp.PanelRequest
  ( atPosition,
  )
where

import Data.Aeson (Value (..), object, (.=))
import Lsp.Subject (Method, Subject (..), offsetIn, rangeOf)
import Query.Description (Description (..))
import Query.Description qualified as Description
import Query.Drawing qualified as Drawing
import Query.Manual qualified as Manual

-- | The request @partc/at@: the title and the rows of a table, the range that they are about, and a
-- drawing in SVG of the contour or of the whole part, if there is one.
atPosition :: Method
atPosition _ subject params = answer <$> offsetIn subject params
  where
    answer at = case (Description.description (now subject) (sound subject) at, drawn at) of
      (Nothing, Nothing) -> Null
      (found, picture) ->
        object $
          [ "title" .= maybe "" title found,
            "rows" .= maybe [] rows found
          ]
            <> ["range" .= rangeOf subject (region d) | Just d <- [found]]
            <> ["svg" .= svg | Just svg <- [picture]]
    drawn = Drawing.drawing (now subject) (sound subject)
    rows d =
      [["value", v] | length (values d) == 1, v <- values d]
        <> [["meaning", sentence d] | sentence d /= ""]
        <> [[k, v] | (k, v) <- facts d]
        <> [["manual", Manual.sentence e] | Just e <- [entry d]]
