{-# LANGUAGE TypeFamilies #-}

-- | A list of tokens as an input stream of megaparsec.
module Surface.TokenStream
  ( Input (..),
  )
where

import Surface.Token (Token)
import Text.Megaparsec qualified as Parsec

-- | The tokens that remain to be parsed.
newtype Input = Input [Token]

instance Parsec.Stream Input where
  type Token Input = Token
  type Tokens Input = [Token]
  tokenToChunk _ t = [t]
  tokensToChunk _ ts = ts
  chunkToTokens _ ts = ts
  chunkLength _ ts = length ts
  chunkEmpty _ ts = null ts
  take1_ (Input ts) = case ts of
    [] -> Nothing
    t : rest -> Just (t, Input rest)
  takeN_ n (Input ts)
    | n <= 0 = Just ([], Input ts)
    | null ts = Nothing
    | otherwise = let (taken, rest) = splitAt n ts in Just (taken, Input rest)
  takeWhile_ p (Input ts) = let (taken, rest) = span p ts in (taken, Input rest)
