-- | Reports of later passes in a text that has changed.
module Query.CarriedReportSpec (spec) where

import Base.Region (Region (..))
import Base.Region qualified as Region
import Data.Text (Text)
import Query.CarriedReport qualified as CarriedReport
import Query.Snapshot (Snapshot (..))
import Query.Snapshot qualified as Snapshot
import Report.Fix (Fix (..))
import Report.Fix qualified as Fix
import Report.Report (Report (..), ReportPlace (..), Severity (..), report)
import Test.Hspec

spec :: Spec
spec = do
  it "keeps a report and its fixes at the corresponding places" $
    map shown (CarriedReport.carried before' now)
      `shouldBe` [(InSource (Region 13 14), ["-- x\nlet c = a", "-- x\nlet a = b"])]
  it "leaves a report out whose place has changed" $
    CarriedReport.carried before' (unanalysed "let b = c") `shouldBe` []
  where
    now = unanalysed "-- x\nlet b = a"
    before' =
      (unanalysed "let b = a")
        { laterReports =
            [ (report Error "E0401" (InSource (Region 8 9)) "wrong")
                { fixes =
                    [ Fix.exchange "Write c." (Region 4 5) "c",
                      Fix.swap "Exchange them." (Region 4 5) (Region 8 9)
                    ]
                }
            ]
        }
    shown r = (place r, map (Fix.applied (source now) . edits) (fixes r))
    unanalysed :: Text -> Snapshot
    unanalysed = Snapshot.unanalysed . Region.fromText "a.part"
