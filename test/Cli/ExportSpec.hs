-- | The subcommand @export@.
module Cli.ExportSpec (spec) where

import Command (inFolder, partc)
import Data.ByteString qualified as ByteString
import Data.List (isInfixOf, isPrefixOf, tails)
import System.Directory (doesFileExist, listDirectory)
import System.Exit (ExitCode (..))
import System.FilePath ((</>))
import Test.Hspec

spec :: Spec
spec = describe "drawings for CAD programs" $ do
  it "are DXF or SVG by the name of the file (catches DXF in a file that is called SVG)" $
    inFolder $ \folder -> do
      beginnings <- traverse (beginning folder) ["a.dxf", "a.svg", "a.SVG", "a"]
      beginnings `shouldBe` ["  0\nSECTION\n", "<?xml versio", "<?xml versio", "  0\nSECTION\n"]
  it "are DXF on standard output" $ do
    (code, out, _) <- partc ["export", "-q", "examples/flange.part"]
    code `shouldBe` ExitSuccess
    out `shouldSatisfy` ("  0\nSECTION\n" `isPrefixOf`)
    partc ["export", "-q", "examples/flange.part", "-o", "-"]
      `shouldReturn` (ExitSuccess, out, "")
  it "show the numbers of all nodes on the page (catches a number that is cut off)" $
    inFolder $ \folder -> do
      writeFile (folder </> "p.part") . unlines $
        [ "part p",
          "tool mill(diameter 1)",
          "feed 60",
          "tolerance 0.01",
          "from (-10, -10)",
          "contour c closed { (0, 0) (0, 20) (20, 20) (20, 0) }",
          "mill c outside { approach (-1, -1) }"
        ]
      (code, _, _) <- partc ["export", "-q", folder </> "p.part", "-o", folder </> "p.svg"]
      code `shouldBe` ExitSuccess
      svg <- readFile (folder </> "p.svg")
      let page = map read (concatMap words (valuesOf "viewBox=" svg)) :: [Double]
          texts = [l | l <- lines svg, "<text " `isInfixOf` l]
          places = [map read (valuesOf " x=" l <> valuesOf " y=" l) | l <- texts]
          -- A number with one digit is 2 mm high and not wider.
          isOnPage place = case (page, place) of
            ([left, top, width, height], [x, y]) ->
              x >= left && x + 2 <= left + width && y - 2 >= top && y <= top + height
            _ -> False
      length places `shouldBe` 8
      filter (not . isOnPage) places `shouldBe` []
  it "have splines for curves that move with their contours (catches arcs in their place)" $
    inFolder $ \folder -> do
      let kinds text = [k | ("  0", k) <- zip (lines text) (drop 1 (lines text))]
          splines body = do
            writeFile (folder </> "p.part") (unlines ("part p" : "from (0, 0)" : arch : body))
            (code, out, _) <- partc ["export", "-q", folder </> "p.part"]
            pure (code, length (filter (== "SPLINE") (kinds out)))
      -- The contours in which the program writes the curve are drawn, too.
      splines [written] `shouldReturn` (ExitSuccess, 1)
      splines [written, "contour n closed { a rotated(a, 180, (20, 0)) }"]
        `shouldReturn` (ExitSuccess, 3)
      splines
        [ written,
          "contour n closed {",
          "  mirrored(scaled(a, 3), line((0, -10), (1, -10)))",
          "  line((120, -20), (0, -20))",
          "}"
        ]
        `shouldReturn` (ExitSuccess, 2)
      splines ["contour n closed { ellipse((25, 60), 28, 14, 20) }"] `shouldReturn` (ExitSuccess, 1)
      splines ["let s = moved(union(ellipse((0, 0), 9, 5), ellipse((9, 0), 9, 5)), (3, 4))"]
        `shouldReturn` (ExitSuccess, 2)
      splines
        [ "let leaf(p) = moved(ellipse(p, 10, 5, 0, 180, 0), (3, 4))",
          "contour n closed { leaf((0, 0)) line((13, 4), (-7, 4)) }"
        ]
        `shouldReturn` (ExitSuccess, 1)
  it "are refused in another form (catches a file that nothing can read)" $
    inFolder $ \folder -> do
      (code, _, complaint) <- exported folder "a.dwg"
      code `shouldBe` ExitFailure 1
      complaint `shouldSatisfy` ("error[E0823]" `isInfixOf`)
      complaint `shouldSatisfy` (".dxf or .svg" `isInfixOf`)
      listDirectory folder `shouldReturn` []
  it "do not replace the program (catches a lost program)" $
    inFolder $ \folder -> do
      let file = folder </> "p.part"
      ByteString.readFile "examples/flange.part" >>= ByteString.writeFile file
      (code, _, complaint) <- partc ["export", file, "-o", file]
      code `shouldBe` ExitFailure 1
      complaint `shouldSatisfy` ("error[E0807]" `isInfixOf`)
      ByteString.readFile file `shouldSatisfyM` \kept ->
        (== kept) <$> ByteString.readFile "examples/flange.part"
  it "are not written for a program with errors (catches a drawing of half a part)" $
    inFolder $ \folder -> do
      ByteString.writeFile (folder </> "p.part") "part p\nfrom (0, 0)\nmill edge outside { }\n"
      (code, _, _) <- partc ["export", folder </> "p.part", "-o", folder </> "p.dxf"]
      code `shouldBe` ExitFailure 1
      doesFileExist (folder </> "p.dxf") `shouldReturn` False
  where
    -- The first value of an attribute in a text, in quotation marks.
    valuesOf attribute text =
      [ takeWhile (/= '"') (drop (length attribute + 1) t)
        | t <- take 1 (filter (attribute `isPrefixOf`) (tails text))
      ]
    arch = "curve arch = bezier([(0, 0), (10, 20), (30, 25), (40, 0)])"
    written = "contour a open { arch }"
    exported folder name = partc ["export", "-q", "examples/flange.part", "-o", folder </> name]
    beginning folder name = do
      (code, _, _) <- exported folder name
      code `shouldBe` ExitSuccess
      ByteString.take 12 <$> ByteString.readFile (folder </> name)
    shouldSatisfyM action test = action >>= test >>= (`shouldBe` True)
