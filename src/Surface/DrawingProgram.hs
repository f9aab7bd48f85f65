-- | The text of a part program from a drawing: a contour for each outline, or a table for a layer
-- of circles.
module Surface.DrawingProgram
  ( convert,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Quantity (LengthUnit, Mm (..), times)
import Base.Region (Located (..), Region (Region))
import Base.Result (Result (..))
import Data.ByteString (ByteString)
import Data.Char (isAlpha, isAlphaNum)
import Data.Containers.ListUtils (nubOrdOn)
import Data.Either (partitionEithers)
import Data.List (find, mapAccumL, nub)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe)
import Data.Set (Set)
import Data.Set qualified as Set
import Data.Text (Text)
import Data.Text qualified as Text
import Drawing.Drawing (Entity)
import Drawing.Drawing qualified as Drawing
import Drawing.Outline (DrawnPart (..), Outline (..))
import Geometry.Carrier (Circle (Circle))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Vec qualified as Vec
import Surface.DrawingError (DrawingMistake)
import Surface.DrawnContour qualified as DrawnContour
import Surface.Formatter qualified as Formatter
import Surface.FromDrawing (Converted (..), DrawingText (..))
import Surface.FromDrawing qualified as FromDrawing
import Surface.Keyword qualified as Keyword
import Surface.Syntax
import Surface.Token (unitName)
import System.FilePath (takeBaseName, takeFileName)

-- | The text of a program from a drawing with some of its layers, or with all if none is named.
-- @name@ is the path of the file of the drawing, and @shown@ its text, to which the regions of the
-- reports refer. @stated@ is the unit of the drawing if its file does not give it. Ends within
-- @tolerance@ are joined.
convert ::
  Text ->
  Maybe LengthUnit ->
  Mm ->
  [Text] ->
  Text ->
  ByteString ->
  Result DrawingMistake DrawingMistake Text
convert name stated tolerance wanted shown content =
  case FromDrawing.fromBytes (Located start name) stated (0, shown) content of
    (faults, remarks, Nothing) -> Result remarks faults Nothing
    (_, presumptions, Just text) ->
      let remarks = presumptions <> concatMap (FromDrawing.remarksIn text) selections
       in case partitionEithers (map (chosenFrom text) selections) of
            (fault : more, _) -> Result remarks (fault : more) Nothing
            ([], chosen) -> programOf text remarks (concat chosen)
  where
    start = Region 0 0
    chosenFrom text selection = FromDrawing.chosenFrom start selection (drawing text)
    selections
      | null wanted = [Nothing]
      | otherwise = map (Just . Located start . OnLayer) (nubOrdOn Text.toCaseFold wanted)
    programOf text remarks es =
      let layers = [(layer, joinedIn text layerOf) | (layer, layerOf) <- byLayer es]
          faults = concatMap (mistakes . snd) layers
          made = [(layer, given c) | (layer, c) <- layers]
          own = Text.pack (takeBaseName (Text.unpack name))
          file = Text.pack (takeFileName (Text.unpack name))
       in Result
            (remarks <> concatMap (notes . snd) layers)
            faults
            (if null faults then Just (programText tolerance own file made) else Nothing)
    joinedIn text = FromDrawing.outlinesIn text start tolerance
    byLayer es =
      [(layer, filter ((== layer) . Drawing.layer) es) | layer <- nub (map Drawing.layer es)]

-- | The text of a program with the name @own@, from the outlines of each layer of a drawing. The
-- comments name the entities and their lines in the file. Circles within the tolerance of one
-- centre stay contours.
programText :: Mm -> Text -> Text -> [(Text, [Outline])] -> Text
programText tolerance own file layers =
  fromMaybe text (Formatter.format text)
  where
    text =
      Text.unlines
        ( ["-- From " <> file <> ".", "part " <> wordFrom "drawing" own]
            <> concat (snd (mapAccumL (layerText tolerance) Set.empty layers))
        )

