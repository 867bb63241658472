use casteljau_domain::DomainError;
use casteljau_gb::GbError;
use casteljau_shape::ShapeError;
use casteljau_solid::SolidError;

/// Why a picture cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlotError {
    /// Nothing was given to draw.
    ///
    /// ```
    /// use casteljau_plot::{PatchStyle, PlotError, patch_picture};
    /// assert_eq!(patch_picture(&[], &PatchStyle::default()), Err(PlotError::Nothing));
    /// ```
    #[error("there is nothing to draw")]
    Nothing,
    /// A number of the style is out of range.
    ///
    /// ```
    /// use casteljau_plot::{PatchStyle, PlotError, patch_picture};
    /// let style = PatchStyle { width: 7, ..PatchStyle::default() };
    /// let error = patch_picture(&[], &style).unwrap_err();
    /// assert_eq!(error.to_string(), "the width in pixels must be 100 to 10000, not 7");
    /// ```
    #[error("the {option} must be {least} to {most}, not {value}")]
    Option {
        /// Which number.
        option: &'static str,
        /// Value given.
        value: f64,
        /// Least value.
        least: f64,
        /// Largest value.
        most: f64,
    },
    /// There is no such coordinate or side.
    ///
    /// ```
    /// use casteljau_domain::{Coordinates, Polygon, glam::dvec2};
    /// use casteljau_plot::{DomainStyle, PlotError, domain_picture};
    /// let triangle = Polygon::new(vec![dvec2(0., 0.), dvec2(1., 0.), dvec2(0., 1.)])?;
    /// let style = DomainStyle { coordinate: Some(3), ..DomainStyle::default() };
    /// let error = domain_picture(&Coordinates::mean_value(triangle)?, &style).unwrap_err();
    /// assert_eq!(error, PlotError::NoSuch { what: "coordinate", index: 3, count: 3 });
    /// # Ok::<(), casteljau_domain::DomainError>(())
    /// ```
    #[error("there is no {what} {index}: the shape has {count}, counted from 0")]
    NoSuch {
        /// `"coordinate"` or `"side"`.
        what: &'static str,
        /// Number given.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// De Casteljau's construction is drawn for curves and surfaces only.
    ///
    /// ```
    /// use casteljau_plot::{PlotError, SolidShape, SurfaceStyle, solid_picture};
    /// use casteljau_solid::Hexahedron;
    /// let style = SurfaceStyle { construction: Some([0.5, 0.5]), ..SurfaceStyle::default() };
    /// let refused = solid_picture(&[SolidShape::from(&Hexahedron::unit_cube())], &style);
    /// assert_eq!(refused, Err(PlotError::NoConstruction));
    /// ```
    #[error("de Casteljau's construction is not drawn for solids")]
    NoConstruction,
    /// A coordinate in the picture left the range of numbers.
    #[error("a point of the picture is not finite")]
    NotFinite,
    /// The shape could not be evaluated.
    #[error("{0}")]
    Gb(#[from] GbError),
    /// A curve, patch or triangle could not be evaluated: it has a pole.
    ///
    /// ```
    /// use casteljau_plot::{CurveShape, CurveStyle, PlotError, curve_picture};
    /// use casteljau_shape::{RationalCurve, geom::glam::DVec3};
    /// let curve = RationalCurve::new(&[DVec3::ZERO, DVec3::X], &[1.0, -1.0])?; // pole at t = ½
    /// let refused = curve_picture(&[CurveShape::from(&curve)], &CurveStyle::default());
    /// assert!(matches!(refused, Err(PlotError::Shape(_))));
    /// # Ok::<(), casteljau_shape::ShapeError>(())
    /// ```
    #[error("{0}")]
    Shape(#[from] ShapeError),
    /// A solid could not be evaluated, or has a face without weight.
    ///
    /// ```
    /// use casteljau_plot::{PlotError, SolidShape, SurfaceStyle, solid_picture};
    /// use casteljau_solid::{RationalTetrahedron, geom::glam::DVec3};
    /// let corners = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ZERO];
    /// let solid = RationalTetrahedron::new(1, &corners, &[0.0, 0.0, 0.0, 1.0])?;
    /// let refused = solid_picture(&[SolidShape::from(&solid)], &SurfaceStyle::default());
    /// assert!(matches!(refused, Err(PlotError::Solid(_))));
    /// # Ok::<(), casteljau_solid::SolidError>(())
    /// ```
    #[error("{0}")]
    Solid(#[from] SolidError),
    /// The domain could not be triangulated or its coordinates evaluated.
    #[error("domain: {0}")]
    Domain(#[from] DomainError),
}
