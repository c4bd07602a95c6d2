//! Layout of the panels of a figure: a grid whose data areas line up.

mod placed;

use crate::prelude::*;

/// Distance of everything from the rim, points.
const RIM: f64 = 4.0;
/// Distance between columns and between rows, points.
const GAP: f64 = 6.0;
/// Size of remarks, points.
const NOTE_SIZE: f64 = 6.25;

/// What a figure has in a grid, row by row, with all that tells where it stands.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Grid {
    /// Width of the page that it is meant for, mm.
    pub width_mm: f64,
    /// Panels in a row.
    pub columns: usize,
    /// Relative widths of the columns; empty for equal ones.
    pub weights: Vec<f64>,
    /// Panels in reading order, and places left free.
    pub cells: Vec<Option<Panel>>,
    /// Whether the panels of a column have one horizontal axis, those of a row one vertical axis.
    pub shares: [bool; 2],
    /// Whether each of several panels has a letter.
    pub has_letters: bool,
    /// Lines of remarks below, in mark-up.
    pub notes: Vec<String>,
    /// One scale of colours below all panels.
    pub foot: Option<Colours>,
}

impl Grid {
    /// An empty grid of one column.
    pub fn new(width_mm: f64) -> Self {
        Self { width_mm, columns: 1, has_letters: true, ..Self::default() }
    }

    pub fn is_whole(&self) -> bool {
        let weights = &self.weights;
        self.columns > 0
            && (weights.is_empty() || weights.len() == self.columns)
            && weights.iter().chain([&self.width_mm]).all(|w| *w > 0.0 && w.is_finite())
    }

    /// The panels in reading order.
    pub fn panels(&self) -> impl Iterator<Item = &Panel> {
        self.cells.iter().flatten()
    }
}

/// A panel with its cell, its axes and its place.
struct Placed<'a> {
    panel: &'a Panel,
    row: usize,
    column: usize,
    span: usize,
    labels: [bool; 2],
    frame: Frame,
    legend: Legend,
    /// Left end and width of its part of the row, points: room for texts above it.
    part: (f64, f64),
    /// Room left of its data area, points.
    left: f64,
    /// Whether names at its right stand inside it, for want of room.
    are_names_inside: bool,
}

/// Largest part of a page that names at the right of a panel may take.
const MOST_FOR_NAMES: f64 = 0.22;

/// Letter of the `index`-th panel.
pub(super) fn letter(index: usize) -> char {
    (b'a' + (index % 26) as u8) as char
}

/// A grid laid out on a page of some width.
pub(super) struct Layout<'a> {
    grid: &'a Grid,
    placed: Vec<Placed<'a>>,
    /// Whether panels stand one below the other that were meant to stand side by side.
    is_stacked: bool,
    legend: Legend,
    legend_left: f64,
    bottom: f64,
    width: f64,
}

impl<'a> Layout<'a> {
    /// Places all panels.
    pub fn of(grid: &'a Grid, width_mm: f64) -> Self {
        let width = width_mm * POINTS_PER_MM;
        // On a page much narrower than meant, fewer panels stand side by side.
        let is_narrow = width_mm < 0.75 * grid.width_mm;
        let fewer = ((grid.columns as f64 * width_mm / grid.width_mm) as usize).max(1);
        let columns = if is_narrow { fewer } else { grid.columns };
        // Pictures without axes stay readable in pairs.
        let are_pictures = grid.columns > 2 && grid.panels().all(|panel| panel.is_bare);
        let columns = columns.max(if are_pictures { 2 } else { 1 });
        // Panels that were not meant to stand below each other have axes of their own.
        let shares = [grid.shares[0] && columns == grid.columns, grid.shares[1]];
        let cells = cells_of(grid, columns, is_narrow);
        let placed = (0..cells.len()).map(|index| with_axes(shares, &cells, index)).collect();
        let mut layout = Self {
            grid,
            placed,
            is_stacked: is_narrow && columns == 1 && !shares[0],
            legend: Legend::default(),
            legend_left: RIM,
            bottom: 0.0,
            width,
        };
        layout.place_columns(columns);
        layout.collect_legends();
        layout.place_rows();
        layout
    }

