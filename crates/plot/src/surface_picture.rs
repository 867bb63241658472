//! Patches and triangles: shaded or coloured by curvature, with isolines, nets, and de Casteljau's construction.

use casteljau_geom::BoundingBox;
use casteljau_geom::glam::{DVec2, DVec3, DVec4};
use casteljau_shape::bernstein::{multi_indices, simplex_index};
use casteljau_shape::{ParametricSurface, PatchEdge, ShapeError};

use crate::canvas::{Frame, Margins, extent, finish, text};
use crate::color::{FAINT, INK, NETS, diverging};
use crate::construction::Construction;
use crate::decoration::{axes_and_scale, color_bar, short};
use crate::domain_picture::check_counts;
use crate::patch_picture::Shading;
use crate::scene::{Pen, Scene};
use crate::shade::{Skin, color_scale, shade};
use crate::shapes::in_space;
use crate::{PlotError, SurfaceShape, View};

/// Pieces that a line on a surface is drawn in.
const PIECES: usize = 64;

/// What [`surface_picture`] shows.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceStyle {
    /// Where the eye is.
    pub view: View,
    /// How the surface is drawn; mean curvature is positive where it bends toward `∂u × ∂v`.
    pub shading: Shading,
    /// Number of lines of constant u, and of constant v; of each barycentric coordinate on a triangle.
    pub levels: usize,
    /// Whether the control nets are drawn.
    pub net: bool,
    /// The parameters (u, v), or (λ₁, λ₂), at which de Casteljau's construction is drawn: for a patch the schemes of the
    /// net's rows at v, blue, then the scheme of their points at u, orange; for a triangle its levels, a colour each.
    pub construction: Option<[f64; 2]>,
    /// Triangles wanted, in all.
    pub triangles: usize,
    /// Width of the picture in pixels.
    pub width: u32,
}

impl Default for SurfaceStyle {
    fn default() -> Self {
        Self {
            view: View::default(),
            shading: Shading::default(),
            levels: 9,
            net: true,
            construction: None,
            triangles: 4000,
            width: 800,
        }
    }
}

/// One surface, sampled.
struct Sampled<'a> {
    shape: &'a SurfaceShape,
    places: Vec<[f64; 2]>,
    points: Vec<DVec3>,
    normals: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

/// Draws patches and triangles: surface, edges, isolines and control nets, as [`patch_picture`](crate::patch_picture) does.
///
/// # Errors
/// No surface, numbers of the style out of range, a pole among the places drawn, a shape that leaves the range of numbers.
///
/// Cost: about 10 µs a triangle.
///
/// ```
/// use casteljau_plot::{SurfaceShape, SurfaceStyle, surface_picture};
/// use casteljau_shape::{Patch, geom::glam::{DVec3, dvec3}};
/// let saddle = Patch::new([1, 1], [DVec3::ZERO, DVec3::Y, DVec3::X, dvec3(1.0, 1.0, 1.0)])?;
/// let style = SurfaceStyle { construction: Some([0.5, 0.3]), ..SurfaceStyle::default() };
/// assert!(surface_picture(&[SurfaceShape::from(&saddle)], &style)?.starts_with("<svg"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn surface_picture(shapes: &[SurfaceShape], style: &SurfaceStyle) -> Result<String, PlotError> {
    check_counts(style.width, style.levels, style.triangles)?;
    let nets = shapes.iter().map(|shape| Net { points: shape.net(), lines: shape.net_lines() }).collect();
    let constructions = match style.construction {
        Some(at) => shapes.iter().map(|shape| Construction::new(shape, at)).collect::<Result<_, _>>()?,
        None => Vec::new(),
    };
    let whole = Whole {
        surfaces: shapes,
        nets,
        // The net of a single surface lies before it; among several, nets are hidden like everything else.
        net_in_front: shapes.len() == 1,
        constructions,
        closed: is_closed(shapes),
        title: title(shapes, style),
    };
    whole.picture(style)
}

/// The control points of a shape and the lines between them.
pub(crate) struct Net {
    pub(crate) points: Vec<DVec4>,
    pub(crate) lines: Vec<Vec<DVec4>>,
}

/// All that is drawn.
pub(crate) struct Whole<'a> {
    pub(crate) surfaces: &'a [SurfaceShape],
    pub(crate) nets: Vec<Net>,
    pub(crate) net_in_front: bool,
    pub(crate) constructions: Vec<Construction>,
    /// Whether the surfaces bound bodies and their normals point out of them.
    pub(crate) closed: bool,
    pub(crate) title: String,
}

