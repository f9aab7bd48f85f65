-- | Messages about the state of the server's work: settled diagnostics, progress, proofs, faults.
module Lsp.Status
  ( settled,
    Interruption (..),
    reason,
    progressBegins,
    progressEnds,
    cancelledWork,
    proofEnded,
    watchFiles,
    logged,
    fault,
  )
where

import Base.Decimal qualified as Decimal
import Data.Aeson (Value (..), object, (.=))
import Data.Aeson.KeyMap qualified as KeyMap
import Data.Aeson.Types (Pair)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Read qualified as Read
import Lsp.Capability (Client (..))
import Lsp.Document (Document (..))
import Lsp.Message (Outgoing (..))

-- | The notification that the published diagnostics of this version of a document are complete.
settled :: Document -> Outgoing
settled document = Notify "partc/settled" (object (named document))

-- | The address of a document, and its version if it has one.
named :: Document -> [Pair]
named Document {uri, version} = ("uri" .= uri) : ["version" .= v | Just v <- [version]]

-- | A reason why an analysis was stopped.
data Interruption = TookTooLong | TookTooMuchMemory | StoppedByUser
  deriving stock (Eq, Show)

-- | The reason as a sentence.
reason :: Interruption -> Text
reason why = case why of
  TookTooLong -> "The analysis was stopped after a minute."
  TookTooMuchMemory -> "The analysis was stopped because it needed too much memory."
  StoppedByUser -> "The analysis was stopped."

-- | The messages that begin the display of progress for the work with this number on the file
-- @path@. The user can stop the work.
progressBegins :: Client -> Int -> Text -> [Outgoing]
progressBegins client number path =
  [ message
    | progress client,
      message <-
        [ Ask (token number) "window/workDoneProgress/create" (object ["token" .= token number]),
          progressed
            number
            [ "kind" .= ("begin" :: Text),
              "title" .= ("partc analyses " <> Text.takeWhileEnd (/= '/') path),
              "cancellable" .= True
            ]
        ]
  ]

-- | The message that ends the display of progress.
progressEnds :: Client -> Int -> [Outgoing]
progressEnds client number = [progressed number ["kind" .= ("end" :: Text)] | progress client]

progressed :: Int -> [Pair] -> Outgoing
progressed number value =
  Notify "$/progress" (object ["token" .= token number, "value" .= object value])

-- | The token of the progress of the work with this number.
token :: Int -> Value
token number = String ("partc-" <> Decimal.whole number)

-- | The number of the work that the user wants to stop, from the parameters of a notification
-- @window/workDoneProgress/cancel@.
cancelledWork :: Value -> Maybe Int
cancelledWork params = case params of
  Object o
    | Just (String name) <- KeyMap.lookup "token" o,
      Just digits <- Text.stripPrefix "partc-" name,
      Right (number, "") <- Read.decimal digits ->
      Just number
  _ -> Nothing

-- | The messages after a proof: the result for the status of the editor, and the request to show
-- code lenses anew. @number@ makes the identifier of this request unique.
proofEnded :: Client -> Int -> Document -> Bool -> [Outgoing]
proofEnded client number document isProven =
  Notify "partc/proof" (object (named document <> ["proven" .= isProven])) :
    [ Ask (String ("lens-" <> Decimal.whole number)) "workspace/codeLens/refresh" Null
      | refreshesLenses client
    ]

-- | The request to tell the server of changes of files on the disk, if the client takes it.
watchFiles :: Client -> [Outgoing]
watchFiles client =
  [ Ask (String "watch") "client/registerCapability" $
      object
        [ "registrations"
            .= [ object
                   [ "id" .= ("partc-files" :: Text),
                     "method" .= ("workspace/didChangeWatchedFiles" :: Text),
                     "registerOptions"
                       .= object
                         [ "watchers"
                             .= [object ["globPattern" .= ("**/*.{part,machine,csv}" :: Text)]]
                         ]
                   ]
               ]
        ]
    | watchesFiles client
  ]

-- | The notification that writes a bug of the compiler to the editor's log.
logged :: Text -> Outgoing
logged why =
  Notify "window/logMessage" (object ["type" .= (1 :: Int), "message" .= fault why])

-- | The message for a bug of the compiler, with the text of its exception.
fault :: Text -> Text
fault why = "this is a bug in partc: " <> why
