//! When two faces are the same surface, and how their parameters lie on each other.

use std::cmp::Ordering;

use casteljau_geom::glam::DVec4;
use casteljau_shape::bernstein::{multi_indices, simplex_index};

use crate::side_key::{compare, least, scaled};

/// The net of a face, homogeneous: a patch of two degrees, second index fastest, or a triangle.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum FaceNet {
    Patch([usize; 2], Vec<DVec4>),
    Triangle(usize, Vec<DVec4>),
}

/// A way to lay a patch or a triangle on itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Turn {
    /// u backwards, v backwards, then both exchanged.
    Patch { flip: [bool; 2], swap: bool },
    /// Vertex a of the new triangle is vertex `[a]` of the old one.
    Triangle([usize; 3]),
}

const PERMUTATIONS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];

impl Turn {
    /// Whether the normal turns around.
    pub fn is_odd(self) -> bool {
        match self {
            Self::Patch { flip: [u, v], swap } => u ^ v ^ swap,
            Self::Triangle(vertices) => PERMUTATIONS[3..].contains(&vertices),
        }
    }

    /// Where a place of the old lattice with so many steps is in the new one: (i, j) of a patch, all three numbers of a triangle.
    pub fn place(self, at: [u32; 3], steps: [u32; 2]) -> [u32; 3] {
        match self {
            Self::Patch { flip, swap } => {
                let [i, j] = [0, 1].map(|a| if flip[a] { steps[a] - at[a] } else { at[a] });
                if swap { [j, i, 0] } else { [i, j, 0] }
            }
            Self::Triangle(vertices) => vertices.map(|v| at[v]),
        }
    }

    /// The steps of the new lattice.
    pub fn steps(self, steps: [u32; 2]) -> [u32; 2] {
        match self {
            Self::Patch { swap: true, .. } => [steps[1], steps[0]],
            _ => steps,
        }
    }
}

impl FaceNet {
    /// The homogeneous control points.
    pub fn points(&self) -> &[DVec4] {
        match self {
            Self::Patch(_, points) | Self::Triangle(_, points) => points,
        }
    }

    /// The nets of the sides: of a patch v = 0, u = 1, v = 1, u = 0, along u and v; of a triangle by the vertex across.
    pub fn sides(&self) -> Vec<Vec<DVec4>> {
        match self {
            Self::Patch([_, n], points) => {
                let row = |j: usize| points.iter().skip(j).step_by(n + 1).copied().collect::<Vec<_>>();
                let (first, last) = (&points[..=*n], &points[points.len() - n - 1..]);
                vec![row(0), last.to_vec(), row(*n), first.to_vec()]
            }
            Self::Triangle(n, points) => {
                let at = |index: [usize; 3]| points[simplex_index(index)];
                let side = |index: &dyn Fn(usize) -> [usize; 3]| (0..=*n).map(|i| at(index(i))).collect();
                vec![side(&|i| [0, i, n - i]), side(&|i| [i, 0, n - i]), side(&|i| [i, n - i, 0])]
            }
        }
    }

    fn turned(&self, turn: Turn) -> Self {
        match (self, turn) {
            (Self::Patch([m, n], points), Turn::Patch { flip, swap }) => {
                let at = |i: usize, j: usize| {
                    let i = if flip[0] { m - i } else { i };
                    let j = if flip[1] { n - j } else { j };
                    points[i * (n + 1) + j]
                };
                if swap {
                    let net = (0..=*n).flat_map(|j| (0..=*m).map(move |i| (i, j)));
                    Self::Patch([*n, *m], net.map(|(i, j)| at(i, j)).collect())
                } else {
                    let net = (0..=*m).flat_map(|i| (0..=*n).map(move |j| (i, j)));
                    Self::Patch([*m, *n], net.map(|(i, j)| at(i, j)).collect())
                }
            }
            (Self::Triangle(n, points), Turn::Triangle(vertices)) => {
                let old = |new: [usize; 3]| {
                    let mut index = [0; 3];
                    for (entry, vertex) in new.into_iter().zip(vertices) {
                        index[vertex] = entry;
                    }
                    points[simplex_index(index)]
                };
                Self::Triangle(*n, multi_indices::<3>(*n).map(old).collect())
            }
            _ => self.clone(),
        }
    }

