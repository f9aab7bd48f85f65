module Sheet.FromPart (fromPart) where
import Base.Result (Result)
import Part.Part (Part)
import Sheet.Error
import Sheet.Sheet
fromPart :: Part -> Result w Error Sheet
fromPart _ = undefined
