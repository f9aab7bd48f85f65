-- | Reading statements by their keys: what a section may hold, what it has to hold, and what each
-- line says.
module Machine.Section
  ( Section (..),

    -- * Keys
    known,
    required,
    optional,
    every,

    -- * Lines
    plain,
    opened,
    malformed,
    keyText,

    -- * Numbers
    wholeIn,
    amountIn,
    choice,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name qualified as Name
import Base.Region (Located (..), Region)
import Base.Result (Result (..))
import Base.Result qualified as Result
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.Error (Error (..))
import Machine.Syntax

-- | The statements of a block, or of the whole file.
data Section = Section
  { -- | in the words of a report: @the tape@
    what :: Text,
    -- | where a report about what is missing points
    place :: Region,
    entries :: [Statement]
  }

-- Keys --------------------------------------------------------------------------------------------

-- | Report every key that is none of these, and every second statement of one of the first list.
known :: [Text] -> [Text] -> Section -> Result w Error ()
known once often section = Result.failing (concat (zipWith fault [0 ..] (entries section))) ()
  where
    fault k s = case keyWord s of
      Just w
        | w `elem` often -> []
        | w `elem` once ->
          [ Twice (region (key s)) (quoted w) (region (key first))
            | first <- take 1 (named w (take k (entries section)))
          ]
      _ -> [UnknownKey (region (key s)) (keyText s) (what section) (once <> often)]
    quoted w = "‘" <> w <> "’"

-- | The statement with a key; the form shows how it is written where it is missing. A key that was
-- meant to be this one is reported as unknown, and that is enough.
required :: Text -> Text -> (Statement -> Result w Error a) -> Section -> Result w Error a
required word form f section = case named word (entries section) of
  s : _ -> f s
  []
    | or
        [ not (null (Name.nearest w [word] <> Name.lookAlike w [word]))
          | s <- entries section,
            Just w <- [keyWord s]
        ] ->
      silent
    | otherwise -> Result.failed (Missing (place section) (what section) word form)

-- | The statement with a key, or what holds without it.
optional :: Text -> a -> (Statement -> Result w Error a) -> Section -> Result w Error a
optional word absent f section = case named word (entries section) of
  s : _ -> f s
  [] -> pure absent

-- | All statements with a key.
every :: Text -> (Statement -> Result w Error a) -> Section -> Result w Error [a]
every word f section = traverse f (named word (entries section))

named :: Text -> [Statement] -> [Statement]
named word ss = [s | s <- ss, keyWord s == Just word]

-- Lines -------------------------------------------------------------------------------------------

-- | A line with arguments only; the forms are the ways to write it. Nothing fits another number of
-- arguments.
plain :: [Text] -> ([Argument] -> Maybe (Result w Error a)) -> Statement -> Result w Error a
plain forms f s
  | broken s = silent
  | Just r <- f (arguments s), Nothing <- formula s, Nothing <- block s = r
  | otherwise = malformed forms s

-- | A line with a block: what its arguments say, and the section.
opened ::
  [Text] ->
  Text ->
  ([Argument] -> Maybe (Result w Error a)) ->
  Statement ->
  Result w Error (a, Section)
opened forms title f s = case block s of
  _ | broken s -> silent
  Just ss
    | Just r <- f (arguments s),
      Nothing <- formula s ->
      (,Section {what = title, place = told s, entries = ss}) <$> r
  _ -> malformed forms s

malformed :: [Text] -> Statement -> Result w Error a
malformed forms s = Result.failed (Malformed (told s) (keyText s) forms)

-- | Reported already.
silent :: Result w e a
silent = Result [] [] Nothing

-- | The key as a report names it.
keyText :: Statement -> Text
keyText s = case value (key s) of
  Word w -> w
  Quoted t -> t
  Number t _ -> t
  Range a b -> Decimal.whole a <> ".." <> Decimal.whole b
  Bit name k -> name <> ":" <> Decimal.whole k
  Dash -> "-"

-- Numbers -----------------------------------------------------------------------------------------

-- | A whole number between two.
wholeIn :: Text -> Int -> Int -> Argument -> Maybe (Result w Error Int)
wholeIn name low high a = case value a of
  Number t v
    | Text.any (== '.') t -> Nothing
    | v < fromIntegral low || v > fromIntegral high ->
      Just (Result.failed (OutOfRange (region a) name (Decimal.whole low) (Decimal.whole high)))
    | otherwise -> Just (pure (round v))
  _ -> Nothing

-- | A number above 0 with its unit, up to a largest.
amountIn :: Text -> Text -> Double -> Argument -> Argument -> Maybe (Result w Error Double)
amountIn name unit high a b = case (value a, value b) of
  (Number _ v, Word u)
    | u /= unit -> Nothing
    | v < smallest || v > high ->
      Just
        (Result.failed (OutOfRange (region a) name (Decimal.exact smallest) (Decimal.exact high)))
    | otherwise -> Just (pure v)
  _ -> Nothing

-- | No length and no feed of a machine is less.
smallest :: Double
smallest = 0.000001

-- | A line with one of some words.
choice :: [(Text, a)] -> Statement -> Result w Error a
choice table s = plain [keyText s <> " " <> w | (w, _) <- table] one s
  where
    one args = case map value args of
      [Word w] -> pure <$> lookup w table
      _ -> Nothing
