//! A plotters backend that writes SVG in twentieths of a pixel.
//!
//! plotters carries integer coordinates, colours and integer widths. Here a
//! coordinate counts [`PER_PX`] to the pixel, a width counts hundredths of a
//! pixel, and a colour's three bytes are the codes of [`super::colour`]:
//! ink, dash, opacity. The style sheet turns inks into colours. Lines that
//! follow one another with the same pen become one path.

use std::convert::Infallible;
use std::fmt::Write as _;

use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle,
    DrawingBackend, DrawingErrorKind, FontStyle, FontTransform,
};

use super::colour::{STYLE, class, dash_array};
use super::markup;

/// Coordinate steps in a pixel.
pub const PER_PX: i32 = 20;
/// Text size that elements have unless they say otherwise, in px.
pub const TEXT_PX: f64 = 11.0;
const FONTS: &str =
    "Helvetica,Arial,'Liberation Sans','Nimbus Sans',sans-serif";

type Done = Result<(), DrawingErrorKind<Infallible>>;

/// The backend. What it draws is in the string once plotters has called
/// [`DrawingBackend::present`].
#[derive(Debug)]
pub struct Svg<'a> {
    out: &'a mut String,
    size_px: (u32, u32),
    /// Attributes of the path being written, empty if none is.
    open: String,
    /// Where its pen is.
    at: BackendCoord,
}

impl<'a> Svg<'a> {
    /// Starts an SVG; `name` is unique on a page, `title` and `description`
    /// are for those who cannot see it.
    #[must_use]
    pub fn new(
        out: &'a mut String,
        size_px: (u32, u32),
        name: &str,
        title: &str,
        description: &str,
    ) -> Self {
        let (width, height) = size_px;
        let mut id = String::new();
        markup::write_escaped(&mut id, name);
        let _ = write!(
            out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"fig\" \
             width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\" \
             aria-labelledby=\"{id}-title {id}-desc\" \
             font-family=\"{FONTS}\" font-size=\"{TEXT_PX}\">\n\
             <title id=\"{id}-title\">"
        );
        markup::write_escaped(out, title);
        let _ = write!(out, "</title>\n<desc id=\"{id}-desc\">");
        markup::write_escaped(out, description);
        let _ = write!(
            out,
            "</desc>\n<style>{STYLE}</style>\n\
             <rect class=\"p\" width=\"{width}\" height=\"{height}\"/>\n"
        );
        Self { out, size_px, open: String::new(), at: (0, 0) }
    }

    /// Makes sure that a path with these attributes is open.
    fn path(&mut self, attributes: String) {
        if self.open != attributes {
            self.close();
            let _ = write!(self.out, "<path {attributes} d=\"");
            self.open = attributes;
        }
    }

    fn close(&mut self) {
        if !self.open.is_empty() {
            self.out.push_str("\"/>\n");
            self.open.clear();
        }
    }

    fn move_to(&mut self, to: BackendCoord) {
        self.out.push('M');
        self.out.push_str(&px(to.0));
        separated(self.out, &px(to.1));
        self.at = to;
    }

    fn lines(&mut self, points: impl Iterator<Item = BackendCoord>) {
        let mut first = true;
        for p in points {
            let (dx, dy) = (p.0 - self.at.0, p.1 - self.at.1);
            if dx == 0 && dy == 0 {
                continue;
            }
            if first {
                self.out.push('l');
                self.out.push_str(&px(dx));
            } else {
                separated(self.out, &px(dx));
            }
            separated(self.out, &px(dy));
            first = false;
            self.at = p;
        }
    }
}

/// A coordinate in px with the fewest characters.
fn px(steps: i32) -> String {
    let hundredths = i64::from(steps) * 100 / i64::from(PER_PX);
    let sign = if hundredths < 0 { "-" } else { "" };
    let (whole, rest) = (hundredths.abs() / 100, hundredths.abs() % 100);
    match (whole, rest) {
        (w, 0) => format!("{sign}{w}"),
        (0, r) if r % 10 == 0 => format!("{sign}.{}", r / 10),
        (0, r) => format!("{sign}.{r:02}"),
        (w, r) if r % 10 == 0 => format!("{sign}{w}.{}", r / 10),
        (w, r) => format!("{sign}{w}.{r:02}"),
    }
}

/// Writes a number after another one.
fn separated(out: &mut String, number: &str) {
    if !number.starts_with('-') {
        out.push(' ');
    }
    out.push_str(number);
}

/// Attributes of a line.
fn stroke<S: BackendStyle>(style: &S) -> String {
    let (ink, dash, _) = style.color().rgb;
    let width = f64::from(style.stroke_width()) / 100.0;
    let mut out =
        format!("class=\"l {}\" stroke-width=\"{width}\"", class(ink));
    if let Some(array) = dash_array(dash) {
        let _ = write!(out, " stroke-dasharray=\"{array}\"");
    }
    out
}

/// Attributes of an area.
fn fill<S: BackendStyle>(style: &S) -> String {
    let (ink, _, percent) = style.color().rgb;
    let mut out = format!("class=\"{}\"", class(ink));
    if percent < 100 {
        let _ =
            write!(out, " fill-opacity=\"{}\"", f64::from(percent) / 100.0);
    }
    out
}

