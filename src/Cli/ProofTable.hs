-- | The proof of a tape as a table and a verdict.
module Cli.ProofTable
  ( proof,
  )
where

import Base.Decimal qualified as Decimal
import Base.Name (Name (..))
import Base.PulseVector (Pulses3 (..))
import Base.Quantity (LengthUnit, Mm (..), Pulses (..))
import Base.Region (Located (..))
import Cli.Table (Align (..))
import Cli.Table qualified as Table
import Data.Text (Text)
import Data.Text qualified as Text
import Machine.Machine (Axis (..), Machine)
import Machine.Machine qualified as Machine
import Verify.Proof (ContourProof (..), Proof, Witness (..))
import Verify.Proof qualified as Proof

-- | The proof as text. A table has two rows for each contour: one for the largest gouge, one for
-- the largest excess. A row has this value in the given unit, the allowed value, and the number of
-- the frame where the value occurs. Without contours there is no table. Facts about the whole tape
-- and the verdict follow.
proof :: LengthUnit -> Machine -> Proof -> Text
proof unit machine p =
  contours <> Table.columns [ToLeft, ToLeft] closing
  where
    contours = case Proof.contourProofs p of
      [] -> ""
      proofs ->
        Table.columns
          [ToLeft, ToRight, ToLeft, ToRight, ToRight]
          (header : concatMap contourRows proofs)
          <> "\n"
    header = ["contour", "", Decimal.unitText unit, "allowed", "frame"]
    contourRows c =
      let Name n = value (contour c)
       in [ [n, "gouge"] <> witness (allowedGouge c) (gouge c),
            ["", "excess"] <> witness (allowedExcess c) (excess c)
          ]
    witness allowed w = case w of
      Nothing -> [fixed4 (Mm 0), fixed4 allowed, ""]
      Just x -> [fixed4 (max (Mm 0) (amount x)), fixed4 allowed, Decimal.whole (Proof.frame x)]
    fixed4 = Decimal.fixedIn unit 4
    inOrder (Pulses3 x y z) = [x, y, z]
    axes words' =
      Text.intercalate ", " (zipWith (\axis w -> axis <> " " <> w) ["x", "y", "z"] words')
        <> " pulses"
    closing =
      [ ["frames read back", Decimal.whole (Proof.frames p)],
        [ "largest increments",
          axes
            [ Decimal.whole d <> " of " <> capacityWord a
              | (Pulses d, a) <- zip (inOrder (Proof.largestIncrement p)) [X, Y, Z]
            ]
        ],
        ["misses its end by", axes [Decimal.whole d | Pulses d <- inOrder (Proof.closure p)]]
      ]
        <> [ ["path mode adds", Decimal.fixedInUnit unit 4 (Proof.mayLeave p)]
             | Proof.mayLeave p > Mm 0
           ]
        <> [["verdict", if Proof.isProven p then "proven" else "WRONG"]]
    capacityWord axis = let Pulses n = Machine.capacity machine axis in Decimal.whole n
