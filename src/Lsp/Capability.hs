-- | The capabilities of the client (the editor) in the Language Server Protocol, and those that the
-- server announces.
module Lsp.Capability
  ( Client (..),
    fromInitialize,
    initializeResult,
  )
where

import Data.Aeson (Value (..), object, (.=))
import Data.Aeson.Key (Key)
import Data.Aeson.KeyMap qualified as KeyMap
import Data.Aeson.Types (Pair)
import Data.Foldable (toList)
import Data.Maybe (isJust)
import Data.Text (Text)
import Data.Text qualified as Text
import Query.SemanticToken (TokenKind (..))

-- | The capabilities of the client that change the form of answers and diagnostics.
data Client = Client
  { -- | true if a symbol may have two ranges: that of the statement and that of the name
    hierarchical :: Bool,
    -- | true if a hover may be Markdown
    markdown :: Bool,
    -- | true if the documentation of a completion may be Markdown
    completionMarkdown :: Bool,
    -- | true if the documentation of a signature may be Markdown
    signatureMarkdown :: Bool,
    -- | true if a diagnostic may have related information, with ranges of its own
    related :: Bool,
    -- | true if the answer to a request for code actions may contain actions, not only commands
    actions :: Bool,
    -- | true if the client shows the progress of the server's work
    progress :: Bool,
    -- | true if the client asks for code lenses again when the server wants it
    refreshesLenses :: Bool,
    -- | true if the client can be asked to watch files
    watchesFiles :: Bool,
    -- | true if the text of a completion may contain the marks of snippets
    snippets :: Bool,
    -- | true if the client can be asked to show an address or a position
    showsDocuments :: Bool,
    -- | true if the client wants inlay hints
    hints :: Bool,
    -- | the address of the folder that contains the pages of the manual; it ends in a stroke
    manual :: Maybe Text
  }
  deriving stock (Eq, Show)

-- | Reads the capabilities from the parameters of the request @initialize@. A capability that is
-- missing there is false.
fromInitialize :: Value -> Client
fromInitialize params =
  Client
    { hierarchical = at ["documentSymbol", "hierarchicalDocumentSymbolSupport"] == Just (Bool True),
      markdown = knowsMarkdown ["hover", "contentFormat"],
      completionMarkdown = knowsMarkdown ["completion", "completionItem", "documentationFormat"],
      signatureMarkdown =
        knowsMarkdown ["signatureHelp", "signatureInformation", "documentationFormat"],
      actions = isJust (at ["codeAction", "codeActionLiteralSupport"]),
      related = at ["publishDiagnostics", "relatedInformation"] == Just (Bool True),
      progress = inAll ["window", "workDoneProgress"] == Just (Bool True),
      refreshesLenses = inAll ["workspace", "codeLens", "refreshSupport"] == Just (Bool True),
      watchesFiles =
        inAll ["workspace", "didChangeWatchedFiles", "dynamicRegistration"] == Just (Bool True),
      showsDocuments = inAll ["window", "showDocument", "support"] == Just (Bool True),
      snippets = at ["completion", "completionItem", "snippetSupport"] == Just (Bool True),
      hints = within ["initializationOptions", "inlayHints"] params == Just (Bool True),
      manual = case within ["initializationOptions", "manual"] params of
        Just (String address) | address /= "" -> Just (Text.dropWhileEnd (== '/') address <> "/")
        _ -> Nothing
    }
  where
    knowsMarkdown keys = case at keys of
      Just (Array kinds) -> String "markdown" `elem` toList kinds
      _ -> False
    inAll keys = within ("capabilities" : keys) params
    at keys = within (["capabilities", "textDocument"] <> keys) params

-- | The value at a path of keys in nested objects, the outermost key first. Nothing if a key is
-- missing.
within :: [Key] -> Value -> Maybe Value
within keys value = case (keys, value) of
  ([], _) -> Just value
  (key : rest, Object o) -> KeyMap.lookup key o >>= within rest
  (_ : _, _) -> Nothing

-- | The result of the request @initialize@: the name and the capabilities of the server.
initializeResult :: Value
initializeResult =
  object
    [ "serverInfo" .= object ["name" .= ("partc" :: Text)],
      "capabilities" .= object capabilities
    ]

-- | The capabilities of the server.
capabilities :: [Pair]
capabilities =
  [ "textDocumentSync"
      .= object
        [ "openClose" .= True,
          "change" .= incremental,
          "save" .= object ["includeText" .= False]
        ],
    "hoverProvider" .= True,
    "definitionProvider" .= True,
    "referencesProvider" .= True,
    "documentHighlightProvider" .= True,
    "renameProvider" .= object ["prepareProvider" .= True],
    "documentSymbolProvider" .= True,
    "workspaceSymbolProvider" .= True,
    "completionProvider" .= object ["triggerCharacters" .= ["(", "," :: Text]],
    "signatureHelpProvider"
      .= object
        ["triggerCharacters" .= ["(" :: Text], "retriggerCharacters" .= ["," :: Text]],
    "semanticTokensProvider"
      .= object
        [ "legend"
            .= object ["tokenTypes" .= tokenTypes, "tokenModifiers" .= tokenModifiers],
          "full" .= True
        ],
    "inlayHintProvider" .= True,
    "documentLinkProvider" .= object ["resolveProvider" .= False],
    "codeLensProvider" .= object ["resolveProvider" .= False],
    "foldingRangeProvider" .= True,
    "selectionRangeProvider" .= True,
    "documentOnTypeFormattingProvider"
      .= object ["firstTriggerCharacter" .= ("\n" :: Text)],
    "documentFormattingProvider" .= True,
    "executeCommandProvider" .= object ["commands" .= ["partc.preview" :: Text]],
    "codeActionProvider" .= object ["codeActionKinds" .= ["quickfix" :: Text]]
  ]
  where
    -- The protocol's number for Incremental: the client sends changed ranges, not whole texts.
    incremental = 2 :: Int

-- | The names of the kinds of tokens, in the order of their numbers.
tokenTypes :: [Text]
tokenTypes = map name [minBound .. maxBound]
  where
    name kind = case kind of
      KeywordToken -> "keyword"
      NumberToken -> "number"
      TextToken -> "string"
      CommentToken -> "comment"
      ValueToken -> "variable"
      FunctionToken -> "function"
      ContourToken -> "class"

-- | The names of the properties of tokens, in the order of their bits.
tokenModifiers :: [Text]
tokenModifiers = ["definition", "defaultLibrary"]
