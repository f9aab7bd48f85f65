; The colours of part programs, for tree-sitter's own highlighter, Neovim, Helix and Zed.
; No node is coloured by two patterns, because the editors differ in which of the two wins.

(comment) @comment
(text) @string
(number) @constant.numeric
(unit) @type
(constant) @constant.builtin
(machine_name) @constant

; The words that begin statements
[
  "part" "units" "machine" "import" "tool" "feed" "tolerance" "clearance" "from"
  "let" "param" "table" "curve" "piece" "contour" "assert"
  "mill" "turn" "pocket" "face" "engrave" "vcarve" "drill" "rapid" "move" "change" "spindle" "coolant" "aux" "with"
  "work" "program" "safe" "stock" "avoid" "contours" "stop" "optional" "dwell"
  "spot" "ream" "countersink" "counterbore" "bore" "tap" "thread"
] @keyword

; Repetition and choice
[ "for" "in" "by" ] @keyword.repeat
[ "if" "then" "else" ] @keyword.conditional
[ "and" "or" "not" ] @keyword.operator

; Contours and pieces
[
  "open" "closed" "cw" "ccw"
  "meet" "near" "smooth" "tangent" "fillet" "chamfer" "slow" "bevel"
  "cipher" "joggle" "to" "radius"
  "left" "right" "inside" "outside" "within" "first" "last"
] @keyword

; Machining
[
  "on" "off" "at" "step"
  "approach" "retract" "depth" "lead" "out" "line" "arc" "allowance" "corners" "round" "sharp"
  "compensation" "compiler" "controller" "start" "plunge" "ramp" "helix" "pitch" "tabs" "tab" "width"
  "peck" "islands" "rest" "allowed" "angle" "of" "as"
  "diameter" "nose" "cone" "vbit" "blade" "height" "gear" "flutes" "stickout" "holder" "tip"
  "manual" "limit" "s" "chip" "break" "pitch" "angle" "hand" "threadmill"
  "direction" "around" "align" "centre" "text"
  "layer" "id" "class" "unit"
] @keyword
(floating) @keyword
(climb) @keyword
(shortest) @keyword
(spiral) @keyword
(conventional) @keyword

; Definitions
(part name: (name) @module)
(let name: (name) @function parameters: (parameters))
(let name: (name) @variable !parameters)
(parameters (name) @variable.parameter)
(param name: (name) @variable)
(table name: (name) @variable)
(curve name: (name) @variable)
(piece name: (name) @variable)
(contour name: (name) @variable)
(pocket name: (name) @variable)
(for name: (name) @variable)
(comprehension name: (name) @variable)
(heading name: (name) @property)

(call function: (name) @function)

; Signs
[ "=" "!=" "<" "<=" ">" ">=" "+" "-" "*" "/" ".." ] @operator
[ "(" ")" "[" "]" "{" "}" ] @punctuation.bracket
"," @punctuation.delimiter
