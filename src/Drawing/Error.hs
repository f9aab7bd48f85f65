{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Errors in the file of a drawing, with the line of the file, and their words. The caller adds
-- the place in the program that asks for the file.
module Drawing.Error
  ( Error (..),
    DrawingFault (..),
    Container (..),
    title,
    message,
    hints,
  )
where

import Data.Text (Text)
import Data.Text qualified as Text
import Drawing.Tolerance qualified as Tolerance

-- | An error in the file of a drawing.
data Error = Error
  { -- | number of the line of the file, from 1
    line :: Int,
    fault :: DrawingFault
  }
  deriving stock (Eq, Ord, Show)

-- | The fault of a file.
data DrawingFault
  = -- | a text that has to be a number: the text
    NotANumber Text
  | -- | an entity with a coordinate, a radius or an axis that is larger than the reach: its word
    OutOfReach Text
  | -- | more parts after all insertions than the limit
    TooManyParts
  | -- | the file contains a container that is not complete
    EndsEarly Container
  | -- | the binary form of DXF
    BinaryDxf
  | -- | a file of the format DWG: the six characters of its version
    DwgFile Text
  | -- | a text that has to be the code of a group of a DXF file: the text
    NotACode Text
  | -- | a word of a DXF file where it cannot be: the word
    Misplaced Text
  | -- | a value that an entity of a DXF file must have: the word of the entity and the code of the
    -- group
    ValueMissing Text Int
  | -- | neither the file nor the program gives the unit of length
    UnitMissing
  | -- | the number of a unit that the format does not have
    UnitUnknown Text
  | -- | the file gives one unit, the program another: the name or the size of each
    UnitConflict Text Text
  | -- | a name in a code page that the reader does not have: the code page
    CodePageUnknown Text
  | -- | a name whose bytes have no meaning in the encoding of the file: the encoding
    NotInEncoding Text
  | -- | an insertion of a block that the file does not have: the block
    BlockUnknown Text
  | -- | a block or an element that contains itself: the names on the way round
    Cycle [Text]
  | -- | blocks or elements within one another, deeper than the limit
    TooDeep
  | -- | a text that is not XML, with the reason
    NotXml Text
  | -- | a file of XML whose outermost element is not svg: the element
    NotSvg Text
  | -- | an attribute of an SVG element that cannot be read: the element, the attribute, the text
    -- where the mistake is
    WrongAttribute Text Text Text
  | -- | a reference of an SVG element to an identifier that the file does not have
    ReferenceUnknown Text
  deriving stock (Eq, Ord, Show)

-- | A thing that has to be complete in a file.
data Container
  = WholeFile
  | -- | a section of a DXF file
    OneSection
  | -- | the section of the entities
    EntitySection
  | -- | a block of a DXF file
    OneBlock
  | -- | the vertices of a POLYLINE or the attributes of an INSERT
    EntitySequence
  | -- | a group of a DXF file, which has a line for the code and one for the value
    Group
  deriving stock (Eq, Ord, Show)

-- | The title of an error: what is wrong, in a few words.
title :: Error -> Text
title e = case fault e of
  NotANumber _ -> "Not a number"
  OutOfReach _ -> "The drawing is too large"
  TooManyParts -> "The drawing has too many parts"
  EndsEarly _ -> "The file ends too early"
  BinaryDxf -> "The file is a binary DXF file"
  DwgFile _ -> "The file is a DWG file"
  NotACode _ -> "Not the code of a group of a DXF file"
  Misplaced _ -> "The file is out of order"
  ValueMissing _ _ -> "An entity is not complete"
  UnitMissing -> "The unit of the drawing is not known"
  UnitUnknown _ -> "The unit of the drawing is not known"
  UnitConflict _ _ -> "The file has another unit"
  CodePageUnknown _ -> "The code page of the file is not known"
  NotInEncoding _ -> "A name cannot be read"
  BlockUnknown _ -> "A block is missing"
  Cycle _ -> "The drawing contains itself"
  TooDeep -> "The drawing is nested too deeply"
  NotXml _ -> "The file is not XML"
  NotSvg _ -> "The file is not an SVG drawing"
  WrongAttribute {} -> "An attribute cannot be read"
  ReferenceUnknown _ -> "An element is missing"

-- | The facts of an error in one sentence, with the line of the file.
message :: Error -> Text
message Error {line, fault} = "Line " <> shown line <> ": " <> sentence fault

sentence :: DrawingFault -> Text
sentence fault = case fault of
  NotANumber text -> named text <> " has to be a number."
  OutOfReach word -> "the entity " <> word <> " has a coordinate or a radius of more than 1 km."
  TooManyParts ->
    "the entities and their points are more than " <> shown Tolerance.mostParts
      <> " after all insertions."
  EndsEarly container -> containerText container
  BinaryDxf -> "this is the binary form of DXF, which partc does not read."
  DwgFile version -> "this is a DWG file (" <> version <> "), which partc does not read."
  NotACode text -> named text <> " has to be a whole number, the code of a group."
  Misplaced word -> named word <> " cannot be here."
  ValueMissing word code -> "the entity " <> word <> " has no group " <> shown code <> "."
  UnitMissing -> "the file does not say in which unit its lengths are."
  UnitUnknown text -> named text <> " is not the number of a unit of length."
  UnitConflict inFile stated ->
    "the lengths of the file are in " <> inFile <> ", but the program says " <> stated <> "."
  CodePageUnknown page -> "this name is written in the code page " <> named page <> "."
  NotInEncoding encoding -> "the bytes of this name are not text in " <> encoding <> "."
  BlockUnknown name -> "the file has no block " <> named name <> "."
  Cycle names -> Text.intercalate " contains " (map named names) <> "."
  TooDeep ->
    "more than " <> shown Tolerance.mostNesting <> " blocks or elements are within one another."
  NotXml reason -> reason
  NotSvg name -> "the outermost element is " <> named name <> ", not svg."
  WrongAttribute element attribute text ->
    "in the element " <> element <> ", the attribute " <> attribute <> " cannot be read at "
      <> named text
      <> "."
  ReferenceUnknown name -> "the file has no element with the identifier " <> named name <> "."

containerText :: Container -> Text
containerText container = case container of
  WholeFile -> "the file ends without the word EOF."
  OneSection -> "the section that begins here has no end."
  EntitySection -> "the file has no section ENTITIES."
  OneBlock -> "the block that begins here has no end."
  EntitySequence -> "the entity that begins here has no SEQEND."
  Group -> "the file ends after the code of a group, without its value."

-- | Advice on an error, each a sentence.
hints :: Error -> [Text]
hints e = case fault e of
  NotANumber _ -> ["Save the drawing again; the file is damaged, or was edited by hand."]
  OutOfReach _ -> ["Check the unit of the file, and the scales of its insertions."]
  TooManyParts -> ["Save only what is to be machined, and explode arrays that are not needed."]
  EndsEarly _ -> ["Copy or save the file again; a part of it is missing."]
  BinaryDxf -> ["Save the drawing as DXF in the form of text (ASCII)."]
  DwgFile _ -> ["Save the drawing as DXF."]
  NotACode _ -> ["Check that the file is a DXF file; if it is, save it again."]
  Misplaced _ -> ["Save the drawing again; the file is damaged, or was edited by hand."]
  ValueMissing _ _ -> ["Save the drawing again; the file is damaged, or was edited by hand."]
  UnitMissing ->
    [ "State the unit: write unit mm or unit in after the file and the layer, or --unit for partc \
      \import."
    ]
  UnitUnknown _ -> ["Choose a unit of length for the drawing, and save it again."]
  UnitConflict _ _ -> ["Remove the unit from the program, or choose the right one in the file."]
  CodePageUnknown _ -> ["Save the drawing as DXF of 2007 or later, or name its layers in English."]
  NotInEncoding _ -> ["Save the drawing as DXF of 2007 or later, or name its layers in English."]
  BlockUnknown _ -> ["Save the drawing again, together with its blocks, or explode the insertion."]
  Cycle _ -> ["Save the drawing again; the file is damaged, or was edited by hand."]
  TooDeep -> ["Explode the blocks or groups, and save the drawing again."]
  NotXml _ -> ["Check that the file is an SVG file; if it is, save it again."]
  NotSvg _ -> ["Save the drawing as SVG."]
  WrongAttribute {} -> ["Save the drawing again; the file is damaged, or was edited by hand."]
  ReferenceUnknown _ -> ["Save the drawing again, and unlink clones."]

-- | A text of the file in quotes, shortened if it is long.
named :: Text -> Text
named text
  | Text.length text > Tolerance.mostNameLength =
    "‘" <> Text.take Tolerance.mostNameLength text <> "…’"
  | otherwise = "‘" <> text <> "’"

shown :: Int -> Text
shown = Text.pack . show
