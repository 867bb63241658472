use casteljau_geom::glam::DVec3;
use pulp::{Arch, Simd, WithSimd};

use crate::formula::{Net, Sink, sweep};
use crate::samples::{CHUNK, check_length, each_chunk};
use crate::scalar::{LANES, Scalar, Vector};
use crate::{CenterWeight, ConcavePatch, GbError, SampleSet};

impl ConcavePatch {
    /// Number of control points that carry weight: the columns of a [`BlendMatrix`].
    pub fn control_point_count(&self) -> usize {
        let ribbons: usize = self.ribbons().iter().map(|r| r.control_points().len()).sum();
        ribbons + usize::from(self.center_weight() != CenterWeight::None) + self.corner_points().len()
    }

    /// The control points in the order of a [`BlendMatrix`]'s columns: ribbon after ribbon, each `[k][j]`, then the
    /// centre if it has a weight, then the corner points.
    ///
    /// # Errors
    /// A buffer whose length is not [`control_point_count`](Self::control_point_count).
    pub fn control_points(&self, out: &mut [DVec3]) -> Result<(), GbError> {
        check_length("the buffer of control points", self.control_point_count(), out.len())?;
        let ribbons = self.ribbons().iter().flat_map(|r| r.control_points().iter().copied());
        let center = self.center().filter(|_| self.center_weight() != CenterWeight::None);
        let corners = self.corner_points().iter().map(|c| c.point);
        for (slot, point) in out.iter_mut().zip(ribbons.chain(center).chain(corners)) {
            *slot = point;
        }
        Ok(())
    }
}

/// The patch as a matrix: point = Σ weight·control point, one row a sample, one column a control point.
///
/// The weights depend on the domain, the degrees, layers, blend power and kinds of weight, not on where the control points
/// are. Moving control points then costs one product, which changes nothing but the roundings against a fresh evaluation.
///
/// Memory: 8 bytes a weight, in blocks of eight rows. Cost: see [`BlendMatrix::apply`].
#[derive(Debug, Clone)]
pub struct BlendMatrix {
    rows: usize,
    columns: usize,
    /// `[block][column][lane]`.
    weights: Vec<f64>,
}

impl BlendMatrix {
    /// The blends of `patch` at `samples`.
    ///
    /// # Errors
    /// Samples of another number of sides.
    pub fn new(patch: &ConcavePatch, samples: &SampleSet) -> Result<Self, GbError> {
        samples.check(patch, 0)?;
        let (rows, columns) = (samples.len(), patch.control_point_count());
        let mut weights = vec![0.0; rows.div_ceil(LANES) * LANES * columns];
        let (net, stride) = (patch.net(), samples.stride());
        let mut start = Vec::with_capacity(patch.sides() + 1);
        let mut next = 0;
        for ribbon in patch.ribbons() {
            start.push(next);
            next += ribbon.control_points().len();
        }
        start.push(next);
        let chunks =
            samples.rows().chunks(CHUNK / LANES * stride).zip(weights.chunks_mut(CHUNK * columns.max(1)));
        each_chunk(chunks.collect(), |(rows, weights)| -> Result<(), GbError> {
            Arch::new().dispatch(Build { net, stride, rows, start: &start, columns, weights });
            Ok(())
        })?;
        Ok(Self { rows, columns, weights })
    }

    /// Number of samples.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of control points.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// One weight, `None` out of range.
    pub fn weight(&self, row: usize, column: usize) -> Option<f64> {
        let inside = row < self.rows && column < self.columns;
        let place = || (row / LANES * self.columns + column) * LANES + row % LANES;
        if inside { self.weights.get(place()).copied() } else { None }
    }

    /// All points from all control points: the edit product, 3 multiply-adds a weight.
    ///
    /// `control_points` in the order of [`ConcavePatch::control_points`]. Limit: the weights are read once, 8 bytes for six
    /// operations, which is 0.2 ms for 10,000 rows of 48 columns at 20 GB/s. The bits do not depend on the number of threads.
    ///
    /// # Errors
    /// A slice of a wrong length.
    pub fn apply(&self, control_points: &[DVec3], out: &mut [DVec3]) -> Result<(), GbError> {
        check_length("the slice of control points", self.columns, control_points.len())?;
        check_length("the buffer of points", self.rows, out.len())?;
        let job = |(weights, out): (&[f64], &mut [DVec3])| -> Result<(), GbError> {
            Arch::new().dispatch(Product { weights, control_points, out });
            Ok(())
        };
        // Below some 10,000 rows the product is over before another thread has woken up.
        let height =
            if self.rows <= 8 * CHUNK { self.rows.next_multiple_of(LANES).max(LANES) } else { 4 * CHUNK };
        if self.rows <= height {
            return job((&self.weights, out));
        }
        let chunks = self.weights.chunks(height * self.columns.max(1)).zip(out.chunks_mut(height));
        each_chunk(chunks.collect(), job)
    }