    /// Widths: margins of each column are those of its neediest panel, the rest is shared; of panels in a stack each
    /// has its own.
    fn place_columns(&mut self, columns: usize) {
        let width = self.width;
        for cell in &mut self.placed {
            cell.are_names_inside =
                columns == 1 && cell.panel.names_width() > MOST_FOR_NAMES * width;
        }
        let (mut left, mut right) = (vec![0.0f64; columns], vec![0.0f64; columns]);
        for cell in &self.placed {
            left[cell.column] = left[cell.column].max(cell.left);
            // What stands at the right may reach into a free cell.
            let is_beside = |other: &Placed<'_>| {
                let rows = other.row..other.row + other.span;
                other.column == cell.column + 1 && rows.contains(&cell.row)
            };
            if cell.column + 1 == columns || self.placed.iter().any(is_beside) {
                let need = cell.panel.right_need(cell.are_names_inside);
                right[cell.column] = right[cell.column].max(need);
            }
        }
        if self.is_stacked {
            for cell in &mut self.placed {
                let x = RIM + cell.left;
                let need = cell.panel.right_need(cell.are_names_inside);
                let free = (width - RIM - need - x).max(20.0);
                (cell.frame.area.x, cell.frame.area.width) = (x, free);
                cell.part = (x, width - RIM - x);
            }
            return;
        }
        let margins: f64 = left.iter().chain(&right).sum();
        let free = width - 2.0 * RIM - GAP * (columns - 1) as f64 - margins;
        let weights = match self.grid.weights.len() == columns {
            true => self.grid.weights.clone(),
            false => vec![1.0; columns],
        };
        let total: f64 = weights.iter().sum();
        let mut x = RIM;
        for column in 0..columns {
            let width = (free * weights[column] / total).max(20.0);
            x += left[column];
            for cell in self.placed.iter_mut().filter(|cell| cell.column == column) {
                (cell.frame.area.x, cell.frame.area.width) = (x, width);
                cell.part = (x, width + right[column]);
                cell.left = left[column];
            }
            x += width + right[column] + GAP;
        }
    }

    fn collect_legends(&mut self) {
        for cell in &mut self.placed {
            let legend = if cell.panel.has_legend { &mut cell.legend } else { &mut self.legend };
            cell.panel.add_keys(&cell.frame, legend);
        }
        let left = self.placed.iter().filter(|cell| cell.column == 0);
        let left = left.map(|cell| cell.left).reduce(f64::min);
        self.legend_left = RIM + left.unwrap_or(0.0);
    }

    /// Heights: as the columns, with captions and legends above each panel.
    fn place_rows(&mut self) {
        let room = self.width - self.legend_left - RIM;
        let mut y = RIM + self.legend.height(room) + if self.legend.is_empty() { 0.0 } else { 3.0 };
        let rows = self.placed.iter().map(|cell| cell.row + cell.span).max().unwrap_or(0);
        let letters = self.has_letters();
        let (mut tops, mut bottoms) = (vec![0.0; rows], vec![0.0; rows]);
        for row in 0..rows {
            let own = || self.placed.iter().filter(|cell| cell.row == row);
            let top = own().map(|cell| cell.top_need(letters)).fold(0.0, f64::max);
            let single = own().filter(|cell| cell.span == 1);
            let height = single.map(|cell| cell.height()).fold(0.0, f64::max);
            let ends = self.placed.iter().filter(|cell| cell.row + cell.span == row + 1);
            let bottom =
                ends.map(|cell| cell.panel.bottom_need(cell.labels[0])).fold(0.0, f64::max);
            (tops[row], bottoms[row]) = (y + top, y + top + height);
            y += top + height + bottom + GAP;
        }
        for cell in &mut self.placed {
            let (top, bottom) = (tops[cell.row], bottoms[cell.row + cell.span - 1]);
            cell.frame.area.y = top;
            cell.frame.area.height = bottom - top;
            cell.make_equal();
        }
        self.bottom = y - GAP;
    }

    fn has_letters(&self) -> bool {
        self.grid.has_letters && self.placed.len() > 1
    }

    /// Draws the figure and sets its height.
    pub fn draw(&self, svg: &mut Svg) {
        let room = self.width - self.legend_left - RIM;
        self.legend.draw(svg, (self.legend_left, RIM), room);
        for (index, cell) in self.placed.iter().enumerate() {
            let names = (cell.left - TITLE_SIZE, cell.are_names_inside);
            cell.panel.draw(svg, &cell.frame, cell.labels, names);
            cell.draw_head(svg, self.has_letters().then(|| letter(index)));
        }
        let y = self.draw_foot(svg);
        svg.height = y + RIM;
    }

    /// Draws the scale of colours and the remarks, side by side where there is room, and gives the lower end.
    fn draw_foot(&self, svg: &mut Svg) -> f64 {
        let style = TextStyle::new(NOTE_SIZE).coloured(MUTED);
        let most = self.width - 2.0 * RIM - 2.0;
        let notes = self.grid.notes.iter();
        let notes = notes.flat_map(|note| text::wrapped(note, NOTE_SIZE, most));
        let notes: Vec<String> = notes.collect();
        let widths = notes.iter().map(|note| text::width(note, NOTE_SIZE, false));
        let widest = widths.fold(0.0, f64::max);
        let (mut first, mut foot) = (self.bottom, self.bottom);
        if let Some(colours) = &self.grid.foot {
            let width = 160f64.min(0.5 * self.width);
            let left = self.width - width - 16.0;
            colours.draw_flat_bar(svg, (left, self.bottom + 3.0), width);
            foot += FLAT_BAR_HEIGHT;
            // Its title may be wider than the bar.
            if RIM + 2.0 + widest > left - 24.0 {
                first = foot;
            }
        }
        for (row, note) in notes.iter().enumerate() {
            svg.text(RIM + 2.0, first + 9.0 * (row + 1) as f64, note, &style);
        }
        foot.max(first + 9.0 * notes.len() as f64)
    }
}