impl Whole<'_> {
    /// Draws it as the style says.
    pub(crate) fn picture(&self, style: &SurfaceStyle) -> Result<String, PlotError> {
        let shapes = self.surfaces;
        let count = style.triangles / shapes.len().max(1);
        let parts = shapes.iter().map(|shape| Sampled::new(shape, count)).collect::<Result<Vec<_>, _>>()?;
        let mut shown: Vec<DVec3> = parts.iter().flat_map(|part| part.points.iter().copied()).collect();
        let size = BoundingBox::from_points(shown.iter().copied()).ok_or(PlotError::Nothing)?.diagonal();
        if style.net {
            shown.extend(self.nets.iter().flat_map(|net| &net.points).filter_map(|&p| in_space(p)));
        }
        shown.extend(self.constructions.iter().flat_map(Construction::points));
        let margins = Margins { side: 30.0, top: 66.0, bottom: 92.0 };
        let frame = Frame::new(extent(shown.iter().map(|&p| style.view.project(p)))?, style.width, &margins)?;

        // Of a closed body the far side is never seen: what lies on it is left out.
        let hidden = (style.shading != Shading::None && self.closed).then_some(style.view);
        let longest = parts.iter().map(Sampled::longest_edge).fold(0.0, f64::max);
        let mut scene = Scene::new(style.view, longest.max(size / 200.0));
        let scale = shade_all(&mut scene, &parts, style, hidden.is_some());
        let isoline = scene.pen(Pen { color: "#52606d", width: 0.7, lift: 0.4 * longest });
        let edge = scene.pen(Pen { color: INK, width: 2.2, lift: 0.8 * longest });
        for shape in shapes {
            for line in shape.isolines(style.levels) {
                draw(&mut scene, shape, &line, isoline, hidden)?;
            }
            for line in shape.edges() {
                draw(&mut scene, shape, &line, edge, hidden)?;
            }
        }
        let lift = if self.net_in_front { 4.0 * size } else { longest };
        for (index, net) in self.nets.iter().enumerate().filter(|_| style.net) {
            // Beside a construction the net is but its ground.
            let color = if self.constructions.is_empty() { NETS[index % NETS.len()] } else { FAINT };
            let pen = scene.pen(Pen { color, width: 1.0, lift });
            for line in &net.lines {
                let line: Vec<DVec3> = line.iter().filter_map(|&p| in_space(p)).collect();
                scene.line(&line, pen);
            }
            net.points.iter().filter_map(|&p| in_space(p)).for_each(|p| scene.dot(p, 2.6, pen));
        }
        for construction in &self.constructions {
            construction.draw(&mut scene, 8.0 * size);
        }

        let title = &self.title;
        let mut page = frame.page(title).add(scene.paint(&frame)).add(axes_and_scale(&frame, &style.view));
        if let Some(scale) = scale {
            let label = if style.shading == Shading::Mean { "mean curvature" } else { "Gaussian curvature" };
            page = page.add(color_bar(&frame, [-scale, scale], label, diverging));
        }
        page = page.add(text(title, DVec2::new(20.0, 27.0), "start").set("font-size", 15));
        Ok(finish(&page))
    }
}

