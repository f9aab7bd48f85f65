{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | The report of lines of another language.
module Surface.ForeignReport
  ( foreignReport,
  )
where

import Base.Decimal qualified as Decimal
import Base.Region (Region)
import Data.Text (Text)
import Data.Text qualified as Text
import Report.Fix qualified as Fix
import Report.Report (Report (..), ReportPlace (..), Severity (..), quote, report)
import Surface.Foreign (ForeignLanguage (..), ForeignLine (translation, written))
import Surface.Foreign qualified as Foreign

-- | The report of lines of another language.
foreignReport :: Region -> ForeignLanguage -> [ForeignLine] -> Report
foreignReport region language ls =
  ( report
      Error
      "E0121"
      (InSource region)
      ( case ls of
          [_] -> "this line is " <> languageName language <> ", not a part program"
          _ ->
            Decimal.whole (length ls)
              <> " lines from here on are "
              <> languageName language
              <> ", not a part program"
      )
  )
    { message =
        [ quote (written l) <> " is written: " <> Text.replace "\n" "; " (translation l)
          | l <- take 3 translated
        ],
      fixes =
        [ Fix.proposed
            ( Fix.joined
                (allOfThem <> " in the language of part programs.")
                (map inOwn ls)
            )
          | not (null translated)
        ]
          <> [Fix.proposed (Fix.joined (comments <> ".") (map asComment ls))],
      hints = [languageHint language]
    }
  where
    translated = filter (not . Text.null . translation) ls
    allOfThem = if length ls == 1 then "Write the line" else "Write the lines"
    comments = if length ls == 1 then "Make the line a comment" else "Make the lines comments"
    asComment l = Fix.exchange "" (Foreign.place l) ("-- " <> written l)
    inOwn l
      | Text.null (translation l) = asComment l
      | otherwise = Fix.exchange "" (Foreign.place l) (translation l)

languageName :: ForeignLanguage -> Text
languageName language = case language of
  GCode -> "G-code"
  Apt -> "APT"
  C -> "C"
  Python -> "Python"
  Basic -> "Basic"

-- | The way in which programs say what is usual in another language.
languageHint :: ForeignLanguage -> Text
languageHint language = case language of
  GCode ->
    "A program describes the part, and partc computes the frames: write contour NAME closed { … } \
    \and mill NAME outside { … }."
  Apt ->
    "The elements of a contour follow one another in contour NAME open { … }; the cutter is led \
    \along it by mill NAME left { … }."
  C ->
    "A value gets its name with let NAME = …, and a statement ends with its line."
  Python ->
    "A function is let f(x) = …, and a repetition is for i in 0..9 { … }. Functions such as sin \
    \need no import."
  Basic ->
    "A value gets its name with let NAME = …, and a repetition is for i in 1..10 { … }."