    fn turns(&self) -> Vec<Turn> {
        match self {
            Self::Patch(..) => (0..8)
                .map(|bits| Turn::Patch { flip: [bits & 1 != 0, bits & 2 != 0], swap: bits & 4 != 0 })
                .collect(),
            Self::Triangle(..) => PERMUTATIONS.map(Turn::Triangle).into(),
        }
    }

    fn degrees(&self) -> [usize; 3] {
        match self {
            Self::Patch([m, n], _) => [4, *m, *n],
            Self::Triangle(n, _) => [3, *n, *n],
        }
    }
}

/// A face's net in the canonical form: equal for faces that are the same surface, whichever way they store it.
///
/// Of all turns and the two signs of a homogeneous net the lexicographically least one is taken, the degrees before the
/// points; a common factor is treated as for sides.
#[derive(Clone, Debug)]
pub(crate) struct FaceKey {
    pub net: FaceNet,
    /// From the face to the canonical form.
    pub turn: Turn,
}

impl FaceKey {
    pub fn new(net: &FaceNet) -> Self {
        let plain = match net {
            FaceNet::Patch(degrees, points) => FaceNet::Patch(*degrees, scaled(points)),
            FaceNet::Triangle(degree, points) => FaceNet::Triangle(*degree, scaled(points)),
        };
        let candidate = |turn: Turn| {
            let turned = plain.turned(turn);
            let points = turned.points().to_vec();
            let signed = least(points.clone(), points.iter().map(|&p| -p).collect());
            let net = match turned {
                FaceNet::Patch(degrees, _) => FaceNet::Patch(degrees, signed),
                FaceNet::Triangle(degree, _) => FaceNet::Triangle(degree, signed),
            };
            Self { net, turn }
        };
        let turns = plain.turns();
        let mut best = candidate(turns[0]);
        for &turn in &turns[1..] {
            let other = candidate(turn);
            let order = other.net.degrees().cmp(&best.net.degrees());
            if order.then_with(|| compare(other.net.points(), best.net.points())) == Ordering::Less {
                best = other;
            }
        }
        // Weights that are all −1 came from the sign that was chosen.
        if let FaceNet::Patch(_, points) | FaceNet::Triangle(_, points) = &mut best.net
            && points.iter().all(|p| p.w == -1.0)
        {
            points.iter_mut().for_each(|p| *p = -*p + DVec4::ZERO);
        }
        best
    }

    /// The bits, to look it up by.
    pub fn bits(&self) -> Vec<u64> {
        let degrees = self.net.degrees().map(|d| d as u64);
        let points = self.net.points().iter().flat_map(|p| p.to_array().map(f64::to_bits));
        degrees.into_iter().chain(points).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_face_is_the_same_and_its_lattice_lies_on_the_other() {
        let patch =
            |i: usize| DVec4::new(((i * 7) % 5) as f64, (i * i) as f64 - 3.0, 0.5 * i as f64, 1.0 + i as f64);
        let nets = [
            FaceNet::Patch([1, 2], (0..6).map(patch).collect()),
            FaceNet::Patch([2, 2], (0..9).map(patch).collect()),
            FaceNet::Triangle(2, (0..6).map(patch).collect()),
        ];
        for net in nets {
            let key = FaceKey::new(&net);
            for turn in net.turns() {
                let turned = net.turned(turn);
                let other = FaceKey::new(&turned);
                assert_eq!(other.bits(), key.bits());
                // The normal turns as often both ways.
                assert_eq!(turn.is_odd() ^ other.turn.is_odd(), key.turn.is_odd(), "{turn:?}");
                // The lattice of steps like the degrees are the control points.
                let (steps, at) = match net {
                    FaceNet::Patch([m, n], _) => ([m as u32, n as u32], [1, 2, 0]),
                    FaceNet::Triangle(n, _) => ([n as u32; 2], [1, 1, 0]),
                };
                let by_turn = other.turn.place(turn.place(at, steps), turn.steps(steps));
                assert_eq!(by_turn, key.turn.place(at, steps), "{turn:?}");
            }
        }
    }
}
