-- | Evaluates texts in a font: the contours of the outlines of their letters, and the region that
-- they bound. Equal letters, also those of several texts, are evaluated once, and then moved.
module Part.Lettering
  ( KnownLetters,
    evaluate,
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
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Semigroup (sconcat)
import Data.Vector qualified as Vector
import Drawing.Drawing (PathPart (Bezier))
import Drawing.PathPart qualified as PathPart
import Font.TextOutline (GlyphName, LetterShape (..))
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
import Part.Transformation qualified as PartTransformation
import Part.Value (Argument (Plain), Value (..))
import Part.Value qualified as Value

-- | Place of a text: the point to which it is aligned, and vectors along its line and from the feet
-- to the heads of its letters. The vectors belong to 1 mm of the shapes of the letters.
data LetterFrame = LetterFrame {anchor :: Point, along :: Vec, upward :: Vec}

-- | A letter: the contours of its outlines, and the region that they bound.
data EvaluatedLetter = EvaluatedLetter [Contour] PlaneRegion

-- | Letters of earlier texts, about their origins, by their glyphs and the vectors along their
-- lines.
type KnownLetters = Map (GlyphName, Vec) EvaluatedLetter

-- | Evaluates a text: all letters that are known then, the contours of its outlines, and their
-- region. The contours of the outlines have hidden names; those of the region have the name of the
-- text.
evaluate ::
  Environment ->
  KnownLetters ->
  Located Name ->
  TextPlace ->
  [LetterShape] ->
  Eval (KnownLetters, [Contour], PlaneRegion)
evaluate env before name place shapes = do
  frame <- frameOf env place
  (known, letters) <- foldlM (withShape name frame) (before, []) shapes
  let inOrder = map snd (sortOn fst letters)
      outlines = concat [contours | EvaluatedLetter contours _ <- inOrder]
  whole <- combined name Union [letter | EvaluatedLetter _ letter <- inOrder]
  pure (known, zipWith numbered [1 ..] outlines, whole)
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

-- | Adds the letters of one shape, each with its region in the program.
withShape ::
  Located Name ->
  LetterFrame ->
  (KnownLetters, [(Region, EvaluatedLetter)]) ->
  LetterShape ->
  Eval (KnownLetters, [(Region, EvaluatedLetter)])
withShape name frame (known, before) shape = do
  letter <- maybe (letterOf name frame shape) pure (Map.lookup key known)
  found <- traverse (placed name frame letter) (NonEmpty.toList (shapeLetters shape))
  pure (Map.insert key letter known, found <> before)
  where
    key = (shapeGlyph shape, along frame)

-- | A letter about its origin.
letterOf :: Located Name -> LetterFrame -> LetterShape -> Eval EvaluatedLetter
letterOf name frame shape = do
  contours <- traverse (outlineOf name frame at . fst) (shapeOutlines shape)
  Evaluation.spend at (sum (fmap (length . elements) contours))
  EvaluatedLetter (NonEmpty.toList contours)
    <$> filled name (NonEmpty.zip contours (fmap snd (shapeOutlines shape)))
  where
    Located at _ = NonEmpty.head (shapeLetters shape)

-- | A letter at its place on the line of a text. The contours of its outlines are moved when they
-- are drawn.
placed ::
  Located Name -> LetterFrame -> EvaluatedLetter -> Located Mm -> Eval (Region, EvaluatedLetter)
placed name frame (EvaluatedLetter contours letter) (Located at (Mm x)) = do
  let move = movedTo name at (Transformation.translation v)
      v = Vec.add (Value.offset (anchor frame)) (Vec.scale x (along frame))
      letter' = PlaneRegion.mapContours move letter
      elements' = concatMap (NonEmpty.toList . elements) (PlaneRegion.contoursOf letter')
  Evaluation.spend at (length elements')
  mapM_ (Value.within at . Vec.norm . Value.offset . Segment.end . segment) elements'
  pure (at, EvaluatedLetter (map move contours) letter')

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

-- | The image of a contour, at another place in the program, with another name. It stays the
-- contour of its written elements.
movedTo :: Located Name -> Region -> Transformation -> Contour -> Contour
movedTo name at t c =
  image
    { contourName = name,
      elements = fmap (\e -> e {origin = at}) (elements image),
      writtenElements = map written (writtenElements c)
    }
  where
    image = PartTransformation.image t c
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
