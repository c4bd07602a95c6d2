//! A browser without a window, led through WebDriver.

use crate::common::prelude::*;
use base64::prelude::{BASE64_STANDARD, Engine};
use std::io::{BufRead, BufReader};
use std::net::{TcpListener, TcpStream};

/// One page in one browser; closed when dropped.
pub struct Browser {
    driver: Child,
    port: u16,
    session: String,
}

/// Whether there is a driver; refuses that there is none where a browser is asked for.
pub fn is_there() -> bool {
    let found = Command::new("chromedriver").arg("--version").output().is_ok();
    let is_required = std::env::var_os("FRICTIONSIM_BROWSER").is_some();
    assert!(found || !is_required, "FRICTIONSIM_BROWSER is set, but there is no chromedriver");
    if !found {
        eprintln!("no chromedriver here (Debian: apt-get install chromium chromium-driver)");
    }
    found
}

impl Browser {
    /// A window in which pages are this large.
    pub fn open([width, height]: [usize; 2]) -> Self {
        let port = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        let driver = Command::new("chromedriver")
            .arg(format!("--port={port}"))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut browser = Self { driver, port, session: String::new() };
        let start = Instant::now();
        while TcpStream::connect(("127.0.0.1", port)).is_err() {
            assert!(start.elapsed() < Duration::from_secs(30), "chromedriver does not answer");
            std::thread::sleep(Duration::from_millis(50));
        }
        let options = json!({ "args": [
            "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
            format!("--window-size={width},{height}"),
        ] });
        // A machine with other work takes its time over a script that reads a whole page.
        let wanted = json!({ "capabilities": { "alwaysMatch": {
            "timeouts": { "script": 180_000, "pageLoad": 180_000 },
            "goog:loggingPrefs": { "browser": "ALL" }, "goog:chromeOptions": options,
        } } });
        let made = browser.request("POST", "/session", &wanted);
        browser.session = format!("/session/{}", made["sessionId"].as_str().unwrap());
        // A window of the desktop cannot be as narrow as a phone.
        let size =
            json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        let command = json!({ "cmd": "Emulation.setDeviceMetricsOverride", "params": size });
        browser.post("/goog/cdp/execute", command);
        browser
    }

    /// Opens a file; waits until its scripts have done their part.
    pub fn visit(&self, file: &Path) {
        self.post("/url", json!({ "url": format!("file://{}", file.display()) }));
    }

    /// As [`Browser::visit`], and waits until the scripts have done their part.
    pub fn visit_ready(&self, file: &Path) {
        self.visit(file);
        self.wait("return document.documentElement.dataset.ready === 'yes'");
    }

    /// What a script returns.
    pub fn run(&self, script: &str) -> Value {
        self.post("/execute/sync", json!({ "script": script, "args": [] }))
    }

    /// What a promise of a script comes to.
    pub fn run_async(&self, script: &str) -> Value {
        let script = format!(
            "const done = arguments[0]; (async () => {{ {script} }})().then(done, e => done('failed: ' + e));"
        );
        self.post("/execute/async", json!({ "script": script, "args": [] }))
    }

    /// Waits until a script returns true, ten seconds at most.
    pub fn wait(&self, script: &str) {
        let start = Instant::now();
        while self.run(script) != json!(true) {
            assert!(start.elapsed() < Duration::from_secs(10), "{script}: {:?}", self.messages());
            std::thread::sleep(Duration::from_millis(30));
        }
    }

    /// Types into the element that a selector finds.
    pub fn send(&self, selector: &str, text: &str) {
        let found = self.post("/element", json!({ "using": "css selector", "value": selector }));
        let id = found.as_object().and_then(|ids| ids.values().next()?.as_str());
        let id = id.unwrap_or_else(|| panic!("{selector}: {found}"));
        self.post(&format!("/element/{id}/value"), json!({ "text": text }));
    }

    /// Drags the mouse over the middle half of the element that a selector finds.
    pub fn drag_over(&self, selector: &str) {
        let place = self.run(&format!(
            "const e = document.querySelector({}); e.scrollIntoView({{ block: 'center' }}); const r = e.getBoundingClientRect(); return [r.left, r.top, r.width, r.height]",
            json!(selector)
        ));
        let number = |i: usize| place[i].as_f64().unwrap();
        let at = |part: f64| [number(0) + part * number(2), number(1) + 0.5 * number(3)];
        self.press_along(&[at(0.25), at(0.5), at(0.75)]);
    }

    /// Moves the mouse to the first place of the window, presses, goes through the others and lets go.
    pub fn press_along(&self, places: &[[f64; 2]]) {
        let press = |kind: &str| json!({ "type": kind, "button": 0 });
        let to = |place: &[f64; 2]| {
            let [x, y] = place.map(f64::round);
            json!({ "type": "pointerMove", "duration": 100, "x": x, "y": y })
        };
        let mut actions: Vec<Value> = places.iter().map(to).collect();
        actions.insert(1, press("pointerDown"));
        actions.push(press("pointerUp"));
        let mouse = json!({
            "type": "pointer", "id": "mouse", "parameters": { "pointerType": "mouse" }, "actions": actions,
        });
        self.post("/actions", json!({ "actions": [mouse] }));
    }

    /// What the console has been told.
    pub fn messages(&self) -> Vec<String> {
        let log = self.post("/se/log", json!({ "type": "browser" }));
        log.as_array().into_iter().flatten().map(|entry| entry["message"].to_string()).collect()
    }

    /// The visible part of the page as PNG.
    pub fn screenshot(&self) -> Vec<u8> {
        let shot = self.request("GET", &format!("{}/screenshot", self.session), &Value::Null);
        BASE64_STANDARD.decode(shot.as_str().unwrap()).unwrap()
    }

    fn post(&self, path: &str, body: Value) -> Value {
        self.request("POST", &format!("{}{path}", self.session), &body)
    }

    fn request(&self, method: &str, path: &str, body: &Value) -> Value {
        let answer = self.exchange(method, path, body);
        let answer = answer.unwrap_or_else(|error| panic!("{method} {path}: {error}"));
        let value = &answer["value"];
        assert!(value.get("error").is_none(), "{method} {path}: {value}");
        value.clone()
    }

    fn exchange(&self, method: &str, path: &str, body: &Value) -> std::io::Result<Value> {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port))?;
        stream.set_read_timeout(Some(Duration::from_secs(200)))?;
        let body = if method == "POST" { body.to_string() } else { String::new() };
        write!(
            stream,
            "{method} {path} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nContent-Type: application/json\r\n\
             Content-Length: {}\r\nConnection: close\r\n\r\n{body}",
            self.port,
            body.len()
        )?;
        // The driver keeps the connection open: the header says how long the answer is.
        let mut reader = BufReader::new(stream);
        let (mut length, mut line) = (0, String::new());
        while reader.read_line(&mut line)? > 2 {
            if let Some(value) = line.to_ascii_lowercase().strip_prefix("content-length:") {
                length = value.trim().parse().unwrap_or(0);
            }
            line.clear();
        }
        let mut content = vec![0; length];
        reader.read_exact(&mut content)?;
        Ok(serde_json::from_slice(&content)?)
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.exchange("DELETE", &self.session, &Value::Null);
        let _ = self.driver.kill();
        let _ = self.driver.wait();
    }
}
