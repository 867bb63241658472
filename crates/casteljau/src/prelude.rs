//! The names that most programs need: `use casteljau::prelude::*;`.

pub use casteljau_domain::{CoordinateKind, Coordinates, Location, Polygon};
pub use casteljau_gb::{
    BlendMatrix, CenterWeight, ConcavePatch, ContinuityReport, LayoutKind, Ribbon, SampleSet,
};
pub use casteljau_geom::glam::{DVec2, DVec3, DVec4};
pub use casteljau_geom::{BoundingBox, CurveJet, Interval, SolidJet, SurfaceJet};
pub use casteljau_io::Geometry;
pub use casteljau_io::model::{Model, NamedShape, Shape};
pub use casteljau_io::{read_model_file, write_mesh_file, write_model_file};
pub use casteljau_mesh::{MeshSink, TriangleMesh};
pub use casteljau_shape::{
    Curve, ParametricCurve, ParametricSurface, Patch, PowerCurve, PowerPatch, RationalCurve, RationalPatch,
    RationalTriangle, Triangle,
};
pub use casteljau_solid::{
    ConstructedSolid, Construction, Hexahedron, ParametricSolid, RationalHexahedron, RationalTetrahedron,
    RationalWedge, Tetrahedron, Twist, Wedge,
};

pub use crate::Error;
