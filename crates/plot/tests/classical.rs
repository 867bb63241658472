//! Pictures of curves, patches and triangles: well-formed, finite, within the page, the same every time.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use casteljau_geom::Interval;
use casteljau_geom::glam::{DVec3, dvec3};
use casteljau_plot::{
    CurveShape, CurveStyle, PlotError, Shading, SolidShape, SurfaceShape, SurfaceStyle, View, curve_picture,
    solid_picture, surface_picture,
};
use casteljau_shape::{
    Curve, Patch, PowerCurve, PowerPatch, RationalCurve, RationalPatch, RationalTriangle, Triangle,
};

/// The plane curve with six points.
fn plane() -> Curve {
    let points = [[0., 0.], [1., 1.], [2., 0.5], [3., 0.5], [0.5, 1.5], [1.5, 0.]];
    Curve::new(points.map(|[x, y]| dvec3(x, y, 0.))).unwrap()
}

/// The 3 × 4 surface.
fn hill() -> Patch {
    let net = [
        [-3., 0., 2.],
        [-2., 0., 6.],
        [-1., 0., 7.],
        [0., 0., 2.],
        [-3., 1., 2.],
        [-2., 1., 4.],
        [-1., 1., 5.],
        [0., 1., 2.5],
        [-3., 3., 0.],
        [-2., 3., 2.5],
        [-1., 3., 4.5],
        [0., 3., 6.5],
    ];
    Patch::new([2, 3], net.map(DVec3::from_array)).unwrap()
}

fn triangle() -> Triangle {
    let net = [
        [3., 0., 0.],
        [2., 1., 1.],
        [2., 0., 1.5],
        [1., 2., 1.],
        [1., 1., 2.],
        [1., 0., 0.5],
        [0., 3., 0.],
        [0., 2., 1.],
        [0., 1., 1.],
        [0., 0., 0.],
    ];
    Triangle::new(3, net.map(DVec3::from_array)).unwrap()
}

/// Every number in path data and circles is on the page.
fn check(svg: &str) {
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
    let attribute = |name: &str| {
        let start = format!(" {name}=\"");
        let at = svg.find(&start).unwrap() + start.len();
        svg[at..].split('"').next().unwrap().parse::<f64>().unwrap()
    };
    let [width, height] = ["width", "height"].map(attribute);
    let mut count = 0;
    for data in svg.split('"').filter(|part| part.starts_with('M')) {
        for pair in data.split(['M', 'L', 'Z']).filter(|pair| !pair.is_empty()) {
            let (x, y) = pair.split_once(' ').unwrap();
            let (x, y): (f64, f64) = (x.parse().unwrap(), y.parse().unwrap());
            assert!((0.0..=width).contains(&x) && (0.0..=height).contains(&y), "({x}, {y})");
            count += 1;
        }
    }
    assert!(count > 50, "{count}");
}

fn save(name: &str, svg: &str) {
    if let Ok(folder) = std::env::var("CASTELJAU_PICTURES") {
        std::fs::write(format!("{folder}/{name}.svg"), svg).unwrap();
    }
}

#[test]
fn curves_with_all_that_can_be_drawn() {
    let helix = Curve::new([
        DVec3::ZERO,
        dvec3(2., 0., 0.5),
        dvec3(2., 2., 1.),
        dvec3(0., 2., 2.),
        dvec3(-1., 0., 2.5),
    ]);
    let helix = helix.unwrap().with_interval(Interval::new(2.0, 5.0).unwrap());
    let circle = RationalCurve::circle(DVec3::ZERO, DVec3::X, DVec3::Y).unwrap();
    let power = PowerCurve::new([DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z]).unwrap();
    let power = power.with_interval(Interval::new(-1.0, 1.0).unwrap());
    let sets: [(&str, Vec<CurveShape>, f64); 4] = [
        ("plane", vec![CurveShape::from(&plane())], 0.4),
        ("helix", vec![CurveShape::from(&helix)], 3.5),
        ("circle", circle.iter().map(CurveShape::from).collect(), 0.3),
        ("power", vec![CurveShape::try_from(&power).unwrap()], 0.2),
    ];
    for (name, curves, t) in sets {
        let styles = [
            ("polygon", CurveStyle::default()),
            ("comb", CurveStyle { comb: true, polygon: false, ..CurveStyle::default() }),
            ("frames", CurveStyle { frames: 9, ..CurveStyle::default() }),
            ("construction", CurveStyle { construction: Some(t), ..CurveStyle::default() }),
        ];
        for (what, style) in styles {
            let svg = curve_picture(&curves, &style).unwrap();
            check(&svg);
            assert_eq!(svg, curve_picture(&curves, &style).unwrap());
            save(&format!("curve-{name}-{what}"), &svg);
        }
    }
}

