; The indentation of text in brackets. Each editor takes the captures that it knows:
; Helix @indent and @outdent, Zed @indent and @end, Neovim those with a point.

[
  (statements)
  (items)
  (rows)
  (settings)
  (list)
  (comprehension)
  (arguments)
] @indent @indent.begin

[ "}" "]" ")" ] @outdent @end @indent.branch
