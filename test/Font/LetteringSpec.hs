-- | Laws of the letters, and of texts that are laid out on lines and on circles.
module Font.LetteringSpec (spec) where

import Base.Quantity (Mm (..), Rad (..), minus, plus, times, total)
import Data.List (sort)
import Data.List.NonEmpty qualified as NonEmpty
import Data.Map.Strict qualified as Map
import Data.Maybe (isNothing)
import Data.Text qualified as Text
import Font.BuiltIn qualified as BuiltIn
import Font.Font (Letter (..))
import Font.FromText qualified as FromText
import Font.Lettering (BaseLine (..))
import Font.Lettering qualified as Lettering
import Geometry.Carrier (Circle (Circle))
import Geometry.Index.BoundingBox (BoundingBox (..))
import Geometry.Index.BoundingBox qualified as BoundingBox
import Geometry.Polyarc (Ends (..), Polyarc (..))
import Geometry.Polyarc qualified as Polyarc
import Geometry.Segment (Segment (..))
import Geometry.Segment qualified as Segment
import Geometry.Vec (Point)
import Geometry.Vec qualified as Vec
import Test.Hspec
import Test.Hspec.QuickCheck (prop)
import Test.QuickCheck hiding (total)

spec :: Spec
spec = do
  describe "the built-in letters" $ do
    it "are those of ASCII and of the Russian alphabet, and usual signs" $
      filter
        (isNothing . (`Map.lookup` BuiltIn.letters))
        ([' ' .. '~'] <> russian <> "№«»–—±×Ø°")
        `shouldBe` ""
    it "are each in one font" $
      sum (map (Map.size . snd) BuiltIn.fonts) `shouldBe` Map.size BuiltIn.letters
    it "have strokes, but for the space" $
      [c | (c, l) <- Map.toList BuiltIn.letters, null (strokes l)] `shouldBe` " "
    prop "every stroke of a letter lies in its box (catches a stroke without half of the gap)" $
      forAll letter $ \l -> conjoin (map (inBox l) (strokes l))
    prop "every stroke is a chain without gaps (catches an arc that begins elsewhere)" $
      forAll letter $ \l -> conjoin (map isChain (strokes l))
    it "of the Russian alphabet have the widths and heights of their standard" $ do
      Map.lookup 'Ш' BuiltIn.letters `shouldSatisfy` maybe False (isNear 1.1 . width)
      Map.lookup 'А' BuiltIn.letters `shouldSatisfy` maybe False (isNear 1 . width)
      [c | c <- ['А' .. 'Я'], not (isHigh 1 c)] `shouldBe` "Й"
      [c | c <- ['а' .. 'я'], not (isHigh 0.7 c)] `shouldBe` "бйф"
  describe "a font" $ do
    it "is read with its strokes" $
      fmap
        (Map.map width)
        (FromText.read (font ["letter A width 3", "  0,0 3,10", "letter B width 8"]))
        `shouldBe` Right (Map.fromList [('A', Mm 0.5), ('B', Mm 1)])
    it "is refused by the number of its first wrong line" $
      map
        (FromText.read . font)
        [ ["letter AB width 4"],
          ["  0,0 1,1"],
          ["letter A width 4", "  0,0 1"],
          ["letter A width 4", "  0,0 cw 2,0 about 1,5 3,0", "  0,0 cw 2,0 about 2,5"],
          ["letter A width 0"],
          ["letter A width 4", "letter A width 4"],
          ["letter A width 4", "  0,0 0,0"]
        ]
        `shouldBe` map Left [3, 3, 4, 5, 3, 4, 4]
  describe "a text" $ do
    prop "on a line has each letter behind the ones before it (catches letters over each other)" $
      forAll ((,) <$> text <*> size) $ \(ls, h) -> forAll ((,) <$> place <*> direction) $ \(p, a) ->
        forAll (elements [0, 0.5, 1]) $ \share ->
          let starts = scanl plus (times (-share) (whole h ls)) (map (times h . width) ls)
              at begin q = alongLine p a (plus begin (Mm (h * Vec.x q))) (h * Vec.y q)
              expected = [map (at b) (pointsOf (strokes l)) | (b, l) <- zip starts ls]
           in near
                (concat expected)
                (concatMap pointsOf (Lettering.layout (StraightLine p a) (Mm h) share ls))
    prop "on a circle keeps the sizes of its letters (catches letters bent along the circle)" $
      forAll ((,) <$> text <*> size) $ \(ls, h) -> forAll (onCircle h) $ \line ->
        let laid = Lettering.layout line (Mm h) 0.5 ls
         in conjoin
              [ nearNumbers (map (h *) (spans (pointsOf (strokes l)))) (spans (pointsOf ss))
                | (l, ss) <- zip ls laid
              ]
    prop "on a circle stands on it in the middle of each letter (catches letters beside it)" $
      forAll ((,) <$> text <*> size) $ \(ls, h) -> forAll (onCircle h) $ \line ->
        conjoin
          [ nearNumbers [r] [Vec.norm (Vec.to c (foot l ss))]
            | (l, ss) <- zip ls (Lettering.layout line (Mm h) 0.5 ls),
              not (null ss),
              let (c, r) = circleOf line
                  foot l' ss' = footOf h l' ss'
          ]
    prop "is cut with all its strokes, each once (catches a stroke that is cut twice)" $
      forAll ((,) <$> text <*> place) $ \(ls, p) ->
        let laid = Lettering.layout (StraightLine p (Rad 0)) (Mm 5) 0 ls
            same = sort . map (sort . map key . NonEmpty.toList . segments)
         in map same (Lettering.inOrder p laid) === map same laid
    prop "is cut by the nearest end of a stroke next (catches a stroke cut from its far end)" $
      forAll ((,) <$> text <*> place) $ \(ls, p) ->
        let laid = Lettering.layout (StraightLine p (Rad 0)) (Mm 5) 0 ls
         in conjoin (greedy p (Lettering.inOrder p laid))
  where
    font ls = Text.unlines (["height 10", "gap 2"] <> ls)
    whole h = times h . total . map width
    isNear x (Mm y) = abs (x - y) < 1e-9

