; What can be folded: the text in braces, and lists over several lines.

[
  (statements)
  (items)
  (rows)
  (settings)
  (list)
  (comprehension)
] @fold
