-- | The outline of a program: what it names, and what is machined.
module Query.Symbol
  ( DocumentSymbol (..),
    SymbolKind (..),
    symbols,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (..), Region (..), Source)
import Base.Region qualified as Region
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Query.Snapshot (Snapshot (..))
import Surface.Syntax (Program (..), Statement, Statement_ (..))

-- | A name, a few words more, the whole statement and the name in it.
data DocumentSymbol = DocumentSymbol
  { name :: Text,
    detail :: Text,
    kind :: SymbolKind,
    whole :: Region,
    selection :: Region
  }
  deriving stock (Eq, Show)

-- | What a symbol stands for.
data SymbolKind = Part' | Value | Function | Contour' | Machining
  deriving stock (Eq, Show, Enum, Bounded)

-- | The symbols in the order of the text. Statements that only set something have none.
symbols :: Snapshot -> [DocumentSymbol]
symbols Snapshot {source, program} = mapMaybe (symbol source) (statements program)

symbol :: Source -> Statement -> Maybe DocumentSymbol
symbol source (Located whole s) = case s of
  Part what title -> named Part' what (maybe "" value title)
  LetValue what _ -> named Value what ""
  Param what _ -> named Value what "param"
  LetFunction what parameters _ ->
    named
      Function
      what
      ("(" <> Text.intercalate ", " [n | Located _ (Name n) <- NonEmpty.toList parameters] <> ")")
  Contour what _ _ -> named Contour' what ""
  Table what _ -> named Value what "table"
  Curve what _ -> named Value what "curve"
  Piece what _ _ _ _ -> named Value what "piece"
  Mill what side _ -> Just (unnamed (Region (start whole) (end (region side))) (region what))
  Pocket what apart _ -> Just (unnamed (Region (start whole) (end (region apart))) (region what))
  Turn what side _ -> Just (unnamed (Region (start whole) (end (region side))) (region what))
  Drill places depth _ -> Just (unnamed (Region (start whole) (end (region depth))) (region places))
  Travel _ _ -> Just (unnamed whole whole)
  Change number' cutter ->
    Just (unnamed (Region (start whole) (end (region cutter))) (region number'))
  Repeat (Located selection _) list _ ->
    Just (unnamed (Region (start whole) (end (region list))) selection)
  When condition _ _ ->
    Just (unnamed (Region (start whole) (end (region condition))) (region condition))
  With placement _ ->
    Just (unnamed (Region (start whole) (end (region placement))) (region placement))
  Broken _ what -> what >>= \n -> named Value n ""
  Machine _ -> Nothing
  Import _ -> Nothing
  Tool _ -> Nothing
  Feed _ -> Nothing
  Tolerance _ -> Nothing
  Clearance _ -> Nothing
  From _ -> Nothing
  Assert _ _ -> Nothing
  Spindle _ -> Nothing
  Coolant _ -> Nothing
  Auxiliary _ -> Nothing
  where
    named kind (Located selection (Name name)) detail =
      Just DocumentSymbol {name, detail, kind, whole, selection}
    unnamed words' selection =
      DocumentSymbol {name = slice source words', detail = "", kind = Machining, whole, selection}

-- | A piece of the text on one line.
slice :: Source -> Region -> Text
slice source place = Text.unwords (concatMap Text.words (Region.pieces source place))
