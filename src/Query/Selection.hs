-- | The regions to which an editor extends a selection step by step.
module Query.Selection
  ( enclosing,
  )
where

import Base.Region (Located (..), Region (..))
import Base.Region qualified as Region
import Data.Containers.ListUtils (nubOrd)
import Data.List (sortOn)
import Data.Text qualified as Text
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Surface.Lexer qualified as Lexer
import Surface.Syntax (Program (..), Statement, Statement_ (..))
import Surface.SyntaxWalk qualified as SyntaxWalk
import Surface.Token qualified as Token

-- | The regions around the offset @at@, the smallest first: a word, expressions, a setting or an
-- item, statements, the whole text. Each lies in the next one.
enclosing :: Snapshot -> Int -> [Region]
enclosing now at = nested (sortOn size (nubOrd (tokens <> nodes <> [Region 0 (Text.length text)])))
  where
    text = Region.text (Snapshot.source now)
    tokens = filter contains (map Token.place (fst (Lexer.tokens 0 text)))
    nodes = concatMap (regionsAround at) (statements (Snapshot.program now))
    contains (Region a b) = a <= at && at <= b
    size (Region a b) = b - a
    -- If two words touch at the cursor, only the first one is kept.
    nested regions = case regions of
      Region a b : rest -> Region a b : nested [r | r@(Region c d) <- rest, c <= a, b <= d]
      [] -> []

-- | The regions of all nodes of a statement that contain an offset, the outermost first.
regionsAround :: Int -> Statement -> [Region]
regionsAround at s
  | not (contains (region s)) = []
  | otherwise =
    region s :
    concatMap (regionsAround at) (SyntaxWalk.blocks s)
      <> [region i | i <- SyntaxWalk.itemsOf s, contains (region i)]
      <> settings
      <> concatMap inExpression (SyntaxWalk.ofStatement s)
  where
    contains (Region a b) = a <= at && at <= b
    inExpression e
      | contains (region e) = region e : concatMap inExpression (SyntaxWalk.parts e)
      | otherwise = []
    settings = case value s of
      Mill _ _ ss -> [region x | x <- ss, contains (region x)]
      Pocket _ _ _ ss -> [region x | x <- ss, contains (region x)]
      RestOf _ _ ss -> [region x | x <- ss, contains (region x)]
      Face _ _ ss -> [region x | x <- ss, contains (region x)]
      Vcarve _ _ ss -> [region x | x <- ss, contains (region x)]
      Engrave _ ss -> [region x | x <- ss, contains (region x)]
      Turn _ _ ss -> [region x | x <- ss, contains (region x)]
      Hole _ _ _ _ ss -> [region x | x <- ss, contains (region x)]
      Drill _ _ ss -> [region x | x <- ss, contains (region x)]
      _ -> []
