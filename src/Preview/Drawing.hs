-- | Part and toolpath as flat arrays for the page. The README of this folder describes them.
module Preview.Drawing
  ( container,
  )
where

import Base.Name (Name)
import Base.Name qualified as Name
import Base.Quantity (Feed (..), LengthUnit (..), Mm (..), Rad (..))
import Base.Region (Located (..), Region)
import Base.Region qualified as Region
import Control.Applicative ((<|>))
import Data.Aeson (Value, object, (.=))
import Data.Aeson.Types (Pair)
import Data.ByteString.Lazy (ByteString)
import Data.List qualified as List
import Data.List.NonEmpty qualified as NonEmpty
import Data.Maybe (fromMaybe, isJust, maybeToList)
import Data.Text (Text)
import Draw.FromPart qualified as Draw
import Draw.Scene qualified as Scene
import Draw.ToolUse (ToolUse)
import Draw.ToolUse qualified as ToolUse
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Machine.BuiltIn qualified as BuiltIn
import Machine.Machine (Machine, MachineName (..))
import Machine.Machine qualified as Machine
import Part.CutFeed qualified as CutFeed
import Part.Part (Part)
import Part.Part qualified as Part
import Preview.Container (Numbers (..))
import Preview.Container qualified as Container
import Preview.ReportList (FileLines)
import Preview.ReportList qualified as ReportList
import Preview.Subject
import Project.LoadedProgram (LoadedProgram (source))
import Project.MachineDescription qualified as MachineDescription
import Surface.Syntax qualified as Surface
import Toolpath.Toolpath (Block (..), Move, Toolpath)
import Toolpath.Toolpath qualified as Toolpath

-- | Answer to the request @drawing@. The flag is true if the page can move the cursor of an editor.
container :: Bool -> Followed -> ByteString
container hasEditor followed = Container.encode (common <> subject) columns
  where
    (subject, columns) = case snd <$> sound followed of
      Just (SoundProgram state) -> programDrawing (chosenMachine followed) state
      Just (TapeAlone state) -> (withoutPart "tape" name (Just (tapeMachine state)), [])
      Nothing -> (withoutPart "program" name Nothing, [])
    name = fileName followed
    common =
      [ "version" .= version followed,
        "reports"
          .= ReportList.reportList name (presentSource followed) (reports followed),
        "presentFiles" .= ReportList.fileList (presentSource followed),
        "present" .= (fmap fst (sound followed) == Just (version followed)),
        "name" .= name,
        "editor" .= hasEditor
      ]

-- | Members of the header without a part: the kind of the subject, its title, and its machine if
-- there is a picture of its frames.
withoutPart :: Text -> Text -> Maybe Machine -> [Pair]
withoutPart kind title machine =
  [ "kind" .= kind,
    "drawn" .= isJust machine,
    "title" .= title,
    "unit" .= unitName Millimetres,
    "turned" .= False,
    "files" .= none,
    "machines" .= map machineEntry (maybeToList machine),
    "machine" .= fmap nameOf machine,
    "tools" .= none,
    "points" .= none,
    "contours" .= none,
    "extents" .= (Nothing :: Maybe Value)
  ]
  where
    none = [] :: [Value]

-- | Members of the header and arrays of a program. The first argument is the machine that the
-- command line names.
programDrawing :: Maybe Text -> ProgramState -> ([Pair], [(Text, Numbers)])
programDrawing chosen ProgramState {loaded, part, path, points} =
  ( [ "kind" .= ("program" :: Text),
      "drawn" .= True,
      "title" .= titleOf part,
      "unit" .= unitName (Toolpath.unit path),
      "turned" .= Toolpath.isTurned path,
      "files" .= ReportList.fileList (source loaded),
      "machines"
        .= (map machineEntry BuiltIn.machines <> map describedEntry (describedFiles chosen part)),
      "machine" .= (chosen <|> fmap (referenceName . value) (Part.machine part)),
      "tools" .= map toolEntry (ToolUse.uses path),
      "points" .= map pointEntry points,
      "contours" .= zipWith (contourEntry known) starts shapes,
      "extents" .= extents shapes path
    ],
    [ ("contour", Reals (concatMap (segmentNumbers . Part.segment) elements)),
      ("contourPlace", Wholes (concatMap (placeNumbers known . Part.origin) elements)),
      ("hole", Reals (concatMap holeNumbers (Part.operations part))),
      ("rest", Reals (concatMap segmentNumbers restSegments)),
      ("move", Reals (concatMap (moveNumbers . moveDrawn) moves)),
      ("moveInfo", Wholes (concatMap (moveInfo known) moves)),
      ("moveFeed", Reals (map (feedOf . moveDrawn) moves))
    ]
  )
  where
    known = ReportList.fileLines (source loaded)
    restSegments = concatMap Scene.around (Draw.restMaterialOf path)
    shapes = Draw.sidedContours part
    elements = concatMap (\(c, _, _) -> NonEmpty.toList (Part.elements c)) shapes
    starts = scanl (+) 0 (map (\(c, _, _) -> NonEmpty.length (Part.elements c)) shapes)
    moves = movesOf path

