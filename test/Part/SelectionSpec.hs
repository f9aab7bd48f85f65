-- | Laws of the choice among several answers. When a drawing is rotated and moved, the choice
-- selects the image of the answer. After a reflection it does so with left and right exchanged. A
-- random drawing and its image are built in the language itself. The program asserts that the
-- answers agree, and the reports must be the same.
module Part.SelectionSpec (spec) where

import Base.Result qualified as Result
import Compile qualified
import Data.List (sort)
import Data.Text (Text)
import Data.Text qualified as Text
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report (ReportCode)
import Report.Report qualified as Report
import Test.Hspec
import Test.QuickCheck

spec :: Spec
spec =
  describe
    "an answer is rotated and moved with the drawing; a reflection exchanges left and right \
    \(catches a choice that depends on the axes)"
    $ mapM_ law groups
  where
    law (group, kind, calls) =
      it group
        . property
        . forAll ((,,,) <$> drawing <*> turning <*> mirroring <*> elements calls)
        $ \(plain, turn, mirror, expression) ->
          let first = answer 0 expression
              sound = null (codesOf [plain, first])
              agrees n image call =
                codesOf
                  ([plain, image, answer n call] <> if sound then [first, same kind n] else [])
                  === codesOf [plain, first]
           in checkCoverage . cover 20 sound "sound" $
                conjoin
                  [ counterexample "turned" (agrees 1 (images 1 turn) expression),
                    counterexample "mirrored" (agrees 2 (images 2 mirror) (exchanged expression))
                  ]

-- | The result of a construction.
data Kind = Points | Lines | Circles

-- | Groups of constructions: a title, the kind of their results, and the calls. The character # in
-- a name is replaced by the number of the drawing.
groups :: [(String, Kind, [Text])]
groups =
  [ ( "intersection, with every choice",
      Points,
      [ "intersection(" <> a <> ", " <> b <> choice <> ")"
        | (a, b) <- pairs,
          choice <- choices <> ranks a b
      ]
    ),
    ( "tangency",
      Points,
      ["tangency(p#, " <> side <> "c#)" | side <- sides]
        <> [ "tangency(l#, circle(p#, l#))",
             "tangency(c#, line(p#, left c#))",
             "tangency(c#, concentric(circle(r, outside c#, p#, near q#), 0))"
           ]
    ),
    ( "foot_of, midpoint, centre_of",
      Points,
      [ "foot_of(p#, l#)",
        "midpoint(p#, q#)",
        "centre_of(c#)",
        "item_of(row(p#, q# - p#, 3), 3)",
        "item_of(grid(p#, q# - p#, 2, s# - p#, 2), 4)"
      ]
    ),
    ( "line, with sides",
      Lines,
      [ "line(" <> a <> ", " <> b <> ")"
        | a <- ["p#"] <> map (<> "c#") sides,
          b <- ["q#"] <> map (<> "d#") sides
      ]
    ),
    ( "parallel, perpendicular, reversed",
      Lines,
      [ "perpendicular(l#, p#)",
        "parallel(l#, left r)",
        "parallel(l#, right r)",
        "parallel(l#, p#)",
        "reversed(l#)"
      ]
    ),
    ( "circle of a radius, with every side and choice",
      Circles,
      [ "circle(r, " <> a <> ", " <> b <> choice <> ")"
        | a <- touched "l#" "c#" "p#",
          b <- touched "k#" "d#" "q#",
          choice <- choices <> [", near p#", ", near q#", ", near s#"]
      ]
    ),
    ( "circle, concentric",
      Circles,
      ["circle(p#, l#)", "circle(p#, q#, s#)", "concentric(c#, r)", "circle(p#, r)"]
    )
  ]
  where
    pairs = [("l#", "k#"), ("l#", "c#"), ("c#", "l#"), ("c#", "d#")]
    choices = ["", ", near p#", ", left m1#", ", right m1#", ", inside e#", ", outside e#"]
    ranks a b = if "l#" `elem` [a, b] then [", first", ", last"] else []
    sides = ["", "left ", "right "]
    touched l c p = [p, l, "left " <> l, "right " <> l, c, "outside " <> c, "inside " <> c]

