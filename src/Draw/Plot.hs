module Draw.Plot (plot) where
import Data.Text (Text)
import Part.Part (Part)
import Path.Path (Path)
plot :: Part -> Path -> Text
plot _ _ = "<svg/>"
