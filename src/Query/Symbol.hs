-- | The symbols of a program, which an editor shows as its outline. Definitions, machining
-- statements, moves, tool changes and statements with a block have symbols.
module Query.Symbol
  ( DocumentSymbol (..),
    SymbolKind (..),
    symbols,
    present,
    flattened,
    matching,
  )
where

import Base.Name (Name (..))
import Base.Name qualified as Name
import Base.Region (Located (..), Region (..), Source)
import Base.Region qualified as Region
import Data.List.NonEmpty (NonEmpty)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe, mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Query.RegionMap (RegionMap)
import Query.RegionMap qualified as RegionMap
import Query.Snapshot (Snapshot (..))
import Surface.Syntax (Lettering (lettered, textHeight), Program (..), Statement, Statement_ (..))
import Surface.SyntaxWalk qualified as SyntaxWalk

-- | A symbol: the name, a short addition such as a parameter list, the kind, the region of the
-- whole statement, and the region to select in it.
data DocumentSymbol = DocumentSymbol
  { name :: Text,
    detail :: Text,
    kind :: SymbolKind,
    whole :: Region,
    selection :: Region,
    -- | the symbols of the statements in its block
    children :: [DocumentSymbol]
  }
  deriving stock (Eq, Show)

-- | The kind of statement for which a symbol is made. 'Value' is also the kind of parameters,
-- tables, curves and pieces. 'Machining' is the kind of all statements that are not definitions.
data SymbolKind = Part' | Value | Function | Contour' | Machining
  deriving stock (Eq, Show, Enum, Bounded)

-- | The symbols of a program in the order of the text. Settings, commands, imports and assertions
-- have no symbol.
symbols :: Snapshot -> [DocumentSymbol]
symbols Snapshot {source, program} = mapMaybe (symbol source) (statements program)

-- | A symbol and all symbols inside it.
flattened :: DocumentSymbol -> [DocumentSymbol]
flattened s = s : concatMap flattened (children s)

-- | The symbols of a program whose name contains the letters of a query in their order. Upper and
-- lower case count as the same letter. The empty query fits every symbol.
matching :: Text -> Snapshot -> [DocumentSymbol]
matching query now =
  [s | s <- concatMap flattened (symbols now), Text.toLower query `isWithin` Text.toLower (name s)]
  where
    isWithin wanted text = case (Text.uncons wanted, Text.uncons text) of
      (Nothing, _) -> True
      (Just _, Nothing) -> False
      (Just (c, more), Just (d, rest)) -> (if c == d then more else wanted) `isWithin` rest

-- | The symbols of the present text. If it has no syntax tree, perhaps because it is not analysed
-- yet, they are those of the snapshot @before@, at the corresponding places.
present :: Snapshot -> Maybe Snapshot -> [DocumentSymbol]
present now before = case before of
  Just old
    | null (statements (program now)) ->
      mapMaybe (moved (RegionMap.between (textOf old) (textOf now))) (symbols old)
  _ -> symbols now
  where
    textOf = Region.text . source

-- | The symbol at the corresponding place; nothing if its name or one of its ends has changed.
moved :: RegionMap -> DocumentSymbol -> Maybe DocumentSymbol
moved regionMap s = do
  whole' <- ends (whole s)
  selection' <- RegionMap.forward regionMap (selection s)
  Just
    s
      { whole = whole',
        selection = selection',
        children = mapMaybe (moved regionMap) (children s)
      }
  where
    ends (Region from to) = do
      begins <- RegionMap.forward regionMap (Region from from)
      ends' <- RegionMap.forward regionMap (Region to to)
      Just (Region.merge begins ends')

-- | The symbol of a statement; 'Nothing' if it has none. A definition is shown by its name. Any
-- other statement is shown by the beginning of its text. For @mill@ and @turn@ this text ends with
-- the side, for @pocket@, @rest of@ and @face@ with the stepover, for @drill@ with the depth,
-- for @engrave@ with the height, for @vcarve@ with the region.
symbol :: Source -> Statement -> Maybe DocumentSymbol
symbol source (Located whole s) = case s of
  Part name title -> definition Part' name (maybe "" value title)
  LetValue name _ -> definition Value name ""
  Param name _ -> definition Value name "param"
  LetFunction name parameters _ -> definition Function name (parameterList parameters)
  Contour name _ _ -> definition Contour' name ""
  Drawn _ name _ -> definition Contour' name ""
  Table name _ -> definition Value name "table"
  Curve name _ -> definition Value name "curve"
  Piece name _ _ _ _ -> definition Value name "piece"
  Mill contour side _ -> machining (region side) (region contour)
  Pocket contour stepover own _ -> machining (region stepover) (maybe (region contour) region own)
  RestOf clearing stepover _ -> machining (region stepover) (region clearing)
  Face contour stepover _ -> machining (region stepover) (region contour)
  Vcarve e own _ -> machining (region e) (maybe (region e) region own)
  Engrave text _ -> machining (region (textHeight text)) (region (lettered text))
  Turn contour side _ -> machining (region side) (region contour)
  Drill holes depth _ -> machining (region depth) (region holes)
  Hole _ points sizes _ _ ->
    machining (maybe (region points) (region . snd) (listToMaybe (reverse sizes))) (region points)
  Travel _ _ -> machining whole whole
  Change number cutter _ -> machining (region cutter) (region number)
  Repeat (Located selection _) list _ -> machining (region list) selection
  When condition _ _ -> machining (region condition) (region condition)
  With placement _ -> machining (region placement) (region placement)
  Broken _ name -> name >>= \n -> definition Value n ""
  DrawnText name _ _ _ -> definition Value name ""
  Machine _ -> Nothing
  Units _ -> Nothing
  Import _ -> Nothing
  Tool _ _ -> Nothing
  Feed _ -> Nothing
  Tolerance _ -> Nothing
  Clearance _ -> Nothing
  From _ -> Nothing
  WorkOffset _ -> Nothing
  ProgramNumber _ -> Nothing
  SafeHeight _ -> Nothing
  Stock _ _ -> Nothing
  Avoid _ _ -> Nothing
  Assert _ _ -> Nothing
  Spindle _ -> Nothing
  Coolant _ -> Nothing
  Auxiliary _ -> Nothing
  ProgramStop -> Nothing
  OptionalStop -> Nothing
  Dwell _ -> Nothing
  where
    definition kind (Located selection symbolName@(Name name)) detail
      | Name.isHidden symbolName = Nothing
      | otherwise = Just DocumentSymbol {name, detail, kind, whole, selection, children}
    machining lastRegion selection =
      Just
        DocumentSymbol
          { name = slice source (Region (start whole) (end lastRegion)),
            detail = "",
            kind = Machining,
            whole,
            selection,
            children
          }
    children = mapMaybe (symbol source) (SyntaxWalk.blocks (Located whole s))

-- | The names of a function's parameters in round brackets, as the addition to its symbol.
parameterList :: NonEmpty (Located Name) -> Text
parameterList parameters =
  "(" <> Text.intercalate ", " [n | Located _ (Name n) <- NonEmpty.toList parameters] <> ")"

-- | The text of the region @part@ as one line, with single spaces between its words.
slice :: Source -> Region -> Text
slice source part = Text.unwords (concatMap Text.words (Region.linesIn source part))
