; Text objects, for Helix: functions, parameters, comments, and the text in braces as a class.

(let parameters: (parameters) value: (_) @function.inside) @function.around
(parameters (name) @parameter.inside)
(arguments (_) @parameter.inside)
(comment) @comment.inside
(comment)+ @comment.around
(contour items: (items) @class.inside) @class.around
(_ (settings) @class.inside) @class.around
