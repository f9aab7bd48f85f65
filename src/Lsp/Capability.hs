-- | What the client can do, and what it is told that the server can.
module Lsp.Capability
  ( Client (..),
    fromInitialize,
    welcome,
  )
where

import Data.Aeson (Value (..), object, (.=))
import Data.Aeson.Key (Key)
import Data.Aeson.KeyMap qualified as KeyMap
import Data.Foldable (toList)
import Data.Text (Text)

-- | The capabilities that change an answer.
data Client = Client
  { -- | symbols may say where their name is
    hierarchical :: Bool,
    -- | hovers may be Markdown
    markdown :: Bool,
    -- | a diagnostic may name other places
    related :: Bool
  }
  deriving stock (Eq, Show)

-- | From the parameters of @initialize@. What is not said, the client cannot do.
fromInitialize :: Value -> Client
fromInitialize params =
  Client
    { hierarchical = at ["documentSymbol", "hierarchicalDocumentSymbolSupport"] == Just (Bool True),
      markdown = case at ["hover", "contentFormat"] of
        Just (Array kinds) -> String "markdown" `elem` toList kinds
        _ -> False,
      related = at ["publishDiagnostics", "relatedInformation"] == Just (Bool True)
    }
  where
    at keys = within (["capabilities", "textDocument"] <> keys) params

within :: [Key] -> Value -> Maybe Value
within keys value = case (keys, value) of
  ([], _) -> Just value
  (key : rest, Object o) -> KeyMap.lookup key o >>= within rest
  (_ : _, _) -> Nothing

-- | The answer to @initialize@.
welcome :: Value
welcome =
  object
    [ "serverInfo" .= object ["name" .= ("partc" :: Text)],
      "capabilities"
        .= object
          [ "textDocumentSync"
              .= object
                [ "openClose" .= True,
                  "change" .= incremental,
                  "save" .= object ["includeText" .= False]
                ],
            "hoverProvider" .= True,
            "definitionProvider" .= True,
            "documentSymbolProvider" .= True,
            "documentFormattingProvider" .= True
          ]
    ]
  where
    incremental = 2 :: Int
