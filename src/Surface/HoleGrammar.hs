{-# LANGUAGE RankNTypes #-}

-- | The rules of the grammar for works on holes and for tools. They take the rule for expressions
-- from "Surface.Grammar".
module Surface.HoleGrammar
  ( hole,
    cutter,
  )
where

import Data.Text (Text)
import Surface.Combinator
import Surface.HoleForm qualified as HoleForm
import Surface.Syntax
import Text.Megaparsec ((<?>), (<|>))
import Text.Megaparsec qualified as Parsec

-- | A work on holes after its keyword: the points, the sizes, the side of a thread, the settings.
hole :: Parser Expr -> (Text -> Parser [Setting]) -> HoleWork -> Parser Statement_
hole expr settings work =
  keyword "at"
    *> ( Hole work
           <$> expr
             <*> Parsec.choice (map (traverse size) (HoleForm.sizeForms work))
             <*> side
             <*> Parsec.option [] (onThisLine (settings (HoleForm.word work)))
       )
  where
    size s = (s,) <$> (keyword (HoleForm.sizeWord s) *> expr)
    side = case work of
      Threading ->
        Just <$> located ((Inside <$ keyword "inside") <|> (Outside <$ keyword "outside"))
      _ -> pure Nothing

-- | A cutter: @mill(diameter 20 mm)@, @drill(…)@, @tap(…)@, @threadmill(…)@, @turn(…)@, @cone(…)@,
-- @vbit(…)@, @blade(…)@.
cutter :: Parser Expr -> Parser Cutter
cutter expr =
  located $
    one "mill" MillCutter size
      <|> one "drill" DrillCutter (size <|> (PointAngle <$> measured "angle"))
      <|> one "tap" TapCutter size
      <|> ( keyword "threadmill"
              *> parens
                ( ThreadMillCutter
                    <$> measured "diameter"
                      <*> further expr "pitch" threadForm
                      <*> sizes size
                )
          )
      <|> (keyword "turn" *> parens (TurningCutter <$> measured "nose" <*> Parsec.optional tip))
      <|> leaningCutter expr
  where
    one kind make allowed =
      keyword kind *> parens (make <$> measured "diameter" <*> sizes allowed)
    sizes allowed = zeroOrMore (symbol "," *> located allowed)
    size =
      (Flutes <$> measured "flutes")
        <|> (StickOut <$> measured "stickout")
        <|> (HolderCylinder <$> measured "holder" <*> Parsec.optional (measured "height"))
    measured measure = keyword measure *> expr
    tip = symbol "," *> measured "tip"
    threadForm = "the rest of threadmill(diameter 8 mm, pitch 1.5 mm)"

-- | A cutter for surfaces that lean: @cone(…)@, @vbit(…)@, @blade(…)@.
leaningCutter :: Parser Expr -> Parser Cutter_
leaningCutter expr =
  one "cone" (ConeCutter <$> measured "diameter" <*> also "bevel" cone <*> also "height" cone)
    <|> one "vbit" (VBitCutter <$> measured "angle" <*> also "tip" bit <*> also "diameter" bit)
    <|> one "blade" (BladeCutter <$> measured "diameter" <*> also "gear" blade)
  where
    one kind made = keyword kind *> parens made
    measured measure = keyword measure *> expr
    also = further expr
    cone = "the rest of cone(diameter 20 mm, bevel 5 deg, height 30 mm)"
    bit = "the rest of vbit(angle 60 deg, tip 0.2 mm, diameter 6 mm)"
    blade = "the rest of blade(diameter 20 mm, gear 70 mm)"

-- | A further size of a cutter that cannot be left out. @form@ shows what may follow.
further :: Parser Expr -> Text -> String -> Parser Expr
further expr measure form = (symbol "," <?> form) *> keyword measure *> expr
