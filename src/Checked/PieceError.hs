{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Mistakes in tables and pieces, and their reports.
--
-- A piece is a curve that is shifted by ciphers, as in the Minsk-22 system. A cipher is a digit, 1,
-- 2, 4 or 6, with values: the digit says by which rule the values give the distance of the shift.
module Checked.PieceError
  ( PieceError (..),
    toReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.Name qualified as Name
import Base.Region (Region (..))
import Checked.ErrorFix qualified as ErrorFix
import Checked.Type (Type)
import Checked.Type qualified as Type
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), at, quote)

-- | A mistake in a table or a piece. The first field of every constructor is the region that the
-- report points at. The comment of a constructor names the other fields in order.
data PieceError
  = -- | a table whose first line does not name the columns: the number of cells in this line
    HeadingsMissing Region Int
  | -- | a column of coordinates with a unit of another dimension: the name of the column, its type,
    -- and the type of its unit
    CoordinateUnit Region Name Type Type
  | -- | a text in a column of values: the name of the column, and true if the column gives points
    TextAsValue Region Name Bool
  | -- | headings below the first line of a table: the regions of the names
    HeadingsRepeated Region [Region]
  | -- | a column whose name an earlier column has: the name, and the region of that column
    ColumnTwice Region Name Region
  | -- | a table without a column of coordinates: the name of the missing column, those of all
    -- columns that give these coordinates, and the columns of the table
    ColumnMissing Region Name [Name] [(Region, Name)]
  | -- | a column of polar coordinates beside columns of others: its name, and these columns
    CoordinatesMixed Region Name [(Region, Name)]
  | -- | a row of the wrong length: the number of the row from 1, the number of columns, the number
    -- of cells in the row, and their regions, if they are in the text of the program
    RowLength Region Int Int Int [Region]
  | -- | an unknown cipher: its digit, the region of the cipher, and those of its values
    NoSuchCipher Region Text Region [Region]
  | -- | a cipher with a wrong number of values: the digit of the cipher, the region of the digit,
    -- and those of the values
    CipherMisfit Region Text Region [Region]
  | -- | a name that is neither a column of the curve's table nor a name in scope, in an expression
    -- whose value may vary along the curve: the name, and the columns
    NoColumn Region Name [Text]
  | -- | the name of a column in an expression that must have one value for the whole piece: the
    -- digit of the cipher, its region, and the column
    ColumnForWholePiece Region Text Region Name
  deriving stock (Eq, Show)

