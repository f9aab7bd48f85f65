-- | The parts of a DXF file that are the same in every drawing: tables, blocks and objects that
-- AutoCAD expects in a file of AC1015 (AutoCAD 2000). Autodesk, "DXF Reference", describes them.
module Export.DxfTable
  ( tables,
    blocks,
    classes,
    objects,
    modelSpace,
    groupDictionary,
    firstFree,
    section,
    dictionary,
  )
where

import Data.Text (Text)
import Export.CadDrawing (CadLayer (..))
import Export.CadDrawing qualified as CadDrawing
import Export.DxfGroup (DxfGroup, Handle (..), handle, integer, place, real, word)
import Geometry.Index.BoundingBox (BoundingBox (..))

-- | A section with its groups.
section :: Text -> [DxfGroup] -> [DxfGroup]
section title groups = [word 0 "SECTION", word 2 title] <> groups <> [word 0 "ENDSEC"]

-- Handles -----------------------------------------------------------------------------------------

-- | The record of the model space, which owns all entities.
modelSpace :: Handle
modelSpace = Handle 0x17

-- | The dictionary of the groups of entities.
groupDictionary :: Handle
groupDictionary = Handle 0x21

-- | The first handle that this module does not use.
firstFree :: Handle
firstFree = Handle 0x100

none, paperSpace, byLayerStyle, textStyle, root, layouts, multilines, plotSettings :: Handle
none = Handle 0
paperSpace = Handle 0x18
byLayerStyle = Handle 0x26
textStyle = Handle 0x14
root = Handle 0x20
layouts = Handle 0x22
multilines = Handle 0x23
plotSettings = Handle 0x24

plotStyles, modelLayout, paperLayout, multiline :: Handle
plotStyles = Handle 0x25
modelLayout = Handle 0x27
paperLayout = Handle 0x28
multiline = Handle 0x29

-- Tables ------------------------------------------------------------------------------------------

-- | The section of tables. The view is that of a box in the unit of the file.
tables :: BoundingBox -> [DxfGroup]
tables box =
  section
    "TABLES"
    ( concat
        [ table "VPORT" 1 [viewport box],
          table "LTYPE" 2 (zipWith lineType [0x11 ..] ["ByBlock", "ByLayer", "Continuous"]),
          table "LAYER" 3 (layerRecord 0x30 "0" 7 : zipWith layerOf [0x31 ..] [minBound ..]),
          table "STYLE" 4 [style],
          table "VIEW" 5 [],
          table "UCS" 6 [],
          table "APPID" 7 [record 7 "APPID" 0x15 "AcDbRegAppTableRecord" "ACAD" [integer 70 0]],
          table "DIMSTYLE" 8 [dimensionStyle],
          table
            "BLOCK_RECORD"
            9
            [ blockRecord modelSpace "*Model_Space" modelLayout,
              blockRecord paperSpace "*Paper_Space" paperLayout
            ]
        ]
    )
  where
    layerOf n layer = layerRecord n (CadDrawing.layerName layer) (colour layer)

-- | A table with its handle and its records.
table :: Text -> Int -> [[DxfGroup]] -> [DxfGroup]
table title own records =
  [word 0 "TABLE", word 2 title, handle 5 (Handle own), handle 330 none, word 100 "AcDbSymbolTable"]
    <> [integer 70 (length records)]
    <> concat
      [ [word 100 "AcDbDimStyleTable", integer 71 (length records)]
        | title == "DIMSTYLE"
      ]
    <> concat records
    <> [word 0 "ENDTAB"]

-- | A record: the handle of its table, its kind, its handle, its class, its name and the rest.
record :: Int -> Text -> Int -> Text -> Text -> [DxfGroup] -> [DxfGroup]
record owner title own class' name rest =
  [ word 0 title,
    handle (if title == "DIMSTYLE" then 105 else 5) (Handle own),
    handle 330 (Handle owner),
    word 100 "AcDbSymbolTableRecord",
    word 100 class',
    word 2 name
  ]
    <> rest

