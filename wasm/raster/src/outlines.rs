//! Turns paths into chords sorted by band, some paths at a time, by whichever thread comes first.

use crate::bins::Bins;
use crate::facets::facets;
use crate::flatten::{Chords, flatten};
use crate::scene::{Frame, Paths};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Paths of a part: some tenths of a millisecond of work.
const PART: usize = 64;

/// All outlines of a call, in parts that are made when they are first asked for.
#[derive(Debug)]
pub struct Outlines<'a> {
    paths: &'a Paths<'a>,
    frame: &'a Frame<'a>,
    sampled: bool,
    parts: Vec<OnceLock<Part>>,
    /// First part that no thread has taken yet.
    next: AtomicUsize,
}

/// Outlines of some paths.
#[derive(Debug)]
pub struct Part {
    /// Index of the first of them.
    pub first: usize,
    pub chords: Chords,
    pub bins: Bins,
}

impl<'a> Outlines<'a> {
    /// Chords are facets if they are to be sampled.
    pub fn new(paths: &'a Paths<'a>, frame: &'a Frame<'a>, sampled: bool) -> Self {
        let parts = (0..paths.len().div_ceil(PART)).map(|_| OnceLock::new()).collect();
        Self { paths, frame, sampled, parts, next: AtomicUsize::new(0) }
    }

    /// Makes parts until all are taken; threads that call it share the work.
    pub fn prepare(&self) {
        while self.part(self.next.fetch_add(1, Ordering::Relaxed)).is_some() {}
    }

    /// All parts in painter's order; waits for those that other threads have taken.
    pub fn parts(&self) -> impl Iterator<Item = &Part> {
        (0..self.parts.len()).map_while(|i| self.part(i))
    }

    /// The part that holds a path of the call.
    pub fn part_of(&self, path: usize) -> Option<&Part> {
        self.part(path / PART)
    }

    fn part(&self, i: usize) -> Option<&Part> {
        let part = self.parts.get(i)?;
        Some(part.get_or_init(|| {
            let paths = self.paths.slice(i * PART..self.paths.len().min((i + 1) * PART));
            let chords = if self.sampled { facets(&paths) } else { flatten(&paths, self.frame.flatness) };
            let bins = Bins::new(&chords, self.frame.height);
            Part { first: i * PART, chords, bins }
        }))
    }
}
