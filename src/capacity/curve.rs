//! One record's response curve.

use thiserror::Error;

/// Why a response curve or a level was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CapacityError {
    /// A curve starts somewhere.
    #[error("response curve without a vertex: expected the vertex at EDP 0")]
    Empty,
    /// The first vertex is the onset of rocking.
    #[error("first vertex has EDP {0}: expected the onset of rocking, EDP 0")]
    FirstEdp(f64),
    /// Intensities are positive, finite and strictly increasing.
    #[error(
        "vertex {number} has intensity {im} after {previous}: expected finite, strictly increasing, positive intensities"
    )]
    Intensity {
        /// Place in the curve, from 1.
        number: usize,
        /// The intensity found.
        im: f64,
        /// The one before it, 0 for the first.
        previous: f64,
    },
    /// Overturned is not a value of the EDP.
    #[error(
        "vertex {number} has EDP {edp}: expected a finite number, not negative; overturning is given apart"
    )]
    Edp {
        /// Place in the curve, from 1.
        number: usize,
        /// The EDP found.
        edp: f64,
    },
    /// Overturning ends the curve.
    #[error(
        "overturning at intensity {overturning}: expected a finite intensity above that of the last vertex, {last}"
    )]
    Overturning {
        /// The intensity found.
        overturning: f64,
        /// The last vertex's intensity.
        last: f64,
    },
    /// A curve ends somewhere.
    #[error(
        "curve {number} says nothing at intensity {im}: beyond its last vertex, before overturning"
    )]
    Beyond {
        /// Place of the curve, from 1.
        number: usize,
        /// The requested intensity.
        im: f64,
    },
    /// Levels are positive.
    #[error("EDP level {0}: expected a positive number, or inf")]
    Level(f64),
    /// Scale factors are positive.
    #[error("scale factor {0}: expected a positive finite number")]
    Factor(f64),
}

/// EDP against IM of one record: linear between vertices, which begin at the
/// onset of rocking (EDP 0), up to the intensity of first overturning.
///
/// Overturning is no value of the EDP, so the curve does not interpolate
/// towards it. A record that never overturned is censored at its last
/// intensity.
///
/// ```
/// use rocking::capacity::{InversionRule, ResponseCurve};
/// let vertices = [(1.0, 0.0), (1.2, 0.4), (1.4, 0.8), (1.6, 0.5)];
/// let curve = ResponseCurve::try_new(&vertices, Some(2.0))?;
/// let crossings = curve.crossings(0.6)?;
/// assert_eq!(crossings.all().len(), 3);
/// assert_eq!(crossings.capacity(InversionRule::Last).im(), 2.0);
/// # Ok::<(), rocking::capacity::CapacityError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ResponseCurve {
    /// Intensity and EDP of each vertex.
    pub(super) vertices: Vec<(f64, f64)>,
    pub(super) overturning_im: Option<f64>,
}

impl ResponseCurve {
    /// A curve through vertices (IM, EDP), and the intensity of first
    /// overturning if there was one.
    ///
    /// # Errors
    /// [`CapacityError`] unless intensities are positive and strictly
    /// increasing, EDPs finite and not negative with the first one 0, and
    /// overturning lies above the last vertex.
    pub fn try_new(
        vertices: &[(f64, f64)],
        overturning_im: Option<f64>,
    ) -> Result<Self, CapacityError> {
        let mut previous = 0.0;
        for (i, &(im, edp)) in vertices.iter().enumerate() {
            let number = i + 1;
            if !(im > previous && im.is_finite()) {
                return Err(CapacityError::Intensity { number, im, previous });
            }
            if !(edp >= 0.0 && edp.is_finite()) {
                return Err(CapacityError::Edp { number, edp });
            }
            previous = im;
        }
        let &(_, first) = vertices.first().ok_or(CapacityError::Empty)?;
        if first != 0.0 {
            return Err(CapacityError::FirstEdp(first));
        }
        if let Some(overturning) = overturning_im
            && !(overturning > previous && overturning.is_finite())
        {
            return Err(CapacityError::Overturning {
                overturning,
                last: previous,
            });
        }
        Ok(Self { vertices: vertices.to_vec(), overturning_im })
    }

    /// The same responses against another intensity measure, proportional
    /// to this one for the record (PGV for PGA).
    ///
    /// # Errors
    /// [`CapacityError::Factor`] unless the factor is positive and finite.
    pub fn scaled(&self, factor: f64) -> Result<Self, CapacityError> {
        if !(factor > 0.0 && factor.is_finite()) {
            return Err(CapacityError::Factor(factor));
        }
        let scale = |&(im, edp): &(f64, f64)| (factor * im, edp);
        Ok(Self {
            vertices: self.vertices.iter().map(scale).collect(),
            overturning_im: self.overturning_im.map(|im| factor * im),
        })
    }

    /// Intensity of the onset of rocking, the first vertex.
    pub fn onset_im(&self) -> f64 {
        self.vertices[0].0
    }

    /// Intensity of the last vertex, the last one that stood.
    pub fn last_im(&self) -> f64 {
        self.vertices[self.vertices.len() - 1].0
    }

    /// Intensity of first overturning; `None` if the record never overturned.
    pub fn overturning_im(&self) -> Option<f64> {
        self.overturning_im
    }

    /// The vertices (IM, EDP), overturning not among them.
    pub fn vertices(&self) -> impl Iterator<Item = (f64, f64)> + '_ {
        self.vertices.iter().copied()
    }

    /// EDP of the curve at an intensity: 0 up to the onset, infinite from the
    /// first overturning on (no resurrection), linear between vertices, and
    /// `None` if it is unknown (beyond the last vertex, or NaN).
    ///
    /// ```
    /// use rocking::capacity::ResponseCurve;
    /// let vertices = [(1.0, 0.0), (2.0, 0.5)];
    /// let curve = ResponseCurve::try_new(&vertices, Some(3.0))?;
    /// assert_eq!(curve.edp_at(0.5), Some(0.0));
    /// assert_eq!(curve.edp_at(1.5), Some(0.25));
    /// assert_eq!(curve.edp_at(2.5), None);
    /// assert_eq!(curve.edp_at(3.0), Some(f64::INFINITY));
    /// # Ok::<(), rocking::capacity::CapacityError>(())
    /// ```
    pub fn edp_at(&self, im: f64) -> Option<f64> {
        if self.overturning_im.is_some_and(|first| im >= first) {
            return Some(f64::INFINITY);
        }
        if im <= self.onset_im() {
            return Some(0.0);
        }
        self.vertices.windows(2).find_map(|pair| {
            let [(a, edp_a), (b, edp_b)] = [pair[0], pair[1]];
            if im == b {
                return Some(edp_b);
            }
            let share = (im - a) / (b - a);
            (im > a && im < b)
                .then(|| f64::mul_add(share, edp_b - edp_a, edp_a))
        })
    }
}
