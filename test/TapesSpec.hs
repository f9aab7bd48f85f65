-- | Tapes that were changed by hand, each with the program that it is verified against.
--
-- The folder test/tapes has for each a program, a tape for iso6983 and the output of @partc
-- verify@. With PARTC_RECORD set, the outputs are written.
module TapesSpec (spec) where

import Command (partc)
import Control.Monad (forM_)
import Data.List (sort)
import Data.Text qualified as Text
import Files (expected, filesBelow)
import System.FilePath (replaceExtension, takeExtension)
import Test.Hspec

spec :: Spec
spec = describe "tapes changed by hand" $ do
  programs <- runIO (sort . filter ((== ".part") . takeExtension) <$> filesBelow "test/tapes")
  forM_ programs $ \program -> it program $ do
    (_, table, reports) <- partc ["verify", program, replaceExtension program "ngc"]
    expected (replaceExtension program "verified") (Text.pack (table <> reports))
