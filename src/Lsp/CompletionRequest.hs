-- | The requests while a text is being written: completion and the form of a call.
module Lsp.CompletionRequest
  ( completion,
    signatureHelp,
  )
where

import Base.Decimal qualified as Decimal
import Data.Aeson (Value (..), object, (.=))
import Data.Text (Text)
import Data.Text qualified as Text
import Lsp.Capability (Client (..))
import Lsp.ManualLink qualified as ManualLink
import Lsp.Subject (Method, atCursor, fenced, textEdit)
import Query.Completion (Completion (..), CompletionItem (..), CompletionKind (..))
import Query.Completion qualified as Completion
import Query.Signature qualified as Signature
import Query.Snippet qualified as Snippet

-- | The request @textDocument/completion@.
completion :: Method
completion client subject = atCursor Completion.completion shown subject
  where
    shown found =
      object
        [ "isIncomplete" .= False,
          "items"
            .= zipWith (itemOf (Completion.replaced found)) [0 ..] (items found)
        ]
    itemOf region index item =
      object $
        [ "label" .= label item,
          "kind" .= number (kind item),
          "sortText" .= sortText (rank item) index,
          "insertTextFormat" .= (if isMarked client item then 2 else 1 :: Int),
          "textEdit" .= textEdit subject region (insertion client item)
        ]
          <> ["detail" .= detail item | detail item /= ""]
          <> ["documentation" .= d | Just d <- [documentation client item]]

-- | The text that an item inserts. A client without snippets gets the words of a statement alone,
-- or the text without its marks.
insertion :: Client -> CompletionItem -> Text
insertion client item
  | isMarked client item = snippet item
  | "$" `Text.isInfixOf` snippet item = case kind item of
    FunctionItem -> label item
    StatementItem -> label item <> " "
    SettingItem -> label item <> " "
    _ -> Snippet.plain (snippet item)
  | otherwise = snippet item

-- | True if the text of an item is sent with the marks of snippets.
isMarked :: Client -> CompletionItem -> Bool
isMarked client item = snippets client && "$" `Text.isInfixOf` snippet item

documentation :: Client -> CompletionItem -> Maybe Value
documentation client item
  | null texts = Nothing
  | completionMarkdown client = Just (inMarkdown (Text.intercalate "\n\n" texts))
  | otherwise = Just (String (Text.intercalate "\n" plain))
  where
    marked = client {markdown = completionMarkdown client}
    about' = [ManualLink.sentence marked entry | Just entry <- [about item]]
    listed = take mostForms (forms' item)
    texts = [fenced (Text.intercalate "\n" listed) | not (null listed)] <> about'
    plain = listed <> about'

-- | A text in Markdown.
inMarkdown :: Text -> Value
inMarkdown text = object ["kind" .= ("markdown" :: Text), "value" .= text]

-- | The largest number of forms of a function that its documentation shows.
mostForms :: Int
mostForms = 12

-- | The text by which an editor sorts an item: its rank, then its position in the list.
sortText :: Int -> Int -> Text
sortText rank index = Decimal.whole rank <> Text.justifyRight 4 '0' (Decimal.whole index)

-- | The protocol's number of a kind of item.
number :: CompletionKind -> Int
number kind = case kind of
  StatementItem -> 14 -- keyword
  SettingItem -> 10 -- property
  WordItem -> 14 -- keyword
  ValueItem -> 6 -- variable
  ContourItem -> 7 -- class
  FunctionItem -> 3 -- function
  ConstantItem -> 21 -- constant
  ColumnItem -> 5 -- field
  UnitItem -> 11 -- unit
  MachineItem -> 9 -- module
  PointItem -> 12 -- value

-- | The request @textDocument/signatureHelp@.
signatureHelp :: Method
signatureHelp client = atCursor Signature.signature shown
  where
    shown s =
      object
        [ "signatures" .= map (form s) (Signature.forms s),
          "activeSignature" .= Signature.active s,
          "activeParameter" .= Signature.argument s
        ]
    form s (text, parameters) =
      object $
        [ "label" .= text,
          "parameters" .= [object ["label" .= p] | p <- parameters]
        ]
          <> ["documentation" .= documented d | Just d <- [about' s]]
    documented d
      | signatureMarkdown client = inMarkdown d
      | otherwise = String d
    marked = client {markdown = signatureMarkdown client}
    about' s = ManualLink.sentence marked <$> Signature.about s
