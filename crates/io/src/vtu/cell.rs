//! From shapes to cells and back.

use casteljau_shape::LARGEST_COORDINATE;
use casteljau_shape::bernstein::simplex_index;

use super::order::{
    curve_order, hexahedron_order, old_hexahedron_order, quadrilateral_order, tetrahedron_order,
    triangle_order, wedge_order,
};
use crate::model::Shape;
use crate::net_record::nested;
use crate::place::Step;
use crate::record::Fault;
use crate::shape_record::UNIT;
use crate::{
    CurveRecord, Geometry, HexahedronRecord, NetRecord, PatchRecord, Reason, TetrahedronRecord,
    TriangleRecord, WedgeRecord,
};

/// The Bézier cells of VTK.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum CellKind {
    Curve,
    Triangle,
    Quadrilateral,
    Tetrahedron,
    Hexahedron,
    Wedge,
}

/// A cell: its points, with their weights, in VTK's order.
pub(super) struct Cell {
    pub(super) kind: CellKind,
    pub(super) degrees: [usize; 3],
    pub(super) nodes: Vec<([f64; 3], f64)>,
}

impl CellKind {
    pub(super) const ALL: [Self; 6] =
        [Self::Curve, Self::Triangle, Self::Quadrilateral, Self::Tetrahedron, Self::Hexahedron, Self::Wedge];

    /// VTK's number for it.
    pub(super) fn code(self) -> u8 {
        match self {
            Self::Curve => 75,
            Self::Triangle => 76,
            Self::Quadrilateral => 77,
            Self::Tetrahedron => 78,
            Self::Hexahedron => 79,
            Self::Wedge => 80,
        }
    }

    /// VTK's name for it.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Curve => "VTK_BEZIER_CURVE",
            Self::Triangle => "VTK_BEZIER_TRIANGLE",
            Self::Quadrilateral => "VTK_BEZIER_QUADRILATERAL",
            Self::Tetrahedron => "VTK_BEZIER_TETRAHEDRON",
            Self::Hexahedron => "VTK_BEZIER_HEXAHEDRON",
            Self::Wedge => "VTK_BEZIER_WEDGE",
        }
    }

    /// As files have them: of its three degrees, those that a cell of this kind has, and 0.
    pub(super) fn told(self, [a, b, c]: [usize; 3]) -> [usize; 3] {
        match self {
            Self::Curve => [a, 0, 0],
            Self::Triangle => [a, a, 0],
            Self::Quadrilateral => [a, b, 0],
            Self::Tetrahedron => [a, a, a],
            Self::Hexahedron => [a, b, c],
            Self::Wedge => [a, a, c],
        }
    }

    /// The number of control points; `None` where there is no such number.
    pub(super) fn count(self, [a, b, c]: [usize; 3]) -> Option<usize> {
        let along = |degree: usize| degree.checked_add(1);
        let simplex = |dimension: usize| {
            (1..=dimension).try_fold(1_usize, |count, i| Some(count.checked_mul(a.checked_add(i)?)? / i))
        };
        match self {
            Self::Curve => along(a),
            Self::Triangle => simplex(2),
            Self::Quadrilateral => along(a)?.checked_mul(along(b)?),
            Self::Tetrahedron => simplex(3),
            Self::Hexahedron => along(a)?.checked_mul(along(b)?)?.checked_mul(along(c)?),
            Self::Wedge => simplex(2)?.checked_mul(along(c)?),
        }
    }

    /// The place in a net of degrees `own` of each node of a cell of the same degrees, or of degree 1 where they are 0: of a
    /// net of degree 0 the one control point is at both ends.
    fn places(self, own: [usize; 3], old: bool) -> Vec<usize> {
        let [l, m, n] = own;
        let [p, q, r] = own.map(|degree| degree.max(1));
        let triangle = |index: [usize; 3]| if l == 0 { 0 } else { simplex_index(index) };
        match self {
            Self::Curve => curve_order(p).into_iter().map(|i| i.min(l)).collect(),
            Self::Triangle => triangle_order(p).into_iter().map(triangle).collect(),
            Self::Quadrilateral => {
                let place = |[i, j]: [usize; 2]| i.min(l) * (m + 1) + j.min(m);
                quadrilateral_order([p, q]).into_iter().map(place).collect()
            }
            Self::Tetrahedron => {
                let place = |index: [usize; 4]| if l == 0 { 0 } else { simplex_index(index) };
                tetrahedron_order(p).into_iter().map(place).collect()
            }
            Self::Hexahedron => {
                let order = if old { old_hexahedron_order } else { hexahedron_order };
                let place = |[i, j, k]: [usize; 3]| (i.min(l) * (m + 1) + j.min(m)) * (n + 1) + k.min(n);
                order([p, q, r]).into_iter().map(place).collect()
            }
            Self::Wedge => {
                let place = |(index, k): ([usize; 3], usize)| triangle(index) * (n + 1) + k.min(n);
                wedge_order([p, r]).into_iter().map(place).collect()
            }
        }
    }
}

