//! Two polynomial equations in two unknowns, `f(u,v) = 0` on `[0, 1]²`, in Bernstein form.
//!
//! A box is left out where the coefficients of a combination of the equations have one sign. The combinations tried
//! are the equations themselves and `J⁻¹f`, J being the Jacobian in the middle of the box, whose Jacobian is near
//! the unit matrix on small boxes. Where it differs from it by less than 1 in the row sums, f is one-to-one on
//! the box; Krawczyk's test then shows that there is a root.
//!
//! Source: Krawczyk, *Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken*, 1969; Mourrain and
//! Pavone, *Subdivision methods for solving polynomial equations*, 2009.

use std::collections::VecDeque;

use casteljau_bernstein::{TensorNet, restrict_tensor};
use casteljau_geom::UNIT_ROUNDOFF;
use casteljau_geom::glam::{DMat2, DVec2};

/// Boxes looked at, at most.
const MOST_BOXES: usize = 20_000;

/// A box of parameters.
pub(super) type Area = [[f64; 2]; 2];

/// f, with a bound on the error of its coefficients and of their restrictions.
pub(super) struct System {
    net: Vec<DVec2>,
    degrees: [usize; 2],
    error: f64,
}

/// A root that is proved, and the only one in `around`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Isolated {
    pub at: DVec2,
    /// The root lies within so much of `at`, by each parameter.
    pub radius: DVec2,
    around: Area,
}

/// A box in which a root is proved, in local parameters of `[−1, 1]²`.
struct Krawczyk {
    /// |J⁻¹f(0)|, rounding included.
    step: f64,
    /// Bound of |J⁻¹∂f − 1| on the box, below 1.
    deviation: f64,
}

impl Krawczyk {
    /// The root lies within so much of the middle.
    fn reach(&self) -> f64 {
        self.step / (1.0 - self.deviation)
    }
}

/// The roots of a system.
pub(super) struct Roots {
    pub isolated: Vec<Isolated>,
    pub undecided: Vec<Area>,
}

/// What one box was found to be.
enum Verdict {
    Empty,
    Root(Isolated),
    Open,
}

impl System {
    /// `coefficient_error` bounds the error of each coefficient, `largest` what they are made of.
    pub fn new(net: Vec<DVec2>, degrees: [usize; 2], coefficient_error: f64, largest: f64) -> Self {
        let degree = (degrees[0] + degrees[1] + 2) as f64;
        Self { net, degrees, error: coefficient_error + 8.0 * degree * UNIT_ROUNDOFF * largest }
    }

    /// All roots in `[0, 1]²`: proved, or in boxes no wider than `resolution` (wider only where the work ends).
    ///
    /// Breadth first, so that what is left when the work ends is evenly fine.
    pub fn roots(&self, resolution: f64) -> Roots {
        let mut roots = Roots { isolated: Vec::new(), undecided: Vec::new() };
        let mut queue = VecDeque::from([[[0.0, 1.0]; 2]]);
        let mut part = self.net.clone();
        let mut looked = 0;
        while let Some(area) = queue.pop_front() {
            if roots.isolated.iter().any(|known| contains(&known.around, &area)) {
                continue;
            }
            looked += 1;
            let verdict = if looked > MOST_BOXES { Verdict::Open } else { self.examine(&area, &mut part) };
            match verdict {
                Verdict::Empty => {}
                Verdict::Root(root) => {
                    // Neighbours see the same root; it is the only one in either's box.
                    let same = |known: &Isolated| holds(&known.around, root.at, root.radius);
                    match roots.isolated.iter_mut().find(|known| same(known)) {
                        // The box around covers the piece just seen, so the search goes on elsewhere.
                        Some(known) if !contains(&known.around, &area) => {
                            known.around = root.around;
                        }
                        Some(_) => {}
                        None => roots.isolated.push(root),
                    }
                }
                Verdict::Open => {
                    let width = area.map(|[a, b]| b - a);
                    if width[0].max(width[1]) <= resolution || looked > MOST_BOXES {
                        roots.undecided.push(area);
                    } else {
                        let axis = usize::from(width[1] > width[0]);
                        let [a, b] = area[axis];
                        let middle = 0.5 * (a + b);
                        for half in [[a, middle], [middle, b]] {
                            let mut child = area;
                            child[axis] = half;
                            queue.push_back(child);
                        }
                    }
                }
            }
        }
        // A root may have been met from a box that is now another's.
        let inside =
            |r: &Isolated| (0..2).all(|k| r.at[k] + r.radius[k] >= 0.0 && r.at[k] - r.radius[k] <= 1.0);
        roots.isolated.retain(inside);
        roots
    }