impl DrawingBackend for Svg<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        let per_px = PER_PX.unsigned_abs();
        (self.size_px.0 * per_px, self.size_px.1 * per_px)
    }

    fn ensure_prepared(&mut self) -> Done {
        Ok(())
    }

    fn present(&mut self) -> Done {
        self.close();
        if !self.out.ends_with("</svg>\n") {
            self.out.push_str("</svg>\n");
        }
        Ok(())
    }

    fn draw_pixel(&mut self, at: BackendCoord, color: BackendColor) -> Done {
        self.draw_circle(at, 1, &color, true)
    }

    fn draw_line<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
    ) -> Done {
        self.draw_path([from, to], style)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        (left, top): BackendCoord,
        (right, bottom): BackendCoord,
        style: &S,
        filled: bool,
    ) -> Done {
        let corners =
            [(left, top), (right, top), (right, bottom), (left, bottom)];
        if filled {
            self.fill_polygon(corners, style)
        } else {
            self.draw_path(corners.into_iter().chain([(left, top)]), style)
        }
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Done {
        let points: Vec<BackendCoord> = path.into_iter().collect();
        let (Some(first), Some(last)) = (points.first(), points.last()) else {
            return Ok(());
        };
        self.path(stroke(style));
        self.move_to(*first);
        let closed = points.len() > 2 && first == last;
        let until = points.len() - usize::from(closed);
        self.lines(points[1..until].iter().copied());
        if closed {
            self.out.push('z');
            self.at = *first;
        }
        Ok(())
    }

    /// A filled circle is a point of a thick round pen, so that many make
    /// one path.
    fn draw_circle<S: BackendStyle>(
        &mut self,
        centre: BackendCoord,
        radius: u32,
        style: &S,
        filled: bool,
    ) -> Done {
        let (ink, ..) = style.color().rgb;
        let radius_px = f64::from(radius) / f64::from(PER_PX);
        if filled {
            let width = 2.0 * radius_px;
            self.path(format!(
                "class=\"l r {}\" stroke-width=\"{width}\"",
                class(ink)
            ));
            self.move_to(centre);
            self.out.push_str("h0");
        } else {
            self.close();
            let _ = writeln!(
                self.out,
                "<circle {} cx=\"{}\" cy=\"{}\" r=\"{radius_px}\"/>",
                stroke(style),
                px(centre.0),
                px(centre.1),
            );
        }
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        corners: I,
        style: &S,
    ) -> Done {
        let mut corners = corners.into_iter();
        let Some(first) = corners.next() else {
            return Ok(());
        };
        self.path(fill(style));
        self.move_to(first);
        self.lines(corners);
        self.out.push('z');
        Ok(())
    }

    /// Text in markup; the position is on the baseline for
    /// [`VPos::Bottom`].
    fn draw_text<T: BackendTextStyle>(
        &mut self,
        text: &str,
        style: &T,
        at: BackendCoord,
    ) -> Done {
        self.close();
        let size = style.size();
        let anchor = style.anchor();
        let down = match anchor.v_pos {
            VPos::Bottom => 0.0,
            VPos::Center => 0.35 * size,
            VPos::Top => 0.72 * size,
        };
        let degrees = match style.transform() {
            FontTransform::None => 0,
            FontTransform::Rotate90 => 90,
            FontTransform::Rotate180 => 180,
            FontTransform::Rotate270 => -90,
        };
        let (x, y) = (px(at.0), px(at.1));
        let (ink, ..) = style.color().rgb;
        let _ = write!(self.out, "<text class=\"{}\"", class(ink));
        if degrees == 0 {
            let lower = at.1 + (down * f64::from(PER_PX)) as i32;
            let _ = write!(self.out, " x=\"{x}\" y=\"{}\"", px(lower));
        } else {
            let _ = write!(
                self.out,
                " transform=\"translate({x} {y}) rotate({degrees})\""
            );
            if down != 0.0 {
                let _ = write!(self.out, " y=\"{down:.2}\"");
            }
        }
        match anchor.h_pos {
            HPos::Left => {}
            HPos::Center => self.out.push_str(" text-anchor=\"middle\""),
            HPos::Right => self.out.push_str(" text-anchor=\"end\""),
        }
        if size != TEXT_PX {
            let _ = write!(self.out, " font-size=\"{size}\"");
        }
        if matches!(style.style(), FontStyle::Bold) {
            self.out.push_str(" font-weight=\"bold\"");
        }
        let mut content = String::new();
        markup::write_tspans(&mut content, text, size);
        if content.contains('<') {
            self.out.push_str(" xml:space=\"preserve\"");
        }
        let _ = writeln!(self.out, ">{content}</text>");
        Ok(())
    }

    fn estimate_text_size<T: BackendTextStyle>(
        &self,
        text: &str,
        style: &T,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let per_px = f64::from(PER_PX);
        let width = markup::width(text, style.size()) * per_px;
        Ok((width.ceil() as u32, (style.size() * per_px).ceil() as u32))
    }
}
