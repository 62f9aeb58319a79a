//! Bottom levels that are built beside the frames, so that none waits for them.
//!
//! One thread takes meshes, the small ones first, and builds each fast with a few others' help. When none is left, it builds
//! those again that rays get faster through by it. What waits, is being built, or was not taken yet is bounded.

use std::collections::{BTreeMap, VecDeque};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::thread::{self, JoinHandle};

use afterglow_bvh::{Blas, Quality};
use parking_lot::{Condvar, Mutex};
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::structures::Member;

/// Triangles that wait, unless a single mesh has more: about 150 MB of corners.
const MOST_WAITING: usize = 1 << 22;
/// Meshes of more triangles are not built a second time.
const MOST_IMPROVED: usize = 1 << 18;
/// Bytes of structures that a frame takes, unless a single one is larger.
const MOST_TAKEN_BYTES: usize = 8 << 20;
/// Threads that build one mesh together.
const MOST_THREADS: usize = 4;

/// A mesh to build.
#[derive(Debug)]
pub(super) struct Order {
    pub(super) content: u64,
    /// Three a triangle.
    pub(super) corners: Vec<[f32; 3]>,
    pub(super) members: Vec<Member>,
    /// A fast build is there already.
    pub(super) is_built: bool,
}

impl Order {
    fn triangles(&self) -> usize {
        self.corners.len() / 3
    }
}

/// A mesh that was built.
pub(super) struct Finished {
    pub(super) content: u64,
    /// None if there is nothing to meet, or the build has failed.
    pub(super) blas: Option<Blas>,
}

/// Makes a structure of an order.
type Build = fn(&Order, Quality) -> Option<Blas>;
/// What is built first: not what is there already, few triangles, the order in which it was asked for.
type Rank = (bool, usize, u64);

#[derive(Default)]
struct State {
    orders: BTreeMap<Rank, Order>,
    finished: VecDeque<Finished>,
    /// Those of what waits and what is being built.
    triangles: usize,
    /// The number of the next order.
    number: u64,
    is_over: bool,
}

#[derive(Default)]
struct Shared {
    state: Mutex<State>,
    has_changed: Condvar,
}

/// The thread, which begins with the first order and ends with this.
pub(super) struct Background {
    build: Build,
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

impl Background {
    pub(super) fn new(build: Build) -> Self {
        Self { build, shared: Arc::default(), thread: None }
    }

    /// Whether so many more triangles may wait.
    pub(super) fn has_room(&self, triangles: usize) -> bool {
        let state = self.shared.state.lock();
        let structures = state.finished.iter().filter_map(|finished| finished.blas.as_ref());
        let finished: usize = structures.map(|blas| blas.triangle_count as usize).sum();
        let waiting = state.triangles + finished;
        waiting == 0 || waiting + triangles <= MOST_WAITING
    }

    /// Asks for a mesh. Gives the order back if there is no thread to be had.
    pub(super) fn ask(&mut self, order: Order) -> Result<(), Order> {
        if self.thread.is_none() {
            let (shared, build) = (self.shared.clone(), self.build);
            let name = "builds".to_owned();
            self.thread = thread::Builder::new()
                .name(name)
                .spawn(move || shared.work(build))
                .map_err(|error| tracing::warn!("frames wait for structures: {error}"))
                .ok();
        }
        if self.thread.is_none() {
            return Err(order);
        }
        self.shared.state.lock().add(order);
        self.shared.has_changed.notify_all();
        Ok(())
    }

    /// What was finished; what is left comes with the next frames.
    pub(super) fn take(&mut self) -> Vec<Finished> {
        let mut state = self.shared.state.lock();
        let mut taken = Vec::new();
        let mut bytes = 0;
        while let Some(next) = state.finished.front() {
            bytes += next.blas.as_ref().map_or(0, Blas::size_bytes);
            if bytes > MOST_TAKEN_BYTES && !taken.is_empty() {
                break;
            }
            taken.extend(state.finished.pop_front());
        }
        taken
    }

