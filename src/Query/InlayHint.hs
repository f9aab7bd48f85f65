-- | Short texts that an editor shows within a line: the units of numbers without a unit, the types
-- of definitions, and the radii of circles along which a contour leads.
module Query.InlayHint
  ( InlayHint (..),
    inlayHints,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name)
import Base.Quantity (LengthUnit)
import Base.Region (Located (..), Region (..))
import Checked.BareNumber qualified as BareNumber
import Checked.Type (Type)
import Checked.Type qualified as Type
import Data.List (sortOn)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Geometry.Segment qualified as Segment
import Part.Part qualified as Part
import Query.Mention qualified as Mention
import Query.Snapshot (Snapshot)
import Query.Snapshot qualified as Snapshot
import Surface.Syntax
import Surface.SyntaxWalk qualified as SyntaxWalk

-- | A text that is shown after the character before the offset.
data InlayHint = InlayHint {offset :: Int, text :: Text, isType :: Bool}
  deriving stock (Eq, Show)

-- | The hints in a region of the program's own text, in order.
inlayHints :: Snapshot -> Region -> [InlayHint]
inlayHints now (Region from to) =
  sortOn offset (filter isInside (types <> concatMap units inner <> radii))
  where
    isInside h = from <= offset h && offset h <= to
    inner = concatMap SyntaxWalk.statementsIn (statements (Snapshot.program now))
    typeAt = BareNumber.typesOfNames (Mention.mentions (Snapshot.facts now))
    types =
      [ InlayHint {offset = end at, text = ": " <> Type.describe t, isType = True}
        | Located _ s <- inner,
          Just (Located at _) <- [definedValue s],
          Just t <- [Map.lookup at typeAt]
      ]
    units s =
      [ InlayHint {offset = end (region e), text = unit, isType = False}
        | (e, t) <- BareNumber.bareNumbers typeAt s,
          Just unit <- [unitOf (Snapshot.unit now) t]
      ]
    radii =
      [ InlayHint
          { offset = end (region e),
            text =
              "radius "
                <> Decimal.inUnit (Snapshot.unit now) r,
            isType = False
          }
        | Located _ (Element (Just _) e _ _) <- concatMap SyntaxWalk.itemsOf inner,
          Just r <- [Map.lookup (region e) walked]
      ]
    walked =
      Map.fromList
        [ (Part.origin x, Segment.radius centre start')
          | Just part <- [Snapshot.part now],
            c <- Part.contours part,
            x <- NonEmpty.toList (Part.elements c),
            Segment.Arc {Segment.centre = centre, Segment.start = start'} <- [Part.segment x]
        ]

-- | The name of a value that a statement defines without saying its type.
definedValue :: Statement_ -> Maybe (Located Name)
definedValue s = case s of
  LetValue n _ -> Just n
  Param n _ -> Just n
  _ -> Nothing

-- | The unit of a number without a unit that has this type, in a file with this unit of lengths;
-- 'Nothing' for a plain number.
unitOf :: LengthUnit -> Type -> Maybe Text
unitOf unit t
  | t == Type.len = Just (Decimal.unitText unit)
  | t == Type.angle = Just "deg"
  | t == Type.feed = Just (Decimal.unitText unit <> "/min")
  | t == Type.spindleSpeed = Just "rpm"
  | otherwise = Nothing