/// A panel with its row, its column and the number of rows that it stands beside, and the ranges of its data.
type Cell<'a> = (&'a Panel, [usize; 3], [Option<(f64, f64)>; 2]);

/// Fills the grid row by row; a panel beside several rows keeps its column in all of them.
fn cells_of(grid: &Grid, columns: usize, is_narrow: bool) -> Vec<Cell<'_>> {
    let mut taken: Vec<(usize, usize)> = Vec::new();
    let mut cells = Vec::new();
    let mut next = 0;
    for cell in &grid.cells {
        while taken.contains(&(next / columns, next % columns)) {
            next += 1;
        }
        let (row, column) = (next / columns, next % columns);
        match cell {
            Some(panel) => {
                let span = if is_narrow { 1 } else { panel.span };
                taken.extend((row..row + span).map(|row| (row, column)));
                cells.push((panel, [row, column, span], panel.ranges()));
            }
            None if is_narrow => continue,
            None => taken.push((row, column)),
        }
        next += 1;
    }
    cells
}

/// The panel of a cell with the ends of its axes, of shared ones over the data of all that share them, and which are
/// labelled: of shared ones the lowest and the leftmost.
fn with_axes<'a>(shares: [bool; 2], cells: &[Cell<'a>], index: usize) -> Placed<'a> {
    let (panel, place @ [row, column, span], _) = cells[index];
    let range = |axis: usize| {
        let are_together = |other: [usize; 3]| shares[axis] && other[1 - axis] == place[1 - axis];
        let own = cells.iter().filter(|cell| cell.1 == place || are_together(cell.1));
        let ranges = own.filter_map(|cell| cell.2[axis]);
        ranges.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    };
    let (x, y) = (panel.x.resolve(range(0)), panel.y.resolve(range(1)));
    let is_below = |other: [usize; 3]| other[..2] == [row + span, column];
    let is_before = |other: [usize; 3]| other[0] == row && other[1] < column;
    let has_below = cells.iter().any(|cell| is_below(cell.1));
    let has_before = cells.iter().any(|cell| is_before(cell.1));
    let labels = [!(shares[0] && has_below), !(shares[1] && has_before)];
    Placed {
        panel,
        row,
        column,
        span,
        labels,
        left: panel.left_need(&y, labels[1]),
        frame: Frame { area: Rect::new(0.0, 0.0, 0.0, 0.0), x, y },
        legend: Legend::default(),
        part: (0.0, 0.0),
        are_names_inside: false,
    }
}
