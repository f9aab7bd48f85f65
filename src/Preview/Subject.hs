-- | Subject of the page: a program that is being edited, or a tape without its program.
module Preview.Subject
  ( Followed (..),
    Sound (..),
    ProgramState (..),
    TapeState (..),
    nothingYet,
    following,
    afterSnapshot,
    withText,
    withReports,
    soundSource,
  )
where

import Base.Name (Name)
import Base.Region (Located (value), Source)
import Base.Region qualified as Region
import Base.Result (Result (..))
import Checked.Dimension qualified as Dimension
import Checked.Type qualified as Type
import Compile (Analysis (Analysis, mentions))
import Compile qualified
import Data.Set qualified as Set
import Data.Text (Text)
import Geometry.Vec (Point)
import Machine.Machine (Machine)
import Part.Part (Part)
import Part.Part qualified as Part
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram
import Query.Mention (Mention, MentionType (OfValue))
import Query.Mention qualified as Mention
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Report.Report (Report)
import Tape.Tape (Tape)
import Toolpath.Toolpath (Toolpath)

-- | The present text with its mistakes, and the last state without errors.
data Followed = Followed
  { -- | number of the text; it grows with every change
    version :: Int,
    -- | file as the user named it
    fileName :: Text,
    -- | machine that the command line names
    chosenMachine :: Maybe Text,
    -- | present text, to which the reports refer
    presentSource :: Source,
    reports :: [Report],
    -- | last state without errors, and the version that it is of
    sound :: Maybe (Int, Sound)
  }

-- | State without errors, of which there is a picture.
data Sound = SoundProgram ProgramState | TapeAlone TapeState

-- | Program without errors.
data ProgramState = ProgramState
  { loaded :: LoadedProgram,
    part :: Part,
    path :: Toolpath,
    -- | points and centres of circles that the program defines by name
    points :: [(Name, Point)]
  }

-- | Tape or file of G-code without its program.
data TapeState = TapeState
  { tapeMachine :: Machine,
    -- | for a file of G-code, its frames as the description lays them out
    aloneTape :: Tape,
    -- | text of a file of G-code, and the line of each of its frames
    gcodeText :: Maybe (Text, [Int])
  }

-- | State before the first text was read.
nothingYet :: Text -> Maybe Text -> Followed
nothingYet fileName chosenMachine =
  Followed
    { version = 0,
      fileName,
      chosenMachine,
      presentSource = Region.fromText fileName "",
      reports = [],
      sound = Nothing
    }

-- | State after a change of the program: the picture changes if the text has no errors.
following :: [(Text, Text)] -> LoadedProgram -> Followed -> Followed
following values loaded before = withText (LoadedProgram.source loaded) reports now before
  where
    result = Compile.analyse values loaded
    reports = errors result <> warnings result
    now = case (errors result, output result) of
      ([], Just Analysis {mentions, Compile.part, Compile.path}) ->
        Just (soundProgram loaded mentions part path)
      _ -> Nothing

-- | State after a change of the program, of which there is a snapshot with the results of all
-- passes.
afterSnapshot :: LoadedProgram -> Snapshot -> Followed -> Followed
afterSnapshot loaded snapshot =
  withText (LoadedProgram.source loaded) (Snapshot.reports snapshot) now
  where
    now = case (Snapshot.isGood snapshot, Snapshot.part snapshot, Snapshot.path snapshot) of
      (True, Just part, Just path) ->
        Just (soundProgram loaded (Mention.mentions (Snapshot.facts snapshot)) part path)
      _ -> Nothing

soundProgram :: LoadedProgram -> [Mention] -> Part -> Toolpath -> Sound
soundProgram loaded mentions part path =
  SoundProgram
    ProgramState
      { loaded,
        part,
        path,
        points = [(value name, p) | (name, p) <- Part.namedPoints part, not (isVector name)]
      }
  where
    isVector name = Set.member (Region.region name) vectors
    vectors =
      Set.fromList
        [ Mention.place m
          | m <- mentions,
            OfValue (Type.Spatial d) <- [Mention.typing m],
            -- A pair of lengths may be both; it is shown as a point.
            d == Dimension.none
        ]

-- | State after a change: the new text, its reports, and the new picture if there is one.
withText :: Source -> [Report] -> Maybe Sound -> Followed -> Followed
withText presentSource reports now before =
  before
    { version = next,
      presentSource,
      reports,
      sound = maybe (sound before) (Just . (next,)) now
    }
  where
    next = version before + 1

-- | State after a change that gives no text, with the reports that say why.
withReports :: [Report] -> Followed -> Followed
withReports reports before = withText (presentSource before) reports Nothing before

-- | Text of the picture; the present text if there is no picture.
soundSource :: Followed -> Source
soundSource followed = case snd <$> sound followed of
  Just (SoundProgram state) -> LoadedProgram.source (loaded state)
  Just (TapeAlone _) -> presentSource followed
  Nothing -> presentSource followed
