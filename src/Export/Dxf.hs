-- | DXF files in the text form of AC1015 (AutoCAD 2000), with coordinates in the unit of the
-- program. Each contour of the part is a group of entities with the contour's name.
module Export.Dxf
  ( document,
  )
where

import Base.Quantity (LengthUnit (..))
import Data.List (mapAccumL)
import Data.Maybe (fromMaybe, mapMaybe)
import Data.Text (Text)
import Export.CadDrawing (CadDrawing (..), CadForm (..), CadLayer (..), CadObject (..))
import Export.CadDrawing qualified as CadDrawing
import Export.Coordinate qualified as Coordinate
import Export.DxfEntity (DxfEntity (..))
import Export.DxfEntity qualified as DxfEntity
import Export.DxfGroup (DxfGroup, Handle (..), handle, integer, place, real, word)
import Export.DxfGroup qualified as DxfGroup
import Export.DxfTable qualified as DxfTable
import Export.UniqueName qualified as UniqueName
import Geometry.Index.BoundingBox (BoundingBox (..))

-- | An object with its group, if it has one, and its entities with their handles.
data Numbered = Numbered {group :: Maybe (Text, Handle), numbered :: [(Handle, DxfEntity)]}

-- | The text of a file.
document :: CadDrawing -> Text
document drawing@CadDrawing {unit} =
  DxfGroup.render
    ( header unit box next
        <> DxfTable.classes
        <> DxfTable.tables box
        <> DxfTable.blocks
        <> DxfTable.section "ENTITIES" (concatMap entityGroups things)
        <> DxfTable.objects
          (concatMap groupObject things)
          [(DxfGroup.name 3 title, own) | Numbered {group = Just (title, own)} <- things]
        <> [word 0 "EOF"]
    )
  where
    (next, things) = withHandles drawing
    box = scaled (fromMaybe (BoundingBox 0 0 0 0) (CadDrawing.extent (objects drawing)))
    scaled (BoundingBox l b r t) = BoundingBox (s l) (s b) (s r) (s t)
    s = Coordinate.inUnit unit

-- | The objects of a drawing with handles, and the first handle that is free. An object with a name
-- gets a group, whose name is unique in the file.
withHandles :: CadDrawing -> (Handle, [Numbered])
withHandles CadDrawing {unit, objects} =
  mapAccumL number DxfTable.firstFree (named (titles objects) objects)
  where
    number free (title, object) =
      let (afterGroup, group) = case title of
            Just t -> (succ free, Just (t, free))
            Nothing -> (free, Nothing)
          entities = DxfEntity.entities unit object
          handles = take (length entities) (iterate succ afterGroup)
       in (advanced (length entities) afterGroup, Numbered {group, numbered = zip handles entities})
    advanced n (Handle k) = Handle (k + n)

-- | The names of the contours of the part, made unique.
titles :: [CadObject] -> [Text]
titles things = UniqueName.distinguished [] (mapMaybe groupTitle things)

-- | The name of an object that gets a group: a contour of the part.
groupTitle :: CadObject -> Maybe Text
groupTitle CadObject {layer, form} = case (layer, form) of
  (PartLayer, Outline t _ _ _) -> Just t
  _ -> Nothing

-- | The objects, those that get a group with one title after the other.
named :: [Text] -> [CadObject] -> [(Maybe Text, CadObject)]
named unused things = case things of
  [] -> []
  thing : more -> case (groupTitle thing, unused) of
    (Just _, t : ts) -> (Just t, thing) : named ts more
    _ -> (Nothing, thing) : named unused more

-- | The groups of the entities of an object.
entityGroups :: Numbered -> [DxfGroup]
entityGroups Numbered {group, numbered} =
  concat
    [ [word 0 kind, handle 5 own]
        <> reactors
        <> [handle 330 DxfTable.modelSpace, word 100 "AcDbEntity"]
        <> [word 8 (CadDrawing.layerName onLayer)]
        <> groups
      | (own, DxfEntity {kind, onLayer, groups}) <- numbered
    ]
  where
    -- An entity names the group to which it belongs.
    reactors =
      concat
        [[word 102 "{ACAD_REACTORS", handle 330 own, word 102 "}"] | Just (_, own) <- [group]]

-- | The object that makes a group of the entities of an object with a name. A click on one of them
-- selects all.
groupObject :: Numbered -> [DxfGroup]
groupObject Numbered {group, numbered} = case group of
  Nothing -> []
  Just (_, own) ->
    [word 0 "GROUP", handle 5 own, handle 330 DxfTable.groupDictionary, word 100 "AcDbGroup"]
      <> [word 300 "", integer 70 0, integer 71 1]
      <> [handle 340 entity | (entity, _) <- numbered]

-- | The section with the settings of the drawing. Points are shown as circles with a cross, of a
-- diameter of 1 mm.
header :: LengthUnit -> BoundingBox -> Handle -> [DxfGroup]
header unit BoundingBox {left, bottom, right, top} next =
  DxfTable.section "HEADER" $
    concat
      [ setting "$ACADVER" [word 1 "AC1015"],
        setting "$DWGCODEPAGE" [word 3 "ANSI_1252"],
        setting "$INSBASE" (place 10 (0, 0, 0)),
        setting "$EXTMIN" (place 10 (left, bottom, 0)),
        setting "$EXTMAX" (place 10 (right, top, 0)),
        setting "$LIMMIN" [real 10 left, real 20 bottom],
        setting "$LIMMAX" [real 10 right, real 20 top],
        setting "$CLAYER" [word 8 "0"],
        setting "$TEXTSTYLE" [word 7 "Standard"],
        setting "$LUNITS" [integer 70 2],
        setting "$LUPREC" [integer 70 4],
        setting "$PDMODE" [integer 70 34],
        setting "$PDSIZE" [real 40 (Coordinate.inUnit unit 1)],
        setting "$MEASUREMENT" [integer 70 (case unit of Millimetres -> 1; Inches -> 0)],
        setting "$INSUNITS" [integer 70 (case unit of Millimetres -> 4; Inches -> 1)],
        setting "$EXTNAMES" [integer 290 1],
        setting "$HANDSEED" [handle 5 next]
      ]
  where
    setting name values = word 9 name : values
