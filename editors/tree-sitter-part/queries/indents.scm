; The indentation of text in brackets. Each editor takes the captures that it knows:
; Helix @indent and @outdent, Zed @indent and @end, Neovim those with a point.

(_ "{" "}" @outdent @end @indent.branch) @indent @indent.begin
(_ "[" "]" @outdent @end @indent.branch) @indent @indent.begin
(_ "(" ")" @outdent @end @indent.branch) @indent @indent.begin
