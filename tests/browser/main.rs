//! Reports in a real browser: every control is used, and what it shows is held to the tables of the run.
//!
//! Where there is no browser all are reported as ignored, with the reason; `.ci/run` installs one.

#[path = "../common/mod.rs"]
mod common;
mod driver;
mod page;

use common::prelude::*;
use driver::Browser;
use libtest_mimic::{Arguments, Trial};
use page::*;

/// Tests by their names: whether there is a browser is known only when they run, too late for an attribute of theirs.
macro_rules! tests {
    ($($name:ident),* $(,)?) => {
        [$((stringify!($name), $name as fn())),*]
    };
}

fn main() {
    let is_there = driver::is_there();
    let tests = tests![
        eigenvalues_move_with_friction_and_modes_with_time,
        solid_bodies_are_turned_and_their_modes_move,
        tables_are_sorted_and_filtered,
        a_run_is_zoomed_read_heard_and_taken_along,
        a_click_on_a_point_of_a_study_shows_the_numbers_of_its_run,
        without_scripts_numbers_and_pictures_are_there,
        two_runs_are_compared_number_by_number_and_curve_over_curve,
    ];
    let trials = tests.map(|(name, test)| {
        let trial = Trial::test(name, move || {
            test();
            Ok(())
        });
        let reason = if is_there { "" } else { "left out: no chromedriver" };
        trial.with_kind(reason).with_ignored_flag(!is_there)
    });
    libtest_mimic::run(&Arguments::from_args(), trials.into()).exit()
}

fn eigenvalues_move_with_friction_and_modes_with_time() {
    let (_folder, run) = eigenvalue_report();
    let browser = Browser::open(WIDE);
    browser.visit_ready(&run.path("report.html"));
    check_text_stays_text(&browser);
    press(&browser, "locus", "Move friction");
    let shown = || {
        browser.run(
            "const of = part => [...document.querySelectorAll('#locus .more ' + part)];\
             return [of('p[aria-live]')[0].textContent, of('li').length]",
        )
    };
    assert_eq!(shown(), json!(["friction coefficient = 0: no unstable", 0]));
    browser.send("#locus input[type=range]", "\u{E010}");
    let rows = run.rows("eigenvalues.csv").into_iter();
    let rows = rows.filter(|row| row["friction_coefficient"] == "0.6" && row["unstable"] == "true");
    let unstable = rows.count() as u64;
    assert!(unstable > 0);
    let said = format!("friction coefficient = 0.6: {unstable} unstable");
    assert_eq!(shown(), json!([said, unstable]));
    assert_ne!(browser.run("return document.querySelector('#locus input[type=range]').getAttribute('aria-valuetext')"), Value::Null);
    press(&browser, "modes-mu-0.3", "Animate");
    let figure = "modes-mu-0.3";
    let phase = || canvas(&browser, figure, "dataset.phase");
    let picture = || canvas(&browser, figure, "toDataURL()");
    let first = (phase(), picture());
    play(&browser, figure);
    assert_ne!((phase(), picture()), first);
    let still = phase();
    std::thread::sleep(Duration::from_millis(150));
    assert_eq!(phase(), still);
    keep_screenshot(&browser, "motion-1280.png");
    check_page(&browser);
}

