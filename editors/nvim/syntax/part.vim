" Part programs of partc.
if exists('b:current_syntax')
  finish
endif

" Names may be Cyrillic.
syntax iskeyword @,48-57,_,192-255,1024-1279

syntax match partComment /--.*/ contains=@Spell
syntax region partText start=/"/ end=/"/ oneline contains=@Spell
syntax match partNumber /\<\d\+\(\.\d\+\)\?/
syntax keyword partStatement part machine tool feed tolerance from let contour mill rapid move
syntax keyword partRepeat for in
syntax keyword partWalk cw ccw open closed
syntax keyword partLink meet near smooth tangent fillet chamfer
syntax keyword partMilling outside inside left right on approach retract diameter
syntax keyword partFunction pi polar circle line distance sin cos tan asin acos atan2 sqrt abs min max floor
syntax match partUnit /\(\d\s*\)\@<=\(mm\|cm\|m\|in\)\(\/min\)\?\>/
syntax match partUnit /\(\d\s*\)\@<=\(deg\|rad\)\>/

highlight default link partComment Comment
highlight default link partText String
highlight default link partNumber Number
highlight default link partStatement Statement
highlight default link partRepeat Repeat
highlight default link partWalk Keyword
highlight default link partLink Keyword
highlight default link partMilling Keyword
highlight default link partFunction Function
highlight default link partUnit Type

let b:current_syntax = 'part'
