/// Disjoint sets of the numbers 0…n−1, with path halving; the least member of a set is its root, so that the answer
/// does not depend on the order of the unions.
pub(crate) struct UnionFind(Vec<u32>);

impl UnionFind {
    /// Every number alone. `n` is at most 2³².
    pub(crate) fn new(n: usize) -> Self {
        Self((0..n).map(|i| i as u32).collect())
    }

    /// The least member of the set of `i`.
    pub(crate) fn root(&mut self, i: u32) -> u32 {
        let mut i = i;
        while self.0[i as usize] != i {
            let up = self.0[self.0[i as usize] as usize];
            self.0[i as usize] = up;
            i = up;
        }
        i
    }

    /// Joins two sets.
    pub(crate) fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}