fn solid_bodies_are_turned_and_their_modes_move() {
    let browser = Browser::open(WIDE);
    let canvas = |figure: &str, what: &str| canvas(&browser, figure, what);
    // A mesh: its regions and boundaries from every side.
    let mesh_file = format!("mesh.file={:?}", shipped("meshes/brake.inp"));
    let (_folder, run) = report_of("mesh", "brake.toml", &[&mesh_file]);
    browser.visit_ready(&run.path("report.html"));
    press(&browser, "mesh", "Look around");
    let regions = canvas("mesh", "toDataURL()");
    browser.send("#mesh canvas", "\u{E014}");
    let turned = canvas("mesh", "toDataURL()");
    assert_ne!(turned, regions);
    keep_screenshot(&browser, "mesh-solid-1280.png");
    browser.run("const s = document.querySelector('#mesh select'); s.value = 1; s.dispatchEvent(new Event('change'))");
    assert_ne!(canvas("mesh", "toDataURL()"), turned);
    // Every boundary that does something is in the legend.
    let legend = canvas("mesh", "nextElementSibling.textContent");
    for word in ["contact", "counterface", "pressure", "tie"] {
        assert!(legend.as_str().unwrap().contains(word), "{legend}");
    }
    check_accessibility(&browser);
    // Modes of an assembly and of a body of revolution: they move, from the side that was chosen.
    let assembly = [
        &*mesh_file,
        "cea.friction_coefficients=[0.0,0.4] ; cea.shapes_at=[0.4] ; cea.max_frequency_hz=3000.0",
    ];
    let revolution =
        ["mesh.circumferential_elements=24 ; mesh.radial_elements=3 ; mesh.axial_elements=2 ; \
         cea.friction_coefficients=[0.4] ; cea.shapes_at=[0.4]"];
    let cases = [("brake.toml", &assembly[..]), ("disc-three-dimensions.toml", &revolution[..])];
    for (name, set) in cases {
        let (_folder, run) = report_of("cea", name, set);
        browser.visit_ready(&run.path("report.html"));
        let figure = "modes-mu-0.4";
        press(&browser, figure, "Animate");
        let first = canvas(figure, "toDataURL()");
        let corner = canvas(figure, "getBoundingClientRect().toJSON()");
        let [x, y] = ["x", "y"].map(|key| corner[key].as_f64().unwrap());
        browser.press_along(&[[x + 300.0, y + 200.0], [x + 380.0, y + 240.0]]);
        let turned = canvas(figure, "toDataURL()");
        assert_ne!(turned, first, "{name}");
        play(&browser, figure);
        assert_ne!(canvas(figure, "toDataURL()"), turned, "{name}");
        keep_screenshot(&browser, &format!("modes-{name}-1280.png"));
        press(&browser, figure, "First view");
        check_page(&browser);
    }
}

fn tables_are_sorted_and_filtered() {
    let (_folder, run) = eigenvalue_report();
    let browser = Browser::open(PHONE);
    browser.visit_ready(&run.path("report.html"));
    keep_screenshot(&browser, "eigenvalues-400.png");
    let table = "[...document.querySelectorAll('table')].find(t => t.caption?.textContent.startsWith('Eigenvalues'))";
    let column = || -> Vec<f64> {
        let script = format!(
            "const shown = [...{table}.tBodies[0].rows].filter(r => !r.hidden);\
             return shown.map(r => Number(r.cells[3].textContent))"
        );
        serde_json::from_value(browser.run(&script)).unwrap()
    };
    let head = format!("{table}.tHead.rows[0].cells[3]");
    let sort = || browser.run(&format!("{head}.querySelector('button').click()"));
    let before = column();
    sort();
    let rising = column();
    assert!(rising.is_sorted() && !before.is_sorted() && rising.len() == before.len());
    sort();
    assert!(column().iter().rev().is_sorted());
    let order = browser.run(&format!("return {head}.getAttribute('aria-sort')"));
    assert_eq!(order, json!("descending"));
    let above = format!("{table}.parentElement.previousElementSibling");
    browser.run(&format!("{above}.querySelector('input').id = 'filter'"));
    browser.send("#filter", "unstable");
    let left = column();
    let is_part = !left.is_empty() && left.len() < before.len();
    assert!(is_part && left.iter().all(|&real| real > 0.0), "{left:?}");
    // Nothing but a table or a picture, each in its own frame, is wider than the phone.
    let width = browser.run("return document.documentElement.scrollWidth");
    assert!(width.as_u64().unwrap() <= PHONE[0] as u64, "{width}");
    check_page(&browser);
}

