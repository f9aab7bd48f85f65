-- | The requests about the name under the cursor.
module Lsp.NameRequest
  ( hover,
    definition,
    references,
    highlights,
    prepareRename,
    rename,
  )
where

import Base.Region (Region)
import Base.Region qualified as Region
import Data.Aeson (Value (..), object, toJSON, withObject, (.:), (.:?), (.=))
import Data.Aeson.Key qualified as Key
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Lsp.Capability (Client (..))
import Lsp.Document (Document (..))
import Lsp.Location qualified as Location
import Lsp.ManualLink qualified as ManualLink
import Lsp.Position (LspRange)
import Lsp.Position qualified as Position
import Lsp.Subject
  ( Method,
    Subject (..),
    atCursor,
    fenced,
    markup,
    offsetIn,
    rangeOf,
    source,
  )
import Lsp.Subject qualified as Subject
import Lsp.Uri (Uri (..))
import Lsp.Uri qualified as Uri
import Query.Description (Description (..))
import Query.Description qualified as Description
import Query.Name qualified as Name
import Query.Reference (References (places))
import Query.Reference qualified as Reference
import Query.Rename qualified as Rename
import Query.SharedFile
  ( FileMentions (..),
    FilePlace (..),
    OpenProgram (OpenProgram, present, previous),
    SharedFile (..),
  )
import Query.SharedFile qualified as SharedFile
import Query.Snapshot qualified as Snapshot

-- | The request @textDocument/hover@.
hover :: Method
hover client subject = atCursor Description.description shown subject
  where
    shown d = object ["contents" .= contents d, "range" .= rangeOf subject (region d)]
    contents d = markup client (marked d) (Text.intercalate "\n" (line d : texts d))
    marked d = fenced (line d) <> "\n" <> Text.intercalate "\n\n" (texts d)
    line d = title d <> if length (values d) == 1 then " = " <> Text.concat (values d) else ""
    texts d =
      [sentence d | sentence d /= ""]
        <> [Text.intercalate lineEnd [k <> ": " <> v | (k, v) <- facts d] | not (null (facts d))]
        <> [ManualLink.sentence client e | Just e <- [entry d]]
    lineEnd = if markdown client then "  \n" else "\n"

-- | The request @textDocument/definition@.
definition :: Method
definition _ subject = atCursor Name.definition shown subject
  where
    shown target =
      Location.location (uri (document subject)) (Name.source target) (Name.region target)

-- | The request @textDocument/references@. The client says if it wants the definition, too.
references :: Method
references _ subject params = do
  at <- offsetIn subject params
  context <- withObject "parameters" (.:? "context") params
  isWanted <- maybe (pure True) (withObject "a context" (.: "includeDeclaration")) context
  let shown all' =
        [ object ["uri" .= addressOf subject (mentionsIn ms), "range" .= range]
          | ms <- Reference.mentions all',
            (r, range) <- rangesOf ms,
            isWanted || Just (FilePlace (identity (mentionsIn ms)) r) /= Reference.definedAt all'
        ]
      found = Reference.sharedReferences (openPrograms subject) (now subject) (sound subject) at
  pure (maybe Null (toJSON . shown) found)

-- | The other open documents as programs.
openPrograms :: Subject -> [OpenProgram]
openPrograms subject =
  [ OpenProgram {present = now o, SharedFile.isAnalysed = Subject.isAnalysed o, previous = sound o}
    | o <- others subject
  ]

-- | The address of a file: that of the open document, in the client's spelling, or else one made
-- from the path of the file.
addressOf :: Subject -> SharedFile -> Uri
addressOf subject f = fromMaybe (Uri.fromPath (path f)) (lookup (identity f) opened)
  where
    opened = [(ownIdentity (now o), uri (document o)) | o <- subject : others subject]
    ownIdentity s = Snapshot.identityOf s (Region.mainFile (Snapshot.source s))

-- | The mentions in one file: their regions and their ranges.
rangesOf :: FileMentions -> [(Region, LspRange)]
rangesOf FileMentions {mentionsIn, regions} = [(r, Position.range own r) | r <- regions]
  where
    own = Region.fromText (path mentionsIn) (content mentionsIn)

-- | The request @textDocument/documentHighlight@: the mentions in the document itself.
highlights :: Method
highlights _ subject = atCursor Reference.references (toJSON . map shown . own) subject
  where
    own found = filter (isInDocument subject) (places found)
    shown r = object ["range" .= rangeOf subject r, "kind" .= (1 :: Int)]

-- | True if a region lies in the document itself, and not in an imported file.
isInDocument :: Subject -> Region -> Bool
isInDocument subject r = Position.fileOf (source subject) r == Region.mainFile (source subject)

-- | The request @textDocument/prepareRename@.
prepareRename :: Method
prepareRename _ subject params = do
  at <- offsetIn subject params
  case Rename.prepare (now subject) at of
    Left why -> fail (Text.unpack why)
    Right (region, name) ->
      pure (object ["range" .= rangeOf subject region, "placeholder" .= name])

-- | The request @textDocument/rename@. It is refused with the reason if the renaming would change
-- the meaning of an open program.
rename :: Method
rename _ subject params = do
  at <- offsetIn subject params
  new <- withObject "parameters" (.: "newName") params
  case Rename.rename (openPrograms subject) (now subject) at new of
    Left why -> fail (Text.unpack why)
    Right edited ->
      pure
        ( object
            [ "changes"
                .= object
                  [ Key.fromText address .= map (edit new . snd) (rangesOf ms)
                    | ms <- edited,
                      let Uri address = addressOf subject (mentionsIn ms)
                  ]
            ]
        )
  where
    edit new range = object ["range" .= range, "newText" .= (new :: Text)]
