-- | Rate at which the spindle turns at each feed for one turn.
--
-- A change of the tool keeps the speed: on lathes whose tape cannot stop the spindle the part keeps
-- turning. A control that stops it by itself asks for the speed again.
module Toolpath.FeedRate
  ( withRates,
  )
where

import Base.Region (Located (..))
import Data.List (mapAccumL)
import Part.CutFeed (CutFeed, SpindleRate (..))
import Part.CutFeed qualified as CutFeed
import Part.Part
  ( Carving,
    Command (..),
    Contour,
    Drilling,
    Element,
    Milling,
    Operation (..),
    Pocketing,
    Stop,
  )
import Part.Part qualified as Part

-- | Operations with the rate of the spindle in all feeds.
withRates :: [Operation] -> [Operation]
withRates = snd . mapAccumL next NoRate
  where
    next rate operation = case operation of
      Command (Located _ c) -> (after rate c, operation)
      Mill m -> (rate, Mill (milling rate <$> m))
      Pocket p -> (rate, Pocket (pocketing rate <$> p))
      Drill d -> (rate, Drill (drilling rate <$> d))
      Carve c -> (rate, Carve (carving rate <$> c))
      Travel stops -> (rate, Travel (fmap (stop rate) stops))

-- | Rate after a command.
after :: SpindleRate -> Command -> SpindleRate
after rate c = case c of
  SpindleOn _ speed -> speed
  SpindleOff -> NoRate
  SpindleByHand -> NoRate
  CoolantTo _ -> rate
  Auxiliary _ -> rate
  ChangeTool _ _ -> rate
  ProgramStop -> rate
  OptionalStop -> rate
  Dwell _ -> rate

milling :: SpindleRate -> Milling -> Milling
milling rate m =
  m
    { Part.contour = contour rate (Part.contour m),
      Part.feed = located rate (Part.feed m),
      Part.plunge = located rate <$> Part.plunge m,
      Part.approach = map (stop rate) (Part.approach m),
      Part.retract = map (stop rate) (Part.retract m)
    }

pocketing :: SpindleRate -> Pocketing -> Pocketing
pocketing rate p =
  p {Part.wall = milling rate (Part.wall p), Part.islands = map (contour rate) (Part.islands p)}

drilling :: SpindleRate -> Drilling -> Drilling
drilling rate d =
  d
    { Part.drillFeed = located rate (Part.drillFeed d),
      Part.form = case Part.form d of
        Part.Bored c -> Part.Bored c {Part.circleFeed = located rate (Part.circleFeed c)}
        Part.Threaded h -> Part.Threaded h {Part.helixFeed = located rate (Part.helixFeed h)}
        other -> other
    }

carving :: SpindleRate -> Carving -> Carving
carving rate c =
  c
    { Part.carvingFeed = located rate (Part.carvingFeed c),
      Part.carvingPlunge = located rate <$> Part.carvingPlunge c
    }

-- | A contour without feeds for one turn stays the same in memory.
contour :: SpindleRate -> Contour -> Contour
contour rate c
  | any hasTurnFeed (Part.elements c) = c {Part.elements = fmap (element rate) (Part.elements c)}
  | otherwise = c
  where
    hasTurnFeed e = case Part.ownFeed (Part.finish e) of
      Just (Located _ (CutFeed.PerTurn _ _)) -> True
      _ -> False

element :: SpindleRate -> Element -> Element
element rate e = e {Part.finish = (Part.finish e) {Part.ownFeed = located rate <$> own}}
  where
    own = Part.ownFeed (Part.finish e)

stop :: SpindleRate -> Stop -> Stop
stop rate s = case Part.pace s of
  Part.Rapid -> s
  Part.At f -> s {Part.pace = Part.At (located rate f)}

located :: SpindleRate -> Located CutFeed -> Located CutFeed
located rate (Located at f) = Located at (CutFeed.atRate rate f)