-- | The lines of a layer, and the names in use after them: a table if it has several circles, and
-- nothing else, and no two of them have one centre within the tolerance.
layerText :: Mm -> Set Text -> (Text, [Outline]) -> (Set Text, [Text])
layerText tolerance used (layer, outlines) = case traverse circleWithLine outlines of
  Just circles@(_ : _ : _)
    | all (null . snd) (FromDrawing.withEarlier tolerance (\(Circle c _, _) -> c) circles) ->
      let name = fresh used base in (Set.insert name used, heading <> tableText name circles)
  _ ->
    let (used', texts) = mapAccumL one used (zip [1 :: Int ..] outlines)
     in (used', heading <> concat texts)
  where
    heading = "" : ["-- Layer " <> layer | not (Text.null layer)]
    base = wordFrom "outline" layer
    one names (k, o) =
      let wanted = if length outlines == 1 then base else base <> "_" <> Decimal.whole k
          name = fresh names wanted
       in (Set.insert name names, contourText name o)
    circleWithLine o = (,NonEmpty.head (parts o)) <$> FromDrawing.circleOf o

-- | A contour, with a line for each item.
contourText :: Text -> Outline -> [Text]
contourText name o =
  ["contour " <> name <> (if ends o == Polyarc.Closed then " closed {" else " open {")]
    <> commented [(entity p, itemText i) | (p, i) <- DrawnContour.items (const nowhere) Nothing o]
    <> ["}"]

-- | A table of circles.
tableText :: Text -> [(Circle, DrawnPart)] -> [Text]
tableText name circles =
  ["table " <> name <> " {", "x y diameter"]
    <> commented [(entity p, row c) | (c, p) <- circles]
    <> ["}"]
  where
    row (Circle c r) =
      let Mm d = times 2 r in Text.unwords (map sizeText [Vec.x c, Vec.y c, d])
    sizeText = expressionText . DrawnContour.size nowhere Nothing

-- | Lines of text, each first one of an entity with a comment that names it.
commented :: [(Entity, Text)] -> [Text]
commented list = zipWith line (Nothing : map (Just . fst) list) list
  where
    line before (e, text)
      | before == Just e = text
      | otherwise =
        text <> "  -- " <> Drawing.word e <> ", line " <> Decimal.whole (Drawing.line e)

itemText :: Item -> Text
itemText (Located _ i) = case i of
  Element sense e _ _ -> maybe "" senseText sense <> expressionText e
  _ -> ""
  where
    senseText (Located _ s) = case s of
      Clockwise -> "cw "
      CounterClockwise -> "ccw "

-- | The text of an expression of "Surface.DrawnContour".
expressionText :: Expr -> Text
expressionText (Located _ e) = case e of
  Literal n unit -> digits n <> maybe "" ((" " <>) . unitName) unit
  Variable (Name name) -> name
  Negate x -> "-" <> expressionText x
  Pair x y -> "(" <> expressionText x <> ", " <> expressionText y <> ")"
  List xs -> "[" <> series xs <> "]"
  Call (Located _ (Name f)) arguments ->
    f <> "(" <> series [x | Given x <- NonEmpty.toList arguments] <> ")"
  _ -> ""
  where
    series = Text.intercalate ", " . map expressionText

-- | A name from a text: signs that a name cannot have become underscores. @other@ stands before a
-- text that begins with no letter, and in place of an empty one.
wordFrom :: Text -> Text -> Text
wordFrom other text
  | Text.all (== '_') made = other
  | not (isAlpha (Text.head made)) || Keyword.isReserved made = other <> "_" <> made
  | otherwise = made
  where
    made = Text.map (\c -> if isAlphaNum c then c else '_') (Text.strip text)

-- | The name with a number if it is in use.
fresh :: Set Text -> Text -> Text
fresh used name = fromMaybe name (find (`Set.notMember` used) (name : map numbered [2 :: Int ..]))
  where
    numbered k = name <> "_" <> Decimal.whole k

nowhere :: Region
nowhere = Region 0 0