/// Draws the triangles; gives the curvature of the full colour, if there are colours.
fn shade_all(scene: &mut Scene, parts: &[Sampled<'_>], style: &SurfaceStyle, closed: bool) -> Option<f64> {
    let values: Vec<Vec<f64>> = parts.iter().map(|part| part.curvatures(style.shading)).collect();
    let curved = matches!(style.shading, Shading::Gaussian | Shading::Mean);
    let scale = curved.then(|| color_scale(values.iter().flatten().copied()));
    for (part, values) in parts.iter().zip(&values) {
        if style.shading != Shading::None {
            let values: Vec<f64> = values.iter().map(|x| x / scale.unwrap_or(1.0)).collect();
            let Sampled { points, normals, triangles, .. } = part;
            let skin = Skin { points, normals, triangles, values: &values };
            shade(scene, &skin, &style.view, closed);
        }
    }
    scale
}

fn title(shapes: &[SurfaceShape], style: &SurfaceStyle) -> String {
    let kind = |plain: bool| if plain { "Bézier" } else { "rational Bézier" };
    let what = match shapes {
        [SurfaceShape::Patch(patch)] => {
            let [m, n] = patch.degrees();
            format!("{} patch of degrees {m} × {n}", kind(patch.weights().all(|w| w == 1.0)))
        }
        [SurfaceShape::Triangle(triangle)] => {
            format!("{} triangle of degree {}", kind(triangle.weights().all(|w| w == 1.0)), triangle.degree())
        }
        _ => format!("{} Bézier surfaces", shapes.len()),
    };
    match style.construction {
        Some([u, v]) => format!("{what}, de Casteljau's construction at ({}, {})", short(u), short(v)),
        None => what,
    }
}

impl<'a> Sampled<'a> {
    /// A grid of about `count` triangles over the parameters.
    fn new(shape: &'a SurfaceShape, count: usize) -> Result<Self, PlotError> {
        let count = count.max(2) as f64;
        let mut places = Vec::new();
        let mut triangles = Vec::new();
        match shape {
            SurfaceShape::Patch(_) => {
                let n = (count / 2.0).sqrt().ceil() as u32;
                for i in 0..=n {
                    places
                        .extend((0..=n).map(|j| [f64::from(i) / f64::from(n), f64::from(j) / f64::from(n)]));
                }
                let at = |i: u32, j: u32| i * (n + 1) + j;
                for i in 0..n {
                    for j in 0..n {
                        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                        // The diagonals alternate, so that none shows as a direction.
                        let pair =
                            if (i + j) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
                        triangles.extend(pair);
                    }
                }
            }
            SurfaceShape::Triangle(_) => {
                let n = count.sqrt().ceil() as usize;
                let index = |i: usize, j: usize| simplex_index([i, j, n - i - j]) as u32;
                places.extend(
                    multi_indices::<3>(n).map(|[i, j, _]| [i as f64 / n as f64, j as f64 / n as f64]),
                );
                for i in 0..n {
                    for j in 0..n - i {
                        triangles.push([index(i, j), index(i + 1, j), index(i, j + 1)]);
                        if i + j + 1 < n {
                            triangles.push([index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)]);
                        }
                    }
                }
            }
        }
        let places: Vec<[f64; 2]> = places.into_iter().map(|place| shape.parameters(place)).collect();
        let surface = shape.surface();
        let points =
            places.iter().map(|&[u, v]| surface.try_point(u, v)).collect::<Result<_, ShapeError>>()?;
        let normals = places.iter().map(|&[u, v]| surface.try_normal(u, v).unwrap_or(DVec3::ZERO)).collect();
        Ok(Self { shape, places, points, normals, triangles })
    }

    /// Longest edge of the triangles in space.
    fn longest_edge(&self) -> f64 {
        let edges = self.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        edges.map(|[a, b]| self.points[a as usize].distance(self.points[b as usize])).fold(0.0, f64::max)
    }

    /// Curvatures at the points, NaN where there is none; empty unless they are wanted.
    fn curvatures(&self, shading: Shading) -> Vec<f64> {
        let pick = match shading {
            Shading::Gaussian => |c: casteljau_geom::Curvatures| c.gaussian,
            Shading::Mean => |c: casteljau_geom::Curvatures| c.mean,
            _ => return Vec::new(),
        };
        let surface = self.shape.surface();
        self.places.iter().map(|&[u, v]| surface.try_curvatures(u, v).map_or(f64::NAN, pick)).collect()
    }
}

impl SurfaceShape {
    fn surface(&self) -> &dyn ParametricSurface {
        match self {
            Self::Patch(patch) => patch,
            Self::Triangle(triangle) => triangle,
        }
    }

    /// From `[0, 1]²` to the rectangle; barycentric coordinates stay.
    fn parameters(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        match self {
            Self::Patch(patch) => {
                let [u, v] = patch.intervals();
                [u.at(x), v.at(y)]
            }
            Self::Triangle(_) => [x, y],
        }
    }

    fn net(&self) -> Vec<DVec4> {
        match self {
            Self::Patch(patch) => patch.control_points().to_vec(),
            Self::Triangle(triangle) => triangle.control_points().to_vec(),
        }
    }

    /// The lines of the control net.
    fn net_lines(&self) -> Vec<Vec<DVec4>> {
        match self {
            Self::Patch(patch) => {
                let [m, n] = patch.degrees();
                let row = |i: usize| (0..=n).filter_map(|j| patch.control_point(i, j)).collect();
                let column = |j: usize| (0..=m).filter_map(|i| patch.control_point(i, j)).collect();
                (0..=m).map(row).chain((0..=n).map(column)).collect()
            }
            Self::Triangle(triangle) => triangle_lines(triangle.control_points(), triangle.degree()),
        }
    }