    fn examine(&self, area: &Area, part: &mut [DVec2]) -> Verdict {
        if restrict_tensor(&self.net, self.degrees, *area, part).is_err() {
            return Verdict::Open;
        }
        if self.excluded(part, DMat2::IDENTITY) {
            return Verdict::Empty;
        }
        let Some(inverse) = self.preconditioner(part) else { return Verdict::Open };
        if self.excluded(part, inverse) {
            return Verdict::Empty;
        }
        // One-to-one? Then Newton's method finds the root, if it is near.
        if self.deviation(part, inverse).max_element() >= 1.0 {
            return Verdict::Open;
        }
        let middle = DVec2::new(area[0][0] + area[0][1], area[1][0] + area[1][1]) * 0.5;
        let Some(at) = self.newton(middle) else { return Verdict::Open };
        let width = DVec2::new(area[0][1] - area[0][0], area[1][1] - area[1][0]);
        // The root may lie a little outside, where neighbours find it too.
        if (0..2).any(|k| at[k] < area[k][0] - 0.25 * width[k] || at[k] > area[k][1] + 0.25 * width[k]) {
            return Verdict::Open;
        }
        self.isolate(at, width, part).map_or(Verdict::Open, Verdict::Root)
    }

    /// Krawczyk's test on a box around an approximate root that holds the box where it was met.
    fn isolate(&self, at: DVec2, width: DVec2, part: &mut [DVec2]) -> Option<Isolated> {
        let degree = (self.degrees[0] + self.degrees[1] + 1) as f64;
        // So far beyond the unit square the coefficients grow by a factor below e² only.
        let half = width * 1.26;
        let beyond = (0..2).map(|k| (half[k] - at[k]).max(at[k] + half[k] - 1.0)).fold(0.0, f64::max);
        if beyond > 1.0 / degree {
            return None;
        }
        let first = self.krawczyk(at, half, part)?;
        let around = [0, 1].map(|k| [at[k] - half[k], at[k] + half[k]]);
        // The Jacobian changes less on a smaller box, which encloses the root more tightly.
        let smaller = half * first.step.sqrt();
        let second = self.krawczyk(at, smaller, part).map(|k| smaller * k.reach());
        let radius = second.map_or(half * first.reach(), |radius| radius.min(half * first.reach()));
        Some(Isolated { at, radius, around })
    }

    /// Krawczyk's test on the box `at ± half`: `None` if it does not show a root.
    fn krawczyk(&self, at: DVec2, half: DVec2, part: &mut [DVec2]) -> Option<Krawczyk> {
        let around = [0, 1].map(|k| [at[k] - half[k], at[k] + half[k]]);
        restrict_tensor(&self.net, self.degrees, around, part).ok()?;
        let inverse = self.preconditioner(part)?;
        let deviation = self.deviation(part, inverse).max_element();
        let [u, v] = at.to_array();
        let value = TensorNet::validated(&self.net, self.degrees).value(u, v);
        let step = ((inverse * value).abs() + row_sums(inverse) * self.grown_error()).max_element();
        Some(Krawczyk { step, deviation }).filter(|k| k.deviation < 1.0 && k.reach() < 1.0)
    }

    /// The inverse of the Jacobian by the local parameters of `[−1, 1]²`, in the middle of a part.
    fn preconditioner(&self, part: &[DVec2]) -> Option<DMat2> {
        let mut jet = [DVec2::ZERO; 3];
        TensorNet::validated(part, self.degrees).partials(0.5, 0.5, &mut jet);
        let jacobian = DMat2::from_cols(jet[1] * 0.5, jet[2] * 0.5);
        let determinant = jacobian.determinant();
        let size = jacobian.x_axis.length() * jacobian.y_axis.length();
        // A Jacobian lost in rounding tells nothing.
        if determinant.abs() <= 64.0 * UNIT_ROUNDOFF * size {
            return None;
        }
        Some(jacobian.inverse()).filter(|m| m.is_finite())
    }

