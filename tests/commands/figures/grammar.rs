//! The chart grammar: figures of any data draw or say why not.
//!
//! Consistency checks: they look at the drawing, not at the physics.

use crate::figures::{check, check_texts, is_finite, texts};
use crate::program::has;
use crate::tier::sized;
use frictionsim::chart::*;
use proptest::prelude::*;
use std::sync::Arc;

/// Numbers that a result may hold when something went wrong, and ordinary ones.
fn number() -> impl Strategy<Value = f64> {
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, f64::MIN_POSITIVE];
    prop_oneof![
        prop::sample::select([&odd[..], &[0.0, -0.0, 5e-324, -1e300]].concat()),
        -1e3..1e3f64,
        (-300.0..300.0f64).prop_map(|e| 10f64.powf(e))
    ]
}

fn series() -> impl Strategy<Value = Vec<f64>> {
    prop_oneof![
        prop::collection::vec(number(), 0..12),
        (number(), 0..5usize).prop_map(|(value, count)| vec![value; count]),
    ]
}

fn axis(choice: u8, value: f64) -> Axis {
    let axis = Axis::new("quantity *q*", "m");
    match choice % 9 {
        0 => axis,
        1 => axis.prefixed(),
        2 => axis.logarithmic(),
        3 => axis.prefixed().decades(5.0),
        4 => axis.symmetric(),
        5 => axis.tight().including(value),
        6 => axis.between(0.0, value),
        7 => axis.logarithmic().between(value, 1.0),
        _ => axis.times(value),
    }
}

fn figure(xs: &[f64], ys: &[f64], zs: &[f64], axes: (u8, u8), value: f64) -> Figure {
    let pairs = || xs.iter().copied().zip(ys.iter().copied());
    let plot = Panel::new(axis(axes.0, value), axis(axes.1, value))
        .caption("all layers")
        .legend()
        .layer(Shapes::bands(vec![(value, 1.0, SERIES[5])]))
        .layer(Fill::between(xs, ys, zs, SERIES[1]).name("between"))
        .layer(Fill::from(value, xs, ys, SERIES[3]).opacity(0.5))
        .layer(Fill::range_of(xs, zs, SERIES[2]))
        .layer(Line::new(xs, ys).name("line").marked(Marker::Circle, 2.0).arrows(2))
        .layer(Points::new(pairs()).name("points"))
        .layer(Rule::horizontal(value).stretching().at_rim("level").beside("here"))
        .layer(Rule::vertical(value).at_rim("place"))
        .layer(Bars::new(pairs().map(|(x, y)| (x, value, y, "bar".into())).collect(), SERIES[0]))
        .layer(Label::new((value, value), "label"));
    let nodes: Vec<[f64; 2]> = pairs().map(|(x, y)| [x, y]).collect();
    let ring = (0..nodes.len() as u32 + 1).collect();
    let mesh = Mesh { rings: vec![ring], are_quadratic: vec![false], ..Mesh::default() };
    let window = Field::window(&nodes, 0.1);
    let (name, map) = (Axis::new("field", "Pa"), ColourMap::Diverging);
    let field = Field::new(Arc::new(mesh), nodes, zs.to_vec(), name, map);
    let picture = Panel::plane(window).layer(field).colour_bar(Side::Below);
    let colours = (Axis::new("level", "dB"), ColourMap::Inferno);
    let at = |column: usize, row: usize| zs.get(column + row).copied().unwrap_or(f64::NAN);
    let heat = Heat::of_values(((value, 1.0), xs.len()), ((0.0, value), ys.len()), colours, at);
    let map =
        Panel::new(axis(axes.1, value), axis(axes.0, value)).layer(heat).colour_bar(Side::Right);
    Figure::new("any", "Any data: everything.")
        .columns(2)
        .shared_y()
        .panel(plot)
        .panel(picture)
        .panel(map)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: sized(40, 200),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn figures_of_any_data_draw_or_say_that_there_is_nothing(
        xs in series(), ys in series(), zs in series(), axes in (0u8..9, 0u8..9), value in number(), width in 60.0..200.0f64,
    ) {
        let figure = figure(&xs, &ys, &zs, axes, value);
        match figure.to_svg(Some(width)) {
            Ok(svg) => {
                prop_assert!(is_finite(&svg), "{svg}");
                let drawing = Drawing::parse(&svg).unwrap();
                prop_assert!(drawing.to_png(40.0).is_ok() && drawing.to_pdf().is_ok());
                prop_assert_eq!(figure.to_svg(Some(width)).unwrap(), svg);
            }
            Err(error) => prop_assert!(matches!(error, ChartError::Empty(_)), "{error}"),
        }
    }
}

fn line(ys: &[f64], name: &str) -> Line {
    let xs: Vec<f64> = (0..ys.len()).map(|i| i as f64).collect();
    Line::new(&xs, ys).name(name)
}

fn plot() -> Panel {
    Panel::new(Axis::new("time *t*", "s").tight(), Axis::new("amplitude", "m").decades(3.0))
}

