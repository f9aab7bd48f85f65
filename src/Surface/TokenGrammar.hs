{-# LANGUAGE RankNTypes #-}

-- | The rules of the grammar for single words and texts. The rules for statements and expressions
-- are in "Surface.Grammar".
module Surface.TokenGrammar
  ( text',
    machine,
    sense,
    cutterSide,
    misfit,
    lineDone,
    touching,
    isTouchingParenthesis,
  )
where

import Base.Region (Located)
import Control.Monad (void)
import Data.Text (Text)
import Surface.Combinator
import Surface.Syntax
import Surface.Token (Token (..), Token_ (..))
import Text.Megaparsec ((<|>))
import Text.Megaparsec qualified as Parsec

-- | A text in quotation marks.
text' :: Parser (Located Text)
text' = located (token "a text" textOf)
  where
    textOf t = case shape t of
      Text x -> Just x
      _ -> Nothing

-- | The name of a machine or of a file that describes one.
machine :: Parser MachineRef
machine = token "the name of a machine" machineOf
  where
    machineOf t = case shape t of
      Word x -> Just (Named x)
      Text x -> Just (Described x)
      _ -> Nothing

-- | The sense of a circle or of a spindle.
sense :: Parser Sense
sense = (Clockwise <$ keyword "cw") <|> (CounterClockwise <$ keyword "ccw")

-- | The side of a contour on which a cutter moves.
cutterSide :: Parser Side
cutterSide = Parsec.choice [s <$ keyword k | (k, s) <- sides]
  where
    sides =
      [ ("outside", Outside),
        ("inside", Inside),
        ("left", LeftSide),
        ("right", RightSide),
        ("on", On)
      ]

-- | Fails at the next token, which begins no cell or heading of a table. @problem@ makes the
-- failure from the token.
misfit :: (Token_ -> Problem) -> Parser a
misfit problem =
  Parsec.lookAhead Parsec.anySingle >>= \t -> Parsec.customFailure (problem (shape t))

-- | Demands the end of a table's line or the closing brace of the table. @problem@ makes the
-- failure from any other token.
lineDone :: (Token_ -> Problem) -> Parser ()
lineDone problem = do
  next <- remaining
  case next of
    t : _ | not (newLine t) && shape t /= Symbol "}" -> misfit problem
    _ -> pure ()

-- | Demands that the next token is an opening parenthesis without a space before it. A name before
-- such a parenthesis is the name of a function. The token is not consumed.
touching :: Parser ()
touching = Parsec.hidden (void (Parsec.lookAhead (Parsec.satisfy isTouchingParenthesis)))

-- | Tells if a token is an opening parenthesis without a space before it.
isTouchingParenthesis :: Token -> Bool
isTouchingParenthesis t = attached t && shape t == Symbol "("