    /// Whether a component of `M f` has all its coefficients on one side of 0.
    fn excluded(&self, part: &[DVec2], m: DMat2) -> bool {
        let unsure = row_sums(m) * self.error;
        let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for &c in part {
            let g = m * c;
            (low, high) = (low.min(g), high.max(g));
        }
        low.cmpgt(unsure).any() || high.cmplt(-unsure).any()
    }

    /// Row sums of a bound of `|∂(M f) − 1|` over a part, by local parameters of `[−1, 1]²`.
    fn deviation(&self, part: &[DVec2], m: DMat2) -> DVec2 {
        let [rows, columns] = self.degrees.map(|d| d + 1);
        let error = row_sums(m) * self.grown_error();
        let mut sums = DVec2::ZERO;
        for axis in 0..2 {
            let degree = self.degrees[axis] as f64;
            let mut most = DVec2::ZERO;
            let step = if axis == 0 { columns } else { 1 };
            for i in 0..rows - usize::from(axis == 0) {
                for j in 0..columns - usize::from(axis == 1) {
                    let place = i * columns + j;
                    let slope = m * (part[place + step] - part[place]) * (0.5 * degree);
                    let unit = if axis == 0 { DVec2::X } else { DVec2::Y };
                    most = most.max((slope - unit).abs());
                }
            }
            if self.degrees[axis] == 0 {
                most = DVec2::ONE;
            }
            sums += most + error * degree;
        }
        sums
    }

    /// The error of coefficients of a part that reaches a little beyond the unit square.
    fn grown_error(&self) -> f64 {
        8.0 * self.error
    }

    /// Newton's method for f, not far beyond the unit square.
    fn newton(&self, start: DVec2) -> Option<DVec2> {
        let mut at = start;
        let mut jet = [DVec2::ZERO; 3];
        for _ in 0..20 {
            TensorNet::validated(&self.net, self.degrees).partials(at.x, at.y, &mut jet);
            let step = DMat2::from_cols(jet[1], jet[2]).inverse() * jet[0];
            let next = at - step;
            if !(next.is_finite() && (next - 0.5).abs().max_element() < 1.5) {
                return None;
            }
            at = next;
            if step.abs().max_element() < 1e-15 {
                break;
            }
        }
        Some(at)
    }

    /// The place of least |f| that damped Gauss–Newton steps reach: the middle of a contact.
    pub fn nearest(&self, start: DVec2) -> DVec2 {
        let (mut at, mut damping) = (start, 1e-6);
        let net = TensorNet::validated(&self.net, self.degrees);
        let mut jet = [DVec2::ZERO; 3];
        for _ in 0..60 {
            net.partials(at.x, at.y, &mut jet);
            let jacobian = DMat2::from_cols(jet[1], jet[2]);
            let normal = jacobian.transpose() * jacobian;
            let trace = normal.x_axis.x + normal.y_axis.y;
            let damped = normal + DMat2::from_diagonal(DVec2::splat(damping * trace));
            let step = damped.inverse() * (jacobian.transpose() * jet[0]);
            let next = (at - step).clamp(DVec2::ZERO, DVec2::ONE);
            if next.is_finite() && net.value(next.x, next.y).length() < jet[0].length() {
                (at, damping) = (next, damping * 0.1);
            } else {
                damping *= 10.0;
            }
            if damping > 1e6 {
                break;
            }
        }
        at
    }
}

/// Sums of absolute values along the rows.
fn row_sums(m: DMat2) -> DVec2 {
    m.x_axis.abs() + m.y_axis.abs()
}

fn contains(outer: &Area, inner: &Area) -> bool {
    (0..2).all(|k| outer[k][0] <= inner[k][0] && inner[k][1] <= outer[k][1])
}

fn holds(outer: &Area, at: DVec2, radius: DVec2) -> bool {
    (0..2).all(|k| outer[k][0] <= at[k] - radius[k] && at[k] + radius[k] <= outer[k][1])
}
