-- | The unit of a file: a program with @units in@ is the program in which each number that is a
-- length or a feed has the unit @in@ or @in/min@.
module Surface.FileUnitSpec (spec) where

import Base.Decimal qualified as Decimal
import Base.Region (Region (..))
import Base.Result (Result (..))
import Checked.Error qualified as Checked
import Checked.FromSurface qualified as Checked
import Checked.Syntax qualified as Checked
import Compile (Compiled (punched), Punched (program))
import Compile qualified
import Control.Monad (forM_)
import Data.Either (isRight, rights)
import Data.Functor.Identity (Identity (runIdentity))
import Data.List (find, sort)
import Data.Maybe (fromMaybe)
import Data.Text (Text)
import Data.Text qualified as Text
import Files (filesBelow, readText)
import Frame.Frame (Frame)
import Frame.Frame qualified as Frame
import Generate.MachinedText qualified as MachinedText
import Machines qualified
import Project.Job (Job (verification), Verification (Unverified))
import Project.LoadedProgram (LoadedProgram)
import Project.LoadedProgram qualified as LoadedProgram
import Report.Report (Report, ReportCode)
import Report.Report qualified as Report
import Surface.Import qualified as Import
import Surface.Lexer qualified as Lexer
import Surface.Token (Numeral (amount), Token (..), Token_ (..))
import System.FilePath (takeDirectory, takeExtension)
import Test.Hspec
import Test.Hspec.QuickCheck (modifyMaxSuccess, prop)
import Test.QuickCheck hiding (Result, output)

spec :: Spec
spec = describe "the unit of a file" $ do
  files <- runIO (filesBelow "examples" >>= traverse (\f -> (,) f <$> readText f) . filter isText)
  let programs = [f | f@(name, _) <- files, takeDirectory name == "examples", isProgram name]
      loaded name = fromFiles files name
  it "units in means that the lengths and feeds of an example are in inches" $ do
    forM_ programs $ \(name, text) ->
      (name, outcome (loaded name (withUnits "in" text)))
        `shouldBe` (name, outcome (loaded name (inInches (loaded name) text)))
    -- Some examples are too large for their machines when they are made in inches.
    let inch = [outcome (loaded name (withUnits "in" text)) | (name, text) <- programs]
    length (rights inch) `shouldSatisfy` (> length programs `div` 2)
  it "units mm changes no example" $
    forM_ programs $ \(name, text) -> do
      let plain = outcome (loaded name text)
      (name, outcome (loaded name (withUnits "mm" text))) `shouldBe` (name, plain)
      plain `shouldSatisfy` isRight
  modifyMaxSuccess (const 40) $
    -- The bug: a kind of statement in which the unit of the file is not heeded.
    prop "units in means that the lengths and feeds of a random program are in inches" $
      forAllShow (MachinedText.program Machines.iso6983) Text.unpack $ \text ->
        let made = outcome (alone (withUnits "in" text))
         in isRight (outcome (alone text))
              ==> classify (isRight made) "with frames"
              $ made === outcome (alone (inInches alone text))
  modifyMaxSuccess (const 300) $
    -- The bug: a factor, a divisor, an angle or a count that is taken for a length, or a length in
    -- an operation, a list or a function that is not.
    prop "units in means that the lengths in random expressions are in inches" $
      forAllShow arithmetic (Text.unpack . bare) $ \p ->
        let made = outcome (alone (withUnits "in" (bare p)))
         in counterexample (show made) (isRight made)
              .&&. made === outcome (alone (annotated p))
  where
    isText name = takeExtension name `elem` [".part", ".csv", ".machine"]
    isProgram name = takeExtension name == ".part"

-- | The program with this name and this text, which imports others of the given files.
fromFiles :: [(FilePath, Text)] -> FilePath -> Text -> LoadedProgram
fromFiles files name text = runIdentity (LoadedProgram.load (Import.byName reader) name text)
  where
    reader file = pure (maybe (Left "it is not there") Right (lookup file files))

-- | The program with this text, which imports nothing.
alone :: Text -> LoadedProgram
alone = LoadedProgram.fromText "p.part"

-- | The frames of a program, or the codes of its errors.
outcome :: LoadedProgram -> Either [ReportCode] [Frame]
outcome loaded = case Compile.compile job loaded :: Result Report Report [Compiled] of
  Result {errors = [], output = Just compiled} ->
    Right
      [ Frame.frame planned
        | c <- compiled,
          planned <- Frame.plannedFrames (program (punched c))
      ]
  Result {errors} -> Left (map Report.code errors)
  where
    job = (Machines.jobForOwnOr Machines.lkp01f [] loaded) {verification = Unverified}

-- | A program with a @units@ statement on the line below its @part@ statement.
withUnits :: Text -> Text -> Text
withUnits unit text = Text.unlines (above <> take 1 below <> ["units " <> unit] <> drop 1 below)
  where
    (above, below) = break ("part " `Text.isPrefixOf`) (Text.lines text)

