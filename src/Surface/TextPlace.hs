-- | The place of a text with outlines: a point and two vectors, from which the points of its
-- letters follow. Their names are hidden.
module Surface.TextPlace
  ( origin,
    along,
    upward,
    capitals,
  )
where

import Base.Name (Name)
import Base.Name qualified as Name
import Base.Quantity (Mm (..))

-- | The names of the point to which a text is aligned, of the vector along its line, and of the
-- vector from its feet to its heads. The vectors belong to 1 mm of a text whose capitals have the
-- height 'capitals'. The argument is the name of the region of the text.
origin, along, upward :: Name -> Name
origin name = Name.hidden name "origin"
along name = Name.hidden name "along"
upward name = Name.hidden name "upward"

-- | The height of the capitals for which the outlines of a text are laid out.
capitals :: Mm
capitals = Mm 10
