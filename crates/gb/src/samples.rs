use casteljau_domain::{Coordinates, Location};
use casteljau_geom::SurfaceJet;
use casteljau_geom::glam::{DVec2, DVec3};
use pulp::{Arch, Simd, WithSimd};

use crate::formula::{Net, surface, surface_jet};
use crate::jet::{First, Second};
use crate::normal::unit;
use crate::scalar::{LANES, Vector};
use crate::{ConcavePatch, GbError};

/// Points that a thread takes at a time.
pub(crate) const CHUNK: usize = 2048;

/// Fixed points of a domain with their coordinates λ, and the derivatives of λ if wanted, kept for many evaluations.
///
/// The coordinates are most of the cost of a fresh point; with them at hand a point of an edited patch takes about 0.1 µs.
/// Any patch over the same domain can be evaluated, whatever its control points.
///
/// Memory: 8·n bytes a point with order 0, 24·n with order 1, 48·n with order 2, in blocks of eight points that vector
/// instructions take whole. A point's result has the same bits whatever points surround it.
#[derive(Debug, Clone)]
pub struct SampleSet {
    sides: usize,
    order: usize,
    locations: Vec<Location>,
    /// `[block][row][coordinate][lane]`; the last block is filled up with its last point.
    rows: Vec<f64>,
}

impl SampleSet {
    /// Evaluates the coordinates, and their derivatives up to `order` (0, 1 or 2), at `locations`.
    ///
    /// On sides and at corners λ is exact. Derivatives do not exist at corners: they are kept as zero and never used.
    ///
    /// # Errors
    /// A location that is outside or names no side or corner; an order above 2.
    pub fn new(coordinates: &Coordinates, locations: &[Location], order: usize) -> Result<Self, GbError> {
        let sides = coordinates.len();
        if order > 2 {
            return Err(GbError::SampleOrder { held: 2, needed: order });
        }
        let locations: Vec<Location> =
            locations.iter().map(|&location| checked(location, sides)).collect::<Result<_, _>>()?;
        let height = (order + 1) * (order + 2) / 2;
        let mut rows = vec![0.0; locations.len().div_ceil(LANES) * LANES * height * sides];
        let chunk = |(locations, rows): (&[Location], &mut [f64])| fill(coordinates, locations, order, rows);
        let size = CHUNK * height * sides;
        each_chunk(locations.chunks(CHUNK).zip(rows.chunks_mut(size)).collect(), chunk)?;
        Ok(Self { sides, order, locations, rows })
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.locations.len()
    }

    /// Whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.locations.is_empty()
    }

    /// Highest order of the derivatives kept.
    pub fn order(&self) -> usize {
        self.order
    }

    /// Number of sides of the domain.
    pub fn sides(&self) -> usize {
        self.sides
    }

    /// The points; ends of sides have become corners.
    pub fn locations(&self) -> &[Location] {
        &self.locations
    }

    /// λ of one point: value, or a derivative in the order u, v, uu, uv, vv.
    pub fn coordinate(&self, point: usize, row: usize, vertex: usize) -> Option<f64> {
        let height = (self.order + 1) * (self.order + 2) / 2;
        if point >= self.len() || row >= height || vertex >= self.sides {
            return None;
        }
        let place = ((point / LANES * height + row) * self.sides + vertex) * LANES + point % LANES;
        self.rows.get(place).copied()
    }

    pub(crate) fn stride(&self) -> usize {
        (self.order + 1) * (self.order + 2) / 2 * self.sides * LANES
    }

    pub(crate) fn rows(&self) -> &[f64] {
        &self.rows
    }

    pub(crate) fn check(&self, patch: &ConcavePatch, needed: usize) -> Result<(), GbError> {
        let (expected, found) = (patch.sides(), self.sides);
        if expected != found {
            return Err(GbError::Structure { what: "the number of sides", expected, found });
        }
        if needed > self.order {
            return Err(GbError::SampleOrder { held: self.order, needed });
        }
        Ok(())
    }
}

