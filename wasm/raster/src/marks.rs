//! A set of columns as bits, read as runs.

/// Columns of a frame, and the one right of it.
#[derive(Debug, Default)]
pub struct Marks {
    words: Vec<u64>,
}

const BITS: usize = u64::BITS as usize;

impl Marks {
    /// The empty set of columns up to `width`, inclusive.
    pub fn clear(&mut self, width: usize) {
        self.words.clear();
        self.words.resize(width / BITS + 1, 0);
    }

    /// Adds `first..=last`.
    #[inline]
    pub fn insert(&mut self, first: usize, last: usize) {
        let (from, to) = (first / BITS, last / BITS);
        let (head, tail) = (!0 << (first % BITS), !0 >> (BITS - 1 - last % BITS));
        if from == to {
            self.words[from] |= head & tail;
            return;
        }
        self.words[from] |= head;
        self.words[from + 1..to].fill(!0);
        self.words[to] |= tail;
    }

    /// Runs of marked columns, ascending: first, and the first behind.
    pub fn runs(&self) -> impl Iterator<Item = (usize, usize)> {
        let mut at = 0;
        std::iter::from_fn(move || {
            let first = self.find(at, 0)?;
            at = self.find(first, !0).unwrap_or(self.words.len() * BITS);
            Some((first, at))
        })
    }

    /// Next column from `at` on that is marked, or not marked if `flip` is all ones.
    fn find(&self, at: usize, flip: u64) -> Option<usize> {
        let mut mask = !0 << (at % BITS);
        for (i, word) in self.words.iter().enumerate().skip(at / BITS) {
            let found = (word ^ flip) & mask;
            if found != 0 {
                return Some(i * BITS + found.trailing_zeros() as usize);
            }
            mask = !0;
        }
        None
    }
}
