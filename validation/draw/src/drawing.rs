//! The backend of plotters on which every figure is drawn: it writes SVG.
//!
//! plotters draws charts, axes, series and areas. The backend does what
//! plotters has no words for:
//!
//! * Sub-pixel coordinates. plotters counts whole pixels, so that its pixel is
//!   a twentieth of a pixel here.
//! * Classes in place of colours, because one style sheet colours a figure for
//!   light and dark screens, print and grey. The red of a colour is the number
//!   of an ink; plotters never looks at it ([`crate::colour`]).
//! * Dashes. plotters cuts a dashed line into pieces, which makes large files
//!   and dashes that start anew at every vertex. The green of a colour is the
//!   number of a dash pattern; the renderer of the SVG dashes.
//! * Widths of lines in hundredths of a pixel, which plotters counts in
//!   pixels.
//! * Italics and subscripts. plotters hands over the text; [`markup`] reads
//!   it.
//! * Widths of texts from a table and never from fonts, which differ between
//!   machines.
//! * Lines with fewer points, so that files stay small.
//!
//! Four things lie beside the backend. plotters moves points outside the plot
//! area to its edge, so that [`crate::panel`] clips lines before. It draws axes
//! below the data and has ticks of one length, so that a panel draws its axes
//! last and twice. It has a legend for each chart; [`crate::legend`] draws one
//! for all. Its logarithmic axis calls the logarithm of the platform, whose
//! bits differ; [`crate::axis`] maps with libm.

use std::convert::Infallible;
use std::fmt::Write as _;

use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle,
    DrawingBackend, DrawingErrorKind, FontTransform,
};

use crate::colour::{STYLE, class, dash_array};
use crate::geometry::{Point, kept};
use crate::markup;

/// Units of plotters in a pixel.
const PER_PX: i32 = 20;
/// How far a line with fewer points may be from the full one, in units.
const TOLERANCE: f64 = 2.0;
/// The same of lines thinner than half a pixel, of which there are many: no
/// reader follows one of them.
const OF_MANY: f64 = 14.0;
const FONTS: &str =
    "Helvetica,Arial,'Liberation Sans','Nimbus Sans',sans-serif";

/// A drawing under way: an SVG, and texts over its shapes.
pub(crate) struct Drawing {
    svg: String,
    /// Attributes of the path being written, empty if there is none: shapes
    /// of one look that follow one another are one path.
    open: String,
    /// Width and height in px.
    pub(crate) size_px: (u32, u32),
    texts: String,
}

/// Units of plotters nearest to a length in px.
pub(crate) fn units(px: f64) -> i32 {
    (f64::from(PER_PX) * px).round() as i32
}

/// Units of plotters as px.
pub(crate) fn px(units: i32) -> f64 {
    f64::from(units) / f64::from(PER_PX)
}

impl Drawing {
    /// An empty drawing of this size in px, with a name that is unique on a
    /// page, a title and a description in plain text.
    pub(crate) fn new(words: [&str; 3], (width, height): Point) -> Self {
        let whole = |x: f64| x.ceil().max(1.0) as u32;
        let (width, height) = (whole(width), whole(height));
        let [id, title, description] = words.map(markup::escaped);
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"fig\" \
             width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\" \
             aria-labelledby=\"{id}-title {id}-desc\" \
             font-family=\"{FONTS}\" xml:space=\"preserve\">\n\
             <title id=\"{id}-title\">{title}</title>\n\
             <desc id=\"{id}-desc\">{description}</desc>\n\
             <style>{STYLE}</style>\n\
             <rect class=\"p\" width=\"{width}\" height=\"{height}\"/>\n"
        );
        let (open, texts) = (String::new(), String::new());
        Self { svg, open, size_px: (width, height), texts }
    }

    /// The SVG.
    pub(crate) fn finish(mut self) -> String {
        self.close();
        self.svg + &self.texts + "</svg>\n"
    }

    fn close(&mut self) {
        if !self.open.is_empty() {
            self.svg.push_str("\"/>\n");
            self.open.clear();
        }
    }

    /// A line, with the command at its end unless it closes itself.
    fn shape(
        &mut self,
        colour: BackendColor,
        look: String,
        points: impl IntoIterator<Item = BackendCoord>,
        (tolerance, end): (f64, &str),
    ) -> Drawn {
        if colour.alpha == 0.0 {
            return Ok(());
        }
        let points: Vec<_> = points.into_iter().collect();
        if points.is_empty() {
            return Ok(());
        }
        let exact = points.iter().map(|p| (f64::from(p.0), f64::from(p.1)));
        let keep = kept(&exact.collect::<Vec<_>>(), tolerance);
        let points = points.into_iter().zip(keep).filter(|(_, keep)| *keep);
        let mut points: Vec<_> = points.map(|(point, _)| point).collect();
        let closed = points.len() > 2 && points.first() == points.last();
        points.truncate(points.len() - usize::from(closed));
        if self.open != look {
            self.close();
            let _ = write!(self.svg, "<path {look} d=\"");
            self.open = look;
        }
        let mut at = (0, 0);
        for (k, to) in points.into_iter().enumerate() {
            match k {
                0 => self.svg.push('M'),
                1 => self.svg.push('l'),
                _ => {}
            }
            self.number(to.0 - at.0);
            self.number(to.1 - at.1);
            at = to;
        }
        self.svg.push_str(if closed { "z" } else { end });
        Ok(())
    }

    /// Writes units as px with the fewest characters, behind a letter or
    /// another number.
    fn number(&mut self, units: i32) {
        let text = px(units).to_string().replace("-0.", "-.");
        let short = text.strip_prefix('0').filter(|rest| !rest.is_empty());
        let text = short.unwrap_or(&text);
        let behind = self.svg.ends_with(|c: char| c.is_ascii_digit());
        if behind && !text.starts_with('-') {
            self.svg.push(' ');
        }
        self.svg.push_str(text);
    }
}

