{-# OPTIONS_GHC -F -pgmF hspec-discover -Wno-missing-export-lists #-}
