//! Threads. The only file that names rayon; without the feature everything runs on one thread, with
//! the same bits: each task writes its own part, and every reduction combines its chunks in order.

/// Elements in one task of a loop over particles.
pub(crate) const CHUNK: usize = 2048;

/// Runs two tasks, side by side if there are threads.
pub(crate) fn join<A: Send, B: Send>(a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B + Send) -> (A, B) {
    #[cfg(feature = "rayon")]
    return rayon::join(a, b);
    #[cfg(not(feature = "rayon"))]
    (a(), b())
}

/// What is done with a part of an array.
type Task<'a, X> = &'a (dyn Fn(usize, &mut [X]) + Sync);

/// Calls `task(first, part)` on consecutive parts of `data`, each of whole units of `unit` elements
/// and at most `units` of them; `first` is the index of the part's first unit.
///
/// The task is called through a pointer: the machinery of threads, a hundred times the code of a usual
/// task, is compiled once for each type of element and not for each task.
pub(crate) fn for_each_part<X: Send>(data: &mut [X], unit: usize, units: usize, task: Task<X>) {
    fn go<X: Send>(first: usize, data: &mut [X], unit: usize, units: usize, task: Task<X>) {
        let count = data.len() / unit;
        if count <= units {
            if count > 0 {
                task(first, data);
            }
            return;
        }
        let half = (count / 2).div_ceil(units) * units;
        let half = if half >= count { half - units } else { half };
        let (left, right) = data.split_at_mut(half * unit);
        join(|| go(first, left, unit, units, task), || go(first + half, right, unit, units, task));
    }
    go(0, data, unit, units, task);
}

/// Calls `task(first, chunk)` on consecutive chunks of `data` (the same for any number of threads) and
/// combines what it returns in ascending order.
pub(crate) fn change_and_reduce<X: Send, R: Send + Clone>(
    data: &mut [X],
    zero: R,
    task: impl Fn(usize, &mut [X]) -> R + Sync,
    combine: impl Fn(R, R) -> R,
) -> R {
    let mut parts: Vec<_> = data.chunks_mut(CHUNK).map(|part| (part, zero.clone())).collect();
    for_each_part(&mut parts, 1, 1, &|first, part: &mut [(&mut [X], R)]| {
        let (chunk, result) = &mut part[0];
        *result = task(first * CHUNK, chunk);
    });
    parts.into_iter().map(|(_, result)| result).fold(zero, combine)
}

/// Maps chunks of `0..count` (the same chunks for any number of threads) and combines the results
/// in ascending order.
pub(crate) fn reduce<R: Send + Clone>(
    count: usize,
    zero: R,
    map: impl Fn(core::ops::Range<usize>) -> R + Sync,
    combine: impl Fn(R, R) -> R,
) -> R {
    let mut parts = vec![zero.clone(); count.div_ceil(CHUNK)];
    for_each_part(&mut parts, 1, 1, &|first, part: &mut [R]| {
        let start = first * CHUNK;
        part[0] = map(start..(start + CHUNK).min(count));
    });
    parts.into_iter().fold(zero, combine)
}

/// A group of threads for a whole run; entering it once is cheaper than once per loop.
///
/// ```
/// # fn main() -> Result<(), alluvium::parallel::ThreadError> {
/// let threads = alluvium::parallel::Threads::new(2)?;
/// let answer = threads.install(|| 6 * 7);
/// # assert_eq!(answer, 42); Ok(()) }
/// ```
#[derive(Debug)]
pub struct Threads {
    #[cfg(feature = "rayon")]
    pool: rayon::ThreadPool,
}

/// The threads could not be started.
#[derive(Debug)]
pub struct ThreadError(String);

impl core::fmt::Display for ThreadError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "could not start the threads: {}", self.0)
    }
}

impl core::error::Error for ThreadError {}

impl Threads {
    /// `count` threads; 0 means one per core. One thread without the feature `rayon`.
    pub fn new(count: usize) -> Result<Self, ThreadError> {
        #[cfg(feature = "rayon")]
        return rayon::ThreadPoolBuilder::new()
            .num_threads(count)
            .build()
            .map(|pool| Self { pool })
            .map_err(|error| ThreadError(error.to_string()));
        #[cfg(not(feature = "rayon"))]
        {
            let _ = count;
            Ok(Self {})
        }
    }

    /// Runs `work` on these threads.
    pub fn install<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        #[cfg(feature = "rayon")]
        return self.pool.install(work);
        #[cfg(not(feature = "rayon"))]
        work()
    }

    /// How many threads there are.
    pub fn count(&self) -> usize {
        #[cfg(feature = "rayon")]
        return self.pool.current_num_threads();
        #[cfg(not(feature = "rayon"))]
        1
    }
}