/// Checks a location against the number of sides; the ends of a side are corners.
pub(crate) fn checked(location: Location, sides: usize) -> Result<Location, GbError> {
    match location {
        Location::Inside(uv) if uv.is_finite() => Ok(location),
        Location::Inside(uv) => Err(GbError::Outside { uv }),
        Location::Side { side, .. } if side >= sides => Err(GbError::NoSuchSide { side, sides }),
        Location::Side { side, t: 0.0 } => Ok(Location::Corner((side + sides - 1) % sides)),
        Location::Side { side, t: 1.0 } => Ok(Location::Corner(side)),
        Location::Side { t, .. } if 0.0 < t && t < 1.0 => Ok(location),
        Location::Side { side, t } => Err(GbError::SideParameter { side, t }),
        Location::Corner(corner) if corner >= sides => Err(GbError::NoSuchCorner { corner, sides }),
        Location::Corner(_) => Ok(location),
        Location::Outside => Err(GbError::Outside { uv: DVec2::NAN }),
    }
}

/// Coordinates of up to [`CHUNK`] points into their blocks.
fn fill(
    coordinates: &Coordinates,
    locations: &[Location],
    order: usize,
    out: &mut [f64],
) -> Result<(), GbError> {
    let n = coordinates.len();
    let height = (order + 1) * (order + 2) / 2;
    let mut store = |point: usize, rows: &[f64]| {
        // The last point fills the rest of its block.
        let last = if point + 1 == locations.len() { LANES } else { point % LANES + 1 };
        let block = point / LANES * height * n * LANES;
        for lane in point % LANES..last {
            for (place, &value) in rows.iter().enumerate() {
                out[block + place * LANES + lane] = value;
            }
        }
    };
    let (mut inside, mut on_sides) = (Vec::new(), Vec::new());
    for location in locations {
        match *location {
            Location::Inside(uv) => inside.push(uv),
            Location::Side { side, t } => on_sides.push((side, t)),
            Location::Corner(_) | Location::Outside => {}
        }
    }
    let mut inside_rows = vec![0.0; inside.len() * height * n];
    coordinates.evaluate_inside(&inside, order, &mut inside_rows)?;
    let mut side_rows = vec![0.0; on_sides.len() * height * n];
    coordinates.evaluate_sides(&on_sides, order, &mut side_rows)?;
    let mut inside_rows = inside_rows.chunks_exact(height * n);
    let mut side_rows = side_rows.chunks_exact(height * n);
    let mut corner_rows = vec![0.0; height * n];
    for (point, location) in locations.iter().enumerate() {
        let rows = match *location {
            Location::Inside(_) => inside_rows.next(),
            Location::Side { .. } => side_rows.next(),
            Location::Corner(corner) => {
                corner_rows.fill(0.0);
                corner_rows[corner] = 1.0;
                Some(&corner_rows[..])
            }
            Location::Outside => None,
        };
        if let Some(rows) = rows {
            store(point, rows);
        }
    }
    Ok(())
}

/// Runs a job on every chunk, on all threads if the feature `rayon` is on and there is more than one; no result depends on it.
pub(crate) fn each_chunk<T: Send, E: Send>(
    chunks: Vec<T>,
    job: impl Fn(T) -> Result<(), E> + Send + Sync,
) -> Result<(), E> {
    #[cfg(feature = "rayon")]
    if chunks.len() > 1 {
        use rayon::prelude::*;
        // Collected first, so that the error reported is that of the first chunk.
        let results: Vec<Result<(), E>> = chunks.into_par_iter().map(job).collect();
        return results.into_iter().collect();
    }
    chunks.into_iter().try_for_each(job)
}