impl Cell {
    /// The cell of a shape.
    pub(super) fn new(shape: &Shape) -> Result<Self, Fault> {
        match shape {
            Shape::Curve(curve) => curve_cell(&curve.net),
            Shape::Patch(patch) => patch_cell(patch.degrees, &patch.net),
            Shape::Triangle(record) => Self::of(CellKind::Triangle, [record.degree; 3], &record.net, &[]),
            Shape::Tetrahedron(record) => {
                Self::of(CellKind::Tetrahedron, [record.degree; 3], &record.net, &[])
            }
            Shape::Hexahedron(record) => {
                Self::of(CellKind::Hexahedron, record.degrees, &record.net, &record.rows())
            }
            Shape::Wedge(record) => {
                let [n, o] = record.degrees;
                Self::of(CellKind::Wedge, [n, n, o], &record.net, &[record.column()])
            }
            Shape::PowerCurve(record) => converted(record.build()?),
            Shape::PowerPatch(record) => converted(record.build()?),
            Shape::TransitionalSolid(record) => converted(record.build()?),
            Shape::RotationalSolid(record) => converted(record.build()?),
            Shape::TwistedSolid(record) => converted(record.build()?),
            Shape::GbPatch(_) => {
                let what = "GB patches: they are no Bézier cells; mesh them".into();
                Err((vec![Step::Field("kind")], Reason::Unwritable { format: "vtu", what }))
            }
        }
    }

    /// `rows` are the lengths of the rows that the file nests.
    fn of(kind: CellKind, own: [usize; 3], net: &NetRecord, rows: &[usize]) -> Result<Self, Fault> {
        let nodes = kind.places(own, false).into_iter().map(|place| node(net, place, rows));
        let degrees = kind.told(own.map(|degree| degree.max(1)));
        Ok(Self { kind, degrees, nodes: nodes.collect::<Result<_, _>>()? })
    }

    /// The shape of a cell whose nodes are as many as its degrees need; of one with weights of 1 alone, a polynomial one.
    /// `old`: the file is of a version before 2.1.
    pub(super) fn into_shape(self, old: bool) -> Shape {
        let degrees @ [l, m, n] = self.degrees;
        let places = self.kind.places(degrees, old);
        let mut points = vec![[0.0; 3]; self.nodes.len()];
        let mut weights = vec![1.0; self.nodes.len()];
        for (place, (point, weight)) in places.into_iter().zip(self.nodes) {
            if let (Some(p), Some(w)) = (points.get_mut(place), weights.get_mut(place)) {
                (*p, *w) = (point, weight);
            }
        }
        let net = match weights.iter().all(|w| *w == 1.0) {
            true => NetRecord::Points(points),
            false => NetRecord::Weighted { points, weights },
        };
        match self.kind {
            CellKind::Curve => Shape::Curve(CurveRecord { net, interval: UNIT }),
            CellKind::Triangle => Shape::Triangle(TriangleRecord { degree: l, net }),
            CellKind::Quadrilateral => {
                Shape::Patch(PatchRecord { degrees: [l, m], net, intervals: [UNIT; 2] })
            }
            CellKind::Tetrahedron => Shape::Tetrahedron(TetrahedronRecord { degree: l, net }),
            CellKind::Hexahedron => {
                Shape::Hexahedron(HexahedronRecord { degrees, net, intervals: [UNIT; 3] })
            }
            CellKind::Wedge => Shape::Wedge(WedgeRecord { degrees: [l, n], net, interval: UNIT }),
        }
    }
}

