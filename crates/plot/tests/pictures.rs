//! Pictures of a patch with one concave corner: well-formed, finite, the same every time, and right where it can be told.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use casteljau_gb::glam::{DVec2, DVec3};
use casteljau_gb::{ConcavePatch, Ribbon};
use casteljau_plot::{
    DomainStyle, Isolines, PatchStyle, PlotError, Shading, View, domain_picture, patch_picture,
};

/// An L of cubic sides on the surface z = x²/4 − y²/5, `scale` times as large.
fn l(scale: f64) -> ConcavePatch {
    let corners = [(2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.), (0., 0.)].map(|(x, y)| DVec2::new(x, y));
    let lift = |p: DVec2| DVec3::new(p.x, p.y, p.x * p.x / 4.0 - p.y * p.y / 5.0) * scale;
    let ribbon = |i: usize| {
        let (a, b) = (corners[(i + 5) % 6], corners[i]);
        let inward = (b - a).perp().normalize();
        let row = |k: f64| (0..4).map(move |j| lift(a.lerp(b, j as f64 / 3.0) + inward * (k / 3.0)));
        Ribbon::new(3, 2, row(0.0).chain(row(1.0)).collect()).unwrap()
    };
    ConcavePatch::builder((0..6).map(ribbon).collect()).build().unwrap()
}

/// All numbers in path data and coordinates.
fn numbers(svg: &str) -> Vec<f64> {
    let data = svg.split('"').filter(|part| part.starts_with('M'));
    let words = data.flat_map(|part| part.split(['M', 'L', 'Z', ' ']));
    words.filter(|word| !word.is_empty()).map(|word| word.parse().unwrap()).collect()
}

fn all_styles() -> Vec<PatchStyle> {
    let shadings = [Shading::None, Shading::Light, Shading::Gaussian, Shading::Mean];
    let isolines = [Isolines::None, Isolines::Grid, Isolines::Side(2), Isolines::Distances];
    let views = ["iso", "top", "front"].map(|name| View::named(name).unwrap());
    let styles = shadings.into_iter().flat_map(|shading| {
        isolines.into_iter().map(move |isolines| PatchStyle {
            shading,
            isolines,
            triangles: 300,
            ..Default::default()
        })
    });
    styles.zip(views.into_iter().cycle()).map(|(style, view)| PatchStyle { view, ..style }).collect()
}

#[test]
fn every_style_is_finite_and_within_the_page() {
    let patch = [l(1.0)];
    for style in all_styles() {
        let svg = patch_picture(&patch, &style).unwrap();
        assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"), "{style:?}");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{style:?}");
        let numbers = numbers(&svg);
        assert!(numbers.len() > 100, "{style:?}: {} numbers", numbers.len());
        assert!(numbers.iter().all(|x| (-1.0..=961.0).contains(x)), "{style:?}");
    }
}

#[test]
fn a_picture_does_not_know_its_units() {
    let style = PatchStyle { triangles: 300, ..PatchStyle::default() };
    let counts = [1e-6, 1.0, 1e6].map(|scale| numbers(&patch_picture(&[l(scale)], &style).unwrap()));
    assert_eq!(counts[0].len(), counts[1].len());
    assert_eq!(counts[2].len(), counts[1].len());
}

#[test]
fn the_same_bytes_every_time() {
    let patch = l(1.0);
    let style = PatchStyle { triangles: 300, ..PatchStyle::default() };
    assert_eq!(patch_picture(std::slice::from_ref(&patch), &style), patch_picture(&[l(1.0)], &style));
    let style = DomainStyle { triangles: 300, ..DomainStyle::default() };
    assert_eq!(domain_picture(patch.coordinates(), &style), domain_picture(l(1.0).coordinates(), &style));
}

#[test]
fn side_curves_are_drawn_where_they_are() {
    // From above, without net, shading or isolines: the outline of the L is all there is.
    let style = PatchStyle {
        view: View::named("top").unwrap(),
        shading: Shading::None,
        isolines: Isolines::None,
        net: false,
        triangles: 100,
        ..PatchStyle::default()
    };
    let svg = patch_picture(&[l(1.0)], &style).unwrap();
    let points: Vec<[f64; 2]> = numbers(&svg).chunks(2).map(|c| [c[0], c[1]]).collect();
    // 740 pixels for 2 units, the margins being 30 at the sides and 66 above.
    let on_outline = |[x, y]: [f64; 2]| {
        let (u, v) = ((x - 30.0) / 370.0, 2.0 - (y - 66.0) / 370.0);
        let near = |a: f64, b: f64| (a - b).abs() < 1e-3;
        let within = |a: f64, low: f64, high: f64| a > low - 1e-3 && a < high + 1e-3;
        near(u, 0.0)
            || near(v, 0.0)
            || (near(u, 2.0) && within(v, 0.0, 1.0))
            || (near(v, 2.0) && within(u, 0.0, 1.0))
            || (near(u, 1.0) && within(v, 1.0, 2.0))
            || (near(v, 1.0) && within(u, 1.0, 2.0))
    };
    assert!(points.len() > 6 * 48 && points.iter().all(|&p| on_outline(p)));
}

#[test]
fn the_domain_marks_its_concave_corner() {
    let patch = l(1.0);
    let style = DomainStyle { coordinate: Some(2), triangles: 400, ..DomainStyle::default() };
    let svg = domain_picture(patch.coordinates(), &style).unwrap();
    for corner in 0..6 {
        assert!(
            svg.contains(&format!(">{corner}</text>")) || svg.contains(&format!("\n{corner}\n")),
            "{corner}"
        );
    }
    assert!(svg.contains("concave corner") && svg.contains("λ of corner 2"));
    assert!(numbers(&svg).iter().all(|x| (0.0..=1100.0).contains(x)));
    // Nineteen levels, each with its own colour.
    let colors: std::collections::BTreeSet<_> =
        svg.match_indices("stroke=\"#").map(|(at, _)| &svg[at..at + 16]).collect();
    assert!(colors.len() > 19, "{colors:?}");
}

#[test]
fn what_cannot_be_drawn_says_why() {
    let patch = l(1.0);
    let wrong = |style: PatchStyle| patch_picture(std::slice::from_ref(&patch), &style).unwrap_err();
    assert!(matches!(
        wrong(PatchStyle { isolines: Isolines::Side(6), ..Default::default() }),
        PlotError::NoSuch { index: 6, count: 6, .. }
    ));
    assert!(matches!(wrong(PatchStyle { levels: 100_000, ..Default::default() }), PlotError::Option { .. }));
    assert!(matches!(wrong(PatchStyle { triangles: 0, ..Default::default() }), PlotError::Option { .. }));
    assert!(matches!(wrong(PatchStyle { width: 0, ..Default::default() }), PlotError::Option { .. }));
    let style = DomainStyle { coordinate: Some(9), ..Default::default() };
    assert!(matches!(domain_picture(patch.coordinates(), &style), Err(PlotError::NoSuch { index: 9, .. })));
    assert_eq!(patch_picture(&[], &PatchStyle::default()), Err(PlotError::Nothing));
}
