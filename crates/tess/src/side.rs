//! Vertices along a side, decided by its curve alone.

use casteljau_geom::glam::{DVec3, DVec4};
use casteljau_shape::{Curve, RationalCurve, ShapeError};

use crate::Density;
use crate::side_curve::SideCurve;
use crate::side_key::SideKey;

/// The parameters are multiples of this, so that 1 − t is exact.
const GRAIN: f64 = 1.0 / (1u64 << 52) as f64;
/// Samples closer than this in the parameter are never asked for.
const CLOSEST: f64 = 1.0 / (1u64 << 32) as f64;
/// A chord of length ℓ along a side of length L is kept below √(16·tolerance·L) even where the side is straight: the
/// surface beside it is taken to bend with a radius of 2L at most.
const STRAIGHT_FACTOR: f64 = 16.0;
/// Most growth of the chord length per length along the side.
const GROWTH: f64 = 0.25;

/// Why a side has no samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NoSamples {
    /// It would take about so many.
    TooMany(f64),
    /// The curve has a pole.
    Shape(ShapeError),
}

impl From<ShapeError> for NoSamples {
    fn from(error: ShapeError) -> Self {
        Self::Shape(error)
    }
}

/// Points along a curve that depend on the curve alone, not on the patch it bounds nor on the way it is run.
///
/// Curves C(t) and C(1−t) give the same points to the bit, in opposite order: of the two lists of control points the
/// lexicographically smaller one is sampled, and of a curve that runs back on itself one half. Zeros have no sign there. The ends are the end points of the control net.
/// A curve with the same course but other control points, one raised in degree for example, is another curve: its points
/// agree with these to rounding only.
#[derive(Clone, Debug, PartialEq)]
pub struct SideSamples {
    parameters: Vec<f64>,
    points: Vec<DVec3>,
    chord_error: f64,
}

impl SideSamples {
    /// Samples for a chord tolerance in model units, or so many evenly spaced edges; `None` where that takes more than
    /// `limit` edges (or the tolerance is not a positive number, or the resolution 0).
    ///
    /// With a tolerance the edges lie within it by a bound, not by measurement: with `[a, b]` the interval of an edge and
    /// Q the control points of the curve over it, |C(t) − chord| ≤ (1 − 2^{1−d})·max |Q_i − chord|. Their
    /// density follows √|C″| across the tangent and changes gently; straight curves get edges of length
    /// √(16·tolerance·length), because the surface beside them bends.
    /// Cost: 0.1 µs an edge and degree².
    ///
    /// ```
    /// use casteljau_gb::glam::dvec3;
    /// use casteljau_shape::Curve;
    /// use casteljau_tess::{Density, SideSamples};
    /// let arch = Curve::new(vec![dvec3(0., 0., 0.), dvec3(1., 2., 0.), dvec3(3., 0., 0.)])?;
    /// let there = SideSamples::new(&arch, Density::Tolerance(1e-3), 1000).unwrap();
    /// let back = SideSamples::new(&arch.reversed(), Density::Tolerance(1e-3), 1000).unwrap();
    /// assert!(there.chord_error() <= 1e-3);
    /// assert!(there.points().iter().eq(back.points().iter().rev()));
    /// assert!(SideSamples::new(&arch, Density::Tolerance(1e-3), 3).is_none());
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    pub fn new(curve: &Curve, density: Density, limit: usize) -> Option<Self> {
        let net: Vec<DVec4> = curve.control_points().iter().map(|p| p.extend(1.0)).collect();
        Self::of_key(&SideKey::new(&net), density, limit).ok()
    }

    /// As [`new`](Self::new), for a rational curve; `None` also where it has a pole.
    ///
    /// Homogeneous control points decide which curves are the same: two nets that differ by a factor −1 or a power of
    /// two, and a net of equal weights and that of the polynomial curve. The bound counts the inner control points by
    /// their share in the denominator, W(1 − 2^{1−d})/(W(1 − 2^{1−d}) + w 2^{1−d}), W being their largest weight and w the
    /// lesser one at the ends.
    pub fn rational(curve: &RationalCurve, density: Density, limit: usize) -> Option<Self> {
        Self::of_key(&SideKey::new(curve.control_points()), density, limit).ok()
    }