titleOf :: Part -> Text
titleOf part = fromMaybe (maybe "" Name.text (Part.name part)) (Part.title part)

unitName :: LengthUnit -> Text
unitName unit = case unit of
  Millimetres -> "mm"
  Inches -> "inch"

-- Machines ----------------------------------------------------------------------------------------

machineEntry :: Machine -> Value
machineEntry machine = object ["name" .= nameOf machine, "title" .= Machine.title machine]

nameOf :: Machine -> Text
nameOf machine = let MachineName name = Machine.name machine in name

-- | Files of descriptions that the command line and the program name.
describedFiles :: Maybe Text -> Part -> [Text]
describedFiles chosen part =
  List.nub
    ( filter MachineDescription.isFileName (maybeToList chosen)
        <> [file | Just (Surface.Described file) <- [value <$> Part.machine part]]
    )

describedEntry :: Text -> Value
describedEntry file = object ["name" .= file, "title" .= file]

referenceName :: Surface.MachineRef -> Text
referenceName reference = case reference of
  Surface.Named name -> name
  Surface.Described file -> file

-- Tools -------------------------------------------------------------------------------------------

toolEntry :: ToolUse -> Value
toolEntry tool =
  object
    [ "kind" .= kindName (Part.kind cutter),
      "radius" .= radius,
      "number" .= ToolUse.number tool
    ]
  where
    cutter = ToolUse.cutter tool
    -- The path of a V-bit is as wide as its tip, and wider above.
    Mm radius = case Part.kind cutter of
      Part.VBitCutter -> Part.tipRadius cutter
      _ -> Part.cutterRadius cutter

kindName :: Part.CutterKind -> Text
kindName kind = case kind of
  Part.MillingCutter -> "mill"
  Part.ConeCutter -> "cone"
  Part.VBitCutter -> "V-bit"
  Part.DovetailCutter -> "dovetail"
  Part.BladeCutter _ -> "blade"
  Part.DrillingCutter -> "drill"
  Part.TappingCutter -> "tap"
  Part.ThreadCutter _ -> "thread mill"
  Part.TurningCutter -> "turning"

-- Points and contours -----------------------------------------------------------------------------

pointEntry :: (Name, Point) -> Value
pointEntry (name, p) = object ["name" .= Name.text name, "x" .= Vec.x p, "y" .= Vec.y p]

-- | Entry of a contour whose first segment has an index.
contourEntry :: FileLines -> Int -> (Part.Contour, Scene.MaterialSide, Mm) -> Value
contourEntry known from (contour, side, Mm depth) =
  object
    [ "name" .= Name.text (value (Part.contourName contour)),
      "closed" .= (Part.ends contour == Polyarc.Closed),
      "from" .= from,
      "count" .= NonEmpty.length (Part.elements contour),
      "file" .= file,
      "line" .= line,
      "side" .= sideName side,
      "depth" .= depth
    ]
  where
    (file, line) = ReportList.lineOf known (Region.region (Part.contourName contour))

sideName :: Scene.MaterialSide -> Text
sideName side = case side of
  Scene.Inside -> "inside"
  Scene.Outside -> "outside"
  Scene.Unknown -> "unknown"