fn a_run_is_zoomed_read_heard_and_taken_along() {
    let set =
        ["mesh.circumferential_elements=48 ; mesh.radial_elements=7 ; output.probes=[1,5] ; \
         output.snapshots=[0.005] ; transient.perturbation.velocity=3e-2 ; \
         transient.duration=0.012"];
    let (_folder, run) = report_of("transient", "polycarbonate-610rpm.toml", &set);
    let browser = Browser::open(WIDE);
    browser.visit_ready(&run.path("report.html"));
    check_text_stays_text(&browser);
    keep_screenshot(&browser, "run-1280.png");
    press(&browser, "overview-5", "Zoom");
    let plot = "document.querySelector('#overview-5 .plot').plot";
    let view = || -> [f64; 2] {
        let view = browser.run(&format!("const x = {plot}.scales.x; return [x.min, x.max]"));
        serde_json::from_value(view).unwrap()
    };
    let all = view();
    // The last sample, 12 ms, is an end of the axis.
    assert!((all[1] - 12.0).abs() < 1e-9 && all[0].abs() < 1e-9, "{all:?}");
    press(&browser, "overview-5", "Zoom in");
    let half = view();
    assert!((half[1] - half[0] - 0.5 * (all[1] - all[0])).abs() < 1e-9, "{half:?}");
    browser.run("document.querySelector('#overview-5 .plot').focus()");
    browser.send("#overview-5 .plot", "\u{E014}");
    assert!(view()[0] > half[0]);
    browser.send("#overview-5 .plot", "0");
    assert_eq!(view(), all);
    browser.drag_over("#overview-5 .u-over");
    let dragged = view();
    assert!(dragged[0] > 1.0 && dragged[1] < 11.0, "{dragged:?}");
    browser.send("#overview-5 .plot", "0");
    browser.send("#overview-5 .plot", ".");
    let read = browser.run("return document.querySelector('#overview-5 .readout').textContent");
    assert!(read.as_str().unwrap().contains("time t (ms)"), "{read}");
    // The samples, against the table of the run.
    let taken = data_of(&browser, "overview-5");
    assert_eq!(taken[0][..2], ["time t (ms)", "tangential acceleration, node 5: aθ (m/s²)"]);
    let rows = columns(&run.rows("probe-5.csv"), ["time_s", "a_theta_m_per_s2"]);
    assert_eq!(taken.len() - 1, rows.len());
    let number = |text: &str| text.parse::<f64>().unwrap();
    let largest = rows.iter().map(|row| row[1].abs()).fold(0.0, f64::max);
    for (own, row) in taken[1..].iter().zip(&rows) {
        // Single precision, eight digits.
        assert!((number(&own[0]) - 1e3 * row[0]).abs() < 1e-6);
        assert!((number(&own[1]) - row[1]).abs() < 1e-6 * largest);
    }
    // Series off and on.
    press(&browser, "energy", "Zoom");
    let pressed = "return document.querySelector('#energy .series').getAttribute('aria-pressed')";
    assert_eq!(browser.run(pressed), json!("true"));
    let picture = || {
        browser.run_async(
            "await new Promise(requestAnimationFrame); await new Promise(requestAnimationFrame);\
             return document.querySelector('#energy .series').parentElement.previousElementSibling.querySelector('canvas').toDataURL()",
        )
    };
    let whole = picture();
    browser.run("document.querySelector('#energy .series').click()");
    assert_eq!(browser.run(pressed), json!("false"));
    assert_ne!(picture(), whole);
    browser.run("document.querySelector('#energy .series').click()");
    assert_eq!(picture(), whole);
    // The sound holds the main frequency.
    press(&browser, "overview-5", "Listen");
    press(&browser, "overview-5", "Play sound");
    browser.wait("return document.querySelector('#overview-5 audio') !== null");
    let heard = browser.run_async(
        "const audio = document.querySelector('#overview-5 audio');\
         for (let i = 0; i < 200 && !(audio.readyState >= 2); i++) await new Promise(r => setTimeout(r, 20));\
         if (audio.error || audio.readyState < 2) return 'no sound: ' + audio.error?.message;\
         return [audio.duration, audio.previousElementSibling.textContent]",
    );
    assert!((heard[0].as_f64().unwrap_or(0.0) - 2.0).abs() < 1e-3, "{heard}");
    let main = run.summary()["main_frequency_hz"].as_f64().unwrap();
    // "loudest at 19.2 kHz, ...": a contact that opens may be loudest at a multiple of its main frequency.
    let said = heard[1].as_str().and_then(|text| text.split(' ').nth(2)?.parse::<f64>().ok());
    let multiple = 1e3 * said.unwrap_or_else(|| panic!("no tone is named: {heard}")) / main;
    assert!(multiple > 0.9 && (multiple - multiple.round()).abs() < 0.05, "{heard} {main}");
    check_page(&browser);
}

