-- | Evaluates engraved texts. Each stroke of a letter becomes a contour, on which the centre of the
-- cutter moves.
module Part.Engraving
  ( engraving,
  )
where

import Base.Crash (bug)
import Base.Name (Name (..))
import Base.Quantity (Mm (..), Rad (..), times)
import Base.Region (Located (..), Region (..))
import Checked.Syntax qualified as Checked
import Control.Monad (when)
import Data.Foldable (for_)
import Data.Map.Strict qualified as Map
import Data.Text (Text)
import Data.Text qualified as Text
import Font.BuiltIn qualified as BuiltIn
import Font.Font (Letter (..))
import Font.Lettering (BaseLine (..))
import Font.Lettering qualified as Lettering
import Geometry.Carrier (Circle (Circle))
import Geometry.Polyarc (Polyarc)
import Geometry.Polyarc qualified as Polyarc
import Geometry.Tolerance qualified as Tolerance
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Part.Carving qualified as Carving
import Part.EngravingError (CircleMisfit (..), EngravingMistake (..))
import Part.Error (CutterStatement (EngraveStatement), Error (..), ValueFact (InEngraving))
import Part.Evaluation (Eval)
import Part.Evaluation qualified as Evaluation
import Part.Expression (Environment)
import Part.Expression qualified as Expression
import Part.Machining (Context (..))
import Part.Machining qualified as Machining
import Part.Measure (lengthOf)
import Part.Parameter qualified as Parameter
import Part.Part
import Part.Value (Value (..))

-- | Evaluates the engraving of a text, which gives one milling for each stroke, in the order in
-- which they are cut. @at@ is the region of the statement.
engraving ::
  Context -> Region -> Checked.Engraving -> Checked.Settings -> Eval (Maybe [Milling])
engraving context at text settings = do
  Machining.checkCutter context at EngraveStatement
  letters <- lettersOf (Checked.engraved text)
  size <- lengthOf env Parameter.TextHeight (Checked.capitalHeight text)
  point <- Expression.point <$> Expression.evaluate env (Checked.anchor text)
  line <- baseLineOf env (region (Checked.anchor text)) point (Checked.textLine text)
  depthAt <-
    maybe (mistake (NoDepth (region (Checked.engraved text)))) (pure . fst) (Checked.depth settings)
  deep <- lengthOf env Parameter.Depth depthAt
  for_ (cutter context) (Carving.checkDepth (region depthAt) deep)
  checkRoom text line size (map snd letters)
  let laid = Lettering.layout line size (shareOf (Checked.textAlignment text)) (map snd letters)
      strokesOf = Lettering.inOrder point laid
      contours =
        [contourOf name s | ((name, _), ss) <- zip letters strokesOf, s <- ss]
  Evaluation.spend at (sum (map (length . elements) contours))
  let side = Located (region (Checked.engraved text)) On
  sequence <$> traverse (\c -> Machining.millingOf context Engraved at settings c side) contours
  where
    env = environment context

-- | The letters of a text with their names. Fails if a character has no letter, or if there is
-- nothing but spaces.
lettersOf :: Located Text -> Eval [(Located Name, Letter)]
lettersOf (Located whole content) = case unknown of
  [] | all (null . strokes . snd) found -> mistake (NothingToEngrave whole)
  [] -> pure found
  _ -> Evaluation.mistakes [Error (InEngraving (NoLetter r c)) [] [] | (r, c) <- unknown]
  where
    -- The text begins behind its quotation mark.
    places = [Region k (k + 1) | k <- [begin whole + 1 ..]]
    looked = [(r, c, Map.lookup c BuiltIn.letters) | (r, c) <- zip places (Text.unpack content)]
    found = [(Located r (Name (Text.singleton c)), l) | (r, c, Just l) <- looked]
    unknown = [(r, c) | (r, c, Nothing) <- looked]
    begin (Region from _) = from

-- | The line on which a text stands. @at@ is the region of the point of the text.
baseLineOf :: Environment -> Region -> Point -> Checked.TextLine -> Eval BaseLine
baseLineOf env at p line = case line of
  Checked.AlongX -> pure (StraightLine p (Rad 0))
  Checked.InDirection e ->
    StraightLine p . Rad . Expression.number <$> Expression.evaluate env e
  Checked.OnCircle e isInside -> do
    circle@(Circle centre _) <- circleOf <$> Expression.evaluate env e
    when (Vec.distance centre p <= Mm Tolerance.equal) (mistake (NoFit at AtCentre))
    let towards = Vec.angle (Vec.to centre p)
    pure (if isInside then WithinCircle circle towards else AroundCircle circle towards)

-- | Fails if a text goes more than once round its circle, or if the circle is too small for letters
-- inside it.
checkRoom :: Checked.Engraving -> BaseLine -> Mm -> [Letter] -> Eval ()
checkRoom text line size letters = case line of
  StraightLine _ _ -> pure ()
  AroundCircle circle _ -> fits circle
  WithinCircle circle@(Circle _ r) _ -> do
    when (size >= r) (mistake (NoFit (region (Checked.capitalHeight text)) (TooHigh size r)))
    fits circle
  where
    width' = Lettering.textWidth size letters
    fits circle = do
      let room = times (2 * pi) (Lettering.measuredRadius line size circle)
      when (width' > room) (mistake (NoFit (region (Checked.engraved text)) (TooLong width' room)))

-- | The part of the width of a text that lies before its point.
shareOf :: Checked.TextAlignment -> Double
shareOf alignment = case alignment of
  Checked.AlignLeft -> 0
  Checked.AlignCentre -> 0.5
  Checked.AlignRight -> 1

-- | The contour of a stroke. It has the name of its letter.
contourOf :: Located Name -> Polyarc -> Contour
contourOf name stroke =
  Contour
    { contourName = name,
      ends = Polyarc.ends stroke,
      elements = fmap element (Polyarc.segments stroke),
      breaks = [],
      writtenElements = []
    }
  where
    element segment =
      Element
        { segment,
          origin = region name,
          finish = plainFinish,
          continues = False,
          ofCurve = False,
          replaced = Nothing,
          bevel = Nothing
        }

circleOf :: Value -> Circle
circleOf v = case v of
  CircleValue c -> c
  _ -> bug "a value that is no circle where one was checked"

mistake :: EngravingMistake -> Eval a
mistake = Evaluation.mistake . InEngraving