fn curve_cell(net: &NetRecord) -> Result<Cell, Fault> {
    Cell::of(CellKind::Curve, [net.len().saturating_sub(1), 0, 0], net, &[])
}

fn patch_cell([m, n]: [usize; 2], net: &NetRecord) -> Result<Cell, Fault> {
    Cell::of(CellKind::Quadrilateral, [m, n, 0], net, &[n + 1])
}

/// A power basis in Bernstein form, a construction as the hexahedron that it is. Their nets are not in the file.
fn converted(geometry: Geometry) -> Result<Cell, Fault> {
    let refused = |error| (vec![Step::Field("coefficients")], Reason::Shape(Box::new(error)));
    match geometry {
        Geometry::PowerCurve(curve) => curve_cell(&NetRecord::from(&curve.to_bezier().map_err(refused)?)),
        Geometry::PowerPatch(patch) => {
            patch_cell(patch.degrees(), &NetRecord::from(&patch.to_bezier().map_err(refused)?))
        }
        Geometry::Constructed(solid) => {
            let solid = solid.hexahedron();
            Cell::of(CellKind::Hexahedron, solid.degrees(), &NetRecord::from(solid), &[])
                .map_err(|(_, reason)| (Vec::new(), reason))
        }
        _ => Err((Vec::new(), Reason::NoNet)),
    }
}

/// A control point with its weight.
fn node(net: &NetRecord, place: usize, rows: &[usize]) -> Result<([f64; 3], f64), Fault> {
    let missing = ([0.0; 3], 0.0);
    Ok(match net {
        NetRecord::Points(points) => points.get(place).map_or(missing, |p| (*p, 1.0)),
        NetRecord::Weighted { points, weights } => {
            points.get(place).zip(weights.get(place)).map_or(missing, |(p, w)| (*p, *w))
        }
        NetRecord::Homogeneous(points) => match points.get(place) {
            // It contributes nothing, wherever it is.
            None | Some([0.0, 0.0, 0.0, 0.0]) => missing,
            Some([x, y, z, w]) => {
                let point = [x / w, y / w, z / w];
                // Shapes have a largest coordinate, and reading multiplies again.
                let held = |c: &f64| c.abs() <= LARGEST_COORDINATE && (c * w).abs() <= LARGEST_COORDINATE;
                if !point.iter().all(held) {
                    let steps = [vec![Step::Field("homogeneous")], nested(place, rows)].concat();
                    let what = match *w {
                        0.0 => "a control point at infinity".into(),
                        w => format!("a control point of weight {w:e} beyond {LARGEST_COORDINATE:e}"),
                    };
                    return Err((steps, Reason::Unwritable { format: "vtu", what }));
                }
                (point, *w)
            }
        },
    })
}

/// The degrees of a cell of which only the number of its control points is known: they are all equal.
pub(super) fn degrees_of(kind: CellKind, count: usize) -> Option<[usize; 3]> {
    let counts = |degree: usize| kind.count([degree; 3]).is_none_or(|c| c >= count);
    // The least one that is enough.
    let degree = match kind {
        CellKind::Curve => count.checked_sub(1)?,
        _ => (1..=count).find(|&degree| counts(degree))?,
    };
    (degree >= 1 && kind.count([degree; 3]) == Some(count)).then_some([degree; 3])
}

#[cfg(test)]
mod tests {
    use casteljau_shape::bernstein::simplex_count;

    use super::*;

    #[test]
    fn degrees_and_counts() {
        for kind in CellKind::ALL {
            for degree in 1..9 {
                let count = kind.count([degree; 3]).unwrap();
                assert_eq!(kind.places([degree; 3], false).len(), count);
                assert_eq!(degrees_of(kind, count), Some([degree; 3]));
            }
            assert_eq!(kind.count([usize::MAX; 3]), None);
        }
        assert_eq!(degrees_of(CellKind::Hexahedron, 9), None);
        assert_eq!(degrees_of(CellKind::Curve, 1), None);
        assert_eq!(simplex_count::<4>(3), CellKind::Tetrahedron.count([3; 3]).unwrap());
    }
}
