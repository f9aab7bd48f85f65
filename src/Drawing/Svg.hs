-- | The reader of SVG files.
--
-- It reads path, rect, circle, ellipse, line, polyline and polygon, in groups, symbols and nested
-- areas with all their transforms. Style sheets are not read, only attributes and their styles. On
-- text and images the drawing has a remark.
module Drawing.Svg
  ( fromSvg,
  )
where

import Base.Quantity (LengthUnit)
import Data.Bifunctor (first)
import Data.ByteString (ByteString)
import Data.List.NonEmpty (NonEmpty)
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe, maybeToList)
import Data.Text (Text)
import Drawing.AffineMap (AffineMap (..), after)
import Drawing.AffineMap qualified as AffineMap
import Drawing.Assembly (DrawingPart (..))
import Drawing.Assembly qualified as Assembly
import Drawing.Drawing
  ( Drawing (..),
    Entity (..),
    PresumedSize (..),
    Remark (..),
    RemarkKind (..),
  )
import Drawing.EntityBoundingBox qualified as EntityBoundingBox
import Drawing.Error (DrawingFault (..), Error (Error))
import Drawing.SvgLength (Direction (..), Viewport (..))
import Drawing.SvgLength qualified as SvgLength
import Drawing.SvgNode (NodeContent (..), SvgNode (..))
import Drawing.SvgNode qualified as SvgNode
import Drawing.SvgPage qualified as SvgPage
import Drawing.Tolerance qualified as Tolerance
import Drawing.XmlElement (XmlElement, nameOf)
import Drawing.XmlElement qualified as XmlElement
import Drawing.XmlText qualified as XmlText
import Geometry.Vec qualified as Vec

-- | The drawing of an SVG file, in mm with y upwards from the lower edge of the page. The unit is
-- that of the file, or the one that the program states if the file has none ('SvgPage.page'). All
-- errors of its elements are reported, or else the first error in the form of the file.
fromSvg :: Maybe LengthUnit -> ByteString -> Either (NonEmpty Error) Drawing
fromSvg stated bytes = do
  element <- first pure (XmlElement.fromText =<< XmlText.fromBytes bytes)
  let (root, named) = SvgNode.nodes element
      wrong fault = Left (pure (Error (XmlElement.line element) fault))
  if nameOf element == "svg" then Right () else wrong (NotSvg (nameOf element))
  ownPage <- first pure (SvgPage.page stated element)
  case XmlElement.attribute "transform" element of
    Just text -> wrong (WrongAttribute "svg" "transform" text)
    Nothing -> Right ()
  let context =
        Context
          { named,
            toPage = SvgPage.toPage ownPage,
            viewport = SvgPage.viewport ownPage,
            layerHere = "",
            identifiersHere = [],
            classesHere = [],
            isVisible = True,
            around = []
          }
  drawing <- Assembly.assembled (partsWithin context root [])
  Right
    drawing
      { presumed =
          if SvgPage.hasUnit ownPage
            then Nothing
            else
              let (width, height) =
                    fromMaybe (EntityBoundingBox.extent (entities drawing)) (SvgPage.size ownPage)
               in Just
                    PresumedSize
                      { sizeLine = XmlElement.line element,
                        largeUnit = Nothing,
                        width,
                        height
                      }
      }

-- Nodes ---------------------------------------------------------------------------------------

-- | The surroundings of a node.
data Context = Context
  { named :: Map Text SvgNode,
    -- | the map from user units to mm
    toPage :: AffineMap,
    viewport :: Viewport,
    layerHere :: Text,
    identifiersHere :: [Text],
    classesHere :: [Text],
    isVisible :: Bool,
    -- | the identifiers of the nodes that are used, from the inside
    around :: [Text]
  }

-- | The parts of the drawing that a node becomes, before other parts. These are computed only when
-- they are asked for, since there may be more than memory can hold.
parts :: Context -> SvgNode -> [DrawingPart] -> [DrawingPart]
parts context node@SvgNode {source, content} others = case content of
  Nowhere -> Visited line : others
  _
    | not (isDisplayed node) -> remarked (Invisible (nameOf source)) : others
    | otherwise -> case transform node of
      Left e -> Wrong e : others
      Right m ->
        let here = inside context {toPage = toPage context `after` m} node
            unclipped = [remarked (Unclipped (nameOf source)) | isClipped node]
         in Visited line : unclipped <> partsOf here node others
  where
    line = XmlElement.line source
    remarked = remarkOn (inside context node) source

-- | A remark on an element in its surroundings.
remarkOn :: Context -> XmlElement -> RemarkKind -> DrawingPart
remarkOn context source kind =
  Remarked
    Remark
      { remarkLine = XmlElement.line source,
        remarkKind = kind,
        remarkLayer = layerHere context,
        remarkIdentifiers = identifiersHere context,
        remarkClasses = classesHere context
      }