impl ConcavePatch {
    /// Points of the patch at fixed samples, from their kept coordinates.
    ///
    /// The bits are those of [`point_at`](Self::point_at) inside. Cost: about 0.1 µs a point for a cubic six-sided patch of
    /// two layers on one thread with AVX2; no allocation but a list of chunks.
    ///
    /// # Errors
    /// Samples of another number of sides, a buffer of a wrong length; a point that is not finite, as where
    /// [`Location::Inside`] was said of a place that is not inside.
    pub fn evaluate_samples(&self, samples: &SampleSet, out: &mut [DVec3]) -> Result<(), GbError> {
        samples.check(self, 0)?;
        check_length("the buffer of points", samples.len(), out.len())?;
        let net = self.net();
        let rows = samples.rows().chunks(CHUNK / LANES * samples.stride());
        let chunks = rows.zip(samples.locations().chunks(CHUNK)).zip(out.chunks_mut(CHUNK)).collect();
        each_chunk(chunks, |((rows, locations), out): ((&[f64], &[Location]), &mut [DVec3])| {
            Arch::new().dispatch(Values { net, stride: samples.stride(), rows, out: &mut *out });
            self.refuse_overflow(locations, out.iter().map(|point| point.is_finite()))
        })
    }

    /// Points and unit normals of the patch at fixed samples of order 1 or more.
    ///
    /// The normal is that of [`normal_at`](Self::normal_at), boundary rules included; where there is none it is zero.
    ///
    /// # Errors
    /// As [`evaluate_samples`](Self::evaluate_samples), and samples without derivatives.
    pub fn evaluate_sample_normals(
        &self,
        samples: &SampleSet,
        points: &mut [DVec3],
        normals: &mut [DVec3],
    ) -> Result<(), GbError> {
        samples.check(self, 1)?;
        check_length("the buffer of points", samples.len(), points.len())?;
        check_length("the buffer of normals", samples.len(), normals.len())?;
        let (net, sign) = (self.net(), self.handedness());
        let rows = samples.rows().chunks(CHUNK / LANES * samples.stride());
        let out = points.chunks_mut(CHUNK).zip(normals.chunks_mut(CHUNK));
        let chunks = rows.zip(samples.locations().chunks(CHUNK)).zip(out).collect();
        each_chunk(chunks, |((rows, locations), (points, normals))| {
            let stride = samples.stride();
            Arch::new().dispatch(Normals {
                net,
                stride,
                rows,
                sign,
                points: &mut *points,
                normals: &mut *normals,
            });
            for (normal, &location) in normals.iter_mut().zip(locations) {
                if !matches!(location, Location::Inside(_)) {
                    *normal = self.normal_at(location).unwrap_or(DVec3::ZERO);
                }
            }
            self.refuse_overflow(locations, points.iter().map(|point| point.is_finite()))
        })
    }

    /// Jets of the patch at fixed samples of order 2.
    ///
    /// # Errors
    /// As [`evaluate_samples`](Self::evaluate_samples), samples without derivatives, a corner among the samples, and
    /// derivatives beyond the range of f64.
    pub fn evaluate_sample_jets(&self, samples: &SampleSet, out: &mut [SurfaceJet]) -> Result<(), GbError> {
        samples.check(self, 2)?;
        check_length("the buffer of jets", samples.len(), out.len())?;
        if let Some(Location::Corner(corner)) =
            samples.locations().iter().find(|l| matches!(l, Location::Corner(_)))
        {
            return Err(GbError::CornerDerivative { corner: *corner });
        }
        let net = self.net();
        let rows = samples.rows().chunks(CHUNK / LANES * samples.stride());
        let chunks = rows.zip(samples.locations().chunks(CHUNK)).zip(out.chunks_mut(CHUNK)).collect();
        each_chunk(chunks, |((rows, locations), out): ((&[f64], &[Location]), &mut [SurfaceJet])| {
            Arch::new().dispatch(Jets { net, stride: samples.stride(), rows, out: &mut *out });
            self.refuse_overflow(locations, out.iter().map(SurfaceJet::is_finite))
        })
    }

