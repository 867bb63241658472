//! The model file's words for what a patch is made of.

use casteljau::gb::{CenterWeight, ConcavePatch, CoordinateKind, LayoutKind};

pub fn layout(patch: &ConcavePatch) -> &'static str {
    match patch.layout() {
        LayoutKind::Projection => "projection",
        LayoutKind::Heuristic => "heuristic",
        LayoutKind::Regular => "regular",
        _ => "given",
    }
}

pub fn coordinates(patch: &ConcavePatch) -> &'static str {
    match patch.coordinates().kind() {
        CoordinateKind::Wachspress => "wachspress",
        CoordinateKind::MeanValue => "mean_value",
        _ => "harmonic",
    }
}

pub fn center_weight(patch: &ConcavePatch) -> &'static str {
    match patch.center_weight() {
        CenterWeight::Deficiency => "deficiency",
        CenterWeight::Nth => "nth",
        CenterWeight::Harmonic => "harmonic",
        _ => "none",
    }
}
