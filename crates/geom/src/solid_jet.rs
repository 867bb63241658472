//! A point of a solid with its first derivatives.

use glam::{DMat3, DVec3};

/// A point of a solid and its partial derivatives of order 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SolidJet {
    /// S(u,v,w)
    pub point: DVec3,
    /// ∂S/∂u
    pub du: DVec3,
    /// ∂S/∂v
    pub dv: DVec3,
    /// ∂S/∂w
    pub dw: DVec3,
}

impl SolidJet {
    /// The Jacobian matrix `∂(x,y,z)/∂(u,v,w)`, with columns ∂u, ∂v, ∂w.
    #[must_use]
    pub fn jacobian_matrix(&self) -> DMat3 {
        DMat3::from_cols(self.du, self.dv, self.dw)
    }

    /// The Jacobian `det ∂(x,y,z)/∂(u,v,w) = ∂u · (∂v × ∂w)`, in length³: the local ratio of volumes, negative
    /// where the solid is turned inside out.
    ///
    /// Error: at most 8u·|∂u||∂v||∂w|, besides that of the derivatives.
    ///
    /// ```
    /// use casteljau_geom::{SolidJet, glam::DVec3};
    /// let jet = SolidJet { du: 2.0 * DVec3::X, dv: DVec3::Z, dw: DVec3::Y, ..SolidJet::default() };
    /// assert_eq!(jet.jacobian(), -2.0);
    /// ```
    #[must_use]
    pub fn jacobian(&self) -> f64 {
        self.du.dot(self.dv.cross(self.dw))
    }
}