-- | The view of the model space: a little more than the box. The ratio of width and height is
-- that of a usual window.
viewport :: BoundingBox -> [DxfGroup]
viewport BoundingBox {left, bottom, right, top} =
  record 1 "VPORT" 0x10 "AcDbViewportTableRecord" "*ACTIVE" $
    [integer 70 0]
      <> pair 10 0 0
      <> pair 11 1 1
      <> pair 12 ((left + right) / 2) ((bottom + top) / 2)
      <> pair 13 0 0
      <> pair 14 10 10
      <> pair 15 10 10
      <> place 16 (0, 0, 1)
      <> place 17 (0, 0, 0)
      <> [real 40 height, real 41 aspect, real 42 50, real 43 0, real 44 0, real 50 0, real 51 0]
      <> [integer c n | (c, n) <- zip [71 .. 78] [0, 100, 1, 3, 0, 0, 0, 0]]
  where
    aspect = 1.5
    height = max 1 (1.1 * max (top - bottom) ((right - left) / aspect))
    pair code x y = [real code x, real (code + 10) y]

lineType :: Int -> Text -> [DxfGroup]
lineType own name =
  record
    2
    "LTYPE"
    own
    "AcDbLinetypeTableRecord"
    name
    [integer 70 0, word 3 "", integer 72 65, integer 73 0, real 40 0]

layerRecord :: Int -> Text -> Int -> [DxfGroup]
layerRecord own name ink =
  record
    3
    "LAYER"
    own
    "AcDbLayerTableRecord"
    name
    [integer 70 0, integer 62 ink, word 6 "Continuous", integer 370 (-3), handle 390 byLayerStyle]

-- | The colour of a layer in AutoCAD's colour index.
colour :: CadLayer -> Int
colour layer = case layer of
  PartLayer -> 7
  HoleLayer -> 4
  StockLayer -> 8
  ClampLayer -> 1
  CutLayer -> 5
  LinkLayer -> 3
  RapidLayer -> 6
  NodeLayer -> 30

style :: [DxfGroup]
style =
  record 4 "STYLE" 0x14 "AcDbTextStyleTableRecord" "Standard" $
    [integer 70 0, real 40 0, real 41 1, real 50 0, integer 71 0, real 42 2]
      <> [word 3 "txt", word 4 ""]

dimensionStyle :: [DxfGroup]
dimensionStyle =
  record 8 "DIMSTYLE" 0x16 "AcDbDimStyleTableRecord" "Standard" [integer 70 0, handle 340 textStyle]

blockRecord :: Handle -> Text -> Handle -> [DxfGroup]
blockRecord (Handle own) name shownOn =
  record 9 "BLOCK_RECORD" own "AcDbBlockTableRecord" name [handle 340 shownOn]

-- Blocks ------------------------------------------------------------------------------------------

-- | The section of blocks: the empty blocks of the model space and of the paper space.
blocks :: [DxfGroup]
blocks =
  section
    "BLOCKS"
    (block modelSpace "*Model_Space" 0x19 [] <> block paperSpace "*Paper_Space" 0x1B [integer 67 1])

block :: Handle -> Text -> Int -> [DxfGroup] -> [DxfGroup]
block owner name own onPaper =
  part "BLOCK" own
    <> [word 100 "AcDbBlockBegin", word 2 name, integer 70 0]
    <> place 10 (0, 0, 0)
    <> [word 3 name, word 1 ""]
    <> part "ENDBLK" (own + 1)
    <> [word 100 "AcDbBlockEnd"]
  where
    part title n =
      [word 0 title, handle 5 (Handle n), handle 330 owner, word 100 "AcDbEntity"]
        <> onPaper
        <> [word 8 "0"]

-- Classes and objects -----------------------------------------------------------------------------

-- | The section of classes: those of the objects that are not built into AutoCAD.
classes :: [DxfGroup]
classes =
  section
    "CLASSES"
    ( concatMap
        class'
        [ ("ACDBDICTIONARYWDFLT", "AcDbDictionaryWithDefault"),
          ("ACDBPLACEHOLDER", "AcDbPlaceHolder"),
          ("LAYOUT", "AcDbLayout")
        ]
    )
  where
    class' (name, inCode) =
      [word 0 "CLASS", word 1 name, word 2 inCode, word 3 "ObjectDBX Classes"]
        <> [integer 90 0, integer 280 0, integer 281 0]

