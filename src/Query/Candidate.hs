-- | The points among which a choice such as @near@ chooses, with their coordinates.
--
-- The text at the cursor is usually not finished. So the choice is cut out of the text, and the
-- rest is evaluated: the evaluation then finds several answers, and these are the candidates.
module Query.Candidate
  ( candidates,
  )
where

import Base.Name (Name (..))
import Base.Region (Located (..), Region (..))
import Base.Region qualified as Region
import Base.Result (Result (..))
import Checked.FromSurface qualified as Checked
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Geometry.Carrier (Circle (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.ConstructionError (ConstructionFault (Several))
import Part.ContourError (ContourFault (..), LinkFault (AmbiguousMeeting), Neighbours (..))
import Part.Error (ValueFact (InConstruction, InContour))
import Part.Error qualified as Part
import Part.ErrorText (Candidate (..))
import Part.FromChecked qualified as Part
import Part.Part (Contour (..), Element (..), Part (contours))
import Project.LoadedProgram qualified as LoadedProgram
import Query.Cursor (Cursor (..), Level (..), Opening (..), isWord)
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Surface.Token (Token (..), Token_ (..))

-- | The candidates for the choice at the cursor: the text of each point, and a note about it. The
-- list is empty if the construction has only one answer, or cannot be evaluated.
candidates :: Snapshot -> Cursor -> [(Text, Text)]
candidates now cursor =
  [ ( Vec.toText (Snapshot.unit now) 4 p,
      "answer " <> Text.pack (show n) <> " of " <> Text.pack (show (length points))
    )
    | (n, p) <- zip [1 :: Int ..] points
  ]
  where
    text = Region.text (Snapshot.source now)
    points = concat (take 1 (filter (not . null) found))
    found = map (answers now) (probes text cursor) <> [corners now cursor]

-- | The points at which the contour of the machining statement around the cursor may begin.
corners :: Snapshot -> Cursor -> [Point]
corners now Cursor {levels} = case NonEmpty.toList levels of
  Level {opening = SettingsOf _} : Level {heads} : _ ->
    take
      mostCorners
      [ Segment.start (segment e)
        | Just part <- [Snapshot.part now],
          c <- contours part,
          let Located _ (Name name) = contourName c,
          any (`isWord` [name]) heads,
          e <- NonEmpty.toList (elements c),
          not (continues e)
      ]
  _ -> []

-- | The largest number of corners that are candidates.
mostCorners :: Int
mostCorners = 20

-- | A changed text, and the region of it in which the choice was.
data Probe = Probe Text Region

-- | The texts without the choice at the cursor.
probes :: Text -> Cursor -> [Probe]
probes text Cursor {levels = levels@(top NonEmpty.:| outer), typed = Region from to, following} =
  case (opening top, outer) of
    (CallOf _, parent : _) ->
      [ Probe
          (Text.take cut text <> uncurry (<>) closed)
          (Region (start (place callee)) (cut + 1))
        | Just cut <- [start . place <$> listToMaybe [t | t <- heads top, shape t == Symbol ","]],
          callee <- take 1 (drop 1 (heads parent))
      ]
    (Items, _) ->
      [ Probe (Text.take cut text <> Text.drop to text) (Region (max 0 (cut - 5)) (cut + 1))
        | Just cut <- [start . place <$> listToMaybe [t | t <- heads top, isWord t ["near"]]]
      ]
    _ -> []
  where
    -- The text from the closing parenthesis on. If the line does not have one, all brackets that
    -- the line has opened are closed.
    closed = case closerOf 0 following of
      Just at | not (Text.any isLineEnd (slice to at)) -> ("", Text.drop at text)
      _ ->
        ( Text.concat (closers (NonEmpty.toList levels)),
          Text.dropWhile (not . isLineEnd) (Text.drop from text)
        )
    slice a b = Text.take (b - a) (Text.drop a text)
    isLineEnd c = c == '\n' || c == '\r'

-- | The brackets that close the levels inside of the innermost braces.
closers :: [Level] -> [Text]
closers levels = case levels of
  l : rest -> case opening l of
    ListBracket -> "]" : closers rest
    CallOf _ -> ")" : closers rest
    CutterOf _ -> ")" : closers rest
    CipherOf _ -> ")" : closers rest
    Parameters -> ")" : closers rest
    Parenthesis -> ")" : closers rest
    File -> []
    Statements -> []
    Items -> []
    SettingsOf _ -> []
    TableLines -> []
  [] -> []

-- | The offset of the bracket that closes the level of the cursor. @depth@ is the count of brackets
-- opened since.
closerOf :: Int -> [Token] -> Maybe Int
closerOf depth tokens = case tokens of
  [] -> Nothing
  t : rest -> case shape t of
    Symbol s
      | s `elem` ["(", "[", "{"] -> closerOf (depth + 1) rest
      | s `elem` [")", "]", "}"] ->
        if depth == 0 then Just (start (place t)) else closerOf (depth - 1) rest
    _ -> closerOf depth rest

-- | The answers among which the text of a probe does not choose.
answers :: Snapshot -> Probe -> [Point]
answers now (Probe text (Region from to)) = case output (LoadedProgram.surface loaded) of
  Nothing -> []
  Just program -> case output (Checked.check program) of
    Nothing -> []
    Just checked ->
      concat
        [ points
          | Part.Error {Part.fact} <- errors (Part.evaluate checked),
            (Region a b, points) <- openChoice fact,
            a < to && b > from
        ]
  where
    loaded = Snapshot.reloaded now [] text

-- | The answers of a construction or a link that does not choose one, and its region.
openChoice :: ValueFact -> [(Region, [Point])]
openChoice fact = case fact of
  InConstruction (Several region _ found) -> [(region, concatMap pointOf found)]
  InContour (NotLinked Neighbours {link} (AmbiguousMeeting points)) -> [(link, points)]
  _ -> []
  where
    pointOf candidate = case candidate of
      APoint p -> [p]
      ACircle (Circle centre _) -> [centre]
      ALine _ -> []