#[test]
fn solids_by_their_faces() {
    use casteljau_solid::{Hexahedron, RationalHexahedron, Tetrahedron, Wedge};
    let meridian = [DVec3::NEG_Z, dvec3(2., 0., -1.), dvec3(2., 0., 1.), DVec3::Z];
    let meridian = RationalCurve::new(&meridian, &[3., 1., 1., 3.]).unwrap();
    let ball = RationalHexahedron::rotational(&meridian).unwrap();
    let corners = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ZERO];
    let prism = [DVec3::X, dvec3(1., 0., 1.), DVec3::Y, dvec3(0., 1., 1.), DVec3::ZERO, DVec3::Z];
    // Folded over itself: every face is drawn.
    let mut folded = Hexahedron::unit_cube().control_points().to_vec();
    folded[7] = dvec3(-1., -1., -0.5);
    let sets: [(&str, SolidShape, usize); 5] = [
        ("ball", SolidShape::from(&ball), 36),
        ("cube", SolidShape::from(&Hexahedron::unit_cube()), 8),
        ("tetrahedron", SolidShape::from(&Tetrahedron::new(1, corners).unwrap().elevated(2).unwrap()), 20),
        ("wedge", SolidShape::from(&Wedge::new([1, 1], prism).unwrap().elevated([1, 0]).unwrap()), 12),
        ("folded", SolidShape::from(&Hexahedron::new([1; 3], folded).unwrap()), 8),
    ];
    for (name, solid, dots) in sets {
        for shading in [Shading::Light, Shading::Mean, Shading::None] {
            let style = SurfaceStyle { shading, levels: 3, ..SurfaceStyle::default() };
            let svg = solid_picture(std::slice::from_ref(&solid), &style).unwrap();
            check(&svg);
            assert_eq!(svg.matches("<circle").count(), dots, "{name}");
            assert_eq!(svg, solid_picture(std::slice::from_ref(&solid), &style).unwrap());
            save(&format!("solid-{name}-{shading:?}"), &svg);
        }
    }
}

#[test]
fn every_level_of_the_construction_is_drawn() {
    // Degree 5: six control points, then 5 + 4 + 3 + 2 + 1 points of the scheme, and the point once more, larger.
    let style = CurveStyle { construction: Some(0.4), ..CurveStyle::default() };
    let dots = |svg: &str| svg.matches("<circle").count();
    assert_eq!(dots(&curve_picture(&[CurveShape::from(&plane())], &style).unwrap()), 6 + 15 + 1);
    // 3 × 4: the net, three schemes of four points with their polygons, and one of three with its polygon.
    let style = SurfaceStyle { construction: Some([0.3, 0.6]), ..SurfaceStyle::default() };
    let svg = surface_picture(&[SurfaceShape::from(&hill())], &style).unwrap();
    assert_eq!(dots(&svg), 12 + 3 * (4 + 3 + 2 + 1) + (3 + 2 + 1) + 1);
}

