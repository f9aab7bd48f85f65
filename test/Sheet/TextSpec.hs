-- | Laws of input sheets as text and as part programs.
module Sheet.TextSpec (spec) where

import Base.Result (Result (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Generate.Sheet qualified as Generate
import Sheet.Error (Error)
import Sheet.FromText qualified as FromText
import Sheet.Sheet (Sheet)
import Sheet.ToSurface qualified as ToSurface
import Sheet.ToText qualified as ToText
import Surface.Error qualified as Surface
import Surface.Formatter qualified as Formatter
import Surface.Parser qualified as Parser
import Surface.Syntax qualified as Surface
import Surface.Unlocated qualified as Unlocated
import Test.Hspec
import Test.Hspec.QuickCheck (prop)
import Test.QuickCheck hiding (Result (..))

spec :: Spec
spec = do
  describe "a sheet as text" $ do
    -- Catches a number that reader and writer put at different positions.
    prop "has every number at the same position after writing and reading" $
      forAll Generate.sheet $ \s ->
        let text = ToText.write s
            Result {errors, output} = FromText.read text :: Result () Error Sheet
         in counterexample (Text.unpack text) $
              errors === [] .&&. fmap ToText.write output === Just text
    -- Catches a meaning that depends on the layout of the sheet.
    prop "has the same meaning with other spaces and line ends" $
      forAll Generate.sheet $ \s ->
        let text = ToText.write s
         in meaning (Text.unwords (Text.words text))
              === meaning text .&&. meaning (Text.intercalate "\r\n\t " (Text.words text))
              === meaning text
  describe "a sheet as a program" $ do
    -- Catches a number that the program rounds, and a name or a sign that is read differently.
    prop "has the same syntax tree if the program is written as text and parsed" $
      forAll Generate.sheet $ \s ->
        let text = ToSurface.text s
            Result {errors, output} = Parser.parse 0 text :: Result () Surface.Error Surface.Program
         in counterexample (Text.unpack text) $
              errors
                === [] .&&. fmap (Unlocated.statements . Surface.statements) output
                === Just (Unlocated.statements (Surface.statements (ToSurface.program s)))
    prop "is in the canonical layout" $
      forAll Generate.sheet $ \s ->
        let text =
              ToSurface.text s
         in Formatter.format text === Just text
  where
    meaning :: Text -> Maybe Text
    meaning t = fmap ToText.write (output (FromText.read t :: Result () Error Sheet))
