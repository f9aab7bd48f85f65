-- | The elements of an XML file with their lines.
--
-- No entity from outside of the file is read, and the entities that the file declares are bounded.
module Drawing.XmlElement
  ( XmlElement (..),
    fromText,
    attribute,
    nameOf,
  )
where

import Control.Exception (SomeException, fromException)
import Data.Conduit (runConduit, yield, (.|))
import Data.Conduit.Attoparsec (ParseError (..), Position (..), PositionRange (..))
import Data.Conduit.List qualified as Conduit
import Data.Map.Strict (Map)
import Data.Map.Strict qualified as Map
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.XML.Types (Content (..), Event (..), Name (..))
import Drawing.Error (DrawingFault (..), Error (Error))
import Drawing.Tolerance qualified as Tolerance
import Text.XML.Stream.Parse (def, parseTextPos, psEntityExpansionSizeLimit)

-- | An element.
data XmlElement = XmlElement
  { -- | number of the line at which its tag begins, from 1
    line :: Int,
    -- | the name in the namespace of SVG, or without a namespace; nothing for another one
    name :: Maybe Text,
    -- | the attributes; names of other namespaces have their prefix from 'prefixes'
    attributes :: Map Text Text,
    children :: [XmlElement]
  }
  deriving stock (Eq, Show)

-- | The value of an attribute without blanks around it.
attribute :: Text -> XmlElement -> Maybe Text
attribute wanted = fmap Text.strip . Map.lookup wanted . attributes

-- | The name of an element, or an empty text for another namespace.
nameOf :: XmlElement -> Text
nameOf = fromMaybe "" . name

-- | The outermost element of a file.
fromText :: Text -> Either Error XmlElement
fromText text
  | declaresEntities && references * Tolerance.mostEntityLength > Tolerance.mostExpansion =
    Left (Error 1 (NotXml "it has too many references to entities."))
  | otherwise = case parsed of
    Left e -> Left (parseError e)
    Right events -> tree [(lineOf range, event) | (range, event) <- events]
  where
    declaresEntities = "<!ENTITY" `Text.isInfixOf` text
    references = Text.count "&" text
    parsed =
      runConduit $
        yield text
          .| parseTextPos def {psEntityExpansionSizeLimit = Tolerance.mostEntityLength}
          .| Conduit.consume
    lineOf range = maybe 1 (posLine . posRangeStart) range

parseError :: SomeException -> Error
parseError e = case fromException e of
  Just ParseError {errorPosition} -> Error (posLine errorPosition) (NotXml wrong)
  _ -> Error 1 (NotXml wrong)
  where
    wrong = "this is not well-formed XML."

-- | An element whose end has not come yet, with its children so far in reverse.
data OpenElement = OpenElement {opened :: XmlElement, tag :: Name, found :: [XmlElement]}

-- | The tree of the elements from their tags.
tree :: [(Int, Event)] -> Either Error XmlElement
tree = go (0 :: Int) []
  where
    go depth around events = case events of
      [] -> case around of
        [] -> Left (Error 1 (NotXml "it has no element."))
        OpenElement {opened} : _ -> Left (Error (line opened) (NotXml "this element has no end."))
      (number, event) : rest -> case event of
        EventBeginElement name pairs
          | depth >= Tolerance.mostElementDepth -> Left (Error number TooDeep)
          | otherwise ->
            go (depth + 1) (OpenElement (element number name pairs) name [] : around) rest
        EventEndElement name -> case around of
          OpenElement {opened, tag, found} : outer
            | tag == name ->
              let closed = opened {children = reverse found}
               in case outer of
                    [] -> nothingAfter closed rest
                    next : further ->
                      go (depth - 1) (withChild closed next : further) rest
          _ -> Left (Error number (NotXml "this tag ends no element."))
        _ -> go depth around rest
    withChild child parent@OpenElement {found} = parent {found = child : found}
    nothingAfter root rest = case [number | (number, EventBeginElement _ _) <- rest] of
      number : _ -> Left (Error number (NotXml "this is a second outermost element."))
      [] -> Right root

element :: Int -> Name -> [(Name, [Content])] -> XmlElement
element line tag pairs =
  XmlElement
    { line,
      name = if own tag then Just (nameLocalName tag) else Nothing,
      attributes =
        Map.fromList [(key, foldMap textOf value) | (n, value) <- pairs, Just key <- [keyOf n]],
      children = []
    }
  where
    own n = maybe True (== "http://www.w3.org/2000/svg") (nameNamespace n)
    keyOf n = case nameNamespace n of
      Nothing -> Just (nameLocalName n)
      Just space -> (<> nameLocalName n) <$> Map.lookup space prefixes
    textOf content = case content of
      ContentText text -> text
      ContentEntity entity -> "&" <> entity <> ";"

-- | The namespaces of attributes that are kept, and their prefixes.
prefixes :: Map Text Text
prefixes =
  Map.fromList
    [ ("http://www.w3.org/1999/xlink", "xlink:"),
      ("http://www.inkscape.org/namespaces/inkscape", "inkscape:"),
      ("https://librecad.org", "lc:")
    ]
