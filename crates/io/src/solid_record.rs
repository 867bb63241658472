//! Solids as files describe them.

use casteljau_geom::Interval;
use casteljau_shape::ControlPoint;
use casteljau_solid::{
    BezierHexahedron, BezierTetrahedron, BezierWedge, Hexahedron, RationalHexahedron, RationalTetrahedron,
    RationalWedge, Tetrahedron, Wedge,
};

use crate::net_record::{homogeneous, interval, vectors};
use crate::place::Step;
use crate::record::Fault;
use crate::shape_record::ends;
use crate::{Geometry, NetRecord};

/// A Bézier tetrahedron, polynomial or rational.
#[derive(Clone, Debug, PartialEq)]
pub struct TetrahedronRecord {
    /// The degree.
    pub degree: usize,
    /// The control points in descending lexicographic order, (n,0,0,0), (n−1,1,0,0), …, (0,0,0,n).
    pub net: NetRecord,
}

/// A tensor-product Bézier solid, polynomial or rational.
#[derive(Clone, Debug, PartialEq)]
pub struct HexahedronRecord {
    /// The degrees l with u, m with v and n with w.
    pub degrees: [usize; 3],
    /// The control points, `Pᵢⱼₖ` at place (i·(m+1) + j)·(n+1) + k.
    pub net: NetRecord,
    /// The intervals of u, v and w.
    pub intervals: [[f64; 2]; 3],
}

/// A Bézier wedge, triangle × interval, polynomial or rational.
#[derive(Clone, Debug, PartialEq)]
pub struct WedgeRecord {
    /// The degrees n of the triangle and o of the height.
    pub degrees: [usize; 2],
    /// The control points: the triangle's in descending lexicographic order, each with the o + 1 of its column.
    pub net: NetRecord,
    /// The interval of the height.
    pub interval: [f64; 2],
}

impl TetrahedronRecord {
    pub(crate) fn build(&self) -> Result<Geometry, Fault> {
        let degree = self.degree;
        let solid = match &self.net {
            NetRecord::Points(points) => Tetrahedron::new(degree, vectors(points)).map(Geometry::Tetrahedron),
            NetRecord::Weighted { points, weights } => {
                RationalTetrahedron::new(degree, &vectors(points), weights).map(Geometry::RationalTetrahedron)
            }
            NetRecord::Homogeneous(points) => {
                RationalTetrahedron::from_homogeneous(degree, homogeneous(points))
                    .map(Geometry::RationalTetrahedron)
            }
        };
        solid.map_err(|error| self.net.solid_fault(error, &[]))
    }
}

impl HexahedronRecord {
    pub(crate) fn build(&self) -> Result<Geometry, Fault> {
        let at = |index| [Step::Field("intervals"), Step::Index(index)];
        let [u, v, w] = self.intervals;
        let over = [interval(u, &at(0))?, interval(v, &at(1))?, interval(w, &at(2))?];
        let degrees = self.degrees;
        let solid = match &self.net {
            NetRecord::Points(points) => Hexahedron::new(degrees, vectors(points))
                .map(|s| Geometry::Hexahedron(s.with_intervals(over))),
            NetRecord::Weighted { points, weights } => {
                RationalHexahedron::new(degrees, &vectors(points), weights)
                    .map(|s| Geometry::RationalHexahedron(s.with_intervals(over)))
            }
            NetRecord::Homogeneous(points) => {
                RationalHexahedron::from_homogeneous(degrees, homogeneous(points))
                    .map(|s| Geometry::RationalHexahedron(s.with_intervals(over)))
            }
        };
        solid.map_err(|error| self.net.solid_fault(error, &self.rows()))
    }

    /// Rows in a slab, and control points in a row.
    pub(crate) fn rows(&self) -> [usize; 2] {
        [self.degrees[1], self.degrees[2]].map(|degree| degree.saturating_add(1))
    }
}

impl WedgeRecord {
    pub(crate) fn build(&self) -> Result<Geometry, Fault> {
        let over = interval(self.interval, &[Step::Field("interval")])?;
        let degrees = self.degrees;
        let solid = match &self.net {
            NetRecord::Points(points) => {
                Wedge::new(degrees, vectors(points)).map(|s| Geometry::Wedge(s.with_height(over)))
            }
            NetRecord::Weighted { points, weights } => RationalWedge::new(degrees, &vectors(points), weights)
                .map(|s| Geometry::RationalWedge(s.with_height(over))),
            NetRecord::Homogeneous(points) => RationalWedge::from_homogeneous(degrees, homogeneous(points))
                .map(|s| Geometry::RationalWedge(s.with_height(over))),
        };
        solid.map_err(|error| self.net.solid_fault(error, &[self.column()]))
    }

    /// Control points in a column.
    pub(crate) fn column(&self) -> usize {
        self.degrees[1].saturating_add(1)
    }
}

impl<'s, P> From<&'s BezierTetrahedron<P>> for TetrahedronRecord
where
    P: ControlPoint,
    NetRecord: From<&'s BezierTetrahedron<P>>,
{
    fn from(solid: &'s BezierTetrahedron<P>) -> Self {
        Self { degree: solid.degree(), net: solid.into() }
    }
}

impl<'s, P> From<&'s BezierHexahedron<P>> for HexahedronRecord
where
    P: ControlPoint,
    NetRecord: From<&'s BezierHexahedron<P>>,
{
    fn from(solid: &'s BezierHexahedron<P>) -> Self {
        let intervals: [Interval; 3] = solid.intervals();
        Self { degrees: solid.degrees(), net: solid.into(), intervals: intervals.map(ends) }
    }
}

impl<'s, P> From<&'s BezierWedge<P>> for WedgeRecord
where
    P: ControlPoint,
    NetRecord: From<&'s BezierWedge<P>>,
{
    fn from(solid: &'s BezierWedge<P>) -> Self {
        Self { degrees: solid.degrees(), net: solid.into(), interval: ends(solid.height()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::place::path_text;
    use crate::shape_record::UNIT;

    #[test]
    fn places_of_points_are_those_of_the_nested_net() {
        let bad = |count: usize, place: usize| {
            let mut points = vec![[0.0; 3]; count];
            points[place][1] = f64::NAN;
            NetRecord::Points(points)
        };
        let hexahedron = HexahedronRecord { degrees: [1, 2, 3], net: bad(24, 21), intervals: [UNIT; 3] };
        assert_eq!(path_text(&hexahedron.build().unwrap_err().0), "control_points[1][2][1][1]");
        let wedge = WedgeRecord { degrees: [1, 2], net: bad(9, 7), interval: UNIT };
        assert_eq!(path_text(&wedge.build().unwrap_err().0), "control_points[2][1][1]");
        let tetrahedron = TetrahedronRecord { degree: 1, net: bad(4, 3) };
        assert_eq!(path_text(&tetrahedron.build().unwrap_err().0), "control_points[3][1]");
    }
}