    /// Samples in the direction of the curve that the key was made of.
    pub(crate) fn of_key(key: &SideKey, density: Density, limit: usize) -> Result<Self, NoSamples> {
        let canonical = Self::canonical(key, density, limit)?;
        Ok(if key.reversed { canonical.reversed() } else { canonical })
    }

    /// Samples in the canonical direction.
    pub(crate) fn canonical(key: &SideKey, density: Density, limit: usize) -> Result<Self, NoSamples> {
        const NONSENSE: NoSamples = NoSamples::TooMany(f64::INFINITY);
        let curve = SideCurve::new(key)?;
        let (parameters, chord_error) = match density {
            // A point needs no vertices but itself.
            Density::Resolution(1..) | Density::Tolerance(_) if key.collapsed => (Vec::new(), 0.0),
            Density::Resolution(0) => return Err(NONSENSE),
            Density::Resolution(count) if count > limit => return Err(NoSamples::TooMany(count as f64)),
            Density::Resolution(count) => ((1..count).map(|i| snap(i as f64 / count as f64)).collect(), 0.0),
            Density::Tolerance(tolerance) if tolerance > 0.0 && tolerance.is_finite() => {
                let place = if key.symmetric { there_and_back } else { adapt };
                place(&curve, tolerance, limit)?
            }
            Density::Tolerance(_) => return Err(NONSENSE),
        };
        let [first, last] = key.ends();
        let mut points = Vec::with_capacity(parameters.len() + 2);
        points.push(first);
        for &t in &parameters {
            points.push(curve.point(t)? + DVec3::ZERO);
        }
        points.push(last);
        let mut parameters: Vec<f64> = std::iter::once(0.0).chain(parameters).chain([1.0]).collect();
        if key.symmetric {
            // The way back is the way there, to the bit.
            let last = points.len() - 1;
            for (there, back) in (0..points.len() / 2).map(|i| (i, last - i)) {
                points[back] = points[there];
                parameters[back] = 1.0 - parameters[there];
            }
        }
        Ok(Self { parameters, points, chord_error })
    }

    /// Parameters, from 0 to 1, strictly increasing.
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// Points, from the curve's first control point to its last, zeros without sign.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// Bound on the distance between the curve and its edges, in model units; 0 where only a resolution was asked for.
    pub fn chord_error(&self) -> f64 {
        self.chord_error
    }

    /// The other way round, exactly.
    pub(crate) fn reversed(&self) -> Self {
        Self {
            parameters: self.parameters.iter().rev().map(|t| 1.0 - t).collect(),
            points: self.points.iter().rev().copied().collect(),
            chord_error: self.chord_error,
        }
    }
}

fn snap(t: f64) -> f64 {
    (t / GRAIN).round() * GRAIN
}

/// Inner parameters whose chords are within the tolerance, and the bound on what they miss.
fn adapt(curve: &SideCurve, tolerance: f64, limit: usize) -> Result<(Vec<f64>, f64), NoSamples> {
    let profile = Profile::new(curve, tolerance)?;
    let mut wanted = profile.count();
    for _ in 0..40 {
        if wanted.is_nan() || wanted > limit as f64 {
            return Err(NoSamples::TooMany(wanted));
        }
        let parameters = profile.place(wanted.ceil().max(1.0) as usize);
        let error = chord_bound(curve, &parameters)?;
        if error <= tolerance {
            return Ok((parameters, error));
        }
        wanted = wanted.ceil() * (error / tolerance).sqrt().clamp(1.05, 2.0);
    }
    halve(curve, 1.0, tolerance, limit)
}

/// For a curve that runs back on itself, C(t) = C(1−t): the parameters of one half serve the other.
fn there_and_back(curve: &SideCurve, tolerance: f64, limit: usize) -> Result<(Vec<f64>, f64), NoSamples> {
    let (there, error) = halve(curve, 0.5, tolerance, limit / 2)?;
    let back: Vec<f64> = there.iter().rev().skip(1).map(|t| 1.0 - t).collect();
    Ok(([there, back].concat(), error))
}

