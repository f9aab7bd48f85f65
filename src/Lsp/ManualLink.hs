-- | Sentences about the words of the language with a link to the manual.
module Lsp.ManualLink
  ( sentence,
  )
where

import Data.Text (Text)
import Lsp.Capability (Client (..))
import Query.Manual (ManualEntry (section))
import Query.Manual qualified as Manual

-- | The sentence of an entry, and a link to its section of the manual on a further line.
sentence :: Client -> ManualEntry -> Text
sentence client entry = Manual.sentence entry <> "\n\n" <> link client entry

-- | The link to the section of an entry. Without the address of the manual, which the client gives,
-- it is the name of the page and its section.
link :: Client -> ManualEntry -> Text
link Client {markdown, manual} entry = case manual of
  Just address
    | markdown -> "[" <> title <> "](" <> address <> section entry <> ")"
    | otherwise -> title <> ": " <> address <> section entry
  Nothing -> title <> ": docs/" <> section entry
  where
    title = "Manual, " <> Manual.sectionTitle entry
