//! A headless Chromium, driven over a pipe by its DevTools protocol.

use std::io::{BufRead as _, BufReader, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde_json::{Value, json};

/// Names that the browser goes by.
const NAMES: [&str; 3] = ["chromium", "chromium-browser", "google-chrome"];

/// No network, no services, nothing kept.
const FLAGS: [&str; 10] = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--no-default-browser-check",
    "--remote-debugging-pipe",
    "--allow-file-access-from-files",
];

/// Where the browser is, if there is one.
pub fn find() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let folders: Vec<PathBuf> = std::env::split_paths(&path).collect();
    let places = NAMES
        .iter()
        .flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
    places.into_iter().find(|place| place.is_file())
}

/// One tab of a browser with a profile of its own.
pub struct Browser {
    child: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
    session: Option<String>,
    last: u64,
    profile: PathBuf,
    /// What the page did wrong since it was opened: errors, exceptions,
    /// requests that leave the machine.
    events: Vec<String>,
}

impl Browser {
    pub fn start(binary: &Path, name: &str) -> Self {
        let profile = std::env::temp_dir()
            .join(format!("rocking-page-{name}-{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&profile);
        // The protocol is spoken on descriptors 3 and 4.
        let mut child = Command::new("sh")
            .arg("-c")
            .arg("exec \"$0\" \"$@\" 3<&0 4>&1 </dev/null >/dev/null 2>&1")
            .arg(binary)
            .args(FLAGS)
            .arg(format!("--user-data-dir={}", profile.display()))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("a browser that starts");
        let to = child.stdin.take().expect("input");
        let from = BufReader::new(child.stdout.take().expect("output"));
        let mut browser = Self {
            child,
            to,
            from,
            session: None,
            last: 0,
            profile,
            events: Vec::new(),
        };
        let tab =
            browser.ask("Target.createTarget", json!({"url": "about:blank"}));
        let session = browser.ask(
            "Target.attachToTarget",
            json!({"targetId": tab["targetId"], "flatten": true}),
        );
        browser.session = session["sessionId"].as_str().map(String::from);
        for domain in ["Page", "Runtime", "Log", "Network"] {
            browser.ask(&format!("{domain}.enable"), json!({}));
        }
        browser
    }

    /// Opens a page of that width, light or dark, and waits until it is
    /// loaded.
    pub fn open(&mut self, page: &Path, width_px: u32, scheme: &str) {
        self.ask(
            "Emulation.setDeviceMetricsOverride",
            json!({
                "width": width_px, "height": 900, "deviceScaleFactor": 1,
                "mobile": width_px < 600,
            }),
        );
        let feature = json!({"name": "prefers-color-scheme", "value": scheme});
        self.ask("Emulation.setEmulatedMedia", json!({"features": [feature]}));
        // A page of its own each time, with no event left from the last.
        self.ask("Page.navigate", json!({"url": "about:blank"}));
        self.wait("Page.loadEventFired");
        self.events.clear();
        let url = format!("file://{}", page.display());
        self.ask("Page.navigate", json!({"url": url}));
        self.wait("Page.loadEventFired");
    }

    /// The value of an expression, awaited.
    pub fn evaluate(&mut self, expression: &str) -> Value {
        let answer = self.ask(
            "Runtime.evaluate",
            json!({
                "expression": expression, "returnByValue": true,
                "awaitPromise": true,
            }),
        );
        assert!(answer.get("exceptionDetails").is_none(), "{answer:#}");
        answer["result"]["value"].clone()
    }

    /// What the page did wrong since it was opened.
    pub fn events(&self) -> Vec<String> {
        self.events.clone()
    }

    fn ask(&mut self, method: &str, params: Value) -> Value {
        self.last += 1;
        let mut message =
            json!({"id": self.last, "method": method, "params": params});
        if let Some(session) = &self.session {
            message["sessionId"] = json!(session);
        }
        let mut bytes = message.to_string().into_bytes();
        bytes.push(0);
        self.to.write_all(&bytes).expect("a browser that listens");
        self.to.flush().expect("a browser that listens");
        loop {
            let answer = self.hear();
            if answer["id"] == self.last {
                assert!(answer.get("error").is_none(), "{method}: {answer}");
                return answer["result"].clone();
            }
        }
    }

    fn wait(&mut self, event: &str) {
        while self.hear()["method"] != event {}
    }

    fn hear(&mut self) -> Value {
        let mut bytes = Vec::new();
        let read = self.from.read_until(0, &mut bytes).expect("an answer");
        assert!(read > 0, "the browser ended");
        bytes.pop();
        let message: Value = serde_json::from_slice(&bytes).expect("JSON");
        self.events.extend(complaint(&message));
        message
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
        let _ = std::fs::remove_dir_all(&self.profile);
    }
}

/// What an event says against the page.
fn complaint(message: &Value) -> Option<String> {
    let params = &message["params"];
    match message["method"].as_str()? {
        "Runtime.exceptionThrown" => {
            let details = &params["exceptionDetails"];
            Some(format!("exception: {}", details["exception"]["description"]))
        }
        "Runtime.consoleAPICalled" => {
            let kind = params["type"].as_str()?;
            let first = &params["args"][0]["value"];
            matches!(kind, "error" | "warning" | "assert")
                .then(|| format!("console {kind}: {first}"))
        }
        "Log.entryAdded" => {
            let entry = &params["entry"];
            let level = entry["level"].as_str()?;
            matches!(level, "error" | "warning").then(|| {
                format!("log {level}: {} {}", entry["text"], entry["url"])
            })
        }
        "Network.requestWillBeSent" => {
            let url = params["request"]["url"].as_str()?;
            let local = ["file:", "data:", "about:", "blob:"];
            (!local.iter().any(|scheme| url.starts_with(scheme)))
                .then(|| format!("request: {url}"))
        }
        _ => None,
    }
}
