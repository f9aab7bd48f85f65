-- | The elements of an SVG file as nodes that can be drawn. All attributes of a node are read once,
-- however often the node is used.
module Drawing.SvgNode
  ( SvgNode (..),
    NodeContent (..),
    nodes,
  )
where

import Control.Applicative ((<|>))
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (mapMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Drawing.AffineMap (AffineMap)
import Drawing.AffineMap qualified as AffineMap
import Drawing.Drawing (Shape)
import Drawing.Error (DrawingFault (..), Error (Error))
import Drawing.SvgLength (Viewport)
import Drawing.SvgShape qualified as SvgShape
import Drawing.SvgTransform qualified as SvgTransform
import Drawing.XmlElement (XmlElement (children, line), attribute, nameOf)

-- | A node.
data SvgNode = SvgNode
  { source :: XmlElement,
    identifier :: Maybe Text,
    classNames :: [Text],
    -- | the name of the layer, if the node is a layer of Inkscape or of LibreCAD
    layerName :: Maybe Text,
    isDisplayed :: Bool,
    -- | the visibility of the node and of those within it, if it says so
    visibility :: Maybe Bool,
    isClipped :: Bool,
    transform :: ~(Either Error AffineMap),
    content :: NodeContent,
    within :: [SvgNode]
  }

-- | The content of a node.
data NodeContent
  = -- | nodes that are drawn
    Container
  | -- | an area of its own: svg or symbol. A symbol is drawn only if it is used
    Area
  | -- | another node, if the file has it; its identifier
    Use Text
  | -- | curves, or the reason why there are none
    Figures (Viewport -> Either Error (Either Text [Shape]))
  | -- | nothing that is drawn
    Nowhere
  | -- | something that is drawn, but is no curve that the reader knows
    Unknown

-- | The root of a tree of elements as a node, and all nodes by their identifiers. Of several nodes
-- with one identifier the first one counts.
nodes :: XmlElement -> (SvgNode, Map Text SvgNode)
nodes element = (root, Map.fromListWith (\_ old -> old) (named root []))
  where
    root = node element
    named n rest = [(i, n) | Just i <- [identifier n]] <> foldr named rest (within n)

node :: XmlElement -> SvgNode
node element =
  SvgNode
    { source = element,
      identifier = attribute "id" element,
      classNames = maybe [] Text.words (attribute "class" element),
      layerName = layerOf element,
      isDisplayed = property "display" /= Just "none",
      visibility = (`notElem` ["hidden", "collapse"]) <$> notInherited "visibility",
      isClipped = any (maybe False (/= "none") . property) ["clip-path", "mask"],
      transform = transformOf element style,
      content = contentOf element,
      within = map node (children element)
    }
  where
    style = maybe Map.empty declarations (attribute "style" element)
    property name = Map.lookup name style <|> attribute name element
    notInherited name = if property name == Just "inherit" then Nothing else property name

contentOf :: XmlElement -> NodeContent
contentOf element = case (nameOf element, SvgShape.figures element) of
  (_, Just shapes) -> Figures shapes
  (name, Nothing)
    | name `elem` ["g", "a", "switch"] -> Container
    | name `elem` ["svg", "symbol"] -> Area
    | name == "use" -> Use (maybe "" (Text.drop 1) reference)
    | name `elem` undrawn -> Nowhere
    | otherwise -> Unknown
  where
    reference = attribute "href" element <|> attribute "xlink:href" element

-- | Elements that are not drawn where they are, and those of other namespaces.
undrawn :: [Text]
undrawn =
  ["", "defs", "metadata", "title", "desc", "style", "script", "view", "cursor", "symbol"]
    <> ["clipPath", "mask", "pattern", "marker", "filter", "color-profile", "font", "font-face"]
    <> ["linearGradient", "radialGradient", "meshgradient", "hatch", "solidcolor"]
    <> ["animate", "animateMotion", "animateTransform", "set", "discard"]

-- | The layer that a group is: of Inkscape, or of LibreCAD.
layerOf :: XmlElement -> Maybe Text
layerOf element = case attribute "inkscape:groupmode" element of
  Just "layer" -> attribute "inkscape:label" element <|> attribute "id" element
  _ -> attribute "lc:layername" element

-- | The declarations of an attribute @style@ by the names of their properties.
declarations :: Text -> Map Text Text
declarations text = Map.fromList (mapMaybe declaration (Text.splitOn ";" text))
  where
    declaration part = case Text.breakOn ":" part of
      (_, "") -> Nothing
      (name, value) -> Just (Text.strip name, important (Text.strip (Text.drop 1 value)))
    important value = maybe value Text.strip (Text.stripSuffix "!important" value)

-- | The map of the attribute @transform@. The property of that name in a style has another grammar,
-- and an origin other than (0, 0) is another map; both are errors.
transformOf :: XmlElement -> Map Text Text -> Either Error AffineMap
transformOf element style = case [(name, value) | (name, Just value) <- foreign'] of
  (name, value) : _ -> Left (wrong name value)
  [] -> case attribute "transform" element of
    Nothing -> Right AffineMap.identity
    Just text -> either (Left . wrong "transform") Right (SvgTransform.fromText text)
  where
    wrong name value = Error (line element) (WrongAttribute (nameOf element) name value)
    foreign' =
      [ ("style", stated =<< Map.lookup "transform" style),
        ("style", Map.lookup "transform-origin" style),
        ("transform-origin", attribute "transform-origin" element)
      ]
    stated value = if value == "none" then Nothing else Just value
