//! Results of `mac`: modal assurance of measured shapes.

use crate::common::*;

keys! {
    /// `summary.json` of `mac`.
    MacSummary {
        measurement: String = "the measured shapes";
        friction_coefficient: f64 = "the friction coefficient of the modes";
        shapes: Vec<MacShape> = "the shapes";
        modes: Vec<MacMode> = "the modes";
        mac: Vec<Vec<f64>> = "the criterion, a row for each shape, a column for each mode";
        pairs: Vec<MacPair> = "the mode of each shape";
        notes: Vec<String> = "what there is to say";
    }

    /// A measured shape.
    MacShape {
        name: String = "what the file calls it";
        frequency_hz: Option<f64> = "its frequency, Hz, where the file says it";
        points: usize = "its points";
        off_body: usize = "those off the body, which are left out";
        largest_distance_m: f64 = "largest distance of a point from its nearest node, m";
    }

    /// A mode of the model.
    #[derive(Copy)]
    MacMode {
        mode: usize = "number by frequency, from 1";
        frequency_hz: f64 = "`Im(lambda) / 2 pi`, Hz";
        real_hz: f64 = "`Re(lambda) / 2 pi`, Hz";
        harmonic: Option<usize> = "nodal diameters; none without symmetry";
    }

    /// A shape and the mode that it is.
    #[derive(Copy)]
    MacPair {
        shape: usize = "shape, from 1";
        mode: usize = "mode, from 1";
        mac: f64 = "their criterion";
    }
}

/// A shape, a mode, their criterion, and whether they are a pair.
type Row = (MacShape, MacMode, f64, bool);

columns! {
    /// A shape beside a mode.
    pub(super) ROWS: row as Row;
    shape: "name of the measured shape" = row.0.name.clone(), Always "shape" Plain;
    measured_frequency_hz: "its frequency, where the file says it" = row.0.frequency_hz, IfAny "measured" Fixed(2);
    mode: "number of the mode by frequency, from 1" = row.1.mode, Always "mode" Count;
    frequency_hz: "its frequency" = row.1.frequency_hz, Always "frequency" Fixed(2);
    real_hz: "real part of its eigenvalue over 2 pi" = row.1.real_hz;
    harmonic: "its nodal diameters; none without symmetry" = row.1.harmonic, IfAny "n" Count;
    mac: "modal assurance criterion, 0 to 1" = row.2, Always "MAC" Fixed(4);
    paired: "whether the two are a pair" = row.3;

    /// How the mode grows, and what is left out of a shape.
    BESIDE: row as Row;
    growth_rate_per_s = TAU * row.1.real_hz, Always "growth rate" Fixed(2);
    off_body = row.0.off_body, Always "points off the body" Count;
}

impl MacSummary {
    /// The row of a shape and a mode, both from 1.
    fn row(&self, shape: usize, mode: usize) -> Row {
        let is_pair = self.pairs.iter().any(|pair| (pair.shape, pair.mode) == (shape, mode));
        let value = self.mac[shape - 1][mode - 1];
        (self.shapes[shape - 1].clone(), self.modes[mode - 1], value, is_pair)
    }

    /// What was found, in a sentence.
    pub fn answer(&self) -> String {
        let good = self.pairs.iter().filter(|pair| pair.mac >= 0.9).count();
        let least = self.pairs.iter().map(|pair| pair.mac).fold(1.0, f64::min);
        format!(
            "{good} of {} shapes agree with a mode of their own by 0.9 or more; the least of all pairs has {least:.3}",
            self.shapes.len()
        )
    }
}

impl Finding for MacSummary {
    fn document(&self) -> Document {
        let all = (1..=self.shapes.len())
            .flat_map(|shape| (1..=self.modes.len()).map(move |mode| self.row(shape, mode)));
        let pairs: Vec<Row> =
            self.pairs.iter().map(|pair| self.row(pair.shape, pair.mode)).collect();
        let table = Table::new("", "The mode of each shape");
        let results = Section::new("Results")
            .facts([
                ("shapes", self.shapes.len().to_string()),
                ("modes", self.modes.len().to_string()),
                ("friction coefficient", self.friction_coefficient.to_string()),
            ])
            .text([self.answer()])
            .tables([table.columns(ROWS, &pairs).columns(BESIDE, &pairs)]);
        Document::new("Modal assurance")
            .section(results)
            .section(Section::new("Modal assurance").figures(["mac"]))
            .file(Table::new("mac.csv", "Each shape and each mode").columns(ROWS, all))
            .notes(&self.notes)
    }

    fn figures(&self) -> Vec<Declaration<'_>> {
        vec![Box::new(|| Some(matrix(self)))]
    }
}

/// The criterion over modes and shapes, pairs marked.
fn matrix(summary: &MacSummary) -> Figure {
    let (shapes, modes) = (summary.shapes.len(), summary.modes.len());
    let span = |count: usize| ((0.5, count as f64 + 0.5), count);
    let axis = Axis::new("modal assurance criterion", "").between(0.0, 1.0);
    let value = |mode: usize, shape: usize| summary.mac[shape][mode];
    let heat = Heat::of_values(span(modes), span(shapes), (axis, ColourMap::Viridis), value);
    let places = summary.pairs.iter().map(|pair| (pair.mode as f64, pair.shape as f64));
    let numbers = |name: &str, count: usize| {
        let (from, to) = span(count).0;
        Axis::new(name, "").between(from, to)
    };
    let panel = Panel::new(numbers("mode of the model", modes), numbers("measured shape", shapes))
        .height(150.0)
        .layer(heat)
        .layer(Points::new(places).marker(Marker::Circle, 2.6, INK))
        .colour_bar(Side::Right);
    let caption =
        "Modal assurance criterion of each measured shape with each mode; circles are the pairs.";
    Figure::new("mac", caption).panel(panel)
}
