{-# LANGUAGE RankNTypes #-}

-- | The rules of the grammar for parts of drawings. They take the rule for numbers from
-- "Surface.Grammar".
module Surface.DrawingGrammar
  ( drawingReference,
    allOutlines,
    fromFile,
  )
where

import Base.Quantity (LengthUnit (..))
import Base.Region (Located (..))
import Data.Maybe (isNothing)
import Data.Text (Text)
import Drawing.FileFormat (formatOf)
import Surface.Combinator
import Surface.EngravingGrammar (lettering)
import Surface.Syntax
import Surface.TokenGrammar (text')
import Text.Megaparsec ((<?>), (<|>))
import Text.Megaparsec qualified as Parsec

-- | A part of a drawing: the name of its file, and what is chosen of it.
drawingReference :: Parser Expr -> Parser DrawingReference
drawingReference number = fileName >>= \file -> partOf file number

-- | The outlines of a drawing or of a text after the keyword @contours@:
-- @parts from "plate.dxf" layer "CUT"@ and @sign from "sans.ttf" text "12" at p height 8@.
allOutlines :: Parser Expr -> Parser Expr -> Parser Statement_
allOutlines number expr = do
  what <- name <* keyword "from"
  file <- fileName
  (drawnText what file <$> (onThisLine (keyword "text") *> lettering expr))
    <|> (Drawn AllOutlines what <$> partOf file number)
  where
    drawnText what file text = DrawnText what file text []

fileName :: Parser (Located Text)
fileName = text' <?> "the name of a file in quotation marks"

-- | The part of a drawing that is chosen after the name of its file.
partOf :: Located Text -> Parser Expr -> Parser DrawingReference
partOf file number = do
  chosen <- Parsec.optional (onThisLine (located choice))
  unit <- Parsec.optional (onThisLine (keyword "unit" *> located lengthUnit))
  DrawingReference file chosen unit <$> Parsec.optional (onThisLine (keyword "within" *> number))
  where
    choice =
      (OnLayer <$> (keyword "layer" *> named))
        <|> (WithIdentifier <$> (keyword "id" *> named))
        <|> (WithClass <$> (keyword "class" *> named))
    named = value <$> (text' <?> "a name in quotation marks")
    lengthUnit = (Millimetres <$ keyword "mm") <|> (Inches <$ keyword "in")

-- | The lines of a table from a file: a drawing, or comma-separated values.
fromFile :: DrawingReference -> Lines
fromFile part@(DrawingReference file chosen unit within)
  | isNothing chosen && isNothing unit && isNothing within && isNothing (formatOf (value file)) =
    LinesFromFile file
  | otherwise = LinesFromDrawing part