russian :: String
russian = ['А' .. 'Я'] <> ['а' .. 'я'] <> "Ёё"

letter :: Gen Letter
letter = elements (Map.elems BuiltIn.letters)

text :: Gen [Letter]
text = chooseInt (1, 12) >>= \n -> vectorOf n letter

size :: Gen Double
size = choose (0.5, 40)

place :: Gen Point
place = Vec.point <$> choose (-300, 300) <*> choose (-300, 300)

direction :: Gen Rad
direction = Rad <$> choose (-7, 7)

-- | A circle of at least twice the height of the letters, which stand outside or inside.
onCircle :: Double -> Gen BaseLine
onCircle h = do
  circle <- Circle <$> place <*> (Mm <$> choose (2 * h, 50 * h))
  elements [AroundCircle, WithinCircle] <*> pure circle <*> direction

circleOf :: BaseLine -> (Point, Double)
circleOf line = case line of
  StraightLine p _ -> (p, 0)
  AroundCircle (Circle c (Mm r)) _ -> (c, r)
  WithinCircle (Circle c (Mm r)) _ -> (c, r)

-- | The middle of the foot of a placed letter, found by the similarity that takes the first two
-- different points of the letter to those of its image.
footOf :: Double -> Letter -> [Polyarc] -> Point
footOf h l laid = Vec.shift (turned (Vec.to a foot)) a'
  where
    pairs = zip (pointsOf (strokes l)) (pointsOf laid)
    (a, a') = first pairs
    (b, b') = first ([(q, q') | (q, q') <- pairs, Vec.norm (Vec.to a q) > 0.01] <> pairs)
    Rad turn = Vec.angle (Vec.to a b)
    Rad turn' = Vec.angle (Vec.to a' b')
    turned v = Vec.scale h (Vec.rotate (Rad (turn' - turn)) v)
    foot = let Mm w = width l in Vec.point (w / 2) 0
    first found = case found of
      pair : _ -> pair
      [] -> error "a letter without strokes"

-- | The point at a distance along a line through @p@, and beside it to the left.
alongLine :: Point -> Rad -> Mm -> Double -> Point
alongLine p a (Mm along) beside =
  Vec.shift (Vec.rotate a (Vec.vec along beside)) p

-- | The ends and the centres of all segments.
pointsOf :: [Polyarc] -> [Point]
pointsOf = concatMap (concatMap ends' . NonEmpty.toList . segments)
  where
    ends' s = case s of
      Straight a b -> [a, b]
      Arc {start, end, centre} -> [start, end, centre]

-- | The distances of all points from the first one and from the one before.
spans :: [Point] -> [Double]
spans ps = [d | (a, b) <- zip ps (drop 1 ps) <> map (p0,) ps, let Mm d = Vec.distance a b]
  where
    p0 = case ps of
      p : _ -> p
      [] -> Vec.point 0 0

near :: [Point] -> [Point] -> Property
near expected found =
  nearNumbers (concatMap numbers expected) (concatMap numbers found)
  where
    numbers p = [Vec.x p, Vec.y p]

nearNumbers :: [Double] -> [Double] -> Property
nearNumbers expected found =
  counterexample
    (show (expected, found))
    (length expected == length found && and (zipWith (\a b -> abs (a - b) < 1e-6) expected found))

-- | A stroke lies between the edges of its letter, half of the gap of most letters apart from them,
-- and no further above the capitals or below the line than the signs that reach furthest.
inBox :: Letter -> Polyarc -> Property
inBox l stroke =
  counterexample
    (show (width l, stroke))
    (left >= -1e-9 && Mm right <= plus (width l) (Mm 1e-9) && bottom >= -0.34 && top <= 1.34)
  where
    BoundingBox {left, bottom, right, top} =
      foldr1 BoundingBox.union (fmap BoundingBox.around (segments stroke))

-- | Each segment begins where the one before ends, each arc runs from its start to its end, and a
-- closed stroke ends where it begins.
isChain :: Polyarc -> Property
isChain stroke =
  conjoin
    ( [Segment.end a === Segment.start b | (_, a, b) <- Polyarc.neighbours stroke]
        <> [ nearNumbers [0] [d] .&&. Segment.start s =/= Segment.end s
             | s@Arc {start, end, centre} <- NonEmpty.toList (segments stroke),
               let Mm d = minus (Vec.distance centre start) (Vec.distance centre end)
           ]
        <> [ ends stroke
               === if beginOf stroke == endOf stroke then Closed else Open
           ]
    )

beginOf, endOf :: Polyarc -> Point
beginOf = Segment.start . NonEmpty.head . segments
endOf = Segment.end . NonEmpty.last . segments

-- | True if the strokes of a letter reach up to this height, in heights of the capitals.
isHigh :: Double -> Char -> Bool
isHigh h c = case Map.lookup c BuiltIn.letters of
  Just l -> abs (maximum (map topOf (strokes l)) - h) < 1e-9
  Nothing -> False
  where
    topOf = top . foldr1 BoundingBox.union . fmap BoundingBox.around . segments

-- | A segment in one of its two directions.
key :: Segment -> (Segment, Segment)
key s = (min s (Segment.reverse s), max s (Segment.reverse s))

-- | Each stroke begins at the nearest of the ends of the strokes of its letter that are left.
greedy :: Point -> [[Polyarc]] -> [Property]
greedy from laid = case laid of
  [] -> []
  [] : more -> greedy from more
  (s : rest) : more ->
    counterexample
      (show (from, s))
      (Vec.distance from (beginOf s) <= plus (Mm 1e-9) (nearest (s : rest))) :
    greedy (endOf s) (rest : more)
  where
    nearest left = minimum [Vec.distance from (e q) | q <- left, e <- [beginOf, endOf]]
