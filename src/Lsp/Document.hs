-- | A text that is open in the editor, and its edits.
--
-- The text is kept as a sequence of lines, so an edit costs the lines that it touches and not the
-- whole text.
module Lsp.Document
  ( Document (..),
    Edit (..),
    open,
    edit,
    program,
    isDescription,
  )
where

import Base.Lines qualified as Lines
import Data.Aeson (FromJSON (..), withObject, (.:), (.:?))
import Data.Foldable (toList)
import Data.Sequence (Seq, (><))
import Data.Sequence qualified as Seq
import Data.Text (Text)
import Data.Text qualified as Text
import Lsp.Position (LspPosition (..), LspRange (..))
import Lsp.Position qualified as Position
import Lsp.Uri (Uri)
import Lsp.Uri qualified as Uri
import Project.MachineDescription qualified as MachineDescription

-- | A text with the address of its file and the version number that the client gives to this state
-- of the text. The version is Nothing if the client gives none. Each line has its line end: LF, CR
-- or CR LF. Only the last line has none. There is at least one line.
data Document = Document {uri :: Uri, version :: Maybe Int, contents :: Seq Text}
  deriving stock (Eq, Show)

-- | An edit of a document: a new text for a range, or for the whole document.
data Edit = Replace LspRange Text | Whole Text
  deriving stock (Eq, Show)

instance FromJSON Edit where
  parseJSON = withObject "a change" $ \o -> do
    range <- o .:? "range"
    new <- o .: "text"
    pure (maybe Whole Replace range new)

-- | The document that a client opens, with its version number if there is one.
open :: Uri -> Maybe Int -> Text -> Document
open uri version whole = Document {uri, version, contents = Seq.fromList (Lines.divided whole)}

-- | Applies edits in the order of the list and sets the version. The range of an edit refers to the
-- text as the previous edits have left it.
edit :: Maybe Int -> [Edit] -> Document -> Document
edit version edits document =
  document {version, contents = foldl applied (contents document) edits}

-- | Applies an edit to the lines of a text.
applied :: Seq Text -> Edit -> Seq Text
applied old e = case e of
  Whole new -> Seq.fromList (Lines.divided new)
  Replace LspRange {from, to} new ->
    let ((i, a), (j, b)) = ordered (place old from) (place old to)
        joined = Text.take a (Seq.index old i) <> new <> Text.drop b (Seq.index old j)
        -- A line that ends with CR becomes one with CR LF if the edit puts LF after it.
        joinsBefore = "\n" `Text.isPrefixOf` joined && i > 0
        first = if joinsBefore then i - 1 else i
        middle = if joinsBefore then Seq.index old first <> joined else joined
        pieces = Lines.divided middle
        isLast = j == Seq.length old - 1
     in Seq.take first old
          >< Seq.fromList (if isLast then pieces else init pieces)
          >< Seq.drop (j + 1) old
  where
    ordered p q = (min p q, max p q)

-- | The index of the line and the count of characters before a position. A position beyond the end
-- of its line gives this end; one beyond the last line gives the end of the text. A position inside
-- a surrogate pair gives the beginning of the character.
place :: Seq Text -> LspPosition -> (Int, Int)
place whole LspPosition {line, character} = case Seq.lookup line whole of
  Just content | line >= 0 -> (line, Position.charactersIn character (Lines.withoutEnd content))
  _
    | line < 0 -> (0, 0)
    | otherwise -> (final, Text.length (Seq.index whole final))
  where
    final = Seq.length whole - 1

-- | The whole text.
text :: Document -> Text
text = Text.concat . toList . contents

-- | The text for the compiler. A byte order mark at the beginning becomes a space. It cannot be
-- dropped, because the client's positions count it as a character.
program :: Document -> Text
program document = Text.map unmarked (Text.take 1 whole) <> Text.drop 1 whole
  where
    whole = text document
    unmarked c = if c == '\xFEFF' then ' ' else c

-- | True if the document is a machine description.
isDescription :: Document -> Bool
isDescription = MachineDescription.isDescription . Uri.toPath . uri
