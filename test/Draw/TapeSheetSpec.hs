-- | Drawing of a tape: its holes are read back from the SVG document and compared with the rows.
module Draw.TapeSheetSpec (spec) where

import Control.Monad (forM_)
import Data.Bits (setBit)
import Data.Containers.ListUtils (nubOrd)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Data.Text.Read qualified as Read
import Data.Word (Word8)
import Draw.Page (Area (Area))
import Draw.TapeSheet (TapeMaterial (..))
import Draw.TapeSheet qualified as TapeSheet
import Machine.Machine (Machine)
import Machine.Machine qualified as Machine
import Machines (iso6983, kontur3p, lkp01f, n55)
import Tape.Journey (journey, start)
import Tape.Punch qualified as Punch
import Tape.RowMeaning (Row)
import Tape.RowMeaning qualified as RowMeaning
import Test.Hspec

spec :: Spec
spec = describe "the drawing of a tape" $ do
  forM_ [("lkp-01f", lkp01f), ("kontur-3p", kontur3p), ("n55", n55)] $ \(name, machine) -> do
    it ("has the holes of the rows, and no others, for " <> name) $
      holesIn machine (drawing machine)
        `shouldBe` map RowMeaning.holes (rowsOf machine)
    it ("has a sprocket hole in each row, on one line of each strip, for " <> name) $ do
      let sprockets = pointsOf "sprocket-holes" (drawing machine)
      length sprockets `shouldBe` length (rowsOf machine)
      length (nubOrd (map fst sprockets)) `shouldSatisfy` (<= length (strips (drawing machine)))
    it ("keeps all of it on its pages, for " <> name) $ do
      let texts = "viewBox=\"0 0 210 " `Text.breakOn` drawing machine
      snd texts `shouldNotBe` ""
      [x | (x, _, w, _) <- strips (drawing machine), x < 12 || x + w > 198] `shouldBe` []
  it "has the tracks of ISO 1154 for a tape of one inch" $ do
    g <- maybe (fail "no tape") pure (TapeSheet.geometryOf PaperTape (Machine.medium n55))
    TapeSheet.sprocketPosition g `shouldBe` 25.4 - 9.96
    map (hundredths . TapeSheet.trackPosition g) [1, 3, 4, 8] `shouldBe` [2306, 1798, 1290, 274]
  it "has three tracks beside the nearer edge of a narrow tape" $ do
    g <- maybe (fail "no tape") pure (TapeSheet.geometryOf PaperTape (Machine.medium kontur3p))
    map (hundredths . TapeSheet.trackPosition g) [5, 3, 2, 1] `shouldBe` [236, 744, 1252, 1506]
  it "has on film the perforations of the film at both edges, and no sprocket holes" $ do
    g <- maybe (fail "no tape") pure (TapeSheet.geometryOf Film (Machine.medium lkp01f))
    let areas = TapeSheet.filmPerforations g (0, 0, 475)
        middles = [(left + right) / 2 | Area left _ right _ <- areas]
    length areas `shouldBe` 2 * 100
    nubOrd (map hundredths middles) `shouldBe` [341, 3157]
    map (hundredths . TapeSheet.trackPosition g) [5, 4, 3, 2, 1]
      `shouldBe` [1114, 1368, 1622, 2130, 2384]
    let svg = fromMaybe "" (TapeSheet.sheet Film lkp01f "tape" (zip [1 ..] (rowsOf lkp01f)))
    pointsOf "sprocket-holes" svg `shouldBe` []
    length (pointsOf "holes" svg) `shouldBe` length (pointsOf "holes" (drawing lkp01f))
  it "has pages of A4, each with its part of the tape" $ do
    let rows = concat (replicate 20 (rowsOf n55))
        pages = TapeSheet.pages PaperTape n55 "tape" (zip [1 ..] rows)
    length pages `shouldSatisfy` (> 1)
    all ("height=\"297mm\"" `Text.isInfixOf`) pages `shouldBe` True
    length (nubOrd pages) `shouldBe` length pages
  it "is only for punched tapes" $
    TapeSheet.sheet PaperTape iso6983 "text" (zip [1 ..] (rowsOf iso6983)) `shouldBe` Nothing

rowsOf :: Machine -> [Row]
rowsOf machine = Punch.rows machine start (journey machine)

drawing :: Machine -> Text
drawing machine =
  fromMaybe
    (error "no drawing")
    (TapeSheet.sheet PaperTape machine "tape" (zip [1 ..] (rowsOf machine)))

hundredths :: Double -> Int
hundredths x = round (100 * x)

-- | Holes of all rows, from the places of the points on the strips.
holesIn :: Machine -> Text -> [Word8]
holesIn machine svg =
  concat
    [ [ foldl
          setBit
          0
          [ track (px - x)
            | (px, py) <- points,
              holds (x, y, w) (px, py),
              row (py - y) == k
          ]
        | k <- [0 .. round (h / pitch) - 1 :: Int]
      ]
      | (x, y, w, h) <- strips svg
    ]
  where
    points = pointsOf "holes" svg
    pitch = 2.54
    row dy = floor (dy / pitch) :: Int
    holds (x, y, w) (px, py) =
      px > x && px < x + w && py > y && any (\(_, y', _, h) -> y' == y && py < y' + h) (strips svg)
    track dx = case [k | k <- [1 .. Machine.tracks (Machine.medium machine)], near dx k] of
      k : _ -> k - 1
      [] -> error ("a hole is on no track: " <> show dx)
    near dx k = abs (TapeSheet.trackPosition geometry k - dx) < 1.0e-3
    geometry = fromMaybe (error "no tape") (TapeSheet.geometryOf PaperTape (Machine.medium machine))

-- | The rectangles of the paper: left edge, upper edge, width and height.
strips :: Text -> [(Double, Double, Double, Double)]
strips svg =
  [ (field "x" r, field "y" r, field "width" r, field "height" r)
    | r <- drop 1 (Text.splitOn "<rect" (layerOf "paper" svg))
  ]
  where
    field key r = number (Text.takeWhile (/= '"') (behind (" " <> key <> "=\"") r))

-- | The points of the layer with a name.
pointsOf :: Text -> Text -> [(Double, Double)]
pointsOf name svg =
  [ case map number (Text.words (Text.takeWhile (/= 'h') p)) of
      [x, y] -> (x, y)
      _ -> error "no point"
    | path <- drop 1 (Text.splitOn " d=\"" (layerOf name svg)),
      p <- drop 1 (Text.splitOn "M" (Text.takeWhile (/= '"') path))
  ]

layerOf :: Text -> Text -> Text
layerOf name svg = fst (Text.breakOn "</g>" (behind ("id=\"" <> name <> "\"") svg))

behind :: Text -> Text -> Text
behind key text = Text.drop (Text.length key) (snd (Text.breakOn key text))

number :: Text -> Double
number = either error fst . Read.signed Read.double
