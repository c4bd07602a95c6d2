//! Reports to look at, and what is checked on every page.

use super::driver::Browser;
use crate::common::prelude::*;

/// Text that would become an element if it were not escaped.
pub const MARKUP: &str = "</script><img src=x onerror=document.title='broken'>&amp;";

pub const WIDE: [usize; 2] = [1280, 900];
pub const PHONE: [usize; 2] = [400, 800];

/// A run of a case of the collection, with a title that has markup in it, in a folder.
pub fn report_of(command: &str, name: &str, set: &[&str]) -> (TempDir, Answer) {
    let text = fs::read_to_string(shipped(name)).unwrap();
    let title = text.lines().find(|line| line.starts_with("title")).unwrap();
    let text = text.replace(title, &format!("title = \"{MARKUP}\""));
    let folder = folder_with(&[("case.toml", text.as_bytes())]);
    let run = Run::new(&[command, "case.toml", "-qq"]).within(&folder).out("out").set(set).done();
    (folder, run)
}

pub const EIGENVALUE_SET: &str = "mesh.circumferential_elements=36 ; mesh.radial_elements=5 ; \
     cea.friction_coefficients={from=0.0,to=0.6,count=13} ; cea.max_frequency_hz=13000.0";

pub fn eigenvalue_report() -> (TempDir, Answer) {
    report_of("cea", "polycarbonate-disc.toml", &[EIGENVALUE_SET])
}

/// Presses the button of a figure whose text begins so.
pub fn press(browser: &Browser, figure: &str, text: &str) {
    let script = format!(
        "const b = [...document.getElementById('{figure}').querySelectorAll('button')].find(b => b.textContent.startsWith('{text}'));\
         if (!b) return false; b.scrollIntoView({{block: 'center'}}); b.click(); return true"
    );
    assert_eq!(browser.run(&script), json!(true), "{figure}: {text}");
}

/// The table that a figure lets one take along.
pub fn data_of(browser: &Browser, figure: &str) -> Vec<Vec<String>> {
    browser.run("window.taken = null; URL.createObjectURL = blob => { blob.text().then(t => window.taken = t); return 'blob:none'; }; HTMLAnchorElement.prototype.click = function () { window.takenName = this.download; };");
    press(browser, figure, "Data");
    browser.wait("return window.taken !== null");
    assert_eq!(browser.run("return window.takenName"), json!(format!("{figure}.csv")));
    let text = browser.run("return window.taken");
    let bytes = text.as_str().unwrap().as_bytes();
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(bytes);
    reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect()
}

pub fn check_accessibility(browser: &Browser) {
    browser.run(include_str!("vendor/axe.min.js"));
    let found = browser.run_async(
        "const r = await axe.run(document, { runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'best-practice'] });\
         return r.violations.map(v => v.id + ': ' + v.nodes.slice(0, 3).map(n => n.html.slice(0, 200)).join(' | '))",
    );
    assert_eq!(found, json!([]));
}

/// No fault of accessibility, no message in the console.
pub fn check_page(browser: &Browser) {
    check_accessibility(browser);
    let messages = browser.messages();
    assert!(messages.is_empty(), "{messages:?}");
}

/// What the canvas of a figure says.
pub fn canvas(browser: &Browser, figure: &str, what: &str) -> Value {
    let figure = figure.replace('.', "\\\\.");
    browser.run(&format!("return document.querySelector('#{figure} canvas').{what}"))
}

/// Lets the modes of a figure move for a while.
pub fn play(browser: &Browser, figure: &str) {
    press(browser, figure, "Play");
    let name = figure.replace('.', "\\\\.");
    let phase = format!("Number(document.querySelector('#{name} canvas').dataset.phase)");
    browser.wait(&format!("return {phase} > 0.05"));
    press(browser, figure, "Pause");
}

pub fn check_text_stays_text(browser: &Browser) {
    // A document's title has no double spaces.
    let has_title = "return document.querySelector('h1').textContent\
        .replace(/\\s+/g, ' ').startsWith(document.title)";
    assert_eq!(browser.run(has_title), json!(true));
    assert!(browser.run("return document.title").as_str().unwrap().starts_with(MARKUP));
    assert_eq!(browser.run("return document.querySelectorAll('img').length"), json!(0));
}

pub fn keep_screenshot(browser: &Browser, name: &str) {
    fs::write(kept("reports").join(name), browser.screenshot()).unwrap();
}