-- | The section of objects. The groups of entities are given: the objects, and the names with the
-- handles for their dictionary.
objects :: [DxfGroup] -> [(DxfGroup, Handle)] -> [DxfGroup]
objects groups named =
  section
    "OBJECTS"
    ( dictionary
        root
        none
        [ (word 3 "ACAD_GROUP", groupDictionary),
          (word 3 "ACAD_LAYOUT", layouts),
          (word 3 "ACAD_MLINESTYLE", multilines),
          (word 3 "ACAD_PLOTSETTINGS", plotSettings),
          (word 3 "ACAD_PLOTSTYLENAME", plotStyles)
        ]
        <> dictionary groupDictionary root named
        <> dictionary layouts root [(word 3 "Model", modelLayout), (word 3 "Layout1", paperLayout)]
        <> dictionary multilines root [(word 3 "Standard", multiline)]
        <> dictionary plotSettings root []
        <> plotStyleDictionary
        <> layout modelLayout "Model" modelSpace 0
        <> layout paperLayout "Layout1" paperSpace 1
        <> multilineStyle
        <> groups
    )

-- | A dictionary: its handle, that of its owner, and its entries.
dictionary :: Handle -> Handle -> [(DxfGroup, Handle)] -> [DxfGroup]
dictionary own owner entries =
  [word 0 "DICTIONARY", handle 5 own, handle 330 owner, word 100 "AcDbDictionary", integer 281 1]
    <> concat [[name, handle 350 to] | (name, to) <- entries]

-- | The dictionary of plot styles with its only style.
plotStyleDictionary :: [DxfGroup]
plotStyleDictionary =
  [word 0 "ACDBDICTIONARYWDFLT", handle 5 plotStyles, handle 330 root]
    <> [word 100 "AcDbDictionary", integer 281 1, word 3 "Normal", handle 350 byLayerStyle]
    <> [word 100 "AcDbDictionaryWithDefault", handle 340 byLayerStyle]
    <> [word 0 "ACDBPLACEHOLDER", handle 5 byLayerStyle, handle 330 plotStyles]

-- | A layout on A4, by its number among the tabs of the window.
layout :: Handle -> Text -> Handle -> Int -> [DxfGroup]
layout own name space number =
  [word 0 "LAYOUT", handle 5 own, handle 330 layouts, word 100 "AcDbPlotSettings"]
    <> [word 1 "", word 2 "none_device", word 4 "", word 6 ""]
    <> [real c x | (c, x) <- zip [40 .. 49] [7.5, 20, 7.5, 20, 210, 297, 0, 0, 0, 0]]
    <> [real 140 0, real 141 0, real 142 1, real 143 1]
    <> [integer 70 (if number == 0 then 1712 else 688)]
    <> [integer 72 1, integer 73 0, integer 74 5, word 7 "", integer 75 16]
    <> [real 147 1, real 148 0, real 149 0, word 100 "AcDbLayout", word 1 name]
    <> [integer 70 1, integer 71 number]
    <> [real 10 0, real 20 0, real 11 210, real 21 297]
    <> concat [place c p | (c, p) <- zip [12, 14, 15, 13, 16, 17] frame]
    <> [real 146 0, integer 76 0, handle 330 space]
  where
    frame = [(0, 0, 0), (0, 0, 0), (210, 297, 0), (0, 0, 0), (1, 0, 0), (0, 1, 0)]

multilineStyle :: [DxfGroup]
multilineStyle =
  [word 0 "MLINESTYLE", handle 5 multiline, handle 330 multilines, word 100 "AcDbMlineStyle"]
    <> [word 2 "Standard", integer 70 0, word 3 "", integer 62 256, real 51 90, real 52 90]
    <> [integer 71 2]
    <> concat [[real 49 x, integer 62 256, word 6 "ByLayer"] | x <- [0.5, -0.5]]