-- | The surroundings of the nodes within a node.
inside :: Context -> SvgNode -> Context
inside context node =
  context
    { layerHere = fromMaybe (layerHere context) (layerName node),
      identifiersHere = maybeToList (identifier node) <> identifiersHere context,
      classesHere = classNames node <> classesHere context,
      isVisible = fromMaybe (isVisible context) (visibility node)
    }

-- | The parts of a node whose transform and names are in the context, before other parts.
partsOf :: Context -> SvgNode -> [DrawingPart] -> [DrawingPart]
partsOf context node@SvgNode {source, content} others = case content of
  Nowhere -> others
  Container -> partsWithin context node others
  Area
    | nameOf source == "symbol" -> others
    | otherwise -> case areaContext context Nothing source of
      Left e -> Wrong e : others
      Right area -> partsWithin area node others
  Unknown -> remarked (NotUnderstood (nameOf source)) : others
  Use wanted -> case used context node wanted of
    Left e -> Wrong e : others
    Right found -> found others
  Figures shapes -> case shapes (viewport context) of
    Left e -> Wrong e : others
    Right _ | not (isVisible context) -> remarked (Invisible (nameOf source)) : others
    Right (Left reason) -> remarked (Unusable (nameOf source) reason) : others
    Right (Right found) -> foldr ((:) . Assembly.partOf . entity) others found
  where
    line = XmlElement.line source
    remarked = remarkOn context source
    entity shape =
      Entity
        { line,
          word = nameOf source,
          layer = layerHere context,
          identifiers = identifiersHere context,
          classes = classesHere context,
          shape = AffineMap.shape (toPage context) shape
        }

-- | The parts of all nodes within a node, before other parts.
partsWithin :: Context -> SvgNode -> [DrawingPart] -> [DrawingPart]
partsWithin context node others = foldr (parts context) others (within node)

-- | The surroundings within an area: an element svg or symbol. Its position and size are its own,
-- or the size that a use of it gives.
areaContext :: Context -> Maybe (Maybe Double, Maybe Double) -> XmlElement -> Either Error Context
areaContext context size element = do
  x <- SvgLength.givenOr 0 outer Horizontal "x" element
  y <- SvgLength.givenOr 0 outer Vertical "y" element
  ownWidth <- SvgLength.givenOr allWidth outer Horizontal "width" element
  ownHeight <- SvgLength.givenOr allHeight outer Vertical "height" element
  box <- SvgLength.viewBox element
  let width = fromMaybe ownWidth (fst =<< size)
      height = fromMaybe ownHeight (snd =<< size)
      placed m =
        context {toPage = toPage context `after` AffineMap.translation (Vec.vec x y) `after` m}
  case box of
    Nothing -> Right (placed AffineMap.identity) {viewport = Viewport width height}
    Just area@(_, _, w, h) -> do
      m <- SvgLength.boxMap element area (width, height)
      Right (placed m) {viewport = Viewport w h}
  where
    outer@(Viewport allWidth allHeight) = viewport context

-- | The parts of the node that a node uses, at the position of the use. They are put before other
-- parts.
used :: Context -> SvgNode -> Text -> Either Error ([DrawingPart] -> [DrawingPart])
used context SvgNode {source} wanted = do
  x <- SvgLength.givenOr 0 (viewport context) Horizontal "x" source
  y <- SvgLength.givenOr 0 (viewport context) Vertical "y" source
  width <- SvgLength.given (viewport context) Horizontal "width" source
  height <- SvgLength.given (viewport context) Vertical "height" source
  let (nearer, further) = break (== wanted) (around context)
      here =
        context
          { toPage = toPage context `after` AffineMap.translation (Vec.vec x y),
            around = wanted : around context
          }
      wrong fault = Left (Error (XmlElement.line source) fault)
  case Map.lookup wanted (named context) of
    _ | not (null further) -> wrong (Cycle (wanted : reverse nearer <> [wanted]))
    _ | length (around context) >= Tolerance.mostNesting -> wrong TooDeep
    Nothing -> wrong (ReferenceUnknown wanted)
    Just target
      | Area <- content target -> areaOf here target (width, height)
      | otherwise -> Right (parts here target)

-- | The parts of an area that is used with a size.
areaOf ::
  Context ->
  SvgNode ->
  (Maybe Double, Maybe Double) ->
  Either Error ([DrawingPart] -> [DrawingPart])
areaOf context target size = do
  m <- transform target
  let moved = inside context {toPage = toPage context `after` m} target
  area <- areaContext moved (Just size) (source target)
  Right (partsWithin area target)