#[test]
fn surfaces_with_all_that_can_be_drawn() {
    let ring = [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y, DVec3::X];
    let make = |a, b, c| RationalTriangle::sphere_octant(DVec3::ZERO, a, b, c).unwrap();
    let octants: Vec<_> =
        ring.windows(2).flat_map(|q| [make(q[0], q[1], DVec3::Z), make(q[1], q[0], DVec3::NEG_Z)]).collect();
    let power =
        PowerPatch::new([1, 2], [DVec3::ZERO, DVec3::Y, DVec3::Z, DVec3::X, DVec3::ZERO, DVec3::Z]).unwrap();
    let torus = RationalPatch::torus(DVec3::ZERO, DVec3::Z, 2.0, 0.7).unwrap();
    let sphere = RationalPatch::sphere(DVec3::ZERO, 1.0).unwrap();
    let sets: [(&str, Vec<SurfaceShape>); 6] = [
        ("hill", vec![SurfaceShape::from(&hill())]),
        ("triangle", vec![SurfaceShape::from(&triangle())]),
        ("octants", octants.iter().map(SurfaceShape::from).collect()),
        ("torus", torus.iter().map(SurfaceShape::from).collect()),
        ("sphere", sphere.iter().map(SurfaceShape::from).collect()),
        ("power", vec![SurfaceShape::try_from(&power).unwrap()]),
    ];
    for (name, shapes) in sets {
        let plain = SurfaceStyle { triangles: 3000, ..SurfaceStyle::default() };
        let styles = [
            ("light", plain.clone()),
            ("lines", SurfaceStyle { shading: Shading::None, ..plain.clone() }),
            ("gaussian", SurfaceStyle { shading: Shading::Gaussian, net: false, ..plain.clone() }),
            ("mean", SurfaceStyle { shading: Shading::Mean, net: false, ..plain.clone() }),
            ("construction", SurfaceStyle { construction: Some([0.3, 0.45]), levels: 0, ..plain.clone() }),
            ("top", SurfaceStyle { view: View::named("top").unwrap(), ..plain }),
        ];
        for (what, style) in styles {
            let svg = surface_picture(&shapes, &style).unwrap();
            check(&svg);
            save(&format!("surface-{name}-{what}"), &svg);
        }
    }
}

#[test]
fn nonsense_is_refused() {
    let curve = [CurveShape::from(&plane())];
    assert_eq!(curve_picture(&[], &CurveStyle::default()), Err(PlotError::Nothing));
    assert_eq!(surface_picture(&[], &SurfaceStyle::default()), Err(PlotError::Nothing));
    let style = CurveStyle { frames: 101, ..CurveStyle::default() };
    assert!(matches!(curve_picture(&curve, &style), Err(PlotError::Option { .. })));
    let style = CurveStyle { construction: Some(f64::NAN), ..CurveStyle::default() };
    assert_eq!(curve_picture(&curve, &style), Err(PlotError::NotFinite));
    let surface = [SurfaceShape::from(&hill())];
    let style = SurfaceStyle { width: 3, ..SurfaceStyle::default() };
    assert!(matches!(surface_picture(&surface, &style), Err(PlotError::Option { .. })));
    let net = [DVec3::ZERO, DVec3::Y, DVec3::X, DVec3::ONE];
    let pole = RationalPatch::new([1, 1], &net, &[1.0, 1.0, -1.0, -1.0]).unwrap();
    let refused = surface_picture(
        &[SurfaceShape::from(&pole)],
        &SurfaceStyle { triangles: 200, ..SurfaceStyle::default() },
    );
    assert!(matches!(refused, Err(PlotError::Shape(_))));
}

#[test]
fn a_point_and_a_curve_without_curvature_have_pictures() {
    let styles = [true, false].map(|comb| CurveStyle {
        comb,
        frames: 5,
        construction: Some(0.5),
        ..CurveStyle::default()
    });
    for curve in [Curve::new([DVec3::ONE]), Curve::new([DVec3::ZERO, DVec3::X, DVec3::X * 2.0])] {
        for style in &styles {
            let svg = curve_picture(&[CurveShape::from(&curve.clone().unwrap())], style).unwrap();
            assert!(!svg.contains("NaN"));
        }
    }
}