#[test]
fn legend_names_only_what_is_seen() {
    let panel = plot()
        .layer(line(&[1.0, 2.0], "alive"))
        .layer(line(&[1e-9, 1e-9], "far below"))
        .layer(line(&[f64::NAN; 2], "missing"));
    let svg = Figure::new("legend", "Legend.").panel(panel).to_svg(None).unwrap();
    has(&texts(&svg).join("\n"), &["alive ; !far below ; !missing"]);
}

#[test]
fn figures_without_data_say_so_and_panels_without_data_are_marked() {
    let empty = Figure::new("nothing", "Nothing.").panel(plot());
    assert_eq!(empty.to_svg(None), Err(ChartError::Empty("nothing".into())));
    let half = Figure::new("half", "Half.").columns(2).panel(plot());
    let half = half.panel(plot().layer(line(&[1.0, 2.0], "line")));
    check("half-empty", &half.to_svg(None).unwrap(), &["no data", "(a)", "(b)", "line"]);
}

#[test]
fn narrow_pages_stack_panels_and_keep_the_width_asked_for() {
    let figure = (0..3).fold(Figure::new("stack", "Stack.").columns(3), |figure, _| {
        figure.panel(plot().layer(line(&[1.0, 2.0], "line")))
    });
    let size = |width: Option<f64>| {
        let svg = figure.to_svg(width).unwrap();
        let view = svg.split("viewBox=\"0 0 ").nth(1).unwrap().split('"').next().unwrap();
        let (width, height) = view.split_once(' ').unwrap();
        (width.parse::<f64>().unwrap(), height.parse::<f64>().unwrap())
    };
    let ((wide, low), (narrow, high)) = (size(None), size(Some(85.0)));
    // 178 and 85 mm in points.
    assert!((wide - 504.57).abs() < 0.01 && (narrow - 240.94).abs() < 0.01);
    assert!(high > 2.5 * low, "{low} {high}");
}

#[test]
fn shared_axes_have_one_range_and_one_row_of_labels() {
    let figure = Figure::new("shared", "Shared.")
        .shared_x()
        .panel(plot().layer(line(&[1.0; 3], "short")))
        .panel(plot().layer(line(&[1.0; 9], "long")));
    let words = texts(&figure.to_svg(None).unwrap());
    assert_eq!(words.iter().filter(|word| *word == "time t (s)").count(), 1);
    assert_eq!(words.iter().filter(|word| *word == "8").count(), 1);
}

#[test]
fn markers_at_the_end_of_an_axis_are_whole() {
    let panel = Panel::new(Axis::new("x", "").tight(), Axis::new("y", "").tight());
    let panel = panel.layer(Points::new([(0.0, 0.0), (1.0, 1.0)]));
    let svg = Figure::new("ends", "Ends.").panel(panel).to_svg(None).unwrap();
    let clipped = svg.split("<g clip-path").nth(1).unwrap().split("</g>").next().unwrap();
    has(clipped, &["!<path"]);
}

#[test]
fn texts_of_any_length_stay_on_the_sheet_at_every_width() {
    let long = "a *quantity* with a name that is a good deal longer than any column of a page is wide, as users write them";
    let panel = |name: &str| {
        let time = Axis::new("time *t* since the beginning of the record", "s").tight();
        let panel = Panel::new(time, Axis::new("amplitude", "m"));
        let panel = panel.caption(long).heading(long).legend();
        panel
            .layer(line(&[1.0, 2.0], long))
            .layer(line(&[2.0, 1.0], name))
            .layer(Rule::horizontal(1.5).at_rim("10.51 kHz, mode 5, *n* = 2"))
            .layer(Rule::vertical(0.98).at_rim("mode 5"))
            .layer(Label::new((0.99, 1.99), "label at the rim"))
    };
    let figure =
        Figure::new("long", "Long.").columns(2).note(long).panel(panel("one")).panel(panel("two"));
    for width in [70.0, 85.0, 120.0, 178.0] {
        check_texts(&format!("long texts at {width} mm"), &figure.to_svg(Some(width)).unwrap());
    }
}

#[test]
fn a_character_that_is_none_does_not_stop_a_drawing() {
    let caption = "title \u{fffe} and \u{ffff}";
    let panel = plot().caption(caption).layer(line(&[1.0, 2.0], caption));
    let svg = Figure::new("none", caption).panel(panel).to_svg(None).unwrap();
    assert!(Drawing::parse(&svg).is_ok());
}

#[test]
fn drawings_become_one_page_of_pdf_of_their_size() {
    let figure = Figure::new("page", "Page.").panel(plot().layer(line(&[1.0, 2.0], "line")));
    let pdf = Drawing::parse(&figure.to_svg(None).unwrap()).unwrap().to_pdf().unwrap();
    let text = String::from_utf8_lossy(&pdf);
    assert!(text.starts_with("%PDF-1.7"), "{text}");
    has(&text, &["/Count 1 ; /MediaBox [0 0 504.5"]);
}
