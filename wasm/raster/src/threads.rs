//! Hands out jobs to scoped threads and returns the answers in the jobs' order.

use std::num::NonZero;
use std::sync::Mutex;
use std::thread;

/// Runs every job of `jobs` with some worker's state; which worker takes which job does not show in the answers.
///
/// Every worker calls `prepare` first, to do its share of what all jobs need.
pub fn map_ordered<J: Send, S: Default, A: Send>(
    threads: usize,
    prepare: impl Fn() + Sync,
    jobs: impl ExactSizeIterator<Item = J> + Send,
    work: impl Fn(&mut S, J) -> A + Sync,
) -> Vec<A> {
    let workers = count(threads).min(jobs.len());
    let queue = Mutex::new(jobs.enumerate());
    let worker = || {
        prepare();
        let mut state = S::default();
        let mut answers = Vec::new();
        while let Some((index, job)) = take(&queue) {
            answers.push((index, work(&mut state, job)));
        }
        answers
    };
    let mut answers = thread::scope(|scope| {
        let others: Vec<_> = (1..workers).map(|_| scope.spawn(worker)).collect();
        let mut answers = worker();
        for other in others {
            match other.join() {
                Ok(more) => answers.extend(more),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        answers
    });
    answers.sort_unstable_by_key(|(index, _)| *index);
    answers.into_iter().map(|(_, answer)| answer).collect()
}

fn take<I: Iterator>(queue: &Mutex<I>) -> Option<I::Item> {
    // A poisoned queue means that another worker panicked: stop, its panic is passed on.
    queue.lock().ok()?.next()
}

/// Zero means one thread for every core.
fn count(threads: usize) -> usize {
    let cores = thread::available_parallelism().map_or(1, NonZero::get);
    if threads == 0 { cores } else { threads.min(MOST_THREADS) }
}

/// More threads than this are a mistake of the caller, not a machine.
const MOST_THREADS: usize = 256;
