{-# LANGUAGE RankNTypes #-}

-- | The rules of the grammar for texts that are cut. They take the rule for expressions from
-- "Surface.Grammar".
module Surface.EngravingGrammar
  ( engraving,
    lettering,
  )
where

import Data.Text (Text)
import Surface.Combinator
import Surface.Syntax
import Surface.TokenGrammar (text')
import Text.Megaparsec ((<?>), (<|>))
import Text.Megaparsec qualified as Parsec

-- | An engraving after its keyword: @"12" at p height 8 direction 30 align centre { … }@.
engraving :: Parser Expr -> (Text -> Parser [Setting]) -> Parser Statement_
engraving expr settings = Engrave <$> (lettering expr <?> "a text") <*> settings "engrave"

-- | A text with its place: @"12" at p height 8 direction 30 align centre@.
lettering :: Parser Expr -> Parser Lettering
lettering expr =
  Lettering <$> onSameLine "a text in quotation marks" text'
    <*> (keyword "at" *> expr)
    <*> (keyword "height" *> expr)
    <*> Parsec.option Level (onThisLine course')
    <*> Parsec.optional (onThisLine (keyword "align" *> alignment'))
  where
    course' =
      (keyword "direction" *> (Inclined <$> expr))
        <|> ( keyword "around"
                *> ( Around <$> expr
                       <*> Parsec.optional (onThisLine (located side))
                   )
            )
    side = (Outside <$ keyword "outside") <|> (Inside <$ keyword "inside")
    alignment' =
      (AlignLeft <$ keyword "left")
        <|> (AlignCentre <$ keyword "centre")
        <|> (AlignRight <$ keyword "right")
