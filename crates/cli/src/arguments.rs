//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

/// A geometry kernel for Bézier shapes.
#[derive(Parser)]
#[command(name = "casteljau", version, arg_required_else_help = true)]
#[command(
    after_help = "Exit status: 0 done, 1 the input or the result is bad, 2 usage. `-` is standard input or output."
)]
pub struct Arguments {
    /// Answer with one JSON object a line.
    #[arg(long, global = true)]
    pub json: bool,
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Subcommand)]
pub enum Command {
    /// Say what is in a model: kinds, degrees, bounds, sides, layers, area, volume.
    Info(Selection),
    /// Evaluate points, derivatives, normals, curvatures and Jacobians.
    Eval(Eval),
    /// Show the domain polygon of GB patches and their barycentric coordinates.
    Domain(Domain),
    /// Tessellate into a mesh file.
    Mesh(Mesh),
    /// Measure the continuity along sides and between shapes; exit status 1 where a promise is broken.
    Check(Check),
    /// Convert between model formats: .json, .cgb, and Bézier cells of VTK (.vtu).
    Convert(Convert),
    /// Draw a picture.
    Plot(Plot),
}

/// A model, or one of its shapes.
#[derive(Args)]
pub struct Selection {
    /// Model file (.json, .cgb or .vtu), `-` for standard input.
    pub model: PathBuf,
    /// The shape, counted from 0; all of them by default.
    #[arg(long, value_name = "N")]
    pub shape: Option<usize>,
    /// Bound on the error of harmonic coordinates [default: 1e-8].
    #[arg(long, value_name = "BOUND")]
    pub accuracy: Option<f64>,
}

#[derive(Args)]
pub struct Places {
    /// A parameter: t of curves; u,v of patches, λ1,λ2 of triangles; u,v,w of hexahedra, λ1,λ2,λ3 of tetrahedra, λ1,λ2,w of
    /// wedges; may be repeated, and negative.
    #[arg(long, value_name = "U[,V[,W]]", allow_hyphen_values = true, conflicts_with = "params")]
    pub at: Vec<String>,
    /// A file of parameters, one a line, numbers apart by commas; `-` for standard input.
    #[arg(long, value_name = "FILE")]
    pub params: Option<PathBuf>,
}

#[derive(Args)]
pub struct Eval {
    #[command(flatten)]
    pub selection: Selection,
    #[command(flatten)]
    pub places: Places,
    /// Partial derivatives up to this order, 0 to 50; for GB patches 0 to 2.
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u8).range(0..=50))]
    pub order: Option<u8>,
}

#[derive(Args)]
pub struct Domain {
    #[command(flatten)]
    pub selection: Selection,
    #[command(flatten)]
    pub places: Places,
}

#[derive(Args)]
pub struct Mesh {
    #[command(flatten)]
    pub selection: Selection,
    /// Mesh file, by its ending: obj, off, ply, stl; `-` for standard output.
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// Largest distance between surface and mesh, in model units [default: 1/2000 of the model's size].
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true, conflicts_with = "resolution")]
    pub tolerance: Option<f64>,
    /// Samples a side, in place of a tolerance.
    #[arg(long, value_name = "COUNT")]
    pub resolution: Option<usize>,
    /// In place of the surface of solids, their slice by the plane Ax + By + Cz = D.
    #[arg(
        long,
        value_name = "A,B,C,D",
        value_delimiter = ',',
        allow_hyphen_values = true,
        conflicts_with = "resolution"
    )]
    pub slice: Option<Vec<f64>>,
    /// In place of the surface of solids, cells that fill them, as .vtu: hexahedra, tetrahedra, wedges.
    #[arg(long, conflicts_with = "slice")]
    pub volume: bool,
    /// With --volume: tetrahedra only.
    #[arg(long, requires = "volume")]
    pub tetrahedra: bool,
    /// Write the surface's normals.
    #[arg(long)]
    pub normals: bool,
    /// Keep the vertices of neighbouring shapes apart, so that creases stay sharp.
    #[arg(long)]
    pub separate: bool,
    /// Most vertices.
    #[arg(long, value_name = "COUNT")]
    pub max_vertices: Option<usize>,
    /// Format for standard output.
    #[arg(long, value_enum, default_value = "obj")]
    pub format: MeshFormatName,
}

#[derive(Clone, Copy, ValueEnum)]
pub enum MeshFormatName {
    Obj,
    Off,
    Ply,
    Stl,
}