    /// Lines of constant parameters, as places in the unit square or triangle.
    fn isolines(&self, levels: usize) -> Vec<Vec<[f64; 2]>> {
        let inner = (1..=levels).map(|j| j as f64 / (levels + 1) as f64);
        match self {
            Self::Patch(_) => {
                inner.flat_map(|c| [straight([c, 0.0], [c, 1.0]), straight([0.0, c], [1.0, c])]).collect()
            }
            Self::Triangle(_) => inner
                .flat_map(|c| {
                    let rest = 1.0 - c;
                    [
                        straight([c, 0.0], [c, rest]),
                        straight([0.0, c], [rest, c]),
                        straight([0.0, rest], [rest, 0.0]),
                    ]
                })
                .collect(),
        }
    }

    fn edges(&self) -> Vec<Vec<[f64; 2]>> {
        let corners: &[[f64; 2]] = match self {
            Self::Patch(_) => &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]],
            Self::Triangle(_) => &[[1.0, 0.0], [0.0, 1.0], [0.0, 0.0], [1.0, 0.0]],
        };
        corners.windows(2).map(|ends| straight(ends[0], ends[1])).collect()
    }

    /// The control points of the edges, counter-clockwise.
    fn edge_nets(&self) -> Vec<Vec<DVec4>> {
        match self {
            Self::Patch(patch) => {
                let edge = |edge: PatchEdge| patch.edge(edge).control_points().to_vec();
                let back = |mut net: Vec<DVec4>| {
                    net.reverse();
                    net
                };
                let [u0, u1] = [PatchEdge::UStart, PatchEdge::UEnd].map(edge);
                let [v0, v1] = [PatchEdge::VStart, PatchEdge::VEnd].map(edge);
                vec![v0, u1, back(v1), back(u0)]
            }
            Self::Triangle(triangle) => {
                let n = triangle.degree();
                let along = |place: fn(usize, usize) -> [usize; 3]| {
                    (0..=n)
                        .filter_map(|i| {
                            let [a, b, c] = place(i, n);
                            triangle.control_point(a, b, c)
                        })
                        .collect()
                };
                vec![along(|i, n| [i, 0, n - i]), along(|i, n| [n - i, i, 0]), along(|i, n| [0, n - i, i])]
            }
        }
    }
}

fn straight(from: [f64; 2], to: [f64; 2]) -> Vec<[f64; 2]> {
    let at = |s: f64| [from[0] * (1.0 - s) + to[0] * s, from[1] * (1.0 - s) + to[1] * s];
    (0..=PIECES).map(|i| at(i as f64 / PIECES as f64)).collect()
}

/// The lines of a triangular net that lie along its three directions.
pub(crate) fn triangle_lines<P: Copy>(net: &[P], n: usize) -> Vec<Vec<P>> {
    let point = |i: usize, j: usize| net.get(simplex_index([i, j, n - i - j])).copied();
    let mut lines = Vec::with_capacity(3 * n);
    for c in 0..n {
        let rest = n - c;
        lines.push((0..=rest).filter_map(|j| point(c, j)).collect());
        lines.push((0..=rest).filter_map(|i| point(i, c)).collect());
        lines.push((0..=rest).filter_map(|i| point(i, rest - i)).collect());
    }
    lines
}

/// Whether every edge runs along another one the other way.
fn is_closed(shapes: &[SurfaceShape]) -> bool {
    let nets: Vec<Vec<DVec4>> = shapes.iter().flat_map(SurfaceShape::edge_nets).collect();
    let opposite = |net: &Vec<DVec4>| nets.iter().any(|other| other.iter().rev().eq(net));
    shapes.len() > 1 && nets.iter().all(opposite)
}

/// Draws a line on a surface. With `hidden`, those pieces are left out where the surface looks away.
fn draw(
    scene: &mut Scene,
    shape: &SurfaceShape,
    line: &[[f64; 2]],
    pen: usize,
    hidden: Option<View>,
) -> Result<(), PlotError> {
    let surface = shape.surface();
    let places: Vec<[f64; 2]> = line.iter().map(|&place| shape.parameters(place)).collect();
    let points =
        places.iter().map(|&[u, v]| surface.try_point(u, v)).collect::<Result<Vec<DVec3>, ShapeError>>()?;
    let seen = |&[u, v]: &[f64; 2]| {
        hidden.is_none_or(|view| surface.try_normal(u, v).is_ok_and(|n| n.dot(view.toward()) > 0.0))
    };
    for (ends, places) in points.windows(2).zip(places.windows(2)) {
        if places.iter().all(seen) {
            scene.line(ends, pen);
        }
    }
    Ok(())
}