    /// Adds weight·`step` of one control point to every point: the control point of that column moved by `step`.
    ///
    /// Many such moves add their roundings up; [`apply`](Self::apply) starts afresh.
    ///
    /// # Errors
    /// No such column, a buffer of a wrong length.
    pub fn move_column(&self, column: usize, step: DVec3, out: &mut [DVec3]) -> Result<(), GbError> {
        check_length("the buffer of points", self.rows, out.len())?;
        if column >= self.columns {
            return Err(GbError::Structure { what: "the column", expected: self.columns, found: column });
        }
        let blocks = self.weights.chunks_exact(self.columns * LANES);
        for (block, out) in blocks.zip(out.chunks_mut(LANES)) {
            for (point, &weight) in out.iter_mut().zip(&block[column * LANES..]) {
                *point += step * weight;
            }
        }
        Ok(())
    }
}

/// Sets up one chunk of blocks.
struct Build<'a> {
    net: Net<'a>,
    stride: usize,
    rows: &'a [f64],
    start: &'a [usize],
    columns: usize,
    weights: &'a mut [f64],
}

impl WithSimd for Build<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let width = Vector::<S>::WIDTH;
        let centers = usize::from(self.net.center_weight != CenterWeight::None);
        let blocks = self.weights.chunks_exact_mut((self.columns * LANES).max(1));
        for (rows, block) in self.rows.chunks_exact(self.stride).zip(blocks) {
            for part in (0..LANES).step_by(width) {
                let load = |i: usize| Vector::load(simd, &rows[i * LANES + part..]);
                let mut sink = Store { start: self.start, centers, part, block };
                if let Some(total) = sweep(&self.net, load, &mut sink) {
                    let inverse = total.reciprocal();
                    for weight in block.chunks_exact_mut(LANES) {
                        (Vector::load(simd, &weight[part..]) * inverse).store(&mut weight[part..]);
                    }
                }
            }
        }
    }
}

/// Stores blends as they come, for the lanes from `part` on.
struct Store<'a> {
    start: &'a [usize],
    centers: usize,
    part: usize,
    block: &'a mut [f64],
}

impl Store<'_> {
    #[inline(always)]
    fn put<S: Simd>(&mut self, column: usize, weight: Vector<S>) {
        weight.store(&mut self.block[column * LANES + self.part..]);
    }
}

impl<S: Simd> Sink<Vector<S>> for Store<'_> {
    #[inline(always)]
    fn ribbon(&mut self, side: usize, along: &[Vector<S>], across: &[Vector<S>]) {
        for (k, &b) in across.iter().enumerate() {
            for (j, &m) in along.iter().enumerate() {
                self.put(self.start[side] + k * along.len() + j, m * b);
            }
        }
    }
    #[inline(always)]
    fn corner_point(&mut self, index: usize, weight: Vector<S>) {
        self.put(self.start[self.start.len() - 1] + self.centers + index, weight);
    }
    #[inline(always)]
    fn center(&mut self, weight: Vector<S>) {
        self.put(self.start[self.start.len() - 1], weight);
    }
}

/// One chunk of the product.
struct Product<'a> {
    weights: &'a [f64],
    control_points: &'a [DVec3],
    out: &'a mut [DVec3],
}

impl WithSimd for Product<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let width = Vector::<S>::WIDTH;
        let stride = self.control_points.len() * LANES;
        if stride == 0 {
            return;
        }
        for (block, out) in self.weights.chunks_exact(stride).zip(self.out.chunks_mut(LANES)) {
            for (part, out) in out.chunks_mut(width).enumerate() {
                let mut sum = [Vector::zero(simd); 3];
                for (weight, point) in block.chunks_exact(LANES).zip(self.control_points) {
                    let weight = Vector::load(simd, &weight[part * width..]);
                    sum[0] = sum[0] + weight.scale(point.x);
                    sum[1] = sum[1] + weight.scale(point.y);
                    sum[2] = sum[2] + weight.scale(point.z);
                }
                let [x, y, z] = sum.map(Vector::to_array);
                for (lane, slot) in out.iter_mut().enumerate() {
                    *slot = DVec3::new(x[lane], y[lane], z[lane]);
                }
            }
        }
    }
}
