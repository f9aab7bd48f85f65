-- | Descriptions of whatever is at the cursor, in numbers: a contour, a link, a machining
-- statement, a machine, a name with its values, or a word of the language.
module Query.Description
  ( Description (..),
    description,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (Feed (..), LengthUnit, Mm (..))
import Base.Region (Located (Located), Region (Region))
import Base.Region qualified as Region
import Base.Result (Result (..))
import Checked.FromSurface qualified as Checked
import Control.Applicative ((<|>))
import Data.List (find)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (listToMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Frame.FeedCode qualified as FeedCode
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Part.ContourError (ContourFault (..), FittingFillets (..), LinkFault (..))
import Part.Error (ValueFact (..))
import Part.Error qualified as Part
import Part.FromChecked qualified as Part
import Part.Part (Contour (contourName, elements), Element (origin, segment), Part (contours))
import Project.LoadedProgram qualified as LoadedProgram
import Query.Machining (StatementSummary (duration, ownFrames, passes, path, statement))
import Query.Machining qualified as Machining
import Query.Manual (ManualEntry)
import Query.Manual qualified as Manual
import Query.Measurement qualified as Measurement
import Query.Name qualified as Name
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Surface.Lexer qualified as Lexer
import Surface.Syntax qualified as Surface
import Surface.SyntaxWalk qualified as SyntaxWalk
import Surface.Token (Token (..), Token_ (..))
import Surface.Token qualified as Token

-- | The description of a region: a title in the language of programs, facts as pairs of a name and
-- a value, and the entry of the manual.
data Description = Description
  { region :: Region,
    title :: Text,
    -- | what it is, in a few words
    sentence :: Text,
    -- | the values of a name
    values :: [Text],
    facts :: [(Text, Text)],
    entry :: Maybe ManualEntry
  }
  deriving stock (Eq, Show)

-- | Describes what is at the offset @at@ of the present text. @now@ is the snapshot of the present
-- text, and @before@ the last snapshot without errors. 'Nothing' if nothing is known of it.
description :: Snapshot -> Maybe Snapshot -> Int -> Maybe Description
description now before at = named now before at <|> (wordAt >>= described now at)
  where
    wordAt = find contains (fst (Lexer.tokens 0 (Region.text (Snapshot.source now))))
    contains t = let Region a b = place t in a <= at && at < b

-- | The description of a token that is no name of the program.
described :: Snapshot -> Int -> Token -> Maybe Description
described now at token = case shape token of
  Word w -> machine now token w <|> linkOf now token w <|> machiningOf now token w <|> plain w
  Number _ (Just unit)
    | name <- Token.unitName unit,
      at >= Region.end (place token) - Text.length name ->
      made (Region (Region.end (place token) - Text.length name) (Region.end (place token))) name
  Number _ _ -> Nothing
  _ -> Nothing
  where
    plain = made (place token)
    made region title =
      Manual.word title >>= \e ->
        Just Description {region, title, sentence = "", values = [], facts = [], entry = Just e}

-- Names

-- | The description of a name of the program or the language.
named :: Snapshot -> Maybe Snapshot -> Int -> Maybe Description
named now before at = shown <$> Name.hover now before at
  where
    shown h =
      Description
        { region = Name.place h,
          title = Name.name h,
          sentence = Name.meaning h,
          values = Name.values h,
          facts =
            several (Name.values h)
              <> maybe [] (Measurement.facts (Snapshot.unit now)) (contourAt h),
          entry = if Name.isBuiltIn h then Manual.function (Name.name h) else Nothing
        }
    several vs = case vs of
      _ : _ : _ ->
        [ ( "values",
            Text.intercalate ", " (take mostValues vs)
              <> (if length vs > mostValues then ", …" else "")
              <> " ("
              <> Decimal.whole (length vs)
              <> ")"
          )
        ]
      _ -> []
    contourAt h =
      listToMaybe
        [ c
          | snapshot <- now : maybe [] pure before,
            Just part <- [Snapshot.part snapshot],
            c <- contours part,
            Just (Region.region (contourName c)) == Name.definedAt h
        ]

-- | The largest number of values of a name that are listed.
mostValues :: Int
mostValues = 12

-- Links

-- | The description of the link with this keyword: its segment, and for a fillet the largest radius
-- that fits.
linkOf :: Snapshot -> Token -> Text -> Maybe Description
linkOf now token w
  | w `notElem` ["fillet", "chamfer", "tangent"] = Nothing
  | otherwise = do
    Located at link <- find ((== Region.start (place token)) . Region.start . Region.region) links
    part <- Snapshot.part now
    segment' <-
      listToMaybe
        [ segment e
          | c <- contours part,
            e <- NonEmpty.toList (elements c),
            origin e == at
        ]
    Just
      Description
        { region = place token,
          title = Text.unwords (concatMap Text.words (Region.linesIn (Snapshot.source now) at)),
          sentence = "",
          values = [],
          facts = Measurement.segmentFacts (Snapshot.unit now) segment' <> largest link,
          entry = Manual.word w
        }
  where
    links =
      [ l
        | s <- Surface.statements (Snapshot.program now),
          Located _ (Surface.Element _ _ _ (Just l)) <-
            concatMap SyntaxWalk.itemsOf (SyntaxWalk.statementsIn s)
      ]
    largest link = case link of
      Surface.Fillet e ->
        [ ("largest radius here", Decimal.inUnit (Snapshot.unit now) r)
          | Just r <- [largestFillet now (Region.region e)]
        ]
      _ -> []

-- | The largest radius of the fillet whose radius is written in this region. The compiler finds it
-- when the radius is much too large.
largestFillet :: Snapshot -> Region -> Maybe Mm
largestFillet now written = listToMaybe (concatMap (found . Part.fact) mistakes)
  where
    text = Region.text (Snapshot.source now)
    (from, to) = (Region.start written, Region.end written)
    old = Text.take (to - from) (Text.drop from text)
    sign = if "-" `Text.isPrefixOf` Text.strip old then "-" else ""
    probe = Text.take from text <> sign <> "100000 mm" <> Text.drop to text
    mistakes = case output (LoadedProgram.surface (Snapshot.reloaded now [] probe)) of
      Nothing -> []
      Just program -> case output (Checked.check program) of
        Nothing -> []
        Just checked -> errors (Part.evaluate checked)
    found fact = case fact of
      InContour (NotLinked _ (NoFillet _ _ (Just fitting) _)) -> here fitting
      InContour (Overrun _ _ _ _ (Just fitting)) -> here fitting
      _ -> []
    here (FittingFillets fillets) =
      [r | (place, _, r) <- fillets, Region.start place <= from, from <= Region.end place]

-- Machining

-- | The description of the machining statement that begins with this token.
machiningOf :: Snapshot -> Token -> Text -> Maybe Description
machiningOf now token w = do
  work <- find ((== Region.start (place token)) . Region.start . statement) summaries
  Just
    Description
      { region = place token,
        title = w,
        sentence = "",
        values = [],
        facts = workFacts (Snapshot.unit now) work,
        entry = Manual.word w
      }
  where
    summaries = case Snapshot.machines now of
      m : _ -> Machining.work m
      [] -> maybe [] (Machining.statements Nothing) (Snapshot.path now)

workFacts :: LengthUnit -> StatementSummary -> [(Text, Text)]
workFacts unit s =
  [("passes", Decimal.whole (passes s)) | passes s > 0]
    <> [("length", Decimal.inUnit unit (path s)), ("time", Measurement.time (duration s))]
    <> [("frames", Decimal.whole n) | Just n <- [ownFrames s]]

-- | The description of a machine whose name is at the token.
machine :: Snapshot -> Token -> Text -> Maybe Description
machine now token w = do
  _ <- find isNamed (Surface.statements (Snapshot.program now))
  m <- BuiltIn.find (MachineName w)
  Just
    Description
      { region = place token,
        title = "machine " <> w,
        sentence = "",
        values = [],
        facts = machineFacts m <> concatMap wholeFacts (Snapshot.machines now),
        entry = Manual.word "machine"
      }
  where
    isNamed s = case Region.value s of
      Surface.Machine (Located at _) -> at == place token
      _ -> False
    wholeFacts summary =
      [ ("frames of this program", Decimal.whole (Machining.frames summary)),
        ("time of this program", Measurement.time (Machining.time summary))
      ]

machineFacts :: Machine -> [(Text, Text)]
machineFacts m =
  [ ("pulse", Decimal.exact pulse <> " mm"),
    ("feeds", number low <> " to " <> number high <> " mm/min")
  ]
    <> [("rapid", number rapid <> " mm/min") | rapid > 0]
  where
    Mm pulse = Machine.planeResolution m
    (a, b) = Machine.feedRange m
    Feed low = FeedCode.feedAlongAxis m a
    Feed high = FeedCode.feedAlongAxis m b
    Feed rapid = FeedCode.rapidFeed m
    number = Decimal.short 2
