# Part programs of partc: file type, colours, indentation, and the language server for kakoune-lsp.

hook global BufCreate .*\.part %{
    set-option buffer filetype part
}

# The delimiters ~ and § are used where the text contains single braces.

hook global WinSetOption filetype=part %~
    require-module part
    hook -group part-indent window InsertChar \n part-indent-new-line
    hook -group part-indent window InsertChar [)}\]] part-indent-closing
    hook -once -always window WinSetOption filetype=.* %{ remove-hooks window part-indent }
~

hook -group part-highlight global WinSetOption filetype=part %{
    require-module part
    add-highlighter window/part ref part
    hook -once -always window WinSetOption filetype=.* %{ remove-highlighter window/part }
}

hook global BufSetOption filetype=part %{
    set-option buffer comment_line '--'
    set-option buffer indentwidth 2
    # Kakoune's own tools may be missing.
    try %{ set-option buffer makecmd 'partc check --format short' }
}

# kakoune-lsp 17 and later read this option. Without kakoune-lsp the option does not exist.
hook global BufSetOption filetype=part %{
    try %{
        set-option buffer lsp_servers %{
            [partc]
            command = "partc"
            args = ["lsp"]
            root_globs = [".git"]
        }
    }
}

provide-module part %§

    add-highlighter shared/part regions
    add-highlighter shared/part/code default-region group
    add-highlighter shared/part/comment region '--' '$' fill comment
    add-highlighter shared/part/text region '"' '"|$' fill string

    # Statements
    add-highlighter shared/part/code/ regex \b(part|machine|import|tool|feed|tolerance|clearance|from|let|param|table|curve|piece|contour|assert|mill|turn|drill|rapid|move|change|spindle|coolant|aux|with)\b 1:keyword
    # The other words that cannot be names
    add-highlighter shared/part/code/ regex \b(for|if|in|then|else|and|or|not|open|closed|cw|ccw|meet|near|smooth|tangent|fillet|chamfer|slow|allowance|bevel|outside|inside|left|right|on|within|first|last|approach|retract)\b 1:keyword
    # Words that begin a line and are names elsewhere
    add-highlighter shared/part/code/ regex ^\h*(pocket|face|vcarve|work|program|safe|stock|avoid|contours|dwell|spot|ream|countersink|counterbore|bore|tap|thread)\h+[(-]?\w 1:keyword
    add-highlighter shared/part/code/ regex ^\h*(rest\h+of)\h 1:keyword
    add-highlighter shared/part/code/ regex ^\h*(engrave)\h 1:keyword
    add-highlighter shared/part/code/ regex \b(at)\b[^\n]*\b(height)\b[^\n]*\{ 1:keyword 2:keyword
    add-highlighter shared/part/code/ regex ^\h*contours\h[^\n]*\bfrom\h[^\n]*\b(text)\h[^\n]*\b(at)\b[^\n]*\b(height)\h 1:keyword 2:keyword 3:keyword
    add-highlighter shared/part/code/ regex \bheight\b[^\n]*\b(direction|around)\h 1:keyword
    add-highlighter shared/part/code/ regex \b(align)\h+(left|centre|right)\b 1:keyword 2:keyword
    add-highlighter shared/part/code/ regex ^\h*pocket\h[^\n]*\h(as)\h 1:keyword
    add-highlighter shared/part/code/ regex ^\h*((?:optional\h+)?stop)\h*$ 1:keyword
    add-highlighter shared/part/code/ regex ^\h*(units)\h+(mm|in)\b 1:keyword 2:type
    add-highlighter shared/part/code/ regex (?:^|\{)\h*(depth|lead|corners|climb|conventional|compensation|start|plunge|peck|chip|dwell|pitch|hand|floating|shortest|islands|rest|angle|ramp|helix|spiral|tabs|tab)\b 1:keyword
    # Words that follow others and are names elsewhere
    add-highlighter shared/part/code/ regex \blead\h+(?:in|out)\h+(line|arc)\b 1:keyword
    add-highlighter shared/part/code/ regex \blead\h+(out)\b 1:keyword
    add-highlighter shared/part/code/ regex \b(?:spindle|coolant)\h+(off)\b 1:keyword
    add-highlighter shared/part/code/ regex \bspindle\h+(manual)\b 1:keyword
    add-highlighter shared/part/code/ regex ^\h*spindle\h[^\n]*\b(limit)\b 1:keyword
    add-highlighter shared/part/code/ regex \bchange\b[^\n]*\)\h*(at)\b 1:keyword
    add-highlighter shared/part/code/ regex ^\h*dwell\h[^\n]*\b(s)\h*$ 1:keyword
    add-highlighter shared/part/code/ regex ^\h*(?:stock|avoid)\h[^\n]*?\bfrom\b[^\n]*?\b(to)\b 1:keyword
    add-highlighter shared/part/code/ regex ^\h*(?:contours?|table)\h[^\n]*\bfrom\h[^\n]*\b(layer|id|class|unit)\h 1:keyword
    add-highlighter shared/part/code/ regex \bcorners\h+(round|sharp)\b 1:keyword
    add-highlighter shared/part/code/ regex \bcompensation\h+(compiler|controller)\b 1:keyword
    add-highlighter shared/part/code/ regex \brest\h+(allowed)\b 1:keyword
    add-highlighter shared/part/code/ regex \b(?:drill|spot|ream|countersink|counterbore|bore|tap|thread)\h+(at)\b 1:keyword
    add-highlighter shared/part/code/ regex \b(?:drill|spot|ream|counterbore|bore|tap|thread)\h+at\b[^\n]*\b(depth)\b 1:keyword
    add-highlighter shared/part/code/ regex ^\h*(?:spot|countersink|counterbore|bore|thread)\h+at\b[^\n]*\b(diameter)\b 1:keyword
    add-highlighter shared/part/code/ regex ^\h*(?:bore|tap|thread)\h+at\b[^\n]*\b(pitch)\b 1:keyword
    add-highlighter shared/part/code/ regex ^\h*countersink\h+at\b[^\n]*\b(angle)\b 1:keyword
    add-highlighter shared/part/code/ regex \bchip\h+(break)\b 1:keyword
    add-highlighter shared/part/code/ regex \b(?:depth|pocket|rest|face)\b[^\n]*\b(step)\b 1:keyword
    add-highlighter shared/part/code/ regex \.\.[^\n]*\b(by)\b 1:keyword
    add-highlighter shared/part/code/ regex \b(cipher|joggle)\b 1:keyword
    add-highlighter shared/part/code/ regex \bjoggle\b[^\n]*\b(to)\b[^\n]*\b(depth)\b[^\n]*\b(radius)\b 1:keyword 2:keyword 3:keyword
    add-highlighter shared/part/code/ regex \b(cone|vbit|blade|tap|threadmill)\( 1:keyword
    add-highlighter shared/part/code/ regex \((diameter|nose)\b 1:keyword
    add-highlighter shared/part/code/ regex \bvbit\((angle)\b[^\n]*,\h*(tip)\b[^\n]*,\h*(diameter)\b 1:keyword 2:keyword 3:keyword
    add-highlighter shared/part/code/ regex ,\h*(height|gear)\b 1:keyword
    add-highlighter shared/part/code/ regex ,\h*(flutes|stickout|holder|angle|pitch)\h+[(-]?\w 1:keyword
    add-highlighter shared/part/code/ regex ,\h*holder\h(?:[^,()\n]|\([^()\n]*\))*\b(height)\h 1:keyword
    add-highlighter shared/part/code/ regex \bturn\([^\n]*,\h*(tip)\b 1:keyword

    # Functions and constants
    add-highlighter shared/part/code/ regex \b(region|union|difference|offset_of|outlines_of|holes_of|area_of|centroid_of|rectangle|bar|rounded|slot|polygon|ellipse|gear|polar|intersection|centre_of|midpoint|foot_of|tangency|point_on|line|horizontal|vertical|parallel|perpendicular|circle|concentric|distance|direction_of|radius_of|length_of|x_of|y_of|spline|closed_spline|bezier|bspline|polyline|parabola|arcs|closed_arcs|fit|sections|rows_of|points_of|point_at_x|point_along|length_along|start_of|end_of|tangent_of|normal_of|curvature_of|moved|rotated|mirrored|scaled|reversed|row|grid|around|count_of|item_of|lift|sin|cos|tan|asin|acos|atan2|sqrt|abs|min|max|floor)\( 1:builtin
    add-highlighter shared/part/code/ regex \b(pi|true|false)\b 1:value

    # Numbers and their units
    add-highlighter shared/part/code/ regex \b([0-9]+(?:\.[0-9]+)?)\b 1:value
    add-highlighter shared/part/code/ regex \b([0-9]+(?:\.[0-9]+)?)\h*(mm/min|m/min|in/min|ft/min|mm/rev|in/rev|mm|cm|m|in|deg|rad|rpm)\b 1:value 2:type
    add-highlighter shared/part/code/ regex ^\h*machine\h+([\w.-]+) 1:value

    # Indents a new line as the line before, and further after an opening bracket. Removes the spaces
    # at the end of the line before.
    define-command -hidden part-indent-new-line %~
        evaluate-commands -draft -itersel %_
            try %{ execute-keys -draft k x s \h+$ <ret> d }
            try %{ execute-keys -draft <semicolon> K <a-&> }
            try %! execute-keys -draft k x <a-k> [{(\[]\h*(--[^\n]*)?$ <ret> j <a-gt> !
        _
    ~

    # Gives a closing bracket that begins its line the indentation of the line with the opening bracket.
    define-command -hidden part-indent-closing %~
        evaluate-commands -draft -itersel %_
            try %! execute-keys -draft <a-h> <a-k> ^\h+[)}\]]$ <ret> h m <a-S> 1 <a-&> !
        _
    ~
§