/// Halving of `[0, end]`, for curves that the density does not understand; the parameters above 0 and below 1.
fn halve(curve: &SideCurve, end: f64, tolerance: f64, limit: usize) -> Result<(Vec<f64>, f64), NoSamples> {
    let (mut parameters, mut largest) = (Vec::new(), 0.0f64);
    let mut todo = vec![[0.0, end]];
    while let Some([a, b]) = todo.pop() {
        let error = curve.segment_bound(a, b)?;
        if error > tolerance && b - a > 2.0 * CLOSEST {
            let middle = snap(0.5 * (a + b));
            todo.extend([[middle, b], [a, middle]]);
        } else {
            largest = largest.max(error);
            parameters.extend((b < 1.0).then_some(b));
        }
        if parameters.len() + todo.len() > limit {
            return Err(NoSamples::TooMany((parameters.len() + todo.len()) as f64));
        }
    }
    Ok((parameters, largest))
}

/// Largest [`segment_bound`](SideCurve::segment_bound) between successive parameters.
fn chord_bound(curve: &SideCurve, inner: &[f64]) -> Result<f64, NoSamples> {
    let ends = inner.iter().copied().chain([1.0]);
    let mut start = 0.0;
    let mut largest = 0.0f64;
    for end in ends {
        largest = largest.max(curve.segment_bound(start, end)?);
        start = end;
    }
    Ok(largest)
}

/// How many chords are wanted up to each of a row of parameters.
struct Profile {
    total: Vec<f64>,
}

impl Profile {
    fn new(curve: &SideCurve, tolerance: f64) -> Result<Self, ShapeError> {
        let steps = 8 * curve.degree() + 24;
        let jets: Vec<_> =
            (0..=steps).map(|i| curve.jet(i as f64 / steps as f64)).collect::<Result<_, _>>()?;
        // Trapezoids; the length need not be exact.
        let ds: Vec<f64> =
            jets.windows(2).map(|w| 0.5 * (w[0].d1.length() + w[1].d1.length()) / steps as f64).collect();
        let length: f64 = ds.iter().sum();
        let longest = (STRAIGHT_FACTOR * tolerance * length).sqrt();
        // Chord length wanted at each parameter, from |C″| across the tangent.
        let mut chord: Vec<f64> = jets
            .iter()
            .map(|jet| {
                let speed = jet.d1.length();
                let square = speed * speed;
                let across =
                    if square > 0.0 { jet.d1.cross(jet.d2).length() / (square * speed) } else { 0.0 };
                let chord = (8.0 * tolerance / across).sqrt();
                if chord.is_nan() { longest } else { chord.min(longest) }
            })
            .collect();
        for i in 0..steps {
            chord[i + 1] = chord[i + 1].min(chord[i] + GROWTH * ds[i]);
        }
        for i in (0..steps).rev() {
            chord[i] = chord[i].min(chord[i + 1] + GROWTH * ds[i]);
        }
        let mut total = vec![0.0];
        let mut sum = 0.0;
        for (w, ds) in chord.windows(2).zip(&ds) {
            let mean = 0.5 * (w[0] + w[1]);
            sum += if mean > 0.0 { ds / mean } else { 0.0 };
            total.push(sum);
        }
        if sum <= 0.0 {
            total = (0..=steps).map(|i| i as f64 / steps as f64).collect();
        }
        Ok(Self { total })
    }

    fn count(&self) -> f64 {
        self.total[self.total.len() - 1]
    }

    /// The inner ones of `count` + 1 parameters that share the total evenly.
    fn place(&self, count: usize) -> Vec<f64> {
        let (steps, all) = (self.total.len() - 1, self.count());
        let mut parameters = Vec::with_capacity(count);
        let (mut step, mut last) = (0, 0.0);
        for i in 1..count {
            let share = all * i as f64 / count as f64;
            while step + 1 < steps && self.total[step + 1] < share {
                step += 1;
            }
            let (low, high) = (self.total[step], self.total[step + 1]);
            let part = if high > low { ((share - low) / (high - low)).clamp(0.0, 1.0) } else { 0.5 };
            let t = snap((step as f64 + part) / steps as f64);
            if t - last >= CLOSEST && 1.0 - t >= CLOSEST {
                parameters.push(t);
                last = t;
            }
        }
        parameters
    }
}
