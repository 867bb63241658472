//! The painter's algorithm: everything is cut small, sorted by depth, and drawn from the back.

use casteljau_geom::glam::DVec3;
use svg::node::element::Group;

use crate::View;
use crate::canvas::{Frame, disc, lines, number, path, polyline};

/// Something small enough to be in front of or behind everything else.
enum Item {
    Triangle { corners: [DVec3; 3], fill: String },
    Stroke { ends: [DVec3; 2], pen: usize },
    Dot { at: DVec3, radius: f64, pen: usize },
}

/// How lines are drawn.
#[derive(Clone, PartialEq)]
pub(crate) struct Pen {
    pub(crate) color: &'static str,
    pub(crate) width: f64,
    /// How far, in model units, its lines are moved toward the eye for sorting, so that they lie on the surface.
    pub(crate) lift: f64,
}

/// What is to be drawn, in no order.
pub(crate) struct Scene {
    view: View,
    items: Vec<(f64, Item)>,
    pens: Vec<Pen>,
    /// Longest piece of a line, in model units.
    piece: f64,
}

impl Scene {
    pub(crate) fn new(view: View, piece: f64) -> Self {
        Self { view, items: Vec::new(), pens: Vec::new(), piece }
    }

    pub(crate) fn pen(&mut self, pen: Pen) -> usize {
        self.pens.push(pen);
        self.pens.len() - 1
    }

    pub(crate) fn triangle(&mut self, corners: [DVec3; 3], fill: String) {
        let depth = corners.iter().map(|&p| self.view.depth(p)).sum::<f64>() / 3.0;
        self.items.push((depth, Item::Triangle { corners, fill }));
    }

    /// A line, cut into pieces short enough to be sorted.
    pub(crate) fn line(&mut self, points: &[DVec3], pen: usize) {
        let lift = self.pens[pen].lift;
        for ends in points.windows(2) {
            let length = ends[0].distance(ends[1]);
            let pieces = (length / self.piece).ceil().clamp(1.0, 1000.0) as usize;
            for i in 0..pieces {
                let at = |i: usize| ends[0].lerp(ends[1], i as f64 / pieces as f64);
                let ends = [at(i), at(i + 1)];
                let depth = self.view.depth(ends[0].midpoint(ends[1])) + lift;
                self.items.push((depth, Item::Stroke { ends, pen }));
            }
        }
    }

    pub(crate) fn dot(&mut self, at: DVec3, radius: f64, pen: usize) {
        let depth = self.view.depth(at) + 1.01 * self.pens[pen].lift;
        self.items.push((depth, Item::Dot { at, radius, pen }));
    }

    /// Draws from the back; strokes of one pen that follow each other become one element.
    pub(crate) fn paint(mut self, frame: &Frame) -> Group {
        self.items.sort_by(|a, b| a.0.total_cmp(&b.0));
        let pixels = |p: DVec3| frame.pixels(self.view.project(p));
        // The thin outline in its own colour closes the seams that antialiasing leaves between triangles.
        let mut group = lines("currentColor", 0.6);
        let mut strokes: Option<(usize, String)> = None;
        for (_, item) in &self.items {
            if let Some((pen, data)) =
                strokes.take_if(|(pen, _)| !matches!(item, Item::Stroke { pen: p, .. } if p == pen))
            {
                group = group.add(self.stroke(pen, data));
            }
            match item {
                Item::Triangle { corners, fill } => {
                    let data = polyline(corners.map(pixels), true);
                    group = group.add(path(data).set("color", fill.as_str()).set("fill", "currentColor"));
                }
                Item::Stroke { ends, pen } => {
                    let (_, data) = strokes.get_or_insert_with(|| (*pen, String::new()));
                    data.push_str(&polyline(ends.map(pixels), false));
                }
                Item::Dot { at, radius, pen } => {
                    let color = self.pens[*pen].color;
                    group = group.add(disc(pixels(*at), *radius).set("fill", color).set("stroke", "none"));
                }
            }
        }
        match strokes {
            Some((pen, data)) => group.add(self.stroke(pen, data)),
            None => group,
        }
    }

    fn stroke(&self, pen: usize, data: String) -> svg::node::element::Path {
        let pen = &self.pens[pen];
        path(data).set("stroke", pen.color).set("stroke-width", number(pen.width))
    }
}
