-- | Locations of the Language Server Protocol: an address of a file and a range in it.
module Lsp.Location
  ( location,
  )
where

import Base.Region (Region, Source)
import Base.Region qualified as Region
import Data.Aeson (Value, object, (.=))
import Lsp.Position qualified as Position
import Lsp.Uri (Uri)
import Lsp.Uri qualified as Uri

-- | The location of a region of @source@. If the region lies in the open document, the address is
-- @own@, in the client's spelling. Otherwise the region lies in an imported file, and the address
-- is made from the path of that file.
location :: Uri -> Source -> Region -> Value
location own source region = object ["uri" .= uri, "range" .= Position.range source region]
  where
    file = Position.fileOf source region
    uri = if file == Region.mainFile source then own else Uri.fromPath file
