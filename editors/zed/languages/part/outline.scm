; The definitions of a program, for Zed's outline.

(part "part" @context name: (name) @name) @item
(let "let" @context name: (name) @name) @item
(param "param" @context name: (name) @name) @item
(table "table" @context name: (name) @name) @item
(curve "curve" @context name: (name) @name) @item
(piece "piece" @context name: (name) @name) @item
(contour "contour" @context name: (name) @name) @item
