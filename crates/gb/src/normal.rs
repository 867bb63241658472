//! Normals, and the ribbon as a surface of its own.

use casteljau_domain::Location;
use casteljau_geom::SurfaceJet;
use casteljau_geom::glam::DVec3;

use crate::formula::{across_ratio_basis, along_basis, surface_jet};
use crate::jet::Second;
use crate::outline::{end_tangent, start_tangent};
use crate::scalar::Scalar;
use crate::{ConcavePatch, GbError, MAX_DEGREE, MAX_LAYERS, Ribbon};

/// Tangents whose sine is at most this are parallel: their cross product has lost half its digits.
const PARALLEL_SINE: f64 = 1e-8;

impl Ribbon {
    /// Jet of the ribbon's own surface `R(s, h) = Σ_{k<l} Σ_j C_{j,k} B_j^d(s) B_k^{2l−1}(h) / Σ_{k<l} B_k^{2l−1}(h)`, with
    /// `du` = ∂/∂s and `dv` = ∂/∂h.
    ///
    /// 0 ≤ h ≤ 1, both ends included (the common factor (1−h)^l is cancelled); any s. Negative h with a vanishing
    /// denominator gives no finite answer, and none is returned. With one layer R does not depend on h.
    pub fn jet(&self, s: f64, h: f64) -> Option<SurfaceJet> {
        let zero = [0.0; 6];
        let s = Second([s, 1.0, 0.0, 0.0, 0.0, 0.0]);
        let h = Second([h, 0.0, 1.0, 0.0, 0.0, 0.0]);
        let one = s.like(1.0);
        let (mut along, mut across) = ([Second(zero); MAX_DEGREE + 1], [Second(zero); MAX_LAYERS]);
        along_basis(self.degree(), s, one - s, &mut along);
        across_ratio_basis(self.layers(), h, one - h, &mut across);
        let mut sum = [Second(zero); 3];
        let mut total = Second(zero);
        for (k, &weight) in across[..self.layers()].iter().enumerate() {
            total = total + weight;
            for (&point, &blend) in self.row(k).iter().zip(&along) {
                let weight = weight * blend;
                for (sum, x) in sum.iter_mut().zip(point.to_array()) {
                    *sum = *sum + weight.scale(x);
                }
            }
        }
        let inverse = total.reciprocal();
        let jet = surface_jet(sum.map(|x| x * inverse));
        jet.is_finite().then_some(jet)
    }
}

impl ConcavePatch {
    /// Unit normal at a location, S_u × S_v for a counter-clockwise domain and −S_u × S_v for a clockwise one: it depends
    /// on the ribbons alone, not on the way the domain was drawn.
    ///
    /// - On a side whose order of contact is 2 or more: the ribbon's own, R_s × R_h at h = 0, to rounding.
    /// - At a corner: the cross product of the two sides' tangents, pointing as the ribbons' normals do; where the
    ///   tangents are parallel (sine at most 1e-8) or with them a side has none, the mean of the ribbons' normals.
    /// - Elsewhere: from the first derivatives.
    ///
    /// # Errors
    /// No normal there; a location that is outside or names no side or corner.
    pub fn normal_at(&self, location: Location) -> Result<DVec3, GbError> {
        match self.checked(location)? {
            Location::Corner(corner) => self.corner_normal(corner),
            Location::Side { side, t } => {
                let own = if self.contacts[side].order >= 2 { self.ribbons[side].jet(t, 0.0) } else { None };
                let own = own.and_then(|jet| unit(jet.du.cross(jet.dv)));
                own.map_or_else(|| self.jet_normal(location), Ok)
            }
            _ => self.jet_normal(location),
        }
    }

    fn jet_normal(&self, location: Location) -> Result<DVec3, GbError> {
        let jet = self.jet_at(location)?;
        let normal = jet.du.cross(jet.dv) * self.handedness();
        unit(normal).ok_or(GbError::NoNormal { location })
    }

    fn corner_normal(&self, corner: usize) -> Result<DVec3, GbError> {
        let (before, after) = (&self.ribbons[corner], &self.ribbons[(corner + 1) % self.sides()]);
        let at = before.end();
        let (arriving, leaving) = (end_tangent(before), start_tangent(after));
        // The ribbons' normals on both sides of the corner; a ribbon of one layer has none.
        let across = |ribbon: &Ribbon, j: usize| ribbon.point(j, 1).map(|p| p - at);
        let normals = [
            across(before, before.degree()).and_then(|c| unit(arriving.cross(c))),
            across(after, 0).and_then(|c| unit(leaving.cross(c))),
        ];
        let mean = unit(normals.into_iter().flatten().sum());
        let cross = arriving.cross(leaving);
        if cross.length() <= PARALLEL_SINE {
            return mean.ok_or(GbError::NoNormal { location: Location::Corner(corner) });
        }
        let agrees = match mean.map(|mean| mean.dot(cross)) {
            Some(dot) if dot != 0.0 => dot > 0.0,
            _ => !self.domain().is_concave(corner),
        };
        Ok(cross.normalize() * if agrees { 1.0 } else { -1.0 })
    }
}

/// The direction of a vector, none if it has no length.
pub(crate) fn unit(v: DVec3) -> Option<DVec3> {
    // Scaled first: squares of lengths below 1e-154 vanish.
    let largest = v.abs().max_element();
    if largest > 0.0 && largest.is_finite() { (v / largest).try_normalize() } else { None }
}