-- | A program in which each number without a unit that is a length has the unit @in@, and each that
-- is a feed the unit @in/min@. A number is a length if the program is right with a length in its
-- place, and wrong with an angle. Where a product leaves it open which factor is a length, the
-- first one is taken for it, and the others are written as plain numbers. @load@ makes a program of
-- a text.
inInches :: (Text -> LoadedProgram) -> Text -> Text
inInches load text = atNumbers open (atNumbers certain text)
  where
    certain written
      | isSound (written "" " deg") = Nothing
      | otherwise = find isSound [written "" " in", written "" " in/min"]
    open written =
      find
        isSound
        [written "(" " mm / 1 mm)", written "" " in", written "(" " * 1 in * 1 in)"]
    isSound t = case LoadedProgram.surface (load t) of
      Result {errors = [], output = Just p} -> null (errors (checked p))
      _ -> False
    checked p = Checked.check p :: Result () Checked.Error Checked.Program

-- | Changes the numbers of a text, from the last to the first. Numbers with a unit and zeros are
-- left as they are. @change@ gets a function that writes texts before and after a number.
atNumbers :: ((Text -> Text -> Text) -> Maybe Text) -> Text -> Text
atNumbers change text = foldl step text (reverse (sort places))
  where
    step t (Region from to) =
      let (above, rest) = Text.splitAt from t
          (digits, below) = Text.splitAt (to - from) rest
       in fromMaybe t (change (\a b -> above <> a <> digits <> b <> below))
    places =
      [ place t
        | t <- fst (Lexer.tokens 0 text),
          Number n Nothing <- [shape t],
          amount n /= 0
      ]

-- Random expressions ------------------------------------------------------------------------------

-- | A text without units, and the same text with the unit @in@ after its lengths.
data Doubled = Doubled {bare :: Text, annotated :: Text}

instance Semigroup Doubled where
  Doubled a b <> Doubled c d = Doubled (a <> c) (b <> d)

instance Monoid Doubled where
  mempty = Doubled "" ""

same :: Text -> Doubled
same t = Doubled t t

-- | A program that moves to points with random coordinates.
arithmetic :: Gen Doubled
arithmetic = do
  a <- literal
  b <- literal
  c <- literal
  d <- literal
  points <- vectorOf 3 ((,) <$> lengthOf 3 <*> lengthOf 2)
  pure . mconcat . map (<> same "\n") $
    [ same "part p",
      same "machine iso6983",
      same "feed 100 mm/min",
      same "let a = " <> a,
      same "param b = " <> b,
      same "let grown(x) = x + " <> c,
      same "let twice(x) = 2 * x",
      same "let times(x, n) = x * n",
      same "let several = [" <> d <> same ", a, b]",
      same "from (0, 0)"
    ]
      -- The summand keeps the coordinates away from the middle between two pulses, where the
      -- order of two multiplications would decide the frame.
      <> [ same "move (a - a + " <> x <> same " + 0.000137 in, " <> y <> same " + 0.000137 in)"
           | (x, y) <- points
         ]

-- | A length.
lengthOf :: Int -> Gen Doubled
lengthOf depth
  | depth <= 0 = oneof [literal, same <$> elements ["a", "b", "item_of(several, 2)"]]
  | otherwise =
    oneof
      [ infix' " + " <$> part <*> part,
        infix' " - " <$> part <*> part,
        (\x -> same "-" <> enclosed x) <$> part,
        infix' " * " <$> number <*> part,
        infix' " * " <$> part <*> number,
        (\x -> enclosed x <> same " / 4") <$> part,
        (\x y -> same "max(" <> x <> same ", " <> y <> same ")") <$> part <*> part,
        (\x -> same "sqrt(b * b + " <> enclosed x <> same " * " <> enclosed x <> same ")") <$> part,
        (\x y z -> same "(if a < " <> x <> same " then " <> y <> same " else " <> z <> same ")")
          <$> part <*> part <*> part,
        (\f x -> same f <> enclosed x) <$> elements ["grown", "twice", "abs"] <*> part,
        (\x n -> same "times(" <> x <> same ", " <> n <> same ")") <$> part <*> number,
        (\x y -> same "distance((0, " <> x <> same "), (" <> y <> same ", b))") <$> part <*> part,
        (\x -> enclosed x <> same " * sin(30)") <$> part
      ]
  where
    part = lengthOf (depth - 1)

-- | A plain number.
number :: Gen Doubled
number =
  oneof
    [ same <$> elements ["2", "0.5", "count_of(several)", "3"],
      (\x -> same x <> same " / (b + " <> Doubled "5" "5 in" <> same ")")
        <$> elements ["a", "b", "item_of(several, 2)"]
    ]

-- | A length of up to ten units.
literal :: Gen Doubled
literal = do
  hundredths <- choose (1, 999 :: Int)
  let digits = Decimal.short 2 (fromIntegral hundredths / 100)
  pure (Doubled digits (digits <> " in"))

infix' :: Text -> Doubled -> Doubled -> Doubled
infix' operator a b = enclosed a <> same operator <> enclosed b

enclosed :: Doubled -> Doubled
enclosed x = same "(" <> x <> same ")"