fn a_click_on_a_point_of_a_study_shows_the_numbers_of_its_run() {
    let set = ["mesh.circumferential_elements=36 ; mesh.radial_elements=4 ; output.probes=[1] ; \
         output.sample_interval=1e-5 ; transient.duration=0.008 ; \
         transient.perturbation.velocity=0.1 ; sweep.\"contact.friction_coefficient\"=[0.3,0.4] ; \
         sweep.\"contact.rotation_speed_rpm\"=[610.0,2000.0]"];
    let (_folder, run) = report_of("sweep", "speed-friction-study.toml", &set);
    let browser = Browser::open(WIDE);
    browser.visit_ready(&run.path("report.html"));
    check_text_stays_text(&browser);
    press(&browser, "frequencies", "Zoom");
    let row = "[...document.querySelectorAll('table')].find(t => t.tHead?.rows[0].cells[0].textContent === 'point').tBodies[0].rows[0]";
    let place = browser.run(&format!(
        "const plot = document.querySelector('#frequencies .plot').plot, row = {row};\
         plot.over.scrollIntoView({{ block: 'center' }});\
         const r = plot.over.getBoundingClientRect(), cell = i => Number(row.cells[i].textContent);\
         return [r.left + plot.valToPos(cell(2), 'x'), r.top + plot.valToPos(cell(3) / 1000, 'y')]"
    ));
    browser.press_along(&[[0, 1].map(|i| place[i].as_f64().unwrap())]);
    let shown = browser.run(&format!(
        "return [[...{row}.cells], [...document.querySelectorAll('#frequencies .picked dd')]].map(l => l.map(c => c.textContent))"
    ));
    assert_eq!(shown[0], shown[1], "{shown}");
    check_page(&browser);
}

fn without_scripts_numbers_and_pictures_are_there() {
    let (_folder, run) = eigenvalue_report();
    let html = run.text("report.html");
    // The same page, its scripts as text.
    let silent = run.path("silent.html");
    fs::write(&silent, html.replace("<script>", "<script type=\"text/plain\">")).unwrap();
    let browser = Browser::open(WIDE);
    browser.visit(&silent);
    assert_eq!(browser.run("return document.documentElement.dataset.ready ?? null"), Value::Null);
    let visible = browser.run("return [...document.querySelectorAll('dd, td, figure svg')].every(e => e.getClientRects().length > 0)");
    assert_eq!(visible, json!(true));
    let counted = browser.run("return [document.querySelectorAll('td').length, document.querySelectorAll('figure svg').length]");
    assert_eq!(counted, json!([html.matches("<td").count(), html.matches("<figure").count()]));
    check_accessibility(&browser);
    keep_screenshot(&browser, "without-scripts-1280.png");
}

fn two_runs_are_compared_number_by_number_and_curve_over_curve() {
    let set = [EIGENVALUE_SET, "material.poisson_ratio=0.36"];
    let runs = [eigenvalue_report(), report_of("cea", "polycarbonate-disc.toml", &set)];
    let [a, b] = runs.each_ref().map(|(_, run)| run.out.to_str().unwrap());
    let both = Run::new(&["compare", a, b, "-qq"]).within(&runs[0].0).out("both").done();
    let [one, two] = runs.each_ref().map(|(_, run)| {
        run.summary()["critical_frictions"][0]["critical_friction"].as_f64().unwrap()
    });
    let table = both.text("compare.csv");
    let row = table.lines().find(|row| row.contains(".critical_friction,")).unwrap();
    let numbers = row.rsplit(',').take(4).map(|cell| cell.parse::<f64>().unwrap());
    let [relative, difference, b, a]: [f64; 4] = numbers.collect::<Vec<_>>().try_into().unwrap();
    assert_eq!((a, b), (one, two), "{row}");
    let apart = two - one;
    assert!((difference - apart).abs() < 1e-15 && (relative - apart / one).abs() < 1e-12);
    let browser = Browser::open(WIDE);
    browser.visit_ready(&both.path("report.html"));
    keep_screenshot(&browser, "compare-1280.png");
    // Curves of both runs in one panel.
    press(&browser, "pairs", "Zoom");
    let names = browser.run("return [...document.querySelectorAll('#pairs .series')].map(b => b.textContent.split(': ')[0])");
    let names: BTreeSet<_> = names.as_array().unwrap().iter().filter_map(Value::as_str).collect();
    assert_eq!(names.len(), 2, "{names:?}");
    check_page(&browser);
}
