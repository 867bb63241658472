//! De Casteljau's construction on patches and triangles.

use casteljau_geom::glam::{DVec3, DVec4};
use casteljau_shape::bernstein::{
    TensorNet, TriangleNet, last_barycentric, scheme_count, tensor_scheme_count,
};
use casteljau_shape::{RationalPatch, RationalTriangle, ShapeError};

use crate::color::{ACCENT, FAINT, NETS};
use crate::curve_picture::levels;
use crate::scene::{Pen, Scene};
use crate::shapes::in_space;
use crate::surface_picture::triangle_lines;
use crate::{PlotError, SurfaceShape};

/// De Casteljau's construction, ready to be drawn.
pub(crate) enum Construction {
    /// The row curves' schemes, each level a polyline, and the scheme across with its polygon.
    Patch { rows: Vec<Vec<Vec<DVec3>>>, across: Vec<Vec<DVec3>> },
    /// The lines of each level's net after the first, and the point.
    Triangle { levels: Vec<Vec<Vec<DVec3>>>, point: Option<DVec3> },
}

impl Construction {
    pub(crate) fn new(shape: &SurfaceShape, [u, v]: [f64; 2]) -> Result<Self, PlotError> {
        if !(u.is_finite() && v.is_finite()) {
            return Err(PlotError::NotFinite);
        }
        match shape {
            SurfaceShape::Patch(patch) => Self::of_patch(patch, [u, v]),
            SurfaceShape::Triangle(triangle) => Self::of_triangle(triangle, [u, v]),
        }
    }

    fn of_patch(patch: &RationalPatch, [u, v]: [f64; 2]) -> Result<Self, PlotError> {
        let [m, n] = patch.degrees();
        let [in_u, in_v] = patch.intervals();
        let mut scheme = vec![DVec4::ZERO; tensor_scheme_count([m, n])];
        TensorNet::new(patch.control_points(), [m, n])
            .and_then(|net| net.scheme(in_u.local(u), in_v.local(v), &mut scheme))
            .map_err(ShapeError::from)?;
        let (rows, across) = scheme.split_at((m + 1) * scheme_count(n));
        let rows = rows.chunks(scheme_count(n)).map(|row| levels(row, n)).collect();
        Ok(Self::Patch { rows, across: levels(across, m) })
    }

    fn of_triangle(triangle: &RationalTriangle, [u, v]: [f64; 2]) -> Result<Self, PlotError> {
        let n = triangle.degree();
        let count = (n + 1) * (n + 2) * (n + 3) / 6;
        let mut scheme = vec![DVec4::ZERO; count];
        TriangleNet::new(triangle.control_points(), n)
            .and_then(|net| net.scheme([u, v, last_barycentric(&[u, v])], &mut scheme))
            .map_err(ShapeError::from)?;
        let point = scheme.last().and_then(|&p| in_space(p));
        let mut rest = &scheme[(n + 1) * (n + 2) / 2..];
        let mut levels = Vec::with_capacity(n);
        for lower in (1..n).rev() {
            let (net, left) = rest.split_at((lower + 1) * (lower + 2) / 2);
            let lines = triangle_lines(net, lower);
            levels.push(lines.into_iter().map(|l| l.into_iter().filter_map(in_space).collect()).collect());
            rest = left;
        }
        Ok(Self::Triangle { levels, point })
    }

    pub(crate) fn points(&self) -> Vec<DVec3> {
        match self {
            Self::Patch { rows, across } => rows.iter().flatten().chain(across).flatten().copied().collect(),
            Self::Triangle { levels, point } => {
                levels.iter().flatten().flatten().copied().chain(*point).collect()
            }
        }
    }

    pub(crate) fn draw(&self, scene: &mut Scene, lift: f64) {
        let point_pen = scene.pen(Pen { color: ACCENT, width: 1.0, lift: 1.5 * lift });
        match self {
            Self::Patch { rows, across } => {
                let polygon = scene.pen(Pen { color: FAINT, width: 0.9, lift });
                let first = scene.pen(Pen { color: NETS[0], width: 1.1, lift: 1.1 * lift });
                let second = scene.pen(Pen { color: NETS[3], width: 2.0, lift: 1.2 * lift });
                for row in rows {
                    for (level, points) in row.iter().enumerate() {
                        let pen = if level == 0 { polygon } else { first };
                        scene.line(points, pen);
                        points.iter().for_each(|&p| scene.dot(p, 2.2, pen));
                    }
                }
                for points in across {
                    scene.line(points, second);
                    points.iter().for_each(|&p| scene.dot(p, 3.2, second));
                }
                if let Some(&point) = across.last().and_then(|level| level.first()) {
                    scene.dot(point, 5.0, point_pen);
                }
            }
            Self::Triangle { levels, point } => {
                for (level, lines) in levels.iter().enumerate() {
                    let color = NETS[(level + 1) % NETS.len()];
                    let lift = (1.0 + 0.1 * level as f64 / levels.len() as f64) * lift;
                    let pen = scene.pen(Pen { color, width: 1.5, lift });
                    for line in lines {
                        scene.line(line, pen);
                        line.iter().for_each(|&p| scene.dot(p, 2.6, pen));
                    }
                }
                if let Some(point) = *point {
                    scene.dot(point, 5.0, point_pen);
                }
            }
        }
    }
}
