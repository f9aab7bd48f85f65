{-# OPTIONS_GHC -O0 -fno-ignore-interface-pragmas #-}

-- | Words of other languages and of the shop, with the words of part programs that mean the same.
module Surface.WordMeaning
  ( meaningsOf,
    fillers,
    typeWords,
    statementMeant,
  )
where

import Data.Text (Text)
import Data.Text qualified as Text

-- | The words of part programs that a word may mean, the most likely one first. A meaning may have
-- several words, separated by spaces.
meaningsOf :: Text -> [Text]
meaningsOf word = [new | (new, olds) <- meanings, Text.toLower word `elem` olds]

meanings :: [(Text, [Text])]
meanings =
  [ (new, Text.words olds)
    | (new, olds) <-
        [ ("outside", "outer out outward outwards exterior external externally around снаружи"),
          ("inside", "inner in inward inwards interior internal internally within внутри"),
          ("left", "g41 leftside слева"),
          ("right", "g42 rightside справа"),
          ("on", "along centre center central middle start true yes enabled enable flood mist"),
          ("off", "stop false no none disabled disable"),
          ("manual", "manually hand by_hand handwheel"),
          ("stop", "halt pause hold m0 m00 m1 m01"),
          ("s", "sec secs second seconds"),
          ("tip", "direction orientation quadrant"),
          ("limit", "max maximum clamp up_to most highest"),
          ("cw", "clockwise right m3 m03 forward cwise"),
          ("ccw", "counterclockwise anticlockwise counter_clockwise acw ccwise left m4 m04"),
          ("closed", "close loop cyclic"),
          ("open", "opened unclosed"),
          ("diameter", "dia d width ø size diam"),
          ("nose", "tip radius r corner"),
          ("mill", "endmill end_mill milling cutter router flatmill em"),
          ("drill", "drillbit bit twist_drill borer"),
          ("turn", "lathe insert turning"),
          ("at", "on in through to from @ points"),
          ("depth", "deep to z down by thickness"),
          ( "step",
            "by stepdown stepover step_over step_down stepsize per every doc ap \
            \depth_of_cut woc ae width_of_cut"
          ),
          ("near", "at from by close"),
          ("line", "linear straight tangent"),
          ("arc", "circle circular round radius quarter"),
          ("in", "into entry of from over inch inches imperial zoll дюйм дюймы"),
          ("mm", "metric millimetre millimetres millimeter millimeters"),
          ("out", "exit outof"),
          ("..", "to until through thru till upto"),
          ("by", "step"),
          ("controller", "control cnc g41 g42 machine left right on"),
          ("compiler", "off none software cam"),
          ("round", "rounded arc smooth fillet rolling"),
          ("sharp", "mitre miter corner chamfer square pointed"),
          ("lead in", "leadin lead_in entry entrance"),
          ("lead out", "leadout lead_out exit"),
          ("start near", "start_at startpoint start_point startat near"),
          ("approach", "enter from"),
          ("retract", "leave withdraw"),
          ("depth", "deep thickness"),
          ("depth", "z"),
          ("allowance", "stock leave finish finishing offset"),
          ("climb", "down downcut down_cut"),
          ("conventional", "up upcut up_cut"),
          ("peck", "pecks pecking q"),
          ("shortest", "short shorter optimal optimise optimize sort sorted tsp nearest"),
          ("plunge", "plungefeed plunge_feed feedz fz"),
          ("ramp", "ramping slope incline zigzag"),
          ("helix", "helical helixes corkscrew"),
          ("spiral", "spiralling continuous"),
          ("tabs", "bridge bridges holding_tabs holdingtabs"),
          ("pitch", "rise lead"),
          ("width", "wide broad"),
          ("height", "high tall thickness"),
          ("islands", "island"),
          ("corners", "corner"),
          ("compensation", "comp radius_compensation"),
          ("rest allowed", "allow_rest"),
          ("cipher", "ciphers code"),
          ("else if", "elif elseif elsif"),
          ("near", "nearest closest"),
          ("from", "between"),
          ("rapid", "fast g0 g00"),
          ("slow", "slowly"),
          ("fillet", "radius round rounded blend r"),
          ("chamfer", "bevelled cham"),
          ("tangent", "tangential tan"),
          ("smooth", "smoothly g1")
        ]
  ]

-- | Words that say nothing where they are too many.
fillers :: [Text]
fillers =
  Text.words
    "at of by is with side to the a an set tool number no nr as on contour milling mode and radius \
    \value speed each every all then do direction point points distance feed let from for length \
    \tolerance cutting name named equal equals only use be size \
    \rate z height rpm mm to return"

-- | Words that say of which type a value is.
typeWords :: [Text]
typeWords = Text.words "float int double var real const val number string auto"

-- | The keyword of a statement, with further words of it, that a word at the start of a line may
-- mean.
statementMeant :: Text -> Maybe Text
statementMeant word = lookup (Text.toLower word) table
  where
    table =
      [ (old, new)
        | (new, olds) <-
            [ ("tool", "cutter toolchange"),
              ("change", "toolchange tool_change"),
              ("import", "include use using require"),
              ("contour", "profile shape path outline"),
              ("move", "goto line_to lineto linear g1"),
              ("rapid", "rapid_to fast g0 moveto"),
              ("feed", "feedrate feed_rate vf"),
              ("spindle cw", "speed rpm"),
              ("from", "start origin home startpoint start_point begin"),
              ("clearance", "clearance_height retract_height"),
              ("safe", "safez safe_z safeheight safe_height"),
              ("stock", "blank workpiece raw billet"),
              ("avoid", "keepout keep_out clamp forbid obstacle fixture"),
              ("work", "work_offset workoffset wcs offset"),
              ("stop", "halt pause hold m0 m00"),
              ("optional stop", "m1 m01 optional_stop opstop"),
              ("dwell", "wait delay sleep g4 g04"),
              ("tolerance", "accuracy precision tol"),
              ("part", "program name title"),
              ("machine", "controller control post postprocessor"),
              ("units in", "inch inches imperial"),
              ("units mm", "metric millimetres millimeters"),
              ("drill at", "hole holes bore drilling"),
              ("turn", "turning lathe"),
              ("mill", "milling cut"),
              ("pocket", "pocketing pocket_mill"),
              ("face", "facing face_mill facemill surfacing"),
              ("engrave", "text lettering letters etch scribe"),
              ("vcarve", "carve carving v_carve v_carving vcarving"),
              ("rest of", "rest_mill rest_milling restmill remachine"),
              ("coolant on", "flood m8 m08"),
              ("coolant off", "m9 m09"),
              ("spindle off", "m5 m05"),
              ("assert", "check ensure require"),
              ("let", "define constant set def function func fn " <> Text.unwords typeWords),
              ("param", "parameter input arg"),
              ("table", "data"),
              ("for", "foreach loop repeat")
            ],
          old <- Text.words olds
      ]