type Drawn = Result<(), DrawingErrorKind<Infallible>>;

impl DrawingBackend for &mut Drawing {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        <[u32; 2]>::from(self.size_px).map(|px| px * PER_PX as u32).into()
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    fn draw_pixel(&mut self, at: BackendCoord, color: BackendColor) -> Drawn {
        self.draw_circle(at, PER_PX as u32 / 2, &color, true)
    }

    fn draw_line<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
    ) -> Drawn {
        self.draw_path([from, to], style)
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Drawn {
        let (ink, dash) = (class(style.color()), dash_array(style.color()));
        let width = f64::from(style.stroke_width()) / 100.0;
        let look = format!("class=\"l {ink}\" stroke-width=\"{width}\"{dash}");
        let is_thin = style.stroke_width() < 50;
        let end = (if is_thin { OF_MANY } else { TOLERANCE }, "");
        self.shape(style.color(), look, path, end)
    }

    /// A point of a thick round pen, so that many dots make one path.
    fn draw_circle<S: BackendStyle>(
        &mut self,
        centre: BackendCoord,
        radius: u32,
        style: &S,
        _fill: bool,
    ) -> Drawn {
        let (ink, width) = (class(style.color()), 2.0 * px(radius as i32));
        let look = format!("class=\"l r {ink}\" stroke-width=\"{width}\"");
        self.shape(style.color(), look, [centre], (TOLERANCE, "h0"))
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        corners: I,
        style: &S,
    ) -> Drawn {
        let BackendColor { alpha, .. } = style.color();
        let mut look = format!("class=\"{}\"", class(style.color()));
        if alpha < 1.0 {
            let _ = write!(look, " fill-opacity=\"{alpha}\"");
        }
        self.shape(style.color(), look, corners, (TOLERANCE, "z"))
    }

    /// The lower edge of a text is its baseline.
    fn draw_text<S: BackendTextStyle>(
        &mut self,
        text: &str,
        style: &S,
        (x, y): BackendCoord,
    ) -> Drawn {
        if text.is_empty() {
            return Ok(());
        }
        let size_px = style.size();
        let down = units(match style.anchor().v_pos {
            VPos::Top => 0.74 * size_px,
            VPos::Center => 0.36 * size_px,
            VPos::Bottom => 0.0,
        });
        let place = match style.transform() {
            FontTransform::None => {
                format!("x=\"{}\" y=\"{}\"", px(x), px(y + down))
            }
            _ => {
                let (x, y) = (px(x + down), px(y));
                format!("transform=\"translate({x} {y}) rotate(-90)\"")
            }
        };
        let align = match style.anchor().h_pos {
            HPos::Left => "",
            HPos::Center => " text-anchor=\"middle\"",
            HPos::Right => " text-anchor=\"end\"",
        };
        let (ink, content) =
            (class(style.color()), markup::tspans(text, size_px));
        let _ = writeln!(
            self.texts,
            "<text class=\"{ink}\" {place}{align} font-size=\"{size_px}\">\
             {content}</text>"
        );
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let size = (markup::width(text, style.size()), style.size());
        Ok((units(size.0) as u32, units(size.1) as u32))
    }
}
