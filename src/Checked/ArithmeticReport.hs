{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | The reports of calculations that other languages allow: sums of points, and feeds per
-- revolution or per second.
module Checked.ArithmeticReport
  ( unitDivisors,
    bareCoordinatesReport,
    cuttingSpeedReport,
    bareCuttingSpeedReport,
    commaMissingReport,
    radiansReport,
    pointsAddedReport,
    unknownUnitReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Quantity (LengthUnit (..))
import Base.Region (Region (..))
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Fix qualified as Fix
import Report.Report (Label (..), Report (..), at, quote)
import Surface.Token (Numeral (digits), Unit, scaledDigits, unitName)

-- | Words after the stroke of a feed that the language does not have.
unitDivisors :: [Text]
unitDivisors = secondWords <> revolutionWords <> toothWords

secondWords, revolutionWords, toothWords :: [Text]
secondWords = Text.words "s sec second seconds"
revolutionWords = Text.words "rev revolution turn r u об"
toothWords = Text.words "tooth t z flute teeth"

-- | The report of a constant cutting speed without a limit.
cuttingSpeedReport :: Region -> Report
cuttingSpeedReport region =
  (at region "E0364" "a cutting speed needs a limit for the speed of the spindle")
    { message =
        [ "Near the axis a constant cutting speed asks for any speed of the spindle, and the chuck \
          \may lose the part."
        ],
      hints = ["Write the largest speed after it, as in ‘spindle cw 180 m/min limit 2500 rpm’."]
    }

-- | The report of a cutting speed without a unit.
bareCuttingSpeedReport :: LengthUnit -> Region -> Report
bareCuttingSpeedReport unit region =
  (at region "E0365" "this cutting speed has no unit")
    { message =
        [ "A number without a unit would be taken for " <> Decimal.unitText unit <> "/min here."
        ],
      fixes = [Fix.insertion ("Write its unit: " <> usual <> ".") (end region) (" " <> usual)]
    }
  where
    usual = case unit of
      Millimetres -> "m/min"
      Inches -> "ft/min"

-- | The report of the coordinates of a point without its brackets.
bareCoordinatesReport :: Region -> Report
bareCoordinatesReport region =
  (at region "E0205" "the coordinates of a point are in brackets")
    { fixes = [Fix.enclosure "Write the point in brackets: (x, y)." "(" region ")"]
    }

-- | The report of the coordinates of a point without the comma between them.
commaMissingReport :: Region -> Int -> Report
commaMissingReport region offset =
  (at region "E0205" "this is a difference of two numbers, but a point is needed here")
    { fixes = [Fix.insertion "Write a comma between the coordinates: (x, y)." offset ","]
    }

-- | The report of a number of radians without a unit, which would be taken for degrees.
radiansReport :: Region -> Report
radiansReport region =
  (at region "E0205" "this number of radians is taken for degrees, since it has no unit")
    { label = "without a unit, an angle is in degrees",
      fixes = [Fix.enclosure "Write it in radians: (…) * 1 rad." "(" region ") * 1 rad"]
    }

-- | The report of a sum of points.
pointsAddedReport :: Region -> Region -> Region -> Maybe Region -> Report
pointsAddedReport region left right half =
  (at region "E0205" "two points cannot be added")
    { others = [Label left "a point", Label right "a point"],
      fixes =
        [ Fix.joined
            "Write the point between them: midpoint(p, q)."
            [ if start whole < start left - 1
                then Fix.exchange "" (Region (start whole) (start left)) "midpoint("
                else Fix.insertion "" (start left) "midpoint(",
              Fix.exchange "" (Region (end left) (start right)) ", ",
              if end whole > end right
                then Fix.exchange "" (Region (end right) (end whole)) "))"
                else Fix.insertion "" (end right) ""
            ]
          | Just whole <- [half]
        ],
      hints =
        [ "A point and a vector can be added: p + (10, 0). The vector from p to q is q - p."
          | Nothing <- [half]
        ]
    }

-- | The report of a feed per revolution, per tooth or per second.
unknownUnitReport :: Region -> Numeral -> Unit -> Text -> Maybe Double -> Report
unknownUnitReport region n unit word known =
  (at region "E0201" (quote (unitName unit <> "/" <> word) <> " is no unit of the language"))
    { message = ["A feed is given for a minute or a turn: mm/min, m/min, in/min, mm/rev, in/rev."],
      fixes =
        [ Fix.exchange ("Write " <> perMinute 60 <> ".") region (perMinute 60)
          | word `elem` secondWords
        ]
          <> [ Fix.exchange
                 ("Write " <> perTurn <> ", if it is the feed of a statement.")
                 region
                 perTurn
               | word `elem` revolutionWords,
                 word /= "rev"
             ]
          <> [ Fix.proposed
                 ( Fix.exchange
                     ( "Write " <> perMinute speed <> ": the feed per revolution times the "
                         <> Decimal.short 3 speed
                         <> " turns a minute of the spindle."
                     )
                     region
                     (perMinute speed)
                 )
               | word `elem` revolutionWords,
                 Just speed <- [known]
             ],
      hints =
        [ "Write the feed per minute: " <> digits n <> " " <> unitName unit
            <> " times the turns a minute of the spindle."
          | word `elem` revolutionWords,
            Nothing <- [known]
        ]
          <> [ "Multiply the feed per tooth by the count of teeth and by the speed of the spindle."
               | word `elem` toothWords
             ]
    }
  where
    perTurn = digits n <> " " <> unitName unit <> "/rev"
    perMinute factor = scaledDigits factor n <> " " <> unitName unit <> "/min"