holeNumbers :: Part.Operation -> [Double]
holeNumbers operation = case operation of
  Part.Drill (Located _ drilling) ->
    concat
      [ [Vec.x centre, Vec.y centre, radius, bottom]
        | Part.Hole (Located _ centre) (Mm bottom) (Mm radius) <-
            NonEmpty.toList (Part.holes drilling)
      ]
  _ -> []

-- Moves -------------------------------------------------------------------------------------------

-- | Move with what the page tells of it.
data DrawnMove = DrawnMove
  { moveDrawn :: Move,
    isCut :: Bool,
    -- | index of the tool, or −1
    tool :: Int,
    isInLastPass :: Bool
  }

movesOf :: Toolpath -> [DrawnMove]
movesOf path = concatMap ofBlock (ToolUse.blocksWithTools path)
  where
    isFinal = Draw.isLastPass path
    ofBlock (used, block) = movesWith (fromMaybe (-1) used) block
    movesWith tool block = case block of
      Commanding _ -> []
      Travelling _ _ moves -> map (linking tool True) moves
      Holing _ moves -> map (worked tool) moves
      Carved _ moves _ -> map (worked tool) (NonEmpty.toList moves)
      Cutting {pass, approach, descent, cut, retract} ->
        let isLast = isFinal pass
         in map (linking tool isLast) (approach <> descent)
              <> [DrawnMove m True tool isLast | m <- NonEmpty.toList cut]
              <> map (linking tool isLast) retract
      Clearing {approach, cleared, retract} ->
        map (linking tool True) approach
          <> [DrawnMove m (Draw.isCut m) tool True | m <- NonEmpty.toList cleared]
          <> map (linking tool True) retract
    worked tool m = DrawnMove m (Toolpath.pace m /= Part.Rapid) tool True
    linking tool isLast m = DrawnMove m False tool isLast

-- | The seven numbers of a segment.
segmentNumbers :: Segment -> [Double]
segmentNumbers s = case s of
  Straight a b -> [Vec.x a, Vec.y a, Vec.x b, Vec.y b, 0, 0, 0]
  Arc {start = a, end = b, centre = c, sweep = Rad turn} ->
    [Vec.x a, Vec.y a, Vec.x b, Vec.y b, Vec.x c, Vec.y c, turn]

moveNumbers :: Move -> [Double]
moveNumbers m = segmentNumbers (Toolpath.segment m) <> [from, to]
  where
    (Mm from, Mm to) = Toolpath.heights m

moveInfo :: FileLines -> DrawnMove -> [Int]
moveInfo known d = [kind, tool d, file, line, fromEnum (isInLastPass d)]
  where
    m = moveDrawn d
    (file, line) = ReportList.lineOf known (Toolpath.origin m)
    kind
      | Toolpath.pace m == Part.Rapid = 0
      | isCut d = 2
      | otherwise = 1

-- | Mean feed of a move in mm\/min; 0 for a rapid move, or if it is not known.
feedOf :: Move -> Double
feedOf m = case Toolpath.pace m of
  Part.Rapid -> 0
  Part.At (Located _ feed) ->
    maybe 0 (\(Feed v) -> v) (CutFeed.perMinuteAlong (Toolpath.segment m) feed)

-- | Extents of contours and moves along x, y and z; Nothing without any.
extents :: [(Part.Contour, Scene.MaterialSide, Mm)] -> Toolpath -> Maybe [[Double]]
extents shapes path = case map BoundingBox.ofSegment segments of
  [] -> Nothing
  b : bs ->
    let BoundingBox left bottom right top = List.foldl' BoundingBox.union b bs
     in Just [[left, right], [bottom, top], [minimum heights, maximum heights]]
  where
    segments =
      [Part.segment e | (c, _, _) <- shapes, e <- NonEmpty.toList (Part.elements c)]
        <> map Toolpath.segment moves
    moves = concatMap Toolpath.moves (Toolpath.blocks path)
    heights = 0 : [z | m <- moves, let (Mm a, Mm b) = Toolpath.heights m, z <- [a, b]]

placeNumbers :: FileLines -> Region -> [Int]
placeNumbers known region = let (file, line) = ReportList.lineOf known region in [file, line]
