-- | Cutters that may be in the spindle in a frame.
module Verify.SpindleCutter
  ( cutters,
    cuttersOf,
  )
where

import Base.Region (Located (..))
import Data.Maybe (fromMaybe)
import Data.Vector qualified as Boxed
import Data.Vector.Unboxed qualified as Vector
import Part.Part (Cutter)
import Part.Part qualified as Part
import Toolpath.Toolpath (Toolpath)
import Toolpath.Toolpath qualified as Toolpath
import Verify.ProofSubject (ProofSubject (..))
import Verify.ProofSubject qualified as Subject
import Verify.SpindleTool qualified as SpindleTool

-- | Tools of a toolpath by their index, from 0; Nothing where the program gives none.
cutters :: Toolpath -> [Maybe Cutter]
cutters path =
  Toolpath.firstCutter (Toolpath.setup path) :
    [ Just c
      | Toolpath.Commanding (Located _ (Part.ChangeTool _ c)) <- Toolpath.blocks path
    ]

-- | Tools that may be in the spindle in a frame, by the number of the frame from 1, each with its
-- index. On a tape that does not show its tool, these are all tools.
cuttersOf :: ProofSubject -> Int -> [(Int, Cutter)]
cuttersOf subject@ProofSubject {path, program, frames}
  | Subject.isAligned subject = \n -> tool (fromMaybe 0 (planned Vector.!? (n - 1)))
  | Just indices <- SpindleTool.indicesByCommands program frames = concatMap tool . indices
  | otherwise = const (concatMap tool [0 .. Boxed.length all' - 1])
  where
    planned = SpindleTool.plannedIndices program
    all' = Boxed.fromList (cutters path)
    tool k = [(k, c) | Just (Just c) <- [all' Boxed.!? k]]