#[derive(Args)]
pub struct Check {
    #[command(flatten)]
    pub selection: Selection,
    /// Places a side that are measured.
    #[arg(long, value_name = "COUNT", default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub samples: u32,
    /// G0: largest gap, in model units [default: 4·max(degree, 2·layers − 1)·certificate·size].
    #[arg(long, value_name = "LENGTH")]
    pub position: Option<f64>,
    /// G1: largest angle between tangent planes, in degrees.
    #[arg(long, value_name = "DEGREES", default_value_t = 1e-6)]
    pub angle: f64,
    /// G2: largest relative difference of normal curvatures.
    #[arg(long, value_name = "RATIO", default_value_t = 1e-4)]
    pub curvature: f64,
}

#[derive(Args)]
pub struct Convert {
    #[command(flatten)]
    pub selection: Selection,
    /// Model file, by its ending: json, cgb, vtu; `-` for standard output.
    #[arg(value_name = "OUT")]
    pub output: PathBuf,
    /// Curves and patches in this basis: `bezier` makes power_curve and power_patch curve and patch, `power` the other way.
    #[arg(long, value_enum, value_name = "BASIS")]
    pub to: Option<BasisName>,
    /// Raise the degrees of Bézier shapes by this much, which changes no point.
    #[arg(long, value_name = "BY")]
    pub elevate: Option<usize>,
    /// Format for standard output.
    #[arg(long, value_enum, default_value = "json")]
    pub format: ModelFormatName,
}

#[derive(Clone, Copy, ValueEnum)]
pub enum BasisName {
    Bezier,
    Power,
}

#[derive(Clone, Copy, ValueEnum)]
pub enum ModelFormatName {
    Json,
    Cgb,
    Vtu,
}

#[derive(Args)]
pub struct Plot {
    #[command(flatten)]
    pub selection: Selection,
    /// Picture file, .svg; `-` for standard output.
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// Draw the domain polygon in place of the shape.
    #[arg(long)]
    pub domain: bool,
    /// With --domain: the corner whose coordinate has its isolines drawn [default: the first concave one].
    #[arg(long, value_name = "I", requires = "domain")]
    pub coordinate: Option<usize>,
    /// With --domain: leave the triangulation out.
    #[arg(long, requires = "domain")]
    pub no_triangulation: bool,
    /// Named view.
    #[arg(long, value_enum, conflicts_with_all = ["azimuth", "elevation", "domain"])]
    pub view: Option<ViewName>,
    /// Angle of the eye about the z axis, from +x, in degrees [default: -60].
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, conflicts_with = "domain")]
    pub azimuth: Option<f64>,
    /// Angle of the eye above the xy plane, in degrees [default: 35].
    #[arg(long, value_name = "DEGREES", allow_negative_numbers = true, conflicts_with = "domain")]
    pub elevation: Option<f64>,
    /// How the surface is drawn.
    #[arg(long, value_enum, default_value = "light", conflicts_with = "domain")]
    pub shading: ShadingName,
    /// Lines on the surface: `none`, `grid` (constant u and v), `distances` (constant h of every side), or a side's number
    /// (constant s and h of that side).
    #[arg(long, default_value = "grid", conflicts_with = "domain")]
    pub isolines: IsolinesName,
    /// Leave the control nets out.
    #[arg(long, conflicts_with = "domain")]
    pub no_net: bool,
    /// De Casteljau's construction at a parameter: T of curves, U,V of patches, λ1,λ2 of triangles.
    #[arg(long, value_name = "T[,..]", allow_hyphen_values = true, conflicts_with = "domain")]
    pub construction: Option<String>,
    /// Curvature combs of curves.
    #[arg(long, conflicts_with = "domain")]
    pub comb: bool,
    /// Frenet frames along each curve.
    #[arg(long, value_name = "COUNT", default_value_t = 0, conflicts_with = "domain")]
    pub frames: usize,
    /// Isolines of a family.
    #[arg(long, value_name = "COUNT")]
    pub levels: Option<usize>,
    /// Triangles that the surface or the domain is cut into.
    #[arg(long, value_name = "COUNT")]
    pub triangles: Option<usize>,
    /// Width of the picture, in pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 800)]
    pub width: u32,
}

#[derive(Clone, Copy, ValueEnum)]
pub enum ViewName {
    Iso,
    Top,
    Bottom,
    Front,
    Back,
    Left,
    Right,
}

#[derive(Clone, Copy, ValueEnum)]
pub enum ShadingName {
    None,
    Light,
    Gaussian,
    Mean,
}

#[derive(Clone, Copy)]
pub enum IsolinesName {
    None,
    Grid,
    Distances,
    Side(usize),
}

impl std::str::FromStr for IsolinesName {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        match word {
            "none" => Ok(Self::None),
            "grid" => Ok(Self::Grid),
            "distances" => Ok(Self::Distances),
            side => side
                .parse()
                .map(Self::Side)
                .map_err(|_| "expected none, grid, distances or a side's number".into()),
        }
    }
}
