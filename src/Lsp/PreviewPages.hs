-- | The pages of the preview that the language server serves: one for each program for which the
-- client has asked for it.
module Lsp.PreviewPages
  ( Pages,
    none,
    open,
    update,
    cursorAt,
  )
where

import Base.Region qualified as Region
import Control.Concurrent
  ( MVar,
    forkIO,
    modifyMVar,
    newEmptyMVar,
    newMVar,
    putMVar,
    readMVar,
    threadDelay,
  )
import Control.Monad (forM_, forever, void)
import Data.Aeson (Value (String), object, (.=))
import Data.List qualified as List
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Lsp.Message (Outgoing (Ask))
import Lsp.Position (LspPosition (..), LspRange (..))
import Lsp.Uri qualified as Uri
import Preview.Server (Listening (AnyPort), Site)
import Preview.Server qualified as Server
import Preview.Subject (Followed)
import Preview.Subject qualified as Subject

-- | The pages by the paths of their programs. The address of a page is absent if it cannot be
-- served.
newtype Pages = Pages (MVar (Map Text (Site, MVar (Maybe Text))))

-- | No page.
none :: IO Pages
none = Pages <$> newMVar Map.empty

-- | The address of the page for the program with this path; nothing if it cannot be served. The
-- page is made if there is none, with the state that the last argument gives. The second argument
-- sends a request to the client, if the client shows positions that are clicked in the page.
open :: Pages -> Maybe (Outgoing -> IO ()) -> Text -> IO (Followed -> Followed) -> IO (Maybe Text)
open (Pages pages) send path state = do
  address <- modifyMVar pages $ \known -> case Map.lookup path known of
    Just (_, address) -> pure (known, address)
    Nothing -> do
      (site, address) <- made
      pure (Map.insert path (site, address) known, address)
  readMVar address
  where
    made = do
      address <- newEmptyMVar
      site <- Server.newSite (showing <$> send) (Subject.nothingYet path Nothing)
      void . forkIO $ do
        ended <- Server.withServer AnyPort site $ \at -> do
          putMVar address (Just at)
          change <- state
          -- A later text may have been analysed in the meantime.
          Server.publish site (\now -> if Subject.version now == 0 then change now else now)
          forever (threadDelay 1000000000)
        either (const (putMVar address Nothing)) pure ended
      pure (site, address)

-- | Asks the client to show a line and a column, from 1, of a file of the page.
showing :: (Outgoing -> IO ()) -> Followed -> Int -> Int -> Int -> IO ()
showing send followed file line column =
  forM_ (take 1 (drop file (Region.files (Subject.soundSource followed)))) $ \(name, _) ->
    send (Ask (String "show-position") "window/showDocument" (parameters name))
  where
    at = LspPosition (line - 1) (column - 1)
    parameters name =
      object
        ["uri" .= Uri.fromPath name, "takeFocus" .= False, "selection" .= LspRange at at]

-- | Changes the state of the page for the program with this path, if there is one.
update :: Pages -> Text -> (Followed -> Followed) -> IO ()
update (Pages pages) path change = do
  known <- readMVar pages
  forM_ (Map.lookup path known) $ \(site, _) -> Server.publish site change

-- | Tells all pages whose program has the file with this path that the cursor is at a line of it.
cursorAt :: Pages -> Text -> Int -> IO ()
cursorAt (Pages pages) path line = do
  known <- readMVar pages
  forM_ known $ \(site, _) -> do
    names <- map fst . Region.files . Subject.soundSource <$> Server.present site
    forM_ (List.elemIndex path names) $ \file -> Server.pointAt site file line
