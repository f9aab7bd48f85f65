-- | Evaluates texts in a font: the contours of the outlines of their letters, and the region that
-- they bound. The outlines of equal letters are evaluated once, and then moved to each letter.
module Part.Lettering
  ( evaluate,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Name qualified as Name
import Base.Quantity (Mm (..), Rad (..), over)
import Base.Region (Located (..), Region)
import Checked.Syntax (Builtin (MakeBezier), TextPlace (..))
import Data.Foldable (foldlM)
import Data.List (sortOn)
import Data.List.NonEmpty (NonEmpty (..))
import Data.List.NonEmpty qualified as NonEmpty
import Data.Semigroup (sconcat)
import Data.Vector qualified as Vector
import Drawing.Drawing (PathPart (Bezier))
import Drawing.PathPart qualified as PathPart
import Font.TextOutline (LetterShape (..))
import Font.TextOutline qualified as TextOutline
import Geometry.ElementCarrier (ElementCarrier (..))
import Geometry.MeasuredPolyarc qualified as MeasuredPolyarc
import Geometry.Segment qualified as Segment
import Geometry.Transformation (Transformation)
import Geometry.Transformation qualified as Transformation
import Geometry.Vec (Point, Vec)
import Geometry.Vec qualified as Vec
import Offset.RegionBoolean (BooleanOperation (..))
import Part.Builtin qualified as Builtin
import Part.ContourElement qualified as ContourElement
import Part.Curve qualified as Curve
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression (Environment)
import Part.Expression qualified as Expression
import Part.Measure (lengthOf)
import Part.Parameter qualified as Parameter
import Part.Part (Contour (..), ContourElement (..), Element (..))
import Part.PlaneRegion (PlaneRegion (..))
import Part.PlaneRegion qualified as PlaneRegion
import Part.RegionBuiltin qualified as RegionBuiltin
import Part.Value (Argument (Plain), Value (..))
import Part.Value qualified as Value

-- | Place of a text: the point to which it is aligned, and vectors along its line and from the feet
-- to the heads of its letters. The vectors belong to 1 mm of the shapes of the letters.
data LetterFrame = LetterFrame {anchor :: Point, along :: Vec, upward :: Vec}

-- | A letter: the contours of its outlines, and the region that they bound.
data EvaluatedLetter = EvaluatedLetter [Contour] PlaneRegion

-- | Evaluates a text. The contours of its outlines have hidden names; those of the region have the
-- name of the text.
evaluate ::
  Environment -> Located Name -> TextPlace -> [LetterShape] -> Eval ([Contour], PlaneRegion)
evaluate env name place shapes = do
  frame <- frameOf env place
  letters <- concat <$> traverse (lettersOf name frame) shapes
  let inOrder = map snd (sortOn fst letters)
      outlines = concat [contours | EvaluatedLetter contours _ <- inOrder]
  whole <- combined name Union [letter | EvaluatedLetter _ letter <- inOrder]
  pure (zipWith numbered [1 ..] outlines, whole)
  where
    numbered k c = c {contourName = Located (region name) (hidden k)}
    hidden :: Int -> Name
    hidden k = Name.hidden (value name) (Decimal.whole k)

-- | Evaluates the place of a text.
frameOf :: Environment -> TextPlace -> Eval LetterFrame
frameOf env place = do
  size <- lengthOf env Parameter.TextHeight (textHeight place)
  anchor <- Expression.point <$> Expression.evaluate env (textPoint place)
  turned <-
    maybe (pure 0) (fmap Expression.number . Expression.evaluate env) (textDirection place)
  let scale = over size TextOutline.capitals
      unit = Vec.rotate (Rad turned)
  pure LetterFrame {anchor, along = unit (Vec.vec scale 0), upward = unit (Vec.vec 0 scale)}

-- | The letters of one shape, each with its region in the program.
lettersOf :: Located Name -> LetterFrame -> LetterShape -> Eval [(Region, EvaluatedLetter)]
lettersOf name frame (LetterShape letters outlines) = do
  contours <- traverse (outlineOf name frame at . fst) outlines
  Evaluation.spend at (sum (fmap (length . elements) contours))
  letter <- filled name (NonEmpty.zip contours (fmap snd outlines))
  traverse (placed (NonEmpty.toList contours) letter) (NonEmpty.toList letters)
  where
    Located at _ = NonEmpty.head letters
    placed contours letter (Located there (Mm x)) = do
      let v = Vec.add (Value.offset (anchor frame)) (Vec.scale x (along frame))
          move = movedTo there (Transformation.translation v)
          moved = map move contours
      Evaluation.spend there (length moved)
      mapM_
        (Value.within there . Vec.norm . Value.offset . Segment.end . segment)
        (concatMap (NonEmpty.toList . elements) moved)
      pure (there, EvaluatedLetter moved (PlaneRegion.mapContours move letter))

-- | The contour of an outline about the origin of its letter. @at@ is the region of the letter.
outlineOf :: Located Name -> LetterFrame -> Region -> NonEmpty PathPart -> Eval Contour
outlineOf name frame at path = do
  values <- traverse valuesOf path
  ContourElement.ofValues name (fmap (at,) (sconcat values))
  where
    valuesOf part = (point (PathPart.start part) :|) <$> curveOf part
    curveOf part = case part of
      Bezier controls _ ->
        let points = Vector.fromList (map point (NonEmpty.toList controls))
         in pure <$> Builtin.apply at MakeBezier [Plain (ListValue points)]
      _ -> pure []
    point p =
      Spatial (Vec.add (Vec.scale (Vec.x p) (along frame)) (Vec.scale (Vec.y p) (upward frame)))

-- | The region that contours bound, each with its depth as in 'shapeOutlines'.
filled :: Located Name -> NonEmpty (Contour, Int) -> Eval PlaneRegion
filled name contours = do
  regions <- traverse inside contours
  foldlM (level (NonEmpty.toList regions)) (PlaneRegion []) [0 .. maximum (fmap snd contours)]
  where
    inside (c, depth) = (depth,) <$> RegionBuiltin.settled (region name) (PlaneRegion.inside c)
    level regions lower depth =
      combined
        name
        (if odd depth then Difference else Union)
        (lower : [r | (d, r) <- regions, d == depth])

-- | The result of a boolean operation on regions, whose contours get the name of the text.
combined :: Located Name -> BooleanOperation -> [PlaneRegion] -> Eval PlaneRegion
combined name operation =
  RegionBuiltin.settled (region name) . PlaneRegion.combined name operation

-- | The image of a contour, at another place in the program. It stays the contour of its written
-- elements.
movedTo :: Region -> Transformation -> Contour -> Contour
movedTo at t c =
  c
    { elements = fmap moved (elements c),
      breaks = map (Transformation.point t) (breaks c),
      writtenElements = map written (writtenElements c)
    }
  where
    moved e = e {segment = Transformation.segment t (segment e), origin = at}
    written w =
      w
        { elementRegion = at,
          elementCarrier = carrier (elementCarrier w),
          elementCurve = Curve.transformed t <$> elementCurve w
        }
    carrier on = case on of
      OnLine l -> OnLine (Transformation.line t l)
      OnCircle sense o -> OnCircle sense (Transformation.circle t o)
      OnCurve p ->
        OnCurve (MeasuredPolyarc.fromSegments (Transformation.segment t <$> segmentsOf p))
      AtPoint p -> AtPoint (Transformation.point t p)
    segmentsOf = MeasuredPolyarc.segments