-- | The report of a mistake.
toReport :: PieceError -> Report
toReport err = case err of
  HeadingsMissing region cells ->
    (at region "E0224" "the first line of this table does not name the columns")
      { fixes =
          [ Fix.proposed
              (Fix.insertion ("Name the columns: " <> names) (start region) (names <> "\n"))
            | cells >= 2,
              let names = Text.unwords ("x" : "y" : ["c" <> Decimal.whole k | k <- [3 .. cells]])
          ],
        hints = ["Write the names of the columns above the numbers, for example: x y mu deg H"]
      }
  CoordinateUnit region (Name name) wanted t ->
    ( at
        region
        "E0205"
        ( Text.concat
            [ "the column ",
              quote name,
              " is ",
              Type.describe wanted,
              ", but its unit is that of ",
              Type.describe t
            ]
        )
    )
      { hints =
          [ Text.concat
              [ "Write ",
                name,
                if wanted == Type.angle then " deg" else " mm",
                ", or leave the unit out."
              ]
          ]
      }
  TextAsValue region (Name name) givesPoints ->
    (at region "E0205" ("the column " <> quote name <> " holds values, but this is a text"))
      { hints =
          [ if givesPoints
              then "Write a number. It gives the point of the row."
              else "A column holds either values or texts. Write a number, or only texts in it."
          ]
      }
  HeadingsRepeated region names ->
    (at region "E0224" "the columns of this table are named already")
      { fixes =
          [ Fix.proposed
              ( Fix.joined
                  "Write brackets around the values in words."
                  [Fix.enclosure "" "(" r ")" | r <- names]
              ),
            Fix.proposed (Fix.removal "Leave the line out." region)
          ]
      }
  ColumnTwice region (Name name) before ->
    (at region "E0225" ("the table has two columns " <> quote name))
      { others = [Label before "the first one"],
        fixes =
          [ Fix.proposed (Fix.exchange ("Name the second one " <> new <> ".") region new)
            | let new = name <> "_2"
          ]
      }
  CoordinatesMixed region (Name name) others ->
    ( at
        region
        "E0225"
        ( Text.concat
            [ "the column ",
              quote name,
              " does not go together with ",
              Text.intercalate " and " [quote other | (_, Name other) <- others]
            ]
        )
    )
      { others = [Label r ("the column " <> quote other) | (r, Name other) <- others],
        hints =
          [ "The points of a table are given either by x and y, or by angle and radius. Name the \
            \columns that do not give points otherwise."
          ]
      }
  ColumnMissing region (Name name) coordinates columns ->
    (at region "E0225" ("the table has no column " <> quote name))
      { fixes =
          [ Fix.proposed
              ( Fix.exchange
                  ("Rename the column " <> quote old <> " to " <> name <> ".")
                  r
                  name
              )
            | (k, (r, Name old)) <- zip [0 ..] columns,
              Name old `notElem` coordinates,
              Name old `notElem` map snd (take k columns)
          ],
        hints =
          [ "Every table has columns x and y, or angle and radius; others may follow."
            | null [old | (_, old) <- columns, old `notElem` coordinates]
          ]
      }
  RowLength region number columns cells written ->
    ( at
        region
        "E0226"
        ( "row "
            <> Decimal.whole number
            <> " has "
            <> counted cells "cell"
            <> ", but the table has "
            <> counted columns "column"
        )
    )
      { fixes =
          [ Fix.proposed
              (Fix.removal "Leave out what is too much." (Region (end kept) (end surplus)))
            | kept : _ <- [reverse (take columns written)],
              surplus : _ <- [reverse (drop columns written)]
          ],
        hints =
          [ "A row is one line with a value for each column. What is no plain number is in \
            \brackets: (2 * h)."
          ]
      }
  NoSuchCipher region digit whole values ->
    (at region "E0227" ("there is no cipher " <> digit))
      { message =
          [ "This was control stop 14441 of the Minsk-22 system: the cipher is not provided \
            \for."
          ],
        fixes =
          [ fix
            | isSeveralCiphers digit,
              fix <- ErrorFix.cipherFixes whole digit region values []
          ],
        hints =
          [ "One digit at a time: cipher "
              <> Text.intercalate ", " [Text.singleton d <> "(…)" | d <- Text.unpack digit]
            | isSeveralCiphers digit
          ]
            <> [ "The ciphers are 1 (a distance that changes uniformly), 2 (one distance), 4 \
                 \(bevel and height), 6 (a distance at each point)."
               ]
      }
  CipherMisfit region digit digitRegion values ->
    ( at
        region
        "E0228"
        ("cipher " <> digit <> " does not work with " <> counted (length values) "value")
    )
      { message =
          [ "This was control stop 14623 of the Minsk-22 system: the piece has no data for \
            \the cipher."
          ],
        fixes =
          ErrorFix.cipherFixes
            region
            digit
            digitRegion
            values
            (map ((+ 1) . Text.count ",") (cipherForms digit)),
        hints = ["Write " <> Text.intercalate ", or " (cipherForms digit) <> "."]
      }
  ColumnForWholePiece region digit digitRegion (Name name) ->
    ( at
        region
        "E0228"
        ( "cipher "
            <> digit
            <> " takes one value here for the whole piece, and "
            <> quote name
            <> " is a column"
        )
    )
      { message =
          [ "This was control stop 14623 of the Minsk-22 system: the piece has no data for \
            \the cipher."
          ],
        fixes =
          [ Fix.proposed
              (Fix.exchange "Write cipher 6: a distance at each point." digitRegion "6")
            | digit == "2"
          ]
      }
  NoColumn region (Name name) columns ->
    (at region "E0229" ("the curve has no column " <> quote name))
      { message =
          [ "This was control stop 14623 of the Minsk-22 system: the piece has no data for \
            \the cipher."
          ],
        fixes =
          [ Fix.exchange ("Write " <> quote w <> ".") region w
            | w <- take 1 (Name.nearest name columns)
          ],
        hints = case (Name.nearest name columns, columns) of
          (_ : _, _) -> []
          ([], []) ->
            [ "Only a curve through a table with more columns than x and y has values at its \
              \points; the first line of the table names them."
            ]
          ([], _) -> ["Its columns are " <> Text.intercalate ", " columns <> "."]
      }

-- | Does a number such as @24@ consist of the digits of several ciphers, written as one word?
isSeveralCiphers :: Text -> Bool
isSeveralCiphers digit = Text.length digit > 1 && Text.all (`elem` ['1', '2', '4', '6']) digit

-- | The ways to write the cipher with the given digit, for hints.
cipherForms :: Text -> [Text]
cipherForms digit = case digit of
  "1" ->
    [ "1(from, to)",
      "1(from, to, mu)",
      "1(from, to, start_point, end_point)",
      "1(from, to, mu, start_point, end_point)"
    ]
  "2" -> ["2(distance)", "2(distance, mu)"]
  "4" -> ["4(mu, height)", "4(mu, height, allowance)"]
  _ -> ["6(distance)", "6(distance, mu)"]

counted :: Int -> Text -> Text
counted n thing = Decimal.whole n <> " " <> thing <> (if n == 1 then "" else "s")
