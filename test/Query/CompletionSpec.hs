-- | Completion and the forms of calls.
module Query.CompletionSpec (spec) where

import Base.Quantity (LengthUnit (..))
import Base.Region (Region (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Query.Completion (Completion (..), CompletionItem (..), CompletionKind (..))
import Query.Completion qualified as Completion
import Query.Marked (header, look, marked)
import Query.Signature (Signature (..))
import Query.Signature qualified as Signature
import Query.Snippet qualified as Snippet
import Test.Hspec

spec :: Spec
spec = do
  describe "completion" $ do
    statements
    types
    words'
    broken
    choices
  signatures

statements :: Spec
statements = do
  it "begins an empty file with part" $ do
    best "^" `shouldBe` ["part"]
    best "-- a comment\n^" `shouldBe` ["part"]
  it "offers each statement at the beginning of a line, and once those that a program has once" $ do
    labels (header <> "^") `shouldSatisfy` all' ["mill", "let", "feed", "contour", "pocket", "stop"]
    labels (header <> "^") `shouldSatisfy` none ["part", "machine", "tool", "tolerance", "from"]
  it "offers the statements in a block" $
    labels "part p\nfor p in [(0, 0)] {\n  ^\n}\n" `shouldSatisfy` all' ["rapid", "drill", "let"]
  it "replaces the word at the cursor" $ do
    fmap replaced (at' "part p\ncont^") `shouldBe` Just (Region 7 11)
    fmap replaced (at' "part p\nmachine lkp-^01f\n") `shouldBe` Just (Region 15 22)
  it "inserts the rest of a statement" $
    [snippet i | i <- items' "part p\n^", label i == "clearance"]
      `shouldBe` ["clearance ${1:3 mm}"]
  it "gives usual sizes in inches in a program in inches" $ do
    let snippetOf name text = [snippet i | i <- items' text, label i == name]
    snippetOf "tool" "part p\nunits in\n^" `shouldBe` ["tool mill(diameter ${1:0.25 in})"]
    snippetOf "plunge" "part p\nunits in\nmill a outside {\n^\n}"
      `shouldBe` ["plunge ${1:1 in/min}"]
    snippetOf "part" "units in\n^" `shouldBe` ["part ${1:name} \"${2:title}\""]
  it "has an example in inches for every size in mm" $
    filter (" mm" `Text.isInfixOf`) (map (Snippet.inUnit Inches . snd) Snippet.statements)
      `shouldBe` []
  it "offers nothing in a comment and in a title" $ do
    at' "part p -- mi^\n" `shouldBe` Nothing
    at' "part p \"mi^ll\"\n" `shouldBe` Nothing
  it "offers nothing where a new name has to come" $ do
    labels "part ^" `shouldBe` []
    labels "part p\nlet ^" `shouldBe` []
    labels "part p\nlet f(a, ^" `shouldBe` []

types :: Spec
types = do
  it "offers contours after mill and pocket" $ do
    best (drawn <> "mill ^") `shouldBe` ["rim"]
    labels (drawn <> "pocket r^") `shouldSatisfy` all' ["rim", "moved", "rotated"]
    labels (drawn <> "pocket r^") `shouldSatisfy` none ["width", "corner", "ring", "sqrt", "circle"]
  it "offers lengths where a length has to come" $ do
    best (drawn <> "clearance ^") `shouldBe` ["width"]
    labels (drawn <> "clearance ^") `shouldSatisfy` all' ["distance", "radius_of", "count"]
    labels (drawn <> "clearance ^") `shouldSatisfy` none ["corner", "turn_by", "rim", "line"]
  it "offers points where a point has to come, and lengths in its parentheses" $ do
    best (drawn <> "rapid ^") `shouldBe` ["corner"]
    best (drawn <> "rapid corner, ^") `shouldBe` ["corner"]
    labels (drawn <> "rapid (^") `shouldSatisfy` all' ["width", "x_of", "corner"]
    labels (drawn <> "rapid (width, ^") `shouldSatisfy` none ["corner", "ring"]
  it "knows the types of the arguments of functions" $ do
    best (drawn <> "let a = radius_of(^)") `shouldBe` ["other", "ring"]
    best (drawn <> "let a = polar(width, ^)") `shouldBe` ["turn_by"]
    best (drawn <> "let a = lug(^") `shouldBe` ["turn_by"]
    labels (drawn <> "let a = circle(corner, ^") `shouldSatisfy` all' ["width", "corner", "line"]
  it "knows the types in lists, conditions and settings" $ do
    best (drawn <> "drill at [^") `shouldBe` ["corner"]
    best (drawn <> "mill rim outside {\n  depth ^") `shouldBe` ["width"]
    best (drawn <> "let a = [for_all for for_all in ^") `shouldBe` ["list"]
    labels (drawn <> "let a = if ^") `shouldSatisfy` none ["width", "rim"]
  it "offers plain numbers beside a factor" $
    best (drawn <> "clearance width * ^") `shouldBe` ["count"]
  it "shows the kind, the value and the form" $ do
    [(kind i, detail i) | i <- items' (drawn <> "mill ^"), label i `elem` ["rim", "moved"]]
      `shouldBe` [(ContourItem, "a contour, length 31.4159 mm"), (FunctionItem, "moved(by)")]
    [detail i | i <- items' (drawn <> "clearance ^"), label i == "width"]
      `shouldBe` ["a length, 12 mm"]
  it "offers the local names of blocks and functions" $ do
    labels "part p\nlet f(radius, b) = ^" `shouldSatisfy` all' ["radius", "b"]
    labels "part p\nlet f(radius) = 1\nlet b = ^" `shouldSatisfy` none ["radius", "b"]
    labels "part p\nfor hole in [(0, 0)] {\n  let inner = hole\n  rapid ^"
      `shouldSatisfy` all' ["hole", "inner"]
    labels "part p\nlet a = [polar(1, ^) for angle in [1, 2]]" `shouldSatisfy` all' ["angle"]

words' :: Spec
words' = do
  it "offers the words of statements and settings" $ do
    labels (drawn <> "mill rim ^") `shouldBe` ["outside", "inside", "left", "right", "on"]
    labels "part p\ncontour a ^" `shouldBe` ["closed", "open", "from"]
    labels "part p\ncontours a ^" `shouldBe` ["from"]
    labels "part p\ntable t from \"a.dxf\" ^" `shouldBe` ["layer", "id", "class", "unit", "within"]
    labels "part p\ncontours t from \"a.ttf\" ^"
      `shouldBe` ["text", "layer", "id", "class", "unit", "within"]
    labels "part p\ncontours t from \"a.ttf\" text \"A\" at (0, 0) height 8 mm ^"
      `shouldBe` ["direction", "align"]
    labels "part p\nspindle ^" `shouldBe` ["cw", "ccw", "off", "manual"]
    labels "part p\nlet v = 180 m/min\nspindle cw v ^" `shouldBe` ["limit"]
    labels "part p\noptional ^" `shouldBe` ["stop"]
    labels "part p\nlet n = 2\ndwell n ^" `shouldBe` ["s"]
    labels "part p\nchange 2 mill(diameter 5) ^" `shouldBe` ["at"]
    labels "part p\nchange 2 turn(nose 1, ^" `shouldBe` ["tip"]
    labels "part p\nlet n = 2\ntool n ^" `shouldSatisfy` all' ["mill", "turn", "cone"]
    labels (drawn <> "mill rim outside {\n  lead ^") `shouldBe` ["in", "out"]
    labels (drawn <> "mill rim outside {\n  ^")
      `shouldSatisfy` all' ["approach", "lead in", "depth"]
    labels (drawn <> "mill rim outside {\n  depth 3\n  ^") `shouldSatisfy` none ["depth", "islands"]
  it "offers elements and links in a contour" $ do
    labels (drawn <> "contour b closed {\n  ^")
      `shouldSatisfy` all' ["cw", "corner", "line", "rim"]
    best (drawn <> "contour b closed {\n  ccw ^") `shouldBe` ["other", "ring"]
    labels (drawn <> "contour b closed {\n  corner ^")
      `shouldSatisfy` all' ["meet", "fillet", "smooth", "feed"]
  it "offers machines, cutters and their words" $ do
    labels "part p\nmachine ^" `shouldSatisfy` all' ["lkp-01f", "n55", "iso6983"]
    labels "part p\ntool ^"
      `shouldBe` ["mill", "drill", "tap", "threadmill", "turn", "cone", "vbit", "blade"]
    labels "part p\ntool mill(^" `shouldBe` ["diameter"]
    labels "part p\ntool cone(diameter 6, ^" `shouldBe` ["bevel"]
  it "offers units after a number" $ do
    labels "part p\nfeed 60 ^" `shouldSatisfy` all' ["mm", "mm/min", "rpm"]
    fmap replaced (at' "part p\nfeed 60mm/m^\n") `shouldBe` Just (Region 14 18)
    labels "part p\nlet a1 ^" `shouldBe` []
  it "offers the columns of a table in ciphers" $ do
    let table =
          "part p\ntable t {\n  x y mu deg H\n  0 0 5 9\n  9 0 6 9\n}\n"
            <> "curve k = polyline(t)\n"
    take 2 (labels (table <> "piece w = k cipher 4(mu, ^")) `shouldBe` ["mu", "H"]
    take 2 (labels (table <> "piece w = k cipher 6(^) left\n")) `shouldBe` ["mu", "H"]
    labels (table <> "piece w = k ^") `shouldBe` ["cipher", "left", "right"]
  it "offers the columns of a table in a drilling and in a repetition" $ do
    let table = "part p\ntable t {\n  angle radius deep wide\n  0 9 5 9\n  9 9 6 9\n}\n"
    take 2 (labels (table <> "drill at t depth ^")) `shouldBe` ["deep", "wide"]
    take 2 (labels (table <> "ream at t depth ^")) `shouldBe` ["deep", "wide"]
    take 2 (labels (table <> "spot at t diameter ^")) `shouldBe` ["deep", "wide"]
    labels (table <> "bore at t diameter ^") `shouldSatisfy` (not . any (`elem` ["deep", "wide"]))
    labels (table <> "bore at t diameter 9 depth deep pitch ^")
      `shouldSatisfy` (not . any (`elem` ["deep", "wide"]))
    take 2 (labels (table <> "for p in t {\n  let r = ^")) `shouldBe` ["deep", "wide"]
    take 2 (labels (table <> "for p in t {\n  if wide > ^")) `shouldBe` ["deep", "wide"]
    labels (table <> "for p in t {\n  rapid p\n}\nlet r = ^")
      `shouldSatisfy` (not . any (`elem` ["deep", "wide"]))
    labels (table <> "ream at ^") `shouldSatisfy` all' ["t"]
    labels (table <> "drill at ^") `shouldSatisfy` all' ["t"]
    labels (table <> "for p in ^") `shouldSatisfy` all' ["t"]

broken :: Spec
broken = do
  it "keeps the types of the last text without errors" $ do
    let sound = drawn <> "mill rim outside {\n  approach (-9, 0)\n  retract (-9, 0)\n}\n"
        text = Text.replace "let width = 12 mm" "let width = (12 mm" drawn <> "clearance ^"
        (now, offset) = marked text
        found = Completion.completion now (Just (look sound)) offset
    fmap (map label . take 1 . items) found `shouldBe` Just ["width"]
  it "works after an open parenthesis that the text never closes" $
    labels (drawn <> "let a = ((1, 2\nmill ^") `shouldSatisfy` all' ["rim"]

choices :: Spec
choices = do
  it "offers the answers of an intersection after near" $
    take 2 (labels (drawn <> "let q = intersection(axis, ring, near ^"))
      `shouldBe` ["(7, 0)", "(17, 0)"]
  it "offers them in a finished call" $
    take 2 (labels (drawn <> "let q = distance(intersection(axis, ring, near ^), corner)\n"))
      `shouldBe` ["(7, 0)", "(17, 0)"]
  it "offers the points at which neighbours meet" $
    take
      2
      ( labels
          ( drawn <> "contour c closed {\n  ccw ring meet near ^\n"
              <> "  ccw other meet near corner\n}\n"
          )
      )
      `shouldBe` ["(14.5, 4.3301)", "(14.5, -4.3301)"]
  it "offers the corners of a contour after start near" $
    take 4 (labels (drawn <> square <> "mill box outside {\n  start near ^\n}\n"))
      `shouldBe` ["(0, 0)", "(9, 0)", "(9, 9)", "(0, 9)"]

signatures :: Spec
signatures = describe "the signature" $ do
  it "is that of the innermost call, with the argument at the cursor" $ do
    shown "part p\nlet a = midpoint((1, 2), ^" `shouldBe` Just ("midpoint(first, second)", 1)
    shown "part p\nlet a = midpoint((1, ^" `shouldBe` Just ("midpoint(first, second)", 0)
    shown "part p\nlet a = sqrt(min(1, ^) + 2)" `shouldBe` Just ("min(first, second)", 1)
  it "is that of a function of the program" $
    shown "part p\nlet f(a, b) = a + b\nlet c = f(1, ^)" `shouldBe` Just ("f(a, b)", 1)
  it "is the form that fits the arguments" $ do
    shown "part p\nlet l = parallel(axis, left ^"
      `shouldBe` Just ("parallel(line, left distance)", 1)
    shown "part p\nlet c = around(ring, 3, ^" `shouldBe` Just ("around(circle, count, from)", 2)
  it "is absent outside of calls" $ do
    shown "part p\nlet a = (^1, 2)" `shouldBe` Nothing
    shown "part p\nlet a = pi(^" `shouldBe` Nothing
  where
    shown text =
      let (now, offset) = marked text
       in (\s -> (fst (forms s !! active s), argument s)) <$> Signature.signature now Nothing offset

-- | A program with names of several types.
drawn :: Text
drawn =
  header
    <> "let width = 12 mm\nlet count = floor(3)\nlet turn_by = 30 deg\nlet corner = (1 mm, 2 mm)\n"
    <> "let ring = circle((12, 0), 5)\nlet other = circle((17, 0), 5)\n"
    <> "let axis = line((0, 0), (1, 0))\nlet list = [1, 2]\nlet lug(a) = polar(90, a)\n"
    <> "contour rim closed { ccw ring }\n"

-- | A further contour.
square :: Text
square = "contour box closed {\n  (0, 0) (9, 0) (9, 9) (0, 9)\n}\n"

at' :: Text -> Maybe Completion
at' text = let (now, offset) = marked text in Completion.completion now Nothing offset

items' :: Text -> [CompletionItem]
items' = maybe [] items . at'

labels :: Text -> [Text]
labels = map label . items'

-- | The items of the best rank that are names of the program, or statements.
best :: Text -> [Text]
best text =
  [label i | i <- items' text, rank i == 0, kind i `elem` [ValueItem, ContourItem, StatementItem]]

all' :: [Text] -> [Text] -> Bool
all' wanted found = all (`elem` found) wanted

none :: [Text] -> [Text] -> Bool
none unwanted found = not (any (`elem` found) unwanted)
