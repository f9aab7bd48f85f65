{-# LANGUAGE TypeFamilies #-}

-- | A list of tokens as an input stream of megaparsec.
module Surface.TokenStream
  ( TokenStream (..),
  )
where

import Surface.Token (Token)
import Text.Megaparsec qualified as Parsec

-- | The tokens that remain to be parsed.
newtype TokenStream = TokenStream [Token]

instance Parsec.Stream TokenStream where
  type Token TokenStream = Token
  type Tokens TokenStream = [Token]
  tokenToChunk _ t = [t]
  tokensToChunk _ ts = ts
  chunkToTokens _ ts = ts
  chunkLength _ ts = length ts
  chunkEmpty _ ts = null ts
  take1_ (TokenStream ts) = case ts of
    [] -> Nothing
    t : rest -> Just (t, TokenStream rest)
  takeN_ n (TokenStream ts)
    | n <= 0 = Just ([], TokenStream ts)
    | null ts = Nothing
    | otherwise = let (taken, rest) = splitAt n ts in Just (taken, TokenStream rest)
  takeWhile_ p (TokenStream ts) = let (taken, rest) = span p ts in (taken, TokenStream rest)
