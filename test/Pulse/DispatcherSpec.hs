-- | Laws of the dispatcher: overflows at the ticks of a dedicated integrator, and a bound for the
-- time that a job waits.
module Pulse.DispatcherSpec
  ( spec,
  )
where

import Data.List (sortOn)
import Data.Maybe (fromMaybe)
import Pulse.Dispatcher (Dispatcher (..), Happening (..), Waiting (..))
import Pulse.Dispatcher qualified as Dispatcher
import Test.Hspec
import Test.QuickCheck

-- | Job that arrives once: its tick, its length, its priority, and the feed that it sets at its
-- last tick, if it sets one.
data Task = Task {at :: Int, long :: Int, rank :: Int, sets :: Maybe Int}
  deriving stock (Show)

-- | Capacity, length of an interpolation cycle, first feed, and all jobs.
data Case = Case {cap :: Int, cycleLength :: Int, firstFeed :: Int, tasks :: [Task]}
  deriving stock (Show)

-- | Ticks that are simulated.
end :: Int
end = 4000

-- | Ticks of the overflows up to 'end', and the changes of the feed: the tick, and the new feed.
simulated :: Case -> ([Int], [(Int, Int)])
simulated c = go (foldr arrive started (tasks c))
  where
    started = Dispatcher.withFeed (firstFeed c) (Dispatcher.start (cap c))
    arrive t = Dispatcher.arrive (at t) t
    go d
      | tick d > end = ([], [])
      | otherwise = case Dispatcher.next (cycleLength c) d of
        Overflowed t d' -> let (ts, vs) = go d' in (t : ts, vs)
        Arrived t task d' -> go (Dispatcher.request (Waiting (rank task) (long task) t task) d')
        Worked _ w d' -> case sets (work w) of
          Nothing -> go d'
          Just v -> let (ts, vs) = go (Dispatcher.withFeed v d') in (ts, (tick d', v) : vs)
        Idle -> ([], [])

-- | Ticks of the overflows of an integrator that adds the feed in every tick. A change of the feed
-- counts from the tick after it.
dedicated :: Case -> [(Int, Int)] -> [Int]
dedicated c = go 1 0 (firstFeed c)
  where
    go t u v changes = case changes of
      (s, v') : more | s < t -> go t u v' more
      _
        | t > end -> []
        | u + v >= cap c -> t : go (t + 1) (u + v - cap c) v changes
        | otherwise -> go (t + 1) (u + v) v changes

-- | A case whose feeds all satisfy the predicate for k·V and C.
caseWith :: (Int -> Int -> Bool) -> Gen Case
caseWith allowed = do
  bits <- choose (6, 14 :: Int)
  k <- choose (2, 12)
  let c = 2 ^ bits
      feedOf = choose (1, c) `suchThat` \v -> allowed (k * v) c
  v <- feedOf
  n <- choose (0, 60)
  Case c k v <$> vectorOf n (taskFor feedOf)
  where
    taskFor feedOf =
      Task <$> choose (0, end) <*> choose (1, 40) <*> choose (1, 6)
        <*> oneof [pure Nothing, Just <$> feedOf]

spec :: Spec
spec = do
  describe "the overflows" $ do
    it
      "come at the ticks of a dedicated integrator, whatever jobs run and change the feed (catches \
      \a booking that is forgotten or too long, a job that runs over an overflow)"
      $ withMaxSuccess 2000 $
        forAll (caseWith (<=)) $ \c ->
          let (ticks, changes) = simulated c
           in takeWhile (<= end) ticks === dedicated c changes
    it
      "come late if the interpolation cycle takes longer than the time between them (catches \
      \a condition that is stricter than needed)"
      $ withMaxSuccess 500 $
        forAll (caseWith (\kv c -> kv > c + c `div` 20 && kv <= 4 * c)) $ \c ->
          let alone = c {tasks = []}
           in takeWhile (<= end) (fst (simulated alone)) =/= dedicated alone []
  describe "a job" $
    it
      "starts within the bound for its wait, whatever else is requested (catches a job that waits \
      \for ever)"
      $ withMaxSuccess 1000 $
        forAll periodic $ \(c, kinds) ->
          conjoin
            [ counterexample (show (c, kinds, kind, bound, waits)) (maximum (0 : waits) <= bound)
              | (n, kind) <- zip [1 ..] kinds,
                let waits = waitsOf c kinds n,
                Just bound <- [boundFor c kinds n]
            ]

-- | Kind of job: its length, its least interval, and the ticks of its requests.
data Kind = Kind {size :: Int, least :: Int, requests :: [Int]}
  deriving stock (Show)

-- | A case without tasks, and kinds of jobs in the order of their priority.
periodic :: Gen (Case, [Kind])
periodic = do
  k <- choose (1, 8)
  v <- choose (1, 4096 `div` (k + 2))
  kinds <- resize 5 (listOf1 kindOf)
  pure (Case 4096 k v [], kinds)
  where
    kindOf = do
      n <- choose (1, 20)
      gap <- choose (n + 1, 600)
      first <- choose (0, 400)
      gaps <- vectorOf 60 (choose (gap, 2 * gap))
      pure (Kind n gap (takeWhile (< end) (scanl (+) first gaps)))

-- | Bound for the wait of the kind with this number, from 1.
boundFor :: Case -> [Kind] -> Int -> Maybe Int
boundFor c kinds n =
  Dispatcher.longestWait
    (cycleLength c)
    (cap c)
    (firstFeed c)
    (size (kinds !! (n - 1)))
    (maximum (map size kinds))
    [(size k, least k) | k <- take n kinds]

-- | Ticks between request and start, for all jobs of the kind with this number.
waitsOf :: Case -> [Kind] -> Int -> [Int]
waitsOf c kinds n =
  [began - asked | (m, asked, began) <- go started, m == n]
  where
    started =
      foldr
        (uncurry Dispatcher.arrive)
        (Dispatcher.withFeed (firstFeed c) (Dispatcher.start (cap c)))
        (sortOn fst [(t, m) | (m, k) <- zip [1 ..] kinds, t <- requests k])
    go d
      | tick d > 4 * end = [(m, requested w, tick d) | w <- waiting d, let m = work w]
      | otherwise = case Dispatcher.next (cycleLength c) d of
        Overflowed _ d' -> go d'
        Arrived t m d' ->
          go (Dispatcher.request (Waiting m (sizeOf m) t m) d')
        Worked t w d' -> (work w, requested w, t) : go d'
        Idle -> []
    sizeOf m = fromMaybe 1 (lookup m (zip [1 ..] (map size kinds)))
