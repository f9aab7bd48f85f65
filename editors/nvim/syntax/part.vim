" Part programs of partc.
if exists('b:current_syntax')
  finish
endif

" Names may be Cyrillic.
syntax iskeyword @,48-57,_,192-255,1024-1279

syntax match partComment /--.*/ contains=@Spell
syntax region partText start=/"/ end=/"/ oneline contains=@Spell
syntax match partNumber /\<\d\+\(\.\d\+\)\?/
syntax keyword partStatement part machine import tool feed tolerance clearance from let param table curve piece contour assert
syntax keyword partStatement mill turn drill rapid move change spindle coolant aux with
" Names as well, but for where a statement begins.
syntax match partStatement /^\s*\zs\<\(pocket\|face\|vcarve\|work\|program\|safe\|stock\|avoid\|contours\|dwell\|spot\|ream\|countersink\|counterbore\|bore\|tap\|thread\)\ze\s\+[(-]\?\k/
syntax match partStatement /^\s*\zs\<rest\s\+of\ze\s/
syntax match partStatement /^\s*\zs\<engrave\ze\s\+"/
syntax match partStatement /\(^\s*engrave\s\+"[^"]*"\s\+\)\@<=at\>/
syntax match partStatement /\(^\s*contours\s.*\<text\s\+"[^"]*"\s\+\)\@<=at\>/
syntax match partStatement /\(^\s*\(engrave\|contours\)\s.*\)\@<=\<\(height\|direction\|around\|align\|centre\)\>/
syntax match partStatement /\(^\s*pocket\s.*\)\@<=\<as\ze\s/
syntax match partStatement /^\s*\zs\<\(optional\s\+\)\?stop\ze\s*\(--.*\)\?$/
syntax match partStatement /\(\<spindle\s\+\)\@<=manual\>/
syntax match partStatement /\(^\s*spindle\s.*\)\@<=\<limit\>/
syntax match partStatement /\(\<change\>.*)\s*\)\@<=at\>/
syntax match partStatement /\(^\s*dwell\s.*\)\@<=\<s\ze\s*\(--.*\)\?$/
syntax match partStatement /\(^\s*\(stock\|avoid\)\s.*\<from\>.*\)\@<=\<to\>/
syntax match partStatement /\(^\s*\(contours\?\|table\)\s.*\<from\s*".*\)\@<=\<\(layer\|id\|class\|unit\|text\)\ze\s/
syntax match partCutter /\(,\s*\)\@<=\(flutes\|stickout\|holder\|angle\|pitch\)\ze\s\+[(-]\?\k/
syntax match partCutter /\(,\s*holder\s\([^,()]\|([^()]*)\)*\)\@<=\<height\ze\s/
syntax match partCutter /\(\<\(turn\|vbit\)(.*,\s*\)\@<=tip\>/
syntax match partCutter /\(\<vbit(\)\@<=angle\>/
syntax match partStatement /^\s*\zs\<units\ze\s\+\(mm\|in\)\>/
syntax keyword partFunction region union difference offset_of outlines_of holes_of area_of centroid_of
syntax keyword partFunction rectangle bar rounded slot polygon ellipse gear
syntax match partUnit /\(^\s*units\s\+\)\@<=\(mm\|in\)\>/
syntax keyword partRepeat for in if then else and or not
syntax keyword partWalk cw ccw open closed
syntax keyword partLink meet near smooth tangent fillet chamfer slow bevel
syntax keyword partPiece cipher joggle within first last
syntax keyword partMilling outside inside left right on approach retract allowance
" Words that may be names as well, where they begin a setting.
syntax match partMilling /^\s*\zs\(depth\|lead\|corners\|climb\|conventional\|compensation\|start\|plunge\|peck\|chip\|dwell\|pitch\|hand\|floating\|shortest\|islands\|rest\|angle\|ramp\|helix\|spiral\|tabs\|tab\)\>/
syntax match partMilling /\(\<lead\s\+\)\@<=out\>/
syntax match partMilling /\(\<chip\s\+\)\@<=break\>/
" Words of the statements on holes.
syntax match partStatement /\(^\s*\(spot\|ream\|countersink\|counterbore\|bore\|tap\|thread\)\s\+at\s.*\)\@<=\<\(depth\|pitch\|angle\)\>/
syntax match partStatement /\(^\s*\(spot\|ream\|countersink\|counterbore\|bore\|tap\|thread\)\s\+\)\@<=at\>/
syntax match partCutter /\<\(tap\|threadmill\)\ze(/
syntax keyword partCutter cone vbit blade diameter
syntax keyword partFunction pi line true false polar intersection centre_of midpoint foot_of tangency point_on horizontal vertical
syntax keyword partFunction parallel perpendicular circle concentric distance direction_of radius_of length_of x_of y_of spline
syntax keyword partFunction closed_spline bezier bspline polyline parabola arcs closed_arcs fit sections rows_of points_of point_at_x point_along
syntax keyword partFunction length_along start_of end_of tangent_of normal_of curvature_of moved rotated mirrored scaled
syntax keyword partFunction reversed row grid around count_of item_of lift sin cos tan asin acos atan2 sqrt abs min max floor
syntax match partUnit /\(\d\s*\)\@<=\(\(mm\|cm\|m\|in\)\(\/min\|\/rev\)\?\|ft\/min\)\>/
syntax match partUnit /\(\d\s*\)\@<=\(deg\|rad\|rpm\)\>/

highlight default link partComment Comment
highlight default link partText String
highlight default link partNumber Number
highlight default link partStatement Statement
highlight default link partRepeat Repeat
highlight default link partWalk Keyword
highlight default link partLink Keyword
highlight default link partPiece Keyword
highlight default link partMilling Keyword
highlight default link partCutter Keyword
highlight default link partFunction Function
highlight default link partUnit Type

let b:current_syntax = 'part'