    /// Names the first sample whose result is not finite.
    fn refuse_overflow(
        &self,
        locations: &[Location],
        mut finite: impl Iterator<Item = bool>,
    ) -> Result<(), GbError> {
        match finite.position(|finite| !finite).and_then(|i| locations.get(i)) {
            Some(&location) => Err(self.overflow(location)),
            None => Ok(()),
        }
    }
}

pub(crate) fn check_length(what: &'static str, expected: usize, found: usize) -> Result<(), GbError> {
    if expected == found { Ok(()) } else { Err(GbError::Length { what, expected, found }) }
}

/// One chunk of points.
struct Values<'a> {
    net: Net<'a>,
    stride: usize,
    rows: &'a [f64],
    out: &'a mut [DVec3],
}

impl WithSimd for Values<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let width = Vector::<S>::WIDTH;
        for (block, out) in self.rows.chunks_exact(self.stride).zip(self.out.chunks_mut(LANES)) {
            for (part, out) in out.chunks_mut(width).enumerate() {
                let load = |i: usize| Vector::load(simd, &block[i * LANES + part * width..]);
                let [x, y, z] = surface(&self.net, Vector::zero(simd), load).map(Vector::to_array);
                for (lane, point) in out.iter_mut().enumerate() {
                    *point = DVec3::new(x[lane], y[lane], z[lane]);
                }
            }
        }
    }
}

/// One chunk of points and normals.
struct Normals<'a> {
    net: Net<'a>,
    stride: usize,
    rows: &'a [f64],
    sign: f64,
    points: &'a mut [DVec3],
    normals: &'a mut [DVec3],
}

impl WithSimd for Normals<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (width, row_length) = (Vector::<S>::WIDTH, self.net.ribbons.len() * LANES);
        let out = self.points.chunks_mut(LANES).zip(self.normals.chunks_mut(LANES));
        for (block, (points, normals)) in self.rows.chunks_exact(self.stride).zip(out) {
            let out = points.chunks_mut(width).zip(normals.chunks_mut(width));
            for (part, (points, normals)) in out.enumerate() {
                let at = |row: usize, i: usize| {
                    Vector::load(simd, &block[row * row_length + i * LANES + part * width..])
                };
                let load = |i: usize| First([at(0, i), at(1, i), at(2, i)]);
                let zero = First([Vector::zero(simd); 3]);
                let [x, y, z] = surface(&self.net, zero, load).map(|jet| jet.0.map(Vector::to_array));
                for (lane, (point, normal)) in points.iter_mut().zip(normals).enumerate() {
                    let part = |k: usize| DVec3::new(x[k][lane], y[k][lane], z[k][lane]);
                    *point = part(0);
                    *normal = unit(part(1).cross(part(2)) * self.sign).unwrap_or(DVec3::ZERO);
                }
            }
        }
    }
}

/// One chunk of jets.
struct Jets<'a> {
    net: Net<'a>,
    stride: usize,
    rows: &'a [f64],
    out: &'a mut [SurfaceJet],
}

impl WithSimd for Jets<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (width, row_length) = (Vector::<S>::WIDTH, self.net.ribbons.len() * LANES);
        for (block, out) in self.rows.chunks_exact(self.stride).zip(self.out.chunks_mut(LANES)) {
            for (part, out) in out.chunks_mut(width).enumerate() {
                let at = |row: usize, i: usize| {
                    Vector::load(simd, &block[row * row_length + i * LANES + part * width..])
                };
                let load = |i: usize| Second([at(0, i), at(1, i), at(2, i), at(3, i), at(4, i), at(5, i)]);
                let zero = Second([Vector::zero(simd); 6]);
                let coordinates = surface(&self.net, zero, load).map(|jet| jet.0.map(Vector::to_array));
                for (lane, jet) in out.iter_mut().enumerate() {
                    *jet = surface_jet(coordinates.map(|c| Second(c.map(|part| part[lane]))));
                }
            }
        }
    }
}