-- | A drawing: points, lines and circles near one another.
drawing :: Gen Text
drawing = do
  ps <- vectorOf 12 point
  rs <- vectorOf 3 radius
  r <- radius
  pure . Text.unlines $
    zipWith (\n p -> "let " <> n <> "0 = " <> p) ["p", "q", "s"] ps
      <> zipWith3
        (\n a b -> "let " <> n <> "0 = line(" <> a <> ", " <> b <> ")")
        ["l", "k", "m1"]
        (drop 3 ps)
        (drop 6 ps)
      <> zipWith3
        (\n a r' -> "let " <> n <> "0 = circle(" <> a <> ", " <> tenths r' <> ")")
        ["c", "d", "e"]
        (drop 9 ps)
        rs
      <> ["let r = " <> tenths r <> " mm"]
  where
    radius = choose (2, 250)
    point =
      (\x y -> "(" <> tenths x <> ", " <> tenths y <> ")")
        <$> choose (-300, 300) <*> choose (-300, 300)

-- | A rotation about (0, 0) and a translation, as a call.
turning :: Gen Text
turning =
  (\a x y -> "moved(rotated(x, " <> tenths a <> " deg), (" <> tenths x <> ", " <> tenths y <> "))")
    <$> choose (0, 3600) <*> choose (-500, 500) <*> choose (-500, 500)

-- | A reflection, as a call.
mirroring :: Gen Text
mirroring =
  (\a x -> "mirrored(x, line((" <> tenths x <> ", 0), " <> tenths a <> " deg))")
    <$> choose (0, 3600) <*> choose (-500, 500)

-- | The statements that define the image of drawing 0, with a number and the call that transforms
-- it.
images :: Int -> Text -> Text
images n call =
  Text.unlines
    ( ("let image" <> number n <> "(x) = " <> call) :
        [ "let " <> name <> number n <> " = image" <> number n <> "(" <> name <> "0)"
          | name <- ["p", "q", "s", "l", "k", "m1", "c", "d", "e"]
        ]
    )

number :: Int -> Text
number = Text.pack . show

-- | A number of tenths as a decimal number.
tenths :: Int -> Text
tenths n =
  (if n < 0 then "-" else "")
    <> Text.pack (show (abs n `div` 10))
    <> "."
    <> Text.pack (show (abs n `mod` 10))

-- | The expression for the reflected drawing, with left and right exchanged. A perpendicular always
-- points to the left of its line, so the expression reverses it.
exchanged :: Text -> Text
exchanged =
  Text.replace "perpendicular(l#, p#)" "reversed(perpendicular(l#, p#))"
    . Text.replace "LEFT" "left"
    . Text.replace "left" "right"
    . Text.replace "right" "LEFT"

-- | The statement that defines the answer for the drawing with this number.
answer :: Int -> Text -> Text
answer n e = "let answer" <> number n <> " = " <> Text.replace "#" (number n) e

-- | Assertions that the answer with this number is the image of answer 0.
same :: Kind -> Int -> Text
same kind n = Text.unlines $ case kind of
  Points -> ["assert distance(" <> there <> ", " <> image <> ") < 0.0001"]
  Lines ->
    [ "assert distance(foot_of((0, 0), "
        <> there
        <> "), foot_of((0, 0), "
        <> image
        <> ")) < 0.0001",
      "assert cos(direction_of(" <> there <> ") - direction_of(" <> image <> ")) > 0.999999",
      "assert length_of(" <> there <> ") = length_of(" <> image <> ") within 0.0001"
    ]
  Circles ->
    [ "assert distance(centre_of(" <> there <> "), centre_of(" <> image <> ")) < 0.0001",
      "assert radius_of(" <> there <> ") = radius_of(" <> image <> ") within 0.0001"
    ]
  where
    there = "answer" <> number n
    image = "image" <> number n <> "(answer0)"

-- | The codes of the errors in a program of these parts.
codesOf :: [Text] -> [ReportCode]
codesOf parts = sort (map Report.code (Result.errors (Compile.analyse [] loaded)))
  where
    loaded = LoadedProgram.fromText "p" text
    text = Text.unlines ("part p" : parts)