    /// Forgets a mesh that nobody needs any more, unless it is being built.
    pub(super) fn cancel(&mut self, content: u64) {
        let mut state = self.shared.state.lock();
        let before = state.orders.values().map(Order::triangles).sum::<usize>();
        state.orders.retain(|_, order| order.content != content);
        let after = state.orders.values().map(Order::triangles).sum::<usize>();
        state.triangles -= before - after;
        state.finished.retain(|finished| finished.content != content);
    }
}

impl Drop for Background {
    /// Waits for the mesh that is being built.
    fn drop(&mut self) {
        self.shared.state.lock().is_over = true;
        self.shared.has_changed.notify_all();
        if let Some(thread) = self.thread.take() {
            // Its panics are caught within.
            let _ = thread.join();
        }
    }
}

impl State {
    fn add(&mut self, order: Order) {
        self.triangles += order.triangles();
        let rank = (order.is_built, order.triangles(), self.number);
        self.number += 1;
        self.orders.insert(rank, order);
    }
}

impl Shared {
    /// Builds until it is over.
    fn work(&self, build: Build) {
        let mut helpers = Vec::new();
        let pool = pool(&mut helpers);
        while let Some(mut order) = self.next() {
            let quality = if order.is_built { Quality::Good } else { Quality::Fast };
            let build = || match &pool {
                Some(pool) => pool.install(|| build(&order, quality)),
                None => build(&order, quality),
            };
            let blas = catch_unwind(AssertUnwindSafe(build)).unwrap_or_else(|_| {
                tracing::warn!("a mesh is left out: its build has panicked");
                None
            });
            let comes_again = !order.is_built && blas.is_some() && order.triangles() <= MOST_IMPROVED;
            let finished = Finished { content: order.content, blas };
            let mut state = self.state.lock();
            state.triangles -= order.triangles();
            state.finished.push_back(finished);
            if comes_again {
                order.is_built = true;
                state.add(order);
            }
        }
        drop(pool);
        for helper in helpers {
            let _ = helper.join();
        }
    }

    /// The next order, once there is one; none when it is over.
    fn next(&self) -> Option<Order> {
        let mut state = self.state.lock();
        while !state.is_over {
            if let Some((_, order)) = state.orders.pop_first() {
                return Some(order);
            }
            self.has_changed.wait(&mut state);
        }
        None
    }
}

/// Threads that build together: half of those that the machine has, so that the program has the others.
fn pool(helpers: &mut Vec<JoinHandle<()>>) -> Option<ThreadPool> {
    let threads = thread::available_parallelism().map_or(1, |threads| threads.get() / 2);
    ThreadPoolBuilder::new()
        .num_threads(threads.clamp(1, MOST_THREADS))
        .spawn_handler(|helper| {
            helpers.push(thread::Builder::new().name("builds".to_owned()).spawn(|| helper.run())?);
            Ok(())
        })
        .build()
        .map_err(|error| tracing::warn!("structures are built without threads of their own: {error}"))
        .ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use afterglow_bvh::build_blas;
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::time::Duration;

    /// Builds wait for this, so that others come in meanwhile.
    static IS_OPEN: AtomicBool = AtomicBool::new(false);

    fn order(content: u64, triangles: usize) -> Order {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].repeat(triangles);
        Order { content, corners, members: Vec::new(), is_built: false }
    }

    fn blas(order: &Order, quality: Quality) -> Option<Blas> {
        let indices: Vec<_> =
            (0..order.triangles() as u32).map(|first| [0, 1, 2].map(|i| 3 * first + i)).collect();
        build_blas(&order.corners, &indices, quality).ok()
    }

    /// The next so many that are finished.
    fn taken(background: &mut Background, count: usize) -> Vec<Finished> {
        let mut taken = Vec::new();
        for _ in 0..3000 {
            taken.extend(background.take());
            if taken.len() >= count {
                break;
            }
            thread::sleep(Duration::from_millis(10));
        }
        assert_eq!(taken.len(), count);
        taken
    }

    #[test]
    fn small_ones_come_first_and_all_come_again() {
        let mut background = Background::new(|order, quality| {
            while !IS_OPEN.load(Ordering::Acquire) {
                thread::sleep(Duration::from_millis(1));
            }
            blas(order, quality)
        });
        assert!(background.ask(order(1, 9)).is_ok());
        while !background.shared.state.lock().orders.is_empty() {
            thread::sleep(Duration::from_millis(1));
        }
        for (content, triangles) in [(2, 90), (3, 5), (4, 7), (5, 40)] {
            assert!(background.ask(order(content, triangles)).is_ok());
        }
        background.cancel(5);
        IS_OPEN.store(true, Ordering::Release);
        let contents: Vec<_> = taken(&mut background, 8).iter().map(|finished| finished.content).collect();
        assert_eq!(contents, [1, 3, 4, 2, 3, 4, 1, 2]);
        assert_eq!(background.shared.state.lock().triangles, 0);
    }

    #[test]
    fn a_panic_leaves_one_mesh_out() {
        let mut background = Background::new(|order, quality| {
            assert!(order.content != 1, "made up for this test");
            blas(order, quality)
        });
        for content in [1, 2] {
            assert!(background.ask(order(content, 3)).is_ok());
        }
        let finished = taken(&mut background, 3);
        let found = finished.iter().map(|finished| (finished.content, finished.blas.is_some()));
        assert!(found.eq([(1, false), (2, true), (2, true)]));
    }

    #[test]
    fn what_waits_is_bounded() {
        let mut background = Background::new(|_, _| {
            thread::sleep(Duration::from_millis(200));
            None
        });
        assert!(background.has_room(MOST_WAITING + 1));
        assert!(background.ask(order(1, 100)).is_ok());
        assert!(background.has_room(MOST_WAITING - 100) && !background.has_room(MOST_WAITING - 99));
        // The thread ends with it.
        let shared = background.shared.clone();
        drop(background);
        assert_eq!(Arc::strong_count(&shared), 1);
    }
}
